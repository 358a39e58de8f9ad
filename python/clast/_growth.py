"""Aggregates, packings and clouds of true shapes: the same numbers as `clast aggregate --json`, `clast pack --json` and `clast evolve --json`."""
from __future__ import annotations

import ctypes
import json
import os
from typing import Any

from . import _bindings as c
from ._boxes import warn_by
from ._core import Config, Monitor, Progress, call, check, encoded, flag, note, people_write, refuse, run_path, text_of, warn
from ._runs import Result
from ._tables import Path


def aggregate(*, output: Path | None = None, progress: Progress = None, **keys: Any) -> Result:
    """Grows virtual aggregates grain by grain: aggregate(core="sphere", core_size=270e-6, coat="sphere", size="30um").

    With `output` the run's folder is written, checkpoints on the way; Ctrl-C then ends at one, and aggregate(resume="run") goes on.
    aggregate(resume="run", printable=True, spacing="5um") adds the printable body to a run that has ended, or makes another.
    fit=True finds what packing explains an observed size, density or settling velocity (`verdict`, `words`).
    """
    report = c.clast_aggregate_report()
    monitor = Monitor(progress)
    folder = run_path(output, keys)
    adds_body = keys.get("printable") is not None and flag("printable", keys["printable"]) and _is_whole(keys)
    resumed = _resumed(output, keys, ("printable", "neck", "spacing") if adds_body else ())
    try:
        with Config(c.clast_aggregate_config(), "clast_aggregate_fields", keys) as config:
            if config.struct.fit:
                return _aggregate_fit(config, output, monitor)
            if resumed and adds_body:
                return _make_printable(config, resumed, monitor)
            check(monitor.run(lambda m: call("clast_aggregate_resume")(encoded("resumed", resumed), None, m, ctypes.byref(report)) if resumed else
                              call("clast_aggregate_run")(ctypes.byref(config.struct), folder, None, m, ctypes.byref(report))))
        values = json.loads(text_of(lambda text: call("clast_aggregate_report_json")(ctypes.byref(report), True, text)))
        return Result(values, _folder(output, resumed))
    finally:
        call("clast_aggregate_report_free")(ctypes.byref(report))


def _is_whole(keys: dict[str, Any]) -> bool:
    """Whether the folder to go on with holds a run that has ended."""
    return bool(keys.get("resume")) and call("clast_run_folder_check")(encoded("resume", keys["resume"])) == c.VALUES["CLAST_OK"]


def _make_printable(config: Config, folder: str, monitor: Monitor) -> Result:
    """The printable body of a whole run, whose results are returned with the body's under `printable`."""
    wanted = c.clast_printable_config(neck=config.struct.neck, spacing=config.struct.spacing)
    made = c.clast_printable_report()
    check(monitor.run(lambda m: call("clast_aggregate_make_printable")(encoded("resumed", folder), ctypes.byref(wanted), m, ctypes.byref(made))))
    with open(os.path.join(folder, "summary.json"), encoding="utf-8") as summary, open(os.path.join(folder, "printable.json"), encoding="utf-8") as body:
        return Result({**json.load(summary), "printable": json.load(body)}, folder)


def _resumed(output: Path | None, keys: dict[str, Any], free: tuple[str, ...] = ()) -> str | None:
    """The folder to go on with; every other key is the folder's own."""
    resume = keys.get("resume")
    if resume is None or isinstance(resume, str) and not resume:
        return None
    folder = os.fsdecode(encoded("resume", resume))
    others = [name for name, value in keys.items() if name not in ("resume", *free) and value is not None]
    if others or output is not None:
        raise refuse(f"resume: {folder} has every key; leave {(others or ['output'])[0]} out")
    return os.path.abspath(folder)


def _aggregate_fit(config: Config, output: Path | None, monitor: Monitor) -> Result:
    found = c.clast_aggregate_fit()
    folder = None if output is None else encoded("output", output)
    check(monitor.run(lambda m: call("clast_aggregate_fit_study")(ctypes.byref(config.struct), folder, m, ctypes.byref(found))))
    values = json.loads(text_of(lambda text: call("clast_aggregate_fit_json")(ctypes.byref(found), text)))
    return Result(values, _folder(output))


def _folder(output: Path | None, resumed: str | None = None) -> str | None:
    """Where a run was written, found from any working folder."""
    return resumed if output is None else os.path.abspath(os.fsdecode(output))


