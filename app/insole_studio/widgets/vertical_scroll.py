"""A column that scrolls vertically only."""

from __future__ import annotations

from PySide6.QtCore import QEvent, QObject, QSize, Qt
from PySide6.QtWidgets import QFrame, QScrollArea, QWidget

from insole_studio.widgets.finger_scroll import scroll_by_finger


class VerticalScroll(QScrollArea):
    """Scroll area as wide as its content, which cannot be scrolled sideways."""

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
        return super().eventFilter(watched, event)

    def minimumSizeHint(self) -> QSize:
        """Return a size as wide as the content."""
        return QSize(self.needed_px, super().minimumSizeHint().height())
