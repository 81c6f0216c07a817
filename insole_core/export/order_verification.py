"""Opening an order again: what is missing, changed, added, or of a wrong side.

`order.json` holds a digest of all that it says, the SHA-256 and size of every file, and each job
sheet the terms that it was written with.

An archive is read where it lies and never unpacked, so that no name in it leads anywhere.
"""

from __future__ import annotations

import hashlib
import re
from collections.abc import Iterator, Mapping
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Final, Protocol

from insole_core.errors import InputError
from insole_core.export.sheet_terms import SheetTerms, sheet_terms, terms_in
from insole_core.export.shop_order import (
    DIGEST_KEY,
    MADE_FROM,
    ORDER_FILE,
    OrderedFile,
    OrderItem,
    Release,
    ShopOrder,
    digest_of_order,
    is_plain_name,
    parse_shop_order,
)
from insole_core.geometry.side import Side
from insole_core.given_file import given_errors, read_given, sha256_of
from insole_core.json_object import JsonObject
from insole_core.messages import Message, counted
from insole_core.progress import SILENT, Progress
from insole_core.regular_file import is_folder
from insole_core.strict_json import MOST_BYTES
from insole_core.zip_archive import DamagedArchiveError, ZipArchive

MOST_BYTES_OF_A_FILE: Final = 512 * 2**20
MOST_BYTES_OF_AN_ORDER: Final = 4 * 2**30
MOST_BYTES_OF_A_PAPER: Final = 64 * 2**20
MOST_FILES: Final = 20_000
_SYSTEM_FILES: Final = frozenset({".ds_store", "thumbs.db", "desktop.ini"})
"""What file managers put into folders by themselves."""


@dataclass(frozen=True)
class Verification:
    """An order that was opened, and one sentence for everything that is wrong with it.

    Parameters
    ----------
    has_digest
        Whether `order.json` has a digest of what it says; those of earlier versions have none.
    sheets
        Number of job sheets whose terms were compared with it.
    """

    order: ShopOrder
    problems: tuple[Message, ...]
    has_digest: bool
    sheets: int

    def compared(self) -> Message:
        """Return what was compared and is as it was written."""
        files = counted(len(self.order.files), "1 file", "{count} files")
        sheets = counted(self.sheets, "1 job sheet", "{count} job sheets")
        if self.has_digest:
            return Message(
                "Unchanged: {files}; all that {order} says (quantities, materials, texts, dates, "
                "names of programs); the terms on {sheets}.",
                files=files,
                order=ORDER_FILE,
                sheets=sheets,
            )
        return Message(
            "Unchanged: {files}; the terms on {sheets}. {order} was written by an earlier version "
            "of the program, without a digest of its own: compare quantities, materials and texts "
            "with what the clinic has sent.",
            files=files,
            order=ORDER_FILE,
            sheets=sheets,
        )


class _Source(Protocol):
    """The files of an order, in a folder or in an archive."""

    def names(self) -> list[str]:
        """Return the names of all files."""
        ...

    def order_text(self) -> bytes:
        """Return the content of `order.json`."""
        ...

    def digest(self, name: str) -> tuple[str, int]:
        """Return SHA-256 and bytes of a file; raises `InputError` when it cannot be read."""
        ...

    def content(self, name: str) -> bytes:
        """Return a paper; raises `InputError` when it cannot be read."""
        ...


class _Folder:
    def __init__(self, path: Path) -> None:
        self._path = path

    def names(self) -> list[str]:
        with given_errors(self._path, MOST_BYTES):
            found = sorted(self._path.iterdir())
        return [f"{path.name}/" if path.is_dir() else path.name for path in found]

    def order_text(self) -> bytes:
        return read_given(self._path / ORDER_FILE, MOST_BYTES)

    def digest(self, name: str) -> tuple[str, int]:
        path = self._path / name
        with given_errors(path, MOST_BYTES_OF_A_FILE):
            return sha256_of(path, MOST_BYTES_OF_A_FILE), path.stat().st_size

    def content(self, name: str) -> bytes:
        return read_given(self._path / name, MOST_BYTES_OF_A_PAPER)


