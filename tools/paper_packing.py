#!/usr/bin/env python3
"""Packings of Rettinger et al. 2022 beside ours: writes docs/validation/packing.md and packing.csv.

usage: tools/paper_packing.py [--clast build/release/clast] [--runs FOLDER...] [--run [STUDY...]] [--keep-cases]

--runs FOLDER... hold the studies of examples/packing, each in a folder of its own name: whole ones, half-done ones, and those of
               which only some shards were run (build/paper-packing unless said)
--run STUDY... runs these studies in the first of them (resumable; without names: the scaled-down ones, some hours on one core)
--keep-cases   leaves the timings of cases A and P as the page has them (they want an idle machine)
--u1 DENSE FOLDER [MANIFEST...]  FOLDER is what `clast pack examples/packing/periodic.yaml --max-steps N -j 2 -o FOLDER` left, N from the page's table of U1, with the
               manifests of its earlier parts where it was resumed; DENSE: wall nanoseconds a grain-step of dense beds, by comma (the
               settled bed of 20,000, `bench_tiles 5 1 2`; the run's own last stretch). The page then has them and what follows; without it the page keeps what it has
packing.csv is the record of all beds: a bed found in a FOLDER replaces its row, others stay. The page comes from the record, so
it can be made anew without running anything. Cases A and P (two GPL scans of ../shared) and known packings are run each time.
"""
import argparse
import csv
import json
import math
import pathlib
import resource
import struct
import subprocess
import tempfile

import chart
import pooled

ROOT = pathlib.Path(__file__).resolve().parent.parent
SHARED = ROOT.parent / "shared/data"
RECORD = ROOT / "docs/validation/packing.csv"
SMALL = ("forms-small", "rounding-small", "dip-small", "spheres-small", "table11-small", "table8-small", "table5-small", "table4-small",
         "table7-small", "table6-small")
HEAD = ("study", "run", "planned", "keys", "seed", "n_grain", "mass", "porosity_bulk", "z_low", "z_high", "flatness_mean",
        "flatness_deviation", "elongation_mean", "elongation_deviation", "coordination", "max_overlap", "n_step", "grain_steps",
        "wall_s", "state_hash", "porosity_untrimmed")
# two-sided 95 % of Student's t with n - 1 degrees of freedom
T95 = {2: 12.706, 3: 4.303, 4: 3.182, 5: 2.776, 6: 2.571, 7: 2.447, 8: 2.365, 9: 2.306, 10: 2.262, 24: 2.069}
TABLE_3 = {"U1": .371, "U3": .356, "U5": .344, "U7": .315, "B30": .270, "B50": .289, "B70": .299}  # experiments
TABLE_4 = {("U7", "0"): .310, ("U7", "200"): .315, ("U7", "100"): .319, ("U7", "50"): .329,
           ("B50", "0"): .278, ("B50", "200"): .284, ("B50", "100"): .289, ("B50", "50"): .294}
TABLE_5 = {"U7": (.323, .314, .309, .309), "B50": (.284, .280, .280, .277)}  # 0, 1, 2, 3 s
TABLE_6 = {"U1": (.382, .381, .386), "U3": (.367, .369, .372), "U5": (.336, .333, .332), "U7": (.315, .313, .314),
           "B30": (.284, .290, .283), "B50": (.283, .276, .281), "B70": (.290, .291, .290)}
TABLE_7 = {"U7": (.291, .291, .291), "B50": (.246, .245, .251)}  # 0.1, 0.2, 0.3 m
TABLE_8 = {"U7": (.291, .287, .285, .283, .282, .281), "B50": (.245, .241, .241, .243, .242, .241)}  # 1, 2, 3, 4, 6, 8 s
TABLE_11 = {"U1": (.353, .356), "U7": (.282, .288)}  # discrete, continuous
EQ_17 = {"U1": (.019, .014, .278), "U7": (.014, .007, .234), "B50": (.014, -.006, .217)}
TABLE_9 = {"flatness": 5.96, "elongation": 5.26, "inverse_elongation": 4.66, None: 5.74, "aschenbrenner_shape_factor": 5.40,
           "inverse_aschenbrenner_shape_factor": 5.58, "illenberger_form_index": 5.18, "inverse_illenberger_form_index": 5.56,
           "illenberger_rod_index": 4.80, "inverse_illenberger_rod_index": 4.19, "oblate_prolate_index": 5.48,
           "inverse_oblate_prolate_index": 6.96, "disc_rod_index": 5.71, "inverse_disc_rod_index": 5.87}  # U1: beside 1/EQ; None: alone
# spec of the reference program, one rank: wall s, us a grain-step, porosity at the end
PRINTED_6 = {"U1": "0.383 ± 0.002", "U3": "0.369 ± 0.002", "U5": "0.333 ± 0.002", "U7": "0.314 ± 0.001", "B30": "0.286 ± 0.003",
             "B50": "0.280 ± 0.003", "B70": "0.290 ± 0.001"}  # mean and standard deviation of the three
CASES = {"A mesh": (367.4, 24.2, .4687), "A eqell": (268.9, 17.7, .4593), "A sph": (14.5, .57, .4499),
         "P mesh": (351.9, 18.7, .4447), "P eqell": (260, 13.8, .4275), "P sph": (54, 2.9, .4649)}


def mean(values):
    return sum(values) / len(values)


def spread(values):
    m = mean(values)
    return math.sqrt(sum((v - m) ** 2 for v in values) / (len(values) - 1)) if len(values) > 1 else math.nan


def shown(values):
    """Mean, with the half width of its 95 % interval by Student's t where there is more than one bed."""
    if not values:
        return "not run"
    half = f" ± {T95.get(len(values), 1.96) * spread(values) / math.sqrt(len(values)):.4f}" if len(values) > 1 else ""
    return f"{mean(values):.4f}{half} ({len(values)})"


def table(head, rows):
    return "\n".join(["| " + " | ".join(head) + " |", "|" + " --- |" * len(head)] +
                     ["| " + " | ".join(str(c) for c in row) + " |" for row in rows])


