"""From the empty home to the file of a device with pelott and posting, counted action by action.

One action is a click, a key, or what is typed into the field that has the focus, with its Enter.
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from canned_questions import CannedQuestions
from pointing import LEFT, pixel
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QPushButton, QWidget
from pytestqt.qtbot import QtBot

from insole_core.export.ply import write_ply
from insole_core.geometry.side import Side
from insole_core.insole.prescription.design import Pelott, Posting
from insole_core.simulate import FootShape, build_foot
from insole_core.workflows.foot_landmarks import metatarsal_line
from insole_studio.app.bootstrap import Application
from insole_studio.app.scripted import wait_for
from insole_studio.features.import_scan.import_dialog import ImportDialog
from insole_studio.features.records.new_patient_dialog import NewPatientDialog
from insole_studio.widgets.number_field import NumberField

pytestmark = pytest.mark.slow

MOST_ACTIONS, MOST_WITH_PATIENT = 11, 14


class User:
    """Works in the window by clicks and keys, and counts them."""

    def __init__(self, app: Application, settle: Callable[[], None]) -> None:
        self.app, self.settle, self.actions = app, settle, 0

    def press(self, button: QWidget | None) -> None:
        assert button is not None
        QTest.mouseClick(button, LEFT)
        self.done()

    def strike(self, action: str) -> None:
        """Press the key of an action."""
        self.app.window.actions_by_key[action].trigger()
        self.done()

    def type(self, field: QWidget, text: str) -> None:
        QTest.keyClicks(field, text)
        QTest.keyClick(field, Qt.Key.Key_Return)
        self.done()

    def done(self) -> None:
        self.actions += 1
        self.settle()

    def design(self, scan: Path, questions: CannedQuestions, result: Path) -> None:
        """Import a scan, place a pelott, post the rearfoot, export."""
        questions.path = scan
        self.strike("open_archive")
        self.actions += 1  # the path is typed into the dialog of the system
        dialog = self.app.window.findChild(ImportDialog)
        assert isinstance(dialog, ImportDialog)
        self.press(dialog.open_button)
        self.strike("tool_pelott")
        line = metatarsal_line(self.app.case.record)
        assert line is not None
        x, y, _ = line[1]
        view = self.app.stage.foot.scene
        QTest.mouseClick(view.surface, LEFT, pos=pixel(view, x, y - 42.0))
        self.done()
        self.strike("tool_posting")
        fields = self.app.stage.parameters.findChildren(NumberField)
        field = next(f for f in fields if f.property("key") == "posting.rearfoot_deg")
        self.press(field.lineEdit())
        field.selectAll()
        self.type(field, "4")
        questions.path = result
        self.strike("export")
        stage = self.app.features.export.stage
        assert stage is not None
        self.press(stage.view.export)
        self.actions += 1  # the name is typed into the dialog of the system
        stage.close()


@pytest.fixture
def user(clinic: Application, rest: Callable[[], None], settle: Callable[[], None]) -> User:
    def quiet() -> None:
        rest()
        settle()
        stage = clinic.features.export.stage
        if stage is not None:
            wait_for(stage.jobs)

    return User(clinic, quiet)


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
    assert written.stat().st_size > 1e6


def test_a_device_with_pelott_and_posting_takes_few_actions_from_home(
    user: User, questions: CannedQuestions, scan: Path, tmp_path: Path
) -> None:
    user.design(scan, questions, tmp_path / "insole.stl")
    check(user.app, tmp_path)
    print(f"{user.actions} actions")
    assert user.actions <= MOST_ACTIONS


def test_with_a_new_patient_it_takes_three_more(
    user: User, questions: CannedQuestions, scan: Path, tmp_path: Path, qtbot: QtBot
) -> None:
    start = user.app.features.records.start
    assert start is not None
    user.press(start.new_patient)
    dialog = user.app.window.findChild(NewPatientDialog)
    assert isinstance(dialog, NewPatientDialog)
    user.type(dialog.name, "Eva Berg")
    page = user.app.features.records.person
    qtbot.waitUntil(lambda: page is not None and page.isVisible())
    assert page is not None
    buttons = page.findChildren(QPushButton)
    user.press(next(b for b in buttons if b.property("action") == "new_visit"))
    qtbot.waitUntil(lambda: user.app.case.kept is not None)
    user.design(scan, questions, tmp_path / "insole.stl")
    assert user.app.case.kept is not None
    assert user.app.case.kept.person.name == "Eva Berg"
    check(user.app, tmp_path)
    print(f"{user.actions} actions")
    assert user.actions <= MOST_WITH_PATIENT
