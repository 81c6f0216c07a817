"""The foot turned and the reference plane placed by dragging, through real mouse events."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from pointing import LEFT, drag, lead, pixel
from PySide6.QtCore import QPoint, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QAbstractButton, QLabel

from insole_core.foot.alignment import pose_angles
from insole_core.workflows.foot_landmarks import landmarks_of
from insole_studio.app.bootstrap import Application
from insole_studio.scene.scene_view import SceneView
from insole_studio.scene.view_camera import Preset
from insole_studio.widgets.number_field import NumberField

pytestmark = [pytest.mark.slow, pytest.mark.one_window]


@pytest.fixture
def foot(opened: Application) -> SceneView:
    opened.window.actions_by_key["tool_turn"].trigger()
    return opened.stage.foot.scene


def handle(view: SceneView, name: str) -> tuple[float, float, float]:
    return next(h.position_mm for h in view.handles if h.name == name)


def pose(app: Application) -> tuple[float, float, float]:
    assert app.case.foot is not None
    angles = pose_angles(app.case.foot, landmarks_of(app.case.record))
    return angles.pitch_deg, angles.roll_deg, angles.yaw_deg


def carried(view: SceneView, name: str, turn_deg: float) -> list[QPoint]:
    """The way of a handle of the ring that lies in the picture, round the middle of the rings."""
    start = np.array(handle(view, name))
    ends = [np.array(h.position_mm) for h in view.handles if h.name == name]
    centre = np.mean(ends, axis=0)
    way = []
    for share in (0.0, 0.5, 1.0):
        angle = np.radians(share * turn_deg)
        x, y, z = start - centre
        turned = np.array(
            [x * np.cos(angle) - y * np.sin(angle), x * np.sin(angle) + y * np.cos(angle), z]
        )
        way.append(pixel(view, *(centre + turned)))
    return way


def test_the_ring_in_the_picture_turns_by_the_angle_of_the_pointer(
    opened: Application, foot: SceneView, settle: Callable[[], None]
) -> None:
    before, steps = pose(opened), len(opened.case.history)
    way = carried(foot, "turn-yaw_deg", 10.0)
    lead(foot, *way)
    assert "°" in opened.stage.tool_controller.tool.hint(
        opened.case
    )  # the angle is told while it changes
    assert opened.stage.tool_controller.tool.foot_step is not None
    assert len(opened.case.history) == steps
    QTest.mouseRelease(foot.surface, LEFT, pos=way[-1])
    settle()
    pitch, roll, yaw = pose(opened)
    # The toes of a left foot that turns counter-clockwise, seen from above, go laterally.
    assert yaw == pytest.approx(before[2] - 10.0, abs=0.8)
    assert (pitch, roll) == pytest.approx(before[:2], abs=0.3)
    assert len(opened.case.history) == steps + 1
    opened.window.actions_by_key["undo"].trigger()
    assert pose(opened) == pytest.approx(before, abs=1e-6)


@pytest.mark.parametrize(("name", "number"), [("turn-pitch_deg", 0), ("turn-roll_deg", 1)])
def test_a_ring_seen_from_its_edge_turns_along_the_drag(
    opened: Application, foot: SceneView, name: str, number: int
) -> None:
    before = pose(opened)
    start = pixel(foot, *handle(foot, name))
    end = start + (QPoint(0, -20) if number == 0 else QPoint(20, 0))
    drag(foot, start, end)
    after = pose(opened)
    assert abs(after[number] - before[number]) > 2.0
    others = [i for i in range(3) if i != number]
    assert [after[i] for i in others] == pytest.approx([before[i] for i in others], abs=0.3)


def test_escape_lets_the_foot_lie_as_it_did(opened: Application, foot: SceneView) -> None:
    record = opened.case.record
    lead(foot, *carried(foot, "turn-yaw_deg", 15.0))
    QTest.keyClick(foot.surface, Qt.Key.Key_Escape)
    assert opened.case.record is record
    assert opened.stage.tool_controller.tool.foot_step is None


def test_the_angle_can_be_typed_as_well(opened: Application, foot: SceneView) -> None:
    fields = opened.stage.parameters.findChildren(NumberField)
    field = next(f for f in fields if f.property("key") == "pose.yaw_deg")
    field.setValue(5.0)
    assert pose(opened)[2] == pytest.approx(5.0, abs=0.01)


def test_the_plane_is_placed_and_turned_by_dragging(opened: Application, foot: SceneView) -> None:
    opened.window.actions_by_key["tool_plane"].trigger()
    drag(foot, pixel(foot, 0.0, 100.0), pixel(foot, 10.0, 120.0))
    plane = opened.case.record.annotations.plane
    assert plane is not None
    assert plane.origin_mm[:2] == pytest.approx((10.0, 120.0), abs=1.0)
    start = pixel(foot, *handle(foot, "plane-pitch"))
    drag(foot, start, start - QPoint(0, 20))
    turned = opened.case.record.annotations.plane
    assert turned is not None
    assert turned.pitch_deg > 2.0
    assert len(opened.case.history) == 2


def test_a_click_on_a_measure_turns_to_its_place_and_marks_it(opened: Application) -> None:
    name = next(
        label
        for label in opened.stage.patient.findChildren(QLabel)
        if 'href="arch_height"' in label.text()
    )
    name.linkActivated.emit("arch_height")
    view = opened.stage.foot.scene
    assert view.camera.preset is Preset.MEDIAL
    apex = landmarks_of(opened.case.record)["arch_apex"].point
    x, y = view.look.pixels_of(apex)[0]
    assert 0.2 * view.width() < x < 0.8 * view.width()
    assert 0.2 * view.height() < y < 0.8 * view.height()
    assert "highlight" in view.painter.shown
    opened.window.actions_by_key["tool_pelott"].trigger()
    assert "highlight" not in view.painter.shown


def test_a_foot_that_lies_wrongly_is_turned_by_right_angles(
    opened: Application, foot: SceneView, settle: Callable[[], None]
) -> None:
    assert opened.case.foot is not None
    before, steps = opened.case.foot.mesh.vertices, len(opened.case.history)
    for _ in range(4):
        click_proposal(opened, "quarter.1.1")
        settle()
    after = opened.case.foot.mesh.vertices
    assert np.ptp(after - before, axis=0) == pytest.approx(0, abs=1e-6)
    assert len(opened.case.history) == steps + 4
    opened.window.actions_by_key["undo"].trigger()
    settle()
    assert np.ptp(opened.case.foot.mesh.vertices[:, 2]) > 60  # it lies on its side
    click_proposal(opened, "quarter.1.1")
    click_proposal(opened, "level.")
    settle()
    assert np.ptp(opened.case.foot.mesh.vertices[:, 2]) < 40


def click_proposal(app: Application, key: str) -> None:
    buttons = app.stage.parameters.findChildren(QAbstractButton)
    QTest.mouseClick(next(b for b in buttons if b.property("offer") == key), LEFT)


def test_landmarks_are_confirmed_by_a_button_that_answers(
    opened: Application, settle: Callable[[], None]
) -> None:
    opened.window.actions_by_key["tool_key_point"].trigger()
    click_proposal(opened, "action.confirm_landmarks")
    settle()
    assert "confirmed" in opened.window.statusBar().currentMessage()
    named = {point.name for point in opened.case.record.annotations.key_points}
    assert "metatarsal_head_1" in named


def test_posting_is_set_from_behind_where_the_axis_can_be_read(
    app: Application, settle: Callable[[], None]
) -> None:
    app.features.case_files.opener.open_example()
    settle()
    before = app.stage.foot.scene.camera
    assert before.preset is Preset.PLANTAR
    app.window.actions_by_key["tool_posting"].trigger()
    assert app.stage.foot.scene.camera.preset is Preset.POSTERIOR
    assert app.stage.insole.scene.camera.preset is Preset.POSTERIOR
    app.window.actions_by_key["tool_section"].trigger()
    assert app.stage.foot.scene.camera == before


def test_posting_stays_in_the_view_that_was_chosen(
    app: Application, settle: Callable[[], None]
) -> None:
    app.features.case_files.opener.open_example()
    settle()
    app.stage.look(Preset.MEDIAL)
    app.window.actions_by_key["tool_posting"].trigger()
    assert app.stage.foot.scene.camera.preset is Preset.MEDIAL
