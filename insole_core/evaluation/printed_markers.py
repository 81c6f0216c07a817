"""What the markers of a printed body say of its print, so that one nobody measured is told.

A pose is found among markers that lie somewhat elsewhere as well, and depth that contradicts them
is corrected by them: a print of another size would prove the chain all the same.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from insole_core.errors import CalibrationError
from insole_core.evaluation.known_object import KnownPlaced
from insole_core.geometry.arrays import FloatArray
from insole_core.reconstruct.result import ViewResult

_MOST = np.array([0.01, 0.01, 0.01, np.radians(0.4)])
"""Of size along x, y and z, and of skew: callipers tell a tenth of it, and a print that keeps
within it is off by less than its surface is rough."""
_DEVIATIONS = 3.0
_LEAST_MARKERS = 10
_UNKNOWNS, _OF_VIEW = 4, 6


def check_print(known: KnownPlaced, views: Sequence[ViewResult], capture: str) -> None:
    """Check that the markers lie as on the print that was told.

    Where its bar was measured, a wrong size in all directions is that of the depth.

    Parameters
    ----------
    known
    views
        Of a capture of it, with their markers.
    capture
        Its name.

    Raises
    ------
    CalibrationError
        When it is another print, or one that nobody measured.
    """
    stretch, deviation = _stretch(known, views)
    if known.bar is not None:
        stretch[:3] -= stretch[:3].mean()
    if (np.abs(stretch) <= np.maximum(_MOST, _DEVIATIONS * deviation)).all():
        return
    x, y, z = np.round(100 * stretch[:3], 1) + 0.0  # no "-0.0"
    raise CalibrationError(
        "{text}: by its markers the print in {capture} differs from that by x {x:+.1f} %, "
        "y {y:+.1f} %, z {z:+.1f} % and {skew:.1f}° of skew; measure the bar that was printed with "
        "it again, and name the readings with --callipers, or, if they are right, calibrate the "
        "sensors.",
        text=known.text,
        capture=capture,
        x=x,
        y=y,
        z=z,
        skew=abs(np.degrees(stretch[3])),
    )


def _stretch(known: KnownPlaced, views: Sequence[ViewResult]) -> tuple[FloatArray, FloatArray]:
    """Fit the print to the markers of all views, whose poses are free again.

    Returns
    -------
    stretch, deviation : (4,) float64
        By how much it is larger along x, y and z, and its skew, radians, reference frame; and
        their standard deviations, without end where there are too few markers.
    """
    places = {marker.id: np.array(marker.position_mm) for marker in known.system.markers}
    rows, offsets = [], []
    for number, view in enumerate(views):
        for fix in (fix for fix in view.fixes if fix.used and view.used):
            place = places[fix.id]
            row = np.zeros((3, _UNKNOWNS + _OF_VIEW * len(views)))
            row[:, :3] = np.diag(place)
            row[0, 3] = place[1]
            own = _UNKNOWNS + _OF_VIEW * number
            row[:, own : own + _OF_VIEW] = np.hstack([np.eye(3), np.cross(place, np.eye(3))])
            rows.append(row)
            offsets.append(view.depth_scale * np.array(fix.position_mm) - place)
    if len(rows) < _LEAST_MARKERS:
        return np.zeros(_UNKNOWNS), np.full(_UNKNOWNS, np.inf)
    system, wanted = np.concatenate(rows), np.concatenate(offsets)
    solved = np.linalg.pinv(system)
    found = solved @ wanted
    free = len(wanted) - np.linalg.matrix_rank(system)
    variance = ((wanted - system @ found) ** 2).sum() / max(free, 1)
    deviation = np.sqrt(variance * (solved[:_UNKNOWNS] ** 2).sum(axis=1))
    return found[:_UNKNOWNS], np.asarray(deviation)
