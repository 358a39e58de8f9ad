"""Size and form of many grains at once, and the statistics of the set."""
from __future__ import annotations

import ctypes
import os
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from . import _bindings as c
from ._core import (Error, Floats, Monitor, Owner, Progress, call, changed, check, choice, encoded, html_table, items, note, output_path, quantity, refuse,
                    refuse_idle, require_writable, settled, status_name, view, warn)
from ._html import file_html
from ._tables import Path, Table, given_table, table_of


@dataclass(frozen=True, eq=False)
class GrainStatistics:
    """Statistics of a set of grains: means and deviations with bootstrap intervals of 95 %, correlation, principal components."""

    n: int
    n_left_out: int
    zingg: dict[str, int]
    columns: Table  #: a row a form factor: mean, deviation, quantiles, Shapiro-Wilk
    correlation: Floats  #: Pearson's r of each two rows of `columns`
    variance: Floats  #: of the principal components
    explained: Floats
    _owner: Owner = field(repr=False)

    def write(self, folder: Path, charts: str = "svg") -> None:
        """Writes the tables and charts of `clast shape --statistics` into a folder, which is made."""
        place = output_path("folder", folder, is_folder=True)
        os.makedirs(folder, exist_ok=True)
        check(call("clast_grain_statistics_write")(ctypes.byref(self._owner.struct), place, encoded("charts", charts)))

    def _repr_html_(self) -> str:
        def zingg(path: str) -> None:
            folder = os.path.dirname(path)
            self.write(folder)
            os.replace(os.path.join(folder, "zingg.svg"), path)
        return html_table({"grains": self.n, **self.zingg}) + self.columns._repr_html_() + file_html(zingg, "svg", "Zingg diagram")


@dataclass(frozen=True, eq=False)
class Grains:
    """Measures of many grains: `table` as `clast shape -o` writes it, one line for each that could not be measured."""

    table: Table
    faults: tuple[str, ...]
    left_out: tuple[str, ...]
    unit: str  #: "m" or "model"

    def __len__(self) -> int:
        return len(self.table)

    def statistics(self, *, resamples: int = 2000, seed: int = 1) -> GrainStatistics:
        """Statistics of the set's form factors and sizes."""
        return grain_statistics(self.table, columns="flatness,elongation", resamples=resamples, seed=seed)

    def _repr_html_(self) -> str:
        return self.table._repr_html_() + (html_table({"not measured": "; ".join(self.faults)}) if self.faults else "")


def grain_statistics(table: Any, *, columns: str = "", resamples: int = 2000, seed: int = 1) -> GrainStatistics:
    """Statistics of a table with a row a grain: a file, a structured array, a DataFrame, a dictionary of columns."""
    given = settled("shape", dict(resamples=resamples, seed=seed))
    rows, owner = given_table("table", table), Owner(c.clast_grain_statistics(), "clast_grain_statistics_free")
    bootstrap = c.clast_bootstrap(n_resample=given["resamples"], level=0.95, seed=given["seed"])
    check(call("clast_grain_statistics_of")(ctypes.byref(rows.struct), encoded("columns", columns) or None, ctypes.byref(bootstrap),
                                            ctypes.byref(owner.struct)))
    warn_of_rows(owner.struct.set)
    s = owner.struct.statistics
    shares = [f"q{round(100 * call('clast_quantile_share')(k)):02d}" for k in range(len(s.summary[0].quantile))] if s.n else []
    plain = [one[0] for one in c.clast_sample_summary._fields_ if one[0] not in ("quantile", "n_left_out", "is_constant")]
    kinds: list[Any] = [("name", "U32"), *((name, "i8" if name == "n" else "f8") for name in (*plain, *shares))]
    found = np.zeros(s.n, kinds).view(Table)
    for k in range(s.n):
        one = s.summary[k]
        found[k] = (s.name[k].decode(), *(getattr(one, name) for name in plain), *one.quantile)
    zingg = {call("clast_zingg_name")(k).decode(): owner.struct.zingg[k] for k in range(len(owner.struct.zingg))}
    return GrainStatistics(owner.struct.set.n, owner.struct.set.n_left_out, zingg, found, view(owner, s.r, (s.n, s.n), np.float64),
                           view(owner, s.variance, (s.n_pca,), np.float64), view(owner, s.explained, (s.n_pca,), np.float64), owner)


def warn_of_rows(forms: Any, is_bed: bool = True) -> None:
    """Warns of the rows of a table that were left out and, where all are one bed's, of numbers of grains that are not looked at."""
    words = ctypes.create_string_buffer(512)
    for of in ("clast_form_set_complaint", "clast_form_set_count_words")[:1 + is_bed]:
        call(of)(ctypes.byref(forms), len(words), ctypes.cast(words, ctypes.c_char_p))
        if words.value:
            warn(words.value.decode("utf-8", "replace"))


def _numbers(name: str, value: Any, counts: tuple[int, ...]) -> list[float]:
    """So many numbers above 0, from a number, a sequence or "A,B,C"."""
    try:
        found = [float(one) for one in (value.split(",") if isinstance(value, str) else items(name, value))]
    except (TypeError, ValueError):
        found = []
    if len(found) not in counts or not all(0 < x < np.inf for x in found):
        raise refuse(f"{name}: {value!r} is not {' or '.join(map(str, counts))} numbers above 0")
    return found


