"""The hand of a journey: what a user does with a mouse, fingers or keys, by real events."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np
from PySide6.QtCore import QPoint, Qt
from PySide6.QtGui import QAction, QPointingDevice
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QMenu, QToolButton, QWidget

from insole_core.geometry.arrays import FloatArray
from insole_studio.app.main_window import MainWindow
from insole_studio.scene.scene_view import SceneView

LEFT = Qt.MouseButton.LeftButton
Nothing = Callable[[], None]


class Hand:
    """Points and types; a mouse unless a subclass says otherwise.

    Parameters
    ----------
    window
        The main window.
    settle
        Waits until what was done is shown.
    """

    touch = False

    def __init__(self, window: MainWindow, settle: Nothing) -> None:
        self.window = window
        self.settle = settle

    def choose(self, key: str) -> None:
        """Take an action: its button in a toolbar, else its line in a menu."""
        action = self.window.actions_by_key[key]
        button = _button_of(self.window, action)
        if button is not None:
            self.click(button)
            return
        menu_action = next(a for a in self.window.menuBar().actions() if _holds(a, action))
        self.open_menu(menu_action)
        menu = menu_action.menu()
        assert isinstance(menu, QMenu)
        self.point(menu, menu.actionGeometry(action).center())
        self.settle()

    def open_menu(self, action: QAction) -> None:
        """Open a menu of the menu bar."""
        bar = self.window.menuBar()
        self.point(bar, bar.actionGeometry(action).center())
        QApplication.processEvents()

    def click(self, widget: QWidget) -> None:
        """Click in the middle of a widget."""
        self.point(widget, widget.rect().center())
        self.settle()

    def point(self, widget: QWidget, at: QPoint) -> None:
        """Press and release at a place of a widget."""
        QTest.mouseClick(widget, LEFT, pos=at)

    def tap(self, scene: SceneView, place_mm: Sequence[float]) -> None:
        """Click at a place of the insole frame."""
        self.point(scene.surface, pixel(scene, np.array(place_mm)))
        self.settle()

    def carry(self, scene: SceneView, *way: QPoint) -> None:
        """Press, go along a way, and hold; `let_go` ends it."""
        QTest.mousePress(scene.surface, LEFT, pos=way[0])
        for place in way[1:]:
            QTest.mouseMove(scene.surface, place)
            QApplication.processEvents()

    def let_go(self, scene: SceneView, at: QPoint) -> None:
        """Release what is carried."""
        QTest.mouseRelease(scene.surface, LEFT, pos=at)
        self.settle()

    def type(self, field: QWidget, text: str) -> None:
        """Type into a field, and Enter."""
        self.point(field, QPoint(12, field.height() // 2))
        QTest.keyClick(field, Qt.Key.Key_A, Qt.KeyboardModifier.ControlModifier)
        QTest.keyClicks(field, text)
        QTest.keyClick(field, Qt.Key.Key_Return)
        self.settle()


class Fingers(Hand):
    """Touches; the window is in touch mode."""

    touch = True

    def __init__(self, window: MainWindow, settle: Nothing) -> None:
        super().__init__(window, settle)
        self._screen: QPointingDevice = QTest.createTouchDevice()

    def point(self, widget: QWidget, at: QPoint) -> None:
        """Touch a place of a widget."""
        self._touch(widget, "press", at)
        self._touch(widget, "release", at)
        QApplication.processEvents()

    def carry(self, scene: SceneView, *way: QPoint) -> None:
        """Touch, go along a way, and hold."""
        self._touch(scene.surface, "press", way[0])
        for place in way[1:]:
            self._touch(scene.surface, "move", place)
            QApplication.processEvents()

    def let_go(self, scene: SceneView, at: QPoint) -> None:
        """Lift the finger."""
        self._touch(scene.surface, "release", at)
        self.settle()

    def _touch(self, widget: QWidget, what: str, at: QPoint) -> None:
        top = widget.window()
        handle = top.windowHandle()
        event = QTest.touchEvent(handle, self._screen, False)
        getattr(event, what)(0, widget.mapTo(top, at), handle)
        event.commit()


class Keys(Hand):
    """Strikes keys, which go where the focus is; no pointer at all."""

    def choose(self, key: str) -> None:
        """Take an action by its shortcut, else by its line in a menu."""
        action = self.window.actions_by_key[key]
        if not action.shortcut().isEmpty():
            self.strike_sequence(action)
            return
        title = next(a for a in self.window.menuBar().actions() if _holds(a, action))
        self.open_menu(title)
        menu = title.menu()
        assert isinstance(menu, QMenu)
        for _ in menu.actions():
            if menu.activeAction() is action:
                break
            QTest.keyClick(menu, Qt.Key.Key_Down)
        QTest.keyClick(menu, Qt.Key.Key_Return)
        self.settle()

    def open_menu(self, action: QAction) -> None:
        """Open a menu with Alt and its letter."""
        text = action.text()
        letter = text[text.index("&") + 1]
        self._strike(Qt.Key(ord(letter.upper())), Qt.KeyboardModifier.AltModifier)

    def strike_sequence(self, action: QAction) -> None:
        """Strike the shortcut of an action."""
        combination = action.shortcut()[0]  # type: ignore[index] # its stubs forget it
        self._strike(combination.key(), combination.keyboardModifiers())
        self.settle()

    def click(self, widget: QWidget) -> None:
        """Go to a widget and press it."""
        widget.setFocus(Qt.FocusReason.TabFocusReason)
        QTest.keyClick(widget, Qt.Key.Key_Space)
        self.settle()

    def tap(self, scene: SceneView, place_mm: Sequence[float]) -> None:
        """Press Enter where the cross is; it starts where the tool is usually used."""
        scene.surface.setFocus(Qt.FocusReason.TabFocusReason)
        QTest.keyClick(scene.surface, Qt.Key.Key_Return)
        self.settle()

    def carry(self, scene: SceneView, *way: QPoint) -> None:
        """Hold with Space, and go on with the arrows."""
        scene.surface.setFocus(Qt.FocusReason.TabFocusReason)
        QTest.keyClick(scene.surface, Qt.Key.Key_Space)
        for _ in way[1:]:
            for _ in range(3):
                QTest.keyClick(scene.surface, Qt.Key.Key_Right, Qt.KeyboardModifier.ShiftModifier)
            QApplication.processEvents()

    def let_go(self, scene: SceneView, at: QPoint) -> None:
        """Let go with Space."""
        QTest.keyClick(scene.surface, Qt.Key.Key_Space)
        self.settle()

    def type(self, field: QWidget, text: str) -> None:
        """Go to a field, type, Enter, and with Escape back to the view."""
        field.setFocus(Qt.FocusReason.TabFocusReason)
        QTest.keyClick(field, Qt.Key.Key_A, Qt.KeyboardModifier.ControlModifier)
        QTest.keyClicks(field, text)
        QTest.keyClick(field, Qt.Key.Key_Return)
        QTest.keyClick(field, Qt.Key.Key_Escape)
        self.settle()

    def _strike(self, key: Qt.Key, modifiers: Qt.KeyboardModifier) -> None:
        active = QApplication.activeWindow()
        if active is None:  # no window manager gives it back after a menu
            active = self.window
            active.activateWindow()
            QTest.qWaitForWindowActive(active)
        QTest.keyClick(active.windowHandle(), key, modifiers)
        QApplication.processEvents()


HANDS: dict[str, type[Hand]] = {"mouse": Hand, "touch": Fingers, "keyboard": Keys}


def pixel(scene: SceneView, place_mm: FloatArray) -> QPoint:
    """Return where a place of the insole frame is seen."""
    place = np.zeros(3)
    place[: len(place_mm)] = place_mm
    x, y = scene.look.pixels_of(place)[0]
    return QPoint(round(x), round(y))


def _button_of(window: MainWindow, action: QAction) -> QToolButton | None:
    buttons = window.findChildren(QToolButton)
    return next((b for b in buttons if b.isVisible() and b.defaultAction() is action), None)


def _holds(title: QAction, action: QAction) -> bool:
    menu = title.menu()
    return isinstance(menu, QMenu) and action in menu.actions()
