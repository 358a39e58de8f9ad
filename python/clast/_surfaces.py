"""Surfaces made from surfaces: the commands `clast mesh ...`."""
from __future__ import annotations

import ctypes
import os
from typing import Any

import numpy as np

from . import _bindings as c
from ._core import Config, Error, Owner, call, changed, check, encoded, length, output_path, refuse, refuse_idle, settled, single, warn, whole
from ._mesh import Mesh, MeshCheck, surface_path, warn_of_doubles
from ._runs import Result
from ._tables import Path

Surface = Mesh | Path


class SurfaceResult(Result):
    """A surface that was made, `mesh`, and what the command reports of it: `result.volume`, `result["volume"]`."""

    mesh: Mesh

    def __init__(self, mesh: Mesh, values: dict[str, Any]) -> None:
        super().__init__(values, None)
        object.__setattr__(self, "mesh", mesh)


def _read(surface: Surface, output: Path | None, weld: bool = True) -> Mesh:
    """The surface, once the output is known to be one that can be written and to take no place of its own."""
    if output is not None:
        surface_path("output", output, surface)
    return surface if isinstance(surface, Mesh) else Mesh.read(surface, weld)


def _numbers(struct: Any) -> dict[str, Any]:
    """The members that are plain numbers."""
    return {name: getattr(struct, name) for name, *_ in struct._fields_ if isinstance(getattr(struct, name), (bool, int, float))}


def _keep(made: Mesh, values: dict[str, Any], output: Path | None, unit: str = "") -> SurfaceResult:
    made._unit = unit
    if output is not None:
        made.write(output)
    return SurfaceResult(made, values)


def mesh_repair(surface: Surface, *, output: Path | None = None, **keys: Any) -> SurfaceResult:
    """Makes a surface closed, oriented and manifold where it can; reports each change, and in `check` what it is now."""
    made, report, given = c.clast_mesh(), c.clast_mesh_repair_report(), _read(surface, output, weld=False)
    with Config(c.clast_mesh_repair_config(), "clast_mesh_repair_fields", keys) as config:
        refuse_idle(config.changed(), "clast_mesh_repair_idle", ctypes.byref(config.struct))
        check(call("clast_mesh_repair")(given._struct(), ctypes.byref(config.struct), ctypes.byref(made),
                                        ctypes.byref(report)))
    mesh = Mesh._own(made)
    found: MeshCheck = mesh.check()
    kept = _keep(mesh, {**_numbers(report), "is_solid": found.is_solid, "check": found}, output, given._unit)
    if report.n_separated > 0 and output is not None and _is_stl(output):
        warn(f"an STL cannot keep {report.n_separated} doubled vertices apart; write .ply, .obj or .off to keep touching surfaces separate")
    return kept


def _is_stl(path: Path) -> bool:
    return bool(call("clast_mesh_format_of_path")(encoded("output", path)) == c.VALUES["CLAST_MESH_STL"])


def mesh_hull(surface: Surface, *, output: Path | None = None) -> SurfaceResult:
    """The convex hull of a surface or of points, and the volume that it adds."""
    mesh = _read(surface, output, weld=False)
    hull = mesh.hull()
    volume = _solid_volume(mesh) if len(mesh.triangles) else float("nan")
    return _keep(hull, {"n_vertex": len(hull.vertices), "n_triangle": len(hull.triangles), "volume": volume, "area": mesh.area,
                        "hull_volume": hull.volume, "hull_area": hull.area, "added_volume": hull.volume - volume}, output, mesh._unit)


def _solid_volume(mesh: Mesh) -> float:
    """Volume of what the surface bounds, once it is welded; NaN where it is open."""
    struct = c.clast_mesh()
    check(call("clast_mesh_copy")(mesh._struct(), ctypes.byref(struct)))
    owner = Owner(struct, "clast_mesh_free")
    check(call("clast_mesh_weld_auto")(ctypes.byref(struct), None))
    found = Mesh._own(struct, owner).check()
    return found.volume if found.closed and found.oriented and not found.doubles else float("nan")


