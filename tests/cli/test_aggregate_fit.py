"""clast aggregate --fit does what its help says."""
import json
import unittest

from clitest import Case, clast


class Fit(Case):
    def setUp(self):
        super().setUp()
        sizes = self.folder / "sizes.csv"
        sizes.write_text("d_um,count\n20,6\n30,3\n")
        self.scene = ["aggregate", "--core", "data/scarlet/stl/Menger2.stl", "--core-size", "100um", "--accept-faults",
                      "--coat", "data/scarlet/stl/Menger2.stl", "--sizes", sizes, "--fit", "--quiet",
                      "--fit-packing", "1deg:1:1", "--fit-packing", "90deg:2:2", "--fit-repeats", "2",
                      "--fit-replicate-max", "2"]

    def test_inside(self):
        run = self.folder / "run"
        done = clast(*self.scene, "--observed-size", "115um", "--observed-size-error", "40um", "--json", "-o", run)
        self.assertEqual(done.code, 0, done.err)
        out = done.json
        self.assertEqual(out["verdict"], "inside")
        self.assertIn("inside the observed interval", out["words"])
        self.assertIn("um against 115 +- 40 um", out["words"])
        self.assertEqual((out["degrees_of_freedom"], out["p_value"]), (0, None))
        self.assertEqual(set(out["best"]), {"cone_deg", "rays", "orientations", "replicate"})
        self.assertLess(abs(out["observables"]["size"]["pull"]), 2)
        self.assertEqual(set(out["spread"]["replicate"]), {"best", "mean", "deviation", "low", "high"})
        self.assertEqual(sorted(p.name for p in run.iterdir()), ["fit.csv", "fit.svg", "manifest.json", "summary.json"])
        self.assertEqual(json.loads((run / "summary.json").read_text()), out)
        self.assertIn("rgb(83.5%", (run / "fit.svg").read_text())  # points of the second packing
        header, *rows = (run / "fit.csv").read_text().splitlines()
        self.assertEqual(header.split(",")[:4], ["cone_rad", "rays", "orientations", "replicate"])
        self.assertAlmostEqual(sum(float(r.split(",")[-1]) for r in rows), 1.0, places=12)

    def test_edge(self):
        done = clast(*self.scene, "--observed-density", "3000", "--observed-density-error", "10")
        self.assertEqual(done.code, 1, done.err)
        self.assertIn("at the edge of what was tried", done.out)
        self.assertIn("tightest packing tried: add tighter ones to fit_packing", done.out)

    def test_intervals_hold_the_best(self):
        """The speed is least between two N_A: "1.772, 68 % of the weight between 1.776 .. 1.801" (m/s)."""
        line = ["aggregate", "--fit", "--core", "sphere", "--core-size", "270um", "--coat", "sphere", "--size", "40um", "--size", "60um",
                "--fit-packing", "1deg:1:1", "--fit-replicate-max", "64", "--fit-repeats", "2",
                "--observed-velocity", "1.632m/s", "--observed-velocity-error", "0.02m/s"]
        done = clast(*line, "--json")
        self.assertEqual(done.code, 1, done.err)
        for name, spread in done.json["spread"].items():
            self.assertLessEqual(spread["low"], spread["best"], name)
            self.assertLessEqual(spread["best"], spread["high"], name)
        speed = done.json["spread"]["settling_velocity"]
        self.assertEqual(speed["low"], speed["best"])  # none of what was grown is slower

    def test_sizes_are_told_in_units_that_suit_them(self):
        """In um whatever they are: "size 1.081e+06 um against 1.15e+06 +- 4e+05 um"."""
        grown = [str(word).replace("100um", "1m") for word in self.scene]
        sizes = self.folder / "sizes.csv"
        sizes.write_text("d_m,count\n0.2,6\n0.3,3\n")
        done = clast(*grown, "--observed-size", "1.15m", "--observed-size-error", "0.4m")
        self.assertEqual(done.code, 0, done.err)
        self.assertIn(" m against 1.15 +- 0.4 m ", done.out)
        self.assertRegex(done.out, r"D_agg +1\.\d+ +\d\.\d+ \.\. [\d.]+ +m\n")

    def test_refused(self):
        size = ["--observed-size", "115um"]
        self.assert_fails(2, *self.scene, says=["observed_size"])
        self.assert_fails(2, *self.scene, *size, says=["error"])
        size += ["--observed-size-error", "1um"]
        self.assert_fails(2, *self.scene, *size, "--rays", "3", says=["fit_packing"])
        self.assert_fails(2, *self.scene, *size, "--replicate", "3", says=["fit_replicate_max"])
        self.assert_fails(2, *self.scene, *size, "--resume", self.folder, says=["--resume"])


if __name__ == "__main__":
    unittest.main()
