"""What a user of the administration does."""

from __future__ import annotations

from typing import TypeVar

from PySide6.QtTest import QTest
from PySide6.QtWidgets import QLineEdit

from insole_studio.app.bootstrap import Application
from insole_studio.features.clinic.record_dialog import RecordDialog
from insole_studio.features.clinic.sign_in_dialog import SignInDialog

Dialog = TypeVar("Dialog", bound=RecordDialog)
PASSWORD, OTHER_PASSWORD = "four words in a row", "quite some other words"


def shown(clinic: Application, kind: type[Dialog]) -> Dialog:
    """Return the dialog of a kind that is open."""
    (dialog,) = [d for d in clinic.window.findChildren(kind) if d.isVisible()]
    return dialog


def type_into(field: QLineEdit, text: str) -> None:
    """Replace what is in a line."""
    field.setFocus()
    field.selectAll()
    QTest.keyClicks(field, text)


def sign_in(dialog: SignInDialog, name: str, password: str) -> None:
    """Sign in as a user does."""
    type_into(dialog.name, name)
    type_into(dialog.password, password)
    dialog.sign_in.click()
