"""A comparison as PDF: difference maps, statistics, and table 3 of both surfaces."""

from __future__ import annotations

import io
from datetime import UTC, datetime
from pathlib import Path

import numpy as np

from insole_core.compare.comparison_report import draw_picture
from insole_core.compare.difference import ComparedMeasure, Difference, foot_rows, part_rows
from insole_core.export import paper
from insole_core.messages import Message, Translate

_FIGURES = {
    "mean_abs": Message("mean of the absolute difference"),
    "median_abs": Message("median"),
    "p95": Message("95 % are below"),
    "max": Message("largest"),
    "signed_mean": Message("mean of first minus second"),
}
_MEASURES = {
    "foot_length": Message("foot length"),
    "length": Message("length"),
    "ball_width": Message("ball width"),
    "heel_width": Message("heel width"),
    "forefoot_width": Message("forefoot width"),
    "arch_height": Message("arch height"),
}
_MM = "{value:.2f} mm"


def write_report(
    difference: Difference, names: tuple[str, str], path: Path, translate: Translate = str
) -> None:
    """Write a comparison as PDF.

    Parameters
    ----------
    names
        Of the first and the second surface.
    translate
        Into the language of the paper.

    Raises
    ------
    OutputError
        If the path cannot be written.
    """
    picture = io.BytesIO()
    draw_picture(difference, picture, names, translate)
    statistics = difference.statistics
    area = Message("{value:.0f} cm²", value=statistics["compared_area_mm2"] / 100)
    figures: dict[str, str] = {
        text: Message(_MM, value=statistics[key]) for key, text in _FIGURES.items()
    }
    figures[Message("compared area")] = area
    what: dict[str, str] = {
        Message("first"): names[0],
        Message("second"): names[1],
        Message("laid on the first"): _fit_text(difference),
        Message("date"): datetime.now(UTC).date().isoformat(),
    }
    sections: list[tuple[str, dict[str, str]]] = [
        (Message("What"), what),
        (Message("Difference"), figures),
    ]
    for title, rows in (
        (Message("Feet"), foot_rows(difference)),
        (Message("Compared part"), part_rows(difference)),
    ):
        if rows:
            sections.append((title, {_MEASURES[row.key]: _both(row) for row in rows}))
    said = [
        (translate(title), {translate(key): translate(text) for key, text in facts.items()})
        for title, facts in sections
    ]
    heading = translate(Message("Comparison of two surfaces"))
    paper.write_report(heading, said, picture.getvalue(), path)


def _fit_text(difference: Difference) -> str:
    residual = difference.fit.residual_mm
    how = Message("as both lie")
    if not np.isnan(residual):
        how = Message("with a residual of {residual:.2f} mm", residual=residual)
    return Message("mirrored, {how}", how=how) if difference.b_is_mirrored else how


def _both(row: ComparedMeasure) -> str:
    first, second = (
        "–" if value is None else Message("{value:.1f} mm", value=value) for value in (row.a, row.b)
    )
    return Message("{first} and {second}", first=first, second=second)
