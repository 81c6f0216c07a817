"""The user checks a part, orders it otherwise, and hands it to the shop."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from datetime import date, timedelta
from pathlib import Path
from typing import Any

import pytest
import trimesh
from PySide6.QtCore import Qt
from PySide6.QtWidgets import (
    QAbstractSpinBox,
    QApplication,
    QStyle,
    QStyleOptionComboBox,
    QToolButton,
)
from pytestqt.qtbot import QtBot
from read_pdf import text_of_pdf

from insole_core.cases.case_record import CaseRecord, FootRecord, Patient
from insole_core.cases.order_note import OrderNote
from insole_core.cases.scan_source import ScanSource
from insole_core.export.order_verification import verify_order
from insole_core.export.shop_order import OrderTerms
from insole_core.foot.foot import Foot
from insole_core.geometry.side import Side
from insole_core.insole.elements import Pelott
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.prescription.materials import read_materials
from insole_core.insole.prescription.shell import Shell
from insole_core.solids.prescription_paper import Responsible
from insole_core.solids.shop import Block, read_shop
from insole_core.workflows.clinic_tables import ClinicBlocks, ClinicExportRules
from insole_core.workflows.last_order import LastOrder
from insole_core.workflows.make_order import OrderChoice
from insole_core.workflows.mill import clinic_machines
from insole_core.workflows.order_package import Ordered
from insole_core.workflows.starting_design import starting_device
from insole_studio.document.case import Case
from insole_studio.features.export.order_form import OrderForm, Stock
from insole_studio.features.export.rows import CheckState, OrderedFoot
from insole_studio.features.export.stage import ExportStage
from insole_studio.texts import load_language
from insole_studio.widgets.layouts import VerticalScroll

SHOP = read_shop()
PAIR = next(block for block in SHOP.blocks if block.name == "EVA pair")
ALONE = {
    Side.LEFT: "The left foot alone is made; “Both feet” makes the right one too.",
    Side.RIGHT: "The right foot alone is made; “Both feet” makes the left one too.",
}
NOWHERE = ScanSource("mesh", "/nowhere/foot.ply", "0" * 64)


@pytest.fixture
def case(make_foot: Callable[[Side], Foot]) -> Case:
    built = Case()
    feet = tuple(
        FootRecord.begun(make_foot(side), NOWHERE, InsoleDesign(side, grid_mm=2.0)) for side in Side
    )
    record = CaseRecord(Patient(name="Anna Berg", born="1980-01-01"), feet, Side.LEFT)
    built.open(record, None)
    built.author = "A. Ek"
    return built


class Chosen:
    """Answers the question for a path."""

    def __init__(self) -> None:
        self.answer: Path | None = None
        self.word = ""
        self.replace = False
        self.asked: list[str] = []

        self.pseudonym = self.number = self.package = ""
        self.named = Responsible("A. Ek", "Foot Clinic", "Sula AB", "Gatan 1, Lund")
        self.told: list[Exception] = []

    def path(self, pseudonym: str, word: str, _suffix: str) -> Path | None:
        self.pseudonym, self.word = pseudonym, word
        return self.answer

    def package_path(self, number: str, package: str) -> Path | None:
        self.number, self.package = number, package
        return self.answer

    def blocks(self, _own: Sequence[Block], _stock: Sequence[Block]) -> None:
        return None

    def machine_file(self) -> Path | None:
        return self.answer

    def machine_file_to_write(self, _name: str) -> Path | None:
        return self.answer

    def zones_file(self) -> Path | None:
        return self.answer

    def responsible(self) -> Responsible:
        return self.named

    def ask_responsible(self) -> bool:
        return True

    def ask_missing(self) -> bool:
        return True

    def when_newest(self, then: Callable[[], None]) -> None:
        then()

    def tell(self, error: Exception) -> None:
        self.told.append(error)

    def may_replace(self, paths: Sequence[Path]) -> bool:
        self.asked += [path.name for path in paths]
        return self.replace


@pytest.fixture
def chosen() -> Chosen:
    return Chosen()


@pytest.fixture
def stage(
    qapp: QApplication,
    qtbot: QtBot,
    case: Case,
    tmp_path: Path,
    chosen: Chosen,
) -> Iterator[ExportStage]:
    rules = ClinicExportRules(tmp_path / "config" / "export.json")
    built = ExportStage(
        case=case,
        rules=rules,
        materials=read_materials(),
        shop=SHOP,
        blocks=ClinicBlocks(tmp_path / "config" / "blocks.json"),
        asker=chosen,
        memory=LastOrder(tmp_path / "config" / "order.json", SHOP),
        machines=clinic_machines(tmp_path / "config"),
        dark=False,
        starting=lambda: starting_device(tmp_path / "config"),
    )
    order(built, both=False)
    built.show()
    yield built
    built.close()
    built.deleteLater()


@pytest.fixture
def settle(qtbot: QtBot, stage: ExportStage) -> Callable[[], None]:
    def wait() -> None:
        qtbot.waitUntil(lambda: not stage.jobs.is_running())

    wait()
    return wait


def sign_of(stage: ExportStage, name: str) -> CheckState:
    return CheckState(stage.view.check_list.rows[name].sign.property("state"))


def order(stage: ExportStage, **changes: object) -> None:
    stage.presenter.edit_choice(replace(stage.view.form.choice(), **changes))  # type: ignore[arg-type]


def test_part_is_made_and_checked_at_once(stage: ExportStage, settle: Callable[[], None]) -> None:
    assert sign_of(stage, "watertight") is CheckState.PASSED
    assert "triangles" in stage.view.summary.text()
    assert stage.view.export.isEnabled()
    assert not stage.view.reason.isVisible()


PAD = Pelott(centre_mm=(0.0, 140.0))


@pytest.mark.parametrize(
    ("prescribed", "alone"),
    [
        ((), None),
        ((Side.LEFT,), Side.LEFT),
        ((Side.RIGHT,), Side.RIGHT),
        ((Side.LEFT, Side.RIGHT), None),
    ],
)
def test_both_feet_are_made_unless_one_alone_is_prescribed_which_is_told(
    stage: ExportStage,
    case: Case,
    settle: Callable[[], None],
    tmp_path: Path,
    prescribed: tuple[Side, ...],
    alone: Side | None,
) -> None:
    """The finish is a prescription as much as a pad; the left foot is the current one."""
    both = alone is None
    told = ALONE[alone or Side.LEFT]
    starting = starting_device(tmp_path / "config")
    feet = []
    for foot in case.record.feet:
        design = starting.design(foot.foot)
        if foot.side in prescribed:
            changed = {Side.LEFT: {"thickness_mm": 4.0}, Side.RIGHT: {"corrections": (PAD,)}}
            design = replace(design, **changed[foot.side])  # type: ignore[arg-type]
        feet.append(FootRecord.begun(foot.foot, NOWHERE, design))
    case.open(replace(case.record, feet=tuple(feet)), None)
    settle()
    assert stage.view.form.both.isVisible()
    assert stage.view.form.both.isChecked() is both
    assert [part.side for part in stage.presenter.parts] == ([alone] if alone else list(Side))
    assert (told in stage.view.notes.text()) is not both
    stage.view.form.both.click()
    settle()
    assert len(stage.presenter.parts) == (1 if both else 2)
    assert (told in stage.view.notes.text()) is both
    stage.view.form.both.click()
    settle()
    assert [part.side for part in stage.presenter.parts] == ([alone] if alone else list(Side))


def test_of_one_foot_the_one_is_made_that_is_switched_to(
    stage: ExportStage, case: Case, settle: Callable[[], None], tmp_path: Path
) -> None:
    """Be it prescribed or not: whoever switches to a foot means that one."""
    starting = starting_device(tmp_path / "config")
    left, right = (
        FootRecord.begun(foot.foot, NOWHERE, starting.design(foot.foot))
        for foot in case.record.feet
    )
    left = left.with_design(left.design.with_added(PAD))
    case.open(replace(case.record, feet=(left, right), at_hand=Side.RIGHT), None)
    settle()
    assert [part.side for part in stage.presenter.parts] == [Side.LEFT]
    case.apply(replace(case.record.patient, name="Anna Bergh"), "Correct the name")
    settle()
    assert [part.side for part in stage.presenter.parts] == [Side.LEFT]
    for side in (Side.LEFT, Side.RIGHT):
        case.take_foot(side)
        settle()
        assert [part.side for part in stage.presenter.parts] == [side]
        assert ALONE[side] in stage.view.notes.text()


def test_what_was_exported_is_told_until_the_order_changes(
    stage: ExportStage,
    chosen: Chosen,
    settle: Callable[[], None],
    tmp_path: Path,
    qtbot: QtBot,
) -> None:
    """Also where the piece, which bears the number of its order, is made anew for the next one."""
    order(stage, relief="raised", numbered=True, pseudonym="P-7", job_sheet=False)
    settle()
    figures = stage.view.summary.text()
    assert "triangles" in figures
    chosen.answer, chosen.replace = tmp_path / "anna.stl", True
    stage.view.export.click()
    settle()
    before = stage.presenter.parts
    assert stage.view.summary.text() == "Exported anna-left.stl"
    order(stage, both=True)
    settle()
    assert stage.presenter.parts != before
    assert "triangles" in stage.view.summary.text()
    stage.view.export.click()
    settle()
    assert stage.view.summary.text().startswith("Exported anna-")
    buttons = lambda: [  # noqa: E731
        b for b in stage.view.findChildren(QToolButton) if b.property("part") and b.isVisible()
    ]
    qtbot.waitUntil(lambda: len(buttons()) == 2)
    (_left, right) = buttons()
    right.click()
    assert "triangles" in stage.view.summary.text()


def test_what_the_design_warns_of_is_told_before_the_export(
    stage: ExportStage, case: Case, settle: Callable[[], None]
) -> None:
    assert stage.view.notes.text() == ALONE[Side.LEFT]
    order(stage, terms=OrderTerms(remarks="軟"))
    assert "has no letters 軟" in stage.view.notes.text(), "before it is printed"
    order(stage, terms=OrderTerms())
    assert stage.view.notes.text() == ALONE[Side.LEFT]
    ahead = Pelott(centre_mm=(0.0, 185.0))
    case.apply(InsoleDesign(Side.LEFT, (ahead,), grid_mm=2.0), "Add a pelott")
    settle()
    assert "ahead of the line of the heads" in stage.view.notes.text()
    assert not stage.view.notes.text().startswith("Left")
    order(stage, both=True)
    settle()
    assert stage.view.notes.text().startswith("Left: ")
    names = [
        button.text() for button in stage.view.findChildren(QToolButton) if button.property("part")
    ]
    assert names == ["Left  !", "Right"]


@pytest.mark.slow
def test_export_names_the_side_and_writes_what_is_wanted(
    stage: ExportStage, settle: Callable[[], None], chosen: Chosen, tmp_path: Path
) -> None:
    told: list[Ordered] = []
    stage.exported.connect(lambda _record, ordered: told.append(ordered))
    order(stage, suffix=".3mf", prescription=True, checks=True, pseudonym="P-7")
    settle()
    chosen.answer = tmp_path / "out" / "anna.3mf"
    chosen.answer.parent.mkdir()
    stage.view.export.click()
    settle()
    assert sorted(path.name for path in chosen.answer.parent.iterdir()) == [
        "anna-left-checks.json", "anna-left-job-sheet.pdf", "anna-left-prescription.pdf",
        "anna-left.3mf",
    ]  # fmt: skip
    assert told[0].paths == (tmp_path / "out" / "anna-left.3mf",)
    assert "anna-left.3mf" in stage.view.summary.text()


def test_an_order_is_written_as_a_whole_and_revised_when_it_is_exported_again(
    stage: ExportStage, settle: Callable[[], None], chosen: Chosen, tmp_path: Path, qtbot: QtBot
) -> None:
    told: list[Ordered] = []
    stage.exported.connect(lambda _record, ordered: told.append(ordered))
    order(stage, both=True, pseudonym="P-7", prescription=True)
    settle()
    fields = stage.view.form.terms
    assert fields.remarks.isVisible()
    fields.package.setCurrentIndex(fields.package.findData("zip"))
    fields.package.edited.emit("zip")
    assert not stage.view.form.prescription.isEnabled()
    day = date.today() + timedelta(days=9)
    for field, text in (
        (fields.quantity, "2"), (fields.colour, "black"), (fields.deliver_on, day.isoformat()),
        (fields.remarks, "soft heel"),
    ):  # fmt: skip
        field.setFocus()
        if isinstance(field, QAbstractSpinBox):
            field.selectAll()
        qtbot.keyClicks(field, text)
    chosen.answer = tmp_path / "order.zip"
    stage.view.export.click()
    settle()
    (ordered,) = told
    assert ordered.paths == (chosen.answer,)
    verification = verify_order(chosen.answer)
    assert verification.problems == ()
    (item,) = verification.order.items
    assert item.terms == ordered.terms == OrderTerms(2, "black", "", "soft heel", day)
    release = verification.order.release
    assert (release.number, release.by) == (chosen.number, "A. Ek") == (ordered.number, "A. Ek")
    assert {file.role for file in item.files} == {"solid", "job_sheet"}
    assert item.sides == (Side.LEFT, Side.RIGHT)
    chosen.replace = True
    stage.view.export.click()
    settle()
    assert chosen.asked == ["order.zip"]
    assert (told[1].number, told[1].revision) == (ordered.number, 2)
    assert verify_order(chosen.answer).order.release.revision == 2
    field = stage.view.form.order
    assert field.currentText() == f"{ordered.number}, revision 3"
    field.setFocus()
    qtbot.keyClick(field, Qt.Key.Key_Down)
    stage.view.export.click()
    assert chosen.number != ordered.number
    settle()
    assert (told[2].number, told[2].revision) == (chosen.number, 1)


def test_the_job_sheet_of_a_single_file_has_the_number_of_its_order(
    stage: ExportStage, settle: Callable[[], None], chosen: Chosen, tmp_path: Path
) -> None:
    told: list[Ordered] = []
    stage.exported.connect(lambda _record, ordered: told.append(ordered))
    order(stage, both=False, pseudonym="P-7")
    settle()
    chosen.answer, chosen.replace = tmp_path / "p.stl", True
    for revision in ("1", "2"):
        stage.view.export.click()
        settle()
        (sheet,) = told[-1].papers
        text = text_of_pdf(sheet)
        assert told[-1].number == told[0].number
        assert f"Order number\n{told[0].number}" in text
        assert f"Revision\n{revision}" in text
    assert told[0].files == (tmp_path / "p-left.stl", tmp_path / "p-left-job-sheet.pdf")


def test_what_the_shop_is_told_stays_with_the_case(
    stage: ExportStage, settle: Callable[[], None], case: Case, qtbot: QtBot
) -> None:
    fields, day = stage.view.form.terms, date.today() + timedelta(days=9)
    typed = (
        (fields.colour, "black"), (fields.deliver_on, day.isoformat()), (fields.remarks, "soft"),
    )  # fmt: skip
    orders = stage.view.form.order.model()  # what can be exported stays as it is meanwhile
    with qtbot.assertNotEmitted(orders.rowsInserted):
        for field, text in typed:
            field.setFocus()
            qtbot.keyClicks(field, text)
        qtbot.keyClick(fields.deliver_on, Qt.Key.Key_Return)
    record = case.record
    assert record.order.terms == OrderTerms(1, "black", "", "soft", day)
    assert case.has_unsaved_changes
    case.open(CaseRecord(), None)
    settle()
    assert (fields.colour.text(), fields.deliver_on.text()) == ("", "")
    case.open(record, None)
    settle()
    assert (fields.colour.text(), fields.deliver_on.text()) == ("black", day.isoformat())
    assert fields.remarks.toPlainText() == "soft"
    past = replace(record.order.terms, deliver_on=date.today() - timedelta(days=1))
    case.open(replace(record, order=replace(record.order, terms=past)), None)
    settle()
    assert fields.deliver_on.text() == ""
    assert stage.view.export.isEnabled()


def test_terms_of_another_station_are_shown_and_stay_when_more_is_typed(
    stage: ExportStage, settle: Callable[[], None], case: Case, qtbot: QtBot
) -> None:
    theirs = OrderTerms(2, "", "", "soft heel", date.today() + timedelta(days=9))
    case.note_stored_order(OrderNote(terms=theirs))
    fields = stage.view.form.terms
    assert fields.remarks.toPlainText() == "soft heel"
    fields.colour.setFocus()
    qtbot.keyClicks(fields.colour, "black")
    settle()
    assert case.record.order.terms == replace(theirs, colour="black")


def test_a_delivery_date_that_cannot_be_right_keeps_from_exporting(
    stage: ExportStage, settle: Callable[[], None], qtbot: QtBot
) -> None:
    field = stage.view.form.terms.deliver_on
    for typed, told in (
        ("2026-02-30", "is no date"), ("2020-01-01", "past"), ("soon", "is no date"),
    ):  # fmt: skip
        field.setFocus()
        qtbot.keyClicks(field, typed)
        qtbot.keyClick(field, Qt.Key.Key_Return)
        assert told in stage.view.error.text()
        assert not stage.view.export.isEnabled()
        field.clear()
        qtbot.keyClick(field, Qt.Key.Key_Return)
        assert stage.view.error.text() == ""
        assert stage.view.export.isEnabled()


def test_a_quantity_still_being_typed_is_ordered(
    stage: ExportStage, settle: Callable[[], None], chosen: Chosen, qtbot: QtBot, tmp_path: Path
) -> None:
    order(stage, both=False, package="folder", job_sheet=False)
    settle()
    field = stage.view.form.terms.quantity
    field.setFocus()
    field.selectAll()
    qtbot.keyClicks(field, "3")
    chosen.answer = tmp_path / "order"
    stage.view.export.click()  # as on a Mac, where a click leaves the focus in the field
    settle()
    written = tmp_path / "order" / "order.json"
    assert json.loads(written.read_text())["items"][0]["quantity"] == 3


def test_pair_is_nested_into_one_block(
    stage: ExportStage, settle: Callable[[], None], chosen: Chosen, tmp_path: Path
) -> None:
    order(stage, both=True, block=PAIR, job_sheet=False)
    settle()
    stage.presenter.show_part("nest")
    chosen.answer = tmp_path / "anna.stl"
    stage.view.export.click()
    settle()
    assert chosen.word == "pair"
    mesh = trimesh.load_mesh(tmp_path / "anna-pair.stl")
    assert len(mesh.split()) == 2
    assert mesh.bounds.min() >= 0


@pytest.mark.usefixtures("settle")
def test_each_block_is_read_whole_on_a_small_screen(stage: ExportStage, qtbot: QtBot) -> None:
    stage.resize(1366, 728)
    qtbot.wait(20)  # until the columns have their widths
    field = stage.view.form.block
    option = QStyleOptionComboBox()
    field.initStyleOption(option)
    room = field.style().subControlRect(
        QStyle.ComplexControl.CC_ComboBox, option, QStyle.SubControl.SC_ComboBoxEditField, field
    )
    for number in range(field.count()):
        text = field.itemText(number)
        assert field.fontMetrics().horizontalAdvance(text) <= room.width() - 4, text


def test_pair_without_a_block_is_two_files(
    stage: ExportStage, settle: Callable[[], None], chosen: Chosen, tmp_path: Path
) -> None:
    order(stage, both=True, job_sheet=False)
    settle()
    chosen.word, chosen.answer = "-", tmp_path / "anna-left.stl"
    stage.view.export.click()
    settle()
    assert chosen.word == ""
    assert sorted(p.name for p in tmp_path.glob("*.stl")) == [
        "anna-left.stl",
        "anna-right.stl",
    ]


@pytest.mark.slow
def test_files_that_are_there_are_replaced_only_on_demand(
    stage: ExportStage, settle: Callable[[], None], chosen: Chosen, tmp_path: Path
) -> None:
    (tmp_path / "anna-left-job-sheet.pdf").write_text("old")
    chosen.answer = tmp_path / "anna-left.stl"
    stage.view.export.click()
    assert chosen.asked == ["anna-left-job-sheet.pdf"]
    assert not chosen.answer.exists()
    chosen.replace = True
    stage.view.export.click()
    settle()
    assert chosen.answer.exists()
    assert (tmp_path / "anna-left-job-sheet.pdf").read_bytes().startswith(b"%PDF")


def test_an_export_does_not_take_the_place_of_the_scan(
    case: Case,
    stage: ExportStage,
    settle: Callable[[], None],
    chosen: Chosen,
    tmp_path: Path,
) -> None:
    scan = tmp_path / "scan-left.stl"
    scan.write_text("of the patient")
    left = replace(case.record.feet[0], source=ScanSource("mesh", str(scan), "0" * 64))
    case.open(replace(case.record, feet=(left,)), None)
    stage.presenter.remake()
    settle()
    chosen.answer, chosen.replace = tmp_path / "scan.stl", True
    stage.view.export.click()
    settle()
    (told,) = chosen.told
    assert "is read to make the result" in str(told)
    assert stage.view.error.text() == ""
    assert scan.read_text() == "of the patient"


@pytest.mark.slow
def test_order_is_remembered_without_the_patient(
    stage: ExportStage, settle: Callable[[], None], chosen: Chosen, tmp_path: Path
) -> None:
    order(stage, suffix=".obj", block=PAIR, pseudonym="P-7", most_triangles=30_000)
    settle()
    chosen.answer = tmp_path / "anna.obj"
    stage.view.export.click()
    settle()
    file = tmp_path / "config" / "order.json"
    loaded = LastOrder(file, SHOP).load()
    assert (loaded.suffix, loaded.block, loaded.most_triangles) == (".obj", PAIR, 30_000)
    assert "P-7" not in file.read_text()


@pytest.mark.parametrize("text", ["{", "[]", '{"suffix": 3, "draft_deg": "x", "block": "none"}'])
def test_memory_that_cannot_be_read_costs_nothing(tmp_path: Path, text: str) -> None:
    (tmp_path / "order.json").write_text(text)
    assert LastOrder(tmp_path / "order.json", SHOP).load() == OrderChoice()


@pytest.mark.slow
def test_what_a_rule_stops_needs_a_reason_that_is_recorded(
    stage: ExportStage, settle: Callable[[], None], chosen: Chosen, tmp_path: Path
) -> None:
    stage.view.rule_edited.emit("shoe_height", "blocking", 2.0)
    settle()
    assert sign_of(stage, "shoe_height") is CheckState.BLOCKING
    assert not stage.view.export.isEnabled()
    assert stage.view.reason.isVisible()
    stage.view.reason.setText("high boot")
    stage.view.reason_edited.emit("high boot")
    assert stage.view.export.isEnabled()
    chosen.answer = tmp_path / "anna.stl"
    stage.view.export.click()
    settle()
    override = json.loads((tmp_path / "anna-left-checks.json").read_text())["override"]
    assert (override["author"], override["reason"]) == ("A. Ek", "high boot")


def test_rules_are_remembered(
    stage: ExportStage, settle: Callable[[], None], tmp_path: Path
) -> None:
    stage.view.rule_edited.emit("step", "off", 9.0)
    stage.view.cutter_edited.emit(16.0)
    settle()
    rules = ClinicExportRules(tmp_path / "config" / "export.json").load()
    assert (rules.policies["step"], rules.limits["step"]) == ("off", 9.0)
    assert rules.cutter_diameter_mm == 16.0
    assert sign_of(stage, "step") is CheckState.OFF


@pytest.fixture
def broken_rules(tmp_path: Path) -> None:
    (tmp_path / "config").mkdir()
    (tmp_path / "config" / "export.json").write_text("{")


def test_rules_that_cannot_be_read_are_named_and_the_products_hold(
    broken_rules: None, stage: ExportStage, settle: Callable[[], None]
) -> None:
    assert "export.json is not valid JSON" in stage.view.error.text()
    assert sign_of(stage, "watertight") is CheckState.PASSED


def test_what_the_checks_say_wraps_and_nothing_is_cut(
    stage: ExportStage, settle: Callable[[], None], qtbot: QtBot
) -> None:
    """On a small laptop, with a word that is told long after the stage came up."""
    stage.resize(1366, 700)
    stage.show()
    order(stage, both=True)
    settle()
    area = stage.view.check_list.parentWidget().parentWidget().parentWidget()
    assert isinstance(area, VerticalScroll)
    row = stage.view.check_list.rows["shoe_height"]
    assert len(row.sentence.text()) > 20
    row.sentence.setText(" ".join(["16 mm wide medially instead of 9 mm"] * 5))
    row.policy.addItem("stands in the way of an export until somebody says why")

    def is_whole() -> bool:
        sentence = row.sentence
        is_high = sentence.height() >= sentence.heightForWidth(sentence.width())
        return is_high and area.widget().width() <= area.viewport().width()

    qtbot.waitUntil(is_whole)
    assert row.sentence.width() < row.fontMetrics().horizontalAdvance(row.sentence.text())
    assert row.sentence.heightForWidth(row.sentence.width()) > 2 * row.fontMetrics().height()
    assert row.policy.width() >= row.policy.minimumSizeHint().width()
    assert area.width() < 700


def test_look_at_the_worst_place(stage: ExportStage, settle: Callable[[], None]) -> None:
    stage.view.rule_edited.emit("shoe_height", "warning", 2.0)
    settle()
    stage.view.check_list.rows["shoe_height"].sentence.click()
    x, y, _ = stage.view.model.scene.camera.focal_mm
    (part,) = stage.presenter.parts
    worst = next(f for f in part.findings if f.name == "shoe_height").place_mm
    assert worst is not None
    assert (x, y) == pytest.approx(worst[:2])


@pytest.mark.slow
def test_what_cannot_be_made_is_one_sentence(
    stage: ExportStage, settle: Callable[[], None]
) -> None:
    order(stage, most_triangles=2000, most_deviation_mm=0.005)
    settle()
    assert "2000 triangles are too few" in stage.view.error.text()
    assert not stage.view.export.isEnabled()
    order(stage, most_triangles=None)
    settle()
    assert stage.view.error.text() == ""
    assert stage.view.export.isEnabled()


def test_letters_that_the_font_lacks_are_said(
    stage: ExportStage, settle: Callable[[], None]
) -> None:
    order(stage, relief="engraved", text="足 7")
    settle()
    assert "足" in stage.view.notes.text()


def test_place_that_cannot_be_written(
    stage: ExportStage, settle: Callable[[], None], chosen: Chosen, tmp_path: Path
) -> None:
    chosen.answer = tmp_path / "none" / "anna.stl"
    stage.view.export.click()
    settle()
    (told,) = chosen.told
    assert "its folder does not exist" in str(told)
    assert stage.view.error.text() == ""
    assert stage.view.export.isEnabled()


def test_cancel_stops_the_work(stage: ExportStage, settle: Callable[[], None]) -> None:
    order(stage, chamfer_mm=1.0)
    stage.view.cancel.click()
    settle()
    assert "Stopped" in stage.view.error.text()
    assert not stage.view.export.isEnabled()


def test_another_design_is_made_anew(
    stage: ExportStage, settle: Callable[[], None], case: Case
) -> None:
    before = stage.view.summary.text()
    design = case.record.design
    assert design is not None
    case.apply(replace(design, thickness_mm=8.0), "Thicker")
    settle()
    assert stage.view.summary.text() != before


def test_the_head_says_whose_insoles_these_are(stage: ExportStage, case: Case) -> None:
    assert stage.view.patient.text() == "Anna Berg  ·  born 1980-01-01"
    case.apply(Patient(), "Forget the patient")
    assert stage.view.patient.text() == "Patient without a name"


def test_the_order_names_a_material_as_the_shop_does_in_every_language(
    qapp: QApplication, qtbot: QtBot
) -> None:
    load_language(qapp, "sv")
    try:
        form = OrderForm(Stock(SHOP.blocks, SHOP.materials))
        qtbot.addWidget(form)
        blocks = [form.block.itemText(index) for index in range(form.block.count())]
        assert "EVA par, 340 × 260 × 40 mm" in blocks
        for typed, ordered in (("Kork och EVA", "Cork and EVA"), ("Filt", "Filt"), ("", "")):
            form.materials[Side.LEFT].setEditText(typed)
            assert form.materials[Side.LEFT].material() == ordered
        form.show_choice(OrderChoice(), has_pair=False)
        form.show_feet([OrderedFoot(Side.LEFT, "polypropylene")])
        assert form.materials[Side.LEFT].currentText() == "Polypropen"
        assert form.materials[Side.LEFT].material() == "polypropylene"
    finally:
        load_language(qapp, "en")


def shelled(design: InsoleDesign, **values: Any) -> InsoleDesign:
    return replace(design, shell=Shell(**values), bottom="following")


def test_the_least_thickness_that_a_material_needs_is_told_beside_the_check(
    stage: ExportStage, case: Case, settle: Callable[[], None]
) -> None:
    """As the papers say it, which take the larger of rule and material."""
    row = stage.view.check_list.rows["thickness"]
    assert row.limit is not None
    rule_mm = row.limit.value()
    assert "material" not in row.sentence.text()
    assert case.record.design is not None
    case.apply(shelled(case.record.design, material="EVA"), "Shell")
    settle()
    (part,) = stage.presenter.parts
    (found,) = [finding for finding in part.findings if finding.name == "thickness"]
    assert found.limit > rule_mm == row.limit.value()
    assert f"; {found.limit:.1f} mm is the least of its material" in row.sentence.text()
    row.limit.setValue(6.0)
    settle()
    assert "material" not in row.sentence.text(), "the rule is stricter"


def test_material_and_walls_are_those_of_the_design(
    stage: ExportStage, case: Case, settle: Callable[[], None], tmp_path: Path
) -> None:
    """The material until it is changed; the walls but of a mould."""
    form = stage.view.form
    assert case.record.design is not None
    field = form.materials[case.record.design.side]
    field.setEditText("Felt")
    assert field.currentText() == "Felt"
    assert form.draft.isVisible()
    assert not form.walls.isVisible()
    case.apply(shelled(case.record.design, draft_lateral_deg=5.0, chamfer_mm=1.0), "Shell")
    settle()
    assert field.currentText() == "Polypropylene"
    assert not form.draft.isVisible()
    assert not form.chamfer.isVisible()
    assert form.walls.text() == "draft 0° medial, 5° lateral, chamfer 1 mm"
    field.setEditText("Carbon")
    order(stage, job_sheet=True)
    stage.presenter.export_to(tmp_path / "insole.stl")
    settle()
    (sheet,) = tmp_path.glob("*.pdf")
    assert "Carbon" in text_of_pdf(sheet)
    order(stage, kind="positive")
    settle()
    assert form.draft.isVisible(), "a mould has the walls of the order"
    assert not form.walls.isVisible()
