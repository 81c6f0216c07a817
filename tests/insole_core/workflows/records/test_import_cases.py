"""Case files of a folder as visits of the record."""

from __future__ import annotations

from dataclasses import replace
from datetime import date

import pytest

from insole_core.cases.case_file import write_case
from insole_core.cases.case_record import CaseRecord, FootRecord, Patient
from insole_core.cases.scan_source import ScanSource
from insole_core.errors import InputError
from insole_core.formats.stl import write_stl
from insole_core.geometry.side import Side
from insole_core.given_file import sha256_of
from insole_core.insole.elements import Pelott
from insole_core.progress import Cancelled, Progress
from insole_core.records.author import Author
from insole_core.records.person import Person
from insole_core.records.person_import import Outcome
from insole_core.records.place import RecordsPlace
from insole_core.records.records import open_records
from insole_core.workflows.records.import_cases import import_cases, plan_cases

_ANNA = Patient("Anna Berg", "1970-02-28", "2026-03-01", "flat feet", "26-7KQ4M")


@pytest.fixture
def records(tmp_path):
    opened = open_records(RecordsPlace.local(tmp_path / "record"), Author("eva", "desk"))
    yield opened
    opened.close()


@pytest.fixture
def folder(tmp_path):
    (tmp_path / "cases/2026").mkdir(parents=True)
    return tmp_path / "cases"


@pytest.fixture(scope="session")
def feet(left_foot, right_foot):
    return tuple(
        FootRecord.begun(foot, ScanSource("mesh", "scan.stl", "a" * 64, "2026-02-27T08:00:00Z"))
        for foot in (left_foot, right_foot)
    )


def test_a_case_becomes_a_person_and_a_visit_with_both_feet(records, folder, feet):
    left, right = feet
    pad = Pelott(centre_mm=(0.0, 150.0))
    left = left.with_design(replace(left.design, corrections=(pad,)))
    write_case(CaseRecord(_ANNA, (left, right), Side.LEFT), folder / "2026/anna.INSOLE")
    plan = import_cases(records, folder)
    assert [(line.path, line.outcome) for line in plan.lines] == [("2026/anna.INSOLE", "new")]
    (person,) = records.persons.search("anna berg")
    assert person.birth_date == date(1970, 2, 28)
    (visit,) = records.visits.of_person(person.id)
    assert (visit.visited_on, visit.findings) == (date(2026, 3, 1), "flat feet")
    case = records.visits.open_case(visit.id).record
    assert [foot.side for foot in case.feet] == [Side.LEFT, Side.RIGHT]
    assert case.feet[0].design == left.design
    (version,) = records.prescriptions.versions(visit.id, Side.LEFT)
    assert version.reason == "Imported from 2026/anna.INSOLE, 26-7KQ4M"


def test_the_scan_comes_along_where_it_still_lies_as_it_was(records, folder, feet, tmp_path):
    scan, changed = tmp_path / "left.stl", tmp_path / "right.stl"
    for foot, path in zip(feet, (scan, changed), strict=True):
        write_stl(foot.foot.mesh, path)
    sources = [ScanSource("mesh", str(path), sha256_of(path)) for path in (scan, changed)]
    left, right = (replace(f, source=s) for f, s in zip(feet, sources, strict=True))
    changed.write_bytes(b"another scan")
    write_case(CaseRecord(_ANNA, (left, right), Side.LEFT), folder / "anna.insole")
    import_cases(records, folder)
    (person,) = records.persons.everybody()
    (visit,) = records.visits.of_person(person.id)
    (capture,) = records.captures.of_visit(visit.id)
    assert capture.source_sha256 == sources[0].sha256
    (version,) = records.prescriptions.versions(visit.id, Side.LEFT)
    assert version.capture_id == capture.id
    assert [foot.source.path for foot in records.visits.open_case(visit.id).record.feet] == [
        "mesh",
        "mesh",
    ]  # no folder that is named after somebody


def test_a_dry_run_changes_nothing_and_importing_twice_adds_nothing(records, folder, feet):
    for day, foot in zip(("2026-03-01", "2026-04-01"), feet, strict=True):
        patient = replace(_ANNA, visit=day)
        write_case(CaseRecord.of_foot(foot, patient), folder / f"{day}.insole")
    assert [line.outcome for line in plan_cases(records, folder).lines] == ["new", "new"]
    assert records.persons.everybody() == []
    import_cases(records, folder)
    again = import_cases(records, folder)
    assert [line.outcome for line in again.lines] == ["already there", "already there"]
    (person,) = records.persons.everybody()
    assert len(records.visits.of_person(person.id)) == 2


