"""Keeps the open case in the clinic's record: nothing has to be saved."""

from __future__ import annotations

import logging
from collections.abc import Callable
from dataclasses import dataclass, replace
from enum import Enum, auto
from typing import TYPE_CHECKING

from PySide6.QtCore import QObject, QTimer, Signal

from insole_core.cases.case_record import CaseRecord, FootRecord, Patient
from insole_core.errors import Conflict, InsoleError, PersonErased, RecordsError, Unreachable
from insole_core.geometry.side import Side
from insole_core.records.person import Person, new_id
from insole_core.workflows.foot_landmarks import with_landmarks
from insole_studio.document.autosave import Autosave
from insole_studio.document.case import Case
from insole_studio.document.clinic_record import ClinicRecord, RecordState
from insole_studio.document.kept_visit import KeptVisit, UnkeptVisit
from insole_studio.texts import tr

if TYPE_CHECKING:
    from insole_core.records.prescription import Base
    from insole_core.records.records import Records
    from insole_core.records.visit import OpenedCase, Visit
    from insole_core.workflows.records.keep_case import KeptChange

log = logging.getLogger(__name__)

SAVE_AFTER_MS, RETRY_MS = 1000, 3000
_WHOSE, _NEWEST, _ASKED = "record-whose-case", "record-newest", "record-newest-asked"
Then = Callable[[], None]
_Stored = dict[Side, tuple[str, int]]
"""Id and revision of the newest version of each foot."""


class KeepState(Enum):
    """Whether what is open is in the record."""

    NOTHING = auto()
    """The open case is not one of the record."""
    SAVED = auto()
    CHANGED = auto()
    """It has changed, and will be saved in a moment."""
    WAITING = auto()
    """The database does not answer; the copy on this computer holds the work meanwhile."""
    CONFLICT = auto()
    """Somebody else has changed the same foot or field; the user decides."""
    REFUSED = auto()
    """The record does not take it as it is."""


@dataclass(frozen=True)
class PatientConflict:
    """Fields of the patient that were changed here and at another station.

    Parameters
    ----------
    collided
        Their names.
    """

    mine: Patient
    theirs: Patient
    collided: tuple[str, ...]


