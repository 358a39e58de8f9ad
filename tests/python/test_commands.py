"""Every command of clast is a function of the package, with the numbers that the command prints."""
import base64
import copy
import html
import json
import math
import os
import pathlib
import pickle
import re
import subprocess
import sys
import tempfile
import unittest
import warnings

import numpy as np

import clast

ROOT = pathlib.Path(__file__).resolve().parents[2]
GRAIN = ROOT / "data/standin63/grain00.ply"
MENGER = ROOT / "data/scarlet/stl/Menger2.stl"
OWN = {"bench", "describe", "man", "completion"}  # of the command itself: what it takes, and how fast this machine is
OTHER_NAMES = {"grading": "Grading"}


def command(*words, code=0):
    done = subprocess.run([os.environ["CLAST"], *map(str, words), "--json"], stdout=subprocess.PIPE, stderr=subprocess.PIPE, cwd=ROOT, text=True)
    if done.returncode != code:
        raise AssertionError(f"{words}: exit code {done.returncode}: {done.stderr}")
    return json.loads(done.stdout)


def form_beds(noise=0.01):
    """63 beds of one form each with eq. 17's porosity and a fixed wave on it."""
    k = np.arange(63.0)
    flatness, elongation = 0.62 + 0.3 * np.sin(1.3 * k + 0.2), 0.7 + 0.2 * np.cos(2.1 * k)
    return {"flatness": flatness, "elongation": elongation,
            "porosity": 0.278 + 0.019 / (flatness * elongation) + 0.014 / elongation + noise * np.sin(k * k)}


