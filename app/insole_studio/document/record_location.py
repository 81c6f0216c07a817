"""Where the clinic's record is, as the settings of this computer say."""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING

from insole_core.errors import InputError
from insole_core.forgiving_json import remembered
from insole_studio.settings import load_settings, save_settings
from insole_studio.user_paths import SETTINGS_GROUP, UserPaths

if TYPE_CHECKING:
    from insole_core.messages import Message
    from insole_core.records.backup.snapshot import SavedFile
    from insole_core.records.place import RecordsPlace


@dataclass(frozen=True)
class RecordLocation:
    """The record of this computer, or one on a server that stations share.

    Parameters
    ----------
    folder
        Of the record of this computer.
    url
        Of the database of a shared record, without a password; empty for that of this computer.
    contents
        Folder of the large files of a shared record.
    password
        Of the database, for as long as the program runs; empty where PostgreSQL's own password
        file has it.
    """

    folder: Path
    url: str = ""
    contents: str = ""
    password: str = field(default="", repr=False)

    @property
    def is_shared(self) -> bool:
        """Whether the record is on a server."""
        return bool(self.url)

    def place(self) -> RecordsPlace:
        """Return the place; the database's library is imported with the first call.

        Raises
        ------
        InputError
            When the address or the folder of a shared record cannot be right.
        """
        from insole_core.records.place import RecordsPlace

        if not self.is_shared:
            return RecordsPlace.local(self.folder)
        if not Path(self.contents).is_absolute():
            raise InputError(
                "A shared record needs the folder of its large files, on a share that all "
                "stations reach; choose it."
            )
        return RecordsPlace.of_url(self.url, Path(self.contents)).with_password(self.password)


def location_of_window(paths: UserPaths) -> RecordLocation:
    """Return where the record is that the window opens, for whoever must not mistake another one.

    Raises
    ------
    InputError
        When the settings do not tell it: their defaults would name another record.
    """
    wrong: list[Message] = []
    kinds = {"record_database": str, "record_contents": str}
    told = remembered(paths.settings_file, kinds, wrong.append, leave=True)
    if wrong:
        raise InputError(
            "The settings in {path} are damaged, so it is not known where the record is; start "
            "the window once to mend them, or name the record.",
            path=paths.settings_file,
        )
    return RecordLocation(
        paths.records_folder, told.get("record_database", ""), told.get("record_contents", "")
    )


def let_window_open(location: RecordLocation, paths: UserPaths) -> None:
    """Let the window open another record from its next start on.

    Raises
    ------
    OutputError
    """
    settings = load_settings(paths.settings_file)
    wanted = location.url, location.contents
    if (settings.record_database, settings.record_contents) != wanted:
        settings.record_database, settings.record_contents = wanted
        save_settings(settings, paths.settings_file)


def settings_for(location: RecordLocation, paths: UserPaths) -> Callable[[SavedFile, bytes], bytes]:
    """Return what changes restored settings: they name the record of the computer before."""

    def revise(file: SavedFile, content: bytes) -> bytes:
        if (file.group, file.name) != (SETTINGS_GROUP, paths.settings_file.name):
            return content
        try:
            values = json.loads(content)
        except (ValueError, RecursionError):  # the window tells it, and uses its defaults
            return content
        if not isinstance(values, dict):
            return content
        place = {"record_database": location.url, "record_contents": location.contents}
        return json.dumps(values | place, indent=1).encode()

    return revise
