"""Keywords stand in the signatures with the types, defaults, units and ranges of the tables; a misspelt one is named."""
import inspect
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import timeit
import typing
import unittest

import clast
import loud
from clast import _bindings, _functions

ROOT = pathlib.Path(__file__).resolve().parents[2]
SKIPPED = {  # keys of the command that the function does not have, and why
    "mesh check": {"weld", "weld_tolerance"},  # Mesh.read(weld=...), mesh_repair(weld=...)
    "mesh synthesize": {"count", "force"},  # one grain a call: index
    "shape": {"statistics", "resamples", "seed", "force"},  # Grains.statistics
    "fill": {"name", "history"},  # Spheres.write, Spheres.history
    "porosity": {"force"},
    "fit": {"force"},
    "predict": {"each", "force"},  # predict_beds
    "decompose": {"columns", "unit", "radius_column", "diameter_column", "mass_column", "velocity_columns", "weight_column", "variable_column",
                  "dataset", "frame", "domain_unit",  # Cloud.read
                  "charts", "force"},
}
TYPES = {"number": {float}, "integer": {int}, "flag": {bool}}


def options(function):
    return inspect.signature(function).parameters


class Keywords(unittest.TestCase):
    def test_every_key_of_a_command_is_in_the_signature(self):
        for name, (module, command, tables) in FUNCTIONS.items():
            if name in ("agglomerate", "box_model", "grain_statistics", "predict_beds", "shape"):  # parts of a command; shapes has all
                continue
            missing = set(_bindings.KEYS[command]) - set(options(getattr(clast, name)))
            self.assertEqual(missing, SKIPPED.get(command, set()), name)

    def test_types_are_those_of_the_tables(self):
        n = 0
        for name, (module, command, tables) in FUNCTIONS.items():
            hints = typing.get_type_hints(getattr(clast, name), vars(_functions))
            for key, (kind, default, unit, low, high, choices, doc) in _bindings.KEYS[command].items():
                if not tables or key not in hints or key in options(getattr(HAND[module], name)):
                    continue
                parts = set(typing.get_args(hints[key])) - {type(None)}
                if kind == "choice":
                    self.assertEqual(typing.get_args(hints[key])[0], typing.Literal[tuple(choices.split("|"))], (name, key))
                elif kind in TYPES:
                    self.assertEqual(parts, TYPES[kind] | ({str} if kind == "number" and unit != "-" else set()), (name, key))
                self.assertIn(re.sub(r"(?<!\w)\|(\w+)\|(?!\w)", r"abs(\1)", doc), getattr(clast, name).__doc__)
                n += 1
        self.assertGreater(n, 300)

    def test_defaults_that_are_written_out_are_those_of_the_tables(self):
        n = 0
        for name, (module, command, tables) in FUNCTIONS.items():
            for key, one in options(getattr(clast, name)).items():
                row = _bindings.KEYS[command].get(key)
                if row is not None and one.default not in (None, one.empty):
                    self.assertEqual(one.default, (float(row[1]) if row[1] == "0" else row[1]), (name, key))  # lengths as texts
                    n += 1
        self.assertGreater(n, 15)

    def test_documents_tell_unit_range_and_default(self):
        self.assertIn("half-angle", clast.aggregate.__doc__)
        self.assertRegex(clast.pack.__doc__, r"mass: .*\(kg; 1e-15 to .*default 1.0\)|mass: .*\(kg; at least 1e-15; default 1.0\)")
        self.assertRegex(clast.fill.__doc__, r"strategy: .*\(largest, random, published; default largest\)")

    def test_a_misspelt_keyword_is_named_with_a_guess(self):
        for name in FUNCTIONS:
            function = getattr(clast, name)
            for key, one in options(function).items():
                if one.kind is one.VAR_POSITIONAL or len(key) < 5:
                    continue
                wrong = key[:-2] + key[-1] + key[-2] + "x"
                with self.assertRaisesRegex(clast.Error, f"^no keyword {wrong}; did you mean "):
                    function(**{wrong: 1})
        with self.assertRaises(clast.Error) as caught:
            clast.pack(xyzzy=1)
        self.assertEqual((caught.exception.code, str(caught.exception)), ("CLAST_E_CONFIG", "no keyword xyzzy"))

    def test_values_out_of_range_are_one_line(self):
        for use, line in ((lambda: clast.pack(mass="3 apples"), "mass.*apples"), (lambda: clast.pack(mass=-1), "mass"),
                          (lambda: clast.pack(law="hooke"), "law.*hooke"), (lambda: clast.aggregate(cone="50"), "cone.*50"),
                          (lambda: clast.aggregate(rays=2.5), "rays.*2.5"), (lambda: clast.pack(seed=-1), "seed")):
            with self.assertRaisesRegex(clast.Error, line) as caught:
                use()
            self.assertEqual(len(str(caught.exception).splitlines()), 1)

    def test_mypy_knows_the_keywords(self):
        if shutil.which("mypy") is None:
            self.skipTest(loud.LEFT_OUT + "mypy is not installed (apt install mypy)")
        good = '''import clast
bed = clast.pack(mass="3kg", law="hertz", shapes=["sphere", "ellipsoid:3,2,1"], seed=3, shaking_time=0)
print(bed["porosity"], clast.predict(0.6, (0.7, 0.1)).porosity + 1.0, clast.fit("beds.csv").model.intercept + 1.0)
cells: int = clast.decompose([[0.0, 0.0]], domain="box:0,0,1,1", mesh="tree").n_cell
'''
        with tempfile.TemporaryDirectory() as folder:
            def check(text):
                path = pathlib.Path(folder, "use.py")
                path.write_text(text)
                return subprocess.run(["mypy", "--strict", "--cache-dir", folder, path], stdout=subprocess.PIPE, text=True,
                                      env={**os.environ, "MYPYPATH": str(ROOT / "python")}).stdout
            self.assertIn("Success", check(good))
            for bad in ('clast.pack(mas="3kg")', 'clast.pack(law="hooke")', 'clast.pack(seed="one")', 'clast.aggregate(picture="no")'):
                self.assertIn("error", check("import clast\n" + bad + "\n"), bad)

    def test_a_call_costs_little_beyond_c(self):
        mesh, grading = clast.Mesh.ellipsoid((1, 1, 1), 0), clast.Grading("U3")  # 20 triangles
        for call in (lambda: mesh.volume, lambda: grading.size(0.5)):
            self.assertLess(min(timeit.repeat(call, number=1000, repeat=7)) / 1000, 10e-6)  # s

    def test_import_is_quick(self):
        with tempfile.TemporaryDirectory() as folder:
            env = {k: v for k, v in os.environ.items() if k != "PYTHONDONTWRITEBYTECODE"} | {"PYTHONPYCACHEPREFIX": folder}
            words = "import numpy, time; t = time.process_time(); import clast; print(time.process_time() - t)"
            took = [float(subprocess.run([sys.executable, "-c", words], env=env, check=True, stdout=subprocess.PIPE).stdout) for _ in range(4)]
        self.assertLess(min(took[1:]), 0.15)  # s of this process beyond NumPy's


sys.path.insert(0, str(ROOT / "tools"))
from python_functions import FUNCTIONS  # noqa: E402

HAND = {name: __import__(f"clast.{name}", fromlist=["x"]) for name in {about[0] for about in FUNCTIONS.values()}}

if __name__ == "__main__":
    loud.main()
