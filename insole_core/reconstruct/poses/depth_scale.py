"""Whether the depth of a view has the scale of its reference system, by its own markers.

The colour image alone tells how far away the markers are: from their size, to 0.05 % of the
distance. The depth image measures the same distances. In views of calibrated sensors the two agree
within 0.15 %, 1 mm; a scale that is wrong by 1 % moves the view by 7 mm along its axis, which
neither the reprojection errors nor the residuals of the markers show clearly, since the pose lies
between the two.
"""

from __future__ import annotations

import numpy as np

from insole_core.errors import ReconstructionError
from insole_core.geometry.transforms import transform
from insole_core.messages import Message
from insole_core.reconstruct.markers.detections import Detections
from insole_core.reconstruct.markers.marker_observation import Registration
from insole_core.reconstruct.poses.camera_pose import SeenMarkers, fit_camera_pose
from insole_core.recording.session import ReferenceSystem
from insole_core.sensing.sensor import Sensor

_LEAST = 0.004
"""More than twice what views of calibrated sensors show, from 650 to 950 mm."""
_LARGEST = 0.05
"""Beyond, the pose or the markers are as likely to be wrong as the depth."""
_LEAST_DEVIATIONS = 4.0
_LEAST_MARKERS = 4
_SAME_PX = 0.5
_MAD_TO_STD = 1.4826


def depth_scale(
    registration: Registration, sightings: Detections, system: ReferenceSystem, sensor: Sensor
) -> float:
    """Return measured over true depth of a view, from markers whose places are known.

    Parameters
    ----------
    registration
        The pose, fitted in the colour image, and its markers.
    sightings
        Markers with a depth reading.
    system
        The places of the markers.
    sensor
        That of the view.

    Returns
    -------
    float
        1 if depth and colour image do not contradict each other.

    Raises
    ------
    ReconstructionError
        When they contradict each other too much to be reconciled; the end of a sentence.
    """
    fixes = [fix for fix in registration.fixes if not fix.excluded]
    if registration.camera_pose is None or not len(sightings) or not fixes:
        return 1.0
    pixels = np.array([fix.pixel for fix in fixes])
    apart_px = np.linalg.norm(pixels[:, None] - sightings.pixels, axis=2)
    nearest = apart_px.argmin(1)
    depths_mm = transform(sensor.depth2color, sightings.points)[nearest, 2]
    measured_mm = np.where(apart_px.min(1) < _SAME_PX, depths_mm, np.nan)
    if np.isfinite(measured_mm).sum() < _LEAST_MARKERS:
        return 1.0
    places = {marker.id: marker.position_mm for marker in system.markers}
    positions = np.array([places[fix.id] for fix in fixes])
    unmeasured = np.full(len(fixes), np.nan)
    pose = fit_camera_pose(
        SeenMarkers(positions, positions, pixels, unmeasured),
        sensor.color_camera,
        registration.camera_pose.reference2color,
    )
    expected_mm = transform(pose.reference2color, positions)[:, 2]
    ratios = (measured_mm / expected_mm)[np.isfinite(measured_mm)]
    scale = float(np.median(ratios))
    scatter = _MAD_TO_STD * float(np.median(np.abs(ratios - scale))) / np.sqrt(len(ratios))
    by_image = float(np.sqrt(pose.covariance[5, 5]) / expected_mm.mean())
    if abs(scale - 1) < max(_LEAST, _LEAST_DEVIATIONS * float(np.hypot(scatter, by_image))):
        return 1.0
    if abs(scale - 1) > _LARGEST:
        raise ReconstructionError(
            "its depth is {percent:.0f} % {direction} than its markers in the colour image say; "
            "calibrate the sensor, and see that the session has the right reference system",
            percent=100 * abs(scale - 1),
            direction=_direction(scale),
        )
    return scale


def scale_note(scale: float) -> str:
    """Describe a scale that was corrected, as the end of a sentence; empty for 1."""
    if scale == 1.0:
        return ""
    return Message(
        "the depth is {percent:.1f} % {direction} than the markers in the colour image say, and is "
        "corrected by that; calibrate the sensor, and see that the session has the right reference "
        "system",
        percent=100 * abs(scale - 1),
        direction=_direction(scale),
    )


def _direction(scale: float) -> str:
    return Message("larger") if scale > 1 else Message("smaller")
