#!/usr/bin/env python3
"""clast pack, domain cell: beds under load, their table, going on after a kill, bad input."""
import csv
import json
import os
import re
import signal
import subprocess
import time
import unittest

from clitest import Case, ROOT, clast

CELL = ["pack", "--curve", "4mm", "--mass", "5g", "--domain", "cell", "--width", "22mm", "--height", "22mm", "--floor=no",
        "--gravity", "0", "--fluid-density", "0", "--seed", "3", "--quiet", "-j", "1"]
FAST = ["--load-rate", "4/s"]  # of stages that press


def rows(path):
    with open(path, encoding="utf-8") as file:
        return [{k: float(v) for k, v in row.items()} for row in csv.DictReader(file)]


def name(option):
    """The key of an option."""
    return option[0].replace("--no-", "--")[2:].replace("-", "_")


class Load(Case):
    def test_a_cell_that_does_not_hold_its_grains_leaves_no_run(self):
        """The refused run's folder was in the way of the right one, and advised a --resume that was refused too."""
        words = [{"5g": "13g"}.get(word, word) for word in CELL]
        self.assert_fails(2, *words, *FAST, "--stages", "isotropic 20kPa until rest", "-o", self.folder / "run", says=["the cell holds"])
        self.assertFalse((self.folder / "run").exists())

    def test_what_is_not_still_is_named_with_its_limit(self):
        """By --rule speed a bed that moved by 0.6 pm "moved by more than 10 um", and the limit of the speed was not named."""
        self.assert_fails(5, "pack", "--curve", "4mm", "--mass", "1g", "--width", "2cm", "--height", "6cm", "--shaking-time", "0", "--rule", "speed",
                          "--still-speed", "1um/s", "--max-damping-time", "0.4s", "-q",
                          says=["its mean height has moved by", "in 10 ms (height_change 10 um)", "(still_speed 1 um/s)"])

    def test_an_early_end_at_a_row_goes_on(self):
        """The row of --max-steps stayed: what the servo set at its step was not in it."""
        cell = [*CELL, *FAST, "--stages", "isotropic 20kPa until stress", "--stages", "shear 5/s 20kPa until strain 0.02", "--energy", "--series-time", "1ms"]
        whole, run = self.folder / "whole", self.folder / "run"
        self.assertEqual(clast(*cell, "-o", whole).code, 0)
        self.assertEqual(clast(*cell, "--max-steps", "600", "-o", run).code, 0)
        for more in (("--max-steps", "10000"), ("--max-steps", "28400"), ()):
            self.assertEqual(clast("pack", "--resume", run, *more, "-q", "-j", "1").code, 0)
        for file in ("state.h5", "load.csv", "series.csv", "summary.json"):
            self.assertEqual((whole / file).read_bytes(), (run / file).read_bytes(), file)

    def test_bed_is_pressed_and_its_energy_found(self):
        run = self.folder / "run"
        result = clast(*CELL, *FAST, "--stages", "isotropic 20kPa until rest", "--energy", "--json", "-o", run)
        self.assertEqual(result.code, 0, result.err)
        out = json.loads(result.out)
        self.assertEqual((out["phase"], out["sank_after_shaking"]), ("done", None))
        self.assertGreater(out["max_speed"], 1e-3)  # a rattler's: the page said "still moving" of a bed that its stage had ended at rest
        self.assertFalse(out["still_moving"])
        for axis in ("xx", "yy", "zz"):
            self.assertLess(abs(out["cell"]["stress"][axis] / 20e3 - 1), 0.01)
        self.assertLess(out["cell"]["unbalanced"], 1e-3)
        self.assertLess(out["porosity_bulk"], 0.46)
        self.assertLess(abs(out["energy"]["rest"]), 1e-10 * out["energy"]["put_in"])
        parts = ("kinetic", "springs", "attraction", "damping", "friction", "rolling", "fluid", "calming", "left", "scheme", "rest")
        self.assertAlmostEqual(sum(out["energy"][part] for part in parts) / out["energy"]["put_in"], 1, 12)
        table = rows(run / "load.csv")
        self.assertGreater(len(table), 5)
        last = table[-1]
        self.assertAlmostEqual(last["porosity"], out["porosity_bulk"], 12)
        self.assertAlmostEqual(last["fabric_xx"] + last["fabric_yy"] + last["fabric_zz"], 1, 12)
        for row in table:  # at every moment, not at the end alone
            self.assertLess(abs(row["energy_rest_J"]), 1e-10 * row["energy_put_in_J"])
        for name in ("load.svg", "energy_book.svg", "state.h5", "grains.csv"):
            self.assertTrue((run / name).exists(), name)
        fine = clast("porosity", run, "--json", "--fields", "4mm", "--chains", "-o", self.folder / "fine")
        self.assertEqual(fine.code, 0, fine.err)
        self.assertAlmostEqual(fine.json["field_mass"] / out["mass"], 1, 12)
        cells = rows(self.folder / "fine/fields.csv")
        side = [cells[0][f"d{k}_m"] for k in "xyz"]
        self.assertAlmostEqual(len(cells) * side[0] * side[1] * side[2] / (last["width_m"] * last["depth_m"] * last["height_m"]), 1, 12)
        for axis in ("xx", "yy", "zz"):  # the cell's mean of the fields is its stress
            mean = sum(c[f"stress_{axis}_Pa"] + c[f"kinetic_stress_{axis}_Pa"] for c in cells) / len(cells)
            self.assertLess(abs(mean / last[f"stress_{axis}_Pa"] - 1), 1e-3)
        self.assertEqual(len(rows(self.folder / "fine/chains.csv")), out["n_contact"])
        self.assertGreater(fine.json["n_chain"], 0)
        for name in ("fields.vti", "chains.vtp", "chains.svg"):
            self.assertTrue((self.folder / "fine" / name).exists(), name)
        self.assert_fails(2, "porosity", run, "--fields", "1m", says=("repeats after",))

    def test_every_kind_of_energy_is_drawn(self):
        """Six kinds were: not the damping of all velocities, which took the most, nor what walls took. One kinetic energy in
        summary.json and series.csv, that of grains in water with the fluid that moves along."""
        run = self.folder / "run"
        result = clast("pack", "--curve", "4mm", "--mass", "2g", "--width", "24mm", "--height", "40mm", "--gravity", "400m/s^2", "--shaking-time",
                       "2ms", "--damping", "1e-20", "--max-steps", 4000, "--fluid-viscosity", "20mPa*s", "--added-mass", "0.5", "--energy", "-o", run,
                       "--json", "--quiet")
        self.assertEqual(result.code, 0, result.err)
        table = rows(run / "load.csv")
        most = max(abs(row["energy_put_in_J"]) for row in table)
        kinds = [["lost_rolling_grains_J", "lost_rolling_walls_J"]] + [[name] for name in table[0] if name.startswith("lost_") and "rolling" not in name]
        kinds += [[f"energy_{name}_J"] for name in ("translation", "rotation", "normal_springs", "tangential_springs", "attraction")]
        drawn = [kind for kind in kinds if max(abs(sum(row[name] for name in kind)) for row in table) > 0.01 * most]
        self.assertIn(["lost_calming_J"], drawn)
        self.assertIn(["lost_fluid_J"], drawn)
        lines = (run / "energy_book.svg").read_text(encoding="utf-8").count("stroke-width:1.6;")
        self.assertEqual(lines, 2 * (len(drawn) + 2))  # each in the legend too; what was put in, and all else
        out = result.json
        self.assertGreater(out["kinetic_energy"], 0)
        self.assertLess(abs(out["kinetic_energy"] / out["energy"]["kinetic"] - 1), 1e-12)
        self.assertLess(abs(rows(run / "series.csv")[-1]["kinetic_energy_J"] / out["kinetic_energy"] - 1), 1e-12)

    def test_shares_of_the_energy_add_up(self):
        """A third of a drum's energy was told nowhere: the damping of all velocities had it."""
        result = clast("pack", "--curve", "4mm", "--mass", "2g", "--width", "24mm", "--height", "40mm", "--gravity", "400m/s^2",
                       "--shaking-time", "2ms", "--damping", "0.999", "--max-steps", 2500, "--fluid-viscosity", "1mPa*s", "--energy")
        self.assertEqual(result.code, 0, result.err)
        line = next(line for line in result.out.splitlines() if line.startswith("energy "))
        self.assertIn("by damping all velocities", line)
        self.assertIn("to the fluid", line)
        self.assertAlmostEqual(sum(float(share) for share in re.findall(r"(\S+) %", line)), 100, delta=1)

    def test_a_bed_that_does_not_come_to_its_end_is_kept(self):
        """Its state and its tables tell why; an older run in the folder stays until a new one is whole."""
        run, new = self.folder / "run", self.folder / "run.new"
        lost = [*CELL, *FAST, "--stages", "isotropic 20kPa until rest", "--max-load-time", "0.02s"]
        whole = clast(*CELL, "--stages", "hold until time 1ms", "-o", run)
        self.assertEqual(whole.code, 0, whole.err)
        kept = (run / "summary.json").read_bytes()
        for _ in range(2):  # the second replaces what the first left
            self.assert_fails(5, *lost, "--force", "-o", run, says=("not come to its end in 20 ms", "until then is in", "run.new"))
            self.assertEqual((run / "summary.json").read_bytes(), kept)
            self.assertGreater(len(rows(new / "load.csv")), 1)
            self.assertEqual(list(new.glob("checkpoint*")), [])
        self.assertEqual(json.loads((new / "manifest.json").read_text())["outcome"], "failed")
        self.assert_fails(3, "export", new, "-o", self.folder / "lost.csv", says=("failed at", "state.h5 there is how it was then"))
        seen = clast("export", new / "state.h5", "-o", self.folder / "lost.csv")
        self.assertEqual(seen.code, 0, seen.err)
        self.assert_fails(5, *lost, "-o", self.folder / "alone", says=("until then is in",))
        table = rows(self.folder / "alone" / "load.csv")
        self.assertGreater(len(table), 1)
        self.assertAlmostEqual(table[-1]["time_s"], 0.02, 3)  # the moment of the end is in it
        self.assert_fails(2, "pack", "--resume", self.folder / "alone", "-q", says=("failed at", "begin it anew"))

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
        stages = [*FAST, "--stages", "isotropic 5kPa until rest", "--stages", "shear 2/s 5kPa until strain 0.3", "--energy",
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

    def test_beds_from_elsewhere_carry_what_they_carried(self):
        """A loaded bed goes out as state, dump and text, and comes back with its contacts and its stress."""
        run = self.folder / "run"
        made = clast(*CELL, *FAST, "--friction", "0", "--stages", "isotropic 20kPa until rest", "--load-rest", "0.01", "--json", "-o", run)
        self.assertEqual(made.code, 0, made.err)
        cell = made.json["cell"]
        hold = ["pack", "--domain", "cell", "--floor=no", "--gravity", "0", "--fluid-density", "0", "--friction", "0", "--quiet",
                "--width", f"{cell['width']!r}m", "--depth", f"{cell['depth']!r}m", "--height", f"{cell['height']!r}m", "--stages",
                "hold until time 0.1ms", "--max-steps", "1", "--json"]
        dump = self.folder / "bed.dump"
        self.assertEqual(clast("export", run, "-o", dump).code, 0)
        text = self.folder / "bed.txt"  # as YADE writes spheres
        with open(run / "grains.csv", encoding="utf-8") as file:
            text.write_text("".join(f"{r['x_m']} {r['y_m']} {r['z_m']} 0.002\n" for r in csv.DictReader(file)), encoding="utf-8")
        for start in ([run / "state.h5"], [dump, "--start-unit", "m"], [text, "--start-unit", "m", "--start-columns", "x,y,z,r"]):
            back = clast(*hold, "--start", *start)
            self.assertEqual(back.code, 0, back.err)
            self.assertEqual(back.json["n_contact"], made.json["n_contact"])
            self.assertEqual(back.json["n_grain"], made.json["n_grain"])
            self.assertAlmostEqual(back.json["porosity_bulk"], made.json["porosity_bulk"], 12)
            self.assertEqual(back.json["n_overlap_start"], made.json["n_contact"])
            self.assertLess(abs(back.json["cell"]["pressure"] / cell["pressure"] - 1), 0.02)
        whole = self.folder / "again"
        self.assertEqual(clast(*hold, "--max-steps", "10", "--start", run / "state.h5", "-o", whole).code, 0)
        resumed = clast("pack", "--resume", whole, "--quiet", "--json")
        self.assertEqual(resumed.code, 0, resumed.err)
        straight = clast(*hold[:-3], "--start", run / "state.h5", "--json")
        self.assertEqual(resumed.json["state_hash"], straight.json["state_hash"])
        self.assertEqual(clast(*hold, "--start", dump).code, 0)  # which says that it is in SI units
        self.assert_fails(2, *hold, "--start", dump, "--start-unit", "mm", says=("in m, not in mm", "start_unit"))
        self.assert_fails(2, *hold, "--start", text, "--start-columns", "x,y,z,r", says=("start", "start_unit"))
        self.assert_fails(2, *hold, "--start", run, says=("is a folder",))
        self.assert_fails(2, *hold, "--start", run / "state.h5", "--mass", "1g", says=("mass does nothing with start, which brings the grains",))
        poured = ["pack", "--start", run / "state.h5", "--width", "40mm", "--height", "40mm", "--quiet"]
        for option in (("--fill-low", "0.5"), ("--fill-high", "0.9"), ("--first-low", "0.1"), ("--first-high", "0.9"),
                       ("--no-shake-from-start",)):
            self.assert_fails(2, *poured, *option, says=(name(option) + " does nothing with start, which brings the grains",))
        text.write_text("0 0 0.005 0.002\n0 0 0.0055 0.002\n", encoding="utf-8")
        self.assert_fails(3, *hold, "--start", text, "--start-unit", "m", "--start-columns", "x,y,z,r",
                          says=("grains 0 and 1 begin inside of each other",))
        low = self.folder / "low.csv"
        low.write_text("x,y,z,d\n0,0,0.01,2\n")
        self.assert_fails(3, "pack", "--start", low, "--start-unit", "mm", "--width", "10mm", "--height", "20mm", "--shaking-time", "0", "-q",
                          says=("grain 0 begins inside of a wall, by 0.99 of its radius",))

    def test_own_tables_of_shapes_and_poses_come_back(self):
        """What clast export writes of any bodies is a start: the same places and turns."""
        shapes = ["--shapes", "ellipsoid:1.3,1,0.8", "--shapes", "data/standin63/grain00.ply"]
        lone = ["--domain", "cell", "--width", "40mm", "--height", "40mm", "--floor=no", "--gravity", "0", "--fluid-density", "0",
                "--stages", "hold until time 1s", "--max-steps", "1", "--quiet"]
        first = self.folder / "first"
        again = self.folder / "again"
        table = self.folder / "bed.csv"
        made = clast("pack", "--curve", "4mm", "--mass", "2g", "--initial-speed", "0", *shapes, *lone, "-o", first)
        self.assertEqual(made.code, 0, made.err)
        self.assertEqual(clast("export", first, "-o", table).code, 0)
        back = clast("pack", "--start", table, *shapes, *lone, "-o", again)
        self.assertEqual(back.code, 0, back.err)
        with open(first / "grains.csv", encoding="utf-8") as a, open(again / "grains.csv", encoding="utf-8") as b:
            for old, new in zip(csv.DictReader(a), csv.DictReader(b), strict=True):
                self.assertEqual(old["shape"], new["shape"])
                for key in old.keys() - {"shape"}:
                    self.assertAlmostEqual(float(old[key]), float(new[key]), 14, key)
        self.assert_fails(3, "pack", "--start", table, *shapes[:2], *lone, says=("row", "none of shapes: 1-ellipsoid:1.3,1,0.8\n"))
        text = table.read_text()
        table.write_text(text.replace("2-grain00.ply", "2-grain00"))  # a file's ending may be left out
        again = clast("pack", "--start", table, *shapes, *lone, "--json")
        self.assertEqual((again.code, again.json["n_grain"]), (0, text.count("\n") - 1), again.err)
        table.write_text(text.replace("2-grain00.ply", "grain00"))
        self.assert_fails(3, "pack", "--start", table, *shapes, *lone,
                          says=("shape 'grain00' is none of shapes: 1-ellipsoid:1.3,1,0.8, 2-grain00.ply",))
        # the ellipsoid of a surface is a shape of the table, too
        made = clast("pack", "--curve", "4mm", "--mass", "2g", *shapes, "--ellipsoids", *lone, "-o", self.folder / "eggs", "--json")
        self.assertEqual(clast("export", self.folder / "eggs", "-o", table).code, 0)
        back = clast("pack", "--start", table, *shapes, "--ellipsoids", *lone, "--json")
        self.assertEqual(back.code, 0, back.err)
        self.assertAlmostEqual(back.json["mass"] / made.json["mass"], 1, 14)

    def test_sides_are_driven_beside_a_shear_without_a_pressure(self):
        """"this is no strain rate (0.1/s): 'y=0.1/s'": the side was read as the shear's pressure."""
        ends = []
        for k, words in enumerate(("shear 1/s y=0.1/s", "y=0.1/s xz=1/s", "shear 1/s x=5kPa", "shear 1/s 5kPa x=5kPa", "shear 1/s xz=2/s", "shear 2/s")):
            run = self.folder / f"run{k}"
            result = clast(*CELL, "--stages", f"{words} until time 1ms", "-o", run)
            self.assertEqual(result.code, 0, (words, result.err))
            ends.append((run / "load.csv").read_bytes())
        self.assertEqual(ends[0], ends[1])
        self.assertEqual(ends[4], ends[5])
        self.assertNotEqual(ends[2], ends[3])  # z stays

    def test_bad_loads_are_said(self):
        self.assert_fails(2, *CELL, says=("without stages",))
        self.assert_fails(2, *CELL, "--stages", "isotropic 10", says=("stage 1", "no pressure"))
        self.assert_fails(2, *CELL, "--stages", "isotropic 10kPa", "--floor", says=("no floor",))
        self.assert_fails(2, *CELL, "--stages", "isotropic 10kPa", "--gravity", "9.81", says=("fall for ever",))
        self.assert_fails(2, *CELL, "--stages", "isotropic 10kPa", "--mass", "13g", says=("larger cell",))
        self.assert_fails(2, *CELL, "--stages", "z=1e6/s until strain 0.1", says=("faster than half", "load_rate"))
        self.assert_fails(2, *CELL, "--stages", "isotropic 10kPa", "--shaking-time", "2s", says=("shaking_time does nothing in domain cell, which its stages load",))
        self.assert_fails(2, *CELL, "--stages", "isotropic 0Pa", says=("stage 1", "never reached"))
        self.assert_fails(2, *CELL, "--stages", "hold until stress 1kPa", says=("stage 1", "drive a side"))
        self.assert_fails(2, *CELL, "--stages", "xz=1 until strain 1", says=("stage 1", "no pressure"))
        for stage in ("isotropic 10kPa until stress 20kPa", "z=-1/s until stress 1kPa", "shear 2kPa until stress 3kPa"):  # each ended at once, as if it had come to it
            self.assert_fails(2, *CELL, "--stages", stage, says=("stage 1", "from above, and grains on a lattice carry nothing"))
        for end, word in (("rest until time 1ms", "until"), ("strain 0.1 x=5kPa", "x=5kPa"), ("stress 1kPa 2kPa", "2kPa")):
            self.assert_fails(2, *CELL, "--stages", f"isotropic 10kPa until {end}", says=("stage 1", f"a stage has one end, and nothing after it: '{word}'"))
        self.assert_fails(2, *CELL, "--stages", "isotropic 10kPa until time rest", says=("stage 1", "expected a number above 0 after 'time'"))
        self.assert_fails(2, *CELL, "--stages", "isotropic 10kPa", "--fluid-viscosity", "1e-3", says=("fluid_viscosity", "domain cell"))
        for option in (("--rule", "speed"), ("--still-speed", "1"), ("--check-time", "1s"), ("--height-change", "1mm"),
                       ("--max-damping-time", "1s"), ("--shake-period", "1s"), ("--no-shake-from-start",), ("--wall-friction", "0.1"),
                       ("--cut", "0.4"), ("--layer", "2mm")):
            self.assert_fails(2, *CELL, "--stages", "isotropic 10kPa", *option,
                              says=(name(option) + " does nothing in domain cell, wh",))
        self.assert_fails(5, *CELL, *FAST, "--stages", "z=10kPa", "--max-load-time", "1ms", says=("stage 1", "not come to its end"))
        self.assert_fails(2, "pack", "--curve", "4mm", "--mass", "2g", "--width", "30mm", "--height", "0.1m", "--stages",
                          "isotropic 10kPa", says=("there is neither",))


if __name__ == "__main__":
    unittest.main()
