"""Values shown by the compare panel."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from insole_core.compare.difference import Difference, foot_rows, part_rows
from insole_studio.texts import localised, tr

FILE, FOLDER = "file", "folder"
"""Keys of the choices that ask for a path."""


@dataclass(frozen=True)
class FigureRow:
    """A row of the table: label, first and second number; a heading has no numbers."""

    text: str
    first: str = ""
    second: str = ""


@dataclass(frozen=True)
class CompareButtons:
    """Which controls are enabled."""

    save: bool = False
    cancel: bool = False
    take_back: bool = False


STATISTICS: dict[str, Callable[[], str]] = {
    "mean_abs": lambda: tr("Mean"),
    "p95": lambda: tr("95 % are below"),
    "max": lambda: tr("Largest"),
    "signed_mean": lambda: tr("Mean, signed"),
}
MEASURES: dict[str, Callable[[], str]] = {
    "foot_length": lambda: tr("Foot length"),
    "ball_width": lambda: tr("Ball width"),
    "length": lambda: tr("Length"),
    "heel_width": lambda: tr("Heel width"),
    "forefoot_width": lambda: tr("Forefoot width"),
    "arch_height": lambda: tr("Arch height"),
}


def figure_rows(difference: Difference) -> tuple[FigureRow, ...]:
    """Return the rows of the table: statistics of the difference, then measures of both surfaces.

    Parameters
    ----------
    difference
        The computed difference.
    """
    statistics = difference.statistics
    fit = difference.fit.residual_mm
    rows = [FigureRow(tr("Difference"))]
    rows += [
        FigureRow(text(), f"{localised(statistics[key], '.2f')} mm")
        for key, text in STATISTICS.items()
    ]
    area = localised(statistics["compared_area_mm2"] / 100, ".0f")
    rows.append(FigureRow(tr("Compared area"), f"{area} cm²"))
    if fit == fit:  # noqa: PLR0124 - not NaN: a transform was fitted
        rows.append(FigureRow(tr("Residual of the fit"), f"{localised(fit, '.2f')} mm"))
    for heading, measures in (
        (tr("Feet"), foot_rows(difference)),
        (tr("Compared part"), part_rows(difference)),
    ):
        if measures:
            rows.append(FigureRow(heading, "A", "B"))
            rows += [FigureRow(MEASURES[m.key](), _mm(m.a), _mm(m.b)) for m in measures]
    return tuple(rows)


def _mm(value: float | None) -> str:
    return "–" if value is None else f"{localised(value)} mm"
