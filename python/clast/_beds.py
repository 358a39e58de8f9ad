"""Spheres in a surface, and the porosity of a bed."""
from __future__ import annotations

import copy
import ctypes
import os
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from . import _bindings as c
from ._core import (Config, Floats, Monitor, Owner, Progress, Quantity, call, check, encoded, html_members, html_table, length,
                    output_path, refuse, refuse_idle, settled, single, view, warn)
from ._html import file_html
from ._mesh import Mesh, warn_of_doubles
from ._runs import Assembly
from ._tables import Path, Table, table_of


@dataclass(frozen=True, eq=False)
class Spheres:
    """A clump of spheres in the surface's unit, and how well it fills it."""

    centres: Floats
    radii: Floats
    n_sphere: int
    solid_volume: float
    sphere_volume: float
    filled_fraction: float  #: share of the solid's volume that the spheres hold
    outside_fraction: float  #: their volume outside of it, by its volume
    volume_error: float
    centroid_error: float
    inertia_error: float
    max_protrusion: float
    n_protruding: int
    max_overlap: float
    deviation_mean: float  #: of the surface from the spheres
    deviation_max: float
    bound: float  #: strategy largest: no greater sphere fits any more; else 0
    _owner: Owner = field(repr=False)
    _mesh: Mesh = field(repr=False)

    @property
    def history(self) -> Table:
        """How the errors fall with the number of spheres."""
        table = Owner(c.clast_table(), "clast_table_free")
        check(call("clast_fill_history")(self._mesh._struct(), ctypes.byref(self._owner.struct), ctypes.byref(table.struct)))
        return table_of(table)

    def write(self, path: Path, name: str = "clump") -> None:
        """Writes the spheres as `clast fill -o` does, by the name's end."""
        check(call("clast_spheres_write")(ctypes.byref(self._owner.struct), output_path("path", path), encoded("name", name),
                                         encoded("unit", self._mesh._unit)))

    def _repr_html_(self) -> str:
        return html_members(self, int, float)


_TOLD = ("n_sphere", "solid_volume", "sphere_volume", "filled_fraction", "outside_fraction", "volume_error", "centroid_error", "inertia_error",
         "max_protrusion", "n_protruding", "max_overlap", "deviation_mean", "deviation_max", "bound")


def fill(mesh: Mesh | Path, *, progress: Progress = None, **keys: Any) -> Spheres:
    """Fills a closed surface, or that of a file, with spheres."""
    surface = copy.copy(mesh) if isinstance(mesh, Mesh) else Mesh.read(mesh)  # of the same memory; the callback may close its own
    spheres, report, monitor = c.clast_spheres(), c.clast_fill_report(), Monitor(progress)
    with Config(c.clast_fill_config(), "clast_fill_fields", keys) as config:
        refuse_idle(config.changed(), "clast_fill_idle", ctypes.byref(config.struct))
        check(monitor.run(lambda m: call("clast_fill")(surface._struct(), ctypes.byref(config.struct), m, ctypes.byref(spheres),
                                                       ctypes.byref(report))))
    owner, found = Owner(spheres, "clast_spheres_free"), surface.check()
    warn_of_doubles(found, "the surface", "; shares of its volume come out low")
    if report.open_share > 1e-6:
        warn(f"the surface has {found.n_open_edge} open edges; their holes were capped, which leaves {report.open_share:.2g} of the volume "
             "uncertain")
    return Spheres(view(owner, spheres.centre, (spheres.n, 3), np.float64), view(owner, spheres.radius, (spheres.n,), np.float64),
                   **{name: getattr(report, name) for name in _TOLD}, _owner=owner, _mesh=surface)


@dataclass(frozen=True, eq=False)
class Porosity:
    """Bulk porosity of a bed between two heights, and what else was asked for; lengths in the run's unit, NaN: not measured."""

    porosity: float
    z_low: float
    z_high: float
    solid_volume: float
    top: float
    unit: str
    n_grain: int
    grain_size: float
    wall_ratio: float  #: least width of the bed by the grains' size; inf: no side walls (periodic, or a part of a packing)
    is_part: bool  #: the bed is a part of the packing: profile and bulk count what lies inside, contacts are all, there is no stress
    bed_outside: float  #: share of a given bed outside the run's own, where no grain is
    n_beyond: int  #: grains that reach beyond the sides of a given bed, -1: the run's own, or periodic
    max_beyond: float
    core: float  #: porosity away from the side walls
    core_error: float
    wall_share: float
    coordination: float
    n_overlap: int  #: -1: not searched for, the run has its contacts or its bed is sheared
    max_overlap: float
    profile: Table
    fabric: Table
    coordinations: Table
    local: Table
    radial: Table
    pores: Table
    stress: Table
    stress_profile: Table
    fields: Table  #: coarse-grained; stresses of a run that knows its forces alone
    chains: Table
    _found: Owner = field(repr=False)

    def chart(self, path: Path) -> None:
        """Draws the profile into an .svg, .pdf or .png file."""
        found = self._found.struct
        check(call("clast_chart_porosity")(ctypes.byref(found.profile), ctypes.byref(found.bulk), self.unit.encode(), output_path("path", path)))

    def _repr_html_(self) -> str:
        numbers = html_table({k: v for k, v in vars(self).items() if isinstance(v, (int, float)) and v == v})
        return numbers + file_html(self.chart, "svg", "porosity over height")


