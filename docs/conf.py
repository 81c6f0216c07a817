"""The site of the manual: ``make manual``, or ``sphinx-build -W -D language=sv docs SITE/sv``.

Each language is a site of its own, with its own search, which works from a folder (decision 0025).
"""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

from docutils import nodes

if TYPE_CHECKING:
    from sphinx.application import Sphinx
    from sphinx.config import Config

sys.path.insert(0, str(Path(__file__).parent))

project = "Insole Studio"
extensions = ["myst_parser", "command_reference", "value_reference"]
html_theme = "furo"
html_title = "Insole Studio"
html_show_search_summary = False  # search_excerpts.js shows more, and fetches nothing
html_static_path = ["search_excerpts.js"]
TEXTS_FILE = "search_texts.js"
html_show_sphinx = False
html_show_copyright = False
html_copy_source = False
html_show_sourcelink = False
myst_heading_anchors = 3
nitpicky = True


def _choose_pages(_app: Sphinx, config: Config) -> None:
    """Take the pages of the language; the formats are described in English."""
    folder = "manual" if config.language == "en" else f"manual/{config.language}"
    config.root_doc = f"{folder}/index"
    config.include_patterns = [f"{folder}/*.md", "formats/*.md"]


def _add_excerpts(
    app: Sphinx, pagename: str, _template: str, _context: dict[str, Any], _doctree: object
) -> None:
    """Let the page of the search show excerpts."""
    if pagename == "search":
        app.add_js_file(TEXTS_FILE)
        app.add_js_file("search_excerpts.js")


def _write_texts(app: Sphinx, error: Exception | None) -> None:
    """Write the texts of all pages as a script."""
    if error is not None or app.builder.name != "html":
        return
    texts = {page: _text_of(app.env.get_doctree(page)) for page in sorted(app.env.found_docs)}
    script = f"const SEARCH_TEXTS = {json.dumps(texts, ensure_ascii=False)};\n"
    Path(app.outdir, "_static", TEXTS_FILE).write_text(script, encoding="utf-8")


def _text_of(doctree: nodes.document) -> str:
    """Return the words of a page, as in its index, without its title."""
    kinds = nodes.paragraph, nodes.literal_block, nodes.title, nodes.term
    parts = list(doctree.findall(lambda node: isinstance(node, kinds)))[1:]
    return " ".join(" ".join(part.astext().split()) for part in parts)


def setup(app: Sphinx) -> None:
    """Have the pages chosen once the language is known."""
    app.connect("config-inited", _choose_pages)
    app.connect("html-page-context", _add_excerpts)
    app.connect("build-finished", _write_texts)
