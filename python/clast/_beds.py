"""Spheres in a surface, and the porosity of a bed."""
from __future__ import annotations

import copy
import ctypes
import os
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from . import _bindings as c
from ._core import (Config, Error, Floats, Monitor, Owner, Progress, Quantity, call, check, encoded, html_members, html_table, quantity, refuse,
                    refuse_idle, settled, single, view, warn)
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
    filled_fraction: float
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
        check(call("clast_spheres_write")(ctypes.byref(self._owner.struct), encoded("path", path), encoded("name", name), None))

    def _repr_html_(self) -> str:
        return html_members(self, int, float)


_TOLD = ("n_sphere", "solid_volume", "sphere_volume", "filled_fraction", "volume_error", "centroid_error", "inertia_error", "max_protrusion",
         "n_protruding", "max_overlap", "deviation_mean", "deviation_max", "bound")


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
    n_overlap: int  #: -1: not searched for, the run tells its contacts or its bed is sheared
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
    _profile: Owner = field(repr=False)
    _bulk: Any = field(repr=False)

    def chart(self, path: Path) -> None:
        """Draws the profile into an .svg, .pdf or .png file."""
        check(call("clast_chart_porosity")(ctypes.byref(self._profile.struct), ctypes.byref(self._bulk), self.unit.encode(),
                                                 encoded("path", path)))

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
        return quantity(name, value, "m" if self.grains.unit == "m" else "-", low, 1e9)


def porosity(run: Path | Assembly, *, bed: str = "", floor: Quantity = 0.0, method: str = "exact", layer: Quantity = 0.0, cut: float = 0.5,
             trim: Quantity = 0.0, at_slice: bool = False, core: float = 0.0, gap: Quantity = 0.0, local: bool = False, rings: int = 0,
             pores: int = 0, fields: Quantity = 0.0, chains: bool = False, columns: str = "", diameter: Quantity = 0.0) -> Porosity:
    """Profile and bulk porosity of a run's folder, a state file, spheres of another program, or an assembly.

    `bed` is what holds the grains ("cylinder:52mm"); a run of `clast pack` knows its own.
    """
    given = settled("porosity", dict(bed=bed, columns=columns, method=method, cut=cut, at_slice=at_slice, core=core, local=local, rings=rings, pores=pores, chains=chains))
    bed = given["bed"]
    b = _Bed(run, bed, given["columns"], single("diameter", diameter))
    given["fields"] = b.length("fields", fields)
    placed, held = ctypes.byref(b.grains._owner.struct), ctypes.byref(b.bed)
    bottom, near = b.length("floor", floor, -1e9), b.length("gap", gap)
    if near > 0 and b.contacts.struct.n_column:
        raise refuse("gap: the run knows its contacts; leave gap out")
    if bed and b.bed.kind in (c.VALUES["CLAST_BED_MESH"], c.VALUES["CLAST_BED_PERIODIC_3D"]):
        if bottom:
            raise refuse(f"floor: bed {bed} has a bottom of its own")
    elif bed:
        b.bed.floor = bottom
    elif bottom:
        raise refuse("floor: the run knows its bed and its floor; leave floor out, or give bed too")
    options = call("clast_porosity_options_default")()
    options.method, options.cut, options.trim, options.at_slice = int(given["method"] == "spheres"), given["cut"], b.length("trim", trim), given["at_slice"]
    slice_height = b.length("layer", layer)
    if slice_height > 0:
        options.layer = slice_height
    elif b.grains.unit != "m" and len(b.grains):
        options.layer = 0.2 * np.cbrt(0.75 / np.pi * b.grains.volume / len(b.grains))
    profile, bulk, beyond, outside = _slices(b, given, options)
    away = c.clast_porosity_core(*[float("nan")] * 4)
    walls = call("clast_bed_side_walls")(held, placed)
    if given["core"] > 0:
        check(call("clast_porosity_core_measure")(placed, held, ctypes.byref(bulk), given["core"], ctypes.byref(options), ctypes.byref(away)))
    touching = _contacts(b, near)
    tables: dict[str, Any] = _more(b, given, options, profile, bulk)
    return Porosity(bulk.porosity, bulk.z_low, bulk.z_high, bulk.solid, bulk.top, b.grains.unit, len(b.grains), walls.size, walls.ratio,
                    bool(b.bed.is_part), outside, beyond.n, beyond.depth, away.porosity, away.error, away.share, **{**touching, **tables}, profile=table_of(profile), _profile=profile, _bulk=bulk)


