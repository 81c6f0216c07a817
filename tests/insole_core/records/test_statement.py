"""Years later the record states what Annex XIII asks for, or says why it cannot."""

from __future__ import annotations

import json
from dataclasses import replace
from datetime import date
from pathlib import Path

import pytest
from read_pdf import text_of_pdf
from sqlalchemy import text
from stations import proven
from tampering import without_triggers

from insole_core.cases.case_record import FootRecord
from insole_core.errors import InputError, RecordsError
from insole_core.geometry.side import Side
from insole_core.records.accounts import Accounts
from insole_core.records.author import Role
from insole_core.records.capture import CaptureFacts
from insole_core.records.captures import MESH
from insole_core.records.order import Order, OrderState
from insole_core.records.person import Person
from insole_core.records.records import Records
from insole_core.records.retention import ErasureReason, erase_person
from insole_core.records.signing import sign
from insole_core.records.statement import DeviceStatement, statement_of, write_statement_paper
from insole_core.records.visit import Visit
from insole_core.solids.prescription_paper import Responsible

TODAY = date(2026, 11, 22)
MAKER = Responsible(maker="Fotkliniken", maker_address="Storgatan 1, Åre")
SCAN = b"solid left foot"


@pytest.fixture
def order(
    records: Records, foot_record: FootRecord, right_record: FootRecord, tmp_path: Path
) -> Order:
    """An order of two feet, the left one from a scan that the record has."""
    person = records.persons.add(Person("Anna Berg", date(1970, 2, 28), pseudonym="P-TEST"))
    visit = records.visits.add(Visit(person.id, TODAY))
    scan = tmp_path / "left.stl"
    scan.write_bytes(SCAN)
    residuals = {"A00362A: camera, px": 0.312, "A00362A: disparity, mm": 1.25}
    facts = CaptureFacts("2026-11-20T10:00:00Z", ("A00362A",), "2026-10-01", residuals)
    capture = records.captures.add(visit.id, MESH, scan, facts)
    left = replace(foot_record, source=replace(foot_record.source, sha256=capture.source_sha256))
    ids = [records.prescriptions.save(visit.id, foot, None).version_id
           for foot in (left, right_record)]  # fmt: skip
    return records.orders.add(visit.id, ids, number="26-7KQ4M")


def sign_all(records: Records, order: Order) -> None:
    with records.context.database.writing() as connection:
        for version_id in order.version_ids:
            sign(connection, version_id, records.who)


def stated(records: Records, order: Order) -> DeviceStatement:
    return statement_of(records.context, order.id, MAKER)


def test_a_statement_says_who_what_from_which_scan_and_by_which_program(
    records: Records, order: Order
) -> None:
    sign_all(records, order)
    records.orders.move(order.id, OrderState.DELIVERED, "", order.revision)
    statement = stated(records, order)
    assert statement.identification == {
        "name": "Anna Berg", "born": "1970-02-28", "pseudonym": "26-7KQ4M", "visit": "2026-11-22",
    }  # fmt: skip
    assert statement.responsible.prescriber == "anna"
    assert [state for _, state in statement.history] == ["designed", "delivered"]
    left, right = statement.feet
    assert (left.side, right.side) == (Side.LEFT, Side.RIGHT)
    assert (left.scan, left.capture.sensor_serials) == ("left.stl", ("A00362A",))
    assert records.contents.read(left.scan_sha256) == SCAN
    known = left.provenance()
    assert known["calibrated"] == "2026-10-01"
    assert known["recorded"] == "2026-11-20"
    residuals = "A00362A: camera 0.31 px; A00362A: disparity 1.25 mm"
    assert known["residuals of the calibration"] == residuals
    old = replace(left, capture=CaptureFacts(sensor_serials=("A00362A",))).provenance()
    assert old["calibrated"] == old["residuals of the calibration"] == "not recorded"
    assert known["signature"] == left.signature
    assert known["Insole Studio"]
    assert "scan" not in right.provenance()  # nothing is invented
    assert json.loads(json.dumps(statement.as_json()))["feet"][1]["side"] == "right"


def test_the_paper_holds_it(records: Records, order: Order, tmp_path: Path) -> None:
    sign_all(records, order)
    path = tmp_path / "statement.pdf"
    write_statement_paper(stated(records, order), path, TODAY)
    printed = " ".join(text_of_pdf(path).split())  # wherever its lines are broken
    for words in ("Anna Berg", "26-7KQ4M", "A00362A", "2026-10-01", "left.stl", "Annex XIII"):
        assert words in printed


def test_a_scan_of_the_other_foot_is_said_to_be_one(
    records: Records, order: Order, foot_record: FootRecord, tmp_path: Path
) -> None:
    [scan] = records.captures.of_visit(order.visit_id)
    source = replace(foot_record.source, sha256=scan.source_sha256, mirrored=True)
    image = replace(foot_record, source=source)
    later = records.visits.add(Visit(order.person_id, TODAY))
    version = records.prescriptions.save(later.id, image, None)
    again = records.orders.add(later.id, [version.version_id], number="26-8KQ4M")
    sign_all(records, again)
    statement = stated(records, again)
    assert statement.feet[0].provenance()["made from"] == "mirror image of the right foot"
    write_statement_paper(statement, tmp_path / "statement.pdf", TODAY)
    printed = " ".join(text_of_pdf(tmp_path / "statement.pdf").split())
    assert "mirror image of the right foot" in printed
    sign_all(records, order)
    assert all("made from" not in foot.provenance() for foot in stated(records, order).feet)


def test_a_prescription_that_is_not_signed_is_told(records: Records, order: Order) -> None:
    with pytest.raises(RecordsError, match="left foot is not signed"):
        stated(records, order)


def test_a_prescription_that_was_changed_since_is_told(records: Records, order: Order) -> None:
    sign_all(records, order)
    with without_triggers(records.context.database) as connection:
        connection.execute(
            text("UPDATE prescription_versions SET reason = 'x' WHERE side = 'right'")
        )
    with pytest.raises(RecordsError, match="right foot is not what was signed"):
        stated(records, order)


def test_what_the_annex_asks_for_is_asked_for(records: Records, order: Order) -> None:
    sign_all(records, order)
    with pytest.raises(InputError, match="the maker, the maker's address"):
        statement_of(records.context, order.id, Responsible())
    with pytest.raises(RecordsError, match="no longer in the record"):
        statement_of(records.context, "nothing", MAKER)


def test_the_full_name_of_who_signed_is_printed(records: Records, order: Order) -> None:
    accounts = Accounts(records.context.database, records.who)
    accounts.switch_on("chef", "Carla Chef", "vier Schuhe gehen")
    chef = Accounts(records.context.database, proven("chef", Role.ADMINISTRATOR))
    chef.add("anna", "Anna Åkesson", Role.ORTHOPEDIST, "vier Schuhe gehen")
    anna = records.for_author(proven("anna"))
    sign_all(anna, order)
    assert stated(anna, order).responsible.prescriber == "Anna Åkesson"


def test_an_erased_patient_stays_documented_under_the_pseudonym(
    records: Records, order: Order
) -> None:
    sign_all(records, order)
    erase_person(records.context, order.person_id, ErasureReason.REQUEST, TODAY)
    statement = stated(records, order)
    assert statement.identification == {"pseudonym": "P-TEST, 26-7KQ4M", "visit": "2026-11-22"}
    assert "Berg" not in str(statement)
