"""CLI: agglomerate --box-model evolves a size spectrum without positions; clouds have spectra too."""
import csv
import math
import random
import re
import unittest

from clitest import ROOT, Case, clast

UNIFORM = ROOT / "data/d2sd/points_u3_n50.csv"
BOX = ("agglomerate", "--box-model", "--concentration", "2")
CHARTS = ["clusters.svg", "moments.svg", "number.svg", "spectrum.svg"]


def rows(path):
    with open(path, encoding="utf-8") as file:
        return [{k: float(v) for k, v in row.items()} for row in csv.DictReader(line for line in file if line[0] != "#")]


class BoxModel(Case):
    def need_sectional(self):
        if "without SUNDIALS" in clast(*BOX, "--solver", "sectional", "--per-octave", "1").err:
            print("SKIPPED: this build has no SUNDIALS (tools/setup.sh sundials)")
            self.skipTest("no SUNDIALS")

    def test_what_rises_does_not_settle(self):
        self.need_sectional()
        for solver in ("monte-carlo", "sectional"):
            self.assert_fails(2, *BOX, "--solver", solver, "--constant", "0", "--monomer-radius", "50um", "--particle-density", "500",
                              "--settling-depth", "1m", "--duration", "1s", says=("settling_depth", "500 kg/m^3", "do not settle"))

    def test_a_tail_that_the_drawn_particles_do_not_hold_is_told(self):
        law = ("--constant", "1", "--duration", "1us", "--initial", "lognormal", "--initial-sd")
        wide = clast(*BOX, *law, "8", "--json")
        self.assertIn("of M2 of their law at the start", wide.err)
        self.assertAlmostEqual(wide.json["law_M2"], 2 * math.exp(math.log(8) ** 2), delta=1e-9 * wide.json["law_M2"])
        self.assertEqual(wide.json["law_M1"], 2.0)
        self.assertLess(wide.json["moments"]["M2"][0], 0.99 * wide.json["law_M2"])
        self.assertEqual(clast(*BOX, *law, "1.2").err, "")
        self.need_sectional()
        self.assertEqual(clast(*BOX, *law, "8", "--solver", "sectional").err, "")

    def test_monte_carlo_meets_the_exact_number_in_tables_charts_and_json(self):
        run = self.folder / "run"
        r = clast(*BOX, "--kernel", "constant", "--constant", "1", "--duration", "1", "--n-step", "2", "--repeats", "10",
                  "--particles", "2000", "--json", "-o", run)
        self.assertEqual(r.code, 0, r.err)
        sd = r.json["n_particle_sd"][-1] / math.sqrt(10)
        self.assertAlmostEqual(r.json["n_particle"][-1], 1.0, delta=4 * sd + 2e-3)
        self.assertAlmostEqual(r.json["exact"]["n_particle"][-1], 1.0, places=12)
        self.assertEqual(r.json["moments"]["M1"], [2.0] * 3)
        self.assertEqual(r.json["events"][-1], 2.0 - r.json["n_particle"][-1])
        self.assertAlmostEqual(r.json["clusters"]["n_1"][-1], 0.5, delta=0.02)
        self.assertEqual(sorted(p.name for p in run.glob("*.svg")), CHARTS)
        spectrum = [row for row in rows(run / "spectrum.csv") if row["time_s"] == 1.0]
        self.assertAlmostEqual(sum(row["n"] for row in spectrum), r.json["n_particle"][-1], places=9)
        self.assertAlmostEqual(sum(row["mass_fraction"] for row in spectrum), 1.0, places=9)
        self.assertEqual(clast("report", run).code, 0)
        page = (run / "report.html").read_text(encoding="utf-8")
        self.assertEqual(re.findall(r"<(?:th|h4|summary)[^>]*><code>([^<]*)", page), [])
        for name in CHARTS:
            self.assertIn(name, page)

    def test_sectional_solver_with_breakage_and_gelation(self):
        self.need_sectional()
        sectional = (*BOX, "--solver", "sectional", "--per-octave", "8", "--n-step", "2", "--json")
        r = clast(*sectional, "--kernel", "additive", "--additive", "0.5", "--duration", "1", "--size-max", "1e4").json
        self.assertAlmostEqual(r["n_particle"][-1], 2 * math.exp(-1), places=6)
        self.assertLess(r["mass_error"], 1e-12)
        self.assertIsNone(r["gel_time"])
        self.assertNotIn("n_particle_sd", r)
        run = self.folder / "gel"
        r = clast(*sectional, "--kernel", "product", "--product", "0.5", "--duration", "1.2", "-o", run)
        self.assertEqual(r.code, 0, r.err)
        self.assertAlmostEqual(r.json["gel_time"], 1.0, delta=0.01)
        self.assertEqual((r.json["is_gelation"], r.json["exact_gel_time"]), (True, 1.0))
        self.assertIsNone(r.json["exact"]["n_particle"][-1])
        words = clast(*sectional[:-1], "--kernel", "product", "--product", "0.5", "--duration", "1.2")
        self.assertRegex(words.out, r"gelation at (0\.99|1\.00)\d* s")
        self.assertNotIn("nan", words.out)  # "exact n" after the gel
        self.assertRegex(words.out, r"(?m)^ *1\.2 .* -$")
        words = clast(*sectional[:-1], "--constant", "1", "--duration", "20", "--size-max", "20")
        self.assertIn("the grid is too small (--size-max)", words.out)
        r = clast(*sectional, "--constant", "1", "--breakage-rate", "1", "--initial", "exponential", "--size-min", "1e-4",
                  "--size-max", "100", "--duration", "5").json
        self.assertAlmostEqual(r["n_particle"][-1], 2.0, delta=0.01)  # sqrt(2 S1 M1 / K)
        self.assertEqual(r["events"], [])

    def test_monte_carlo_breaks_fills_settles_and_gels(self):
        run = self.folder / "run"
        words = (*BOX, "--kernel", "constant", "--constant", "0.5", "--duration", "3", "--n-step", "3", "--repeats", "8", "--particles",
                 "1000", "--breakage-rate", "0.2", "--source", "0.5", "--settling-depth", "1mm", "--monomer-radius", "10um",
                 "--particle-density", "2000")
        r = clast(*words, "--json", "-o", run)
        self.assertEqual(r.code, 0, r.err)
        self.assertEqual(r.json["mass_error"], 0.0)
        self.assertEqual(sorted(p.name for p in run.glob("*.svg")), sorted([*CHARTS, "balance.svg"]))
        history = rows(run / "history.csv")
        for row in history:
            self.assertAlmostEqual(row["M1"] / 2 + row["settled_fraction"], 1 + row["added_fraction"], delta=1e-12)
        self.assertGreater(history[-1]["settled_fraction"], 0.1)
        self.assertAlmostEqual(r.json["added_fraction"][-1], 0.75, delta=0.05)
        self.assertEqual(r.json["events"], [])  # no difference of numbers tells them here
        self.assertIn("settled        added", clast(*words).out)
        one, two = (clast(*words, "-j", threads, "--json").json for threads in ("1", "4"))
        del one["wall_s"], two["wall_s"]
        self.assertEqual(one, two)
        gel = clast(*BOX, "--kernel", "product", "--product", "0.5", "--duration", "1.5", "--repeats", "3", "--particles", "5000", "--json")
        self.assertEqual((gel.json["is_gelation"], gel.json["n_gelled"]), (True, 3))
        self.assertAlmostEqual(gel.json["gel_time"], 1.0, delta=0.06)
        self.assertGreater(gel.json["gel_fraction"][-1], 0.3)
        out = clast(*BOX, "--kernel", "product", "--product", "0.5", "--duration", "1.5", "--repeats", "3", "--particles", "5000").out
        self.assertRegex(out, r"gelation at (0\.9|1\.0)\d* s \(mean of 3 of 3 runs\)")

    def test_a_table_of_sizes_is_a_start(self):
        table = self.folder / "sizes.csv"
        table.write_text("size,number\n1,3\n4,1\n")
        r = clast("agglomerate", "--box-model", "--initial", "table", "--initial-file", table, "--constant", "1e-9", "--n-step",
                  "1", "--json").json
        self.assertEqual(r["moments"]["M0"], [4.0] * 2)
        self.assertAlmostEqual(r["moments"]["M2"][0], 19.0, delta=1e-2)
        table.write_text("size,count\n1,3\n")
        self.assert_fails(3, "agglomerate", "--box-model", "--initial", "table", "--initial-file", table,
                          says=["sizes.csv", "columns size and number"])
        # a box's own spectrum was refused: its numbers are called n, and it has many times
        run = ("agglomerate", "--box-model", "--constant", "1", "--n-step", "2", "--json")
        first = clast(*run, "--concentration", "2", "-o", self.folder / "first").json
        on = clast(*run, "--initial", "table", "--initial-file", self.folder / "first/spectrum.csv").json
        self.assertAlmostEqual(on["n_particle"][0], first["n_particle"][-1], places=9)
        self.assertAlmostEqual(on["moments"]["M1"][0], 2.0, delta=2e-2)
        start = ("agglomerate", "--box-model", "--constant", "1e-9", "--n-step", 1, "--json", "--initial", "table", "--initial-file", table)
        table.write_text("time_s,size,n\n0,1,9\n1,1,5\n0,2,1\n1,2,1\n")  # by size: the last row alone was taken
        self.assertEqual(clast(*start).json["moments"]["M0"][0], 6)
        for text, line in (("time_s,size,n\n0,1,9\nnan,1,5\n", "row 2: time_s is nan"), ("size,number\n", "no row of sizes"),
                           ("time_s,size,size_low,size_high,n\n0,1,1,1,9\n", "the spectrum of a cloud, whose n counts particles")):
            table.write_text(text)
            self.assert_fails(3, *start, says=["sizes.csv", line])
        table.write_text("size,number\n1,3\n-4,1\n")
        self.assert_fails(3, "agglomerate", "--box-model", "--initial", "table", "--initial-file", table,
                          says=["sizes.csv", "row 2", "-4"])

    def test_a_start_that_cannot_break_is_refused(self):
        # "the smallest size does not break", and that of the start is the smallest: 1e12 stayed 1e12, without a word
        common = ("agglomerate", "--box-model", "--concentration", "1e12", "--constant", "1e-30", "--breakage-rate", "1", "--duration", "0.01s",
                  "--n-step", "1", "--json")
        table = self.folder / "one.csv"
        table.write_text("size,number\n100,1e12\n")
        for start in (("--initial-mean", "100"), ("--initial", "table", "--initial-file", table),
                      ("--initial-mean", "100", "--source", "1e3", "--source-size", "200")):
            for solver in ("monte-carlo", "sectional"):
                self.assert_fails(2, *common, *start, "--solver", solver, says=["has 100 monomers", "does not break", "--size-min"])
        r = clast(*common, "--initial-mean", "100", "--size-min", "1").json
        self.assertAlmostEqual(r["n_particle"][-1], 2e12, delta=0.05e12)  # N0 (1 + S1 x t)
        self.assertEqual(clast(*common).code, 0)  # monomers: what they form breaks

    def test_numbers_of_a_table_are_shares_of_a_concentration_and_it_says_so(self):
        table = self.folder / "sizes.csv"
        table.write_text("size,number\n1,1e12\n2,5e11\n")
        common = ("agglomerate", "--box-model", "--initial", "table", "--initial-file", table, "--constant", "1e-20", "--n-step", "1", "--json")
        r = clast(*common, "--concentration", "5")
        self.assertEqual(r.json["n_particle"][0], 5)
        self.assertIn("note: the numbers of", r.err)
        self.assertIn("1.5e+12 in all, are taken as shares of --concentration 5 1/m^3", r.err)
        for words in ((), ("--concentration", "1.5e12"), ("--concentration", "5", "--quiet")):
            self.assertEqual(clast(*common, *words).err, "")

    def test_what_does_not_go_together_is_refused(self):
        wanted = [(("agglomerate",), "missing POINTS... (or --box-model"),
                  (("agglomerate", UNIFORM, "--domain", "box:0,0,0,1,1,1", "--solver", "sectional"), "--solver is an option of a box"),
                  ((*BOX, UNIFORM), "a box has no positions"),
                  ((*BOX, "--mesh", "boxes"), "--mesh is an option of clouds"),
                  ((*BOX, "--charts", "png"), "--charts does nothing without -o"),
                  ((*BOX, "--breakage-rate", "1", "--fragment-exponent", "1"), "has no whole number: take sectional"),
                  ((*BOX, "--fragments", "halves"), "--fragments does nothing without --breakage-rate"),
                  ((*BOX, "--breakage-rate", "1", "--fragments", "halves", "--fragment-exponent", "-0.5"),
                   "--fragment-exponent does nothing with --fragments halves"),
                  ((*BOX, "--source-size", "2"), "--source-size does nothing without --source"),
                  ((*BOX, "--source", "2", "--source-size", "1e9"), "source_size: 1e+09 monomers lies outside the grid"),
                  ((*BOX, "--size-min", "1e-15"), "the particles of the start are more than 2^53 units of 1e-15 monomers"),
                  ((*BOX, "--source", "1", "--source-size", "1e-20"), "more than 2^53 units of 1e-20 monomers"),
                  ((*BOX, "--initial-sd", "2"), "--initial-sd does nothing without --initial lognormal"),
                  ((*BOX, "--initial", "table", "--initial-file", UNIFORM, "--initial-mean", "2"),
                   "--initial-mean does nothing with --initial table"),
                  ((*BOX, "--tolerance", "1e-3"), "--tolerance does nothing with this --solver"),
                  ((*BOX, "--solver", "sectional", "--seed", "3"), "--seed does nothing with this --solver"),
                  ((*BOX, "--initial", "table"), "--initial table and --initial-file go together"),
                  ((*BOX, "--kernel", "ballistic"), "which a box does not have"),
                  ((*BOX, "--kernel", "brownian"), "--monomer-radius"),
                  ((*BOX, "--shear", "3"), "--shear does nothing with --kernel constant"),
                  ((*BOX, "--settling-depth", "1m", "--efficiency", "1"), "--efficiency does nothing with --kernel constant"),
                  (("agglomerate", UNIFORM, "--kernel", "brownian+settling", "--dissipation-column", "e"),
                   "--dissipation-column does nothing with --kernel brownian+settling"),
                  (("agglomerate", UNIFORM, "--sticking", "liquid", "--asperity", "1um"), "--asperity does nothing with --sticking liquid"),
                  (("agglomerate", UNIFORM, "--fractal-prefactor", "1.3"), "--fractal-prefactor does nothing with --radius-law volume"),
                  (("agglomerate", "--box-model"), "--concentration")]
        for words, says in wanted:
            self.assert_fails(2, *words, says=[says])
        settles = clast(*BOX, "--settling-depth", "1m", "--gravity", "5", "--monomer-radius", "1um", "--particle-density", "2000", "--json")
        self.assertEqual(settles.code, 0, settles.err)  # by which particles settle, whatever the kernel

    def test_any_thread_count_gives_the_same_spectrum(self):
        runs = []
        for threads, seed in (("1", 3), ("4", 3), ("1", 4)):
            r = clast(*BOX, "--constant", "1", "--particles", "500", "-j", threads, "--seed", seed, "--json").json
            del r["wall_s"]
            runs.append(r)
        self.assertEqual(runs[0], runs[1])
        self.assertNotEqual(runs[0], runs[2])


