"""The foot stage as the window offers it: real mouse and keys, from a session to the design."""

from __future__ import annotations

import json
import shutil
import zipfile
from collections.abc import Callable, Sequence
from pathlib import Path

import numpy as np
import pytest
from image_colors import colors_of
from PySide6.QtCore import QPoint, QPointF, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QToolButton
from pytestqt.qtbot import QtBot
from real_dialogs import answering

from insole_core.cases.scan_source import ScanSource
from insole_core.foot.foot import Foot
from insole_core.geometry.arrays import IntArray
from insole_core.geometry.side import Side
from insole_core.insole.elements import Pelott
from insole_core.recording.box import Box
from insole_core.recording.hand_edits import Pixel
from insole_core.recording.reader import read_session
from insole_studio.app.bootstrap import Application
from insole_studio.features.foot.rows import Mark
from insole_studio.features.foot.stage import FootStage
from insole_studio.scene.view_camera import Preset
from insole_studio.services.questions import Questions
from insole_studio.widgets.side_switch import SideBadge

pytestmark = pytest.mark.one_window

LEFT = Qt.MouseButton.LeftButton


@pytest.fixture
def session(tmp_path: Path, small_session: Path) -> Path:
    path = tmp_path / "session.zip"
    shutil.copy(small_session, path)
    return path


def shown_stage(app: Application) -> FootStage:
    stage = app.features.foot.stage
    assert stage is not None
    return stage


@pytest.fixture
def stage(app: Application, qtbot: QtBot, session: Path) -> FootStage:
    """The stage with a session that is read and placed; its foot is not made."""
    app.features.case_files.opener.open_path(session)
    opened = shown_stage(app)
    qtbot.waitUntil(lambda: opened.view.table.rowCount() == 3)
    opened.view.cancel_requested.emit()
    opened.activateWindow()
    QTest.qWait(50)  # until the panels have their places
    return opened


def cell(stage: FootStage, row: int, title: str) -> str:
    """What a line of the table says under a heading."""
    table = stage.view.table
    titles = [table.horizontalHeaderItem(i).text() for i in range(table.columnCount())]
    return table.item(row, titles.index(title)).text()


def mark(stage: FootStage, marker: str) -> Mark:
    return next(m for m in stage.view.markers.picture._marks if m.id == marker)


def click(stage: FootStage, pixel: Pixel) -> None:
    place = stage.view.markers.picture.to_widget(pixel).toPoint()
    QTest.mouseClick(stage.view.markers.picture, LEFT, pos=place)


def choose(stage: FootStage, text: str, sub: str = "") -> None:
    """Choose a line of the menu that a click has opened."""
    menu = stage.view.markers.menu
    menu.close()
    action = next(a for a in menu.actions() if a.text() == text)
    if sub:
        action = next(a for a in action.menu().actions() if a.text() == sub)  # type: ignore[attr-defined]
    action.trigger()


def drag(stage: FootStage, start: QPointF, *way: QPointF) -> None:
    picture = stage.view.markers.picture
    QTest.mousePress(picture, LEFT, pos=start.toPoint())
    for place in way:
        QTest.mouseMove(picture, place.toPoint())
        QApplication.processEvents()
    QTest.mouseRelease(picture, LEFT, pos=way[-1].toPoint())


@pytest.mark.slow
def test_an_opened_session_shows_its_foot_and_goes_on_to_design(
    app: Application, settle: Callable[[], None], session: Path
) -> None:
    app.features.case_files.opener.open_path(session)
    settle()
    stage = shown_stage(app)
    assert stage.isVisible()
    assert app.case.foot is not None
    assert cell(stage, 0, "Markers") == "12 / 12"
    assert cell(stage, 0, "Remarks") == "Good"
    QTest.mouseClick(stage.view.go_on, LEFT)
    assert app.features.foot.stage is None
    QTest.qWaitForWindowActive(app.window)
    assert app.window.isActiveWindow()
    assert QApplication.focusWidget() is app.stage.foot.scene.surface
    steps = [button.text() for button in app.stage.steps.findChildren(QToolButton)]
    assert [text for text in steps if text.startswith("◉")] == ["◉  Design"]
    app.stage.steps.chosen.emit("foot")
    again = shown_stage(app)
    assert again is not stage
    app.stage.steps.chosen.emit("foot")
    assert shown_stage(app) is again
    settle()
    assert len(app.case.history) == 0  # looking changes nothing


