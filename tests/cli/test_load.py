#!/usr/bin/env python3
"""clast pack, domain cell: beds under load, their table, going on after a kill, bad input."""
import csv
import json
import os
import signal
import subprocess
import time
import unittest

from clitest import Case, ROOT, clast

CELL = ["pack", "--curve", "4mm", "--mass", "5g", "--domain", "cell", "--width", "22mm", "--height", "22mm", "--floor=no",
        "--gravity", "0", "--fluid-density", "0", "--load-rate", "4/s", "--seed", "3", "--quiet", "-j", "1"]


def rows(path):
    with open(path, encoding="utf-8") as file:
        return [{k: float(v) for k, v in row.items()} for row in csv.DictReader(file)]


class Load(Case):
    def test_bed_is_pressed_and_its_energy_found(self):
        run = self.folder / "run"
        result = clast(*CELL, "--stages", "isotropic 20kPa until rest", "--energy", "--json", "-o", run)
        self.assertEqual(result.code, 0, result.err)
        out = json.loads(result.out)
        self.assertEqual(out["phase"], "done")
        for axis in ("xx", "yy", "zz"):
            self.assertLess(abs(out["cell"]["stress"][axis] / 20e3 - 1), 0.01)
        self.assertLess(out["cell"]["unbalanced"], 1e-3)
        self.assertLess(out["porosity_bulk"], 0.46)
        self.assertLess(abs(out["energy"]["rest"]), 1e-10 * out["energy"]["put_in"])
        table = rows(run / "load.csv")
        self.assertGreater(len(table), 5)
        last = table[-1]
        self.assertAlmostEqual(last["porosity"], out["porosity_bulk"], 12)
        self.assertAlmostEqual(last["fabric_xx"] + last["fabric_yy"] + last["fabric_zz"], 1, 12)
        for row in table:  # at every moment, not at the end alone
            self.assertLess(abs(row["energy_rest_J"]), 1e-10 * row["energy_put_in_J"])
        for name in ("load.svg", "energy_book.svg", "state.h5", "grains.csv"):
            self.assertTrue((run / name).exists(), name)
        stress = clast("porosity", run, "--json")
        self.assertEqual(stress.code, 0, stress.err)

    def test_poured_beds_have_the_book_and_their_old_bits(self):
        poured = ["pack", "--curve", "6mm", "--mass", "12g", "--width", "40mm", "--height", "0.1m", "--shaking-time", "0.01s",
                  "--quiet", "-j", "1", "--json"]
        plain = clast(*poured)
        booked = clast(*poured, "--energy", "-o", self.folder / "run")
        self.assertEqual(plain.json["state_hash"], booked.json["state_hash"])
        self.assertNotIn("energy", plain.json)
        energy = booked.json["energy"]
        self.assertLess(abs(energy["rest"]), 1e-10 * energy["put_in"])
        self.assertGreater(energy["damping"], 0)
        self.assertGreater(energy["friction"], 0)

    def test_a_killed_load_goes_on_in_the_same_bytes(self):
        stages = ["--stages", "isotropic 5kPa until rest", "--stages", "shear 2/s 5kPa until strain 0.3", "--energy",
                  "--shapes", "ellipsoid:1.3,1,0.8", "--width", "26mm", "--height", "26mm",
                  "--checkpoint-time", "0.05s"]
        whole = self.folder / "whole"
        cut = self.folder / "cut"
        made = clast(*CELL, *stages, "-o", whole)
        self.assertEqual(made.code, 0, made.err)
        process = subprocess.Popen([os.environ["CLAST"], *CELL, *stages, "-o", str(cut)], cwd=ROOT, stdout=subprocess.DEVNULL,
                                   stderr=subprocess.DEVNULL)
        while not list(cut.glob("checkpoint-0000*[1-9]*.h5")) and process.poll() is None:
            time.sleep(0.01)
        process.send_signal(signal.SIGKILL)
        process.wait()
        resumed = clast("pack", "--resume", cut, "--quiet", "-j", "1")
        self.assertEqual(resumed.code, 0, resumed.err)
        for name in ("state.h5", "load.csv", "series.csv", "summary.json"):
            self.assertEqual((whole / name).read_bytes(), (cut / name).read_bytes(), name)

    def test_bad_loads_are_said(self):
        self.assert_fails(2, *CELL, says=("without stages",))
        self.assert_fails(2, *CELL, "--stages", "isotropic 10", says=("stage 1", "no pressure"))
        self.assert_fails(2, *CELL, "--stages", "isotropic 10kPa", "--floor", says=("no floor",))
        self.assert_fails(2, *CELL, "--stages", "isotropic 10kPa", "--gravity", "9.81", says=("fall for ever",))
        self.assert_fails(2, *CELL, "--stages", "isotropic 10kPa", "--mass", "13g", says=("larger cell",))
        self.assert_fails(2, *CELL, "--stages", "z=1e6/s until strain 0.1", says=("faster than half", "load_rate"))
        self.assert_fails(2, *CELL, "--stages", "isotropic 10kPa", "--shaking-time", "2s", says=("leave out", "shaking_time"))
        self.assert_fails(5, *CELL, "--stages", "z=10kPa", "--max-load-time", "1ms", says=("stage 1", "not come to its end"))
        self.assert_fails(2, "pack", "--curve", "4mm", "--mass", "2g", "--width", "30mm", "--height", "0.1m", "--stages",
                          "isotropic 10kPa", says=("domain cell alone",))


if __name__ == "__main__":
    unittest.main()
