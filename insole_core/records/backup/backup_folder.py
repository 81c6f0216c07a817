"""A folder of backups: encrypted objects, and snapshots that refer to them.

An object is a large file of the record, or a piece of one of its tables. It is written once, and
shared by all later snapshots: a folder grows by what is new. The name of an object holds an HMAC
of its content, which tells nothing about it, and size and digest of the encrypted file, by which
damage is found without the passphrase (docs/formats/backup.md).
"""

from __future__ import annotations

import hashlib
import json
import logging
import os
import re
import zlib
from collections.abc import Callable, Container, Iterator, Mapping
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path
from typing import Any, BinaryIO, Final, Self

import pyrage

from insole_core.errors import InputError, InsoleError, OutputError, RecordsError
from insole_core.files.atomic import PRIVATE_FOLDER, make_private_folder, write_text
from insole_core.files.file_lock import FileLock
from insole_core.files.file_safety import sync
from insole_core.files.temporary import make_file, release, remove, sweep
from insole_core.files.write_errors import output_errors
from insole_core.given_file import read_given
from insole_core.records.backup.backup_key import (
    BackupKey,
    OpenedKey,
    authenticate,
    damaged,
    missing,
)
from insole_core.records.content_store import MOST_BYTES
from insole_core.regular_file import blocks_of, open_regular
from insole_core.strict_json import load_strictly

log = logging.getLogger(__name__)

FORMAT: Final = 1
HEAD_FILE: Final = "insole-studio-backup.json"
UNFINISHED: Final = "first-backup-not-finished"
"""An empty file beside the head until there is a snapshot, for whoever looks into the folder."""
OBJECTS: Final = "objects"
SNAPSHOTS: Final = "snapshots"
LISTS: Final = "lists"
_HEAD_BYTES: Final = 2**20
_SNAPSHOT_BYTES: Final = 2**30
_OBJECT: Final = re.compile(r"([0-9a-f]{64})-(\d{1,15})-([0-9a-f]{32})\.age")
_SNAPSHOT: Final = re.compile(r"(\d{6})-(\d{4}-\d\d-\d\dT\d\d-\d\d-\d\dZ)\.age")
_LIST_SUFFIX: Final = ".objects"
_TIME: Final = "%Y-%m-%dT%H-%M-%SZ"


@dataclass(frozen=True)
class SnapshotName:
    """A snapshot in a folder.

    Parameters
    ----------
    number
        Tells the order, whatever the clock said.
    made_at
        UTC.
    """

    number: int
    made_at: datetime

    @property
    def file_name(self) -> str:
        """Name of its file."""
        return f"{self.number:06}-{self.made_at.strftime(_TIME)}.age"

    @property
    def list_name(self) -> str:
        """Name of the file that lists its objects."""
        return f"{self.file_name.removesuffix('.age')}{_LIST_SUFFIX}"


@dataclass(frozen=True)
class ObjectList:
    """What a snapshot refers to, for those who make backups and cannot read them.

    Parameters
    ----------
    objects
        First parts of their names.
    damaged
        Number of large files that the record had lost.
    """

    objects: frozenset[str]
    damaged: int

    def as_json(self) -> bytes:
        """Return the list as its file holds it."""
        values = {"format": FORMAT, "damaged": self.damaged, "objects": sorted(self.objects)}
        return json.dumps(values).encode("ascii")

    @classmethod
    def from_json(cls, content: bytes, name: str) -> Self:
        """Read a list that was authenticated.

        Raises
        ------
        DamagedBackup
            When it is none that this program knows.
        """
        try:
            values = json.loads(content)
            if values["format"] != FORMAT:
                raise damaged(name)
            return cls(frozenset(values["objects"]), int(values["damaged"]))
        except (ValueError, KeyError, TypeError, OverflowError, RecursionError) as error:
            raise damaged(name) from error


@dataclass(frozen=True)
class KnownSnapshot:
    """A snapshot, and whether it can be restored as far as is known without its passphrase.

    Parameters
    ----------
    is_good
        Whether all that it refers to is there, and the record had lost nothing when it was made.
    """

    name: SnapshotName
    is_good: bool


@dataclass(frozen=True)
class BackupHead:
    """What everybody may read of a folder of backups."""

    recipient: str
    locked: str
    opened_by: str


