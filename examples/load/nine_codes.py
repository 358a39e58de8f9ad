#!/usr/bin/env python3
"""The three cases that eight open-source DEM codes were compared on (Dosta and others, Computer Physics Communications 296 (2024) 109066), made smaller.

Geometry, densities, moduli, friction and restitution by pairs, and speeds are those of public scripts for the comparison (YADE's, MercuryDPM's, peclet's);
its start files were not at hand, so beds are poured here. Grains are larger by --factor (their number falls with its cube) and their moduli lower by --softer:
those published, 1, ask for steps of 1 us, which 0.1 s of an impact can have and 5 s of a silo had better not.

    CLAST=build/release/clast python3 examples/load/nine_codes.py silo|drum|impact FOLDER [--factor 2] [--softer 50] [--time 5] [--orifice 0.06] [--grains 25000] [--row 0.0025] [--lammps lmp]

Writes FOLDER/CASE.csv. With --lammps (Debian's package lammps) the same silo empties by that program too: FOLDER/silo_lammps.csv.
"""
import argparse
import csv
import json
import math
import os
import random
import subprocess

CLAST = os.environ.get("CLAST", "clast")
COMMON = ["--law", "hertz", "--poisson", "0.2", "--fluid-density", "0", "--shake-amplitude", "0", "--rule", "speed", "--quiet", "-j", "1", "--force"]
YOUNG = {"m1": 1e9, "m2": 5e8, "steel": 2.1e11}  # Pa
CONTACTS = {("m1", "m1"): (0.3, 0.5), ("m1", "m2"): (0.2, 0.45), ("m2", "m2"): (0.4, 0.4), ("m1", "steel"): (0.2, 0.4), ("m2", "steel"): (0.2, 0.4),
            ("steel", "steel"): (0.5, 0.6)}  # friction, restitution


def clast(*arguments):
    out = subprocess.run([CLAST, *map(str, arguments), "--json"], check=True, stdout=subprocess.PIPE)
    return json.loads(out.stdout)


def step_of(diameter, softer):
    """A time step for spheres of M1 (s): a 30th of a collision at 1 m/s, or less."""
    return 5e-3 * diameter * math.sqrt(softer / 200)


def materials(softer, *grains):
    """Options for spheres of these materials, a shape each, between walls of steel."""
    out = [word for name in grains for word in ("--shapes", "sphere", "--material", name)]
    for (a, b), (friction, restitution) in CONTACTS.items():
        for x, y in ([(a, b)] if {a, b} <= set(grains) else []) + ([(a, "walls")] if a in grains and b == "steel" else []):
            young = ",".join(f"{YOUNG[side] / softer:g}" for side in ((a, b) if x != y else (a,)))
            out += ["--contacts", f"{x} {y} friction {friction} restitution {restitution} young {young}"]
    return out


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
    """Rows of a bed that begins: (x, y, z, diameter, density); grains of another density are another shape, in the order in which they come."""
    shapes = {}
    with open(path, "w", encoding="utf-8", newline="") as file:
        out = csv.writer(file)
        out.writerow("shape x_m y_m z_m qw qx qy qz scale density_kg/m^3".split())
        for x, y, z, d, density in grains:
            shape = shapes.setdefault(density, f"{len(shapes) + 1}-sphere")
            out.writerow([shape, x, y, z, 1, 0, 0, 0, d, density])


def loose(n, d, low, sides, round_=False):
    """n places on a loose lattice from `low` on, each off by a random way; sides(z) are its width and depth at a height."""
    chance, pitch, shift = random.Random(1), 1.12 * d, 0.05 * d
    grains, z = [], low
    while True:
        width, depth = sides(z)
        nx, ny = (int((side - 2 * shift) / pitch) for side in (width, depth))
        for i in range(nx + 1):
            for j in range(ny + 1):
                x, y = (i - nx / 2) * pitch, (j - ny / 2) * pitch
                if not round_ or math.hypot(x, y) + shift <= width / 2:
                    grains.append((*(v + chance.uniform(-shift, shift) for v in (x, y, z)), d, 2500))
                    if len(grains) == n:
                        return grains
        z += pitch


def write_rows(path, names, rows):
    with open(path, "w", encoding="utf-8", newline="") as file:
        out = csv.writer(file, lineterminator="\n")
        out.writerow(names)
        out.writerows(["%.6g" % v for v in row] for row in rows)


