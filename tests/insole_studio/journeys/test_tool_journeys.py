"""Each further tool once, by real mouse and key events in the real window."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from pointing import LEFT, drag, lead, pixel
from PySide6.QtCore import QPoint, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QDialog, QLineEdit, QScroller, QToolButton, QWidget
from pytestqt.qtbot import QtBot
from read_pdf import paths_of_pdf
from round_foot import round_foot
from x_pointer import drag_at_once

from insole_core.cases.case_record import CaseRecord
from insole_core.geometry.side import Side
from insole_core.insole.build import build_insole
from insole_core.insole.clinic_rules import load_rules
from insole_core.insole.elements import BrushStroke, HeelCup, HeelSkive, Pelott
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.prescription.shell import Shell
from insole_core.solids.solid_outline import outline_of
from insole_core.workflows.foot_landmarks import metatarsal_line
from insole_studio.app.bootstrap import Application
from insole_studio.document.section_plane import SectionPlane
from insole_studio.features.design.models.color_maps import MapKind
from insole_studio.features.design.tools.key_point_tool import confidence, shown_points
from insole_studio.features.design.tools.metatarsal_line import clearance
from insole_studio.features.export.outline_print import print_outline
from insole_studio.scene.scene_view import ORBIT_DEG_PER_PX, SceneView
from insole_studio.widgets.form_parts import ComboBox
from insole_studio.widgets.number_field import NumberField

pytestmark = [pytest.mark.slow, pytest.mark.one_window]

USUAL_MM = load_rules().pelott_usual_behind_heads_mm


def ring(view: SceneView, centre: tuple[float, float], radius_mm: float) -> list[QPoint]:
    angles = np.linspace(0, 1.9 * np.pi, 24)
    return [
        pixel(view, centre[0] + radius_mm * np.cos(a), centre[1] + radius_mm * np.sin(a))
        for a in angles
    ]


def act(app: Application, key: str) -> None:
    app.window.actions_by_key[key].trigger()


def last(app: Application) -> object:
    assert app.case.record.design is not None
    return app.case.record.design.corrections[-1]


@pytest.fixture
def foot(opened: Application) -> SceneView:
    return opened.stage.foot.scene


def test_a_pad_is_drawn_by_free_hand_and_its_corner_dragged(
    opened: Application, foot: SceneView
) -> None:
    act(opened, "tool_free_hand")
    drag(foot, *ring(foot, (0.0, 120.0), 18.0))
    pad = last(opened)
    assert isinstance(pad, Pelott)
    assert pad.shape == "outline"
    assert pad.centre_mm == pytest.approx((0.0, 120.0), abs=2.0)
    low, high = np.array(pad.outline_mm).min(axis=0), np.array(pad.outline_mm).max(axis=0)
    assert high - low == pytest.approx((36.0, 36.0), abs=3.0)
    act(opened, "tool_pelott")
    corner = next(h for h in foot.handles if h.name == "corner:0")
    start = pixel(foot, *corner.position_mm)
    drag(foot, start, start + QPoint(10, 0))
    assert last(opened) != pad
    assert len(opened.case.history) == 2


@pytest.mark.display
@pytest.mark.parametrize("tool", ["tool_free_hand", "tool_brush"])
def test_a_line_drawn_while_the_program_is_busy_loses_no_point(
    opened: Application, foot: SceneView, qtbot: QtBot, tool: str
) -> None:
    act(opened, tool)
    QApplication.processEvents()
    drag_at_once(foot.surface, ring(foot, (0.0, 120.0), 18.0))
    qtbot.waitUntil(lambda: len(opened.case.history) == 1)
    drawn = last(opened)
    assert isinstance(drawn, Pelott | BrushStroke)
    points = drawn.outline_mm if isinstance(drawn, Pelott) else drawn.points_mm
    assert points is not None
    assert np.ptp(np.array(points), axis=0) == pytest.approx((36.0, 36.0), abs=3.0)
    assert len(points) > 10


@pytest.mark.display
def test_other_drags_end_where_the_hand_ended_however_busy_the_program_is(
    opened: Application, foot: SceneView, qtbot: QtBot
) -> None:
    way = [pixel(foot, 0.0, 110.0), pixel(foot, -8.0, 118.0), pixel(foot, 5.0, 124.0)]
    act(opened, "tool_pelott")
    drag_at_once(foot.surface, way)
    qtbot.waitUntil(lambda: len(opened.case.history) == 1)
    pad = last(opened)
    assert isinstance(pad, Pelott)
    assert pad.centre_mm == pytest.approx((5.0, 124.0), abs=1.0)
    act(opened, "tool_section")
    drag_at_once(foot.surface, way)
    end = pytest.approx((5.0, 124.0), abs=1.0)
    qtbot.waitUntil(lambda: (cut := opened.stage.cut.plane) is not None and cut.origin_mm == end)
    act(opened, "tool_orbit")
    before = foot.camera
    drag_at_once(foot.surface, [QPoint(5, 5), QPoint(40, 60), QPoint(60, 40)])
    turned = before.orbited(-55 * ORBIT_DEG_PER_PX, 35 * ORBIT_DEG_PER_PX)
    qtbot.waitUntil(lambda: foot.camera == turned)


def test_moves_that_come_faster_than_they_are_handled_are_handled_together(
    opened: Application, foot: SceneView
) -> None:
    act(opened, "tool_brush")
    shown: list[int] = []
    opened.case.preview_changed.connect(lambda: shown.append(1))
    drag(foot, *ring(foot, (0.0, 120.0), 18.0))
    stroke = last(opened)
    assert isinstance(stroke, BrushStroke)
    assert len(stroke.points_mm) > 20
    assert len(shown) < 10


def test_a_drawing_that_crosses_itself_makes_no_pad(opened: Application, foot: SceneView) -> None:
    act(opened, "tool_free_hand")
    eight = [(-20, 100), (20, 140), (20, 100), (-20, 140)]
    drag(foot, *(pixel(foot, *place) for place in eight))
    assert opened.case.record.design is not None
    assert opened.case.record.design.corrections == ()
    assert "crosses itself" in opened.stage.tool_controller.tool.hint(opened.case)


def test_a_stroke_raises_the_surface_where_it_went_and_nowhere_else(
    opened: Application, foot: SceneView
) -> None:
    before, far = (
        opened.stage.preview.height_mm(0.0, 100.0),
        opened.stage.preview.height_mm(0.0, 200.0),
    )
    act(opened, "tool_brush")
    drag(foot, pixel(foot, -10, 100), pixel(foot, 0, 100), pixel(foot, 10, 100))
    stroke = last(opened)
    assert isinstance(stroke, BrushStroke)
    assert opened.stage.preview.height_mm(0.0, 100.0) == pytest.approx(before + 1.0, abs=0.1)
    assert opened.stage.preview.height_mm(0.0, 200.0) == far
    act(opened, "undo")
    assert opened.stage.preview.height_mm(0.0, 100.0) == before


def number(app: Application, key: str) -> NumberField:
    fields = app.stage.parameters.findChildren(NumberField)
    (field,) = (f for f in fields if f.property("key") == key)
    assert field.isVisibleTo(app.stage.parameters)
    return field


@pytest.mark.parametrize("selected", ["pad", "stroke"])
def test_the_brush_is_set_while_a_correction_is_selected(
    opened: Application, foot: SceneView, selected: str
) -> None:
    act(opened, f"tool_{'pelott' if selected == 'pad' else 'brush'}")
    if selected == "pad":
        QTest.mouseClick(foot.surface, LEFT, pos=pixel(foot, 0.0, 120.0))
    else:
        drag(foot, pixel(foot, -10, 120), pixel(foot, 10, 120))
        act(opened, "next_correction")
    first = last(opened)
    assert isinstance(first, Pelott | BrushStroke)
    assert opened.case.selection == first.id
    act(opened, "tool_brush")
    for key, text in (("radius_mm", "22"), ("strength", "2.5")):
        field = number(opened, f"template.{key}")
        field.setFocus()
        field.selectAll()
        QTest.keyClicks(field, text)
        QTest.keyClick(field, Qt.Key.Key_Return)
    drag(foot, pixel(foot, -10, 60), pixel(foot, 10, 60))
    stroke = last(opened)
    assert isinstance(stroke, BrushStroke)
    assert (stroke.radius_mm, stroke.strength) == (22.0, 2.5)
    assert opened.case.record.design is not None
    assert opened.case.record.design.correction(first.id) == first
    number(opened, "correction.height_mm" if selected == "pad" else "correction.radius_mm")


def test_a_landmark_is_dragged(opened: Application, foot: SceneView) -> None:
    act(opened, "tool_key_point")
    name = "metatarsal_head_1"
    start = pixel(foot, *shown_points(opened.case)[name])
    drag(foot, start, start + QPoint(4, -4), start + QPoint(8, -8))
    assert confidence(opened.case, name) == 1.0
    assert len(opened.case.history) == 1


def test_a_landmark_dragged_off_the_foot_stays_where_and_as_sure_as_it_was(
    opened: Application, foot: SceneView
) -> None:
    act(opened, "tool_key_point")
    name = "metatarsal_head_1"
    place = shown_points(opened.case)[name]
    start, beside = pixel(foot, *place), QPoint(2, foot.height() // 2)
    drag(foot, start, beside)
    assert len(opened.case.history) == 0
    assert shown_points(opened.case)[name] == place
    assert confidence(opened.case, name) < 1.0
    drag(foot, start, start + QPoint(4, -4), beside)  # over skin: it stays at the last of it
    assert len(opened.case.history) == 1
    assert shown_points(opened.case)[name] != place


def test_landmarks_are_confirmed_and_found_anew(opened: Application) -> None:
    act(opened, "confirm_landmarks")
    assert confidence(opened.case, "heel_centre") == 1.0
    act(opened, "find_landmarks")
    assert confidence(opened.case, "heel_centre") < 1.0
    assert len(opened.case.history) == 2


def test_both_handles_of_the_posting_are_seen_and_dragged_from_behind(
    opened: Application, foot: SceneView
) -> None:
    opened.window.resize(1366, 768)
    act(opened, "tool_posting")
    act(opened, "look_posterior")
    places = {h.name: pixel(foot, *h.position_mm) for h in foot.handles}
    apart = places["rearfoot"] - places["forefoot"]
    assert abs(apart.x()) > 20, "one handle is not on the other, px"
    for name, angle in (("rearfoot", "rearfoot_deg"), ("forefoot", "forefoot_deg")):
        drag(foot, places[name], places[name] - QPoint(0, 30))
        assert getattr(last(opened), angle) > 0
        places = {h.name: pixel(foot, *h.position_mm) for h in foot.handles}


def test_a_pelott_snaps_behind_the_heads(opened: Application, foot: SceneView) -> None:
    line = metatarsal_line(opened.case.record)
    assert line is not None
    act(opened, "tool_pelott")
    x, y = line[1, :2]
    QTest.mouseClick(foot.surface, LEFT, pos=pixel(foot, x, y - 45.0))
    pad = last(opened)
    assert isinstance(pad, Pelott)
    found = clearance(opened.case.record, pad)
    assert found is not None
    # Carried to within a millimetre of the usual distance, it takes exactly that one.
    ahead = (found.nearest - found.front) / found.distance_mm
    near = np.array(pad.centre_mm) + (found.distance_mm - USUAL_MM - 1.0) * ahead
    start, end = pixel(foot, *pad.centre_mm), pixel(foot, *near)
    drag(foot, start, start + (end - start) * 0.5, end)
    settled = last(opened)
    assert isinstance(settled, Pelott)
    exact = clearance(opened.case.record, settled)
    assert exact is not None
    assert exact.distance_mm == pytest.approx(USUAL_MM, abs=0.05)
    assert f"{USUAL_MM:.1f} mm" in opened.stage.tool_controller.tool.hint(opened.case)


def test_a_pelott_ahead_of_the_heads_is_never_so_far_behind_them_as_less_than_nothing(
    opened: Application, foot: SceneView
) -> None:
    line = metatarsal_line(opened.case.record)
    assert line is not None
    act(opened, "tool_pelott")
    x, y = line[1, :2]
    QTest.mouseClick(foot.surface, LEFT, pos=pixel(foot, x, y - 10.0))
    pad = last(opened)
    assert isinstance(pad, Pelott)
    found = clearance(opened.case.record, pad)
    assert found is not None
    assert found.distance_mm < -1.0
    told = f"Front edge {-found.distance_mm:.1f} mm ahead of the metatarsal heads"
    assert opened.stage.tool_controller.tool.hint(opened.case) == told


def test_the_section_is_cut_by_a_click(opened: Application, foot: SceneView) -> None:
    act(opened, "tool_section")
    QTest.mouseClick(foot.surface, LEFT, pos=pixel(foot, 0.0, 110.0))
    # The plane takes whole half millimetres, and the sole rises by 0.3 on each here.
    assert opened.stage.section.thickness_mm(0.0) == pytest.approx(
        opened.stage.preview.height_mm(0.0, 110.0), abs=0.2
    )


def test_a_heel_skive_is_prescribed_and_its_values_edited(
    opened: Application, settle: Callable[[], None]
) -> None:
    act(opened, "add_heel_skive")
    settle()
    panel = opened.stage.parameters
    fields = {field.property("key"): field for field in panel.findChildren(NumberField)}
    fields["correction.depth_mm"].setValue(4.0)
    border = next(
        c for c in panel.findChildren(ComboBox) if c.property("key") == "correction.border"
    )
    border.setCurrentIndex(border.findData("lateral"))
    border.activated.emit(border.currentIndex())
    skive = last(opened)
    assert isinstance(skive, HeelSkive)
    assert (skive.depth_mm, skive.border) == (4.0, "lateral")
    assert skive.created_at != ""


def row_button(app: Application, tip: str) -> QToolButton | None:
    """The button of the selected correction's row in the list."""
    return next(
        (
            b
            for b in app.stage.patient.findChildren(QToolButton)
            if b.toolTip() == tip and b.property("correction") == app.case.selection
        ),
        None,
    )


