"""Positions of particles: cells of uniform concentration, events, agglomeration in time."""
from __future__ import annotations

import ctypes
import math
import os
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from . import _bindings as c
from ._boxes import check_used, warn_by
from ._core import (Config, Fixed, Floats, Monitor, Owner, Progress, call, changed, check, choice, encoded, fixed, html_last, html_members, html_table,
                    items, numbers, output_path, refuse, refuse_idle, settled, single, view, warn, whole)
from ._html import file_html
from ._tables import Path, Table, table_of


@dataclass(frozen=True, eq=False)
class Decomposition:
    """Cells of uniform concentration, and what they say of events; NaN where the command prints null."""

    n: int
    n_outside: int
    dimension: int
    reject: bool | None  #: None of fewer than 5 points, which are not tested
    score: float
    stop: str
    n_cell: int
    events: float  #: with beta_dt, else nan
    events_low: float
    events_high: float
    pair_integral: float  #: without beta_dt (with it: events / beta_dt), else nan
    pair_integral_low: float
    pair_integral_high: float
    events_cross: float  #: the two with crossfit=True, free of the bias of choosing cells by their counts; else nan
    pair_integral_cross: float
    resolved: bool
    keeps_apart: bool  #: seeded regularly, stratified or repelling: not resolved
    points_needed: float
    ideal_score: float
    estimator: str  #: "cells", or "pairs" by distance
    n_repeated: int  #: points that lie where another lies
    cells_bias: float  #: relative bias of the pairs in these cells against those of all sizes of cells
    bias_estimate: float  #: of n^2 against n (n - 1), with events="paper"
    smoothing_bias: float  #: what extrapolation took off the events
    points_per_bin: float  #: with cells of bins; below 10 they keep the noise of their counts
    sizes: Table | None  #: events of random parts of the points, with sizes=K
    _cloud: Cloud = field(repr=False)
    _owner: Owner = field(repr=False)

    @cached_property
    def cells(self) -> NDArray[Any]:
        """low, high, volume, count, weight, events (without beta_dt the pair integral) of each cell."""
        kinds: list[Any] = [("low", "f8", 3), ("high", "f8", 3), ("volume", "f8"), ("count", "i8"), ("weight", "f8"), ("events", "f8")]
        cells = np.zeros(self.n_cell, np.dtype(kinds))
        for name, *kind in kinds:
            cells[name] = view(self._owner, getattr(self._owner.struct.cells, name), (self.n_cell, *kind[1:]), kind[0])
        return cells

    @cached_property
    def cell_of_point(self) -> NDArray[np.int32]:
        """Each point's cell, -1 for points left out; the library's own memory."""
        return fixed(self._owner, self._owner.struct.cells.of_point, (self.n + self.n_outside,), np.int32)

    @cached_property
    def tests(self) -> Table:
        """The votes: name, statistic, p, reject."""
        before = self._owner.struct.before
        votes = [(v.name.decode(), v.statistic, v.p, float(v.reject)) for v in (before.vote[k] for k in range(before.n_test))]
        return np.array(votes, [("name", "U16"), ("statistic", "f8"), ("p", "f8"), ("reject", "f8")]).view(Table)

    @cached_property
    def pairs(self) -> Table:
        """g(r) in shells of distance, with pairs=True or the estimator "pairs"."""
        return table_of(self._owner, self._owner.struct.pairs.shells)

    def chart(self, name: str, path: Path) -> None:
        """Draws "points", "density", "score" or "events" ("pair_integral" without beta_dt) into an .svg, .pdf or .png file.

        Points are drawn where the cloud's array has them now.
        """
        names = [call("clast_decompose_chart_name")(k, ctypes.byref(self._owner.struct)).decode()
                 for k in range(c.VALUES["CLAST_N_DECOMPOSE_CHART"])]
        number = choice("name", name, "|".join(names))
        if not call("clast_decompose_chart_fits")(number, ctypes.byref(self._owner.struct)):
            raise refuse(f"name: nothing to draw for {name} ({self.stop})")
        check(call("clast_decompose_chart_write")(number, ctypes.byref(self._cloud._struct()), ctypes.byref(self._owner.struct),
                                                  output_path("path", path)))

    def _repr_html_(self) -> str:
        numbers = html_members(self, int, float, str)
        if not call("clast_decompose_chart_fits")(0, ctypes.byref(self._owner.struct)):  # points on a line, or none
            return numbers
        return numbers + file_html(lambda path: self.chart("points", path), "svg", f"{self.n} points in {self.n_cell} cells")


