"""Storage of the calibrated sensors of this clinic: one folder for each serial number."""

from __future__ import annotations

import re
import shutil
from collections.abc import Callable
from contextlib import nullcontext
from pathlib import Path

import platformdirs

from insole_core.errors import CalibrationError, InputError, UsageError
from insole_core.files.atomic import copy_into, make_output_folder
from insole_core.files.transaction import Transaction, nothing_foreign
from insole_core.recording.sensor_folder import (
    CORRECTION_FILE,
    REFERENCE_FILE,
    SENSOR_FILE,
    check_readable,
    read_sensor,
    write_sensor,
)
from insole_core.sensing.family import DIRECT_DEPTH
from insole_core.sensing.infrared_reference import InfraredReference, load_record, load_reference
from insole_core.sensing.sensor import Sensor

BEFORE = "before"
"""Sub-folder of a sensor that holds its files as they were before the last change."""
_SERIAL = re.compile(r"[A-Za-z0-9][A-Za-z0-9._-]{0,63}")


def sensors_folder_of_user() -> Path:
    """Return the folder of this user's calibrated sensors."""
    return platformdirs.user_data_path("insole-studio", appauthor=False) / "sensors"


def delivering_raw_numbers(sensor: Sensor) -> Sensor:
    """Return a sensor, if boards and its raw numbers can calibrate it.

    Raises
    ------
    InputError
        When it delivers millimetres.
    """
    if sensor.depth_unit_mm is not None:
        raise InputError(
            "Sensor {serial} is a {model}, whose cameras and scale its factory has calibrated; "
            "calibrate only the distortion of its depth, with walls.",
            serial=sensor.serial,
            model=sensor.model,
        )
    return sensor


def measuring_disparity(sensor: Sensor) -> Sensor:
    """Return a sensor, if walls can calibrate the distortion of its depth.

    Raises
    ------
    InputError
        When it delivers millimetres and is no stereo camera.
    """
    if sensor.family is DIRECT_DEPTH:
        raise InputError(
            "Sensor {serial} is a {model}, which measures no disparity that walls could correct; "
            "use it as its factory calibrated it.",
            serial=sensor.serial,
            model=sensor.model,
        )
    return sensor


class SensorStore:
    """Storage of every sensor's ``sensor.json``, corrections, pattern of dots and reports.

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
            When its files are damaged, or are those of another sensor; says how to go on.
        """
        folder = self.folder_of(serial)
        if not (folder / SENSOR_FILE).exists():
            return None
        try:
            sensor = read_sensor(folder)
        except InputError as error:
            raise InputError(
                "The calibration of sensor {serial} cannot be read; undo its last step under "
                "Calibrate sensors, or by insole-studio calibrate undo --serial {serial}: {reason}",
                serial=serial,
                reason=error.message,
            ) from error
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

        How they were before is kept for `undo`.

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
        CalibrationError
            When the sensor could not be read again as it is.
        OutputError
            When the place cannot be written.
        After any error, what was there before is untouched.
        """
        folder = self.folder_of(sensor.serial)
        make_output_folder(self._folder)
        with Transaction() if outputs is None else nullcontext(outputs) as transaction:
            beside = transaction.folder(folder, nothing_foreign)
            if folder.exists():
                copy_into(beside, folder)
            if (folder / SENSOR_FILE).exists():
                _keep(folder, beside / BEFORE)
            if sensor.correction is None:
                (beside / CORRECTION_FILE).unlink(missing_ok=True)
            write_sensor(sensor, beside)
            _check_readable(sensor.serial, beside)
            attach(beside)
        return folder

    def keep_reference(
        self, reference: InfraredReference, outputs: Transaction | None = None
    ) -> None:
        """Keep the pattern of dots of a known sensor with its calibration; `undo` takes it back.

        Parameters
        ----------
        reference
        outputs
            As of `save`.

        Raises
        ------
        CalibrationError, UsageError, InputError, OutputError
            As of `check_known` and `save`.
        """
        sensor = self.check_known(reference.record.serial)
        self.save(sensor, lambda folder: reference.save(folder / REFERENCE_FILE), outputs)

    def reference(self, serial: str) -> InfraredReference | None:
        """Read the pattern of dots of a sensor; None when none is kept.

        Raises
        ------
        UsageError
            When the serial number is not one.
        InputError
            When it is damaged, or of a newer version.
        """
        if not self.has_reference(serial):
            return None
        return load_reference(self.folder_of(serial) / REFERENCE_FILE)

    def reference_date(self, serial: str) -> str:
        """Return when the kept pattern of dots was learnt, ISO 8601; empty where none is readable.

        Raises
        ------
        UsageError
            When the serial number is not one.
        """
        if not self.has_reference(serial):
            return ""
        try:
            return load_record(self.folder_of(serial) / REFERENCE_FILE).made_at
        except InputError:
            return ""

    def has_reference(self, serial: str) -> bool:
        """Return whether the pattern of dots of a sensor is kept.

        Raises
        ------
        UsageError
            When the serial number is not one.
        """
        return (self.folder_of(serial) / REFERENCE_FILE).exists()

    def check_known(self, serial: str) -> Sensor:
        """Return a sensor that a pattern can be kept with.

        Raises
        ------
        CalibrationError
            When it was never saved.
        UsageError, InputError
            As of `load`.
        """
        sensor = self.load(serial)
        if sensor is None:
            raise CalibrationError(
                "Sensor {serial} was never calibrated here, so its pattern of dots cannot be kept; "
                "calibrate it first, or write the pattern by --out.",
                serial=serial,
            )
        return sensor

    def can_undo(self, serial: str) -> bool:
        """Return whether there is anything to undo for a sensor."""
        folder = self.folder_of(serial)
        return any((place / SENSOR_FILE).exists() for place in (folder, folder / BEFORE))

    def undo(self, serial: str) -> bool:
        """Exchange the files of a sensor for those before its last change; again, to redo it.

        Returns
        -------
        bool
            Whether the sensor is calibrated now; before its first step it was not.

        Raises
        ------
        UsageError
            When nothing is kept for this serial number.
        OutputError
            When the place cannot be written.
        """
        folder = self.folder_of(serial)
        if not self.can_undo(serial):
            raise UsageError(
                "Nothing is kept of sensor {serial} that could be undone; check the serial number.",
                serial=serial,
            )
        with Transaction() as transaction:
            beside = transaction.folder(folder, nothing_foreign)
            copy_into(beside, folder)
            for path in _files(beside):
                path.unlink()
            if (folder / BEFORE).exists():
                copy_into(beside, folder / BEFORE)
            _keep(folder, beside / BEFORE)
            return (beside / SENSOR_FILE).exists()


def _keep(folder: Path, before: Path) -> None:
    """Copy the files of a sensor's folder, without what was before them."""
    shutil.rmtree(before, ignore_errors=True)
    before.mkdir()
    for path in _files(folder):
        shutil.copy2(path, before)


def _files(folder: Path) -> list[Path]:
    return [path for path in folder.iterdir() if path.is_file()]


def _check_readable(serial: str, folder: Path) -> None:
    try:
        check_readable(folder)
    except InputError as error:
        raise CalibrationError(
            "Nothing was saved, because sensor {serial} could not be read again with this result; "
            "check what was given to the step and take it again: {reason}",
            serial=serial,
            reason=error.message,
        ) from error
