"""The library, its errors and configurations, and NumPy arrays over its memory."""
from __future__ import annotations

import ctypes
import functools
import importlib
import inspect
import math
import os
import pathlib
import re
import signal
import sys
import threading
import warnings
from numbers import Integral, Real
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
        return type(self), (self.code, str(self))


class Missing(Error, AttributeError):
    """A member that is not there: hasattr, getattr with a default and inspect take it for absent."""


class Equal:
    """Equal where all members are, NaN to NaN: a number that is not known is no difference."""

    def __eq__(self, other: object) -> bool:
        return type(self) is type(other) and _plain(vars(self)) == _plain(vars(other))

    def __hash__(self) -> int:
        return hash(_plain(vars(self)))


def _plain(value: Any) -> Any:
    if isinstance(value, dict):
        return tuple((name, _plain(one)) for name, one in value.items())
    return None if value != value else value


class Fixed:
    """Whose members named in _FIXED cannot be replaced: the library would not see it, or read beyond what is there."""

    _FIXED: tuple[str, ...] = ()

    def __setattr__(self, name: str, value: Any) -> None:
        if name in self._FIXED:
            raise AttributeError(f"{name}: cannot be replaced; write into the array, or make another {type(self).__name__}")
        super().__setattr__(name, value)


_INTERFACE = c.VERSION.rpartition(".")[0]  # of the soname


