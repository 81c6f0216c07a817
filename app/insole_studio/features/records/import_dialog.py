"""What the imports share: what becomes of every row or file, before anything is added."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from PySide6.QtCore import Signal
from PySide6.QtWidgets import (
    QCheckBox,
    QDialog,
    QDialogButtonBox,
    QHBoxLayout,
    QVBoxLayout,
    QWidget,
)

from insole_core.records.person_import import Outcome
from insole_studio.texts import tr, translate_core_message
from insole_studio.widgets.message_label import MessageLabel
from insole_studio.widgets.row_table import RowTable, TableRow

_SIZE_PX = (860, 640)


@dataclass(frozen=True)
class ImportRow:
    """One row of a table, or one file.

    Parameters
    ----------
    place
        Line or path.
    """

    place: str
    outcome: Outcome
    name: str
    reason: str


class ImportDialog(QDialog):
    """Shows a dry run; the user adds what is new, or closes the dialog.

    Parameters
    ----------
    place
        Heading of the column with lines or paths.
    """

    add_requested = Signal(bool)
    """Whether the doubtful ones are to be added, too."""
    report_requested = Signal()

    def __init__(self, title: str, place: str, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setWindowTitle(title)
        self.resize(*_SIZE_PX)
        self.rows: tuple[ImportRow, ...] = ()
        self.counts = MessageLabel()
        self.trouble = MessageLabel("warning")
        headings = (place, tr("What becomes of it"), tr("Name"), tr("Why"))
        self.table = RowTable(headings, stretched=3)
        self.table.setAccessibleName(tr("What becomes of each row"))
        self.with_doubtful = QCheckBox(tr("Add the doubtful ones, too, as new patients"))
        self.with_doubtful.setToolTip(tr("Two that turn out to be one can be merged later."))
        self.with_doubtful.toggled.connect(self._show_button)
        self.buttons = QDialogButtonBox()
        self.add_button = self.buttons.addButton("", QDialogButtonBox.ButtonRole.AcceptRole)
        self.report_button = self.buttons.addButton(
            tr("Save report…"), QDialogButtonBox.ButtonRole.ActionRole
        )
        self.buttons.addButton(tr("Close"), QDialogButtonBox.ButtonRole.RejectRole)
        self.add_button.clicked.connect(lambda: self.add_requested.emit(self._adds_doubtful))
        self.report_button.clicked.connect(self.report_requested)
        self.buttons.rejected.connect(self.reject)
        self.head = QVBoxLayout()
        """Above the table, for what one of the imports asks."""
        layout = QVBoxLayout(self)
        layout.setSpacing(10)
        layout.addLayout(self.head)
        layout.addWidget(self.trouble)
        layout.addWidget(self.counts)
        layout.addWidget(self.table, 1)
        foot = QHBoxLayout()
        foot.addWidget(self.with_doubtful, 1)
        layout.addLayout(foot)
        layout.addWidget(self.buttons)
        self.wait()

    def wait(self, sentence: str = "") -> None:
        """Show that nothing can be added yet.

        Parameters
        ----------
        sentence
            Why not; the rows of the dry run before are gone. Empty while one is on its way.
        """
        if sentence:
            self.show_rows((), "")
        self.trouble.say(sentence)
        self.add_button.setEnabled(False)
        self.report_button.setEnabled(False)

    def show_rows(self, rows: Sequence[ImportRow], counts: str) -> None:
        """Show what becomes of each row; what needs a look comes first.

        Parameters
        ----------
        counts
            How many there are of each outcome.
        """
        self.rows = tuple(rows)
        self.trouble.say("")
        self.counts.say(counts)
        order = list(_ATTENTION)
        shown = sorted(self.rows, key=lambda row: order.index(row.outcome))
        self.table.show_rows([_table_row(number, row) for number, row in enumerate(shown)])
        self.with_doubtful.setVisible(self._count(Outcome.DOUBTFUL) > 0)
        self.report_button.setEnabled(bool(self.rows))
        self._show_button()

    @property
    def _adds_doubtful(self) -> bool:
        return self.with_doubtful.isChecked() and self._count(Outcome.DOUBTFUL) > 0

    def _show_button(self) -> None:
        count = self._count(Outcome.NEW)
        count += self._count(Outcome.DOUBTFUL) if self._adds_doubtful else 0
        self.add_button.setText(tr("Add {count}").format(count=count))
        self.add_button.setEnabled(count > 0)

    def _count(self, outcome: Outcome) -> int:
        return sum(row.outcome is outcome for row in self.rows)


_ATTENTION = {
    Outcome.REFUSED: True,
    Outcome.DOUBTFUL: True,
    Outcome.REPEATED: False,
    Outcome.NEW: False,
    Outcome.PRESENT: False,
}
"""Whether an outcome needs a look; the first come first."""


def _table_row(number: int, row: ImportRow) -> TableRow:
    reason = translate_core_message(row.reason)
    cells = (row.place, _outcome_text(row.outcome), row.name, reason)
    return TableRow(str(number), cells, attention=_ATTENTION[row.outcome], tip=reason)


def _outcome_text(outcome: Outcome) -> str:
    """Return what becomes of one row; the core speaks of several."""
    return {
        Outcome.NEW: tr("is added"),
        Outcome.PRESENT: tr("already there"),
        Outcome.REPEATED: tr("twice in the file"),
        Outcome.DOUBTFUL: tr("is doubtful"),
        Outcome.REFUSED: tr("is refused"),
    }[outcome]
