"""The clinic's record on the command line."""

from __future__ import annotations

import csv
import io
import json
from datetime import date

import pytest
from stations import add_member, proven

from insole_core.cases.case_file import write_case
from insole_core.cases.case_record import CaseRecord, Patient
from insole_core.records.accounts import Accounts
from insole_core.records.author import Author, Role
from insole_core.records.person import Person
from insole_core.records.place import RecordsPlace
from insole_core.records.records import open_records
from insole_core.records.visit import Visit
from insole_studio.cli.main import run

_TABLE = "Namn;Född;Personnummer;Anteckning\nÅsa Öberg;02/03/1970;;=1+1\nPer Ek;1980-01-01;;\n;;;\n"


@pytest.fixture
def record(tmp_path):
    """A record with two persons, and a visit of today."""
    folder = tmp_path / "record"
    records = open_records(RecordsPlace.local(folder), Author("eva", "desk"))
    anna = records.persons.add(Person("Anna Berg", date(1970, 2, 28), pseudonym="A-1"))
    records.persons.add(Person("Anna Bergman", pseudonym="A-2"))
    records.visits.add(Visit(anna.id, date.today(), reason="heel\npain"))
    records.close()
    return folder


def test_persons_and_visits_are_listed_as_lines_and_as_json(record, capsys):
    assert run(["records", "list", "berg", "1970", "--record", str(record)]) == 0
    heading, row = csv.reader(io.StringIO(capsys.readouterr().out), delimiter="\t")
    assert heading[:3] == ["pseudonym", "name", "born"]
    assert row[:3] == ["A-1", "Anna Berg", "1970-02-28"]
    assert run(["records", "list", "--visits", "today", "--json", "--record", str(record)]) == 0
    (visit,) = json.loads(capsys.readouterr().out)
    assert (visit["name"], visit["reason"]) == ("Anna Berg", "heel pain")
    assert run(["records", "list", "--orders", "--record", str(record)]) == 0
    assert capsys.readouterr().out == ""


def test_a_person_is_shown_by_pseudonym_and_refused_if_several_are_meant(record, capsys):
    assert run(["records", "show", "A-1", "--record", str(record)]) == 0
    shown = capsys.readouterr().out
    assert "Name: Anna Berg" in shown
    assert "heel" in shown
    assert run(["records", "show", "A-1", "--json", "--record", str(record)]) == 0
    assert json.loads(capsys.readouterr().out)["person"]["name"] == "Anna Berg"
    assert run(["records", "show", "Anna", "--record", str(record)]) == 1
    assert "several persons" in capsys.readouterr().err
    assert run(["records", "show", "Nobody", "--record", str(record)]) == 1
    assert "Nobody is found" in capsys.readouterr().err


def test_a_table_is_imported_after_a_dry_run_and_the_order_of_days_is_asked(
    record, tmp_path, capsys
):
    table, report = tmp_path / "persons.csv", tmp_path / "report.csv"
    table.write_bytes(_TABLE.encode("cp1252"))
    command = ["records", "import", str(table), "--record", str(record)]
    assert run([*command, "--dry-run"]) == 2
    assert "--day-first or --month-first" in capsys.readouterr().err
    assert run([*command, "--dry-run", "--day-first", "--report", str(report)]) == 0
    captured = capsys.readouterr()
    assert "Dry run: 2 new" in captured.err
    assert captured.out.splitlines() == ["2\tnew\tÅsa Öberg\t", "3\tnew\tPer Ek\t"]
    assert _names(record) == {"Anna Berg", "Anna Bergman"}
    assert _read_csv(report)[1:] == [["2", "new", "Åsa Öberg", ""], ["3", "new", "Per Ek", ""]]
    assert run([*command, "--day-first", "--column", "Anteckning=-"]) == 0
    assert "Åsa Öberg" in _names(record)
    person = _persons(record)["Åsa Öberg"]
    assert person.birth_date == date(1970, 3, 2)
    assert run([*command, "--day-first"]) == 0
    captured = capsys.readouterr()
    assert "Done: 0 added (2 already there)" in captured.err
    assert captured.out.splitlines() == [
        "2\talready there\tÅsa Öberg\tIt is Åsa Öberg, born 1970-03-02.",
        "3\talready there\tPer Ek\tIt is Per Ek, born 1980-01-01.",
    ]


@pytest.mark.parametrize(
    ("options", "words"),
    [
        (["--column", "Foo=name"], "no column “Foo”"),
        (["--column", "1=shoe"], "name one of"),
        (["--number-kind", "xx"], "--number-kind"),
        (["--contents", "x"], "--contents belongs"),
        (["--database", "postgresql://x/y"], "needs --contents"),
    ],
)
def test_options_that_mean_nothing_are_refused(record, tmp_path, capsys, options, words):
    table = tmp_path / "persons.csv"
    table.write_text(_TABLE, encoding="utf-8")
    place = [] if options[0] in ("--contents", "--database") else ["--record", str(record)]
    assert run(["records", "import", str(table), *options, *place]) == 2
    assert words in capsys.readouterr().err


def test_a_formula_in_a_reason_is_only_text_in_the_report(record, tmp_path):
    table, report = tmp_path / "persons.csv", tmp_path / "report.csv"
    table.write_text("Name,Born\nX,=cmd()\n", encoding="utf-8")
    command = ["records", "import", str(table), "--record", str(record), "--report", str(report)]
    assert run(command) == 0
    (_, row) = _read_csv(report)
    assert row[1] == "refused"
    assert row[3].startswith("'=cmd() is no date")


