"""Sphinx configuration: Markdown pages, and the C headers through Doxygen and Breathe. Works offline."""
import pathlib
import re

ROOT = pathlib.Path(__file__).resolve().parent.parent
project = "clast"
author = "the clast maintainers"
copyright = "2026, the clast maintainers"  # noqa: A001 (Sphinx's name)
release = re.search(r"VERSION (\d+\.\d+\.\d+)", (ROOT / "CMakeLists.txt").read_text()).group(1)
extensions = ["myst_parser", "breathe", "sphinx.ext.mathjax"]
myst_enable_extensions = ["dollarmath", "amsmath", "colon_fence"]
myst_heading_anchors = 3
mathjax_path = "formulas.js"  # formulas stay readable as TeX without a network
breathe_projects = {"clast": str(ROOT / "build/docs/xml")}
breathe_default_project = "clast"
breathe_domain_by_extension = {"h": "c"}
html_theme = "alabaster"
html_theme_options = {"description": "particles that stick, settle and cluster", "page_width": "1100px"}
html_static_path = ["static"]
exclude_patterns = ["_build"]
suppress_warnings = ["myst.header"]
