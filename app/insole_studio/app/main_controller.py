"""The controller of the window: runs actions and shows the progress of the case."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from PySide6.QtCore import QObject, Qt, Signal
from PySide6.QtWidgets import QApplication, QDialog, QWidget

from insole_core.cases.case_record import CaseRecord, Patient
from insole_core.errors import InsoleError
from insole_core.workflows.scanned_feet import ScannedFoot
from insole_studio.app.actions import ACTIONS, Run, bind_actions
from insole_studio.app.features import Features
from insole_studio.app.window_actions import WindowFeature
from insole_studio.app.workflow_steps import session_of, steps_of
from insole_studio.document.autosave import Autosave
from insole_studio.document.case_names import title_of, whose
from insole_studio.document.hand_over import HandOver
from insole_studio.document.record_keeper import KeepState
from insole_studio.features.clinic.actions import OF_ACCOUNTS
from insole_studio.features.clinic.record_dialog import RecordDialog
from insole_studio.features.records.actions import ADDING, OF_PERSON
from insole_studio.services.app_services import AppServices
from insole_studio.texts import tr, translate_core_message
from insole_studio.widgets.text_fields import commit_typed_text

SCANNING = ("open_session", "open_archive", "capture")
"""Actions that bring a foot, which belongs to a visit."""
ERASED = "case-erased"
_STEP_ACTIONS = {"foot": "tool_key_point", "export": "export"}


class MainController(QObject):
    """Connects window, case and features. Constructed by the composition root."""

    closed = Signal()

    def __init__(
        self,
        services: AppServices,
        features: Features,
        main: WindowFeature,
        autosave: Autosave,
    ) -> None:
        super().__init__()
        self._services = services
        self._case = services.case
        self._features = features
        self._stage = features.design.stage
        self._tool_controller = self._stage.tool_controller
        self._main = main
        self._window = main.window
        self._autosave = autosave
        self._records = {record.key: record for record in ACTIONS}
        self._run = bind_actions(features, main)
        self._connect_window()
        self._connect_features()
        self._connect_records()
        self._connect_clinic()
        self._connect_case()
        self._show_state()
        self._show_tool()
        self._show_choices()
        self._show_recent()
        self._window.check_action("linked", services.settings.linked_views)
        main.appearance.set_linked(services.settings.linked_views)

    def run_action(self, key: str, checked: bool) -> None:
        """Run an action; show a user-correctable error as a sentence.

        Parameters
        ----------
        key
            The action's key in the action table.
        checked
            The new state of a toggle; ignored by other actions.
        """
        commit_typed_text()
        self._stage.end_keys()
        try:
            self._run_of(key)(checked)
        except InsoleError as error:
            self._services.messages.show_error(error)
        self._show_choices()

    def connect_hand_over(self, hand_over: HandOver) -> None:
        """Tell of work that was handed over to the record, and offer what it cannot take."""
        recovery = self._features.case_files.recovery
        hand_over.stuck_changed.connect(lambda left: recovery.show_stuck(left, hand_over.give_up))
        hand_over.stuck_changed.connect(self._features.records.order_actions.take_left)
        hand_over.found.connect(recovery.offer)
        hand_over.damaged.connect(self._services.messages.show_sentence)
        hand_over.handed_over.connect(self._tell_handed_over)
        hand_over.failed.connect(self._services.messages.show_error)

    def quit(self) -> None:
        """Close the window after unsaved work has been dealt with."""
        saver = self._features.case_files.saver
        # The result last: it is dropped for good, and at the case one may still go on.
        saver.after_unsaved(lambda: self._features.calibrate.after_result(self._close))

    def _connect_window(self) -> None:
        window, design = self._window, self._features.design
        window.action_triggered.connect(self.run_action)
        window.close_requested.connect(self.quit)
        window.recent_chosen.connect(self._open_recent)
        window.back_requested.connect(design.navigation.go_back)
        window.pad_chosen.connect(design.prescription.take_pad)
        window.layout_changed.connect(self._main.appearance.note_layout)
        self._services.recent.changed.connect(self._show_recent)
        self._stage.action_requested.connect(self._run_requested)
        self._stage.plantar.changed.connect(self._show_choices)
        self._stage.load.told.connect(self._show_choices)
        self._stage.steps.chosen.connect(self._go_to_step)

    def _connect_features(self) -> None:
        """Connect the output of each feature to the feature that continues with it."""
        features = self._features
        capture, foot, opener = features.capture, features.foot, features.case_files.opener
        capture.captured.connect(opener.open_path)
        capture.captured_for.connect(features.records.captures.store)
        features.records.captures.fetched.connect(opener.open_path)
        foot.foot_made.connect(self._take_made)
        foot.closed.connect(capture.hand_on, Qt.ConnectionType.QueuedConnection)
        foot.closed.connect(self._window.come_forward, Qt.ConnectionType.QueuedConnection)
        foot.unreadable.connect(self._services.messages.show_error)
        features.export.changed.connect(self._show_state)
        features.export.exported_files.connect(features.records.order_actions.note_export)
        self._stage.counterpart.changed.connect(self._show_choices)

    def _connect_records(self) -> None:
        """Connect the pages of the record, which take the place of the panels."""
        records, keeper = self._features.records, self._services.keeper
        records.page_requested.connect(self._show_page)
        records.action_requested.connect(self._run_requested)
        records.recent_file_chosen.connect(self._open_recent)
        records.person_named.connect(self._show_state)
        records.compared.connect(self._features.compare.open_visits)
        self._case.opened.connect(self._show_panels)
        self._main.help.panels_requested.connect(self._show_panels)
        keeper.failed.connect(self._services.messages.show_error)
        keeper.state_changed.connect(self._show_kept)
        keeper.erased.connect(self._tell_erased)

    def _connect_clinic(self) -> None:
        """Connect the administration of the record."""
        administration, clinic = self._features.clinic, self._services.clinic
        administration.start_requested.connect(self._features.records.show_start)
        administration.patients_hidden.connect(self._hide_patients)
        administration.lock.quit_requested.connect(self._quit_locked)
        administration.backups.reminder_changed.connect(self._features.records.show_reminder)
        self._features.records.reminder_put_off.connect(administration.backups.put_off_reminder)
        self._window.status.follow(administration.backups.jobs)
        clinic.state_changed.connect(self._show_accounts)
        clinic.state_changed.connect(self._show_recent)
        clinic.state_changed.connect(self._show_state)
        self._show_accounts()

    def _show_accounts(self) -> None:
        """Show what has to do with signing in only where the record has accounts."""
        clinic, settings = self._services.clinic, self._services.settings
        if settings.record_had_accounts is not clinic.had_accounts:
            settings.record_had_accounts = clinic.had_accounts
            self._services.save_settings()
        for key in OF_ACCOUNTS:
            self._window.actions_by_key[key].setVisible(clinic.has_accounts)
        author = clinic.author if clinic.has_accounts and clinic.is_open else None
        text = "" if author is None else tr("Signed in as {name}").format(name=author.name)
        self._window.status.show_user(text)

    def _hide_patients(self) -> None:
        """Close all windows and drop all notices that may show a patient."""
        self._close_windows(lambda dialog: dialog is self._features.clinic.lock.dialog)
        self._services.notices.drop_all()
        self._features.case_files.recovery.hide()

    def _tell_erased(self) -> None:
        """Close what may show the patient of the case that was closed; say why it was."""
        self._close_windows(lambda dialog: isinstance(dialog, RecordDialog))  # such as of erasing
        self._features.records.show_start()
        sentence = tr("The patient whose visit was open was erased; the visit was closed.")
        self._services.notices.put(ERASED, sentence, on_pages=True)

    def _close_windows(self, stays: Callable[[QDialog], bool]) -> None:
        """Close all windows of features, and all dialogs but some."""
        features = self._features
        for feature in (features.capture, features.export, features.compare, features.foot):
            feature.close()
        for dialog in QApplication.topLevelWidgets():
            if isinstance(dialog, QDialog) and dialog.isVisible() and not stays(dialog):
                dialog.reject()

    def _quit_locked(self) -> None:
        """End without a question or a picture of the case, whose copy is offered at the start."""
        self._autosave.keep_now()
        self.closed.emit()

    def _show_kept(self) -> None:
        """Say whether the open visit is in the record, or on the disk of this computer."""
        keeper = self._services.keeper
        if keeper.state in (KeepState.WAITING, KeepState.REFUSED) and not self._autosave.is_kept:
            trouble = self._autosave.trouble
            text = (
                tr("Not saved and not kept here yet") if trouble else tr("Keeping your work here…")
            )
            self._window.status.show_kept(text, translate_core_message(trouble), warns=True)
            return
        text, warns = {
            KeepState.NOTHING: ("", False),
            KeepState.SAVED: (tr("Saved in the record"), False),
            KeepState.CHANGED: (tr("Saving…"), False),
            KeepState.WAITING: (
                tr("Not saved yet: the database does not answer; your work is kept here"),
                True,
            ),
            KeepState.CONFLICT: (tr("Not saved yet: two versions, decide"), True),
            KeepState.REFUSED: (tr("Not saved in the record; your work is kept here"), True),
        }[keeper.state]
        tip = translate_core_message(keeper.trouble)
        self._window.status.show_kept(text, tip, warns=warns)

    def _show_page(self, page: QWidget) -> None:
        if self._window.page is None:
            self._services.messages.clear()  # it spoke of what the page hides
        self._window.show_page(page)
        self._services.notices.hide_of_case(True)
        self._show_state()

    def _show_panels(self) -> None:
        if self._window.page is not None:
            self._window.show_panels()
            self._services.notices.hide_of_case(False)
            self._stage.focus_view()
            self._show_state()

    def _run_of(self, key: str) -> Run:
        """Return what an action does on the page that is shown."""
        records, administration = self._features.records, self._features.clinic
        on_person: dict[str, Callable[[], None]] = {
            "undo": records.undo,
            "redo": records.redo,
            "erase_patient": lambda: administration.open_erase(records.person_on_page),
        }
        if key in on_person and self._is_on_person:
            return lambda _on: on_person[key]()
        return self._run[key]

    @property
    def _is_on_person(self) -> bool:
        page = self._window.page
        return page is not None and page is self._features.records.person

    @property
    def _is_on_person_alone(self) -> bool:
        """Whether a person's page is shown, and no visit is open."""
        return self._is_on_person and self._case.is_empty

    def _take_made(self, scanned: ScannedFoot) -> None:
        foot = self._features.foot
        if not self._features.case_files.opener.take_scan(scanned, foot.shown_stage):
            foot.note_declined(scanned)

    def _tell_handed_over(self, name: str, conflicted: bool) -> None:
        if self._services.clinic.hides_patients:  # whoever was signed in has left meanwhile
            return
        if conflicted:
            sentence = tr(
                "{name}: somebody else changed the same foot or field while the record did not "
                "answer. Theirs counts; what was changed here is kept beside it: feet under "
                "“Versions…” on the patient's page, fields in the notes of the visit."
            )
        else:
            sentence = tr("{name}: what was not saved yet is now in the record.")
        self._services.notices.put(f"handed-{name}", sentence.format(name=name), stays=True)

    def _connect_case(self) -> None:
        case = self._case
        for signal in (case.opened, case.changed, case.saved_changed, case.selection_changed):
            signal.connect(self._show_state)
        case.leaving.connect(commit_typed_text)
        case.closing.connect(self._clear_case)
        self._tool_controller.tool_changed.connect(self._show_tool)
        for signal in (self._tool_controller.tool_changed, self._case.preview_changed):
            signal.connect(self._show_undo)
        self._tool_controller.tool_changed.connect(self._services.messages.clear)
        self._autosave.failed.connect(self._services.messages.show_sentence)
        self._autosave.kept_changed.connect(self._show_kept)

    def _clear_case(self, coming: CaseRecord) -> None:
        """Take away all that hangs on the case, wherever it is shown, before another one comes."""
        features = self._features
        if features.foot.leave_case(coming):
            features.capture.forget_waiting()
        features.export.leave_case()
        features.compare.close()
        features.case_files.opener.cancel()
        features.case_files.saver.cancel()
        features.design.plantar.leave_case()
        features.design.shoe.leave_case()
        features.design.load.leave_case()
        features.design.side_by_side.forget()
        features.design.repeat.forget()
        self._stage.clear()
        self._services.notices.clear()
        self._services.messages.clear()
        self._show_choices()

    def _go_to_step(self, key: str) -> None:
        if key == "patient":
            if not self._features.records.show_patient_of_case():
                self._show_panels()
                self._stage.patient.setFocus()
            return
        self._show_panels()
        if key == "capture":
            self.run_action("capture", False)
        elif key == "foot" and (session := session_of(self._case.record)) is not None:
            self._features.foot.open_session(session, hand_over=False)
        elif key in _STEP_ACTIONS and self._case.foot is not None:
            self.run_action(_STEP_ACTIONS[key], True)

    def _close(self) -> None:
        self._tool_controller.cancel()
        self._features.close_windows()
        self._autosave.forget()
        self._main.appearance.remember_layout()
        self._window.close_for_good()
        self.closed.emit()

    def _open_recent(self, name: str) -> None:
        self._features.case_files.opener.open_path(Path(name))

    def _run_requested(self, key: str) -> None:
        self.run_action(key, False)

    def _show_recent(self) -> None:
        names = [] if self._services.clinic.hides_patients else self._services.recent.names
        self._window.show_recent(names)

    def _show_state(self) -> None:
        case, window = self._case, self._window
        on_panels = window.page is None
        self._show_whose()
        self._show_undo()
        for record in ACTIONS:
            if record.needs_foot:
                window.show_action(record.key, on_panels and case.foot is not None)
            if record.needs_both:
                window.show_action(record.key, on_panels and len(case.record.feet) == 2)
        is_file = not self._services.keeper.is_keeping and not case.is_empty
        why_not = self._services.clinic.why_not_change
        window.allow_action("add_to_record", on_panels and is_file, why_not)
        for key in OF_PERSON:
            window.show_action(key, self._is_on_person)
        for key in ("new_visit", "follow_up"):
            window.allow_action(key, self._is_on_person, why_not)
        why_not_same = self._features.records.why_not_same
        window.allow_action("new_visit_same", self._is_on_person, why_not_same)
        for key in ADDING:
            window.allow_action(key, True, self._services.clinic.why_read_only)
        for key in SCANNING:  # else the foot would be nobody's
            window.show_action(key, not self._is_on_person_alone)
        window.show_action("remove", on_panels and case.selection is not None)
        window.show_pads(on_panels and case.foot is not None)

    def _show_whose(self) -> None:
        """Show whose case is open, and how far it is; without one, whose page is shown."""
        case, steps = self._case, self._stage.steps
        is_person_alone = self._is_on_person_alone
        record = case.record
        if is_person_alone:
            record = CaseRecord(Patient(self._features.records.name_on_page))
        title = record.patient.name if is_person_alone else title_of(case)
        self._window.show_title(title, case.has_unsaved_changes)
        is_exported = case.record is self._features.export.exported
        steps.show_steps(steps_of(record, is_exported))
        steps.show_whose(whose(record))
        steps.let_choose(
            ("patient",) if is_person_alone else None, tr("Begin a visit, or open one, first.")
        )

    def _show_undo(self) -> None:
        """Offer to undo what is shown: the panels' case, or the fields of a person's page."""
        for key, sentence in zip(("undo", "redo"), self._steps, strict=True):
            verb = self._records[key].text()
            text = f"{verb}: {sentence}" if sentence else verb
            self._window.show_action(key, bool(sentence), text)

    @property
    def _steps(self) -> tuple[str, str]:
        """What undo and redo would do to what is shown; empty for what there is nothing to."""
        if self._is_on_person:
            return self._features.records.steps_on_page
        if self._window.page is not None:
            return "", ""
        history = self._case.history
        undone = self._tool_controller.tool.own_step(self._case) or history.undo_sentence
        return undone, history.redo_sentence

    def _show_choices(self) -> None:
        """Check the toggles and choices that match what is shown, however they were changed."""
        side_by_side = self._features.design.side_by_side
        self._window.check_action(f"beside_{side_by_side.counterpart.kind.value}", True)
        self._window.check_action(f"map_{side_by_side.map_kind.value}", True)

    def _show_tool(self) -> None:
        self._window.check_action(f"tool_{self._tool_controller.tool.key}", True)