class _Archive:
    def __init__(self, path: Path) -> None:
        self._archive = ZipArchive(path.name, path)
        if self._archive.stated_bytes > MOST_BYTES_OF_AN_ORDER:
            raise InputError(
                "{archive} unpacks to more than {limit_gb} GB, far more than an order has; do not "
                "unpack it, and ask the clinic for another one.",
                archive=path.name,
                limit_gb=MOST_BYTES_OF_AN_ORDER // 2**30,
            )

    def names(self) -> list[str]:
        return sorted(self._archive.names)

    def order_text(self) -> bytes:
        return self._archive.read(ORDER_FILE, MOST_BYTES)

    def digest(self, name: str) -> tuple[str, int]:
        content = self._archive.read(name, MOST_BYTES_OF_A_FILE)
        return hashlib.sha256(content).hexdigest(), len(content)

    def content(self, name: str) -> bytes:
        return self._archive.read(name, MOST_BYTES_OF_A_PAPER)


def verify_order(path: Path, progress: Progress = SILENT) -> Verification:
    """Open an order again, and compare every file with `order.json`.

    Parameters
    ----------
    path
        Folder or zip archive.

    Raises
    ------
    InputError
        When it is no order, its archive or `order.json` is damaged, or it comes from a newer
        version.
    Cancelled
    """
    source, names, order, content = _opened(path)
    sheets = list(_sheets(source, order, frozenset(names)))
    problems = [
        *_problems_of_content(content, any(stated is not None for _, _, stated in sheets)),
        *(problem for sheet in sheets for problem in _problems_of_sheet(order.release, *sheet)),
        *_problems_of_files(source, order, frozenset(names), progress),
        *(problem for item in order.items for problem in _problems_of_sides(item)),
        *_additional(order, names),
    ]
    compared = sum(stated is not None for _, _, stated in sheets)
    return Verification(order, tuple(problems), DIGEST_KEY in content, compared)


def read_order(path: Path) -> ShopOrder:
    """Read the `order.json` of an order, without comparing its files.

    Raises
    ------
    InputError
        As for `verify_order`.
    """
    return _opened(path)[2]


def ordered_content(path: Path, file: OrderedFile) -> bytes:
    """Return a file of the order in a folder or zip archive, as it was written.

    Raises
    ------
    InputError
        When it cannot be read, or is another one than `order.json` lists.
    """
    if is_folder(path):
        content = read_given(path / file.name, MOST_BYTES_OF_A_FILE)
    else:
        content = ZipArchive(path.name, path).read(file.name, MOST_BYTES_OF_A_FILE)
    if hashlib.sha256(content).hexdigest() != file.sha256:
        raise InputError(
            "{file} in {order} has been changed since the order was written; ask the clinic to "
            "send the order again.",
            file=file.name,
            order=path,
        )
    return content


def _opened(path: Path) -> tuple[_Source, list[str], ShopOrder, Mapping[str, Any]]:
    """Return an order with the names of all its files but those of file managers.

    The last value is all that its `order.json` says, also with keys of later versions.
    """
    source: _Source = _Folder(path) if is_folder(path) else _Archive(path)
    names = [name for name in source.names() if name.casefold() not in _SYSTEM_FILES]
    if len(names) > MOST_FILES:
        raise InputError(
            "{path} holds {count} files, far more than an order has; choose another place.",
            path=path,
            count=len(names),
        )
    if ORDER_FILE not in names:
        raise InputError(
            "{path} holds no {file}, so that it is no order; choose the folder or zip archive of "
            "an order.",
            path=path,
            file=ORDER_FILE,
        )
    name, text = f"{path.name}/{ORDER_FILE}", source.order_text()
    return source, names, parse_shop_order(name, text), JsonObject.parse(name, text).values


def _problems_of_content(content: Mapping[str, Any], is_expected: bool) -> Iterator[Message]:
    """Say whether what `order.json` says is what was written; a digest may be expected in it."""
    is_expected |= DIGEST_KEY in content
    if is_expected and content.get(DIGEST_KEY) != digest_of_order(content):
        yield Message(
            "{file} has been changed since the order was written: quantities, materials, texts or "
            "names in it may be wrong; ask the clinic to send the order again.",
            file=ORDER_FILE,
        )


def _sheets(
    source: _Source, order: ShopOrder, names: frozenset[str]
) -> Iterator[tuple[OrderItem, OrderedFile, SheetTerms | None]]:
    """Yield each job sheet that is there, its item, and the terms it was written with."""
    for item in order.items:
        for file in item.files:
            if file.role == "job_sheet" and file.name in names:
                with suppress(InputError):  # told with the other files
                    yield item, file, terms_in(source.content(file.name))


