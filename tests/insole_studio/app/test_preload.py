"""What the first foot needs is loaded once the window is there."""

from __future__ import annotations

import sys

import pytest
from PySide6.QtCore import QObject
from PySide6.QtWidgets import QApplication
from pytestqt.qtbot import QtBot

from insole_studio.app import between_events


def test_modules_are_loaded_one_by_one_between_events(
    qapp: QApplication, qtbot: QtBot, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(between_events, "MODULES", ("wave", "sched"))
    for name in between_events.MODULES:
        monkeypatch.delitem(sys.modules, name, raising=False)
    owner = QObject()
    between_events.Preload(owner)
    assert not sys.modules.keys() & {"wave", "sched"}, "nothing is loaded before the first event"
    qtbot.waitUntil(lambda: "wave" in sys.modules)
    assert "sched" not in sys.modules
    qtbot.waitUntil(lambda: "sched" in sys.modules)


def test_a_window_that_is_closed_loads_no_more(
    qapp: QApplication, qtbot: QtBot, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(between_events, "MODULES", ("wave",))
    monkeypatch.delitem(sys.modules, "wave", raising=False)
    owner = QObject()
    between_events.Preload(owner)
    del owner
    qtbot.wait(3 * between_events.PAUSE_MS)
    assert "wave" not in sys.modules
