"""Forms of the record: an editor for each field that somebody fills in, as it is declared."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, TypeAlias

from PySide6.QtWidgets import QLineEdit, QPlainTextEdit

from insole_core.records.record_field import Choice, Day, Line, Lines, Typed, typed_fields
from insole_studio.texts import localised, translate_core_message
from insole_studio.widgets.date_field import DateField
from insole_studio.widgets.form_parts import ComboBox
from insole_studio.widgets.text_fields import NotesField

if TYPE_CHECKING:
    from _typeshed import DataclassInstance

Editor: TypeAlias = QLineEdit | QPlainTextEdit | ComboBox


def new_editor(field: Typed) -> Editor:
    """Return what a field is filled in with."""
    if isinstance(field, Choice):
        return _choice_box(field)
    if isinstance(field, Day):
        return DateField()
    if isinstance(field, Lines) and not field.is_low:
        return NotesField()
    return new_line(field)


def new_line(field: Typed) -> QLineEdit:
    """Return what a field of one line is filled in with."""
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
