"""The markers that recorded sessions show, for the survey of a built reference system."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
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


def read_marker_views(
    sessions: Sequence[Path], system: ReferenceSystem, progress: Progress = SILENT
) -> tuple[list[MarkerView], tuple[str, ...]]:
    """Find the markers in every view of recorded sessions.

    Returns
    -------
    list of MarkerView, tuple of str
        And a sentence for every view that could not be used.

    Raises
    ------
    InputError
        When a session cannot be read.
    CalibrationError
        When no view shows the system.
    """
    found: list[MarkerView] = []
    left_out: list[str] = []
    views = list(_views(sessions))
    for done, (name, view) in enumerate(views):
        progress.step(done / len(views), f"Finding the markers of {name}")
        try:
            pixels = _marker_pixels(view, system)
        except ReconstructionError as error:
            left_out.append(f"{name} is left out: {error}.")
        else:
            found.append(MarkerView(name, pixels, view.sensor.color_camera))
    if not found:
        raise CalibrationError(left_out[0])
    return found, tuple(left_out)


def _views(sessions: Sequence[Path]) -> Iterator[tuple[str, View]]:
    for path in sessions:
        for view in read_session(path).views:
            yield f"{path.name}/{view.name}", view


def _marker_pixels(view: View, system: ReferenceSystem) -> dict[str, np.ndarray]:
    frames = (view.read_depth(index) for index in range(view.depth_count))
    depth = view.sensor.depth_mm(capture_from_frames(view.name, frames).raw)
    blobs = find_blobs(view.read_color(0))
    sightings = locate_blobs(blobs, view.sensor.points(depth), view.sensor)
    fixes = register(sightings, system, view.sensor).fixes
    return {fix.id: np.array(fix.pixel) for fix in fixes if fix.used}
