"""Surfaces of trimesh, meshio and PyVista come in and go out; what is not installed is named.

Debian has meshio; trimesh and PyVista are taken where they are installed, else classes with the same members stand in.
"""
import importlib
import os
import pathlib
import subprocess
import sys
import tempfile
import types
import unittest

import numpy as np

import clast
import loud

ROOT = pathlib.Path(__file__).resolve().parents[2]
GRAIN = ROOT / "data/standin63/grain00.ply"


class Trimesh:
    def __init__(self, vertices, faces, process=True):
        self.vertices, self.faces, self.process = vertices.view(type("TrackedArray", (np.ndarray,), {})), faces, process


class PolyData:
    """pyvista.PolyData: faces lie flat, each with its number of corners before it."""

    def __init__(self, points, faces):
        self.points, self.faces = points, faces

    def triangulate(self):
        out, at = [], 0
        while at < len(self.faces):
            n, corner = self.faces[at], self.faces[at + 1:at + 1 + self.faces[at]]
            out += [x for k in range(1, n - 1) for x in (3, corner[0], corner[k], corner[k + 1])]
            at += n + 1
        return PolyData(self.points, np.array(out))


class Grid:
    def __init__(self, surface):
        self.surface = surface

    def extract_surface(self):
        return self.surface


def module(name, **members):
    """The module, or one with these members."""
    try:
        return importlib.import_module(name)
    except ImportError:
        made = types.ModuleType(name)
        made.__dict__.update(members)
        return made


SQUARE = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0.0]])
CUBE = np.array([[x, y, z] for x in (0.0, 1.0) for y in (0.0, 1.0) for z in (0.0, 1.0)])
SIDES = np.array([[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]])


