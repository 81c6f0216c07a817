"""What may keep the program from working on this computer, and what to do about it.

The findings name no patient, no case and no file of one; folders of the user begin with ``~``.
"""

from __future__ import annotations

import locale
import os
import platform
import shutil
import sqlite3
import time
from collections.abc import Callable, Iterator
from contextlib import closing
from dataclasses import dataclass
from datetime import UTC, datetime
from importlib.metadata import version
from pathlib import Path
from typing import TYPE_CHECKING

from insole_core.errors import InsoleError, RecordsError
from insole_core.messages import Message, Translate, joined
from insole_core.resources import resource_path
from insole_core.workflows.calibration.sensor_store import SensorStore
from insole_studio.acquisition.examined_sensors import (
    ExaminedSensor,
    examine_sensors,
    has_udev_rule,
)
from insole_studio.app.graphics import LEAST_OPENGL, Graphics
from insole_studio.document.record_location import RecordLocation, location_of_window
from insole_studio.features.clinic.backups import is_overdue
from insole_studio.settings import load_settings, peek_settings
from insole_studio.user_paths import UserPaths

if TYPE_CHECKING:
    from insole_core.records.backup.backup_key import BackupKey
    from insole_core.records.place_check import PlaceReport

LEAST_FREE_GB = 2.0
OLD_CALIBRATION_DAYS = 365
RECORD = Message("Record")
_DAY_S = 86_400
FindSensors = Callable[[], tuple[ExaminedSensor, ...]]


@dataclass(frozen=True)
class Diagnosis:
    """One thing that was examined.

    Parameters
    ----------
    topic, state
        What it is, and how it is.
    advice
        One sentence on what to do; empty where nothing is wrong.
    """

    topic: str
    state: str
    advice: str = ""


