"""One folder or zip archive for one order: solids, papers, other files, and `order.json`."""

from __future__ import annotations

import re
import shutil
import zipfile
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from datetime import date, datetime
from pathlib import Path
from typing import Final

from insole_core.cases.case_record import Patient
from insole_core.errors import InputError, UsageError
from insole_core.export.order_verification import read_order, side_in_name
from insole_core.export.shop_order import (
    ORDER_FILE,
    OrderedFile,
    OrderItem,
    OrderTerms,
    Release,
    ShopOrder,
    is_plain_name,
    parse_shop_order,
    serial_number,
    write_shop_order,
)
from insole_core.files.temporary import make_folder, release, remove
from insole_core.files.transaction import Transaction
from insole_core.files.write_errors import output_errors
from insole_core.formats.file_formats import role_of
from insole_core.geometry.side import Side
from insole_core.given_file import given_errors, read_given, sha256_of
from insole_core.messages import Translate
from insole_core.progress import SILENT, Progress
from insole_core.records.author import program_version
from insole_core.solids.checks import Override
from insole_core.solids.order import Part
from insole_core.solids.shop import Shop
from insole_core.strict_json import MOST_BYTES
from insole_core.workflows.make_order import (
    MadeFor,
    OrderChoice,
    files_of,
    ordered_material,
    write_order,
)
from insole_core.workflows.nameless import require_nameless

_MOST_BYTES: Final = 512 * 2**20
_COMPRESSION: Final = 1
"""Of the archive: meshes shrink by half, and higher levels gain 3 % for three times the time."""


@dataclass(frozen=True, eq=False)
class PackedItem:
    """What is ordered for one patient.

    Parameters
    ----------
    parts
        From `make_parts`, with a choice that `makes_alike`.
    choice
        Its pseudonym names the files.
    added
        Files made elsewhere, such as G-code, and the feet that they are for.
    override
        Accepts failed checks.
    made
        Zones or tool paths, from `prepare`; None to make them when the order is written.
    """

    parts: Sequence[Part]
    choice: OrderChoice
    patient: Patient
    added: Mapping[Path, tuple[Side, ...]]
    override: Override | None = None
    made: MadeFor | None = None


@dataclass(frozen=True)
class Ordered:
    """What was written for a shop, for whoever keeps it.

    Parameters
    ----------
    paths
        Of the files that it is made from, or of the whole order.
    number, revision
        Of the order, as its papers have them.
    papers
        Of single files: what was written beside them.
    """

    paths: tuple[Path, ...]
    terms: OrderTerms
    number: str
    revision: int = 1
    papers: tuple[Path, ...] = ()

    @property
    def files(self) -> tuple[Path, ...]:
        """All that was written."""
        return self.paths + self.papers

    @property
    def place(self) -> Path:
        """The folder that they were written to."""
        return self.paths[0].parent


def files_of_package(path: Path, order: ShopOrder) -> tuple[Path, ...]:
    """Return the files that `write_package` has written: the archive, or those in the folder."""
    if path.suffix.lower() == ".zip":
        return (path,)
    return tuple(path / name for name in (ORDER_FILE, *(file.name for file in order.files)))


def write_package(
    items: Iterable[PackedItem],
    path: Path,
    *,
    number: str,
    revision: int = 1,
    shop: Shop,
    now: datetime,
    clinic: str = "",
    released_by: str = "",
    translate: Translate = str,
    progress: Progress = SILENT,
) -> ShopOrder:
    """Write an order as a folder, or as a zip archive if the path ends in ``.zip``.

    Parameters
    ----------
    items
        One for each patient; taken one after the other, so that they may be made meanwhile.
    number
        By which clinic and shop speak of the order.
    revision
        At least; where it takes the place of an order of this number, it is the next one of it.
    released_by
        Name of who releases it, for the drawing.
    translate
        Into the language of the papers.
    now
        With time zone.

    Returns
    -------
    ShopOrder
        The content of its `order.json`.

    Raises
    ------
    DesignError, InputError
        As for `write_order`; when two items have one pseudonym, or a quantity, a date or an added
        file cannot be right.
    OutputError
        When the place cannot be written; nothing is left of the order then.
    """
    is_archive = path.suffix.lower() == ".zip"
    program = f"Insole Studio {program_version()}"
    state = Release(number, max(revision, _revision(path, number)), released_by)
    state.check()
    begun = ShopOrder(state, now.isoformat(timespec="seconds"), program, (), clinic)
    with Transaction() as outputs:
        beside = outputs.file(path) if is_archive else outputs.folder(path, find_foreign_to_order)
        with output_errors(path):
            folder = make_folder(beside.parent, path) if is_archive else beside
        try:
            how = _How(folder, state, shop, translate)
            order = _written(items, begun, how, progress.part(0.0, 0.95))
            progress.step(0.95, "Writing the order")
            if is_archive:
                with output_errors(path):
                    _pack(folder, beside, order)
        finally:
            if is_archive:
                remove(folder)
                release(folder)
    return order


@dataclass(frozen=True, eq=False)
class _How:
    """Where to and in which language the files of an order are written."""

    folder: Path
    release: Release
    shop: Shop
    translate: Translate