def read_csv(path):
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def beds_of(folder, study):
    """The whole beds of a study's folder, also of one that has not ended or of some shards."""
    plan = folder / study / "plan.csv"
    rows = read_csv(plan) if plan.exists() else []
    for row in rows:
        result = folder / study / f"runs/{int(row['run']):06d}/result.json"
        if not result.exists() or not result.read_text(encoding="utf-8").strip():
            continue
        found = json.loads(result.read_text(encoding="utf-8"))
        if not found.get("converged"):
            continue
        keys = ";".join(f"{k}={v}" for k, v in row.items() if k not in ("run", "seed"))
        yield {k: "" for k in HEAD} | {k: str(found[k]) for k in HEAD if k in found} | {
            "study": study, "run": row["run"], "planned": str(len(rows)), "keys": keys, "seed": row.get("seed", "1")}


class Record:
    def __init__(self, folders):
        self.beds = {(b["study"], b["keys"], b["seed"]): b for b in (read_csv(RECORD) if RECORD.exists() else [])}
        for folder in folders:
            for study in sorted(p.name for p in folder.iterdir() if p.is_dir()) if folder.exists() else []:
                for bed in beds_of(folder, study):
                    self.beds[bed["study"], bed["keys"], bed["seed"]] = bed

    def write(self):
        with open(RECORD, "w", newline="", encoding="utf-8") as file:
            writer = csv.DictWriter(file, HEAD, lineterminator="\n")
            writer.writeheader()
            writer.writerows(sorted(self.beds.values(), key=lambda b: (b["study"], int(b["run"]))))

    def of(self, study, **keys):
        """Beds of a study whose varied keys have these values."""
        wanted = {f"{k}={v}" for k, v in keys.items()}
        return [b for b in self.beds.values() if b["study"] == study and wanted <= set(b["keys"].split(";"))]

    def porosities(self, study, **keys):
        return [float(b["porosity_bulk"]) for b in self.of(study, **keys)]


def clast(command, *arguments):
    done = subprocess.run([command, *map(str, arguments), "--json", "--quiet"], capture_output=True, text=True, check=False,
                          cwd=ROOT)
    if done.returncode != 0:
        raise RuntimeError(f"clast {' '.join(map(str, arguments))}: {done.stderr.strip()}")
    return json.loads(done.stdout)


