"""The library, its errors and configurations, and NumPy arrays over its memory."""
from __future__ import annotations

import ctypes
import functools
import importlib
import inspect
import math
import operator
import os
import pathlib
import signal
import sys
import threading
import warnings
from typing import Any, Callable, Iterable, Iterator, NamedTuple, ParamSpec, Sequence, TypeVar, Union

import numpy as np
from numpy.typing import NDArray

from . import _bindings as c

Floats = NDArray[np.float64]
Progress = Union[bool, None, Callable[[str, int, int], None]]
Quantity = Union[float, str]  #: SI, or a text with its unit ("50deg")
Quantities = Union[Quantity, Sequence[Quantity], NDArray[np.float64]]


class Error(Exception):
    """What the library refused: `code` ("CLAST_E_FORMAT") and the one line that says what, where and what to do."""

    def __init__(self, code: str, line: str) -> None:
        super().__init__(line)
        self.code = code

    def __reduce__(self) -> tuple[type[Error], tuple[str, str]]:  # pools of processes send errors
        return Error, (self.code, str(self))


def _candidates() -> Iterator[str]:
    if os.environ.get("CLAST_LIBRARY"):  # who names a file wants that one or none
        yield os.environ["CLAST_LIBRARY"]
        return
    yield from (str(p) for p in sorted(pathlib.Path(__file__).parent.glob("libclast_view.so*")))
    yield from ("libclast_view.so.0", "libclast_view.so")  # whose handle finds the core's functions too


def _load() -> ctypes.CDLL:
    reasons = []
    for name in _candidates():
        try:
            library = ctypes.CDLL(name)
        except OSError as reason:
            reasons.append(str(reason))
            continue
        library.clast_version.restype = ctypes.c_char_p
        version = library.clast_version().decode()
        if version != c.VERSION:
            raise ImportError(f"clast: {name} is version {version}, this package is for {c.VERSION}; install both from one release")
        return library
    raise ImportError(f"clast: no libclast_view.so ({reasons[-1]}); the wheel of clast brings it (pip install), as do the packages libclast-view0 "
                      "(apt) and clast (conda), and make install of a clone; or set CLAST_LIBRARY to the file")


library = _load()
_STATUS = {value: name for name, value in c.VALUES.items()
           if name == "CLAST_OK" or name.startswith("CLAST_E_")}
_ready: dict[str, Any] = {}


def call(name: str) -> Any:
    """The function of the library, with its prototype."""
    function = _ready.get(name)
    if function is None:
        function = getattr(library, name)
        function.restype, function.argtypes, _ = c.PROTOTYPES[name]
        _ready[name] = function
    return function


def check(status: int) -> None:
    """Raises what the calling thread's last call failed with."""
    if status != 0:
        raise Error(_STATUS.get(status, str(status)), call("clast_error_detail")().decode("utf-8", "replace"))


def refuse(line: str) -> Error:
    return Error("CLAST_E_ARGUMENT", line)


def encoded(name: str, text: str | os.PathLike[str]) -> bytes:
    """A text or path as C reads it, which ends at its first NUL."""
    try:
        made = os.fsencode(text)
    except UnicodeEncodeError:
        raise refuse(f"{name}: {text!r} is no text that can be written as UTF-8") from None
    if b"\0" in made:
        raise refuse(f"{name}: {text!r} has a NUL in it")
    return made


class Owner:
    """A struct of the library's and the function that frees it, when nothing looks into it any more."""

    def __init__(self, struct: Any, free: str) -> None:
        self.struct = struct
        self._free = call(free)
        self._byref = ctypes.byref

    def __reduce__(self) -> Any:
        raise TypeError("what the library owns can be neither copied nor pickled")

    def __del__(self) -> None:
        free = getattr(self, "_free", None)
        if free is not None:
            free(self._byref(self.struct))


def pinned(struct: Any, owner: Any) -> Any:
    """The struct as an argument; its memory lives as long as the call, whoever closes its object in another thread meanwhile."""
    pointer: Any = ctypes.pointer(struct)
    pointer.owner = owner
    return pointer


