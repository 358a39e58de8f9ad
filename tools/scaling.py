#!/usr/bin/env python3
"""Counts what goes between the ranks of a bed (strong and weak), fits the model of docs/theory/scaling.md to it and prints
its tables: tools/scaling.py [--mpi build/release/clast-mpi] [--launch "mpirun -n"] [--ranks 1,2,4,8,16,64]. Counts do not
depend on the machine: ranks may be more than cores. State hashes of one bed must be equal on all ranks."""
import argparse
import json
import math
import os
import subprocess
import sys

STEPS = 200
# The network and a rank's own work, as the page assumes them [s, s, B/s, s, s].
LATENCY, PER_MESSAGE, BANDWIDTH = 2e-6, 0.5e-6, 10e9
GRAIN_STEP = 150e-9
RECORD = 400.0  # bytes of a grain on every rank
# Counted by callgrind on two ranks: contacts of a ghost, in those of an own grain; what refreshes add to the work on own grains.
TWICE, LISTS = 0.73, 0.04
MOST_NEIGHBOURS = 26  # of a brick


def bed(mass, width):
    return ("pack --curve 4mm --domain periodic --height 0.25m --generator shelf --first-low 0 --first-high 0.9 --fill-low 0.9 "
            f"--gravity 100m/s^2 --restitution 0.3 --max-steps {STEPS} --width {width:.4f}mm --mass {mass:.4f}kg -q --json").split()


def count(options, ranks, mass, width):
    """A row of counts, each for a rank."""
    env = {**os.environ, "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1", "OMPI_MCA_rmaps_base_oversubscribe": "1",
           "OMPI_MCA_hwloc_base_binding_policy": "none"}
    done = subprocess.run([*options.launch.split(), str(ranks), options.mpi, *bed(mass, width), "-j", "1"], env=env, check=False,
                          capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(done.stderr)
    bed_json = json.loads(done.stdout)
    r = bed_json.get("ranks") or {}
    n = bed_json["n_grain"]
    refreshes = max(1, bed_json["n_refresh"])
    per_rank = {key: r.get(key, 0.0) / ranks for key in ("ghosts", "messages", "step_bytes", "list_bytes")}
    return {"ranks": ranks, "grains": n, "hash": bed_json["state_hash"], "own": n / ranks, "ghosts": per_rank["ghosts"],
            "messages": per_rank["messages"], "bytes": per_rank["step_bytes"], "list": per_rank["list_bytes"] * STEPS / refreshes,
            "imbalance": r.get("imbalance", 1.0), "refresh": STEPS / refreshes}


def show(title, rows):
    print(f"\n{title}\n| ranks | grains | a rank's own | ghosts | messages a step | kB a step | kB for lists, a refresh | cost of the most loaded | state hash |")
    print("| --- " * 9 + "|")
    for r in rows:
        print(f"| {r['ranks']} | {r['grains']} | {r['own']:.0f} | {r['ghosts']:.0f} | {r['messages']:.2f} | {r['bytes'] / 1e3:.1f} | "
              f"{r['list'] / 1e3:.0f} | {r['imbalance']:.3f} | {r['hash']} |", flush=True)


def fit(rows):
    """Ghosts = a own^(2/3), least in relative squares; bytes of lists in those of ghosts."""
    some = [r for r in rows if r["ranks"] >= 8]
    a = math.exp(sum(math.log(r["ghosts"] / r["own"] ** (2 / 3)) for r in some) / len(some))
    b = sum(r["list"] / r["ghosts"] for r in some) / len(some)
    off = max(abs(a * r["own"] ** (2 / 3) / r["ghosts"] - 1) for r in some)
    return {"a": a, "off": off, "list": b, "bytes": some[-1]["bytes"] / some[-1]["ghosts"],
            "imbalance": max(r["imbalance"] for r in some), "refresh": sum(r["refresh"] for r in some) / len(some)}


def predict(m, n, ranks):
    """Seconds of a step of n grains on so many ranks: work, ghosts, latency, bytes, lists; and the efficiency."""
    own = n / ranks
    ghosts = min(m["a"] * own ** (2 / 3), n - own)
    work = GRAIN_STEP * own * m["imbalance"] * (1 + LISTS)
    again = GRAIN_STEP * ghosts * TWICE
    rounds = (2 * math.ceil(math.log2(ranks)) + 2) * LATENCY + min(ranks - 1, MOST_NEIGHBOURS) * PER_MESSAGE + 2e-9 * ranks
    volume = m["bytes"] * ghosts / BANDWIDTH
    lists = (3 * ranks * PER_MESSAGE + 96 * ranks / BANDWIDTH + m["list"] * ghosts / BANDWIDTH +
             8 * 2 * math.ceil(math.log2(ranks)) * LATENCY) / m["refresh"]
    total = work + again + rounds + volume + lists
    return work, again, rounds, volume, lists, GRAIN_STEP * own / total


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--mpi", default="build/release/clast-mpi")
    parser.add_argument("--launch", default="mpirun -n")
    parser.add_argument("--ranks", default="1,2,4,8,16,64")
    options = parser.parse_args()
    counts = [int(word) for word in options.ranks.split(",")]
    strong = [count(options, k, 1.6, 100.0) for k in counts]
    show("Strong: one bed", strong)
    if len({r["hash"] for r in strong}) != 1:
        sys.exit("the state hash depends on the ranks")
    weak = [count(options, k, 0.4 * k, 50.0 * math.sqrt(k)) for k in counts if k <= 16]
    show("Weak: the same bed a rank", weak)
    m = fit(strong + weak)
    print(f"\nfit: ghosts = {m['a']:.2f} own^(2/3) (off by {m['off']:.0%} at the most), {m['bytes']:.0f} bytes a ghost and step, "
          f"{m['list']:.0f} a ghost and refresh, {m['refresh']:.0f} steps a refresh")
    print("\n| grains | ranks | work, us | ghosts' | latencies | bytes | lists | efficiency | GB of records a rank |")
    print("| --- " * 9 + "|")
    for n in (20_000, 1_000_000, 10_000_000):
        for ranks in (2, 16, 64, 400, 10_000):
            *parts, efficiency = predict(m, n, ranks)
            print(f"| {n} | {ranks} | " + " | ".join(f"{1e6 * p:.1f}" for p in parts) + f" | {efficiency:.2f} | {RECORD * n / 1e9:.2f} |")
        half = next((k for k in range(2, 100_001) if predict(m, n, k)[-1] < 0.5), None)
        print(f"# {n} grains: below half at {half} ranks")


if __name__ == "__main__":
    main()
