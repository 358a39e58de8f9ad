"""CLI: clast study runs, resumes and tabulates."""
import csv
import json
import os
import pathlib
import signal
import statistics
import subprocess
import sys
import time
import unittest

from clitest import CLAST, ROOT, Case, clast, preload

SURFACE = "data/scarlet/stl/27sk21_shape_fine.stl"


class Study(Case):
    def plan(self, text):
        path = self.folder / "study.yaml"
        path.write_text(text)
        return path

    def rows(self, name="results.csv"):
        with open(self.folder / "out" / name, newline="", encoding="utf-8") as file:
            return list(csv.DictReader(file))

    def test_results_equal_the_command_alone(self):
        plan = self.plan(f"run: fill\nargument: [{SURFACE}]\nvary: [spheres = 5 | 9, strategy = random | largest]\n")
        done = clast("study", plan, "-o", self.folder / "out", "--json")
        self.assertEqual(done.code, 0, done.err)
        self.assertEqual(done.json["n_done"], 4)
        rows = self.rows()
        alone = clast("fill", SURFACE, "--spheres", 9, "--strategy", "random", "--json").json
        self.assertEqual([row["spheres"] for row in rows], ["5", "5", "9", "9"])
        self.assertEqual(float(rows[2]["filled_fraction"]), alone["filled_fraction"])
        self.assertNotIn("wall_s", rows[0])
        self.assertIn("wall_s", self.rows("times.csv")[0])
        first = (self.folder / "out/results.csv").read_bytes()
        again = clast("study", plan, "-o", self.folder / "other", "-j", 1)
        self.assertEqual(again.code, 0, again.err)
        self.assertEqual((self.folder / "other/results.csv").read_bytes(), first)

    def long_plan(self):
        return self.plan("run: pack\nconfig: examples/u1.yaml\nfix: [mass=60g, max_steps=1500]\nseeds: 6\n")

    def start(self, plan, *words):
        return subprocess.Popen([CLAST, "study", plan, "-o", self.folder / "out", *words], cwd=ROOT, stdout=subprocess.PIPE,
                                stderr=subprocess.PIPE, text=True)

    def test_two_studies_share_one_folder(self):
        plan = self.long_plan()
        both = [self.start(plan, "-j", "1", "-q", "--json") for _ in range(2)]
        ends = [(one.communicate(), one.returncode) for one in both]
        for (_, error), code in ends:
            self.assertEqual((code, error), (0, ""))
        done = [json.loads(out)["n_done"] for (out, _), _ in ends]
        self.assertEqual(sum(done), 6)  # none twice
        self.assertEqual(len(self.rows()), 6)
        self.assertEqual([row["exit_code"] for row in self.rows()], ["0"] * 6)
        self.assertEqual([p.name for p in (self.folder / "out").rglob("*.lock")], [])

    def test_a_killed_study_leaves_no_run_behind(self):
        if not sys.platform.startswith("linux"):
            self.skipTest("SKIPPED LOUDLY: only Linux tells a process that its parent has gone")
        with self.start(self.long_plan(), "-j", "2", "-q") as study:
            runs = self.folder / "out/runs"
            while len(list(runs.glob("*.part/out/manifest.json"))) < 2 and study.poll() is None:
                time.sleep(0.02)
            study.kill()
            study.communicate()
        ends = time.monotonic() + 20

        def left():
            return subprocess.run(["pgrep", "-f", str(self.folder)], capture_output=True, text=True, check=False).stdout.split()

        while left() and time.monotonic() < ends:
            time.sleep(0.05)
        self.assertEqual(left(), [])
        again = clast("study", self.folder / "study.yaml", "-o", self.folder / "out", "-q", cwd=ROOT)
        self.assertEqual(again.code, 0, again.err)

    def test_two_other_studies_begun_at_once_do_not_mix(self):
        """Both went on, with rows of the one and of the other."""
        for n in range(8):
            out = self.folder / f"mix-{n}"
            words = [CLAST, "study", "--run", "fill", "--argument", SURFACE, "-o", out, "-q", "--vary"]
            both = [subprocess.Popen([*words, values], cwd=ROOT, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
                    for values in ("spheres=5|6", "spheres=15|16")]
            errors = [one.communicate()[1] for one in both]
            self.assertEqual(sorted(one.returncode for one in both), [0, 2], errors)
            self.assertIn("holds another study (vary differs)", "".join(errors))
            with open(out / "results.csv", newline="", encoding="utf-8") as file:
                rows = [(row["spheres"], row["exit_code"]) for row in csv.DictReader(file)]
            self.assertEqual(rows, [("5", "0"), ("6", "0")] if both[0].returncode == 0 else [("15", "0"), ("16", "0")])
            self.assertEqual(list(out.rglob("*.lock")), [])

    def test_a_killed_study_begun_again_at_once_waits_for_its_runs(self):
        """They were still writing their checkpoints, and the new ones failed; both wrote one messages.txt."""
        if not sys.platform.startswith("linux"):
            self.skipTest("SKIPPED LOUDLY: only Linux tells a process that its parent has gone")
        plan = self.plan("run: pack\nconfig: examples/u1.yaml\nfix: [mass=60g, max_steps=12000]\nseeds: 2\n")
        runs = self.folder / "out/runs"
        with self.start(plan, "-j", "2", "-q") as study:
            while len(list(runs.glob("*.part/out/checkpoint-*"))) < 2 and study.poll() is None:
                time.sleep(0.01)
            left = [int(pid) for pid in pathlib.Path(f"/proc/{study.pid}/task/{study.pid}/children").read_text().split()]
            self.assertEqual(len(left), 2)
            for pid in left:  # a busy machine
                os.kill(pid, signal.SIGSTOP)
            study.kill()
        with self.start(plan, "-j", "2", "-q") as again:
            time.sleep(1)
            for pid in left:
                os.kill(pid, signal.SIGCONT)
            error = again.communicate()[1]
        self.assertEqual((again.returncode, error), (0, ""))
        self.assertEqual([path.read_text() for path in runs.glob("*/messages.txt")], ["", ""])

    def test_runs_share_the_memory(self):
        """--max-memory was the study's alone."""
        grain = ROOT / "data/standin63/grain00.ply"
        study = ("study", "--run", "shape", "--argument", grain, "--vary", "axes=feret|fitted", "-q", "-j", "2")
        self.assertEqual(clast(*study, "--max-memory", "300kB", "-o", self.folder / "little").code, 1)
        self.assertIn("the limit is 150 kB", (self.folder / "little/runs/000001.part/messages.txt").read_text())
        self.assertEqual(clast(*study, "--max-memory", "0", "-o", self.folder / "any").code, 0)

    def test_a_study_is_the_same_however_its_files_are_spelled(self):
        """It was another for --config ./grain.yaml."""
        (self.folder / "grain.yaml").write_text("strategy: largest\n")
        study = ("study", "--run", "fill", "--argument", ROOT / SURFACE, "--vary", "spheres=5", "-q", "-o", "out")
        for spelling in ("grain.yaml", "./grain.yaml", self.folder / "grain.yaml"):
            done = clast(*study, "--config", spelling, cwd=self.folder)
            self.assertEqual(done.code, 0, done.err)
        self.assert_fails(2, *study, "--config", "grain.yaml", "--seed", "7", cwd=self.folder, says=["holds another study (seed differs)"])
        (self.folder / "other.yaml").write_text("strategy: random\n")
        self.assert_fails(2, *study, "--config", "other.yaml", cwd=self.folder, says=["other.yaml is not the configuration"])

    def test_disks_without_flock(self):
        """Lustre, mounted without -o flock: no study ran."""
        study = ("study", "--run", "fill", "--argument", ROOT / SURFACE, "--vary", "spheres=5|6", "-q", "-o")
        flock = "#include <errno.h>\nint flock(int file, int kind) { (void)file; (void)kind; errno = ENOSYS; return -1; }\n"
        done = clast(*study, self.folder / "out", env=preload(self.folder, flock))
        self.assertEqual(done.code, 0, done.err)
        self.assertEqual([row["exit_code"] for row in self.rows()], ["0", "0"])
        fcntl = """#include <dlfcn.h>
            #include <fcntl.h>
            #include <stdarg.h>
            static int pass(const char *name, int file, int command, void *word)
            {
                if (command == F_SETLK || command == F_OFD_SETLK) { errno = ENOSYS; return -1; }
                return ((int (*)(int, int, void *))dlsym(RTLD_NEXT, name))(file, command, word);
            }
            #define PASS(name) int name(int file, int command, ...) { va_list list; va_start(list, command); \\
                void *word = va_arg(list, void *); va_end(list); return pass(#name, file, command, word); }
            PASS(fcntl) PASS(fcntl64)"""
        self.assert_fails(4, *study, self.folder / "none", env=preload(self.folder, flock + fcntl),
                          says=["study.lock: this disk has no file locks (Lustre: mount it with -o flock)"])

    def test_wanted_and_achieved_values_of_one_name_stand_side_by_side(self):
        plan = self.plan("run: pack\nfix: [form_law=true, curve=6 mm, mass=1e-6, max_steps=1, height=0.3m, width=0.1m]\n"
                         "vary: [flatness_mean = 0.5 | 0.7]\n")
        done = clast("study", plan, "-o", self.folder / "out", "--json")
        self.assertEqual(done.code, 0, done.err)
        rows = self.rows()
        self.assertEqual([row["flatness_mean"] for row in rows], ["0.5", "0.7"])
        self.assertNotEqual(float(rows[0]["result.flatness_mean"]), 0.5)  # one grain, drawn

    def test_runs_with_folders_keep_them(self):
        plan = self.plan("run: pack\nconfig: examples/u1.yaml\nfix: [mass=10g, max_steps=20]\n"
                         "vary:\n  - shapes = sphere | ellipsoid:3,2,1\n")
        done = clast("study", plan, "-o", self.folder / "out")
        self.assertEqual(done.code, 0, done.err)
        for run in ("000001", "000002"):
            self.assertTrue((self.folder / "out/runs" / run / "out/state.h5").exists())
        self.assertEqual([row["shapes"] for row in self.rows()], ["sphere", "ellipsoid:3,2,1"])

    def test_shipped_packing_studies_are_whole(self):
        """Every study of examples/packing plans its runs; no run is done (there is no thousandth)."""
        expected = {"table4": 24, "table5": 24, "table6": 21, "table7": 18, "table8": 12, "table11": 12, "forms": 378,
                    "forms-10": 10, "mixtures": 104}
        studies = [p for p in sorted((ROOT / "examples/packing").glob("*.yaml")) if p.stem not in ("cylinder", "periodic", "heavy-minerals")]
        self.assertGreater(len(studies), len(expected))
        for path in studies:
            done = clast("study", path, "-o", self.folder / path.stem, "--shard", "1000/1000", "--json")
            self.assertEqual(done.code, 0, f"{path}: {done.err}")
            self.assertEqual(done.json["n_run"], expected.pop(path.stem, done.json["n_run"]), path.stem)
        self.assertEqual(expected, {})

    def test_fit_reads_the_results_of_packings(self):
        """Seven beds of one form each; clast fit finds the forms in results.csv."""
        plan = self.plan("run: pack\nfix: [curve=6 mm, mass=8g, width=30mm, height=60mm, max_steps=45000, cut=0.95]\nvary:\n"
                         "  - shapes = " + " | ".join(f"ellipsoid:{1 + k / 5},{1 + (k * k % 7) / 40},1" for k in range(1, 8)) + "\n")
        done = clast("study", plan, "-o", self.folder / "out", "--json")
        self.assertEqual(done.code, 0, done.err)
        self.assertEqual(done.json["n_done"], 7)
        row = self.rows()[0]
        self.assertAlmostEqual(float(row["elongation_mean"]), (1 + 1 / 40) / 1.2, 12)
        fit = clast("fit", self.folder / "out/results.csv", "--target", "porosity_bulk", "--columns",
                    "flatness_mean,elongation_mean", "--n-term", 1, "--n-fold", 3, "--json")
        self.assertEqual(fit.code, 0, fit.err)
        self.assertEqual(len(fit.json["ranking"]), 26)
        porosity = [float(row["porosity_bulk"]) for row in self.rows()]
        inverse = [1 / (float(row["flatness_mean"]) * float(row["elongation_mean"])) for row in self.rows()]
        told = next(r["r"] for r in fit.json["ranking"] if r["feature"] == "inverse_equancy")
        self.assertAlmostEqual(told, statistics.correlation(inverse, porosity), 10)

    def test_bad_plans_say_so_before_any_run(self):
        plan = self.plan(f"run: fill\nargument: [{SURFACE}]\n")
        out = ["-o", self.folder / "out"]
        self.assert_fails(2, "study", plan, *out, "--vary", "sphere=1|2", says=["no key 'sphere'", "spheres"])
        self.assert_fails(2, "study", plan, *out, "--run", "fil", says=["'fil' is no command"])
        self.assert_fails(2, "study", plan, *out, "--run", "study", says=["no command that a study can run"])
        self.assert_fails(2, "study", plan, "--vary", "spheres=1|2", says=["-o FOLDER"])
        self.assert_fails(3, "study", plan, *out, "--table", self.folder / "absent.csv", says=["absent.csv"])
        # the last of the two was taken without a word
        self.assert_fails(2, "study", plan, *out, "--fix", "spheres=3", "--vary", "spheres=1|2", says=["fix: 'spheres=3'", "varies"])
        self.assert_fails(2, "study", plan, *out, "--fix", "seed=3", says=["fix: 'seed=3'", "option seed"])
        self.assert_fails(2, "study", plan, *out, "--fix", "filled=0.8", "--fix", "filled=0.9", says=["'filled=0.8'", "'filled=0.9'", "one value"])
        self.assert_fails(2, "study", plan, *out, "--table", SURFACE, f"--table={SURFACE}", says=["--table is given 2 times"])
        # every run failed
        for run, says in (("render", "writes the file that its -o names"), ("mesh simplify", "writes the file"), ("completion", "prints no numbers")):
            self.assert_fails(2, "study", "--run", run, *out, says=[f"run: clast {run}", says])
        # both varied, and the runs took the last of the two
        self.assert_fails(2, "study", "--run", "aggregate", *out, "--vary", "core-size=100um|300um", "--vary", "core_size=200um",
                          says=["'core_size' varies twice", "'core-size'"])
        # a division by 0
        header = self.folder / "header.csv"
        header.write_text("rays\n")
        self.assert_fails(3, "study", "--run", "aggregate", *out, "--table", header, says=[str(header), "a header and no rows"])
        self.assertFalse((self.folder / "out").exists())

    def test_a_result_that_no_run_has_is_named(self):
        plan = self.plan(f"run: fill\nargument: [{SURFACE}]\nvary: [spheres = 5 | 9]\nkeep: [n_sphere, filled_fraction, nothing.here]\n")
        done = clast("study", plan, "-o", self.folder / "out", "-q")
        self.assertEqual(done.code, 0)
        self.assertEqual(done.err.splitlines(), ["clast study: keep: 'nothing.here': no run's result has such a number"])
        self.assertEqual(list(self.rows()[0]), ["run", "spheres", "seed", "exit_code", "n_sphere", "filled_fraction", "nothing.here"])
        self.assertGreater(float(self.rows("times.csv")[1]["wall_s"]), 0)  # stdout names this table, which had no times

    def test_a_misspelt_result_ends_the_study_after_its_first_run(self):
        """All runs were computed before the name was told; what is repeated was run twice without a word."""
        text = f"run: fill\nargument: [{SURFACE}]\nvary: [spheres = 5 | 6 | 7 | 8 | 9]\nkeep: [fillde_fraction]\n"
        out = ["-o", self.folder / "out", "-q", "-j", 1]
        self.assert_fails(2, "study", self.plan(text), *out, says=["keep: 'fillde_fraction'", "did you mean 'filled_fraction'"])
        self.assertLessEqual(len(list((self.folder / "out/runs").glob("[0-9]*[0-9]"))), 2)
        done = clast("study", self.plan(text.replace("fillde", "filled")), *out, "--json")
        self.assertEqual((done.code, done.json["n_before"] >= 1, done.json["n_run"]), (0, True, 5), done.err)
        self.assert_fails(2, "study", self.plan(text), "-o", self.folder / "two", "--vary", "spheres=3|4|3", says=["values 1 and 3 of 'spheres' are the same", "seeds"])

    def test_a_run_that_is_named_twice_is_refused(self):
        """Two rows of a table, and 1g beside 1000mg, were run with one seed, and counted as two beds."""
        table = self.folder / "table.csv"
        study = ["study", "--run", "pack", "-o", self.folder / "out"]
        for text, says in (("friction,mass\n0.1,1g\n0.2,1g\n0.1,1g\n", "rows 1 and 3"), ("friction,mass\n0.1,1g\n0.1,1000mg\n", "rows 1 and 2"),
                           ("mass,seed\n1g,3\n2g,3\n2g,4\n1g,3\n", "rows 1 and 4")):
            table.write_text(text)
            self.assert_fails(2, *study, "--table", table, says=[f"table: {says} are the same: the same runs; option seeds repeats them"])
        self.assert_fails(2, *study, "--vary", "mass=1g|2g|1000mg", says=["vary: values 1 and 3 of 'mass' are the same ('1g', '1000mg')"])
        self.assert_fails(2, *study, "--design", "zip", "--vary", "mass=1g|1g", "--vary", "friction=0.1|0.1", says=["of 'mass' and of the others are the same"])
        self.assertFalse((self.folder / "out").exists())

    def test_a_run_that_fails_is_named(self):
        plan = self.plan("run: fill\nargument: [absent.stl]\nvary: [spheres = 5 | 9]\n")
        done = clast("study", plan, "-o", self.folder / "out")
        self.assertEqual(done.code, 1)
        self.assertIn("2 of 2 runs failed", done.err)
        self.assertIn("absent.stl", (self.folder / "out/runs/000001.part/messages.txt").read_text())
        self.assertEqual(self.rows()[0]["exit_code"], "3")

    def test_a_run_that_does_not_converge_is_a_row(self):
        """Its result is empty: results.csv and times.csv were not written, and the same call failed for ever."""
        table = self.folder / "table.csv"
        table.write_text("stages,max_load_time\nhold until time 5ms,20\nisotropic 10kPa until rest,0.02\n")
        plan = self.plan("run: pack\nfix: [mass=0.5g, curve=4mm, domain=cell, width=18mm, height=18mm, floor=false, gravity=0, fluid_density=0]\n")
        study = ["study", plan, "--table", table, "-o", self.folder / "out", "-j", 1]
        done = clast(*study)
        self.assertEqual(done.code, 0, done.err)
        self.assertIn("2 runs: 2 done now, 0 before; 1 did not converge (exit code 5)\n", done.out)
        self.assertEqual([(row["exit_code"], row["n_grain"]) for row in self.rows()], [("0", "6"), ("5", "")])
        self.assertEqual([row["wall_s"] == "" for row in self.rows("times.csv")], [False, True])
        again = clast(*study, "--json")
        self.assertEqual((again.code, again.json["n_before"], again.json["n_unconverged"]), (0, 2, 1), again.err)
        said = (self.folder / "out/runs/000002/messages.txt").read_text()  # named 000002.part
        self.assertTrue(said.endswith(f"what there is until then is in {self.folder}/out/runs/000002/out\n"), said)

    def test_a_run_that_a_signal_ended_says_so_until_it_goes_on(self):
        """messages.txt was empty; the exit code of the attempt before stayed beside the one that went on."""
        if not sys.platform.startswith("linux"):
            self.skipTest("SKIPPED LOUDLY: children are found by /proc")
        plan = self.plan("run: pack\nconfig: examples/u1.yaml\nfix: [mass=60g, shaking_time=100s, checkpoint_time=0.1]\n")
        part = self.folder / "out/runs/000001.part"
        with self.start(plan, "-j", "1", "-q") as study:
            while not list(part.glob("out/checkpoint-*")) and study.poll() is None:
                time.sleep(0.01)
            for pid in pathlib.Path(f"/proc/{study.pid}/task/{study.pid}/children").read_text().split():
                os.kill(int(pid), signal.SIGKILL)
            error = study.communicate()[1]
        self.assertEqual(study.returncode, 1, error)
        self.assertEqual(self.rows()[0]["exit_code"], "137")
        self.assertRegex((part / "messages.txt").read_text(), r"^clast study: the run was ended by signal 9 \(.*memory limit.*\)\n$")
        stopped = clast("study", plan, "-o", self.folder / "out", "-j", 1, "-q", "--time-limit", "1s")
        self.assertEqual(stopped.code, 143, stopped.err)
        self.assertEqual(self.rows()[0].get("exit_code", ""), "")

    def test_the_first_seed_is_that_of_the_configuration(self):
        """It was 1, without a word; clast fill with the configuration took 42."""
        config = self.folder / "fill.yaml"
        config.write_text("strategy: random\nseed: 42\n")
        study = ["study", "--run", "fill", "--argument", SURFACE, "--config", config, "--vary", "spheres=3", "-q"]

        def seeds(name, *words):
            done = clast(*study, *words, "-o", self.folder / name)
            self.assertEqual(done.code, 0, done.err)
            with open(self.folder / name / "plan.csv", newline="", encoding="utf-8") as file:
                return [row["seed"] for row in csv.DictReader(file)]

        self.assertEqual(seeds("one", "--seeds", 2), ["42", "43"])
        self.assertEqual(seeds("two", "--seed", 1), ["1"])
        self.assertEqual(seeds("three", self.plan("seed: 7\n")), ["7"])
        self.assert_fails(2, *study, "-o", self.folder / "two", says=["holds another study (seed differs)"])
        config.write_text("strategy: random\n")
        self.assertEqual(seeds("four"), ["1"])
        config.write_text("seed: 9007199254740993\n")
        self.assert_fails(2, *study, "-o", self.folder / "five", says=["fill.yaml:1: seed: 9007199254740993", "is outside"])

    def test_seeds_that_a_table_does_not_keep_are_refused(self):
        """Three seeds were 12345678901234568: three times one bed, and an interval of width 0."""
        study = ["study", "--run", "fill", "--argument", SURFACE, "--vary", "spheres=3", "--seeds", 3, "-q", "-o", self.folder / "out"]
        for seed in (12345678901234567, 2 ** 53):
            self.assert_fails(2, *study, "--seed", seed, says=[f"seed: {seed} is outside"])

    def test_a_configuration_is_checked_with_a_seed_too(self):
        """It was read where no seed was given alone; else each run failed by itself."""
        config = self.folder / "fill.yaml"
        config.write_text("strategie: random\n")
        for words in ((), ("--seed", 3)):
            self.assert_fails(2, "study", "--run", "fill", "--argument", SURFACE, "--config", config, "--vary", "spheres=3", *words,
                              "-o", self.folder / "out", says=["unknown key 'strategie'; did you mean 'strategy'?"])

    def test_a_shard_of_very_many(self):
        """N was added to the number of runs: with the largest the first was never run."""
        done = clast("study", "--run", "fill", "--argument", SURFACE, "--vary", "spheres=3|4", "--shard", f"1/{2 ** 63 - 1}", "-q", "--json",
                     "-o", self.folder / "out")
        self.assertEqual((done.code, done.json["n_done"], done.json["n_other"]), (0, 1, 1), done.err)

    def test_an_input_that_changed_between_shards_is_named(self):
        sizes = self.folder / "sizes.csv"
        sizes.write_text("size_mm,count\n4,50\n5,50\n")
        plan = self.plan(f'run: pack\nfix: ["curve=list:{sizes}", mass=1g, width=20mm, height=60mm, max_steps=20]\nseeds: 3\n')
        study = ["study", plan, "-o", self.folder / "out", "-j", 1, "-q"]
        self.assertEqual(clast(*study, "--shard", "1/3").code, 0)
        old = sizes.read_text()
        sizes.write_text("size_mm,count\n3,50\n5,50\n")
        table = (self.folder / "out/results.csv").read_bytes()
        self.assert_fails(2, *study, says=(str(sizes), "is not the file that run 1 of this study was made with", "put the old one back"))
        self.assertEqual((self.folder / "out/results.csv").read_bytes(), table)
        sizes.write_text(old)
        done = clast(*study)
        self.assertEqual(done.code, 0, done.err)
        self.assertEqual([row["exit_code"] for row in self.rows()], ["0"] * 3)
        sizes.unlink()  # whoever only tabulates does not need it
        self.assertEqual(clast(*study).code, 0)

    def test_a_grain_that_changed_between_shards_is_named(self):
        """Runs of shape have no manifest: the table was of two grains, without a word."""
        grain = self.folder / "grain.stl"
        grain.write_bytes((ROOT / SURFACE).read_bytes())
        study = ["study", "--run", "shape", "--argument", grain, "--vary", "axes=feret|fitted", "-o", self.folder / "out", "-q"]
        self.assertEqual(clast(*study, "--shard", "1/2").code, 0)
        grain.write_bytes((ROOT / "data/scarlet/stl/27sk21_shape_coarse.stl").read_bytes())
        self.assert_fails(2, *study, "--shard", "2/2", says=(str(grain), "is not the file that run 1 of this study was made with", "put the old one back"))
        grain.write_bytes((ROOT / SURFACE).read_bytes())
        self.assertEqual(clast(*study, "--shard", "2/2").code, 0)
        self.assertEqual([row["exit_code"] for row in self.rows()], ["0", "0"])

    def test_a_study_of_one_grain_has_its_numbers(self):
        """Its table had hull and n_grain alone."""
        done = clast("study", "--run", "shape", "--argument", SURFACE, "--fix", "unit=um", "--vary", "axes=feret|fitted", "-o", self.folder / "out", "-q", cwd=ROOT)
        self.assertEqual(done.code, 0, done.err)
        alone = clast("shape", SURFACE, "--unit", "um", "--axes", "fitted", "--json", cwd=ROOT).json["grains"][0]
        row = self.rows()[1]
        for key in ("L", "I", "S", "volume", "flatness"):
            self.assertEqual(float(row[f"grains.0.{key}"]), alone[key], key)
        self.assertEqual(float(row["grains.0.inverse.flatness"]), alone["inverse"]["flatness"])

    def test_stop_and_go_on_give_the_same_table(self):
        plan = self.plan(f"run: fill\nargument: [{SURFACE}]\nvary: [spheres = 40 | 41 | 42 | 43 | 44 | 45]\n")
        with subprocess.Popen([CLAST, "study", plan, "-o", self.folder / "out", "-q", "-j", "1"]) as study:
            until = time.time() + 60
            while not (self.folder / "out/runs/000001").exists() and time.time() < until:
                time.sleep(0.01)
            study.send_signal(signal.SIGTERM)
            self.assertIn(study.wait(60), (143, 0))
        self.assertEqual(clast("study", plan, "-o", self.folder / "out").code, 0)
        self.assertEqual(clast("study", plan, "-o", self.folder / "whole").code, 0)
        self.assertEqual((self.folder / "out/results.csv").read_bytes(),
                         (self.folder / "whole/results.csv").read_bytes())


if __name__ == "__main__":
    unittest.main()
