"""What was closed is freed, in a window that stays open for weeks."""

from __future__ import annotations

import gc
import weakref
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import pytest
from PySide6.QtCore import QCoreApplication, QEvent
from PySide6.QtWidgets import QApplication

from insole_core.cases.case_record import CaseRecord, FootRecord
from insole_core.cases.scan_source import ScanSource
from insole_core.foot.foot import Foot
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.side import Side
from insole_studio.app.bootstrap import Application, UserPaths, build_application

NOWHERE = ScanSource("mesh", "/nowhere/foot.ply", "0" * 64)
MakeFoot = Callable[[Side], Foot]
Settle = Callable[[], None]


@pytest.fixture(scope="module")
def same_results() -> None:
    """Share nothing with other tests: what they keep is never freed."""


def own_foot(make_foot: MakeFoot, side: Side = Side.LEFT) -> Foot:
    """A foot that nobody else holds."""
    foot = make_foot(side)
    return replace(foot, mesh=replace(foot.mesh, vertices=foot.mesh.vertices.copy()))


def living(watched: dict[str, weakref.ref[object]]) -> list[str]:
    gc.collect()
    return [name for name, found in watched.items() if found() is not None]


def test_a_case_is_freed_when_another_one_is_opened(
    app: Application, make_foot: MakeFoot, settle: Settle
) -> None:
    foot = own_foot(make_foot)
    app.case.open_foot(foot, NOWHERE)
    settle()
    for key in ("tool_key_point", "tool_section", "tool_turn", "add_posting", "copy_measures"):
        app.window.actions_by_key[key].trigger()
        settle()
    assert isinstance(app.stage.preview.mesh, TriangleMesh)
    watched: dict[str, weakref.ref[object]] = {
        "foot": weakref.ref(foot),
        "its mesh": weakref.ref(foot.mesh),
        "its insole": weakref.ref(app.stage.preview.mesh),
        "its record": weakref.ref(app.case.record),
    }
    del foot
    app.case.open_foot(own_foot(make_foot), NOWHERE)
    settle()
    assert living(watched) == []


def test_a_session_is_freed_with_its_stage_before_garbage_is_collected(
    app: Application, settle: Settle, small_session: Path
) -> None:
    app.features.foot.open_session(small_session, hand_over=False)
    settle()
    stage = app.features.foot.stage
    assert stage is not None
    work, (made,) = stage.presenter._work, stage.presenter._made_feet.values()
    assert work is not None
    watched: dict[str, weakref.ref[object]] = {
        "session": weakref.ref(work),
        "view": weakref.ref(next(iter(work.opened.measured.values()))),
        "foot": weakref.ref(made.scan.foot),
        "shown mesh": weakref.ref(stage.view.foot.scene._mesh),
    }
    del work, made, stage
    app.features.foot.close()
    assert not gc.isenabled()
    assert [name for name, found in watched.items() if found() is not None] == []


def test_an_application_is_freed_when_it_is_closed(
    qapp: QApplication, paths: UserPaths, make_foot: MakeFoot
) -> None:
    app = build_application(qapp, paths)
    app.window.show()
    app.case.open_foot(own_foot(make_foot), NOWHERE)
    while app.jobs.is_running():
        QApplication.processEvents()
    watched: dict[str, weakref.ref[object]] = {
        "application": weakref.ref(app),
        "case": weakref.ref(app.case),
        "record": weakref.ref(app.case.record),
        "plotter": weakref.ref(app.stage.foot.scene._canvas.plotter),
        "render window": weakref.ref(app.stage.insole.scene._canvas.plotter.render_window),
        "window": weakref.ref(app.window),
    }
    app.autosave.forget()
    app.close()
    del app
    QCoreApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)
    assert living(watched) == []


@pytest.mark.slow
def test_a_closed_case_leaves_nothing_behind_in_an_empty_window(
    app: Application, make_foot: MakeFoot, settle: Settle, export, tmp_path: Path
) -> None:
    left, right = own_foot(make_foot), own_foot(make_foot, Side.RIGHT)
    app.case.open_foot(right, NOWHERE)
    settle()
    export(tmp_path / "right.stl")
    exported = app.features.export.exported
    assert exported is not None
    app.case.apply(FootRecord.begun(left, NOWHERE), "Add a foot")
    settle()
    for key in ("beside_foot", "map_difference", "ghost", "tool_pelott", "tool_key_point"):
        app.window.actions_by_key[key].trigger()
        settle()
    built = app.stage.counterpart.built
    assert built is not None
    assert app.stage.preview.mesh is not None
    watched: dict[str, weakref.ref[object]] = {
        "left foot": weakref.ref(left),
        "left mesh": weakref.ref(left.mesh),
        "right foot": weakref.ref(right),
        "right mesh": weakref.ref(right.mesh),
        "insole": weakref.ref(app.stage.preview.mesh),
        "contact surface": weakref.ref(app.stage.preview.base),
        "what stood beside": weakref.ref(built),
        "solid beside": weakref.ref(built.solid),
        "surface of the renderer": weakref.ref(app.stage.foot.scene.painter._surface),
        "record": weakref.ref(app.case.record),
        "exported record": weakref.ref(exported),
    }
    del left, right, built, exported
    app.case.open(CaseRecord(), None)
    settle()
    assert living(watched) == []
    assert app.stage.foot.scene.painter.shown == frozenset()
    assert app.stage.insole.scene.painter.shown == frozenset()
