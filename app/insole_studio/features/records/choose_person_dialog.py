"""A dialog to choose the person that a case of a file belongs to."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QDialog, QDialogButtonBox, QLabel, QLineEdit, QVBoxLayout, QWidget

from insole_studio.features.records.start_page import MOST_LETTERS
from insole_studio.services.person_list import person_headings
from insole_studio.texts import tr
from insole_studio.widgets.row_table import RowTable, TableRow

_SIZE = (640, 420)


class ChoosePersonDialog(QDialog):
    """A search line and the persons it finds; the case may also begin a new person."""

    search_edited = Signal(str)

    def __init__(self, name: str, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setWindowTitle(tr("Add to the record"))
        self.resize(*_SIZE)
        self.person_id = ""
        """The chosen person; empty for a new one."""
        words = QLabel(tr("Whose case is it? It becomes a visit; the file stays as it is."))
        words.setWordWrap(True)
        self.search = QLineEdit(name)
        self.search.setMaxLength(MOST_LETTERS)
        self.search.setAccessibleName(tr("Search patients"))
        self.search.textChanged.connect(self.search_edited)
        self.table = RowTable(person_headings())
        self.table.setAccessibleName(tr("Patients"))
        self.table.chosen.connect(self._choose)
        self.table.current_changed.connect(self._allow)
        buttons = QDialogButtonBox()
        role = QDialogButtonBox.ButtonRole
        self.add = buttons.addButton(tr("Add to this patient"), role.ActionRole)
        self.new = buttons.addButton(tr("Add as a new patient"), role.ActionRole)
        buttons.addButton(tr("Cancel"), role.RejectRole)
        self.add.setEnabled(False)
        self.add.clicked.connect(self._choose_current)
        self.new.clicked.connect(self._choose_new)
        buttons.rejected.connect(self.reject)
        layout = QVBoxLayout(self)
        layout.setSpacing(12)
        for part in (words, self.search, self.table, buttons):
            layout.addWidget(part, 1 if part is self.table else 0)

    def show_found(self, rows: Sequence[TableRow]) -> None:
        """Show the persons that were found."""
        self.table.show_rows(rows)

    def _allow(self, person_id: str) -> None:
        self.add.setEnabled(bool(person_id))

    def _choose_current(self) -> None:
        self._choose(self.table.current_key)

    def _choose_new(self) -> None:
        self._choose("")

    def _choose(self, person_id: str) -> None:
        self.person_id = person_id
        self.accept()
