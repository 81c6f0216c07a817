"""A section through the insole, true to scale, with rulers in mm."""

from __future__ import annotations

import numpy as np
from PySide6.QtCore import QEvent, QLineF, QPointF, QRectF, QSize, Qt
from PySide6.QtGui import QColor, QMouseEvent, QPainter, QPaintEvent, QPen, QPolygonF, QTransform
from PySide6.QtWidgets import QWidget

from insole_core.geometry.arrays import FloatArray
from insole_studio.texts import localised, tr
from insole_studio.widgets.chart_ticks import chart_ticks

LEFT_PX, BOTTOM_PX, FREE_PX = 40.0, 22.0, 12.0
LEGEND_PX, SWATCH_PX, LEGEND_GAP_PX = 18.0, 21.0, 11.0
SKIN, COVER = "#c4684a", "#2e8b67"
ABOVE_MM = 22.0
"""Height of the foot shown above the insole."""


class SectionChart(QWidget):
    """The insole as a filled area, and lines for skin and cover; a legend with their heights.

    The heights are those at the pointer over the chart, else those at a place that is told.
    """

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._sentence = ""
        self._top: FloatArray | None = None
        self._bottom = self._skin = np.empty((0, 2))
        self._cover: FloatArray | None = None
        self._at_mm: float | None = None
        self._ends = ("", "")
        self._pointer_px: float | None = None
        self.setMouseTracking(True)
        self.setMinimumSize(220, 64)

    def sizeHint(self) -> QSize:
        """Return a wide and low size."""
        return QSize(420, 132)

    def show_sentence(self, sentence: str) -> None:
        """Show a sentence instead of a section."""
        self._top, self._sentence = None, sentence
        self.update()

    def show_cut(
        self,
        top: FloatArray,
        bottom: FloatArray,
        skin: FloatArray,
        ends: tuple[str, str],
        *,
        cover: FloatArray | None = None,
        at_mm: float | None = None,
    ) -> None:
        """Show a section.

        Parameters
        ----------
        top, bottom : (n, 2) mm
            Surface of the insole; each pair of points has the same abscissa.
        skin : (k, 2, 2) mm
            Line segments of the foot.
        ends
            Anatomical directions at the left and at the right.
        cover : (n, 2) mm, optional
            Lower side of the cover.
        at_mm
            Abscissa at which to measure unless the pointer is over the chart.
        """
        self._top, self._bottom, self._skin, self._ends = top, bottom, skin, ends
        self._cover, self._at_mm = cover, at_mm
        self.update()

    def thickness_mm(self, s_mm: float) -> float | None:
        """Return the thickness of the insole at an abscissa; None outside it."""
        if self._top is None or not self._top[0, 0] <= s_mm <= self._top[-1, 0]:
            return None
        top = np.interp(s_mm, self._top[:, 0], self._top[:, 1])
        return float(top - np.interp(s_mm, self._bottom[:, 0], self._bottom[:, 1]))

    def skin_mm(self, s_mm: float) -> float | None:
        """Return the height of the sole at an abscissa; None where there is no skin."""
        start, end = np.moveaxis(self._skin, 1, 0) if len(self._skin) else np.zeros((2, 0, 2))
        low, high = np.minimum(start[:, 0], end[:, 0]), np.maximum(start[:, 0], end[:, 0])
        over = (low <= s_mm) & (s_mm <= high) & (high > low)
        if not over.any():
            return None
        start, end = start[over], end[over]
        share = (s_mm - start[:, 0]) / (end[:, 0] - start[:, 0])
        return float((start[:, 1] + share * (end[:, 1] - start[:, 1])).min())

    @property
    def measured_mm(self) -> float | None:
        """The abscissa at which the chart measures; None for none."""
        if self._pointer_px is None or self._top is None:
            return self._at_mm
        mm2px = self._mm2px(self._frame())
        return float(mm2px.inverted()[0].map(QPointF(self._pointer_px, 0.0)).x())

    def legend(self) -> list[tuple[str, str]]:
        """Return name and height, as text, of each curve; empty heights where nothing is."""
        if self._top is None:
            return []
        s_mm = self.measured_mm
        inside = s_mm is not None and self.thickness_mm(s_mm) is not None
        heights = [
            (tr("Foot"), None if s_mm is None else self.skin_mm(s_mm)),
            (tr("Contact surface"), _height(self._top, s_mm if inside else None)),
            (tr("Cover"), _height(self._cover, s_mm if inside else None)),
            (tr("Underside"), _height(self._bottom, s_mm if inside else None)),
        ]
        if self._cover is None:
            del heights[2]
        return [(name, "" if mm is None else localised(mm)) for name, mm in heights]

    def paintEvent(self, _event: QPaintEvent) -> None:
        """Draw the insole, the skin, the rulers and the measured thickness."""
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        if self._top is None:
            flags = Qt.AlignmentFlag.AlignCenter | Qt.TextFlag.TextWordWrap
            painter.setPen(self.palette().placeholderText().color())
            painter.drawText(self.rect().adjusted(16, 0, -16, 0), flags, self._sentence)
        else:
            frame = self._frame()
            mm2px = self._mm2px(frame)
            self._paint_rulers(painter, mm2px, frame)
            painter.setClipRect(frame)
            self._paint_cut(painter, mm2px)
            self._paint_measured(painter, mm2px)
            painter.setClipping(False)
            self._paint_legend(painter)
        painter.end()

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        """Measure the thickness under the pointer."""
        self._pointer_px = event.position().x()
        self.update()

    def leaveEvent(self, _event: QEvent) -> None:
        """Hide the measurement."""
        self._pointer_px = None
        self.update()

    def _frame(self) -> QRectF:
        return QRectF(self.rect()).adjusted(LEFT_PX, LEGEND_PX + 6, -FREE_PX, -BOTTOM_PX)

    def _mm2px(self, frame: QRectF) -> QTransform:
        """Return the transform from mm to pixels, with the same scale in both directions."""
        assert self._top is not None
        low_s, high_s = self._top[0, 0], self._top[-1, 0]
        high_z = float(self._top[:, 1].max()) + ABOVE_MM / 2
        wide = max(high_s - low_s, 1.0) + 4.0
        px_per_mm = min(frame.width() / wide, frame.height() / (high_z + 1.0))
        mm2px = QTransform.fromTranslate(frame.center().x(), frame.bottom())
        mm2px.scale(px_per_mm, -px_per_mm)
        return mm2px.translate(-(low_s + high_s) / 2, 1.0)

    def _paint_cut(self, painter: QPainter, mm2px: QTransform) -> None:
        assert self._top is not None
        around = np.concatenate([self._top, self._bottom[::-1]])
        body = _polygon(around)
        accent = self.palette().highlight().color()
        fill = QColor(accent)
        fill.setAlpha(56)
        painter.setBrush(fill)
        painter.setPen(Qt.PenStyle.NoPen)
        painter.drawPolygon(mm2px.map(body))
        for line, style in (
            (self._top, Qt.PenStyle.SolidLine),
            (self._bottom, Qt.PenStyle.DotLine),
        ):
            painter.setPen(QPen(accent, 1.5, style))
            painter.drawPolyline(mm2px.map(QPolygonF([QPointF(*point) for point in line])))
        painter.setPen(QPen(QColor(SKIN), 1.5))
        painter.drawLines([mm2px.map(QLineF(*a, *b)) for a, b in self._skin])
        if self._cover is not None:
            painter.setPen(QPen(QColor(COVER), 1.5, Qt.PenStyle.DashLine))
            painter.drawPolyline(mm2px.map(_polygon(self._cover)))

    def _paint_rulers(self, painter: QPainter, mm2px: QTransform, frame: QRectF) -> None:
        painter.setPen(QPen(self.palette().mid().color(), 1))
        painter.drawLine(frame.bottomLeft(), frame.bottomRight())
        painter.drawLine(frame.bottomLeft(), frame.topLeft())
        painter.setPen(self.palette().windowText().color())
        shown = mm2px.inverted()[0].mapRect(frame)
        for s in chart_ticks(shown.left(), shown.right(), mm2px.m11()):
            at = mm2px.map(QPointF(s, shown.top()))
            painter.drawLine(at, at + QPointF(0, 4))
        for words, text in self.ruler_words():
            painter.drawText(words, Qt.AlignmentFlag.AlignCenter, text)
        for z in chart_ticks(shown.top(), shown.bottom(), mm2px.m11(), 18.0):
            at = mm2px.map(QPointF(shown.left(), z))
            painter.drawLine(at, at - QPointF(4, 0))
            words = QRectF(0, at.y() - 9, LEFT_PX - 7, 18)
            end = Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter
            painter.drawText(words, end, localised(z, "g"))
        painter.setPen(self.palette().placeholderText().color())
        top = QRectF(frame.left() + 6, frame.top() - 4, frame.width() - 12, 18)
        painter.drawText(top, Qt.AlignmentFlag.AlignLeft, self._ends[0])
        painter.drawText(top, Qt.AlignmentFlag.AlignRight, self._ends[1])

    def ruler_words(self) -> list[tuple[QRectF, str]]:
        """Return the unit and the numbers of the ruler below, and where each has room for itself.

        A number that would touch the unit or the one before is left out.
        """
        frame = self._frame()
        mm2px = self._mm2px(frame)
        top, high = frame.bottom() + 4, BOTTOM_PX - 4
        shown = mm2px.inverted()[0].mapRect(frame)
        numbers = [
            (s, localised(s, "g")) for s in chart_ticks(shown.left(), shown.right(), mm2px.m11())
        ]
        unit_px = self._width_of("mm")
        words = [(QRectF(self.width() - 2 - unit_px, top, unit_px, high), "mm")]
        for s, text in numbers:
            wide = self._width_of(text)
            place = QRectF(mm2px.map(QPointF(s, 0.0)).x() - wide / 2, top, wide, high)
            if not any(place.adjusted(-3, 0, 3, 0).intersects(taken) for taken, _ in words):
                words.append((place, text))
        return words

    def _width_of(self, text: str) -> float:
        return self.fontMetrics().horizontalAdvance(text) + 1.0

    def _paint_measured(self, painter: QPainter, mm2px: QTransform) -> None:
        """Draw a line from the underside to the contact surface where the chart measures."""
        s_mm = self.measured_mm
        thickness = None if s_mm is None else self.thickness_mm(s_mm)
        if s_mm is None or thickness is None or self._top is None:
            return
        z = float(np.interp(s_mm, self._top[:, 0], self._top[:, 1]))
        painter.setPen(QPen(self.palette().windowText().color(), 1, Qt.PenStyle.DashLine))
        at = mm2px.map(QPointF(s_mm, z))
        painter.drawLine(mm2px.map(QPointF(s_mm, z - thickness)), at)
        painter.drawText(at + QPointF(6, -6), f"{localised(thickness)} mm")

    def _paint_legend(self, painter: QPainter) -> None:
        """Write names and heights of the curves above the chart, as many as there is room for."""
        styles, left, middle = self._styles(), LEGEND_GAP_PX, LEGEND_PX / 2
        for name, value in self.legend():
            text = f"{name} {value}".rstrip()
            wide = self.fontMetrics().horizontalAdvance(text)
            if left + SWATCH_PX + wide > self.width():
                return
            painter.setPen(styles[name])
            painter.drawLine(QPointF(left, middle), QPointF(left + SWATCH_PX - 5, middle))
            painter.setPen(self.palette().windowText().color())
            words = QRectF(left + SWATCH_PX, 0, wide + 1, LEGEND_PX)
            painter.drawText(words, Qt.AlignmentFlag.AlignVCenter, text)
            left += SWATCH_PX + wide + LEGEND_GAP_PX

    def _styles(self) -> dict[str, QPen]:
        """Return the pens of the curves by their names."""
        accent = self.palette().highlight().color()
        return {
            tr("Foot"): QPen(QColor(SKIN), 2),
            tr("Contact surface"): QPen(accent, 2),
            tr("Cover"): QPen(QColor(COVER), 2, Qt.PenStyle.DashLine),
            tr("Underside"): QPen(accent, 2, Qt.PenStyle.DotLine),
        }


def _polygon(points: FloatArray) -> QPolygonF:
    return QPolygonF([QPointF(*point) for point in points])


def _height(line: FloatArray | None, s_mm: float | None) -> float | None:
    """Return the height of a line (n, 2) at an abscissa; None without one of them."""
    if line is None or s_mm is None:
        return None
    return float(np.interp(s_mm, line[:, 0], line[:, 1]))
