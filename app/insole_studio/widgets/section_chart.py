"""A section through the insole, true to scale, with rulers in mm."""

from __future__ import annotations

import numpy as np
from PySide6.QtCore import QEvent, QLineF, QPointF, QRectF, QSize, Qt
from PySide6.QtGui import QColor, QMouseEvent, QPainter, QPaintEvent, QPen, QPolygonF, QTransform
from PySide6.QtWidgets import QWidget

from insole_core.geometry.arrays import FloatArray
from insole_studio.texts import localised
from insole_studio.widgets.chart_ticks import chart_ticks

LEFT_PX, BOTTOM_PX, FREE_PX = 40.0, 22.0, 12.0
ABOVE_MM = 22.0
"""Height of the foot shown above the insole."""


class SectionChart(QWidget):
    """The insole as a filled area and the skin as a line; the pointer measures the thickness."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._sentence = ""
        self._top: FloatArray | None = None
        self._bottom = self._skin = np.empty((0, 2))
        self._ends = ("", "")
        self._pointer_px: float | None = None
        self.setMouseTracking(True)
        self.setMinimumSize(260, 112)

    def sizeHint(self) -> QSize:
        """Return a wide and low size."""
        return QSize(420, 132)

    def show_sentence(self, sentence: str) -> None:
        """Show a sentence instead of a section."""
        self._top, self._sentence = None, sentence
        self.update()

    def show_cut(
        self, top: FloatArray, bottom: FloatArray, skin: FloatArray, ends: tuple[str, str]
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
        """
        self._top, self._bottom, self._skin, self._ends = top, bottom, skin, ends
        self.update()

    def thickness_mm(self, s_mm: float) -> float | None:
        """Return the thickness of the insole at an abscissa; None outside it."""
        if self._top is None or not self._top[0, 0] <= s_mm <= self._top[-1, 0]:
            return None
        top = np.interp(s_mm, self._top[:, 0], self._top[:, 1])
        return float(top - np.interp(s_mm, self._bottom[:, 0], self._bottom[:, 1]))

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
        return QRectF(self.rect()).adjusted(LEFT_PX, FREE_PX, -FREE_PX, -BOTTOM_PX)

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
        body = QPolygonF([QPointF(*point) for point in around])
        accent = self.palette().highlight().color()
        fill = QColor(accent)
        fill.setAlpha(56)
        painter.setBrush(fill)
        painter.setPen(QPen(accent, 1.5))
        painter.drawPolygon(mm2px.map(body))
        painter.setPen(QPen(QColor("#c4684a"), 1.5))
        painter.drawLines([mm2px.map(QLineF(*a, *b)) for a, b in self._skin])

    def _paint_rulers(self, painter: QPainter, mm2px: QTransform, frame: QRectF) -> None:
        painter.setPen(QPen(self.palette().mid().color(), 1))
        painter.drawLine(frame.bottomLeft(), frame.bottomRight())
        painter.drawLine(frame.bottomLeft(), frame.topLeft())
        painter.setPen(self.palette().windowText().color())
        shown = mm2px.inverted()[0].mapRect(frame)
        for s in chart_ticks(shown.left(), shown.right(), mm2px.m11()):
            at = mm2px.map(QPointF(s, shown.top()))
            painter.drawLine(at, at + QPointF(0, 4))
            words = QRectF(at.x() - 30, at.y() + 4, 60, BOTTOM_PX - 4)
            painter.drawText(words, Qt.AlignmentFlag.AlignCenter, localised(s, "g"))
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

    def _paint_measured(self, painter: QPainter, mm2px: QTransform) -> None:
        if self._pointer_px is None or self._top is None:
            return
        s = mm2px.inverted()[0].map(QPointF(self._pointer_px, 0.0)).x()
        thickness = self.thickness_mm(s)
        if thickness is None:
            return
        z = float(np.interp(s, self._top[:, 0], self._top[:, 1]))
        painter.setPen(QPen(self.palette().windowText().color(), 1, Qt.PenStyle.DashLine))
        at = mm2px.map(QPointF(s, z))
        painter.drawLine(mm2px.map(QPointF(s, z - thickness)), at)
        painter.drawText(at + QPointF(6, -6), f"{localised(thickness)} mm")