def folder_is_away(folder: Path) -> OutputError:
    """Return the error that the folder of the backups is not there, for the caller to raise."""
    return OutputError(
        "The folder of the backups, {folder}, is not there; connect its disk, or choose another "
        "folder.",
        folder=folder,
    )


class BackupFolder:
    """A folder with the backups of one record."""

    def __init__(self, path: Path) -> None:
        self.path = path

    def head(self) -> BackupHead:
        """Read what everybody may read.

        Raises
        ------
        InputError
            When the folder holds no backups.
        DamagedBackup
        """
        path = self.path / HEAD_FILE
        if not path.is_file():
            raise InputError(
                "{folder} holds no backup; choose the folder that has {name} in it.",
                folder=self.path,
                name=HEAD_FILE,
            )
        try:
            values = load_strictly(read_given(path, _HEAD_BYTES))
            if values["format"] > FORMAT:
                raise RecordsError(
                    "The backup in {folder} comes from a newer Insole Studio; install the newest "
                    "version.",
                    folder=self.path,
                )
            return BackupHead(*(str(values[name]) for name in ("recipient", "key", "opened_by")))
        except (ValueError, KeyError, TypeError, RecursionError) as error:
            raise damaged(HEAD_FILE) from error

    def snapshots(self) -> list[SnapshotName]:
        """Return the snapshots, the oldest first."""
        folder = self.path / SNAPSHOTS
        names = [path.name for path in folder.iterdir()] if folder.is_dir() else []
        found = filter(None, map(_snapshot_of, names))
        return sorted(found, key=lambda snapshot: snapshot.number)

    def finished_snapshots(self) -> dict[int, SnapshotName]:
        """Return the snapshots by number, at least one.

        Raises
        ------
        InputError
            When the folder holds none.
        """
        snapshots = {snapshot.number: snapshot for snapshot in self.snapshots()}
        if not snapshots:
            raise InputError(
                "{folder} holds no finished backup, since the first one was broken off; back the "
                "record up to it again, or choose another folder.",
                folder=self.path,
            )
        return snapshots

    def known_snapshots(self, key: BackupKey) -> list[KnownSnapshot]:
        """Return the snapshots, the oldest first, as whoever makes backups knows them."""
        there = self.objects()
        lists = ((name, self.read_list(name, key)) for name in self.snapshots())
        return [KnownSnapshot(name, _is_good(found, there)) for name, found in lists]

    def read_list(self, name: SnapshotName, key: BackupKey) -> ObjectList | None:
        """Return the objects of a snapshot; None where an older program has not listed them."""
        path = self.path / LISTS / name.list_name
        try:
            content = read_given(path, _SNAPSHOT_BYTES)
            return ObjectList.from_json(unsealed(content, key.mac_key, path.name), path.name)
        except InsoleError as error:
            log.warning("the objects of %s are not known, so all are kept: %s", path.name, error)
            return None

    def objects(self) -> dict[str, Path]:
        """Return the complete objects by the first part of their names.

        One that was cut off is not among them: the next backup writes it again.
        """
        found = {}
        for folder in _subfolders(self.path / OBJECTS):
            for entry in os.scandir(folder):
                match = _OBJECT.fullmatch(entry.name)
                if match is not None and _has_size(entry, int(match[2])):
                    found[match[1]] = Path(entry.path)
        return found

    def damaged_objects(self, is_cancelled: Callable[[], bool]) -> Iterator[tuple[Path, bool]]:
        """Read every object; yield its path, and whether it is what was written."""
        for folder in _subfolders(self.path / OBJECTS):
            for path in sorted(folder.iterdir()):
                match = _OBJECT.fullmatch(path.name)
                if match is not None and not is_cancelled():
                    yield path, _has_digest(path, match[3])


def _snapshot_of(name: str) -> SnapshotName | None:
    """Return what the name of a file says; None for another file."""
    match = _SNAPSHOT.fullmatch(name)
    if match is None:
        return None
    try:
        made_at = datetime.strptime(match[2], _TIME).replace(tzinfo=UTC)
    except ValueError:  # digits that are no time
        return None
    return SnapshotName(int(match[1]), made_at)


def _is_good(found: ObjectList | None, there: Container[str]) -> bool:
    return found is not None and found.damaged == 0 and all(name in there for name in found.objects)


