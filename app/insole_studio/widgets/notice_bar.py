"""What the user should know but need not answer: lines with a button, until they are dismissed."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from PySide6.QtCore import QSize, Signal
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import (
    QFrame,
    QHBoxLayout,
    QLabel,
    QPushButton,
    QSizePolicy,
    QToolButton,
    QVBoxLayout,
    QWidget,
)

from insole_studio.texts import tr
from insole_studio.widgets.icons import icon

LEAST_PX = 640


@dataclass(frozen=True)
class Notice:
    """One line; `offer` is the text of its button, empty for none."""

    key: str
    text: str
    offer: str = ""


class NoticeBar(QWidget):
    """Shows notices one below the other; takes no room while there is none."""

    taken = Signal(str)
    dismissed = Signal(str)
    filled = Signal(bool)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._lines = QVBoxLayout(self)
        self._lines.setContentsMargins(4, 0, 4, 0)
        self._lines.setSpacing(4)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)

    def sizeHint(self) -> QSize:
        """Be as high as the lines are at this width, no higher."""
        hint = super().sizeHint()
        return QSize(hint.width(), self._lines.heightForWidth(max(self.width(), LEAST_PX)))

    def minimumSizeHint(self) -> QSize:
        """Leave nothing out."""
        return QSize(0, self.sizeHint().height())

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Break the lines anew."""
        super().resizeEvent(event)
        if event.size().width() != event.oldSize().width():
            self.updateGeometry()

    def show_notices(self, notices: Sequence[Notice]) -> None:
        """Show these and no others."""
        while (item := self._lines.takeAt(0)) is not None:
            if (line := item.widget()) is not None:
                line.hide()
                line.deleteLater()
        for notice in notices:
            self._lines.addWidget(self._line(notice))
        self.filled.emit(bool(notices))

    def _line(self, notice: Notice) -> QFrame:
        line = QFrame()
        line.setObjectName("notice")
        row = QHBoxLayout(line)
        row.setContentsMargins(8, 2, 4, 2)
        text = QLabel(notice.text)
        text.setWordWrap(True)
        row.addWidget(text, 1)
        if notice.offer:
            take = QPushButton(notice.offer)
            take.setProperty("notice", notice.key)
            take.clicked.connect(self._take)
            row.addWidget(take)
        dismiss = QToolButton()
        dismiss.setIcon(icon("remove"))
        dismiss.setAutoRaise(True)
        dismiss.setToolTip(tr("Dismiss"))
        dismiss.setAccessibleName(tr("Dismiss"))
        dismiss.setProperty("notice", notice.key)
        dismiss.clicked.connect(self._dismiss)
        row.addWidget(dismiss)
        return line

    def _take(self) -> None:
        self.taken.emit(self.sender().property("notice"))

    def _dismiss(self) -> None:
        self.dismissed.emit(self.sender().property("notice"))
