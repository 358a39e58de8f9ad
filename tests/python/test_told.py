"""What users are told: warnings of the command, refusals in one line with the key's name, words of Python and not of the shell.

Found by someone who used the package from a notebook for the first time.
"""
import inspect
import os
import pathlib
import re
import subprocess
import tempfile
import unittest
import warnings

import numpy as np

import clast
from clast import _bindings as c
from clast._core import call

ROOT = pathlib.Path(__file__).resolve().parents[2]
GRAIN = ROOT / "data/standin63/grain00.ply"
X = np.random.default_rng(7).random((400, 3))
BOX = "box:0,0,0,1,1,1"
FOLDER = tempfile.TemporaryDirectory()
BED = pathlib.Path(FOLDER.name, "bed")
AGGREGATE = {"core": "sphere", "core_size": 270e-6, "coat": "sphere", "size": "30um", "replicate": 5, "picture": False}
PACK = {"curve": "4mm", "mass": "0.5g", "width": "30mm", "height": "0.1m", "shaking_time": 0, "max_steps": 2000}
LATTICE = pathlib.Path(FOLDER.name, "lattice.csv")
LATTICE.write_text("x_mm,y_mm,z_mm,d_mm\n" + "".join(f"{i},{j},{k + 0.5},1\n" for i in range(3) for j in range(3) for k in range(6)))
FORMS = {"flatness": np.linspace(0.4, 0.8, 9), "elongation": np.linspace(0.7, 0.5, 9) ** 2 + 0.3}
with warnings.catch_warnings():
    warnings.simplefilter("ignore")
    clast.pack(**PACK, output=BED)


class Case(unittest.TestCase):
    def refused(self, line, use):
        with self.assertRaisesRegex(clast.Error, line) as caught:
            use()
        self.assertEqual(len(str(caught.exception).splitlines()), 1)

    def said(self, *words):
        done = subprocess.run([os.environ["CLAST"], *map(str, words)], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, cwd=FOLDER.name, text=True)
        return " ".join(done.stdout.split())

    def heard(self, use):
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            use()
        return [str(one.message) for one in caught]


CUBE = [[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)]
FACETS = [[0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1], [2, 3, 7], [2, 7, 6], [0, 2, 6], [0, 6, 4], [1, 5, 7], [1, 7, 3]]


class Surfaces(Case):
    def test_facets_written_twice(self):
        """Volume 2 and convexity 2 of a cube, in silence."""
        twice = clast.Mesh(CUBE, FACETS + FACETS)
        found = twice.check()
        self.assertEqual((found.n_repeated, found.n_body), (12, 1))
        self.assertRegex("; ".join(self.heard(twice.shape)), "^the surface: 12 of its triangles repeat another with the same winding; .*; mesh_repair drops")
        self.assertTrue(np.isnan(clast.mesh_hull(twice).added_volume))

    def test_several_bodies(self):
        two = clast.Mesh(CUBE + [[x + 5, y, z] for x, y, z in CUBE], FACETS + [[8 + corner for corner in facet] for facet in FACETS])
        self.assertRegex("; ".join(self.heard(two.shape)), "^the surface is 2 bodies that do not hang together")
        path = pathlib.Path(FOLDER.name, "two.ply")
        two.write(path)
        self.assertEqual(len(self.heard(lambda: clast.shape(path))), 1)
        self.assertIn("clast mesh repair --keep largest keeps one", self.heard(lambda: clast.shapes(path))[0])  # as it is typed

    def test_closed_pores_are_no_form(self):
        """Their walls counted in area and sphericity."""
        ball = clast.Mesh.ellipsoid((1, 1, 1))
        n = len(ball.vertices)
        grain = clast.Mesh(np.vstack([ball.vertices, 0.8 * ball.vertices]), np.vstack([ball.triangles, n + ball.triangles[:, ::-1]])).shape()
        self.assertAlmostEqual(grain.sphericity, ball.shape().sphericity, places=12)
        self.assertAlmostEqual(grain.pore_volume / ball.volume, 0.512, places=12)
        self.assertAlmostEqual(grain.volume + grain.pore_volume, ball.volume, places=12)

    def test_a_sheet_is_told(self):
        """Of `clast shape` alone."""
        sheet = clast.Mesh(CUBE + [[3, 0, 0], [4, 0, 0], [3, 1, 0]], FACETS + [[8, 9, 10], [10, 9, 8]])
        self.assertRegex("; ".join(self.heard(sheet.shape)), r"1 of its 2 parts has no volume \(the two sides of a sheet\)")

    def test_a_file_of_ours_says_its_unit(self):
        """unit="mm" took a file of micrometres for millimetres."""
        path, out = pathlib.Path(FOLDER.name, "um.ply"), pathlib.Path(FOLDER.name, "mm.ply")
        clast.mesh_convert(clast.Mesh(CUBE, FACETS), path, unit="um")
        self.refused("it is in um, not in mm", lambda: clast.mesh_convert(path, out, unit="mm"))
        self.assertEqual(clast.mesh_convert(path, out, out_unit="mm").factor, 1e-6 / 1e-3)

    def test_cuts_that_were_not_looked_for(self):
        """Two lenses of 20000 triangles that cut each other: n_intersection 0, and no word."""
        n, k = 5000, np.arange(5000)
        ring = np.column_stack([np.cos(2 * np.pi * k / n), np.sin(2 * np.pi * k / n), 0 * k])
        lens, after = np.vstack([ring, [0, 0, 1], [0, 0, -1]]), (k + 1) % n
        facets = np.vstack([np.column_stack([k, after, 0 * k + n]), np.column_stack([after, k, 0 * k + n + 1])])
        dense = clast.Mesh(np.vstack([lens, lens + [0, 0, 0.1]]), np.vstack([facets, facets + n + 2])).check()
        self.assertEqual((dense.n_intersection, dense.intersection_complete), (0, False))
        self.assertIn("was not looked for", dense.doubles)

    def test_a_vertex_that_strays(self):
        """The centroid went with it: "is vertex 0 at (0, 0, 0) an error?", it was asked."""
        far = np.array(CUBE, float)
        far[3, 1] = 1e300
        self.refused("is vertex 3 at ", lambda: clast.fill(clast.Mesh(far, FACETS), spheres=2))


