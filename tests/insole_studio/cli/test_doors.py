"""Every way to the record is known, and none opens without a proof of who comes."""

from __future__ import annotations

import argparse
import io
import re
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import pyrage
import pytest
from stations import FIRST, add_member, proven

from insole_core.records.accounts import FREE_FAILURES
from insole_core.records.audit import SIGNED_IN_BY
from insole_core.records.author import Author, Role, system_user
from insole_core.records.backup.back_up import set_up_backups
from insole_core.records.backup.backup_key import BackupKey
from insole_core.records.person import Person
from insole_core.records.place import RecordsPlace
from insole_core.records.records import Records, open_records
from insole_studio.cli.main import command_parser, run

ROOT = Path(__file__).parents[3]
APP = ROOT / "app"
DECISION = ROOT / "docs" / "decisions" / "0045-accounts-audit-signatures.md"
ROW = re.compile(r"^\| `(?P<door>[^`]+)` \| (?P<who>[^|]+) \| (?P<proof>[^|]+) \|$", re.MULTILINE)
DOORS = {row["door"]: row for row in ROW.finditer(DECISION.read_text("utf-8"))}
OPENS = re.compile(
    r"(?<![.\w])(?<!def )"
    r"(?:open_records|Database|check_place|look_at_place|restore|sqlite3\.connect)\("
)
"""What opens a record: its database, or one that is restored."""
PASSWORD = "four words in a row"
NEEDED = {
    "list": ["Anna"],
    "show": ["A-1"],
    "import": ["table.csv"],
    "export": ["A-1", "--out", "out"],
    "statement": ["26-7KQ4M", "--json"],
    "backup": ["backups"],
    "verify": [],
    "undo-upgrade": [],
    "accounts": ["list"],
    "audit": [],
    "erase": ["A-1"],
    "retention": [],
    "schedule": [],
    "restore": ["backups", "--set-aside", "--private-key", "key"],
}
"""What each command is given; what is wrong with it is told only to whoever may."""
OPEN_TO_ALL = {"migrate", "password"}
"""The one shows nothing, and the other asks for the present password."""


