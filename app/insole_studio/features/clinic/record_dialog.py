"""A dialog that asks the record: its answers and refusals are told in it; and new passwords."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, TypeVar

from PySide6.QtCore import Qt
from PySide6.QtGui import QKeyEvent, QShowEvent
from PySide6.QtWidgets import (
    QDialog,
    QDialogButtonBox,
    QFormLayout,
    QLineEdit,
    QPushButton,
    QVBoxLayout,
    QWidget,
)
from shiboken6 import isValid

from insole_core.errors import InputError, InsoleError
from insole_studio.document.clinic_record import ClinicRecord
from insole_studio.texts import tr
from insole_studio.widgets.message_label import MessageLabel
from insole_studio.widgets.tab_order import tab_stops

if TYPE_CHECKING:
    from insole_core.records.records import Records

Answer = TypeVar("Answer")
Done = Callable[[Answer], None]
MOST_CHARACTERS = 1000


class RecordDialog(QDialog):
    """A dialog with content above a message and buttons; it is gone once it is closed.

    Parameters
    ----------
    clinic
        The record; its answers are dropped once the dialog is closed.
    """

    def __init__(self, title: str, clinic: ClinicRecord, parent: QWidget | None) -> None:
        super().__init__(parent)
        self.setWindowTitle(title)
        self.clinic = clinic
        self.content = QVBoxLayout()
        self.content.setSpacing(12)
        self.message = MessageLabel()
        self.buttons = QDialogButtonBox()
        self.close_button = self.buttons.addButton(
            tr("Close"), QDialogButtonBox.ButtonRole.RejectRole
        )
        self.close_button.setAutoDefault(False)  # else Enter in a line closes the dialog
        self.buttons.rejected.connect(self.reject)
        layout = QVBoxLayout(self)
        layout.setSpacing(12)
        layout.addLayout(self.content, 1)
        layout.addStretch()  # so that the message stays small where there is nothing else
        layout.addWidget(self.message)
        layout.addWidget(self.buttons)
        self.finished.connect(self.deleteLater)

    def add_button(self, text: str, run: Callable[[], object]) -> QPushButton:
        """Add a button to the row at the bottom; Enter does not press it."""
        button = self.buttons.addButton(text, QDialogButtonBox.ButtonRole.ActionRole)
        button.setAutoDefault(False)
        button.clicked.connect(run)
        return button

    def make_primary(self, button: QPushButton) -> None:
        """Let a button stand out: it does what the dialog is for."""
        button.setObjectName("primary")
        button.style().unpolish(button)  # it was polished as it was added
        button.style().polish(button)

    def say(self, sentence: str, *, warns: bool = False) -> None:
        """Show a sentence above the buttons; an empty one hides it."""
        self.say_all([sentence] if sentence else [], warns=warns)

    def say_all(self, sentences: list[str], *, warns: bool = False) -> None:
        """Show sentences above the buttons, one below the other."""
        self.message.setObjectName("warning" if warns else "")
        self.message.style().polish(self.message)  # the style sheet depends on the name
        self.message.say_all(sentences)
        self.make_room()

    def make_room(self) -> None:
        """Grow by what has come into the dialog, so that its fields keep their height."""
        layout = self.layout()
        if layout is None or not self.isVisible():
            return
        layout.activate()
        needed = layout.totalHeightForWidth(self.width())
        if needed > self.height():
            self.resize(self.width(), needed)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Let Enter press the button that has the focus, and not the one for Enter in a line."""
        focused = self.focusWidget()
        is_enter = event.key() in (Qt.Key.Key_Return, Qt.Key.Key_Enter)
        if is_enter and isinstance(focused, QPushButton):
            focused.click()
        else:
            super().keyPressEvent(event)

    def showEvent(self, event: QShowEvent) -> None:
        """Give the focus to the first field, unless the dialog has chosen one."""
        super().showEvent(event)
        if isinstance(self.focusWidget(), QPushButton | None):
            stops = tab_stops(self)
            field = next((stop for stop in stops if not isinstance(stop, QPushButton)), None)
            if field is not None:
                field.setFocus(Qt.FocusReason.OtherFocusReason)

    def ask(self, question: Callable[[Records], Answer], done: Done[Answer]) -> None:
        """Ask the record; a later question of the same kind of dialog replaces this one."""
        channel = f"clinic-{type(self).__name__}"
        self.clinic.ask(channel, question, self.while_open(done), self.while_open(self.refuse))

    def change(self, change: Callable[[Records], Answer], done: Done[Answer]) -> None:
        """Change the record; nothing can be pressed until the answer is there."""
        self.setEnabled(False)

        def told(answer: Answer) -> None:
            self.setEnabled(True)
            done(answer)

        self.clinic.write(change, self.while_open(told), self.while_open(self.refuse))

    def while_open(self, call: Done[Answer]) -> Done[Answer]:
        """Return a function that calls `call` unless the dialog has been closed meanwhile."""

        def guarded(answer: Answer) -> None:
            if isValid(self):
                call(answer)

        return guarded

    def refuse(self, error: Exception) -> None:
        """Tell why something was not done."""
        self.setEnabled(True)
        if not isinstance(error, InsoleError):
            raise error
        self.say(error.message, warns=True)


def secret_line() -> QLineEdit:
    """Return a line that does not show what is typed."""
    line = QLineEdit()
    line.setEchoMode(QLineEdit.EchoMode.Password)
    line.setMaxLength(MOST_CHARACTERS)
    return line


def password_hint() -> str:
    """Say what a password has to be."""
    return tr("At least 12 characters, such as four words; capitals and signs are not asked for.")


class PasswordFields:
    """The lines, to be added to a form."""

    def __init__(self) -> None:
        self.first = secret_line()
        self.again = secret_line()

    def add_to(self, form: QFormLayout, label: str) -> None:
        """Add both lines to a form."""
        form.addRow(label, self.first)
        form.addRow(tr("The same again"), self.again)

    def clear(self) -> None:
        """Forget what was typed."""
        self.first.clear()
        self.again.clear()

    def read(self) -> str:
        """Return what was typed.

        Raises
        ------
        InputError
            When the lines differ.
        """
        if self.first.text() != self.again.text():
            raise InputError("The two lines are not the same; type both again.")
        return self.first.text()