def view(owner: Any, pointer: Any, shape: Sequence[int], dtype: Any) -> NDArray[Any]:
    """The library's memory as an array that keeps `owner` alive; nothing is copied."""
    kind = np.dtype(dtype)
    n_byte = math.prod(map(int, shape)) * kind.itemsize
    address = ctypes.cast(pointer, ctypes.c_void_p).value
    if not n_byte or address is None:
        return np.empty(shape, kind)
    memory: Any = (ctypes.c_char * n_byte).from_address(address)
    memory.owner = owner
    return np.frombuffer(memory, kind).reshape(shape)


def fixed(owner: Any, pointer: Any, shape: Sequence[int], dtype: Any) -> NDArray[Any]:
    """The same that nobody can write through: numbers that C trusts, as it uses them as indices."""
    seen = view(owner, pointer, shape, dtype)
    return np.frombuffer(memoryview(seen.data).toreadonly(), seen.dtype).reshape(seen.shape) if seen.size else seen


def numbers(name: str, value: Any, columns: Sequence[int] | None, dtype: Any = np.float64) -> NDArray[Any]:
    """`value` as the library reads it: as it is where it fits, else converted once; refused by `name` where it is no numbers."""
    if isinstance(value, np.ma.MaskedArray) and np.any(np.asarray(value.mask)):
        raise refuse(f"{name}: an array with masked items; fill or drop them")
    array = np.asarray(value)
    if array.dtype.kind not in "fiu" or (np.dtype(dtype).kind == "i" and array.dtype.kind == "f"):
        raise refuse(f"{name}: an array of {array.dtype} where numbers ({np.dtype(dtype).name}) are wanted")
    if columns is not None and (array.ndim != 2 or array.shape[1] not in columns):
        wanted = " or ".join(f"(n, {k})" for k in columns)
        raise refuse(f"{name}: an array of shape {array.shape} where {wanted} is wanted")
    if columns is None and array.ndim != 1:
        raise refuse(f"{name}: an array of shape {array.shape} where (n,) is wanted")
    if array.shape[0] == 0:
        raise refuse(f"{name}: an empty array")
    if np.dtype(dtype).itemsize < 8 and array.dtype.itemsize >= 4 and (array.max() > 2**31 - 1 or array.min() < -2**31):
        raise refuse(f"{name}: a number beyond 32 bits")
    return np.require(array, np.dtype(dtype), ["C", "A"])


class Key(NamedTuple):
    """A key of a command: what its keyword takes."""

    kind: str
    default: Any
    unit: str
    low: float | None
    high: float | None
    choices: str | None  #: "a|b|c"
    help: str


def keys(command: str) -> dict[str, Key]:
    """The keys of a command ("aggregate", "mesh check"): default, unit, range and meaning of each keyword."""
    if command not in c.KEYS:
        raise refuse(f"command: '{command}' is none of {', '.join(c.KEYS)}")
    return {name: Key(*row) for name, row in c.KEYS[command].items()}


def warn(line: str) -> None:
    """What the command says on its error stream; shown where people called the package."""
    frame, level = sys._getframe(1), 2
    while frame is not None and frame.f_code.co_filename.startswith(_HOME):
        frame, level = frame.f_back, level + 1  # type: ignore[assignment]
    warnings.warn(line, stacklevel=level)


_HOME = os.path.dirname(__file__) + os.sep


def given(names: dict[str, Any], but: str = "") -> dict[str, Any]:
    """The keywords that were given: those that are not None."""
    return {name: value for name, value in names.items() if value is not None and name != but}


P = ParamSpec("P")
R = TypeVar("R")


def spelt(function: Callable[P, R]) -> Callable[P, R]:
    """Names the nearest keyword where one is misspelt."""
    parameters = inspect.signature(function).parameters
    known = frozenset(name for name, one in parameters.items() if one.kind is not one.VAR_POSITIONAL)

    @functools.wraps(function)
    def checked(*args: P.args, **keywords: P.kwargs) -> R:
        for name in keywords:
            if name not in known:
                raise Error("CLAST_E_CONFIG", f"no keyword {name}{nearest(name, known)}")
        return function(*args, **keywords)
    checked.__module__ = "clast"
    return checked


