"""Files of the record: what was stored is read, or somebody is told."""

from __future__ import annotations

import errno
import hashlib
import os
import stat
import time
from pathlib import Path
from typing import Any

import pytest

from insole_core.errors import InputError, OutputError, RecordsError, Unreachable
from insole_core.files import file_safety
from insole_core.progress import Progress
from insole_core.records.content_store import (
    GRACE_S,
    IDENTITY_FILE,
    ContentStore,
    DamagedContent,
    SweptContents,
)

SCAN = b"solid foot" * 1000
SHA = hashlib.sha256(SCAN).hexdigest()


@pytest.fixture
def store(tmp_path: Path) -> ContentStore:
    return ContentStore(tmp_path / "contents")


def age(path: Path, seconds: float) -> None:
    then = time.time() - seconds
    os.utime(path, (then, then))


def test_what_is_put_is_read_by_its_digest(store: ContentStore, tmp_path: Path) -> None:
    scan = tmp_path / "scan.stl"
    scan.write_bytes(SCAN)
    assert store.put(scan) == store.put(SCAN) == SHA
    assert store.read(SHA) == SCAN
    with store.open(SHA) as file:
        assert file.read() == SCAN
    store.copy_to(SHA, tmp_path / "copy.stl")
    assert (tmp_path / "copy.stl").read_bytes() == SCAN
    assert list(store.digests()) == [SHA]
    assert store.path(SHA) == store.folder / SHA[:2] / SHA


def test_only_the_owner_reads_it(store: ContentStore) -> None:
    store.put(SCAN)
    for path in [store.folder, *store.folder.rglob("*")]:
        assert stat.S_IMODE(path.stat().st_mode) == (0o700 if path.is_dir() else 0o600)