_COLUMNS = ("radius", "mass", "weight", "velocity", "variable")


class Cloud(Fixed):
    """Positions (n, 1 to 3) [m] with what they carry; float64 arrays in C order are read where they lie, others converted once.

    The arrays can be written into, not replaced. Messages count points from 1, as rows of a file.

    radius [m], mass [kg], weight (real particles that one stands for), variable (temperature or the like): (n,); velocity [m/s]: as
    positions. `domain` ("box:0,0,0,1,1,1", "sphere:5mm") is that of decompose and agglomerate, unless they name another.
    """

    _FIXED = ("positions", *_COLUMNS)
    positions: Floats

    def __init__(self, positions: Any, *, radius: Any = None, mass: Any = None, weight: Any = None, velocity: Any = None,
                 variable: Any = None, domain: str | None = None) -> None:
        self._fill("positions", positions, dict(radius=radius, mass=mass, weight=weight, velocity=velocity, variable=variable))
        self.domain = domain

    def _fill(self, name: str, positions: Any, given: dict[str, Any]) -> None:
        x = numbers(name, positions, [1, 2, 3])
        vars(self)["positions"] = x
        self._columns: dict[str, Floats] = {key: _column(key, value, x) for key, value in given.items() if value is not None}

    @classmethod
    def _named(cls, name: str, positions: Any, **given: Any) -> Cloud:
        if isinstance(positions, Cloud):
            doubled = [key for key, value in given.items() if value is not None]
            if doubled:
                raise refuse(f"{doubled[0]}: the cloud has its own columns; give arrays, or a Cloud with them")
            return positions
        cloud = cls.__new__(cls)
        cloud._fill(name, positions, given)
        cloud.domain = None
        return cloud

    @classmethod
    def read(cls, path: Path, *, columns: Any = "x,y,z", unit: str | None = "", radius_column: str = "", diameter_column: str = "",
             mass_column: str = "", velocity_columns: Any = "", weight_column: str = "", variable_column: str = "", dataset: str = "",
             frame: int | None = None, domain: str | None = None) -> Cloud:
        """The points of a CSV, VTK, XYZ, LAMMPS dump or HDF5 file, as `clast decompose` takes them; columns without a unit are in `unit`.

        `frame` is the snapshot of an XYZ or dump, from 0, -1 the last; None: the first, which is said where there are others.
        """
        table, struct = Owner(c.clast_table(), "clast_table_free"), c.clast_cloud()
        options = c.clast_points_options(dataset=encoded("dataset", dataset) or None, frame=whole("frame", frame or 0, -2**63, 2**63 - 1))
        read = c.clast_points_snapshot()
        options.snapshot = ctypes.pointer(read)
        check(call("clast_cloud_read")(encoded("path", path), ctypes.byref(options), ctypes.byref(table.struct)))
        if frame is None and read.n > 1:
            warn(f"{os.fspath(path)}: snapshot {read.number} of {read.n}" + (f", TIMESTEP {read.step}" if read.step >= 0 else ""))
        names = dict(radius_column=radius_column, diameter_column=diameter_column, mass_column=mass_column, weight_column=weight_column,
                     variable_column=variable_column, unit=unit)
        wanted = c.clast_cloud_columns(**{name: encoded(name, "" if text is None else text) for name, text in names.items()})
        lists = [_text_list("columns", "x,y,z" if columns is None else columns), _text_list("velocity_columns", velocity_columns)]
        wanted.columns, wanted.velocity_columns = lists
        check(call("clast_cloud_from_table")(ctypes.byref(table.struct), ctypes.byref(wanted), ctypes.byref(struct)))
        warn_by("clast_cloud_weight_words", ctypes.byref(struct), encoded("path", path))
        owner, n, dimension = Owner(struct, "clast_cloud_free"), struct.n, struct.dimension
        shapes = {key: (n, dimension) if key == "velocity" else (n,) for key in _COLUMNS}
        given = {key: view(owner, getattr(struct, key), shape, np.float64) for key, shape in shapes.items() if getattr(struct, key)}
        return cls(view(owner, struct.x, (n, dimension), np.float64), domain=domain, **given)

    def _struct(self) -> Any:
        struct = c.clast_cloud()
        struct.n, struct.dimension = self.positions.shape
        for name, array in (("x", self.positions), *self._columns.items()):
            setattr(struct, name, ctypes.cast(array.ctypes.data, ctypes.POINTER(ctypes.c_double)))
        return struct

    def __len__(self) -> int:
        return len(self.positions)

    def __getattr__(self, name: str) -> Floats:
        """radius, mass, weight, velocity, variable: the arrays that the cloud has."""
        if name in _COLUMNS and name in self._columns:
            return self._columns[name]
        raise AttributeError(f"this cloud has no {name}" if name in _COLUMNS else name)

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *self._columns]

    def __repr__(self) -> str:
        columns = f" with {', '.join(self._columns)}" if self._columns else ""
        return f"<clast.Cloud of {len(self)} points in {self.positions.shape[1]} dimensions{columns}>"

    @property
    def n_repeated(self) -> int:
        """Points that lie where another lies."""
        n = ctypes.c_int64()
        check(call("clast_cloud_repeated")(ctypes.byref(self._struct()), ctypes.byref(n)))
        return n.value

    def decompose(self, **keys: Any) -> Decomposition:
        """As clast.decompose."""
        return decompose(self, **keys)

    def agglomerate(self, **keys: Any) -> Agglomeration:
        """As clast.agglomerate, from this snapshot alone."""
        return agglomerate(self, **keys)

    def _repr_html_(self) -> str:
        low, high = self.positions.min(axis=0), self.positions.max(axis=0)
        return html_table({"points": len(self), "domain": self.domain or "none", "columns": ", ".join(["positions", *self._columns]),
                           "least (m)": " ".join(f"{x:.6g}" for x in low), "greatest (m)": " ".join(f"{x:.6g}" for x in high)})


