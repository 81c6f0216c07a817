"""`order.json`: what a shop is to make, in which number, and the files it makes it from."""

from __future__ import annotations

import hashlib
import json
import re
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from datetime import date
from pathlib import Path
from typing import Any, Final, get_args

from insole_core.errors import InputError
from insole_core.files.atomic import write_text
from insole_core.formats.file_formats import FileRole
from insole_core.geometry.side import Side
from insole_core.json_object import JsonObject

FORMAT: Final = "insole-order"
VERSION: Final = 1
ORDER_FILE: Final = "order.json"
DIGEST_KEY: Final = "sha256"
MOST_PAIRS: Final = 1000
"""Of one item; more is a slip of the finger."""
_MOST_LETTERS: Final = 200
_MOST_OF_NUMBER: Final = 60
"""As in the clinic's record."""
_MOST_REMARKS: Final = 2000
_MOST_DAYS: Final = 730
_FORBIDDEN_IN_NAMES: Final = re.compile(r'[\x00-\x1f<>:"|?*/\\]')
_DIGEST: Final = re.compile(r"[0-9a-f]{64}")

FILE_ROLES: Final[tuple[FileRole, ...]] = get_args(FileRole)
MADE_FROM: Final[tuple[FileRole, ...]] = ("solid", "gcode")
"""Roles of the files that a machine makes an insole from: each ordered side needs one."""


@dataclass(frozen=True)
class OrderTerms:
    """How the shop is to make and deliver what is ordered.

    Parameters
    ----------
    quantity
        Of the pair, or of the one foot that is ordered.
    colour, cover
        Of the material, and what is glued on top; empty for the shop's usual.
    lot
        Number of the lot of the material; empty where it is not known yet.
    deliver_on
        None where the clinic names no date.
    """

    quantity: int = 1
    colour: str = ""
    cover: str = ""
    remarks: str = ""
    deliver_on: date | None = None
    lot: str = ""

    def check(self, today: date) -> None:
        """Check that a shop could do as the terms say.

        Raises
        ------
        InputError
            Naming the term that cannot be right.
        """
        if not 1 <= self.quantity <= MOST_PAIRS:
            raise InputError(
                "The quantity is {quantity}, and must be 1 to {most}; correct it.",
                quantity=self.quantity,
                most=MOST_PAIRS,
            )
        for name, text, most in self._texts:
            if len(text) > most:
                raise InputError(
                    "The {name} of the order has {count} characters, and the papers take at most "
                    "{most}; shorten it.",
                    name=name,
                    count=len(text),
                    most=most,
                )
        if self.deliver_on is not None:
            _check_delivery(self.deliver_on, today)

    def from_day(self, today: date) -> OrderTerms:
        """Return the terms for an order of today: a delivery date that is past is none."""
        is_past = self.deliver_on is not None and self.deliver_on < today
        return replace(self, deliver_on=None) if is_past else self

    @property
    def facts(self) -> dict[str, str]:
        """The terms by name, for papers; nothing that is not said."""
        day = "" if self.deliver_on is None else self.deliver_on.isoformat()
        facts = {"quantity": str(self.quantity), "delivery date": day}
        facts |= {name: text for name, text, _ in self._texts}
        return {name: text for name, text in facts.items() if text}

    @property
    def _texts(self) -> tuple[tuple[str, str, int], ...]:
        return (
            ("colour", self.colour, _MOST_LETTERS),
            ("cover", self.cover, _MOST_LETTERS),
            ("lot of the material", self.lot, _MOST_OF_NUMBER),
            ("remarks", self.remarks, _MOST_REMARKS),
        )


MOST_REVISIONS: Final = 10**6
"""Of the papers of one order."""


@dataclass(frozen=True)
class Release:
    """Which state of which order is released to the shop.

    Parameters
    ----------
    number
        Of the order; empty for files without one.
    revision
        1 for the first, one more each time the order takes the place of an earlier one.
    by
        Name of who released it; may be empty.
    """

    number: str = ""
    revision: int = 1
    by: str = ""

    def check(self) -> None:
        """Check that the papers can show number and name.

        Raises
        ------
        InputError
            When the number is empty, or one of them is too long or of more than a line.
        """
        if not self.number.strip():
            raise InputError("The order has no number; give it one.")
        texts = (("number", self.number, _MOST_OF_NUMBER), ("released by", self.by, _MOST_LETTERS))
        for name, text, most in texts:
            if len(text) > most or not text.isprintable():
                raise InputError(
                    'The "{name}" of the order must be one line of at most {most} characters; '
                    "shorten it.",
                    name=name,
                    most=most,
                )


