"""The action that opens the calibrate stage."""

from __future__ import annotations

from typing import TYPE_CHECKING

from insole_studio.services.action_record import ActionRecord
from insole_studio.texts import tr

if TYPE_CHECKING:
    from insole_studio.features.calibrate.calibrate_window import CalibrateWindow


CALIBRATE_ACTIONS: tuple[ActionRecord[CalibrateWindow], ...] = (
    ActionRecord(
        "calibrate",
        lambda: tr("Calibrate sensors…"),
        lambda: tr("Turn a sensor from the box into a measuring device"),
        lambda window, _on: window.open(),
    ),
    ActionRecord(
        "print_boards",
        lambda: tr("Print calibration boards…"),
        lambda: tr("Boards and marker templates at true size"),
        lambda window, _on: window.print_boards(),
    ),
)
