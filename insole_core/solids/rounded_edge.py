"""The rounding of an insole's upper edge: an arc of one radius from the wall to the upper side.

A ball of that radius rolls along the wall below the upper side, and its own surface is the edge: it
touches both without a step, however steep the upper side rises to the edge. Where the insole is too
thin for the radius, or so steep that the ball would sink deep below the edge, the ball is smaller.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
import scipy

from insole_core.geometry.arrays import FloatArray, IntArray
from insole_core.insole.primitives.height_field import HeightField
from insole_core.insole.primitives.outline_curve import evenly_spread
from insole_core.messages import Message

_FLATTENED_MM, _LEAST_FACETS = 0.03, 4
"""By how much the facets of a rounded edge may lie inside of it, and how many a quarter has."""
_STEEPEST_DEG = 60.0
"""Of an upper side up to whose touching point the arc has facets of its own."""
_LOWERED = 3.0
"""How far the top of a rounded edge may lie below the sharp one, in asked radii: enough for a full
radius at a steepness of 60 degrees."""
_PITCH_MM, _EVENED_MM = 1.0, 1.5
"""Between the places at which the arc is worked out, and standard deviation over which the rise of
the edge is evened."""
_REACH = 2.0
"""How far from the wall a ball touches the upper side at most, in radii."""
_DEPTHS = np.linspace(0.0, _REACH, 25)
_ACROSS = np.linspace(-0.98, 0.98, 29)
"""Where a ball may touch the upper side, in radii from its centre inwards."""
_SMALLER, _TOLD_MM = 0.85, 1.0
"""Share of the asked radius below which a smaller one is told, and height that is told when the
rounding takes it off the rim."""
_HALVINGS = 8
_TURNS = 4
"""Steps in which a ball comes to lie on a wall that is not upright."""


def edge_contours_mm(radius_mm: float) -> tuple[float, ...]:
    """Return the distances from the outline at which a rounded edge has its facets, ascending."""
    if radius_mm <= _FLATTENED_MM:
        return ()
    half_angle = np.arccos(1 - _FLATTENED_MM / radius_mm)
    step_deg = 90 / max(np.ceil(np.pi / 4 / half_angle), _LEAST_FACETS)
    angles = np.radians(np.arange(step_deg, 90 + _STEEPEST_DEG + 1e-6, step_deg))
    return tuple(float(bend) for bend in radius_mm * (1 - np.cos(angles)))


@dataclass(frozen=True, eq=False)
class EdgePlaces:
    """Positions along an edge, between its places.

    Parameters
    ----------
    before : (n,) int64
        Index of the place before each.
    share : (n,) float64
        Of the way to the next one.
    """

    before: IntArray
    share: FloatArray

    def carry(self, values: FloatArray) -> FloatArray:
        """Interpolate values (m,) at all places of the edge."""
        after = (self.before + 1) % len(values)
        return np.asarray(values[self.before] * (1 - self.share) + values[after] * self.share)


@dataclass(frozen=True, eq=False)
class EdgeArcs:
    """The arcs of a rounded edge, each in the vertical plane across the outline.

    Where the edge rises along the outline, this plane cuts the round obliquely: in an ellipse.

    Parameters
    ----------
    radius_mm, height_mm : (n,) float64
        Half axes across and upwards; the former is the radius of the ball.
    centre_mm, level_mm : (n,) float64
        Distance of the ball's centre from the outline, and its height.
    touch_mm : (n,) float64
        Distance from the outline at which the arc ends on the upper side.
    beyond_mm : (n,) float64
        How far outside of the outline it begins, on a wall that is wider at the bottom.
    sharp_mm : (n,) float64
        Height of the edge without rounding.
    """

    radius_mm: FloatArray
    height_mm: FloatArray
    centre_mm: FloatArray
    level_mm: FloatArray
    touch_mm: FloatArray
    beyond_mm: FloatArray
    sharp_mm: FloatArray

    @property
    def lowered_mm(self) -> FloatArray:
        """(n,) by how much the top of the rounded edge lies below the sharp one."""
        return np.maximum(self.sharp_mm - self.level_mm - self.height_mm, 0.0)

    def on_arc(
        self, at: EdgePlaces, inside_mm: FloatArray, top_mm: FloatArray
    ) -> tuple[FloatArray, FloatArray]:
        """Return heights of vertices on the rounded edge, and how far they move outwards.

        Parameters
        ----------
        at
            Where along the edge the vertices (n,) lie.
        inside_mm, top_mm : (n,) float64
            Their distance from the outline, and their height on the upper side.

        Returns
        -------
        tuple of (n,) float64, mm
        """
        touch = np.maximum(at.carry(self.touch_mm), 1e-9)
        out = at.carry(self.beyond_mm) * np.clip(1 - inside_mm / touch, 0, 1)
        radius = np.maximum(at.carry(self.radius_mm), 1e-9)
        across = np.clip((at.carry(self.centre_mm) - inside_mm + out) / radius, -1, 1)
        height = at.carry(self.level_mm) + at.carry(self.height_mm) * np.sqrt(1 - across**2)
        return np.where(inside_mm < touch, np.minimum(top_mm, height), top_mm), out


@dataclass(frozen=True, eq=False)
class RoundedEdge:
    """What the rounding of an edge depends on beside the body.

    Parameters
    ----------
    radius_mm
        As asked for.
    places_mm, inward : (n, 2) float64
        Evenly along the outline, counter-clockwise, and the unit vectors away from it there.
    """

    radius_mm: float
    places_mm: FloatArray
    inward: FloatArray

    @property
    def reach_mm(self) -> float:
        """How far from the outline the rounding may reach."""
        return _REACH * self.radius_mm

    @classmethod
    def along(cls, outline: FloatArray, radius_mm: float) -> RoundedEdge:
        """Return the rounding along an outline (n, 2), mm, counter-clockwise."""
        length_mm = np.hypot(*(np.roll(outline, -1, axis=0) - outline).T).sum()
        # From the rear end on, as the mirrored outline.
        outline = np.roll(outline, -int(outline[:, 1].argmin()), axis=0)
        places = evenly_spread(outline, max(int(length_mm / _PITCH_MM), 16))
        along = np.roll(places, -1, axis=0) - np.roll(places, 1, axis=0)
        inward = along[:, ::-1] * [-1, 1] / np.maximum(np.hypot(*along.T), 1e-12)[:, None]
        return cls(radius_mm, places, inward)

    def beside(self, points: FloatArray) -> EdgePlaces:
        """Return where along the edge points (n, 2) on the outline lie."""
        _, nearest = scipy.spatial.KDTree(self.places_mm).query(points)
        here = self.places_mm[nearest]
        after, before = (np.roll(self.places_mm, -step, axis=0)[nearest] for step in (1, -1))
        # The same on the mirrored edge, where a point may lie beside both of them.
        onward, back = (_share(points - here, there - here) for there in (after, before))
        first = np.where(back > onward, nearest - 1, nearest) % len(self.places_mm)
        return EdgePlaces(first, np.clip(np.where(back > onward, 1 - back, onward), 0, 1))

    def arcs(
        self,
        lattice: HeightField,
        top_mm: FloatArray,
        bottom_mm: FloatArray,
        draft_deg: FloatArray,
    ) -> EdgeArcs:
        """Roll the ball along the edge of a body.

        Parameters
        ----------
        lattice
            Provides the positions of the nodes.
        top_mm, bottom_mm, draft_deg : (ny, nx) float64
            Of the body, and of the wall that is nearest to each node; a wall that is narrower at
            the bottom is met as a vertical one.
        """
        here = np.zeros(1)
        lower, draft = (
            self._profiles(replace(lattice, heights_mm=heights), here)[:, 0]
            for heights in (bottom_mm, draft_deg)
        )
        tops = self._profiles(replace(lattice, heights_mm=top_mm), _DEPTHS * self.radius_mm)
        bed = _Bed(tops, _REACH * self.radius_mm, self._rise(tops[:, 0]), np.radians(draft))
        radius = np.minimum(self.radius_mm, bed.thickness_mm(tops[:, 0] - lower) / 2)
        most_mm = _LOWERED * self.radius_mm
        deep = np.flatnonzero(bed.arcs(radius).lowered_mm > most_mm)
        radius[deep] = bed.only(deep).largest(radius[deep], most_mm)
        return bed.arcs(radius)

    def notes(self, arcs: EdgeArcs) -> tuple[Message, ...]:
        """Say where the edge is not rounded as asked for, and where that lowers the rim much."""
        notes = []
        least, deepest = int(arcs.radius_mm.argmin()), int(arcs.lowered_mm.argmax())
        if arcs.radius_mm[least] < _SMALLER * self.radius_mm:
            notes.append(
                Message(
                    "The edge is rounded by {least_mm:.1f} mm instead of {radius_mm:g} mm where "
                    "the insole is too thin or its rim too steep for more, most at x = {x_mm:.0f} "
                    "mm, y = {y_mm:.0f} mm, and less than asked for over {share:.0%} of its "
                    "length.",
                    least_mm=float(arcs.radius_mm[least]),
                    radius_mm=self.radius_mm,
                    share=float((arcs.radius_mm < _SMALLER * self.radius_mm).mean()),
                    **self._place(least),
                )
            )
        if arcs.lowered_mm[deepest] > _TOLD_MM:
            notes.append(
                Message(
                    "Rounding a steep rim takes up to {lowered_mm:.1f} mm off its height, most at "
                    "x = {x_mm:.0f} mm, y = {y_mm:.0f} mm; design the rim higher by as much, or "
                    "make the edge radius smaller, if its height counts.",
                    lowered_mm=float(arcs.lowered_mm[deepest]),
                    **self._place(deepest),
                )
            )
        return tuple(notes)

    def _place(self, at: int) -> dict[str, float]:
        x, y = self.places_mm[at]
        return {"x_mm": float(x), "y_mm": float(y)}

    def _profiles(self, field: HeightField, depths_mm: FloatArray) -> FloatArray:
        """Return heights (n, k) at distances (k,) from the outline."""
        points = self.places_mm[:, None] + self.inward[:, None] * depths_mm[:, None]
        low = [field.x_mm[0], field.y_mm[0]]
        return field.height_at(np.clip(points, low, [field.x_mm[-1], field.y_mm[-1]]))

    def _rise(self, heights_mm: FloatArray) -> FloatArray:
        """Return the slope of heights (n,) along the outline."""
        ahead = np.hypot(*(np.roll(self.places_mm, -1, axis=0) - self.places_mm).T)
        climb = np.roll(heights_mm, -1) - np.roll(heights_mm, 1)
        slope = climb / np.maximum(ahead + np.roll(ahead, 1), 1e-12)
        sigma = _EVENED_MM / max(float(ahead.mean()), 1e-12)
        return np.asarray(scipy.ndimage.gaussian_filter1d(slope, sigma, mode="wrap"))


@dataclass(frozen=True, eq=False)
class _Bed:
    """The upper side across the outline and the wall, between which a ball comes to lie.

    Parameters
    ----------
    tops_mm : (n, k) float64
        Heights at even distances from the outline, from 0 to `depth_mm`.
    rise, tilt : (n,) float64
        Slope of the edge along the outline; angle of the wall from the vertical, radians.
    """

    tops_mm: FloatArray
    depth_mm: float
    rise: FloatArray
    tilt: FloatArray

    def only(self, chosen: IntArray) -> _Bed:
        return replace(
            self, tops_mm=self.tops_mm[chosen], rise=self.rise[chosen], tilt=self.tilt[chosen]
        )

    def thickness_mm(self, wall_mm: FloatArray) -> FloatArray:
        """Return the thickness (n,) across the upper side where walls have a height (n,)."""
        slope = (self.tops_mm[:, 0] - self.tops_mm[:, -1]) / self.depth_mm
        return wall_mm / np.sqrt(1 + slope**2 + self.rise**2)

    def largest(self, radius_mm: FloatArray, most_lowered_mm: float) -> FloatArray:
        """Return the largest radii (n,) up to these whose edges are not lowered by more."""
        low, high = np.zeros_like(radius_mm), radius_mm
        for _ in range(_HALVINGS):
            middle = (low + high) / 2
            deep = self.arcs(middle).lowered_mm > most_lowered_mm
            low, high = np.where(deep, low, middle), np.where(deep, middle, high)
        return low

    def arcs(self, radius_mm: FloatArray) -> EdgeArcs:
        """Lay balls (n,) between upper side and wall."""
        tilt = np.maximum(self.tilt, 0)
        height = radius_mm * np.hypot(1, self.rise)
        reach = np.hypot(radius_mm * np.cos(tilt), height * np.sin(tilt))
        sharp, centre = self.tops_mm[:, 0], (reach - height * np.sin(tilt)) / np.cos(tilt)
        for _ in range(_TURNS if tilt.any() else 1):
            level, across = self._under(centre, radius_mm, height)
            slope = height / np.maximum(radius_mm, 1e-9) * across / np.sqrt(1 - across**2)
            off = centre * np.cos(tilt) - reach + (sharp - level) * np.sin(tilt)
            centre = centre - off / np.maximum(np.cos(tilt) + slope * np.sin(tilt), 0.1)
        level, across = self._under(centre, radius_mm, height)
        begin = np.arctan2(height * np.sin(tilt), radius_mm * np.cos(tilt))
        beyond = np.maximum(radius_mm * np.cos(begin) - centre, 0)
        touch = centre + across * radius_mm
        return EdgeArcs(radius_mm, height, centre, level, touch, beyond, sharp)

    def _under(
        self, centre_mm: FloatArray, radius_mm: FloatArray, height_mm: FloatArray
    ) -> tuple[FloatArray, FloatArray]:
        """Return how high balls (n,) rise below the upper side, and where they touch it.

        The latter is counted from their centres inwards, in radii, and is below 1.
        """
        inwards = centre_mm[:, None] + radius_mm[:, None] * _ACROSS
        step = inwards / self.depth_mm * (self.tops_mm.shape[1] - 1)
        before = np.clip(step.astype(int), 0, self.tops_mm.shape[1] - 2)
        share = np.clip(step - before, 0, 1)
        row = np.arange(len(before))[:, None]
        tops = self.tops_mm[row, before] * (1 - share) + self.tops_mm[row, before + 1] * share
        room = tops - height_mm[:, None] * np.sqrt(1 - _ACROSS**2)
        at = room.argmin(axis=1)
        return room[row[:, 0], at], _ACROSS[at]


def _share(offsets: FloatArray, onward: FloatArray) -> FloatArray:
    """Return where on the way to the next place offsets (n, 2) from a place end, 0 to 1."""
    return np.asarray((offsets * onward).sum(axis=1) / np.maximum((onward**2).sum(axis=1), 1e-12))
