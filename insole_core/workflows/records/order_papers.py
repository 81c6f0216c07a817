"""The papers of an order as files again, to be read and printed."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Final

from insole_core.files.atomic import write_private
from insole_core.files.write_errors import output_errors
from insole_core.records.records import Records
from insole_core.zip_archive import ZipArchive

_PAPER: Final = ".pdf"
_ARCHIVE: Final = ".zip"
_MOST_BYTES: Final = 2**28


def copy_papers(records: Records, order_id: str, folder: Path) -> tuple[Path, ...]:
    """Write the papers of an order's newest revision into a folder, also those in its archive.

    Returns
    -------
    tuple of Path
        Empty where the order was written without papers.

    Raises
    ------
    RecordsError
        When there is no such order, or a file is missing or was changed on the disk.
    InputError
        When its archive cannot be read.
    OutputError
        When they cannot be written.
    """
    papers: list[Path] = []
    for copy in records.orders.copy_files(order_id, folder):
        if copy.suffix.lower() == _PAPER:
            papers.append(copy)
        elif copy.suffix.lower() == _ARCHIVE:
            papers += _unpacked(copy, folder)
    return tuple(papers)


def _unpacked(archive: Path, folder: Path) -> Iterator[Path]:
    packed = ZipArchive(archive.name, archive)
    for name in packed.names:
        if name.lower().endswith(_PAPER):
            place = folder / Path(name).name
            content = packed.read(name, _MOST_BYTES)
            with output_errors(place):
                write_private(place, content)
            yield place
