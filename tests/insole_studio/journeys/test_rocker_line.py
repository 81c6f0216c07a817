"""The line of a rocker in the views, by real mouse and key events."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from pointing import LEFT, drag, hold
from PySide6.QtCore import QPoint, Qt
from PySide6.QtTest import QTest

from insole_core.cases.case_record import FootRecord
from insole_core.cases.scan_source import ScanSource
from insole_core.geometry.side import Side
from insole_core.insole.elements import Rocker
from insole_core.insole.fields import ranges_of
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.primitives.height_field import heads_ahead
from insole_studio.app.bootstrap import Application
from insole_studio.scene.scene_view import SceneView

pytestmark = [pytest.mark.slow, pytest.mark.one_window]


@pytest.fixture(params=["left", "right"])
def rocked(
    request: pytest.FixtureRequest,
    opened: Application,
    make_foot: Callable[[Side], object],
    settle: Callable[[], None],
) -> Application:
    """A foot with a rocker of 10 mm, which is selected."""
    case, rocker = opened.case, Rocker(behind_heads_mm=10.0)
    if request.param == "right":
        foot, source = make_foot(Side.RIGHT), ScanSource("mesh", "/nowhere/right.ply", "0" * 64)
        record = FootRecord.begun(foot, source, InsoleDesign(Side.RIGHT))  # type: ignore[arg-type]
        case.apply(record, "Add the right foot")
        settle()
    assert case.record.design is not None
    case.apply(case.record.design.with_added(rocker), "Add a rocker")
    case.select(rocker.id)
    opened.window.actions_by_key["tool_orbit"].trigger()
    settle()
    return opened


def behind_mm(app: Application) -> float:
    assert app.case.record.design is not None
    found = [c for c in app.case.record.design.corrections if isinstance(c, Rocker)]
    return found[0].behind_heads_mm


def place(view: SceneView) -> QPoint:
    handle = next(h for h in view.handles if h.name == "rocker_line")
    x, y = view.look.pixels_of(np.array(handle.position_mm))[0]
    return QPoint(round(x), round(y))


def way(view: SceneView, app: Application, ahead_mm: float) -> QPoint:
    """Return the way on the screen that leads as far ahead of the heads."""
    assert app.case.foot is not None
    step = np.append(ahead_mm * heads_ahead(app.case.foot), 0.0)
    start, end = view.look.pixels_of(np.stack([np.zeros(3), step]))
    return QPoint(*(round(float(way)) for way in end - start))


def test_the_line_is_dragged_in_either_view(
    rocked: Application, settle: Callable[[], None]
) -> None:
    for view in (rocked.stage.insole.scene, rocked.stage.foot.scene):
        steps, start = len(rocked.case.history), place(view)
        drag(view, start, start + way(view, rocked, 6.0))
        settle()
        assert behind_mm(rocked) == pytest.approx(4.0, abs=1.0)
        assert len(rocked.case.history) == steps + 1
        assert rocked.case.history.undo_sentence == "Move the rocker line"
        moved = place(view) - start - way(view, rocked, 6.0)
        assert abs(moved.x()) + abs(moved.y()) < 8
        rocked.window.actions_by_key["undo"].trigger()
        settle()
        assert behind_mm(rocked) == 10.0
        assert len(rocked.case.history) == steps


def test_a_drag_ends_at_the_range_and_escape_takes_it_back(
    rocked: Application, settle: Callable[[], None]
) -> None:
    view = rocked.stage.insole.scene
    start = place(view)
    far = start + way(view, rocked, -80.0)
    QTest.mousePress(view.surface, LEFT, pos=start)
    QTest.mouseMove(view.surface, far)
    shown = rocked.case.shown.design
    assert shown is not None
    rocker = next(c for c in shown.corrections if isinstance(c, Rocker))
    assert rocker.behind_heads_mm == ranges_of(Rocker)["behind_heads_mm"].greatest
    QTest.keyClick(view.surface, Qt.Key.Key_Escape)
    assert rocked.case.shown.design == rocked.case.record.design
    QTest.mouseRelease(view.surface, LEFT, pos=far)
    settle()
    assert behind_mm(rocked) == 10.0


def test_arrow_keys_move_the_line_and_are_one_step(
    rocked: Application, settle: Callable[[], None]
) -> None:
    view, steps = rocked.stage.insole.scene, len(rocked.case.history)
    view.take_focus()
    hold(view.surface, Qt.Key.Key_Up, repeats=3)
    settle()
    assert behind_mm(rocked) == pytest.approx(8.0, abs=0.6)
    assert len(rocked.case.history) == steps + 1


def test_the_hint_names_the_handle_which_another_selection_takes_away(rocked: Application) -> None:
    assert "Rocker" in rocked.stage.tool_controller.tool.hint(rocked.case)
    rocked.case.select(None)
    names = [handle.name for handle in rocked.stage.insole.scene.handles]
    assert "rocker_line" not in names
