#!/usr/bin/env python3
"""code_saturne with clast in its time loop: makes the meshes, runs the cases, draws the tables. Standard library only.

usage: examples/code_saturne/drive.py [PART...] [-o FOLDER] [--build FOLDER] [--keep]

Parts, all by default: small (the least case: does it run?), meshes (four meshes by three numbers of parcels, the
solver's own agglomeration beside clast's), ranks (one and two), cost (of a call), growth (parcels grow, mass
balanced), pipe (the half pipe of Martinez Rodriguez et al. 2021, section 4.4). Tables go to FOLDER
(build/code_saturne); --build has clast's library (build/release). Needs code_saturne 6.0: tools/setup.sh saturne.
"""
import argparse
import concurrent.futures
import csv
import math
import os
import pathlib
import shutil
import subprocess
import sys
import time

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
sys.path[:0] = [str(HERE), str(ROOT / "tools")]
import chart  # noqa: E402
import meshes  # noqa: E402

DUCT = (.4, .1, .1)  # m
CELLS = ((8, 2, 2), (20, 8, 8), (40, 16, 16), (64, 24, 24))
PARCELS = (200, 1000, 5000)  # a step
PARTICLES = 200000  # real ones a step
DUCT_SETTINGS = {
    "task": "count", "steps": 20, "dt": .01, "velocity": (1, 0, 0), "hydraulic_diameter": .1, "density": 1.2,
    "viscosity": 1.8e-5, "period": 1, "diameter": 1e-5, "particle_density": 1000, "kernel": 1e-11, "every": 1, "spare": 0,
    "domain": "box:0,0,0,0.4,0.1,0.1"}  # air at 1 m/s; particles of 10 um
# Water at Re 1e4 by the diameter; sets of parcels are told apart by their weight: one every second step, 1, 2, 5 a step.
PIPE = {"radius": .1, "length": 1., "source": .01, "fine": 2, "layers": 50}
PIPE_SETTINGS = DUCT_SETTINGS | {
    "task": "snapshot", "steps": 2000, "velocity": (0, 0, .05), "hydraulic_diameter": .2, "density": 1000, "viscosity": 1e-3,
    "parcels": (1, 1, 2, 5), "period": (2, 1, 1, 1), "weight": (1, 2, 3, 4), "domain": "half-pipe:0.1,1"}
PRINTED = (955, 1920, 3820, 9580)