@pytest.mark.slow
@pytest.mark.parametrize(
    ("answer", "side"),
    [("Take it as a left foot", Side.LEFT), ("Open anyway", Side.RIGHT), ("Do not open", None)],
)
def test_a_left_foot_that_was_captured_as_right_is_taken_as_what_it_is(
    app: Application,
    settle: Callable[[], None],
    qtbot: QtBot,
    monkeypatch: pytest.MonkeyPatch,
    tmp_path: Path,
    session: Path,
    answer: str,
    side: Side | None,
) -> None:
    path = tmp_path / "right"
    with zipfile.ZipFile(session) as archive:
        archive.extractall(path)
    manifest = path / "manifest.json"
    manifest.write_text(json.dumps(json.loads(manifest.read_text()) | {"side": "right"}))
    monkeypatch.setattr(app.services.messages, "questions", Questions(app.window))
    with answering(answer) as answers:
        app.features.case_files.opener.open_path(path)
        qtbot.waitUntil(lambda: answers.left == [])
    settle()
    assert "looks like a left foot" in answers.asked[0]
    stage = shown_stage(app)
    (badge,) = stage.findChildren(SideBadge)
    assert badge.text() == (Side.RIGHT if side is None else side).name
    assert [foot.side for foot in app.case.record.feet] == ([] if side is None else [side])
    assert stage.view.go_on.isEnabled() is (side is not None)
    if side is Side.LEFT:
        assert app.case.foot is not None
        assert not any("session says" in note for note in stage.presenter._made.scan.warnings)
        stage.view.view_switched.emit("right", False)
        stage.view.go_on.click()  # corrected, it stays a left foot, without a second question
        settle()
        assert [foot.side for foot in app.case.record.feet] == [Side.LEFT]
        app.features.case_files.opener.open_path(path)  # as the recent files do
        settle()
        assert shown_stage(app).view.findChild(SideBadge).text() == "LEFT"
        shown_stage(app).view.undo_requested.emit()
        assert read_session(path).manifest.side is Side.LEFT
    if side is Side.RIGHT:
        stage.view.view_switched.emit("right", False)
        with answering("Take it as a left foot") as answers:
            stage.view.make_requested.emit()
            qtbot.waitUntil(lambda: answers.left == [])
        settle()
        stage.view.go_on.click()
        settle()
        assert [foot.side for foot in app.case.record.feet] == [Side.LEFT]


@pytest.mark.slow
def test_going_on_with_a_foot_that_was_not_opened_asks_once_more(
    app: Application,
    settle: Callable[[], None],
    qtbot: QtBot,
    monkeypatch: pytest.MonkeyPatch,
    make_foot: Callable[[Side], Foot],
    session: Path,
) -> None:
    app.case.open_foot(make_foot(Side.LEFT), ScanSource("mesh", "left.stl", "0" * 64))
    first = app.case.foot
    monkeypatch.setattr(app.services.messages, "questions", Questions(app.window))
    with answering("Do not open") as answers:
        app.features.case_files.opener.open_path(session)
        qtbot.waitUntil(lambda: answers.left == [])
    settle()
    stage = shown_stage(app)
    with answering("Do not open"):
        QTest.mouseClick(stage.view.go_on, LEFT)
    assert shown_stage(app) is stage
    assert stage.isVisible()
    assert app.case.foot is first
    with answering("Put in its place"):
        QTest.mouseClick(stage.view.go_on, LEFT)
    assert app.features.foot.stage is None
    assert app.case.foot is not first


@pytest.mark.slow
def test_a_foot_made_again_keeps_its_design(
    app: Application, settle: Callable[[], None], session: Path
) -> None:
    app.features.case_files.opener.open_path(session)
    settle()
    design, first = app.case.record.design, app.case.foot
    assert design is not None
    app.case.apply(design.with_added(Pelott(centre_mm=(0.0, 140.0))), "Place a pelott")
    stage = shown_stage(app)
    stage.view.view_switched.emit("right", False)
    assert stage.view.go_on.text() == "Reconstruct and go on"
    stage.view.go_on.click()
    settle()
    assert app.features.foot.stage is None
    assert app.case.foot is not first
    assert app.case.record.design is not None
    assert len(app.case.record.design.corrections) == 1
    app.controller.run_action("undo", False)
    assert app.case.foot is first


@pytest.mark.slow
def test_keys_and_clicks_exclude_and_include(stage: FootStage, session: Path, qtbot: QtBot) -> None:
    """Keys go from mark to mark; corrections are there when the session is opened again."""
    picture = stage.view.markers.picture
    picture.setFocus()
    for key in (Qt.Key.Key_Right, Qt.Key.Key_Right, Qt.Key.Key_Space):
        QTest.keyClick(picture, key)
    assert [m.id for m in picture._marks if m.state == "excluded"] == ["S2"]
    QTest.keyClick(picture, Qt.Key.Key_Return)
    choose(stage, "Include S2")
    assert mark(stage, "S2").state == "used"

    at = mark(stage, "S3").pixel
    click(stage, at)
    choose(stage, "Exclude S3")
    assert mark(stage, "S3").state == "excluded"
    assert cell(stage, 0, "Markers") == "11 / 12"
    assert read_session(session).edits.of("left").excluded == ("S3",)
    click(stage, at)
    choose(stage, "Include S3")
    assert mark(stage, "S3").state == "used"
    stage.activateWindow()  # which the menu has been
    QTest.qWaitForWindowActive(stage)
    for key, state in ((Qt.Key.Key_Z, "excluded"), (Qt.Key.Key_Y, "used")):
        QTest.keyClick(stage.view.markers.picture, key, Qt.KeyboardModifier.ControlModifier)
        qtbot.waitUntil(lambda state=state: mark(stage, "S3").state == state)


