"""Spheres in a surface, and the porosity of a bed."""
from __future__ import annotations

import ctypes
import os
from dataclasses import dataclass
from typing import Any

import numpy as np

from . import _bindings as c
from ._core import Config, Floats, Monitor, Owner, Progress, call, check, html_table, refuse, view
from ._mesh import Mesh
from ._runs import Assembly
from ._tables import Path


@dataclass(frozen=True)
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

    def _repr_html_(self) -> str:
        return html_table({k: v for k, v in vars(self).items() if not isinstance(v, np.ndarray)})


def fill(mesh: Mesh, *, progress: Progress = None, **keys: Any) -> Spheres:
    """Fills a closed surface with spheres; keywords are the keys of `clast fill`."""
    spheres, report, monitor = c.clast_spheres(), c.clast_fill_report(), Monitor(progress)
    with Config(c.clast_fill_config(), "clast_fill_fields", keys) as config:
        check(monitor.run(lambda m: call("clast_fill")(mesh._struct(), ctypes.byref(config.struct), m, ctypes.byref(spheres),
                                                       ctypes.byref(report))))
    owner = Owner(spheres, "clast_spheres_free")
    told = {name: getattr(report, name) for name in Spheres.__dataclass_fields__ if name not in ("centres", "radii")}
    return Spheres(view(owner, spheres.centre, (spheres.n, 3), np.float64), view(owner, spheres.radius, (spheres.n,), np.float64), **told)


@dataclass(frozen=True)
class Porosity:
    """Bulk porosity of a bed between two heights [m]."""

    porosity: float
    z_low: float
    z_high: float
    solid_volume: float
    top: float

    def _repr_html_(self) -> str:
        return html_table(vars(self))


def porosity(run: Path, *, method: str = "exact", layer: float = 1e-3, cut: float = 0.5, trim: float = 0.0,
             at_slice: bool = False) -> Porosity:
    """Bulk porosity of a packing's folder: method "exact" or "spheres"; heights of slices and trim in metres."""
    if method not in ("exact", "spheres"):
        raise refuse(f"method: '{method}' is none of exact, spheres")
    grains = Assembly.read(run)
    if grains.unit != "m":
        raise refuse(f"run: lengths of {os.fspath(run)} are in {grains.unit} units, metres are wanted; clast porosity takes both")
    path = ctypes.create_string_buffer(c.VALUES["CLAST_RUN_PATH"])
    check(call("clast_run_folder_state")(os.fsencode(run), ctypes.cast(path, ctypes.c_char_p)))
    bed, surface, bulk = c.clast_bed(), Owner(c.clast_mesh(), "clast_mesh_free"), c.clast_porosity_bulk()
    check(call("clast_bed_read")(path.value, ctypes.byref(bed), ctypes.byref(surface.struct)))
    options = call("clast_porosity_options_default")()
    options.method, options.layer, options.cut, options.trim, options.at_slice = int(method == "spheres"), layer, cut, trim, at_slice
    profile = Owner(c.clast_table(), "clast_table_free")
    placed = ctypes.byref(grains._owner.struct)
    check(call("clast_porosity_profile")(placed, ctypes.byref(bed), ctypes.byref(options), ctypes.byref(profile.struct)))
    check(call("clast_porosity_measure")(placed, ctypes.byref(bed), ctypes.byref(options), ctypes.byref(profile.struct),
                                         ctypes.byref(bulk)))
    return Porosity(bulk.porosity, bulk.z_low, bulk.z_high, bulk.solid, bulk.top)
