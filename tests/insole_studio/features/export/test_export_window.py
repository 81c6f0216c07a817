"""The stage within the whole window: its dialogs, its own blocks, and what it names the files."""

from __future__ import annotations

import ast
import json
from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from functools import cache
from hashlib import sha256
from pathlib import Path

import pytest
from PySide6.QtCore import Qt, QTimer
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QDialog, QWidget
from pytestqt.qtbot import QtBot

import insole_studio
from insole_core.cases.case_record import CaseRecord, FootRecord, Patient
from insole_core.cases.scan_source import ScanSource
from insole_core.export.shop_order import digest_of_order
from insole_core.foot.foot import Foot
from insole_core.geometry.side import Side
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.solids.shop import Block
from insole_core.workflows.clinic_tables import ClinicBlocks
from insole_studio.app.bootstrap import Application
from insole_studio.features.export.blocks_dialog import BlocksDialog
from insole_studio.features.export.order_form import OrderForm
from insole_studio.features.export.rows import CheckState
from insole_studio.features.export.stage import ExportStage
from insole_studio.services.files import Kept
from insole_studio.services.questions import Questions
from insole_studio.settings import load_settings
from insole_studio.widgets.form_parts import FieldsDialog

pytestmark = pytest.mark.one_window

NOWHERE = ScanSource("mesh", "/nowhere/foot.ply", "0" * 64)
LEFT = Qt.MouseButton.LeftButton


class PathGiven(Questions):
    """The real dialogs, except that of the path."""

    def __init__(self, window: QWidget) -> None:
        super().__init__(window)
        self.answer: Path | None = None
        self.suggested: list[str] = []
        self.windows = [window]

    def on(self, window: QWidget) -> PathGiven:
        self._parent = window
        self.windows.append(window)
        return self

    def file_to_write(self, suggestion: str, _kinds: str, _kept: Kept) -> Path | None:
        self.suggested.append(suggestion)
        return self.answer

    name_to_write = file_to_write

    def file_to_open(self, _kinds: str, _kept: Kept) -> Path | None:
        return self.answer


@pytest.fixture
def paths_given(app: Application) -> PathGiven:
    questions = PathGiven(app.window)
    app.services.messages.questions = questions
    return questions


def case_of(make_foot: Callable[[Side], Foot], patient: Patient) -> CaseRecord:
    feet = tuple(
        FootRecord.begun(make_foot(side), NOWHERE, InsoleDesign(side, grid_mm=2.0)) for side in Side
    )
    return CaseRecord(patient, feet, Side.LEFT)


@pytest.fixture
def stage(
    app: Application, paths_given: PathGiven, make_foot: Callable[[Side], Foot], qtbot: QtBot
) -> Iterator[ExportStage]:
    app.case.open(case_of(make_foot, Patient("Anna Bergqvist", "1980-01-01")), None)
    app.features.export.open()
    built = app.features.export.stage
    assert built is not None
    qtbot.waitUntil(lambda: not built.jobs.is_running())
    yield built
    app.features.export.close()


@pytest.fixture
def settle(qtbot: QtBot, stage: ExportStage) -> Callable[[], None]:
    def wait() -> None:
        qtbot.waitUntil(lambda: not stage.jobs.is_running())

    return wait


def order(stage: ExportStage, **changes: object) -> None:
    stage.presenter.edit_choice(replace(stage.view.form.choice(), **changes))  # type: ignore[arg-type]


def when_asked(kind: type[QDialog], act: Callable[[QDialog], None]) -> None:
    """Do something with the next modal dialog of a kind."""

    def look() -> None:
        dialog = QApplication.activeModalWidget()
        if isinstance(dialog, kind) and dialog.isVisible():
            try:
                act(dialog)
            finally:
                if dialog.isVisible():  # whatever went wrong, the test does not wait for a user
                    dialog.reject()
        else:
            QTimer.singleShot(50, look)

    QTimer.singleShot(50, look)