class BackupWriter:
    """Writes one snapshot into a folder, and the objects that are not there yet.

    A context: only one writer works in a folder at a time.

    Raises
    ------
    RecordsError
        When the folder is that of another record, or another station writes there.
    OutputError
        When the folder cannot be written.
    """

    def __init__(self, folder: BackupFolder, key: BackupKey) -> None:
        self._folder = folder
        self._key = key
        self._recipients = [pyrage.x25519.Recipient.from_str(key.recipient)]
        self._lock = FileLock(folder.path / ".lock")
        self._known: dict[str, Path] = {}
        self._used: set[str] = set()
        self._unsynced: set[Path] = set()
        self.written_objects = 0
        self.written_bytes = 0

    def __enter__(self) -> BackupWriter:
        path = self._folder.path
        with output_errors(path):
            make_private_folder(path)
        if not self._lock.acquire():
            raise RecordsError(
                "Another program is making a backup in {folder}; wait until it is done.",
                folder=path,
            )
        try:
            self._check_head()
            for name in (OBJECTS, SNAPSHOTS, LISTS):
                with output_errors(path / name):
                    make_private_folder(path / name)
            self._known = self._folder.objects()
            for folder in _subfolders(path / OBJECTS):
                sweep(folder)  # what a program left that was killed
        except BaseException:
            self._lock.release()
            raise
        return self

    def __exit__(self, *_error: object) -> None:
        self._lock.release()

    def _check_head(self) -> None:
        path = self._folder.path / HEAD_FILE
        if path.exists():
            if self._folder.head().recipient != self._key.recipient:
                raise RecordsError(
                    "{folder} holds the backups of another record, or of this one under another "
                    "passphrase; choose another folder.",
                    folder=self._folder.path,
                )
            self._note_unfinished()
            return
        self._note_unfinished()
        values = {
            "kind": "insole-studio-backup",
            "format": FORMAT,
            "recipient": self._key.recipient,
            "key": self._key.locked,
            "opened_by": self._key.opened_by,
        }
        write_text(json.dumps(values, indent=1) + "\n", path)

    def _note_unfinished(self) -> None:
        if not self._folder.snapshots():
            write_text("", self._folder.path / UNFINISHED)

    def put_rows(self, sha256: str, content: bytes) -> None:
        """Keep a piece of a table, unless it is there.

        Parameters
        ----------
        sha256
            Of the content, which is compressed.
        """
        self._put(sha256, lambda file: file.write(self._encrypted(zlib.compress(content))))

    def put_file(self, sha256: str, opened: Callable[[], BinaryIO]) -> None:
        """Keep a file, unless it is there.

        Parameters
        ----------
        opened
            Opens the file, whose content has been verified.
        """
        self._put(sha256, lambda file: self._encrypt_file(opened, file))

    def finish(self, made_at: datetime, manifest: bytes, lost: int) -> SnapshotName:
        """Write the snapshot, once all that it refers to is on the disk.

        Parameters
        ----------
        lost
            Number of large files that the record had lost.
        """
        last = max((snapshot.number for snapshot in self._folder.snapshots()), default=0)
        name = SnapshotName(last + 1, made_at)
        content = self._encrypted(sealed(manifest, self._key.mac_key))
        listed = sealed(ObjectList(frozenset(self._used), lost).as_json(), self._key.mac_key)
        self._write_at(self._folder.path / LISTS / name.list_name, listed)
        self._write_at(self._folder.path / SNAPSHOTS / name.file_name, content)
        try:
            (self._folder.path / UNFINISHED).unlink(missing_ok=True)
        except OSError as error:  # a folder may let nothing be removed; the snapshot is there
            log.warning("%s stays: %s", UNFINISHED, error.strerror)
        return name

    def _write_at(self, path: Path, content: bytes) -> None:
        self._write(path.parent, lambda file: file.write(content), lambda _size, _digest: path)
        self._sync_folders()

    def prune(self, choose: Callable[[list[KnownSnapshot]], list[SnapshotName]]) -> int:
        """Remove old snapshots, and what none refers to since they were removed last.

        What only the removed ones refer to goes the next time: whoever restores one of them at
        this moment can finish.

        Parameters
        ----------
        choose
            Returns those of all snapshots that are to go.

        Returns
        -------
        int
            How many snapshots were removed.
        """
        lists = {name: self._folder.read_list(name, self._key) for name in self._folder.snapshots()}
        known = [KnownSnapshot(name, _is_good(found, self._known)) for name, found in lists.items()]
        with output_errors(self._folder.path):
            self._remove_unused(lists)
            going = choose(known)
            for name in going:
                (self._folder.path / SNAPSHOTS / name.file_name).unlink(missing_ok=True)
                (self._folder.path / LISTS / name.list_name).unlink(missing_ok=True)
        return len(going)

    def _remove_unused(self, lists: Mapping[SnapshotName, ObjectList | None]) -> None:
        """Remove objects and lists that no snapshot refers to, if all of these are known."""
        listed = [found.objects for found in lists.values() if found is not None]
        if len(listed) < len(lists):
            return
        used = frozenset().union(*listed)
        for name, path in list(self._known.items()):
            if name not in used:
                path.unlink(missing_ok=True)
                del self._known[name]
        names = {name.list_name for name in lists}
        for path in (self._folder.path / LISTS).glob(f"*{_LIST_SUFFIX}"):
            if path.name not in names:
                path.unlink(missing_ok=True)

    def _put(self, sha256: str, write: Callable[[BinaryIO], Any]) -> None:
        name = object_name(self._key.mac_key, sha256)
        self._used.add(name)
        if name in self._known:
            return
        folder = self._folder.path / OBJECTS / name[:2]
        with self._output_errors(folder):
            if not folder.is_dir():
                folder.mkdir(mode=PRIVATE_FOLDER)  # the one above is made when the backup begins
                self._unsynced.add(folder.parent)

        def path_of(size: int, digest: str) -> Path:
            return folder / f"{name}-{size}-{digest[:32]}.age"

        self._known[name] = self._write(folder, write, path_of)

    def _write(
        self,
        folder: Path,
        write: Callable[[BinaryIO], Any],
        path_of: Callable[[int, str], Path],
    ) -> Path:
        """Write a file beside its place, read it again, and give it its name."""
        with self._output_errors(folder):
            beside = make_file(folder, folder)
            try:
                with beside.open("wb") as file:
                    hashing = _HashingFile(file)
                    hashing.run(write)
                sync(beside)
                _forget_cached(beside)
                if _digest(beside) != hashing.digest()[:32]:
                    raise OutputError(
                        "{folder} does not keep what is written to it; use another disk for "
                        "backups.",
                        folder=folder,
                    )
                path = path_of(hashing.size, hashing.digest())
                beside.replace(path)
            finally:
                with suppress(OSError):
                    remove(beside)
                release(beside)
        self._unsynced.add(folder)
        self.written_objects += 1
        self.written_bytes += hashing.size
        return path

    @contextmanager
    def _output_errors(self, path: Path) -> Iterator[None]:
        """Do as `output_errors`, and tell where the disk was taken away meanwhile."""
        try:
            with output_errors(path):
                yield
        except OutputError as error:
            if not (self._folder.path / HEAD_FILE).is_file():
                raise folder_is_away(self._folder.path) from error
            raise

    def _sync_folders(self) -> None:
        for folder in sorted(self._unsynced):
            with self._output_errors(folder):
                sync(folder)
        self._unsynced.clear()

    def _encrypted(self, content: bytes) -> bytes:
        encrypted: bytes = pyrage.encrypt(content, self._recipients)
        return encrypted

    def _encrypt_file(self, opened: Callable[[], BinaryIO], file: BinaryIO) -> None:
        with opened() as source:
            pyrage.encrypt_io(source, file, self._recipients)


