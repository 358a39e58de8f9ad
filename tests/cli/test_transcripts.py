"""Each command's output, as a person sees it, is the transcript in tests/golden/transcripts; each file that it names exists.

A transcript is a terminal session: lines that begin with `$ ` are run by bash in one clean folder that has data/ and examples/
of the repository; what follows is their output, both streams. Clock times are masked as #. Only lines with `$ ` are
written by hand: CLAST_RENEW_GOLDEN=1 (make golden) writes the rest.
"""
import difflib
import os
import pathlib
import re
import subprocess
import unittest

from clitest import CLAST, ROOT, Case

TRANSCRIPTS = ROOT / "tests/golden/transcripts"
# What a clock says differs from run to run.
CLOCKS = [(re.compile(r"^(\s*time\s+)[0-9.e+-]+( m?s)", re.M), r"\1#\2"),
          (re.compile(r"^(took +)[0-9.e+-]+ s, [0-9.e+-]+ (ns a grain-step)", re.M), r"\1# s, # \2"),
          (re.compile(r"^(took +)[0-9.e+-]+ s$", re.M), r"\1# s"),
          (re.compile(r"(triangles, )[0-9.]+ s$", re.M), r"\1# s"),
          (re.compile(r"^\w[\w ]* \d+(?:/\d+ \(\d+ %\))?, [\d.e+-]+/s(?:, \d+ s left)?\n", re.M), ""),  # a minute went by
          (re.compile(r'("\w*(?:wall|cpu|contact|envelope)_s"|"ns_per_\w+"): *[0-9.e+-]+'), r"\1: #")]
FILE_NAME = re.compile(r"(?<![\w*/.])(?:[\w.-]+/)*[\w-]+\.(?:csv|svg|png|json|html|h5|stl|3mf|vtu|pvd|ply|obj|off|yaml)\b")


def sessions():
    return sorted(TRANSCRIPTS.glob("*.txt"))


class Transcripts(Case):
    def setUp(self):
        super().setUp()
        for name in ("data", "examples"):
            (self.folder / name).symlink_to(ROOT / name)
        (self.folder / ".bin").mkdir()
        (self.folder / ".bin/clast").symlink_to(pathlib.Path(CLAST).resolve())

    def shell(self, line):
        path = f"{self.folder}/.bin:{os.environ['PATH']}"
        done = subprocess.run(["bash", "-c", line], cwd=self.folder, env={**os.environ, "PATH": path, "COLUMNS": "80"},
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, stdin=subprocess.DEVNULL, text=True,
                              timeout=300, check=False)
        text = done.stdout + ("" if done.stdout.endswith("\n") or not done.stdout else "\n")
        for clock, masked in CLOCKS:
            text = clock.sub(masked, text)
        return text + (f"[exit {done.returncode}]\n" if done.returncode else "")

    def check_named_files(self, line, output):
        """Whatever looks like a file's name in the output of a command that succeeded is a file, here or beside the results."""
        folders = [self.folder, *(path for path in self.folder.glob("*") if path.is_dir() and not path.is_symlink())]
        for name in FILE_NAME.findall(output):
            self.assertTrue(any((folder / name).exists() for folder in folders), f"$ {line}\nnames {name}, which is not there")

    def play(self, path):
        """The session anew: the same commands, with what they say now."""
        told = []
        for line in [row[2:] for row in path.read_text().splitlines() if row.startswith("$ ")]:
            output = self.shell(line)
            told.append(f"$ {line}\n{output}")
            if "[exit" not in output and "--help" not in line:
                self.check_named_files(line, output)
        return "".join(told)


def test_of(path):
    def test(self):
        now = self.play(path)
        if os.environ.get("CLAST_RENEW_GOLDEN"):
            path.write_text(now)
        before = path.read_text()
        self.assertEqual(before, now, "".join(difflib.unified_diff(
            before.splitlines(True), now.splitlines(True), str(path.relative_to(ROOT)), "now")))
    return test


for session in sessions():
    setattr(Transcripts, f"test_{session.stem}", test_of(session))


class Coverage(unittest.TestCase):
    def test_every_command_has_a_transcript(self):
        commands = re.findall(r"^COMMAND\((\w+)\)", (ROOT / "cli/commands.def").read_text(), re.M)
        self.assertEqual(sorted(commands), sorted(path.stem for path in sessions()))


if __name__ == "__main__":
    unittest.main()
