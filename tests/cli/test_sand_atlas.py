"""The tables of 8,422 grains of the Sand Atlas (CC BY 4.0, in shared data): what their README states holds in what clast reads."""
import csv
import statistics
import sys
import unittest

from clitest import ROOT, Case, clast

FOLDER = ROOT.parent / "shared/data/shapes/sand-atlas"
# grains, median and mean equivalent diameter (micrometres), total volume (cubic micrometres): README of the data
TABLES = {
    "hamburg-0000004.csv": (8037, 421.592, 450.934, 6.4393611e11),
    "hostun-0000005.csv": (54, 341.162, 345.089, 1.235487e9),
    "caicos-0000001.csv": (75, 306.676, 311.014, 1.2450811e9),
    "couscous-0000003.csv": (81, 704.801, 708.118, 1.539222e10),
    "ottawa-0000008.csv": (175, 256.753, 254.505, 1.5658754e9),
}


@unittest.skipUnless(FOLDER.exists(), f"NOT TESTED: {FOLDER} is not here")
class SandAtlas(Case):
    def rows(self, name):
        with open(FOLDER / name, encoding="utf-8-sig", newline="") as file:
            return list(csv.DictReader(file))

    def test_forms_and_sizes_of_every_row(self):
        n = 0
        for name, (count, *_) in TABLES.items():
            out = clast("shape", FOLDER / name, "--json")
            self.assertEqual(out.code, 0, out.err)
            grains = out.json["grains"]
            self.assertEqual((len(grains), out.json["unit"], out.json["left_out"]), (count, "m", []))
            for g, row in zip(grains, self.rows(name), strict=True):
                self.assertAlmostEqual(g["flatness"], float(row["Flatness (-)"]), 9)
                self.assertAlmostEqual(g["elongation"], float(row["Elongation (-)"]), 9)
                for key, axis in zip("LIS", ("Major", "Middle", "Minor")):
                    self.assertAlmostEqual(g[key] / (1e-6 * float(row[f"{axis} Axis Length (µm)"])), 1.0, 9)
            n += count
        self.assertEqual(n, 8422)

    def test_sizes_have_the_stated_median_and_mean(self):
        for name, (count, median, mean, volume) in TABLES.items():
            drawn = self.folder / "sizes.csv"
            out = clast("grading", f"list:{FOLDER / name}", "--sample", 4 * count, "-o", drawn, "--json")
            self.assertEqual(out.code, 0, out.err)
            with open(drawn, encoding="utf-8", newline="") as file:
                sizes = [1e6 * float(row["diameter_m"]) for row in csv.DictReader(file)]
            listed = {round(float(row["Equivalent Diameter (µm)"]), 6) for row in self.rows(name)}
            self.assertLessEqual({round(s, 6) for s in sizes}, listed)  # only sizes of the list are drawn
            # a sample's mean: five standard errors
            spread = statistics.stdev(sizes) / len(sizes) ** 0.5
            self.assertLess(abs(statistics.fmean(sizes) - mean), 5 * spread + 1e-3)
            self.assertAlmostEqual(1e6 * out.json["drawn_by_number"]["d50"] / median, 1.0, delta=2.0 / count)
            self.assertAlmostEqual(out.json["mean_cube"] * 3.141592653589793 / 6 * 1e18 * count / volume, 1.0, 6)

    def test_one_command_predicts_a_bed(self):
        out = clast("predict", FOLDER / "ottawa-0000008.csv", "--grading", "U1", "--json").json
        forms = [(float(r["Flatness (-)"]), float(r["Elongation (-)"])) for r in self.rows("ottawa-0000008.csv")]
        equancy = [f * e for f, e in forms]
        wanted = (0.032 / statistics.fmean(equancy) - 0.003 / statistics.stdev(equancy)
                  + 0.011 / statistics.fmean(e for _, e in forms) + 0.287)  # eq. 23
        self.assertAlmostEqual(out["porosity"], wanted, 9)


if __name__ == "__main__":
    if not FOLDER.exists():
        print(f"SKIPPED: {FOLDER} is not here; 8,422 grains were not checked", file=sys.stderr)
    unittest.main()
