"""Persons of a table: columns, rows, who is there already, and adding them in one transaction."""

from __future__ import annotations

import time
from dataclasses import replace
from datetime import date
from pathlib import Path

import pytest

from insole_core.cases.written_dates import DateOrder
from insole_core.errors import InputError
from insole_core.progress import Cancelled, Progress
from insole_core.records.author import Author
from insole_core.records.person import Person
from insole_core.records.person_import import (
    ImportPlan,
    Outcome,
    import_persons,
    plan_import,
)
from insole_core.records.person_table import (
    ColumnMapping,
    asks_date_order,
    propose_mapping,
    read_persons,
)
from insole_core.records.records import open_records
from insole_core.records.text_table import read_table

_TODAY = date(2026, 11, 22)


@pytest.fixture
def records(local_place):
    opened = open_records(local_place, Author("eva", "desk"))
    yield opened
    opened.close()


@pytest.mark.parametrize(
    ("headings", "fields"),
    [
        ("Name,Date of birth,E-mail", ("name", "birth_date", "contact")),
        ("Förnamn,Efternamn,Personnummer,Ort", ("given_name", "family_name",
                                                "personal_number", "contact")),
        ("Nachname,Vorname,Geb.,PLZ", ("family_name", "given_name", "birth_date", "contact")),
        ("Patient,First name,Last name,Ålder", (None, "given_name", "family_name", None)),
        ("Name,Name,,Notes 1,Notes 2", ("name", None, None, "notes", "notes")),
    ],
)  # fmt: skip
def test_headings_of_three_languages_propose_the_columns(tmp_path, headings, fields):
    assert propose_mapping(_table(tmp_path, headings + "\n")).fields == fields


def test_one_date_tells_the_order_of_a_column_and_numbers_their_kind(tmp_path):
    text = "Name,Born,Personnummer\nA B,02/03/1964,640823-3234\nC D,31/01/1970,\n"
    table = _table(tmp_path, text)
    mapping = propose_mapping(table)
    assert (mapping.date_order, mapping.number_kind) == (DateOrder.DAY_FIRST, "se")
    assert asks_date_order(table, mapping)


def test_an_ambiguous_day_is_refused_until_its_order_is_said(tmp_path):
    table = _table(tmp_path, "Name,Born\nAnna Berg,02/03/1970\n")
    mapping = propose_mapping(table)
    assert mapping.date_order is None
    refused = read_persons(table, mapping, _TODAY).refused
    assert "1970-02-03 or 1970-03-02" in refused[0].reason
    said = ColumnMapping(mapping.fields, DateOrder.MONTH_FIRST)
    (row,) = read_persons(table, said, _TODAY).accepted
    assert row.person.birth_date == date(1970, 2, 3)


def test_all_that_is_mapped_arrives_and_several_columns_become_lines(tmp_path):
    text = (
        "Vorname;Nachname;Geb.;Telefon;Ort;Notizen;Bemerkung;Einwilligung\n"
        "Jürgen;Groß;28.02.1970;+49 1;Köln;Plattfuß;;01.02.2026\n"
    )
    table = _table(tmp_path, text, "cp1252")
    (row,) = read_persons(table, propose_mapping(table), _TODAY).accepted
    person = row.person
    assert (person.name, person.birth_date) == ("Jürgen Groß", date(1970, 2, 28))
    assert (person.contact, person.notes) == ("+49 1\nKöln", "Notizen: Plattfuß")
    assert person.consent_on == date(2026, 2, 1)


@pytest.mark.parametrize(
    ("row", "words"),
    [
        (",1970-02-28,", "name is missing"),
        ("x" * 10_000 + ",1970-02-28,", "10000 characters"),
        ("Anna\x07Berg,,", "cannot be seen"),
        ("Anna \u202eBerg,,", "cannot be seen"),
        ("Anna Berg,1970-02-30,", "is no date"),
        ("Anna Berg,2970-02-28,", "not between"),
        ("Anna Berg,1970-02-28,640823-3234", "not that of the personal number"),
        ("Anna Berg,,640823-3235", "last digit"),
        ("Anna Berg,1970-02-28,,more", "4 cells under 3 headings"),
    ],
)
def test_rows_that_cannot_be_right_are_refused_with_their_line_and_reason(tmp_path, row, words):
    table = _table(tmp_path, f"Name,Born,Pnr\nPer Ek,1980-01-01,\n{row}\n")
    mapping = ColumnMapping(("name", "birth_date", "personal_number"), number_kind="se")
    rows = read_persons(table, mapping, _TODAY)
    assert [row.person.name for row in rows.accepted] == ["Per Ek"]
    (refused,) = rows.refused
    assert refused.line == 3
    assert words in refused.reason


