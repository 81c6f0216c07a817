"""From a recorded session to one coloured foot in the reference frame."""

from insole_core.reconstruct.markers.marker_observation import MarkerObservation
from insole_core.reconstruct.poses.pose_quality import RegistrationLimits
from insole_core.reconstruct.reconstruction import reconstruct
from insole_core.reconstruct.result import (
    DepthSource,
    Method,
    Reconstruction,
    Residuals,
    ViewResult,
    report_json,
)

__all__ = [
    "DepthSource",
    "MarkerObservation",
    "Method",
    "Reconstruction",
    "RegistrationLimits",
    "Residuals",
    "ViewResult",
    "reconstruct",
    "report_json",
]