def test_pads_change_their_order_past_what_has_none(opened: Application) -> None:
    design = opened.case.record.design
    assert design is not None
    first, second = Pelott(centre_mm=(0.0, 140.0)), Pelott(centre_mm=(0.0, 100.0))
    for correction in (first, HeelCup(), second):
        design = design.with_added(correction)
    opened.case.apply(design, "three")
    opened.case.select(second.id)
    up = row_button(opened, "Move up")
    assert up is not None
    QTest.mouseClick(up, LEFT)
    assert opened.case.record.design is not None
    assert [c.type for c in opened.case.record.design.corrections] == [
        "pelott", "heel_cup", "pelott",
    ]  # fmt: skip
    assert opened.case.record.design.corrections[0] == second


def test_what_shapes_the_whole_cannot_be_moved_in_the_list(opened: Application) -> None:
    act(opened, "add_heel_cup")
    assert row_button(opened, "Move up") is None
    assert row_button(opened, "Copy") is not None


def test_a_pad_is_copied_beside_itself(opened: Application, foot: SceneView) -> None:
    act(opened, "tool_pelott")
    QTest.mouseClick(foot.surface, LEFT, pos=pixel(foot, 10.0, 120.0))
    first = last(opened)
    copy = row_button(opened, "Copy")
    assert copy is not None
    QTest.mouseClick(copy, LEFT)
    second = last(opened)
    assert isinstance(first, Pelott)
    assert isinstance(second, Pelott)
    assert second.id != first.id
    assert second.centre_mm[1] == first.centre_mm[1] - 10.0
    assert opened.case.selection == second.id


