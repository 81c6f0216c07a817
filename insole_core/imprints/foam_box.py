"""Find the imprints of feet in the scan of a foam box, and cut them out as soles.

Foam that was pressed down keeps the form of the sole, so the surface of an imprint is that of the
sole itself, neither mirrored nor turned: only its triangles face into the foot. Around the imprint
lies a rim of undisturbed foam, which says where the back of the foot is. Both together leave only
heel and toes to be told apart.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy

from insole_core.geometry.arrays import BoolArray, FloatArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.mesh_graph import pieces, relaxed
from insole_core.geometry.sampling import area_samples
from insole_core.geometry.sections import cut_off
from insole_core.geometry.transforms import transform
from insole_core.imprints.planes import Plane, large_planes
from insole_core.imprints.relief import (
    PressedRegion,
    Relief,
    ReliefViewer,
    curled_over,
    pressed_regions,
)

_SAMPLES = 4000
_LEAST_RIM_MM2 = 3000.0
_ABOVE_MM, _MOST_ABOVE = 15.0, 0.02
"""Share of the surface that may lie higher than this over the rim."""
_BUMP_MM, _FLAT = 45.0, 0.5
"""Greatest height of a sole that stands out of a plane, and least share of it that is sole."""

_RIM_MM = 2.5
"""Depth from which on the foam was pressed down; above it lies rim, with its noise and waves."""
_BESIDE_MM = 40.0  # how far an imprint reaches beyond the region in which it was recognised
_UNDER_MM, _UNDER_NODES = 5.0, 5
_LEAST_PIECE = 0.005
_TOE_MM, _TOE_SHARE, _TOE_MM2 = 3.5, 0.3, 4000.0
"""Radius of a disk that fits into the imprint of any toe, how much of it such disks cover at least,
and the greatest area of all toes."""
_HEIGHT_ROUNDS = 2
_GRAIN_MM, _GRAIN_ROUNDS, _MOST_ROUNDS = 1.0, 6, 20
"""Distance of points at which the grain of foam and scanner is smoothed in so many rounds."""


@dataclass(frozen=True, eq=False)
class Imprint:
    """The imprint of one foot as its sole.

    Parameters
    ----------
    mesh : mm, source frame
        Open; its triangles face out of the foot, into the foam.
    dorsal : (3,) float64
        Unit vector out of the box, towards the back of the foot.
    rim_mm
        Height of the rim: the points on it have this product with `dorsal`.
    centre : (3,) float64, mm, source frame
    depth_mm
        Of the deepest part below the rim.
    """

    mesh: TriangleMesh
    dorsal: FloatArray
    rim_mm: float
    centre: FloatArray
    depth_mm: float


@dataclass(frozen=True, eq=False)
class BoxScan:
    """What was found in the scan of a foam box.

    Parameters
    ----------
    imprints
        Of one foot, or of both.
    is_hollow
        Whether the triangles face out of the foam; otherwise the file shows a sole that stands out
        of a plane, unless it is inside out.
    """

    imprints: tuple[Imprint, ...]
    is_hollow: bool


@dataclass(frozen=True, eq=False)
class _View:
    relief: Relief
    regions: list[PressedRegion]

    @property
    def is_hollow(self) -> bool:
        return sum(region.facing for region in self.regions) > 0

    @property
    def is_plausible(self) -> bool:
        """Whether what stands out of a plane, if it does, can be a sole."""
        return self.is_hollow or all(
            region.depth_mm < _BUMP_MM and region.flatness > _FLAT for region in self.regions
        )

    @property
    def rank(self) -> tuple[bool, float]:
        return self.is_hollow, sum(float(region.mask.sum()) for region in self.regions)


def find_imprints(mesh: TriangleMesh) -> BoxScan | None:
    """Find imprints of feet in a surface.

    Parameters
    ----------
    mesh : mm, source frame
        In any pose; open, or a closed block. Its triangles face as in the file.

    Returns
    -------
    BoxScan or None
        None where no foot is pressed below a rim.
    """
    points, _ = area_samples(mesh, mesh.area_mm2 / _SAMPLES)
    sides = [
        (plane, sign)
        for plane in large_planes(points)
        for sign in (1, -1)
        if _can_be_rim(plane, sign, points, mesh.area_mm2)
    ]
    if not sides:
        return None
    viewer = ReliefViewer(mesh)
    reliefs = (viewer.relief(plane, sign) for plane, sign in sides)
    views = [_View(relief, pressed_regions(relief)) for relief in reliefs]
    views = [view for view in views if view.regions and view.is_plausible]
    if not views:
        return None
    view = max(views, key=lambda one: one.rank)
    numbers = range(len(view.regions))
    imprints = tuple(_imprint(mesh, viewer, view, number) for number in numbers)
    return BoxScan(imprints, view.is_hollow)


def _can_be_rim(plane: Plane, sign: int, points: FloatArray, area_mm2: float) -> bool:
    above = float((sign * plane.heights(points) > _ABOVE_MM).mean())
    return plane.share * area_mm2 > _LEAST_RIM_MM2 and above < _MOST_ABOVE


def _imprint(mesh: TriangleMesh, viewer: ReliefViewer, view: _View, number: int) -> Imprint:
    """Cut one imprint out below the edge where the foam curls over, and turn it into a sole."""
    relief, region = view.relief, view.regions[number]
    detail = viewer.detail(relief, region.mask, _BESIDE_MM)
    local = transform(relief.source2relief, mesh.vertices)
    places, heights = local[:, :2], local[:, 2]
    uppermost = heights > _lowest_nearby(detail, places) - _UNDER_MM
    for _ in range(_HEIGHT_ROUNDS):
        heights = np.asarray(mesh.links.mean @ heights)
    curled = curled_over(detail)
    inside = np.minimum(_within(view, number, places), _away_from(curled, detail, places))
    field = np.where(uppermost, np.minimum(-heights - _RIM_MM, inside), -1.0)
    sole = _of_foot(cut_off(mesh, field), view, number, detail, curled)
    if float(sole.vertex_areas @ (sole.vertex_normals @ relief.up)) > 0:
        sole = sole.flipped()
    centre = sole.vertex_areas @ sole.vertices / sole.area_mm2
    rim_mm = -float(relief.source2relief[2, 3])
    return Imprint(_without_grain(sole), relief.up, rim_mm, centre, region.depth_mm)


def _within(view: _View, number: int, places: FloatArray) -> FloatArray:
    """Return how far places (n, 2) lie inside the surroundings of one region, mm; < 0 outside.

    Two regions divide what lies between them.
    """
    relief = view.relief
    away = [
        scipy.ndimage.distance_transform_edt(~region.mask) * relief.cell_mm
        for region in view.regions
    ]
    own = away.pop(number)
    inside = np.minimum.reduce([_BESIDE_MM - own, *((other - own) / 2 for other in away)])
    return relief.at(inside, places, beyond=-1.0)


def _lowest_nearby(relief: Relief, places: FloatArray) -> FloatArray:
    """Return the lowest of the uppermost surface about places (n, 2): below it all is hidden."""
    heights = np.where(np.isnan(relief.heights_mm), np.inf, relief.heights_mm)
    lowest = scipy.ndimage.minimum_filter(heights, _UNDER_NODES)
    return relief.at(np.where(np.isfinite(lowest), lowest, -1e3), places, beyond=-1e3)


def _away_from(curled: BoolArray, detail: Relief, places: FloatArray) -> FloatArray:
    """Return how far places (n, 2) lie from where the foam curls over, mm; not above 0 there."""
    away_mm = scipy.ndimage.distance_transform_edt(~curled) * detail.cell_mm
    return detail.at(away_mm - detail.cell_mm / 2, places, beyond=-1.0)


def _of_foot(
    sole: TriangleMesh, view: _View, number: int, detail: Relief, curled: BoolArray
) -> TriangleMesh:
    """Keep the pieces of the region, and those beside it that a toe can have pressed."""
    local = transform(detail.source2relief, sole.vertices)[:, :2]
    known = view.relief.at(view.regions[number].mask.astype(float), local, beyond=0.0) > 0.5
    toes = detail.at(_toe_like(detail, curled).astype(float), local, beyond=0.0) > 0.5
    count, piece = pieces(sole)
    area, in_region, in_toes = (
        np.bincount(piece, sole.vertex_areas * inside, minlength=count)
        for inside in (True, known, toes)
    )
    kept = ((in_region > area / 2) & (area > _LEAST_PIECE * area.sum())) | (
        in_toes > _TOE_SHARE * area
    )
    return sole.part(kept[piece])


def _toe_like(detail: Relief, curled: BoolArray) -> BoolArray:
    """Return the nodes in hollows as wide as a toe: foam that was dragged down is a narrow strip.

    What reaches the edge of the relief is beside the box.
    """
    low = ~curled & ~(detail.heights_mm > -_RIM_MM)
    radius_mm = scipy.ndimage.distance_transform_edt(low) * detail.cell_mm
    broad = scipy.ndimage.distance_transform_edt(radius_mm < _TOE_MM) * detail.cell_mm < _TOE_MM
    parts, count = scipy.ndimage.label(broad)
    size = np.bincount(parts.ravel(), minlength=count + 1) * detail.cell_mm**2
    beside = np.zeros(count + 1, dtype=bool)
    beside[[*parts[[0, -1]].ravel(), *parts[:, [0, -1]].ravel()]] = True
    return np.asarray(((size < _TOE_MM2) & ~beside)[parts] & (parts > 0))


def _without_grain(sole: TriangleMesh) -> TriangleMesh:
    """Smooth what is finer than skin; a surface whose points lie far apart has nothing so fine."""
    edges = sole.links.edges[0]
    length_mm = np.linalg.norm(np.diff(sole.vertices[edges], axis=1)[:, 0], axis=1)
    rounds = _GRAIN_ROUNDS * (_GRAIN_MM / max(float(np.median(length_mm)), 1e-3)) ** 2
    moved = relaxed(sole, min(round(rounds), _MOST_ROUNDS))
    return TriangleMesh(moved, sole.triangles, sole.colors)
