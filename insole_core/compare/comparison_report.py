"""The result of a comparison: as numbers, as a picture, as a coloured surface, and as PDF."""

from __future__ import annotations

from dataclasses import replace
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib import colormaps
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from insole_core.compare.difference import (
    FOOT_MEASURES,
    ComparedMeasure,
    Difference,
    foot_rows,
    part_rows,
    table_3,
)
from insole_core.export import paper
from insole_core.export.lettering import with_known_letters
from insole_core.foot.spread import MeasuredFoot, Spread, explained, spread_text
from insole_core.geometry.arrays import ByteArray, FloatArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.messages import Message, Translate, joined
from insole_core.recording.images import encode_png

_COLOR_MAP = "RdBu_r"
_LEAST_RANGE_MM = 0.1
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


def report_json(difference: Difference) -> dict[str, Any]:
    """Return the figures for `json.dump`: docs/formats/comparison.md."""
    limits = {
        name: (foot or MeasuredFoot({}, {})).limits_json(FOOT_MEASURES)
        for name, foot in zip("ab", difference.feet, strict=True)
    }
    fit = difference.fit
    residual = None if np.isnan(fit.residual_mm) else round(fit.residual_mm, 6)
    return {
        "unit": "mm",
        "sign": "positive where a is higher (+z) than b",
        **{key: round(value, 6) for key, value in difference.statistics.items()},
        "b_mirrored": difference.b_is_mirrored,
        "b2a": fit.b2a.tolist(),
        "fit": {"residual": residual, "share_of_b": round(fit.share, 4)},
        "pixel_mm": difference.grid.pitch_mm,
        "measures": table_3(difference),
        **{key: {name: limits[name][key] for name in "ab"} for key in ("limits_95", "limits_by")},
        "within_error": [row.key for row in foot_rows(difference) if row.is_within_error],
    }


def draw_picture(
    difference: Difference,
    path: Path,
    names: tuple[str, str],
    translate: Translate = str,
) -> None:
    """Write the signed and the absolute difference side by side as PNG, to scale.

    Parameters
    ----------
    names
        Of the first and the second surface.
    translate
        Into the language of the picture.
    """
    path.write_bytes(encode_png(drawn_maps(difference, names, translate)))


def drawn_maps(
    difference: Difference, names: tuple[str, str], translate: Translate = str
) -> ByteArray:
    """Return the maps of a difference as a picture, (height, width, 3) uint8, RGB."""
    canvas = FigureCanvasAgg(_maps(difference, names, translate))
    canvas.draw()  # type: ignore[no-untyped-call] # Figure.savefig would draw twice
    drawn = np.asarray(canvas.buffer_rgba(), np.uint8)  # type: ignore[no-untyped-call]
    return np.ascontiguousarray(drawn[..., :3])


def _maps(difference: Difference, names: tuple[str, str], translate: Translate) -> Figure:
    signed = difference.signed_mm
    limit = _limit_mm(signed)
    figure = Figure(figsize=(9, 8), dpi=120, layout="constrained")
    grid = difference.grid
    (x, y), (rows, columns), pitch = grid.first_mm, grid.shape, grid.pitch_mm
    extent = (x - pitch / 2, x + (columns - 0.5) * pitch, y - pitch / 2, y + (rows - 0.5) * pitch)
    figure.suptitle(_caption(difference, names, translate), parse_math=False)  # names of files
    for axes, values, low, colors, title in zip(
        figure.subplots(1, 2),
        (signed, np.abs(signed)),
        (-limit, 0.0),
        (_COLOR_MAP, "viridis"),
        (Message("first minus second"), Message("absolute difference")),
        strict=True,
    ):
        image = axes.imshow(
            values, origin="lower", extent=extent, vmin=low, vmax=limit, cmap=colors
        )
        axes.set(title=translate(title), xlabel="x, mm", ylabel="y, mm", aspect="equal")
        figure.colorbar(image, ax=axes, label="mm", shrink=0.8, extend="both")
    return figure


def colored_surface(difference: Difference) -> TriangleMesh:
    """Return surface a coloured by the signed difference, for display; grey where b is missing."""
    mesh, signed = difference_surface(difference)
    return replace(mesh, colors=difference_colors(signed))


