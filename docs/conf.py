"""How Sphinx makes the site: `sphinx-build -W docs build/site`."""

from __future__ import annotations

import inspect
import sys
from pathlib import Path

import engine3d

sys.path.insert(0, str(Path(__file__).resolve().parent))
from frame_scraper import FrameScraper
from make_map import page as map_page
from reference_code import with_code

project = "engine3d"
author = "engine3d authors"
copyright = "2026, engine3d authors"
release = version = engine3d.__version__
language = "en"

extensions = [
    "myst_parser",
    "sphinx.ext.autodoc",
    "sphinx.ext.autosummary",
    "sphinx.ext.viewcode",
    "numpydoc",
    "sphinx_gallery.gen_gallery",
]
root_doc = "index"
source_suffix = {".md": "markdown", ".rst": "restructuredtext"}
exclude_patterns = ["examples", "course/README_*"]

# Links between pages name headings as they do where the files are read as they are.
myst_heading_anchors = 4

# The API: signatures without types, which are in the docstrings and the stubs.
autodoc_typehints = "none"
autodoc_member_order = "bysource"
autosummary_generate = False
numpydoc_show_class_members = False
numpydoc_attributes_as_param_list = True

sphinx_gallery_conf = {
    "examples_dirs": "examples",
    "gallery_dirs": "generated/examples",
    "filename_pattern": "plot_",
    "image_scrapers": (FrameScraper(),),
    "show_memory": False,
    "min_reported_time": 60,
    "write_computation_times": False,
    "capture_repr": (),
    "reset_modules": (),
    "within_subsection_order": "FileNameSortKey",
    "nested_sections": False,
}

# The list of all files is made here, from their first sentences.
_map = Path(__file__).resolve().parent / "generated" / "map.md"
_map.parent.mkdir(exist_ok=True)
_map.write_text(map_page(), "utf-8")

html_theme = "pydata_sphinx_theme"
html_title = f"engine3d {version}"
html_logo = html_favicon = "site/logo.svg"
html_static_path = ["site"]
html_css_files = ["site.css"]
# The text of a page, and beside each name of the API the code that it stands for.
html_show_sourcelink = True
html_theme_options = {
    "logo": {"text": f"engine3d {version}", "alt_text": "engine3d"},
    "show_toc_level": 2,
    "navigation_depth": 2,
    "navbar_end": ["theme-switcher"],
    "footer_start": ["copyright"],
    "footer_end": ["sphinx-version"],
    "secondary_sidebar_items": ["page-toc", "sourcelink"],
}
# Pages without a section of their own have no list of pages beside them.
html_sidebars = {page: [] for page in ("index", "start", "gallery", "search", "genindex")}

#: Classes that a user never makes. Their entries show no parameters.
MADE_BY_OTHERS = ("Node", "NodeSelection", "Frame", "RasterizeResult", "World")


def signature_as_called(app, what, name, thing, options, signature, returned):
    """Show the parameters of a class as its caller gives them, whatever made the class callable."""
    if what != "class" or issubclass(thing, (Exception, Warning)):
        return None
    if name.rpartition(".")[2] in MADE_BY_OTHERS:
        return "", ""
    parameters = inspect.signature(thing).parameters.values()
    plain = [parameter.replace(annotation=inspect.Parameter.empty) for parameter in parameters]
    return str(inspect.Signature(plain)), returned


def show_code_of_rules(app, docname, source):
    """Put the reference's code beside the rules of exactness."""
    if docname.startswith("exactness/"):
        source[0] = with_code(source[0])


def setup(app):
    app.connect("source-read", show_code_of_rules)
    app.connect("autodoc-process-signature", signature_as_called)
