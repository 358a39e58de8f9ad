"""Surfaces."""
from __future__ import annotations

import ctypes
import importlib
import os
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from . import _bindings as c
from ._core import (Equal, Error, Floats, Owner, call, changed, check, choice, encoded, fixed, flag, html_table, note, numbers, output_path, pinned, refuse,
                    refuse_idle, settled, view, warn, whole)
from ._tables import Path


@dataclass(frozen=True, eq=False)
class MeshCheck(Equal):
    """What `clast mesh check` counts; lengths are in the mesh's own unit."""

    closed: bool
    oriented: bool
    manifold: bool
    n_vertex: int
    n_triangle: int
    n_edge: int
    n_part: int
    n_open_edge: int
    n_open_loop: int
    n_nonmanifold_edge: int
    n_nonmanifold_vertex: int
    n_misoriented_edge: int
    n_inside_out: int
    n_nested: int
    n_doubled: int  #: nested parts that count twice in the volume
    n_body: int  #: solid parts, each with its cavities; parted where they hang together by an edge alone
    n_repeated: int  #: triangles that repeat another with the same winding: they count twice in the volume
    n_degenerate: int
    n_duplicate: int
    n_intersection: int
    intersection_complete: bool  #: False: `n_intersection` is a lower bound, as the triangles overlap too densely
    extent: float
    volume: float
    area: float
    hull_volume: float
    n_flat: int = 0  #: parts without volume, the two sides of a sheet
    doubles: str = ""  #: what counts twice in the volume, in words

    @property
    def is_solid(self) -> bool:
        """Closed, oriented and manifold: it bounds a volume."""
        return self.closed and self.oriented and self.manifold


@dataclass(frozen=True, eq=False)
class Shape(Equal):
    """Size and form of one grain, lengths in the mesh's own unit; L >= I >= S by the named definition of axes."""

    volume: float
    area: float
    L: float
    I: float  # noqa: E741 (the field's symbol)
    S: float
    flatness: float
    elongation: float
    sieve_size: float
    sphericity: float
    convexity: float
    roundness: float
    feret_max: float
    feret_min: float
    axes: str
    roundness_deviation: float = float("nan")  #: of `roundness`, over where its search for corners begins
    pore_volume: float = 0.0  #: of closed pores, which `volume` leaves out; `area`, sphericity, convexity and roundness are of the outer surface
    pore_area: float = 0.0

    def _repr_html_(self) -> str:
        return html_table({k: v for k, v in vars(self).items()})


def _parts(call: str, given: Any, *names: str) -> list[Any]:
    missing = [name for name in names if not hasattr(given, name)]
    if missing:
        raise refuse(f"{call}: a {type(given).__name__} without {' and '.join(missing)}")
    return [getattr(given, name) for name in names]


def _module(call: str, name: str) -> Any:
    try:
        return importlib.import_module(name)
    except ImportError:
        raise refuse(f"{call}: {name} is not installed (pip install {name})") from None


def _space(points: Any) -> NDArray[Any]:
    """Points of a plane get z = 0."""
    array = np.asarray(points)
    return np.pad(array, ((0, 0), (0, 1))) if array.ndim == 2 and array.shape[1] == 2 else array


def _check_numbers(name: str, corners: NDArray[Any], n_vertex: int) -> None:
    if corners.size and (corners.min() < 0 or corners.max() >= n_vertex):
        raise refuse(f"{name}: vertex numbers from {corners.min()} to {corners.max()} where there are {n_vertex} vertices, from 0")


def _halved(points: Floats, quads: NDArray[Any]) -> NDArray[Any]:
    """Two triangles of each quadrangle, by the diagonal that leaves both on one side of it: a concave one has only that."""
    a, b, c, d = (_space(points)[quads[:, k]] for k in range(4))
    is_good = (np.cross(b - a, c - a) * np.cross(c - a, d - a)).sum(axis=1) > 0
    first = np.where(is_good[:, None], quads[:, [0, 1, 2]], quads[:, [0, 1, 3]])
    second = np.where(is_good[:, None], quads[:, [0, 2, 3]], quads[:, [1, 2, 3]])
    return np.concatenate([first, second])


