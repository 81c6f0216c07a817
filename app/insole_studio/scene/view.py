"""One 3-D view: camera by the hand, and pointer events in the terms of the foot for the tools."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial
from typing import Protocol

import numpy as np
from PySide6.QtCore import QEvent, QObject, QPointF, Qt, Signal
from PySide6.QtGui import QImage, QKeyEvent, QMouseEvent, QWheelEvent
from PySide6.QtWidgets import QMenu, QVBoxLayout, QWidget

from insole_core.geometry.arrays import FloatArray, IntArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.picking import SurfacePicker
from insole_core.geometry.side import Side
from insole_studio.scene.camera import Camera, Look, Preset, Subject, fitted, look
from insole_studio.scene.canvas import make_canvas
from insole_studio.scene.coloring import Coloring
from insole_studio.scene.companion import Companion
from insole_studio.scene.painter import Painter
from insole_studio.scene.pointer import Handle, Phase, PointerEvent

GRAB_PX = 14.0
TOUCH_GRAB_PX = 28.0
ORBIT_DEG_PER_PX = 0.4
ZOOM_PER_STEP = 0.88

_DARK = 128
"""Below this lightness of its windows a theme is dark."""
_ARROWS = {
    Qt.Key.Key_Left: (-1, 0),
    Qt.Key.Key_Right: (1, 0),
    Qt.Key.Key_Up: (0, 1),
    Qt.Key.Key_Down: (0, -1),
}


class Offered(Protocol):
    """A line of the menu under the pointer."""

    @property
    def text(self) -> str:
        """What it says."""
        ...

    @property
    def run(self) -> Callable[[], None]:
        """What it does."""
        ...


class PointerSink(Protocol):
    """Who acts on the pointer: the hand that holds a tool."""

    def press(self, event: PointerEvent) -> bool:
        """Begin a gesture; False leaves the press to the camera."""
        ...

    def move(self, event: PointerEvent) -> None:
        """Continue the gesture."""
        ...

    def release(self, event: PointerEvent) -> None:
        """End the gesture."""
        ...

    def cancel(self) -> bool:
        """Give the gesture up; False when there is none."""
        ...

    def double_click(self, event: PointerEvent) -> bool:
        """Act on a double click; False leaves it to the camera."""
        ...

    def offers(self, event: PointerEvent) -> Sequence[Offered]:
        """Give what can be done at a place."""
        ...

    def wheel(self, event: PointerEvent, steps: float) -> bool:
        """Act on the wheel; False leaves it to the camera."""
        ...

    def nudge(self, event: PointerEvent, right: int, up: int) -> bool:
        """Act on an arrow key; False leaves it to others."""
        ...


class SceneView(QWidget):
    """Shows one subject through a camera that may be shared with other views."""

    camera_changed = Signal(object)
    hovered = Signal(object)
    left = Signal()

    def __init__(self, subject: Subject, dark: bool = False, parent: QWidget | None = None) -> None:
        self._is_alive = False
        super().__init__(parent)
        self.subject = subject
        self.sink: PointerSink | None = None
        self.side = Side.LEFT
        self.camera = Camera()
        self.handles: tuple[Handle, ...] = ()
        self.grab_px = GRAB_PX
        """How near the pointer must come to a handle."""
        self._mesh: TriangleMesh | None = None
        self._picker: SurfacePicker | None = None
        self._dragging: str | None = None
        self._last = QPointF()
        self._canvas = make_canvas(self._aim, self)
        self.painter = Painter(self._canvas.plotter, dark, self.devicePixelRatioF())
        self.companion = Companion(self._canvas.plotter, self.devicePixelRatioF())
        layout = QVBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.addWidget(self._canvas)
        surface = self._canvas.surface
        surface.setMouseTracking(True)
        surface.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        surface.installEventFilter(self)
        self.setFocusProxy(surface)
        self._is_alive = True

    @property
    def surface(self) -> QWidget:
        """The widget that receives mouse and keys."""
        return self._canvas.surface

    @property
    def look(self) -> Look:
        """The camera made concrete for the size of the widget."""
        size = (max(self._canvas.width(), 1), max(self._canvas.height(), 1))
        return look(self.camera, self.subject, self.side, size)

    def show_mesh(
        self,
        mesh: TriangleMesh | None,
        coloring: Coloring | None = None,
    ) -> None:
        """Show another surface; it can be touched by the pointer from now on."""
        self.painter.show_surface(mesh, coloring)
        self._take(mesh)

    def move_mesh(
        self,
        mesh: TriangleMesh,
        normals: FloatArray,
        moved: IntArray | None = None,
        coloring: Coloring | None = None,
    ) -> bool:
        """Show the same triangles at new places; False when they are others."""
        followed = self.painter.move_surface(mesh, normals, moved, coloring)
        if followed:
            self._take(mesh)
        return followed

    def show_handles(self, handles: tuple[Handle, ...]) -> None:
        """Show what can be grabbed."""
        self.handles = handles
        self.painter.show_handles(handles)
        self.request_render()

    def set_camera(self, camera: Camera) -> None:
        """Look through another camera, without telling anybody."""
        self.camera = camera
        self.request_render()

    def aim_at(self, preset: Preset, bounds_mm: FloatArray) -> Camera:
        """Give the camera of a preset that shows the whole box in this view."""
        size = (self._canvas.width(), self._canvas.height())
        return fitted(Camera(preset), bounds_mm, size)

    def request_render(self) -> None:
        """Draw soon."""
        self._canvas.request_render()

    def picture(self) -> QImage:
        """Draw now and give the picture."""
        return self._canvas.picture()

    def close_scene(self) -> None:
        """Free the renderer; may be called twice."""
        self._is_alive = False
        self._canvas.surface.removeEventFilter(self)
        self._canvas.close_plotter()

    def changeEvent(self, event: QEvent) -> None:
        """Follow the theme, whichever stage is open."""
        if event.type() == QEvent.Type.PaletteChange and self._is_alive:
            self.painter.set_dark(self.palette().window().color().lightness() < _DARK)
            self.request_render()
        super().changeEvent(event)

    def eventFilter(self, _watched: QObject, event: QEvent) -> bool:
        """Take mouse and keys before the renderer's own interactor sees them."""
        kind = event.type()
        if isinstance(event, QMouseEvent):
            handler = {
                QEvent.Type.MouseButtonPress: self._pressed,
                QEvent.Type.MouseMove: self._moved,
                QEvent.Type.MouseButtonRelease: self._released,
                QEvent.Type.MouseButtonDblClick: self._double_clicked,
            }.get(kind)
            if handler is not None:
                handler(event)
                return True
        if isinstance(event, QWheelEvent):
            self._wheeled(event)
            return True
        if isinstance(event, QKeyEvent) and kind == QEvent.Type.KeyPress:
            return self._key_pressed(event)
        if kind == QEvent.Type.Leave:
            self.left.emit()
        if kind == QEvent.Type.Resize:
            self.request_render()
            self.camera_changed.emit(self.camera)
        return False

    def _aim(self) -> None:
        self.painter.aim(self.look)

    def _take(self, mesh: TriangleMesh | None) -> None:
        self._mesh = mesh
        if self._dragging != "tool":
            self._picker = None

    def _pressed(self, event: QMouseEvent) -> None:
        self._canvas.surface.setFocus(Qt.FocusReason.MouseFocusReason)
        self._last = event.position()
        shift = bool(event.modifiers() & Qt.KeyboardModifier.ShiftModifier)
        if event.button() == Qt.MouseButton.MiddleButton or (
            event.button() == Qt.MouseButton.LeftButton and shift
        ):
            self._dragging = "pan"
        elif event.button() == Qt.MouseButton.RightButton:
            self._open_menu(event)
        elif event.button() == Qt.MouseButton.LeftButton:
            taken = self.sink is not None and self.sink.press(self._event(Phase.PRESS, event))
            self._dragging = "tool" if taken else "orbit"

    def _open_menu(self, event: QMouseEvent) -> None:
        """Offer what can be done here; the menu goes with its use."""
        offers = () if self.sink is None else self.sink.offers(self._event(Phase.PRESS, event))
        if not offers:
            return
        menu = QMenu(self)
        menu.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        for offer in offers:
            menu.addAction(offer.text).triggered.connect(partial(_run, offer))
        menu.popup(event.globalPosition().toPoint())

    def _moved(self, event: QMouseEvent) -> None:
        if self._dragging == "tool" and self.sink is not None:
            pointer = self._event(Phase.MOVE, event)
            self.sink.move(pointer)
            self.hovered.emit(pointer)
        elif self._dragging is not None:
            self._move_camera(event.position())
        else:
            self._hover(event)
        self._last = event.position()

    def _released(self, event: QMouseEvent) -> None:
        was_tool, self._dragging = self._dragging == "tool", None
        if was_tool and self.sink is not None:
            self.sink.release(self._event(Phase.RELEASE, event))
            self._picker = None
        self._hover(event)

    def _double_clicked(self, event: QMouseEvent) -> None:
        pointer = self._event(Phase.PRESS, event)
        if self.sink is not None and self.sink.double_click(pointer):
            return
        hit = pointer.surface_mm
        if hit is not None:
            self._change_camera(self.camera.centred(hit))

    def _wheeled(self, event: QWheelEvent) -> None:
        steps = event.angleDelta().y() / 120
        pointer = self._event(Phase.MOVE, event)
        if self.sink is not None and self.sink.wheel(pointer, steps):
            return
        about = self.look.point_at(event.position().x(), event.position().y())
        self._change_camera(self.camera.zoomed(ZOOM_PER_STEP**steps, about))

    def _key_pressed(self, event: QKeyEvent) -> bool:
        if self.sink is None:
            return False
        if event.key() == Qt.Key.Key_Escape:
            return self.sink.cancel()
        if event.key() in _ARROWS:
            centre = (self.width() / 2, self.height() / 2)
            pointer = PointerEvent(
                Phase.MOVE,
                self.subject,
                self.look,
                centre,
                fine=_holds(event.modifiers(), Qt.KeyboardModifier.ControlModifier),
                coarse=_holds(event.modifiers(), Qt.KeyboardModifier.ShiftModifier),
            )
            return self.sink.nudge(pointer, *_ARROWS[Qt.Key(event.key())])
        return False

    def _hover(self, event: QMouseEvent) -> None:
        pointer = self._event(Phase.MOVE, event)
        grabbable = pointer.handle is not None
        shape = Qt.CursorShape.OpenHandCursor if grabbable else Qt.CursorShape.ArrowCursor
        self._canvas.surface.setCursor(shape)
        self.hovered.emit(pointer)

    def _move_camera(self, position: QPointF) -> None:
        step = position - self._last
        if self._dragging == "orbit":
            azimuth, elevation = -step.x() * ORBIT_DEG_PER_PX, step.y() * ORBIT_DEG_PER_PX
            self._change_camera(self.camera.orbited(azimuth, elevation))
        else:
            shown = self.look
            shift = (-step.x() * shown.right + step.y() * shown.up) * shown.mm_per_px
            self._change_camera(self.camera.centred(shown.focal_mm + shift))

    def _change_camera(self, camera: Camera) -> None:
        self.set_camera(camera)
        self.camera_changed.emit(camera)

    def _event(self, phase: Phase, event: QMouseEvent | QWheelEvent) -> PointerEvent:
        position = event.position()
        return PointerEvent(
            phase,
            self.subject,
            self.look,
            (position.x(), position.y()),
            self._hit(position),
            self._handle_at(position),
            fine=_holds(event.modifiers(), Qt.KeyboardModifier.ControlModifier),
            coarse=_holds(event.modifiers(), Qt.KeyboardModifier.ShiftModifier),
        )

    def _hit(self, position: QPointF) -> FloatArray | None:
        if self._mesh is None or len(self._mesh.triangles) == 0:
            return None
        if self._picker is None:
            self._picker = SurfacePicker(self._mesh)
        return self._picker.pick(*self.look.ray_at(position.x(), position.y()))

    def _handle_at(self, position: QPointF) -> str | None:
        if not self.handles:
            return None
        places = np.array([handle.position_mm for handle in self.handles])
        offset = self.look.pixels_of(places) - (position.x(), position.y())
        distance = np.hypot(*offset.T)
        nearest = int(np.argmin(distance))
        return self.handles[nearest].name if distance[nearest] <= self.grab_px else None


def _run(offer: Offered, _checked: bool = False) -> None:
    offer.run()


def _holds(modifiers: Qt.KeyboardModifier, key: Qt.KeyboardModifier) -> bool:
    return bool(modifiers & key)
