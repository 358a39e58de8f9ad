"""CLI: the first page of each command's help is short and true; --help-all and the manual page have everything, once."""
import functools
import os
import pathlib
import re
import subprocess
import unittest

from clitest import CLAST, ROOT, Case, clast



@functools.cache
def output(*arguments):
    """What the command prints, without a message, asked once: a start under sanitizers takes a quarter of a second."""
    page = clast(*arguments)
    assert (page.code, page.err) == (0, ""), (arguments, page.code, page.err)
    return page.out


COMMANDS = re.findall(r"^  (\w+(?: \w+)?)  +\S", output("--help"), re.M)
OF_EVERY_COMMAND = {"--output", "--threads", "--max-memory", "--time-limit", "--set", "--json", "--quiet", "--help", "--help-all"}
# examples that take more than some seconds with sanitizers
SLOW = {"clast aggregate examples/27sk21.yaml -o run/", "clast evolve examples/evolve/ash.yaml --duration 100s", "clast study examples/packing-study.yaml -o study/ -j 2",
        "clast pack --curve 4mm --mass 20g --width 2cm --height 9cm --shaking-time 0 --rule speed",
        "clast pack --curve U1 --shapes ellipsoid:1,0.7,0.5 --mass 0.1kg --width 60mm -o bed/", "clast bench P1 --repeats 1",
        "clast bench --json", "clast shape data/standin63/*.ply --statistics forms/",
        "clast mesh repair data/scarlet/stl/t_rex.stl -o closed.stl", "clast mesh hull data/scarlet/stl/t_rex.stl -o hull.ply",
        "clast mesh synthesize --count 3 --flatness-deviation 0.1 -o grains/"}


def completed(command):
    """Options of a command as completion offers them: one word a row of its field table."""
    text = output("completion")
    words = re.search(rf'"{command}"\\? ?\*\) words="([^"]*)"', text)[1].split()
    return [word for word in words if word not in OF_EVERY_COMMAND]


def named(page):
    """Options at the begin of a page's lines, as they are typed: --no-hull for --[no-]hull."""
    names = [name.replace("[no-]", "no-") for name in re.findall(r"^  (--[][\w-]+)", page, re.M)]
    return [name for name in names if name not in OF_EVERY_COMMAND]


def examples(page):
    return [line.strip() for line in re.search(r"^examples:\n((?:  .*\n)+)", page, re.M)[1].splitlines()]


def is_ours(example):
    """An example all of whose input files a clone has."""
    words = example.split()
    files = [word for before, word in zip(words, words[1:]) if before not in ("-o", "--statistics", ">")
             and re.search(r"\.(stl|ply|csv|vtu|yaml|json)$|^[a-z0-9]+/$", word)]
    return all(list(ROOT.glob(word)) for word in files) and "mesh:" not in example


