"""Sizes in a well-mixed box, without positions; and what the library says of a run."""
from __future__ import annotations

import ctypes
from dataclasses import dataclass
from typing import Any, Iterable

import numpy as np

from . import _bindings as c
from ._core import Config, Error, Monitor, Owner, Progress, call, check, html_last, refuse, refuse_idle, warn
from ._tables import Table, given_table, table_of


def check_used(config: Any, names: Iterable[str], settles: bool = False) -> None:
    """Sets the mask of the kernels, and refuses keys that they, the law of sticking, the radii, or settling in a box do not look at."""
    mask = ctypes.c_uint32()
    check(call("clast_kernel_parse")(config.kernel, ctypes.byref(mask)))
    config.collide.kernel = mask.value
    for name in names:
        by = call("clast_collide_idle")(ctypes.byref(config.collide), name.encode(), settles)
        if by is not None:
            raise Error("CLAST_E_CONFIG", f"{name} does nothing with this {by.decode()}")


def warn_by(words: str, *facts: Any) -> None:
    """Warns of what the library says of these: "" is nothing."""
    text = ctypes.create_string_buffer(1024)
    line = call(words)(*facts, len(text), text)
    if line:
        warn(line.decode("utf-8", "replace"))


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
    own = set(c.TABLES["clast_spectrum_fields"])
    for name in keys:
        if not call("clast_agglomerate_takes")(name.encode(), True):
            raise Error("CLAST_E_CONFIG", f"{name}: is a key of clouds; a box has no positions")
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
    for k in range(c.VALUES["CLAST_N_SPECTRUM_NOTE"]):
        warn_by("clast_spectrum_note", ctypes.byref(r), k)
    history = table_of(result, r.history)
    return Spectrum(history, table_of(result, r.spectrum), r.spectrum.n_row // max(1, len(np.atleast_1d(history))), r.gel_time, r.is_gelation,
                    r.exact_gel_time, r.mass_error)