def _text_list(name: str, value: Any) -> Any:
    texts = [encoded(name, text) for text in items(name, value) if text]
    return c.clast_text_list(n=len(texts), item=(ctypes.c_char_p * max(1, len(texts)))(*texts))


def _column(name: str, value: Any, x: Floats) -> Floats:
    array = numbers(name, value, [x.shape[1]] if name == "velocity" else None)
    if len(array) != len(x):
        raise refuse(f"{name}: {len(array)} rows where there are {len(x)} positions")
    return array


def _flow(name: str, value: Any, snapshots: list[Cloud]) -> Floats:
    """What the fluid is at each particle of each snapshot: (n,) of all of them, or (snapshots, n)."""
    rows = value if np.ndim(value) == 2 else [value] * len(snapshots)
    if len(rows) != len(snapshots):
        raise refuse(f"{name}: {len(rows)} rows where there are {len(snapshots)} snapshots")
    return np.concatenate([_column(name, row, snapshots[0].positions) for row in rows])


def _domain(cloud: Cloud, domain: str | None) -> str:
    chosen = domain if domain is not None else cloud.domain
    if chosen is None:
        raise refuse("domain: is missing, as in domain='box:0,0,0,1,1,1'; it is never guessed from the points")
    return chosen


def decompose(positions: Any, *, domain: str | None = None, radius: Any = None, mass: Any = None, weight: Any = None, velocity: Any = None,
              variable: Any = None, test_only: bool = False, sizes: int = 0, regular: int = 0, **keys: Any) -> Decomposition:
    """Splits a Cloud, or positions (n, 1 to 3) [m], into cells of uniform concentration and counts events.

    float64 arrays in C order are read where they lie, others are converted once. `domain` is that of the command
    ("box:0,0,0,1,1,1", "sphere:5mm"); its other keys follow as keywords (seed=1, beta_dt=1e-12, mesh="tree"). `test_only` runs the
    tests alone (`reject` says what they found); `sizes` gives the table of that name, what `clast decompose --sizes` writes.
    A call cannot be interrupted: Ctrl-C waits for its end.
    """
    own = settled("decompose", dict(test_only=test_only, sizes=sizes, regular=regular))
    if own["test_only"]:
        if keys.get("variant") is not None and single("variant", keys["variant"]) not in ("full", "test"):
            raise refuse("test_only is variant test: leave variant out")
        keys["variant"] = "test"
    cloud = Cloud._named("positions", positions, radius=radius, mass=mass, weight=weight, velocity=velocity, variable=variable)
    result = c.clast_decomposition()
    with Config(c.clast_decompose_config(), "clast_decompose_fields", {"domain": _domain(cloud, domain), **keys}) as config:
        _refuse_idle([*config.changed(), *changed("decompose", own)], config.struct, [cloud], own["sizes"])
        check(call("clast_decompose")(ctypes.byref(cloud._struct()), ctypes.byref(config.struct), ctypes.byref(result)))
        owner = Owner(result, "clast_decomposition_free")
        parts = _parts_of(cloud, own["sizes"], own["regular"], config.struct) if own["sizes"] else None
        _warn_of_units(config.struct, cloud)
    is_test = config.struct.variant == c.VALUES["CLAST_VARIANT_TEST"]
    for k in range(0 if is_test else c.VALUES["CLAST_N_DECOMPOSITION_NOTE"]):
        warn_by("clast_decomposition_note", ctypes.byref(result), cloud.n_repeated, k)
    return _decomposition(owner, cloud, parts, is_test)


