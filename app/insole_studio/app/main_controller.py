"""The controller of the window: leads actions to their rooms, and shows how far the case is."""

from __future__ import annotations

from pathlib import Path

from PySide6.QtCore import QObject, Qt, Signal

from insole_core.errors import InsoleError
from insole_studio.app.action_context import ActionContext
from insole_studio.app.actions import ACTIONS
from insole_studio.app.main_window import MainWindow
from insole_studio.app.workflow_steps import session_of, steps_of
from insole_studio.document.autosave import Autosave
from insole_studio.document.case import Case
from insole_studio.document.case_name import case_name, whose
from insole_studio.features.design.tools.tool_controller import ToolController
from insole_studio.services.recent_files import RecentFiles
from insole_studio.settings import Settings

_STEP_ACTIONS = {"foot": "tool_key_point", "design": "tool_pelott", "export": "export"}


class MainController(QObject):
    """Connects window, case and rooms. Constructed by the composition root."""

    closed = Signal()

    def __init__(
        self,
        *,
        rooms: ActionContext,
        window: MainWindow,
        case: Case,
        tool_controller: ToolController,
        autosave: Autosave,
        settings: Settings,
        recent: RecentFiles,
    ) -> None:
        super().__init__()
        self.rooms = rooms
        self._window = window
        self._case = case
        self._tool_controller = tool_controller
        self._autosave = autosave
        self._recent = recent
        self._actions = {record.key: record for record in ACTIONS}
        self._connect_window()
        for signal in (case.opened, case.changed, case.saved_changed, case.selection_changed):
            signal.connect(self._show_state)
        rooms.exporting.changed.connect(self._show_state)
        rooms.comparing.counterpart.changed.connect(self._show_choices)
        tool_controller.tool_changed.connect(self._show_tool)
        autosave.failed.connect(rooms.messages.show_sentence)
        self._show_state()
        self._show_tool()
        self._show_choices()
        self._show_recent()
        window.check_action("linked", settings.linked_views)
        rooms.appearance.set_linked(settings.linked_views)

    def run_action(self, key: str, checked: bool) -> None:
        """Do what an action says; what the user can put right is shown as a sentence."""
        self.rooms.stage.end_keys()
        try:
            self._actions[key].run(self.rooms, checked)
        except InsoleError as error:
            self.rooms.messages.show_error(error)
        self._show_choices()

    def quit(self) -> None:
        """Close, once nothing can be lost."""
        self.rooms.saving.after_unsaved(self._close)

    def _connect_window(self) -> None:
        rooms, window = self.rooms, self._window
        window.action_triggered.connect(self.run_action)
        window.close_requested.connect(self.quit)
        window.recent_chosen.connect(self._open_recent)
        window.back_requested.connect(rooms.navigating.go_back)
        window.pad_chosen.connect(rooms.prescribing.take_pad)
        window.layout_changed.connect(rooms.appearance.note_layout)
        self._recent.changed.connect(self._show_recent)
        rooms.stage.offer_chosen.connect(self._take_offer)
        rooms.stage.steps.chosen.connect(self._go_to_step)
        rooms.capture.captured.connect(rooms.opening.open_path)
        rooms.foot.foot_made.connect(rooms.opening.take_scan)
        rooms.foot.closed.connect(rooms.capture.hand_on, Qt.ConnectionType.QueuedConnection)
        rooms.foot.closed.connect(window.come_forward, Qt.ConnectionType.QueuedConnection)
        rooms.foot.unreadable.connect(rooms.messages.show_error)

    def _go_to_step(self, key: str) -> None:
        if key == "patient":
            self.rooms.stage.patient.setFocus()
        elif key == "capture":
            self.run_action("capture", False)
        elif key == "foot" and (session := session_of(self._case.record)) is not None:
            self.rooms.foot.open_session(session, hand_over=False)
        elif self._case.foot is not None:
            self.run_action(_STEP_ACTIONS[key], True)

    def _close(self) -> None:
        self._tool_controller.cancel()
        self.rooms.capture.close()
        self.rooms.calibrate.close()
        self.rooms.exporting.close()
        self.rooms.compare.close()
        self.rooms.foot.close()
        self._autosave.forget()
        self.rooms.appearance.remember_layout()
        self._window.close_for_good()
        self.closed.emit()

    def _open_recent(self, name: str) -> None:
        self.rooms.opening.open_path(Path(name))

    def _take_offer(self, key: str) -> None:
        self.run_action({"open_mesh": "open_archive"}.get(key, key), False)

    def _show_recent(self) -> None:
        self._window.show_recent(self._recent.names)

    def _show_state(self) -> None:
        case, window = self._case, self._window
        window.show_title(case_name(case), case.has_unsaved_changes)
        for key, sentence in (
            ("undo", case.history.undo_sentence),
            ("redo", case.history.redo_sentence),
        ):
            verb = self._actions[key].text()
            window.show_action(key, bool(sentence), f"{verb}: {sentence}" if sentence else verb)
        for record in ACTIONS:
            if record.needs_foot:
                window.show_action(record.key, case.foot is not None)
            if record.needs_both:
                window.show_action(record.key, len(case.record.feet) == 2)
        window.show_action("remove", case.selection is not None)
        exported = self.rooms.exporting.exported
        self.rooms.stage.steps.show_steps(steps_of(case.record, case.record is exported))
        self.rooms.stage.steps.show_whose(whose(case.record))

    def _show_choices(self) -> None:
        """Check what is really shown, whoever has chosen it."""
        comparing = self.rooms.comparing
        self._window.check_action(f"beside_{comparing.counterpart.kind.value}", True)
        self._window.check_action(f"map_{comparing.map_kind.value}", True)

    def _show_tool(self) -> None:
        self._window.check_action(f"tool_{self._tool_controller.tool.key}", True)
