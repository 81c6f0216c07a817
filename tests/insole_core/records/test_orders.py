"""Orders, captures, follow-ups and visits are kept, found and told."""

from __future__ import annotations

import zipfile
from dataclasses import replace
from datetime import date, timedelta
from pathlib import Path

import pytest
from sqlalchemy import insert

from insole_core.cases.case_record import FootRecord
from insole_core.cases.order_note import OrderNote
from insole_core.cases.scan_source import ScanSource
from insole_core.errors import Conflict, InputError, RecordsError
from insole_core.export.shop_order import OrderTerms
from insole_core.geometry.side import Side
from insole_core.given_file import sha256_of
from insole_core.recording.hand_edits import HandEdits
from insole_core.recording.hand_edits_file import write_edits
from insole_core.recording.reader import read_session
from insole_core.records import schema
from insole_core.records.capture import CaptureFacts
from insole_core.records.captures import MESH, SESSION
from insole_core.records.order import Order, OrderSearch, OrderState
from insole_core.records.person import Person
from insole_core.records.records import Records
from insole_core.records.visit import CaptureState, FollowUp, Visit
from insole_core.workflows.starting_design import on_earlier_scan, starting_device

SMALL = Path(__file__).parents[2] / "data" / "sessions" / "left_small.zip"
TODAY = date.today()
TOMORROW = TODAY + timedelta(days=1)


@pytest.fixture
def person(records: Records) -> Person:
    return records.persons.add(Person("Anna Berg"))


@pytest.fixture
def visit(records: Records, person: Person) -> Visit:
    return records.visits.add(Visit(person.id, TODAY))


@pytest.fixture
def order(records: Records, visit: Visit, foot_record: FootRecord, tmp_path: Path) -> Order:
    base = records.prescriptions.save(visit.id, foot_record, None)
    stl = tmp_path / "left.stl"
    stl.write_bytes(b"solid")
    return records.orders.add(
        visit.id, [base.version_id], shop="CNC", due_on=TOMORROW, remarks="blue", files=[stl]
    )


@pytest.mark.parametrize("is_copy", [False, True])
def test_a_session_that_is_taken_as_the_other_foot_comes_back_as_that(
    records: Records, visit: Visit, foot_record: FootRecord, tmp_path: Path, is_copy: bool
) -> None:
    """Where it was recorded, and where a copy from the record was corrected."""
    session = tmp_path / "session"
    with zipfile.ZipFile(SMALL) as archive:
        archive.extractall(session)
    mistaken = records.captures.add(visit.id, SESSION, session)
    path = records.captures.copy_to(mistaken, tmp_path) if is_copy else session
    write_edits(HandEdits(side=Side.RIGHT), path)
    taken = records.captures.add(visit.id, SESSION, path)
    assert records.captures.of_visit(visit.id) == [taken]
    assert records.captures.add(visit.id, SESSION, path) == taken
    back = tmp_path / "back"
    back.mkdir()
    session_back = read_session(records.captures.copy_to(taken, back))
    assert session_back.manifest.side is Side.RIGHT
    assert len(session_back.views) == len(read_session(SMALL).views)
    digest = sha256_of(path if is_copy else path / "manifest.json")
    made = replace(foot_record, source=ScanSource("session", "x", digest))
    records.prescriptions.save(visit.id, made, None)
    [version] = records.prescriptions.versions(visit.id, Side.LEFT)
    assert version.capture_id == taken.id


def test_the_same_capture_is_stored_once(records: Records, visit: Visit, tmp_path: Path) -> None:
    scan = tmp_path / "left.stl"
    scan.write_bytes(b"solid")
    first = records.captures.add(visit.id, MESH, scan)
    scan.rename(tmp_path / "again.stl")
    assert records.captures.add(visit.id, MESH, tmp_path / "again.stl") == first
    assert records.captures.of_visit(visit.id) == [first]
    other = records.visits.add(Visit(visit.person_id, TOMORROW))
    assert records.captures.add(other.id, MESH, tmp_path / "again.stl").visit_id == other.id


