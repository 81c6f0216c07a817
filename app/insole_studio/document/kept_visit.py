"""Which visit of the clinic's record the open case is, and what it has to be stored over."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, fields, replace
from typing import TYPE_CHECKING, Any

from insole_core.cases.case_record import CaseRecord, Patient
from insole_core.export.shop_order import OrderTerms, terms_from_json, terms_to_json
from insole_core.geometry.side import Side
from insole_core.json_object import JsonObject
from insole_core.records.person import Person, new_id
from insole_core.records.prescription import Base
from insole_core.records.visit import Visit

if TYPE_CHECKING:
    from insole_core.workflows.records.keep_case import CaseChange

_FIELDS = tuple(part.name for part in fields(Patient))
MOST_REVISIONS = 2**53
"""Of a row of the record."""


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


@dataclass(frozen=True)
class UnkeptVisit:
    """A visit with changes that the clinic's record does not hold yet.

    Parameters
    ----------
    before
        The patient's fields as they were stored last.
    bases
        For each foot that has changed, the version it is based on; None for a new foot.
    editing, sent
        As in `KeptVisit`.
    terms
        What the shop was to be told, as it was stored last.
    """

    visit_id: str
    before: Patient
    bases: Mapping[Side, Base | None]
    editing: str = ""
    sent: tuple[Patient, ...] = ()
    terms: OrderTerms = field(default_factory=OrderTerms)

    @classmethod
    def of(
        cls, kept: KeptVisit, before: CaseRecord, now: CaseRecord, *, all_feet: bool = False
    ) -> UnkeptVisit:
        """Return what has changed between two states of a visit; for `all_feet` each has."""
        changed = (f.side for f in now.feet if all_feet or f is not before.of_side(f.side))
        bases = {side: kept.bases.get(side) for side in changed}
        terms = before.order.terms
        return cls(kept.visit.id, before.patient, bases, kept.editing, kept.sent, terms)

    def change_to(self, now: CaseRecord) -> CaseChange:
        """Return what is to be stored of the visit as it is now."""
        from insole_core.workflows.records.keep_case import CaseChange

        return CaseChange(
            self.visit_id, self.before, now, self.bases, self.editing, self.sent, self.terms
        )

    def to_json(self) -> dict[str, Any]:
        """Return it as values for `json.dumps`."""
        return {
            "id": self.visit_id,
            "before": _fields_of(self.before),
            "sent": [_fields_of(patient) for patient in self.sent],
            "editing": self.editing,
            "terms": terms_to_json(self.terms),
            "bases": {
                str(side): None
                if base is None
                else {"version": base.version_id, "revision": base.revision, "mine": base.is_mine}
                for side, base in self.bases.items()
            },
        }

    @classmethod
    def from_json(cls, stored: JsonObject) -> UnkeptVisit:
        """Return it from what `to_json` gave.

        Raises
        ------
        InputError
            When it is none.
        """
        before = _patient(stored.object("before"))
        kept = stored.object("bases")
        bases = {side: _base(kept, side) for side in Side if kept.has(str(side))}
        if not stored.has("editing"):  # of a program of before 2026-11-26
            return cls(stored.text("id"), before, bases)
        sent = tuple(_patient(patient) for patient in stored.objects("sent"))
        editing = stored.text("editing", empty=True)
        if not stored.has("terms"):  # also of that day
            return cls(stored.text("id"), before, bases, editing, sent)
        terms = terms_from_json(stored.object("terms"))
        return cls(stored.text("id"), before, bases, editing, sent, terms)


def _fields_of(patient: Patient) -> dict[str, str]:
    return {key: getattr(patient, key) for key in _FIELDS}


def _patient(stored: JsonObject) -> Patient:
    return Patient(**{key: stored.text(key, empty=True) for key in _FIELDS})


def _base(bases: JsonObject, side: Side) -> Base | None:
    if bases.value(str(side)) is None:
        return None
    base = bases.object(str(side))
    revision = base.integer("revision", 0, MOST_REVISIONS)
    return Base(base.text("version"), revision, base.flag("mine"))