def test_a_formula_in_a_name_is_only_text_wherever_a_table_is_written(record, tmp_path, capsys):
    table, report = tmp_path / "persons.csv", tmp_path / "report.csv"
    table.write_text('Name,Born\n"Ek;=cmd()",1980-03-03\n＝cmd(),1980-03-04\n', encoding="utf-8")
    place = ["--record", str(record)]
    assert run(["records", "import", str(table), *place, "--dry-run"]) == 0
    assert run(["records", "import", str(table), *place, "--report", str(report)]) == 0
    assert run(["records", "list", *place]) == 0
    for text in (report.read_text(encoding="utf-8"), capsys.readouterr().out):
        assert '"Ek;=cmd()"' in text
        assert "'＝cmd()" in text


def test_the_character_set_of_a_table_is_asked_for(record, tmp_path, capsys):
    table = tmp_path / "patients.csv"
    table.write_bytes("Name;Born\nŞahin Yıldız;1970-02-28\n".encode("cp1254"))
    command = ["records", "import", str(table), "--record", str(record), "--dry-run"]
    assert run(command) == 1
    asked = capsys.readouterr().err.splitlines()[-1]
    assert "choose it (--encoding)" in asked
    assert "Turkish (cp1254): Şahin, Yıldız" in asked
    assert run([*command, "--encoding", "iso-8859-9"]) == 0
    assert "\tnew\tŞahin Yıldız" in capsys.readouterr().out
    for wrong in ("hex", "no-such", "undefined"):
        assert run([*command, "--encoding", wrong]) == 2
        assert "is no known character set" in capsys.readouterr().err.splitlines()[-1]


def test_a_folder_of_cases_is_imported(record, tmp_path, capsys):
    cases = tmp_path / "cases"
    cases.mkdir()
    write_case(CaseRecord(Patient("Anna Berg", "1970-02-28", "2026-03-01")), cases / "a.insole")
    (cases / "b.insole").write_bytes(b"")
    assert run(["records", "import", str(cases), "--record", str(record)]) == 0
    captured = capsys.readouterr()
    assert "Done: 1 added (1 new, 1 refused)" in captured.err
    assert captured.out.startswith("b.insole\trefused")
    assert _names(record) == {"Anna Berg", "Anna Bergman"}
    assert run(["records", "import", str(cases), "--day-first", "--record", str(record)]) == 2


def test_a_person_is_exported(record, tmp_path, capsys):
    out = tmp_path / "out"
    command = ["records", "export", "A-1", "--out", str(out), "--record", str(record)]
    assert run([*command, "--pseudonymous"]) == 0
    assert "Anna" not in (out / "summary.html").read_text(encoding="utf-8")
    assert run(command) == 1
    assert "not replaced" in capsys.readouterr().err


def test_the_summary_is_in_the_language_that_is_asked_for(record, tmp_path):
    command = ["records", "export", "A-1", "--record", str(record), "--language"]
    for language, words in (
        ("sv", ("Besök ", "Orsak: heel")),
        ("en", ("Visit on", "Reason: heel")),
    ):
        out = tmp_path / language
        assert run([*command, language, "--out", str(out)]) == 0
        page = (out / "summary.html").read_text(encoding="utf-8")
        assert f'<html lang="{language}">' in page
        assert all(word in page for word in words)
        assert ("Besök" in page) == (language == "sv")


def test_only_migrate_makes_a_record(tmp_path, capsys):
    assert run(["records", "list", "--record", str(tmp_path / "new")]) == 2
    assert "does not exist" in capsys.readouterr().err
    assert not (tmp_path / "new").exists()
    assert run(["records", "migrate", "--record", str(tmp_path / "new")]) == 0
    assert run(["records", "list", "--record", str(tmp_path / "new")]) == 0


def test_where_the_clinic_has_accounts_a_command_signs_in_and_keeps_to_the_role(
    record, tmp_path, capsys, monkeypatch
):
    password = "correct horse battery"
    records = open_records(RecordsPlace.local(record), Author("eva", "desk"))
    database = records.context.database
    Accounts(database, records.who).switch_on("eva", "Eva Lund", password)
    eva = Accounts(database, proven("eva", Role.ADMINISTRATOR))
    add_member(eva, "olle", "Olle Ek", Role.ORTHOPEDIST, password)
    records.close()
    command = ["records", "show", "A-1", "--record", str(record)]
    assert run(command) == 1
    assert "not signed in" in capsys.readouterr().err
    for account, code in (("eva", 1), ("olle", 0)):
        monkeypatch.setattr("sys.stdin", io.StringIO(f"{password}\n"))
        assert run([*command, "--account", account]) == code
    monkeypatch.setattr("sys.stdin", io.StringIO("wrong\n"))
    assert run([*command, "--account", "olle"]) == 1
    assert "password is wrong" in capsys.readouterr().err


def _read_csv(path):
    with path.open(encoding="utf-8", newline="") as file:
        return list(csv.reader(file))


def _names(folder):
    return set(_persons(folder))


def _persons(folder):
    records = open_records(RecordsPlace.local(folder), Author("eva", "desk"))
    persons = {person.name: person for person in records.persons.everybody()}
    records.close()
    return persons
