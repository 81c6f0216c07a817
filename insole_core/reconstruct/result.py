"""What a reconstruction gives back, and the report that is written of it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Literal

import numpy as np

from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.reconstruct.registration import MarkerFix

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
    """

    name: str
    used: bool
    reason: str = ""
    sensor2reference: FloatArray | None = None
    residuals: Residuals | None = None
    fixes: tuple[MarkerFix, ...] = ()

    @property
    def markers_found(self) -> int:
        """Blobs assigned to markers."""
        return len(self.fixes)

    @property
    def markers_used(self) -> int:
        """Markers that determined the pose."""
        return sum(fix.used for fix in self.fixes)


@dataclass(frozen=True, eq=False)
class Surface:
    """A coloured mesh, mm, reference frame, and how certain it is.

    Parameters
    ----------
    mesh
    deviation_mm : (n,) float64, optional
        Standard deviation of every vertex along the surface's normal, where it is known.
    """

    mesh: TriangleMesh
    deviation_mm: FloatArray | None = None


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
    """

    mesh: TriangleMesh
    views: tuple[ViewResult, ...]
    warnings: tuple[str, ...]
    seconds: dict[str, float]
    deviation_mm: FloatArray | None = None


def report_json(reconstruction: Reconstruction, total_seconds: float) -> dict[str, Any]:
    """Give the report of the contract; `total_seconds` from first file read to last written."""
    return {
        "views": [_view_json(view) for view in reconstruction.views],
        "vertices": len(reconstruction.mesh.vertices),
        "triangles": len(reconstruction.mesh.triangles),
        "seconds": {"total": total_seconds, **reconstruction.seconds},
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
        "sensor2reference": None if pose is None else pose.tolist(),
        "markers": [
            {
                "id": fix.id,
                "pixel": list(fix.pixel),
                "position_mm": list(fix.position_mm),
                "residual_mm": fix.residual_mm,
                "used": fix.used,
                "reprojection_px": fix.reprojection_px,
            }
            for fix in view.fixes
        ],
    }
