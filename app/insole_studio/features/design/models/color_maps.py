"""The colour maps of the insole, computed from its current surface."""

from __future__ import annotations

from collections.abc import Callable
from enum import StrEnum

import numpy as np

from insole_core.foot.foot import Foot
from insole_core.geometry.arrays import FloatArray
from insole_studio.document.insole_preview import InsolePreview
from insole_studio.document.side_by_side import SideBySide, foot_difference, insole_difference
from insole_studio.scene.coloring import Coloring
from insole_studio.texts import fill, tr

LEAST_SPAN_MM = 1.0


class MapKind(StrEnum):
    """What the colours of the insole show."""

    NONE = "none"
    HEIGHT = "height"
    THICKNESS = "thickness"
    FIT = "fit"
    DIFFERENCE = "difference"
    PRESSURE = "pressure"


def color_by(kind: MapKind, surface: InsolePreview, counterpart: SideBySide) -> Coloring | None:
    """Return the colours of the insole.

    Parameters
    ----------
    kind
        The colour map.
    surface
        The current preview of the insole.
    counterpart
        What a difference compares with.

    Returns
    -------
    Coloring or None
        None if there is nothing to show.
    """
    if surface.mesh is None or surface.contact is None or surface.base is None:
        return None
    if kind is MapKind.DIFFERENCE:
        return _difference(surface, counterpart)
    maker = _MAKERS.get(kind)
    return None if maker is None else maker(surface)


def _height(surface: InsolePreview) -> Coloring:
    assert surface.mesh is not None
    z = surface.mesh.vertices[:, 2]
    return Coloring(z, (0.0, max(float(z.max()), LEAST_SPAN_MM)), tr("Height"))


def _thickness(surface: InsolePreview) -> Coloring:
    assert surface.mesh is not None
    bottom = surface.bottom_heights_mm
    assert bottom is not None
    thickness = surface.mesh.vertices[: len(bottom), 2] - bottom
    limits = (0.0, max(float(thickness.max()), LEAST_SPAN_MM))
    everywhere = surface.values_everywhere(thickness, thickness)
    return Coloring(everywhere, limits, tr("Thickness"))


def _fit(surface: InsolePreview) -> Coloring:
    """Colour by the height of the insole above the sole as scanned, before pads."""
    assert surface.mesh is not None
    assert surface.base is not None
    bottom = surface.bottom_heights_mm
    assert bottom is not None
    top = surface.mesh.vertices[: len(bottom)]
    over = np.nan_to_num(top[:, 2] - surface.base.surface.height_at(top[:, :2]))
    everywhere = surface.values_everywhere(over, np.zeros(len(bottom)))
    return Coloring(everywhere, _symmetric(over), tr("Insole over foot"), signed=True)


def _difference(surface: InsolePreview, counterpart: SideBySide) -> Coloring | None:
    over = insole_difference(surface, counterpart)
    if over is None:
        return None
    everywhere = surface.values_everywhere(over, np.full(len(over), np.nan))
    return Coloring(everywhere, difference_limits(over), tr("Difference"), signed=True)


def color_foot(foot: Foot, counterpart: SideBySide) -> Coloring | None:
    """Colour the sole by its difference to the other foot; None without one."""
    over = foot_difference(foot, counterpart)
    if over is None or not np.isfinite(over).any():
        return None
    return Coloring(over, difference_limits(over), tr("Difference"), signed=True)


def difference_limits(over: FloatArray) -> tuple[float, float]:
    """Return symmetric limits that enclose 99 % of the values, in steps of 0.5 mm."""
    known = np.abs(over[np.isfinite(over)])
    span = float(np.quantile(known, 0.99)) if len(known) else 0.0
    span = max(np.ceil(2 * span) / 2, LEAST_SPAN_MM)
    return -span, span


def numbers_text(over: FloatArray) -> str:
    """Return the mean of a difference, and 95 % quantile and maximum of its magnitude, as text."""
    known = over[np.isfinite(over)]
    if len(known) == 0:
        return tr("Nothing lies over each other")
    size = np.abs(known)
    return fill(
        tr("mean {mean:+.2f}   95 % {p95:.2f}   max {max:.2f} mm"),
        mean=float(known.mean()) + 0.0,
        p95=float(np.quantile(size, 0.95)),
        max=float(size.max()),
    )


def _symmetric(values: FloatArray) -> tuple[float, float]:
    span = max(float(np.abs(values).max()), LEAST_SPAN_MM)
    return -span, span


_MAKERS: dict[MapKind, Callable[[InsolePreview], Coloring]] = {
    MapKind.HEIGHT: _height,
    MapKind.THICKNESS: _thickness,
    MapKind.FIT: _fit,
}
