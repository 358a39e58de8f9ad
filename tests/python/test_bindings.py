"""The bindings that are committed are those of this build, and ctypes lays every struct out as C does."""
import ctypes
import importlib.util
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
spec = importlib.util.spec_from_file_location("bindings", ROOT / "python/clast/_bindings.py")  # without NumPy too
bindings = importlib.util.module_from_spec(spec)
spec.loader.exec_module(bindings)


class Bindings(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.text = subprocess.run([os.environ["CLAST"], "describe", "--json"], check=True, stdout=subprocess.PIPE).stdout

    def test_the_committed_file_is_new(self):
        with tempfile.TemporaryDirectory() as folder:
            described, made = pathlib.Path(folder, "d.json"), pathlib.Path(folder, "made.py")
            described.write_bytes(self.text)
            subprocess.run([sys.executable, ROOT / "tools/make_python.py", described, made], check=True)
            for file, name in ((made, "_bindings.py"), (made.with_name("_functions.py"), "_functions.py")):
                self.assertTrue(file.read_text() == (ROOT / "python/clast" / name).read_text(), f"python/clast/{name} is old: "
                                "clast describe --json > d.json; python3 tools/make_python.py d.json python/clast/_bindings.py")

    def test_sizes_and_offsets_are_those_of_c(self):
        structs = json.loads(self.text)["structs"]
        self.assertGreater(len(structs), 150)
        for one in structs:
            made = getattr(bindings, one["name"])
            self.assertEqual(ctypes.sizeof(made), one["size"], one["name"])
            for field in one["fields"]:
                member = getattr(made, field["name"])
                self.assertEqual((member.offset, member.size), (field["offset"], field["size"]), (one["name"], field["name"]))

    def test_every_function_that_the_package_calls_has_a_prototype(self):
        known, n = {*bindings.PROTOTYPES, *(one for one in json.loads(self.text)["configurations"])}, 0
        for path in (ROOT / "python/clast").glob("*.py"):
            if path.name != "_bindings.py":
                called = set(re.findall(r'"(clast_[a-z0-9_]+)"', path.read_text()))
                self.assertEqual(called - known, set(), path.name)
                n += len(called)
        self.assertGreater(n, 100)

    def test_every_function_is_in_the_library(self):
        library = ctypes.CDLL(os.environ["CLAST_LIBRARY"])
        missing = [name for name in bindings.PROTOTYPES if not hasattr(library, name)]
        self.assertEqual(missing, [])


if __name__ == "__main__":
    unittest.main()
