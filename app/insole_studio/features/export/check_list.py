"""The list of checks: each with its limit, its policy, and a link to its location."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QGridLayout, QLabel, QVBoxLayout, QWidget

from insole_studio.features.export.rows import TIPS, CheckRow, CheckState
from insole_studio.texts import tr
from insole_studio.widgets.form_parts import ComboBox
from insole_studio.widgets.number_field import NumberField
from insole_studio.widgets.wrapped_button import WrappedButton

LIMIT_PX = 96
_SIGNS = {
    CheckState.PASSED: "✓",
    CheckState.WARNING: "!",
    CheckState.BLOCKING: "✗",
    CheckState.OFF: "–",
    CheckState.OPEN: "…",
}


class CheckList(QWidget):
    """Rows of checks; a click on a sentence goes to the location of the finding."""

    check_chosen = Signal(str)
    rule_edited = Signal(str, str, float)
    """Name of the check, policy, limit."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._layout = QVBoxLayout(self)
        self._layout.setContentsMargins(0, 0, 0, 0)
        self._layout.setSpacing(8)
        self._layout.addStretch(1)
        self.rows: dict[str, _Row] = {}

    def show_rows(self, rows: Sequence[CheckRow]) -> None:
        """Show the checks; fields being edited are kept."""
        for row in rows:
            if row.name not in self.rows:
                self.rows[row.name] = made = _Row(row)
                made.chosen.connect(self.check_chosen)
                made.edited.connect(self.rule_edited)
                self._layout.insertWidget(self._layout.count() - 1, made)
            self.rows[row.name].show_row(row)


class _Row(QWidget):
    chosen = Signal(str)
    edited = Signal(str, str, float)

    def __init__(self, row: CheckRow) -> None:
        super().__init__()
        self._name = row.name
        self.sign = QLabel()
        self.sign.setObjectName("check-sign")
        self.sign.setAlignment(Qt.AlignmentFlag.AlignCenter)
        self.sign.setFixedSize(22, 22)
        title = QLabel(row.title)
        self.sentence = WrappedButton()
        self.sentence.setObjectName("row")
        self.sentence.clicked.connect(self._choose)
        self.limit: NumberField | None = None
        self.policy = ComboBox(
            [("blocking", tr("blocks")), ("warning", tr("warns")), ("off", tr("off"))]
        )
        self.policy.setAccessibleName(row.title)
        self.policy.setToolTip(tr("Whether a failed check stops the export, warns, or is left out"))
        self.policy.edited.connect(self._edit)
        grid = QGridLayout(self)
        grid.setContentsMargins(0, 0, 0, 0)
        grid.setHorizontalSpacing(8)
        grid.setVerticalSpacing(0)
        grid.setColumnStretch(1, 1)
        grid.addWidget(self.sign, 0, 0)
        grid.addWidget(title, 0, 1)
        grid.addWidget(self.policy, 0, 3)
        grid.addWidget(self.sentence, 1, 1, 1, 3)
        if row.limit is not None:
            decimals = 2 if row.name == "cutter" else 1
            self.limit = NumberField(row.unit, least=0, greatest=500, step=0.5, decimals=decimals)
            self.limit.setAccessibleName(row.title)
            self.limit.setToolTip(TIPS[row.name]())
            self.limit.set_room(LIMIT_PX)
            self.limit.edited.connect(self._edit)
            grid.addWidget(self.limit, 0, 2)

    def show_row(self, row: CheckRow) -> None:
        self.sign.setText(_SIGNS[row.state])
        self.sign.setProperty("state", row.state.value)
        self.sign.style().unpolish(self.sign)
        self.sign.style().polish(self.sign)
        self.sentence.setText(row.sentence + "  ›" * row.leads)
        self.sentence.setToolTip(tr("Look there") if row.leads else "")
        self.policy.show_value(row.policy)
        if self.limit is not None and row.limit is not None:
            self.limit.show_value(row.limit)

    def _choose(self) -> None:
        self.chosen.emit(self._name)

    def _edit(self) -> None:
        limit = self.limit.value() if self.limit is not None else 0.0
        self.edited.emit(self._name, self.policy.currentData(), limit)
