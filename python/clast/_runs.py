"""What a run leaves: results by name, its folder, its grains."""
from __future__ import annotations

import ctypes
import json
import os
import tempfile
from dataclasses import dataclass, field
from typing import Any, Iterator, KeysView

import numpy as np
from numpy.typing import NDArray

from . import _bindings as c
from ._core import (Config, Error, Fixed, Floats, Missing, Owner, Quantity, call, changed, check, choice, encoded, fixed, html_table, length, output_path,
                    quantity, refuse, refuse_idle, settled, single, view, warn)
from ._html import View, file_html, picture_html
from ._tables import Path, Table, given_table, read_table, table_of


SI = "Numbers are in SI units (m, kg, s, Pa, J) where their name has no unit."


@dataclass(frozen=True)
class Result:
    """A run's results under the names of its summary.json: `result.porosity`, `result["porosity"]`."""

    values: dict[str, Any] = field(hash=False)
    folder: str | None

    def __getitem__(self, name: str) -> Any:
        return self.values[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self.values)

    def __contains__(self, name: object) -> bool:
        return name in self.values

    def keys(self) -> KeysView[str]:
        """The names of the results; `dict(result)` has all."""
        return self.values.keys()

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *self.values]

    def __getattr__(self, name: str) -> Any:
        if name == "run":  # which refused: Python comes here for what raises AttributeError
            return self._opened()
        if name.startswith("_") or name not in self.values:
            raise AttributeError(f"no result {name}; there are {', '.join(self.values)}" if not name.startswith("_") else name)
        return self.values[name]

    @property
    def run(self) -> Run:
        """The run's folder, where one was written."""
        return self._opened()

    def _opened(self) -> Run:
        if self.folder is None:
            raise Missing("CLAST_E_ARGUMENT", "run: no folder was written; call with output=FOLDER")
        try:
            return Run(self.folder)
        except Error as error:
            raise Missing(error.code, str(error)) from None

    def _repr_html_(self) -> str:
        numbers = html_table({k: v for k, v in self.values.items() if not isinstance(v, (list, dict))}, foot=SI)
        return self.run._shown(numbers) if self.folder is not None and os.path.isdir(self.folder) else numbers


