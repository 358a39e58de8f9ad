"""CLI: clast mesh form puts a form on a grain exactly and says what it measured."""
import unittest

from clitest import ROOT, Case, clast

STONE = ROOT / "data/scarlet/stl/particle.stl"


class MeshForm(Case):
    def test_the_wanted_form_is_measured(self):
        out = self.folder / "grain.ply"
        result = clast("mesh", "form", STONE, "--hull", "300", "--flatness", "0.5", "--elongation", "0.7",
                       "--size", "2", "-o", out, "--json")
        self.assertEqual(result.code, 0, result.err)
        after = result.json["after"]
        self.assertAlmostEqual(after["flatness"], 0.5, places=13)
        self.assertAlmostEqual(after["elongation"], 0.7, places=13)
        self.assertAlmostEqual(after["D"], 2, places=12)
        self.assertLessEqual(result.json["n_triangle"], 300)
        check = clast("mesh", "check", out, "--json")
        self.assertEqual(check.code, 0)
        self.assertAlmostEqual(check.json["volume"] / check.json["hull_volume"], 1, places=10)

    def test_own_form_is_kept_where_none_is_asked_for(self):
        out = self.folder / "grain.ply"
        got = clast("mesh", "form", STONE, "-o", out, "--json").json
        for key in "LIS":
            self.assertAlmostEqual(got["after"][key] / got["before"][key], 1, places=12)
        self.assertAlmostEqual(got["volume"] / got["volume_before"], 1, places=12)
        # stored in its frame: a second call changes nothing but rounding
        again = clast("mesh", "form", out, "-o", self.folder / "again.ply", "--json").json
        self.assertAlmostEqual(again["after"]["L"] / got["after"]["L"], 1, places=12)

    def test_unit_form_has_no_form(self):
        got = clast("mesh", "form", STONE, "--unit-form", "-o", self.folder / "unit.ply", "--json").json
        for key in "LIS":
            self.assertAlmostEqual(got["after"][key], 1, places=12)

    def test_a_hull_is_not_taken_for_the_surface(self):
        """`before` and the volume were the hull's, and that it nearly doubles the volume of this sponge was not told."""
        menger, out = ROOT / "data/scarlet/stl/Menger2.stl", self.folder / "m.ply"
        got = clast("mesh", "form", menger, "--hull", 100, "-o", out, "--json").json
        alone = clast("mesh", "form", menger, "-o", out, "--json").json
        self.assertEqual(got["before"], alone["before"])
        self.assertAlmostEqual(got["volume_before"], 0.5487, 4)
        self.assertAlmostEqual(got["volume_hull"], 1, 4)
        self.assertAlmostEqual(got["added_volume"], got["volume_hull"] - got["volume_before"], 12)
        self.assertAlmostEqual(got["hull"]["D"] / got["after"]["D"], 1, 12)
        result = clast("mesh", "form", menger, "--hull", 100, "-o", out)
        for text in ("before  L 1.41", "hull    L 1.29", "volume  1.0000014 of the hull", "surface volume 0.5487", "the hull adds 0.4513"):
            self.assertIn(text, result.out)
        opened = self.folder / "open.off"
        opened.write_text("OFF\n4 3 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n")
        result = clast("mesh", "form", opened, "--hull", 100, "-o", out)
        self.assertIn("what it adds is not known: the input is not closed", result.out)
        self.assertNotIn("before", result.out)

    def test_a_size_is_in_the_unit_of_the_file(self):
        """A file in mm was said to be in model units, refused 7mm and took 50% for 0.5."""
        mm, out = self.folder / "mm.ply", self.folder / "grain.ply"
        self.assertEqual(clast("mesh", "convert", STONE, "--unit", "mm", "-o", mm).code, 0)
        sizes = [clast("mesh", "form", mm, "--size", size, "-o", out, "--json").json for size in ("7", "7mm", "7000um")]
        for got in sizes:
            self.assertEqual(got["unit"], "mm")
            self.assertAlmostEqual(got["after"]["D"], 7, 10)
        self.assertIn("lengths in mm", clast("mesh", "form", mm, "-o", out).out)
        for command in ("mesh hull", "mesh simplify"):
            self.assertIn("lengths in mm", clast(*command.split(), mm, "-o", out).out)
        self.assert_fails(2, "mesh", "form", mm, "--size", "50%", "-q", "-o", out, says=["size", "'%'"])
        self.assert_fails(2, "mesh", "form", STONE, "--size", "50%", "-q", "-o", out, says=["size", "bare number"])
        self.assert_fails(2, "mesh", "form", STONE, "--size", "7mm", "-q", "-o", out, says=["size", "no unit"])
        self.assert_fails(2, "mesh", "form", STONE, "--size", "-7", "-q", "-o", out, says=["size", "outside [0, 1e12]"])
        # "volume is 0: the surface is inside out or open", of a sound one
        self.assert_fails(2, "mesh", "form", STONE, "--size", "1e-300", "-q", "-o", out, says=["moments", "unit"])

    def test_refusals_are_one_line(self):
        out = self.folder / "g.ply"
        self.assert_fails(2, "mesh", "form", STONE, "--unit-form", "--size", "2", "-o", out, says=["unit_form"])
        self.assert_fails(2, "mesh", "form", STONE, "--hull", "3", "-o", out, says=["4 faces"])
        self.assert_fails(2, "mesh", "form", STONE, "--flatness", "1.5", "-o", out, says=["flatness"])
        for thin in ("1e-9", "1e-7"):  # blamed the file: "vertex 1 is -0.2, -0.3, inf", or gave another flatness by 0.4 %
            self.assert_fails(2, "mesh", "form", STONE, "--flatness", thin, "-q", "-o", out, says=["of L; below 1e-06"])
        self.assertFalse(out.exists())


if __name__ == "__main__":
    unittest.main()
