"""The feature of the clinic's record: its pages, and what leads from one to the other."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from datetime import date
from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtCore import QObject, Signal, Slot
from PySide6.QtWidgets import QWidget
from shiboken6 import isValid

from insole_core.cases.case_record import CaseRecord, FootRecord
from insole_core.errors import Conflict
from insole_core.geometry.side import Side
from insole_core.insole.prescription.design_differences import design_differences
from insole_core.insole.prescription.template import Template
from insole_core.messages import Message
from insole_core.records.person import Person, PersonSummary
from insole_core.records.prescription import VersionSummary
from insole_core.records.record_field import FieldChoice, merge_fields, settle_fields, typed_fields
from insole_core.records.visit import CaptureState, FollowUp, Visit, fields_of_patient
from insole_core.visible_text import visible_line
from insole_core.workflows.starting_design import starting_device
from insole_studio.document.case_names import case_name
from insole_studio.document.clinic_record import RecordState
from insole_studio.document.record_keeper import KeepState, PatientConflict
from insole_studio.features.records.earlier_visit import (
    EarlierScan,
    SamePrescription,
    last_prescriptions,
)
from insole_studio.features.records.nest_actions import NestActions
from insole_studio.features.records.order_actions import OrderActions
from insole_studio.features.records.order_files import OrderFiles
from insole_studio.features.records.orders_page import OrdersPage
from insole_studio.features.records.orders_presenter import OrdersPresenter
from insole_studio.features.records.patient_dialogs import ChoosePersonDialog, NewPatientDialog
from insole_studio.features.records.person_page import PersonPage
from insole_studio.features.records.person_presenter import PersonPresenter
from insole_studio.features.records.record_dialogs import FollowUpDialog, VisitDialog
from insole_studio.features.records.rows import version_text
from insole_studio.features.records.sample_patient import SamplePatient
from insole_studio.features.records.start_page import StartPage
from insole_studio.features.records.start_presenter import MOST_FOUND, StartPresenter
from insole_studio.features.records.version_dialogs import (
    Choice,
    CollidedField,
    ComparedVersion,
    ConflictDialog,
    FieldConflictDialog,
    HistoryDialog,
    chosen_foot,
    collided_fields,
)
from insole_studio.features.records.visit_captures import VisitCaptures
from insole_studio.features.records.visit_photos import VisitPhotos
from insole_studio.features.records.visit_presence import VisitPresence
from insole_studio.services.app_services import AppServices
from insole_studio.services.person_list import identified, person_rows, visit_time_text
from insole_studio.services.questions import Namesake
from insole_studio.texts import tr

if TYPE_CHECKING:
    from insole_core.records.order import Order
    from insole_core.records.records import Records
    from insole_studio.features.records.record_transfer import RecordTransfer

Then = Callable[[], None]
CONFLICT, LOST, OUTDATED = "record-conflict", "record-lost", "record-outdated"


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
    reminder_put_off = Signal()
    person_named = Signal()
    """The person page shows its person anew, such as under another name or after an edit."""
    compared = Signal(object, object)
    """Emitted with two visits to compare, the newer one first: name and case of each."""

    def __init__(self, services: AppServices, leave_case: Callable[[Then], None]) -> None:
        super().__init__(services.window)
        self._services = services
        self._clinic = services.clinic
        self._keeper = services.keeper
        self._leave_case = leave_case
        self.start: StartPage | None = None
        self._reminder = ""
        self.person: PersonPage | None = None
        self.orders: OrdersPage | None = None
        self._is_adding_visit = False
        self._start_presenter: StartPresenter | None = None
        self._orders_presenter: OrdersPresenter | None = None
        self._same_prescription = SamePrescription(services)
        self._earlier_scan = EarlierScan(services, self._same_prescription)
        self.captures = VisitCaptures(services)
        self._presence = VisitPresence(services)
        self.order_actions = OrderActions(services)
        self._visit_to_export = ""
        """Of the order that is being revised, until it is open."""
        services.case.opened.connect(self._export_opened)
        self.nest_actions = NestActions(services)
        self.order_files = OrderFiles(services)
        self.photos = VisitPhotos(services)
        self.sample = SamplePatient(services, leave_case, self.show_person, self.show_start)
        self._tell = services.messages.show_error
        self._person_presenter: PersonPresenter | None = None
        self._transfer: RecordTransfer | None = None
        self._keeper.conflicted.connect(self.decide)
        self._keeper.outdated.connect(self._offer_newer)
        services.case.opened.connect(self._forget_outdated)
        self._keeper.lost.connect(self._offer_lost)
        self._keeper.state_changed.connect(self._drop_lost)
        self._keeper.state_changed.connect(self._drop_outdated)
        services.recent.changed.connect(self._show_recent_files)
        self._clinic.state_changed.connect(self._show_recent_files)
        self._clinic.state_changed.connect(self._let_add_again)

    def close(self) -> None:
        """Leave the open visit to other stations."""
        self._presence.close()
        self.order_files.close()
        self.order_actions.close()
        self.photos.close()

    def show_start(self) -> None:
        """Show the start page, its search line empty and with the focus."""
        if self.start is None:
            self._make_start()
        assert self.start is not None
        assert self._start_presenter is not None
        self.page_requested.emit(self.start)
        self.start.begin()
        self._start_presenter.refresh()

    def show_reminder(self, sentence: str) -> None:
        """Show a quiet sentence on the start page; an empty one hides it."""
        self._reminder = sentence
        if self.start is not None:
            self.start.show_reminder(sentence)

    def show_person(self, person_id: str) -> None:
        """Show a person and their visits; whoever else's case is open is left first.

        So the window never shows one patient while its steps and actions work on another one.
        """
        case = self._services.case
        kept = case.kept
        is_theirs = kept is not None and kept.person.id == person_id
        if is_theirs or (case.is_empty and case.path is None):
            self._show_page_of(person_id)
        else:
            self._leave_case(lambda: self._close_case_for(person_id))

    def _close_case_for(self, person_id: str) -> None:
        name, kept = case_name(self._services.case), self._services.case.kept
        self._services.case.open(CaseRecord(), None)
        self._show_page_of(person_id)
        if kept is not None:
            self._services.messages.say(tr("{name}: saved and closed.").format(name=name))

    def _show_page_of(self, person_id: str) -> None:
        if self.person is None:
            self._make_person()
        assert self.person is not None
        assert self._person_presenter is not None
        self._person_presenter.open(person_id)
        self.page_requested.emit(self.person)

    def show_patient_of_case(self) -> bool:
        """Show the person whose visit is open; return False for a case of a file."""
        kept = self._services.case.kept
        if kept is None:
            return False
        self.show_person(kept.person.id)
        return True

    def ask_new_patient(self) -> None:
        """Ask for the data of a new patient, add them, and show their page."""
        start = self.start
        is_sought = start is not None and start.isVisible() and not start.found.rows
        name = start.search.text().strip() if start is not None and is_sought else ""
        if any(letter.isdigit() for letter in name):
            name = ""  # a date or a number was searched for
        self._ask_new_patient(Person(name))

    def _ask_new_patient(self, begun: Person) -> NewPatientDialog | None:
        """Show the form of a new patient, unless nobody may see one meanwhile."""
        if self._clinic.hides_patients:
            return None
        number_kind = self._services.settings.number_kind
        dialog = NewPatientDialog(begun, number_kind, self._services.window)
        dialog.finished.connect(dialog.deleteLater)
        dialog.accepted.connect(lambda: self._add(dialog.person))
        dialog.open()
        return dialog

    @property
    def transfer(self) -> RecordTransfer:
        """Imports and exports; the library of the database is imported with them."""
        if self._transfer is None:
            from insole_studio.features.records.record_transfer import RecordTransfer

            self._transfer = RecordTransfer(self._services)
            self._transfer.imported.connect(self._refresh)
        return self._transfer

    def export_patient(self) -> None:
        """Export the patient whose page is shown, or else the one whose visit is open."""
        is_on_page = self.person is not None and self.person.isVisible()
        kept = self._services.case.kept
        person = None if kept is None else kept.person
        person = self.person_on_page if is_on_page else person
        if person is None:
            self._services.messages.say(tr("Open a patient first."))
            return
        self.transfer.export(person.id, person.name)

    def open_visit(self, visit_id: str, *, then_export: bool = False) -> None:
        """Open a visit as the case of the window, and perhaps what exports it."""
        self._visit_to_export = visit_id if then_export else ""
        self._leave_case(lambda: self._keeper.open_visit(visit_id, self._tell))

    def begin_visit(self, *, same_prescription: bool = False) -> None:
        """Add a visit of today for the person on the page, and open it.

        Parameters
        ----------
        same_prescription
            Whether a new scan gets the last prescription at once; otherwise it is offered.
        """
        person = self.person_on_page
        if person is None:
            self.show_start()
            return
        visit = Visit(person.id, date.today(), capture_state=CaptureState.WANTED)
        self._leave_case(lambda: self._add_visit(visit, same_prescription))

    def _add_visit(self, visit: Visit, same_prescription: bool) -> None:
        """Add a visit and open it, once the case before it has been left.

        A key that is held, or pressed again before the visit is open, adds no other one.
        """
        if self._is_adding_visit:
            return
        self._is_adding_visit = True

        folder = self._services.paths.settings_folder

        def add(records: Records) -> dict[Side, Template]:
            templates = last_prescriptions(records, visit.person_id, starting_device(folder))
            records.visits.add(visit)
            return templates

        def added(templates: dict[Side, Template]) -> None:
            self._is_adding_visit = False
            self._same_prescription.expect(visit.id, templates, applied=same_prescription)
            self._keeper.open_visit(visit.id, self._tell)

        def failed(error: Exception) -> None:
            self._is_adding_visit = False
            self._tell(error)

        self._clinic.write(add, added, failed)

    def _let_add_again(self) -> None:
        """Let a visit be added where the record was closed before it could answer."""
        if self._clinic.state is RecordState.CLOSED:
            self._is_adding_visit = False

    def _delete_visit(self, visit_id: str) -> None:
        """Delete a visit of the person on the page if it is empty, or say why it is kept.

        The record knows who has it open at other stations, and nothing of other windows here.
        """
        person = self.person_on_page
        shown = (
            None if self._person_presenter is None else self._person_presenter.visit_of(visit_id)
        )
        if person is None or shown is None:
            return
        if self._presence.is_in_another_window(visit_id):
            sentence = tr(
                "The visit is open in another window of this computer; close it there before it is "
                "deleted."
            )
            self._services.messages.show_sentence(sentence)
            return
        day = shown.visit.visited_on.isoformat()

        def deleted(_none: None) -> None:
            sentence = tr("The empty visit of {day} is deleted.")
            self._services.messages.say(sentence.format(day=day))

        def delete() -> None:
            self._clinic.write(lambda r: r.visits.delete(visit_id), deleted, self._tell)

        def close_and_delete() -> None:
            self._close_case_for(person.id)
            delete()

        if self._keeper.visit_id == visit_id:
            self._leave_case(close_and_delete)
        else:
            delete()

    def show_orders(self, *, of_person: bool = False) -> None:
        """Show the orders of the clinic, or of the person on the page."""
        if self.orders is None:
            self.orders = OrdersPage()
            self._orders_presenter = OrdersPresenter(
                self.orders, self._clinic, self.order_actions, self.nest_actions, self._tell
            )
            self.orders.patients_requested.connect(self.show_start)
            self.orders.order_chosen.connect(self._open_order)
            self.orders.edit_requested.connect(self.order_actions.ask)
            self.orders.revise_requested.connect(self._revise_order)
            self.orders.papers_requested.connect(self.order_files.open_papers)
            self.orders.folder_requested.connect(self.order_files.open_folder)
        assert self._orders_presenter is not None
        self.page_requested.emit(self.orders)
        self._orders_presenter.show(self.person_on_page if of_person else None)

    def show_photos(self) -> None:
        """Show the photos of the open visit."""
        if self._keeper.visit_id:
            self.photos.open(self._keeper.visit_id)
        else:
            self._services.messages.say(tr("Open a visit first."))

    def add_case(self) -> None:
        """Ask whose the open case of a file is, and make a visit of it."""
        case = self._services.case.record
        dialog = ChoosePersonDialog(case.patient.name, self._services.window)
        dialog.finished.connect(dialog.deleteLater)
        dialog.accepted.connect(
            lambda: self._add_case(self._services.case.record, dialog.person_id)
        )

        def show(found: list[PersonSummary]) -> None:
            if isValid(dialog):
                dialog.show_found(person_rows(found))

        def search(typed: str) -> None:
            self._clinic.ask(
                "records-choose",
                lambda records: records.persons.search(typed, MOST_FOUND),
                show,
                self._tell,
            )

        dialog.search_edited.connect(search)
        dialog.open()
        search(case.patient.name)

    def _add_case(self, case: CaseRecord, person_id: str, *, is_another: bool = False) -> None:
        """Make a visit of a case; of a namesake of a new patient the user decides."""

        def add(records: Records) -> Visit | PersonSummary:
            from insole_core.workflows.records.keep_case import add_case, new_person

            if not person_id and not is_another:
                person = new_person(case.patient)
                known = records.persons.namesakes(person.name, person.birth_date)
                if known:
                    return known[0]
            return add_case(records, case, person_id)

        def added(found: Visit | PersonSummary) -> None:
            if isinstance(found, Visit):
                self._keeper.open_visit(found.id, self._tell)
                return
            self._ask_namesake(
                found,
                (tr("Add to this patient"), lambda: self._add_case(case, found.id)),
                (tr("Add as a new patient"), lambda: self._add_case(case, "", is_another=True)),
            )

        self._clinic.write(add, added, self._tell)

    def ask_follow_up(self) -> None:
        """Show what became of the insoles of the person on the page, and ask for more."""
        person = self.person_on_page
        if person is None:
            return

        def show(before: Sequence[FollowUp]) -> None:
            self._show_follow_ups(before, FollowUp(person.id, date.today(), ""))

        self._clinic.ask(
            "records-follow-ups", lambda r: r.follow_ups.of_person(person.id), show, self._tell
        )

    def _show_follow_ups(
        self, before: Sequence[FollowUp], begun: FollowUp
    ) -> FollowUpDialog | None:
        """Show follow-ups and the form of another one, unless nobody may see them meanwhile."""
        if self._clinic.hides_patients:
            return None
        dialog = FollowUpDialog(begun, before, self._services.window)
        dialog.finished.connect(dialog.deleteLater)
        dialog.accepted.connect(lambda: self._add_follow_up(before, dialog.follow_up()))
        dialog.open()
        return dialog

    @property
    def name_on_page(self) -> str:
        """The name of the person on the page; empty for none, and until it is read."""
        return "" if self.person_on_page is None else self.person_on_page.name

    @property
    def person_on_page(self) -> Person | None:
        """The person on the page; None for none, and until it is read."""
        return None if self._person_presenter is None else self._person_presenter.person

    @property
    def why_not_same(self) -> str:
        """Why no new visit of the person on the page can take the last prescription."""
        return "" if self._person_presenter is None else self._person_presenter.why_not_same

    def _add_follow_up(self, before: Sequence[FollowUp], follow_up: FollowUp) -> None:
        def failed(error: Exception) -> None:
            self._tell(error, self._show_follow_ups(before, follow_up))

        self._clinic.write(lambda r: r.follow_ups.add(follow_up), _nothing, failed)

    def _open_order(self, order_id: str) -> None:
        """Open the visit of an order, on whichever page it is listed."""
        self._clinic.ask(
            "records-order",
            lambda records: records.orders.get(order_id).visit_id,
            self.open_visit,
            self._tell,
        )

    def _revise_order(self, order_id: str) -> None:
        """Open the visit of an order, and the window that exports its next revision."""

        def read(records: Records) -> tuple[Order, str]:
            order = records.orders.get(order_id)
            return order, records.orders.note_of(order.visit_id).number

        def revise(found: tuple[Order, str]) -> None:
            order, revised = found
            if order.number == revised:
                self.open_visit(order.visit_id, then_export=True)
                return
            sentence = tr(
                "Order {number} was cancelled, or is not the last one of its visit, and gets no "
                "revision; open the visit and export a new order."
            )
            self._services.messages.show_sentence(sentence.format(number=order.number))

        self._clinic.ask("records-order", read, revise, self._tell)

    def _export_opened(self) -> None:
        """Show the window that exports, once the visit that it was asked for is open."""
        if self._visit_to_export and self._keeper.visit_id == self._visit_to_export:
            self.action_requested.emit("export")
        self._visit_to_export = ""

    def _edit_visit(self, visit_id: str) -> None:
        assert self._person_presenter is not None
        shown = self._person_presenter.visit_of(visit_id)
        if shown is not None:
            self._ask_visit(shown.visit, shown.visit)

    def _ask_visit(self, before: Visit, typed: Visit) -> VisitDialog | None:
        """Show the form of a visit with what was typed, unless nobody may see it meanwhile."""
        if self._clinic.hides_patients:
            return None
        dialog = VisitDialog(typed, self._services.window)
        dialog.finished.connect(dialog.deleteLater)
        dialog.accepted.connect(lambda: self._change_visit(before, dialog.value))
        dialog.open()
        return dialog

    def _change_visit(self, before: Visit, visit: Visit) -> None:
        """Store the fields of a visit that were changed, over what others have changed meanwhile.

        What was typed is shown again where the record does not take it.

        Parameters
        ----------
        before
            The visit that the change is based on.
        """

        def failed(error: Exception) -> None:
            if isinstance(error, Conflict):
                self._change_over(before, visit, error.theirs)
            else:
                self._tell(error, self._ask_visit(before, visit))

        self._clinic.write(
            lambda records: records.visits.change(visit, visit.revision), _nothing, failed
        )

    def _change_over(self, before: Visit, mine: Visit, theirs: Visit) -> None:
        typed = typed_fields(Visit)
        merged, collided = merge_fields(before, mine, theirs, (*typed, "capture_state"))
        fields = collided_fields(mine, theirs, [n for n in collided if n in typed], typed)

        def store(choices: Mapping[str, FieldChoice]) -> None:
            self._change_visit(theirs, settle_fields(merged, mine, choices))

        if fields:
            self._ask_fields(fields, store)
        else:
            store({})

    def _ask_fields(
        self, fields: Sequence[CollidedField], done: Callable[[Mapping[str, FieldChoice]], None]
    ) -> None:
        """Show both values of each field, and call a function with what was chosen."""
        dialog = FieldConflictDialog(fields, self._services.window)
        dialog.finished.connect(lambda: done(dialog.choices))
        dialog.finished.connect(dialog.deleteLater)
        dialog.open()

    def _show_versions(self, visit_id: str) -> None:
        def read(records: Records) -> list[VersionSummary]:
            return [v for side in Side for v in records.prescriptions.versions(visit_id, side)]

        self._clinic.ask("records-versions", read, self._show_history, self._tell)

    def _show_history(self, versions: list[VersionSummary]) -> None:
        dialog = HistoryDialog(tr("Versions"), versions, self._services.window)
        dialog.finished.connect(dialog.deleteLater)
        dialog.version_chosen.connect(
            lambda version_id: self._show_changes(dialog, versions, version_id)
        )
        dialog.sign_requested.connect(self._sign)
        dialog.open()
        self._show_changes(dialog, versions, dialog.table.current_key)

    def _show_changes(
        self, dialog: HistoryDialog, versions: list[VersionSummary], version_id: str
    ) -> None:
        """Say below the versions what the chosen one changed in the one before it."""
        version = next(version for version in versions if version.id == version_id)
        before = next(
            (v for v in versions if v.side is version.side and v.number == version.number - 1), None
        )
        if before is None:
            dialog.show_changes(version_id, [tr("The first version of this foot.")])
            return

        def read(records: Records) -> tuple[Message, ...]:
            old = records.prescriptions.read(before.id)
            return design_differences(old.design, records.prescriptions.read(version_id).design)

        def show(lines: tuple[Message, ...]) -> None:
            if isValid(dialog):
                dialog.show_changes(version_id, lines or [tr("No difference that can be seen")])

        self._clinic.ask("records-changes-of-version", read, show, self._tell)

    def _sign(self, version_id: str) -> None:
        self._clinic.write(
            lambda records: records.prescriptions.sign(version_id), _nothing, self._tell
        )

    def _compare(self, newer_id: str, older_id: str) -> None:
        def read(records: Records) -> list[tuple[str, CaseRecord]]:
            opened = [records.visits.open_case(visit_id) for visit_id in (newer_id, older_id)]
            return [(visit_time_text(found.visit), found.record) for found in opened]

        self._clinic.ask(
            "records-compare", read, lambda found: self.compared.emit(*found), self._tell
        )

    @Slot()
    def decide(self) -> None:
        """Show both versions of what was changed at two stations, and keep the choice."""
        if self._keeper.patient_conflict is not None:
            self._decide_fields(self._keeper.patient_conflict)
            return
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
            self._tell,
        )

    def _decide_fields(self, conflict: PatientConflict) -> None:
        def settle(choices: Mapping[str, FieldChoice]) -> None:
            if self._keeper.patient_conflict is conflict:
                chosen = settle_fields(conflict.theirs, conflict.mine, choices)
                self._keeper.settle_patient(chosen)

        mine, theirs, collided = conflict.mine, conflict.theirs, conflict.collided
        self._ask_fields(collided_fields(mine, theirs, collided, fields_of_patient()), settle)

    def _settle(
        self, conflict: Conflict, choice: Choice | None, theirs: FootRecord, author: str
    ) -> None:
        assert choice is not None
        self._services.notices.drop(CONFLICT)
        self._keeper.settle(conflict, chosen_foot(choice, conflict.mine, theirs, author))

    def _remind(self) -> None:
        if self._keeper.conflict is None:  # the case was closed as its patient was erased
            return
        self._services.notices.put(
            CONFLICT,
            tr("Two versions of this foot wait for a decision; yours is kept on this computer."),
            (tr("Decide…"), self.decide),
            on_pages=True,
        )

    def _offer_newer(self) -> None:
        """Offer what somebody else has stored since the visit was opened here."""
        self._services.notices.put(
            OUTDATED,
            tr("This prescription was changed elsewhere: a newer version than this is stored."),
            (tr("Open the newer version"), lambda: self._keeper.open_newer(self._tell)),
        )

    def _offer_lost(self) -> None:
        """Offer what becomes of the work on a visit that was deleted elsewhere."""
        self._services.notices.put(
            LOST,
            tr("This visit was deleted elsewhere; what you have made is kept on this computer."),
            (tr("Keep as a new visit"), self._keeper.keep_as_new_visit),
            (tr("Save as a file…"), lambda: self.action_requested.emit("save_as")),
            on_pages=True,
        )

    def _drop_lost(self) -> None:
        if self._keeper.state in (KeepState.SAVED, KeepState.NOTHING):
            self._services.notices.drop(LOST)

    def _forget_outdated(self) -> None:
        self._services.notices.drop(OUTDATED)

    def _drop_outdated(self) -> None:
        """Drop it for a case that became one of a file, and where a decision takes its place."""
        if self._keeper.state is KeepState.NOTHING or self._keeper.conflict is not None:
            self._services.notices.drop(OUTDATED)

    def _here(self) -> str:
        who = self._clinic.author
        return "" if who is None else f"{who.name}, {who.station}"

    @property
    def steps_on_page(self) -> tuple[str, str]:
        """What undo and redo would do on the person page; empty for what there is nothing to."""
        presenter = self._person_presenter
        return ("", "") if presenter is None else (presenter.undo_sentence, presenter.redo_sentence)

    def undo(self) -> None:
        """Undo the last edit on the person page."""
        if self._person_presenter is not None:
            self._person_presenter.undo()

    def redo(self) -> None:
        """Redo the edit undone last on the person page."""
        if self._person_presenter is not None:
            self._person_presenter.redo()

    def _refresh(self) -> None:
        if self._start_presenter is not None:
            self._start_presenter.refresh()

    def _make_start(self) -> None:
        self.start = page = StartPage()
        self._start_presenter = StartPresenter(page, self._clinic)
        page.person_chosen.connect(self.show_person)
        page.visit_chosen.connect(self.open_visit)
        page.order_chosen.connect(self._open_order)
        page.action_requested.connect(self.action_requested)
        page.recent_file_chosen.connect(self.recent_file_chosen)
        page.reminder_put_off.connect(self.reminder_put_off)
        page.show_reminder(self._reminder)
        self._show_recent_files()

    def _make_person(self) -> None:
        self.person = page = PersonPage()
        folder = self._services.paths.settings_folder
        self._person_presenter = PersonPresenter(
            page, self._clinic, self._tell, self._ask_fields, folder
        )
        page.action_requested.connect(self.action_requested)
        page.visit_action_requested.connect(self._run_on_visit)
        page.compare_requested.connect(self._compare)
        page.named.connect(self.person_named)

    def _run_on_visit(self, key: str, visit_id: str) -> None:
        run = {
            "open": self.open_visit,
            "edit": self._edit_visit,
            "photos": self.photos.open,
            "versions": self._show_versions,
            "delete": self._delete_visit,
        }[key]
        run(visit_id)

    def _show_recent_files(self) -> None:
        if self.start is not None:
            names = [] if self._clinic.hides_patients else self._services.recent.names
            self.start.show_recent_files([(name, visible_line(Path(name).name)) for name in names])

    def _add(self, person: Person | None, *, is_another: bool = False) -> None:
        """Add a person, unless there is one of the same number; of a namesake the user decides.

        What was typed is shown again where nobody is added after all.

        Parameters
        ----------
        is_another
            Whether it is known that they are not the namesake who is there.
        """
        assert person is not None
        number = person.personal_number
        settings = self._services.settings
        settings.number_kind = person.number_kind or settings.number_kind

        def add(records: Records) -> Person | PersonSummary:
            known = records.persons.with_number(number) if number else []
            if not known and not is_another:
                known = records.persons.namesakes(person.name, person.birth_date)
            return known[0] if known else records.persons.add(person)

        def added(found: Person | PersonSummary) -> None:
            has_number = number != "" and found.personal_number == number
            if isinstance(found, PersonSummary) and not has_number:
                self._ask_namesake(
                    found,
                    (tr("Open this patient"), lambda: self.show_person(found.id)),
                    (tr("Add another patient"), lambda: self._add(person, is_another=True)),
                    lambda: self._ask_new_patient(person),
                )
                return
            self.show_person(found.id)
            if isinstance(found, PersonSummary):
                self._services.messages.say(
                    tr("{name} has this personal number already.").format(name=found.name)
                )

        def failed(error: Exception) -> None:
            self._tell(error, self._ask_new_patient(person))

        self._clinic.write(add, added, failed)

    def _ask_namesake(
        self,
        known: PersonSummary,
        same: tuple[str, Then],
        another: tuple[str, Then],
        neither: Callable[[], object] = lambda: None,
    ) -> None:
        """Ask whether a new patient is somebody who is there, and do what is answered.

        Parameters
        ----------
        same, another
            Verb of the button, and what it does.
        neither
            Called where nobody is to be added.
        """
        questions = self._services.messages.questions
        answer = questions.about_namesake(identified(known), same[0], another[0])
        if answer is Namesake.SAME:
            same[1]()
        elif answer is Namesake.ANOTHER:
            another[1]()
        else:
            neither()


def _nothing(_answer: object) -> None:
    """Do nothing with an answer: the pages show what has changed by themselves."""
