#!/usr/bin/env python3
"""Measures grains with published sizes and writes docs/validation/shape.md and .csv: published value, ours, deviation, limit.

usage: tools/paper_shape.py [--clast build/release/clast] [--shared ../shared/data] [--level 5]

Limits were set before the first run: volumes 1e-6 and areas 3e-5 (what an independent quadrature reached), trace ratios half
their last digit, lengths 1 % and widths and thicknesses 15 % (the published ones come from a coarse grid of directions), volume,
area and moments of meshes 2e-5 (single precision), L, I, S of the Rhine scans their printed digits. Nothing is tuned.
"""
import argparse
import csv
import json
import math
import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent

# volume, area, sphericity, convexity and principal moments by an independent NumPy script (data README)
MESHES = {
    "platonic/Tetrahedron.stl": (0.333333231, 3.46410079, 0.671139, 1.0, (0.0333333, 0.0333333, 0.0333333)),
    "platonic/Dodecahedron.stl": (0.427051006, 3.01217123, 0.910453, 1.0, (0.0378418, 0.0378418, 0.0378418)),
    "ellipsoids/Sphere_R_1.stl": (4.18652505, 12.5626137, 0.999938, 1.0, (1.67401, 1.67401, 1.67401)),
    "ellipsoids/Ellipsoid_R_1_2_3.stl": (25.1191503, 48.8675078, 0.848791, 1.0, (25.1101, 50.2202, 65.2862)),
    "grains/sand.stl": (559820.969, 35912.3007, 0.914689, 0.989762, (4.4384e8, 7.43071e8, 8.41474e8)),
    "grains/sand_finer.stl": (559820.969, 35912.3007, 0.914689, 0.989762, (4.4384e8, 7.43071e8, 8.41474e8)),
    "grains/Pear.stl": (299.11732, 237.082537, 0.912317, 0.925786, (1706.57, 2757.14, 2772.34)),
    "grains/stone_0.ply": (0.00166602032, 0.0868154101, 0.782842, 0.900302, (2.93246e-6, 5.34353e-6, 6.76031e-6)),
    "asteroids/castalia.obj": (0.667816841, 4.25568489, 0.868200, 0.920592, (0.0529173, 0.128063, 0.136629)),
    "asteroids/216Kleopatra.obj": (708868.123, 52186.4121, 0.736722, 0.635980, (4.6588e8, 3.17835e9, 3.20472e9)),
    "primitives/box.stl": (1.0, 6.0, 0.805996, 1.0, (0.166667, 0.166667, 0.166667)),
    "primitives/torus.stl": (0.348328029, 3.82577962, 0.625782, 0.681883, (0.0500725, 0.0508343, 0.0946484)),
    "rocks-cad/curiosity_rock1.obj": (0.455757665, 3.15290519, 0.908369, 0.996002, (0.038835, 0.0426676, 0.0629833)),
    "rocks-cad/curiosity_rock2.obj": (1.17583636, 5.68067873, 0.948379, 0.985379, (0.176139, 0.220857, 0.226988)),
    "rocks-cad/offroad_rock2.obj": (7.56781014, 22.9144327, 0.813496, 0.963566, (2.91818, 8.34186, 9.72469)),
    "rocks-cad/offroad_rock4.obj": (10.2249626, 25.0861633, 0.908150, 0.984900, (5.23398, 10.239, 11.4404)),
    "multiformat/convex_polyhedron.ply": (1.0, 5.55690024, 0.870265, 1.0, (0.15883, 0.15883, 0.163764)),
    "multiformat/tsoulis.ply": (2000.0, 1000.0, 0.767663, 1.0, (33333.3, 83333.3, 83333.3)),
}
# volume of the least box that the SHAPE code found (an upper bound by its own word)
BOXES = {
    "platonic/Tetrahedron.stl": 1.0, "platonic/Dodecahedron.stl": 0.89442723, "grains/sand.stl": 1113584.3,
    "grains/Pear.stl": 700.24632, "grains/stone_0.ply": 0.0034102821, "asteroids/castalia.obj": 1.2925743,
    "asteroids/216Kleopatra.obj": 1673902.3, "rocks-cad/curiosity_rock1.obj": 0.83752517,
    "rocks-cad/offroad_rock4.obj": 19.727583,
}
RHINE = {
    "sediment_scan_0.obj": {"volume": 0.86197691, "area": 6.04025, "L": 2.400931, "I": 1.291653, "S": 0.575876, "D": 1.0,
                            "flatness": 0.445844, "elongation": 0.537980, "equancy": 0.239855, "sphericity": 0.7251},
    "sediment_scan_1.obj": {"volume": 1.01632650, "area": 5.57033, "L": 2.044386, "I": 1.074475, "S": 0.919513, "D": 1.0,
                            "flatness": 0.855779, "elongation": 0.525573, "equancy": 0.449774, "sphericity": 0.8776},
}