class Porosity(Case):
    def test_a_run_knows_its_contacts(self):
        """Coordination came of the pairs within `gap`, directions of the run's own contacts: two sets in one table."""
        self.refused("^gap: .*knows its contacts", lambda: clast.porosity(BED, cut=0.95, gap="0.1mm"))

    def test_what_cannot_be_is_refused_before_the_work(self):
        """Chains were refused when all else had been measured, and so told of the bed first, as contacts of a sheared box still were."""
        self.refused("^chains: .*this bed knows none", lambda: clast.porosity(LATTICE, bed="cylinder:0.01mm", chains=True))
        self.refused("^bed: contacts across .* leave out gap", lambda: clast.porosity(LATTICE, bed="periodic:0mm,0mm,0mm,1mm,1mm,1mm,0.5mm", gap="1um"))

    def test_a_run_knows_its_floor(self):
        self.refused("^floor: .*bed", lambda: clast.porosity(BED, cut=0.95, floor="1mm"))
        low = clast.porosity(BED, cut=0.95, bed="cylinder:15mm", floor="-1mm").z_low
        self.assertEqual(low, -1e-3)

    def test_an_assembly_knows_its_grains(self):
        grains = clast.Assembly.read_spheres(LATTICE)
        for keys in (dict(columns="x,y,z,d"), dict(diameter="1mm")):
            self.refused("^columns, diameter: ", lambda: clast.porosity(grains, bed="periodic:0mm,0mm,3mm,3mm", **keys))


