"""CLI: every command reads its options, and what stands before them, from a YAML file too."""
import json
import re
import unittest

from clitest import ROOT, Case, clast

POINTS = ROOT / "data/d2sd/points_b3_n500.csv"
STL = ROOT / "data/scarlet/stl/particle.stl"
GRAIN = ROOT / "data/standin63/grain00.ply"
CUBE = "box:0,0,0,1,1,1"
CLOCKS = ("wall_s", "contact_s", "envelope_s")


class Configs(Case):
    def answer(self, *words):
        r = clast(*words, "--json")
        self.assertIn(r.code, (0, 1), r.err)
        return {key: value for key, value in r.json.items() if key not in CLOCKS}

    def write(self, text):
        path = self.folder / "run.yaml"
        path.write_text(text)
        return path

    def test_an_empty_file_is_refused(self):
        """It ran the defaults without a word: 1 kg of U1."""
        for text in ("", "\n\n", "# mass: 1g\n"):
            self.assert_fails(2, "pack", self.write(text), says=("run.yaml: empty; expected lines of the form 'key: value'",))

    def test_a_second_document_is_refused(self):
        """It was dropped unread, whatever it said."""
        said = "a second document; a file is one configuration"
        bed = "curve: 4mm\nmass: 1g\nmax_steps: 1\n"
        for text, line in ((f"---\n{bed}---\nfriction: 0.3\n", "6:1: " + said), (f"{bed}...\nnonsense: 4\n", "run.yaml:5:"),
                           (f"{bed}---\n---\n4\n", "6:1: " + said), (f"{bed}---\n{{{{{{ not yaml\n", "did not find expected"),
                           (f"{bed}...\n---\n[1]", "6:1: " + said), (f"---\n---\n{bed}", "expected lines of the form 'key: value'")):
            self.assert_fails(2, "pack", self.write(text), says=("run.yaml:", line))
        for end in ("---\n", "...\n", "---\n# mass: 2g\n", "...\n---\n", "---\n---\n...\n"):
            r = clast("pack", self.write("---\n" + bed + end), "--quiet", "-j", 1)
            self.assertEqual(r.code, 0, (end, r.err))

    def test_a_value_with_a_nul_is_refused(self):
        """What stood behind it was dropped: "4mm\\0x" was 4mm."""
        for text, says in (('curve: "4mm\\0x"\nmax_steps: 1\n', "run.yaml:1:8: curve: a NUL"), ('shapes: [sphere, "sphere\\0:3"]\n', "run.yaml:1:18: shapes: a NUL"),
                           ('"mass\\0x": 1g\n', "run.yaml:1:1: a key must be a plain word")):
            self.assert_fails(2, "pack", self.write(text), says=(says,))

    def test_a_file_says_what_the_command_line_says(self):
        (self.folder / "forms.csv").write_text("flatness,elongation\n0.6,0.7\n0.65,0.68\n0.7,0.72\n")
        forms = self.folder / "forms.csv"
        fit = self.folder / "beds.csv"
        fit.write_text("porosity,a\n" + "".join(f"{0.3 + 0.01 * k + 0.001 * (k % 3)},{k}\n" for k in range(12)))
        for command, positional, key, options in (
                ("decompose", [POINTS], "points", {"domain": CUBE, "votes": 3, "mesh": "tree"}),
                ("agglomerate", [POINTS], "points", {"domain": CUBE, "constant": "1e-3", "n_step": 2}),
                ("shape", [GRAIN], "file", {"unit": "mm"}),
                ("fill", [GRAIN], "file", {"spheres": 20}),
                ("predict", [forms], "table", {"grading": "U7"}),
                ("fit", [fit], "table", {"target": "porosity"}),
                ("grading", ["U7"], "curve", {"mass": "16kg"}),
                ("mesh check", [STL], "file", {"weld": "off"})):
            with self.subTest(command):
                words = [w for name, value in options.items() for w in ("--" + name.replace("_", "-"), str(value))]
                wanted = self.answer(*command.split(), *positional, *words)
                listed = "".join(f"{name}: {value}\n" for name, value in options.items())
                path = self.write(f"{key}: {positional[0]}\n{listed}")
                self.assertEqual(self.answer(*command.split(), path), wanted)
                self.write(f"{key}: [{positional[0]}]\n{listed}")
                self.assertEqual(self.answer(*command.split(), path), wanted)
                self.write(listed)
                self.assertEqual(self.answer(*command.split(), path, *positional), wanted)

    def test_options_and_arguments_win_over_the_file(self):
        path = self.write(f"points: none.csv\ndomain: {CUBE}\nvotes: 5\n")
        r = self.answer("decompose", path, POINTS, "--votes", "1")
        self.assertEqual(r, self.answer("decompose", POINTS, "--domain", CUBE, "--votes", "1"))

    def test_a_file_after_a_switch_is_read(self):
        # `clast decompose --quiet run.yaml` took no notice of the file
        path = self.write(f"points: {POINTS}\ndomain: {CUBE}\n")
        for switch in ("--quiet", "-q", "--crossfit"):
            r = clast("decompose", switch, path, "--json")
            self.assertEqual(r.code, 0, r.err)
            self.assertEqual(r.json["n"], 500)
        r = clast("aggregate", "--quiet", self.write("corr: sphere\n"))
        self.assertEqual(r.code, 2)
        self.assertIn("unknown key 'corr'", r.err)

    def test_what_is_wrong_names_the_line(self):
        path = self.write(f"points: {POINTS}\n\ndomian: {CUBE}\n")
        self.assert_fails(2, "decompose", path, says=[f"{path}:3", "unknown key 'domian'", "did you mean 'domain'"])
        path.write_text(f"points: [{POINTS}, {POINTS}]\ndomain: {CUBE}\n")
        self.assert_fails(2, "decompose", path, says=["too many arguments"])
        path.write_text(f"domain: {CUBE}\n")
        self.assert_fails(2, "decompose", path, says=["missing POINTS"])

    def test_the_manifest_names_points_of_the_file_as_input(self):
        out = self.folder / "out"
        r = clast("decompose", self.write(f"points: {POINTS}\ndomain: {CUBE}\n"), "-o", out)
        self.assertEqual(r.code, 0, r.err)
        manifest = json.loads((out / "manifest.json").read_text())
        self.assertIn(str(POINTS), json.dumps(manifest["inputs"]))

    def test_help_names_the_file_and_its_key_where_there_is_one(self):
        commands = re.findall(r"^  (\w+(?: \w+)?)  +\S", clast("--help").out, re.M)
        self.assertGreater(len(commands), 20)
        for command in commands:
            with self.subTest(command):
                page = clast(*command.split(), "--help-all").out
                if "\n  --" not in page.split("\nof every command:")[0]:
                    self.assertNotIn("yaml", page.split("\n")[0].lower())
                    self.assertNotIn("a key of CONFIG.yaml", page)
                    continue
                self.assertIn("[CONFIG.yaml]", page.split("\n")[0])
                self.assertIn("Every option but those of every command is a key of CONFIG.yaml", page)
        self.assertIn("POINTS is its key points", clast("decompose", "--help-all").out)
        self.assertIn("FILE is its key file", clast("mesh", "repair", "--help-all").out)


if __name__ == "__main__":
    unittest.main()
