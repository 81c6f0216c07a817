"""The open case: the one place that holds it, changes it and says that it has changed."""

from __future__ import annotations

from dataclasses import replace
from datetime import UTC, datetime
from pathlib import Path
from typing import TypeVar

from PySide6.QtCore import QObject, Signal

from insole_core.cases.case_record import Annotations, CaseRecord, FootRecord, Patient, ScanSource
from insole_core.foot.foot import Foot
from insole_core.geometry.side import Side
from insole_core.insole.prescription.corrections import CorrectionBase
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.workflows.history import History

Changeable = InsoleDesign | Annotations | Patient | FootRecord | CaseRecord
Prescribed = TypeVar("Prescribed", bound=CorrectionBase)


class Case(QObject):
    """The record of the open case with its undo history.

    `apply` is the only way to change the record; `preview` shows a change that is not made yet,
    while the hand still moves. Everything else listens.
    """

    opened = Signal()
    """Another case is there."""
    foot_changed = Signal()
    """Another foot is at hand: of another case, or the other foot of this one."""
    changed = Signal()
    """The record is another one: applied, undone, redone."""
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
        self.author = ""
        """Who prescribes."""

    @property
    def record(self) -> CaseRecord:
        """What is true: what would be saved now."""
        return self._record

    @property
    def shown(self) -> CaseRecord:
        """What the views show: the record, or the preview while the hand moves."""
        return self._record if self._shown is None else self._shown

    @property
    def foot(self) -> Foot | None:
        """The foot, once there is one."""
        return self._record.foot

    @property
    def side(self) -> Side | None:
        """Which foot."""
        return self._record.side

    @property
    def history(self) -> History[CaseRecord]:
        """For the texts of undo and redo."""
        return self._history

    @property
    def has_unsaved_changes(self) -> bool:
        """Whether the record differs from the file; which foot is at hand is no difference."""
        return not self._record.holds_the_same(self._saved_record)

    @property
    def is_empty(self) -> bool:
        """Whether nothing would be lost by leaving this case."""
        return not self._record.feet and self._record.patient == Patient()

    def stamped(self, correction: Prescribed) -> Prescribed:
        """Note who prescribes a correction, and when."""
        now = datetime.now(UTC).isoformat(timespec="seconds")
        return replace(correction, author=self.author, created_at=now)

    def apply(self, value: Changeable, sentence: str, merge_key: str = "") -> None:
        """Change the case and make it one step of undo; ends a preview.

        Parameters
        ----------
        value
            The new design or annotations of the foot at hand, the new patient; or a foot, which is
            added or replaced and comes to hand; or the whole record.
        sentence
            What was done, for the menu: "Move the pelott".
        merge_key
            Steps of the same non-empty key that follow each other are one.
        """
        self._shown = None
        after = _with(self._record, value)
        if after is self._record:
            self.preview_changed.emit()
            return
        # Undo leads to the foot that was changed, also when another was at hand.
        before = self._record if after.at_hand is None else self._record.at(after.at_hand)
        self._history.push(before, after, sentence, merge_key)
        self._set(after)

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
        """Take the foot of a side to hand; that is no change of the case."""
        if self._record.at(side) is not self._record:
            self._shown = None
            self._history.end_merging()
            self._put(self._record.at(side))

    def undo(self) -> None:
        """Take the last step back."""
        self._step_to(self._history.undo())

    def redo(self) -> None:
        """Do the last undone step again."""
        self._step_to(self._history.redo())

    @property
    def selection(self) -> str | None:
        """The id of the selected correction, the same in all views."""
        return self._selection

    def select(self, correction_id: str | None) -> None:
        """Select a correction, or nothing."""
        if correction_id != self._selection:
            self._selection = correction_id
            self.selection_changed.emit()

    def open(self, record: CaseRecord, path: Path | None, unsaved: bool = False) -> None:
        """Put another case here; its history begins anew."""
        self._history.clear()
        self._shown = None
        self._selection = None
        self.path = path
        self._record = record
        self._saved_record = CaseRecord() if unsaved else record
        self.opened.emit()
        self.foot_changed.emit()
        self.selection_changed.emit()
        self.saved_changed.emit()

    def open_foot(self, foot: Foot, source: ScanSource) -> None:
        """Begin a design on a new foot alone; the patient stays."""
        record = CaseRecord.of_foot(FootRecord.begun(foot, source), self._record.patient)
        self.open(record, self.path, unsaved=True)

    def mark_saved(self, record: CaseRecord, path: Path) -> None:
        """Note that `record` is what the file holds."""
        self.path = path
        self._saved_record = record
        self.saved_changed.emit()

    def _step_to(self, record: CaseRecord | None) -> None:
        if record is not None:
            self._shown = None
            self._set(record)

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
    """Put `value` into the record; the same record when nothing differs."""
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
