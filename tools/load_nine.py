#!/usr/bin/env python3
"""Runs of examples/load/nine_codes.py as the tables and pictures of docs/validation/load.md, beside what is published.

python3 tools/load_nine.py FOLDER [--library build/release/libclast_view.so] [-o docs/validation/load]

FOLDER holds folders silo*, drumFACTOR, impactFACTOR (25,000 spheres of 2 mm) and deepFACTOR (100,000), one a run. Writes NAME_silo.csv, NAME_rates.csv, NAME_drum.csv and NAME_impact.csv, with the library
NAME_silo.svg, NAME_drum.svg and NAME_impact.svg.
"""
import argparse
import csv
import json
import math
import pathlib
import re
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import chart  # noqa: E402

# Of 100,000 spheres of 4 mm, 8.38 kg: mean of eight codes, 23,200 spheres a second, all within 5 %.
EIGHT = 23200 * 2500 * math.pi / 6 * 4e-3 ** 3


def read(path):
    with open(path, encoding="utf-8") as file:
        return [{k: float(v) for k, v in row.items()} for row in csv.DictReader(file)]


def write(path, names, rows):
    with open(path, "w", encoding="utf-8", newline="") as file:
        out = csv.writer(file, lineterminator="\n")
        out.writerow(names)
        out.writerows([v if isinstance(v, str) else "%.6g" % v for v in row] for row in rows)


def fit(xy):
    """Slope and value at 0 by least squares."""
    n, mx, my = len(xy), sum(x for x, _ in xy) / len(xy), sum(y for _, y in xy) / len(xy)
    slope = sum((x - mx) * (y - my) for x, y in xy) / sum((x - mx) ** 2 for x, _ in xy)
    return slope, my - slope * mx


def silos(folder, name, library):
    rates, curves = [], []
    for run in sorted(folder.glob("silo*")):
        result = json.loads((run / "rate.json").read_text())
        ours, theirs = read(run / "silo.csv"), read(run / "silo_lammps.csv") if (run / "silo_lammps.csv").exists() else []
        mass = result["n"] * 2500 * math.pi / 6 * result["diameter_m"] ** 3
        late = [[(r["time_s"], -mass * r["mass_inside"]) for r in rows if 0.5 <= r["time_s"] <= 3.5] for rows in (ours, theirs)]
        for program, xy in zip(("clast", "LAMMPS"), late):  # the head falls, and the rate a little with it
            spans = [[p for p in xy if begin <= p[0] <= begin + 1] for begin in (0.5, 1.5, 2.5)]
            if xy:
                print(f"{run.name}, {program}: " + ", ".join(f"{fit(span)[0]:.3f} ({span[0][0]:.1f} to {span[-1][0]:.1f} s)" for span in spans if len(span) > 9) + " kg/s")
        result["lammps"] = fit(late[1])[0] if late[1] else ""
        rates.append(result)
        if result["orifice_m"] == 0.06:
            curves.append((result["diameter_m"], [(r["time_s"], r["mass_inside"]) for r in read(run / "silo.csv")]))
    rates.sort(key=lambda r: (-r["orifice_m"], r["diameter_m"]))
    wide = [r for r in rates if r["orifice_m"] == 0.06]
    slope, at_zero = fit([(r["diameter_m"], r["rate_kg/s"] ** 0.4) for r in wide])  # W^0.4 = a (D - k d)
    k = -slope * 0.06 / at_zero
    c = (at_zero / 0.06) ** 2.5 / (0.6 * 2500 * math.sqrt(9.81))
    small = (at_zero + slope * 4e-3) ** 2.5
    write(f"{name}_rates.csv", ("orifice_m", "diameter_m", "n", "rate_kg/s", "by_the_fit_kg/s", "lammps_kg/s"),
          [(r["orifice_m"], r["diameter_m"], r["n"], r["rate_kg/s"], (at_zero * (r["orifice_m"] - k * r["diameter_m"]) / 0.06) ** 2.5, r["lammps"]) for r in rates])
    curves.sort()
    write(f"{name}_silo.csv", ("diameter_m", "time_s", "mass_inside"), [(d, *p) for d, xy in curves for p in xy])
    worst = max(abs((at_zero + slope * r["diameter_m"]) ** 2.5 / r["rate_kg/s"] - 1) for r in wide)
    print(f"silo: W = C rho_b sqrt(g) (D - k d)^2.5 with C {c:.3f}, k {k:.3f} (rho_b 1500 kg/m3), off by {100 * worst:.2f} % at most; "
          f"for d = 4 mm {small:.3f} kg/s, eight codes {EIGHT:.3f} kg/s: {100 * (small / EIGHT - 1):+.1f} %")
    if library:
        lines = [chart.line(f"{1e3 * d:g} mm", i, xy) for i, (d, xy) in enumerate(curves)]
        lines.append(chart.line("4 mm, eight codes (mean rate)", len(lines), [(0.15, 1.0), (4.0, 1 - 0.232 * 3.85)], dashed=True))
        chart.draw(library, f"{name}_silo.svg", "Silo, orifice of 60 mm", "time since it is open (s)", "mass inside (-)", lines)


