"""Findings and the table of materials, edited in the window."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QLabel, QPushButton

from insole_core.errors import InsoleError
from insole_core.insole.elements import BrushStroke, HeelSkive, Pelott
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.prescription.materials import read_materials
from insole_core.workflows.clinic_findings import ClinicFindings
from insole_core.workflows.clinic_tables import ClinicMaterials
from insole_studio.app.bootstrap import Application
from insole_studio.features.design.devices.devices_view import DevicesView
from insole_studio.features.design.devices.materials_dialog import MaterialsDialog
from insole_studio.widgets.number_field import NumberField

pytestmark = pytest.mark.slow

LEFT = Qt.MouseButton.LeftButton


def design(app: Application) -> InsoleDesign:
    assert app.case.record.design is not None
    return app.case.record.design


def list_of(app: Application) -> DevicesView:
    app.window.actions_by_key["choose_device"].trigger()
    view = app.features.design.devices.view
    assert view is not None
    return view


def search(view: DevicesView, text: str) -> None:
    view.search.clear()
    QTest.keyClicks(view.search, text)


def entry(view: DevicesView, key: str) -> None:
    action = next(a for a in view.more.menu().actions() if a.data() == key)
    assert action.isEnabled()
    action.trigger()


def offered(view: DevicesView, key: str) -> bool:
    return next(a for a in view.more.menu().actions() if a.data() == key).isEnabled()


def said(view: DevicesView) -> str:
    return "\n".join(label.text() for label in view.details.findChildren(QLabel))


def findings(app: Application) -> ClinicFindings:
    return ClinicFindings(app.services.paths.settings_folder)


def choose_device(app: Application, text: str, settle: Callable[[], None]) -> None:
    view = list_of(app)
    QTest.keyClicks(view.search, text)
    QTest.keyClick(view.search, Qt.Key.Key_Return)
    settle()


def test_a_design_is_kept_as_a_finding_and_applied_again(
    opened: Application, settle: Callable[[], None], questions: object
) -> None:
    choose_device(opened, "eva full", settle)
    plain = design(opened)
    stroke = BrushStroke(points_mm=((0.0, 100.0),))
    skived = plain.with_added(HeelSkive(depth_mm=4.0)).with_added(stroke)
    opened.case.apply(skived, "Skive")
    questions.given = {  # type: ignore[attr-defined]
        "name": "Our overpronation", "keywords": "valgus, rolling in", "source": "own",
    }  # fmt: skip
    view = list_of(opened)
    entry(view, "keep")
    sentence = questions.asked[-1]  # type: ignore[attr-defined]
    assert "heel skive, medial, 4 mm" in sentence
    assert "not part of it: Stroke" in sentence or "not part of it: " in sentence
    assert view.chosen == "finding:our-overpronation"
    opened.case.apply(plain, "Back")
    search(view, "rolling in")
    assert view.chosen == "finding:our-overpronation"
    assert "heel skive" in said(view)
    assert "Source: own" in said(view)
    QTest.mouseClick(view.apply_button, LEFT)
    settle()
    (skive,) = design(opened).corrections
    assert isinstance(skive, HeelSkive)
    assert skive.depth_mm == 4.0


def test_a_design_without_corrections_is_no_finding(
    opened: Application,
    settle: Callable[[], None],
    questions: object,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    choose_device(opened, "eva full", settle)
    shown: list[InsoleError] = []
    monkeypatch.setattr(
        opened.services.messages, "show_error", lambda error, _over=None: shown.append(error)
    )
    view = list_of(opened)
    entry(view, "keep")
    assert "add a correction or a pad" in str(shown[0])
    assert findings(opened).load().own == frozenset()
    view.reject()


def test_a_finding_is_edited_removed_and_the_supplied_ones_come_back(
    opened: Application, questions: object
) -> None:
    view = list_of(opened)
    search(view, "cavus")
    assert not offered(view, "remove_finding")
    questions.given = {"keywords": "hohlfuss", "source": "ours"}  # type: ignore[attr-defined]
    entry(view, "edit_finding")
    stored = findings(opened).load()
    assert stored.own == {"cavus-foot"}
    assert stored.items["cavus-foot"].keywords == ("hohlfuss",)
    assert stored.items["cavus-foot"].arch_fill_mm == 1.6, "what it proposes stays"
    search(view, "hohlfuss")
    assert view.chosen == "finding:cavus-foot"
    assert "Source: ours" in said(view)
    questions.given = {"name": "High arch"}  # type: ignore[attr-defined]
    entry(view, "edit_finding")
    assert findings(opened).load().own == {"high-arch"}
    assert "high arch" in findings(opened).load().items["cavus-foot"].keywords
    search(view, "high arch")
    entry(view, "remove_finding")
    assert findings(opened).load().own == frozenset()
    entry_is_left = offered(view, "reset_findings")
    assert not entry_is_left
    view.reject()


def test_findings_are_shared_as_a_file(
    opened: Application, questions: object, tmp_path: Path
) -> None:
    view = list_of(opened)
    search(view, "cavus")
    questions.path = tmp_path / "ours.insole-findings"  # type: ignore[attr-defined]
    entry(view, "export_finding")
    text = questions.path.read_text()  # type: ignore[attr-defined]
    questions.path.write_text(text.replace("Cavus foot", "Claw foot"))  # type: ignore[attr-defined]
    entry(view, "import_findings")
    assert view.chosen == "finding:claw-foot"
    assert findings(opened).load().own == {"claw-foot"}
    entry(view, "export_findings")
    entry(view, "reset_findings")
    assert findings(opened).load().own == frozenset()
    kept = list(opened.services.paths.settings_folder.glob("findings.json.kept-*"))
    assert len(kept) == 1, "nothing is lost"
    view.reject()


def test_findings_that_cannot_be_read_are_told_and_hide_no_others(opened: Application) -> None:
    folder = opened.services.paths.settings_folder
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "findings.json").write_text("half a fi")
    view = list_of(opened)
    search(view, "cavus")
    assert view.chosen == "finding:cavus-foot"
    notices = [label.text() for label in opened.stage.notices.findChildren(QLabel)]
    assert any("findings.json is not valid JSON" in text for text in notices)
    view.reject()


def table_of(app: Application) -> MaterialsDialog:
    app.window.actions_by_key["edit_materials"].trigger()
    dialog = app.features.design.devices.table.dialog
    assert dialog is not None
    return dialog


def row_of(dialog: MaterialsDialog, text: str) -> None:
    (row,) = [n for n in range(dialog.list.count()) if dialog.list.item(n).text() == text]
    dialog.list.setCurrentRow(row)


def retype(field: NumberField, text: str) -> None:
    field.setFocus()
    field.selectAll()
    QTest.keyClicks(field, text)
    QTest.keyClick(field, Qt.Key.Key_Return)


def test_a_material_is_changed_and_the_design_follows_as_one_step(
    opened: Application, settle: Callable[[], None]
) -> None:
    choose_device(opened, "functional three", settle)
    steps = len(opened.case.history)
    dialog = table_of(opened)
    row_of(dialog, "Polypropylene")
    retype(dialog.least, "4,5")
    retype(dialog.steps.thicknesses[0], "5")
    QTest.mouseClick(dialog.keep, LEFT)
    settle()
    shell = design(opened).shell
    assert shell is not None
    assert (shell.material, shell.least_mm, shell.least_edge_mm) == ("polypropylene", 4.5, None)
    assert len(opened.case.history) == steps + 1
    opened.case.apply(replace(design(opened), shell=replace(shell, body_weight_kg=70.0)), "Weigh")
    buttons = opened.stage.parameters.findChildren(QPushButton)
    assert [b.text() for b in buttons if b.text().startswith("Take ")] == ["Take 5 mm"]
    opened.case.undo()
    opened.case.undo()
    assert design(opened).shell == replace(shell, least_mm=None)
    table, _ = ClinicMaterials(opened.services.paths.settings_folder).load()
    assert table.material("polypropylene").least_mm == 4.5


def test_materials_are_added_and_removed(opened: Application) -> None:
    dialog = table_of(opened)
    supplied = dialog.materials
    QTest.mouseClick(dialog.add, LEFT)
    assert not dialog.problem.isVisible()
    QTest.keyClicks(dialog.name, "polypropylene")
    assert "already" in dialog.problem.text()
    assert not dialog.keep.isEnabled()
    dialog.name.selectAll()
    QTest.keyClicks(dialog.name, "Carbon")
    retype(dialog.shore, "25")
    assert (dialog.materials[-1].shore_a, dialog.materials[-1].modulus_mpa) == (25.0, None)
    QTest.mouseClick(dialog.steps.add, LEFT)
    retype(dialog.steps.weights[0], "80")
    QTest.mouseClick(dialog.steps.add, LEFT)
    assert dialog.materials[-1].steps[1].up_to_kg == 100.0
    retype(dialog.steps.weights[1], "60")
    assert "from light to heavy" in dialog.problem.text()
    QTest.mouseClick(dialog.steps.removes[1], LEFT)
    assert not dialog.problem.isVisible()
    row_of(dialog, "TPU, printed")
    QTest.mouseClick(dialog.remove, LEFT)
    QTest.mouseClick(dialog.keep, LEFT)
    table, _ = ClinicMaterials(opened.services.paths.settings_folder).load()
    names = [material.name for material in supplied if material.name != "TPU, printed"]
    assert list(table.names) == [*names, "Carbon"]
    assert [step.up_to_kg for step in table.material("Carbon").steps] == [80.0, math.inf]


def test_a_table_is_shared_and_the_supplied_one_comes_back(
    opened: Application, questions: object, tmp_path: Path
) -> None:
    dialog = table_of(opened)
    questions.path = tmp_path / "ours.insole-materials"  # type: ignore[attr-defined]
    row_of(dialog, "EVA")
    QTest.mouseClick(dialog.remove, LEFT)
    shared = dialog.materials
    _import, _export, _line, supplied = dialog.more.menu().actions()
    _export.trigger()
    supplied.trigger()
    assert dialog.materials == read_materials().materials
    _import.trigger()
    assert dialog.materials == shared == read_materials(questions.path).materials  # type: ignore[attr-defined]
    dialog.reject()
    table, _ = ClinicMaterials(opened.services.paths.settings_folder).load()
    assert table is read_materials(), "nothing is stored without saving"


def test_both_feet_follow_the_table(
    opened: Application, make_foot: Callable[..., object], settle: Callable[[], None]
) -> None:
    choose_device(opened, "functional three", settle)
    pad = Pelott(centre_mm=(0.0, 150.0))
    opened.case.apply(design(opened).with_added(pad), "Place a pelott")
    side = design(opened).side
    dialog = table_of(opened)
    row_of(dialog, "Polypropylene")
    retype(dialog.least_edge, "2")
    QTest.mouseClick(dialog.keep, LEFT)
    assert opened.case.record.at_hand is side
    assert design(opened).shell.least_edge_mm == 2.0  # type: ignore[union-attr]
    assert design(opened).correction(pad.id) == pad