def table(run, name):
    with open(os.path.join(run, name), encoding="utf-8") as file:
        return [{k: float(v) if k != "shape" else v for k, v in row.items()} for row in csv.DictReader(file)]


LAMMPS = """units si
atom_style sphere
boundary f f f
newton off
comm_modify vel yes
read_data {folder}/lammps.data
pair_style granular
pair_coeff * * hertz/material {young} {e} 0.2 tangential mindlin NULL 1.0 {mu} damping tsuji
neighbor {skin} bin
neigh_modify delay 0 every 1 check yes
timestep {step}
region cone cone z 0 0 {radius} 0.1 {lip} {shoulder} open 1 open 2 units box
region barrel cylinder z 0 0 0.1 {shoulder} 2 open 1 open 2 units box
region inside block -1 1 -1 1 {lip} 3 units box
fix move all nve/sphere
fix weight all gravity 9.81 vector 0 0 -1
fix cone all wall/gran/region {wall} region cone
fix barrel all wall/gran/region {wall} region barrel
fix gate all wall/gran {wall} zplane {lip} NULL
variable n equal count(all,inside)
variable t equal step*dt
thermo_style custom step v_t v_n
thermo_modify lost ignore flush yes
thermo {every}
run {pouring}
unfix gate
run {steps}
"""


def tsuji(restitution):
    """What LAMMPS is asked for so that this is what comes: its `tsuji` of 2021 gives 0.616 for 0.5 and 0.53 for 0.4 (two spheres, a wall), for its polynomial
    is that of another mass than it multiplies. The dashpot that gives `restitution` by Hertz's law is -5^(1/2) ln e / (pi^2 + ln^2 e)^(1/2) [Antypov2011]."""
    ln = math.log(restitution)
    aim, low, high = -math.sqrt(5) * ln / math.hypot(math.pi, ln), 0.0, 1.0
    for _ in range(60):  # Tsuji's polynomial falls from 1.2728 at 0 to 0 at 1
        e = 0.5 * (low + high)
        dashpot = 1.2728 + e * (-4.2783 + e * (11.087 + e * (-22.348 + e * (27.467 + e * (-18.022 + e * 4.8218)))))
        low, high = (e, high) if dashpot > aim else (low, e)
    return e


def silo_by_lammps(lammps, folder, n, diameter, radius, lip, softer, opened, time):
    """The silo from the same places by LAMMPS, whose gate opens at the same time: [(s since then, share of the mass above the lip)]."""
    with open(os.path.join(folder, "silo_start.csv"), encoding="utf-8") as file:
        places = [(row["x_m"], row["y_m"], row["z_m"]) for row in csv.DictReader(file)]
    with open(os.path.join(folder, "lammps.data"), "w", encoding="utf-8") as file:
        file.write(f"silo\n\n{n} atoms\n1 atom types\n-0.12 0.12 xlo xhi\n-0.12 0.12 ylo yhi\n{lip - 0.1} 1 zlo zhi\n\nAtoms # sphere\n\n")
        file.writelines(f"{k + 1} 1 {diameter} 2500 {x} {y} {z}\n" for k, (x, y, z) in enumerate(places))
    step = step_of(diameter, softer)
    young, steel = (YOUNG[side] / softer for side in ("m1", "steel"))
    both = 2 / (1 / young + 1 / steel)  # LAMMPS takes a wall's modulus for both sides
    (mu, e), (mu_wall, e_wall) = CONTACTS["m1", "m1"], CONTACTS["m1", "steel"]
    text = LAMMPS.format(folder=folder, young=young, e=tsuji(e), mu=mu, wall=f"granular hertz/material {both} {tsuji(e_wall)} 0.2 tangential mindlin NULL 1.0 {mu_wall} damping tsuji",
                         skin=0.1 * diameter, step=step, radius=radius, lip=lip, shoulder=lip + 0.1 - radius, every=round(0.02 / step),
                         pouring=round(opened / step), steps=round(time / step))
    path = os.path.join(folder, "silo.lammps")
    with open(path, "w", encoding="utf-8") as file:
        file.write(text)
    log = subprocess.run([lammps, "-in", path, "-log", "none"], check=True, stdout=subprocess.PIPE, text=True, env={**os.environ, "OMP_NUM_THREADS": "1"}).stdout
    rows = [line.split() for line in log.splitlines()]
    rows = [(float(row[1]) - opened, int(row[2]) / n) for row in rows if len(row) == 3 and row[0].isdigit() and row[2].isdigit()]
    return sorted(row for row in dict(rows).items() if row[0] > -1e-9)


