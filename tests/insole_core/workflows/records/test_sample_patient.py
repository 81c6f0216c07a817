"""The sample patient: marked wherever it goes, counted nowhere, removed and brought back."""

from __future__ import annotations

import shutil
from collections.abc import Iterator
from dataclasses import replace
from datetime import date
from pathlib import Path

import pytest
from PIL import Image

from insole_core.cases.case_record import Patient
from insole_core.cases.sample import SAMPLE_PSEUDONYM
from insole_core.errors import InputError, RecordsError
from insole_core.geometry.side import Side
from insole_core.records.author import Author
from insole_core.records.captures import MESH
from insole_core.records.person import Person
from insole_core.records.place import RecordsPlace
from insole_core.records.records import Records, open_records
from insole_core.records.retention import over_retention
from insole_core.records.sample_patient import (
    has_patients,
    holds_only_sample,
    is_untouched,
    remove_sample,
)
from insole_core.records.verify import verify_record
from insole_core.records.visit import FollowUp
from insole_core.workflows.nameless import require_nameless
from insole_core.workflows.records.sample_patient import ensure_sample, renew_sample

NAME = "Anna Example (sample patient)"
MUCH_LATER = date(2090, 1, 1)


def opened_in(folder: Path) -> Records:
    return open_records(RecordsPlace.local(folder), Author("Dr. Dal", "here"))


@pytest.fixture(scope="module")
def with_sample(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder of a record that holds the sample patient."""
    folder = tmp_path_factory.mktemp("sample")
    records = opened_in(folder)
    ensure_sample(records, NAME, "Invented.", "Pain.")
    records.close()
    return folder


@pytest.fixture
def records(with_sample: Path, tmp_path: Path) -> Iterator[Records]:
    """A record of this computer with nothing but the sample patient."""
    shutil.copytree(with_sample, tmp_path / "record")
    opened = opened_in(tmp_path / "record")
    yield opened
    opened.close()


@pytest.fixture
def sample(records: Records) -> Person:
    person = records.persons.sample()
    assert person is not None
    return person


def flags(records: Records) -> tuple[bool, bool]:
    with records.context.database.reading() as connection:
        return has_patients(connection), holds_only_sample(connection)


def test_it_is_one_person_with_a_foot_to_work_on(records: Records, sample: Person) -> None:
    assert ensure_sample(records, "another", "", "") == records.persons.get(sample.id)
    (visit,) = records.visits.of_person(sample.id)
    case = records.visits.open_case(visit.id).record
    assert case.patient.is_sample
    assert case.patient.name == NAME
    assert visit.findings == "Pain."
    assert case.of_side(Side.RIGHT) is not None


def test_it_follows_the_language_until_something_was_tried_on_it(
    records: Records, sample: Person
) -> None:
    renew_sample(records, NAME, "Invented.", "Pain.")
    assert records.persons.sample() == records.persons.get(sample.id)
    renew_sample(records, "Anna Exempel", "Påhittad.", "Smärta.")
    renewed = records.persons.sample()
    assert renewed is not None
    assert (renewed.name, renewed.notes) == ("Anna Exempel", "Påhittad.")
    (visit,) = records.visits.of_person(renewed.id)
    assert visit.findings == "Smärta."
    assert [found.name for found in records.persons.recent()] == ["Anna Exempel"]
    records.visits.change(replace(visit, reason="tried"), visit.revision)
    renew_sample(records, NAME, "Invented.", "Pain.")
    kept = records.persons.sample()
    assert kept is not None
    assert kept.name == "Anna Exempel"
    assert verify_record(records.context).is_sound


@pytest.mark.parametrize("tried", ["photo", "capture", "follow-up"])
def test_it_stays_with_what_was_added_to_it(
    records: Records, sample: Person, tmp_path: Path, tried: str
) -> None:
    (visit,) = records.visits.of_person(sample.id)
    if tried == "photo":
        Image.new("RGB", (60, 40)).save(tmp_path / "sole.png")
        records.photos.add(visit.id, tmp_path / "sole.png")
    elif tried == "capture":
        (tmp_path / "foot.stl").write_bytes(b"solid foot")
        records.captures.add(visit.id, MESH, tmp_path / "foot.stl")
    else:
        records.follow_ups.add(FollowUp(sample.id, date.today(), "better"))
    renew_sample(records, "Anna Exempel", "Påhittad.", "Smärta.")
    kept = records.persons.sample()
    assert kept is not None
    assert (kept.id, kept.name) == (sample.id, NAME)


def test_its_label_cannot_be_lost(records: Records, sample: Person) -> None:
    for changed in (replace(sample, name="Eva Berg"), replace(sample, pseudonym="P-1")):
        with pytest.raises(InputError, match="keeps its name"):
            records.persons.change(changed, sample.revision)
    told = records.persons.change(replace(sample, notes="tried"), sample.revision)
    assert told.notes == "tried"
    real = records.persons.add(Person("Eva Berg"))
    for kept, merged in ((sample, real), (real, sample)):
        with pytest.raises(RecordsError, match="cannot be merged"):
            records.persons.merge(kept.id, merged.id)


def test_the_shop_may_read_that_it_is_a_sample() -> None:
    texts = {"file name": "SAMPLE-insole-right"}
    require_nameless(Patient(NAME, pseudonym=SAMPLE_PSEUDONYM), texts)
    with pytest.raises(InputError):
        require_nameless(Patient(NAME), texts)


def test_it_is_nothing_to_back_up_and_nothing_to_keep(records: Records, sample: Person) -> None:
    assert flags(records) == (False, True)
    assert over_retention(records.context, MUCH_LATER) == []
    real = records.persons.add(Person("Eva Berg"))
    assert flags(records) == (True, False)
    assert over_retention(records.context, MUCH_LATER) == [real.id]


def test_it_goes_with_all_of_it_and_comes_back(records: Records, sample: Person) -> None:
    remove_sample(records.context)
    assert records.persons.recent() == []
    assert records.visits.of_person(sample.id) == []
    assert records.persons.get(sample.id).name != NAME
    assert flags(records)[0] is False
    assert not is_untouched(records.context)  # so that it does not come back by itself
    assert verify_record(records.context).is_sound
    again = ensure_sample(records, NAME, "", "")
    assert again.id != sample.id
    assert again.pseudonym == SAMPLE_PSEUDONYM
    assert verify_record(records.context).is_sound