def test_names_in_any_script_and_commands_are_only_texts(tmp_path, records):
    names = [
        "'; DROP TABLE persons; --",
        "محمد علي",
        "דוד כהן",
        "李小龍",
        "<script>x</script>",
        "=1+1",
    ]
    table = _table(tmp_path, "Name\n" + "\n".join(names) + "\n", "utf-16")
    import_persons(records, read_persons(table, propose_mapping(table), _TODAY))
    assert {person.name for person in records.persons.everybody()} == set(names)


@pytest.mark.parametrize(
    "fields",
    [
        (None, "notes", None),
        ("name", "given_name", None),
        ("name", "birth_date", "birth_date"),
    ],
)
def test_columns_that_make_no_person_are_refused(tmp_path, fields):
    table = _table(tmp_path, "a,b,c\n1,2,3\n")
    with pytest.raises(InputError, match="column"):
        read_persons(table, ColumnMapping(fields), _TODAY)


def test_the_dry_run_tells_new_present_repeated_doubtful_and_refused(tmp_path, records):
    records.persons.add(Person("Anna Berg", date(1970, 2, 28), pseudonym="P-1"))
    records.persons.add(Person("Per Ek", date(1980, 1, 1), personal_number="7"))
    text = (
        "Name,Born,Personal number,Pseudonym\n"
        '"BERG, Anna",1970-02-28,,\n'  # the same words of the name
        "Lena Holm,1990-05-05,,\n"
        "Lena Holm,1990-05-05,,\n"
        "Anna Berg,,,\n"  # without a birth date
        "Per Ek,1980-01-01,8,\n"  # with another number
        "Olle Ek,1950-01-01,7,\n"  # with the number of another person
        "Ulla Ny,1951-01-01,,P-1\n"  # with the pseudonym of another person
        "Anna Berg,1971-01-01,,\n"  # born on another day
        ",1970-01-01,,\n"
    )
    rows = _rows(tmp_path, text)
    plan = plan_import(records, rows)
    assert [line.outcome for line in plan.lines] == [
        Outcome.PRESENT, Outcome.NEW, Outcome.REPEATED, Outcome.DOUBTFUL, Outcome.DOUBTFUL,
        Outcome.DOUBTFUL, Outcome.REFUSED, Outcome.NEW, Outcome.REFUSED,
    ]  # fmt: skip
    assert [line.line for line in plan.lines] == list(range(2, 11))
    assert len(records.persons.everybody()) == 2


def test_an_import_adds_the_new_ones_and_the_doubtful_only_on_demand(tmp_path, records):
    records.persons.add(Person("Anna Berg", date(1970, 2, 28)))
    rows = _rows(tmp_path, "Name,Born\nAnna Berg,\nLena Holm,1990-05-05\n")
    import_persons(records, rows)
    assert sorted(p.name for p in records.persons.everybody()) == ["Anna Berg", "Lena Holm"]
    import_persons(records, rows, with_doubtful=True)
    names = sorted(p.name for p in records.persons.everybody())
    assert names == ["Anna Berg", "Anna Berg", "Lena Holm"]


def test_importing_the_same_file_twice_adds_nobody(tmp_path, records):
    text = "Name,Born\n" + "".join(f"Person {n},19{n:02d}-01-01\n" for n in range(50))
    import_persons(records, _rows(tmp_path, text))
    again = import_persons(records, _rows(tmp_path, text))
    assert len(again.of(Outcome.PRESENT)) == 50
    assert len(records.persons.everybody()) == 50


