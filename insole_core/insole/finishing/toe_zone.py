"""The zone in front of the metatarsal heads, a designed floor instead of the toes' imprint."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from insole_core.foot.foot import Foot
from insole_core.foot.landmarks import HEADS, TOE_TIPS, find_landmarks
from insole_core.geometry.arrays import BoolArray, FloatArray
from insole_core.insole.finishing.edge_distance import EdgeDistance
from insole_core.insole.prescription.finish import Finish
from insole_core.insole.primitives.blending import smoother_step
from insole_core.insole.primitives.outline_curve import inside_curve

_TRANSITION_MM, _SULCUS_TRANSITION_MM = 14.0, 18.0
"""From the toe line to where the floor of the toes is reached, and the lower one of a sulcus."""
_LEVEL_MM = (0.0, 6.0)  # ahead of the heads: the strip whose median height is the toes' level
_LEAST_NODES = 20
_SULCUS_DEPTH_MM, _SULCUS_MM = 4.0, (4.0, 13.5)
"""How deep a sulcus is, and where ahead of the heads it falls (Telfer, Offloading_Insoles)."""
_CREST_MM, _CREST_HALF_MM = 4.0, 15.0
_CREST_PLACE = 0.45  # share of the way from the heads 2 to 4 to the tips of their toes
_CREST_TOES = (0.15, 0.35)  # shares of the ball's width from the 1st head: the big toe lies free
_PITCH_MM = 2.0


@dataclass(frozen=True, eq=False)
class HeadsParabola:
    """A parabola y(x) fitted to the five heads of a foot, insole frame, mm.

    Parameters
    ----------
    coefficients : (3,) float64
        Of y over x towards medial, the highest power first, so that a mirrored foot has the same.
    medial_sign
        Sign of the insole frame's x on the medial side.
    """

    coefficients: FloatArray
    medial_sign: float

    @classmethod
    def of(cls, foot: Foot) -> HeadsParabola:
        """Fit the parabola to a foot's landmarks."""
        landmarks, sign = find_landmarks(foot), foot.side.medial_sign
        heads = np.array([landmarks[name].point[:2] for name in HEADS]) * [sign, 1.0]
        return cls(np.polyfit(heads[:, 0], heads[:, 1], 2), sign)

    def ahead_mm(self, x_mm: FloatArray, y_mm: FloatArray) -> FloatArray:
        """Return how far places lie ahead of the parabola, to first order normal to it."""
        y0_mm, steepness = self._at(x_mm)
        return np.asarray((y_mm - y0_mm) / steepness)

    def line_y_mm(self, x_mm: FloatArray, ahead_mm: float) -> FloatArray:
        """Return y of the places that lie a given distance ahead: there `ahead_mm` returns it."""
        y0_mm, steepness = self._at(x_mm)
        return np.asarray(y0_mm + ahead_mm * steepness)

    def _at(self, x_mm: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return y on the parabola, and the length of its tangent for a step of 1 in x."""
        medial_mm = self.medial_sign * x_mm
        slope = np.polyval(np.polyder(self.coefficients), medial_mm)
        y0_mm = np.asarray(np.polyval(self.coefficients, medial_mm), float)
        return y0_mm, np.hypot(1.0, np.asarray(slope, float))


@dataclass(frozen=True, eq=False)
class ToeZone:
    """The toes' part of an insole.

    Parameters
    ----------
    ahead_mm : (ny, nx) float64
        How far each node lies ahead of the `HeadsParabola`.
    level_mm
        On which the toes lie: the median of the contact surface just ahead of the heads, less the
        depth of a sulcus.
    floor_mm : (ny, nx) float64
        Heights of the designed floor.
    begin_mm, end_mm
        How far ahead of the heads the contact surface ends and the floor begins; inf where the
        toes stay as scanned.
    """

    ahead_mm: FloatArray
    level_mm: float
    floor_mm: FloatArray
    begin_mm: float
    end_mm: float

    @property
    def contact(self) -> BoolArray:
        """(ny, nx) nodes that keep the contact surface."""
        return np.asarray(self.ahead_mm <= self.begin_mm)

    @property
    def floor(self) -> BoolArray:
        """(ny, nx) nodes on the designed floor."""
        return np.asarray(self.ahead_mm >= self.end_mm)

    def joined(self, contact_mm: FloatArray) -> FloatArray:
        """Return contact surface and floor with a plain transition: what the plate aims at."""
        if not np.isfinite(self.end_mm):
            return contact_mm
        share = smoother_step(self.ahead_mm, self.begin_mm, self.end_mm)
        return np.asarray(contact_mm + share * (self.floor_mm - contact_mm))


def toe_zone(
    foot: Foot, place: EdgeDistance, contact_mm: FloatArray, measured: BoolArray, finish: Finish
) -> ToeZone:
    """Design the toe zone of a contact surface.

    Parameters
    ----------
    contact_mm : (ny, nx) float64
        Heights of the contact surface.
    measured : (ny, nx) bool
        Nodes where the foot was measured.
    """
    parabola = HeadsParabola.of(foot)
    ahead_mm = parabola.ahead_mm(place.x_mm, place.y_mm)
    level_mm = _level_mm(ahead_mm, contact_mm, measured & (place.inside_mm > 0))
    floor_mm = np.full(ahead_mm.shape, level_mm)
    if finish.toe_zone == "sulcus":
        floor_mm = level_mm - _SULCUS_DEPTH_MM * smoother_step(ahead_mm, *_SULCUS_MM)
        level_mm -= _SULCUS_DEPTH_MM
    elif finish.toe_zone == "crest":
        medial = foot.side.medial_sign
        heads_mm = medial * _places(foot, HEADS)[:, 0]
        reach_mm = parabola.ahead_mm(*_places(foot, TOE_TIPS)[1:4].T).mean()
        aside = (heads_mm[0] - medial * place.x_mm) / max(heads_mm[0] - heads_mm[-1], 1.0)
        across = smoother_step(aside, *_CREST_TOES)
        away = np.abs(ahead_mm - _CREST_PLACE * reach_mm) / _CREST_HALF_MM
        floor_mm = level_mm + _CREST_MM * across * (1 - smoother_step(away, 0.0, 1.0))
    transition_mm = _SULCUS_TRANSITION_MM if finish.toe_zone == "sulcus" else _TRANSITION_MM
    begin, end = finish.toe_line_mm, finish.toe_line_mm + transition_mm
    if finish.toe_zone == "as_scanned":
        begin = end = np.inf
    return ToeZone(ahead_mm, level_mm, floor_mm, begin, end)


def _places(foot: Foot, names: tuple[str, ...]) -> FloatArray:
    """Return landmarks (k, 2), mm, insole frame."""
    landmarks = find_landmarks(foot)
    return np.array([landmarks[name].point[:2] for name in names])


def _level_mm(ahead_mm: FloatArray, contact_mm: FloatArray, on_foot: BoolArray) -> float:
    """Return the median height just ahead of the heads; of a foot that ends before, at its end."""
    low, high = _LEVEL_MM
    strip = on_foot & (ahead_mm > low) & (ahead_mm < high)
    if strip.sum() < _LEAST_NODES and on_foot.any():
        foremost = ahead_mm[on_foot].max()
        strip = on_foot & (ahead_mm > foremost - (high - low))
    return float(np.median(contact_mm[strip])) if strip.any() else float(contact_mm.min())


def toe_line(foot: Foot, outline: FloatArray, ahead_mm: float) -> FloatArray:
    """Return the places a given distance ahead of the parabola through the heads.

    Parameters
    ----------
    outline : (n, 2) float64, mm, insole frame
        Of the insole, which the line does not leave.
    ahead_mm
        As `Finish.toe_line_mm`.

    Returns
    -------
    (m, 2) float64, mm, insole frame
        In ascending x; none where the line lies ahead of the whole insole.
    """
    low, high = outline[:, 0].min(), outline[:, 0].max()
    x = np.linspace(low, high, max(2, round((high - low) / _PITCH_MM)))
    line = np.column_stack([x, HeadsParabola.of(foot).line_y_mm(x, ahead_mm)])
    return np.asarray(line[inside_curve(outline, line)])