@pytest.mark.parametrize("kind", ["height", "thickness", "fit"])
def test_maps_follow_a_drag_without_a_new_actor(
    opened: Application, foot: SceneView, kind: str
) -> None:
    act(opened, f"map_{kind}")
    actor = opened.stage.insole.scene.painter._plotter.actors["surface"]
    act(opened, "tool_pelott")
    drag(foot, pixel(foot, 0, 120), pixel(foot, 0, 130), pixel(foot, 0, 140))
    assert opened.stage.insole.scene.painter._plotter.actors["surface"] is actor
    act(opened, f"map_{MapKind.NONE.value}")


def test_the_insole_is_seen_through_the_foot(opened: Application, foot: SceneView) -> None:
    act(opened, "ghost")
    plotter = foot.painter._plotter
    low, high = plotter.actors["ghost"].bounds[4:]
    # Below the foot by its thickness, and up its sides.
    assert low == pytest.approx(-3.0, abs=0.01)
    act(opened, "tool_pelott")
    drag(foot, pixel(foot, 0, 120), pixel(foot, 0, 130), pixel(foot, 0, 140))
    assert plotter.actors["ghost"].bounds[5] >= high
    act(opened, "ghost")
    assert "ghost" not in plotter.actors


def test_the_section_follows_the_pointer_and_tells_the_heights(
    opened: Application, foot: SceneView, qtbot: QtBot
) -> None:
    stage = opened.stage
    act(opened, "section_follows")
    assert stage.section.isVisible()
    assert "Point at" in stage.section._sentence
    for y_mm in (60.0, 110.0):
        QTest.mouseMove(foot.surface, pixel(foot, 10.0, y_mm))
        qtbot.waitUntil(lambda y=y_mm: _cut_y(opened) == pytest.approx(y, abs=1.0))
        contact = stage.preview.height_mm(10.0, y_mm)
        told = dict(stage.section.legend())
        assert float(told["Contact surface"]) == pytest.approx(contact, abs=0.3)
        assert float(told["Foot"]) == pytest.approx(contact, abs=0.3)  # it stands on it
        assert told["Underside"] == "0.0"
    act(opened, "section_follows")
    QTest.mouseMove(foot.surface, pixel(foot, 0.0, 180.0))
    QTest.qWait(50)
    assert _cut_y(opened) == pytest.approx(110.0, abs=1.0)  # it stays where it was left


