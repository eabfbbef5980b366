# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""Sphinx's configuration of the site: docs/site/build.sh."""
import inspect
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
OUT = ROOT / "build" / "site"
sys.path.insert(0, str(ROOT / "bindings" / "python"))

project = "anicodec"
copyright = "The anicodec authors"
release = re.search(r'^version = "(.+)"$', (ROOT / "pyproject.toml").read_text(encoding="utf-8"), re.M)[1]
extensions = ["myst_parser", "breathe", "sphinx.ext.autodoc"]
source_suffix = {".md": "markdown"}
root_doc = "index"
language = "en"
highlight_language = "none"
default_role = "code"
suppress_warnings = ["toc.not_included", "myst.header", "myst.xref_missing", "misc.highlighting_failure"]

myst_heading_anchors = 4
myst_enable_extensions = ["attrs_block", "colon_fence"]

breathe_projects = {"anicodec": str(OUT / "doxygen" / "xml")}
breathe_default_project = "anicodec"
breathe_domain_by_extension = {"h": "c"}

# The package is read without its extension module and without the extras.
autodoc_mock_imports = ["anicodec._anicodec", "panda3d", "pxr", "dask", "trimesh", "pyvista", "meshio"]
autodoc_member_order = "bysource"
autodoc_typehints = "description"
autodoc_typehints_description_target = "documented"
autodoc_default_options = {"members": True}
add_module_names = False
python_use_unqualified_type_names = True

html_theme = "furo"
html_title = f"anicodec {release}"
html_static_path = ["static"]
html_css_files = ["site.css"]
html_js_files = ["gallery.js"]
html_extra_path = [str(OUT / "clips")]
html_copy_source = False
html_show_sphinx = False
html_theme_options = {
    "light_css_variables": {"color-brand-primary": "#b4532a", "color-brand-content": "#9c4522"},
    "dark_css_variables": {"color-brand-primary": "#e58a5c", "color-brand-content": "#e58a5c"},
}

ITEM = re.compile(r"^([A-Za-z_][\w ,()\"'.-]*?): ")


def parameters_of(obj):
    try:
        return list(inspect.signature(obj).parameters)
    except (TypeError, ValueError):
        return []


def mark_parameters(app, what, name, obj, options, lines):
    """A paragraph of "name: text" with deeper lines becomes a list; in others the names of parameters stand out."""
    names = "|".join(map(re.escape, parameters_of(obj)))
    result = []
    for paragraph in "\n".join(lines).split("\n\n"):
        rows = paragraph.splitlines()
        if any(row.startswith(" ") for row in rows[1:]) and ITEM.match(rows[0]):
            for row in rows:
                item = ITEM.match(row)
                result.append(f"- **{item[1]}**: {row[item.end():]}" if item else "  " + row.strip())
        else:
            result += [re.sub(rf"(?<![\w.])({names}): ", r"**\1**: ", row) if names else row for row in rows]
        result.append("")
    lines[:] = result


def setup(app):
    app.connect("autodoc-process-docstring", mark_parameters)
