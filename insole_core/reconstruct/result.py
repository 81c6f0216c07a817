"""The result of a reconstruction and its report."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import Any, Literal

import numpy as np

from insole_core.errors import ReconstructionError
from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.reconstruct.fusion.depth_view import DepthView
from insole_core.reconstruct.fusion.infrared_surface import InfraredUse
from insole_core.reconstruct.markers.marker_observation import MarkerObservation, Registration
from insole_core.reconstruct.poses.pose_quality import PoseRefusedError
from insole_core.sensing.family import SensorFamily

Method = Literal["fused", "thesis"]
DepthSource = Literal["auto", "infrared", "chip"]


@dataclass(frozen=True)
class Residuals:
    """Distances of the measured markers from the reference system after registration, mm."""

    mean: float
    rms: float
    max: float

    @staticmethod
    def of(distances_mm: FloatArray) -> Residuals:
        """Summarise distances (k,), mm, k > 0."""
        rms = float(np.sqrt((distances_mm**2).mean()))
        return Residuals(float(distances_mm.mean()), rms, float(distances_mm.max()))


@dataclass(frozen=True, eq=False)
class ViewResult:
    """The result of one view.

    Parameters
    ----------
    name
    used
        Whether it is part of the foot.
    reason
        Why it is not; for a used view remarks about it, often empty.
    sensor2reference : (4, 4) float64, mm, optional
        Pose of the depth camera, if it was found.
    residuals
        Of the markers that determined the pose.
    fixes
        Every marker that was found.
    reprojection_px
        Root mean square of the reprojection errors; None for the thesis's method.
    displacement_mm
        Standard deviation of the position of the foot's middle that follows from the pose's; None
        for the thesis's method.
    frames, left_out
        Number of depth frames, and of those left out because something moved in them.
    family
        Of its sensor; None for a view that is not used.
    depth_scale
        Measured over true depth, by which the view was corrected.
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
    family: SensorFamily | None = None
    depth_scale: float = 1.0

    @property
    def markers_found(self) -> int:
        """Number of markers that were found."""
        return len(self.fixes)

    @property
    def markers_used(self) -> int:
        """Number of markers that determined the pose."""
        return sum(fix.used for fix in self.fixes)


def refused_result(name: str, error: ReconstructionError) -> ViewResult:
    """Return the result of a view that is not part of the foot.

    Parameters
    ----------
    name
        Of the view.
    error
        The reason; a `PoseRefusedError` also gives the pose and its markers.

    Returns
    -------
    ViewResult
        Not used, with the reason and, when a pose was found, the pose and its markers.
    """
    if isinstance(error, PoseRefusedError):
        return replace(placed_result(name, error.registration), reason=str(error))
    return ViewResult(name, used=False, reason=str(error))


def placed_result(name: str, registration: Registration) -> ViewResult:
    """Return the result of a view of known pose, not yet marked as used."""
    pose, distances_mm = registration.camera_pose, registration.residuals_mm
    return ViewResult(
        name,
        used=False,
        sensor2reference=registration.sensor2reference,
        residuals=Residuals.of(distances_mm) if len(distances_mm) else None,
        fixes=registration.fixes,
        reprojection_px=None if pose is None else pose.rms_px,
        displacement_mm=registration.displacement_mm,
        depth_scale=registration.depth_scale,
    )


