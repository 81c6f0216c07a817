"""The rim of an insole as an unrolled graph: its height along the edge, with stations to drag."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from PySide6.QtCore import QEvent, QPointF, QRectF, QSize, Qt, Signal
from PySide6.QtGui import (
    QColor,
    QContextMenuEvent,
    QFocusEvent,
    QHelpEvent,
    QKeyEvent,
    QMouseEvent,
    QPainter,
    QPaintEvent,
    QPen,
    QPolygonF,
    QTransform,
)
from PySide6.QtWidgets import QMenu, QToolTip, QWidget

from insole_core.geometry.arrays import FloatArray
from insole_studio.texts import localised, tr
from insole_studio.widgets.chart_ticks import chart_ticks

LEFT_PX, RIGHT_PX, TOP_PX, BOTTOM_PX = 40.0, 12.0, 20.0, 22.0
SWATCH_PX, GAP_PX = 20, 20
"""In the legend, from the line of a curve to its name, and on to the next one."""
LEAST_HIGH_MM, ABOVE_MM, ABOVE_FLANK_MM = 16.0, 3.0, 8.0
"""Least height that is shown, and room above the highest station; more for a flank above it."""
GRAB_PX, TOUCH_GRAB_PX = 12.0, 26.0
STATION_PX, SELECTED_PX = 5.0, 7.0
ALONG_PX = 6.0
"""A drag that goes less far along the edge only changes the height."""
NUDGE_MM, COARSE, FINE = 0.5, 10.0, 0.1
SKIN = "#c4684a"


@dataclass(frozen=True)
class ChartStation:
    """A station of the rim: where it stands in the graph."""

    s_mm: float
    height_mm: float


@dataclass(frozen=True)
class ChartZone:
    """A named part of the edge between two places, mm along the graph."""

    name: str
    start_mm: float
    end_mm: float


@dataclass(frozen=True, eq=False)
class RimGraph:
    """What the graph shows.

    Parameters
    ----------
    s_mm : (n,)
        Places along the unrolled edge, ascending.
    rim_mm, flank_mm : (n,)
        Height of the rim, and of the foot's flank beside it; NaN where the foot has none.
    stations
        In the order of the prescription.
    describe
        Returns place and height of a station in words, by its number.
    zones
        The anatomical parts of the edge.
    cut_off
        Parts of the way, from one place to another, that a short insole does not reach.
    """

    s_mm: FloatArray
    rim_mm: FloatArray
    flank_mm: FloatArray
    stations: tuple[ChartStation, ...]
    zones: tuple[ChartZone, ...]
    describe: Callable[[int], str]
    cut_off: tuple[tuple[float, float], ...] = ()


@dataclass(frozen=True)
class _Drag:
    """A station that is held: its number, where the pointer was pressed, where it stood."""

    number: int
    pressed_px: QPointF
    start_px: QPointF


class RimChart(QWidget):
    """The rim over the unrolled edge; a drag of a station goes out as intents, in mm."""

    chosen = Signal(int)
    """A station was selected; -1 for none."""
    grabbed = Signal(int)
    """A drag of a station begins."""
    dragged = Signal(float, float)
    """The station that is held shall stand there: place along the edge and height, mm."""
    released = Signal()
    cancelled = Signal()
    nudged = Signal(int, float, float)
    """Move a station by these steps along the edge and up, mm."""
    added = Signal(float)
    """Add a station at this place along the edge, mm."""
    removed = Signal(int)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._sentence = ""
        self._graph: RimGraph | None = None
        self._selected: int | None = None
        self._drag: _Drag | None = None
        self._range_mm = (0.0, LEAST_HIGH_MM)
        self._pointer_px: QPointF | None = None
        self._grab_px = GRAB_PX
        self.setMouseTracking(True)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setMinimumSize(220, 64)
        self.setAccessibleName(tr("Height of the rim along the edge"))

    def sizeHint(self) -> QSize:
        """Return a wide and low size."""
        return QSize(560, 140)

    def show_sentence(self, sentence: str) -> None:
        """Show a sentence instead of a graph."""
        self._graph, self._drag, self._sentence = None, None, sentence
        self.setAccessibleDescription(sentence)
        self.update()

    def show_graph(self, graph: RimGraph, selected: int | None) -> None:
        """Show a graph with one station selected; the scale stays during a drag."""
        self._graph, self._selected = graph, selected
        if self._drag is None:
            self._range_mm = _range_of(graph)
        self.setAccessibleDescription("" if selected is None else graph.describe(selected))
        self.update()

    def set_touch(self, touch: bool) -> None:
        """Set the size at which stations are grabbed, for touch or for a mouse."""
        self._grab_px = TOUCH_GRAB_PX if touch else GRAB_PX

    def pixel_of(self, s_mm: float, height_mm: float) -> QPointF:
        """Return where a place of the graph is painted."""
        return self._mm2px().map(QPointF(s_mm, height_mm))

    def station_at(self, place_px: QPointF) -> int | None:
        """Return the nearest station within the reach of the pointer."""
        graph = self._graph
        if graph is None or not graph.stations:
            return None
        gaps = [(self._station_px(i) - place_px).toTuple() for i in range(len(graph.stations))]
        distances = [float(np.hypot(*gap)) for gap in gaps]
        nearest = int(np.argmin(distances))
        return nearest if distances[nearest] <= self._grab_px else None

    def paintEvent(self, _event: QPaintEvent) -> None:
        """Draw grid, flank, rim, stations and the height at the pointer."""
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        if self._graph is None:
            flags = Qt.AlignmentFlag.AlignCenter | Qt.TextFlag.TextWordWrap
            painter.setPen(self.palette().placeholderText().color())
            painter.drawText(self.rect().adjusted(16, 0, -16, 0), flags, self._sentence)
        else:
            mm2px = self._mm2px()
            self._paint_grid(painter, self._graph, mm2px)
            self._paint_flank(painter, self._graph, mm2px)
            self._paint_rim(painter, self._graph, mm2px)
            self._paint_cut_off(painter, self._graph, mm2px)
            self._paint_pointer(painter, self._graph, mm2px)
            self._paint_stations(painter, self._graph)
            self._paint_legend(painter)
        if self.hasFocus():
            painter.setPen(QPen(self.palette().highlight().color(), 2))
            painter.setBrush(Qt.BrushStyle.NoBrush)
            painter.drawRect(self.rect().adjusted(1, 1, -1, -1))
        painter.end()

    def mousePressEvent(self, event: QMouseEvent) -> None:
        """Select the station under the pointer and hold it."""
        if event.button() is not Qt.MouseButton.LeftButton or self._graph is None:
            super().mousePressEvent(event)
            return
        number = self.station_at(event.position())
        self.chosen.emit(-1 if number is None else number)
        if number is not None:
            self._drag = _Drag(number, event.position(), self._station_px(number))
            self.grabbed.emit(number)

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        """Drag the station that is held, or show the height under the pointer."""
        self._pointer_px = event.position()
        if self._drag is not None:
            way = event.position() - self._drag.pressed_px
            if abs(way.x()) < ALONG_PX:
                way.setX(0.0)
            place = self._px2mm().map(self._drag.start_px + way)
            self.dragged.emit(place.x(), place.y())
        over = self._drag is not None or self.station_at(event.position()) is not None
        self.setCursor(Qt.CursorShape.SizeAllCursor if over else Qt.CursorShape.ArrowCursor)
        self.update()

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        """Let the station go."""
        if event.button() is Qt.MouseButton.LeftButton and self._drag is not None:
            self._drag = None
            self.released.emit()

    def mouseDoubleClickEvent(self, event: QMouseEvent) -> None:
        """Add a station on the rim, except where one stands."""
        if self._graph is not None and self.station_at(event.position()) is None:
            self.added.emit(self._px2mm().map(event.position()).x())

    def leaveEvent(self, _event: QEvent) -> None:
        """Hide the height at the pointer."""
        self._pointer_px = None
        self.update()

    def focusInEvent(self, event: QFocusEvent) -> None:
        """Show the frame of the panel that has the keys."""
        super().focusInEvent(event)
        self.update()

    def focusOutEvent(self, event: QFocusEvent) -> None:
        """Hide that frame."""
        super().focusOutEvent(event)
        self.update()

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Choose a station by the Page keys, move it by the arrows; Insert adds, Delete removes."""
        act = _KEYS.get(Qt.Key(event.key()))
        if self._graph is None or act is None or not act(self, event.modifiers()):
            super().keyPressEvent(event)

    def event(self, event: QEvent) -> bool:
        """Take Delete before the window does, and explain what is under the pointer."""
        is_override = event.type() == QEvent.Type.ShortcutOverride
        if is_override and isinstance(event, QKeyEvent) and self._is_removal(event):
            event.accept()
            return True
        if isinstance(event, QHelpEvent) and event.type() == QEvent.Type.ToolTip:
            QToolTip.showText(event.globalPos(), self._tip(QPointF(event.pos())), self)
            return True
        return super().event(event)

    def _is_removal(self, event: QKeyEvent) -> bool:
        return event.key() == Qt.Key.Key_Delete and self._selected is not None

    def contextMenuEvent(self, event: QContextMenuEvent) -> None:
        """Offer what a double click and the Delete key do."""
        if self._graph is None:
            return
        place = self._menu_place(event)
        number = self.station_at(place)
        menu = QMenu(self)
        if number is None:
            s_mm = self._px2mm().map(place).x()
            menu.addAction(tr("Add a station here")).triggered.connect(
                lambda: self.added.emit(s_mm)
            )
        else:
            menu.addAction(tr("Remove this station")).triggered.connect(
                lambda: self.removed.emit(number)
            )
        menu.exec(event.globalPos())
        menu.deleteLater()

    def _menu_place(self, event: QContextMenuEvent) -> QPointF:
        """Return where the menu is asked for: by the keyboard, at the selected station."""
        is_by_key = event.reason() is QContextMenuEvent.Reason.Keyboard
        if is_by_key and self._selected is not None:
            return self._station_px(self._selected)
        return QPointF(event.pos())

    def _choose(self, step: int) -> bool:
        """Select the next station along the edge."""
        assert self._graph is not None
        order = sorted(range(len(self._graph.stations)), key=self._s_of)
        if not order:
            return False
        at = order.index(self._selected) if self._selected in order else (-1 if step > 0 else 0)
        self.chosen.emit(order[(at + step) % len(order)])
        return True

    def _nudge(self, right: int, up: int, modifiers: Qt.KeyboardModifier) -> bool:
        if self._selected is None:
            return self._choose(1)
        step = NUDGE_MM
        if modifiers & Qt.KeyboardModifier.ShiftModifier:
            step *= COARSE
        elif modifiers & Qt.KeyboardModifier.ControlModifier:
            step *= FINE
        self.nudged.emit(self._selected, right * step, up * step)
        return True

    def _insert(self) -> bool:
        """Add a station midway between the selected one and the next."""
        assert self._graph is not None
        if self._selected is None:
            return False
        s, whole = self._s_of(self._selected), float(self._graph.s_mm[-1])
        after = [self._s_of(i) for i in range(len(self._graph.stations)) if self._s_of(i) > s]
        self.added.emit((s + min(after, default=whole)) / 2)
        return True

    def _remove(self) -> bool:
        if self._selected is None:
            return False
        self.removed.emit(self._selected)
        return True

    def _escape(self) -> bool:
        """Put a station that is held back; else leave the key to the window."""
        if self._drag is None:
            return False
        self._drag = None
        self.cancelled.emit()
        return True

    def _s_of(self, number: int) -> float:
        assert self._graph is not None
        return self._graph.stations[number].s_mm

    def _station_px(self, number: int) -> QPointF:
        assert self._graph is not None
        station = self._graph.stations[number]
        return self.pixel_of(station.s_mm, station.height_mm)

    def _frame(self) -> QRectF:
        return QRectF(self.rect()).adjusted(LEFT_PX, TOP_PX, -RIGHT_PX, -BOTTOM_PX)

    def _mm2px(self) -> QTransform:
        """Return the transform from mm to pixels; the height has a scale of its own."""
        assert self._graph is not None
        frame, (low, high) = self._frame(), self._range_mm
        wide = max(float(self._graph.s_mm[-1]), 1.0)
        mm2px = QTransform.fromTranslate(frame.left(), frame.bottom())
        mm2px.scale(frame.width() / wide, -frame.height() / (high - low))
        return mm2px.translate(0.0, -low)

    def _px2mm(self) -> QTransform:
        return self._mm2px().inverted()[0]

    def _tip(self, place_px: QPointF) -> str:
        number = self.station_at(place_px)
        if self._graph is None:
            return ""
        if number is not None:
            return self._graph.describe(number)
        return tr("Drag a station to shape the rim; double click adds one, Delete removes it")

    def _paint_grid(self, painter: QPainter, graph: RimGraph, mm2px: QTransform) -> None:
        frame, text = self._frame(), self.palette().windowText().color()
        strong, faint = QColor(text), QColor(text)
        strong.setAlpha(110)
        faint.setAlpha(40)
        line = QPen(strong, 1)
        for z in chart_ticks(*self._range_mm, -mm2px.m22(), 18.0):
            y = mm2px.map(QPointF(0.0, z)).y()
            painter.setPen(line if z == 0 else QPen(faint, 1))
            painter.drawLine(QPointF(frame.left(), y), QPointF(frame.right(), y))
            painter.setPen(text)
            words = QRectF(0, y - 9, LEFT_PX - 7, 18)
            end = Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter
            painter.drawText(words, end, localised(z, "g"))
        for number, zone in enumerate(graph.zones):
            left, right = (mm2px.map(QPointF(s, 0.0)).x() for s in (zone.start_mm, zone.end_mm))
            if number:
                painter.setPen(line)
                painter.drawLine(QPointF(left, frame.top()), QPointF(left, frame.bottom() + 6))
            painter.setPen(text)
            words = QRectF(left, frame.bottom() + 3, right - left, BOTTOM_PX - 3)
            painter.drawText(words, Qt.AlignmentFlag.AlignCenter, zone.name)
        painter.setPen(line)
        painter.drawLine(frame.bottomLeft(), frame.bottomRight())
        painter.drawLine(frame.bottomLeft(), frame.topLeft())

    def _paint_flank(self, painter: QPainter, graph: RimGraph, mm2px: QTransform) -> None:
        """Fill what the foot itself offers as a wall."""
        known = np.flatnonzero(np.isfinite(graph.flank_mm))
        pieces = np.split(known, np.flatnonzero(np.diff(known) > 1) + 1) if len(known) else []
        skin = QColor(SKIN)
        fill = QColor(SKIN)
        fill.setAlpha(38)
        painter.save()
        painter.setClipRect(self._frame())
        for piece in pieces:
            edge = mm2px.map(_line(graph.s_mm[piece], graph.flank_mm[piece]))
            floor, box = self._frame().bottom() + 2, edge.boundingRect()
            around = QPolygonF(edge)
            around.append(QPointF(box.right(), floor))
            around.append(QPointF(box.left(), floor))
            painter.setPen(Qt.PenStyle.NoPen)
            painter.setBrush(fill)
            painter.drawPolygon(around)
            painter.setPen(QPen(skin, 1.2))
            painter.drawPolyline(edge)
        painter.restore()

    def _paint_rim(self, painter: QPainter, graph: RimGraph, mm2px: QTransform) -> None:
        painter.save()
        painter.setClipRect(self._frame().adjusted(0, -2, 0, 2))
        painter.setPen(QPen(self.palette().highlight().color(), 2))
        painter.drawPolyline(mm2px.map(_line(graph.s_mm, graph.rim_mm)))
        painter.restore()

    def _paint_cut_off(self, painter: QPainter, graph: RimGraph, mm2px: QTransform) -> None:
        """Veil what lies ahead of a short insole's front edge."""
        veil = QColor(self.palette().window().color())
        veil.setAlpha(190)
        frame = self._frame()
        for start, end in graph.cut_off:
            left, right = (mm2px.map(QPointF(s, 0.0)).x() for s in (start, end))
            painter.fillRect(QRectF(left, frame.top(), right - left, frame.height()), veil)

    def _paint_stations(self, painter: QPainter, graph: RimGraph) -> None:
        accent, base = self.palette().highlight().color(), self.palette().base().color()
        for number in range(len(graph.stations)):
            is_selected = number == self._selected
            painter.setPen(QPen(accent, 2))
            painter.setBrush(accent if is_selected else base)
            radius = SELECTED_PX if is_selected else STATION_PX
            painter.drawEllipse(self._station_px(number), radius, radius)
        if self._selected is not None:
            self._paint_value(painter, graph.stations[self._selected], self._selected)

    def _paint_value(self, painter: QPainter, station: ChartStation, number: int) -> None:
        """Write the height of the selected station beside it, inside the frame."""
        text, at = f"{localised(station.height_mm)} mm", self._station_px(number)
        frame = self._frame()
        wide = painter.fontMetrics().horizontalAdvance(text) + 8
        left = at.x() + 10 if at.x() + 10 + wide < frame.right() else at.x() - 10 - wide
        top = min(max(at.y() - 20, frame.top()), frame.bottom() - 18)
        box = QRectF(left, top, wide, 18)
        ground = self.palette().base().color()
        ground.setAlpha(225)
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(ground)
        painter.drawRoundedRect(box, 3, 3)
        painter.setPen(self.palette().windowText().color())
        painter.drawText(box, Qt.AlignmentFlag.AlignCenter, text)

    def _paint_pointer(self, painter: QPainter, graph: RimGraph, mm2px: QTransform) -> None:
        """Show the height of the rim under the pointer."""
        frame, at = self._frame(), self._pointer_px
        if at is None or self._drag is not None or not frame.contains(at):
            return
        if self.station_at(at) is not None:
            return
        s = mm2px.inverted()[0].map(at).x()
        height = float(np.interp(s, graph.s_mm, graph.rim_mm))
        on_rim = mm2px.map(QPointF(s, height))
        painter.setPen(QPen(self.palette().windowText().color(), 1, Qt.PenStyle.DashLine))
        painter.drawLine(QPointF(at.x(), frame.bottom()), on_rim)
        text = f"{localised(height)} mm"
        wide = painter.fontMetrics().horizontalAdvance(text)
        left = min(on_rim.x() + 6, frame.right() - wide)
        painter.drawText(QPointF(left, max(on_rim.y() - 6, frame.top() + 10)), text)

    @property
    def legend(self) -> list[tuple[str, QRectF]]:
        """The names of the curves and what the numbers are, and the place of each above the chart.

        What has no room ends in "…".
        """
        frame, metrics = self._frame(), self.fontMetrics()
        x, end = frame.left() + 4, frame.right()
        written: list[tuple[str, QRectF]] = []
        for name in (tr("Rim"), tr("Flank of the foot")):
            x += SWATCH_PX
            text = metrics.elidedText(name, Qt.TextElideMode.ElideRight, int(end - x) - 2)
            wide = metrics.horizontalAdvance(text) + 2
            written.append((text, QRectF(x, 0, wide, TOP_PX)))
            x += wide + GAP_PX
        unit = metrics.elidedText(
            tr("mm over the heel"), Qt.TextElideMode.ElideRight, max(int(end - x), 0)
        )
        wide = metrics.horizontalAdvance(unit)
        return [*written, (unit, QRectF(end - wide, 0, wide, TOP_PX))]

    def _paint_legend(self, painter: QPainter) -> None:
        *names, (unit, beside) = self.legend
        colors = self.palette().highlight().color(), QColor(SKIN)
        for (text, place), color in zip(names, colors, strict=True):
            painter.setPen(QPen(color, 2))
            line = QPointF(place.left() - SWATCH_PX, TOP_PX / 2)
            painter.drawLine(line, line + QPointF(14, 0))
            painter.setPen(self.palette().windowText().color())
            painter.drawText(place, Qt.AlignmentFlag.AlignCenter, text)
        painter.setPen(self.palette().placeholderText().color())
        painter.drawText(beside, Qt.AlignmentFlag.AlignCenter, unit)


