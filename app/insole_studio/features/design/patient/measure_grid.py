"""The table of measures: of one foot, or left and right side by side with the asymmetry."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

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


@dataclass(frozen=True)
class _RowLayout:
    """What of a row no text changes: the key of its link, and which of its values are quiet.

    A line that explains the others has none.
    """

    key: str
    quiet: tuple[bool, ...]


class MeasureGrid(QWidget):
    """One row per measure; a click on a name shows where it is taken."""

    chosen = Signal(str)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._shown: list[Measure] = []
        self._rows: list[tuple[_RowLayout, list[QLabel]]] = []
        """Form and labels of each row; those of other measures of the same forms are reused."""
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
        self.setVisible(bool(measures))
        if not measures:
            return
        forms = [_form(measure) for measure in measures]
        if forms != [form for form, _ in self._rows]:
            self._lay_out(measures, forms)
        for measure, (_, (name, *numbers)) in zip(measures, self._rows, strict=True):
            _write(measure, name, numbers)

    def _lay_out(self, measures: Sequence[Measure], forms: Sequence[_RowLayout]) -> None:
        remove_widgets(self._grid)
        first = 0
        if len(measures[0].values) == _BOTH:
            self._add_heads()
            first = 1
        self._rows = [(form, self._row(row, form)) for row, form in enumerate(forms, first)]

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

    def _row(self, row: int, form: _RowLayout) -> list[QLabel]:
        """Return the label of the name and those of the values."""
        name = self._name(form.key)
        name.setWordWrap(True)
        if not form.quiet:
            name.setObjectName("quiet" if not form.key else "")
            self._grid.addWidget(name, row, 0, 1, -1)
            return [name]
        self._grid.addWidget(name, row, 0)
        numbers = []
        for column, is_quiet in enumerate(form.quiet, 1):
            number = QLabel()
            number.setAlignment(_RIGHT)  # also of two lines
            number.setObjectName("quiet" if is_quiet else "")
            self._grid.addWidget(number, row, column, _RIGHT)
            numbers.append(number)
        return [name, *numbers]

    def _name(self, key: str) -> QLabel:
        """Return the label of a measure, a link if its place can be shown."""
        if not key:
            return QLabel()
        name = LinkLabel("", key, underlined=False)
        name.setCursor(Qt.CursorShape.PointingHandCursor)
        name.linkActivated.connect(self.chosen)
        return name


def _form(measure: Measure) -> _RowLayout:
    columns = range(1, len(measure.values) + 1)
    quiet = tuple(
        column in (_LIMITS, _BOTH) or (column == _DIFFERENCE and measure.is_within_error)
        for column in columns
    )
    return _RowLayout(measure.key, quiet)


def _write(measure: Measure, name: QLabel, numbers: Sequence[QLabel]) -> None:
    both = len(measure.values) == _BOTH
    words = f"{measure.name} (°)" if both and measure.unit == "°" else measure.name
    if isinstance(name, LinkLabel):
        name.say(words)
    else:
        name.setText(words)
    name.setToolTip(measure.tip if numbers else "")
    for number, value in zip(numbers, measure.values, strict=True):
        number.setText(value if both or not measure.unit else f"{value} {measure.unit}")
        number.setToolTip(measure.tip)
