"""Between the foot stage and the session that is reconstructed."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any, Protocol

import numpy as np

from insole_core.cases.scan import ScannedFoot
from insole_core.errors import InsoleError, OutputError
from insole_core.foot.placing import SideMismatchError
from insole_core.geometry.arrays import ByteArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.side import Side
from insole_core.progress import Progress
from insole_core.reconstruct import RegistrationLimits, ViewResult
from insole_core.reconstruct.view_mesh import view_mesh
from insole_core.recording.hand_edits import HandEdits, NamedSpot, Pixel, Region, ViewEdits
from insole_core.recording.hand_edits_file import write_edits
from insole_core.recording.session import Box
from insole_studio.jobs import JobProgress, Jobs
from insole_studio.scene.coloring import Coloring
from insole_studio.stages.reconstruct.maps import color_foot
from insole_studio.stages.reconstruct.marks import marks_of
from insole_studio.stages.reconstruct.rows import (
    VIEW_COLORS,
    Buttons,
    FootMap,
    Limits,
    Mark,
    ViewRow,
    view_row,
)
from insole_studio.texts import tr
from insole_studio.workbench.history import History
from insole_studio.workbench.reconstructing import (
    MadeFoot,
    MeasuredSession,
    make_foot,
    measure_session,
)

READING, MAKING = "read-session", "reconstruct"
"""The channels of the jobs."""
_SPOT_SHARE = 14 / 1280
"""Half the width of what is ignored round a blue spot that is no marker."""


class ReconstructPanel(Protocol):
    """What the stage shows, and the intents it emits."""

    view_chosen: Any
    view_switched: Any
    marker_toggled: Any
    marker_named: Any
    marker_released: Any
    marker_moved: Any
    marker_dropped: Any
    spot_ignored: Any
    region_ignored: Any
    region_searched: Any
    regions_cleared: Any
    box_edited: Any
    box_reset: Any
    map_chosen: Any
    limits_edited: Any
    undo_requested: Any
    redo_requested: Any
    make_requested: Any
    cancel_requested: Any
    go_on_requested: Any

    def show_session(self, name: str, side: Side) -> None: ...  # noqa: D102
    def show_views(self, rows: Sequence[ViewRow], selected: str) -> None: ...  # noqa: D102
    def show_picture(self, picture: ByteArray) -> None: ...  # noqa: D102
    def show_markers(  # noqa: D102
        self, marks: Sequence[Mark], ids: Sequence[str], edits: ViewEdits
    ) -> None: ...
    def show_foot(self, mesh: TriangleMesh, coloring: Coloring | None) -> None: ...  # noqa: D102
    def show_map(self, kind: FootMap, possible: Sequence[FootMap]) -> None: ...  # noqa: D102
    def show_box(self, box: Box) -> None: ...  # noqa: D102
    def show_limits(self, limits: Limits) -> None: ...  # noqa: D102
    def show_sentences(self, sentences: Sequence[str]) -> None: ...  # noqa: D102
    def show_progress(self, fraction: float, text: str) -> None: ...  # noqa: D102
    def show_buttons(self, buttons: Buttons) -> None: ...  # noqa: D102


class ReconstructPresenter:
    """Places the views anew at every correction, and makes the foot when asked.

    Parameters
    ----------
    panel
    jobs
    limits
        When the pose of a view is refused.
    remember
        Is told other limits.
    hand_over
        Is given a foot that is to be designed on.
    ask
        Whether to go on although a sentence speaks against it.
    finished
        Is told that the stage has done its work; with True when nothing runs any more.
    unreadable
        Is given the error when the session cannot be read at all.
    """

    def __init__(
        self,
        *,
        panel: ReconstructPanel,
        jobs: Jobs,
        limits: RegistrationLimits,
        remember: Callable[[RegistrationLimits], None],
        hand_over: Callable[[ScannedFoot], None],
        ask: Callable[[str], bool],
        finished: Callable[[bool], None],
        unreadable: Callable[[Exception], None],
    ) -> None:
        self._panel = panel
        self._jobs = jobs
        self._limits = limits
        self._remember = remember
        self._hand_over = hand_over
        self._ask = ask
        self._finished = finished
        self._unreadable = unreadable
        self._opened: MeasuredSession | None = None
        self._results: dict[str, ViewResult] = {}
        self._meshes: dict[str, TriangleMesh] = {}
        self._history: History[HandEdits] = History()
        self._selected = ""
        self._map = FootMap.VIEWS
        self._made: MadeFoot | None = None
        self._handed: MadeFoot | None = None
        self._trouble = ""
        self._hands_over = False
        """Whether the foot is to be handed over as soon as it is made."""
        self._leaves = False
        """Whether the stage is left with that."""
        self._connect(panel)
        panel.show_limits(_shown(limits))
        self._show_buttons()

    def open(self, path: Path, hand_over: bool) -> None:
        """Read a session and make its foot; hand it over then, or leave that to the user."""
        self._opened = self._made = self._handed = None
        self._hands_over, self._leaves = hand_over, False
        self._history.clear()
        self._trouble = ""

        def read(progress: Progress) -> tuple[MeasuredSession, dict[str, ViewResult]]:
            opened = measure_session(path, progress.part(0.0, 0.9))
            progress.step(0.9, "Finding the markers")
            return opened, self._placed(opened)

        self._jobs.start(READING, read, self._take_session, self._unreadable)

    @property
    def box(self) -> Box | None:
        """The volume of interest; None before there is a session."""
        return None if self._opened is None else self._opened.box

    @property
    def edits(self) -> HandEdits:
        """What was corrected by hand."""
        return HandEdits() if self._opened is None else self._opened.edits

    def choose_view(self, name: str) -> None:
        """Show another view's image."""
        if self._opened is None or name == self._selected:
            return
        self._selected = name
        if name in self._opened.measured:
            self._panel.show_picture(self._opened.measured[name].color)
        self._show_markers()

    def switch_view(self, name: str, on: bool) -> None:
        """Use a view, or leave it out."""
        edits = replace(self.edits.of(name), off=not on)
        text = tr("Use the view {name}") if on else tr("Leave out the view {name}")
        self._apply(self.edits.with_view(name, edits), text.format(name=name))

    def toggle_marker(self, marker: str) -> None:
        """Exclude a marker, or include it again."""
        edits = self._view_edits
        if marker in edits.excluded:
            self._edit(edits.with_included(marker), tr("Include {id}").format(id=marker))
        else:
            self._edit(edits.with_excluded(marker), tr("Exclude {id}").format(id=marker))

    def name_marker(self, marker: str, pixel: Pixel, exact: bool) -> None:
        """Say which marker a spot is, or that a marker is at a place."""
        edits = self._view_edits.with_named(NamedSpot(marker, pixel, exact))
        self._edit(edits, tr("Point at {id}").format(id=marker))

    def release_marker(self, marker: str) -> None:
        """Leave a marker to the automatic search."""
        edits = self._view_edits.without_name(marker).with_included(marker)
        self._edit(edits, tr("Search for {id}").format(id=marker))

    def move_marker(self, marker: str, pixel: Pixel) -> None:
        """Show where a marker would be, while the hand moves it."""
        if self._opened is not None:
            edits = self._view_edits.with_named(NamedSpot(marker, pixel, exact=True))
            shown = self._opened.with_edits(self.edits.with_view(self._selected, edits))
            self._results[self._selected] = shown.placed(self._selected, self._limits)
            self._show_views()
            self._show_markers()

    def ignore_spot(self, pixel: Pixel) -> None:
        """Say that a blue spot is no marker."""
        if self._opened is not None:
            half = _SPOT_SHARE * self._opened.measured[self._selected].color.shape[1]
            u, v = pixel
            corners = ((-half, -half), (half, -half), (half, half), (-half, half))
            region = tuple((u + du, v + dv) for du, dv in corners)
            self._edit(self._view_edits.with_ignored(region), tr("Ignore a blue spot"))

    def ignore_region(self, region: Region) -> None:
        """Say that a region shows no marker."""
        self._edit(self._view_edits.with_ignored(region), tr("Ignore a region"))

    def search_region(self, region: Region) -> None:
        """Search in a region only."""
        self._edit(replace(self._view_edits, searched=region), tr("Search in a region"))

    def clear_regions(self) -> None:
        """Search the whole image again."""
        edits = replace(self._view_edits, searched=None, ignored=())
        self._edit(edits, tr("Search the whole image"))

    def edit_box(self, box: Box) -> None:
        """Take another volume of interest."""
        edits = replace(self.edits, volume_of_interest=box)
        self._apply(edits, tr("Change the volume"), merge_key="box")

    def reset_box(self) -> None:
        """Take the volume that was recorded."""
        self._apply(replace(self.edits, volume_of_interest=None), tr("Reset the volume"))

    def edit_limits(self, limits: Limits) -> None:
        """Refuse poses from other limits on."""
        self._limits = replace(
            self._limits,
            residual_mm=limits.residual_mm,
            reprojection_px=limits.reprojection_px,
            displacement_mm=limits.displacement_mm,
        )
        self._remember(self._limits)
        self._place_all()

    def choose_map(self, kind: FootMap) -> None:
        """Colour the foot otherwise."""
        self._map = kind
        self._show_foot()

    def undo(self) -> None:
        """Take the last correction back."""
        self._step_to(self._history.undo())

    def redo(self) -> None:
        """Do the last undone correction again."""
        self._step_to(self._history.redo())

    def make(self, force: bool = False) -> None:
        """Make the foot with the corrections of now."""
        opened, limits = self._opened, self._limits
        if opened is None:
            return
        self._trouble = ""

        def task(progress: Progress) -> MadeFoot:
            return make_foot(
                opened,
                limits,
                progress,
                on_preview=lambda made: self._jobs.tell(lambda: self._take_preview(made)),
                force=force,
            )

        self._jobs.start(MAKING, task, self._take_foot, self._take_trouble)
        self._show_buttons()

    def cancel(self) -> None:
        """Stop what runs."""
        for channel in (READING, MAKING):
            self._jobs.cancel(channel)
        self._hands_over = self._leaves = False
        self._panel.show_progress(0.0, "")
        self._show_buttons()

    def go_on(self) -> None:
        """Hand the foot over and leave; what is computed still follows when it is ready."""
        self._leaves = True
        running = self._jobs.is_running(MAKING)
        if self._is_stale and not running:
            self._hands_over = True
            self.make()
            return
        if self._made is not None and self._made is not self._handed:
            self._give(self._made)
        self._hands_over = running
        self._finished(not running)

    def progressed(self, news: JobProgress) -> None:
        """Show how far the work is."""
        if news.channel in (READING, MAKING):
            self._panel.show_progress(news.fraction, news.text)

    @property
    def _view_edits(self) -> ViewEdits:
        return self.edits.of(self._selected)

    @property
    def _is_stale(self) -> bool:
        return self._made is None or self._made.edits != self.edits

    def _connect(self, panel: ReconstructPanel) -> None:
        panel.view_chosen.connect(self.choose_view)
        panel.view_switched.connect(self.switch_view)
        panel.marker_toggled.connect(self.toggle_marker)
        panel.marker_named.connect(self.name_marker)
        panel.marker_released.connect(self.release_marker)
        panel.marker_moved.connect(self.move_marker)
        panel.marker_dropped.connect(lambda marker, at: self.name_marker(marker, at, exact=True))
        panel.spot_ignored.connect(self.ignore_spot)
        panel.region_ignored.connect(self.ignore_region)
        panel.region_searched.connect(self.search_region)
        panel.regions_cleared.connect(self.clear_regions)
        panel.box_edited.connect(self.edit_box)
        panel.box_reset.connect(self.reset_box)
        panel.map_chosen.connect(self.choose_map)
        panel.limits_edited.connect(self.edit_limits)
        panel.undo_requested.connect(self.undo)
        panel.redo_requested.connect(self.redo)
        panel.make_requested.connect(self.make)
        panel.cancel_requested.connect(self.cancel)
        panel.go_on_requested.connect(self.go_on)

    def _take_session(self, read: tuple[MeasuredSession, dict[str, ViewResult]]) -> None:
        self._opened, self._results = read
        session = self._opened.session
        self._panel.show_session(self._opened.path.stem, session.manifest.side)
        self._panel.show_box(self._opened.box)
        self._selected = ""
        troubled = (name for name, result in self._results.items() if not result.used)
        self._show_views()
        self.choose_view(next(troubled, session.views[0].name))
        self._show_views()
        self._show_foot()
        self.make()

    def _take_preview(self, made: MadeFoot) -> None:
        if self._jobs.is_running(MAKING) and made.edits == self.edits:
            self._made = made
            self._show_foot()
            self._show_buttons()

    def _take_foot(self, made: MadeFoot) -> None:
        self._made = made
        self._panel.show_progress(0.0, "")
        if self._hands_over:
            self._hands_over = False
            self._give(made)
        if self._leaves:
            self._finished(True)
            return
        self._show_foot()
        self._show_sentences()
        self._show_buttons()

    def _take_trouble(self, error: Exception) -> None:
        self._panel.show_progress(0.0, "")
        if isinstance(error, SideMismatchError) and self._ask(str(error)):
            self.make(force=True)
            return
        if not isinstance(error, InsoleError):
            raise error
        self._trouble, self._leaves = str(error), False
        self._show_sentences()
        self._show_buttons()

    def _give(self, made: MadeFoot) -> None:
        self._handed = made
        self._hand_over(made.scan)

    def _edit(self, edits: ViewEdits, sentence: str) -> None:
        self._apply(self.edits.with_view(self._selected, edits), sentence)

    def _apply(self, edits: HandEdits, sentence: str, merge_key: str = "") -> None:
        if self._opened is not None and edits != self.edits:
            self._history.push(self.edits, edits, sentence, merge_key)
            self._set(edits)

    def _step_to(self, edits: HandEdits | None) -> None:
        if edits is not None:
            self._set(edits)

    def _set(self, edits: HandEdits) -> None:
        """Take corrections: keep them, and place the views that they bear on anew."""
        assert self._opened is not None
        before, self._opened = self._opened, self._opened.with_edits(edits)
        self._trouble = ""
        try:
            write_edits(edits, self._opened.path)
        except OutputError as error:
            self._trouble = str(error)
        for view in self._opened.session.views:
            moved = edits.of(view.name) != before.edits.of(view.name)
            if moved or view.name == self._selected:
                self._results[view.name] = self._opened.placed(view.name, self._limits)
                self._meshes.pop(view.name, None)
        if self._opened.box != before.box:
            self._meshes.clear()
            self._panel.show_box(self._opened.box)
        self._show_views()
        self._show_markers()
        self._show_foot()
        self._show_sentences()
        self._show_buttons()

    def _place_all(self) -> None:
        if self._opened is not None:
            self._results = self._placed(self._opened)
            self._show_views()
            self._show_markers()
            self._show_sentences()

    def _placed(self, opened: MeasuredSession) -> dict[str, ViewResult]:
        return {view.name: opened.placed(view.name, self._limits) for view in opened.session.views}

    def _show_views(self) -> None:
        rows = [
            view_row(number, result, self.edits.of(name))
            for number, (name, result) in enumerate(self._results.items())
        ]
        self._panel.show_views(rows, self._selected)

    def _show_markers(self) -> None:
        if self._opened is None or self._selected not in self._opened.measured:
            return
        measured = self._opened.measured[self._selected]
        system = self._opened.session.manifest.reference_system
        ids = [marker.id for marker in system.facing(measured.view.sensor.faces)]
        marks = marks_of(measured, self._results[self._selected], self._view_edits)
        self._panel.show_markers(marks, ids, self._view_edits)

    def _show_foot(self) -> None:
        possible = self._possible_maps()
        if self._map not in possible:
            self._map = FootMap.VIEWS
        self._panel.show_map(self._map, possible)
        if self._map is FootMap.VIEWS:
            self._show_view_meshes()
        elif self._made is not None:
            self._panel.show_foot(self._made.mesh, color_foot(self._map, self._made))

    def _possible_maps(self) -> list[FootMap]:
        if self._made is None:
            return [FootMap.VIEWS]
        if self._made.reconstruction is None:
            return [FootMap.VIEWS, FootMap.SKIN]
        return list(FootMap)

    def _show_view_meshes(self) -> None:
        """Show every placed view in its own colour."""
        if self._opened is None:
            return
        for number, (name, result) in enumerate(self._results.items()):
            if name not in self._meshes and result.sensor2reference is not None:
                color = VIEW_COLORS[number % len(VIEW_COLORS)]
                self._meshes[name] = view_mesh(
                    self._opened.measured[name], result.sensor2reference, self._opened.box, color
                )
        shown = [mesh for name, mesh in self._meshes.items() if self._results[name].used]
        if shown:
            self._panel.show_foot(_together(shown), None)

    def _show_sentences(self) -> None:
        sentences = [self._trouble] if self._trouble else []
        if self._made is not None and self._made.reconstruction is not None and not self._is_stale:
            sentences += self._made.scan.warnings
        self._panel.show_sentences(sentences)

    def _show_buttons(self) -> None:
        busy = self._jobs.is_running(MAKING) or self._jobs.is_running(READING)
        self._panel.show_buttons(
            Buttons(
                make=self._opened is not None and not busy,
                cancel=busy,
                go_on=self._made is not None and not (busy and self._is_stale),
                undo=self._history.undo_sentence,
                redo=self._history.redo_sentence,
                is_stale=self._made is not None and self._is_stale,
            )
        )


def _shown(limits: RegistrationLimits) -> Limits:
    return Limits(limits.residual_mm, limits.reprojection_px, limits.displacement_mm)


def _together(meshes: Sequence[TriangleMesh]) -> TriangleMesh:
    """Several coloured meshes as one."""
    starts = np.cumsum([0, *(len(mesh.vertices) for mesh in meshes[:-1])])
    return TriangleMesh(
        np.concatenate([mesh.vertices for mesh in meshes]),
        np.concatenate(
            [mesh.triangles + np.int32(start) for mesh, start in zip(meshes, starts, strict=True)]
        ),
        np.concatenate([mesh.colors for mesh in meshes if mesh.colors is not None]),
    )