class Help(Case):
    def test_commands_are_listed_in_one_line_each(self):
        self.assertEqual(len(COMMANDS), 26)
        for page in (clast("--help"), clast()):
            lines = (page.out or page.err).splitlines()
            self.assertLess(len(lines), 40)
            self.assertLessEqual(max(map(len, lines)), 90)
        for arguments, code in ((["mesh"], 2), (["mesh", "--help"], 0), (["mesh", "-h"], 0)):
            page = clast(*arguments)
            self.assertEqual(page.code, code)
            self.assertEqual(re.findall(r"^  clast (mesh \w+)", page.out + page.err, re.M),
                             [name for name in COMMANDS if name.startswith("mesh ")])

    def test_first_page_is_short_and_says_where_more_is(self):
        for command in COMMANDS:
            with self.subTest(command):
                page = clast(*command.split(), "-h")
                self.assertEqual((page.code, page.err), (0, ""))
                lines = page.out.splitlines()
                self.assertLessEqual(len(lines), 25)
                self.assertLessEqual(max(map(len, lines)), 90, max(lines, key=len))
                self.assertTrue(lines[0].startswith(f"usage: clast {command}"))
                self.assertEqual(lines[-1], f"more: clast {command} --help-all; man clast")
                self.assertTrue(set(named(page.out)) <= set(completed(command)))
                self.assertEqual(output(*command.split(), "--help"), page.out)

    def test_first_page_shortens_no_text_until_it_misleads(self):
        # "left out at both ends (h_pd", "true shapes {exact|spheres}": texts were cut inside of brackets, choices left out
        for command in COMMANDS:
            page = output(*command.split(), "--help-all")
            full = {name: " ".join(text.split()) for name, text in re.findall(r"^  (--\S+) ((?:.*\n)(?: {10,}.*\n)*)", page, re.M)}
            for line in re.findall(r"^  --.*", output(*command.split(), "--help"), re.M):
                with self.subTest(command, line=line):
                    for pair in ("()", "[]", "{}"):
                        self.assertEqual(line.count(pair[0]), line.count(pair[1]), line)
                    choices = re.search(r"\{[\w|-]+\|[\w|-]+\}", full[line.split()[0]])
                    if choices:
                        self.assertIn(choices[0], line)

    def test_what_a_command_does_not_take_is_refused(self):
        # -o wrote nothing, --json printed roff: options that were read and left
        for words in (["mesh", "check", ROOT / "data/standin63/grain00.ply"], ["bench", "--list"], ["man"], ["completion"]):
            self.assert_fails(2, *words, "-o", self.folder / "out", says=["writes no file: leave out -o"])
            self.assertNotIn("--output", clast(*[word for word in words if isinstance(word, str)][:2 if words[0] == "mesh" else 1],
                                               "--help-all").out)
        for word in ("man", "completion"):
            self.assert_fails(2, word, "--json", says=["is no data: leave out --json"])
        listed = clast("bench", "--list", "--json").json["scenes"]
        self.assertEqual([scene["name"] for scene in listed], [row.split()[0] for row in clast("bench", "--list").out.splitlines()])
        for command in COMMANDS:
            page = output(*command.split(), "--help-all")
            self.assertEqual("[CONFIG.yaml]" in page or "CONFIG" in page.splitlines()[0], "is a key of CONFIG.yaml" in page, command)

    def test_examples_are_three_and_their_options_exist(self):
        for command in COMMANDS:
            with self.subTest(command):
                found = examples(output(*command.split(), "--help"))
                self.assertEqual(len(set(found)), 3)
                known = set(completed(command)) | OF_EVERY_COMMAND
                for example in found:
                    self.assertIn(f"clast {command}", example)
                    for option in re.findall(r" (--[\w-]+)", example):
                        self.assertTrue(option in known or option.replace("--", "--no-", 1) in known
                                        or option.replace("--no-", "--", 1) in known, example)

    def test_all_pages_name_each_option_once_and_in_groups(self):
        manual = output("man").replace("\\-", "-")
        for command in COMMANDS:
            with self.subTest(command):
                page = output(*command.split(), "--help-all")
                self.assertEqual(named(page), completed(command))
                section = manual[manual.index(f".SS clast {command} "):].split("\n.S")[0]
                self.assertEqual([n.replace("[no-]", "no-") for n in re.findall(r"^\.B (--\S+)$", section, re.M)],
                                 completed(command))
                headings = re.findall(r"^([a-z][^\n]*):\n  --", page, re.M)
                self.assertEqual(len(headings), len(set(headings)))
                self.assertGreaterEqual(len(headings), 3 if len(completed(command)) > 20 else 0)
        for command, heading in (("aggregate", "growth"), ("pack", "contacts"), ("decompose", "tree"), ("shape", "output")):
            self.assertIn(f"\n{heading}:\n", output(command, "--help-all"))
            self.assertIn(f"\n.I {heading}\n", manual)

    def test_options_of_every_command_are_the_same_everywhere(self):
        manual = output("man").replace("\\-", "-").split(".SH COMMON OPTIONS")[1]
        self.assertEqual(set(re.findall(r"^\.B .*?(--[\w-]+)", manual, re.M)) | {"--help-all"}, OF_EVERY_COMMAND)
        for command in COMMANDS:
            page = output(*command.split(), "--help-all").split("\nof every command:\n")[1]
            words = re.search(rf'"{command}"\\? ?\*\) words="([^"]*)"', output("completion"))[1].split()
            left_out = {"--help-all"} | ({"--output"} - set(words)) | ({"--json"} - set(words))
            self.assertEqual(set(re.findall(r"^  (?:-\w, )?(--[\w-]+)", page, re.M)), OF_EVERY_COMMAND - left_out, command)
            for option in OF_EVERY_COMMAND - {"--json", "--quiet", "--help", "--help-all"}:
                self.assert_fails(2, *command.split(), option, says=[f"{option} needs a value"])

    def test_defaults_are_typed_as_people_do(self):
        for command, words in (("aggregate", ["(default 1deg)", "as 270um"]), ("pack", ["(default 104mm)", "(default 1kg)"]),
                               ("render", ["(default -55deg)"])):
            page = output(command, "--help")
            for word in words:
                self.assertIn(word, page)
        self.assertIn("(default 1/s)", " ".join(output("pack", "--help-all").split()))  # "11/s" is eleven

    def test_examples_on_bundled_data_run(self):
        for name in ("data", "examples"):
            (self.folder / name).symlink_to(ROOT / name)
        (self.folder / "bin").mkdir()
        (self.folder / "bin/clast").symlink_to(pathlib.Path(CLAST).resolve())
        n = 0
        for command in COMMANDS:
            for example in examples(output(*command.split(), "--help")):
                if example in SLOW or not is_ours(example) or command in ("man", "completion"):
                    continue
                done = subprocess.run(["bash", "-c", example], cwd=self.folder, capture_output=True, text=True, check=False,
                                      timeout=300, env={**os.environ, "PATH": f"{self.folder / 'bin'}:{os.environ['PATH']}"})
                self.assertEqual(done.returncode, 0, f"{example}: {done.stderr}")
                n += 1
        self.assertGreater(n, 20)

    def test_a_bare_length_or_angle_is_refused_with_its_spelling(self):
        for command, option, says in (("aggregate", "--core-size=270", "core_size: 270 has no unit; write 270um"),
                                      ("aggregate", "--cone=50", "cone: 50 has no unit; write 50deg"),
                                      ("aggregate", "--set=stop_size=1000", "write 1000um"),
                                      ("aggregate", "--size=20", "size: 20 has no unit"),
                                      ("pack", "--layer=1", "layer: 1 has no unit; write 1mm"),
                                      ("pack", "--width=0.1", "width: 0.1 has no unit; write 0.1m"),
                                      # the nearest spelling of a width of 104mm was 100um
                                      ("pack", "--width=100", "width: 100 has no unit; write 100mm"),
                                      ("pack", "--height=1", "height: 1 has no unit; write 1m"),
                                      ("pack", "--curve=uniform:3,5mm", "3 has no unit; write 3mm"),
                                      ("pack", "--curve=4", "4 has no unit; write 4mm"),
                                      ("grading", "--mass=-1", "mass"),
                                      ("render", "--azimuth=30", "azimuth: 30 has no unit; write 30deg"),
                                      ("agglomerate", "--monomer-radius=1e-6", "monomer_radius")):
            inputs = {"render": ["x.stl"], "agglomerate": ["x.csv"], "grading": ["U1"]}.get(command, [])
            self.assert_fails(2, command, *inputs, option, says=[says])
        path = self.folder / "run.yaml"
        path.write_text("core: sphere\ncoat: sphere\nsize: [20um, 30]\n")
        self.assert_fails(2, "aggregate", path, says=["run.yaml:3: size: 30 has no unit; write 30mm"])
        for option in ("--core-size=0", "--cone=0", "--neck=0"):  # zero needs no unit
            r = clast("aggregate", option)
            self.assertNotIn("unit", r.err)


if __name__ == "__main__":
    unittest.main()