class Others(unittest.TestCase):
    def setUp(self):
        self.grain = clast.Mesh.read(GRAIN)
        held = {name: sys.modules.get(name) for name in ("trimesh", "pyvista")}
        sys.modules["trimesh"] = module("trimesh", Trimesh=Trimesh)
        sys.modules["pyvista"] = module("pyvista", PolyData=PolyData)
        self.addCleanup(lambda: [sys.modules.pop(name) if was is None else sys.modules.update({name: was}) for name, was in held.items()])

    def same(self, mesh):
        self.assertTrue(np.array_equal(mesh.vertices, self.grain.vertices))
        self.assertTrue(np.array_equal(mesh.triangles, self.grain.triangles))
        self.assertEqual(mesh.volume, self.grain.volume)

    def test_there_and_back(self):
        self.same(clast.Mesh.from_trimesh(self.grain.to_trimesh()))
        self.same(clast.Mesh.from_pyvista(self.grain.to_pyvista()))
        self.assertAlmostEqual(clast.Mesh.from_pyvista(Grid(self.grain.to_pyvista())).volume, self.grain.volume)

    def test_what_goes_out_is_a_copy(self):
        other = self.grain.to_trimesh()
        other.vertices[:] = 0
        self.assertGreater(self.grain.volume, 0)

    def test_meshio(self):
        try:
            import meshio
        except ImportError:
            self.skipTest(loud.LEFT_OUT + "meshio is not installed (apt install python3-meshio)")
        self.same(clast.Mesh.from_meshio(self.grain.to_meshio()))
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "grain.vtu")
            self.grain.to_meshio().write(path)
            self.same(clast.Mesh.from_meshio(meshio.read(path)))
            self.same(clast.Mesh.from_meshio(meshio.read(GRAIN)))
        cube = meshio.Mesh(CUBE, [("quad", SIDES), ("line", np.array([[0, 1]])), ("vertex", np.array([[0]]))])
        self.assertEqual((clast.Mesh.from_meshio(cube).volume, clast.Mesh.from_meshio(cube).check().is_solid), (1.0, True))
        with self.assertRaisesRegex(clast.Error, "^cells: 1 of kind tetra; a surface has triangles"):
            clast.Mesh.from_meshio(meshio.Mesh(CUBE, [("tetra", np.array([[0, 1, 2, 4]]))]))

    def test_exports_open_in_meshio(self):
        """No VTU of clast did: texts were arrays of type String, for which meshio refuses the whole file."""
        try:
            import meshio
        except ImportError:
            self.skipTest(loud.LEFT_OUT + "meshio is not installed (apt install python3-meshio)")
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "grains.vtu")
            made = clast.export(ROOT / "data/state/schema1.h5", path)
            mesh = meshio.read(path)
            self.assertEqual((len(mesh.points), len(mesh.cells[0].data)), (made["n_vertex"], made["n_triangle"]))
            self.assertEqual(bytes(mesh.field_data["unit"]), b"mm\0")
            self.assertEqual(bytes(mesh.field_data["shape_names"]).split(b"\0")[0], b'egg, "the" <first>')
            run = pathlib.Path(folder, "cells")
            words = [os.environ["CLAST"], "decompose", ROOT / "data/d2sd/points_b3_n500.csv", "--domain", "box:0,0,0,1,1,1", "-o", run]
            subprocess.run(words, check=True, stdout=subprocess.DEVNULL)
            mesh = meshio.read(run / "cells.vtu")
            self.assertEqual(bytes(mesh.field_data["domain"]), b"box:0,0,0,1,1,1\0")
            self.assertEqual(mesh.cell_data["count"][0].sum(), 500)

    def test_indices_of_any_width(self):
        for kind in ("u8", "i8", "u4", "i2", ">i4"):
            of = types.SimpleNamespace(points=self.grain.vertices, cells=[("triangle", self.grain.triangles.astype(kind))])
            self.same(clast.Mesh.from_meshio(of))
        both = clast.Mesh.from_meshio(types.SimpleNamespace(points=CUBE, cells=[("triangle", SIDES[:1, :3].astype("u8")), ("quad", SIDES[1:].astype("i8"))]))
        self.assertEqual(len(both.triangles), 11)
        with self.assertRaisesRegex(clast.Error, "^triangles: a number beyond 32 bits"):
            clast.Mesh.from_meshio(types.SimpleNamespace(points=CUBE, cells=[("triangle", np.array([[0, 1, 2**63]], "u8"))]))

    def test_quadrangles_are_cut_inside(self):
        for turn in range(4):  # an arrow head: area 1, its hull has 2
            arrow = np.array([[0, 0, 0], [2, 0, 0], [0.5, 0.5, 0], [0, 2, 0.0]])
            quad = np.roll(np.arange(4), turn)[None]
            cut = clast.Mesh.from_meshio(types.SimpleNamespace(points=arrow, cells=[("quad", quad)]))
            self.assertAlmostEqual(cut.area, 1.0, places=14)
        for bad in ([0, 1, 2, 4], [0, 1, 2, -1]):
            with self.assertRaisesRegex(clast.Error, "^quads: vertex numbers from .* where there are 4 vertices"):
                clast.Mesh.from_meshio(types.SimpleNamespace(points=SQUARE, cells=[("quad", np.array([bad]))]))
        with self.assertRaisesRegex(clast.Error, "^quads: an array of shape"):
            clast.Mesh.from_meshio(types.SimpleNamespace(points=SQUARE, cells=[("quad", np.array([[0, 1, 2]]))]))
        flat = clast.Mesh.from_meshio(types.SimpleNamespace(points=SQUARE[:, :2], cells=[("quad", np.array([[0, 1, 2, 3]]))]))
        self.assertEqual(flat.area, 1.0)

    def test_faces_of_many_corners(self):
        flat = np.hstack([np.full((6, 1), 4), SIDES]).ravel()
        self.assertEqual(clast.Mesh.from_pyvista(PolyData(CUBE, flat)).volume, 1.0)
        with self.assertRaisesRegex(clast.Error, "^faces: not all are triangles"):
            clast.Mesh.from_pyvista(types.SimpleNamespace(points=CUBE, faces=flat))

    def test_what_is_no_surface_is_refused_by_name(self):
        for call in ("from_trimesh", "from_meshio", "from_pyvista"):
            with self.assertRaisesRegex(clast.Error, f"^{call}: a dict without"):
                getattr(clast.Mesh, call)({})

    def test_what_is_not_installed_is_named(self):
        for name in ("trimesh", "meshio", "pyvista"):
            held = sys.modules.get(name)
            sys.modules[name] = None
            try:
                with self.assertRaisesRegex(clast.Error, f"^to_{name}: {name} is not installed"):
                    getattr(self.grain, f"to_{name}")()
            finally:
                sys.modules.pop(name) if held is None else sys.modules.update({name: held})


if __name__ == "__main__":
    loud.main()