class Doctor:
    """Examines the computer; `graphics` was asked in the window's thread, the rest in any.

    Parameters
    ----------
    location
        Of the record; by default the one that the settings of the window name.
    """

    def __init__(
        self,
        paths: UserPaths,
        graphics: Graphics | None,
        find_sensors: FindSensors = examine_sensors,
        location: RecordLocation | None = None,
    ) -> None:
        self._paths = paths
        self._graphics = graphics
        self._find_sensors = find_sensors
        self._location = location

    def examine(self) -> list[Diagnosis]:
        """Examine everything; what cannot be examined is told, and does not end it."""
        found: list[Diagnosis] = []
        for topic, examination in (
            (Message("Program"), self._program),
            (Message("Graphics"), self._see_graphics),
            (Message("Sensors"), self._sensors),
            (Message("Permission for sensors"), self._permission),
            (Message("Calibration"), self._calibration),
            (Message("Folders"), self._folders),
            (Message("Disk"), self._disk),
            (Message("Settings"), self._settings),
            (RECORD, self._record),
        ):
            try:
                found += [Diagnosis(topic, state, advice) for state, advice in examination()]
            except InsoleError as error:
                found.append(Diagnosis(topic, Message("cannot be examined"), error.message))
            except (OSError, ValueError, sqlite3.Error) as error:
                kind = Message("{kind}; report it if it does not go away.", kind=_kind_of(error))
                found.append(Diagnosis(topic, Message("cannot be examined"), kind))
        return found

    def _program(self) -> Iterator[tuple[str, str]]:
        facts = (
            f"Insole Studio {version('insole-studio')}",
            platform.platform(),
            f"Python {platform.python_version()}",
            ".".join(part for part in locale.getlocale() if part) or "C",
            "/".join(time.tzname),
        )
        yield joined(facts), ""

    def _see_graphics(self) -> Iterator[tuple[str, str]]:
        graphics = self._graphics
        if graphics is None:
            yield Message("not examined, because there is no screen"), ""
            return
        if graphics.version is None:
            advice = Message(
                "Install the driver of the graphics card, or start with the environment variable "
                "LIBGL_ALWAYS_SOFTWARE=1 (Windows: QT_OPENGL=software), which draws slowly."
            )
            yield Message("no OpenGL"), advice
            return
        advice = Message("")
        state = Message(
            "OpenGL {version}, {renderer}",
            version=".".join(map(str, graphics.version)),
            renderer=graphics.renderer or "?",
        )
        if not graphics.is_enough:
            advice = Message(
                "The 3-D views need OpenGL {version}: renew the driver of the graphics card, or "
                "start with the environment variable LIBGL_ALWAYS_SOFTWARE=1.",
                version=".".join(map(str, LEAST_OPENGL)),
            )
        elif graphics.is_software:
            advice = Message(
                "The processor draws, which is slow: install the driver of the graphics card."
            )
        yield state, advice

    def _sensors(self) -> Iterator[tuple[str, str]]:
        sensors = self._find_sensors()
        if not sensors:
            yield (
                Message("none is plugged in"),
                Message("To capture, plug in the USB cable of each sensor and its 12 V supply."),
            )
        for sensor in sensors:
            info = sensor.info
            state = Message(
                "{serial}, model {model}, device {release}, USB controller {bus}",
                serial=info.serial or "?",
                model=info.model or "?",
                release=sensor.release or "?",
                bus=str(info.bus),
            )
            yield state, self._advice_on(sensor, sensors)

    def _advice_on(self, sensor: ExaminedSensor, all_: tuple[ExaminedSensor, ...]) -> str:
        if sensor.info.problem:
            return sensor.info.problem
        beside = [other for other in all_ if other.info.bus == sensor.info.bus]
        if len(beside) > 1 and not sensor.shares:
            return Message(
                "It shares USB controller {bus} with another sensor, so the two take turns; plug "
                "one into a controller of its own to capture with both at once.",
                bus=str(sensor.info.bus),
            )
        if sensor.has_motor_firmware is False:
            return Message(
                "Its motor does not run, because its audio firmware is not loaded; tilt it by hand."
            )
        return ""

    def _permission(self) -> Iterator[tuple[str, str]]:
        if has_udev_rule():
            yield Message("granted to whoever sits at this computer"), ""
        else:
            advice = Message(
                "Have an administrator copy {rule} to /etc/udev/rules.d, then unplug the sensors "
                "and plug them in again.",
                rule=shown(resource_path("sensors") / "70-*.rules"),
            )
            yield Message("not set up"), advice

    def _calibration(self) -> Iterator[tuple[str, str]]:
        store = SensorStore(self._paths.sensors_folder)
        serials = store.serials()
        if not serials:
            advice = Message(
                "Calibrate the sensors that you capture with: Tools ▸ Calibrate sensors."
            )
            yield Message("no sensor is calibrated on this computer"), advice
        for serial in serials:
            sensor = store.load(serial)
            assert sensor is not None
            days = [_age_days(step.made_at) for step in sensor.calibration]
            if not days:
                yield Message("{serial}: nobody has noted when", serial=serial), ""
                continue
            state = Message("{serial}: {days:.0f} days old", serial=serial, days=float(max(days)))
            old = max(days) > OLD_CALIBRATION_DAYS
            advice = Message("It is more than a year old: check it, or calibrate the sensor again.")
            yield state, advice if old else ""

    def _folders(self) -> Iterator[tuple[str, str]]:
        for folder in (self._paths.settings_folder, self._paths.data_folder):
            state = Message("{folder}", folder=shown(folder))
            if os.access(_existing(folder), os.W_OK | os.X_OK):
                yield state, ""
            else:
                yield (
                    state,
                    Message(
                        "Nothing can be written there, so neither settings nor work are kept: ask "
                        "whoever looks after this computer for the right to write."
                    ),
                )

    def _disk(self) -> Iterator[tuple[str, str]]:
        free_gb = shutil.disk_usage(_existing(self._paths.data_folder)).free / 1e9
        advice = Message("Free some space: a session takes about 100 MB, a backup more.")
        yield Message("{free:.1f} GB free", free=free_gb), advice if free_gb < LEAST_FREE_GB else ""

    def _settings(self) -> Iterator[tuple[str, str]]:
        """Read them without setting a damaged file aside, as the next start does."""
        path = self._paths.settings_file
        if not path.exists():
            yield Message("none yet; the defaults hold"), ""
            return
        if self._complaints():
            advice = Message(
                "What cannot be read gets its default at the next start; the file is kept beside."
            )
            yield Message("damaged in part"), advice
        else:
            yield Message("readable"), ""

    def _complaints(self) -> list[Message]:
        complaints: list[Message] = []
        load_settings(self._paths.settings_file, complaints.append, leave=True)
        return complaints

    def _record(self) -> Iterator[tuple[str, str]]:
        from insole_core.records.place_check import look_at_place

        location = self._location or location_of_window(self._paths)
        place = location.place()
        if not location.is_shared and place.database_file.exists():
            yield _examined_file(place.database_file)
        try:
            report = look_at_place(place)
        except RecordsError as error:
            yield Message("cannot be opened"), error.message
            return
        if location.is_shared:
            yield Message("on the server {place}, which answers", place=place.name), ""
        if report.patients is None:
            yield Message("none yet"), ""
        else:
            yield self._last_backup(report)

    def _last_backup(self, report: PlaceReport) -> tuple[str, str]:
        """Tell the age of the last good backup: by its folder where this station has one."""
        settings = peek_settings(self._paths.settings_file)
        made_at = report.last_good_backup
        if settings.backup_folder and report.backup_key is not None:
            try:
                made_at = _newest_good(Path(settings.backup_folder), report.backup_key)
            except InsoleError as error:
                return Message("the backups cannot be looked at"), error.message
        if made_at is None:
            return (
                Message("no good backup"),
                Message("Back the record up: what is in it is lost if its disk fails.")
                if report.patients
                else "",
            )
        now = datetime.now(UTC)
        state = Message(
            "last good backup {days:.1f} days old", days=(now - made_at).total_seconds() / _DAY_S
        )
        advice = Message(
            "Make a backup, and see why none was made: what was entered since is in no other place."
        )
        return state, advice if is_overdue(made_at, settings.backup_day, now) else ""


