"""What is unusual stands in words in the window: pads off the foot, pads on pads."""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from pointing import LEFT, drag, lead, pixel
from PySide6.QtCore import QEventLoop, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QLabel, QPushButton, QWidget
from pytestqt.qtbot import QtBot

from insole_core.errors import OutputError
from insole_core.formats.ply import write_ply
from insole_core.geometry.side import Side
from insole_core.insole.elements import HeelLift, Pelott
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.prescription.design_json import design_to_json
from insole_core.simulate.foot_model import build_foot
from insole_core.simulate.foot_shape import FootShape
from insole_studio.app.bootstrap import Application
from insole_studio.cli.main import run
from insole_studio.jobs import Jobs
from insole_studio.scene.scene_view import SceneView
from insole_studio.widgets.number_field import NumberField

pytestmark = pytest.mark.one_window


@pytest.fixture
def view(opened: Application) -> SceneView:
    opened.window.actions_by_key["tool_pelott"].trigger()
    scene: SceneView = opened.stage.foot.scene
    return scene


def warnings(app: Application) -> list[QLabel]:
    QApplication.processEvents()  # a new line of a panel is shown by the next event
    labels = app.stage.patient.findChildren(QLabel, "warning")
    return [label for label in labels if label.isVisibleTo(app.stage.patient)]


def design(app: Application) -> InsoleDesign:
    assert app.case.record.design is not None
    return app.case.record.design


def saying(app: Application, words: str) -> list[QLabel]:
    return [label for label in warnings(app) if words in label.text()]


def test_a_pad_pushed_off_the_foot_is_warned_of_until_it_is_back(
    opened: Application, view: SceneView, settle: Callable[[], None]
) -> None:
    QTest.mouseClick(view.surface, LEFT, pos=pixel(view, 30.0, 110.0))
    settle()
    assert saying(opened, "below the foot") == []
    for _ in range(5):  # 5 mm each; seen from below, +x is on the left
        QTest.keyClick(view.surface, Qt.Key.Key_Left, Qt.KeyboardModifier.ShiftModifier)
    settle()
    (label,) = saying(opened, "below the foot")
    assert "of the pelott lies below the foot; move it inwards." in label.text()
    for _ in range(len(opened.case.history) - 1):
        opened.window.actions_by_key["undo"].trigger()
    settle()
    assert saying(opened, "below the foot") == []


def test_two_pads_on_one_place_are_warned_of_and_the_warning_leads_there(
    opened: Application, view: SceneView, settle: Callable[[], None]
) -> None:
    QTest.mouseClick(view.surface, LEFT, pos=pixel(view, -18.0, 110.0))
    opened.case.select(None)
    QTest.mouseClick(view.surface, LEFT, pos=pixel(view, 22.0, 110.0))
    first, second = design(opened).corrections
    settle()
    assert saying(opened, "heights add up") == []
    start, end = pixel(view, *second.centre_mm), pixel(view, *np.add(first.centre_mm, (12.0, 2.0)))
    drag(view, start, end)
    settle()
    (label,) = saying(opened, "heights add up")
    opened.case.select(None)
    label.linkActivated.emit(link(label))
    assert opened.case.selection in (first.id, second.id)


def link(label: QLabel) -> str:
    return label.text().split('"')[1]


@pytest.mark.slow
def test_a_recess_deeper_than_the_insole_is_told_while_it_is_dragged(
    app: Application,
    settle: Callable[[], None],
    export: Callable[[Path], Path],
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
) -> None:
    scan, prescription = tmp_path / "foot.ply", tmp_path / "design.json"
    shape = FootShape(side=Side.LEFT)
    write_ply(build_foot(shape, np.random.default_rng(1), cell_mm=3.0).mesh, scan)
    app.features.case_files.opener.open_path(scan, Side.LEFT)
    settle()
    recess = Pelott(centre_mm=(22.0, 115.0), height_mm=-6.0, length_mm=30.0, width_mm=25.0)
    thin = replace(design(app), thickness_mm=3.0).with_added(recess)
    app.case.apply(thin, "Add a recess under the arch")
    app.case.select(recess.id)
    app.window.actions_by_key["tool_pelott"].trigger()
    settle()
    label = app.stage.insole.findChild(QLabel, "warning")
    assert app.stage.preview.problem == ""
    assert label.text() == ""

    view = app.stage.foot.scene
    arch, ball = pixel(view, *recess.centre_mm), pixel(view, 4.0, 180.0)
    lead(view, arch, ball)  # the button is still held
    told = app.stage.preview.problem
    assert "The insole would be only -" in told
    assert label.text() == told
    assert label.isVisibleTo(app.stage.insole)
    QTest.mouseMove(view.surface, arch)
    QApplication.processEvents()
    assert app.stage.preview.problem == ""
    assert not label.isVisibleTo(app.stage.insole)
    QTest.mouseMove(view.surface, ball)
    QTest.mouseRelease(view.surface, LEFT, pos=ball)
    settle()
    assert app.stage.preview.problem == told

    with pytest.raises(OutputError) as refused:
        export(tmp_path / "insole.stl")
    assert str(refused.value) == told
    prescription.write_text(json.dumps(design_to_json(design(app))), encoding="utf-8")
    capsys.readouterr()
    call = ["design", str(scan), "--side", "left", "--prescription", str(prescription)]
    assert run([*call, "--out", str(tmp_path / "insole.stl")]) != 0
    assert told in capsys.readouterr().err.splitlines()[-1]
    assert not list(tmp_path.glob("*.stl"))


