"""A search line with a list, to choose one person of the record."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, cast

from PySide6.QtCore import QEvent, QObject, Qt, Signal
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import QLineEdit, QVBoxLayout, QWidget
from shiboken6 import isValid

from insole_core.records.person import PersonSummary
from insole_studio.document.clinic_record import ClinicRecord
from insole_studio.services.person_list import person_headings, person_rows
from insole_studio.texts import tr
from insole_studio.widgets.message_label import MessageLabel
from insole_studio.widgets.row_table import RowTable

if TYPE_CHECKING:
    from insole_core.records.records import Records

_MOST_FOUND = 20
_MOST_LETTERS = 200


class PersonPicker(QWidget):
    """Finds persons as their name is typed; the row that the cursor is on is the chosen one."""

    person_changed = Signal()

    def __init__(
        self,
        title: str,
        clinic: ClinicRecord,
        refuse: Callable[[Exception], None],
        parent: QWidget | None = None,
    ) -> None:
        super().__init__(parent)
        self._clinic = clinic
        self._channel = f"clinic-pick-{title}"
        self._refuse = refuse
        self._found: dict[str, PersonSummary] = {}
        heading = MessageLabel("heading")
        heading.say(title)
        self.search = QLineEdit()
        self.search.setMaxLength(_MOST_LETTERS)
        self.search.setPlaceholderText(tr("Name, birth date, personal number or order"))
        self.search.setAccessibleName(title)
        self.search.setClearButtonEnabled(True)
        self.search.textEdited.connect(self._search)
        self.search.installEventFilter(self)
        self.table = RowTable(person_headings())
        self.table.setAccessibleName(title)
        self.table.current_changed.connect(lambda _key: self.person_changed.emit())
        layout = QVBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.setSpacing(4)
        layout.addWidget(heading)
        layout.addWidget(self.search)
        layout.addWidget(self.table, 1)

    @property
    def person(self) -> PersonSummary | None:
        """The chosen person."""
        return self._found.get(self.table.current_key)

    def show_person(self, person: PersonSummary) -> None:
        """Choose a person."""
        self.search.setText(person.name)
        self._show([person])

    def clear(self) -> None:
        """Choose nobody."""
        self.search.clear()
        self._show([])

    def eventFilter(self, _watched: QObject, event: QEvent) -> bool:
        """Let the arrow go from the search line to the list, and Enter press no button."""
        if event.type() != QEvent.Type.KeyPress:
            return False
        key = cast("QKeyEvent", event).key()
        if key == Qt.Key.Key_Down and self.table.take_first():
            self.table.setFocus(Qt.FocusReason.OtherFocusReason)
            return True
        return key in (Qt.Key.Key_Return, Qt.Key.Key_Enter)

    def _search(self, typed: str) -> None:
        if not typed.strip():
            self._show([])
            return

        def find(records: Records) -> list[PersonSummary]:
            return records.persons.search(typed, _MOST_FOUND)

        def show(found: list[PersonSummary]) -> None:
            if isValid(self):
                self._show(found)

        self._clinic.ask(self._channel, find, show, self._refuse)

    def _show(self, found: Sequence[PersonSummary]) -> None:
        self._found = {person.id: person for person in found}
        self.table.show_rows(person_rows(found))
        self.table.take_first()
        self.person_changed.emit()
