"""A view of known pose, corrected and smoothed on its own before the views are joined."""

from __future__ import annotations

from dataclasses import dataclass, replace

from insole_core.reconstruct.fusion.depth_view import DepthView
from insole_core.reconstruct.fusion.matching_error import without_matching_error
from insole_core.reconstruct.fusion.occluding_contour import (
    OccludingContour,
    find_occluding_contour,
)
from insole_core.reconstruct.fusion.silhouette import Silhouette, find_silhouette, within_outline
from insole_core.reconstruct.fusion.smoothing import SmoothDepth, smooth_depth


@dataclass(frozen=True, eq=False)
class PreparedView:
    """One view, ready to be joined with others.

    Parameters
    ----------
    measured
        The view as it was cut out of the depth image.
    within
        The view without readings outside the foot's silhouette, not corrected; None if the reading
        is not corrected either.
    reading
        The same without the sensor's matching error.
    outline
        None when the foot cannot be distinguished from the background by colour.
    depth
        The smoothed reading.
    rim
        The contour to a fraction of a pixel; None when it is not certain.
    """

    measured: DepthView
    within: DepthView | None
    reading: DepthView
    outline: Silhouette | None
    depth: SmoothDepth
    rim: OccludingContour | None = None


def prepare(reading: DepthView, *, corrected: bool = True) -> PreparedView:
    """Find the outline of the foot in a view; correct and smooth the readings inside.

    Parameters
    ----------
    reading
    corrected
        Whether the sensor's matching error is subtracted.

    Returns
    -------
    PreparedView
    """
    outline = find_silhouette(reading)
    within = within_outline(reading, outline)
    right = without_matching_error(within) if corrected else within
    rim = None if outline is None else find_occluding_contour(right, outline)
    # Copies, so that the properties cached so far are not kept in memory.
    given = replace(within) if corrected else None
    return PreparedView(replace(reading), given, right, outline, smooth_depth(right), rim)
