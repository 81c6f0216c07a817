"""Large files of the record, named by the SHA-256 of their content.

A file is written beside its place, synced and renamed, and only then may a row of the database
refer to it: a row never names a file that is not there. Every reading is verified. What no row
refers to any more goes to a folder of removed files after a grace time, and leaves the disk after
another one; whoever still reads it meanwhile brings it back.
"""

from __future__ import annotations

import errno
import hashlib
import os
import re
import time
import uuid
from collections.abc import Callable, Collection, Iterator, Mapping
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path
from typing import BinaryIO, Final

from insole_core.errors import InputError, OutputError, RecordsError, Unreachable
from insole_core.files.atomic import make_private_folder, replacing_file
from insole_core.files.file_safety import sync
from insole_core.files.temporary import is_temporary
from insole_core.files.write_errors import output_errors
from insole_core.given_file import given_errors, sha256_of
from insole_core.progress import SILENT, Progress
from insole_core.regular_file import blocks_of, open_regular

IDENTITY_FILE: Final = "identity"
"""Names the store; a share that is not mounted leaves an empty folder, which has none."""
HEAD_FILE: Final = "audit-head"
"""The last line of the audit log, see `head_witness`."""
IDENTITY_VALUE: Final = "contents_identity"
"""Key of the clinic's settings: the store that belongs to the database."""
REMOVED_FOLDER: Final = "removed"
GRACE_S: Final = 7 * 24 * 3600.0
"""Longer than any work between the writing of a file and of its row, and than a clock is wrong."""
_IN_WORK_S: Final = 3600.0
"""Longer than between the writing of a file and of its row, where nobody has stopped the clock."""
MOST_BYTES: Final = 2**33
"""No session or mesh is larger."""
_SHA256: Final = re.compile(r"[0-9a-f]{64}")
_AWAY: Final = (
    errno.EIO,
    errno.ENXIO,
    errno.ENODEV,
    errno.ESTALE,
    errno.ENOTCONN,
    errno.ETIMEDOUT,
    errno.EHOSTDOWN,
    errno.EHOSTUNREACH,
)
"""What a share says that does not answer."""


class DamagedContent(RecordsError):  # noqa: N818 - as the other errors of the record
    """A stored file is missing, or is not what was stored."""


@dataclass(frozen=True)
class SweptContents:
    """What a sweep did, in numbers of files.

    Parameters
    ----------
    set_aside
        No longer referred to, moved to the removed files.
    deleted
        Removed files whose grace time is over.
    brought_back
        Removed files that a row refers to after all.
    """

    set_aside: int = 0
    deleted: int = 0
    brought_back: int = 0


@dataclass(frozen=True)
class ContentReport:
    """What a verification found; the digests are sorted.

    Parameters
    ----------
    checked, checked_bytes
        Files that were read and compared with their name.
    damaged
        Files whose content is not that of their name.
    missing
        Files that the database refers to and that are not there.
    unused
        Files that the database does not refer to; they are swept in time.
    foreign
        Paths within the folder that are not part of a store.
    """

    checked: int
    checked_bytes: int
    damaged: tuple[str, ...]
    missing: tuple[str, ...]
    unused: tuple[str, ...]
    foreign: tuple[Path, ...]

    @property
    def is_sound(self) -> bool:
        """Whether all that the database refers to can be read."""
        return not self.damaged and not self.missing


