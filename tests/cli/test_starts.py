#!/usr/bin/env python3
"""clast export and clast pack --start: packings of other programs come and go without losing a digit."""
import csv
import struct
import unittest

from clitest import ROOT, Case, clast

LONE = ["--domain", "cell", "--width", "40mm", "--height", "40mm", "--floor=no", "--gravity", "0", "--fluid-density", "0",
        "--stages", "hold until time 1s", "--max-steps", "1", "--quiet", "-j", "1"]
SPHERES = ("data", "dump", "txt", "voro", "xyzd", "conf")


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
        self.assertEqual(first.read_bytes().replace(b"first.shp", b"").replace(b"ITEM: UNITS\nsi\n", b""), text, ending)
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


if __name__ == "__main__":
    unittest.main()