def clast_timed(command, *arguments):
    """The answer, with the processor seconds of the process as cpu_s: other work on the machine does not count."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    found = clast(command, *arguments)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return found | {"cpu_s": after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime}


def what_was_run(record):
    rows = []
    for study in sorted({b["study"] for b in record.beds.values()}):
        beds = record.of(study)
        grains = [int(b["n_grain"]) for b in beds]
        masses = [float(b["mass"]) for b in beds]
        steps = sum(float(b["grain_steps"]) for b in beds)
        rows.append((f"`{study}`", f"{len(beds)} of {beds[0]['planned']}", f"{min(masses):.3g} to {max(masses):.3g} kg", f"{min(grains)} to {max(grains)}",
                     f"{steps:.3g}"))
    return table(("study (examples/packing)", "beds", "mass", "grains a bed", "grain-steps"), rows)


def table_6(record):
    rows = []
    for curve, runs in TABLE_6.items():
        full, small = (record.porosities(study, curve=curve) for study in ("table6", "table6-small"))
        off = f"{mean(full) - mean(runs):+.4f}" if full else ""
        rows.append((curve, f"{TABLE_3[curve]:.3f}", PRINTED_6[curve], shown(full), off, shown(small)))
    return table(("curve", "experiment", "paper, as printed: mean ± standard deviation of 3", "ours, 3 kg", "ours - mean of the paper's runs", "ours, 1 kg"), rows)


def column(record, study, key, values, **keys):
    return [shown(record.porosities(study, **{key: v}, **keys)) for v in values]


def table_4(record):
    rows = [(curve, "paper", *(f"{TABLE_4[curve, n]:.3f}" for n in ("0", "200", "100", "50"))) for curve in ("U7", "B50")]
    rows += [(curve, "ours, 3 kg", *column(record, "table4", "faces", ("0", "200", "100", "50"), curve=curve))
             for curve in ("U7", "B50") if record.of("table4", curve=curve)]
    rows += [("U7", "ours, 1 kg, 0.5 s", *column(record, "table4-small", "faces", ("0", "200", "100", "50")))]
    return table(("curve", "", "300 faces", "200", "100", "50"), rows)


def shaking(record, published, study, small, times, small_times):
    rows = [(curve, "paper", *(f"{v:.3f}" for v in values)) for curve, values in published.items()]
    rows += [(curve, "ours, full size", *column(record, study, "shaking_time", [f"{t} s" for t in times], curve=curve))
             for curve in published if record.of(study, curve=curve)]
    text = table(("curve", "", *(f"{t} s" for t in times)), rows)
    return text + "\n\n" + table(("scaled down", *(f"{t} s" for t in small_times)),
                                 [(f"`{small}`", *column(record, small, "shaking_time", [f"{t} s" for t in small_times]))])


def table_7(record):
    rows = [(curve, "paper", *(f"{v:.3f}" for v in values)) for curve, values in TABLE_7.items()]
    rows += [(curve, "ours, full size", *column(record, "table7", "width", ("0.1m", "0.2m", "0.3m"), curve=curve))
             for curve in TABLE_7 if record.of("table7", curve=curve)]
    text = table(("curve", "", "0.1 m", "0.2 m", "0.3 m"), rows)
    return text + "\n\n" + table(("scaled down, U1", "70 mm", "85 mm", "100 mm"),
                                 [("`table7-small`", *column(record, "table7-small", "width", ("70 mm", "85 mm", "100 mm")))])


def table_11(record, command):
    rows = []
    for curve, published in TABLE_11.items():
        predicted = clast(command, "predict", ROOT / "data/standin63/grains.csv", "--grading", curve)
        for k, law in enumerate(("false", "true")):
            small = record.porosities("table11-small", form_law=law)
            small = small or (record.porosities("rounding-small", rounding="0") if law == "false" else [])
            rows.append((curve, "drawn from normal laws" if k else "63 grains as they are", f"{published[k]:.3f}",
                         shown(record.porosities("table11", curve=curve, form_law=law)), shown(small) if curve == "U1" else "",
                         f"{predicted['porosity']:.4f} ± {2 * predicted['standard_error']:.4f}"))
    return table(("curve", "forms", "paper, simulated", "ours, full size", "ours, scaled down", "the paper's model on our 63 forms"),
                 rows)


def pearson(x, y):
    mx, my = mean(x), mean(y)
    return sum((a - mx) * (b - my) for a, b in zip(x, y)) / math.sqrt(sum((a - mx) ** 2 for a in x) * sum((b - my) ** 2 for b in y))


def inverse_equancy(bed):
    return 1 / (float(bed["flatness_mean"]) * float(bed["elongation_mean"]))


def eq_17(bed):
    a, b, c = EQ_17["U1"]
    return a * inverse_equancy(bed) + b / float(bed["elongation_mean"]) + c


def forms(record, study):
    """Rows by L/S: grain, L/S, porosity of surfaces, of ellipsoids, eq. 17."""
    rows = []
    for bed in record.of(study):
        keys = dict(pair.split("=", 1) for pair in bed["keys"].split(";"))
        if keys.get("ellipsoids", "false") != "false" or keys.get("curve", "U1") != "U1":
            continue
        inverse_eq = inverse_equancy(bed)
        eggs = "forms-126" if study == "forms-10" else study  # the ellipsoids of forms-10 are those of forms-126
        egg = record.porosities(eggs, shapes=keys["shapes"], ellipsoids="true", **({"curve": "U1"} if "curve" in keys else {}))
        rows.append((pathlib.Path(keys["shapes"]).stem, inverse_eq, float(bed["porosity_bulk"]), egg[0] if egg else math.nan, eq_17(bed)))
    return sorted(rows, key=lambda r: r[1])


def forms_text(record, study):
    rows = forms(record, study)
    if len(rows) < 3:
        return "Not run."
    eggs = [r for r in rows if not math.isnan(r[3])]
    text = table(("form", "L/S", "surfaces", "ellipsoids", "surfaces - ellipsoids", "eq. 17"),
                 [(n, f"{e:.3f}", f"{p:.4f}", "not run" if math.isnan(q) else f"{q:.4f}", "" if math.isnan(q) else f"{p - q:+.4f}",
                   f"{m:.4f}") for n, e, p, q, m in rows])
    text += (f"\n\nCorrelation of the porosity of surfaces with L/S: r = {pearson([r[1] for r in rows], [r[2] for r in rows]):.3f} "
             f"over {len(rows)} forms; mean difference to eq. 17: {mean([r[2] - r[4] for r in rows]):+.4f}, root mean square "
             f"{math.sqrt(mean([(r[2] - r[4]) ** 2 for r in rows])):.4f}.")
    if eggs:
        text += (f" Root mean square of surfaces against ellipsoids: {math.sqrt(mean([(r[2] - r[3]) ** 2 for r in eggs])):.4f} "
                 "(paper, Fig. 10a: 0.0087).")
    return text


def fit_of(beds, command, *options):
    """`clast fit` on these beds, as a user would."""
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "results.csv"
        with open(path, "w", newline="", encoding="utf-8") as file:
            writer = csv.DictWriter(file, HEAD, lineterminator="\n")
            writer.writeheader()
            writer.writerows(beds)
        return clast(command, "fit", path, "--target", "porosity_bulk", "--columns", "flatness_mean,elongation_mean", *options)


def fit_text(record, command, study):
    beds = [b for b in record.of(study) if "ellipsoids=true" not in b["keys"]]
    if len(beds) < 6:
        return "Too few beds for a fit."
    fit = fit_of(beds, command, "--n-term", 1, "--n-fold", min(10, len(beds) // 2))
    return table(("rank", "feature", "r"), [(i + 1, r["feature"], f"{r['r']:.3f}") for i, r in enumerate(fit["ranking"][:5])])


def pipeline_of(beds, command):
    """The paper's sec. 6.3 on beds of one form each: cells of a column, by the rows of PIPELINE."""
    if len(beds) < 10:
        return [f"{len(beds)} of 63", *["too few beds"] * (len(PIPELINE) - 1)]
    first = fit_of(beds, command, "--n-term", 1)
    second = fit_of(beds, command, "--use", "inverse_equancy,inverse_elongation", "--n-repeat", 20)
    chosen = fit_of(beds, command, "--n-term", 2, "--score", "median", "--n-repeat", 20)
    terms = {t["term"]: t for t in second["terms"]}
    off = [float(bed["porosity_bulk"]) - eq_17(bed) for bed in beds]
    equant = [bed for bed in beds if inverse_equancy(bed) < FLAT]
    if len(equant) < 10:
        slope = f"too few beds ({len(equant)})"
    else:
        sloped = fit_of(equant, command, "--use", "inverse_equancy,inverse_elongation")["terms"][1]
        slope = f"{sloped['coefficient']:.4f} ± {2 * sloped['standard_error']:.4f} ({len(equant)})"
    return [f"{len(beds)} of 63",
            ", ".join(f"{r['feature']} {r['r']:.3f}" for r in first["ranking"][:3]),
            *(f"{terms[t]['coefficient']:.4f} ± {2 * terms[t]['standard_error']:.4f}" for t in ("inverse_equancy", "inverse_elongation", "intercept")),
            f"{1e3 * second['trials'][0]['cv_mean_error']:.2f}, {1e3 * second['cv_mean_error']:.2f}",
            ", ".join(t["term"] for t in chosen["terms"][1:]),
            f"{mean(off):+.4f}; {spread(off):.4f}",
            slope]


FLAT = 3.7  # 1/EQ of the forms that the paper's Fig. 8 has few of
PIPELINE = ("beds", "features of the largest correlation", "coefficient of 1/EQ", "coefficient of 1/EL", "intercept",
            "held-out mean error of 1/EQ alone, and with 1/EL (10⁻³)", "the two features selected", "beds less eq. 17 as printed: mean; scatter about it",
            f"coefficient of 1/EQ over forms with 1/EQ below {FLAT} (how many)")
PIPELINE_PAPER = ("63", "1/EQ, 1/JFF, WFI (all of them L/S)", "0.019", "0.014", "0.278", "5.74, 4.66", "1/EQ, 1/EL", "", "")


def one_form_beds(record, ellipsoids):
    """Beds of 4 kg of one grain each: forms-126, and of surfaces those of forms-10, which are the same beds."""
    beds = {} if ellipsoids else {b["keys"]: b for b in record.of("forms-10")}
    for bed in record.of("forms-126", ellipsoids="true" if ellipsoids else "false"):
        beds[bed["keys"].split(";")[0]] = bed
    return beds