class ContentStore:
    """A folder of files that are named by their content.

    Parameters
    ----------
    folder
        Beside the database, or on a share. It is made when the first file is stored.
    identity
        Of the store that is expected there, as the database keeps it. With it, an empty folder is
        that of a share that is not mounted; nothing is written there.
    """

    def __init__(self, folder: Path, identity: str | None = None) -> None:
        self.folder = folder
        self._identity = identity

    def identity(self) -> str:
        """Return the name of this store, which is made if there is none.

        Raises
        ------
        Unreachable
            When the folder does not answer, or holds another store than the database knows.
        OutputError
            When the folder cannot be made.
        """
        self._check_identity()
        if self._identity is None:
            with self._answering():
                self._identity = self._read_identity() or self._make_identity()
        return self._identity

    def path(self, sha256: str) -> Path:
        """Return where a content is stored, whether or not it is there.

        Raises
        ------
        DamagedContent
            When the text is no SHA-256; it never becomes part of a path.
        """
        return self.folder / _checked(sha256)[:2] / sha256

    def put(self, content: bytes | Path) -> str:
        """Store a content and return its SHA-256, in hexadecimal.

        When the function returns, the file is on the disk, also after a power failure. A content
        that is there already is not written again, unless it was damaged.

        Raises
        ------
        InputError
            When the given file cannot be read, or changes meanwhile.
        OutputError
            When the store cannot be written, such as on a full disk.
        Unreachable
            When the folder does not answer.
        """
        self.identity()
        sha256 = _digest_of(content)
        path = self.path(sha256)
        with self._answering():
            if self._is_kept(path):
                return sha256
            self._make_folder(path.parent)
            with replacing_file(path) as beside:
                if _write(content, beside) != sha256:
                    raise InputError(
                        "{path} was changed while it was being stored; try again.",
                        path=str(content),
                    )
        return sha256

    def receive(self, sha256: str, write: Callable[[BinaryIO], object]) -> None:
        """Store a content that somebody else writes, such as a backup; not if it is there.

        Raises
        ------
        DamagedContent
            When what was written is something else.
        OutputError, Unreachable
            As for `put`.
        """
        self.identity()
        path = self.path(sha256)
        with self._answering():
            if self._is_kept(path):
                return
            self._make_folder(path.parent)
            with replacing_file(path) as beside:
                with beside.open("wb") as file:
                    write(file)
                if sha256_of(beside) != sha256:
                    raise self._changed(sha256)

    def read(self, sha256: str) -> bytes:
        """Return a content, verified.

        Raises
        ------
        DamagedContent
            When it is missing, or was changed on the disk.
        Unreachable
            When the folder does not answer.
        """
        with self._opened(sha256) as file, self._answering():
            content = b"".join(blocks_of(file, MOST_BYTES))
        if hashlib.sha256(content).hexdigest() != sha256:
            raise self._changed(sha256)
        return content

    def open(self, sha256: str) -> BinaryIO:
        """Return a file to read a content from, which was verified when it was opened.

        Raises
        ------
        DamagedContent, Unreachable
            As for `read`.
        """
        file = self._opened(sha256)
        try:
            with self._answering():
                is_intact = _digest_of_file(file) == sha256
            if not is_intact:
                raise self._changed(sha256)
            file.seek(0)
        except BaseException:
            file.close()
            raise
        return file

    def copy_to(self, sha256: str, path: Path) -> None:
        """Write a verified copy of a content for somebody else.

        Raises
        ------
        DamagedContent, Unreachable
            As for `read`.
        OutputError
            When the place cannot be written.
        """
        with self.open(sha256) as file, replacing_file(path) as beside, beside.open("wb") as copy:
            for block in blocks_of(file, MOST_BYTES):
                copy.write(block)

    def digests(self) -> Iterator[str]:
        """Yield the name of every stored content.

        Raises
        ------
        Unreachable
            When the folder does not answer.
        """
        for path in self._files():
            if self._is_in_place(path):
                yield path.name

    def sweep(self, used: Collection[str], now: float, grace_s: float = GRACE_S) -> SweptContents:
        """Set aside what no row refers to, and delete what was set aside a grace time ago.

        Parameters
        ----------
        used
            What rows of the database refer to, read before the call.
        now
            Seconds since 1970. A file from the future, as after a jump of the clock, stays.

        Raises
        ------
        Unreachable
            When the folder does not answer.
        OutputError
            When a file cannot be moved.
        """
        self._check_identity()
        with self._answering():
            brought_back, deleted = self._empty_removed(used, now - grace_s)
            unused = [path for path in self._files() if self._is_in_place(path)]
            unused = [p for p in unused if p.name not in used and _is_before(p, now - grace_s)]
            set_aside = sum(self._set_aside(path, now) for path in unused)
        return SweptContents(set_aside, deleted, brought_back)

    def discard(self, digests: Collection[str]) -> None:
        """Delete contents of somebody who was erased, to which no row refers any more.

        One that was stored within the last hour is left to the sweeps: a row for it may be coming.

        Raises
        ------
        Unreachable
            When the folder does not answer.
        OutputError
            When a file cannot be deleted.
        """
        self._check_identity()
        before = time.time() - _IN_WORK_S
        with self._answering():
            for sha256 in digests:
                for path in (self.path(sha256), self._removed(sha256)):
                    if path.is_file() and _is_before(path, before):
                        with output_errors(path):
                            path.unlink(missing_ok=True)

    def verify(self, used: Mapping[str, int], progress: Progress = SILENT) -> ContentReport:
        """Read every file and compare it with its name.

        Parameters
        ----------
        used
            Size in bytes of every content that the database refers to, by SHA-256.

        Raises
        ------
        Unreachable
            When the folder does not answer.
        Cancelled
        """
        self._check_identity()
        with self._answering():
            files = sorted(self._files())
            damaged, seen, foreign, total = [], set(), [], 0
            for number, path in enumerate(files):
                progress.step(number / len(files), "Verifying the files of the record")
                if not self._is_in_place(path):
                    foreign.append(path)
                    continue
                is_sound = _is_sound(path)
                try:
                    total += path.stat().st_size
                except FileNotFoundError:  # swept since the folder was listed
                    continue
                seen.add(path.name)
                if not is_sound:
                    damaged.append(path.name)
        missing = sorted(
            sha256 for sha256 in used if sha256 not in seen and not self._restore(sha256)
        )
        unused = sorted(seen.difference(used))
        return ContentReport(
            len(seen), total, tuple(damaged), tuple(missing), tuple(unused), tuple(foreign)
        )

    def _check_identity(self) -> None:
        """Check that the folder holds the expected store, if one is expected.

        Raises
        ------
        Unreachable
        """
        with self._answering():
            if self._identity is not None and self._read_identity() != self._identity:
                raise Unreachable(
                    "{folder} does not hold the files of this record; connect the disk or the "
                    "share that holds them, then try again.",
                    folder=self.folder,
                )

    def _read_identity(self) -> str | None:
        try:
            with open_regular(self.folder / IDENTITY_FILE) as file:
                return b"".join(blocks_of(file, 100)).decode("ascii", "replace").strip()
        except (FileNotFoundError, NotADirectoryError):
            return None

    def _make_identity(self) -> str:
        identity = str(uuid.uuid4())
        with output_errors(self.folder):
            make_private_folder(self.folder)
            sync(self.folder.parent)
        with replacing_file(self.folder / IDENTITY_FILE) as beside:
            beside.write_text(identity, "ascii", newline="\n")
        return identity

    def _make_folder(self, folder: Path) -> None:
        if not folder.is_dir():
            with output_errors(folder):
                make_private_folder(folder)
                sync(folder.parent)

    def _is_kept(self, path: Path) -> bool:
        """Return whether a content is stored and sound; its grace time starts anew."""
        try:
            os.utime(path)
            return sha256_of(path) == path.name
        except FileNotFoundError:
            return False

    def _opened(self, sha256: str) -> BinaryIO:
        path = self.path(sha256)
        with self._answering():
            try:
                return open_regular(path)
            except (FileNotFoundError, NotADirectoryError):
                if not self._restore(sha256):
                    raise self._missing(sha256) from None
                return open_regular(path)

    def _missing(self, sha256: str) -> RecordsError:
        """Return what is wrong with a content that is not there: it alone, or the whole store."""
        try:
            self._check_identity()
        except Unreachable as error:
            return error
        return DamagedContent(
            "The file {name} of the record is missing in {folder}; restore it from a backup.",
            name=sha256[:12],
            folder=self.folder,
        )

    def _changed(self, sha256: str) -> DamagedContent:
        return DamagedContent(
            "{path} was changed since the record stored it; restore it from a backup.",
            path=self.path(sha256),
        )

    def _files(self) -> Iterator[Path]:
        """Yield all files of the folder that are neither unfinished nor removed."""
        if not self.folder.is_dir():  # nothing was stored yet
            return
        for place, folders, names in os.walk(self.folder, onerror=_raise):
            folders[:] = [name for name in folders if name != REMOVED_FOLDER]
            for name in names:
                path = Path(place, name)
                own = (self.folder / IDENTITY_FILE, self.folder / HEAD_FILE)
                if not is_temporary(name) and path not in own:
                    yield path

    def _is_in_place(self, path: Path) -> bool:
        return _SHA256.fullmatch(path.name) is not None and path == self.path(path.name)

    def _removed(self, sha256: str) -> Path:
        return self.folder / REMOVED_FOLDER / sha256

    def _set_aside(self, path: Path, now: float) -> bool:
        """Move a content to the removed ones; return whether it was still there."""
        aside = self._removed(path.name)
        with output_errors(aside):
            self._make_folder(aside.parent)
            try:
                os.utime(path, (now, now))
                path.replace(aside)
            except FileNotFoundError:  # another station sweeps too
                return False
        return True

    def _restore(self, sha256: str) -> bool:
        """Bring a removed content back; return whether there was one."""
        path, aside = self.path(sha256), self._removed(sha256)
        if not aside.is_file():
            return False
        with output_errors(path):
            self._make_folder(path.parent)
            try:
                os.utime(aside)
                aside.replace(path)
            except FileNotFoundError:  # another station was first
                return path.is_file()
            sync(path.parent)
        return True

    def _empty_removed(self, used: Collection[str], before: float) -> tuple[int, int]:
        """Return how many removed files were brought back, and how many were deleted."""
        brought_back = deleted = 0
        folder = self.folder / REMOVED_FOLDER
        for path in sorted(folder.iterdir()) if folder.is_dir() else ():
            if path.name in used:
                brought_back += self._restore(path.name)
            elif _is_before(path, before):
                with output_errors(path), suppress(FileNotFoundError):  # another station was first
                    path.unlink()
                    deleted += 1
        return brought_back, deleted

    @contextmanager
    def _answering(self) -> Iterator[None]:
        """Say that the folder does not answer, whoever noticed it.

        Raises
        ------
        Unreachable
        """
        try:
            yield
        except RecordsError:
            raise
        except (OSError, OutputError) as error:
            system = error.__cause__ if isinstance(error, OutputError) else error
            if not isinstance(system, OSError) or (
                system is not error and system.errno not in _AWAY
            ):
                raise
            raise Unreachable(
                "{folder} does not answer ({reason}); check that its disk or share is connected "
                "and that you may use it.",
                folder=self.folder,
                reason=system.strerror or str(system),
            ) from error


