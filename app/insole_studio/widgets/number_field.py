"""An input field for a length or an angle, with decimal comma or point."""

from __future__ import annotations

from PySide6.QtCore import QEvent, QSignalBlocker, Qt, Signal
from PySide6.QtGui import QHideEvent, QKeyEvent, QValidator, QWheelEvent
from PySide6.QtWidgets import QDoubleSpinBox, QWidget

from insole_studio.texts import tr
from insole_studio.widgets.validation_bubble import ValidationBubble

TOUCH_HEIGHT_PX = 36
"""Fields higher than this are styled for touch."""
TOUCH_BUTTONS_PX = 84
COARSE = 10.0
FINE = 0.1
_OF_THE_WINDOW = (Qt.Key.Key_Z, Qt.Key.Key_Y, Qt.Key.Key_E)
"""With Ctrl these undo, redo and export the whole case instead of editing the field."""

_UNFINISHED = ("", "-", ".", ",", "-.", "-,")
"""Beginnings of a number, which need no explanation."""


class NumberField(QDoubleSpinBox):
    """A number with its unit. Shift makes a step ten times as large, Ctrl a tenth.

    A number out of range can be typed and is rejected with a message: 40 must never become 4.
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
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.valueChanged.connect(self.edited)
        self._room_px = 0
        self.refusal = ValidationBubble(self)
        self.lineEdit().textEdited.connect(self.refusal.hide)

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
        """Accept comma and point; what is no number of the range is rejected when committed.

        A key that is swallowed would make another number of what was typed: 11 of 1e1.
        """
        state, localised, position = super().validate(self._localised(text), position)
        if state == QValidator.State.Invalid or self._is_beyond(text):
            return (QValidator.State.Intermediate, text, position)
        return (state, localised, position)

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
            self.refusal.say(
                sentence.format(
                    typed=self._bare(text) + self.suffix(),
                    least=least,
                    greatest=greatest + self.suffix(),
                    before=before + self.suffix(),
                )
            )
        return text

    def valueFromText(self, text: str) -> float:
        """Parse a number with comma or point."""
        return super().valueFromText(self._localised(text))

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

    def _is_beyond(self, text: str) -> bool:
        value, is_number = self.locale().toDouble(self._localised(self._bare(text)))
        if not is_number:
            return False
        return 0 < value < self._least_known or not self.minimum() <= value <= self.maximum()

    def _bare(self, text: str) -> str:
        return text.removesuffix(self.suffix()).strip()

    def _localised(self, text: str) -> str:
        point = self.locale().decimalPoint()
        return text.replace(",", point).replace(".", point)