@pytest.fixture
def records(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Records]:
    """A record with a person, a key of backups and an account of each role, named after it."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "table.csv").write_text("name;birth date\nBen Ek;1970-03-02\n")
    (tmp_path / "key").write_text("AGE-SECRET-KEY-1")
    opened = open_records(RecordsPlace.local(tmp_path / "record"), Author.of_user())
    opened.persons.add(Person("Anna Berg", pseudonym="A-1"))
    opened.accounts.switch_on("administrator", "Rut Root", PASSWORD)
    root = opened.for_author(proven("administrator"))
    for role in Role:
        if role is not Role.ADMINISTRATOR:
            add_member(root.accounts, role.replace(" ", "-"), "Eva Ek", role, PASSWORD)
    recipient = str(pyrage.x25519.Identity.generate().to_public())
    set_up_backups(root.context, BackupKey.for_recipients([recipient]))
    yield root
    opened.close()


def command(name: str) -> list[str]:
    return ["records", name, *NEEDED[name], "--record", "record"]


def signed_in(role: str, name: str, monkeypatch: pytest.MonkeyPatch) -> int:
    monkeypatch.setattr("sys.stdin", io.StringIO(f"{PASSWORD}\n"))
    return run([*command(name), "--account", role.replace(" ", "-")])


def test_every_module_that_opens_a_record_is_a_door() -> None:
    found = {
        path.relative_to(APP).as_posix()
        for path in APP.rglob("*.py")
        if OPENS.search(path.read_text("utf-8"))
    }
    assert found == {door for door in DOORS if door.endswith(".py")}


def test_every_command_of_the_record_is_a_door() -> None:
    assert {f"records {step}" for step in steps()} == {
        door for door in DOORS if not door.endswith(".py")
    }
    assert set(steps()) == {*NEEDED, *OPEN_TO_ALL}


def steps() -> list[str]:
    return list(_subcommands(_subcommands(command_parser())["records"]))


def _subcommands(parser: argparse.ArgumentParser) -> dict[str, argparse.ArgumentParser]:
    (action,) = [a for a in parser._actions if isinstance(a, argparse._SubParsersAction)]
    return dict(action.choices)


@pytest.mark.parametrize("name", NEEDED)
def test_a_name_in_the_environment_is_nobody(
    name: str, records: Records, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    before = records.audit.head()
    for variable in ("LOGNAME", "USER", "LNAME", "USERNAME"):
        monkeypatch.setenv(variable, "orthopedist")
    assert run(command(name)) == 1
    told = capsys.readouterr()
    assert "you are not signed in" in told.err.splitlines()[-1]
    assert "Anna" not in told.out + told.err
    assert records.audit.head() == before
    assert not Path("out").exists()


@pytest.mark.parametrize("name", NEEDED)
def test_a_command_is_for_those_whom_the_table_names(
    name: str, records: Records, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """Whoever may do it comes as far as what is wrong with what the command was given."""
    for role in Role:
        signed_in(role, name, monkeypatch)
        is_refused = "may not" in capsys.readouterr().err
        assert is_refused is (role not in DOORS[f"records {name}"]["who"]), role


def test_wrong_passwords_lock_the_account_on_the_command_line_too(
    records: Records, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    for _ in range(FREE_FAILURES):
        monkeypatch.setattr("sys.stdin", io.StringIO("a wrong password\n"))
        assert run([*command("list"), "--account", "orthopedist"]) == 1
        assert "password is wrong" in capsys.readouterr().err
    assert signed_in("orthopedist", "list", monkeypatch) == 1
    assert "Too many wrong passwords" in capsys.readouterr().err


def test_the_log_says_how_somebody_has_signed_in(
    records: Records, monkeypatch: pytest.MonkeyPatch
) -> None:
    assert signed_in("orthopedist", "show", monkeypatch) == 0
    lines = records.audit.lines(author="orthopedist")
    assert {line.action for line in lines} == {"signed in", "changed password", "seen"}
    assert all(f'"{SIGNED_IN_BY}":"password"' in line.details for line in lines)


def test_a_first_password_is_changed_on_the_command_line(
    records: Records, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    records.accounts.add("tom", "Tom Tall", Role.TECHNICIAN, FIRST)
    tom = [*command("list"), "--account", "tom"]
    for typed, code in (
        ([FIRST], 2),
        ([FIRST, FIRST], 1),
        ([FIRST, PASSWORD], 0),
        ([PASSWORD], 0),
    ):
        monkeypatch.setattr("sys.stdin", io.StringIO("\n".join([*typed, ""])))
        assert run(tom) == code
        assert ("Anna" in capsys.readouterr().out) is (code == 0)


def test_an_account_of_a_user_of_the_system_needs_no_password(
    records: Records, capsys: pytest.CaptureFixture[str]
) -> None:
    for account in records.accounts.all():
        if account.name == "backup-service":
            records.accounts.change(replace(account, system_user=system_user()))
    assert run(command("verify")) == 0
    assert run(command("list")) == 1
    assert "backup-service (backup service) may not see patients" in capsys.readouterr().err


def test_a_password_is_read_from_a_private_file_or_a_descriptor(
    records: Records, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "password"
    file.write_text(f"{PASSWORD}\n")
    file.chmod(0o644)
    by_file = [*command("list"), "--account", "orthopedist", "--password-file", str(file)]
    assert run(by_file) == 1
    assert "others may read it" in capsys.readouterr().err
    file.chmod(0o600)
    assert run(by_file) == 0
    with file.open() as opened:
        by_descriptor = ["--password-fd", str(opened.fileno())]
        assert run([*command("list"), "--account", "orthopedist", *by_descriptor]) == 0
    assert run([*command("list"), "--account", "orthopedist", "--password-fd", "999"]) == 2
    assert "Anna Berg" in capsys.readouterr().out
