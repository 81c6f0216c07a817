"""Text that comes from elsewhere is shown as it is: never as HTML, which may load files."""

from __future__ import annotations

import zipfile
from collections.abc import Callable, Iterator
from dataclasses import replace
from pathlib import Path

import pytest
from PySide6.QtCore import QAbstractItemModel, QObject, QPoint, Qt, QTimer
from PySide6.QtGui import QImage, QTextDocument
from PySide6.QtTest import QTest
from PySide6.QtWidgets import (
    QAbstractItemView,
    QApplication,
    QDialog,
    QLabel,
    QTextEdit,
    QToolTip,
    QWidget,
)
from shiboken6 import isValid

from insole_core.cases.case_file import write_case
from insole_core.cases.case_record import (
    Annotations,
    CaseRecord,
    FootRecord,
    KeyPoint,
    Patient,
    Variant,
)
from insole_core.cases.scan_source import ScanSource
from insole_core.errors import InputError
from insole_core.foot.foot import Foot
from insole_core.geometry.side import Side
from insole_core.insole.elements import HeelLift
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.messages import Message
from insole_core.visible_text import is_control, visible_line
from insole_studio.app.bootstrap import Application
from insole_studio.features.calibrate.rows import LookRow
from insole_studio.features.calibrate.view import CalibrateView
from insole_studio.features.capture.rows import CaptureRow, SensorRow
from insole_studio.features.capture.view import CaptureView
from insole_studio.services.questions import Questions

pytestmark = pytest.mark.one_window

MARK = "EVIL"
STEERING = "\x1b[2J\u202egnp\x9b"
"""What turns the direction of writing, or steers a terminal that a text is copied to."""
MOST_COLUMNS = 12


@pytest.fixture
def evil(tmp_path: Path) -> str:
    """A text that would load a local image and be bold if it were taken for HTML."""
    image = tmp_path / "beacon.png"
    QImage(8, 8, QImage.Format.Format_RGB32).save(str(image))
    return f'<img src="file://{image}"><b>{MARK}</b> & Co'


@pytest.fixture
def hostile(
    app: Application,
    settle: Callable[[], None],
    make_foot: Callable[[Side], Foot],
    evil: str,
    tmp_path: Path,
) -> Application:
    """A window on a case that has it in every text, with what steers beside it."""
    evil += STEERING
    feet = []
    for side in Side:
        lift = HeelLift(height_mm=9.0, author=evil, created_at="2026-11-20T10:00:00+00:00")
        design = InsoleDesign(side, corrections=(lift,), grid_mm=2.0)
        source = ScanSource("mesh", f"/nowhere/<b>{MARK}<b>{STEERING}.ply", "0" * 64)
        foot = FootRecord.begun(make_foot(side), source, design)
        marked = Annotations((KeyPoint(evil, (0.0, 120.0, 0.0)),))
        foot = replace(foot, annotations=marked, earlier=None)
        feet.append(foot.with_variant(Variant(evil, design)))
    patient = Patient(name=evil, born=evil, visit=evil, notes=evil)
    path = tmp_path / f"<b>{MARK}<b>{STEERING}.insole"
    write_case(CaseRecord(patient, tuple(feet), Side.LEFT), path)
    app.window.resize(1366, 768)
    app.case.author = evil
    app.features.case_files.opener.open_path(path)
    settle()
    told = Message("{text}", text=evil)
    app.services.notices.put("long", told * 20, (told, lambda: None))
    app.services.messages.say(told)
    QTest.qWait(20)
    return app


def rich(label: QLabel) -> bool:
    """Whether a label takes its text for HTML."""
    if label.textFormat() == Qt.TextFormat.AutoText:
        return Qt.mightBeRichText(label.text())
    return label.textFormat() != Qt.TextFormat.PlainText


def _letters_of(widget: QWidget) -> str:
    """The letters that a label or a text field shows: those of HTML without its marks."""
    if isinstance(widget, QTextEdit):
        return widget.toPlainText()
    if not isinstance(widget, QLabel):
        return ""
    document = QTextDocument()
    (document.setHtml if rich(widget) else document.setPlainText)(widget.text())
    return document.toPlainText()


