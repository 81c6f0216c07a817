"""Notices that need no answer: lines with a button, shown until dismissed; many can be scrolled."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from PySide6.QtCore import QSize, Qt, Signal
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import (
    QFrame,
    QHBoxLayout,
    QPushButton,
    QScrollArea,
    QSizePolicy,
    QToolButton,
    QWidget,
)

from insole_studio.texts import tr
from insole_studio.widgets.elided_label import ElidedLabel
from insole_studio.widgets.icons import give_icon
from insole_studio.widgets.layouts import FlowLayout, remove_widgets

LEAST_PX = 640
MOST_LINES = 2.5
"""Lines that are shown at once: the half one tells that there are more."""


@dataclass(frozen=True)
class Notice:
    """One notice, with the texts of its buttons."""

    key: str
    text: str
    offers: tuple[str, ...] = ()


class NoticeBar(QScrollArea):
    """Shows notices, short ones side by side; has no height while there are none."""

    taken = Signal(str, int)
    """Emitted with the key of the notice and the number of its button."""
    dismissed = Signal(str)
    filled = Signal(bool)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        content = QWidget()
        self._lines = FlowLayout(content, margin_px=4, gap_px=4)
        self._lines.setContentsMargins(4, 0, 4, 0)
        self.setWidget(content)
        content.setAutoFillBackground(False)  # else it has the colour of buttons
        self.viewport().setAutoFillBackground(False)
        self.setWidgetResizable(True)
        self.setFrameShape(QFrame.Shape.NoFrame)
        self.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)

    def sizeHint(self) -> QSize:
        """Return the height of the lines at this width, or of those that are shown at once."""
        needed_px = self._lines.heightForWidth(max(self.viewport().width(), LEAST_PX))
        most_px = round(MOST_LINES * self._lines.minimumSize().height())
        return QSize(LEAST_PX, min(needed_px, most_px))

    def minimumSizeHint(self) -> QSize:
        """Return a size that cuts no line off."""
        return QSize(0, self.sizeHint().height())

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Wrap the lines again."""
        super().resizeEvent(event)
        if event.size().width() != event.oldSize().width():
            self.updateGeometry()

    def show_notices(self, notices: Sequence[Notice]) -> None:
        """Replace the shown notices."""
        remove_widgets(self._lines)
        for notice in notices:
            line = _Line(notice)
            line.taken.connect(self.taken)
            line.dismissed.connect(self.dismissed)
            self._lines.addWidget(line)
        self.updateGeometry()
        self.filled.emit(bool(notices))


class _Line(QFrame):
    """One notice: its text, unfolded if long, its button, and a button to dismiss it."""

    taken = Signal(str, int)
    dismissed = Signal(str)

    def __init__(self, notice: Notice) -> None:
        super().__init__()
        self.setObjectName("notice")
        self._key = notice.key
        self._text = ElidedLabel(notice.text)
        self._more = _button("down", tr("Read all"))
        self._more.setCheckable(True)
        self._more.hide()
        self._more.toggled.connect(self._text.unfold)
        self._text.overflowed.connect(self._show_more)
        row = QHBoxLayout(self)
        row.setContentsMargins(8, 2, 4, 2)
        row.addWidget(self._text, 1)
        row.addWidget(self._more)
        for number, offer in enumerate(notice.offers):
            take = QPushButton(offer)
            take.setProperty("offer", number)
            take.clicked.connect(self._take)
            row.addWidget(take)
        dismiss = _button("remove", tr("Dismiss"))
        dismiss.clicked.connect(self._dismiss)
        row.addWidget(dismiss)

    def _show_more(self, too_long: bool) -> None:
        self._more.setVisible(too_long or self._more.isChecked())

    def _take(self) -> None:
        self.taken.emit(self._key, self.sender().property("offer"))

    def _dismiss(self) -> None:
        self.dismissed.emit(self._key)


def _button(icon_name: str, tip: str) -> QToolButton:
    button = QToolButton()
    give_icon(button, icon_name)
    button.setAutoRaise(True)
    button.setToolTip(tip)
    button.setAccessibleName(tip)
    return button
