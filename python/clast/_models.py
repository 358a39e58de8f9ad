"""Porosity of beds from the forms of their grains: published models, and fits of one's own."""
from __future__ import annotations

import ctypes
import os
import re
import reprlib
from dataclasses import dataclass, field
from types import MappingProxyType
from typing import Any, Mapping, Sequence

from numpy.typing import NDArray

from . import _bindings as c
from ._core import (Config, Equal, Fixed, Owner, call, changed, check, choice, encoded, html_members, html_table, items, note, output_path, refuse, refuse_idle,
                    settled, warn)
from ._grains import warn_of_rows
from ._html import file_html
from ._tables import Path, Table, given_table, table_of

_SINGLE, _MIXTURE = c.VALUES["CLAST_MODEL_SINGLE"], c.VALUES["CLAST_MODEL_MIXTURE"]
Moments = float | str | Sequence[float] | NDArray[Any]


class Model(Fixed):
    """porosity = intercept + sum of coefficient times feature; from a name ("single_form_U1") or a file of `clast fit`."""

    _FIXED = ("name", "source", "kind", "intercept", "coefficients", "units", "ranges")
    name: str
    source: str
    kind: str
    intercept: float
    coefficients: Mapping[str, float]
    units: Mapping[str, str]  #: of the features whose cells have one ("5mm": m)
    ranges: Mapping[str, tuple[float, float]]

    def __init__(self, name: Path) -> None:
        struct = c.clast_porosity_model()
        number = call("clast_porosity_model_find")(encoded("name", name))
        check(call("clast_porosity_model_published")(number, ctypes.byref(struct)) if number >= 0 else
              call("clast_porosity_model_read")(encoded("name", name), ctypes.byref(struct)))
        self._keep(Owner(struct, "clast_porosity_model_free"), struct)

    @classmethod
    def _of(cls, owner: Owner, struct: Any) -> Model:
        model = cls.__new__(cls)
        model._keep(owner, struct)
        return model

    def _keep(self, owner: Owner, struct: Any) -> None:
        self._owner, self._model = owner, struct
        vars(self).update(name=struct.name.decode(), source=struct.source.decode(), kind=call("clast_model_kind_name")(struct.kind).decode(),
                          intercept=struct.intercept,
                          coefficients=MappingProxyType({t.feature.decode(): t.coefficient for t in struct.term[:struct.n_term]}),
                          units=MappingProxyType({t.feature.decode(): t.unit.decode() for t in struct.term[:struct.n_term] if t.unit not in (None, b"-")}),
                          ranges=MappingProxyType({r.feature.decode(): (r.low, r.high) for r in struct.range[:struct.n_range]}))

    def write(self, path: Path) -> None:
        """Writes the model as JSON, for predict(model=path) and `clast predict --model`."""
        origin = (ctypes.c_char_p * 2)(b"clast", c.VERSION.encode())
        check(call("clast_porosity_model_write")(ctypes.byref(self._model), origin, 1, output_path("path", path)))

    def __repr__(self) -> str:
        return f"<clast.Model {self.name}>"

    def _repr_html_(self) -> str:
        return html_table([(self.name, ""), ("intercept", self.intercept),
                           *((f"{name} ({self.units[name]})" if name in self.units else name, value) for name, value in self.coefficients.items())],
                          ("term", "coefficient"), self.source)


@dataclass(frozen=True, eq=False)
class Prediction(Equal):
    """Porosity of a bed by a linear model; errors are one standard error."""

    model: str
    porosity: float
    standard_error: float
    model_error: float
    coefficient_error: float
    sampling_error: float  #: of a limited number of grains; nan: not known
    in_range: bool
    out_of_range: tuple[str, ...] = ()  #: features outside the range of the model's data
    leverage: float = float("nan")
    kind: str = "single_form"
    source: str = ""
    inputs: dict[str, Any] = field(default_factory=dict)

    def _repr_html_(self) -> str:
        return html_table({k: v for k, v in vars(self).items() if not isinstance(v, (dict, tuple))})


def _moments(name: str, value: Moments) -> tuple[float, float | None]:
    """Mean, and standard deviation where there is one."""
    parts = re.split(r"\+-|\+/-|\u00b1", value) if isinstance(value, str) else items(name, value)
    try:
        found = [float(part) for part in parts if not isinstance(part, (bool, bytes))]
    except (TypeError, ValueError):
        found = []
    if not len(found) == len(parts) in (1, 2) or not all(deviation >= 0 for deviation in found[1:]):
        told = reprlib.repr(value if isinstance(value, str) else parts)
        raise refuse(f"{name}: {told} is no mean, as 0.65, or mean and standard deviation, as 0.65+-0.17")
    return found[0], found[1] if len(found) == 2 else None


