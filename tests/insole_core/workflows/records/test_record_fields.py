"""Whatever field is declared on a person, a visit or an order, all that goes by fields knows it."""

from __future__ import annotations

import json
from collections.abc import Iterator
from dataclasses import dataclass, replace
from datetime import date
from pathlib import Path
from typing import Annotated, Any

import jsonschema
import pytest
from sqlalchemy import Column

from insole_core.errors import InputError
from insole_core.evaluation.report import section_lines
from insole_core.messages import Message
from insole_core.records import schema
from insole_core.records.author import Author
from insole_core.records.capture import CaptureFacts
from insole_core.records.fhir import patient_resource
from insole_core.records.marks import TAKEN_OVER, Erased, Merged
from insole_core.records.order import Order
from insole_core.records.person import Person
from insole_core.records.person_import import Outcome, plan_import
from insole_core.records.person_table import IMPORTED, field_of, propose_mapping, read_persons
from insole_core.records.place import RecordsPlace
from insole_core.records.record_field import (
    Choice,
    Day,
    Number,
    Typed,
    check_fields,
    fields_of,
    listed_fields,
    merge_fields,
    told_fields,
    typed_fields,
)
from insole_core.records.records import Records, open_records
from insole_core.records.retention import ErasureReason, erase_person
from insole_core.records.schema import tables_of_persons
from insole_core.records.text_table import read_table
from insole_core.records.visit import FollowUp, Visit
from insole_core.workflows.records.person_dossier import person_json, pseudonymous, read_dossier
from insole_core.workflows.records.person_summary import person_report

TODAY = date.today()
DEFINITIONS = {
    "persons": "person", "visits": "visit", "captures": "capture", "visit_photos": "photo",
    "prescription_versions": "version", "orders": "order", "follow_ups": "follow_up",
}  # fmt: skip
"""What the schema of the export calls a row of a table."""
WITHHELD = {
    **dict.fromkeys(("persons.search_text", "persons.sort_key", "persons.name_key",
                     "person_words.word", "person_words.person_id"), "made of other fields"),
    **dict.fromkeys(("persons.is_erased", "persons.merged_into", "persons.last_seq",
                     "persons.revision", "visits.revision", "orders.revision",
                     "visit_photos.revision", "prescription_versions.revision"),
                    "only this record needs to know"),
    "persons.salt": "by which nobody may guess what an erased row held",
    **dict.fromkeys(("presence.visit_id", "presence.station", "presence.author", "presence.since",
                     "presence.seen_at"), "who works where just now"),
    "captures.number": "their order in the list",
    **dict.fromkeys(("order_files.order_id", "order_events.order_id", "order_feet.order_id",
                     "order_feet.release"), "they stand in their order"),
    "order_feet.prescription_version_id": "version_ids of the order",
    **dict.fromkeys(("prescription_versions.document", "prescription_versions.mesh_sha256"),
                    "foot of the version, and the case file"),
}  # fmt: skip
"""Columns about a person that an export does not hold under their name, and why."""
KNOWN = {"name": "Zaphodina Uniqname", "personal_number": "19811228-9874"}
"""What must be of a form of its own."""
OF_PERSON = typed_fields(Person)
OF_VISIT = typed_fields(Visit)
SCHEMA = Path(__file__).parents[4] / "docs/formats/record.schema.json"


def sample(name: str, field: Typed) -> Any:
    """A value that the field can hold, and that stands nowhere else."""
    if isinstance(field, Day):
        return date(1971, 4, 2) if name == "birth_date" else date(2026, 4, 2)
    if isinstance(field, Number):
        return field.least + 0.5
    if isinstance(field, Choice):
        return next(reversed(field.names))
    return KNOWN.get(name, f"planted {name}")


PERSON = Person(**{name: sample(name, field) for name, field in OF_PERSON.items()})
VISIT = {name: sample(name, field) for name, field in OF_VISIT.items()}


