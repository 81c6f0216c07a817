"""Presenter of the foot stage and of the reconstruction of its session."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, Protocol

import numpy as np

from insole_core.errors import InsoleError
from insole_core.foot.foot_placement import SideMismatchError
from insole_core.foot.landmarks import find_landmarks
from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.side import Side
from insole_core.geometry.transforms import rigid
from insole_core.progress import Progress
from insole_core.reconstruct import RegistrationLimits, ViewResult
from insole_core.reconstruct.parallel import both, for_views
from insole_core.reconstruct.views.range_mesh import view_mesh
from insole_core.recording.box import Box
from insole_core.recording.hand_edits import NO_EDITS, HandEdits
from insole_core.visible_text import visible_line
from insole_core.workflows.make_feet import DoubtfulFeetError, MissingFootError, make_feet
from insole_core.workflows.make_foot import (
    MadeFoot,
    MeasuredSession,
    measure_session,
)
from insole_core.workflows.scanned_feet import ScannedFoot
from insole_core.workflows.session_editor import SessionEditor
from insole_studio.features.foot.marker_presenter import ImagePanel, MarkerPresenter
from insole_studio.features.foot.rows import (
    VIEW_COLORS,
    FootButtons,
    FootMap,
    Limits,
    ViewRow,
    color_foot,
    view_row,
)
from insole_studio.jobs import JobProgress, Jobs
from insole_studio.scene.coloring import Coloring, on_display
from insole_studio.services.questions import OtherFoot
from insole_studio.texts import tr, translate_core_message
from insole_studio.view_names import view_text

READING, MAKING = "read-session", "reconstruct"
"""Channels of the jobs."""


class FootStagePanel(ImagePanel, Protocol):
    """The panel of the foot stage as its presenter sees it, with the signals it emits."""

    foot_chosen: Any
    view_chosen: Any
    view_switched: Any
    box_edited: Any
    box_reset: Any
    map_chosen: Any
    limits_edited: Any
    undo_requested: Any
    redo_requested: Any
    make_requested: Any
    cancel_requested: Any
    go_on_requested: Any

    def show_session(self, name: str, sides: Sequence[Side]) -> None: ...  # noqa: D102
    def show_side(self, side: Side) -> None: ...  # noqa: D102
    def show_views(self, rows: Sequence[ViewRow], selected: str) -> None: ...  # noqa: D102
    def show_foot(self, mesh: TriangleMesh, coloring: Coloring | None) -> None: ...  # noqa: D102
    def show_nothing(self, sentence: str) -> None: ...  # noqa: D102
    def show_no_session(self, sentence: str) -> None: ...  # noqa: D102
    def show_map(self, kind: FootMap, possible: Sequence[FootMap]) -> None: ...  # noqa: D102
    def show_box(self, box: Box) -> None: ...  # noqa: D102
    def show_limits(self, limits: Limits) -> None: ...  # noqa: D102
    def show_sentences(self, sentences: Sequence[str]) -> None: ...  # noqa: D102
    def show_progress(self, fraction: float, text: str) -> None: ...  # noqa: D102
    def show_buttons(self, buttons: FootButtons) -> None: ...  # noqa: D102


@dataclass(frozen=True, eq=False)
class _ReadSession:
    """What the job that reads a session hands over, for the foot that is shown first."""

    work: SessionEditor
    side: Side
    meshes: Mapping[str, TriangleMesh]


class FootStagePresenter:
    """Registers the views again after every correction, and makes the foot on request.

    Parameters
    ----------
    panel
        The panel of the foot stage.
    jobs
        Runs long computations.
    limits
        Limits beyond which the pose of a view is rejected.
    remember
        Called with changed limits.
    hand_over
        Called with a foot for the design stage; if it is not wanted, `note_declined` is called.
    ask
        Asks whether to continue despite a warning.
    ask_alone
        Asks whether to make one foot, since the other one is missing.
    ask_side
        Asks which foot it is whose shape is that of the other side; given the side that it shows.
    finished
        Called when the stage has done its work; with True if no job is running.
    needed_again
        Called when a job fails after the stage was left: the user has to correct something.
    unreadable
        Called with the error if the session cannot be read.
    """

    def __init__(
        self,
        *,
        panel: FootStagePanel,
        jobs: Jobs,
        limits: RegistrationLimits,
        remember: Callable[[RegistrationLimits], None],
        hand_over: Callable[[ScannedFoot], None],
        ask: Callable[[str], bool],
        ask_alone: Callable[[str, Side], bool],
        ask_side: Callable[[str, Side], OtherFoot],
        finished: Callable[[bool], None],
        needed_again: Callable[[], None],
        unreadable: Callable[[Exception], None],
    ) -> None:
        self._panel = panel
        self._jobs = jobs
        self._limits = limits
        self._remember = remember
        self._hand_over = hand_over
        self._ask = ask
        self._ask_alone = ask_alone
        self._ask_side = ask_side
        self._finished = finished
        self._needed_again = needed_again
        self._unreadable = unreadable
        self._work: SessionEditor | None = None
        self._markers = MarkerPresenter(panel)
        self._meshes: dict[str, TriangleMesh] = {}
        self._mesh_box: Box | None = None
        self._map = FootMap.VIEWS
        self._side = Side.LEFT
        """The foot that is shown, of those that were captured."""
        self._only: Side | None = None
        """The foot that is made alone, since the other one is missing."""
        self._made_feet: dict[Side, MadeFoot] = {}
        self._handed: dict[Side, MadeFoot] = {}
        self._trouble = ""
        self._hands_over = False
        """Whether to hand over the foot as soon as it is made."""
        self._leaves = False
        """Whether to leave the stage then."""
        self._connect(panel)
        panel.show_limits(_shown(limits))
        self._show_buttons()

    def open(self, path: Path, hand_over: bool) -> None:
        """Read a session and make its foot, or both.

        Parameters
        ----------
        path
            Folder of the session.
        hand_over
            Whether to hand the foot over when it is made, or wait for the user.
        """
        self._jobs.cancel(MAKING)  # a late foot of another session must not appear as this one's
        self._forget(tr("The session is being read."))
        self._hands_over = hand_over

        def read(progress: Progress) -> _ReadSession:
            opened = measure_session(path, progress.part(0.0, 0.7))
            work = SessionEditor(opened, self._limits, self._take_change, progress.part(0.7, 0.9))
            progress.step(0.9, "The session is read")
            side = opened.session.manifest.sides[0]
            return _ReadSession(work, side, _view_meshes(work, side, work.names))

        self._jobs.start(READING, read, self._take_session, self._unreadable)
        self._show_buttons()

    def _forget(self, sentence: str) -> None:
        """Let go of the session, and show a sentence instead of all that was shown of it."""
        self._work = self._mesh_box = None
        self._made_feet, self._handed = {}, {}
        self._only = None
        self._meshes = {}
        self._hands_over = self._leaves = False
        self._trouble = ""
        self._markers.take(None)
        self._panel.show_no_session(sentence)

    @property
    def box(self) -> Box | None:
        """The volume of interest of the foot that is shown; None before a session is open."""
        return None if self._work is None else self._foot(self._work).box

    @property
    def edits(self) -> HandEdits:
        """The manual corrections."""
        return NO_EDITS if self._work is None else self._work.edits

    def choose_foot(self, side: Side) -> None:
        """Show the other one of two feet."""
        if self._work is None or side is self._side:
            return
        self._side, self._mesh_box = side, None
        self._panel.show_side(side)
        self._take_change(frozenset(self._work.names))

    def choose_view(self, name: str) -> None:
        """Show the image of another view."""
        self._markers.choose_view(name)

    def switch_view(self, name: str, on: bool) -> None:
        """Use a view, or exclude it."""
        edits = replace(self.edits.of(name), off=not on)
        text = tr("Use the view {name}") if on else tr("Leave out the view {name}")
        self._apply(self.edits.with_view(name, edits), text.format(name=view_text(name)))

    def edit_box(self, box: Box) -> None:
        """Set the volume of interest."""
        key = f"box {self._side}"
        self._apply(self._edits_with_box(box), tr("Change the volume"), merge_key=key)

    def end_merging(self) -> None:
        """Let the next correction be an undo step of its own."""
        if self._work is not None:
            self._work.history.end_merging()

    def reset_box(self) -> None:
        """Restore the recorded volume of interest."""
        self._apply(self._edits_with_box(None), tr("Reset the volume"))

    def _edits_with_box(self, box: Box | None) -> HandEdits:
        if self._work is not None and len(self._work.opened.feet) > 1:
            return self.edits.with_volume(self._side, box)
        return replace(self.edits, volume_of_interest=box)

    def edit_limits(self, limits: Limits) -> None:
        """Set the limits beyond which poses are rejected."""
        self._limits = replace(
            self._limits,
            residual_mm=limits.residual_mm,
            reprojection_px=limits.reprojection_px,
            displacement_mm=limits.displacement_mm,
        )
        self._remember(self._limits)
        if self._work is not None:
            self._work.set_limits(self._limits)

    def choose_map(self, kind: FootMap) -> None:
        """Choose the colour map of the foot."""
        self._map = kind
        self._show_foot()

    def undo(self) -> None:
        """Undo the last correction."""
        if self._work is not None:
            self._work.undo()

    def redo(self) -> None:
        """Redo the last undone correction."""
        if self._work is not None:
            self._work.redo()

    def make(self, force: bool = False, only: Side | None = None) -> None:
        """Make the feet with the current corrections.

        Parameters
        ----------
        force
            Despite a warning.
        only
            This one of two feet; by default both.
        """
        if self._work is None:
            return
        opened, limits = self._work.opened, self._limits
        self._only = only
        if only is not None:
            opened = opened.of_foot(only)
        self._trouble = self._work.trouble

        def task(progress: Progress) -> tuple[MadeFoot, ...]:
            feet = make_feet(opened, limits, progress, compare_views=True, force=force)
            for made in feet:
                _prepare_display(made)
            return feet

        self._jobs.start(MAKING, task, self._take_feet, self._take_trouble)
        self._show_buttons()

    def cancel(self) -> None:
        """Cancel the running jobs."""
        for channel in (READING, MAKING):
            self._jobs.cancel(channel)
        self._hands_over = self._leaves = False
        self._panel.show_progress(0.0, "")
        self._show_buttons()

    def close(self) -> None:
        """Cancel the running jobs and let go of the session."""
        self.cancel()
        self._forget("")

    def go_on(self) -> None:
        """Hand the feet over and leave; one still being made is handed over when it is ready."""
        self._leaves = True
        running = self._jobs.is_running(MAKING)
        if self._is_stale and not running:
            self._hands_over = True
            self.make()
            return
        all_taken = self._give()
        self._hands_over = running
        if running or all_taken:
            self._finished(not running)
        else:
            self._leaves = False

    def note_declined(self, scanned: ScannedFoot) -> None:
        """Remember that a foot which was handed over was not wanted; it may be once more."""
        self._handed = {s: made for s, made in self._handed.items() if made.scan is not scanned}

    def progressed(self, news: JobProgress) -> None:
        """Show the progress of a job."""
        if news.channel in (READING, MAKING):
            self._panel.show_progress(news.fraction, news.text)

    @property
    def _is_stale(self) -> bool:
        if self._work is None:
            return True
        wanted = {
            foot.session.manifest.one_side: (foot.edits, self._limits)
            for foot in self._work.opened.feet
            if self._only in (None, foot.session.manifest.side)
        }
        return wanted != {side: (foot.edits, foot.limits) for side, foot in self._made_feet.items()}

    @property
    def _made(self) -> MadeFoot | None:
        """The foot that is shown, if it is made."""
        return self._made_feet.get(self._side)

    def _foot(self, work: SessionEditor) -> MeasuredSession:
        """Return the session of the foot that is shown, in the foot's own reference frame."""
        return work.opened.of_foot(self._side)

    def _connect(self, panel: FootStagePanel) -> None:
        panel.foot_chosen.connect(self.choose_foot)
        panel.view_chosen.connect(self.choose_view)
        panel.view_switched.connect(self.switch_view)
        panel.box_edited.connect(self.edit_box)
        panel.box_reset.connect(self.reset_box)
        panel.map_chosen.connect(self.choose_map)
        panel.limits_edited.connect(self.edit_limits)
        panel.undo_requested.connect(self.undo)
        panel.redo_requested.connect(self.redo)
        panel.make_requested.connect(self.make)
        panel.cancel_requested.connect(self.cancel)
        panel.go_on_requested.connect(self.go_on)

    def _take_session(self, read: _ReadSession) -> None:
        self._work = read.work
        self.make()  # it has begun when its views are shown
        try:
            self._show_session(read)
        except Exception as error:  # noqa: BLE001 - shown by the window
            # Half of one session must not stand beside half of another.
            self._jobs.cancel(MAKING)
            self._forget("")
            self._unreadable(error)

    def _show_session(self, read: _ReadSession) -> None:
        work, self._side = read.work, read.side
        self._panel.show_session(
            visible_line(work.opened.path.stem), work.opened.session.manifest.sides
        )
        self._panel.show_side(self._side)
        self._mesh_box, self._meshes = self._foot(work).box, dict(read.meshes)
        self._panel.show_box(self._mesh_box)
        self._markers.take(work)
        self._take_change(frozenset())

    def _take_change(self, moved: frozenset[str]) -> None:
        """Show the views after a correction that moved some of them."""
        if self._work is None:
            return
        box = self._foot(self._work).box
        if box != self._mesh_box:
            self._mesh_box = box
            self._panel.show_box(self._mesh_box)
            moved = frozenset(self._work.names)
        for name in moved:
            self._meshes.pop(name, None)
        self._trouble = self._work.trouble
        self._show_views()
        self._markers.show()
        self._show_foot()
        self._show_sentences()
        self._show_buttons()

    def _take_feet(self, feet: Sequence[MadeFoot]) -> None:
        self._made_feet = {made.scan.foot.side: made for made in feet}
        if self._made is None:
            self.choose_foot(feet[0].scan.foot.side)
        self._panel.show_progress(0.0, "")
        if self._hands_over:
            self._hands_over = False
            all_taken = self._give()
            if self._leaves and not all_taken:
                self._leaves = False
                self._needed_again()
        if self._leaves:
            self._finished(True)
            return
        self._show_foot()
        self._show_sentences()
        self._show_buttons()

    def _take_trouble(self, error: Exception) -> None:
        self._panel.show_progress(0.0, "")
        if isinstance(error, MissingFootError) and self._ask_alone(str(error), error.side.other):
            self.make(only=error.side.other)
            return
        if isinstance(error, SideMismatchError) and self._only is None:
            shown = error.asked.other
            answer = self._ask_side(str(error), shown)
            if answer is OtherFoot.TAKE:
                self._take_as(shown)
            if answer is not OtherFoot.CANCEL:
                self.make(force=answer is OtherFoot.INSIST)
                return
        elif isinstance(error, (SideMismatchError, DoubtfulFeetError)) and self._ask(str(error)):
            # The place of one foot of two says which one it is; the other has its own.
            self.make(force=True, only=self._only)
            return
        if not isinstance(error, InsoleError):
            raise error
        was_left, self._leaves = self._leaves, False
        self._trouble = str(error)
        self._show_sentences()
        self._show_buttons()
        if was_left:
            self._needed_again()

    def _take_as(self, side: Side) -> None:
        """Take the session of one foot as that of the other side from now on."""
        if self._work is not None:
            self._work.take_as(side)
            self._panel.show_session(visible_line(self._work.opened.path.stem), (side,))
            self.choose_foot(side)

    def _give(self) -> bool:
        """Hand over the feet that were not handed over yet; return whether all were wanted."""
        for side, made in self._made_feet.items():
            if self._handed.get(side) is not made:
                self._handed[side] = made
                self._hand_over(made.scan)
        return all(self._handed.get(side) is made for side, made in self._made_feet.items())

    def _apply(self, edits: HandEdits, sentence: str, merge_key: str = "") -> None:
        if self._work is not None:
            self._work.apply(edits, sentence, merge_key)

    def _show_views(self) -> None:
        if self._work is not None:
            rows = [
                view_row(number, self._work.results[name], self.edits.of(name))
                for number, name in enumerate(self._work.names)
            ]
            self._panel.show_views(rows, self._markers.selected)

    def _show_foot(self) -> None:
        possible = self._possible_maps()
        if self._map not in possible:
            self._map = FootMap.VIEWS
        self._panel.show_map(self._map, possible)
        if self._map is FootMap.VIEWS:
            self._show_view_meshes()
        elif self._made is not None:
            coloring = color_foot(self._map, self._made)
            self._panel.show_foot(*on_display(self._made.display_surface(), coloring))

    def _possible_maps(self) -> list[FootMap]:
        return [FootMap.VIEWS] if self._made is None else list(FootMap)

    def _show_view_meshes(self) -> None:
        """Show every registered view in its own colour."""
        if self._work is None:
            return
        missing = [name for name in self._work.names if name not in self._meshes]
        self._meshes |= _view_meshes(self._work, self._side, missing)
        results = self._work.results
        shown = [mesh for name, mesh in self._meshes.items() if results[name].used]
        if shown:
            self._panel.show_foot(_together(shown), None)
        else:
            self._panel.show_nothing(tr("No view is placed. Correct its markers, or tick a view."))

    def _show_sentences(self) -> None:
        sentences = [self._trouble] if self._trouble else self._troubles_of_views()
        made = self._made
        if made is not None and not self._is_stale:
            sentences += made.scan.warnings
        self._panel.show_sentences(sentences)

    def _troubles_of_views(self) -> list[str]:
        """Return why views cannot be used, unless the foot's own warnings say so."""
        if self._work is None or not self._is_stale:
            return []
        return [
            tr("View {name}: {reason}.").format(
                name=view_text(name), reason=translate_core_message(result.reason)
            )
            for name, result in self._work.results.items()
            if not result.used and not self.edits.of(name).off
        ]

    def _show_buttons(self) -> None:
        busy = self._jobs.is_running(MAKING) or self._jobs.is_running(READING)
        history = self._work.history if self._work is not None else None
        self._panel.show_buttons(
            FootButtons(
                make=self._work is not None and not busy,
                cancel=busy,
                go_on=bool(self._made_feet) and not (busy and self._is_stale),
                undo=history.undo_sentence if history is not None else "",
                redo=history.redo_sentence if history is not None else "",
                is_stale=bool(self._made_feet) and self._is_stale,
                has_session=self._work is not None,
            )
        )


