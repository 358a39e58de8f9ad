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
import numpy as np
from clast import _bindings, _functions

ROOT = pathlib.Path(__file__).resolve().parents[2]
SKIPPED = {  # keys of the command that the function does not have, and why
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
                    self.assertEqual(one.default, (float(row[1]) if isinstance(one.default, float) else row[1]), (name, key))  # lengths as texts
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


BOX = dict(concentration=1e12, kernel="constant", constant=1e-15, duration=1.0)
CLOUD = dict(domain="box:0,0,0,1,1,1", kernel="constant", constant=1e-5, duration="1s", n_step=1)


class Idle(unittest.TestCase):
    """A keyword that a call would not look at is refused by name, by the rules of the command."""

    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.grain = clast.Mesh.ellipsoid((3, 2, 1), 2)
        cls.file = os.path.join(cls.folder.name, "grain.stl")
        cls.grain.write(cls.file)
        cls.forms = {"flatness": [0.5, 0.6, 0.7, 0.55], "elongation": [0.6, 0.8, 0.7, 0.75]}
        cls.beds = {"porosity": [0.4, 0.41, 0.43, 0.42, 0.45, 0.44], "a": [1.0, 2, 3, 4, 5, 6], "b": [2.0, 1, 4, 3, 6, 5]}
        cls.beds = {name: np.tile(column, 3) + 0.01 * np.arange(18) * (name != "b") for name, column in cls.beds.items()}
        cls.points = np.random.default_rng(1).random((200, 3))

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def refused(self, name, why, function, /, *args, **keywords):
        with self.subTest(function=function.__name__, name=name), self.assertRaisesRegex(clast.Error, f"^{name} does nothing {why}") as caught:
            function(*args, **keywords)
        if hasattr(caught, "exception"):
            self.assertEqual(caught.exception.code, "CLAST_E_CONFIG")

    def test_models(self):
        of_two = clast.fit(self.beds, use="a,b", features="columns").model
        for keywords, name, why in ((dict(model="single_form_U1", grading="U7"), "grading", "with this model"),
                                    (dict(columns="a,b"), "columns", "without a table"), (dict(resamples=9), "resamples", "without a table"),
                                    (dict(seed=4), "seed", "without a table")):
            self.refused(name, why, clast.predict, 0.6, 0.7, **keywords)
        self.refused("grains", "with a table", clast.predict, table=self.forms, grains=55)
        self.refused("grading", "with this model", clast.predict, table=self.forms, model=clast.Model("single_form_U1"), grading="U7")
        self.refused("grading", "with this model", clast.predict_beds, self.forms, model="single_form_B50", grading="B50")
        self.refused("columns", "with a model of a table's own columns", clast.predict_beds, self.beds, model=of_two, columns="a,b")
        self.refused("n_term", "with use", clast.fit, self.beds, features="columns", use="a,b", n_term=3)
        self.refused("score", "with use", clast.fit, self.beds, features="columns", use="a,b", score="median")
        self.refused("group", "without grains", clast.fit, self.forms, features="form", group="zz")
        self.assertGreater(clast.predict(0.6, 0.7, grading="U1", seed=1, columns="", grains=0).porosity, 0.3)  # defaults are no mistakes

    def test_surfaces(self):
        largest, random = "with strategy largest", "without strategy largest"
        for keywords, name, why in ((dict(seed=4), "seed", largest), (dict(candidates=5), "candidates", largest), (dict(max_tries=3), "max_tries", largest),
                                    (dict(first_at_centre=False), "first_at_centre", largest), (dict(strategy="random", tolerance=0.1), "tolerance", random),
                                    (dict(strategy="random", min_share=0.1), "min_share", random), (dict(shrink=0.1), "shrink", "without outer"),
                                    (dict(overlap=True, tolerance=0.1), "tolerance", "with overlap")):
            self.refused(name, why, clast.fill, self.grain, spheres=2, **keywords)
        for keywords, name, why in ((dict(weld_tolerance=0.05), "weld_tolerance", "without weld within"), (dict(fill=False, fill_size=0.1), "fill_size", "with"),
                                    (dict(split=False, split_tolerance=1e-3), "split_tolerance", "with")):
            self.refused(name, why, clast.mesh_repair, self.file, **keywords)
        self.refused("weld_tolerance", "without weld within", clast.mesh_check, self.file, weld_tolerance=1e-3)
        self.refused("name", "with .ply and .off", clast.mesh_convert, self.grain, os.path.join(self.folder.name, "z.ply"), name="foo")
        self.refused("tolerance", "with measure amplitude", clast.mesh_synthesize, measure="amplitude", rough=0, tolerance=0.1)
        self.refused("decay", "with rough 0", clast.mesh_synthesize, measure="amplitude", rough=0, decay=2)
        for keywords, why in ((dict(voxel_type="u16"), "without voxels"), (dict(big_endian=True), "without voxels"), (dict(skip=12), "without voxels"),
                              (dict(level=2), "with files of these kinds"), (dict(spacing=2), "with files of these kinds"),
                              (dict(threshold=2), "with files of these kinds"), (dict(columns="L,I,S"), "with files of these kinds"),
                              (dict(degree=3, kind="surface"), "with this kind")):
            self.refused(next(iter(keywords)), why, clast.shapes, self.file, **keywords)

    def test_clouds(self):
        x, cube = self.points, "box:0,0,0,1,1,1"
        tests = "with test_only or variant test"
        for keywords, name, why in (
                (dict(regular=3), "regular", "without sizes"), (dict(test_only=True, mesh="tree"), "mesh", tests), (dict(test_only=True, beta_dt=1.0), "beta_dt", tests),
                (dict(variant="test", crossfit=True), "crossfit", tests), (dict(test_only=True, pairs=True), "pairs", tests),
                (dict(test_only=True, sizes=2), "sizes", tests), (dict(mesh="tree", lower="search"), "lower", "with cells of the tree"),
                (dict(strict=True), "strict", "with cells of the tree"), (dict(max_pass=3), "max_pass", "with cells of the tree"),
                (dict(mesh="boxes", tree_level=0.1), "tree_level", "with cells of bins"), (dict(mesh="boxes", tree_least=9), "tree_least", "with cells of bins"),
                (dict(mesh="boxes", pairs_radius=0.1), "pairs_radius", "without pairs"), (dict(variant="fast", max_pass=3), "max_pass", "with this variant"),
                (dict(variable_tolerance=1.0), "variable_tolerance", "without variable")):
            self.refused(name, why, clast.decompose, x, domain=cube, **keywords)
        with self.assertRaisesRegex(clast.Error, "^test_only is variant test: leave variant out"):
            clast.decompose(x, domain=cube, test_only=True, variant="fast")
        self.assertIsNotNone(clast.decompose(x, domain=cube, test_only=True, variant="test").reject)
        clast.decompose(x, domain=cube, variable=x[:, 0], variable_tolerance=1.0)
        for keywords, name, why in (
                (dict(leap=0.5), "leap", "without collisions poisson"), (dict(self_collisions=True), "self_collisions", "without weight"),
                (dict(change_level=0.3), "change_level", "with one snapshot"), (dict(rebuild="always"), "rebuild", "with one snapshot"),
                (dict(strict=True), "strict", "with cells of the tree")):
            self.refused(name, why, clast.agglomerate, x, **CLOUD, **keywords)
        self.refused("change_level", "with this rebuild", clast.agglomerate, x, x, **CLOUD, rebuild="always", change_level=0.3)
        for keywords, name, why in (
                (dict(solver="sectional", seed=4), "seed", "with this solver"), (dict(source_size=3), "source_size", "without source"),
                (dict(fragment_exponent=0.3), "fragment_exponent", "without breakage_rate"), (dict(leap=0.5), "leap", "without collisions poisson"),
                (dict(breakage_exponent=0.2), "breakage_exponent", "without breakage_rate"), (dict(tolerance=1e-3), "tolerance", "with this solver"),
                (dict(initial_sd=2), "initial_sd", "without initial lognormal")):
            self.refused(name, why, clast.box_model, **BOX, **keywords)

    def test_sizes_pictures_and_runs(self):
        self.refused("spread", "with sizes that are no sieve curve", clast.Grading, "4mm", spread="linear")
        self.refused("count", "with spread means", clast.Grading, "U7", spread="means", count="exact")
        made = clast.aggregate(core="sphere", core_size="20um", coat="sphere", size="5um", replicate=2, output=os.path.join(self.folder.name, "run")).run
        self.refused("field_of_view", "without projection perspective", clast.render, made, field_of_view=0.5)
        self.refused("cut_position", "without cut", clast.render, made, cut_position=0.4)
        few = dict(core="sphere", core_size="20um", coat="sphere", size="5um", replicate=2)
        for keywords, name in ((dict(printable=True), "printable"), (dict(fall_speed=True), "fall_speed")):
            self.refused(name, "without output", clast.aggregate, **few, **keywords)
        self.refused("keep", "without output", clast.evolve, domain="box:0,0,0,1mm,1mm,1mm", particles=5, curve="20um", duration="1ms", keep=3)
        out = [os.path.join(self.folder.name, name) for name in ("a.ply", "a.xyzd", "a.csv", "b.stl")]
        self.refused("level", "with points", clast.export, made, out[0], level=2, points=True)
        self.refused("level", "in a file without surfaces", clast.export, made, out[2], level=2)
        self.refused("colour", "but in a .ply", clast.export, made, out[3], colour="size")
        self.refused("density", "in a file without densities", clast.export, made, out[1], density=2000)
        self.refused("level", "with table", clast.export, made, out[2], table="history", level=2)
        self.refused("columns", "with a run, which knows its grains", clast.export, made, out[2], columns="x,y,z,d")


sys.path.insert(0, str(ROOT / "tools"))
from python_functions import FUNCTIONS  # noqa: E402

HAND = {name: __import__(f"clast.{name}", fromlist=["x"]) for name in {about[0] for about in FUNCTIONS.values()}}

if __name__ == "__main__":
    loud.main()