def test_the_section_does_not_follow_a_gesture(
    opened: Application, foot: SceneView, qtbot: QtBot
) -> None:
    act(opened, "section_follows")
    QTest.mouseMove(foot.surface, pixel(foot, 0.0, 60.0))
    qtbot.waitUntil(lambda: _cut_y(opened) == pytest.approx(60.0, abs=1.0))
    act(opened, "tool_pelott")
    lead(foot, pixel(foot, 0, 120), pixel(foot, 0, 130), pixel(foot, 0, 140))
    QTest.qWait(50)
    assert _cut_y(opened) == pytest.approx(60.0, abs=1.0)
    QTest.mouseRelease(foot.surface, LEFT, pos=pixel(foot, 0, 140))


def test_the_section_follows_within_a_frame(opened: Application) -> None:
    act(opened, "section_follows")
    seconds = []
    for y_mm in np.arange(40.0, 200.0, 4.0):
        start = time.process_time()
        opened.stage.cut.show(SectionPlane((0.0, float(y_mm))))
        seconds.append(time.process_time() - start)
    assert np.median(seconds) < 0.06  # some 7 ms usually, of 16


def _cut_y(app: Application) -> float | None:
    plane = app.stage.cut.plane
    return None if plane is None else plane.origin_mm[1]


def test_the_outline_of_a_shoe_comes_and_goes(
    opened: Application, settle: Callable[[], None]
) -> None:
    plotter = opened.stage.insole.scene.painter._plotter
    act(opened, "shoe")
    assert plotter.actors["shoe"].bounds[4] == 0.0
    design = opened.case.record.design
    assert design is not None
    opened.case.apply(replace(design, shell=Shell(heel_pitch_mm=10.0)), "Pitch")
    settle()
    assert plotter.actors["shoe"].bounds[4] == pytest.approx(
        -10.0, abs=0.1
    )  # the last is no straight line
    act(opened, "shoe")
    assert "shoe" not in plotter.actors


