"""The functions of python/clast with every keyword in their signatures, from the hand-written ones and the tables of keys."""
import ast
import pathlib
import re
import textwrap

SOURCE = pathlib.Path(__file__).resolve().parents[1] / "python/clast"
FILES = {"fill": {"name", "history"},  # keys by which the command alone writes files; those of clouds, which a box has not
         "box_model": {"rebuild", "change_level", "fixed", "depth", "self_collisions"}}
SIZES = ("curve",)  # texts that may be one size, as in _core.py
MODULES = ("_beds", "_boxes", "_clouds", "_core", "_grains", "_growth", "_html", "_mesh", "_models", "_runs", "_studies", "_surfaces", "_tables", "_views")
# function: its module, its command, and the library's tables that its **keys may name
FUNCTIONS = {
    "aggregate": ("_growth", "aggregate", ["clast_aggregate_fields"]),
    "agglomerate": ("_clouds", "agglomerate", ["clast_agglomerate_fields", "clast_decompose_fields"]),
    "box_model": ("_boxes", "agglomerate", ["clast_spectrum_fields", "clast_agglomerate_fields"]),
    "decompose": ("_clouds", "decompose", ["clast_decompose_fields"]),
    "evolve": ("_growth", "evolve", ["clast_evolve_fields"]),
    "export": ("_runs", "export", []),
    "fill": ("_beds", "fill", ["clast_fill_fields"]),
    "fit": ("_models", "fit", ["clast_porosity_fit_fields"]),
    "mesh_check": ("_mesh", "mesh check", []),
    "mesh_convert": ("_surfaces", "mesh convert", []),
    "mesh_form": ("_surfaces", "mesh form", []),
    "mesh_hull": ("_surfaces", "mesh hull", []),
    "mesh_repair": ("_surfaces", "mesh repair", ["clast_mesh_repair_fields"]),
    "mesh_simplify": ("_surfaces", "mesh simplify", []),
    "mesh_synthesize": ("_surfaces", "mesh synthesize", ["clast_synthesize_fields"]),
    "pack": ("_growth", "pack", ["clast_pack_fields"]),
    "porosity": ("_beds", "porosity", []),
    "predict": ("_models", "predict", []),
    "predict_beds": ("_models", "predict", []),
    "render": ("_views", "render", ["clast_render_fields"]),
    "report": ("_views", "report", ["clast_report_fields"]),
    "grain_statistics": ("_grains", "shape", []),
    "shape": ("_mesh", "shape", []),
    "shapes": ("_grains", "shape", []),
    "study": ("_studies", "study", ["clast_study_fields"]),
}
HEAD = '''"""One function a command, every keyword with its type: written by tools/make_python.py, do not edit."""
from __future__ import annotations

from typing import Any, Literal

'''