def test_an_order_closes_what_it_orders(
    records: Records, visit: Visit, order: Order, foot_record: FootRecord
) -> None:
    [version] = records.prescriptions.versions(visit.id, Side.LEFT)
    assert version.is_closed
    assert order.version_ids == (version.id,)
    assert records.contents.read(order.files[0].content_sha256) == b"solid"
    assert (order.files[0].name, order.files[0].size) == ("left.stl", 5)
    assert records.orders.get(order.id) == order
    base = records.visits.open_case(visit.id).bases[Side.LEFT]
    thicker = foot_record.with_design(replace(foot_record.design, thickness_mm=5))
    records.prescriptions.save(visit.id, thicker, base)
    assert len(records.prescriptions.versions(visit.id, Side.LEFT)) == 2


def test_an_order_goes_through_its_states(records: Records, order: Order) -> None:
    for state in (OrderState.SENT, OrderState.RETURNED, OrderState.DELIVERED):
        order = records.orders.move(order.id, state, f"now {state}", order.revision)
    assert [(e.from_state, e.to_state, e.remarks) for e in order.events] == [
        (None, "designed", ""),
        ("designed", "sent", "now sent"),
        ("sent", "returned", "now returned"),
        ("returned", "delivered", "now delivered"),
    ]
    assert records.orders.open() == []
    assert [o.number for o in records.orders.open(OrderState.DELIVERED)] == [order.number]


def test_what_is_exported_again_is_a_revision_and_the_first_one_stays(
    records: Records, visit: Visit, order: Order, foot_record: FootRecord, tmp_path: Path
) -> None:
    sent = records.orders.move(order.id, OrderState.SENT, "", order.revision)
    base = records.visits.open_case(visit.id).bases[Side.LEFT]
    thicker = foot_record.with_design(replace(foot_record.design, thickness_mm=5))
    base = records.prescriptions.save(visit.id, thicker, base)
    stl = tmp_path / "left.stl"
    stl.write_bytes(b"thicker")
    place = str(tmp_path)
    revised = records.orders.revise(
        order.id,
        [base.version_id],
        sent.revision,
        release=2,
        due_on=TOMORROW,
        files=[stl],
        place=place,
    )
    assert (revised.number, revised.release, revised.place) == (order.number, 2, place)
    assert revised.state is OrderState.DESIGNED
    assert revised.version_ids == (base.version_id,)
    read = {f.release: records.contents.read(f.content_sha256) for f in revised.files}
    assert read == {1: b"solid", 2: b"thicker"}
    assert [f.release for f in revised.newest_files] == [2]
    assert [(e.to_state, e.release) for e in revised.events] == [
        ("designed", 1), ("sent", 1), ("designed", 2),
    ]  # fmt: skip
    assert revised.revision == sent.revision + 1
    with pytest.raises(InputError, match="has a revision 2 already"):
        records.orders.revise(order.id, [base.version_id], revised.revision, release=2)
    (copy,) = records.orders.copy_files(order.id, tmp_path)
    assert copy.read_bytes() == b"thicker"


@pytest.mark.parametrize("final", [OrderState.CANCELLED, OrderState.DELIVERED])
def test_an_order_that_was_closed_meanwhile_is_not_revised(
    records: Records, order: Order, final: OrderState
) -> None:
    closed = records.orders.move(order.id, final, "", order.revision)
    with pytest.raises(InputError, match=f"was {final} meanwhile; export once more"):
        records.orders.revise(order.id, order.version_ids, closed.revision, release=2)
    assert records.orders.get(order.id) == closed


