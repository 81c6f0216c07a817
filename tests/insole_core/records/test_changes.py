"""Stations see what others do, and who has what open."""

from __future__ import annotations

from dataclasses import replace
from datetime import date, datetime, timedelta, tzinfo

import pytest
from stations import ANNA, BEN, Stations

from insole_core.cases.case_record import FootRecord
from insole_core.geometry.side import Side
from insole_core.records import author
from insole_core.records import stations as presence_module
from insole_core.records.person import Person
from insole_core.records.place import RecordsPlace
from insole_core.records.records import Records
from insole_core.records.visit import Visit


def added_visit(records: Records) -> Visit:
    person = records.persons.add(Person("Anna Berg"))
    return records.visits.add(Visit(person.id, date.today()))


def test_changes_are_told_in_their_order(stations: Stations) -> None:
    desk, room = stations.open(ANNA), stations.open(BEN)
    mark = desk.mark()
    visit = added_visit(room)
    desk.persons.open(visit.person_id)
    found = desk.changes_since(mark)
    assert [(c.action, c.subject_kind, c.is_mine) for c in found.changes] == [
        ("added", "person", False),
        ("added", "visit", False),
    ]
    assert found.changes[1].subject_id == visit.id
    assert not found.has_more
    assert desk.changes_since(found.mark).changes == ()


def test_many_changes_are_told_in_part(stations: Stations, monkeypatch: pytest.MonkeyPatch) -> None:
    records = stations.open()
    monkeypatch.setattr("insole_core.records.stations._MOST", 3)
    for number in range(4):
        records.persons.add(Person(f"Anna {number}"))
    found = records.changes_since(0)
    assert found.has_more
    assert len(found.changes) == 3
    assert found.mark == records.mark()


def test_who_has_a_visit_open_is_seen(stations: Stations) -> None:
    desk, room = stations.open(ANNA), stations.open(BEN)
    visit = added_visit(desk)
    assert desk.presence.enter(visit.id) == []
    [other] = room.presence.enter(visit.id)
    assert (other.author, other.station) == ("anna", "desk")
    assert [p.author for p in desk.presence.enter(visit.id)] == ["ben"]
    room.presence.leave(visit.id)
    assert desk.presence.others(visit.id) == []


def test_a_station_that_was_switched_off_is_forgotten(
    stations: Stations, monkeypatch: pytest.MonkeyPatch
) -> None:
    desk, room = stations.open(ANNA), stations.open(BEN)
    visit = added_visit(desk)
    room.presence.enter(visit.id)
    assert len(desk.presence.enter(visit.id)) == 1
    monkeypatch.setattr(presence_module, "STALE_S", -1.0)  # also those of this moment
    assert desk.presence.others(visit.id) == []
    monkeypatch.undo()
    [other] = room.presence.enter(visit.id)
    assert other.author == "anna"


class Clock:
    """The clock of a computer, which can be put forward and back."""

    def __init__(self) -> None:
        self.ahead = timedelta()

    def now(self, zone: tzinfo) -> datetime:
        return datetime.now(zone) + self.ahead


@pytest.fixture
def clock(monkeypatch: pytest.MonkeyPatch) -> Clock:
    clock = Clock()
    monkeypatch.setattr(author, "datetime", clock)
    return clock


def test_a_clock_that_jumps_changes_no_order(
    stations: Stations, foot_record: FootRecord, clock: Clock
) -> None:
    desk = stations.open(ANNA)
    mark, visit, base = desk.mark(), added_visit(desk), None
    for ahead, thickness_mm in ((0, 3.0), (365, 4.0), (-1, 5.0)):
        clock.ahead = timedelta(days=ahead)
        foot = foot_record.with_design(replace(foot_record.design, thickness_mm=thickness_mm))
        base = desk.prescriptions.save(visit.id, foot, base, reason=f"clock {ahead}")
        desk.persons.open(desk.persons.add(Person(f"Clock {ahead}")).id)
    versions = desk.prescriptions.versions(visit.id, Side.LEFT)
    assert [version.number for version in versions] == [3, 2, 1]
    opened = desk.visits.open_case(visit.id).record.of_side(Side.LEFT)
    assert opened is not None
    assert opened.design.thickness_mm == 5.0
    names = [person.name for person in desk.persons.recent()]
    assert names == ["Anna Berg", "Clock -1", "Clock 365", "Clock 0"]
    seqs = [change.seq for change in desk.changes_since(mark).changes]
    assert seqs == sorted(seqs)
    assert desk.audit.verify().is_intact


def test_who_was_here_before_a_clock_was_put_back_is_forgotten(
    local_place: RecordsPlace, clock: Clock
) -> None:
    stations = Stations(local_place, [])
    desk, room = stations.open(ANNA), stations.open(BEN)
    visit = added_visit(desk)
    clock.ahead = timedelta(days=365)
    room.presence.enter(visit.id)
    assert len(desk.presence.others(visit.id)) == 1
    clock.ahead = timedelta(days=-1)
    assert desk.presence.others(visit.id) == []
    room.presence.enter(visit.id)
    assert len(desk.presence.others(visit.id)) == 1
    desk.close()
    room.close()


def test_a_snapshot_sees_one_moment(stations: Stations) -> None:
    desk, room = stations.open(ANNA), stations.open(BEN)
    room.persons.add(Person("Anna"))
    with desk.snapshot():
        assert len(desk.persons.recent()) == 1
        room.persons.add(Person("Ben"))
        with desk.snapshot():
            assert len(desk.persons.recent()) == 1
        assert len(desk.persons.recent()) == 1
    assert len(desk.persons.recent()) == 2
