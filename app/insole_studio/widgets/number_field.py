"""A field for one length or angle: typed with comma or point, nudged, or scrolled."""

from __future__ import annotations

from PySide6.QtCore import QEvent, QSignalBlocker, Qt, Signal
from PySide6.QtGui import QHideEvent, QKeyEvent, QValidator, QWheelEvent
from PySide6.QtWidgets import QDoubleSpinBox, QWidget

from insole_studio.texts import tr
from insole_studio.widgets.validation_bubble import ValidationBubble

TOUCH_HEIGHT_PX = 36
"""A field that is higher is made for fingers."""
TOUCH_BUTTONS_PX = 84
COARSE = 10.0
FINE = 0.1
_OF_THE_WINDOW = (Qt.Key.Key_Z, Qt.Key.Key_Y, Qt.Key.Key_E)
"""With Ctrl these mean undo, redo and export of the whole case, not something inside the field."""

_BEGUN = ("-", "-.", "-,")
"""The begin of a number below zero."""


class NumberField(QDoubleSpinBox):
    """A number with its unit. Shift makes a step ten times as large, Ctrl a tenth.

    A number beyond the range can be typed, and is refused in words: 40 must never be read as 4.
    """

    edited = Signal(float)
    """The user, not the program, gave another value."""

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
        self.refusal = ValidationBubble(self)
        self.lineEdit().textEdited.connect(self.refusal.hide)

    @property
    def is_for_fingers(self) -> bool:
        """Whether the style makes it a target for fingers."""
        self.ensurePolished()
        return self.sizeHint().height() > TOUCH_HEIGHT_PX

    def room_px(self, width_px: int) -> int:
        """Give the width for a field of this width; fingers get their buttons beside it."""
        return width_px + (TOUCH_BUTTONS_PX if self.is_for_fingers else 0)

    def show_value(self, value: float) -> None:
        """Show a value without `edited`; what is being typed stays."""
        if self.value() != value:
            with QSignalBlocker(self):
                self.setValue(value)

    def show_range(self, least: float, greatest: float) -> None:
        """Take another range without `edited`; what is selected or typed stays."""
        if (least, greatest) != (self.minimum(), self.maximum()):
            with QSignalBlocker(self):
                self.setRange(least, greatest)

    def hideEvent(self, event: QHideEvent) -> None:
        """Take the refusal away as well: it is a window of its own."""
        super().hideEvent(event)
        self.refusal.hide()

    def event(self, event: QEvent) -> bool:
        """Leave the window's own shortcuts to the window; the typed number is taken first."""
        if isinstance(event, QKeyEvent) and event.type() == QEvent.Type.ShortcutOverride:
            control = event.modifiers() & Qt.KeyboardModifier.ControlModifier
            if control and event.key() in _OF_THE_WINDOW:
                self.interpretText()
                event.ignore()
                return False
        return super().event(event)

    def validate(self, text: str, position: int) -> tuple[QValidator.State, str, int]:
        """Accept comma and point alike; a number beyond the range waits to be refused."""
        if self._is_beyond(text) or self._bare(text) in _BEGUN:
            return (QValidator.State.Intermediate, text, position)
        return super().validate(self._localised(text), position)

    def fixup(self, text: str) -> str:
        """Say why a number cannot be taken; the one before comes back."""
        if self._is_beyond(text):
            least, greatest, before = map(
                self.textFromValue, (self.minimum(), self.maximum(), self.value())
            )
            sentence = tr(
                "{typed} cannot be taken; put in {least} to {greatest}. It stays {before}."
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
        """Read comma and point alike."""
        return super().valueFromText(self._localised(text))

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Nudge by the arrow keys; Escape leaves the value as it was."""
        if event.key() == Qt.Key.Key_Escape:
            event.setAccepted(self._forget_typed())  # the next one leads back to the view
            return
        direction = {Qt.Key.Key_Up: 1, Qt.Key.Key_Down: -1}.get(Qt.Key(event.key()))
        if direction is None:
            super().keyPressEvent(event)
        else:
            self._nudge(direction, event.modifiers())

    def wheelEvent(self, event: QWheelEvent) -> None:
        """Nudge by the wheel; Shift and Alt may turn it sideways."""
        turn = event.angleDelta().y() or event.angleDelta().x()
        self._nudge(turn / 120, event.modifiers())
        event.accept()

    def _forget_typed(self) -> bool:
        """Show the value again in the place of what is being typed; False when that is the same."""
        shown = self.textFromValue(self.value())
        if self.cleanText() == shown:
            return False
        self.lineEdit().setText(f"{self.prefix()}{shown}{self.suffix()}")
        self.selectAll()
        return True

    def _nudge(self, steps: float, modifiers: Qt.KeyboardModifier) -> None:
        factor = 1.0
        if modifiers & Qt.KeyboardModifier.ShiftModifier:
            factor = COARSE
        elif modifiers & Qt.KeyboardModifier.ControlModifier:
            factor = FINE
        self.interpretText()
        smallest = 10.0 ** -self.decimals()
        self.setValue(self.value() + steps * max(factor * self.singleStep(), smallest))

    def _is_beyond(self, text: str) -> bool:
        value, is_number = self.locale().toDouble(self._localised(self._bare(text)))
        return is_number and not self.minimum() <= value <= self.maximum()

    def _bare(self, text: str) -> str:
        return text.removesuffix(self.suffix()).strip()

    def _localised(self, text: str) -> str:
        point = self.locale().decimalPoint()
        return text.replace(",", point).replace(".", point)
