"""Those who work on the record of a test, each at a station."""

from __future__ import annotations

from dataclasses import dataclass, replace

from insole_core.records.accounts import Account, Accounts
from insole_core.records.author import Author, Proof, Role
from insole_core.records.open import open_records
from insole_core.records.place import RecordsPlace
from insole_core.records.records import Records

ANNA = Author("anna", "desk")
BEN = Author("ben", "capture room")
FIRST = "told across the desk"


def proven(name: str, role: Role = Role.ORTHOPEDIST, station: str = "desk") -> Author:
    """Return somebody who has signed in with a password."""
    return Author(name, station, role, Proof.PASSWORD)


def add_member(accounts: Accounts, name: str, full_name: str, role: Role, password: str) -> Account:
    """Add an account whose owner has chosen their password."""
    added = accounts.add(name, full_name, role, FIRST)
    accounts.change_password(name, FIRST, password)
    return replace(added, has_first_password=False)


@dataclass
class Stations:
    """A place, and the records that stations have open there."""

    place: RecordsPlace
    opened: list[Records]

    def open(self, who: Author = ANNA) -> Records:
        records = open_records(self.place, who)
        self.opened.append(records)
        return records
