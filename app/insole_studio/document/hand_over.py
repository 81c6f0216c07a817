"""Hands over to the clinic's record what was changed while it did not answer, or before a crash."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtCore import QObject, Signal

from insole_core.errors import InsoleError, Unreachable
from insole_studio.document.autosave import Recovered, find_recovered
from insole_studio.document.clinic_record import ClinicRecord, RecordState

if TYPE_CHECKING:
    from insole_core.records.author import Author
    from insole_core.records.records import Records
    from insole_core.workflows.records.keep_case import KeptChange


class HandOver(QObject):
    """Stores journals of visits as soon as the record can be asked; none is removed before.

    Where somebody else has changed the same foot meanwhile, theirs stays the newest version, and
    what the journal holds becomes a version before it.

    Parameters
    ----------
    folder
        Of the journals.
    """

    handed_over = Signal(str, bool)
    """Emitted with the patient's name, and whether somebody else had changed the same foot."""
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
            self.handed_over.emit(journal.record.patient.name, bool(change.conflicts))

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
    change = CaseChange(visit.visit_id, visit.before, journal.record, visit.bases)
    kept = keep_case(records, change)
    for conflict in kept.conflicts.values():
        theirs = records.prescriptions.read(conflict.theirs.id)
        records.prescriptions.settle(visit.visit_id, conflict.mine, conflict.theirs, theirs)
    return kept
