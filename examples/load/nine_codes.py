#!/usr/bin/env python3
"""The three cases that nine DEM codes were compared on (Dosta and others, Computer Physics Communications 296 (2024) 109066), made smaller.

Geometry, densities, friction and speeds are those of public scripts of the comparison (YADE's, examples/DEM2020Benchmark; MercuryDPM's);
its start files and its curves were not at hand, so beds are poured here and no published curve stands beside the numbers. Grains are larger by
--factor (their number falls with its cube), the modulus is lower (1e9 Pa there), and one restitution stands for its three to five.

    CLAST=build/release/clast python3 examples/load/nine_codes.py silo|drum|impact FOLDER [--factor 4] [--time 1]
"""
import argparse
import csv
import json
import math
import os
import subprocess

CLAST = os.environ.get("CLAST", "clast")
STEP = "2e-5"  # s, silo and drum
COMMON = ["--law", "hertz", "--poisson", "0.2", "--fluid-density", "0", "--restitution", "0.5", "--friction", "0.3", "--wall-friction", "0.2",
          "--shaking-time", "0", "--shake-amplitude", "0", "--rule", "speed", "--still-speed", "0.03", "--quiet"]


def clast(*arguments):
    out = subprocess.run([CLAST, *map(str, arguments), "--json"], check=True, stdout=subprocess.PIPE)
    return json.loads(out.stdout)


def write_off(path, vertices, triangles):
    with open(path, "w", encoding="utf-8") as file:
        file.write(f"OFF\n{len(vertices)} {len(triangles)} 0\n")
        file.writelines("%.9g %.9g %.9g\n" % v for v in vertices)
        file.writelines("3 %d %d %d\n" % t for t in triangles)


def rings(radii, heights, along_y=False, n=64):
    """Rings one after the other, joined by triangles."""
    vertices, triangles = [], []
    for k, (r, h) in enumerate(zip(radii, heights)):
        for i in range(n):
            a, b = r * math.cos(2 * math.pi * i / n), r * math.sin(2 * math.pi * i / n)
            vertices.append((a, h, b) if along_y else (a, b, h))
        for i in range(n if k else 0):
            p, q = (k - 1) * n, k * n
            j = (i + 1) % n
            triangles += [(p + i, p + j, q + j), (p + i, q + j, q + i)]
    return vertices, triangles


def capped(vertices, triangles, which, n=64):
    """A disc over ring `which`."""
    ring = vertices[which * n:(which + 1) * n]
    middle = tuple(sum(v[c] for v in ring) / n for c in range(3))
    vertices.append(middle)
    triangles += [(which * n + i, which * n + (i + 1) % n, len(vertices) - 1) for i in range(n)]


def write_start(path, grains):
    """Rows of a bed that begins: (x, y, z, diameter, density)."""
    with open(path, "w", encoding="utf-8", newline="") as file:
        out = csv.writer(file)
        out.writerow("shape x_m y_m z_m qw qx qy qz scale density_kg/m^3".split())
        for x, y, z, d, density in grains:
            out.writerow(["1-sphere", x, y, z, 1, 0, 0, 0, d / 2, density])


def table(run, name):
    with open(os.path.join(run, name), encoding="utf-8") as file:
        return [{k: float(v) if k != "shape" else v for k, v in row.items()} for row in csv.DictReader(file)]


