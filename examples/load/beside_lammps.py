#!/usr/bin/env python3
"""A triaxial test at constant volume of the same spheres by clast and by LAMMPS, and their stresses side by side.

python3 examples/load/beside_lammps.py --clast build/release/clast --lammps lmp --seed 1 --finer 1 -o beside/     (10 s of one core)

500 frictionless spheres are pressed to 10 kPa by clast and exported as a LAMMPS data file; both programs then start from it with friction
0.5 and compress it along z by 10 % while x and y extend by half as much each. Contact law: linear spring and dashpot with tangential
history (clast: law linear; LAMMPS: pair_style gran/hooke/history), the same constants. With --finer N springs are N^2 times as stiff. Writes beside.csv.
"""
import argparse
import csv
import json
import math
import pathlib
import subprocess

DIAMETER, DENSITY, MASS = 4e-3, 2650.0, 44.4e-3
RESTITUTION, COLLISION, POISSON, FRICTION = 0.1, 2e-4, 0.22, 0.5
STEP, RATE, STRAIN = 5e-6, 0.5, 0.1
COMMON = ["--domain", "cell", "--floor=no", "--gravity", "0", "--fluid-density", "0", "--restitution", RESTITUTION, "--poisson", POISSON, "-j", "1",
          "--quiet", "--force"]

LAMMPS = """units si
atom_style sphere
boundary p p p
newton off
comm_modify vel yes
read_data {data}
change_box all x final {x0} {x1} y final {y0} {y1} z final {z0} {z1}
{law}
neighbor 0.5e-3 bin
neigh_modify delay 0 every 1 check yes
timestep {dt}
fix move all nve/sphere
fix strain all deform 1 x trate {half} y trate {half} z trate -{rate} remap v
compute s all pressure NULL pair
variable e equal {rate}*step*dt
thermo_style custom step v_e c_s[1] c_s[2] c_s[3]
thermo_modify format float %.10g
thermo {every}
run {steps}
"""


LAWS = {"gran/hooke/history": "pair_style gran/hooke/history {kn} {kt} {gn} {gt} {mu} 1\npair_coeff * *",
        "granular": "pair_style granular\npair_coeff * * hooke {kn} {gn} tangential linear_history {kt} {xt} {mu} damping mass_velocity"}


def clast(program, *arguments):
    result = subprocess.run([program, *map(str, arguments)], capture_output=True, text=True, check=False)
    if result.returncode not in (0, 5):
        raise SystemExit(f"clast {arguments[0]}: {result.stderr}")
    return result.stdout


def constants(collision):
    """Of two equal spheres: LAMMPS takes springs as they are, dashpots a reduced mass."""
    reduced = 0.5 * DENSITY * math.pi / 6 * DIAMETER ** 3
    log = math.log(RESTITUTION)
    kn = reduced * (math.pi ** 2 + log ** 2) / collision ** 2
    kappa = 2 * (1 - POISSON) / (2 - POISSON)
    gn = -2 * log / collision
    return {"kn": kn, "kt": kappa * kn, "gn": gn, "gt": math.sqrt(kappa) * gn, "xt": math.sqrt(kappa), "mu": FRICTION}


