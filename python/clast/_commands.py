"""One function for a command of the library: the same numbers as `clast COMMAND --json`."""
from __future__ import annotations

import ctypes
import json
import os
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from . import _bindings as c
from ._core import Config, Floats, Monitor, Owner, Progress, call, check, choice, html_table, numbers, refuse, settled, text_of, view
from ._tables import Path, Table, read_table, table_of


@dataclass(frozen=True)
class Decomposition:
    """Cells of uniform concentration, and what they say of events; NaN where the command prints null."""

    n: int
    n_outside: int
    dimension: int
    reject: bool
    score: float
    stop: str
    n_cell: int
    events: float
    events_low: float
    events_high: float
    pair_integral: float
    pair_integral_low: float
    pair_integral_high: float
    resolved: bool
    points_needed: float
    cells: NDArray[Any]  #: low, high, volume, count, weight, events of each cell
    cell_of_point: NDArray[np.int32]  #: -1 for points left out; the library's own memory

    def _repr_html_(self) -> str:
        return html_table({k: v for k, v in vars(self).items() if not isinstance(v, np.ndarray)})


def _cloud(positions: Any, name: str, **columns: Any) -> tuple[Any, list[Any]]:
    """The struct, and what it borrows from."""
    x = numbers(name, positions, [1, 2, 3])
    cloud = c.clast_cloud()
    cloud.n, cloud.dimension = x.shape
    cloud.x = ctypes.cast(x.ctypes.data, ctypes.POINTER(ctypes.c_double))
    held = [x]
    for column, value in columns.items():
        if value is not None:
            held.append(_column(column, value, x))
            setattr(cloud, column, ctypes.cast(held[-1].ctypes.data, ctypes.POINTER(ctypes.c_double)))
    return cloud, held


def _column(name: str, value: Any, x: Floats) -> Floats:
    array = numbers(name, value, [x.shape[1]] if name == "velocity" else None)
    if len(array) != len(x):
        raise refuse(f"{name}: {len(array)} rows where there are {len(x)} positions")
    return array


def decompose(positions: Any, *, domain: str, radius: Any = None, mass: Any = None, weight: Any = None, velocity: Any = None,
              **keys: Any) -> Decomposition:
    """Splits a cloud of positions (n, 1 to 3) [m] into cells of uniform concentration and counts events.

    float64 arrays in C order are read where they lie, others are converted once. `domain` is that of the command
    ("box:0,0,0,1,1,1", "sphere:5mm"); its other keys follow as keywords (seed=1, beta_dt=1e-12, mesh="tree").
    """
    cloud, _held = _cloud(positions, "positions", radius=radius, mass=mass, weight=weight, velocity=velocity)
    result = c.clast_decomposition()
    with Config(c.clast_decompose_config(), "clast_decompose_fields", {"domain": domain, **keys}) as config:
        check(call("clast_decompose")(ctypes.byref(cloud), ctypes.byref(config.struct), ctypes.byref(result)))
    return _decomposition(Owner(result, "clast_decomposition_free"))


@dataclass(frozen=True)
class Agglomeration:
    """A cloud that agglomerates in time: tables as the command writes them (history.csv, particles.csv, spectrum.csv)."""

    history: Table
    particles: Table
    spectrum: Table
    n_rebuilt: int
    n_cell: int

    def _repr_html_(self) -> str:
        last = self.history[-1]
        return html_table({name: float(last[name]) for name in ("time_s", "n_particle", "M1", "M2", "events") if name in last.dtype.names})


