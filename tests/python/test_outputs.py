"""No output of Python takes the place of an input or of a run's file: the rule of the command (tests/cli/test_inputs_kept.py)."""
import os
import pathlib
import shutil
import tempfile
import unittest
from unittest import mock

import clast
from clast import _grains, _mesh, _surfaces
from clast._core import call

ROOT = pathlib.Path(__file__).resolve().parents[2]
GRAIN = ROOT / "data/standin63/grain00.ply"


class Outputs(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)

    def contents(self):
        return {os.fspath(p): p.read_bytes() for p in self.folder.rglob("*") if p.is_file()}

    def refused(self, says, *calls):
        before = self.contents()
        for number, made in enumerate(calls):
            with self.subTest(number), self.assertRaisesRegex(clast.Error, says):
                made()
        self.assertEqual(self.contents(), before)

    def test_none_takes_an_inputs_place(self):
        grain, link, table = self.folder / "g.ply", self.folder / "link.ply", self.folder / "s.csv"
        shutil.copy(GRAIN, grain)
        link.symlink_to("g.ply")
        table.write_text("id,x,y,z,d\n7,5,5,2,4\n", encoding="utf-8")
        self.refused("^output .* is the input .*; an output takes no input's place, give it another name$",
                     lambda: clast.mesh_convert(grain, grain, scale=3.0), lambda: clast.mesh_simplify(grain, 50, output=link),
                     lambda: clast.mesh_repair(link, output=grain), lambda: clast.mesh_hull(os.fspath(grain), output=grain),
                     lambda: clast.mesh_form(grain, flatness=0.6, output=self.folder / "." / "g.ply"), lambda: clast.export(table, table),
                     lambda: clast.report(table, output=table))
        self.refused("^(surfaces|output) .* is the folder of the input ", lambda: clast.shapes(grain, surfaces=self.folder),
                     lambda: clast.pack(curve="4mm", mass="1g", width="20mm", height="40mm", max_steps=3, shapes=grain, output=self.folder),
                     lambda: clast.aggregate(core=grain, size="30um", output=self.folder),
                     lambda: clast.study(run="fill", argument=grain, vary="spheres = 5|9", output=self.folder))
        self.assertGreater(clast.mesh_hull(grain, output=self.folder / "hull.ply").volume, 0)

    def test_none_takes_the_place_of_a_runs_file(self):
        run = self.folder / "bed"
        bed = clast.pack(curve="4mm", mass="1g", domain="box", width="20mm", height="40mm", max_steps=3, output=run)
        grain = clast.Mesh.read(GRAIN)
        (self.folder / "link.ply").symlink_to("bed/state.h5")
        self.refused("^(output|path|folder) .* is part of a run; give another name",
                     lambda: clast.export(run, run / "summary.json"), lambda: clast.export(run, run / "grains.csv"),
                     lambda: clast.export(run, run / "series.csv", table="series"), lambda: clast.report(run, output=run / "summary.json"),
                     lambda: clast.mesh_hull(grain, output=run / "manifest.json"), lambda: clast.mesh_convert(grain, self.folder / "link.ply"),
                     lambda: grain.write(run / "state.h5"), lambda: bed.run.table("series").write(run / "series.csv"),
                     lambda: bed.run.grains.write(run / "grains.csv"))
        clast.export(run, run / "own.csv")
        clast.export(run, run / "own.csv")
        clast.report(run, output=run / "report.html")

    def test_one_that_cannot_be_written_is_refused_before_the_work(self):
        def idle(name):
            self.assertNotIn(name, ("clast_mesh_hull", "clast_mesh_simplify", "clast_mesh_repair", "clast_reform_principal", "clast_synthesize_grain",
                                    "clast_grains_read", "clast_mesh_read"))
            return call(name)

        (self.folder / "is.ply").mkdir()
        for module in (_grains, _mesh, _surfaces):
            patch = mock.patch.object(module, "call", idle)
            patch.start()
            self.addCleanup(patch.stop)
        for name, says in (("none/g.ply", "^cannot write .*g.ply: there is no folder .*none/$"), ("is.ply", "^cannot write .*is.ply: it is a folder$"),
                           ("g.foo", "^output: .*g.foo is no surface format by its name; write .stl, .obj, .ply"), ("g", "^output: .*g is no surface")):
            to = self.folder / name
            self.refused(says, lambda: clast.mesh_hull(GRAIN, output=to), lambda: clast.mesh_simplify(GRAIN, 50, output=to),
                         lambda: clast.mesh_repair(GRAIN, output=to), lambda: clast.mesh_form(GRAIN, flatness=0.6, output=to),
                         lambda: clast.mesh_synthesize(output=to), lambda: clast.mesh_convert(GRAIN, to))
        self.refused("^cannot write .*: there is no folder .*none/$", lambda: clast.shapes(GRAIN, surfaces=self.folder / "none"))
        self.refused("^output: 3MF is in millimetres", lambda: clast.mesh_hull(GRAIN, output=self.folder / "g.3mf"))

    def test_a_link_is_left_to_the_writing(self):
        (self.folder / "real").mkdir()
        (self.folder / "to.ply").symlink_to("real/g.ply")
        clast.mesh_hull(GRAIN, output=self.folder / "to.ply")
        self.assertGreater((self.folder / "real/g.ply").stat().st_size, 0)


if __name__ == "__main__":
    unittest.main()
