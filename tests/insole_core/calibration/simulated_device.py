"""A depth sensor whose every parameter is known, for the tests of its calibration."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field

import numpy as np

from insole_core.calibration.walls.captures import WallCapture, capture_from_frames
from insole_core.calibration.walls.wall_plane import plane_rows
from insole_core.geometry.arrays import BoolArray, FloatArray, RawArray
from insole_core.sensing.disparity import NO_READING, LinearInverseDisparity
from insole_core.sensing.pinhole_camera import PinholeCamera

CAMERA = PinholeCamera(640, 480, 585.0, 587.0, 317.5, 243.5)
DISPARITY = LinearInverseDisparity(3.3309495, -0.0030711016)


def smooth_distortion(seed: int, rms_raw: float) -> FloatArray:
    """(480, 640) a smooth random distortion without a plane in it, like figure 10."""
    generator = np.random.default_rng(seed)
    v, u = np.mgrid[-1:1:480j, -1:1:640j]
    shape = 1.5 * (u**2 + v**2) ** 2
    for _ in range(6):
        frequency, phase = generator.uniform(1, 4, 2), generator.uniform(0, 6, 2)
        shape = shape + np.cos(frequency[0] * u + phase[0]) * np.cos(frequency[1] * v + phase[1])
    rows = plane_rows(CAMERA).reshape(-1, 3)
    flat = shape.ravel() - rows @ np.linalg.lstsq(rows, shape.ravel(), rcond=None)[0]
    return (flat * rms_raw / np.sqrt((flat**2).mean())).reshape(480, 640)


@dataclass(frozen=True, eq=False)
class SimulatedDevice:
    """Distorts as Herrera's model says, D exp(-decay (raw - 650)), adds noise, and rounds."""

    distortion_raw: FloatArray
    decay: float = 0.002
    noise_raw: float = 0.6
    serial: str = "SIM1"
    disparity: LinearInverseDisparity = DISPARITY
    generator: np.random.Generator = field(default_factory=lambda: np.random.default_rng(1))

    def distorted(self, plane: FloatArray) -> FloatArray:
        """(480, 640) noise-free raw numbers of a plane 1/Z = plane · (x, y, 1)."""
        true = true_raw(plane, self.disparity)
        return true + self.distortion_raw * np.exp(-self.decay * (true - 650))

    def frames(
        self, plane: FloatArray, count: int, hidden: BoolArray | None = None
    ) -> Iterator[RawArray]:
        """Frames of a wall; nothing is measured where `hidden`."""
        clean = self.distorted(plane)
        for _ in range(count):
            frame = np.round(clean + self.generator.normal(0, self.noise_raw, clean.shape))
            raw = np.clip(frame, 0, NO_READING - 1).astype(np.uint16)
            if hidden is not None:
                raw[hidden] = NO_READING
            yield raw

    def capture(
        self, plane: FloatArray, count: int = 10, hidden: BoolArray | None = None
    ) -> WallCapture:
        return capture_from_frames(
            f"wall at {1 / plane[2]:.0f} mm",
            self.frames(plane, count, hidden),
            serial=self.serial,
        )


def wall(distance_mm: float, tilt_x_deg: float = 0.0, tilt_y_deg: float = 0.0) -> FloatArray:
    """Plane (3,) 1/mm of a wall at a distance along the axis, turned about x and y."""
    a, b = np.radians([tilt_x_deg, tilt_y_deg])
    return np.array([np.tan(b), np.tan(a), 1.0]) / distance_mm


def true_raw(plane: FloatArray, disparity: LinearInverseDisparity = DISPARITY) -> FloatArray:
    return disparity.raw(1 / (plane_rows(CAMERA) @ plane))


WALLS = (
    wall(650, 3, -2), wall(720, -4, 1), wall(790, 0, 5), wall(850, 2, -6), wall(920, -3, 2),
    wall(1000, 5, 3),
)  # fmt: skip
