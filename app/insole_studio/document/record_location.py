"""Where the clinic's record is, as the settings of this computer say."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING

from insole_core.errors import InputError

if TYPE_CHECKING:
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