class Config:
    """A configuration of the library's: its tables' defaults, then keywords in SI numbers or texts with a unit ("50deg")."""

    def __init__(self, struct: Any, tables: str | Sequence[str], keys: dict[str, Any]) -> None:
        names = [tables] if isinstance(tables, str) else tables
        self._tables: list[Any] = [ctypes.cast(ctypes.addressof(ctypes.c_char.in_dll(library, name)), ctypes.POINTER(c.clast_field))
                                   for name in names]
        self.struct = struct
        self._bytes = ctypes.cast(ctypes.byref(struct), ctypes.c_void_p)
        for table in self._tables:
            check(call("clast_fields_default")(table, self._bytes))
        try:
            for name, value in keys.items():
                if value is not None:
                    self._set(name, value)
        except BaseException:
            self.close()
            raise

    def _set(self, name: str, value: Any) -> None:
        found = [f for f in (call("clast_fields_find")(table, name.encode()) for table in self._tables) if f]
        if not found:
            near = next((n for n in (call("clast_fields_nearest")(table, name.encode()) for table in self._tables) if n), None)
            raise Error("CLAST_E_CONFIG", f"no keyword {name}" + (f"; did you mean {near.decode()}?" if near else ""))
        takes_list = found[0].contents.type in (c.VALUES["CLAST_FIELD_TEXT_LIST"], c.VALUES["CLAST_FIELD_F64_LIST"])
        items = list(value) if isinstance(value, (list, tuple, np.ndarray)) else [value]
        if len(items) != 1 and not takes_list:
            raise refuse(f"{name}: takes one value, not {len(items)}")
        if not items:
            call("clast_field_clear")(found[0], self._bytes)
        for k, item in enumerate(items):
            is_text = isinstance(item, (str, os.PathLike))
            text = item if is_text else ("true" if item else "false") if isinstance(item, (bool, np.bool_)) else \
                repr(item.item() if isinstance(item, np.generic) else item)
            check(call("clast_field_set" if is_text else "clast_field_set_si")(found[0], self._bytes, encoded(name, text), k > 0))

    def close(self) -> None:
        for table in self._tables:
            call("clast_fields_free")(table, self._bytes)
        self._tables = []

    def __enter__(self) -> Config:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()


def _log(_: Any, text: bytes) -> None:
    """What comes next ("printable.stl: about 48 MB"), to the logger "clast"."""
    import logging
    logging.getLogger("clast").info("%s", text.decode("utf-8", "replace"))


class Monitor:
    """Progress to a callback or tqdm; Ctrl-C asks the work to end at its checkpoint, then is KeyboardInterrupt."""

    def __init__(self, progress: Progress) -> None:
        self._progress = progress if callable(progress) else _bar() if progress else None
        self._failed: BaseException | None = None
        self._asked = False
        self._report = ctypes.CFUNCTYPE(None, ctypes.c_void_p, ctypes.c_char_p, ctypes.c_int64, ctypes.c_int64)(self._tell)
        self._stop = ctypes.CFUNCTYPE(ctypes.c_bool, ctypes.c_void_p)(lambda _: self._asked or self._failed is not None)
        self.struct = c.clast_monitor()
        self.struct.report = ctypes.cast(self._report, ctypes.c_void_p)
        self.struct.stop = ctypes.cast(self._stop, ctypes.c_void_p)
        self._note = ctypes.CFUNCTYPE(None, ctypes.c_void_p, ctypes.c_char_p)(_log)
        self.struct.note = ctypes.cast(self._note, ctypes.c_void_p)

    def _tell(self, _: Any, phase: bytes, done: int, total: int) -> None:
        if self._progress is not None and self._failed is None:
            try:
                self._progress(phase.decode(), done, total)
            except BaseException as failed:  # raised again when the library has returned
                self._failed = failed

    def _interrupt(self, *_: object) -> None:
        self._asked = True

    def run(self, work: Callable[[Any], Any]) -> Any:
        """work(monitor): its status."""
        is_main = threading.current_thread() is threading.main_thread()
        before = signal.getsignal(signal.SIGINT) if is_main else None  # None in the main thread: the handler of a program around Python
        if before is not None:
            signal.signal(signal.SIGINT, self._interrupt)
        try:
            status = work(ctypes.byref(self.struct))
        finally:
            if before is not None:
                signal.signal(signal.SIGINT, before)
        if self._failed is not None:
            raise self._failed
        if self._asked:
            raise KeyboardInterrupt
        return status


