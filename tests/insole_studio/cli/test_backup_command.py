"""Backing up, restoring and verifying the record on the command line."""

from __future__ import annotations

import io
import json
from collections.abc import Callable
from datetime import date
from pathlib import Path

import pyrage
import pytest

from insole_core.cases.case_record import FootRecord
from insole_core.cases.scan_source import ScanSource
from insole_core.foot.foot import Foot
from insole_core.geometry.side import Side
from insole_core.records.author import Author
from insole_core.records.person import Person
from insole_core.records.place import RecordsPlace
from insole_core.records.records import open_records
from insole_core.records.visit import Visit
from insole_studio.cli.main import run
from insole_studio.user_paths import UserPaths

ANNA = Author("anna", "desk")
IDENTITY = pyrage.x25519.Identity.generate()


@pytest.fixture
def paths(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> UserPaths:
    paths = UserPaths(tmp_path / "config" / "settings.json", tmp_path / "data" / "autosave")
    monkeypatch.setattr(UserPaths, "of_user", lambda: paths)
    return paths


@pytest.fixture
def record(paths: UserPaths) -> Path:
    """The user's own record, with a person and a file, and the user's settings."""
    records = open_records(RecordsPlace.local(paths.records_folder), ANNA)
    records.persons.add(Person("Anna Berg"))
    records.contents.put(b"solid left foot")
    records.close()
    paths.settings_folder.mkdir()
    paths.settings_file.write_text("{}")
    return paths.records_folder


@pytest.fixture
def key(tmp_path: Path) -> Path:
    path = tmp_path / "key.txt"
    path.write_text(f"# created by age-keygen\n{IDENTITY}\n")
    return path


def back_up(folder: Path, *more: str) -> int:
    return run(["records", "backup", str(folder), "--recipient", str(IDENTITY.to_public()), *more])


@pytest.mark.parametrize("part", [".", "sub", "sub/below"])
def test_backups_do_not_lie_in_the_record(
    part: str, record: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert back_up(record / part) == 2
    assert "the folder of the record; name another folder" in capsys.readouterr().err
    assert not (record / "sub").exists()
    backups = tmp_path / "bk"
    assert back_up(backups) == 0
    before = names_in(backups)
    words = ["records", "restore", str(backups), "--record", str(backups)]
    assert run(words) == 2
    assert "the folder of the record; name another folder" in capsys.readouterr().err
    assert names_in(backups) == before


def names_in(folder: Path) -> list[str]:
    records = open_records(RecordsPlace.local(folder), ANNA)
    names = [person.name for person in records.persons.recent()]
    records.close()
    return names


def test_a_record_is_backed_up_verified_and_restored(
    record: Path, key: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    folder, new = tmp_path / "backups", tmp_path / "new"
    assert back_up(folder) == 0
    assert "snapshot 1" in capsys.readouterr().out
    assert back_up(folder) == 0
    assert "0.0 MB were new" in capsys.readouterr().out
    secret = ["--private-key", str(key)]
    assert run(["records", "verify", "--backup", str(folder), *secret]) == 0
    assert "backup 2" in capsys.readouterr().out
    assert run(["records", "restore", str(folder), *secret, "--record", str(new)]) == 0
    assert "0 settings were there and stay" in capsys.readouterr().out
    assert names_in(new) == ["Anna Berg"]
    assert run(["records", "verify", "--record", str(new)]) == 0
    (new / "contents" / "audit-head").unlink()
    assert run(["records", "verify", "--record", str(new)]) == 1
    assert "not noted beside the files" in capsys.readouterr().err.splitlines()[-1]


def test_a_record_that_is_there_is_set_aside_only_on_request(
    record: Path, key: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    folder = tmp_path / "backups"
    assert back_up(folder) == 0
    restore = ["records", "restore", str(folder), "--private-key", str(key)]
    assert run(restore) == 1
    assert "as the backup has it: nothing was changed since" in capsys.readouterr().err
    assert run([*restore, "--set-aside", "--snapshot", "1"]) == 0
    assert "the record before is kept as" in capsys.readouterr().out
    assert len(list(record.glob("records until *.sqlite3"))) == 1
    assert names_in(record) == ["Anna Berg"]


def test_what_is_wrong_is_the_last_line_and_the_exit_code(
    record: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(["records", "verify"]) == 0
    file = next(path for path in (record / "contents").rglob("*") if len(path.name) == 64)
    file.write_bytes(b"changed on the disk")
    assert run(["records", "verify"]) == 1
    assert "One file was changed since" in capsys.readouterr().err.splitlines()[-1]


@pytest.mark.parametrize(
    "command", [["list"], ["verify"], ["backup", "b", "--recipient", str(IDENTITY.to_public())]]
)
def test_a_database_cut_to_nothing_is_refused_as_a_damaged_one(
    record: Path, command: list[str], tmp_path: Path, capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:  # fmt: skip
    monkeypatch.chdir(tmp_path)
    (record / "records.sqlite3").write_bytes(b"")
    assert run(["records", *command]) == 1
    assert "is damaged; restore the record" in capsys.readouterr().err.splitlines()[-1]
    assert (record / "records.sqlite3").read_bytes() == b""


@pytest.mark.parametrize(
    ("arguments", "sentence", "code"),
    [
        (["verify", "--record", "nowhere"], "does not exist", 2),
        (["verify", "--contents", "x"], "--contents belongs to --database", 2),
        (["verify", "--database", "postgresql://x/y"], "needs --contents", 2),
        (["verify", "--database", "mysql://x/y", "--contents", "x"], "of the kind mysql", 1),
        (["verify", "--account", "eva"], "has no accounts", 1),
        (["restore", "nowhere", "--private-key", "KEY"], "holds no backup", 1),
        (["restore", "nowhere", "--private-key", "nowhere"], "cannot be read", 1),
        (["restore", "nowhere"], "Nobody can be asked", 2),
        (["backup", "b", "--recipient", "age1x"], "public key of age", 1),
        (["backup", "b"], "Nobody can be asked", 2),
    ],
)
def test_what_is_wrong_with_the_arguments_is_told(
    record: Path,
    key: Path,
    arguments: list[str],
    sentence: str,
    code: int,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.chdir(key.parent)
    monkeypatch.setattr("sys.stdin", io.StringIO())
    given = [str(key) if argument == "KEY" else argument for argument in arguments]
    assert run(["records", *given]) == code
    assert sentence in capsys.readouterr().err.splitlines()[-1]


def test_the_statement_of_an_order_is_asked_for_by_its_number(
    record: Path,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
    make_foot: Callable[[Side], Foot],
) -> None:
    records = open_records(RecordsPlace.local(record), ANNA)
    person = records.persons.recent()[0]
    visit = records.visits.add(Visit(person.id, date.today()))
    foot = FootRecord.begun(make_foot(Side.LEFT), ScanSource("mesh", "left.stl", "a" * 64))
    version_id = records.prescriptions.save(visit.id, foot, None).version_id
    order = records.orders.add(visit.id, [version_id])
    out = str(tmp_path / "statement.pdf")
    command = ["records", "statement", order.number, "--out", out, "--json"]
    maker = ["--maker", "Fotkliniken", "--maker-address", "Storgatan 1"]
    assert run([*command, *maker]) == 1
    assert "left foot is not signed" in capsys.readouterr().err
    records.prescriptions.sign(version_id)
    records.close()
    assert run(command) == 1
    assert "the maker" in capsys.readouterr().err
    assert run([*command, *maker]) == 0
    stated = json.loads(capsys.readouterr().out)
    assert stated["identification"]["pseudonym"] == order.number
    assert stated["feet"][0]["provenance"]["signed by"].startswith("anna, ")
    assert Path(out).read_bytes().startswith(b"%PDF")
    assert run(["records", "statement", order.number]) == 1
    assert run(["records", "statement", "26-NONE", "--json"]) == 1
    assert "no order 26-NONE" in capsys.readouterr().err


@pytest.mark.slow
def test_a_passphrase_comes_from_a_file(
    record: Path, tmp_path: Path, quick_passphrases: None
) -> None:
    file = tmp_path / "passphrase.txt"
    file.write_text("blå sko på grön äng\n", "utf-8")
    folder, secret = str(tmp_path / "backups"), ["--passphrase-file", str(file)]
    assert run(["records", "backup", folder, *secret]) == 0
    assert run(["records", "backup", folder, *secret]) == 0
    assert run(["records", "restore", folder, *secret, "--record", str(tmp_path / "new")]) == 0
    assert names_in(tmp_path / "new") == ["Anna Berg"]


@pytest.mark.parametrize(
    ("given", "sentence", "code"),
    [
        (["--passphrase-file", "other.txt"], "--passphrase-file does not give that; leave it", 2),
        (["--passphrase-file", "missing.txt"], "missing.txt cannot be read", 1),
        (["--recipient", "nonsense"], "public key of age", 1),
        (["--recipient", str(IDENTITY.to_public())], "--recipient does not give that; leave it", 2),
    ],
)
def test_what_does_not_open_the_backups_of_a_record_is_refused(
    record: Path,
    quick_passphrases: None,
    given: list[str],
    sentence: str,
    code: int,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    """Into another folder as well: whoever keeps the other passphrase could not restore."""
    monkeypatch.chdir(tmp_path)
    for name, phrase in (("first.txt", "blå sko på grön äng"), ("other.txt", "four other words")):
        Path(name).write_text(phrase, "utf-8")
    assert run(["records", "backup", "one", "--passphrase-file", "first.txt"]) == 0
    assert run(["records", "backup", "two", *given]) == code
    assert sentence in capsys.readouterr().err.splitlines()[-1]
    assert not Path("two").exists()


def test_another_recipient_than_that_of_the_backups_is_refused(
    record: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert back_up(tmp_path / "one") == 0
    other = str(pyrage.x25519.Identity.generate().to_public())
    assert run(["records", "backup", str(tmp_path / "two"), "--recipient", other]) == 2
    assert "opened by the private key that was chosen" in capsys.readouterr().err
    assert not (tmp_path / "two").exists()


@pytest.mark.parametrize(
    ("command", "other"), [("backup", "--recipient"), ("restore", "--private-key")]
)
def test_a_backup_is_opened_by_one_thing(
    command: str, other: str, capsys: pytest.CaptureFixture[str]
) -> None:
    with pytest.raises(SystemExit):
        run(["records", command, "b", "--passphrase-file", "p", other, "k"])
    assert "not allowed with argument" in capsys.readouterr().err
