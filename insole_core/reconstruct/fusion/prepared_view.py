"""A placed view with all that can be said of it alone, before the views are joined."""

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
    reading
        Without what lies beside the foot's outline, and without the error of the sensor's matching.
    outline
        None where the colours do not tell.
    depth
        The reading, smoothed.
    rim
        The outline between the pixels; None where it is not certain.
    """

    measured: DepthView
    reading: DepthView
    outline: Silhouette | None
    depth: SmoothDepth
    rim: OccludingContour | None = None


def prepare(reading: DepthView, *, exact: bool = False) -> PreparedView:
    """Find the outline of the foot in a view; correct and smooth what lies within.

    Parameters
    ----------
    reading
    exact
        Whether it has no error of a matching window that is to be taken out.
    """
    outline = find_silhouette(reading)
    within = within_outline(reading, outline)
    corrected = within if exact else without_matching_error(within)
    rim = None if outline is None else find_occluding_contour(corrected, outline)
    # A copy, so that what was derived from the reading on the way here is not kept with it.
    return PreparedView(replace(reading), corrected, outline, smooth_depth(corrected), rim)