def test_dialogs_are_over_the_stage_which_stays_above_the_main_window_and_go_with_it(
    app: Application,
    stage: ExportStage,
    settle: Callable[[], None],
    paths_given: PathGiven,
    tmp_path: Path,
    qtbot: QtBot,
) -> None:
    """That of the file is the real one, as a user gets it."""
    assert stage.windowHandle().transientParent() is app.window.windowHandle()
    features = app.features
    for feature in (features.capture, features.calibrate, features.compare, features.foot):
        assert feature.parent() is app.window
    app.services.messages.questions = Questions(app.window)
    owners: list[QWidget | None] = []

    def note(dialog: QDialog) -> None:
        owners.append(dialog.parentWidget())
        dialog.reject()

    when_asked(QDialog, note)
    QTest.mouseClick(stage.view.export, LEFT)
    assert owners == [stage]

    app.services.messages.questions = paths_given
    paths_given.answer = tmp_path / "none" / "o.stl"
    QTest.mouseClick(stage.view.export, LEFT)
    settle()
    (dialog,) = app.services.messages.dialogs
    assert dialog.isVisible()
    assert dialog.parentWidget() is stage
    assert "its folder does not exist" in dialog.text()
    assert stage.view.error.text() == ""  # told once
    dialog.done(0)
    assert app.services.messages.dialogs == []

    paths_given.answer = tmp_path / f"{'å' * 124}.stl"  # allowed, but not with the side
    QTest.mouseClick(stage.view.export, LEFT)
    settle()
    (dialog,) = app.services.messages.dialogs
    assert "the name is too long" in dialog.text()
    stage.close()
    qtbot.waitUntil(lambda: app.services.messages.dialogs == [])


BEFORE_ANY_WINDOW = "app/graphics.py"


DIALOGS = ("QFileDialog", "QMessageBox", "QInputDialog", "ErrorDialog")


@cache
def calls_of_dialogs() -> Sequence[tuple[str, ast.Call]]:
    root = Path(insole_studio.__file__).parent
    texts = {path: path.read_text(encoding="utf-8") for path in root.rglob("*.py")}
    return [
        (f"{path.relative_to(root)}:{node.lineno}", node)
        for path, text in texts.items()
        if any(name in text for name in DIALOGS)
        for node in ast.walk(ast.parse(text))
        if isinstance(node, ast.Call) and ast.unparse(node.func).split(".")[0] in DIALOGS
    ]


def test_every_dialog_names_the_window_it_belongs_to() -> None:
    calls = calls_of_dialogs()
    assert len(calls) >= 8
    owners = {"self", "self._parent", "self._window", "over or self._window", "parent"}
    strays = [
        where
        for where, call in calls
        if not where.startswith(BEFORE_ANY_WINDOW)
        and not any(
            ast.unparse(argument) in owners
            for argument in [*call.args, *(keyword.value for keyword in call.keywords)]
        )
    ]
    assert strays == []


def test_all_file_dialogs_come_from_where_their_folders_are_remembered() -> None:
    places = [w for w, call in calls_of_dialogs() if ast.unparse(call.func).startswith("QFileD")]
    assert {place.split(":")[0] for place in places} == {"services/questions.py"}


def test_the_shop_gets_the_order_number_but_no_name_and_the_case_keeps_it(
    app: Application,
    stage: ExportStage,
    settle: Callable[[], None],
    paths_given: PathGiven,
    tmp_path: Path,
) -> None:
    stage.view.form.pseudonym.setFocus()
    QTest.keyClicks(stage.view.form.pseudonym, "Bergqvist 7")
    paths_given.answer = tmp_path / "o.stl"
    QTest.mouseClick(stage.view.export, LEFT)
    settle()
    (dialog,) = app.services.messages.dialogs
    assert "holds the patient's name" in dialog.text()
    assert list(tmp_path.glob("*.stl")) == []
    dialog.done(0)
    paths_given.suggested.clear()

    number = stage.view.form.pseudonym.placeholderText()
    order(stage, pseudonym="", both=True, block=block_named(stage, "EVA pair"), job_sheet=False)
    settle()
    paths_given.answer = tmp_path / f"{number}.stl"
    QTest.mouseClick(stage.view.export, LEFT)
    settle()
    assert paths_given.suggested == [f"{number}-pair.stl"]
    assert "Bergqvist" not in "".join(path.name for path in tmp_path.iterdir())
    assert app.case.record.patient.pseudonym == number
    assert stage.view.form.pseudonym.text() == number
    assert app.features.export.exported is app.case.record
    order(stage, pseudonym="P-7 / 2", both=False)
    settle()
    QTest.mouseClick(stage.view.export, LEFT)
    settle()
    assert paths_given.suggested[-1] == "P-7_2-left.stl"
    order(stage, block=None, both=True)
    settle()
    paths_given.answer = None
    QTest.mouseClick(stage.view.export, LEFT)
    assert paths_given.suggested[-1] == "P-7_2.stl"  # the names of both files tell their sides


def test_another_case_takes_nothing_of_the_one_before(
    app: Application,
    stage: ExportStage,
    settle: Callable[[], None],
    make_foot: Callable[[Side], Foot],
) -> None:
    number = stage.view.form.pseudonym.placeholderText()
    order(stage, pseudonym="P-7", relief="engraved", text="Left of P-7")
    settle()
    form = form_of(app, case_of(make_foot, Patient("Otto Ek")), settle)
    assert (form.choice().pseudonym, form.choice().text) == ("", "")
    assert form.pseudonym.placeholderText() != number
    form = form_of(app, case_of(make_foot, Patient("Otto Ek", pseudonym="P-9")), settle)
    assert form.choice().pseudonym == "P-9"


