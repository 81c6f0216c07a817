"""Signing makes a version of a prescription immutable, and every change of it is found."""

from __future__ import annotations

from collections.abc import Iterator
from datetime import date
from typing import Any

import pytest
from sqlalchemy import delete, insert, select, update
from stations import Stations, proven
from tampering import without_triggers

from insole_core.errors import NotAllowed, RecordsError
from insole_core.records import schema
from insole_core.records.accounts import Accounts
from insole_core.records.audit import AuditLog
from insole_core.records.author import Author, Role
from insole_core.records.database import Database
from insole_core.records.signing import (
    SIGNED_COLUMNS,
    Signature,
    SignatureReport,
    digest_of,
    sign,
    verify_signatures,
)

ANNA = Author("anna", "desk")
MESH = "ab" * 32


@pytest.fixture
def database(stations: Stations) -> Database:
    """Of an empty record, in each kind of database."""
    return stations.open().context.database


@pytest.fixture
def version_id(database: Database) -> Iterator[str]:
    """A version that is still being edited."""
    times = {"created_at": "2026-11-22", "changed_at": "2026-11-22", "revision": 1}
    rows: list[tuple[Any, dict[str, Any]]] = [
        (schema.contents, {"sha256": MESH, "size": 1, "kind": "mesh", "created_at": "2026"}),
        (schema.persons, {"id": "p", "name": "", "search_text": "", "pseudonym": "26", **times}),
        (schema.visits, {"id": "v", "person_id": "p", "visited_on": date(2026, 11, 22), **times}),
        (schema.prescription_versions, {
            "id": "left", "visit_id": "v", "side": "left", "number": 1, "document": '{"å": 1}',
            "mesh_sha256": MESH, "author": "anna", "station": "desk", "program_version": "0.1",
            **times,
        }),
    ]  # fmt: skip
    with database.writing() as connection:
        for table, values in rows:
            connection.execute(insert(table).values(values))
    return "left"


def signed(database: Database, version_id: str, author: Author = ANNA) -> Signature:
    with database.writing() as connection:
        return sign(connection, version_id, author)


def report_of(database: Database) -> SignatureReport:
    with database.reading() as connection:
        return verify_signatures(connection)


def test_a_signed_version_states_who_signed_and_is_closed(
    database: Database, version_id: str
) -> None:
    signature = signed(database, version_id)
    with database.reading() as connection:
        row = connection.execute(select(schema.prescription_versions)).one()
    assert (row.signed_by, row.signed_at, row.signature) == (
        signature.signed_by, signature.signed_at, signature.digest,
    )  # fmt: skip
    assert row.is_closed
    assert row.revision == 2  # who still edits it learns of it
    assert signature.digest == digest_of(row._asdict())
    assert signature.digest in AuditLog(database, ANNA).lines()[0].details
    assert report_of(database) == SignatureReport(checked=1)


def test_a_closed_version_is_signed_as_it_is(database: Database, version_id: str) -> None:
    with database.writing() as connection:
        connection.execute(update(schema.prescription_versions).values(is_closed=True))
    signed(database, version_id)
    assert report_of(database) == SignatureReport(checked=1)


def test_a_version_is_signed_once(database: Database, version_id: str) -> None:
    signed(database, version_id)
    with pytest.raises(RecordsError, match="anna has signed this version already"):
        signed(database, version_id, Author("eva", "desk"))
    with pytest.raises(RecordsError, match="not in the record any more"):
        signed(database, "right")


def test_only_who_may_sign_signs(database: Database, version_id: str) -> None:
    accounts = Accounts(database, ANNA)
    accounts.switch_on("chef", "Carla Chef", "vier Schuhe gehen")
    administered = Accounts(database, proven("chef", Role.ADMINISTRATOR))
    administered.add("tim", "Tim Ek", Role.TECHNICIAN, "vier Schuhe gehen")
    with pytest.raises(NotAllowed, match=r"tim .technician. may not sign prescriptions"):
        signed(database, version_id, proven("tim", Role.ORTHOPEDIST))
    assert report_of(database).checked == 0


CHANGES = {
    "document": "x", "mesh_sha256": "cd" * 32, "side": "right", "author": "eva", "number": 2,
    "signed_by": "eva", "signed_at": "1970", "signature": "x", "is_closed": False,
    "reason": "because", "program_version": "0.2", "created_at": "1970", "station": "shop",
}  # fmt: skip


def test_the_database_refuses_to_change_what_is_signed(database: Database, version_id: str) -> None:
    signed(database, version_id)
    for column, value in CHANGES.items():
        change = update(schema.prescription_versions).values({column: value})
        with pytest.raises(RecordsError), database.writing() as connection:
            connection.execute(change)
    assert report_of(database) == SignatureReport(checked=1)


@pytest.mark.parametrize("column", CHANGES)
def test_a_change_behind_the_back_of_the_database_is_found(
    database: Database, version_id: str, column: str
) -> None:
    signed(database, version_id)
    with without_triggers(database) as connection:
        new_mesh = {"sha256": "cd" * 32, "size": 1, "kind": "mesh", "created_at": "2026"}
        connection.execute(insert(schema.contents).values(new_mesh))
        change = update(schema.prescription_versions).values({column: CHANGES[column]})
        connection.execute(change)
    assert report_of(database).changed == (version_id,)


def test_a_signature_that_was_made_anew_is_not_in_the_audit_log(
    database: Database, version_id: str
) -> None:
    signed(database, version_id)
    with without_triggers(database) as connection:
        versions = schema.prescription_versions
        row = connection.execute(select(versions)).one()._asdict()
        row["document"] = "forged"
        connection.execute(update(versions).values(document="forged", signature=digest_of(row)))
    assert report_of(database) == SignatureReport(checked=1, unlogged=(version_id,))


def test_a_signed_version_that_is_gone_is_missed(database: Database, version_id: str) -> None:
    signed(database, version_id)
    with without_triggers(database) as connection:
        connection.execute(delete(schema.prescription_versions))
    assert report_of(database) == SignatureReport(checked=0, missing=(version_id,))
    with database.writing() as connection:
        AuditLog.append(connection, ANNA, "erased", "prescription", version_id)
    assert report_of(database) == SignatureReport(checked=0)


def test_everything_a_version_states_is_signed() -> None:
    unsigned = {"changed_at", "revision", "is_closed", "signature"}
    assert set(SIGNED_COLUMNS) == set(schema.prescription_versions.c.keys()) - unsigned
