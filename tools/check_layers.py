#!/usr/bin/env python3
"""Fails when an include or a call of a public function points up, or sideways into another folder of the same layer
(STYLE section 1), or from the core into the view (docs/adr/0010-two-libraries.md), or when the view calls a function of the
core that is not marked CLX_SHARED, or a mark has no call. A public header declares functions of several layers; who calls
them is what counts.

It also fails when headers include each other in a circle, or when more than two files call each other in one.

Only io, plot, render, base/file.c and base/lock.c may open files. Only base/number*.c may read or print a double by the C
library, which obeys the host's locale.

Fewer than LEAST_ASSERTS invariants (CLAST_ASSERT) in 1000 lines of src fail too, and more than MOST_BEHIND headers of ours behind a
median .c: include what a file uses, and in a header only what it needs complete (a pointer needs the name alone).
"""
import pathlib
import re
import statistics
import sys

LAYER = {"base": 0, "math": 1, "geom": 2, "shape": 3, "convex": 3, "touch": 3, "cloud": 3, "assembly": 4, "aggregate": 5,
         "dem": 5, "porosity": 5, "pack": 6, "evolve": 6, "io": 7, "plot": 7, "render": 7, "mpi": 7, "run": 8,
         "report": 9, "study": 10}
VIEW = {"plot", "render", "report", "study"}  # libclast_view; what is not here is libclast (CMakeLists.txt has the same list)
OPENERS = re.compile(r"\b(fopen|open|fdopen|creat|H5Fopen|H5Fcreate)\s*\(")
READERS = re.compile(r"\b(strto(?:d|f|ld)|atof|v?[fs]?scanf)\s*\(")
PRINTERS = re.compile(r"\b(?:vs|s|f|vf)n?printf\s*\((?:[^;\"]|\"(?:[^\"\\]|\\.)*\")*?;", re.S)
DOUBLE = re.compile(r"%[-+ #0]*[\d*]*(?:\.[\d*]*)?l?[efgaEFGA]")
INVARIANT = re.compile(r"(?<!define )\bCLAST_ASSERT\(")
LEAST_ASSERTS = 5  # in 1000 lines of src
MOST_BEHIND = 10
BARE_VERB = re.compile(r"^(?:static |inline |CLX_\w+ )+[\w \*]*?\b(take|keep|give|put|make|add|measure|set)\(", re.M)
ROOT = pathlib.Path(__file__).resolve().parent.parent


def strip_comments(text):
    return re.sub(r"//[^\n]*|/\*.*?\*/", "", text, flags=re.S)


def definers():
    """Public function -> folder that defines it."""
    defined = {}
    for path in ROOT.glob("src/*/*.c"):
        for name in re.findall(r"^[a-z_][\w \*]*?\b(clast_\w+)\(", strip_comments(path.read_text()), flags=re.M):
            defined.setdefault(name, path.parent.name)
    return defined


def circles(graph):
    """Strongly connected parts of more than one node, each sorted: Tarjan's algorithm."""
    order, low, stack, found = {}, {}, [], []

    def visit(node):
        order[node] = low[node] = len(order)
        stack.append(node)
        for other in sorted(graph[node]):
            if other not in order:
                visit(other)
            if other in stack:
                low[node] = min(low[node], low[other])
        if low[node] == order[node]:
            part = stack[stack.index(node):]
            del stack[stack.index(node):]
            if len(part) > 1:
                found.append(sorted(part))

    for node in sorted(graph):
        if node not in order:
            visit(node)
    return found


def include_graph():
    """File of src or public header -> the files that it includes."""
    graph = {}
    for path in [*ROOT.glob("src/*/*.[ch]"), *ROOT.glob("include/clast/*.h")]:
        names = re.findall(r'#include\s+[<"]([^>"]+)[>"]', strip_comments(path.read_text()))
        graph[str(path.relative_to(ROOT))] = {
            ("include/" if n.startswith("clast/") else "src/") + n for n in names if "/" in n}
    return {name: targets & set(graph) for name, targets in graph.items()}


def call_graph():
    """Source -> the sources that define a function, or a table of functions, that it names."""
    words, owner = {}, {}
    defined = r"^(?!static|typedef|extern)[a-z_][\w \*]*?\b(\w+)\([^;]*?\)\n\{"
    table = r"^(?!extern)const clx_\w+ (clx_\w+)(?:\[\])? = "
    for path in sorted(ROOT.glob("src/*/*.c")):
        text = strip_comments(path.read_text())
        name = str(path.relative_to(ROOT))
        words[name] = set(re.findall(r"\b(?:clx|clast|touch|xml)_\w+", text))
        for function in re.findall(defined, text, flags=re.M) + re.findall(table, text, flags=re.M):
            owner.setdefault(function, name)
    return {name: {owner[w] for w in used if w in owner} - {name} for name, used in words.items()}


def header_problems():
    graph, counts = include_graph(), []
    for source in (name for name in graph if name.endswith(".c")):
        seen, left = set(), [source]
        while left:
            new = graph[left.pop()] - seen
            seen |= new
            left += new
        counts.append(len(seen))
    median = statistics.median(counts)
    if median > MOST_BEHIND:
        yield f"src: {median:g} headers behind a median .c (at most {MOST_BEHIND}), {max(counts)} behind the worst"


def circle_problems():
    for circle in circles(include_graph()):
        yield f"headers include each other in a circle: {', '.join(circle)}"
    for circle in circles(call_graph()):
        if len(circle) > 2:
            yield f"{len(circle)} files call each other in a circle: {', '.join(circle)}"


