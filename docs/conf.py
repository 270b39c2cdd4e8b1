"""Configuration of the documentation (Sphinx)."""

import sys
from pathlib import Path

HERE = Path(__file__).parent
sys.path.insert(0, str(HERE / "_extensions"))
# the pages describe the functions themselves, not what compiles them
import stommel.compilation  # noqa: E402

stommel.compilation.compiled = stommel.compilation.inlined = lambda function: function

project = "stommel"
author = "the stommel authors"
project_copyright = "the stommel authors, Apache-2.0"

extensions = [
    "myst_parser", "sphinx.ext.autodoc", "sphinx.ext.napoleon", "mathml", "generated_pages", "titles_in_navigation",
    "sources_read_once",
]  # fmt: skip
myst_enable_extensions = ["dollarmath", "deflist", "colon_fence"]
myst_dmath_double_inline = True
myst_heading_anchors = 3
exclude_patterns = ["_generated/*.md", "_static/**"]
default_role = "code"
smartquotes = False  # they would turn --option into a dash

autodoc_member_order = "bysource"
autodoc_typehints = "none"
autodoc_preserve_defaults = True
maximum_signature_line_length = 100
toc_object_entries_show_parents = "hide"
autodoc_default_options = {"members": True, "exclude-members": "model_config"}
add_module_names = False
napoleon_google_docstring = False
napoleon_use_rtype = False

html_theme = "furo"
html_title = "stommel"
html_math_renderer = "mathml"
html_static_path = ["_static"]
html_css_files = ["stommel.css"]
html_copy_source = False
html_show_sphinx = False
