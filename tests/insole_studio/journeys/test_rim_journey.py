"""The rim in graph, views and fields, by real mouse and key events in the real window."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from pointing import LEFT, drag, hold, lead, turn_wheel
from PySide6.QtCore import QPoint, QPointF, Qt
from PySide6.QtGui import QAction
from PySide6.QtTest import QTest
from PySide6.QtWidgets import (
    QPushButton,
    QStyle,
    QStyleOptionSlider,
)
from pytestqt.qtbot import QtBot

from insole_core.cases.case_record import FootRecord, Variant
from insole_core.cases.scan_source import ScanSource
from insole_core.foot.foot import Foot
from insole_core.geometry.side import Side
from insole_core.insole.prescription.base_form import BaseForm
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.prescription.finish import Finish, RimStation
from insole_core.insole.prescription.shell import Shell
from insole_core.workflows.clinic_devices import (
    AS_SCANNED,
    DEFAULT_DEVICE,
    DefaultDevice,
    clinic_devices,
    clinic_forms,
)
from insole_core.workflows.starting_design import starting_device
from insole_studio.app.bootstrap import Application
from insole_studio.document.case_names import choose_variant
from insole_studio.features.design.devices.device_actions import DeviceActions
from insole_studio.scene.scene_view import SceneView
from insole_studio.scene.view_camera import Preset
from insole_studio.widgets.number_field import NumberField, SliderField
from insole_studio.widgets.rim_chart import RimChart
from insole_studio.widgets.tab_order import tab_stops

NOWHERE = ScanSource("mesh", "/nowhere/foot.ply", "0" * 64)
MakeFoot = Callable[[Side], Foot]

pytestmark = [pytest.mark.slow, pytest.mark.one_window]


def act(app: Application, key: str) -> None:
    app.window.actions_by_key[key].trigger()


@pytest.fixture
def designed(app: Application, settle: Callable[[], None], make_foot: MakeFoot) -> Application:
    """The left foot with the device of the product, and the rim tool taken."""
    foot = make_foot(Side.LEFT)
    device = starting_device(app.services.paths.settings_folder)
    app.case.open_foot(foot, NOWHERE, device.design(foot))
    act(app, "tool_rim")
    settle()
    assert app.stage.rim_model.curve is not None
    return app


@pytest.fixture
def chart(designed: Application) -> RimChart:
    chart = designed.stage.rim
    assert chart.isVisible()
    return chart


@pytest.mark.parametrize("key", ["section_follows", "tool_section"])
def test_the_section_comes_before_the_rim_when_it_is_asked_for(
    designed: Application, settle: Callable[[], None], key: str
) -> None:
    for _ in range(2):  # also when it is there already, behind the rim
        act(designed, key)
        settle()
        assert not designed.stage.section.visibleRegion().isEmpty()
        act(designed, "tool_rim")
        if key == "section_follows":
            act(designed, key)
        settle()


def test_a_section_that_follows_stays_behind_the_rim_once_that_is_chosen(
    designed: Application, settle: Callable[[], None]
) -> None:
    act(designed, "section_follows")
    act(designed, "tool_orbit")
    act(designed, "tool_rim")
    settle()
    scene = designed.stage.insole.scene
    QTest.mouseMove(scene.surface, scene.surface.rect().center())
    QTest.qWait(100)
    assert designed.stage.section.visibleRegion().isEmpty()


def design(app: Application) -> InsoleDesign:
    assert app.case.record.design is not None
    return app.case.record.design


def finish(app: Application) -> Finish:
    value = design(app).finish
    assert value is not None
    return value


def on_chart(app: Application, number: int) -> QPoint:
    """Where a station is painted in the graph."""
    placed = app.stage.rim_model.placed[number]
    edge = placed.arc_mm - app.stage.rim_model.curve.edge.medial_head_mm  # type: ignore[union-attr]
    length_mm = app.stage.rim_model.curve.edge.length_mm  # type: ignore[union-attr]
    return app.stage.rim.pixel_of(edge % length_mm, placed.height_mm).toPoint()


def in_view(view: SceneView, number: int) -> QPoint:
    handle = next(h for h in view.handles if h.name == f"rim:{number}")
    x, y = view.look.pixels_of(np.array(handle.position_mm))[0]
    return QPoint(round(x), round(y))


def pull(chart: RimChart, start: QPoint, *way: QPoint) -> None:
    QTest.mousePress(chart, LEFT, pos=start)
    for place in way:
        QTest.mouseMove(chart, place)


def test_a_station_is_dragged_in_the_graph(
    designed: Application, chart: RimChart, settle: Callable[[], None]
) -> None:
    before, steps = finish(designed).rim, len(designed.case.history)
    start = on_chart(designed, 3)
    up_mm = 1 / (chart.pixel_of(0, 0).y() - chart.pixel_of(0, 1).y())
    pull(chart, start, start - QPoint(0, 10), start - QPoint(2, 20))
    shown = designed.case.shown.design
    assert shown is not None
    assert shown.finish != finish(designed), "the views follow before the release"
    QTest.mouseRelease(chart, LEFT, pos=start - QPoint(2, 20))
    settle()
    after = finish(designed).rim
    assert after[3].height_mm == pytest.approx(before[3].height_mm + 20 * up_mm, abs=0.06)
    assert (after[:3], after[4:]) == (before[:3], before[4:])
    assert after[3].along == before[3].along, "raised, not shifted"
    assert len(designed.case.history) == steps + 1
    placed = designed.stage.rim_model.placed[3]
    heel = designed.stage.preview.base
    assert heel is not None
    assert heel.finished is not None
    act(designed, "undo")
    assert finish(designed).rim == before
    assert placed.height_mm != designed.stage.rim_model.placed[3].height_mm


def test_escape_takes_a_drag_in_the_graph_back(designed: Application, chart: RimChart) -> None:
    before, steps = design(designed), len(designed.case.history)
    start = on_chart(designed, 3)
    pull(chart, start, start - QPoint(0, 20))
    QTest.keyClick(chart, Qt.Key.Key_Escape)
    assert designed.case.shown.design == before
    QTest.mouseRelease(chart, LEFT, pos=start - QPoint(0, 20))
    assert design(designed) == before
    assert len(designed.case.history) == steps


def test_a_station_stays_between_its_neighbours(designed: Application, chart: RimChart) -> None:
    start, beyond = on_chart(designed, 3), on_chart(designed, 1)
    pull(chart, start, beyond)
    QTest.mouseRelease(chart, LEFT, pos=beyond)
    alongs = [s.along for s in finish(designed).rim if s.border == "medial"]
    assert alongs == sorted(alongs)
    assert designed.stage.preview.problem == ""


def test_the_keyboard_shapes_the_rim(designed: Application, chart: RimChart) -> None:
    steps, count = len(designed.case.history), len(finish(designed).rim)
    chart.setFocus()
    QTest.keyClick(chart, Qt.Key.Key_PageDown)
    number = designed.stage.rim_model.selected
    assert number is not None
    before = finish(designed).rim[number]
    hold(chart, Qt.Key.Key_Up, repeats=3)
    assert finish(designed).rim[number].height_mm == pytest.approx(before.height_mm + 2.0)
    assert len(designed.case.history) == steps + 1, "a held key is one step"
    hold(chart, Qt.Key.Key_Right, repeats=3)
    moved = designed.stage.rim_model.placed[number].arc_mm
    assert len(designed.case.history) == steps + 2
    QTest.keyClick(chart, Qt.Key.Key_Insert)
    assert len(finish(designed).rim) == count + 1
    assert designed.stage.rim_model.selected == count
    assert designed.stage.rim_model.placed[count].arc_mm > moved
    QTest.keyClick(chart, Qt.Key.Key_Delete)
    assert len(finish(designed).rim) == count


def test_a_double_click_adds_a_station_on_the_rim_as_it_runs(
    designed: Application, chart: RimChart
) -> None:
    curve = designed.stage.rim_model.curve
    assert curve is not None
    between = (QPointF(on_chart(designed, 3)) + QPointF(on_chart(designed, 2))) / 2
    QTest.mouseDClick(chart, LEFT, pos=between.toPoint())
    added = designed.stage.rim_model.placed[len(finish(designed).rim) - 1]
    assert added.height_mm == pytest.approx(curve.height_at(added.arc_mm), abs=0.06)


def test_the_selected_station_is_typed(designed: Application, chart: RimChart) -> None:
    QTest.mouseClick(chart, LEFT, pos=on_chart(designed, 3))
    panel = designed.stage.parameters
    field = next(
        f for f in panel.findChildren(NumberField) if f.property("key") == "station.height_mm"
    )
    field.setFocus()
    field.selectAll()
    QTest.keyClicks(field, "19,5")
    QTest.keyClick(field, Qt.Key.Key_Return)
    assert finish(designed).rim[3].height_mm == 19.5


@pytest.mark.parametrize("name", ["foot", "insole"])
def test_a_station_is_raised_in_the_views(
    designed: Application, settle: Callable[[], None], name: str
) -> None:
    """From the side upwards; seen from below or above by a drag outwards."""
    view: SceneView = getattr(designed.stage, name).scene
    before = finish(designed).rim
    for preset, way in ((Preset.MEDIAL, QPoint(0, -12)), (Preset.PLANTAR, None)):
        designed.stage.look(preset)
        raise_station(designed, view, way)
        act(designed, "undo")
        settle()
        assert finish(designed).rim == before


def raise_station(designed: Application, view: SceneView, way: QPoint | None) -> None:
    before, steps = finish(designed).rim, len(designed.case.history)
    middle = view.look.pixels_of(np.array([0.0, 125.0, 0.0]))[0]
    start = in_view(view, 3)
    outward = way or QPoint(12 if start.x() > middle[0] else -12, 0)
    drag(view, start, start + outward)
    after = finish(designed).rim
    assert len(designed.case.history) == steps + 1
    assert after[3].along == before[3].along
    by_mm = after[3].height_mm - before[3].height_mm
    assert by_mm == pytest.approx(12 * view.look.mm_per_px, rel=0.2)
    assert designed.stage.rim_model.selected == 3
    assert next(h for h in view.handles if h.name == "rim:3").kind == "move"


def test_a_station_is_moved_along_the_edge_in_a_view(designed: Application) -> None:
    view = designed.stage.insole.scene
    before = finish(designed).rim
    start = in_view(view, 3)
    drag(view, start, start + QPoint(0, 8))
    after = finish(designed).rim
    assert after[3].height_mm == before[3].height_mm
    assert after[3].along < before[3].along, "towards the heel"


def test_escape_takes_a_drag_in_a_view_back(designed: Application) -> None:
    view, before = designed.stage.insole.scene, design(designed)
    start = in_view(view, 3)
    lead(view, start, start + QPoint(20, 0))
    assert designed.case.shown.design != before
    QTest.keyClick(view.surface, Qt.Key.Key_Escape)
    assert designed.case.shown.design == before
    QTest.mouseRelease(view.surface, LEFT, pos=start + QPoint(20, 0))
    assert design(designed) == before


def test_the_toe_line_is_dragged(designed: Application) -> None:
    view = designed.stage.insole.scene
    handle = next(h for h in view.handles if h.name == "toe_line")
    x, y = view.look.pixels_of(np.array(handle.position_mm))[0]
    start, before = QPoint(round(x), round(y)), finish(designed).toe_line_mm
    drag(view, start, start - QPoint(0, 10))
    ahead_mm = finish(designed).toe_line_mm - before
    assert ahead_mm == pytest.approx(10 * view.look.mm_per_px, abs=1.0)
    assert designed.case.history.undo_sentence == "Move the toe line"


def slider(app: Application, key: str) -> SliderField:
    fields = app.stage.parameters.findChildren(SliderField)
    return next(f for f in fields if f.property("key") == key)


def test_cup_flange_and_fill_are_the_first_controls(designed: Application) -> None:
    act(designed, "tool_orbit")
    stops = tab_stops(designed.stage.parameters)
    keys = [stop.property("key") for stop in stops if stop.property("key")]
    assert keys[:3] == ["device.cup", "device.flange", "device.fill"]


def knob(field: SliderField) -> QPoint:
    """Where the handle of a slider is painted."""
    option = QStyleOptionSlider()
    field.slider.initStyleOption(option)
    part = QStyle.SubControl.SC_SliderHandle
    control = QStyle.ComplexControl.CC_Slider
    return field.slider.style().subControlRect(control, option, part, field.slider).center()


def shown_finish(app: Application) -> Finish:
    shown = app.case.shown.design
    assert shown is not None
    assert shown.finish is not None
    return shown.finish


def test_a_slider_dragged_with_the_mouse_is_followed_and_is_one_step(
    designed: Application, settle: Callable[[], None]
) -> None:
    act(designed, "tool_orbit")
    cup = slider(designed, "device.cup")
    before, steps = finish(designed), len(designed.case.history)
    start = knob(cup)
    QTest.mousePress(cup.slider, LEFT, pos=start)
    for right in (8, 16, 24):
        QTest.mouseMove(cup.slider, start + QPoint(right, 0))
    dragged = shown_finish(designed).rim[0].height_mm
    assert dragged == cup.number.value() > before.rim[0].height_mm + 2.0
    assert finish(designed) == before
    QTest.mouseRelease(cup.slider, LEFT, pos=start + QPoint(24, 0))
    settle()
    assert finish(designed).rim[0].height_mm == dragged
    assert len(designed.case.history) == steps + 1
    assert not designed.stage.tool_controller.is_busy


def test_the_wheel_moves_a_slider_that_was_clicked_and_no_other(
    designed: Application, settle: Callable[[], None], qtbot: QtBot
) -> None:
    act(designed, "tool_orbit")
    cup, before = slider(designed, "device.cup"), design(designed)
    designed.window.activateWindow()
    qtbot.waitUntil(designed.window.isActiveWindow)
    turn_wheel(cup.slider, 1)
    assert design(designed) == before
    QTest.mouseClick(cup.slider, LEFT, pos=knob(cup))
    assert cup.slider.hasFocus()
    turn_wheel(cup.slider, 1)
    settle()
    raised = finish(designed).rim[0].height_mm
    assert before.finish is not None
    assert raised > before.finish.rim[0].height_mm
    assert raised == cup.number.value()
    act(designed, "undo")
    settle()
    assert design(designed) == before


def with_form(app: Application, settle: Callable[[], None]) -> None:
    """Put the insole on a base form, half of which is the foot's own sole."""
    form = next(iter(clinic_forms(Path("none")).load().items.values()))
    base = BaseForm(form=form, contact_share=0.5)
    app.case.apply(replace(design(app), base=base), "Take a form")
    settle()


