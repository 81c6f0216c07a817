"""Dialogs that add a patient, or choose the one that a case of a file belongs to."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from datetime import date

from PySide6.QtCore import Signal
from PySide6.QtWidgets import (
    QCheckBox,
    QDialog,
    QDialogButtonBox,
    QFormLayout,
    QHBoxLayout,
    QLabel,
    QLineEdit,
    QVBoxLayout,
    QWidget,
)

from insole_core.cases.days import read_day
from insole_core.errors import InputError
from insole_core.records.field_checks import MOST_NAME, check_name
from insole_core.records.person import Person
from insole_core.records.personal_numbers import KINDS, MOST_NUMBER, check_personal_number
from insole_studio.features.records.record_form import choice_box, label_of
from insole_studio.features.records.rows import day_text
from insole_studio.features.records.start_page import MOST_LETTERS
from insole_studio.services.person_list import person_headings
from insole_studio.texts import tr
from insole_studio.widgets.date_field import DateField
from insole_studio.widgets.form_parts import allow, mark_labels
from insole_studio.widgets.message_label import MessageLabel
from insole_studio.widgets.row_table import RowTable, TableRow

_WIDTH_PX = 460

_SIZE = (640, 420)


class NewPatientDialog(QDialog):
    """A form; it is accepted once all that is typed can be right.

    Parameters
    ----------
    begun
        What is filled in to begin with, such as the name that was searched for.
    number_kind
        The kind of personal numbers used last.
    """

    def __init__(self, begun: Person, number_kind: str, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setWindowTitle(tr("New patient"))
        self.setMinimumWidth(_WIDTH_PX)
        self.name = QLineEdit(begun.name)
        self.name.setMaxLength(MOST_NAME + 1)
        self.born = DateField(day_text(begun.birth_date))
        self.number = QLineEdit(begun.personal_number)
        self.number.setMaxLength(MOST_NUMBER + 1)
        self.kind = choice_box(Person, "number_kind")
        self.kind.show_value(begun.number_kind or number_kind)
        self.consent = QCheckBox(tr("The patient agrees that these data are kept (today)"))
        self.consent.setChecked(begun.consent_on is not None)
        self.refusal = MessageLabel("warning")
        self.number.editingFinished.connect(self._take_birth_date)
        self.buttons = QDialogButtonBox()
        self.add_button = self.buttons.addButton(
            tr("Add patient"), QDialogButtonBox.ButtonRole.AcceptRole
        )
        self.buttons.addButton(tr("Cancel"), QDialogButtonBox.ButtonRole.RejectRole)
        self.buttons.accepted.connect(self._try)
        self.buttons.rejected.connect(self.reject)
        self.person: Person | None = None
        """What was typed, once it is accepted."""
        self._lay_out()
        (self.born if begun.name else self.name).setFocus()

    def _lay_out(self) -> None:
        number = QHBoxLayout()
        number.addWidget(self.number, 1)
        number.addWidget(self.kind)
        form = QFormLayout()
        form.setFieldGrowthPolicy(QFormLayout.FieldGrowthPolicy.AllNonFixedFieldsGrow)
        form.addRow(label_of(Person, "name"), self.name)
        form.addRow(label_of(Person, "birth_date"), self.born)
        form.addRow(label_of(Person, "personal_number"), number)
        form.addRow("", self.consent)
        mark_labels(form)
        layout = QVBoxLayout(self)
        layout.setSpacing(12)
        layout.addLayout(form)
        layout.addWidget(self.refusal)
        layout.addWidget(self.buttons)

    def _take_birth_date(self) -> None:
        """Fill in the birth date that a personal number holds."""
        kind = KINDS[self.kind.currentData()]
        try:
            day = kind.birth_date(kind.check(self.number.text().strip()))
        except InputError:
            return  # told when the dialog is accepted
        if day is not None and not self.born.text().strip():
            self.born.setText(day.isoformat())

    def _try(self) -> None:
        try:
            self.person = self._read(date.today())
        except InputError as error:
            self.refusal.say(error.message)
            return
        self.accept()

    def _read(self, today: date) -> Person:
        """Return the person.

        Raises
        ------
        InputError
            Names the first field that cannot be right.
        """
        self._take_birth_date()
        born = read_day("born", self.born.text(), today)
        kind = self.kind.currentData()
        person = Person(
            name=check_name(self.name.text()),
            birth_date=date.fromisoformat(born) if born else None,
            personal_number=check_personal_number(self.number.text(), kind),
            consent_on=today if self.consent.isChecked() else None,
        )
        return replace(person, number_kind=kind if person.personal_number else "")


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
        self._allow("")
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
        allow(self.add, "" if person_id else tr("Choose a patient in the list first."))

    def _choose_current(self) -> None:
        self._choose(self.table.current_key)

    def _choose_new(self) -> None:
        self._choose("")

    def _choose(self, person_id: str) -> None:
        self.person_id = person_id
        self.accept()
