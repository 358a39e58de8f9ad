"""CLI: clast predict answers as its help says, and refuses in one line."""
import csv
import json
import unittest

from clitest import Case, clast

RHINE = ("--flatness", "0.647+-0.175", "--elongation", "0.682+-0.139")


class Predict(Case):
    def table(self, text):
        path = self.folder / "grains.csv"
        path.write_text(text)
        return path

    def answer(self, *arguments):
        done = clast("predict", *map(str, arguments), "--json")
        self.assertEqual(done.code, 0, done.err)
        return json.loads(done.out)

    def refusal(self, code, *arguments):
        done = clast("predict", *map(str, arguments))
        self.assertEqual(done.code, code, done.err)
        self.assertEqual(done.out, "")
        self.assertEqual(done.err.count("\n"), 1, done.err)
        return done.err

    def test_table_11(self):
        for grading, published in (("U1", 0.356), ("U7", 0.285)):
            out = self.answer(*RHINE, "--grading", grading)
            self.assertEqual(out["model"], f"form_mixture_{grading}")
            self.assertAlmostEqual(out["porosity"], published, delta=0.0098)
            self.assertTrue(out["in_range"])
            self.assertGreater(out["standard_error"], out["errors"]["model"])

    def test_table_gives_the_mixture_and_one_grain_the_single_form(self):
        many = self.answer(self.table("flatness,elongation\n0.5,0.7\n0.7,0.6\n0.6,0.8\n"))
        self.assertEqual(many["kind"], "form_mixture")
        self.assertEqual(many["inputs"]["n_grain"], 3)
        self.assertGreater(many["errors"]["sampling"], 0)
        one = self.answer(self.table("flatness,elongation\n0.5,0.7\n"))
        self.assertEqual(one["kind"], "single_form")
        self.assertAlmostEqual(one["porosity"], 0.278 + 0.019 / 0.35 + 0.014 / 0.7, places=14)

    def test_equal_grains_are_a_single_form(self):
        # "auto (mixture where the forms vary, else single)": rounding was a spread, the porosity -8.9e12
        for count in (2, 3, 67, 1000):
            path = self.table("flatness,elongation\n" + "0.3,0.9\n" * count)
            for grading, a, b, c in (("U1", 0.019, 0.014, 0.278), ("B50", 0.014, -0.006, 0.217)):
                out = self.answer(path, "--grading", grading)
                self.assertEqual(out["model"], f"single_form_{grading}")
                self.assertAlmostEqual(out["porosity"], c + a / 0.27 + b / 0.9, places=14)
                self.assertEqual((out["inputs"]["flatness_deviation"], out["inputs"]["equancy_deviation"]), (0, 0))
                self.assertNotIn("sampling", out["errors"])
        self.assertIn("spread", self.refusal(3, path, "--model", "mixture"))
        self.assertIn("flatness   0.3000 +- 0.0000\n", clast("predict", path).out)
        # one form at many sizes: its ratios differ by rounding
        path = self.table("L,I,S\n" + "".join(f"{k},{0.9 * k},{0.3 * 0.9 * k}\n" for k in (1 + 0.1 * j for j in range(60))))
        self.assertEqual(self.answer(path)["kind"], "single_form")

    def test_words_say_which_deviations_are_known(self):
        given = clast("predict", "--flatness", "0.647+-0", "--elongation", "0.682+-0").out
        self.assertIn("flatness   0.6470 +- 0.0000\nelongation 0.6820 +- 0.0000\n", given)
        self.assertNotIn("no deviations", given)
        self.assertIn("single_form_U1", given)
        self.assertIn("no deviations were given", clast("predict", "--flatness", "0.647", "--elongation", "0.682").out)
        one = clast("predict", self.table("FL,EL\n0.6,0.7\n")).out
        self.assertIn("of one grain", one)
        self.assertNotIn("no deviations", one)
        # a deviation that a program computed of equal grains
        self.assertEqual(self.answer("--flatness", "0.65+-1.1e-16", "--elongation", "0.7+-0")["kind"], "single_form")

    def test_a_bed_without_a_porosity_costs_no_other(self):
        done = clast("predict", self.table("FL,EL\n0.6,0.7\n0.05,0.05\n0.7,0.7\n"), "--each", "--json")
        self.assertEqual(done.code, 0, done.err)
        self.assertIn("1 of 3 beds have no porosity (first: row 2): model single_form_U1 gives one outside 0 to 1", done.err)
        beds = json.loads(done.out)["beds"]
        self.assertEqual([(b["row"], b["porosity"] is None, b["standard_error"] is None, b["in_range"]) for b in beds],
                         [(1, False, False, True), (2, True, True, False), (3, False, False, True)])
        self.assertIn("       2          -              -  no\n", clast("predict", self.table("FL,EL\n0.6,0.7\n0.05,0.05\n"), "--each").out)

    def test_rows_that_a_model_of_columns_leaves_out_are_kept(self):
        beds = "".join(f"{0.3 + 0.01 * k + 0.001 * (k % 3)},{k}\n" for k in range(12))
        self.assertEqual(clast("fit", self.table("porosity,a\n" + beds), "--use", "a", "-o", self.folder / "model").code, 0)
        done = clast("predict", self.table("a\n1\nnan\n300\n2\n"), "--model", self.folder / "model/model.json", "--json", "-o", self.folder / "run")
        self.assertEqual(done.code, 0, done.err)
        self.assertIn("1 of 4 rows left out", done.err)
        self.assertIn("1 of 3 beds have no porosity (first: row 3)", done.err)
        self.assertEqual(json.loads(done.out)["inputs"]["n_left_out"], 1)
        self.assertEqual((self.folder / "run/left_out.csv").read_text().split(), ["row,reason", "2,a", "cell", "is", "missing", "or", "infinite"])
        with open(self.folder / "run/prediction.csv", newline="") as file:
            self.assertEqual([row["row"] for row in csv.DictReader(file)], ["1", "3", "4"])

    def test_bad_rows_are_told_and_left_out(self):
        path = self.table("flatness,elongation\n0.5,0.7\n,0.6\n0.6,-0.8\n0.6,inf\n0.7,0.6\n")
        done = clast("predict", str(path), "--json", "-o", str(self.folder / "run"))
        self.assertEqual(done.code, 0, done.err)
        self.assertIn("3 of 5 rows left out: 1 missing, 1 infinite, 1 not positive", done.err)
        self.assertEqual(json.loads(done.out)["inputs"]["n_left_out"], 3)
        self.assertNotIn("null", done.out)
        with open(self.folder / "run/left_out.csv", newline="") as file:
            self.assertEqual([row["row"] for row in csv.DictReader(file)], ["2", "3", "4"])
        with open(self.folder / "run/prediction.csv", newline="") as file:
            self.assertEqual(len(list(csv.DictReader(file))), 1)

    def test_outside_the_range_is_named(self):
        out = self.answer("--flatness", "0.3+-0.15", "--elongation", "0.7+-0.3")
        self.assertFalse(out["in_range"])
        self.assertEqual([r["feature"] for r in out["out_of_range"]], ["mean_flatness", "deviation_elongation"])
        # L/S 8.1 of a form whose flatness and elongation are each in range; a spread that Table 2 does not have
        out = self.answer("--flatness", "0.3", "--elongation", "0.41")
        self.assertEqual([r["feature"] for r in out["out_of_range"]], ["inverse_equancy"])
        out = self.answer("--flatness", "0.6+-0.15", "--elongation", "0.6+-0.15")
        self.assertEqual([r["feature"] for r in out["out_of_range"]], ["mean_elongation"])

    def test_each_row_is_a_bed(self):
        path = self.table("L,I,S\n4,3,2\n4,4,4\n")
        out = self.answer(path, "--each", "--grading", "B50")
        self.assertEqual(len(out["beds"]), 2)
        self.assertAlmostEqual(out["beds"][1]["porosity"], 0.217 + 0.014 - 0.006, places=14)
        self.assertFalse(out["beds"][1]["in_range"])
        units = self.answer(self.table("L_mm,I_cm,S_um\n4,0.3,2000\n4,0.4,4000\n"), "--each", "--grading", "B50")  # were refused: porosity 1.058
        for one, two in zip(out["beds"], units["beds"]):
            self.assertAlmostEqual(one["porosity"], two["porosity"], places=12)

    def test_refusals(self):
        self.assertIn("table of grains", self.refusal(2))
        self.assertIn("not both", self.refusal(2, self.table("FL,EL\n0.5,0.5\n"), *RHINE))
        self.assertIn("both or none", self.refusal(2, "--flatness", "0.6+-0.1", "--elongation", "0.7"))
        self.assertIn("no mean", self.refusal(2, "--flatness", "flat", "--elongation", "0.7"))
        self.assertIn("B50", self.refusal(2, *RHINE, "--grading", "B50"))
        self.assertIn("S/I or I/L", self.refusal(3, "--flatness", "1.6", "--elongation", "0.7"))
        self.assertIn("spread", self.refusal(3, "--flatness", "0.6", "--elongation", "0.7", "--model", "mixture"))
        self.assertIn("neither", self.refusal(3, self.table("a,b\n1,2\n")))
        self.assertIn("none of its 1 rows", self.refusal(3, self.table("FL,EL\n5,2\n")))
        self.refusal(3, self.folder / "none.csv")
        self.refusal(3, *RHINE, "--model", self.folder / "none.json")

    def test_numbers_of_grains_are_not_looked_at_and_told(self):
        """102 grains in 3 rows were 3 grains, without a word."""
        for name in ("n", "count", "number", "weight", "mass_g", "Mass (kg)", "frequency"):
            path = self.table(f"flatness,elongation,{name}\n0.5,0.7,100\n0.6,0.8,1\n0.65,0.71,1\n")
            said = f"grains.csv: column '{name}' is not looked at: each row is one grain\n"
            for command in ("predict", "shape"):
                done = clast(command, path)
                self.assertEqual(done.code, 0, done.err)
                self.assertTrue(done.err.endswith(said), done.err)
            self.assertEqual(clast("predict", path, "--each").err, "")
        for text in ("flatness,elongation,n\n0.5,0.7,1\n0.6,0.8,1\n", "flatness,elongation,n_contact\n0.5,0.7,3\n0.6,0.8,1\n"):
            self.assertEqual(clast("predict", self.table(text)).err, "")

    def test_decimal_commas_are_told(self):
        path = self.table("flatness;elongation\n0,5;0,7\n")
        self.assertIn("row 1 is not a number; a decimal comma? write 0.5, not 0,5", self.refusal(3, path))
        self.assertNotIn("comma", self.refusal(3, self.table("flatness;elongation\nlow;0.7\n")))

    def test_a_term_of_coefficient_0_needs_no_value(self):
        """Grains of one elongation have no inverse deviation of it, which the printed equation of U1 has not either."""
        path = self.table("flatness,elongation\n" + "".join(f"{0.5 + 0.02 * k},0.68\n" for k in range(10)))
        out = self.answer(path)
        self.assertEqual((out["model"], out["in_range"]), ("form_mixture_U1", False))
        self.assertIn("deviation_elongation", [r["feature"] for r in out["out_of_range"]])
        said = self.refusal(3, path, "--grading", "U7")
        self.assertIn("'inverse_deviation_elongation' has no value", said)
        self.assertIn("the single-form model needs no spread", said)

    def test_words_name_model_and_error(self):
        done = clast("predict", *RHINE)
        self.assertIn("porosity   0.3558 +- 0.0062", done.out)
        self.assertIn("form_mixture_U1", done.out)

    def test_same_bytes_for_any_thread_count(self):
        path = self.table("FL,EL\n" + "".join(f"{0.4 + 0.01 * k},{0.9 - 0.007 * k}\n" for k in range(40)))
        outputs = {clast("predict", str(path), "--json", "-j", str(j)).out for j in (1, 2, 4)}
        self.assertEqual(len(outputs), 1)


if __name__ == "__main__":
    unittest.main()
