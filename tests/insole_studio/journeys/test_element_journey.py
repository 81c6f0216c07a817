"""Elements of the library and an arch to a height, by the menus, the mouse and the keyboard."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from pointing import LEFT, drag, pixel
from PySide6.QtCore import QPoint, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QLabel, QMenu, QToolButton, QWidget

from insole_core.cases.scan_source import ScanSource
from insole_core.foot.foot import Foot
from insole_core.foot.landmarks import HEADS
from insole_core.geometry.side import Side
from insole_core.insole.elements import ArchRaise, Correction, Pelott
from insole_core.insole.pads.pad_heights import pad_heights
from insole_core.insole.pads.pad_shapes import pad_size
from insole_core.workflows.foot_landmarks import landmarks_of
from insole_core.workflows.pad_library import load_pads
from insole_studio.app.bootstrap import Application
from insole_studio.features.design.correction_names import describe, name_of
from insole_studio.features.design.pad_menu import PadEntry, PadMenu, pad_menu
from insole_studio.features.design.parameters.correction_fields import field_specs
from insole_studio.features.design.rows import FieldSpec
from insole_studio.scene.scene_view import SceneView
from insole_studio.texts import load_language
from insole_studio.widgets.number_field import NumberField

pytestmark = pytest.mark.one_window

MOST_ROWS = 16


@pytest.fixture
def foot(opened: Application) -> SceneView:
    return opened.stage.foot.scene


def take_entry(menu: QMenu, text: str) -> QMenu:
    """Take an entry of an open menu, and return the menu that it opens, or the menu itself."""
    (action,) = (a for a in menu.actions() if a.text().split("   ")[0].replace("&", "") == text)
    submenu = action.menu()
    if not isinstance(submenu, QMenu):
        QTest.mouseClick(menu, LEFT, pos=menu.actionGeometry(action).center())
        return menu
    while menu.activeAction() is not action:
        QTest.keyClick(menu, Qt.Key.Key_Down)
    QTest.keyClick(menu, Qt.Key.Key_Right)
    assert submenu.isVisible()
    return submenu


def choose_in_menu_bar(app: Application, *texts: str) -> None:
    bar = app.window.menuBar()
    (first,) = (a for a in bar.actions() if a.text().replace("&", "") == texts[0])
    place = bar.mapTo(app.window, bar.actionGeometry(first).center())
    QTest.mouseClick(app.window.windowHandle(), LEFT, Qt.KeyboardModifier.NoModifier, place)
    menu = first.menu()
    assert isinstance(menu, QMenu)
    for text in texts[1:]:
        menu = take_entry(menu, text)


def choose_pad(app: Application, *texts: str) -> None:
    """Choose a pad in the menu beside the tool."""
    bar = app.window.findChildren(QToolButton)
    (button,) = (b for b in bar if b.defaultAction() is app.window.actions_by_key["tool_pelott"])
    menu = button.menu()
    assert isinstance(menu, QMenu)
    menu.popup(button.mapToGlobal(QPoint(0, button.height())))
    for text in texts:
        menu = take_entry(menu, text)


def corrections(app: Application) -> tuple[Correction, ...]:
    assert app.case.record.design is not None
    return app.case.record.design.corrections


def field(app: Application, key: str) -> NumberField:
    (found,) = (
        f
        for f in app.stage.parameters.findChildren(NumberField)
        if f.property("key") == key and f.isVisible()
    )
    return found


def act(app: Application, key: str) -> None:
    app.window.actions_by_key[key].trigger()


def type_into(widget: QWidget, text: str) -> None:
    assert isinstance(widget, NumberField)
    QTest.mouseDClick(widget.lineEdit(), LEFT)
    widget.selectAll()
    QTest.keyClicks(widget, text)
    QTest.keyClick(widget, Qt.Key.Key_Return)


def values_of_selected(app: Application) -> dict[str, float]:
    """What the panel shows of the selected correction, which is what the design says of it."""
    design, selection, side = app.case.record.design, app.case.selection, app.case.record.side
    assert design is not None
    assert selection is not None
    assert side is not None
    selected = design.correction(selection)
    assert selected is not None
    panel = app.stage.parameters
    shown = {
        f.property("key"): f.value()
        for f in panel.findChildren(NumberField)
        if f.isVisible() and f.property("key").startswith("correction.")
    }
    specs = field_specs(selected, "correction", side)
    told = {spec.key: spec.value for spec in specs if isinstance(spec, FieldSpec)}
    assert shown == pytest.approx(told, abs=0.05)
    titles = [label.text() for label in panel.findChildren(QLabel) if label.isVisible()]
    assert name_of(selected) in titles
    return shown


def test_the_panel_shows_the_selected_element_whatever_was_selected_before(
    opened: Application, settle: Callable[[], None], make_foot: Callable[[Side], Foot]
) -> None:
    library = ("Prescribe", "Pad of the library", "Forefoot", "Relief under a head")
    choose_in_menu_bar(opened, *library, "Relief under the 2nd head")
    choose_in_menu_bar(opened, *library, "Relief under the 3rd head")
    choose_in_menu_bar(opened, "Prescribe", "Arch to a height")
    settle()
    second, third, arch = (each.id for each in corrections(opened))

    def select(correction: str) -> dict[str, float]:
        opened.case.select(correction)
        return values_of_selected(opened)

    height = "correction.height_mm"
    of_arch = select(arch)
    kept = field(opened, "correction.target_mm")
    assert select(second)[height] == 2.0
    type_into(field(opened, height), "1.5")
    assert select(third)[height] == 2.0
    assert select(second)[height] == 1.5
    assert select(arch) == of_arch
    assert field(opened, "correction.target_mm") is kept
    type_into(kept, "33")
    select(third)
    opened.case.undo()
    assert select(arch) == of_arch
    opened.case.undo()
    assert select(second)[height] == 2.0
    opened.case.select(None)
    act(opened, "variant_duplicate")
    assert select(corrections(opened)[0].id)[height] == 2.0
    type_into(field(opened, height), "1")
    act(opened, "variant_next")
    assert select(corrections(opened)[0].id)[height] == 2.0

    place = select(corrections(opened)[0].id)["correction.centre_mm.0"]
    act(opened, "mirror_foot")
    settle()
    act(opened, "foot_left")
    act(opened, "copy_to_other")
    settle()
    assert opened.case.record.side is Side.RIGHT
    assert select(corrections(opened)[0].id)["correction.centre_mm.0"] == place
    act(opened, "new_case")
    opened.case.open_foot(make_foot(Side.RIGHT), ScanSource("mesh", "/nowhere/right.ply", "1" * 64))
    settle()
    choose_in_menu_bar(opened, "Prescribe", "Arch to a height")
    settle()
    assert select(corrections(opened)[0].id) == pytest.approx(of_arch, abs=0.2)


def test_reliefs_are_chosen_in_the_menu_deepened_moved_and_undone(
    opened: Application, foot: SceneView, settle: Callable[[], None]
) -> None:
    library = ("Prescribe", "Pad of the library", "Forefoot", "Relief under a head")
    choose_in_menu_bar(opened, *library, "Relief under the 2nd head")
    choose_in_menu_bar(opened, *library, "Relief under the 3rd head")
    settle()
    second, third = corrections(opened)
    assert [describe(c).partition(" (")[0] for c in (second, third)] == [
        "Relief under the 2nd head 2 mm deep",
        "Relief under the 3rd head 2 mm deep",
    ]
    landmarks = landmarks_of(opened.case.record)
    for pad, head in ((second, HEADS[1]), (third, HEADS[2])):
        assert isinstance(pad, Pelott)
        assert pad.centre_mm == pytest.approx(landmarks[head].point[:2], abs=0.01)
    type_into(field(opened, "correction.height_mm"), "1.5")
    start = pixel(foot, *third.centre_mm)
    drag(foot, start, start + QPoint(0, 15), start + QPoint(0, 30))
    moved = corrections(opened)[1]
    assert isinstance(moved, Pelott)
    assert (moved.id, moved.height_mm, moved.kind) == (third.id, -1.5, "relief_head_3")
    assert moved.centre_mm[1] < third.centre_mm[1] - 5
    for _ in range(4):
        QTest.keyClick(opened.window, Qt.Key.Key_Z, Qt.KeyboardModifier.ControlModifier)
    assert corrections(opened) == ()


def test_a_reverse_mortons_extension_is_chosen_beside_the_tool_and_its_corner_dragged(
    opened: Application, foot: SceneView, settle: Callable[[], None]
) -> None:
    choose_pad(opened, "Forefoot", "Reverse Morton's extension")
    settle()
    (pad,) = corrections(opened)
    assert isinstance(pad, Pelott)
    heads = np.array([landmarks_of(opened.case.record)[name].point[:2] for name in HEADS])
    heights = pad_heights(pad, heads)
    assert heights[0] == 0.0
    assert heights[1:].min() > 0.6 * 3.0
    corners = [h for h in foot.handles if h.name.startswith("corner:")]
    assert len(corners) == 6
    start = pixel(foot, *corners[0].position_mm)
    drag(foot, start, start + QPoint(0, -12))
    (stretched,) = corrections(opened)
    assert isinstance(stretched, Pelott)
    assert stretched.outline_mm != pad.outline_mm
    assert stretched.kind == "reverse_mortons_extension"
    assert len(opened.case.history) == 2
    (handle,) = (h for h in foot.handles if h.name == "length")
    start = pixel(foot, *handle.position_mm)
    drag(foot, start, start + QPoint(0, -12))
    (longer,) = corrections(opened)
    assert isinstance(longer, Pelott)
    (length, width), (before, same) = pad_size(longer), pad_size(stretched)
    assert length > before + 3
    assert width == pytest.approx(same)
    type_into(field(opened, "correction.width_mm"), "60")
    (wide,) = corrections(opened)
    assert isinstance(wide, Pelott)
    assert pad_size(wide) == pytest.approx((length, 60.0))


def test_an_arch_is_prescribed_to_a_height_and_dragged(
    opened: Application, foot: SceneView, settle: Callable[[], None]
) -> None:
    choose_in_menu_bar(opened, "Prescribe", "Arch to a height")
    settle()
    (arch,) = corrections(opened)
    assert isinstance(arch, ArchRaise)
    assert arch.target_mm is not None
    assert arch.apex_mm is not None
    assert opened.stage.preview.height_mm(*arch.apex_mm) == pytest.approx(arch.target_mm, abs=0.1)
    type_into(field(opened, "correction.target_mm"), "33")
    settle()
    assert opened.stage.preview.height_mm(*arch.apex_mm) == pytest.approx(33.0, abs=0.1)
    names = {h.name for h in foot.handles}
    assert names == {"move", "length", "width", "height"}
    (handle,) = (h for h in foot.handles if h.name == "move")
    start = pixel(foot, *handle.position_mm)
    drag(foot, start, start + QPoint(0, 12), start + QPoint(0, 24))
    settle()
    (moved,) = corrections(opened)
    assert isinstance(moved, ArchRaise)
    assert moved.apex_mm is not None
    assert moved.apex_mm[1] < arch.apex_mm[1] - 4
    assert moved.target_mm == 33.0
    assert opened.stage.preview.height_mm(*moved.apex_mm) == pytest.approx(33.0, abs=0.1)
    (handle,) = (h for h in foot.handles if h.name == "height")
    start = pixel(foot, *handle.position_mm)
    drag(foot, start, start + QPoint(0, -10), start + QPoint(0, -20))
    (raised,) = corrections(opened)
    assert isinstance(raised, ArchRaise)
    assert raised.target_mm is not None
    assert raised.target_mm > 33.0
    for _ in range(3):
        opened.case.undo()
    assert corrections(opened) == (arch,)


def rows(menu: PadMenu) -> list[PadMenu]:
    return [menu, *(part for e in menu.entries if isinstance(e, PadMenu) for part in rows(e))]


@pytest.mark.parametrize("language", ["en", "sv"])
def test_the_library_is_listed_by_parts_of_the_foot(qapp: QApplication, language: str) -> None:
    load_language(qapp, language)
    try:
        menu = pad_menu(load_pads())
    finally:
        load_language(qapp, "en")
    assert [entry.title for entry in menu.entries if isinstance(entry, PadMenu)] == (
        ["Forefoot", "Arch and midfoot", "Heel", "Toes"]
        if language == "en"
        else ["Framfot", "Fotvalv och mellanfot", "Häl", "Tår"]
    )
    menus = rows(menu)
    assert max(len(part.entries) for part in menus) <= MOST_ROWS
    entries = [e for part in menus for e in part.entries if isinstance(e, PadEntry)]
    assert sorted(entry.number for entry in entries) == list(range(len(load_pads())))
    assert len({entry.text for entry in entries}) == len(entries)
