"""The feature of the clinic's record: its pages, and what leads from one to the other."""

from __future__ import annotations

from collections.abc import Callable
from datetime import date
from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtCore import QObject, Signal, Slot
from PySide6.QtWidgets import QWidget

from insole_core.cases.case_record import FootRecord
from insole_core.errors import Conflict
from insole_core.records.person import Person, PersonSummary
from insole_core.records.visit import CaptureState, Visit
from insole_studio.features.records.conflict_dialog import (
    Choice,
    ComparedVersion,
    ConflictDialog,
    chosen_foot,
)
from insole_studio.features.records.new_patient_dialog import NewPatientDialog
from insole_studio.features.records.person_page import PersonPage
from insole_studio.features.records.person_presenter import PersonPresenter
from insole_studio.features.records.record_texts import version_text
from insole_studio.features.records.start_page import StartPage
from insole_studio.features.records.start_presenter import StartPresenter
from insole_studio.services.app_services import AppServices
from insole_studio.texts import tr

if TYPE_CHECKING:
    from insole_core.records.records import Records
    from insole_studio.features.records.record_transfer import RecordTransfer

Then = Callable[[], None]
CONFLICT = "record-conflict"


class PatientRecords(QObject):
    """Start page and person page, made when they are shown first, and the dialogs on them.

    Parameters
    ----------
    leave_case
        Calls a function once the open case may be replaced by another one.
    """

    page_requested = Signal(QWidget)
    action_requested = Signal(str)
    """A button of a page asks for an action of any feature."""
    recent_file_chosen = Signal(str)

    def __init__(self, services: AppServices, leave_case: Callable[[Then], None]) -> None:
        super().__init__(services.window)
        self._services = services
        self._clinic = services.clinic
        self._keeper = services.keeper
        self._leave_case = leave_case
        self.start: StartPage | None = None
        self.person: PersonPage | None = None
        self._start_presenter: StartPresenter | None = None
        self._person_presenter: PersonPresenter | None = None
        self._transfer: RecordTransfer | None = None
        self._keeper.conflicted.connect(self.decide)
        services.recent.changed.connect(self._show_recent_files)

    def show_start(self) -> None:
        """Show the start page, its search line empty and with the focus."""
        if self.start is None:
            self._make_start()
        assert self.start is not None
        assert self._start_presenter is not None
        self.page_requested.emit(self.start)
        self.start.begin()
        self._start_presenter.refresh()

    def show_person(self, person_id: str) -> None:
        """Show a person and their visits."""
        if self.person is None:
            self._make_person()
        assert self.person is not None
        assert self._person_presenter is not None
        self.page_requested.emit(self.person)
        self._person_presenter.open(person_id)

    def show_patient_of_case(self) -> bool:
        """Show the person whose visit is open; return False for a case of a file."""
        kept = self._services.case.kept
        if kept is None:
            return False
        self.show_person(kept.person.id)
        return True

    def ask_new_patient(self) -> None:
        """Ask for the data of a new patient, add them, and show their page."""
        settings = self._services.settings
        name = "" if self.start is None else self.start.search.text().strip()
        if any(letter.isdigit() for letter in name):
            name = ""  # a date or a number was searched for
        dialog = NewPatientDialog(name, settings.number_kind, self._services.window)
        dialog.finished.connect(dialog.deleteLater)
        dialog.accepted.connect(lambda: self._add(dialog.person))
        dialog.open()

    @property
    def transfer(self) -> RecordTransfer:
        """Imports and exports; the library of the database is imported with them."""
        if self._transfer is None:
            from insole_studio.features.records.record_transfer import RecordTransfer

            self._transfer = RecordTransfer(self._services)
            self._transfer.imported.connect(self._refresh)
        return self._transfer

    def export_patient(self) -> None:
        """Export the patient on the page, or the one whose visit is open."""
        person = None if self._person_presenter is None else self._person_presenter.person
        kept = self._services.case.kept
        person = person or (None if kept is None else kept.person)
        if person is None:
            self._services.messages.say(tr("Open a patient first."))
            return
        self.transfer.export(person.id, person.name)

    def open_visit(self, visit_id: str) -> None:
        """Open a visit as the case of the window."""
        self._leave_case(
            lambda: self._keeper.open_visit(visit_id, self._services.messages.show_error)
        )

    def begin_visit(self, *, same_prescription: bool = False) -> None:
        """Add a visit of today for the person on the page, and open it."""
        person = None if self._person_presenter is None else self._person_presenter.person
        if person is None:
            return
        visit = Visit(person.id, date.today(), capture_state=CaptureState.WANTED)

        def add(records: Records) -> Visit:
            return records.visits.add(visit)

        self._clinic.write(
            add, lambda added: self.open_visit(added.id), self._services.messages.show_error
        )

    @Slot()
    def decide(self) -> None:
        """Show both versions of a foot that was changed at two stations, and keep the choice."""
        conflict = self._keeper.conflict
        if conflict is None:
            return
        mine, summary = conflict.mine, conflict.theirs

        def show(theirs: FootRecord) -> None:
            dialog = ConflictDialog(
                ComparedVersion(tr("Mine"), self._here(), mine),
                ComparedVersion(tr("Theirs"), version_text(summary), theirs),
                self._services.window,
            )
            dialog.finished.connect(dialog.deleteLater)
            dialog.rejected.connect(self._remind)
            dialog.accepted.connect(
                lambda: self._settle(conflict, dialog.choice, theirs, summary.author)
            )
            dialog.open()

        self._clinic.ask(
            "records-conflict",
            lambda records: records.prescriptions.read(summary.id),
            show,
            self._services.messages.show_error,
        )

    def _settle(
        self, conflict: Conflict, choice: Choice | None, theirs: FootRecord, author: str
    ) -> None:
        assert choice is not None
        self._services.notices.drop(CONFLICT)
        self._keeper.settle(conflict, chosen_foot(choice, conflict.mine, theirs, author))

    def _remind(self) -> None:
        self._services.notices.put(
            CONFLICT,
            tr("Two versions of this foot wait for a decision; yours is kept on this computer."),
            (tr("Decide…"), self.decide),
        )

    def _here(self) -> str:
        who = self._clinic.author
        return "" if who is None else f"{who.name}, {who.station}"

    def undo(self) -> None:
        """Undo the last edit on the person page."""
        if self._person_presenter is not None:
            self._person_presenter.undo()

    def redo(self) -> None:
        """Redo the edit undone last on the person page."""
        if self._person_presenter is not None:
            self._person_presenter.redo()

    def renew_icons(self) -> None:
        """Redraw the icons in the colours of the palette."""
        if self.start is not None:
            self.start.renew_icons()

    def _refresh(self) -> None:
        if self._start_presenter is not None:
            self._start_presenter.refresh()

    def _make_start(self) -> None:
        self.start = page = StartPage()
        self._start_presenter = StartPresenter(page, self._clinic)
        page.person_chosen.connect(self.show_person)
        page.visit_chosen.connect(self.open_visit)
        page.action_requested.connect(self.action_requested)
        page.recent_file_chosen.connect(self.recent_file_chosen)
        self._show_recent_files()

    def _make_person(self) -> None:
        self.person = page = PersonPage()
        self._person_presenter = PersonPresenter(
            page, self._clinic, self._services.messages.show_error
        )
        page.action_requested.connect(self.action_requested)
        page.visit_action_requested.connect(self._run_on_visit)

    def _run_on_visit(self, key: str, visit_id: str) -> None:
        if key == "open":
            self.open_visit(visit_id)

    def _show_recent_files(self) -> None:
        if self.start is not None:
            names = self._services.recent.names
            self.start.show_recent_files([(name, Path(name).name) for name in names])

    def _add(self, person: Person | None) -> None:
        """Add a person, unless there is one of the same number: then the user decides."""
        assert person is not None
        settings = self._services.settings
        settings.number_kind = person.number_kind or settings.number_kind

        def add(records: Records) -> Person | PersonSummary:
            if person.personal_number:
                known = records.persons.with_number(person.personal_number)
                if known:
                    return known[0]
            return records.persons.add(person)

        def added(found: Person | PersonSummary) -> None:
            if isinstance(found, PersonSummary):
                self._services.messages.say(
                    tr("{name} has this personal number already.").format(name=found.name)
                )
            self.show_person(found.id)

        self._clinic.write(add, added, self._services.messages.show_error)