class Assembly(Fixed):
    """Placed grains: views of the state's own memory, which can be written into and not replaced."""

    _FIXED = ("unit", "positions", "orientations", "scales", "densities", "shape_ids")
    unit: str
    positions: Floats
    orientations: Floats  #: quaternions w, x, y, z
    scales: Floats  #: factors on the shapes as they are kept: a radius of spheres that another program placed, a diameter of a run's; see lengths
    densities: Floats
    shape_ids: NDArray[np.int32]  #: which cannot be written either

    def __init__(self, owner: Owner, frame: Any = None) -> None:
        a = owner.struct
        n = a.n_grain
        self._owner, self._frame = owner, frame  # step and box, for files of LAMMPS
        vars(self).update(unit=a.unit.decode(), positions=view(owner, a.position, (n, 3), np.float64),
                          orientations=view(owner, a.orientation, (n, 4), np.float64), scales=view(owner, a.scale, (n,), np.float64),
                          densities=view(owner, a.density, (n,), np.float64), shape_ids=fixed(owner, a.shape_id, (n,), np.int32))

    @classmethod
    def read(cls, path: Path) -> Assembly:
        """The grains of a state file or a run's folder."""
        found = ctypes.create_string_buffer(c.VALUES["CLAST_RUN_PATH"])
        check(call("clast_run_folder_state")(encoded("path", path), ctypes.cast(found, ctypes.c_char_p)))
        struct, frame = c.clast_assembly(), c.clast_packing_frame()
        check(call("clast_state_read_assembly")(found.value, ctypes.byref(struct)))
        check(call("clast_state_read_frame")(found.value, ctypes.byref(frame)))
        return cls(Owner(struct, "clast_assembly_free"), frame)

    @classmethod
    def read_spheres(cls, path: Path, *, columns: str | None = "", diameter: Quantity | None = None) -> Assembly:
        """Grains that another program placed: text, .xyz, LAMMPS dump, VTK points; columns as in "id,x,y,z,d", `diameter` of all.

        Of several snapshots the last. Where the file gives no densities they are 1 until they are written into, and `write` leaves them out.
        """
        asked = 0.0 if diameter is None else single("diameter", diameter)
        size = quantity("diameter", asked, "m", 0, 1e9, bare=True)  # the file's unit says below how to read it
        options, struct = c.clast_packing_options(columns=encoded("columns", "" if columns is None else columns), diameter=size), c.clast_assembly()
        told = c.clast_packing_report()
        check(call("clast_packing_read")(encoded("path", path), ctypes.byref(options), ctypes.byref(struct), ctypes.byref(told)))
        made = cls(Owner(struct, "clast_assembly_free"), told.frame)
        length("diameter", asked, made.unit)
        if told.n_snapshot > 1:
            warn(f"{os.fspath(path)}: snapshot {told.snapshot} of {told.n_snapshot}" + (f", TIMESTEP {told.frame.step}" if told.frame.step >= 0 else ""))
        return made

    def _copy(self) -> Assembly:
        struct = c.clast_assembly()
        check(call("clast_assembly_copy")(ctypes.byref(self._owner.struct), ctypes.byref(struct)))
        return Assembly(Owner(struct, "clast_assembly_free"), self._frame)

    def _framed(self) -> Any:
        return None if self._frame is None else ctypes.pointer(self._frame)

    def __len__(self) -> int:
        return len(self.positions)

    @property
    def lengths(self) -> Floats:
        """The greatest length of each grain, of a sphere its diameter, in `unit`."""
        a = self._owner.struct
        own = np.array([a.shape[k].length for k in range(a.n_shape)])
        return np.asarray(self.scales * own[self.shape_ids] if len(own) else np.zeros(0), np.float64)

    @property
    def volume(self) -> float:
        """Sum of the grains' own volumes."""
        return float(call("clast_assembly_volume")(ctypes.byref(self._owner.struct)))

    def __repr__(self) -> str:
        return f"<clast.Assembly of {len(self)} grains, {self.unit}>"

    def write(self, path: Path) -> None:
        """Writes by the name's end, as `export`; lengths are in the assembly's own unit."""
        options = c.clast_export_options(level=3, frame=self._framed())
        check(call("clast_assembly_write")(ctypes.byref(self._owner.struct), output_path("path", path), ctypes.byref(options), None))

    def view(self, triangles: int = 100_000, title: str = "clast") -> View:
        """The interactive 3-D view, grains simplified to so many triangles together."""
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "view.html")
            with Config(c.clast_report_config(), "clast_report_fields", {"title": title, "triangles": triangles}) as config:
                check(call("clast_report_write_view")(ctypes.byref(self._owner.struct), encoded("path", path), ctypes.byref(config.struct)))
            with _open_file(path, "rb") as file:
                return View(file.read(), title)

    def _picture(self) -> str:
        from ._views import render  # which draws assemblies
        return file_html(render(self, width=480, height=360).write, "png", f"{len(self)} grains")

    def _repr_html_(self) -> str:
        numbers = html_table({"grains": len(self), "unit of length": self.unit, f"volume ({self.unit}^3)": self.volume})
        return numbers + (self._picture() + self.view()._repr_html_() if len(self) else "")

    def table(self) -> Table:
        """One row a grain, as `clast export -o grains.csv`."""
        table = c.clast_table()
        check(call("clast_assembly_table")(ctypes.byref(self._owner.struct), ctypes.byref(table)))
        return table_of(Owner(table, "clast_table_free"))


def _placed(run: Path | Assembly, columns: str, diameter: Quantity, density: float) -> Assembly:
    """The grains of a run, a file of another program, or an assembly; those that came without densities get `density`."""
    grains = run if isinstance(run, Assembly) else Assembly.read_spheres(run, columns=columns, diameter=diameter) if _is_other(run) else Assembly.read(run)
    if not density:
        return grains
    if not grains._owner.struct.no_density:
        raise refuse("density: the grains have their own; leave it out")
    made = grains._copy() if isinstance(run, Assembly) else grains
    made.densities[:] = density
    made._owner.struct.no_density = False
    return made


def _is_other(run: Path | Assembly) -> bool:
    """Whether another program wrote this file."""
    return not isinstance(run, Assembly) and os.path.isfile(run) and not os.fsdecode(run).endswith(".h5")