def pipeline_text(record, command):
    """The paper's own way from beds of one form to its model, on ours."""
    surfaces, eggs = (one_form_beds(record, ellipsoids) for ellipsoids in (False, True))
    columns = [pipeline_of(list(beds.values()), command) for beds in (surfaces, eggs)]
    text = table(("", "paper, U1, 16 kg, 6 s", "ours, surfaces", "ours, their ellipsoids"), list(zip(PIPELINE, PIPELINE_PAPER, *columns)))
    both = [(float(bed["porosity_bulk"]), float(eggs[k]["porosity_bulk"])) for k, bed in surfaces.items() if k in eggs]
    if both:
        text += (f"\n\nSurfaces against ellipsoids, {len(both)} grains: mean difference {mean([p - q for p, q in both]):+.4f}, root mean square "
                 f"{math.sqrt(mean([(p - q) ** 2 for p, q in both])):.4f} (paper, Fig. 10a: 0.0087).")
    return text


def table_9(record, command):
    """Held-out mean error of 1/EQ and each other feature of Table 9."""
    beds = list(one_form_beds(record, False).values())
    ours = [1e3 * fit_of(beds, command, "--use", ",".join(filter(None, ("inverse_equancy", feature))), "--n-repeat", 20)["cv_mean_error"]
            for feature in TABLE_9]
    best = [sorted(values)[:3] for values in (TABLE_9.values(), ours)]
    rows = [(feature or "1/EQ alone", *(f"**{v:.2f}**" if v in least else f"{v:.2f}" for v, least in zip(pair, best)))
            for feature, *pair in zip(TABLE_9, TABLE_9.values(), ours)]
    return table(("beside inverse_equancy", "paper, U1, 63 beds", f"ours, {len(beds)} beds"), rows)


def dip_rows(record):
    for bed in record.of("dip-small"):
        axes = [float(x) for x in bed["keys"].split("=ellipsoid:")[1].split(",")]
        yield axes[0] / axes[2], float(bed["porosity_bulk"]), float(bed["coordination"])


def dip(record):
    text = table(("L/S", "porosity", "coordination"),
                 [(f"{e:.2f}", f"{p:.4f}", f"{z:.2f}") for e, p, z in sorted(dip_rows(record))])
    return text


def spheres(record):
    """Porosity and coordination of spheres by friction and time of shaking."""
    times = ("0.7 s", "2 s", "6 s")
    rows = []
    for friction in ("0.5", "0.1", "0"):
        cells = []
        for time in times:
            beds = record.of("spheres-small", friction=friction, shaking_time=time)
            cells.append(f"{float(beds[0]['porosity_bulk']):.4f} ({float(beds[0]['coordination']):.2f})" if beds else "")
        rows.append((friction, *cells))
    return table(("friction", *times), rows)


def both_ways(record, study, key, value):
    """Porosity by seed, ends trimmed and not, of the beds whose varied key has the value."""
    beds = sorted(record.of(study, **{key: value}), key=lambda b: int(b["seed"]))
    return [{b["seed"]: float(b[column]) for b in beds if b.get(column)} for column in ("porosity_bulk", "porosity_untrimmed")]


def pairs_of_beds(record, study, key, values, labels):
    """A row a seed: two kinds of beds, with their ends trimmed and with nothing left out, and the means."""
    columns = [both_ways(record, study, key, value)[k] for k in (0, 1) for value in values]
    seeds = sorted({seed for column in columns for seed in column}, key=int)
    rows = [(seed, *(f"{column[seed]:.4f}" if seed in column else "" for column in columns)) for seed in seeds]
    rows.append(("mean", *(shown(list(column.values())) for column in columns)))
    return table(("seed", *labels, f"nothing left out: {labels[0]}", labels[1]), rows)


def differences(record, study, key, values):
    """Second kind of beds less the first, of the same seeds."""
    words = []
    for k in (0, 1):
        first, second = (both_ways(record, study, key, value)[k] for value in values)
        off = [second[seed] - first[seed] for seed in first if seed in second]
        words.append(f"{mean(off):+.4f} ± {T95.get(len(off), 1.96) * spread(off) / math.sqrt(len(off)):.4f}" if len(off) > 1 else "not run")
    return f"Differences of the same seeds, with 95 % intervals: {words[0]}; with nothing left out {words[1]}."


STEPS = (("explicit", "5us", "explicit, T_c/40 (published)"), ("explicit", "2.5us", "explicit, T_c/80"), ("exact", "5us", "exact, T_c/40"), ("exact", "10us", "exact, T_c/20"))


def steps(record):
    """Porosity by time step: means, and differences to the published step of the same seeds."""
    published, rows = {}, []
    for scheme, step, label in STEPS:
        beds = {b["seed"]: b for b in record.of("steps-small", contact_scheme=scheme, time_step=step)}
        published = published or beds
        cells = [shown([float(b["porosity_bulk"]) for b in beds.values()]), f"{mean([float(b['coordination']) for b in beds.values()]):.2f}"]
        for key in ("porosity_bulk", "porosity_untrimmed"):
            off = [float(beds[seed][key]) - float(published[seed][key]) for seed in beds if seed in published]
            cells.append("" if beds is published else f"{mean(off):+.4f} ± {half_width(off):.4f}")
        rows.append((label, *cells, f"{mean([float(b['grain_steps']) for b in beds.values()]):.3g}"))
    return table(("steps", "porosity", "contacts a grain", "less published, same seeds", "nothing left out", "grain-steps"), rows)


def rounding(record):
    exact = record.porosities("rounding-small", rounding="0")
    rows = []
    for margin in ("0", "1 um", "3 um", "10 um"):
        values = record.porosities("rounding-small", rounding=margin)
        off = ""
        if margin != "0" and len(values) > 1 and len(exact) > 1:
            error = math.sqrt(spread(values) ** 2 / len(values) + spread(exact) ** 2 / len(exact))
            off = f"{mean(values) - mean(exact):+.4f} ± {T95.get(len(values) + len(exact) - 1, 2.3) * error:.4f}"
        rows.append((margin, shown(values), off))
    return table(("rounding", "porosity", "difference to exact"), rows)


def t_between(first, second):
    """Two-sided p-value of two means (pooled spread), and the sign of second - first; one value a side has no spread of its own."""
    n, m = len(first), len(second)
    squares = sum((v - mean(g)) ** 2 for g in (first, second) for v in g)
    t = (mean(second) - mean(first)) / math.sqrt(squares / (n + m - 2) * (1 / n + 1 / m))
    return pooled.student_tails(t, n + m - 2), 1 if t > 0 else -1