def test_the_next_export_revises_what_is_not_delivered_or_cancelled(
    records: Records, visit: Visit, order: Order
) -> None:
    terms = OrderTerms(2, "black", "", "soft heel", TOMORROW)
    records.visits.change(replace(visit, terms=terms), visit.revision)
    noted = records.visits.open_case(visit.id).record.order
    assert noted == OrderNote(order.number, 1, terms) == records.orders.note_of(visit.id)
    for state in (OrderState.DELIVERED, OrderState.CANCELLED):
        order = records.orders.move(order.id, state, "", order.revision)
        assert records.orders.note_of(visit.id) == OrderNote(terms=terms)
    records.orders.move(order.id, OrderState.RETURNED, "", order.revision)
    assert records.orders.note_of(visit.id).number == order.number


def test_orders_are_searched_sorted_and_counted(
    records: Records, visit: Visit, order: Order
) -> None:
    eva = records.persons.add(Person("Eva Öberg"))
    with records.context.database.writing() as connection:
        connection.execute(insert(schema.orders), [
            {"id": f"o{n}", "number": f"26-X{n:03}", "visit_id": visit.id, "person_id": eva.id,
             "state": state, "shop": "Söder" if n % 2 else "", "created_at": f"2026-11-{n:02}T",
             "changed_at": "2026", "revision": 1}
            for n, state in enumerate(["delivered", "cancelled", "sent"] * 4, 1)
        ])  # fmt: skip

    def numbers(search: OrderSearch, limit: int | None = None) -> list[str]:
        return [found.number for found in records.orders.find(search, limit)]

    assert records.orders.count(OrderSearch()) == 13
    assert len(numbers(OrderSearch((OrderState.CANCELLED,)))) == 4
    assert numbers(OrderSearch(typed="oberg x007")) == ["26-X007"]
    assert numbers(OrderSearch(typed="anna cnc")) == [order.number]
    assert numbers(OrderSearch(typed="percent%")) == []
    by_shop = OrderSearch(sorted_by="shop", is_descending=True)
    assert [s.shop for s in records.orders.find(by_shop, 8)] == ["Söder"] * 6 + ["CNC", ""]
    assert numbers(OrderSearch(sorted_by="person_name"), 2) == [order.number, "26-X001"]
    latest = OrderSearch(sorted_by="ordered_on", is_descending=True)
    assert numbers(latest, 2) == [order.number, "26-X012"]
    by_state = records.orders.find(OrderSearch(sorted_by="state"))
    assert [s.state for s in by_state][::4] == ["designed", "sent", "delivered", "cancelled"]


def test_open_orders_come_by_their_due_date(records: Records, visit: Visit, order: Order) -> None:
    late = records.orders.add(visit.id, order.version_ids, due_on=TODAY - timedelta(days=3))
    some_day = records.orders.add(visit.id, order.version_ids)
    listed = records.orders.open()
    assert [o.number for o in listed] == [late.number, order.number, some_day.number]
    assert [o.is_overdue(TODAY) for o in listed] == [True, False, False]
    assert listed[0].person_name == "Anna Berg"
    assert [o.id for o in records.orders.of_person(order.person_id)] == [o.id for o in listed]


def test_a_person_is_found_by_the_number_of_an_order(records: Records, order: Order) -> None:
    found = records.persons.search(order.number.lower())
    assert [person.id for person in found] == [order.person_id]


def test_who_moves_an_order_second_is_told(records: Records, order: Order) -> None:
    records.orders.move(order.id, OrderState.SENT, "", order.revision)
    with pytest.raises(Conflict, match=order.number) as caught:
        records.orders.move(order.id, OrderState.CHECKED, "", order.revision)
    assert caught.value.theirs.state is OrderState.SENT
    with pytest.raises(InputError, match="is sent already"):
        records.orders.move(order.id, OrderState.SENT, "", order.revision + 1)


def test_an_order_is_changed(records: Records, order: Order) -> None:
    order = records.orders.change(
        order.id, {"shop": "Other", "due_on": None, "remarks": "red"}, order.revision
    )
    assert (order.shop, order.due_on, order.remarks) == ("Other", None, "red")