def _choose(model: Model | Fit | Path, grading: str, has_spread: bool) -> Model:
    """The model by "auto", "single" or "mixture" for a published grading, by its published name, or of a file."""
    if isinstance(model, (Model, Fit)):
        return model if isinstance(model, Model) else model.model
    word = os.fsdecode(encoded("model", model))
    if not call("clast_porosity_model_by_grading")(word.encode("utf-8", "surrogateescape")):
        return Model(model)
    is_mixture = word == "mixture" or (word == "auto" and has_spread)
    name = f"{'form_mixture' if is_mixture else 'single_form'}_{grading}"
    if call("clast_porosity_model_find")(encoded("name", name)) < 0:
        raise refuse(f"grading: no form-mixture model was published for {grading}; take model='single', or U1 or U7")
    return Model(name)


def _settled(model: Model | Fit | Path, has_table: bool, **given: Any) -> dict[str, Any]:
    """The keywords of a prediction; refused where such a one does not look at them."""
    values, word = settled("predict", given), None if isinstance(model, (Model, Fit)) else encoded("model", model)
    takes_columns = has_table and _choose(model, values["grading"], False).kind == "columns"
    asked = c.clast_predict_given(model=word, has_table=has_table, each=values["each"], takes_columns=takes_columns)
    refuse_idle(changed("predict", values), "clast_porosity_predict_idle", ctypes.byref(asked))
    return values


def _prediction(model: Model, found: Any, inputs: Any, source: str) -> Prediction:
    if model._model.kind == _SINGLE and inputs.has_deviation:
        note("a single-form model at the mean form: it leaves the spread of the forms out")
    told = {name: getattr(inputs, name) for name in ("n_grain", "flatness_mean", "flatness_deviation", "elongation_mean",
                                                     "elongation_deviation", "equancy_mean", "equancy_deviation")}
    outside = tuple(model._model.range[found.outside[k]].feature.decode() for k in range(min(found.n_outside, len(found.outside))))
    return Prediction(model.name, found.porosity, found.standard_error, found.model_error, found.coefficient_error, found.sampling_error,
                      found.in_range, outside, found.leverage, model.kind, model.source,
                      {"from": source, **told, "equancy_by_independence": inputs.is_independent})


def _looks_like_table(value: Any) -> bool:
    has_names = hasattr(value, "keys") and any(isinstance(key, str) for key in value.keys())
    return isinstance(value, os.PathLike) or has_names or getattr(getattr(value, "dtype", None), "names", None) is not None or (
        isinstance(value, str) and os.path.exists(value))


def predict(flatness: Moments | None = None, elongation: Moments | None = None, *, table: Any = None, model: Model | Fit | Path = "auto",
            grading: str = "U1", grains: int = 0, columns: str = "", resamples: int = 500, seed: int = 1) -> Prediction:
    """Porosity of a bed from its grains' form [Rettinger2022 eqs 17-19, 23, 24], or by a model of one's own.

    Either mean S/I and I/L, each a number, (mean, standard deviation) or "0.65+-0.17", and the number of `grains` behind them; or a
    `table` with a row a grain (a file, a structured array, a DataFrame, a dictionary of columns), with flatness and elongation or L, I
    and S. "auto" takes the model of a mixture where forms vary, else the one of a single form; `grading` names the size distribution.
    """
    if _looks_like_table(flatness):
        raise refuse("flatness: a table of grains; give it by its name, predict(table=...)")
    if (table is None) == (flatness is None and elongation is None):
        raise refuse("predict: give a table of grains, or flatness and elongation" + ("" if table is None else ", not both"))
    given = _settled(model, table is not None, grading=grading, grains=grains, columns=columns, resamples=resamples, seed=seed)
    if table is None:
        return _predict_moments(flatness, elongation, model, given["grading"], given["grains"])
    owner, rows = Owner(c.clast_form_set(), "clast_form_set_free"), given_table("table", table)
    if _choose(model, given["grading"], False).kind == "columns":
        raise refuse("model: takes columns of a table, a row a bed; call predict_beds")
    check(call("clast_form_set_of")(ctypes.byref(rows.struct), encoded("columns", given["columns"]), ctypes.byref(owner.struct)))
    warn_of_rows(owner.struct)
    inputs, found = c.clast_form_inputs(), c.clast_prediction()
    check(call("clast_form_inputs_of")(ctypes.byref(owner.struct), None, 0, ctypes.byref(inputs)))
    chosen = _choose(model, given["grading"], inputs.has_deviation)
    bootstrap = c.clast_bootstrap(n_resample=given["resamples"], level=0.95, seed=given["seed"])
    check(call("clast_porosity_predict_set")(ctypes.byref(chosen._model), ctypes.byref(owner.struct), ctypes.byref(bootstrap),
                                             ctypes.byref(inputs), ctypes.byref(found)))
    return _prediction(chosen, found, inputs, "table")


