"""Runs the built command for the tests in tests/cli (CLAST names it)."""
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
CLAST = os.environ.get("CLAST", str(ROOT / "build/dev/clast"))
WITHOUT_HDF5 = os.environ.get("CLAST_HAVE_HDF5", "1") == "0"
skips = WITHOUT_HDF5  # a test that meets what needs HDF5


class Result:
    def __init__(self, done):
        self.code, self.out, self.err = done.returncode, done.stdout, done.stderr

    @property
    def json(self):
        return json.loads(self.out)


def clast(*arguments, cwd=None, stdin=None, timeout=300, env=None):
    """Runs `clast ARGUMENTS` and returns code, out, err (texts) and json (parsed stdout)."""
    done = subprocess.run([CLAST, *map(str, arguments)], cwd=cwd, input=stdin, timeout=timeout, text=True,
                          capture_output=True, check=False, env={**os.environ, **(env or {})})
    if skips and "built without HDF5" in done.stderr:
        print(f"SKIPPED LOUDLY: clast {arguments[0]}: this clast is built without HDF5; this test did not end")
        raise unittest.SkipTest("built without HDF5")
    return Result(done)


def preload(folder, source):
    """Environment in which the C functions of `source` take the place of the C library's; skips loudly without a compiler."""
    if shutil.which("cc") is None or not sys.platform.startswith("linux"):
        print("SKIPPED LOUDLY: no cc, or no Linux: what a library in between shows was not tried")
        raise unittest.SkipTest("no cc")
    (folder / "between.c").write_text("#define _GNU_SOURCE 1\n" + source)
    subprocess.run(["cc", "-shared", "-fPIC", "-o", folder / "between.so", folder / "between.c", "-ldl"], check=True)
    return {"LD_PRELOAD": f"{os.environ.get('LD_PRELOAD', '')} {folder / 'between.so'}".strip(),
            "ASAN_OPTIONS": f"{os.environ.get('ASAN_OPTIONS', '')}:verify_asan_link_order=0".strip(":")}


class Case(unittest.TestCase):
    """A test case with a scratch folder `self.folder` and a check for one-line errors."""

    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)

    def assert_fails(self, code, *arguments, says=(), **options):
        """The command ends with `code`, says one line on stderr that holds each of `says`, and nothing on stdout."""
        result = clast(*arguments, **options)
        self.assertEqual(result.code, code, result.err)
        self.assertEqual(result.err.count("\n"), 1, result.err)
        for text in says:
            self.assertIn(text, result.err)
        self.assertEqual(result.out, "")
        return result


def shared(name):
    """Path in ../shared/data, or None after saying loudly that the check is skipped."""
    path = ROOT.parent / "shared/data" / name
    if not path.exists():
        print(f"SKIPPED LOUDLY: {path} is not here; this check did not run")
        return None
    return path