def test_light_from_the_side_comes_and_goes(opened: Application) -> None:
    lights = opened.stage.insole.scene.painter._plotter.renderer.lights
    ahead = [(light.position, light.intensity) for light in lights]
    act(opened, "grazing_light")
    assert [(light.position, light.intensity) for light in lights] != ahead
    act(opened, "grazing_light")
    assert [(light.position, light.intensity) for light in lights] == ahead


def test_contours_and_wireframe_come_and_go(opened: Application) -> None:
    painter = opened.stage.insole.scene.painter
    assert "contours" in painter._plotter.actors
    act(opened, "wireframe")
    assert painter._plotter.actors["surface"].prop.style == "Wireframe"
    act(opened, "contours")
    act(opened, "wireframe")
    assert "contours" not in painter._plotter.actors
    assert painter._plotter.actors["surface"].prop.style == "Surface"


def test_a_template_of_the_left_foot_is_mirrored_for_the_right(
    opened: Application, settle: Callable[[], None], tmp_path: Path
) -> None:
    assert opened.case.record.source is not None
    opened.case.open_foot(round_foot(Side.LEFT), opened.case.record.source)
    settle()
    act(opened, "tool_pelott")
    foot = opened.stage.foot.scene
    QTest.mouseClick(foot.surface, LEFT, pos=pixel(foot, 10.0, 150.0))
    pad = last(opened)
    assert isinstance(pad, Pelott)
    opened.services.messages.questions.path = tmp_path / "bar.insole-template"  # type: ignore[attr-defined]
    act(opened, "save_template")
    assert opened.case.record.source is not None
    opened.case.open_foot(round_foot(Side.RIGHT), opened.case.record.source)
    settle()
    act(opened, "apply_template")
    copied = last(opened)
    assert isinstance(copied, Pelott)
    assert copied.centre_mm == pytest.approx((-pad.centre_mm[0], pad.centre_mm[1]), abs=0.02)
    assert copied.id != pad.id
    assert opened.case.history.undo_sentence == "Apply a template"


