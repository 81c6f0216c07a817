"""The administration of the record on the command line."""

from __future__ import annotations

import io
import json
from collections.abc import Callable, Iterator
from datetime import date
from pathlib import Path

import pytest

from insole_core.errors import UsageError
from insole_core.records.author import Author, Role
from insole_core.records.person import Person
from insole_core.records.place import RecordsPlace
from insole_core.records.records import Records, open_records
from insole_core.records.visit import Visit
from insole_studio.cli.main import run
from insole_studio.cli.records.secrets import new_password
from insole_studio.settings import load_settings
from insole_studio.user_paths import UserPaths

CHEF, EVA, FIRST = "four words in a row", "quite some other words", "told across the desk"
Command = Callable[..., int]


pytestmark = pytest.mark.usefixtures("quick_passphrases")


@pytest.fixture
def records(tmp_path: Path) -> Iterator[Records]:
    """A record with two persons, who were here today."""
    opened = open_records(RecordsPlace.local(tmp_path / "record"), Author.of_user())
    for name, pseudonym in (("Anna Berg", "A-1"), ("Ben Ek", "B-1")):
        person = opened.persons.add(Person(name, pseudonym=pseudonym))
        opened.visits.add(Visit(person.id, date.today()))
    yield opened
    opened.close()


@pytest.fixture
def command(records: Records, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Command:
    """Run a step of `records`, with the lines that somebody types."""

    def command(*arguments: str, typed: tuple[str, ...] = (), account: str = "chef") -> int:
        monkeypatch.setattr("sys.stdin", io.StringIO("".join(f"{line}\n" for line in typed)))
        signing = ("--account", account) if records.accounts.are_on else ()
        return run(["records", *arguments, "--record", str(tmp_path / "record"), *signing])

    return command


def test_accounts_are_administered_from_the_first_one_on(
    records: Records, command: Command, capsys: pytest.CaptureFixture[str]
) -> None:
    first = ("chef", "--full-name", "Carla Chef")
    assert command("accounts", "on", *first, typed=(CHEF,)) == 0  # once, as a script writes it
    eva = ("eva", "--full-name", "Eva Ek", "--role", "technician")
    assert command("accounts", "add", *eva, typed=(CHEF, FIRST)) == 0
    assert command("password", typed=(FIRST, EVA), account="eva") == 0
    assert records.accounts.sign_in("eva", EVA).role == "technician"
    assert command("password", typed=(FIRST, CHEF), account="eva") == 1
    change = ("--role", "orthopedist", "--system-user", "ek")
    assert command("accounts", "change", "Eva", *change, typed=(CHEF,)) == 0
    assert command("accounts", "reset", "ＥＶＡ", typed=(CHEF, FIRST)) == 0  # in wide letters
    capsys.readouterr()
    assert command("accounts", "list", "--json", typed=(CHEF,)) == 0
    listed = json.loads(capsys.readouterr().out)
    assert listed[1] == {
        "account": "eva", "full name": "Eva Ek", "role": "orthopedist",
        "state": "first password", "system user": "ek",
    }  # fmt: skip
    assert command("accounts", "change", "eva", "--disable", typed=(CHEF,)) == 0
    assert command("accounts", "unlock", "eva", typed=(CHEF,)) == 0
    assert command("accounts", "unlock", "nobody", typed=(CHEF,)) == 1
    assert "no account nobody" in capsys.readouterr().err
    assert command("accounts", "list", typed=(CHEF,)) == 0
    assert "eva\tEva Ek\torthopedist\tdisabled\tek" in capsys.readouterr().out
    assert command("accounts", "off", typed=(CHEF,)) == 0
    assert not records.accounts.are_on


class Terminal(io.StringIO):
    """Where somebody types."""

    def isatty(self) -> bool:
        return True


def test_what_is_typed_blindly_is_typed_twice(monkeypatch: pytest.MonkeyPatch) -> None:
    typed = iter((CHEF, "something else", CHEF, CHEF))
    monkeypatch.setattr("getpass.getpass", lambda _prompt: next(typed))
    monkeypatch.setattr("sys.stdin", Terminal())
    with pytest.raises(UsageError, match="differ"):
        new_password()
    assert new_password() == CHEF


def test_accounts_that_somebody_has_switched_off_unseen_are_told(
    records: Records, command: Command, capsys: pytest.CaptureFixture[str]
) -> None:
    assert command("verify", "--account", "chef", typed=(CHEF,)) == 1
    assert "The record has no accounts" in capsys.readouterr().err
    records.accounts.switch_on("chef", "Carla Chef", CHEF)
    with records.context.database.writing() as connection:
        connection.exec_driver_sql("DELETE FROM clinic WHERE key = 'accounts_on'")
    assert command("verify", "--account", "chef", typed=(CHEF,)) == 1
    assert "although nobody has switched them off" in capsys.readouterr().err


def test_the_backup_service_does_not_choose_what_opens_the_backups(
    records: Records, command: Command, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    records.accounts.switch_on("chef", "Carla Chef", CHEF)
    chef = records.for_author(records.accounts.sign_in("chef", CHEF))
    chef.accounts.add("night", "Night Watch", Role.BACKUP_SERVICE, EVA)
    folder = str(tmp_path / "backups")
    assert command("backup", folder, typed=(EVA,), account="night") == 1
    assert "let an administrator make the first backup" in capsys.readouterr().err
    assert command("backup", folder, typed=(CHEF, "what opens the backups")) == 0
    assert command("backup", folder, typed=(EVA,), account="night") == 0


def test_the_audit_log_is_filtered_and_verified(
    command: Command, capsys: pytest.CaptureFixture[str]
) -> None:
    today = date.today().isoformat()
    assert command("audit", "--person", "A-1", "--from", today, "--to", "today", "--json") == 0
    lines = json.loads(capsys.readouterr().out)
    assert [line["what"] for line in lines] == ["visit A-1", "person A-1"]
    assert command("audit", "--author", "nobody") == 0
    assert capsys.readouterr().out == ""
    assert command("audit", "--verify") == 0
    assert "4 lines are what was written" in capsys.readouterr().out


def test_a_person_is_erased_once_that_is_confirmed(
    records: Records, command: Command, capsys: pytest.CaptureFixture[str]
) -> None:
    assert command("erase", "A-1") == 2
    told = capsys.readouterr()
    assert "A-1: 1 visit, " in told.out
    assert "Nothing was erased" in told.err
    assert {person.name for person in records.persons.recent()} == {"Anna Berg", "Ben Ek"}
    assert command("erase", "A-1", "--yes") == 0
    assert "Anna Berg" not in {person.name for person in records.persons.recent()}


def test_those_whose_time_is_over_are_listed_and_erased(
    records: Records, command: Command, capsys: pytest.CaptureFixture[str]
) -> None:
    assert command("retention", "--years", "3") == 2
    assert "at least 10 years" in capsys.readouterr().err
    assert command("retention", "--years", "3000") == 2
    assert "100 are the most" in capsys.readouterr().err
    assert command("retention", "--years", "15") == 0
    assert capsys.readouterr().out == "kept for 15 years after the last entry\n"
    assert command("audit", "--limit", "1") == 0
    assert "years: 15, years_before: 10" in capsys.readouterr().out
    with records.context.database.writing() as connection:
        for table, column in (("persons", "created_at"), ("visits", "visited_on")):
            connection.exec_driver_sql(f"UPDATE {table} SET {column} = '1990-01-01'")
    assert command("retention") == 0
    assert "A-1\tkept until 2005-01-01\t1 visit\t0 orders" in capsys.readouterr().out
    assert command("erase", "A-1", "--reason", "retention", "--yes") == 0
    assert "everything but the pseudonym" in capsys.readouterr().out
    assert command("retention") == 0
    assert "A-1" not in capsys.readouterr().out


@pytest.mark.parametrize("step", ["audit", "list", "retention"])
@pytest.mark.parametrize("limit", ["0", "-3"])
def test_a_list_has_at_least_one_line(
    step: str, limit: str, command: Command, capsys: pytest.CaptureFixture[str]
) -> None:
    with pytest.raises(SystemExit) as ended:
        command(step, "--limit", limit)
    assert ended.value.code == 2
    assert f"--limit: {limit} is less than 1" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (["list", "foo", "--orders"], "--orders and --visits list all, and take no WORD"),
        (["list", "foo", "--visits", "today"], "--orders and --visits list all, and take no WORD"),
        (["audit", "--verify", "--person", "NOPE"], "--verify reads the whole log"),
        (["audit", "--verify", "--to", "2026-11-20"], "--verify reads the whole log"),
        (["list", "--password-fd", "77"], "name it with --account"),
        (["audit", "--password-file", "nothing"], "name it with --account"),
        (["accounts", "off"], "The record has no accounts"),
    ],
)
def test_what_would_be_ignored_is_refused_and_nothing_is_written(
    words: list[str],
    told: str,
    command: Command,
    records: Records,
    capsys: pytest.CaptureFixture[str],
) -> None:
    lines = len(records.audit.lines())
    assert command(*words) == 2
    assert told in capsys.readouterr().err
    assert len(records.audit.lines()) == lines