def serial_number(release: Release, pseudonym: str, side: Side) -> str:
    """Return the number of a piece: of its order, of the patient, of the revision, and the side."""
    known = dict.fromkeys(filter(None, (release.number, pseudonym)))
    return "-".join((*known, str(release.revision), str(side)[0].upper()))


def _check_delivery(day: date, today: date) -> None:
    if day < today:
        raise InputError(
            "The delivery date {day} is past; choose a day from {today} on.",
            day=day.isoformat(),
            today=today.isoformat(),
        )
    if (day - today).days > _MOST_DAYS:
        raise InputError(
            "The delivery date {day} is more than two years ahead; check the year.",
            day=day.isoformat(),
        )


@dataclass(frozen=True)
class OrderedFile:
    """A file of an order.

    Parameters
    ----------
    name
        In the folder or archive of the order.
    sides
        Of the feet that it is for.
    """

    name: str
    role: FileRole
    sides: tuple[Side, ...]
    sha256: str
    size_bytes: int


@dataclass(frozen=True)
class OrderItem:
    """One or both insoles of one patient, known to the shop by a pseudonym only.

    Parameters
    ----------
    kind
        "insole", "block" or "positive", as an export has it.
    materials
        Of each side that is made.
    mirrored
        Sides whose foot was not scanned: they are the other one's mirror image.
    serials
        Number of the piece of each side; empty in orders of earlier versions.
    """

    pseudonym: str
    kind: str
    materials: Mapping[Side, str]
    terms: OrderTerms
    files: tuple[OrderedFile, ...]
    mirrored: tuple[Side, ...] = ()
    serials: Mapping[Side, str] = field(default_factory=dict)

    @property
    def sides(self) -> tuple[Side, ...]:
        """The sides that are made, left first."""
        return tuple(side for side in Side if side in self.materials)


@dataclass(frozen=True)
class ShopOrder:
    """An order to a shop.

    Parameters
    ----------
    release
        By which number clinic and shop speak of it, which revision it is, and who released it.
    created_at
        ISO 8601 with time zone.
    program
        Name and version of what wrote it.
    """

    release: Release
    created_at: str
    program: str
    items: tuple[OrderItem, ...]
    clinic: str = ""

    @property
    def files(self) -> tuple[OrderedFile, ...]:
        """The files of all items."""
        return tuple(file for item in self.items for file in item.files)


def write_shop_order(order: ShopOrder, path: Path) -> None:
    """Write `order.json`.

    Raises
    ------
    OutputError
        When the place cannot be written.
    """
    content: dict[str, Any] = {
        "format": FORMAT,
        "version": VERSION,
        "number": order.release.number,
        "revision": order.release.revision,
        "released_by": order.release.by,
        "created_at": order.created_at,
        "program": order.program,
        "clinic": order.clinic,
        "items": [_item_json(item) for item in order.items],
    }
    content[DIGEST_KEY] = digest_of_order(content)
    write_text(json.dumps(content, indent=1, ensure_ascii=False) + "\n", path)


def digest_of_order(content: Mapping[str, Any]) -> str:
    """Return the SHA-256 of everything that an `order.json` says, but for its own digest.

    Parameters
    ----------
    content
        The root object, also with keys that this program does not know.
    """
    said = {key: value for key, value in content.items() if key != DIGEST_KEY}
    text = json.dumps(said, sort_keys=True, separators=(",", ":"))
    return hashlib.sha256(text.encode("ascii")).hexdigest()


def _item_json(item: OrderItem) -> dict[str, Any]:
    mirrored = {"mirrored": [str(side) for side in item.mirrored]} if item.mirrored else {}
    serials = {str(side): number for side, number in item.serials.items()}
    return {
        "pseudonym": item.pseudonym,
        "kind": item.kind,
        "sides": [str(side) for side in item.sides],
        "materials": {str(side): item.materials[side] for side in item.sides},
        **mirrored,
        **({"serials": serials} if serials else {}),
        **terms_to_json(item.terms),
        "files": [
            {
                "name": file.name,
                "role": file.role,
                "sides": [str(side) for side in file.sides],
                "sha256": file.sha256,
                "bytes": file.size_bytes,
            }
            for file in item.files
        ],
    }