def test_an_export_that_ends_in_the_next_case_leaves_its_order_number_out_of_it(
    app: Application,
    stage: ExportStage,
    settle: Callable[[], None],
    make_foot: Callable[[Side], Foot],
    tmp_path: Path,
) -> None:
    order(stage, pseudonym="P-7", both=False, block=None)
    settle()
    stage.presenter.export_to(tmp_path / "P-7.stl")
    app.case.open(case_of(make_foot, Patient("Otto Ek")), None)
    settle()
    assert any(tmp_path.glob("P-7*.stl"))
    assert app.case.record.patient == Patient("Otto Ek")


def form_of(app: Application, record: CaseRecord, settle: Callable[[], None]) -> OrderForm:
    """The form of the stage, opened again for another case."""
    app.case.open(record, None)
    settle()
    app.window.actions_by_key["export"].trigger()
    settle()
    assert app.features.export.stage is not None
    form: OrderForm = app.features.export.stage.view.form
    return form


def block_named(stage: ExportStage, name: str) -> Block:
    return next(b for b in stage.presenter._blocks if b.name == name)


def sign_of(stage: ExportStage, name: str) -> CheckState:
    return CheckState(stage.view.check_list.rows[name].sign.property("state"))


def test_the_block_is_checked_with_what_is_written_into_it(
    stage: ExportStage, settle: Callable[[], None]
) -> None:
    """No block fits nothing; each alone may fit where the pair does not; a nest is both."""
    assert stage.view.form.block.currentData() == ""
    assert sign_of(stage, "block") is CheckState.OFF
    assert stage.view.check_list.rows["block"].sentence.text() == "no block is chosen"

    order(stage, both=True, block=block_named(stage, "EVA single"))
    settle()
    assert sign_of(stage, "block") is CheckState.BLOCKING
    assert "The pair needs a block of" in stage.view.error.text()
    assert not stage.view.export.isEnabled()
    assert not stage.view.reason.isVisible()  # no reason makes it fit
    stage.presenter.show_part("nest")
    assert stage.view.summary.text().startswith("Both need")
    order(stage, both=True, block=block_named(stage, "EVA pair"))
    settle()
    assert sign_of(stage, "block") is CheckState.PASSED
    assert stage.view.error.text() == ""
    assert stage.view.export.isEnabled()

    stage.view.rule_edited.emit("shoe_height", "warning", 2.0)
    settle()
    stage.presenter.show_part("nest")
    assert sign_of(stage, "shoe_height") is CheckState.WARNING
    finding = stage.presenter._findings["shoe_height"]
    left, right = stage.presenter.parts
    spots = [f.spots_mm for part in (left, right) for f in part.findings if f.name == finding.name]
    assert len(finding.spots_mm) == sum(map(len, spots)) > len(spots[0])
    assert finding.spots_mm[:, :2].min() > 0
    stage.view.check_list.rows["shoe_height"].sentence.click()
    x, y, _ = stage.view.model.scene.camera.focal_mm
    assert 0 < x < 260  # within the block, whose corner is the origin
    assert 0 < y < 340


def test_a_clinic_makes_names_changes_and_deletes_its_own_blocks(
    app: Application, stage: ExportStage, settle: Callable[[], None], qtbot: QtBot
) -> None:
    file = app.services.paths.settings_folder / "blocks.json"

    def make(dialog: QDialog) -> None:
        assert isinstance(dialog, BlocksDialog)
        assert dialog.parentWidget() is stage
        QTest.mouseClick(dialog.add, LEFT)
        (row,) = dialog.rows
        QTest.keyClicks(row.name, "EVA pair")  # replaces the proposed name, which is selected
        assert not dialog.keep.isEnabled()
        assert "There is a block EVA pair already" in dialog.problem.text()
        QTest.keyClicks(row.name, " of ours")
        row.lengths[1].selectAll()
        QTest.keyClicks(row.lengths[1], "275,5")
        QTest.mouseClick(dialog.keep, LEFT)

    when_asked(BlocksDialog, make)
    QTest.mouseClick(stage.view.form.own_blocks, LEFT)
    settle()
    ours = Block("EVA pair of ours", (340.0, 275.5, 40.0))
    assert ClinicBlocks(file).load() == (ours,)
    assert stage.view.form.choice().block == ours

    def delete(dialog: QDialog) -> None:
        assert isinstance(dialog, BlocksDialog)
        QTest.mouseClick(dialog.rows[0].remove, LEFT)
        QTest.mouseClick(dialog.keep, LEFT)

    when_asked(BlocksDialog, delete)
    QTest.mouseClick(stage.view.form.own_blocks, LEFT)
    settle()
    assert ClinicBlocks(file).load() == ()
    assert stage.view.form.choice().block is None
    assert stage.view.form.block.findData(ours.name) == -1