class Study:
    """A folder of cases, and the library that their user sources are linked with."""

    def __init__(self, folder, build):
        self.folder, self.build = folder.resolve(), build.resolve()
        self.pipe = None  # the half pipe's run, once it is begun
        if shutil.which("code_saturne") is None:
            sys.exit("drive.py: code_saturne is not installed: tools/setup.sh saturne (Debian: code-saturne, code-saturne-include)")
        if not (self.build / "libclast.so").exists():
            sys.exit(f"drive.py: {self.build}/libclast.so is not there; build it: tools/build.sh release libclast.so")

    def run(self, name, write_mesh, settings, ranks=1):
        """Runs one case; returns the rows of its events.csv and its folder. Ends where the solver fails."""
        case = self.folder / name / "case"
        shutil.rmtree(case.parent, ignore_errors=True)
        for sub in (case / "RESU", case.parent / "MESH"):
            sub.mkdir(parents=True)
        for sub in ("DATA", "SRC"):
            shutil.copytree(HERE / sub, case / sub)
        write_mesh(case.parent / "MESH" / "mesh.msh")
        (case / "DATA" / "build.txt").write_text(f"mesh.msh\n{ROOT / 'include'}\n{self.build}\n")
        (case / "DATA" / "settings.txt").write_text("".join(
            f"{key} {' '.join(map(str, value)) if isinstance(value, tuple) else value}\n" for key, value in settings.items()))
        environment = os.environ | {"USER": os.environ.get("USER", "user"), "OMP_NUM_THREADS": "1",
                                    "OMPI_MCA_rmaps_base_oversubscribe": "1", "OMPI_MCA_hwloc_base_binding_policy": "none"}
        if os.geteuid() == 0:  # Open MPI asks twice
            environment |= {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
        begun = time.monotonic()
        done = subprocess.run(["code_saturne", "run", "--id", "run", "-n", str(ranks)], cwd=case, env=environment,
                              capture_output=True, text=True)
        result = case / "RESU" / "run"
        (result / "summary").unlink(missing_ok=True)  # it holds the whole environment
        if done.returncode != 0 or not (result / "events.csv").exists():
            sys.exit(f"drive.py: {name}: code_saturne ended with {done.returncode}; see {result}/error and compile.log\n{done.stdout[-600:]}")
        print(f"{name}: {time.monotonic() - begun:.1f} s", file=sys.stderr)
        with open(result / "events.csv", newline="") as f:
            return [{k: float(v) for k, v in row.items()} for row in csv.DictReader(f)], result

    def duct(self, name, cells, parcels, ranks=1, **changes):
        settings = DUCT_SETTINGS | {"parcels": parcels, "weight": PARTICLES / parcels} | changes
        return self.run(name, lambda path: meshes.write_duct(path, DUCT, cells), settings, ranks)[0]

    def write_table(self, name, rows):
        with open(self.folder / name, "w", newline="") as f:
            out = csv.DictWriter(f, rows[0].keys(), lineterminator="\n")
            out.writeheader()
            out.writerows(rows)
        print(f"{self.folder / name}")


def show(rows):
    """A table of a few rows on stdout."""
    cells = [list(rows[0])] + [[str(v) for v in row.values()] for row in rows]
    width = [max(len(line[k]) for line in cells) for k in range(len(cells[0]))]
    for line in cells:
        print("  ".join(text.rjust(w) for text, w in zip(line, width)))


def front_events(settings, step):
    """Events of one step were particles even behind a sharp front: beta dt n^2 / 2 V."""
    volume = settings["velocity"][0] * step * settings["dt"] * DUCT[1] * DUCT[2]
    return settings["kernel"] * settings["dt"] * (PARTICLES * step) ** 2 / (2 * volume)


def part_small(study):
    row = study.duct("small", CELLS[0], 200)[-1]
    even = front_events(DUCT_SETTINGS, 20)
    print(f"{row['parcels']:.0f} parcels, {row['events']:.1f} events by clast, {even:.1f} were they even behind a sharp front")
    if not .85 * even < row["events"] < 1.15 * even:
        sys.exit("drive.py: small: the events are not those of the particles")


def part_meshes(study):
    rows = []
    cases = [(cells, parcels) for cells in CELLS for parcels in PARCELS]
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:  # a case a core, the largest first
        jobs = {case: pool.submit(study.duct, f"meshes-{math.prod(case[0])}-{case[1]}", *case, task="own", every=20) for case in reversed(cases)}
    for cells, parcels in cases:
        row = jobs[cells, parcels].result()[-1]
        rows.append({"cells": math.prod(cells), "parcels_a_step": parcels, "own_events": round(row["own_events"]),
                     "per_cell_law": f"{row['per_solver_cell']:.1f}", "clast_events": f"{row['events']:.1f}",
                     "clast_low": f"{row['events_low']:.1f}", "clast_high": f"{row['events_high']:.1f}", "clast_cells": int(row["n_cell"])})
    show(rows)
    study.write_table("meshes.csv", rows)
    draw_meshes(study, rows)


def draw_meshes(study, rows):
    library = study.build / "libclast_view.so"
    if not library.exists():
        print(f"drive.py: no figure: {library} is not there", file=sys.stderr)
        return
    series = []
    for colour, parcels in enumerate(PARCELS):
        mine = [r for r in rows if r["parcels_a_step"] == parcels]
        series.append(chart.line(f"code_saturne, {parcels} parcels a step", colour, [(r["cells"], r["own_events"]) for r in mine], True))
        series.append(chart.line(f"clast, {parcels}", colour, [(r["cells"], float(r["clast_events"])) for r in mine]))
    chart.draw(library, study.folder / "meshes.svg", "Events of one time step, the same 4 million particles", "cells of the solver",
               "events", series, x_log=True, y_log=True)
    print(study.folder / "meshes.svg")


def part_ranks(study):
    """Gathered on every rank, and from each rank's own points where libclast_mpi is built."""
    rows = []
    for ranks in (1, 2):
        row = study.duct(f"ranks-{ranks}", CELLS[1], 1000, ranks, task="ranks", every=20)[-1]
        rows.append({"ranks": ranks, "parcels": int(row["parcels"]), "events": f"{row['events']:.2f}", "low": f"{row['events_low']:.1f}",
                     "high": f"{row['events_high']:.1f}", "own_points": f"{row['own_points']:.2f}" if row["own_points"] >= 0 else "not built"})
    show(rows)
    study.write_table("ranks.csv", rows)


def part_cost(study):
    """CPU time of clast beside a step of the solver with 4000 parcels in 10,240 cells, once the duct is full; and what is spared costs in events."""
    rows, exact = [], {}
    for spare, every in ((0, 1), (1, 1), (2, 1)):
        found = study.duct(f"cost-{spare}-{every}", CELLS[2], 100, steps=150, spare=spare, every=every)
        full = [r for r in found if r["step"] > 50]
        exact = exact or {r["step"]: r["events"] for r in full}
        off = [r["events"] / exact[r["step"]] - 1 for r in full]
        call = sum(r["call_ms"] for r in full) / (len(full) * every)
        step = sum(r["step_ms"] for r in full) / len(full)
        rows.append({"tests_and_cuts": ("each call", "when changed", "each 50th and 10th")[spare], "call_every": every,
                     "parcels": int(full[-1]["parcels"]), "clast_ms_a_step": f"{call:.2f}", "solver_ms_a_step": f"{step:.2f}",
                     "share_percent": f"{100 * call / step:.1f}", "worst_call_ms": f"{max(r['call_ms'] for r in full):.1f}",
                     "events_off_rms_percent": f"{100 * math.sqrt(sum(o * o for o in off) / len(off)):.1f}"})
    show(rows)
    study.write_table("cost.csv", rows)


def part_growth(study):
    """Parcels grow by clast's collisions. In plug flow n = n0 / (1 + K n0 t / 2); what came in k steps ago has collided for k dt."""
    kernel, dt = 2.5e-9, DUCT_SETTINGS["dt"]
    found = study.duct("growth", CELLS[1], 500, task="grow", steps=80, kernel=kernel, spare=1)
    rows = []
    for r in found:
        if r["step"] % 10 == 0:
            a = kernel * PARTICLES / (dt * DUCT[1] * DUCT[2]) / 2
            plug = sum(PARTICLES / (1 + a * k * dt) for k in range(1, min(int(r["step"]), 40) + 1))
            error = (r["mass_in"] - r["mass_out"] - r["mass_present"]) / r["mass_in"]
            rows.append({"step": int(r["step"]), "parcels": int(r["parcels"]), "particles": f"{r['particles']:.0f}", "plug_flow": f"{plug:.0f}",
                         "stuck": f"{r['stuck']:.0f}", "mass_in_kg": f"{r['mass_in']:.6e}", "mass_out_kg": f"{r['mass_out']:.6e}",
                         "mass_present_kg": f"{r['mass_present']:.6e}", "imbalance": f"{error:.1e}"})
    show(rows)
    study.write_table("growth.csv", rows)
    worst = max(abs(float(r["imbalance"])) for r in rows)
    if worst > 1e-12:
        sys.exit(f"drive.py: growth: mass is off by {worst:.1e} of what came in")


def run_pipe(study):
    n_cell = []
    _, result = study.run("pipe", lambda path: n_cell.append(meshes.write_half_pipe(path, *PIPE.values())), PIPE_SETTINGS)
    return n_cell[0], result


def part_pipe(study):
    """Positions after 20 s, one file for each number of particles, rounded to a micrometre."""
    n_cell, result = study.pipe.result()
    with open(result / "parcels.csv", newline="") as f:
        parcels = list(csv.DictReader(f))
    for weight, printed in enumerate(PRINTED, 1):
        chosen = [r for r in parcels if float(r["weight"]) == weight]
        path = study.folder / f"half_pipe_{printed}.csv"
        path.write_text("x_m,y_m,z_m\n" + "".join(f"{float(r['x_m']):.6f},{float(r['y_m']):.6f},{float(r['z_m']):.6f}\n" for r in chosen))
        print(f"{path}: {len(chosen)} particles, {printed} in the paper; {n_cell} cells")


PARTS = {"small": part_small, "meshes": part_meshes, "ranks": part_ranks, "cost": part_cost, "growth": part_growth, "pipe": part_pipe}


def keep(study):
    """The tables and the figure become those of the documents, the snapshots those of data/."""
    for name in ("meshes.csv", "meshes.svg", "ranks.csv", "cost.csv", "growth.csv"):
        if (study.folder / name).exists():
            shutil.copy(study.folder / name, ROOT / "docs" / "validation" / f"code_saturne_{name}")
    (ROOT / "data" / "code_saturne").mkdir(exist_ok=True)
    for path in study.folder.glob("half_pipe_*.csv"):
        shutil.copy(path, ROOT / "data" / "code_saturne")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("parts", nargs="*", metavar="PART", help=", ".join(PARTS))
    parser.add_argument("-o", "--output", type=pathlib.Path, default=ROOT / "build" / "code_saturne")
    parser.add_argument("--build", type=pathlib.Path, default=ROOT / "build" / "release")
    parser.add_argument("--keep", action="store_true", help="copy tables to docs/validation, snapshots to data/code_saturne")
    args = parser.parse_args()
    unknown = [part for part in args.parts if part not in PARTS]
    if unknown:
        sys.exit(f"drive.py: no part {unknown[0]!r}; parts are {', '.join(PARTS)}")
    study = Study(args.output, args.build)
    begun = time.monotonic()
    parts = args.parts or list(PARTS)
    with concurrent.futures.ThreadPoolExecutor(1) as pool:
        for part in parts:
            if study.pipe is None and "pipe" in parts and part != "small":
                study.pipe = pool.submit(run_pipe, study)  # the longest, on one core beside all others
            print(f"== {part}", flush=True)
            PARTS[part](study)
    if args.keep:
        keep(study)
    print(f"{time.monotonic() - begun:.0f} s")


if __name__ == "__main__":
    main()
