"""Sizes of grains."""
from __future__ import annotations

import ctypes
import os
from typing import Any

import numpy as np

from . import _bindings as c
from ._core import (Error, Floats, Owner, Quantity, call, changed, check, encoded, html_table, quantity, refuse, refuse_idle, settled, size, view,
                    whole)
from ._tables import Path, Table


class _Handle:
    """What the library made, destroyed when nothing uses it any more, in whatever thread."""

    def __init__(self, pointer: ctypes.c_void_p) -> None:
        self._as_parameter_ = pointer
        self._destroy = call("clast_grading_destroy")

    __reduce__ = Owner.__reduce__

    def __del__(self) -> None:
        self._destroy(self._as_parameter_)


class Grading:
    """A distribution of grain sizes: a published case ("U1"), "lognormal:2mm,0.5mm", one size ("11 mm"), a curve's or a list's file.

    A number is one size in metres. `spread` and `count` are those of `clast grading`; sizes are in metres.
    """

    def __init__(self, text: Quantity | Path, *, spread: str = "step", count: str = "mean") -> None:
        self._handle: Any = None
        given = settled("grading", dict(spread=spread, count=count))
        kinds = [c.VALUES[f"CLAST_{name}_{given[name]}".upper()] for name in ("spread", "count")]
        curve, handle = Owner(c.clast_curve(), "clast_curve_free"), ctypes.c_void_p()
        if isinstance(text, float) and not 0 < text < np.inf:
            raise refuse(f"text: {text} m is no size of grains")
        name = encoded("text", size("text", text))
        check(call("clast_grading_load")(name, kinds[0], kinds[1], ctypes.byref(curve.struct), ctypes.byref(handle)))
        refuse_idle(changed("grading", given), "clast_grading_idle", ctypes.byref(curve.struct), kinds[0])
        self._handle, self._curve, self._name = _Handle(handle), curve, os.fsdecode(name)

    def close(self) -> None:
        """Lets go of the memory."""
        self._handle = None

    def _open(self) -> Any:
        handle = self._handle
        if handle is None:
            raise Error("CLAST_E_USAGE", "this grading is closed")
        return handle

    def size(self, share: float, by: str = "number") -> float:
        """The size that this share of the grains (by="number") or of their volume (by="mass") does not exceed [m]."""
        if by not in ("number", "mass"):
            raise refuse(f"by: '{by}' is none of number, mass")
        return float(call("clast_grading_size" if by == "number" else "clast_grading_mass_size")(self._open(), quantity("share", share, low=0, high=1)))

    def draw(self, n: int, seed: int | None = 1) -> Floats:
        """Sizes of grains 0 .. n - 1 [m]: a function of the seed and the grain's number alone."""
        draw, handle, n, seed = call("clast_grading_draw"), self._open(), whole("n", n, 0, 2**40), whole("seed", 1 if seed is None else seed, 0, 2**64 - 1)
        return np.fromiter((draw(handle, seed, k) for k in range(n)), np.float64, n)

    @property
    def range(self) -> tuple[float, float]:
        """Least and greatest size [m]; infinite where the law ends nowhere."""
        low, high = ctypes.c_double(), ctypes.c_double()
        call("clast_grading_range")(self._open(), ctypes.byref(low), ctypes.byref(high))
        return low.value, high.value

    @property
    def mean_cube(self) -> float:
        """Mean of the cubed size by number [m^3]."""
        return float(call("clast_grading_mean_cube")(self._open()))

    def n_expected(self, mass: float, density: float = 2650.0, grain_volume: float = np.pi / 6) -> float:
        """Grains that a mass [kg] holds on average; grain_volume is that of a grain by the cube of its sieve size."""
        given = settled("grading", dict(mass=mass, density=density, grain_volume=grain_volume))
        return float(given["mass"] / (given["density"] * given["grain_volume"] * self.mean_cube))

    @property
    def classes(self) -> Table:
        """Sieve classes: low, high and mean size [m], shares of mass and number; empty for a law of size."""
        handle, curve = self._open(), self._curve.struct
        sieve = view(self._curve, curve.sieve, (curve.n_class + 1 if curve.n_class else 0,), np.float64)
        rows = np.zeros(curve.n_class, [(name, "f8") for name in ("low", "high", "mean", "mass", "number")]).view(Table)
        if len(rows):
            share = np.array([call("clast_grading_share")(handle, size) for size in sieve])
            rows["low"], rows["high"], rows["number"] = sieve[:-1], sieve[1:], np.diff(share)
            rows["mass"] = view(self._curve, curve.mass, (curve.n_class,), np.float64)
            rows["mean"] = [call("clast_curve_class_size")(ctypes.byref(curve), k) for k in range(curve.n_class)]
        rows.units = {"low": "m", "high": "m", "mean": "m"}
        return rows

    def __repr__(self) -> str:
        return f"<clast.Grading {self._name}>"

    def _repr_html_(self) -> str:
        return html_table({f"D{round(100 * share)} by {by} (mm)": 1e3 * self.size(share, by) for by in ("mass", "number")
                           for share in (0.1, 0.5, 0.9)}) + (self.classes._repr_html_() if self._curve.struct.n_class else "")
