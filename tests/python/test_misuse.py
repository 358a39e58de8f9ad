"""What must not be done, done on purpose to every class: it ends in one line or in the right number, never in a crash.

CTest runs this plain, and in the build with sanitizers under AddressSanitizer, which sees each byte that is read after it was freed.
"""
import copy
import gc
import inspect
import itertools
import multiprocessing
import os
import pathlib
import pickle
import subprocess
import sys
import tempfile
import threading
import unittest
from unittest import mock

import numpy as np

import clast

ROOT = pathlib.Path(__file__).resolve().parents[2]
GRAIN = ROOT / "data/standin63/grain00.ply"
SMALL = {"core": "sphere", "core_size": 270e-6, "coat": "sphere", "size": "30um", "replicate": 20}
X = np.random.default_rng(7).random((400, 3))
BOX = "box:0,0,0,1,1,1"
FOLDER = tempfile.TemporaryDirectory()
RUN = pathlib.Path(FOLDER.name, "run")
clast.aggregate(**SMALL, picture=False, output=RUN)

FORMS = {"flatness": np.linspace(0.4, 0.8, 9), "elongation": np.linspace(0.7, 0.5, 9) ** 2 + 0.3}
LATTICE = pathlib.Path(FOLDER.name, "lattice.csv")
LATTICE.write_text("x_mm,y_mm,z_mm,d_mm\n" + "".join(f"{i},{j},{k + 0.5},1\n" for i in range(-3, 4) for j in range(-3, 4) for k in range(6)))


def beds():
    k = np.arange(40.0)
    return {"x": k, "y": np.sin(k), "porosity": 0.3 + 0.001 * k + 0.01 * np.sin(k * k)}


# class: a maker, and the arrays that look into its memory
MAKERS = {
    "Mesh": (lambda: clast.Mesh.read(GRAIN), lambda m: [m.vertices, m.triangles]),
    "Mesh of arrays": (lambda: clast.Mesh(np.eye(3), [[0, 1, 2]]), lambda m: [m.vertices, m.triangles]),
    "Spheres": (lambda: clast.fill(GRAIN, spheres=4), lambda s: [s.centres, s.radii]),
    "Assembly": (lambda: clast.Assembly.read(RUN), lambda a: [a.positions, a.orientations, a.scales, a.densities, a.shape_ids]),
    "Run": (lambda: clast.open(RUN), lambda r: [r.grains.positions, r.table("history")["n"]]),
    "Table": (lambda: clast.read_table(RUN / "history.csv"), lambda t: [t["n"], t[2:5]["n"]]),
    "Cloud": (lambda: clast.Cloud(X.copy(), mass=np.ones(400)), lambda c: [c.positions, c.mass]),
    "Decomposition": (lambda: clast.decompose(X, domain=BOX), lambda d: [d.cells, d.cell_of_point]),
    "Agglomeration": (lambda: clast.agglomerate(X, domain=BOX, kernel="constant", constant=0.01, duration=1.0, n_step=2), lambda a: [a.history]),
    "Fit": (lambda: clast.fit(beds(), features="columns", n_term=1, n_permutation=0), lambda f: [f.terms["coefficient"], f.rows["fitted"]]),
    "Picture": (lambda: clast.render(RUN, width=64, height=64, colour_bar=False, scale_bar=False), lambda p: [p.rgba]),
    "Grading": (lambda: clast.Grading("U3"), lambda g: [g.draw(5), g.classes["mass"]]),
    "Grains": (lambda: clast.shapes(GRAIN, GRAIN), lambda g: [g.table["volume"]]),
    "GrainStatistics": (lambda: clast.grain_statistics(FORMS, resamples=10), lambda g: [g.columns["mean"], g.correlation, g.explained]),
    "Spectrum": (lambda: clast.box_model(concentration=2, constant=1, particles=200, n_step=2), lambda s: [s.history["M0"], s.spectrum["n"]]),
    "Porosity": (lambda: clast.porosity(LATTICE, bed="periodic:-3.5mm,-3.5mm,3.5mm,3.5mm", gap="1um"), lambda p: [p.profile["porosity"], p.fabric["value"]]),
    "Model": (lambda: clast.Model("single_form_U1"), lambda m: [np.array(list(m.coefficients.values()))]),
    "SurfaceResult": (lambda: clast.mesh_hull(GRAIN), lambda s: [s.mesh.vertices]),
}


def digest(array):
    return np.ascontiguousarray(array).tobytes()


