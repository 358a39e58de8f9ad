"""The Python package: the command's numbers, arrays in and out, what is refused, and what is closed or let go of."""
import gc
import json
import os
import pathlib
import pickle
import subprocess
import sys
import tempfile
import threading
import tracemalloc
import unittest

import numpy as np

import clast

ROOT = pathlib.Path(__file__).resolve().parents[2]
GRAIN = ROOT / "data/standin63/grain00.ply"
POINTS = ROOT / "data/d2sd/points_b3_n500.csv"
BOX = "box:0,0,0,1,1,1"
AGGREGATE = {"core": "sphere", "core_size": 270e-6, "coat": "sphere", "size": "30um", "replicate": 20}


def command(*words):
    return json.loads(subprocess.run([os.environ["CLAST"], *map(str, words), "--json"], check=True, stdout=subprocess.PIPE).stdout)


class Numbers(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.x = np.loadtxt(POINTS, delimiter=",", skiprows=1)

    def test_mesh(self):
        said, found = command("mesh", "check", GRAIN), clast.mesh_check(GRAIN)
        for name in ("volume", "area", "closed", "oriented", "manifold", "extent", "hull_volume"):
            self.assertEqual(getattr(found, name), said[name], name)

    def test_shape(self):
        for axes in ("ellipsoid", "box", "feret"):
            said, found = command("shape", GRAIN, "--axes", axes)["grains"][0], clast.shape(GRAIN, axes=axes)
            self.assertEqual([found.L, found.I, found.S, found.sieve_size, found.flatness], [said[k] for k in ("L", "I", "S", "D", "flatness")])

    def test_decompose(self):
        said = command("decompose", POINTS, "--domain", BOX)
        found = clast.decompose(self.x, domain=BOX)
        for name in ("n", "n_cell", "score", "stop", "reject", "resolved", "pair_integral", "pair_integral_low", "pair_integral_high"):
            here = getattr(found, name)
            self.assertEqual(None if here != here else here, said[name], name)  # null there is NaN here
        self.assertEqual(found.cells["count"].sum(), 500)
        self.assertEqual([(t["name"], t["statistic"], t["p"], t["reject"]) for t in said["tests"]], [tuple(row) for row in found.tests.tolist()])
        for name in ("ideal_score", "estimator", "n_repeated"):
            self.assertEqual(getattr(found, name), said[name], name)
        self.assertTrue(np.array_equal(np.bincount(found.cell_of_point), found.cells["count"]))

    def test_keys_are_those_of_the_command(self):
        said = {row["name"]: row for one in command("describe")["commands"] if one["name"] == "aggregate" for row in one["fields"]}
        found = clast.keys("aggregate")
        self.assertEqual({k: v.help for k, v in found.items()}, {k: v["doc"] for k, v in said.items()})
        self.assertEqual([found["cone"].unit, found["contact"].default, found["contact"].low], ["rad", "exact", None])
        self.assertIn(found["cone"].help, clast.aggregate.__doc__)
        with self.assertRaisesRegex(clast.Error, "'growing' is none of mesh check"):
            clast.keys("growing")

    def test_agglomerate(self):
        keys = ["--domain", BOX, "--kernel", "constant", "--constant", 0.01, "--duration", "10s", "--n-step", 4, "--seed", 3]
        said = command("agglomerate", POINTS, *keys)
        found = clast.agglomerate(self.x, domain=BOX, kernel="constant", constant=0.01, duration=10.0, n_step=4, seed=3)
        self.assertEqual(list(found.history["n_particle"]), said["n_particle"])
        self.assertEqual(list(found.history["M2"]), said["moments"]["M2"])
        self.assertEqual([found.n_cell], said["n_cell"][-1:])
        with self.assertRaisesRegex(clast.Error, "no keyword kerne; did you mean kernel"):
            clast.agglomerate(self.x, domain=BOX, kerne="constant")
        with self.assertRaisesRegex(clast.Error, "monomers: 3 rows where there are 500"):
            clast.agglomerate(self.x, domain=BOX, kernel="constant", monomers=np.ones(3))

    def test_grading_and_predict(self):
        said, found = command("grading", "U1"), clast.Grading("U1")
        self.assertEqual(found.size(0.5, "mass"), said["drawn_by_mass"]["d50"])
        self.assertEqual(found.size(0.5), said["drawn_by_number"]["d50"])
        drawn = command("grading", "U1", "--sample", 20, "-o", pathlib.Path(self.folder.name, "sizes.csv"))
        self.assertTrue(drawn)
        self.assertTrue(np.array_equal(found.draw(20), clast.read_table(pathlib.Path(self.folder.name, "sizes.csv"))["diameter_m"]))
        found.close()
        with self.assertRaisesRegex(clast.Error, "this grading is closed"):
            found.size(0.5)
        for words, given in ((("--flatness", 0.65, "--elongation", 0.7), (0.65, 0.7)),
                             (("--flatness", "0.65+-0.17", "--elongation", "0.7+-0.1", "--grains", 300), ((0.65, 0.17), (0.7, 0.1)))):
            said, found = command("predict", *words), clast.predict(*given, grains=300 if "--grains" in words else 0)
            self.assertEqual([found.model, found.porosity, found.standard_error, found.in_range],
                             [said[k] for k in ("model", "porosity", "standard_error", "in_range")])

    def test_render_and_report(self):
        run, page = pathlib.Path(self.folder.name, "run"), pathlib.Path(self.folder.name, "page.html")
        one, two = (pathlib.Path(self.folder.name, n) for n in ("one.png", "two.png"))
        clast.aggregate(**AGGREGATE, output=run)
        picture = clast.render(run, width=96, height=64, colour_bar=False, scale_bar=False)
        self.assertEqual(picture.rgba.shape, (64, 96, 4))
        picture.write(one)
        command("render", run, "--width", 96, "--height", 64, "--no-colour-bar", "--no-scale-bar", "-o", two)
        self.assertEqual(one.read_bytes(), two.read_bytes())
        self.assertEqual(picture._repr_png_(), one.read_bytes())
        pixels = picture.rgba
        del picture
        gc.collect()
        self.assertGreater(pixels[..., 3].max(), 0)
        clast.report(run, output=page, title="Ash")
        self.assertIn("<title>Ash", page.read_text())
        with self.assertRaisesRegex(clast.Error, "none is given"):
            clast.report(output=page)

    def test_aggregate_and_its_folder(self):
        one, two = pathlib.Path(self.folder.name, "one"), pathlib.Path(self.folder.name, "two")
        told = []
        found = clast.aggregate(**AGGREGATE, output=one, progress=lambda *what: told.append(what))
        said = command("aggregate", "--core", "sphere", "--core-size", "270um", "--coat", "sphere", "--size", "30um", "--replicate", 20,
                       "-o", two)
        clocks = ("wall_s", "contact_s", "envelope_s", "repeats")
        self.assertEqual({k: v for k, v in found.values.items() if k not in clocks}, {k: v for k, v in said.items() if k not in clocks})
        self.assertTrue(told)
        self.assertEqual((one / "state.h5").read_bytes(), (two / "state.h5").read_bytes())
        run = clast.open(one)
        self.assertEqual((run.command, len(run.grains), run.grains.positions.shape), ("aggregate", 21, (21, 3)))
        self.assertEqual(len(run.grains.table()), 21)
        run.grains.write(one / "grains.csv")
        subprocess.run([os.environ["CLAST"], "export", two, "-o", two / "grains.csv"], check=True, stdout=subprocess.DEVNULL)
        self.assertEqual((one / "grains.csv").read_bytes(), (two / "grains.csv").read_bytes())
        self.assertGreater(len(run.table("history")), 0)

    def test_pack(self):
        keys = {"curve": "4mm", "mass": "1g", "width": "30mm", "height": 0.1, "shaking_time": 0, "max_steps": 500}
        said = command("pack", *(w for k, v in keys.items() for w in (f"--{k.replace('_', '-')}", "0.1m" if k == "height" else v)))
        found = clast.pack(**keys)
        self.assertEqual(found.state_hash, said["state_hash"])


    def test_fill(self):
        said, found = command("fill", GRAIN), clast.fill(clast.Mesh.read(GRAIN))
        for name in ("n_sphere", "filled_fraction", "sphere_volume", "inertia_error", "max_protrusion"):
            self.assertEqual(getattr(found, name), said[name], name)
        self.assertEqual(found.centres.shape, (said["n_sphere"], 3))
        history, clump = pathlib.Path(self.folder.name, "history.csv"), pathlib.Path(self.folder.name, "clump.csv")
        command("fill", GRAIN, "--history", history, "-o", clump)
        self.assertTrue(np.array_equal(clast.read_table(history), found.history))
        found.write(pathlib.Path(self.folder.name, "own.csv"), name="grain00")
        self.assertEqual(clump.read_bytes(), pathlib.Path(self.folder.name, "own.csv").read_bytes())
        with self.assertRaisesRegex(clast.Error, "no keyword history"):
            clast.fill(GRAIN, history="x.csv")

    def test_porosity(self):
        bed = pathlib.Path(self.folder.name, "bed")
        clast.pack(curve="4mm", mass="40g", width="30mm", height="0.1m", shaking_time=0, max_steps=20000, output=bed)
        for method in ("exact", "spheres"):
            said, found = command("porosity", bed, "--method", method), clast.porosity(bed, method=method)
            self.assertEqual((found.porosity, found.z_low, found.z_high), (said["bulk"], said["z_low"], said["z_high"]))
        said = command("porosity", bed, "--core", 1, "--local", "--rings", 3, "--pores", 500, "--layer", "2mm", "--trim", "1mm", "--at-slice")
        found = clast.porosity(bed, core=1, local=True, rings=3, pores=500, layer="2mm", trim=1e-3, at_slice=True)
        self.assertEqual([found.porosity, found.core, found.core_error, found.wall_share, found.wall_ratio, found.grain_size, found.coordination],
                         [said[k] for k in ("bulk", "core", "core_error", "wall_share", "wall_ratio", "grain_size", "coordination")])
        self.assertEqual(dict(zip(found.fabric["name"], found.fabric["value"])), said["fabric"])
        self.assertEqual(dict(zip(found.stress["name"], found.stress["value"])), said["stress"])
        inner = found.local[found.local["border"] == 0]
        self.assertAlmostEqual(inner["porosity"].mean() if len(inner) else np.nan, said["local_mean"] or np.nan, places=14)
        self.assertEqual((len(found.radial), len(found.pores) > 0), (3, True))
        self.assertIn("data:image/svg", found._repr_html_())

    def test_porosity_of_other_beds(self):
        # Spheres on a cubic lattice whose box repeats in x and y: grains that poke out count whole [1 - pi / 6 = 0.4764].
        text = "x_mm,y_mm,z_mm,d_mm\n" + "".join(f"{i},{j},{k + 0.5},1\n" for i in range(4) for j in range(4) for k in range(8))
        path = pathlib.Path(self.folder.name, "spheres.csv")
        path.write_text(text)
        bed = "periodic:0mm,0mm,4mm,4mm"
        said = command("porosity", path, "--bed", bed, "--trim", "2mm", "--layer", "1mm", "--gap", "10um", "--at-slice")
        found = clast.porosity(path, bed=bed, trim="2mm", layer="1mm", gap="10um", at_slice=True)
        self.assertEqual([found.porosity, found.coordination, found.n_overlap], [said[k] for k in ("bulk", "coordination", "n_overlap")])
        self.assertAlmostEqual(found.porosity, 1 - np.pi / 6, places=12)
        grains = clast.Assembly.read_spheres(path)
        before = grains.positions.copy()
        self.assertEqual(clast.porosity(grains, bed=bed, trim="2mm", layer="1mm", at_slice=True).porosity, found.porosity)
        self.assertTrue(np.array_equal(grains.positions, before))
        # a window of the packing counted the solid beyond its sides
        with self.assertRaisesRegex(clast.Error, "^bed: 96 of 128 grains reach beyond its sides, by up to 500 um"):
            clast.porosity(path, bed="box:0mm,0mm,3mm,3mm", layer="0.2mm")
        with self.assertWarnsRegex(UserWarning, "^bed: 96 of 128 grains reach beyond its sides"):
            window = clast.porosity(path, bed="box:0mm,0mm,3mm,3mm", layer="0.2mm", pores=500)
        said = command("porosity", path, "--bed", "box:0mm,0mm,3mm,3mm", "--layer", "0.2mm", "--pores", 500)
        self.assertEqual((window.n_beyond, window.max_beyond, window.porosity), (said["n_beyond"], said["max_beyond"], said["bulk"]))
        self.assertAlmostEqual(window.porosity, float(said["pore_porosity"]), places=1)
        self.assertEqual((window.is_part, window.wall_ratio, found.is_part, said["is_part"]), (True, float("inf"), False, True))
        with self.assertWarns(UserWarning):  # the last ring held what lies beyond it, of porosity -2.6
            rings = clast.porosity(path, bed="cylinder:1.5mm,2mm,2mm", layer="0.2mm", pores=500, rings=3).radial
        self.assertTrue(np.all((rings["porosity"] > 0.2) & (rings["porosity"] < 0.8)))
        with self.assertRaisesRegex(clast.Error, "a part of a packing has no side walls"):
            clast.porosity(path, bed="box:0mm,0mm,3mm,3mm", layer="0.2mm", pores=500, core=1)
        self.assertEqual(found.n_beyond, -1)
        with self.assertRaisesRegex(clast.Error, "^bed: its images lie on .* of 128 grains"):  # 0.2772 for 0.4408
            clast.porosity(path, bed="periodic:0mm,0mm,3mm,3mm", layer="0.2mm")
        sheared = clast.porosity(path, bed="periodic:0mm,0mm,0mm,4mm,4mm,8mm,1mm")
        self.assertAlmostEqual(sheared.porosity, 1 - np.pi / 6, places=12)
        self.assertEqual(sheared.n_overlap, -1)
        for keys, line in (({}, "^bed: .* does not say what holds the grains"), (dict(bed="cylinder:1mm"), "^bed: grains take"),
                           (dict(bed=bed, trim="2"), "2"), (dict(bed=bed, trim=-1.0), "^trim: -1.0 lies outside")):
            with self.assertRaisesRegex(clast.Error, line):
                clast.porosity(path, **keys)

    def test_a_folder_that_is_no_run(self):
        with self.assertRaises(clast.Error):
            clast.open(self.folder.name)


class Arrays(unittest.TestCase):
    def setUp(self):
        self.x = np.loadtxt(POINTS, delimiter=",", skiprows=1)

    def test_what_is_taken_gives_the_same(self):
        wide = np.zeros((len(self.x), 6))
        wide[:, ::2] = self.x
        still = self.x.copy()
        still.flags.writeable = False
        want = clast.decompose(self.x, domain=BOX).pair_integral
        for same in (wide[:, ::2], self.x.astype(">f8"), np.asfortranarray(self.x), still, self.x.tolist()):
            self.assertEqual(clast.decompose(same, domain=BOX).pair_integral, want)
        single = self.x.astype(np.float32)
        self.assertEqual(clast.decompose(single, domain=BOX).pair_integral, clast.decompose(single.astype(float), domain=BOX).pair_integral)

    def test_what_is_no_cloud_is_refused_by_name(self):
        for bad in (np.zeros((0, 3)), np.zeros(3), np.zeros((2, 4)), self.x.astype(complex), np.array([["a", "b"]]), np.array([[None]])):
            with self.assertRaisesRegex(clast.Error, "^positions: "):
                clast.decompose(bad, domain=BOX)
        with self.assertRaisesRegex(clast.Error, "^radius: 3 rows"):
            clast.decompose(self.x, domain=BOX, radius=np.ones(3))
        with self.assertRaisesRegex(clast.Error, "^triangles: vertex numbers from 0 to 9"):
            clast.Mesh(np.zeros((4, 3)), [[0, 1, 9]])
        with self.assertRaisesRegex(clast.Error, "^triangles: an array of float64"):
            clast.Mesh(np.zeros((4, 3)), np.zeros((1, 3)))

    def test_keywords_are_checked_by_the_tables(self):
        with self.assertRaisesRegex(clast.Error, "did you mean seed") as caught:
            clast.decompose(self.x, domain=BOX, sed=1)
        self.assertEqual(caught.exception.code, "CLAST_E_CONFIG")
        with self.assertRaises(clast.Error):
            clast.aggregate(**{**AGGREGATE, "cone": "50kg"})

    def test_a_million_positions_are_not_copied_by_python(self):
        x = np.random.default_rng(1).random((10**6, 3))
        tracemalloc.start()
        clast.decompose(x, domain=BOX, variant="test")
        peak = tracemalloc.get_traced_memory()[1]
        tracemalloc.stop()
        self.assertLess(peak, x.nbytes / 4)


class Lives(unittest.TestCase):
    def test_a_view_keeps_its_owner(self):
        mesh = clast.Mesh.read(GRAIN)
        vertices, before = mesh.vertices, mesh.vertices.copy()
        mesh.close()
        del mesh
        gc.collect()
        np.zeros(10**6)
        self.assertTrue(np.array_equal(vertices, before))

    def test_use_after_close_is_an_error(self):
        mesh = clast.Mesh.read(GRAIN)
        mesh.close()
        mesh.close()
        for use in (lambda: mesh.volume, lambda: mesh.vertices, mesh.check, mesh.shape, mesh.hull):
            with self.assertRaisesRegex(clast.Error, "closed"):
                use()

    def test_arrays_are_borrowed(self):
        read = clast.Mesh.read(GRAIN)
        vertices, triangles = read.vertices.copy(), read.triangles.copy()
        mesh = clast.Mesh(vertices, triangles)
        self.assertIs(mesh.vertices, vertices)
        del vertices, triangles
        self.assertEqual(mesh.volume, read.volume)

    def test_threads_at_once(self):
        found = []
        threads = [threading.Thread(target=lambda: found.append(clast.Mesh.read(GRAIN).shape().sieve_size)) for _ in range(8)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(len(set(found)), 1)
        self.assertEqual(len(found), 8)

    def test_a_child_process_may_free(self):
        mesh = clast.Mesh.read(GRAIN)
        child = os.fork()
        if child == 0:
            mesh.close()
            os._exit(0)
        self.assertEqual(os.waitpid(child, 0)[1], 0)
        self.assertGreater(mesh.volume, 0)

    def test_what_a_callback_raises_comes_out(self):
        def fail(*_):
            raise RuntimeError("mine")
        with self.assertRaisesRegex(RuntimeError, "mine"):
            clast.aggregate(**AGGREGATE, progress=fail)

    def test_a_handler_that_python_did_not_set_stays(self):
        """An interpreter inside a program: signal.signal cannot put that program's handler of Ctrl-C back, so it is left alone."""
        import signal
        from unittest import mock
        with mock.patch.object(signal, "getsignal", return_value=None), mock.patch.object(signal, "signal") as changed:
            self.assertGreater(clast.aggregate(**AGGREGATE)["n_grain"], 0)
        changed.assert_not_called()
        before = signal.getsignal(signal.SIGINT)
        clast.aggregate(**AGGREGATE)
        self.assertIs(signal.getsignal(signal.SIGINT), before)

    def test_interrupt_ends_at_a_checkpoint(self):
        with tempfile.TemporaryDirectory() as folder:
            with self.assertRaises(KeyboardInterrupt):
                clast.aggregate(**{**AGGREGATE, "replicate": 2000}, output=folder + "/run", progress=lambda *_: os.kill(os.getpid(), 2))
            self.assertGreater(clast.Mesh.read(GRAIN).volume, 0)
            self.assertIn("stopped", pathlib.Path(folder, "run/manifest.json").read_text())

    def test_interrupt_ends_what_keeps_nothing(self):
        points = np.random.default_rng(1).random((50, 3))
        for work in (lambda p: clast.agglomerate(points, domain="box:0,0,0,1,1,1", n_step=50, progress=p),
                     lambda p: clast.box_model(concentration=1e12, n_step=50, particles=100, repeats=4, progress=p),
                     lambda p: clast.box_model(concentration=1e12, n_step=50, solver="sectional", progress=p),
                     lambda p: clast.shapes(*[GRAIN] * 50, progress=p)):
            told = []
            work(lambda phase, done, total: told.append((done, total)))
            self.assertEqual(told[-1][0], told[-1][1])
            with self.assertRaises(KeyboardInterrupt):
                work(lambda *_: os.kill(os.getpid(), 2))

    def test_without_the_library_the_cure_is_named(self):
        env = {k: v for k, v in os.environ.items() if k not in ("CLAST_LIBRARY", "LD_LIBRARY_PATH")}
        done = subprocess.run([sys.executable, "-c", "import clast"], env=env, stderr=subprocess.PIPE, text=True)
        if done.returncode:  # no library installed beside this build
            self.assertRegex(done.stderr.splitlines()[-1], "no libclast_view.so .*pip install.*libclast-view0[.]2")

    def test_errors_go_between_processes(self):
        error = pickle.loads(pickle.dumps(clast.Error("CLAST_E_IO", "no such file")))
        self.assertEqual((error.code, str(error)), ("CLAST_E_IO", "no such file"))

    def test_points_on_a_line_show_their_numbers(self):
        cells = clast.decompose(np.random.default_rng(1).random((200, 1)), domain="box:0,1")
        self.assertIn("n_cell", cells._repr_html_())

    def test_texts_in_bytes_are_texts(self):
        from clast._tables import given_table, table_of
        self.assertEqual(list(table_of(given_table("t", {"g": np.array([b"a", b"b"]), "x": [1.0, 2.0]}))["g"]), ["a", "b"])

    def test_a_library_that_was_named_is_not_replaced(self):
        done = subprocess.run([sys.executable, "-c", "import clast"], env={**os.environ, "CLAST_LIBRARY": "/no/such.so"}, stderr=subprocess.PIPE, text=True)
        self.assertEqual(done.returncode, 1)
        self.assertIn("/no/such.so", done.stderr.splitlines()[-1])


unittest.main()
