"""CLI: clast shape measures whatever holds grains, and says one line about what it cannot."""
import csv
import json
import math
import unittest

from clitest import ROOT, Case, clast, shared

DATA = ROOT / "data"
KEYS = ["file", "volume", "area", "L", "I", "S", "D", "flatness", "elongation", "equancy", "aschenbrenner_shape_factor",
        "corey_shape_factor", "disc_rod_index", "illenberger_form_index", "illenberger_rod_index", "janke_form_factor",
        "krumbein_intercept_sphericity", "maximum_projection_sphericity", "oblate_prolate_index",
        "wentworth_flatness_index", "sphericity", "convexity", "moments", "centroid"]
BOX = """OFF
8 6 0
0 0 0
2 0 0
2 3 0
0 3 0
0 0 6
2 0 6
2 3 6
0 3 6
4 0 3 2 1
4 4 5 6 7
4 0 1 5 4
4 1 2 6 5
4 2 3 7 6
4 3 0 4 7
"""


class Shape(Case):
    def put(self, name, text):
        path = self.folder / name
        path.write_text(text)
        return path

    def test_json_has_the_stable_keys_and_a_boxs_numbers(self):
        result = clast("shape", self.put("box.off", BOX), "--json")
        self.assertEqual((result.code, result.err), (0, ""))
        grain = result.json["grains"][0]
        for key in KEYS:
            self.assertIn(key, grain)
        self.assertAlmostEqual(grain["volume"], 36.0, places=12)
        self.assertAlmostEqual(grain["L"], 12.0 * math.sqrt(5.0 / 12.0), places=12)
        self.assertAlmostEqual(grain["D"], math.sqrt((9 + 4) / 2.0 * 5.0 / 3.0), places=12)
        self.assertAlmostEqual(grain["flatness"], 2.0 / 3.0, places=12)
        self.assertAlmostEqual(grain["inverse"]["equancy"], 3.0, places=12)
        self.assertAlmostEqual(grain["moments"][0], 36.0 * 13.0 / 12.0, places=11)
        self.assertAlmostEqual(grain["feret_max"], 7.0, places=12)
        self.assertEqual(result.json["unit"], "model")

    def test_axes_choose_the_definition(self):
        box = self.put("box.off", BOX)
        for axes, length in (("box", 6.0), ("fitted", 7.0), ("feret", 7.0), ("principal", 6.0)):
            grain = clast("shape", box, "--axes", axes, "--json").json["grains"][0]
            self.assertAlmostEqual(grain["L"], length, places=11)
            self.assertAlmostEqual(grain["by_definition"][axes]["L"], length, places=11)

    def test_unit_gives_si_and_columns_with_units(self):
        out = self.folder / "grains.csv"
        result = clast("shape", self.put("box.off", BOX), "--unit", "mm", "-o", out, "--json")
        self.assertEqual(result.json["unit"], "m")
        self.assertAlmostEqual(result.json["grains"][0]["volume"], 36e-9, places=20)
        with open(out, encoding="utf-8") as file:
            row = next(csv.DictReader(file))
        self.assertAlmostEqual(float(row["volume_m3"]), 36e-9, places=20)
        self.assertAlmostEqual(float(row["box_L_m"]), 6e-3, places=14)
        self.assertAlmostEqual(float(row["inverse_flatness"]), 1.5, places=12)
        self.assertEqual(row["kind"], "surface")

    def test_series_have_their_published_volume(self):
        result = clast("shape", DATA / "shapes/sh-grains/fdot57-A-anm-00001.dat", "--level", "3", "--json")
        grain = result.json["grains"][0]
        self.assertEqual(grain["kind"], "series")
        self.assertAlmostEqual(grain["volume"] / 3083.215147, 1.0, places=9)
        self.assertAlmostEqual(grain["area"] / 1193.622617, 1.0, places=4)

    def test_voxels_give_a_grain_a_label(self):
        text = ["Xsize: 24", "Ysize: 12", "Zsize: 12", "Resolution: 2"]
        for z in range(12):
            for y in range(12):
                for x in range(24):
                    inside = (x % 12 - 5.5) ** 2 + (y - 5.5) ** 2 + (z - 5.5) ** 2 < 25
                    text.append(str((4 if x < 12 else 9) * inside))
        result = clast("shape", self.put("two.txt", "\n".join(text)), "--json")
        grains = result.json["grains"]
        self.assertEqual([g["file"].split("#")[1] for g in grains], ["4", "9"])
        self.assertEqual(grains[0]["n_voxel"], grains[1]["n_voxel"])
        self.assertAlmostEqual(grains[1]["centroid"][0] - grains[0]["centroid"][0], 24.0, places=3)
        hull = clast("shape", self.folder / "two.txt", "--hull", "--json").json["grains"]
        self.assertGreater(hull[0]["sphericity"], 0.85)

    def test_points_give_their_hull_or_their_cubes(self):
        rows = ["x,y,z"] + [f"{x},{y},{z}" for x in range(9) for y in range(8) for z in range(7)]
        points = self.put("points.csv", "\n".join(rows))
        grain = clast("shape", points, "--json").json["grains"][0]
        self.assertEqual(grain["kind"], "points")
        self.assertAlmostEqual(grain["volume"], 8.0 * 7.0 * 6.0, places=9)
        cubes = clast("shape", points, "--spacing", "1", "--json").json["grains"][0]
        self.assertAlmostEqual(cubes["volume"] / (9 * 8 * 7), 1.0, delta=0.1)  # rounded corners

    def test_table_rows_are_grains_and_bad_rows_are_told(self):
        table = self.put("t.csv", "L,I,S\n3,2,1\n4,,1\n1,2,3\n5,inf,1\n-1,1,1\n")
        result = clast("shape", table, "--json")
        self.assertEqual(result.code, 0)
        self.assertEqual(len(result.json["grains"]), 1)
        grain = result.json["grains"][0]
        self.assertAlmostEqual(grain["L"], 3.0, places=12)
        self.assertIsNone(grain["volume"])
        self.assertIn("4 of 5 rows left out", result.err)
        self.assertIn("4 of 5 rows left out", result.json["left_out"][0]["text"])
        ratios = clast("shape", self.put("r.csv", "FL,EL\n0.5,0.5\n"), "--json").json["grains"][0]
        self.assertIsNone(ratios["L"])
        self.assertAlmostEqual(ratios["equancy"], 0.25, places=12)

    def test_bad_files_get_a_line_each_and_the_rest_is_measured(self):
        lines = BOX.splitlines()
        opened = self.put("open.off", "\n".join([lines[0], "8 5 0"] + lines[2:-1]) + "\n")
        turned = self.put("turned.off", "\n".join(lines[:10] + ["4 " + " ".join(reversed(f.split()[1:]))
                                                                for f in lines[10:]]) + "\n")
        flat = self.put("flat.off", BOX.replace(" 6\n", " 0\n"))
        result = clast("shape", opened, self.put("box.off", BOX), turned, flat, "--json")
        self.assertEqual(result.code, 3)
        self.assertEqual(len(result.json["grains"]), 1)
        errors = result.err.splitlines()
        self.assertEqual(len(errors), 3)
        self.assertIn("open.off is not a closed, outward surface: 4 open edges", errors[0])
        self.assertIn("--hull", errors[0])
        self.assertIn("turned.off is not a closed, outward surface: 1 part inside out", errors[1])
        self.assertIn("thickness", errors[2])
        hull = clast("shape", opened, "--hull", "--json")
        self.assertEqual(hull.code, 0)
        self.assertAlmostEqual(hull.json["grains"][0]["volume"], 36.0, places=12)
        self.assert_fails(3, "shape", self.folder / "none.stl", says=["none.stl"])
        self.assert_fails(2, "shape", opened, "--unit", "parsec", says=["parsec"])

    def test_surfaces_are_written(self):
        result = clast("shape", DATA / "shapes/sh-grains/fdot57-A-anm-00001.dat", "--level", "2", "--surfaces",
                       self.folder)
        self.assertEqual(result.code, 0, result.err)
        check = clast("mesh", "check", self.folder / "fdot57-A-anm-00001.ply", "--json").json
        self.assertTrue(check["closed"])
        self.assertEqual(check["n_triangle"], 320)

    def test_no_surface_takes_the_place_of_another(self):
        """They are named by the file alone: of two g.ply, which one stayed hung on the number of threads."""
        for name in "ab":
            (self.folder / name).mkdir()
        out = self.folder / "out"
        first, second = self.put("a/g.off", BOX), self.put("b/g.off", BOX)
        for files in ((first, second), (second, self.put("a/h.off", BOX), first), (first, first)):
            self.assert_fails(2, "shape", *files, "--surfaces", out, says=("g.off and ", "would both write", "out/g.ply"))
        labels = "Xsize: 8\nYsize: 8\nZsize: 8\nResolution: 1\n" + "\n".join(str(int(0 < min(x, y, z) and max(x, y, z) < 7))
                                                                             for z in range(8) for y in range(8) for x in range(8)) + "\n"
        voxels, like, marked = self.put("a/g.txt", labels), self.put("b/g.txt", labels), self.put("b/g#1.off", BOX)
        self.assert_fails(2, "shape", voxels, like, "--surfaces", out, says=("a/g.txt and ", "b/g.txt would both write", "out/g#LABEL.ply"))
        self.assert_fails(2, "shape", marked, voxels, "--surfaces", out, says=("g#1.off and ", "g.txt would both write", "out/g#1.ply"))
        self.assertEqual(list(out.glob("*")) if out.exists() else [], [])
        out.mkdir(exist_ok=True)
        other = self.put("b/g#2.off", BOX)
        table, points = self.put("b/g.csv", "L,I,S\n3,2,1\n"), self.put("a/g.csv", "x,y,z\n0,0,0\n1,0,0\n0,1,0\n0,0,1\n")
        for files, names in (((first, voxels, table), ["g#1.ply", "g.ply"]), ((first, self.put("b/g-1.off", BOX)), ["g-1.ply", "g.ply"])):
            done = clast("shape", *files, "--surfaces", out)
            self.assertEqual((done.code, sorted(p.name for p in out.iterdir())), (0, names), done.err)
            for path in out.iterdir():
                path.unlink()
        self.assert_fails(2, "shape", other, voxels, "--surfaces", out, says=("g#2.off",))  # which labels are there is not known yet
        self.assert_fails(2, "shape", first, points, "--surfaces", out, says=("g.off and ", "g.csv would both write"))
        self.assertEqual(clast("shape", first, second).code, 0)

    def test_words_of_tables_do_not_name_a_definition(self):
        """\"2 grains; L, I, S by ellipsoid\" of a table's own."""
        table, one = self.put("t.csv", "L,I,S\n3,2,1\n2,2,2\n"), self.put("one.csv", "L,I,S\n3,2,1\n")
        self.assertIn("2 grains; L, I, S by the table; ", clast("shape", table).out)
        self.assertIn("form factors of L, I, S by the table:", clast("shape", one).out)
        self.assertIn("3 grains; L, I, S by box, of rows by their table; ", clast("shape", table, self.put("b.off", BOX), "--axes", "box").out)
        self.assertIn("2 grains; L, I, S by feret; ", clast("shape", self.put("b.off", BOX), self.put("c.off", BOX), "--axes", "feret").out)
        self.assertEqual([clast("shape", f, "--json").json["axes"] for f in (table, self.folder / "b.off")], ["table", "ellipsoid"])

    def test_a_class_does_not_hang_on_the_unit(self):
        """I/L of a box 3:2:1 is 2/3, the rounder side; a tenth of it was a blade by 1e-16, in an STL by 1e-8."""
        box = self.folder / "box.off"
        sides = [(float(x) * 1 / 2, float(y) * 2 / 3, float(z) * 3 / 6) for x, y, z in (line.split() for line in BOX.splitlines()[2:10])]
        box.write_text("\n".join(["OFF", "8 6 0", *("{} {} {}".format(*v) for v in sides), *BOX.splitlines()[10:]]) + "\n")
        self.assertEqual(clast("shape", box, "--json").json["grains"][0]["zingg"], "disc")
        for scale in (0.1, 0.7, 1e-3, 3e-6, 1.1):
            for name in ("out.ply", "out.stl"):
                self.assertEqual(clast("mesh", "convert", box, "--scale", scale, "-o", self.folder / name).code, 0)
                self.assertEqual(clast("shape", self.folder / name, "--json").json["grains"][0]["zingg"], "disc", (scale, name))

    def test_threads_do_not_change_a_byte(self):
        files = sorted(DATA.glob("scarlet/stl/27sk21*.stl")) + [self.put("box.off", BOX)]
        one = clast("shape", *files, "--json", "-j", "1").out
        self.assertEqual(one, clast("shape", *files, "--json", "-j", "4").out)

    def test_spheres_are_one_clump(self):
        clump = self.put("clump.csv", "x_mm,y_mm,z_mm,r_mm\n0,0,0,1\n0,0,1.5,1\n")
        found = clast("shape", clump, "--json").json
        grain = found["grains"][0]
        self.assertEqual((found["unit"], grain["kind"], grain["zingg"]), ("m", "clump", "rod"))
        self.assertAlmostEqual(grain["area"] * 1e6, 4 * 3.141592653589793 * 1.75, 9)
        self.assertAlmostEqual(grain["feret_max"] * 1e3, 3.5, 12)
        self.assertIsNone(grain["feret_min"])
        self.assertIsNone(grain["by_definition"]["box"]["L"])
        self.assertIsNone(clast("shape", clump, "--axes", "box", "--json").json["grains"][0]["zingg"])
        out = clast("shape", clump).out
        self.assertIn("Feret              0.0035, - m (greatest, least)", out)
        self.assertNotIn("nan", out)

    def test_words_name_every_factor_with_its_formula(self):
        out = clast("shape", self.put("box.off", BOX)).out
        for text in ("Corey shape factor", "S/sqrt(L I)", "roundness", "L, I, S box        6, 3, 2", "Zingg class"):
            self.assertIn(text, out)
        help_text = clast("shape", "--help-all").out
        for key in KEYS[7:20]:
            self.assertIn(key + " = ", help_text)

    def test_the_rhine_scans_have_their_published_dimensions(self):
        scan = shared("sediment/sediment_scan_0.obj")
        if scan is None:
            return
        grain = clast("shape", scan, "--json").json["grains"][0]
        for key, value in (("volume", 0.86197691), ("L", 2.400931), ("I", 1.291653), ("S", 0.575876), ("D", 1.0),
                           ("flatness", 0.445844), ("elongation", 0.537980), ("equancy", 0.239855)):
            self.assertAlmostEqual(grain[key], value, delta=1e-6)
        self.assertAlmostEqual(grain["area"], 6.04025, delta=1e-5)
        self.assertAlmostEqual(grain["sphericity"], 0.7251, delta=1e-4)


