"""Many runs of one command, in parallel, resumable, one table out."""
from __future__ import annotations

import ctypes
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import time
from dataclasses import dataclass
from typing import Any

from . import _bindings as c
from ._core import Config, Monitor, Progress, call, check, encoded, given, items, nearest, refuse, run_path, single, SIZES, size, warn, whole, written
from ._tables import Path, Table, read_table


@dataclass(frozen=True)
class Study:
    """A study's folder: how its runs went, and tables of what varied and came out."""

    folder: str
    n_run: int
    n_before: int
    n_done: int
    n_failed: int
    n_other: int
    n_unconverged: int

    @property
    def results(self) -> Table:
        """A row a run: what varied, seed, exit code, the numbers of its results (of lists, those of one entry: a.0.b)."""
        return read_table(os.path.join(self.folder, "results.csv"))

    @property
    def times(self) -> Table:
        """Results that differ from run to run (wall_s)."""
        return read_table(os.path.join(self.folder, "times.csv"))

    @property
    def plan(self) -> Table:
        """A row a run: what varies, and its seed."""
        return read_table(os.path.join(self.folder, "plan.csv"))

    def _repr_html_(self) -> str:
        return self.results._repr_html_()


def _program() -> str:
    """The command clast of this version: CLAST, beside the package or the interpreter (where pip puts it), or on the PATH."""
    beside = [place / "clast" for place in (pathlib.Path(__file__).parent, pathlib.Path(sys.executable).parent)]
    path = os.environ.get("CLAST") or next((str(one) for one in beside if one.is_file()), shutil.which("clast"))
    if path is None or shutil.which(path) is None:
        raise ImportError(f"clast.study: its runs are processes of the command clast, which is not {'at ' + path if path else 'on the PATH'}; "
                          "install clast (make install), or set CLAST to the file")
    version = subprocess.run([path, "--version"], stdout=subprocess.PIPE, text=True).stdout.split()[1:2]
    if version != [c.VERSION]:
        raise ImportError(f"clast.study: {path} is version {' '.join(version) or 'unknown'}, this package is for {c.VERSION}")
    return os.path.abspath(shutil.which(path) or path)


class _Workers:
    """Processes of a study; the library calls these from one thread."""

    START = ctypes.CFUNCTYPE(ctypes.c_int, ctypes.c_void_p, ctypes.POINTER(c.clast_study_item))
    WAIT = ctypes.CFUNCTYPE(ctypes.c_int, ctypes.c_void_p, ctypes.POINTER(ctypes.c_int64), ctypes.POINTER(ctypes.c_int))
    STOP = ctypes.CFUNCTYPE(None, ctypes.c_void_p)

    def __init__(self, program: str, command: str) -> None:
        self._program = program
        self._busy: dict[int, subprocess.Popen[bytes]] = {}
        self.failed: BaseException | None = None
        self._held = (self.START(self._start), self.WAIT(self._wait), self.STOP(self._stop))
        self.struct = c.clast_study_worker(has_folder=command in c.FOLDERS, has_seed="seed" in c.KEYS[command],
                                           has_resume="resume" in c.KEYS[command])
        for name, function in zip(("start", "wait", "stop"), self._held):
            setattr(self.struct, name, ctypes.cast(function, ctypes.c_void_p))

    def _start(self, _: Any, item: Any) -> int:
        one = item.contents
        try:
            folder = os.fsdecode(one.folder)
            words = [os.fsdecode(one.argument[k]) for k in range(one.n_argument)]
            with open(os.path.join(folder, "result.json"), "wb") as out, open(os.path.join(folder, "messages.txt"), "wb") as err:
                self._busy[one.row] = subprocess.Popen([self._program, *words], stdin=subprocess.DEVNULL, stdout=out, stderr=err,
                                                       env={**os.environ, "CLAST_STUDY_PROCESS": str(os.getpid())})
        except BaseException as failed:
            self.failed = failed
            return c.VALUES["CLAST_E_IO"]
        return 0

    def _wait(self, _: Any, row: Any, code: Any) -> int:
        row[0] = -1
        for _try in range(4):
            for number, process in self._busy.items():
                if process.poll() is not None:
                    row[0], code[0] = number, process.returncode if process.returncode >= 0 else 128 - process.returncode
                    del self._busy[number]
                    return 0
            time.sleep(0.005)
        return 0

    def _stop(self, _: Any) -> None:
        for process in self._busy.values():
            process.send_signal(signal.SIGTERM)


