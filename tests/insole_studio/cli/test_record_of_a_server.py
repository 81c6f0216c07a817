"""Commands, backups and the doctor work on the record of the window, also if it is on a server."""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path

import pyrage
import pytest
from postgres_server import PostgresServer
from PySide6.QtWidgets import QApplication
from sqlalchemy import update
from stations import proven

from insole_core.records.author import Author, Role
from insole_core.records.database import SCHEMA_TABLE
from insole_core.records.person import Person
from insole_core.records.place import RecordsPlace
from insole_core.records.records import Records, open_records
from insole_core.records.schema import audit, contents
from insole_studio.app.doctor import Diagnosis, Doctor
from insole_studio.cli.main import run
from insole_studio.document.record_location import location_of_window
from insole_studio.settings import peek_settings
from insole_studio.user_paths import UserPaths

IDENTITY = pyrage.x25519.Identity.generate()
PASSWORD = "four words in a row"


@dataclass(frozen=True)
class Station:
    """A computer whose window opens the record of a server."""

    paths: UserPaths
    url: str
    share: Path

    def records(self) -> Records:
        return open_records(RecordsPlace.of_url(self.url, self.share), Author("eva", "desk"))

    def name_record(self, url: str) -> None:
        self.paths.settings_folder.mkdir(parents=True, exist_ok=True)
        values = {"record_database": url, "record_contents": str(self.share), "clinic": "Foot"}
        self.paths.settings_file.write_text(json.dumps(values))


@pytest.fixture
def station(tmp_path: Path, postgres_url: str, monkeypatch: pytest.MonkeyPatch) -> Station:
    """A station with one patient in the record of the server, and none in that of the computer."""
    paths = use(tmp_path / "station", monkeypatch)
    share = tmp_path / "share"
    share.mkdir()
    station = Station(paths, postgres_url, share)
    station.name_record(postgres_url)
    records = station.records()
    records.persons.add(Person("Anna Berg", pseudonym="A-1"))
    records.close()
    open_records(RecordsPlace.local(paths.records_folder), Author("eva", "desk")).close()
    return station


@pytest.fixture
def key(tmp_path: Path) -> str:
    path = tmp_path / "key.txt"
    path.write_text(str(IDENTITY))
    return str(path)


def use(folder: Path, monkeypatch: pytest.MonkeyPatch) -> UserPaths:
    """Let commands be run on a computer whose files are in a folder."""
    paths = UserPaths(folder / "config" / "settings.json", folder / "data" / "autosave")
    monkeypatch.setattr(UserPaths, "of_user", lambda: paths)
    return paths


def back_up(folder: Path, *more: str) -> int:
    return run(["records", "backup", str(folder), "--recipient", str(IDENTITY.to_public()), *more])


def of_record(paths: UserPaths) -> list[Diagnosis]:
    found = Doctor(paths, None, lambda: ()).examine()
    return [diagnosis for diagnosis in found if diagnosis.topic == "Record"]


