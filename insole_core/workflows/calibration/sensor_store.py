"""Storage of the calibrated sensors of this clinic: one folder for each serial number."""

from __future__ import annotations

import re
from collections.abc import Callable
from contextlib import nullcontext
from pathlib import Path

import platformdirs

from insole_core.errors import InputError, UsageError
from insole_core.export.atomic import copy_into, make_output_folder
from insole_core.export.transaction import Transaction, nothing_foreign
from insole_core.recording.sensor_folder import (
    CORRECTION_FILE,
    SENSOR_FILE,
    read_sensor,
    write_sensor,
)
from insole_core.sensing.sensor import Sensor

_SERIAL = re.compile(r"[A-Za-z0-9][A-Za-z0-9._-]{0,63}")


def sensors_folder_of_user() -> Path:
    """Return the folder of this user's calibrated sensors."""
    return platformdirs.user_data_path("insole-studio", appauthor=False) / "sensors"


class SensorStore:
    """Storage of ``sensor.json``, ``correction.npz`` and the reports of every sensor.

    Parameters
    ----------
    folder
        Holds one folder for each serial number; created when the first sensor is saved.
    """

    def __init__(self, folder: Path) -> None:
        self._folder = folder

    def folder_of(self, serial: str) -> Path:
        """Return the folder of a sensor, which need not exist.

        Raises
        ------
        UsageError
            When the serial number is not one.
        """
        if not _SERIAL.fullmatch(serial):
            raise UsageError(
                '"{serial}" is no serial number of a sensor; give its letters and digits as they '
                "stand on its label.",
                serial=serial,
            )
        return self._folder / serial

    def serials(self) -> list[str]:
        """Return the serial numbers of the saved sensors, sorted."""
        folders = (path.parent.name for path in self._folder.glob(f"*/{SENSOR_FILE}"))
        return sorted(filter(_SERIAL.fullmatch, folders))

    def load(self, serial: str) -> Sensor | None:
        """Read a sensor; None when it was never saved.

        Raises
        ------
        UsageError
            When the serial number is not one.
        InputError
            When its files are damaged, or are those of another sensor.
        """
        folder = self.folder_of(serial)
        if not (folder / SENSOR_FILE).exists():
            return None
        sensor = read_sensor(folder)
        if sensor.serial != serial:
            raise InputError(
                "{folder} holds the calibration of sensor {owner}; calibrate sensor {serial} "
                "again.",
                folder=folder,
                owner=sensor.serial,
                serial=serial,
            )
        return sensor

    def save(
        self,
        sensor: Sensor,
        attach: Callable[[Path], None] = lambda _folder: None,
        outputs: Transaction | None = None,
    ) -> Path:
        """Replace the stored files of a sensor atomically; other files in its folder stay.

        Parameters
        ----------
        attach
            Writes further files, such as reports, into the folder that it is called with.
        outputs
            Of a command that writes more than this; they are replaced together.

        Returns
        -------
        Path
            The folder of the sensor.

        Raises
        ------
        UsageError
            When the serial number is not one.
        OutputError
            When the place cannot be written; what was there before is untouched.
        """
        folder = self.folder_of(sensor.serial)
        make_output_folder(self._folder)
        with Transaction() if outputs is None else nullcontext(outputs) as transaction:
            beside = transaction.folder(folder, nothing_foreign)
            if folder.exists():
                copy_into(beside, folder)
            if sensor.correction is None:
                (beside / CORRECTION_FILE).unlink(missing_ok=True)
            write_sensor(sensor, beside)
            attach(beside)
        return folder