def heights(app: Application) -> Any:
    mesh = app.stage.preview.mesh
    assert mesh is not None
    return mesh.vertices[:, 2].copy()


PLACES = {"device.cup": 41, "device.flange": 50, "device.fill": 9, "base.contact_share": 4}


def test_the_picture_follows_a_slider_without_waiting_for_a_rebuild(
    designed: Application, settle: Callable[[], None]
) -> None:
    act(designed, "tool_orbit")
    with_form(designed, settle)
    for key, place in PLACES.items():
        follow_slider(designed, settle, key, place)


def follow_slider(designed: Application, settle: Callable[[], None], key: str, place: int) -> None:
    field, before = slider(designed, key), heights(designed)
    field.slider.setSliderDown(True)
    for number in range(place - 2, place + 1):
        field.slider.setValue(number)
        assert not designed.services.jobs.is_running("insole"), "the drag has all the time"
    preview = designed.stage.preview
    followed = heights(designed)
    assert np.abs(followed - before).max() > 0.4
    assert not preview.is_current
    field.slider.setSliderDown(False)
    settle()
    assert preview.is_current
    assert np.abs(preview.heights_mm(np.array([[0.0, 60.0], [5.0, 120.0]]))).min() > 0
    act(designed, "undo")
    settle()
    assert np.array_equal(heights(designed), before)


