"""From a recorded session to one coloured foot: the thesis's chain, and the better one."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import Any, Generic, Protocol, TypeVar

import numpy as np

from insole_core.errors import ReconstructionError
from insole_core.geometry.arrays import ByteArray, FloatArray, RawArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.transforms import transform
from insole_core.progress import SILENT, Progress
from insole_core.reconstruct.blobs import find_blobs, sharpened
from insole_core.reconstruct.coloring import color_points, mean_color
from insole_core.reconstruct.fusion.reading import Reading, read_volume
from insole_core.reconstruct.fusion.surface import fuse
from insole_core.reconstruct.midline import cut_at_midline
from insole_core.reconstruct.registration import (
    DEFAULT_LIMITS,
    Registration,
    RegistrationLimits,
    register,
    register_in_image,
    register_precisely,
)
from insole_core.reconstruct.remarks import check_still, motion_note, warnings_of
from insole_core.reconstruct.result import (
    Method,
    Reconstruction,
    Residuals,
    Surface,
    ViewResult,
)
from insole_core.reconstruct.sheet import (
    Sheet,
    join,
    longest_edges,
    triangulate,
    without_small_pieces,
)
from insole_core.reconstruct.sighting import locate_blobs
from insole_core.reconstruct.stopwatch import Stopwatch
from insole_core.reconstruct.volume import check_any_inside, is_inside, volume_of_interest
from insole_core.recording.session import Box, ReferenceSystem, Session, View
from insole_core.sensing.frames import RawAverage, average_raw, median_raw

_Part = TypeVar("_Part")


def reconstruct(
    session: Session,
    method: Method = "fused",
    progress: Progress = SILENT,
    limits: RegistrationLimits = DEFAULT_LIMITS,
    on_preview: Callable[[TriangleMesh], None] | None = None,
) -> Reconstruction:
    """Make one coloured foot, in the reference frame, from the views of a session.

    Parameters
    ----------
    session
    method
        ``thesis``: median of the frames, depth in whole mm, views cut where they overlap.
        ``fused``: mean of the frames in disparity, and the likeliest smooth surface of all views.
    progress
    limits
        When the pose of a view is good enough.
    on_preview
        Is given a coloured mesh before the last step, for ``fused`` only.

    Raises
    ------
    ReconstructionError
        When no view can be used; the sentence names the reason of each.
    """
    way: _Way[Any] = _Thesis() if method == "thesis" else _Fused(on_preview)
    return _Chain(session, way, limits, Stopwatch()).run(progress)


class _Way(Protocol[_Part]):
    """What the methods do differently."""

    def average(self, view: View) -> RawAverage:
        """Give one raw image of many."""
        ...

    def rounded(self, depth_mm: FloatArray) -> FloatArray:
        """Give depth in the resolution that the method keeps."""
        ...

    def register(
        self, measured: _Measured, system: ReferenceSystem, limits: RegistrationLimits
    ) -> Registration:
        """Find where the sensor stood."""
        ...

    def cut_out(self, measured: _Measured, sensor2reference: FloatArray, box: Box) -> _Part:
        """Give the part of a placed view that shows the foot."""
        ...

    def join(self, parts: list[_Part], progress: Progress) -> Surface:
        """Make one surface of all views."""
        ...


@dataclass(frozen=True, eq=False)
class _Measured:
    """One view, its frames averaged; depth in the depth camera's frame."""

    view: View
    raw: FloatArray
    points: FloatArray
    color: ByteArray
    motion_note: str


class _Thesis:
    """Chapters 5 and 6: the baseline."""

    def average(self, view: View) -> RawAverage:
        raw = median_raw(_depth_frames(view))
        return RawAverage(raw, np.zeros_like(raw), view.depth_count, (), 0.0)

    def rounded(self, depth_mm: FloatArray) -> FloatArray:
        return np.asarray(np.rint(depth_mm))

    def register(
        self, measured: _Measured, system: ReferenceSystem, limits: RegistrationLimits
    ) -> Registration:
        sensor = measured.view.sensor
        sightings = locate_blobs(find_blobs(measured.color), measured.points, sensor)
        return register(sightings, system, sensor.faces, limits)

    def cut_out(self, measured: _Measured, sensor2reference: FloatArray, box: Box) -> Sheet:
        sensor = measured.view.sensor
        placed = transform(sensor2reference, measured.points)
        inside = is_inside(placed, box)
        edges = longest_edges(measured.points[..., 2], sensor.depth_camera.fx)
        triangles = triangulate(placed, inside, edges)
        check_any_inside(inside)
        colors = color_points(measured.points, inside, measured.color, sensor)
        return without_small_pieces(
            Sheet(placed, triangles, colors, sensor2reference, sensor.depth_camera)
        )

    def join(self, parts: list[Sheet], progress: Progress) -> Surface:
        progress.step(0.0, "Cutting the views where they overlap")
        return Surface(join([without_small_pieces(sheet) for sheet in cut_at_midline(parts)]))


