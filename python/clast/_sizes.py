"""Sizes of grains, and what their forms say of a bed's porosity."""
from __future__ import annotations

import ctypes
from dataclasses import dataclass
from typing import Any

import numpy as np

from . import _bindings as c
from ._core import Error, Floats, call, check, refuse
from ._mesh import html_table


class Grading:
    """A distribution of grain sizes: a published case ("U1"), "lognormal:2mm,0.5mm", one size ("11 mm"), a curve's or a list's file.

    `spread` and `count` are those of `clast grading`; sizes are in metres.
    """

    def __init__(self, text: str, *, spread: str = "step", count: str = "mean") -> None:
        self._handle: Any = None
        kinds = []
        for name, value, prefix in (("spread", spread, "CLAST_SPREAD_"), ("count", count, "CLAST_COUNT_")):
            kinds.append(c.VALUES.get(prefix + value.upper()))
            if kinds[-1] is None:
                raise refuse(f"{name}: '{value}' is none of {', '.join(n[len(prefix):].lower() for n in c.VALUES if n.startswith(prefix))}")
        curve = c.clast_curve()
        handle = ctypes.c_void_p()
        try:
            check(call("clast_grading_load")(text.encode(), kinds[0], kinds[1], ctypes.byref(curve), ctypes.byref(handle)))
        finally:
            call("clast_curve_free")(ctypes.byref(curve))
        self._handle = handle

    def close(self) -> None:
        if self._handle is not None:
            call("clast_grading_destroy")(self._handle)
            self._handle = None

    def __del__(self) -> None:
        if getattr(self, "_handle", None) is not None:
            self.close()

    def _open(self) -> Any:
        if self._handle is None:
            raise Error("CLAST_E_USAGE", "this grading is closed")
        return self._handle

    def size(self, share: float, by: str = "number") -> float:
        """The size that this share of the grains (by="number") or of their volume (by="mass") does not exceed [m]."""
        if by not in ("number", "mass"):
            raise refuse(f"by: '{by}' is none of number, mass")
        return float(call("clast_grading_size" if by == "number" else "clast_grading_mass_size")(self._open(), share))

    def draw(self, n: int, seed: int = 1) -> Floats:
        """Sizes of grains 0 .. n - 1 [m]: a function of the seed and the grain's number alone."""
        draw, handle = call("clast_grading_draw"), self._open()
        return np.fromiter((draw(handle, seed, k) for k in range(n)), np.float64, n)


@dataclass(frozen=True)
class Prediction:
    """Porosity of a bed by a published model; errors are one standard error."""

    model: str
    porosity: float
    standard_error: float
    model_error: float
    coefficient_error: float
    sampling_error: float
    in_range: bool

    def _repr_html_(self) -> str:
        return html_table(vars(self))


def predict(flatness: float | tuple[float, float], elongation: float | tuple[float, float], *, grading: str = "U1",
            grains: int = 0) -> Prediction:
    """Porosity from the grains' form: mean S/I and I/L, or (mean, standard deviation) of both, for a size distribution U1, U7 or B50.

    With deviations the model of mixtures is taken, without the one of a single form [Rettinger2022 eqs 17-19, 23, 24].
    """
    pairs = [v if isinstance(v, tuple) else (v, None) for v in (flatness, elongation)]
    if (pairs[0][1] is None) != (pairs[1][1] is None):
        raise refuse("flatness, elongation: one has a deviation and the other has none")
    has_spread = pairs[0][1] is not None and (pairs[0][1] > 0 or (pairs[1][1] or 0) > 0)
    name = f"{'form_mixture' if has_spread else 'single_form'}_{grading}"
    number = call("clast_porosity_model_find")(name.encode())
    if number < 0:
        raise refuse(f"grading: no model {name} was published; there are U1, U7 and, for a single form, B50")
    model, inputs, found = c.clast_porosity_model(), c.clast_form_inputs(), c.clast_prediction()
    mean = (ctypes.c_double * 2)(*(m for m, _ in pairs))
    deviation = None if pairs[0][1] is None else (ctypes.c_double * 2)(*(d or 0.0 for _, d in pairs))
    check(call("clast_porosity_model_published")(number, ctypes.byref(model)))
    try:
        check(call("clast_form_inputs_from_moments")(mean, deviation, grains, ctypes.byref(inputs)))
        check(call("clast_porosity_predict_moments")(ctypes.byref(model), ctypes.byref(inputs), ctypes.byref(found)))
    finally:
        call("clast_porosity_model_free")(ctypes.byref(model))
    return Prediction(name, found.porosity, found.standard_error, found.model_error, found.coefficient_error, found.sampling_error,
                      found.in_range)