class Report:
    def __init__(self, arguments):
        self.arguments, self.rows = arguments, []

    def clast(self, *arguments):
        done = subprocess.run([self.arguments.clast, "shape", *map(str, arguments), "--json"], capture_output=True, text=True,
                              check=False)
        if done.returncode != 0:
            raise RuntimeError(done.stderr.strip())
        return json.loads(done.stdout)["grains"]

    def add(self, group, grain, quantity, published, ours, limit):
        """limit: greatest relative deviation; None: the definitions differ, for information."""
        deviation = ours / published - 1.0
        self.rows.append({"group": group, "grain": grain, "quantity": quantity, "published": published, "ours": ours,
                          "deviation": deviation, "limit": limit,
                          "verdict": "" if limit is None else "pass" if abs(deviation) <= limit else "FAIL"})

    def series(self, group, path, degree, published):
        """published: volume, area, trace ratio, length, width, thickness."""
        g = self.clast(path, "--degree", degree, "--axes", "fitted", "--level", self.arguments.level)[0]
        name = path.name
        radius = (3.0 * g["volume"] / (4.0 * math.pi)) ** (1.0 / 3.0)
        # about the series' origin, as the published one: 2 V |c|^2 more than about the centroid
        about_origin = sum(g["moments"]) + 2.0 * g["volume"] * sum(x * x for x in g["centroid"])
        trace = about_origin / (1.2 * g["volume"] * radius ** 2)
        self.add(group, name, "volume", published[0], g["volume"], 1e-6)
        self.add(group, name, "area", published[1], g["area"], 3e-5)
        self.add(group, name, "trace of inertia / sphere's", published[2], trace, 5e-4 / published[2])
        for key, value, limit in zip("LIS", published[3:6], (0.01, 0.15, 0.15)):
            self.add(group, name, f"{key} (fitted)", value, g[key], limit)
        return g


def stones(report, shared):
    folder = shared / "shapes/sh-grains/fdot57"
    with open(folder / "fdot57-geom-A-to-H.dat", encoding="utf-8") as file:
        for row in list(map(str.split, file))[1:]:
            values = [float(row[i]) for i in (7, 8, 11, 14, 15, 16)]
            report.series("FDOT-57 gravel", folder / row[0], int(row[12]), values)


def cement(report, shared):
    folder = shared / "shapes/sh-grains/cement152"
    shape = {}
    with open(folder / "cement152-shapestats-first486.dat", encoding="utf-8") as file:
        for row in list(map(str.split, file))[1:]:
            shape[row[0]] = [float(x) for x in row[1:]]
    with open(folder / "cement152-geom-first486.csv", encoding="utf-8") as file:
        for row in csv.reader(file):
            path = folder / row[0].strip()
            if not path.exists():
                continue
            values = [float(row[i]) for i in (7, 8, 11, 14, 15, 16)]
            g = report.series("cement 152", path, int(row[12]), values)
            if path.name in shape:
                report.add("cement 152", path.name, "roundness (DP)", shape[path.name][11], g["normal_roundness"], None)


def meshes(report, shared):
    for name, (volume, area, sphericity, convexity, moments) in MESHES.items():
        g = report.clast(shared / "shapes" / name)[0]
        for key, value in (("volume", volume), ("area", area), ("sphericity", sphericity), ("convexity", convexity)):
            report.add("surfaces", name, key, value, g[key], 2e-5)
        for k in range(3):
            report.add("surfaces", name, f"moment {k + 1}", moments[k], g["moments"][k], 2e-5)
        if name in BOXES:
            box = g["by_definition"]["box"]
            ours = box["L"] * box["I"] * box["S"]
            report.add("surfaces", name, "least box", BOXES[name], ours, None)
            report.rows[-1]["verdict"] = "pass" if ours <= BOXES[name] * (1.0 + 1e-6) else "FAIL"


def rhine(report, shared):
    for name, values in RHINE.items():
        g = report.clast(shared / "sediment" / name)[0]
        for key, value in values.items():
            digits = 5e-5 if key == "sphericity" else 5e-6 if key == "area" else 6e-7
            report.add("Rhine scans", name, key, value, g[key], digits / value)


