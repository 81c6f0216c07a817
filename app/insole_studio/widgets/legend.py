"""Legends: of a colour map in the unit of its values, of named colours, of lengths."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import QPointF, QRectF, QSize, Qt
from PySide6.QtGui import QColor, QLinearGradient, QPainter, QPaintEvent, QPen
from PySide6.QtWidgets import QFrame, QHBoxLayout, QLabel, QWidget

from insole_studio.scene.coloring import MISSING, Coloring, Swatch
from insole_studio.texts import localised
from insole_studio.widgets.layouts import FlowLayout, remove_widgets

BAR_PX, LEAST_BAR_PX = 140, 60
NUMBER_PX = 72
SWATCH_PX = 14
WHOLE_FROM = 100.0
"""From this value on numbers are shown without decimals."""
_SWATCH_PX = 14
_ROUND_LENGTHS_MM = (1, 2, 5, 10, 20, 50, 100, 200)
LONGEST_PX = 120.0


class Legend(QWidget):
    """A colour strip between the limits of its map, with a title."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._coloring: Coloring | None = None
        self.setVisible(False)

    def show_coloring(self, coloring: Coloring | None) -> None:
        """Show another colour map; None hides the legend."""
        if coloring is not None and not coloring.title:
            coloring = None  # a picture, which has no scale of values
        before, self._coloring = self._coloring, coloring
        if _words(before) == _words(coloring):
            return  # other values, as in every picture of a drag: the panel is not laid out anew
        self.setVisible(coloring is not None)
        self.setToolTip("" if coloring is None else coloring.title)
        self.updateGeometry()
        self.update()

    def sizeHint(self) -> QSize:
        """Return a size for title, strip and two numbers."""
        return QSize(BAR_PX + 2 * NUMBER_PX + self._name_px + self._missing_px, 22)

    def minimumSizeHint(self) -> QSize:
        """Return a size with a short strip, without the title, which is then shown as tooltip."""
        return QSize(LEAST_BAR_PX + 2 * NUMBER_PX, 22)

    @property
    def _name_px(self) -> int:
        if self._coloring is None:
            return 0
        return self.fontMetrics().horizontalAdvance(self._coloring.title)

    @property
    def _missing_px(self) -> int:
        """Width of the swatch for missing values, with its text and a gap."""
        if self._coloring is None or not self._coloring.missing:
            return 0
        return SWATCH_PX + 18 + self.fontMetrics().horizontalAdvance(self._coloring.missing)

    def paintEvent(self, _event: QPaintEvent) -> None:
        """Draw the limits and the strip between them."""
        if self._coloring is None:
            return
        painter = QPainter(self)
        bar_px = max(LEAST_BAR_PX, min(BAR_PX, self.width() - 2 * NUMBER_PX))
        start = self.width() - bar_px - 2 * NUMBER_PX
        strip = QRectF(start + NUMBER_PX, 5, bar_px, self.height() - 10)
        gradient = QLinearGradient(strip.topLeft(), strip.topRight())
        for number, color in enumerate(self._coloring.colors):
            gradient.setColorAt(number / (len(self._coloring.colors) - 1), QColor(color))
        painter.fillRect(strip, gradient)
        decimals = 0 if max(abs(limit) for limit in self._coloring.limits) >= WHOLE_FROM else 1
        low, high = (
            localised(limit, f".{decimals}f").replace("-", "−") for limit in self._coloring.limits
        )
        high = f"≥ {high}" if self._coloring.is_clipped else high
        left = QRectF(start, 0, NUMBER_PX - 6, self.height())
        right = QRectF(strip.right() + 6, 0, NUMBER_PX, self.height())
        vertical = Qt.AlignmentFlag.AlignVCenter
        free = start
        if free >= self._missing_px:
            free -= self._missing_px
            self._paint_missing(painter, free)
        if free >= self._name_px:
            name = QRectF(free - self._name_px, 0, self._name_px, self.height())
            painter.drawText(name, vertical, self._coloring.title)
        painter.drawText(left, vertical | Qt.AlignmentFlag.AlignRight, low)
        painter.drawText(
            right, vertical | Qt.AlignmentFlag.AlignLeft, f"{high} {self._coloring.unit}"
        )
        painter.end()

    def _paint_missing(self, painter: QPainter, left: int) -> None:
        assert self._coloring is not None
        if not self._coloring.missing:
            return
        painter.fillRect(QRectF(left, 5, SWATCH_PX, self.height() - 10), QColor(MISSING))
        text = QRectF(left + SWATCH_PX + 6, 0, self._missing_px, self.height())
        painter.drawText(text, Qt.AlignmentFlag.AlignVCenter, self._coloring.missing)