class Mesh:
    """A triangle surface: `vertices` (n, 3) and `triangles` (m, 3), views of the library's memory or, of vertices, the array given.

    Points alone have triangles of shape (0, 3), or []. Vertices count from 0, in messages too.
    """

    _unit = ""  # of the coordinates, where a file that clast wrote said it

    def __init__(self, vertices: Any, triangles: Any) -> None:
        """Vertices are borrowed where they are float64 in C order, else converted once; triangles are checked and copied."""
        none = isinstance(triangles, (list, tuple)) and len(triangles) == 0  # which has neither type nor columns
        vert, given = numbers("vertices", vertices, [3]), numbers("triangles", np.zeros((0, 3), np.int32) if none else triangles, [3], np.int32, least=0)
        if not np.isfinite(vert).all():
            raise refuse(f"vertices: vertex {int(np.argmin(np.isfinite(vert).all(axis=1)))} of {len(vert)} is not finite")
        tri = np.frombuffer(given.tobytes(), np.int32).reshape(given.shape)  # which nobody can write to
        _check_numbers("triangles", tri, len(vert))
        self._mesh: Any = c.clast_mesh()
        self._mesh.n_vert, self._mesh.n_tri = len(vert), len(tri)
        self._mesh.vert = ctypes.cast(vert.ctypes.data, ctypes.POINTER(ctypes.c_double))
        self._mesh.tri = ctypes.cast(tri.ctypes.data, ctypes.POINTER(ctypes.c_int32))
        self._owner: Any = (vert, tri)
        self._arrays: tuple[Floats, NDArray[np.int32]] = (vert, tri)

    @classmethod
    def _own(cls, struct: Any, owner: Owner | None = None) -> Mesh:
        mesh = cls.__new__(cls)
        owner = owner or Owner(struct, "clast_mesh_free")
        mesh._mesh, mesh._owner = struct, owner
        mesh._arrays = (view(owner, struct.vert, (struct.n_vert, 3), np.float64), fixed(owner, struct.tri, (struct.n_tri, 3), np.int32))
        return mesh

    @classmethod
    def read(cls, path: Path, weld: bool | None = True) -> Mesh:
        """Reads STL, OBJ, PLY or OFF, as the commands do: open edges that rounding has parted are merged (weld)."""
        struct, told, joined = c.clast_mesh(), c.clast_mesh_read_report(), c.clast_mesh_repair_report()
        is_welded = weld is None or flag("weld", weld)
        check(call("clast_mesh_read")(encoded("path", path), ctypes.byref(struct), ctypes.byref(told)))
        owner = Owner(struct, "clast_mesh_free")
        for k in range(told.n_warning):
            warn(f"{os.fspath(path)}: {told.warning[k].value.decode('utf-8', 'replace')}")
        if is_welded:
            check(call("clast_mesh_weld_auto")(ctypes.byref(struct), ctypes.byref(joined)))
        if joined.n_merged > 0:
            note(f"{os.fspath(path)}: {joined.n_merged} vert{'ex' if joined.n_merged == 1 else 'ices'} of open edges merged with others within "
                 f"{joined.weld_distance:.3g} (model units)")
        mesh = cls._own(struct, owner)
        mesh._unit = told.unit.decode("utf-8", "replace")
        return mesh

    @classmethod
    def from_trimesh(cls, mesh: Any) -> Mesh:
        """From anything with `vertices` and `faces` (trimesh.Trimesh)."""
        vertices, faces = _parts("from_trimesh", mesh, "vertices", "faces")
        return cls(np.asarray(vertices), np.asarray(faces))

    def to_trimesh(self) -> Any:
        """A trimesh.Trimesh of the same vertices and triangles, in their order."""
        return _module("to_trimesh", "trimesh").Trimesh(np.array(self.vertices), np.array(self.triangles), process=False)

    @classmethod
    def from_meshio(cls, mesh: Any) -> Mesh:
        """From anything with `points` and `cells` (meshio.Mesh): triangles, and quadrangles as two; points and lines are passed over."""
        points, cells = _parts("from_meshio", mesh, "points", "cells")
        found = [np.zeros((0, 3), np.int32)]
        for block in cells:
            kind, data = (block.type, block.data) if hasattr(block, "data") else block
            if kind == "triangle":
                found.append(numbers("triangles", data, [3], np.int32, least=0))
            elif kind == "quad":
                quads = numbers("quads", data, [4], np.int32)
                _check_numbers("quads", quads, len(points))
                found.append(_halved(np.asarray(points, np.float64), quads))
            elif kind not in ("vertex", "line"):
                raise refuse(f"cells: {len(data)} of kind {kind}; a surface has triangles and quadrangles")
        return cls(_space(points), np.concatenate(found))

    def to_meshio(self) -> Any:
        """A meshio.Mesh of triangles."""
        return _module("to_meshio", "meshio").Mesh(np.array(self.vertices), [("triangle", np.array(self.triangles))])

    @classmethod
    def from_pyvista(cls, data: Any) -> Mesh:
        """From a pyvista.PolyData, or a grid, whose surface is taken; faces of more corners are cut into triangles by PyVista."""
        if not hasattr(data, "faces") and hasattr(data, "extract_surface"):
            data = data.extract_surface()
        points, faces = _parts("from_pyvista", data, "points", "faces")
        flat = np.asarray(faces)
        if (flat.size % 4 or (flat.reshape(-1, 4)[:, 0] != 3).any()) and hasattr(data, "triangulate"):
            data = data.triangulate()
            points, flat = data.points, np.asarray(data.faces)
        if flat.size % 4 or (flat.reshape(-1, 4)[:, 0] != 3).any():
            raise refuse("faces: not all are triangles; call triangulate() first")
        return cls(_space(points), flat.reshape(-1, 4)[:, 1:])

    def to_pyvista(self) -> Any:
        """A pyvista.PolyData of triangles."""
        faces = np.hstack([np.full((len(self.triangles), 1), 3), self.triangles])
        return _module("to_pyvista", "pyvista").PolyData(np.array(self.vertices), faces.ravel())

    @classmethod
    def ellipsoid(cls, semi_axes: tuple[float, float, float], level: int = 4) -> Mesh:
        """An ellipsoid of 20 * 4^level triangles."""
        struct, axes = c.clast_mesh(), numbers("semi_axes", semi_axes, None)
        if len(axes) != 3:
            raise refuse(f"semi_axes: takes three numbers, not {len(axes)}")
        check(call("clast_mesh_ellipsoid")((ctypes.c_double * 3)(*axes), whole("level", level, 0, 9), ctypes.byref(struct)))
        return cls._own(struct)

    def close(self) -> None:
        """Lets go of the memory; views of it stay good as long as they are held."""
        self._mesh = self._owner = None

    def _struct(self) -> Any:
        mesh, owner = self._mesh, self._owner
        if mesh is None or owner is None:
            raise Error("CLAST_E_USAGE", "this mesh is closed")
        return pinned(mesh, owner)

    def __reduce__(self) -> Any:
        return Mesh, (np.array(self.vertices), np.array(self.triangles)), {"_unit": self._unit}

    @property
    def vertices(self) -> Floats:
        """Corners (n, 3) float64, in the mesh's own unit: a view, which can be written into."""
        self._struct()
        return self._arrays[0]

    @property
    def triangles(self) -> NDArray[np.int32]:
        """Rows of `vertices` (m, 3) int32, counted from 0, counterclockwise from outside: a view, which cannot."""
        self._struct()
        return self._arrays[1]

    @property
    def volume(self) -> float:
        """In the cube of the mesh's own unit; signed: below 0 when inside out, meaningless when open."""
        return float(call("clast_mesh_volume")(self._struct()))

    @property
    def area(self) -> float:
        """In the square of the mesh's own unit."""
        return float(call("clast_mesh_area")(self._struct()))

    def hull(self) -> Mesh:
        """The convex hull."""
        struct = c.clast_mesh()
        check(call("clast_mesh_hull")(self._struct(), ctypes.byref(struct)))
        return Mesh._own(struct)

    def write(self, path: Path) -> None:
        """Writes STL, OBJ, PLY or OFF by the name's end; mesh_convert writes 3MF too, which needs the unit."""
        options, place = c.clast_mesh_write_options(unit=encoded("unit", self._unit) or None), surface_path("path", path)
        check(call("clast_mesh_write")(self._struct(), place, ctypes.byref(options)))

    def check(self) -> MeshCheck:
        """What is this surface, and can it be trusted?"""
        result = c.clast_mesh_check_result()
        check(call("clast_mesh_check")(self._struct(), ctypes.byref(result)))
        words = ctypes.create_string_buffer(256)
        call("clast_mesh_check_doubles")(ctypes.byref(result), len(words), words)
        try:
            return MeshCheck(**{name: getattr(result, name) for name in MeshCheck.__dataclass_fields__ if name != "doubles"},
                             doubles=words.value.decode("utf-8"))
        finally:
            call("clast_mesh_check_free")(ctypes.byref(result))

    def shape(self, axes: str = "ellipsoid", hull: bool = False) -> Shape:
        """Size and form, as `clast shape` measures them."""
        given, grain = settled("shape", dict(axes=axes, hull=hull)), c.clast_grain()
        kind = choice("axes", given["axes"], c.KEYS["shape"]["axes"][5] or "")
        check(call("clast_grain_measure_hull" if given["hull"] else "clast_grain_measure")(self._struct(), ctypes.byref(grain)))
        if not given["hull"]:
            found = self.check()
            warn_of_doubles(found, "the surface")
            if found.n_body > 1 and found.n_intersection == 0 and found.intersection_complete:
                warn(f"the surface is {found.n_body} bodies that do not hang together, measured as one grain; mesh_repair(keep='largest') keeps one")
        long, middle, least = grain.axes[kind].lis
        return Shape(volume=grain.volume, area=grain.area, L=long, I=middle, S=least, flatness=least / middle, elongation=middle / long,
                     sieve_size=float(np.sqrt((least * least + middle * middle) / 2)), sphericity=grain.sphericity,
                     convexity=grain.convexity, roundness=grain.roundness, feret_max=grain.longest, feret_min=grain.shortest, axes=given["axes"],
                     roundness_deviation=grain.roundness_deviation, pore_volume=grain.pore_volume, pore_area=grain.pore_area)

    def __repr__(self) -> str:
        return "<clast.Mesh, closed>" if self._mesh is None else f"<clast.Mesh of {self._mesh.n_vert} vertices, {self._mesh.n_tri} triangles>"


