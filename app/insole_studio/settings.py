"""The settings of the window; a bad entry costs a warning, never the start."""

from __future__ import annotations

import json
import logging
from dataclasses import asdict, dataclass, field, fields
from pathlib import Path
from typing import Literal, get_type_hints

from insole_core.files.atomic import make_output_folder, replacing_file
from insole_core.forgiving_json import Complain, entries_of_others, remembered
from insole_core.reconstruct.poses.pose_quality import DEFAULT_LIMITS
from insole_studio.languages import Language

log = logging.getLogger(__name__)

RECENT_COUNT = 8
LAST_HOUR = 23

Theme = Literal["system", "light", "dark"]
BackupDay = Literal["never", "daily", "0", "1", "2", "3", "4", "5", "6"]
BackupKeep = Literal["all", "months", "year"]


@dataclass
class Settings:
    """All settings of the window, with their defaults.

    `window_geometry` and `window_docks` are Qt's own packed states in base64; `capture_views` says
    which sensor gives which view (``left=SERIAL``); `device` is that of new designs; `author`,
    `clinic`, `maker` and `maker_address` stand on the prescription; file dialogs start in the
    folder of their kind; `number_kind` is that of new personal numbers. `record_database` is the
    address of a shared record without its password, empty for the record of this computer;
    `record_contents` is the folder of its large files; `record_had_accounts` says that nobody sees
    a patient before signing in, also while it does not answer. Backups go to `backup_folder` at
    `backup_hour` of every day ("daily") or of a day of the week (0 for Monday), or on demand only;
    `backup_keep` says which of them stay: all, or those of 30 days and then one of each month, of
    all months or of the last twelve. `backup_used_folder` had a backup before, so that an empty one
    in its place is a disk that is not connected. Nobody is reminded of backups before
    `backup_reminder_from`, a day as in ISO 8601.
    A view is refused if its pose exceeds the largest residuals or displacement.
    """

    theme: Theme = "system"
    linked_views: bool = True
    language: Language = "system"
    touch: bool = False
    software_rendering: bool = False
    tour_seen: bool = False
    pressure_change_read: bool = False
    version_used: str = ""
    author: str = ""
    clinic: str = ""
    maker: str = ""
    maker_address: str = ""
    number_kind: str = ""
    record_database: str = ""
    record_contents: str = ""
    record_had_accounts: bool = False
    backup_folder: str = ""
    backup_day: BackupDay = "never"
    backup_hour: int = 12
    backup_keep: BackupKeep = "months"
    backup_used_folder: str = ""
    backup_reminder_from: str = ""
    recent: list[str] = field(default_factory=list)
    cases_folder: str = ""
    scans_folder: str = ""
    exports_folder: str = ""
    papers_folder: str = ""
    pictures_folder: str = ""
    backups_parent_folder: str = ""
    records_parent_folder: str = ""
    window_geometry: str = ""
    window_docks: str = ""
    capture_views: list[str] = field(default_factory=list)
    largest_residual_mm: float = DEFAULT_LIMITS.residual_mm
    largest_reprojection_px: float = DEFAULT_LIMITS.reprojection_px
    largest_displacement_mm: float = DEFAULT_LIMITS.displacement_mm

    def remember(self, path: Path) -> None:
        """Put `path` at the head of the recent files, unless its name is no text."""
        try:
            str(path).encode()
        except UnicodeEncodeError:
            return
        others = [name for name in self.recent if name != str(path)]
        self.recent = [str(path), *others][:RECENT_COUNT]


def folder_names() -> list[str]:
    """Return the names of the settings that hold the folder of a file dialog or of backups."""
    return [each.name for each in fields(Settings) if each.name.endswith("_folder")]


def load_settings(path: Path, complain: Complain = log.warning, *, leave: bool = False) -> Settings:
    """Read the settings; absent or invalid entries get their defaults.

    Parameters
    ----------
    complain
        Called with a sentence for the user if something is not understood; the file is kept then.
    leave
        Leave the file as it is, whatever is wrong with it.
    """
    entries = remembered(path, get_type_hints(Settings), complain, leave=leave)
    settings = Settings(**entries)
    settings.recent = settings.recent[:RECENT_COUNT]
    settings.backup_hour = min(max(settings.backup_hour, 0), LAST_HOUR)
    return settings


def peek_settings(path: Path) -> Settings:
    """Read the settings without a word, and leave the file as it is, whatever is wrong with it."""
    return load_settings(path, lambda _sentence: None, leave=True)


def save_settings(settings: Settings, path: Path) -> None:
    """Write the settings, if they changed; those of another version that shares the file stay.

    Raises
    ------
    OutputError
        When the file cannot be written.
    """
    make_output_folder(path.parent)
    own = asdict(settings)
    text = json.dumps(entries_of_others(path, own) | own, indent=1)
    if _holds(path, text):
        return
    with replacing_file(path.resolve()) as beside:  # whoever keeps them elsewhere has made a link
        beside.write_text(text, encoding="utf-8", newline="\n")


def _holds(path: Path, text: str) -> bool:
    try:
        return path.read_bytes() == text.encode()
    except OSError:
        return False
