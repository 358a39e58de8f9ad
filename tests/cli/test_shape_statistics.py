"""CLI: clast shape --statistics FOLDER describes a set of grains."""
import csv
import pathlib
import unittest

from clitest import Case, clast

STANDIN = pathlib.Path("data/standin63/grains.csv")


class Statistics(Case):
    def test_stand_in(self):
        run = self.folder / "run"
        out = clast("shape", STANDIN, "--statistics", run, "--resamples", 200, "--json")
        self.assertEqual(out.code, 0, out.err)
        s = out.json["statistics"]
        column = {c["name"]: c for c in s["columns"]}
        self.assertAlmostEqual(column["flatness"]["mean"]["value"], 0.647, places=6)
        self.assertAlmostEqual(column["elongation"]["deviation"]["value"], 0.139, places=6)
        self.assertLess(column["flatness"]["mean"]["low"], 0.647)
        self.assertGreater(column["flatness"]["shapiro_p"], 0.05)  # made of a normal law's quantiles
        self.assertAlmostEqual(s["correlation"]["r"][0][1], -0.0894, delta=5e-5)
        self.assertEqual(s["zingg"], {"sphere": 20, "disc": 15, "rod": 10, "blade": 18})
        self.assertEqual(len(s["pca"]), 13)
        for name in ("zingg.svg", "correlation.svg", "pca.svg", "histogram_flatness.svg", "statistics.csv"):
            self.assertTrue((run / name).stat().st_size > 100, name)
        with open(run / "statistics.csv", newline="") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual(float(rows[0]["mean"]), column["flatness"]["mean"]["value"])

    def test_words(self):
        out = clast("shape", STANDIN, "--statistics", self.folder / "run", "--resamples", 50)
        self.assertIn("20 sphere, 15 disc, 10 rod, 18 blade", out.out)
        self.assertIn("97.3 % in two", out.out)

    def test_columns_do_not_run_together(self):
        """-1.235e-05 takes ten characters, all of a column."""
        path = self.folder / "sheets.csv"
        path.write_text("L (m),I (m),S (m)\n" + "".join(f"1,1,{1e-10 * (1 + 0.1 * k)}\n" for k in range(5)))
        words = clast("shape", path, "--statistics", self.folder / "run", "--resamples", 50).out
        rows = [line.split() for line in words.splitlines() if line.startswith("oblate_prolate_index ")]
        self.assertEqual([len(r) for r in rows], [8], words)

    def test_one_grain_has_no_spread_and_no_nan(self):
        path = self.folder / "one.csv"
        path.write_text("flatness,elongation\n0.5,0.6\n")
        out = clast("shape", path, "--statistics", self.folder / "run", "--json")
        self.assertEqual(out.code, 0, out.err)
        self.assertNotIn("NaN", out.out)
        self.assertIsNone(out.json["statistics"]["columns"][0]["deviation"]["value"])
        words = clast("shape", path, "--statistics", self.folder / "run")
        self.assertNotIn("nan", words.out.split("1 grain:")[-1])

    def test_same_bytes_for_any_thread_count(self):
        texts = {clast("shape", STANDIN, "--statistics", self.folder / f"run{j}", "--json", "-j", j).out for j in (1, 3)}
        self.assertEqual(len(texts), 1)
        files = {(self.folder / f"run{j}/statistics.csv").read_bytes() for j in (1, 3)}
        self.assertEqual(len(files), 1)

    def test_folder_that_cannot_be(self):
        (self.folder / "no").write_text("a file")
        self.assert_fails(4, "shape", STANDIN, "--statistics", self.folder / "no/such", says=["no/such"])


if __name__ == "__main__":
    unittest.main()