class Values(Case):
    def test_lengths_are_those_of_the_grains(self):
        """`scales` was a radius of spheres that were read and a diameter of a run's."""
        self.assertTrue(np.allclose(clast.Assembly.read_spheres(LATTICE).lengths, 1e-3, rtol=1e-12))
        made = clast.aggregate(**AGGREGATE, output=os.path.join(FOLDER.name, "lengths")).run.grains
        self.assertTrue(np.allclose(made.lengths, np.r_[270e-6, np.full(len(made) - 1, 30e-6)], rtol=1e-9))

    def test_what_is_not_known_is_no_difference(self):
        for make in (lambda: clast.predict(0.6, 0.7), lambda: clast.shape(GRAIN), lambda: clast.Mesh.ellipsoid((1, 1, 1), 1).shape()):
            self.assertEqual((make(), hash(make())), (make(), hash(make())))
        self.assertNotEqual(clast.predict(0.6, 0.7), clast.predict(0.6, 0.71))

    def test_a_model_cannot_be_changed(self):
        model = clast.Model("single_form_U1")
        for of in (model.coefficients, model.ranges):
            with self.assertRaises(TypeError):
                of[next(iter(of))] = 0.0

    def test_pictures_are_png(self):
        picture = clast.render(clast.Assembly.read_spheres(LATTICE), width=64, height=64, samples=1)
        self.refused("^path: .*x.jpg: a picture is written as .png", lambda: picture.write(os.path.join(FOLDER.name, "x.jpg")))
        picture.write(os.path.join(FOLDER.name, "x.PNG"))

    def test_points_are_a_mesh_without_triangles(self):
        self.assertEqual(clast.Mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1.0]], []).triangles.shape, (0, 3))

    def test_odd_values_are_named(self):
        mesh = clast.Mesh.ellipsoid((1, 1, 1), 2)
        mesh.vertices[5] = np.nan
        self.refused("^vertex 5 of 162 is not finite", lambda: clast.mesh_simplify(mesh, 20))
        self.refused("^text: nan m is no size", lambda: clast.Grading(float("nan")))
        forms = np.rec.fromarrays([np.array(["2024-01-01", "2024-01-02"], "M8[D]"), [0.5, 0.6], [0.7, 0.8]], names="day,flatness,elongation")
        self.assertEqual(len(clast.predict_beds(forms)), 2)

        class Frame(dict):
            columns = ["spheres"]
        self.refused("^vary: a table; give a dictionary", lambda: clast.study(run="fill", argument=str(GRAIN), vary=Frame(), output=os.path.join(FOLDER.name, "s")))

    def test_units_survive_a_file(self):
        path = os.path.join(FOLDER.name, "units.csv")
        pathlib.Path(path).write_text("density_1/m,number_1/m3,moment_1_m5\n1,2,3\n")
        self.assertEqual(list(clast.read_table(path).units.values()), ["1/m", "1/m3", "m5"])

    def test_more_numbers_of_the_command(self):
        found = clast.fill(clast.Mesh.read(GRAIN), spheres=5)
        self.assertTrue(found.bound > 0 and 0 < found.deviation_mean < found.deviation_max and found.n_protruding == 0)
        cells = clast.decompose(X, domain=BOX, mesh="boxes", events="paper")
        self.assertTrue(cells.bias_estimate > 0 and (cells.points_per_bin > 0) == (len(cells.cells) > 1))