def _slices(b: _Bed, given: dict[str, Any], options: Any) -> tuple[Owner, Any, Any, float]:
    """Profile, bulk, what reaches beyond the sides of a given bed, which with pores may be a part of the packing, and its share outside the run's."""
    placed, held, period = ctypes.byref(b.grains._owner.struct), ctypes.byref(b.bed), (ctypes.c_double * 3)()
    is_periodic = call("clast_bed_period")(held, period)
    if given["bed"] and is_periodic:
        _check_images(b, options, period)
    call("clast_bed_wrap")(held, placed)
    while True:
        profile, bulk, beyond = Owner(c.clast_table(), "clast_table_free"), c.clast_porosity_bulk(), c.clast_bed_beyond(-1, float("nan"), float("nan"))
        check(call("clast_porosity_profile")(placed, held, ctypes.byref(options), ctypes.byref(profile.struct)))
        check(call("clast_porosity_measure")(placed, held, ctypes.byref(profile.struct), ctypes.byref(options), ctypes.byref(bulk)))
        if given["bed"] and not is_periodic:
            check(call("clast_bed_beyond_measure")(held, placed, ctypes.byref(bulk), options.method, ctypes.byref(beyond)))
        is_within = beyond.n < 0 or beyond.solid <= 0.01 * bulk.solid
        if is_within or b.bed.is_part or not given["pores"]:
            break
        b.bed.is_part = True
    if bulk.porosity < -1e-2:
        raise Error("CLAST_E_GEOMETRY", f"bed: grains take {1 - bulk.porosity:.4g} times the room of this bed between z = {bulk.z_low:g} and "
                    f"{bulk.z_high:g}: it is smaller than what holds them (pores measures a part of a packing), or in another unit")
    told = f"{beyond.n} of {len(b.grains)} grains reach beyond its sides, by up to {beyond.depth:.4g}"
    share = f"{100 * beyond.solid / bulk.solid:.3g} % of the solid that counts as inside"
    if not is_within and not b.bed.is_part:
        raise Error("CLAST_E_GEOMETRY", f"bed: {told}, with {share}; give what holds the grains (core leaves out what is near its walls), or pores "
                    "for the porosity of this part of the packing")
    if beyond.n > 0:
        warn(f"bed: {told}" + (": a part of a packing; bulk and profile count what lies inside, contacts do not; there is no stress" if b.bed.is_part
                               else f", with {share}"))
    outside = ctypes.c_double(float("nan"))
    if given["bed"] and b.has_own and not is_periodic:
        check(call("clast_bed_outside")(held, ctypes.byref(b.own), (ctypes.c_double * 2)(bulk.z_low, bulk.z_high), ctypes.byref(outside)))
    if outside.value > 1e-3:
        warn(f"bed: {100 * outside.value:.3g} % of it lies outside the run's own, where no grain is: it counts as pores")
    return profile, bulk, beyond, outside.value


def _check_images(b: _Bed, options: Any, period: Any) -> None:
    """Refuses a periodic bed whose images lie on the grains, or not where the run's own do."""
    covered, none, same, own_period = c.clast_bed_beyond(), c.clast_porosity_bulk(), 1e-3, (ctypes.c_double * 3)()
    if b.has_own:
        call("clast_bed_period")(ctypes.byref(b.own), own_period)
    for axis, own, given in zip("xyz", own_period, period):
        if own > 0 and given > 0 and abs(given - own) > same * own:
            raise Error("CLAST_E_GEOMETRY", f"bed: a period of {given:.4g} along {axis}, where the run repeats after {own:.4g}; leave out bed, or "
                        "measure a part of the packing (box, with pores)")
    sheared = (b.bed.shift - b.own.shift) / own_period[0] if own_period[2] > 0 and period[2] > 0 else 0.0
    if abs(sheared - round(sheared)) > same:
        raise Error("CLAST_E_GEOMETRY", f"bed: its images above lie {b.bed.shift:.4g} along x, those of the run {b.own.shift:.4g} (the seventh number); "
                    "leave out bed")
    placed = ctypes.byref(b.grains._owner.struct)
    check(call("clast_bed_beyond_measure")(ctypes.byref(b.bed), placed, ctypes.byref(none), options.method, ctypes.byref(covered)))
    share = covered.solid / b.grains.volume if len(b.grains) else 0.0
    if share > 0.01:
        raise Error("CLAST_E_GEOMETRY", f"bed: its images lie on {covered.n} of {len(b.grains)} grains, which share {100 * share:.3g} % of the solid: "
                    "its period is not theirs; give what holds the grains, or measure a part of the packing (box, with pores)")


