"""The report on a repeat test: a table, the picture of Bland and Altman, and a map of the sole."""

from __future__ import annotations

from functools import partial
from itertools import combinations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from insole_core.evaluation.repeat import Repeated, RepeatEvaluation
from insole_core.evaluation.report import Number, Plot, ReportSection, Table
from insole_core.foot.measures import DEFINITIONS

_UNITS = {"mm": "mm", "degrees": "°", "": ""}
_MOST_MAP_MM = 1.0
"""End of the colours of the map, unless more of the sole scatters more."""
_COLUMNS = 4


def repeat_section(evaluation: RepeatEvaluation) -> ReportSection:
    """Report a repeat test; each measure has its standard deviation and its ± as numbers."""
    known = evaluation.deviation_mm[np.isfinite(evaluation.deviation_mm)]
    names = ", ".join(capture.name for capture in evaluation.captures)
    return ReportSection(
        key="repeat",
        title="Repeat test of the measuring place",
        sentences=(
            f"{len(evaluation.captures)} captures of one foot, taken off and put back: {names}.",
            "± is half of the 95 % limits of one further capture (Student's t for the captures "
            "times their standard deviation). What all captures have in common does not show in "
            "it: prove the whole chain for that.",
        ),
        numbers=(
            *(
                number
                for name, one in evaluation.measures.items()
                for number in _numbers(name, one)
            ),
            Number("sole_median_mm", "Scatter of the sole, median", float(np.median(known)), "mm"),
            Number(
                "sole_p95_mm",
                "Scatter of the sole, 95 % are below",
                float(np.percentile(known, 95)),
                "mm",
            ),
        ),
        tables=(_table(evaluation),),
        plots=(
            Plot("Bland–Altman: differences of two captures", partial(_draw_pairs, evaluation)),
            Plot("Standard deviation at each place of the sole", partial(_draw_map, evaluation)),
        ),
    )


def number_keys() -> tuple[str, ...]:
    """Return the keys of the numbers that the report has of a foot all of whose measures are."""
    of_measures = [key for name in DEFINITIONS for key in (f"sd_{name}", f"limits_95_{name}")]
    return (*of_measures, "sole_median_mm", "sole_p95_mm")


def _numbers(name: str, one: Repeated) -> tuple[Number, Number]:
    unit = _UNITS[DEFINITIONS[name].unit]
    return (
        Number(f"sd_{name}", f"{_said(name)}, SD", one.deviation, unit),
        Number(f"limits_95_{name}", f"{_said(name)}, ±", one.limits_95, unit),
    )


def _table(evaluation: RepeatEvaluation) -> Table:
    rows = tuple(
        (
            _said(name),
            DEFINITIONS[name].unit,
            f"{evaluation.values(name).mean():.2f}",
            f"{one.deviation:.2f}",
            f"{one.limits_95:.2f}",
            f"{np.sqrt(2) * one.limits_95:.2f}",
            str(one.captures),
        )
        for name, one in evaluation.measures.items()
    )
    headings = ("measure", "unit", "mean", "SD", "±", "± of a difference", "captures")
    return Table("Repeatability", headings, rows)


def _draw_pairs(evaluation: RepeatEvaluation, figure: Figure) -> None:
    """Draw the difference of each pair of captures over their mean, with the limits."""
    names = list(evaluation.measures)
    rows = -(-len(names) // _COLUMNS)
    axes = np.ravel(figure.subplots(rows, _COLUMNS, squeeze=False))
    for place, name in zip(axes, names, strict=False):
        _draw_measure(place, name, evaluation)
    for empty in axes[len(names) :]:
        empty.set_axis_off()
    figure.supxlabel("mean of two captures", fontsize=9)
    figure.supylabel("their difference; dashed: ± of a difference", fontsize=9)


def _draw_measure(axes: Axes, name: str, evaluation: RepeatEvaluation) -> None:
    pairs = np.array(list(combinations(evaluation.values(name), 2)))
    axes.plot(pairs.mean(axis=1), pairs[:, 1] - pairs[:, 0], "o", markersize=3)
    limit = np.sqrt(2) * evaluation.measures[name].limits_95
    for height, style in ((-limit, "--"), (0.0, "-"), (limit, "--")):
        axes.axhline(height, color="0.5", linewidth=0.8, linestyle=style)
    axes.set_title(_said(name), fontsize=8)
    axes.tick_params(labelsize=6)
    axes.ticklabel_format(useOffset=False)
    axes.xaxis.set_major_locator(MaxNLocator(3))


def _draw_map(evaluation: RepeatEvaluation, figure: Figure) -> None:
    deviation, grid = evaluation.deviation_mm, evaluation.grid
    most = max(_MOST_MAP_MM, float(np.nanpercentile(deviation, 95)))
    (x, y), pitch, (rows, columns) = grid.first_mm, grid.pitch_mm, grid.shape
    axes = figure.subplots()
    image = axes.imshow(
        deviation.T,
        origin="lower",
        extent=(y, y + rows * pitch, x, x + columns * pitch),
        vmin=0.0,
        vmax=most,
        cmap="viridis",
    )
    axes.set(xlabel="heel to toes, mm", ylabel="across, mm", aspect="equal")
    label = "standard deviation, mm"
    figure.colorbar(image, ax=axes, label=label, extend="max", orientation="horizontal")


def _said(name: str) -> str:
    return name.removesuffix("_deg").replace("_", " ")
