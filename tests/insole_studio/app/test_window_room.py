"""The window fits small screens, and its panels keep what they need of it."""

from __future__ import annotations

from collections.abc import Callable

from hands import MANUAL_SIZE, Hands
from PySide6.QtCore import QEvent, QObject, QPoint, QRect
from PySide6.QtWidgets import (
    QAbstractButton,
    QApplication,
    QComboBox,
    QDockWidget,
    QLabel,
    QProgressBar,
    QPushButton,
    QScrollArea,
    QStyle,
    QStyleOption,
    QStyleOptionButton,
    QStyleOptionComboBox,
    QVBoxLayout,
    QWidget,
)
from pytestqt.qtbot import QtBot

from insole_core.cases.case_record import FootRecord
from insole_core.cases.scan_source import ScanSource
from insole_core.foot.foot import Foot
from insole_core.geometry.side import Side
from insole_core.insole.elements import Pelott
from insole_studio.app.bootstrap import Application
from insole_studio.app.scripted import wait_for
from insole_studio.jobs import JobProgress
from insole_studio.scene.view_camera import Subject
from insole_studio.widgets.date_field import DateField
from insole_studio.widgets.empty_page import EmptyPage
from insole_studio.widgets.layouts import VerticalScroll
from insole_studio.widgets.model_view import ModelView
from insole_studio.widgets.number_field import NumberField

SMALLEST = (683, 456)
"""A screen of 1366 × 768 at 200 % is as wide, one of 1366 × 768 at 150 % less its frame as high."""

LAPTOP = (911, 490)
"""A screen of 1366 × 768 at 150 %, less the frame."""
LOW_PX = 400


def test_the_window_can_be_as_small_as_a_small_screen(clinic: Application) -> None:
    def fits() -> bool:
        width, height = clinic.window.minimumSizeHint().toTuple()
        return width <= SMALLEST[0] and height <= SMALLEST[1]

    assert fits(), "the page of patients"
    clinic.features.records.show_orders()
    assert fits(), "the page of orders"


def test_every_page_of_the_record_is_whole_across_a_laptop_at_150_percent(
    clinic: Application, qtbot: QtBot
) -> None:
    clinic.window.resize(*LAPTOP)
    records = clinic.features.records
    clinic.window.actions_by_key["sample_patient"].trigger()
    qtbot.waitUntil(lambda: records.person is not None and records.person.isVisible())

    def is_whole() -> bool:
        page = clinic.window.page
        assert page is not None
        scrolled = page.parentWidget().parentWidget()
        assert isinstance(scrolled, QScrollArea)
        buttons = [b for b in page.findChildren(QPushButton) if b.isVisible()]
        assert len(buttons) > 1
        return scrolled.horizontalScrollBar().maximum() == 0 and all(
            button.width() >= button.sizeHint().width() for button in buttons
        )

    for show in (lambda: None, records.show_start, records.show_orders):
        show()
        qtbot.waitUntil(is_whole)  # what the record tells comes in later


def test_the_buttons_of_the_export_stay_on_a_low_screen(
    opened: Application, settle: Callable[[], None], qtbot: QtBot
) -> None:
    opened.window.actions_by_key["export"].trigger()
    settle()
    stage = opened.features.export.stage
    assert stage is not None
    wait_for(stage.jobs)
    scrolled = stage.findChild(QScrollArea)
    assert isinstance(scrolled, QScrollArea)
    buttons = (stage.view.export, stage.view.leave)

    def stay() -> None:
        assert scrolled.viewport().height() <= LOW_PX, "it has the new size"
        for button in buttons:
            place = QRect(button.mapTo(stage, QPoint(0, 0)), button.size())
            assert stage.rect().contains(place)
        assert scrolled.verticalScrollBar().maximum() == 0

    stage.resize(LAPTOP[0], LOW_PX)
    qtbot.waitUntil(stay)
    stage.close()


