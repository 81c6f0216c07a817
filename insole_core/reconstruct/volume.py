"""The volume of interest: the part of space where the foot is (thesis 6.2.3)."""

from __future__ import annotations

import numpy as np

from insole_core.errors import ReconstructionError
from insole_core.geometry.arrays import BoolArray, FloatArray
from insole_core.geometry.side import BOTH
from insole_core.recording.box import Box
from insole_core.recording.session import FootPlace, ReferenceSystem, Session

_BLOCK_MM = 24.0
"""Least distance of the foot from the markers: a marker's block, its mounting and a clearance."""
_BELOW_SOLE_MM = 30.0
_ASIDE = 0.2
"""Tangent of the angle to the side from which on a sensor counts as standing beside a foot."""


class NothingInVolumeError(ReconstructionError):
    """No surface was measured in the volume of interest."""


def volume_of_interest(session: Session) -> Box:
    """Return the volume set by the user, else the manifest's, else the one the markers enclose.

    Of both feet it is the one that holds those of the two.
    """
    if session.manifest.side == BOTH:
        left, right = map(foot_volume, session.feet, session.manifest.reference_system.feet)
        return left.joined(right)
    recorded = session.edits.volume_of_interest or session.manifest.volume_of_interest
    return recorded or enclosed_volume(session.manifest.reference_system)


def foot_volume(foot: Session, place: FootPlace) -> Box:
    """Return the volume of one of two feet in the frame of the system that they share.

    Parameters
    ----------
    foot
        Its session, in its own frame.
    place
        Its place in the system.
    """
    return volume_of_interest(foot).moved(place.origin_mm)


def is_inside(points: FloatArray, box: Box) -> BoolArray:
    """Return which points lie in a box.

    Parameters
    ----------
    points : (..., 3) float64, mm, reference frame
        NaN lies outside.
    box

    Returns
    -------
    (...,) bool
    """
    low, high = np.array(box.min_mm), np.array(box.max_mm)
    return np.asarray(((points >= low) & (points <= high)).all(-1))


def check_any_inside(found: BoolArray) -> None:
    """Refuse a view without a reading in the volume of interest.

    Parameters
    ----------
    found : bool, any shape
        Whether each reading lies in the volume.

    Raises
    ------
    NothingInVolumeError
        With the reason, as the end of a sentence.
    """
    if not found.any():
        raise NothingInVolumeError(
            "it measured no surface in the volume of interest; check that the foot was in place "
            'and "volume_of_interest_mm" in manifest.json'
        )


def enclosed_volume(system: ReferenceSystem) -> Box:
    """Return the space between the markers, mm, reference frame."""
    positions = np.array([marker.position_mm for marker in system.markers])
    low, high = positions.min(0), positions.max(0)
    return Box(
        (low[0] + _BLOCK_MM, low[1], low[2] - _BELOW_SOLE_MM),
        (high[0] - _BLOCK_MM, high[1], high[2]),
    )


def stands_aside(sensor2reference: FloatArray, box: Box) -> bool:
    """Return whether a sensor behind the heel stands beside its foot.

    That of the other one of two feet does: it sees one flank, and the tendon only slantingly.

    Parameters
    ----------
    sensor2reference : (4, 4) float64, mm
    box
        The volume of interest of the foot.
    """
    x, y, z = sensor2reference[:3, 3] - (np.array(box.min_mm) + box.max_mm) / 2
    return bool(-y > abs(z) and abs(x) > _ASIDE * -y)
