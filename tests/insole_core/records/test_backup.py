"""A backup holds all, grows by what is new, tells any damage, and has been restored."""

from __future__ import annotations

import base64
import errno
import json
import os
import shutil
import sqlite3
import stat
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from contextlib import closing
from datetime import UTC, datetime, timedelta
from multiprocessing import get_context
from pathlib import Path
from typing import Any

import pyrage
import pytest
from backed_up_record import (
    ANNA,
    IDENTITY,
    MESH,
    RECIPIENT,
    SECRET,
    SESSION,
    STRANGE,
    add_person,
    all_rows,
    context_of,
    make_record,
)
from record_samples import place_of_sample
from sqlalchemy import insert, text
from stations import proven

from insole_core.errors import InputError, NotAllowed, OutputError, RecordsError
from insole_core.progress import Cancelled, Progress
from insole_core.records import schema
from insole_core.records.accounts import Accounts
from insole_core.records.audit import AuditLog
from insole_core.records.author import Role
from insole_core.records.backup import backup_folder
from insole_core.records.backup import restore as restoring
from insole_core.records.backup.back_up import BackupReport, BackupSchedule, back_up, set_up_backups
from insole_core.records.backup.backup_folder import (
    HEAD_FILE,
    UNFINISHED,
    BackupFolder,
    BackupWriter,
)
from insole_core.records.backup.backup_key import BackupKey, DamagedBackup, WrongSecret, open_key
from insole_core.records.backup.restore import PlaceTaken, RestoreReport, restore
from insole_core.records.backup.snapshot import check_backup, damaged_files, open_snapshot
from insole_core.records.content_store import ContentStore
from insole_core.records.context import RecordsContext
from insole_core.records.database import Database
from insole_core.records.migrate import SCHEMA
from insole_core.records.place import RecordsPlace
from insole_core.records.records import Records
from insole_core.records.signing import SignatureReport, verify_signatures

NOT_COMPARED = {"audit", "audit_head", "clinic"}
"""Restoring writes a line about it, and the name of the store."""