@dataclass(frozen=True)
class _Fused:
    """The best there is."""

    on_preview: Callable[[TriangleMesh], None] | None

    def average(self, view: View) -> RawAverage:
        return average_raw(_depth_frames(view))

    def rounded(self, depth_mm: FloatArray) -> FloatArray:
        return depth_mm

    def register(
        self, measured: _Measured, system: ReferenceSystem, limits: RegistrationLimits
    ) -> Registration:
        blobs = sharpened(measured.color, find_blobs(measured.color))
        sensor = measured.view.sensor
        sightings = locate_blobs(blobs, measured.points, sensor)
        try:
            return register_precisely(sightings, system, sensor, limits)
        except ReconstructionError as error:
            try:
                return register_in_image(blobs, system, sensor, limits)
            except ReconstructionError:
                raise error from None

    def cut_out(self, measured: _Measured, sensor2reference: FloatArray, box: Box) -> Reading:
        view = measured.view
        return read_volume(
            view.name,
            view.sensor,
            sensor2reference,
            box,
            raw=measured.raw,
            color=measured.color,
        )

    def join(self, parts: list[Reading], progress: Progress) -> Surface:
        return fuse(parts, progress, on_preview=self.on_preview)


@dataclass(frozen=True, eq=False)
class _Chain(Generic[_Part]):
    """The steps of one reconstruction, with what they all need."""

    session: Session
    way: _Way[_Part]
    limits: RegistrationLimits
    clock: Stopwatch

    def run(self, progress: Progress) -> Reconstruction:
        """Go through the views, then join them."""
        parts: list[_Part] = []
        results: list[ViewResult] = []
        views = self.session.views
        for number, view in enumerate(views):
            start, end = (0.5 * (number + done) / len(views) for done in (0, 1))
            try:
                part, result = self._place(view, progress.part(start, end))
            except ReconstructionError as error:
                results.append(ViewResult(view.name, used=False, reason=str(error)))
                continue
            parts.append(part)
            results.append(result)
        _check_any_used(self.session, results)
        with self.clock.measuring("surface"):
            surface = self.way.join(parts, progress.part(0.5, 1.0))
        progress.step(1.0, "The foot is ready")
        return Reconstruction(
            surface.mesh,
            tuple(results),
            warnings_of(self.session, results),
            self.clock.seconds,
            surface.deviation_mm,
        )

    def _place(self, view: View, progress: Progress) -> tuple[_Part, ViewResult]:
        """Bring one view to the reference frame."""
        progress.step(0.0, f"Averaging the frames of the view {view.name}")
        with self.clock.measuring("frames"):
            measured = self._measure(view)
        progress.step(0.6, f"Finding the markers of the view {view.name}")
        with self.clock.measuring("markers"):
            system = self.session.manifest.reference_system
            registration = self.way.register(measured, system, self.limits)
        with self.clock.measuring("surface"):
            box = volume_of_interest(self.session.manifest)
            part = self.way.cut_out(measured, registration.sensor2reference, box)
        return part, _used(measured, registration)

    def _measure(self, view: View) -> _Measured:
        """Average a view's frames and convert them, thesis (12), (16), 6.1."""
        average = self.way.average(view)
        check_still(average)
        raw = view.sensor.corrected(average.raw)
        depth_mm = view.sensor.disparity.depth_mm(raw)
        if not np.isfinite(depth_mm).any():
            raise ReconstructionError(
                "its depth frames hold no reading; check the sensor's distance and that no "
                "sunlight falls on the foot"
            )
        points = view.sensor.points(self.way.rounded(depth_mm))
        note = motion_note(view, average, depth_mm)
        return _Measured(view, raw, points, mean_color(view), note)


def _depth_frames(view: View) -> Iterable[RawArray]:
    return (view.read_depth(index) for index in range(view.depth_count))


def _used(measured: _Measured, registration: Registration) -> ViewResult:
    return ViewResult(
        measured.view.name,
        used=True,
        reason=measured.motion_note,
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
