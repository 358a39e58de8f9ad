"""CLI: clast report writes one page that stands alone."""
import json
import os
import tempfile
import unittest

from clitest import Case, clast


class Report(Case):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.run_path = os.path.join(self.folder.name, "run")
        os.mkdir(self.run_path)
        self.put("summary.json", json.dumps({"n_grain": 7, "porosity": {"hull": 0.4321}, "odd_m": 2.5e-6}))

    def put(self, name, text):
        with open(os.path.join(self.run_path, name), "w", encoding="utf-8") as file:
            file.write(text)

    def page(self, path):
        with open(path, encoding="utf-8") as file:
            return file.read()

    def test_one_run_gets_its_page_inside(self):
        result = clast("report", self.run_path, "--json")
        self.assertEqual(result.code, 0, result.err)
        self.assertEqual(result.json, {"n_run": 1, "output": os.path.join(self.run_path, "report.html")})
        page = self.page(result.json["output"])
        self.assertIn(">0.4321<", page)
        self.assertIn("2.500", page)
        self.assertNotIn("<script", page)  # no state.h5, no 3-D view, no script

    def test_an_aggregate_comes_with_charts_and_page(self):
        grown = os.path.join(self.folder.name, "grown")
        result = clast("aggregate", "--core", "sphere", "--core-size", "100um", "--coat", "sphere", "--size", "30um",
                       "--n-particle", "5", "--replicate", "5", "-q", "--picture=false", "-o", grown)
        self.assertEqual(result.code, 0, result.err)
        for name in ["history", "diameter", "density", "sizes"]:
            self.assertIn("<svg", self.page(os.path.join(grown, name + ".svg")))
        page = self.page(os.path.join(grown, "report.html"))
        for part in ["Porosity while the aggregate grows", 'class="view-data"', '"n_grain": 6,', "half-angle"]:
            self.assertIn(part, page)

    def test_two_runs_need_a_name(self):
        self.assert_fails(2, "report", self.run_path, self.run_path, says=["-o NAME.html", "2 runs"])

    def test_title_is_the_users(self):
        out = os.path.join(self.folder.name, "a.html")
        self.assertEqual(clast("report", self.run_path, self.run_path, "-o", out, "--title", "A & B").code, 0)
        self.assertIn("<h1>A &amp; B</h1>", self.page(out))

    def test_folder_without_summary_is_bad_input(self):
        os.remove(os.path.join(self.run_path, "summary.json"))
        self.assert_fails(3, "report", self.run_path, says=["has no summary.json"])

    def test_missing_folder_is_bad_input(self):
        self.assert_fails(3, "report", "no/such", says=["no/such"])

    def test_unwritable_output_leaves_no_file(self):
        self.assert_fails(4, "report", self.run_path, "-o", os.path.join(self.folder.name, "no/such/a.html"),
                          says=["no/such"])


if __name__ == "__main__":
    unittest.main()
