"""Zip archives of unknown origin: nothing is inflated past a limit, and nothing is ambiguous."""

from __future__ import annotations

import io
import struct
import zipfile
import zlib
from pathlib import Path
from typing import BinaryIO

from insole_core.errors import InputError, unreadable
from insole_core.regular_file import open_regular

_LOCAL_HEADER = struct.Struct("<4s22xHH")
_ENCRYPTED = 0x1
_PACKINGS = (zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED)
_UNREADABLE = (
    zipfile.BadZipFile, OSError, EOFError, ValueError, RuntimeError, NotImplementedError,
    struct.error, OverflowError,
)  # fmt: skip

_ABSENT = (FileNotFoundError, NotADirectoryError, IsADirectoryError, PermissionError)


class DamagedArchiveError(InputError):
    """The archive, or a file in it, is not what was packed."""


class ZipArchive:
    """The files of an archive, by their names with forward slashes.

    The directory is read once. Files may be read by several threads, and no handle stays open.

    Parameters
    ----------
    name
        Of the archive, for messages.
    source
        Its path, or its content.

    Raises
    ------
    DamagedArchiveError
        When it is no readable archive.
    InputError
        When it is not there or may not be read, is encrypted, holds a name twice, or is packed in
        an unusual way.
    """

    def __init__(self, name: str, source: Path | bytes) -> None:
        self.name = name
        self._source = source
        try:
            with self._opened() as file, zipfile.ZipFile(file) as archive:
                entries = [entry for entry in archive.infolist() if not entry.is_dir()]
        except _ABSENT as error:
            raise unreadable(name, error) from error
        except _UNREADABLE as error:
            raise DamagedArchiveError(
                "{archive} is not a readable zip archive; copy it again from its source.",
                archive=name,
            ) from error
        self._entries: dict[str, zipfile.ZipInfo] = {}
        for entry in entries:
            self._add(entry)

    @property
    def names(self) -> list[str]:
        """Names of all files."""
        return list(self._entries)

    @property
    def stated_bytes(self) -> int:
        """Size of all files together, as the archive states it."""
        return sum(entry.file_size for entry in self._entries.values())

    def read(self, name: str, most_bytes: int) -> bytes:
        """Inflate one file.

        Raises
        ------
        DamagedArchiveError
            When it is damaged.
        InputError
            When it is larger than `most_bytes`, whatever the archive states.
        """
        entry = self._entries[name]
        if entry.file_size > most_bytes:
            raise self._too_large(name, most_bytes)
        try:
            content = self._inflated(entry, most_bytes)
        except (*_UNREADABLE, zlib.error) as error:
            raise self._damaged(name) from error
        if len(content) > most_bytes:
            raise self._too_large(name, most_bytes)
        if len(content) != entry.file_size or zlib.crc32(content) != entry.CRC:
            raise self._damaged(name)
        return content

    def _too_large(self, name: str, most_bytes: int) -> InputError:
        return InputError(
            "{file} is larger than {limit_mb} MB, far more than such a file has; do not use "
            "the archive {archive}.",
            file=name,
            archive=self.name,
            limit_mb=most_bytes // 2**20,
        )

    def _add(self, entry: zipfile.ZipInfo) -> None:
        name = entry.filename.replace("\\", "/")  # some programs for Windows write them
        if entry.flag_bits & _ENCRYPTED:
            raise InputError(
                "{archive} is encrypted; unpack it with its password, and pack it again without.",
                archive=self.name,
            )
        if entry.compress_type not in _PACKINGS:
            raise InputError(
                "{archive} is packed in an unusual way; unpack it, and pack it again as an "
                "ordinary zip archive.",
                archive=self.name,
            )
        if name in self._entries:
            raise InputError(
                "{archive} holds {file} twice, and nothing says which is right; pack it again.",
                archive=self.name,
                file=name,
            )
        self._entries[name] = entry

    def _opened(self) -> BinaryIO:
        if isinstance(self._source, bytes):
            return io.BytesIO(self._source)
        return open_regular(self._source)

    def _inflated(self, entry: zipfile.ZipInfo, most_bytes: int) -> bytes:
        """Read one file at the place that the directory names.

        `zipfile` would read the whole directory anew for every file.
        """
        with self._opened() as file:
            file.seek(entry.header_offset)
            signature, name, extra = _LOCAL_HEADER.unpack(file.read(_LOCAL_HEADER.size))
            if signature != b"PK\x03\x04":
                raise EOFError
            file.seek(name + extra, io.SEEK_CUR)
            packed = file.read(min(entry.compress_size, most_bytes + 2**20))
        if entry.compress_type == zipfile.ZIP_STORED:
            return packed
        return zlib.decompressobj(-zlib.MAX_WBITS).decompress(packed, most_bytes + 1)

    def _damaged(self, name: str) -> InputError:
        return DamagedArchiveError(
            "{file} inside {archive} is damaged; copy the archive again from its source.",
            file=name,
            archive=self.name,
        )