def test_days_of_the_log_that_end_before_they_begin_are_told(
    command: Command, capsys: pytest.CaptureFixture[str]
) -> None:
    assert command("audit", "--from", "2026-11-20", "--to", "2026-11-19") == 2
    assert "--from is 2026-11-20, which is after --to 2026-11-19" in capsys.readouterr().err
    assert command("audit", "--from", "2026-11-20", "--to", "2026-11-20") == 0


def test_the_schedule_of_the_station_is_told_and_changed(
    command: Command,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    paths = UserPaths(tmp_path / "config" / "settings.json", tmp_path / "data" / "autosave")
    monkeypatch.setattr(UserPaths, "of_user", lambda: paths)
    assert command("schedule") == 0
    assert "day\tnever" in capsys.readouterr().out
    assert not paths.settings_file.exists()
    plan = ("--folder", str(tmp_path), "--day", "friday", "--hour", "18", "--keep", "year")
    assert command("schedule", *plan) == 0
    assert "day\tfriday\nhour\t18\nkeep\tyear" in capsys.readouterr().out
    settings = load_settings(paths.settings_file)
    assert (settings.backup_folder, settings.backup_day) == (str(tmp_path), "4")
    assert command("schedule", "--hour", "24") == 2
    assert command("schedule", "--folder", str(tmp_path / "none" / "x")) == 2
    assert "where no folder is; connect its disk" in capsys.readouterr().err
    assert load_settings(paths.settings_file).backup_folder == str(tmp_path)