def test_a_template_that_is_none_is_one_sentence(opened: Application, tmp_path: Path) -> None:
    (tmp_path / "odd.insole-template").write_text("{}")
    opened.services.messages.questions.path = tmp_path / "odd.insole-template"  # type: ignore[attr-defined]
    act(opened, "apply_template")
    (dialog,) = opened.services.messages.dialogs
    assert "format is missing" in dialog.text()


def test_the_outline_is_printed_in_true_size(
    opened: Application, settle: Callable[[], None], tmp_path: Path
) -> None:
    opened.features.export.print_outline_to(tmp_path / "outline.pdf")
    settle()
    content = (tmp_path / "outline.pdf").read_bytes()
    assert content.startswith(b"%PDF")
    # 80 × 250 mm and its margin fit on A4: exactly, or a printer that fits the page scales it.
    assert b"/MediaBox [0 0 595.275591 841.889764]" in content
    assert opened.window.statusBar().currentMessage().endswith("to be printed on A4 paper")
    lines = paths_of_pdf(tmp_path / "outline.pdf")
    sizes = [np.ptp(line, axis=0) for line in lines]
    within_mm = 0.03  # of 100
    assert sum(bool(np.allclose(size, [0, 100], atol=within_mm)) for size in sizes) == 1
    ink = np.concatenate(lines)  # which all printers can put there
    assert ink.min(axis=0).min() > 5
    assert (ink.max(axis=0) < np.array([210, 297]) - 5).all()


@pytest.mark.parametrize(("length_mm", "paper"), [(270.0, "A4"), (300.0, "A3")])
def test_an_outline_is_on_the_smallest_paper_that_holds_it_at_true_size(
    length_mm: float, paper: str, opened: Application, tmp_path: Path
) -> None:
    foot = round_foot(Side.RIGHT)
    longer = foot.mesh.moved(foot.mesh.vertices * [1.0, length_mm / foot.length_mm, 1.0])
    scanned = replace(foot, mesh=longer, length_mm=length_mm)
    insole = build_insole(scanned, InsoleDesign(Side.RIGHT))
    assert print_outline(insole, opened.case.record.patient.name, tmp_path / "a.pdf") == paper
    tall_mm = np.ptp(outline_of(insole)[:, 1])
    sizes_mm = [np.ptp(line[:, 1]) for line in paths_of_pdf(tmp_path / "a.pdf")]
    assert min(abs(size - tall_mm) for size in sizes_mm) < 0.03


