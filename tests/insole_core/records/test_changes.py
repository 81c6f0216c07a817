"""Stations see what others do, and who has what open."""

from __future__ import annotations

from datetime import date

import pytest
from stations import ANNA, BEN, Stations

from insole_core.records import presence as presence_module
from insole_core.records.person import Person
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
    monkeypatch.setattr("insole_core.records.changes._MOST", 3)
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
    monkeypatch.setattr(presence_module, "STALE_S", 0.0)
    assert desk.presence.others(visit.id) == []
    monkeypatch.undo()
    [other] = room.presence.enter(visit.id)
    assert other.author == "anna"


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
