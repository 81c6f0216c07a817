"""The dialogs of an import: how a table is read, and what becomes of every row or file."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from PySide6.QtCore import Signal
from PySide6.QtWidgets import (
    QCheckBox,
    QDialog,
    QDialogButtonBox,
    QFormLayout,
    QHBoxLayout,
    QRadioButton,
    QScrollArea,
    QVBoxLayout,
    QWidget,
)

from insole_core.cases.written_dates import DateOrder
from insole_core.messages import counted
from insole_core.records.person import Person
from insole_core.records.person_import import Outcome
from insole_core.records.person_table import IMPORTED, ColumnMapping
from insole_core.records.text_table import Reading, TextTable
from insole_core.visible_text import visible_line, visible_value
from insole_studio.features.records.record_form import choice_box
from insole_studio.texts import tr, translate_core_message, with_capital
from insole_studio.widgets.form_parts import ComboBox, allow
from insole_studio.widgets.message_label import MessageLabel
from insole_studio.widgets.row_table import RowTable, TableRow

_SIZE_PX = (860, 640)

_COLUMNS_PX = 220
_LONGEST_EXAMPLE = 40
_ENCODINGS = {
    "cp1252": "Windows-1252",
    "cp1254": "Windows-1254",
    "cp1250": "Windows-1250",
    "cp1257": "Windows-1257",
    "cp1251": "Windows-1251",
    "cp1253": "Windows-1253",
    "utf-8-sig": "UTF-8",
    "utf-16-le": "UTF-16",
    "utf-16-be": "UTF-16",
}
"""Codecs of Python as people call them."""

_WIDTH_PX = 480


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
        why_not = translate_core_message(sentence) or tr("The file is being read.")
        for button in (self.add_button, self.report_button):
            allow(button, with_capital(why_not))

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
        allow(self.report_button, "" if self.rows else tr("There is nothing to report."))
        self._show_button()

    @property
    def _adds_doubtful(self) -> bool:
        return self.with_doubtful.isChecked() and self._count(Outcome.DOUBTFUL) > 0

    def _show_button(self) -> None:
        count = self._count(Outcome.NEW)
        count += self._count(Outcome.DOUBTFUL) if self._adds_doubtful else 0
        self.add_button.setText(tr("Add {count}").format(count=count))
        allow(self.add_button, "" if count else tr("There is nobody to add."))

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


class TableImportDialog(ImportDialog):
    """Shows the columns of a table with an example each, and asks what they hold.

    Parameters
    ----------
    table
        As it was read.
    mapping
        What the headings propose.
    """

    mapping_changed = Signal()

    def __init__(
        self, table: TextTable, mapping: ColumnMapping, name: str, parent: QWidget | None = None
    ) -> None:
        title = tr("Import patients from {name}").format(name=name)
        super().__init__(title, tr("Row"), parent)
        self.reading = MessageLabel("quiet")
        self.reading.say(_reading(table))
        self.columns = [ComboBox(_fields()) for _ in table.headings]
        for box, field in zip(self.columns, mapping.fields, strict=True):
            box.show_value(field or "")
            box.edited.connect(self.mapping_changed)
        self.order = ComboBox(_orders())
        self.order.show_value(mapping.date_order or "")
        self.order.edited.connect(self.mapping_changed)
        self.kind = choice_box(Person, "number_kind")
        self.kind.show_value(mapping.number_kind)
        self.kind.edited.connect(self.mapping_changed)
        self._others = QFormLayout()
        self.mapping_changed.connect(self._ask_kind)
        self._lay_out(table)

    def ask_order(self, asked: bool) -> None:
        """Show or hide the question in which order dates are written."""
        self._others.setRowVisible(self.order, asked)

    @property
    def mapping(self) -> ColumnMapping:
        """What the user has chosen."""
        fields = tuple(box.currentData() or None for box in self.columns)
        order = self.order.currentData()
        return ColumnMapping(fields, DateOrder(order) if order else None, self.kind.currentData())

    def _lay_out(self, table: TextTable) -> None:
        form = QFormLayout()
        for number, (heading, box) in enumerate(zip(table.headings, self.columns, strict=True)):
            label = visible_value(heading) or tr("Column {number}").format(number=number + 1)
            box.setAccessibleName(label)
            box.setToolTip(_example(table, number))
            form.addRow(_label(label, _example(table, number)), box)
        columns = QWidget()
        columns.setLayout(form)
        scrolled = QScrollArea()
        scrolled.setWidgetResizable(True)
        scrolled.setWidget(columns)
        scrolled.setMinimumHeight(_COLUMNS_PX)
        self._others.addRow(tr("Dates such as 02/03/1970"), self.order)
        self._others.addRow(tr("Personal numbers"), self.kind)
        self.ask_order(False)
        self._ask_kind()
        self.head.addWidget(self.reading)
        self.head.addWidget(scrolled, 1)
        self.head.addLayout(self._others)

    def _ask_kind(self) -> None:
        """Ask for the kind of personal numbers if there are any."""
        asked = "personal_number" in self.mapping.fields
        self._others.setRowVisible(self.kind, asked)


def _fields() -> list[tuple[str, str]]:
    fields = ((name, translate_core_message(field.label)) for name, field in IMPORTED.items())
    return [("", tr("not imported")), *fields]


def _orders() -> list[tuple[str, str]]:
    return [
        ("", tr("choose")),
        (DateOrder.DAY_FIRST, tr("the day comes first")),
        (DateOrder.MONTH_FIRST, tr("the month comes first")),
    ]


def _reading(table: TextTable) -> str:
    delimiters = {",": tr("comma"), ";": tr("semicolon"), "\t": tr("tab")}
    delimiter = delimiters.get(table.delimiter, table.delimiter)
    encoding = _ENCODINGS.get(table.encoding, table.encoding.upper())
    rows = translate_core_message(counted(len(table.rows), "1 row", "{count} rows"))
    return ", ".join((rows, encoding, delimiter))


def _example(table: TextTable, number: int) -> str:
    """Return the first cell of a column that is not empty, shortened."""
    cells = (row.cells[number].strip() for row in table.rows)
    text = visible_line(" ".join(next(filter(None, cells), "").split()))
    return text if len(text) <= _LONGEST_EXAMPLE else f"{text[:_LONGEST_EXAMPLE]}…"


def _label(heading: str, example: str) -> str:
    return f"{heading}  ({example})" if example else heading


class CharacterSetDialog(QDialog):
    """Shows words of the file in every reading; none is chosen until the user has read them."""

    chosen = Signal(str)
    """The codec of the reading."""

    def __init__(
        self, name: str, readings: Sequence[Reading], parent: QWidget | None = None
    ) -> None:
        super().__init__(parent)
        self.setWindowTitle(tr("Import patients from {name}").format(name=name))
        self.setMinimumWidth(_WIDTH_PX)
        question = MessageLabel()
        question.say(
            tr("The file does not tell how its letters are stored. Which names are right?")
        )
        self.readings: dict[str, QRadioButton] = {}
        layout = QVBoxLayout(self)
        layout.setSpacing(12)
        layout.addWidget(question)
        for reading in readings:
            words, kind = ", ".join(reading.examples), translate_core_message(reading.name)
            button = QRadioButton(f"{words}   ({kind})".replace("&", "&&"))
            button.toggled.connect(self._allow)
            self.readings[reading.encoding] = button
            layout.addWidget(button)
        buttons = QDialogButtonBox()
        self.read = buttons.addButton(tr("Read it so"), QDialogButtonBox.ButtonRole.AcceptRole)
        allow(self.read, tr("Choose first which names are right."))
        buttons.addButton(tr("Cancel"), QDialogButtonBox.ButtonRole.RejectRole)
        buttons.accepted.connect(self._choose)
        buttons.rejected.connect(self.reject)
        layout.addWidget(buttons)

    def _allow(self) -> None:
        allow(self.read, "")

    def _choose(self) -> None:
        self.accept()
        self.chosen.emit(next(key for key, button in self.readings.items() if button.isChecked()))
