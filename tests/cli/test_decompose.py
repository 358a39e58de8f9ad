"""CLI: decompose tests, splits and counts as its help says."""
import base64
import json
import math
import random
import re
import struct
import unittest
import zlib

from clitest import ROOT, Case, clast

DATA = ROOT / "data/d2sd"


def write_points(path, points):
    names = "xyz"[:len(points[0])]
    path.write_text(",".join(names) + "\n" + "\n".join(",".join(repr(c) for c in p) for p in points) + "\n")


def csv_lines(path):
    """Cells of a table's lines below its note."""
    return [line.split(",") for line in path.read_text().splitlines() if not line.startswith("#")]


def vtk_array(text, name):
    """Numbers of a zlib-packed inline DataArray, decoded by the format's own rules."""
    kind, data = re.search(rf'<DataArray type="(\w+)" Name="{name}"[^>]*>\n(.*?)\n</DataArray>', text, re.S).groups()
    n_block = struct.unpack("<Q", base64.b64decode(data[:12])[:8])[0]
    width = (8 * (3 + n_block) + 2) // 3 * 4
    head = struct.unpack(f"<{3 + n_block}Q", base64.b64decode(data[:width]))
    body, raw = base64.b64decode(data[width:]), b""
    for size in head[3:]:
        raw, body = raw + zlib.decompress(body[:size]), body[size:]
    code = {"Float64": "d", "Int64": "q", "Int32": "i", "UInt8": "B"}[kind]
    return struct.unpack(f"<{len(raw) // struct.calcsize(code)}{code}", raw)


def hexahedron_volume(p):
    """Six tetrahedra of a VTK hexahedron's corners."""
    sub = lambda a, b: [x - y for x, y in zip(a, b)]
    total = 0.0
    for a, b, c, d in ((0, 1, 2, 6), (0, 2, 3, 6), (0, 3, 7, 6), (0, 7, 4, 6), (0, 4, 5, 6), (0, 5, 1, 6)):
        u, v, w = sub(p[b], p[a]), sub(p[c], p[a]), sub(p[d], p[a])
        total += abs(u[0] * (v[1] * w[2] - v[2] * w[1]) - u[1] * (v[0] * w[2] - v[2] * w[0])
                     + u[2] * (v[0] * w[1] - v[1] * w[0])) / 6
    return total


