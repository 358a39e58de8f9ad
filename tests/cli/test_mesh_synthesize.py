"""CLI: clast mesh synthesize makes grains that measure what was asked."""
import csv
import statistics
import unittest

from clitest import Case, clast


class MeshSynthesize(Case):
    def test_one_grain_has_the_form_and_roughness(self):
        out = self.folder / "grain.ply"
        result = clast("mesh", "synthesize", "--flatness", "0.5", "--elongation", "0.8", "--size", "0.011",
                       "--rough", "0.06", "--faces", "200", "-o", out, "--json")
        self.assertEqual(result.code, 0, result.err)
        grain = result.json["grains"][0]
        self.assertLess(abs(grain["angularity"] - 0.06), 1e-3)
        self.assertLessEqual(grain["n_triangle"], 200)
        form = clast("mesh", "form", out, "-o", self.folder / "again.ply", "--json").json["before"]
        self.assertAlmostEqual(form["flatness"], 0.5, places=12)
        self.assertAlmostEqual(form["elongation"], 0.8, places=12)
        self.assertAlmostEqual(form["D"] / 0.011, 1, places=12)

    def test_a_set_fills_a_folder_and_a_table(self):
        out = self.folder / "set"
        options = ["mesh", "synthesize", "--count", "6", "--flatness-deviation", "0.1", "--measure", "amplitude",
                   "--rough", "0.1", "--faces", "60", "-o", out]
        got = clast(*options, "--json").json
        with open(out / "grains.csv", newline="", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual(len(rows), 6)
        flatness = [float(row["flatness"]) for row in rows]
        self.assertEqual(len(set(flatness)), 6)
        self.assertAlmostEqual(got["mean"]["flatness"], statistics.fmean(flatness), places=14)
        self.assertAlmostEqual(got["deviation"]["flatness"], statistics.stdev(flatness), places=14)
        for row in rows:
            self.assertEqual(clast("mesh", "check", out / row["file"]).code, 0)
        first = (out / "grain0003.ply").read_bytes()
        # a second set went over the first, and left its other grains standing; a run of pack got grains among its files
        self.assert_fails(2, *options, says=["set holds a finished run", "--force"])
        fewer = ["4" if word == "6" else word for word in options]
        self.assertEqual(clast(*fewer, "--force").code, 0)
        self.assertEqual((out / "grain0003.ply").read_bytes(), first)
        self.assertEqual(sorted(path.name for path in out.iterdir()),
                         [*(f"grain000{k}.ply" for k in range(4)), "grains.csv", "manifest.json", "summary.json"])
        self.assertEqual(clast("report", out).code, 0)
        self.assertFalse("<th><code>" in (out / "report.html").read_text())
        self.assert_fails(2, "mesh", "synthesize", "--force", "-o", self.folder / "one.ply", says=["no output folder"])

    def test_a_unit_is_handed_on(self):
        out = self.folder / "g.ply"
        made = ("mesh", "synthesize", "--measure", "amplitude", "--rough", "0.1", "--faces", "60", "-o", out)
        result = clast(*made, "--size", "7mm", "--unit", "mm")
        self.assertEqual(result.code, 0, result.err)
        self.assertIn("1 grain; lengths in mm", result.out)
        self.assertRegex(result.out, r"\n  volume +[0-9.]+ mm\^3\n")  # said no unit
        self.assertIn(b"unit mm", out.read_bytes()[:200])
        with_unit = clast("mesh", "form", out, "-o", self.folder / "f.ply", "--json").json
        self.assertEqual(with_unit["unit"], "mm")
        self.assertAlmostEqual(with_unit["before"]["D"], 7, 10)
        self.assertIn("model units", clast(*made, "--size", "7").out)
        self.assert_fails(2, *made, "--size", "7mm", says=["size", "no unit"])
        self.assert_fails(2, *made, "--size", "50%", says=["size"])
        self.assert_fails(2, *made, "--size", "0", says=["size"])
        self.assert_fails(2, *made, "--unit", "kg", says=["unit"])

    def test_refusals_are_one_line(self):
        out = self.folder / "g.ply"
        self.assert_fails(2, "mesh", "synthesize", "--count", 2, "-o", self.folder / "z.stl", says=["z.stl", "folder"])
        for options, says in ((("--tolerance", 0.1), "--tolerance does nothing with --measure amplitude"),
                              (("--rough", 0, "--decay", 1), "--decay does nothing with --rough 0")):
            self.assert_fails(2, "mesh", "synthesize", "--measure", "amplitude", *options, "-o", out, says=(says,))
        self.assert_fails(2, "mesh", "synthesize", says=["-o OUT"])
        self.assert_fails(5, "mesh", "synthesize", "--measure", "normal_roundness", "--rough", "0.99", "-o", out,
                          says=["smoother than its ellipsoid"])
        self.assert_fails(2, "mesh", "synthesize", "--flatness", "0.05", "-o", out, says=["outside 0.1 to 1"])
        self.assertFalse(out.exists())
        out = self.folder / "plain"
        out.write_text("")
        self.assert_fails(4, "mesh", "synthesize", "--count", "2", "-o", out, says=["folder"])


if __name__ == "__main__":
    unittest.main()