def agglomerate(*snapshots: Any, domain: str, radius: Any = None, mass: Any = None, weight: Any = None, velocity: Any = None,
                monomers: Any = None, speed_rms: Any = None, temperature: Any = None, shear: Any = None, dissipation: Any = None,
                **keys: Any) -> Agglomeration:
    """Evolves positions (n, 1 to 3) [m], one array a snapshot: cells by decomposition, collisions in them by a kernel.

    The columns are those of the first snapshot; keywords are the keys of `clast agglomerate` (kernel="constant", constant=1e-3,
    duration="10s", n_step=100, seed=1).
    """
    if not snapshots:
        raise refuse("snapshots: none is given")
    made = [_cloud(x, f"snapshot {k + 1}", **(dict(radius=radius, mass=mass, weight=weight, velocity=velocity) if k == 0 else {}))
            for k, x in enumerate(snapshots)]
    clouds = (c.clast_cloud * len(made))(*(cloud for cloud, _ in made))
    given, held = c.clast_agglomerate_input(), []
    given.snapshot, given.n_snapshot = ctypes.cast(clouds, ctypes.POINTER(c.clast_cloud)), len(made)
    for name, value in dict(monomers=monomers, speed_rms=speed_rms, temperature=temperature, shear=shear, dissipation=dissipation).items():
        if value is not None:
            held.append(_column(name, value, made[0][1][0]))
            setattr(given, name, ctypes.cast(held[-1].ctypes.data, ctypes.POINTER(ctypes.c_double)))
    tables = ("clast_agglomerate_fields", "clast_decompose_fields")
    owner = Owner(c.clast_agglomeration(), "clast_agglomeration_free")
    with Config(c.clast_agglomerate_config(), tables, {"domain": domain, **keys}) as config:
        check(call("clast_agglomerate")(ctypes.byref(given), ctypes.byref(config.struct), ctypes.byref(owner.struct)))
    r = owner.struct
    return Agglomeration(table_of(owner, r.history), table_of(owner, r.particles), table_of(owner, r.spectrum), r.n_rebuilt,
                         r.n_cell)


def _decomposition(owner: Owner) -> Decomposition:
    r, nan = owner.struct, float("nan")
    n, is_bound = r.cells.n, not np.isnan(r.events_low)
    kinds: list[Any] = [("low", "f8", 3), ("high", "f8", 3), ("volume", "f8"), ("count", "i8"), ("weight", "f8"), ("events", "f8")]
    cells = np.zeros(n, np.dtype(kinds))
    for name, *kind in kinds:
        cells[name] = view(owner, getattr(r.cells, name), (n, *kind[1:]), kind[0])
    given = tuple(v if np.isfinite(v) else nan for v in
                  (r.events if is_bound else nan, r.events_low, r.events_high if is_bound else nan))
    none = (nan, nan, nan)
    events, pairs = (given, none) if r.beta_dt > 0 else (none, given)
    return Decomposition(n=r.n, n_outside=r.n_outside, dimension=r.dimension, reject=r.before.reject, score=r.before.score,
                         stop=call("clast_decompose_stop_text")(r.stop).decode(), n_cell=n, events=events[0], events_low=events[1],
                         events_high=events[2], pair_integral=pairs[0], pair_integral_low=pairs[1], pair_integral_high=pairs[2],
                         resolved=r.resolved, points_needed=r.points_needed if np.isfinite(r.points_needed) else nan, cells=cells,
                         cell_of_point=view(owner, r.cells.of_point, (r.n + r.n_outside,), np.int32))


@dataclass(frozen=True)
class Result:
    """A run's results under the names of its summary.json: `result.porosity`, `result["porosity"]`."""

    values: dict[str, Any]
    folder: str | None

    def __getitem__(self, name: str) -> Any:
        return self.values[name]

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_") or name not in self.values:
            raise AttributeError(f"no result {name}; there are {', '.join(self.values)}" if not name.startswith("_") else name)
        return self.values[name]

    def _repr_html_(self) -> str:
        return html_table({k: v for k, v in self.values.items() if not isinstance(v, (list, dict))})