def difference_surface(difference: Difference) -> tuple[TriangleMesh, FloatArray]:
    """Return surface a and the signed difference (n,) at its vertices, mm; NaN if b is missing."""
    heights = difference.heights_a_mm
    known = np.isfinite(heights)
    places = np.concatenate([difference.grid.places, heights[..., None]], axis=-1).reshape(-1, 3)
    index = np.arange(known.size, dtype=np.int32).reshape(known.shape)
    a, b, c, d = index[:-1, :-1], index[:-1, 1:], index[1:, 1:], index[1:, :-1]
    triangles = np.concatenate(
        [np.stack([corner.ravel() for corner in half], axis=1) for half in ((a, b, c), (a, c, d))]
    )
    whole = known.ravel()[triangles].all(axis=1)
    mesh = TriangleMesh(places, triangles[whole]).part(known.ravel())
    return mesh, difference.signed_mm.ravel()[known.ravel()]


def span_mm(difference: Difference) -> float:
    """Return the end of the colour scale: the 99th percentile of the absolute difference."""
    return _limit_mm(difference.signed_mm)


def difference_colors(signed_mm: FloatArray) -> ByteArray:
    """Return colours (n, 3): red where a is higher, blue where b is, grey where one is missing."""
    share = 0.5 + 0.5 * signed_mm / _limit_mm(signed_mm)
    colors = colormaps[_COLOR_MAP](np.nan_to_num(np.clip(share, 0, 1), nan=0.5), bytes=True)
    return np.where(np.isfinite(signed_mm)[:, None], colors[:, :3], 128).astype(np.uint8)


def _limit_mm(signed: FloatArray) -> float:
    """Return the end of the colour scale: the 99th percentile of the absolute difference."""
    size = np.abs(signed[np.isfinite(signed)])
    return max(float(np.percentile(size, 99)), _LEAST_RANGE_MM)


def _caption(difference: Difference, names: tuple[str, str], translate: Translate) -> str:
    s = difference.statistics
    first, second = (with_known_letters(translate(name)) for name in names)
    if difference.b_is_mirrored:
        second = translate(Message("{name} (mirrored)", name=second))
    figures = Message(
        "mean {mean:.2f} mm, 95 % {p95:.2f} mm, largest {max:.2f} mm, signed mean {signed:+.2f} mm",
        mean=s["mean_abs"],
        p95=s["p95"],
        max=s["max"],
        signed=s["signed_mean"],
    )
    return f"{first} – {second}\n{translate(figures)}"


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
    picture = encode_png(drawn_maps(difference, names, translate))
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
            spreads = [s for row in rows for s in (row.a_spread, row.b_spread) if s is not None]
            facts: dict[str, str] = {_MEASURES[row.key]: _both(row) for row in rows}
            if spreads:
                facts[Message("uncertainty")] = joined(explained(spreads), "; ")
            sections.append((title, facts))
    said = [
        (translate(title), {translate(key): translate(text) for key, text in facts.items()})
        for title, facts in sections
    ]
    heading = translate(Message("Comparison of two surfaces"))
    paper.write_report(heading, said, picture, path)


def _fit_text(difference: Difference) -> str:
    residual = difference.fit.residual_mm
    how = Message("as both lie")
    if not np.isnan(residual):
        how = Message("with a residual of {residual:.2f} mm", residual=residual)
    return Message("mirrored, {how}", how=how) if difference.b_is_mirrored else how


def _both(row: ComparedMeasure) -> str:
    first, second = _value(row.key, row.a, row.a_spread), _value(row.key, row.b, row.b_spread)
    if row.is_within_error:
        return Message(
            "{first} and {second}; the difference is within the error", first=first, second=second
        )
    return Message("{first} and {second}", first=first, second=second)


def _value(key: str, value: float | None, spread: Spread | None) -> str:
    if value is None:
        return "–"
    if spread is None:
        return Message("{value:.1f} mm", value=value)
    limits = spread_text(key, spread.limits_95)
    return Message("{value:.1f} {limits} mm", value=value, limits=limits)
