"""The audit log is read by person, author and day, by those who may."""

from __future__ import annotations

from datetime import date, timedelta

import pytest
from stations import BEN, Stations, proven

from insole_core.errors import NotAllowed, RecordsError
from insole_core.records.audit_search import (
    AuditFilter,
    authors_of_audit,
    search_audit,
    verify_audit,
)
from insole_core.records.author import Role
from insole_core.records.person import Person
from insole_core.records.records import Records
from insole_core.records.visit import Visit

TODAY = date.today()


def actions(records: Records, **wanted: object) -> list[tuple[str, str]]:
    found = search_audit(records.context, AuditFilter(**wanted))  # type: ignore[arg-type]
    return [(shown.line.action, shown.line.subject_kind) for shown in found]


def test_lines_about_a_person_are_those_about_their_visits_too(records: Records) -> None:
    anna, berit = (records.persons.add(Person(name)) for name in ("Anna", "Berit"))
    records.visits.add(Visit(anna.id, TODAY))
    records.visits.add(Visit(berit.id, TODAY))
    found = search_audit(records.context, AuditFilter(pseudonym=anna.pseudonym))
    assert [s.line.subject_kind for s in found] == ["visit", "person"]
    assert found[-1].subject == anna.pseudonym
    assert (found[0].subject, found[0].details) == (anna.pseudonym, {"person": anna.pseudonym})
    assert "Anna" not in "".join(found[-1].line.details)
    typed = f" {anna.pseudonym.lower()} "
    assert search_audit(records.context, AuditFilter(pseudonym=typed)) == found
    for pseudonym in ("d-A", "D-a"):
        records.persons.add(Person("Dora", pseudonym=pseudonym))
    (added,) = search_audit(records.context, AuditFilter(pseudonym="D-a"))
    assert added.subject == "D-a"
    with pytest.raises(RecordsError, match="Nobody has the pseudonym d-a"):
        search_audit(records.context, AuditFilter(pseudonym="d-a"))  # which of the two?
    with pytest.raises(RecordsError, match="P-NOBODY"):
        search_audit(records.context, AuditFilter(pseudonym="P-NOBODY"))


def test_lines_about_those_merged_through_others_are_found(records: Records) -> None:
    anna, berit, carin = (records.persons.add(Person(n)) for n in ("Anna", "Berit", "Carin"))
    records.persons.merge(berit.id, carin.id)
    records.persons.merge(anna.id, berit.id)
    found = actions(records, pseudonym=anna.pseudonym)
    assert sorted(found) == [("added", "person")] * 3 + [("merged", "person")] * 2


def test_lines_are_found_by_author_and_day(stations: Stations) -> None:
    records, other = stations.open(), stations.open(BEN)
    anna = records.persons.add(Person("Anna"))
    other.persons.open(anna.id)
    assert actions(records, author="ben") == [("seen", "person")]
    assert authors_of_audit(records.context) == ["anna", "ben"]
    assert len(actions(records, first_day=TODAY, last_day=TODAY)) == 2
    assert len(actions(records, first_day=TODAY)) == 2
    assert actions(records, first_day=TODAY + timedelta(days=2)) == []
    assert actions(records, last_day=TODAY - timedelta(days=2)) == []
    assert len(actions(records, first_day=date.min, last_day=date.max)) == 2


def test_the_next_page_begins_where_the_last_one_ended(records: Records) -> None:
    for number in range(5):
        records.persons.add(Person(f"Anna {number}"))
    first = search_audit(records.context, AuditFilter(), limit=3)
    rest = search_audit(records.context, AuditFilter(), before=first[-1].line.seq, limit=3)
    assert [shown.line.seq for shown in (*first, *rest)] == [5, 4, 3, 2, 1]


def test_the_log_is_for_administrators(stations: Stations) -> None:
    records = stations.open()
    records.accounts.switch_on("root", "Rut Root", "four words in a row")
    admin = records.for_author(proven("root", Role.ADMINISTRATOR))
    admin.accounts.add("eva", "Eva Ek", Role.TECHNICIAN, "other words in a row")
    eva = records.for_author(proven("eva", Role.TECHNICIAN))
    for ask in (
        lambda: search_audit(eva.context, AuditFilter()),
        lambda: authors_of_audit(eva.context),
        lambda: verify_audit(eva.context),
    ):
        with pytest.raises(NotAllowed, match="read the audit log"):
            ask()
    assert verify_audit(admin.context).is_intact
    assert search_audit(admin.context, AuditFilter())[0].subject == "eva"
