"""The user chooses a printer or a router, sees what it will make, and exports for it."""

from __future__ import annotations

import json
import zipfile
from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QComboBox
from pytestqt.qtbot import QtBot

from insole_core.cases.case_record import CaseRecord, FootRecord, Patient
from insole_core.cases.scan_source import ScanSource
from insole_core.foot.foot import Foot
from insole_core.geometry.side import Side
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.prescription.materials import read_materials
from insole_core.resources import resource_path
from insole_core.solids.prescription_paper import Responsible
from insole_core.solids.shop import Block, read_shop
from insole_core.workflows.clinic_tables import ClinicBlocks, ClinicExportRules
from insole_core.workflows.last_order import LastOrder
from insole_core.workflows.make_order import OrderChoice
from insole_core.workflows.mill import MillingChoice, clinic_machines
from insole_core.workflows.order_package import Ordered
from insole_core.workflows.print_order import PrintChoice
from insole_core.workflows.starting_design import starting_device
from insole_studio.app.application_events import ApplicationEvents
from insole_studio.document.case import Case
from insole_studio.features.export.order_form import OrderForm, Stock
from insole_studio.features.export.stage import ExportStage

SHOP = read_shop()
KEYS = Qt.Key
CTRL = Qt.KeyboardModifier.ControlModifier


class Asker:
    """Answers every question for a file with one path."""

    def __init__(self) -> None:
        self.answer: Path | None = None
        self.told: list[Exception] = []
        self.asked: list[Path] = []

    def path(self, _pseudonym: str, _word: str, _suffix: str) -> Path | None:
        return self.answer

    def package_path(self, _number: str, _package: str) -> Path | None:
        return self.answer

    def machine_file(self) -> Path | None:
        return self.answer

    def machine_file_to_write(self, _name: str) -> Path | None:
        return self.answer

    def zones_file(self) -> Path | None:
        return self.answer

    def blocks(self, _own: Sequence[Block], _stock: Sequence[Block]) -> None:
        return None

    def responsible(self) -> Responsible:
        return Responsible()

    def ask_responsible(self) -> bool:
        return True

    def ask_missing(self) -> bool:
        return True

    def when_newest(self, then: Callable[[], None]) -> None:
        then()

    def tell(self, error: Exception) -> None:
        self.told.append(error)

    def may_replace(self, paths: Sequence[Path]) -> bool:
        self.asked += paths
        return True


@pytest.fixture
def asker() -> Asker:
    return Asker()


@pytest.fixture
def memory(tmp_path: Path) -> LastOrder:
    folder = tmp_path / "config"
    return LastOrder(folder / "order.json", SHOP, machines=clinic_machines(folder))


@pytest.fixture
def stage(
    qapp: QApplication,
    make_foot: Callable[[Side], Foot],
    tmp_path: Path,
    asker: Asker,
    memory: LastOrder,
) -> Iterator[ExportStage]:
    case = Case()
    scan = ScanSource("mesh", "/nowhere/foot.ply", "0" * 64)
    design = InsoleDesign(Side.LEFT, grid_mm=3.0)
    foot = FootRecord.begun(make_foot(Side.LEFT), scan, design)
    case.open(CaseRecord(Patient(name="Anna Berg"), (foot,), Side.LEFT), None)
    memory.save(OrderChoice(most_triangles=8000, most_deviation_mm=0.5, job_sheet=False))
    folder = tmp_path / "config"
    built = ExportStage(
        case=case,
        rules=ClinicExportRules(folder / "export.json"),
        materials=read_materials(),
        shop=SHOP,
        blocks=ClinicBlocks(folder / "blocks.json"),
        asker=asker,
        memory=memory,
        machines=clinic_machines(folder),
        dark=False,
        starting=lambda: starting_device(folder),
    )
    built.show()
    built.activateWindow()
    QTest.qWaitForWindowActive(built)
    events = ApplicationEvents(qapp)
    yield built
    built.close()
    events.close()
    built.deleteLater()


@pytest.fixture
def settle(qtbot: QtBot, stage: ExportStage) -> Callable[[], None]:
    def wait() -> None:
        qtbot.waitUntil(lambda: not stage.jobs.is_running())

    wait()
    return wait


