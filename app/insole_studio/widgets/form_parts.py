"""Parts of forms: labels, buttons, choices, folds, and a dialog that asks for several lines."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from html import escape

from PySide6.QtCore import QEvent, QSignalBlocker, Qt, Signal, SignalInstance
from PySide6.QtWidgets import (
    QDialog,
    QDialogButtonBox,
    QFormLayout,
    QLabel,
    QLineEdit,
    QPushButton,
    QToolButton,
    QVBoxLayout,
    QWidget,
)

from insole_studio.texts import tr
from insole_studio.widgets.elided_fields import ElidedComboBox

_WIDTH_PX = 460


def mark_labels(form: QFormLayout) -> None:
    """Mark the labels of a form for the theme's style sheet."""
    for row in range(form.rowCount()):
        item = form.itemAt(row, QFormLayout.ItemRole.LabelRole)
        label = None if item is None else item.widget()
        if label is not None:
            label.setProperty("form", True)


def allow(part: QWidget, why_not: str, tip: str = "") -> None:
    """Enable a button or a field, or let it say why it is not; an empty sentence enables it.

    Parameters
    ----------
    tip
        What it says otherwise.
    """
    part.setEnabled(not why_not)
    part.setToolTip(why_not or tip)
    part.setAccessibleDescription(why_not)


@dataclass(frozen=True)
class Field:
    """One line of text.

    Parameters
    ----------
    value
        The initial text.
    required
        Whether the dialog can only be accepted with a text here.
    """

    key: str
    label: str
    value: str = ""
    required: bool = True


class FieldsDialog(QDialog):
    """A form of lines; it can be accepted once every required one is filled in."""

    def __init__(
        self, title: str, sentence: str, fields: Sequence[Field], parent: QWidget | None = None
    ) -> None:
        super().__init__(parent)
        self.setWindowTitle(title)
        self.setMinimumWidth(_WIDTH_PX)
        self.lines = {field.key: QLineEdit(field.value) for field in fields}
        self._required = {field.key: field.label for field in fields if field.required}
        words = QLabel(sentence)
        words.setWordWrap(True)
        form = QFormLayout()
        form.setFieldGrowthPolicy(QFormLayout.FieldGrowthPolicy.AllNonFixedFieldsGrow)
        for field in fields:
            form.addRow(field.label, self.lines[field.key])
            self.lines[field.key].textChanged.connect(self._allow)
        mark_labels(form)
        self.buttons = QDialogButtonBox()
        self.accept_button = self.buttons.addButton(
            tr("Use these"), QDialogButtonBox.ButtonRole.AcceptRole
        )
        self.buttons.addButton(tr("Cancel"), QDialogButtonBox.ButtonRole.RejectRole)
        self.buttons.accepted.connect(self.accept)
        self.buttons.rejected.connect(self.reject)
        layout = QVBoxLayout(self)
        layout.setSpacing(12)
        for part in (words, form, self.buttons):
            if isinstance(part, QFormLayout):
                layout.addLayout(part)
            else:
                layout.addWidget(part)
        self._allow()
        self._focus_first_gap()

    def texts(self) -> dict[str, str]:
        """Return the texts by key."""
        return {key: line.text().strip() for key, line in self.lines.items()}

    def _allow(self) -> None:
        texts = self.texts()
        gaps = ", ".join(label for key, label in self._required.items() if not texts[key])
        allow(self.accept_button, tr("Still missing: {names}").format(names=gaps) if gaps else "")

    def _focus_first_gap(self) -> None:
        gaps = [key for key in self._required if not self.lines[key].text()]
        if gaps:
            self.lines[gaps[0]].setFocus()


def plain_button(
    text: str, run: Callable[..., object] | SignalInstance | None = None
) -> QPushButton:
    """Return a button that only a click on it or Space presses; `run` is what it does."""
    button = QPushButton(text)
    button.setAutoDefault(False)
    if run is not None:
        button.clicked.connect(run)
    return button


class ComboBox(ElidedComboBox):
    """A combo box that shows texts and returns the stored values."""

    edited = Signal(str)
    """Emitted when the user, not the program, chose another value."""

    def __init__(self, options: Sequence[tuple[str, str]], parent: QWidget | None = None) -> None:
        super().__init__(parent)
        for word, text in options:
            self.addItem(text, word)
        self.activated.connect(self._pass_on)

    def show_value(self, word: str) -> None:
        """Select a value without emitting `edited`."""
        with QSignalBlocker(self):
            self.setCurrentIndex(self.findData(word))

    def _pass_on(self, number: int) -> None:
        self.edited.emit(self.itemData(number))


class Fold(QToolButton):
    """The heading of what is rarely needed; a click or Space opens and closes it.

    Parameters
    ----------
    text
        What is below it.
    content
        The widgets that it shows and hides; what else depends on it follows `toggled`.
    """

    def __init__(
        self, text: str, content: Sequence[QWidget] = (), parent: QWidget | None = None
    ) -> None:
        super().__init__(parent)
        self._content = content
        self.setObjectName("fold")
        self.setText(text)
        self.setAccessibleName(text)
        self.setCheckable(True)
        self.setAutoRaise(True)
        self.setToolButtonStyle(Qt.ToolButtonStyle.ToolButtonTextBesideIcon)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.toggled.connect(self._show)
        self._show(False)

    def _show(self, is_open: bool) -> None:
        self.setArrowType(Qt.ArrowType.DownArrow if is_open else Qt.ArrowType.RightArrow)
        for widget in self._content:
            widget.setVisible(is_open)


class LinkLabel(QLabel):
    """A link for mouse and keyboard, in the theme's colour of plain text.

    Rich text does not inherit its colour: without this it would be black on a dark background.

    Parameters
    ----------
    words
        The text of the link.
    target
        Argument of `linkActivated`.
    underlined
        Whether to underline the text.
    """

    def __init__(self, words: str, target: str, underlined: bool = True) -> None:
        super().__init__()
        self._words, self._target = words, target
        self._decoration = "underline" if underlined else "none"
        self.setTextFormat(Qt.TextFormat.RichText)
        self.setWordWrap(True)
        by = Qt.TextInteractionFlag
        self.setTextInteractionFlags(by.LinksAccessibleByMouse | by.LinksAccessibleByKeyboard)
        self._write()

    def say(self, words: str) -> None:
        """Show another text that leads to the same."""
        if words != self._words:
            self._words = words
            self._write()

    def changeEvent(self, event: QEvent) -> None:
        """Follow changes of the theme."""
        super().changeEvent(event)
        if event.type() == QEvent.Type.PaletteChange:
            self._write()

    def _write(self) -> None:
        color = self.palette().color(self.foregroundRole()).name()
        style = f"color: {color}; text-decoration: {self._decoration}"
        self.setText(f'<a href="{escape(self._target)}" style="{style}">{escape(self._words)}</a>')