def _words(coloring: Coloring | None) -> tuple[object, ...]:
    """Return all that a legend shows of a colour map."""
    if coloring is None:
        return ()
    return (
        coloring.title, coloring.limits, coloring.colors, coloring.unit, coloring.is_clipped,
        coloring.missing,
    )  # fmt: skip


class SwatchLegend(QWidget):
    """Squares of colour with their names, in lines; hidden while there are none."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._layout = FlowLayout(self, margin_px=0, gap_px=16)
        self._shown: tuple[Swatch, ...] = ()
        self.hide()

    @property
    def texts(self) -> tuple[str, ...]:
        """The names that are shown."""
        return tuple(swatch.text for swatch in self._shown)

    def show_swatches(self, swatches: Sequence[Swatch]) -> None:
        """Show colours with their names; none hides the legend."""
        if tuple(swatches) != self._shown:
            self._shown = tuple(swatches)
            remove_widgets(self._layout)
            for swatch in self._shown:
                self._layout.addWidget(_swatch(swatch))
        self.setVisible(bool(self._shown))


def _swatch(swatch: Swatch) -> QWidget:
    square, name, whole = QFrame(), QLabel(swatch.text), QWidget()
    square.setFixedSize(_SWATCH_PX, _SWATCH_PX)
    square.setStyleSheet(f"background: {_brush(swatch)}; border: 1px solid gray;")
    row = QHBoxLayout(whole)
    row.setContentsMargins(0, 0, 0, 0)
    row.setSpacing(6)
    row.addWidget(square)
    row.addWidget(name)
    return whole


def _brush(swatch: Swatch) -> str:
    """Return the ground of a swatch as a style sheet says it."""
    if not swatch.stripe:
        return swatch.color
    across = 0.5 if swatch.is_slanted else 0.0
    return (
        f"qlineargradient(spread:repeat, x1:0, y1:0, x2:{across}, y2:0.5, "
        f"stop:0 {swatch.color}, stop:0.49 {swatch.color}, stop:0.5 {swatch.stripe}, "
        f"stop:1 {swatch.stripe})"
    )


class ScaleBar(QWidget):
    """The longest round length that fits, drawn to scale."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._mm_per_px = 0.0
        self.setAttribute(Qt.WidgetAttribute.WA_TransparentForMouseEvents)

    def show_scale(self, mm_per_px: float) -> None:
        """Draw for another scale; 0 hides the bar."""
        self._mm_per_px = mm_per_px
        self.update()

    def sizeHint(self) -> QSize:
        """Return a size for bar and number."""
        return QSize(int(LONGEST_PX) + 64, 22)

    def minimumSizeHint(self) -> QSize:
        """Return the size hint: the bar does not shrink."""
        return self.sizeHint()

    @property
    def length_mm(self) -> int:
        """The drawn length."""
        longest = LONGEST_PX * self._mm_per_px
        fitting = [length for length in _ROUND_LENGTHS_MM if length <= longest]
        return fitting[-1] if fitting else _ROUND_LENGTHS_MM[0]

    def paintEvent(self, _event: QPaintEvent) -> None:
        """Draw bar, ends and number."""
        if self._mm_per_px <= 0:
            return
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.setPen(QPen(self.palette().windowText().color(), 1.5))
        width, middle = self.length_mm / self._mm_per_px, self.height() / 2
        painter.drawLine(QPointF(2, middle), QPointF(2 + width, middle))
        for x in (2.0, 2 + width):
            painter.drawLine(QPointF(x, middle - 4), QPointF(x, middle + 4))
        beside = self.rect().adjusted(round(width) + 10, 0, 0, 0)
        painter.drawText(beside, Qt.AlignmentFlag.AlignVCenter, f"{self.length_mm} mm")
        painter.end()
