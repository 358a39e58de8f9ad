"""Sizes in a well-mixed box, without positions; and what a kernel's range says of a run."""
from __future__ import annotations

import ctypes
import math
from dataclasses import dataclass
from typing import Any, Iterable

import numpy as np

from . import _bindings as c
from ._core import Config, Error, Monitor, Owner, Progress, call, check, html_last, nearest, refuse, refuse_idle, warn
from ._tables import Table, given_table, table_of

_OF_CLOUDS = ("rebuild", "change_level", "fixed", "depth", "self_collisions")


def check_used(config: Any, names: Iterable[str], settles: bool = False) -> None:
    """Sets the mask of the kernels, and refuses keys that they, the law of sticking, the radii, or settling in a box do not look at."""
    mask, collide = ctypes.c_uint32(), config.collide
    check(call("clast_kernel_parse")(config.kernel, ctypes.byref(mask)))
    for name in names:
        collide.kernel = mask.value | (1 << c.VALUES["CLAST_KERNEL_SETTLING"] if settles and name != "efficiency" else 0)
        by = call("clast_collide_idle")(ctypes.byref(collide), name.encode())
        if by is not None:
            raise Error("CLAST_E_CONFIG", f"{name} does nothing with this {by.decode()}")
    collide.kernel = mask.value


def warn_of_range(report: Any) -> None:
    """Warns where particles or collisions lie beyond the range of their kernel, as the command does."""
    used = report.collisions if report.collisions.outside > 0 or not report.start.outside > 0 else report.start
    if used.outside > 0:
        words = ctypes.create_string_buffer(512)
        call("clast_range_use_words")(ctypes.byref(used), len(words), ctypes.cast(words, ctypes.c_char_p))
        shares = [100 * (one.outside / one.n if one.n > 0 else 0.0) for one in (report.start, report.collisions)]
        since = f", over 0.1 % of them from t = {report.time:.4g} s on" if math.isfinite(report.time) else ""
        warn(f"{words.value.decode()}; beyond lie {shares[0]:.3g} % of the particles at the start and {shares[1]:.3g} % of the collisions{since}")


def warn_of_dense(volume_fraction: float) -> None:
    if volume_fraction > 0.1:
        warn(f"the particles fill {100 * volume_fraction:.3g} % of the volume; kernels are of dilute suspensions: look at the units")


def _warn_of_start(history: Table, law: Any) -> None:
    """Warns where drawn particles do not hold what their law has, as the command does: a tail of few large ones is in few samples."""
    mass, second = history["M1"][0], history["M2"][0]
    if abs(mass - law.law_M1) > 0.01 * law.law_M1 or abs(second - law.law_M2) > 0.01 * law.law_M2:
        warn(f"the particles drawn hold {100 * mass / law.law_M1:.4g} % of the mass and {100 * second / law.law_M2:.3g} % of M2 of their law at "
             "the start: its tail is in few of so many; take more particles or solver='sectional'")


@dataclass(frozen=True, eq=False)
class Spectrum:
    """A box in time: `history` has numbers and moments [1/m3], `spectrum` a row a time and size; NaN: not, or not known."""

    history: Table
    spectrum: Table
    n_section: int
    gel_time: float
    is_gelation: bool
    exact_gel_time: float
    mass_error: float

    def _repr_html_(self) -> str:
        return html_last(self.history, "time_s", "M0", "M1", "M2", "exact_M0", "exact_M2")


def box_model(*, sizes: Any = None, seed: int | None = None, progress: Progress = None, **keys: Any) -> Spectrum:
    """Evolves the sizes of particles in a well-mixed box (`clast agglomerate --box-model`): box_model(concentration=1e12, kernel="constant").

    Monte Carlo, or solver="sectional" for breakage, sources and settling too. `sizes` is a table of the start, columns size (monomers) and
    number (1/m3; shares, where concentration is given), or the spectrum of a box, whose last time is taken: a file, a structured array, a
    DataFrame or a dictionary; it is initial="table".
    Ctrl-C ends it between steps.
    """
    own = set(_FIELDS["clast_spectrum_fields"])
    for name in keys:
        if name in _OF_CLOUDS:
            raise Error("CLAST_E_CONFIG", f"{name}: is a key of clouds; a box has no positions")
        if name not in own and name not in _FIELDS["clast_agglomerate_fields"]:
            raise Error("CLAST_E_CONFIG", f"no keyword {name}{nearest(name, own | set(_FIELDS['clast_agglomerate_fields']))}")
    if sizes is not None and keys.setdefault("initial", "table") != "table" or sizes is None and keys.get("initial") == "table":
        raise refuse("sizes: and initial='table' go together")
    start, held = c.clast_spectrum_start(), None
    if sizes is not None:
        held = given_table("sizes", sizes)
        check(call("clast_spectrum_start_from_table")(ctypes.byref(held.struct), ctypes.byref(start)))
    result, monitor = Owner(c.clast_spectrum(), "clast_spectrum_free"), Monitor(progress)
    parts = [{name: value for name, value in keys.items() if (name in own) == is_own} for is_own in (True, False)]
    with Config(c.clast_spectrum_config(), "clast_spectrum_fields", parts[0]) as box, \
            Config(c.clast_agglomerate_config(), ("clast_agglomerate_fields", "clast_decompose_fields"), {**parts[1], "seed": seed}) as rest:
        a, s = rest.struct, box.struct
        check_used(a, parts[1], s.settling_depth > 0)
        names = [*box.changed(), *rest.changed()]
        refuse_idle(names, "clast_spectrum_idle", ctypes.byref(s))
        refuse_idle(names, "clast_agglomerate_idle", ctypes.byref(a), ctypes.byref(c.clast_agglomerate_given()))
        a.collide.seed = a.decompose.seed
        s.duration, s.n_step, s.repeats = a.duration, a.n_step, a.repeats
        check(monitor.run(lambda m: call("clast_spectrum_evolve")(ctypes.byref(start) if held is not None else None, ctypes.byref(s),
                                                                  ctypes.byref(a.collide), m, ctypes.byref(result.struct))))
    r = result.struct
    warn_of_range(r.range)
    warn_of_dense(r.volume_fraction)
    history = table_of(result, r.history)
    if s.solver == c.VALUES["CLAST_SOLVER_MONTE_CARLO"]:
        _warn_of_start(history, r)
    return Spectrum(history, table_of(result, r.spectrum), r.spectrum.n_row // max(1, len(np.atleast_1d(history))), r.gel_time, r.is_gelation,
                    r.exact_gel_time, r.mass_error)


_FIELDS = {table: tuple(c.TABLES[table]) for table in ("clast_spectrum_fields", "clast_agglomerate_fields")}