def mesh_simplify(surface: Surface, faces: int = 300, *, output: Path | None = None) -> SurfaceResult:
    """Fewer triangles, same volume; reports how far the two surfaces are apart. Fewer than wanted where topology forbids (`reached`)."""
    wanted = settled("mesh simplify", dict(faces=faces))["faces"]
    struct, report, given = c.clast_mesh(), c.clast_mesh_simplify_report(), _read(surface, output)
    check(call("clast_mesh_simplify")(given._struct(), wanted, ctypes.byref(struct), ctypes.byref(report)))
    made, volume, apart = Mesh._own(struct), report.volume_after, report.deviation
    if output is not None and _is_stl(output):  # 24 bits
        check(call("clast_mesh_round_float")(ctypes.byref(struct)))
        volume = made.volume
    found = made.check()
    values = {**_numbers(report), "volume": volume, "volume_change": volume / report.volume_before - 1.0, "hausdorff": apart.hausdorff,
              "mean_distance": apart.mean, "is_solid": found.is_solid and found.hull_volume > 0, "n_intersection": found.n_intersection,
              "intersection_complete": found.intersection_complete, "n_doubled": found.n_doubled}
    if not values["is_solid"] or found.doubles:
        before = given.check()
        if not values["is_solid"] and before.is_solid:
            warn(f"the simpler surface is no solid any more: {found.n_inside_out} part{'' if found.n_inside_out == 1 else 's'} inside out, "
                 f"{found.n_intersection} pair{'' if found.n_intersection == 1 else 's'} of triangles that cut each other; ask for more faces")
        elif not before.doubles:
            warn_of_doubles(found, "the simpler surface", "; ask for more faces")
    return _keep(made, values, output, given._unit)


def mesh_form(surface: Surface, *, flatness: float = 0.0, elongation: float = 0.0, size: float | str = 0.0, unit_form: bool = False,
              hull: int = 0, output: Path | None = None) -> SurfaceResult:
    """A grain in its principal frame, stretched to S/I, I/L and sieve size (0: its own); hull > 0 takes the convex hull first.

    `before` is of the surface (numbers are NaN where it bounds no solid), `hull` of the hull that is stretched. A `size` may have a unit ("7mm")
    where the surface's file names its own.
    """
    wanted = settled("mesh form", dict(flatness=flatness, elongation=elongation, unit_form=unit_form, hull=hull))
    n_face = wanted["hull"]
    if wanted["unit_form"] and (wanted["flatness"] or wanted["elongation"] or single("size", size) not in (0, "0")):
        raise refuse("unit_form: makes L = I = S = 1; leave flatness, elongation and size out")
    if 0 < n_face < 4:
        raise refuse(f"hull: a solid has 4 faces or more, not {n_face}")
    given = mesh = _read(surface, output)
    wanted["size"] = length("size", size, given._unit, high=1e12)
    if n_face == 0:
        _require_solid(mesh)
    else:
        struct = c.clast_mesh()
        check(call("clast_reform_hull")(mesh._struct(), n_face, ctypes.byref(struct)))
        mesh = Mesh._own(struct)
    turned, axes = _principal(mesh)
    values: dict[str, Any] = {"before": axes, "volume_before": mesh.volume}
    if n_face > 0:
        volume = _solid_volume(given) if len(given.triangles) else float("nan")
        values = {"before": _principal(given)[1] if volume > 0 else dict.fromkeys(axes, float("nan")), "hull": axes, "volume_before": volume,
                  "added_volume": mesh.volume - volume}
    own = dict(flatness=axes["flatness"], elongation=axes["elongation"], size=axes["D"])
    lengths = (ctypes.c_double * 3)(1.0, 1.0, 1.0)
    if not wanted["unit_form"]:
        call("clast_form_lengths")(*(wanted[key] or own[key] for key in own), lengths)
    made = c.clast_mesh()
    check(call("clast_reform_mesh")(turned._struct(), lengths, ctypes.byref(made)))
    out = Mesh._own(made)
    return _keep(out, {**values, "after": _principal(out)[1], "volume_hull": mesh.volume, "volume": out.volume,
                       "n_triangle": len(out.triangles)}, output, "" if wanted["unit_form"] else given._unit)


def _require_solid(mesh: Mesh) -> None:
    found = mesh.check()
    if not (found.closed and found.oriented):
        raise Error("CLAST_E_GEOMETRY", f"surface: {'not closed' if not found.closed else 'not oriented'}; call mesh_repair, "
                    "or take its hull with hull=N")
    warn_of_doubles(found, "the surface", ", so L, I and S are off")
    if found.n_body > 1 and not found.doubles:
        warn(f"the surface is {found.n_body} bodies that do not hang together, taken as one grain; mesh_repair(keep='largest') keeps one")