def _line(s_mm: FloatArray, z_mm: FloatArray) -> QPolygonF:
    return QPolygonF([QPointF(s, z) for s, z in zip(s_mm.tolist(), z_mm.tolist(), strict=True)])


def _range_of(graph: RimGraph) -> tuple[float, float]:
    heights = [*(station.height_mm for station in graph.stations), *graph.rim_mm[[0]]]
    low = min(0.0, float(graph.rim_mm.min()), *heights)
    high = max(LEAST_HIGH_MM, float(graph.rim_mm.max()), *heights)
    flank = float(np.nanmax(graph.flank_mm, initial=high))
    return low - (1.0 if low < 0 else 0.0), min(flank + 1.0, high + ABOVE_FLANK_MM) + ABOVE_MM


_KEYS: dict[Qt.Key, Callable[[RimChart, Qt.KeyboardModifier], bool]] = {
    Qt.Key.Key_PageDown: lambda chart, _modifiers: chart._choose(1),
    Qt.Key.Key_PageUp: lambda chart, _modifiers: chart._choose(-1),
    Qt.Key.Key_Left: lambda chart, modifiers: chart._nudge(-1, 0, modifiers),
    Qt.Key.Key_Right: lambda chart, modifiers: chart._nudge(1, 0, modifiers),
    Qt.Key.Key_Up: lambda chart, modifiers: chart._nudge(0, 1, modifiers),
    Qt.Key.Key_Down: lambda chart, modifiers: chart._nudge(0, -1, modifiers),
    Qt.Key.Key_Insert: lambda chart, _modifiers: chart._insert(),
    Qt.Key.Key_Delete: lambda chart, _modifiers: chart._remove(),
    Qt.Key.Key_Escape: lambda chart, _modifiers: chart._escape(),
}