def export(run: Path | Assembly, output: Path, *, level: int = 3, points: bool = False, colour: str = "grain", table: str = "",
           unit: str = "", density: Quantity = 0.0, columns: str = "", diameter: Quantity = 0.0) -> dict[str, Any]:
    """Writes the grains of a run or of another program's file by the name's end, or one `table` of the run.

    Names end in .vtu, .stl, .obj, .ply, .3mf, .csv, .json, .dump or .data (LAMMPS), .txt (YADE), .voro, .xyzd or .conf. STL, OBJ and PLY
    name no unit: they are in mm unless `unit` says else. Returns format, unit and counts.
    """
    given = settled("export", dict(level=level, points=points, colour=colour, table=table, unit=unit, density=density, columns=columns))
    names = [*changed("export", given), *(["diameter"] if diameter else [])]
    asked = c.clast_export_given(format=call("clast_export_format_of_path")(encoded("output", output)), has_table=bool(table),
                                 is_run=not _is_other(run), points=given["points"])
    refuse_idle(names, "clast_export_given_idle", ctypes.byref(asked))
    place = output_path("output", output, run)
    if table:
        if isinstance(run, Assembly):
            raise refuse("table: an assembly has none; give the run's folder")
        state_table(run, table).write(output)
        return {"file": os.fspath(output), "table": table}
    grains = _placed(run, given["columns"], single("diameter", diameter), given["density"])
    asked.assembly = ctypes.pointer(grains._owner.struct)
    refuse_idle(names, "clast_export_given_idle", ctypes.byref(asked))
    bare = asked.format in [c.VALUES[f"CLAST_EXPORT_{n}"] for n in ("STL", "OBJ", "PLY")]
    chosen = unit or ("mm" if bare and grains.unit not in ("", "model") else None)
    options = c.clast_export_options(level=given["level"], points=given["points"], colour=choice("colour", given["colour"], "grain|order|size|shape"),
                                     unit=None if chosen is None else encoded("chosen", chosen), frame=grains._framed())
    told = c.clast_export_report()
    check(call("clast_assembly_write")(ctypes.byref(grains._owner.struct), place, ctypes.byref(options), ctypes.byref(told)))
    return {"file": os.fspath(output), "format": call("clast_export_format_name")(told.format).decode(), "unit": told.unit.decode(),
            "n_grain": len(grains), "n_vertex": told.n_vertex, "n_triangle": told.n_triangle, "facet_ratio": told.facet_ratio,
            "clump_ratio": told.clump_ratio, "ellipsoid_ratio": told.ellipsoid_ratio, "ids_kept": told.ids_kept, "id_offset": told.id_offset}


def state_table(run: Path, name: str) -> Table:
    """A table that the run's state holds ("history")."""
    found, owner = ctypes.create_string_buffer(c.VALUES["CLAST_RUN_PATH"]), Owner(c.clast_table(), "clast_table_free")
    check(call("clast_run_folder_state")(encoded("run", run), ctypes.cast(found, ctypes.c_char_p)))
    check(call("clast_state_read_table")(found.value, encoded("name", name), ctypes.byref(owner.struct)))
    return table_of(owner)


class Run:
    """A run's folder: its summary, manifest, tables and grains."""

    def __init__(self, folder: Path) -> None:
        check(call("clast_run_folder_check")(encoded("folder", folder)))
        self.folder = os.path.abspath(os.fsdecode(folder))
        if self._has("study.json"):  # a folder of runs: each has its manifest
            self.manifest: dict[str, Any] = {"command": "study", "study": self._json("study.json")}
            results, count = given_table("results", os.path.join(self.folder, "results.csv")), c.clast_study_outcomes()
            check(call("clast_study_count")(ctypes.byref(results.struct), ctypes.byref(count)))
            self.summary: dict[str, Any] = {"n_run": count.n_run, "n_done": count.n_done, "n_failed": count.n_failed}
        else:
            self.manifest = self._json("manifest.json")
            self.summary = self._json("summary.json") if self._has("summary.json") else {}
        self.command: str = self.manifest["command"]

    def _json(self, name: str) -> dict[str, Any]:
        with _open_file(os.path.join(self.folder, name)) as file:
            values: dict[str, Any] = json.load(file)
        return values

    @property
    def grains(self) -> Assembly:
        """Its grains as they lie at the end, read anew at each call."""
        try:
            return Assembly.read(self.folder)
        except Error as error:
            raise Missing(error.code, str(error)) from None

    def table(self, name: str) -> Table:
        """A table of the folder by its name ("history", "profile")."""
        return read_table(os.path.join(self.folder, os.fsdecode(encoded("name", name)) + ".csv"))

    def view(self, triangles: int = 100_000) -> View:
        """The interactive 3-D view of its grains."""
        return self.grains.view(triangles, os.path.basename(os.path.abspath(self.folder)))

    def _shown(self, numbers: str) -> str:
        """Numbers, picture and 3-D view, as far as the run has them."""
        pictures = [name for name in ("picture.png", "points.svg", "predicted.svg", "history.svg", "profile.svg", "spectrum.svg", "zingg.svg") if self._has(name)][:1]
        for name in pictures:
            with _open_file(os.path.join(self.folder, name), "rb") as file:
                numbers += picture_html(file.read(), name[-3:], f"{self.command}: {name}")
        return numbers + (("" if pictures else self.grains._picture()) + self.view()._repr_html_() if self._has("state.h5") else "")

    def __fspath__(self) -> str:
        return self.folder

    def __repr__(self) -> str:
        return f"<clast.Run of {self.command} in {self.folder}>"

    def _has(self, name: str) -> bool:
        return os.path.isfile(os.path.join(self.folder, name))

    def _repr_html_(self) -> str:
        return self._shown(html_table({k: v for k, v in self.summary.items() if not isinstance(v, (list, dict))}, foot=SI))


_open_file = open


def open(folder: Path) -> Run:  # noqa: A001 (clast.open)
    """A run's folder, whatever command wrote it."""
    return Run(folder)
