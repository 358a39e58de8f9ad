"""The page of files and columns: what each command's run writes, found by running it on bundled data."""
import csv
import json
import os
import pathlib
import re
import subprocess
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
BED = "pack --curve 4mm --mass 3g --width 20mm --height 60mm --shaking-time 0 --frame-time 50ms"
RUNS = [  # (command, its arguments, folder or file that it writes)
    ("aggregate", "aggregate --core sphere --core-size 270um --coat sphere --size 60um --replicate 12 --repeats 2 --printable --spacing 8um", "run"),
    ("aggregate --fit", "aggregate --fit --core sphere --core-size 200um --coat sphere --size 60um --observed-size 300um --observed-size-error 50um "
                        "--fit-packing 1deg:1:1 --fit-repeats 2 --fit-replicate-max 2", "fit"),
    ("pack", BED, "bed"),
    ("porosity", "porosity bed --rings 3 --local --pores 400", "porosity"),
    ("porosity of several runs", "porosity bed bed-2", "realisations"),
    ("predict", "predict data/standin63/grains.csv", "prediction"),
    ("decompose", "decompose data/d2sd/points_b3_n500.csv --domain box:0,0,0,1,1,1 --pairs --sizes 2", "cells"),
    ("decompose --mesh bins", "decompose data/d2sd/points_b3_n500.csv --domain box:0,0,0,1,1,1 --mesh bins --beta-dt 1e-6", "bins"),
    ("agglomerate", "agglomerate data/d2sd/points_u3_n50.csv --domain box:0,0,0,1,1,1 --constant 0.01", "evolution"),
    ("agglomerate --box-model", "agglomerate --box-model --concentration 1e12 --constant 1e-12 --duration 5s", "box"),
    ("evolve", "evolve --domain box:0,0,0,1mm,1mm,5mm --particles 500 --curve 20um --duration 0.2s --rows 4 --frames 2 --keep 3 "
               "--out-of-range extrapolate", "fall"),
    ("study", "study --run aggregate --fix core=sphere --fix core_size=270um --fix coat=sphere --fix size=60um --seeds 2 --keep density", "study"),
    ("shape", "shape data/standin63/grain00.ply data/standin63/grain05.ply", "shape.csv"),
    ("shape --statistics", "shape data/standin63/grain00.ply data/standin63/grain05.ply data/standin63/grain10.ply data/standin63/grain20.ply --statistics forms", None),
    ("fill", "fill data/standin63/grain00.ply --spheres 5", "spheres.csv"),
    ("fill --history", "fill data/standin63/grain00.ply --spheres 5 --history errors.csv", "more.csv"),
    ("grading --sample", "grading U1 --sample 5", "sizes.csv"),
    ("export", "export bed", "grains.csv"),
    ("export (LAMMPS)", "export bed", "grains.dump"),
]
FIRST = {"porosity of several runs": f"{BED} --seed 2 -o bed-2 -q"}  # what a run needs besides
KINDS = {".h5": "state: placed grains with their shapes, tables, configuration ([layout](../theory/state-file.md))", ".svg": "chart", ".png": "picture",
         ".stl": "surface, mm", ".3mf": "surface for printers, mm", ".html": "page that works offline", ".vtu": "for ParaView", ".vtp": "points for ParaView",
         ".pvd": "frames in time for ParaView"}
FIXED = {"manifest.json": "version, options, seed, SHA-256 of inputs, host, times", "summary.json": "the keys of `--json`"}


def columns(path):
    """Names of a CSV's columns; their unit is at the end of the name."""
    with path.open(encoding="utf-8") as file:
        lines = [line for line in file if not line.startswith("#")]
    return next(csv.reader(lines))


def keys(value, before=""):
    """Names of a JSON object's keys, a.b for b within a, a[] for the items of a list."""
    for key, inside in value.items():
        name = before + key
        if isinstance(inside, dict) and inside:
            yield from keys(inside, name + ".")
        elif isinstance(inside, list) and inside and isinstance(inside[0], dict):
            yield from keys(inside[0], name + "[].")
        else:
            yield name


def row(path, shown):
    if path.suffix == ".csv":
        return f"| `{shown}` | {' '.join(f'`{name}`' for name in columns(path))} |"
    if shown in FIXED:
        return f"| `{shown}` | {FIXED[shown]} |"
    if path.suffix == ".json":
        return f"| `{shown}` | {' '.join(f'`{name}`' for name in keys(json.loads(path.read_text(encoding='utf-8'))))} |"
    if path.suffix == ".dump":
        return f"| `{shown}` | {path.read_text(encoding='utf-8').splitlines()[8].removeprefix('ITEM: ATOMS ')} |"
    return f"| `{shown}` | {KINDS.get(path.suffix, 'text')} |"


def rows_of(target):
    """A row a file of a run; of files that differ by a number one stands for all."""
    paths = sorted(path for path in target.rglob("*") if path.is_file()) if target.is_dir() else [target]
    told = set()
    for path in paths:
        shown = re.sub(r"\d{4,}", "N", str(path.relative_to(target)) if target.is_dir() else path.name)
        if shown not in told and not shown.startswith("runs/N/out/"):
            told.add(shown)
            yield row(path, shown)


def page(clast):
    lines = ["# Files, columns, JSON", "", "What each command writes, as the runs named here wrote it when this page was built. A column's unit ends its name (`d_agg_m`); "
             "a JSON key without one is SI. `--json` prints the keys of `summary.json` on stdout; lists that a table holds (`profile` of porosity) are on stdout alone.", ""]
    with tempfile.TemporaryDirectory() as folder:
        os.symlink(ROOT / "data", pathlib.Path(folder, "data"))
        for title, arguments, target in RUNS:
            out = [] if target is None else ["-o", target]
            if title in FIRST:
                subprocess.run([clast, *FIRST[title].split()], cwd=folder, capture_output=True, check=True)
            done = subprocess.run([clast, *arguments.split(), *out, "--json", "-q"], cwd=folder, capture_output=True, text=True, check=False)
            if done.returncode not in (0, 1):
                raise SystemExit(f"reference: clast {arguments}: {done.stderr}")
            lines += [f"## {title}", "", "```sh", " ".join(["clast", arguments, *out]), "```", "", "| file | what it holds |", "| --- | --- |",
                      *rows_of(pathlib.Path(folder, target or arguments.split()[-1])), ""]
            if done.stdout.lstrip().startswith("{"):
                lines += ["JSON: " + " ".join(f"`{name}`" for name in dict.fromkeys(keys(json.loads(done.stdout)))), ""]
    return "\n".join(lines)