def _checked(sha256: str) -> str:
    if _SHA256.fullmatch(sha256) is None:
        raise DamagedContent(
            'The record refers to a file by "{name}", which is no SHA-256; restore the database '
            "from a backup.",
            name=sha256[:80],
        )
    return sha256


def _digest_of(content: bytes | Path) -> str:
    if isinstance(content, bytes):
        return hashlib.sha256(content).hexdigest()
    with given_errors(content, MOST_BYTES):
        return sha256_of(content, MOST_BYTES)


def _digest_of_file(file: BinaryIO) -> str:
    digest = hashlib.sha256()
    for block in blocks_of(file, MOST_BYTES):
        digest.update(block)
    return digest.hexdigest()


def _write(content: bytes | Path, beside: Path) -> str:
    """Write a content into an unfinished file; return the SHA-256 of what was written."""
    if isinstance(content, bytes):
        beside.write_bytes(content)
        return hashlib.sha256(content).hexdigest()
    digest = hashlib.sha256()
    with open_regular(content) as source, beside.open("wb") as copy:
        for block in blocks_of(source, MOST_BYTES):
            copy.write(block)
            digest.update(block)
    return digest.hexdigest()


def _is_sound(path: Path) -> bool:
    try:
        return sha256_of(path) == path.name
    except OSError as error:
        if error.errno in _AWAY:
            raise
        return False  # a folder of that name, or a file that may not be read


def _is_before(path: Path, time_s: float) -> bool:
    """Return whether a file is older; one that another station has just swept is not."""
    try:
        return path.stat().st_mtime < time_s
    except FileNotFoundError:
        return False


def _raise(error: OSError) -> None:
    raise error
