"""The pose of one view, and the markers it rests on."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.transforms import transform
from insole_core.reconstruct.poses.camera_pose import CameraPose


@dataclass(frozen=True)
class MarkerObservation:
    """One marker as observed by one view.

    Parameters
    ----------
    id
    pixel
        (u, v) of its centre in the colour image, px.
    position_mm
        Measured position, reference frame.
    residual_mm
        Distance of the measured position from the one in the reference system.
    used
        Whether it helped to determine the pose.
    reprojection_px
        Distance between observed and projected centre in the colour image; None for the thesis's
        method.
    projected
        (u, v) of the centre projected with the pose, px; None for the thesis's method.
    by_hand
        Whether the user pointed at it.
    excluded
        Whether the user excluded it.
    """

    id: str
    pixel: tuple[float, float]
    position_mm: tuple[float, float, float]
    residual_mm: float
    used: bool
    reprojection_px: float | None = None
    projected: tuple[float, float] | None = None
    by_hand: bool = False
    excluded: bool = False


@dataclass(frozen=True, eq=False)
class Registration:
    """The pose of one view and the markers it rests on.

    Parameters
    ----------
    sensor2reference : (4, 4) float64, mm
        Pose of the depth camera.
    fixes
        The observed markers, in the order of the reference system.
    camera_pose : optional
        Pose of the colour camera with its covariance, when it was fitted in the colour image.
    displacement_mm : optional
        Standard deviation of the position of the foot's middle that follows from the pose's; with
        `camera_pose` only.
    depth_scale
        Measured over true depth; other than 1 where the markers contradict the depth image. The
        pose is that of the view with its depth divided by it.
    """

    sensor2reference: FloatArray
    fixes: tuple[MarkerObservation, ...]
    camera_pose: CameraPose | None = None
    displacement_mm: float | None = None
    depth_scale: float = 1.0

    @property
    def residuals_mm(self) -> FloatArray:
        """(k,) residuals of the markers that determined the pose."""
        return np.array([fix.residual_mm for fix in self.fixes if fix.used])

    def moved(self, from2to: FloatArray, middle: FloatArray) -> Registration:
        """Return the registration in another frame.

        Parameters
        ----------
        from2to : (4, 4) float64, mm
        middle : (3,) float64, mm, old frame
            Middle of the foot, of which the displacement is told.
        """
        pose, displacement_mm = self.camera_pose, self.displacement_mm
        if pose is not None:
            displacement_mm = pose.displacement_mm(middle)
            pose = pose.moved(from2to)
        fixes = tuple(
            replace(fix, position_mm=_triple(transform(from2to, np.array([fix.position_mm]))[0]))
            for fix in self.fixes
        )
        sensor2reference = from2to @ self.sensor2reference
        return replace(
            self,
            sensor2reference=sensor2reference,
            fixes=fixes,
            camera_pose=pose,
            displacement_mm=displacement_mm,
        )


def _triple(point: FloatArray) -> tuple[float, float, float]:
    x, y, z = point.tolist()
    return x, y, z
