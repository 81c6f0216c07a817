"""The table of measures: of one foot, or left and right side by side with the asymmetry."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QGridLayout, QLabel, QWidget

from insole_core.geometry.side import Side
from insole_studio.features.design.rows import Measure
from insole_studio.texts import tr
from insole_studio.widgets.form_parts import LinkLabel
from insole_studio.widgets.layouts import remove_widgets
from insole_studio.widgets.side_switch import side_letter

_RIGHT = Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter
_LIMITS, _DIFFERENCE, _BOTH = 3, 4, 5


class MeasureGrid(QWidget):
    """One row per measure; a click on a name shows where it is taken."""

    chosen = Signal(str)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._shown: list[Measure] = []
        self._grid = QGridLayout(self)
        self._grid.setContentsMargins(0, 0, 0, 0)
        self._grid.setHorizontalSpacing(6)
        self._grid.setVerticalSpacing(4)
        self._grid.setColumnStretch(0, 1)

    def show_measures(self, measures: Sequence[Measure]) -> None:
        """Show other measures; the same ones stay, with a name being pressed."""
        if list(measures) == self._shown:
            return
        self._shown = list(measures)
        remove_widgets(self._grid)
        first = 0
        if measures and len(measures[0].values) == _BOTH:
            self._add_heads()
            first = 1
        for row, measure in enumerate(measures, first):
            self._add(row, measure)

    def _add_heads(self) -> None:
        unit = QLabel("mm")
        unit.setObjectName("quiet")
        self._grid.addWidget(unit, 0, 0)
        difference = QLabel(tr("L − R"))
        difference.setToolTip(tr("Left minus right"))
        limits = QLabel("±")
        limits.setToolTip(tr("How far the values of both feet may be off: 95 % limits"))
        percent = QLabel("%")
        percent.setToolTip(tr("The difference in per cent of the mean of both"))
        heads = (side_letter(Side.LEFT), side_letter(Side.RIGHT), limits, difference, percent)
        for column, head in enumerate(heads, 1):
            self._grid.addWidget(head, 0, column, _RIGHT)

    def _add(self, row: int, measure: Measure) -> None:
        if not measure.values:
            self._add_explanation(row, measure)
            return
        both = len(measure.values) == _BOTH
        is_angle = both and measure.unit == "°"
        name = self._name(f"{measure.name} (°)" if is_angle else measure.name, measure.key)
        name.setWordWrap(True)
        name.setToolTip(measure.tip)
        self._grid.addWidget(name, row, 0)
        for column, value in enumerate(measure.values, 1):
            text = value if both or not measure.unit else f"{value} {measure.unit}"
            number = QLabel(text)
            number.setToolTip(measure.tip)
            number.setAlignment(_RIGHT)  # also of two lines
            if column in (_LIMITS, _BOTH) or (column == _DIFFERENCE and measure.is_within_error):
                number.setObjectName("quiet")
            self._grid.addWidget(number, row, column, _RIGHT)

    def _add_explanation(self, row: int, measure: Measure) -> None:
        told = self._name(measure.name, measure.key)
        told.setObjectName("quiet" if not measure.key else "")
        told.setWordWrap(True)
        self._grid.addWidget(told, row, 0, 1, -1)

    def _name(self, words: str, key: str) -> QLabel:
        """Return the label of a measure, a link if its place can be shown."""
        if not key:
            return QLabel(words)
        name = LinkLabel(words, key, underlined=False)
        name.setCursor(Qt.CursorShape.PointingHandCursor)
        name.linkActivated.connect(self.chosen)
        return name