def test_steps_of_the_fill_by_key_are_seen_at_once(
    designed: Application, settle: Callable[[], None]
) -> None:
    act(designed, "tool_orbit")
    fill, before = slider(designed, "device.fill"), heights(designed)
    fill.number.setFocus()
    for _ in range(4):
        QTest.keyClick(fill.number, Qt.Key.Key_Up)
    first = heights(designed)
    assert np.abs(first - before).max() > 0.4
    settle()
    exact = heights(designed)
    assert len(exact) != len(first) or np.abs(exact - first).max() < 1.0


def test_the_picture_follows_the_toe_line(
    designed: Application, settle: Callable[[], None]
) -> None:
    view, before = designed.stage.insole.scene, heights(designed)
    handle = next(h for h in view.handles if h.name == "toe_line")
    x, y = view.look.pixels_of(np.array(handle.position_mm))[0]
    start = QPoint(round(x), round(y))
    QTest.mousePress(view.surface, LEFT, pos=start)
    for way in (10, 20, 30):
        QTest.mouseMove(view.surface, start - QPoint(0, way))
        assert not designed.services.jobs.is_running("insole")
    assert np.abs(heights(designed) - before).max() > 0.2
    QTest.mouseRelease(view.surface, LEFT, pos=start - QPoint(0, 30))
    settle()
    assert designed.stage.preview.is_current