def run_clast(program, options, out):
    pressed = out / "pressed"
    common = [*COMMON, "--collision-time", f"{COLLISION / options.finer}s", "--time-step", f"{STEP / options.finer}s"]
    clast(program, "pack", *common, "--curve", f"{DIAMETER}m", "--mass", f"{MASS}kg", "--width", "40mm", "--height", "40mm", "--friction", 0,
          "--seed", options.seed, "--stages", "isotropic 10kPa until rest", "-o", pressed)
    clast(program, "export", pressed, "-o", out / "bed.data")
    cell = json.loads((pressed / "summary.json").read_text())["cell"]
    clast(program, "pack", *common, "--start", out / "bed.data", "--start-unit", "m", "--friction", FRICTION,
          "--width", f"{cell['width']!r}m", "--depth", f"{cell['depth']!r}m", "--height", f"{cell['height']!r}m", "--series-time", "5ms",
          "--stages", f"x=-{RATE / 2}/s y=-{RATE / 2}/s z={RATE}/s until strain {STRAIN}", "-o", out / "sheared")
    with open(out / "sheared/load.csv", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    return cell, [(float(r["strain_z"]), *(float(r[f"stress_{k}_Pa"]) for k in ("xx", "yy", "zz"))) for r in rows]


def run_lammps(program, finer, law, out, cell):
    script = out / "triaxial.in"
    law = LAWS[law].format(**constants(COLLISION / finer))
    script.write_text(LAMMPS.format(data=out / "bed.data", x0=-cell["width"] / 2, x1=cell["width"] / 2, y0=-cell["depth"] / 2,
                                    y1=cell["depth"] / 2, z0=0, z1=cell["height"], dt=STEP / finer, rate=RATE, half=RATE / 2, every=1000 * finer,
                                    steps=round(STRAIN / RATE / STEP) * finer, law=law), encoding="utf-8")
    result = subprocess.run([program, "-in", str(script), "-log", str(out / "lammps.log"), "-screen", "none"], check=False)
    if result.returncode:
        raise SystemExit(f"LAMMPS failed: see {out / 'lammps.log'}")
    rows = []
    for line in (out / "lammps.log").read_text().splitlines():
        words = line.split()
        if len(words) == 5 and words[0].isdigit():
            rows.append(tuple(map(float, words[1:])))
    return rows


def at(rows, strain, k):
    for a, b in zip(rows, rows[1:]):
        if a[0] <= strain <= b[0]:
            return a[k] + (b[k] - a[k]) * (strain - a[0]) / (b[0] - a[0])
    return rows[-1][k]


def compare(ours, theirs, path):
    """Pressures and deviators at 20 strains; the greatest difference of deviators, that up to 2.5 %, and the greatest deviator."""
    worst, early, greatest = 0.0, 0.0, 0.0
    with open(path, "w", encoding="utf-8") as file:
        file.write("strain_z,clast_pressure_Pa,lammps_pressure_Pa,clast_deviator_Pa,lammps_deviator_Pa\n")
        for k in range(1, 21):  # at 0 clast's table has no contacts yet
            strain = STRAIN * k / 20
            s = [[at(rows, strain, i) for i in (1, 2, 3)] for rows in (ours, theirs)]
            p = [sum(x) / 3 for x in s]
            q = [x[2] - (x[0] + x[1]) / 2 for x in s]
            file.write(f"{strain:.4g},{p[0]:.6g},{p[1]:.6g},{q[0]:.6g},{q[1]:.6g}\n")
            worst, greatest = max(worst, abs(q[0] - q[1])), max(greatest, q[1])
            early = worst if strain <= 0.0251 else early
    return worst, early, greatest


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--clast", default="build/release/clast")
    parser.add_argument("--lammps", default="lmp")
    parser.add_argument("--seed", default="1")
    parser.add_argument("--law", choices=tuple(LAWS), default="gran/hooke/history", help="of LAMMPS: its arms are radii, or end half-way in the overlap")
    parser.add_argument("--finer", type=int, default=1, help="collisions and steps are so many times shorter, springs stiffer by the square")
    parser.add_argument("-o", "--output", type=pathlib.Path, default=pathlib.Path("beside"))
    options = parser.parse_args()
    options.output.mkdir(parents=True, exist_ok=True)
    cell, ours = run_clast(options.clast, options, options.output)
    theirs = run_lammps(options.lammps, options.finer, options.law, options.output, cell)
    worst, early, greatest = compare(ours, theirs, options.output / "beside.csv")
    print(f"{len(ours)} and {len(theirs)} rows; deviators differ by {100 * worst / greatest:.2f} % of the greatest at most, "
          f"{100 * early / greatest:.3f} % up to a strain of 2.5 %")


if __name__ == "__main__":
    main()
