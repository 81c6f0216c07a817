"""From the empty home to the file of a device with pelott and posting, counted action by action.

One action is a click, a key, or what is typed into the field that has the focus, with its Enter.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from hands import MANUAL_SIZE, Hands
from PySide6.QtWidgets import QPushButton
from pytestqt.qtbot import QtBot

from insole_core.formats.ply import write_ply
from insole_core.geometry.side import Side
from insole_core.insole.elements import Pelott, Posting
from insole_core.scans.mesh_file import read_mesh
from insole_core.simulate import FootShape, build_foot
from insole_core.workflows.foot_landmarks import metatarsal_line
from insole_studio.app.bootstrap import Application
from insole_studio.features.import_scan.import_dialog import ImportDialog
from insole_studio.features.records.patient_dialogs import NewPatientDialog
from insole_studio.widgets.number_field import NumberField

pytestmark = pytest.mark.slow

MOST_ACTIONS, MOST_WITH_PATIENT = 11, 14


@pytest.fixture
def at_home(hands: Hands, qtbot: QtBot) -> Hands:
    """The user before the start page, with a new record."""
    record = hands.app.services.clinic
    hands.app.window.resize(*MANUAL_SIZE)
    hands.app.features.records.show_start()
    record.open()
    qtbot.waitUntil(lambda: record.is_open)
    return hands


def design(hands: Hands, scan: Path, result: Path) -> None:
    """Import a scan, place a pelott, post the rearfoot, export."""
    hands.open(scan)
    hands.actions += 1  # the path is typed into the dialog of the system
    dialog = hands.app.window.findChild(ImportDialog)
    assert isinstance(dialog, ImportDialog)
    hands.press(dialog.open_button)
    hands.choose("tool_pelott")
    line = metatarsal_line(hands.app.case.record)
    assert line is not None
    x, y, _ = line[1]
    hands.click((x, y - 42.0))
    hands.choose("tool_posting")
    fields = hands.app.stage.parameters.findChildren(NumberField)
    field = next(f for f in fields if f.property("key") == "posting.rearfoot_deg")
    hands.press(field.lineEdit())
    field.selectAll()
    hands.type_into(field, "4")
    hands.export(result)
    hands.actions += 1  # the name is typed into the dialog of the system


@pytest.fixture(scope="module")
def scan(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("scan") / "left.ply"
    write_ply(
        build_foot(FootShape(side=Side.LEFT), np.random.default_rng(1), cell_mm=4.0).mesh, path
    )
    return path


def check(app: Application, folder: Path) -> None:
    design = app.case.record.design
    assert design is not None
    assert design.finish is not None, "it is a device"
    assert [type(c) for c in design.corrections] == [Pelott, Posting]
    (written,) = folder.glob("insole-left.stl")
    assert read_mesh(written).mesh.is_closed


def test_a_device_with_pelott_and_posting_takes_few_actions_from_home(
    at_home: Hands, scan: Path, tmp_path: Path
) -> None:
    design(at_home, scan, tmp_path / "insole.stl")
    check(at_home.app, tmp_path)
    print(f"{at_home.actions} actions")
    assert at_home.actions <= MOST_ACTIONS


def test_with_a_new_patient_it_takes_three_more(
    at_home: Hands, scan: Path, tmp_path: Path, qtbot: QtBot
) -> None:
    start = at_home.app.features.records.start
    assert start is not None
    at_home.press(start.new_patient)
    dialog = at_home.app.window.findChild(NewPatientDialog)
    assert isinstance(dialog, NewPatientDialog)
    at_home.type_into(dialog.name, "Eva Berg")
    page = at_home.app.features.records.person
    qtbot.waitUntil(lambda: page is not None and page.isVisible())
    assert page is not None
    buttons = page.findChildren(QPushButton)
    at_home.press(next(b for b in buttons if b.property("action") == "new_visit"))
    qtbot.waitUntil(lambda: at_home.app.case.kept is not None)
    design(at_home, scan, tmp_path / "insole.stl")
    assert at_home.app.case.kept is not None
    assert at_home.app.case.kept.person.name == "Eva Berg"
    check(at_home.app, tmp_path)
    print(f"{at_home.actions} actions")
    assert at_home.actions <= MOST_WITH_PATIENT
