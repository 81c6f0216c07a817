"""Heights that pads add to the contact surface: Gaussian neighbourhood (25) with a smooth edge.

The thesis cuts the Gaussian off at the outline, which leaves a step there. Here it is multiplied by
a window that falls to zero at the outline with zero slope, so that the skin meets no edge; outside
the outline nothing changes, and at the apex the height is exactly the prescribed one.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy

from insole_core.geometry.arrays import FloatArray
from insole_core.insole.pads.pad_form import DOMED, PadForm
from insole_core.insole.pads.pad_shapes import is_seen_whole, local_outline, pad2insole
from insole_core.insole.primitives.blending import smooth_step
from insole_core.memo import Memo

_PLATEAU = 0.5  # share of the way to the outline over which the window of a dome is 1
_WIDEST_EDGE = 0.95  # share of the way to the outline that the edge may take
_FLAT_EDGE = 0.25  # breadth of a flat pad's edge relative to its width
_INSET_MM = 0.02  # a flat pad ends this much within its outline: the depth is interpolated
_DEPTH_CELLS = 160
_ROUNDING = 0.05  # of the greatest depth: scale over which the creases of the depth are rounded
_AROUND = 1.25  # reach of the grid relative to the outline: its edge must not affect the rounding
_OUTLINE_PITCH = 0.2  # of a cell
_LEAF = 64  # points; from the middle of a pad most of its outline is about as far away
_DRAWN_POINTS = 120

_fields = Memo(16)
"""Distance fields and polar forms by outline, so that moving and turning a pad is cheap.

They depend on a pad's shape only and are shared by all cases; at most 6 MB.
"""


def pad_outline(pad: PadForm, points: int | None = None) -> FloatArray:
    """Return the outline of a pad, counter-clockwise, the first point not repeated.

    Parameters
    ----------
    points
        Greatest number of points, for drawing; by default all.

    Returns
    -------
    (n, 2) float64, mm, insole frame
    """
    outline = local_outline(pad)
    if points is not None:
        outline = outline[:: -(-len(outline) // points)]
    return np.asarray(outline @ pad2insole(pad).T + np.array(pad.centre_mm))


def closed_outline(pad: PadForm) -> FloatArray:
    """Return the outline of a pad to be drawn, (n, 2), mm, its first point repeated."""
    around = pad_outline(pad, _DRAWN_POINTS)
    return np.concatenate([around, around[:1]])


def pad_heights(pad: PadForm, xy: FloatArray) -> FloatArray:
    """Compute the height that a pad adds at points of the surface.

    Parameters
    ----------
    xy : (..., 2) float64, mm, insole frame

    Returns
    -------
    (...) float64, mm
        0 outside the outline, `pad.height_mm` at the apex.
    """
    local = _to_pad(pad, np.asarray(xy, dtype=float))
    if pad.shape not in DOMED:
        return np.asarray(pad.height_mm * _edge_window(pad, local))
    window = _radial_window if is_seen_whole(pad) else _edge_window
    return np.asarray(pad.height_mm * _dome(pad, local) * window(pad, local))


def _to_pad(pad: PadForm, xy: FloatArray) -> FloatArray:
    """Transform from insole to pad frame, spelled out for the same bits in an array of any size."""
    (a, b), (c, d) = pad2insole(pad)
    x, y = xy[..., 0] - pad.centre_mm[0], xy[..., 1] - pad.centre_mm[1]
    return np.stack([x * a + y * c, x * b + y * d], axis=-1)


def _dome(pad: PadForm, local: FloatArray) -> FloatArray:
    """Evaluate the Gaussian of (25), 1 at the apex."""
    if pad.sigma_mm is None:
        sigma = np.ptp(local_outline(pad), axis=0) / 2
    else:
        sigma = np.array(pad.sigma_mm)
    x, y = local[..., 0] / sigma[0], local[..., 1] / sigma[1]
    return np.asarray(np.exp(-0.5 * (x * x + y * y)))


def _radial_window(pad: PadForm, local: FloatArray) -> FloatArray:
    """Return a window along rays from the apex: 1 around it, 0 from the outline on."""
    outline = local_outline(pad)
    angle, radius = _fields.get("polar", outline.tobytes(), lambda: _polar_outline(outline))
    x, y = local[..., 0], local[..., 1]
    reach = np.interp(np.arctan2(y, x), angle, radius)
    share = np.hypot(x, y) / reach
    if pad.blend_mm is None:
        return 1 - smooth_step(share, _PLATEAU, 1.0)
    edge = np.minimum(pad.blend_mm / reach, _WIDEST_EDGE)
    return 1 - smooth_step((share - 1) / edge, -1.0, 0.0)


def _polar_outline(outline: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return angles from -pi to pi, in order, and the outline's distance there."""
    x, y = outline.T
    angle = np.arctan2(y, x)
    order = np.argsort(angle)
    angle, radius = angle[order], np.hypot(x, y)[order]
    angle = np.concatenate([angle[-1:] - 2 * np.pi, angle, angle[:1] + 2 * np.pi])
    return angle, np.concatenate([radius[-1:], radius, radius[:1]])


