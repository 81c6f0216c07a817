"""Pictures scaled to their widget, and one to draw on: lines by dragging, places by a click."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TypeAlias

from PySide6.QtCore import QPointF, QRect, QRectF, Qt, Signal
from PySide6.QtGui import QColor, QImage, QMouseEvent, QPainter, QPaintEvent, QPen, QPolygonF
from PySide6.QtWidgets import QSizePolicy, QWidget

from insole_core.geometry.arrays import ByteArray
from insole_core.records.photo import MOST_POINTS

Line: TypeAlias = tuple[tuple[float, float], ...]
"""Points across and down, as parts of width and height; one alone is a place."""
_COLOR, _CHOSEN = QColor("#ff5f00"), QColor("#1668b8")
_WIDTH_PX, _HALO_PX, _RADIUS_PX = 3, 5, 8
_LEAST_DRAG_PX, _LEAST_STEP_PX = 6, 2
_LEAST = (360, 300)
_MARGIN_PX = 24


class MarkedPicture(QWidget):
    """Shows a picture as large as it fits, with marks on it."""

    drawn = Signal(object)
    """Emitted with the `Line` that was drawn."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setMinimumSize(*_LEAST)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Expanding)
        self._image = QImage()
        self._marks: tuple[Line, ...] = ()
        self._chosen = -1
        self._drag: list[QPointF] = []
        self._is_editable = True

    def show_picture(self, image: QImage) -> None:
        """Show a picture; a null image for none."""
        self._image, self._drag = image, []
        is_drawable = self._is_editable and not image.isNull()
        self.setCursor(Qt.CursorShape.CrossCursor if is_drawable else Qt.CursorShape.ArrowCursor)
        self.update()

    def show_marks(self, marks: Sequence[Line], chosen: int) -> None:
        """Show marks, one of them chosen; -1 for none."""
        self._marks, self._chosen = tuple(marks), chosen
        self.update()

    def show_editable(self, editable: bool) -> None:
        """Show whether one can draw."""
        self._is_editable = editable
        self.show_picture(self._image)

    @property
    def picture_rect(self) -> QRectF:
        """Where the picture is, in pixels of the widget; empty without one."""
        if self._image.isNull():
            return QRectF()
        size = self._image.size().scaled(self.size(), Qt.AspectRatioMode.KeepAspectRatio)
        left, top = (self.width() - size.width()) / 2, (self.height() - size.height()) / 2
        return QRectF(left, top, size.width(), size.height())

    def mousePressEvent(self, event: QMouseEvent) -> None:
        """Begin a mark on the picture."""
        is_left = event.button() == Qt.MouseButton.LeftButton
        if is_left and self._is_editable and self.picture_rect.contains(event.position()):
            self._drag = [event.position()]

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        """Go on with a line; it does not leave the picture."""
        if self._drag:
            rect = self.picture_rect
            x = min(max(event.position().x(), rect.left()), rect.right())
            y = min(max(event.position().y(), rect.top()), rect.bottom())
            step = QPointF(x, y) - self._drag[-1]
            if math.hypot(step.x(), step.y()) >= _LEAST_STEP_PX:
                self._drag.append(QPointF(x, y))
                piece = QPolygonF(self._drag[-2:]).boundingRect().toAlignedRect()
                self.update(piece.adjusted(-_RADIUS_PX, -_RADIUS_PX, _RADIUS_PX, _RADIUS_PX))

    def mouseReleaseEvent(self, _event: QMouseEvent) -> None:
        """End the mark: a line that was hardly drawn is a place."""
        dragged, self._drag = self._drag, []
        if not dragged:
            return
        first = dragged[0]
        is_line = any((p - first).manhattanLength() >= _LEAST_DRAG_PX for p in dragged)
        self.drawn.emit(self._parts(dragged if is_line else dragged[:1]))

    def paintEvent(self, _event: QPaintEvent) -> None:
        """Draw the picture, its marks, and what is being drawn."""
        painter = QPainter(self)
        painter.setRenderHints(
            QPainter.RenderHint.Antialiasing | QPainter.RenderHint.SmoothPixmapTransform
        )
        rect = self.picture_rect
        if rect.isEmpty():
            return
        painter.drawImage(rect, self._image)
        for number, mark in enumerate(self._marks):
            points = [QPointF(rect.x() + x * rect.width(), rect.y() + y * rect.height())
                      for x, y in mark]  # fmt: skip
            color = _CHOSEN if number == self._chosen else _COLOR
            _draw_mark(painter, points, color, str(number + 1))
        if self._drag:
            _draw_mark(painter, self._drag, _CHOSEN, "")

    def _parts(self, points: Sequence[QPointF]) -> Line:
        rect = self.picture_rect
        most = min(len(points), MOST_POINTS)
        ends = max(most - 1, 1)  # a long line keeps both ends, and as many points as are stored
        points = [points[n * (len(points) - 1) // ends] for n in range(most)]
        return tuple(
            ((p.x() - rect.x()) / rect.width(), (p.y() - rect.y()) / rect.height()) for p in points
        )


def _draw_mark(painter: QPainter, points: Sequence[QPointF], color: QColor, text: str) -> None:
    """Draw a line or a circle with a light edge, so that it stands out from any ground."""
    for pen_color, width in ((QColor(255, 255, 255, 200), _HALO_PX), (color, _WIDTH_PX)):
        pen = QPen(pen_color, width)
        pen.setCapStyle(Qt.PenCapStyle.RoundCap)
        pen.setJoinStyle(Qt.PenJoinStyle.RoundJoin)
        painter.setPen(pen)
        painter.setBrush(Qt.BrushStyle.NoBrush)
        if len(points) > 1:
            painter.drawPolyline(QPolygonF(list(points)))
        else:
            painter.drawEllipse(points[0], _RADIUS_PX, _RADIUS_PX)
    if text:
        height = painter.fontMetrics().height()
        width = max(painter.fontMetrics().horizontalAdvance(text) + 8, height)
        label = QRectF(points[0].x() + _RADIUS_PX + 2, points[0].y() - height / 2, width, height)
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(color)
        painter.drawRoundedRect(label, 4, 4)
        painter.setPen(QColor("white"))
        painter.drawText(label, Qt.AlignmentFlag.AlignCenter, text)


class PictureView(QWidget):
    """An image scaled to the widget with its aspect ratio kept; a sentence if there is none."""

    clicked = Signal(float, float)
    """Emitted with column and row of the image, px, at which the user has clicked."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._image, self._sentence = QImage(), ""
        self.setMinimumSize(160, 120)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Expanding)

    def show_picture(self, picture: ByteArray) -> None:
        """Show an image, (height, width, 3) uint8, RGB."""
        height, width = picture.shape[:2]
        packed = picture.tobytes()
        self._image = QImage(packed, width, height, 3 * width, QImage.Format.Format_RGB888).copy()
        self.update()

    def show_sentence(self, sentence: str) -> None:
        """Show a sentence instead of the image."""
        self._image, self._sentence = QImage(), sentence
        self.setAccessibleName(sentence)
        self.update()

    def mousePressEvent(self, event: QMouseEvent) -> None:
        """Tell which place of the image was clicked."""
        place = self._place()
        if event.button() != Qt.MouseButton.LeftButton or place.isEmpty():
            return
        share_x = (event.position().x() - place.left()) / place.width()
        share_y = (event.position().y() - place.top()) / place.height()
        if 0 <= share_x < 1 and 0 <= share_y < 1:
            self.clicked.emit(share_x * self._image.width(), share_y * self._image.height())

    def _place(self) -> QRect:
        """Return where the image is drawn; empty without one."""
        size = self._image.size().scaled(self.size(), Qt.AspectRatioMode.KeepAspectRatio)
        place = self.rect()
        place.setSize(size)
        place.moveCenter(self.rect().center())
        return place

    def paintEvent(self, _event: QPaintEvent) -> None:
        """Draw the image centred."""
        painter = QPainter(self)
        painter.fillRect(self.rect(), self.palette().alternateBase())
        if not self._image.isNull():
            painter.setRenderHint(QPainter.RenderHint.SmoothPixmapTransform)
            painter.drawImage(self._place(), self._image)
        else:
            inside = self.rect().adjusted(_MARGIN_PX, _MARGIN_PX, -_MARGIN_PX, -_MARGIN_PX)
            painter.setPen(self.palette().placeholderText().color())
            middle = Qt.AlignmentFlag.AlignCenter | Qt.TextFlag.TextWordWrap
            painter.drawText(inside, middle, self._sentence)
        painter.end()
