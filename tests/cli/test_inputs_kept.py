"""CLI: no output takes the place of an input, of another output or of a run's file, whatever its spelling."""
import os
import shutil
import unittest

from clitest import ROOT, Case, clast

GRAIN = ROOT / "data/standin63/grain00.ply"
POINTS = ROOT / "data/d2sd/points_u3_n50.csv"
CURVE = "size_mm,passing_%\n1,0\n2,30\n4,80\n8,100\n"
PACK = ("--curve", "6 mm", "--mass", "12g", "--width", "40mm", "--height", "0.1m", "--max-steps", "50", "-q")


def contents(folder):
    return {str(p.relative_to(folder)): p.read_bytes() for p in folder.rglob("*") if p.is_file()}


class InputsKept(Case):
    def setUp(self):
        super().setUp()
        shutil.copy(GRAIN, self.folder / "g.ply")
        shutil.copy(POINTS, self.folder / "points.csv")
        (self.folder / "c.csv").write_text(CURVE)
        (self.folder / "bed.yaml").write_text("curve: '6 mm'\n")

    def commands(self):
        """Words with INPUT, the input's name, and the option that names the output."""
        return [(("mesh", "convert", "INPUT"), "g.ply", "-o"), (("mesh", "repair", "INPUT"), "g.ply", "-o"),
                (("mesh", "simplify", "INPUT", "--faces", "20"), "g.ply", "-o"), (("mesh", "hull", "INPUT"), "g.ply", "-o"),
                (("mesh", "form", "INPUT", "--flatness", "0.6", "--elongation", "0.7"), "g.ply", "-o"),
                (("shape", "INPUT"), "g.ply", "-o"), (("shape", "INPUT"), "g.ply", "--statistics"),
                (("shape", "INPUT"), "g.ply", "--surfaces"), (("fill", "INPUT", "--spheres", "3"), "g.ply", "-o"),
                (("fill", "INPUT", "--spheres", "3"), "g.ply", "--history"), (("render", "INPUT"), "g.ply", "-o"),
                (("grading", "INPUT", "--sample", "10"), "c.csv", "-o"),
                (("grading", "INPUT", "--sample", "10"), "c.csv", "--chart"),
                (("decompose", "INPUT", "--domain", "box:0,0,0,1,1,1"), "points.csv", "-o"),
                (("agglomerate", "INPUT", "--domain", "box:0,0,0,1,1,1"), "points.csv", "-o"),
                (("pack", *PACK, "--shapes", "INPUT"), "g.ply", "-o"), (("pack", "INPUT"), "bed.yaml", "-o"),
                (("pack", "--curve", "INPUT"), "c.csv", "-o"), (("pack", "--curve", "list:INPUT"), "c.csv", "-o"),
                (("aggregate", "--core", "INPUT", "--size", "30um"), "g.ply", "-o"),
                (("porosity", "INPUT", "--bed", "box:0,0,1,1"), "c.csv", "-o"), (("predict", "INPUT"), "c.csv", "-o"),
                (("fit", "INPUT"), "c.csv", "-o"), (("study", "--run", "pack", "--config", "INPUT"), "bed.yaml", "-o"),
                (("report", "INPUT"), "c.csv", "-o"), (("export", "INPUT"), "c.csv", "-o")]

    def test_no_spelling_of_an_input_is_an_output(self):
        before = contents(self.folder)
        for k, (words, name, option) in enumerate(self.commands()):
            given = [w.replace("INPUT", name) for w in words]
            os.link(self.folder / name, self.folder / "hard")
            os.symlink(name, self.folder / "soft")
            spellings = (name, f"./{name}", self.folder / name, f"../{self.folder.name}/{name}", "hard", "soft")
            for output in spellings if k == 0 else (spellings[k % 6], spellings[(k + 3) % 6]):  # one check, called by all
                with self.subTest(f"{' '.join(given)} {option} {output}"):
                    self.assert_fails(2, *given, option, output, says=["is the input", name], cwd=self.folder)
            os.unlink(self.folder / "hard")
            os.unlink(self.folder / "soft")
        self.assertEqual(contents(self.folder), before)

    def test_a_run_goes_into_no_folder_that_holds_its_input(self):
        shutil.copy(self.folder / "points.csv", self.folder / "cells.csv")
        before = contents(self.folder)
        for words in (("decompose", "cells.csv", "--domain", "box:0,0,0,1,1,1", "-o", "."),
                      ("shape", "g.ply", "--surfaces", self.folder), ("pack", *PACK, "--shapes", "./g.ply", "-o", "./")):
            self.assert_fails(2, *words, says=["is the folder of the input"], cwd=self.folder)
        self.assertEqual(contents(self.folder), before)

    def test_files_of_a_run_are_no_outputs(self):
        self.assertEqual(clast("pack", *PACK, "-o", "bed", cwd=self.folder).code, 0)
        before = contents(self.folder)
        for words in (("export", "bed", "--table", "history", "-o", "bed/series.csv"), ("report", "bed", "-o", "bed/summary.json"),
                      ("render", "bed", "-o", "bed/../bed/state.h5"), ("shape", "g.ply", "-o", "bed/grains.csv"),
                      ("porosity", "bed", "-o", "bed"), ("porosity", "bed", "-o", "bed", "--force"),
                      ("mesh", "convert", "g.ply", "-o", "bed/manifest.json")):
            with self.subTest(" ".join(words)):
                self.assertEqual(clast(*words, cwd=self.folder).code, 2)
        self.assertEqual(contents(self.folder), before)
        for words in (("report", "bed"), ("report", "bed", "-o", "bed/report.html"), ("export", "bed", "-o", "bed/own.csv"),
                      ("export", "bed", "-o", "bed/own.csv"), ("render", "bed", "--width", "64", "--height", "64", "-o", "bed/own.png")):
            done = clast(*words, cwd=self.folder)
            self.assertEqual(done.code, 0, done.err)

    def test_two_outputs_are_two_files(self):
        os.symlink("x.csv", self.folder / "to-x.csv")  # dangles, as x.csv is not there yet
        os.symlink(self.folder, self.folder / "here")
        for other in ("x.csv", "./x.csv", str(self.folder / "x.csv"), "here/x.csv", "to-x.csv", "here/to-x.csv"):
            with self.subTest(other):
                self.assert_fails(2, "fill", "g.ply", "--spheres", "2", "-o", "x.csv", "--history", other, says=["the same file", "x.csv"],
                                  cwd=self.folder)
        self.assertFalse((self.folder / "x.csv").exists())

    def test_a_file_that_cannot_be_written_is_told_before_the_work(self):
        """A mistyped folder was told after it: of a picture of 2000 x 2000, 32 s later. Here the input alone would end it otherwise."""
        (self.folder / "broken.ply").write_text("no surface")
        (self.folder / "file").write_text("mine")
        (self.folder / "folder.png").mkdir()
        for words in (("render", "broken.ply"), ("mesh", "repair", "broken.ply"), ("mesh", "simplify", "broken.ply", "--faces", "20"),
                      ("shape", "broken.ply"), ("fill", "broken.ply"), ("grading", "broken.ply", "--sample", "3"), ("export", "broken.ply"), ("report", "broken.ply")):
            for output, says in (("no/such/x.png", "there is no folder no/such/"), ("file/x.png", "there is no folder file/"), ("folder.png", "it is a folder")):
                self.assert_fails(4, *words, "-o", output, says=[f"cannot write {output}: {says}"], cwd=self.folder)
        for words in (("fill", "broken.ply", "--history"), ("grading", "broken.ply", "--sample", "3", "--chart")):
            self.assert_fails(4, *words, "no/such/x.csv", says=["cannot write no/such/x.csv: there is no folder no/such/"], cwd=self.folder)
        self.assert_fails(3, "render", "broken.ply", "-o", "x.png", says=["broken.ply"], cwd=self.folder)
        os.symlink("nowhere", self.folder / "dangling")
        self.assert_fails(4, "decompose", "points.csv", "--domain", "box:0,0,0,1,1,1", "-o", "dangling", says=["dangling: it is a link to what is not there"], cwd=self.folder)

    def test_an_empty_output_is_wrong_use_everywhere(self):
        listing = clast("--help").out.split("commands:\n")[1].split("\n\n")[0]
        for name in [line[2:18].rstrip() for line in listing.splitlines() if line.strip()]:
            self.assert_fails(2, *name.split(), "-o", "", says=["--output has an empty value"])
            self.assert_fails(2, *name.split(), "--output=", says=["--output has an empty value"])

    def test_links_are_followed_whether_they_dangle_or_not(self):
        os.mkdir(self.folder / "far")
        os.symlink("far/new.obj", self.folder / "link.obj")
        for _ in range(2):  # dangling, then not
            done = clast("mesh", "convert", "g.ply", "-o", "link.obj", cwd=self.folder)
            self.assertEqual(done.code, 0, done.err)
            self.assertTrue((self.folder / "link.obj").is_symlink())
            self.assertTrue((self.folder / "far/new.obj").is_file())
        os.symlink("round.obj", self.folder / "round.obj")
        self.assert_fails(4, "mesh", "convert", "g.ply", "-o", "round.obj", says=["round.obj", "circle"], cwd=self.folder)


if __name__ == "__main__":
    unittest.main()