@pytest.mark.parametrize("count", [0, 2])
def test_an_order_is_of_one_version_for_a_foot(
    records: Records, visit: Visit, order: Order, foot_record: FootRecord, count: int
) -> None:
    base = records.visits.open_case(visit.id).bases[Side.LEFT]
    thicker = foot_record.with_design(replace(foot_record.design, thickness_mm=5))
    records.prescriptions.save(visit.id, thicker, base)
    versions = [v.id for v in records.prescriptions.versions(visit.id, Side.LEFT)]
    with pytest.raises(InputError, match="one version of one or both feet"):
        records.orders.add(visit.id, versions[:count])


def test_a_number_is_of_one_order(records: Records, visit: Visit, order: Order) -> None:
    with pytest.raises(InputError, match=order.number):
        records.orders.add(visit.id, order.version_ids, number=order.number)


def test_the_work_list_holds_what_the_capture_room_has_to_do(
    records: Records, person: Person, visit: Visit, tmp_path: Path
) -> None:
    records.visits.change(replace(visit, capture_state=CaptureState.WANTED), visit.revision)
    records.visits.add(Visit(person.id, TODAY))
    assert [(v.id, v.person_name) for v in records.visits.work_list()] == [(visit.id, "Anna Berg")]
    scan = tmp_path / "scan.ply"
    scan.write_bytes(b"ply")
    records.captures.add(visit.id, MESH, scan)
    assert records.visits.work_list() == []
    assert records.visits.get(visit.id).capture_state is CaptureState.DONE
    assert len(records.visits.on(TODAY)) == 2
    assert records.visits.on(TOMORROW) == []


def test_a_capture_is_kept_with_its_facts(
    records: Records, visit: Visit, foot_record: FootRecord, tmp_path: Path
) -> None:
    session = tmp_path / "session"
    (session / "views" / "left").mkdir(parents=True)
    (session / "manifest.json").write_text("{}")
    (session / "views" / "left" / "sensor.json").write_text("{}")
    facts = CaptureFacts(
        "2026-11-20T10:00:00Z", ("A1", "B2"), "2026-10-01", {"A1": 0.4}, {"views": 2}
    )
    capture = records.captures.add(visit.id, SESSION, session, facts)
    assert records.captures.of_visit(visit.id) == [capture]
    assert records.captures.get(capture.id).facts == facts
    assert capture.source_sha256 == sha256_of(session / "manifest.json")
    copy = records.captures.copy_to(capture, tmp_path)
    assert copy.suffix == ".zip"
    assert sha256_of(copy) == capture.content_sha256
    made = replace(foot_record, source=ScanSource("session", "x", capture.source_sha256))
    records.prescriptions.save(visit.id, made, None)
    [version] = records.prescriptions.versions(visit.id, Side.LEFT)
    assert version.capture_id == capture.id
    later = records.visits.add(Visit(visit.person_id, TOMORROW))
    [scanned] = records.prescriptions.last_scanned(visit.person_id)
    assert (scanned.side, scanned.scanned_on) == (Side.LEFT, TODAY)
    earlier = records.prescriptions.read(scanned.version_id)
    again = on_earlier_scan(earlier, scanned.scanned_on, starting_device(tmp_path))
    base = records.prescriptions.save(later.id, again, None)
    [version] = records.prescriptions.versions(later.id, Side.LEFT)
    assert version.capture_id == capture.id
    assert records.prescriptions.read(base.version_id).foot.scanned_on == TODAY.isoformat()
    [scanned] = records.prescriptions.last_scanned(visit.person_id)
    assert (scanned.version_id, scanned.scanned_on) == (base.version_id, TODAY)


def test_a_mirror_image_is_the_last_scan_only_of_a_foot_that_was_never_scanned(
    records: Records, visit: Visit, foot_record: FootRecord, right_record: FootRecord
) -> None:
    later = records.visits.add(Visit(visit.person_id, TOMORROW))
    mirrored = replace(right_record.source, mirrored=True)
    image = replace(foot_record, foot=replace(foot_record.foot, mirrored=True), source=mirrored)
    of_image = records.prescriptions.save(later.id, image, None)
    [scanned] = records.prescriptions.last_scanned(visit.person_id)
    assert (scanned.version_id, scanned.scanned_on) == (of_image.version_id, TOMORROW)
    of_scan = records.prescriptions.save(visit.id, foot_record, None)
    [scanned] = records.prescriptions.last_scanned(visit.person_id)
    assert (scanned.version_id, scanned.scanned_on) == (of_scan.version_id, TODAY)


