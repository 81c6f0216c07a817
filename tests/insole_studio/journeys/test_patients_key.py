"""F3 leads to the patients from the windows of the stages, too."""

from __future__ import annotations

from collections.abc import Callable

import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication
from pytestqt.qtbot import QtBot

from insole_studio.app.bootstrap import Application


@pytest.mark.parametrize(
    ("key", "closes"), [("export", True), ("compare", True), ("capture", False)]
)
def test_it_leads_there_and_closes_what_keeps_nothing(
    opened: Application, settle: Callable[[], None], qtbot: QtBot, key: str, closes: bool
) -> None:
    app = opened
    app.window.actions_by_key[key].trigger()
    settle()
    feature = getattr(app.features, key)
    stage = feature.stage
    assert stage is not None
    stage.activateWindow()
    qtbot.waitUntil(lambda: QApplication.activeWindow() is stage)
    QTest.keyClick(stage, Qt.Key.Key_F3)
    qtbot.waitUntil(lambda: app.window.page is app.features.records.start)
    assert (feature.stage is None) == closes
    feature.close()