def taken_for_html(root: QWidget) -> Iterator[str]:
    """Every text below a widget, tooltips included, that shows foreign text as HTML."""
    for widget in (root, *root.findChildren(QWidget)):
        if not isValid(widget):  # it may go while another one is polished
            continue
        widget.ensurePolished()
        if MARK in (letters := _letters_of(widget)) and f"<b>{MARK}" not in letters:
            yield f"{type(widget).__name__}: {letters}"
        for tip in (widget.toolTip(), widget.statusTip(), widget.whatsThis(), *_item_tips(widget)):
            if MARK in tip:
                yield from _tooltip_as_html(tip, widget)


def _item_tips(widget: QWidget) -> Iterator[str]:
    if isinstance(widget, QAbstractItemView) and (model := widget.model()) is not None:
        for row in range(model.rowCount()):
            for column in range(MOST_COLUMNS):
                yield model.index(row, column).data(Qt.ItemDataRole.ToolTipRole) or ""


def _tooltip_as_html(tip: str, widget: QWidget) -> Iterator[str]:
    QToolTip.showText(QPoint(10, 10), tip, widget)
    bubbles = [w for w in QApplication.topLevelWidgets() if w.inherits("QTipLabel")]
    assert bubbles
    for bubble in bubbles:
        assert isinstance(bubble, QLabel)
        if rich(bubble):
            yield f"tooltip: {tip}"
    QToolTip.hideText()


def steered(root: QObject) -> Iterator[str]:
    """Every text of a window, its menus and its lists that a control character is in."""
    for shown in (root, *root.findChildren(QObject)):
        kind = shown.metaObject()
        texts = [kind.property(number) for number in range(kind.propertyCount())]
        for text in (each for each in texts if each.metaType().name() == "QString"):
            if _is_steered(str(shown.property(text.name()))):
                yield f"{kind.className()}.{text.name()}: {shown.property(text.name())!r}"
        if isinstance(shown, QAbstractItemModel):
            yield from filter(_is_steered, _cells(shown))


def _is_steered(text: str) -> bool:
    return any(is_control(character) and character not in "\n\t" for character in text)


def _cells(model: QAbstractItemModel) -> Iterator[str]:
    for row in range(model.rowCount()):
        for column in range(MOST_COLUMNS):
            yield str(model.index(row, column).data() or "")


def all_taken_for_html() -> list[str]:
    """Every text of all windows that is shown as HTML, or that steers what is shown.

    Not of the bubbles of tooltips: each one that is looked at ends the one before.
    """
    windows = (w for w in QApplication.topLevelWidgets() if not w.inherits("QTipLabel"))
    return [text for window in windows for text in (*taken_for_html(window), *steered(window))]


def test_the_window_shows_foreign_text_as_it_is(
    hostile: Application, settle: Callable[[], None], evil: str
) -> None:
    labels = [w for w in hostile.window.findChildren(QLabel) if MARK in w.text()]
    assert len(labels) >= 3  # the strip, a notice, and others
    assert all_taken_for_html() == []
    hostile.controller.run_action("beside_variant", True)
    settle()
    hostile.controller.run_action("map_difference", True)
    settle()
    assert MARK in hostile.stage.insole.numbers.text()
    hostile.stage.insole.show_warning(evil)
    hostile.controller.run_action("tool_key_point", True)
    assert all_taken_for_html() == []
    name = f"<b>{MARK}<b>{visible_line(STEERING)}"
    assert hostile.window.windowTitle() == f"{name}[*] – Insole Studio"


def test_the_stages_show_foreign_text_as_it_is(
    hostile: Application, settle: Callable[[], None], small_session: Path, tmp_path: Path
) -> None:
    hostile.controller.run_action("export", False)
    stage = hostile.features.export.stage
    assert MARK in stage.view.patient.text()
    stage.view.show_error(stage.view.patient.text())
    hostile.controller.run_action("compare", False)
    hostile.features.compare.stage.view.show_error(stage.view.patient.text())
    session = tmp_path / f"<b>{MARK}<b>{STEERING}.zip"
    session.write_bytes(small_session.read_bytes())
    hostile.features.foot.open_session(session, hand_over=False)
    foot_stage = hostile.features.foot.stage
    foot_stage.view.show_session(f"<b>{MARK}<b>", Side.LEFT)
    foot_stage.view.show_sentences([f"<b>{MARK}</b>"])
    assert all_taken_for_html() == []
    foot_stage.presenter.cancel()