def terms_to_json(terms: OrderTerms) -> dict[str, Any]:
    """Return terms as plain values for `json.dump`."""
    day = terms.deliver_on
    return vars(terms) | {"deliver_on": None if day is None else day.isoformat()}


def terms_from_json(of: JsonObject) -> OrderTerms:
    """Read terms; the inverse of `terms_to_json`.

    Raises
    ------
    InputError
        Naming the key that is missing or wrong.
    """
    return OrderTerms(
        of.integer("quantity", 1, MOST_PAIRS),
        of.text("colour", empty=True),
        of.text("cover", empty=True),
        of.text("remarks", empty=True),
        None if of.value("deliver_on") is None else _day(of, "deliver_on"),
        of.text("lot", empty=True) if of.has("lot") else "",
    )


def parse_shop_order(name: str, text: bytes) -> ShopOrder:
    """Read `order.json`; every value must be right, unknown keys are passed over.

    Parameters
    ----------
    name
        Of the file, for messages.

    Raises
    ------
    InputError
        Naming the key that is missing or wrong, or when it comes from a newer version.
    """
    root = JsonObject.parse(name, text)
    root.check_format(FORMAT, VERSION)
    items = tuple(_item(item) for item in root.objects("items"))
    if not items:
        raise root.fail("items", "must hold at least one item")
    order = ShopOrder(
        Release(
            root.text("number"),
            root.integer("revision", 1, MOST_REVISIONS) if root.has("revision") else 1,
            root.text("released_by", empty=True) if root.has("released_by") else "",
        ),
        root.date("created_at"),
        root.text("program"),
        items,
        root.text("clinic", empty=True),
    )
    names = [file.name.casefold() for file in order.files]
    twice = next((file for file in order.files if names.count(file.name.casefold()) > 1), None)
    if twice is not None:
        raise root.fail("items", "list the file {file} twice", file=twice.name)
    return order


def _item(item: JsonObject) -> OrderItem:
    sides = _sides(item)
    materials = item.object("materials")
    return OrderItem(
        item.text("pseudonym"),
        item.choice("kind", ("insole", "block", "positive")),
        {side: materials.text(str(side), empty=True) for side in sides},
        terms_from_json(item),
        tuple(_file(file, sides) for file in item.objects("files")),
        _mirrored(item, sides),
        _serials(item, sides),
    )


def _serials(item: JsonObject, ordered: tuple[Side, ...]) -> dict[Side, str]:
    if not item.has("serials"):
        return {}
    serials = item.object("serials")
    return {side: serials.text(str(side)) for side in ordered if serials.has(str(side))}


def _mirrored(item: JsonObject, ordered: tuple[Side, ...]) -> tuple[Side, ...]:
    if not item.has("mirrored"):
        return ()
    named = item.texts("mirrored")
    if not set(named) <= set(ordered):
        raise item.fail("mirrored", "names a side that is not ordered")
    return tuple(side for side in ordered if side in named)


def _file(file: JsonObject, ordered: tuple[Side, ...]) -> OrderedFile:
    name = file.text("name")
    if not is_plain_name(name):
        raise file.fail(
            "name", 'is "{name}", but must be the plain name of a file, without folders', name=name
        )
    digest = file.text("sha256")
    if not _DIGEST.fullmatch(digest):
        raise file.fail("sha256", "must be 64 digits and letters a to f")
    sides = _sides(file)
    if not set(sides) <= set(ordered):
        raise file.fail("sides", "name a foot that the item does not order")
    size = file.integer("bytes", 0, 2**40)
    return OrderedFile(name, file.choice("role", FILE_ROLES), sides, digest, size)


def _sides(of: JsonObject) -> tuple[Side, ...]:
    listed = of.listed("sides")
    sides = [listed.choice(key, tuple(Side)) for key in listed.values]
    if not sides or len(set(sides)) < len(sides):
        raise of.fail("sides", "must name left, right, or both, each once")
    return tuple(side for side in Side if side in sides)


def _day(of: JsonObject, key: str) -> date:
    try:
        return date.fromisoformat(of.text(key))
    except ValueError:
        raise of.fail(key, "must be a day such as 2026-11-20, or null") from None


def is_plain_name(name: str) -> bool:
    """Return whether a name is that of a file in the same folder, on every system."""
    return (
        not _FORBIDDEN_IN_NAMES.search(name)
        and name.strip(". ") != ""
        and not name.endswith((".", " "))
        and len(name.encode()) <= 255
    )
