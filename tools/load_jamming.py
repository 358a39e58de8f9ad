#!/usr/bin/env python3
"""Runs of examples/load/jamming.yaml as the table and picture of docs/validation/load.md, and what its powers are.

python3 tools/load_jamming.py FOLDER... [--library build/release/libclast_view.so] [-o docs/validation/load_jamming]

Of each stage the last row. Pressure and contacts above balance are powers of the solid fraction less that of jamming, which is fitted with the
power of the pressure (least squares of logarithms) over the pressures of a range, bed by bed; then means and standard errors over the beds.
Balance of N frictionless spheres in a periodic cell needs 3 (N - 1) contacts, 6 - 6/N a grain [Goodrich2012].
"""
import argparse
import csv
import math
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import chart  # noqa: E402
import load_nine  # noqa: E402

RANGES = ((1e5, 2e3), (1e4, 5e2), (2e3, 5e1), (1e5, 5e1))  # Pa, from and to


def slope(xy):
    """Slope of the straight line of least squares, and the sum of squares that is left."""
    b, at_zero = load_nine.fit(xy)
    return b, sum((y - at_zero - b * x) ** 2 for x, y in xy)


def powers(rows):
    """Solid fraction at jamming, power of p, of the contacts above balance, and of these over p."""
    least = min(r["solid"] for r in rows)

    def of(jammed, key):
        return slope([(math.log(r["solid"] - jammed), math.log(r[key])) for r in rows])

    jammed = min((least - 1e-7 * 1e5 ** (k / 4000) for k in range(4001)), key=lambda j: of(j, "pressure_Pa")[1])
    over_p = slope([(math.log(r["pressure_Pa"]), math.log(r["excess"])) for r in rows])[0]
    return jammed, of(jammed, "pressure_Pa")[0], of(jammed, "excess")[0], over_p


def read(folder):
    """The last row of each stage."""
    with open(folder / "grains.csv", encoding="utf-8") as file:
        n_grain = sum(1 for line in file if line[0] != "#") - 1
    with open(folder / "load.csv", encoding="utf-8") as file:
        last = {row["stage"]: {k: float(v) for k, v in row.items()} for row in csv.DictReader(file)}
    for row in last.values():
        row["solid"] = 1 - row["porosity"]
        row["excess"] = row["coordination_held"] - 6 + 6 / (n_grain - row["n_rattler"])
    return list(last.values())


def mean(values, digits):
    n, middle = len(values), sum(values) / len(values)
    error = math.sqrt(sum((v - middle) ** 2 for v in values) / (n * (n - 1))) if n > 1 else 0
    return f"{middle:.{digits}f} ± {error:.{digits}f}" if n > 1 else f"{middle:.{digits}f}"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=pathlib.Path, nargs="+")
    parser.add_argument("--library", type=pathlib.Path)
    parser.add_argument("-o", "--output", type=pathlib.Path, default=pathlib.Path("load_jamming"))
    options = parser.parse_args()
    beds = [read(folder) for folder in options.folder]
    names = ("pressure_Pa", "solid", "coordination_held", "n_rattler")
    with open(options.output.with_suffix(".csv"), "w", encoding="utf-8") as file:
        file.write("bed," + ",".join(names) + "\n")
        for k, rows in enumerate(beds):
            file.writelines(f"{k + 1},{r['pressure_Pa']:.6g},{r['solid']:.6f},{r['coordination_held']:.4f},{r['n_rattler']:.0f}\n" for r in rows)
    print("| fitted to pressures | solid fraction at jamming | power of p (known: 1) | power of contacts above balance (known: 0.5) | the same over p |")
    print("| --- | --- | --- | --- | --- |")
    for high, low in RANGES:
        found = list(zip(*(powers([r for r in rows if 0.95 * low <= r["pressure_Pa"] <= 1.05 * high]) for rows in beds)))
        print(f"| {high / 1e3:g} kPa to {low:g} Pa | {mean(found[0], 4)} | {mean(found[1], 3)} | {mean(found[2], 3)} | {mean(found[3], 3)} |")
    print("least contacts above balance: " + mean([rows[-1]["excess"] for rows in beds], 4) + ", rattlers " + mean([rows[-1]["n_rattler"] for rows in beds], 1))
    booked = [abs(r["energy_rest_J"]) / r["energy_put_in_J"] for rows in beds for r in rows if "energy_rest_J" in r]
    if booked:
        print(f"energy: rest over what was put in, at most {max(booked):.1g}")
    if options.library:
        at = [(rows, powers(rows)[0]) for rows in beds]
        widest = max(rows[0]["solid"] - jammed for rows, jammed in at)
        chart.draw(options.library, options.output.with_suffix(".svg"), f"Frictionless spheres above the jamming point, {len(beds)} beds",
                   "solid fraction less that of jamming (-)", "over that at 100 kPa (-)",
                   [chart.points(label, colour, [(r["solid"] - jammed, r[key] / rows[0][key]) for rows, jammed in at for r in rows])
                    for colour, (label, key) in enumerate((("pressure", "pressure_Pa"), ("contacts a grain above balance", "excess")))]
                   + [chart.line(f"power {power:g}", colour, [(x, (x / widest) ** power) for x in (3e-5, widest)], dashed=True)
                      for colour, power in enumerate((1, 0.5))],
                   x_log=True, y_log=True)


if __name__ == "__main__":
    main()