class Warnings(Case):
    def test_evolve_beyond_its_drag_law(self):
        keys = dict(domain="box:0,0,0,10mm,10mm,10mm", particles=5, curve="200um", duration="1ms", fall="stokes")
        told = self.said("evolve", *(word for key, value in keys.items() for word in (f"--{key}", value)))
        line = re.search(r"Reynolds number of the fastest fall .*? drag law", told)[0]
        self.assertEqual([one[:len(line)] for one in self.heard(lambda: clast.evolve(**keys))], [line])

    def test_evolve_above_a_floor_that_reflects(self):
        keys = {"domain": "box:0,0,0,0.1,0.1,0.1", "curve": "20um", "particles": 100, "kernel": "constant", "constant": 1e-9, "duration": "10s"}
        [told] = self.heard(lambda: clast.evolve(floor="reflect", **keys))
        self.assertRegex(told, r"^100 % of the mass comes to a floor that reflects .* take floor='deposit' or shorter steps$")
        self.assertEqual(self.heard(lambda: clast.evolve(**keys)), [])

    def test_a_bed_heavier_than_asked_for(self):
        keys = {**PACK, "mass": "1mg"}
        told = self.said("pack", *(word for key, value in keys.items() for word in (f"--{key.replace('_', '-')}", "0s" if value == 0 else value)))
        line = re.search(r"[0-9.]+ times the mass that was asked for: [^;]*;", told)[0]
        self.assertEqual([one[:len(line)] for one in self.heard(lambda: clast.pack(**keys)) if "times the mass" in one], [line])

    def test_aggregates_packed_at_another_density(self):
        run = os.path.join(FOLDER.name, "aggregate")
        clast.aggregate(**AGGREGATE, core_density=2500, coat_density=2500, output=run)
        keys = dict(shapes=run + "/state.h5", curve="1mm", mass="10mg", width="20mm", height="20mm", max_steps=5, shaking_time=0)
        with self.assertLogs("clast", "INFO") as caught:
            self.heard(lambda: clast.pack(**keys))
        self.assertRegex(" ".join(caught.output), "aggregates of 2500 kg/m.3 are packed at 2650 kg/m.3: density=0 keeps their own")

    def test_a_result_that_no_run_has(self):
        keys = dict(run="fill", argument=ROOT / "data/scarlet/stl/Menger2.stl", vary={"spheres": [2]}, keep=["nonsense", "filled_fraction"])
        heard = self.heard(lambda: clast.study(**keys, output=os.path.join(FOLDER.name, "study")))
        self.assertEqual(heard, ["keep: 'nonsense': no run's result has such a number"])

    def test_a_model_of_one_form(self):
        with self.assertLogs("clast", "INFO") as caught:
            clast.predict((0.65, 0.1), (0.7, 0.1), model="single")
        self.assertIn("a single-form model at the mean form: it leaves the spread of the forms out", caught.output[0])
        with self.assertNoLogs("clast", "INFO"):
            clast.predict(0.65, 0.7, model="single")

    def test_numbers_of_grains_are_not_looked_at(self):
        table = {"flatness": [0.5, 0.6, 0.65], "elongation": [0.7, 0.8, 0.71], "n": [100, 1, 1]}
        said = ["column 'n' is not looked at: each row is one grain"]
        self.assertEqual(self.heard(lambda: clast.predict(table=table)), said)
        self.assertEqual(self.heard(lambda: clast.grain_statistics(table)), said)
        self.assertEqual(self.heard(lambda: clast.predict_beds(table, model="single")), [])
        path = pathlib.Path(FOLDER.name, "counted.csv")
        path.write_text("flatness,elongation,n\n0.5,0.7,100\n0.6,0.8,1\n")
        self.assertEqual(self.heard(lambda: clast.shapes(path)), [f"{path}: {said[0]}"])

    def test_a_mask_has_no_grey_levels(self):
        mask = np.zeros((12, 12, 12), np.uint8)
        mask[3:9, 3:9, 3:9] = 200
        pathlib.Path(FOLDER.name, "mask.raw").write_bytes(mask.tobytes())
        told = self.said("shape", "mask.raw", "--kind", "voxels", "--voxels", "12,12,12", "--threshold", 100)
        line = re.search("1 of 1 grains are of a mask.*labels' are", told)[0].replace("--", "")
        with self.assertLogs("clast", "INFO") as caught:
            clast.shapes(os.path.join(FOLDER.name, "mask.raw"), kind="voxels", voxels=(12, 12, 12), threshold=100)
        self.assertIn(line, caught.output[0])

    def test_grains_that_cannot_be_measured(self):
        """A misspelt name was an empty table, and a mean of 62 of 63 grains said nothing."""
        self.refused("nope.ply", lambda: clast.shapes("nope.ply"))
        heard = self.heard(lambda: self.assertEqual(len(clast.shapes("nope.ply", GRAIN)), 1))
        self.assertEqual(len(heard), 1)
        self.assertRegex(heard[0], "^1 file or grain could not be measured .first: .*nope.ply")