@pytest.fixture(scope="module")
def filled(migrated_file: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder of a record that nobody has open."""
    folder = tmp_path_factory.mktemp("filled") / "record"
    context = make_record(migrated_file, folder)
    set_up_backups(context, BackupKey.for_recipients([RECIPIENT]))
    context.database.close()
    return folder


@pytest.fixture
def context(filled: Path, tmp_path: Path) -> Iterator[RecordsContext]:
    shutil.copytree(filled, tmp_path / "record")
    context = context_of(RecordsPlace.local(tmp_path / "record"))
    yield context
    context.database.close()


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    return tmp_path / "backups"


def files_in(folder: Path) -> dict[str, bytes]:
    return {str(p.relative_to(folder)): p.read_bytes() for p in folder.rglob("*") if p.is_file()}


def restored_at(folder: Path, target: Path, **more: Any) -> tuple[RecordsContext, RestoreReport]:
    place = RecordsPlace.local(target)
    report = restore(folder, SECRET, place, ANNA, **more)
    return context_of(place), report


def test_a_restored_record_equals_the_one_that_was_backed_up(
    context: RecordsContext, folder: Path, tmp_path: Path
) -> None:
    report = back_up(context, folder)
    restored, told = restored_at(folder, tmp_path / "another machine" / "record")
    equal_rows(context, restored)
    assert any(STRANGE in row for row in all_rows(restored)["persons"])
    assert [line.action for line in AuditLog(restored.database, ANNA).lines(limit=1)] == [
        "restored"
    ]
    assert told.audit.is_intact
    assert sorted(restored.contents.digests()) == sorted(context.contents.digests())
    assert {restored.contents.read(name) for name in restored.contents.digests()} == {MESH, SESSION}
    assert (told.contents, told.contents_bytes) == (2, len(MESH) + len(SESSION))
    assert told.rows == report.rows > 10
    for path in (tmp_path / "another machine").rglob("*"):
        assert stat.S_IMODE(path.stat().st_mode) == (0o700 if path.is_dir() else 0o600)
    restored.database.close()


@pytest.mark.parametrize("tables", ["0001", SCHEMA])
def test_persons_of_a_restored_record_are_found(
    tables: str, folder: Path, tmp_path: Path, request: pytest.FixtureRequest
) -> None:
    place = place_of_sample(tables, "sqlite", tmp_path, request)
    older = RecordsContext(Database(place), ContentStore(place.contents), ANNA)
    set_up_backups(older, BackupKey.for_recipients([RECIPIENT]))
    back_up(older, folder)
    older.database.close()
    assert open_snapshot(folder, SECRET).manifest.schema == tables
    restored, told = restored_at(folder, tmp_path / "new")
    assert told.audit.is_intact
    found = Records(restored.database, restored.contents, ANNA).persons.search("berg 1970-02")
    assert [person.name for person in found] == ["Anna Berg"]
    restored.database.close()


def test_a_restored_record_can_be_worked_on_and_backed_up_again(
    context: RecordsContext, folder: Path, tmp_path: Path
) -> None:
    back_up(context, folder)
    restored, _ = restored_at(folder, tmp_path / "new")
    add_person(restored, "new")
    with pytest.raises(RecordsError), restored.database.writing() as connection:
        connection.execute(text("UPDATE prescription_versions SET document = 'x'"))
    report = back_up(restored, folder)
    assert report.snapshot.number == 2
    again, _ = restored_at(folder, tmp_path / "newer")
    assert any("new" in row for row in all_rows(again)["persons"])
    restored.database.close()
    again.database.close()


def test_the_folder_grows_by_what_is_new(context: RecordsContext, folder: Path) -> None:
    first = back_up(context, folder)
    before = files_in(folder)
    assert first.written_bytes > len(MESH) + len(SESSION)
    second = back_up(context, folder)
    after = files_in(folder)
    assert {name: after[name] for name in before} == before
    # The audit log with its head, the snapshot itself and its list; none of the large files.
    assert second.written_bytes < 10_000
    assert len(after) - len(before) == second.written_objects <= 4


def test_a_new_row_of_a_large_table_writes_one_new_piece(
    context: RecordsContext, folder: Path
) -> None:
    rows = [
        {"id": f"p{n}", "name": f"{n}", "pseudonym": f"{n}", "search_text": "", "revision": 1,
         "created_at": f"{n:09}", "changed_at": ""} for n in range(6000)
    ]  # fmt: skip
    with context.database.writing() as connection:
        connection.execute(insert(schema.persons), rows)
    first = back_up(context, folder)
    assert first.written_objects > 15
    with context.database.writing() as connection:
        connection.execute(text("UPDATE persons SET name = 'Eva' WHERE id = 'p77'"))
    second = back_up(context, folder)
    # One piece of persons, the audit log with its head, the snapshot itself and its list.
    assert second.written_objects <= 5


def test_nothing_in_a_backup_can_be_read_without_its_key(
    context: RecordsContext, folder: Path, tmp_path: Path
) -> None:
    (tmp_path / "settings").mkdir()
    (tmp_path / "settings" / "settings.json").write_text('{"clinic": "Fotkliniken"}')
    back_up(context, folder, {"settings": tmp_path / "settings"})
    for name, content in files_in(folder).items():
        for secret in (b"Zo\xc3\xab", b"Fotkliniken", b"solid left", b"anna", b"26-A", b"persons"):
            assert secret not in content, name
        if name != HEAD_FILE and not name.startswith("lists"):
            assert content.startswith(b"age-encryption.org/v1")
        for digest in context.contents.digests():
            assert digest not in name
    for path in [folder, *folder.rglob("*")]:
        assert stat.S_IMODE(path.stat().st_mode) == (0o700 if path.is_dir() else 0o600)


@pytest.mark.slow
def test_a_passphrase_opens_a_backup_and_a_wrong_one_is_told(
    context: RecordsContext, folder: Path, tmp_path: Path
) -> None:
    phrase = "blå sko på grön äng"
    # For a passphrase age takes a gigabyte: of a process that ends, not of one that goes on.
    with ProcessPoolExecutor(1, mp_context=get_context("spawn")) as apart:
        set_up_backups(context, apart.submit(BackupKey.with_passphrase, phrase).result())
        back_up(context, folder)
        assert apart.submit(check_backup, folder, phrase).result().is_sound
        place = RecordsPlace.local(tmp_path / "new")
        with pytest.raises(WrongSecret, match="does not open this backup"):
            apart.submit(restore, folder, phrase + "!", place, ANNA).result()
    assert not (tmp_path / "new").exists()


@pytest.mark.parametrize(
    "secret",
    [str(pyrage.x25519.Identity.generate()), "AGE-SECRET-KEY-1X"],
    ids=["of another", "malformed"],
)
def test_a_wrong_private_key_is_told(context: RecordsContext, folder: Path, secret: str) -> None:
    back_up(context, folder)
    with pytest.raises(WrongSecret, match="does not open this backup"):
        check_backup(folder, secret)


def test_keys_that_will_not_do_are_refused() -> None:
    with pytest.raises(InputError, match="at least 12 characters"):
        BackupKey.with_passphrase("short")
    for recipients in ([], ["age1x"], [RECIPIENT, ""]):
        with pytest.raises(InputError, match="public key of age"):
            BackupKey.for_recipients(recipients)


def test_a_backup_is_set_up_first_and_by_who_may(
    context: RecordsContext, folder: Path, migrated_file: Path, tmp_path: Path
) -> None:
    bare = make_record(migrated_file, tmp_path / "bare")
    with pytest.raises(RecordsError, match="no passphrase yet"):
        back_up(bare, folder)
    bare.database.close()
    Accounts(context.database, ANNA).switch_on("chef", "Carla Chef", "vier Schuhe gehen")
    for work in (lambda: set_up_backups(context, BackupKey.for_recipients([RECIPIENT])),
                 lambda: back_up(context, folder)):  # fmt: skip
        with pytest.raises(NotAllowed, match="not signed in"):
            work()
    chef = proven("chef", Role.ADMINISTRATOR)
    back_up(RecordsContext(context.database, context.contents, chef), folder)


def test_the_folder_of_another_record_is_not_written_to(
    context: RecordsContext, folder: Path
) -> None:
    back_up(context, folder)
    before = files_in(folder)
    set_up_backups(context, BackupKey.for_recipients([RECIPIENT]))  # has another key
    with pytest.raises(RecordsError, match="backups of another record"):
        back_up(context, folder)
    assert files_in(folder) == before


def test_two_backups_at_once_do_not_meet(context: RecordsContext, folder: Path) -> None:
    back_up(context, folder)
    with backup_folder.FileLock(folder / ".lock") as lock:
        assert lock.acquire()
        with pytest.raises(RecordsError, match="Another program is making a backup"):
            back_up(context, folder)


def test_work_goes_on_during_a_backup_which_is_of_one_moment(
    context: RecordsContext, folder: Path, tmp_path: Path
) -> None:
    steps = 0

    def work_on(_fraction: float, _text: str) -> None:
        nonlocal steps
        steps += 1
        add_person(context, f"meanwhile {steps}")

    back_up(context, folder, progress=Progress(work_on))
    assert steps > 5
    restored, told = restored_at(folder, tmp_path / "new")
    assert told.audit.is_intact
    assert len(all_rows(restored)["persons"]) == 2
    restored.database.close()


def objects_of(folder: Path) -> list[Path]:
    return sorted((folder / "objects").rglob("*.age"))


def damage(path: Path, how: str) -> None:
    content = path.read_bytes()
    if how == "truncated":
        path.write_bytes(content[:-1])
    elif how == "empty":
        path.write_bytes(b"")
    elif how == "removed":
        path.unlink()
    else:
        place = len(content) // 2
        path.write_bytes(content[:place] + bytes([content[place] ^ 1]) + content[place + 1 :])


@pytest.mark.parametrize("how", ["truncated", "empty", "removed", "tampered"])
def test_damage_of_any_file_is_found_and_never_restored(
    context: RecordsContext, folder: Path, tmp_path: Path, how: str
) -> None:
    back_up(context, folder)
    largest = max(objects_of(folder), key=lambda path: path.stat().st_size)
    for path in objects_of(folder):
        kept = path.read_bytes()
        damage(path, how)
        report = check_backup(folder, SECRET)
        assert not report.is_sound
        assert len(report.damaged) == 1
        if path == largest:
            place = RecordsPlace.local(tmp_path / "new")
            with pytest.raises(DamagedBackup, match=r"The backup is (damaged|incomplete)"):
                restore(folder, SECRET, place, ANNA)
            assert not place.database_file.exists()
        path.write_bytes(kept)
    assert check_backup(folder, SECRET).is_sound


@pytest.mark.parametrize("how", ["truncated", "empty", "tampered"])
def test_damage_of_a_snapshot_is_told(context: RecordsContext, folder: Path, how: str) -> None:
    back_up(context, folder)
    (snapshot,) = (folder / "snapshots").iterdir()
    damage(snapshot, how)
    with pytest.raises(DamagedBackup, match=r"000001-.*is not what was written"):
        check_backup(folder, SECRET)


@pytest.mark.parametrize(
    "content", [b"", b"{", b"[]", b'{"format": 1}', b'{"format": "x"}', b"\xff" * 100]
)
def test_damage_of_the_head_is_told(context: RecordsContext, folder: Path, content: bytes) -> None:
    back_up(context, folder)
    (folder / HEAD_FILE).write_bytes(content)
    with pytest.raises(DamagedBackup, match=HEAD_FILE):
        check_backup(folder, SECRET)


def test_damaged_files_are_found_without_the_key(context: RecordsContext, folder: Path) -> None:
    back_up(context, folder)
    assert damaged_files(folder) == ()
    damage(objects_of(folder)[0], "tampered")
    damage(objects_of(folder)[1], "truncated")
    assert len(damaged_files(folder)) == 2
    with pytest.raises(InputError, match="holds no backup"):
        damaged_files(folder / "objects")


def test_the_next_backup_writes_what_was_cut_off_again(
    context: RecordsContext, folder: Path
) -> None:
    back_up(context, folder)
    damage(objects_of(folder)[0], "truncated")
    back_up(context, folder)
    assert check_backup(folder, SECRET).is_sound


def test_a_forged_snapshot_is_told(context: RecordsContext, folder: Path) -> None:
    """Whoever has the folder knows the public key, and could encrypt anything to it."""
    back_up(context, folder)
    head = BackupFolder(folder).head()
    recipient = pyrage.x25519.Recipient.from_str(head.recipient)
    forged = pyrage.encrypt(backup_folder.sealed(b"{}", "00" * 32), [recipient])
    (snapshot,) = (folder / "snapshots").iterdir()
    snapshot.write_bytes(forged)
    with pytest.raises(DamagedBackup):
        check_backup(folder, SECRET)


def test_a_forged_object_is_told(context: RecordsContext, folder: Path, tmp_path: Path) -> None:
    back_up(context, folder)
    recipient = pyrage.x25519.Recipient.from_str(BackupFolder(folder).head().recipient)
    path = max(objects_of(folder), key=lambda path: path.stat().st_size)
    forged = pyrage.encrypt(b"another foot", [recipient])
    path.unlink()
    name = path.name[:64]
    digest = backup_folder.hashlib.sha256(forged).hexdigest()[:32]
    (path.parent / f"{name}-{len(forged)}-{digest}.age").write_bytes(forged)
    with pytest.raises(DamagedBackup):
        restored_at(folder, tmp_path / "new")


def test_damage_of_the_record_is_left_out_and_named(
    context: RecordsContext, folder: Path, tmp_path: Path
) -> None:
    """One damaged scan must not keep all others from being saved."""
    digest = next(d for d in context.contents.digests() if context.contents.read(d) == MESH)
    context.contents.path(digest).write_bytes(b"changed on the disk")
    report = back_up(context, folder)
    assert report.damaged == (digest,)
    assert check_backup(folder, SECRET).is_sound
    restored, told = restored_at(folder, tmp_path / "new")
    assert told.left_out == (digest,)
    assert list(restored.contents.digests()) != [digest]
    restored.database.close()


def full_disk(*_arguments: Any, **_more: Any) -> Any:
    raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))


@pytest.mark.parametrize("failing", ["fsync", "replace"])
def test_a_full_disk_leaves_the_earlier_backup_as_it_was(
    context: RecordsContext, folder: Path, failing: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    back_up(context, folder)
    before = files_in(folder)
    context.contents.put(b"new")
    add_person(context, "new")
    target = {"fsync": os, "replace": Path}[failing]
    with monkeypatch.context() as patch:
        patch.setattr(target, failing, full_disk)
        with pytest.raises(OutputError, match="the disk is full"):
            back_up(context, folder)
    assert files_in(folder) == before
    back_up(context, folder)
    assert check_backup(folder, SECRET).is_sound


def test_a_disk_that_gets_full_while_it_encrypts_is_told(
    context: RecordsContext, folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    written = backup_folder._HashingFile.write

    def write(self: Any, content: bytes) -> int:
        self.error = OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
        raise self.error

    monkeypatch.setattr(backup_folder._HashingFile, "write", write)
    with pytest.raises(OutputError, match="the disk is full"):
        back_up(context, folder)
    monkeypatch.setattr(backup_folder._HashingFile, "write", written)
    assert objects_of(folder) == []
    for number in (None, 1):
        with pytest.raises(InputError, match="holds no finished backup, since the first one was"):
            open_snapshot(folder, SECRET, number)
    back_up(context, folder)
    assert check_backup(folder, SECRET).is_sound


@pytest.mark.parametrize("after", [0, 2, 5])
def test_a_folder_that_goes_away_during_a_backup_is_told_and_not_made_anew(
    after: int, context: RecordsContext, folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    put, written = BackupWriter.put_rows, iter(range(100))

    def unplug(writer: BackupWriter, sha256: str, content: bytes) -> None:
        if next(written) == after:
            folder.rename(folder.with_name("elsewhere"))
        put(writer, sha256, content)

    monkeypatch.setattr(BackupWriter, "put_rows", unplug)
    with pytest.raises(OutputError, match=r"^The folder of the backups, .* connect its disk"):
        back_up(context, folder)
    assert not folder.exists()


def test_a_disk_that_does_not_keep_what_is_written_is_told(
    context: RecordsContext, folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(backup_folder, "_digest", lambda _path: "00" * 16)
    with pytest.raises(OutputError, match="does not keep what is written"):
        back_up(context, folder)
    assert objects_of(folder) == []


def test_a_cancelled_backup_leaves_no_snapshot(context: RecordsContext, folder: Path) -> None:
    calls = 0

    def cancel() -> bool:
        nonlocal calls
        calls += 1
        return calls > 8

    with pytest.raises(Cancelled):
        back_up(context, folder, progress=Progress(is_cancelled=cancel))
    assert BackupFolder(folder).snapshots() == []
    back_up(context, folder)
    assert check_backup(folder, SECRET).is_sound


def test_a_newer_record_is_not_replaced_without_a_word(
    context: RecordsContext, folder: Path
) -> None:
    back_up(context, folder)
    add_person(context, "new")
    place = context.database.place
    before = all_rows(context)
    found = r"newer than the backup: 1 entries .* the last of \d{4}-\d\d-\d\d .* \(person 1\)"
    with pytest.raises(PlaceTaken, match=found):
        restore(folder, SECRET, place, ANNA)
    assert all_rows(context) == before


def test_a_record_with_nothing_new_in_it_is_said_to_have_nothing_new(
    context: RecordsContext, folder: Path
) -> None:
    """That it was backed up twice is no change."""
    back_up(context, folder)
    back_up(context, folder)
    with pytest.raises(PlaceTaken, match="nothing was changed since"):
        restore(folder, SECRET, context.database.place, ANNA, number=1)


def test_another_record_is_told_from_an_older_state_of_the_same(
    context: RecordsContext, folder: Path, tmp_path: Path, migrated_file: Path
) -> None:
    back_up(context, folder)
    other = make_record(migrated_file, tmp_path / "another")
    for number in range(4):
        add_person(other, f"person {number}")
    other.database.close()
    with pytest.raises(PlaceTaken, match="holds another record than the backup"):
        restore(folder, SECRET, other.database.place, ANNA)


def test_the_empty_record_of_a_new_machine_makes_room(
    context: RecordsContext, folder: Path, tmp_path: Path, migrated_file: Path
) -> None:
    back_up(context, folder)
    place = RecordsPlace.local(tmp_path / "new machine")
    place.database_file.parent.mkdir()
    place.database_file.write_bytes(migrated_file.read_bytes())
    report = restore(folder, SECRET, place, ANNA)
    assert report.set_aside is not None
    assert report.set_aside.exists()
    restored = context_of(place)
    equal_rows(context, restored)
    restored.database.close()


def test_an_older_record_is_not_replaced_either(
    context: RecordsContext, folder: Path, tmp_path: Path, migrated_file: Path
) -> None:
    back_up(context, folder)
    other = tmp_path / "other"
    other.mkdir()
    place = RecordsPlace.local(other)
    place.database_file.write_bytes(migrated_file.read_bytes())
    older = context_of(place)
    add_person(older, "early")
    older.database.close()
    with pytest.raises(PlaceTaken, match=r"a record with \d entries fewer in its audit log"):
        restore(folder, SECRET, place, ANNA)
    place.database_file.write_bytes(b"no database at all")
    with pytest.raises(PlaceTaken, match="holds a record that cannot be read"):
        restore(folder, SECRET, place, ANNA)


def test_a_replaced_record_is_set_aside(context: RecordsContext, folder: Path) -> None:
    back_up(context, folder)
    add_person(context, "after the backup")
    place = context.database.place
    context.database.close()
    restored, told = restored_at(folder, place.database_file.parent, replace_existing=True)
    assert not any("after the backup" in row for row in all_rows(restored)["persons"])
    restored.database.close()
    assert told.set_aside is not None
    with closing(sqlite3.connect(told.set_aside)) as kept:
        found = kept.execute("SELECT count(*) FROM persons WHERE id LIKE 'after%'").fetchone()
    assert found == (1,)


def test_a_record_that_is_open_elsewhere_is_not_replaced(
    context: RecordsContext, folder: Path
) -> None:
    back_up(context, folder)
    with context.database.reading() as connection:
        connection.execute(text("SELECT count(*) FROM persons")).scalar()
        with pytest.raises(RecordsError, match="is open in another program"):
            restored_at(folder, context.database.place.database_file.parent, replace_existing=True)
    assert len(all_rows(context)["persons"]) == 2


def test_a_damaged_record_is_set_aside_for_its_backup(
    context: RecordsContext, folder: Path
) -> None:
    back_up(context, folder)
    context.database.close()
    place = context.database.place
    place.database_file.write_bytes(b"no database" * 1000)
    restored, told = restored_at(folder, place.database_file.parent, replace_existing=True)
    assert told.set_aside is not None
    assert told.set_aside.read_bytes().startswith(b"no database")
    assert len(all_rows(restored)["persons"]) == 2
    restored.database.close()


def test_a_failed_restore_leaves_nothing_in_the_place(
    context: RecordsContext, folder: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    back_up(context, folder)
    target = tmp_path / "new"
    with monkeypatch.context() as patch:
        patch.setattr(restoring, "verify_chain", full_disk)
        with pytest.raises(OSError, match="No space"):
            restored_at(folder, target)
    assert [path.name for path in target.iterdir()] == ["contents"]
    restored, _ = restored_at(folder, target)
    restored.database.close()


def equal_rows(context: RecordsContext, other: RecordsContext) -> None:
    """Compare all that was there before the backup was made."""
    before, after = all_rows(context), all_rows(other)
    for name in before.keys() - NOT_COMPARED:
        assert after[name] == before[name], name
    # The backup was made before the line that tells of it.
    assert after["audit"][: len(before["audit"]) - 1] == before["audit"][:-1]
    assert AuditLog(other.database, ANNA).verify().is_intact
    signatures = verified_signatures(other)
    assert signatures == SignatureReport(signatures.checked)


def verified_signatures(context: RecordsContext) -> SignatureReport:
    with context.database.reading() as connection:
        return verify_signatures(connection)


def test_a_backup_restores_into_either_kind_of_database(
    context: RecordsContext, folder: Path, tmp_path: Path, server_place: RecordsPlace
) -> None:
    back_up(context, folder)
    restore(folder, SECRET, server_place, ANNA)
    shared = context_of(server_place)
    equal_rows(context, shared)
    add_person(shared, "new")
    set_up_backups(shared, BackupKey.for_recipients([RECIPIENT]))
    back_up(shared, tmp_path / "backups of the server")
    local, _ = restored_at(tmp_path / "backups of the server", tmp_path / "local again")
    equal_rows(shared, local)
    shared.database.close()
    local.database.close()


def test_a_server_is_restored_to_only_while_it_is_empty(
    context: RecordsContext, folder: Path, server_place: RecordsPlace
) -> None:
    back_up(context, folder)
    shared = context_of(server_place)
    add_person(shared, "new")
    for replace_existing in (False, True):
        with pytest.raises(PlaceTaken, match="entries fewer"):
            restore(folder, SECRET, server_place, ANNA, replace_existing=replace_existing)
    assert len(all_rows(shared)["persons"]) == 1
    shared.database.close()


def test_any_snapshot_can_be_restored(
    context: RecordsContext, folder: Path, tmp_path: Path
) -> None:
    back_up(context, folder)
    add_person(context, "second")
    back_up(context, folder)
    for number, persons in ((1, 2), (2, 3), (None, 3)):
        restored, _ = restored_at(folder, tmp_path / f"of {number}", number=number)
        assert len(all_rows(restored)["persons"]) == persons
        restored.database.close()
    with pytest.raises(InputError, match="holds no snapshot 7; it has: 1, 2"):
        restored_at(folder, tmp_path / "none", number=7)
    with pytest.raises(InputError, match="holds no backup"):
        restored_at(tmp_path, tmp_path / "none")


def test_a_backup_of_a_newer_program_is_refused_in_words(
    context: RecordsContext, folder: Path, tmp_path: Path
) -> None:
    with context.database.writing() as connection:
        connection.execute(text("UPDATE alembic_version SET version_num = '9999'"))
    with pytest.raises(RecordsError):
        back_up(context, folder)  # its last line is refused by the older program
    context.database.schema = "9999"
    back_up(context, folder)
    with pytest.raises(RecordsError, match="newer Insole Studio"):
        restored_at(folder, tmp_path / "new")
    head = json.loads((folder / HEAD_FILE).read_text())
    (folder / HEAD_FILE).write_text(json.dumps({**head, "format": 2}))
    with pytest.raises(RecordsError, match="newer Insole Studio"):
        restored_at(folder, tmp_path / "new")


def test_settings_are_backed_up_and_restored_where_none_are(
    context: RecordsContext, folder: Path, tmp_path: Path
) -> None:
    there = tmp_path / "settings"
    (there / "devices").mkdir(parents=True)
    (there / "settings.json").write_text("{}")
    (there / "devices" / "låg.json").write_text("[1]")
    back_up(context, folder, {"settings": there, "sensors": tmp_path / "absent"})
    here = tmp_path / "new settings"
    here.mkdir()
    (here / "settings.json").write_text("mine")
    restored, told = restored_at(folder, tmp_path / "new", settings={"settings": here})
    restored.database.close()
    assert (told.files, told.kept_files) == (1, 1)
    assert (here / "settings.json").read_text() == "mine"
    assert (here / "devices" / "låg.json").read_text() == "[1]"


def test_the_clock_does_not_tell_the_order_of_snapshots(
    context: RecordsContext, folder: Path
) -> None:
    back_up(context, folder)
    (first,) = (folder / "snapshots").iterdir()
    first.rename(first.with_name("000001-2099-01-01T00-00-00Z.age"))
    assert back_up(context, folder).snapshot.number == 2
    assert open_snapshot(folder, SECRET).snapshot.number == 2


def test_backups_are_due_by_the_schedule() -> None:
    daily, now = BackupSchedule(None, 18), datetime(2026, 11, 22, 12, tzinfo=UTC)  # a Sunday
    assert daily.latest(now) == datetime(2026, 11, 21, 18, tzinfo=UTC)
    assert daily.latest(now.replace(hour=18)) == now.replace(hour=18)
    assert daily.is_due(None, now)
    assert daily.is_due(datetime(2026, 11, 21, 17, 59, tzinfo=UTC), now)  # missed, made up for
    assert not daily.is_due(datetime(2026, 11, 21, 18, 1, tzinfo=UTC), now)
    assert not daily.is_due(now + timedelta(minutes=5), now)
    assert daily.is_due(now + timedelta(days=300), now)  # made while the clock was wrong
    fridays = BackupSchedule(4, 9)
    assert fridays.latest(now) == datetime(2026, 11, 20, 9, tzinfo=UTC)
    assert fridays.latest(datetime(2026, 11, 20, 8, tzinfo=UTC)) == datetime(
        2026, 11, 13, 9, tzinfo=UTC
    )


@pytest.mark.parametrize("killed_at", range(1, 16, 2))
def test_a_killed_backup_is_completed_by_the_next_one(
    context: RecordsContext, folder: Path, killed_at: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Each object and each snapshot appears by one rename, with all it refers to on the disk."""
    renames = 0
    replace = Path.replace

    def killed(path: Path, target: Path) -> Path:
        nonlocal renames
        renames += 1
        if renames == killed_at:
            raise KeyboardInterrupt
        return replace(path, target)

    with monkeypatch.context() as patch:
        patch.setattr(Path, "replace", killed)
        with pytest.raises(KeyboardInterrupt):
            back_up(context, folder)
    assert BackupFolder(folder).snapshots() == []
    said = folder / UNFINISHED
    assert said.exists() or not (folder / HEAD_FILE).exists()
    back_up(context, folder)
    assert check_backup(folder, SECRET).is_sound
    assert not said.exists()


def test_a_backup_of_an_older_program_that_was_broken_off_is_told_as_such(
    context: RecordsContext, folder: Path
) -> None:
    with pytest.raises(Cancelled):
        back_up(context, folder, progress=Progress(is_cancelled=lambda: True))
    (folder / UNFINISHED).unlink()
    with pytest.raises(Cancelled):
        back_up(context, folder, progress=Progress(is_cancelled=lambda: True))
    assert (folder / UNFINISHED).exists()
    with pytest.raises(InputError, match="holds no finished backup"):
        open_snapshot(folder, SECRET)


def test_any_age_program_opens_the_key_and_the_files(context: RecordsContext, folder: Path) -> None:
    """Nothing but age is needed to read a backup (docs/formats/backup.md)."""
    back_up(context, folder)
    head = BackupFolder(folder).head()
    opened = open_key(head.locked, SECRET)
    values = json.loads(pyrage.decrypt(base64.b64decode(head.locked), [IDENTITY]))
    assert values == {"identity": opened.identity, "mac_key": opened.mac_key}
    assert opened.decrypt(objects_of(folder)[0].read_bytes(), "object")


def test_a_report_counts_what_is_there(context: RecordsContext, folder: Path) -> None:
    report: BackupReport = back_up(context, folder)
    check = check_backup(folder, SECRET)
    assert (check.rows, check.contents, check.contents_bytes) == (
        report.rows, report.contents, report.contents_bytes,
    )  # fmt: skip
    assert open_snapshot(folder, SECRET).manifest.schema == SCHEMA