def aggregate(*, output: Path | None = None, progress: Progress = None, **keys: Any) -> Result:
    """Grows virtual aggregates grain by grain: aggregate(core="sphere", core_size=270e-6, coat="sphere", size="30um").

    With `output` the run's folder is written, checkpoints on the way; Ctrl-C then ends at one, and aggregate(resume="run") goes on.
    fit=True finds what packing explains an observed size, density or settling velocity (`verdict`, `words`).
    """
    report = c.clast_aggregate_report()
    monitor = Monitor(progress)
    folder = None if output is None else os.fsencode(output)
    resumed = _resumed(output, keys)
    try:
        with Config(c.clast_aggregate_config(), "clast_aggregate_fields", keys) as config:
            if config.struct.fit:
                return _aggregate_fit(config, output, monitor)
            check(monitor.run(lambda m: call("clast_aggregate_resume")(os.fsencode(resumed), None, m, ctypes.byref(report)) if resumed else
                              call("clast_aggregate_run")(ctypes.byref(config.struct), folder, None, m, ctypes.byref(report))))
        values = json.loads(text_of(lambda text: call("clast_aggregate_report_json")(ctypes.byref(report), True, text)))
        return Result(values, resumed if output is None else os.fspath(output))
    finally:
        call("clast_aggregate_report_free")(ctypes.byref(report))


def _resumed(output: Path | None, keys: dict[str, Any], free: str = "") -> str | None:
    """The folder to go on with; every other key is the folder's own."""
    if not keys.get("resume"):
        return None
    others = [name for name, value in keys.items() if name not in ("resume", free) and value is not None]
    if others or output is not None:
        raise refuse(f"resume: {os.fspath(keys['resume'])} has every key; leave {(others or ['output'])[0]} out")
    folder: str = os.fspath(keys["resume"])
    return folder


def _aggregate_fit(config: Config, output: Path | None, monitor: Monitor) -> Result:
    found = c.clast_aggregate_fit()
    folder = None if output is None else os.fsencode(output)
    check(monitor.run(lambda m: call("clast_aggregate_fit_study")(ctypes.byref(config.struct), folder, m, ctypes.byref(found))))
    values = json.loads(text_of(lambda text: call("clast_aggregate_fit_json")(ctypes.byref(found), text)))
    return Result(values, None if output is None else os.fspath(output))


def pack(*, output: Path | None = None, progress: Progress = None, **keys: Any) -> Result:
    """Pours, shakes and calms a bed of grains: pack(curve="4mm", mass="2g", width="30mm", height=0.1, shaking_time=0)."""
    result = c.clast_pack_result()
    monitor = Monitor(progress)
    folder = None if output is None else os.fsencode(output)
    resumed = _resumed(output, keys, "max_steps")
    try:
        with Config(c.clast_pack_config(), "clast_pack_fields", keys) as config:
            most = config.struct.max_steps
            check(monitor.run(lambda m: call("clast_pack_resume")(os.fsencode(resumed), most, m, ctypes.byref(result)) if resumed else
                              call("clast_pack_run")(ctypes.byref(config.struct), folder, m, ctypes.byref(result))))
        values = json.loads(text_of(lambda text: call("clast_pack_result_json")(ctypes.byref(result), True, text)))
        return Result(values, resumed if output is None else os.fspath(output))
    finally:
        call("clast_pack_result_free")(ctypes.byref(result))


class Assembly:
    """Placed grains: views of the state's own memory."""

    def __init__(self, owner: Owner) -> None:
        a = owner.struct
        n = a.n_grain
        self._owner = owner
        self.unit: str = a.unit.decode()
        self.positions: Floats = view(owner, a.position, (n, 3), np.float64)
        self.orientations: Floats = view(owner, a.orientation, (n, 4), np.float64)  #: quaternions w, x, y, z
        self.scales: Floats = view(owner, a.scale, (n,), np.float64)
        self.densities: Floats = view(owner, a.density, (n,), np.float64)
        self.shape_ids: NDArray[np.int32] = view(owner, a.shape_id, (n,), np.int32)

    @classmethod
    def read(cls, path: Path) -> Assembly:
        """The grains of a state file or a run's folder."""
        found = ctypes.create_string_buffer(c.VALUES["CLAST_RUN_PATH"])
        check(call("clast_run_folder_state")(os.fsencode(path), ctypes.cast(found, ctypes.c_char_p)))
        struct = c.clast_assembly()
        check(call("clast_state_read_assembly")(found.value, ctypes.byref(struct)))
        return cls(Owner(struct, "clast_assembly_free"))

    def __len__(self) -> int:
        return len(self.positions)

    @property
    def volume(self) -> float:
        """Sum of the grains' own volumes."""
        return float(call("clast_assembly_volume")(ctypes.byref(self._owner.struct)))

    def write(self, path: Path) -> None:
        """Writes VTU, STL, OBJ, PLY, 3MF, CSV, dump or JSON by the name's end; lengths are in the assembly's own unit."""
        check(call("clast_assembly_write")(ctypes.byref(self._owner.struct), os.fsencode(path), None, None))

    def table(self) -> Table:
        """One row a grain, as `clast export -o grains.csv`."""
        table = c.clast_table()
        check(call("clast_assembly_table")(ctypes.byref(self._owner.struct), ctypes.byref(table)))
        return table_of(Owner(table, "clast_table_free"))


