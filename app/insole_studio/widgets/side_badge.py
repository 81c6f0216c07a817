"""A coloured badge that shows left or right."""

from __future__ import annotations

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QLabel, QSizePolicy, QWidget

from insole_core.geometry.side import Side
from insole_studio.texts import tr

COLORS = {Side.LEFT: "#b3261e", Side.RIGHT: "#1b7a3d"}
"""Red is left and green is right, as on ships; both carry white text at AA contrast."""
PADDING_PX = 8
WIDEST_PX = 16_777_215
"""What Qt takes for no limit (QWIDGETSIZE_MAX)."""


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
        self.setVisible(side is not None)
        if side is None:
            self.clear()
            return
        word = tr("LEFT") if side is Side.LEFT else tr("RIGHT")
        parts = [word, *([_mirrored_from(side.other)] if mirrored else [])]
        parts += [tr("scan of {day}").format(day=scanned_on)] if scanned_on else []
        self.setText(" · ".join(parts))
        self.setStyleSheet(
            f"background: {COLORS[side]}; color: white; border-radius: 4px;"
            f" padding: 1px {PADDING_PX}px; font-weight: 600;"
        )

    @property
    def least_px(self) -> int:
        """Width of the widest word, to which the badge can be narrowed."""
        words = (self.fontMetrics().horizontalAdvance(word) for word in self.text().split())
        return max(words, default=0) + 2 * PADDING_PX

    def fit(self, room_px: int) -> None:
        """Wrap the text where it is wider than its room."""
        self.setWordWrap(False)
        self.setMinimumWidth(0)
        self.setMaximumWidth(WIDEST_PX)
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