def shapes(*files: Path, axes: str = "ellipsoid", hull: bool = False, unit: str = "", kind: str = "auto", degree: int = -1, level: int = 5,
           spacing: float = 0.0, voxels: Any = None, voxel_type: str = "u8", big_endian: bool = False, skip: int = 0, voxel_edge: Any = None,
           dataset: str = "", threshold: float | None = None, least_voxels: int = 1, columns: str = "",
           surfaces: Path | None = None, progress: Progress = None) -> Grains:
    """Measures every grain of many files, in parallel: surfaces, series of harmonics, volumes of labels or grey values, points, tables.

    What cannot be measured is listed in `faults` and warned of, the others are measured. `unit` is that of files that do not say theirs; where none says one,
    lengths are those of the files.
    Ctrl-C ends it between files; nothing is kept but surfaces written by then.
    """
    if not files:
        raise refuse("files: none is given")
    words = c.KEYS["shape"]
    given = settled("shape", dict(axes=axes, hull=hull, degree=degree, level=level, spacing=spacing, kind=kind, unit=unit, voxel_type=voxel_type,
                                  big_endian=big_endian, skip=skip, least_voxels=least_voxels))
    options = c.clast_grains_options(kind=choice("kind", given["kind"], words["kind"][5] or ""), hull=given["hull"], degree=given["degree"],
                                     level=given["level"], spacing=given["spacing"], dataset=encoded("dataset", dataset),
                                     has_threshold=threshold is not None,
                                     threshold=0.0 if threshold is None else quantity("threshold", threshold), least_voxels=given["least_voxels"],
                                     columns=encoded("columns", columns) or None,
                                     folder=None if surfaces is None else output_path("surfaces", surfaces, *files, is_folder=True),
                                     unit=encoded("unit", given["unit"]))
    volume = options.volume
    volume.type, volume.is_big_endian, volume.skip = choice("voxel_type", given["voxel_type"], words["voxel_type"][5] or ""), given["big_endian"], given["skip"]
    if voxels is not None:
        sizes = _numbers("voxels", voxels, (3,))
        if any(size != int(size) or size >= 2**31 for size in sizes):
            raise refuse(f"voxels: {voxels!r} are not sizes")
        volume.n[:] = [int(size) for size in sizes]
    if voxel_edge is not None:
        edges = _numbers("voxel_edge", voxel_edge, (1, 3))
        volume.edge[:] = edges * 3 if len(edges) == 1 else edges
    others = dict(voxels=voxels, voxel_edge=voxel_edge, dataset=dataset, threshold=threshold, columns=columns, surfaces=surfaces)
    names = [*changed("shape", given), *(name for name, value in others.items() if value is not None and not (isinstance(value, str) and value == ""))]
    refuse_idle(names, "clast_grains_idle", ctypes.byref(options), 0)
    metres = ctypes.c_double()
    if given["unit"]:
        check(call("clast_unit_factor")(encoded("unit", given["unit"]), b"m", ctypes.byref(metres)))
    if surfaces is not None:
        require_writable(os.path.join(os.fsdecode(surfaces), "*.ply"))
    return _measure(files, options, names, metres.value, Monitor(progress), choice("axes", given["axes"], words["axes"][5] or ""))


def _measure(files: tuple[Path, ...], options: Any, keywords: list[str], metres: float, monitor: Monitor, axes: int) -> Grains:
    owner, table = Owner(c.clast_grains(), "clast_grains_free"), Owner(c.clast_table(), "clast_table_free")
    names = (ctypes.c_char_p * len(files))(*(encoded("files", file) for file in files))
    check(monitor.run(lambda m: call("clast_grains_read")(len(files), names, ctypes.byref(options), m, ctypes.byref(owner.struct))))
    g = owner.struct
    records = [g.record[k] for k in range(g.n)]
    if not g.n_fault:  # which may be of any kind
        refuse_idle(keywords, "clast_grains_idle", ctypes.byref(options), sum({1 << one.kind for one in records}))
    in_metres = ctypes.c_bool()
    check(call("clast_grains_to_metres")(ctypes.byref(g), metres, ctypes.byref(in_metres)))
    check(call("clast_grains_table")(ctypes.byref(g), axes, in_metres, ctypes.byref(table.struct)))
    faults, notes = (tuple(lines[k].text.decode("utf-8", "replace") for k in range(n)) for lines, n in ((g.fault, g.n_fault), (g.note, g.n_note)))
    for line in notes:
        warn(line)
    left_out = tuple(line for k, line in enumerate(notes) if status_name(g.note[k].status) == "CLAST_OK")
    n_mask = sum(one.is_smoothed and one.kind == c.VALUES["CLAST_GRAINS_VOXELS"] for one in records)
    if n_mask:
        note(f"{n_mask} of {g.n} grains are of a mask (one value inside, one outside, no grey levels at threshold): their surfaces are smoothed as "
             "labels' are")
    if faults and not g.n:
        raise Error(status_name(g.fault[g.n_fault - 1].status), faults[-1])
    if faults:
        warn(f"{len(faults)} file{'s' if len(faults) > 1 else ''} or grain{'s' if len(faults) > 1 else ''} could not be measured (first: {faults[0]})")
    return Grains(table_of(table), faults, left_out, "m" if in_metres.value else "model")
