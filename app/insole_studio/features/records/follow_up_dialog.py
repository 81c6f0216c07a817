"""What became of the insoles: what was told so far, and what is told now."""

from __future__ import annotations

from collections.abc import Sequence
from datetime import date

from PySide6.QtWidgets import (
    QDialog,
    QDialogButtonBox,
    QFormLayout,
    QLineEdit,
    QVBoxLayout,
    QWidget,
)

from insole_core.records.field_checks import MOST_NAME
from insole_core.records.follow_up import FollowUp
from insole_core.records.record_field import typed_fields
from insole_studio.features.records.record_form import label_of
from insole_studio.texts import tr
from insole_studio.widgets.form_labels import mark_labels
from insole_studio.widgets.notes_field import NotesField
from insole_studio.widgets.row_table import RowTable, TableRow

_SIZE = (640, 440)


class FollowUpDialog(QDialog):
    """The follow-ups of a person, the newest first, and a form for another one."""

    def __init__(
        self, person_id: str, before: Sequence[FollowUp], parent: QWidget | None = None
    ) -> None:
        super().__init__(parent)
        self.setWindowTitle(tr("Follow-up"))
        self.resize(*_SIZE)
        self._person_id = person_id
        day, outcome, notes = (label_of(FollowUp, name) for name in typed_fields(FollowUp))
        self.table = RowTable((day, outcome, notes, tr("By")), stretched=2)
        self.table.setAccessibleName(tr("Follow-ups so far"))
        self.table.show_rows([_row(follow_up) for follow_up in before])
        self.outcome = QLineEdit()
        self.outcome.setMaxLength(MOST_NAME)
        self.outcome.setPlaceholderText(tr("Better, the same, worse; in a word or two"))
        self.notes = NotesField()
        buttons = QDialogButtonBox()
        role = QDialogButtonBox.ButtonRole
        self.add = buttons.addButton(tr("Add follow-up"), role.AcceptRole)
        self.add.setEnabled(False)
        buttons.addButton(tr("Close"), role.RejectRole)
        buttons.accepted.connect(self.accept)
        buttons.rejected.connect(self.reject)
        self.outcome.textChanged.connect(self._allow)
        form = QFormLayout()
        form.setFieldGrowthPolicy(QFormLayout.FieldGrowthPolicy.AllNonFixedFieldsGrow)
        form.addRow(outcome, self.outcome)
        form.addRow(notes, self.notes)
        mark_labels(form)
        layout = QVBoxLayout(self)
        layout.setSpacing(12)
        layout.addWidget(self.table, 1)
        layout.addLayout(form)
        layout.addWidget(buttons)
        self.outcome.setFocus()

    def follow_up(self) -> FollowUp:
        """Return what was typed, as of today."""
        return FollowUp(
            self._person_id, date.today(), self.outcome.text().strip(), self.notes.toPlainText()
        )

    def _allow(self) -> None:
        self.add.setEnabled(bool(self.outcome.text().strip()))


def _row(follow_up: FollowUp) -> TableRow:
    notes = " ".join(follow_up.notes.split())
    cells = (follow_up.on_date.isoformat(), follow_up.outcome, notes, follow_up.author)
    return TableRow(follow_up.id, cells, tip=follow_up.notes)