def test_escape_takes_a_slider_back(designed: Application) -> None:
    act(designed, "tool_orbit")
    fill, before = slider(designed, "device.fill"), design(designed)
    fill.slider.setSliderDown(True)
    fill.slider.setValue(9)
    assert designed.case.shown.design != before
    QTest.keyClick(fill.slider, Qt.Key.Key_Escape)
    assert designed.case.shown.design == before
    assert (design(designed), fill.number.value()) == (before, 0.0)
    assert not designed.stage.tool_controller.is_busy


def test_the_rim_goes_with_the_prescription_to_the_other_foot(
    designed: Application, make_foot: Callable[[Side], object], settle: Callable[[], None]
) -> None:
    changed = RimStation(border="medial", along=0.45, height_mm=23.5)
    rim = (*finish(designed).rim[:3], changed, *finish(designed).rim[4:])
    kept = replace(design(designed), finish=replace(finish(designed), rim=rim))
    designed.case.apply(kept, "Change the rim")
    source = ScanSource("mesh", "/nowhere/right.ply", "0" * 64)
    other = FootRecord.begun(make_foot(Side.RIGHT), source)  # type: ignore[arg-type]
    designed.case.apply(other, "Add the right foot")
    settle()
    designed.case.take_foot(Side.LEFT)
    act(designed, "copy_to_other")
    settle()
    record = designed.case.record.of_side(Side.RIGHT)
    assert record is not None
    assert record.design.finish == kept.finish
    assert record.design.device == kept.device