class Functions:
    def __init__(self, described):
        self.tables = described["configurations"]
        self.keys = {one["name"]: {k["name"]: k for k in one["fields"]} for one in described["commands"]}
        self.trees = {name: ast.parse((SOURCE / f"{name}.py").read_text()) for name in MODULES}
        self.homes = {name: module for module, tree in self.trees.items() for name in defined(tree)}
        self.used = {"given", "spelt"}

    def text(self):
        bodies = [self.function(name, *about) for name, about in FUNCTIONS.items()]
        by_module = {}
        for name in self.used:
            if name in self.homes:
                by_module.setdefault(self.homes[name], set()).add(name)
        imports = [f"from . import {', '.join(sorted({about[0] for about in FUNCTIONS.values()}))}"]
        imports += [f"from .{module} import {', '.join(sorted(names))}" for module, names in sorted(by_module.items())]
        names = textwrap.fill(", ".join(f'"{name}"' for name in FUNCTIONS), 120, subsequent_indent=" " * 11)
        return HEAD + "\n".join(imports) + f"\n\n__all__ = [{names}]\n" + "".join(bodies)

    def function(self, name, module, command, tables):
        made = next(one for one in self.trees[module].body if isinstance(one, ast.FunctionDef) and one.name == name)
        own = [a.arg for a in made.args.posonlyargs + made.args.args + made.args.kwonlyargs]
        rows = {k["name"]: k for table in tables for k in self.tables[table]
                if k["name"] not in own and k["name"] not in FILES.get(name, ())}
        assert (made.args.kwarg is not None) == bool(tables), name
        parts = [*self.positional(made.args), *(f"{key}: {self.type_of(row)} | None = None" for key, row in rows.items())]
        self.mark(made.returns)
        star = made.args.vararg
        words = f"*{star.arg}, **given(locals(), '{star.arg}')" if star else "**given(locals())"
        listed = {**{key: self.keys[command][key] for key in own if key in self.keys[command]}, **rows}
        doc = ast.get_docstring(made) + "".join(["\n\nKeywords (None: the default; a number is SI, a text has its unit):\n"] if listed else [])
        doc += "\n".join(f"    {key}: {told(row)}" for key, row in listed.items())
        indented = "\n".join(("    " + line).rstrip() for line in doc.replace("\\", "\\\\").splitlines())
        lines = ",\n        ".join(parts)
        return (f"\n\n@spelt\ndef {name}(\n        {lines},\n) -> {ast.unparse(made.returns)}:\n"
                f'    """{indented.strip()}\n    """\n    return {module}.{name}({words})\n')

    def positional(self, args):
        """The hand-written parameters, as they stand."""
        plain = args.args
        first = len(plain) - len(args.defaults)
        for k, one in enumerate(plain):
            yield self.parameter(one, args.defaults[k - first] if k >= first else None)
        if args.vararg:
            self.mark(args.vararg.annotation)
            yield f"*{args.vararg.arg}: {ast.unparse(args.vararg.annotation)}"
        elif args.kwonlyargs or args.kwarg:
            yield "*"
        for one, default in zip(args.kwonlyargs, args.kw_defaults):
            yield self.parameter(one, default)

    def parameter(self, one, default):
        self.mark(one.annotation)
        return f"{one.arg}: {ast.unparse(one.annotation)}" + ("" if default is None else f" = {ast.unparse(default)}")

    def mark(self, annotation):
        self.used |= {node.id for node in ast.walk(annotation) if isinstance(node, ast.Name)}

    def type_of(self, row):
        if row["type"] == "choice":
            return "Literal[" + ", ".join(f'"{word}"' for word in row["choices"].split("|")) + "]"
        has_unit = row["unit"] != "-"
        if row["name"] in SIZES:
            self.used.update(("Quantity", "Text"))
            return "Quantity | Text"
        name = {"number": "Quantity" if has_unit else "float", "integer": "int", "flag": "bool", "text": "Text", "texts": "Texts",
                "numbers": "Quantities"}[row["type"]]
        self.used.add(name)
        return name


def defined(tree):
    for one in tree.body:
        if isinstance(one, (ast.ClassDef, ast.FunctionDef)):
            yield one.name
        elif isinstance(one, ast.Assign):
            yield from (target.id for target in one.targets if isinstance(target, ast.Name))


def told(row):
    """What a key is, its unit, range and default."""
    low, high, facts = row["low"], row["high"], []
    if row["choices"]:
        facts.append(row["choices"].replace("|", ", "))
    if row["unit"] not in ("-", "output"):
        facts.append(row["unit"])
    if low is not None and high is not None and low < high:
        facts.append(f"{low:g} to {high:g}" if high < 1e15 else f"at least {low:g}")
    default = row["default"]
    if row["type"] == "integer":
        default = int(default)
    facts.append("no default" if default in ("", None) else f"default {default}" if isinstance(default, str) else f"default {default!r}")
    doc = re.sub(r"(?<!\w)\|(\w+)\|(?!\w)", r"abs(\1)", row["doc"])  # which would be a substitution in the documents
    return f"{doc} ({'; '.join(facts)})".replace('"""', "'''")
