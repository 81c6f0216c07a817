"""Forms of the record: an editor for each field that somebody fills in, as it is declared."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from datetime import date
from typing import TYPE_CHECKING, Any, Generic, TypeAlias, TypeVar

from PySide6.QtWidgets import (
    QDialog,
    QDialogButtonBox,
    QFormLayout,
    QLineEdit,
    QPlainTextEdit,
    QVBoxLayout,
    QWidget,
)

from insole_core.errors import InputError
from insole_core.records.record_field import Choice, Day, Line, Lines, Typed, typed_fields
from insole_studio.texts import localised, tr, translate_core_message
from insole_studio.widgets.combo_box import ComboBox
from insole_studio.widgets.date_field import DateField
from insole_studio.widgets.form_labels import mark_labels
from insole_studio.widgets.message_label import MessageLabel
from insole_studio.widgets.notes_field import NotesField

if TYPE_CHECKING:
    from _typeshed import DataclassInstance

Editor: TypeAlias = QLineEdit | QPlainTextEdit | ComboBox
Value = TypeVar("Value", bound="DataclassInstance")

_WIDTH_PX = 460


def new_editor(field: Typed) -> Editor:
    """Return what a field is filled in with."""
    if isinstance(field, Choice):
        return _choice_box(field)
    if isinstance(field, Day):
        return DateField()
    if isinstance(field, Lines) and not field.is_low:
        return NotesField()
    line = QLineEdit()
    if isinstance(field, Line | Lines):
        line.setMaxLength(field.most + 1)  # one more, so that too long a text is told
    return line


def choice_box(kind: type[object], name: str) -> ComboBox:
    """Return the editor of a field that holds one of a few words."""
    field = typed_fields(kind)[name]
    assert isinstance(field, Choice), name
    return _choice_box(field)


def _choice_box(field: Choice) -> ComboBox:
    names = field.names.items()
    box = ComboBox([(word, translate_core_message(name)) for word, name in names])
    box.setAccessibleName(translate_core_message(field.label))
    return box


def show_text(editor: Editor, text: str) -> None:
    """Show the text of a field in its editor."""
    if isinstance(editor, ComboBox):
        editor.show_value(text)
    elif isinstance(editor, QPlainTextEdit):
        editor.setPlainText(text)
    else:
        editor.setText(text)


def text_in(editor: Editor) -> str:
    """Return what was typed or chosen."""
    if isinstance(editor, ComboBox):
        return str(editor.currentData())
    return editor.toPlainText() if isinstance(editor, QPlainTextEdit) else editor.text()


def shown_text(field: Typed, value: Any) -> str:
    """Return a value as the language of the window writes it."""
    return localised(value, "g") if isinstance(value, float) else field.written(value)


def shown_texts(value: DataclassInstance) -> dict[str, str]:
    """Return the fields of a value as their editors show them."""
    fields = typed_fields(type(value))
    return {name: shown_text(field, getattr(value, name)) for name, field in fields.items()}


def label_of(kind: type[object], name: str) -> str:
    """Return what a field is called in forms."""
    return translate_core_message(typed_fields(kind)[name].label)


class RecordDialog(QDialog, Generic[Value]):
    """A form of all fields of a value; it is accepted once all that is typed can be right.

    Attributes
    ----------
    value
        As it was typed, once it is accepted.
    typed
        The fields alone, by their names.
    """

    def __init__(self, title: str, value: Value, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setWindowTitle(title)
        self.setMinimumWidth(_WIDTH_PX)
        self.value = value
        self.typed: Mapping[str, Any] = {}
        kind = type(value)
        self.editors = {name: new_editor(f) for name, f in typed_fields(kind).items()}
        for name, text in shown_texts(value).items():
            show_text(self.editors[name], text)
        self.refusal = MessageLabel("warning")
        self.form = QFormLayout()
        self.form.setFieldGrowthPolicy(QFormLayout.FieldGrowthPolicy.AllNonFixedFieldsGrow)
        for name, editor in self.editors.items():
            self.form.addRow(label_of(kind, name), editor)
        mark_labels(self.form)
        buttons = QDialogButtonBox()
        role = QDialogButtonBox.ButtonRole
        self.keep = buttons.addButton(tr("Keep"), role.AcceptRole)
        buttons.addButton(tr("Cancel"), role.RejectRole)
        buttons.accepted.connect(self._try)
        buttons.rejected.connect(self.reject)
        self.below = QVBoxLayout()
        layout = QVBoxLayout(self)
        layout.setSpacing(12)
        layout.addLayout(self.form)
        layout.addLayout(self.below)
        layout.addWidget(self.refusal)
        layout.addWidget(buttons)

    def read(self, today: date) -> Value:
        """Return the value as it was typed; a needed day that was emptied stays.

        Raises
        ------
        InputError
            Names the first field that cannot be right.
        """
        fields = typed_fields(type(self.value))
        read = {n: fields[n].read(text_in(editor), today) for n, editor in self.editors.items()}
        self.typed = {n: v for n, v in read.items() if v is not None or not fields[n].is_needed}
        return replace(self.value, **self.typed)

    def _try(self) -> None:
        try:
            self.value = self.read(date.today())
        except InputError as error:
            self.refusal.say(error.message)
        else:
            self.accept()
