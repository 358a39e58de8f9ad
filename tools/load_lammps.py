#!/usr/bin/env python3
"""Beds of examples/load/beside_lammps.py as the table and picture of docs/validation/load.md.

python3 tools/load_lammps.py FOLDER... [--library build/release/libclast_view.so] [-o docs/validation/load_lammps]

Means over the beds of both programs' pressures and deviators, and of the differences of deviators with their standard errors.
"""
import argparse
import csv
import math
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import chart  # noqa: E402

NAMES = ("clast_pressure_Pa", "lammps_pressure_Pa", "clast_deviator_Pa", "lammps_deviator_Pa")


def read(folder):
    with open(folder / "beside.csv", encoding="utf-8") as file:
        return [{k: float(v) for k, v in row.items()} for row in csv.DictReader(file)]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=pathlib.Path, nargs="+")
    parser.add_argument("--library", type=pathlib.Path)
    parser.add_argument("-o", "--output", type=pathlib.Path, default=pathlib.Path("load_lammps"))
    options = parser.parse_args()
    beds = [read(folder) for folder in options.folder]
    n, rows = len(beds), []
    for at in zip(*beds):
        off = [row["clast_deviator_Pa"] - row["lammps_deviator_Pa"] for row in at]
        middle = sum(off) / n
        error = math.sqrt(sum((x - middle) ** 2 for x in off) / max(1, n * (n - 1)))
        rows.append((at[0]["strain_z"], *(sum(row[k] for row in at) / n for k in NAMES), middle, error))
    with open(options.output.with_suffix(".csv"), "w", encoding="utf-8") as file:
        file.write("strain_z," + ",".join(NAMES) + ",difference_of_deviators_Pa,its_standard_error_Pa\n")
        file.writelines(",".join(f"{x:.6g}" for x in row[:5]) + f",{row[5]:.3g},{row[6]:.2g}\n" for row in rows)
    greatest = max(row[4] for row in rows)
    early = [max(abs(r["clast_deviator_Pa"] - r["lammps_deviator_Pa"]) for r in bed if r["strain_z"] <= 0.0251) / greatest for bed in beds]
    worst = [max(abs(r["clast_deviator_Pa"] - r["lammps_deviator_Pa"]) for r in bed) / greatest for bed in beds]
    score = sum((row[5] / row[6]) ** 2 for row in rows) / len(rows) if n > 1 else math.nan
    print(f"{n} beds: deviators differ by {100 * min(early):.2f} to {100 * max(early):.2f} % of the greatest up to a strain of 2.5 %, by {100 * min(worst):.1f} to "
          f"{100 * max(worst):.1f} % at most; their means by {100 * max(abs(row[5]) for row in rows) / greatest:.2f} % at most, {math.sqrt(score):.1f} standard errors in the root mean square")
    if options.library:
        chart.draw(options.library, options.output.with_suffix(".svg"), f"Triaxial test at constant volume, means of {n} beds", "axial strain (-)", "stress (Pa)",
                   [chart.line(f"{word}, clast", colour, [(row[0], row[1 + 2 * colour]) for row in rows]) for colour, word in enumerate(("pressure", "deviator"))]
                   + [chart.points(f"{word}, LAMMPS", colour, [(row[0], row[2 + 2 * colour]) for row in rows]) for colour, word in enumerate(("pressure", "deviator"))])


if __name__ == "__main__":
    main()