def test_file_then_folders_are_synced_before_put_returns(
    store: ContentStore, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The order of a power failure: content, name, and the folder's own name."""
    store.identity()
    steps: list[str] = []
    real_sync, real_replace = os.fsync, Path.replace

    def fsync(handle: int) -> None:
        target = Path(f"/proc/self/fd/{handle}").readlink()
        steps.append(f"sync {target.name if target.is_dir() else 'file'}")
        real_sync(handle)

    def replace(path: Path, target: Path) -> Path:
        steps.append("rename")
        return real_replace(path, target)

    monkeypatch.setattr(file_safety.os, "fsync", fsync)
    monkeypatch.setattr(Path, "replace", replace)
    store.put(SCAN)
    assert steps == ["sync contents", "sync file", "rename", f"sync {SHA[:2]}"]


def test_content_that_is_there_is_not_written_again(store: ContentStore) -> None:
    path = store.path(store.put(SCAN))
    before = path.stat().st_ino
    store.put(SCAN)
    assert path.stat().st_ino == before


def test_damaged_content_is_told_and_healed_by_storing_it_again(
    store: ContentStore, tmp_path: Path
) -> None:
    path = store.path(store.put(SCAN))
    path.write_bytes(SCAN[:-1] + b"!")
    for read in (store.read, store.open):
        with pytest.raises(DamagedContent, match="was changed since the record stored it"):
            read(SHA)
    with pytest.raises(DamagedContent):
        store.copy_to(SHA, tmp_path / "copy.stl")
    assert not (tmp_path / "copy.stl").exists()
    store.put(SCAN)
    assert store.read(SHA) == SCAN


def test_missing_content_is_told(store: ContentStore) -> None:
    with pytest.raises(DamagedContent, match=f"{SHA[:12]} of the record is missing"):
        store.read(SHA)
    assert not store.folder.exists()  # reading makes nothing


@pytest.mark.parametrize("name", ["", "../../etc/passwd", SHA.upper(), SHA + "\n", "å" * 64])
def test_a_text_that_is_no_digest_never_becomes_a_path(store: ContentStore, name: str) -> None:
    with pytest.raises(DamagedContent, match="which is no SHA-256"):
        store.read(name)


def test_unmounted_share_is_not_written_to(tmp_path: Path) -> None:
    """Its empty mount point looks like a new store."""
    identity = ContentStore(tmp_path / "share").identity()
    (tmp_path / "share").rename(tmp_path / "away")
    (tmp_path / "share").mkdir()
    store = ContentStore(tmp_path / "share", identity)
    for use in (lambda: store.put(SCAN), lambda: store.read(SHA), lambda: store.verify({})):
        with pytest.raises(Unreachable, match="does not hold the files of this record"):
            use()
    with pytest.raises(Unreachable):
        store.sweep({SHA}, time.time())
    assert list((tmp_path / "share").iterdir()) == []


def test_share_of_another_clinic_is_not_written_to(store: ContentStore) -> None:
    store.identity()
    with pytest.raises(Unreachable):
        ContentStore(store.folder, "another").put(SCAN)


@pytest.mark.parametrize("number", [errno.EIO, errno.ESTALE, errno.EHOSTDOWN])
def test_share_that_disappears_is_unreachable(
    store: ContentStore, number: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    store.put(SCAN)

    def gone(*_arguments: Any, **_more: Any) -> Any:
        raise OSError(number, os.strerror(number))

    monkeypatch.setattr(os, "open", gone)
    with pytest.raises(Unreachable, match="does not answer"):
        store.read(SHA)
    with pytest.raises(Unreachable, match="does not answer"):
        store.put(b"another")


@pytest.mark.parametrize("failing", ["write", "fsync", "replace"])
def test_full_disk_is_told_and_leaves_nothing(
    store: ContentStore, failing: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    store.identity()

    def full(*_arguments: Any, **_more: Any) -> Any:
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    target = {"write": (Path, "write_bytes"), "fsync": (os, "fsync"), "replace": (Path, "replace")}
    with monkeypatch.context() as patch:
        patch.setattr(*target[failing], full)
        with pytest.raises(OutputError, match="the disk is full"):
            store.put(SCAN)
    assert [p.name for p in store.folder.rglob("*") if p.is_file()] == [IDENTITY_FILE]
    assert store.put(SCAN) == SHA


@pytest.mark.skipif(getattr(os, "geteuid", int)() == 0, reason="root may write anywhere")
def test_folder_that_may_not_be_written_is_told(store: ContentStore) -> None:
    store.identity()
    store.folder.chmod(0o500)
    with pytest.raises(OutputError, match="you may not write there"):
        store.put(SCAN)
    store.folder.chmod(0o700)


def test_given_file_that_is_none_is_told(store: ContentStore, tmp_path: Path) -> None:
    for path in (tmp_path / "missing.zip", tmp_path):
        with pytest.raises(InputError, match="cannot be read"):
            store.put(path)


def test_given_file_that_changes_meanwhile_is_not_stored(
    store: ContentStore, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    scan = tmp_path / "scan.zip"
    scan.write_bytes(SCAN)
    kept = ContentStore._is_kept

    def change_meanwhile(self: ContentStore, path: Path) -> bool:
        scan.write_bytes(b"more")
        return kept(self, path)

    monkeypatch.setattr(ContentStore, "_is_kept", change_meanwhile)
    with pytest.raises(InputError, match="was changed while it was being stored"):
        store.put(scan)
    assert list(store.digests()) == []


def test_unused_contents_leave_after_two_grace_times(store: ContentStore) -> None:
    used, unused = store.put(b"used"), store.put(SCAN)
    for sha256 in (used, unused):
        age(store.path(sha256), GRACE_S + 60)
    recent = store.put(b"its row is not committed yet")
    now = time.time()
    assert store.sweep({used}, now) == SweptContents(set_aside=1)
    assert sorted(store.digests()) == sorted([used, recent])
    assert store.sweep({used}, now + GRACE_S / 2) == SweptContents()
    assert store.sweep({used, recent}, now + GRACE_S + 1) == SweptContents(deleted=1)
    with pytest.raises(DamagedContent):
        store.read(unused)
    assert store.read(used) == b"used"


class SweptMeanwhile(set[str]):
    """What rows refer to; another station sweeps as soon as the last of the files is looked up."""

    def __init__(self, store: ContentStore, now: float, lookups: int) -> None:
        super().__init__()
        self.store, self.now, self.left = store, now, lookups

    def __contains__(self, name: object) -> bool:
        self.left -= 1
        if self.left == 0:
            self.store.sweep(set(), self.now)
        return False


@pytest.mark.parametrize("lookups", [1, 2])
def test_two_stations_may_sweep_at_once(store: ContentStore, lookups: int) -> None:
    for content in (b"first", b"second"):
        age(store.path(store.put(content)), GRACE_S + 60)
    now = time.time()
    assert store.sweep(SweptMeanwhile(store, now, lookups), now) == SweptContents()
    later = now + GRACE_S + 1
    assert store.sweep(SweptMeanwhile(store, later, 1), later).set_aside == 0
    assert list((store.folder / "removed").iterdir()) == []


def test_what_another_station_deletes_is_not_counted(
    store: ContentStore, monkeypatch: pytest.MonkeyPatch
) -> None:
    age(store.path(store.put(SCAN)), GRACE_S + 60)
    now = time.time()
    store.sweep(set(), now)
    unlink = Path.unlink

    def second(path: Path, missing_ok: bool = False) -> None:
        unlink(path)
        unlink(path, missing_ok)

    monkeypatch.setattr(Path, "unlink", second)
    assert store.sweep(set(), now + GRACE_S + 1) == SweptContents()
    assert list((store.folder / "removed").iterdir()) == []


def test_what_is_swept_while_it_is_verified_is_neither_damaged_nor_an_error(
    store: ContentStore,
) -> None:
    age(store.path(store.put(SCAN)), GRACE_S + 60)
    sweeping = Progress(lambda _fraction, _text: store.sweep(set(), time.time()))
    report = store.verify({}, sweeping)
    assert (report.is_sound, report.checked, report.unused) == (True, 0, ())


def test_storing_again_starts_the_grace_time_anew(store: ContentStore) -> None:
    """The row that refers to it is written only after `put` has returned."""
    path = store.path(store.put(SCAN))
    age(path, GRACE_S + 60)
    store.put(SCAN)
    assert store.sweep(set(), time.time()) == SweptContents()


@pytest.mark.parametrize("how", ["reading", "verifying", "sweeping", "storing"])
def test_what_was_set_aside_by_mistake_comes_back(store: ContentStore, how: str) -> None:
    age(store.path(store.put(SCAN)), GRACE_S + 60)
    now = time.time()
    store.sweep(set(), now)
    if how == "reading":
        assert store.read(SHA) == SCAN
    elif how == "verifying":
        assert store.verify({SHA: len(SCAN)}).is_sound
    elif how == "sweeping":
        assert store.sweep({SHA}, now) == SweptContents(brought_back=1)
    else:
        store.put(SCAN)
    assert store.path(SHA).read_bytes() == SCAN


def test_a_clock_that_was_behind_removes_nothing(store: ContentStore) -> None:
    store.put(SCAN)
    assert store.sweep(set(), time.time() - 10 * GRACE_S) == SweptContents()


def test_verification_names_what_is_wrong(store: ContentStore) -> None:
    sound, damaged, unused = store.put(b"sound"), store.put(SCAN), store.put(b"unused")
    missing = hashlib.sha256(b"missing").hexdigest()
    store.path(damaged).write_bytes(b"")
    foreign = store.folder / "notes.txt"
    foreign.touch()
    report = store.verify({sound: 5, damaged: len(SCAN), missing: 7})
    assert not report.is_sound
    assert (report.damaged, report.missing) == ((damaged,), (missing,))
    assert (report.unused, report.foreign) == ((unused,), (foreign,))
    assert (report.checked, report.checked_bytes) == (3, 11)
    store.put(SCAN)
    store.put(b"missing")
    assert store.verify({sound: 5, damaged: len(SCAN), missing: 7}).is_sound


def test_errors_are_errors_of_the_record() -> None:
    assert issubclass(DamagedContent, RecordsError)
    assert issubclass(Unreachable, RecordsError)
