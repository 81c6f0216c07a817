"""From a recorded session to one coloured foot: the thesis's method and the fused one."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from threading import Lock
from typing import Any, Generic, Protocol, TypeVar

from insole_core.errors import InputError, ReconstructionError
from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.transforms import transform
from insole_core.messages import Message, joined
from insole_core.progress import SILENT, Progress
from insole_core.reconstruct.fusion.depth_view import read_volume
from insole_core.reconstruct.fusion.fused_surface import fuse
from insole_core.reconstruct.fusion.infrared_evidence import InfraredView
from insole_core.reconstruct.fusion.prepared_view import PreparedView, prepare
from insole_core.reconstruct.markers.marker_observation import Registration
from insole_core.reconstruct.parallel import VIEWS_AT_ONCE
from insole_core.reconstruct.poses.pose_quality import DEFAULT_LIMITS, RegistrationLimits
from insole_core.reconstruct.result import (
    DepthSource,
    Method,
    Reconstruction,
    Surface,
    ViewResult,
    refused_result,
)
from insole_core.reconstruct.shared_views import Register
from insole_core.reconstruct.views.coloring import color_points
from insole_core.reconstruct.views.foot_coverage import coverage_of
from insole_core.reconstruct.views.infrared_pictures import (
    infrared_view,
    infrared_warnings,
    unused_pictures,
)
from insole_core.reconstruct.views.measured_view import (
    MeasuredView,
    measure_as_thesis,
    measure_view,
    used_result,
)
from insole_core.reconstruct.views.midline import cut_at_midline
from insole_core.reconstruct.views.range_mesh import (
    RangeMesh,
    join,
    longest_edges,
    triangulate,
    without_small_pieces,
)
from insole_core.reconstruct.volume import (
    NothingInVolumeError,
    check_any_inside,
    is_inside,
    stands_aside,
    volume_of_interest,
)
from insole_core.reconstruct.warnings import misfits, warnings_of
from insole_core.recording.box import Box
from insole_core.recording.hand_edits import ViewEdits
from insole_core.recording.session import Session, View

_Part = TypeVar("_Part")


@dataclass
class _Stopwatch:
    """The total seconds of named steps, over all threads."""

    seconds: dict[str, float] = field(default_factory=dict)
    _lock: Lock = field(default_factory=Lock, repr=False)

    @contextmanager
    def measuring(self, step: str) -> Iterator[None]:
        """Add the time spent inside the context to `step`."""
        start = time.perf_counter()
        try:
            yield
        finally:
            spent = time.perf_counter() - start
            with self._lock:
                self.seconds[step] = self.seconds.get(step, 0.0) + spent


def reconstruct(
    session: Session,
    method: Method = "fused",
    progress: Progress = SILENT,
    limits: RegistrationLimits = DEFAULT_LIMITS,
    *,
    corrected: bool = True,
    depth: DepthSource = "auto",
    measure: Callable[[View], MeasuredView] = measure_view,
    register: Register | None = None,
) -> Reconstruction:
    """Make one coloured foot, mm, reference frame, from the views of a session.

    Parameters
    ----------
    session
        Together with the user's corrections.
    method
        ``thesis``: median of the frames, depth in whole mm, views cut where they overlap.
        ``fused``: mean of the frames in disparity, and the most probable smooth surface of all
        views.
    progress
    limits
        When the pose of a view is good enough.
    corrected
        Whether the learnt error of the sensor's matching is subtracted; for ``fused`` only.
    depth
        ``chip``: as the sensors computed it. ``infrared``: refined by the infrared pictures, of
        which one view at least must have some; ``auto``: where there are. For ``fused`` only.
    measure
        Averages the frames of a view, for ``fused`` only; pass one with a cache when a session is
        reconstructed several times.
    register
        Finds the pose of a view; by default from the markers of the session's reference system.

    Returns
    -------
    Reconstruction
        The foot, the result of every view, and warnings.

    Raises
    ------
    ReconstructionError
        When no view can be used; the sentence names the reason of each.
    NothingInVolumeError
        When that is for the lack of a foot in some of them.
    """
    fused = _Fused(measure, corrected, depth)
    way: _Way[Any] = _Thesis() if method == "thesis" else fused

    def found(measured: MeasuredView, edits: ViewEdits) -> Registration:
        return measured.register(session.manifest.reference_system, limits, edits)

    return _Chain(session, way, register or found, _Stopwatch()).run(progress)


class _Way(Protocol[_Part]):
    """The steps in which the methods differ."""

    def measure(self, view: View) -> MeasuredView:
        """Combine the frames of a view."""
        ...

    def cut_out(self, measured: MeasuredView, sensor2reference: FloatArray, box: Box) -> _Part:
        """Return the part of a view of known pose that shows the foot."""
        ...

    def note(self, part: _Part) -> str:
        """Return a remark about the part, as the end of a sentence; often empty."""
        ...

    def join(self, parts: list[_Part], progress: Progress) -> Surface:
        """Join all views to one surface."""
        ...


class _Thesis:
    """The baseline: chapters 5 and 6 of the thesis."""

    def measure(self, view: View) -> MeasuredView:
        return measure_as_thesis(view)

    def cut_out(self, measured: MeasuredView, sensor2reference: FloatArray, box: Box) -> RangeMesh:
        sensor = measured.view.sensor
        placed = transform(sensor2reference, measured.points)
        inside = is_inside(placed, box)
        edges = longest_edges(measured.points[..., 2], sensor.depth_camera.fx)
        triangles = triangulate(placed, inside, edges)
        check_any_inside(inside)
        colors = color_points(measured.points, inside, measured.color, sensor)
        return without_small_pieces(
            RangeMesh(placed, triangles, colors, sensor2reference, sensor.depth_camera)
        )

    def note(self, part: RangeMesh) -> str:
        return ""

    def join(self, parts: list[RangeMesh], progress: Progress) -> Surface:
        progress.step(0.0, "Cutting the views where they overlap")
        return Surface(join([without_small_pieces(sheet) for sheet in cut_at_midline(parts)]))


@dataclass(frozen=True)
class _Fused:
    """Fusion of all readings to the most probable smooth surface."""

    measuring: Callable[[View], MeasuredView]
    corrected: bool
    depth: DepthSource
    faults: dict[str, str] = field(default_factory=dict)
    """Why the infrared pictures of a view cannot be used, by its name."""

    def measure(self, view: View) -> MeasuredView:
        return self.measuring(view)

    def cut_out(
        self, measured: MeasuredView, sensor2reference: FloatArray, box: Box
    ) -> PreparedView:
        reading = read_volume(
            measured.view.name,
            measured.view.sensor,
            sensor2reference,
            box,
            raw=measured.raw,
            color=measured.color,
        )
        prepared = prepare(reading, corrected=self.corrected)
        prepared = replace(prepared, infrared=self._infrared(measured.view))
        if stands_aside(sensor2reference, box):
            # What it sees of the foot at the edge, it sees too slantingly to learn its colours.
            return replace(prepared, outline=None, rim=None)
        return prepared

    def note(self, part: PreparedView) -> str:
        edges = joined(part.reading.cut_edges, " and ")
        return edges and (
            Message(
                "the foot is cut off at the {edges} edge of the depth picture; turn the sensor "
                "or move it back",
                edges=edges,
            )
        )

    def _infrared(self, view: View) -> InfraredView | None:
        if self.depth == "chip":
            return None
        try:
            return infrared_view(view)
        except InputError as error:
            self.faults[view.name] = error.message
            return None

    def join(self, parts: list[PreparedView], progress: Progress) -> Surface:
        if self.depth == "infrared" and all(part.infrared is None for part in parts):
            raise _nothing_usable(unused_pictures(self.faults, {}))
        surface = fuse(parts, progress)
        if self.depth == "infrared" and not any(use.used for use in surface.infrared.values()):
            raise _nothing_usable(unused_pictures(self.faults, surface.infrared))
        # What was computed from them meanwhile is larger than they are, and is not needed again.
        return replace(
            surface,
            depth_views=tuple(replace(part.measured) for part in parts),
            warnings=tuple(infrared_warnings(self.faults, surface.infrared)),
        )


@dataclass(frozen=True, eq=False)
class _Chain(Generic[_Part]):
    """One reconstruction in progress."""

    session: Session
    way: _Way[_Part]
    register: Register
    clock: _Stopwatch

    def run(self, progress: Progress) -> Reconstruction:
        """Register all views, then join them."""
        parts: list[_Part] = []
        results: list[ViewResult] = []
        errors: list[ReconstructionError] = []
        views = self.session.views
        with ThreadPoolExecutor(VIEWS_AT_ONCE) as pool:
            placing = [pool.submit(self._place, view) for view in views]
            try:
                for number, view in enumerate(views):
                    progress.step(
                        0.5 * number / len(views), "Placing the view {view}", view=view.name
                    )
                    try:
                        part, result = placing[number].result()
                    except ReconstructionError as error:
                        errors.append(error)
                        results.append(refused_result(view.name, error))
                        continue
                    parts.append(part)
                    results.append(result)
            finally:
                pool.shutdown(wait=False, cancel_futures=True)
        _check_any_used(self.session, results, errors)
        with self.clock.measuring("surface"):
            surface = self.way.join(parts, progress.part(0.5, 1.0))
        progress.step(1.0, "The foot is ready")
        coverage = coverage_of(surface.mesh)
        return Reconstruction(
            surface.mesh,
            tuple(results),
            (
                *warnings_of(self.session, results, coverage),
                *self._misfits(results, surface),
                *surface.warnings,
            ),
            self.clock.seconds,
            surface.deviation_mm,
            surface.correction_mm,
            coverage,
            surface.depth_views,
            surface.infrared,
            surface.infrared_share,
        )

    def _misfits(self, results: list[ViewResult], surface: Surface) -> list[str]:
        box = volume_of_interest(self.session)
        aside = {
            result.name
            for result in results
            if result.sensor2reference is not None and stands_aside(result.sensor2reference, box)
        }
        return misfits(results, surface, aside)

    def _place(self, view: View) -> tuple[_Part, ViewResult]:
        """Measure and register one view, and cut out the foot."""
        edits = self.session.edits.of(view.name)
        if edits.off:
            raise ReconstructionError("it was switched off by hand")
        with self.clock.measuring("frames"):
            measured = self.way.measure(view)
        with self.clock.measuring("markers"):
            registration = self.register(measured, edits)
        measured = measured.at_scale(registration.depth_scale)
        with self.clock.measuring("cutting out"):
            part = self.way.cut_out(
                measured, registration.sensor2reference, volume_of_interest(self.session)
            )
        return part, used_result(measured, registration, self.way.note(part))


def _nothing_usable(reasons: list[Message]) -> ReconstructionError:
    return ReconstructionError(
        "No view has infrared pictures that can be used; use the sensors' own depth (chip). "
        "{reasons}",
        reasons=joined(reasons, " ") if reasons else "None were recorded.",
    )


def _check_any_used(
    session: Session, results: list[ViewResult], errors: list[ReconstructionError]
) -> None:
    if not any(result.used for result in results):
        reasons = (
            Message("view {view}: {reason}", view=result.name, reason=result.reason)
            for result in results
        )
        empty = any(isinstance(error, NothingInVolumeError) for error in errors)
        raise (NothingInVolumeError if empty else ReconstructionError)(
            "No foot can be made from {session}, because none of its views can be used "
            "({reasons}).",
            session=session.source,
            reasons=joined(reasons, "; "),
        )
