"""Which visit of the clinic's record the open case is."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from insole_core.geometry.side import Side
from insole_core.records.person import Person
from insole_core.records.prescription import Base
from insole_core.records.visit import Visit


@dataclass(frozen=True, eq=False)
class KeptVisit:
    """A visit that a case was opened from, and what it is based on.

    Parameters
    ----------
    bases
        For each stored foot, the version that the next saving is based on.
    """

    person: Person
    visit: Visit
    bases: Mapping[Side, Base] = field(default_factory=dict)