def _contacts(b: _Bed, gap: float) -> dict[str, Any]:
    """Contacts, directions and overlaps; those of a run of clast pack overlap by what their forces need, and are not searched for."""
    placed, found = ctypes.byref(b.grains._owner.struct), c.clast_overlaps(-1, float("nan"), float("nan"))
    period = c.clast_period(low=(b.bed.low[0], b.bed.low[1], b.bed.floor))
    where = ctypes.byref(period) if call("clast_bed_period")(ctypes.byref(b.bed), period.length) else None
    knows = b.contacts.struct.n_column > 0
    if gap > 0 and b.bed.shift:
        raise refuse("bed: contacts across the borders of a sheared box are those of runs of clast pack, which know them; this bed knows none: "
                     "leave out gap")
    if not knows and not b.bed.shift:
        check(call("clast_assembly_overlaps")(placed, where, ctypes.byref(found)))
    if gap > 0:
        check(call("clast_assembly_find_contacts_periodic")(placed, gap, where))
    counts, fabric = Owner(c.clast_table(), "clast_table_free"), Owner(c.clast_table(), "clast_table_free")
    a, mean = b.grains._owner.struct, float("nan")
    if a.contact:
        mean = 2.0 * a.n_contact / a.n_grain
        check(call("clast_assembly_coordination")(placed, ctypes.byref(counts.struct)))
    check(call("clast_fabric")(placed, ctypes.byref(b.contacts.struct) if knows else None, period.length if where else None,
                               ctypes.byref(fabric.struct)))
    return {"coordination": mean, "n_overlap": found.n, "max_overlap": found.depth, "coordinations": table_of(counts),
            "fabric": table_of(fabric)}


def _more(b: _Bed, given: dict[str, Any], options: Any, profile: Owner, bulk: Any) -> dict[str, Any]:
    """What is measured when it is asked for, and the stresses of a run that knows its forces."""
    placed, held, z = ctypes.byref(b.grains._owner.struct), ctypes.byref(b.bed), (ctypes.c_double * 2)(bulk.z_low, bulk.z_high)
    made = {name: Owner(c.clast_table(), "clast_table_free") for name in ("local", "radial", "stress", "stress_profile", "fields", "chains")}
    to = {name: ctypes.byref(owner.struct) for name, owner in made.items()}
    pores = Owner(c.clast_pores(), "clast_pores_free")
    if given["local"]:
        check(call("clast_porosity_local")(placed, held, b.bed.floor, bulk.top, to["local"]))
    if given["rings"]:
        rings = c.clast_radial_options(method=options.method, n_ring=given["rings"])
        check(call("clast_porosity_radial")(placed, held, z, ctypes.byref(rings), to["radial"]))
    if given["pores"]:
        wanted = c.clast_pore_options(n_point=given["pores"], n_bin=50)
        call("clast_bed_period")(held, wanted.period)
        check(call("clast_pores_measure")(placed, held, z, ctypes.byref(wanted), ctypes.byref(pores.struct)))
    forces = ctypes.byref(b.contacts.struct)
    if given["fields"]:
        moves = ctypes.byref(b.velocities.struct) if b.velocities.struct.n_column else None
        check(call("clast_bed_fields")(held, placed, forces if b.contacts.struct.n_column else None, moves, given["fields"], to["fields"]))
    if given["chains"]:
        if not b.contacts.struct.n_column:
            raise refuse("chains: force chains are of runs of clast pack, which know their contact forces; this bed knows none")
        check(call("clast_bed_chains")(held, placed, forces, to["chains"]))
    if b.contacts.struct.n_row and not b.bed.is_part:
        check(call("clast_stress")(forces, held, z, to["stress"]))
        check(call("clast_stress_profile")(forces, held, ctypes.byref(profile.struct), to["stress_profile"]))
    return {**{name: table_of(owner) for name, owner in made.items()}, "pores": table_of(pores, pores.struct.sizes)}