class BackupReader:
    """Reads snapshots and objects of a folder with its opened key."""

    def __init__(self, folder: BackupFolder, key: OpenedKey) -> None:
        self._folder = folder
        self._key = key
        self._known = folder.objects()

    def manifest(self, snapshot: SnapshotName) -> bytes:
        """Return the manifest of a snapshot.

        Raises
        ------
        DamagedBackup
            When it is not what the record has written.
        """
        name = snapshot.file_name
        content = read_given(self._folder.path / SNAPSHOTS / name, _SNAPSHOT_BYTES)
        return unsealed(self._key.decrypt(content, name), self._key.mac_key, name)

    def read_rows(self, sha256: str) -> bytes:
        """Return a piece of a table, verified.

        Raises
        ------
        DamagedBackup
        """
        path = self._path(sha256)
        decrypted = self._key.decrypt(read_given(path, _SNAPSHOT_BYTES), path.name)
        content = _inflated(decrypted, path.name)
        if hashlib.sha256(content).hexdigest() != sha256:
            raise damaged(path.name)
        return content

    def copy_file(self, sha256: str, target: BinaryIO) -> int:
        """Decrypt a file into an open one; return its size in bytes.

        Raises
        ------
        DamagedBackup
            When it is not what was written; what the target holds by then is to be thrown away.
        """
        path = self._path(sha256)
        hashing = _HashingFile(target)
        with open_regular(path) as source:
            try:
                hashing.run(lambda file: pyrage.decrypt_io(source, file, self._key.identities()))
            except (pyrage.DecryptError, OSError) as error:
                if hashing.error is not None:
                    raise
                raise damaged(path.name) from error
        if hashing.digest() != sha256:
            raise damaged(path.name)
        return hashing.size

    def _path(self, sha256: str) -> Path:
        name = object_name(self._key.mac_key, sha256)
        if name not in self._known:
            raise missing(f"{OBJECTS}/{name[:2]}/{name[:12]}…")
        return self._known[name]


