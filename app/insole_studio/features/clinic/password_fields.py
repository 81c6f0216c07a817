"""Two lines for a new password or passphrase, which have to agree."""

from __future__ import annotations

from PySide6.QtWidgets import QFormLayout, QLineEdit

from insole_core.errors import InputError
from insole_studio.texts import tr

MOST_CHARACTERS = 1000


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