def shared():
    """clx_ function that the core shares with the view -> header that says so."""
    return {name: path for path in ROOT.glob("src/*/*.h")
            for name in re.findall(r"^CLX_SHARED [\w \*]*?\b(clx_\w+)\(", path.read_text(), flags=re.M)}


def uses(text, macros):
    """clx_ names in a text, those of the macros it uses too."""
    found = set(re.findall(r"\bclx_\w+\b", text))
    found |= {f"clx_{noun}_fault" for noun in re.findall(r"\bCLX_WHOLE\((\w+)", text)}
    for macro, body in macros.items():
        if re.search(rf"\b{macro}\b", text):
            found |= uses(body, {})
    return found


def view_problems():
    marked, core, called, macros = shared(), {}, set(), {}
    for path in ROOT.glob("src/*/*.h"):
        if path.parent.name not in VIEW:
            macros.update(re.findall(r"^#define (CLX_\w+)((?:.*\\\n)*.*)", path.read_text(), flags=re.M))
            for name in re.findall(r"^(?:extern |CLX_SHARED )?(?!static|CLX_INLINE|typedef)[a-z][\w \*]*?\b(clx_\w+)[\[\(]",
                                   strip_comments(path.read_text()), flags=re.M):
                core[name] = path
    for path in sorted(ROOT.glob("src/*/*.[ch]")):
        if path.parent.name in VIEW:
            used = uses(strip_comments(path.read_text()), macros) & core.keys()
            called |= used
            for name in sorted(used - marked.keys()):
                yield f"{path.relative_to(ROOT)}: the view uses {name}, which {core[name].relative_to(ROOT)} does not mark CLX_SHARED"
    for name in sorted(marked.keys() - called):
        yield f"{marked[name].relative_to(ROOT)}: {name} is marked CLX_SHARED, and the view does not call it"


def assert_problems():
    texts = [path.read_text() for path in ROOT.glob("src/*/*.[ch]")]
    n_line = sum(text.count("\n") for text in texts)
    n_assert = sum(len(INVARIANT.findall(strip_comments(text))) for text in texts)
    if 1000 * n_assert < LEAST_ASSERTS * n_line:
        yield (f"src: {n_assert} invariants in {n_line} lines are {1000 * n_assert / n_line:.1f} in 1000; "
               f"state them by CLAST_ASSERT, {LEAST_ASSERTS} in 1000 at least")


def bare_verb_problems():
    """A function's name must be found by grep: a verb with its noun."""
    for path in sorted([*ROOT.glob("src/**/*.[ch]"), *ROOT.glob("cli/*.[ch]")]):
        for m in BARE_VERB.finditer(path.read_text()):
            yield f"{path.relative_to(ROOT)}: function {m.group(1)}(): say what, as in append_contact()"


def problems():
    yield from circle_problems()
    yield from header_problems()
    yield from view_problems()
    yield from assert_problems()
    yield from bare_verb_problems()
    defined = definers()
    for path in sorted(ROOT.glob("src/*/*.[ch]")):
        folder = path.parent.name
        if folder not in LAYER:
            yield f"{path.relative_to(ROOT)}: folder {folder} has no layer"
            continue
        text = strip_comments(path.read_text())
        for name in re.findall(r'#include\s+[<"]([^>"]+)[>"]', text):
            target = name.split("/")[0]
            if name == "mpi.h" and folder != "mpi":
                yield f"{path.relative_to(ROOT)}: includes <mpi.h>; only src/mpi does"
            if target not in LAYER or target == folder:
                continue
            if target in VIEW and folder not in VIEW:
                yield f"{path.relative_to(ROOT)}: includes {name}: the core knows nothing of the view"
            if LAYER[target] >= LAYER[folder]:
                yield (f"{path.relative_to(ROOT)}: includes {name} ({target}, layer {LAYER[target]}) "
                       f"from {folder}, layer {LAYER[folder]}")
        for name in sorted(set(re.findall(r"\b(clast_\w+)\s*\(", text)) & defined.keys()):
            target = defined[name]
            if target in VIEW and folder not in VIEW:
                yield f"{path.relative_to(ROOT)}: calls {name} ({target}): the core knows nothing of the view"
            if target != folder and LAYER[target] >= LAYER[folder]:
                yield f"{path.relative_to(ROOT)}: calls {name} ({target}, layer {LAYER[target]}) from layer {LAYER[folder]}"
        opens = OPENERS.search(text)
        if opens and LAYER[folder] < 7 and path.name not in ("file.c", "lock.c"):
            yield (f"{path.relative_to(ROOT)}: opens files ({opens.group(1)}); only io, plot, render, base/file.c "
                   "and base/lock.c do")
        if not path.name.startswith("number"):
            calls = [m.group(0) for m in PRINTERS.finditer(text)]
            calls = READERS.findall(text) + [c for c in calls if DOUBLE.search(c) or c.startswith("v")]
            for call in calls:
                yield f"{path.relative_to(ROOT)}: {' '.join(call.split())[:60]} obeys the locale: take base/number.h"
    for path in sorted(ROOT.glob("cli/*.[ch]")):
        for name in re.findall(r'#include\s+"([^"]+)"', path.read_text()):
            if "/" in name:
                yield f"{path.relative_to(ROOT)}: includes {name}; the command uses public headers only"


def main():
    found = list(problems())
    for line in found:
        print(line)
    print(f"layers: {len(found)} broken")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
