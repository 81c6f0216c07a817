"""Backups that somebody has damaged, mixed up, or forged with their key are refused in words."""

from __future__ import annotations

import json
import os
import shutil
import zlib
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pyrage
import pytest
from backed_up_record import ANNA, IDENTITY, RECIPIENT, SECRET, make_record

from insole_core.errors import InsoleError, RecordsError
from insole_core.records.backup.back_up import back_up, key_of_backups, set_up_backups
from insole_core.records.backup.backup_folder import (
    LISTS,
    OBJECTS,
    SNAPSHOTS,
    BackupFolder,
    BackupReader,
    sealed,
)
from insole_core.records.backup.backup_key import BackupKey, DamagedBackup, authenticate, open_key
from insole_core.records.backup.restore import restore
from insole_core.records.backup.snapshot import check_backup, damaged_files, open_snapshot
from insole_core.records.context import RecordsContext
from insole_core.records.place import RecordsPlace

PLACES: dict[str, Callable[[Path], object]] = {
    "folder": lambda path: path.mkdir(),
    "pipe": os.mkfifo,
    "link to itself": lambda path: path.symlink_to(path.name),
    "link to zeros": lambda path: path.symlink_to("/dev/zero"),
}


@pytest.fixture(scope="module")
def sound(
    migrated_file: Path, tmp_path_factory: pytest.TempPathFactory
) -> tuple[RecordsContext, Path]:
    """A record, and a folder with one backup of it."""
    folder = tmp_path_factory.mktemp("sound")
    context = make_record(migrated_file, folder / "record")
    set_up_backups(context, BackupKey.for_recipients([RECIPIENT]))
    config = folder / "config"
    config.mkdir()
    (config / "settings.json").write_text("{}")
    back_up(context, folder / "backups", {"settings": config})
    return context, folder / "backups"


@pytest.fixture
def backups(sound: tuple[RecordsContext, Path], tmp_path: Path) -> Path:
    return Path(shutil.copytree(sound[1], tmp_path / "backups"))


def forge(backups: Path, change: Callable[[dict[str, Any]], object]) -> None:
    """Change the manifest of the newest snapshot, as only whoever has its key can."""
    folder = BackupFolder(backups)
    key = open_key(folder.head().locked, SECRET)
    newest = folder.snapshots()[-1]
    manifest = json.loads(BackupReader(folder, key).manifest(newest))
    change(manifest)
    content = zlib.compress(json.dumps(manifest).encode())
    signed = authenticate(key.mac_key, content).encode() + content
    recipient = pyrage.x25519.Recipient.from_str(folder.head().recipient)
    (backups / SNAPSHOTS / newest.file_name).write_bytes(pyrage.encrypt(signed, [recipient]))


@pytest.mark.parametrize("what", PLACES)
@pytest.mark.parametrize("part", [OBJECTS, SNAPSHOTS, LISTS, "one object"])
def test_what_is_no_file_in_a_backup_is_damage_and_no_hang(
    backups: Path, sound: tuple[RecordsContext, Path], part: str, what: str
) -> None:
    path = next((backups / OBJECTS).rglob("*.age")) if part == "one object" else backups / part
    if path.is_dir():
        shutil.rmtree(path)
    else:
        path.unlink()
    PLACES[what](path)
    key = key_of_backups(sound[0])
    assert key is not None
    good = [known.is_good for known in BackupFolder(backups).known_snapshots(key)]
    assert good == ([] if part == SNAPSHOTS else [False])
    assert bool(damaged_files(backups)) is (part == "one object")
    assert is_restorable(backups) is (part == LISTS)


def is_restorable(backups: Path) -> bool:
    try:
        return check_backup(backups, SECRET).is_sound
    except InsoleError:
        return False


@pytest.mark.parametrize(
    "name", ["000009-2026-13-45T99-99-99Z.age", "000009-0000-01-01T00-00-00Z.age", "\x1b[2J.age"]
)
def test_a_name_that_is_no_snapshot_is_none(backups: Path, name: str) -> None:
    (backups / SNAPSHOTS / name).write_bytes(b"x")
    assert [snapshot.number for snapshot in BackupFolder(backups).snapshots()] == [1]


