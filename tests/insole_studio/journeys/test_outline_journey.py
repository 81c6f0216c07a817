"""The outline is dragged as a spline, by real mouse events in the real window."""

from __future__ import annotations

from collections.abc import Callable
from itertools import product

import numpy as np
import pytest
from pointing import LEFT, drag, hold, lead
from PySide6.QtCore import QPoint, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QMenu

from insole_core.foot import measures
from insole_core.insole.outline.outline_drag import drag_weights
from insole_core.insole.prescription.outline import Outline
from insole_core.insole.primitives.outline_curve import evenly_spread, smoothed_along
from insole_studio.app.bootstrap import Application
from insole_studio.features.design.tools.outline_tool import curve_of
from insole_studio.scene.scene_view import SceneView
from insole_studio.widgets.form_parts import ComboBox
from insole_studio.widgets.number_field import NumberField

pytestmark = [pytest.mark.slow, pytest.mark.one_window]

RIGHT = Qt.MouseButton.RightButton


@pytest.fixture(params=["foot", "insole"])
def view(opened: Application, request: pytest.FixtureRequest) -> SceneView:
    """Either view: the tool works in both."""
    opened.window.actions_by_key["tool_outline"].trigger()
    scene: SceneView = getattr(opened.stage, request.param).scene
    return scene


def outline(app: Application) -> Outline:
    assert app.case.record.design is not None
    return app.case.record.design.outline


def pixel(view: SceneView, number: int) -> QPoint:
    """Where a point of the outline is seen."""
    handle = next(h for h in view.handles if h.name == f"outline:{number}")
    x, y = view.look.pixels_of(np.array(handle.position_mm))[0]
    return QPoint(round(x), round(y))


def place(view: SceneView, number: int) -> np.ndarray:
    handle = next(h for h in view.handles if h.name == f"outline:{number}")
    return np.array(handle.position_mm[:2])


def test_a_point_is_dragged_and_undone(
    opened: Application, view: SceneView, settle: Callable[[], None]
) -> None:
    before = place(view, 5)
    points = np.array([h.position_mm[:2] for h in view.handles])
    drag(view, pixel(view, 5), pixel(view, 5) + QPoint(12, 0))
    settle()
    assert outline(opened).source == "drawn"
    moved = place(view, 5) - before
    assert np.hypot(*moved) == pytest.approx(12 * view.look.mm_per_px, abs=0.2)
    weights = drag_weights(points, 5, moved)
    still = [f"outline:{n}" for n in np.flatnonzero(weights == 0)]
    assert len(still) > 20, "the neighbours follow, and most of the outline stays"
    assert all((place(view, int(name[8:])) == points[int(name[8:])]).all() for name in still)
    assert opened.stage.preview.mesh is not None
    assert opened.case.history.undo_sentence == "Move a point of the outline"
    assert len(opened.case.history) == 1
    opened.window.actions_by_key["undo"].trigger()
    assert outline(opened).source == "foot"


def curvature(app: Application) -> np.ndarray:
    """Curvature of the edge per mm, convex > 0, every millimetre, over 4 mm."""
    curve = curve_of(app.case.shown)
    length = np.hypot(*(np.roll(curve, -1, axis=0) - curve).T).sum()
    even = smoothed_along(evenly_spread(curve, int(length)), 4.0)
    before, after = np.roll(even, 1, axis=0), np.roll(even, -1, axis=0)
    way, bend = (after - before) / 2, after - 2 * even + before
    return (way[:, 0] * bend[:, 1] - way[:, 1] * bend[:, 0]) / np.hypot(*way.T) ** 3


def test_a_dragged_outline_stays_fair(opened: Application, settle: Callable[[], None]) -> None:
    opened.window.actions_by_key["tool_outline"].trigger()
    view = opened.stage.insole.scene
    before = curvature(opened)
    for number, pixels in product([5, 14, 27], [-25, -8, 8, 25]):
        drag_as_far(opened, view, number, pixels, settle)
        after = curvature(opened)
        assert len(opened.case.history) == 1
        assert after.max() < before.max() + 0.035, f"no corner at {number} by {pixels}"
        assert after.min() > before.min() - 0.02, f"no notch at {number} by {pixels}"
        opened.window.actions_by_key["undo"].trigger()
        np.testing.assert_array_equal(curvature(opened), before)


def drag_as_far(
    app: Application, view: SceneView, number: int, pixels: int, settle: Callable[[], None]
) -> None:
    """Drag a point sideways; again where the view moved below the mouse.

    The window of the tests is narrower than its longest message, and grows when that comes.
    """
    for _ in range(5):
        settle()
        start, before = pixel(view, number), place(view, number)
        way_mm = abs(pixels) * view.look.mm_per_px
        drag(view, start, start + QPoint(pixels, 0))
        if np.hypot(*(place(view, number) - before)) == pytest.approx(way_mm, abs=0.2):
            return
        app.window.actions_by_key["undo"].trigger()
    pytest.fail(f"point {number} did not follow the mouse")


