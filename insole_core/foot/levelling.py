"""Refine the pose of a foot: sole level, axis along y, origin at heel and ground.

The pose is known to some ten degrees; heel, heads and toe are found at their usual positions and
define the frame, which is iterated until it converges.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Literal

import numpy as np

from insole_core.errors import InputError
from insole_core.foot.outermost import reach
from insole_core.foot.toes import pulp_line
from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.sampling import EvenSurface
from insole_core.geometry.side import Side
from insole_core.geometry.transforms import rigid, rotation_angle_deg

_Toes = Literal["pulps", "backs"]

OUTLINE_HEIGHT_MM = 45.0
"""Height over the sole above which the surface is leg and does not belong to the outline."""

# Shares of the foot's length, and of the ball's width from the medial border.
_HEEL_BANDS = (0.10, 0.13, 0.16, 0.19, 0.22)
_FIRST_HEAD, _FIFTH_HEAD = 0.73, 0.63
_HEAD_INSET = 0.075
_SECOND_TOE_ACROSS, _SECOND_TOE_REACH = 0.41, 0.12
_BALL_BAND = 0.68
_BAND = 0.02
_PATCH, _PATCH_END, _PATCH_DEPTH_MM = 0.03, 4.0, 12.0
_BACK_FACING = 0.3
_ROUNDS, _AT_REST_DEG, _NEARLY_AT_REST_DEG = 40, 0.002, 0.2
_END_MM, _BLUNT = (6.0, 40.0), 0.7  # an end of the foot, and what is behind it; share of its width


@dataclass(frozen=True, eq=False)
class LevelFoot:
    """The insole frame of a foot.

    Parameters
    ----------
    source2insole : (4, 4) float64, mm
    length_mm
        Heel to the tip of the longest toe; an estimate where the toes are missing.
    second_toe_found
        Whether the tip of the 2nd toe was found; otherwise its usual position is used.
    """

    source2insole: FloatArray
    length_mm: float
    second_toe_found: bool


def level(
    surface: EvenSurface,
    side: Side,
    source2rough: FloatArray,
    covered: float = 1.0,
    *,
    shows_pulps: bool = True,
) -> LevelFoot:
    """Find the insole frame of a foot of roughly known pose.

    Parameters
    ----------
    surface : mm, source frame
    side
    source2rough : (4, 4) float64, mm
        To a frame with the toes towards +y and the sole towards -z, accurate to some 15 degrees.
    covered
        Share of the foot's length that the surface covers from the heel on.
    shows_pulps
        Whether the toes were seen from below; otherwise their backs are looked for.

    Returns
    -------
    LevelFoot

    Raises
    ------
    InputError
        When nothing faces the ground.
    """
    key = (side, source2rough.tobytes(), covered, shows_pulps)
    return surface.derived.get(
        "level", key, lambda: _level(surface, side, source2rough, covered, shows_pulps)
    )


def _level(
    surface: EvenSurface, side: Side, source2rough: FloatArray, covered: float, shows_pulps: bool
) -> LevelFoot:
    low = _low_part(surface, source2rough)
    for toes in ("pulps" if shows_pulps else "backs", None):
        pose, at_rest = _settled(low, side, source2rough, covered, toes)
        if at_rest:
            break
    marks = _Marks(low, side, pose, covered, toes)
    ground = rigid(np.eye(3), np.array([0.0, -marks.back, -marks.lowest]))
    return LevelFoot(ground @ pose, marks.length, marks.second_toe[1])


def _settled(
    low: EvenSurface, side: Side, pose: FloatArray, covered: float, toes: _Toes | None
) -> tuple[FloatArray, bool]:
    """Iterate the pose, and return whether it came to rest.

    Where the 2nd toe hardly stands out, it is found in one pose and lost in the next one, and the
    axis swings by degrees; a coarse surface lets it swing by hundredths.
    """
    for _ in range(_ROUNDS):
        step = _Marks(low, side, pose, covered, toes).frame()
        pose = step @ pose
        moved_deg = rotation_angle_deg(step[:3, :3])
        if moved_deg < _AT_REST_DEG:
            return pose, True
    return pose, moved_deg < _NEARLY_AT_REST_DEG


def _low_part(surface: EvenSurface, source2rough: FloatArray) -> EvenSurface:
    """Leave out the leg, with a margin for a tilt of the pose."""
    if len(surface.points) == 0:
        raise _no_sole()
    height = surface.points @ source2rough[2, :3]
    return surface.part(height < height.min() + 2 * OUTLINE_HEIGHT_MM)


def _no_sole() -> InputError:
    """Return the error of a surface with nothing to stand on, for the caller to raise."""
    return InputError(
        "The surface has no sole: nothing of it faces the ground;"
        " check that the scan shows the foot from below."
    )


class _Marks:
    """The positions of heel, heads and toe in the current pose."""

    def __init__(
        self, surface: EvenSurface, side: Side, pose: FloatArray, covered: float, toes: _Toes | None
    ) -> None:
        self.side = side
        self.toes = toes if covered >= 1 else None
        # A row for each coordinate: all that follows looks at one of them at a time.
        points = pose[:3, :3] @ surface.points.T + pose[:3, 3, None]
        self.lowest = float(points[2].min())
        low = np.flatnonzero(points[2] < self.lowest + OUTLINE_HEIGHT_MM)
        self._low, self._areas = points[:, low], surface.area_mm2[low]
        self._facing_up = surface.normals[low] @ pose[2, :3]
        sole = np.flatnonzero(self._facing_up < -0.5)
        if len(sole) == 0:
            raise _no_sole()
        self.sole, self.sole_areas = self._low[:, sole], self._areas[sole]
        y = self._low[1]
        self.back = -reach(-y, self._areas)
        self.length = (reach(y, self._areas) - self.back) / covered
        self._shares = (y - self.back) / self.length

    def borders(self, share: float) -> tuple[float, float]:
        """Return medial and lateral x of the outline at a share of the length."""
        away = np.abs(self._shares - share)
        x = self._low[0, away < _BAND] * self.side.medial_sign
        if len(x) == 0:
            x = self._low[0, [away.argmin()]] * self.side.medial_sign
        return float(x.max()) * self.side.medial_sign, float(x.min()) * self.side.medial_sign

    @cached_property
    def heel(self) -> FloatArray:
        """(2,) centre of the heel."""
        x = np.mean([self.borders(share) for share in _HEEL_BANDS])
        return np.array([x, self._y(float(np.mean(_HEEL_BANDS)))])

    @cached_property
    def heads(self) -> tuple[FloatArray, FloatArray]:
        """(2,) each, below the 1st and the 5th metatarsal head."""
        inset = _HEAD_INSET * self.length * self.side.medial_sign
        first = np.array([self.borders(_FIRST_HEAD)[0] - inset, self._y(_FIRST_HEAD)])
        fifth = np.array([self.borders(_FIFTH_HEAD)[1] + inset, self._y(_FIFTH_HEAD)])
        return first, fifth

    @cached_property
    def second_toe(self) -> tuple[FloatArray, bool]:
        """(2,) tip of the 2nd toe, and whether it was found as a separate tip."""
        medial, lateral = self.borders(_BALL_BAND)
        usual = np.array(
            [medial + _SECOND_TOE_ACROSS * (lateral - medial), self.back + self.length]
        )
        if self.toes is None:
            return usual, False
        search = _SECOND_TOE_REACH * abs(lateral - medial)
        if self.toes == "pulps":
            x = pulp_line(self.sole.T, self.sole_areas, self.length, usual, search)
        else:
            x = pulp_line(*self._backs(), self.length, usual, search)
        return (usual, False) if x is None else (np.array([x, usual[1]]), True)

    def _backs(self) -> tuple[FloatArray, FloatArray]:
        """Return points (n, 3) of the back of the foot as if seen from below, and their areas."""
        back = self._facing_up > _BACK_FACING
        return self._low[:, back].T * (1.0, 1.0, -1.0), self._areas[back]

    def height(self, xy: FloatArray) -> float:
        """Compute the mean height of the sole about a position (2,)."""
        x, y, z = self.sole
        far2 = ((x - xy[0]) ** 2 + (y - xy[1]) ** 2) / (_PATCH * self.length) ** 2
        far2 -= far2.min()
        near = np.flatnonzero(far2 < _PATCH_END**2)
        # Noise can turn a piece of the back of the foot upside down.
        near = near[z[near] < z[near].min() + _PATCH_DEPTH_MM]
        weights = self.sole_areas[near] * np.exp(-0.5 * far2[near])
        return float(weights @ z[near] / weights.sum())

    def frame(self) -> FloatArray:
        """Return the transform (4, 4) from the current pose to the frame of the marks."""
        heel, first, fifth = (np.array([*xy, self.height(xy)]) for xy in (self.heel, *self.heads))
        up = np.cross(first - heel, fifth - heel) * self.side.medial_sign
        up /= np.linalg.norm(up)
        toe = np.array([*self.second_toe[0], 0.0])
        ahead = toe - heel
        ahead -= (ahead @ up) * up
        ahead /= np.linalg.norm(ahead)
        rotation = np.stack([np.cross(ahead, up), ahead, up])
        return rigid(rotation, -rotation @ heel)

    def _y(self, share: float) -> float:
        return self.back + share * self.length


def at_origin(mesh: TriangleMesh, source2insole: FloatArray) -> FloatArray:
    """Move a frame so that the lowest vertex lies at z = 0, and the rearmost low one at y = 0.

    Parameters
    ----------
    mesh : mm, source frame
    source2insole : (4, 4) float64, mm

    Returns
    -------
    (4, 4) float64, mm
    """
    y, z = (mesh.vertices @ source2insole[1:3, :3].T + source2insole[1:3, 3]).T
    low = z < z.min() + OUTLINE_HEIGHT_MM
    return rigid(np.eye(3), np.array([0.0, -y[low].min(), -z.min()])) @ source2insole


def is_cut_behind(points: FloatArray) -> bool:
    """Return whether the rear is missing: a heel is round from above, so its end is narrow.

    Parameters
    ----------
    points : (n, 3) float64, mm, insole frame
        Evenly spread over the foot.
    """
    return _is_blunt(points, points[:, 1])


def is_cut_before(points: FloatArray) -> bool:
    """Return whether the toes are missing: one or two of them are the end of a foot.

    Parameters
    ----------
    points : (n, 3) float64, mm, insole frame
        Evenly spread over the foot.
    """
    return _is_blunt(points, -points[:, 1])


def _is_blunt(points: FloatArray, inwards: FloatArray) -> bool:
    low = points[:, 2] < OUTLINE_HEIGHT_MM
    x, depth = points[low, 0], inwards[low] - inwards[low].min()
    end, whole = (np.ptp(x[depth < reach_mm]) for reach_mm in _END_MM)
    return bool(end > _BLUNT * whole)
