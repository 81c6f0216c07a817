"""The calibrate stage in a window of its own, and the action that opens it."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from PySide6.QtWidgets import QWidget

from insole_core.workflows.calibration.sensor_store import SensorStore
from insole_studio.acquisition.sensor_source import SensorSource
from insole_studio.services.action_record import ActionRecord
from insole_studio.services.stage_window import StageWindow
from insole_studio.services.user_messages import UserMessages
from insole_studio.texts import tr
from insole_studio.user_paths import UserPaths

if TYPE_CHECKING:
    from insole_studio.features.calibrate.stage import CalibrateStage

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


class CalibrateWindow(StageWindow["CalibrateStage"]):
    """Opens the calibrate stage; the sensors are switched off when it closes."""

    def __init__(
        self, paths: UserPaths, source: SensorSource, messages: UserMessages, window: QWidget
    ) -> None:
        super().__init__(window)
        self._paths = paths
        self._messages = messages
        self._source = source

    def print_boards(self) -> None:
        """Open the stage with the dialog that prints boards and marker templates."""
        self.open()
        if self.stage is not None:
            self.stage.print_boards()

    def after_result(self, then: Callable[[], None]) -> None:
        """Do something once a result that is not saved was saved or dropped, if there is one."""
        if self.stage is None:
            then()
        else:
            self.stage.presenter.after_result(then)

    def close(self) -> None:
        """Close the stage at the end of the program, before which `after_result` has asked."""
        if self.stage is not None:
            self.stage.presenter.drop_result()
        super().close()

    def make_stage(self) -> CalibrateStage:
        """Create the stage and connect to the sensors."""
        from insole_studio.features.calibrate.stage import CalibrateStage

        store = SensorStore(self._paths.sensors_folder)
        return CalibrateStage(
            store,
            self._source,
            self._paths.calibrations_folder,
            questions=self._messages.questions,
        )