class Commands(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def write(self, name, columns):
        path = self.folder / name
        rows = zip(*([str(v) if isinstance(v, str) else repr(float(v)) for v in column] for column in columns.values()))
        path.write_text("\n".join([",".join(columns), *(",".join(row) for row in rows)]) + "\n")
        return path

    def same(self, found, said, names):
        for name in names:
            value = found[name] if isinstance(found, dict) else getattr(found, name)
            wanted = said[name]
            self.assertTrue(value == wanted or (wanted is None and math.isnan(value)), f"{name}: {value!r} where the command has {wanted!r}")

    def test_every_command_has_its_function(self):
        names = [one["name"] for one in command("describe")["commands"]]
        self.assertGreater(len(names), 20)
        for name in names:
            function = OTHER_NAMES.get(name, name.replace(" ", "_"))
            if name in OWN:
                self.assertFalse(hasattr(clast, function), name)
            else:
                self.assertTrue(callable(getattr(clast, function, None)), f"clast {name} has no function")
                self.assertIn(function, clast.__all__)

    def test_the_page_of_the_documents_runs(self):
        code = re.search(r"```python\n(.*?)```", (ROOT / "docs/python.md").read_text(), re.S)[1]
        (self.folder / "data").symlink_to(ROOT / "data")
        done = subprocess.run([sys.executable, "-c", code], cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertGreater(len(done.stdout.split()), 8)

    def test_fit(self):
        path = self.write("beds.csv", form_beds())
        said = command("fit", path, "--n-permutation", 19)
        for table in (path, form_beds(), clast.read_table(path)):
            found = clast.fit(table, n_permutation=19)
            self.assertEqual([found.model.name, found.model.kind], [said["model"], said["kind"]])
            self.same(found, said, ("n_bed", "n_left_out", "n_candidate", "n_removed", "r2", "cv_mean_error", "cv_median_error", "r2_held_out",
                                    "p_value", "residual_deviation", "condition"))
            self.assertEqual(list(found.terms["coefficient"]), [row["coefficient"] for row in said["terms"]])
            self.assertEqual(list(found.ranking["feature"]), [row["feature"] for row in said["ranking"]])
        found.chart("predicted", self.folder / "predicted.svg")
        self.assertIn("<svg", (self.folder / "predicted.svg").read_text())
        with self.assertRaisesRegex(clast.Error, "^name: 'predict' is none of feature, .*did you mean predicted"):
            found.chart("predict", self.folder / "x.svg")

    def test_fit_of_a_study_of_beds(self):
        rng = np.random.default_rng(5)
        beds, study = {"run": [], "porosity": []}, self.folder / "study"
        for run in range(1, 21):
            flatness, elongation = rng.uniform(0.4, 0.9, 30), rng.uniform(0.4, 0.9, 30)
            (study / f"runs/{run:06d}/out").mkdir(parents=True)
            self.write(f"study/runs/{run:06d}/out/grains.csv", {"flatness": flatness, "elongation": elongation})
            beds["run"].append(run)
            beds["porosity"].append(0.3 + 0.1 * flatness.mean() + 0.001 * rng.normal())
        path = self.write("beds.csv", beds)
        said = command("fit", path, "--group", "run", "--grains", study, "--n-term", 1)
        found = clast.fit(path, group="run", grains=study, n_term=1)
        self.same(found, said, ("n_bed", "r2", "cv_mean_error", "n_candidate"))
        with self.assertRaisesRegex(clast.Error, "no column of numbers 'bed' that names the run"):
            clast.fit(path, grains=study)
        with self.assertRaisesRegex(clast.Error, "^features: 'mixture' and grains belong together"):
            clast.fit(path, features="mixture")

    def test_a_fitted_model_predicts(self):
        path, run = self.write("beds.csv", form_beds()), self.folder / "run"
        command("fit", path, "-o", run)
        model = clast.fit(path).model
        model.write(self.folder / "model.json")
        said = command("predict", "--flatness", 0.6, "--elongation", 0.7, "--model", run / "model.json")
        for given in (model, run / "model.json", self.folder / "model.json"):
            found = clast.predict(0.6, 0.7, model=given)
            self.same(found, said, ("porosity", "standard_error", "in_range", "leverage"))
        self.assertEqual(clast.predict(0.2, 0.7, model=model).out_of_range, tuple(
            one["feature"] for one in command("predict", "--flatness", 0.2, "--elongation", 0.7, "--model", run / "model.json")["out_of_range"]))

    def test_a_model_of_columns_predicts_beds(self):
        rng = np.random.default_rng(1)
        beds = {"friction": rng.uniform(0.1, 0.8, 20), "size": rng.uniform(1, 2, 20)}
        beds["porosity"] = 0.35 + 0.1 * beds["friction"] + 0.001 * rng.normal(size=20)
        path, run = self.write("beds.csv", beds), self.folder / "run"
        command("fit", path, "--features", "columns", "--n-term", 1, "-o", run)
        said = command("predict", path, "--model", run / "model.json")["beds"]
        model = clast.fit(beds, features="columns", n_term=1).model
        found = clast.predict_beds(path, model=model)
        self.assertEqual([list(found[name]) for name in ("porosity", "standard_error")],
                         [[bed[name] for bed in said] for name in ("porosity", "standard_error")])
        with self.assertRaisesRegex(clast.Error, "call predict_beds"):
            clast.predict(table=path, model=model)

    def test_predict_from_a_table_of_grains(self):
        rng = np.random.default_rng(2)
        grains = {"flatness": rng.uniform(0.5, 0.8, 100), "elongation": rng.uniform(0.5, 0.8, 100)}
        path = self.write("grains.csv", grains)
        for words, keys in ((("--grading", "U7"), dict(grading="U7")), (("--model", "single", "--resamples", 50, "--seed", 3),
                                                                         dict(model="single", resamples=50, seed=3))):
            said, found = command("predict", path, *words), clast.predict(table=grains, **keys)
            self.same(found, said, ("model", "kind", "source", "porosity", "standard_error", "in_range"))
            self.assertEqual(found.sampling_error, said["errors"]["sampling"])
            self.same(found.inputs, said["inputs"], ("n_grain", "flatness_mean", "equancy_deviation"))
        said = command("predict", path, "--each", "--grading", "B50")["beds"]
        found = clast.predict_beds(grains, grading="B50")
        self.assertEqual(list(found["porosity"]), [bed["porosity"] for bed in said])

    def test_predict_from_moments_as_texts(self):
        said = command("predict", "--flatness", "0.65+-0.17", "--elongation", "0.7 +/- 0.1", "--grains", 300)
        for pair in (("0.65+-0.17", "0.7 +/- 0.1"), ((0.65, 0.17), "0.7\u00b10.1")):
            self.same(clast.predict(*pair, grains=300), said, ("model", "porosity", "standard_error"))
        for bad, line in ((("0.65+-", 0.7), "flatness: '0.65.-' is no mean"), ((0.65, None), "elongation: is missing"),
                          (((0.6, 0.1), 0.7), "one has a deviation"), ((None, None), "give a table of grains")):
            with self.assertRaisesRegex(clast.Error, line):
                clast.predict(*bad)
        with self.assertRaisesRegex(clast.Error, "^grading: 'U2' is none of U1, U7, B50"):
            clast.predict(0.6, 0.7, grading="U2")

    def test_study(self):
        words = ("--run", "fill", "--argument", MENGER, "--vary", "spheres=5|9", "--vary", "strategy=random|largest")
        command("study", *words, "-o", self.folder / "one")
        told = []
        found = clast.study(run="fill", argument=MENGER, vary={"spheres": [5, 9], "strategy": ["random", "largest"]}, output=self.folder / "two",
                            progress=lambda *what: told.append(what))
        self.assertEqual((found.n_run, found.n_done, found.n_failed), (4, 4, 0))
        self.assertTrue(told)
        self.assertEqual((self.folder / "one/results.csv").read_bytes(), (self.folder / "two/results.csv").read_bytes())
        self.assertEqual(list(found.results["spheres"]), [5, 5, 9, 9])
        opened = clast.open(self.folder / "one")
        self.assertEqual((opened.command, opened.summary), ("study", {"n_run": 4, "n_done": 4, "n_failed": 0}))
        self.assertEqual(list(opened.table("results")["spheres"]), [5, 5, 9, 9])
        self.assertIn("n_done", opened._repr_html_())
        again = clast.study(run="fill", argument=MENGER, vary=["spheres=5|9", "strategy=random|largest"], output=self.folder / "two")
        self.assertEqual((again.n_before, again.n_done), (4, 0))
        table = self.folder / "runs.csv"
        table.write_text("sphere\n5\n")  # was looked at by no one, and all runs failed
        for keys, line in ((dict(run="fil"), "no command that a study can run; did you mean fill"), (dict(vary="sphere=5"), "did you mean 'spheres'"),
                           (dict(fix="spheres"), "^fix takes key=value"), (dict(table=table), "^clast fill has no key 'sphere'"), (dict(run="mesh check", seeds=2), "draws nothing at random"),
                           (dict(run="mesh hull"), "no numbers for a study"), (dict(run="completion"), "no numbers for a study"),
                           (dict(fix=["filled=0.8", "filled=0.9"]), "^fix: 'filled=0.8' and 'filled=0.9': filled takes one value")):
            with self.assertRaisesRegex(clast.Error, line):
                clast.study(**{**dict(run="fill", output=self.folder / "x"), **keys})

    def test_values_of_a_study_are_those_of_every_call(self):
        """A bare length was refused by every run, False was "False", and range(3, 5) one value."""
        fix = dict(core="sphere", core_size=270e-6, coat="sphere", size=[30e-6, "20um"], core_density=np.float64(2500), fall_speed=np.bool_(True), picture=False, mode=None)
        found = clast.study(run="aggregate", fix=fix, vary={"replicate": range(1, 3), "cone": np.array([0.1, 0.2])}, jobs="1", output=self.folder / "one")
        self.assertEqual((found.n_done, found.n_failed), (4, 0))
        one = clast.open(self.folder / "one/runs/000004/out")
        del fix["mode"]
        said = clast.aggregate(**fix, replicate=2, cone=0.2, output=self.folder / "said")
        self.assertEqual((one.summary["n_grain"], one.summary["d_agg"]), (said.n_grain, said.d_agg))
        for vary, line in (({"spheres": np.ma.MaskedArray([3, 4], mask=[0, 1])}, "^spheres: .*masked"), ({"spheres": [b"3"]}, "^spheres: a bytes"), ({"sphere": 3}, "did you mean 'spheres'"),
                           ({"spheres": []}, "^spheres: "), ({"spheres": [5, "5.0"]}, r"are the same \('5', '5.0'\)")):
            with self.assertRaisesRegex(clast.Error, line):
                clast.study(run="fill", argument=MENGER, vary=vary, output=self.folder / "x")

    def test_a_study_without_the_command_names_the_cure(self):
        env = {**os.environ, "CLAST": "", "PATH": "/nowhere"}
        code = "import clast; clast.study(run='fill', argument='x.stl', vary='spheres=1', output='x')"
        done = subprocess.run([sys.executable, "-c", code], env=env, stderr=subprocess.PIPE, text=True, cwd=self.folder)
        if not pathlib.Path(sys.executable).with_name("clast").exists():
            self.assertRegex(done.stderr.splitlines()[-1], "processes of the command clast, which is not on the PATH; install clast")
        other = self.folder / "clast"
        other.write_text("#!/bin/sh\necho clast 9.9.9\n")
        other.chmod(0o755)
        done = subprocess.run([sys.executable, "-c", code], env={**os.environ, "CLAST": str(other)}, stderr=subprocess.PIPE, text=True, cwd=self.folder)
        self.assertRegex(done.stderr.splitlines()[-1], "is version 9.9.9, this package is for")

    def test_an_interrupted_study_goes_on(self):
        keys = dict(run="pack", fix=["curve=4mm", "mass=40g", "width=30mm", "height=0.1m", "shaking_time=0s", "max_steps=60000"], seeds=3, jobs=1,
                    output=self.folder / "out")
        with self.assertRaises(KeyboardInterrupt):
            clast.study(**keys, progress=lambda phase, done, total: os.kill(os.getpid(), 2) if done >= 1 else None)
        first = clast.study(**keys)
        self.assertGreaterEqual(first.n_before, 1)
        self.assertEqual((first.n_before + first.n_done, first.n_failed), (3, 0))

    def test_a_run_that_does_not_converge_is_a_row(self):
        """results.csv was not written, and the study ended with an error for ever."""
        fix = ["mass=0.5g", "curve=4mm", "domain=cell", "width=18mm", "height=18mm", "floor=false", "gravity=0", "fluid_density=0"]
        table = self.folder / "runs.csv"
        table.write_text("stages,max_load_time\nhold until time 5ms,20\nisotropic 10kPa until rest,0.02\n")
        with self.assertWarnsRegex(UserWarning, "^1 of 2 runs did not converge"):
            found = clast.study(run="pack", fix=fix, table=table, output=self.folder / "out", jobs=1)
        self.assertEqual((found.n_done, found.n_failed, found.n_unconverged), (2, 0, 1))
        self.assertEqual(list(found.results["exit_code"]), [0, 5])
        self.assertTrue(np.isnan(found.results["n_grain"][1]))
        self.assertEqual(clast.open(self.folder / "out").summary, {"n_run": 2, "n_done": 2, "n_failed": 0})

    def test_a_study_begins_with_the_seed_of_its_configuration(self):
        """It was 1, without a word."""
        config = self.folder / "fill.yaml"
        config.write_text("strategy: random\nseed: 42\n")
        keys = dict(run="fill", argument=MENGER, config=config, vary="spheres=3", seeds=2)
        self.assertEqual(list(clast.study(**keys, output=self.folder / "one").plan["seed"]), [42, 43])
        self.assertEqual(list(clast.study(**keys, seed=1, output=self.folder / "two").plan["seed"]), [1, 2])
        for k, (text, seed) in enumerate((("{strategy: random, seed: 42}", 42), ("seed: 010", 10), ("seed: 0x10", 16), ("? seed\n: 7", 7))):
            config.write_text(text if k == 0 else text + "\nstrategy: random")  # were 1, 10, 0 and 1, and others for the command
            self.assertEqual(list(clast.study(**keys, output=self.folder / f"as-{k}").plan["seed"]), [seed, seed + 1])
            command("study", "--run", "fill", "--argument", MENGER, "--config", config, "--vary", "spheres=3", "--seeds", 2, "-o", self.folder / f"as-{k}")

    def test_a_study_without_an_answer_opens(self):
        """Stopped before its first run ended: its results have no exit code, and it could not be opened."""
        for name, text in (("study.json", "{}"), ("plan.csv", "run,seed\n1,1\n2,1\n"), ("results.csv", "run,seed\n1,1\n2,1\n")):
            (self.folder / name).write_text(text)
        self.assertEqual(clast.open(self.folder).summary, {"n_run": 2, "n_done": 0, "n_failed": 0})

    def test_a_run_that_fails_is_told(self):
        with self.assertWarnsRegex(UserWarning, "1 of 2 runs failed; the first says why in .*000002"):
            found = clast.study(run="fill", argument=MENGER, vary="volume_error = 0 | -1", fix="spheres=5", output=self.folder / "x")
        self.assertEqual((found.n_done, found.n_failed), (1, 1))

    def test_aggregate_fit(self):
        sizes = self.folder / "sizes.csv"
        sizes.write_text("d_um,count\n20,6\n30,3\n")
        words = ("aggregate", "--core", MENGER, "--core-size", "100um", "--accept-faults", "--coat", MENGER, "--sizes", sizes, "--fit",
                 "--fit-packing", "1deg:1:1", "--fit-packing", "90deg:2:2", "--fit-repeats", 2, "--fit-replicate-max", 2,
                 "--observed-size", "115um", "--observed-size-error", "40um")
        said = command(*words)
        found = clast.aggregate(core=MENGER, core_size="100um", accept_faults=True, coat=MENGER, sizes=sizes, fit=True,
                                fit_packing=["1deg:1:1", "90deg:2:2"], fit_repeats=2, fit_replicate_max=2, observed_size="115um",
                                observed_size_error="40um", output=self.folder / "run")
        self.assertEqual(found.values, said)
        self.assertEqual(found.verdict, "inside")
        self.assertTrue((self.folder / "run/fit.svg").exists())

    def test_resume(self):
        keys = dict(core="sphere", core_size=270e-6, coat="sphere", size="30um", replicate=2000)
        with self.assertRaises(KeyboardInterrupt):
            clast.aggregate(**keys, output=self.folder / "run", progress=lambda *_: os.kill(os.getpid(), 2))
        resumed = clast.aggregate(resume=self.folder / "run")
        self.assertEqual(resumed.n_grain, 2001)
        self.assertEqual(resumed.folder, str(self.folder / "run"))
        with self.assertRaisesRegex(clast.Error, "^resume: .* has every key; leave core out"):
            clast.aggregate(resume=self.folder / "run", core="sphere")

    def test_surfaces(self):
        out = self.folder / "out.ply"
        said, found = command("mesh", "repair", MENGER, "-o", out), clast.mesh_repair(MENGER)
        self.same(found, said["changes"], said["changes"])
        self.same(found.check, said, ("closed", "oriented", "manifold", "n_vertex", "n_triangle", "volume"))
        said, found = command("mesh", "hull", GRAIN, "-o", out), clast.mesh_hull(GRAIN)
        self.same(found, said, ("n_vertex", "n_triangle", "volume", "area", "hull_volume", "hull_area", "added_volume"))
        said, found = command("mesh", "simplify", GRAIN, "--faces", 100, "-o", out), clast.mesh_simplify(GRAIN, 100)
        self.same(found, said, ("n_triangle_before", "volume_before", "volume", "hausdorff", "mean_distance", "reached", "volume_drift"))
        self.assertEqual(len(found.mesh.triangles), said["n_triangle"])
        for words, keys in ((("--flatness", 0.6, "--size", 12), dict(flatness=0.6, size=12)), (("--unit-form",), dict(unit_form=True)),
                            (("--hull", 100), dict(hull=100))):
            said, found = command("mesh", "form", GRAIN, *words, "-o", out), clast.mesh_form(GRAIN, **keys)
            self.same(found, said, ("before", "after", "volume", "volume_hull", "n_triangle"))
        clast.mesh_convert(GRAIN, self.folder / "mm.ply", unit="mm")
        said = command("mesh", "form", self.folder / "mm.ply", "--size", "7mm", "-o", out)
        found = clast.mesh_form(self.folder / "mm.ply", size="7mm", output=self.folder / "py.ply")
        self.same(found, said, ("before", "after", "volume_before"))
        self.assertEqual((self.folder / "py.ply").read_bytes(), out.read_bytes())  # the unit, too
        self.assertRaisesRegex(clast.Error, "size: .*'%'", clast.mesh_form, self.folder / "mm.ply", size="50%")
        said = command("mesh", "synthesize", "--seed", 4, "--flatness", 0.5, "-o", out)["grains"][0]
        found = clast.mesh_synthesize(seed=4, flatness=0.5)
        self.same(found, said, ("flatness", "elongation", "angularity", "volume", "n_triangle"))
        command("mesh", "convert", GRAIN, "--unit", "mm", "-o", self.folder / "one.3mf")
        clast.mesh_convert(GRAIN, self.folder / "two.3mf", unit="mm")
        self.assertEqual((self.folder / "one.3mf").read_bytes(), (self.folder / "two.3mf").read_bytes())
        for call, line in ((lambda: clast.mesh_convert(GRAIN, "x.3mf"), "^unit: is missing; 3MF is in millimetres"),
                           (lambda: clast.mesh_convert(GRAIN, "x.doc"), "^output: x.doc is no surface format"),
                           (lambda: clast.mesh_convert(GRAIN, "x.ply", unit="parsec"), "^unknown unit 'parsec'"),
                           (lambda: clast.mesh_form(GRAIN, flatness=2), "^flatness: 2.0 lies outside 0 to 1"),
                           (lambda: clast.mesh_form(GRAIN, unit_form=True, size=3), "^unit_form: "),
                           (lambda: clast.mesh_simplify(GRAIN, "few"), "few")):
            with self.assertRaisesRegex(clast.Error, line):
                call()

    def test_a_box_without_positions(self):
        words = ("agglomerate", "--box-model", "--concentration", 2, "--constant", 1, "--duration", "1s", "--n-step", 2, "--repeats", 3, "--particles", 2000)
        said = command(*words, "--seed", 5)
        found = clast.box_model(concentration=2, constant=1, duration=1.0, n_step=2, repeats=3, particles=2000, seed=5)
        self.assertEqual(list(found.history["M0"]), said["n_particle"])
        self.assertEqual(list(found.history["M2_sd"]), said["moments_sd"]["M2"])
        self.assertEqual((list(found.history["exact_M0"]), found.n_section), (said["exact"]["n_particle"], said["n_section"]))
        self.assertEqual(found.spectrum.units["n"], "1/m^3")
        sizes = {"size": [1.0, 2.0], "number": [1.0, 0.5]}
        path = self.write("sizes.csv", sizes)
        said = command(*words[:2], "--initial", "table", "--initial-file", path, "--constant", 1, "--n-step", 2)
        self.assertEqual(list(clast.box_model(sizes=sizes, constant=1, n_step=2).history["M1"]), said["moments"]["M1"])
        before = clast.box_model(sizes=sizes, constant=1, n_step=2)  # whose spectrum was refused as a start
        self.assertAlmostEqual(clast.box_model(sizes=before.spectrum, constant=1, n_step=2).history["M0"][0], before.history["M0"][-1], places=9)
        for keys, line in ((dict(solver="sectional", particles=3), "^particles does nothing with this solver"), (dict(initial="table"), "^sizes: and"),
                           (dict(concentration=1, shear=3), "^shear does nothing with this kernel"),
                           (dict(sizes={"size": [1.0]}), "columns size and number"), (dict(concentratio=1), "did you mean concentration")):
            with self.assertRaisesRegex(clast.Error, line):
                clast.box_model(**keys)

    def test_a_kernel_beyond_its_range_warns(self):
        x = np.column_stack([[0.1, 0.5], [0.5, 0.5], [0.5, 0.5]])
        keys = dict(domain="box:0,0,0,1,1,1", kernel="settling", radius=[5e-4, 5e-6], viscosity=1.8e-5, density=1.2, particle_density=2500,
                    mean_free_path="66nm", efficiency=1, variant="test", n_step=1, duration=10.0, settling_law="stokes")
        with self.assertRaisesRegex(clast.Error, "Reynolds number of settling by Stokes' law"):
            clast.agglomerate(x, **keys)
        for idle, line in ((dict(shear=3), "^shear does nothing with this kernel"), (dict(dissipation=np.ones(2)), "^dissipation does nothing"),
                           (dict(asperity=1e-6), "^asperity does nothing with this sticking")):
            with self.assertRaisesRegex(clast.Error, line):
                clast.agglomerate(x, **keys, **idle)
        with self.assertWarnsRegex(UserWarning, "^kernel settling: Reynolds number .*; beyond lie 50 % of the particles"):
            clast.agglomerate(x, **keys, out_of_range="extrapolate")

    def test_what_the_command_warns_of(self):
        forms = {"flatness": [0.6, 0.7, -1.0, 0.65], "elongation": [0.7, 0.8, 0.7, 0.66]}
        with self.assertWarnsRegex(UserWarning, "^1 of 4 rows left out: 1 not positive .row 3") as caught:
            clast.predict(table=forms)
        self.assertEqual(caught.filename, __file__)
        with self.assertWarnsRegex(UserWarning, "^1 of 4 rows left out"):
            self.assertEqual(len(clast.predict_beds(forms)), 3)
        mesh = clast.Mesh.read(GRAIN)
        with self.assertWarnsRegex(UserWarning, "^the surface has 3 open edges; their holes were capped"):
            clast.fill(clast.Mesh(mesh.vertices, mesh.triangles[1:]), spheres=3, allow_open=True)
        with self.assertWarnsRegex(UserWarning, "^the surface: it cuts itself at .* pairs"):
            clast.fill(clast.Mesh(np.concatenate([mesh.vertices, mesh.vertices + 0.1]), np.concatenate([mesh.triangles, mesh.triangles + len(mesh.vertices)])),
                       spheres=3)
        with self.assertWarnsRegex(UserWarning, "points a bin .under 10.*compare mesh tree"):
            clast.decompose(np.random.default_rng(1).random((300, 2)) ** 2, domain="box:0,0,1,1", mesh="boxes")
        with self.assertLogs("clast", "INFO") as caught:
            clast.aggregate(core="sphere", core_size="270um", coat="sphere", size="100um", replicate=2, printable=True, output=self.folder / "run")
        self.assertIn("printable", caught.output[0])
        again = clast.aggregate(resume=self.folder / "run", printable=True)
        self.assertTrue(again.printable["resolved"])
        with self.assertRaisesRegex(clast.Error, "leave printable out"):
            clast.aggregate(resume=self.folder / "run", printable="no")  # a new body took the old one's place

    def said(self, *words):
        """What the command says on both streams, without its JSON."""
        done = subprocess.run([os.environ["CLAST"], *map(str, words)], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, cwd=self.folder, text=True)
        return " ".join(done.stdout.split())

    def test_warnings_are_those_of_the_command(self):
        """A reviewer found a dozen warnings of the command that Python kept to itself."""
        x = np.random.default_rng(0).random((300, 3))
        box = "box:0,0,0,1,1,1"
        small, points, sets = (self.write(f"{name}.csv", dict(zip("xyz", columns.T))) for name, columns in
                               (("small", x * 1e-3), ("points", x), ("sets", np.random.default_rng(2).random((500, 3)) ** 3)))
        pack = dict(curve="4mm", mass="5g", width="12mm", height="0.1m", shaking_time=1e-3)
        flags = [word for key, value in pack.items() for word in (f"--{key.replace('_', '-')}", f"{value}s" if isinstance(value, float) else value)]
        agglomerate, box_model = dict(constant=1e-4, duration=1.0, n_step=2), dict(concentration=1e12, constant=1e-12, duration=1.0, n_step=2,
                                                                                   initial="exponential", particles=50)
        tail = ("--constant", 1e-12, "--duration", "1s", "--n-step", 2, "--initial", "exponential", "--particles", 50)
        rows = {"flatness": [0.6, 0.7, -1.0, 0.65, 0.5], "elongation": [0.7, 0.8, 0.7, 0.66, 0.6]}
        beds = form_beds()
        beds["porosity"][4] = np.nan
        for use, words, lines in (
                (lambda: clast.decompose(x * 1e-3, domain=box), ("decompose", small, "--domain", box),
                 ["all points lie within 999.2 um, the domain is 1 m wide; are both in the same unit?"]),
                (lambda: clast.agglomerate(x * 1e-3, domain=box, **agglomerate),
                 ("agglomerate", small, "--domain", box, "--constant", 1e-4, "--duration", "1s", "--n-step", 2),
                 ["all points lie within 999.2 um, the domain is 1 m wide", "in 1 of 1 snapshot the particles did not show their own structure"]),
                (lambda: clast.pack(**pack), ("pack", *flags), ["the bed was level and still moves: its fastest grain is not below still_speed",
                                                                 "shaking ended while grains fell: the highest sank by"]),
                (lambda: clast.box_model(**box_model), ("agglomerate", "--box-model", "--concentration", 1e12, *tail),
                 ["the particles drawn hold 96.86 % of the mass and 89.3 % of M2 of their law at the start"]),
                (lambda: clast.grain_statistics(rows, resamples=10), ("shape", self.write("rows.csv", rows), "--statistics", "s"),
                 ["1 of 5 rows left out: 1 not positive (row 3)"]),
                (lambda: clast.shapes(self.folder / "rows.csv"), ("shape", "rows.csv"), ["1 of 5 rows left out: 1 not positive (row 3)"]),
                (lambda: clast.fit(beds, n_permutation=0), ("fit", self.write("beds.csv", beds), "--n-permutation", 0),
                 ["1 of 63 rows left out (first: row 5, "])):
            told = self.said(*words)
            for line in lines:
                self.assertIn(line, told)
            with warnings.catch_warnings(record=True) as caught:
                warnings.simplefilter("always")
                use()
            heard = [str(one.message) for one in caught]
            self.assertEqual(len(heard), len(lines), heard)
            for line, one in zip(lines, heard):
                self.assertIn(line, one)

    def test_a_model_of_columns_tells_the_beds_it_left_out(self):
        k = np.arange(40.0)
        beds = {"x": k, "y": np.sin(k), "porosity": 0.3 + 0.001 * k + 0.01 * np.sin(k * k)}
        model = clast.fit(beds, features="columns", n_term=1, n_permutation=0).model
        with self.assertWarnsRegex(UserWarning, "^1 of 2 rows left out: missing or infinite"):
            clast.predict_beds({"x": [1.0, np.nan], "y": [1.0, np.nan]}, model=model)

    def test_pairs_and_cells_that_disagree_are_told(self):
        """Points that keep apart: g(r) does not fall from r = 0, and pairs find no structure."""
        x = (np.mgrid[:8, :8, :8].reshape(3, -1).T + 0.5 + 0.2 * np.random.default_rng(1).random((512, 3))) / 9
        path, box = self.write("even.csv", dict(zip("xyz", x.T))), "box:0,0,0,1,1,1"
        line = re.search("warning: (events by pairs|g\\(r\\) is not).*?:", self.said("decompose", path, "--domain", box, "--pairs"))[0][9:]
        with self.assertWarnsRegex(UserWarning, f"^{re.escape(line[:12])}"):
            clast.decompose(x, domain=box, pairs=True)
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            clast.decompose(x, domain=box)

    def test_what_surfaces_lose_is_told(self):
        path = self.folder / "curve.obj"
        path.write_text("v 0 0 0\nv 2 0 0\nv 0.5 0.5 1\nv 0 2 0\nf 1 2 3 4\ncurv 1 2\n")
        with self.assertWarnsRegex(UserWarning, "^.*curve.obj: .*passed over") as caught:
            clast.Mesh.read(path)
        self.assertEqual(caught.filename, __file__)
        grain = clast.Mesh.read(GRAIN)
        far = clast.Mesh(grain.vertices + 1e4, grain.triangles)
        far.write(self.folder / "far.ply")
        told = self.said("mesh", "convert", "far.ply", "-o", "far.stl")
        for given in (far, self.folder / "far.ply"):
            with warnings.catch_warnings(record=True) as caught:
                warnings.simplefilter("always")
                clast.mesh_convert(given, self.folder / "far2.stl")
            self.assertEqual([str(one.message)[:20] for one in caught][:1], ["STL keeps 24 bits: c"])
            for one in caught:
                self.assertIn(str(one.message), told)
        touching = clast.Mesh(np.concatenate([grain.vertices, grain.vertices + [100, 0, 0]]), np.concatenate([grain.triangles, grain.triangles + len(grain.vertices)]))
        touching.vertices[len(grain.vertices)] = touching.vertices[0]
        one_corner = touching.triangles.copy()
        one_corner[one_corner == len(grain.vertices)] = 0
        with self.assertWarnsRegex(UserWarning, "^an STL cannot keep 1 doubled vert.* apart; write .ply, .obj or .off"):
            clast.mesh_repair(clast.Mesh(touching.vertices, one_corner), split=True, output=self.folder / "two.stl")
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            clast.mesh_hull(path)
        self.assertEqual(len(caught), 1)  # the file is read once

    def test_a_medium_is_one_number_or_one_a_particle(self):
        x = np.random.default_rng(1).random((50, 3)) * 1e-4
        keys = dict(domain="box:0,0,0,1e-4,1e-4,1e-4", kernel="brownian", radius=np.full(50, 1e-6), duration="100s", n_step=2)
        made = [list(clast.agglomerate(x, **keys, temperature=t).history["n_particle"]) for t in (300, "300 K", np.full(50, 300.0))]
        self.assertEqual(made[0], made[2])
        self.assertEqual(made[0], made[1])
        self.assertLess(made[0][-1], 50)
        two = [list(clast.agglomerate(x, x, **keys, temperature=t).history["n_particle"]) for t in (300, np.full(50, 300.0), np.full((2, 50), 300.0))]
        self.assertEqual(two[0], two[1])
        self.assertEqual(two[0], two[2])
        hot = clast.agglomerate(x, x, **keys, temperature=np.outer([300, 900], np.ones(50))).history["n_particle"]
        self.assertEqual(list(hot[:3]), two[0][:3])
        self.assertNotEqual(list(hot), two[0])
        with self.assertRaisesRegex(clast.Error, "^temperature: 3 rows where there are 2 snapshots"):
            clast.agglomerate(x, x, **keys, temperature=np.ones((3, 50)))

    def test_shapes_of_many_files(self):
        files = sorted((ROOT / "data/standin63").glob("*.ply"))[:12] + [ROOT / "README.md"]
        words = ("shape", *files, "--axes", "box", "--unit", "mm", "--statistics", self.folder / "one", "--resamples", 100)
        said = command(*words, "-o", self.folder / "one.csv", code=3)
        found = clast.shapes(*files, axes="box", unit="mm")
        self.assertEqual((len(found), found.unit), (12, said["unit"]))
        self.assertEqual(list(found.faults), [one["text"] for one in said["faults"]])
        found.table.write(self.folder / "two.csv")
        self.assertEqual((self.folder / "one.csv").read_bytes(), (self.folder / "two.csv").read_bytes())
        statistics, wanted = found.statistics(resamples=100), said["statistics"]
        self.assertEqual((statistics.n, statistics.zingg), (wanted["n"], wanted["zingg"]))
        for k, one in enumerate(wanted["columns"]):
            row = statistics.columns[k]
            self.assertEqual([row["name"], row["mean"], row["mean_low"], row["deviation_high"], row["q25"], row["shapiro_p"]],
                             [one["name"], one["mean"]["value"], one["mean"]["low"], one["deviation"]["high"], one["quantiles"]["q25"], one["shapiro_p"]])
        self.assertEqual(list(statistics.explained), [one["explained"] for one in wanted["pca"]])
        self.assertEqual(statistics.correlation[0].tolist(), wanted["correlation"]["r"][0])
        statistics.write(self.folder / "two")
        self.assertEqual((self.folder / "one/pca.csv").read_bytes(), (self.folder / "two/pca.csv").read_bytes())
        self.assertIn("data:image/svg", statistics._repr_html_())

    def test_shapes_in_several_units(self):
        """The first file decided: "model" or "m" by the order."""
        for name, text in (("ratios", "flatness,elongation\n0.5,0.8\n"), ("mm", "L_mm,I_mm,S_mm\n30,20,10\n"), ("um", "L_um,I_um,S_um\n30000,20000,10000\n"),
                           ("bare", "L,I,S\n3,2,1\n")):
            (self.folder / f"{name}.csv").write_text(text)
        ratios, mm, um, bare = (self.folder / f"{name}.csv" for name in ("ratios", "mm", "um", "bare"))
        for files in ((ratios, mm, um), (mm, um, ratios)):
            found = clast.shapes(*files)
            self.assertEqual(found.unit, "m")
            np.testing.assert_allclose(found.table["L_m"][np.isfinite(found.table["L_m"])], 0.03)
        self.assertEqual(clast.shapes(mm, um, bare, unit="cm").unit, "m")
        for files, keys, line in (((mm, um, bare), {}, "bare.csv:1 says none: give that with unit$"), ((mm,), dict(unit="cm"), "leave out unit$")):
            with self.assertRaisesRegex(clast.Error, line):
                clast.shapes(*files, **keys)
        columns = {"L_mm": [30.0, 45.0], "I (cm)": [2.0, 4.1], "S_um": [10000.0, 12000.0]}  # names tell the unit, as in a file
        self.assertAlmostEqual(clast.grain_statistics(columns, resamples=0).columns["mean"][1], (2 / 3 + 41 / 45) / 2)

    def test_shapes_of_voxels(self):
        x = np.mgrid[:20, :20, :20]
        labels = np.zeros((20, 20, 20), ">u2")
        labels[((x - 9.5) ** 2).sum(axis=0) < 64] = 3
        path = self.folder / "labels.raw"
        path.write_bytes(b"head" + labels.tobytes())
        said = command("shape", path, "--kind", "voxels", "--voxels", "20,20,20", "--voxel-type", "u16", "--big-endian", "--skip", 4, "--voxel-edge", "2")
        found = clast.shapes(path, kind="voxels", voxels=(20, 20, 20), voxel_type="u16", big_endian=True, skip=4, voxel_edge=2)
        self.assertEqual([found.table["volume"][0], found.table["L"][0]], [said["grains"][0]["volume"], said["grains"][0]["L"]])
        for keys, line in ((dict(voxels="20,20"), "^voxels: '20,20' is not 3 numbers"), (dict(voxels=(20, 20, 2.5)), "^voxels: .* are not sizes"),
                           (dict(voxel_edge=-1), "^voxel_edge: "), (dict(kind="voxel"), "^kind: 'voxel' is none of .*did you mean voxels"),
                           (dict(unit="miles"), "miles")):
            with self.assertRaisesRegex(clast.Error, line):
                clast.shapes(path, **keys)
        with self.assertRaisesRegex(clast.Error, "^files: none"):
            clast.shapes()

    def test_grading(self):
        said, found = command("grading", "U3", "--mass", "1kg"), clast.Grading("U3")
        self.assertEqual([list(found.range), found.mean_cube, found.n_expected(1.0)], [[said["low"], said["high"]], said["mean_cube"], said["n_expected"]])
        for name in ("low", "high", "mean", "mass", "number"):
            self.assertEqual(list(found.classes[name]), [row[name] for row in said["classes"]])
        self.assertEqual(len(clast.Grading("uniform:1mm,2mm").classes), 0)

    def test_export(self):
        run = self.folder / "run"
        clast.aggregate(core="sphere", core_size=270e-6, coat="sphere", size="30um", replicate=20, output=run)
        for name, words, keys in (("a.stl", (), {}), ("b.ply", ("--colour", "size", "--level", 1), dict(colour="size", level=1)),
                                  ("c.vtu", ("--points",), dict(points=True)), ("d.3mf", (), {}), ("e.obj", ("--unit", "um"), dict(unit="um"))):
            said = command("export", run, "-o", self.folder / name, *words)
            told = clast.export(run, self.folder / ("own_" + name), **keys)
            self.same(told, said, ("format", "unit", "n_grain", "n_vertex", "n_triangle"))
            self.assertEqual((self.folder / name).read_bytes(), (self.folder / ("own_" + name)).read_bytes())
        command("export", run, "--table", "history", "-o", self.folder / "history.csv")
        clast.export(run, self.folder / "own.csv", table="history")
        self.assertEqual((self.folder / "history.csv").read_bytes(), (self.folder / "own.csv").read_bytes())


class Notebooks(unittest.TestCase):
    """What _repr_html_ shows: key numbers, a picture as data, the 3-D view in a frame; nothing of a file's becomes markup."""

    EVIL = "</script><img src=x onerror=alert(1)>"

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def frame_of(self, shown):
        return html.unescape(re.search(r'<iframe [^>]*srcdoc="([^"]*)"', shown)[1])

    def test_a_run(self):
        evil = self.folder / "<b>run"
        result = clast.aggregate(core="sphere", core_size=270e-6, coat="sphere", size="30um", replicate=20, output=evil)
        for shown in (result._repr_html_(), clast.open(evil)._repr_html_()):
            self.assertIn("<th>density</th>", shown)
            self.assertIn("SI units", shown)
            self.assertTrue(re.search(r'srcdoc="([^"]*)"', shown)[1].isascii())  # a page of another encoding showed "Âµm"
            picture = re.search(r'src="data:image/png;base64,([^"]*)"', shown)[1]
            self.assertEqual(base64.b64decode(picture), (evil / "picture.png").read_bytes())
            page = self.frame_of(shown)
            self.assertIn('"n_grain": 21, "n_shown": 21', page)
            self.assertIn("Content-Security-Policy", page)
            self.assertIn("&lt;b&gt;run", page)
            for text in (shown, page):
                self.assertNotIn("<b>", text)
        self.assertIn('sandbox="allow-scripts"', shown)
        grains = result.run.grains
        self.assertIn("data:image/png;base64,iVBOR", grains._repr_html_())
        grains.view().write(self.folder / "view.html")
        self.assertIn("</html>", (self.folder / "view.html").read_text())

    def test_names_and_values_are_escaped(self):
        table = clast.predict_beds({"flatness": [0.6], "elongation": [0.7]})
        made = clast.fit({self.EVIL: np.arange(20.0), "porosity": 0.3 + 0.01 * np.arange(20) + 0.001 * np.sin(np.arange(20))},
                         features="columns", n_term=1, name=self.EVIL, n_permutation=0)
        for shown in (made._repr_html_(), clast.Result({self.EVIL: self.EVIL}, None)._repr_html_(), clast.View(self.EVIL.encode(), self.EVIL)._repr_html_()):
            self.assertNotIn("<img src=x", shown)
            self.assertNotIn("</script>", shown)
            self.assertIn("&lt;/script&gt;", shown)
        self.assertIn("data:image/svg+xml;base64,", made._repr_html_())
        self.assertIn("0.343238", table._repr_html_())

    def test_a_decomposition_shows_its_points(self):
        x = np.random.default_rng(1).random((200, 2))
        shown = clast.decompose(x, domain="box:0,0,1,1")._repr_html_()
        picture = base64.b64decode(re.search(r'base64,([^"]*)"', shown)[1])
        self.assertIn(b"<svg", picture)

    def test_a_result_whose_folder_is_gone_still_shows(self):
        self.assertIn("<th>x</th>", clast.Result({"x": 1}, str(self.folder / "gone"))._repr_html_())
        with self.assertRaisesRegex(clast.Error, "^run: no folder was written"):
            clast.Result({"x": 1}, None).run


class Clouds(unittest.TestCase):
    def setUp(self):
        self.path = ROOT / "data/d2sd/points_b3_n500.csv"
        self.x = np.loadtxt(self.path, delimiter=",", skiprows=1)
        self.box = "box:0,0,0,1,1,1"

    def test_a_cloud_is_what_its_arrays_are(self):
        cloud = clast.Cloud(self.x, weight=np.full(500, 2.0), domain=self.box)
        self.assertIs(cloud.positions, self.x)
        self.assertEqual(len(cloud), 500)
        said = clast.decompose(self.x, weight=np.full(500, 2.0), domain=self.box)
        self.assertEqual(cloud.decompose().pair_integral, said.pair_integral)
        keys = dict(kernel="constant", constant=0.01, duration=10.0, n_step=4, seed=3)
        self.assertTrue(np.array_equal(cloud.agglomerate(**keys).history, clast.agglomerate(self.x, weight=cloud.weight, domain=self.box,
                                                                                            **keys).history, equal_nan=False))
        self.assertEqual(clast.Cloud(np.repeat(self.x, 2, axis=0)).n_repeated, 500)
        for use, line in ((lambda: cloud.mass, "this cloud has no mass"), (lambda: cloud.colour, "colour")):
            with self.assertRaisesRegex(AttributeError, line):
                use()
        for use, line in ((lambda: clast.Cloud(self.x).decompose(), "^domain: is missing"), (lambda: clast.Cloud(self.x, mass=[1.0]), "^mass: 1 rows"),
                          (lambda: clast.decompose(cloud, mass=np.ones(500), domain=self.box), "^mass: the cloud has its own columns")):
            with self.assertRaisesRegex(clast.Error, line):
                use()

    def test_a_file_is_read_as_the_command_reads_it(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "points.csv")
            path.write_text("px_mm,py_mm,pz_mm,d_um,w\n" + "\n".join(",".join(map(repr, [*row.tolist(), 30.0, 2.0])) for row in self.x))
            words = ("--columns", "px_mm,py_mm,pz_mm", "--diameter-column", "d_um", "--weight-column", "w", "--domain", "box:0,0,0,1mm,1mm,1mm")
            said = command("decompose", path, *words)
            cloud = clast.Cloud.read(path, columns="px_mm,py_mm,pz_mm", diameter_column="d_um", weight_column="w")
            self.assertLess(cloud.positions.max(), 1e-3)
            self.assertAlmostEqual(cloud.radius[0], 15e-6, delta=1e-19)
            found = cloud.decompose(domain="box:0,0,0,1mm,1mm,1mm")
            self.assertEqual((found.pair_integral, found.n_cell), (said["pair_integral"], said["n_cell"]))
            with self.assertRaisesRegex(clast.Error, "no column"):
                clast.Cloud.read(path)


    def test_parts_of_a_cloud_are_those_of_the_command(self):
        with tempfile.TemporaryDirectory() as folder:
            words = ("decompose", self.path, "--domain", self.box, "--sizes", 4, "--regular", 5, "--beta-dt", "1e-4", "--seed", 3)
            command(*words, "-o", pathlib.Path(folder, "out"))
            want = clast.read_table(pathlib.Path(folder, "out/events_by_n.csv"))
        found = clast.decompose(self.x, domain=self.box, sizes=4, regular=5, beta_dt=1e-4, seed=3).sizes
        self.assertEqual((found.columns, list(found["n"])), (want.columns, [62, 125, 250, 500]))
        for name in found.columns:
            np.testing.assert_array_equal(found[name], want[name])
        self.assertIsNone(clast.decompose(self.x, domain=self.box).sizes)
        for keys, line in ((dict(sizes=8), "^sizes: 8 of 500 points end below 5"), (dict(sizes=41), "^sizes: 41"),
                           (dict(sizes=2, weight=np.ones(500)), "^sizes: takes parts of equal points")):
            with self.assertRaisesRegex(clast.Error, line):
                clast.decompose(self.x, domain=self.box, **keys)

    def test_the_tests_alone(self):
        found = clast.decompose(self.x, domain=self.box, test_only=True)
        self.assertEqual((found.reject, found.n_cell, len(found.tests)), (True, 1, 5))
        # one cell says nothing of the events of a cloud just rejected: they were those of a uniform one
        for found in (found, clast.decompose(self.x, domain=self.box, variant="test")):
            for name in ("events", "events_low", "events_cross", "pair_integral", "pair_integral_high", "pair_integral_cross", "points_needed"):
                self.assertTrue(math.isnan(getattr(found, name)), name)
            self.assertEqual((found.resolved, found.keeps_apart, np.isnan(found.cells["events"]).all()), (False, False, True))


class Tables(unittest.TestCase):
    def test_a_table_is_an_array_and_a_data_frame(self):
        table = clast.predict_beds({"flatness": [0.6, 0.7], "elongation": [0.7, 0.8]})
        self.assertIsInstance(table, np.ndarray)
        self.assertIs(type(table["porosity"]), np.ndarray)
        self.assertEqual(table[table["porosity"] > 0].columns, ("row", "porosity", "standard_error", "in_range"))
        try:
            import pandas
        except ImportError:
            with self.assertRaisesRegex(clast.Error, "^to_pandas: pandas is not installed"):
                table.to_pandas()
            return
        frame = table.to_pandas()
        self.assertIsInstance(frame, pandas.DataFrame)
        self.assertEqual(list(frame["porosity"]), list(table["porosity"]))
        again = clast.predict_beds(pandas.DataFrame({"flatness": [0.6, 0.7], "elongation": [0.7, 0.8]}))
        self.assertEqual(list(again["porosity"]), list(table["porosity"]))

    def test_what_comes_from_a_file_goes_back_the_same(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "t.csv")
            path.write_text('name,d_um,share\n"a, <b>",1.5,0.25\nc,2,\n')
            table = clast.read_table(path)
            self.assertEqual((table.columns, table.units["d_um"], table["d_um"].sum()), (("name", "d_um", "share"), "um", 3.5))
            table.write(pathlib.Path(folder, "again.csv"))
            self.assertEqual(pathlib.Path(folder, "again.csv").read_text(), path.read_text())
            again = pickle.loads(pickle.dumps(table))
            self.assertEqual((type(again), again.units, again.columns), (clast.Table, table.units, table.columns))
            self.assertEqual(again.tobytes(), table.tobytes())
            self.assertEqual(copy.deepcopy(table[:1]).units, table.units)
            self.assertIn("a, &lt;b&gt;", table._repr_html_())
            self.assertNotIn("<b>", table._repr_html_())

    def test_what_is_no_table_is_refused_by_name(self):
        for bad, line in ((3, "a int where"), ({}, "no column"), ({"x": [1, 2], "y": [1]}, "columns of 1 and 2 rows"),
                          ({"x": np.zeros((2, 2))}, "column x of shape"), ({"x": np.zeros(2, complex)}, "complex128")):
            with self.assertRaisesRegex(clast.Error, f"^table: .*{line}"):
                clast.predict_beds(bad)


if __name__ == "__main__":
    unittest.main()