def _view_meshes(work: SessionEditor, side: Side, names: Sequence[str]) -> dict[str, TriangleMesh]:
    """Mesh the views that are placed, each in its own colour, in the foot's reference frame."""
    foot = work.opened.of_foot(side)

    def mesh_of(name: str) -> tuple[str, TriangleMesh] | None:
        pose = _pose(work, side, work.results[name])
        if pose is None:
            return None
        color = VIEW_COLORS[work.names.index(name) % len(VIEW_COLORS)]
        return name, view_mesh(foot.measured[name], pose, foot.box, color)

    return dict(filter(None, for_views(mesh_of, names)))


def _pose(work: SessionEditor, side: Side, result: ViewResult) -> FloatArray | None:
    """Return the pose of a view in the own reference frame of a foot."""
    system = work.opened.session.manifest.reference_system
    pose = result.sensor2reference
    if pose is None or not system.feet:
        return pose
    return rigid(np.eye(3), -np.array(system.place(side).origin_mm)) @ pose


def _prepare_display(made: MadeFoot) -> None:
    """Compute in the job what this window shows, and what the design stage shows at once."""
    foot = made.scan.foot
    both(lambda: find_landmarks(foot), foot.display_surface)
    made.display_surface()


def _shown(limits: RegistrationLimits) -> Limits:
    return Limits(limits.residual_mm, limits.reprojection_px, limits.displacement_mm)


def _together(meshes: Sequence[TriangleMesh]) -> TriangleMesh:
    """Return several coloured meshes as one."""
    starts = np.cumsum([0, *(len(mesh.vertices) for mesh in meshes[:-1])])
    return TriangleMesh(
        np.concatenate([mesh.vertices for mesh in meshes]),
        np.concatenate(
            [mesh.triangles + np.int32(start) for mesh, start in zip(meshes, starts, strict=True)]
        ),
        np.concatenate([mesh.colors for mesh in meshes if mesh.colors is not None]),
    )
