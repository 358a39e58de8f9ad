"""clast aggregate --fit does what its help says."""
import json
import os
import subprocess
import tempfile
import unittest

CLAST = os.environ["CLAST"]


def clast(*arguments):
    return subprocess.run([CLAST, *arguments], capture_output=True, text=True, timeout=300)


class Fit(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp()
        sizes = os.path.join(self.folder, "sizes.csv")
        with open(sizes, "w") as f:
            f.write("d_um,count\n20,6\n30,3\n")
        self.scene = ["aggregate", "--core", "data/scarlet/stl/Menger2.stl", "--core-size", "100um", "--accept-faults",
                      "--coat", "data/scarlet/stl/Menger2.stl", "--sizes", sizes, "--fit", "--quiet",
                      "--fit-packing", "1deg:1:1", "--fit-packing", "90deg:2:2", "--fit-repeats", "2",
                      "--fit-replicate-max", "2"]

    def test_reached(self):
        run = os.path.join(self.folder, "run")
        done = clast(*self.scene, "--observed-size", "115um", "--observed-size-error", "40um", "--json", "-o", run)
        self.assertEqual(done.returncode, 0, done.stderr)
        out = json.loads(done.stdout)
        self.assertTrue(out["reached"])
        self.assertIn("is reached", out["words"])
        self.assertEqual(set(out["best"]), {"cone_deg", "rays", "orientations", "replicate"})
        self.assertLess(abs(out["observables"]["size"]["pull"]), 2)
        self.assertEqual(set(out["spread"]["replicate"]), {"best", "mean", "deviation", "low", "high"})
        self.assertEqual(sorted(os.listdir(run)), ["fit.csv", "manifest.json", "summary.json"])
        with open(os.path.join(run, "summary.json")) as f:
            self.assertEqual(json.load(f), out)
        with open(os.path.join(run, "fit.csv")) as f:
            header, *rows = f.read().splitlines()
        self.assertEqual(header.split(",")[:4], ["cone_rad", "rays", "orientations", "replicate"])
        self.assertAlmostEqual(sum(float(r.split(",")[-1]) for r in rows), 1.0, places=12)

    def test_not_reached(self):
        done = clast(*self.scene, "--observed-density", "3000", "--observed-density-error", "10")
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertIn("cannot be reached", done.stdout)
        self.assertIn("cannot be reached", done.stderr)
        self.assertIn("tightest", done.stdout)

    def test_refused(self):
        done = clast(*self.scene)
        self.assertEqual(done.returncode, 2)
        self.assertIn("observed_size", done.stderr)
        done = clast(*self.scene, "--observed-size", "115um")
        self.assertEqual(done.returncode, 2)
        self.assertIn("error", done.stderr)
        done = clast(*self.scene, "--observed-size", "1m", "--observed-size-error", "1cm", "--rays", "3")
        self.assertEqual(done.returncode, 2)
        self.assertIn("fit_packing", done.stderr)


if __name__ == "__main__":
    unittest.main()
