"""CLI: clast mesh simplify keeps the volume, clast mesh hull tells what it adds."""
import unittest

from clitest import ROOT, Case, clast

DATA = ROOT / "data"


class MeshSimplify(Case):
    def test_volume_is_kept_to_1e_9_through_a_file(self):
        source = DATA / "scarlet/stl/27sk21_shape_coarse.stl"
        before = clast("mesh", "check", source, "--json").json
        for name, tolerance in [("out.ply", 1e-12), ("out.stl", 1e-9)]:
            out = self.folder / name
            result = clast("mesh", "simplify", source, "--faces", "100", "-o", out, "--json")
            self.assertEqual(result.code, 0, result.err)
            self.assertEqual(result.json["n_triangle"], 100)
            self.assertGreater(result.json["hausdorff"], 0)
            after = clast("mesh", "check", out, "--json")
            self.assertEqual(after.code, 0)
            self.assertEqual(after.json["n_triangle"], 100)
            self.assertLess(abs(after.json["volume"] / before["volume"] - 1), tolerance)

    def test_unreachable_number_is_code_5_and_told(self):
        out = self.folder / "out.ply"
        result = clast("mesh", "simplify", DATA / "scarlet/stl/L_shaped.stl", "--faces", "10", "-o", out)
        self.assertEqual(result.code, 5)
        self.assertIn("no further edge can go", result.err)
        self.assertTrue(out.exists())

    def test_open_surface_is_sent_to_repair(self):
        self.assert_fails(3, "mesh", "simplify", DATA / "broken-meshes/draco/test_nm.obj", "-o", self.folder / "o.ply",
                          says=["30 open edges", "clast mesh repair"])


class MeshHull(Case):
    def test_the_volume_that_a_hull_adds_is_told_of_closed_surfaces_only(self):
        """test_nm.obj has 30 open edges: its four sums of volume differ by 30 %."""
        out = self.folder / "hull.ply"
        result = clast("mesh", "hull", DATA / "broken-meshes/draco/test_nm.obj", "-o", out)
        self.assertEqual(result.code, 0, result.err)
        self.assertIn("not known: the input is not closed", result.out)
        found = clast("mesh", "hull", DATA / "broken-meshes/draco/test_nm.obj", "-o", out, "--json").json
        self.assertIsNone(found["volume"])
        self.assertIsNone(found["added_volume"])
        self.assertGreater(found["hull_volume"], 0.0)

    def test_surfaces_without_a_known_unit_say_so(self):
        scan = DATA / "scarlet/stl/27sk21_shape_fine.stl"
        for command in (("hull", scan), ("simplify", scan, "--faces", 300), ("form", scan), ("repair", scan),
                        ("convert", scan)):
            self.assertIn("model units", clast("mesh", *command, "-o", self.folder / "o.ply").out, command)
        self.assertIn("model units", clast("mesh", "check", scan).out)
        for command in ("hull", "simplify", "form", "repair"):
            self.assert_fails(2, "mesh", command, scan, "-o", self.folder / "o.3mf", says=["3MF is in mm"])

    def test_hull_of_the_scan(self):
        out = self.folder / "hull.ply"
        result = clast("mesh", "hull", DATA / "scarlet/stl/particle.stl", "-o", out, "--json")
        self.assertEqual(result.code, 0, result.err)
        self.assertAlmostEqual(1 - result.json["volume"] / result.json["hull_volume"], 0.3527, places=4)
        check = clast("mesh", "check", out, "--json")
        self.assertEqual(check.code, 0)
        self.assertAlmostEqual(check.json["volume"] / check.json["hull_volume"], 1, places=12)

    def test_points_will_do_and_flat_sets_are_refused(self):
        flat = self.folder / "flat.off"
        flat.write_text("OFF\n4 1 0\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n3 0 1 2\n")
        self.assert_fails(3, "mesh", "hull", flat, "-o", self.folder / "h.ply", says=["lie in one plane"])


if __name__ == "__main__":
    unittest.main()