def strike(
    stage: ExportStage,
    key: Qt.Key | str,
    modifiers: Qt.KeyboardModifier = Qt.KeyboardModifier.NoModifier,
) -> None:
    """Press a key of the keyboard, which goes where the focus is."""
    QTest.keyClick(stage.windowHandle(), key, modifiers)


def choose(box: QComboBox, text: str) -> None:
    """Choose by the keyboard, as a user walks through the entries."""
    box.setFocus()
    QTest.keyClick(box, KEYS.Key_Home)
    while not box.currentText().startswith(text):
        before = box.currentIndex()
        QTest.keyClick(box, KEYS.Key_Down)
        assert box.currentIndex() == before + 1, f"there is no {text}"


def test_zones_are_drawn_and_a_typed_weight_holds_without_enter(
    stage: ExportStage,
    settle: Callable[[], None],
    asker: Asker,
    memory: LastOrder,
    tmp_path: Path,
    qtbot: QtBot,
) -> None:
    form = stage.view.form
    choose(form.machine.made_on, "Printer: PrusaSlicer")
    settle()
    assert stage.view.swatches.texts == ("heel 20 %", "arch 32 %", "forefoot 18 %")
    assert all(each.name != "cutter" for each in stage.presenter.parts[0].findings)
    assert "2 walls" in form.machine.facts.text()
    assert "With walls and solid layers of 0.2 mm: " in form.machine.facts.text()
    assert "denser than its infill (heel 20 %: " in form.machine.error.text()
    assert not form.format.isEnabled()
    asker.answer = tmp_path / "anna.3mf"
    form.machine.weight.setFocus()
    strike(stage, KEYS.Key_A, CTRL)
    for digit in "95":
        strike(stage, digit)
    strike(stage, KEYS.Key_Return, CTRL)
    settle()
    assert stage.view.swatches.texts == ("heel 28 %", "arch 40 %", "forefoot 25 %")
    assert not list(tmp_path.glob("*.3mf"))  # nothing is exported that was not shown
    strike(stage, KEYS.Key_Return, CTRL)
    written = tmp_path / "anna-left.3mf"
    qtbot.waitUntil(written.exists)  # the button is seen to go down before
    settle()
    with zipfile.ZipFile(written) as archive:
        config = archive.read("Metadata/Slic3r_PE_model.config").decode()
    assert 'value="heel 28 %"' in config
    assert memory.load().printing == PrintChoice("prusaslicer")
    choose(form.machine.made_on, "Any machine")
    settle()
    assert (form.format.currentData(), form.format.isEnabled()) == (".stl", True)
    assert stage.view.swatches.texts == ()


def test_a_router_gets_its_program_beside_the_solid(
    stage: ExportStage,
    settle: Callable[[], None],
    asker: Asker,
    memory: LastOrder,
    tmp_path: Path,
) -> None:
    fields = stage.view.form.machine
    choose(fields.made_on, "Router: GRBL")
    settle()
    assert "none is chosen; choose the block" in fields.error.text()
    assert not stage.view.export.isEnabled()
    choose(stage.view.form.block, "EVA single")
    settle()
    QTest.keyClick(fields.both_sides, KEYS.Key_Space)
    stage.view.cancel.click()
    assert not stage.jobs.is_running()
    assert not stage.view.export.isEnabled()
    assert "Stopped" in fields.error.text()
    QTest.keyClick(fields.both_sides, KEYS.Key_Space)
    settle()
    assert fields.error.text() == ""
    assert "min without changes of cutters" in fields.facts.text()
    assert stage.view.form.cutter.value() == 6.0
    (hollows,) = (each for each in stage.presenter.parts[0].findings if each.name == "cutter")
    assert "6 mm cutter" in str(hollows.unit)
    asker.answer = tmp_path / "anna.stl"
    told: list[Ordered] = []
    stage.exported.connect(lambda _record, ordered: told.append(ordered))
    stage.view.export.click()
    settle()
    programs = [f"anna-left-{number}.nc" for number in (1, 2, 3)]
    assert sorted(path.name for path in tmp_path.glob("anna*")) == [
        *programs, "anna-left-setup-sheet.pdf", "anna-left.stl"
    ]  # fmt: skip
    assert [path.name for path in told[0].paths] == ["anna-left.stl", *programs]
    assert all("\nG1 X" in (tmp_path / name).read_text() for name in programs)
    assert stage.view.summary.text() == f"Exported anna-left.stl, {', '.join(programs)}"
    (tmp_path / "anna-left-4.nc").write_text((tmp_path / programs[0]).read_text())
    asker.asked.clear()
    stage.view.export.click()
    assert "earlier program (anna-left-4.nc)" in str(asker.told[-1])
    assert asker.asked == []
    asker.answer = tmp_path / "order.zip"
    stage.presenter.edit_choice(replace(stage.view.form.choice(), package="zip"))
    stage.view.export.click()
    settle()
    with zipfile.ZipFile(asker.answer) as archive:
        assert any(name.endswith("-left-3.nc") for name in archive.namelist())
    loaded = memory.load().milling
    assert loaded is not None
    assert (loaded.machine.name, loaded.both_sides) == ("GRBL", False)


