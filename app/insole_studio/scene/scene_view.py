"""One 3-D view: interactive camera, and pointer events in the foot's coordinates for the tools."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cache, partial
from typing import TYPE_CHECKING, Protocol

import numpy as np
from PySide6.QtCore import QEvent, QMargins, QObject, QPoint, QPointF, Qt, Signal
from PySide6.QtGui import (
    QImage,
    QInputEvent,
    QKeyEvent,
    QMouseEvent,
    QPainter,
    QPaintEvent,
    QPalette,
    QWheelEvent,
)
from PySide6.QtWidgets import QApplication, QMenu, QVBoxLayout, QWidget

from insole_core.geometry.arrays import FloatArray, IntArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.ray_casting import SurfacePicker
from insole_core.geometry.side import Side
from insole_studio.scene.canvas import Canvas, make_canvas
from insole_studio.scene.coloring import Coloring
from insole_studio.scene.keyboard_cursor import KeyboardCursor
from insole_studio.scene.pointer import Handle, Phase, PointerEvent
from insole_studio.scene.pointer_moves import PointerMoves
from insole_studio.scene.view_camera import Preset, Subject, ViewCamera, ViewTransform, fitted, look

if TYPE_CHECKING:
    from insole_studio.scene.painter import Painter
    from insole_studio.scene.secondary_mesh import SecondaryMesh

MOST_STEPS = 8
"""A pixel of the window may be 5/4, 3/2, 15/8 … of a pixel of the screen."""
FRAME_PX = 2
"""Width of the frame around the view that has the keyboard focus."""
GRAB_PX = 14.0
TOUCH_GRAB_PX = 28.0
GENEROUS = 2.0
"""How much farther a handle is grabbed where a miss would do nothing."""
ORBIT_DEG_PER_PX = 0.4
ZOOM_PER_STEP = 0.88

_TABS = (Qt.Key.Key_Tab, Qt.Key.Key_Backtab)
_DARK = 128
"""A theme with a darker window background than this is dark."""


class OfferedItem(Protocol):
    """An item of the context menu; one that `removes` is also run by the Delete key."""

    @property
    def text(self) -> str:
        """Label of the item."""
        ...

    @property
    def run(self) -> Callable[[], None]:
        """What the item does."""
        ...

    @property
    def removes(self) -> bool:
        """Whether the item deletes the object under the pointer."""
        ...


class PointerSink(Protocol):
    """Receiver of a view's pointer events."""

    @property
    def turns_view(self) -> bool:
        """Whether a drag by the left button turns the view where nothing is grabbed."""
        ...

    def press(self, event: PointerEvent) -> bool:
        """Start a gesture; return False to leave the press to the camera."""
        ...

    def move(self, event: PointerEvent) -> None:
        """Continue the gesture."""
        ...

    def release(self, event: PointerEvent) -> None:
        """Finish the gesture."""
        ...

    def cancel(self) -> bool:
        """Cancel the gesture; return False if there is none."""
        ...

    def double_click(self, event: PointerEvent) -> bool:
        """Handle a double click; return False to leave it to the camera."""
        ...

    def offers(self, event: PointerEvent) -> Sequence[OfferedItem]:
        """Return the context menu items for a position."""
        ...

    def wheel(self, event: PointerEvent, steps: float) -> bool:
        """Handle the wheel; return False to leave it to the camera.

        Parameters
        ----------
        event
            Position of the pointer.
        steps
            Notches of the wheel, > 0 away from the user.
        """
        ...

    def nudge(self, event: PointerEvent, right: int, up: int) -> bool:
        """Handle an arrow key; return False if it is not used.

        Parameters
        ----------
        event
            Position of the pointer, and the modifier keys.
        right, up
            Direction of the key: -1, 0 or 1.
        """
        ...


@dataclass(frozen=True, eq=False)
class _Renderer:
    """What draws a scene, and the widget it draws into."""

    canvas: Canvas
    painter: Painter
    companion: SecondaryMesh