def test_the_parameters_take_a_share_of_a_low_window(hands: Hands) -> None:
    window = hands.app.window
    docks = {dock.objectName(): dock for dock in window.findChildren(QDockWidget)}
    assert window.height() < MANUAL_SIZE[1]
    assert docks["dock-parameters"].height() <= 0.23 * window.height()


def test_the_offers_of_an_empty_view_are_whole_in_a_narrow_one(qtbot: QtBot) -> None:
    page = EmptyPage()
    qtbot.addWidget(page)
    page.resize(230, 240)
    page.show_offers("No scan yet.", {n: f"Open number {n}…" for n in "123"})
    page.show()
    buttons = page.findChildren(QPushButton)
    assert len(buttons) == 3

    def are_whole() -> None:
        for button in buttons:
            assert button.width() >= button.sizeHint().width()
            assert button.height() >= button.sizeHint().height()
            assert page.rect().contains(button.geometry().translated(button.parentWidget().pos()))
        assert len({button.y() for button in buttons}) == 3

    qtbot.waitUntil(are_whole)


def cut_texts(panel: QWidget) -> list[str]:
    """What buttons and choices of a panel draw beyond the room that they have for it."""
    parts, complex_parts, one = QStyle.SubElement, QStyle.ComplexControl, QStyle.SubControl
    texts: list[tuple[str, int, QStyleOption]] = []
    for button in panel.findChildren(QPushButton):
        pressed = QStyleOptionButton()
        button.initStyleOption(pressed)
        room = button.style().subElementRect(parts.SE_PushButtonContents, pressed, button)
        texts += [(pressed.text, room.width(), pressed)] * button.isVisible()
    for choice in panel.findChildren(QComboBox):
        chosen = QStyleOptionComboBox()
        choice.initStyleOption(chosen)
        room = choice.style().subControlRect(
            complex_parts.CC_ComboBox, chosen, one.SC_ComboBoxEditField, choice
        )
        texts += [(chosen.currentText, room.width(), chosen)] * choice.isVisible()
    assert len(texts) > 3
    return [text for text, px, drawn in texts if drawn.fontMetrics.horizontalAdvance(text) > px]


def test_what_has_no_room_in_a_narrow_panel_ends_in_dots(
    opened: Application, settle: Callable[[], None], qtbot: QtBot
) -> None:
    """Of rows that cannot be scrolled sideways."""
    case, panel = opened.case, opened.stage.patient
    design = case.record.design
    assert design is not None
    case.apply(design.with_added(Pelott(centre_mm=(0.0, 120.0))), "Place a pelott")
    foot = case.record.current
    assert foot is not None
    case.apply(foot.with_name(foot.chosen, "For the shoes that she wears at work"), "Name it")
    settle()
    dock = panel.parentWidget()
    assert isinstance(dock, QDockWidget)
    dock.setFloating(True)
    dock.resize(1, 400)
    settle()
    assert panel.width() == panel.minimumSizeHint().width()
    rows = [b for b in panel.findChildren(QPushButton) if b.text().startswith("Pelott")]
    qtbot.waitUntil(rows[0].isVisible)
    assert cut_texts(panel) == []


def test_neither_panels_nor_long_sentences_widen_the_window(
    opened: Application, qtbot: QtBot
) -> None:
    opened.window.actions_by_key["tool_rim"].trigger()
    opened.window.actions_by_key["tool_section"].trigger()
    opened.stage.hint_changed.emit("A sentence that says what can be done here and now. " * 4)
    news = JobProgress("insole", 0.5, "What is being done for a while " * 4, elapsed_s=0.5)
    opened.jobs.progressed.emit(news)
    bar = opened.window.status.findChild(QProgressBar)
    assert bar is not None
    qtbot.waitUntil(bar.isVisible)
    QApplication.processEvents()
    width, height = opened.window.minimumSizeHint().toTuple()
    assert width <= SMALLEST[0]
    assert height <= SMALLEST[1]


