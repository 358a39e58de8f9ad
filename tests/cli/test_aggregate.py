"""clast aggregate: does it do what its help says, and does it refuse what it must?"""
import csv
import json
import math
import os
import re
import signal
import subprocess
import time
import unittest

from clitest import CLAST, ROOT, Case, clast

# Pictures are slow under sanitizers; test_render looks at them.
QUICK = ("--picture=false",)
SPHERES = ("aggregate", "--core", "sphere", "--core-size", "10um", "--coat", "sphere", "--size", "5um")
CLUSTER = ("aggregate", "--mode", "cluster", "--coat", "sphere", "--size", "1um", "--replicate", 8)
CUBE = """OFF
8 6 0
0 0 0
1 0 0
1 1 0
0 1 0
0 0 1
1 0 1
1 1 1
0 1 1
4 0 3 2 1
4 4 5 6 7
4 0 1 5 4
4 1 2 6 5
4 2 3 7 6
4 3 0 4 7
"""


class Results(Case):
    def test_tangent_spheres_have_the_known_porosity(self):
        for q, phi in ((1, 0.2), (2, 4 / 31), (5, 25 / 781), (10, 100 / 11111)):
            result = clast("aggregate", "--core", "sphere", "--core-size", f"{q}um", "--coat", "sphere",
                           "--size", "1um", "--json")
            self.assertEqual(result.code, 0, result.err)
            self.assertAlmostEqual(result.json["porosity"]["surface_hull"], phi, delta=1e-6)

    def test_json_has_the_promised_keys(self):
        found = clast(*SPHERES, "--replicate", 5, "--repeats", 3, "--envelope", "surface_hull",
                      "--envelope", "enclosing_sphere", "--json").json
        for key in ("n_grain", "solid_sum", "solid_union", "envelope", "porosity", "d_agg", "density",
                    "radius_of_gyration", "max_overlap", "repeats", "wall_s", "contact_s", "envelope_s"):
            self.assertIn(key, found)
        self.assertEqual(found["n_grain"], 6)
        self.assertEqual(len(found["repeats"]), 3)
        self.assertEqual(set(found["porosity"]), {"surface_hull", "enclosing_sphere"})
        middle = found["interval"]["porosity"]["surface_hull"]
        self.assertLess(middle["low"], middle["mean"])
        self.assertLess(middle["mean"], middle["high"])

    def test_fall_speed_has_a_row_each_time_and_ends_as_the_result(self):
        """Surfaces of flat faces: the last row measures the hull that the result has."""
        (self.folder / "cube.off").write_text(CUBE)
        words = ("aggregate", "--core", self.folder / "cube.off", "--core-size", "270um", "--coat", self.folder / "cube.off", "--unit", "um", "--size", "60um",
                 "--replicate", 6, *QUICK)
        found = clast(*words, "--fall-speed", "--json", "-o", self.folder / "run").json
        with open(self.folder / "run/history.csv", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        speed = [float(row["settling_velocity_m/s"]) for row in rows]
        self.assertEqual(len(speed), 7)
        self.assertAlmostEqual(speed[-1] / found["settling_velocity"], 1.0, places=12)
        self.assertEqual(clast(*words, "-o", self.folder / "plain").code, 0)
        with open(self.folder / "plain/history.csv", encoding="utf-8") as file:
            self.assertNotIn("settling", file.readline())

    def test_approach_is_a_key_and_refuses_what_it_does_not_ask(self):
        """Central rays on a sphere all end at one distance; lines over the cross-section and walks make looser aggregates."""
        file = self.folder / "walk.yaml"
        file.write_text("core: sphere\ncore_size: 1 um\ncoat: [sphere]\nsize: [1 um]\nreplicate: 300\napproach: diffusive\n")
        porosity = []
        for name in ("central", "ballistic", "diffusive"):
            found = clast("aggregate", file, "--approach", name, "--json").json
            self.assertLess(found["max_overlap"], 1e-18)
            porosity.append(found["porosity"]["surface_hull"])
        self.assertEqual(clast("aggregate", file, "--json").json["porosity"]["surface_hull"], porosity[2])
        self.assertTrue(porosity[0] < porosity[1] < porosity[2])
        refused = clast("aggregate", file, "--rays", 2)
        self.assertEqual(refused.code, 2)
        self.assertIn("approach: diffusive makes one walk a particle; leave out rays, orientations", refused.err)
        refused = clast("aggregate", file, "--approach", "ballistic", "--contact", "march")
        self.assertIn("the published march is central only", refused.err)

    def test_a_permeable_coat_settles_faster_and_says_when_it_cannot(self):
        grains = ("aggregate", "--core", "sphere", "--core-size", "1um", "--coat", "sphere", "--size", "1um", "--replicate", 300)
        found = clast(*grains, "--json").json
        self.assertGreater(found["settling_velocity_permeable"], found["settling_velocity"])
        self.assertAlmostEqual(found["settling_velocity"] / found["settling_velocity_permeable"], found["drag_permeable"], places=2)
        self.assertAlmostEqual(found["coat_grain"], 1e-6, places=12)
        self.assertRegex(clast(*grains).out, r"settling, permeable coat +1.9\d+ mm/s")
        found = clast(*grains, "--permeability", "kozeny_carman", "--json").json
        self.assertIsNone(found["settling_velocity_permeable"])
        self.assertEqual(found["repeats"][0]["permeable"], "the coat's porosity is outside of the law of permeability")

    def test_clusters_of_clusters_have_no_dimension_by_growth(self):
        """Their grains are in no order of growth: the row said -29.9."""
        run = self.folder / "clusters"
        result = clast("aggregate", "--mode", "cluster", "--coat", "sphere", "--size", "1um", "--replicate", 200,
                       "--approach", "ballistic", "--envelope-every", 1000, "-o", run, *QUICK)
        self.assertEqual(result.code, 0, result.err)
        text = (run / "structure.csv").read_text()
        self.assertNotIn("fractal_growth", text)
        self.assertIn("fractal_correlation", text)

    def test_the_folder_holds_the_run(self):
        run = self.folder / "run"
        result = clast(*SPHERES, "--replicate", 20, "--repeats", 2, "-o", run, "--printable", *QUICK)
        self.assertEqual(result.code, 0, result.err)
        self.assertIn("porosity, surface_hull", result.out)
        names = {path.name for path in run.iterdir()}
        self.assertLessEqual({"state.h5", "state-0002.h5", "history.csv", "history_band.csv", "summary.json",
                              "aggregate.stl", "manifest.json", "printable.stl", "structure.csv", "radial.csv",
                              "history.svg"}, names)
        self.assertEqual(clast("mesh", "check", run / "printable.stl").code, 0)
        with open(run / "history.csv", newline="") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual(len(rows), 2 * 21)
        summary = json.loads((run / "summary.json").read_text())
        ends = [float(row["porosity_surface_hull"]) for row in rows if row["n"] == "20"]
        self.assertAlmostEqual(sum(ends) / 2, summary["porosity"]["surface_hull"], delta=2e-3)
        manifest = json.loads((run / "manifest.json").read_text())
        self.assertEqual(manifest["outcome"], "done")
        self.assertEqual(manifest["config"]["core"], "sphere")

        self.assertEqual(manifest["command_line"][1:4], ["aggregate", "--core", "sphere"])
        self.assertIn("--printable", manifest["command_line"])
        with open(run / "sizes.csv", newline="") as file:
            (row,) = csv.DictReader(file)
        self.assertEqual((row["wanted"], row["placed"]), ("20", "20"))
        printable = json.loads((run / "printable.json").read_text())
        self.assertTrue(printable["resolved"])
        self.assertEqual((run / "printable.stl").stat().st_size, 84 + 50 * printable["n_triangle"])

    def test_a_bin_of_sizes_has_its_low_end_first(self):
        """low 40, high 30 were swapped without a word; phi falls with the size."""
        listed = self.folder / "sizes.csv"
        words = ["aggregate", "--core", "sphere", "--core-size", "100um", "--coat", "sphere", "--sizes", listed, "--no-picture"]
        listed.write_text("low_um,high_um,count\n40,30,5\n")
        self.assert_fails(3, *words, says=["sizes.csv:2", "low, 40 um, is above high, 30 um"])
        listed.write_text("low_phi,high_phi,count\n5.1,4.6,2\n")
        self.assertEqual(clast(*words, "-q").code, 0)

    def test_the_chart_of_sizes_knows_no_order_of_the_list(self):
        charts = []
        for name, sizes in (("mixed", (30, 50, 40, 30, 50, 40)), ("sorted", (30, 30, 40, 40, 50, 50))):
            listed = self.folder / f"{name}.csv"
            listed.write_text("size_um\n" + "".join(f"{size}\n" for size in sizes))
            result = clast("aggregate", "--core", "sphere", "--core-size", "100um", "--coat", "sphere", "--sizes",
                           listed, "-o", self.folder / name, *QUICK)
            self.assertEqual(result.code, 0, result.err)
            charts.append((self.folder / name / "sizes.svg").read_text())
        self.assertEqual(charts[0], charts[1])

    def test_an_earlier_run_is_not_overwritten(self):
        run = self.folder / "run"
        command = (*SPHERES, "--no-picture", "-o", run)
        self.assertEqual(clast(*command, "--repeats", 2).code, 0)
        self.assertFalse((run / "picture.png").exists())
        (run / "notes.txt").write_text("mine")
        before = (run / "manifest.json").read_bytes()
        self.assert_fails(2, *command, says=("finished run", "--force"))
        self.assertEqual((run / "manifest.json").read_bytes(), before)
        self.assertEqual(clast(*command, "--force").code, 0)
        names = {path.name for path in run.iterdir()}
        self.assertNotIn("state-0002.h5", names)
        self.assertNotIn("history_band.csv", names)
        self.assertIn("notes.txt", names)
        forced = (run / "state.h5").read_bytes()
        self.assertEqual(clast(*SPHERES, "--no-picture", "-o", self.folder / "other").code, 0)
        self.assertEqual((self.folder / "other/state.h5").read_bytes(), forced)

    def test_switches_turn_off(self):
        self.assert_fails(2, *SPHERES, "--no-picture=true", says=("no value",))
        self.assert_fails(2, *SPHERES, "--no-core", says=("unknown option",))
        self.assertIn("--[no-]picture", clast("aggregate", "--help-all").out)

    def test_a_run_is_a_core_and_a_coating(self):
        run = self.folder / "run"
        self.assertEqual(clast(*SPHERES, "--replicate", 4, "-o", run, *QUICK).code, 0)
        state = run / "state.h5"
        on_core = clast("aggregate", "--core", state, "--coat", "sphere", "--size", "2um", "--replicate", 3,
                        "--json")
        self.assertEqual(on_core.code, 0, on_core.err)
        self.assertEqual(on_core.json["n_grain"], 5 + 3)
        thrown = clast("aggregate", "--core", "sphere", "--core-size", "20um", "--coat", state, "--size",
                       "10um", "--replicate", 3, "--json")
        self.assertEqual(thrown.code, 0, thrown.err)
        self.assertEqual(thrown.json["n_grain"], 1 + 3 * 5)
        self.assertLess(thrown.json["max_overlap"], 1e-15)

    def test_clusters_merge_to_one(self):
        found = clast("aggregate", "--mode", "cluster", "--coat", "sphere", "--size", "1um", "--replicate", 64,
                      "--json").json
        self.assertEqual(found["n_grain"], 64)
        self.assertEqual(found["repeats"][0]["n_cluster"], 1)
        self.assertEqual(found["repeats"][0]["n_contact"], 63)
        self.assertLess(found["max_overlap"], 1e-15)

    def test_surfaces_touch_exactly(self):
        cube = self.folder / "cube.off"
        cube.write_text(CUBE)
        found = clast("aggregate", "--core", cube, "--core-size", "10um", "--coat", cube, "--size", "6um",
                      "--replicate", 10, "--rays", 3, "--orientations", 3, "--cone", "40deg", "--json").json
        self.assertEqual(found["n_grain"], 11)
        self.assertLess(found["max_overlap"], 1e-15)
        self.assertGreater(found["porosity"]["surface_hull"], 0.0)

    def test_stop_criteria(self):
        stopped = clast(*SPHERES, "--replicate", 500, "--stop-size", "25um", "--json").json
        self.assertEqual(stopped["repeats"][0]["stopped_by"], "size")
        self.assertGreaterEqual(stopped["d_agg"], 24.9e-6)
        stopped = clast(*SPHERES, "--replicate", 500, "--stop-porosity", "0.5", "--json").json
        self.assertEqual(stopped["repeats"][0]["stopped_by"], "porosity")
        short = clast(*SPHERES, "--replicate", 5, "--stop-size", "1mm", "--json")
        self.assertEqual(short.code, 5)
        self.assertIn("replicate", short.err)
        # One particle was placed, and the run had reached what its core alone fulfils.
        self.assert_fails(2, *SPHERES, "--replicate", 5, "--stop-size", "1um", says=("stop_size: the core alone has a d_agg of 10", "not below 1 um"))
        run = self.folder / "run"
        self.assertEqual(clast(*SPHERES, "--replicate", 30, *QUICK, "-o", run).code, 0)
        self.assert_fails(2, "aggregate", "--core", run / "state.h5", "--coat", "sphere", "--size", "5um", "--stop-porosity", "0.2",
                          says=("stop_porosity: the core alone has a porosity of 0.", "not below 0.2"))

    def test_a_band_ends_where_the_first_repeat_does(self):
        """Beyond it the mean was of those that the criterion had left: it fell while every aggregate grew looser."""
        words = ("aggregate", "--core", "sphere", "--core-size", "270um", "--coat", "sphere", "--size", "40um", "--replicate", 60, "--repeats", 5, *QUICK)
        rows = {}
        for name, more in (("stopped", ("--stop-porosity", "0.3")), ("whole", ())):
            self.assertEqual(clast(*words, *more, "-o", self.folder / name).code, 0)
            for file in ("history", "history_band"):
                with open(self.folder / name / f"{file}.csv", newline="") as text:
                    rows[name, file] = list(csv.DictReader(text))
        ends = [0] * 5
        for row in rows["stopped", "history"]:
            ends[int(row["repeat"])] = int(row["n"])
        self.assertLess(min(ends), max(ends))
        self.assertEqual(len(rows["stopped", "history_band"]), min(ends) + 1)
        self.assertEqual(rows["stopped", "history_band"], rows["whole", "history_band"][:min(ends) + 1])
        self.assertEqual({row["n_repeat"] for row in rows["whole", "history_band"]}, {"5"})
        self.assertEqual(len(rows["whole", "history_band"]), 61)

    def test_sizes_of_a_law_are_wanted_by_the_law(self):
        """wanted_finer was 1 at 50 um, of which the law cut at 0 has 0.446 finer; of 5 particles 1.5 were wanted."""
        core = ("aggregate", "--core", "sphere", "--core-size", "270um", "--coat", "sphere", *QUICK)
        for name, law in (("normal", ("--size-law", "normal", "--size-mean", "50um", "--size-deviation", "40um", "--n-particle", 5)),
                          ("one", ("--size-law", "lognormal", "--size-mean", "50um", "--size-shape", "0.4", "--n-particle", 1)),
                          ("equal", ("--size-law", "uniform", "--size-low", "50um", "--size-high", "50um", "--n-particle", 3))):
            self.assertEqual(clast(*core, *law, "-o", self.folder / name).code, 0)
            with open(self.folder / name / "sizes.csv", newline="") as file:
                rows = [{key: float(value) for key, value in row.items()} for row in csv.DictReader(file)]
            self.assertEqual(len(rows), 12 if name == "normal" else 1, name)
            self.assertAlmostEqual(sum(row["wanted"] for row in rows), law[-1], places=12)
            self.assertEqual(sum(row["placed"] for row in rows), law[-1])
            for row in rows if name == "normal" else ():
                below, least = (0.5 * math.erfc((50e-6 - x) / (40e-6 * math.sqrt(2))) for x in (row["high_m"], 0.0))
                self.assertAlmostEqual(row["wanted_finer"], (below - least) / (1 - least), places=12)

    def test_bins_that_overlap_are_one_row(self):
        """All 20 of each bin were placed, and told as 27 and 13."""
        listed = self.folder / "sizes.csv"
        listed.write_text("low_um,high_um,count\n20,60,20\n50,90,20\n90,95,1\n")
        self.assertEqual(clast("aggregate", "--core", "sphere", "--core-size", "270um", "--coat", "sphere", "--sizes", listed, *QUICK, "-o", self.folder / "run").code, 0)
        with open(self.folder / "run/sizes.csv", newline="") as file:
            self.assertEqual([(row["wanted"], row["placed"]) for row in csv.DictReader(file)], [("40", "40"), ("1", "1")])


class Printable(Case):
    """A printable body is the last of a run's results, and one that the run is whole without."""

    NEEDLE = ("aggregate", "--core", "ellipsoid:20,1,1", "--core-size", "1.2mm", "--coat", "sphere", "--size", "5um", "--replicate", 30, *QUICK)

    def outputs(self, run):
        return json.loads((run / "manifest.json").read_text())["outputs"]

    def test_a_body_in_pieces_leaves_a_whole_run(self):
        """It lost summary and page, and --resume, which the message named, failed the same way for ever."""
        run, plain = self.folder / "run", self.folder / "plain"
        failed = clast(*self.NEEDLE, "--printable", "--neck", "1um", "-o", run)
        self.assertEqual(failed.code, 5, failed.err)
        self.assertIn("grains                                 31", failed.out)
        self.assertNotIn("--printable adds", failed.out)
        self.assertEqual(failed.err.count("clast aggregate:"), 1, failed.err)
        for text in ("run holds the whole run but no printable body", "pieces with necks of 1 um sampled at 4 um", f"clast aggregate --resume {run} --printable --neck 1um --spacing 333nm"):
            self.assertIn(text, failed.err)
        self.assertEqual(json.loads((run / "manifest.json").read_text())["outcome"], "done")
        self.assert_fails(5, "aggregate", "--resume", run, "--printable", "--neck", "1um", "-q", says=("pieces with necks of 1 um sampled at 4 um",))  # was 3, "bad input"
        self.assert_fails(2, "aggregate", "--resume", run, "--printable", "--neck", "1mm", says=("thicker than every grain",))
        self.assertEqual(clast(*self.NEEDLE, "-o", plain).code, 0)
        names = {path.name for path in plain.iterdir()}
        self.assertEqual({path.name for path in run.iterdir()}, names)
        for name in names - {"manifest.json", "report.html", "state.h5"}:  # a state has the run's options
            self.assertEqual((run / name).read_bytes(), (plain / name).read_bytes(), name)
        self.assertEqual(clast("export", run, "-o", self.folder / "grains.csv").code, 0)
        self.assertEqual(clast("report", run, "-o", self.folder / "page.html").code, 0)

        made = clast("aggregate", "--resume", run, "--printable", "--neck", "4um", "--spacing", "2um")
        self.assertEqual(made.code, 0, made.err)
        self.assertIn("in mm: printable.3mf, printable.stl\nsmallest feature 4 um, resolved\n", made.out)
        self.assertEqual(clast("mesh", "check", run / "printable.stl").code, 0)
        self.assertEqual({path.name for path in run.iterdir()} - names, {"printable.3mf", "printable.json", "printable.stl"})
        self.assertEqual(sorted(set(self.outputs(run)) - set(self.outputs(plain))), ["printable.3mf", "printable.json", "printable.stl"])
        self.assertEqual(json.loads((run / "manifest.json").read_text())["config"]["neck"], 1e-6)  # the run's own
        before = self.outputs(run)
        again = clast("aggregate", "--resume", run, "--printable", "--spacing", "4um", "--json")
        self.assertEqual((again.code, again.json["spacing"], again.json["resolved"]), (0, 4e-6, False), again.err)
        self.assertEqual(self.outputs(run), before)
        self.assertEqual(clast(*self.NEEDLE, "-o", run, "--force").code, 0)  # the body was the old run's
        self.assertEqual({path.name for path in run.iterdir()}, names)

    def test_a_grid_too_large_leaves_a_whole_run(self):
        run = self.folder / "run"
        failed = clast(*SPHERES, "--printable", "--spacing", "1nm", *QUICK, "-o", run, "--json")
        self.assertEqual(failed.code, 5, failed.err)
        self.assertEqual(failed.json["n_grain"], 2)
        self.assertIn("a spacing of 1 nm on a body of extent 12.2607 um needs more than 2^31 nodes", failed.err)
        self.assertIn(f"clast aggregate --resume {run} --printable tries that", failed.err)
        made = clast("aggregate", "--resume", run, "--printable", "-q")
        self.assertEqual(made.code, 0, made.err)
        body = (run / "printable.stl").read_bytes()
        self.assertEqual(clast("aggregate", "--resume", run, "--printable", "--spacing", "1nm").code, 3)
        self.assertEqual((run / "printable.stl").read_bytes(), body)

    def test_a_whole_run_gets_a_body_later(self):
        run = self.folder / "run"
        self.assertEqual(clast(*SPHERES, "--replicate", 3, *QUICK, "-o", run).code, 0)
        self.assert_fails(2, "aggregate", "--resume", run, "--printable", "--rays", 3, says=("drop rays",))
        self.assert_fails(2, "aggregate", "--resume", run, "--printable", "-o", self.folder / "other", says=("drop -o",))
        self.assert_fails(2, "aggregate", "--resume", run, "--printable", "--neck", "1um", "--spacing", "1um", says=("neck: 1 um is below two spacings",))
        self.assert_fails(2, "aggregate", "--resume", run, "--neck", "1um", says=("drop neck",))
        self.assert_fails(2, "aggregate", "--resume", self.folder, "--printable", says=("drop printable",))
        self.assertFalse((run / "printable.stl").exists())
        self.assertEqual(clast("aggregate", "--resume", run, "--printable", "-q").code, 0)
        asked = self.folder / "asked"
        self.assertEqual(clast(*SPHERES, "--replicate", 3, "--printable", *QUICK, "-o", asked).code, 0)
        for name in ("printable.stl", "printable.3mf", "printable.json"):
            self.assertEqual((run / name).read_bytes(), (asked / name).read_bytes(), name)

    def test_an_earlier_body_stays_until_the_new_one_is_whole(self):
        """All three files of it were removed, and manifest.json still listed them."""
        run, names = self.folder / "run", ("printable.3mf", "printable.stl")
        self.assertEqual(clast(*SPHERES, "--replicate", 3, "--printable", "--spacing", "500nm", *QUICK, "-o", run).code, 0)
        before = {path.name: path.read_bytes() for path in run.iterdir()}
        words = f"ulimit -f 400; exec '{CLAST}' aggregate --resume '{run}' --printable --spacing 200nm"  # kB
        failed = subprocess.run(["bash", "-c", words], capture_output=True, text=True)
        self.assertEqual(failed.returncode, 4, failed.stderr)
        self.assertIn(f"printable.stl: write: File too large; clast aggregate --resume {run} --printable --spacing 200nm makes it", failed.stderr)
        self.assertEqual({path.name: path.read_bytes() for path in run.iterdir()}, before)
        (run / "printable.json").unlink()
        (run / "printable.json").mkdir()
        failed = clast("aggregate", "--resume", run, "--printable", "--spacing", "300nm")
        self.assertEqual(failed.code, 4, failed.err)
        self.assertEqual({name: (run / name).read_bytes() for name in names}, {name: before[name] for name in names})
        (run / "printable.json").rmdir()
        self.assertEqual(clast("aggregate", "--resume", run, "--printable", "--spacing", "500nm").code, 0)
        self.assertEqual({path.name: path.read_bytes() for path in run.iterdir()}, before)

    def test_a_run_that_is_stopped_in_its_body_is_whole(self):
        """It said "running" for ever, without outputs and page; neither --resume nor -o went on with it."""
        run = self.folder / "run"
        words = (*SPHERES, "--printable", "--neck", "200nm", "--spacing", "60nm", *QUICK, "-o", run)
        with subprocess.Popen([CLAST, *map(str, words)], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True) as process:
            self.assertIn("printable.stl: about", process.stderr.readline())  # the body begins
            process.send_signal(signal.SIGTERM)
            said = process.stderr.read()
        self.assertEqual(process.returncode, 143, said)
        self.assertIn(f"run holds the whole run but no printable body: stopped; clast aggregate --resume {run} --printable --neck 200nm --spacing 60nm makes it", said)
        manifest = json.loads((run / "manifest.json").read_text())
        self.assertEqual(manifest["outcome"], "done")
        self.assertIn("report.html", {path.name for path in run.iterdir()})
        self.assertNotIn("printable.stl", {path.name for path in run.iterdir()} | set(manifest["outputs"]))
        text = (run / "manifest.json").read_text()  # as an earlier version left it
        text = re.sub(r'\n  "outputs": .*', "", text).replace('"outcome": "done",', '"outcome": "running",\n  "process": "process 1 on vm",\n  "progress": 0.99,')
        (run / "manifest.json").write_text(text)
        self.assertEqual(clast("aggregate", "--resume", run, "--printable", "--spacing", "1um").code, 0)
        mended = json.loads((run / "manifest.json").read_text())
        self.assertEqual(mended.pop("outcome"), "done")
        self.assertEqual(mended, {key: value for key, value in manifest.items() if key not in ("outcome", "outputs")})

    def test_a_new_run_tells_what_its_body_does_not_show(self):
        """Nothing did but printable.json: a neck of six times the thinnest grain, 36 % more volume."""
        run = self.folder / "run"
        words = ("aggregate", "--core", "sphere", "--core-size", "270um", "--coat", "ellipsoid:3,2,1", "--size", "60um", "--replicate", 10, *QUICK, "--printable")
        made = clast(*words, "--spacing", "40um", "-o", run)
        self.assertEqual(made.code, 0, made.err)
        self.assertIn("aggregate.stl\nsmallest feature 20 um, below two spacings, may be lost\n", made.out)
        self.assertIn("printable.stl: not resolved: the smallest feature, 20 um, is below two spacings", made.err)
        found = clast(*words, "--spacing", "5um", "--force", "-o", run, "--json")
        self.assertNotIn("not resolved", found.err)
        self.assertEqual((found.json["printable"]["resolved"], found.json["printable"]["lost"]), (True, 0.0))
        self.assertNotIn("printable", json.loads((run / "summary.json").read_text()))

    def test_what_cannot_be_printed_is_refused_before_the_run(self):
        run = self.folder / "run"
        self.assert_fails(2, *CLUSTER, "--n-final", 2, "--printable", "-o", run, says=("printable: one body", "n_final leaves 2 clusters apart"))
        self.assert_fails(2, *SPHERES, "--printable", "--neck", "1um", "--spacing", "4um", "-o", run,
                          says=("neck: 1 um is below two spacings of 4 um", "a spacing of a third of the neck (333.333 nm)", "a neck of three spacings (12 um)"))
        self.assertFalse(run.exists())


class Clusters(Case):
    """Numbers of a run that ends in several clusters are those of the largest, and say so."""

    APART = ("aggregate", "--mode", "cluster", "--coat", "sphere", "--size", "20um", "--replicate", 40, "--seed", 5, *QUICK)

    def structure(self, run):
        with open(run / "structure.csv", newline="") as file:
            return {row["name"]: float(row["value"]) for row in csv.DictReader(file)}

    def test_every_number_is_of_the_largest(self):
        """structure.csv had 40 grains, a porosity of 0.9074 and 151 um: of all ten side by side; summary.json 24, 0.7449, 91 um."""
        run = self.folder / "run"
        made = clast(*self.APART, "--n-final", 10, "-o", run)
        self.assertEqual(made.code, 0, made.err)
        self.assertIn("\nlargest of 10 clusters, 24 of 40 grains (", made.out)
        summary, found = json.loads((run / "summary.json").read_text()), self.structure(run)
        self.assertEqual((summary["n_grain"], summary["repeats"][0]["n_cluster"], found["n_grain"]), (24, 10, 24))
        self.assertEqual(found["n_contact"], summary["repeats"][0]["n_contact"])
        self.assertEqual(summary["repeats"][0]["n_grain_all"], 40)
        self.assertTrue(summary["scope"].startswith("largest of 10 clusters, 24 of 40 grains ("), summary["scope"])
        self.assertIn(summary["scope"], (run / "report.html").read_text())
        for name, of_summary in (("mass", summary["mass"]), ("radius_of_gyration", summary["radius_of_gyration"]), ("d_agg_surface_hull", summary["d_agg"]),
                                 ("porosity_surface_hull", summary["porosity"]["surface_hull"])):
            self.assertAlmostEqual(found[name] / of_summary, 1.0, delta=1e-9, msg=name)
        with open(run / "radial.csv", newline="") as file:
            solid = sum(float(row["solid_m3"]) for row in csv.DictReader(file))
        self.assertAlmostEqual(solid / summary["solid_sum"], 1.0, delta=1e-6)
        self.assertEqual(clast("mesh", "check", run / "aggregate.stl", "--json").json["n_part"], 40)  # all, to be looked at
        repeats = clast(*self.APART, "--n-final", 10, "--repeats", 2)
        self.assertIn("\nlargest of 10 clusters of each repeat (", repeats.out)
        self.assertNotIn("largest", clast(*CLUSTER).out)

    def test_clusters_apart_are_no_rigid_core(self):
        """Ten clusters, set side by side to be looked at, were taken as one rigid core of 40 grains."""
        run = self.folder / "run"
        self.assertEqual(clast(*self.APART, "--n-final", 10, "-o", run).code, 0)
        state = run / "state.h5"
        self.assert_fails(3, "aggregate", "--core", state, "--coat", "sphere", "--size", "20um", says=("core: its 40 grains are 10 pieces that do not touch", "n_final 1"))
        self.assert_fails(3, "aggregate", "--core", "sphere", "--core-size", "20um", "--coat", state, "--size", "20um", says=("coat: its 40 grains are 10 pieces",))

    def test_a_printable_body_of_several_is_the_largest(self):
        run = self.folder / "run"
        made = clast(*self.APART, "--stop-size", "80um", "--printable", "--spacing", "4um", "-o", run)
        self.assertEqual(made.code, 0, made.err)
        self.assertIn("printable.stl: the largest of 13 clusters, 19 of 40 grains\n", made.err)
        body = json.loads((run / "printable.json").read_text())
        self.assertAlmostEqual(body["solid_volume"] / (19 * 3.141592653589793 / 6 * 8e-15), 1.0, delta=1e-12)
        first = (run / "printable.stl").read_bytes()
        self.assertEqual(clast("aggregate", "--resume", run, "--printable", "--spacing", "4um", "-q").code, 0)
        self.assertEqual((run / "printable.stl").read_bytes(), first)


class Overlapping(Case):
    """Where composites touch, true surfaces overlap: one name has one number, and it is said which solid it is by."""

    LONG = ("aggregate", "--core", "ellipsoid:3,2,1", "--core-size", "100um", "--coat", "ellipsoid:3,2,1", "--size", "20um", "--replicate", 20,
            "--fill-spheres", 30, *QUICK)

    def test_one_name_has_one_number(self):
        """Porosity 0.47674 in summary.json, 0.48271 in structure.csv; max_overlap 1e-20 and 6.9e-6 m."""
        for contact, says in (("spheres", "max_overlap that of the sphere composites"), ("march", "max_overlap is not looked for in the march")):
            run = self.folder / contact
            made = clast(*self.LONG, "--contact", contact, "-o", run)
            self.assertEqual(made.code, 0, made.err)
            summary = json.loads((run / "summary.json").read_text())
            with open(run / "structure.csv", newline="") as file:
                found = {row["name"]: float(row["value"]) for row in csv.DictReader(file)}
            hull = summary["envelope"]["surface_hull"]
            self.assertAlmostEqual(found["porosity_surface_hull"], summary["porosity"]["surface_hull"], delta=1e-12)
            self.assertAlmostEqual(summary["porosity"]["surface_hull"], 1 - summary["solid_sum"] / hull, delta=1e-12)
            self.assertAlmostEqual(found["porosity_union_surface_hull"], 1 - summary["solid_union"] / hull, delta=1e-3)
            self.assertAlmostEqual(found["packing_surface_hull"] + found["porosity_surface_hull"], 1.0, delta=1e-12)
            self.assertAlmostEqual(found["density_surface_hull"] / (2500 * found["packing_surface_hull"]), 1.0, delta=1e-12)
            self.assertNotIn("max_overlap", found)
            self.assertGreater(found["max_overlap_surfaces"], 1e-6)
            self.assertIn("porosity by the sum of the grains' volumes, which overlap by ", made.out)
            self.assertIn(says, made.out)
            printed = float(re.search(r"porosity_union, surface_hull +([\d.]+)", made.out).group(1))
            self.assertAlmostEqual(printed, found["porosity_union_surface_hull"], delta=1e-3)
            self.assertTrue(summary["scope"].startswith("porosity by the sum of the grains' volumes, which overlap by "), summary["scope"])
        self.assertIsNone(summary["repeats"][0]["max_overlap"])  # of the march: nobody looked
        with open(run / "history.csv", newline="") as file:
            self.assertEqual({row["overlap_m"] for row in csv.DictReader(file)}, {""})
        self.assertIsNone(summary["max_overlap"])
        self.assertNotIn("scope", clast(*SPHERES, "--json").json)
        self.assertNotIn("union", clast(*SPHERES).out)


class Repeatable(Case):
    def run_with(self, name, *options):
        run = self.folder / name
        result = clast("aggregate", "--core", "ellipsoid:3,2,1", "--core-size", "30um", "--coat",
                       "ellipsoid:2,1.5,1", "--coat", "sphere", "--size-law", "lognormal", "--size-mean", "8um",
                       "--size-shape", "0.4", "--n-particle", 40, "--cone", "60deg", "--rays", 6,
                       "--orientations", 3, "-o", run, *QUICK, *options)
        self.assertEqual(result.code, 0, result.err)
        return run

    def assert_same(self, one, other):
        timed = {"manifest.json", "report.html"}  # both tell when and where the run was
        names = sorted(path.name for path in one.iterdir() if path.name not in timed)
        self.assertEqual(names, sorted(p.name for p in other.iterdir() if p.name not in timed))
        for name in names:
            self.assertEqual((one / name).read_bytes(), (other / name).read_bytes(), name)

    def test_threads_change_no_byte(self):
        one = self.run_with("one", "-j1")
        for threads in (2, 4):
            self.assert_same(one, self.run_with(f"{threads}", f"-j{threads}"))

    def test_seed_changes_the_aggregate(self):
        one = self.run_with("one")
        other = self.run_with("other", "--seed", 2)
        self.assertNotEqual((one / "history.csv").read_bytes(), (other / "history.csv").read_bytes())

    def interrupted(self, run, command, number):
        process = subprocess.Popen([CLAST, *command, "-o", str(run)], stdout=subprocess.DEVNULL,
                                   stderr=subprocess.PIPE, text=True)
        limit = time.time() + 60
        while not list(run.glob("checkpoint-*.h5")) and process.poll() is None and time.time() < limit:
            time.sleep(0.005)
        os.kill(process.pid, number)
        _, said = process.communicate(timeout=60)
        return process.returncode, said

    def test_a_stopped_run_ends_in_the_same_bytes(self):
        command = ("aggregate", "--core", "ellipsoid:3,2,1", "--core-size", "30um", "--coat",
                   "ellipsoid:2,1.5,1", "--size", "8um", "--replicate", "60", "--cone", "90deg", "--rays", "40",
                   "--orientations", "10", "--repeats", "2", "--checkpoint-every", "3", "--envelope-every", "20", *QUICK)
        whole = self.folder / "whole"
        self.assertEqual(clast(*command, "-o", whole).code, 0)
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
            run = self.folder / f"stopped-{number}"
            code, said = self.interrupted(run, command, number)
            self.assertEqual(code, 128 + number, said)
            self.assertIn("--resume", said)
            self.assertFalse((run / "summary.json").exists())
            self.assertLessEqual(len(list(run.glob("checkpoint-*.h5"))), 2)
            self.assert_fails(2, *command, "-o", run, says=("--resume",))
            self.assert_fails(2, "aggregate", "--resume", run, "--rays", 3, says=("rays",))
            resumed = clast("aggregate", "--resume", run)
            self.assertEqual(resumed.code, 0, resumed.err)
            self.assert_same(whole, run)

    def test_a_resumed_run_tells_its_own_surfaces(self):
        """It told those of the command line's --printable, which beside --resume is the default."""
        run = self.folder / "run"
        self.interrupted(run, (*SPHERES, "--replicate", "60", "--cone", "90deg", "--rays", "200", "--checkpoint-every", "5", "--printable",
                               "--spacing", "5um", *QUICK), signal.SIGKILL)
        resumed = clast("aggregate", "--resume", run)
        self.assertEqual(resumed.code, 0, resumed.err)
        self.assertTrue((run / "printable.3mf").exists())
        self.assertIn("in mm: printable.3mf, printable.stl, aggregate.stl\n", resumed.out)

    def test_a_killed_run_goes_on_from_its_checkpoint(self):
        command = (*SPHERES, "--replicate", "400", "--cone", "90deg", "--rays", "200", "--checkpoint-every", "20",
                   "--envelope-every", "100", *QUICK)
        run, whole = self.folder / "killed", self.folder / "whole"
        self.assertEqual(self.interrupted(run, command, signal.SIGKILL)[0], -signal.SIGKILL)
        newest = max(run.glob("checkpoint-*.h5"))
        newest.write_bytes(newest.read_bytes()[:-100])  # as if the disk had lost its end
        if len(list(run.glob("checkpoint-*.h5"))) == 1:
            self.assert_fails(3, "aggregate", "--resume", run, says=("checkpoint",))
            return
        self.assertEqual(clast("aggregate", "--resume", run).code, 0)
        self.assertEqual(clast(*command, "-o", whole).code, 0)
        self.assert_same(whole, run)


class BadInput(Case):
    def sizes(self, text):
        path = self.folder / "sizes.csv"
        path.write_text(text)
        return ("aggregate", "--core", "sphere", "--core-size", "1mm", "--coat", "sphere", "--sizes", path)

    def test_sizes_are_read_in_their_unit(self):
        for text in ("d_um\n20\n10\n", "d_mm;count\n0.02;1\n0.01;1\n", "low_um,high_um,n\n20,20,1\n10,10,1\n",
                     "# phi\nd_phi\n5.643856189774724\n6.643856189774724\n"):
            found = clast(*self.sizes(text), "--json")
            self.assertEqual(found.code, 0, found.err)
            solid = 3.141592653589793 / 6 * (1e-9 + 8e-15 + 1e-15)
            self.assertAlmostEqual(found.json["solid_sum"] / solid, 1.0, delta=1e-12)

    def test_a_lone_name_with_its_unit_in_brackets(self):
        """'Size (mm)', which the message tells people to write, was cut at its blank: "column '(mm)' is not understood"."""
        for text in ("Size (mm)\n0.02\n0.04\n", "Size (um)\n20\n40\n", "Size (µm)\n20\n40\n", "Size (mm) count\n0.02 1\n0.04 1\n"):
            found = clast(*self.sizes(text), "--json")
            self.assertEqual(found.code, 0, found.err)
            self.assertAlmostEqual(found.json["solid_sum"] / (3.141592653589793 / 6 * (1e-9 + 8e-15 + 64e-15)), 1.0, delta=1e-12)

    def test_bad_sizes_name_their_line(self):
        for text, says in (("d_um\n20\n0\n", "sizes.csv:3"), ("d_um\n-4\n", "sizes.csv:2"),
                           ("d_um\n1\n2\nnan\n", "sizes.csv:4"), ("d_um\n1\nbig\n", "'big' is not a number"),
                           ("d_um,count\n10,-1\n", "sizes.csv:2"), ("d_um\n1,2\n", "sizes.csv:2: 2 cells"),
                           ("d_um\ninf\n", "'inf' is not finite"), ("d_um\n1e999\n", "not finite"), ("", "no row"), ("d_um\n", "no sizes")):
            self.assert_fails(3, *self.sizes(text), says=(says,))
        self.assert_fails(2, *self.sizes("20\n10\n"), says=("size_unit",))
        self.assert_fails(2, *self.sizes("d_um,count\n20,1.5\n"), says=("whole",))

    def test_sizes_are_counts_or_masses_in_one_unit(self):
        weighed = "d_um,mass_g\n10,8\n20,8\n"
        self.assert_fails(2, *self.sizes("d_um,mass\n20,3\n"), says=("'mass' holds masses", "size_by_mass"))
        draw = ("--size-draw", "--n-particle", "40", "--seed", "2")
        self.assert_fails(2, *self.sizes("d_um,count\n20,3\n"), "--size-by-mass", *draw, says=("'count'", "leave size_by_mass out"))
        run = self.folder / "run"
        made = clast(*self.sizes(weighed), "--size-by-mass", *draw, "-o", run)
        self.assertEqual(made.code, 0, made.err)
        self.assert_fails(2, *self.sizes("d_mm\n0.02\n"), "--size-unit", "um", says=("'d_mm' is in mm by its name", "asked for is um"))
        self.assertEqual(clast(*self.sizes("d_mm\n0.02\n"), "--size-unit", "mm").code, 0)
        for name in ("size_ft", "size (inches)", "size (m/s)"):  # 305 times the size, with exit code 0
            self.assert_fails(3, *self.sizes(f"{name}\n0.02\n"), "--size-unit", "mm", says=(f"column '{name}' is in no unit of length that is read here",))
        self.assertEqual(clast(*self.sizes("size [ mm ]\n0.02\n"), "--size-unit", "mm").code, 0)
        self.assert_fails(2, *self.sizes("size [ mm ]\n0.02\n"), "--size-unit", "phi", says=("is in mm by its name", "asked for is phi"))
        self.assertEqual(clast(*self.sizes("grain_id,size_mm\n7,0.02\n")).code, 0)
        self.assert_fails(2, *self.sizes("gloss,size_mm\n7,0.02\n"), says=("'gloss' is not understood",))
        self.assertEqual(clast(*self.sizes("gloss,size_mm\n7,0.02\n"), "--size-column", "size_mm").code, 0)

    def test_bins_weigh_as_their_masses_say(self):
        """A bin of a decade was drawn 3.8 times too often: its grains were weighed by the cube of its geometric middle, not by their mean cube."""
        run = self.folder / "run"
        made = clast(*self.sizes("low_um,high_um,mass_g\n10,20,1\n20,200,1\n"), "--size-by-mass", "--size-draw", "--n-particle", 4000, *QUICK,
                     "--envelope", "gyration_sphere", "--envelope-every", 9999, "-o", run)
        self.assertEqual(made.code, 0, made.err)
        with open(run / "sizes.csv", encoding="utf-8") as file:
            fine, coarse = csv.DictReader(file)
        # mean cubes in (10 um)^3: 7 / 3 ln 2 of the fine, 7992 / 3 ln 10 of the coarse
        ratio = (7992 / math.log(10)) / (7 / math.log(2))
        self.assertAlmostEqual(float(fine["wanted"]) / float(coarse["wanted"]), ratio, delta=1e-9 * ratio)
        self.assertAlmostEqual(float(coarse["placed"]), 4000 / (1 + ratio), delta=5 * math.sqrt(4000 / ratio))

    def test_a_size_at_a_limit_is_below_it_in_every_unit(self):
        """0.03 mm was above a class_limit of 30um in its last bit, as 442 of the first 1000 um are, and took the other shape."""
        coats = ("--coat", "ellipsoid:2,1,1", "--class-limit", "30um", "--json")
        solids = [clast(*self.sizes(text), *coats).json["solid_sum"] for text in ("size_mm\n0.03\n", "size_um\n30\n", "size_m\n3e-5\n")]
        self.assertLess(max(solids) - min(solids), 1e-22)

    def test_a_porosity_below_zero_is_told(self):
        """A light coat about a dense core: by the sphere of its radius of gyration, porosity -1.47 and 1472 kg/m3 without a word."""
        light = (*SPHERES, "--replicate", 60, "--coat-density", "100kg/m^3")
        says = "porosity below 0: gyration_sphere is smaller than the solid"
        made = clast(*light, "--envelope", "surface_hull", "--envelope", "gyration_sphere")
        self.assertIn(says, made.out)
        self.assertIn(says, clast(*light, "--envelope", "gyration_sphere", "--json").json["scope"])
        self.assertNotIn("below 0", clast(*light).out)

    def test_percent_by_weight_is_a_mass(self):
        """Weight percent of a sieve analysis were taken for numbers of grains: 100 of them."""
        for name in ("weight_percent", "Weight %", "weight (%)"):
            self.assert_fails(2, *self.sizes(f"low_um,high_um,{name}\n10,20,30\n20,40,70\n"), says=("holds masses, not numbers of grains",))
        self.assertEqual(clast(*self.sizes("low_um,high_um,weight\n10,20,30\n20,40,70\n"), "--json").json["n_grain"], 101)

    def test_drawn_sizes_are_drawn_in_each_replicate(self):
        """The help said "particles to place" of all: a law has other particles in each replicate, a list has n_particle in all."""
        grow = (*SPHERES[:7], "--replicate", 3, "--json", "--n-particle")
        law = ("--size-law", "lognormal", "--size-mean", "4um", "--size-shape", "0.5")
        for n_grain, more in ((61, (20, *law)), (61, (20, *self.sizes("d_um,count\n4,3\n5,1\n")[-2:], "--size-draw")), (3, (2, "--size", "4um"))):
            self.assertEqual(clast(*grow, *more).json["n_grain"], n_grain, more)
        told = " ".join(clast("aggregate", "--help-all").out.split())
        self.assertIn("from a law or with size_draw: how many are drawn, replicate times", told)
        self.assertIn("how often the list is used, or n_particle sizes are drawn", told)

    def test_lengths_are_told_in_units_that_suit_them(self):
        """A body of metres was "1.35721e+06 um"."""
        for size, unit in (("1m", "m"), ("2mm", "mm"), ("30um", "um"), ("200nm", "nm")):
            out = clast("aggregate", "--core", "sphere", "--core-size", size, "--coat", "sphere", "--size", size).out
            self.assertRegex(out, rf"d_agg +\d[\d.]* {unit} *\n")
            self.assertRegex(out, r"radius of gyration +\d[\d.]* [mun]?m *\n")

    def test_a_fall_beyond_the_drag_law_is_told(self):
        ask = ("aggregate", "--core", "sphere", "--coat", "sphere", "--core-size")
        self.assertIn("m/s     (Re 1.3e+06, beyond the drag law's 3e+05)", clast(*ask, "20cm", "--size", "10cm").out)
        self.assertNotIn("(Re", clast(*ask, "2mm", "--size", "1mm").out)
        self.assertAlmostEqual(clast(*ask, "20cm", "--size", "10cm", "--json").json["settling_reynolds"], 1.344e6, delta=1e3)

    def test_bad_options(self):
        for options, says in ((("--rayz", "3"), "--rays"), (("--cone", "200deg"), "cone"),
                              (("--axis", "0,0,0"), "axis"), (("--envelope", "hull"), "envelope"),
                              (("--class-limit", "3um"), "class_limit"), (("--n-particle", "5"), "n_particle"),
                              (("--stop-mass", "1kg"), "stop_mass"), (("--origin", "sphere"), "origin"),
                              (("--size-law", "normal"), "size_law"), (("--stop-porosity", "2"), "stop_porosity"),
                              (("--core-size", "1e-13m"), "1e-6")):
            self.assert_fails(2, *SPHERES, *options, says=(says,))
        self.assert_fails(2, *CLUSTER, "--n-final", "9", says=("n_final",))

    def test_refusals_name_what_helps(self):
        """A unit was asked for that was there, a file that there was not, cells that no option has, and a bound of inf m."""
        coat = ("--coat", "sphere", "--size", "5um")
        for core in ("sphere", "ellipsoid:3,2,1"):
            self.assert_fails(2, "aggregate", "--core", core, "--unit", "um", *coat, says=("have no size of their own; give core_size",))
        self.assert_fails(2, *SPHERES[:5], "--coat", "ellipsoid:3um,2um,1um", "--size", "5um", says=("ratios of its axes: they have no unit",))
        self.assert_fails(3, *SPHERES, "--envelope", "wrap", "--envelope-length", "1m", says=("a ball of radius 1 m", "a smaller envelope_length"))
        self.assert_fails(2, *SPHERES[:7], "--size-law", "lognormal", "--size-mean", "1um", "--size-shape", "0.1", "--size-low", "70um",
                          "--n-particle", 3, says=("none of 10000 draws lies above size_low 70 um\n",))

    def test_options_without_effect_are_refused(self):
        """Each was taken, and the run's numbers were those without it."""
        run = self.folder / "run"
        self.assertEqual(clast(*SPHERES, "--replicate", 3, "-o", run, *QUICK).code, 0)
        h5 = run / "state.h5"
        of_run = ("aggregate", "--core", h5, "--coat", h5, "--size", "2um")
        law = ("aggregate", "--core", "sphere", "--core-size", "10um", "--coat", "sphere", "--n-particle", 6, "--size-law")
        flat, normal, wide = (*law, "uniform", "--size-low", "1um", "--size-high", "2um"), (*law, "normal", "--size-mean", "2um", "--size-deviation", "0.1um"), \
            (*law, "weibull", "--size-mean", "2um", "--size-shape", 3)
        long = ("aggregate", "--core", "ellipsoid:3,2,1", "--core-size", "10um", "--coat", "ellipsoid:3,2,1", "--size", "5um")
        march, fit = (*long, "--contact", "march"), (*long, "--fit", "--observed-size", "12um", "--observed-size-error", "1um")
        out = ("-o", self.folder / "never")
        in_cluster, no_law, listed = "in mode cluster", "without a size_law", "with this size_law: it goes from size_low to size_high"
        for words, options in (
                (SPHERES, ((("--size-mean", "3um"), "size_mean", no_law), (("--size-deviation", "3um"), "size_deviation", no_law),
                           (("--size-shape", 2), "size_shape", no_law), (("--size-low", "1um"), "size_low", no_law),
                           (("--size-high", "9um"), "size_high", no_law), (("--size-column", "d"), "size_column", "without sizes"),
                           (("--size-unit", "um"), "size_unit", "without sizes"), (("--n-final", 3), "n_final", "without mode cluster"),
                           (("--pick", "mass"), "pick", "without mode cluster"),
                           (("--march-fine", 0.1), "march_fine", "without contact march"), (("--walk-step", 0.5), "walk_step", "without approach diffusive"),
                           (("--envelope-length", "1um"), "envelope_length", "without envelope wrap or alpha"),
                           (("--envelope-rays", 50), "envelope_rays", "without envelope sphere_rays"), (("--coat-weight", 3), "coat_weight", "with one coating shape"),
                           (("--neck", "1um", *out), "neck", "without printable"),
                           (("--observed-velocity", 1), "observed_velocity", "without fit"), (("--fit-repeats", 9), "fit_repeats", "without fit"),
                           (("--printable",), "printable", "without -o"),
                           (("--fall-speed",), "fall_speed", "without -o"))),
                (flat, ((("--size-mean", "1um"), "size_mean", listed), (("--size-draw",), "size_draw", "with a size_law, which draws"),
                        (("--size-by-mass",), "size_by_mass", "with a size_law, which draws"))),
                (normal, ((("--size-shape", 2), "size_shape", "with this size_law: its width is size_deviation"),)),
                (wide, ((("--size-deviation", "1um"), "size_deviation", "with this size_law: its width is size_shape"),)),
                (CLUSTER, ((("--core", "sphere"), "core", in_cluster), (("--core-size", "1um"), "core_size", in_cluster),
                           (("--core-density", 100), "core_density", in_cluster), (("--origin", "core"), "origin", in_cluster),
                           (("--target", "mass"), "target", in_cluster))),
                (of_run, ((("--core-density", 9), "core_density", "with an aggregate (state.h5), whose grains have their own"),
                          (("--coat-density", 9), "coat_density", "with aggregates (state.h5), whose grains have their own"))),
                (long, ((("--core-spheres", "none.csv"), "core_spheres", "without -o, contact spheres or march, or an envelope of spheres"),)),
                (march, ((("--target", "mass"), "target", "with contact march"), (("--max-tries", 3), "max_tries", "with contact march"),
                         (("--origin", "grain"), "origin", "with contact march"))),
                (fit, ((("--repeats", 4), "repeats", "with fit: it grows fit_repeats"), (("--permeability", "kozeny_carman"), "permeability", "with fit"),
                       (("--printable", *out), "printable", "with fit")))):
            for option, name, why in options:
                with self.subTest(name, why=why):
                    self.assert_fails(2, *words, *option, says=(f"{name} does nothing {why}",))
        self.assertFalse(out[1].exists())
        for words, option, name, why in (  # what files for another engine bring is told
                (SPHERES, ("--flavour", "figures"), "flavour", "without contact march"), (SPHERES, ("--confidence", 0.6), "confidence", "without repeats"),
                (SPHERES, ("--fill", "random"), "fill", "without contact spheres or march, or an envelope of spheres"),
                (of_run, ("--contact", "spheres", "--fill-spheres", 9), "fill_spheres", "where every shape comes with its spheres")):
            done = clast(*words, *option)
            self.assertEqual((done.code, f"{name} does nothing {why}" in done.err), (0, True), done.err)
        file = self.folder / "walk.yaml"
        file.write_text("core: sphere\ncore_size: 1 um\ncoat: [sphere]\nsize: [1 um]\nwalk_step: 0.2\n")
        self.assert_fails(2, "aggregate", file, says=("walk_step does nothing without approach diffusive",))
        self.assertEqual(clast("aggregate", file, "--walk-step", 0.1).code, 0)  # the default is no mistake

    def test_bad_shapes(self):
        base = ("aggregate", "--core-size", "1mm", "--size", "1um", "--coat")
        self.assert_fails(3, *base, "sphere", "--core", self.folder / "none.stl", says=("none.stl",))
        self.assert_fails(3, *base, self.folder / "none.stl", "--core", "sphere", says=("none.stl", "coat"))
        self.assert_fails(2, *base, "ellipsoid:1,2", "--core", "sphere", says=("ellipsoid",))
        self.assert_fails(2, "aggregate", "--coat", "sphere", "--size", "1um", says=("core",))
        empty = self.folder / "empty.stl"
        empty.write_bytes(b"")
        self.assert_fails(3, *base, "sphere", "--core", empty, says=("empty.stl",))
        opened = self.folder / "open.off"
        opened.write_text(CUBE.replace("8 6 0", "8 5 0").replace("4 3 0 4 7\n", ""))
        self.assert_fails(3, *base, "sphere", "--core", opened, says=("open.off", "repair"))

    def test_refused_runs_leave_nothing(self):
        run = self.folder / "run"
        self.assert_fails(2, *SPHERES, "--stop-mass", "1kg", "-o", run)
        self.assertFalse(run.exists())
        self.assert_fails(4, *SPHERES, "-o", "/proc/run", says=("/proc/run",))

    def test_a_core_that_says_its_unit_has_a_size(self):
        surface, said = ROOT / "data/standin63/grain05.ply", self.folder / "mm.stl"
        clast("mesh", "convert", surface, "--unit", "mm", "-o", said)
        grown = [clast("aggregate", "--core", *core, "--coat", "sphere", "--size", "1mm", "--replicate", 5, "--json")
                 for core in ((said,), (said, "--unit", "mm"))]
        self.assertEqual([g.code for g in grown], [0, 0], grown[0].err)
        self.assertEqual(grown[0].json["d_agg"], grown[1].json["d_agg"])
        self.assert_fails(2, "aggregate", "--core", surface, "--coat", "sphere", "--size", "1mm", says=("the core's file has no unit",))

    def test_volume_diameters_as_lengths_are_noted(self):
        sizes = self.folder / "volume.csv"
        sizes.write_text("volume_diameter_um,number\n30,2\n40,1\n")
        for coat, more, n in (("ellipsoid:1,0.8,0.6", (), 1), ("ellipsoid:1,0.8,0.6", ("--size-meaning", "volume"), 0), ("sphere", (), 0)):
            done = clast("aggregate", "--core", "sphere", "--core-size", "270um", "--coat", coat, "--sizes", sizes, *more)
            self.assertEqual((done.code, done.err.count("column 'volume_diameter_um', and are taken as maximum lengths")), (0, n), done.err)


if __name__ == "__main__":
    unittest.main()