def test_as_scanned_and_back_is_one_click_each(
    designed: Application, settle: Callable[[], None]
) -> None:
    before = design(designed)

    def press(text: str) -> None:
        buttons = designed.stage.parameters.findChildren(QPushButton)
        QTest.mouseClick(next(b for b in buttons if b.text() == text), LEFT)
        settle()

    act(designed, "tool_orbit")
    press("As scanned")
    assert design(designed).finish is None
    assert designed.stage.rim_model.curve is None
    press("Design the rim")
    assert design(designed).finish == before.finish
    assert design(designed).device == before.device


def test_each_variant_gets_its_own_device_back(
    designed: Application, settle: Callable[[], None]
) -> None:
    first, record = finish(designed), designed.case.record.current
    assert record is not None
    other = replace(design(designed), finish=replace(first, toe_line_mm=first.toe_line_mm + 6.0))
    designed.case.apply(record.with_variant(Variant("B", other)), "Add a variant")
    settle()
    act(designed, "toggle_as_scanned")
    choose_variant(designed.case, record.chosen)
    act(designed, "toggle_as_scanned")
    settle()
    assert design(designed).finish is None
    act(designed, "toggle_as_scanned")
    assert finish(designed) == first
    choose_variant(designed.case, "B")
    act(designed, "toggle_as_scanned")
    assert finish(designed) == other.finish
    settle()


