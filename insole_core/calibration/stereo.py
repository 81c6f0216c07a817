"""Where the colour camera stands beside the depth camera (thesis 4.3, 5.4, its limitation 10.3).

From pictures of one board in infrared (emitter covered) and in colour. The depth image is cut out
of the infrared image a few pixels shifted, which is taken into account.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import cv2
import numpy as np

from insole_core.calibration.adjustment import Adjustment, Blocks, adjust, pose, pose_vector
from insole_core.calibration.board import Sighting
from insole_core.errors import CalibrationError
from insole_core.geometry.arrays import FloatArray, IntArray
from insole_core.geometry.transforms import inverse, rigid, rotation_angle_deg, transform
from insole_core.sensing.camera import Camera

IR_TO_DEPTH_PX = (-4.8, -3.9)
"""Depth pixel minus infrared pixel of a Kinect v1: half of its correlation window."""
_LEAST_PAIRS = 3
_LEAST_COMMON = 8


@dataclass(frozen=True, eq=False)
class StereoCalibration:
    """The pose between the two cameras.

    Parameters
    ----------
    depth2color : (4, 4) float64, mm
    rotation_deviation_deg, translation_deviation_mm : (3,) float64
        Standard deviations about and along x, y, z.
    rms
        Of the residuals, in `unit`.
    unit
        ``px`` (boards in two pictures) or ``raw`` (boards in colour and disparity).
    pairs
        Names of the pictures used.
    """

    depth2color: FloatArray
    rotation_deviation_deg: FloatArray
    translation_deviation_mm: FloatArray
    rms: float
    unit: str
    pairs: tuple[str, ...]

    @property
    def baseline_mm(self) -> float:
        """Distance of the two cameras."""
        return float(np.linalg.norm(self.depth2color[:3, 3]))

    @property
    def rotation_deg(self) -> float:
        """Angle between the two cameras."""
        return rotation_angle_deg(self.depth2color[:3, :3])


def calibrate_stereo(
    depth: Sequence[Sighting], color: Sequence[Sighting], depth_camera: Camera, color_camera: Camera
) -> StereoCalibration:
    """Fit the pose between the cameras to boards that both see.

    Parameters
    ----------
    depth, color
        Sightings of the same board positions, in the same order; those of the depth camera in the
        pixels of `depth_camera` (see `board.shifted`).

    Raises
    ------
    CalibrationError
        With fewer than three pairs.
    """
    pairs = [common_corners(a, b) for a, b in zip(depth, color, strict=True)]
    pairs = [(a, b) for a, b in pairs if len(a.pixels) >= _LEAST_COMMON]
    if len(pairs) < _LEAST_PAIRS:
        raise CalibrationError(
            f"The board is seen by both cameras in {len(pairs)} pairs of pictures, but "
            f"{_LEAST_PAIRS} are needed; take infrared and colour pictures of the same positions."
        )
    boards = [board_pose(a, depth_camera) for a, _ in pairs]
    between = [
        board_pose(b, color_camera) @ inverse(p) for (_, b), p in zip(pairs, boards, strict=True)
    ]
    first = min(between, key=lambda one: sum(float(np.abs(one - other).sum()) for other in between))

    def residuals(unknowns: FloatArray) -> FloatArray:
        depth2color = pose(unknowns[:6])
        parts = []
        for (a, b), vector in zip(pairs, unknowns[6:].reshape(-1, 6), strict=True):
            points = transform(pose(vector), a.points_mm)
            parts.append((a.pixels - depth_camera.project(points)).ravel())
            parts.append((b.pixels - color_camera.project(transform(depth2color, points))).ravel())
        return np.concatenate(parts)

    start = np.concatenate([pose_vector(first), *[pose_vector(board) for board in boards]])
    lengths = tuple(4 * len(a.pixels) for a, _ in pairs)
    found = adjust(residuals, start, Blocks(lengths, 6))
    # Of a corner, like the errors of the single cameras: two residuals each.
    rms = float(np.sqrt((found.residuals**2).mean() * 2))
    return as_stereo(found, rms, "px", tuple(a.name for a, _ in pairs))


def as_stereo(
    found: Adjustment, rms: float, unit: str, pairs: tuple[str, ...]
) -> StereoCalibration:
    """Read the pose from the first six unknowns of a fit."""
    return StereoCalibration(
        depth2color=pose(found.values[:6]),
        rotation_deviation_deg=np.degrees(found.deviations[:3]),
        translation_deviation_mm=found.deviations[3:6],
        rms=rms,
        unit=unit,
        pairs=pairs,
    )


def common_corners(a: Sighting, b: Sighting) -> tuple[Sighting, Sighting]:
    """Keep the corners that both pictures show, in the same order."""
    same = (np.abs(a.points_mm[:, None] - b.points_mm[None]).max(-1) < 1e-6).nonzero()
    return _taking(a, same[0]), _taking(b, same[1])


def board_pose(sighting: Sighting, camera: Camera) -> FloatArray:
    """Give the pose (4, 4) ``board2camera`` of a board in one picture."""
    rays = camera.normalised(sighting.pixels)
    _, turn, shift = cv2.solvePnP(sighting.points_mm, rays, np.eye(3), None)
    return rigid(cv2.Rodrigues(turn)[0], shift.ravel())


def _taking(sighting: Sighting, which: IntArray) -> Sighting:
    return Sighting(sighting.name, sighting.size, sighting.points_mm[which], sighting.pixels[which])
