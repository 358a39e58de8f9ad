"""CLI: clast grading tells numbers from masses, sizes at shares, and draws that follow them."""
import csv
import json
import math
import unittest

from clitest import Case, clast


class Grading(Case):
    def test_published_curve_has_the_papers_numbers(self):
        got = clast("grading", "U3", "--mass", "16 kg", "--json").json
        low = got["classes"][2]
        self.assertAlmostEqual(low["mean"], 1e-3 * math.sqrt(5.6 * 8), places=15)
        count = 0.21 * 16 / (2650 * math.pi / 6 * low["mean"] ** 3)  # eq. 9
        self.assertAlmostEqual(low["count"] / count, 1, places=13)
        self.assertAlmostEqual(got["curve_by_mass"]["d50"], 1e-3 * math.sqrt(8 * 11.2), places=15)
        counts = [c["count"] for c in got["classes"]]
        self.assertAlmostEqual(low["number"], low["count"] / sum(counts), places=13)

    def test_drawn_sizes_are_kept_and_compared(self):
        out = self.folder / "sizes.csv"
        got = clast("grading", "U7", "--sample", "5000", "--seed", "3", "-o", out, "--json").json
        with open(out, newline="", encoding="utf-8") as file:
            sizes = [float(row["diameter_m"]) for row in csv.DictReader(file)]
        self.assertEqual(len(sizes), 5000)
        self.assertTrue(all(2.8e-3 <= d <= 31.5e-3 for d in sizes))
        self.assertLess(got["distance_number"], 2.7 / math.sqrt(5000))  # KS at level 1e-6
        inside = sum(2.8e-3 <= d < 4e-3 for d in sizes) / 5000
        self.assertAlmostEqual(got["classes"][0]["achieved_number"], inside, places=12)
        again = clast("grading", "U7", "--sample", "5000", "--seed", "3", "--json").json
        self.assertEqual(got, again)
        other = clast("grading", "U7", "--sample", "5000", "--seed", "4", "--json").json
        self.assertNotEqual(got["achieved_d50"], other["achieved_d50"])

    def grades(self, prefix, text):
        path = self.folder / "list.csv"
        path.write_text(text)
        return ("grading", f"{prefix}:{path}", "--json")

    def test_columns_of_masses_and_counts_are_known_by_name_and_unit(self):
        rows = "10,10\n20,40\n40,80\n"
        for name in ("mass", "mass_g", "Mass (kg)", "retained_g", "mass [mg]", "mass [ g ]", "weight", "frequency", "wt%", "mass_fraction"):
            got = clast(*self.grades("masses", f"size_um,{name}\n{rows}"))
            self.assertEqual(got.code, 0, got.err)
            self.assertAlmostEqual(got.json["drawn_by_mass"]["d10"] / 20e-6, 1, 12, name)
            self.assertAlmostEqual(got.json["drawn_by_mass"]["d50"] / 40e-6, 1, 12, name)
        for name in ("count", "n_grains", "Number of grains", "frequency", "n"):
            got = clast(*self.grades("list", f"size_um,{name}\n{rows}"))
            self.assertEqual(got.code, 0, got.err)
            self.assertAlmostEqual(got.json["drawn_by_number"]["d50"] / 40e-6, 1, 12, name)
        both = "size_um,count,mass_g\n10,1,8\n20,1,1\n"
        self.assertAlmostEqual(clast(*self.grades("masses", both)).json["drawn_by_mass"]["d50"] / 10e-6, 1, 12)
        self.assertAlmostEqual(clast(*self.grades("list", both)).json["drawn_by_number"]["d90"] / 20e-6, 1, 12)

    def test_sizes_of_lists_and_curves_have_the_units_of_their_names(self):
        """size_ft and "size (inches)" were no units of a list, sieve_in none of a curve, "size [ mm ]" none of either."""
        def d50(name, passing=(0, 1)):
            curve = self.folder / "curve.csv"
            curve.write_text(f"{name},passing\n1,{passing[0]}\n2,{passing[1]}\n")
            got = clast(*self.grades("list", f"{name},count\n1,1\n2,1\n")), clast("grading", curve, "--json")
            self.assertEqual([g.code for g in got], [0, 0], (name, got[0].err, got[1].err))
            return got[0].json["drawn_by_number"]["d50"], got[1].json["curve_by_mass"]["d50"]

        wanted = d50("size_mm")
        for name, metre in (("size [ mm ]", 1e-3), ("sieve_in", 0.0254), ("Sieve (in)", 0.0254), ("size_um:0", 1e-6), ("diameter (mm) mean", 1e-3),
                            ("Size (mean) (mm)", 1e-3), ("phi_mm", 1e-3)):
            for a, b in zip(d50(name), wanted):
                self.assertAlmostEqual(a / b / (metre / 1e-3), 1, 12, name)
        self.assertEqual(d50("Phi", (1, 0)), d50("size [phi]", (1, 0)))
        for name in ("size_ft", "size (inches)", "sieve (ft)", "Size (MM)", "size (m/s)", "diameter ft"):
            file = self.folder / "curve.csv"
            file.write_text(f"{name},passing\n1,0\n2,1\n")
            for command in (("grading", file), self.grades("list", f"{name},frequency\n1,1\n2,1\n"), self.grades("masses", f"{name},frequency\n1,1\n2,1\n")):
                self.assert_fails(3, *command, says=(f"column '{name}' is in no unit of length that is read here", "convert or rename it"))

    def test_masses_are_no_counts_and_counts_no_masses(self):
        rows = "10,10\n20,40\n"
        for prefix, head, says in (("masses", "size_um,count", ("'count'", "not masses", "list:")), ("list", "size_um,mass_g", ("'mass_g'", "masses:")),
                                   ("masses", "phi,n_grains", ("'n_grains'", "list:")), ("list", "size_um,retained", ("'retained'", "masses:")),
                                   ("masses", "size_um,mass_mm", ("no column of masses", "size_um, mass_mm")),
                                   ("list", "size_um,heaviness", ("'heaviness' is not understood",))):
            self.assert_fails(2, *self.grades(prefix, f"{head}\n{rows}"), says=says)
        self.assert_fails(2, *self.grades("masses", "size_um\n10\n20\n"), says=("no column of masses",))

    def test_phi_is_its_own_unit_and_1_mm_is_phi_0(self):
        path = self.folder / "phi.csv"
        path.write_text("phi,count\n0,10\n1,40\n")
        got = clast("grading", f"list:{path}", "--json")
        self.assertAlmostEqual(got.json["drawn_by_number"]["d50"] / 0.5e-3, 1, 12)
        for curve in (f"list:{path}", "1mm"):
            words = clast("grading", curve).out
            self.assertIn("phi  0.000", words)
            self.assertNotIn("-0.000", words)
        path.write_text("d,count\n4,10\n")
        self.assert_fails(2, "grading", f"list:{path}", says=("end the column's name in it",))
        self.assertNotIn("size_unit", clast("grading", f"list:{path}").err)

    def test_measured_sizes_are_set_beside_a_curve(self):
        out = self.folder / "sizes.csv"
        drawn = clast("grading", "U7", "--sample", "2000", "-o", out, "--json").json
        got = clast("grading", "U7", "--compare", out, "--json").json
        self.assertEqual(got["n_sample"], 2000)
        self.assertAlmostEqual(got["distance_mass"], drawn["distance_mass"], places=14)
        wrong = clast("grading", "U1", "--compare", out, "--json").json
        self.assertGreater(wrong["distance_mass"], 0.3)
        self.assertIn("2000 grains compared", clast("grading", "U1", "--compare", out).out)
        self.assert_fails(2, "grading", "U1", "--compare", out, "--sample", "5", says=["take one"])
        self.assert_fails(2, "grading", "6 mm", "--compare", out, says=["no sieve curve"])
        out.write_text("low_mm,high_mm,count\n1,2,3\n")
        self.assert_fails(3, "grading", "U1", "--compare", out, says=["one row for each grain"])

    def test_distances_fall_to_the_law_that_is_drawn_from(self):
        """By mass the draws were held against the sheet's curve, from which their law is 0.13 away, by number against the law."""
        got = clast("grading", "U1", "--sample", "200000", "--json").json
        self.assertLess(got["distance_number"], 0.005)
        self.assertLess(got["distance_mass"], 0.01)
        self.assertAlmostEqual(got["distance_curve"], 0.1324, delta=0.005)
        self.assertEqual((got["n_below"], got["n_above"], got["mass_outside"]), (0, 0, 0))
        words = clast("grading", "U1", "--sample", "1000").out
        self.assertIn(" drawn: farthest from the law to draw by ", words)
        self.assertNotIn("outside", words)

    def test_linear_counts_are_those_of_its_law(self):
        """Of the law that is drawn the table had the numbers, of equation 9 the grains: 1060.7 in all for 940.7."""
        got = clast("grading", "U3", "--spread", "linear", "--mass", "1kg", "--json").json
        self.assertAlmostEqual(sum(c["count"] for c in got["classes"]), got["n_expected"], places=9)
        for c in got["classes"]:
            self.assertAlmostEqual(c["count"], c["number"] * got["n_expected"], places=9)

    def test_grains_outside_all_classes_are_told(self):
        """The classes held 0.001 of the mass, and nothing said where the rest was."""
        sizes = self.folder / "out.csv"
        sizes.write_text("size_mm\n50\n60\n7\n1\n")
        got = clast("grading", "U3", "--compare", sizes, "--json").json
        self.assertEqual((got["n_below"], got["n_above"]), (1, 2))
        self.assertAlmostEqual(got["mass_outside"], 1 - 7**3 / (50**3 + 60**3 + 7**3 + 1), places=14)
        self.assertIn("  3 of 4 lie outside all classes: 1 below, 2 above, 0.9990 of the mass\n", clast("grading", "U3", "--compare", sizes).out)

    def test_a_sieve_curve_is_no_list(self):
        """masses: made 24879 grains a kg, as large as the sieve that they stayed on, where the curve has 9767; list: sent there."""
        file = self.folder / "sieve.csv"
        for head in ("sieve_mm,retained_g", "Sieve opening (mm),Retained (g)", "opening_mm,mass_retained", "retained,sieve_mm"):
            rows = [("8", "0"), ("5.6", "30"), ("4", "50"), ("2", "20")]
            file.write_text(head + "\n" + "".join(",".join(row if head.startswith(("s", "S", "o")) else row[::-1]) + "\n" for row in rows))
            for prefix in ("masses", "list"):
                self.assert_fails(2, *self.grades(prefix, file.read_text()), says=("are a sieve curve", f"give the file without {prefix}:"))
        self.assertAlmostEqual(clast("grading", file, "--mass", "1kg", "--json").json["n_expected"], 9767, delta=1)
        for head in ("phi,mass_g", "Phi,retained_g"):  # was a list of the sizes that are the sieves', 1.4 times too small
            self.assert_fails(2, *self.grades("masses", head + "\n3,0\n4,10\n5,20\n"), says=("are a sieve curve", "give the file without masses:"))
        self.assertEqual(clast(*self.grades("list", "sieve_mm,count\n1,2\n2,3\n")).code, 0)
        self.assert_fails(2, "aggregate", "--core", "sphere", "--core-size", "1mm", "--coat", "sphere", "--sizes", file, "-o", self.folder / "run",
                          says=("are a sieve curve", "give the ends of each class (low_mm, high_mm)"))

    def test_a_table_of_shape_is_a_list_of_sieve_sizes(self):
        """Its 71 columns were more than 64, and D_m was not known as a size; its last cells may be empty."""
        forms, table = self.folder / "forms.csv", self.folder / "table.csv"
        forms.write_text("L_mm,I_mm,S_mm\n12,8,6\n9,7,5\n7,6,6\n")
        self.assertEqual(clast("shape", forms, "-o", table).code, 0)
        with open(table, newline="", encoding="utf-8") as file:
            sizes = sorted(float(row["D_m"]) for row in csv.DictReader(file))
        got = clast("grading", "U3", "--compare", table, "--json")
        self.assertEqual(got.code, 0, got.err)
        self.assertEqual((got.json["n_sample"], got.json["achieved_d90"]), (3, sizes[2]))
        self.assertAlmostEqual(clast("grading", f"list:{table}", "--json").json["drawn_by_number"]["d50"] / sizes[1], 1, 12)
        self.assertAlmostEqual(clast(*self.grades("list", "id,D (mm)\n1,4\n2,4\n")).json["high"], 4e-3, 12)
        self.assertAlmostEqual(clast(*self.grades("list", "D_mm,size_mm,n\n1,4,1\n2,4,2\n")).json["low"], 4e-3, 12)
        self.assert_fails(3, *self.grades("list", "id,D_mm,note\n1,,\n"), says=("list.csv:2: '' is not a number",))

    def test_a_users_curve_is_read_and_shown(self):
        file = self.folder / "river.csv"
        file.write_text("phi,passing (%)\n-1,0\n-2,25\n-3,100\n")
        result = clast("grading", file, "--spread", "linear")
        self.assertEqual(result.code, 0, result.err)
        self.assertIn("0.7500", result.out)
        self.assertIn("D50", result.out)

    def test_grains_of_a_class_are_those_of_the_count(self):
        """--count exact printed the grains of equation 9: 57.7 and 47.6 beside "10 g hold 100.6 grains"."""
        file = self.folder / "sieve.csv"
        file.write_text("sieve_mm,retained\n2,0\n2.8,30\n4,70\n5.6,0\n")
        for curve, mass in ((file, 10e-3), ("B50", 1.0)):
            exact = clast("grading", curve, "--mass", f"{mass}kg", "--count", "exact", "--json").json
            for one in exact["classes"]:
                a = 3 * math.log(one["high"] / one["low"])
                count = one["mass"] * mass / (2650 * math.pi / 6 * one["mean"] ** 3 * math.sinh(a / 2) / (a / 2))
                self.assertAlmostEqual(one["count"], count, delta=1e-12 * count)
            self.assertAlmostEqual(sum(one["count"] for one in exact["classes"]), exact["n_expected"], 9)
            mean = clast("grading", curve, "--mass", f"{mass}kg", "--json").json
            for one in mean["classes"]:
                self.assertAlmostEqual(one["count"] * 2650 * math.pi / 6 * one["mean"] ** 3, one["mass"] * mass, 12)  # eq. 9
        out = clast("grading", file, "--mass", "10g", "--count", "exact").out
        self.assertEqual([float(line.split()[-1]) for line in out.splitlines()[3:5]], [55.0, 45.6])

    def test_cumulative_columns_are_read_as_such(self):
        """They were taken for the masses of single sieves: 0.588 and 0.412 for 0.3 and 0.7."""
        file = self.folder / "sieve.csv"
        for name in ("retained cumulative", "retained_cumulative_pct", "cumulative_retained", "cum. retained"):
            file.write_text(f"sieve_mm,{name}\n4,0\n2,70\n1,100\n")
            got = clast("grading", file, "--json")
            self.assertEqual(got.code, 0, got.err)
            self.assertAlmostEqual(got.json["classes"][1]["mass"], 0.7, 14, name)
            self.assertAlmostEqual(got.json["curve_by_mass"]["d50"], 2e-3 * 2 ** (2 / 7), 15)  # 2.438 mm
        file.write_text("sieve_mm,mass above\n4,0\n2,70\n1,100\n")
        self.assert_fails(3, "grading", file, says=["'above' is not understood", "cumulative retained"])

    def test_percent_and_shares_are_all_of_it(self):
        """Retained percents were scaled to 100 from any sum: 95 with the pan forgotten, 200 of cumulative ones; passing 99.9 was refused."""
        file = self.folder / "sheet.csv"
        for name, values, total in (("retained_%", (0, 60, 90, 50), "200, not 100"), ("pct retained", (0, 30, 40, 25), "95, not 100"),
                                    ("retained_share", (0, .1, .2, .1), "0.4, not 1"), ("mass_fraction", (0, 30, 40, 25), "95, not 1")):
            file.write_text(f"sieve_mm,{name}\n" + "".join(f"{d},{v}\n" for d, v in zip((16, 8, 4, 2), values)))
            self.assert_fails(3, "grading", file, says=(f"column '{name}' sums to {total}", "pan"))
        masses = []
        for name, values in (("retained_%", (0, 29.9, 40, 30)), ("cumulative retained_%", (0, 29.9, 69.9, 99.9)), ("passing_%", (99.9, 70, 30, 0)),
                             ("retained_g", (0, 59.8, 80, 60)), ("retained", (0, 59.8, 80, 60)), ("fraction", (0, .299, .4, .3))):
            file.write_text(f"sieve_mm,{name}\n" + "".join(f"{d},{v}\n" for d, v in zip((16, 8, 4, 2), values)))
            got = clast("grading", file, "--json")
            self.assertEqual(got.code, 0, got.err)
            masses.append([one["mass"] for one in got.json["classes"]])
        for other in masses[1:]:
            for a, b in zip(masses[0], other):
                self.assertAlmostEqual(a, b, 12)
        file.write_text("sieve_mm,passing_%\n8,98.9\n4,30\n2,0\n")
        self.assert_fails(3, "grading", file, says=("98.9 of 100 pass the largest sieve",))

    def test_ends_of_a_bin_have_their_own_units(self):
        """low_mm,high_cm: both in mm, bins of 1 to 2 and 2 to 4 mm for 1 to 20 and 20 to 40."""
        one = clast(*self.grades("list", "low_mm,high_cm,count\n1,2,5\n20,4,7\n")).json
        two = clast(*self.grades("list", "low_mm,high_mm,count\n1,20,5\n20,40,7\n")).json
        self.assertEqual(one["drawn_by_number"], two["drawn_by_number"])
        self.assertEqual(clast(*self.grades("list", "low_mm,high,count\n1,20,5\n20,40,7\n")).json["drawn_by_number"], two["drawn_by_number"])
        self.assert_fails(2, *self.grades("list", "low_mm,high_cm,count\n1,2,5\n2,4,7\n"), says=("overlap",))
        self.assert_fails(3, *self.grades("list", "low_cm,high_mm,count\n1,2,5\n"), says=("size low, 1 cm, is above high, 2 mm",))

    def test_a_list_tells_what_it_counted(self):
        """Running numbers were counts, and columns that say counts in words of their own were left out, both without a line."""
        rows = "".join(f"{k},{20 - 0.1 * k}\n" for k in range(1, 41))
        for text, words, told in ((f"number,size_mm\n{rows}", "  40 rows, counted by column 'number': 820 in all\n", (40, "number", 820, "")),
                                  (f"id,size_mm\n{rows}", "  40 rows, one grain a row; not looked at: id\n", (40, "", 40, "id")),
                                  ("size_mm,nr,who\n10,300,a\n5,2,b\n", "  2 rows, one grain a row; not looked at: nr, who\n", (2, "", 2, "nr, who")),
                                  ("size_mm,count,density_kg/m^3\n10,3,2650\n5,2,2650\n", "  2 rows, counted by column 'count': 5 in all\n", (2, "count", 5, ""))):
            asked = self.grades("list", text)
            self.assertIn(words, clast(*asked[:-1]).out)
            found = clast(*asked).json["list"]
            self.assertEqual((found["n_row"], found["column"], found["total"], found["ignored"]), told)
        self.assertIn("  2 rows, weighed by column 'mass_g': 5 in all; not looked at: count\n",
                      clast(*self.grades("masses", "size_mm,count,mass_g\n10,1,3\n5,2,2\n")[:-1]).out)
        self.assertNotIn("list", clast("grading", "U3", "--json").json)

    def test_runs_tell_what_their_list_counted(self):
        """pack, evolve and aggregate read the same lists without a word."""
        sizes, beds, run = self.folder / "um.csv", self.folder / "mm.csv", self.folder / "run"
        for path in (sizes, beds):
            path.write_text(f"id,size_{path.stem},count\n1,4,2\n2,5,1\n")
        told = "2 rows, counted by column 'count': 3 in all; not looked at: id"
        evolve = ("evolve", "--particles", 9, "--domain", "box:0,0,0,1m,1m,1m", "--kernel", "constant", "--constant", "1e-9", "--duration", "1s", "--curve")
        for words, name in ((("pack", "--mass", "1g", "--width", "20mm", "--height", "60mm", "--max-steps", 5, "--curve"), f"list:{beds}"),
                            (evolve, f"list:{sizes}"),
                            (("aggregate", "--core", "sphere", "--core-size", "270um", "--coat", "sphere", "--sizes"), str(sizes))):
            found = clast(*words, name, "-o", run, "--force")
            self.assertEqual(found.code, 0, found.err)
            self.assertIn(f"{name}: {told}\n", found.err)
            self.assertEqual(json.loads((run / "manifest.json").read_text())["sizes"], told)
            self.assertEqual(clast(*words, name, "--quiet").err, "")
        plain = self.folder / "plain.csv"  # sizes alone: nothing to tell
        plain.write_text("size_um\n4\n5\n")
        self.assertNotIn("rows", clast(*evolve, f"list:{plain}").err)

    def test_words_in_quotes_are_words(self):
        """Column '"count"' was not understood."""
        plain = clast(*self.grades("list", "size_mm,count\n10,3\n5,2\n")).json
        for text in ('"size_mm","count"\n10,3\n5,2\n', '"size_mm";"count"\r\n"10";"3"\r\n"5";"2"\r\n', '"size_mm" "count"\n10 3\n5 2\n',
                     '"size, as ""sieved"" (mm)",count # "none\n10,3\n5,2\n'):
            got = clast(*self.grades("list", text))
            self.assertEqual(got.code, 0, got.err)
            self.assertEqual(got.json["drawn_by_number"], plain["drawn_by_number"])
        for text in ('"size_mm,count\n10,3\n', '"size_mm"x,count\n10,3\n'):
            self.assert_fails(3, *self.grades("list", text), says=(":1: ", "quote"))

    def test_laws_need_no_classes(self):
        got = clast("grading", "lognormal:8mm,2mm", "--mass", "1", "--json").json
        self.assertNotIn("classes", got)
        cube = 8e-3**3 * math.exp(3 * math.log(1 + 1 / 16))
        self.assertAlmostEqual(got["mean_cube"] / cube, 1, places=12)
        self.assertAlmostEqual(got["n_expected"] * 2650 * math.pi / 6 * cube, 1, places=12)

    def test_options_without_effect_are_refused(self):
        """Each was taken, and the numbers were those without it."""
        lists = {name: self.folder / f"{name}.csv" for name in ("count", "mass")}
        for name, path in lists.items():
            path.write_text(f"size_mm,{name}\n1,3\n2,4\n")
        for law in ("lognormal:5mm,1mm", "uniform:1mm,2mm", "11 mm", f"list:{lists['count']}", f"masses:{lists['mass']}"):
            for option, value in (("--spread", "linear"), ("--count", "exact")):
                self.assert_fails(2, "grading", law, option, value, says=(f"{option} does nothing with sizes that are no sieve curve",))
        self.assert_fails(2, "grading", "U3", "--spread", "means", "--count", "exact", says=("--count does nothing with --spread means",))

    def test_drawn_sizes_are_in_the_format_that_the_ending_names(self):
        """It was CSV under any name."""
        drawn = self.folder / "drawn.json"
        self.assertEqual(clast("grading", "U3", "--sample", 5, "-o", drawn).code, 0)
        (column,) = json.loads(drawn.read_text())["columns"]
        self.assertEqual((column["name"], len(column["values"])), ("diameter_m", 5))
        for name in ("drawn.txt", "drawn"):
            self.assert_fails(2, "grading", "U3", "--sample", 5, "-o", self.folder / name, says=("a table is written as .csv or .json",))
            self.assertFalse((self.folder / name).exists())

    def test_decimal_commas_are_guessed(self):
        path = self.folder / "comma.csv"
        path.write_text("Sieve size (mm);Passing (%)\n2;0\n2,8;30\n4;70\n5,6;100\n")
        self.assert_fails(3, "grading", path, says=["row 2 holds '2,8'", "a decimal comma? write 0.5, not 0,5"])

    def test_sizes_to_draw_are_not_called_drawn(self):
        out = clast("grading", "U3").out
        self.assertIn("to draw, by mass", out)
        self.assertNotIn("drawn", out)

    def test_bad_input_is_one_line(self):
        file = self.folder / "bad.csv"
        file.write_text("sieve_mm,passing\n1,0\n2,60\n3,50\n4,100\n")
        self.assert_fails(3, "grading", file, says=["row 3", "less than the 60"])
        file.write_text("sieve_mm,mass\n1,-1\n2,0\n")
        self.assert_fails(3, "grading", file, says=["row 1"])
        self.assert_fails(3, "grading", "U9", says=["U1, U3"])
        self.assert_fails(2, "grading", "U1", "--spread", "linear", "--count", "exact", says=["linear"])
        self.assert_fails(2, "grading", "U1", "-o", file, says=["--sample"])
        self.assert_fails(2, "grading", "uniform:2mm", says=["uniform:LOW,HIGH"])

    def test_chart_draws_wanted_and_achieved(self):
        chart = self.folder / "sieve.svg"
        out = clast("grading", "U7", "--sample", 2000, "--chart", chart)
        self.assertEqual(out.code, 0, out.err)
        text = chart.read_text()
        self.assertTrue(text.startswith("<?xml"))
        self.assertGreater(text.count("<path"), 20)
        self.assert_fails(2, "grading", "U7", "--chart", chart, says=("--sample N or --compare FILE",))
        self.assert_fails(2, "grading", "uniform:1mm,2mm", "--sample", 5, "--chart", chart, says=("no sieve curve",))


if __name__ == "__main__":
    unittest.main()
