"""The site of the documents: every page of the repository where it stands, the package of Python, the headers (doxygen)."""

import sys
from pathlib import Path

root = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(root / "apps/python"))

project, author, copyright = "Peperite", "the authors of Peperite", "the authors of Peperite"  # noqa: A001  Sphinx's names
root_doc = "cmake/docs/index"
include_patterns = ["*.md", "apps/*.md", "apps/tutorials/*.md", "benchmarks/**.md", "lib*/*.md", "tests/*.md", "cmake/docs/*.md"]
extensions = ["myst_parser", "sphinx.ext.autodoc"]
myst_heading_anchors = 3
myst_enable_extensions = ["colon_fence"]
# Pages begin with the level that suits them where they stand; of TOML and logs Pygments knows no more than we say.
suppress_warnings = ["myst.header"]
autodoc_default_options = {"members": True, "show-inheritance": True}
autodoc_member_order = "bysource"

html_theme = "furo"
html_title = "Peperite"
html_show_sourcelink = False
html_show_copyright = False
