"""CLI: what is refused names its file, and no name from outside reaches a terminal, a table or a page as it is."""
import os
import re
import shutil
import subprocess
import unittest

from clitest import CLAST, ROOT, Case, clast

WILD = b"w\xff\x1b[31m\n\xc2\x9bx"  # not UTF-8, a colour, a new line, a C1 control
CUBE = ("--domain", "box:0,0,0,1,1,1")


class Messages(Case):
    def wild(self, *words):
        """Code, stdout and stderr (bytes) of a command whose words may be bytes."""
        done = subprocess.run([CLAST, *words], cwd=self.folder, capture_output=True, check=False)
        return done.returncode, done.stdout, done.stderr

    def assert_shown(self, text):
        """UTF-8 without controls, but for the ends of lines."""
        shown = text.decode("utf-8")
        self.assertIsNone(re.search("[\x00-\x09\x0b-\x1f\x7f-\x9f]", shown), shown)

    def test_an_option_that_would_do_nothing_is_refused(self):
        grain = ROOT / "data/standin63/grain00.ply"
        (self.folder / "grains.csv").write_text("flatness,elongation\n0.6,0.7\n0.65,0.75\n0.7,0.72\n")
        shape, fill, grading = ("shape", grain), ("fill", grain, "--spheres", "2"), ("grading", "U1")
        picture = ("render", grain, "-o", self.folder / "p.png", "--width", "64", "--height", "64", "--samples", "1")
        table, means = ("predict", self.folder / "grains.csv"), ("predict", "--flatness", "0.6", "--elongation", "0.7")
        beds, model = self.folder / "beds.csv", self.folder / "model"
        beds.write_text("width,porosity\n" + "".join(f"{k},{0.3 + 0.01 * k + 0.001 * (k * k % 7)}\n" for k in range(1, 13)))
        fit = ("fit", beds)
        forms = self.folder / "forms.csv"
        forms.write_text("flatness,elongation,porosity\n" + "".join(f"{0.3 + 0.05 * k},{0.9 - 0.03 * (k * k % 7)},{0.3 + 0.01 * k}\n" for k in range(1, 13)))
        of_forms = ("fit", forms)
        self.assertEqual(clast(*fit, "-o", model).code, 0)
        by_columns = ("predict", beds, "--model", model / "model.json")
        stl, flat, points = (("export", ROOT / "data/state/schema1.h5", "-o", self.folder / name) for name in ("g.stl", "g.csv", "g.vtu"))
        pack = ("pack", "--curve", "U1", "--shapes", grain, "--mass", "1g", "--width", "40mm", "--height", "80mm", "--max-steps", "5", "-q")
        for command, option, why in (
                (shape, ("--resamples", "9"), "without --statistics"), (shape, ("--seed", "9"), "without --statistics"),
                (shape, ("--skip", "4"), "without --voxels"), (shape, ("--big-endian",), "without --voxels"),
                ((*shape, "--kind", "surface"), ("--level", "2"), "with this --kind"),
                ((*shape, "--kind", "surface"), ("--spacing", "2"), "with this --kind"),
                (shape, ("--level", "2"), "with files of these kinds"), (shape, ("--threshold", "2"), "with files of these kinds"),
                (fill, ("--candidates", "5"), "with --strategy largest"), (fill, ("--no-first-at-centre",), "with --strategy largest"),
                (fill, ("--seed", "5"), "with --strategy largest"), ((*fill, "--strategy", "random"), ("--tolerance", "0.1"), "without"),
                (fill, ("--shrink", "1"), "without --outer"), ((*fill, "--overlap"), ("--tolerance", "0.1"), "with --overlap"),
                (grading, ("--density", "2000"), "without --mass"), (grading, ("--seed", "5"), "without --sample"),
                (picture, ("--field-of-view", "1rad"), "without --projection perspective"),
                (picture, ("--cut-position", "0.2"), "without --cut"),
                (means, ("--resamples", "9"), "without a table"), (means, ("--columns", "L,I,S"), "without a table"),
                (means, ("--each",), "without a table"), (table, ("--grains", "9"), "with a table, whose rows are counted"),
                ((*table, "--each"), ("--seed", "9"), "with --each"),
                ((*means, "--model", "single_form_U1"), ("--grading", "U7"), "with this --model, which has its own"),
                (by_columns, ("--grading", "U7"), "with this --model"), (by_columns, ("--resamples", "9"), "with a model of a table's own columns"),
                ((*fit, "--use", "width"), ("--n-term", "5"), "with --use"), ((*fit, "--use", "width"), ("--score", "median"), "with --use"),
                (of_forms, ("--group", "name"), "without --grains, where beds are of one form each"),
                (stl, ("--colour", "size"), "but in a .ply"), (flat, ("--level", "2"), "in a file without surfaces"),
                ((*points, "--points"), ("--level", "2"), "with --points"),
                *(((*flat, "--table", "history"), option, "with --table") for option in (("--level", "2"), ("--colour", "size"), ("--unit", "mm")))):
            self.assert_fails(2, *command, *option, says=[f"{option[0]} does nothing {why}"])
            self.assertEqual(clast(*command).code, 0)
        self.assert_fails(2, *pack, "--rule", "speed", "--height-change", "1mm", says=["height_change does nothing with rule speed"])

    def test_a_refusal_names_the_file(self):
        bad = {"nan.csv": "x,y,z\n0.1,0.2,0.3\n0.4,nan,0.5\n", "outside.csv": "x,y,z\n0.1,0.2,0.3\n0.4,9,0.5\n", "one.csv": "x,y\n1\n",
               "empty.csv": "", "words.csv": "x,y,z\na,b,c\n"}
        for name, text in bad.items():
            (self.folder / name).write_text(text)
            for command in (("decompose",), ("agglomerate", "--constant", "1")):
                self.assert_fails(3, command[0], name, *CUBE, *command[1:], says=[name], cwd=self.folder)
        for name, text in (("bad.stl", "solid x\n facet"), ("bad.obj", "v 1 2\n"), ("bad.ply", "ply\nformat"), ("bad.off", "OFF\n1")):
            (self.folder / name).write_text(text)
            for command in (("mesh", "check"), ("shape",), ("fill",), ("render",)):
                more = ("-o", "p.png") if command[0] == "render" else ()
                self.assert_fails(3, *command, name, *more, says=[name], cwd=self.folder)
        (self.folder / "bad.yaml").write_text("curve: [[1\n")
        for command in ("pack", "aggregate", "study"):
            result = clast(command, "bad.yaml", "-o", "x", cwd=self.folder)
            self.assertIn(result.code, (2, 3))
            self.assertIn("bad.yaml", result.err)

    def test_names_are_shown_harmless(self):
        grain = WILD + b".ply"
        shutil.copy(ROOT / "data/standin63/grain00.ply", os.fsencode(self.folder) + b"/" + grain)
        for words in (("mesh", "check", grain), ("shape", grain), ("shape", grain, "--json"), ("shape", grain, grain), ("mesh", "convert", grain, "-o", WILD + b".obj"),
                      ("mesh", "hull", grain, "-o", WILD + b".stl"), ("fill", grain, "--spheres", "2"), ("shape", b"no" + grain),
                      ("render", grain, "--width", "64", "--height", "64", "-o", WILD + b".png"), ("nocommand" + "\x1b",),
                      ("shape", grain, "-o", "s.csv"), ("shape", b"--" + WILD), ("decompose", b"no" + grain, *CUBE)):
            _, out, error = self.wild(*words)
            self.assert_shown(out)
            self.assert_shown(error)
        table = (self.folder / "s.csv").read_bytes()
        self.assertIn(rb"w\xff\x1b[31m", table)
        self.assert_shown(table)

    def test_a_run_in_a_wild_folder_is_reported(self):
        code, out, error = self.wild("pack", "--curve", "6 mm", "--mass", "3g", "--width", "40mm", "--height", "0.1m", "--max-steps", "100",
                                     "-q", "-o", WILD)
        self.assertEqual(code, 0, error)
        for words in (("report", WILD), ("report", WILD, "-o", "page.html"), ("render", WILD, "--width", "64", "--height", "64", "-o", "p.png"),
                      ("export", WILD, "-o", "x.csv"), ("porosity", WILD, "--cut", "1", "-o", WILD + b"p"),
                      ("aggregate", "--core", "sphere", "--core-size", "1mm", "--coat", "sphere", "--size", "0.3mm", "--replicate", "3", "-o", WILD + b"a"),
                      ("grading", b"list:" + WILD + b"/grains.csv")):
            code, out, error = self.wild(*words)
            self.assertEqual(code, 0, error)
            self.assert_shown(out)
        (self.folder / "page.html").read_bytes().decode("utf-8")

    def test_a_failed_run_of_a_study_is_told(self):
        done = clast("study", "--run", "pack", "--config", ROOT / "examples/u1.yaml", "--seeds", "2", "--fix", "curve=nonsense", "-q", "-o",
                     self.folder / "many")
        self.assertEqual(done.code, 1)
        self.assertIn("2 of 2 runs failed", done.err)
        self.assertIn("messages.txt", done.err)


if __name__ == "__main__":
    unittest.main()
