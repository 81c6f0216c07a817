"""Many candidate poses of a camera at once, and their refinement on the markers they explain."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from insole_core.geometry.arrays import BoolArray, FloatArray, IntArray
from insole_core.geometry.transforms import rotations_by

LEAST_EXPLAINED = 4
"""Least number of explained markers: any three blobs explain three markers."""
_DAMPING = 1e-9


@dataclass(frozen=True, eq=False)
class Sight:
    """The blobs that a camera saw and the markers that it should see.

    Parameters
    ----------
    blobs : (n, 2) float64
        Normalised image coordinates.
    markers : (m, 3) float64, mm, reference frame
    """

    blobs: FloatArray
    markers: FloatArray


@dataclass(frozen=True, eq=False)
class PoseBatch:
    """Poses, reference frame to camera frame.

    Parameters
    ----------
    rotations : (t, 3, 3) float64
    translations : (t, 3) float64, mm
    """

    rotations: FloatArray
    translations: FloatArray

    def __len__(self) -> int:
        return len(self.rotations)

    @staticmethod
    def none() -> PoseBatch:
        """Return an empty batch."""
        return PoseBatch(np.zeros((0, 3, 3)), np.zeros((0, 3)))

    @staticmethod
    def joined(parts: list[PoseBatch]) -> PoseBatch:
        """Concatenate batches."""
        return PoseBatch(
            np.concatenate([part.rotations for part in parts]),
            np.concatenate([part.translations for part in parts]),
        )

    def take(self, index: IntArray | BoolArray) -> PoseBatch:
        """Return some of the poses, by index or mask."""
        return PoseBatch(self.rotations[index], self.translations[index])

    def turned(self, markers: FloatArray) -> FloatArray:
        """Rotate points (m, 3) to the axes of every camera, (t, m, 3)."""
        return np.asarray(markers @ np.swapaxes(self.rotations, 1, 2))

    def project(self, markers: FloatArray) -> FloatArray:
        """Project points (m, 3), mm, reference frame, with every pose.

        Returns
        -------
        (t, m, 2) float64
            Normalised image coordinates; 1e6 for points behind the camera.
        """
        return _divided(self.turned(markers) + self.translations[:, None])


def matches(poses: PoseBatch, sight: Sight, near: float) -> tuple[IntArray, BoolArray, FloatArray]:
    """Find which markers have a blob near their projection; a blob explains one marker at most.

    Parameters
    ----------
    poses
    sight
    near
        Largest distance, normalised image coordinates.

    Returns
    -------
    nearest : (t, m) int64
        The blob nearest to every marker.
    explained : (t, m) bool
        Whether it is near enough, and nearest to no other marker.
    squared : (t, m) float64
        Its squared distance, normalised image coordinates.
    """
    projected = poses.project(sight.markers)
    squared = ((projected[:, :, None] - sight.blobs) ** 2).sum(3)
    nearest, nearest_marker = squared.argmin(2), squared.argmin(1)
    own = np.take_along_axis(nearest_marker, nearest, axis=1) == np.arange(len(sight.markers))
    least = squared.min(2)
    return nearest, np.asarray(own & (least < near**2)), least


def improved(poses: PoseBatch, sight: Sight, near: float, doubted: float = np.inf) -> PoseBatch:
    """Take one Gauss-Newton step on the reprojection errors of the markers each pose explains.

    Parameters
    ----------
    poses
    sight
    near
        Largest distance of a blob that explains a marker, normalised image coordinates.
    doubted
        Reprojection error that counts half (Cauchy's weights), normalised image coordinates.

    Returns
    -------
    PoseBatch
        Without the poses that explained fewer than four markers.
    """
    nearest, explained, squared = matches(poses, sight, near)
    enough = explained.sum(1) >= LEAST_EXPLAINED
    if not enough.any():
        return PoseBatch.none()
    poses, nearest = poses.take(enough), nearest[enough]
    weights = (explained / (1 + squared / doubted**2))[enough]
    turned = poses.turned(sight.markers)
    points = turned + poses.translations[:, None]
    residuals = sight.blobs[nearest] - _divided(points)
    design = _design(turned, points)
    weighted = design * weights[..., None, None]
    normal = np.einsum("tmci,tmcj->tij", weighted, design)
    rhs = np.einsum("tmci,tmc->ti", weighted, residuals)
    # Rotations are in rad and shifts in mm; the damping is relative to the mean scale.
    damping = _DAMPING * np.einsum("tii->ti", normal)[..., None] * np.eye(6)
    step = np.linalg.solve(normal + damping + 1e-15 * np.eye(6), rhs[..., None])[..., 0]
    return PoseBatch(rotations_by(step[:, :3]) @ poses.rotations, poses.translations + step[:, 3:])


def _divided(points: FloatArray) -> FloatArray:
    ahead = points[..., 2:] > 1.0
    return np.where(ahead, points[..., :2] / np.where(ahead, points[..., 2:], 1.0), 1e6)


def _design(turned: FloatArray, points: FloatArray) -> FloatArray:
    """Differentiate the projections by rotation about the origin and shift, (t, m, 2, 6)."""
    depth = np.maximum(points[..., 2], 1.0)
    by_point = np.zeros((*points.shape[:2], 2, 3))
    by_point[..., 0, 0] = by_point[..., 1, 1] = 1 / depth
    by_point[..., :, 2] = -points[..., :2] / depth[..., None] ** 2
    x, y, z = np.moveaxis(turned, -1, 0)
    zero = np.zeros_like(x)
    by_turn = np.stack([zero, z, -y, -z, zero, x, y, -x, zero], axis=-1).reshape(*x.shape, 3, 3)
    return np.concatenate([by_point @ by_turn, by_point], axis=-1)