class Words(Case):
    def test_a_bare_number_is_told_with_its_unit(self):
        """"30 is outside [-90 deg, 90 deg]" read as if the package could not count."""
        for keys, line in ((dict(elevation=30), r"^elevation: 30 rad is outside \[-90 deg, 90 deg\]; write 30deg"),
                           (dict(azimuth=45), r"^azimuth: 45 rad is .*; write 45deg"), (dict(elevation="2rad"), r"^elevation: 2rad is outside"),
                           (dict(elevation="100deg"), r"^elevation: 100deg is outside \[-90 deg, 90 deg\]$"), (dict(width=1), r"^width: 1 is outside"),
                           (dict(elevation=200), r"^elevation: 200 rad is outside \[-90 deg, 90 deg\]$")):
            self.refused(line, lambda: clast.render(BED, **keys))
        self.refused("^mass: -1 kg is outside", lambda: clast.pack(mass=-1))
        self.refused("^density: -5 kg/m3 is outside", lambda: clast.pack(density="-5 kg/m3"))

    def test_options_are_keywords(self):
        self.refused("outside drop|outside='drop'", lambda: clast.decompose(X * 1.2, domain=BOX))
        self.refused("replace it with force$", lambda: clast.pack(**PACK, output=BED))
        self.refused("concentration$", clast.box_model)
        for use in (lambda: clast.decompose(X * 1.2, domain=BOX), lambda: clast.pack(**PACK, output=BED), clast.box_model,
                    lambda: clast.fit({"x": [1.0, 2.0]}, features="columns")):
            with self.assertRaisesRegex(clast.Error, "^(?!.*--).*$"):
                use()

    def test_a_grain_has_its_number(self):
        for member, value in (("positions", np.nan), ("orientations", 2.0), ("scales", -1.0)):
            grains = clast.Assembly.read(BED)
            getattr(grains, member)[2] = value
            for use in (lambda: clast.render(grains, width=64), lambda: grains.write(os.path.join(FOLDER.name, "x.vtu")), grains._copy):
                self.refused(f"^assembly: grain 3 of {len(grains)}: ", use)

    def test_a_number_is_metres_where_a_size_is_a_text(self):
        self.assertEqual(clast.Grading(0.004).size(0.5), clast.Grading("4mm").size(0.5))
        self.assertEqual(clast.Grading(np.float32(0.5)).size(0.5), 0.5)
        keys = dict(mass="0.2g", width="30mm", height="0.1m", max_steps=10, shaking_time=0)
        self.assertEqual(clast.pack(**keys, curve=4e-3)["n_grain"], clast.pack(**keys, curve="4mm")["n_grain"])
        study = clast.study(run="pack", fix={**keys, "max_steps": 2000}, vary={"curve": [3e-3, "4mm"]}, seeds=1, output=os.path.join(FOLDER.name, "sizes"))
        self.assertEqual((study.n_done, study.n_failed), (2, 0))
        for bad in ({}, [1, 2], float("nan")):
            self.refused("^text: |nan", lambda: clast.Grading(bad))
            self.refused("^curve: |nan", lambda: clast.pack(**keys, curve=bad))

    def test_a_bar_parts_values(self):
        self.refused("^shapes: .*has a |", lambda: clast.study(run="pack", vary={"shapes": ["a|b", "c"]}, output=os.path.join(FOLDER.name, "x")))

    def test_what_is_no_path_model_or_word_is_named(self):
        fit = clast.fit({"x": np.arange(40.0), "porosity": 0.3 + 0.001 * np.arange(40.0) + 0.01 * np.sin(np.arange(40.0) ** 2)}, features="columns", n_term=1,
                        n_permutation=0)
        for line, use in (("^resume: a bool", lambda: clast.pack(resume=True)), ("^resume: a dict", lambda: clast.aggregate(resume={})), ("^resume: a ndarray", lambda: clast.pack(resume=X)),
                          ("^resume: a bool", lambda: clast.evolve(resume=True)), ("call predict_beds", lambda: clast.predict(table=FORMS, model=fit)),
                          ("^model: a dict", lambda: clast.predict(0.6, 0.7, model={})), ("^model: a int", lambda: clast.predict_beds(FORMS, model=3)),
                          ("^solver: ", lambda: clast.box_model(solver=["a", "b"])), ("^solver: ", lambda: clast.box_model(solver={})),
                          ("^bed: takes one value", lambda: clast.porosity(LATTICE, bed=X)), ("^unit: takes one value", lambda: clast.shapes(GRAIN, unit=X)),
                          ("^name: a int", lambda: clast.open(BED).table(3)), ("^axes: ", lambda: clast.shape(GRAIN, axes=X[:3])),
                          ("^columns: a ndarray", lambda: clast.Assembly.read_spheres(LATTICE, columns=X)),
                          ("^columns: a int", lambda: clast.Cloud.read(LATTICE, columns=3)), ("^output: a bool", lambda: clast.pack(**PACK, output=True)),
                          ("^density: 0.0 lies", lambda: clast.Grading("U1").n_expected(1, density=0)),
                          ("^mass: -1.0 lies", lambda: clast.Grading("U1").n_expected(-1)),
                          ("^grain_volume: 0.0 lies", lambda: clast.Grading("U1").n_expected(1, grain_volume=0))):
            self.refused(line, use)
        self.assertEqual(len(clast.predict_beds({"x": [3.0]}, model=fit)), 1)
        self.assertEqual(clast.porosity(clast.open(BED), cut=0.95).porosity, clast.porosity(BED, cut=0.95).porosity)  # a run is its folder

    def test_none_is_the_default(self):
        points = os.path.join(FOLDER.name, "points.csv")
        np.savetxt(points, X, delimiter=",", header="x,y,z", comments="")
        self.assertEqual(len(clast.Cloud.read(points, unit=None, columns=None, velocity_columns=None)), 400)
        self.assertEqual(len(clast.Assembly.read_spheres(LATTICE, columns=None)), 54)
        self.assertEqual(list(clast.Grading("U1").draw(3, seed=None)), list(clast.Grading("U1").draw(3)))
        self.assertEqual(clast.Mesh.read(GRAIN, weld=None).volume, clast.Mesh.read(GRAIN).volume)

    def test_three_mf_is_of_mesh_convert(self):
        mesh = clast.Mesh.read(GRAIN)
        self.refused("mesh_convert", lambda: mesh.write(os.path.join(FOLDER.name, "x.3mf")))

    def test_documents_say_what_can_be_interrupted(self):
        page = re.sub(r"\s+", " ", (ROOT / "docs/python.md").read_text())
        stoppable = [name for name in clast._functions.__all__ if "progress" in inspect.signature(getattr(clast, name)).parameters]
        self.assertIn(f"Ctrl-C ends {', '.join(f'`{name}`' for name in sorted(stoppable))}", page)
        for name in ("decompose", "fit"):
            self.assertIn("cannot be interrupted", getattr(clast, name).__doc__, name)


