"""The camera as a value that keeps the foot upright, and its arithmetic.

Both views share one `ViewCamera`. Its plantar preset shows the foot from below and the insole from
above, so that the sole and what it stands on are seen like two pages of an open book.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from enum import StrEnum
from functools import lru_cache

import numpy as np

from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.side import Side
from insole_core.geometry.transforms import rotation_about

MAX_ELEVATION_DEG = 85.0
SMALLEST_VIEW_MM = 10.0
LARGEST_VIEW_MM = 2000.0
ROUND_MM = (45.0, 30.0, 24.0)
"""Margin around a fitted box for the anatomical directions, in x, y and z."""


class Preset(StrEnum):
    """The named viewing directions."""

    PLANTAR = "plantar"
    MEDIAL = "medial"
    LATERAL = "lateral"
    POSTERIOR = "posterior"
    ANTERIOR = "anterior"
    DORSAL = "dorsal"


class Subject(StrEnum):
    """What a view shows."""

    FOOT = "foot"
    INSOLE = "insole"


@dataclass(frozen=True)
class ViewCamera:
    """A camera in parallel projection, so that lengths on the screen are true.

    Parameters
    ----------
    preset
        Direction and upright axis from which the angles are counted.
    azimuth_deg
        Rotation about the upright axis.
    elevation_deg
        Elevation above (> 0) the direction of the preset.
    focal_mm
        The point in the middle of the image.
    height_mm
        Length that the image shows from top to bottom.
    """

    preset: Preset = Preset.PLANTAR
    azimuth_deg: float = 0.0
    elevation_deg: float = 0.0
    focal_mm: tuple[float, float, float] = (0.0, 130.0, 20.0)
    height_mm: float = 300.0

    def orbited(self, azimuth_deg: float, elevation_deg: float) -> ViewCamera:
        """Return the rotated camera.

        Parameters
        ----------
        azimuth_deg
            Rotation about the upright axis.
        elevation_deg
            Change of the elevation, which stops short of the poles.
        """
        elevation = self.elevation_deg + elevation_deg
        return replace(
            self,
            azimuth_deg=(self.azimuth_deg + azimuth_deg + 180.0) % 360.0 - 180.0,
            elevation_deg=float(np.clip(elevation, -MAX_ELEVATION_DEG, MAX_ELEVATION_DEG)),
        )

    def zoomed(self, factor: float, about_mm: FloatArray | None = None) -> ViewCamera:
        """Return the camera scaled by `factor`; `about_mm` keeps its place on the screen.

        Parameters
        ----------
        factor
            Ratio of the new visible height to the old one; < 1 zooms in.
        about_mm : (3,) float64
            By default the focal point.
        """
        height = float(np.clip(self.height_mm * factor, SMALLEST_VIEW_MM, LARGEST_VIEW_MM))
        focal = np.asarray(self.focal_mm)
        if about_mm is not None:
            focal = about_mm + (focal - about_mm) * (height / self.height_mm)
        return replace(self, height_mm=height, focal_mm=_point(focal))

    def centred(self, focal_mm: FloatArray) -> ViewCamera:
        """Return the camera centred on a point."""
        return replace(self, focal_mm=_point(focal_mm))


@dataclass(frozen=True, eq=False)
class ViewTransform:
    """The view transform of a camera for one subject and one image size.

    Parameters
    ----------
    right, up, back : (3,) float64
        Unit vectors of the image in the insole frame; `back` points from the scene to the eye.
    focal_mm : (3,) float64
        The point in the middle of the image, insole frame.
    height_mm
        Length that the image shows from top to bottom.
    size_px
        Width and height of the image.
    """

    right: FloatArray
    up: FloatArray
    back: FloatArray
    focal_mm: FloatArray
    height_mm: float
    size_px: tuple[int, int]

    @property
    def mm_per_px(self) -> float:
        """Length of one pixel."""
        return self.height_mm / max(self.size_px[1], 1)

    def point_at(self, x_px: float, y_px: float) -> FloatArray:
        """Return the point under a pixel in the plane through the focal point; (3,) mm."""
        dx = (x_px - self.size_px[0] / 2) * self.mm_per_px
        dy = (self.size_px[1] / 2 - y_px) * self.mm_per_px
        return np.asarray(self.focal_mm + dx * self.right + dy * self.up)

    def ray_at(self, x_px: float, y_px: float) -> tuple[FloatArray, FloatArray]:
        """Return origin (3,) mm and unit direction (3,) of the ray into the scene at a pixel."""
        return self.point_at(x_px, y_px) + self.back * LARGEST_VIEW_MM, -self.back

    def pixels_of(self, points: FloatArray) -> FloatArray:
        """Return the pixels (n, 2) at which points (n, 3) appear."""
        offset = np.atleast_2d(points) - self.focal_mm
        x = self.size_px[0] / 2 + offset @ self.right / self.mm_per_px
        y = self.size_px[1] / 2 - offset @ self.up / self.mm_per_px
        return np.stack([x, y], axis=1)


@lru_cache(maxsize=16)  # each move of the pointer asks several times
def look(
    camera: ViewCamera, subject: Subject, side: Side, size_px: tuple[int, int]
) -> ViewTransform:
    """Return the view transform of a camera.

    Parameters
    ----------
    camera
        The shared camera.
    subject
        Foot or insole, on which the direction of a preset depends.
    side
        Side of the foot, which decides where medial is.
    size_px
        Width and height of the image.
    """
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
    """Return the camera centred and scaled so that a whole box is visible.

    Parameters
    ----------
    camera
        The camera, whose direction is kept.
    bounds_mm : (2, 3) float64
        The box, insole frame.
    size_px
        Width and height of the image.
    """
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
    """Return the upright axis (3,) and the direction (3,) to the eye."""
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