def silo(folder, factor, time):
    """Cylinder of radius 0.1 m, cone of 0.07 m to an orifice of radius 0.03 m: 100,000 spheres of 4 mm leave."""
    lip, cone, top = -0.0554222, 0.07, 0.3146
    diameter, n = 4e-3 * factor, round(100000 / factor ** 3)
    v, t = rings([0.1, 0.1, 0.03], [top + 0.2, lip + cone, lip])
    write_off(os.path.join(folder, "silo.off"), v, t)
    v, t = rings([0.0305], [lip + 1e-6])
    capped(v, t, 0)
    write_off(os.path.join(folder, "gate.off"), v, t)
    run = os.path.join(folder, "silo")
    mass = n * 2500 * math.pi / 6 * diameter ** 3
    result = clast("pack", *COMMON, "--curve", f"{diameter}m", "--mass", f"{mass}kg", "--density", "2500", "--young", "5e6", "--time-step", STEP,
                   "--domain", "cylinder", "--width", "0.1999m", "--height", "0.5m", "--floor=no", "--wall", f"silo {folder}/silo.off m", "--wall",
                   f"gate {folder}/gate.off m", "--outlet", f"z<{lip - diameter}m", "--stages", f"open gate until time {time}s", "--series-time",
                   "0.05s", "--force", "-o", run)
    rows = [row for row in table(run, "walls.csv") if row["stage"] == 1]
    print(f"{n} spheres of {1e3 * diameter:g} mm; time after opening, number inside")
    for row in rows[:: max(1, len(rows) // 20)]:
        print(f"{row['time_s'] - rows[0]['time_s']:6.3f} s  {row['n_grain']:6.0f}")
    first, last = rows[len(rows) // 4], rows[3 * len(rows) // 4]
    rate = (first["mass_kg"] - last["mass_kg"]) / (last["time_s"] - first["time_s"])
    print(f"discharge {rate:.3f} kg/s; C rho_b sqrt(g) (D - k d)^2.5 with C 0.58, k 1.5, rho_b 0.6 of 2500 (Beverloo, a flat bottom): "
          f"{0.58 * 0.6 * 2500 * 9.81 ** 0.5 * max(0.0, 0.06 - 1.5 * diameter) ** 2.5:.3f} kg/s; {result['n_left']} left")


def drum(folder, factor, time):
    """Drum of radius 0.1 m and depth 0.06 m, 2 rad/s: 30,000 spheres of 2 mm (2500 kg/m3) lie on 8,000 of 4 mm (2000 kg/m3)."""
    v, t = rings([0.1, 0.1], [-0.03, 0.03], along_y=True)
    capped(v, t, 0)
    capped(v, t, 1)
    write_off(os.path.join(folder, "drum.off"), v, t)
    grains, z = [], -0.085
    for d, density, n in ((4e-3 * factor, 2000, round(8000 / factor ** 3)), (2e-3 * factor, 2500, round(30000 / factor ** 3))):
        step = 1.05 * d
        while n > 0:
            across = math.sqrt(max(0.0, (0.099 - 0.5 * d) ** 2 - (abs(z) + 0.5 * d) ** 2))
            for i in range(-int(across / step), int(across / step) + 1):
                rows = int((0.06 - d) / step) + 1
                for j in range(rows):
                    if n > 0:
                        grains.append((i * step, (j - (rows - 1) / 2) * step, z, d, density))
                        n -= 1
            z += step
            assert z < 0.08, "the drum is full: take a greater factor"
    write_start(os.path.join(folder, "drum.csv"), grains)
    run = os.path.join(folder, "drum")
    steps = None
    for k in range(6):
        if k == 0:
            clast("pack", *COMMON, "--start", f"{folder}/drum.csv", "--young", "5e6", "--time-step", STEP, "--container",
                  f"{folder}/drum.off", "--container-unit", "m", "--floor=no", "--wall", "container axis 0,-1,0 rotate 2rad/s", "--stages",
                  "container until time 1us", "--force", "-o", run)
            steps = table(run, "walls.csv")[-1]["step"]
            clast("pack", *COMMON, "--start", f"{folder}/drum.csv", "--young", "5e6", "--time-step", STEP, "--container",
                  f"{folder}/drum.off", "--container-unit", "m", "--floor=no", "--wall", "container axis 0,-1,0 rotate 2rad/s", "--stages",
                  f"container until time {time}s", "--force", "-o", run, "--max-steps", int(steps))
        else:
            clast("pack", "--resume", run, "--quiet", *(["--max-steps", int(steps + k * time / 5 / float(STEP))] if k < 5 else []))
        zones = {}
        for row in table(run, "grains.csv"):
            small = row["sieve_size_m"] < 3e-3 * factor
            zone = 1 if row["x_m"] > 0 and row["z_m"] > 0 else 2 if row["x_m"] < 0 and row["z_m"] < 0 else 0
            zones[small, zone] = zones.get((small, zone), 0) + 1
        print(f"{k * time / 5:5.2f} s turned: small and large in zone 1 (x, z > 0) {zones.get((True, 1), 0)}, {zones.get((False, 1), 0)}; "
              f"in zone 2 (x, z < 0) {zones.get((True, 2), 0)}, {zones.get((False, 2), 0)}")


def impact(folder, factor, time):
    """A steel sphere (7200 kg/m3) meets a bed of spheres (2500 kg/m3) at 5 m/s: here one of 20 mm, 25,000 / factor^3 spheres of 2 mm times factor, a box of 0.1 m."""
    d, n = 2e-3 * factor, round(25000 / factor ** 3)
    mass = n * 2500 * math.pi / 6 * d ** 3
    bed, run = os.path.join(folder, "bed"), os.path.join(folder, "impact")
    clast("pack", *COMMON, "--curve", f"{d}m", "--mass", f"{mass}kg", "--density", "2500", "--young", "2e7", "--time-step", "5e-6", "--domain", "box",
          "--width", "0.1m", "--height", "0.15m", "--force", "-o", bed)
    lying = [row for row in table(bed, "grains.csv")]
    grains = [(row["x_m"], row["y_m"], row["z_m"], d, 2500.0) for row in lying]
    top = max(g[2] for g in grains) + d / 2
    fall = 5.0 ** 2 / (2 * 9.81)
    write_start(os.path.join(folder, "impact.csv"), [*grains, (0.0, 0.0, top + 0.01 + fall, 0.02, 7200.0)])
    met = math.sqrt(2 * fall / 9.81)
    for k in range(11):
        steps = ["--max-steps", int((met + k * time / 10) / 5e-6)]
        if k == 0:
            clast("pack", *COMMON, "--start", f"{folder}/impact.csv", "--young", "2e7", "--time-step", "5e-6", "--domain", "box",
                  "--width", "0.1m", "--height", "2m", "--shaking-time", f"{met + time}s", "--force", "-o", run, *steps)
        else:
            clast("pack", "--resume", run, "--quiet", *steps)
        ball = max(table(run, "grains.csv"), key=lambda row: row["sieve_size_m"])
        print(f"{k * time / 10:6.4f} s after the impact: lowest point of the sphere {1e3 * (top - ball['z_m'] + 0.01):7.2f} mm below the bed's top")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("case", choices=("silo", "drum", "impact"))
    parser.add_argument("folder")
    parser.add_argument("--factor", type=float, default=4)
    parser.add_argument("--time", type=float)
    options = parser.parse_args()
    os.makedirs(options.folder, exist_ok=True)
    case, usual = {"silo": (silo, 1.0), "drum": (drum, 1.0), "impact": (impact, 0.05)}[options.case]
    case(options.folder, options.factor, options.time or usual)


if __name__ == "__main__":
    main()