def test_touch_mode_widens_what_can_be_grabbed(opened: Application, foot: SceneView) -> None:
    narrow = foot.grab_px
    act(opened, "touch")
    assert foot.grab_px >= 2 * narrow
    assert "min-height: 40px" in QApplication.instance().styleSheet()  # type: ignore[union-attr]
    act(opened, "touch")


def test_the_steps_show_how_far_the_case_is(opened: Application) -> None:
    def signs() -> str:
        return "".join(b.text()[0] for b in opened.stage.steps.findChildren(QToolButton))

    # Nobody has said who the patient is, and yet the foot on the bench is designed on.
    assert signs() == "○●●◉○"
    act(opened, "add_heel_lift")
    assert signs() == "○●●◉○"
    opened.case.open(CaseRecord(), None)
    assert signs() == "◉○○○○"


def test_the_step_of_the_design_takes_no_tool(opened: Application, foot: SceneView) -> None:
    act(opened, "tool_orbit")
    step = next(b for b in opened.stage.steps.findChildren(QToolButton) if "Design" in b.text())
    QTest.mouseClick(step, LEFT)
    assert opened.stage.tool_controller.tool.key == "orbit"
    QTest.mouseClick(foot.surface, LEFT, pos=pixel(foot, 0.0, 110.0))
    assert opened.case.record.current.design.corrections == ()


def test_both_usual_shortcuts_redo(opened: Application) -> None:
    window, control = opened.window, Qt.KeyboardModifier.ControlModifier
    shift = Qt.KeyboardModifier.ShiftModifier
    window.activateWindow()
    QTest.qWaitForWindowActive(window)
    act(opened, "add_heel_lift")
    lifted = opened.case.record
    for key, modifiers in ((Qt.Key.Key_Y, control), (Qt.Key.Key_Z, control | shift)):
        QTest.keyClick(window, Qt.Key.Key_Z, control)
        assert opened.case.record != lifted
        QTest.keyClick(window, key, modifiers)
        assert opened.case.record == lifted


@pytest.mark.parametrize("feature", ["export", "compare"])
def test_escape_and_its_button_close_a_stage(
    opened: Application, qtbot: QtBot, settle: Callable[[], None], feature: str
) -> None:
    window = getattr(opened.features, feature)
    ways: list[Callable[[QWidget], None]] = [
        lambda stage: QTest.keyClick(stage, Qt.Key.Key_Escape),
        lambda stage: QTest.mouseClick(stage.view.leave, LEFT),
    ]
    for leave in ways:
        window.open()
        stage = window.stage
        qtbot.waitUntil(stage.view.leave.isVisible)  # all is made
        leave(stage)
        assert window.stage is None
    settle()


def test_the_section_takes_room_only_while_it_is_wanted(
    opened: Application, foot: SceneView
) -> None:
    assert not opened.stage.section.isVisible()
    act(opened, "tool_section")
    assert opened.stage.section.isVisible()
    QTest.mouseClick(foot.surface, LEFT, pos=pixel(foot, 0.0, 110.0))
    act(opened, "tool_orbit")
    assert opened.stage.section.isVisible()


def test_the_place_of_the_pointer_is_that_of_the_release(
    opened: Application, foot: SceneView
) -> None:
    told: list[str] = []
    opened.stage.pointed.connect(told.append)
    act(opened, "tool_pelott")
    drag(foot, pixel(foot, 0, 120), pixel(foot, 0, 130), pixel(foot, 10, 140))
    y = float(told[-1].split("From heel")[1].split()[0])
    assert y == pytest.approx(140.0, abs=1.0)
    for name in ("From axis", "From heel", "Height"):
        assert told[-1].split(name)[1].split()[1] == "mm", f"{name} has its unit"