def test_a_renamed_variant_gets_its_device_back_and_a_new_one_of_that_name_does_not(
    designed: Application, questions: Any, settle: Callable[[], None]
) -> None:
    changed = replace(finish(designed), toe_line_mm=finish(designed).toe_line_mm + 6.0)
    designed.case.apply(replace(design(designed), finish=changed), "Move the toe line")
    act(designed, "variant_duplicate")
    act(designed, "toggle_as_scanned")
    questions.typed = "softer"
    act(designed, "variant_name")
    act(designed, "toggle_as_scanned")
    settle()
    assert finish(designed) == changed
    act(designed, "toggle_as_scanned")
    act(designed, "variant_duplicate")
    record = designed.case.record.current
    assert record is not None
    assert record.chosen == "B"
    act(designed, "toggle_as_scanned")
    settle()
    assert finish(designed) != changed


def entry(devices: DeviceActions, key: str) -> QAction:
    assert devices.view is not None
    return next(a for a in devices.view.more.menu().actions() if a.data() == key)


def test_own_devices_are_kept_shared_and_made_the_default(
    designed: Application, questions: object, tmp_path: object
) -> None:
    devices = designed.features.design.devices
    devices.open()
    assert devices.view is not None
    questions.typed = "Own sport"  # type: ignore[attr-defined]
    entry(devices, "save").trigger()
    assert devices.view.chosen == "device:own-sport"
    questions.path = tmp_path / "shared.insole-device"  # type: ignore[attr-defined,operator]
    entry(devices, "export").trigger()
    entry(devices, "default").trigger()
    folder = designed.services.paths.settings_folder
    stored = clinic_devices(folder).load()
    assert stored.items["own-sport"].values.finish == finish(designed)
    assert "default" in devices.view.list.currentItem().text()
    entry(devices, "remove").trigger()
    assert "own-sport" not in clinic_devices(folder).load().items
    entry(devices, "import").trigger()
    assert clinic_devices(folder).load().items["own-sport"].values.finish == finish(designed)


def test_the_imprint_becomes_a_designed_rim_though_the_clinics_device_has_none(
    opened: Application, settle: Callable[[], None]
) -> None:
    DefaultDevice(opened.services.paths.settings_folder).save(AS_SCANNED)
    act(opened, "toggle_as_scanned")
    settle()
    assert design(opened).device == DEFAULT_DEVICE
    assert opened.stage.rim_model.curve is not None


def test_a_device_of_the_clinic_that_cannot_be_read_is_told(opened: Application) -> None:
    broken = opened.services.paths.settings_folder / "devices" / "half.json"
    broken.parent.mkdir(parents=True)
    broken.write_text("half a fi")
    devices, notices = opened.features.design.devices, opened.services.notices
    devices.open()
    assert devices.view is not None
    (notice,) = notices.notices
    assert "half.json" in notice.text
    devices.view.reject()
    broken.unlink()
    devices.open()
    assert not notices.notices


def test_the_rim_ends_where_the_insole_ends_after_its_shell_is_gone(
    opened: Application, settle: Callable[[], None]
) -> None:
    finished = replace(
        design(opened),
        finish=Finish(),
        shell=Shell(),
        outline=replace(design(opened).outline, extent="three_quarter"),
    )
    opened.case.apply(finished, "shell")
    settle()
    rim = opened.stage.rim_model
    assert rim.curve is not None
    trimmed = rim.reached
    opened.case.apply(replace(finished, shell=None), "no shell")
    settle()
    plain = rim.reached
    assert plain.sum() != trimmed.sum()
    opened.case.apply(finished, "shell again")
    settle()
    assert np.array_equal(rim.reached, trimmed)


def test_no_device_of_the_clinic_is_replaced_unasked(designed: Application, questions: Any) -> None:
    devices = designed.features.design.devices
    questions.typed = "Own sport"
    devices.save_as_device()
    assert questions.asked == []
    before = finish(designed)
    designed.case.apply(replace(design(designed), finish=replace(before, arch_fill_mm=5.0)), "fill")
    questions.replace = False
    devices.save_as_device()
    assert questions.asked == ["replace Own sport"]
    folder = designed.services.paths.settings_folder
    assert clinic_devices(folder).load().items["own-sport"].values.finish == before
    questions.replace = True
    devices.save_as_device()
    assert clinic_devices(folder).load().items["own-sport"].values.finish == finish(designed)
