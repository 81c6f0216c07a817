"""Read the materials of an OBJ: files of colours (MTL) and the pictures that they name."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from insole_core.formats.number_text import floats, plain_text
from insole_core.formats.scan_content import ScanContent
from insole_core.formats.texture import (
    MOST_TEXTURE_BYTES,
    colors_of_shares,
    decode_texture,
    missing_texture,
)
from insole_core.geometry.arrays import ByteArray
from insole_core.messages import Message

_MOST_LIBRARIES, _MOST_LIBRARY_BYTES = 10, 2**20
_MOST_MATERIALS = 100
_OPTIONS = {
    b"-blendu": 1, b"-blendv": 1, b"-boost": 1, b"-mm": 2, b"-o": 3, b"-s": 3, b"-t": 3,
    b"-texres": 1, b"-clamp": 1, b"-bm": 1, b"-imfchan": 1, b"-type": 1, b"-cc": 1,
}  # fmt: skip
"""Numbers of values behind each option of a map."""


@dataclass(frozen=True, eq=False)
class Material:
    """A colour (3,) uint8, a picture (h, w, 3) uint8, both RGB, or neither."""

    color: ByteArray | None = None
    picture: ByteArray | None = None


@dataclass(frozen=True)
class _Entry:
    color: tuple[float, ...] = ()
    picture: str = ""


def read_materials(
    libraries: list[bytes], wanted: set[bytes], source: ScanContent
) -> tuple[dict[bytes, Material], list[Message]]:
    """Read the wanted materials.

    Parameters
    ----------
    libraries
        Lines of the OBJ that name them.

    Returns
    -------
    materials : dict
    notes : list
        What was missing, a sentence each.
    """
    notes: list[Message] = []
    entries: dict[bytes, _Entry] = {}
    for line in libraries[:_MOST_LIBRARIES]:
        name = line.partition(b" ")[2].strip().decode("utf-8", "replace")
        content = source.beside(name, _MOST_LIBRARY_BYTES)
        try:
            entries |= _entries(plain_text(content or b""))
        except ValueError:
            content = None
        if content is None:
            notes.append(
                Message(
                    "The file of colours {library} is not beside the scan or cannot be read; the "
                    "scan has no colours.",
                    library=name[:80],
                )
            )
    used = {name: entry for name, entry in entries.items() if name in wanted}
    if len(used) > _MOST_MATERIALS:
        return {}, notes
    pictures: dict[str, ByteArray | None] = {}
    for name in dict.fromkeys(entry.picture for entry in used.values() if entry.picture):
        content = source.beside(name, MOST_TEXTURE_BYTES)
        pictures[name] = None if content is None else decode_texture(content)
        if pictures[name] is None:
            notes.append(missing_texture(name))
    return {
        name: Material(_color(entry), pictures.get(entry.picture)) for name, entry in used.items()
    }, notes


def _color(entry: _Entry) -> ByteArray | None:
    """Return the colour of a material; None where a picture shows it."""
    if len(entry.color) != 3 or entry.picture or not np.isfinite(entry.color).all():
        return None
    return colors_of_shares(np.array(entry.color))


def _entries(text: bytes) -> dict[bytes, _Entry]:
    found: dict[bytes, _Entry] = {}
    name: bytes | None = None
    for line in text.splitlines():
        key, _, rest = line.strip().partition(b" ")
        if key == b"newmtl":
            name = rest.strip()
            found[name] = _Entry()
        elif name is not None and key == b"Kd":
            found[name] = replace(found[name], color=tuple(floats(rest).tolist()))
        elif name is not None and key == b"map_Kd":
            found[name] = replace(found[name], picture=_picture_name(rest))
    return found


def _picture_name(rest: bytes) -> str:
    """Return what follows the options of a map; the name may hold spaces."""
    words = rest.strip().split(b" ")
    while words and words[0] in _OPTIONS:
        words = words[1 + _OPTIONS[words[0]] :]
    return b" ".join(words).decode("utf-8", "replace")
