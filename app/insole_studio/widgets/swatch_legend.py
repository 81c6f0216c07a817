"""A legend of named colours, such as those of the zones of a print."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtWidgets import QFrame, QHBoxLayout, QLabel, QWidget

from insole_studio.widgets.emptied import remove_widgets
from insole_studio.widgets.flow import FlowLayout

_SWATCH_PX = 14


class SwatchLegend(QWidget):
    """Squares of colour with their names, in lines; hidden while there are none."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._layout = FlowLayout(self, margin_px=0, gap_px=16)
        self._shown: tuple[tuple[str, str], ...] = ()
        self.hide()

    @property
    def texts(self) -> tuple[str, ...]:
        """The names that are shown."""
        return tuple(text for _, text in self._shown)

    def show_swatches(self, swatches: Sequence[tuple[str, str]]) -> None:
        """Show colours (as "#rrggbb") with their names; none hides the legend."""
        if tuple(swatches) != self._shown:
            self._shown = tuple(swatches)
            remove_widgets(self._layout)
            for color, text in self._shown:
                self._layout.addWidget(_swatch(color, text))
        self.setVisible(bool(self._shown))


def _swatch(color: str, text: str) -> QWidget:
    square, name, whole = QFrame(), QLabel(text), QWidget()
    square.setFixedSize(_SWATCH_PX, _SWATCH_PX)
    square.setStyleSheet(f"background: {color}; border: 1px solid gray;")
    row = QHBoxLayout(whole)
    row.setContentsMargins(0, 0, 0, 0)
    row.setSpacing(6)
    row.addWidget(square)
    row.addWidget(name)
    return whole
