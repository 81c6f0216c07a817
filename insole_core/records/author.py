"""Who works on the record, at which station and when, with which program, and how it was proven."""

from __future__ import annotations

import os
import platform
from dataclasses import dataclass
from datetime import UTC, datetime
from enum import StrEnum
from functools import cache
from importlib.metadata import version
from typing import Final

TIME_FORMAT: Final = "%Y-%m-%dT%H:%M:%S.%fZ"


try:
    import pwd
except ImportError:  # on Windows, where this is the name in the program's access token

    def _own_name() -> str:
        return os.getlogin()
else:

    def _own_name() -> str:
        return pwd.getpwuid(os.getuid()).pw_name


class Role(StrEnum):
    """What somebody is in the clinic, from which follows what their account may do."""

    ORTHOPEDIST = "orthopedist"
    TECHNICIAN = "technician"
    ADMINISTRATOR = "administrator"
    BACKUP_SERVICE = "backup service"
    """No person: a scheduled task, which makes and verifies backups."""

    @property
    def sees_patients(self) -> bool:
        """Whether the role treats patients."""
        return self in (Role.ORTHOPEDIST, Role.TECHNICIAN)


class Proof(StrEnum):
    """How it was proven who somebody is; the audit log keeps it with every line."""

    NONE = "none"
    """Not at all: the name is that of the operating system's user, who is nobody once the record
    has accounts."""
    PASSWORD = "password"
    SYSTEM_USER = "system user"
    """The operating system, or the server of the database, says which of its users it is."""


@dataclass(frozen=True)
class Author:
    """Who changes the record.

    Parameters
    ----------
    name
        Of the account; while accounts are off, of the operating system's user.
    station
        Name of the computer.
    proof
        Only `insole_core.records.accounts` states another one than none.
    """

    name: str
    station: str
    role: Role = Role.ORTHOPEDIST
    proof: Proof = Proof.NONE

    @classmethod
    def of_user(cls) -> Author:
        """Return the operating system's user at this computer."""
        return cls(system_user() or "?", platform.node() or "?")


def system_user() -> str:
    """Return the name of whoever runs this program, as the operating system knows it.

    Not the environment's, which anybody can set. Empty where the user has no name, as in some
    containers.
    """
    try:
        return _own_name()
    except (KeyError, OSError):
        return ""


def utc_now() -> str:
    """Return the present time as the record writes it: ``2026-11-20T10:00:00.000000Z``."""
    return datetime.now(UTC).strftime(TIME_FORMAT)


@cache
def program_version() -> str:
    """Return the version of this program."""
    return version("insole-studio")
