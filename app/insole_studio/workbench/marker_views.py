"""The markers that recorded sessions show, for the survey of a built reference system."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from insole_core.calibration.captures import capture_from_frames
from insole_core.calibration.marker_survey import MarkerView
from insole_core.errors import CalibrationError, ReconstructionError
from insole_core.progress import SILENT, Progress
from insole_core.reconstruct.blobs import find_blobs
from insole_core.reconstruct.registration import register
from insole_core.reconstruct.sighting import locate_blobs
from insole_core.recording.reader import read_session
from insole_core.recording.session import ReferenceSystem, View
from insole_core.sensing.camera import Camera


@dataclass(frozen=True, eq=False)
class MarkerViews:
    """What one sensor saw of a reference system.

    Parameters
    ----------
    serial
        Of the sensor with the most views.
    camera
        Its colour camera.
    views
    left_out
        Sentences about views that could not be used.
    """

    serial: str
    camera: Camera
    views: tuple[MarkerView, ...]
    left_out: tuple[str, ...]


def read_marker_views(
    sessions: Sequence[Path], system: ReferenceSystem, progress: Progress = SILENT
) -> MarkerViews:
    """Find the markers in every view that the most used sensor recorded.

    Raises
    ------
    InputError
        When a session cannot be read.
    CalibrationError
        When no view shows the system.
    """
    views = list(_views(sessions))
    serials = [view.sensor.serial for _, view in views]
    serial = max(dict.fromkeys(serials), key=serials.count)
    found: list[MarkerView] = []
    left_out: list[str] = []
    own = [(name, view) for name, view in views if view.sensor.serial == serial]
    for done, (name, view) in enumerate(own):
        progress.step(done / len(own), f"Finding the markers of {name}")
        try:
            found.append(MarkerView(name, _marker_pixels(view, system)))
        except ReconstructionError as error:
            left_out.append(f"{name} is left out: {error}.")
    if not found:
        raise CalibrationError(left_out[0])
    camera = own[0][1].sensor.color_camera
    return MarkerViews(serial, camera, tuple(found), tuple(left_out))


def _views(sessions: Sequence[Path]) -> Iterator[tuple[str, View]]:
    for path in sessions:
        for view in read_session(path).views:
            yield f"{path.name}/{view.name}", view


def _marker_pixels(view: View, system: ReferenceSystem) -> dict[str, np.ndarray]:
    frames = (view.read_depth(index) for index in range(view.depth_count))
    depth = view.sensor.depth_mm(capture_from_frames(view.name, frames).raw)
    blobs = find_blobs(view.read_color(0))
    sightings = locate_blobs(blobs, view.sensor.points(depth), view.sensor)
    fixes = register(sightings, system, view.sensor.faces).fixes
    return {fix.id: np.array(fix.pixel) for fix in fixes if fix.used}
