#!/usr/bin/env python3
"""clast pack, walls that move, are pressed or open, and outlets: their table, going on after a kill, bad input."""
import csv
import math
import os
import signal
import struct
import subprocess
import time
import unittest

from clitest import Case, ROOT, clast

BED = ["pack", "--curve", "4mm", "--initial-speed", "0.5", "--domain", "box", "--width", "24mm", "--height", "60mm", "--fluid-density", "0", "--shaking-time", "0",
       "--shake-amplitude", "0", "--seed", "3", "--quiet", "-j", "1"]


def rows(path):
    with open(path, encoding="utf-8") as file:
        return [{k: float(v) for k, v in row.items()} for row in csv.DictReader(file)]


def write_stl(path, triangles):
    with open(path, "wb") as file:
        file.write(bytes(80) + struct.pack("<I", len(triangles)))
        for triangle in triangles:
            file.write(struct.pack("<12fH", 0, 0, 0, *(x for corner in triangle for x in corner), 0))


def write_plate(path, half, z, hole=0.0):
    """A square in mm, with a square hole in its middle."""
    outer = [(-half, -half, z), (half, -half, z), (half, half, z), (-half, half, z)]
    inner = [(x * hole / half, y * hole / half, z) for x, y, z in outer]
    if hole == 0:
        write_stl(path, [(outer[0], outer[1], outer[2]), (outer[0], outer[2], outer[3])])
        return
    triangles = []
    for i in range(4):
        k = (i + 1) % 4
        triangles += [(outer[i], outer[k], inner[k]), (outer[i], inner[k], inner[i])]
    write_stl(path, triangles)


def write_tank(path, low=0, sides=6):
    """A closed box in mm, whose bottom lies at z = low; of 4 sides a tube."""
    corner = [(20 * (k & 1), 20 * (k >> 1 & 1), low + 60 * (k >> 2)) for k in range(8)]
    all_sides = ((0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5), (0, 2, 3, 1), (4, 5, 7, 6))
    write_stl(path, [[corner[k] for k in side] for a, b, c, d in all_sides[:sides] for side in ((a, b, c), (a, c, d))])


