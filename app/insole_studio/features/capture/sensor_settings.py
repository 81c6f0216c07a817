"""What can be set of a sensor, on its card: only what this sensor has."""

from __future__ import annotations

from PySide6.QtCore import QSignalBlocker, Signal
from PySide6.QtWidgets import QCheckBox, QHBoxLayout, QWidget

from insole_studio.acquisition.messages import Capability, Preset, Tuning
from insole_studio.features.capture.rows import SensorRow
from insole_studio.texts import tr
from insole_studio.widgets.form_parts import ComboBox
from insole_studio.widgets.number_field import NumberField


class SensorSettings(QWidget):
    """Preset, power of the projector, and infrared pair of a sensor."""

    edited = Signal(object)
    """The `Tuning` with what the user sets; what is None in it stays."""

    def __init__(self, serial: str, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._preset = ComboBox(
            [
                (Preset.HIGH_ACCURACY.value, tr("High accuracy")),
                (Preset.HIGH_DENSITY.value, tr("High density")),
            ]
        )
        self._preset.setAccessibleName(tr("Preset of sensor {serial}").format(serial=serial))
        self._preset.setToolTip(
            tr("High accuracy: few wrong readings, more gaps. High density: the reverse.")
        )
        self._preset.edited.connect(lambda word: self.edited.emit(Tuning(preset=Preset(word))))
        self._laser = NumberField("mW", least=0, greatest=0, step=1, decimals=0)
        self._laser.setPrefix(tr("Light: "))
        self._laser.setAccessibleName(tr("Light of sensor {serial}").format(serial=serial))
        self._laser.setToolTip(
            tr("Power of the projector: less where the depth has holes in what is bright and near")
        )
        self._laser.edited.connect(lambda power_mw: self.edited.emit(Tuning(laser_mw=power_mw)))
        self._pair = QCheckBox(tr("Infrared pair"))
        self._pair.setAccessibleName(tr("Infrared pair of sensor {serial}").format(serial=serial))
        self._pair.setToolTip(
            tr(
                "Records its two infrared pictures too, which makes the foot finer. Two such "
                "sensors fit on one USB controller instead of three."
            )
        )
        self._pair.toggled.connect(lambda on: self.edited.emit(Tuning(pair=on)))
        row = QHBoxLayout(self)
        row.setContentsMargins(0, 0, 0, 0)
        row.setSpacing(4)
        row.addWidget(self._preset)
        row.addWidget(self._laser)
        row.addWidget(self._pair)
        row.addStretch(1)
        self.hide()

    def show_row(self, row: SensorRow) -> None:
        """Show what is set of the sensor."""
        has_preset = Capability.PRESET in row.capabilities
        self._preset.setVisible(has_preset)
        self._preset.show_value("" if row.tuning.preset is None else row.tuning.preset.value)
        has_laser = Capability.LASER in row.capabilities and row.laser_range is not None
        self._laser.setVisible(has_laser)
        if row.laser_range is not None:
            self._laser.show_range(row.laser_range.least_mw, row.laser_range.greatest_mw)
            self._laser.setSingleStep(row.laser_range.step_mw)
        if row.tuning.laser_mw is not None:
            self._laser.show_value(row.tuning.laser_mw)
        has_pair = Capability.HAS_PAIR in row.capabilities
        self._pair.setVisible(has_pair)
        with QSignalBlocker(self._pair):
            self._pair.setChecked(bool(row.tuning.pair))
        self.setEnabled(row.can_tune)
        self.setVisible(has_preset or has_laser or has_pair)
