"""The tab order: from control to control in reading order.

Qt follows the order of construction, which puts rows added later last. Here the order is taken
from the layouts each time it is needed.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from PySide6.QtCore import Qt
from PySide6.QtGui import QKeyEvent, QKeySequence, QShortcut
from PySide6.QtWidgets import QApplication, QLayout, QScrollArea, QSplitter, QVBoxLayout, QWidget

from insole_studio.widgets.screen_room import Scrolled, Shrunk


def tab_stops(root: QWidget) -> Iterator[QWidget]:
    """Yield the tab stops inside a widget, in reading order."""
    if not root.isVisible():
        return
    if _is_stop(root):
        yield root
        return
    for part in _parts(root):
        yield from tab_stops(part)


def go_on(roots: Sequence[QWidget], forward: bool) -> bool:
    """Move the focus to the next or previous tab stop.

    Parameters
    ----------
    roots
        Widgets in reading order.
    forward
        Whether to go to the next stop rather than the previous one.

    Returns
    -------
    bool
        False if there are no stops; the order is cyclic.
    """
    stops = [stop for root in roots for stop in tab_stops(root)]
    if not stops:
        return False
    at = _place_of(QApplication.focusWidget(), stops)
    step = 1 if forward else -1
    start = at if at is not None else (-1 if forward else 0)
    reason = Qt.FocusReason.TabFocusReason if forward else Qt.FocusReason.BacktabFocusReason
    give_focus(stops[(start + step) % len(stops)], reason)
    return True


def give_focus(
    widget: QWidget, reason: Qt.FocusReason = Qt.FocusReason.ShortcutFocusReason
) -> None:
    """Give a widget the focus, and scroll to it."""
    widget.setFocus(reason)
    above = widget.parentWidget()
    while above is not None:
        if isinstance(above, QScrollArea):
            above.ensureWidgetVisible(widget, 8, 8)
        above = above.parentWidget()


class StageFrame(QWidget):
    """Window of a stage: tab order in reading order; Ctrl+W closes it, Escape goes back."""

    def __init__(self) -> None:
        super().__init__()
        QShortcut(QKeySequence("Ctrl+W"), self, self.close)

    def hold(self, content: QWidget) -> None:
        """Fill the window with its content, which scrolls on a screen that is too small for it."""
        layout = QVBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.addWidget(Scrolled(Shrunk(content)))

    def focusNextPrevChild(self, forward: bool) -> bool:
        """Move the focus in reading order."""
        return go_on([self], forward) if self.isWindow() else super().focusNextPrevChild(forward)

    def go_back(self) -> None:
        """Do what Escape asks for; nothing where closing would lose what was captured or made."""

    def step_aside(self) -> None:
        """Make room for the main window; nothing where closing would lose what was captured."""

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Go back on Escape, unless a widget in the window has handled the key."""
        if event.key() == Qt.Key.Key_Escape:
            self.go_back()
        else:
            super().keyPressEvent(event)


def _is_stop(widget: QWidget) -> bool:
    takes_tab = widget.focusPolicy() & Qt.FocusPolicy.TabFocus
    return bool(takes_tab) and widget.isEnabled() and not isinstance(widget, QScrollArea)


def _parts(widget: QWidget) -> list[QWidget]:
    if isinstance(widget, QScrollArea):
        content = widget.widget()
        return [] if content is None else [content]
    if isinstance(widget, QSplitter):
        parts = (widget.widget(number) for number in range(widget.count()))
        return [part for part in parts if part is not None]
    layout = widget.layout()
    if layout is not None:
        return list(_laid_out(layout))
    children = widget.findChildren(QWidget, options=Qt.FindChildOption.FindDirectChildrenOnly)
    return sorted(children, key=lambda child: (child.y(), child.x()))


def _laid_out(layout: QLayout) -> Iterator[QWidget]:
    for number in range(layout.count()):
        item = layout.itemAt(number)
        if item is None:
            continue
        inner, widget = item.layout(), item.widget()
        if inner is not None:
            yield from _laid_out(inner)
        elif widget is not None:
            yield widget


def _place_of(focused: QWidget | None, stops: Sequence[QWidget]) -> int | None:
    """Return the index of the stop that holds the focus."""
    for number, stop in enumerate(stops):
        if focused is stop or (focused is not None and stop.isAncestorOf(focused)):
            return number
    return None