def test_commands_and_backups_are_of_the_record_that_the_window_opens(
    station: Station, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(["records", "list"]) == 0
    assert "Anna Berg" in capsys.readouterr().out
    assert run(["records", "verify"]) == 0
    assert run(["records", "migrate"]) == 0
    assert "localhost/records has schema" in capsys.readouterr().err
    assert back_up(tmp_path / "backups") == 0
    assert "snapshot 1 of localhost/records: 1 patient, 0 visits" in capsys.readouterr().out


def test_a_backup_without_patients_fails_while_the_window_has_some(
    station: Station, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    local, folder = str(station.paths.records_folder), tmp_path / "backups"
    assert back_up(folder, "--record", local) == 1
    assert "holds no patient, but localhost/records" in capsys.readouterr().err.splitlines()[-1]
    assert not folder.exists()
    station.name_record("postgresql://me@localhost:1/gone")
    assert back_up(folder, "--record", local) == 1
    assert "localhost/gone does not answer" in capsys.readouterr().err.splitlines()[-1]
    assert not folder.exists()
    station.name_record("")
    assert back_up(folder, "--record", local) == 0
    assert "0 patients" in capsys.readouterr().out


@pytest.mark.parametrize(
    "settings", ['{"record_database": 7}', '{"record_contents": ["x"]}', "{", "[]", "\0"]
)
@pytest.mark.parametrize("command", [["list"], ["verify"], ["migrate"], ["backup", "backups"]])
def test_settings_that_do_not_tell_the_record_name_no_other(
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    settings: str,
    command: list[str],
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.chdir(tmp_path)
    paths = use(tmp_path / "station", monkeypatch)
    paths.settings_folder.mkdir(parents=True)
    paths.settings_file.write_text(settings)
    assert run(["records", *command]) == 1
    assert "not known where the record is" in capsys.readouterr().err.splitlines()[-1]
    assert paths.settings_file.read_text() == settings
    assert not paths.records_folder.exists()


def test_scheduled_backups_are_made_by_an_account_that_may_do_nothing_else(
    station: Station, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    folder = tmp_path / "backups"
    assert back_up(folder) == 0
    records = station.records()
    records.accounts.switch_on("root", "Rut Root", PASSWORD)
    root = records.for_author(proven("root", Role.ADMINISTRATOR))
    root.accounts.add("night", "Nightly backup", Role.BACKUP_SERVICE, PASSWORD)
    records.close()
    password = tmp_path / "night"
    password.write_text(f"{PASSWORD}\n")
    password.chmod(0o600)
    account = ["--account", "night", "--password-file", str(password)]
    capsys.readouterr()
    assert run(["records", "backup", str(folder), *account]) == 0
    assert "snapshot 2 of localhost/records: 1 patient, " in capsys.readouterr().out
    for command in (["list"], ["show", "A-1"], ["export", "A-1", "--out", str(tmp_path / "out")]):
        assert run(["records", *command, *account]) == 1
        told = capsys.readouterr()
        assert "night (backup service) may not" in told.err
        assert "Anna" not in told.out + told.err
    assert of_record(station.paths)[-1].advice == ""


def test_the_backup_of_a_server_is_in_front_on_another_computer(
    station: Station,
    tmp_path: Path,
    key: str,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    folder = tmp_path / "backups"
    assert back_up(folder) == 0
    new = use(tmp_path / "new", monkeypatch)
    restore = ["records", "restore", str(folder), "--private-key", key]
    assert run([*restore, "--record", str(tmp_path / "trial")]) == 0
    assert "the window opens its own record as before" in capsys.readouterr().out
    assert not new.settings_file.exists()
    assert run(restore) == 0
    assert f"the window opens {new.records_folder}" in capsys.readouterr().out
    settings = peek_settings(new.settings_file)
    assert (settings.record_database, settings.record_contents) == ("", "")
    assert settings.clinic == "Foot"
    records = open_records(location_of_window(new).place(), Author("eva", "desk"))
    assert [person.name for person in records.persons.recent()] == ["Anna Berg"]
    records.close()


@pytest.mark.parametrize(
    ("present", "is_in_front"),
    [("", True), ("postgresql://me@localhost:1/gone", True), ("the old one", False)],
)
def test_a_record_that_is_restored_to_a_server_is_in_front_unless_patients_are_elsewhere(
    station: Station,
    postgres: PostgresServer,
    tmp_path: Path,
    key: str,
    capsys: pytest.CaptureFixture[str],
    *,
    present: str,
    is_in_front: bool,
) -> None:
    folder = tmp_path / "backups"
    assert back_up(folder) == 0
    postgres.execute("CREATE DATABASE other")
    try:
        station.name_record(station.url if present == "the old one" else present)
        other = postgres.url("other").replace("@", ":secret@")
        server = ["--database", other, "--contents", str(tmp_path / "share2")]
        assert run(["records", "restore", str(folder), "--private-key", key, *server]) == 0
        told = "the window opens localhost/other" if is_in_front else "the window still opens"
        assert told in capsys.readouterr().out
        opened = location_of_window(station.paths).place()
        assert (opened.url.database == "other") is is_in_front
        assert "secret" not in station.paths.settings_file.read_text()
        assert peek_settings(station.paths.settings_file).clinic == "Foot"
    finally:
        postgres.execute("DROP DATABASE other WITH (FORCE)")


def test_the_doctor_tells_monitoring_of_the_record_of_a_server(
    station: Station,
    tmp_path: Path,
    qapp: QApplication,
    capsys: pytest.CaptureFixture[str],
) -> None:
    assert run(["doctor"]) == 1
    told = capsys.readouterr()
    assert "Record: on the server localhost/records, which answers" in told.out
    assert "! Record: no good backup" in told.out
    assert "record or its backups need attention" in told.err.splitlines()[-1]
    assert "Anna" not in told.out
    assert back_up(tmp_path / "backups") == 0
    assert run(["doctor"]) == 0
    assert "  Record: last good backup 0.0 days old" in capsys.readouterr().out
    records = station.records()
    with records.context.database.writing() as connection:
        lost = {"sha256": "a" * 64, "size": 5, "kind": "mesh", "created_at": "2026-11-26T00:00:00Z"}
        connection.execute(contents.insert().values(lost))
    assert back_up(tmp_path / "backups") == 0
    with records.context.database.engine.begin() as connection:
        connection.exec_driver_sql("SET session_replication_role = replica")
        old = {"at": "2026-01-01T00:00:00.000000Z"}
        connection.execute(
            update(audit).where(audit.c.details.not_like('%"damaged":1%')).values(old)
        )
    [_, backup] = of_record(station.paths)
    assert "Make a backup" in backup.advice
    assert "days old" in backup.state
    with records.context.database.engine.begin() as connection:
        connection.execute(update(SCHEMA_TABLE).values(version_num="9999"))
    records.close()
    [newer] = of_record(station.paths)
    assert "newer Insole Studio" in newer.advice
    station.name_record("postgresql://me@localhost:1/gone")
    [gone] = of_record(station.paths)
    assert "does not answer" in gone.advice
    station.name_record("postgresql://me@localhost/x?host=elsewhere")
    [refused] = of_record(station.paths)
    assert "more than once" in refused.advice


def test_the_doctor_believes_the_folder_of_the_backups(station: Station, tmp_path: Path) -> None:
    folder = tmp_path / "backups"
    assert back_up(folder) == 0
    values = json.loads(station.paths.settings_file.read_text())
    station.paths.settings_file.write_text(json.dumps(values | {"backup_folder": str(folder)}))
    assert of_record(station.paths)[-1].advice == ""
    next((folder / "objects").rglob("*.age")).unlink()
    assert of_record(station.paths)[-1].state == "no good backup"
    folder.rename(tmp_path / "unplugged")
    assert "holds no backup" in of_record(station.paths)[-1].advice