def _principal(mesh: Mesh) -> tuple[Mesh, dict[str, float]]:
    """The grain rotated so that L, I and S lie along x, y and z, and these."""
    struct, axes = c.clast_mesh(), (ctypes.c_double * 3)()
    check(call("clast_reform_principal")(mesh._struct(), ctypes.byref(struct), axes))
    long, middle, least = axes
    return Mesh._own(struct), {"L": long, "I": middle, "S": least, "D": float(call("clast_form_sieve_size")(middle, least)),
                               "flatness": least / middle, "elongation": middle / long}


def mesh_synthesize(index: int = 0, *, output: Path | None = None, size: float | str = 1.0, unit: str = "", **keys: Any) -> SurfaceResult:
    """A grain of a wanted form, size and roughness that nobody scanned: the one of this index and seed (`--count` makes 0, 1, 2 ...)."""
    index = whole("index", index, 0, 2**64 - 1)
    if output is not None:
        surface_path("output", output)
    struct, report = c.clast_mesh(), c.clast_synthesize_report()
    if encoded("unit", unit):
        _metres(unit)
    keys["size"] = length("size", size, unit, high=1e12)
    with Config(c.clast_synthesize_config(), "clast_synthesize_fields", keys) as config:
        refuse_idle(config.changed(), "clast_synthesize_idle", ctypes.byref(config.struct))
        check(call("clast_synthesize_grain")(ctypes.byref(config.struct), index, ctypes.byref(struct), ctypes.byref(report)))
    return _keep(Mesh._own(struct), _numbers(report), output, unit)


def mesh_convert(surface: Surface, output: Path, *, unit: str = "", out_unit: str = "", scale: float = 1.0, name: str = "") -> SurfaceResult:
    """Writes a surface as STL, OBJ, PLY, OFF or 3MF by the name's end, in another unit if wanted; 3MF needs `unit`."""
    wanted = settled("mesh convert", dict(unit=unit, out_unit=out_unit, scale=scale, name=name))
    of_path = call("clast_mesh_format_of_path")(encoded("output", output))
    if of_path == c.VALUES["CLAST_MESH_ANY"]:
        raise refuse(f"output: {os.fspath(output)} is no surface format by its name; write .stl, .obj, .ply, .off or .3mf")
    output_path("output", output, surface)
    mesh = _read(surface, None, weld=False)
    check(call("clast_mesh_require_unit")(b"the surface", ctypes.byref(c.clast_mesh_read_report(unit=mesh._unit.encode())), encoded("unit", unit)))
    unit = unit or mesh._unit
    if not unit and (out_unit or of_path == c.VALUES["CLAST_MESH_3MF"]):
        raise refuse(f"unit: is missing; {'out_unit needs it' if out_unit else '3MF is in millimetres'}")
    refuse_idle(changed("mesh convert", wanted), "clast_mesh_write_idle", of_path)
    factor, out_unit = wanted["scale"], out_unit or unit
    if unit:
        factor *= _metres(unit) / _metres(out_unit)
    if factor != 1.0:
        mesh = Mesh(np.asarray(mesh.vertices) * factor, mesh.triangles)
    options = c.clast_mesh_write_options(unit=encoded("out_unit", out_unit) or None, name=encoded("name", wanted["name"]) or None)
    check(call("clast_mesh_write")(mesh._struct(), encoded("output", output), ctypes.byref(options)))
    if _is_stl(output):
        _warn_of_loss(mesh, output)
    return SurfaceResult(mesh, {"n_vertex": len(mesh.vertices), "n_triangle": len(mesh.triangles), "unit": unit or "model",
                                "out_unit": out_unit or "model", "factor": factor})


def _warn_of_loss(mesh: Mesh, output: Path) -> None:
    """Warns of what the 24 bits of STL lose, as the command does: by the file's size, which is what a reader will find."""
    with np.errstate(all="ignore"):
        moved = np.abs(mesh.vertices - mesh.vertices.astype(np.float32)).max() / np.ptp(mesh.vertices, axis=0).max()
    if moved > 1e-6:
        warn(f"STL keeps 24 bits: coordinates move by up to {moved:.2g} of the extent; move the surface near the origin or write PLY")
    n = len(mesh.triangles) - (os.path.getsize(output) - 84) // 50
    if n > 0:
        warn(f"{n} triangles have two corners that are one in the 24 bits of STL and were left out; write PLY to keep them")


def _metres(unit: str) -> float:
    factor = ctypes.c_double()
    check(call("clast_unit_factor")(encoded("unit", unit), b"m", ctypes.byref(factor)))
    return factor.value
