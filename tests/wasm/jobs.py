"""Golden scenes as command lines, run by the native command and by clast.wasm: aggregates, packings, decompositions, shapes, refusals."""
import hashlib
import json
import os
import pathlib
import shutil
import subprocess
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
CLAST = os.environ.get("CLAST", str(ROOT / "build/release/clast"))
PACKAGE = pathlib.Path(os.environ.get("CLAST_WASM", str(ROOT / "build/wasm"))) / "npm"
GRAIN = {f"grain{k:02d}.ply": ROOT / f"data/standin63/grain{k:02d}.ply" for k in (0, 1, 2, 3)}
POINTS = {name: ROOT / f"data/d2sd/{name}" for name in ("points_b3_n500.csv", "points_s2_n500.csv")}
# glibc has its elementary functions twice, with fused multiply-add and without; WebAssembly has none.
PLAIN = {**os.environ, "GLIBC_TUNABLES": "glibc.cpu.hwcaps=-AVX2,-FMA,-FMA4"}
# What a run measures of itself; and the manifest, which names machine and moment.
OWN = ("wall_s", "contact_s", "envelope_s", "ns_per_grain_step", "measure_s", "porosity_s", "grain_steps_per_s")
OWN_FILES = ("manifest.json",)
CHARTS = (".svg", ".png", ".pdf")  # their text is in the built-in strokes of cairo
GROWN = ["--core", "grain00.ply", "--core-size", "270um", "--coat", "grain01.ply", "--coat", "grain02.ply", "--size", "60um", "--unit", "um",
         "--replicate", "24", "--cone", "40deg", "--rays", "4", "--orientations", "3", "--seed", "7", "--json"]
POURED = ["--curve", "4mm", "--mass", "2g", "--width", "20mm", "--height", "30mm", "--shaking-time", "0.01s", "--max-steps", "30000", "--seed", "3", "--json"]
CHARTED = {
    "decompose": (["decompose", "points_s2_n500.csv", "--domain", "box:0,0,1,1", "--pairs", "--json"], "--charts", "", ["-o", "cells"]),
    "agglomerate": (["agglomerate", "points_s2_n500.csv", "--domain", "box:0,0,1,1", "--constant", "1e-3", "--json"], "--charts", "", ["-o", "grown"]),
    "grading": (["grading", "U1", "--mass", "10kg", "--sample", "100", "--json"], "--chart", "curve.", []),
}

JOBS = {
    "aggregate, true surfaces": (["aggregate", *GROWN], GRAIN),
    "aggregate, spheres": (["aggregate", *GROWN, "--contact", "spheres"], GRAIN),
    "aggregate, march": (["aggregate", *GROWN, "--contact", "march", "--rays", "2"], GRAIN),
    "packing, spheres": (["pack", *POURED], {}),
    "packing, ellipsoids": (["pack", *POURED, "--shapes", "ellipsoid:1,0.7,0.5"], {}),
    "packing, hulls": (["pack", *POURED, "--shapes", "grain03.ply", "--unit", "mm", "--mass", "1g", "--max-steps", "12000"], GRAIN),
    "decomposition, tree": (["decompose", "points_b3_n500.csv", "--domain", "box:0,0,0,1,1,1", "--json", "-o", "cells"], POINTS),
    "decomposition, boxes": (["decompose", "points_s2_n500.csv", "--domain", "box:0,0,1,1", "--mesh", "boxes", "--beta-dt", "0.001", "--json", "-o", "cells"], POINTS),
    "decomposition, ghosts": (["decompose", "points_s2_n500.csv", "--domain", "box:0,0,1,1", "--mesh", "labels", "--ghost-samples", "20", "--json"], POINTS),
    "shapes": (["shape", *GRAIN, "--unit", "um", "--json"], GRAIN),
    "sphere composite": (["fill", "grain01.ply", "--spheres", "60", "--json"], GRAIN),
    "surface": (["mesh", "check", "grain02.ply", "--json"], GRAIN),
    **{f"charts of {name}, {form}": ([*words, option, form_of + form, *more], POINTS)
       for form in ("svg", "png", "pdf") for name, (words, option, form_of, more) in CHARTED.items()},
    "refused: a missing file": (["decompose", "none.csv", "--domain", "box:0,0,1,1"], {}),
    "refused: a word": (["aggregate", "--core", "sphere", "--cores", "2"], {}),
    "refused: a length without a unit": (["aggregate", "--core", "sphere", "--core-size", "270", "--coat", "sphere", "--size", "30um"], {}),
}


def lacking(*programs):
    """What a test of clast.wasm cannot do without and does not find, or None."""
    made = PACKAGE / "clast.wasm"
    if not made.exists():
        return f"{made} is not here; make wasm makes it"
    newest = max(p.stat().st_mtime for folder in ("src", "cli", "include", "web/wasm", "web/live", "web/dist", "tools/portable") for p in (ROOT / folder).rglob("*.*"))
    if newest > (PACKAGE / "clast.mjs").stat().st_mtime:
        return f"{made} is older than the sources; make wasm makes it anew"
    absent = [program for program in programs if not shutil.which(program)]
    return f"{absent[0]} is not installed (tools/setup.sh wasm)" if absent else None


def numbers_of(text):
    """--json's object without what a run measures of itself; other texts as they are."""
    try:
        found = json.loads(text)
    except ValueError:
        return text
    return {key: value for key, value in found.items() if key not in OWN}


def plain(result):
    files = {name: "drawn" if name.endswith(CHARTS) else digest for name, digest in result["files"].items() if pathlib.Path(name).name not in OWN_FILES}
    return {"status": result["status"], "stdout": numbers_of(result["stdout"]), "stderr": result["stderr"], "files": files}


def native(words, files):
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        for name, path in files.items():
            (folder / name).write_bytes(path.read_bytes())
        done = subprocess.run([CLAST, *words], cwd=folder, capture_output=True, text=True, check=False, timeout=300, env=PLAIN)
        made = {str(p.relative_to(folder)): hashlib.sha256(p.read_bytes()).hexdigest()
                for p in sorted(folder.rglob("*")) if p.is_file() and str(p.relative_to(folder)) not in files}
        return {"status": done.returncode, "stdout": done.stdout, "stderr": done.stderr, "files": made}
