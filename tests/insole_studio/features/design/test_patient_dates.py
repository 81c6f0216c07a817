"""Dates are typed, checked, and refused in words; a case with wrong ones opens with a notice."""

from __future__ import annotations

from pathlib import Path

import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QLineEdit
from pytestqt.qtbot import QtBot

from insole_core.cases.case_file import write_case
from insole_core.cases.case_record import CaseRecord, Patient
from insole_studio.app.bootstrap import Application


def field_of(app: Application, key: str) -> QLineEdit:
    fields = app.stage.patient.findChildren(QLineEdit)
    return next(field for field in fields if field.property("key") == key)


def type_in(app: Application, key: str, text: str) -> QLineEdit:
    field = field_of(app, key)
    field.setFocus()
    field.selectAll()
    QTest.keyClicks(field, text)
    QTest.keyClick(field, Qt.Key.Key_Return)
    return field


def test_a_date_is_taken_however_it_is_written(app: Application) -> None:
    field = type_in(app, "born", "1970-2-8")
    assert app.case.record.patient.born == field.text() == "1970-02-08"
    type_in(app, "visit", "20261120")
    assert app.case.record.patient.visit == "2026-11-20"


@pytest.mark.parametrize("key", ["born", "visit"])
def test_a_day_that_the_calendar_lacks_is_refused(app: Application, key: str) -> None:
    type_in(app, key, "1970-02-28")
    steps = len(app.case.history)
    field = type_in(app, key, "1970-02-30")
    bubble = app.stage.patient._refusals[key]
    assert bubble.isVisible()
    assert bubble.text() == (
        "1970-02-30 is no date; write year, month and day, such as 1970-02-28. It stays 1970-02-28."
    )
    assert field.text() == getattr(app.case.record.patient, key) == "1970-02-28"
    assert len(app.case.history) == steps
    type_in(app, key, " ")
    assert getattr(app.case.record.patient, key) == ""


def test_a_case_with_a_nonsense_birth_date_opens_with_a_notice(
    app: Application, tmp_path: Path, qtbot: QtBot
) -> None:
    write_case(CaseRecord(Patient("Anna", "1970-02-30")), tmp_path / "a.insole")
    app.features.case_files.opener.open_path(tmp_path / "a.insole")
    qtbot.waitUntil(lambda: app.case.path is not None)
    assert app.case.record.patient.born == "1970-02-30"
    texts = [notice.text for notice in app.services.notices.notices]
    assert any("The birth date cannot be right: 1970-02-30 is no date" in text for text in texts)
    type_in(app, "born", "1970-03-02")
    assert app.services.notices.notices == []