@pytest.fixture(scope="module")
def records(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Records]:
    folder = tmp_path_factory.mktemp("fields")
    opened = open_records(RecordsPlace.local(folder / "record"), Author("anna", "desk"))
    yield opened
    opened.close()


@pytest.fixture
def person(records: Records) -> Iterator[Person]:
    """Somebody in the record with a value in every field, and a visit with one in every field."""
    fresh = Person("")
    added = records.persons.add(
        replace(PERSON, id=fresh.id, pseudonym=f"{PERSON.pseudonym} {fresh.pseudonym}")
    )
    records.visits.add(Visit(added.id, **VISIT))
    yield added
    erase_person(records.context, added.id, ErasureReason.REQUEST, date(2099, 1, 1))


def words_of(records: Records, person: Person, *, is_pseudonymous: bool = False) -> str:
    """All that an export writes of a person, for programs and for people."""
    dossier = read_dossier(records, person.id)
    dossier = pseudonymous(dossier) if is_pseudonymous else dossier
    data = json.dumps(person_json(dossier, {}, (), ()), ensure_ascii=False)
    sections = person_report(dossier, {}, (), ()).sections
    return "\n".join([data, *(line for section in sections for line in section_lines(section))])


@pytest.mark.parametrize("kind", [Person, Visit, Order, FollowUp])
def test_no_two_fields_are_called_the_same(kind: type) -> None:
    fields = fields_of(kind).values()
    labels = [field.label for field in typed_fields(kind).values()]
    assert len(set(labels)) == len(labels)
    assert len({field.noun for field in fields}) == len(fields)


def test_all_that_is_filled_in_is_stored(records: Records, person: Person) -> None:
    assert records.persons.get(person.id) == person
    (visit,) = records.visits.of_person(person.id)
    assert {name: getattr(visit, name) for name in OF_VISIT} == VISIT


@pytest.mark.parametrize("name", OF_PERSON)
def test_a_field_is_typed_as_it_is_written(name: str) -> None:
    written = OF_PERSON[name].written(getattr(PERSON, name))
    assert PERSON.with_typed(name, written, TODAY) == PERSON


@pytest.mark.parametrize("name", [n for n in OF_PERSON if n not in ("number_kind",)])
def test_a_change_of_a_field_is_stored_told_and_refused_to_who_comes_second(
    records: Records, person: Person, name: str
) -> None:
    field = OF_PERSON[name]
    value = date(1972, 5, 3) if isinstance(field, Day) else f"other {name}"
    number = {"number_kind": ""} if name == "personal_number" else {}
    changed = records.persons.change(replace(person, **{name: value}, **number), person.revision)
    assert getattr(changed, name) == value
    details = json.loads(records.audit.lines(subject_id=person.id)[0].details)
    assert set(details["fields"].split()) == {name, *number}
    merged, collided = merge_fields(person, person, changed, tuple(OF_PERSON))
    assert collided == ()
    assert getattr(merged, name) == value
    records.persons.change(replace(changed, **{name: getattr(person, name)}), changed.revision)


@pytest.mark.parametrize(
    "name", [n for n, f in OF_PERSON.items() if f.mark.merged is Merged.FILLED]
)
def test_a_merge_takes_a_field_over_and_gives_it_back(
    records: Records, person: Person, name: str
) -> None:
    kept = records.persons.add(Person("Berta"))
    assert name in records.persons.preview_merge(kept.id, person.id).filled
    merge = records.persons.merge(kept.id, person.id)
    assert getattr(records.persons.get(kept.id), name) == getattr(person, name)
    records.persons.undo_merge(merge)
    assert not getattr(records.persons.get(kept.id), name)


