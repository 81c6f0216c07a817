"""Those who work on the record of a test, each at a station."""

from __future__ import annotations

from dataclasses import dataclass

from insole_core.records.author import Author, Proof, Role
from insole_core.records.open import open_records
from insole_core.records.place import RecordsPlace
from insole_core.records.records import Records

ANNA = Author("anna", "desk")
BEN = Author("ben", "capture room")


def proven(name: str, role: Role = Role.ORTHOPEDIST, station: str = "desk") -> Author:
    """Return somebody who has signed in with a password."""
    return Author(name, station, role, Proof.PASSWORD)


@dataclass
class Stations:
    """A place, and the records that stations have open there."""

    place: RecordsPlace
    opened: list[Records]

    def open(self, who: Author = ANNA) -> Records:
        records = open_records(self.place, who)
        self.opened.append(records)
        return records
