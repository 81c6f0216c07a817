"""A recorded session on its way to a foot: measured once, placed and fused as often as wanted."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from pathlib import Path

from insole_core.errors import InsoleError, ReconstructionError
from insole_core.foot.foot_placement import place_foot
from insole_core.geometry.mesh import TriangleMesh
from insole_core.progress import SILENT, Progress
from insole_core.reconstruct import Reconstruction, RegistrationLimits, ViewResult, reconstruct
from insole_core.reconstruct.fusion.depth_view import DepthView, read_volume
from insole_core.reconstruct.result import refused_result
from insole_core.reconstruct.views.measured_view import MeasuredView, measure_view, used_result
from insole_core.reconstruct.views.view_consistency import ViewConsistency, view_consistency
from insole_core.reconstruct.volume import volume_of_interest
from insole_core.recording.hand_edits import HandEdits
from insole_core.recording.reader import read_session
from insole_core.recording.session import Box, Session, View
from insole_core.workflows.open_scan import ScannedFoot, session_source


@dataclass(frozen=True, eq=False)
class MeasuredSession:
    """A session whose frames are averaged; what remains depends on the hand's corrections.

    Parameters
    ----------
    path
    session
        With the corrections of now.
    measured
        By the name of the view.
    refused
        Why a view measured nothing that can be used, by its name.
    """

    path: Path
    session: Session
    measured: Mapping[str, MeasuredView]
    refused: Mapping[str, ReconstructionError]

    @property
    def edits(self) -> HandEdits:
        """What was corrected by hand."""
        return self.session.edits

    @property
    def box(self) -> Box:
        """The volume of interest."""
        return volume_of_interest(self.session)

    def with_edits(self, edits: HandEdits) -> MeasuredSession:
        """Correct something else."""
        return replace(self, session=replace(self.session, edits=edits))

    def measure(self, view: View) -> MeasuredView:
        """Give what a view measured.

        Raises
        ------
        ReconstructionError
            When that is nothing that can be used.
        """
        if view.name in self.refused:
            raise self.refused[view.name]
        return self.measured[view.name]

    def placed(self, name: str, limits: RegistrationLimits) -> ViewResult:
        """Find where one sensor stood, or why that cannot be said; quick."""
        edits = self.edits.of(name)
        if name in self.refused:
            return refused_result(name, self.refused[name])
        measured, system = self.measured[name], self.session.manifest.reference_system
        try:
            result = used_result(measured, measured.register(system, limits, edits))
        except ReconstructionError as error:
            frames, left_out = measured.view.depth_count, measured.left_out
            return replace(refused_result(name, error), frames=frames, left_out=left_out)
        return replace(result, used=not edits.off)

    def reading(self, result: ViewResult) -> DepthView | None:
        """Give the part of a placed view that shows the foot; None where nothing does."""
        if not result.used or result.sensor2reference is None:
            return None
        measured = self.measured[result.name]
        try:
            return read_volume(
                result.name,
                measured.view.sensor,
                result.sensor2reference,
                self.box,
                raw=measured.raw,
                color=measured.color,
            )
        except ReconstructionError:
            return None  # that nothing lies in the volume is said where the foot is made


@dataclass(frozen=True, eq=False)
class MadeFoot:
    """A foot that can be designed on, and how it came about.

    Parameters
    ----------
    mesh : mm, reference frame
    scan
    edits, limits
        The corrections and limits that it was made with.
    reconstruction, agreement
        None for the coarse foot that comes first.
    """

    mesh: TriangleMesh
    scan: ScannedFoot
    edits: HandEdits
    limits: RegistrationLimits
    reconstruction: Reconstruction | None = None
    agreement: ViewConsistency | None = None


def measure_session(path: Path, progress: Progress = SILENT) -> MeasuredSession:
    """Read a session and average its frames.

    Raises
    ------
    InputError
        When the session breaks the format.
    Cancelled
    """
    progress.step(0.0, "Reading the session")
    session = read_session(path)
    measured: dict[str, MeasuredView] = {}
    refused: dict[str, ReconstructionError] = {}
    for number, view in enumerate(session.views):
        done = 0.1 + 0.9 * number / len(session.views)
        progress.step(done, "Averaging the frames of the view {view}", view=view.name)
        try:
            measured[view.name] = measure_view(view)
        except ReconstructionError as error:
            refused[view.name] = error
    progress.step(1.0, "The session is read")
    return MeasuredSession(path, session, measured, refused)


def make_foot(
    opened: MeasuredSession,
    limits: RegistrationLimits,
    progress: Progress = SILENT,
    *,
    on_preview: Callable[[MadeFoot], None] | None = None,
    force: bool = False,
) -> MadeFoot:
    """Reconstruct the foot and find heel and toes.

    Parameters
    ----------
    opened
    limits
        When the pose of a view is good enough.
    progress
    on_preview
        Is given a coarse foot as soon as there is one.
    force
        Go on although the shape looks like the other foot.

    Raises
    ------
    ReconstructionError
        When no view can be used.
    SideMismatchError
        When the shape is that of the other foot, unless `force`.
    Cancelled
    """
    session, source = opened.session, session_source(opened.path, opened.session)

    def placed(mesh: TriangleMesh, warnings: tuple[str, ...], certain: bool) -> MadeFoot:
        foot = place_foot(mesh, session.manifest.side, frame="reference", force=certain)
        return MadeFoot(mesh, ScannedFoot(foot, source, warnings), opened.edits, limits)

    def show(mesh: TriangleMesh) -> None:
        if on_preview is None:
            return
        try:
            coarse = placed(mesh, (), certain=True)
        except InsoleError:
            return  # whether the foot is one is judged by the fine mesh
        on_preview(coarse)

    result = reconstruct(
        session, "fused", progress.part(0.0, 0.9), limits, on_preview=show, measure=opened.measure
    )
    progress.step(0.9, "Finding heel and toes")
    made = placed(result.mesh, result.warnings, certain=force)
    readings = [reading for view in result.views if (reading := opened.reading(view)) is not None]
    return replace(made, reconstruction=result, agreement=view_consistency(result.mesh, readings))
