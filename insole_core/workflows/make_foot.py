"""Make a foot from a recorded session, for window, command line and case files alike."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path

from insole_core.errors import ReconstructionError, UsageError
from insole_core.foot.display_surface import DisplaySurface, display_surface
from insole_core.foot.foot_placement import place_foot
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.side import BOTH, Side
from insole_core.geometry.transforms import inverse
from insole_core.progress import SILENT, Progress
from insole_core.reconstruct import (
    DepthSource,
    Method,
    Reconstruction,
    RegistrationLimits,
    ViewResult,
    reconstruct,
)
from insole_core.reconstruct.parallel import both, for_views
from insole_core.reconstruct.poses.pose_quality import DEFAULT_LIMITS
from insole_core.reconstruct.result import refused_result
from insole_core.reconstruct.shared_views import SharedViews
from insole_core.reconstruct.views.foot_coverage import ViewConsistency, view_consistency
from insole_core.reconstruct.views.measured_view import MeasuredView, measure_view, used_result
from insole_core.reconstruct.volume import volume_of_interest
from insole_core.recording.box import Box
from insole_core.recording.hand_edits import HandEdits
from insole_core.recording.reader import read_session
from insole_core.recording.session import Session, View
from insole_core.workflows.calibration.correction_choice import (
    BY_DEFAULT,
    CorrectionChoice,
    choice_for,
)
from insole_core.workflows.scanned_feet import ScannedFoot, session_source


@dataclass(frozen=True, eq=False)
class MeasuredSession:
    """A session and the measurements of its views, which do not depend on manual corrections.

    Parameters
    ----------
    session
        With its current corrections.
    measured
        By the name of the view; views not measured yet are absent.
    refused
        Why a view has no usable measurement, by its name.
    correction
        Whether the learnt error of the matching of these sensors is subtracted.
    is_of_two
        Whether it is that of one of two feet that were captured together.
    """

    path: Path
    session: Session
    measured: Mapping[str, MeasuredView]
    refused: Mapping[str, ReconstructionError]
    correction: CorrectionChoice = BY_DEFAULT
    is_of_two: bool = False

    @property
    def edits(self) -> HandEdits:
        """Manual corrections of the session."""
        return self.session.edits

    @property
    def box(self) -> Box:
        """Volume of interest, reference frame."""
        return volume_of_interest(self.session)

    @property
    def feet(self) -> tuple[MeasuredSession, ...]:
        """One session for each captured foot, in the foot's own reference frame."""
        return tuple(self._of(side) for side in self.session.manifest.sides)

    def of_foot(self, side: Side | None) -> MeasuredSession:
        """Return the session of one of the captured feet, in the foot's own reference frame.

        Parameters
        ----------
        side
            None for the only one.

        Raises
        ------
        UsageError
            When it holds both feet and none is named, or another foot than the one named.
        """
        sides = self.session.manifest.sides
        if side is None and len(sides) > 1:
            raise UsageError(
                "{path} was recorded with both feet; say which one, with --side left or --side "
                "right.",
                path=self.path,
            )
        if side is not None and side not in sides:
            raise UsageError(
                "The {side} foot is asked for, but {path} was recorded as the {recorded} foot; ask "
                "for that one, or name the recording of the other.",
                side=side,
                path=self.path,
                recorded=sides[0],
            )
        return self._of(side or sides[0])

    def _of(self, side: Side) -> MeasuredSession:
        is_of_two = self.is_of_two or len(self.session.manifest.sides) > 1
        return replace(self, session=self.session.of_foot(side), is_of_two=is_of_two)

    def taken_as(self, side: Side) -> MeasuredSession:
        """Take the session of one foot as that of a side, whatever was said at its recording."""
        recorded = self.session.manifest
        assert recorded.side != BOTH, "of both feet, the place of each says which one it is"
        manifest, edits = replace(recorded, side=side), replace(self.edits, side=side)
        return replace(self, session=replace(self.session, manifest=manifest, edits=edits))

    def with_edits(self, edits: HandEdits) -> MeasuredSession:
        """Replace the manual corrections; the measurements stay."""
        return replace(self, session=replace(self.session, edits=edits))

    def measure(self, view: View) -> MeasuredView:
        """Return the measurement of a view, computed now unless the whole session was measured.

        Raises
        ------
        ReconstructionError
            When the view has no usable measurement.
        """
        if view.name in self.refused:
            raise self.refused[view.name]
        return self.measured.get(view.name) or measure_view(view)

    def placed(self, name: str, limits: RegistrationLimits) -> ViewResult:
        """Find the pose of the sensor of one view; quick.

        Parameters
        ----------
        name
            Of a view that was measured.
        limits
            Beyond which the pose is refused.

        Returns
        -------
        ViewResult
            Refused, with the reason, where the pose cannot be determined.
        """
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


@dataclass(frozen=True, eq=False)
class MadeFoot:
    """A foot ready for design, and how it was made.

    Parameters
    ----------
    mesh : mm, reference frame
    edits, limits
        Corrections and limits that it was made with.
    reconstruction
        Without its depth views, which are large.
    agreement
        None where it was not requested.
    """

    mesh: TriangleMesh
    scan: ScannedFoot
    edits: HandEdits
    limits: RegistrationLimits
    reconstruction: Reconstruction
    agreement: ViewConsistency | None = None

    def display_surface(self) -> DisplaySurface:
        """Return the mesh with an even border, reference frame; computed once, in about 0.2 s."""
        foot = self.scan.foot

        def compute() -> DisplaySurface:
            if foot.mesh.triangles is self.mesh.triangles:  # no scraps were left out
                shown = foot.display_surface()
            else:
                shown = display_surface(self.mesh.transformed(foot.source2insole))
            return shown.transformed(inverse(foot.source2insole))

        return foot.derived.get("display, reference frame", (), compute)