def test_names_of_sensors_and_pictures_are_shown_as_they_are(
    app: Application, qtbot, evil: str
) -> None:
    capture, calibrate = CaptureView(2.0), CalibrateView()
    for view in (capture, calibrate):
        qtbot.addWidget(view)
        view.show()
    capture.show_sensors([SensorRow(evil, f"Sensor {evil}", "left", evil, hints=(evil,))])
    capture.show_capture(CaptureRow(button="Capture", offer=evil))
    capture.show_sentence(evil)
    calibrate.show_serials([evil])
    calibrate.show_serial(evil)
    calibrate.show_looks([LookRow(evil, usable=True, sentence=evil)])
    calibrate.show_next([evil])
    calibrate.show_error(evil)
    assert all_taken_for_html() == []


def inspect_dialog(found: list[str]) -> None:
    """Look at the dialog that is waiting for an answer, and reject it."""
    dialog = QApplication.activeModalWidget()
    assert isinstance(dialog, QDialog)
    labels = [label for label in dialog.findChildren(QLabel) if MARK in label.text()]
    assert labels
    found += [*taken_for_html(dialog), *steered(dialog)]
    dialog.reject()


ASKING: dict[str, Callable[[Questions, str], object]] = {
    "unsaved": lambda questions, evil: questions.about_unsaved(evil),
    "anyway": lambda questions, evil: questions.open_anyway(evil),
    "other foot": lambda questions, evil: questions.about_other_foot(evil, Side.LEFT),
    "alone": lambda questions, evil: questions.make_alone(evil, Side.LEFT),
    "replace": lambda questions, _evil: questions.may_replace(
        [Path(f"<b>{MARK}<b>{STEERING}.stl")]
    ),
    "replace own": lambda questions, evil: questions.may_replace_own(evil),
    "discard": lambda questions, evil: questions.may_discard(evil),
    "namesake": lambda questions, evil: questions.about_namesake(evil, "Open", "Add"),
    "text": lambda questions, evil: questions.text("Name", evil, evil),
}


@pytest.mark.parametrize("question", ASKING)
def test_questions_show_foreign_text_as_it_is(question: str, app: Application, evil: str) -> None:
    found: list[str] = []
    QTimer.singleShot(50, lambda: inspect_dialog(found))
    ASKING[question](Questions(app.window), evil)
    assert found == []


def test_errors_show_foreign_text_as_it_is(app: Application, evil: str) -> None:
    error = InputError("{path} is empty; export it again.", path=evil)
    error.__cause__ = OSError(evil)
    app.services.messages.show_error(error)
    (dialog,) = app.services.messages.dialogs
    QTest.qWait(20)
    assert MARK in dialog.text()
    assert list(taken_for_html(dialog)) == []


@pytest.mark.drawn
def test_no_image_of_a_foreign_text_is_drawn(hostile: Application, evil: str) -> None:
    """The strip with the name is as high as its letters: an image would make it higher."""
    label = next(w for w in hostile.stage.steps.findChildren(QLabel) if MARK in w.text())
    assert "<img" in label.text()
    assert label.sizeHint().width() >= label.fontMetrics().horizontalAdvance(label.text())


def test_an_archive_of_a_foreign_name_is_told_as_it_is(
    app: Application, settle: Callable[[], None], tmp_path: Path
) -> None:
    path = tmp_path / f"<b>{MARK}<b>{STEERING}.zip"
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr("nothing", "")
    app.features.case_files.opener.open_path(path)
    settle()
    QTest.qWait(20)
    (dialog,) = app.services.messages.dialogs
    assert MARK in dialog.text()
    assert list(taken_for_html(dialog)) == []
