"""Garbage is collected by the timer of the window, never in the midst of an event."""

from __future__ import annotations

import gc
import weakref

from pytestqt.qtbot import QtBot

from insole_studio.app import between_events
from insole_studio.app.between_events import GarbageCollection


class Cycle:
    def __init__(self) -> None:
        self.myself = self


def test_cycles_go_with_the_timer_and_not_before(qtbot: QtBot, monkeypatch) -> None:
    monkeypatch.setattr(between_events, "INTERVAL_MS", 20)
    garbage = GarbageCollection()
    assert not gc.isenabled()
    gone = weakref.ref(Cycle())
    kept = [[] for _ in range(gc.get_threshold()[0] + 100)]  # Python itself would collect here
    assert gone() is not None
    qtbot.waitUntil(lambda: gone() is None)
    assert kept
    garbage.deleteLater()


def test_what_a_case_has_left_does_not_wait_until_the_oldest_generation_is_due(
    qtbot: QtBot, monkeypatch
) -> None:
    monkeypatch.setattr(between_events, "INTERVAL_MS", 20)
    garbage = GarbageCollection()
    stage = Cycle()
    gone = weakref.ref(stage)
    gc.collect()  # it is old when it is left
    del stage
    garbage.leave_case()
    qtbot.waitUntil(lambda: gone() is None)
    garbage.deleteLater()