class Decompose(Case):
    def decompose(self, name, domain, *options):
        result = clast("decompose", DATA / f"points_{name}.csv", "--domain", domain, "--json", *options)
        self.assertEqual(result.code, 0, result.err)
        return result.json

    def test_verdicts_of_a_single_test_agree(self):
        for name in ("b3_n500", "u3_n50"):
            ask = ("decompose", ROOT / f"data/d2sd/points_{name}.csv", "--domain", "box:0,0,0,1,1,1", "--tests", "star")
            words, alone = clast(*ask, "--test-only"), clast(*ask, "--test-only", "--json")
            reject = alone.json["reject"]
            self.assertEqual(reject, name == "b3_n500")
            self.assertEqual(reject, alone.json["tests"][0]["p"] < 0.05)
            self.assertEqual((words.code, alone.code), (int(reject),) * 2)
            self.assertEqual("not uniform" in words.out, reject)
            self.assertEqual("accepted by the tests" in clast(*ask).out, not reject)
            self.assert_fails(2, *ask, "--votes", "3", says=("votes: 3 tests must reject, but 1 votes",))

    def test_uniform_points_are_one_cell(self):
        r = self.decompose("u2_n50", "box:0,0,1,1", "--beta-dt", "0.004")
        self.assertFalse(r["reject"])
        self.assertEqual(r["n_cell"], 1)
        self.assertAlmostEqual(r["events"], 0.5 * 0.004 * 50 * 49, places=12)

    def test_stop_says_what_happened_on_stdout_in_json_and_in_the_summary(self):
        # a tree of 127 cells of a cloud that all but one test reject said "the tests accept"
        out = self.folder / "out"
        r = self.decompose("b3_n500", "box:0,0,0,1,1,1", "-o", out)
        self.assertEqual((r["reject"], r["n_cell"], r["stop"]), (True, 127, "rejected by the tests and split"))
        self.assertEqual(json.loads((out / "summary.json").read_text())["stop"], r["stop"])
        words = clast("decompose", DATA / "points_b3_n500.csv", "--domain", "box:0,0,0,1,1,1").out
        self.assertIn("stop: rejected by the tests and split\n", words)
        self.assertNotIn("accept", words)
        only = clast("decompose", DATA / "points_b3_n500.csv", "--domain", "box:0,0,0,1,1,1", "--test-only", "--json")
        self.assertEqual(only.code, 1)
        self.assertEqual(only.json["stop"], "rejected by the tests; the variant does not split")
        for points, stop in (("u2_n50", "accepted by the tests"), ("f2_n500", "split; the tests then accept")):
            self.assertEqual(self.decompose(points, "box:0,0,1,1", "--mesh", "boxes")["stop"], stop)
        write_points(self.folder / "few.csv", [[0.1, 0.2], [0.5, 0.6], [0.8, 0.1]])
        few = clast("decompose", self.folder / "few.csv", "--domain", "box:0,0,1,1", "--json").json
        self.assertEqual((few["tests"], few["stop"]), ([], "not tested: fewer than 5 points"))

    def test_a_sample_that_does_not_show_its_structure_says_so(self):
        # 300 points of a sheet of sd 0.02: cells of a tree found 0.36 of the pairs, with an interval about that
        random.seed(8)
        sheet = [[random.random(), random.random(), min(1, max(0, random.gauss(0.45, 0.02)))] for _ in range(300)]
        write_points(self.folder / "sheet.csv", sheet)
        command = ["decompose", self.folder / "sheet.csv", "--domain", "box:0,0,0,1,1,1"]
        r = clast(*command, "--json").json
        self.assertEqual((r["resolved"], r["pair_integral_high"]), (False, None))
        self.assertLess(r["pair_integral_low"], 0.5 * 300 * 299 / (2 * math.sqrt(math.pi) * 0.02))
        self.assertGreater(r["points_needed"], 1000)
        self.assertIn("not resolved: the points do not show their own structure, the lower bound alone holds", clast(*command).out)
        plane = [[random.random(), random.gauss(0.5, 0.1)] for _ in range(6000)]
        write_points(self.folder / "plane.csv", plane)
        r = clast("decompose", self.folder / "plane.csv", "--domain", "box:0,-1,1,2", "--json").json
        self.assertEqual((r["resolved"], r["points_needed"], r["passes"]), (True, 6000, []))  # a tree in 2-D too
        self.assertLess(r["pair_integral_low"], 0.5 * 6000 * 5999 / (2 * math.sqrt(math.pi) * 0.1))
        self.assertGreater(r["pair_integral_high"], 0.5 * 6000 * 5999 / (2 * math.sqrt(math.pi) * 0.1))

    def test_words_and_columns_say_what_they_are(self):
        frame = clast("decompose", DATA / "points_f2_n500.csv", "--domain", "box:0,0,1,1", "--beta-dt", "0.002", "--mesh", "boxes").out
        self.assertRegex(frame, r"pass 1: 5 x 5 bins, threshold [\d.]+ of the mean density \(\d+ points a bin; best of \d+\), ")
        self.assertRegex(frame, r"\d+ cells, events [\d.]+ \[[\d.]+, -\] with beta dt 0.002 m\^2, \d+ cells at the cap")
        self.assertIsNone(self.decompose("b3_n500", "box:0,0,0,1,1,1")["points_per_bin"])  # a tree has no bins
        random.seed(3)
        points = [[0.05 * random.random(), 0.05 * random.random(), random.random()] for _ in range(50)] + [[3, 3, 3]]
        write_points(self.folder / "pipe.csv", points)
        out = self.folder / "out"
        r = clast("decompose", self.folder / "pipe.csv", "--domain", "cylinder:0.1,1", "--outside", "drop", "--mesh",
                  "boxes", "-o", out)
        self.assertEqual(r.code, 0, r.err)
        self.assertIn("50 points in 3 dimensions, 1 outside the domain left out", r.out)
        # corners of a map's cells are coordinates of the unit cube, and a point outside has neither label nor pass
        self.assertTrue(",".join(csv_lines(out / "cells.csv")[0]).startswith("u_low,u_high,v_low,v_high,w_low,w_high,volume,"))
        self.assertEqual((out / "point_cells.csv").read_text().splitlines()[-1], "-1,,")

    def test_crossfit_keeps_every_column_in_its_halves(self):
        random.seed(5)
        rows = [(random.random(), random.random()) for _ in range(800)]
        hot = self.folder / "hot.csv"
        hot.write_text("x,y,T,w\n" + "".join(f"{x!r},{y!r},{300 if x < 0.5 else 400},2\n" for x, y in rows))
        options = ["--domain", "box:0,0,1,1", "--mesh", "tree", "--crossfit", "--no-extrapolate", "--tree-level", "1e-9",
                   "--tree-root-level", "1e-12", "--weight-column", "w", "--beta-dt", "1e-6", "--json"]
        count = [0] * 4
        for x, y in rows:
            count[2 * (x >= 0.5) + (y >= 0.5)] += 2
        plain = clast("decompose", hot, *options).json
        self.assertAlmostEqual(plain["events_cross"], 2e-6 * 800 * 800, places=9)
        split = clast("decompose", hot, "--variable-column", "T", *options).json
        self.assertEqual(split["n_cell"], 4)
        even = sum(2e-6 * n * n for n in count)  # of halves that share each cell's points evenly; others have fewer pairs
        self.assertLess(split["events_cross"], even)
        self.assertGreater(split["events_cross"], 0.96 * even)

    def test_frame_has_five_by_five_bins_and_one_pass_as_published(self):
        r = self.decompose("f2_n500", "box:0,0,1,1", "--mesh", "boxes")
        self.assertTrue(r["reject"])
        self.assertEqual([p["bins"] for p in r["passes"]], [[5, 5]])

    def test_cells_hold_all_points_and_the_whole_volume(self):
        for mesh in ("boxes", "components", "bins", "labels", "tree"):
            r = clast("decompose", DATA / "points_b3_n500.csv", "--domain", "box:0,0,0,1,1,1", "--mesh", mesh,
                      "--beta-dt", "1e-6", "-o", self.folder / mesh, "--json")
            self.assertEqual(r.code, 0, r.err)
            rows = csv_lines(self.folder / mesh / "cells.csv")
            column = {name: k for k, name in enumerate(rows[0])}
            self.assertEqual(len(rows) - 1, r.json["n_cell"])
            self.assertEqual(sum(float(row[column["count"]]) for row in rows[1:]), 500)
            self.assertAlmostEqual(sum(float(row[column["volume"]]) for row in rows[1:]), 1.0, places=9)
            self.assertAlmostEqual(sum(float(row[column["events"]]) for row in rows[1:]), r.json["events"], places=9)

    def test_events_scale_with_the_inverse_of_the_volume(self):
        near = self.decompose("u2_n50", "box:0,0,1,1")
        random.seed(1)
        points = [[float(c) * 10 for c in line.split(",")]
                  for line in (DATA / "points_u2_n50.csv").read_text().split()[1:]]
        write_points(self.folder / "far.csv", points)
        far = clast("decompose", self.folder / "far.csv", "--domain", "box:0,0,10,10", "--json").json
        self.assertAlmostEqual(near["pair_integral"] / far["pair_integral"], 100.0, places=6)
        self.assertAlmostEqual(near["score"], far["score"], places=12)

    def test_uniform_3d_cloud_is_unbiased_by_default(self):
        random.seed(7)
        points = [[random.random() for _ in range(3)] for _ in range(1000)]
        write_points(self.folder / "u.csv", points)
        expected = 0.5 * 1000 * 999
        for mesh in ("boxes", "tree"):
            r = clast("decompose", self.folder / "u.csv", "--domain", "box:0,0,0,1,1,1", "--mesh", mesh, "--json").json
            self.assertLess(abs(r["pair_integral"] / expected - 1.0), 0.02)

    def test_all_particles_are_the_cap_at_any_rate(self):
        # the square of 1e300 is infinite: "no number of events: points lie closer together than cells of this domain can resolve"
        random.seed(1)
        points = self.folder / "even.csv"
        write_points(points, [[random.random() for _ in range(3)] for _ in range(800)])
        for rate in ("1e3", "1e300"):
            r = clast("decompose", points, "--domain", "box:0,0,0,1,1,1", "--beta-dt", rate, "--json").json
            self.assertEqual((r["events"], r["events_high"], r["n_capped"]), (400, 400, 1))
            self.assertAlmostEqual(r["events_low"], 373.22, places=2)

    def test_published_estimate_is_biased_in_3d_and_says_so(self):
        random.seed(7)
        points = [[random.random() for _ in range(3)] for _ in range(1000)]
        write_points(self.folder / "u.csv", points)
        r = clast("decompose", self.folder / "u.csv", "--domain", "box:0,0,0,1,1,1", "--variant", "fast",
                  "--events", "paper", "--json").json
        self.assertGreater(r["pair_integral"] / 1e6, 1.6)
        words = clast("decompose", self.folder / "u.csv", "--domain", "box:0,0,0,1,1,1", "--variant", "fast").out
        self.assertIn("points a bin (under 10)", words)

    def test_half_pipe_maps_uniform_points_to_uniform_points(self):
        random.seed(3)
        points = []
        for _ in range(2000):
            rho, theta = 0.1 * math.sqrt(random.random()), math.pi * random.random()
            points.append([rho * math.cos(theta), rho * math.sin(theta), random.random()])
        write_points(self.folder / "pipe.csv", points)
        r = clast("decompose", self.folder / "pipe.csv", "--domain", "half-pipe:0.1,1", "--json").json
        self.assertFalse(r["reject"])
        volume = 0.5 * math.pi * 0.01
        self.assertAlmostEqual(r["pair_integral"] / (0.5 * 2000 * 1999 / volume), 1.0, places=9)

    def test_folder_holds_tables_pictures_and_files_for_paraview(self):
        out = self.folder / "out"
        r = clast("decompose", DATA / "points_s2_n500.csv", "--domain", "box:0,0,1,1", "--mesh", "boxes", "--beta-dt", "1e-6", "-o", out,
                  "--json")
        self.assertEqual(r.code, 0, r.err)
        names = {"cells.csv", "point_cells.csv", "thresholds.csv", "summary.json", "manifest.json", "cells.vtu", "points.vtp",
                 "points.svg", "density.svg", "score.svg", "events.svg"}
        self.assertEqual({path.name for path in out.iterdir()}, names)
        self.assertEqual(json.loads((out / "summary.json").read_text()), {k: v for k, v in r.json.items() if k != "wall_s"})
        rows = csv_lines(out / "point_cells.csv")
        self.assertEqual(rows[0], ["cell", "label", "pass"])
        vtp = (out / "points.vtp").read_text()
        self.assertEqual([list(map(float, row)) for row in rows[1:]],
                         [list(t) for t in zip(*(vtk_array(vtp, name) for name in ("cell", "label", "pass")))])
        again = clast("decompose", out / "points.vtp", "--columns", "x,y", "--domain", "box:0,0,1,1", "--mesh", "boxes", "--beta-dt",
                      "1e-6", "--json").json
        self.assertEqual(again["events"], r.json["events"])
        vtu = (out / "cells.vtu").read_text()
        self.assertEqual(vtk_array(vtu, "count"), tuple(
            float(row[5]) for row in csv_lines(out / "cells.csv")[1:]))
        self.assertEqual(set(vtk_array(vtu, "types")), {9})

    def test_events_of_parts_scale_to_the_whole(self):
        random.seed(8)
        points = []
        while len(points) < 4000:
            p = [random.gauss(0.5, 0.1), random.gauss(0.5, 0.1)]
            if 0 < p[0] < 1 and 0 < p[1] < 1:
                points.append(p)
        write_points(self.folder / "blob.csv", points)
        out = self.folder / "sizes"
        r = clast("decompose", self.folder / "blob.csv", "--domain", "box:0,0,1,1", "--sizes", "4", "--regular", "20",
                  "--beta-dt", "1e-6", "-o", out, "--json")
        self.assertEqual(r.code, 0, r.err)
        lines = csv_lines(out / "events_by_n.csv")
        rows = [dict(zip(lines[0], (float(x or "nan") for x in line))) for line in lines[1:]]  # not resolved: no upper end
        self.assertEqual([row["n"] for row in rows], [500, 1000, 2000, 4000])
        self.assertAlmostEqual(rows[-1]["events"], r.json["events"], delta=0.05 * r.json["events"])
        truth = 0.5e-6 * 4000 ** 2 / (4 * math.pi * 0.01)  # integral of the density's square
        for row in rows:  # a part has half the points of the next: error of the regular mesh is 1 / (2 sigma)^2 bins
            self.assertAlmostEqual(row["scaled_events"], row["events"] * 4000 * 3999 / (row["n"] * (row["n"] - 1)), delta=1e-9)
            self.assertLess(abs(row["scaled_regular"] / truth - 1), 0.03 + 4 * 2 / math.sqrt(row["n"]))
        self.assertLess(abs(rows[-1]["scaled_events"] / truth - 1), 0.1)
        self.assertTrue((out / "events_by_n.svg").read_text().startswith("<?xml"))
        self.assert_fails(2, "decompose", self.folder / "blob.csv", "--domain", "box:0,0,1,1", "--sizes", "20", "-o", self.folder / "none",
                          says=["below 5 points"])

    def test_inside_of_a_surface_is_a_domain(self):
        random.seed(9)
        points = []
        while len(points) < 600:
            p = [random.uniform(0, 1), random.uniform(0, 1), random.uniform(0, 1)]
            if sum(p) < 1 and (p[0] < 0.3 or random.random() < 0.2):
                points.append(p)
        write_points(self.folder / "corner.csv", points)
        surface = self.folder / "corner.off"
        surface.write_text("OFF\n4 4 0\n0 0 0\n1000 0 0\n0 1000 0\n0 0 1000\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n")
        for mesh in ("boxes", "components", "bins", "labels", "tree"):
            out = self.folder / mesh
            r = clast("decompose", self.folder / "corner.csv", "--domain", f"mesh:{surface}", "--domain-unit", "mm", "--mesh",
                      mesh, "-o", out, "--json")
            self.assertEqual(r.code, 0, r.err)
            lines = csv_lines(out / "cells.csv")
            rows = [dict(zip(lines[0], map(float, line))) for line in lines[1:]]
            self.assertGreater(len(rows), 1)
            self.assertAlmostEqual(sum(row["volume"] for row in rows), 1 / 6, delta=1e-12 / 6)
            self.assertEqual(sum(row["count"] for row in rows), 600)
            self.assertEqual(r.json["n_test"], 3600)
            self.assertEqual(set(vtk_array((out / "cells.vtu").read_text(), "types")), {12})
        r = clast("agglomerate", self.folder / "corner.csv", "--domain", f"mesh:{surface}", "--domain-unit", "mm", "--constant",
                  "1e-3", "--fixed", "4", "--json")
        self.assertEqual(r.code, 0, r.err)
        self.assertEqual(r.json["moments"]["M1"][-1], 600)
        self.assertGreater(r.json["fixed"]["events"][-1], 0)
        # a file by clast says its unit: taken where none is given, and another one is refused (1000 times off, without a word)
        said = self.folder / "corner.ply"
        self.assertEqual(clast("mesh", "convert", surface, "--unit", "mm", "-o", said).code, 0)
        r = clast("decompose", self.folder / "corner.csv", "--domain", f"mesh:{said}", "--json")
        self.assertEqual((r.code, r.json["n"]), (0, 600))
        self.assert_fails(2, "decompose", self.folder / "corner.csv", "--domain", f"mesh:{said}", "--unit", "m",
                          says=["corner.ply says that it is in mm, not in m", "--domain-unit"])
        surface.write_text("OFF\n4 3 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n")
        out = self.folder / "none"
        self.assert_fails(3, "decompose", self.folder / "corner.csv", "--domain", f"mesh:{surface}", "-o", out,
                          says=["corner.off", "open", "3 open edges", "clast mesh repair"])
        self.assertFalse(out.exists())

    def test_cells_of_curved_domains_fill_them(self):
        random.seed(4)
        points = []
        while len(points) < 3000:
            p = [random.gauss(0.3, 0.2), random.gauss(0.0, 0.3), random.gauss(0.0, 0.3)]
            if math.hypot(*p) < 1.0:
                points.append(p)
        write_points(self.folder / "ball.csv", points)
        for domain, volume in (("sphere:1", 4 / 3 * math.pi), ("cylinder:1,2", 2 * math.pi)):
            out = self.folder / domain.split(":")[0]
            r = clast("decompose", self.folder / "ball.csv", "--domain", domain, "--outside", "drop", "--mesh",
                      "components", "-o", out)
            self.assertEqual(r.code, 0, r.err)
            vtu = (out / "cells.vtu").read_text()
            x = vtk_array(vtu, "Points")
            corners = [x[i:i + 3] for i in range(0, len(x), 3)]
            total = sum(hexahedron_volume(corners[i:i + 8]) for i in range(0, len(corners), 8))
            self.assertAlmostEqual(total / volume, 1.0, delta=0.05)

    def test_any_thread_count_gives_the_same_answer(self):
        answers = []
        for threads in ("1", "2", "4"):
            r = self.decompose("b3_n500", "box:0,0,0,1,1,1", "-j", threads)
            del r["wall_s"]
            answers.append(r)
        self.assertEqual(answers[0], answers[1])
        self.assertEqual(answers[0], answers[2])

    def test_bad_input_is_one_line(self):
        file = DATA / "points_u2_n50.csv"
        self.assert_fails(2, "decompose", file, says=["--domain", "never guessed"])
        self.assert_fails(2, "decompose", file, "--domain", "", says=["--domain has an empty value; give one"])
        self.assert_fails(2, "decompose", file, "--domain", "box:0,0,1", says=["domain 'box:0,0,1'"])
        self.assert_fails(2, "decompose", file, "--domain", "sphere:1", says=["3 dimensions", "2"])
        self.assert_fails(3, "decompose", file, "--domain", "box:0,0,0.5,0.5", says=["50 points lie outside", "--outside drop"])
        self.assert_fails(3, "decompose", self.folder / "none.csv", "--domain", "box:0,1", says=["none.csv"])
        (self.folder / "nan.csv").write_text("x,y\n0.5,nan\n")
        self.assert_fails(3, "decompose", self.folder / "nan.csv", "--domain", "box:0,0,1,1", says=["point 1"])
        (self.folder / "text.csv").write_text("a,b\n0.5,0.1\n")
        self.assert_fails(3, "decompose", self.folder / "text.csv", "--domain", "box:0,0,1,1", says=["'x'"])

    def test_idle_options_are_refused(self):
        command = ["decompose", DATA / "points_u2_n50.csv", "--domain", "box:0,0,1,1"]
        self.assert_fails(2, *command, "--regular", "5", says=["--regular does nothing without --sizes"])
        self.assert_fails(2, *command, "--frame", "3", says=["frame 3: snapshots are those of a LAMMPS dump", "points_u2_n50.csv"])
        self.assert_fails(2, *command, "--dataset", "a", says=["dataset a: arrays are those of an HDF5 file", "points_u2_n50.csv"])
        self.assert_fails(2, *command, "--test-only", "--variant", "fast", says=["--test-only is --variant test"])
        for option in (["--pairs"], ["--mesh", "tree"], ["--beta-dt", "1"], ["--sizes", "2", "-o", self.folder / "o"], ["--crossfit"]):
            for tests in (["--test-only"], ["--variant", "test"]):
                self.assert_fails(2, *command, *option, *tests, says=[f"{option[0]} does nothing with --test-only or --variant test"])
        other = ["agglomerate", DATA / "points_u2_n50.csv", "--domain", "box:0,0,1,1", "--kernel", "constant", "--constant", "1e-5",
                 "--duration", "1s"]
        for line in (command, other):
            self.assert_fails(2, *line, "--charts", "png", says=["--charts does nothing without -o"])
            self.assert_fails(2, *line, "--variable-tolerance", "1", says=["--variable-tolerance does nothing without --variable-column"])
        for option in (["--lower", "joint"], ["--strict"], ["--max-pass", "3"], ["--ghost-samples", "9"]):
            for line in (command, other):
                self.assert_fails(2, *line, *option, says=[f"{option[0]} does nothing with cells of the tree", "--mesh boxes"])
                self.assertEqual(clast(*line, *option, "--mesh", "boxes").code, 0)
        for option in (["--tree-level", "0.02"], ["--tree-root-level", "0.02"], ["--tree-least", "9"], ["--no-tree-refine"], ["--no-extrapolate"]):
            for line in (command, other):
                self.assert_fails(2, *line, *option, "--mesh", "boxes", says=[f"{option[0]} does nothing with cells of bins", "--mesh tree"])
                self.assertEqual(clast(*line, *option).code, 0)
        self.assert_fails(2, *command, "--variant", "fast", "--max-pass", "3", says=["--max-pass does nothing with this --variant"])
        self.assert_fails(2, *command, "--mesh", "boxes", "--pairs-radius", "0.1", says=["--pairs-radius does nothing without --pairs"])
        self.assertEqual(clast(*command, "--pairs-radius", "0.1").code, 0)  # auto may count pairs

    def test_few_and_equal_points_are_told_apart_from_uniform(self):
        write_points(self.folder / "few.csv", [[0.1, 0.2], [0.3, 0.4]])
        few = clast("decompose", self.folder / "few.csv", "--domain", "box:0,0,1,1", "--json").json
        self.assertEqual((few["tests"], few["n_cell"]), ([], 1))
        write_points(self.folder / "equal.csv", [[0.5, 0.25]] * 40)
        for mesh in ("boxes", "tree"):
            equal = clast("decompose", self.folder / "equal.csv", "--domain", "box:0,0,1,1", "--mesh", mesh, "--json")
            self.assertEqual(equal.code, 0, equal.err)
            self.assertTrue(equal.json["reject"])


