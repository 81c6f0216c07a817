"""What was closed is freed, in a window that stays open for weeks."""

from __future__ import annotations

import gc
import weakref
from collections.abc import Callable
from dataclasses import replace

from PySide6.QtCore import QCoreApplication, QEvent
from PySide6.QtWidgets import QApplication

from insole_core.cases.case_record import ScanSource
from insole_core.foot.foot import Foot
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.side import Side
from insole_studio.app.bootstrap import Application, UserPaths, build_application

NOWHERE = ScanSource("mesh", "/nowhere/foot.ply", "0" * 64)
MakeFoot = Callable[[Side], Foot]
Settle = Callable[[], None]


def own_foot(make_foot: MakeFoot) -> Foot:
    """A foot that nobody else holds."""
    foot = make_foot(Side.LEFT)
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
