"""What the actions do: opens, saves and exports the case, and keeps the window in step with it."""

from __future__ import annotations

import traceback
from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path

from PySide6.QtCore import QObject, QTimer, Signal
from PySide6.QtWidgets import QApplication, QMessageBox

from insole_core.cases.case_file import read_case, write_case
from insole_core.cases.record import CaseRecord
from insole_core.errors import InsoleError
from insole_core.export.solid_file import write_solids
from insole_core.export.three_mf import Part
from insole_core.foot.placing import SideMismatchError
from insole_core.geometry.side import Side
from insole_core.insole.build import build_insole
from insole_core.progress import Progress
from insole_core.resources import resource_path
from insole_core.solids.solid import make_solid
from insole_studio.jobs import Jobs
from insole_studio.scene.camera import Preset
from insole_studio.settings import Language, Settings
from insole_studio.shell.actions import ACTIONS, EXAMPLE
from insole_studio.shell.capture_window import CaptureWindow
from insole_studio.shell.main_window import MainWindow
from insole_studio.shell.outline_print import print_outline
from insole_studio.shell.prescribing import Prescribing, case_kinds
from insole_studio.shell.questions import Answer, Questions
from insole_studio.shell.stage_window import StageWindow
from insole_studio.shell.steps import steps_of, whose
from insole_studio.shell.theme import apply_theme, is_dark
from insole_studio.shell.tour_stops import tour_stops
from insole_studio.stages.calibrate.stage import CalibrateStage
from insole_studio.stages.design.maps import MapKind
from insole_studio.stages.design.stage import DesignStage
from insole_studio.texts import tr
from insole_studio.tools.hand import Hand
from insole_studio.widgets.error_dialog import ErrorDialog
from insole_studio.widgets.tour import Tour
from insole_studio.workbench.autosave import Autosave, Recovered
from insole_studio.workbench.case import Case
from insole_studio.workbench.opening import (
    CASE_SUFFIX,
    MESH_SUFFIXES,
    OpenedFoot,
    kind_of,
    open_mesh,
    open_session,
)
from insole_studio.workbench.pad_library import LibraryPad

OPENING, SAVING, EXPORTING = "open", "save", "export"
LAYOUT_REST_MS = 600
_STEP_ACTIONS = {"foot": "tool_key_point", "design": "tool_pelott", "export": "export"}
SOLID_KINDS = "STL (*.stl);;3MF (*.3mf);;OBJ (*.obj);;PLY (*.ply)"


