"""Mouse and keys of a journey: real events, in a 3-D view at places in mm."""

from __future__ import annotations

import numpy as np
from PySide6.QtCore import QEvent, QPoint, QPointF, Qt
from PySide6.QtGui import QKeyEvent, QWheelEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QTableView, QWidget

from insole_studio.scene.scene_view import SceneView

LEFT = Qt.MouseButton.LeftButton


def pixel(view: SceneView, x_mm: float, y_mm: float, z_mm: float = 0.0) -> QPoint:
    """Give where a place of the insole frame is seen."""
    x, y = view.look.pixels_of(np.array([x_mm, y_mm, z_mm]))[0]
    return QPoint(round(x), round(y))


def lead(view: SceneView, *way: QPoint, button: Qt.MouseButton = LEFT) -> None:
    """Press at the first place and move on to the last; the picture follows twice."""
    places = way if len(way) > 2 else (way[0], (way[0] + way[1]) / 2, way[1])
    QTest.mousePress(view.surface, button, pos=places[0])
    for number, place in enumerate(places[1:], start=1):
        QTest.mouseMove(view.surface, place)
        if number in (len(places) // 2, len(places) - 1):
            QApplication.processEvents()


def drag(view: SceneView, *way: QPoint, button: Qt.MouseButton = LEFT) -> None:
    """Press, move, release; two places are joined by a straight way."""
    lead(view, *way, button=button)
    QTest.mouseRelease(view.surface, button, pos=way[-1])


def click_heading(table: QTableView, column: int) -> None:
    header = table.horizontalHeader()
    x = header.sectionViewportPosition(column) + header.sectionSize(column) // 2
    place = QPoint(x, header.height() // 2)
    QTest.mouseClick(header.viewport(), LEFT, pos=place)


_wheel_turned_at_s = 0.0


def turn_wheel(widget: QWidget, notches: int, *, after_s: float = 1.0) -> None:
    """Turn the wheel over the middle of a widget, some time after it was turned before."""
    global _wheel_turned_at_s  # noqa: PLW0603 - the clock of the system, which only goes on
    _wheel_turned_at_s += after_s
    middle = QPointF(widget.rect().center())
    turned = QWheelEvent(
        middle,
        widget.mapToGlobal(middle),
        QPoint(),
        QPoint(0, 120 * notches),
        Qt.MouseButton.NoButton,
        Qt.KeyboardModifier.NoModifier,
        Qt.ScrollPhase.NoScrollPhase,
        False,
    )
    turned.setTimestamp(round(1000 * _wheel_turned_at_s))
    QApplication.sendEvent(widget, turned)


def hold(
    field: QWidget,
    key: Qt.Key,
    repeats: int,
    modifiers: Qt.KeyboardModifier = Qt.KeyboardModifier.NoModifier,
) -> None:
    """Press a key and hold it, which the system reports as one press and repeated ones."""
    for is_repeated in (False, *[True] * repeats):
        event = QKeyEvent(QEvent.Type.KeyPress, key, modifiers, "", is_repeated)
        QApplication.sendEvent(field, event)