class SceneView(QWidget):
    """3-D view of one subject; its camera may be linked with that of other views."""

    camera_changed = Signal(object)
    hovered = Signal(object)
    left = Signal()
    missed = Signal()
    """Emitted when the left button was pressed where there is nothing to drag."""

    def __init__(self, subject: Subject, dark: bool = False, parent: QWidget | None = None) -> None:
        self._is_alive = False
        super().__init__(parent)
        self.subject = subject
        self.sink: PointerSink | None = None
        self.side = Side.LEFT
        self.camera = ViewCamera()
        self.handles: tuple[Handle, ...] = ()
        self.grab_px = GRAB_PX
        """Largest distance at which the pointer grabs a handle."""
        self.start: Callable[[], tuple[float, float, float] | None] | None = None
        """Returns the start position of the keyboard cursor."""
        self.keys = KeyboardCursor(self)
        self._mesh: TriangleMesh | None = None
        self._picker: SurfacePicker | None = None
        self._dragging: str | None = None
        self._last = QPointF()
        self._grip = QPointF()
        """From the pointer to the handle that it drags, so that grabbing alone moves nothing."""
        self._moves = PointerMoves(self._moved, self)
        self._dark = dark
        self._renderer: _Renderer | None = None
        """Made with the first thing to draw: the empty window opens without waiting for VTK."""
        self._frame = QVBoxLayout(self)
        self._frame.setContentsMargins(FRAME_PX, FRAME_PX, FRAME_PX, FRAME_PX)
        self._is_alive = True

    @property
    def is_open(self) -> bool:
        """Whether something was drawn, so that there is a renderer."""
        return self._renderer is not None

    @property
    def painter(self) -> Painter:
        """Draws the subject and the marks on it."""
        return self._opened().painter

    @property
    def companion(self) -> SecondaryMesh:
        """Draws what stands beside the subject."""
        return self._opened().companion

    @property
    def surface(self) -> QWidget:
        """The widget that receives mouse and keys."""
        return self if self._renderer is None else self._canvas.surface

    def take_focus(self) -> None:
        """Let the keys act here."""
        self._canvas.surface.setFocus(Qt.FocusReason.ShortcutFocusReason)

    @property
    def look(self) -> ViewTransform:
        """The camera made concrete for the size of the widget."""
        width, height = self._size_px
        size = (max(width, 1), max(height, 1))
        return look(self.camera, self.subject, self.side, size)

    def clear(self) -> None:
        """Show nothing, and let go of the meshes that were shown."""
        self.handles = ()
        self._take(None)
        self._picker = None
        if self._renderer is not None:
            self._renderer.painter.clear()
            self._renderer.companion.clear()

    def show_mesh(
        self,
        mesh: TriangleMesh | None,
        coloring: Coloring | None = None,
    ) -> None:
        """Show another surface and let the pointer pick on it.

        Parameters
        ----------
        mesh : mm, insole frame
            The surface; None removes it.
        coloring
            By default the mesh's own colours, or those of the material.
        """
        self.painter.show_surface(mesh, coloring)
        self._take(mesh)
        self.request_render()

    def move_mesh(
        self,
        mesh: TriangleMesh,
        normals: FloatArray,
        moved: IntArray | None = None,
        coloring: Coloring | None = None,
    ) -> bool:
        """Move the vertices of the shown surface; see `Painter.move_surface`."""
        followed = self.painter.move_surface(mesh, normals, moved, coloring)
        if followed:
            self._take(mesh)
            self.request_render()
        return followed

    def show_handles(self, handles: tuple[Handle, ...]) -> None:
        """Show the draggable handles."""
        self.handles = handles
        self.painter.show_handles(handles)
        if self.keys.is_shown and not self.keys.holds:
            self.keys.refresh()
        self.request_render()

    def set_camera(self, camera: ViewCamera) -> None:
        """Set the camera without emitting a signal."""
        self.camera = camera
        if self.keys.is_shown:
            self.keys.refresh()
        self.request_render()

    def change_camera(self, camera: ViewCamera) -> None:
        """Set the camera and announce it."""
        self.set_camera(camera)
        self.camera_changed.emit(camera)

    def aim_at(self, preset: Preset, bounds_mm: FloatArray) -> ViewCamera:
        """Give the camera of a preset that shows the whole box in this view."""
        return fitted(ViewCamera(preset), bounds_mm, self._size_px)

    def request_render(self) -> None:
        """Draw soon."""
        if self._renderer is not None:
            self._fit_frame()
            self._canvas.request_render()

    def picture(self) -> QImage:
        """Draw immediately and return the image."""
        return self._canvas.picture()

    def close_scene(self) -> None:
        """Free the renderer and the meshes that were shown; may be called more than once."""
        if self._is_alive:
            self.clear()
        self._is_alive = False
        if self._renderer is not None:
            self._canvas.surface.removeEventFilter(self)
            self._canvas.close_plotter()

    def set_dark(self, dark: bool) -> None:
        """Change the scheme of the scene."""
        self._dark = dark
        if self._renderer is not None:
            self._renderer.painter.set_dark(dark)
            self.request_render()

    def event(self, event: QEvent) -> bool:
        """Draw as large on a screen of another scale, which the window was moved to."""
        if event.type() == QEvent.Type.DevicePixelRatioChange and self._renderer is not None:
            ratio = self.devicePixelRatioF()
            self._renderer.painter.set_pixel_ratio(ratio)
            self._renderer.companion.pixel_ratio = ratio
            self.request_render()
        return super().event(event)

    def changeEvent(self, event: QEvent) -> None:
        """Follow changes of the theme."""
        if event.type() == QEvent.Type.PaletteChange and self._is_alive:
            self.set_dark(self.palette().window().color().lightness() < _DARK)
        super().changeEvent(event)

    def paintEvent(self, _event: QPaintEvent) -> None:
        """Frame the view that the keys act on."""
        has_keys = self.surface.hasFocus()
        role = QPalette.ColorRole.Highlight if has_keys else QPalette.ColorRole.Window
        QPainter(self).fillRect(self.rect(), self.palette().color(role))

    def eventFilter(self, _watched: QObject, event: QEvent) -> bool:
        """Handle mouse and keys before the renderer's own interactor sees them."""
        kind = event.type()
        if isinstance(event, QMouseEvent) and kind == QEvent.Type.MouseMove:
            self._moves.take(event)
            return True
        if isinstance(event, QInputEvent) or kind == QEvent.Type.Leave:
            self._moves.hand_over()
        if isinstance(event, QMouseEvent):
            handler = {
                QEvent.Type.MouseButtonPress: self._pressed,
                QEvent.Type.MouseButtonRelease: self._released,
                QEvent.Type.MouseButtonDblClick: self._double_clicked,
            }.get(kind)
            if handler is not None:
                handler(event)
                return True
        if isinstance(event, QWheelEvent):
            self._wheeled(event)
            return True
        if isinstance(event, QKeyEvent):
            return self._key_event(event)
        if kind in (QEvent.Type.FocusIn, QEvent.Type.FocusOut):
            self.keys.let_go()
            self.update()
        if kind == QEvent.Type.Leave:
            self.left.emit()
        if kind == QEvent.Type.Resize:
            self.request_render()
            self.camera_changed.emit(self.camera)
        return False

    @property
    def _canvas(self) -> Canvas:
        return self._opened().canvas

    @property
    def _size_px(self) -> tuple[int, int]:
        """Width and height within the frame; a canvas that was just made is not laid out yet."""
        inside = self.size().shrunkBy(self._frame.contentsMargins())
        return inside.width(), inside.height()

    def _fit_frame(self) -> None:
        """Let the picture begin and end at whole pixels of the screen.

        Else Qt leaves a black line between what it draws itself and what OpenGL has drawn.
        """
        step = _pixels_per_step(self.devicePixelRatioF())
        corner = self.mapTo(self.window(), QPoint(0, 0))
        left, right = _margins(corner.x(), self.width(), step)
        top, bottom = _margins(corner.y(), self.height(), step)
        margins = QMargins(left, top, right, bottom)
        if margins != self._frame.contentsMargins():
            self._frame.setContentsMargins(margins)
            self._frame.activate()

    def _opened(self) -> _Renderer:
        if self._renderer is None:
            self._renderer = self._open()
        return self._renderer

    def _open(self) -> _Renderer:
        # VTK takes most of the time and memory of a start.
        from insole_studio.scene.painter import Painter
        from insole_studio.scene.secondary_mesh import SecondaryMesh

        canvas, ratio = make_canvas(self._aim, self), self.devicePixelRatioF()
        self._frame.addWidget(canvas)
        surface = canvas.surface
        surface.setMouseTracking(True)
        surface.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        surface.installEventFilter(self)
        self.setFocusProxy(surface)
        return _Renderer(
            canvas,
            Painter(canvas.plotter, self._dark, ratio),
            SecondaryMesh(canvas.plotter, ratio),
        )

    def _aim(self) -> None:
        self.painter.aim(self.look)

    def _take(self, mesh: TriangleMesh | None) -> None:
        self._mesh = mesh
        if self._dragging != "tool":
            self._picker = None

    def _pressed(self, event: QMouseEvent) -> None:
        self._canvas.surface.setFocus(Qt.FocusReason.MouseFocusReason)
        self.keys.let_go()
        self.keys.forget()
        self._last = event.position()
        shift = _holds(event.modifiers(), Qt.KeyboardModifier.ShiftModifier)
        button = event.button()
        if button == Qt.MouseButton.MiddleButton or (button == Qt.MouseButton.LeftButton and shift):
            self._dragging = "pan"
        elif button == Qt.MouseButton.RightButton:
            if self._dragging != "tool":
                self._dragging = "menu"  # on release, unless it is dragged before
        elif button == Qt.MouseButton.LeftButton:
            self._dragging = self._begin_drag(event)

    def _begin_drag(self, event: QMouseEvent) -> str:
        """Return what a drag by the left button does from here on."""
        pressed = self._event(Phase.PRESS, event)
        if pressed.handle is not None:
            is_taken = self._grab(event, pressed.handle)
        else:
            is_taken = self.begin(pressed)
        if is_taken:
            return "tool"
        if self.sink is None or self.sink.turns_view:
            return "orbit"
        near = self._handle_at(event.position(), GENEROUS * self.grab_px)
        if near is not None and self._grab(event, near):
            return "tool"
        self.missed.emit()
        return "nothing"

    def _grab(self, event: QMouseEvent, name: str) -> bool:
        """Start a gesture of a handle, as if the pointer were in the middle of it."""
        self._grip = self._way_to(event.position(), name)
        if self.begin(replace(self._event(Phase.PRESS, event), handle=name)):
            return True
        self._grip = QPointF()
        return False

    def offer_menu(self, event: PointerEvent) -> None:
        """Open the context menu for a position; it is deleted once closed."""
        offers = () if self.sink is None else self.sink.offers(event)
        if not offers:
            return
        menu = QMenu(self)
        menu.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        for offer in offers:
            menu.addAction(offer.text).triggered.connect(partial(_run, offer))
        menu.popup(self.surface.mapToGlobal(QPointF(*event.pixel)).toPoint())

    def _moved(self, moves: Sequence[QMouseEvent]) -> None:
        if not self._is_alive:
            return
        event = moves[-1]
        position = event.position()
        if self._dragging == "menu":
            if (position - self._last).manhattanLength() < QApplication.startDragDistance():
                return
            self._dragging = "orbit"
        if self._dragging == "tool":
            hits = [self._hit(move.position() + self._grip) for move in moves[:-1]]
            before = tuple(hit for hit in hits if hit is not None)
            pointer = replace(self._event(Phase.MOVE, event), before_mm=before)
            self.go_on(pointer)
            self.hovered.emit(pointer)
        elif self._dragging in ("orbit", "pan"):
            self._move_camera(position)
        elif self._dragging is None:
            self._hover(event)
        self._last = position

    def _released(self, event: QMouseEvent) -> None:
        done, self._dragging = self._dragging, None
        if done == "tool":
            self.go_on(self._event(Phase.RELEASE, event))
        self._grip = QPointF()
        if done == "menu":
            self.offer_menu(self._event(Phase.PRESS, event))
        if done != "nothing":  # what was said of a miss stays until the pointer moves on
            self._hover(event)

    def _double_clicked(self, event: QMouseEvent) -> None:
        pointer = self._event(Phase.PRESS, event)
        if self.sink is not None and self.sink.double_click(pointer):
            return
        hit = pointer.surface_mm
        if hit is not None:
            self.change_camera(self.camera.centred(hit))

    def _wheeled(self, event: QWheelEvent) -> None:
        steps = event.angleDelta().y() / 120
        pointer = self._event(Phase.MOVE, event)
        if self.sink is not None and self.sink.wheel(pointer, steps):
            return
        about = self.look.point_at(event.position().x(), event.position().y())
        self.change_camera(self.camera.zoomed(ZOOM_PER_STEP**steps, about))

    def _key_event(self, event: QKeyEvent) -> bool:
        """Handle a key; an unused one goes to the window, not to the renderer."""
        if event.type() == QEvent.Type.ShortcutOverride:
            if event.key() == Qt.Key.Key_Delete and self.keys.is_shown:
                event.accept()
                return True
            return False
        if event.type() != QEvent.Type.KeyPress or event.key() in _TABS:
            return False
        event.setAccepted(self.keys.take(event))
        return True

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
            self.change_camera(self.camera.orbited(azimuth, elevation))
        else:
            shown = self.look
            shift = (-step.x() * shown.right + step.y() * shown.up) * shown.mm_per_px
            self.change_camera(self.camera.centred(shown.focal_mm + shift))

    @property
    def start_mm(self) -> tuple[float, float, float] | None:
        """Position where the keyboard cursor starts; None is the middle of the view."""
        return None if self.start is None else self.start()

    def event_at(
        self, phase: Phase, pixel: tuple[float, float], handle: str | None, fine: bool, coarse: bool
    ) -> PointerEvent:
        """Return a pointer event of the keyboard cursor.

        Parameters
        ----------
        phase
            Press, move or release.
        pixel
            Position in the view (x, y).
        handle
            Name of the chosen handle.
        fine, coarse
            Whether Ctrl or Shift is held.
        """
        hit = self._hit(QPointF(*pixel))
        return PointerEvent(
            phase, self.subject, self.look, pixel, hit, handle, fine, coarse, by_key=True
        )

    def begin(self, event: PointerEvent) -> bool:
        """Start a gesture; return False if it is not used."""
        return self.sink is not None and self.sink.press(event)

    def go_on(self, event: PointerEvent) -> None:
        """Continue a gesture, or finish it with a release."""
        if self.sink is not None and event.phase is Phase.RELEASE:
            self.sink.release(event)
            self._picker = None
        elif self.sink is not None:
            self.sink.move(event)

    def give_up(self) -> bool:
        """Cancel the gesture; return False if there is none."""
        return self.sink is not None and self.sink.cancel()

    def nudge(self, event: PointerEvent, right: int, up: int) -> bool:
        """Move the selected object; return False if nothing is selected."""
        return self.sink is not None and self.sink.nudge(event, right, up)

    def lift(self, event: PointerEvent, steps: float) -> bool:
        """Raise the selected object; return False if nothing is selected."""
        return self.sink is not None and self.sink.wheel(event, steps)

    def remove(self, event: PointerEvent) -> bool:
        """Delete the object under the cursor; return False if that is not possible."""
        offers = () if self.sink is None else self.sink.offers(event)
        removing = next((offer for offer in offers if offer.removes), None)
        if removing is not None:
            removing.run()
        return removing is not None

    def show_pointer(self, lines: tuple[FloatArray, ...], event: PointerEvent | None) -> None:
        """Draw the keyboard cursor as lines (n, 3) and announce its position."""
        if lines or self.is_open:
            self.painter.show_lines("pointer", lines, self.painter.scheme.alarm, 2.5)
            self.request_render()
        if event is not None:
            self.hovered.emit(event)
        else:
            self.left.emit()

    def _event(self, phase: Phase, event: QMouseEvent | QWheelEvent) -> PointerEvent:
        position = event.position() + self._grip
        return PointerEvent(
            phase,
            self.subject,
            self.look,
            (position.x(), position.y()),
            self._hit(position),
            self._handle_at(position, self.grab_px),
            fine=_holds(event.modifiers(), Qt.KeyboardModifier.ControlModifier),
            coarse=_holds(event.modifiers(), Qt.KeyboardModifier.ShiftModifier),
        )

    def _hit(self, position: QPointF) -> FloatArray | None:
        if self._mesh is None or len(self._mesh.triangles) == 0:
            return None
        if self._picker is None:
            self._picker = SurfacePicker(self._mesh)
        return self._picker.pick(*self.look.ray_at(position.x(), position.y()))

    def _handle_at(self, position: QPointF, reach_px: float) -> str | None:
        """Return the name of the nearest handle, if it is near enough."""
        if not self.handles:
            return None
        distance = np.hypot(*self._ways_to(position, self.handles).T)
        nearest = int(np.argmin(distance))
        return self.handles[nearest].name if distance[nearest] <= reach_px else None

    def _way_to(self, position: QPointF, name: str) -> QPointF:
        """Return the way from a position to the nearest of the handles of a name."""
        ways = self._ways_to(position, [h for h in self.handles if h.name == name])
        return QPointF(*min(ways.tolist(), key=lambda way: np.hypot(*way)))

    def _ways_to(self, position: QPointF, handles: Sequence[Handle]) -> FloatArray:
        """Return the ways (n, 2) from a position to handles, px."""
        places = np.array([handle.position_mm for handle in handles])
        return np.asarray(self.look.pixels_of(places) - (position.x(), position.y()))


@cache
def _pixels_per_step(ratio: float) -> int:
    """Return the least number of the window's pixels that are whole pixels of the screen."""
    return Fraction(ratio).limit_denominator(MOST_STEPS).denominator


def _margins(start: int, length: int, step: int) -> tuple[int, int]:
    """Return the least margins before and after, within which all is whole steps of the window.

    Parameters
    ----------
    start, length
        Where in the window it begins, and how long it is.
    """
    before = FRAME_PX + -(start + FRAME_PX) % step
    return before, FRAME_PX + (start + length - FRAME_PX) % step


def _run(offer: OfferedItem, _checked: bool = False) -> None:
    offer.run()


def _holds(modifiers: Qt.KeyboardModifier, key: Qt.KeyboardModifier) -> bool:
    return bool(modifiers & key)
