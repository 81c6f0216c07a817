"""The pose of one view, and the markers it rests on."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from insole_core.geometry.arrays import FloatArray
from insole_core.reconstruct.poses.camera_pose import CameraPose


@dataclass(frozen=True)
class MarkerObservation:
    """One marker as one view saw it.

    Parameters
    ----------
    id
    pixel
        (u, v) of its centre in the colour image, px.
    position_mm
        Measured, reference frame.
    residual_mm
        Distance from where the reference system has it.
    used
        Whether it helped to determine the pose.
    reprojection_px
        Distance in the colour image from where the pose puts it; the thesis's chain has none.
    projected
        (u, v) where the pose puts it; the thesis's chain has none.
    by_hand
        Whether somebody pointed at it.
    excluded
        Whether somebody excluded it.
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
    fixes
        In the order of the reference system.
    camera_pose : optional
        With its certainty, where the pose was found in the colour image.
    displacement_mm : optional
        Standard deviation of the place of the foot's middle that comes with the pose's; with
        `camera_pose` only.
    """

    sensor2reference: FloatArray
    fixes: tuple[MarkerObservation, ...]
    camera_pose: CameraPose | None = None
    displacement_mm: float | None = None

    @property
    def residuals_mm(self) -> FloatArray:
        """(k,) residuals of the markers that determined the pose."""
        return np.array([fix.residual_mm for fix in self.fixes if fix.used])
