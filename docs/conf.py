"""The site of the manual: ``make manual``, or ``sphinx-build -W -D language=sv docs SITE/sv``.

Each language is a site of its own, with its own search, which works from a folder (decision 0062).
"""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from sphinx.application import Sphinx
    from sphinx.config import Config

sys.path.insert(0, str(Path(__file__).parent))

project = "Insole Studio"
extensions = ["myst_parser", "command_reference"]
html_theme = "furo"
html_title = "Insole Studio"
html_show_search_summary = False  # which would be fetched; a browser fetches nothing from a disk
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


def setup(app: Sphinx) -> None:
    """Have the pages chosen once the language is known."""
    app.connect("config-inited", _choose_pages)
