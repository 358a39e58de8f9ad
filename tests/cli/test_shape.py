"""CLI: clast shape measures whatever holds grains, and says one line about what it cannot."""
import csv
import json
import math
import pathlib
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

    def test_angularity_is_the_mean_over_directions(self):
        """1.25 % low: facets were taken at their middles, where they are nearest."""
        obj = self.folder / "grain.obj"
        self.assertEqual(clast("mesh", "convert", DATA / "standin63/grain31.ply", "-o", obj).code, 0)
        grain = clast("shape", obj, "--json").json["grains"][0]
        axes = grain["by_definition"]["ellipsoid"]
        lines = [line.split() for line in obj.read_text().splitlines()]
        points = [[float(x) - c for x, c in zip(w[1:4], grain["centroid"])] for w in lines if w[:1] == ["v"]]
        planes = []  # of a convex grain, as normal / distance: r = 1 / (greatest of n.d)
        for w in lines:
            if w[:1] == ["f"]:
                a, b, c = (points[int(x.split("/")[0]) - 1] for x in w[1:4])
                u, v = [y - x for x, y in zip(a, b)], [y - x for x, y in zip(a, c)]
                n = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]
                h = sum(x * y for x, y in zip(n, a))
                planes.append([x / h for x in n])
        total, n_ray = 0.0, 3000
        for k in range(n_ray):  # Fibonacci's lattice
            z = 1 - (2 * k + 1) / n_ray
            turn, s = math.pi * (1 + math.sqrt(5)) * (k + 0.5), math.sqrt(1 - z * z)
            d = (s * math.cos(turn), s * math.sin(turn), z)
            r = 1 / max(p[0] * d[0] + p[1] * d[1] + p[2] * d[2] for p in planes)
            total += abs(r * math.hypot(*(2 / axes[name] * sum(x * y for x, y in zip(e, d))
                                          for name, e in zip("LIS", axes["direction"]))) - 1)
        self.assertLess(abs(grain["angularity"] / (total / n_ray) - 1), 4e-3)

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

    def test_a_missing_folder_of_surfaces_is_told_before_the_work(self):
        """It was told of each file, once all had been measured."""
        grains, none = [ROOT / f"data/standin63/grain0{k}.ply" for k in (0, 1)], self.folder / "none"
        self.assert_fails(4, "shape", *grains, "--surfaces", none, "-o", self.folder / "t.csv", says=(f"cannot write surfaces into {none}: No such file",))
        self.assertEqual(list(self.folder.iterdir()), [])

    def test_surfaces_are_written(self):
        result = clast("shape", DATA / "shapes/sh-grains/fdot57-A-anm-00001.dat", "--level", "2", "--surfaces",
                       self.folder)
        self.assertEqual(result.code, 0, result.err)
        check = clast("mesh", "check", self.folder / "fdot57-A-anm-00001.ply", "--json").json
        self.assertTrue(check["closed"])
        self.assertEqual(check["n_triangle"], 320)

    def test_faces_of_vtk_files_are_not_passed_over(self):
        """A surface in VTK was measured as the hull of its points: an L of convexity 0.71 had 1, without a word."""
        head = "# vtk DataFile Version 3.0\nx\nASCII\nDATASET {}\nPOINTS 4 double\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n"
        facets = "4 16\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n"
        tetra, dots = "CELLS 1 5\n4 0 1 2 3\nCELL_TYPES 1\n10\n", "CELLS 2 4\n1 0\n1 1\nCELL_TYPES 2\n1\n1\n"
        xml = ('<?xml version="1.0"?>\n<VTKFile type="{0}" version="0.1"><{0}><Piece NumberOfPoints="4" {1}><Points>'
               '<DataArray type="Float64" NumberOfComponents="3" format="ascii">0 0 0 1 0 0 0 1 0 0 0 1</DataArray></Points>{2}</Piece></{0}></VTKFile>\n')
        cells = ('<Cells><DataArray type="Int32" Name="connectivity" format="ascii">0 1 2 3</DataArray><DataArray type="Int32" Name="offsets" '
                 'format="ascii">4</DataArray><DataArray type="UInt8" Name="types" format="ascii">{}</DataArray></Cells>')
        with_faces = [self.put("polygons.vtk", head.format("POLYDATA") + "POLYGONS " + facets),
                      self.put("strips.vtk", head.format("POLYDATA") + "TRIANGLE_STRIPS 1 5\n4 0 1 2 3\n"),
                      self.put("cells.vtk", head.format("UNSTRUCTURED_GRID") + tetra),
                      self.put("polys.vtp", xml.format("PolyData", 'NumberOfPolys="1"', "<Polys></Polys>")),
                      self.put("cells.vtu", xml.format("UnstructuredGrid", 'NumberOfCells="1"', cells.format(10)))]
        without = [self.put("lines.vtk", head.format("POLYDATA") + "VERTICES 1 2\n1 0\nLINES 1 3\n2 0 1\nPOLYGONS 0 0\n"),
                   self.put("dots.vtk", head.format("UNSTRUCTURED_GRID") + dots),
                   self.put("points.vtp", xml.format("PolyData", 'NumberOfPolys="0"', "")),
                   self.put("line.vtu", xml.format("UnstructuredGrid", 'NumberOfCells="1"', cells.format(4)))]
        for path in with_faces:
            self.assert_fails(3, "shape", path, says=(path.name, "a VTK file with faces", "STL, OBJ, PLY or OFF", "--kind points"))
            self.assertEqual(clast("shape", path, "--hull").code, 0)
        for result in (clast("shape", *with_faces, "--kind", "points", "--json"), clast("shape", *without, "--json")):
            self.assertEqual((result.code, result.err), (0, ""))
            self.assertEqual({(grain["kind"], round(6.0 * grain["volume"], 12)) for grain in result.json["grains"]}, {("points", 1.0)})

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


