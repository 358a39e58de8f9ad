#!/usr/bin/env python3
"""What is left of the porosity by form under load: load.csv of each run of examples/load/form-small.yaml (or form-full.yaml) as one table
and one picture.

python3 tools/load_forms.py form-small [--library build/release/libclast_view.so] [-o docs/validation/load_forms]

Writes NAME.csv (a row a curve, form and pressure: porosity and its standard error, contacts without rattlers, means over seeds) and, with the
library, NAME.svg. Prints what is left of each curve's difference between hulls and ellipsoids.
"""
import argparse
import csv
import json
import math
import pathlib
import statistics
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import chart  # noqa: E402


def stages(run):
    """The last row of each stage: (pressure, porosity, contacts without rattlers, mean overlap of the cell's strain)."""
    last = {}
    with open(run / "load.csv", encoding="utf-8") as file:
        for row in csv.DictReader(file):
            last[int(float(row["stage"]))] = row
    wanted = json.loads((run / "manifest.json").read_text())["config"]["stages"]
    for number, row in sorted(last.items()):
        value = wanted[number - 1].split()[1]
        if not value.endswith("Pa") or not wanted[number - 1].endswith("rest"):  # on the way to the first pressure
            continue
        unit = value.lstrip("0123456789.")
        pressure = float(value[:-len(unit)]) * {"Pa": 1, "kPa": 1e3, "MPa": 1e6}[unit]
        if abs(float(row["pressure_Pa"]) / pressure - 1) < 0.02:  # a stage that was cut off has not reached it
            yield pressure, float(row["porosity"]), float(row["coordination_held"])


def gather(folder):
    """(curve, form, pressure): [(porosity, contacts), a seed each], seeds in order."""
    found = {}
    for manifest in sorted(folder.glob("**/manifest.json")):
        run = manifest.parent
        if (run / "load.csv").exists():
            config = json.loads(manifest.read_text())["config"]
            curve = "U7 below 8 mm" if config["curve"].endswith("u7-fine.csv") else config["curve"]
            form = "ellipsoids" if config["ellipsoids"] else "hulls"
            for pressure, *values in stages(run):
                found.setdefault((curve, form, pressure), []).append(values)
    return found


def mean(values, k):
    return statistics.mean(v[k] for v in values)


def standard_error(values):
    """Of the mean porosity over seeds; NaN of one."""
    return statistics.stdev(v[0] for v in values) / math.sqrt(len(values)) if len(values) > 1 else math.nan


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--library", type=pathlib.Path)
    parser.add_argument("-o", "--output", type=pathlib.Path, default=pathlib.Path("load_forms"))
    options = parser.parse_args()
    found = gather(options.folder)
    if not found:
        raise SystemExit(f"{options.folder}: no run with a load.csv")
    with open(options.output.with_suffix(".csv"), "w", encoding="utf-8") as file:
        file.write("curve,form,pressure_Pa,n,porosity,porosity_error,coordination_held\n")
        for (curve, form, pressure), values in sorted(found.items()):
            porosity, error, held = mean(values, 0), standard_error(values), mean(values, 1)
            file.write(f"{curve},{form},{pressure:g},{len(values)},{porosity:.5f},{'' if math.isnan(error) else f'{error:.5f}'},{held:.4f}\n")
            print(f"{curve:18s} {form:10s} {pressure / 1e3:8g} kPa  porosity {porosity:.4f} +- {error:.4f}  contacts {held:.3f}")
    for curve, pressure in sorted({(c, p) for c, _, p in found}):
        two = [found.get((curve, form, pressure), []) for form in ("hulls", "ellipsoids")]
        if all(two):
            print(f"{curve:18s} hulls less ellipsoids {pressure / 1e3:8g} kPa  {mean(two[0], 0) - mean(two[1], 0):+.4f} "
                  f"+- {math.hypot(*map(standard_error, two)):.4f}")
    for curve, form in sorted({(c, f) for c, f, _ in found}):
        pressures = sorted(p for c, f, p in found if (c, f) == (curve, form))
        ends = [found[curve, form, p] for p in (pressures[0], pressures[-1])]
        lost = [(a[0] - b[0],) for a, b in zip(*ends)]  # of each bed: pressed on, so its luck is the same at both ends
        if len(ends[0]) == len(ends[1]):
            print(f"{curve:18s} {form:10s} lose {mean(lost, 0):.4f} +- {standard_error(lost):.4f} from {pressures[0] / 1e3:g} to {pressures[-1] / 1e3:g} kPa ({len(lost)} beds)")
    if options.library:
        names = sorted({(curve, form) for curve, form, _ in found})
        series = []
        for i, (curve, form) in enumerate(names):
            own = [(p / 1e3, values) for (c, f, p), values in sorted(found.items()) if (c, f) == (curve, form)]
            xy = [(p, mean(values, 0)) for p, values in own]
            series += [chart.line(f"{curve}, {form}", i // 2, xy, dashed=form == "ellipsoids"),
                       chart.points(None, i // 2, xy, [standard_error(values) for _, values in own])]
        chart.draw(options.library, options.output.with_suffix(".svg"), "Porosity under load", "pressure (kPa)", "porosity (-)", series,
                   x_log=True)


if __name__ == "__main__":
    main()
