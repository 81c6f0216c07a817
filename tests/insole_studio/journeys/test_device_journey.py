"""Devices, findings and shells, chosen and changed by real events in the real window."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from pointing import LEFT, drag
from PySide6.QtCore import QPoint, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QLabel, QPushButton
from pytestqt.qtbot import QtBot

from insole_core.insole.elements import HeelCup, Pelott
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.prescription.shell import Shell
from insole_core.workflows.clinic_devices import clinic_forms
from insole_studio.app.bootstrap import Application
from insole_studio.features.design.devices.devices_view import DevicesView
from insole_studio.widgets.form_parts import ComboBox, LinkLabel
from insole_studio.widgets.number_field import NumberField

pytestmark = [pytest.mark.slow, pytest.mark.one_window]


def act(app: Application, key: str) -> None:
    app.window.actions_by_key[key].trigger()


def design(app: Application) -> InsoleDesign:
    assert app.case.record.design is not None
    return app.case.record.design


def shell(app: Application) -> Shell:
    value = design(app).shell
    assert value is not None
    return value


def list_of(app: Application) -> DevicesView:
    act(app, "choose_device")
    view = app.features.design.devices.view
    assert view is not None
    return view


def rows(view: DevicesView) -> list[str]:
    items = [view.list.item(number) for number in range(view.list.count())]
    return [item.text() for item in items if item.data(Qt.ItemDataRole.UserRole)]


def said(view: DevicesView) -> str:
    return "\n".join(label.text() for label in view.details.findChildren(QLabel))


def choose(app: Application, text: str, settle: Callable[[], None]) -> None:
    view = list_of(app)
    QTest.keyClicks(view.search, text)
    QTest.keyClick(view.search, Qt.Key.Key_Return)
    settle()
    assert app.features.design.devices.view is None


def number(app: Application, key: str) -> NumberField:
    fields = app.stage.parameters.findChildren(NumberField)
    return next(field for field in fields if field.property("key") == key)


def choice(app: Application, key: str) -> ComboBox:
    boxes = app.stage.parameters.findChildren(ComboBox)
    return next(box for box in boxes if box.property("key") == key)


def type_number(app: Application, key: str, text: str) -> None:
    field = number(app, key)
    field.setFocus()
    field.selectAll()
    QTest.keyClicks(field, text)
    QTest.keyClick(field, Qt.Key.Key_Return)


def pick(app: Application, key: str, word: str) -> None:
    box = choice(app, key)
    box.setCurrentIndex(box.findData(word))
    box.activated.emit(box.currentIndex())


def test_the_list_is_filtered_by_typing_and_walked_by_arrows(opened: Application) -> None:
    view = list_of(opened)
    everything = rows(view)
    assert len(everything) > 20
    QTest.keyClicks(view.search, "child")
    assert any("UCBL" in row for row in rows(view))
    assert len(rows(view)) < len(everything) / 2
    first = view.chosen
    QTest.keyClick(view.search, Qt.Key.Key_Down)
    assert view.chosen != first
    QTest.keyClick(view.search, Qt.Key.Key_Up)
    assert view.chosen == first
    QTest.keyClicks(view.search, " zzz")
    assert rows(view) == []
    assert "type others" in said(view)
    assert not view.apply_button.isEnabled()
    QTest.keyClick(view.search, Qt.Key.Key_Return)
    assert opened.features.design.devices.view is view, "there is nothing to apply"


def test_what_changes_is_shown_before_and_applied_as_one_step(
    opened: Application, settle: Callable[[], None]
) -> None:
    before, steps = design(opened), len(opened.case.history)
    view = list_of(opened)
    QTest.keyClicks(view.search, "ucbl")
    assert "Heel cup" in said(view)
    assert "20 mm" in said(view)
    assert "Source:" in said(view)
    assert design(opened) == before, "nothing is applied by itself"
    QTest.mouseClick(view.apply_button, LEFT)
    settle()
    assert design(opened).device == "UCBL, child"
    assert len(opened.case.history) == steps + 1
    assert opened.stage.preview.problem == ""
    act(opened, "undo")
    assert design(opened) == before


def test_a_finding_proposes_and_keeps_what_is_prescribed(
    opened: Application, settle: Callable[[], None]
) -> None:
    pad = Pelott(centre_mm=(0.0, 150.0))
    opened.case.apply(design(opened).with_added(pad), "Place a pelott")
    steps = len(opened.case.history)
    choose(opened, "tibialis", settle)
    assert design(opened).correction(pad.id) == pad
    assert design(opened).finish is not None
    assert len(opened.case.history) == steps + 1
    assert opened.case.history.undo_sentence.startswith("Finding: ")


def test_a_base_form_keeps_the_device(opened: Application, settle: Callable[[], None]) -> None:
    choose(opened, "eva full", settle)
    finish = design(opened).finish
    view = list_of(opened)
    QTest.keyClicks(view.search, "eva full")
    forms = [n for n in range(view.list.count()) if "form:" in str(view.list.item(n).data(256))]
    view.list.setCurrentRow(forms[0])
    QTest.mouseClick(view.apply_button, LEFT)
    settle()
    assert design(opened).base is not None
    assert design(opened).finish == finish


def test_a_base_form_is_blended_with_the_foot(
    opened: Application, settle: Callable[[], None]
) -> None:
    choose(opened, "eva full", settle)
    view = list_of(opened)
    QTest.keyClicks(view.search, "eva full")
    forms = [n for n in range(view.list.count()) if "form:" in str(view.list.item(n).data(256))]
    view.list.setCurrentRow(forms[0])
    QTest.mouseClick(view.apply_button, LEFT)
    settle()
    type_number(opened, "base.contact_share", "40")
    settle()
    base = design(opened).base
    assert base is not None
    assert base.contact_share == pytest.approx(0.4)
    opened.case.undo()
    settle()
    base = design(opened).base
    assert base is not None
    assert base.contact_share == 0.0


def test_the_form_of_an_insole_is_kept_as_a_base(
    opened: Application, settle: Callable[[], None], questions: object
) -> None:
    choose(opened, "eva full", settle)
    view = list_of(opened)
    questions.typed = "Anna's arch"  # type: ignore[attr-defined]
    entry = next(a for a in view.more.menu().actions() if a.data() == "form")
    entry.trigger()
    assert opened.jobs.is_running("form"), "the window does not wait for it"
    settle()
    stored = clinic_forms(opened.services.paths.settings_folder).load()
    assert "anna-s-arch" in stored.own
    assert view.chosen == "form:anna-s-arch"
    assert "those of this design come on top" in said(view)  # a pad of both would be there twice
    view.reject()


def test_a_form_of_a_much_shorter_foot_is_refused_before_it_is_applied(
    opened: Application, settle: Callable[[], None]
) -> None:
    forms = clinic_forms(opened.services.paths.settings_folder)
    adults = next(form for form in forms.load().items.values() if form.name == "Flat")
    forms.save(replace(adults, name="Doll", length_mm=adults.length_mm / 2.2))
    view = list_of(opened)
    QTest.keyClicks(view.search, "doll")
    settle()
    assert "choose a form of about its length" in said(view)
    assert not view.apply_button.isEnabled()
    view.reject()


def test_posts_weight_and_thickness_of_a_shell(
    opened: Application, settle: Callable[[], None]
) -> None:
    choose(opened, "functional three", settle)
    pick(opened, "post.rearfoot", "")
    assert shell(opened).posts == ()
    pick(opened, "post.rearfoot", "rearfoot")
    type_number(opened, "post.rearfoot.angle_deg", "4")
    (post,) = shell(opened).posts
    assert (post.region, post.angle_deg) == ("rearfoot", 4.0)
    type_number(opened, "shell.body_weight_kg", "100")
    assert shell(opened).body_weight_kg == 100.0
    buttons = opened.stage.parameters.findChildren(QPushButton)
    take = next(button for button in buttons if button.text() == "Take 4.8 mm")
    QTest.mouseClick(take, LEFT)
    settle()
    assert design(opened).thickness_mm == 4.8
    for wrong in ("3", "400"):
        type_number(opened, "shell.body_weight_kg", wrong)
        assert shell(opened).body_weight_kg == 100.0, "what was known is kept"
    type_number(opened, "shell.body_weight_kg", "0")
    assert shell(opened).body_weight_kg is None
    assert opened.stage.preview.problem == ""


def test_a_cover_is_glued_on_later_and_the_insole_gets_narrow(
    opened: Application, settle: Callable[[], None]
) -> None:
    type_number(opened, "layers.cover_mm", "2")
    pick(opened, "layers.cover_material", "EVA")
    assert design(opened).layers.cover_material == "EVA"
    pick(opened, "layers.cover_material", "")
    assert design(opened).layers.cover_material is None
    pick(opened, "layers.cover_is_taken_off", "1")
    assert design(opened).layers.cover_is_taken_off is True
    pick(opened, "outline.width_mm", "1")
    assert design(opened).outline.width_mm == -3.2
    pick(opened, "outline.width_mm", "0")
    settle()
    assert design(opened).outline.width_mm is None


@pytest.mark.parametrize("name", ["foot", "insole"])
def test_the_front_edge_of_a_shell_is_dragged(
    opened: Application, settle: Callable[[], None], name: str
) -> None:
    choose(opened, "functional three", settle)
    act(opened, "tool_rim")
    view = getattr(opened.stage, name).scene
    handle = next(h for h in view.handles if h.name == "trim:1")
    x, y = view.look.pixels_of(np.array(handle.position_mm))[0]
    start, steps = QPoint(round(x), round(y)), len(opened.case.history)
    drag(view, start, start + QPoint(0, 8))
    settle()
    points = shell(opened).trim_mm
    assert points is not None
    behind_mm = handle.position_mm[1] - points[1][1]
    assert behind_mm == pytest.approx(8 * view.look.mm_per_px, abs=1.5)
    assert len(opened.case.history) == steps + 1
    good = design(opened)
    drag(view, start + QPoint(0, 8), start + QPoint(0, 250))
    settle()
    assert opened.stage.preview.problem == "", "beyond what leaves a shell the last good one stays"
    assert design(opened).shell != good.shell or design(opened) == good


def test_a_heel_cup_is_seen_in_the_rim(opened: Application, settle: Callable[[], None]) -> None:
    choose(opened, "eva full", settle)
    opened.case.apply(design(opened).with_added(HeelCup(depth_mm=20.0)), "Add a heel cup")
    settle()
    curve = opened.stage.rim_model.curve
    assert curve is not None
    assert curve.height_at(curve.edge.heel_mm) == pytest.approx(20.0, abs=1.0)
    assert len(opened.stage.rim_model.placed) == len(design(opened).finish.rim)  # type: ignore[union-attr]


def test_the_device_stands_above_the_corrections(
    opened: Application, settle: Callable[[], None]
) -> None:
    choose(opened, "eva full", settle)
    pad = Pelott(centre_mm=(0.0, 150.0))
    opened.case.apply(design(opened).with_added(pad), "Place a pelott")
    opened.case.select(pad.id)
    buttons = opened.stage.patient.findChildren(QPushButton)
    row = next(b for b in buttons if b.text() == "Device: EVA, full length")
    assert not row.isChecked()
    QTest.mouseClick(row, LEFT)
    assert opened.case.selection is None
    assert row.isChecked()


def test_what_the_finish_cannot_do_is_said_and_leads_there(
    opened: Application, settle: Callable[[], None], qtbot: QtBot
) -> None:
    """This sole has no flanks: any cup stands free of the foot."""
    choose(opened, "ucbl", settle)

    def warnings() -> list[LinkLabel]:
        labels = opened.stage.patient.findChildren(LinkLabel)
        return [w for w in labels if w.objectName() == "warning" and w.isVisible()]

    def of_rim() -> list[LinkLabel]:
        return [w for w in warnings() if "rim" in w.text()]

    qtbot.waitUntil(lambda: len(of_rim()) > 0)
    said_of_rim = of_rim()[0]
    before = opened.stage.insole.scene.camera.focal_mm
    said_of_rim.linkActivated.emit(str(warnings().index(said_of_rim)))
    assert opened.stage.insole.scene.camera.focal_mm != before