def between_groups(groups):
    """p-value of equal means of several groups (one-way analysis of variance)."""
    values = [v for g in groups for v in g]
    within = sum((v - mean(g)) ** 2 for g in groups for v in g)
    among = sum(len(g) * (mean(g) - mean(values)) ** 2 for g in groups)
    df = len(groups) - 1, len(values) - len(groups)
    return 1 - pooled.f_below(among / df[0] / (within / df[1]), *df)


def pooled_text(record):
    """Every comparison of this page that asks for no difference, each row and all rows of a table as one test."""
    rows = []

    def add(name, pairs, groups=None):
        found = [(*t_between(a, b), len(a), len(b)) for a, b in pairs if a and b and len(a) + len(b) > 2]
        if not found:
            return
        if groups is not None:  # they share a reference, so their p-values are not independent
            way, one = f"analysis of variance over {len(groups)} groups", between_groups(groups)
        elif len(found) > 1:
            way, one = "Stouffer", pooled.stouffer([f[:2] for f in found])[0]
        else:
            way, one = "t", found[0][0]
        rows.append((name, ", ".join(f"{n} beside {m}" for _, _, n, m in found), ", ".join(f"{f[0]:.2g}" for f in found), way, one))

    add("Table 6: ours, 3 kg, against the paper", [(TABLE_6[c], record.porosities("table6", curve=c)) for c in TABLE_6])
    add("Table 11 scaled down: forms drawn against as they are",
        [[record.porosities("table11-small", form_law=law) for law in ("false", "true")]])
    for study, key, values, name in (("rounding-small", "rounding", ("0", "1 um", "3 um", "10 um"), "rounded edges against exact ones"),
                                     ("table7-small", "width", ("70 mm", "85 mm", "100 mm"), "Table 7 scaled down: wider against 70 mm"),
                                     ("table4-small", "faces", ("0", "100", "50"), "Table 4 scaled down: fewer faces against 300")):
        groups = [g for g in (record.porosities(study, **{key: v}) for v in values) if len(g) > 1]
        add(name, [(groups[0], g) for g in groups[1:]], groups)
    n_row = sum(len(r[2].split(",")) for r in rows)
    least = min(float(p) for r in rows for p in r[2].split(","))
    text = table(("question", "beds", "p of each row", "pooled by", "pooled p"), [(*r[:4], f"{r[4]:.2g}") for r in rows])
    return (f"{text}\n\nThat is {n_row} comparisons in {len(rows)} questions, one of them below 0.05 expected by sampling error in {100 * (1 - .95 ** len(rows)):.0f} % "
            f"of such pages. The least p of a row is {least:.2g} ({min(1, n_row * least):.2g} by Bonferroni), Fisher's over the questions "
            f"{pooled.fisher([r[4] for r in rows]):.2g}.")


def cases(command):
    if not (SHARED / "sediment").exists():
        return "Not run: the two scans are not here."
    rows = []
    scans = [str(SHARED / f"sediment/sediment_scan_{k}.obj") for k in (0, 1)]
    for name, (wall, rate, porosity) in CASES.items():
        domain, kind = name.split()
        # the reference's fill is all or nothing; its mass is asked for here
        mass = {"A mesh": .2956, "A eqell": .3139, "A sph": .2281, "P mesh": .3691, "P eqell": .3915, "P sph": .2057}[name]
        shapes = ["--shapes", "sphere"] if kind == "sph" else ["--shapes", scans[0], "--shapes", scans[1]]
        steps = 53048 if name == "A sph" else 40003
        found = [clast_timed(command, "pack", "--curve", "U1", *shapes, *(["--ellipsoids"] if kind == "eqell" else []), "--mass",
                       f"{mass}kg", "--domain", "cylinder" if domain == "A" else "periodic", "--width",
                       "0.104m" if domain == "A" else "0.1m", "--height", "0.2m", "--lid", "--generator", "hcp", "--spacing",
                       "16mm", "--first-low", .1, "--first-high", .9, "--fill-high", .95, "--no-random-turn", *([] if kind == "sph" else ["--no-gyroscopic"]),
                       "--shaking-time", "0.17s", "--max-steps", steps, "--trim", "0mm", "--rule", "speed", "--still-speed", 0,
                       "--seed", seed, "-j", 1) for seed in (41, 42, 43)]
        least = min(1e6 * f["cpu_s"] / f["grain_steps"] for f in found)
        rows.append((name, f"{wall}", f"{rate}", f"{porosity:.4f}", found[0]["n_grain"], f"{found[0]['mass']:.4f}", f"{min(f['cpu_s'] for f in found):.2f}",
                     f"{least:.3f}", f"{rate / least:.0f}", shown([f["porosity_bulk"] for f in found])))
    return table(("case", "their wall s", "their us a grain-step", "their porosity", "our grains", "our kg", "our CPU s (least of 3)",
                  "our us a grain-step", "ratio", "our porosity"), rows)


RULES = "pack --curve U1 --mass 0.2kg --width 0.06m --height 0.4m --shaking-time 0.3s -j 1".split()


def rules(command):
    """The height rule of the paper beside the speed rule: the same grains, one bed a row."""
    rows = []
    for seed in (1, 2, 3):
        for rule in ("height", "speed"):
            bed = clast(command, *RULES, "--rule", rule, "--seed", seed)
            rows.append((seed, f"`{rule}`", f"{bed['time']:.2f}", f"{1e3 * bed['max_speed']:.3g}", f"{bed['n_loose']} of {bed['n_grain']}",
                         f"{bed['coordination']:.2f}", f"{bed['porosity_bulk']:.4f}"))
    return table(("seed", "rule", "ends at (s)", "fastest grain (mm/s)", "grains below four contacts", "coordination", "porosity"), rows)


def kept(head):
    """The table as the page has it, or nothing."""
    lines = (ROOT / "docs/validation/packing.md").read_text(encoding="utf-8").splitlines()
    first = next((i for i, line in enumerate(lines) if line.startswith(f"| {head} ")), None)
    if first is None:
        return ""
    last = next(i for i in range(first, len(lines)) if not lines[i].startswith("|"))
    return "\n".join(lines[first:last])


