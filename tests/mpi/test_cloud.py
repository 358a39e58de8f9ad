"""MPI: one cloud over ranks is the same bytes as `clast decompose`, however its points are dealt; faults end on all ranks."""
import json
import os
import pathlib
import random
import unittest

from clitest import Case, clast
from ranktest import own_lines, ranks

BOX = ("--domain", "box:0,0,0,1,1,1")


def cloud(n, seed):
    """Half of n points in a blob, with repeated places, and points that share a coordinate."""
    draw = random.Random(seed)
    points = []
    while len(points) < n:
        blob = [draw.gauss(0.4, 0.06) for _ in range(3)]
        points.append(blob if len(points) % 2 and all(0 <= x <= 1 for x in blob) else [draw.random() for _ in range(3)])
    return points + points[:n // 50] + [[0.5, y, z] for _, y, z in points[:n // 20]]


def rows(points):
    return "".join("%r,%r,%r\n" % tuple(p) for p in points)


def rows4(points):
    return "".join("%r,%r,%r,%r\n" % tuple(p) for p in points)


def octahedron():
    """The text of an OBJ file: corners in the middles of the unit cube's faces."""
    corners = [[(k % 2 if j == k // 2 else 0.5) for j in range(3)] for k in range(6)]
    faces = []
    for x, y, z in ((k & 1, k >> 1 & 1, k >> 2) for k in range(8)):
        face = [1 + x, 3 + y, 5 + z]
        faces.append(face if (x + y + z) % 2 else face[::-1])
    return "".join("v %r %r %r\n" % tuple(c) for c in corners) + "".join("f %d %d %d\n" % tuple(f) for f in faces)


def found(out):
    """The summary without the time that it took."""
    made = json.loads(out)
    made.pop("wall_s")
    return json.dumps(made)


class Cloud(Case):
    def write(self, name, text):
        path = self.folder / name
        path.write_text(text)
        return path

    def both(self, n, path, *arguments, code=0):
        alone = clast("decompose", path, *arguments, "--json")
        self.assertEqual(alone.code, code, alone.err)
        got, out, err = ranks(n, "decompose", path, *arguments, "--json")
        self.assertEqual(got, code, err)
        self.assertEqual(found(out), found(alone.out))
        return found(out)

    def test_any_ranks_and_any_order_are_the_same_bytes(self):
        points = cloud(3000, 1)
        dealt = {"as drawn": points, "along x": sorted(points), "shuffled": random.Random(2).sample(points, len(points)),
                 "from the other end": points[::-1]}
        summaries = set()
        for n, order in zip((1, 2, 3, 4), dealt):
            path = self.write(f"{n}.csv", "x,y,z\n" + rows(dealt[order]))
            summaries.add(self.both(n, path, *BOX))
        self.assertEqual(len(summaries), 1)

    def test_settings_are_the_same_bytes(self):
        path = self.write("points.csv", "x,y,z\n" + rows(cloud(2000, 3)))
        for n, arguments in ((3, ("--beta-dt", "1e-6")), (2, ("--no-extrapolate", "--estimator", "cells")), (4, ("--pairs",)),
                             (2, ("--paper", "--mesh", "tree")), (3, ("--tests", "star,pearson", "--votes", "1", "--statistic", "T"))):
            self.both(n, path, *BOX, *arguments)
        for n, arguments in ((3, ("--mesh", "boxes")), (2, ("--mesh", "components", "--lower", "joint", "--max-pass", "3")),
                             (4, ("--variant", "fast", "--mesh", "bins", "--paper"))):
            self.both(n, path, *BOX, *arguments)
        self.both(3, path, *BOX, "--test-only", code=1)
        self.both(2, path, "--domain", "sphere:0.5,0.5,0.5,0.6", "--outside", "drop")

    def test_parcels_are_the_same_bytes(self):
        draw = random.Random(10)
        weighted = [(*p, draw.lognormvariate(0, 1.5)) for p in cloud(2500, 9)]
        columns = ("--weight-column", "w", *BOX)
        summaries = set()
        for n, points in ((1, weighted), (2, weighted[::-1]), (3, sorted(weighted)), (4, draw.sample(weighted, len(weighted)))):
            summaries.add(self.both(n, self.write(f"parcels{n}.csv", "x,y,z,w\n" + rows4(points)), *columns))
        self.assertEqual(len(summaries), 1)
        path = self.folder / "parcels1.csv"
        self.both(3, path, *columns, "--mesh", "boxes", "--beta-dt", "1e-6")
        self.both(4, self.write("two.csv", "x,y,z,w\n" + rows4(weighted[:2])), *columns)  # ranks without a parcel

    def test_cross_fitting_a_variable_and_ghost_samples_are_the_same_bytes(self):
        draw = random.Random(13)
        hot = [(*p, 300 if p[0] < 0.5 else draw.gauss(400, 5)) for p in cloud(2000, 14)]
        path = self.write("hot.csv", "x,y,z,T\n" + rows4(hot))
        other = self.write("toh.csv", "x,y,z,T\n" + rows4(hot[::-1]))
        crossed = ("--crossfit", "--variable-column", "T", *BOX)
        self.assertEqual(self.both(3, path, *crossed), self.both(2, other, *crossed))
        self.both(2, path, "--columns", "x,y", "--domain", "box:0,0,1,1", "--mesh", "boxes", "--ghost-samples", "2", "--variant", "fast")

    def test_events_by_number_are_the_same_bytes(self):
        points = cloud(1500, 15)
        more = (*BOX, "--sizes", "3", "--regular", "6", "-q")
        tables = set()
        for n, order in ((1, points), (2, points[::-1]), (4, sorted(points))):
            folder = self.folder / f"sizes{n}"
            path = self.write(f"sizes{n}.csv", "x,y,z\n" + rows(order))
            code, _, err = ranks(n, "decompose", path, *more, "-o", folder)
            self.assertEqual(code, 0, err)
            tables.add((folder / "events_by_n.csv").read_bytes())
            self.assertTrue((folder / "events_by_n.svg").exists())
        alone = clast("decompose", self.folder / "sizes4.csv", *more, "-o", self.folder / "alone")
        self.assertEqual(alone.code, 0, alone.err)
        self.assertEqual(tables, {(self.folder / "alone/events_by_n.csv").read_bytes()})

    def test_weights_that_no_option_names_are_told_once(self):
        """Ranks said nothing, whoever has the rows of weights that are not 1."""
        points = rows(cloud(300, 22)).split()
        for first, last in ((0, 9), (290, 299), (0, 299)):
            path = self.write("parcels.csv", "n,x,y,z,multiplicity,Weight\n" + "".join(
                f"{k},{row},{2 if k >= 299 else 1},{5 if first <= k <= last else 1}\n" for k, row in enumerate(points)))
            alone = clast("decompose", path, *BOX)
            self.assertIn("' is not looked at: each row is one particle", alone.err)
            for n in (2, 4):
                code, _, err = ranks(n, "decompose", path, *BOX)
                self.assertEqual((code, own_lines(err)), (0, own_lines(alone.err)))
            self.assertEqual(ranks(2, "decompose", path, *BOX, "--weight-column", "Weight")[2].count("not looked at"), 0)

    def test_rows_of_several_times_are_refused_alike(self):
        """Each rank reads a stretch that may hold one time alone: all ranks' times count together."""
        points = cloud(300, 21)
        for order in (lambda k: k // 101, lambda k: k % 4):
            text = "time,x,y,z\n" + "".join(f"{order(k)},{row}\n" for k, row in enumerate(rows(points).split()))
            path = self.write("hist.csv", text)
            alone = clast("decompose", path, *BOX)
            self.assertIn("column 'time' holds 4 times", alone.err)
            for n in (2, 4):
                code, _, err = ranks(n, "decompose", path, *BOX)
                self.assertEqual((code, own_lines(err)), (alone.code, own_lines(alone.err)))

    def test_a_closed_surface_is_the_same_bytes(self):
        surface = self.write("octahedron.obj", octahedron())
        path = self.write("around.csv", "x,y,z\n" + rows(cloud(2500, 11)))
        more = ("--domain", f"mesh:{surface}", "--outside", "drop")
        self.both(2, path, *more)
        self.both(3, path, *more, "--mesh", "boxes")
        self.both(4, path, *more, "--pairs")

    def test_pairs_of_many_points_are_the_same_bytes(self):
        draw = random.Random(12)
        path = self.write("many pairs.csv", "x,y,z\n" + rows([[draw.random() ** 2, draw.random(), draw.random()] for _ in range(210000)]))
        self.both(3, path, *BOX, "--pairs")

    def test_many_points_take_the_ways_of_many(self):
        points = cloud(60000, 4)  # binned sums, a grid of splines, chosen neighbours
        path = self.write("many.csv", "x,y,z\n" + rows(points))
        self.both(4, path, *BOX)
        flat = self.write("flat.csv", "x,y\n" + "".join("%r,%r\n" % tuple(p[:2]) for p in points))
        self.both(2, flat, "--domain", "box:0,0,1,1")
        line = self.write("line.csv", "x\n" + "".join("%r\n" % p[0] for p in points[:30000]))
        self.both(3, line, "--domain", "box:0,1")

    def test_files_are_the_same_bytes(self):
        path = self.write("points.csv", "x,y,z\n" + rows(cloud(1500, 5)) + "2.0,0.5,0.5\n")
        more = (*BOX, "--outside", "drop", "-q")
        alone = clast("decompose", path, *more, "-o", self.folder / "alone")
        self.assertEqual(alone.code, 0, alone.err)
        for n in (2, 4):
            code, out, err = ranks(n, "decompose", path, *more, "-o", self.folder / str(n))
            self.assertEqual(code, 0, err)
            self.assertEqual(out, alone.out)
            for name in ("cells.csv", "point_cells.csv", "cells.vtu", "summary.json"):
                self.assertTrue((self.folder / str(n) / name).read_bytes() == (self.folder / "alone" / name).read_bytes(), name)
            left_out = {path.name for path in (self.folder / "alone").iterdir()} - {path.name for path in (self.folder / str(n)).iterdir()}
            self.assertEqual(left_out, {"points.vtp", "points.svg"})

    def test_charts_are_the_same_bytes(self):
        """All charts were left out with those that show points."""
        path = self.write("points.csv", "x,y,z\n" + rows(cloud(1500, 5)))
        for more, names in ((("--mesh", "boxes"), {"density.svg", "score.svg", "pair_integral.svg"}),
                            (("--beta-dt", "1e-4"), {"events.svg"})):
            run = self.folder / more[0]
            self.assertEqual(clast("decompose", path, *BOX, *more, "-q", "-o", f"{run}-alone").code, 0)
            code, _, err = ranks(3, "decompose", path, *BOX, *more, "-q", "-o", run)
            self.assertEqual(code, 0, err)
            self.assertLessEqual(names, {found.name for found in run.iterdir()})
            for name in names:
                self.assertEqual((run / name).read_bytes(), (self.folder / f"{run}-alone" / name).read_bytes(), name)

    def test_any_text_of_numbers_is_shared_out(self):
        points = rows(cloud(700, 6))
        names = ("--columns", "column_1,column_2,column_3")
        self.both(3, self.write("bare.csv", points), *names, *BOX)
        lines = points.splitlines()
        self.both(2, self.write("remarks.csv", "# a remark\n\n" + "x,y,z\n" + "\n# one more\n\n".join(lines)), *BOX)
        self.both(4, self.write("windows.csv", "\ufeffx;y;z\r\n" + "\r\n".join(l.replace(",", ";") for l in lines)), *BOX)
        self.both(3, self.write("blanks.txt", " x   y z\n" + "\n".join(l.replace(",", "  ") for l in lines)), *BOX)
        self.both(3, self.write("units.csv", "x_mm,y_mm,z_mm\n" + points), "--columns", "x_mm,y_mm,z_mm",
                  "--domain", "box:0,0,0,1mm,1mm,1mm")

    def test_lines_end_in_lf_cr_lf_or_cr(self):
        """Ranks looked for LF alone: rows behind a bare CR were read once by each rank, or written beyond the block."""
        lines = ["x,y,z"] + rows(cloud(2000, 16)).splitlines()
        draw = random.Random(17)
        ends = {"names.csv": ["\r"] + ["\n"] * len(lines), "old mac.csv": ["\r"] * len(lines), "rows.csv": ["\n"] * 40 + ["\r"] * len(lines),
                "mixed.csv": [draw.choice(("\n", "\r\n", "\r")) for _ in lines]}
        summaries = set()
        for n, (name, by_line) in zip((2, 3, 3, 4), ends.items()):
            path = self.folder / name
            path.write_bytes("".join(line + end for line, end in zip(lines, by_line)).encode())
            summaries.add(self.both(n, path, *BOX))
        self.assertEqual(len(summaries), 1)
        lines[1900] = "0.1,zwei,0.3"
        path.write_bytes("".join(line + end for line, end in zip(lines, by_line)).encode())
        code, _, err = ranks(3, "decompose", path, *BOX)
        self.assertEqual(code, 3, err)
        self.assertIn("mixed.csv:1901: 'zwei' in column 'y' is no number", err)

    def test_texts_in_a_column_that_nobody_asks_for(self):
        """Refused by ranks alone, where the first rows hold numbers: "'p3000' in column 'id' is no number"."""
        points = ["%s%d,%r,%r,%r\n" % ("p" if k >= 3000 else "", k, *p) for k, p in enumerate(cloud(4000, 18))]
        self.both(3, self.write("named.csv", "id,x,y,z\n" + "".join(points)), *BOX)

    @unittest.skipIf(os.environ.get("CLAST_HAVE_HDF5") == "0", "built without HDF5")
    def test_rows_of_hdf5_are_shared_out(self):
        try:
            import h5py
            import numpy
        except ImportError:
            self.skipTest("no h5py")
        points = numpy.array(cloud(900, 7))
        path = self.folder / "points.h5"
        with h5py.File(path, "w") as file:
            file["all"] = points
            for k, name in enumerate("xyz"):
                file[f"each/{name}"] = points[:, k]
        self.both(3, path, "--dataset", "all", *BOX)
        self.both(2, path, "--dataset", "each", *BOX)

    def test_ranks_without_points_and_few_points(self):
        for n in (1, 2, 3, 6):
            path = self.write(f"few{n}.csv", "x,y,z\n" + rows([[0.1 * k, 0.2, 0.9 - 0.1 * k] for k in range(n)]))
            self.both(4, path, *BOX)
        self.both(4, self.write("one place.csv", "x,y,z\n" + "0.5,0.5,0.5\n" * 40), *BOX)

    def test_faults_end_on_all_ranks_with_one_line(self):
        lines = rows(cloud(4000, 8)).splitlines()
        def bad(name, line, text):
            return self.write(name, "x,y,z\n" + "\n".join(lines[:line - 2] + [text] + lines[line - 1:]) + "\n")
        good = self.write("good.csv", "x,y,z\n" + "\n".join(lines) + "\n")
        for path, more, code, says in (
                (bad("word.csv", 3000, "0.1,zwei,0.3"), (), 3, "word.csv:3000: 'zwei' in column 'y'"),
                (bad("early.csv", 30, "0.1,zwei,0.3"), (), 3, "row 29 holds 'zwei'"),
                (bad("ragged.csv", 3001, "0.1,0.3"), (), 3, "ragged.csv:3001: 2 cells"),
                (bad("missing.csv", 3002, "0.1,,0.3"), (), 3, "point 3001 has a coordinate that is not finite"),
                (bad("quoted.csv", 3003, '"0.1",0.2,0.3'), (), 3, "quoted.csv:3003"),
                (bad("outside.csv", 3004, "0.1,0.2,7"), (), 3, "1 of 4280 points lie outside"),
                (self.write("empty.csv", "x,y,z\n"), (), 3, "holds no points"),
                (self.write("nothing.csv", ""), (), 3, "holds no table"),
                (self.folder / "absent.csv", (), 3, "No such file"),
                (good, ("--columns", "x,y,w"), 3, "no column of numbers named 'w'"),
                (pathlib.Path("data/scarlet/stl/27sk21_shape_fine.stl"), (), 3, "27sk21"),
                (good, ("--weight-column", "x", "--pairs"), 2, "weights"),
                (bad("light.csv", 3005, "0,0.2,0.3"), ("--weight-column", "x"), 3, "the weight of point 3004 is 0"),
                (bad("hot.csv", 3006, "0.1,0.2,1e200"), ("--columns", "x,y", "--domain", "box:0,0,1,1", "--variable-column", "z"), 3,
                 "the variable of point 3005 is 1e+200"),
                (good, ("--sizes", "12", "-o", self.folder / "s"), 2, "sizes: 12 of 4280 points end below 5 points")):
            got, out, err = ranks(3, "decompose", path, *BOX, *more)
            self.assertEqual(got, code, err)
            self.assertEqual(out, "")
            self.assertEqual(len(own_lines(err)), 1, err)
            self.assertIn(says, own_lines(err)[0])


if __name__ == "__main__":
    unittest.main()