def _refuse_idle(names: list[str], config: Any, clouds: list[Cloud], n_size: int = 0) -> None:
    """Refuses keywords that cells of these clouds do not look at."""
    has_variable = any("variable" in cloud._columns for cloud in clouds)
    refuse_idle(names, "clast_decompose_idle", ctypes.byref(config), has_variable, n_size)


def _warn_of_units(config: Any, cloud: Cloud) -> None:
    """Warns of points that take a thousandth of the domain's width or less, as the command does."""
    domain = Owner(c.clast_domain(), "clast_domain_free")
    check(call("clast_domain_parse")(config.domain, ctypes.byref(domain.struct)))
    warn_by("clast_cloud_corner_words", ctypes.byref(cloud._struct()), None, ctypes.byref(domain.struct))


def _parts_of(cloud: Cloud, sizes: int, regular: int, config: Any) -> Table:
    """Events of random parts of n, n/2, n/4, ... points."""
    domain, table = Owner(c.clast_domain(), "clast_domain_free"), Owner(c.clast_table(), "clast_table_free")
    check(call("clast_domain_parse")(config.domain, ctypes.byref(domain.struct)))
    check(call("clast_decompose_sizes")(None, ctypes.byref(domain.struct), ctypes.byref(cloud._struct()),
                                        ctypes.byref(c.clast_decompose_parts(sizes, regular)), ctypes.byref(config), ctypes.byref(table.struct)))
    return table_of(table)


@dataclass(frozen=True, eq=False)
class Agglomeration:
    """A cloud that agglomerates in time: tables as the command writes them (history.csv, particles.csv, members.csv, spectrum.csv)."""

    history: Table
    particles: Table  #: those that are left
    members: Table | None  #: which of them each particle of the start is part of; None of parcels of unequal weights, which go into several
    spectrum: Table
    n_rebuilt: int
    n_cell: int

    def _repr_html_(self) -> str:
        return html_last(self.history, "time_s", "n_particle", "M1", "M2", "events")


