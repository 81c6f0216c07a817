"""Where one looks from: a camera as a value that keeps the foot upright, and its arithmetic.

Both views share one `ViewCamera`. A plantar look at the foot comes from below, the same look at the
insole from above: the sole and what it stands on are seen like two pages of an open book.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from enum import StrEnum

import numpy as np

from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.side import Side
from insole_core.geometry.transforms import rotation_about

MAX_ELEVATION_DEG = 85.0
SMALLEST_VIEW_MM = 10.0
LARGEST_VIEW_MM = 2000.0
ROUND_MM = (45.0, 19.0, 24.0)
"""What a fitted picture leaves free round its box for the anatomical words, in x, y and z."""


class Preset(StrEnum):
    """The named directions to look from."""

    PLANTAR = "plantar"
    MEDIAL = "medial"
    LATERAL = "lateral"
    POSTERIOR = "posterior"
    ANTERIOR = "anterior"
    DORSAL = "dorsal"


class Subject(StrEnum):
    """What is looked at."""

    FOOT = "foot"
    INSOLE = "insole"


@dataclass(frozen=True)
class ViewCamera:
    """A look at the scene in parallel projection, so that lengths on the screen are true.

    Parameters
    ----------
    preset
        Direction and upright axis that the angles count from.
    azimuth_deg
        Turn about the upright axis.
    elevation_deg
        Lift above (> 0) the direction of the preset.
    focal_mm
        The point in the middle of the picture.
    height_mm
        How much the picture shows from its top to its bottom.
    """

    preset: Preset = Preset.PLANTAR
    azimuth_deg: float = 0.0
    elevation_deg: float = 0.0
    focal_mm: tuple[float, float, float] = (0.0, 130.0, 20.0)
    height_mm: float = 300.0

    def orbited(self, azimuth_deg: float, elevation_deg: float) -> ViewCamera:
        """Turn by the given angles; never over the top."""
        elevation = self.elevation_deg + elevation_deg
        return replace(
            self,
            azimuth_deg=(self.azimuth_deg + azimuth_deg + 180.0) % 360.0 - 180.0,
            elevation_deg=float(np.clip(elevation, -MAX_ELEVATION_DEG, MAX_ELEVATION_DEG)),
        )

    def zoomed(self, factor: float, about_mm: FloatArray | None = None) -> ViewCamera:
        """Show `factor` times as much; `about_mm` stays where it is on the screen."""
        height = float(np.clip(self.height_mm * factor, SMALLEST_VIEW_MM, LARGEST_VIEW_MM))
        focal = np.asarray(self.focal_mm)
        if about_mm is not None:
            focal = about_mm + (focal - about_mm) * (height / self.height_mm)
        return replace(self, height_mm=height, focal_mm=_point(focal))

    def centred(self, focal_mm: FloatArray) -> ViewCamera:
        """Put a point into the middle."""
        return replace(self, focal_mm=_point(focal_mm))


@dataclass(frozen=True, eq=False)
class ViewTransform:
    """A camera made concrete for one subject and one picture.

    Parameters
    ----------
    right, up, back : (3,) float64
        Unit vectors of the picture in the insole frame; `back` points from the scene to the eye.
    focal_mm : (3,) float64
    height_mm
    size_px
        Width and height of the picture.
    """

    right: FloatArray
    up: FloatArray
    back: FloatArray
    focal_mm: FloatArray
    height_mm: float
    size_px: tuple[int, int]

    @property
    def mm_per_px(self) -> float:
        """Length that one pixel shows."""
        return self.height_mm / max(self.size_px[1], 1)

    def point_at(self, x_px: float, y_px: float) -> FloatArray:
        """Give the point under a pixel in the plane through the focal point; (3,) mm."""
        dx = (x_px - self.size_px[0] / 2) * self.mm_per_px
        dy = (self.size_px[1] / 2 - y_px) * self.mm_per_px
        return np.asarray(self.focal_mm + dx * self.right + dy * self.up)

    def ray_at(self, x_px: float, y_px: float) -> tuple[FloatArray, FloatArray]:
        """Give origin and direction of the ray into the scene at a pixel."""
        return self.point_at(x_px, y_px) + self.back * LARGEST_VIEW_MM, -self.back

    def pixels_of(self, points: FloatArray) -> FloatArray:
        """Give the pixels (n, 2) at which points (n, 3) appear."""
        offset = np.atleast_2d(points) - self.focal_mm
        x = self.size_px[0] / 2 + offset @ self.right / self.mm_per_px
        y = self.size_px[1] / 2 - offset @ self.up / self.mm_per_px
        return np.stack([x, y], axis=1)


def look(
    camera: ViewCamera, subject: Subject, side: Side, size_px: tuple[int, int]
) -> ViewTransform:
    """Make a camera concrete."""
    upright, front = _preset_axes(camera.preset, subject, side)
    right = np.cross(upright, front)
    lift = rotation_about(right, -camera.elevation_deg)
    turn = rotation_about(upright, camera.azimuth_deg)
    pose = turn @ lift
    return ViewTransform(
        right=np.asarray(pose @ right),
        up=np.asarray(pose @ upright),
        back=np.asarray(pose @ front),
        focal_mm=np.asarray(camera.focal_mm, dtype=float),
        height_mm=camera.height_mm,
        size_px=size_px,
    )


def fitted(camera: ViewCamera, bounds_mm: FloatArray, size_px: tuple[int, int]) -> ViewCamera:
    """Show a whole box (2, 3), whatever the direction."""
    low, high = bounds_mm
    extent = high - low + 2 * np.array(ROUND_MM)
    aspect = size_px[0] / max(size_px[1], 1)
    lying = camera.preset not in (Preset.PLANTAR, Preset.DORSAL)
    tall = extent[2] if lying else extent[1]
    wide = extent[0]
    if camera.preset in (Preset.MEDIAL, Preset.LATERAL):
        wide = extent[1]
    height = max(tall, wide / aspect, SMALLEST_VIEW_MM)
    return replace(camera, focal_mm=_point((low + high) / 2), height_mm=float(height))


def _preset_axes(preset: Preset, subject: Subject, side: Side) -> tuple[FloatArray, FloatArray]:
    """Give the upright axis and the direction to the eye."""
    x, y, z = np.eye(3)
    if preset in (Preset.PLANTAR, Preset.DORSAL):
        from_below = (preset is Preset.PLANTAR) == (subject is Subject.FOOT)
        return y, -z if from_below else z
    fronts = {
        Preset.MEDIAL: side.medial_sign * x,
        Preset.LATERAL: -side.medial_sign * x,
        Preset.POSTERIOR: -y,
        Preset.ANTERIOR: y,
    }
    return z, fronts[preset]


def _point(array: FloatArray) -> tuple[float, float, float]:
    x, y, z = (float(value) for value in array)
    return x, y, z
