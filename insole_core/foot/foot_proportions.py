"""Sizes and proportions that no foot has: what is not one is refused before it is designed on."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from insole_core.errors import InputError
from insole_core.foot.levelling import OUTLINE_HEIGHT_MM
from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.mesh import TriangleMesh

LENGTH_MM = (90.0, 350.0)
"""EU 16 to 52, and somewhat more."""
_BALL_SHARES, _HEEL_SHARES = (0.60, 0.75), (0.08, 0.20)
_BALL_TO_LENGTH = (0.26, 0.60)
_HEEL_TO_BALL = (0.40, 0.88)
_BORDERS = (0.5, 99.5)
_LEAST_HEIGHT_TO_LENGTH = 0.07
"""Mean thickness of a closed surface; of a foot it is 0.13 or more, of an insole 0.04."""


class ProportionsError(InputError):
    """The surface is as long as a foot, but not of its proportions; a user may insist on it."""


@dataclass(frozen=True)
class Proportions:
    """Sizes of a placed surface, mm; `thickness_mm` is NaN for an open one."""

    length_mm: float
    ball_mm: float
    heel_mm: float
    thickness_mm: float


def proportions(mesh: TriangleMesh, points: FloatArray, length_mm: float) -> Proportions:
    """Measure a surface as a foot.

    Parameters
    ----------
    mesh : mm, insole frame
    points : (n, 3) float64, mm, insole frame
        Its `surface_points`.
    length_mm
        From the heel to the toes, estimated where they are missing.
    """
    low = points[points[:, 2] < OUTLINE_HEIGHT_MM]
    ball, heel = (_width(low, length_mm, shares) for shares in (_BALL_SHARES, _HEEL_SHARES))
    thickness = np.nan
    if mesh.is_closed and ball > 0:
        thickness = abs(mesh.volume_mm3) / (length_mm * ball)
    return Proportions(length_mm, ball, heel, float(thickness))


def check_length(length_mm: float) -> None:
    """Check that a foot can be as long.

    Raises
    ------
    InputError
        With the numbers.
    """
    if not LENGTH_MM[0] <= length_mm <= LENGTH_MM[1]:
        raise InputError(
            "The surface would be a foot of {length_mm:.0f} mm, and feet are {least_mm:g} to "
            "{most_mm:g} mm long; check its unit, and that it is a whole foot.",
            length_mm=length_mm,
            least_mm=LENGTH_MM[0],
            most_mm=LENGTH_MM[1],
        )


def check_proportions(mesh: TriangleMesh, points: FloatArray, length_mm: float) -> None:
    """Check that a placed surface has proportions that feet can have.

    Parameters
    ----------
    mesh, points, length_mm
        As for `proportions`.

    Raises
    ------
    ProportionsError
        With the numbers.
    """
    sizes = proportions(mesh, points, length_mm)
    ball, heel = sizes.ball_mm / length_mm, sizes.heel_mm / max(sizes.ball_mm, 1e-9)
    if not (
        _BALL_TO_LENGTH[0] <= ball <= _BALL_TO_LENGTH[1]
        and _HEEL_TO_BALL[0] <= heel <= _HEEL_TO_BALL[1]
    ):
        raise ProportionsError(
            "The surface has no proportions of a foot: {length_mm:.0f} mm long, {ball_mm:.0f} mm "
            "wide at the ball, {heel_mm:.0f} mm at the heel; check that the file holds one whole "
            "foot or its sole, and nothing else.",
            length_mm=length_mm,
            ball_mm=sizes.ball_mm,
            heel_mm=sizes.heel_mm,
        )
    if sizes.thickness_mm < _LEAST_HEIGHT_TO_LENGTH * length_mm:
        raise ProportionsError(
            "The surface is only {thickness_mm:.0f} mm thick on average at a length of "
            "{length_mm:.0f} mm, as if it were an insole; choose the scan of the foot.",
            thickness_mm=sizes.thickness_mm,
            length_mm=length_mm,
        )


def _width(low: FloatArray, length_mm: float, shares: tuple[float, float]) -> float:
    share = low[:, 1] / length_mm
    band = low[(share > shares[0]) & (share < shares[1]), 0]
    if len(band) == 0:
        return 0.0
    least, most = np.percentile(band, _BORDERS)  # what little lies beside a foot does not count
    return float(most - least)