def _fields(command: str) -> Any:
    """Names of a command's keys and whether they take lists, as the library checks those of a study."""
    lists = {"texts": c.VALUES["CLAST_FIELD_TEXT_LIST"], "numbers": c.VALUES["CLAST_FIELD_F64_LIST"]}
    made = [c.clast_field(name=key.encode(), type=lists.get(kind, c.VALUES["CLAST_FIELD_F64"])) for key, (kind, *_) in c.KEYS[command].items()]
    return (c.clast_field * (len(made) + 1))(*made)


def _entries(command: str, name: str, values: dict[str, Any]) -> list[str]:
    """A dictionary as texts of YAML: values that vary beside each other, those of a list that all runs share below each other."""
    made = []
    for key, value in given(values).items():
        kind, _, unit, *_ = c.KEYS.get(command, {}).get(key.replace("-", "_"), ("text", "", "-"))
        texts = [_text(key, unit, one) for one in (items(key, value) if name == "vary" or kind in ("texts", "numbers") else [single(key, value)])]
        if not texts:
            raise refuse(f"{key}: an empty list")
        parted = [text for text in texts if name == "vary" and "|" in text]
        if parted:
            raise refuse(f"{key}: '{parted[0]}' has a |, which parts values")
        made += [f"{key}={text}" for text in (["|".join(texts)] if name == "vary" else texts)]
    return made


def _text(key: str, unit: str, value: Any) -> str:
    """A value with its unit: a process reads no bare lengths and angles."""
    value = size(key, value) if key in SIZES else value
    is_bare = unit == "-" or isinstance(value, (str, os.PathLike, bool))
    return f"{os.fspath(written(key, value))}{'' if is_bare else ' ' + unit}"


def study(*, output: Path, run: str, vary: Any = None, fix: Any = None, jobs: int = 0, progress: Progress = None, **keys: Any) -> Study:
    """Runs a command for every combination of what varies: study(run="fill", argument="grain.stl", vary="spheres = 5|9", output="out").

    `vary` and `fix` are texts as in YAML, lists of them, or dictionaries of values as other calls take them: vary={"spheres": [5, 9]}.
    Runs are processes of the command `clast`, `jobs` at once (0: one a core). The same call goes on where it was stopped; runs that failed
    are tried again.
    """
    for name, value in (("vary", vary), ("fix", fix)):
        if hasattr(value, "columns"):
            raise refuse(f"{name}: a table; give a dictionary of values, as {{'spheres': [5, 9]}}, or rows that go together by table='runs.csv'")
        if value is not None:
            keys[name] = _entries(run, name, value) if isinstance(value, dict) else value
    if run not in c.STUDIED:
        raise refuse(f"run: clast {run} has no numbers for a study to tabulate" if run in c.KEYS
                     else f"run: '{run}' is no command that a study can run{nearest(run, c.STUDIED)}")
    n_job, folder = whole("jobs", jobs, 0, 4096), encoded("output", output)
    run_path(output, keys)
    report, monitor = c.clast_study_report(), Monitor(progress)
    before = call("clast_parallel_threads")()
    call("clast_parallel_set_threads")(n_job)
    try:
        with Config(c.clast_study_config(), "clast_study_fields", {"run": run, **keys}) as config:
            check(call("clast_study_check")(ctypes.byref(config.struct), _fields(run), None))
            workers = _Workers(_program(), run)
            status = monitor.run(lambda m: call("clast_study_run")(ctypes.byref(config.struct), folder, ctypes.byref(workers.struct), None, m,
                                                                   ctypes.byref(report)))
        if workers.failed is not None:
            raise workers.failed
        if status != c.VALUES["CLAST_E_NO"]:
            check(status)
    finally:
        call("clast_parallel_set_threads")(before)
    if report.n_unknown:
        name = os.fsdecode(items("keep", keys["keep"])[report.first_unknown])
        warn(f"keep: '{name}'{' and others' if report.n_unknown > 1 else ''}: no run's result has such a number")
    if report.n_failed:
        warn(f"{report.n_failed} of {report.n_run} runs failed; the first says why in {os.fspath(output)}/runs/"
             f"{report.first_failed:06d}.part/messages.txt; the same call tries them again")
    if report.n_unconverged:
        warn(f"{report.n_unconverged} of {report.n_run} runs did not converge (exit code 5)")
    return Study(os.path.abspath(os.fsdecode(output)), report.n_run, report.n_before, report.n_done, report.n_failed, report.n_other,
                 report.n_unconverged)
