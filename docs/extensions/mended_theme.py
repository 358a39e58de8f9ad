"""What Debian's furo leaves to a web server or to a later release, mended in the built site so that it works from a folder.

- furo.js is a module that imports another (a browser refuses that from file:): the two become one script.
- furo.css imports /javascript/normalize.css/normalize.css: it is copied beside it.
- captions of the side bar have the role of a heading and no level.
- the page of the search has no heading of its own.
- Breathe gives the titles of a header's parts the same few ids, to which nothing leads.
"""
import pathlib
import re

NORMALIZE = pathlib.Path("/usr/share/javascript/normalize.css/normalize.css")


def mend(app, error):
    if error or app.builder.format != "html":
        return
    static = pathlib.Path(app.outdir, "_static")
    script, helper = static / "scripts/furo.js", static / "scripts/gumshoe-patched.js"
    text = script.read_text()
    if text.startswith("import Gumshoe"):
        inside = re.sub(r"^export default ", "const Gumshoe = ", helper.read_text(), flags=re.M)
        script.write_text("(function () {\nvar exports, module, define;  // a section named exports would be taken for one\n" + inside + "\n" + text.split("\n", 1)[1] + "\n})();\n")
    style = static / "styles/furo.css"
    (style.parent / "normalize.css").write_text(NORMALIZE.read_text())
    style.write_text(style.read_text().replace("url(/javascript/normalize.css/normalize.css)", "url(normalize.css)"))
    for page in pathlib.Path(app.outdir).rglob("*.html"):
        text = page.read_text(encoding="utf-8")
        mended = text.replace('class="caption" role="heading">', 'class="caption" role="heading" aria-level="2">')
        mended = mended.replace('<div id="search-results"></div>', '<h1>Search</h1>\n<div id="search-results"></div>')
        mended = re.sub(r' id="breathe-section-title-[a-z-]+"', "", mended)
        if mended != text:
            page.write_text(mended, encoding="utf-8")


def setup(app):
    app.connect("build-finished", mend)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
