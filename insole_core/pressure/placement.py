"""Where a map or a picture lies under a foot: a rigid placement in the insole frame."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.transforms import transform


@dataclass(frozen=True)
class Placement:
    """Where the frame of a map lies in the insole frame, seen from above.

    The frame of a map has its origin in the middle, +x to the right and +y to the first row.

    Parameters
    ----------
    x_mm, y_mm
        Of the map's middle.
    turn_deg
        Counter-clockwise.
    mirrored
        Whether the map shows the foot from below: left and right are exchanged first.
    """

    x_mm: float = 0.0
    y_mm: float = 0.0
    turn_deg: float = 0.0
    mirrored: bool = False

    @property
    def middle_mm(self) -> FloatArray:
        """(2,) middle of the map, insole frame."""
        return np.array([self.x_mm, self.y_mm])

    def to_insole(self, points: FloatArray) -> FloatArray:
        """Transform points (n, 2) of the map, mm, to the insole frame."""
        return np.asarray(points * self._mirror @ self._turn.T + self.middle_mm)

    def to_map(self, points: FloatArray) -> FloatArray:
        """Transform points (n, 2) of the insole frame, mm, to the map."""
        return np.asarray((points - self.middle_mm) @ self._turn * self._mirror)

    def moved(self, x_mm: float, y_mm: float) -> Placement:
        """Return the placement moved by a way."""
        return replace(self, x_mm=self.x_mm + x_mm, y_mm=self.y_mm + y_mm)

    def turned(self, turn_deg: float, about: FloatArray) -> Placement:
        """Return the placement turned about a point (2,) of the insole frame."""
        turn = _rotation(turn_deg)
        x, y = (float(value) for value in turn @ (self.middle_mm - about) + about)
        return Placement(x, y, _wrapped(self.turn_deg + turn_deg), self.mirrored)

    def with_foot(self, step: FloatArray) -> Placement:
        """Return the placement on a foot that was laid anew.

        Parameters
        ----------
        step : (4, 4) float64
            From the insole frame before to the one after.
        """
        corners = np.array([[self.x_mm, self.y_mm, 0.0], [self.x_mm, self.y_mm, 0.0]])
        corners[1, :2] += self._turn @ [0.0, 100.0]
        (x, y, _), (ahead_x, ahead_y, _) = transform(step, corners)
        turn_deg = float(np.degrees(np.arctan2(x - ahead_x, ahead_y - y)))
        return replace(self, x_mm=float(x), y_mm=float(y), turn_deg=turn_deg)

    def rounded(self) -> Placement:
        """Return the placement in steps of 0.01 mm and 0.01°."""
        return replace(
            self,
            x_mm=round(self.x_mm, 2),
            y_mm=round(self.y_mm, 2),
            turn_deg=round(_wrapped(self.turn_deg), 2),
        )

    @property
    def _mirror(self) -> FloatArray:
        return np.array([-1.0 if self.mirrored else 1.0, 1.0])

    @property
    def _turn(self) -> FloatArray:
        return _rotation(self.turn_deg)


def _rotation(turn_deg: float) -> FloatArray:
    cos, sin = np.cos(np.radians(turn_deg)), np.sin(np.radians(turn_deg))
    return np.array([[cos, -sin], [sin, cos]])


def _wrapped(turn_deg: float) -> float:
    return (turn_deg + 180.0) % 360.0 - 180.0
