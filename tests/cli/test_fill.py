"""clast fill: what its help says."""
import csv
import math
import subprocess
import unittest

from clitest import CLAST, ROOT, Case, clast, shared

CUBE = """OFF
8 12 0
0 0 0
1 0 0
0 1 0
1 1 0
0 0 1
1 0 1
0 1 1
1 1 1
3 0 2 1
3 1 2 3
3 4 5 6
3 5 7 6
3 0 1 4
3 1 5 4
3 2 6 3
3 3 6 7
3 0 4 2
3 2 4 6
3 1 3 5
3 3 7 5
"""


class Fill(Case):
    def setUp(self):
        super().setUp()
        self.cube = self.folder / "cube.off"
        self.cube.write_text(CUBE)

    def test_json_has_the_promised_keys(self):
        result = clast("fill", self.cube, "--spheres", 9, "--tolerance", 1e-5, "--json")
        self.assertEqual(result.code, 0, result.err)
        for key in ("n_sphere", "filled_fraction", "max_protrusion", "volume_error", "inertia_error", "wall_s"):
            self.assertIn(key, result.json)
        self.assertEqual(result.json["n_sphere"], 9)
        self.assertLessEqual(result.json["max_protrusion"], 1e-12)
        self.assertAlmostEqual(result.json["radius_max"], 0.5, 12)
        r = 0.5 * (math.sqrt(3) - 1) / (math.sqrt(3) + 1)
        self.assertAlmostEqual(result.json["filled_fraction"], 4 / 3 * math.pi * (0.125 + 8 * r**3), 3)

    def test_csv_holds_the_spheres(self):
        out = self.folder / "spheres.csv"
        self.assertEqual(clast("fill", self.cube, "--spheres", 5, "-o", out, "-q").code, 0)
        rows = list(csv.DictReader(out.read_text().splitlines()))
        self.assertEqual(list(rows[0]), ["x", "y", "z", "radius"])
        self.assertEqual(len(rows), 5)
        self.assertEqual([float(v) for v in rows[0].values()], [0.5] * 4)

    def test_state_file_keeps_sets_by_name(self):
        out = self.folder / "sets.h5"
        for name, n in (("few", 3), ("many", 7), ("few", 4)):
            result = clast("fill", self.cube, "--spheres", n, "--name", name, "-o", out)
            self.assertEqual(result.code, 0, result.err)
        first = out.read_bytes()
        self.assertEqual(clast("fill", self.cube, "--spheres", 4, "--name", "few", "-o", out).code, 0)
        self.assertEqual(out.read_bytes(), first)  # replaced by the same, not added

    def test_threads_write_the_same_bytes(self):
        texts = set()
        for threads in (1, 2, 4):
            out = self.folder / f"{threads}.csv"
            self.assertEqual(clast("fill", self.cube, "--overlap", "--spheres", 12, "-j", threads, "-o", out).code, 0)
            texts.add(out.read_bytes())
        self.assertEqual(len(texts), 1)

    def test_seed_changes_random_fillings_only(self):
        def spheres(*options):
            out = self.folder / "s.csv"
            result = clast("fill", self.cube, "--spheres", 6, "-o", out, *options)
            self.assertEqual(result.code, 0, result.err)
            return out.read_text()
        self.assert_fails(2, "fill", self.cube, "--seed", 2, says=["--seed does nothing with --strategy largest"])
        random = ("--strategy", "random")
        self.assertNotEqual(spheres("--seed", 1, *random), spheres("--seed", 2, *random))
        self.assertEqual(spheres("--seed", 2, *random), spheres("--seed", 2, *random))

    def test_history_has_a_row_for_each_sphere(self):
        out = self.folder / "history.csv"
        self.assertEqual(clast("fill", self.cube, "--spheres", 9, "--history", out).code, 0)
        rows = list(csv.DictReader(out.read_text().splitlines()))
        self.assertEqual(len(rows), 9)
        self.assertAlmostEqual(float(rows[0]["filled_fraction"]), math.pi / 6, 12)

    def test_filled_is_the_share_of_the_solid(self):
        """`published` puts a ball through the corners first, 2.72 times the cube: filled was 2.72, and --filled 0.9 met by what lies beside."""
        published = ("fill", self.cube, "--strategy", "published", "--spheres", 1)
        got = clast(*published, "--json").json
        ball = math.pi * math.sqrt(3) / 2
        self.assertAlmostEqual(got["sphere_volume"], ball, 12)
        self.assertAlmostEqual(got["filled_fraction"], 1, delta=2e-3)
        self.assertAlmostEqual(got["filled_fraction"] + got["outside_fraction"], ball, 12)
        self.assertAlmostEqual(got["volume_error"], ball - 1, 12)
        self.assertIn("1.72 of the volume, beside the solid", clast(*published).out)
        self.assertEqual(clast("fill", self.cube, "--spheres", 3, "--json").json["outside_fraction"], 0)

    def test_a_stop_at_filled_waits_for_the_solid(self):
        """A grain of 300 faces: 399 spheres were said to fill 0.9, and hold 0.73 of it."""
        grain = self.folder / "grain.ply"
        self.assertEqual(clast("mesh", "synthesize", "--measure", "amplitude", "--rough", 0.1, "-o", grain).code, 0)
        options = ("fill", grain, "--strategy", "published", "--filled", 0.7, "--history", self.folder / "h.csv", "--json")
        got = clast(*options, "--spheres", 3000).json
        self.assertGreater(got["outside_fraction"], 0.1)
        self.assertGreaterEqual(got["filled_fraction"], 0.7)
        rows = list(csv.DictReader((self.folder / "h.csv").read_text().splitlines()))
        self.assertAlmostEqual(float(rows[-1]["filled_fraction"]), got["filled_fraction"], 12)
        self.assertLess(float(rows[-2]["filled_fraction"]), 0.7)
        self.assert_fails(5, *options, "--spheres", got["n_sphere"] - 1, says=["wanted 0.7"])

    def test_the_unit_of_the_surface_is_handed_on(self):
        """Spheres of a surface in mm were in model units: clast shape of them gave 1e9 times the volume."""
        surface, out = self.folder / "mm.ply", self.folder / "s.csv"
        self.assertEqual(clast("mesh", "convert", self.cube, "--unit", "mm", "-o", surface).code, 0)
        result = clast("fill", surface, "--spheres", 1, "-o", out)
        self.assertIn("lengths in mm", result.out)
        self.assertEqual(out.read_text().splitlines()[0], "x_mm,y_mm,z_mm,radius_mm")
        self.assertEqual(clast("fill", surface, "--spheres", 1, "-q", "--json").json["unit"], "mm")
        self.assertAlmostEqual(clast("shape", out, "--json").json["grains"][0]["volume"] / (math.pi / 6 * 1e-9), 1, 12)

    def test_words_without_json(self):
        result = clast("fill", self.cube, "--spheres", 1)
        self.assertIn("1 sphere, as many as asked for", result.out)
        self.assertIn("0.523599 of the volume 1", result.out)

    def test_bad_input_ends_in_one_line(self):
        missing = self.folder / "missing.stl"
        self.assert_fails(3, "fill", missing, says=["missing.stl"])
        opened = self.folder / "open.off"
        opened.write_text(CUBE.replace("8 12 0", "8 11 0").replace("3 3 7 5\n", ""))
        self.assert_fails(3, "fill", opened, says=["3 open edges", "clast mesh repair"])
        self.assertEqual(clast("fill", opened, "--allow-open", "--spheres", 2, "-q").code, 0)
        inside_out = self.folder / "inside_out.off"
        faces = [line.split() for line in CUBE.splitlines()[10:]]
        inside_out.write_text("\n".join(CUBE.splitlines()[:10] + [f"3 {a} {c} {b}" for _, a, b, c in faces]) + "\n")
        self.assert_fails(3, "fill", inside_out, says=["inside out"])

    def test_a_surface_that_cuts_itself_is_named(self):
        """Two unit cubes, the second moved by (0.5, 0.4, 0.3): volume 2 as facets add up, 1.79 as a union."""
        lines = CUBE.splitlines()
        moved = [tuple(float(v) + d for v, d in zip(line.split(), (0.5, 0.4, 0.3))) for line in lines[2:10]]
        faces = [[int(v) for v in line.split()[1:]] for line in lines[10:]]
        two = self.folder / "two.off"
        two.write_text("\n".join(["OFF", "16 24 0"] + lines[2:10] + ["%g %g %g" % v for v in moved] + lines[10:]
                                 + ["3 %d %d %d" % tuple(k + 8 for k in face) for face in faces]) + "\n")
        result = clast("fill", two, "--spheres", 3, "--json")
        self.assertEqual(result.code, 0, result.err)
        self.assertGreater(result.json["n_intersection"], 0)
        self.assertIn("cuts itself at %d pairs of triangles" % result.json["n_intersection"], result.err)
        self.assertNotIn("cuts itself", clast("fill", self.cube, "--spheres", 3).err)

    def test_impossible_bounds_end_in_code_5(self):
        self.assert_fails(5, "fill", self.cube, "--spheres", 5, "--filled", 0.9, "-q", says=["wanted 0.9"])
        self.assert_fails(5, "fill", self.cube, "--min-radius", 0.6, "-q", says=["no sphere of radius 0.6"])

    def test_wrong_options_end_in_code_2(self):
        self.assert_fails(2, "fill", self.cube, "--strategy", "biggest", says=["biggest"])
        self.assert_fails(2, "fill", self.cube, "--overlap", "--strategy", "random", says=["overlap"])
        self.assert_fails(2, "fill", self.cube, "--spheres", 2, "-q", "-o", self.folder / "s.txt", says=[".csv or .h5"])

    def test_full_disk_ends_in_code_4(self):
        self.assert_fails(4, "fill", self.cube, "--spheres", 2, "-q", "-o", self.folder / "no/such/s.csv")

    def test_published_shapes_fill_as_they_are(self):
        """ellipse and particle have seams of rounding, t_rex 46 open edges."""
        for name, filled in (("ellipse", 0.68), ("particle", 0.63), ("t_rex", 0.63)):
            path = ROOT / f"data/scarlet/stl/{name}.stl"
            path = path if path.exists() else shared(f"scarlet/stl/{name}.stl")
            if path is None:
                continue
            result = clast("fill", path, "--spheres", 100, "--json", "-q")
            self.assertEqual(result.code, 0, result.err)
            self.assertEqual(result.json["n_sphere"], 100)
            self.assertLessEqual(result.json["max_protrusion"], 1e-6)
            self.assertGreater(result.json["filled_fraction"], filled - 0.06)

    def test_four_writers_of_one_file_lose_nothing(self):
        path = self.folder / "sets.h5"
        grain = ROOT / "data/standin63/grain00.ply"
        writers = [subprocess.Popen([CLAST, "fill", grain, "--spheres", "3", "--name", f"set{k}", "-q", "-o", path],
                                    stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True) for k in range(4)]
        for one in writers:
            error = one.communicate()[1]
            self.assertEqual(one.returncode, 0, error)
        for k in range(4):
            self.assertIn(f"set{k}".encode(), path.read_bytes())
        self.assertEqual([p.name for p in self.folder.iterdir() if "lock" in p.name or ".clast" in p.name], [])


if __name__ == "__main__":
    unittest.main()