def _candidates() -> Iterator[str]:
    if os.environ.get("CLAST_LIBRARY"):  # who names a file wants that one or none
        yield os.environ["CLAST_LIBRARY"]
        return
    yield from (str(p) for p in sorted(pathlib.Path(__file__).parent.glob("libclast_view.so*")))
    yield from (f"libclast_view.so.{_INTERFACE}", "libclast_view.so")  # whose handle finds the core's functions too


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
    raise ImportError(f"clast: no libclast_view.so ({reasons[-1]}); the wheel of clast brings it (pip install), as do the packages libclast-view{_INTERFACE} "
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


def status_name(status: int) -> str:
    return _STATUS.get(status, str(status))


def check(status: int, name: str = "") -> None:
    """Raises what the calling thread's last call failed with, `name` before it."""
    if status != 0:
        detail = in_python(call("clast_error_detail")().decode("utf-8", "replace"))
        raise Error(status_name(status), f"{name}: {detail}" if name else detail)


def in_python(line: str) -> str:
    """A line of the library's without names of C functions, its options as the keywords that they are here; commands to be typed stay."""
    line = re.sub(r"(?<!\S)clast_\w+: ", "", line, count=1)
    line = re.sub(r"(\bclast(?: [a-z]+)+(?: [^ ;,`)]+)*)|(?<![\w-])--([a-z][a-z-]*)", lambda found: found[1] or found[2].replace("-", "_"), line)
    return re.sub(r"\b(by|without) -o\b", r"\1 output", line)


def refuse(line: str) -> Error:
    return Error("CLAST_E_ARGUMENT", line.replace("\n", " "))  # of an array


def encoded(name: str, text: str | os.PathLike[str]) -> bytes:
    """A text or path as C reads it, which ends at its first NUL."""
    try:
        made = os.fsencode(text)
    except UnicodeEncodeError:
        raise refuse(f"{name}: {text!r} is no text that can be written as UTF-8") from None
    except TypeError:
        raise refuse(f"{name}: a {type(text).__name__} where a text or a path is wanted") from None
    if b"\0" in made:
        raise refuse(f"{name}: {text!r} has a NUL in it")
    return made


def output_path(name: str, path: str | os.PathLike[str], *inputs: Any, is_folder: bool = False) -> bytes:
    """A path to write to as C reads it: no file of a run, none of the inputs that are files, and one that can be written, as the commands refuse it."""
    made = encoded(name, path)
    check(call("clast_run_folder_check_output")(name.encode(), made))
    for one in inputs:
        if isinstance(one, (str, os.PathLike)):
            check(call("clast_run_folder_check_input")(name.encode(), made, encoded(name, one)))
    if not is_folder:
        require_writable(os.fsdecode(path))
    return made


def require_writable(place: str) -> None:
    """Before the work: a file can be written there; what a link names is left to the writing, as is a pipe."""
    folder, is_link = place[:place.rfind("/") + 1] or ".", os.path.islink(place)
    if os.path.isdir(place) and not is_link:
        why = "it is a folder"
    elif is_link or (os.path.exists(place) and not os.path.isfile(place)):
        return
    elif not os.path.isdir(folder):
        why = f"there is no folder {folder}"
    elif not os.access(folder, os.W_OK | os.X_OK):
        why = f"the folder {folder} cannot be written into"
    else:
        return
    raise Error("CLAST_E_DISK", f"cannot write {place}: {why}".replace("\n", " "))


def run_path(output: str | os.PathLike[str] | None, keys: dict[str, Any]) -> bytes | None:
    """The folder of a run to be written, which is not that of a file that the keys name."""
    made = None if output is None else encoded("output", output)
    for name, value in keys.items() if made is not None else ():
        for one in items(name, value):
            if isinstance(one, (str, os.PathLike)):
                check(call("clast_run_folder_check_input")(b"output", made, encoded(name, one)))
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


def unmasked(name: str, value: Any) -> Any:
    """The value; refused where it masks items, whose numbers mean nothing."""
    if isinstance(value, np.ma.MaskedArray) and np.any(np.asarray(value.mask)):
        raise refuse(f"{name}: an array with masked items; fill or drop them")
    return value


def numbers(name: str, value: Any, columns: Sequence[int] | None, dtype: Any = np.float64, least: int = 1) -> NDArray[Any]:
    """`value` as the library reads it: as it is where it fits, else converted once; refused by `name` where it is no numbers."""
    array = np.asarray(unmasked(name, value))
    if array.dtype.kind not in "fiu" or (np.dtype(dtype).kind == "i" and array.dtype.kind == "f"):
        raise refuse(f"{name}: an array of {array.dtype} where numbers ({np.dtype(dtype).name}) are wanted")
    if columns is not None and (array.ndim != 2 or array.shape[1] not in columns):
        wanted = " or ".join(f"(n, {k})" for k in columns)
        raise refuse(f"{name}: an array of shape {array.shape} where {wanted} is wanted")
    if columns is None and array.ndim != 1:
        raise refuse(f"{name}: an array of shape {array.shape} where (n,) is wanted")
    if array.shape[0] < least:
        raise refuse(f"{name}: an empty array")
    if array.size and np.dtype(dtype).itemsize < 8 and array.dtype.itemsize >= 4 and (array.max() > 2**31 - 1 or array.min() < -2**31):
        raise refuse(f"{name}: a number beyond 32 bits")
    return np.require(array, np.dtype(dtype), ["C", "A"])


def items(name: str, value: Any) -> list[Any]:
    """The values of a list, an array or a pandas.Series, or the one value there is; those of NumPy as Python's own."""
    plain = value.tolist() if hasattr(unmasked(name, value), "tolist") else value
    return [one.tolist() if hasattr(one, "tolist") else one for one in (plain if isinstance(plain, (list, tuple, range)) else [plain])]


def single(name: str, value: Any) -> Any:
    found = items(name, value)
    if len(found) != 1:
        raise refuse(f"{name}: takes one value, not {len(found)}")
    return found[0]


def written(name: str, value: Any) -> str | os.PathLike[str]:
    """A value as the library parses it, a number in SI."""
    if isinstance(value, (str, os.PathLike)):
        return value
    if isinstance(value, bool):
        return str(value).lower()
    if not isinstance(value, Real):
        raise refuse(f"{name}: a {type(value).__name__} where a number or a text is wanted")
    return str(int(value)) if isinstance(value, Integral) else repr(float(value))


def size(name: str, value: Any) -> Any:
    """A text that may be one size: a number is in metres."""
    one = single(name, value)
    return one if isinstance(one, (str, bool, os.PathLike)) or not isinstance(one, Real) else f"{written(name, one)} m"


def flag(name: str, value: Any) -> bool:
    """A flag by itself or by one of the words that the command takes ("yes", "off")."""
    word = written(name, single(name, value))
    if word not in _FLAGS:
        raise refuse(f"{name}: '{word}' is neither true nor false")
    return _FLAGS.index(word) < 4


_FLAGS = ("true", "yes", "on", "1", "false", "no", "off", "0")


def quantity(name: str, value: Any, unit: str = "-", low: float = -math.inf, high: float = math.inf, bare: bool = False) -> float:
    """A number in SI, or a text with its unit, `bare`: perhaps without."""
    one = single(name, value)
    if isinstance(one, str):
        number = ctypes.c_double()
        check(call("clast_unit_parse" if bare else "clast_unit_parse_asked")(encoded(name, one), unit.encode(), ctypes.byref(number)), name)
        one = number.value
    try:
        if isinstance(one, bool) or not isinstance(one, Real) or one != one:
            raise TypeError
        return _inside(name, float(one), low, high)
    except (TypeError, OverflowError):
        raise refuse(f"{name}: {one!r} is no number") from None


def length(name: str, value: Any, unit: str, low: float = 0.0, high: float = 1e9) -> float:
    """A length in a file's own unit: a number, or a text, which may have another unit where the file names its own."""
    one = single(name, value)
    if isinstance(one, str):
        number = ctypes.c_double()
        check(call("clast_unit_parse_length")(encoded(name, one), unit.encode(), ctypes.byref(number)), name)
        one = number.value
    return quantity(name, one, low=low, high=high)


def whole(name: str, value: Any, low: float, high: float) -> int:
    """A whole number that fits: ctypes would drop the bits that do not."""
    one = single(name, value)
    if isinstance(one, str):
        one = int(one) if one.isdecimal() else quantity(name, one)
    if isinstance(one, float) and one.is_integer():
        one = int(one)
    if isinstance(one, bool) or not isinstance(one, Integral):
        raise refuse(f"{name}: {one!r} is no integer")
    return _inside(name, int(one), low, high)


N = TypeVar("N", int, float)


def _inside(name: str, number: N, low: float, high: float) -> N:
    if not low <= number <= high:
        raise Error("CLAST_E_CONFIG", f"{name}: {number} lies outside {low:g} to {high:g}")
    return number


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
    warnings.warn(in_python(line), stacklevel=level)


_HOME = os.path.dirname(__file__) + os.sep


def note(line: str) -> None:
    """What the command says as a note ("printable.stl: about 48 MB"), to the logger "clast"."""
    import logging
    logging.getLogger("clast").info("%s", in_python(line))


def people_write(value: float, unit: str) -> str:
    """A quantity in the unit in which people write it ("3.75 um")."""
    factor = ctypes.c_double(1.0)
    name = call("clast_unit_for")(value, unit.encode(), ctypes.byref(factor)).decode()
    size = value * factor.value
    return f"{size:{'.0f' if 1e4 <= abs(size) < 1e6 else '.4g'}} {name}"


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


def refuse_idle(names: Iterable[str], rules: str, *facts: Any) -> None:
    """Refuses the first of these keywords that the call would not look at, by the command's rules: those that "clast_fill_idle" makes of facts."""
    made = (c.clast_idle * c.VALUES["CLAST_N_IDLE"])()
    call(rules)(*facts, made)
    for name in names:
        for rule in made:
            if rule.is_idle and name in rule.names.decode().split("|"):
                raise Error("CLAST_E_CONFIG", in_python(f"{name} does nothing {rule.why.decode()}").replace("_column", ""))


SIZES = ("curve",)  #: keys that take a text, or one size


class Config:
    """A configuration of the library's: its tables' defaults, then keywords in SI numbers or texts with a unit ("50deg")."""

    def __init__(self, struct: Any, tables: str | Sequence[str], keys: dict[str, Any]) -> None:
        names = [tables] if isinstance(tables, str) else tables
        self._tables: list[Any] = [ctypes.cast(ctypes.addressof(ctypes.c_char.in_dll(library, name)), ctypes.POINTER(c.clast_field))
                                   for name in names]
        self.struct = struct
        self._bytes = ctypes.cast(ctypes.byref(struct), ctypes.c_void_p)
        self._given: dict[str, Any] = {}
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
        self._given[name] = found[0]
        kind = found[0].contents.type
        takes_list = kind in (c.VALUES["CLAST_FIELD_TEXT_LIST"], c.VALUES["CLAST_FIELD_F64_LIST"])
        values = items(name, value) if takes_list else [single(name, value)]
        if not values:
            call("clast_field_clear")(found[0], self._bytes)
        for k, one in enumerate(values):
            one = size(name, one) if name in SIZES else one
            is_text = isinstance(one, (str, os.PathLike))
            if kind == c.VALUES["CLAST_FIELD_U64"] and isinstance(one, float) and one.is_integer():
                one = int(one)  # as 3.0 is where fewer bits are kept
            check(call("clast_field_set" if is_text else "clast_field_set_si")(found[0], self._bytes, encoded(name, written(name, one)), k > 0))

    def changed(self) -> list[str]:
        """The keywords with another value than their default."""
        return [name for name, row in self._given.items() if not call("clast_field_is_default")(row, self._bytes)]

    def close(self) -> None:
        for table in self._tables:
            call("clast_fields_free")(table, self._bytes)
        self._tables = []

    def __enter__(self) -> Config:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()


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
        self._note = ctypes.CFUNCTYPE(None, ctypes.c_void_p, ctypes.c_char_p)(lambda _, text: note(text.decode("utf-8", "replace")))
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


def html_members(made: Any, *kinds: type) -> str:
    """The members of these kinds (int, float), as an HTML table."""
    return html_table({name: value for name, value in vars(made).items() if isinstance(value, kinds)})


def html_last(history: Any, *names: str) -> str:
    """Columns of a history's last row, those that it has, as an HTML table."""
    return html_table({name: float(history[-1][name]) for name in names if name in history.dtype.names})


def _cell(value: Any) -> str:
    from html import escape
    return f"<td>{escape(f'{value:.6g}' if isinstance(value, (float, np.floating)) else str(value))}</td>"


def nearest(name: str, names: Iterable[str]) -> str:
    """"; did you mean seed?" where a name is near, else nothing."""
    from difflib import get_close_matches
    near = get_close_matches(name, list(names), 1)
    return f"; did you mean {near[0]}?" if near else ""


def choice(key: str, value: str, words: str) -> int:
    """The number of a word among "a|b|c"; any other is refused by name."""
    known = words.split("|")
    if not isinstance(value, str) or value not in known:
        raise refuse(f"{key}: '{value}' is none of {', '.join(known)}{nearest(str(value), known)}")
    return known.index(value)


def settled(command: str, given: dict[str, Any]) -> dict[str, Any]:
    """The keys of a command with defaults filled in: SI numbers, words, texts; for commands without a table in the library."""
    rows = keys(command)
    for name in given:
        if name not in rows:
            raise Error("CLAST_E_CONFIG", f"no keyword {name}{nearest(name, rows)}")
    return {name: _value(name, key, given.get(name)) for name, key in rows.items()}


def changed(command: str, given: dict[str, Any]) -> list[str]:
    """The keys of settled values with another value than their default."""
    return [name for name, value in given.items() if value != c.KEYS[command][name][1]]


def _value(name: str, key: Key, value: Any) -> Any:
    if value is None:
        return int(key.default) if key.kind == "integer" else key.default
    if key.kind == "choice":
        choice(name, value, key.choices or "")
    elif key.kind in ("number", "integer"):
        ends = -math.inf if key.low is None else key.low, math.inf if key.high is None else key.high
        value = quantity(name, value, key.unit, *ends) if key.kind == "number" else whole(name, value, *ends)
    elif key.kind == "flag":
        value = flag(name, value)
    elif key.kind == "text":
        value = os.fsdecode(encoded(name, single(name, value)))
    return value
