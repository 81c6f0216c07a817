"""A surface over a plane: its relief, the regions pressed into it, and the edge that curls."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy

from insole_core.geometry.arrays import BoolArray, FloatArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.ray_casting import RayCaster
from insole_core.geometry.transforms import rigid, transform
from insole_core.imprints.planes import Plane

_COARSE_MM, _FINE_MM, _MOST_CELLS = 2.0, 1.0, 120_000
_MARGIN_MM = 10.0
_LEVELS_MM = (5.0, 8.0, 11.0, 15.0, 20.0)
"""Depths at which imprints are looked for; deeper ones where two imprints run into each other."""
_DEEPEST_MM = 60.0
_RIM_MM = (-4.0, 12.0)
"""Heights of undisturbed foam, and of the carton around it."""
_LENGTH_MM, _WIDTH_TO_LENGTH = (100.0, 340.0), (0.2, 0.62)
_PART_MM2 = 60.0
_GAP_MM = 30.0  # between the parts of one imprint, such as the toes and the ball
_RING_MM, _SURROUNDED = 14.0, 0.6
_DEPTH_MM = 6.0
_MOST_FEET = 2
_DEEPEST_EDGE_MM = 8.0
"""Depth below the rim to which an edge can curl; a ridge between two toes lies deeper."""
_REACH_MM = 4.0
_STEEP, _EASED = 1.2, 0.6
"""Slope of a wall, and the share of it below which the foam beside its upper end curls over."""
_STEP_MM, _NOISE_MM = 0.5, 0.7


@dataclass(frozen=True, eq=False)
class Relief:
    """Heights of the uppermost surface over a plane.

    Parameters
    ----------
    source2relief : (4, 4) float64, mm
        To a frame in which the plane is z = 0 and one looks along -z.
    first_mm : (2,) float64
        x and y of the node [0, 0], relief frame.
    cell_mm
        Distance of the nodes.
    heights_mm : (ny, nx) float64
        NaN where there is no surface.
    facing : (ny, nx) float64
        z of the triangles' normals as the surface has them; NaN where there is none.
    """

    source2relief: FloatArray
    first_mm: FloatArray
    cell_mm: float
    heights_mm: FloatArray
    facing: FloatArray

    @property
    def up(self) -> FloatArray:
        """(3,) unit vector against the direction in which one looks, source frame."""
        return self.source2relief[2, :3]

    def positions(self, mask: BoolArray) -> FloatArray:
        """Return x and y (n, 2) of the nodes in a mask (ny, nx), mm, relief frame."""
        rows, columns = np.nonzero(mask)
        return self.first_mm + self.cell_mm * np.stack([columns, rows], axis=1)

    def at(self, values: FloatArray, places: FloatArray, beyond: float) -> FloatArray:
        """Interpolate values (ny, nx) at places (n, 2), relief frame; `beyond` outside the grid."""
        column, row = ((places - self.first_mm) / self.cell_mm).T
        return np.asarray(
            scipy.ndimage.map_coordinates(values, [row, column], order=1, cval=beyond)
        )


class ReliefViewer:
    """Looks at one surface along the normals of planes."""

    def __init__(self, mesh: TriangleMesh) -> None:
        self._mesh = mesh
        self._caster = RayCaster(mesh)

    def relief(self, plane: Plane, sign: int) -> Relief:
        """Look at the whole surface against the normal of a plane.

        Parameters
        ----------
        sign
            -1 to look along the normal.
        """
        source2relief = _frame(plane, sign)
        local = transform(source2relief, self._mesh.vertices)[:, :2]
        low, high = local.min(axis=0) - _MARGIN_MM, local.max(axis=0) + _MARGIN_MM
        cell_mm = max(_COARSE_MM, float(np.sqrt(np.prod(high - low) / _MOST_CELLS)))
        return self._look(source2relief, low, high, cell_mm)

    def detail(self, relief: Relief, mask: BoolArray, margin_mm: float) -> Relief:
        """Look closely at the nodes in a mask (ny, nx) and what is beside them."""
        places = relief.positions(mask)
        low, high = places.min(axis=0) - margin_mm, places.max(axis=0) + margin_mm
        return self._look(relief.source2relief, low, high, _FINE_MM)

    def _look(
        self, source2relief: FloatArray, low: FloatArray, high: FloatArray, cell_mm: float
    ) -> Relief:
        """Return the relief between two corners (2,), relief frame."""
        local = transform(source2relief, self._mesh.vertices)[:, 2]
        x, y = (np.arange(a, b, cell_mm) for a, b in zip(low, high, strict=True))
        across, along = np.meshgrid(x, y)
        top = np.full(across.size, local.max() + _MARGIN_MM)
        starts = np.stack([across.ravel(), along.ravel(), top], axis=1)
        origins = (starts - source2relief[:3, 3]) @ source2relief[:3, :3]
        up = source2relief[2, :3]
        hits = self._caster.cast(origins, np.broadcast_to(-up, origins.shape))
        heights, facing = np.full((2, len(starts)), np.nan)
        corners = local[self._mesh.triangles[hits.triangle]]
        heights[hits.ray] = (hits.weights * corners).sum(axis=1)
        facing[hits.ray] = self._mesh.triangle_normals[hits.triangle] @ up
        shape = across.shape
        return Relief(source2relief, low, cell_mm, heights.reshape(shape), facing.reshape(shape))


def _frame(plane: Plane, sign: int) -> FloatArray:
    """Return the transform (4, 4) to a frame on the plane, z along its normal times `sign`."""
    up = sign * plane.normal
    aside = np.eye(3)[np.abs(up).argmin()]
    x = np.cross(aside, up)
    x /= np.linalg.norm(x)
    return rigid(np.stack([x, np.cross(up, x), up]), np.array([0.0, 0.0, -sign * plane.offset_mm]))


@dataclass(frozen=True, eq=False)
class PressedRegion:
    """Where one foot was pressed in.

    Parameters
    ----------
    mask : (ny, nx) bool
        Nodes of the relief.
    depth_mm
        Of its deepest part below the plane.
    length_mm, width_mm
        Of the region below the level at which it was found.
    facing
        Mean z of the normals of its floor, as the surface has them: > 0 for a hollow.
    flatness
        Share of its area that lies deeper than half its depth.
    """

    mask: BoolArray
    depth_mm: float
    length_mm: float
    width_mm: float
    facing: float
    flatness: float


def pressed_regions(relief: Relief) -> list[PressedRegion]:
    """Find the regions below z = 0 that are as large as a foot and surrounded by a rim.

    Returns
    -------
    list of PressedRegion
        Two at most; none where there is no imprint.
    """
    best: list[PressedRegion] = []
    for level_mm in _LEVELS_MM:
        found = _at_level(relief, level_mm)
        if len(found) > len(best):
            best = found
    return best


def _at_level(relief: Relief, level_mm: float) -> list[PressedRegion]:
    low = (relief.heights_mm < -level_mm) & (relief.heights_mm > -_DEEPEST_MM)
    parts, count = scipy.ndimage.label(_holes_filled(low, relief), np.ones((3, 3)))
    sizes = np.bincount(parts.ravel(), minlength=count + 1) * relief.cell_mm**2
    large = [n for n in range(1, count + 1) if sizes[n] > _PART_MM2]
    masks = _grouped([parts == n for n in sorted(large, key=lambda n: -sizes[n])], relief)
    regions = [region for mask in masks if (region := _region(mask, relief)) is not None]
    return regions if len(regions) <= _MOST_FEET else []


def _holes_filled(low: BoolArray, relief: Relief) -> BoolArray:
    """Add what is enclosed and was not measured, such as steep walls."""
    missing = np.isnan(relief.heights_mm)
    enclosed = missing & scipy.ndimage.binary_fill_holes(~missing)
    return np.asarray(low | (enclosed & _near(low, relief)))


def _near(mask: BoolArray, relief: Relief) -> BoolArray:
    return np.asarray(scipy.ndimage.distance_transform_edt(~mask) * relief.cell_mm < _RING_MM)


def _grouped(parts: list[BoolArray], relief: Relief) -> list[BoolArray]:
    """Join parts, the largest first, that make one longish shape with a larger one near them."""
    groups: list[BoolArray] = []
    for part in parts:
        for number, group in enumerate(groups):
            gap = scipy.ndimage.distance_transform_edt(~group)[part].min() * relief.cell_mm
            if gap < _GAP_MM and _is_foot_like(*_extents(group | part, relief)):
                groups[number] = group | part
                break
        else:
            groups.append(part)
    return groups


def _extents(mask: BoolArray, relief: Relief) -> tuple[float, float]:
    """Return length and width of a region along its main directions, mm."""
    places = relief.positions(mask)
    centred = places - places.mean(axis=0)
    along = centred @ np.linalg.eigh(centred.T @ centred)[1]
    width, length = np.ptp(along, axis=0)
    return float(length), float(width)


def _is_foot_like(length_mm: float, width_mm: float) -> bool:
    least, most = _WIDTH_TO_LENGTH
    fits = _LENGTH_MM[0] <= length_mm <= _LENGTH_MM[1]
    return fits and least <= width_mm / length_mm <= most


def _region(mask: BoolArray, relief: Relief) -> PressedRegion | None:
    length_mm, width_mm = _extents(mask, relief)
    if not _is_foot_like(length_mm, width_mm) or _surrounded(mask, relief) < _SURROUNDED:
        return None
    heights: FloatArray = relief.heights_mm[mask]
    measured = np.isfinite(heights)
    depth_mm = -float(np.quantile(heights[measured], 0.02))
    if depth_mm < _DEPTH_MM:
        return None
    floor = mask & (relief.heights_mm < -0.5 * depth_mm)
    facing = float(np.mean(relief.facing[floor]))
    return PressedRegion(
        mask, depth_mm, length_mm, width_mm, facing, float(floor.sum() / measured.sum())
    )


def _surrounded(mask: BoolArray, relief: Relief) -> float:
    """Return the share of the surroundings of a region that is rim."""
    ring = _near(mask, relief) & ~mask
    heights = relief.heights_mm[ring]
    return float(((heights > _RIM_MM[0]) & (heights < _RIM_MM[1])).mean())


def curled_over(relief: Relief) -> BoolArray:
    """Return the nodes (ny, nx) that lie over a wall close by and are much less steep than it.

    A sole has no such edge: its arch bends over tens of millimetres.
    """
    heights = _smoothed(relief)
    slope = np.hypot(*np.gradient(heights, relief.cell_mm))
    below = _steepest_below(heights, slope, round(_REACH_MM / relief.cell_mm))
    return np.asarray((heights > -_DEEPEST_EDGE_MM) & (below > _STEEP) & (slope < _EASED * below))


def _smoothed(relief: Relief) -> FloatArray:
    """Return the heights without noise; what was not measured gets the nearest height."""
    missing = np.isnan(relief.heights_mm)
    nearest = scipy.ndimage.distance_transform_edt(
        missing, return_distances=False, return_indices=True
    )
    heights = relief.heights_mm[tuple(nearest)]
    return np.asarray(scipy.ndimage.gaussian_filter(heights, _NOISE_MM / relief.cell_mm))


def _steepest_below(heights: FloatArray, slope: FloatArray, reach: int) -> FloatArray:
    """Return the greatest slope of the lower nodes within some nodes; 0 where there is none."""
    padded_heights = np.pad(heights, reach, constant_values=np.inf)
    padded_slope = np.pad(slope, reach)
    rows, columns = heights.shape
    steepest = np.zeros_like(heights)
    for i in range(2 * reach + 1):
        for j in range(2 * reach + 1):
            if (i - reach) ** 2 + (j - reach) ** 2 > reach**2:
                continue
            window = slice(i, i + rows), slice(j, j + columns)
            lower = padded_heights[window] < heights - _STEP_MM
            steepest = np.maximum(steepest, np.where(lower, padded_slope[window], 0.0))
    return steepest