class _Bed:
    """The grains and what holds them."""

    def __init__(self, run: Path | Assembly, bed: str, columns: str, diameter: Quantity) -> None:
        self.bed, self.surface = c.clast_bed(), Owner(c.clast_mesh(), "clast_mesh_free")
        self.contacts, self.velocities = (Owner(c.clast_table(), "clast_table_free") for _ in range(2))
        self.own, self.own_surface = c.clast_bed(), Owner(c.clast_mesh(), "clast_mesh_free")
        self.has_own = False
        if isinstance(run, Assembly):
            if columns or diameter:
                raise refuse("columns, diameter: an assembly knows its grains")
            self.grains = run._copy()
        else:
            state = ctypes.create_string_buffer(c.VALUES["CLAST_RUN_PATH"])
            check(call("clast_run_folder_state")(encoded("run", run), ctypes.cast(state, ctypes.c_char_p)))
            if state.value.endswith(b".h5"):
                if columns or diameter:
                    raise refuse(f"columns, diameter: {os.fspath(run)} is a run, which knows its grains")
                self.grains = Assembly.read(run)
                self.has_own = call("clast_bed_read")(state.value, ctypes.byref(self.own), ctypes.byref(self.own_surface.struct)) == 0
                call("clast_state_read_table")(state.value, b"contacts", ctypes.byref(self.contacts.struct))  # other programs have none
                call("clast_state_read_table")(state.value, b"velocities", ctypes.byref(self.velocities.struct))
            else:
                self.grains = Assembly.read_spheres(run, columns=columns, diameter=diameter)
        if bed:
            check(call("clast_bed_load")(encoded("bed", bed), ctypes.byref(self.bed), ctypes.byref(self.surface.struct)))
        elif self.has_own:
            self.bed = self.own
        else:
            name = "the assembly" if isinstance(run, Assembly) else os.fspath(run)
            raise refuse(f"bed: {name} does not say what holds the grains; give bed, such as 'cylinder:52mm'")

    def length(self, name: str, value: Quantity, low: float = 0.0) -> float:
        """A number in the run's unit, or a text with its unit for a run in metres."""
        return length(name, value, self.grains.unit, low)


def porosity(run: Path | Assembly, *, bed: str = "", floor: Quantity = 0.0, method: str = "exact", layer: Quantity = 0.0, cut: float = 0.5,
             trim: Quantity = 0.0, at_slice: bool = False, core: float = 0.0, gap: Quantity = 0.0, local: bool = False, rings: int = 0,
             pores: int = 0, fields: Quantity = 0.0, chains: bool = False, columns: str = "", diameter: Quantity = 0.0) -> Porosity:
    """Profile and bulk porosity of a run's folder, a state file, spheres of another program, or an assembly.

    `bed` is what holds the grains ("cylinder:52mm"); a run of `clast pack` knows its own.
    """
    given = settled("porosity", dict(bed=bed, columns=columns, method=method, cut=cut, at_slice=at_slice, core=core, local=local, rings=rings, pores=pores, chains=chains))
    b = _Bed(run, given["bed"], given["columns"], single("diameter", diameter))
    slices = c.clast_porosity_options(method=int(given["method"] == "spheres"), layer=b.length("layer", layer), cut=given["cut"], trim=b.length("trim", trim),
                                      at_slice=given["at_slice"])
    options = c.clast_bed_options(porosity=slices, floor=b.length("floor", floor, -1e9), gap=b.length("gap", gap), fields=b.length("fields", fields),
                                  **{name: given[name] for name in ("core", "local", "rings", "pores", "chains")})
    known = c.clast_bed_known(ctypes.pointer(b.bed), not given["bed"], ctypes.pointer(b.own) if b.has_own else None, ctypes.pointer(b.contacts.struct),
                              ctypes.pointer(b.velocities.struct))
    owner = Owner(c.clast_bed_findings(), "clast_bed_findings_free")
    check(call("clast_bed_measure")(ctypes.byref(b.grains._owner.struct), ctypes.byref(known), ctypes.byref(options), ctypes.byref(owner.struct)))
    f = owner.struct
    if f.beyond.n > 0:
        warn(f"bed: {f.beyond.n} of {len(b.grains)} grains reach beyond its sides, by up to {f.beyond.depth:.4g}"
             + (": a part of a packing; bulk and profile count what lies inside, contacts do not; there is no stress" if f.bed.is_part
                else f", with {100 * f.beyond.solid / f.bulk.solid:.3g} % of the solid that counts as inside"))
    if f.outside > 1e-3:
        warn(f"bed: {100 * f.outside:.3g} % of it lies outside the run's own, where no grain is: it counts as pores")
    tables = {name: table_of(owner, getattr(f, name)) for name in ("profile", "fabric", "local", "radial", "stress", "stress_profile", "fields", "chains")}
    return Porosity(f.bulk.porosity, f.bulk.z_low, f.bulk.z_high, f.bulk.solid, f.bulk.top, b.grains.unit, len(b.grains), f.walls.size, f.walls.ratio,
                    bool(f.bed.is_part), f.outside, f.beyond.n, f.beyond.depth, f.core.porosity, f.core.error, f.core.share, f.mean_coordination,
                    f.n_overlap, f.max_overlap, coordinations=table_of(owner, f.coordination), pores=table_of(owner, f.pores.sizes), **tables,
                    _found=owner)
