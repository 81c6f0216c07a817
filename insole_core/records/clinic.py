"""Settings of the clinic, which all stations share."""

from __future__ import annotations

import json
from typing import Any, Final

from sqlalchemy import Connection, select

from insole_core.records.context import RecordsContext
from insole_core.records.database import upsert
from insole_core.records.rights import Right
from insole_core.records.schema import clinic

ERASING: Final = "erasing "
"""How the key of a setting begins that says who was erased while their text is still in files."""


class ClinicSettings:
    """JSON values by name."""

    def __init__(self, context: RecordsContext) -> None:
        self._context = context

    def get(self, key: str, default: Any = None) -> Any:
        """Return a setting; `default` where it was never set."""
        with self._context.database.reading() as connection:
            return setting_of(connection, key, default)

    def set(self, key: str, value: Any) -> None:
        """Store a setting.

        Parameters
        ----------
        value
            Anything that JSON can hold.
        """
        with self._context.writing(Right.SET_UP) as connection:
            write_setting(connection, key, value)
            self._context.log(connection, "changed", "clinic", key)


def setting_of(connection: Connection, key: str, default: Any = None) -> Any:
    """Return a setting; `default` where it was never set."""
    stored = connection.execute(select(clinic.c.value).where(clinic.c.key == key)).scalar()
    return default if stored is None else json.loads(stored)


def write_setting(connection: Connection, key: str, value: Any) -> None:
    """Write a setting, in a transaction of the caller."""
    upsert(connection, clinic, {"key": key, "value": json.dumps(value)}, ["value"])