WHY = [
    "H-anm-00001 (volume, area, trace: 3 values): the published volume, 2554.96224, is that of degree 24 to every digit (ours at degree 24: 2554.962241); the "
    "table says 26.",
    "L (5 values), I (1) and S (8) of twelve grains: the published triad is not the extreme one. The published search runs on a coarse grid of "
    "directions and its three lines are at right angles only to each other. A triad tilted from our longest caliper by 2 to 12 degrees "
    "and turned about it by up to 20 gives all three published numbers within 2 % for C-5 (0.5 %), D-6, E-6 (0.2 %), F-2, cement 151, 185, 384 "
    "and 576 (level 3 surfaces, which are inscribed and 1 to 2 % small), within 4.6 to 7.5 % for A-3, F-4, H-5 and cement 884, whose widths "
    "change fastest with the tilt. Our longest calipers are nowhere shorter than the published ones by more than the sampling at level 5 "
    "(lowest deviation of L: {low:+.1e}), and calipers equal brute force to 1e-12.",
    "Area of cement 151 (1 value): ours changes by 1e-8 from 120 to 300 nodes, so the published one (its quadrature is not known) is 4e-5 high.",
    "Trace ratios: the published moments are taken about the series' origin, as the published roundness is, and so are ours here. That "
    "was found on cement 525, whose ratio is 1.39346 about its centroid and 1.39351 about the origin (published: 1.394); no other of the 73 grains tells the two "
    "apart, and about the origin all 73 but H-1 (the degree again) round to the published digits.",
]


def summary(rows):
    """Per group and quantity: number, mean and greatest deviation, limit, failures."""
    lines = ["| group | quantity | values | mean deviation | greatest | limit | outside |", "| --- | --- | --- | --- | --- | --- | --- |"]
    keys = list(dict.fromkeys((r["group"], r["quantity"]) for r in rows))
    for group, quantity in keys:
        own = [r for r in rows if (r["group"], r["quantity"]) == (group, quantity)]
        worst = max(own, key=lambda r: abs(r["deviation"]))
        limits = [r["limit"] for r in own if r["limit"] is not None]
        limit = f"{max(limits):.1e}" if limits else ("not above" if any(r["verdict"] for r in own) else "none")
        outside = sum(r["verdict"] == "FAIL" for r in own)
        lines.append(f"| {group} | {quantity} | {len(own)} | {sum(r['deviation'] for r in own) / len(own):+.2e} | "
                     f"{worst['deviation']:+.2e} ({worst['grain']}) | {limit} | {outside} |")
    return lines


def write(report, folder):
    rows = report.rows
    with open(folder / "shape.csv", "w", encoding="utf-8", newline="") as file:
        writer = csv.DictWriter(file, fieldnames=list(rows[0]), lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)
    judged = [r for r in rows if r["verdict"]]
    failed = [r for r in judged if r["verdict"] == "FAIL"]
    text = ["# Size and form: published values beside ours", "",
            f"Made by `tools/paper_shape.py --level {report.arguments.level}`; all {len(rows)} rows are in `shape.csv`. "
            f"{len(judged)} are judged: {len(judged) - len(failed)} pass, {len(failed)} fail.", "",
            "*FDOT-57 gravel*: 49 X-ray scanned stones (NIST), *cement 152*: 24 cement grains, both as spherical harmonics with "
            "published sizes, terms up to the published degree. *surfaces*: values of an independent script, and boxes of the SHAPE "
            "code, which ours may not exceed. *Rhine scans*: two of the grains of Rettinger et al. 2022.",
            "Limits come from the data's own notes: the published lengths, widths and thicknesses were searched on a coarse grid of "
            "directions, so a length may fall short of the true caliper, and a thickness, at right angles to a width that is not the longest, may be "
            "off either way. "
            "*roundness (DP)* is published about the series' origin and ours (`normal_roundness`) about the centroid: not judged.", "",
            *summary(rows)]
    if failed:
        text += ["", "## Outside their limit", "", "| grain | quantity | published | ours | deviation | limit |",
                 "| --- | --- | --- | --- | --- | --- |"]
        text += [f"| {r['grain']} | {r['quantity']} | {r['published']:.9g} | {r['ours']:.9g} | {r['deviation']:+.3e} | "
                 + (f"{r['limit']:.1e} |" if r["limit"] else "not above |") for r in failed]
        low = min(r["deviation"] for r in rows if r["quantity"] == "L (fitted)")
        text += ["", "Causes found:", ""] + ["- " + why.format(low=low) for why in WHY]
    (folder / "shape.md").write_text("\n".join(text) + "\n", encoding="utf-8")
    print(f"{len(rows)} values, {len(judged)} judged, {len(failed)} outside their limit -> {folder / 'shape.md'}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--clast", default=str(ROOT / "build/release/clast"))
    parser.add_argument("--shared", type=pathlib.Path, default=ROOT.parent / "shared/data")
    parser.add_argument("--level", type=int, default=5)
    parser.add_argument("--out", type=pathlib.Path, default=ROOT / "docs/validation")
    report = Report(parser.parse_args())
    shared = report.arguments.shared
    if not shared.exists():
        sys.exit(f"paper_shape: {shared} is not here: the published grains are not part of this repository")
    stones(report, shared)
    cement(report, shared)
    meshes(report, shared)
    rhine(report, shared)
    write(report, report.arguments.out)


main()