def _predict_moments(flatness: Moments | None, elongation: Moments | None, model: Model | Fit | Path, grading: str, grains: int) -> Prediction:
    if flatness is None or elongation is None:
        raise refuse(f"{'flatness' if flatness is None else 'elongation'}: is missing; give both flatness and elongation")
    pairs = [_moments("flatness", flatness), _moments("elongation", elongation)]
    if (pairs[0][1] is None) != (pairs[1][1] is None):
        raise refuse("flatness, elongation: one has a deviation and the other has none")
    inputs, found = c.clast_form_inputs(), c.clast_prediction()
    mean = (ctypes.c_double * 2)(*(m for m, _ in pairs))
    deviation = (ctypes.c_double * 2)(*(d or 0.0 for _, d in pairs)) if pairs[0][1] is not None else None
    check(call("clast_form_inputs_from_moments")(mean, deviation, grains, ctypes.byref(inputs)))
    chosen = _choose(model, grading, inputs.has_deviation)
    check(call("clast_porosity_predict_moments")(ctypes.byref(chosen._model), ctypes.byref(inputs), ctypes.byref(found)))
    return _prediction(chosen, found, inputs, "moments")


def _beds(model: Model, beds: Owner) -> Table:
    words = ctypes.create_string_buffer(256)
    if told := call("clast_porosity_beds_words")(ctypes.byref(model._model), ctypes.byref(beds.struct), len(words), words):
        warn(told.decode())
    return table_of(beds)


def predict_beds(table: Any, *, model: Model | Fit | Path = "auto", grading: str = "U1", columns: str = "") -> Table:
    """One porosity a row, each a bed of that one form (`clast predict --each`) or of the columns that a model of one's own takes.

    Columns row (from 1), porosity, standard_error, in_range; rows that cannot be used are missing. Porosity and
    standard_error are NaN where the model gives a porosity outside 0 to 1.
    """
    rows, beds = given_table("table", table), Owner(c.clast_table(), "clast_table_free")
    given = _settled(model, True, grading=grading, columns=columns, each=True)
    chosen = _choose(model, given["grading"], False)
    if chosen.kind == "columns":
        if isinstance(table, (str, os.PathLike)):  # numbers of an array are SI, those of a file may be anything
            check(call("clast_porosity_model_check_units")(ctypes.byref(chosen._model), ctypes.byref(rows.struct)))
        check(call("clast_porosity_predict_columns")(ctypes.byref(chosen._model), ctypes.byref(rows.struct), ctypes.byref(beds.struct)))
        if beds.struct.n_row < rows.struct.n_row:
            warn(f"{rows.struct.n_row - beds.struct.n_row} of {rows.struct.n_row} rows left out: missing or infinite")
        return _beds(chosen, beds)
    owner = Owner(c.clast_form_set(), "clast_form_set_free")
    check(call("clast_form_set_of")(ctypes.byref(rows.struct), encoded("columns", given["columns"]), ctypes.byref(owner.struct)))
    warn_of_rows(owner.struct, False)
    check(call("clast_porosity_predict_each")(ctypes.byref(chosen._model), ctypes.byref(owner.struct), ctypes.byref(beds.struct)))
    return _beds(chosen, beds)


@dataclass(frozen=True, eq=False)
class Fit:
    """A linear porosity model of a table of beds, and how good it is; tables as `clast fit -o` writes them."""

    model: Model
    n_bed: int
    n_left_out: int
    n_candidate: int
    n_removed: int
    r2: float
    cv_mean_error: float
    cv_median_error: float
    r2_held_out: float
    p_value: float
    residual_deviation: float
    condition: float
    terms: Table
    ranking: Table
    trials: Table
    rows: Table
    features: Table
    left_out: Table
    _data: Owner = field(repr=False)
    _fit: Owner = field(repr=False)

    def chart(self, name: str, path: Path) -> None:
        """Draws "feature", "predicted", "residuals" or "leverage" into an .svg, .pdf or .png file."""
        names = "|".join(call("clast_fit_chart_name")(k).decode() for k in range(c.VALUES["CLAST_N_FIT_CHART"]))
        number = choice("name", name, names)
        check(call("clast_chart_fit")(number, ctypes.byref(self._data.struct), ctypes.byref(self._fit.struct), output_path("path", path)))

    def _repr_html_(self) -> str:
        return html_members(self, int, float) + self.model._repr_html_() + file_html(lambda path: self.chart("predicted", path), "svg", "predicted and measured")


