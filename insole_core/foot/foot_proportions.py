"""Sizes and proportions that no foot has: what is not one is refused before it is designed on."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from insole_core.errors import InputError
from insole_core.foot.front_height import MOST_FRONT_HEIGHT, front_height
from insole_core.foot.levelling import OUTLINE_HEIGHT_MM
from insole_core.foot.pose import surface_samples
from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.mesh import TriangleMesh

LENGTH_MM = (90.0, 350.0)
"""EU 16 to 52, and somewhat more."""
_FORCED_LENGTH_MM = (50.0, 500.0)
"""What a case can hold."""
_BALL_SHARES, _HEEL_SHARES = (0.60, 0.75), (0.08, 0.20)
_BALL_TO_LENGTH = (0.26, 0.52)
_HEEL_TO_BALL = (0.40, 0.88)
_MIDFOOT_SHARES = (0.40, 0.50)
_BORDERS = (0.5, 99.5)
_WHOLE = 0.95  # share of the length, less of which shows that an end is missing
_LEAST_HEIGHT_TO_LENGTH = 0.07
"""Mean thickness of a closed surface; of a foot it is 0.13 or more, of an insole 0.04."""


class ProportionsError(InputError):
    """The surface is as long as a foot, but not of its proportions; a user may insist on it."""


@dataclass(frozen=True)
class Proportions:
    """Sizes of a placed surface, mm; `thickness_mm` is NaN for an open one.

    Parameters
    ----------
    length_mm
        From the heel to the toes, estimated where they are missing.
    scanned_mm
        The same, or what was scanned of it.
    toe_height
        Where the toes lie, in shares of the length.
    """

    length_mm: float
    scanned_mm: float
    ball_mm: float
    heel_mm: float
    midfoot_mm: float
    toe_height: float
    thickness_mm: float


def proportions(mesh: TriangleMesh, length_mm: float) -> Proportions:
    """Measure a surface as a foot.

    Parameters
    ----------
    mesh : mm, insole frame
    length_mm
        From the heel to the toes, estimated where they are missing.
    """
    points, normals = surface_samples(mesh)
    low = points[points[:, 2] < OUTLINE_HEIGHT_MM]
    ball, heel, midfoot = (
        _width(low, length_mm, shares) for shares in (_BALL_SHARES, _HEEL_SHARES, _MIDFOOT_SHARES)
    )
    toe_height = front_height(points, normals, np.eye(4))
    thickness = np.nan
    if mesh.is_closed and ball > 0:
        thickness = abs(mesh.volume_mm3) / (length_mm * ball)
    scanned_mm = float(np.ptp(low[:, 1]))
    if scanned_mm > _WHOLE * length_mm:
        scanned_mm = length_mm
    return Proportions(length_mm, scanned_mm, ball, heel, midfoot, toe_height, float(thickness))


def check_length(length_mm: float, scanned_mm: float | None = None, *, force: bool = False) -> None:
    """Check that a foot can be as long, or if forced, that it can be kept.

    Parameters
    ----------
    length_mm
    scanned_mm
        What was scanned of a foot without toes, whose length is a guess and is not told; None for
        a whole foot.
    force

    Raises
    ------
    InputError
        With the numbers.
    """
    if is_within(length_mm, _FORCED_LENGTH_MM if force else LENGTH_MM):
        return
    least_mm, most_mm = LENGTH_MM
    if scanned_mm is not None:
        raise InputError(
            "The surface shows {scanned_mm:.0f} mm of a foot without its toes, which fits no foot "
            "of {least_mm:g} to {most_mm:g} mm; check its unit, and that it is a foot.",
            scanned_mm=scanned_mm,
            least_mm=least_mm,
            most_mm=most_mm,
        )
    raise InputError(
        "The surface would be a foot of {length_mm:.0f} mm, and feet are {least_mm:g} to "
        "{most_mm:g} mm long; check its unit, and that it is a whole foot.",
        length_mm=length_mm,
        least_mm=least_mm,
        most_mm=most_mm,
    )


def check_proportions(sizes: Proportions) -> None:
    """Check that a placed surface has proportions that feet can have.

    Raises
    ------
    ProportionsError
        With the numbers.
    """
    length_mm = sizes.length_mm
    ball, heel = sizes.ball_mm / length_mm, sizes.heel_mm / max(sizes.ball_mm, 1e-9)
    if not (is_within(ball, _BALL_TO_LENGTH) and is_within(heel, _HEEL_TO_BALL)):
        raise ProportionsError(
            "The surface has no proportions of a foot: {scanned_mm:.0f} mm long, {ball_mm:.0f} mm "
            "wide at the ball, {heel_mm:.0f} mm at the heel; check that the file holds one whole "
            "foot or its sole, and nothing else.",
            scanned_mm=sizes.scanned_mm,
            ball_mm=sizes.ball_mm,
            heel_mm=sizes.heel_mm,
        )
    if sizes.thickness_mm < _LEAST_HEIGHT_TO_LENGTH * length_mm:
        raise ProportionsError(
            "The surface is only {thickness_mm:.0f} mm thick on average at a length of "
            "{scanned_mm:.0f} mm, as if it were an insole; choose the scan of the foot.",
            thickness_mm=sizes.thickness_mm,
            scanned_mm=sizes.scanned_mm,
        )
    if sizes.toe_height > MOST_FRONT_HEIGHT:
        raise ProportionsError(
            "The surface is no foot by its shape: {scanned_mm:.0f} mm long, but {toe_mm:.0f} mm "
            "high where the toes would be, and feet are {usual_mm:.0f} mm there at most; check "
            "that the file holds one whole foot or its sole, and nothing else.",
            scanned_mm=sizes.scanned_mm,
            toe_mm=sizes.toe_height * length_mm,
            usual_mm=MOST_FRONT_HEIGHT * length_mm,
        )


def is_within(value: float, limits: tuple[float, float]) -> bool:
    """Return whether a value lies between two limits, or on one of them."""
    return limits[0] <= value <= limits[1]


def _width(low: FloatArray, length_mm: float, shares: tuple[float, float]) -> float:
    share = low[:, 1] / length_mm
    band = low[(share > shares[0]) & (share < shares[1]), 0]
    if len(band) == 0:
        return 0.0
    least, most = np.percentile(band, _BORDERS)  # what little lies beside a foot does not count
    return float(most - least)
