"""The widgets that show a plotter: Qt's own GL window if available, else a painted image."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from PySide6.QtCore import QEvent, QObject, QSize, Qt, QTimer
from PySide6.QtGui import (
    QGuiApplication,
    QImage,
    QPainter,
    QPaintEvent,
    QResizeEvent,
    QSurfaceFormat,
)
from PySide6.QtWidgets import QVBoxLayout, QWidget

_GL_PLATFORMS = ("xcb", "windows", "cocoa")


def has_gl() -> bool:
    """Return whether VTK can draw into a window of this Qt platform."""
    return QGuiApplication.platformName() in _GL_PLATFORMS


class Canvas(QWidget):
    """Widget that shows a plotter; `plotter` holds the actors, `request_render` draws once, soon.

    `aim` is called before each drawing, so that several camera changes cost one update.
    """

    plotter: Any
    surface: QWidget
    """The widget that receives mouse events."""

    def __init__(self, aim: Callable[[], None], parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.aim = aim
        self._timer = QTimer(self)
        self._timer.setSingleShot(True)
        self._timer.setInterval(0)
        self._timer.timeout.connect(self.render_now)

    def request_render(self) -> None:
        """Draw when the pending events are handled; several requests are drawn once."""
        if self.plotter is not None and not self._timer.isActive():
            self._timer.start()

    def render_now(self) -> None:
        """Draw immediately."""
        raise NotImplementedError

    def picture(self) -> QImage:
        """Return the rendered image, in device pixels."""
        raise NotImplementedError

    def close_plotter(self) -> None:
        """Free the renderer; may be called more than once."""
        self._timer.stop()
        if self.plotter is not None:
            self.plotter.close()
            self.plotter = None


class _DefaultFormat(QSurfaceFormat):
    """Qt's format for pyvistaqt, whose views set the default one that the program has set before.

    Of setting it again Qt warns, though it is the same.
    """

    @staticmethod
    def setDefaultFormat(wanted: QSurfaceFormat | QSurfaceFormat.FormatOption) -> None:
        if QSurfaceFormat.defaultFormat() != wanted:
            QSurfaceFormat.setDefaultFormat(wanted)


class WindowCanvas(Canvas):
    """Canvas in whose native window VTK draws."""

    def __init__(self, aim: Callable[[], None], parent: QWidget | None = None) -> None:
        super().__init__(aim, parent)
        from pyvistaqt import QtInteractor, rwi

        rwi.QSurfaceFormat = _DefaultFormat
        interactor = QtInteractor(self, auto_update=False, multi_samples=4)
        self.plotter = interactor
        self.surface = interactor
        layout = QVBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.addWidget(interactor)
        self.setFocusProxy(interactor)
        interactor.installEventFilter(self)

    def eventFilter(self, _watched: QObject, event: QEvent) -> bool:
        """Aim before whatever is drawn: Qt also asks for it by itself, as soon as it is shown."""
        if event.type() == QEvent.Type.Paint and self.plotter is not None:
            self.aim()
        return False

    def render_now(self) -> None:
        """Draw immediately."""
        if self.plotter is not None and self.isVisible():
            QWidget.update(self.surface)  # draws: what was drawn before would be drawn twice

    def picture(self) -> QImage:
        """Return the rendered image, in device pixels."""
        self.aim()
        self.plotter.render_window.Render()
        return _image(self.plotter.screenshot(return_img=True))


class ImageCanvas(Canvas):
    """Canvas that paints the image of an off-screen plotter; needs no GL in Qt."""

    def __init__(self, aim: Callable[[], None], parent: QWidget | None = None) -> None:
        super().__init__(aim, parent)
        import pyvista as pv

        self.plotter = pv.Plotter(off_screen=True, window_size=(64, 64))
        # Without GL the processor draws every sample: multisampling takes three times as long.
        self.plotter.disable_anti_aliasing()
        self.surface = self
        self._image: QImage | None = None
        self.setAttribute(Qt.WidgetAttribute.WA_OpaquePaintEvent)

    def sizeHint(self) -> QSize:
        """Return the size that the layout offers."""
        return QSize(320, 320)

    def render_now(self) -> None:
        """Draw immediately."""
        if self.plotter is None or not self.isVisible():
            return
        self._image = self.picture()
        self.update()

    def picture(self) -> QImage:
        """Return the rendered image, in device pixels."""
        ratio = self.devicePixelRatioF()
        size = [max(round(self.width() * ratio), 1), max(round(self.height() * ratio), 1)]
        self.plotter.window_size = size
        self.aim()
        self.plotter.render()
        image = _image(self.plotter.screenshot(return_img=True))
        image.setDevicePixelRatio(ratio)
        return image

    def paintEvent(self, _event: QPaintEvent) -> None:
        """Paint the last image."""
        painter = QPainter(self)
        if self._image is None:
            painter.fillRect(self.rect(), self.palette().window())
        else:
            painter.drawImage(0, 0, self._image)
        painter.end()

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Draw in the new size."""
        super().resizeEvent(event)
        self.request_render()


def make_canvas(aim: Callable[[], None], parent: QWidget | None = None) -> Canvas:
    """Return the best canvas that this Qt platform supports.

    Parameters
    ----------
    aim
        Sets the camera of the plotter; called before each drawing.
    parent
        The parent widget.
    """
    return WindowCanvas(aim, parent) if has_gl() else ImageCanvas(aim, parent)


def _image(pixels: Any) -> QImage:
    pixels = np.ascontiguousarray(pixels[:, :, :3])
    height, width, _ = pixels.shape
    view = QImage(pixels.data, width, height, 3 * width, QImage.Format.Format_RGB888)
    return view.copy()
