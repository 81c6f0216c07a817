"""The menu of the pad library, by the part of the foot."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import groupby

from insole_core.workflows.pad_library import GROUPS, LibraryPad
from insole_studio.features.design.correction_names import pad_text
from insole_studio.texts import tr

_GROUP_TITLES: dict[str, Callable[[], str]] = {
    "forefoot": lambda: tr("Forefoot"),
    "midfoot": lambda: tr("Arch and midfoot"),
    "heel": lambda: tr("Heel"),
    "toes": lambda: tr("Toes"),
}
_FAMILY_TITLES: dict[str, Callable[[], str]] = {
    "relief_head": lambda: tr("Relief under a head"),
    "relief_toe": lambda: tr("Relief under a toe"),
    "toe_filler": lambda: tr("Toe filler"),
}


@dataclass(frozen=True)
class PadEntry:
    """A pad of the library: its text and its number there."""

    text: str
    number: int


@dataclass(frozen=True)
class PadMenu:
    """A menu of pads, or of menus of them."""

    title: str
    entries: tuple[PadEntry | PadMenu, ...]


def pad_menu(pads: Sequence[LibraryPad]) -> PadMenu:
    """Return the library by parts of the foot."""
    numbered = list(enumerate(pads))
    parts = [(group, [pad for pad in numbered if pad[1].group == group]) for group in GROUPS]
    menus = [PadMenu(_GROUP_TITLES[group](), _entries(part)) for group, part in parts if part]
    others = [pad for pad in numbered if not pad[1].group]
    return PadMenu(tr("Pad of the library"), (*menus, *_entries(others)))


def _entries(pads: list[tuple[int, LibraryPad]]) -> tuple[PadEntry | PadMenu, ...]:
    """Return an entry for each pad; those of all heads or toes share a menu."""
    entries: list[PadEntry | PadMenu] = []
    for family, members in groupby(pads, lambda pad: _family(pad[1].kind)):
        texts = tuple(PadEntry(pad_text(pad), number) for number, pad in members)
        if family in _FAMILY_TITLES:
            entries.append(PadMenu(_FAMILY_TITLES[family](), texts))
        else:
            entries.extend(texts)
    return tuple(entries)


def _family(kind: str) -> str:
    return kind.rstrip("12345").removesuffix("_")