def pack(*, output: Path | None = None, progress: Progress = None, **keys: Any) -> Result:
    """Pours, shakes and damps a bed of grains: pack(curve="4mm", mass="2g", width="30mm", height=0.1, shaking_time=0)."""
    result = c.clast_pack_result()
    monitor = Monitor(progress)
    folder = run_path(output, keys)
    resumed = _resumed(output, keys, ("max_steps",))
    try:
        with Config(c.clast_pack_config(), "clast_pack_fields", keys) as config:
            most = config.struct.max_steps
            check(monitor.run(lambda m: call("clast_pack_resume")(encoded("resumed", resumed), most, None, m, ctypes.byref(result)) if resumed else
                              call("clast_pack_run")(ctypes.byref(config.struct), folder, None, m, ctypes.byref(result))))
        values = json.loads(text_of(lambda text: call("clast_pack_result_json")(ctypes.byref(result), True, text)))
        _warn_of_bed(result)
        return Result(values, _folder(output, resumed))
    finally:
        call("clast_pack_result_free")(ctypes.byref(result))


def _warn_of_bed(r: Any) -> None:
    """Warns of what still moves and of a mass that is not the one asked for, as the command does."""
    if r.mass_wanted > 0 and r.n_left == 0 and r.dem.mass > 1.5 * r.mass_wanted:
        warn(f"{r.dem.mass / r.mass_wanted:.3g} times the mass that was asked for: {people_write(r.dem.mass / r.dem.n_grain, 'kg')} one grain weighs; "
             "give more mass or smaller grains")
    if r.own_density > 0:
        note(f"aggregates of {people_write(r.own_density, 'kg/m^3')} are packed at {people_write(r.given_density, 'kg/m^3')}: density=0 keeps their own")
    if r.dem.n_grain > 0 and r.n_stage == 0 and r.cell.side[2] == 0 and r.still_diameters > 10:
        note(f"still_speed is {r.still_diameters:.3g} diameters of the smallest grain a second: for such grains take a lower still_speed, and "
             "height_change with it")
    if r.phase == c.VALUES["CLAST_PACK_DONE"] and r.is_moving and r.n_stage == 0:
        warn("the bed was level and still moves: its fastest grain is not below still_speed; rule='speed' waits until it is")
    if r.fell:
        warn(f"shaking ended while grains fell: the highest sank by {people_write(r.sank, 'm')} since; take a longer shaking_time")


def evolve(*, output: Path | None = None, progress: Progress = None, **keys: Any) -> Result:
    """Follows a cloud of true shapes to the floor: evolve(domain="box:0,0,0,1cm,1cm,1cm", particles=200, curve="20um", duration="1s").

    With `output` the run's folder is written, checkpoints on the way; Ctrl-C then ends at one, and evolve(resume="run") goes on.
    """
    result = c.clast_evolve_result()
    monitor = Monitor(progress)
    folder = run_path(output, keys)
    resumed = _resumed(output, keys)
    try:
        with Config(c.clast_evolve_config(), "clast_evolve_fields", keys) as config:
            check(monitor.run(lambda m: call("clast_evolve_resume")(encoded("resumed", resumed), m, ctypes.byref(result)) if resumed else
                              call("clast_evolve_run")(ctypes.byref(config.struct), folder, m, ctypes.byref(result))))
        values = json.loads(text_of(lambda text: call("clast_evolve_result_json")(ctypes.byref(result), True, text)))
        if result.fall_reynolds > result.fall_reynolds_limit:
            warn(f"Reynolds number of the fastest fall is {result.fall_reynolds:.2g}, beyond the {result.fall_reynolds_limit:g} of the drag law"
                 + ("; take fall='form' or 'sphere'" if result.fall_reynolds_limit < 1 else ""))
        if result.gathered > 0:
            at_floor, at_top = result.gathered_top < result.gathered, result.gathered_top > 0
            walls = [("floor", "floor='deposit'")] * at_floor + [("top", "open_top=True (a box; else sides='deposit')")] * at_top
            warn(f"{100 * result.gathered:.3g} % of the mass comes to a {' or '.join(w for w, _ in walls)} that reflects and gathers there in a layer "
                 "(diffusivity over speed) thinner than a step moves it: what meets there depends on the steps; take "
                 f"{' and '.join(cure for _, cure in walls)} or shorter steps")
        if result.is_field_apart:
            warn("no body starts within the grid of field, or it is 1000 times as wide as the domain; are both in the same unit? (beyond the grid "
                 "the velocity is that at its edge)")
        if result.is_bed_empty:
            note("bed_width: nothing lies on the floor; there is no deposit.h5")
        for words in (result.weight_words, result.points_words):
            if words:
                warn(words.decode())
        warn_by("clast_kernel_dense_words", result.volume_fraction)
        return Result(values, _folder(output, resumed))
    finally:
        call("clast_evolve_result_free")(ctypes.byref(result))
