"""A view's colour image with its markers: detected, and projected by the pose."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from PySide6.QtCore import QPointF, QRectF, Qt, Signal
from PySide6.QtGui import (
    QColor,
    QImage,
    QKeyEvent,
    QMouseEvent,
    QPainter,
    QPainterPath,
    QPaintEvent,
    QPen,
    QPolygonF,
    QTransform,
    QWheelEvent,
)
from PySide6.QtWidgets import QSizePolicy, QWidget

from insole_core.geometry.arrays import ByteArray
from insole_core.recording.hand_edits import Pixel, Region
from insole_studio.features.foot.rows import Mark
from insole_studio.texts import localised, tr

ENLARGED = 100
"""Factor by which residuals are enlarged."""
LONGEST_PX = 60.0
GRAB_PX = 12.0
_DRAG_PX = 4.0
_ZOOM_PER_STEP = 1.2
_GREATEST_ZOOM = 24.0
_LEAST_CORNERS = 3
_MARGIN = 0.12
"""Margin around the markers, as a share of their extent."""
_SPOT_PX, _MARK_PX = 5.0, 9.0
_COLORS = {
    "used": QColor("#4ade80"),
    "unused": QColor("#ffb454"),
    "excluded": QColor("#b8bec4"),
    "spot": QColor("#b8bec4"),
}
_SELECTED, _RESIDUAL, _REGION = QColor("#ffffff"), QColor("#ff5a4f"), QColor("#5aa9f2")


class MarkerPicture(QWidget):
    """Shows marks on an image; marks can be chosen and dragged, and regions drawn.

    The wheel zooms at the pointer, the middle button pans, a double click shows the whole image.
    Arrow keys go from mark to mark, Space and Return act on the chosen one.
    """

    mark_chosen = Signal(str, object)
    """Id and pixel, for the menu; the id is empty where there is no marker."""
    mark_toggled = Signal(str)
    mark_moved = Signal(str, object)
    mark_dropped = Signal(str, object)
    region_drawn = Signal(object)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._image = QImage()
        self._marks: tuple[Mark, ...] = ()
        self._ignored: tuple[Region, ...] = ()
        self._searched: Region | None = None
        self._selected = ""
        self._zoom = 1.0
        self._middle = QPointF()
        self._pressed: QPointF | None = None
        self._dragged: Mark | None = None
        self._panning = False
        self._sketch: list[QPointF] = []
        self._drawing = False
        self._fits_marks = False
        self.setMinimumSize(240, 180)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Expanding)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setMouseTracking(True)

    def show_picture(self, picture: ByteArray) -> None:
        """Show an image (height, width, 3) uint8, RGB; the next marks are zoomed to fit."""
        height, width = picture.shape[:2]
        packed = np.ascontiguousarray(picture).tobytes()
        self._image = QImage(packed, width, height, 3 * width, QImage.Format.Format_RGB888).copy()
        self._selected = ""
        self.show_whole()
        self._fits_marks = True

    def show_nothing(self) -> None:
        """Show no image, no marks and no regions."""
        self._image = QImage()
        self.show_marks(())
        self.show_regions((), None)

    def show_whole(self) -> None:
        """Show the whole image."""
        self._zoom, self._middle = 1.0, QPointF(self._image.rect().center())
        self.update()

    def show_marked(self) -> None:
        """Zoom to the markers."""
        places = np.array([mark.pixel for mark in self._marks if mark.id]).reshape(-1, 2)
        if len(places) < _LEAST_CORNERS:
            self.show_whole()
            return
        low, high = places.min(0), places.max(0)
        margin = _MARGIN * float((high - low).max())
        wide, tall = high - low + 2 * margin
        image = self._image
        zoom = min(image.width() / wide, image.height() / tall)
        self._zoom = min(max(zoom, 1.0), _GREATEST_ZOOM)
        self._middle = QPointF(*((low + high) / 2))
        self.update()

    def show_marks(self, marks: Sequence[Mark]) -> None:
        """Replace the marks."""
        self._marks = tuple(marks)
        if self._fits_marks:
            self._fits_marks = False
            self.show_marked()
        self.update()

    def show_regions(self, ignored: Sequence[Region], searched: Region | None) -> None:
        """Show the regions that limit the search for markers.

        Parameters
        ----------
        ignored
            Regions without markers.
        searched
            The only region that is searched; None for the whole image.
        """
        self._ignored, self._searched = tuple(ignored), searched
        self.update()

    def draw_region(self, drawing: bool) -> None:
        """Start or stop drawing a region with the next drag."""
        self._drawing = drawing
        self._sketch = []
        self.setCursor(Qt.CursorShape.CrossCursor if drawing else Qt.CursorShape.ArrowCursor)
        self.update()

    def to_widget(self, pixel: Pixel) -> QPointF:
        """Return the widget position of a pixel of the image."""
        return self._shown().map(QPointF(*pixel) + QPointF(0.5, 0.5))

    def to_pixel(self, place: QPointF) -> Pixel:
        """Return the pixel of the image at a widget position."""
        inverted, _ = self._shown().inverted()
        found = inverted.map(place) - QPointF(0.5, 0.5)
        width, height = self._image.width() - 1, self._image.height() - 1
        return min(max(found.x(), 0.0), width), min(max(found.y(), 0.0), height)

    def paintEvent(self, _event: QPaintEvent) -> None:
        """Draw image, regions and marks."""
        painter = QPainter(self)
        painter.fillRect(self.rect(), self.palette().button())
        if not self._image.isNull():
            painter.setRenderHint(QPainter.RenderHint.SmoothPixmapTransform)
            painter.setRenderHint(QPainter.RenderHint.Antialiasing)
            painter.save()
            painter.setTransform(self._shown(), combine=True)
            painter.drawImage(0, 0, self._image)
            painter.restore()
            self._draw_regions(painter)
            for mark in self._marks:
                self._draw_mark(painter, mark)
        painter.end()

    def mousePressEvent(self, event: QMouseEvent) -> None:
        """Grab a mark, start a region, or start panning."""
        self._pressed = event.position()
        if event.button() == Qt.MouseButton.MiddleButton:
            self._panning = True
        elif event.button() == Qt.MouseButton.LeftButton and self._drawing:
            self._sketch = [event.position()]
        elif event.button() == Qt.MouseButton.LeftButton:
            self._dragged = self._mark_at(event.position())
            self._select(self._dragged)

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        """Move the grabbed object."""
        place = event.position()
        if self._pressed is None:
            if not self._drawing:
                over = self._mark_at(place)
                self.setCursor(
                    Qt.CursorShape.PointingHandCursor if over else Qt.CursorShape.ArrowCursor
                )
                self.setToolTip("" if over is None else _numbers(over))
        elif self._panning:
            moved = (place - self._pressed) / self._scale()
            self._middle, self._pressed = self._middle - moved, place
            self.update()
        elif self._sketch:
            self._sketch.append(place)
            self.update()
        elif self._is_drag(place) and self._dragged is not None and self._dragged.id:
            self.mark_moved.emit(self._dragged.id, self.to_pixel(place))

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        """Drop a mark, finish a region, or choose the clicked object."""
        place, dragged, was_panning = event.position(), self._dragged, self._panning
        was_drag, was_drawing = self._is_drag(place), bool(self._sketch)
        sketch, self._sketch = self._sketch, []
        self._pressed, self._dragged, self._panning = None, None, False
        if was_panning:
            return
        if was_drawing:
            self._end_region(sketch)
        elif was_drag and dragged is not None and dragged.id:
            self.mark_dropped.emit(dragged.id, self.to_pixel(place))
        elif not was_drag and self.rect().contains(place.toPoint()) and not self._image.isNull():
            found = dragged or self._mark_at(place)
            pixel = self.to_pixel(place) if found is None else found.pixel
            self.mark_chosen.emit("" if found is None else found.id, pixel)

    def mouseDoubleClickEvent(self, _event: QMouseEvent) -> None:
        """Toggle between the whole image and the markers."""
        if self._zoom > 1.0:
            self.show_whole()
        else:
            self.show_marked()

    def wheelEvent(self, event: QWheelEvent) -> None:
        """Zoom at the pointer."""
        fixed = self.to_pixel(event.position())
        zoom = self._zoom * _ZOOM_PER_STEP ** (event.angleDelta().y() / 120)
        self._zoom = min(max(zoom, 1.0), _GREATEST_ZOOM)
        self._middle += QPointF(*fixed) - QPointF(*self.to_pixel(event.position()))
        self.update()
        event.accept()

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Go from mark to mark, and act on the chosen one."""
        steps = {Qt.Key.Key_Left: -1, Qt.Key.Key_Right: 1}.get(Qt.Key(event.key()))
        chosen = next((mark for mark in self._marks if mark.id == self._selected != ""), None)
        if steps is not None and self._marks:
            order = [mark for mark in self._marks if mark.id]
            at = order.index(chosen) + steps if chosen in order else 0
            self._select(order[at % len(order)] if order else None)
        elif event.key() == Qt.Key.Key_Escape:
            self._sketch = []
            self.update()
        elif chosen is not None and event.key() == Qt.Key.Key_Space:
            self.mark_toggled.emit(chosen.id)
        elif chosen is not None and event.key() in (Qt.Key.Key_Return, Qt.Key.Key_Enter):
            self.mark_chosen.emit(chosen.id, chosen.pixel)
        else:
            super().keyPressEvent(event)

    def _select(self, mark: Mark | None) -> None:
        self._selected = mark.id if mark is not None else ""
        self.update()

    def _is_drag(self, place: QPointF) -> bool:
        return self._pressed is not None and (place - self._pressed).manhattanLength() > _DRAG_PX

    def _mark_at(self, place: QPointF) -> Mark | None:
        def distance(mark: Mark) -> float:
            away = self.to_widget(mark.pixel) - place
            return float(np.hypot(away.x(), away.y()))

        nearest = min(self._marks, key=distance, default=None)
        return nearest if nearest is not None and distance(nearest) <= GRAB_PX else None

    def _end_region(self, sketch: list[QPointF]) -> None:
        corners = tuple(self.to_pixel(place) for place in sketch[:: max(len(sketch) // 40, 1)])
        if len(set(corners)) >= _LEAST_CORNERS:
            self.region_drawn.emit(corners)
        self.update()

    def _scale(self) -> float:
        width, height = max(self._image.width(), 1), max(self._image.height(), 1)
        return self._zoom * min(self.width() / width, self.height() / height)

    def _shown(self) -> QTransform:
        """Return the transform from image pixels, counted from their corners, to the widget."""
        scale = self._scale()
        shown = QTransform.fromTranslate(self.width() / 2, self.height() / 2)
        shown.scale(scale, scale)
        return shown.translate(-self._middle.x(), -self._middle.y())

    def _draw_regions(self, painter: QPainter) -> None:
        painter.setPen(QPen(_REGION, 2, Qt.PenStyle.DashLine))
        shade = QColor(0, 0, 0, 110)
        if self._searched is not None:
            searched, around = self._polygon(self._searched), QPainterPath()
            around.addRect(self.rect())
            around.addPolygon(searched)
            painter.fillPath(around, shade)
            painter.drawPolygon(searched)
        painter.setBrush(shade)
        for region in self._ignored:
            painter.drawPolygon(self._polygon(region))
        painter.setBrush(Qt.BrushStyle.NoBrush)
        if self._sketch:
            painter.drawPolyline(QPolygonF(self._sketch))

    def _polygon(self, region: Region) -> QPolygonF:
        return QPolygonF([self.to_widget(corner) for corner in region])

    def _draw_mark(self, painter: QPainter, mark: Mark) -> None:
        place, color = self.to_widget(mark.pixel), _COLORS[mark.state]
        painter.setBrush(Qt.BrushStyle.NoBrush)
        radius = _SPOT_PX if mark.state == "spot" else _MARK_PX
        for width, shade in ((4, QColor(0, 0, 0, 150)), (2, color)):
            style = Qt.PenStyle.DotLine if mark.state == "spot" else Qt.PenStyle.SolidLine
            painter.setPen(QPen(shade, width, style))
            if mark.by_hand:
                painter.drawRect(
                    QRectF(place.x() - radius, place.y() - radius, 2 * radius, 2 * radius)
                )
            else:
                painter.drawEllipse(place, radius, radius)
        if mark.id == self._selected != "":
            painter.setPen(QPen(_SELECTED, 2))
            painter.drawEllipse(place, radius + 4, radius + 4)
        if mark.projected is not None:
            self._draw_residual(painter, place, self.to_widget(mark.projected), mark)
        if mark.id:
            # The numbers of chosen and of excluded marks are always shown.
            detailed = mark.id == self._selected or mark.state == "unused"
            text = _numbers(mark) if detailed else mark.id
            self._draw_text(painter, place + QPointF(radius + 4, -radius + 2), text, color)

    def _draw_residual(
        self, painter: QPainter, place: QPointF, projected: QPointF, mark: Mark
    ) -> None:
        away = projected - place
        length = float(np.hypot(away.x(), away.y()))
        if mark.state != "excluded" and length > 0:
            enlarged = min(ENLARGED, max(LONGEST_PX / length, 1.0))
            painter.setPen(QPen(_RESIDUAL, 2))
            painter.drawLine(place, place + away * enlarged)
        painter.setPen(QPen(_SELECTED, 1))
        for step in (QPointF(4, 0), QPointF(0, 4)):
            painter.drawLine(projected - step, projected + step)

    def _draw_text(self, painter: QPainter, place: QPointF, text: str, color: QColor) -> None:
        painter.setPen(QColor(0, 0, 0, 200))
        for shift in (QPointF(1, 1), QPointF(-1, 1), QPointF(1, -1), QPointF(-1, -1)):
            painter.drawText(place + shift, text)
        painter.setPen(color)
        painter.drawText(place, text)


def _numbers(mark: Mark) -> str:
    """Return the marker's name with its residual."""
    parts = [mark.id or tr("Blue spot")]
    if mark.residual_px is not None:
        parts.append(f"{localised(mark.residual_px)} px")
    if mark.residual_mm is not None:
        parts.append(f"{localised(mark.residual_mm)} mm")
    return "  ".join(parts)
