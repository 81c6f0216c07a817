"""Markers in recorded sessions, for the survey of a built reference system."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path

import numpy as np

from insole_core.calibration.markers.marker_survey import MarkerView
from insole_core.errors import CalibrationError, ReconstructionError
from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.transforms import transform
from insole_core.messages import Message
from insole_core.progress import SILENT, Progress
from insole_core.reconstruct.markers.blobs import find_blobs
from insole_core.reconstruct.markers.detections import Detections, locate_blobs
from insole_core.reconstruct.poses.registration import PoseSearch
from insole_core.recording.reader import read_session
from insole_core.recording.session import ReferenceSystem, View
from insole_core.sensing.frames import mean_raw
from insole_core.sensing.readings import Readings

_NEAR_PLAN_MM = 10.0
"""Half of the least distance between two markers."""


def read_marker_views(
    sessions: Sequence[Path],
    system: ReferenceSystem,
    rigid: bool = False,
    progress: Progress = SILENT,
) -> tuple[list[MarkerView], tuple[str, ...]]:
    """Find the markers in every view of recorded sessions, on all faces.

    Parameters
    ----------
    system
        As planned.
    rigid
        Whether all sensors kept their relative poses in all sessions.

    Returns
    -------
    views : list of MarkerView
    left_out : tuple of str
        A sentence for every view that could not be used.

    Raises
    ------
    InputError
        When a session cannot be read.
    CalibrationError
        When no view shows the system.
    Cancelled
    """
    usable: list[MarkerView] = []
    left_out: list[str] = []
    views = list(_views(sessions))
    for done, (session, name, view) in enumerate(views):
        progress.step(done / len(views), "Finding the markers of {view}", view=name)
        try:
            pixels = _marker_pixels(view, system)
        except ReconstructionError as error:
            left_out.append(
                Message("{view} is left out: {reason}.", view=name, reason=error.message)
            )
        else:
            capture = (view.sensor.serial, session) if rigid else ("", "")
            usable.append(MarkerView(name, pixels, view.sensor.color_camera, *capture))
    if not usable:
        raise CalibrationError(left_out[0])
    return usable, tuple(left_out)


def _views(sessions: Sequence[Path]) -> Iterator[tuple[str, str, View]]:
    for number, path in enumerate(sessions):
        for view in read_session(path).views:
            yield f"{number}", f"{path.name}/{view.name}", view


def _marker_pixels(view: View, system: ReferenceSystem) -> dict[str, FloatArray]:
    readings = Readings.of(view.sensor)
    frames = (readings.numbers(view.read_depth(index)) for index in range(view.depth_count))
    sensor = readings.sensor
    points = sensor.points(sensor.depth_mm(mean_raw(frames, readings.per_raw)))
    detections = locate_blobs(find_blobs(view.read_color(0)), points, sensor)
    registration = PoseSearch(system, view.sensor).by_places(detections)
    own = {fix.id: np.array(fix.pixel) for fix in registration.fixes if fix.used}
    return own | _on_other_faces(detections, system, view, registration.sensor2reference)


def _on_other_faces(
    detections: Detections, system: ReferenceSystem, view: View, sensor2reference: FloatArray
) -> dict[str, FloatArray]:
    """Find markers of faces that the sensor was not assigned to, near their planned positions."""
    others = [marker for marker in system.markers if marker.face not in view.sensor.faces]
    if not others or not len(detections):
        return {}
    planned = np.array([marker.position_mm for marker in others], dtype=float)
    seen = transform(sensor2reference, detections.points)
    away_mm = np.linalg.norm(planned[:, None] - seen[None], axis=-1)
    nearest = away_mm.argmin(1)
    # A spot is at most one of them: it must be nearest to this marker.
    return {
        marker.id: detections.pixels[spot]
        for row, (marker, spot) in enumerate(zip(others, nearest, strict=True))
        if away_mm[row, spot] < _NEAR_PLAN_MM and away_mm[:, spot].argmin() == row
    }
