"""How load moves is shown while the insole is drawn, once what it can tell has been read."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
import pytest
from image_colors import colors_of
from pointing import LEFT
from PySide6.QtCore import QPoint, QRect, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QDockWidget
from pytestqt.qtbot import QtBot

from insole_core.cases.case_record import FootRecord
from insole_core.contact.change import SENTENCE, Change
from insole_core.imprints.form import Form
from insole_core.insole.elements import Pelott
from insole_core.insole.prescription.outline import Outline
from insole_core.insole.prescription.shell import Shell
from insole_core.pressure.laid_map import Placement, PressureMap
from insole_core.workflows.plantar_pressure import with_pressure
from insole_core.workflows.starting_design import mirrored_foot
from insole_studio.app.bootstrap import Application
from insole_studio.document.side_by_side import Beside
from insole_studio.features.design.load.load_dialog import LoadDialog
from insole_studio.features.design.models.color_maps import MapKind
from insole_studio.widgets.legend import SwatchLegend

Settle = Callable[[], None]
BESIDE_FOOT = Outline(
    source="drawn", points_mm=((150.0, 0.0), (190.0, 0.0), (190.0, 40.0), (150.0, 40.0))
)


@dataclass(frozen=True)
class SmallScreen:
    """What a window asks of its screen."""

    room: QRect

    def availableGeometry(self) -> QRect:  # noqa: N802
        return self.room


def act(app: Application, key: str) -> None:
    app.window.actions_by_key[key].trigger()


def measured(change: Change) -> PressureMap:
    """The pressures on the floor as a plate would show them."""
    field = change.sole.field
    middle = [float(along[0] + along[-1]) / 2 for along in (field.x_mm, field.y_mm)]
    kpa = 1000 * change.old.mpa[::-1]
    return PressureMap(kpa, (field.step_mm, field.step_mm), Placement(*middle))


def _higher(foot: FootRecord | None) -> FootRecord:
    """The foot with higher pads."""
    assert foot is not None
    design = foot.design
    for pad in design.of(Pelott):
        design = design.with_changed(replace(pad, height_mm=pad.height_mm + 3))
    return foot.with_design(design)


def test_the_change_is_read_of_first_then_asked_then_follows_the_hand(
    app: Application, settle: Settle, qtbot: QtBot
) -> None:
    act(app, "open_example")
    settle()
    load, stage = app.stage.load, app.stage
    act(app, "map_load")
    (dialog,) = app.window.findChildren(LoadDialog)
    assert dialog.question is None
    assert not dialog.go_on.isEnabled()
    QTest.mouseClick(dialog.was_read, LEFT)
    QTest.mouseClick(dialog.go_on, LEFT)
    settle()
    assert not dialog.table.rows  # no weight is assumed
    assert "body weight" in dialog.problem.text()
    QTest.keyClicks(dialog.weight, "75")
    QTest.keyClick(dialog.weight, Qt.Key.Key_Return)
    settle()
    assert app.services.settings.pressure_change_read
    assert load.change is not None
    assert dialog.problem.isHidden()
    shown = {row.key: row.cells for row in dialog.table.rows}
    assert len(shown) == 9
    assert re.fullmatch(r"−\d+\N{NO-BREAK SPACE}% \(−\d+ … [−+]?\d+\)", shown["heel"][1])
    assert all(" … " in cells[1] or cells[1] == "cannot tell" for cells in shown.values())
    for view in (stage.insole, stage.foot):
        assert view.numbers.text() == SENTENCE
    assert app.window.actions_by_key["map_load"].isChecked()

    before = load.change
    assert load.limits is not None
    untold = set(load.limits.cannot_tell)
    assert untold > set(before.untold)  # of some it is found by the limits alone
    (pad,) = app.case.record.design.of(Pelott)
    higher = app.case.record.design.with_changed(replace(pad, height_mm=pad.height_mm + 3))
    app.case.preview(higher)  # as at a drag
    assert load.change is not before  # in the picture of this move, not in a later one
    assert load.change.old is before.old
    settle()
    assert load.limits is None  # only once the hand rests
    assert set(load.untold_of(load.change)) >= untold  # and none aims by what will be grey then
    assert {row.cells[1] for row in dialog.table.rows} == {"…"}
    apex = np.array(pad.centre_mm)
    pressed = [
        float(replace(one.sole.field, heights_mm=one.new_kpa).height_at(apex))
        for one in (before, load.change)
    ]
    assert pressed[1] > pressed[0]
    drawn = load.change
    app.case.preview(app.case.record.design)  # the hand comes back to where it began
    assert load.change is not drawn
    assert np.abs(load.change.new_kpa - before.new_kpa).max() < 0.1 * before.new_kpa.max()
    app.case.end_preview()
    settle()
    assert load.limits is not None

    # Papers carry nothing unless it is ticked, then with the sentence, and of this design alone.
    ordered = app.case.record
    assert load.told_on_papers(ordered) == {}
    QTest.mouseClick(dialog.papers, LEFT, pos=QPoint(8, dialog.papers.height() // 2))
    (lines,) = load.told_on_papers(ordered).values()
    assert lines[-1] == SENTENCE
    assert any(line.startswith("Heel: −") and "%" in line for line in lines)
    foot = ordered.current
    assert foot is not None
    thicker = replace(foot.design, thickness_mm=foot.design.thickness_mm + 1)
    assert load.told_on_papers(ordered.with_foot(foot.with_design(thicker))) == {}
    act(app, "export")
    stage_of_export = app.features.export.stage
    assert stage_of_export is not None
    qtbot.waitUntil(lambda: bool(stage_of_export.presenter.parts))
    (part,) = stage_of_export.presenter.parts
    assert part.told == lines
    stage_of_export.close()
    QTest.mouseClick(dialog.papers, LEFT, pos=QPoint(8, dialog.papers.height() // 2))
    assert load.told_on_papers(ordered) == {}

    # Of a region that is relieved only because the pad is pressed now, no height is told.
    for region, percent, shown, text in (
        ("midfoot", -10.0, False, "No height can be told: "),
        ("heel", 30.0, True, "No height of the pad that was tried reaches it: it makes"),
    ):
        dialog.region.setCurrentIndex(dialog.region.findData(region))
        dialog.percent.show_value(percent)
        dialog.region.activated.emit(dialog.region.currentIndex())
        settle()
        assert (load.curve is not None) is shown  # what is not told is not computed either
        assert dialog.dose.text().startswith(text)
        assert dialog.chart.isHidden() is not shown
    assert load.curve is not None
    assert load.curve.doses_mm[0] == 0
    dialog.percent.show_value(round(load.curve.percents[3]))
    dialog.region.activated.emit(dialog.region.currentIndex())
    assert dialog.chart.isHidden()  # that of another target
    settle()
    assert load.curve is not None
    assert load.dose is not None, load.curve.percents
    assert load.curve.is_within(load.dose.told)
    assert dialog.dose.text().startswith("The height of this pad hardly matters there")
    assert not dialog.chart.isHidden()
    dialog.region.setCurrentIndex(0)
    dialog.region.activated.emit(0)
    assert dialog.chart.isHidden()
    assert dialog.dose.isHidden()

    # Two variants: their difference, or both maps side by side with one legend.
    first = app.case.record.current
    assert first is not None
    act(app, "variant_duplicate")
    app.case.apply(app.case.record.with_foot(_higher(app.case.record.current)), "Change")
    assert not dialog.both.isEnabled()  # beside a flat shoe there is nothing to show
    dialog.against.setCurrentIndex(dialog.against.findData(first.chosen))
    dialog.against.activated.emit(dialog.against.currentIndex())
    settle()
    difference = load.change
    assert difference is not None
    assert stage.counterpart.kind is Beside.NOTHING
    QTest.mouseClick(dialog.both, LEFT, pos=QPoint(8, dialog.both.height() // 2))
    settle()
    beside = load.beside(first.design)
    assert beside is not None
    assert load.change is not None
    assert load.change.old is beside.old  # a flat shoe
    np.testing.assert_allclose(beside.new_kpa, difference.old_kpa, atol=1.0)
    np.testing.assert_allclose(load.change.new_kpa, difference.new_kpa, atol=1.0)
    assert not np.allclose(beside.new_kpa, load.change.new_kpa, atol=1.0)
    across = Qt.Orientation.Horizontal
    headings = [dialog.table.model().headerData(column, across) for column in range(3)]
    second = app.case.record.current
    assert second is not None
    titles = [f"Variant {name}" for name in (second.chosen, first.chosen)]
    assert headings[1:] == [f"{title} (95 %)" for title in titles]
    assert [len(line) > 0 for line in dialog.area.text().split("\n")] == [True, True]
    assert all(len(row.cells) == 3 and row.cells[2] for row in dialog.table.rows)
    for view in (stage.insole, stage.foot):
        actor = view.scene.painter._plotter.actors["companion"]
        red, _, blue = actor.mapper.dataset.point_data["painted"].astype(int).T
        assert (blue > red + 40).any()  # relieved, on the same scale as the other one
    app.case.preview(_higher(second).design)
    assert load.beside(first.design) is beside  # stays while the other one is drawn
    assert {row.cells[1] for row in dialog.table.rows} == {"…"}
    assert "%" in {row.key: row.cells for row in dialog.table.rows}["heel"][2]
    app.case.end_preview()
    settle()
    assert load.beside(first.design) is beside
    QTest.mouseClick(dialog.both, LEFT, pos=QPoint(8, dialog.both.height() // 2))
    settle()
    assert load.beside(first.design) is None
    assert stage.counterpart.kind is Beside.NOTHING
    assert "companion" not in stage.foot.scene.painter._plotter.actors
    app.case.undo()
    app.case.undo()
    settle()
    assert dialog.against.currentData() == ""

    # What cannot be made is told, and has no figures.
    outside = replace(app.case.record.design, outline=BESIDE_FOOT)
    app.case.apply(outside, "Change")
    settle()
    assert {row.cells[1] for row in dialog.table.rows} == {"cannot tell"}
    assert dialog.problem.text()
    app.case.undo()

    # Fitted to a map under the foot, with its error where the fit did not look.
    assert not dialog.fit.isEnabled()
    foot = app.case.record.current
    assert foot is not None
    app.case.apply(app.case.record.with_foot(with_pressure(foot, measured(before))), "Lay a map")
    QTest.mouseClick(dialog.fit, LEFT, pos=QPoint(8, dialog.fit.height() // 2))
    settle()
    assert load.fitted is not None, load.problem
    assert f"off by {load.fitted.error_percent:.0f} %" in dialog.fitted.text()
    assert load.limits is not None
    assert load.limits.assumed is load.fitted.assumed
    app.case.undo()
    assert not dialog.fit.isChecked()
    settle()
    assert load.fitted is None
    assert dialog.fitted.isHidden()

    # Of a foot that was recorded with weight on it, nothing is told; of one with a part, that.
    for weight, said in (("full", dialog.problem), ("semi", dialog.assumed)):
        foot = app.case.record.current
        assert foot is not None
        source = replace(foot.source, weight_bearing=weight)
        app.case.apply(app.case.record.with_foot(replace(foot, source=source)), "Change")
        settle()
        assert (load.change is None) == (weight == "full")
        assert "recorded with" in said.text()
        app.case.undo()

    # The other foot has nothing of this one's, not even what is being computed.
    whole = app.case.record
    left = whole.current
    assert left is not None
    right = mirrored_foot(left, app.case.stamped)
    assert right.foot is not None
    right = replace(right, foot=replace(right.foot, form=Form.IMPRINT))
    app.case.apply(right, "Add the other foot")
    assert load.change is None
    settle()
    assert load.change is not None
    assert load.change.sole.foot is right.foot
    assert "part of the weight" in dialog.assumed.text()
    app.case.undo()
    assert load.change is None

    dialog.reject()
    settle()
    assert load.change is None
    assert app.features.design.side_by_side.map_kind is MapKind.NONE
    assert app.window.actions_by_key["map_none"].isChecked()
    act(app, "map_load")
    (again,) = (one for one in app.window.findChildren(LoadDialog) if one.isVisible())
    assert again.is_read
    # Its weight is that of the person: as it was put in, or as the design says since.
    assert again.weight.value() == 75
    case = app.case.record.design
    assert case is not None
    lighter = replace(case.shell or Shell(), body_weight_kg=60.0)
    app.case.apply(replace(case, shell=lighter), "Body weight")
    settle()
    assert again.weight.value() == 60
    assert load.change is not None
    assert load.change.loading.weight_kg == 60
    act(app, "new_case")
    settle()
    assert load.change is None
    assert not any(one.isVisible() for one in app.window.findChildren(LoadDialog))


@pytest.mark.display
def test_on_a_small_screen_the_window_covers_no_part_of_the_insole(
    app: Application, settle: Settle, qtbot: QtBot, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A laptop's 1366 × 768, with one insole and with two."""
    room = QRect(0, 0, 1366, 768)
    monkeypatch.setattr(LoadDialog, "screen", lambda _dialog: SmallScreen(room))
    app.window.setGeometry(room)
    act(app, "open_example")
    settle()
    scene = app.stage.insole.scene
    wide_px = scene.width()
    app.services.settings.pressure_change_read = True
    act(app, "map_load")
    (dialog,) = app.window.findChildren(LoadDialog)
    dialog.weight.setValue(75)
    settle()

    def is_seen() -> bool:
        """Whether the screen shows what is drawn of the insole, and none is under the window."""
        meshes = [app.stage.insole_presenter.mesh, app.stage.insole_presenter.companion]
        points = np.concatenate([mesh.vertices for mesh in meshes if mesh is not None])
        at_px = scene.look.pixels_of(points)
        corners = [
            scene.surface.mapToGlobal(QPoint(*np.rint(xy).astype(int).tolist()))
            for xy in (at_px.min(axis=0), at_px.max(axis=0))
        ]
        insole, legend = QRect(*corners), app.stage.insole.findChild(SwatchLegend)
        assert isinstance(legend, SwatchLegend)
        covering = dialog.frameGeometry()
        beside = QRect(legend.mapToGlobal(QPoint(0, 0)), legend.size())
        drawn = QRect(scene.surface.mapToGlobal(QPoint(0, 0)), scene.surface.size())
        if not drawn.contains(insole) or any(map(covering.intersects, (insole, beside))):
            return False
        shown = colors_of(app.window.screen().grabWindow(0).toImage())
        here = shown[insole.top() : insole.bottom(), insole.left() : insole.right()].astype(int)
        return bool((here[..., 2] - here[..., 0] > 60).any())  # the blue of what is relieved

    def covered_panels() -> list[str]:
        panels = [dock for dock in app.window.findChildren(QDockWidget) if dock.isVisible()]
        places = [(dock, QRect(dock.mapToGlobal(QPoint(0, 0)), dock.size())) for dock in panels]
        return [d.windowTitle() for d, at in places if at.intersects(dialog.frameGeometry())]

    qtbot.waitUntil(is_seen)
    assert room.contains(dialog.frameGeometry())
    assert covered_panels() == ["Patient"]
    act(app, "variant_duplicate")
    dialog.against.setCurrentIndex(1)
    dialog.against.activated.emit(1)
    dialog.both.click()
    settle()
    assert app.stage.insole_presenter.companion is not None
    qtbot.waitUntil(is_seen)
    assert room.contains(dialog.frameGeometry())
    assert covered_panels() == ["Patient"]

    dialog.move(700, 0)  # over the other view the insole has all its room again
    qtbot.waitUntil(lambda: scene.width() == wide_px)
    dialog.move(0, 0)
    qtbot.waitUntil(lambda: scene.width() < wide_px)
    dialog.reject()
    qtbot.waitUntil(lambda: scene.width() == wide_px)