def open_session(
    path: Path, progress: Progress = SILENT, *, sensors: Path | None = None
) -> MeasuredSession:
    """Read a session; its frames are averaged on demand.

    Parameters
    ----------
    path
        Folder or zip archive.
    sensors
        Folder of the calibrated sensors, by default this user's; it says whether the learnt
        correction is used for those of the session.

    Raises
    ------
    InputError
        When the session violates the format.
    """
    progress.step(0.0, "Reading the session")
    session = read_session(path)
    return MeasuredSession(path, session, {}, {}, choice_for(session, sensors))


def open_foot(path: Path, side: Side | None, progress: Progress = SILENT) -> MeasuredSession:
    """Read a session as that of one foot, in the foot's own reference frame.

    Parameters
    ----------
    path
        Folder or zip archive.
    side
        Which foot; None for the only one.

    Raises
    ------
    UsageError
        When it holds both feet and none is named, or another foot than the one named.
    InputError
        When the session violates the format.
    """
    return open_session(path, progress).of_foot(side)


def measure_session(path: Path, progress: Progress = SILENT) -> MeasuredSession:
    """Read a session and average its frames, so that it can be reconstructed several times.

    Parameters
    ----------
    path
        Folder or zip archive.

    Raises
    ------
    InputError
        When the session violates the format.
    Cancelled
    """
    opened = open_session(path, progress)
    views = opened.session.views
    measured: dict[str, MeasuredView] = {}
    refused: dict[str, ReconstructionError] = {}

    def measure(number: int) -> None:
        view = views[number]
        done = 0.1 + 0.9 * number / len(views)
        progress.step(done, "Averaging the frames of the view {view}", view=view.name)
        try:
            measured[view.name] = measure_view(view)
        except ReconstructionError as error:
            refused[view.name] = error

    for_views(measure, range(len(views)))
    progress.step(1.0, "The session is read")
    return replace(opened, measured=measured, refused=refused)


def reconstruct_session(
    opened: MeasuredSession,
    limits: RegistrationLimits = DEFAULT_LIMITS,
    progress: Progress = SILENT,
    *,
    method: Method = "fused",
    corrected: bool | None = None,
    depth: DepthSource = "auto",
    shared: SharedViews | None = None,
) -> Reconstruction:
    """Reconstruct the coloured surface of a session, in the reference frame.

    It is the first half of `make_foot`, for callers that need only the surface.

    Parameters
    ----------
    opened
        Views that were not measured yet are measured here.
    limits
        Beyond which the pose of a view is refused.
    corrected
        Whether the learnt error of the sensor's matching is subtracted, by the fused method only;
        by default as was chosen for the sensors.
    depth
        As of `reconstruct`.
    shared
        Of one foot of two, what it has in common with the other.

    Returns
    -------
    Reconstruction
        Its mesh is in mm, reference frame.

    Raises
    ------
    ReconstructionError
        When no view can be used.
    Cancelled
    """
    choice = opened.correction.called(corrected)
    result = reconstruct(
        opened.session,
        method,
        progress,
        limits,
        corrected=choice.corrected,
        depth=depth,
        measure=opened.measure if shared is None else shared.measure,
        register=None if shared is None else shared.around(opened.session.manifest.one_side),
    )
    if method != "fused" or not choice.note:
        return result
    return replace(result, warnings=(*result.warnings, choice.note))


def make_foot(
    opened: MeasuredSession,
    limits: RegistrationLimits = DEFAULT_LIMITS,
    progress: Progress = SILENT,
    *,
    compare_views: bool = False,
    force: bool = False,
    shared: SharedViews | None = None,
) -> MadeFoot:
    """Reconstruct the foot of a session, and find heel and toes.

    Parameters
    ----------
    limits
        Beyond which the pose of a view is refused.
    compare_views
        Whether to measure how far the views deviate from each other on the foot.
    force
        Continue although the shape looks like the other foot.
    shared
        Of one foot of two, what it has in common with the other.

    Returns
    -------
    MadeFoot
        Its foot is in the insole frame.

    Raises
    ------
    ReconstructionError
        When no view can be used.
    SideMismatchError
        When the shape is that of the other foot, unless `force`.
    Cancelled
    """
    result = reconstruct_session(opened, limits, progress.part(0.0, 0.9), shared=shared)
    progress.step(0.9, "Finding heel and toes")
    side = opened.session.manifest.one_side
    agreement, foot = both(
        lambda: view_consistency(result.mesh, result.depth_views) if compare_views else None,
        lambda: place_foot(result.mesh, side, frame="reference", force=force),
    )
    source = session_source(opened.path, opened.session)
    return MadeFoot(
        result.mesh,
        ScannedFoot(foot, source, result.warnings, is_alone=not opened.is_of_two),
        opened.edits,
        limits,
        replace(result, depth_views=()),
        agreement,
    )
