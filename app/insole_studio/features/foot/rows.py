"""Values shown by the foot stage, and its colour maps."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from enum import StrEnum
from typing import Literal

import numpy as np

from insole_core.geometry.arrays import FloatArray
from insole_core.reconstruct import ViewResult
from insole_core.recording.hand_edits import Pixel, ViewEdits
from insole_core.workflows.make_foot import MadeFoot
from insole_studio.scene.coloring import Coloring
from insole_studio.texts import fill, tr

VIEW_COLORS = (
    (230, 159, 0), (0, 158, 115), (204, 121, 167), (86, 180, 233),
    (213, 94, 0), (240, 228, 66), (0, 114, 178), (148, 120, 200),
)  # fmt: skip
"""One colour per view, distinguishable by colour-blind users (Okabe & Ito)."""
MarkState = Literal["used", "unused", "excluded", "spot"]
_LEAST_SPAN_MM = 0.5


class FootMap(StrEnum):
    """What the colours of the foot show."""

    VIEWS = "views"
    SKIN = "skin"
    CONFIDENCE = "confidence"
    COVERAGE = "coverage"
    AGREEMENT = "agreement"
    CORRECTION = "correction"


@dataclass(frozen=True)
class ViewRow:
    """One row of the table of views.

    Parameters
    ----------
    name, color
        Name of the view, and its colour in the scene.
    on
        Whether the user has not excluded the view.
    found, used
        Numbers of markers.
    residual_mm
        Mean, root mean square and maximum distance of the markers; None without a pose.
    reprojection_px, displacement_mm
        Root mean square of the markers in the colour image, and standard deviation of the middle of
        the foot due to the pose's uncertainty; None where unknown.
    frames, left_out
        Numbers of depth frames, and of those rejected because something had moved.
    trouble
        Why the view is not used, or a warning; usually empty.
    is_used
        Whether the view contributes to the foot.
    """

    name: str
    color: tuple[int, int, int]
    on: bool
    found: int
    used: int
    residual_mm: tuple[float, float, float] | None
    reprojection_px: float | None
    displacement_mm: float | None
    frames: int
    left_out: int
    trouble: str
    is_used: bool


@dataclass(frozen=True)
class Mark:
    """A spot on a colour image.

    Parameters
    ----------
    id
        Id of its marker; empty for a blue spot that is none.
    pixel
        Position in the image.
    projected
        Position of the marker as projected by the pose.
    state
        How the spot is used.
    by_hand
        Whether the user placed it.
    residual_px, residual_mm
        Residual in the image and in space.
    """

    id: str
    pixel: Pixel
    projected: Pixel | None = None
    state: MarkState = "used"
    by_hand: bool = False
    residual_px: float | None = None
    residual_mm: float | None = None


@dataclass(frozen=True)
class Limits:
    """Limits beyond which a pose is rejected, as far as the user can set them."""

    residual_mm: float
    reprojection_px: float
    displacement_mm: float


@dataclass(frozen=True)
class FootButtons:
    """Which buttons are enabled."""

    make: bool = False
    cancel: bool = False
    go_on: bool = False
    undo: str = ""
    redo: str = ""
    is_stale: bool = False
    """Whether there are corrections that are not in the foot yet."""
    has_session: bool = False


def view_row(number: int, result: ViewResult, edits: ViewEdits) -> ViewRow:
    """Return the row of a view.

    Parameters
    ----------
    number
        Index of the view, which decides its colour.
    result
        Result of the registration.
    edits
        The manual corrections of the view.
    """
    residuals = result.residuals
    return ViewRow(
        name=result.name,
        color=VIEW_COLORS[number % len(VIEW_COLORS)],
        on=not edits.off,
        found=result.markers_found,
        used=result.markers_used,
        residual_mm=None if residuals is None else (residuals.mean, residuals.rms, residuals.max),
        reprojection_px=result.reprojection_px,
        displacement_mm=result.displacement_mm,
        frames=result.frames,
        left_out=result.left_out,
        trouble="" if edits.off else result.reason,
        is_used=result.used,
    )


def color_foot(kind: FootMap, made: MadeFoot) -> Coloring | None:
    """Return the colours of a foot.

    Parameters
    ----------
    kind
        The colour map.
    made
        The foot, with the data its reconstruction kept.

    Returns
    -------
    Coloring or None
        None for skin colour, and for maps without data.
    """
    maker = _MAKERS.get(kind)
    return None if maker is None else maker(made)


def _confidence(made: MadeFoot) -> Coloring | None:
    deviation_mm = made.reconstruction.deviation_mm
    if deviation_mm is None:
        return None
    title, share = tr("Standard deviation"), made.reconstruction.infrared_share
    if share > 0:
        title = fill(tr("Standard deviation, {share:.0%} by infrared"), share=share)
    return Coloring(deviation_mm, (0.0, _span(deviation_mm)), title)


def _coverage(made: MadeFoot) -> Coloring | None:
    if made.agreement is None:
        return None
    views = made.agreement.views.astype(float)
    most = max(float(views.max(initial=1)), 1.0)
    return Coloring(views, (0.0, most), tr("Views that see it"), unit=tr("views"))


def _agreement(made: MadeFoot) -> Coloring | None:
    if made.agreement is None:
        return None
    spread_mm = made.agreement.spread_mm
    return Coloring(spread_mm, (0.0, _span(spread_mm)), tr("Distance between the views"))


def _correction(made: MadeFoot) -> Coloring | None:
    correction_mm = made.reconstruction.correction_mm
    if correction_mm is None:
        return None
    span = _span(np.abs(correction_mm))
    return Coloring(correction_mm, (-span, span), tr("Moved by the correction"), signed=True)


def _span(values_mm: FloatArray) -> float:
    known = values_mm[np.isfinite(values_mm)]
    return max(float(np.percentile(known, 98)), _LEAST_SPAN_MM) if len(known) else _LEAST_SPAN_MM


_MAKERS: dict[FootMap, Callable[[MadeFoot], Coloring | None]] = {
    FootMap.CONFIDENCE: _confidence,
    FootMap.COVERAGE: _coverage,
    FootMap.AGREEMENT: _agreement,
    FootMap.CORRECTION: _correction,
}
