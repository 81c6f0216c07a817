"""What a reconstruction gives back, and the report that is written of it."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import Any, Literal

import numpy as np

from insole_core.errors import ReconstructionError
from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.reconstruct.fusion.depth_view import DepthView
from insole_core.reconstruct.markers.marker_observation import MarkerObservation, Registration
from insole_core.reconstruct.poses.pose_quality import PoseRefusedError

Method = Literal["fused", "thesis"]


@dataclass(frozen=True)
class Residuals:
    """Distances of the measured markers from the reference system after registration, mm."""

    mean: float
    rms: float
    max: float

    @staticmethod
    def of(distances_mm: FloatArray) -> Residuals:
        """Sum up the distances (k,), mm, k > 0."""
        rms = float(np.sqrt((distances_mm**2).mean()))
        return Residuals(float(distances_mm.mean()), rms, float(distances_mm.max()))


@dataclass(frozen=True, eq=False)
class ViewResult:
    """What became of one view.

    Parameters
    ----------
    name
    used
        Whether it is part of the foot.
    reason
        Why it is not; of a used view what is to be known of it, mostly nothing.
    sensor2reference : (4, 4) float64, mm, optional
    residuals
    fixes
        Every marker that was found.
    reprojection_px, displacement_mm
        How well the markers fit in the colour image (root mean square), and the standard deviation
        of the place of the foot's middle that comes with the pose's; not for the thesis's chain.
    frames, left_out
        How many depth frames there are, and how many of them showed something that had moved.
    """

    name: str
    used: bool
    reason: str = ""
    sensor2reference: FloatArray | None = None
    residuals: Residuals | None = None
    fixes: tuple[MarkerObservation, ...] = ()
    reprojection_px: float | None = None
    displacement_mm: float | None = None
    frames: int = 0
    left_out: int = 0

    @property
    def markers_found(self) -> int:
        """Blobs assigned to markers."""
        return len(self.fixes)

    @property
    def markers_used(self) -> int:
        """Markers that determined the pose."""
        return sum(fix.used for fix in self.fixes)


def refused_result(name: str, error: ReconstructionError) -> ViewResult:
    """Say why a view is not part of the foot, with its markers where a pose was found."""
    if isinstance(error, PoseRefusedError):
        return replace(placed_result(name, error.registration), reason=str(error))
    return ViewResult(name, used=False, reason=str(error))


def placed_result(name: str, registration: Registration) -> ViewResult:
    """Say where a view stood; whether it is used is another question."""
    pose, distances_mm = registration.camera_pose, registration.residuals_mm
    return ViewResult(
        name,
        used=False,
        sensor2reference=registration.sensor2reference,
        residuals=Residuals.of(distances_mm) if len(distances_mm) else None,
        fixes=registration.fixes,
        reprojection_px=None if pose is None else pose.rms_px,
        displacement_mm=registration.displacement_mm,
    )


@dataclass(frozen=True, eq=False)
class Surface:
    """A coloured mesh, mm, reference frame, and how certain it is.

    Parameters
    ----------
    mesh
    deviation_mm : (n,) float64, optional
        Standard deviation of every vertex along the surface's normal, where it is known.
    view_gaps_mm : (views, views, 3) float64, reference frame, optional
        How far the foot seems to have moved from each used view to each other; NaN where too
        little was seen by both.
    depth_views
        What it was made of: of every used view what lies in the volume of interest. Of the fused
        method only.
    """

    mesh: TriangleMesh
    deviation_mm: FloatArray | None = None
    view_gaps_mm: FloatArray | None = None
    depth_views: tuple[DepthView, ...] = ()


@dataclass(frozen=True, eq=False)
class Reconstruction:
    """A coloured foot and how it came about.

    Parameters
    ----------
    mesh : mm, reference frame
    views
        In the session's order.
    warnings
        A sentence each.
    seconds
        Time of every step, by name.
    deviation_mm : (n,) float64, optional
        Standard deviation of every vertex along the surface's normal; not for the thesis's chain.
    coverage
        Share of every region of the foot that has a surface, 0 to 1.
    depth_views
        Of every used view what lies in the volume of interest; not for the thesis's chain.
    """

    mesh: TriangleMesh
    views: tuple[ViewResult, ...]
    warnings: tuple[str, ...]
    seconds: dict[str, float]
    deviation_mm: FloatArray | None = None
    coverage: dict[str, float] = field(default_factory=dict)
    depth_views: tuple[DepthView, ...] = ()


def report_json(reconstruction: Reconstruction, total_seconds: float) -> dict[str, Any]:
    """Give the report of the contract; `total_seconds` from first file read to last written."""
    return {
        "views": [_view_json(view) for view in reconstruction.views],
        "vertices": len(reconstruction.mesh.vertices),
        "triangles": len(reconstruction.mesh.triangles),
        "seconds": {"total": total_seconds, **reconstruction.seconds},
        "coverage": reconstruction.coverage,
        "warnings": list(reconstruction.warnings),
    }


def _view_json(view: ViewResult) -> dict[str, Any]:
    pose, residuals = view.sensor2reference, view.residuals
    return {
        "name": view.name,
        "used": view.used,
        "reason": view.reason,
        "markers_found": view.markers_found,
        "markers_used": view.markers_used,
        "residual_mm": None
        if residuals is None
        else {"mean": residuals.mean, "rms": residuals.rms, "max": residuals.max},
        "reprojection_px": view.reprojection_px,
        "displacement_mm": view.displacement_mm,
        "frames": view.frames,
        "frames_left_out": view.left_out,
        "sensor2reference": None if pose is None else pose.tolist(),
        "markers": [
            {
                "id": fix.id,
                "pixel": list(fix.pixel),
                "position_mm": list(fix.position_mm),
                "residual_mm": fix.residual_mm,
                "used": fix.used,
                "reprojection_px": fix.reprojection_px,
                "by_hand": fix.by_hand,
                "excluded": fix.excluded,
            }
            for fix in view.fixes
        ],
    }
