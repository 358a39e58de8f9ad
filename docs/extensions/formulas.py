"""Formulas set by KaTeX when the site is built: no script in the page, nothing fetched; a formula that KaTeX refuses is a warning.

One node process per worker sets them all, a line of JSON each way; equal formulas are set once. Debian's katex (libjs-katex) gives
the setter, its style sheet and the fonts that are copied into the site (woff2 only).
"""
import functools
import json
import pathlib
import re
import shutil
import subprocess

from sphinx.util import logging

KATEX = pathlib.Path("/usr/share/javascript/katex")
SETTER = r"""
const katex = require("/usr/share/javascript/katex/katex.js");
require("readline").createInterface({input: process.stdin}).on("line", line => {
    const asked = JSON.parse(line);
    let answer;
    try { answer = {html: katex.renderToString(asked.tex, {displayMode: asked.display, output: "htmlAndMathml", throwOnError: true, strict: "ignore"})}; }
    catch (error) { answer = {error: String(error.message)}; }
    process.stdout.write(JSON.stringify(answer) + "\n");
});
"""
logger = logging.getLogger(__name__)


@functools.lru_cache(maxsize=1)
def setter():
    return subprocess.Popen(["node", "-e", SETTER], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)


@functools.lru_cache(maxsize=None)
def set_formula(tex, display):
    process = setter()
    process.stdin.write(json.dumps({"tex": tex, "display": display}) + "\n")
    process.stdin.flush()
    answer = json.loads(process.stdout.readline())
    if "error" in answer:
        raise ValueError(answer["error"])
    return re.sub(r'<annotation encoding="application/x-tex">.*?</annotation>', "", answer["html"], flags=re.S)


def formula(translator, node, tex, display):
    try:
        return set_formula(tex.strip(), display)
    except ValueError as fault:
        logger.warning("formula: %s: %s", fault, tex, location=node)
        return translator.encode(tex)


def visit_inline(translator, node):
    from docutils import nodes
    tex = node.astext()
    if r"\tag" in tex:  # a numbered formula inside a paragraph of a list
        translator.body.append(f'<span class="formula inside" role="math">{formula(translator, node, tex, True)}</span>')
    else:
        translator.body.append(formula(translator, node, tex, False))
    raise nodes.SkipNode


def visit_block(translator, node):
    from docutils import nodes
    identity = f' id="{node["ids"][0]}"' if node.get("ids") else ""
    translator.body.append(f'<div class="formula" role="math"{identity}>{formula(translator, node, node.astext(), True)}</div>\n')
    raise nodes.SkipNode


def copy_style(app, error):
    if error or app.builder.format != "html":
        return
    to = pathlib.Path(app.outdir, "_static", "katex")
    (to / "fonts").mkdir(parents=True, exist_ok=True)
    style = (KATEX / "katex.min.css").read_text()
    style = re.sub(r",url\(fonts/[^)]*\.(?:woff|ttf)\) format\(\"[a-z]+\"\)", "", style)
    (to / "katex.css").write_text(style)
    for font in (KATEX / "fonts").glob("*.woff2"):
        shutil.copyfile(font, to / "fonts" / font.name)


def setup(app):
    app.add_html_math_renderer("katex", (visit_inline, None), (visit_block, None))
    app.add_css_file("katex/katex.css")
    app.connect("build-finished", copy_style)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