def outflow(rows, begin, end):
    """Slope of the mass inside by least squares, from begin to end [1/s]."""
    rows = [row for row in rows if begin <= row[0] <= end]
    t, m = (sum(row[c] for row in rows) / len(rows) for c in (0, 1))
    return -sum((x - t) * (y - m) for x, y in rows) / sum((x - t) ** 2 for x, _ in rows)


def silo(folder, options):
    """Cylinder of radius 0.1 m, cone of 45 degrees to an orifice of 0.06 or 0.04 m: 100,000 spheres of 4 mm leave."""
    radius = options.orifice / 2
    cone = 0.1 - radius
    lip = -0.0554222 if radius > 0.025 else -0.0593008
    diameter, n, softer = 4e-3 * options.factor, round(100000 / options.factor ** 3), options.softer or 200
    v, t = rings([0.1, 0.1, radius], [lip + cone + 0.5, lip + cone, lip])
    write_off(os.path.join(folder, "silo.off"), v, t)
    v, t = rings([radius + 5e-4], [lip + 1e-6])
    capped(v, t, 0)
    write_off(os.path.join(folder, "gate.off"), v, t)
    run = os.path.join(folder, "silo")
    mass = n * 2500 * math.pi / 6 * diameter ** 3
    write_start(os.path.join(folder, "silo_start.csv"), loose(n, diameter, lip + 0.6 * diameter, lambda z: (2 * (min(0.1, radius + z - lip) - 0.75 * diameter),) * 2, round_=True))
    clast("pack", *COMMON, "--start", f"{folder}/silo_start.csv", *materials(softer, "m1"), "--time-step", step_of(diameter, softer),
          "--still-speed", "0.03", "--shaking-time", "0", "--domain", "cylinder", "--width", "0.1999m", "--height", "1m", "--floor=no", "--wall", f"silo {folder}/silo.off m",
          "--wall", f"gate {folder}/gate.off m", "--outlet", f"z<{lip - diameter}m", "--stages", f"open gate until time {options.time or 5}s",
          "--series-time", "0.02s", "-o", run)
    rows = [row for row in table(run, "walls.csv") if row["stage"] == 1]
    rows = [(row["time_s"] - rows[0]["time_s"], row["mass_kg"] / mass) for row in rows]
    write_rows(os.path.join(folder, "silo.csv"), ("time_s", "mass_inside"), rows)
    end = min(3.5, rows[-1][0])  # the comparison's own times are 0.5 to 3.5 s
    rate = round(mass * outflow(rows, 0.5, end), 9)
    with open(os.path.join(folder, "rate.json"), "w", encoding="utf-8") as file:
        json.dump({"n": n, "diameter_m": diameter, "orifice_m": options.orifice, "softer": softer, "rate_kg/s": rate}, file)
    beverloo = 0.58 * 0.6 * 2500 * 9.81 ** 0.5 * max(0.0, options.orifice - 1.5 * diameter) ** 2.5
    print(f"{n} spheres of {1e3 * diameter:g} mm, orifice {1e3 * options.orifice:g} mm: {rate:.4f} kg/s from 0.5 to {end:.2f} s; "
          f"C rho_b sqrt(g) (D - k d)^2.5 with C 0.58, k 1.5, rho_b 0.6 of 2500 (Beverloo, a flat bottom): {beverloo:.4f} kg/s; "
          f"{100 * rows[-1][1]:.1f} % inside after {rows[-1][0]:.2f} s")
    if options.lammps:
        start = next(row["time_s"] for row in table(run, "walls.csv") if row["stage"] == 1)
        theirs = silo_by_lammps(options.lammps, folder, n, diameter, radius, lip, softer, start, rows[-1][0])
        write_rows(os.path.join(folder, "silo_lammps.csv"), ("time_s", "mass_inside"), theirs)
        print(f"LAMMPS: {mass * outflow(theirs, 0.5, end):.4f} kg/s from 0.5 to {end:.2f} s; {100 * theirs[-1][1]:.1f} % inside after {theirs[-1][0]:.2f} s")


