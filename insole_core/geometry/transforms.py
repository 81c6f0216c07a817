"""Rigid transforms as 4x4 matrices named ``a2b``, applied to column vectors."""

from __future__ import annotations

import numpy as np

from insole_core.geometry.arrays import FloatArray

MIRROR = np.array([-1.0, 1.0, 1.0])
"""What coordinates are multiplied by for the mirror image in the plane x = 0."""


def rigid(rotation: FloatArray, translation_mm: FloatArray) -> FloatArray:
    """Return the transform (4, 4) of a rotation (3, 3) and a translation (3,), mm."""
    a2b = np.eye(4)
    a2b[:3, :3] = rotation
    a2b[:3, 3] = translation_mm
    return a2b


def inverse(a2b: FloatArray) -> FloatArray:
    """Return the inverse ``b2a`` (4, 4) of a rigid transform."""
    rotation = a2b[:3, :3].T
    return rigid(rotation, -rotation @ a2b[:3, 3])


def transform(a2b: FloatArray, points: FloatArray) -> FloatArray:
    """Transform points (..., 3), mm, from frame a to frame b."""
    return np.asarray(points @ a2b[:3, :3].T + a2b[:3, 3])


def rotation_about(axis: FloatArray, angle_deg: float) -> FloatArray:
    """Return the rotation matrix about an axis (Rodrigues).

    Parameters
    ----------
    axis : (3,) float64
        Of any length but zero.
    angle_deg
        Counter-clockwise, seen against the axis.

    Returns
    -------
    (3, 3) float64
    """
    x, y, z = np.asarray(axis, dtype=float) / np.linalg.norm(axis)
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    angle = np.radians(angle_deg)
    return np.asarray(np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross)


def rotations_by(vectors_rad: FloatArray) -> FloatArray:
    """Return the rotation matrices (n, 3, 3) of rotation vectors (n, 3), rad (Rodrigues)."""
    angle = np.linalg.norm(vectors_rad, axis=1)
    x, y, z = vectors_rad.T
    zero = np.zeros_like(x)
    cross = np.stack([zero, -z, y, z, zero, -x, -y, x, zero], axis=1).reshape(-1, 3, 3)
    sine = np.sinc(angle / np.pi)[:, None, None]
    versine = (np.sinc(angle / 2 / np.pi) ** 2 / 2)[:, None, None]
    return np.asarray(np.eye(3) + sine * cross + versine * cross @ cross)


def rotation_angle_deg(rotation: FloatArray) -> float:
    """Return the angle of a rotation matrix (3, 3), 0 to 180."""
    # The sine form stays exact for small angles, where the trace alone loses half the digits.
    sine = np.linalg.norm(rotation - rotation.T) / np.sqrt(8)
    return float(np.degrees(np.arctan2(sine, (np.trace(rotation) - 1) / 2)))


def is_rotation(matrix: FloatArray, tolerance: float = 1e-3) -> bool:
    """Return whether a matrix is a proper rotation: finite, orthonormal, not mirrored.

    Parameters
    ----------
    matrix
        Of any shape; only (3, 3) can be a rotation.
    tolerance
        Largest deviation of ``matrix @ matrix.T`` from the identity.
    """
    matrix = np.asarray(matrix, dtype=float)
    return (
        matrix.shape == (3, 3)
        and bool((np.abs(matrix) <= 1 + tolerance).all())
        and bool(np.abs(matrix @ matrix.T - np.eye(3)).max() < tolerance)
        and bool(np.linalg.det(matrix) > 0)
    )
