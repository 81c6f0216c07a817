"""Who works on the record, and at which station."""

from __future__ import annotations

import getpass
import platform
from dataclasses import dataclass
from enum import StrEnum


class Role(StrEnum):
    """What somebody is in the clinic, from which follows what their account may do."""

    ORTHOPEDIST = "orthopedist"
    TECHNICIAN = "technician"
    ADMINISTRATOR = "administrator"


@dataclass(frozen=True)
class Author:
    """Who changes the record.

    Parameters
    ----------
    name
        Of the account; while accounts are off, of the operating system's user.
    station
        Name of the computer.
    """

    name: str
    station: str
    role: Role = Role.ORTHOPEDIST

    @classmethod
    def of_user(cls) -> Author:
        """Return the operating system's user at this computer."""
        try:
            name = getpass.getuser()
        except (ImportError, KeyError, OSError):  # no name: some containers, services of Windows
            name = ""
        return cls(name or "?", platform.node() or "?")
