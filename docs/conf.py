"""Sphinx configuration: Markdown pages, and the C headers through Doxygen and Breathe. Works offline."""
import os
import pathlib
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
sys.path[:0] = [str(ROOT / "docs/extensions"), str(ROOT / "python")]
os.environ.setdefault("CLAST_LIBRARY", str(ROOT / "build/release/libclast_view.so"))  # what `import clast` loads for its docstrings
project = "clast"
author = "the clast maintainers"
copyright = "2026, the clast maintainers"  # noqa: A001 (Sphinx's name)
release = (ROOT / "VERSION").read_text().split()[0]
extensions = ["myst_parser", "breathe", "sphinx_inline_tabs", "sphinx_copybutton", "sphinx.ext.autodoc", "formulas", "mended_theme", "python_keys"]
myst_enable_extensions = ["dollarmath", "amsmath", "colon_fence"]
myst_heading_anchors = 3
html_math_renderer = "katex"  # set when the site is built: docs/extensions/formulas.py
breathe_projects = {"clast": str(ROOT / "build/docs/xml")}
breathe_default_project = "clast"
autodoc_typehints = "signature"
autodoc_member_order = "groupwise"
breathe_domain_by_extension = {"h": "c"}
html_theme = "furo"
html_title = f"clast {release}"
html_css_files = ["site.css"]
html_js_files = ["site.js"]
html_use_index = False  # the search finds what an index of C names would list
html_copy_source = False
html_show_sourcelink = False
html_theme_options = {  # contrast of 4.5 at least, in light and dark
    "light_css_variables": {"color-brand-primary": "#1a5a7a", "color-brand-content": "#1a5a7a", "color-foreground-muted": "#5c6066",
                            "color-foreground-secondary": "#54575c", "color-highlight-on-target": "#fff6cc"},
    "dark_css_variables": {"color-brand-primary": "#7cc4ea", "color-brand-content": "#7cc4ea", "color-foreground-muted": "#9aa0a6",
                           "color-foreground-secondary": "#a4a9b0",
                           # Debian's furo.css has these only for a chosen dark, not for the reader's system
                           "color-problematic": "#ff8a80", "color-foreground-primary": "#e4e6ea", "color-foreground-border": "#7d828a",
                           "color-background-primary": "#131416", "color-background-secondary": "#1a1c1e", "color-background-hover": "#1e2124",
                           "color-background-hover--transparent": "#1e212400", "color-background-border": "#303335",
                           "color-background-item": "#444", "color-announcement-background": "#000000dd", "color-announcement-text": "#eeebee",
                           "color-admonition-background": "#18181a", "color-card-border": "#1a1c1e", "color-card-background": "#18181a",
                           "color-card-marginals-background": "#1e2124", "color-inline-code-background": "#1a1c1e",
                           "color-highlighted-background": "#083563", "color-guilabel-background": "#08356380", "color-guilabel-border": "#13395f80",
                           "color-api-keyword": "#9ca0a5", "color-api-background": "#1a1c1e", "color-highlight-on-target": "#333300"},
}
pygments_style = "default"
pygments_dark_style = "github-dark"
html_static_path = ["static"]
exclude_patterns = ["_build", "reference/verdicts.md"]
suppress_warnings = ["myst.header"]
