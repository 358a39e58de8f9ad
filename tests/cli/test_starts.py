#!/usr/bin/env python3
"""clast export and clast pack --start: packings of other programs come and go without losing a digit."""
import csv
import math
import struct
import unittest

from clitest import ROOT, Case, clast

LONE = ["--domain", "cell", "--width", "40mm", "--height", "40mm", "--floor=no", "--gravity", "0", "--fluid-density", "0",
        "--stages", "hold until time 1s", "--max-steps", "1", "--quiet", "-j", "1"]
SPHERES = ("data", "dump", "txt", "voro", "xyzd", "conf")
BOX = ["--domain", "box", "--width", "40mm", "--height", "50mm", "--shaking-time", "0", "--shake-amplitude", "0", "--max-steps", "1", "--quiet", "--json"]


def snapshot(step, rows, columns="id x y z radius", units=""):
    """One snapshot of a LAMMPS dump."""
    head = f"ITEM: UNITS\n{units}\n" if units else ""
    return (f"{head}ITEM: TIMESTEP\n{step}\nITEM: NUMBER OF ATOMS\n{len(rows)}\nITEM: BOX BOUNDS pp pp ff\n0 20\n0 20\n0 20\n"
            f"ITEM: ATOMS {columns}\n" + "".join(" ".join(map(str, row)) + "\n" for row in rows))


def ball(diameter, density=2650.0):
    return math.pi / 6 * diameter ** 3 * density