def fit(table: Any, *, features: str = "auto", grains: Any = None, name: str = "fitted", **keys: Any) -> Fit:
    """Fits a linear porosity model to a table of beds [Rettinger2022 sec. 6.3, 7.2].

    `table` has a row a bed (a file, a structured array, a DataFrame, a dictionary of columns); with `grains` a second table, or the
    folder of a study of `clast pack`, holds the grains of all beds, and a column of both (group="bed") names the bed.
    A call cannot be interrupted: Ctrl-C waits for its end.
    """
    beds = given_table("table", table)
    data, made = Owner(c.clast_fit_data(), "clast_fit_data_free"), Owner(c.clast_porosity_fit(), "clast_porosity_fit_free")
    number = choice("features", features, c.KEYS["fit"]["features"][5] or "")
    with Config(c.clast_porosity_fit_config(), "clast_porosity_fit_fields", keys) as config:
        asked = ctypes.byref(config.struct)
        kind = number - 1 if number > 0 else _kind_of(beds, grains is not None, asked)  # behind "auto" as clast_model_kind
        refuse_idle(config.changed(), "clast_porosity_fit_idle", asked, kind != _SINGLE)
        if (kind == _MIXTURE) != (grains is not None):
            raise refuse("features: 'mixture' and grains belong together: the features are means and deviations over the grains")
        if kind == _MIXTURE:
            rows = _study_grains(grains, beds, config.struct.group) if _is_folder(grains) else given_table("grains", grains)
            check(call("clast_fit_data_mixture")(ctypes.byref(beds.struct), ctypes.byref(rows.struct), asked, ctypes.byref(data.struct)))
        else:
            check(call("clast_fit_data_single" if kind == _SINGLE else "clast_fit_data_columns")(
                ctypes.byref(beds.struct), asked, ctypes.byref(data.struct)))
        source = f"fitted by clast {c.VERSION} to {(beds.struct.name or b'').decode()}"
        check(call("clast_porosity_fit_data")(ctypes.byref(data.struct), encoded("name", name), encoded("source", source), asked,
                                              ctypes.byref(made.struct)))
        told, n_told = c.clast_fit_note(), 0
        while call("clast_porosity_fit_note")(ctypes.byref(made.struct), ctypes.byref(beds.struct), ctypes.byref(data.struct), n_told, asked, ctypes.byref(told)):
            _warn_of(told)
            n_told += 1
    return _fit(data, made)


def _kind_of(beds: Owner, has_grains: bool, config: Any) -> int:
    kind, told = ctypes.c_int(), c.clast_fit_note()
    check(call("clast_porosity_fit_choose")(ctypes.byref(beds.struct), has_grains, config, ctypes.byref(kind), ctypes.byref(told)))
    if told.text:
        _warn_of(told)
    return kind.value


def _warn_of(told: Any) -> None:
    """A note of the command's, whose advice is in options."""
    line = told.text.decode("utf-8", "replace")
    warn(line.replace(": --features columns --columns a,b", " (columns=)").replace("--features form", "features='form'"))


def _fit(data: Owner, made: Owner) -> Fit:
    m, f = made.struct.model, made.struct
    return Fit(Model._of(made, m), m.n_bed, data.struct.left_out.n_row, data.struct.beds.n_column - 2, f.n_removed, m.r2, m.cv_mean_error,
               m.cv_median_error, f.r2_held_out, f.p_value, m.deviation, f.condition,
               **{name: table_of(made, getattr(f, name)) for name in ("terms", "ranking", "trials", "rows")},
               features=table_of(data, data.struct.beds), left_out=table_of(data, data.struct.left_out), _data=data, _fit=made)


def _is_folder(value: Any) -> bool:
    return isinstance(value, (str, os.PathLike)) and os.path.isdir(value)


def _study_grains(folder: Path, beds: Owner, group: bytes) -> Owner:
    """Forms of the grains of a study's runs that ended well."""
    grains = Owner(c.clast_table(), "clast_table_free")
    check(call("clast_study_grains")(encoded("grains", folder), ctypes.byref(beds.struct), group, ctypes.byref(grains.struct)))
    return grains
