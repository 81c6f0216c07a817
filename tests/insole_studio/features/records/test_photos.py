"""Photos of a visit in the window: added, drawn and written on, kept at once, deleted."""

from __future__ import annotations

import threading
from collections.abc import Callable
from dataclasses import replace
from datetime import date
from pathlib import Path

import pytest
from canned_questions import CannedQuestions
from PySide6.QtCore import QEvent, QPoint, QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QImage, QMouseEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QPushButton
from pytestqt.qtbot import QtBot

from insole_core.errors import InputError, Unreachable
from insole_core.records.person import Person
from insole_core.records.photo import Photo, PhotoMark
from insole_core.records.photos import Photos
from insole_core.records.records import Records
from insole_core.records.visit import Visit
from insole_studio.app.bootstrap import Application
from insole_studio.document import clinic_record
from insole_studio.features.records.photos_dialog import PhotosDialog
from insole_studio.services.questions import Answer
from insole_studio.widgets.picture_view import Line, MarkedPicture

pytestmark = pytest.mark.one_window

LEFT = Qt.MouseButton.LeftButton
SKIN = "#c8a08c"


@pytest.fixture
def dialog(
    clinic: Application, visit: Visit, rest: Callable[[], None], questions: CannedQuestions,
    tmp_path: Path, qtbot: QtBot,
) -> PhotosDialog:  # fmt: skip
    """The photos of Anna's visit, opened from its card: a photo of 400 by 300 pixels."""
    clinic.features.records.show_person(visit.person_id)
    rest()
    page = clinic.features.records.person
    assert page is not None
    qtbot.waitUntil(lambda: list(page.cards) == [visit.id])
    buttons = page.cards[visit.id].findChildren(QPushButton)
    QTest.mouseClick(next(b for b in buttons if b.text() == "Photos…"), LEFT)
    qtbot.waitUntil(lambda: bool(clinic.window.findChildren(PhotosDialog)))
    (shown,) = clinic.window.findChildren(PhotosDialog)
    image = QImage(400, 300, QImage.Format.Format_RGB32)
    image.fill(QColor(SKIN))
    questions.path = tmp_path / "sole.png"
    assert image.save(str(questions.path))
    QTest.mouseClick(shown.add, LEFT)
    rest()
    qtbot.waitUntil(lambda: not shown.picture.picture_rect.isEmpty())
    return shown


def at(dialog: PhotosDialog, x: float, y: float) -> QPoint:
    rect = dialog.picture.picture_rect
    return QPointF(rect.x() + x * rect.width(), rect.y() + y * rect.height()).toPoint()


def draw(dialog: PhotosDialog, *places: tuple[float, float]) -> None:
    picture, points = dialog.picture, [at(dialog, *place) for place in places]
    QTest.mousePress(picture, LEFT, pos=points[0])
    for point in points[1:]:
        QTest.mouseMove(picture, point)
    QTest.mouseRelease(picture, LEFT, pos=points[-1])


def test_lines_and_places_are_drawn_with_a_text_and_kept_at_once(
    dialog: PhotosDialog, clinic: Application, records: Records, visit: Visit,
    rest: Callable[[], None], qtbot: QtBot,
) -> None:  # fmt: skip
    draw(dialog, (0.25, 0.5))
    assert dialog.focusWidget() is dialog.text
    QTest.keyClicks(dialog.text, "sore")
    draw(dialog, (0.1, 0.1), (0.5, 0.2), (0.9, 0.1))
    QTest.keyClicks(dialog.text, "callus")
    QTest.keyClick(dialog.text, Qt.Key.Key_Return)
    dialog.caption.setFocus()
    QTest.keyClicks(dialog.caption, "Left sole")
    QTest.keyClick(dialog.caption, Qt.Key.Key_Return)
    rest()
    qtbot.waitUntil(lambda: records.photos.of_visit(visit.id)[0].caption == "Left sole")
    (photo,) = records.photos.of_visit(visit.id)
    place, line = photo.marks
    assert (place.text, line.text) == ("sore", "callus")
    assert place.points[0] == pytest.approx((0.25, 0.5), abs=0.01)
    assert len(place.points) == 1
    assert line.points[-1] == pytest.approx((0.9, 0.1), abs=0.01)
    drawn = dialog.picture.grab().toImage()
    on_line, beside = at(dialog, 0.5, 0.2), at(dialog, 0.5, 0.8)
    skin, line_color = (drawn.pixelColor(place) for place in (beside, on_line))
    assert abs(skin.blue() - QColor(SKIN).blue()) < 5
    assert abs(line_color.blue() - skin.blue()) > 40
    dialog.reject()
    page = clinic.features.records.person
    assert page is not None
    qtbot.waitUntil(lambda: page.cards[visit.id].row.photos == 1)
    buttons = [button.text() for button in page.cards[visit.id].findChildren(QPushButton)]
    assert "Photos (1)…" in buttons


