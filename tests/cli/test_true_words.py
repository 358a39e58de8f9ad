"""CLI: what decompose says of a cloud is true, with units: stdout, JSON, tables, pictures' files and exit codes."""
import itertools
import json
import math
import random
import re
import unittest

from clitest import ROOT, Case, clast

B3 = ROOT / "data/d2sd/points_b3_n500.csv"
U2 = ROOT / "data/d2sd/points_u2_n50.csv"
S2 = ROOT / "data/d2sd/points_s2_n500.csv"
CUBE, SQUARE = "box:0,0,0,1,1,1", "box:0,0,1,1"


def table(path):
    """Notes and rows of a CSV file: lines that begin with # are notes."""
    lines = path.read_text().splitlines()
    rows = [line.split(",") for line in lines if not line.startswith("#")]
    return [line for line in lines if line.startswith("#")], [dict(zip(rows[0], row)) for row in rows[1:]]


class TrueWords(Case):
    def write(self, name, points):
        path = self.folder / name
        path.write_text(",".join("xyz"[:len(points[0])]) + "\n" + "".join(",".join(map(repr, p)) + "\n" for p in points))
        return path

    def decompose(self, path, domain, *options, code=0):
        r = clast("decompose", path, "--domain", domain, "--json", *options)
        self.assertEqual(r.code, code, r.err)
        return r.json

    def test_without_beta_dt_the_answer_is_the_pair_integral(self):
        for path, domain, d, n in ((U2, SQUARE, 2, 50), (B3, CUBE, 3, 500)):
            plain = self.decompose(path, domain)
            self.assertIsNone(plain["beta_dt"])
            for key in ("events", "events_low", "events_high", "n_capped"):
                self.assertIsNone(plain[key], key)
            self.assertEqual(plain["pair_integral_unit"], f"1/m^{d}")
            timed = self.decompose(path, domain, "--beta-dt", "1e-9")
            self.assertEqual(timed["beta_dt"], 1e-9)
            self.assertIsNone(timed["pair_integral"])
            for end in ("", "_low", "_high") if plain["resolved"] else ("", "_low"):
                self.assertAlmostEqual(plain["pair_integral" + end] * 1e-9 / timed["events" + end], 1.0, places=12)
            words = clast("decompose", path, "--domain", domain).out
            self.assertRegex(words, rf"pair integral [\d.e+]+ \[[\d.e+]+, [\d.e+-]+\] 1/m\^{d}, events per beta dt")
            self.assertNotRegex(words, r"\bcap\b")
        self.assertAlmostEqual(self.decompose(U2, SQUARE)["pair_integral"], 0.5 * 50 * 49, places=9)
        out = self.folder / "out"
        r = clast("decompose", S2, "--domain", SQUARE, "--sizes", "3", "--regular", "5", "-o", out)
        self.assertEqual(r.code, 0, r.err)
        _, rows = table(out / "cells.csv")
        self.assertIn("pair_integral", rows[0])
        self.assertNotIn("events", rows[0])
        self.assertIn("scaled_pair_integral", table(out / "events_by_n.csv")[1][0])
        self.assertIn("pair_integral.svg", {path.name for path in out.iterdir()})
        self.assertIn('Name="pair_integral"', (out / "cells.vtu").read_text())
        page = self.folder / "page.html"
        self.assertEqual(clast("report", out, "-o", page).code, 0)
        text = re.sub(r"<[^>]+>", " ", page.read_text())
        self.assertRegex(text, r"Pair integral, events per beta dt \(1/m\^d\)")
        self.assertRegex(text, r"Standard score\s+-?[\d.]+\s+p-value")  # "z" is no length here

    def test_a_tree_has_no_labels(self):
        out = self.folder / "out"
        r = self.decompose(B3, CUBE, "-o", out)
        self.assertEqual((r["labels"], r["n_cell"]), (None, 127))
        _, rows = table(out / "cells.csv")
        self.assertFalse({"label", "pass"} & set(rows[0]))
        self.assertEqual(list(table(out / "point_cells.csv")[1][0]), ["cell"])
        for name in ("cells.vtu", "points.vtp"):
            self.assertNotIn('Name="label"', (out / name).read_text())
        self.assertGreater(len(set(re.findall(r"rgb\(([^)]*)\)", (out / "points.svg").read_text()))), 20)  # by density, not by four groups of labels
        boxes = self.decompose(B3, CUBE, "--mesh", "boxes", "-o", self.folder / "boxes")
        self.assertGreater(boxes["labels"]["cluster_1"], 0)
        self.assertLess(len(set(re.findall(r"rgb\(([^)]*)\)", (self.folder / "boxes/points.svg").read_text()))), 10)

    def test_what_means_nothing_is_null(self):
        tree = self.decompose(B3, CUBE)
        self.assertEqual((tree["points_per_bin"], tree["bias_estimate"]), (None, None))
        boxes = self.decompose(B3, CUBE, "--mesh", "boxes")
        self.assertGreater(boxes["points_per_bin"], 0)
        self.assertIsNone(boxes["bias_estimate"])  # n (n - 1) has none
        printed = self.decompose(B3, CUBE, "--mesh", "boxes", "--events", "paper")
        self.assertAlmostEqual(printed["bias_estimate"], printed["n_cell"] / 500)

    def test_pearson_is_of_one_pair_and_names_it(self):
        random.seed(2)
        points = []
        for _ in range(400):
            x = random.random()
            points.append([x, random.random(), (0.7 * x + 0.3 * random.random())])
        path = self.write("xz.csv", points)
        test = {t["name"]: t for t in self.decompose(path, CUBE)["tests"]}
        mean = [sum(p[k] for p in points) / 400 for k in range(3)]
        r = (sum((p[0] - mean[0]) * (p[2] - mean[2]) for p in points)
             / math.sqrt(sum((p[0] - mean[0]) ** 2 for p in points) * sum((p[2] - mean[2]) ** 2 for p in points)))
        self.assertEqual(test["pearson"]["axes"], ["x", "z"])
        self.assertAlmostEqual(test["pearson"]["statistic"], r, places=12)
        self.assertLess(test["pearson"]["p"], 1e-50)
        self.assertIsNone(test["star"]["axes"])
        self.assertRegex(clast("decompose", path, "--domain", CUBE).out, r"pearson x,z +0\.9")
        flat = self.decompose(path, "cylinder:2,1", "--outside", "drop", "--mesh", "boxes")
        self.assertTrue(set(next(t for t in flat["tests"] if t["name"] == "pearson")["axes"]) < {"u", "v", "w"})

    def test_intervals_end_at_the_cap(self):
        random.seed(8)
        path = self.write("even.csv", [[random.random(), random.random()] for _ in range(2000)])
        highest = []
        for beta_dt in ("1e-6", "4.99e-4", "1"):  # one cell of 2000 points: 1000 events at the most
            r = self.decompose(path, SQUARE, "--beta-dt", beta_dt)
            self.assertTrue(r["resolved"])
            self.assertLessEqual(r["events_low"], r["events"])
            self.assertLessEqual(r["events"], r["events_high"])
            highest.append(r["events_high"])
        self.assertLess(highest[0], 3.0)
        self.assertEqual(highest[1:], [1000.0, 1000.0])

    def test_an_empty_file_is_bad_input(self):
        path = self.folder / "none.csv"
        path.write_text("x,y,z\n")
        for command in ("decompose", "agglomerate"):
            self.assert_fails(3, command, path, "--domain", CUBE, says=["none.csv", "no points"])
        self.assert_fails(3, "decompose", U2, "--domain", "box:5,5,6,6", "--outside", "drop",
                          says=["none of the 50 points", "box:5,5,6,6", "same unit"])

    def test_test_only_ends_with_1_when_rejected(self):
        self.assertTrue(self.decompose(B3, CUBE, "--test-only", code=1)["reject"])
        self.assertFalse(self.decompose(U2, SQUARE, "--test-only")["reject"])
        out = self.folder / "out"
        r = clast("decompose", B3, "--domain", CUBE, "--test-only", "-o", out)
        self.assertEqual((r.code, r.err), (1, ""))
        self.assertTrue(json.loads((out / "summary.json").read_text())["reject"])
        self.assertRegex(clast("decompose", "--help").out, r"--test-only .*exit code 1")

    def test_the_tests_alone_give_no_number_of_what_they_do_not_compute(self):
        # a cloud just rejected had the pair integral of one cell, 124750
        none = ["n_cell", "labels", "resolved", "points_needed", "cells_bias", "points_per_bin", "bias_estimate", "smoothing_bias",
                "estimator", "n_capped", "seed"]
        none += [what + end for what in ("events", "pair_integral") for end in ("", "_low", "_high", "_cross")]
        for path, domain, code in ((B3, CUBE, 1), (U2, SQUARE, 0)):
            for option in (("--test-only",), ("--variant", "test")):
                r = self.decompose(path, domain, *option, code=code if len(option) == 1 else 0)
                self.assertEqual(({key: r[key] for key in none}, r["passes"]), (dict.fromkeys(none), []))
                self.assertEqual((r["reject"], len(r["tests"])), (code == 1, 5))
                words = clast("decompose", path, "--domain", domain, *option).out
                self.assertNotRegex(words, r"cell|pair integral|events|resolved|stop")
        out = self.folder / "out"
        self.assertEqual(clast("decompose", B3, "--domain", CUBE, "--variant", "test", "-o", out).code, 0)
        _, rows = table(out / "cells.csv")
        self.assertEqual(rows[0]["pair_integral"], "")

    def test_too_few_points_are_not_tested(self):
        path = self.write("four.csv", [[0.1, 0.2, 0.3], [0.4, 0.5, 0.6], [0.7, 0.8, 0.9], [0.2, 0.8, 0.5]])
        for more in ((), ("--test-only",)):
            r = self.decompose(path, CUBE, *more)
            self.assertEqual((r["reject"], r["evenness"], r["tests"]), (None, None, []))
            words = clast("decompose", path, "--domain", CUBE, *more).out
            self.assertEqual(words.count("not tested: fewer than 5 points, nothing is rejected\n"), 1)
        self.assertRegex(clast("decompose", "--help-all").out, r"--test-only[^-]*exit code 1 when not uniform, 0\s+with\s+fewer\s+than\s+5\s+points")

    def test_points_needed_are_no_wild_guess(self):
        # "about 4.2e+07 points would do" of a sheet that 3000 resolve
        rng = random.Random(6)
        path = self.write("sheet.csv", [[rng.random(), rng.random(), rng.gauss(0.5, 0.02)] for _ in range(1000)])
        self.assertEqual(self.decompose(path, CUBE)["points_needed"], None)
        self.assertIn("how many points would do cannot be determined", clast("decompose", path, "--domain", CUBE).out)
        # --pairs told it a second time, and of other clouds with another number
        words = clast("decompose", path, "--domain", CUBE, "--pairs").out
        self.assertEqual((words.count("points would do"), words.count("; by pairs alone, ")), (1, 0))

    def test_a_bias_of_rounding_is_not_told(self):
        # one cell of a cylinder was "off by +2.2e-14 %; this is taken off"
        random.seed(4)
        points = []
        while len(points) < 3000:
            p = [random.uniform(-1, 1), random.uniform(-1, 1)]
            if math.hypot(*p) < 1:
                points.append([0.1 * p[0], 0.1 * p[1], 0.7 * random.random()])
        words = clast("decompose", self.write("pipe.csv", points), "--domain", "cylinder:10cm,70cm")
        self.assertEqual(words.code, 0, words.err)
        self.assertNotIn("this is taken off", words.out)

    def test_a_lattice_is_more_even_than_uniform(self):
        for d, m in ((2, 20), (3, 8), (3, 10)):
            path = self.write("lattice.csv", [[(c + 0.5) / m for c in p] for p in itertools.product(range(m), repeat=d)])
            domain = (SQUARE, CUBE)[d - 2]
            r = self.decompose(path, domain)
            self.assertEqual(r["evenness"], "more even")
            self.assertGreater(r["spacing"]["ratio"], 1.5)
            self.assertLess(r["spacing"]["p"], 1e-9)
            words = clast("decompose", path, "--domain", domain, "--test-only")
            self.assertEqual(words.code, 1)
            self.assertIn("more evenly spaced than uniform", words.out)
            self.assertNotIn(": uniform\n", words.out)
        self.assertEqual(self.decompose(B3, CUBE)["evenness"], "less even")
        self.assertIn("clustered or of varying density", clast("decompose", B3, "--domain", CUBE).out)
        self.assertEqual(self.decompose(U2, SQUARE)["evenness"], "uniform")

    def test_spacing_is_right_in_size(self):
        random.seed(4)
        for d in (1, 2, 3):
            p = []
            for _ in range(12):
                path = self.write("u.csv", [[random.random() for _ in range(d)] for _ in range(300)])
                spacing = self.decompose(path, "box:" + ",".join(["0"] * d + ["1"] * d), "--test-only", "--level", "1e-6")["spacing"]
                self.assertLess(abs(spacing["ratio"] - 1.0), 0.2)
                p.append(spacing["p"])
            self.assertGreater(min(p), 1e-3)
            self.assertGreater(sum(p) / 12, 0.2)

    def test_files_hold_what_the_numbers_depend_on(self):
        out = self.folder / "out"
        r = self.decompose(S2, SQUARE, "--beta-dt", "1e-6", "--mesh", "boxes", "-o", out)
        summary = json.loads((out / "summary.json").read_text())
        wanted = {"domain": "box:0,0,1,1", "domain_volume": 1.0, "domain_volume_unit": "m^2", "length_unit": "m", "beta_dt": 1e-6, "seed": None}
        for key, value in wanted.items():
            self.assertEqual(r[key], value, key)
            self.assertEqual(summary[key], value, key)
        self.assertNotIn("seed", json.loads((out / "manifest.json").read_text()))
        for name in ("cells.csv", "point_cells.csv", "thresholds.csv"):
            notes, _ = table(out / name)
            self.assertEqual(notes, ["# domain box:0,0,1,1 (m), volume 1 m^2, beta_dt 1e-06 m^2"], name)
        for name in ("cells.vtu", "points.vtp"):
            text = (out / name).read_text()
            found = {}
            for key, codes in re.findall(r'<DataArray type="UInt8" Name="(\w+)" NumberOfTuples="\d+" format="ascii">([\d ]+)</DataArray>', text):
                found[key] = "".join(chr(int(code)) for code in codes.split()[:-1])
            self.assertEqual(found, {"unit": "m", "domain": "box:0,0,1,1"}, name)
            numbers = dict(re.findall(r'<DataArray type="Float64" Name="(\w+)" NumberOfTuples="1" format="ascii">([^<]+)</DataArray>', text))
            self.assertEqual({key: float(value) for key, value in numbers.items()}, {"volume": 1.0, "beta_dt": 1e-6}, name)
        drawn = self.decompose(S2, SQUARE, "--ghost-samples", "20", "--mesh", "boxes", "--seed", "7", "-o", self.folder / "drawn")
        self.assertEqual(drawn["seed"], 7)
        self.assertEqual(json.loads((self.folder / "drawn/manifest.json").read_text())["seed"], 7)
        self.assertIn("seed 7", table(self.folder / "drawn/cells.csv")[0][0])

    def test_agglomerate_names_its_domain_and_seed_too(self):
        r = clast("agglomerate", B3, "--domain", "box:0,0,0,1m,1m,100cm", "--constant", "1e-3", "--n-step", "1", "--seed", "5", "--json")
        self.assertEqual(r.code, 0, r.err)
        self.assertEqual([r.json[key] for key in ("domain", "domain_volume", "domain_volume_unit", "length_unit", "seed")],
                         [CUBE, 1.0, "m^3", "m", 5])

    def test_equal_runs_write_equal_summaries(self):
        for command, options in (("decompose", ["--domain", CUBE]),
                                 ("agglomerate", ["--domain", CUBE, "--constant", "1e-3", "--n-step", "1"])):
            texts = []
            for k in range(2):
                out = self.folder / f"{command}{k}"
                r = clast(command, B3, *options, "-o", out, "--json")
                self.assertEqual(r.code, 0, r.err)
                self.assertIn("wall_s", r.json)
                texts.append((out / "summary.json").read_bytes())
            self.assertEqual(texts[0], texts[1])
            self.assertNotIn(b"wall_s", texts[0])


if __name__ == "__main__":
    unittest.main()