def test_lifts_that_add_up_to_too_much_are_told_while_they_are_typed(
    opened: Application, settle: Callable[[], None]
) -> None:
    label = opened.stage.insole.findChild(QLabel, "warning")
    for height in ("12", "9"):
        opened.window.actions_by_key["add_heel_lift"].trigger()
        type_number(opened, "correction.height_mm", height)
        settle()
    assert label.text().startswith("The heel lifts add up to 21 mm, and must be -10 to 20 mm;")
    assert label.isVisibleTo(opened.stage.insole)
    type_number(opened, "correction.height_mm", "8")
    settle()
    assert label.text() == ""


def test_a_coarse_grid_is_told_in_the_window_and_before_export(
    opened: Application, settle: Callable[[], None]
) -> None:
    type_number(opened, "insole.grid_mm", "4.5")
    settle()
    (label,) = saying(opened, "too coarse")
    assert "The grid of 4.5 mm is too coarse for a smooth insole; up to 2 mm" in label.text()
    opened.window.actions_by_key["export"].trigger()
    stage = opened.features.export.stage
    assert stage is not None
    finish(stage.jobs)
    row = stage.view.check_list.rows["grid"]
    assert row.sentence.text() == "4.5 mm between the points of the surface"
    assert row.isVisibleTo(stage)
    stage.close()
    type_number(opened, "insole.grid_mm", "1")
    settle()
    assert saying(opened, "too coarse") == []


def finish(jobs: Jobs) -> None:
    while jobs.is_running():
        loop = QEventLoop()
        jobs.ended.connect(loop.quit)
        loop.exec()
    QApplication.processEvents()


def type_number(app: Application, key: str, text: str) -> None:
    fields = app.stage.parameters.findChildren(NumberField)
    (field,) = (f for f in fields if f.property("key") == key)
    field.setFocus()
    field.selectAll()
    QTest.keyClicks(field, text)
    QTest.keyClick(field, Qt.Key.Key_Return)


@pytest.mark.slow
@pytest.mark.parametrize("size", [(1366, 728), (1366, 1000), (1920, 1040)])
def test_warnings_that_come_and_go_cut_nothing(
    opened: Application, settle: Callable[[], None], qtbot: QtBot, size: tuple[int, int]
) -> None:
    opened.window.resize(*size)
    opened.window.arrange()
    high = (
        design(opened)
        .with_added(HeelLift(height_mm=15.0))
        .with_added(Pelott(centre_mm=(0.0, 120.0), height_mm=14.0))
    )
    opened.case.apply(high, "Lift")
    settle()
    for _ in range(3):
        for action in ("undo", "redo"):
            opened.window.actions_by_key[action].trigger()
            settle()
            qtbot.waitUntil(lambda: cut_labels(opened.stage.patient) == [])


def cut_labels(panel: QWidget) -> list[str]:
    """The texts that have less room than they need."""
    labels = [label for label in panel.findChildren(QLabel) if label.isVisible() and label.text()]
    assert len(labels) > 10
    return [
        label.text()
        for label in labels
        if label.height() < (label.heightForWidth(label.width()) if label.wordWrap() else 0)
        or (not label.wordWrap() and label.width() < label.minimumSizeHint().width())
        or label.height() < label.fontMetrics().height()
    ]


@pytest.mark.own_window  # a panel of it gets a height that it keeps
def test_all_warnings_are_reached_from_their_number(
    opened: Application, view: SceneView, settle: Callable[[], None]
) -> None:
    panel = opened.stage.patient
    count = panel.findChild(QPushButton, "warning_count")
    assert count is not None
    assert not count.isVisibleTo(panel)
    off = tuple(Pelott(centre_mm=(60.0 + 5 * n, 30.0 + 30 * n)) for n in range(6))
    opened.case.apply(replace(design(opened), corrections=off), "Add pads off the foot")
    settle()
    panel.setFixedHeight(420)  # as at 1366 x 768
    QApplication.processEvents()
    shown = warnings(opened)
    assert count.text() == f"{len(shown)} warnings"
    assert not count.visibleRegion().isEmpty()
    assert shown[0].visibleRegion().isEmpty()
    QTest.mouseClick(count, LEFT)
    QApplication.processEvents()
    assert not shown[0].visibleRegion().isEmpty()
    assert not shown[1].visibleRegion().isEmpty()