@dataclass(frozen=True, eq=False)
class Surface:
    """A coloured mesh with its uncertainty.

    Parameters
    ----------
    mesh : mm, reference frame
    deviation_mm : (n,) float64, optional
        Standard deviation of every vertex along the surface's normal; fused method only.
    correction_mm : (n,) float64, optional
        By how much the correction of the sensor's matching moved the readings at every vertex,
        outwards along the surface's normal; NaN where unknown. Fused method only.
    view_gaps_mm : (views, views, 3) float64, reference frame, optional
        Apparent motion of the foot from each used view to each other; NaN where both measured too
        little in common. Fused method only.
    depth_views
        The readings of every used view in the volume of interest; fused method only.
    infrared
        What became of the infrared pictures that were compared, by the name of the view.
    infrared_share
        Of the vertices, whose deviation is that by infrared, because it is the smaller one.
    warnings
        A sentence each.
    """

    mesh: TriangleMesh
    deviation_mm: FloatArray | None = None
    correction_mm: FloatArray | None = None
    view_gaps_mm: FloatArray | None = None
    depth_views: tuple[DepthView, ...] = ()
    infrared: dict[str, InfraredUse] = field(default_factory=dict)
    infrared_share: float = 0.0
    warnings: tuple[str, ...] = ()


@dataclass(frozen=True, eq=False)
class Reconstruction:
    """A coloured foot and how it was made.

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
        Standard deviation of every vertex along the surface's normal; fused method only.
    correction_mm : (n,) float64, optional
        By how much the correction of the sensor's matching moved the readings at every vertex,
        outwards along the surface's normal; NaN where unknown. Fused method only.
    coverage
        Measured share of every region of the foot, 0 to 1.
    depth_views
        The readings of every used view in the volume of interest; fused method only.
    infrared, infrared_share
        As of `Surface`.
    """

    mesh: TriangleMesh
    views: tuple[ViewResult, ...]
    warnings: tuple[str, ...]
    seconds: dict[str, float]
    deviation_mm: FloatArray | None = None
    correction_mm: FloatArray | None = None
    coverage: dict[str, float] = field(default_factory=dict)
    depth_views: tuple[DepthView, ...] = ()
    infrared: dict[str, InfraredUse] = field(default_factory=dict)
    infrared_share: float = 0.0


def report_json(reconstruction: Reconstruction, total_seconds: float) -> dict[str, Any]:
    """Return the report of a reconstruction, ready to be written as JSON.

    Parameters
    ----------
    reconstruction
    total_seconds
        From the first file read to the last one written.

    Returns
    -------
    dict
        Whether infrared pictures were used and how much they were trusted, where any were compared;
        views with their markers, size of the mesh, seconds, coverage, how far the correction moved
        the surface, and warnings; lengths in mm.
    """
    depth = _depth_json(reconstruction)
    return {
        **({} if depth is None else {"depth": depth}),
        "views": [_view_json(view) for view in reconstruction.views],
        "vertices": len(reconstruction.mesh.vertices),
        "triangles": len(reconstruction.mesh.triangles),
        "seconds": {"total": total_seconds, **reconstruction.seconds},
        "coverage": reconstruction.coverage,
        "correction_mm": _correction_json(reconstruction.correction_mm),
        "warnings": list(reconstruction.warnings),
    }


def _depth_json(made: Reconstruction) -> dict[str, Any] | None:
    """Return where the surface comes from; None where no infrared picture was compared."""
    infrared = made.infrared
    if not infrared:
        return None
    source = "infrared" if any(use.used for use in infrared.values()) else "chip"
    return {
        "source": source,
        "trusted_share": {name: use.trusted for name, use in infrared.items()},
        "bright_share": {name: use.bright for name, use in infrared.items()},
        "noisy_share": {name: use.noisy for name, use in infrared.items()},
        "foot_share": made.infrared_share,
        "deviation_of": source,
    }


def _correction_json(correction_mm: FloatArray | None) -> dict[str, float] | None:
    """Return mean and 95 % of the ways; None where nothing was corrected."""
    if correction_mm is None or not np.isfinite(correction_mm).any():
        return None
    ways_mm = np.abs(correction_mm[np.isfinite(correction_mm)])
    return {"mean": float(ways_mm.mean()), "p95": float(np.quantile(ways_mm, 0.95))}


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
        "sensor_family": None if view.family is None else view.family.name,
        "matching_error_learnt": None if view.family is None else view.family.learnt,
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
