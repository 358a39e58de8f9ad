"""Tables with named columns: of the library's, of files, and of what people hold in Python."""
from __future__ import annotations

import ctypes
import importlib
import os
from typing import Any, Sequence

import numpy as np
from numpy.typing import NDArray

from . import _bindings as c
from ._core import Owner, call, check, encoded, html_table, output_path, refuse, unmasked, view

Path = str | os.PathLike[str]
Text = Path  #: where a key takes words, or a file
Texts = Text | Sequence[Text]


class Table(NDArray[Any]):
    """A structured array, one field a column; names give the unit (diameter_m), `units` has it.

    A field by its name is a plain array: `table["porosity"].mean()`.
    """

    units: dict[str, str]

    def __array_finalize__(self, base: Any) -> None:
        self.units = getattr(base, "units", {})

    def __reduce__(self) -> tuple[Any, ...]:  # NumPy's own state knows of no units
        made: Any = super().__reduce__()
        return made[0], made[1], (made[2], self.units)

    def __setstate__(self, state: Any) -> None:
        array, self.units = state
        super().__setstate__(array)

    def __getitem__(self, key: Any) -> Any:
        part = super().__getitem__(key)
        if not isinstance(part, Table):
            return part
        if part.dtype.names is None:
            return part.view(np.ndarray)
        part.units = {name: unit for name, unit in self.units.items() if name in part.dtype.names}
        return part

    @property
    def columns(self) -> tuple[str, ...]:
        """Their names; those of numbers end in their unit where they have one (diameter_m)."""
        return self.dtype.names or ()

    def to_pandas(self) -> Any:
        """A pandas.DataFrame of the same columns."""
        try:
            pandas: Any = importlib.import_module("pandas")
        except ImportError:
            raise refuse("to_pandas: pandas is not installed (apt install python3-pandas, or pip install pandas)") from None
        return pandas.DataFrame({name: np.ascontiguousarray(self[name]) for name in self.columns})

    def write(self, path: Path) -> None:
        """Writes CSV or JSON, by the name's end, as the commands do."""
        functions = {".csv": "clast_table_write_csv", ".json": "clast_table_write_json"}
        function = functions.get(os.path.splitext(os.fspath(path))[1].lower(), "")
        if not function:
            raise refuse(f"path: {os.fspath(path)}: a table is written as .csv or .json; to_pandas() writes others")
        owner = given_table("table", self)
        check(call(function)(ctypes.byref(owner.struct), output_path("path", path)))

    def _repr_html_(self) -> str:
        shown = self[:10] if self.ndim else self.reshape(1)
        rows = [[row[name] for name in self.columns] for row in shown]
        return html_table(rows, self.columns, f"{len(shown)} of {self.size} rows" if self.size > len(shown) else "")


def table_of(owner: Owner, part: Any = None) -> Table:
    """A table of the library's, or one that is part of what is owned (a copy: columns lie apart in the library)."""
    table = owner.struct if part is None else part
    columns = [table.column[k] for k in range(table.n_column)]
    n = int(table.n_row)
    texts = {k: [(column.text[i] or b"").decode("utf-8", "replace") for i in range(n)]
             for k, column in enumerate(columns) if not column.number}
    kinds = [(column.name.decode(), f"U{max([1, *map(len, texts[k])])}" if k in texts else "f8") for k, column in enumerate(columns)]
    out = np.zeros(n, np.dtype(kinds))
    for k, column in enumerate(columns):
        out[kinds[k][0]] = texts[k] if k in texts else view(None, column.number, (n,), np.float64)
    found = out.view(Table)
    found.units = {column.name.decode(): (column.unit or b"").decode() for column in columns if column.number}
    return found


def read_table(path: Path) -> Table:
    """Delimited text as a structured array; numbers stay as they are, names give their unit."""
    return table_of(_read(path))


def _read(path: Path) -> Owner:
    table = c.clast_table()
    check(call("clast_table_read_csv")(encoded("path", path), None, ctypes.byref(table), None))
    return Owner(table, "clast_table_free")


def given_table(name: str, value: Any) -> Owner:
    """A table of the library's from a file, a structured array, a pandas.DataFrame or a dictionary of columns."""
    if isinstance(value, (str, os.PathLike)):
        return _read(value)
    columns = _columns_of(name, value)
    owner = Owner(c.clast_table(), "clast_table_free")
    lengths = {len(values) for values in columns.values()}
    if len(lengths) != 1:
        raise refuse(f"{name}: {'no column' if not lengths else 'columns of ' + ' and '.join(map(str, sorted(lengths))) + ' rows'}")
    n = lengths.pop()
    units = getattr(value, "units", {})
    check(call("clast_table_init")(ctypes.byref(owner.struct), encoded("name", name), n))
    for k, (column, values) in enumerate(columns.items()):
        if values.dtype.kind in "fiub":
            check(call("clast_table_add_number")(ctypes.byref(owner.struct), encoded("column", column), units.get(column, "-").encode(), None))
            view(owner, owner.struct.column[k].number, (n,), np.float64)[...] = values
        else:
            check(call("clast_table_add_text")(ctypes.byref(owner.struct), encoded("column", column)))
            for i, text in enumerate(values):
                check(call("clast_table_set_text")(ctypes.byref(owner.struct), k, i, encoded(column, text.decode() if isinstance(text, bytes) else str(text))))
    return owner


def _columns_of(name: str, value: Any) -> dict[str, NDArray[Any]]:
    names = getattr(getattr(value, "dtype", None), "names", None)  # a structured array
    if names is None and hasattr(value, "keys") and hasattr(value, "__getitem__"):  # a dictionary, a DataFrame
        names = tuple(value.keys())
    if names is None:
        raise refuse(f"{name}: a {type(value).__name__} where a file, a structured array, a DataFrame or a dictionary of columns is wanted")
    found = {str(column): np.asarray(unmasked(f"{name}: column {column}", value[column])) for column in names}
    found = {column: values.astype(str) if values.dtype.kind in "mM" else values for column, values in found.items()}  # times are texts
    for column, values in found.items():
        if values.ndim != 1 or values.dtype.kind not in "fiubUSO":
            raise refuse(f"{name}: column {column} of shape {values.shape} and type {values.dtype} is neither numbers nor texts")
    return found