_NASTY = [
    "Anna Berg;;;;",
    "Anna Berg;;;040-1;",
    "Anna Berg;1970-02-28;;;",
    "Anna Berg;;640823-3234;;",
    "Per Ek;;;;left foot",
    "Per Ek;;;;right foot",
    '"\'; DROP TABLE persons; --";;;=1+1;',
    '"Quoted; ""Name""";;;"two\nlines";',
    "<b>Lena</b>;;;;",
    "../../etc;;;;",
    "محمد علي;;;;",
    "E\u0301va;;;;",
    "Anna \u202eBerg;;;;",
    "Anna\x07Berg;;;;",
    ";1970-02-28;;;",
    "x" * 10_000 + ";;;;",
    "Ulla Ny;1970-02-30;;;",
    "Ulla Ny;2970-02-28;;;",
]


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "utf-16", "utf-16-le"])
def test_a_file_imported_again_with_its_doubtful_rows_adds_nobody(tmp_path, records, encoding):
    records.persons.add(Person("Anna Berg", date(1970, 2, 28), contact="040-2"))
    head = "Name;Born;Personnummer;Telefon;Notes"
    others = ";".join(f"c{n}" for n in range(295))
    text = "\n".join([f"{head};{others}", *_NASTY]) + "\n"
    table = _table(tmp_path, text, encoding)
    assert len(table.headings) == 300
    rows = read_persons(table, propose_mapping(table), _TODAY)
    assert len(rows.refused) == 6
    dry = plan_import(records, rows)
    done = import_persons(records, rows, with_doubtful=True)
    assert _outcomes(done) == _outcomes(dry)
    count = 1 + len(dry.of(Outcome.NEW, Outcome.DOUBTFUL))
    assert len(records.persons.everybody()) == count == 12
    again = import_persons(
        records, read_persons(table, propose_mapping(table), _TODAY), with_doubtful=True
    )
    assert {line.outcome for line in again.lines} == {Outcome.PRESENT, Outcome.REFUSED}
    assert len(records.persons.everybody()) == count


def test_rows_of_persons_completed_changed_or_merged_since_are_there_already(tmp_path, records):
    rows = _rows(tmp_path, "Name,Phone,Notes\nAnna Berg,040-1,flat foot\nA. Berg,040-1,\n")
    import_persons(records, rows)
    anna, short = sorted(records.persons.everybody(), key=lambda person: person.name, reverse=True)
    person = records.persons.get(anna.id)
    completed = replace(
        person, birth_date=date(1970, 2, 28), contact="Malmö\n040-1", notes="Flat foot\nlikes tea"
    )
    records.persons.change(completed, person.revision)
    records.persons.merge(anna.id, short.id)
    plan = import_persons(records, rows, with_doubtful=True)
    assert [line.outcome for line in plan.lines] == [Outcome.PRESENT, Outcome.PRESENT]
    assert "born 1970-02-28" in plan.lines[0].reason


def test_a_row_that_says_something_else_is_doubtful(tmp_path, records):
    records.persons.add(Person("Anna Berg", contact="040-1"))
    records.persons.add(Person("Per Ek", date(1970, 2, 28), contact="040-2"))
    rows = _rows(tmp_path, "Name,Phone,Notes\nAnna Berg,040-9,\nAnna Berg,,new\nPer Ek,,\n")
    plan = plan_import(records, rows)
    assert [line.outcome for line in plan.lines] == [Outcome.DOUBTFUL] * 3


def test_a_column_of_towns_taken_for_names_is_planned_in_seconds(tmp_path, records):
    rows = _rows(tmp_path, "Name,Phone\n" + "".join(f"Malmö,{n}\n" for n in range(8000)))
    begin = time.process_time()
    plan = plan_import(records, rows)
    assert time.process_time() - begin < 5
    assert [line.outcome for line in plan.lines] == [Outcome.NEW, *[Outcome.DOUBTFUL] * 7999]


def test_both_databases_add_the_same_persons_and_their_audit_lines(tmp_path, stations):
    records = stations.open()
    text = (
        'Name;Born;Personnummer;Ort\nÅsa Öberg;;640823-3234;Malmö\n"\'; DROP TABLE";1970-01-01;;\n'
    )
    import_persons(records, _rows(tmp_path, text))
    found = {person.name: person for person in records.persons.everybody()}
    assert found.keys() == {"Åsa Öberg", "'; DROP TABLE"}
    assert found["Åsa Öberg"].birth_date == date(1964, 8, 23)
    added = [line.subject_id for line in records.audit.lines() if line.action == "added"]
    assert set(added) == {person.id for person in found.values()}
    assert records.audit.verify().is_intact
    assert [person.name for person in records.persons.search("asa 1964")] == ["Åsa Öberg"]


def test_an_interrupted_import_adds_nobody(tmp_path, records):
    rows = _rows(tmp_path, "Name\n" + "".join(f"Person {n}\n" for n in range(1200)))
    answers = iter([False, False, True])
    with pytest.raises(Cancelled):
        import_persons(records, rows, progress=Progress(is_cancelled=lambda: next(answers)))
    assert records.persons.everybody() == []


def _outcomes(plan: ImportPlan):
    return [(line.line, line.outcome, line.reason) for line in plan.lines]


def _rows(folder: Path, text: str):
    table = _table(folder, text)
    return read_persons(table, propose_mapping(table), _TODAY)


def _table(folder: Path, text: str, encoding: str = "utf-8"):
    path = folder / "persons.csv"
    path.write_bytes(text.encode(encoding))
    return read_table(path)