def drums(folder, name, library):
    runs = {run.name: read(run / "zones.csv") for run in sorted(folder.glob("drum*"))}
    write(f"{name}_drum.csv", ("run", *next(iter(runs.values()))[0]), [(run, *r.values()) for run, rows in runs.items() for r in rows])
    lines = []
    for run, rows in runs.items():
        small = [(r["time_s"], r["small_zone_2"]) for r in rows]
        turns = [(x, y) for (_, a), (x, y), (_, b) in zip(small, small[1:], small[2:]) if (y - a) * (b - y) <= 0 and y != a]
        print(f"{run}: small grains in zone 2 turn at " + ", ".join(f"{x:.1f} s ({y:.3f})" for x, y in turns))
        lines.append(chart.line(f"small, {2 * float(re.sub('[a-z]', '', run)):g} mm", len(lines), small))
    if library:
        lines.append(chart.points("small of 2 mm, LIGGGHTS: troughs", len(lines), [(1.4, 0.0), (3.4, 0.0)]))
        chart.draw(library, f"{name}_drum.svg", "Drum: share of grains in zone 2 (x, z < 0)", "time turned (s)", "share (-)", lines)


def impacts(folder, name, library):
    runs = sorted(folder.glob("impact*")) + sorted(folder.glob("deep*"))
    curves = {run.name: [(r["time_s"], r["displacement_m"]) for r in read(run / "way.csv")] for run in runs}
    write(f"{name}_impact.csv", ("run", "time_s", "displacement_m"), [(run, *p) for run, xy in curves.items() for p in xy])
    for run, xy in curves.items():
        least = min(xy, key=lambda p: p[1])
        print(f"{run}: deepest {1e3 * least[1]:.1f} mm at {least[0]:.4f} s, {1e3 * xy[-1][1]:.1f} mm at {xy[-1][0]:.3f} s")
    if library:
        lines = [chart.line(f"{'deep bed, ' if run[0] == 'd' else ''}{2 * float(re.sub('[a-z]', '', run)):g} mm", i, [(t, 1e3 * z) for t, z in xy])
                 for i, (run, xy) in enumerate(curves.items())]
        lines.append(chart.points("deepest: LIGGGHTS, MUSEN", len(lines), [(0.03, -139), (0.03, -138)]))
        lines.append(chart.points("deep bed, at rest: LIGGGHTS, MUSEN", len(lines), [(0.1, -90.5), (0.1, -90.9)]))
        chart.draw(library, f"{name}_impact.svg", "Way of a sphere that strikes a bed", "time (s)", "displacement (mm)", lines)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--library", type=pathlib.Path)
    parser.add_argument("-o", "--output", default="load")
    options = parser.parse_args()
    for part in (silos, drums, impacts):
        part(options.folder, options.output, options.library)


if __name__ == "__main__":
    main()