def surface_path(name: str, path: Path, *inputs: Any) -> bytes:
    """A path to write a surface to, by the name's end STL, OBJ, PLY or OFF."""
    made = output_path(name, path, *inputs)
    kind = call("clast_mesh_format_of_path")(made)
    if kind == c.VALUES["CLAST_MESH_3MF"]:
        raise refuse(f"{name}: 3MF is in millimetres and a mesh has no unit; mesh_convert(mesh, path, unit='mm') writes it")
    if kind == c.VALUES["CLAST_MESH_ANY"]:
        raise refuse(f"{name}: {os.fspath(path)} is no surface format by its name; write .stl, .obj, .ply or .off")
    return made


def warn_of_doubles(found: MeshCheck, name: str, effect: str = "") -> None:
    """Warns of what counts twice in a surface's volume."""
    if found.doubles:
        is_cut = found.n_flat == 0 and (found.n_intersection > 0 or not found.intersection_complete)
        warn(f"{name}: {found.doubles}{effect if found.n_flat == 0 else ''}{'' if is_cut else '; mesh_repair drops what bounds nothing'}")


def mesh_check(path: Path, *, weld: str = "auto", weld_tolerance: float = 1e-6) -> MeshCheck:
    """What is this file's surface, and can it be trusted?"""
    given = settled("mesh check", dict(weld=weld, weld_tolerance=weld_tolerance))
    mode = choice("weld", given["weld"], c.KEYS["mesh check"]["weld"][5] or "")
    refuse_idle(changed("mesh check", given), "clast_mesh_repair_idle", ctypes.byref(c.clast_mesh_repair_config(weld=mode)))
    mesh = Mesh.read(path, weld=given["weld"] == "auto")
    if given["weld"] == "within":
        welded = c.clast_mesh()
        check(call("clast_mesh_weld")(mesh._struct(), given["weld_tolerance"], ctypes.byref(welded), None))
        mesh = Mesh._own(welded)
    return mesh.check()


def shape(path: Path, *, axes: str = "ellipsoid", hull: bool = False) -> Shape:
    """Size and form of a file's grain, lengths in the file's own unit."""
    return Mesh.read(path).shape(axes, hull)
