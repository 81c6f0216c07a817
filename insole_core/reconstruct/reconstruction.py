"""From a recorded session to one coloured foot, the thesis's chain (chapters 4 to 6)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from insole_core.errors import ReconstructionError
from insole_core.geometry.arrays import ByteArray, FloatArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.transforms import transform
from insole_core.progress import SILENT, Progress
from insole_core.reconstruct.blobs import find_blobs
from insole_core.reconstruct.coloring import color_points, mean_color
from insole_core.reconstruct.midline import cut_at_midline
from insole_core.reconstruct.overlap import blend_overlaps
from insole_core.reconstruct.registration import (
    DEFAULT_LIMITS,
    Registration,
    RegistrationLimits,
    register,
)
from insole_core.reconstruct.result import Method, Reconstruction, Residuals, ViewResult
from insole_core.reconstruct.sheet import (
    Sheet,
    join,
    longest_edges,
    triangulate,
    without_small_pieces,
)
from insole_core.reconstruct.sighting import locate_blobs
from insole_core.reconstruct.stopwatch import Stopwatch
from insole_core.reconstruct.volume import is_inside, volume_of_interest
from insole_core.recording.session import Box, Session, View
from insole_core.sensing.frames import mean_raw, median_raw
from insole_core.sensing.sensor import Sensor


def reconstruct(
    session: Session,
    method: Method = "fused",
    progress: Progress = SILENT,
    limits: RegistrationLimits = DEFAULT_LIMITS,
) -> Reconstruction:
    """Make one coloured foot, in the reference frame, from the views of a session.

    Parameters
    ----------
    session
    method
        ``thesis``: median of the frames, depth in whole mm, views cut where they overlap.
        ``fused``: mean of the frames in disparity, fractions of a mm, overlaps blended by weight.
    progress
    limits
        When the pose of a view is good enough.

    Raises
    ------
    ReconstructionError
        When no view can be used; the sentence names the reason of each.
    """
    chain = _Chain(session, method, limits, Stopwatch())
    sheets: list[Sheet] = []
    results: list[ViewResult] = []
    for number, view in enumerate(session.views):
        start, end = (0.9 * (number + done) / len(session.views) for done in (0, 1))
        try:
            sheet, registration = chain.measure(view, progress.part(start, end))
        except ReconstructionError as error:
            results.append(ViewResult(view.name, used=False, reason=str(error)))
            continue
        sheets.append(sheet)
        results.append(_used(view, registration))
    _check_any_used(session, results)
    progress.step(0.9, "Joining the views")
    mesh = chain.merge(sheets)
    progress.step(1.0, "The foot is ready")
    return Reconstruction(mesh, tuple(results), _warnings(results), chain.clock.seconds)


@dataclass(frozen=True, eq=False)
class _Chain:
    """The steps of one reconstruction, with what they all need."""

    session: Session
    method: Method
    limits: RegistrationLimits
    clock: Stopwatch

    def measure(self, view: View, progress: Progress) -> tuple[Sheet, Registration]:
        """Bring one view to the reference frame as a surface."""
        progress.step(0.0, f"Averaging the frames of the view {view.name}")
        with self.clock.measuring("frames"):
            points = view.sensor.points(average_depth(view, self.method))
            color = mean_color(view)
        progress.step(0.4, f"Finding the markers of the view {view.name}")
        with self.clock.measuring("markers"):
            sightings = locate_blobs(find_blobs(color), points, view.sensor)
            system = self.session.manifest.reference_system
            registration = register(sightings, system, view.sensor.faces, self.limits)
        progress.step(0.8, f"Building the surface of the view {view.name}")
        with self.clock.measuring("surface"):
            box = volume_of_interest(self.session.manifest)
            sheet = _build_sheet(points, color, view.sensor, registration.sensor2reference, box)
        return sheet, registration

    def merge(self, sheets: list[Sheet]) -> TriangleMesh:
        """Make one mesh of the views' surfaces."""
        with self.clock.measuring("merge"):
            merged = cut_at_midline(sheets) if self.method == "thesis" else blend_overlaps(sheets)
            return join([without_small_pieces(sheet) for sheet in merged])


def _warnings(results: list[ViewResult]) -> tuple[str, ...]:
    return tuple(
        f"The view {result.name} is left out: {result.reason}."
        for result in results
        if not result.used
    )


def average_depth(view: View, method: Method) -> FloatArray:
    """Average a view's depth frames and convert them, thesis (12), (16), 6.1.

    Returns
    -------
    (height, width) float64, mm along z, NaN = no reading; whole mm for the thesis's method

    Raises
    ------
    ReconstructionError
        When no pixel has a reading in at least half of the frames.
    """
    frames = (view.read_depth(index) for index in range(view.depth_count))
    raw = median_raw(frames) if method == "thesis" else mean_raw(frames)
    depth_mm = view.sensor.depth_mm(raw)
    if not np.isfinite(depth_mm).any():
        raise ReconstructionError(
            "its depth frames hold no reading; check the sensor's distance and that no sunlight "
            "falls on the foot"
        )
    return np.asarray(np.rint(depth_mm)) if method == "thesis" else depth_mm


def _build_sheet(
    points: FloatArray, color: ByteArray, sensor: Sensor, sensor2reference: FloatArray, box: Box
) -> Sheet:
    placed = transform(sensor2reference, points)
    inside = is_inside(placed, box)
    edges = longest_edges(points[..., 2], sensor.depth_camera.fx)
    triangles = triangulate(placed, inside, edges)
    if len(triangles) == 0:
        raise ReconstructionError(
            "it measured no surface in the volume of interest; check that the foot was in place "
            'and "volume_of_interest_mm" in manifest.json'
        )
    colors = color_points(points, inside, color, sensor)
    return without_small_pieces(
        Sheet(placed, triangles, colors, sensor2reference, sensor.depth_camera)
    )


def _used(view: View, registration: Registration) -> ViewResult:
    return ViewResult(
        view.name,
        used=True,
        sensor2reference=registration.sensor2reference,
        residuals=Residuals.of(registration.residuals_mm),
        fixes=registration.fixes,
    )


def _check_any_used(session: Session, results: list[ViewResult]) -> None:
    if not any(result.used for result in results):
        reasons = "; ".join(f"view {result.name}: {result.reason}" for result in results)
        raise ReconstructionError(
            f"No foot can be made from {session.source}, because none of its views can be used "
            f"({reasons})."
        )