class Starts(Case):
    def bed(self, *shapes):
        """A few grains that touch nothing and do not move, so that a step leaves them where they are."""
        run = self.folder / "run"
        made = clast("pack", "--curve", "uniform:3mm,4mm", "--mass", "2g", "--initial-speed", "0", *shapes, *LONE, "--force", "-o", run)
        self.assertEqual(made.code, 0, made.err)
        return run

    def check_round(self, run, ending, has_turns=False):
        """Export, start, a step, export: equal bytes, but for turns, which a step makes ones of length 1 anew; and equal bytes by
        a plain conversion of the file."""
        first, again, plain = (self.folder / f"{name}.{ending}" for name in ("first", "again", "plain"))
        self.assertEqual(clast("export", run, "-o", first).code, 0, ending)
        start = clast("pack", "--start", first, "--start-unit", "m", *LONE, "--force", "-o", self.folder / "started")
        self.assertEqual(start.code, 0, (ending, start.err))
        back = clast("export", self.folder / "started", "-o", again)
        self.assertEqual(back.code, 0, (ending, back.err))
        if has_turns:
            for old, new in zip(first.read_text().split(), again.read_text().split(), strict=True):
                if old[0].isalpha():
                    self.assertEqual(old.replace("first", "again"), new)
                elif old != new:
                    self.assertAlmostEqual(float(old), float(new), 14, ending)
        else:
            self.assertEqual(first.read_bytes(), again.read_bytes(), ending)
        converted = clast("export", first, "-o", plain)
        self.assertEqual(converted.code, 0, (ending, converted.err))
        text = plain.read_bytes().replace(b"plain.shp", b"").replace(b"lengths in model", b"lengths in m")
        self.assertEqual(first.read_bytes().replace(b"first.shp", b""), text, ending)
        if ending == "conf":
            self.assertEqual(first.with_suffix(".shp").read_bytes(), again.with_suffix(".shp").read_bytes())

    def test_spheres_come_back_in_every_format(self):
        run = self.bed()
        for ending in SPHERES:
            self.check_round(run, ending, ending in ("dump", "conf"))

    def test_ellipsoids_come_back_from_lammps(self):
        run = self.bed("--shapes", "ellipsoid:1.3,1,0.8", "--shapes", "ellipsoid:2,1,1")
        for ending in ("data", "dump"):
            self.check_round(run, ending, True)

    def test_surfaces_come_back_from_rockable(self):
        run = self.bed("--shapes", "data/standin63/grain00.ply", "--shapes", "data/standin63/grain11.ply", "--shapes", "sphere")
        self.check_round(run, "conf", True)
        for ending, says in (("txt", "spheres and clumps"), ("voro", "holds spheres"), ("xyzd", "holds spheres")):
            self.assert_fails(2, "export", run, "-o", self.folder / f"no.{ending}", says=(says,))
        self.assert_fails(2, "export", self.bed("--shapes", "ellipsoid:2,1,1"), "-o", self.folder / "no.conf", says=("spheres and polyhedra",))

    def test_a_sheared_cell_is_a_start(self):
        """Its images above came back upright: "grains 5 and 11 begin inside of each other"."""
        run = self.folder / "run"
        made = clast("pack", "--curve", "4mm", "--mass", "2g", *LONE[:2], "--width", "18mm", "--height", "18mm", *LONE[6:11], "--seed", "3", "--load-rate", "8/s",
                     "--stages", "isotropic 10kPa until stress", "--stages", "shear 5/s 10kPa until strain 0.2", "-q", "-j", "1", "-o", run, "--json")
        self.assertEqual(made.code, 0, made.err)
        with open(run / "load.csv", encoding="utf-8") as file:
            last = list(csv.DictReader(file))[-1]
        sides = [word for key in ("width", "depth", "height") for word in (f"--{key}", f"{1e3 * float(last[key + '_m']):.6g}mm")]
        self.assertEqual(clast("export", run, "-o", self.folder / "bed.dump").code, 0)
        for start in (run / "state.h5", self.folder / "bed.dump"):
            again = self.folder / "again"
            held = clast("pack", "--start", start, *LONE, *sides, "--force", "-o", again, "--json")
            self.assertEqual(held.code, 0, held.err)
            self.assertEqual(held.json["n_contact"], made.json["n_contact"])
            self.assertLess(held.json["deepest_overlap_start"], 0.05)
            shifts = []
            for path in (run, again):
                self.assertEqual(clast("export", path, "-o", self.folder / "box.dump").code, 0)
                shifts.append(float((self.folder / "box.dump").read_text().split("xz yz pp pp pp\n")[1].split()[2 + 3]))
            self.assertAlmostEqual(*shifts, 7)

    def test_names_that_break_a_format_are_refused(self):
        """A newline in a shape's name began a line of Rockable's library; a blank in the file's own name cut it off in shapeFile."""
        for name in ("two\nlines.ply", "a b.ply", "a#b.ply", "a\x7fb.ply"):
            (self.folder / name).write_bytes((ROOT / "data/standin63/grain00.ply").read_bytes())
            run, bad = self.bed("--shapes", self.folder / name), self.folder / "bad.conf"
            self.assert_fails(2, "export", run, "-o", bad, says=("no blanks and no #",))
            self.assertFalse(bad.exists() or bad.with_suffix(".shp").exists())
            for ending in ("csv", "json", "vtu", "obj", "dump"):
                self.assertEqual(clast("export", run, "-o", self.folder / f"first.{ending}").code, 0)
            with open(self.folder / "first.csv", encoding="utf-8", newline="") as file:
                self.assertEqual({row["shape"] for row in csv.DictReader(file)}, {f"1-{name}".replace("\x7f", "\\x7f")})
            self.assertEqual(len([line for line in (self.folder / "first.obj").read_text().split("\n") if line[:1] not in "vfgo#s"]), 0)
        self.assert_fails(2, "export", self.bed(), "-o", self.folder / "my bed.conf", says=("no blanks and no #",))

    def test_a_density_beside_the_starts_own_is_said(self):
        """The usual 2650 gave way without a word, 2700 was refused."""
        run = self.bed("--density", "2000")
        self.assertEqual(clast("export", run, "-o", self.folder / "bed.data").code, 0)
        for start, whose in ((run / "state.h5", "state"), (self.folder / "bed.data", "file")):
            for density in ("2650", "2700"):
                self.assert_fails(2, "pack", "--start", start, "--start-unit", "m", "--density", density, *LONE, "-o", self.folder / "bad",
                                  says=(f"density is the {whose}'s own; leave it out",))
        again = clast("pack", "--start", run / "state.h5", *LONE, "-o", self.folder / "again", "--json")
        self.assertEqual(again.code, 0, again.err)
        with open(self.folder / "again" / "grains.csv", encoding="utf-8") as file:
            self.assertEqual({float(row["density_kg/m^3"]) for row in csv.DictReader(file)}, {2000.0})

    def test_columns_and_diameter_beside_poses_are_refused(self):
        """They had no effect, without a word."""
        start = self.folder / "poses.csv"
        start.write_text("shape,x_m,y_m,z_m,qw,qx,qy,qz,scale,density_kg/m^3\n1-sphere,0,0,5e-3,1,0,0,0,4e-3,2650\n")
        for option in (("--start-columns", "x,y,z,d"), ("--start-diameter", "3mm")):
            self.assert_fails(2, "pack", "--start", start, "--shapes", "sphere", *option, *LONE, "-o", self.folder / "bad",
                              says=("are for packings of spheres from other programs",))

    def test_old_shapes_stay_where_rockables_configuration_fails(self):
        """The shapes' file was replaced before the configuration was whole."""
        many, shapes = self.folder / "many.data", self.folder / "many.shp"
        many.write_text("\n\n1100 atoms\n1 atom types\n\nAtoms # sphere\n\n"
                        + "".join(f"{i + 1} 1 1 {1000 + i} {2 * i} 0 0\n" for i in range(1100)))
        shapes.write_text("old")
        self.assert_fails(3, "export", many, "-o", self.folder / "many.conf", says=("1024 densities",))
        self.assertEqual(shapes.read_text(), "old")

    def test_files_as_others_write_them(self):
        """LAMMPS's and LIGGGHTS's data, YADE's clumps, Rockable's rounded cube of its documentation."""
        data = self.folder / "liggghts.data"
        data.write_text("LIGGGHTS data file\n\n2 atoms\n2 atom types\n0 1 xlo xhi\n0 1 ylo yhi\n0 1 zlo zhi\n\nAtoms\n\n"
                        "7 2 0.5 2500 0.3 0.3 0.3 0 0 0\n3 1 0.25 1000 0.7 0.7 0.7 0 0 0\n\nVelocities\n\n7 0 0 0 0 0 0\n3 0 0 0 0 0 0\n")
        found = clast("porosity", data, "--bed", "periodic:0,0,0,1,1,1", "--json").json
        self.assertAlmostEqual(found["solid"], 0.5235987755982988 * (0.125 + 0.015625), 14)
        clumps = self.folder / "clumps.txt"
        clumps.write_text("#format x_y_z_r_clumpId\n0.2 0.2 0.2 0.1 -1\n0.5 0.5 0.5 0.1 0\n0.8 0.5 0.5 0.1 0\n")
        found = clast("porosity", clumps, "--bed", "periodic:0,0,0,1,1,1", "--json").json
        self.assertEqual(found["n_grain"], 2)
        self.assertAlmostEqual(found["solid"], 3 * 4.1887902047863905e-3, 6)
        shapes = self.folder / "cube.shp"
        corners = [(x, y, z) for z in (-0.4, 0.4) for x, y in ((0.4, 0.4), (-0.4, 0.4), (-0.4, -0.4), (0.4, -0.4))]
        faces = ["0 1 2 3", "4 5 6 7", "0 1 5 4", "2 3 7 6", "1 2 6 5", "0 4 7 3"]
        shapes.write_text("<\nname Cube\nradius 0.1\npreCompDone y\nnv 8\n" + "".join(f"{x} {y} {z}\n" for x, y, z in corners) +
                          "ne 0\nnf 6\n" + "".join(f"4 {f}\n" for f in faces) + "volume 0.975587\n>\n")
        conf = self.folder / "cube.conf"
        conf.write_text("Rockable 29-11-2018\nt 0\nshapeFile cube.shp\ndensity 0 2600\nParticles 1\n#name group ...\n"
                        "Cube 0 0 2 1.5 1.5 1.5 0 0 0 0 0 0 1 0 0 0 0 0 0 0 0 0\n")
        found = clast("porosity", conf, "--bed", "periodic:0,0,0,3,3,3", "--layer", 0.1, "--json")
        self.assertEqual(found.code, 0, found.err)
        self.assertLess(abs(found.json["solid"] / (8 * 0.975587) - 1), 0.01)  # a hull of 42 points a corner lies inside
        self.assertLess(found.json["solid"], 8 * 0.975587)

    def test_bad_files_are_said_with_their_line(self):
        def wrong(name, text, *says):
            path = self.folder / name
            path.write_text(text)
            self.assert_fails(3, "porosity", path, "--bed", "periodic:0,0,0,1,1,1", says=says)

        box = ("two\n\n1 atoms\n1 ellipsoids\n1 atom types\n0 1 xlo xhi\n0 1 ylo yhi\n0 1 zlo zhi\n\n"
               "Atoms # ellipsoid\n\n1 1 1 2500 0.5 0.5 0.5\n\nEllipsoids\n\n")
        wrong("half.data", box + "1.5 0.2 0.2 0.2 1 0 0 0\n", "there is no atom 1.5")
        wrong("slant.data", "two\n\n1 atoms\n1 atom types\n1 0 0 avec\n0 1 0 bvec\n0 0 1 cvec\n0 0 0 abc origin\n\nAtoms\n\n1 1 0.5 2500 0.5 0.5 0.5\n")
        faces = "0.4 0 0\n0 0.4 0\n0 0 0.4\n0 0 0\n"
        (self.folder / "half.shp").write_text(f"<\nname T\nradius 0.1\npreCompDone y\nnv 4\n{faces}ne 0\nnf 4\n3.5 0 1 2\n3 0 3 1\n3 1 3 2\n3 2 3 0\n>\n")
        wrong("half.conf", "Rockable 29-11-2018\nt 0\nshapeFile half.shp\ndensity 0 2600\nParticles 1\nT 0 0 1 1 1 1 0 0 0 0 0 0 1 0 0 0 0 0 0 0 0 0\n",
              "3.5 corners")
        head = "x\n\n1 atoms\n1 atom types\n\n"
        wrong("a.data", head + "Atoms # bond\n\n1 1 1 0 0 0\n", ":6:", "style 'bond'", "sphere")
        wrong("a.data", head + "Atoms # sphere\n\n1 1 0.5 2500 0 0\n", ":8:", "6 words", "has 7")
        wrong("a.data", head + "Atoms # sphere\n\n1 1 x 2500 0 0 0\n", ":8:", "word 3, 'x'")
        wrong("a.data", head + "Atoms # sphere\n\n1 0 1 2500 0 0 0\n", "row 1", "type 0")
        wrong("a.data", head + "Bonds\n\n1 1 1 2\n", ":6:", "section 'Bonds'")
        wrong("a.data", head, "no section Atoms")
        wrong("a.data", "x\n\n9000000 atoms\n", ":3:", "the file holds fewer")
        shape = self.folder / "s.shp"
        conf = "Rockable 29-11-2018\nshapeFile s.shp\nParticles 1\nball 0 0 1 0 0 0 0 0 0 0 0 0 1 0 0 0\n"
        self.assertFalse(shape.exists())
        wrong("a.conf", conf, "s.shp")
        shape.write_text("<\nname ball\nradius 1\nnv 1\n0 0\n>\n")
        wrong("a.conf", conf, "s.shp:5", "a vertex is missing")
        shape.write_text("<\nname cube\nradius 1\nnv 1\n0 0 0\n>\n")
        wrong("a.conf", conf, "a.conf:4", "shape 'ball' is none")
        shape.write_text("<\nname ball\nradius 1\nnv 1\n0 0 0\n>\n")
        wrong("a.conf", conf.replace("1 0 0 0\n", "1 0 0\n"), "a.conf:4", "16 words")
        wrong("a.conf", conf.replace("Particles", "nDriven 1\nParticles"), "a.conf:3", "driven")
        wrong("a.conf", "Rockable\n" + "Particles 0\n", "no shapeFile")
        (self.folder / "b.xyzd").write_bytes(struct.pack("<5d", 1, 2, 3, 4, 5))
        self.assert_fails(3, "porosity", self.folder / "b.xyzd", "--bed", "periodic:0,0,0,1,1,1", says=("40 bytes",))

    def write(self, name, text):
        path = self.folder / name
        path.write_text(text, encoding="utf-8")
        return path

    def masses(self, start, *options):
        """Mass of the bed that begins with a file, without a step's change."""
        made = clast("pack", "--start", start, *BOX, *options)
        self.assertEqual(made.code, 0, made.err)
        return made.json["mass"]

    def test_a_given_diameter_is_in_metres_whatever_the_unit_of_places(self):
        """start_unit scaled it a second time: grains of 4 mm were 4 um, exit code 0."""
        places = "2,2,2\n6,2,2\n2,6,2\n6,6,2\n"
        csv4 = self.write("c4.csv", "x,y,z\n" + places)
        xyz = self.write("c4.xyz", "4\nfour\n" + "".join("C " + row.replace(",", " ") + "\n" for row in places.split()))
        known = self.write("mm.csv", "x_mm,y_mm,z_mm\n" + places)
        for start, unit in ((csv4, ("--start-unit", "mm")), (xyz, ("--start-unit", "mm")), (known, ()), (known, ("--start-unit", "mm"))):
            self.assertAlmostEqual(self.masses(start, *unit, "--start-diameter", "4mm") / (4 * ball(4e-3)), 1.0, 12, start)
        dump = self.write("c4.dump", snapshot(0, [(1, 0.2, 0.2, 0.2)], "id x y z", "cgs"))
        self.assertAlmostEqual(self.masses(dump, "--start-diameter", "4mm") / ball(4e-3), 1.0, 12)
        clumps = self.write("clump.txt", "#format x_y_z_r_clumpId\n3 3 3 9 0\n6 3 3 9 0\n")
        self.assertAlmostEqual(self.masses(clumps, "--start-unit", "mm", "--start-diameter", "2mm") / (2 * ball(2e-3)), 1.0, 3)

    def test_the_last_of_several_snapshots_is_read_and_told(self):
        """The first was, without a word: LAMMPS's dumps begin with grains that have not settled."""
        dump = self.write("two.dump", snapshot(0, [(1, 2, 2, 12, 1)]) + snapshot(500, [(1, 5, 5, 2, 2)]))
        xyz = self.write("two.xyz", "1\nfirst\nC 2 2 12 1\n1\nsecond\nC 5 5 2 2\n")
        for path, says in ((dump, "snapshot 2 of 2, TIMESTEP 500"), (xyz, "snapshot 2 of 2")):
            begun = clast("pack", "--start", path, "--start-unit", "mm", *BOX)
            self.assertEqual(begun.code, 0, begun.err)
            self.assertIn(says, begun.err)
            self.assertEqual((begun.json["start_snapshot"], begun.json["n_start_snapshot"]), (2, 2))
            self.assertEqual(begun.json.get("start_step"), 500 if path == dump else None)
            self.assertAlmostEqual(begun.json["mass"] / ball(4e-3), 1.0, 12)
            bulk = clast("porosity", path, "--bed", "box:0,0,20,20", "--layer", 1, "--cut", 1, "--json")
            self.assertEqual(bulk.code, 0, bulk.err)
            self.assertIn(says, bulk.err)
            self.assertEqual((bulk.json["snapshot"], bulk.json["n_snapshot"]), (2, 2))
            self.assertAlmostEqual(bulk.json["solid"] / ball(4, 1), 1.0, 12)
            out = clast("export", path, "-o", self.folder / "out.dump", "--json")
            self.assertEqual(out.code, 0, out.err)
            self.assertIn(says, out.err)
            self.assertEqual((out.json["snapshot"], out.json["n_snapshot"]), (2, 2))
            if path == dump:
                self.assertEqual(out.json["step"], 500)
                self.assertIn("ITEM: TIMESTEP\n500\n", (self.folder / "out.dump").read_text(encoding="utf-8"))
        first = clast("pack", "--start", dump, "--start-unit", "mm", "--start-frame", "0", *BOX)
        self.assertAlmostEqual(first.json["mass"] / ball(2e-3), 1.0, 12)
        self.assertIn("snapshot 1 of 2, TIMESTEP 0", first.err)
        self.assert_fails(3, "pack", "--start", dump, "--start-unit", "mm", "--start-frame", "2", *BOX, says=("no snapshot 2 among 2",))
        self.assert_fails(3, "pack", "--start", xyz, "--start-unit", "mm", "--start-frame", "-3", *BOX, says=("no snapshot -3 among 2",))
        one = self.write("one.csv", "x,y,z,d\n5,5,2,4\n")
        self.assert_fails(2, "pack", "--start", one, "--start-unit", "mm", "--start-frame", "0", *BOX, says=("--start-frame 0: snapshots are those of",))
        lone = self.write("lone.dump", snapshot(7, [(1, 5, 5, 2, 2)]))
        self.assertNotIn("snapshot", clast("pack", "--start", lone, "--start-unit", "mm", *BOX).err)

    def test_a_density_of_a_table_counts_in_its_unit(self):
        """A table's densities were passed over without a word, for 2650."""
        for column, value in (("density", 2000), ("density_kg/m^3", 2000), ("density_g/cm3", 2), ("rho", 2000), ("Density (g/cm^3)", 2), ("rho [kg/m3]", 2000),
                              ("density [ g/cm3 ]", 2), ("density mean (g/cm3)", 2), ("density g/cm3", 2),
                              ("mass_g", 1e3 * ball(4e-3, 2000)), ("mass_kg", ball(4e-3, 2000))):
            table = self.write("d.csv", f"x_mm,y_mm,z_mm,d_mm,{column}\n5,5,2,4,{value}\n")
            self.assertAlmostEqual(self.masses(table) / ball(4e-3, 2000), 1.0, 12, column)
            self.assert_fails(2, "pack", "--start", table, "--density", "2500", *BOX, says=("density is the file's own; leave it out",))
            plain = self.write("p.csv", f"x,y,z,d,{column}\n5,5,2,4,{value}\n")
            self.assertAlmostEqual(self.masses(plain, "--start-unit", "mm") / ball(4e-3, 2000), 1.0, 12, column)
        listed = self.write("l.txt", "5 5 2 4 2000\n5 15 2 4 2000\n")
        options = ("--start-unit", "mm", "--start-columns")
        self.assertAlmostEqual(self.masses(listed, *options, "x,y,z,d,density") / (2 * ball(4e-3, 2000)), 1.0, 12)
        self.assertAlmostEqual(self.masses(listed, *options, "x,y,z,d,-") / (2 * ball(4e-3)), 1.0, 12)
        self.assert_fails(3, "pack", "--start", self.write("b.csv", "x_mm,y_mm,z_mm,d_mm,density\n5,5,2,4,0\n"), *BOX, says=("row 1", "density 0"))
        for options in ((), ("--start-columns", "x,y,z,d,density")):
            self.assert_fails(3, "pack", "--start", self.write("b.csv", "x_mm,y_mm,z_mm,d_mm,density (lb/ft3)\n5,5,2,4,160\n"), *BOX, *options,
                              says=("density (lb/ft3)", "kg/m^3"))

    def test_units_of_a_dump_count(self):
        """ITEM: UNITS was passed over, even in clast's own dumps, and the hint that followed made a bed 1000 times too small."""
        for word, metre, density, mass in (("si", 1, 1, 1), ("cgs", 1e-2, 1e3, 1e-3), ("micro", 1e-6, 1e3, 1e-15), ("nano", 1e-9, 1e6, 1e-21),
                                           ("real", 1e-10, 1e3, 1e-3 / 6.02214076e23), ("metal", 1e-10, 1e3, 1e-3 / 6.02214076e23)):
            sizes = [1e-2 / metre, 1e-2 / metre, 2e-3 / metre, 2e-3 / metre]
            for column, value in (("density", 2000 / density), ("mass", ball(4e-3, 2000) / mass)):
                dump = self.write("u.dump", snapshot(0, [(1, *sizes, value)], f"id x y z radius {column}", word))
                self.assertAlmostEqual(self.masses(dump) / ball(4e-3, 2000), 1.0, 12, (word, column))
            self.assertAlmostEqual(self.masses(self.write("u.dump", snapshot(0, [(1, *sizes)], units=word))) / ball(4e-3), 1.0, 12, word)
        cgs = self.write("cgs.dump", snapshot(0, [(1, 1, 1, 0.2, 0.2)], units="cgs"))
        self.assertAlmostEqual(self.masses(cgs, "--start-unit", "cm") / ball(4e-3), 1.0, 12)
        self.assert_fails(2, "pack", "--start", cgs, "--start-unit", "mm", *BOX, says=("cm", "not in mm", "start_unit"))
        lj = self.write("lj.dump", snapshot(0, [(1, 1, 1, 0.2, 0.2)], units="lj"))
        self.assert_fails(2, "pack", "--start", lj, *BOX, says=("unit of its lengths is not known",))
        self.assertAlmostEqual(self.masses(lj, "--start-unit", "cm") / ball(4e-3), 1.0, 12)
        run, own = self.bed(), self.folder / "own.dump"
        self.assertEqual(clast("export", run, "-o", own).code, 0)
        back = clast("pack", "--start", own, *LONE, "--json")
        self.assertEqual(back.code, 0, back.err)
        state = clast("pack", "--start", run / "state.h5", *LONE, "--json")
        self.assertAlmostEqual(back.json["mass"] / state.json["mass"], 1.0, 12)

    def test_messages_name_options_that_the_command_has(self):
        """They were those of clast porosity."""
        ids, five, named = (self.write("i.txt", "1 5 5 2\n2 5 15 2\n"), self.write("f.txt", "7 5 5 2 4\n9 5 15 2 4\n"), self.write("n.csv", "x,y,z\n1,2,3\n"))
        for start, options in ((ids, ("--start-diameter", "--start-columns")), (five, ("--start-columns",)), (named, ("--start-diameter",))):
            said = self.assert_fails(3, "pack", "--start", start, "--start-unit", "mm", *BOX, says=options).err
            self.assertNotIn("--diameter", said)
            self.assertNotIn("--columns", said)
            self.assert_fails(3, "porosity", start, "--bed", "box:0,0,20,20", says=tuple(o.replace("start-", "") for o in options))
        self.assert_fails(2, "pack", "--start", ids, "--start-unit", "mm", "--start-columns", "id,x", *BOX, says=("--start-columns",))

    def test_an_export_invents_no_density(self):
        """1 kg/m3 went out as a fact: LAMMPS got stone 2650 times too light."""
        bare = self.write("bare.csv", "x_mm,y_mm,z_mm,d_mm\n5,5,2,4\n15,5,2,4\n")
        for ending in ("data", "conf"):
            self.assert_fails(2, "export", bare, "-o", self.folder / f"no.{ending}", says=("density", "--density"))
            self.assertFalse((self.folder / f"no.{ending}").exists())
        for ending in ("csv", "json", "dump", "vtu", "txt", "voro", "xyzd"):
            out = self.folder / f"out.{ending}"
            self.assertEqual(clast("export", bare, "-o", out).code, 0, ending)
            for word in (b"density", b"mass"):
                self.assertNotIn(word, out.read_bytes(), ending)
        for ending, says in (("data", " 2500 "), ("conf", "density 0 2500"), ("dump", " 2500\n"), ("csv", "density_kg/m^3"), ("vtu", "density")):
            out = self.folder / f"given.{ending}"
            made = clast("export", bare, "-o", out, "--density", "2.5g/cm3")
            self.assertEqual(made.code, 0, made.err)
            self.assertIn(says, out.read_text(encoding="utf-8"), ending)
        self.assert_fails(2, "export", bare, "-o", self.folder / "no.voro", "--density", "2500", says=("--density does nothing",))
        told = self.write("told.csv", "x_mm,y_mm,z_mm,d_mm,density\n5,5,2,4,2000\n")
        self.assert_fails(2, "export", told, "-o", self.folder / "no.data", "--density", "2500", says=("density is the file's own; leave it out",))
        out = self.folder / "told.data"
        self.assertEqual(clast("export", told, "-o", out).code, 0)
        self.assertIn(" 2000 ", out.read_text(encoding="utf-8"))
        self.assertAlmostEqual(self.masses(bare, "--density", "2500") / (2 * ball(4e-3, 2500)), 1.0, 12)  # a start has its own option
        ids = self.write("ids.txt", "1 5 5 2\n2 5 15 2\n")  # voro++
        self.assert_fails(3, "export", ids, "-o", out, says=("--diameter", "--columns"))
        made = clast("export", ids, "-o", out, "--diameter", "4", "--density", "2500")
        self.assertEqual(made.code, 0, made.err)
        self.assertIn("\n1 1 4 2500 5 5 2\n", out.read_text(encoding="utf-8"))


if __name__ == "__main__":
    unittest.main()