class Pairs(Case):
    def sheet(self):
        """1000 points in a sheet of sd 0.02: the integral is 1 / (2 sd sqrt(pi)) = 14.1 / m^3."""
        rng = random.Random(3)
        path = self.folder / "sheet.csv"
        write_points(path, [(rng.random(), rng.random(), rng.gauss(0.5, 0.02)) for _ in range(1000)])
        return path

    def test_pairs_are_printed_beside_cells_and_written(self):
        out = self.folder / "out"
        command = ("decompose", self.sheet(), "--domain", "box:0,0,0,1,1,1", "--beta-dt", "1e-6", "--pairs", "--estimator", "cells")
        words = clast(*command, "-o", out)
        self.assertEqual(words.code, 0, words.err)
        self.assertRegex(words.out, r"pairs within [0-9.]+ mm; integral of the squared density .* 1/m\^3")
        self.assertRegex(words.out, r"events by pairs .*, by cells .*; events are those by cells")
        self.assertTrue((out / "pairs.svg").exists())
        note, *rows = (out / "pairs.csv").read_text().splitlines()
        self.assertEqual(note, "# domain box:0,0,0,1,1,1 (m), volume 1 m^3, beta_dt 1e-06 m^3")
        self.assertTrue(rows[0].startswith("r_low_m,r_high_m,pairs,pairs_within,expected,g,g_low,g_high,integral"))
        self.assertEqual(len(rows), 49)
        r = json.loads((out / "summary.json").read_text())
        pairs = r["pairs"]
        self.assertTrue(pairs["resolved"])
        self.assertLess(pairs["integral_low"], 1 / (0.04 * math.sqrt(math.pi)))
        self.assertGreater(pairs["integral_high"], 1 / (0.04 * math.sqrt(math.pi)))
        self.assertAlmostEqual(pairs["events"], 1e-6 * 1000 * 999 / 2 * pairs["integral"], places=9)
        self.assertEqual(sum(pairs["count"]), pairs["n_pair"])
        self.assertTrue(pairs["g_low"][-1] <= pairs["g"][-1] <= pairs["g_high"][-1])

    def test_close_pairs_lie_below_the_cells(self):
        """500 pairs of sd 1 mm: one cell with 500 events at its cap, and g(r) of 4e4 was a warning alone."""
        rng = random.Random(3)
        first = [[rng.random() for _ in range(3)] for _ in range(500)]
        second = [[min(1, max(0, x + rng.gauss(0, 1e-3))) for x in p] for p in first]
        path = self.folder / "close.csv"
        write_points(path, first + second)
        command = ("decompose", path, "--domain", "box:0,0,0,1,1,1", "--beta-dt", "4e-6", "--pairs")
        words = clast(*command)
        self.assertEqual(words.code, 0, words.err)
        self.assertRegex(words.out, r"structure lies below the cells \(edge [0-9.]+ m\): \d+ pairs within [0-9.]+ mm are ")
        self.assertRegex(words.out, r"its own g\(r\) .* may multiply the uniform cells' pair integral alone, [0-9.e+]+ 1/m\^3: .* counts twice")
        pairs = json.loads(clast(*command, "--json").out)["pairs"]
        self.assertTrue(pairs["structure_below_cells"])
        self.assertGreater(pairs["g_within_low"], 1e3)
        self.assertLess(pairs["structure_length"], 8e-3)
        self.assertGreater(pairs["pair_integral_even_cells"], 4.9e5)
        words = clast("decompose", self.even(), "--domain", "box:0,0,0,1,1,1", "--pairs")
        self.assertIn("no structure is seen below the cells", words.out)
        self.assertIn("a kernel with its own g(r) may multiply these events", words.out)

    def even(self):
        rng = random.Random(5)
        path = self.folder / "even.csv"
        write_points(path, [[rng.random() for _ in range(3)] for _ in range(1000)])
        return path

    def test_estimator_says_which_events_count(self):
        command = ("decompose", self.sheet(), "--domain", "box:0,0,0,1,1,1", "--beta-dt", "1e-6", "--json", "--estimator")
        cells, pairs, auto = (clast(*command, e).json for e in ("cells", "pairs", "auto"))
        self.assertNotIn("pairs", cells)
        self.assertEqual(pairs["estimator"], "pairs")
        self.assertEqual(pairs["events"], pairs["pairs"]["events"])
        self.assertAlmostEqual(pairs["pairs"]["events_by_cells"], cells["events"])
        self.assertEqual(auto["estimator"], "pairs")  # cells do not resolve the sheet
        self.assertAlmostEqual(auto["events"], pairs["events"], places=9)
        self.assertAlmostEqual(pairs["smoothing_bias"], auto["smoothing_bias"], delta=1e-9)  # 0 of pairs, though their events are the same
        plain = clast("decompose", self.sheet(), "--domain", "box:0,0,0,1,1,1", "--json", "--estimator", "pairs").json
        self.assertEqual(plain["pair_integral"], plain["pairs"]["pair_integral"])
        self.assertNotIn("events", plain["pairs"])
        refused = clast(*command, "pairs", "--paper")
        self.assertEqual(refused.code, 2)
        self.assertIn("estimator", refused.err)

    def test_lengths_take_their_units(self):
        # --pairs-radius 5mm was "unknown unit 'mm'; known here: -, %"
        command = ["decompose", self.sheet(), "--domain", "box:0,0,0,1,1,1"]
        for text in ("50mm", "0.05", "5 cm", "0.05m"):
            r = clast(*command, "--json", "--pairs", "--pairs-radius", text)
            self.assertEqual((r.code, r.err), (0, ""))
            self.assertAlmostEqual(r.json["pairs"]["radius"], 0.05)
        # no unit was taken, though m^d is asked for
        made = [clast(*command, "--beta-dt", value, "--json").json["beta_dt"] for value in ("1mm3", "1 mm^3", "1e-9m^3", "1e-9")]
        self.assertEqual(made, [1e-9] * 4)
        self.assert_fails(2, *command, "--beta-dt", "1e-9m^2", says=["beta_dt: is in m^2, in 3 dimensions it is in m^3"])
        self.assert_fails(2, *command, "--beta-dt", "1g", says=["beta_dt: unknown unit 'g'; known here: m, cm"])
        flat = ("decompose", DATA / "points_s2_n500.csv", "--domain", "box:0,0,1,1", "--beta-dt")
        self.assertEqual(clast(*flat, "1 mm^2", "--json").json["beta_dt"], 1e-6)
        self.assert_fails(2, *flat, "1e-9m^3", says=["beta_dt: is in m^3, in 2 dimensions it is in m^2"])
        said = self.folder / "beta.yaml"
        said.write_text("beta_dt: 1e-9m^3\n")
        self.assert_fails(2, *flat[:-1], said, says=["in 2 dimensions"])
        self.assertEqual(clast(*flat[:-1], said, "--beta-dt", "1e-9", "--json").code, 0)  # a bare number is of any dimension
        self.assert_fails(2, *command, "--pairs", "--pairs-radius", "5kg", says=["pairs_radius", "known here: m, cm, mm"])
        square = DATA / "points_u2_n50.csv"
        for text in ("10mm", "0.01"):
            r = clast("agglomerate", square, "--domain", "box:0,0,1,1", "--kernel", "brownian", "--monomer-radius", "1um", "--depth", text)
            self.assertEqual((r.code, r.err), (0, ""))
        self.assert_fails(2, "agglomerate", square, "--domain", "box:0,0,1,1", "--constant", "1mm3/s", says=["in 2 dimensions it is in m^2/s"])
        for text in ("1e12", "1e12/m^3", "1e6 1/cm^3"):
            r = clast("agglomerate", "--box-model", "--concentration", text, "--constant", "1e-12")
            self.assertEqual((r.code, r.err), (0, ""))

    def test_radius_is_in_the_unit_of_the_points_and_weights_are_refused(self):
        command = ["decompose", self.sheet(), "--domain", "box:0,0,0,1,1,1", "--json", "--pairs"]
        r = clast(*command, "--pairs-radius", "0.05").json
        self.assertEqual(r["pairs"]["radius"], 0.05)
        self.assertLessEqual(r["pairs"]["window"], 0.05)
        unresolved = ["decompose", DATA / "points_b3_n500.csv", "--domain", "box:0,0,0,1,1,1"]
        cause = "pairs are those within --pairs-radius 1 mm; the distance that is taken without it may resolve more"
        self.assertIn(cause, clast(*unresolved, "--pairs-radius", "1mm").out)
        self.assertNotIn("--pairs-radius", clast(*unresolved).out)
        self.assert_fails(2, *unresolved, "--pairs", "--pairs-radius", "5", says=["pairs_radius 5 m: the domain is 1.73", "as 270um"])
        table = self.folder / "weights.csv"
        table.write_text("x,y,z,w\n0.1,0.1,0.1,1\n0.2,0.2,0.2,2\n0.3,0.3,0.3,3\n")
        refused = clast("decompose", table, "--domain", "box:0,0,0,1,1,1", "--pairs", "--weight-column", "w")
        self.assertEqual(refused.code, 2)
        self.assertIn("weights", refused.err)


if __name__ == "__main__":
    unittest.main()