def _written(
    items: Iterable[PackedItem], begun: ShopOrder, how: _How, progress: Progress
) -> ShopOrder:
    """Write all files of an order that has no items yet into a folder."""
    today = datetime.fromisoformat(begun.created_at).date()
    written: list[OrderItem] = []
    for item in items:
        _check_item(item, today, written)
        progress.step(0.0, "Writing the order")
        written.append(_write_item(item, how, progress))
    if not written:
        raise UsageError("The order holds nothing; name at least one case.")
    order = replace(begun, items=tuple(written))
    write_shop_order(order, how.folder / ORDER_FILE)
    return order


def _check_item(item: PackedItem, today: date, before: Sequence[OrderItem]) -> None:
    choice = item.choice
    choice.terms.check(today)
    if _stem(choice.pseudonym).casefold() in {
        _stem(other.pseudonym).casefold() for other in before
    }:
        raise InputError(
            "Two patients of the order are called {pseudonym}; give one of them another pseudonym.",
            pseudonym=choice.pseudonym,
        )


def _write_item(item: PackedItem, how: _How, progress: Progress) -> OrderItem:
    choice = replace(item.choice, prescription=False)  # it names the patient
    named = how.folder / f"{_stem(choice.pseudonym)}{choice.suffix}"
    write_order(
        item.parts, choice, named,
        shop=how.shop, patient=item.patient, override=item.override, made=item.made,
        release=how.release, translate=how.translate, progress=progress,
    )  # fmt: skip
    sides = tuple(part.side for part in item.parts)
    files = [
        _listed(path, _sides_of(path, sides))
        for path in files_of(item.parts, choice, named, overridden=item.override is not None)
    ]
    for source, for_sides in item.added.items():
        files.append(_added(source, for_sides, sides, how.folder, item.patient))
    return OrderItem(
        choice.pseudonym,
        choice.kind,
        {part.side: ordered_material(choice, part.insole.design) for part in item.parts},
        choice.terms,
        tuple(files),
        tuple(part.side for part in item.parts if part.insole.foot.mirrored),
        {side: serial_number(how.release, choice.pseudonym, side) for side in sides},
    )


def _added(
    source: Path,
    sides: tuple[Side, ...],
    ordered: tuple[Side, ...],
    folder: Path,
    patient: Patient,
) -> OrderedFile:
    """Copy a file that was made elsewhere into the folder of the order."""
    require_nameless(patient, {"file name": source.stem})
    named = side_in_name(source.name)
    if not set(sides) <= set(ordered) or named not in (None, *sides):
        raise InputError(
            "{file} is given for the {side} foot, which its name or the order contradicts; "
            "correct one of them.",
            file=source.name,
            side=" and ".join(sides),
        )
    target = folder / source.name
    if target.exists() or not is_plain_name(source.name) or source.name == ORDER_FILE:
        raise InputError(
            "{file} cannot be added under this name, which the order has already or which not "
            "every system takes; give it another name.",
            file=source.name,
        )
    content = read_given(source, _MOST_BYTES)
    with output_errors(target):
        target.write_bytes(content)
    return _listed(target, sides)


def _listed(path: Path, sides: tuple[Side, ...]) -> OrderedFile:
    with given_errors(path, _MOST_BYTES):
        size = path.stat().st_size
        return OrderedFile(path.name, role_of(path.name), sides, sha256_of(path), size)


def _sides_of(path: Path, ordered: tuple[Side, ...]) -> tuple[Side, ...]:
    named = side_in_name(path.name)
    return ordered if named is None else (named,)


def _stem(pseudonym: str) -> str:
    """Return a pseudonym as a name of files on every system."""
    return re.sub(r"[^\w .()+-]", "-", pseudonym).strip(" .") or "order"


def _revision(path: Path, number: str) -> int:
    """Return the revision of an order that is written over an earlier one of its number."""
    try:
        before = read_order(path).release
    except InputError:
        return 1
    return before.revision + 1 if before.number == number else 1


def _pack(folder: Path, archive: Path, order: ShopOrder) -> None:
    names = [ORDER_FILE, *(file.name for file in order.files)]
    packing = zipfile.ZIP_DEFLATED
    with zipfile.ZipFile(archive, "w", packing, compresslevel=_COMPRESSION) as packed:
        for name in names:
            info = zipfile.ZipInfo.from_file(folder / name, name, strict_timestamps=False)
            info.compress_type = packing
            info.external_attr = 0o644 << 16
            with (folder / name).open("rb") as source, packed.open(info, "w") as target:
                shutil.copyfileobj(source, target, 2**20)


def find_foreign_to_order(folder: Path) -> str | None:
    """Return the name of a file in a folder that no earlier order put there; None for none."""
    names = sorted(path.name for path in folder.iterdir())
    if not names:
        return None
    if ORDER_FILE not in names:
        return names[0]
    try:
        order = parse_shop_order(ORDER_FILE, read_given(folder / ORDER_FILE, MOST_BYTES))
    except InputError:
        return ORDER_FILE
    known = {ORDER_FILE, *(file.name for file in order.files)}
    return next((name for name in names if name not in known), None)
