"""Pose, pen marks and pronation of a whole foot, by real mouse events in the real window."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QLabel, QPushButton

from insole_core.cases.case_record import KeyPoint
from insole_core.cases.scan_source import ScanSource
from insole_core.foot.foot import Foot
from insole_core.foot.foot_placement import place_foot
from insole_core.geometry.side import Side
from insole_core.insole.clinic_rules import load_rules, proposed_post_deg
from insole_core.insole.elements import Pelott, Posting
from insole_core.simulate.foot_model import build_foot
from insole_core.simulate.foot_shape import FootShape
from insole_core.workflows.foot_landmarks import landmarks_of
from insole_studio.app.bootstrap import Application
from insole_studio.widgets.number_field import NumberField

pytestmark = pytest.mark.one_window

INK_AT = (-10.0, 150.0)


def with_ink(foot: Foot) -> Foot:
    """A spot of 5 mm radius drawn on the sole."""
    colors = np.full(foot.mesh.vertices.shape, (222, 178, 158), dtype=np.uint8)
    away = np.hypot(*(foot.mesh.vertices[:, :2] - INK_AT).T)
    colors[(away < 5) & (foot.mesh.vertex_normals[:, 2] < -0.5)] = (30, 30, 120)
    return replace(foot, mesh=replace(foot.mesh, colors=colors))


@pytest.fixture(scope="module")
def whole_foot() -> Foot:
    shape = FootShape(length_mm=255, ball_width_mm=96, rearfoot_eversion_deg=6.0)
    mesh = build_foot(shape, np.random.default_rng(4), cell_mm=3.0).mesh
    return with_ink(place_foot(mesh, Side.LEFT, frame="reference"))


@pytest.fixture
def bench(app: Application, settle: Callable[[], None], whole_foot: Foot) -> Application:
    app.case.open_foot(whole_foot, ScanSource("mesh", "/nowhere/foot.ply", "0" * 64))
    settle()
    return app


def press(app: Application, text: str) -> None:
    """Click the button of the parameters panel that begins with a text."""
    QApplication.processEvents()
    button = next(
        b for b in app.stage.parameters.findChildren(QPushButton) if b.text().startswith(text)
    )
    QTest.mouseClick(button, Qt.MouseButton.LeftButton)


def field(app: Application, key: str) -> NumberField:
    QApplication.processEvents()
    fields = app.stage.parameters.findChildren(NumberField)
    return next(f for f in fields if f.property("key") == key)


def test_the_measured_axis_proposes_a_posting_that_one_click_takes(bench: Application) -> None:
    # The leg is put to lean by 6° medially, as a dragged landmark would.
    x, y, z = landmarks_of(bench.case.record)["achilles_lower"].point
    upper = (x + 80 * np.tan(np.radians(6.0)), y, z + 80)
    annotations = bench.case.record.annotations
    for name, place in (("achilles_lower", (x, y, z)), ("achilles_upper", upper)):
        annotations = annotations.with_key_point(KeyPoint(name, place))
    bench.case.apply(annotations, "lean")
    bench.window.actions_by_key["tool_posting"].trigger()
    assert "axes" in bench.stage.foot.scene.painter._plotter.actors
    QApplication.processEvents()
    lean = 6.0
    labels = [label.text() for label in bench.stage.parameters.findChildren(QLabel)]
    assert f"Achilles axis {lean:.1f}° valgus to the sole" in labels
    press(bench, "Propose")
    (posting,) = bench.case.record.design.corrections  # type: ignore[union-attr]
    assert isinstance(posting, Posting)
    assert posting.rearfoot_deg == proposed_post_deg(lean, load_rules().pronation) == 5.0
    assert len(bench.case.history) == 2
    QApplication.processEvents()
    buttons = bench.stage.parameters.findChildren(QPushButton)
    texts = [button.text() for button in buttons if button.isVisible()]
    assert not any(text.startswith("Propose") for text in texts)


def test_a_pen_mark_becomes_a_landmark_or_the_place_of_a_pelott(bench: Application) -> None:
    bench.window.actions_by_key["tool_key_point"].trigger()
    press(bench, "Use as")
    (point,) = bench.case.record.annotations.key_points
    assert point.position_mm[:2] == pytest.approx(INK_AT, abs=1.5)
    press(bench, "Pelott here")
    (pad,) = bench.case.record.design.corrections  # type: ignore[union-attr]
    assert isinstance(pad, Pelott)
    assert pad.centre_mm == pytest.approx(INK_AT, abs=1.5)
    assert bench.case.selection == pad.id
    assert len(bench.case.history) == 2


@pytest.mark.slow
def test_the_foot_is_turned_by_numbers_and_aligned_by_its_landmarks(
    bench: Application, settle: Callable[[], None]
) -> None:
    design = bench.case.record.design
    assert design is not None
    pad = Pelott(centre_mm=(5.0, 150.0))
    bench.case.apply(design.with_added(pad), "a pad")
    before = bench.case.foot
    bench.window.actions_by_key["tool_key_point"].trigger()
    field(bench, "pose.roll_deg").setValue(7.0)
    settle()
    assert field(bench, "pose.roll_deg").value() == pytest.approx(7.0, abs=0.06)
    first, fifth = (landmarks_of(bench.case.record)[f"metatarsal_head_{n}"].point for n in (1, 5))
    assert first[2] - fifth[2] > 5  # medial edge up
    press(bench, "Align")
    settle()
    assert field(bench, "pose.roll_deg").value() == pytest.approx(0.0, abs=0.06)
    assert bench.case.history.undo_sentence == "Align the foot by the landmarks"
    assert bench.case.record.design is not None
    carried = bench.case.record.design.correction(pad.id)
    assert isinstance(carried, Pelott)
    assert carried.centre_mm == pytest.approx(pad.centre_mm, abs=3.0)
    for _ in range(2):
        bench.window.actions_by_key["undo"].trigger()
    assert bench.case.foot is before