class Units(Case):
    def setUp(self):
        super().setUp()
        for name, text in (("ratios", "flatness,elongation\n0.5,0.8\n"), ("mm", "L_mm,I_mm,S_mm\n30,20,10\n"),
                           ("um", "L_um,I_um,S_um\n30000,20000,10000\n"), ("clump", "x_mm,y_mm,z_mm,r_mm\n0,0,0,1\n")):
            (self.folder / f"{name}.csv").write_text(text)
        (self.folder / "box.off").write_text(BOX)

    def shape(self, text, *options):
        (self.folder / "t.csv").write_text(text)
        result = clast("shape", self.folder / "t.csv", *options, "--json")
        self.assertEqual(result.code, 0, result.err)
        return result.json["unit"], result.json["grains"][0]

    def test_the_first_file_does_not_decide_on_the_unit(self):
        """Ratios first: 30 and 30000 in one column, a mean size of 7900 and a deviation of 11000."""
        for order in (("ratios", "mm", "um"), ("mm", "um", "ratios"), ("um", "ratios", "mm")):
            found = clast("shape", *[self.folder / f"{name}.csv" for name in order], "--json").json
            lengths = {pathlib.Path(g["file"]).name: g["L"] for g in found["grains"]}
            self.assertEqual(found["unit"], "m")
            self.assertIsNone(lengths["ratios.csv:1"])
            self.assertAlmostEqual(lengths["mm.csv:1"], 0.03, 15)
            self.assertAlmostEqual(lengths["um.csv:1"], 0.03, 15)

    def test_known_units_stand_beside_no_unknown_one(self):
        mm, um, clump, box = (self.folder / name for name in ("mm.csv", "um.csv", "clump.csv", "box.off"))
        for files in ((mm, um, box), (box, um, mm), (um, box, mm), (clump, box), (box, clump)):
            self.assert_fails(2, "shape", *files, says=("box.off says none", "--unit"))
            found = clast("shape", *files, "--unit", "cm", "--json").json
            self.assertEqual(found["unit"], "m")
            volume, = (g["volume"] for g in found["grains"] if g["kind"] == "surface")
            self.assertAlmostEqual(volume * 1e6, 36.0, 12)
        self.assertEqual(clast("shape", mm, box, "--json").json["unit"], "model")

    def test_a_unit_against_that_of_all_files_is_refused(self):
        """It was ignored."""
        mm, um = self.folder / "mm.csv", self.folder / "um.csv"
        for files in ((mm,), (mm, self.folder / "ratios.csv"), (mm, um)):
            self.assert_fails(2, "shape", *files, "--unit", "cm", says=("csv:1 says its unit of length", "--unit another, 0.01 m"))
        self.assertEqual(clast("shape", mm, "--unit", "mm").code, 0)
        clump = self.folder / "clump.csv"  # it was ignored beside clumps to the last
        for files in ((clump,), (clump, mm)):
            self.assert_fails(2, "shape", *files, "--unit", "cm", says=("says its unit of length", "--unit another, 0.01 m"))
            self.assertEqual(clast("shape", *files, "--unit", "mm").code, 0)
        several = self.shape_file("x_mm,y_um,z_mm,r_mm\n0,0,0,1\n")
        self.assert_fails(2, "shape", several, "--unit", "mm", says=("says a unit of length for each column",))

    def test_each_column_counts_by_its_own_unit(self):
        """30 mm, 2 cm and 1 cm were a blade of I/L 0.067."""
        unit, grain = self.shape("L_mm,I_cm,S_um\n30,2,10000\n")
        self.assertEqual((unit, grain["zingg"]), ("m", "disc"))
        for key, value in (("L", 0.03), ("I", 0.02), ("S", 0.01), ("elongation", 2 / 3), ("flatness", 0.5)):
            self.assertAlmostEqual(grain[key], value, 12)
        self.assert_fails(3, "shape", self.shape_file("L_mm,I_mm,S\n30,20,10\n"), says=("2 of the 3 columns of L, I and S say their unit",))
        self.assert_fails(3, "shape", self.shape_file("x_mm,y,z\n0,0,0\n1,0,0\n0,1,0\n0,0,1\n"), says=("1 of the 3 columns x, y, z say",))

    def shape_file(self, text):
        (self.folder / "bad.csv").write_text(text)
        return self.folder / "bad.csv"

    def test_points_have_units(self):
        """x_mm was no point, and with --kind points no millimetre."""
        corners = [(0, 0, 0), (8, 0, 0), (0, 7, 0), (0, 0, 6)]
        for names, scale in (("x_mm,y_mm,z_mm", (1, 1, 1)), ("x_mm,y_cm,z_um", (1, 0.1, 1000)), ("X (mm),Y (mm),Z (mm)", (1, 1, 1))):
            text = "\n".join([names, *(",".join(str(x * s) for x, s in zip(corner, scale)) for corner in corners)]) + "\n"
            for options in ((), ("--kind", "points")):
                unit, grain = self.shape(text, *options)
                self.assertEqual((unit, grain["kind"]), ("m", "points"), names)
                self.assertAlmostEqual(grain["volume"] * 1e9, 56.0, 9)
        cubes = "\n".join(["x_mm,y_mm,z_mm", *(f"{x},{y},{z}" for x in range(9) for y in range(8) for z in range(7))]) + "\n"
        self.assertAlmostEqual(self.shape(cubes, "--spacing", "1")[1]["volume"] / (9 * 8 * 7 * 1e-9), 1.0, delta=0.1)  # in the file's unit

    def test_places_of_grains_that_have_a_form_are_no_points(self):
        unit, grain = self.shape("x_mm,y_mm,z_mm,L_mm,I_mm,S_mm\n1,2,3,30,20,10\n")
        self.assertEqual((unit, grain["kind"]), ("m", "table"))
        self.assertAlmostEqual(grain["L"], 0.03, 15)

    def test_rows_with_a_size_too_are_grains_and_no_spheres(self):
        """They were one clump of spheres of the diameters, without a word."""
        table = self.folder / "rows.csv"
        for columns, form, options in (("diameter_mm,L_mm,I_mm,S_mm", ".5,.4,.3", ()), ("r,L,I,S", "3,2,1", ()), ("D_mm,flatness,elongation", ".8,.7", ()),
                                       ("d,a,b,c", "3,2,1", ("--columns", "a,b,c"))):
            table.write_text(f"x,y,z,{columns}\n1,2,3,.4,{form}\n5,6,7,.6,{form}\n")
            result = clast("shape", table, *options, "--json")
            self.assertEqual((result.code, [grain["kind"] for grain in result.json["grains"]]), (0, ["table", "table"]), (columns, result.err))
        table.write_text("x_mm,y_mm,z_mm,d_mm\n1,2,3,4\n5,6,7,8\n")
        self.assertEqual([grain["kind"] for grain in clast("shape", table, "--json").json["grains"]], ["clump"])

    def test_spheres_in_units_that_are_not_read_are_refused(self):
        """Diameters in feet were lengths of the model, or behind "_" no diameters: the hull of the centres was measured."""
        table = self.folder / "clump.csv"
        for names in ("x_phi,y_phi,z_phi,d_phi", "x (ft),y (ft),z (ft),r (ft)", "x_mm,y_mm,z_mm,d_ft", "x_ft,y_ft,z_ft,radius_ft"):
            table.write_text(f"{names}\n0,0,0,1\n5,0,0,2\n")
            for command in (("shape", table), ("pack", "--shapes", table, "--curve", "6 mm", "--max-steps", "1", "-q")):
                self.assert_fails(3, *command, says=("column '", "is in no unit of length that is read here", "convert or rename it"))

    def test_diameters_of_spheres_in_phi(self):
        """"d (phi)" was refused, and of d_phi the hull of the centres was measured: a 31st of the volume."""
        rows = ["0,0,0,{}", "1,0,0,{}", "0,1,0,{}", "0,0,1,{}"]

        def volume(names, size):
            unit, grain = self.shape("\n".join([names, *rows]).format(*[size] * 4) + "\n")
            self.assertEqual((unit, grain["kind"]), ("m", "clump"), names)
            return grain["volume"]

        wanted = volume("x_mm,y_mm,z_mm,d_mm", 2)
        for names in ("x_mm,y_mm,z_mm,d_phi", "x_mm,y_mm,z_mm,diameter_phi", "x_mm,y_mm,z_mm,d (phi)", "x_mm,y_mm,z_mm,d_phi,r_ft", "x_mm,y_mm,z_mm,D [phi]"):
            self.assertAlmostEqual(volume(names, "-1,9" if "ft" in names else -1) / wanted, 1.0, 12, names)
        self.assertAlmostEqual(volume("x_mm,y_mm,z_mm,r_phi", 0) / wanted, 1.0, 12)
        self.assertAlmostEqual(volume("x_in,y_in,z_in,d_in", 2) / wanted, 25.4**3, 8)
        self.assert_fails(3, "shape", self.shape_file("x,y,z,d_phi\n0,0,0,1\n"), says=("1 of the 4 columns x, y, z, radius say",))
        self.assertEqual(self.shape("x_mm,y_mm,z_mm,r_g\n0,0,0,1\n1,0,0,1\n0,1,0,1\n0,0,1,1\n")[1]["kind"], "points")  # a radius of gyration

    def test_sizes_and_lengths_in_phi(self):
        """They were lengths, with the order of the grains reversed, and those from 1 mm on no sizes."""
        for name in ("D (phi)", "D_phi", "sieve_size [phi]"):
            (self.folder / "phi.csv").write_text(f"flatness,elongation,{name}\n0.5,0.6,1\n0.6,0.7,-2\n0.6,0.7,0\n")
            made = clast("shape", self.folder / "phi.csv", "--json")
            self.assertEqual(([grain["D"] for grain in made.json["grains"]], made.err), ([0.0005, 0.004, 0.001], ""), name)
        phi, mm = self.shape("L (phi),I_phi,S (phi)\n1,2,3\n"), self.shape("L_mm,I_mm,S_mm\n0.5,0.25,0.125\n")
        self.assertEqual([phi[0], *(phi[1][key] for key in "LISD")], [mm[0], *(mm[1][key] for key in "LISD")])
        mixed = self.shape("L_phi,I_um,S_phi\n1,250,3\n")
        self.assertEqual(mixed[0], "m")
        for key in "LIS":
            self.assertAlmostEqual(mixed[1][key] / mm[1][key], 1.0, 12)
        table = self.shape_file("flatness,elongation,D_phi\n0.5,0.6,1\n0.6,0.7,1\n0.6,0.6,1\n")
        columns = clast("shape", table, "--statistics", self.folder / "forms", "--resamples", 10, "--json").json["statistics"]["columns"]
        self.assertEqual({column["name"]: column["mean"]["value"] for column in columns}["size_m"], 0.0005)

    def test_lengths_in_units_that_are_not_read_are_refused(self):
        """They were lengths in the files' unit, or the column was passed over."""
        corners = "\n0,0,0\n1,0,0\n0,1,0\n0,0,1\n"
        for text in ("L (ft),I (ft),S (ft)\n3,2,1\n", "L_ft,I_ft,S_ft\n3,2,1\n", "flatness,elongation,D_ft\n.5,.6,1\n", "flatness,elongation,D (g)\n.5,.6,1\n",
                     f"x (ft),y (ft),z (ft){corners}", f"x_ft,y_ft,z_ft{corners}", f"x_phi,y_phi,z_phi{corners}"):
            self.assert_fails(3, "shape", self.shape_file(text), "--unit", "mm", says=("column '", "is in no unit of length that is read here", "convert or rename it"))
        self.assert_fails(3, "shape", self.shape_file("L_g,I_g,S_g\n3,2,1\n"), says=("has neither the columns flatness and elongation nor L, I and S",))
        for names in ("D_ft,D_mm", "D (ft),D (mm)"):  # the one that is read counts
            self.assertAlmostEqual(self.shape(f"flatness,elongation,{names}\n0.5,0.8,1,12\n")[1]["D"], 0.012, 15)
        self.assertEqual(self.shape(f"x_ft,x_mm,y_mm,z_mm{corners.replace(chr(10), chr(10) + '9,')[:-2]}")[0], "m")

    def test_rows_of_several_units_are_in_metres(self):
        """10 mm were 10000 of "the files' units", beside 10 of a table without any; the mean was of both."""
        mixed, none, one = (self.folder / name for name in ("mixed.csv", "none.csv", "one.csv"))
        mixed.write_text("L_mm,I_mm,S_um\n10,8,5000\n20,10,5000\n")
        none.write_text("L,I,S\n10,8,5\n20,10,5\n")
        one.write_text("L_mm,I_mm,S_mm\n10,8,5\n")
        self.assert_fails(2, "shape", none, mixed, says=("mixed.csv:2 says a unit of length that others do not share", "none.csv:2 says none", "--unit"))
        both = clast("shape", none, mixed, "--unit", "mm", "--json")
        self.assertEqual([round(grain["L"], 12) for grain in both.json["grains"]], [0.01, 0.02, 0.01, 0.02], both.err)
        self.assert_fails(2, "shape", mixed, "--unit", "mm",  # it said 1e-06 m, which is that of S alone; then nothing
                          says=("mixed.csv:2 says a unit of length for each column", "--unit another, 0.001 m"))
        for files, n_note in (((none, one), 1), ((none, none), 0)):
            said = clast("shape", *files, "--statistics", self.folder / f"forms{n_note}", "--resamples", 10).err
            self.assertEqual(said.count("one.csv:1 says its unit of length and"), n_note, said)

    def test_a_bad_size_takes_no_form_away(self):
        """Lengths of D = -5 were -0.0089, and the statistics left four known forms out."""
        table = self.folder / "d.csv"
        table.write_text("flatness,elongation,D_mm\n0.5,0.8,12\n0.6,0.7,\n0.55,0.7,-5\n0.7,0.6,0\n0.8,0.9,inf\n")
        result = clast("shape", table, "--statistics", self.folder / "forms", "--resamples", 10, "--json")
        said = "4 of 5 sizes left out: missing, infinite or not positive (first: row 2)"
        self.assertIn(said, result.err)
        self.assertIn(said, result.json["left_out"][0]["text"])
        grains = result.json["grains"]
        self.assertEqual([round(g["flatness"], 12) for g in grains], [0.5, 0.6, 0.55, 0.7, 0.8])
        self.assertEqual([[g[key] for key in "LISD"] for g in grains[1:]], [[None] * 4] * 4)
        self.assertAlmostEqual(grains[0]["D"], 0.012, 15)
        self.assertEqual(result.json["statistics"]["n"], 5)

    def test_a_diameter_is_no_sieve_size(self):
        """\"Diameter (mm)\" was one, for it begins with a D."""
        for name in ("Diameter (mm)", "diameter_mm", "Equivalent Diameter (mm)"):
            self.assertIsNone(self.shape(f"flatness,elongation,{name}\n0.5,0.8,12\n")[1]["L"])
        for name in ("D (mm)", "d_mm", "Sieve Size (mm)"):
            self.assertAlmostEqual(self.shape(f"flatness,elongation,{name}\n0.5,0.8,12\n")[1]["D"], 0.012, 15)


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
        (self.folder / "out").mkdir()
        for file, option in ((ROOT / "data/standin63/grain00.ply", ("--columns", "L,I,S")), (ROOT / "data/standin63/grain00.ply", ("--voxel-edge", 2)),
                             (table, ("--hull",)), (table, ("--axes", "feret")), (table, ("--surfaces", self.folder / "out"))):
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