def drum(folder, options):
    """Drum of radius 0.1 m and depth 0.06 m, 2 rad/s, up at x > 0: 30,000 spheres of 2 mm (2500 kg/m3) lie on 8,000 of 4 mm (2000 kg/m3)."""
    factor, time, softer = options.factor, options.time or 5.0, options.softer or 200
    step = step_of(2e-3 * factor, softer)
    v, t = rings([0.1, 0.1], [-0.03, 0.03], along_y=True)
    capped(v, t, 0)
    capped(v, t, 1)
    write_off(os.path.join(folder, "drum.off"), v, t)
    grains, z = [], -0.085
    for d, density, n in ((4e-3 * factor, 2000, round(8000 / factor ** 3)), (2e-3 * factor, 2500, round(30000 / factor ** 3))):
        pitch = 1.05 * d
        while n > 0:
            across = math.sqrt(max(0.0, (0.099 - 0.5 * d) ** 2 - (abs(z) + 0.5 * d) ** 2))
            for i in range(-int(across / pitch), int(across / pitch) + 1):
                rows = int((0.06 - d) / pitch) + 1
                for j in range(rows):
                    if n > 0:
                        grains.append((i * pitch, (j - (rows - 1) / 2) * pitch, z, d, density))
                        n -= 1
            z += pitch
            assert z < 0.08, "the drum is full: take a greater factor"
    write_start(os.path.join(folder, "drum.csv"), grains)
    run = os.path.join(folder, "drum")
    bed = ["pack", *COMMON, "--start", f"{folder}/drum.csv", *materials(softer, "m2", "m1"), "--still-speed", "0.03", "--time-step", step, "--shaking-time", "0", "--container",
           f"{folder}/drum.off", "--container-unit", "m", "--floor=no", "--wall", "container axis 0,-1,0 rotate 2rad/s", "-o", run]
    clast(*bed, "--stages", "container until time 1us")
    begun = table(run, "walls.csv")[-1]["step"]
    clast(*bed, "--stages", f"container until time {time}s", "--max-steps", int(begun))
    out, n = [], round(5 * time)
    for k in range(n + 1):
        if k:
            clast("pack", "--resume", run, "--quiet", *(["--max-steps", int(begun + k / (5 * step))] if k < n else []))
        zones = {}
        for row in table(run, "grains.csv"):
            small = row["sieve_size_m"] < 3e-3 * factor
            zone = 1 if row["x_m"] > 0 and row["z_m"] > 0 else 2 if row["x_m"] < 0 and row["z_m"] < 0 else 0
            zones[small, zone] = zones.get((small, zone), 0) + 1
        of = {which: sum(v for (s, _), v in zones.items() if s == which) for which in (True, False)}
        out.append((k / 5, *(zones.get((s, i), 0) / of[s] for i in (1, 2) for s in (True, False))))
        write_rows(os.path.join(folder, "zones.csv"), ("time_s", "small_zone_1", "large_zone_1", "small_zone_2", "large_zone_2"), out)
        print("%5.2f s turned: share of the small and large grains in zone 1 (x, z > 0) %.4f, %.4f, in zone 2 (x, z < 0) %.4f, %.4f" % out[-1], flush=True)


def struck(folder, grains, softer, step, name, speed, *more):
    """A run of these grains and a sphere of steel 0.15 m above the floor that a plate strikes down at this speed."""
    v, t = rings([0.02], [BEGIN + 0.01])
    capped(v, t, 0)
    write_off(os.path.join(folder, "plate.off"), v, t)
    with open(os.path.join(folder, "plate.csv"), "w", encoding="utf-8") as file:
        file.write(f"time_s,z_m\n0,0\n0.004,{-0.004 * speed}\n")
    write_start(os.path.join(folder, name + ".csv"), [*grains, (0.0, 0.0, BEGIN, 0.02, 7200.0)])
    run = os.path.join(folder, name)
    clast("pack", *COMMON, "--start", f"{folder}/{name}.csv", *materials(softer, *["m1"] * bool(grains), "steel"), "--time-step", step, *BOX, "--height", "0.4m", "--shaking-time", "1s",
          "--wall", f"plate {folder}/plate.off m table {folder}/plate.csv", "--wall-forces", "--series-time", "0.5ms", "-o", run, *more)
    return run


def height(run):
    rows = table(run, "grains.csv")
    return max(rows, key=lambda row: row["sieve_size_m"])["z_m"]


BEGIN = 0.0902431 + 0.06  # m above the floor
BOX = ["--domain", "box", "--width", "0.1m", "--depth", "0.06m"]


