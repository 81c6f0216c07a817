"""Layouts: a row that wraps, cards side by side, a column that scrolls."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from math import ceil

from PySide6.QtCore import QEvent, QMargins, QObject, QPoint, QRect, QSize, Qt, Signal
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import (
    QAbstractScrollArea,
    QFrame,
    QGridLayout,
    QLayout,
    QLayoutItem,
    QScrollArea,
    QScroller,
    QScrollerProperties,
    QWidget,
)

_GAP_PX = 8
_OVERSHOOT = QScrollerProperties.ScrollMetric.VerticalOvershootPolicy
_NEVER = QScrollerProperties.OvershootPolicy.OvershootAlwaysOff


def keep_room(widget: QWidget) -> None:
    """Let what stands beside a widget stay where it is while the widget comes and goes."""
    policy = widget.sizePolicy()
    policy.setRetainSizeWhenHidden(True)
    widget.setSizePolicy(policy)


def remove_widgets(layout: QLayout) -> None:
    """Hide the widgets of a layout, which go when the events are handled next."""
    while (item := layout.takeAt(0)) is not None:
        if (widget := item.widget()) is not None:
            widget.hide()
            widget.deleteLater()


class FlowLayout(QLayout):
    """Lays items out like text: left to right, then down; too wide an item gets its own line.

    Parameters
    ----------
    is_centred
        Whether each line stands in the middle; by default at the left.
    """

    def __init__(
        self, parent: QWidget, margin_px: int, gap_px: int, *, is_centred: bool = False
    ) -> None:
        super().__init__(parent)
        self._items: list[QLayoutItem] = []
        self._gap_px = gap_px
        self._is_centred = is_centred
        self.setContentsMargins(QMargins(margin_px, margin_px, margin_px, margin_px))

    def addItem(self, item: QLayoutItem) -> None:
        """Append an item."""
        self._items.append(item)
        self.invalidate()  # else those after a new one may stay where they are

    def count(self) -> int:
        """Return the number of items."""
        return len(self._items)

    def itemAt(self, index: int) -> QLayoutItem | None:
        """Return an item; None beyond the end."""
        return self._items[index] if 0 <= index < len(self._items) else None

    def takeAt(self, index: int) -> QLayoutItem | None:
        """Remove and return an item; None beyond the end."""
        return self._items.pop(index) if 0 <= index < len(self._items) else None

    def hasHeightForWidth(self) -> bool:
        """Return True: a narrower layout needs more lines."""
        return True

    def heightForWidth(self, width: int) -> int:
        """Return the height of all lines at this width."""
        return self._flow(QRect(0, 0, width, 0), place=False)

    def sizeHint(self) -> QSize:
        """Return the minimum size: the layout takes the space that there is."""
        return self.minimumSize()

    def minimumSize(self) -> QSize:
        """Return the size of the largest item."""
        size = QSize()
        for item in self._items:
            size = size.expandedTo(item.minimumSize())
        return size.grownBy(self.contentsMargins())

    def setGeometry(self, rect: QRect) -> None:
        """Place all items."""
        super().setGeometry(rect)
        self._flow(rect, place=True)

    def _flow(self, rect: QRect, place: bool) -> int:
        margins = self.contentsMargins()
        inner = rect.marginsRemoved(margins)
        y, lines = inner.top(), self._lines(inner.width())
        for line in lines:
            used_px = sum(size.width() for _, size in line) + self._gap_px * (len(line) - 1)
            x = inner.left() + ((inner.width() - used_px) // 2 if self._is_centred else 0)
            for item, size in line:
                if place:
                    item.setGeometry(QRect(QPoint(x, y), size))
                x += size.width() + self._gap_px
            y += max(size.height() for _, size in line) + self._gap_px
        return y - (self._gap_px if lines else 0) + margins.bottom() - rect.top()

    def _lines(self, width_px: int) -> list[list[tuple[QLayoutItem, QSize]]]:
        """Return the items of each line, with their sizes."""
        lines: list[list[tuple[QLayoutItem, QSize]]] = []
        x = 0
        for item in self._items:
            if item.isEmpty():  # hidden
                continue
            size = item.sizeHint()
            if size.width() > width_px:
                wraps = item.hasHeightForWidth()
                height = item.heightForWidth(width_px) if wraps else size.height()
                size = QSize(width_px, height)
            if not lines or x + size.width() > width_px:
                lines.append([])
                x = 0
            lines[-1].append((item, size))
            x += size.width() + self._gap_px
        return lines


class FlowRow(QWidget):
    """A row of widgets that wraps where there is no room for all of them."""

    def __init__(self, *parts: QWidget, gap_px: int = 8, is_centred: bool = False) -> None:
        super().__init__()
        self._layout = FlowLayout(self, 0, gap_px, is_centred=is_centred)
        self.show_parts(parts)

    def show_parts(self, parts: Iterable[QWidget]) -> None:
        """Show widgets in place of those before, which go."""
        remove_widgets(self._layout)
        for part in parts:
            self._layout.addWidget(part)


class CardGrid(QScrollArea):
    """Cards of equal width, in rows of equal length as far as possible."""

    wrapped = Signal(bool)
    """Whether the cards need more than one row by now."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setFrameShape(QFrame.Shape.NoFrame)
        self.setWidgetResizable(True)
        self.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAsNeeded)
        self._cards: list[QWidget] = []
        self._columns = 0
        self.is_wrapped = False
        self._inner = QWidget()
        self._layout = QGridLayout(self._inner)
        self._layout.setContentsMargins(0, 0, 0, 0)
        self._layout.setSpacing(_GAP_PX)
        self.setWidget(self._inner)

    def show_cards(self, cards: Sequence[QWidget]) -> None:
        """Show these cards in this order; those that are no longer there are taken out."""
        if list(cards) != self._cards:
            for card in self._cards:
                self._layout.removeWidget(card)
            self._cards = list(cards)
            self._place()

    def minimumSizeHint(self) -> QSize:
        """Return the size of one card: the rest can be scrolled to."""
        size = QSize(0, 0)
        for card in self._cards:
            size = size.expandedTo(card.minimumSizeHint())
        return size.grownBy(self._layout.contentsMargins())

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Wrap anew."""
        super().resizeEvent(event)
        if self._columns_that_fit() != self._columns:
            self._place()

    def _columns_that_fit(self) -> int:
        count = len(self._cards)
        if not count:
            return 0
        least_px = max(card.minimumSizeHint().width() for card in self._cards) + _GAP_PX
        most = max(1, (self.width() + _GAP_PX) // least_px)
        return ceil(count / ceil(count / most))

    def _place(self) -> None:
        for column in range(self._columns):
            self._layout.setColumnStretch(column, 0)
        self._columns = self._columns_that_fit()
        for place, card in enumerate(self._cards):
            self._layout.addWidget(card, *divmod(place, self._columns))
        for column in range(self._columns):
            self._layout.setColumnStretch(column, 1)
        if self.is_wrapped != (self._columns < len(self._cards)):
            self.is_wrapped = not self.is_wrapped
            self.wrapped.emit(self.is_wrapped)


def scroll_by_finger(area: QAbstractScrollArea) -> None:
    """Enable kinetic scrolling by touch; the mouse works as before."""
    viewport = area.viewport()
    QScroller.grabGesture(viewport, QScroller.ScrollerGestureType.TouchGesture)
    scroller = QScroller.scroller(viewport)
    properties = scroller.scrollerProperties()
    properties.setScrollMetric(_OVERSHOOT, _NEVER)
    scroller.setScrollerProperties(properties)


class VerticalScroll(QScrollArea):
    """Scroll area as wide as its content, which cannot be scrolled sideways."""

    needs_changed = Signal()
    """The content needs another width by now."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setWidgetResizable(True)
        self.setFrameShape(QFrame.Shape.NoFrame)
        self.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self._told_px = 0
        scroll_by_finger(self)

    @property
    def needed_px(self) -> int:
        """Width of the content and the scroll bar."""
        content = self.widget()
        inside = 0 if content is None else content.minimumSizeHint().width()
        return inside + self.verticalScrollBar().sizeHint().width()

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Ask for room when the content needs another width than it was given."""
        if event.type() == QEvent.Type.LayoutRequest and self.needed_px != self._told_px:
            self._told_px = self.needed_px
            self.updateGeometry()
            self.needs_changed.emit()
        return super().eventFilter(watched, event)

    def minimumSizeHint(self) -> QSize:
        """Return a size as wide as the content."""
        return QSize(self.needed_px, super().minimumSizeHint().height())
