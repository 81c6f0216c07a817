"""Values shown by the compare panel."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass

from insole_core.compare.difference import ComparedMeasure, Difference, foot_rows, part_rows
from insole_core.foot.spread import Spread, explained, spread_text
from insole_studio.texts import fill, localised, tr, translate_core_message

FILE, FOLDER = "file", "folder"
"""Keys of the choices that ask for a path."""
SURFACES, RESULT, MAPS = range(3)
"""Numbers of the tabs."""


@dataclass(frozen=True)
class FigureRow:
    """A row of the table: label, first and second number; a heading has no numbers.

    What is quiet stands in grey.
    """

    text: str
    first: str = ""
    second: str = ""
    is_quiet: bool = False


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
        (tr("Feet (mm)"), foot_rows(difference)),
        (tr("Compared part"), part_rows(difference)),
    ):
        if measures:
            rows.append(FigureRow(heading, "A", "B"))
            rows += [row for measure in measures for row in _measure_rows(measure)]
            spreads = [s for m in measures for s in (m.a_spread, m.b_spread) if s is not None]
            rows += [
                FigureRow(translate_core_message(line), is_quiet=True)
                for line in explained(spreads)
            ]
    return tuple(rows)


def _measure_rows(measure: ComparedMeasure) -> Iterator[FigureRow]:
    """Yield a row of a measure, and one of a difference that says nothing."""
    first = _mm(measure.key, measure.a, measure.a_spread)
    second = _mm(measure.key, measure.b, measure.b_spread)
    yield FigureRow(MEASURES[measure.key](), first, second)
    if measure.is_within_error and measure.a is not None and measure.b is not None:
        apart = localised(measure.a - measure.b, "+z.1f")
        yield FigureRow(fill(tr("A − B {apart} mm: within the error"), apart=apart), is_quiet=True)


def _mm(key: str, value: float | None, spread: Spread | None) -> str:
    if value is None:
        return "–"
    if spread is None:
        return f"{localised(value)} mm"
    return f"{localised(value)} {translate_core_message(spread_text(key, spread.limits_95))}"
