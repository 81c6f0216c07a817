"""A number with a slider beside it: dragged while one looks at the result, or typed."""

from __future__ import annotations

from PySide6.QtCore import QEvent, QSignalBlocker, Qt, Signal
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import QHBoxLayout, QSlider, QWidget

from insole_studio.widgets.number_field import NumberField

SLIDER_PX = 116


class SliderField(QWidget):
    """A slider in steps of the field, and the field itself, which also takes what lies between."""

    edited = Signal(float)
    """Emitted when the user, not the program, entered another value; after a drag once."""
    moved = Signal(float)
    """Emitted while the slider is dragged: the value that a release would enter."""
    cancelled = Signal()
    """Emitted when a drag is taken back by Escape."""

    def __init__(
        self,
        unit: str,
        *,
        least: float,
        greatest: float,
        step: float,
        decimals: int = 1,
        parent: QWidget | None = None,
    ) -> None:
        super().__init__(parent)
        self._step = step
        self.number = NumberField(
            unit, least=least, greatest=greatest, step=step, decimals=decimals
        )
        self.number.edited.connect(self._enter)
        self.slider = _Slider(Qt.Orientation.Horizontal)
        self.slider.setFocusPolicy(Qt.FocusPolicy.ClickFocus)  # by keyboard the number is set
        self.slider.setFixedWidth(SLIDER_PX)
        self.slider.setPageStep(round(2 / step))
        self.slider.valueChanged.connect(self._slide)
        self.slider.sliderReleased.connect(self._enter_slid)
        self.slider.given_up.connect(self.cancelled)
        row = QHBoxLayout(self)
        row.setContentsMargins(0, 0, 0, 0)
        row.setSpacing(6)
        row.addWidget(self.slider)
        row.addWidget(self.number)
        self.setFocusProxy(self.number)
        self.show_range(least, greatest)

    def show_value(self, value: float) -> None:
        """Show a value without emitting anything; a slider that is held stays in the hand."""
        self.number.show_value(value)
        if not self.slider.isSliderDown():
            with QSignalBlocker(self.slider):
                self.slider.setValue(round(value / self._step))

    def show_range(self, least: float, greatest: float) -> None:
        """Set the range without emitting anything."""
        self.number.show_range(least, greatest)
        with QSignalBlocker(self.slider):
            self.slider.setRange(round(least / self._step), round(greatest / self._step))

    def set_room(self, width_px: int) -> None:
        """Fix the width of the number."""
        self.number.set_room(width_px)

    def describe(self, name: str, tip: str) -> None:
        """Name both for screen readers, and explain them."""
        for part in (self.number, self.slider):
            part.setAccessibleName(name)
            part.setAccessibleDescription(tip)
            part.setToolTip(tip)

    def _slide(self, place: int) -> None:
        value = place * self._step
        if self.slider.isSliderDown():
            self.number.show_value(value)
            self.moved.emit(value)
        else:
            self._enter(value)

    def _enter_slid(self) -> None:
        self._enter(self.slider.value() * self._step)

    def _enter(self, value: float) -> None:
        self.show_value(value)
        self.edited.emit(value)


class _Slider(QSlider):
    """A slider that Escape takes back."""

    given_up = Signal()

    def event(self, event: QEvent) -> bool:
        """Take Escape before the window does while the slider is held."""
        is_override = event.type() == QEvent.Type.ShortcutOverride
        if is_override and isinstance(event, QKeyEvent) and self._is_given_up(event):
            event.accept()
            return True
        return super().event(event)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Give the drag up on Escape."""
        if self._is_given_up(event):
            with QSignalBlocker(self):
                self.setSliderDown(False)
            self.given_up.emit()
        else:
            super().keyPressEvent(event)

    def _is_given_up(self, event: QKeyEvent) -> bool:
        return self.isSliderDown() and event.key() == Qt.Key.Key_Escape