class RecordKeeper(QObject):
    """Saves the open visit a moment after each change, however many follow, and before it is left.

    The autosaved copy on the disk (`Autosave`) is the journal: it holds what the record does not
    hold yet, with the versions that it is based on.
    """

    state_changed = Signal()
    conflicted = Signal()
    """There is a `patient_conflict` or a `conflict`; `settle_patient` and `settle` end them."""
    failed = Signal(object)
    """Emitted with an error that the user has to know of."""
    lost = Signal()
    """The visit is in the record no more, as one that was deleted at another station; its work
    stays here until it is kept as another one (`keep_as_new_visit`), or saved as a file."""
    moved = Signal(str, str)
    """The open visit is kept as another one in place of one that is lost: emitted with the id that
    it had and the one that it has, so that all that was meant for the lost one comes to this."""
    outdated = Signal()
    """Somebody else has stored a newer version of a foot that is as it was stored here."""
    erased = Signal()
    """The patient was erased, here or at another station, and the case closed: nothing stays."""

    def __init__(
        self,
        case: Case,
        clinic: ClinicRecord,
        autosave: Autosave,
        parent: QObject | None = None,
    ) -> None:
        """Begin to keep what is opened.

        Parameters
        ----------
        autosave
            Writes the journal of the open case.
        """
        super().__init__(parent)
        self._case = case
        self._clinic = clinic
        self._autosave = autosave
        self._is_saving = False
        self._conflict: Conflict | None = None
        self._patient_conflict: PatientConflict | None = None
        self._then: Then | None = None
        self._otherwise: Then | None = None
        self._to_export: tuple[Then, Then] | None = None
        """What `when_newest` was given, until the case is saved."""
        self._reason = ""
        self._is_to_move = False
        """Whether it is to be kept as a new visit once what is being saved is refused."""
        self._told = ""
        """The last refusal that the user was told: each change after it would tell it again."""
        self._told_newer: dict[Side, str] = {}
        """The newest versions when `outdated` was emitted last."""
        self.state = KeepState.NOTHING
        self.trouble = ""
        """Why the case is not in the record yet; empty if it is, or about to be."""
        self._timer = QTimer(self)
        self._timer.setSingleShot(True)
        self._timer.timeout.connect(self._save)
        case.opened.connect(self._begin)
        case.changed.connect(self._note_change)
        case.saved_changed.connect(self._let_go)
        clinic.state_changed.connect(self._save_if_back)
        clinic.changed.connect(self._look_whose)
        clinic.changed.connect(self._look_for_newer)
        clinic.author_changed.connect(self._note_seen)

    @property
    def is_keeping(self) -> bool:
        """Whether the open case is a visit of the record."""
        return self._case.kept is not None

    @property
    def visit_id(self) -> str:
        """The visit that is open; empty for a case of a file."""
        return "" if self._case.kept is None else self._case.kept.visit.id

    @property
    def _has_to_save(self) -> bool:
        return self._case.has_unsaved_changes or self._is_saving

    def open_visit(self, visit_id: str, failed: Callable[[Exception], None]) -> None:
        """Open a visit as the case of the window, after the case before has been left.

        What was changed in that one while the record was read is saved, or decided on, first.
        """
        left = self._case.record

        def opened(found: OpenedCase) -> None:
            self._case.leaving.emit()  # what is being typed is a change, too
            if self.is_keeping and not self._case.record.holds_the_same(left):
                self.leave(lambda: self.open_visit(visit_id, failed))
                return
            kept = KeptVisit(found.person, found.visit, dict(found.bases))
            self._case.open(found.record, None, kept=kept)

        def read(records: Records) -> OpenedCase:
            found = records.visits.open_case(visit_id)
            with_landmarks(found.record)
            return found

        self._clinic.ask("records-open", read, opened, failed)

    def open_newer(self, failed: Callable[[Exception], None]) -> None:
        """Open the visit as it is stored by now; what was changed here is decided on before."""
        visit_id = self.visit_id
        self.leave(lambda: self.open_visit(visit_id, failed))

    def when_newest(self, then: Then, outdated: Then) -> None:
        """Call `then`, or `outdated` where the record holds a newer version of a foot that is open.

        What is not stored yet is saved before. Where that meets a conflict, it is decided on, and
        neither is called; a record that is silent or takes nothing keeps nobody from going on.
        """
        kept = self._case.kept
        if self.state is KeepState.CONFLICT:
            self.conflicted.emit()
            return
        if kept is None or not self._clinic.is_open:
            then()
            return
        if self._has_to_save:
            self._to_export = (then, outdated)
            self._save()
            return

        def found(stored: _Stored | None) -> None:
            now = self._case.kept
            if now is None or now.visit.id != kept.visit.id:
                return
            if now.bases != kept.bases or self._has_to_save:
                self.when_newest(then, outdated)
            elif stored is None:
                self._told = ""  # whoever exports is told again
                self._refuse_unless_erased(kept, _lost())
            else:
                (outdated if _is_newer(stored, now) else then)()

        def failed(error: Exception) -> None:
            _note_failure(error)
            found({side: _version_of(base) for side, base in kept.bases.items()})

        self._clinic.ask(_ASKED, lambda records: _stored(records, kept), found, failed)

    def leave(self, then: Then, otherwise: Then | None = None) -> None:
        """Save what is not in the record yet, and call `then`; at once if nothing is left to do.

        While the database does not answer, the work stays in the journal and `then` is called too.

        Parameters
        ----------
        otherwise
            Called where the visit cannot be left: the user has to decide, or the record or the disk
            takes nothing.
        """
        if self.state is KeepState.CONFLICT:
            self.conflicted.emit()
            if otherwise is not None:
                otherwise()
        elif self.is_keeping and self._has_to_save:
            self._then, self._otherwise = then, otherwise
            self._save()
        else:
            then()

    def set_aside(self) -> None:
        """Leave the case in the journal, if it is saved nowhere, for whoever signs in next.

        Raises
        ------
        OutputError
            When the journal cannot be written.
        """
        if self._case.has_unsaved_changes and not self._case.is_empty:
            self._autosave.set_aside()
            if self._case.kept is not None:  # should it stay open, both are stored
                self._case.kept = self._case.kept.begun_anew()

    def keep_version(self, reason: str) -> None:
        """Keep the feet as they are as a version of their own, for a reason."""
        self._reason, self._told = reason, ""
        self._save()

    def keep_as_new_visit(self) -> None:
        """Add what is open as another visit of its patient, in place of one that is lost."""
        kept = self._case.kept
        if kept is None:
            return
        self._is_to_move = self._is_saving
        if self._is_to_move:
            return
        self._is_saving, self._told = True, ""

        def add(records: Records) -> tuple[Person, Visit]:
            person = records.persons.get(kept.person.id)
            visit = replace(kept.visit, id=new_id(), person_id=person.id)
            return person, records.visits.add(visit)

        def added(found: tuple[Person, Visit]) -> None:
            self._is_saving = False
            if self.visit_id != kept.visit.id:
                return
            person, visit = found
            self._take_person(person)
            stored = replace(self._case.saved_record, feet=(), at_hand=None)
            self._case.mark_kept(stored, KeptVisit(person, visit))
            self.moved.emit(kept.visit.id, visit.id)
            self._set_state(KeepState.CHANGED)
            self._save()

        self._clinic.write(add, added, self._fail)

    @property
    def conflict(self) -> Conflict | None:
        """The foot that the user has to decide on; None for nothing."""
        return self._conflict

    @property
    def patient_conflict(self) -> PatientConflict | None:
        """The patient's fields that the user has to decide on; None for nothing."""
        return self._patient_conflict

    def settle_patient(self, chosen: Patient) -> None:
        """Settle a conflict of the patient's fields; one step of undo brings those here back."""
        conflict, kept = self._patient_conflict, self._case.kept
        if conflict is None or kept is None:
            return
        self._patient_conflict = None
        saved = self._case.saved_record
        theirs = {name: getattr(conflict.theirs, name) for name in conflict.collided}
        patient = replace(saved.patient, **theirs)
        self._case.mark_kept(replace(saved, patient=patient), kept)
        fields = {name: getattr(chosen, name) for name in conflict.collided}
        now = replace(self._case.record.patient, **fields)
        self._case.apply(now, tr("Choose between two versions of the patient's fields"))
        self._go_on_after_conflict()

    def settle(self, conflict: Conflict, chosen: FootRecord) -> None:
        """Settle a conflict: the chosen foot becomes the newest version, the other stays too.

        Parameters
        ----------
        chosen
            The foot of this window, theirs, or one that holds both as variants.
        """
        kept = self._case.kept
        if kept is None:
            return
        visit_id, mine, theirs = kept.visit.id, conflict.mine, conflict.theirs

        def settled(base: Base) -> None:
            if self.visit_id != visit_id:
                return
            assert self._case.kept is not None
            bases = {**self._case.kept.bases, chosen.side: base}
            self._conflict, self._told_newer = None, {}
            self._case.keep_foot(chosen, replace(self._case.kept, bases=bases))
            self._go_on_after_conflict()

        def missed(error: Exception) -> None:
            if self.visit_id == visit_id or not isinstance(error, PersonErased):
                self._fail(error)

        self._clinic.write(
            lambda r: r.prescriptions.settle(visit_id, mine, theirs, chosen), settled, missed
        )

    def _go_on_after_conflict(self) -> None:
        """Save what was chosen, unless there is more to decide on."""
        if self._conflict is not None or self._patient_conflict is not None:
            self.conflicted.emit()
            return
        self._set_state(KeepState.CHANGED)
        self._save()

    def _begin(self) -> None:
        self._timer.stop()
        self._is_to_move = False
        self._to_export = None
        self._told_newer = {}
        self._reason, self._told = "", ""
        self._conflict = self._patient_conflict = None
        is_changed = self._case.has_unsaved_changes
        state = KeepState.CHANGED if is_changed else KeepState.SAVED
        self._set_state(state if self.is_keeping else KeepState.NOTHING)
        if self.is_keeping and is_changed:
            self._timer.start(SAVE_AFTER_MS)

    def _let_go(self) -> None:
        """Keep nothing any more of a case that has become one of a file."""
        if not self.is_keeping and self.state is not KeepState.NOTHING:
            self._begin()

    def _note_change(self) -> None:
        if not self.is_keeping or not self._case.has_unsaved_changes:
            return
        if self.state in (KeepState.SAVED, KeepState.REFUSED):
            self._set_state(KeepState.CHANGED)
        if self.state is KeepState.CHANGED and not self._timer.isActive():
            self._timer.start(SAVE_AFTER_MS)

    def _save_if_back(self) -> None:
        """Save when the record is open again; what was being saved as it closed has no answer."""
        if self._clinic.state is RecordState.CLOSED:
            self._is_saving = False
            self._to_export = None
        # Refused, as to who was not signed in.
        unsaved = (KeepState.CHANGED, KeepState.WAITING, KeepState.REFUSED)
        if self._clinic.state is RecordState.OPEN and self.state in unsaved:
            self._save()

    def _note_seen(self) -> None:
        """Let the audit log tell that whoever has signed in sees the visit that was open."""
        visit_id = self.visit_id
        if visit_id and self._clinic.may_show_patients:
            self._clinic.write(
                lambda records: records.visits.note_seen(visit_id),
                lambda _nothing: None,
                _note_failure,
            )

    def _look_whose(self) -> None:
        """Ask for the patient of the open visit, who may have been merged or erased meanwhile."""
        kept = self._case.kept
        if kept is not None:
            visit_id = kept.visit.id
            self._clinic.ask(
                _WHOSE,
                lambda records: _whose(records, kept),
                lambda whose: self._note_person(visit_id, whose[0]),
                _note_failure,
            )

    def _look_for_newer(self) -> None:
        """Ask whether somebody else has stored a foot of the open visit after it was read here."""
        kept = self._case.kept
        if kept is None:
            return

        def found(stored: _Stored | None) -> None:
            now = self._case.kept
            if now is None or now.visit.id != kept.visit.id or self._is_saving:
                return  # saving finds it by itself
            if now.bases != kept.bases:
                self._look_for_newer()
            elif stored and _is_newer(stored, now) and self.state is KeepState.SAVED:
                self._tell_newer(stored)

        self._clinic.ask(_NEWEST, lambda records: _stored(records, kept), found, _note_failure)

    def _tell_newer(self, stored: _Stored) -> None:
        """Tell of newer versions once, however often they or anything else are stored again."""
        versions = {side: version_id for side, (version_id, _revision) in stored.items()}
        if versions != self._told_newer:
            self._told_newer = versions
            self.outdated.emit()

    def _note_person(self, visit_id: str, person: Person) -> None:
        if self.visit_id != visit_id:
            return
        if person.is_erased:
            self._close_erased()
        elif not self._is_saving and self.state is not KeepState.CONFLICT:  # else it looks again
            self._take_person(person)

    def _take_person(self, person: Person) -> None:
        """Let the open visit be that of whoever it belongs to by now, such as after a merge."""
        from insole_core.records.visits import patient_of  # once there is a record

        kept = self._case.kept
        assert kept is not None
        if person == kept.person:
            return
        kept = replace(kept, person=person, visit=replace(kept.visit, person_id=person.id))
        self._case.take_person(patient_of(person, kept.visit), kept)

    def _close_erased(self) -> None:
        """Close a case whose patient was erased; what was not saved yet goes with the patient."""
        then, self._then, self._otherwise = self._then, None, None
        self._is_saving = False
        self._case.open(CaseRecord(), None)
        self.erased.emit()
        if then is not None:
            then()

    def _save(self) -> None:
        """Save the case as it is now, unless it is being saved: then once more afterwards."""
        kept = self._case.kept
        if kept is None or self._is_saving or self.state is KeepState.CONFLICT:
            return
        self._timer.stop()
        self._is_saving = True
        record, reason = self._case.record, self._reason
        before = self._case.saved_record
        keep_journal = self._autosave.ahead()
        self._case.kept = kept.sending(record.patient)

        def keep(records: Records) -> KeptChange:
            from insole_core.workflows.records.keep_case import keep_case

            keep_journal()
            unkept = UnkeptVisit.of(kept, before, record, all_feet=bool(reason))
            return keep_case(records, unkept.change_to(record), reason)

        self._clinic.write(
            keep,
            lambda change: self._note_saved(kept.visit.id, before, record, change, reason),
            self._fail,
        )

    def _note_saved(
        self,
        visit_id: str,
        before: CaseRecord,
        record: CaseRecord,
        change: KeptChange,
        reason: str,
    ) -> None:
        self._is_saving = False
        kept = self._case.kept
        if kept is None or kept.visit.id != visit_id:
            return
        kept = replace(
            kept,
            person=change.person or kept.person,
            visit=change.visit or kept.visit,
            bases={**kept.bases, **change.bases},
            sent=kept.sent if change.trouble is not None else (),
        )
        if change.trouble is None and self._reason == reason:
            self._reason = ""
        if change.trouble is None:
            self._is_to_move = False
        is_whole = change.trouble is None and not change.conflicts
        saved = record if is_whole else before
        if change.collided:
            unsaved = {name: getattr(before.patient, name) for name in change.collided}
            saved = replace(saved, patient=replace(saved.patient, **unsaved))
        self._case.mark_kept(saved, kept)
        if change.conflicts or change.collided:
            self._conflict = next(iter(change.conflicts.values()), None)
            self._patient_conflict = _patient_conflict(record.patient, change)
            self._to_export = None
            self._set_state(KeepState.CONFLICT)
            self.conflicted.emit()
            self._stay()
        elif change.trouble is not None:
            self._fail(change.trouble)
        elif self._case.has_unsaved_changes or self._reason:
            self._set_state(KeepState.CHANGED)
            is_awaited = self._then is not None or self._to_export is not None
            self._timer.start(0 if is_awaited else SAVE_AFTER_MS)
        else:
            self._told = ""
            self._set_state(KeepState.SAVED)
            self._go_on()
            if self._to_export is not None:
                (then, outdated), self._to_export = self._to_export, None
                self.when_newest(then, outdated)

    def _fail(self, error: Exception) -> None:
        self._is_saving = False
        if not isinstance(error, InsoleError):
            self._to_export = None
            self._stay()
            raise error
        self.trouble = str(error)
        if isinstance(error, Unreachable):
            self._clinic.note_failure(error)
            self._set_state(KeepState.WAITING)
            self._timer.start(RETRY_MS)
            self._leave_unsaved()
            self._export_unsaved()
        elif isinstance(error, PersonErased):
            self._close_erased()
        elif isinstance(error, RecordsError) and self._case.kept is not None:
            self._refuse_unless_erased(self._case.kept, error)
        else:
            self._refuse(error)

    def note_refused(
        self, visit_id: str, error: Exception, tell: Callable[[Exception], None]
    ) -> None:
        """Tell why the record did not take something for a visit, unless that is open and lost.

        Then what becomes of the visit is all that the user has to know.
        """
        kept = self._case.kept
        is_open = kept is not None and kept.visit.id == visit_id
        if kept is None or not is_open or not isinstance(error, RecordsError):
            tell(error)
            return

        def found(whose: tuple[Person, bool]) -> None:
            person, is_there = whose
            if is_there or person.is_erased:
                tell(error)
            elif self.visit_id == visit_id:
                self._refuse(error, is_lost=True)

        self._clinic.ask(
            f"{_WHOSE}-of-refused",
            lambda records: _whose(records, kept),
            found,
            lambda _error: tell(error),
        )

    def _refuse_unless_erased(self, kept: KeptVisit, error: RecordsError) -> None:
        """Tell why nothing was stored, unless the visit has gone with an erased patient."""

        def found(whose: tuple[Person, bool]) -> None:
            person, is_there = whose
            if self.visit_id != kept.visit.id:
                return
            if person.is_erased:
                self._close_erased()
            else:
                self._refuse(error, is_lost=not is_there)

        self._clinic.ask(
            f"{_WHOSE}-refused",
            lambda records: _whose(records, kept),
            found,
            lambda _error: self._refuse(error),
        )

    def _refuse(self, error: InsoleError, *, is_lost: bool = False) -> None:
        """Tell what was refused, once, and again to whoever wants to leave it."""
        if is_lost and self._is_to_move:
            self._stay()
            self.keep_as_new_visit()
            return
        self._is_to_move = False
        if is_lost:  # in place of what the record says: whoever opens the person leaves the work
            error = _lost()
            self.trouble = str(error)
        is_new = self._told != str(error)
        self._told = str(error)
        self._set_state(KeepState.REFUSED)
        if is_lost and (is_new or self._to_export is not None):
            self._to_export = None  # nothing is written for a visit that is gone
            self.lost.emit()
        if self._then is not None or (is_new and not is_lost):
            self.failed.emit(error)
        self._stay()
        self._export_unsaved()

    def _export_unsaved(self) -> None:
        """Go on with what waited for the saving, although nothing was saved."""
        if self._to_export is not None:
            (then, _outdated), self._to_export = self._to_export, None
            then()

    def _leave_unsaved(self) -> None:
        """Leave the case for another one, once its journal is safe."""
        if self._then is None:
            return
        try:
            self.set_aside()
        except InsoleError as error:
            self.failed.emit(error)
            self._stay()
        else:
            self._go_on()

    def _go_on(self) -> None:
        then, self._then, self._otherwise = self._then, None, None
        if then is not None:
            then()

    def _stay(self) -> None:
        otherwise, self._then, self._otherwise = self._otherwise, None, None
        if otherwise is not None:
            otherwise()

    def _set_state(self, state: KeepState) -> None:
        if state in (KeepState.SAVED, KeepState.CHANGED, KeepState.NOTHING):
            self.trouble = ""
        self.state = state
        self.state_changed.emit()


