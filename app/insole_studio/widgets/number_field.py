"""An input field for a length or an angle, with decimal comma or point, and one with a slider."""

from __future__ import annotations

import re
from decimal import ROUND_HALF_UP, Decimal

from PySide6.QtCore import QEvent, QSignalBlocker, Qt, Signal
from PySide6.QtGui import QHideEvent, QKeyEvent, QValidator, QWheelEvent
from PySide6.QtWidgets import QDoubleSpinBox, QHBoxLayout, QSlider, QWidget

from insole_studio.texts import tr
from insole_studio.widgets.text_fields import ValidationBubble

TOUCH_HEIGHT_PX = 36
"""Fields higher than this are styled for touch."""
TOUCH_BUTTONS_PX = 84
COARSE = 10.0
FINE = 0.1
_OF_THE_WINDOW = (Qt.Key.Key_Z, Qt.Key.Key_Y, Qt.Key.Key_E)
"""With Ctrl these undo, redo and export the whole case instead of editing the field."""
_UNFINISHED = ("", "-", ".", ",", "-.", "-,")
"""Beginnings of a number, which need no explanation."""
_NUMBER = re.compile(r"[-+]?(\d+([.,]\d*)?|[.,]\d+)")
_SLIDER_PX = 116


class NumberField(QDoubleSpinBox):
    """A number with its unit. Shift makes a step ten times as large, Ctrl a tenth.

    The unit may be typed. A number out of range is rejected with a message when it is entered: 40
    must never become 4. One with more decimals than the field has is rounded, with a message.
    """

    edited = Signal(float)
    """Emitted when the user, not the program, entered another value."""

    _least_known = 0.0  # of the class, since Qt validates before the constructor is done

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
        self.setRange(least, greatest)
        self.setDecimals(decimals)
        self.setSingleStep(step)
        self.setSuffix(f" {unit}" if unit else "")
        self.setKeyboardTracking(False)
        self.setAlignment(Qt.AlignmentFlag.AlignRight)
        self.valueChanged.connect(self.edited)
        self._room_px = 0
        self._typed = ""
        self.refusal = ValidationBubble(self)
        self.lineEdit().textEdited.connect(self._note_typed)
        self.editingFinished.connect(self._say_rounded)

    @property
    def is_for_fingers(self) -> bool:
        """Whether the field is styled for touch."""
        self.ensurePolished()
        return self.sizeHint().height() > TOUCH_HEIGHT_PX

    def allow_unknown(self, least_known: float) -> None:
        """Let 0 mean that the number is unknown; the least that can be known is larger."""
        self._least_known = least_known

    def set_room(self, width_px: int) -> None:
        """Fix the width of the field, to which touch mode, now or later, adds its buttons."""
        self._room_px = width_px
        self.setFixedWidth(width_px + (TOUCH_BUTTONS_PX if self.is_for_fingers else 0))

    def show_value(self, value: float) -> None:
        """Show a value without emitting `edited`; text being typed is kept."""
        if self.value() != value:
            with QSignalBlocker(self):
                self.setValue(value)

    def show_range(self, least: float, greatest: float) -> None:
        """Set the range without emitting `edited`; selection and text being typed are kept."""
        if (least, greatest) != (self.minimum(), self.maximum()):
            with QSignalBlocker(self):
                self.setRange(least, greatest)

    def changeEvent(self, event: QEvent) -> None:
        """Make room for the buttons when touch mode begins, and take it back when it ends."""
        super().changeEvent(event)
        if event.type() is QEvent.Type.StyleChange and self._room_px:
            self.set_room(self._room_px)

    def hideEvent(self, event: QHideEvent) -> None:
        """Hide the validation bubble as well: it is a window of its own."""
        super().hideEvent(event)
        self.refusal.hide()

    def event(self, event: QEvent) -> bool:
        """Leave the window's shortcuts to the window, after committing the typed number.

        A letter begins no number, so it is the key of a tool, unless a number is being typed.
        """
        if isinstance(event, QKeyEvent) and event.type() == QEvent.Type.ShortcutOverride:
            control = event.modifiers() & Qt.KeyboardModifier.ControlModifier
            if control and event.key() in _OF_THE_WINDOW:
                self.interpretText()
                event.ignore()
                return False
            if event.text().isalpha() and not self._is_typed():
                event.ignore()
                return False
        return super().event(event)

    def validate(self, text: str, position: int) -> tuple[QValidator.State, str, int]:
        """Accept comma, point and the unit; what is no number of the range is rejected later.

        A key that is swallowed would make another number of what was typed: 11 of 1e1.
        """
        number = self._number(text)
        is_taken = number is not None and not self._is_beyond(self._rounded(number))
        state = QValidator.State.Acceptable if is_taken else QValidator.State.Intermediate
        return (state, text, position)

    def fixup(self, text: str) -> str:
        """Explain why a number is rejected, and return the previous value."""
        if self._bare(text) not in _UNFINISHED:
            least, greatest, before = map(
                self.textFromValue, (self.minimum(), self.maximum(), self.value())
            )
            sentence = tr(
                "{typed} cannot be taken; put in {least} to {greatest}. It stays {before}."
            )
            if self._least_known > 0:
                least = self.textFromValue(self._least_known)
                sentence = tr(
                    "{typed} cannot be taken; put in {least} to {greatest}, or 0 if it is not "
                    "known. It stays {before}."
                )
            typed = self._bare(text)
            self.refusal.say(
                sentence.format(
                    typed=typed + self.suffix() if typed[-1:].isdigit() else typed,
                    least=least,
                    greatest=greatest + self.suffix(),
                    before=before + self.suffix(),
                )
            )
        return text

    def valueFromText(self, text: str) -> float:
        """Parse a number with comma or point, rounded to the decimals of the field."""
        number = self._number(text)
        return self.value() if number is None else self._rounded(number)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Step with the arrow keys; Escape restores the value."""
        if event.key() == Qt.Key.Key_Escape:
            event.setAccepted(self._forget_typed())  # the next Escape returns to the view
            return
        direction = {Qt.Key.Key_Up: 1, Qt.Key.Key_Down: -1}.get(Qt.Key(event.key()))
        if direction is None:
            super().keyPressEvent(event)
        else:
            self._nudge(direction, event.modifiers())

    def wheelEvent(self, event: QWheelEvent) -> None:
        """Step with the wheel; Shift and Alt may make it report horizontal scrolling."""
        turn = event.angleDelta().y() or event.angleDelta().x()
        self._nudge(turn / 120, event.modifiers())
        event.accept()

    def _forget_typed(self) -> bool:
        """Replace what is being typed by the value; return False if both are the same."""
        if not self._is_typed():
            return False
        shown = self.textFromValue(self.value())
        self.lineEdit().setText(f"{self.prefix()}{shown}{self.suffix()}")
        self.selectAll()
        return True

    def _is_typed(self) -> bool:
        return self.cleanText() != self.textFromValue(self.value())

    def _nudge(self, steps: float, modifiers: Qt.KeyboardModifier) -> None:
        factor = 1.0
        if modifiers & Qt.KeyboardModifier.ShiftModifier:
            factor = COARSE
        elif modifiers & Qt.KeyboardModifier.ControlModifier:
            factor = FINE
        self.interpretText()
        smallest = 10.0 ** -self.decimals()
        value = self.value() + steps * max(factor * self.singleStep(), smallest)
        if 0 < value < self._least_known:
            value = self._least_known if steps > 0 else 0.0
        self.setValue(value)

    def _note_typed(self, text: str) -> None:
        self._typed = text
        self.refusal.hide()

    def _say_rounded(self) -> None:
        typed, self._typed = self._bare(self._typed), ""
        number = self._number(typed)
        if number is None:
            return
        rounded = self._rounded(number)
        if rounded == self.value() and Decimal(str(rounded)) != number:
            self.refusal.say(
                tr("{typed} is taken as {rounded}.").format(
                    typed=typed + self.suffix(), rounded=self.text()
                )
            )

    def _is_beyond(self, value: float) -> bool:
        return 0 < value < self._least_known or not self.minimum() <= value <= self.maximum()

    def _rounded(self, number: Decimal) -> float:
        smallest = Decimal(1).scaleb(-self.decimals())
        return float(number.quantize(smallest, ROUND_HALF_UP))

    def _number(self, text: str) -> Decimal | None:
        bare = self._bare(text)
        return Decimal(bare.replace(",", ".")) if _NUMBER.fullmatch(bare) else None

    def _bare(self, text: str) -> str:
        """Return what is typed without the unit, which a user may have typed once more."""
        unit = self.suffix().strip()
        bare = text.removeprefix(self.prefix()).strip()
        while unit and bare.endswith(unit):
            bare = bare.removesuffix(unit).strip()
        return bare


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
        self.slider.setFixedWidth(_SLIDER_PX)
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