def _edge_window(pad: PadForm, local: FloatArray) -> FloatArray:
    """Return a window by the distance from the outline: 1 deep inside, 0 from the outline on."""
    outline = local_outline(pad)
    depth = _fields.get("depth", outline.tobytes(), lambda: _depth(outline))
    if pad.blend_mm is not None:
        edge = pad.blend_mm
    elif pad.shape in DOMED:
        edge = np.inf
    else:
        edge = _FLAT_EDGE * float(np.ptp(outline[:, 0]))
    whole = depth.deepest_mm if pad.shape == "horseshoe" else depth.at_apex_mm
    edge = min(edge, _WIDEST_EDGE * (whole - _INSET_MM))
    return smooth_step(depth.at(local), _INSET_MM, _INSET_MM + edge)


@dataclass(frozen=True, eq=False)
class _Depth:
    """Distance from an outline, positive inside, sampled on a grid around it.

    Parameters
    ----------
    first_mm : (2,)
        Position of the first node.
    values : (nx, ny) float64, mm
    """

    first_mm: FloatArray
    step_mm: float
    values: FloatArray

    @property
    def deepest_mm(self) -> float:
        """Greatest distance."""
        return float(self.values.max())

    @property
    def at_apex_mm(self) -> float:
        """Distance of the apex, which is the middle node."""
        row, column = self.values.shape
        return float(self.values[row // 2, column // 2])

    def at(self, local: FloatArray) -> FloatArray:
        """Interpolate the distance at points (..., 2) linearly; negative beyond the grid."""
        index = (local.reshape(-1, 2) - self.first_mm).T / self.step_mm
        distance = scipy.ndimage.map_coordinates(self.values, index, order=1, cval=-1.0)
        return np.asarray(distance.reshape(local.shape[:-1]))


def _depth(curve: FloatArray) -> _Depth:
    """Compute the distance field of an outline."""
    # Symmetric about the apex, so that a mirrored outline has the mirrored field.
    reach = np.abs(curve).max(axis=0)
    step = float(2 * reach.max() / _DEPTH_CELLS)
    half = np.ceil(_AROUND * reach / step).astype(int)
    x, y = (np.arange(-n, n + 1) * step for n in half)
    places = np.stack(np.meshgrid(x, y, indexing="ij"), axis=-1)
    points, inward = _dense(curve, _OUTLINE_PITCH * step)
    _, nearest = scipy.spatial.cKDTree(points, leafsize=_LEAF).query(places)
    # Along the edge's normal the distance does not depend on where the edge was sampled.
    values = ((places - points[nearest]) * inward[nearest]).sum(axis=-1)
    values = scipy.ndimage.gaussian_filter(values, _ROUNDING * values.max() / step, mode="nearest")
    return _Depth(-half * step, step, values)


def _dense(curve: FloatArray, pitch_mm: float) -> tuple[FloatArray, FloatArray]:
    """Return points (n, 2) on a counter-clockwise polygon and the inward normals of their edges."""
    edge = np.roll(curve, -1, axis=0) - curve
    length = np.hypot(*edge.T)
    count = np.ceil(np.maximum(length / pitch_mm, 1)).astype(int)
    which = np.repeat(np.arange(len(curve)), count)
    number = np.arange(len(which)) - np.repeat(np.cumsum(count) - count, count)
    share = ((number + 0.5) / count[which])[:, None]
    normal = np.stack([-edge[:, 1], edge[:, 0]], axis=1) / np.maximum(length, 1e-12)[:, None]
    return curve[which] + share * edge[which], normal[which]