@pytest.mark.parametrize("kind", [Person, Visit])
def test_an_erasure_empties_every_field_that_has_no_reason_to_stay(
    records: Records, person: Person, kind: type
) -> None:
    (visit,) = records.visits.of_person(person.id)
    erase_person(records.context, person.id, ErasureReason.REQUEST, TODAY)
    left = records.persons.get(person.id) if kind is Person else records.visits.get(visit.id)
    empty = {name for name in typed_fields(kind) if not getattr(left, name)}
    emptied = {n for n, f in typed_fields(kind).items() if f.mark.erased is Erased.EMPTIED}
    assert empty == emptied
    if kind is Person:
        assert emptied == OF_PERSON.keys() - {"name", "pseudonym"}


@pytest.mark.parametrize("name", OF_PERSON | OF_VISIT)
def test_an_export_holds_every_field(records: Records, person: Person, name: str) -> None:
    field = {**OF_PERSON, **OF_VISIT}[name]
    value = field.written({**vars(PERSON), **VISIT}[name])
    said = words_of(records, person)
    assert f'"{name}": ' in said
    assert value in said
    if field.is_told:
        assert f"{field.label}: {value}" in said


def test_a_pseudonymous_export_holds_no_text_about_the_person(
    records: Records, person: Person
) -> None:
    said = words_of(records, person, is_pseudonymous=True)
    texts = {n for n, f in {**OF_PERSON, **OF_VISIT}.items() if f.kind is str and f.is_told}
    planted = {**vars(PERSON), **VISIT}
    assert {name for name in texts if str(planted[name]) in said} == {"pseudonym"}
    assert "1971-04-02" not in said


def test_the_schema_of_the_export_knows_every_field(records: Records, person: Person) -> None:
    forms = json.loads(SCHEMA.read_text(encoding="utf-8"))
    data = person_json(read_dossier(records, person.id), {}, (), ())
    jsonschema.validate(data, forms)
    for kind, form in (
        (Person, "person"), (Visit, "visit"), (Order, "order"), (FollowUp, "follow_up"),
        (CaptureFacts, "capture"),
    ):  # fmt: skip
        known = forms["$defs"][form]["properties"]
        assert fields_of(kind).keys() - known.keys() == set()


def columns_of_persons() -> Iterator[Column[Any]]:
    for table in (schema.persons, *tables_of_persons()):
        yield from table.columns


def test_every_column_about_a_person_is_exported_or_says_why_not() -> None:
    forms = json.loads(SCHEMA.read_text(encoding="utf-8"))["$defs"]
    parts = {f"order_{name}": forms["order"]["properties"][name]["items"]
             for name in ("files", "events")}  # fmt: skip
    known = {
        f"{table}.{name}"
        for table, form in {**{t: forms[d] for t, d in DEFINITIONS.items()}, **parts}.items()
        for name in form["properties"]
    }
    columns = {f"{column.table.name}.{column.name}" for column in columns_of_persons()}
    assert columns - known == WITHHELD.keys()


@pytest.mark.parametrize("name", IMPORTED)
def test_a_list_brings_every_field_by_each_of_its_headings(tmp_path: Path, name: str) -> None:
    field = IMPORTED[name]
    value = sample(name, field)
    for heading in field.headings:
        assert field_of(heading) == name
        path = tmp_path / "list.csv"
        whole = "" if name in ("name", "given_name") else "Given name;"
        path.write_text(f"{whole}{heading}\n{whole and 'Anna;'}{field.written(value)}\n", "utf-8")
        table = read_table(path)
        (row,) = read_persons(table, propose_mapping(table), TODAY).accepted
        held = getattr(row.person, "name" if name in ("given_name", "family_name") else name)
        assert held == (f"Anna {value}" if name == "family_name" else value)


def test_every_field_is_imported_but_the_kind_of_the_number() -> None:
    assert OF_PERSON.keys() - IMPORTED.keys() == {"number_kind"}


@pytest.mark.parametrize("name", ["contact", "notes"])
def test_a_row_that_tells_more_of_a_namesake_is_no_repetition(
    records: Records, person: Person, tmp_path: Path, name: str
) -> None:
    path = tmp_path / "list.csv"
    heading, value = IMPORTED[name].headings[0], getattr(person, name)
    rows = f"{PERSON.name};{value}\n{PERSON.name};{value} and more\n"
    path.write_text(f"Name;{heading}\n{rows}", "utf-8")
    table = read_table(path)
    lines = plan_import(records, read_persons(table, propose_mapping(table), TODAY)).lines
    assert lines[1].outcome is Outcome.DOUBTFUL


