"""Where a camera stood, by the least reprojection error of markers in its image."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.transforms import rigid, rotation_about, transform
from insole_core.sensing.pinhole_camera import PinholeCamera

_ROUNDS = 20
_CONVERGED = 1e-9
_TURN_STEP_RAD = 1e-5
_SHIFT_STEP_MM = 1e-2
_STEPS = np.repeat([_TURN_STEP_RAD, _SHIFT_STEP_MM], 3)
_TURNS = np.stack([rotation_about(axis, np.degrees(_TURN_STEP_RAD)) for axis in np.eye(3)])
_FREEDOM = 6
_MEDIAN_OF_SQUARES = 2 * np.log(2)
"""Of the sums of two squares of standard normal numbers."""


@dataclass(frozen=True)
class SightingNoise:
    """Standard deviations of what was seen of a marker.

    Parameters
    ----------
    pixel_px
        Of its centre in a good colour image; where the residuals show more, that counts.
    place_mm
        Of its place in the marker system, along an axis.
    depth_mm
        Of its distance, from the depth image.
    """

    pixel_px: float = 0.1
    place_mm: float = 0.13
    depth_mm: float = 1.0

    def seen_from(self, distance_mm: float, camera: PinholeCamera) -> SightingNoise:
        """Count what the marker system is off as if the picture were."""
        place_px = self.place_mm * camera.fx / distance_mm
        return SightingNoise(float(np.hypot(self.pixel_px, place_px)), 0.0, self.depth_mm)


@dataclass(frozen=True, eq=False)
class CameraPose:
    """The pose of a camera, and how certain it is.

    Parameters
    ----------
    reference2color : (4, 4) float64, mm
    residuals_px : (n, 2) float64, px
        Observed minus projected; 0 for a marker that does not count.
    weights : (n,) float64
        1 for a marker that fits in the image, towards 0 for one that does not: 1 / (1 + r²) at r
        times the noise.
    covariance : (6, 6) float64
        Of a small turn (rad) about the markers' centre and a shift (mm), camera frame.
    center : (3,) float64, mm, reference frame
        Of the markers.
    """

    reference2color: FloatArray
    residuals_px: FloatArray
    weights: FloatArray
    covariance: FloatArray
    center: FloatArray

    @property
    def rms_px(self) -> float:
        """Weighted root mean square of the distances in the image."""
        squared = (self.residuals_px**2).sum(1)
        return float(np.sqrt(self.weights @ squared / self.weights.sum()))

    def displacement_mm(self, place: FloatArray) -> float:
        """Give the standard deviation of where a place (3,), mm, is put, all axes together."""
        arm = self.reference2color[:3, :3] @ (place - self.center)
        # A small turn t moves the place by t × arm.
        change = np.concatenate([np.cross(np.eye(3), arm).T, np.eye(3)], axis=1)
        return float(np.sqrt(np.trace(change @ self.covariance @ change.T)))

    @property
    def turn_deviation_deg(self) -> float:
        """Standard deviation of the rotation, all axes together."""
        return float(np.degrees(np.sqrt(np.trace(self.covariance[:3, :3]))))


@dataclass(frozen=True, eq=False)
class SeenMarkers:
    """Markers and what a camera saw of them.

    Parameters
    ----------
    faces : (n, 3) float64, mm, reference frame
        Centres of their faces, n > 3.
    centers : (n, 3) float64, mm, reference frame
        What the camera sees as their centres: the faces', or a little behind them.
    pixels : (n, 2) float64, px
        Where the camera saw the centres; NaN = not precisely enough to count.
    distances_mm : (n,) float64, mm
        Of the faces along the camera's axis, NaN = unknown.
    """

    faces: FloatArray
    centers: FloatArray
    pixels: FloatArray
    distances_mm: FloatArray


def fit_camera_pose(
    seen: SeenMarkers,
    camera: PinholeCamera,
    start: FloatArray,
    noise: SightingNoise = SightingNoise(),
) -> CameraPose:
    """Find the likeliest pose: least reprojection error, robust (Gauss-Newton, Cauchy's weights).

    The image tells five of the six degrees of freedom well. How far away the markers are it tells
    only by their size, and an error of 0.03 % in the focal length is 0.25 mm there; so the
    distances, where they are known, count as well, with their own and larger noise.

    Parameters
    ----------
    seen
    camera
    start : (4, 4) float64, mm
        Reference frame to camera frame, from a closed form.
    noise
    """
    distance_mm = float(transform(start, seen.faces)[:, 2].mean())
    problem = _Problem(seen, camera, noise.seen_from(distance_mm, camera))
    pose = problem.converged(start)
    problem = problem.as_noisy_as_seen(pose)
    pose = problem.converged(pose)
    scaled, design = problem.linearised(pose)
    weights = _cauchy(scaled)
    normal, _ = _normal_equations(design, scaled, weights)
    freedom = max(weights.sum() + weights[:, 0].sum() - _FREEDOM, 1)
    scatter = float((weights * (scaled**2).sum(2)).sum()) / freedom
    residuals_px = scaled[:, 0] * problem.noise.pixel_px
    counted = weights[:, 0] * np.isfinite(seen.pixels[:, 0])
    covariance = max(1, scatter) * np.linalg.inv(normal)
    return CameraPose(pose, residuals_px, counted, covariance, seen.faces.mean(0))


@dataclass(frozen=True, eq=False)
class _Problem:
    seen: SeenMarkers
    camera: PinholeCamera
    noise: SightingNoise

    def converged(self, pose: FloatArray) -> FloatArray:
        """Improve a pose until it stays."""
        for _ in range(_ROUNDS):
            scaled, design = self.linearised(pose)
            normal, pull = _normal_equations(design, scaled, _cauchy(scaled))
            step = np.asarray(np.linalg.solve(normal, pull), dtype=np.float64)
            pose = _moved(pose, step, self.seen.faces.mean(0))
            if step @ step < _CONVERGED:
                break
        return pose

    def as_noisy_as_seen(self, pose: FloatArray) -> _Problem:
        """Take the noise from the residuals in the image, where they show more than expected.

        From their median, which strays do not widen. What the pose's six degrees of freedom took
        up was as large as expected.
        """
        seen = np.isfinite(self.seen.pixels[:, 0])
        scaled, _ = self.linearised(pose)
        typical = float(np.median((scaled[seen, 0] ** 2).sum(1))) / _MEDIAN_OF_SQUARES
        wider = np.sqrt(max(1.0, typical + _FREEDOM / (2 * seen.sum())))
        return replace(self, noise=replace(self.noise, pixel_px=self.noise.pixel_px * float(wider)))

    def linearised(self, pose: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Residuals in standard deviations, and how the prediction changes.

        Returns
        -------
        scaled : (n, 2, 2) float64
            For each marker what the image says, (u, v), and what the depth says, (z, 0).
        design : (n, 2, 2, 6) float64
            Change of the prediction with turn and shift.
        """
        predicted, *moved = self._predict(_varied(pose, self.seen.faces.mean(0)))
        observed = np.zeros_like(predicted)
        observed[:, 0] = self.seen.pixels / self.noise.pixel_px
        observed[:, 1, 0] = self.seen.distances_mm / self.noise.depth_mm
        unknown = np.isnan(observed)
        design = (np.stack(moved, axis=-1) - predicted[..., None]) / _STEPS
        design[unknown] = 0
        return np.where(unknown, 0, observed - predicted), design

    def _predict(self, poses: FloatArray) -> FloatArray:
        predicted = np.zeros((len(poses), len(self.seen.faces), 2, 2))
        pixels = self.camera.project(_placed(poses, self.seen.centers))
        predicted[:, :, 0] = pixels / self.noise.pixel_px
        predicted[:, :, 1, 0] = _placed(poses, self.seen.faces)[..., 2] / self.noise.depth_mm
        return predicted


def _cauchy(scaled: FloatArray) -> FloatArray:
    """Weights (n, 2) of the image and of the depth of every marker."""
    squared = (scaled**2).sum(2)
    # Where most lie far away the start was rough: only the relative size counts then.
    usual = np.maximum(1, np.median(squared, axis=0))
    return np.asarray(1 / (1 + squared / usual))


def _normal_equations(
    design: FloatArray, scaled: FloatArray, weights: FloatArray
) -> tuple[FloatArray, FloatArray]:
    weighted = weights[..., None, None] * design
    normal = np.einsum("nkci,nkcj->ij", weighted, design)
    return normal, np.einsum("nkci,nkc->i", weighted, scaled)


def _placed(poses: FloatArray, points: FloatArray) -> FloatArray:
    """Bring points (n, 3) to the frames of many poses: (k, n, 3)."""
    return np.asarray(points @ poses[:, :3, :3].swapaxes(1, 2) + poses[:, None, :3, 3])


def _varied(pose: FloatArray, center: FloatArray) -> FloatArray:
    """Give a pose and what it becomes by a small step in each direction: (7, 4, 4)."""
    poses = np.tile(pose, (7, 1, 1))
    poses[1:4, :3, :3] = _TURNS @ pose[:3, :3]
    poses[1:4, :3, 3] = transform(pose, center) - poses[1:4, :3, :3] @ center
    poses[4:, :3, 3] += _SHIFT_STEP_MM * np.eye(3)
    return poses


def _moved(pose: FloatArray, step: FloatArray, center: FloatArray) -> FloatArray:
    """Turn a pose about the place of `center`, and shift it."""
    angle = float(np.linalg.norm(step[:3]))
    turn = rotation_about(step[:3], np.degrees(angle)) if angle > 0 else np.eye(3)
    rotation = turn @ pose[:3, :3]
    at = transform(pose, center)
    return rigid(rotation, at + step[3:] - rotation @ center)