def test_the_name_of_a_patient_is_no_part_of_a_path(
    records: Records, visit: Visit, tmp_path: Path
) -> None:
    scan = tmp_path / "Anna ..Berg.STL"
    scan.write_bytes(b"solid")
    capture = records.captures.add(visit.id, MESH, scan)
    copy = records.captures.copy_to(capture, tmp_path)
    assert "anna" not in copy.name.lower()
    assert copy.suffix == ".stl"
    assert not [p for p in records.contents.folder.rglob("*") if "Anna" in p.name]


def test_a_capture_that_cannot_be_read_leaves_nothing(
    records: Records, visit: Visit, tmp_path: Path
) -> None:
    with pytest.raises(InputError, match="cannot be read"):
        records.captures.add(visit.id, MESH, tmp_path / "missing.stl")
    assert records.captures.of_visit(visit.id) == []


def test_visits_come_newest_first(records: Records, person: Person) -> None:
    days = [TODAY - timedelta(days=n) for n in (2, 0, 1)]
    for day in days:
        records.visits.add(Visit(person.id, day, measures={"left_length_mm": 251.5}))
    listed = records.visits.of_person(person.id)
    assert [v.visited_on for v in listed] == sorted(days, reverse=True)
    assert listed[0].measures == {"left_length_mm": 251.5}


@pytest.mark.parametrize(
    "wrong",
    [
        {"weight_kg": 1000.0},
        {"weight_kg": float("nan")},
        {"shoe_size_eu": 3.0},
        {"visited_on": date(2200, 1, 1)},
        {"reason": "x" * 30_000},
    ],
)
def test_a_visit_that_cannot_be_right_is_refused(
    records: Records, visit: Visit, wrong: dict[str, float]
) -> None:
    with pytest.raises(InputError):
        records.visits.change(replace(visit, **wrong), visit.revision)
    assert records.visits.get(visit.id) == visit


def test_who_changes_a_visit_second_sees_both(records: Records, visit: Visit) -> None:
    records.visits.change(replace(visit, findings="flat"), visit.revision)
    with pytest.raises(Conflict) as caught:
        records.visits.change(replace(visit, findings="high"), visit.revision)
    assert (caught.value.mine.findings, caught.value.theirs.findings) == ("high", "flat")


def test_follow_ups_come_newest_first(records: Records, person: Person, order: Order) -> None:
    for days, outcome in ((9, "worse"), (2, "better")):
        records.follow_ups.add(
            FollowUp(person.id, TODAY - timedelta(days=days), outcome, order_id=order.id)
        )
    listed = records.follow_ups.of_person(person.id)
    assert [(f.outcome, f.author) for f in listed] == [("better", "anna"), ("worse", "anna")]
    with pytest.raises(InputError, match="outcome"):
        records.follow_ups.add(FollowUp(person.id, TODAY, ""))


def test_what_is_gone_is_told(records: Records, foot_record: FootRecord) -> None:
    for ask in (
        lambda: records.visits.get("x"),
        lambda: records.visits.open_case("x"),
        lambda: records.orders.get("x"),
        lambda: records.orders.move("x", OrderState.SENT, "", 1),
        lambda: records.captures.get("x"),
        lambda: records.prescriptions.read("x"),
        lambda: records.prescriptions.save("x", foot_record, None),
    ):
        with pytest.raises(RecordsError, match="no longer in the record"):
            ask()


def test_settings_of_the_clinic_are_kept(records: Records) -> None:
    assert records.clinic.get("retention_years", 10) == 10
    records.clinic.set("retention_years", 15)
    records.clinic.set("retention_years", 20)
    assert records.clinic.get("retention_years") == 20