@pytest.mark.slow
def test_a_spot_is_another_marker_a_place_is_one_and_one_is_dragged(stage: FootStage) -> None:
    picture = stage.view.markers.picture
    click(stage, mark(stage, "S2").pixel)
    choose(stage, "This is", "S9")
    assert stage.presenter.edits.of("left").named[0].id == "S9"
    click(stage, (300.0, 200.0))
    choose(stage, "Add a marker here", "S2")
    assert mark(stage, "S2").pixel == pytest.approx((300.0, 200.0), abs=2)

    start = picture.to_widget(mark(stage, "S6").pixel)
    drag(stage, start, start + QPointF(8, 0), start + QPointF(16, 4))
    moved = mark(stage, "S6")
    assert moved.by_hand
    expected = picture.to_pixel((start + QPointF(16, 4)).toPoint().toPointF())
    assert moved.pixel == pytest.approx(expected)
    (named,) = (each for each in stage.presenter.edits.of("left").named if each.id == "S6")
    assert named.exact


def test_a_double_click_zooms_a_region_is_drawn_and_a_tick_leaves_a_view_out(
    stage: FootStage,
) -> None:
    picture = stage.view.markers.picture
    fitted = picture._zoom
    assert fitted > 1
    QTest.mouseDClick(picture, LEFT, pos=QPoint(5, 5))
    assert picture._zoom == 1
    QTest.mouseDClick(picture, LEFT, pos=QPoint(5, 5))
    assert picture._zoom == fitted
    stage.view.markers.menu.close()

    at = picture.to_widget(mark(stage, "S4").pixel)
    corners = [at + QPointF(*by) for by in ((-12, -12), (12, -12), (12, 12), (-12, 12))]
    stage.view.markers.ignore.click()
    drag(stage, *corners)
    assert "S4" not in [m.id for m in picture._marks]
    assert not stage.view.markers.ignore.isChecked()
    stage.view.markers.clear.click()
    assert mark(stage, "S4").state == "used"
    stage.view.markers.search.click()
    stage.view.markers.ignore.click()
    assert not stage.view.markers.search.isChecked()

    item = stage.view.table.item(1, 0)
    assert item is not None
    item.setCheckState(Qt.CheckState.Unchecked)
    assert stage.presenter.edits.of("right").off
    assert cell(stage, 1, "Remarks") == "Left out by hand"
    stage.view.table.setCurrentCell(2, 0)
    assert mark(stage, "A1").state == "used"


@pytest.mark.slow
def test_the_box_is_bounded_by_its_faces_and_by_numbers(stage: FootStage) -> None:
    """Escape gives a drag up."""
    scene, before = stage.view.foot.scene, stage.presenter.box
    assert before is not None
    handle = next(h for h in scene.handles if h.name == "box-x-max")
    start = QPoint(*(round(x) for x in scene.look.pixels_of(np.array(handle.position_mm))[0]))
    QTest.mousePress(scene.surface, LEFT, pos=start)
    QTest.mouseMove(scene.surface, start + QPoint(9, 0))
    QTest.keyClick(scene.surface, Qt.Key.Key_Escape)
    QTest.mouseRelease(scene.surface, LEFT, pos=start + QPoint(9, 0))
    assert stage.presenter.box == before
    assert next(h for h in scene.handles if h.name == "box-x-max") == handle

    handle = next(h for h in scene.handles if h.name == "box-y-min")
    start = QPoint(*(round(x) for x in scene.look.pixels_of(np.array(handle.position_mm))[0]))
    mm = scene.look.mm_per_px
    QTest.mousePress(scene.surface, LEFT, pos=start)
    for share in (10, 20):
        QTest.mouseMove(scene.surface, start - QPoint(0, share))
        QApplication.processEvents()
    assert stage.presenter.box == before
    QTest.mouseRelease(scene.surface, LEFT, pos=start - QPoint(0, 20))
    after = stage.presenter.box
    assert after is not None
    assert after.min_mm[1] == pytest.approx(before.min_mm[1] + 20 * mm, abs=1.5)
    assert after.max_mm == before.max_mm
    stage.view.box.reset.click()
    assert stage.presenter.box == before

    low, _ = stage.view.box._fields[2]
    low.setValue(10.0)
    assert stage.presenter.box is not None
    assert stage.presenter.box.min_mm[2] == 10.0
    stage.view.box.show_box(Box((0, 0, 0), (1, 1, 1)))
    assert stage.view.box.box().max_mm == (20.0, 20.0, 20.0)


