#!/usr/bin/env python3
"""The run of examples/load/jamming.yaml as the table and picture of docs/validation/load.md, and what its powers are.

python3 tools/load_jamming.py FOLDER [--library build/release/libclast_view.so] [-o docs/validation/load_jamming]

Of each stage the last row. Pressure and contacts less 6 are powers of the solid fraction less that of jamming, which is fitted with the power of
the pressure (least squares of logarithms) over the pressures of a range.
"""
import argparse
import csv
import math
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import chart  # noqa: E402
import load_nine  # noqa: E402

RANGES = ((1e5, 2e3), (5e4, 1e3), (1e4, 5e2), (1e5, 5e1), (1e4, 5e1), (2e3, 5e1))  # Pa, from and to


def slope(xy):
    """Slope of the straight line of least squares, and the sum of squares that is left."""
    b, at_zero = load_nine.fit(xy)
    return b, sum((y - at_zero - b * x) ** 2 for x, y in xy)


def powers(rows):
    """Solid fraction at jamming, power of p, of the contacts less 6, and of these over p."""
    least = min(r["solid"] for r in rows)

    def of(jammed, key, less=0.0):
        return slope([(math.log(r["solid"] - jammed), math.log(r[key] - less)) for r in rows])

    jammed = min((least - 1e-7 * 1e5 ** (k / 4000) for k in range(4001)), key=lambda j: of(j, "pressure_Pa")[1])
    over_p = slope([(math.log(r["pressure_Pa"]), math.log(r["coordination_held"] - 6)) for r in rows])[0]
    return jammed, of(jammed, "pressure_Pa")[0], of(jammed, "coordination_held", 6)[0], over_p


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--library", type=pathlib.Path)
    parser.add_argument("-o", "--output", type=pathlib.Path, default=pathlib.Path("load_jamming"))
    options = parser.parse_args()
    with open(options.folder / "load.csv", encoding="utf-8") as file:
        last = {row["stage"]: {k: float(v) for k, v in row.items()} for row in csv.DictReader(file)}
    rows = [{**r, "solid": 1 - r["porosity"]} for r in last.values()]
    names = ("pressure_Pa", "solid", "coordination_held", "n_rattler")
    with open(options.output.with_suffix(".csv"), "w", encoding="utf-8") as file:
        file.write(",".join(names) + "\n" + "".join(f"{r['pressure_Pa']:.6g},{r['solid']:.6f},{r['coordination_held']:.4f},{r['n_rattler']:.0f}\n" for r in rows))
    print("| fitted to pressures | solid fraction at jamming | power of p (known: 1) | power of contacts less 6 (known: 0.5) | the same over p |\n| --- | --- | --- | --- | --- |")
    for high, low in RANGES:
        within = [r for r in rows if 0.95 * low <= r["pressure_Pa"] <= 1.05 * high]
        print("| {:g} kPa to {:g} Pa | {:.5f} | {:.2f} | {:.2f} | {:.2f} |".format(high / 1e3, low, *powers(within)))
    print("energy: rest over what was put in, at most %.1g" % max(abs(r["energy_rest_J"]) / r["energy_put_in_J"] for r in rows))
    if options.library:
        jammed = powers(rows)[0]
        chart.draw(options.library, options.output.with_suffix(".svg"), "Frictionless spheres above the jamming point", f"solid fraction less {jammed:.4f} (-)",
                   "over that at 100 kPa (-)",
                   [chart.points(label, colour, [(r["solid"] - jammed, (r[key] - less) / (rows[0][key] - less)) for r in rows])
                    for colour, (label, key, less) in enumerate((("pressure", "pressure_Pa", 0), ("contacts a grain less 6", "coordination_held", 6)))]
                   + [chart.line(f"power {power:g}", colour, [(x, (x / (rows[0]["solid"] - jammed)) ** power) for x in (3e-5, rows[0]["solid"] - jammed)], dashed=True)
                      for colour, power in enumerate((1, 0.5))],
                   x_log=True, y_log=True)


if __name__ == "__main__":
    main()
