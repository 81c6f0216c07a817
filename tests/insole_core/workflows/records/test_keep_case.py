"""What changes in the case of a visit is stored part by part, and nothing is lost midway."""

from __future__ import annotations

from dataclasses import replace
from datetime import date
from typing import Any

import numpy as np
import pytest

from insole_core.cases.case_record import CaseRecord, FootRecord, Patient
from insole_core.cases.order_note import OrderNote
from insole_core.cases.scan_source import ScanSource
from insole_core.errors import Unreachable
from insole_core.export.shop_order import OrderTerms
from insole_core.foot.foot import Foot
from insole_core.geometry.side import Side
from insole_core.records.person import Person, new_id
from insole_core.records.prescription import Base
from insole_core.records.records import Records
from insole_core.records.visit import CaptureState, Visit
from insole_core.workflows.records.keep_case import CaseChange, add_case, keep_case, visit_measures
from insole_core.workflows.records.thumbnails import thumbnails


@pytest.fixture
def visit(records: Records) -> Visit:
    person = records.persons.add(Person("Anna Berg", date(1970, 2, 28)))
    wanted = Visit(person.id, date.today(), capture_state=CaptureState.WANTED)
    return records.visits.add(wanted)


@pytest.fixture
def case(records: Records, visit: Visit, left_foot: Foot, right_foot: Foot) -> CaseRecord:
    """The visit's case, with two feet that are not stored yet."""
    record = records.visits.open_case(visit.id).record
    for foot in (right_foot, left_foot):
        source = ScanSource("mesh", f"{foot.side}.stl", "a" * 64)
        record = record.with_foot(FootRecord.begun(foot, source))
    return record


def change_of(visit: Visit, case: CaseRecord, before: Patient | None = None) -> CaseChange:
    return CaseChange(visit.id, before or case.patient, case, dict.fromkeys(Side))


def thicker(foot: FootRecord, thickness_mm: float) -> FootRecord:
    return foot.with_design(replace(foot.design, thickness_mm=thickness_mm))


def test_both_feet_fields_and_measures_are_stored(
    records: Records, visit: Visit, case: CaseRecord
) -> None:
    patient = replace(case.patient, name="Anna Dal", born="1971-03-01", notes="Flat foot")
    kept = keep_case(records, change_of(visit, replace(case, patient=patient), case.patient))
    assert kept.trouble is None
    assert set(kept.bases) == set(Side)
    opened = records.visits.open_case(visit.id)
    assert (opened.person.name, opened.person.birth_date) == ("Anna Dal", date(1971, 3, 1))
    assert (opened.visit.findings, opened.visit.capture_state) == ("Flat foot", CaptureState.DONE)
    measures = visit_measures(case.feet)
    assert opened.visit.measures == pytest.approx(measures)
    assert {"left_foot_length_mm", "right_foot_length_mm"} <= set(measures)
    assert opened.record.patient == patient


def test_a_connection_lost_midway_loses_nothing_that_was_stored(
    records: Records, visit: Visit, case: CaseRecord, monkeypatch: pytest.MonkeyPatch
) -> None:
    save = records.prescriptions.save

    def save_left(visit_id: str, foot: FootRecord, *given: Any) -> Base:
        if foot.side is Side.RIGHT:
            raise Unreachable("The database does not answer.")
        return save(visit_id, foot, *given)

    monkeypatch.setattr(records.prescriptions, "save", save_left)
    kept = keep_case(records, change_of(visit, case))
    assert isinstance(kept.trouble, Unreachable)
    assert set(kept.bases) == {Side.LEFT}
    monkeypatch.undo()
    bases = {side: kept.bases.get(side) for side in Side}
    again = keep_case(records, CaseChange(visit.id, case.patient, case, bases))
    assert again.trouble is None
    assert not again.conflicts
    assert [len(records.prescriptions.versions(visit.id, side)) for side in Side] == [1, 1]


def test_a_lost_acknowledgement_is_no_conflict_and_somebody_elses_change_is(
    records: Records, visit: Visit, case: CaseRecord
) -> None:
    keep_case(records, change_of(visit, case))
    again = keep_case(records, change_of(visit, case))
    assert not again.conflicts
    assert set(again.bases) == set(Side)
    left = case.of_side(Side.LEFT)
    assert left is not None
    changed = case.with_foot(thicker(left, 5.0))
    kept = keep_case(records, change_of(visit, changed))
    assert set(kept.conflicts) == {Side.LEFT}
    assert set(kept.bases) == {Side.RIGHT}


