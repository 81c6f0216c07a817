"""Report files in the format of their suffix."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path

from insole_core.evaluation.report import Report, report_json
from insole_core.evaluation.report_html import write_html
from insole_core.evaluation.report_pdf import write_pdf
from insole_core.files.atomic import write_text

__all__ = ["WRITERS", "write_html", "write_json", "write_pdf"]


def write_json(report: Report, path: Path) -> None:
    """Write the numbers of a report.

    Raises
    ------
    OutputError
        If the path cannot be written.
    """
    write_text(json.dumps(report_json(report), indent=1, ensure_ascii=False) + "\n", path)


WRITERS: dict[str, Callable[[Report, Path], None]] = {
    ".html": write_html,
    ".pdf": write_pdf,
    ".json": write_json,
}
"""Writer of a report by the suffix of its file."""
