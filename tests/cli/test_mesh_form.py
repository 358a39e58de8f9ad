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

    def test_refusals_are_one_line(self):
        out = self.folder / "g.ply"
        self.assert_fails(2, "mesh", "form", STONE, "--unit-form", "--size", "2", "-o", out, says=["unit_form"])
        self.assert_fails(2, "mesh", "form", STONE, "--hull", "3", "-o", out, says=["4 faces"])
        self.assert_fails(2, "mesh", "form", STONE, "--flatness", "1.5", "-o", out, says=["flatness"])
        self.assertFalse(out.exists())


if __name__ == "__main__":
    unittest.main()
