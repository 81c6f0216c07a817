"""The open case: the one place that holds it, changes it and says that it has changed."""

from __future__ import annotations

from dataclasses import replace
from datetime import UTC, datetime
from pathlib import Path
from typing import TypeVar

from PySide6.QtCore import QObject, Signal

from insole_core.cases.record import Annotations, CaseRecord, Patient, Source
from insole_core.foot.foot import Foot
from insole_core.geometry.side import Side
from insole_core.insole.corrections import CorrectionBase
from insole_core.insole.design import InsoleDesign
from insole_studio.workbench.history import History

Changeable = InsoleDesign | Annotations | Patient
Prescribed = TypeVar("Prescribed", bound=CorrectionBase)


class Case(QObject):
    """The record of the open case with its undo history.

    `apply` is the only way to change the record; `preview` shows a change that is not made yet,
    while the hand still moves. Everything else listens.
    """

    opened = Signal()
    """Another case, or another foot, is there."""
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
        """Whether the record differs from the file."""
        return self._record is not self._saved_record

    @property
    def is_empty(self) -> bool:
        """Whether nothing would be lost by leaving this case."""
        return self._record.foot is None and self._record.patient == Patient()

    def stamped(self, correction: Prescribed) -> Prescribed:
        """Note who prescribes a correction, and when."""
        now = datetime.now(UTC).isoformat(timespec="seconds")
        return replace(correction, author=self.author, created_at=now)

    def apply(self, value: Changeable, sentence: str, merge_key: str = "") -> None:
        """Change the case and make it one step of undo; ends a preview.

        Parameters
        ----------
        value
            The new design, annotations or patient.
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
        self._history.push(self._record, after, sentence, merge_key)
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
        self.selection_changed.emit()
        self.saved_changed.emit()

    def open_foot(self, foot: Foot, source: Source) -> None:
        """Begin a design on a new foot; the patient stays."""
        record = CaseRecord(
            patient=self._record.patient,
            source=source,
            foot=foot,
            design=InsoleDesign(side=foot.side),
        )
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
        self._record = record
        self._forget_lost_selection()
        self.changed.emit()
        self.saved_changed.emit()

    def _forget_lost_selection(self) -> None:
        design = self._record.design
        if self._selection and (design is None or design.correction(self._selection) is None):
            self.select(None)


def _with(record: CaseRecord, value: Changeable) -> CaseRecord:
    """Put `value` into the record; the same record when nothing differs."""
    name = {InsoleDesign: "design", Annotations: "annotations", Patient: "patient"}[type(value)]
    if getattr(record, name) == value:
        return record
    return replace(record, **{name: value})  # type: ignore[arg-type]