def test_measures_are_copied_and_written_as_a_table(opened: Application, tmp_path: Path) -> None:
    assert opened.case.record.source is not None
    opened.case.open_foot(round_foot(Side.LEFT), opened.case.record.source)
    act(opened, "copy_measures")
    copied = QApplication.clipboard().text()
    assert copied.startswith("measure,unit,left,right,difference,percent,positive,left_limits_95,")
    length = next(line for line in copied.splitlines() if line.startswith("foot_length,mm,"))
    assert float(length.split(",")[2]) == pytest.approx(250.0, abs=1.0)
    opened.services.messages.questions.path = tmp_path / "measures.csv"  # type: ignore[attr-defined]
    act(opened, "save_measures")
    assert (tmp_path / "measures.csv").read_text() == copied
    opened.services.messages.questions.path = tmp_path / "sheet.pdf"  # type: ignore[attr-defined]
    act(opened, "print_measures")
    assert (tmp_path / "sheet.pdf").read_bytes().startswith(b"%PDF")
    opened.stage.patient.measure_chosen.emit("angles")
    (dialog,) = (d for d in opened.window.findChildren(QDialog) if d.isVisible())
    assert dialog.windowTitle() == "Angles of the feet"
    dialog.reject()


def test_a_pad_of_the_library_lies_at_its_place_at_once(
    opened: Application, foot: SceneView
) -> None:
    opened.window.pad_chosen.emit(4)
    pad = last(opened)
    assert isinstance(pad, Pelott)
    assert (pad.shape, pad.length_mm, pad.width_mm, pad.height_mm) == ("drop", 22, 18, 4)
    found = clearance(opened.case.record, pad)
    assert found is not None
    assert found.distance_mm == pytest.approx(USUAL_MM, abs=0.1)
    start = pixel(foot, *pad.centre_mm)
    drag(foot, start, start + QPoint(0, 20), start + QPoint(0, 40))
    moved = last(opened)
    assert isinstance(moved, Pelott)
    assert moved.id == pad.id
    assert moved.centre_mm[1] < pad.centre_mm[1] - 10
    assert len(opened.case.history) == 2


def test_touch_mode_makes_every_target_44_pixels(
    opened: Application, foot: SceneView, qtbot: QtBot
) -> None:
    act(opened, "tool_pelott")
    QTest.mouseClick(foot.surface, LEFT, pos=pixel(foot, 0.0, 120.0))
    act(opened, "touch")
    opened.case.select(None)  # the fields are laid out anew
    panel = opened.stage.parameters

    def shown_fields() -> list[NumberField | ComboBox]:
        every = [*panel.findChildren(NumberField), *panel.findChildren(ComboBox)]
        return [field for field in every if field.isVisible()]

    qtbot.waitUntil(lambda: min((field.height() for field in shown_fields()), default=0) >= 44)
    fields = shown_fields()

    def shown_buttons() -> list[QToolButton]:
        every = opened.window.findChildren(QToolButton)
        # Those of a line are as high as it.
        return [b for b in every if b.isVisible() and not isinstance(b.parent(), QLineEdit)]

    qtbot.waitUntil(lambda: min(button.height() for button in shown_buttons()) >= 44)
    small = [button for button in shown_buttons() if button.sizeHint().height() < 44]
    assert [(button.text(), button.toolTip(), button.parent()) for button in small] == []
    (more,) = (b for b in shown_buttons() if b.objectName() == "qt_toolbar_ext_button")
    assert more.parentWidget().rect().contains(more.geometry()), "whole in a narrow window"
    field = next(field for field in fields if isinstance(field, NumberField))
    before = field.value()
    for from_right, change in ((22, 1), (66, -1)):  # plus outside, minus beside it
        at = QPoint(field.width() - from_right, field.height() // 2)
        QTest.mouseClick(field, LEFT, pos=at)
        before += change * field.singleStep()
        assert field.value() == pytest.approx(before)


def test_panels_are_scrolled_by_a_finger(opened: Application) -> None:
    for panel in (opened.stage.parameters, opened.stage.patient):
        assert QScroller.hasScroller(panel.viewport())