def test_blocks_that_cannot_be_read_are_named(
    app: Application, paths_given: PathGiven, make_foot: Callable[[Side], Foot], qtbot: QtBot
) -> None:
    folder = app.services.paths.settings_folder
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "blocks.json").write_text("{")
    app.case.open(case_of(make_foot, Patient("Anna")), None)
    app.features.export.open()
    stage = app.features.export.stage
    assert stage is not None
    qtbot.waitUntil(lambda: not stage.jobs.is_running())
    assert "blocks.json is not valid JSON" in stage.view.error.text()
    stage.close()


def fill(texts: Sequence[str]) -> Callable[[QDialog], None]:
    """Type into the fields of a dialog one after the other, and accept it."""

    def type_in(dialog: QDialog) -> None:
        assert isinstance(dialog, FieldsDialog)
        for line, text in zip(dialog.lines.values(), texts, strict=True):
            line.clear()
            QTest.keyClicks(line, text)
        QTest.mouseClick(dialog.accept_button, LEFT)

    return type_in


@pytest.mark.slow
def test_a_prescription_asks_for_who_prescribes_and_makes(
    app: Application,
    stage: ExportStage,
    settle: Callable[[], None],
    paths_given: PathGiven,
    tmp_path: Path,
) -> None:
    app.case.apply(Patient(), "Forget the patient")
    order(stage, prescription=True, job_sheet=False)
    paths_given.answer = tmp_path / "o.stl"
    when_asked(FieldsDialog, lambda dialog: dialog.reject())
    QTest.mouseClick(stage.view.export, LEFT)
    assert paths_given.suggested == []  # cancelled: nothing is exported

    def refuse_gaps(dialog: QDialog) -> None:
        assert isinstance(dialog, FieldsDialog)
        assert dialog.parentWidget() is stage
        assert not dialog.accept_button.isEnabled()
        missing = "Still missing: Name of the patient, Prescriber, Maker of the insole, "
        assert dialog.accept_button.toolTip() == missing + "Address of the maker"
        fill(["Anna Bergqvist", "A. Ek", "", "Sula AB", "Gatan 1, Lund"])(dialog)

    when_asked(FieldsDialog, refuse_gaps)
    QTest.mouseClick(stage.view.export, LEFT)
    settle()
    assert app.case.record.patient.name == "Anna Bergqvist"
    assert (tmp_path / "o-left-prescription.pdf").exists()
    kept = load_settings(app.services.paths.settings_file)
    assert (kept.author, kept.maker, kept.maker_address) == ("A. Ek", "Sula AB", "Gatan 1, Lund")
    paths_given.answer = tmp_path / "again.stl"
    QTest.mouseClick(stage.view.export, LEFT)  # nothing is missing: nothing is asked
    assert len(paths_given.suggested) == 2
    settle()


def test_an_order_that_arrived_is_verified(
    app: Application, paths_given: PathGiven, tmp_path: Path, qtbot: QtBot
) -> None:
    digest = sha256(b"solid").hexdigest()
    file = {"name": "a-left.stl", "role": "solid", "sides": ["left"], "bytes": 5, "sha256": digest}
    item = {
        "pseudonym": "P-1", "kind": "insole", "sides": ["left"], "materials": {"left": ""},
        "quantity": 1, "colour": "", "cover": "", "remarks": "", "deliver_on": None,
        "files": [file],
    }  # fmt: skip
    order = {
        "format": "insole-order", "version": 1, "number": "26-7KQ4M", "clinic": "", "program": "x",
        "created_at": "2026-11-20T12:00:00+00:00", "items": [item],
    }  # fmt: skip
    folder = tmp_path / "26-7KQ4M"
    folder.mkdir()
    paths_given.answer = folder / "order.json"
    paths_given.answer.write_text(json.dumps(order | {"sha256": digest_of_order(order)}))
    solid = folder / "a-left.stl"
    solid.write_bytes(b"solid")
    export, status = app.features.export, app.window.statusBar()
    export.ask_verify_order()
    qtbot.waitUntil(lambda: "26-7KQ4M is complete" in status.currentMessage())
    solid.unlink()
    export.ask_verify_order()
    dialogs = app.services.messages.dialogs
    qtbot.waitUntil(lambda: bool(dialogs))
    assert "do not make it:\na-left.stl is missing" in dialogs[0].report
    dialogs[0].close()