class _HashingFile:
    """A file to write to that keeps size and SHA-256 of what was written.

    The encryption loses the number of an error of the system; it is raised again from here.
    """

    def __init__(self, file: BinaryIO) -> None:
        self._file = file
        self._hash = hashlib.sha256()
        self.size = 0
        self.error: OSError | None = None

    def run(self, write: Callable[[Any], Any]) -> None:
        """Let `write` write to this file.

        Raises
        ------
        OSError
            Of the file; other errors are those of `write`.
        """
        try:
            write(self)
            self._file.flush()
        except Exception:
            if self.error is not None:
                raise self.error from None
            raise

    def write(self, content: bytes) -> int:
        """Write a block."""
        try:
            written = self._file.write(content)
        except OSError as error:
            self.error = error
            raise
        self._hash.update(content)
        self.size += len(content)
        return written

    def flush(self) -> None:
        """Do nothing: the file is flushed at its end."""

    def digest(self) -> str:
        """Return the SHA-256 of what was written, in hexadecimal."""
        return self._hash.hexdigest()


def object_name(mac_key: str, sha256: str) -> str:
    """Return the part of an object's name that depends on its content."""
    return authenticate(mac_key, bytes.fromhex(sha256))


def sealed(manifest: bytes, mac_key: str) -> bytes:
    """Return a manifest with its authentication, compressed."""
    content = zlib.compress(manifest)
    return authenticate(mac_key, content).encode("ascii") + content


def unsealed(content: bytes, mac_key: str, name: str) -> bytes:
    """Return the manifest that `sealed` was given.

    Raises
    ------
    DamagedBackup
        When the record has not written it.
    """
    mac, compressed = content[:64], content[64:]
    if authenticate(mac_key, compressed).encode("ascii") != mac:
        raise damaged(name)
    return _inflated(compressed, name)


def _inflated(compressed: bytes, name: str) -> bytes:
    """Return what was compressed; nothing larger than any snapshot.

    Raises
    ------
    DamagedBackup
    """
    inflating = zlib.decompressobj()
    try:
        content = inflating.decompress(compressed, _SNAPSHOT_BYTES)
    except zlib.error as error:
        raise damaged(name) from error
    if not inflating.eof:
        raise damaged(name)
    return content


def _subfolders(folder: Path) -> list[Path]:
    return sorted(path for path in folder.iterdir() if path.is_dir()) if folder.is_dir() else []


def _has_size(entry: os.DirEntry[str], size: int) -> bool:
    """Return whether something is a file of a size; a link may lead nowhere."""
    try:
        return entry.is_file() and entry.stat().st_size == size
    except OSError:
        return False


def _has_digest(path: Path, digest: str) -> bool:
    """Return whether a file can be read, and is what was written."""
    try:
        return _digest(path) == digest
    except OSError as error:
        log.warning("%s cannot be read: %s", path, error)
        return False


def _digest(path: Path) -> str:
    """Return the part of the SHA-256 of a file that object names hold."""
    digest = hashlib.sha256()
    with open_regular(path) as file:
        for block in blocks_of(file, 2 * MOST_BYTES):
            digest.update(block)
    return digest.hexdigest()[:32]


def _forget_cached(path: Path) -> None:
    """Let the next reading come from the disk, where the system can be asked for it."""
    if hasattr(os, "posix_fadvise"):
        with open_regular(path) as file:
            os.posix_fadvise(file.fileno(), 0, 0, os.POSIX_FADV_DONTNEED)