def test_what_follows_is_seen_while_dragging(opened: Application, view: SceneView) -> None:
    tool, start = opened.stage.tool_controller.tool, pixel(view, 5)
    places = {h.name: h.position_mm for h in view.handles}
    lead(view, start, start + QPoint(12, 0))  # the button is still held
    larger = {h.name for h in view.handles if h.kind == "move"}
    assert "outline:5" in larger
    assert larger == {h.name for h in view.handles if h.position_mm[:2] != places[h.name][:2]}
    assert 5 <= len(larger) < 16
    ends = np.array(tool.sketch)[[0, -1]]
    first, last = (np.array(places[f"outline:{n}"][:2]) for n in still_beside(larger))
    np.testing.assert_allclose(ends, [first, last], atol=1e-6)
    QTest.mouseRelease(view.surface, LEFT, pos=start + QPoint(12, 0))
    assert tool.sketch == ()
    assert {h.kind for h in view.handles} == {"size"}


def still_beside(larger: set[str]) -> tuple[int, int]:
    """Return the points that stay, next to those that follow."""
    moved = {int(name.removeprefix("outline:")) for name in larger}
    first = next(n for n in moved if (n - 1) % 36 not in moved)
    last = next(n for n in moved if (n + 1) % 36 not in moved)
    return (first - 1) % 36, (last + 1) % 36


def test_steps_of_an_arrow_key_add_up_to_one_soft_drag(
    opened: Application, view: SceneView
) -> None:
    before = curvature(opened)
    drag(view, pixel(view, 5), pixel(view, 5) + QPoint(2, 0))
    hold(view.surface, Qt.Key.Key_Left, 3, Qt.KeyboardModifier.ShiftModifier)
    assert len(opened.case.history) == 2
    after = curvature(opened)
    assert after.max() < before.max() + 0.035
    assert after.min() > before.min() - 0.02


def test_escape_restores_the_outline(opened: Application, view: SceneView) -> None:
    start = pixel(view, 5)
    QTest.mousePress(view.surface, LEFT, pos=start)
    QTest.mouseMove(view.surface, start + QPoint(15, 0))
    assert opened.case.shown.design != opened.case.record.design
    QTest.keyClick(view.surface, Qt.Key.Key_Escape)
    assert opened.case.shown.design == opened.case.record.design
    QTest.mouseRelease(view.surface, LEFT, pos=start)
    assert len(opened.case.history) == 0


def test_a_click_alone_changes_nothing(opened: Application, view: SceneView) -> None:
    QTest.mouseClick(view.surface, LEFT, pos=pixel(view, 3))
    assert outline(opened).source == "foot"
    assert len(opened.case.history) == 0


def test_double_click_takes_a_point_away_and_adds_one(
    opened: Application, view: SceneView, settle: Callable[[], None]
) -> None:
    opened.window.resize(1280, 800)  # so that a point may lie between two others
    settle()
    count = len(view.handles)
    QTest.mouseDClick(view.surface, LEFT, pos=pixel(view, 6))
    assert len(view.handles) == count - 1
    between = (pixel(view, 5) + pixel(view, 6)) / 2
    QTest.mouseDClick(view.surface, LEFT, pos=between)
    assert len(view.handles) == count
    assert len(opened.case.history) == 2


def test_the_menu_under_the_pointer_offers_the_same(opened: Application, view: SceneView) -> None:
    count = len(view.handles)
    QTest.mouseClick(view.surface, RIGHT, pos=pixel(view, 6))
    (menu,) = view.findChildren(QMenu)
    remove = next(a for a in menu.actions() if a.text() == "Remove this point")
    remove.trigger()
    menu.close()
    assert len(view.handles) == count - 1


def test_an_outline_that_would_cross_itself_is_held(opened: Application, view: SceneView) -> None:
    line = np.array([place(view, n) for n in range(len(view.handles))])
    left, right = pixel(view, int(line[:, 0].argmin())), pixel(view, int(line[:, 0].argmax()))
    drag(view, left, right + (right - left))
    assert "cross itself" in opened.stage.tool_controller.tool.hint(opened.case)
    assert not opened.stage.preview.problem


def test_arrow_keys_move_the_last_point(opened: Application, view: SceneView) -> None:
    drag(view, pixel(view, 5), pixel(view, 5) + QPoint(12, 0))
    before = place(view, 5)
    hold(view.surface, Qt.Key.Key_Up, repeats=2)
    assert place(view, 5) - before == pytest.approx((0.0, 1.5), abs=0.02)
    assert len(opened.case.history) == 2


def choose(app: Application, source: str) -> None:
    field = next(
        c
        for c in app.stage.parameters.findChildren(ComboBox)
        if c.property("key") == "outline.source"
    )
    field.setCurrentIndex(field.findData(source))
    field.activated.emit(field.currentIndex())


def test_the_size_of_the_shoe_is_proposed(
    opened: Application, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(measures, "is_length_seen", lambda _landmarks: True)
    choose(opened, "shoe_size")
    # (250 + 15) mm / 6.67 mm = 39.75, to the half.
    assert outline(opened).shoe_size_eu == 40.0
    QApplication.processEvents()
    fields = {f.property("key") for f in opened.stage.parameters.findChildren(NumberField)}
    assert "outline.shoe_size_eu" in fields


def test_drawing_begins_with_the_outline_there_is(opened: Application) -> None:
    opened.window.actions_by_key["tool_outline"].trigger()
    before = [h.position_mm[:2] for h in opened.stage.insole.scene.handles]
    choose(opened, "drawn")
    assert outline(opened).points_mm == tuple(before)
    choose(opened, "foot")
    assert outline(opened).points_mm is None
