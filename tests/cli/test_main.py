"""CLI: the frame itself, whatever the subcommand."""
import json
import re
import shutil
import subprocess
import unittest

from clitest import CLAST, ROOT, Case, clast


def commands():
    listing = clast("--help").out.split("commands:\n")[1].split("\n\n")[0]
    return [line[2:18].rstrip() for line in listing.splitlines() if line.strip()]


class Frame(Case):
    def test_readme_is_one_screen(self):
        lines = (ROOT / "README.md").read_text().splitlines()
        self.assertLessEqual(len(lines), 50)
        rows = [line for line in lines if line.startswith("| ")][1:]
        self.assertTrue(all("](docs/" in row for row in rows if "---" not in row))  # each claim names its page
        for page in re.findall(r"\]\(((?:docs|examples)/[^)#]*)", "\n".join(lines)):
            self.assertTrue((ROOT / page).exists(), page)

    def test_version_names_the_build(self):
        """Builds of one release with different results had one name; HDF5 was there or not without a word."""
        told = clast("--version").out
        self.assertEqual(told.split()[1], (ROOT / "VERSION").read_text().strip())
        self.assertRegex(told, r"^clast \d+\.\d+\.\d+\nsource (unknown|[0-9a-f]{12}(-dirty)?)\nwith .+\n(without .+\n)?$")
        parts = set(told.replace("without", "with").split("with ", 1)[1].replace("with ", "").replace("\n", ", ").split(", ")) - {""}
        self.assertEqual(parts, {"threads", "HDF5", "TIFF", "SUNDIALS"})

    def test_a_run_names_the_source_that_made_it(self):
        """Its manifest had the release alone, which two sources may share."""
        run = self.folder / "run"
        self.assertEqual(clast("aggregate", "--core", "sphere", "--core-size", "270um", "--coat", "sphere", "--size", "60um", "-o", run, "-q").code, 0)
        made = json.loads((run / "manifest.json").read_text())
        self.assertEqual(clast("--version").out.split("\n")[:2], ["clast " + made["clast_version"], "source " + made["clast_source"]])

    def test_no_command_is_a_usage_error(self):
        result = clast()
        self.assertEqual(result.code, 2)
        self.assertIn("usage: clast", result.err)

    def test_unknown_command_is_named(self):
        self.assert_fails(2, "comple", says=["unknown command 'comple'", "clast completion"])

    def test_first_word_alone_lists_its_commands(self):
        page = clast("mesh", "--help")
        self.assertEqual(page.code, 0)
        for verb in ("check", "repair", "hull", "simplify", "convert"):
            self.assertIn(f"clast mesh {verb}", page.out)
        alone = clast("mesh")
        self.assertEqual((alone.code, alone.out), (2, ""))
        self.assertIn("clast mesh check", alone.err)

    def test_unknown_option_names_the_nearest(self):
        self.assert_fails(2, "completion", "--shel", "bash", says=["--shel", "did you mean --shell"])
        self.assert_fails(2, "aggregate", "--core-sise", "270um", says=["did you mean --core-size?"])  # as typed; it was --core_size

    def test_wrong_choice_lists_the_choices(self):
        self.assert_fails(2, "completion", "--shell", "fish", says=["bash|zsh"])

    def test_every_command_has_a_help_page_with_its_options(self):
        for name in commands():
            page = clast(*name.split(), "--help-all")
            self.assertEqual(page.code, 0, name)
            self.assertIn(f"usage: clast {name}", page.out)
            self.assertIn("exit codes:", page.out)
            self.assertRegex(page.out, r"129/130/143 stopped by\s+SIGHUP/SIGINT/SIGTERM")

    def test_manual_names_every_command(self):
        page = clast("man").out.replace("\\-", "-")
        for name in commands():
            self.assertIn(f".SS clast {name} ", page)

    def test_bash_completion_is_valid_and_complete(self):
        script = clast("completion").out
        check = subprocess.run(["bash", "-n"], input=script, text=True, capture_output=True, check=False)
        self.assertEqual(check.returncode, 0, check.stderr)
        for name in commands():
            self.assertIn(f'"{name}"', script)
        ask = script + '\nCOMP_WORDS=(clast completion --sh); COMP_CWORD=2; _clast; echo "${COMPREPLY[@]}"'
        done = subprocess.run(["bash"], input=ask, text=True, capture_output=True, check=True)
        self.assertIn("--shell", done.stdout)

    def test_zsh_completion_is_valid(self):
        """It held a `;;&`, which bash alone has: zsh completed nothing and printed a parse error at each Tab."""
        script = clast("completion", "--shell", "zsh").out
        self.assertNotIn(";;&", script)
        if shutil.which("zsh"):
            check = subprocess.run(["zsh", "-fn"], input=script, text=True, capture_output=True, check=False)
            self.assertEqual((check.returncode, check.stderr), (0, ""))

    def test_full_disk_on_stdout_is_an_error(self):
        for words in (["man"], ["--version"], ["--help"], ["mesh", "--help"], ["pack", "--help"], ["pack", "--help-all"], ["completion"]):
            with open("/dev/full", "w", encoding="ascii") as full:
                done = subprocess.run([CLAST, *words], stdout=full, stderr=subprocess.PIPE, check=False)
            self.assertEqual(done.returncode, 4, words)
            self.assertTrue(re.search(rb"cannot write", done.stderr))


if __name__ == "__main__":
    unittest.main()