def test_work_goes_on_over_what_was_stored_without_an_answer(
    records: Records, visit: Visit, case: CaseRecord
) -> None:
    """Whether it began the version or continued it; a field, too."""
    editing, left = new_id(), case.of_side(Side.LEFT)
    assert left is not None
    bases: dict[Side, Base | None] = {Side.LEFT: None}
    sent: tuple[Patient, ...] = ()
    for thickness_mm in (4.0, 5.0, 6.0, 7.0):
        now = case.with_foot(thicker(left, thickness_mm))
        now = replace(now, patient=replace(now.patient, name=f"Anna {thickness_mm}"))
        change = CaseChange(visit.id, case.patient, now, bases, editing, sent)
        kept = keep_case(records, change)
        assert (kept.conflicts, kept.collided) == ({}, ())
        sent = (*sent, now.patient)
        if thickness_mm == 5.0:  # the only answer that arrives
            bases, sent = {Side.LEFT: kept.bases[Side.LEFT]}, ()
            case = replace(case, patient=now.patient)
    (version,) = records.prescriptions.versions(visit.id, Side.LEFT)
    assert records.prescriptions.read(version.id).design.thickness_mm == 7.0
    assert records.persons.get(visit.person_id).name == "Anna 7.0"


def test_what_somebody_else_made_of_work_without_an_answer_is_a_conflict(
    records: Records, visit: Visit, case: CaseRecord
) -> None:
    left = case.of_side(Side.LEFT)
    assert left is not None
    mine = CaseChange(visit.id, case.patient, case, {Side.LEFT: None}, new_id())
    keep_case(records, mine)
    theirs = records.visits.open_case(visit.id)
    records.prescriptions.save(visit.id, thicker(left, 6.0), theirs.bases[Side.LEFT])
    kept = keep_case(records, replace(mine, now=case.with_foot(thicker(left, 5.0))))
    assert set(kept.conflicts) == {Side.LEFT}


def change_elsewhere(records: Records, visit: Visit, name: str, findings: str) -> None:
    person, stored = records.persons.get(visit.person_id), records.visits.get(visit.id)
    records.persons.change(replace(person, name=name), person.revision)
    records.visits.change(replace(stored, findings=findings), stored.revision)


def test_fields_of_two_stations_are_put_together_and_those_of_both_are_told(
    records: Records, visit: Visit, case: CaseRecord
) -> None:
    change_elsewhere(records, visit, "Anna Lind", "Flat foot")
    mine = replace(case.patient, name="Anna Ek", born="1971-03-01")
    kept = keep_case(records, CaseChange(visit.id, case.patient, replace(case, patient=mine), {}))
    assert (kept.trouble, kept.collided) == (None, ("name",))
    stored = records.visits.open_case(visit.id).record.patient
    assert kept.theirs == stored
    assert (stored.name, stored.born, stored.notes) == ("Anna Lind", "1971-03-01", "Flat foot")


def test_the_same_change_at_two_stations_is_no_conflict(
    records: Records, visit: Visit, case: CaseRecord
) -> None:
    change_elsewhere(records, visit, "Anna Lind", "Flat foot")
    mine = replace(case.patient, name=" Anna Lind", notes="Flat foot\n")
    kept = keep_case(records, CaseChange(visit.id, case.patient, replace(case, patient=mine), {}))
    assert (kept.trouble, kept.collided) == (None, ())


@pytest.mark.parametrize(
    ("mine", "merged"),
    [
        (OrderTerms(), OrderTerms(2, "black", remarks="call")),
        (OrderTerms(colour="red"), OrderTerms(2, "red", remarks="call")),
        (OrderTerms(remarks="soft"), OrderTerms(2, "black", remarks="call\nsoft")),
    ],
)
def test_terms_of_two_stations_are_put_together(
    records: Records, visit: Visit, case: CaseRecord, mine: OrderTerms, merged: OrderTerms
) -> None:
    stored = records.visits.get(visit.id)
    theirs = OrderTerms(2, "black", remarks="call")
    records.visits.change(replace(stored, terms=theirs), stored.revision)
    now = replace(case, order=OrderNote(terms=mine))
    change = CaseChange(visit.id, case.patient, now, {}, terms_before=OrderTerms())
    for _ in range(2):  # also when its answer was lost
        assert keep_case(records, change).trouble is None
        assert records.visits.get(visit.id).terms == merged


@pytest.mark.parametrize("is_new", [True, False])
def test_a_case_of_a_file_becomes_a_visit(
    records: Records, visit: Visit, case: CaseRecord, is_new: bool
) -> None:
    patient = Patient("Anna Berg", "1970-02-28", "2026-01-15", "From a file")
    person_id = "" if is_new else visit.person_id
    added = add_case(records, replace(case, patient=patient), person_id)
    assert (added.person_id == visit.person_id) is not is_new
    assert (added.visited_on, added.findings) == (date(2026, 1, 15), "From a file")
    opened = records.visits.open_case(added.id)
    assert [foot.side for foot in opened.record.feet] == list(Side)


def test_pictures_show_the_foot_from_below_and_the_insole_from_above(case: CaseRecord) -> None:
    left = case.of_side(Side.LEFT)
    assert left is not None
    small = thumbnails(left)
    for picture in (small.foot, small.insole):
        assert picture.dtype == np.uint8
        height, width, channels = picture.shape
        assert channels == 4
        assert height > 1.5 * width
        assert 0.4 < (picture[..., 3] == 255).mean() < 1.0
