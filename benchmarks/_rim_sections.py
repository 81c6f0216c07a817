"""The radius of an insole's rim, measured from its STL: circles through sections across the rim.

Written without the code that rounds it. A section is taken every few millimetres of the silhouette,
in the plane normal to the rim there, which rises and falls.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import manifold3d
import numpy as np
import numpy.typing as npt
from scipy.spatial import KDTree

_Array = npt.NDArray[np.float64]
_REACH_MM, _BESIDE_MM, _LEAST_MM, _TURN_DEG = 9.0, 2.5, 0.004, 8.0
_RECORD = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])


@dataclass(frozen=True)
class RimSection:
    """What a section across the rim shows.

    Parameters
    ----------
    place_mm
        x, y and height of the rim.
    radius_mm
        Of the circle through the section between wall and upper side; 0 for a sharp edge.
    thickness_mm
        From where the circle ends on the upper side, straight through the solid.
    """

    place_mm: tuple[float, float, float]
    radius_mm: float
    thickness_mm: float

    def is_asked(self, asked_mm: float, within: float = 0.15) -> bool:
        """Whether the radius is that asked for, or half of the thickness where that is less."""
        fits = min(asked_mm, self.thickness_mm / 2)
        return (1 - within) * fits <= self.radius_mm <= (1 + within) * asked_mm


def rim_sections(path: Path, asked_mm: float, every_mm: float = 5.0) -> Iterator[RimSection]:
    """Yield the sections of a binary STL with an insole that is narrower at no height."""
    corners = np.frombuffer(path.read_bytes()[84:], dtype=_RECORD)["corners"].astype(float)
    edge = _even(_silhouette(corners), every_mm)
    ahead = np.roll(edge, -1, axis=0) - np.roll(edge, 1, axis=0)
    along = ahead / np.hypot(*ahead.T)[:, None]
    tree = KDTree(corners.mean(axis=1)[:, :2])
    near = [corners[tree.query_ball_point(place, _REACH_MM)] for place in edge]
    crest = np.array([_crest(*each) for each in zip(near, edge, along, strict=True)])
    rise = (np.roll(crest, -1) - np.roll(crest, 1)) / np.hypot(*ahead.T)
    for place, way, height, slope, triangles in zip(edge, along, crest, rise, near, strict=True):
        origin, inward = np.array([*place, height]), np.array([-way[1], way[0], 0.0])
        profile = _profile(triangles, origin, np.array([*way, slope]), inward)
        radius, thickness = _measured(profile, asked_mm)
        yield RimSection((float(place[0]), float(place[1]), float(height)), radius, thickness)


def _silhouette(corners: _Array) -> _Array:
    vertices, number = np.unique(corners.reshape(-1, 3), axis=0, return_inverse=True)
    mesh = manifold3d.Mesh(vertices.astype(np.float32), number.reshape(-1, 3).astype(np.uint32))
    polygons = manifold3d.Manifold(mesh).project().to_polygons()
    return max((np.array(each, float) for each in polygons), key=lambda p: np.ptp(p[:, 1]))


def _even(polygon: _Array, every_mm: float) -> _Array:
    """Return points of a polygon at even distances; those of manifold3d go counter-clockwise."""
    closed = np.vstack([polygon, polygon[:1]])
    way = np.concatenate([[0], np.cumsum(np.hypot(*np.diff(closed, axis=0).T))])
    at = np.linspace(0, way[-1], int(way[-1] / every_mm), endpoint=False)
    return np.column_stack([np.interp(at, way, axis) for axis in closed.T])


def _crest(triangles: _Array, place: _Array, along: _Array) -> float:
    """Return the height of the rim at a place of the silhouette."""
    ends = _cut(triangles, np.array([*place, 0.0]), np.array([*along, 0.0]))
    inside = (ends[..., :2] - place) @ [-along[1], along[0]]
    return float(ends[..., 2][np.abs(inside) < 1.0].max())


def _cut(triangles: _Array, origin: _Array, normal: _Array) -> _Array:
    """Return the segments (n, 2, 3) in which a plane cuts triangles."""
    over = (triangles - origin) @ normal
    over = np.where(np.abs(over) < 1e-9, 1e-9, over)
    parts = []
    for a, b, c in ((0, 1, 2), (1, 2, 0), (2, 0, 1)):
        alone = (over[:, a] > 0) != (over[:, b] > 0)
        alone &= (over[:, a] > 0) != (over[:, c] > 0)
        ends = [_crossing(triangles[alone], over[alone], a, k) for k in (b, c)]
        parts.append(np.stack(ends, axis=1))
    return np.concatenate(parts)


def _crossing(triangles: _Array, over: _Array, a: int, b: int) -> _Array:
    """Return where edges cross a plane, from above it, so that neighbours have the same point."""
    swap = (over[:, a] < 0)[:, None]
    first = np.where(swap, triangles[:, b], triangles[:, a])
    last = np.where(swap, triangles[:, a], triangles[:, b])
    high = np.where(swap[:, 0], over[:, b], over[:, a])[:, None]
    low = np.where(swap[:, 0], over[:, a], over[:, b])[:, None]
    return np.asarray(first + high / (high - low) * (last - first))


def _profile(triangles: _Array, origin: _Array, along: _Array, inward: _Array) -> _Array:
    """Return the section (n, 2) about an origin, inwards and upwards: from below, over the rim."""
    along = along / np.linalg.norm(along)
    across = inward - along * (inward @ along)
    across /= np.linalg.norm(across)
    up = np.cross(along, across)
    lines = [
        np.column_stack([(line - origin) @ across, (line - origin) @ up])
        for line in _lines(_cut(triangles, origin, along))
    ]
    line = min(lines, key=lambda line: float(np.hypot(*line.T).min()))
    far = np.concatenate([[True], np.hypot(*np.diff(line, axis=0).T) > _LEAST_MM])
    line = line[far]
    way = np.concatenate([[0], np.cumsum(np.hypot(*np.diff(line, axis=0).T))])
    top = way[(line[:, 1] - line[:, 0]).argmax()]
    before, after = np.interp([top - _BESIDE_MM, top + _BESIDE_MM], way, line[:, 0])
    return np.asarray(line[::-1] if before > after else line)


def _lines(segments: _Array) -> Iterator[_Array]:
    """Yield the lines (n, 3) that segments which share their ends make together."""
    keys = [[tuple(end) for end in segment] for segment in np.round(segments, 5).tolist()]
    at: dict[tuple[float, ...], list[int]] = {}
    for number, ends in enumerate(keys):
        for end in ends:
            at.setdefault(end, []).append(number)
    starts = [found[0] for found in at.values() if len(found) == 1]
    used: set[int] = set()
    for number in (*starts, *range(len(keys))):
        if number in used:
            continue
        first = 0 if len(at[keys[number][0]]) == 1 else 1
        end, line = keys[number][first], [keys[number][first]]
        following: int | None = number
        while following is not None:
            used.add(following)
            a, b = keys[following]
            end = b if a == end else a
            line.append(end)
            following = next((each for each in at[end] if each not in used), None)
        yield np.array(line)


def _measured(line: _Array, asked_mm: float) -> tuple[float, float]:
    """Return the radius of the rim in a section, and the thickness behind it."""
    step = np.diff(line, axis=0)
    length, turned = np.hypot(*step.T), np.degrees(np.arctan2(step[:, 0], step[:, 1]))
    way = np.concatenate([[0], np.cumsum(length)])
    top = int((line[:, 1] - line[:, 0]).argmax())
    outer = np.flatnonzero((way[1:] > way[top] - 3 * asked_mm) & (np.abs(turned) < 30))
    outer = outer[outer <= top]
    # A wall may be cut into several sides of one direction.
    alike = np.abs(turned[outer, None] - turned[outer]) < 3
    wall = max(top - 1, 0)
    if len(outer):
        wall = int(outer[alike[(alike @ length[outer]).argmax()]].max())
    behind = min(int(np.searchsorted(way, way[top] + 2.7 * asked_mm)), len(step) - 1)
    arc_mm = 0.8 * asked_mm * np.radians(max(turned[behind] - turned[wall], 10.0))
    bent = [
        side
        for side in range(wall + 1, behind)
        if turned[wall] + _TURN_DEG < turned[side] < turned[behind] - _TURN_DEG
    ]
    round_ = [side for side in bent if way[side] - way[bent[0]] < arc_mm]
    last = round_[-1] + 1 if round_ else top
    thickness = _through(line, last, turned[min(last, len(step) - 1)])
    if len(round_) < 2:
        return 0.0, thickness
    return _circle(line[round_[0] : last + 1]), thickness


def _through(line: _Array, at: int, turned_deg: float) -> float:
    """Return how far a straight line into the solid goes from a vertex of its section."""
    angle = np.radians(turned_deg)
    inwards, beside = (
        np.array([np.cos(angle), -np.sin(angle)]),
        np.array([np.sin(angle), np.cos(angle)]),
    )
    deep, off = (line - line[at]) @ inwards, (line - line[at]) @ beside
    crossed = np.flatnonzero((off[:-1] > 0) != (off[1:] > 0))
    share = off[crossed] / (off[crossed] - off[crossed + 1])
    depths = deep[crossed] + share * (deep[crossed + 1] - deep[crossed])
    depths = depths[depths > 0.1]
    return float(depths.min()) if len(depths) else np.inf


def _circle(points: _Array) -> float:
    """Return the radius of the circle through points (n, 2), by least squares."""
    known = np.column_stack([2 * points, np.ones(len(points))])
    (x, y, rest), *_ = np.linalg.lstsq(known, (points**2).sum(axis=1), rcond=None)
    return float(np.sqrt(rest + x * x + y * y))