def test_a_mark_and_a_photo_are_removed(
    dialog: PhotosDialog, records: Records, visit: Visit, rest: Callable[[], None], qtbot: QtBot,
    questions: CannedQuestions,
) -> None:  # fmt: skip
    draw(dialog, (0.2, 0.2))
    draw(dialog, (0.8, 0.8))
    dialog.marks.selectRow(0)
    QTest.mouseClick(dialog.remove, LEFT)
    rest()
    qtbot.waitUntil(lambda: len(records.photos.of_visit(visit.id)[0].marks) == 1)
    (mark,) = records.photos.of_visit(visit.id)[0].marks
    assert mark.points[0] == pytest.approx((0.8, 0.8), abs=0.01)
    questions.unsaved = Answer.CANCEL
    QTest.mouseClick(dialog.delete, LEFT)
    rest()
    assert questions.asked == ["delete photo"]
    assert len(dialog.table.rows) == len(records.photos.of_visit(visit.id)) == 1
    questions.unsaved = Answer.DISCARD
    QTest.mouseClick(dialog.delete, LEFT)
    rest()
    assert questions.asked == ["delete photo"] * 2
    qtbot.waitUntil(lambda: records.photos.of_visit(visit.id) == [])
    assert dialog.table.rows == ()
    assert not dialog.delete.isEnabled()
    assert dialog.delete.toolTip() == dialog.caption.toolTip() == "Choose a photo first."
    assert dialog.remove.toolTip() == "Choose a mark first, or draw one."


def test_photos_that_cannot_be_changed_say_why(qapp: QApplication) -> None:
    dialog = PhotosDialog("Photos", why_not_change="Nothing can be changed.")
    for button in (dialog.add, dialog.delete, dialog.remove):
        assert not button.isEnabled()
        assert button.toolTip() == "Nothing can be changed."
    assert dialog.caption.isReadOnly()
    dialog.deleteLater()


def test_what_somebody_else_has_drawn_is_not_lost(
    dialog: PhotosDialog, clinic: Application, other_station: Records, visit: Visit, qtbot: QtBot
) -> None:
    (photo,) = other_station.photos.of_visit(visit.id)
    theirs = PhotoMark(((0.5, 0.5),), "wart")
    other_station.photos.change(replace(photo, marks=(theirs,)), photo.revision)
    draw(dialog, (0.1, 0.9))
    qtbot.waitUntil(lambda: bool(clinic.services.messages.dialogs))
    assert "Somebody else has drawn" in clinic.services.messages.dialogs[0].text()
    qtbot.waitUntil(lambda: [row.cells[1] for row in dialog.marks.rows] == ["wart"])
    draw(dialog, (0.1, 0.9))
    qtbot.waitUntil(lambda: len(other_station.photos.of_visit(visit.id)[0].marks) == 2)


def held_changes(
    monkeypatch: pytest.MonkeyPatch, error: Exception | None = None
) -> threading.Event:
    """Let changes of photos wait for an event; the first of them then fails with an error."""
    go_on, change, errors = threading.Event(), Photos.change, [] if error is None else [error]

    def change_later(photos: Photos, photo: Photo, revision: int) -> Photo:
        assert go_on.wait(60)
        if errors:
            raise errors.pop()
        return change(photos, photo, revision)

    monkeypatch.setattr(Photos, "change", change_later)
    return go_on


def test_a_late_answer_brings_no_photo_to_another_patient(
    dialog: PhotosDialog, clinic: Application, records: Records, visit: Visit,
    rest: Callable[[], None], monkeypatch: pytest.MonkeyPatch, qtbot: QtBot,
) -> None:  # fmt: skip
    eva = records.visits.add(Visit(records.persons.add(Person("Eva Holm")).id, date.today()))
    go_on = held_changes(monkeypatch)
    draw(dialog, (0.2, 0.2))
    draw(dialog, (0.8, 0.8))
    dialog.reject()
    qtbot.waitUntil(lambda: not clinic.window.findChildren(PhotosDialog))
    clinic.features.records.photos.open(eva.id)
    qtbot.waitUntil(lambda: bool(clinic.window.findChildren(PhotosDialog)))
    (of_eva,) = clinic.window.findChildren(PhotosDialog)
    go_on.set()
    rest()
    qtbot.waitUntil(lambda: len(records.photos.of_visit(visit.id)[0].marks) == 2)
    QTest.mouseClick(of_eva.add, LEFT)
    rest()
    qtbot.waitUntil(lambda: not of_eva.picture.picture_rect.isEmpty())
    assert [row.key for row in of_eva.table.rows] == [p.id for p in records.photos.of_visit(eva.id)]
    draw(of_eva, (0.5, 0.5))
    qtbot.waitUntil(lambda: len(records.photos.of_visit(eva.id)[0].marks) == 1)


