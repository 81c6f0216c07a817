"""The last line of the audit log, also kept beside the large files.

Whoever cuts the end of the log off and corrects its head leaves a chain that is intact. This file
knows of a later line, as backups do.
"""

from __future__ import annotations

import logging
import os
import re
from pathlib import Path
from typing import Final

from sqlalchemy import Connection, select

from insole_core.records.content_store import HEAD_FILE
from insole_core.records.schema import audit, audit_head

log = logging.getLogger(__name__)

_LINE: Final = re.compile(rb"(\d{20}) ([0-9a-f]{64})\n")
_LENGTH: Final = 86
"""Every line is as long: it is written over the one before it, in one step."""


class HeadWitness:
    """A file with number and hash of the last line of the audit log.

    Parameters
    ----------
    folder
        Of the large files; nothing is written before it is there.
    """

    def __init__(self, folder: Path) -> None:
        self._path = folder / HEAD_FILE

    def read(self) -> dict[int, str]:
        """Return the hash of the line by its number; nothing where there is none."""
        try:
            with self._path.open("rb") as file:
                found = _LINE.fullmatch(file.read(_LENGTH))
        except OSError:
            return {}
        return {} if found is None else {int(found[1]): found[2].decode("ascii")}

    def coming(self, connection: Connection) -> tuple[int, str] | None:
        """Return the head to write once a transaction is through.

        None where the log has lost what the file knows: then the file stays as the proof of it.
        """
        for seq, known in self.read().items():
            query = select(audit.c.hash).where(audit.c.seq == seq)
            if seq and connection.execute(query).scalar() != known:
                return None
        seq, last = connection.execute(select(audit_head.c.seq, audit_head.c.hash)).one()
        return int(seq), str(last)

    def write(self, head: tuple[int, str]) -> None:
        """Write the head; what cannot be written is told in the log of the program only."""
        line = f"{head[0]:020} {head[1]}\n".encode("ascii")
        try:
            if self._path.parent.is_dir():
                file = os.open(self._path, os.O_WRONLY | os.O_CREAT, 0o600)
                try:
                    os.write(file, line)
                finally:
                    os.close(file)
        except OSError as error:
            log.warning("%s cannot be written: %s", self._path, error)

    def forget(self) -> None:
        """Remove the file, as another record comes to this place."""
        try:
            self._path.unlink(missing_ok=True)
        except OSError as error:
            log.warning("%s cannot be removed: %s", self._path, error)
