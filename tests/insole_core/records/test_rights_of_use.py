"""Every part of the record asks for the right to what is done, once accounts are on."""

from __future__ import annotations

from collections.abc import Callable
from datetime import date
from pathlib import Path

import pytest
from sqlalchemy import insert
from stations import Stations, proven

from insole_core.cases.case_record import FootRecord
from insole_core.errors import NotAllowed
from insole_core.records.author import Role
from insole_core.records.captures import MESH
from insole_core.records.clinic import write_setting
from insole_core.records.person import Person
from insole_core.records.records import Records
from insole_core.records.rights import ACCOUNTS_ON
from insole_core.records.schema import accounts
from insole_core.records.visit import Visit


@pytest.fixture
def visit(stations: Stations, foot_record: FootRecord) -> Visit:
    """A visit with a prescription, of a record whose accounts are switched on by then."""
    records = stations.open()
    person = records.persons.add(Person("Anna Berg"))
    visit = records.visits.add(Visit(person.id, date.today()))
    records.prescriptions.save(visit.id, foot_record, None)
    with records.context.database.writing() as connection:
        for role in Role:
            account = {"id": role, "name": role, "full_name": role, "role": role}
            connection.execute(insert(accounts).values(**account, password_hash="", changed_at=""))
        write_setting(connection, ACCOUNTS_ON, True)
    return visit


def signed_in(stations: Stations, role: str) -> Records:
    return stations.open(proven(role))


Use = Callable[[Records, Visit], object]
SEES: dict[str, Use] = {
    "search": lambda r, _: r.persons.search("anna"),
    "duplicates": lambda r, _: r.persons.alike(),
    "person": lambda r, v: r.persons.open(v.person_id),
    "case": lambda r, v: r.visits.open_case(v.id),
    "orders": lambda r, _: r.orders.open(),
    "presence": lambda r, v: r.presence.enter(v.id),
}
WRITES: dict[str, Use] = {
    "add": lambda r, _: r.persons.add(Person("Ben")),
    "visit": lambda r, v: r.visits.add(Visit(v.person_id, date.today())),
    "capture": lambda r, v: r.captures.add(v.id, MESH, Path(__file__)),
}


@pytest.mark.parametrize("use", [*SEES.values(), *WRITES.values()], ids=[*SEES, *WRITES])
def test_an_administrator_sees_no_patients(stations: Stations, visit: Visit, use: Use) -> None:
    with pytest.raises(NotAllowed, match="may not"):
        use(signed_in(stations, Role.ADMINISTRATOR), visit)
    with pytest.raises(NotAllowed, match="not signed in"):
        use(signed_in(stations, "somebody"), visit)
    use(signed_in(stations, Role.TECHNICIAN), visit)


def test_a_technician_neither_signs_nor_merges(stations: Stations, visit: Visit) -> None:
    technician = signed_in(stations, Role.TECHNICIAN)
    other = technician.persons.add(Person("Ben"))
    base = next(iter(technician.visits.open_case(visit.id).bases.values()))
    with pytest.raises(NotAllowed, match="sign prescriptions"):
        technician.prescriptions.sign(base.version_id)
    with pytest.raises(NotAllowed, match="merge patients"):
        technician.persons.merge(visit.person_id, other.id)
    orthopedist = signed_in(stations, Role.ORTHOPEDIST)
    assert orthopedist.prescriptions.sign(base.version_id).signed_by == "orthopedist"
    orthopedist.persons.merge(visit.person_id, other.id)
