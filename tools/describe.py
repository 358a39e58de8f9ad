"""Writes cli/describe.inc from include/clast: what `clast describe --json` says of the library (describe.py OUT)."""
import json
import pathlib
import sys

from headers import Headers

ROOT = pathlib.Path(__file__).resolve().parents[1]


def quoted(text):
    return json.dumps(text.encode("ascii", "replace").decode()).replace("??", "?\\?")


def rows(of, name, lines):
    return [f"static const {of} {name}[] = {{", *(f"    {{{line}}}," for line in lines), "};"]


def main():
    h = Headers(ROOT / "include")
    structs, members, functions, arguments = [], [], [], []
    for name, fields in h.structs.items():
        docs, above = h.member_docs(name), h.doc("(?:typedef )?struct " + name + r" (?=\{)")
        structs.append(f'"{name}", {quoted(above)}, sizeof({name}), {len(members)}, {len(fields)}')
        members += [f'"{d.name}", {quoted(d.text)}, {quoted(docs.get(d.name, ""))}, offsetof({name}, {d.name}), sizeof((({name} *)0)->{d.name})'
                    for d in fields]
    for result, name, given in h.functions:
        above = h.doc(r"CLAST_API[^;{}]*?\b" + name + r"\(")
        functions.append(f'"{name}", {quoted(result)}, {quoted(above)}, {len(arguments)}, {len(given)}')
        arguments += [f'"{a.name}", {quoted(a.text)}' for a in given]
    lines = ["// Written by tools/describe.py from include/clast: do not edit."]
    lines += rows("described_struct", "structs", structs) + rows("described_member", "members", members)
    lines += rows("described_function", "functions", functions) + rows("described_argument", "arguments", arguments)
    lines += rows("described_value", "values", [f'"{of}", "{name}", (int64_t){name}' for of, name in h.enumerators()])
    lines += rows("described_table", "tables", [f'"{name}", {name}' for name in h.tables()])
    pathlib.Path(sys.argv[1]).write_text("\n".join(lines) + "\n")


main()