def test_a_damaged_session_closes_the_stage(
    app: Application, settle: Callable[[], None], tmp_path: Path
) -> None:
    (tmp_path / "session").mkdir()
    app.features.case_files.opener.open_path(tmp_path / "session")
    settle()
    assert app.features.foot.stage is None
    (dialog,) = app.services.messages.dialogs
    assert "holds no manifest.json" in dialog.text()


def with_views(session: Path, folder: Path, names: Sequence[str]) -> Path:
    """A copy of a recorded session whose views are copies of its first one, under these names."""
    with zipfile.ZipFile(session) as archive:
        archive.extractall(folder)
    manifest = json.loads((folder / "manifest.json").read_text())
    first, *others = manifest["views"]
    for name in names:
        if name not in manifest["views"]:
            shutil.copytree(folder / "views" / first, folder / "views" / name)
    for name in set(others) - set(names):
        shutil.rmtree(folder / "views" / name)
    manifest["views"] = list(names)
    (folder / "manifest.json").write_text(json.dumps(manifest))
    return folder


@pytest.mark.slow
def test_a_session_of_three_views_follows_one_of_six(
    app: Application, qtbot: QtBot, session: Path, tmp_path: Path
) -> None:
    six = with_views(session, tmp_path / "six", ["left", "right", "top", "heel", "toes", "inside"])
    app.features.case_files.opener.open_path(six)
    stage = shown_stage(app)
    qtbot.waitUntil(lambda: stage.view.table.rowCount() == 6)
    stage.view.cancel_requested.emit()
    QTest.qWait(50)
    app.features.case_files.opener.open_path(session)
    assert stage.view.table.rowCount() == 0  # nothing of the first is left while this one is read
    assert stage.view.foot.scene._mesh is None
    assert stage.view.markers.picture._image.isNull()
    with qtbot.captureExceptions() as exceptions:
        qtbot.waitUntil(lambda: stage.view.table.rowCount() == 3)
    assert exceptions == []
    assert app.jobs.is_running("reconstruct")
    assert stage.view._name.text() == session.stem


def test_a_session_that_fails_on_the_way_leaves_nothing_of_the_one_before(
    app: Application, stage: FootStage, settle: Callable[[], None], session: Path, monkeypatch
) -> None:
    def fail(*_rows: object) -> None:
        raise RuntimeError("the table cannot be filled")

    again = session.with_name("again.zip")
    shutil.copy(session, again)
    monkeypatch.setattr(stage.view.markers, "show_markers", fail)
    app.features.case_files.opener.open_path(again)
    settle()
    assert app.features.foot.stage is None
    (dialog,) = app.services.messages.dialogs
    assert "the table cannot be filled" in dialog.detailedText()
    assert app.case.foot is None


@pytest.mark.drawn
@pytest.mark.slow
def test_another_map_is_drawn_at_once(
    app: Application, settle: Callable[[], None], qtbot: QtBot, session: Path
) -> None:
    app.features.case_files.opener.open_path(session)
    settle()
    view = shown_stage(app).view
    QTest.qWait(500)  # until the views are drawn

    def shown() -> IntArray:
        return colors_of(view.foot.scene.surface.grab().toImage())  # without drawing it anew

    before = shown()

    def differs() -> bool:
        return bool((shown() != before).any(axis=-1).sum() > 1000)

    QTest.keyClick(view.maps, Qt.Key.Key_Down)  # from the colours of the views to the skin's
    qtbot.waitUntil(differs)


@pytest.mark.display
def test_the_views_and_the_box_are_seen(
    app: Application, settle: Callable[[], None], session: Path
) -> None:
    """With real GL: the two sole views have their colours, and the edges of the box are blue."""
    app.features.case_files.opener.open_path(session)
    settle()
    stage = shown_stage(app)
    stage.view._look(Preset.PLANTAR)
    red, green, blue = np.moveaxis(colors_of(stage.view.foot.scene.picture()), -1, 0)
    orange = (red > green + 40) & (green > blue + 40)
    bluish = (blue > red + 60) & (blue > green + 30)
    assert orange.sum() > 500
    greenish = (green > red + 60) & (green > blue + 20)
    assert greenish.sum() > 500
    edge = stage.view.foot.scene.look.pixels_of(
        np.array(stage.view.foot.scene.handles[0].position_mm)
    )
    x = round(edge[0][0])
    assert bluish[:, x - 2 : x + 3].any(axis=1).sum() > 100