def export(run: Path | Assembly, output: Path, *, level: int = 3, points: bool = False, colour: str = "grain", table: str = "",
           unit: str = "") -> dict[str, Any]:
    """Writes a run's grains as VTU, STL, OBJ, PLY, 3MF, CSV, JSON or LAMMPS dump by the name's end, or one `table` of the run.

    STL, OBJ and PLY name no unit: they are in mm unless `unit` says else. Tells format, unit and counts.
    """
    given = settled("export", dict(level=level, points=points, colour=colour, table=table, unit=unit))
    if table:
        if isinstance(run, Assembly):
            raise refuse("table: an assembly has none; give the run's folder")
        state_table(run, table).write(output)
        return {"file": os.fspath(output), "table": table}
    grains = run if isinstance(run, Assembly) else Assembly.read(run)
    bare = call("clast_export_format_of_path")(os.fsencode(output)) in [c.VALUES[f"CLAST_EXPORT_{n}"] for n in ("STL", "OBJ", "PLY")]
    chosen = unit or ("mm" if bare and grains.unit not in ("", "model") else None)
    options = c.clast_export_options(level=given["level"], points=points, colour=choice("colour", colour, "grain|order|size|shape"),
                                     unit=None if chosen is None else chosen.encode())
    told = c.clast_export_report()
    check(call("clast_assembly_write")(ctypes.byref(grains._owner.struct), os.fsencode(output), ctypes.byref(options), ctypes.byref(told)))
    return {"file": os.fspath(output), "format": call("clast_export_format_name")(told.format).decode(), "unit": told.unit.decode(),
            "n_grain": len(grains), "n_vertex": told.n_vertex, "n_triangle": told.n_triangle}


def state_table(run: Path, name: str) -> Table:
    """A table that the run's state holds ("history")."""
    found, owner = ctypes.create_string_buffer(c.VALUES["CLAST_RUN_PATH"]), Owner(c.clast_table(), "clast_table_free")
    check(call("clast_run_folder_state")(os.fsencode(run), ctypes.cast(found, ctypes.c_char_p)))
    check(call("clast_state_read_table")(found.value, name.encode(), ctypes.byref(owner.struct)))
    return table_of(owner)


class Run:
    """A run's folder: its summary, manifest, tables and grains."""

    def __init__(self, folder: Path) -> None:
        check(call("clast_run_folder_check")(os.fsencode(folder)))
        self.folder = os.fspath(folder)
        self.manifest: dict[str, Any] = self._json("manifest.json")
        self.summary: dict[str, Any] = self._json("summary.json")
        self.command: str = self.manifest["command"]

    def _json(self, name: str) -> dict[str, Any]:
        with _open_file(os.path.join(self.folder, name)) as file:
            values: dict[str, Any] = json.load(file)
        return values

    @property
    def grains(self) -> Assembly:
        return Assembly.read(self.folder)

    def table(self, name: str) -> Table:
        """A table of the folder by its name ("history", "profile")."""
        return read_table(os.path.join(self.folder, name + ".csv"))

    def _repr_html_(self) -> str:
        return html_table({k: v for k, v in self.summary.items() if not isinstance(v, (list, dict))})


_open_file = open


def open(folder: Path) -> Run:  # noqa: A001 (clast.open)
    """A run's folder, whatever command wrote it."""
    return Run(folder)
