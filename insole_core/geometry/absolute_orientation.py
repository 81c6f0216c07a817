"""Absolute orientation of two point sets in closed form (thesis 3.2; Horn, with quaternions)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from insole_core.errors import ReconstructionError
from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.transforms import rigid

_COLLINEAR = 1e-6
"""Width over length of a point set below which it counts as one line."""


@dataclass(frozen=True, eq=False)
class Orientation:
    """Pose of frame a in frame b: ``b = scale * rotation @ a + translation_mm``.

    Parameters
    ----------
    rotation : (3, 3) float64
        Proper; a reflection cannot occur.
    translation_mm : (3,) float64, mm, frame b
    scale
        1 unless it was estimated as well.
    """

    rotation: FloatArray
    translation_mm: FloatArray
    scale: float = 1.0

    @property
    def a2b(self) -> FloatArray:
        """Homogeneous transform (4, 4) from frame a to frame b, scale included."""
        return rigid(self.scale * self.rotation, self.translation_mm)


def absolute_orientation(
    points_a: FloatArray,
    points_b: FloatArray,
    weights: FloatArray | None = None,
    *,
    scaled: bool = False,
) -> Orientation:
    """Find the motion from frame a to frame b with the least squared error, thesis (2) - (5).

    Parameters
    ----------
    points_a, points_b : (n, 3) float64, mm
        Row i of one corresponds to row i of the other.
    weights : (n,) float64, optional
        Not negative; a point of weight 0 does not count.
    scaled
        Whether to estimate the scale (4) too.

    Returns
    -------
    Orientation
        Of frame a in frame b.

    Raises
    ------
    ReconstructionError
        With fewer than three points of positive weight, or when they are collinear.
    """
    weight = np.ones(len(points_a)) if weights is None else np.asarray(weights, dtype=float)
    _check_spread(points_a[weight > 0])
    _check_spread(points_b[weight > 0])
    mean_a, mean_b = weight @ points_a / weight.sum(), weight @ points_b / weight.sum()
    centred_a, centred_b = points_a - mean_a, points_b - mean_b
    rotation = rotation_from_covariance((weight[:, None] * centred_a).T @ centred_b)
    turned = centred_a @ rotation.T
    scale = 1.0
    if scaled:
        scale = float(weight @ (turned * centred_b).sum(1) / (weight @ (centred_a**2).sum(1)))
    return Orientation(rotation, mean_b - scale * rotation @ mean_a, scale)


def rotation_from_covariance(covariance: FloatArray) -> FloatArray:
    """Compute the rotations that maximise (5) from cross-covariances, with Horn's matrix N (A.8).

    The unit quaternion is the eigenvector of the largest eigenvalue of the symmetric 4x4 matrix N.

    Parameters
    ----------
    covariance : (..., 3, 3) float64
        Sum of a_i b_i^T over the centred points.

    Returns
    -------
    (..., 3, 3) float64, from frame a to frame b
    """
    s = covariance
    skew = np.stack(
        [
            s[..., 1, 2] - s[..., 2, 1],
            s[..., 2, 0] - s[..., 0, 2],
            s[..., 0, 1] - s[..., 1, 0],
        ],
        axis=-1,
    )
    trace = np.trace(s, axis1=-2, axis2=-1)
    n = np.empty((*s.shape[:-2], 4, 4))
    n[..., 0, 0] = trace
    n[..., 0, 1:] = n[..., 1:, 0] = skew
    n[..., 1:, 1:] = s + np.swapaxes(s, -1, -2) - trace[..., None, None] * np.eye(3)
    return rotation_from_quaternion(np.linalg.eigh(n)[1][..., -1])


def rotation_from_quaternion(quaternion: FloatArray) -> FloatArray:
    """Return the rotation matrices (..., 3, 3) of unit quaternions (..., 4), scalar part first."""
    w, x, y, z = np.moveaxis(quaternion, -1, 0)
    rows = [
        [w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y)],
        [2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x)],
        [2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z],
    ]
    return np.moveaxis(np.array(rows), (0, 1), (-2, -1))


def _check_spread(points: FloatArray) -> None:
    if len(points) < 3:
        raise ReconstructionError(
            "At least three points are needed to place one frame in another, but only {count} were "
            "given.",
            count=len(points),
        )
    length, width, _ = np.linalg.svd(points - points.mean(0), compute_uv=False)
    if not width > _COLLINEAR * length:
        raise ReconstructionError(
            "The points that should place one frame in another lie on one line; "
            "at least one beside it is needed."
        )
