"""What the foot stage shows, as values."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum
from typing import Literal

from insole_core.reconstruct import ViewResult
from insole_core.recording.hand_edits import Pixel, ViewEdits

VIEW_COLORS = (
    (230, 159, 0), (0, 158, 115), (204, 121, 167), (86, 180, 233),
    (213, 94, 0), (240, 228, 66), (0, 114, 178), (148, 120, 200),
)  # fmt: skip
"""One a view, told apart by colour-blind eyes as well (Okabe & Ito)."""

MarkState = Literal["used", "unused", "excluded", "spot"]


class FootMap(StrEnum):
    """What the colours of the foot tell."""

    VIEWS = "views"
    SKIN = "skin"
    CONFIDENCE = "confidence"
    COVERAGE = "coverage"
    AGREEMENT = "agreement"


@dataclass(frozen=True)
class ViewRow:
    """One line of the table.

    Parameters
    ----------
    name, color
    on
        Whether the hand has not switched it off.
    found, used
        Markers.
    residual_mm
        Mean, root mean square and greatest distance of the markers; None where there is no pose.
    reprojection_px, displacement_mm
    frames, left_out
    trouble
        Why it is not used, or what is to be known of it; mostly empty.
    is_used
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
        Of its marker; empty for a blue spot that is none.
    pixel
    projected
        Where the pose puts the marker.
    state
    by_hand
    residual_px, residual_mm
        How far it lies from where it should, in the image and in space.
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
    """When a pose is refused, as far as the window lets it be set."""

    residual_mm: float
    reprojection_px: float
    displacement_mm: float


@dataclass(frozen=True)
class Buttons:
    """What can be pressed."""

    make: bool = False
    cancel: bool = False
    go_on: bool = False
    undo: str = ""
    redo: str = ""
    is_stale: bool = False
    """Whether there are corrections that the foot does not have yet."""
    has_session: bool = False


def view_row(number: int, result: ViewResult, edits: ViewEdits) -> ViewRow:
    """Give the line of a view."""
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