class Results(Case):
    def test_a_result_is_a_mapping(self):
        found = clast.aggregate(**AGGREGATE)
        self.assertEqual(("density" in found, "nothing" in found), (True, False))
        self.assertEqual((list(found), dict(found)), (list(found.values), found.values))
        self.assertLessEqual({"density", "run", "folder"}, set(dir(found)))
        self.assertIn("mass", dir(clast.Cloud(X, mass=np.ones(400))))

    def test_a_folder_is_found_from_elsewhere(self):
        before = os.getcwd()
        try:
            os.chdir(FOLDER.name)
            for made in (clast.aggregate(**AGGREGATE, output="here"), clast.study(run="fill", argument=GRAIN, vary={"spheres": [2]}, output="many"), clast.open("here")):
                os.chdir("/")
                self.assertTrue(os.path.isdir(made.folder), made.folder)
                os.chdir(FOLDER.name)
        finally:
            os.chdir(before)

    def test_what_is_shown_says_what_it_is(self):
        run = clast.open(BED)
        self.assertEqual(repr(run), f"<clast.Run of pack in {BED}>")
        self.assertEqual(repr(run.grains), f"<clast.Assembly of {len(run.grains)} grains, m>")
        self.assertEqual(repr(clast.Cloud(X, mass=np.ones(400))), "<clast.Cloud of 400 points in 3 dimensions with mass>")
        self.assertEqual(repr(clast.Grading("4mm")), "<clast.Grading 4mm>")
        self.assertEqual(repr(clast.Model("single_form_U1")), "<clast.Model single_form_U1>")
        self.assertRegex(repr(run.grains.view()), "^<clast.View of [0-9]+ kB>$")

    def test_cross_fitting_can_be_read(self):
        keys = dict(domain=BOX, crossfit=True)
        x = X**2
        found = clast.decompose(x, **keys, beta_dt=1e-6)
        self.assertGreater(found.events_cross, 0)
        self.assertTrue(np.isnan(found.pair_integral_cross))
        self.assertAlmostEqual(clast.decompose(x, **keys).pair_integral_cross * 1e-6 / found.events_cross, 1)
        self.assertTrue(np.isnan(clast.decompose(x, domain=BOX).pair_integral_cross))

    def test_repeated_points_are_those_that_were_decomposed(self):
        x = X.copy()
        x[:60] = x[0]
        found = clast.decompose(x, domain=BOX)
        self.assertEqual(found.n_repeated, 59)
        x[:] = X
        self.assertEqual(found.n_repeated, 59)

    def test_copies_have_no_number_of_events(self):
        """decompose gave nan and said nothing, agglomerate some hundred times too many events."""
        x = np.repeat(X[:100], 4, axis=0)
        line = "so many points are duplicates (coincident points), where no density is defined; leave copies out"
        with self.assertWarnsRegex(UserWarning, f"^no number of events: {re.escape(line)}"):
            self.assertTrue(np.isnan(clast.decompose(x, domain=BOX, beta_dt=1e-6).events))
        with self.assertWarnsRegex(UserWarning, f"^no pair integral: {re.escape(line)}"):
            clast.decompose(x, domain=BOX)
        with self.assertRaisesRegex(clast.Error, f"^snapshot 1: no number of events: {re.escape(line)}"):
            clast.agglomerate(x, domain=BOX, kernel="constant", constant=1e-6)
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            clast.agglomerate(np.concatenate([X, X[:1]]), domain=BOX, kernel="constant", constant=1e-6, n_step=1)
            clast.decompose(x, domain=BOX, test_only=True)
        heard = [str(one.message) for one in caught]
        self.assertEqual(heard[-1], "1 particle is a duplicate (coincident points); each such pair counts as two particles that meet")
        self.assertFalse([line for line in heard if "too few" in line])

    def test_a_table_says_what_its_rows_are(self):
        """Ten times in one table were one cloud of 113 times the events; weights that nothing names were one each, without a word."""
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "parcels.csv")
            for name, value, keys in (("weight", 1000, {}), ("time_s", 2, {}), ("weight", 1, {}), ("n_real", 7, dict(weight_column="n_real"))):
                np.savetxt(path, np.column_stack([X, np.where(np.arange(len(X)) % 2, value, 1)]), delimiter=",", header=f"x,y,z,{name}", comments="")
                with warnings.catch_warnings(record=True) as caught:
                    warnings.simplefilter("always")
                    if name == "time_s":
                        with self.assertRaisesRegex(clast.Error, "parcels.csv: column 'time_s' holds 2 times"):
                            clast.Cloud.read(path)
                    else:
                        self.assertEqual(len(clast.Cloud.read(path, **keys)), len(X))
                told = [str(one.message) for one in caught]
                wanted = [f"{path}: column 'weight' is not looked at: each row is one particle (weight_column weight)"]
                self.assertEqual(told, wanted if value == 1000 else [])
            np.savetxt(path, np.column_stack([X[:20], np.full(20, 9)]), delimiter=",", header="x,y,z,weight", comments="")
            bodies = dict(domain=BOX, points=path, curve="1um", kernel="constant", constant=0, duration="1ms", rows=1, structure=False)
            self.assertEqual(self.heard(lambda: clast.evolve(**bodies)),  # said nothing
                             ["points: column 'weight' is not looked at: each row is one particle (weight: of all alike)"])
            np.savetxt(path, np.column_stack([X[:20], np.full(20, 9)]), delimiter=",", header="x,y,z,diameter_um", comments="")
            self.assertEqual(self.heard(lambda: clast.evolve(**bodies)),
                             ["points: column 'diameter_um' is not looked at: sizes are those of the curve (diameter_column: of diameters)"])

    def test_which_of_several_snapshots_was_read_is_told(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "two.xyz")
            with open(path, "w", encoding="utf-8") as file:
                for n in (30, 20):
                    file.write(f"{n}\n\n" + "".join("A {} {} {}\n".format(*p) for p in X[:n]))
            for frame, n, said in ((None, 30, [f"{path}: snapshot 1 of 2"]), (0, 30, []), (1, 20, []), (-1, 20, [])):
                read = []
                self.assertEqual(self.heard(lambda: read.append(clast.Cloud.read(path, frame=frame))), said)
                self.assertEqual(len(read[0]), n)

    def test_a_rate_has_the_unit_of_its_dimension(self):
        keys = dict(domain=BOX, estimator="cells")
        self.assertEqual(clast.decompose(X, beta_dt="1 mm^3", **keys).events, clast.decompose(X, beta_dt=1e-9, **keys).events)
        with self.assertRaisesRegex(clast.Error, "^beta_dt: is in m.2, in 3 dimensions it is in m.3"):
            clast.decompose(X, beta_dt="1e-9m^2", **keys)

    def test_keys_of_a_box_are_those_that_it_takes(self):
        """Which keys are a box's stood in three lists."""
        known = {*c.TABLES["clast_agglomerate_fields"], *c.TABLES["clast_spectrum_fields"], "seed"}
        taken = {name for name in known if call("clast_agglomerate_takes")(name.encode(), True)}
        self.assertEqual(set(inspect.signature(clast.box_model).parameters) - {"sizes", "progress"}, taken)

    def test_particles_that_are_left_go_on(self):
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            keys = dict(domain=BOX, kernel="constant", constant=0.01, duration=1.0, n_step=2)
            run = clast.agglomerate(X, **keys)
            left = run.particles
            self.assertEqual(len(left), run.history["n_particle"][-1])
            self.assertEqual(left["monomers"].sum(), 400)
            numbers, sizes = np.unique(run.members["aggregate"], return_counts=True)
            self.assertTrue(np.array_equal(numbers, left["particle"]) and np.array_equal(sizes, left["monomers"]))
            places = np.column_stack([left[name] for name in ("x_m", "y_m", "z_m")])
            self.assertIsNone(clast.agglomerate(X, weight=np.arange(1.0, 1 + len(X)), **keys).members)  # parcels that come apart
            on = clast.agglomerate(places, monomers=left["monomers"], **keys).history
            self.assertEqual((on["n_particle"][0], on["M2"][0]), (run.history["n_particle"][-1], run.history["M2"][-1]))


