"""Hands over to the clinic's record what was changed while it did not answer, or before a crash."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtCore import QObject, Signal

from insole_core.cases.case_record import CaseRecord, Patient
from insole_core.errors import InsoleError, Unreachable
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
    refused = Signal(object)
    """Emitted with journals (`Recovered`) that the record cannot take, as it cannot be opened."""
    failed = Signal(object)

    def __init__(self, clinic: ClinicRecord, folder: Path, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._clinic = clinic
        self._folder = folder
        self._waiting: list[Recovered] = []
        self._looks_again = False
        self._author: Author | None = None
        clinic.state_changed.connect(self._go_on)

    def take(self, journals: Sequence[Recovered]) -> None:
        """Hand over journals, or keep them until the record is open."""
        self._waiting += journals
        self._go_on()

    def close(self) -> None:
        """Leave what is not handed over to the next window that starts."""
        for journal in self._waiting:
            journal.release()
        self._waiting.clear()

    def _go_on(self) -> None:
        clinic = self._clinic
        if clinic.state is RecordState.AWAY:
            self._looks_again = True
        elif clinic.state is RecordState.REFUSED and self._waiting:
            waiting, self._waiting = self._waiting, []
            self.refused.emit(waiting)
        elif clinic.is_open:
            self._note_author()
            if clinic.may_show_patients:
                self._hand_over_all()

    def _hand_over_all(self) -> None:
        if self._looks_again:
            self._look_again()
        waiting, self._waiting = self._waiting, []
        for journal in waiting:
            self._hand_over(journal)

    def _note_author(self) -> None:
        """Look again for what was set aside when somebody else has signed in."""
        before, self._author = self._author, self._clinic.author
        self._looks_again |= before is not None and before != self._author

    def _look_again(self) -> None:
        self._looks_again = False
        found = find_recovered(self._folder)
        self._waiting += [journal for journal in found if journal.visit is not None]
        for journal in found:
            if journal.visit is None:
                journal.release()

    def _hand_over(self, journal: Recovered) -> None:
        def keep(records: Records) -> KeptChange:
            return _keep(records, journal)

        def kept(change: KeptChange) -> None:
            if change.trouble is not None:
                missed(change.trouble)
                return
            journal.discard()
            collided = bool(change.conflicts or change.collided)
            self.handed_over.emit(journal.record.patient.name, collided)

        def missed(error: Exception) -> None:
            self._waiting.append(journal)
            if not isinstance(error, InsoleError):
                raise error
            self._clinic.note_failure(error)
            if not isinstance(error, Unreachable):
                self.failed.emit(error)

        self._clinic.write(keep, kept, missed)


def _keep(records: Records, journal: Recovered) -> KeptChange:
    from insole_core.workflows.records.keep_case import CaseChange, keep_case

    visit = journal.visit
    assert visit is not None
    change = CaseChange(
        visit.visit_id, visit.before, journal.record, visit.bases, visit.editing, visit.sent
    )
    kept = keep_case(records, change)
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
