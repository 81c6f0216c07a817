"""Where the application stores its files."""

from __future__ import annotations

import logging
import time
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryFile

import platformdirs

from insole_core.files.atomic import PRIVATE_FOLDER, make_output_folder
from insole_core.files.write_errors import output_errors

log = logging.getLogger(__name__)

APPLICATION = "insole-studio"
SETTINGS_GROUP = "settings"
"""Name of the folder of the settings in a backup."""
_TRIED_BYTES = 65536


@dataclass(frozen=True)
class UserPaths:
    """The files and folders of one user."""

    settings_file: Path
    autosave_folder: Path

    @property
    def settings_folder(self) -> Path:
        """The folder of the settings, the clinic's rules and the last order."""
        return self.settings_file.parent

    @property
    def data_folder(self) -> Path:
        """The folder of calibrated sensors, unfinished captures, and captured sessions."""
        return self.autosave_folder.parent

    @property
    def sensors_folder(self) -> Path:
        """The folder of calibrated sensors."""
        return self.data_folder / "sensors"

    @property
    def calibrations_folder(self) -> Path:
        """The folder of the pictures that sensors are calibrated from."""
        return self.data_folder / "calibrations"

    @property
    def locks_folder(self) -> Path:
        """The folder of the locks of cases whose own folder takes none."""
        return self.data_folder / "locks"

    @property
    def records_folder(self) -> Path:
        """The folder of the clinic's record: its database and large files."""
        return self.data_folder / "records"

    @property
    def fetched_folder(self) -> Path:
        """The folder of copies of captures that were opened from the record."""
        return self.data_folder / "from-record"

    @property
    def papers_folder(self) -> Path:
        """The folder of copies of papers of an order, while they are printed."""
        return self.data_folder / "papers"

    @property
    def waiting_photos_folder(self) -> Path:
        """The folder of what was drawn on photos and is not in the record yet."""
        return self.data_folder / "waiting" / "photos"

    @property
    def waiting_orders_folder(self) -> Path:
        """The folder of orders that were written and are not in the record yet."""
        return self.data_folder / "waiting" / "orders"

    @property
    def erasures_folder(self) -> Path:
        """The folder of notes on what erased patients have left on this computer."""
        return self.data_folder / "erasures"

    @property
    def crashes_folder(self) -> Path:
        """The folder of reports of errors in the program itself."""
        return self.data_folder / "crashes"

    @property
    def log_file(self) -> Path:
        """The log of trouble with sensors and the database."""
        return self.data_folder / "logs" / "insole-studio.log"

    @property
    def sensors_log_file(self) -> Path:
        """The log of the process that talks to the sensors."""
        return self.log_file.with_name("sensors.log")

    @property
    def backed_up_folders(self) -> dict[str, Path]:
        """What belongs to a backup besides the record, by name."""
        return {SETTINGS_GROUP: self.settings_folder, "sensors": self.sensors_folder}

    def make_private(self) -> None:
        """Close the folders to other users; an earlier version left them open."""
        for folder in (self.settings_folder, self.data_folder):
            try:
                if folder.is_dir():
                    folder.chmod(PRIVATE_FOLDER)
            except OSError as error:
                log.warning("%s stays as open as it is: %s", folder, error)

    def check_writable(self) -> None:
        """Write to the folders, for a full disk shows only then.

        Raises
        ------
        OutputError
            When nothing can be kept in one of them.
        """
        for folder in (self.data_folder, self.settings_folder):
            make_output_folder(folder)
            with output_errors(folder), TemporaryFile(dir=folder) as file:
                file.write(bytes(_TRIED_BYTES))

    @classmethod
    def of_user(cls) -> UserPaths:
        """Return the paths of this user on this platform."""
        config = platformdirs.user_config_path(APPLICATION, appauthor=False)
        data = platformdirs.user_data_path(APPLICATION, appauthor=False)
        return cls(config / "settings.json", data / "autosave")


def is_older(path: Path, seconds: float) -> bool:
    """Return whether a path has not changed for so long; not where another window removed it."""
    try:
        return time.time() - path.stat().st_mtime > seconds
    except OSError:
        return False
