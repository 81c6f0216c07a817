"""An image scaled to its widget."""

from __future__ import annotations

from PySide6.QtCore import QRect, Qt, Signal
from PySide6.QtGui import QImage, QMouseEvent, QPainter, QPaintEvent
from PySide6.QtWidgets import QSizePolicy, QWidget

from insole_core.geometry.arrays import ByteArray

_MARGIN_PX = 24


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