def _bar() -> Callable[[str, int, int], None] | None:
    try:
        bar: Any = importlib.import_module("tqdm.auto").tqdm()
    except ImportError:
        return None

    def tell(phase: str, done: int, total: int) -> None:
        bar.set_description(phase)
        bar.total = total if total > 0 else None
        bar.n = done
        bar.refresh()
    return tell


def text_of(make: Callable[[Any], Any]) -> str:
    """A text that the library made, freed."""
    text = ctypes.c_char_p()
    check(make(ctypes.byref(text)))
    value = (text.value or b"").decode("utf-8", "replace")
    call("clast_text_free")(text)
    return value


def html_table(rows: dict[str, Any] | Sequence[Sequence[Any]], head: Sequence[str] = (), foot: str = "") -> str:
    """Names and values, or rows under a head, as an HTML table; texts are escaped."""
    from html import escape
    pairs = [f"<tr><th>{escape(k)}</th>{_cell(v)}</tr>" for k, v in rows.items()] if isinstance(rows, dict) else \
        ["<tr>" + "".join(map(_cell, row)) + "</tr>" for row in rows]
    top = "<tr>" + "".join(f"<th>{escape(name)}</th>" for name in head) + "</tr>" if head else ""
    return f"<table>{top}{''.join(pairs)}</table>{f'<p>{escape(foot)}</p>' if foot else ''}"


def _cell(value: Any) -> str:
    from html import escape
    return f"<td>{escape(f'{value:.6g}' if isinstance(value, (float, np.floating)) else str(value))}</td>"


def nearest(name: str, names: Iterable[str]) -> str:
    """"; did you mean seed?" where a name is near, else nothing."""
    from difflib import get_close_matches
    near = get_close_matches(name, list(names), 1)
    return f"; did you mean {near[0]}?" if near else ""


def whole(name: str, value: Any, low: int, high: int) -> int:
    """An integer that fits: ctypes would drop the bits that do not."""
    try:
        number = operator.index(value)
    except TypeError:
        raise refuse(f"{name}: {value!r} is no integer") from None
    if not low <= number <= high:
        raise refuse(f"{name}: {number} lies outside {low} to {high}")
    return number


def choice(key: str, value: str, words: str) -> int:
    """The number of a word among "a|b|c"; any other is refused by name."""
    known = words.split("|")
    if value not in known:
        raise refuse(f"{key}: '{value}' is none of {', '.join(known)}{nearest(str(value), known)}")
    return known.index(value)


def settled(command: str, given: dict[str, Any]) -> dict[str, Any]:
    """The keys of a command with defaults filled in: SI numbers, words, texts; for commands without a table in the library."""
    rows = keys(command)
    for name in given:
        if name not in rows:
            raise Error("CLAST_E_CONFIG", f"no keyword {name}{nearest(name, rows)}")
    return {name: _value(name, key, given.get(name)) for name, key in rows.items()}


def _value(name: str, key: Key, value: Any) -> Any:
    if value is None:
        return int(key.default) if key.kind == "integer" else key.default
    if key.kind == "choice":
        choice(name, value, key.choices or "")
    elif key.kind in ("number", "integer"):
        if isinstance(value, str):
            number = ctypes.c_double()
            check(call("clast_unit_parse_asked")(encoded(name, value), key.unit.encode(), ctypes.byref(number)))
            value = number.value
        try:
            value = float(value) if key.kind == "number" else operator.index(int(value) if value == int(value) else value)
        except (TypeError, ValueError, OverflowError):
            raise refuse(f"{name}: '{value}' is no {key.kind}") from None
        if not (key.low is None or key.high is None or key.low <= value <= key.high):
            raise Error("CLAST_E_CONFIG", f"{name}: {value!r} lies outside {key.low:g} to {key.high:g}")
    elif key.kind == "flag":
        value = bool(value)
    elif key.kind == "text":
        value = os.fspath(value)
    return value