class Lives(unittest.TestCase):
    """Objects and the views of their memory go in any order."""

    def test_views_outlive_their_owner(self):
        for name, (make, views_of) in MAKERS.items():
            made = make()
            views = views_of(made)
            want = [digest(v) for v in views]
            del made
            gc.collect()
            np.zeros(10**5)  # what was freed is written over
            self.assertEqual([digest(v) for v in views], want, name)

    def test_views_go_in_any_order(self):
        for name, (make, views_of) in MAKERS.items():
            n = len(views_of(make())) + 1
            for order in itertools.islice(itertools.permutations(range(n)), 3):
                made = make()
                held = [made, *views_of(made)]
                want = [None, *(digest(v) for v in held[1:])]
                del made
                for gone in order:
                    held[gone] = None
                    gc.collect()
                    self.assertTrue(all(digest(v) == w for v, w in zip(held[1:], want[1:]) if v is not None), name)

    def test_circles_are_collected(self):
        for name, (make, views_of) in MAKERS.items():
            class Holder:
                pass
            one, other = Holder(), Holder()
            one.other, other.one, one.made, other.views = other, one, make(), views_of(make())
            del one, other
            self.assertGreater(gc.collect(), 0, name)

    def test_everything_may_be_left_at_the_end(self):
        script = ("import sys; sys.path.insert(0, %r); sys.argv = ['x']\nfrom test_misuse import MAKERS\n"
                  "left = [(make(), views(make())) for make, views in MAKERS.values()]; left.append(left)\nprint('end')")
        done = subprocess.run([sys.executable, "-W", "ignore", "-c", script % str(ROOT / "tests/python")], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.assertEqual((done.returncode, done.stdout, done.stderr), (0, "end\n", ""))

    def test_copies_own_nothing_twice(self):
        for name, (make, views_of) in MAKERS.items():
            made = make()
            again = copy.copy(made)
            want = [digest(v) for v in views_of(made)]
            del made
            gc.collect()
            self.assertEqual([digest(v) for v in views_of(again)], want, name)
            try:
                pickled = pickle.loads(pickle.dumps(again))
            except (TypeError, ValueError, AttributeError):
                continue  # memory of the library's cannot be pickled
            self.assertEqual([digest(v) for v in views_of(pickled)], want, name)

    def test_meshes_and_clouds_can_be_pickled(self):
        mesh = pickle.loads(pickle.dumps(clast.Mesh.read(GRAIN)))
        self.assertEqual(mesh.volume, clast.Mesh.read(GRAIN).volume)
        named = os.path.join(FOLDER.name, "named.ply")
        clast.mesh_synthesize(size="5mm", unit="mm", output=named)
        for again in (pickle.loads(pickle.dumps(clast.Mesh.read(named))), copy.deepcopy(clast.Mesh.read(named))):
            self.assertAlmostEqual(clast.mesh_form(again, size="7000um")["after"]["D"], 7.0)  # in the unit that its file named
        cloud = pickle.loads(pickle.dumps(clast.Cloud(X, domain=BOX)))
        self.assertEqual(cloud.decompose().pair_integral, clast.decompose(X, domain=BOX).pair_integral)

    def test_what_cannot_be_pickled_says_so_in_one_line(self):
        """A Grading left "Exception ignored in ... __del__" on the error stream besides."""
        for use in (pickle.dumps, copy.deepcopy):
            with mock.patch("sys.unraisablehook") as ignored, self.assertRaisesRegex(TypeError, "neither copied nor pickled"):
                use(clast.Grading("U1"))
            ignored.assert_not_called()

    def test_points_without_triangles(self):
        path = os.path.join(FOLDER.name, "points.ply")
        pathlib.Path(path).write_text("ply\nformat ascii 1.0\nelement vertex 4\nproperty double x\nproperty double y\nproperty double z\nend_header\n"
                                      "0 0 0\n1 0 0\n0 1 0\n0 0 1\n")
        for made in (clast.Mesh.read(path, weld=False), pickle.loads(pickle.dumps(clast.Mesh.read(path, weld=False))), clast.mesh_convert(path, path[:-4] + "2.ply", scale=2.0).mesh,
                     clast.Mesh(np.eye(4)[:, :3], np.zeros((0, 3), int))):
            self.assertEqual((len(made.vertices), made.triangles.shape), (4, (0, 3)))
            self.assertGreater(made.hull().volume, 0.1)
            for use in (made.shape, made.check, lambda: made.area, lambda: clast.fill(made), lambda: clast.mesh_repair(made), lambda: clast.mesh_simplify(made, 9),
                        lambda: clast.mesh_form(made), lambda: made.write(path[:-4] + ".stl"), made.to_trimesh, lambda: repr(made)):
                try:
                    use()
                except clast.Error as error:
                    self.assertEqual(len(str(error).splitlines()), 1)

    def test_results_can_be_compared_and_looked_into(self):
        for name, (make, _) in {**MAKERS, "Result": (lambda: clast.aggregate(**SMALL), None), "Prediction": (lambda: clast.predict(0.6, 0.7), None)}.items():
            if name == "Table":
                continue  # is an array
            made, again = make(), make()
            self.assertEqual((made == made, made != made, bool(made == again) == bool(made != again)), (True, False, False), name)
            self.assertTrue(made != again or hash(made) == hash(again), name)
            self.assertGreater(len(inspect.getmembers(made)), 5, name)
        run = clast.open(RUN)
        self.assertGreater(len(inspect.getmembers(run.grains)), len(inspect.getmembers(object)))

    def test_members_that_are_not_there(self):
        """hasattr, getattr with a default and inspect ask for what raises AttributeError."""
        result = clast.aggregate(**SMALL)
        self.assertEqual((hasattr(result, "run"), getattr(result, "run", 3)), (False, 3))
        with self.assertRaisesRegex(clast.Error, "^run: no folder was written; call with output=FOLDER"):
            result.run
        with tempfile.TemporaryDirectory() as folder:
            result = clast.aggregate(**SMALL, picture=False, output=os.path.join(folder, "run"))
            run = result.run
        self.assertEqual((hasattr(result, "run"), hasattr(run, "grains")), (False, False))
        for error in (lambda: result.run, lambda: run.grains):
            with self.assertRaisesRegex(clast.Error, "run") as caught:
                error()
            self.assertEqual(str(pickle.loads(pickle.dumps(caught.exception))), str(caught.exception))

    def test_a_temporary_is_not_freed_while_it_is_used(self):
        for use in (lambda: clast.mesh_simplify(GRAIN, 50), lambda: clast.mesh_repair(GRAIN), lambda: clast.mesh_form(GRAIN, flatness=0.5),
                    lambda: clast.mesh_hull(clast.Mesh.read(GRAIN)), lambda: clast.Assembly.read(RUN).volume, lambda: clast.Mesh.read(GRAIN).hull().volume,
                    lambda: clast.render(clast.Assembly.read(RUN), width=64, height=64, colour_bar=False, scale_bar=False), lambda: clast.Assembly.read(RUN)._copy()._copy().table()):
            use()


class Closed(unittest.TestCase):
    def test_use_after_close_is_one_line(self):
        for make, uses in ((MAKERS["Mesh"][0], [lambda m: m.volume, lambda m: m.area, lambda m: m.vertices, lambda m: m.triangles, lambda m: m.hull(),
                                               lambda m: m.check(), lambda m: m.shape(), lambda m: m.write("x.stl"), lambda m: m.to_meshio(),
                                               lambda m: clast.fill(m), lambda m: clast.mesh_repair(m), lambda m: clast.mesh_simplify(m),
                                               lambda m: pickle.dumps(m)]),
                           (MAKERS["Grading"][0], [lambda g: g.size(0.5), lambda g: g.draw(3), lambda g: g.classes, lambda g: g.range,
                                                   lambda g: g.mean_cube, lambda g: g.n_expected(1.0)])):
            made = make()
            made.close()
            made.close()
            for use in uses:
                with self.assertRaisesRegex(clast.Error, "closed"):
                    use(made)
            repr(made)

    def test_close_while_another_thread_uses_it(self):
        for _ in range(8):
            mesh = clast.Mesh.read(GRAIN)
            found = []

            def work(mesh=mesh, found=found):
                try:
                    found.append(mesh.shape().volume)
                except clast.Error as error:
                    found.append(str(error))
            threads = [threading.Thread(target=work) for _ in range(3)] + [threading.Thread(target=mesh.close)]
            for thread in threads:
                thread.start()
            for thread in threads:
                thread.join()
            self.assertTrue(all(one in (clast.Mesh.read(GRAIN).shape().volume, "this mesh is closed") for one in found), found)

    def test_close_from_its_own_callback(self):
        mesh = clast.Mesh.read(GRAIN)
        self.assertEqual(clast.fill(mesh, spheres=20, progress=lambda *_: mesh.close()).n_sphere, clast.fill(GRAIN, spheres=20).n_sphere)

    def test_callbacks_may_call_the_library(self):
        seen = []
        clast.aggregate(**SMALL, progress=lambda *_: seen.append(clast.aggregate(**{**SMALL, "replicate": 2}).n_grain))
        self.assertEqual(set(seen), {3})

    def test_callbacks_that_are_none(self):
        with self.assertRaises(TypeError):
            clast.aggregate(**SMALL, progress=lambda: None)


class Arrays(unittest.TestCase):
    def test_every_layout_gives_the_same(self):
        raw = bytearray(X.nbytes + 1)
        odd = np.frombuffer(memoryview(raw)[1:], np.float64).reshape(X.shape)  # not aligned
        odd[...] = X
        with tempfile.TemporaryFile() as file:
            X.tofile(file)
            file.flush()
            mapped = np.memmap(file, np.float64, "r", shape=X.shape)
            want = clast.decompose(X, domain=BOX).pair_integral
            for same in (X[::-1][::-1], np.asfortranarray(X), X.astype(">f8"), X.astype("<f8"), odd, mapped, X.astype(np.longdouble),
                         np.stack([X, X])[1], np.ma.MaskedArray(X), np.repeat(X, 2, axis=0)[::2]):
                self.assertEqual(clast.Cloud(same).decompose(domain=BOX).pair_integral, want, type(same))
        backwards = clast.Cloud(X[::-1])
        self.assertTrue(np.array_equal(backwards.positions, X[::-1]))

    def test_integers_and_halves(self):
        corner = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]])
        faces = np.array([[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])
        for kind in ("i1", "u1", ">i2", "u4", "i8", "f2", "f4", ">f8"):
            self.assertAlmostEqual(clast.Mesh(corner.astype(kind), faces).volume, 1 / 6, places=15)
        for kind in ("i1", "u1", ">i2", ">i4", "u4", ">u8", "i8"):
            self.assertAlmostEqual(clast.Mesh(corner, faces.astype(kind)).volume, 1 / 6, places=15)

    def test_what_is_refused_is_named(self):
        masked = np.ma.MaskedArray(X, mask=X > 0.9)
        for bad in (X[0], X[None], np.zeros((3, 4)), np.zeros((0, 3)), X > 0.5, X.astype(complex), X.astype(str), X.astype(object), masked, None, "x",
                    {}, [[1, 2], [3]], X.view([("a", "f8"), ("b", "f8"), ("c", "f8")]), np.zeros((2, 3), "M8[s]")):
            with self.assertRaises((clast.Error, ValueError)) as caught:
                clast.Cloud(bad)
            self.assertRegex(str(caught.exception), "^positions: |inhomogeneous")
        for bad in ([[0, 1, 3]], [[0, 1, -1]], [[0, 1, 2**31]], [[0, 1, 2**63 - 1]], np.array([[0, 1, 2**64 - 1]], "u8"), [[0.0, 1.0, 2.0]], [[0, 1]]):
            with self.assertRaisesRegex(clast.Error, "^triangles: "):
                clast.Mesh(np.eye(3), bad)
        for name, bad in (("radius", np.ones(399)), ("mass", np.ones((400, 1))), ("weight", ["a"] * 400), ("velocity", np.ones((400, 2)))):
            with self.assertRaisesRegex(clast.Error, f"^{name}: "):
                clast.decompose(X, domain=BOX, **{name: bad})

    def test_indices_cannot_be_changed_under_the_library(self):
        faces = np.array([[0, 1, 2]], np.int32)
        mesh = clast.Mesh(np.eye(3), faces)
        area = mesh.area
        faces[0, 0] = 10**8
        self.assertEqual(mesh.area, area)
        for array in (mesh.triangles, clast.Assembly.read(RUN).shape_ids, clast.decompose(X, domain=BOX).cell_of_point):
            with self.assertRaisesRegex(ValueError, "read-only"):
                array[0] = 10**8
            with self.assertRaises(ValueError):
                array.flags.writeable = True

    def test_arrays_cannot_be_replaced_under_the_library(self):
        """Strided or shorter arrays in their place were read as they lay, beyond their end."""
        cloud, grains = clast.Cloud(X.copy(), mass=np.ones(400), domain=BOX), clast.Assembly.read(RUN)
        for made, names in ((cloud, ("positions", "mass", "radius", "weight", "velocity", "variable")), (clast.Mesh.read(GRAIN), ("vertices", "triangles")),
                            (grains, ("positions", "orientations", "scales", "densities", "shape_ids", "unit")),
                            (MAKERS["Picture"][0](), ("rgba", "pixel_size")), (MAKERS["Model"][0](), ("intercept", "coefficients", "name", "kind", "source", "ranges"))):
            for name in names:
                with self.assertRaisesRegex(AttributeError, name):
                    setattr(made, name, X[::2])
        want = cloud.decompose().pair_integral
        cloud.positions[:] *= 0.5  # what is written into them is read
        self.assertNotEqual(cloud.decompose().pair_integral, want)
        cloud.domain = "box:0,0,0,0.5,0.5,0.5"
        self.assertAlmostEqual(cloud.decompose().pair_integral / 8 / want, 1)
        again = pickle.loads(pickle.dumps(cloud))
        self.assertEqual((again.mass[3], again.decompose().pair_integral), (1.0, cloud.decompose().pair_integral))

    def test_numbers_that_are_none(self):
        for bad in (np.nan, np.inf, -np.inf, 1e308, 1e-320):
            grain = clast.Mesh.read(GRAIN)
            grain.vertices[5] = bad
            for use in (lambda: grain.volume, grain.hull, grain.shape, grain.check, lambda: clast.fill(grain, spheres=3, max_tries=100),
                        lambda: clast.mesh_repair(grain), lambda: clast.mesh_simplify(grain, 50), lambda: clast.mesh_form(grain, flatness=0.5)):
                try:
                    use()
                except clast.Error as error:
                    self.assertEqual(len(str(error).splitlines()), 1)
            x = X.copy()
            x[3] = bad
            if bad != 1e-320:
                with self.assertRaises(clast.Error):
                    clast.decompose(x, domain=BOX)
            for member in ("positions", "orientations", "scales", "densities"):
                grains = clast.Assembly.read(RUN)
                getattr(grains, member)[2] = bad
                for use in (lambda: grains.volume, lambda: clast.render(grains, width=64, height=64, colour_bar=False, scale_bar=False), grains.view, grains.table,
                            lambda: clast.porosity(grains, bed="cylinder:10mm"), lambda: grains.write(os.path.join(FOLDER.name, "x.vtu"))):
                    try:
                        use()
                    except clast.Error as error:
                        self.assertEqual(len(str(error).splitlines()), 1)


class Keywords(unittest.TestCase):
    def test_values_of_every_kind(self):
        for value in (object(), b"U1", {}, [], [1, 2], (), np.zeros(0), np.zeros((2, 2)), float("nan"), float("inf"), 10**400, "", "\0", "1kg\0x", "\ud800", 1j,
                      ...):
            for key in ("mass", "seed", "law", "floor", "width"):
                with self.assertRaises(clast.Error) as caught:
                    clast.pack(**{key: value, "max_steps": 1, "curve": "nothing"})
                self.assertEqual(len(str(caught.exception).splitlines()), 1)

    def test_an_empty_list_empties(self):
        with self.assertRaisesRegex(clast.Error, "shape"):
            clast.pack(shapes=[], mass="1g", max_steps=1)

    def test_texts_end_where_they_end(self):
        for use in (lambda: clast.Mesh.read(f"{GRAIN}\0.stl"), lambda: clast.Grading("U1\0"), lambda: clast.read_table("x\0"), lambda: clast.open(f"{RUN}\0"),
                    lambda: clast.decompose(X, domain=BOX + "\0"), lambda: clast.Cloud.read(ROOT / "data/d2sd/points_b3_n500.csv", unit="mm\0"), lambda: clast.Model("single_form_U1\0"),
                    lambda: clast.predict_beds({"flatness\0": [0.5], "elongation": [0.5]}), lambda: clast.mesh_convert(GRAIN, "x.stl", unit="mm\0"),
                    lambda: clast.Mesh.read(GRAIN).write("x\0.stl"), lambda: clast.fit(beds(), name="a\0b"), lambda: clast.porosity(RUN, bed="cylinder:1m\0")):
            with self.assertRaisesRegex(clast.Error, "NUL"):
                use()

    def test_flags_are_words_everywhere(self):
        """`bool("no")` is true: half of the functions took a word for its contrary."""
        grain, bed = clast.Mesh.read(GRAIN), dict(bed="periodic:-3.5mm,-3.5mm,3.5mm,3.5mm")
        for name, use in (("local", lambda flag: len(clast.porosity(LATTICE, **bed, local=flag).local)), ("at_slice", lambda flag: clast.porosity(LATTICE, **bed, at_slice=flag).z_high),
                          ("test_only", lambda flag: clast.decompose(X**3, domain=BOX, test_only=flag).n_cell), ("hull", lambda flag: grain.shape(hull=flag).volume),
                          ("hull", lambda flag: clast.shape(GRAIN, hull=flag).volume), ("hull", lambda flag: clast.shapes(GRAIN, hull=flag).table["volume"][0]),
                          ("unit_form", lambda flag: clast.mesh_form(GRAIN, unit_form=flag).after["I"]),
                          ("weld", lambda flag: len(clast.Mesh.read(GRAIN, weld=flag).vertices)),
                          ("points", lambda flag: clast.export(RUN, os.path.join(FOLDER.name, "x.vtu"), points=flag)["n_vertex"]),
                          ("accept_faults", lambda flag: len(clast.aggregate(**SMALL, accept_faults=flag).values))):
            for flag in (False, True):
                for word in (*(("yes", "1", 1) if flag else ("no", "off", 0)), np.bool_(flag), np.array(flag)):
                    self.assertEqual(use(word), use(flag), (name, word))
            for bad in ("maybe", "No", 2, 0.5):
                with self.assertRaisesRegex(clast.Error, f"^{name}: '{bad}' is neither true nor false"):
                    use(bad)
        with self.assertRaisesRegex(clast.Error, "^unit_form: makes"):
            clast.mesh_form(GRAIN, flatness=0.5, unit_form="yes")

    def test_values_of_numpy_and_pandas(self):
        for keys in (dict(core_size=np.array(270e-6)), dict(replicate=np.array(20)), dict(replicate=20.0), dict(replicate=np.float32(20)), dict(size=np.array([30e-6])),
                     dict(core_size=[np.array("270um")]), dict(size=[np.array(30e-6)])):
            self.assertEqual(clast.aggregate(**{**SMALL, **keys}).n_grain, 21, keys)
        want = clast.aggregate(**{**SMALL, "size": [30e-6, 20e-6]}).n_grain
        lists = [np.array([30e-6, 20e-6]), (np.float64(30e-6), "20um"), np.array(["30um", "20um"])]
        try:
            import pandas
            lists += [pandas.Series([30e-6, 20e-6]), pandas.Index(["30um", "20um"])]
        except ImportError:
            pass
        for size in lists:
            self.assertEqual(clast.aggregate(**{**SMALL, "size": size}).n_grain, want)
        brownian = dict(domain="box:0,0,0,1e-4,1e-4,1e-4", kernel="brownian", radius=np.full(400, 1e-6), duration="100s", n_step=2)
        self.assertEqual(list(clast.agglomerate(X * 1e-4, **brownian, temperature=np.array(300.0)).history["n_particle"]),
                         list(clast.agglomerate(X * 1e-4, **brownian, temperature=300).history["n_particle"]))

    def test_one_rule_for_whole_numbers(self):
        grading = clast.Grading("U3")
        want = clast.decompose(X, domain=BOX, seed=3).pair_integral
        for seed in (3, 3.0, np.float32(3), np.array(3.0), "3"):
            self.assertEqual(clast.decompose(X, domain=BOX, seed=seed).pair_integral, want)
            self.assertEqual(digest(grading.draw(4, seed)), digest(grading.draw(4, 3)))
            self.assertEqual(clast.predict(table=FORMS, seed=seed, resamples=9).standard_error, clast.predict(table=FORMS, seed=3, resamples=9).standard_error)
            self.assertEqual(clast.mesh_synthesize(seed).volume, clast.mesh_synthesize(3).volume)
        for seed in (True, np.bool_(True), 3.5, float("nan"), [1, 2], b"3", 1j):
            for use in (lambda: clast.decompose(X, domain=BOX, seed=seed), lambda: grading.draw(4, seed), lambda: clast.grain_statistics(FORMS, seed=seed, resamples=9)):
                with self.assertRaisesRegex(clast.Error, "^seed: "):
                    use()

    def test_errors_name_the_key(self):
        bed, grain, grading = dict(bed="periodic:-3.5mm,-3.5mm,3.5mm,3.5mm"), clast.Mesh.read(GRAIN), clast.Grading("U3")
        for use, name in ((lambda: clast.porosity(LATTICE, **bed, trim=[1, 2]), "trim"), (lambda: clast.porosity(LATTICE, **bed, trim="abc"), "trim"),
                          (lambda: clast.porosity(LATTICE, **bed, trim={}), "trim"), (lambda: clast.porosity(LATTICE, **bed, trim=True), "trim"),
                          (lambda: clast.porosity(LATTICE, **bed, floor="5kg"), "floor"), (lambda: clast.porosity(LATTICE, **bed, gap=float("nan")), "gap"),
                          (lambda: clast.porosity(LATTICE, **bed, columns=3), "columns"), (lambda: clast.shapes(GRAIN, threshold="grey"), "threshold"),
                          (lambda: clast.mesh_form(GRAIN, size=True), "size"), (lambda: clast.mesh_form(GRAIN, size="2kg"), "size"),
                          (lambda: clast.Assembly.read_spheres(LATTICE, diameter={}), "diameter"), (lambda: clast.Assembly.read_spheres(LATTICE, diameter="1kg"), "diameter"),
                          (lambda: clast.Grading("U3", spread=3), "spread"), (lambda: clast.Grading("U3", count="Exact"), "count"), (lambda: clast.Grading({}), "text"),
                          (lambda: grading.size("few"), "share"), (lambda: grading.size(float("nan")), "share"), (lambda: grading.size(2), "share"),
                          (lambda: grading.n_expected("1m"), "mass"), (lambda: grain.shape(3), "axes"), (lambda: grain.shape("n"), "axes"),
                          (lambda: clast.Mesh.ellipsoid((1, 1)), "semi_axes"), (lambda: clast.Mesh.ellipsoid((1, 1, 1, 1)), "semi_axes"),
                          (lambda: clast.Mesh.ellipsoid(("1mm", 1, 1)), "semi_axes"), (lambda: clast.Mesh.ellipsoid(1), "semi_axes"), (lambda: clast.Mesh.read(3), "path"),
                          (lambda: clast.Mesh.ellipsoid((1, 1, 1), level=None), "level"), (lambda: clast.mesh_convert(GRAIN, "x.ply", name=3), "name"),
                          (lambda: clast.pack(curve=b"4mm"), "curve"), (lambda: clast.shapes(GRAIN, voxels={}), "voxels"), (lambda: clast.Model(3), "name"),
                          (lambda: clast.study(run="fill", output="x", jobs="two"), "jobs"), (lambda: clast.study(run="fill", output="x", jobs=-1), "jobs"),
                          (lambda: clast.study(run="fill", output="x", seeds="few"), "seeds")):
            with self.assertRaisesRegex(clast.Error, f"^{name}: ") as caught:
                use()
            self.assertEqual(len(str(caught.exception).splitlines()), 1)

    def test_texts_are_numbers_where_the_command_takes_them(self):
        self.assertEqual(clast.mesh_form(GRAIN, hull="20").n_triangle, clast.mesh_form(GRAIN, hull=20).n_triangle)
        grey = np.pad(np.full((4, 4, 4), 200, np.uint8), 2)
        pathlib.Path(FOLDER.name, "grey.raw").write_bytes(grey.tobytes())
        self.assertEqual(len(clast.shapes(os.path.join(FOLDER.name, "grey.raw"), voxels="8,8,8", threshold="128")), 1)
        self.assertEqual(clast.Grading("U3").size("0.5"), clast.Grading("U3", spread=None).size(0.5))
        self.assertEqual(len(clast.Assembly.read_spheres(LATTICE, diameter=None)), 294)

    def test_moments_are_one_number_or_two(self):
        """A NaN or negative deviation took the model without one."""
        want = clast.predict((0.65, 0.17), (0.7, 0.1)).porosity
        pairs = [[0.65, 0.17], np.array([0.65, 0.17]), "0.65+-0.17", ["0.65", 0.17]]
        try:
            import pandas
            pairs.append(pandas.Series([0.65, 0.17]))
        except ImportError:
            pass
        for pair in pairs:
            self.assertEqual(clast.predict(pair, (0.7, 0.1)).porosity, want)
        self.assertEqual(clast.predict(np.array(0.65), np.float32(0.7)).model, "single_form_U1")
        for bad in ((0.65, -0.1), (0.65, float("nan")), (0.65, 0.1, 0.1), (), "0.65+--0.17", "0.65+-nan", True, (0.65, True), {}, [[0.65, 0.1]], np.full(99, 0.65),
                    np.ma.MaskedArray([0.65, 0.1], mask=[0, 1]), b"0.65"):
            for use in (lambda: clast.predict(bad, (0.7, 0.1)), lambda: clast.predict(flatness=(0.7, 0.1), elongation=bad)):
                with self.assertRaisesRegex(clast.Error, "^(flatness|elongation): ") as caught:
                    use()
                self.assertEqual(len(str(caught.exception).splitlines()), 1)

    def test_masks_are_not_lost(self):
        def masked(values):
            return np.ma.MaskedArray(values, mask=np.arange(len(values)) == 1)
        for use in (lambda: clast.predict(table={**FORMS, "flatness": masked(FORMS["flatness"])}), lambda: clast.grain_statistics({**FORMS, "flatness": masked(FORMS["flatness"])}),
                    lambda: clast.box_model(sizes={"size": masked([1, 2]), "number": [1.0, 2.0]}, constant=1, n_step=2), lambda: clast.fit({**beds(), "x": masked(beds()["x"])}),
                    lambda: clast.aggregate(**{**SMALL, "size": masked([3e-5, 2e-5])}), lambda: clast.aggregate(**{**SMALL, "core_size": np.ma.masked}),
                    lambda: clast.shapes(GRAIN, voxels=masked([2, 2, 2]))):
            with self.assertRaisesRegex(clast.Error, "^(table: column flatness|sizes: column size|table: column x|size|core_size|voxels): .*masked items"):
                use()
        self.assertEqual(clast.predict(table={**FORMS, "flatness": np.ma.MaskedArray(FORMS["flatness"])}).porosity, clast.predict(table=FORMS).porosity)

    def test_what_a_user_tries_first_is_told(self):
        """A table given as flatness, a file name of another kind, vertices that are no numbers."""
        table = clast.read_table(LATTICE)
        for use, word in ((lambda: clast.predict(FORMS), "flatness: a table of grains; give it by its name"),
                          (lambda: clast.predict(table), "flatness: a table of grains"),
                          (lambda: clast.predict(str(LATTICE)), "flatness: a table of grains"),
                          (lambda: table.write(pathlib.Path(FOLDER.name, "x.xlsx")), "x.xlsx: a table is written as .csv or .json"),
                          (lambda: table.write(pathlib.Path(FOLDER.name, "plain")), "written as .csv or .json"),
                          (lambda: clast.Mesh([[0, 0, 0], [1, 0, 0], [0, np.nan, 0]], [[0, 1, 2]]), "vertices: vertex 2 of 3 is not finite")):
            with self.assertRaisesRegex(clast.Error, word) as caught:
                use()
            self.assertEqual(len(str(caught.exception).splitlines()), 1)
        self.assertFalse(pathlib.Path(FOLDER.name, "x.xlsx").exists())

    def test_parts_of_tables_have_the_units_of_their_columns(self):
        history = clast.open(RUN).table("history")
        part = history[["n", "d_agg_m"]]
        self.assertEqual(part.units, {name: history.units[name] for name in ("n", "d_agg_m")})
        self.assertEqual(history[3:].units, history.units)

    def test_a_sampling_error_that_is_not_known_is_no_zero(self):
        self.assertTrue(np.isnan(clast.predict((0.647, 0.175), (0.682, 0.139)).sampling_error))
        self.assertGreater(clast.predict((0.647, 0.175), (0.682, 0.139), grains=63).sampling_error, 0)
        two = clast.predict(table={"flatness": [0.6, 0.7], "elongation": [0.7, 0.8]})
        self.assertTrue(np.isnan(two.sampling_error) and np.isfinite(two.standard_error))

    def test_integers_that_do_not_fit(self):
        grading = clast.Grading("U3")
        for use in (lambda: grading.draw(3, seed=-1), lambda: grading.draw(3, seed=2**64), lambda: grading.draw(-1), lambda: clast.mesh_synthesize(2**64),
                    lambda: clast.mesh_synthesize(-1), lambda: clast.Mesh.ellipsoid((1, 1, 1), 2**32), lambda: clast.Mesh.ellipsoid((1, 1, 1), 1.5),
                    lambda: clast.Cloud.read("x", frame=2**63), lambda: clast.predict(0.6, 0.7, grains=10**13), lambda: clast.pack(seed=2**64)):
            with self.assertRaises(clast.Error):
                use()


class Processes(unittest.TestCase):
    def test_threads_make_and_drop(self):
        want = {name: [digest(v) for v in views_of(make())] for name, (make, views_of) in MAKERS.items()}
        wrong = []

        def work():
            for name, (make, views_of) in MAKERS.items():
                if [digest(v) for v in views_of(make())] != want[name]:
                    wrong.append(name)
        threads = [threading.Thread(target=work) for _ in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(wrong, [])

    def test_messages_stay_with_their_thread(self):
        said = {}

        def work(name):
            for _ in range(50):
                try:
                    clast.Grading(name)
                except clast.Error as error:
                    said.setdefault(name, set()).add(name in str(error))
        threads = [threading.Thread(target=work, args=(f"nothing{k}",)) for k in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(said, {f"nothing{k}": {True} for k in range(4)})

    def test_a_child_computes_and_frees(self):
        made = {name: make() for name, (make, _) in MAKERS.items()}  # OpenMP has its threads by now, which the child has not
        want = clast.aggregate(**SMALL).d_agg
        child = os.fork()
        if child == 0:
            status = 1
            try:
                same = all([digest(v) for v in MAKERS[name][1](one)] for name, one in made.items())
                made.clear()
                gc.collect()
                clast.decompose(np.random.default_rng(1).random((20000, 3)), domain=BOX)
                status = 0 if same and clast.aggregate(**SMALL).d_agg == want else 2
            finally:
                os._exit(status)
        self.assertEqual(os.waitpid(child, 0)[1], 0)
        self.assertEqual(clast.aggregate(**SMALL).d_agg, want)

    def test_pools_of_processes(self):
        with multiprocessing.get_context("fork").Pool(2) as pool:
            self.assertEqual(pool.map(volume_of, [GRAIN] * 4), [clast.Mesh.read(GRAIN).volume] * 4)


def volume_of(path):
    return clast.Mesh.read(path).volume


if __name__ == "__main__":
    unittest.main()
