#!/usr/bin/env python3
"""clast pack: beds of aggregates, every kind of grain cut off and gone on with, a shaken drum. Each computes for a while."""
import csv
import json
import math
import os
import shutil
import signal
import subprocess
import time
import unittest

from clitest import Case, ROOT, clast

SMALL = ["pack", "--curve", "6 mm", "--mass", "12g", "--width", "40mm", "--height", "0.1m", "--shaking-time", "0.01s",
         "--seed", "3", "--quiet", "-j", "1"]


class Kinds(Case):
    def run_small(self, *extra):
        return clast(*SMALL, *extra)

    def rows(self, path):
        with open(path, newline="", encoding="utf-8") as file:
            return list(csv.DictReader(file))

    def aggregate(self, name, *options):
        made = clast("aggregate", *options, "--seed", "2", "-o", self.folder / name, "--quiet")
        self.assertEqual(made.code, 0, made.err)
        return self.folder / name / "state.h5"

    def test_aggregate_is_a_grain(self):
        made = clast("aggregate", "--core", "sphere", "--core-size", "200um", "--coat", "sphere", "--size", "100um", "--replicate",
                     "6", "-o", self.folder / "aggregate", "--quiet")
        self.assertEqual(made.code, 0, made.err)
        run = self.folder / "run"
        result = self.run_small("--shapes", self.folder / "aggregate" / "state.h5", "--shapes", "sphere", "--max-steps", "14000",
                                "--json", "-o", run)
        self.assertEqual(result.code, 0, result.err)
        self.assertGreater(json.loads(result.out)["n_grain"], 5)

    def test_aggregates_of_any_shape_are_grains(self):
        eggs = self.aggregate("eggs", "--core", "ellipsoid:3,2,1", "--core-size", "200um", "--coat", "ellipsoid:2,1,1", "--size",
                              "100um", "--replicate", "3")
        gravel = self.aggregate("gravel", "--core", ROOT / "data/standin63/grain20.ply", "--core-size", "200um", "--coat",
                                ROOT / "data/standin63/grain10.ply", "--size", "100um", "--replicate", "2", "--unit", "m")
        for state, n_hull in ((eggs, 0), (gravel, 1)):
            run = self.folder / f"bed-{n_hull}"
            made = self.run_small("--shapes", state, "--mass", "2g", "--json", "-o", run)
            self.assertEqual(made.code, 0, made.err)
            self.assertEqual(len(made.json["hulls"]), n_hull)
            self.assertTrue(made.json["converged"])
            # the exact slices hold the volume of the parts: the bed's mass over its density
            sliced = clast("porosity", run, "--cut", "0.95", "-o", run / "slices")
            self.assertEqual(sliced.code, 0, sliced.err)
            with open(run / "slices/profile.csv", newline="", encoding="utf-8") as file:
                solid = sum(float(row["solid_m3"]) for row in csv.DictReader(file))
            self.assertAlmostEqual(2650 * solid / made.json["mass"], 1, 12)
            picture = clast("render", run, "-o", run / "bed.png", "--width", "64", "--height", "64", "--samples", "1")
            self.assertEqual(picture.code, 0, picture.err)
        self.assert_fails(2, *SMALL, "--shapes", eggs, "--form-law", says=("cannot stretch",))
        self.assert_fails(2, *SMALL, "--shapes", gravel, "--rounding", "1um", says=("not rounded",))

    def test_aggregate_of_two_densities_keeps_them(self):
        state = self.aggregate("coated", "--core", "sphere", "--core-size", "200um", "--core-density", "4700", "--coat", "sphere",
                               "--size", "150um", "--coat-density", "1200", "--replicate", "3")
        bed = ["--shapes", state, "--mass", "4g", "--shaking-time", "0.004s"]
        self.assert_fails(2, *SMALL, *bed, says=("several densities", "give it density 0"))
        self.assert_fails(2, *SMALL, "--density", "0", says=("no density of its own",))
        whole = self.folder / "whole"
        made = self.run_small(*bed, "--density", "0", "--json", "-o", whole)
        self.assertEqual(made.code, 0, made.err)
        self.assertTrue(made.json["converged"])
        core, coat = 4700 * 0.2**3, 1200 * 0.15**3
        density = {float(row["density_kg/m^3"]) for row in self.rows(whole / "grains.csv")}
        self.assertEqual(len(density), 1)
        self.assertIn(round(density.pop(), 6), [round((core + k * coat) / (0.2**3 + k * 0.15**3), 6) for k in range(1, 30)])
        run = self.folder / "cut"
        process = subprocess.Popen([os.environ["CLAST"], *map(str, [*SMALL, *bed]), "--density", "0", "--checkpoint-time", "0.02s",
                                    "-o", str(run)], cwd=ROOT, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        while not list(run.glob("checkpoint-0000*[1-9]*.h5")) and process.poll() is None:
            time.sleep(0.002)
        process.kill()
        process.wait()
        self.assertEqual(process.returncode, -9, "the run ended before it could be killed")
        resumed = clast("pack", "--resume", run, "--json", "-j", "4")
        self.assertEqual(resumed.code, 0, resumed.err)
        self.assertEqual(resumed.json["state_hash"], made.json["state_hash"])
        # the same bytes for any number of threads, and for a run that went on with another
        for threads in ("1", "2", "4"):
            other = self.folder / f"threads-{threads}"
            again = clast(*SMALL, *bed, "--density", "0", "--checkpoint-time", "0.02s", "-j", threads, "-o", other)
            self.assertEqual(again.code, 0, again.err)
            for name in ("state.h5", "series.csv", "summary.json", "grains.csv"):
                self.assertEqual((other / name).read_bytes(), (run / name).read_bytes(), f"{name}, {threads} threads")

    def test_other_kinds_resume_after_a_kill(self):
        spheres = self.folder / "clump.csv"
        spheres.write_text("x,y,z,radius\n0,0,0,1\n1,0,0,0.8\n")
        rigid = self.aggregate("rigid", "--core", "ellipsoid:3,2,1", "--core-size", "200um", "--coat", "ellipsoid:2,1,1", "--size",
                               "100um", "--replicate", "2")
        for kind, shape in (("egg", "ellipsoid:3,2,1"), ("hull", "data/standin63/grain10.ply"), ("clump", str(spheres)),
                            ("rigid", str(rigid))):
            options = ["--shapes", shape, "--mass", "4g", "--shaking-time", "0.004s", "--max-steps", "24000"]
            whole = self.folder / f"{kind}-whole"
            self.assertEqual(self.run_small(*options, "-o", whole, "--checkpoint-time", "0.02s").code, 0)
            run = self.folder / f"{kind}-cut"
            for _ in range(8):  # a busy machine may look again only when a short run has ended
                process = subprocess.Popen([os.environ["CLAST"], *SMALL, *options, "--checkpoint-time", "0.02s", "--force", "-o",
                                            str(run)], cwd=ROOT, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
                while not list(run.glob("checkpoint-0000*[1-9]*.h5")) and process.poll() is None:
                    time.sleep(0.002)
                process.kill()
                if process.wait() == -signal.SIGKILL:
                    break
                shutil.rmtree(run)
            self.assertEqual(process.returncode, -9, f"{kind}: the run ended before it could be killed")
            resumed = clast("pack", "--resume", run, "--quiet", "-j", "1")
            self.assertEqual(resumed.code, 0, resumed.err)
            self.assertEqual((whole / "state.h5").read_bytes(), (run / "state.h5").read_bytes(), kind)

    def test_other_checkpoints_are_refused(self):
        eggs = self.aggregate("eggs", "--core", "sphere", "--core-size", "200um", "--coat", "sphere", "--size", "100um",
                              "--replicate", "2")
        run = self.folder / "run"
        run.mkdir()
        (run / "checkpoint-000000000100.h5").write_bytes(eggs.read_bytes())
        self.assert_fails(3, "pack", "--resume", run, says=("no checkpoint of a packing",))

    def drum(self, height=80):
        """A closed drum of twelve sides, 50 mm wide, lying off the axis."""
        n = 12
        ring = [(25 * math.cos(2 * math.pi * k / n) + 10, 25 * math.sin(2 * math.pi * k / n)) for k in range(n)]
        vertices = [(x, y, 5) for x, y in ring] + [(x, y, 5 + height) for x, y in ring] + [(10, 0, 5), (10, 0, 5 + height)]
        faces = []
        for i in range(n):
            j = (i + 1) % n
            faces += [(i, j, n + j), (i, n + j, n + i), (j, i, 2 * n), (n + i, n + j, 2 * n + 1)]
        path = self.folder / "drum.off"
        path.write_text(f"OFF\n{len(vertices)} {len(faces)} 0\n" + "".join("%r %r %r\n" % v for v in vertices) +
                        "".join("3 %d %d %d\n" % f for f in faces))
        return path

    def test_closed_container_holds_a_shaken_bed(self):
        drum = self.drum()
        options = ["pack", "--container", drum, "--container-unit", "mm", "--no-floor", "--curve", "8 mm", "--mass", "30g",
                   "--shaking-time", "0.05s", "--shake-amplitude", "2mm", "-j", "1", "--quiet"]
        run = self.folder / "run"
        for shape in ("sphere", ROOT / "data/standin63/grain10.ply"):
            made = clast(*options, "--shapes", shape, "--json")
            self.assertEqual(made.code, 0, made.err)
            self.assertEqual((made.json["n_outside"], made.json["converged"]), (0, True))
        # cut off, its container changed, it does not go on
        process = subprocess.Popen([os.environ["CLAST"], *map(str, options), "--checkpoint-time", "0s", "-o", str(run)], cwd=ROOT,
                                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        while not list(run.glob("checkpoint-0000*[1-9]*.h5")) and process.poll() is None:
            time.sleep(0.01)
        process.kill()
        process.wait()
        self.drum(height=81)
        self.assert_fails(3, "pack", "--resume", run, says=("drum.off (container) is not the one",))
        self.drum()
        resumed = clast("pack", "--resume", run, "--quiet", "-j", "1", "--json")
        self.assertEqual((resumed.code, resumed.json["n_outside"]), (0, 0), resumed.err)


if __name__ == "__main__":
    unittest.main()
