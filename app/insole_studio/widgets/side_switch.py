"""Left or right: the badge that shows a side, and the buttons that choose the active foot."""

from __future__ import annotations

from collections.abc import Callable, Collection

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QHBoxLayout, QLabel, QMenu, QSizePolicy, QToolButton, QWidget

from insole_core.geometry.side import Side
from insole_studio.texts import tr

COLORS = {Side.LEFT: "#b3261e", Side.RIGHT: "#1b7a3d"}
"""Red is left and green is right, as on ships; both carry white text at AA contrast."""
_PADDING_PX = 8
_WIDEST_PX = 16_777_215
"""What Qt takes for no limit (QWIDGETSIZE_MAX)."""
_WAYS_TO_ADD: dict[str, Callable[[], str]] = {
    "open_session": lambda: tr("Open session…"),
    "open_archive": lambda: tr("Import a scan…"),
    "capture": lambda: tr("Capture…"),
    "mirror_foot": lambda: tr("Other foot as mirror image"),
}
_SHAPE = "border-radius: 4px; padding: 4px 4px; font-weight: 600;"


class SideBadge(QLabel):
    """The side of a foot; hidden while there is none."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setAlignment(Qt.AlignmentFlag.AlignCenter)
        self.setSizePolicy(QSizePolicy.Policy.Maximum, QSizePolicy.Policy.Maximum)
        self.show_side(None)

    def show_side(self, side: Side | None, *, mirrored: bool = False, scanned_on: str = "") -> None:
        """Show a side; None hides the badge.

        Parameters
        ----------
        mirrored
            Whether it is the other one's mirror image.
        scanned_on
            Day of the earlier visit that the scan is of; empty for one of this visit.
        """
        if side is None:
            self.hide()
            self.clear()
            return
        word = tr("LEFT") if side is Side.LEFT else tr("RIGHT")
        parts = [word, *([_mirrored_from(side.other)] if mirrored else [])]
        parts += [tr("scan of {day}").format(day=scanned_on)] if scanned_on else []
        self.setText(" · ".join(parts))
        _set_style(
            self,
            f"background: {COLORS[side]}; color: white; border-radius: 4px;"
            f" padding: 1px {_PADDING_PX}px; font-weight: 600;",
        )
        self.show()  # last, so that its neighbours make room for it once

    @property
    def least_px(self) -> int:
        """Width of the widest word, to which the badge can be narrowed."""
        words = (self.fontMetrics().horizontalAdvance(word) for word in self.text().split())
        return max(words, default=0) + 2 * _PADDING_PX

    def fit(self, room_px: int) -> None:
        """Wrap the text where it is wider than its room."""
        self.setWordWrap(False)
        self.setMinimumWidth(0)
        self.setMaximumWidth(_WIDEST_PX)
        if self.sizeHint().width() > room_px:
            self.setWordWrap(True)
            self.setFixedWidth(max(room_px, self.least_px))


def _mirrored_from(side: Side) -> str:
    return tr("mirrored from left") if side is Side.LEFT else tr("mirrored from right")


def side_letter(side: Side) -> QLabel:
    """Return the one-letter badge of a list row."""
    letter = QLabel(tr("L") if side is Side.LEFT else tr("R"))
    letter.setSizePolicy(QSizePolicy.Policy.Fixed, QSizePolicy.Policy.Fixed)
    letter.setToolTip(tr("LEFT") if side is Side.LEFT else tr("RIGHT"))
    letter.setStyleSheet(
        f"background: {COLORS[side]}; color: white; border-radius: 3px; padding: 0 4px;"
        " font-weight: 600;"
    )
    return letter


class SideSwitch(QWidget):
    """Buttons for left and right; a missing foot offers the ways to add it."""

    chosen = Signal(object)
    action_requested = Signal(str)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._menu = self._menu_to_add()
        self.buttons = {side: self._button(side) for side in Side}
        row = QHBoxLayout(self)
        row.setContentsMargins(0, 0, 0, 0)
        row.setSpacing(8)
        for button in self.buttons.values():
            row.addWidget(button)
        self.show_feet(None, ())

    def show_feet(self, at_hand: Side | None, present: Collection[Side]) -> None:
        """Show which feet the case has, and which of them is active."""
        self.setVisible(at_hand is not None)
        for side, button in self.buttons.items():
            there = side in present
            button.setText(_word(side) if there else f"+ {_word(side)}")
            button.setMenu(None if there else self._menu)  # type: ignore[arg-type]
            button.setToolTip(_tip(side, there))
            button.setAccessibleName(_tip(side, there))
            _set_style(button, _style(side, there, side is at_hand))

    def _button(self, side: Side) -> QToolButton:
        button = QToolButton()
        button.setProperty("side", side.value)
        button.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        button.setMinimumHeight(30)
        button.setPopupMode(QToolButton.ToolButtonPopupMode.InstantPopup)
        button.clicked.connect(self._choose)
        return button

    def _menu_to_add(self) -> QMenu:
        menu = QMenu(self)
        for key, text in _WAYS_TO_ADD.items():
            action = menu.addAction(text())
            action.setData(key)
            action.triggered.connect(self._request_action)
        return menu

    def _choose(self) -> None:
        self.chosen.emit(Side(self.sender().property("side")))

    def _request_action(self) -> None:
        self.action_requested.emit(self.sender().data())  # type: ignore[attr-defined]


def _word(side: Side) -> str:
    return tr("LEFT") if side is Side.LEFT else tr("RIGHT")


def _tip(side: Side, there: bool) -> str:
    if side is Side.LEFT:
        return tr("Work on the left foot") if there else tr("Add the left foot to the case")
    return tr("Work on the right foot") if there else tr("Add the right foot to the case")


def _style(side: Side, there: bool, at_hand: bool) -> str:
    if at_hand:
        look = f"background: {COLORS[side]}; color: white; border: 2px solid {COLORS[side]};"
    else:
        line = f"2px solid {COLORS[side]}" if there else "2px dashed palette(mid)"
        look = f"background: transparent; border: {line};"
    return f"QToolButton {{ {look} {_SHAPE} }} QToolButton::menu-indicator {{ image: none; }}"


def _set_style(widget: QWidget, sheet: str) -> None:
    """Give a widget another style sheet; Qt would take as long over the same one."""
    if widget.styleSheet() != sheet:
        widget.setStyleSheet(sheet)
