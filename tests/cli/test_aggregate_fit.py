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