class Walls(Case):
    def test_a_containers_bottom_in_the_floor_is_no_wall_of_it(self):
        """It stayed behind while its sides moved through the ball, and had the floor's contact law, without a word."""
        tank, start, run = self.folder / "tank.stl", self.folder / "start.csv", self.folder / "run"
        write_tank(tank)
        write_tank(self.folder / "low.stl", -1)
        start.write_text("x_m,y_m,z_m,radius_m\n0.01,0.01,0.002,0.002\n", encoding="utf-8")
        bed = ["pack", "--start", start, "--density", "2500", "--container", tank, "--container-unit", "mm", "--fluid-density", "0", "--shake-amplitude", "0",
               "--shaking-time", "0.1", "--max-steps", "20000", "-q", "-j", "1"]
        up, bouncy = ("--wall", "container move 0,0,10mm/s"), ("--contacts", "grains container restitution 0.8")
        said = "the container's bottom lies in the floor, which pushes in its place; give --no-floor"
        self.assert_fails(2, *bed, *up, says=("wall 1, 'container move 0,0,10mm/s': " + said,))
        self.assert_fails(2, *bed, *bouncy, says=("contacts 1, 'grains container restitution 0.8': " + said,))
        # the floor, named beside it as the refusal said, stayed behind just so
        still, floor = ("--wall", "container"), ("--wall", "floor")
        for words in ((*up, *floor), (*up, "--wall", "floor move 0,0,9mm/s")):
            self.assert_fails(2, *bed, *words, says=("wall 1, 'container move 0,0,10mm/s': " + said, "give the floor the same motion"))
        for stage in ("open container until time 1ms", "container=1mm/s until time 1ms", "open container floor=1mm/s until time 1ms"):
            press = (" press 0,0,1",) if "=" in stage else ("",)
            self.assert_fails(2, *bed, "--wall", "container" + press[0], *floor, "--stages", stage, says=(f"stage 1, '{stage}': " + said, "with it"))
        for words in ((*up, "--wall", "floor move 0,0,10mm/s"), (*still, *floor, "--stages", "open container open floor until time 1ms")):
            result = clast(*bed, *words, "--max-steps", "1")
            self.assertEqual(result.code, 0, (words, result.err))
        self.assertEqual(clast(*bed, *bouncy, "--contacts", "floor grains restitution 0.8", "--max-steps", "1").code, 0)
        self.assertEqual(clast(*bed, "--contacts", "grains walls restitution 0.8", "--max-steps", "1").code, 0)
        self.assert_fails(2, *bed, "--container", self.folder / "low.stl", says=("below the floor at z = 0: move it, or give --no-floor",))
        result = clast(*bed, *up, "--no-floor", "-o", run)
        self.assertEqual(result.code, 0, result.err)
        way = rows(run / "walls.csv")[-1]["container_z_m"]
        self.assertGreater(way, 0.9e-3)
        with open(run / "grains.csv", encoding="utf-8") as file:
            self.assertAlmostEqual(float(next(csv.DictReader(file))["z_m"]), 2e-3 + way, 6)

    def test_a_floor_does_not_take_a_bottom_at_rest_with_it(self):
        """It moved away or opened, and the ball fell through the closed bottom without a word; upwards it crossed the sides after a while."""
        tank, tube, start = self.folder / "tank.stl", self.folder / "tube.stl", self.folder / "start.csv"
        write_tank(tank)
        write_tank(tube, 5, sides=4)
        start.write_text("x_m,y_m,z_m,radius_m\n0.01,0.01,0.012,0.002\n", encoding="utf-8")
        bed = ["pack", "--start", start, "--density", "2500", "--container-unit", "mm", "--fluid-density", "0", "--shake-amplitude", "0", "-q", "-j", "1"]
        said = "the container's bottom lies in the floor, which pushes in its place; give --no-floor, or "
        for words, what in ((("--wall", "floor move 0,0,-10mm/s"), "wall 1, 'floor move 0,0,-10mm/s': " + said + "give the container the same motion, too"),
                            (("--wall", "floor move 0,0,10mm/s"), said + "give the container the same motion, too"),
                            (("--wall", "floor move 0,0,10mm/s", "--wall", "container"), "wall 2, 'container': " + said + "give the floor the same motion, too"),
                            (("--wall", "floor press 0,0,-1", "--stages", "floor=10mm/s until time 50ms"), said + "let the container move or open with it"),
                            (("--wall", "floor", "--stages", "open floor until time 50ms"),
                             "stage 1, 'open floor until time 50ms': " + said + "let the container move or open with it"),
                            (("--wall", "floor", "--wall", "container", "--stages", "open floor until time 50ms"), said + "let the container move or open with it")):
            self.assert_fails(2, *bed, "--container", tank, *words, says=(what,))
        result = clast(*bed, "--container", tank, "--wall", "floor", "--max-steps", "1")  # whose force is asked for
        self.assertEqual(result.code, 0, result.err)
        # a piston below a tube without a bottom: it carries the ball up
        run = self.folder / "run"
        result = clast(*bed, "--container", tube, "--shaking-time", "0", "--wall", "floor press 0,0,1", "--stages", "floor=10mm/s until time 400ms", "-o", run)
        self.assertEqual(result.code, 0, result.err)
        way = rows(run / "walls.csv")[-1]["floor_z_m"]
        self.assertAlmostEqual(way, 4e-3, 5)
        with open(run / "grains.csv", encoding="utf-8") as file:
            self.assertAlmostEqual(float(next(csv.DictReader(file))["z_m"]), 2e-3 + way, 5)

    def test_a_pressure_acts_on_the_area_that_is_given(self):
        """No spelling of an area was read but 1e-2m²: units that end in a digit were taken for bare numbers."""
        lid = [*BED, "--mass", "3g", "--lid", "--max-steps", "1", "--stages", "lid=1kPa until rest"]
        for area in ("0.01m^2", "100cm^2", "1e-2m²", "1e4mm^2"):
            result = clast(*lid, "--wall", f"lid area {area}")
            self.assertEqual(result.code, 0, (area, result.err))
        for area in ("0.01", "0m^2", "-1m^2", "1m", "1m^3", "2", "m^2"):
            self.assert_fails(2, *lid, "--wall", f"lid area {area}", says=(f"wall 1, 'lid area {area}': expected an area (0.01m^2), not '{area}'",))

    def test_a_lid_presses_a_bed(self):
        """An oedometer: the lid comes to its pressure, the floor carries it and the weight; force is the work's slope."""
        run = self.folder / "run"
        result = clast(*BED, "--mass", "8g", "--lid", "--wall", "lid", "--stages", "lid=10kPa until rest", "--stages",
                       "lid=2kPa until rest", "--energy", "--load-rest", "0.03", "--load-rate", "8/s",
                       "--series-time", "0.5ms", "-o", run, "--json")
        self.assertEqual(result.code, 0, result.err)
        table = rows(run / "walls.csv")
        first = [row for row in table if row["stage"] == 1]
        area = 24e-3 ** 2
        weight = result.json["mass"] * 9.81
        for row, pressure in ((first[-1], 10e3), (table[-1], 2e3)):
            self.assertLess(abs(row["lid_force_z_N"] / (pressure * area) - 1), 0.1)
        self.assertLess(abs(-first[-1]["floor_force_z_N"] - first[-1]["lid_force_z_N"] + sum(
            -first[-1][f"{side}_force_z_N"] for side in ("left", "right", "front", "back")) - weight), 0.1 * 10e3 * area)
        self.assertLess(first[-1]["lid_z_m"], -0.02)
        self.assertLess(abs(table[-1]["lid_z_m"] - first[-1]["lid_z_m"]), 1e-3)
        energy = result.json["energy"]
        self.assertLess(abs(energy["rest"]), 1e-10 * energy["put_in"])
        self.assertGreater(energy["walls"], 0)
        self.assertAlmostEqual(energy["walls"], sum(table[-1][f"{name}_work_J"] for name in ("lid", "floor", "left")), 12)

    def test_a_lid_stops_at_its_pressure(self):
        """A bed many times softer than the lid's contacts: the servo does not press it to more than it is to carry."""
        run = self.folder / "run"
        result = clast("pack", "--curve", "4mm", "--initial-speed", "0.5", "--fluid-density", "0", "--shaking-time", "0", "--shake-amplitude", "0", "--seed", "1",
                       "--width", "24mm", "--height", "50mm", "--mass", "8g", "--lid", "--wall", "lid", "--load-rate", "4/s", "--load-rest", "0.01", "--stages",
                       "lid=2kPa until rest", "--series-time", "1ms", "-o", run, "--quiet", "-j", "1")
        self.assertEqual(result.code, 0, result.err)
        self.assertLess(max(row["lid_force_z_N"] for row in rows(run / "walls.csv")), 1.1 * 2e3 * math.pi * 12e-3 ** 2)

    def test_a_stress_is_come_to_from_where_it_is(self):
        """until stress P ended at once where a lid was let down to less or moved up, and by the lid's pressure while another wall moved."""
        layer = ["pack", "--curve", "4mm", "--mass", "0.7g", "--domain", "box", "--width", "24mm", "--height", "20mm", "--lid", "--fluid-density", "0",
                 "--shaking-time", "0", "--shake-amplitude", "0", "--load-rate", "8/s", "--rule", "speed", "-j", "1", "-q", "--stages", "lid=4kPa until stress"]
        area = {"lid": 24e-3 ** 2, "left": 24e-3 * 20e-3}
        for k, (walls, stage, name, end, most) in enumerate((
                (["lid"], "lid=0.5N until stress 2kPa", "lid_force_z_N", 2e3, 1.2), (["lid move 0,0,1mm/s"], "lid until stress 2kPa", "lid_force_z_N", 2e3, 1.2),
                (["lid", "left"], "lid=4kPa left=50mm/s until stress 0.2kPa", "left_force_x_N", -0.2e3, 5))):
            run = self.folder / f"run{k}"
            result = clast(*layer, *(x for wall in walls for x in ("--wall", wall)), "--stages", stage, "--max-load-time", "0.5s", "--series-time", "50us", "-o", run)
            self.assertEqual(result.code, 0, result.err)
            *_, before, last = rows(run / "walls.csv")
            pressure = last[name] / area[name.split("_", maxsplit=1)[0]]
            self.assertEqual((before["stage"], last["stage"]), (2, 2), stage)
            self.assertTrue(0.6 < pressure / end < most, (stage, pressure))

    def test_porosity_lies_between_the_walls_where_they_are(self):
        """A bed that its floor had lifted by 10 mm had a porosity of 0.71 from z = 0 on; one that a side had pressed, that of the room left behind it."""
        run = self.folder / "run"
        result = clast(*BED, "--mass", "4g", "--wall", "floor", "--wall", "left", "--stages", "floor=200mm/s until way 10mm", "--stages",
                       "left=100mm/s until way 4mm", "--stages", "hold until time 50ms", "-o", run, "--json")
        self.assertEqual(result.code, 0, result.err)
        self.assertAlmostEqual(result.json["z_low"], 10e-3, 9)
        profile = rows(run / "profile.csv")
        self.assertAlmostEqual(profile[0]["z_low_m"], 10e-3, 9)
        for row in profile:
            self.assertAlmostEqual(row["solid_m3"] / (1 - row["porosity"]) / (20e-3 * 24e-3 * 1e-3) if row["porosity"] < 1 else 1, 1, 6)
        self.assertAlmostEqual(sum(row["solid_m3"] for row in profile) * 2650 / result.json["mass"], 1, 6)
        self.assertAlmostEqual(clast("porosity", run, "--method", "spheres", "--json").json["z_low"], 10e-3, 9)

    def test_what_sank_after_shaking_is_not_what_stages_moved(self):
        out = clast(*BED, "--mass", "1g", "--shaking-time", "10ms", "--wall", "floor", "--stages", "floor=200mm/s until way 4mm", "--json").json
        self.assertEqual((out["phase"], out["sank_after_shaking"]), ("done", None))  # was the way of the floor, less what sank

    def test_help_says_where_a_stress_is_looked_at(self):
        """The help told it of a cell's sides alone, as if it were no end between walls."""
        page = " ".join(clast("pack", "--help-all").out.split())
        self.assertIn("between walls at those that move (from above where they move away), else at those that are pressed.", page)

    def test_a_floor_is_pressed_over_the_hole_above_it(self):
        """A pressure on the floor below a round tube acted on the square about the tube: 4 / pi of it."""
        run, tube, top = self.folder / "run", self.folder / "tube.stl", self.folder / "top.stl"
        around = [(10 * math.cos(2 * math.pi * k / 12), 10 * math.sin(2 * math.pi * k / 12)) for k in range(13)]
        write_stl(tube, [t for (a, b), (c, d) in zip(around, around[1:]) for t in (((a, b, 2), (c, d, 2), (c, d, 30)), ((a, b, 2), (c, d, 30), (a, b, 30)))])
        write_plate(top, 6, 25)
        result = clast("pack", "--curve", "4mm", "--mass", "0.5g", "--container", tube, "--container-unit", "mm", "--fluid-density", "0", "--shaking-time", "0",
                       "--shake-amplitude", "0", "--load-rate", "4/s", "--rule", "speed", "-j", "1", "-q", "--wall", "floor", "--wall", f"top {top} mm press 0,0,-1",
                       "--stages", "top=200mm/s until stress 0.2kPa", "--stages", "floor=2kPa until stress", "--series-time", "50us", "-o", run)
        self.assertEqual(result.code, 0, result.err)
        self.assertLess(abs(rows(run / "walls.csv")[-1]["floor_force_z_N"] / (-2e3 * 12 * 0.5 * 10e-3 ** 2 * math.sin(math.pi / 6)) - 1), 0.1)

    def test_a_lone_grain_between_plates_comes_to_rest(self):
        """No two grains touch: a stage until rest never ended, though the lid carried what it was to carry."""
        for mass, n in (("0.05g", 1), ("0.7g", 8)):  # a grain; a layer, side by side on its lattice
            run = self.folder / f"run{n}"
            result = clast("pack", "--curve", "4mm", "--mass", mass, "--domain", "box", "--width", "24mm", "--height", "20mm", "--lid", "--fluid-density", "0",
                           "--shaking-time", "0", "--shake-amplitude", "0", "--wall", "lid", "--stages", "lid=1N until rest", "--max-load-time", "0.5s",
                           "--load-rate", "8/s", "--series-time", "0.2ms", "--rule", "speed", "-j", "1", "-q", "--json", "-o", run)
            self.assertEqual(result.code, 0, result.err)
            self.assertEqual((result.json["n_grain"], result.json["n_contact"]), (n, 0))
            self.assertLess(abs(rows(run / "walls.csv")[-1]["lid_force_z_N"] - 1), 0.02)

    def silo(self):
        plate, gate = self.folder / "plate.stl", self.folder / "gate.stl"
        write_plate(plate, 15, 0, 7)
        write_plate(gate, 7.5, 0)
        return [*BED, "--mass", "6g", "--floor=no", "--height", "80mm", "--wall", f"plate {plate} mm", "--wall",
                f"gate {gate} mm vibrate 0,0,0.2mm 10ms", "--outlet", "z<-20mm", "--stages", "gate until time 20ms",
                "--stages", "open gate until time 0.25s", "--energy", "--series-time", "5ms"]

    def test_an_orifice_lets_grains_out(self):
        runs = []
        for k, threads in enumerate(("1", "3")):
            runs.append(self.folder / f"run{k}")
            result = clast(*self.silo()[:-2], "--series-time", "5ms", "-j", threads, "-o", runs[-1], "--json")
            self.assertEqual(result.code, 0, result.err)
        for name in ("state.h5", "walls.csv", "load.csv", "summary.json"):
            self.assertEqual((runs[0] / name).read_bytes(), (runs[1] / name).read_bytes(), name)
        table = rows(runs[0] / "walls.csv")
        last = table[-1]
        self.assertGreater(result.json["n_left"], 20)
        self.assertEqual(last["n_grain"] + last["outlet_1_n"], table[0]["n_grain"] if table[0]["n_grain"] > 0 else max(
            row["n_grain"] for row in table))
        self.assertAlmostEqual(last["mass_left_kg"] + last["mass_kg"], max(row["mass_kg"] for row in table), 12)
        self.assertEqual(result.json["n_grain"], last["n_grain"])
        energy = result.json["energy"]
        self.assertLess(abs(energy["rest"]), 1e-10 * energy["put_in"])
        self.assertTrue((runs[0] / "outflow.svg").exists())

    def test_a_killed_run_goes_on_in_the_same_bytes(self):
        whole, cut = self.folder / "whole", self.folder / "cut"
        options = [*self.silo(), "--shapes", "ellipsoid:1.3,1,0.8", "--material", "salt", "--contacts", "grains walls friction 0.3", "--contacts",
                   "salt plate friction 0.1 restitution 0.6", "--checkpoint-time", "0.05s"]
        made = clast(*options, "-o", whole)
        self.assertEqual(made.code, 0, made.err)
        for wanted in (3, 6):
            process = subprocess.Popen([os.environ["CLAST"], *(options if wanted == 3 else ["pack", "--resume", str(cut), "-q"]),
                                        *(["-o", str(cut)] if wanted == 3 else [])], cwd=ROOT, stdout=subprocess.DEVNULL,
                                       stderr=subprocess.DEVNULL)
            began = time.monotonic()
            while process.poll() is None and (time.monotonic() - began < 0.25 * wanted or not any(cut.glob("checkpoint*"))):
                time.sleep(0.01)  # on a busy machine the first checkpoint comes later
            process.send_signal(signal.SIGKILL)
            process.wait()
        if not (cut / "summary.json").exists():
            resumed = clast("pack", "--resume", cut, "--quiet", "-j", "1")
            self.assertEqual(resumed.code, 0, resumed.err)
        for name in ("state.h5", "walls.csv", "load.csv", "series.csv", "summary.json"):
            self.assertEqual((whole / name).read_bytes(), (cut / name).read_bytes(), name)

    def test_an_early_end_at_a_row_goes_on(self):
        """The row of --max-steps stayed: without the fill that came at its step, and the grains that left at it."""
        load = ROOT / "examples/load"
        silo = [*BED, "--seed", "1", "--mass", "6g", "--domain", "cylinder", "--width", "16mm", "--no-floor", "--wall", f"plate {load / 'orifice.off'} m", "--wall",
                f"gate {load / 'gate.off'} m", "--outlet", "z<-10mm", "--stages", "open gate until time 0.1s"]
        whole, run = self.folder / "whole", self.folder / "run"
        self.assertEqual(clast(*silo, "-o", whole).code, 0)
        self.assertEqual(clast(*silo, "--max-steps", "6000", "-o", run).code, 0)
        self.assertLess(rows(run / "walls.csv")[-1]["n_grain"], rows(whole / "walls.csv")[3]["n_grain"])  # its fill is to come
        for more in (("--max-steps", "44000"), ()):
            self.assertEqual(clast("pack", "--resume", run, *more, "-q", "-j", "1").code, 0)
        for name in ("state.h5", "walls.csv", "series.csv", "summary.json"):
            self.assertEqual((whole / name).read_bytes(), (run / name).read_bytes(), name)

    def test_materials_slide_by_their_own_friction(self):
        """Two balls on one belt: mu g t^2 / 2 each."""
        start, run = self.folder / "start.csv", self.folder / "run"
        start.write_text("shape,x_m,y_m,z_m,qw,qx,qy,qz,scale,density_kg/m^3\n1-sphere,0,-5e-3,2e-3,1,0,0,0,4e-3,2650\n"
                         "2-sphere,0,5e-3,2e-3,1,0,0,0,4e-3,2650\n", encoding="utf-8")
        bed = ["pack", "--start", start, "--shapes", "sphere", "--shapes", "sphere", "--domain", "box", "--width", "40mm", "--fluid-density", "0",
               "--shaking-time", "0", "--damping", "1", "--rule", "speed", "--still-speed", "1e-6", "--wall", "floor move 1000,0,0mm/s",
               "--quiet", "-j", "1"]
        result = clast(*bed, "--material", "ice", "--material", "salt", "--contacts", "grains floor friction 0.1", "--contacts", "salt floor friction 0.3",
                       "--max-steps", "10000", "-o", run)
        self.assertEqual(result.code, 0, result.err)
        with open(run / "grains.csv", encoding="utf-8") as file:
            ends = [float(row["x_m"]) for row in csv.DictReader(file)]
        time_s = rows(run / "walls.csv")[-1]["time_s"]
        for x, friction in zip(ends, (0.1, 0.3)):
            self.assertLess(abs(x / (0.5 * friction * 9.81 * time_s ** 2) - 1), 0.01)
        ice = ["--material", "ice", "--material", "salt"]
        for options, said in (
                (["--contacts", "grains lid friction 0.1"], "that is there, not 'lid'"),
                (["--contacts", "grains floor young 5e6"], "with law hertz alone acts 'young'"),
                (["--contacts", "grains floor friction 200"], "out of the range of its option is 'friction'"),
                (["--contacts", "grains floor friction"], "a number is expected after 'friction'"),
                (["--contacts", "grains floor hue 3"], "expected friction, rolling_friction, restitution, collision_time, young or poisson, not 'hue'"),
                (["--contacts", "floor walls friction 0.1"], "walls do not touch each other"),
                (["--contacts", "grains floor friction 0.1", "--contacts", "floor grains friction 0.2"], "an earlier one is of the same two sides"),
                (["--contacts", "grains floor collision_time 1us"], "time_step 5 us is too long"),
                (ice, "material does nothing without contacts"),
                ([*ice, "--contacts", "ice snow friction 0.1"], "that is there, not 'snow'"),
                ([*ice, "--material", "snow", "--contacts", "ice snow friction 0.1"], "3 materials for 2 shapes")):
            bad = clast(*bed, *options, "-o", self.folder / "bad")
            self.assertEqual((bad.code, bad.err.count("\n")), (2, 1), bad.err)
            self.assertIn(said, bad.err)

    def test_a_table_and_a_formula_are_one_motion(self):
        """Rows of a straight motion, and its velocity: the same places to rounding."""
        plate, table = self.folder / "plate.stl", self.folder / "way.csv"
        write_plate(plate, 20, 0)
        table.write_text("time_s,z_m,angle_rad\n0,0,0\n1,0.05,2\n", encoding="utf-8")
        ends = []
        for k, words in enumerate(("move 0,0,50mm/s axis 0,0,1 rotate 2rad/s", f"axis 0,0,1 table {table}")):
            run = self.folder / f"run{k}"
            result = clast(*BED, "--mass", "3g", "--floor=no", "--wall", f"plate {plate} mm {words}", "--max-steps", "8000", "-o", run)
            self.assertEqual(result.code, 0, result.err)
            ends.append(rows(run / "walls.csv")[-1])
        self.assertAlmostEqual(ends[0]["plate_z_m"], 50e-3 * ends[0]["time_s"], 12)
        for key in ("plate_z_m", "plate_angle_rad"):
            self.assertAlmostEqual(ends[0][key], ends[1][key], 12)
        self.assertAlmostEqual(ends[0]["plate_force_z_N"], ends[1]["plate_force_z_N"], 3)

    def test_shear_by_a_stress_comes_to_it_or_says_so(self):
        cell = ["pack", "--curve", "4mm", "--mass", "5g", "--domain", "cell", "--width", "22mm", "--height", "22mm", "--floor=no",
                "--gravity", "0", "--fluid-density", "0", "--load-rate", "4/s", "--seed", "3", "--quiet", "-j", "1"]
        run = self.folder / "run"
        result = clast(*cell, "--stages", "isotropic 20kPa until stress", "--stages", "shear 3kPa 20kPa until rest", "--stages",
                       "shear -3kPa 20kPa until rest", "--energy", "--load-rest", "0.01", "-o", run, "--json")
        self.assertEqual(result.code, 0, result.err)
        table = rows(run / "load.csv")
        second = [row for row in table if row["stage"] == 2][-1]
        self.assertLess(abs(second["stress_xz_Pa"] / -3e3 - 1), 0.02)
        self.assertLess(abs(table[-1]["stress_xz_Pa"] / 3e3 - 1), 0.02)
        self.assertGreater(second["shear_strain"], table[-1]["shear_strain"])
        self.assertLess(abs(result.json["energy"]["rest"]), 1e-10 * result.json["energy"]["put_in"])
        self.assert_fails(5, *cell, "--stages", "isotropic 5kPa until stress", "--stages", "shear 8kPa 5kPa until rest", "--max-load-time",
                          "0.3s", says=("stage 2", "has not come to its end"))

    def test_bad_walls_are_said(self):
        plate, table = self.folder / "plate.stl", self.folder / "way.csv"
        write_plate(plate, 11, 30)
        wall = f"plate {plate} mm"
        bed = [*BED, "--mass", "3g"]
        self.assert_fails(2, *bed, "--wall", f"plate {plate}", says=("wall 1", "unit"))
        self.assert_fails(2, *bed, "--wall", wall + " move 1,2mm/s", says=("wall 1", "expected a velocity"))
        self.assert_fails(2, *bed, "--wall", wall + " fly", says=("wall 1", "expected move"))
        self.assert_fails(2, *bed, "--wall", wall + " rotate 3rpm", says=("wall 1", "no axis"))
        self.assert_fails(2, *bed, "--wall", wall + " axis 0,0,1 rotate 3", says=("wall 1", "expected an angular velocity"))
        table.write_text("time_s,z_m\n0,0\n1,1\n", encoding="utf-8")
        for words in ("move 0,0,10mm/s", "vibrate 0,0,0.2mm 20ms", "axis 0,0,1", "rotate 30rpm", "swing 5deg 20ms", "about 0,0,1mm", f"table {table}"):
            once = "axis 0,0,1 rotate 30rpm" + ("" if words in ("axis 0,0,1", "rotate 30rpm") else " " + words)
            self.assert_fails(2, *bed, "--wall", f"{wall} {once} {words}", says=("wall 1", f"it is given twice: '{words.split()[0]}'"))
        unused = {"press": "no stage presses the wall, or moves it along that direction (stages); leave out 'press'",
                  "area": "no stage presses the wall by a pressure, or until one (stages); leave out 'area'"}
        for word, words, stage in (("press", "press 0,0,-1", None), ("area", "area 1m^2", None), ("press", "press 0,0,-1", "hold until time 1ms"),
                                   ("area", "press 0,0,-1 area 1m^2", "plate=1mm/s until time 5ms"), ("area", "press 0,0,-1 area 1m^2", "plate=1N until rest"),
                                   ("area", "area 1m^2", "open plate until time 1ms")):  # they did nothing
            stages = ("--stages", stage) if stage else ()
            self.assert_fails(2, *bed, "--wall", f"{wall} {words}", *stages, says=("wall 1", unused[word]))
        for words, stage in (("area 1m^2 press 0,0,-1", "plate=1kPa until rest"), ("area 1m^2 press 0,0,-1", "plate=-1mm/s until stress 1kPa"),
                             ("area 1m^2 press 0,0,-1", "plate=1N until stress 1kPa"), ("press 0,0,-1", "plate=1N until rest")):
            self.assertEqual(clast(*bed, "--wall", f"{wall} {words}", "--stages", stage, "--max-steps", "1").code, 0, stage)
        self.assert_fails(2, *bed, "--wall", wall + " press 0,0,-1 press 0,0,1", "--stages", "plate=1kPa", says=("wall 1", "it is given twice: 'press'"))
        self.assert_fails(2, *bed, "--wall", wall, "--wall", wall, says=("wall 2", "has this name"))
        self.assert_fails(2, *bed, "--wall", wall + " move 0,0,-40m/s", says=("wall 1", "faster than half"))
        stiff = [word for pair in ("grains grains", "grains walls") for word in ("--contacts", pair + " collision_time 10us")]
        fast = ["--wall", wall + " move 0,0,-20m/s", "--time-step", "0.2us", "--max-steps", "1", "-o", self.folder / "fast"]
        self.assert_fails(2, *bed, *fast, says=("wall 1", "faster than half"))
        done = clast(*bed, *fast, *stiff)
        self.assertEqual(done.code, 0, done.err)  # what no two sides have does not count
        self.assert_fails(2, *bed, "--wall", wall, "--stages", "plate=1kPa", says=("stage 1", "direction"))
        write_tank(self.folder / "tank.stl")
        self.assert_fails(2, "pack", "--curve", "4mm", "--mass", "1g", "--container", self.folder / "tank.stl", "--container-unit", "mm", "--no-floor", "--wall",
                          "container axis 0,0,1 about 10,10,0mm rotate 20000rpm", says=("wall 1", "would move at ", "faster than half"))  # its rotation had no speed
        self.assert_fails(2, *bed, "--wall", wall + " press 0,0,-1", "--stages", "plate=1kPa until stress 2kPa", says=("stage 1", "no stage before it presses with more: 'plate'"))
        self.assert_fails(2, *bed, "--wall", wall + " press 1,0,0", "--stages", "plate=1kPa until stress", says=("stage 1", "no area"))
        self.assert_fails(2, *bed, "--wall", wall, "--stages", "plate until time 1s", says=("stage 1", "no motion"))
        self.assert_fails(2, *bed, "--wall", wall, "--stages", "lid=1kPa", says=("stage 1", "no wall"))
        self.assert_fails(2, *bed, "--wall", wall + " move 0,0,-1mm/s", "--stages", f"plate {'x' * 70} until time 1s", says=("stage 1", "x~"))
        self.assert_fails(2, *bed, "--stages", "hold", says=("stages", "neither"))
        for end in ("rest until time 1ms", "time 1ms until rest", "stress 1kPa 2kPa"):
            self.assert_fails(2, *bed, "--wall", wall + " press 0,0,-1", "--stages", f"plate=1kPa until {end}",
                              says=("stage 1", "a stage has one end, and nothing after it: '"))
        # these pressed nothing, stood still or were over at once, with exit code 0
        lid, hold = [*bed, "--lid", "--wall", "lid"], ("--stages", "hold until time 1ms")
        self.assert_fails(2, *lid, "--stages", "open lid until time 1ms", *hold, "--stages", "lid=1kPa until rest",
                          says=("stage 3", "stage 1 opened wall lid"))
        self.assert_fails(2, *bed, "--lid", "--wall", "lid move 0,0,1mm/s", *hold, says=("wall 1", "no stage names it"))
        self.assert_fails(2, *lid, "--outlet", "z<10mm", "--stages", "hold until mass 5g", says=("stage 1", "mass still inside"))
        self.assert_fails(2, *bed, "--outlet", "down", says=("outlet 1", "half-space"))
        self.assert_fails(2, *bed, "--wall", "floor axis 1,0,0 rotate 3rpm", says=("wall 1", "rotates about its normal"))
        self.assert_fails(2, *bed, "--domain", "periodic", "--width", "30mm", "--wall", wall, says=("wall 1", "periodic"))
        table.write_text("time_s,z_m\n0,0\n0,1\n", encoding="utf-8")
        self.assert_fails(3, *bed, "--wall", wall + f" table {table}", says=("row 2", "rise"))
        missing = self.folder / "none.stl"
        self.assert_fails(3, *bed, "--wall", f"plate {missing} mm", says=("none.stl",))
        run = self.folder / "run"
        self.assert_fails(5, *bed, "--wall", wall + " press 0,0,-1", "--stages", "plate=20mm/s until way 40mm", "-o", run,
                          says=("walls floor and plate cross",))


if __name__ == "__main__":
    unittest.main()
