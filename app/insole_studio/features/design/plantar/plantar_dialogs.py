"""What the file of a pressure map or footprint does not say: asked, with the picture beside."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from PySide6.QtCore import Qt
from PySide6.QtWidgets import (
    QDialog,
    QDialogButtonBox,
    QFormLayout,
    QHBoxLayout,
    QLabel,
    QVBoxLayout,
    QWidget,
)

from insole_core.errors import InputError
from insole_core.geometry.arrays import ByteArray
from insole_core.geometry.side import Side
from insole_core.pressure.laid_map import FootprintPicture
from insole_core.pressure.picture import DPI, Picture, with_distance, with_dpi
from insole_core.pressure.recording import (
    LENGTH_MM,
    PITCH_MM,
    Answers,
    PressureRecording,
    PressureUnit,
    SeenFrom,
)
from insole_core.workflows.lay_plantar import Shown
from insole_studio.scene.coloring import map_colors
from insole_studio.texts import fill, tr
from insole_studio.widgets.form_parts import ComboBox
from insole_studio.widgets.message_label import MessageLabel
from insole_studio.widgets.number_field import NumberField
from insole_studio.widgets.picture_view import PictureView

_PICTURE_PX = (320, 460)
_ASK = ""


class _PlantarDialog(QDialog):
    """A picture beside a form; it can be accepted once all is answered.

    Parameters
    ----------
    sentence
        Stands above the form.
    sides
        The feet that the case has; a single one is that of the picture, unless it says another.
    """

    def __init__(self, sentence: str, sides: Sequence[Side], parent: QWidget | None) -> None:
        super().__init__(parent)
        self._only_side = sides[0].value if len(sides) == 1 else _ASK
        self.setWindowTitle(tr("Pressure and footprint"))
        self.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        self.picture = PictureView()
        self.picture.setMinimumSize(*_PICTURE_PX)
        self.form = QFormLayout()
        self.note = _words("")
        self.warning = MessageLabel("warning")
        self.buttons = QDialogButtonBox()
        role = QDialogButtonBox.ButtonRole
        self.lay_button = self.buttons.addButton(tr("Lay under the foot"), role.AcceptRole)
        cancel = self.buttons.addButton(tr("Cancel"), role.RejectRole)
        cancel.setAutoDefault(False)  # else Enter cancels while something is still to be said
        self.buttons.accepted.connect(self.accept)
        self.buttons.rejected.connect(self.reject)
        right = QVBoxLayout()
        right.addWidget(_words(sentence))
        right.addLayout(self.form)
        right.addWidget(self.note)
        right.addWidget(self.warning)
        right.addStretch(1)
        right.addWidget(self.buttons)
        both = QHBoxLayout(self)
        both.addWidget(self.picture, 1)
        both.addLayout(right)
        self.lay_button.setDefault(True)  # which counts only once it is in the dialog

    def _add(self, label: str, field: ComboBox | NumberField) -> None:
        self.form.addRow(label, field)
        field.edited.connect(self.refresh)

    def refresh(self, _value: object = None) -> None:
        """Allow to go on once nothing is open."""
        open_ = self.open_questions()
        self.lay_button.setEnabled(not open_)
        self.note.setText(tr("Still to be said: {list}").format(list=", ".join(open_)))
        self.note.setVisible(bool(open_))

    def open_questions(self) -> list[str]:
        """Return what is not answered yet."""
        raise NotImplementedError


class PressureDialog(_PlantarDialog):
    """Asks for what a map of pressures does not say, and which contact is to be shown.

    Parameters
    ----------
    name
        Of the file.
    recordings
        All maps of the file.
    sides
        As of all these dialogs.
    """

    def __init__(
        self,
        name: str,
        recordings: Sequence[PressureRecording],
        sides: Sequence[Side],
        parent: QWidget | None,
    ) -> None:
        device = recordings[0].device or tr("table")
        super().__init__(fill(tr("{name} ({device})"), name=name, device=device), sides, parent)
        self._recordings = recordings
        self.which = ComboBox([(str(n), one.name) for n, one in enumerate(recordings)])
        if len(recordings) > 1:
            self.form.addRow(tr("Map"), self.which)
            self.which.edited.connect(self._show_recording)
        self.side = ComboBox(_with_open(_sides()))
        self._add(tr("Foot"), self.side)
        self.seen_from = ComboBox(_with_open(_seen_from()))
        self._add(tr("Seen from"), self.seen_from)
        self.unit = ComboBox(_with_open([(unit.value, unit.value) for unit in PressureUnit]))
        self._add(tr("Unit"), self.unit)
        self.across = _number("mm", 0, PITCH_MM[1])
        self.along = _number("mm", 0, PITCH_MM[1])
        self.length = _number("mm", 0, LENGTH_MM[1])
        if recordings[0].is_insole:
            self._add(tr("Length of the insole"), self.length)
        else:
            self._add(tr("Sensors apart, across"), self.across)
            self._add(tr("Sensors apart, along"), self.along)
        self.kind = ComboBox(
            [("peak", tr("Greatest pressure")), ("mean", tr("Mean")), ("frame", tr("One frame"))]
        )
        self.step = ComboBox([])
        self.frame = NumberField("", least=1, greatest=1, step=1, decimals=0)
        self._add(tr("Shown"), self.kind)
        self._add(tr("Ground contact"), self.step)
        self._add(tr("Frame"), self.frame)
        self._show_recording()

    @property
    def recording(self) -> PressureRecording:
        """The chosen map."""
        return self._recordings[int(self.which.currentData())]

    @property
    def answers(self) -> Answers:
        """What was answered."""
        side, seen_from, unit = (
            str(box.currentData()) for box in (self.side, self.seen_from, self.unit)
        )
        across, along, length = self.across.value(), self.along.value(), self.length.value()
        return Answers(
            Side(side) if side else None,
            (across, along) if min(across, along) >= PITCH_MM[0] else None,
            length if length >= LENGTH_MM[0] else None,
            PressureUnit(unit) if unit else None,
            SeenFrom(seen_from) if seen_from else None,
        )

    @property
    def shown(self) -> Shown:
        """What of the recording is to be laid."""
        kind = str(self.kind.currentData())
        step = int(self.step.currentData())
        return Shown(kind, None if step < 0 else step, int(self.frame.value()) - 1)

    def open_questions(self) -> list[str]:
        """Return what neither the file nor the user says."""
        words = {
            "pitch": tr("Sensors apart"),
            "length": tr("Length of the insole"),
            "unit": tr("Unit"),
            "side": tr("Foot"),
            "seen_from": tr("Seen from"),
        }
        known = self.answers
        without = replace(
            self.recording, pitch_mm=None, unit=None, side=None, seen_from=None
        )  # the fields show what the file says, and the user may clear them
        return [words[question] for question in without.answered(known).questions]

    def _show_recording(self, _word: object = None) -> None:
        """Show what the file says of the chosen map."""
        one = self.recording
        self.side.show_value(self._only_side if one.side is None else one.side.value)
        self.seen_from.show_value(_ASK if one.seen_from is None else one.seen_from.value)
        self.unit.show_value(_ASK if one.unit is None else one.unit.value)
        steps = one.steps()
        self.step.clear()
        self.step.addItem(tr("All"), "-1")
        for number, step in enumerate(steps):
            text = tr("{number}: frames {first} to {last}")
            self.step.addItem(
                text.format(number=number + 1, first=step.first + 1, last=step.last + 1),
                str(number),
            )
        self.step.setEnabled(len(steps) > 1)
        self.frame.setRange(1, len(one.values))
        across, along = one.pitch_mm or (0.0, 0.0)
        self.across.setValue(across)
        self.along.setValue(along)
        self.refresh()

    def refresh(self, value: object = None) -> None:
        """Show the picture, and what is still open."""
        super().refresh(value)
        is_frame = self.kind.currentData() == "frame"
        self.frame.setEnabled(is_frame)
        one = self.recording
        step = int(self.step.currentData())
        values = one.values
        if is_frame:
            picture = values[int(self.frame.value()) - 1]
        else:
            if step >= 0:
                values = values[one.steps()[step].first : one.steps()[step].last + 1]
            is_peak = self.kind.currentData() == "peak"
            picture = np.fmax.reduce(values) if is_peak else values.mean(axis=0)
        self.picture.show_picture(_picture_of(np.asarray(picture, dtype=np.float64)))


class PictureDialog(_PlantarDialog):
    """Asks for foot, view and scale of a picture; the scale also by two clicks."""

    def __init__(self, picture: Picture, sides: Sequence[Side], parent: QWidget | None) -> None:
        super().__init__(picture.file, sides, parent)
        self._picture = picture
        self._clicks: list[tuple[float, float]] = []
        self.side = ComboBox(_with_open(_sides()))
        self.side.show_value(self._only_side)
        self._add(tr("Foot"), self.side)
        self.seen_from = ComboBox(_with_open(_seen_from()))
        self._add(tr("Seen from"), self.seen_from)
        self.dpi = _number(tr("per inch"), 0, DPI[1])
        self.dpi.setValue(picture.dpi or 0.0)
        self._add(tr("Dots"), self.dpi)
        self.distance = _number("mm", 0, 700)
        self._add(tr("Distance of two clicks"), self.distance)
        self.form.addRow("", _words(tr("Click two points whose distance is known")))
        self.picture.clicked.connect(self._click)
        self._show_clicks()
        self.refresh()

    @property
    def answered_side(self) -> Side:
        """The foot of the picture."""
        return Side(str(self.side.currentData()))

    @property
    def answered_view(self) -> SeenFrom:
        """From where it shows the foot."""
        return SeenFrom(str(self.seen_from.currentData()))

    def scaled(self) -> FootprintPicture:
        """Return the picture in its size; the two clicks go before the dots.

        Raises
        ------
        InputError
            When it is not as large as a foot's.
        """
        if len(self._clicks) == 2 and self.distance.value() > 0:
            first, second = self._clicks
            return with_distance(self._picture, first, second, self.distance.value())
        return with_dpi(self._picture, self.dpi.value())

    def open_questions(self) -> list[str]:
        """Return what is not answered yet."""
        missing = []
        if not self.side.currentData():
            missing.append(tr("Foot"))
        if not self.seen_from.currentData():
            missing.append(tr("Seen from"))
        by_clicks = len(self._clicks) == 2 and self.distance.value() > 0
        if not by_clicks and self.dpi.value() < DPI[0]:
            missing.append(tr("Dots, or two clicks and their distance"))
        return missing

    def refresh(self, value: object = None) -> None:
        """Tell what is still open, or that the picture is not as large as a foot's."""
        super().refresh(value)
        refusal = ""
        if not self.open_questions():
            try:
                self.scaled()
            except InputError as error:
                refusal = error.message
                self.lay_button.setEnabled(False)
        self.warning.say(refusal)

    def _click(self, x_px: float, y_px: float) -> None:
        """Take a point; a third one begins anew."""
        before = self._clicks if len(self._clicks) < 2 else []
        self._clicks = [*before, (x_px, y_px)]
        self._show_clicks()
        self.refresh()

    def _show_clicks(self) -> None:
        picture = self._picture.colors.copy()
        size = max(picture.shape[0] // 60, 2)
        for x, y in self._clicks:
            row, column = int(y), int(x)
            picture[max(row - size, 0) : row + size, max(column - size, 0) : column + size] = _MARK
        self.picture.show_picture(picture)


_MARK = (200, 30, 30)


def _picture_of(values: np.ndarray[tuple[int, ...], np.dtype[np.float64]]) -> ByteArray:
    """Return a map as a picture (height, width, 3), by the colours of the legend."""
    greatest = max(float(np.nanmax(values)), 1e-9)
    flat = map_colors(np.nan_to_num(values).ravel(), (0.0, greatest))
    flat[~np.isfinite(values).ravel()] = 255
    return flat.reshape(*values.shape, 3).astype(np.uint8)


def _with_open(options: Sequence[tuple[str, str]]) -> list[tuple[str, str]]:
    return [(_ASK, tr("Choose…")), *options]


def _sides() -> list[tuple[str, str]]:
    return [(Side.LEFT.value, tr("Left foot")), (Side.RIGHT.value, tr("Right foot"))]


def _seen_from() -> list[tuple[str, str]]:
    return [
        (SeenFrom.ABOVE.value, tr("above, as one sees one's own foot")),
        (SeenFrom.BELOW.value, tr("below, as a scanner sees it")),
    ]


def _number(unit: str, least: float, greatest: float) -> NumberField:
    field = NumberField(unit, least=least, greatest=greatest, step=1, decimals=2)
    field.setSpecialValueText(tr("Not known"))
    return field


def _words(text: str) -> QLabel:
    label = QLabel(text)
    label.setTextFormat(Qt.TextFormat.PlainText)
    label.setWordWrap(True)
    return label