def is_whole(widget: QWidget, panel: QWidget) -> bool:
    corner = widget.mapTo(panel, QPoint(0, 0))
    return corner.x() >= 0 and corner.x() + widget.width() <= panel.width()


def test_the_patient_panel_is_whole_again_after_a_small_window(
    opened: Application, make_foot: Callable[[Side], Foot], qtbot: QtBot
) -> None:
    window, panel = opened.window, opened.stage.patient
    right = FootRecord.begun(make_foot(Side.RIGHT), ScanSource("mesh", "/nowhere", "0" * 64))
    opened.case.apply(right, "Add the right foot")
    assert opened.case.record.design is not None
    opened.case.apply(
        opened.case.record.design.with_added(Pelott(centre_mm=(0.0, 150.0))), "Place a pelott"
    )
    window.resize(1366, 768)
    window.arrange()
    QApplication.processEvents()
    wide = panel.width()
    for size in ((700, 480), (1366, 768)):
        window.resize(*size)
        qtbot.waitUntil(lambda: not window._sharing.isActive())
        QApplication.processEvents()
        cut = [
            part
            for part in panel.findChildren(QWidget)
            if isinstance(part, QAbstractButton | DateField)
            and part.isVisibleTo(panel)
            and not is_whole(part, panel.viewport())
        ]
        assert cut == []
    qtbot.waitUntil(lambda: panel.width() == wide)


def test_a_column_gets_room_for_what_comes_into_it(qtbot: QtBot) -> None:
    column, content, label = VerticalScroll(), QWidget(), QLabel("short")
    QVBoxLayout(content).addWidget(label)
    column.setWidget(content)
    dock = QDockWidget()
    qtbot.addWidget(dock)
    dock.setWidget(column)
    dock.resize(60, 80)
    dock.show()
    QApplication.processEvents()
    label.setText("something much longer than what was there before")
    qtbot.waitUntil(lambda: column.viewport().width() >= content.minimumSizeHint().width())


def test_a_section_leaves_the_thickness_in_sight(opened: Application, qtbot: QtBot) -> None:
    window, panel = opened.window, opened.stage.parameters
    window.resize(1200, 700)
    window.arrange()
    assert opened.case.record.design is not None
    pad = Pelott(centre_mm=(0.0, 150.0))
    opened.case.apply(opened.case.record.design.with_added(pad), "Place a pelott")
    opened.case.select(pad.id)
    fields = panel.findChildren(NumberField)
    thickness = next(f for f in fields if f.property("key") == "insole.thickness_mm")

    def is_seen() -> bool:
        QApplication.processEvents()
        place = QRect(thickness.mapTo(panel.viewport(), QPoint(0, 0)), thickness.size())
        return panel.viewport().rect().contains(place)

    qtbot.waitUntil(is_seen)
    without_section = panel.viewport().size()
    window.actions_by_key["tool_section"].trigger()
    assert opened.stage.section.isVisible()
    qtbot.waitUntil(lambda: panel.viewport().size() != without_section)
    qtbot.waitUntil(is_seen)


def test_nothing_flashes_while_a_view_is_made(qtbot: QtBot) -> None:
    """A page that is shown before it is in its view would be a window for a moment."""
    before = set(QApplication.topLevelWidgets())
    shown: list[QWidget] = []

    class Watcher(QObject):
        def eventFilter(self, watched: QObject, event: QEvent) -> bool:  # noqa: N802
            is_window = isinstance(watched, QWidget) and watched.isWindow()
            if event.type() == QEvent.Type.Show and is_window and watched not in before:
                shown.append(watched)
            return False

    watcher = Watcher()
    QApplication.instance().installEventFilter(watcher)  # type: ignore[union-attr]
    view = ModelView(Subject.INSOLE, "", dark=False)
    qtbot.addWidget(view)
    QApplication.instance().removeEventFilter(watcher)  # type: ignore[union-attr]
    assert shown == []
