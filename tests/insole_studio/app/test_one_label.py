"""One thing has one name, wherever the window offers or tells it."""

from __future__ import annotations

from collections.abc import Callable, Iterator

import numpy as np
import pytest
from PySide6.QtCore import Qt
from PySide6.QtGui import QAction
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QAbstractButton, QLabel, QWidget

from insole_core.cases.scan_source import ScanSource
from insole_core.foot.foot import Foot
from insole_core.geometry.side import Side
from insole_core.insole.elements import Pelott, Posting
from insole_core.insole.fields import Spot
from insole_studio.app.actions import ACTIONS
from insole_studio.app.bootstrap import Application
from insole_studio.app.menus import LANGUAGE_KEYS
from insole_studio.features.design.correction_names import name_of
from insole_studio.features.records.visit_card import VisitCard
from insole_studio.scene.pointer import Phase, PointerEvent
from insole_studio.scene.view_camera import Subject

pytestmark = pytest.mark.one_window

ACTIONS_BY_KEY = {record.key: record for record in ACTIONS}
SAYS_MORE = {"lock", "toggle_as_scanned"}
"""Actions that a button names by what comes of it there: signing in, the one of two states."""


def offers(window: QWidget) -> Iterator[tuple[str, str]]:
    """Give key and text of everything in a window that offers an action."""
    for button in window.findChildren(QAbstractButton):
        key = button.property("action") or button.property("offer")
        is_of_visit = isinstance(button.parent(), VisitCard)  # whose actions are its own
        if isinstance(key, str) and button.text() and not is_of_visit:
            yield key.removeprefix("action."), button.text()
    for entry in window.findChildren(QAction):
        if isinstance(entry.data(), str):
            yield entry.data(), entry.text()


def test_what_offers_an_action_calls_it_as_its_menu_does(
    clinic: Application, rest: Callable[[], None], make_foot: Callable[[Side], Foot]
) -> None:
    records = clinic.features.records
    records.sample.show()
    rest()
    records.show_orders()
    seen = dict(offers(clinic.window))
    clinic.window.show_panels()
    seen |= dict(offers(clinic.window))
    clinic.case.open_foot(make_foot(Side.LEFT), ScanSource("mesh", "/nowhere/f.ply", "0" * 64))
    for tool in ("key_point", "plantar"):
        clinic.window.actions_by_key[f"tool_{tool}"].trigger()
        rest()
        seen |= dict(offers(clinic.window))
    found = {key: text for key, text in seen.items() if key in ACTIONS_BY_KEY.keys() - SAYS_MORE}
    assert {"open_archive", "calibrate", "new_patient", "lay_pressure"} <= found.keys()
    names = {
        key: {record.text(), record.text() if record.short is None else record.short()}
        for key, record in ACTIONS_BY_KEY.items()
    }
    assert {key: text for key, text in found.items() if text not in names[key]} == {}


def test_a_tool_is_called_as_the_correction_that_it_makes(opened: Application) -> None:
    posting, pelott = Posting(rearfoot_deg=4.0), Pelott(centre_mm=(0.0, 150.0))
    for tool, correction in (("posting", posting), ("pelott", pelott)):
        assert ACTIONS_BY_KEY[f"tool_{tool}"].text() == name_of(correction)
    assert ACTIONS_BY_KEY["add_posting"].text() == name_of(posting)
    opened.window.actions_by_key["tool_posting"].trigger()
    headings = opened.stage.parameters.findChildren(QLabel, "heading")
    assert name_of(posting) in [heading.text() for heading in headings]


@pytest.mark.parametrize("side", Side)
def test_the_pointer_tells_a_place_by_the_names_of_its_fields(
    opened: Application, make_foot: Callable[[Side], Foot], side: Side
) -> None:
    opened.case.open_foot(make_foot(side), ScanSource("mesh", "/nowhere/f.ply", "0" * 64))
    told: list[str] = []
    opened.stage.pointed.connect(told.append)
    view = opened.stage.foot.scene
    place = np.array([3.0, 153.34, 6.0])
    view.hovered.emit(PointerEvent(Phase.MOVE, Subject.FOOT, view.look, (0.0, 0.0), place))
    labels = [label for label, _ in Spot.each]
    medial = {Side.LEFT: "3.0", Side.RIGHT: "-3.0"}[side]
    assert told == [f"{labels[0]} {medial} mm   {labels[1]} 153.3 mm   Height 6.0 mm"]


def status_texts(app: Application) -> list[str]:
    labels = app.window.status.findChildren(QLabel)
    return [label.text() for label in labels if label.isVisible() and label.text()]


def test_a_page_of_the_record_tells_nothing_of_a_tool(
    clinic: Application, rest: Callable[[], None], make_foot: Callable[[Side], Foot]
) -> None:
    window = clinic.window
    clinic.case.open_foot(make_foot(Side.LEFT), ScanSource("mesh", "/nowhere/f.ply", "0" * 64))
    rest()
    window.actions_by_key["tool_pelott"].trigger()
    clinic.services.messages.say("All landmarks are confirmed.")
    clinic.stage.pointed.emit("From axis 1.0")
    hint = clinic.stage.tool_controller.tool.hint(clinic.case)
    QTest.keyClick(window, Qt.Key.Key_F3)
    assert window.page is not None
    assert window.status.currentMessage() == ""
    assert not {hint, "From axis 1.0"} & set(status_texts(clinic))
    window.show_panels()
    assert hint in status_texts(clinic)


def test_another_tool_ends_what_was_said_of_the_one_before(opened: Application) -> None:
    opened.services.messages.say("All landmarks are confirmed.")
    opened.window.actions_by_key["tool_pelott"].trigger()
    assert opened.window.status.currentMessage() == ""


def test_one_language_alone_carries_the_mark(app: Application) -> None:
    entries = {key: app.window.actions_by_key[key] for key in LANGUAGE_KEYS}
    for key in LANGUAGE_KEYS:
        entries[key].trigger()
        assert [name for name, entry in entries.items() if entry.isChecked()] == [key]
