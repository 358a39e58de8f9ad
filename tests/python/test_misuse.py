"""What must not be done, done on purpose to every class: it ends in one line or in the right number, never in a crash.

CTest runs this plain, and in the build with sanitizers under AddressSanitizer, which sees each byte that is read after it was freed.
"""
import copy
import gc
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
        done = subprocess.run([sys.executable, "-c", script % str(ROOT / "tests/python")], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
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
        cloud = pickle.loads(pickle.dumps(clast.Cloud(X, domain=BOX)))
        self.assertEqual(cloud.decompose().pair_integral, clast.decompose(X, domain=BOX).pair_integral)

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
        for bad in ([[0, 1, 3]], [[0, 1, -1]], [[0, 1, 2**31]], [[0, 1, 2**63 - 1]], np.array([[0, 1, 2**64 - 1]], "u8"), [[0.0, 1.0, 2.0]], [[0, 1]], []):
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
