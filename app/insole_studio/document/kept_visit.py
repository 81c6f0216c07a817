"""Which visit of the clinic's record the open case is."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace

from insole_core.cases.case_record import Patient
from insole_core.geometry.side import Side
from insole_core.records.person import Person, new_id
from insole_core.records.prescription import Base
from insole_core.records.visit import Visit


@dataclass(frozen=True, eq=False)
class KeptVisit:
    """A visit that a case was opened from, and what it is based on.

    Parameters
    ----------
    bases
        For each stored foot, the version that the next saving is based on.
    editing
        Names what is stored from now on as the work of one editing; see `Prescriptions.save`.
    sent
        The patient's fields as they were sent to the record since it answered last; any of them may
        be stored.
    """

    person: Person
    visit: Visit
    bases: Mapping[Side, Base] = field(default_factory=dict)
    editing: str = field(default_factory=new_id)
    sent: tuple[Patient, ...] = ()

    def begun_anew(self) -> KeptVisit:
        """Return it as another editing, which continues no version of this one."""
        bases = {side: replace(base, is_mine=False) for side, base in self.bases.items()}
        return replace(self, bases=bases, editing=new_id())

    def sending(self, patient: Patient) -> KeptVisit:
        """Return it with the patient's fields among those sent."""
        return self if patient in self.sent else replace(self, sent=(*self.sent, patient))
