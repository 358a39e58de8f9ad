"""CLI: agglomerate evolves a cloud as its help says."""
import csv
import json
import math
import random
import unittest

from clitest import ROOT, Case, clast

UNIFORM = ROOT / "data/d2sd/points_u3_n50.csv"
CUBE = "box:0,0,0,1,1,1"


def write(path, names, rows):
    path.write_text(",".join(names) + "\n" + "\n".join(",".join(repr(c) for c in row) for row in rows) + "\n")
    return path


class Agglomerate(Case):
    def test_constant_kernel_follows_the_exact_death_process(self):
        """E N of the finite cloud: dN/dt = -K/2V E[N (N - 1)]; 50 particles, solved state by state."""
        rate, n0, runs = 0.02, 50, 300
        r = clast("agglomerate", UNIFORM, "--domain", CUBE, "--constant", rate, "--duration", "2", "--n-step", "2",
                  "--repeats", runs, "--json").json
        chance, dt = [0.0] * (n0 + 1), 1e-3
        chance[n0] = 1.0
        for _ in range(2000):
            flow = [0.5 * rate * n * (n - 1) * p * dt for n, p in enumerate(chance)]
            chance = [p - flow[n] + (flow[n + 1] if n < n0 else 0.0) for n, p in enumerate(chance)]
        mean = sum(n * p for n, p in enumerate(chance))
        sd = r["n_particle_sd"][-1]
        self.assertAlmostEqual(r["n_particle"][-1], mean, delta=4 * sd / math.sqrt(runs) + 2e-3 * mean)
        self.assertEqual(r["time"], [0.0, 1.0, 2.0])
        self.assertEqual(r["moments"]["M1"], [50.0] * 3)
        self.assertEqual(r["moments"]["M0"], r["n_particle"])
        self.assertAlmostEqual(r["events"][-1], n0 - r["n_particle"][-1], places=9)
        self.assertAlmostEqual(r["exact"]["n_particle"][-1], 50 / (1 + 1.0), places=9)

    def test_folder_holds_tables_summary_and_charts(self):
        r = clast("agglomerate", UNIFORM, "--domain", CUBE, "--constant", "0.02", "--fixed", "2", "-o",
                  self.folder / "run", "--json")
        self.assertEqual(r.code, 0, r.err)
        for name in ("moments.svg", "number.svg"):
            self.assertIn("<svg", (self.folder / "run" / name).read_text())
        self.assertEqual(json.loads((self.folder / "run/summary.json").read_text()), {k: v for k, v in r.json.items() if k != "wall_s"})
        with open(self.folder / "run/particles.csv", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        sizes = {}
        for row in rows:
            sizes[row["aggregate"]] = sizes.get(row["aggregate"], 0) + 1
        self.assertEqual(sum(float(row["monomers"]) for row in rows), 50)
        for number, row in enumerate(rows):
            self.assertEqual(float(row["monomers"]), sizes.get(str(number), 0))
        self.assertEqual(len(sizes), r.json["n_particle"][-1])
        self.assertEqual(len(r.json["fixed"]["events"]), 11)

    def test_pairs_that_cells_hide_collide_too(self):
        """A plume of 1000 points, whose cells miss a tenth of the pairs: as many more collisions as decompose adds events."""
        rng, rows = random.Random(6), []
        while len(rows) < 1000:
            z = rng.random()
            p = [rng.gauss(0.5, math.sqrt(2e-4 + 0.004 * z)), rng.gauss(0.5, math.sqrt(2e-4 + 0.004 * z)), z]
            if 0 <= min(p) and max(p) <= 1:
                rows.append(p)
        file = write(self.folder / "plume.csv", ["x", "y", "z"], rows)
        bias = clast("decompose", file, "--domain", CUBE, "--beta-dt", "1e-9", "--json").json["smoothing_bias"]
        self.assertLess(bias, -0.07)
        mean, error = [], []
        for options in ((), ("--no-extrapolate",)):
            r = clast("agglomerate", file, "--domain", CUBE, "--constant", "1e-6", "--duration", "1", "--n-step", "1", "--repeats", "150",
                      "--tests", "pearson", "--json", *options).json
            mean.append(r["events"][-1])
            error.append(r["n_particle_sd"][-1] / math.sqrt(150) / r["events"][-1])
        self.assertAlmostEqual(mean[0] / mean[1], 1 / (1 + bias), delta=4 * math.hypot(*error))
        self.assertLess(4 * math.hypot(*error), -0.7 * bias)

    def test_same_seed_gives_the_same_run_for_any_thread_count(self):
        runs = []
        for threads, seed in (("1", 3), ("4", 3), ("1", 4)):
            r = clast("agglomerate", UNIFORM, "--domain", CUBE, "--constant", "0.02", "-j", threads, "--seed", seed,
                      "--json").json
            del r["wall_s"]
            runs.append(r)
        self.assertEqual(runs[0], runs[1])
        self.assertNotEqual(runs[0], runs[2])

    def test_cells_take_the_mean_of_field_columns(self):
        """Two cells of a mesh by column; shear acts where it is, and nowhere else."""
        random.seed(2)
        rows = []
        for i in range(400):
            left = i % 2 == 0
            x = 0.5 * random.random() + (0.0 if left else 0.5)
            rows.append([x, random.random(), random.random(), 1e-2, 30.0 if left else 1e-9, 0 if left else 1, 0.5])
        file = write(self.folder / "p.csv", ["x", "y", "z", "r", "G", "cell", "volume"], rows)
        r = clast("agglomerate", file, "--domain", CUBE, "--kernel", "shear_laminar", "--radius-column", "r",
                  "--shear-column", "G", "--fixed-column", "cell", "--fixed-volume-column", "volume", "--duration", "10",
                  "--out-of-range", "extrapolate", "--json", "-o", self.folder / "run")
        self.assertEqual(r.code, 0, r.err)
        self.assertGreater(r.json["fixed"]["events"][-1], 20)
        self.assertGreaterEqual(r.json["fixed"]["n_particle"][-1], 200)

    def test_cells_of_particles_that_do_not_show_their_structure_are_told(self):
        even = [[(i % 40 + 0.5) / 40, (i // 40 + 0.5) / 40] for i in range(1600)]
        random.seed(7)
        drawn = [[random.random(), random.random()] for _ in range(1600)]
        for name, points, times in (("even", even, 1), ("drawn", drawn, 0)):
            file = write(self.folder / f"{name}.csv", ["x", "y"], points)
            options = (file, "--domain", "box:0,0,1,1", "--constant", "1e-6")
            self.assertEqual(clast("agglomerate", *options, "--json").json["n_unresolved"], times)
            said = "warning: 1 of 1 times that cells were made the particles did not show their own structure"
            self.assertEqual(said in clast("agglomerate", *options).out, times == 1)

    def test_snapshots_move_particles_and_renew_cells_when_they_must(self):
        random.seed(5)
        here = [[random.random() for _ in range(2)] for _ in range(600)]
        near = [[min(1.0, x + 1e-4) for x in p] for p in here]
        far = [[0.3 * x for x in p] for p in here]
        files = [write(self.folder / f"{k}.csv", ["x", "y"], p) for k, p in enumerate((here, near, far))]
        r = clast("agglomerate", *files, "--domain", "box:0,0,1,1", "--constant", "1e-5", "--n-step", "2", "--json").json
        self.assertEqual(len(r["time"]), 7)
        self.assertEqual(r["n_rebuilt"], 1)
        self.assertEqual(r["n_cell"][:5], [1] * 5)
        self.assertGreater(r["n_cell"][-1], 1)
        always = clast("agglomerate", *files, "--domain", "box:0,0,1,1", "--constant", "1e-5", "--rebuild", "always",
                       "--json").json
        self.assertEqual(always["n_rebuilt"], 2)
        short = write(self.folder / "short.csv", ["x", "y"], here[:5])
        self.assert_fails(3, "agglomerate", files[0], short, "--domain", "box:0,0,1,1", says=["snapshot 2 has 5"])

    def test_physical_kernels_name_what_is_missing(self):
        wanted = [(["--kernel", "brown"], "'brown'"), (["--kernel", "brownian"], "radius column or --monomer-radius"),
                  (["--kernel", "shear_laminar", "--monomer-radius", "1um"], "needs a shear > 0"),
                  (["--kernel", "settling", "--monomer-radius", "1um"], "mass column or --particle-density"),
                  (["--kernel", "ballistic", "--monomer-radius", "1um"], "velocity columns"),
                  (["--radius-law", "fractal"], "volume|fractal-collision|fractal-gyration"),
                  (["--radius-law", "fractal-gyration"], "fractal radii need --monomer-radius")]
        for options, words in wanted:
            self.assert_fails(2, "agglomerate", UNIFORM, "--domain", CUBE, *options, says=[words])
        self.assert_fails(2, "agglomerate", ROOT / "data/d2sd/points_u2_n50.csv", "--domain", "box:0,0,1,1", "--kernel",
                          "brownian", "--monomer-radius", "1um", says=["2 dimensions", "--depth"])
        self.assert_fails(3, "agglomerate", UNIFORM, "--domain", CUBE, "--radius-column", "r", says=["'r'"])
        bad = write(self.folder / "bad.csv", ["x", "y", "z", "r"], [[0.5, 0.5, 0.5, 1e-6], [0.1, 0.1, 0.1, -1e-6]])
        self.assert_fails(3, "agglomerate", bad, "--domain", CUBE, "--radius-column", "r", says=["particle 2", "-1e-06"])
        half = write(self.folder / "half.csv", ["x", "y", "z", "m"], [[0.5, 0.5, 0.5, 1.5]])
        self.assert_fails(3, "agglomerate", half, "--domain", CUBE, "--monomers-column", "m", says=["particle 1", "whole"])


if __name__ == "__main__":
    unittest.main()