class CloudSpectra(Case):
    def test_spectra_of_a_cloud_count_its_aggregates(self):
        run = self.folder / "run"
        r = clast("agglomerate", UNIFORM, "--domain", "box:0,0,0,1,1,1", "--constant", "0.05", "--n-step", "3", "--repeats", "6",
                  "-o", run, "--json")
        self.assertEqual(r.code, 0, r.err)
        last = [row for row in rows(run / "spectrum.csv") if row["time_s"] == 1.0]
        self.assertAlmostEqual(sum(row["n"] for row in last), r.json["n_particle"][-1], places=9)
        for k in range(1, 9):
            self.assertEqual(last[k - 1]["size"], k)
            self.assertEqual(last[k - 1]["n"], r.json["clusters"][f"n_{k}"][-1])
        self.assertLessEqual(sum(row["n"] * row["size_low"] for row in last), 50 + 1e-9)
        self.assertGreaterEqual(sum(row["n"] * row["size_high"] for row in last), 50 - 1e-9)
        self.assertGreater(r.json["moments_sd"]["M2"][-1], 0)
        self.assertEqual(sorted(p.name for p in run.glob("*.svg")), CHARTS)

    def test_gelation_of_a_cloud_is_named(self):
        points = self.folder / "points.csv"
        rng = random.Random(3)
        points.write_text("x,y,z\n" + "".join(f"{rng.random()},{rng.random()},{rng.random()}\n" for _ in range(1500)))
        words = ("agglomerate", points, "--domain", "box:0,0,0,1,1,1", "--duration", "1.5", "--n-step", "30", "--repeats", "12")
        gel = clast(*words, "--kernel", "product", "--product", str(1 / 1500), "-o", self.folder / "gel", "--json").json
        self.assertEqual((gel["n_cell"][-1], gel["is_gelation"], gel["n_gelled"]), (1, True, 12))
        self.assertAlmostEqual(gel["gel_time"], 1.0, delta=1500 ** (-1 / 3) + 0.05)  # the width of the critical window, and a step
        self.assertAlmostEqual(gel["gel_fraction"][-1], 0.583, delta=0.02)  # g = 1 - exp(-g T) [Flory]
        with open(self.folder / "gel/history.csv", encoding="utf-8") as file:
            history = [{"gelled": float(row["gelled"])} for row in csv.DictReader(line for line in file if line[0] != "#")]
        self.assertEqual((history[0]["gelled"], history[-1]["gelled"]), (0, 1))
        self.assertRegex(clast(*words, "--kernel", "product", "--product", str(1 / 1500)).out, r"gelation by (0\.9|1\.)\d* s \(12 of 12 runs\)")
        even = clast(*words, "--constant", str(1 / 1500), "--json").json
        self.assertEqual((even["gel_time"], even["is_gelation"], even["n_gelled"]), (None, False, 0))


if __name__ == "__main__":
    unittest.main()