class Output(Case):
    def test_the_table_is_in_the_format_that_the_ending_names(self):
        """It was CSV under any name."""
        grain, out = ROOT / "data/standin63/grain00.ply", self.folder / "grains.json"
        self.assertEqual(clast("shape", grain, "-o", out).code, 0)
        columns = {column["name"]: column["values"] for column in json.loads(out.read_text())["columns"]}
        self.assertEqual(columns["L"], [clast("shape", grain, "--json").json["grains"][0]["L"]])
        self.assert_fails(2, "shape", grain, "-o", self.folder / "grains.txt", says=("grains.txt: a table is written as .csv or .json",))
        self.assertFalse((self.folder / "grains.txt").exists())

    def test_options_of_other_kinds_of_files_are_refused(self):
        """Each was taken, and the numbers were those without it; no surface of a table was written."""
        table = self.folder / "t.csv"
        table.write_text("L,I,S\n3,2,1\n4,3,2\n")
        for file, option in ((ROOT / "data/standin63/grain00.ply", ("--columns", "L,I,S")), (ROOT / "data/standin63/grain00.ply", ("--voxel-edge", 2)),
                             (table, ("--hull",)), (table, ("--axes", "feret")), (table, ("--surfaces", self.folder / "none"))):
            self.assert_fails(2, "shape", file, *option, says=(f"{option[0]} does nothing with files of these kinds",))


class InsideOut(Case):
    def test_hull_of_an_inside_out_tetrahedron_adds_nothing(self):
        path = self.folder / "inside.obj"
        path.write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 4 2\nf 1 3 4\nf 2 4 3\n")
        self.assert_fails(3, "shape", path, says=("inside out",))
        (grain,) = clast("shape", path, "--hull", "--json").json["grains"]
        self.assertAlmostEqual(grain["hull_volume_added"], 0.0, 12)  # it was -2


if __name__ == "__main__":
    unittest.main()