def impact(folder, options):
    """A steel sphere (20 mm, 7200 kg/m3) comes at 5 m/s, 0.15 m above the floor of a box of 0.1 by 0.06 m, onto 25,000 or 100,000 spheres of 2 mm (2500 kg/m3).

    Grains of a start are at rest: a plate strikes the sphere, at the speed that alone gives it 5 m/s."""
    d, n, time, softer = 2e-3 * options.factor, round(options.grains / options.factor ** 3), options.time or 0.1, options.softer or 50
    step = step_of(d, softer)
    lying = loose(n, d, 0.6 * d, lambda z: (0.1 - d, 0.06 - d))
    for k in sorted({500.0, max(20.0, softer), softer}, reverse=True):  # what weight presses together does not fly apart once moduli are higher
        write_start(os.path.join(folder, "bed.csv"), lying)
        bed = os.path.join(folder, f"bed{k:g}")
        clast("pack", *COMMON, "--start", f"{folder}/bed.csv", *materials(k, "m1"), "--time-step", step_of(d, k), *BOX, "--height", "0.6m",
              "--still-speed", "0.05", "--shaking-time", "0", "-o", bed)
        lying = [(row["x_m"], row["y_m"], row["z_m"], d, 2500.0) for row in table(bed, "grains.csv")]
    top = sorted(g[2] for g in lying)[-n // 100] + d / 2
    print(f"{n} spheres of {1e3 * d:g} mm, top of the bed {1e3 * top:.1f} mm above the floor", flush=True)
    speed, flown, late = 10 / 3, 0.008, 0.0
    for _ in range(3):  # the sphere alone: 5 m/s where it would have begun, `late` after the start of the run
        run = struck(folder, [], softer, step, "alone", speed, "--max-steps", round(flown / step))
        first = height(run)
        clast("pack", "--resume", run, "--quiet", "--max-steps", round(2 * flown / step))
        v = (first - height(run)) / (step * (round(2 * flown / step) - round(flown / step))) - 9.81 * 1.5 * flown
        t = (-5 + math.sqrt(25 + 2 * 9.81 * (BEGIN - first))) / 9.81
        late = round(flown / step) * step - t
        v = v + 9.81 * late
        print(f"plate at {speed:.4f} m/s: sphere at {v:.4f} m/s, {1e3 * late:.3f} ms late", flush=True)
        speed *= 5 / v
    out = []
    for k in range(1, round(time / options.row) + 1):
        steps = ["--max-steps", round((late + k * options.row) / step)]
        if k == 1:
            run = struck(folder, lying, softer, step, "impact", speed, *steps)
        else:
            clast("pack", "--resume", run, "--quiet", *steps)
        out.append((k * options.row, height(run) - BEGIN))
        write_rows(os.path.join(folder, "way.csv"), ("time_s", "displacement_m"), [(0, 0), *out])
        print("%6.4f s: %8.2f mm" % (out[-1][0], 1e3 * out[-1][1]), flush=True)
    force = max((-row["floor_force_z_N"], row["time_s"] - late) for row in table(run, "walls.csv"))
    least = min(out, key=lambda row: row[1])
    print(f"deepest {1e3 * least[1]:.1f} mm at {least[0]:.4f} s, {1e3 * out[-1][1]:.1f} mm at {out[-1][0]:.4f} s; "
          f"greatest force on the floor {force[0]:.0f} N (mean of 0.5 ms) at {force[1]:.4f} s")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("case", choices=("silo", "drum", "impact"))
    parser.add_argument("folder")
    parser.add_argument("--factor", type=float, default=4)
    parser.add_argument("--softer", type=float)
    parser.add_argument("--time", type=float)
    parser.add_argument("--orifice", type=float, choices=(0.06, 0.04), help="of the silo (default 0.06 m)")
    parser.add_argument("--grains", type=int, help="of the impact's bed (default 25000)")
    parser.add_argument("--row", type=float, help="time between rows of the impact (default 0.0025 s)")
    parser.add_argument("--lammps", help="the silo by this program too")
    options = parser.parse_args()
    for name, case in (("orifice", "silo"), ("lammps", "silo"), ("grains", "impact"), ("row", "impact")):
        if getattr(options, name) is not None and options.case != case:
            parser.error(f"--{name} acts on the {case} alone")
    if options.case == "silo" and options.time is not None and options.time < 0.6:
        parser.error("--time: the outflow is measured from 0.5 s on, give 0.6 s or more")
    options.orifice, options.grains, options.row = options.orifice or 0.06, options.grains or 25000, options.row or 0.0025
    os.makedirs(options.folder, exist_ok=True)
    {"silo": silo, "drum": drum, "impact": impact}[options.case](options.folder, options)


if __name__ == "__main__":
    main()
