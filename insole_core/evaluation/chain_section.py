"""What a proof of the whole chain shows: the report section, and which correction to use."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from matplotlib.figure import Figure

from insole_core.evaluation.chain import (
    CORRECTIONS,
    DISTANCE_STEP_MM,
    PARTS,
    SLANTS_DEG,
    ChainErrors,
    ChainEvaluation,
    Correction,
    Errors,
    SurfaceErrors,
)
from insole_core.evaluation.known_object import KnownPlaced
from insole_core.evaluation.report import Number, Plot, ReportSection, Share, Table
from insole_core.geometry.arrays import BoolArray, FloatArray

WORSE_MEAN_MM, WORSE_95_MM, _WORSE_SIZE = 0.02, 0.1, 0.005
"""By more than this a correction may not be worse, in the mean, at 95 %, and in the size."""
_NAMES = {"none": "without correction", "learnt": "with the learnt correction"}
_HEADINGS = (
    "share", "mean without", "mean learnt", "rms without", "rms learnt", "95 % without",
    "95 % learnt", "outwards without", "outwards learnt",
)  # fmt: skip
_WIDE_RANGE_MM = 0.5
_MAP_MM = 1.5
_MAPPED = 6000


@dataclass(frozen=True)
class Verdict:
    """A decision for a set of sensors.

    Parameters
    ----------
    use
        The one to use.
    is_clear
        Whether the object told the two apart; if it did not, the correction stays on.
    reason
        One sentence.
    """

    use: Correction
    is_clear: bool
    reason: str


def judge(evaluation: ChainEvaluation) -> Verdict:
    """Decide by what the correction did to the mean, to the 95 %, and to the size."""
    without, learnt = evaluation.results["none"], evaluation.results["learnt"]
    change = {
        "mean": (_mean(without), _mean(learnt), WORSE_MEAN_MM),
        "95 %": (_p95(without), _p95(learnt), WORSE_95_MM),
        "size": (
            abs(without.size_error_mm),
            abs(learnt.size_error_mm),
            _WORSE_SIZE * without.size_mm,
        ),
    }
    said = ", ".join(f"{name} {a:.2f} to {b:.2f} mm" for name, (a, b, _) in change.items())
    worse = [name for name, (a, b, limit) in change.items() if b - a > limit]
    better = [name for name, (a, b, limit) in change.items() if a - b > limit]
    if worse:
        return Verdict(
            "none",
            True,
            f"The correction makes it worse ({' and '.join(worse)}: {said}), so it is better off.",
        )
    if better:
        return Verdict("learnt", True, f"The correction makes it better ({said}), so it stays on.")
    return Verdict(
        "learnt",
        False,
        f"The correction changes hardly anything on this object ({said}), so it stays on; a cast "
        "of a foot says more.",
    )


def _mean(result: ChainErrors) -> float:
    return result.surface.all.mean_abs_mm


def _p95(result: ChainErrors) -> float:
    return result.surface.all.p95_mm


def chain_section(evaluation: ChainEvaluation, verdict: Verdict) -> ReportSection:
    """Report a proof of the chain; numbers without a suffix are those of what the verdict says.

    Of a body in its known place the report is one page, to be kept.
    """
    if isinstance(evaluation.known, KnownPlaced):
        return _page(evaluation, verdict)
    tables = (
        Table("Verdict", ("use", "why"), ((verdict.use, verdict.reason),)),
        Table("Error by slant", ("degrees", *_HEADINGS), _rows(evaluation, _slants), "mm"),
        Table("Error by distance", ("mm", *_HEADINGS), _rows(evaluation, _distances), "mm"),
        Table("Error by part", ("part", *_HEADINGS), _rows(evaluation, _parts), "mm"),
        Table("Error by sensor", ("view", *_HEADINGS), _rows(evaluation, _views), "mm"),
        _single_readings(evaluation),
    )
    return ReportSection(
        key="chain",
        title="Proof of the whole chain",
        sentences=tuple(_sentences(evaluation, verdict)),
        numbers=(
            *_numbers(evaluation.results[verdict.use], "", "as recommended"),
            *(
                number
                for correction in CORRECTIONS
                for number in _numbers(
                    evaluation.results[correction], f"_{correction}", _NAMES[correction]
                )
            ),
        ),
        tables=tables,
        plots=(
            Plot("Mean absolute error by slant, mm", lambda f: _draw_slants(f, evaluation)),
            Plot("Error seen from the sole, mm, outwards red", lambda f: _draw_maps(f, evaluation)),
        ),
    )


def _page(evaluation: ChainEvaluation, verdict: Verdict) -> ReportSection:
    result = evaluation.results[verdict.use]
    chosen = (("part", _parts), ("view", _views))
    tables = tuple(
        Table(
            f"Error by {name}",
            (name, "share", "mean", "rms", "95 %", "outwards"),
            tuple((label, *_short(result.surface.over(one)))
                  for label, one in classes(result.surface, evaluation)),
            "mm",
        )
        for name, classes in chosen
    )  # fmt: skip
    return ReportSection(
        key="reference_foot",
        title="Proof of the whole chain by the reference foot",
        sentences=tuple(_sentences(evaluation, verdict)),
        numbers=(*_numbers(result, "", "as recommended"), *_place_numbers(result)),
        tables=tables,
        plots=(
            Plot(
                "Error seen from the sole, mm, outwards red",
                lambda figure: _draw_maps(figure, evaluation),
            ),
        ),
    )


def _place_numbers(result: ChainErrors) -> Iterator[Number]:
    best = result.best_place
    assert best is not None, "the body has a known place"
    label = "Mean absolute error that the best place would leave"
    yield Number("best_place_mean_abs_mm", label, best.mean_abs_mm, "mm")
    yield Number("place_mm", "Distance to that place", best.away_mm, "mm")
    yield Number("turn_deg", "Turn to that place", best.turn_deg, "°")


def _sentences(evaluation: ChainEvaluation, verdict: Verdict) -> Iterator[str]:
    known = evaluation.known
    yield f"Captured: {known.text}; {', '.join(evaluation.captures)}."
    yield f"Use the chain {_NAMES[verdict.use]}. {verdict.reason}"
    result = evaluation.results[verdict.use]
    where = "its best place" if result.best_place is None else "its place among its markers"
    yield (
        f"Compared with a size of {result.true_size_mm:.2f} mm in {where}; fitted freely it is "
        f"{result.size_mm:.2f} mm."
    )
    least, most = known.size_range_mm
    if most - least > _WIDE_RANGE_MM:
        yield (
            f"The size is only known to {most - least:.1f} mm, so within that range nothing is "
            "said of its bias; measure the circumference with a tape to know it."
        )


def _numbers(result: ChainErrors, suffix: str, which: str) -> Iterator[Number]:
    errors = result.surface.all
    yield Number(f"mean_abs_mm{suffix}", f"Mean absolute error, {which}", errors.mean_abs_mm, "mm")
    yield Number(f"rms_mm{suffix}", f"Root mean square error, {which}", errors.rms_mm, "mm")
    yield Number(f"p95_mm{suffix}", f"Error, 95 %, {which}", errors.p95_mm, "mm")
    yield Number(f"size_mm{suffix}", f"Bias of the size, {which}", result.size_error_mm, "mm")
    yield Share(f"missing_share{suffix}", f"Share not covered, {which}", result.missing_share)


_Classes = Iterator[tuple[str, BoolArray]]
_Classify = Callable[[SurfaceErrors, ChainEvaluation], _Classes]


def _slants(surface: SurfaceErrors, _: ChainEvaluation) -> _Classes:
    last = SLANTS_DEG[-1]
    for low, high in pairwise(SLANTS_DEG):
        name = f"{low:.0f}+" if high == last else f"{low:.0f}–{high:.0f}"
        yield name, (surface.slants_deg >= low) & (surface.slants_deg < high)


def _distances(surface: SurfaceErrors, evaluation: ChainEvaluation) -> _Classes:
    far = np.concatenate([r.surface.distances_mm for r in evaluation.results.values()])
    for low in np.arange(far.min() // DISTANCE_STEP_MM, far.max() // DISTANCE_STEP_MM + 1):
        start, end = low * DISTANCE_STEP_MM, (low + 1) * DISTANCE_STEP_MM
        within = (surface.distances_mm >= start) & (surface.distances_mm < end)
        yield f"{start:.0f}–{end:.0f}", within


def _parts(surface: SurfaceErrors, _: ChainEvaluation) -> _Classes:
    for number, name in enumerate(PARTS):
        yield name, surface.parts == number


def _views(surface: SurfaceErrors, evaluation: ChainEvaluation) -> _Classes:
    for number, name in enumerate(evaluation.views):
        yield name, surface.views == number


def _rows(evaluation: ChainEvaluation, classes: _Classify) -> tuple[tuple[str, ...], ...]:
    without, learnt = (evaluation.results[key].surface for key in CORRECTIONS)
    return tuple(
        (name, *_cells(without.over(one), learnt.over(other)))
        for (name, one), (_, other) in zip(
            classes(without, evaluation), classes(learnt, evaluation), strict=True
        )
    )


def _short(errors: Errors | None) -> tuple[str, ...]:
    share = "–" if errors is None else f"{100 * errors.share:.0f} %"
    sizes = (_cell(errors, kind) for kind in ("mean_abs_mm", "rms_mm", "p95_mm"))
    return share, *sizes, _cell(errors, "signed_mm", "+")


def _cells(without: Errors | None, learnt: Errors | None) -> tuple[str, ...]:
    share = "–" if without is None else f"{100 * without.share:.0f} %"
    kinds = ("mean_abs_mm", "rms_mm", "p95_mm")
    size = (_cell(one, kind) for kind in kinds for one in (without, learnt))
    return share, *size, _cell(without, "signed_mm", "+"), _cell(learnt, "signed_mm", "+")


def _cell(errors: Errors | None, kind: str, sign: str = "") -> str:
    return "–" if errors is None else f"{getattr(errors, kind):{sign}.2f}"


def _single_readings(evaluation: ChainEvaluation) -> Table:
    rows = []
    without, learnt = (evaluation.results[key].sensors for key in CORRECTIONS)
    for one, other in zip(without, learnt, strict=True):
        kinds = ("mean_abs_mm", "p95_mm")
        size = (_cell(each.errors, kind) for kind in kinds for each in (one, other))
        sizes = (_number(each.size_error_mm) for each in (one, other))
        off = (_number(each.off_mm, "") for each in (one, other))
        rows.append((one.view, one.serial, str(one.readings), *size, *sizes, *off))
    headings = (
        "view", "serial", "readings", *_HEADINGS[1:3], *_HEADINGS[5:7], "size without",
        "size learnt", "place without", "place learnt",
    )  # fmt: skip
    return Table("Single readings of each sensor, in the place that fits it alone", headings,
                 tuple(rows), "mm")  # fmt: skip


def _number(value: float, sign: str = "+") -> str:
    return f"{value:{sign}.2f}" if np.isfinite(value) else "–"


def _draw_slants(figure: Figure, evaluation: ChainEvaluation) -> None:
    axes = figure.subplots()
    for number, correction in enumerate(CORRECTIONS):
        surface = evaluation.results[correction].surface
        names, chosen = zip(*_slants(surface, evaluation), strict=True)
        errors = [surface.over(one) for one in chosen]
        heights = [0.0 if one is None else one.mean_abs_mm for one in errors]
        places = np.arange(len(names)) + (number - 0.5) * 0.38
        axes.bar(places, heights, width=0.36, label=_NAMES[correction])
    axes.set_xticks(np.arange(len(names)), names)
    axes.set(xlabel="slant to the sensor that sees it best, degrees", ylabel="mm")
    axes.legend()


def _draw_maps(figure: Figure, evaluation: ChainEvaluation) -> None:
    both = figure.subplots(1, 2, sharex=True, sharey=True)
    for axes, correction in zip(both, CORRECTIONS, strict=True):
        surface = evaluation.results[correction].surface
        places, errors = _thinned(surface)
        drawn = axes.scatter(
            places[:, 0], places[:, 1], 3, errors, cmap="RdBu_r", vmin=-_MAP_MM, vmax=_MAP_MM
        )
        axes.set(title=_NAMES[correction], xlabel="x, mm", aspect="equal")
    both[0].set_ylabel("y, to the toes, mm")
    both[0].invert_xaxis()  # who looks at the sole has the patient's right on the left
    figure.colorbar(drawn, ax=both)


def _thinned(surface: SurfaceErrors) -> tuple[FloatArray, FloatArray]:
    """Return places and errors of some vertices, those nearest to the viewer last."""
    chosen = np.argsort(-surface.places_mm[:, 2])[:: max(1, len(surface.errors_mm) // _MAPPED)]
    return surface.places_mm[chosen], surface.errors_mm[chosen]