def test_the_clinics_own_router(
    stage: ExportStage, settle: Callable[[], None], asker: Asker, tmp_path: Path
) -> None:
    fields = stage.view.form.machine
    text = resource_path("milling/grbl.json").read_text()
    asker.answer = tmp_path / "our.json"
    asker.answer.write_text(text.replace("13000", "0"))
    fields.machine_file_requested.emit()
    assert "our.json" in fields.error.text()
    assert fields.milling() is None
    asker.answer.write_text(json.dumps(json.loads(text) | {"name": "Our router"}))
    fields.machine_file_requested.emit()
    settle()
    chosen = fields.milling()
    assert chosen is not None
    assert chosen.machine.name == fields.made_on.currentText().removeprefix("Router: ")
    assert (tmp_path / "config" / "milling" / "our-router.json").exists()
    fields.machine_removal_requested.emit(chosen.machine)
    settle()
    assert fields.made_on.findText("Router: Our router") < 0
    assert fields.made_on.currentText() == "Any machine"
    assert stage.view.export.isEnabled()


def test_bad_zones_are_told_beside_the_fields(
    stage: ExportStage, settle: Callable[[], None], asker: Asker, tmp_path: Path
) -> None:
    fields = stage.view.form.machine
    choose(fields.made_on, "Printer: Cura")
    choose(fields.zones, "From the map")
    settle()
    assert "needs a map of pressures under the left foot" in fields.error.text()
    choose(fields.zones, "From a file")
    settle()
    assert "No file of zones is chosen" in fields.error.text()
    asker.answer = tmp_path / "zones.json"
    fields.file.click()
    settle()
    assert "zones.json" in fields.error.text()
    assert not stage.view.export.isEnabled()
    zones = {"format": "insole-zones", "version": 1, "preset": "PETG", "zones": []}
    asker.answer.write_text(json.dumps(zones | {"weight_kg": 60}))
    fields.file.click()
    settle()
    assert fields.error.text().startswith("Walls and solid layers make the print denser")
    assert "4 walls" in fields.facts.text()
    assert np.isfinite(stage.presenter.parts[0].solid.vertices).all()


def test_the_weight_of_one_patient_is_not_that_of_the_next(qtbot: QtBot) -> None:
    form = OrderForm(Stock(SHOP.blocks, SHOP.materials))
    qtbot.addWidget(form)
    fields = form.machine
    heavy = PrintChoice("orca", weight_kg=120.0)
    form.show_choice(OrderChoice(suffix=".3mf", printing=heavy), has_pair=False)
    assert fields.printing() == heavy
    form.show_choice(OrderChoice(), has_pair=False)
    fields.show_prescribed_weight(52.0)
    choose(fields.made_on, "Printer: Orca")
    assert fields.printing() == PrintChoice("orca")
    assert fields.weight.value() == 52.0


def test_bad_memory_of_a_print_costs_nothing(memory: LastOrder, tmp_path: Path) -> None:
    machine = next(iter(clinic_machines(tmp_path).load().items.values()))
    memory.save(OrderChoice(milling=MillingChoice(machine, both_sides=True)))
    file = tmp_path / "config" / "order.json"
    assert memory.load().milling == MillingChoice(machine, both_sides=True)
    stored = json.loads(file.read_text()) | {"machine": "gone", "print_printer": "laser"}
    file.write_text(json.dumps(stored))
    assert replace(memory.load(), block=None) == OrderChoice()