def full_u1(command):
    """Grain-steps of U1 at L = 0.2 m, 16 kg, 6 s from one fill of the process itself: table, while pouring, after."""
    one = clast(command, "pack", "examples/packing/periodic.yaml", "--max-steps", 1)
    share = one["mass"] / 16
    fills = math.ceil(1 / share)
    g, drop = 9.81 * (1 - 1000 / 2650), 0.4
    fall = (math.sqrt(1 + 2 * g * drop) - 1) / g
    per_fill = round(fall / 5e-6)
    grains = [min(one["n_grain"] * (k + 1), one["n_grain"] / share) for k in range(fills)]
    pouring, rest = per_fill * sum(grains), 6.1 / 5e-6 * grains[-1]
    tenth, done, step = 0.1 * (pouring + rest), 0, 0
    for n in grains:
        part = min(per_fill, max(0, (tenth - done) / n))
        done, step = done + part * n, step + part
    rows = [("grains", f"{grains[-1]:.0f}"), ("fills", fills), ("steps", f"{fills * per_fill + 6.1 / 5e-6:.3g}"),
            ("grain-steps while pouring", f"{pouring:.3g}"), ("grain-steps after", f"{rest:.3g}"),
            ("`--max-steps` of a tenth of all grain-steps", f"{step:.0f}")]
    rows += [(f"hours at {ns} ns a grain-step", f"{(pouring + rest) * ns * 1e-9 / 3600:.2f}") for ns in (100, 150, 200, 250, 300)]
    return table(("U1, L = 0.2 m, 16 kg, 6 s", ""), rows), pouring, rest


def part_of_u1(dense, folder, earlier, pouring, rest):
    """What a part of the full bed took, and what the whole would."""
    with open(folder / "summary.json", encoding="utf-8") as file:
        end = json.load(file)
    parts = []
    for path in [*earlier, folder / "manifest.json"]:
        with open(path, encoding="utf-8") as file:
            parts.append(json.load(file))
    run, wall, cpu = parts[-1], sum(part["wall_s"] for part in parts), sum(part["cpu_s"] for part in parts)
    rate = wall / end["grain_steps"]
    rows = [("threads", run["threads"]), ("processor", f"{run['host']['processor']}, {run['host']['cores']} cores"),
            ("steps", end["n_step"]), ("grains at its end", end["n_grain"]),
            ("grain-steps", f"{end['grain_steps']:.3g} ({100 * end['grain_steps'] / (pouring + rest):.1f} % of all)"),
            ("wall, CPU s", f"{wall:.0f}, {cpu:.0f}"), ("wall ns a grain-step", f"{1e9 * rate:.0f}"),
            ("hours, all grain-steps at the part's rate", f"{(pouring + rest) * rate / 3600:.2f}"),
            *((f"hours, pouring at the part's rate, the rest at {ns:g} ns", f"{(pouring * rate + rest * 1e-9 * ns) / 3600:.2f}") for ns in dense)]
    return table(("part of U1, measured", ""), rows)


