"""A measure of both feet over the visits, as a plot."""

from __future__ import annotations

from collections.abc import Sequence
from datetime import date

from PySide6.QtCore import QPointF, QRectF, QSize, Qt
from PySide6.QtGui import QColor, QPainter, QPaintEvent, QPen
from PySide6.QtWidgets import QLabel, QVBoxLayout, QWidget

from insole_core.geometry.side import Side
from insole_studio.features.records.rows import Trend
from insole_studio.texts import localised, tr
from insole_studio.widgets.chart_ticks import chart_ticks
from insole_studio.widgets.form_parts import ComboBox
from insole_studio.widgets.side_switch import COLORS

LEFT_PX, RIGHT_PX, TOP_PX, BOTTOM_PX = 40.0, 12.0, 10.0, 20.0
DOT_PX = 3.0
LEAST_SPAN = 2.0
"""Of the values: a change of a tenth of a millimetre must not look like a fall."""
_BAR_PX = 4.0
"""Half of the width of the ends of an error bar."""


class TrendChart(QWidget):
    """A list of measures, and the plot of the chosen one: left red, right green."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.measures = ComboBox([])
        self.measures.setAccessibleName(tr("Measure over time"))
        self.measures.currentIndexChanged.connect(self._show_chosen)
        self.plot = _Plot()
        self.changes = {side: QLabel() for side in (None, *Side)}
        layout = QVBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.setSpacing(4)
        layout.addWidget(self.measures)
        layout.addWidget(self.plot)
        for label in self.changes.values():
            label.setToolTip(tr("From the first to the last visit; ±: 95 % limits of a change"))
            layout.addWidget(label)
        self._trends: tuple[Trend, ...] = ()

    def show_trends(self, trends: Sequence[Trend]) -> None:
        """Show other measures; the chosen one stays chosen."""
        if tuple(trends) == self._trends:
            return
        self._trends = tuple(trends)
        before = self.measures.currentData()
        names = list(dict.fromkeys(trend.name for trend in trends))
        self.measures.blockSignals(True)
        self.measures.clear()
        for name in names:
            self.measures.addItem(name, name)
        self.measures.setCurrentIndex(names.index(before) if before in names else 0)
        self.measures.blockSignals(False)
        self._show_chosen()

    def _show_chosen(self) -> None:
        name = self.measures.currentData()
        lines = [trend for trend in self._trends if trend.name == name]
        self.plot.show_lines(lines)
        shown = {trend.side: trend for trend in lines}
        for side, label in self.changes.items():
            label.setVisible(side in shown)
            if side in shown:
                label.setText(shown[side].change_text)
                label.setObjectName("quiet" if shown[side].is_within_error else "")
                label.style().polish(label)  # the style sheet depends on the name


class _Plot(QWidget):
    """Values over days, one line for each side."""

    def __init__(self) -> None:
        super().__init__()
        self._lines: list[Trend] = []
        self.setMinimumHeight(120)

    def sizeHint(self) -> QSize:
        """Return a low size."""
        return QSize(300, 140)

    def show_lines(self, lines: list[Trend]) -> None:
        """Show the lines of one measure."""
        self._lines = lines
        ends = (
            f"{line.side_text} {localised(line.values[0])} → {localised(line.values[-1])}, "
            f"{line.change_text}"
            for line in lines
        )
        self.setAccessibleDescription("; ".join(ends))
        self.update()

    def paintEvent(self, _event: QPaintEvent) -> None:
        """Draw the rulers, the lines and a dot for each visit."""
        if not self._lines:
            return
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        frame = QRectF(
            LEFT_PX,
            TOP_PX,
            self.width() - LEFT_PX - RIGHT_PX,
            self.height() - TOP_PX - BOTTOM_PX,
        )
        values = [end for line in self._lines for ends in _bars(line) for end in ends]
        days = [_number(day) for line in self._lines for day in line.days]
        middle, span = (min(values) + max(values)) / 2, max(max(values) - min(values), LEAST_SPAN)
        low, high = middle - 0.6 * span, middle + 0.6 * span
        first, last = min(days), max(days)

        def place(day: str, value: float) -> QPointF:
            share = 0.5 if last == first else (_number(day) - first) / (last - first)
            return QPointF(
                frame.left() + share * frame.width(),
                frame.bottom() - (value - low) / (high - low) * frame.height(),
            )

        self._draw_rulers(painter, frame, low, high)
        for line in self._lines:
            points = [place(day, value) for day, value in zip(line.days, line.values, strict=True)]
            color = QColor(COLORS[line.side]) if line.side else self.palette().text().color()
            painter.setPen(QPen(color, 1))
            for day, (least, most) in zip(line.days, _bars(line), strict=True):
                _draw_bar(painter, place(day, least), place(day, most))
            painter.setPen(QPen(color, 2))
            painter.drawPolyline(points)
            painter.setBrush(color)
            for point in points:
                painter.drawEllipse(point, DOT_PX, DOT_PX)
        painter.end()

    def _draw_rulers(self, painter: QPainter, frame: QRectF, low: float, high: float) -> None:
        quiet = self.palette().placeholderText().color()
        line = QColor(quiet)
        line.setAlpha(80)
        for tick in chart_ticks(low, high, frame.height() / (high - low)):
            y = frame.bottom() - (tick - low) / (high - low) * frame.height()
            painter.setPen(line)
            painter.drawLine(QPointF(frame.left(), y), QPointF(frame.right(), y))
            painter.setPen(quiet)
            box = QRectF(0, y - 8, LEFT_PX - 6, 16)
            painter.drawText(
                box,
                Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter,
                localised(tick, "g"),
            )
        below = QRectF(frame.left(), frame.bottom() + 4, frame.width(), 16)
        days = sorted(day for trend in self._lines for day in trend.days)
        painter.drawText(below, Qt.AlignmentFlag.AlignLeft, days[0])
        if days[-1] != days[0]:
            painter.drawText(below, Qt.AlignmentFlag.AlignRight, days[-1])


def _bars(line: Trend) -> list[tuple[float, float]]:
    """Return the least and the greatest value that each visit's may stand for."""
    limits = line.limits or (None,) * len(line.values)
    return [
        (value - (limit or 0.0), value + (limit or 0.0))
        for value, limit in zip(line.values, limits, strict=True)
    ]


def _draw_bar(painter: QPainter, low: QPointF, high: QPointF) -> None:
    if low == high:
        return
    painter.drawLine(low, high)
    for end in (low, high):
        painter.drawLine(end - QPointF(_BAR_PX, 0), end + QPointF(_BAR_PX, 0))


def _number(day: str) -> int:
    return date.fromisoformat(day).toordinal()
