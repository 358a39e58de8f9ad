#!/usr/bin/env python3
"""clast evolve: a cloud from the fluid to the floor, its files, stopped and resumed, any threads, bad input."""
import base64
import csv
import json
import math
import random
import os
import re
import signal
import subprocess
import time
import unittest

from clitest import Case, ROOT, clast

ASH = ["evolve", "--domain", "box:0,0,0,1mm,1mm,10mm", "--particles", "3000", "--curve", "lognormal:20um,10um,5um,60um",
       "--duration", "1s", "--rows", "20", "--shapes", "ellipsoid:1,0.8,0.5", "--shapes", "sphere", "--eddy-diffusivity", "1e-8",
       "--out-of-range", "extrapolate", "--seed", "3", "--quiet"]
TABLES = ["balance.csv", "spectrum.csv", "events.csv", "deposit.csv", "particles.csv"]
SAME = TABLES + ["summary.json", "state.h5", "evolution.svg"]


def rows(path):
    with open(path, newline="", encoding="utf-8") as file:
        return [{k: float(v) if v else math.nan for k, v in row.items()} for row in csv.DictReader(file)]


class Evolve(Case):
    def run_ash(self, *extra):
        result = clast(*ASH, *extra)
        self.assertEqual(result.code, 0, result.err)
        return result

    def test_a_fall_beyond_its_law_is_told_with_a_way_out(self):
        big = ("evolve", "--domain", "box:0,0,0,10m,10m,10m", "--particles", "5", "--curve", "30cm", "--duration", "0.1s", "--constant", "0",
               "--kernel", "constant", "--json")
        found = clast(*big)
        self.assertGreater(found.json["fall_reynolds"], 3e5)
        self.assertEqual(found.err.count("\n"), 1)
        self.assertIn("beyond the 300000 of the drag law", found.err)
        small = clast(*big[:6], "0.1mm", *big[7:])
        self.assertEqual((small.code, small.err), (0, ""))
        self.assert_fails(2, "evolve", "--domain", "box:0,0,0,1cm,1cm,1cm", "--particles", "1000", "--curve", "uniform:0.1mm,0.3mm",
                          "--duration", "0.05s", "--kernel", "settling", "--efficiency", "1", "--fall", "stokes", says=("--fall form or sphere",))

    def test_rates_take_units(self):
        # "constant: unknown unit 'cm^3/s'", of a number in m^3/s
        box = ["evolve", "--domain", "box:0,0,0,1mm,1mm,1mm", "--particles", "500", "--curve", "2um", "--duration", "1s", "--gravity", "0",
               "--floor", "reflect", "--kernel", "constant", "--json", "--quiet"]
        typed, bare = (clast(*box, "--constant", k, "--eddy-diffusivity", d).json["state_hash"]
                       for k, d in (("1e-6 cm^3/s", "1e-4 mm^2/s"), ("1e-12", "1e-10")))
        self.assertEqual(typed, bare)
        self.assert_fails(2, *box, "--constant", "1e-12 m^2/s", says=("m^3/s",))

    def test_books_balance_in_every_row(self):
        run = self.folder / "run"
        out = self.run_ash("-j", 2, "--json", "-o", run).json
        for key in ("n_start", "n_in_fluid", "n_event", "n_deposit", "n_step", "mass_balance", "state_hash", "deposit", "wall_s"):
            self.assertIn(key, out)
        self.assertGreater(out["n_event"], 50)
        balance = rows(run / "balance.csv")
        self.assertLessEqual(len(balance), 21)
        for row in balance:
            self.assertEqual(row["number_balance"], 0)
            self.assertLess(abs(row["mass_balance"]), 1e-12)
            self.assertEqual(row["n_particle"] + row["n_event"] + row["n_deposit"] + row["n_out"], 3000)
            self.assertAlmostEqual((row["mass_kg"] + row["deposit_kg"]) / out["mass_start"], 1.0, 12)
        deposit = rows(run / "deposit.csv")
        self.assertEqual(len(deposit), out["n_deposit"])
        self.assertEqual(sorted(row["time_s"] for row in deposit), [row["time_s"] for row in deposit])
        self.assertTrue(all(row["z_m"] == 0.0 and 0.0 <= row["porosity"] < 1.0 for row in deposit))
        self.assertEqual(sum(row["grains"] for row in deposit) + sum(row["grains"] for row in rows(run / "particles.csv")), 3000)
        for name in SAME + ["manifest.json", "report.html", "spectrum.svg", "deposit.svg"]:
            self.assertTrue((run / name).exists(), name)
        self.assertEqual(list(run.glob("checkpoint-*")), [])

    def test_threads_change_no_byte(self):
        one, four = self.folder / "one", self.folder / "four"
        self.run_ash("-j", 1, "--bed-width", "0.2mm", "-o", one)
        self.run_ash("-j", 4, "--bed-width", "0.2mm", "-o", four)
        for name in [*SAME, "deposit.h5"]:
            self.assertEqual((one / name).read_bytes(), (four / name).read_bytes(), name)

    def test_stopped_and_killed_runs_end_in_the_same_bytes(self):
        whole = self.folder / "whole"
        self.run_ash("--checkpoint-time", "0s", "-o", whole)
        for number in (signal.SIGINT, signal.SIGKILL):
            run = self.folder / f"cut-{int(number)}"
            process = subprocess.Popen([os.environ["CLAST"], *ASH, "--checkpoint-time", "0s", "-o", str(run)], cwd=ROOT,
                                       stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            while not list(run.glob("checkpoint-0000*[1-9]*.h5")) and process.poll() is None:
                time.sleep(0.005)
            process.send_signal(number)
            process.wait()
            self.assertNotEqual(process.returncode, 0, "it ended before it was stopped")
            told = clast("porosity", run)
            self.assertEqual(told.code, 3)
            self.assertIn(f"clast evolve --resume {run}", told.err)
            resumed = clast("evolve", "--resume", run, "--quiet")
            self.assertEqual(resumed.code, 0, resumed.err)
            for name in SAME:
                self.assertEqual((run / name).read_bytes(), (whole / name).read_bytes(), name)

    def cut_off(self, run, *extra):
        """A run of slow steps, stopped by SIGTERM once it writes its folder."""
        process = subprocess.Popen([os.environ["CLAST"], *self.SLOW, *extra, "-o", str(run)], cwd=ROOT, stdout=subprocess.DEVNULL,
                                   stderr=subprocess.PIPE, text=True)
        while not list(run.glob("checkpoint-*.h5")) and process.poll() is None:
            time.sleep(0.005)
        time.sleep(0.5)
        process.send_signal(signal.SIGTERM)
        return process.communicate()[1], process.returncode

    SLOW = ["evolve", "--domain", "box:0,0,0,1mm,1mm,1mm", "--particles", "2000", "--curve", "lognormal:5um,1um,3um,8um", "--viscosity", "1e-3",
            "--fluid-density", "1000", "--kernel", "shear_laminar+brownian", "--shear", "20", "--gravity", "0", "--floor", "periodic",
            "--duration", "150s", "--rows", "3", "--seed", "3", "-j", "1", "--out-of-range", "extrapolate", "--quiet"]

    def test_a_signal_or_a_limit_within_a_leg_keeps_its_steps(self):
        """A leg of 16 steps took seconds and looked once: ended by a signal, a folder that said "running" and held the start alone;
        with a short --time-limit it never came further."""
        whole, run = self.folder / "whole", self.folder / "run"
        made = clast(*self.SLOW, "-o", whole)
        self.assertEqual(made.code, 0, made.err)
        err, code = self.cut_off(run)
        self.assertEqual(code, 143, err)
        self.assertIn(f"clast evolve --resume {run}", err)
        self.assertEqual(json.loads((run / "manifest.json").read_text())["outcome"], "stopped")
        self.assertGreater(max(path.name for path in run.glob("checkpoint-*.h5")), "checkpoint-000000000000.h5")
        for _ in range(3):  # each comes further
            before = max(path.name for path in run.glob("checkpoint-*.h5"))
            short = clast("evolve", "--resume", run, "--time-limit", "0.5s", "--quiet")
            if short.code == 0:
                break
            self.assertEqual(short.code, 143, short.err)
            self.assertGreater(max(path.name for path in run.glob("checkpoint-*.h5")), before)
        else:
            resumed = clast("evolve", "--resume", run, "--quiet")
            self.assertEqual(resumed.code, 0, resumed.err)
        for name in SAME:
            self.assertEqual((run / name).read_bytes(), (whole / name).read_bytes(), name)

    def test_a_resumed_run_is_warned_of_by_its_own_drag_law(self):
        """It was by the command line's, which beside --resume is the default."""
        run = self.folder / "run"
        process = subprocess.Popen([os.environ["CLAST"], *ASH, "--fall", "stokes", "--checkpoint-time", "0s", "-o", str(run)], cwd=ROOT,
                                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        while not list(run.glob("checkpoint-0000*[1-9]*.h5")) and process.poll() is None:
            time.sleep(0.005)
        process.kill()
        process.wait()
        self.assertNotEqual(process.returncode, 0, "it ended before it was stopped")
        resumed = clast("evolve", "--resume", run)
        self.assertEqual(resumed.code, 0, resumed.err)
        self.assertRegex(resumed.err, r"Reynolds number of the fastest fall is [.\d]+, beyond the 0\.1 of the drag law \(take --fall form or sphere\)")

    def test_particles_fit_into_the_domain(self):
        """Bodies of 2 m went into a box of 1 x 1 x 5 mm without a word."""
        few = ("evolve", "--particles", 3, "--duration", "1ms", "--kernel", "constant", "--constant", 0, "-q")
        self.assert_fails(2, *few, "--domain", "box:0,0,0,1mm,1mm,5mm", "--curve", "2m", "--out-of-range", "extrapolate",
                          says=["3 of 3 particles are wider than the domain", "least width is 1 mm", "(particle 1: 2 m,", "larger domain or smaller"])
        for domain, width in (("box:0,0,0,1mm,2mm,5mm", 1.0), ("box:0,0,0,2mm,2mm,0.5mm", 0.5), ("cylinder:0,0,0,0,0,1,1mm,5mm", 2.0),
                              ("half-pipe:1mm,5mm", 1.0), ("sphere:0.6mm", 1.2)):
            with self.subTest(domain):
                sides = () if domain.startswith("box") else ("--sides", "reflect", "--floor", "reflect")
                self.assert_fails(2, *few, "--domain", domain, *sides, "--curve", f"{1.001 * width}mm", says=["wider than the domain"])
                fits = clast(*few, "--domain", domain, *sides, "--curve", f"{0.999 * width}mm")
                self.assertEqual(fits.code, 0, fits.err)
        long = ("--domain", "box:0,0,0,1mm,1mm,5mm", "--curve", "0.6mm")
        self.assertEqual(clast(*few, *long).code, 0)
        self.assert_fails(2, *few, *long, "--shapes", "ellipsoid:4,1,1", says=["3 of 3 particles", "(particle 1: 1.5"])

    def test_a_bed_of_these_very_aggregates(self):
        run, bed = self.folder / "run", self.folder / "bed"
        self.run_ash("--keep", 3, "-o", run)
        kept = sorted((run / "aggregates").glob("node-*.h5"))
        self.assertEqual(len(kept), 3)
        shapes = [word for path in kept for word in ("--shapes", path)]
        packed = clast("pack", *shapes, "--density", 0, "--curve", "4mm", "--mass", "2g", "--width", "16mm", "--height", "50mm",
                       "--shaking-time", 0, "--quiet", "-o", bed, "--json")
        self.assertEqual(packed.code, 0, packed.err)
        measured = clast("porosity", bed, "--cut", 0.9, "--trim", "2mm", "--json")
        self.assertEqual(measured.code, 0, measured.err)
        self.assertTrue(0.3 < measured.json["bulk"] < 0.95, measured.json["bulk"])
        sizes = clast("grading", f"list:{run / 'deposit_sizes.csv'}", "--json")
        self.assertEqual(sizes.code, 0, sizes.err)
        largest = clast("export", run, "-o", self.folder / "largest.vtu", "--json")  # state.h5: the aggregate of most grains
        self.assertEqual(largest.code, 0, largest.err)

    def test_the_deposit_settles_as_it_is(self):
        """Every body of the floor once, with its own size and mass, as a bed."""
        run, bed = self.folder / "run", self.folder / "bed"
        out = self.run_ash("--particles", 300, "--bed-width", "1um", "--json", "-o", run).json["deposit"]
        deposit = rows(run / "deposit.csv")
        self.assertGreater(out["bed_width"], max(row["envelope_m"] for row in deposit))  # 1 um was too narrow
        self.assertGreater(max(row["grains"] for row in deposit), 1)
        self.assertIn("Envelope&#39;s diameter, mean by mass", (run / "report.html").read_text())  # the card of the deposit
        start = clast("export", run / "deposit.h5", "-o", self.folder / "start.csv", "--json")
        self.assertEqual(start.code, 0, start.err)
        packed = clast("pack", "--start", run / "deposit.h5", "--domain", "box", "--width", f"{out['bed_width']}m",
                       "--height", f"{out['bed_height']}m",
                       "--collision-time", "20us", "--time-step", "0.5us", "--fluid-density", 0, "--shaking-time", 0, "--max-steps", 2000,
                       "--quiet", "-o", bed, "--json")
        self.assertEqual(packed.code, 0, packed.err)
        self.assertEqual(packed.json["n_grain"], len(deposit))
        self.assertAlmostEqual(packed.json["mass"] / sum(row["mass_kg"] for row in deposit), 1.0, 6)

    EVEN = ("evolve", "--domain", "box:0,0,0,1cm,1cm,1cm", "--curve", "20um", "--duration", "60s", "--kernel", "constant", "--constant", "1e-30",
            "--quiet", "--json")

    def bed_of(self, run):
        """deposit.csv and centres of deposit.h5, rows in the order of arrival."""
        out = self.folder / f"{run.name}.csv"
        made = clast("export", run / "deposit.h5", "-o", out, "--quiet")
        self.assertEqual(made.code, 0, made.err)
        with open(out, newline="", encoding="utf-8") as file:
            centre = [[float(row[f"{axis}_m"]) for axis in "xyz"] for row in csv.DictReader(file)]
        return rows(run / "deposit.csv"), centre

    def test_bodies_of_a_bed_are_above_the_places_where_they_came_down(self):
        """They stood in 81 vertical poles, row by row, whatever their x and y; pack called that at rest."""
        run, bed = self.folder / "run", self.folder / "bed"
        out = clast(*self.EVEN, "--particles", 600, "--bed-width", "0.2mm", "-o", run).json["deposit"]
        deposit, centre = self.bed_of(run)
        width, radius = 2e-4, 1e-5
        self.assertEqual(len({(round(x, 12), round(y, 12)) for x, y, _ in centre}), 600)
        room = 1.01 * radius
        for row, (x, y, z) in zip(deposit, centre):
            for place, at in ((row["x_m"], x), (row["y_m"], y)):
                wanted = room - width / 2 + (place % width) / width * (width - 2 * room)
                self.assertLess(abs(wanted - at), 0.0101 * radius)
                self.assertLess(abs(at) + radius, width / 2 * (1 + 1e-9))
            self.assertGreater(z, radius)
        for k, (x, y, z) in enumerate(centre):  # free of those before, and upon one of them or the floor
            gaps = [math.dist((x, y, z), other) - 2 * room for other in centre[:k]]
            self.assertGreater(min(gaps, default=0), -1e-12)
            self.assertLess(min(gaps + [z - room]), 1e-12)
        self.assertAlmostEqual(out["bed_height"], max(z for _, _, z in centre) + room, 12)
        packed = clast("pack", "--start", run / "deposit.h5", "--domain", "box", "--width", "0.2mm", "--height", "4mm", "--fluid-density", 1000,
                       "--shaking-time", 0, "--collision-time", "40us", "--time-step", "1us", "--rule", "speed", "--still-speed", "20um/s",
                       "--layer", "5um", "--trim", "20um", "--quiet", "--json", "-o", bed)
        self.assertEqual(packed.code, 0, packed.err)
        self.assertLess(packed.json["n_loose"], 0.3 * 600)  # all of them
        self.assertGreater(packed.json["coordination"], 4.0)  # 1.9
        self.assertLess(packed.json["porosity_bulk"], 0.48)  # 0.61

    def test_the_bed_settles_by_the_line_that_is_told(self):
        """By the defaults of clast pack, whose contacts are those of millimetres, it exploded in step 530."""
        run, bed = self.folder / "run", self.folder / "bed"
        told = self.run_ash("--particles", 200, "--bed-width", "0.3mm", "-o", run).out
        line = re.search(r"settles by +clast (pack --start .*)", told)
        self.assertIsNotNone(line, told)
        packed = clast(*line[1].split(), "--max-steps", 30000, "--quiet", "--json", "-o", bed)
        self.assertEqual(packed.code, 0, packed.err)
        self.assertGreater(packed.json["n_grain"], 50)

    def test_a_bed_of_one_place_has_no_poles(self):
        run, points = self.folder / "run", self.folder / "points.csv"
        points.write_text("x,y,z\n" + "".join(f"5e-3,5e-3,{(k + 1) * 1e-4}\n" for k in range(60)))
        made = clast(*self.EVEN, "--points", points, "--no-brownian", "--bed-width", "0.2mm", "-o", run)
        self.assertEqual(made.code, 0, made.err)
        deposit, centre = self.bed_of(run)
        self.assertEqual({(row["x_m"], row["y_m"]) for row in deposit}, {(5e-3, 5e-3)})
        for (x, y, _), (u, v, _) in zip(centre, centre[1:]):
            self.assertGreater(math.hypot(x - u, y - v), 1e-8)
        self.assertEqual([z for _, _, z in centre], sorted(z for _, _, z in centre))

    def test_beds_of_any_domain_keep_their_layers_and_walls(self):
        for domain in ("cylinder:1mm,2mm", "half-pipe:1mm,2mm", "cylinder:1cm,0,0,0,1,1,0.5mm,2mm", "sphere:1mm", "box:-3mm,0,0,-2.9mm,1mm,1mm"):
            with self.subTest(domain):
                run = self.folder / f"run{len(domain)}"
                made = clast("evolve", "--domain", domain, "--particles", 200, "--curve", "uniform:10um,30um", "--duration", "2min", "--sides",
                             "reflect", "--kernel", "constant", "--constant", "1e-30", "--bed-width", "0.3mm", "--quiet", "-o", run)
                self.assertEqual(made.code, 0, made.err)
                _, centre = self.bed_of(run)
                self.assertGreater(len(centre), 150)
                for axis in (0, 1):  # all of the width is taken
                    at = [c[axis] for c in centre]
                    self.assertLess(max(map(abs, at)), 1.5e-4)
                    self.assertLess(abs(sum(at) / len(at)), 3e-5)
                    self.assertGreater(max(at) - min(at), 2.4e-4)

    def test_a_bed_has_no_bodies_of_walls(self):
        """deposit.h5 had what stuck to sides and ceiling too, as if it lay on the floor."""
        for domain, wind, weight in (("box:0,0,0,5mm,5mm,5mm", "0.03,0,0", 1), ("cylinder:0,0,0,1,0,0,2mm,5mm", "0,0.05,0", 3)):
            with self.subTest(domain):
                run = self.folder / domain[:3]
                made = clast("evolve", "--domain", domain, "--curve", "20um", "--particles", 200, "--sides", "deposit", "--wind", wind, "--weight", weight,
                             "--kernel", "constant", "--constant", "1e-30", "--duration", "1s", "--bed-width", "100um", "-q", "-o", run)
                self.assertEqual(made.code, 0, made.err)
                deposit, centre = self.bed_of(run)
                axis = -2e-5 if domain[0] == "c" else 1e-9  # of a horizontal pipe the wall below its axis is floor
                below = sum(row["z_m"] < axis for row in deposit)
                self.assertTrue(50 < len(centre) < 190, len(centre))
                self.assertLess(abs(len(centre) - below), 3)
                out = json.loads((run / "summary.json").read_text())["deposit"]
                self.assertEqual(out["n_wall"], 200 - len(centre))
                self.assertAlmostEqual((out["mass"] - out["mass_wall"]) / (weight * out["bed_mass"]), 1.0, 9)
                self.assertRegex(made.out, rf"on walls +{out['n_wall']} bodies, [\d.]+ ug, not on the floor\n")
                self.assertEqual("of the 3 that it stands for" in made.out, weight == 3)

    def test_a_bed_of_weighted_bodies_says_that_each_comes_once(self):
        run = self.folder / "run"
        made = clast(*self.EVEN[:-2], "--particles", 30, "--weight", 3, "--bed-width", "0.2mm", "-o", run)
        self.assertRegex(made.out, r"bed +.*deposit.h5: .* high; each body once, [\d.]+ ng, of the 3 that it stands for\n")
        out = json.loads((run / "summary.json").read_text())["deposit"]
        self.assertAlmostEqual(out["bed_mass"] * 3 / out["mass"], 1.0, 9)
        plain = clast(*self.EVEN[:-2], "--particles", 30, "--bed-width", "0.2mm", "-o", self.folder / "plain")
        self.assertRegex(plain.out, r"bed +.* high\n")

    def test_the_envelope_is_named_and_grains_are_those_of_the_start(self):
        """Porosity 0.259 for an aggregate whose clast aggregate says 0.653, and '1 grains' for a body of 301."""
        grown, run = self.folder / "grown", self.folder / "run"
        made = clast("aggregate", "--core", "sphere", "--core-size", "30um", "--coat", "sphere", "--size", "10um", "--replicate", 20, "--no-picture",
                     "--quiet", "-o", grown)
        self.assertEqual(made.code, 0, made.err)
        told = clast(*self.EVEN[:-2], "--particles", 5, "--shapes", grown / "state.h5", "-o", run)
        self.assertEqual(told.code, 0, told.err)
        self.assertRegex(told.out, r"diameter [\d.]+ um and porosity [\d.]+ \(of the ellipsoid of equal moments\), .* 1 particle of the start")
        self.assertRegex(told.out, r"largest aggregate +1 particle of the start")
        self.assertEqual(json.loads((run / "summary.json").read_text())["deposit"]["envelope_kind"], "ellipsoid of equal moments")
        self.assertIn("ellipsoid of equal moments", (run / "report.html").read_text())
        self.assertIn("ellipsoid of equal moments", clast("evolve", "--help-all").out)

    def test_points_are_read_from_the_tables_of_clast(self):
        """No column 'x': they have x_m, and there was no option to name it."""
        first, again, other = self.folder / "first", self.folder / "again", self.folder / "other"
        made = clast(*self.EVEN, "--particles", 40, "--keep", 0, "-o", first)
        self.assertEqual(made.code, 0, made.err)
        lifted = self.folder / "lifted.csv"
        table = rows(first / "deposit.csv")
        lifted.write_text("node,x_m,y_m,z_m,envelope_m\n" + "".join(f"{r['node']},{r['x_m']},{r['y_m']},5e-3,{r['envelope_m']}\n" for r in table))
        read = clast(*self.EVEN, "--points", lifted, "--keep", 0, "-o", again)
        self.assertEqual((read.code, read.json["n_start"]), (0, 40), read.err)
        mm = self.folder / "mm.csv"
        mm.write_text("east_mm,north_mm,up_um,d_um\n" + "".join(f"{1e3 * r['x_m']!r},{1e3 * r['y_m']!r},5000,20\n" for r in table))
        words = self.EVEN[:3] + self.EVEN[5:]
        read = clast(*words, "--points", mm, "--columns", "east_mm,north_mm,up_um", "--diameter-column", "d_um", "--keep", 0, "-o", other)
        self.assertEqual((read.code, read.json["n_start"]), (0, 40), read.err)
        self.assert_fails(3, *self.EVEN, "--points", mm, says=("points", "east_mm", "'x'"))
        self.assert_fails(3, *self.EVEN, "--points", mm, "--columns", "east_mm,north_mm", says=("2 coordinates", "columns"))
        both = self.folder / "both.csv"
        both.write_text("x_m,x_mm,y,z\n1e-3,1,1e-3,1e-3\n")
        self.assert_fails(3, *self.EVEN, "--points", both, says=("'x'", "x_mm"))
        for command in ("decompose", "agglomerate"):
            told = clast(command, lifted, "--domain", "box:0,0,0,1cm,1cm,1cm", "--json",
                         *(() if command == "decompose" else ("--kernel", "constant", "--constant", 1e-12)))
            self.assertEqual(told.code, 0, told.err)

    def test_points_of_a_snapshot_and_of_an_array(self):
        """Only the first of a dump's snapshots could be had."""
        dump = self.folder / "two.dump"
        dump.write_text("".join(f"ITEM: TIMESTEP\n{step}\nITEM: NUMBER OF ATOMS\n{n}\nITEM: BOX BOUNDS pp pp pp\n0 1\n0 1\n0 1\nITEM: ATOMS id x y z\n"
                                + "".join(f"{k + 1} {0.1 * k + 0.05} 0.5 0.5\n" for k in range(n)) for step, n in ((0, 3), (10, 5))))
        run = ("evolve", "--domain", "box:0,0,0,1,1,1", "--duration", "1s", "--json", "--points", dump)
        for more, n, said in (((), 3, "points: the first snapshot of 2 (--frame -1: the last)"), (("--frame", -1), 5, ""), (("--frame", 1), 5, "")):
            made = clast(*run, *more)
            self.assertEqual((made.code, made.json["n_start"]), (0, n), made.err)
            self.assertIn(said, made.err)
            self.assertEqual("snapshot" in made.err, said != "", made.err)
        bed = self.folder / "bed"
        self.assertEqual(clast("pack", ROOT / "examples/u1.yaml", "--mass", "20g", "--max-steps", 100, "-o", bed).code, 0)
        array = (*run[:2], "box:-1,-1,-1,1,1,1", *run[3:-1], bed / "state.h5", "--dataset")
        made = clast(*array, "/assembly/position")
        self.assertEqual((made.code, made.json["n_start"]), (0, json.loads((bed / "summary.json").read_text())["n_grain"]), made.err)
        self.assert_fails(3, *array, "/none", says=("points", "/none"))
        self.assert_fails(3, *run, "--frame", 2, says=("points", "no snapshot 2 among 2"))
        self.assert_fails(2, *run[:-2], "--particles", 3, "--frame", 1, says=("frame does nothing without points",))

    def test_frames_and_points(self):
        run = self.folder / "run"
        points = self.folder / "points.csv"
        points.write_text("x,y,z,d\n" + "".join(f"{0.1 * k + 0.05},0.5,0.5,{1e-5 * (k + 1)}\n" for k in range(10)))
        done = clast("evolve", "--domain", "box:0,0,0,1,1,1", "--points", points, "--diameter-column", "d", "--duration", "1s",
                     "--rows", 4, "--frames", 2, "--quiet", "-o", run, "--json")
        self.assertEqual(done.code, 0, done.err)
        self.assertEqual(done.json["n_start"], 10)
        self.assertEqual(done.json["n_frame"], 3)
        self.assertEqual((run / "frames.pvd").read_text().count("<DataSet"), 3)
        views = [json.loads(text) for text in re.findall(r'class="view-data">(.*?)</script>', (run / "report.html").read_text(), re.S)]
        for frame in (frame for view in views if view.get("frames") for frame in view["frames"]["frame"]):
            self.assertEqual(set(base64.b64decode(frame["grain"])), {255})  # rows of a frame are no bodies of the end
        bodies = views[-1]["shapes"][0]
        self.assertEqual(set(base64.b64decode(bodies["pose"])[36:40]), {0})  # density: none is told, which was shown as 1 kg/m3
        for frame in (run / "frames").iterdir():
            for name in ("node", "on_floor", "grains", "envelope_m", "porosity", "speed_m/s", "mass_kg"):
                self.assertIn(f'Name="{name}"', frame.read_text())
        masses = sorted(row["mass_kg"] for name in ("particles.csv", "deposit.csv") for row in rows(run / name))
        self.assertAlmostEqual(masses[9] / masses[0], 1000.0, 9)

    def test_examples_are_whole(self):
        for path in sorted((ROOT / "examples/evolve").glob("*.yaml")):
            out = clast("evolve", path, "--json", "--quiet", cwd=ROOT).json
            self.assertEqual(out["number_balance"], 0, path.name)
            self.assertLess(out["mass_balance"], 1e-12)
            self.assertGreater(out["deposit"]["mass"], 0.95 * out["mass_start"])  # it ends on the floor
            self.assertGreater(out["grains_most"], 50)

    def test_options_without_effect_are_refused(self):
        """Each was taken, and the state was that without it."""
        box = ["evolve", "--domain", "box:0,0,0,1,1,1", "--duration", "1s", "--particles", 5]
        grown, points = self.folder / "grown", self.folder / "points.csv"
        made = clast("aggregate", "--core", "sphere", "--core-size", "10um", "--coat", "sphere", "--size", "5um", "--no-picture", "-q", "-o", grown)
        self.assertEqual(made.code, 0, made.err)
        points.write_text("x,y,z,d\n0.5,0.5,0.5,1e-5\n")
        sized = [*box[:5], "--points", points, "--diameter-column", "d"]
        still, drops = [*box, "--no-brownian", "--gravity", 0, "--floor", "reflect", "--kernel", "constant"], [*box, "--no-structure"]
        and_still = "with kernel constant and without gravity"
        for words, option, value, why in (
                ([*box, "--shapes", grown / "state.h5"], "density", 500, "with aggregates (state.h5), whose grains have their own"),
                (box, "shape-weight", 3, "with one shape"), (box, "unit", "mm", "without a surface file among the shapes"), (box, "keep", 3, "without -o"),
                (box, "walk-step", 0.3, "without meeting diffusive"), (box, "field-columns", "a,b,c", "without field"),
                (box, "columns", "a,b,c", "without points"),
                ([*box, "--even", "whole"], "change-level", 0.1, "with even whole"), (sized, "curve", "55um", "with diameter_column"),
                (drops, "meeting", "central", "without structure"), (drops, "max-tries", 3, "without structure"),
                (drops, "walk-step", 0.3, "without structure"), ([*drops, "-o", self.folder / "never"], "keep", 3, "without structure"),
                ([*box, "--no-brownian", "--kernel", "shear_laminar", "--shear", "1/s"], "temperature", "500K",
                 "with kernel shear_laminar and without brownian"),
                (still, "viscosity", 1e-4, and_still), (still, "fluid-density", 2, and_still), (still, "mean-free-path", "1um", and_still),
                (still, "fall", "sphere", "without gravity and brownian"), (still, "collision-radius", "volume", "with kernel constant"),
                ([*box, "--kernel", "constant"], "dissipation", 1, "with kernel constant"), (box, "checkpoint-time", "5s", "without -o"),
                ([*box, "--floor", "reflect", "-o", self.folder / "never"], "bed-width", "1mm", "without a floor that is deposit: nothing lies there")):
            with self.subTest(option):
                refused = self.assert_fails(2, *words, f"--{option}", value, says=(f" does nothing {why}",))
                self.assertIn(option, refused.err.replace("_", "-"))
        self.assertEqual(clast(*box, "--no-brownian", "--temperature", "500K", "--quiet").code, 0)  # the kernel looks at it
        self.assert_fails(2, *box, "--floor", "reflect", "--sides", "deposit", "--wind", "2,0,0", "--bed-width", "1mm", "-o", self.folder / "aside",
                          says=("bed_width does nothing without a floor that is deposit",))  # a bed of what stuck to a wall was written

    def test_layers_at_walls_that_reflect_are_refused_or_told(self):
        """A layer of diffusivity over speed that no step follows: 5 to 248 events by time_step, 114 to 527 at the top by step_error."""
        drops = ("evolve", "--curve", "20um", "--particles", 1000, "--kernel", "constant", "--constant", "1e-9", "--no-structure", "--rows", 1, "--domain")
        cube = (*drops, "box:0,0,0,0.1,0.1,0.1", "--duration", "10s")
        along = (*cube, "--floor", "periodic", "--sides", "reflect", "--gravity", 0, "--wind", "0.05,0,0", "--eddy-diffusivity", "1e-5")
        for step in ("10ms", "5s"):
            self.assert_fails(2, *along, "--time-step", step, says=("100 % of the mass", "into sides that reflect", "or time_step below 4 ms"))
        self.assert_fails(2, *along, says=("into sides that reflect", "or step_error below 0.002"))
        self.assertEqual(clast(*along, "--time-step", "3ms").code, 0)  # was refused
        shaft = clast(*drops, "box:0,0,0,1,1,1000", "--release", "box:0,0,0,1,1,10", "--wind", "1e-4,0,0", "--sides", "reflect", "--duration", "12h")
        self.assertEqual(shaft.code, 0, shaft.err)  # "100 %": the whole shaft was taken for the way down
        sheared = (*drops, "box:0,0,0,0.1,0.1,1", "--release", "box:0,0,0.99,0.1,0.1,1", "--wind", "0.5,0,0", "--wind-shear", -0.5, "--sides", "reflect")
        self.assert_fails(2, *sheared, "--eddy-diffusivity", "2e-5", "--duration", "60s", says=("into sides that reflect",))  # calm where they start
        self.assert_fails(2, *cube, "--wind", "0,0,0.05", says=("wind", "into a top that reflects", "take open_top"))
        self.assertEqual(clast(*cube, "--wind", "0,0,0.05", "--open-top").code, 0)
        calm = (*cube, "--gravity", 0, "--floor", "reflect", "--wind")  # one into the floor was taken, its mirror image refused
        self.assert_fails(2, *calm, "0,0,-0.05", says=("wind", "into a floor that reflects", "take floor: deposit"))
        self.assert_fails(2, *calm, "0,0,0.05", says=("wind", "into a top that reflects"))
        rise = clast(*cube, "--fluid-density", 4000).err  # it was told to take --floor deposit, which it had
        self.assertRegex(rise, r"^clast evolve: warning: \d+\.\d % of the mass comes to a top that reflects .*\(take --open-top .*\n$")
        floor = (*cube, "--floor", "reflect")
        self.assertRegex(clast(*floor).err, r"^clast evolve: warning: 100 % of the mass comes to a floor that reflects .* depends on the steps .*\(take --floor deposit, or.*\n$")
        self.assertEqual(clast(*floor, "--json", "-q").json["gathered"], 1)
        for words in ((*floor, "--eddy-diffusivity", "1e-3"), (*floor, "--sides", "deposit", "--wind", "10,0,0"), cube):  # 3 cm; blown out before
            calm = clast(*words, "--json")
            self.assertEqual((calm.code, calm.err, calm.json["gathered"]), (0, "", 0))

    def test_a_field_that_does_not_meet_the_domain_is_told(self):
        """A grid 5 m away, or in millimetres without a unit: every body had the velocity of an edge or of the first cell."""
        for scale, shift, is_told in ((1e-2, 0, False), (1e-2, 5, True), (10, 0, True)):
            field = self.folder / "field.csv"
            field.write_text("x,y,z,u,v,w\n" + "".join(f"{shift + scale * x},{shift + scale * y},{shift + scale * z},0,0,0\n"
                                                       for x in (0, 0.5, 1) for y in (0, 0.5, 1) for z in (0, 0.5, 1)))
            r = clast("evolve", "--domain", "box:0,0,0,1cm,1cm,1cm", "--particles", 20, "--curve", "1um", "--kernel", "constant", "--constant", "1e-30",
                      "--duration", "1ms", "--rows", 1, "--no-structure", "--field", field, "--field-columns", "u,v,w", "--sides", "deposit")
            self.assertEqual((r.code, "are both in the same unit?" in r.err), (0, is_told), r.err)

    def test_a_bed_of_nothing_is_told(self):
        """All bodies blown onto the walls: no deposit.h5 and no word."""
        r = clast("evolve", "--curve", "30um", "--particles", 20, "--release", "box:1mm,1mm,40mm,4mm,4mm,45mm", "--domain", "box:0,0,0,5mm,5mm,50mm",
                  "--sides", "deposit", "--wind", "5,0,0", "--duration", "1s", "--rows", 1, "--bed-width", "1mm", "-o", self.folder / "blown")
        self.assertEqual(r.code, 0, r.err)
        self.assertRegex(r.out, r"(?m)^bed +none: nothing lies on the floor$")

    def test_a_vortex_takes_no_steps_of_its_grid(self):
        """A field without compression took 610, 325 and 165 steps on 6, 11 and 21 nodes an axis: the error of the interpolation between them."""
        for n in (6, 11):
            field = self.folder / f"vortex{n}.csv"
            at = [(i / (n - 1), 2 * math.pi * i / (n - 1)) for i in range(n)]
            field.write_text("x,y,z,u,v,w\n" + "".join(f"{0.01 * x!r},{0.01 * y!r},{z},{math.sin(a) * math.cos(b)!r},{-math.cos(a) * math.sin(b)!r},0\n"
                                                       for x, a in at for y, b in at for z in (0, 0.01)))
            out = clast("evolve", "--domain", "box:0,0,0,1cm,1cm,1cm", "--particles", 50, "--curve", "1um", "--kernel", "constant", "--constant", "1e-30",
                        "--field", field, "--gravity", 0, "--no-brownian", "--floor", "periodic", "--duration", "1s", "--rows", 10, "--json")
            self.assertEqual((out.code, out.err), (0, ""))
            self.assertEqual(out.json["n_step"], 10)

    def test_bad_input_is_one_line(self):
        box = ["evolve", "--domain", "box:0,0,0,1,1,1", "--duration", "1s"]
        self.assert_fails(2, *box, says=("particles",))
        self.assert_fails(2, "evolve", "--particles", 5, "--duration", "1s", says=("domain", "box:"))
        self.assert_fails(2, *box, "--particles", 5, "--gravity", 0, "--no-brownian", says=("floor", "nothing reaches it"))
        self.assert_fails(2, *box, "--particles", 5, "--kernel", "shear_turbulent", says=("dissipation",))
        self.assert_fails(2, *box, "--particles", 5, "--kernel", "ballistic", "--gravity", 0, "--floor", "reflect", says=("ballistic", "velocity"))
        self.assert_fails(2, *box, "--particles", 5, "--curve", "100um", "--time-step", "2s", says=("time_step", "whole height", "take less than"))
        self.assert_fails(2, *box, "--particles", 5, "--wind", "1,0,0", "--sides", "deposit", "--time-step", "2s",
                          says=("time_step", "moves 2 m to the side", "whole width of 1 m"))
        self.assert_fails(2, "evolve", "--domain", "cylinder:0,0,0,0,0,1,1m,2mm", "--sides", "reflect", "--duration", "60s", "--particles", 5, "--curve",
                          "20um", "--time-step", "0.3s", says=("time_step", "whole height of 2 mm"))
        self.assert_fails(2, *box, "--particles", 5, "--wind", "2,0,0", "--sides", "reflect", says=("wind", "100 % of the mass", "sides that reflect"))
        self.assert_fails(2, *box, "--particles", 5, "--bed-width", "1mm", says=("bed_width", "-o"))
        self.assert_fails(2, *box, "--particles", 5, "--wind", "1,2", says=("wind", "x,y,z"))
        self.assert_fails(2, *box, "--particles", 5, "--density", 1, "--density", 2, says=("density", "1 shapes"))
        self.assert_fails(2, *box, "--particles", 5, "--frames", 1, says=("frames", "-o"))
        self.assert_fails(2, *box, "--particles", 5, "--diameter-column", "d", says=("diameter_column",))
        self.assert_fails(3, *box, "--particles", 5, "--shapes", "nowhere.stl", says=("shapes", "nowhere.stl"))
        outside = self.folder / "outside.csv"
        outside.write_text("x,y,z\n0.5,0.5,0.5\n2,0,0\n")
        self.assert_fails(3, *box, "--points", outside, says=("points", "row 2"))
        outside.write_text("x,y,z\n0.5,0.5,0.5\n0.5,nan,0.5\n")
        self.assert_fails(3, *box, "--points", outside, says=("points", "row 2 has a coordinate that is not finite"))
        draw = random.Random(3)
        places = [f"{draw.random()},{draw.random()},{draw.random()}\n" for _ in range(1000)]
        outside.write_text("x,y,z\n" + "".join(2 * places))
        self.assert_fails(3, *box, "--points", outside, "--kernel", "constant", says=("points", "duplicates (coincident points)"))
        self.assert_fails(2, *box, "--particles", 5, "--release", "box:0,0,0,1,1,2", says=("release", "to 2 m along z, beyond the domain"))
        self.assert_fails(2, *box, "--particles", 5, "--wind", "0,0,-1", "--time-step", "2s", says=("time_step", "moves 2.015", "whole height"))
        outside.write_text("x,y,z\n0.5,0.5,0.5\n2,0,0\n")
        uneven = self.folder / "uneven.csv"
        uneven.write_text("x,y,z,u,v,w\n" + "".join(f"{x},0,0,1,0,0\n" for x in (0, 1, 3)))
        self.assert_fails(3, *box, "--particles", 5, "--field", uneven, says=("field", "not even", "plane 2 of 3"))
        self.assert_fails(3, *box, "--particles", 5, "--field", outside, says=("field", "u"))
        self.assert_fails(2, "evolve", "--domain", "sphere:1", "--particles", 5, "--duration", "1s", says=("only a box",))
        self.assert_fails(3, "evolve", "--resume", self.folder, says=("no checkpoint",))


if __name__ == "__main__":
    unittest.main()