def test_what_waits_to_be_stored_is_there_when_the_photos_are_opened_again(
    dialog: PhotosDialog, clinic: Application, records: Records, visit: Visit,
    monkeypatch: pytest.MonkeyPatch, qtbot: QtBot,
) -> None:  # fmt: skip
    go_on = held_changes(monkeypatch)
    draw(dialog, (0.2, 0.2))
    dialog.reject()
    qtbot.waitUntil(lambda: not clinic.window.findChildren(PhotosDialog))
    clinic.features.records.photos.open(visit.id)
    qtbot.waitUntil(lambda: bool(clinic.window.findChildren(PhotosDialog)))
    (again,) = clinic.window.findChildren(PhotosDialog)
    assert len(again.marks.rows) == 1
    qtbot.waitUntil(lambda: not again.picture.picture_rect.isEmpty())
    draw(again, (0.8, 0.8))
    go_on.set()
    qtbot.waitUntil(lambda: len(records.photos.of_visit(visit.id)[0].marks) == 2)
    assert clinic.services.messages.dialogs == []


@pytest.mark.parametrize(
    "error", [Unreachable("The database does not answer."), InputError("Draw it again.")]
)
def test_what_was_drawn_after_a_change_that_failed_is_stored(
    dialog: PhotosDialog, clinic: Application, records: Records, visit: Visit, error: Exception,
    monkeypatch: pytest.MonkeyPatch, qtbot: QtBot,
) -> None:  # fmt: skip
    monkeypatch.setattr(clinic_record, "RETRY_MS", 50)
    go_on = held_changes(monkeypatch, error)
    draw(dialog, (0.2, 0.2))
    draw(dialog, (0.8, 0.8))
    go_on.set()
    qtbot.waitUntil(lambda: bool(clinic.services.messages.dialogs))
    assert str(error) in clinic.services.messages.dialogs[0].text()
    qtbot.waitUntil(lambda: len(records.photos.of_visit(visit.id)[0].marks) == 2)
    assert len(dialog.marks.rows) == 2


def test_no_text_can_be_typed_that_the_record_would_refuse(
    dialog: PhotosDialog, records: Records, visit: Visit, qtbot: QtBot
) -> None:
    draw(dialog, (0.2, 0.2))
    QTest.keyClicks(dialog.text, "w" * 600)
    QTest.keyClick(dialog.text, Qt.Key.Key_Return)
    dialog.caption.setFocus()
    QTest.keyClicks(dialog.caption, "c" * 600)
    QTest.keyClick(dialog.caption, Qt.Key.Key_Return)
    qtbot.waitUntil(lambda: records.photos.of_visit(visit.id)[0].caption == dialog.caption.text())
    (photo,) = records.photos.of_visit(visit.id)
    assert photo.caption == "c" * len(photo.caption) != ""
    assert photo.marks[0].text == dialog.text.text() != ""


@pytest.mark.parametrize(("step_px", "fewest", "most"), [(0.25, 200, 400), (5.0, 1900, 2000)])
def test_a_long_line_of_a_fast_mouse_is_taken(
    qtbot: QtBot, step_px: float, fewest: int, most: int
) -> None:
    picture = MarkedPicture()
    qtbot.addWidget(picture)
    image = QImage(400, 300, QImage.Format.Format_RGB32)
    picture.show_picture(image)
    lines: list[Line] = []
    picture.drawn.connect(lines.append)
    moved, rect = QEvent.Type.MouseMove, picture.picture_rect
    places = [_wave(rect, step_px * n) for n in range(3000)]
    for kind, place in [
        (QEvent.Type.MouseButtonPress, places[0]),
        *((moved, place) for place in places),
        (QEvent.Type.MouseButtonRelease, places[-1]),
    ]:
        none = Qt.KeyboardModifier.NoModifier
        QApplication.sendEvent(picture, QMouseEvent(kind, place, place, LEFT, LEFT, none))
    (line,) = lines
    assert fewest < len(PhotoMark(line).checked().points) <= most
    for part, place in ((line[0], places[0]), (line[-1], places[-1])):
        drawn = QPointF(rect.x() + part[0] * rect.width(), rect.y() + part[1] * rect.height())
        assert (drawn - place).manhattanLength() < 4


def _wave(rect: QRectF, along_px: float) -> QPointF:
    """Return a point so far along a line that goes to and fro on a picture."""
    there = along_px % (2 * (rect.width() - 2))
    return QPointF(rect.left() + 1 + min(there, 2 * (rect.width() - 2) - there), rect.center().y())
