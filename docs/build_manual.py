"""Build the site of the manual: ``python docs/build_manual.py``, or ``make manual``.

Each language is a site of its own in ``resources/manual``, where F1 and bundles find it. A page,
link, anchor or picture that is not there is an error.
"""

from __future__ import annotations

import shutil
import sys
from pathlib import Path

from sphinx.cmd.build import build_main

from insole_studio.languages import LANGUAGES

DOCS = Path(__file__).resolve().parent
SITE = DOCS.parent / "resources" / "manual"
PAGES_READ = DOCS.parent / "build" / "manual"
STRICT = ("--quiet", "--fail-on-warning", "--keep-going", "--fresh-env")


def main() -> int:
    """Build every language anew; return the exit code."""
    shutil.rmtree(SITE, ignore_errors=True)
    return max(_build(language) for language in LANGUAGES)


def _build(language: str) -> int:
    chosen = ("--define", f"language={language}", "--doctree-dir", str(PAGES_READ / language))
    return build_main([*STRICT, *chosen, str(DOCS), str(SITE / language)])


if __name__ == "__main__":
    sys.exit(main())