@pytest.mark.parametrize(
    "change",
    [
        {"schema": 5},
        {"schema": ""},
        {"schema": "0000"},
        {"schema": "../../etc"},
        {"audit_seq": "1"},
        {"audit_seq": -1},
        {"audit_seq": {}},
        {"contents": True},
        {"damaged": 5},
        {"damaged": ["x"]},
        {"tables": "x"},
        {"tables": [5]},
        {"tables": [{"name": {}, "columns": [], "rows": 0, "pieces": []}]},
        {"tables": [{"name": "persons", "columns": 5, "rows": 0, "pieces": []}]},
        {"tables": [{"name": "persons", "columns": [], "rows": 0, "pieces": ["x"]}]},
        {"files": [{"group": [], "name": "x", "sha256": "a" * 64, "size": 1}]},
        {"files": [{"group": "settings", "name": "\0", "sha256": "a" * 64, "size": 1}]},
        {"files": [{"group": "settings", "name": "\ud800", "sha256": "a" * 64, "size": 1}]},
        {"files": [{"group": "settings", "name": "x", "sha256": "\ud800", "size": 1}]},
        {"made_at": "\x1b[2J"},
    ],
    ids=str,
)
def test_a_forged_snapshot_is_refused_and_leaves_nothing(
    backups: Path, tmp_path: Path, change: dict[str, Any]
) -> None:
    forge(backups, lambda manifest: manifest.update(change))
    place = RecordsPlace.local(tmp_path / "new")
    with pytest.raises(DamagedBackup):
        restore(backups, SECRET, place, ANNA, settings={"settings": tmp_path / "config"})
    assert not list(tmp_path.glob("new/*"))
    assert not (tmp_path / "config").exists()


def test_a_backup_of_an_older_program_is_read_and_an_older_one_refuses_a_new_one_in_words(
    backups: Path,
) -> None:
    """An older one takes a key that it does not know for damage, unless the format is newer."""

    def age(manifest: dict[str, Any]) -> None:
        assert (manifest["format"], manifest.pop("patients")) == (2, 1)
        manifest["format"] = 1

    forge(backups, age)
    assert check_backup(backups, SECRET).is_sound
    assert open_snapshot(backups, SECRET).manifest.patients is None
    forge(backups, lambda manifest: manifest.update(format=3, unknown=5))
    with pytest.raises(RecordsError, match="comes from a newer Insole Studio"):
        check_backup(backups, SECRET)


@pytest.mark.parametrize("name", ["../x", "/x", "..", "", ".", "a/../../x", "x" * 300, "é" * 120])
def test_no_file_of_the_settings_leads_out_of_their_folder(
    backups: Path, tmp_path: Path, name: str
) -> None:
    forge(backups, lambda manifest: manifest["files"][0].update(name=name))
    with pytest.raises(DamagedBackup):
        restore(
            backups,
            SECRET,
            RecordsPlace.local(tmp_path / "new"),
            ANNA,
            settings={"settings": tmp_path / "config"},
        )
    assert not list(tmp_path.glob("new/*"))
    assert not (tmp_path / "config").exists()


@pytest.mark.parametrize(
    "content",
    [b"[" * 100_000, b'{"format": 1, "damaged": -Infinity, "objects": []}', b"5", b"\xff", b"{}"],
    ids=lambda content: repr(content[:20]),
)
def test_a_list_that_cannot_be_read_makes_no_good_backup(
    backups: Path, sound: tuple[RecordsContext, Path], content: bytes
) -> None:
    key = key_of_backups(sound[0])
    assert key is not None
    folder = BackupFolder(backups)
    (backups / LISTS / folder.snapshots()[-1].list_name).write_bytes(sealed(content, key.mac_key))
    assert [known.is_good for known in folder.known_snapshots(key)] == [False]


@pytest.mark.parametrize("raw", [b"no zlib" * 20, zlib.compress(b"x" * 99)[:-9]])
def test_what_is_signed_and_not_compressed_is_damage(
    backups: Path, sound: tuple[RecordsContext, Path], raw: bytes
) -> None:
    key = key_of_backups(sound[0])
    assert key is not None
    folder = BackupFolder(backups)
    newest = folder.snapshots()[-1]
    signed = authenticate(key.mac_key, raw).encode() + raw
    (backups / LISTS / newest.list_name).write_bytes(signed)
    assert [known.is_good for known in folder.known_snapshots(key)] == [False]
    recipient = IDENTITY.to_public()
    head = pyrage.x25519.Recipient.from_str(folder.head().recipient)
    (backups / SNAPSHOTS / newest.file_name).write_bytes(pyrage.encrypt(signed, [head, recipient]))
    with pytest.raises(DamagedBackup):
        check_backup(backups, SECRET)
