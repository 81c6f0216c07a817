"""The open case: the one place that holds it, changes it and announces changes."""

from __future__ import annotations

from dataclasses import replace
from datetime import UTC, datetime
from functools import cache
from pathlib import Path
from typing import TypeVar

from PySide6.QtCore import QObject, Signal

from insole_core.cases.case_record import Annotations, CaseRecord, FootRecord, Patient
from insole_core.cases.order_note import OrderNote
from insole_core.cases.scan_source import ScanSource
from insole_core.foot.foot import Foot
from insole_core.geometry.side import Side
from insole_core.history import History
from insole_core.insole.elements import Correction
from insole_core.insole.prescription.design import InsoleDesign
from insole_studio.document.kept_visit import KeptVisit

Changeable = InsoleDesign | Annotations | Patient | FootRecord | CaseRecord
_OF_PERSON = ("name", "born", "pseudonym")
"""Fields of the patient that are those of the person, and not of the visit."""
Prescribed = TypeVar("Prescribed", bound=Correction)


class Case(QObject):
    """The record of the open case with its undo history.

    `apply` is the only way to change the record; `preview` shows a change that is not made yet,
    during a drag. Everything else listens.
    """

    leaving = Signal()
    """Another case or another foot is about to come; what is being typed belongs to this one."""
    closing = Signal(object)
    """Another case is about to come, with this record; nothing that hangs on this one may stay."""
    opened = Signal()
    """Another case was opened."""
    foot_changed = Signal()
    """Another foot is active: of another case, or the other foot of this one."""
    changed = Signal()
    """The record has changed: applied, undone, redone."""
    preview_changed = Signal()
    """The shown design or annotations changed without a change of the record."""
    selection_changed = Signal()
    saved_changed = Signal()

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._record = CaseRecord()
        self._saved_record = self._record
        self._shown: CaseRecord | None = None
        self._history: History[CaseRecord] = History()
        self._selection: str | None = None
        self.path: Path | None = None
        self.digest = ""
        """SHA-256 of the file when it was last read or written; empty where that is unknown."""
        self.is_read_only = False
        """Whether the file must not be written, because another window has it open."""
        self.kept: KeptVisit | None = None
        """The visit of the record that the case is; None for a case of a file."""
        self.author = ""
        """The prescriber."""

    @property
    def record(self) -> CaseRecord:
        """Return the record as it would be saved now."""
        return self._record

    @property
    def saved_record(self) -> CaseRecord:
        """Return the record as it was saved last."""
        return self._saved_record

    @property
    def shown(self) -> CaseRecord:
        """Return what the views show: the record, or the preview during a drag."""
        return self._record if self._shown is None else self._shown

    @property
    def foot(self) -> Foot | None:
        """Return the active foot, if there is one."""
        return self._record.foot

    @property
    def side(self) -> Side | None:
        """Return the side of the active foot."""
        return self._record.side

    @property
    def history(self) -> History[CaseRecord]:
        """Return the undo history, for the texts of undo and redo."""
        return self._history

    @property
    def has_unsaved_changes(self) -> bool:
        """Whether the record differs from the file; which foot is active makes no difference."""
        return not self._record.holds_the_same(self._saved_record)

    @property
    def is_empty(self) -> bool:
        """Whether nothing would be lost by closing this case."""
        return not self._record.feet and self._record.patient == Patient()

    def stamped(self, correction: Prescribed) -> Prescribed:
        """Return the correction with prescriber and date."""
        now = datetime.now(UTC).isoformat(timespec="seconds")
        return replace(correction, author=self.author, created_at=now)

    def apply(
        self, value: Changeable, sentence: str, merge_key: str = "", *, only_foot: bool = False
    ) -> None:
        """Change the case as one undo step; ends a preview.

        Parameters
        ----------
        value
            The new design or annotations of the active foot; the new patient; a foot, which is
            added or replaced and becomes active; or the whole record.
        sentence
            What was done, for the undo menu: "Move the pelott".
        merge_key
            Steps of one gesture with the same non-empty key are merged into one.
        only_foot
            Whether a foot takes the place of the other one, too, which leaves the case.
        """
        self._shown = None
        if isinstance(value, FootRecord):
            self.leaving.emit()
        after = _with(self._record, value)
        if only_foot and isinstance(value, FootRecord):
            after = replace(after, feet=(value,))
        if after is self._record:
            self.preview_changed.emit()
            return
        # Undo returns to the foot that was changed, even if another was active.
        before = self._record if after.at_hand is None else self._record.at(after.at_hand)
        self._history.push(before, after, sentence, merge_key)
        self._set(after)

    def note_order(self, order: OrderNote) -> None:
        """Note what was ordered, or what the shop is to be told; no step of undo takes it back."""
        if order != self._record.order:
            self._set(replace(self._record, order=order))

    def note_stored_order(self, order: OrderNote) -> None:
        """Note an order as the clinic's record has it; what is being changed here stays.

        So does a later revision that the shop has already, and the record not yet.
        """
        if order.number == self._record.order.number:
            revision = max(order.revision, self._record.order.revision)
            order = replace(order, revision=revision)
        terms = self._record.order.terms
        if terms == self._saved_record.order.terms:
            terms = order.terms
        self._saved_record = replace(self._saved_record, order=order)
        self.note_order(replace(order, terms=terms))

    def take_person(self, stored: Patient, kept: KeptVisit) -> None:
        """Take what the clinic's record holds of the person by now; what is changed here stays.

        No step of undo takes it back: each leads to the values that took the place of those there.
        """
        self.kept = kept
        if self._changed_elsewhere(stored):
            self.leaving.emit()  # what is being typed is a change of here
        before = self._changed_elsewhere(stored)
        if not before:
            return

        @cache  # one patient stays one: by that it is seen what is not saved yet
        def renamed(patient: Patient) -> Patient:
            values = {n: getattr(stored, n) for n in before if getattr(patient, n) == before[n]}
            return replace(patient, **values)

        def taken(record: CaseRecord) -> CaseRecord:
            return replace(record, patient=renamed(record.patient))

        self._shown = None
        self._history.revise(taken)
        self._saved_record = taken(self._saved_record)
        self._set(taken(self._record))

    def _changed_elsewhere(self, stored: Patient) -> dict[str, str]:
        """Return as saved last those of the person's fields that are stored otherwise by now.

        What was changed here, too, is none of them: it is a conflict, if it is one, of the saving.
        """
        mine, saved = self._record.patient, self._saved_record.patient
        return {
            name: getattr(saved, name)
            for name in _OF_PERSON
            if getattr(mine, name) == getattr(saved, name) != getattr(stored, name)
        }

    def end_merging(self) -> None:
        """Let the next change be an undo step of its own, as the user begins another gesture."""
        self._history.end_merging()

    def preview(self, value: Changeable) -> None:
        """Show a change without making it."""
        self._shown = _with(self._record, value)
        self.preview_changed.emit()

    def end_preview(self) -> None:
        """Show the record again."""
        if self._shown is not None:
            self._shown = None
            self._forget_lost_selection()
            self.preview_changed.emit()

    def take_foot(self, side: Side) -> None:
        """Make the foot of a side active; that does not change the case."""
        if self._record.at(side) is not self._record:
            self.leaving.emit()
            self._shown = None
            self.end_merging()
            self._put(self._record.at(side))

    def undo(self) -> None:
        """Undo the last step."""
        self._step_to(self._history.undo())

    def redo(self) -> None:
        """Redo the step undone last."""
        self._step_to(self._history.redo())

    @property
    def selection(self) -> str | None:
        """Return the id of the selected correction, which all views share."""
        return self._selection

    def select(self, correction_id: str | None) -> None:
        """Select a correction, or none."""
        if correction_id != self._selection:
            self._selection = correction_id
            self.selection_changed.emit()

    def open(
        self,
        record: CaseRecord,
        path: Path | None,
        unsaved: bool = False,
        *,
        digest: str = "",
        read_only: bool = False,
        kept: KeptVisit | None = None,
    ) -> None:
        """Replace the case by another one, with an empty history.

        Parameters
        ----------
        path
            The file it was opened from; None for a case never saved.
        unsaved
            Whether the record already differs from the file.
        digest
            SHA-256 of the file as it was read; without it a change of the file is not noticed.
        read_only
            Whether the file must not be written.
        kept
            The visit of the record that it is.
        """
        self.leaving.emit()
        self.closing.emit(record)
        self.path, self.digest, self.is_read_only = path, digest, read_only
        self.kept = kept
        self._begin(record, unsaved)

    def open_foot(self, foot: Foot, source: ScanSource, design: InsoleDesign | None = None) -> None:
        """Begin a design on a new foot alone; the patient stays.

        Parameters
        ----------
        source
            The scan that the foot was made from.
        design
            Where it begins; by default as scanned, without corrections.
        """
        self.leaving.emit()
        record = CaseRecord.of_foot(FootRecord.begun(foot, source, design), self._record.patient)
        self._begin(replace(record, order=self._record.order), unsaved=True)

    def _begin(self, record: CaseRecord, unsaved: bool) -> None:
        self._history.clear()
        self._shown = None
        self._selection = None
        self._record = record
        self._saved_record = CaseRecord() if unsaved else record
        self.opened.emit()
        self.foot_changed.emit()
        self.selection_changed.emit()
        self.saved_changed.emit()

    def mark_saved(self, record: CaseRecord, path: Path, digest: str = "") -> None:
        """Note that the file contains `record`; the case is one of a file from then on.

        Parameters
        ----------
        digest
            SHA-256 of the file.
        """
        self.path, self.digest, self.is_read_only = path, digest, False
        self.kept = None
        self._saved_record = record
        self.saved_changed.emit()

    def mark_kept(self, record: CaseRecord, kept: KeptVisit) -> None:
        """Note that the clinic's record contains `record`."""
        self.kept = kept
        self._saved_record = record
        self.saved_changed.emit()

    def keep_foot(self, foot: FootRecord, kept: KeptVisit) -> None:
        """Show a foot that the clinic's record contains, in place of that of the same side.

        The steps before it cannot be undone one by one any more, but their versions are kept.
        """
        self.leaving.emit()
        self._history.clear()
        self._shown = None
        self.kept = kept
        after = self._record.with_foot(foot).at(self._record.at_hand or foot.side)
        self._saved_record = self._saved_record.with_foot(foot)
        self._set(after)

    def _step_to(self, record: CaseRecord | None) -> None:
        if record is not None:
            self._shown = None
            order = self._record.order
            self._set(record if record.order == order else replace(record, order=order))

    def _set(self, record: CaseRecord) -> None:
        self._put(record)
        self.saved_changed.emit()

    def _put(self, record: CaseRecord) -> None:
        is_same_foot = record.foot is self._record.foot
        self._record = record
        self._forget_lost_selection()
        if not is_same_foot:
            self.foot_changed.emit()
        self.changed.emit()

    def _forget_lost_selection(self) -> None:
        design = self._record.design
        if self._selection and (design is None or design.correction(self._selection) is None):
            self.select(None)


def _with(record: CaseRecord, value: Changeable) -> CaseRecord:
    """Return the record with `value` in it; the same record if nothing differs."""
    match value:
        case CaseRecord():
            return value
        case Patient():
            return record if value == record.patient else replace(record, patient=value)
        case FootRecord():
            return record if value is record.of_side(value.side) else record.with_foot(value)
    foot = record.current
    assert foot is not None, "a design and annotations need a foot"
    if isinstance(value, Annotations):
        same = value == foot.annotations
        return record if same else record.with_foot(replace(foot, annotations=value))
    return record if value == foot.design else record.with_foot(foot.with_design(value))
