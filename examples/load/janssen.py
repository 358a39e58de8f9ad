#!/usr/bin/env python3
"""Janssen's silo: a cylinder is filled to five heights, its wall moves up by 3 mm so that friction is mobilised everywhere, and the
force on the floor is compared with the closed form, whose two numbers are measured in the same bed.

    m_floor = m_s (1 - exp(-m / m_s)),  m_s = rho_b A D / (4 mu K)

All are of the last state, floor_mean_g of the second half of the way. K is the ratio of the mean radial stress at the wall to the mean vertical stress (sums over contacts of the last state), mu the
ratio of friction to normal force at the wall, rho_b the bulk density of the bed. Nothing is fitted.

    CLAST=build/release/clast python3 examples/load/janssen.py janssen/        (needs h5py and numpy; a few minutes)
"""
import csv
import os
import subprocess
import sys

import h5py
import numpy

CLAST = os.environ.get("CLAST", "clast")
WIDTH = 24e-3
GRAVITY = 9.81


def fill(folder, grams):
    run = os.path.join(folder, f"m{grams}")
    if not os.path.exists(os.path.join(run, "summary.json")):
        subprocess.run([CLAST, "pack", "--curve", "uniform:3.6mm,4.4mm", "--mass", f"{grams}g", "--domain", "cylinder", "--width", f"{WIDTH}m",
                        "--height", "0.25m", "--fluid-density", "0", "--shaking-time", "0", "--shake-amplitude", "0", "--initial-speed", "0.5",
                        "--friction", "0.5", "--contact-scheme", "exact", "--time-step", "1e-5", "--restitution", "0.3", "--wall",
                        "sides move 0,0,20mm/s", "--stages", "sides until way 3mm", "--series-time", "5ms", "--seed", "1", "--quiet",
                        "-o", run], check=True, stdout=subprocess.DEVNULL)
    return run


def measure(run):
    with open(os.path.join(run, "walls.csv"), encoding="utf-8") as file:
        rows = [{k: float(v) for k, v in row.items()} for row in csv.DictReader(file)]
    steady = [row for row in rows if row["sides_z_m"] > 1.5e-3]
    mean = -numpy.mean([row["floor_force_z_N"] for row in steady]) / GRAVITY
    mass = steady[-1]["mass_kg"]
    with h5py.File(os.path.join(run, "state.h5")) as state:
        c = {column.attrs["name"]: numpy.array(column) for column in state["table/contacts"].values()}
        c = {name.decode() if isinstance(name, bytes) else name: column for name, column in c.items()}
        z = numpy.array(state["pack/grain"])[:, 2]
    force = numpy.stack([c[f"force_{k}_N"] for k in "xyz"], 1)
    normal = numpy.stack([c[f"normal_{k}"] for k in "xyz"], 1)
    at_side = (c["b"] < 0) & (numpy.abs(normal[:, 2]) < 0.5)
    pressed = numpy.sum(force[at_side] * normal[at_side])
    friction = abs(numpy.sum(force[at_side, 2]))
    floor = abs(numpy.sum(force[(c["b"] < 0) & ~at_side, 2])) / GRAVITY
    vertical = numpy.sum(c["branch_z_m"] * force[:, 2]) / (numpy.pi * WIDTH ** 2 / 4)  # of stress over height
    height = numpy.quantile(z, 0.98) + 2e-3
    return {"mass": mass, "floor": floor, "mean": mean, "K": pressed / (numpy.pi * WIDTH) / vertical, "mu": friction / pressed, "height": height}


def main(folder):
    os.makedirs(folder, exist_ok=True)
    found = [measure(fill(folder, grams)) for grams in (12, 24, 36, 48, 64)]
    print("mass_g  height_over_D  K      mu     m_s_g  floor_g  janssen_g  floor_mean_g")
    for f in found:
        saturated = f["mass"] / f["height"] * WIDTH / (4 * f["mu"] * f["K"])
        closed = saturated * (1 - numpy.exp(-f["mass"] / saturated))
        print(f"{1e3 * f['mass']:6.2f}  {f['height'] / WIDTH:13.2f}  {f['K']:.3f}  {f['mu']:.3f}  {1e3 * saturated:5.1f}  "
              f"{1e3 * f['floor']:7.2f}  {1e3 * closed:9.2f}  {1e3 * f['mean']:12.2f}")


if __name__ == "__main__":
    main(sys.argv[1] if len(sys.argv) > 1 else "janssen")
