"""The part of space where the foot is (thesis 6.2.3)."""

from __future__ import annotations

import numpy as np

from insole_core.errors import ReconstructionError
from insole_core.geometry.arrays import BoolArray, FloatArray
from insole_core.recording.box import Box
from insole_core.recording.session import ReferenceSystem, Session

_BLOCK_MM = 24.0
"""A marker's block, its mounting and a little air; the foot keeps so far inside of them."""
_BELOW_SOLE_MM = 30.0


def volume_of_interest(session: Session) -> Box:
    """Give the volume set by hand, the manifest's, or the space that the markers enclose."""
    recorded = session.edits.volume_of_interest or session.manifest.volume_of_interest
    return recorded or enclosed_volume(session.manifest.reference_system)


def is_inside(points: FloatArray, box: Box) -> BoolArray:
    """Tell which points (..., 3) in the reference frame lie in the box; NaN does not."""
    low, high = np.array(box.min_mm), np.array(box.max_mm)
    return np.asarray(((points >= low) & (points <= high)).all(-1))


def check_any_inside(found: BoolArray) -> None:
    """Refuse a view of which nothing was found in the volume.

    Raises
    ------
    ReconstructionError
        With the reason, as the end of a sentence.
    """
    if not found.any():
        raise ReconstructionError(
            "it measured no surface in the volume of interest; check that the foot was in place "
            'and "volume_of_interest_mm" in manifest.json'
        )


def enclosed_volume(system: ReferenceSystem) -> Box:
    """Give the space between the markers."""
    positions = np.array([marker.position_mm for marker in system.markers])
    low, high = positions.min(0), positions.max(0)
    return Box(
        (low[0] + _BLOCK_MM, low[1], low[2] - _BELOW_SOLE_MM),
        (high[0] - _BLOCK_MM, high[1], high[2]),
    )
