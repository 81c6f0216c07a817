"""Hands over to the clinic's record what was changed while it did not answer, or before a crash."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtCore import QObject, Signal

from insole_core.cases.case_record import CaseRecord, Patient
from insole_core.errors import InsoleError, PersonErased, Unreachable
from insole_studio.document.clinic_record import ClinicRecord, RecordState
from insole_studio.document.journal import Recovered, find_recovered
from insole_studio.texts import tr

if TYPE_CHECKING:
    from insole_core.records.author import Author
    from insole_core.records.records import Records
    from insole_core.workflows.records.keep_case import KeptChange


class HandOver(QObject):
    """Stores journals of visits as soon as the record can be asked; none is removed before.

    Where somebody else has changed the same foot meanwhile, theirs stays the newest version, and
    what the journal holds becomes a version before it. Of a field that both have changed, theirs
    stays, and what the journal holds is added to the notes of the visit.

    Parameters
    ----------
    folder
        Of the journals.
    """

    handed_over = Signal(str, bool)
    """Emitted with the patient's name, and whether somebody else had changed the same, too."""
    stuck_changed = Signal(object)
    """Emitted with the journals (`Recovered`) that the record does not take; see `give_up`."""
    found = Signal(object)
    """Emitted with journals of files, which are none of the record's."""
    failed = Signal(object)
    damaged = Signal(object)
    """Emitted with a sentence about a journal that cannot be read."""

    def __init__(self, clinic: ClinicRecord, folder: Path, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._clinic = clinic
        self._folder = folder
        self._waiting: list[Recovered] = []
        self._under_way: Recovered | None = None
        self._refusals: dict[Recovered, str] = {}
        """Why the record did not take journals, for which it would have to be another one."""
        self._looks_again = False
        self._author: Author | None = None
        clinic.state_changed.connect(self._go_on)

    def take(self, journals: Sequence[Recovered]) -> None:
        """Hand over journals, or keep them until the record is open."""
        self._waiting += journals
        self._go_on()

    def give_up(self, journal: Recovered) -> bool:
        """Hand over a journal no more; return False if it is being stored or is stored already."""
        if journal not in self._waiting:
            return False
        self._waiting.remove(journal)
        self._refusals.pop(journal, None)
        return True

    def close(self) -> None:
        """Leave what is not handed over to the next window that starts."""
        self._put_back()
        for journal in self._waiting:
            journal.release()
        self._waiting.clear()

    def _go_on(self) -> None:
        clinic = self._clinic
        if clinic.state is RecordState.CLOSED:
            self._put_back()
        elif clinic.state is RecordState.AWAY:
            self._looks_again = True
        elif clinic.state is RecordState.REFUSED:
            self.stuck_changed.emit(tuple(self._waiting))
        elif clinic.is_open:
            self._note_author()
            if clinic.may_show_patients:
                self._hand_over_all()

    def _hand_over_all(self) -> None:
        """Hand over one journal after the other, the newest first: it stays the newest version."""
        if self._under_way is not None:
            return
        if self._looks_again:
            self._look_again()
        self._hand_over_next(list(self._waiting))

    def _hand_over_next(self, journals: list[Recovered]) -> None:
        while journals:
            journal = journals.pop(0)
            if journal in self._waiting:
                self._waiting.remove(journal)
                self._hand_over(journal, lambda: self._hand_over_next(journals))
                return
        self.stuck_changed.emit(tuple(self._refusals))

    def _put_back(self) -> None:
        """Let a journal wait whose answer does not arrive any more."""
        if self._under_way is not None:
            self._waiting.insert(0, self._under_way)
            self._under_way = None

    def _forget_under_way(self, journal: Recovered) -> None:
        """Remove a journal that is in the record, or whose person was erased."""
        self._under_way = None
        self._refusals.pop(journal, None)
        journal.discard()

    def _note_author(self) -> None:
        """Look again for what was set aside when somebody else has signed in."""
        before, self._author = self._author, self._clinic.author
        self._looks_again |= before is not None and before != self._author

    def _look_again(self) -> None:
        self._looks_again = False
        found = find_recovered(self._folder, self.damaged.emit)
        self._waiting += [journal for journal in found if journal.visit is not None]
        self.found.emit([journal for journal in found if journal.visit is None])

    def _hand_over(self, journal: Recovered, then: Callable[[], None]) -> None:
        self._under_way = journal

        def keep(records: Records) -> KeptChange:
            return _keep(records, journal)

        def kept(change: KeptChange) -> None:
            if change.trouble is not None:
                missed(change.trouble)
                return
            self._forget_under_way(journal)
            collided = bool(change.conflicts or change.collided)
            self.handed_over.emit(journal.record.patient.name, collided)
            then()

        def missed(error: Exception) -> None:
            if isinstance(error, PersonErased):
                self._forget_under_way(journal)
                then()
                return
            self._put_back()
            if not isinstance(error, InsoleError):
                raise error
            if isinstance(error, Unreachable):
                self._clinic.note_failure(error)
                return
            if self._refusals.get(journal) != str(error):
                self._refusals[journal] = str(error)
                self.failed.emit(error)
            then()

        self._clinic.write(keep, kept, missed)


def _keep(records: Records, journal: Recovered) -> KeptChange:
    from insole_core.workflows.records.keep_case import CaseChange, keep_case

    visit = journal.visit
    assert visit is not None
    kept = keep_case(records, visit.change_to(journal.record))
    for conflict in kept.conflicts.values():
        theirs = records.prescriptions.read(conflict.theirs.id)
        records.prescriptions.settle(visit.visit_id, conflict.mine, conflict.theirs, theirs)
    if kept.collided and kept.theirs is not None and kept.trouble is None:
        notes = _with_mine(kept.theirs.notes, journal.record.patient, kept.collided)
        noted = CaseRecord(replace(kept.theirs, notes=notes))
        added = keep_case(records, CaseChange(visit.visit_id, kept.theirs, noted, {}))
        return replace(kept, trouble=added.trouble)
    return kept


def _with_mine(notes: str, mine: Patient, collided: Sequence[str]) -> str:
    """Return notes with what the fields were changed to here below them."""
    labels = {
        "name": tr("Name"),
        "born": tr("Born"),
        "visit": tr("Day"),
        "pseudonym": tr("Pseudonym"),
    }
    lines = [f"{labels[n]}: {getattr(mine, n)}" for n in collided if n in labels]
    lines += [mine.notes] if "notes" in collided else []
    return "\n".join((notes, *lines)).strip()
