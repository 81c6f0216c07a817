"""What a snapshot of the record consists of."""

from __future__ import annotations

import json
from dataclasses import asdict, dataclass
from typing import Any, Self

from insole_core.errors import RecordsError
from insole_core.records.backup.backup_key import damaged

FORMAT = 1


@dataclass(frozen=True)
class TableContent:
    """The rows of a table.

    Parameters
    ----------
    columns
        Names, in the order of the values of a row.
    pieces
        SHA-256 of each piece, in order.
    """

    name: str
    columns: tuple[str, ...]
    rows: int
    pieces: tuple[str, ...]


@dataclass(frozen=True)
class SavedFile:
    """A file of the settings.

    Parameters
    ----------
    group
        Which folder it is from, such as "settings".
    name
        Path within the folder, with slashes.
    """

    group: str
    name: str
    sha256: str
    size: int


@dataclass(frozen=True)
class Manifest:
    """The content of a snapshot.

    Parameters
    ----------
    made_at
        UTC.
    schema
        Revision of the tables.
    audit_seq, audit_hash
        Last line of the audit log.
    contents, contents_bytes
        Large files that the tables refer to.
    damaged
        SHA-256 of those that were missing or damaged when the backup was made, and are not in it.
    erased
        Ids of erased persons, who stay erased when an earlier snapshot is restored.
    """

    made_at: str
    program_version: str
    schema: str
    audit_seq: int
    audit_hash: str
    tables: tuple[TableContent, ...]
    files: tuple[SavedFile, ...]
    contents: int
    contents_bytes: int
    damaged: tuple[str, ...] = ()
    erased: tuple[str, ...] = ()

    def as_json(self) -> bytes:
        """Return the manifest as a snapshot holds it."""
        return json.dumps({"format": FORMAT, **asdict(self)}, ensure_ascii=False).encode()

    @classmethod
    def from_json(cls, content: bytes, name: str) -> Self:
        """Read a manifest that was authenticated.

        Raises
        ------
        RecordsError
            When it comes from a newer program.
        DamagedBackup
        """
        try:
            values: dict[str, Any] = json.loads(content)
            if values.pop("format") != FORMAT:
                raise RecordsError(
                    "The backup {name} comes from a newer Insole Studio; install the newest "
                    "version.",
                    name=name,
                )
            tables = [TableContent(**_tuples(table)) for table in values.pop("tables")]
            files = [SavedFile(**file) for file in values.pop("files")]
            return cls(tables=tuple(tables), files=tuple(files), **_tuples(values))
        except (ValueError, KeyError, TypeError) as error:
            raise damaged(name) from error


def _tuples(values: dict[str, Any]) -> dict[str, Any]:
    return {
        key: tuple(value) if isinstance(value, list) else value for key, value in values.items()
    }