def _problems_of_sheet(
    release: Release, item: OrderItem, file: OrderedFile, stated: SheetTerms | None
) -> Iterator[Message]:
    """Say which terms on a job sheet are others than in `order.json`."""
    materials = {side: item.materials[side] for side in file.sides}
    ordered = sheet_terms(release, item.pseudonym, materials, item.terms)
    for name, value in ordered.items():
        if stated is not None and stated.get(name, "") != value:
            yield Message(
                "{file} says {stated} for {term}, and {order} says {value}; ask the clinic which "
                "is right.",
                file=file.name,
                stated=f'"{stated.get(name, "")}"',
                term=name,
                order=ORDER_FILE,
                value=f'"{value}"',
            )


def _problems_of_files(
    source: _Source, order: ShopOrder, names: frozenset[str], progress: Progress
) -> Iterator[Message]:
    """Say which files are missing, changed, or exchanged with another one."""
    by_digest = {file.sha256: file for file in order.files}
    for number, file in enumerate(order.files):
        progress.step(number / len(order.files), "Comparing the files")
        if file.name not in names:
            yield Message(
                "{file} is missing; ask the clinic to send the order again.", file=file.name
            )
            continue
        try:
            digest, size = source.digest(file.name)
        except DamagedArchiveError as error:
            yield error.message
            continue
        if digest != file.sha256:
            yield _about_changed(file, by_digest.get(digest))
        elif size != file.size_bytes:
            yield Message(
                "{file} has {size} bytes, and {order} says {stated}; ask the clinic to send the "
                "order again.",
                file=file.name,
                size=size,
                order=ORDER_FILE,
                stated=file.size_bytes,
            )


def _about_changed(file: OrderedFile, real: OrderedFile | None) -> Message:
    if real is not None and real.sides != file.sides:
        return Message(
            "{file} is for the {side} foot, but holds what {real} was for the {real_side}: the "
            "sides are exchanged; do not make it, and ask the clinic to send the order again.",
            file=file.name,
            side=_words(file.sides),
            real=real.name,
            real_side=_words(real.sides),
        )
    if real is not None:
        return Message(
            "{file} holds what {real} was; ask the clinic to send the order again.",
            file=file.name,
            real=real.name,
        )
    return Message(
        "{file} has been changed since the order was written; ask the clinic to send the order "
        "again.",
        file=file.name,
    )


def _problems_of_sides(item: OrderItem) -> Iterator[Message]:
    """Say which files are named after the other foot, and which foot has none to make it from."""
    for file in item.files:
        named = side_in_name(file.name)
        if named is not None and file.sides != (named,):
            yield Message(
                "{file} is named after the {named} foot, and {order} has it for the {side}; ask "
                "the clinic which is right.",
                file=file.name,
                named=str(named),
                order=ORDER_FILE,
                side=_words(file.sides),
            )
    made = {side for file in item.files if file.role in MADE_FROM for side in file.sides}
    for side in item.sides:
        if side not in made:
            yield Message(
                "{pseudonym} orders the {side} foot, and no file is there to make it from; ask "
                "the clinic for it.",
                pseudonym=item.pseudonym,
                side=str(side),
            )


def side_in_name(name: str) -> Side | None:
    """Return the side that is a word in the name of a file; None for neither or both."""
    words = set(re.findall(r"[a-z]+", name.casefold()))
    found = [side for side in Side if str(side) in words]
    return found[0] if len(found) == 1 else None


def _additional(order: ShopOrder, names: list[str]) -> Iterator[Message]:
    known = {ORDER_FILE, *(file.name for file in order.files)}
    for name in names:
        if name in known:
            continue
        if is_plain_name(name.removesuffix("/")):
            yield Message(
                "{file} is not part of the order; leave it out, or ask the clinic about it.",
                file=name,
            )
        else:
            yield Message(
                "{file} leads out of the folder of the order; do not unpack the archive, and ask "
                "the clinic for another one.",
                file=name,
            )


def _words(sides: tuple[Side, ...]) -> str:
    return str(sides[0]) if len(sides) == 1 else "left and right"