def test_cases_are_matched_by_name_and_birth_date_or_pseudonym(records, folder):
    anna = records.persons.add(Person("Berg, Anna", date(1970, 2, 28), pseudonym="A1"))
    _write(folder, "1", replace(_ANNA, visit="2026-01-01"))
    _write(folder, "2", Patient(visit="2026-01-02", pseudonym="A1"))
    _write(folder, "3", replace(_ANNA, born="1971-01-01", visit="2026-01-03"))
    _write(folder, "4", replace(_ANNA, born="", visit="2026-01-04"))
    plan = import_cases(records, folder)
    assert [line.outcome for line in plan.lines] == [
        Outcome.NEW, Outcome.NEW, Outcome.NEW, Outcome.DOUBTFUL,
    ]  # fmt: skip
    days = [visit.visited_on.day for visit in records.visits.of_person(anna.id)]
    assert sorted(days) == [1, 2]
    assert len(records.persons.everybody()) == 2


def test_doubtful_ones_become_new_persons_on_demand_and_only_once(records, folder, feet):
    records.persons.add(Person("Anna Berg", date(1970, 2, 28)))
    for number, foot in enumerate(feet):
        patient = replace(_ANNA, born="", visit=f"2026-03-0{number + 1}")
        write_case(CaseRecord.of_foot(foot, patient), folder / f"{number}.insole")
    import_cases(records, folder, with_doubtful=True)
    again = import_cases(records, folder, with_doubtful=True)
    assert [line.outcome for line in again.lines] == ["already there", "already there"]
    # Without a birth date, nobody can say that the two are one.
    assert len(records.persons.everybody()) == 3


def test_what_is_no_case_or_says_too_little_is_told(records, folder, feet):
    (folder / "1.insole").write_bytes(b"no case")
    _write(folder, "2", Patient(visit="2026-01-01"))
    _write(folder, "3", replace(_ANNA, born="1970-02-30"))
    _write(folder, "4", replace(_ANNA, visit=""))
    write_case(CaseRecord.of_foot(feet[0], replace(_ANNA, visit="")), folder / "5.insole")
    (folder / "6.insole").write_bytes((folder / "5.insole").read_bytes())
    (folder / ".hidden.insole").write_bytes(b"")
    (folder / "notes.txt").write_text("no case")
    lines = plan_cases(records, folder).lines
    assert [line.outcome for line in lines] == [
        Outcome.REFUSED, Outcome.REFUSED, Outcome.REFUSED, Outcome.REFUSED, Outcome.NEW,
        Outcome.REPEATED,
    ]  # fmt: skip
    words = ("no readable case", "names nobody", "is no date", "no date of a visit", "", "5.insole")
    assert all(word in line.reason for word, line in zip(words, lines, strict=True))
    assert lines[4].day == date(2026, 2, 27)  # of the scan


def test_an_interrupted_import_goes_on_where_it_stopped(records, folder, feet):
    left, right = feet
    case = CaseRecord(_ANNA, (left, right), Side.LEFT)
    write_case(CaseRecord(_ANNA, (left,), Side.LEFT), folder / "half.insole")
    import_cases(records, folder)
    (folder / "half.insole").unlink()
    write_case(case, folder / "anna.insole")
    import_cases(records, folder)
    (person,) = records.persons.everybody()
    (visit,) = records.visits.of_person(person.id)
    assert len(records.visits.open_case(visit.id).record.feet) == 2


def test_a_cancelled_import_keeps_the_cases_before(records, folder):
    _write(folder, "1", _ANNA)
    _write(folder, "2", replace(_ANNA, name="Per Ek"))
    answers = iter([False, True])
    with pytest.raises(Cancelled):
        import_cases(records, folder, progress=Progress(is_cancelled=lambda: next(answers)))
    assert [person.name for person in records.persons.everybody()] == ["Anna Berg"]


def test_a_folder_without_cases_is_refused(records, folder):
    with pytest.raises(InputError, match="holds no case files"):
        plan_cases(records, folder)
    with pytest.raises(InputError, match="cannot be read"):
        plan_cases(records, folder / "none")


def _write(folder, name, patient):
    write_case(CaseRecord(patient), folder / f"{name}.insole")