def _examined_file(path: Path) -> tuple[str, str]:
    address = f"{path.absolute().as_uri()}?mode=ro"
    with closing(sqlite3.connect(address, uri=True)) as connection:
        told = str(connection.execute("PRAGMA quick_check(1)").fetchone()[0])
    state = Message("{size:.1f} MB on this computer", size=path.stat().st_size / 1e6)
    advice = Message("The database is damaged: restore the newest backup.")
    return state, "" if told == "ok" else advice


def _newest_good(folder: Path, key: BackupKey) -> datetime | None:
    """Return when the newest backup of a folder was made that can be restored.

    Raises
    ------
    InputError
        When the folder is not there, as on a disk that is not connected.
    """
    from insole_core.records.backup.backup_folder import BackupFolder

    backups = BackupFolder(folder)
    backups.head()
    good = [known.name.made_at for known in backups.known_snapshots(key) if known.is_good]
    return good[-1] if good else None


def report_lines(found: list[Diagnosis], translate: Translate = str) -> list[str]:
    """Return the findings as the lines of a report."""
    lines = []
    for diagnosis in found:
        mark = "!" if diagnosis.advice else " "
        lines.append(f"{mark} {translate(diagnosis.topic)}: {translate(diagnosis.state)}")
        if diagnosis.advice:
            lines.append(f"    {translate(diagnosis.advice)}")
    return lines


def shown(path: Path) -> str:
    """Write a path without the name of the user."""
    try:
        return str(Path("~") / path.relative_to(Path.home()))
    except (ValueError, RuntimeError):  # elsewhere, or a user without a home
        return str(path)


def _existing(folder: Path) -> Path:
    return next((place for place in (folder, *folder.parents) if place.exists()), folder)


def _age_days(made_at: str) -> int:
    made = datetime.fromisoformat(made_at)
    made = made if made.tzinfo else made.replace(tzinfo=UTC)
    return (datetime.now(UTC) - made).days


def _kind_of(error: Exception) -> str:
    """Return what happened without the names of files."""
    return (error.strerror if isinstance(error, OSError) else None) or type(error).__name__