@pytest.mark.parametrize("name", OF_PERSON | OF_VISIT)
def test_what_a_field_cannot_hold_is_refused_by_its_name(name: str) -> None:
    field = {**OF_PERSON, **OF_VISIT}[name]
    value = PERSON if name in OF_PERSON else Visit(PERSON.id, **VISIT)
    wrong: Any = "x" * 30_000
    if isinstance(field, Day):
        wrong = date(1801, 1, 1)
    if isinstance(field, Number):
        wrong = field.most + 1
    with pytest.raises(InputError, match=f"The {field.noun} |no {field.noun}"):
        replace(value, **{name: wrong}).checked(TODAY)


@dataclass(frozen=True)
class Shod:
    """A value with a field that is one of a few words."""

    shoe: Annotated[str, Choice(
        "shoe", TAKEN_OVER, label="Usual shoe", names={"boot": "Boot", "low": "Low shoe"},
    )] = ""  # fmt: skip


def test_a_choice_is_one_of_its_words_wherever_it_comes_from() -> None:
    (shoe,) = typed_fields(Shod).values()
    assert [shoe.read(text, TODAY) for text in ("boot", " LOW SHOE", "")] == ["boot", "low", ""]
    with pytest.raises(InputError, match="The shoe is one of: Boot, Low shoe; clog is none of"):
        shoe.read("clog", TODAY)
    with pytest.raises(InputError, match="clog"):
        check_fields(Shod("clog"), TODAY)
    with pytest.raises(InputError, match="kind of number"):
        replace(PERSON, personal_number="", number_kind="martian").checked(TODAY)


def test_a_choice_is_told_by_its_name_to_be_translated() -> None:
    ((_, said),) = told_fields(Shod("low"))
    assert (said, isinstance(said, Message)) == ("Low shoe", True)
    assert list(told_fields(Shod())) == []


def test_lists_hold_a_column_for_every_field_that_is_listed(
    records: Records, person: Person
) -> None:
    (found,) = records.persons.search(person.pseudonym, 2)
    assert {name: getattr(found, name) for name in listed_fields(Person)} == {
        name: getattr(person, name) for name in listed_fields(Person)
    }
    for name in listed_fields(Person):
        assert found in records.persons.listed("", name, 10)
    (visit,) = records.visits.on(VISIT["visited_on"])
    assert {name: getattr(visit, name) for name in listed_fields(Visit)} == {
        name: VISIT[name] for name in listed_fields(Visit)
    }


def test_another_system_gets_every_field_that_it_has_an_element_for() -> None:
    resource = json.dumps(patient_resource(PERSON), ensure_ascii=False)
    held = {
        name
        for name, field in OF_PERSON.items()
        if f'"{field.written(vars(PERSON)[name])}"' in resource
    }
    declared = {name for name, field in OF_PERSON.items() if field.fhir}
    assert held == declared | {"pseudonym"}
    assert all(element in patient_resource(PERSON) for element in ("name", "telecom", "birthDate"))


def test_measures_are_told_with_their_decimals_and_what_tells_their_limits(
    records: Records, person: Person
) -> None:
    told = {
        "left_foot_length_mm": 251.234,
        "left_foot_length_mm_limits_95_by_simulation": 1.0,
        "left_arch_index": 0.2449,
        "own_score": 3.125,
    }
    records.visits.add(Visit(person.id, date(2026, 5, 3), measures=told))
    words = words_of(records, person)
    assert "251.2 ± 1.0" in words
    assert "0.24 ± ?" in words
    assert "3.125" in words
    assert "± ?: not known for this value" in words
    assert "scanner" not in words
