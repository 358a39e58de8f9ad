"""Writes python/clast/_bindings.py, and _functions.py beside it, from what `clast describe --json` prints.

make_python.py DESCRIPTION.json OUT
"""
import json
import pathlib
import sys

from headers import Declared
from python_functions import Functions

SCALARS = {"double": "c_double", "float": "c_float", "bool": "c_bool", "size_t": "c_size_t", "int": "c_int", "char": "c_char",
           "uint8_t": "c_uint8", "unsigned char": "c_uint8", "int32_t": "c_int32", "int64_t": "c_int64", "uint32_t": "c_uint32",
           "uint64_t": "c_uint64"}
HEAD = '''"""Structs, named values, prototypes and keys of libclast: written by tools/make_python.py, do not edit."""
from __future__ import annotations

from ctypes import (POINTER, Structure, c_bool, c_char, c_char_p, c_double, c_float, c_int, c_int32, c_int64, c_size_t, c_uint8,
                    c_uint32, c_uint64, c_void_p)
from typing import Any

__all__ = ["FOLDERS", "KEYS", "PROTOTYPES", "SIZES", "STUDIED", "TABLES", "VALUES", "VERSION"]

_ = (c_char, c_float, c_uint32)
'''


class Bindings:
    def __init__(self, described):
        self.d = described
        self.structs = {s["name"] for s in described["structs"]}
        self.values = {v["name"]: v["value"] for v in described["enums"]}
        self.enums = {v["enum"] for v in described["enums"] if v["enum"]}

    def base(self, name):
        """The ctypes name of a type that is no pointer, or None for one that only the library knows."""
        return SCALARS.get(name) or ("c_int" if name in self.enums else name if name in self.structs else None)

    def type(self, d, is_argument):
        if d.is_function:
            return "c_void_p"
        stars = d.stars - (1 if d.is_row else 0)
        base = self.base(d.type)
        if is_argument and d.dims and not d.is_row:  # arrays decay
            stars, dims = stars + 1, []
        elif d.is_row:
            stars, dims = stars + 1, []
        else:
            dims = d.dims
        if stars > 0 and d.type == "char":
            text, stars = "c_char_p", stars - 1
        elif stars > 0 and base is None:
            text, stars = "c_void_p", stars - 1
        else:
            text = base or "c_void_p"
        text = "POINTER(" * stars + text + ")" * stars
        for n in reversed(dims):
            text = f"{text} * {int(eval(n, {}, self.values))}"
            text = f"({text})"
        return text

    def in_order(self):
        """Structs after those that they hold by value."""
        left, done = {s["name"]: s for s in self.d["structs"]}, []
        while left:
            for name, one in list(left.items()):
                held = {Declared(f["declaration"]).type for f in one["fields"] if "*" not in f["declaration"]}
                if not held & set(left):
                    done.append(left.pop(name))
        return done

    def lines(self):
        yield HEAD
        yield f"VERSION = {self.d['version']!r}\n\n"
        ordered = self.in_order()
        for one in ordered:
            yield f"class {one['name']}(Structure):\n    {short(one['doc'] or one['name'])}\n\n"
        for one in ordered:
            yield f"{one['name']}._fields_ = ["
            for f in one["fields"]:
                yield f"    ({f['name']!r}, {self.type(Declared(f['declaration']), False)}),"
            yield "]"
        yield "\n# sizeof, and offsetof and sizeof of each member, as C has them.\nSIZES: dict[str, tuple[int, dict[str, tuple[int, int]]]] = {"
        for one in ordered:
            inner = ", ".join(f"{f['name']!r}: ({f['offset']}, {f['size']})" for f in one["fields"])
            yield f"    {one['name']!r}: ({one['size']}, {{{inner}}}),"
        yield "}\n\nVALUES: dict[str, int] = {"
        for name, value in self.values.items():
            yield f"    {name!r}: {value},"
        yield "}\n\n# name: (result, arguments, what it does)\nPROTOTYPES: dict[str, tuple[Any, list[Any], str]] = {"
        for f in self.d["functions"]:
            arguments = ", ".join(self.type(Declared(a["declaration"]), True) for a in f["arguments"])
            result = "None" if f["returns"] == "void" else self.type(Declared(f["returns"] + " result"), False)
            yield f"    {f['name']!r}: ({result}, [{arguments}], {short(f['doc'])[3:-3]!r}),"
        yield "}\n\n# command: key: (type, default, unit, least, greatest, choices, what it is)"
        yield "KEYS: dict[str, dict[str, tuple[str, Any, str, float | None, float | None, str | None, str]]] = {"
        for c in self.d["commands"]:
            yield f"    {c['name']!r}: {{"
            for k in c["fields"]:
                row = (k["type"], k["default"], k["unit"], k["low"], k["high"], k["choices"], k["doc"])
                yield f"        {k['name']!r}: {row!r},"
            yield "    },"
        yield "}\n\n# Keys of the library's own tables.\nTABLES: dict[str, tuple[str, ...]] = {"
        for name, fields in self.d["configurations"].items():
            yield f"    {name!r}: {tuple(k['name'] for k in fields)!r},"
        yield "}\n\n# Commands that write a run's folder."
        yield f"FOLDERS: tuple[str, ...] = {tuple(c['name'] for c in self.d['commands'] if c['writes_folder'])!r}"
        yield "\n# Commands that a study can run."
        yield f"STUDIED: tuple[str, ...] = {tuple(c['name'] for c in self.d['commands'] if c['runs_in_studies'])!r}"


def short(doc):
    """The first sentence, quoted."""
    text = doc.split(". ")[0].rstrip(".").replace("\\", "/").replace('"""', "'''")
    return f'"""{text}."""' if not text.endswith('"') else f'"""{text} ."""'


def main():
    described = json.loads(pathlib.Path(sys.argv[1]).read_text())
    out = pathlib.Path(sys.argv[2])
    out.write_text("\n".join(Bindings(described).lines()) + "\n")
    out.with_name("_functions.py").write_text(Functions(described).text())


main()
