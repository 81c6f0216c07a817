"""Answers the dialog that asks about a scan, as a user does."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication

from insole_core.geometry.side import Side
from insole_studio.app.bootstrap import Application
from insole_studio.features.import_scan.import_dialog import ImportDialog

LEFT_BUTTON = Qt.MouseButton.LeftButton


def asked_scan(app: Application) -> ImportDialog | None:
    """Return the dialog that asks about a scan; None where none does."""
    dialogs = app.window.findChildren(ImportDialog)
    return next((dialog for dialog in dialogs if dialog.isVisible()), None)


def insist_on(app: Application, settle: Callable[[], None], side: Side) -> None:
    """Open the scan that is asked about as a foot of a side, whatever speaks against it."""
    dialog = asked_scan(app)
    assert dialog is not None
    QTest.mouseClick(dialog.sides[side], LEFT_BUTTON)
    while asked_scan(app) is not None:
        assert dialog.open_button.isEnabled()
        QTest.mouseClick(dialog.open_button, LEFT_BUTTON)
        settle()
    app.window.activateWindow()  # as a window manager does when a dialog is closed
    QApplication.processEvents()