class Models(Case):
    def test_equal_grains_are_a_single_form(self):
        """"auto" took the mixture of 67 equal grains: rounding was their spread, the porosity -8.9e12."""
        found = clast.predict(table={"flatness": np.full(67, 0.3), "elongation": np.full(67, 0.9)})
        self.assertEqual((found.model, found.inputs["equancy_deviation"]), ("single_form_U1", 0.0))
        self.assertAlmostEqual(found.porosity, 0.278 + 0.019 / 0.27 + 0.014 / 0.9, 14)
        self.assertEqual(clast.predict((0.3, 1.1e-16), (0.9, 0.0)).model, "single_form_U1")  # numpy.std of equal grains
        self.assertEqual(clast.predict((0.65, 0.0), (0.7, 0.1), model="single").inputs["elongation_deviation"], 0.1)

    def test_words_and_few_features_are_told(self):
        k = np.arange(20.0)
        beds = {"a": k, "site": [f"x{i}" for i in range(20)], "porosity": 0.3 + 0.01 * np.sin(3 * k)}
        self.assertEqual(self.heard(lambda: clast.fit(beds, n_permutation=0)), ["1 column of words is no candidate: site",
            "1 of 2 features: no candidate is left of 1 (0 like a chosen one, 0 constant or not finite in some row)",
            "feature 'a' counts the rows; if it says nothing of a bed, name the candidates (columns=)"])
        self.assertEqual(self.heard(lambda: clast.fit({**beds, "b": k * k}, group="a", n_permutation=0, n_term=1)),
                         ["1 column of words is no candidate: site", "column 'a' names the bed and is no candidate"])
        self.assertEqual(self.heard(lambda: clast.fit(beds, n_permutation=0, columns="a", n_term=1)), [])
        mixed = {"sand": 0.2 + 0.6 * np.sin(k) ** 2, "mu": 0.1 + 0.5 * np.cos(2 * k) ** 2, "porosity": 0.3 + 0.01 * np.sin(3 * k)}  # were a form
        self.assertEqual(self.heard(lambda: clast.fit(mixed, n_permutation=0, columns="sand,mu")),
                         ["columns sand,mu are candidates; features='form' takes them as a form"])
        form = {"mean FL": mixed["sand"], "elongation_mean": mixed["mu"], "porosity": mixed["porosity"]}
        self.assertEqual(clast.fit(form, n_permutation=0, columns="mean FL,elongation_mean").model.kind, "single_form")
        self.assertEqual(self.heard(lambda: clast.fit(beds, n_permutation=0, features="columns", use="a")), [])
        study = {"run": k + 1, "size": [f"{100 + 10 * i}um" for i in range(20)], "seed": k, "exit_code": 0 * k, "note": ["n"] * 20,
                 "porosity": 0.3 + 0.001 * k + 1e-4 * np.sin(k * k)}
        found = clast.fit(study, n_term=1, n_permutation=0)
        self.assertEqual((list(found.model.coefficients), self.heard(lambda: clast.fit(study, n_term=1, n_permutation=0))), (["size"], []))
        self.assertEqual(len(clast.predict_beds({"size": ["150um", "0.2mm"]}, model=found.model)), 2)
        # numbers of an array are SI, those of a file may be anything
        self.assertEqual(dict(found.model.units), {"size": "m"})
        made = [clast.predict_beds({"size": size}, model=found.model)["porosity"][0] for size in (["150um"], [150e-6])]
        self.assertEqual(made[0], made[1])
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "new.csv"
            path.write_text("size\n150\n")
            with self.assertRaisesRegex(clast.Error, "column 'size' has no unit"):
                clast.predict_beds(path, model=found.model)


if __name__ == "__main__":
    unittest.main()