class Studio(QObject):
    """The controller of the window. Constructed by the composition root."""

    closed = Signal()
    prescribing: Prescribing

    def __init__(
        self,
        *,
        window: MainWindow,
        stage: DesignStage,
        case: Case,
        hand: Hand,
        jobs: Jobs,
        autosave: Autosave,
        settings: Settings,
        questions: Questions,
        capture: CaptureWindow,
        calibrate: StageWindow[CalibrateStage],
        pads: Sequence[LibraryPad] = (),
        remember: Callable[[], None] = lambda: None,
    ) -> None:
        super().__init__()
        self.window = window
        self.stage = stage
        self.case = case
        self.questions = questions
        self.capture: CaptureWindow = capture
        self.calibrate: StageWindow[CalibrateStage] = calibrate
        self._hand = hand
        self._jobs = jobs
        self._autosave = autosave
        self._settings = settings
        self.prescribing = Prescribing(case, hand, pads, self)
        self._remember_settings = remember
        self._exported: CaseRecord | None = None
        self._actions = {record.key: record for record in ACTIONS}
        self.dialogs: list[ErrorDialog] = []
        window.action_triggered.connect(self.run_action)
        window.close_requested.connect(self.quit)
        window.recent_chosen.connect(self._open_recent)
        window.pad_chosen.connect(self.prescribing.take_pad)
        stage.offer_chosen.connect(self._take_offer)
        capture.captured.connect(self.open_path)
        stage.steps.chosen.connect(self._go_to_step)
        self._layout_rest = QTimer(window)
        self._layout_rest.setSingleShot(True)
        self._layout_rest.setInterval(LAYOUT_REST_MS)
        self._layout_rest.timeout.connect(self._remember_layout)
        window.layout_changed.connect(self._layout_rest.start)
        case.opened.connect(self._show_state)
        case.changed.connect(self._show_state)
        case.saved_changed.connect(self._show_state)
        case.selection_changed.connect(self._show_state)
        hand.tool_changed.connect(self._show_tool)
        autosave.failed.connect(self.show_sentence)
        self._show_state()
        self._show_tool()
        window.show_recent(settings.recent)
        window.check_action("linked", settings.linked_views)
        self.set_linked(settings.linked_views)

    def run_action(self, key: str, checked: bool) -> None:
        """Do what an action says; what the user can put right is shown as a sentence."""
        try:
            self._actions[key].run(self, checked)
        except InsoleError as error:
            self.show_error(error)

    def open_path(self, path: Path, side: Side | None = None) -> None:
        """Open a case, a session or a mesh, whatever the path is."""
        try:
            kind = kind_of(path)
        except InsoleError as error:
            self.show_error(error)
            return
        if kind == "case":
            self._open_case(path)
        elif kind == "mesh":
            self._open_mesh(path, side or self.questions.which_side(path))
        else:
            self._open_session(path.parent if kind == "manifest" else path)

    def ask_open_case(self) -> None:
        """Let the user choose a case."""
        self._open_chosen(self.questions.file_to_open(case_kinds()))

    def ask_open_session(self) -> None:
        """Let the user choose the folder of a session."""
        self._open_chosen(self.questions.folder_to_open())

    def ask_open_mesh(self) -> None:
        """Let the user choose an archive or a mesh."""
        patterns = " ".join(f"*{suffix}" for suffix in (".zip", *MESH_SUFFIXES))
        self._open_chosen(self.questions.file_to_open(tr("Session or mesh") + f" ({patterns})"))

    def new_case(self) -> None:
        """Begin with an empty case."""
        self._after_unsaved(lambda: self.case.open(CaseRecord(), None))

    def save(self) -> None:
        """Save to the file of the case; ask for one where there is none."""
        if self.case.path is None:
            self.ask_save()
        else:
            self.save_to(self.case.path)

    def ask_save(self, then: Callable[[], None] = lambda: None) -> None:
        """Let the user choose where to save."""
        suggestion = f"{self._file_stem()}{CASE_SUFFIX}"
        path = self.questions.file_to_write(suggestion, case_kinds())
        if path is not None:
            self.save_to(path.with_suffix(CASE_SUFFIX), then)

    def save_to(self, path: Path, then: Callable[[], None] = lambda: None) -> None:
        """Save beside the window; then do something more."""
        record = self.case.record

        def write(progress: Progress) -> None:
            progress.step(0.0, tr("Saving the case"))
            write_case(record, path)

        def saved(_nothing: None) -> None:
            self.case.mark_saved(record, path)
            self._remember(path)
            then()

        self._jobs.start(SAVING, write, saved, self.show_error)

    def ask_export(self) -> None:
        """Let the user choose where the STL file goes."""
        path = self.questions.file_to_write(f"{self._file_stem()}.stl", SOLID_KINDS)
        if path is not None:
            self.export_to(path if path.suffix else path.with_suffix(".stl"))

    def export_to(self, path: Path) -> None:
        """Build the insole anew and write it, beside the window."""
        record = self.case.record
        foot, design = record.foot, record.design
        if foot is None or design is None:
            self.show_sentence(tr("There is no insole to export yet; open a session or a mesh."))
            return

        def write(progress: Progress) -> None:
            insole = build_insole(foot, design, progress.part(0.0, 0.8))
            solid = make_solid(insole, progress=progress.part(0.8, 0.9))
            progress.step(0.9, tr("Writing the file"))
            write_solids([Part(solid, f"{design.side} insole")], path)

        def done(_nothing: None) -> None:
            self._exported = record
            self._show_state()
            self.say(tr("Exported {name}").format(name=path.name))

        self._jobs.start(EXPORTING, write, done, self.show_error)

    def ask_print_outline(self) -> None:
        """Let the user choose where the PDF goes."""
        path = self.questions.file_to_write(f"{self._file_stem()}-outline.pdf", "PDF (*.pdf)")
        if path is not None:
            self.print_outline_to(path.with_suffix(".pdf"))

    def print_outline_to(self, path: Path) -> None:
        """Write the outline in true size."""
        record = self.case.record
        foot, design = record.foot, record.design
        if foot is None or design is None:
            return
        text = "   ".join(part for part in (whose(record), record.patient.visit) if part)

        def write(progress: Progress) -> None:
            insole = build_insole(foot, design, progress.part(0.0, 0.9))
            progress.step(0.9, tr("Writing the file"))
            print_outline(insole, text, path)

        def done(_nothing: None) -> None:
            self.say(tr("Written: {name}").format(name=path.name))

        self._jobs.start(EXPORTING, write, done, self.show_error)

    def undo(self) -> None:
        """Take the gesture or the last step back."""
        if not self._hand.cancel():
            self.case.undo()

    def redo(self) -> None:
        """Do the last undone step again."""
        self._hand.cancel()
        self.case.redo()

    def remove_selected(self) -> None:
        """Take the selected correction out."""
        design, selected = self.case.record.design, self.case.selection
        if design is not None and selected is not None:
            self.case.apply(design.with_removed(selected), tr("Remove a correction"))

    def take_tool(self, key: str) -> None:
        """Take a tool into the hand."""
        self._hand.take(key)

    def look(self, preset: Preset) -> None:
        """Look from a named direction."""
        self.stage.look(preset)

    def fit(self) -> None:
        """Show the whole foot and the whole insole."""
        self.stage.fit()

    def show_map(self, kind: MapKind) -> None:
        """Colour the insole by a map."""
        self.stage.insole_presenter.show_map(kind)

    def show_contours(self, shown: bool) -> None:
        """Draw lines of equal height on the insole, or not."""
        self.stage.insole_presenter.show_contours(shown)

    def show_wireframe(self, shown: bool) -> None:
        """Show the insole's edges alone, or the whole."""
        self.stage.insole_presenter.show_wireframe(shown)

    def open_example(self) -> None:
        """Open the case that comes with the product."""
        self.open_path(resource_path(EXAMPLE))

    def set_linked(self, linked: bool) -> None:
        """Let the views move together or not."""
        self._settings.linked_views = linked
        self.stage.set_linked(linked)
        self._remember_settings()

    def set_dark(self, dark: bool) -> None:
        """Change the theme."""
        self._settings.theme = "dark" if dark else "light"
        application = QApplication.instance()
        assert isinstance(application, QApplication)
        apply_theme(application, dark, self._settings.touch)
        self.window.renew_icons()
        self.stage.set_dark(dark)
        self._remember_settings()

    def set_touch(self, touch: bool) -> None:
        """Make the targets large enough for fingers, or small again."""
        self._settings.touch = touch
        application = QApplication.instance()
        assert isinstance(application, QApplication)
        apply_theme(application, is_dark(self._settings.theme), touch)
        self.stage.set_touch(touch)
        self._remember_settings()

    def set_language(self, language: Language) -> None:
        """Speak another language from the next start on."""
        self._settings.language = language
        self._remember_settings()
        self.say(tr("The window speaks this language from the next start on."))

    def begin_tour(self) -> None:
        """Show the window in five steps."""
        tour = Tour(tour_stops(self.stage), self.window)
        tour.ended.connect(self._end_tour)
        tour.begin()

    def show_about(self) -> None:
        """Say what this program is."""
        QMessageBox.about(
            self.window,
            tr("About Insole Studio"),
            tr("Insole Studio: from the scan of a foot to its insole. BSD 3-Clause licence."),
        )

    def show_error(self, error: Exception) -> None:
        """Show an error; the details only where the sentence was not written for the user."""
        if isinstance(error, InsoleError):
            self._show_dialog(str(error), _cause(error))
        else:
            sentence = tr("Something unexpected happened; your work is kept. Please report it.")
            self._show_dialog(sentence, "".join(traceback.format_exception(error)))

    def show_sentence(self, sentence: str) -> None:
        """Show a sentence in a dialog."""
        self._show_dialog(sentence, "")

    def offer_recovered(self, recovered: Recovered) -> None:
        """Open what a crash has left; it stays unsaved, under a copy of this window's own."""
        self.case.open(recovered.record, recovered.path, unsaved=True)
        self.window.statusBar().showMessage(
            tr("Work that was not saved when Insole Studio ended last time is open again."), 15000
        )
        self._autosave.write_now()
        recovered.discard()

    def quit(self) -> None:
        """Close, once nothing can be lost."""
        self._after_unsaved(self._close)

    def say(self, text: str) -> None:
        """Say something in the status line."""
        self.window.statusBar().showMessage(text, 5000)

    def _end_tour(self) -> None:
        self._settings.tour_seen = True
        self._remember_settings()

    def _remember_layout(self) -> None:
        layout = self.window.layout_state()
        self._settings.window_geometry, self._settings.window_docks = layout
        self._remember_settings()

    def _go_to_step(self, key: str) -> None:
        if key == "patient":
            self.stage.patient.setFocus()
        elif key == "capture":
            self.run_action("capture", False)
        elif self.case.foot is not None:
            self.run_action(_STEP_ACTIONS[key], True)

    def _close(self) -> None:
        self._hand.cancel()
        self.capture.close()
        self.calibrate.close()
        self._autosave.forget()
        self._remember_layout()
        self._layout_rest.stop()
        self.window.close_for_good()
        self.closed.emit()

    def _after_unsaved(self, then: Callable[[], None]) -> None:
        if not self.case.has_unsaved_changes or self.case.is_empty:
            then()
            return
        answer = self.questions.about_unsaved(self._name())
        if answer is Answer.DISCARD:
            then()
        elif answer is Answer.SAVE and self.case.path is not None:
            self.save_to(self.case.path, then)
        elif answer is Answer.SAVE:
            self.ask_save(then)

    def _open_chosen(self, path: Path | None) -> None:
        if path is not None:
            self.open_path(path)

    def _open_recent(self, name: str) -> None:
        self.open_path(Path(name))

    def _remember(self, path: Path) -> None:
        self._settings.remember(path)
        self.window.show_recent(self._settings.recent)

    def _open_case(self, path: Path) -> None:
        def read(progress: Progress) -> CaseRecord:
            progress.step(0.0, tr("Opening the case"))
            return read_case(path)

        def opened(record: CaseRecord) -> None:
            self.case.open(record, path)
            self._remember(path)

        self._after_unsaved(lambda: self._jobs.start(OPENING, read, opened, self.show_error))

    def _open_session(self, path: Path) -> None:
        self._open_foot(partial(open_session, path), self.show_error)

    def _open_mesh(self, path: Path, side: Side | None, force: bool = False) -> None:
        if side is None:
            return

        def failed(error: Exception) -> None:
            if isinstance(error, SideMismatchError):
                if self.questions.open_anyway(str(error)):
                    self._open_mesh(path, side, force=True)
            else:
                self.show_error(error)

        def task(progress: Progress) -> OpenedFoot:
            return open_mesh(path, side, force, progress)

        self._open_foot(task, failed)

    def _open_foot(
        self, task: Callable[..., OpenedFoot], failed: Callable[[Exception], None]
    ) -> None:
        def opened(result: OpenedFoot) -> None:
            self.case.open_foot(result.foot, result.source)
            self._remember(Path(result.source.path))
            if result.warnings:
                self.show_sentence(" ".join(result.warnings))
            self.window.statusBar().showMessage(" ".join(result.foot.notes), 8_000)

        def start() -> None:
            self._jobs.start(OPENING, lambda progress: task(progress=progress), opened, failed)

        if self.case.foot is None:
            start()
        else:
            self._after_unsaved(start)

    def _take_offer(self, key: str) -> None:
        self.run_action({"open_mesh": "open_archive"}.get(key, key), False)

    def _show_state(self) -> None:
        case, window = self.case, self.window
        window.show_title(self._name(), case.has_unsaved_changes)
        for key, sentence in (
            ("undo", case.history.undo_sentence),
            ("redo", case.history.redo_sentence),
        ):
            verb = self._actions[key].text()
            window.show_action(key, bool(sentence), f"{verb}: {sentence}" if sentence else verb)
        for record in ACTIONS:
            if record.needs_foot:
                window.show_action(record.key, case.foot is not None)
        window.show_action("remove", case.selection is not None)
        self.stage.steps.show_steps(steps_of(case.record, case.record is self._exported))
        self.stage.steps.show_whose(whose(case.record))

    def _show_tool(self) -> None:
        self.window.check_action(f"tool_{self._hand.tool.key}", True)

    def _show_dialog(self, sentence: str, details: str) -> None:
        dialog = ErrorDialog(sentence, details, self.window)
        self.dialogs.append(dialog)
        dialog.finished.connect(self._forget_dialog)
        dialog.open()

    def _forget_dialog(self) -> None:
        dialog = self.sender()
        assert isinstance(dialog, ErrorDialog)
        self.dialogs.remove(dialog)
        dialog.deleteLater()

    def _name(self) -> str:
        if self.case.path is not None:
            return self.case.path.stem
        return self.case.record.patient.name or tr("New case")

    def _file_stem(self) -> str:
        name = self._name() if self.case.record.patient.name or self.case.path else "insole"
        side = self.case.side
        return f"{name}-{side.value}" if side is not None and side.value not in name else name


def _cause(error: Exception) -> str:
    return repr(error.__cause__) if error.__cause__ is not None else ""