def agglomerate(*snapshots: Any, domain: str | None = None, radius: Any = None, mass: Any = None, weight: Any = None, velocity: Any = None,
                monomers: Any = None, speed_rms: Any = None, temperature: Any = None, shear: Any = None, dissipation: Any = None,
                progress: Progress = None, **keys: Any) -> Agglomeration:
    """Evolves a Cloud, or positions (n, 1 to 3) [m], one a snapshot: cells by decomposition, collisions in them by a kernel.

    radius, mass, weight, velocity and monomers are those of the first snapshot (a Cloud has its own velocities in each); speed_rms, temperature,
    shear and dissipation are numbers, texts with a unit ("300 K"), or arrays of one value a particle, of all snapshots (n,) or of each
    (snapshots, n). Keywords are the keys of `clast agglomerate` (kernel="constant", constant=1e-3,
    duration="10s", n_step=100, seed=1). Ctrl-C ends it between steps; nothing is kept.
    """
    if not snapshots:
        raise refuse("snapshots: none is given")
    columns = dict(radius=radius, mass=mass, weight=weight, velocity=velocity)
    made = [Cloud._named(f"snapshot {k + 1}", x, **(columns if k == 0 else {})) for k, x in enumerate(snapshots)]
    clouds = (c.clast_cloud * len(made))(*(cloud._struct() for cloud in made))
    given, held = c.clast_agglomerate_input(), []
    given.snapshot, given.n_snapshot = ctypes.cast(clouds, ctypes.POINTER(c.clast_cloud)), len(made)
    given_columns = []
    for name, value in dict(monomers=monomers, speed_rms=speed_rms, temperature=temperature, shear=shear, dissipation=dissipation).items():
        if value is not None and name != "monomers" and (isinstance(value, str) or np.ndim(value) == 0):
            keys[name] = value  # of all particles
        elif value is not None:
            given_columns.append(name)
            held.append(_column(name, value, made[0].positions) if name == "monomers" else _flow(name, value, made))
            setattr(given, name, ctypes.cast(held[-1].ctypes.data, ctypes.POINTER(ctypes.c_double)))
    tables = ("clast_agglomerate_fields", "clast_decompose_fields")
    owner, monitor = Owner(c.clast_agglomeration(), "clast_agglomeration_free"), Monitor(progress)
    with Config(c.clast_agglomerate_config(), tables, {"domain": _domain(made[0], domain), **keys}) as config:
        check_used(config.struct, [*keys, *given_columns])
        brought = {name: name in given_columns or name in made[0]._columns for name in ("weight", "radius", "temperature", "shear", "dissipation")}
        refuse_idle(config.changed(), "clast_agglomerate_idle", ctypes.byref(config.struct),
                    ctypes.byref(c.clast_agglomerate_given(n_snapshot=len(made), **brought)))
        _refuse_idle(config.changed(), config.struct.decompose, made)
        check(monitor.run(lambda m: call("clast_agglomerate")(ctypes.byref(given), ctypes.byref(config.struct), m, ctypes.byref(owner.struct))))
        _warn_of_units(config.struct.decompose, made[0])
    r = owner.struct
    for k in range(c.VALUES["CLAST_N_AGGLOMERATION_NOTE"]):
        warn_by("clast_agglomeration_note", ctypes.byref(r), k)
    members = table_of(owner, r.members) if r.members.n_column > 0 else None
    return Agglomeration(table_of(owner, r.history), table_of(owner, r.particles), members, table_of(owner, r.spectrum), r.n_rebuilt, r.n_cell)


def _decomposition(owner: Owner, cloud: Cloud, sizes: Table | None, is_test: bool) -> Decomposition:
    r, nan = owner.struct, float("nan")
    if is_test:  # whose one cell says nothing of events, least of all in a cloud just rejected
        r.events = r.events_low = r.events_high = r.events_cross = r.points_needed = nan
        r.resolved = r.keeps_apart = False
        view(owner, r.cells.events, (r.cells.n,), np.float64)[...] = nan
    is_bound = not math.isnan(r.events_low)
    given = tuple(v if math.isfinite(v) else nan for v in
                  (r.events if is_bound else nan, r.events_low, r.events_high if is_bound else nan))
    none = (nan, nan, nan)
    events, pairs = (given, none) if r.beta_dt > 0 else (none, given)
    cross = (r.events_cross, nan) if r.beta_dt > 0 else (nan, r.events_cross)
    estimator = "pairs" if r.estimator == c.VALUES["CLAST_ESTIMATOR_PAIRS"] else "cells"
    return Decomposition(n=r.n, n_outside=r.n_outside, dimension=r.dimension, reject=r.before.reject if r.before.n_test > 0 else None, score=r.before.score,
                         ideal_score=r.before.ideal, estimator=estimator, stop=call("clast_decompose_stop_text")(r.stop).decode(),
                         n_cell=r.cells.n, events=events[0], events_low=events[1], events_high=events[2], pair_integral=pairs[0],
                         pair_integral_low=pairs[1], pair_integral_high=pairs[2], events_cross=cross[0], pair_integral_cross=cross[1],
                         cells_bias=nan if is_test else r.cells_bias, bias_estimate=nan if is_test else r.bias_estimate,
                         smoothing_bias=r.smoothing_bias if is_bound else nan, points_per_bin=r.points_per_bin if r.points_per_bin > 0 else nan,
                         n_repeated=cloud.n_repeated, resolved=r.resolved, keeps_apart=r.keeps_apart, sizes=sizes,
                         points_needed=r.points_needed if math.isfinite(r.points_needed) else nan, _cloud=cloud, _owner=owner)
