"""Every part of the record asks for the right to what is done, once accounts are on."""

from __future__ import annotations

import ast
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


def test_an_administrator_sees_no_patients(stations: Stations, visit: Visit) -> None:
    roles = (Role.ADMINISTRATOR, "somebody", Role.TECHNICIAN)
    administrator, somebody, technician = (signed_in(stations, role) for role in roles)
    for name, use in (SEES | WRITES).items():
        for who, why in ((administrator, "may not"), (somebody, "not signed in")):
            with pytest.raises(NotAllowed) as refused:
                use(who, visit)
            assert why in str(refused.value), name
        use(technician, visit)


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


ROOT = Path(__file__).parents[3]
CHECKS = {"require", "require_signed_in", "_require_management"}
OPENS = {"reading", "writing", "snapshot"}
UNCHECKED = {
    # What signs in, or has to be known before: it tells nothing of anybody.
    "records/accounts.py are_on",
    "records/accounts.py switch_on",
    "records/accounts.py were_switched_off_unseen",
    "records/accounts.py sign_in",
    "records/accounts.py sign_in_system_user",
    "records/accounts.py _note_success",
    "records/accounts.py change_password",
    "records/accounts.py _count_in_record",
    "records/accounts.py _count_here",
    "records/clinic.py get",
    "records/backup/back_up.py key_of_backups",
    "records/backup/back_up.py last_backup_at",
    "records/place_check.py look_at_place",
    # Ids of what has changed, so that a window notices that accounts were switched on.
    "records/stations.py mark",
    "records/stations.py since",
    # Whether the record is that of a first start, or has somebody to lose.
    "records/sample_patient.py is_untouched",
    # Ids of who is erased in a record that is set aside for a restored one, to erase them again.
    "records/backup/restore.py _erased_in",
    # A number of the clinic's, which is nobody's.
    "records/retention.py years_of_keeping",
    # Called by what has checked.
    "records/retention.py over_retention_named",
    "records/migrate.py _put_back_file",
    "records/migrate.py _put_back_schema",
    # Before there is anybody: opening, migrating, restoring to an empty place.
    "records/records.py snapshot",
    "records/migrate.py migrate",
    "records/records.py _why_server_read_only",
    "records/records.py _check_tables",
    "records/records.py _content_store",
    "records/backup/restore.py _fill",
    "records/backup/restore.py _check_empty",
    "records/migrate.py copies_of",
    "records/migrate.py forget_copies",
    "records/deleted_text.py finish_erasing",
}
"""Functions that open a transaction of the database without a check of their own, and why."""


def test_whatever_opens_a_transaction_checks_or_is_known() -> None:
    found = set()
    for path in sorted((ROOT / "insole_core").rglob("*.py")):
        source = path.read_text("utf-8")
        if not any(f".{name}" in source for name in OPENS):
            continue
        tree = ast.parse(source)
        for function in (node for node in ast.walk(tree) if isinstance(node, ast.FunctionDef)):
            if _opens(function) and not _calls(function) & CHECKS:
                found.add(f"{path.relative_to(ROOT / 'insole_core').as_posix()} {function.name}")
    assert found == UNCHECKED


def _opens(function: ast.FunctionDef) -> bool:
    """Tell whether a function asks the database itself, not what checks before it does."""
    return any(
        isinstance(node, ast.Call)
        and isinstance(node.func, ast.Attribute)
        and node.func.attr in OPENS
        and "database" in ast.unparse(node.func.value)
        for node in ast.walk(function)
    )


def _calls(function: ast.FunctionDef) -> set[str]:
    calls = (node.func for node in ast.walk(function) if isinstance(node, ast.Call))
    return {getattr(call, "id", getattr(call, "attr", "")) for call in calls}
