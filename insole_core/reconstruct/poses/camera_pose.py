"""The pose of a camera by the least reprojection error of markers in its image."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.transforms import inverse, rigid, rotation_about, transform
from insole_core.sensing.pinhole_camera import PinholeCamera

_ROUNDS = 20
_CONVERGED = 1e-9
_TURN_STEP_RAD = 1e-5
_SHIFT_STEP_MM = 1e-2
_STEPS = np.repeat([_TURN_STEP_RAD, _SHIFT_STEP_MM], 3)
_TURNS = np.stack([rotation_about(axis, np.degrees(_TURN_STEP_RAD)) for axis in np.eye(3)])
_FREEDOM = 6
_MEDIAN_OF_SQUARES = 2 * np.log(2)
"""Median of the sum of the squares of two standard normal variables."""


@dataclass(frozen=True)
class SightingNoise:
    """Standard deviations of what is observed of a marker.

    Parameters
    ----------
    pixel_px
        Of its centre in a good colour image; enlarged where the residuals show more.
    place_mm
        Of its position in the reference system, along an axis.
    depth_mm
        Of its distance, from the depth image.
    """

    pixel_px: float = 0.1
    place_mm: float = 0.13
    depth_mm: float = 1.0

    def seen_from(self, distance_mm: float, camera: PinholeCamera) -> SightingNoise:
        """Convert the error of the marker positions to an error in the image.

        Parameters
        ----------
        distance_mm
            Mean distance of the markers from the camera.
        camera

        Returns
        -------
        SightingNoise
            With both errors in `pixel_px`, and 0 for `place_mm`.
        """
        place_px = self.place_mm * camera.fx / distance_mm
        return SightingNoise(float(np.hypot(self.pixel_px, place_px)), 0.0, self.depth_mm)


@dataclass(frozen=True, eq=False)
class CameraPose:
    """The pose of a camera and its covariance.

    Parameters
    ----------
    reference2color : (4, 4) float64, mm
    residuals_px : (n, 2) float64, px
        Observed minus projected; 0 for a marker without a precise centre.
    weights : (n,) float64
        1 for a marker that fits in the image, towards 0 for one that does not: 1 / (1 + r²) at r
        times the noise; 0 for a marker without a precise centre.
    covariance : (6, 6) float64
        Of a small rotation (rad) about the markers' centre and a shift (mm), camera frame.
    center : (3,) float64, mm, reference frame
        Mean of the markers.
    """

    reference2color: FloatArray
    residuals_px: FloatArray
    weights: FloatArray
    covariance: FloatArray
    center: FloatArray

    @property
    def rms_px(self) -> float:
        """Weighted root mean square of the distances in the image, px."""
        squared = (self.residuals_px**2).sum(1)
        return float(np.sqrt(self.weights @ squared / self.weights.sum()))

    def displacement_mm(self, place: FloatArray) -> float:
        """Compute the standard deviation of a point under the pose, all axes together.

        Parameters
        ----------
        place : (3,) float64, mm, reference frame

        Returns
        -------
        float, mm
        """
        arm = self.reference2color[:3, :3] @ (place - self.center)
        # A small rotation t moves the point by t × arm.
        change = np.concatenate([np.cross(np.eye(3), arm).T, np.eye(3)], axis=1)
        return float(np.sqrt(np.trace(change @ self.covariance @ change.T)))

    def moved(self, from2to: FloatArray) -> CameraPose:
        """Return the pose with its reference frame replaced by another.

        Parameters
        ----------
        from2to : (4, 4) float64, mm
        """
        return replace(
            self,
            reference2color=self.reference2color @ inverse(from2to),
            center=transform(from2to, self.center[None])[0],
        )

    @property
    def turn_deviation_deg(self) -> float:
        """Standard deviation of the rotation, all axes together, degrees."""
        return float(np.degrees(np.sqrt(np.trace(self.covariance[:3, :3]))))


@dataclass(frozen=True, eq=False)
class SeenMarkers:
    """Markers and their observations by a camera.

    Parameters
    ----------
    faces : (n, 3) float64, mm, reference frame
        Centres of their faces, n > 3.
    centers : (n, 3) float64, mm, reference frame
        The points that appear as their centres: those of the faces, or a little behind them.
    pixels : (n, 2) float64, px
        Observed centres; NaN = too imprecise to count.
    distances_mm : (n,) float64, mm
        Measured depth of the faces along the camera's axis; NaN = unknown.
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
    """Find the pose of least robust reprojection error (Gauss-Newton with Cauchy's weights).

    The image determines five of the six degrees of freedom well, but the distance of the markers
    only by their size, where an error of 0.03 % in the focal length makes 0.25 mm; so the
    distances, where they are known, count as well, with their own and larger noise.

    Parameters
    ----------
    seen
    camera
        The camera that observed the markers.
    start : (4, 4) float64, mm
        Initial reference2color, from a closed form.
    noise

    Returns
    -------
    CameraPose
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
    """The least-squares problem of one pose."""

    seen: SeenMarkers
    camera: PinholeCamera
    noise: SightingNoise

    def converged(self, pose: FloatArray) -> FloatArray:
        """Refine a pose by Gauss-Newton steps until it converges."""
        for _ in range(_ROUNDS):
            scaled, design = self.linearised(pose)
            normal, rhs = _normal_equations(design, scaled, _cauchy(scaled))
            step = np.asarray(np.linalg.solve(normal, rhs), dtype=np.float64)
            pose = _moved(pose, step, self.seen.faces.mean(0))
            if step @ step < _CONVERGED:
                break
        return pose

    def as_noisy_as_seen(self, pose: FloatArray) -> _Problem:
        """Enlarge the noise where the residuals in the image show more than expected.

        It is estimated from their median, which outliers do not affect; the share absorbed by the
        pose's six degrees of freedom is taken to be as expected.
        """
        seen = np.isfinite(self.seen.pixels[:, 0])
        scaled, _ = self.linearised(pose)
        typical = float(np.median((scaled[seen, 0] ** 2).sum(1))) / _MEDIAN_OF_SQUARES
        wider = np.sqrt(max(1.0, typical + _FREEDOM / (2 * seen.sum())))
        return replace(self, noise=replace(self.noise, pixel_px=self.noise.pixel_px * float(wider)))

    def linearised(self, pose: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Compute the residuals, in standard deviations, and their design matrix.

        Returns
        -------
        scaled : (n, 2, 2) float64
            For each marker the residual in the image, (u, v), and in depth, (z, 0).
        design : (n, 2, 2, 6) float64
            Derivative of the prediction by rotation and shift.
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
    """Compute the weights (n, 2) of the image and of the depth of every marker."""
    squared = (scaled**2).sum(2)
    # When most residuals are large the start is rough; then only their relative size counts.
    usual = np.maximum(1, np.median(squared, axis=0))
    return np.asarray(1 / (1 + squared / usual))


def _normal_equations(
    design: FloatArray, scaled: FloatArray, weights: FloatArray
) -> tuple[FloatArray, FloatArray]:
    weighted = weights[..., None, None] * design
    normal = np.einsum("nkci,nkcj->ij", weighted, design)
    return normal, np.einsum("nkci,nkc->i", weighted, scaled)


def _placed(poses: FloatArray, points: FloatArray) -> FloatArray:
    """Transform points (n, 3) to the frames of many poses: (k, n, 3)."""
    return np.asarray(points @ poses[:, :3, :3].swapaxes(1, 2) + poses[:, None, :3, 3])


def _varied(pose: FloatArray, center: FloatArray) -> FloatArray:
    """Return a pose and its variations by a small step in each direction: (7, 4, 4)."""
    poses = np.tile(pose, (7, 1, 1))
    poses[1:4, :3, :3] = _TURNS @ pose[:3, :3]
    poses[1:4, :3, 3] = transform(pose, center) - poses[1:4, :3, :3] @ center
    poses[4:, :3, 3] += _SHIFT_STEP_MM * np.eye(3)
    return poses


def _moved(pose: FloatArray, step: FloatArray, center: FloatArray) -> FloatArray:
    """Rotate a pose about the image of `center` in the camera frame, and shift it."""
    angle = float(np.linalg.norm(step[:3]))
    turn = rotation_about(step[:3], np.degrees(angle)) if angle > 0 else np.eye(3)
    rotation = turn @ pose[:3, :3]
    at = transform(pose, center)
    return rigid(rotation, at + step[3:] - rotation @ center)
