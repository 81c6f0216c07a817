"""A comparison as PDF: difference maps, statistics, and table 3 of both surfaces."""

from __future__ import annotations

import io
from datetime import UTC, datetime
from pathlib import Path

import numpy as np

from insole_core.compare.comparison_report import draw_picture
from insole_core.compare.difference import ComparedMeasure, Difference, foot_rows, part_rows
from insole_core.export import paper

_FIGURES = {
    "mean_abs": "mean of the absolute difference",
    "median_abs": "median",
    "p95": "95 % are below",
    "max": "largest",
    "signed_mean": "mean of first minus second",
}


def write_report(difference: Difference, names: tuple[str, str], path: Path) -> None:
    """Write a comparison as PDF.

    Parameters
    ----------
    names
        Of the first and the second surface.

    Raises
    ------
    OutputError
        If the path cannot be written.
    """
    picture = io.BytesIO()
    draw_picture(difference, picture, names)
    statistics = difference.statistics
    figures = {text: f"{statistics[key]:.2f} mm" for key, text in _FIGURES.items()}
    figures["compared area"] = f"{statistics['compared_area_mm2'] / 100:.0f} cm²"
    what = {
        "first": names[0],
        "second": names[1],
        "laid on the first": _fit_text(difference),
        "date": datetime.now(UTC).date().isoformat(),
    }
    sections = [("What", what), ("Difference", figures)]
    for title, rows in (("Feet", foot_rows(difference)), ("Compared part", part_rows(difference))):
        if rows:
            sections.append((title, {r.key.replace("_", " "): _both(r) for r in rows}))
    paper.write_report("Comparison of two surfaces", sections, picture.getvalue(), path)


def _fit_text(difference: Difference) -> str:
    residual = difference.fit.residual_mm
    how = "as both lie" if np.isnan(residual) else f"with a residual of {residual:.2f} mm"
    return f"mirrored, {how}" if difference.b_is_mirrored else how


def _both(row: ComparedMeasure) -> str:
    first, second = ("–" if value is None else f"{value:.1f} mm" for value in (row.a, row.b))
    return f"{first} and {second}"
