#!/usr/bin/env python3
"""clast pack: a small bed, stopped and resumed at any moment, bad input."""
import csv
import json
import math
import os
import pathlib
import re
import resource
import signal
import subprocess
import time
import unittest

from clitest import Case, ROOT, clast

SMALL = ["pack", "--curve", "6 mm", "--mass", "12g", "--width", "40mm", "--height", "0.1m", "--shaking-time", "0.01s",
         "--seed", "3", "--quiet", "-j", "1"]
FILES = ["state.h5", "series.csv", "profile.csv", "grains.csv", "summary.json", "energy.svg"]


class Pack(Case):
    def run_small(self, *extra):
        return clast(*SMALL, *extra)

    def test_bed_comes_to_rest(self):
        run = self.folder / "run"
        result = self.run_small("--json", "-o", run)
        self.assertEqual(result.code, 0, result.err)
        out = json.loads(result.out)
        for key in ("state_hash", "n_grain", "n_step", "time", "phase", "converged", "mass", "porosity_bulk", "coordination",
                    "wall_s", "ns_per_grain_step"):
            self.assertIn(key, out)
        self.assertEqual(out["phase"], "done")
        self.assertTrue(out["converged"])
        self.assertGreaterEqual(out["mass"], 0.012)
        self.assertLess(out["mass"], 0.0125)  # one grain of 0.3 g too many at most
        self.assertGreater(out["porosity_bulk"], 0.3)
        self.assertLess(out["porosity_bulk"], 0.7)
        for name in FILES + ["manifest.json"]:
            self.assertTrue((run / name).exists(), name)
        self.assertEqual(list(run.glob("checkpoint-*")), [])
        porosity = clast("porosity", run, "--method", "spheres", "--core", 2, "--json")
        self.assertEqual(porosity.code, 0, porosity.err)
        self.assertAlmostEqual(porosity.json["bulk"], out["porosity_bulk"], 12)
        self.assertAlmostEqual(out["wall_ratio"], 20 / 6, 12)
        self.assertAlmostEqual(porosity.json["wall_share"], out["wall_share"], 12)

    def test_grains_that_fly_are_no_bed(self):
        """A lattice in the air had a bulk porosity of 0.98, and walls their share of it."""
        words = ("pack", "--curve", "4mm", "--mass", "2g", "--width", "25mm", "--height", "0.1m", "--shaking-time", "0", "--max-steps", "20", "-q")
        said = clast(*words)
        self.assertEqual(said.code, 0, said.err)
        self.assertIn("none: there is no bed yet", said.out)
        self.assertNotIn("porosity is theirs", said.out)
        told = clast(*words, "--json").json
        self.assertEqual((told["phase"], told["porosity_none"]), ("generate", "no bed yet"))
        for name in ("porosity_bulk", "porosity_untrimmed", "porosity_least", "bed_top", "z_low", "z_high", "wall_share"):
            self.assertIsNone(told[name], name)

    def test_grains_that_touch_nothing_are_no_bed(self):
        """57 grains that fell, after the last was made, at 1 m/s had a bulk porosity of 0.974."""
        words = ("pack", "--curve", "4mm", "--mass", "5g", "--width", "30mm", "--height", "0.1m", "--shaking-time", "0", "--max-steps", "2000", "-q")
        said = clast(*words)
        self.assertEqual(said.code, 0, said.err)
        self.assertRegex(said.out, r"bulk porosity +none: there is no bed yet, more than half of the grains touch nothing")
        self.assertNotIn("porosity is theirs", said.out)
        told = clast(*words, "--json").json
        self.assertEqual((told["phase"], told["porosity_none"], told["porosity_bulk"], told["bed_top"]), ("damp", "no bed yet", None, None))

    def test_domain_open_is_a_container_alone(self):
        """It was offered and refused everywhere; the refusal left the cell out."""
        small = ("pack", "--curve", "4mm", "--mass", "1g", "--domain", "open", "--max-steps", "1", "-q")
        self.assert_fails(2, *small, says=("domain cylinder, periodic, box or cell", "container"))
        held = clast(*small, "--container", "data/standin63/grain00.ply", "--container-unit", "m", "--floor=no", "--json")
        self.assertEqual(held.code, 0, held.err)
        self.assert_fails(2, "pack", "--curve", "4mm", "--mass", "1g", "--domain", "box", "--container", "data/standin63/grain00.ply", "--container-unit", "m",
                          says=("domain does nothing with container",))
        self.assertIn("open: container alone", " ".join(clast("pack", "--help-all").out.split()))

    def test_stopped_and_killed_runs_end_in_the_same_bytes(self):
        whole = self.folder / "whole"
        self.assertEqual(self.run_small("-o", whole, "--checkpoint-time", "0.02s").code, 0)
        for number in (signal.SIGINT, signal.SIGKILL):
            run = self.folder / f"cut-{int(number)}"
            process = subprocess.Popen([os.environ["CLAST"], *SMALL, "--checkpoint-time", "0.02s", "-o", str(run)],
                                       cwd=ROOT, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            while not list(run.glob("checkpoint-0000*[1-9]*.h5")) and process.poll() is None:
                time.sleep(0.01)
            process.send_signal(number)
            process.wait()
            if process.returncode == 0:
                self.fail("the run ended before it could be stopped; make it longer")
            self.assertEqual(process.returncode, 130 if number == signal.SIGINT else -9)
            busy = self.run_small("-o", run)
            self.assertEqual(busy.code, 2)
            self.assertIn("--resume", busy.err)
            resumed = clast("pack", "--resume", run, "--quiet", "-j", "1")
            self.assertEqual(resumed.code, 0, resumed.err)
            for name in FILES:
                left = (whole / name).read_bytes()
                right = (run / name).read_bytes()
                self.assertEqual(left, right, name)

    def test_damaged_checkpoint_is_passed_over(self):
        run = self.folder / "run"
        stopped = self.run_small("-o", run, "--max-steps", "2000", "--checkpoint-time", "0s")
        self.assertEqual(stopped.code, 0, stopped.err)
        (run / "checkpoint-000000000100.h5").write_bytes(b"nothing")
        result = clast("pack", "--resume", run, "--quiet")
        self.assertEqual(result.code, 3)
        self.assertIn("damaged", result.err)

    def test_what_still_moves_is_told(self):
        # damped while they fall from rest: the mean height moves by less than 10 um in a microsecond
        early = ["--shaking-time", "0.001s", "--check-time", "5us", "--initial-speed", "0m/s", "--shake-amplitude", "0m"]
        moving = self.run_small(*early)
        self.assertEqual(moving.code, 0, moving.err)
        self.assertRegex(moving.out, r"motion +[\d.e-]+ m?m/s the fastest grain; 41 of 41 with fewer than four contacts")
        self.assertRegex(moving.out, r"phase +done \(level\)")
        self.assertRegex(moving.out, "warning +the bed was level and still moves.*--rule speed")
        as_json = self.run_small(*early, "--json").json
        self.assertEqual((as_json["still_moving"], as_json["n_loose"]), (True, 41))
        self.assertGreater(as_json["max_speed"], 0.001)
        rests = self.run_small("--rule", "speed", "--shaking-time", "0.001s")
        self.assertRegex(rests.out, r"phase +done \(at rest\)")
        self.assertRegex(rests.out, r"warning +shaking ended while grains fell: the highest sank by [\d.]+ mm.*--shaking-time")
        self.assertNotIn("still moves", rests.out)
        slow = self.run_small("--rule", "speed", "--shaking-time", "0.3s", "--json").json
        self.assertEqual((slow["still_moving"], slow["shaken_while_falling"], slow["converged"]), (False, False, True))
        self.assertLess(slow["max_speed"], 0.001)

    def test_a_bed_looser_than_the_cut_is_no_missing_bed(self):
        """'there is no bed yet' was said of a bed at rest."""
        falling = (*SMALL[:4], "4g", *SMALL[5:], "--max-steps", 1000)
        early = clast(*falling)
        self.assertRegex(early.out, r"bulk porosity +none: there is no bed yet")
        words = (*SMALL, "--shaking-time", 0, "--cut", 0.2)
        loose = clast(*words)
        self.assertEqual(loose.code, 0, loose.err)
        self.assertRegex(loose.out, r"bulk porosity +none: no slice is denser than the cut of 0\.2, the least porosity of one is 0\.\d+; .*--cut")
        self.assertNotIn("no bed yet", loose.out)
        found = clast(*words, "--json").json
        self.assertEqual((found["porosity_bulk"], found["porosity_none"]), (None, "above cut"))
        self.assertGreater(found["porosity_least"], 0.2)
        known = clast(*words[:-1], 0.9, "--json").json
        self.assertNotIn("porosity_none", known)
        self.assertGreaterEqual(known["porosity_bulk"], found["porosity_least"])
        trimmed = clast(*words[:-1], 0.9, "--trim", "0.1m", "--json").json
        self.assertEqual((trimmed["porosity_bulk"], trimmed["porosity_none"]), (None, "trimmed away"))
        self.assertEqual(clast(*falling, "--json").json["porosity_none"], "no bed yet")
        run = self.folder / "run"
        self.assertEqual(clast(*words, "-o", run, "--quiet").code, 0)
        self.assert_fails(3, "porosity", run, "--cut", 0.2, says=("cut",))

    def test_nothing_is_said_of_a_shaking_that_was_switched_off(self):
        told = clast(*SMALL, "--shaking-time", 0)
        self.assertEqual(told.code, 0, told.err)
        self.assertNotIn("--shaking-time", told.out)
        self.assertFalse(clast(*SMALL, "--shaking-time", 0, "--json").json["shaken_while_falling"])

    def test_one_grain_may_weigh_more_than_all_that_was_wanted(self):
        heavy = clast("pack", "--curve", "4mm", "--mass", "0.01g", "--width", "30mm", "--height", "0.1m", "--shaking-time", 0)
        self.assertRegex(heavy.out, r"warning +8\.88 times the mass that was asked for: 88\.8 mg one grain weighs")
        self.assertNotIn("was asked for", clast(*SMALL, "--max-steps", 10).out)

    def test_small_grains_have_a_still_speed_of_their_own(self):
        tiny = ("pack", "--curve", "16um", "--mass", "1ug", "--width", "0.3mm", "--height", "2mm", "--collision-time", "20us", "--time-step", "0.5us",
                "--spacing", "40um", "--initial-speed", "1mm/s", "--max-steps", 10)
        told = clast(*tiny)
        self.assertRegex(told.out, r"note +still_speed is 6\d\.\d diameters of the smallest grain a second.*--still-speed")
        self.assertNotIn("note ", clast(*tiny, "--still-speed", "50um/s").out)
        self.assertNotIn("note ", clast(*SMALL, "--max-steps", 10).out)

    def test_an_aggregate_packed_at_another_density_is_told(self):
        """The cookbook said that it comes with its density; it was 2650 without a word."""
        grown = self.folder / "grown"
        made = clast("aggregate", "--core", "sphere", "--core-size", "2mm", "--coat", "sphere", "--size", "1mm", "--replicate", 6, "--no-picture",
                     "--quiet", "-o", grown)
        self.assertEqual(made.code, 0, made.err)
        words = ("pack", "--curve", "4mm", "--shapes", grown / "state.h5", "--mass", "1g", "--width", "30mm", "--height", "0.1m", "--max-steps", 10)
        told = clast(*words)
        self.assertRegex(told.out, r"density +aggregates of 2500 kg/m\^3 are packed at 2650 kg/m\^3: --density 0")
        self.assertEqual(clast(*words, "--json").json["aggregate_density"], 2500)
        for density in (0, 2500):
            self.assertNotIn("are packed at", clast(*words, "--density", density).out)

    def test_contacts_have_one_count(self):
        for shape in ("sphere", "data/standin63/grain10.ply", "clump"):
            if shape == "clump":
                shape = self.folder / "clump.csv"
                shape.write_text("x,y,z,radius\n0,0,0,1\n1,0,0,0.8\n0.5,0.8,0,0.9\n")
            run = self.folder / f"run-{pathlib.Path(shape).stem}"
            made = self.run_small("--shapes", shape, "--shaking-time", "0.02s", "--json", "-o", run)
            self.assertEqual(made.code, 0, made.err)
            n, walls = made.json["n_contact"], made.json["n_wall_contact"]
            self.assertGreater(n, 20)
            self.assertAlmostEqual(made.json["coordination"], 2 * n / made.json["n_grain"], 12)
            with open(run / "series.csv", newline="", encoding="utf-8") as file:
                last = list(csv.DictReader(file))[-1]
            if int(float(last["step"])) == made.json["n_step"]:
                self.assertEqual((float(last["n_contact"]), float(last["n_wall_contact"])), (n, walls))
            looked = clast("porosity", run, "--method", "spheres", "--json", "-o", self.folder / f"of-{run.name}")
            self.assertEqual(looked.code, 0, looked.err)
            self.assertAlmostEqual(looked.json["coordination"], made.json["coordination"], 12)
            with open(run / "grains.csv", newline="", encoding="utf-8") as file:
                rows = list(csv.DictReader(file))
            self.assertEqual(len(rows), made.json["n_grain"])
            for row in rows:
                self.assertAlmostEqual(sum(float(row[k]) ** 2 for k in ("qw", "qx", "qy", "qz")), 1, 9)
                self.assertLess(math.hypot(float(row["x_m"]), float(row["y_m"])), 0.02)
            self.assertAlmostEqual(sum(float(r["z_m"]) for r in rows) / len(rows), made.json["mean_height"], 3)

    def test_forms_from_a_law_and_clumps(self):
        result = clast(*SMALL, "--shapes", "ellipsoid:3,2,1", "--form-law", "--max-steps", "3000", "--json")
        self.assertEqual(result.code, 0, result.err)
        self.assertFalse(json.loads(result.out)["converged"])
        spheres = self.folder / "clump.csv"
        spheres.write_text("x,y,z,radius\n0,0,0,1\n1,0,0,0.8\n")
        result = clast(*SMALL, "--shapes", str(spheres), "--max-steps", "6000", "--json", "-o", self.folder / "c")
        self.assertEqual(result.code, 0, result.err)

    def one_grain(self, *extra):
        """One grain of 6 mm, made and not yet fallen."""
        result = clast(*SMALL, "--mass", "1mg", "--shapes", "data/standin63/grain20.ply", "--max-steps", "1", "--json", *extra)
        self.assertEqual(result.code, 0, result.err)
        out = json.loads(result.out)
        self.assertEqual(out["n_grain"], 1)
        return out

    def test_surfaces_simplified_or_as_ellipsoids_keep_their_form(self):
        with open(ROOT / "data/standin63/grains.csv", newline="", encoding="utf-8") as file:
            row = next(r for r in csv.DictReader(file) if r["file"] == "grain20.ply")
        length, width, height, volume = (float(row[k]) for k in ("L", "I", "S", "volume"))
        surface, egg, coarse = self.one_grain(), self.one_grain("--ellipsoids"), self.one_grain("--faces", "50")
        self.assertAlmostEqual(surface["mass"], 2650 * volume * 0.006**3, 12)
        self.assertAlmostEqual(egg["mass"], 2650 * math.pi / 6 * length * width * height * 0.006**3, 12)
        self.assertNotEqual(coarse["state_hash"], surface["state_hash"])
        self.assertAlmostEqual(coarse["flatness_mean"], surface["flatness_mean"], delta=0.02)
        for out in (surface, egg):
            self.assertAlmostEqual(out["flatness_mean"], float(row["flatness"]), 9)
            self.assertAlmostEqual(out["elongation_mean"], float(row["elongation"]), 9)
            self.assertEqual(out["flatness_deviation"], 0)

    def test_hulls_are_the_default_and_say_what_they_add(self):
        # a pyramid of volume 2/3 on its tip whose lid is pushed in by half its height: V = 1/3
        surface = self.folder / "dented.obj"
        surface.write_text("v 1 0 0\nv 0 1 0\nv -1 0 0\nv 0 -1 0\nv 0 0 -0.5\nv 0 0 -1\n"
                           "f 1 2 5\nf 2 3 5\nf 3 4 5\nf 4 1 5\nf 2 1 6\nf 3 2 6\nf 4 3 6\nf 1 4 6\n")
        run = self.folder / "hull"
        few = ["--mass", "1mg", "--max-steps", "1"]
        out = clast(*SMALL, *few, "--shapes", surface, "--json", "-o", run)
        self.assertEqual(out.code, 0, out.err)
        (hull,) = out.json["hulls"]
        self.assertEqual(hull["shape"], "1-dented.obj")
        self.assertAlmostEqual(hull["volume_added"], 1.0, 12)
        self.assertEqual(json.loads((run / "summary.json").read_text())["hulls"], out.json["hulls"])
        words = clast(*SMALL, *few, "--shapes", surface).out
        self.assertIn("its hull adds 100.000 % of volume", words)
        self.assert_fails(3, *SMALL, *few, "--shapes", surface, "--no-hull", says=("not convex", "hull: yes"))
        convex = clast(*SMALL, *few, "--shapes", ROOT / "data/standin63/grain20.ply", "--no-hull", "--json")
        self.assertEqual((convex.code, convex.json["hulls"]), (0, []), convex.err)

    def test_hulls_of_open_surfaces_add_an_unknown_volume(self):
        opened = self.folder / "open.obj"
        opened.write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\n")
        out = clast(*SMALL, "--mass", "1mg", "--max-steps", "1", "--shapes", opened, "--json")
        self.assertEqual(out.code, 0, out.err)
        self.assertIsNone(out.json["hulls"][0]["volume_added"])

    def test_a_seed_with_a_grain_too_large_is_refused_before_the_first_step(self):
        # two sizes by number: the large ones come late, but are told at once
        curve = self.folder / "two.csv"
        curve.write_text("size_mm\n" + "4\n" * 400 + "30\n")
        self.assert_fails(3, "pack", "--curve", f"list:{curve}", "--mass", "0.2kg", "--domain", "periodic", "--width", "30.2mm",
                          "--height", "0.5m", "--quiet", says=("has a bounding diameter of 30 mm", "more than the period", "seed"))

    def test_a_form_too_wide_is_refused_before_the_first_step(self):
        law = ["pack", "--curve", "4mm", "--mass", "8g", "--height", "0.2m", "--form-law", "--flatness-mean", "0.9", "--flatness-deviation", "0.05",
               "--elongation-mean", "0.8", "--elongation-deviation", "0.2", "--shaking-time", "0", "--quiet", "-j", "1"]
        periodic = ["--domain", "periodic", "--width", "12mm", "--trim", "0", "--seed", "6"]
        run = self.folder / "run"
        for shape, options, says in (("ellipsoid:1,1,1", ["--width", "11mm", "--seed", "1"], "grain 46 of this seed has a bounding diameter of 11.5807 mm"),
                                     ("ellipsoid:1,1,1", periodic, "grain 22 of this seed has a bounding diameter of 14.4653 mm"),
                                     (ROOT / "data/standin63/grain10.ply", periodic, "grain 22 of this seed has a bounding diameter of 16.216 mm")):
            self.assert_fails(3, *law, *options, "--shapes", shape, "-o", run, says=(says, "take a wider domain"))
            self.assertFalse(run.exists())

    def test_bad_input_is_one_line(self):
        self.assert_fails(2, *SMALL, "--time-step", "1e-4s", says=("time_step", "6.31935 us or less", "contact_scheme exact"))
        self.assert_fails(2, *SMALL, "--mass", "5kg", says=("cannot fit",))
        self.assert_fails(2, *SMALL, "--gravity=-9.81", says=("gravity",))  # grains flew out of the open top
        self.assert_fails(2, *SMALL, "--layer", "10nm", says=("1e+07 slices", "layer"))  # known before the run, not after it
        self.assert_fails(3, *SMALL, "--domain", "periodic", "--width", "5mm", "--mass", "1g", says=("more than the period",))
        self.assert_fails(2, *SMALL, "--shape-weight", "1", "--shape-weight", "2", says=("2 weights for 1 shapes",))
        self.assert_fails(3, *SMALL, "--shapes", str(self.folder / "none.stl"), says=("shapes",))
        self.assert_fails(2, *SMALL, "--domain", "open", says=("sides",))
        self.assert_fails(3, *SMALL, "--curve", "U9", says=("U9",))
        self.assert_fails(2, "pack", "--resume", str(self.folder), "--mass", "2kg", says=("drop mass",))
        self.assert_fails(3, "pack", "--resume", str(self.folder), says=("no checkpoint",))

    def test_full_disk_leaves_the_last_good_checkpoint(self):
        def limit():  # files of at most 40 kB: what a full disk answers, without the rights to mount one
            resource.setrlimit(resource.RLIMIT_FSIZE, (40000, 40000))

        whole = self.run_small("--json")
        run = self.folder / "full"
        full = subprocess.run([os.environ["CLAST"], *SMALL, "--checkpoint-time", "0.02s", "-o", str(run)], cwd=ROOT,
                              preexec_fn=limit, capture_output=True, text=True, check=False)
        self.assertEqual(full.returncode, 4, full.stderr)
        self.assertIn("cannot write", full.stderr)
        self.assertFalse((run / "state.h5").exists())
        resumed = clast("pack", "--resume", run, "--quiet", "-j", "1", "--json")
        self.assertEqual(resumed.code, 0, resumed.err)
        self.assertEqual(json.loads(resumed.out)["state_hash"], json.loads(whole.out)["state_hash"])

    def test_changed_shape_is_refused_at_resume(self):
        spheres = self.folder / "clump.csv"
        spheres.write_text("x,y,z,radius\n0,0,0,1\n1,0,0,0.8\n")
        run = self.folder / "run"
        process = subprocess.Popen([os.environ["CLAST"], *SMALL, "--shapes", str(spheres), "-o", str(run)], cwd=ROOT,
                                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        while not list(run.glob("checkpoint-*.h5")) and process.poll() is None:
            time.sleep(0.01)
        process.kill()
        process.wait()
        spheres.write_text("x,y,z,radius\n0,0,0,1\n1,0,0,0.9\n")
        self.assert_fails(3, "pack", "--resume", str(run), says=("clump.csv", "not the one"))

    def test_density_is_one_for_all_or_one_each(self):
        pair = ["--shapes", "sphere", "--shapes", "ellipsoid:1,1,0.5", "--max-steps", "1", "--spacing", "8mm", "--json"]
        volume = {"1-sphere": math.pi / 6 * 0.006**3, "2-ellipsoid:1,1,0.5": None}
        # sieve size D = sqrt(2 (b^2 + c^2)) of semi-axes: b = 2 c
        c = 0.006 / math.sqrt(2 * 5)
        volume["2-ellipsoid:1,1,0.5"] = 4 / 3 * math.pi * 4 * c**3
        config = self.folder / "bed.yaml"
        config.write_text("density: [2000 kg/m^3, 5 g/cm3]\n")
        for words, density in (((), (2650, 2650)), (("--density", "2000"), (2000, 2000)),
                               (("--density", "2000", "--density", "5 g/cm3"), (2000, 5000)), ((config,), (2000, 5000))):
            run = self.folder / f"run-{len(words)}-{density[1]}"
            made = clast("pack", *(words if words[:1] == (config,) else ()), *SMALL[1:], *(words if words[:1] != (config,) else ()),
                         *pair, "-o", run)
            self.assertEqual(made.code, 0, made.err)
            with open(run / "grains.csv", newline="", encoding="utf-8") as file:
                shapes = [row["shape"] for row in csv.DictReader(file)]
            self.assertEqual(set(shapes), set(volume))
            wanted = sum(volume[s] * density[s.startswith("2")] for s in shapes)
            self.assertAlmostEqual(made.json["mass"] / wanted, 1, 12)
        self.assert_fails(2, *SMALL, "--density", "1", "--density", "2", says=("2 densities for 1 shapes",))
        self.assert_fails(2, *SMALL, *pair[:4], "--density", "2650", "--density", "900", says=("900 kg/m^3 do not sink",))

    def rows(self, path):
        with open(path, newline="", encoding="utf-8") as file:
            return list(csv.DictReader(file))

    def test_density_goes_with_the_size(self):
        bed = ["--width", "0.1m", "--height", "1m", "--mass", "0.5kg", "--max-steps", "1", "--json"]
        # by class: the curve's shares are of mass, so the heavy class has fewer grains
        sieve = self.folder / "curve.csv"
        sieve.write_text("sieve_mm,retained\n4,0.5\n5,0.5\n6,0\n")
        by_class = ["--curve", sieve, "--density", "5000", "--density", "2500", "--density-of", "class"]
        run = self.folder / "class"
        made = clast("pack", *by_class, *bed, "--spread", "means", "-o", run)
        self.assertEqual(made.code, 0, made.err)
        mass = {5000.0: 0.0, 2500.0: 0.0}
        for row in self.rows(run / "grains.csv"):
            size, density = float(row["sieve_size_m"]), float(row["density_kg/m^3"])
            self.assertEqual(density, 5000 if size < 0.005 else 2500)
            mass[density] += density * math.pi / 6 * size**3
        self.assertAlmostEqual(sum(mass.values()) / made.json["mass"], 1, 9)
        share = mass[5000.0] / made.json["mass"]
        self.assertAlmostEqual(share, 0.5, delta=0.06)  # by volume alone it would be 2/3
        achieved = [float(row["achieved_mass"]) for row in self.rows(run / "achieved.csv") if float(row["wanted_mass"]) > 0]
        self.assertAlmostEqual(achieved[0], share, 9)
        self.assert_fails(2, "pack", *by_class[:4], *by_class[6:], *bed, says=("1 densities for 2 classes",))
        # by row of a list, in the unit that its column names; masses are divided by it
        sizes = self.folder / "sizes.csv"
        sizes.write_text("size_mm,mass,density_g/cm3\n5,1,2.65\n5,1,5.3\n6,2,2.65\n")
        run = self.folder / "list"
        made = clast("pack", "--curve", f"masses:{sizes}", "--density-of", "list", *bed, "-o", run)
        self.assertEqual(made.code, 0, made.err)
        kinds = {}
        for row in self.rows(run / "grains.csv"):
            kind = (round(float(row["sieve_size_m"]), 9), float(row["density_kg/m^3"]))
            kinds[kind] = kinds.get(kind, 0) + 1
        self.assertEqual(set(kinds), {(0.005, 2650.0), (0.005, 5300.0), (0.006, 2650.0)})
        self.assertAlmostEqual(kinds[0.005, 2650.0] / kinds[0.005, 5300.0], 2, delta=0.8)
        sizes.write_text("size_mm,density\n5,-1\n")
        self.assert_fails(3, "pack", "--curve", f"list:{sizes}", "--density-of", "list", *bed, says=("sizes.csv:2", "'-1'"))
        sizes.write_text("size_mm\n5\n")
        self.assert_fails(2, "pack", "--curve", f"list:{sizes}", "--density-of", "list", *bed, says=("column density",))

    def test_volume_diameters_as_sieve_sizes_are_noted(self):
        sizes = self.folder / "sizes.csv"
        sizes.write_text("volume_diameter_mm\n2\n3\n")
        bed = ("--curve", f"list:{sizes}", "--mass", "1g", "--width", "2cm", "--height", "6cm", "--max-steps", 1)
        form = ("--shapes", "ellipsoid:1,0.5,0.3")
        for words, n in ((form, 1), ((*form, "--size-meaning", "volume"), 0), ((), 0)):
            result = clast("pack", *bed, *words)
            self.assertEqual((result.code, result.err.count("column 'volume_diameter_mm'")), (0, n), result.err)

    def test_first_example_warns_of_nothing(self):
        made = clast("pack", "examples/u1.yaml", "-q", cwd=ROOT)
        self.assertEqual(made.code, 0, made.err)
        self.assertNotIn("warning", made.out)

    def test_example_of_heavy_minerals(self):
        # higher, so that one fill makes all of its grains
        run = self.folder / "heavy"
        made = clast("pack", "examples/packing/heavy-minerals.yaml", "--height", "0.3m", "--max-steps", "1", "--json", "-o", run, cwd=ROOT)
        self.assertEqual(made.code, 0, made.err)
        density = [float(row["density_kg/m^3"]) for row in self.rows(run / "grains.csv")]
        self.assertEqual(set(density), {2650.0, 4700.0})
        self.assertGreater(len(density), 400)
        self.assertAlmostEqual(density.count(4700.0) / len(density), 0.1, delta=3 * math.sqrt(0.09 / len(density)))
        self.assertGreaterEqual(made.json["mass"], 1e-3)

    def test_kills_at_any_moment_lose_nothing(self):
        # checkpoints all the time, so that most kills hit one
        kept = self.folder / "whole"
        whole = self.run_small("--checkpoint-time", "0s", "--json", "-o", kept)
        run = self.folder / "run"
        first = [os.environ["CLAST"], *SMALL, "--checkpoint-time", "0s", "-o", str(run)]
        again = [os.environ["CLAST"], "pack", "--resume", str(run), "--quiet", "-j", "1"]
        killed = 0
        for wait in (0.05, 0.03, 0.07, 0.02, 0.045, 0.06, 0.025, 0.055):
            going = again if list(run.glob("checkpoint-*.h5")) else first
            process = subprocess.Popen(going, cwd=ROOT, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            time.sleep(wait)
            while not list(run.glob("checkpoint-*.h5")) and process.poll() is None:
                time.sleep(0.001)
            process.kill()
            process.wait()
            killed += process.returncode == -9
        self.assertGreater(killed, 3)
        resumed = clast("pack", "--resume", run, "--quiet", "-j", "1", "--json")
        self.assertEqual(resumed.code, 0, resumed.err)
        self.assertEqual(resumed.json["state_hash"], whole.json["state_hash"])
        self.assertEqual([p.name for p in run.iterdir() if "checkpoint" in p.name], [])
        for name in ("series.csv", "grains.csv", "profile.csv", "summary.json"):
            self.assertEqual((run / name).read_bytes(), (kept / name).read_bytes(), name)
        self.assertEqual((run / "state.h5").read_bytes(), (kept / "state.h5").read_bytes())
        self.assert_fails(3, "pack", "--resume", run, says=("no checkpoint", "has ended"))

    def test_an_early_end_goes_on(self):
        whole, far = self.folder / "whole", self.folder / "far"
        self.assertEqual(self.run_small("-o", whole).code, 0)
        self.assertEqual(self.run_small("--max-steps", "3000", "-o", far).code, 0)
        for steps in ("1300", "2000"):  # between two rows of the series, and at one
            run = self.folder / f"run-{steps}"
            self.assertEqual(self.run_small("--max-steps", steps, "-o", run).code, 0)
            self.assert_fails(2, "pack", "--resume", run, "--max-steps", steps, says=(f"done {steps} steps", "--max-steps"))
            for more, wanted in ((("--max-steps", "3000"), far), ((), whole)):
                again = clast("pack", "--resume", run, *more, "--quiet", "-j", "1")
                self.assertEqual(again.code, 0, again.err)
                for name in ("state.h5", "series.csv", "grains.csv", "summary.json"):
                    self.assertEqual((run / name).read_bytes(), (wanted / name).read_bytes(), f"{name}, {steps} {more}")
        self.assert_fails(3, "pack", "--resume", run, says=("no checkpoint", "has ended"))
        # one that was stopped takes a later end, too
        run = self.folder / "cut"
        process = subprocess.Popen([os.environ["CLAST"], *SMALL, "--max-steps", "9000", "--checkpoint-time", "0s", "-o", str(run)],
                                   cwd=ROOT, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        while not (run / "checkpoint-000000000000.h5").exists() and process.poll() is None:
            pass
        process.kill()
        process.wait()
        again = clast("pack", "--resume", run, "--max-steps", "3000", "--quiet")
        self.assertEqual(again.code, 0, again.err)
        self.assertEqual(sorted(p.name for p in run.glob("checkpoint-*")), [])

    def test_exact_steps_and_rolling_springs_go_on(self):
        options = ("--contact-scheme", "exact", "--time-step", "10us", "--rolling-friction", "0.1", "--rolling-model", "spring")
        for more in (options[:4], options):  # in lanes, and one by one
            far, run = self.folder / "far", self.folder / "run"
            self.assertEqual(self.run_small(*more, "--max-steps", "9000", "-o", far, "--force").code, 0)
            self.assertEqual(self.run_small(*more, "--max-steps", "8500", "-o", run, "--force").code, 0)
            again = clast("pack", "--resume", run, "--max-steps", "9000", "--quiet", "-j", "1")
            self.assertEqual(again.code, 0, again.err)
            self.assertEqual((run / "summary.json").read_bytes(), (far / "summary.json").read_bytes())
            self.assertGreater(json.loads((far / "summary.json").read_text())["n_wall_contact"], 0)

    def test_results_that_cannot_be_written_come_when_gone_on_with(self):
        far, run = self.folder / "far", self.folder / "run"
        self.assertEqual(self.run_small("--max-steps", "3000", "-o", far).code, 0)
        self.assertEqual(self.run_small("--max-steps", "2000", "-o", run).code, 0)
        (run / "series.csv").unlink()
        (run / "series.csv").mkdir()  # state.h5 comes before it
        self.assert_fails(4, "pack", "--resume", run, "--max-steps", "3000", says=("series.csv",))
        self.assertEqual((run / "state.h5").read_bytes(), (far / "state.h5").read_bytes())
        (run / "series.csv").rmdir()
        again = clast("pack", "--resume", run, "--max-steps", "3000", "--quiet", "-j", "1")
        self.assertEqual(again.code, 0, again.err)
        for name in ("state.h5", "series.csv", "grains.csv", "summary.json"):
            self.assertEqual((run / name).read_bytes(), (far / name).read_bytes(), name)
        self.assertEqual(sorted(p.name for p in run.glob("checkpoint-*")), [])
        self.assert_fails(2, "pack", "--resume", run, "--max-steps", "3000", says=("done 3000 steps",))

    def test_a_run_is_replaced_only_by_force(self):
        run = self.folder / "run"
        two, three = ["--max-steps", "200"], ["--max-steps", "300"]
        self.assertEqual(self.run_small(*two, "--frame-time", "0.5ms", "-o", run).code, 0)
        (run / "note.txt").write_text("mine")
        before = {p: p.read_bytes() for p in run.rglob("*") if p.is_file()}
        self.assertIn(run / "frames" / "frame-000002.vtu", before)
        self.assert_fails(2, *SMALL, *three, "-o", run, says=("holds a finished run", "--force"))
        self.assertEqual({p: p.read_bytes() for p in run.rglob("*") if p.is_file()}, before)
        self.assertEqual(self.run_small(*three, "--force", "-o", run).code, 0)
        fresh = self.folder / "fresh"
        self.assertEqual(self.run_small(*three, "-o", fresh).code, 0)
        self.assertEqual(sorted(p.name for p in run.iterdir()), sorted([p.name for p in fresh.iterdir()] + ["note.txt"]))
        self.assertEqual((run / "state.h5").read_bytes(), (fresh / "state.h5").read_bytes())
        self.assertIn("--force", json.loads((run / "manifest.json").read_text())["command_line"])
        self.assert_fails(2, *SMALL, *three, "--force", says=("no output folder",))
        self.assert_fails(2, "pack", "--resume", run, "--force", says=("drop force",))
        spheres = ["aggregate", "--core", "sphere", "--core-size", "200um", "--coat", "sphere", "--size", "100um", "--replicate", "2", "--quiet"]
        self.assert_fails(2, *spheres, "-o", run, says=("holds a finished run",))
        self.assertEqual(clast(*spheres, "--force", "-o", run).code, 0)
        self.assertFalse((run / "series.csv").exists())
        self.assert_fails(2, *SMALL, *three, "-o", run, says=("holds a finished run",))

    def test_balls_in_a_container_go_on_in_the_same_bytes(self):
        bed = ["pack", "--container", self.cup(), "--container-unit", "mm", "--curve", "8 mm", "--mass", "10g", "--shapes", "sphere", "-j", "1",
               "--shapes", ROOT / "data/standin63/grain05.ply", "--verify", "100", "--quiet"]
        whole, run = self.folder / "whole", self.folder / "run"
        self.assertEqual(clast(*bed, "--max-steps", "24000", "-o", whole).code, 0)
        self.assertEqual(clast(*bed, "--max-steps", "14000", "-o", run).code, 0)
        again = clast("pack", "--resume", run, "--max-steps", "24000", "--quiet", "-j", "1")
        self.assertEqual(again.code, 0, again.err)
        self.assertGreater(json.loads((whole / "summary.json").read_text())["verified"]["n"], 0)
        for name in ("state.h5", "series.csv", "summary.json"):
            self.assertEqual((run / name).read_bytes(), (whole / name).read_bytes(), name)

    def test_frames_at_every_step(self):
        run = self.folder / "run"
        result = self.run_small("--max-steps", "150", "--frame-time", "5us", "-o", run)  # more rounds than bits of their length
        self.assertEqual(result.code, 0, result.err)
        self.assertEqual(len(list((run / "frames").glob("*.vtu"))), 150)

    def listed(self, run):
        """Time and file of each entry of frames.pvd; every file is there, and none is left out."""
        entries = re.findall(r'timestep="([^"]*)"[^>]*file="([^"]*)"', (run / "frames.pvd").read_text())
        self.assertEqual([name for _, name in entries], sorted(f"frames/{p.name}" for p in (run / "frames").iterdir()))
        return [(float(t), name) for t, name in entries]

    def test_collection_lists_the_frames_that_were_written(self):
        # 0.012 ms are 2.4 steps: a frame every 2 steps, 10 us apart; the first fill comes before the first frame
        run = self.folder / "run"
        result = self.run_small("--max-steps", "25", "--frame-time", "12us", "-o", run)
        self.assertEqual(result.code, 0, result.err)
        self.assertIn("12, every 10 us of the simulation", result.out)
        listed = self.listed(run)
        self.assertEqual([name for _, name in listed], [f"frames/frame-{k:06}.vtu" for k in range(1, 13)])
        for k, (at, _) in enumerate(listed, 1):
            self.assertAlmostEqual(at, k * 1e-5, 12)
        again = clast("pack", "--resume", run, "--max-steps", "40", "--json", "--quiet")
        self.assertEqual((again.code, again.json["n_frame"], len(self.listed(run))), (0, 20, 20), again.err)
        none = self.folder / "none"
        result = self.run_small("--max-steps", "25", "--frame-time", "1s", "-o", none)
        self.assertIn("none: the run ended before the first, at 1 s", result.out)
        self.assertEqual((result.code, list(none.glob("frames*"))), (0, []), result.err)

    def test_collection_of_a_stopped_or_failed_run_lists_its_frames(self):
        run, failed = self.folder / "run", self.folder / "failed"
        process = subprocess.Popen([os.environ["CLAST"], *SMALL, "--frame-time", "1ms", "-o", str(run)], cwd=ROOT,
                                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        while not (run / "frames" / "frame-000003.vtu").exists() and process.poll() is None:
            time.sleep(0.01)
        process.send_signal(signal.SIGINT)
        self.assertEqual(process.wait(), 130)
        self.assertGreaterEqual(len(self.listed(run)), 3)
        self.assertEqual(self.run_small("--max-damping-time", "0s", "--height-change", "0m", "--frame-time", "9ms", "-o", failed).code, 5)
        self.assertGreaterEqual(len(self.listed(failed)), 1)

    def test_options_without_effect_are_refused(self):
        small = self.cup()
        for options, says in ((("--young", "1e6"), "law hertz"), (("--law", "hertz", "--collision-time", "1ms"), "law linear"),
                              (("--flatness-mean", "0.5"), "form_law"), (("--cohesion", "jkr"), "surface_energy"),
                              (("--cohesion", "area"), "cohesion_energy"), (("--depth", "10mm"), "cylinder"),
                              (("--container-unit", "mm"), "without container"), (("--frame-time", "1ms"), "-o"),
                              (("--container", small, "--container-unit", "mm", "--domain", "box"), "domain does nothing with container"),
                              (("--wall-friction", "-0.5"), "it is -1"), (("--trim", "-0.5m"), "it is -1"),
                              (("--first-low", "0.5", "--first-high", "0.3"), "first_high"), (("--resume", ""), "empty"),
                              (("--spacing", "1m"), "smaller spacing"), (("--spacing", "1e-308m"), "tenth of the smallest"),
                              (("--spacing", "0.81mm", "--width", "1m", "--height", "1m"), "larger spacing"), (("--shapes", "ellipsoid:1,1,1e-9"), "larger grains")):
            self.assert_fails(2, "pack", "--curve", "8 mm", "--mass", "4g", "--max-steps", "10", *options, says=(says,))

    def test_options_that_a_run_would_not_look_at_are_refused(self):
        """Each was taken, and the state hash was that without it; beside what it acts on it is still taken."""
        clump, start = self.folder / "clump.csv", self.folder / "start.csv"
        clump.write_text("x,y,z,radius\n0,0,0,1\n0.8,0,0,0.7\n")
        start.write_text("x,y,z,d\n0,0,4,6\n")
        grain = ROOT / "data/standin63/grain10.ply"
        one = ["pack", "--curve", "6 mm", "--mass", "1g", "--width", "40mm", "--height", "0.1m", "--max-steps", "5", "--first-low", "0.1", "-q"]
        curve = [*one[:1], "--curve", "U1", *one[3:]]
        egg, clumps, hulls = ["--shapes", "ellipsoid:1.2,1,0.8"], ["--shapes", clump], ["--shapes", grain]
        begun = ["pack", "--start", start, "--start-unit", "mm", "--width", "40mm", "--height", "0.1m", "--max-steps", "5", "-q"]
        cell = ["pack", "--curve", "4mm", "--mass", "1g", "--domain", "cell", "--width", "20mm", "--height", "20mm", "--floor=no", "--gravity", "0",
                "--max-steps", "30", "-q"]
        lid = [*one, "--lid", "--wall", "lid"]
        spheres, no_surface = "with spheres, whose sizes and moments are one", "without a surface among shapes"
        brought = "with start, which brings the grains"
        for command, option, why, acts in (
                (one, ("--rounding", "0.1mm"), "without surfaces", [*one, *hulls]), ([*one, *clumps], ("--rounding", "0.1mm"), "without surfaces", None),
                (one, ("--clump-contacts", "each"), "without clumps and aggregates", [*one, *clumps]),
                (one, ("--faces", "100"), no_surface, [*one, *hulls]), ([*one, *clumps], ("--faces", "100"), no_surface, None),
                (one, ("--no-hull",), no_surface, None), ([*one, *hulls, "--faces", "50"], ("--no-hull",), "with faces, which take hulls", None),
                (one, ("--unit", "mm"), no_surface, [*one, *hulls]), ([*one, *egg], ("--unit", "mm"), no_surface, None),
                (one, ("--ellipsoids",), "without a surface or clump among shapes", [*one, *clumps]),
                (one, ("--gyroscopic=no",), spheres, [*one, *egg]), (one, ("--size-meaning", "volume"), spheres, [*one, *egg]),
                (one, ("--verify", "10"), "with spheres, whose contacts have no warm start", [*one, "--form-law"]),
                ([*one, "--fluid-viscosity", "1e-3", *egg], ("--sphere-drag", "standard"), "without spheres", [*one, "--fluid-viscosity", "1e-3"]),
                (one, ("--shape-weight", "2"), "with one shape", None), (one, ("--flatness-mean", "0.5"), "without form_law", [*one, "--form-law"]),
                (one, ("--spread", "means"), "without a sieve curve", curve), (one, ("--count", "exact"), "without a sieve curve", curve),
                ([*one, "--shake-amplitude", "0"], ("--shake-period", "1s"), "with shake_amplitude 0", one),
                ([*one, "--shake-amplitude", "0"], ("--shake-from-start=no",), "with shake_amplitude 0", one),
                ([*one, "--shaking-time", "0", "--no-shake-from-start"], ("--shake-amplitude", "1mm"), "without a time of shaking", one),
                ([*one, "--generator", "shelf"], ("--spacing", "8mm"), "with generator shelf", one),
                (one, ("--density-of", "chance"), "with one density to draw from", None), (one, ("--density-weight", "1"), "without density_of chance", None),
                (one, ("--checkpoint-time", "1s"), "without an output folder (-o)", None), (one, ("--material", "glass"), "without contacts", None),
                *((begun, option, brought, None) for option in (
                    ("--spread", "means"), ("--count", "exact"), ("--size-meaning", "volume"), ("--random-turn=no",), ("--seed", "2"),
                    ("--density-weight", "1"), ("--mass", "2g"))),
                (begun, ("--unit", "mm"), no_surface, None), (begun, ("--hull=no",), no_surface, None),
                ([*begun, "--shaking-time", "0"], ("--shake-amplitude", "1mm"), "without a time of shaking", begun),
                ([*cell, "--stages", "z=1/s until strain 0.01"], ("--load-rate", "2/s"), "without a stage that presses", [*cell, "--stages", "z=1kPa"]),
                ([*cell, "--stages", "isotropic 1kPa until time 1s"], ("--load-rest", "0.1"), "without a stage until rest", [*cell, "--stages", "z=1kPa"]),
                ([*cell, "--stages", "isotropic 1kPa until time 1s"], ("--load-tolerance", "0.1"), "without a stage that ends when its pressure",
                 [*cell, "--stages", "isotropic 1kPa until stress"]),
                ([*cell, "--stages", "isotropic 1kPa until time 1s"], ("--max-load-time", "1s"), "with stages that all end by a time",
                 [*cell, "--stages", "isotropic 1kPa until strain 1"]),
                ([*lid, "--stages", "lid=-1mm/s until way 1mm"], ("--load-rate", "2/s"), "without a stage that presses", [*lid, "--stages", "lid=1kPa"]),
                ([*lid, "--stages", "lid=1kPa until time 1s"], ("--load-rest", "0.1"), "without a stage until rest", [*lid, "--stages", "lid=1kPa"])):
            name = option[0].split("=")[0].replace("--no-", "--")[2:].replace("-", "_")
            self.assert_fails(2, *command, *option, says=(f"{name} does nothing {why}",))
            for taken in [command] + ([[*acts, *option]] if acts else []):
                made = clast(*taken)
                self.assertEqual(made.code, 0, made.err)

    def test_killed_before_the_first_grain_it_goes_on(self):
        whole = self.run_small("--json")
        run = self.folder / "run"
        process = subprocess.Popen([os.environ["CLAST"], *SMALL, "-o", str(run)], cwd=ROOT, stdout=subprocess.DEVNULL,
                                   stderr=subprocess.DEVNULL)
        while not (run / "checkpoint-000000000000.h5").exists() and process.poll() is None:
            pass
        process.kill()
        process.wait()
        self.assertEqual([p.name for p in run.glob("checkpoint-*")], ["checkpoint-000000000000.h5"])
        resumed = clast("pack", "--resume", run, "--quiet", "-j", "1", "--json")
        self.assertEqual(resumed.code, 0, resumed.err)
        self.assertEqual(resumed.json["state_hash"], whole.json["state_hash"])

    def test_grains_without_volume_are_refused(self):
        flat = self.folder / "flat.obj"
        flat.write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 2 3\nf 2 4 3\n")
        self.assert_fails(3, *SMALL, "--shapes", flat, says=("flat.obj",))
        self.assert_fails(3, *SMALL, "--shapes", flat, "--no-hull", says=("flat.obj", "lie in one plane"))
        self.assert_fails(2, *SMALL, "--shapes", "ellipsoid:1,1,0", says=("three numbers above 0",))

    def test_contacts_too_soft_for_their_load_end_with_a_line(self):
        soft = ("--collision-time", "8ms", "--initial-speed")
        self.assert_fails(5, *SMALL, *soft, "0.7m/s", says=("explodes in step", "contacts too soft"))
        self.assert_fails(2, *SMALL, *soft, "0.8m/s", says=("stop no more than", "lower initial_speed"))

    def test_fine_grains_are_told_which_constants_suit(self):
        fine = ["pack", "--curve", "0.2mm", "--mass", "0.2mg", "--width", "2mm", "--height", "10mm", "--shaking-time", "0s", "--seed", "3",
                "--quiet", "-j", "1", "--max-steps", "20000"]
        self.assert_fails(2, *fine, says=("contacts of the smallest grain (200 um) stop no more than 973.765 mm/s",
                                          "collision_time (100 us suits a fall through the height) with time_step 2.5 us"))
        told = clast(*fine, "--collision-time", "100us", "--time-step", "2.5us")
        self.assertEqual(told.code, 0, told.err)

    def test_a_unit_against_the_file_s_own_is_refused(self):
        surface = self.folder / "mm.stl"
        clast("mesh", "convert", ROOT / "data/standin63/grain10.ply", "--unit", "mm", "-o", surface)
        self.assert_fails(2, *SMALL, "--shapes", surface, "--unit", "um", says=("mm.stl says that it is in mm, not in um",))

    def test_trimmed_away_says_what_to_do(self):
        result = clast("pack", "--domain", "periodic", "--width", "40mm", "--height", "0.1m", "--curve", "6 mm", "--mass", "30g",
                       "--shaking-time", "0s", "--quiet")
        self.assertEqual(result.code, 0, result.err)
        self.assertRegex(result.out, r"none: the bed is [\d.]+ mm high and 31.5 mm are left out at both ends; give a smaller --trim")
        self.assertRegex(result.out, "side walls +none: the bed is periodic")

    def cup(self):
        """A hexagonal cup with a bottom and no lid, 80 mm wide above and 50 mm below, off the axis."""
        ring = [(math.cos(k * math.pi / 3), math.sin(k * math.pi / 3)) for k in range(6)]
        vertices = [(25 * x + 100, 25 * y, 0) for x, y in ring] + [(40 * x + 100, 40 * y, 90) for x, y in ring]
        vertices.append((100, 0, 0))
        faces = []
        for i in range(6):
            j = (i + 1) % 6
            faces += [(i, j, 6 + j), (i, 6 + j, 6 + i), (j, i, 12)]
        path = self.folder / "cup.off"
        path.write_text("OFF\n13 18 0\n" + "".join("%r %r %r\n" % v for v in vertices) + "".join("3 %d %d %d\n" % f for f in faces))
        return path

    def test_container_of_triangles_holds_a_bed(self):
        cup = self.cup()
        run = self.folder / "cup"
        result = clast("pack", "--container", cup, "--container-unit", "mm", "--curve", "8 mm", "--mass", "40g",
                       "--shaking-time", "0.02s", "--quiet", "--json", "-o", run)
        self.assertEqual(result.code, 0, result.err)
        out = json.loads(result.out)
        self.assertEqual((out["n_outside"], out["wall_ratio"], out["wall_share"]), (0, None, None))
        self.assertTrue(out["converged"])
        self.assertGreater(out["porosity_bulk"], 0.3)
        self.assertLess(out["porosity_bulk"], 0.7)
        other = clast("pack", "--container", cup, "--container-unit", "mm", "--curve", "8 mm", "--mass", "40g", "--seed", 2,
                      "--shaking-time", "0.02s", "--quiet", "--json", "-o", self.folder / "other").json
        several = clast("porosity", run, self.folder / "other", "--method", "spheres", "--json", "-o", self.folder / "mean")
        self.assertEqual(several.code, 0, several.err)
        several = json.loads(several.out)
        self.assertAlmostEqual(several["bulk"]["mean"], (out["porosity_bulk"] + other["porosity_bulk"]) / 2, 12)
        self.assertGreater(several["bulk"]["deviation"], 0)
        self.assertTrue((self.folder / "mean" / "mean_profile.svg").exists())
        one = json.loads(clast("porosity", run, "--json", "-o", self.folder / "one").out)
        self.assertGreater(one["stress"]["stress_zz"], 0)
        self.assertTrue((self.folder / "one" / "stress.svg").exists())
        by_file = clast("porosity", run, "--bed", f"mesh:{cup},mm", "--method", "spheres", "--json")
        self.assertAlmostEqual(json.loads(by_file.out)["bulk"], out["porosity_bulk"], 9)
        self.assert_fails(2, "pack", "--container", str(cup), "--mass", "40g", says=("unit",))
        self.assert_fails(2, "pack", "--container", str(cup), "--container-unit", "mm", "--mass", "1kg", says=("cannot fit",))


if __name__ == "__main__":
    unittest.main()
