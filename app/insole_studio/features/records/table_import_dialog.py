"""The import of a table: which column holds what, chosen by hand."""

from __future__ import annotations

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QFormLayout, QScrollArea, QWidget

from insole_core.cases.written_dates import DateOrder
from insole_core.records.person import Person
from insole_core.records.person_table import IMPORTED, ColumnMapping
from insole_core.records.text_table import TextTable
from insole_core.visible_text import visible_line, visible_value
from insole_studio.features.records.import_dialog import ImportDialog
from insole_studio.features.records.record_form import choice_box
from insole_studio.texts import tr, translate_core_message
from insole_studio.widgets.combo_box import ComboBox
from insole_studio.widgets.message_label import MessageLabel

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
    return tr("{rows} rows, {encoding}, {delimiter}").format(
        rows=len(table.rows), encoding=encoding, delimiter=delimiter
    )


def _example(table: TextTable, number: int) -> str:
    """Return the first cell of a column that is not empty, shortened."""
    cells = (row.cells[number].strip() for row in table.rows)
    text = visible_line(" ".join(next(filter(None, cells), "").split()))
    return text if len(text) <= _LONGEST_EXAMPLE else f"{text[:_LONGEST_EXAMPLE]}…"


def _label(heading: str, example: str) -> str:
    return f"{heading}  ({example})" if example else heading
