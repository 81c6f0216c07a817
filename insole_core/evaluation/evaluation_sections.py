"""Report sections on evaluations (thesis chapter 5)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from matplotlib.figure import Figure

from insole_core.evaluation.alignment import Misalignment
from insole_core.evaluation.artefact import ArtefactEvaluation
from insole_core.evaluation.distances import ObjectEvaluation
from insole_core.evaluation.noise import Noise, WarmUp
from insole_core.evaluation.report import Number, Plot, ReportSection, Share, Table
from insole_core.evaluation.resolution import Resolution
from insole_core.evaluation.wall import WallError

_LISTED, _LARGEST = 105, 20
"""All distances of up to fifteen points are listed, as in the thesis; of more, the worst."""


_JUDGED_AS = {"default": "corrected"}
"""The default correction is judged by the limit of a corrected wall, also on walls left out."""


def wall_section(errors: Mapping[str, Sequence[WallError]]) -> ReportSection:
    """Report wall errors by correction: figure 11."""
    rows = tuple(
        (name, f"{e.distance_mm:.0f}", f"{e.mean_abs_mm:.3f}", f"{e.rms_mm:.3f}", f"{e.p95_mm:.3f}",
         f"{e.mean_abs_raw:.3f}")
        for name, listed in errors.items()
        for e in listed
    )  # fmt: skip
    return ReportSection(
        key="wall",
        title="Error of a flat wall",
        numbers=tuple(
            Number(
                f"mean_abs_mm_{_JUDGED_AS.get(name, name).replace(' ', '_')}",
                f"Mean absolute error, {name}",
                float(np.mean([e.mean_abs_mm for e in listed])),
                "mm",
            )
            for name, listed in errors.items()
        ),
        tables=(
            Table(
                "Walls",
                ("correction", "distance, mm", "mean abs", "rms", "95 %", "raw units"),
                rows,
                "errors in mm",
            ),
        ),
        plots=(Plot("Mean absolute error over distance", lambda f: _draw_walls(f, errors)),),
    )


def resolution_section(resolutions: Sequence[Resolution]) -> ReportSection:
    """Report the resolution over distance: figures 13 and 14."""
    ordered = sorted(resolutions, key=lambda one: one.distance_mm)
    rows = tuple(
        (f"{r.distance_mm:.0f}", f"{r.x_mm:.3f}", f"{r.theory_x_mm:.3f}", f"{r.y_mm:.3f}",
         f"{r.theory_y_mm:.3f}", f"{r.depth_mm:.3f}", f"{r.theory_depth_mm:.3f}")
        for r in ordered
    )  # fmt: skip
    headings = ("distance", "x", "x theory", "y", "y theory", "depth", "depth theory")
    return ReportSection(
        key="resolution",
        title="Spatial and depth resolution",
        numbers=(
            Number("x_mm", "Largest spacing in x", max(r.x_mm for r in ordered), "mm"),
            Number("y_mm", "Largest spacing in y", max(r.y_mm for r in ordered), "mm"),
            Number("depth_mm", "Largest depth step", max(r.depth_mm for r in ordered), "mm"),
        ),
        tables=(Table("Resolution", headings, rows, "mm"),),
        plots=(Plot("Resolution over distance", lambda f: _draw_resolution(f, ordered)),),
    )


def alignment_section(rows: Sequence[Misalignment]) -> ReportSection:
    """Report the misalignment of colour and depth: table 2."""
    texts = tuple(
        (f"{r.distance_mm:.0f}", f"{r.x_px:+z.2f}", f"{r.y_px:+z.2f}", f"{r.sd_x_px:.2f}",
         f"{r.sd_y_px:.2f}", str(r.points))
        for r in rows
    )  # fmt: skip
    return ReportSection(
        key="alignment",
        title="Colour on depth",
        sentences=(
            "How far to the right (x) and below (y) of where the depth expects it colour is seen.",
        ),
        numbers=(
            Number("x_px", "Largest offset in x", max((r.x_px for r in rows), key=abs), "px"),
            Number("y_px", "Largest offset in y", max((r.y_px for r in rows), key=abs), "px"),
        ),
        tables=(
            Table("Offset", ("distance, mm", "x", "y", "sd x", "sd y", "points"), texts, "px"),
        ),
        plots=(Plot("Offset over distance", lambda f: _draw_alignment(f, rows)),),
    )


def object_section(result: ObjectEvaluation) -> ReportSection:
    """Report a known object: figures 17 to 19."""
    listed = len(result.distances) if len(result.distances) <= _LISTED else _LARGEST
    rows = tuple(
        (_pair(d.first, d.second), d.axis, f"{d.true_mm:.2f}", f"{d.measured_mm:.2f}",
         f"{d.error_mm:+.2f}", f"{d.relative:.2%}")
        for d in sorted(result.distances, key=lambda d: -abs(d.error_mm))[:listed]
    )  # fmt: skip
    by_axis = tuple(
        Number(f"mean_abs_mm_{axis}", f"Mean absolute error, {axis}", value, "mm")
        for axis, value in result.mean_abs_by_axis_mm.items()
    )
    return ReportSection(
        key="object",
        title="Known object",
        sentences=(
            f"{len(result.distances)} distances were measured; those with the {len(rows)} largest "
            "errors are listed.",
        ),
        numbers=(
            Number("mean_abs_mm", "Mean absolute error", result.mean_abs_mm, "mm"),
            Number("sd_abs_mm", "Standard deviation of it", result.sd_abs_mm, "mm"),
            Number("max_abs_mm", "Largest error", result.max_abs_mm, "mm"),
            Share("mean_relative", "Mean relative error", result.mean_relative),
            *by_axis,
        ),
        tables=(
            Table("Distances", ("points", "axis", "true", "measured", "error", "relative"), rows),
        ),
        plots=(Plot("Errors of the distances, mm", lambda f: _draw_object(f, result)),),
    )


def artefact_section(result: ArtefactEvaluation) -> ReportSection:
    """Report an acceptance test in the manner of VDI/VDE 2634."""
    labels = {
        "probing_form_mm": "Probing error, form",
        "probing_form_95_mm": "Probing error, form, 95 %",
        "probing_size_mm": "Probing error, size",
        "spacing_mm": "Sphere spacing error",
        "flatness_mm": "Flatness",
        "flatness_95_mm": "Flatness, 95 %",
    }
    return ReportSection(
        key="artefact",
        title="Acceptance with an artefact",
        numbers=tuple(Number(k, label, getattr(result, k), "mm") for k, label in labels.items()),
        sentences=("In the manner of VDI/VDE 2634; this is no certified test.",),
    )


def noise_section(noise: Noise, warm_up: WarmUp | None = None) -> ReportSection:
    """Report temporal noise and, if it was recorded, the warm-up."""
    numbers = [
        Number("sd_raw", "Noise of one frame", noise.sd_raw, "raw units"),
        Number("sd_mm", "Noise of one frame", noise.sd_mm, "mm"),
        Share("missing_share", "Share without reading", noise.missing_share),
    ]
    plots: tuple[Plot, ...] = ()
    if warm_up is not None:
        numbers += [
            Number("drift_mm", "Drift while warming up", warm_up.drift_mm, "mm"),
            Number("settled_after_s", "Settled after", warm_up.settled_after_s, "s"),
        ]
        plots = (Plot("Depth at the centre over time", lambda f: _draw_warm_up(f, warm_up)),)
    return ReportSection("noise", "Noise and warm-up", tuple(numbers), plots=plots)


def _pair(first: str, second: str) -> str:
    """Name two points; a picture that contains both is named only once."""
    picture, found, point = first.rpartition(":")
    other, _, other_point = second.rpartition(":")
    return (
        f"{picture}: {point} – {other_point}"
        if found and other == picture
        else f"{first} – {second}"
    )


def _draw_walls(figure: Figure, errors: Mapping[str, Sequence[WallError]]) -> None:
    axes = figure.subplots()
    for name, listed in errors.items():
        ordered = sorted(listed, key=lambda error: error.distance_mm)
        axes.plot(
            [e.distance_mm for e in ordered], [e.mean_abs_mm for e in ordered], "o-", label=name
        )
    axes.set(xlabel="distance, mm", ylabel="mean absolute error, mm", ylim=(0, None))
    axes.grid(visible=True, alpha=0.3)
    axes.legend()


def _draw_alignment(figure: Figure, rows: Sequence[Misalignment]) -> None:
    axes = figure.subplots()
    distance = [r.distance_mm for r in rows]
    axes.axhline(0, color="#999999", linewidth=0.8)
    axes.errorbar(
        distance, [r.x_px for r in rows], [r.sd_x_px for r in rows], fmt="o-", capsize=3, label="x"
    )
    axes.errorbar(
        distance, [r.y_px for r in rows], [r.sd_y_px for r in rows], fmt="s-", capsize=3, label="y"
    )
    axes.set(xlabel="distance, mm", ylabel="offset and standard deviation, px")
    axes.grid(visible=True, alpha=0.3)
    axes.legend()


def _draw_resolution(figure: Figure, resolutions: Sequence[Resolution]) -> None:
    spatial, depth = figure.subplots(1, 2)
    distance = [r.distance_mm for r in resolutions]
    spatial.plot(distance, [r.x_mm for r in resolutions], "o", label="x")
    spatial.plot(distance, [r.theory_x_mm for r in resolutions], "-", label="x, theory (22)")
    spatial.plot(distance, [r.y_mm for r in resolutions], "s", label="y")
    spatial.plot(distance, [r.theory_y_mm for r in resolutions], "--", label="y, theory (22)")
    depth.plot(distance, [r.depth_mm for r in resolutions], "o", label="measured")
    depth.plot(distance, [r.theory_depth_mm for r in resolutions], "-", label="one raw unit")
    for axes, what in ((spatial, "pixel spacing, mm"), (depth, "depth step, mm")):
        axes.set(xlabel="distance, mm", ylabel=what)
        axes.legend()


def _draw_object(figure: Figure, result: ObjectEvaluation) -> None:
    bars, histogram = figure.subplots(2, 1)
    colors = {"x": "C0", "y": "C1", "z": "C2", "space": "C7"}
    first = 0
    for axis, color in colors.items():
        errors = [abs(d.error_mm) for d in result.distances if d.axis == axis]
        if errors:
            bars.bar(range(first, first + len(errors)), errors, color=color, label=axis, width=1)
        first += len(errors)
    bars.set(ylabel="absolute error, mm", xlabel="distance, by axis")
    bars.legend(ncols=len(colors), fontsize=8)
    histogram.hist([d.error_mm for d in result.distances], bins=20)
    histogram.set(xlabel="measured minus true, mm", ylabel="distances")


def _draw_warm_up(figure: Figure, warm_up: WarmUp) -> None:
    axes = figure.subplots()
    axes.plot(np.array(warm_up.seconds) / 60, warm_up.depth_mm, "o-")
    axes.set(xlabel="minutes", ylabel="depth, mm")
    axes.ticklabel_format(useOffset=False)