def _whose(records: Records, kept: KeptVisit) -> tuple[Person, bool]:
    """Return whose a visit is by now, or was, and whether it is still there."""
    try:
        person_id, is_there = records.visits.get(kept.visit.id).person_id, True
    except Unreachable:
        raise
    except RecordsError:
        person_id, is_there = kept.person.id, False
    return records.persons.get(person_id), is_there


def _stored(records: Records, kept: KeptVisit) -> _Stored | None:
    """Return the newest version of each foot of a visit; None where the visit is gone."""
    newest = [version.summary for version in records.prescriptions.newest(kept.visit.id)]
    if not newest and not _whose(records, kept)[1]:
        return None
    return {version.side: (version.id, version.revision) for version in newest}


def _version_of(base: Base) -> tuple[str, int]:
    return base.version_id, base.revision


def _is_newer(stored: _Stored, kept: KeptVisit) -> bool:
    """Return whether a foot was stored or added after what the work is based on."""
    read = {side: _version_of(base) for side, base in kept.bases.items()}
    return any(read.get(side) != version for side, version in stored.items())


def _lost() -> RecordsError:
    sentence = tr(
        "This visit was deleted elsewhere: keep what you have made as a new visit, or save it as a "
        "file."
    )
    return RecordsError(sentence)


def _note_failure(error: Exception) -> None:
    """Let the next change of the record, or the next saving, ask again; a fault is told."""
    if not isinstance(error, InsoleError):
        raise error
    log.warning("the record cannot be asked about the open visit: %s", error)


def _patient_conflict(mine: Patient, change: KeptChange) -> PatientConflict | None:
    if not change.collided or change.theirs is None:
        return None
    return PatientConflict(mine, change.theirs, change.collided)
