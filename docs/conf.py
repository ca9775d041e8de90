"""Sphinx: the site of these Markdown pages, in build/docs (make docs)."""

import sys
from importlib.metadata import version as installed
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent / "_site"))

project = "Trunnion"
author = "Trunnion developers"
release = version = installed("trunnion")

extensions = [
    "myst_parser",
    "sphinx.ext.autodoc",
    # of _site
    "decklexer",
    "docstrings",
    "mathml",
    "navigation",
]
exclude_patterns = ["_site"]

myst_enable_extensions = ["dollarmath"]
myst_heading_anchors = 3
# ```deck and ```python >>> are plain names on a forge, too
highlight_language = "none"
suppress_warnings = ["config.cache"]

autodoc_member_order = "bysource"
autodoc_typehints = "signature"
python_use_unqualified_type_names = True
python_maximum_signature_line_length = 88

html_theme = "furo"
html_title = f"Trunnion {release}"
html_static_path = ["_site/site.css"]
html_css_files = ["site.css"]
html_math_renderer = "mathml"
html_show_search_summary = False  # it would ask a server for the pages, and there is none
html_copy_source = False
html_show_copyright = False
html_theme_options = {
    "navigation_with_keys": True,
    "light_css_variables": {"color-brand-primary": "#1d4f73", "color-brand-content": "#1d5f91"},
    "dark_css_variables": {"color-brand-primary": "#8cc0e6", "color-brand-content": "#8cc0e6"},
}