def known(command):
    if not (SHARED / "packings").exists():
        return "Not run: data of others are not here."
    edge, data = 20.0823593086113, (SHARED / "packings/rcp10000/packing.xyzd").read_bytes()
    points = [struct.unpack_from("<4d", data, 32 * i)[:3] for i in range(len(data) // 32)]
    images = [(x, y, z + s) for x, y, z in points for s in (-edge, 0, edge) if -0.5 < z + s < edge + 0.5]
    lines = [(SHARED / f"packings/voro/pack_{n}.txt").read_text().splitlines() for n in ("ten_cube", "cylinder")]
    voro = [[tuple(map(float, line.split()[1:])) for line in text] for text in lines]
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        path, cells = pathlib.Path(folder) / "spheres.csv", pathlib.Path(folder) / "cells"

        def profile(spheres, *arguments):
            path.write_text("x,y,z,radius\n" + "".join(f"{x!r},{y!r},{z!r},0.5\n" for x, y, z in spheres), encoding="ascii")
            return clast(command, "porosity", path, *arguments)["profile"]

        layer = edge / 400
        found = profile(images, "--bed", f"periodic:0,0,{edge},{edge}", "--floor", repr(-10 * layer), "--layer", repr(layer),
                        "--cut", 0.9)
        rows.append(("random close packing of 10,000 spheres (Baranau)", "0.353520998",
                     f"{mean([r['porosity'] for r in found[10:410]]):.9f}"))
        for name, spheres, bed, low, high, counted in (
                ("1000 spheres in a box (voro++), -3..3, -3..3, 2..7", voro[0], "box:-5,-5,5,5", 2, 7, .631),
                ("2300 spheres in a cylinder (voro++), -3..3, -3..3, 3..14", voro[1], "cylinder:6", 3, 14, .632)):
            profile(spheres, "--bed", bed, "--layer", 0.1, "--cut", 0.9, "--local", "--force", "-o", cells)
            inside = []
            for cell in read_csv(cells / "local.csv"):
                x, y, z = spheres[int(cell["grain"])]
                inside += [cell] if max(abs(x), abs(y)) < 3 and low < z < high else []
            rows.append((name + f": {len(inside)} radical Voronoi cells", f"{1 - counted:.3f} (cut at the sides)",
                         f"{1 - len(inside) * math.pi / 6 / sum(float(r['cell']) for r in inside):.4f}"))
    return table(("packing", "published or counted", "ours"), rows)


def half_width(values):
    return T95.get(len(values), 1.96) * spread(values) / math.sqrt(len(values)) if len(values) > 1 else math.nan


def draw_curves(record, library):
    """Table 6 as a chart: experiment, paper, ours over the curves."""
    curves, series = list(TABLE_3), []
    series.append(chart.points("experiment", -1, [(i + .8, TABLE_3[k]) for i, k in enumerate(curves)]))
    series.append(chart.points("paper, 3 kg", 0, [(i + .93, mean(TABLE_6[k])) for i, k in enumerate(curves)],
                               [half_width(TABLE_6[k]) for k in curves]))
    for study, label, colour, shift in (("table6", "ours, 3 kg", 1, 1.07), ("table6-small", "ours, 1 kg", 2, 1.2)):
        found = [(i, record.porosities(study, curve=k)) for i, k in enumerate(curves)]
        found = [(i, v) for i, v in found if v]
        if found:
            series.append(chart.points(label, colour, [(i + shift, mean(v)) for i, v in found], [half_width(v) for _, v in found]))
    notes = [(i + 1, .263, k) for i, k in enumerate(curves)]
    chart.draw(library, RECORD.with_name("packing_curves.svg"), "Porosity of seven sieve curves in the cylinder", "curve",
               "porosity (-)", series, notes, (.5, 7.5))


def draw_forms(record, library):
    """Fig. 10 as a chart: surfaces, their ellipsoids, the paper's linear model, ellipsoids of I = sqrt(L S)."""
    rows = forms(record, "forms-small")
    eggs = [(e, q) for _, e, _, q, _ in rows if not math.isnan(q)]
    series = [chart.points("surfaces", 1, [(e, p) for _, e, p, _, _ in rows]), chart.points("their ellipsoids", 0, eggs),
              chart.line("eq. 17 of the paper (6 s of shaking)", -1, [(e, m) for _, e, _, _, m in rows], True)]
    smooth = sorted((e, p) for e, p, _ in dip_rows(record))
    if smooth:
        series.append(chart.points("ellipsoids, I = sqrt(L S)", 2, smooth))
    reach = max([e for _, e, _, _, _ in rows] + [e for e, _ in smooth])
    chart.draw(library, RECORD.with_name("packing_forms.svg"), "One form a packing, U1 (scaled down)", "L/S (-)", "porosity (-)",
               series, x_range=(.8, reach + .2))


def draw_one_form(record, command, library):
    """Fig. 10 and 9 on beds of 4 kg: porosity over L/S, surfaces beside ellipsoids; what models say beside what beds have."""
    surfaces, eggs = ([(inverse_equancy(bed), float(bed["porosity_bulk"])) for bed in one_form_beds(record, ellipsoids).values()]
                      for ellipsoids in (False, True))
    beds = list(one_form_beds(record, False).values())
    printed = [(float(bed["porosity_bulk"]), eq_17(bed)) for bed in beds]
    terms = {t["term"]: t["coefficient"] for t in fit_of(beds, command, "--use", "inverse_equancy,inverse_elongation")["terms"]}
    ours = [(float(bed["porosity_bulk"]), terms["intercept"] + terms["inverse_equancy"] * inverse_equancy(bed)
             + terms["inverse_elongation"] / float(bed["elongation_mean"])) for bed in beds]
    ends = [min(p for p, _ in printed) - .01, max(p for p, _ in printed) + .01]
    chart.draw(library, RECORD.with_name("packing_one_form.svg"), f"One form a bed, U1, 4 kg: {len(surfaces)} surfaces, {len(eggs)} ellipsoids",
               "1/EQ = L/S (-)", "porosity (-)",
               [chart.points("surfaces", 1, surfaces), chart.points("their ellipsoids", 0, eggs),
                chart.points("eq. 17 of the paper (16 kg, 6 s of shaking)", -1, [(e, eq_17(bed)) for (e, _), bed in zip(surfaces, beds)])])
    chart.draw(library, RECORD.with_name("packing_predicted.svg"), f"Models of one form beside {len(beds)} beds of 4 kg", "porosity of the bed (-)",
               "porosity by the model (-)",
               [chart.points("fitted to these beds", 1, ours), chart.points("eq. 17 as printed", 0, printed),
                chart.line("equal", -1, [(p, p) for p in ends], True)])


def page(record, command, timed, measured):
    return f"""# Packings: the paper beside ours

Made by `tools/paper_packing.py` (`make paper-packing`); every bed of a study (next table) is a row of `packing.csv`. Paper: Rettinger, Rüde, Vollmer and Frings,
Granular Matter 24 (2022) 118. **Its 63 scans are not public here**: beds of grains rest on the stand-in of `data/standin63` (other
stones, stretched to the same means and deviations of form), so trends are compared, not third digits. Nothing was tuned; physics, process and
evaluation are the published ones but where a row says "scaled down". Intervals are 95 % by Student's t over realisations, with
their number in brackets; one bed has no interval. ± of fits and of the models' predictions is twice the standard error, ± of the paper as it prints it.
In no table of the repository: the exact steps of T_c/20 in beds of 4 kg and of T_c/10, the twelve beds of ellipsoids, the unshaken beds in water; *Two rules*, cases A and P and
the known packings are run by the tool.

## What was run

{what_was_run(record)}

Full-size studies that do not appear, or only in part, were not run here: `clast study examples/packing/NAME.yaml -o NAME` does.

## Table 6: seven curves in the cylinder

{table_6(record)}

![Porosity over the curves](packing_curves.svg)

## Table 4: mesh resolution (cylinder, t_s = 2 s)

{table_4(record)}

## Table 5: shaking time, cylinder

{shaking(record, TABLE_5, "table5", "table5-small", (0, 1, 2, 3), (0, 0.5, 1, 2))}

## Table 7: width of the periodic box

{table_7(record)}

U7 and B50 at 0.1 m hold stand-in grains longer than half the period (up to 96 mm). The paper's program shrinks such grains; here they stay as they are and touch others in several images.

## Table 8: shaking time, periodic box

{shaking(record, TABLE_8, "table8", "table8-small", (1, 2, 3, 4, 6, 8), (0.5, 1, 2, 4))}

## Fig. 8 to 10: one form a packing

Scaled down (`forms-small`): U1, L = 60 mm, 0.4 kg, t_s = 1 s, 12 mm cut off at both ends. The paper has L = 0.2 m, 16 kg, 6 s, so ours are
shaken less and expected looser.

{forms_text(record, "forms-small")}

![Porosity over L/S](packing_forms.svg)

`clast fit` on the same table (Fig. 8; the paper names L/S first, then 1/JFF and WFI):

{fit_text(record, command, "forms-small")}

Ellipsoids of I = sqrt(L S) (`dip-small`; the paper: 0.36 for spheres, least near L/S = 2):

{dip(record)}

Spheres (`spheres-small`), porosity and coordination by friction and time of shaking. Random close packing of spheres, 0.36, is the state
without friction (isostatic, six contacts a grain); with the paper's friction of 0.5 grains lock into looser beds, which shaking
brings down by about 0.01 for each threefold time:

{spheres(record)}

Ten single forms at L = 0.1 m, 4 kg, t_s = 1 s (`forms-10`; ellipsoids of `forms-126`):

{forms_text(record, "forms-10")}

### The paper's way to its model, on beds of 4 kg

`forms-126`: each of the 63 grains as surface and as ellipsoid, L = 0.1 m, 4 kg, t_s = 1 s (the paper: 0.2 m, 16 kg, 6 s; beds that are shaken
less are looser, which the intercept takes up). ± is twice the standard error.

{pipeline_text(record, command)}

![Porosity of one form a bed over L/S](packing_one_form.svg)

Table 9: held-out mean error of two features, 10⁻³ (`clast fit --use inverse_equancy,FEATURE --n-repeat 20`); the three smallest of each column bold:

{table_9(record, command)}

Fig. 9: what the models give beside what the beds have.

![Predicted beside observed porosity](packing_predicted.svg)

## Table 11: forms as they are, or drawn

{table_11(record, command)}

Scaled down: `table11-small` (L = 140 mm, 2.1 kg), else the exact beds of `rounding-small` (0.5 kg); both are shaken for 1 s, the paper's for 6 s.

## Two rules that end a bed

The paper's rule, the mean height moves by less than 10 um in 10 ms (`--rule height`), beside no grain faster than 1 mm/s (`--rule speed`):
spheres of U1, 0.2 kg in a cylinder of 60 mm, shaken 0.3 s (`clast {" ".join(RULES)}`). The mean height is level
while grains still rattle, so that the first rule ends before contacts have formed: coordination says which rule a bed ended by, and porosity
falls by up to 0.005 until the second one.

{rules(command)}

## Steps and water

Hulls of one long grain (`grain03`, L/S 4.3) of U1, 0.25 kg in a periodic box of 56 mm, shaken 0.5 s, 24 seeds (`steps-small`); porosity without 10 mm at both ends, and with
nothing left out. The published explicit steps of T_c/40 beside half of them, and beside `--contact-scheme exact`:

{steps(record)}

Explicit steps of T_c/40 and T_c/80 and exact ones of T_c/40 agree within their errors. **Exact steps of T_c/20 make denser beds**, here and in six beds of 4 kg (forms of
`forms-10`: -0.0028 ± 0.0024, by form 0.0000 to -0.0057, a bed's own scatter in it): where a grain has more contacts than such steps bear, their dashpots are reduced (`../theory/dem.md`). They do for a look at half the price, not for
porosities to 0.005. (Twelve ellipsoid beds of 280 grains, which stood here before, were not conclusive: -0.0031 ± 0.0059.)
Explicit steps of T_c/20 did not end: after 1 s of damping the fastest of 280 ellipsoids moved at 2.0 to 2.7 mm/s; at T_c/10 the mean height itself moved on. Both are refused.
Exact steps of T_c/10 (with an earlier form of the limit for grains with many contacts) gave -0.0047 ± 0.0026 over ten seeds, and are refused too.

Ellipsoids 1.5:1:0.7 of U1, 0.2 kg (some 280 grains) in a periodic box of 50 mm, shaken 0.3 s, ended by `--rule speed`, between 8 mm from the floor and 8 mm below the top:
as published, less buoyancy alone, beside `--fluid-viscosity "1e-3 Pa s" --hindrance --added-mass 0.5 --wet-restitution`
(`water-small`):


{pairs_of_beds(record, "water-small", "hindrance", ("false", "true"), ("less buoyancy alone", "in water"))}

{differences(record, "water-small", "hindrance", ("false", "true"))} It is how grains arrive that counts, not
shaking: unshaken, seeds 1 and 2 have 0.4164 and 0.4103 in water, 0.3699 and 0.3722 less buoyancy alone; shaking takes 0.012 to 0.020 off both. In water grains land
slower (1.0 m/s at most, their speed at the start, not 2.6) and come to rest where they touch. The paper's choice gives beds as dense as pouring in air makes them; who asks for a
bed that fell through still water takes the options. Small boxes, one form, one shaking: no more follows.

## Rounded edges

`rounding-small`: the same seeds, so the same grains, at four radii; 10 um is 1.5e-3 of a grain. Chaos makes each bed another realisation.
Fewer than three beds a side settle nothing: their own spread is then a poor estimate of the scatter, and the interval with it.

{rounding(record)}

## All rows together

Each interval above judges its own row. Here all rows of a question are one test: two-sided p-values of t tests with pooled spread, joined by Stouffer's rule, or one
analysis of variance where rows share a reference. A p-value says how often beds without a difference differ as far; two or three beds a side
would hide a difference of 0.01 more often than not, so a large p is no proof of equality.

{pooled_text(record)} Table 6 differs by more than sampling error; our stones are not the paper's, which may be why: nothing here tests it.

## Cases A and P of the reference program (two Rhine scans)

The reference's times are of another machine. Its beds are 3 to 4 grains deep and still creeping when stopped, so porosities are no
validation; its fill is all or nothing, so we ask for the mass that it reached; but our lattice
leaves points empty where two grains' spheres would cross, so a fill of long grains holds fewer. Seeds 41, 42, 43, one thread.

{timed}

## U1 at full size: what it takes

The whole was not run here. The grain-steps are arithmetic on the number of grains in a fill; what a part of them took is measured below, where
it was run (`clast pack examples/packing/periodic.yaml --max-steps N -j 2`). The rest of it is a dense bed: at the rate of the part's last stretch, from 20,000
grains on, or at that of a settled bed of 20,000 (`bench_tiles 5 1 2`). The paper-like program: 9.8 days of one core.

{full_u1(command)[0]}

{measured or "No part of it was run."}

## Known packings

{known(command)}
"""


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--clast", default=str(ROOT / "build/release/clast"))
    parser.add_argument("--runs", type=pathlib.Path, nargs="+", default=[ROOT / "build/paper-packing"])
    parser.add_argument("--run", nargs="*")
    parser.add_argument("--keep-cases", action="store_true")
    parser.add_argument("--u1", nargs="+", metavar=("DENSE", "FOLDER"))
    args = parser.parse_args()
    for study in (args.run or SMALL) if args.run is not None else ():
        subprocess.run([args.clast, "study", f"examples/packing/{study}.yaml", "-o", str(args.runs[0] / study)], check=True, cwd=ROOT)
    timed = kept("case") if args.keep_cases else cases(args.clast)
    measured = kept("part of U1, measured")
    if args.u1:
        folder, *earlier = map(pathlib.Path, args.u1[1:])
        measured = part_of_u1([float(ns) for ns in args.u1[0].split(",")], folder, earlier, *full_u1(args.clast)[1:])
    record = Record(args.runs)
    record.write()
    library = pathlib.Path(args.clast).resolve().parent / "libclast_view.so"
    draw_curves(record, library)
    draw_forms(record, library)
    draw_one_form(record, args.clast, library)
    text = page(record, args.clast, timed, measured)
    (ROOT / "docs/validation/packing.md").write_text(text, encoding="utf-8")
    print(f"packing: {len(record.beds)} beds in docs/validation/packing.csv, page docs/validation/packing.md")


if __name__ == "__main__":
    main()
