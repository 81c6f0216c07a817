"""Ways to damage a sound file: its bytes, the values of its JSON, the entries of its archive."""

from __future__ import annotations

import copy
import io
import json
import os
import random
import struct
import zipfile
import zlib
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

from benchmarks._fuzz_pool import Expected

_RAW = {
    "@nan": "NaN",
    "@inf": "-Infinity",
    "@400": "7" * 400,
    "@e400": "1e400",
    "@5000": "7" * 5000,
}
"""Numbers that `json.dumps` cannot write."""
_NO_NUMBERS = ["@nan", "@inf", "@400", "@e400", "@5000", "12", True, None, [], {}]
_LARGE = [1e308, -1e308, 1e30, -1, 0, 1e-300]
_NO_TEXTS = [5, True, [], {}, "\ud800"]
_TEXTS = ["", "x" * 100_000, "\x00", "../../etc/passwd", "{0}{name}", "ﷺ" * 50, "<b>x</b>"]

Mutation = tuple[str, bytes, Expected]


def json_mutations(
    content: Any, large: Expected = "any", optional: tuple[str, ...] = ()
) -> Iterator[Mutation]:
    """Yield JSON texts with one value wrong, missing or doubled.

    Parameters
    ----------
    large
        What is expected of 1e308 in the place of a number.
    optional
        Keys that may be null.
    """
    for path, value in _leaves(content):
        where = ".".join(map(str, path))
        for bad, expected in _replacements(path, value, large, optional):
            yield f"{where} = {str(bad)[:12]}", _with(content, path, bad), expected
        if isinstance(path[-1], str):
            yield f"{where} missing", _without(content, path), "any"
            yield f"{where} twice", _doubled(content, path, value), "refused"


def _replacements(
    path: tuple[Any, ...], value: Any, large: Expected, optional: tuple[str, ...]
) -> Iterator[tuple[Any, Expected]]:
    if isinstance(value, bool):
        yield from _each((0, "yes", [], "@nan"), "refused")
    elif isinstance(value, int | float):
        yield from (
            (b, "refused") for b in _NO_NUMBERS if b is not None or path[-1] not in optional
        )
        yield from ((bad, large if abs(bad) == 1e308 else "any") for bad in _LARGE)
    elif isinstance(value, str):
        yield from _each(_NO_TEXTS, "refused")
        yield from _each(_TEXTS, "any")
    elif isinstance(value, list):
        yield from _each(({}, "x", 5), "refused")
        yield from _each(([], value * 50, value * 5000, [value]), "any")
    else:
        yield from _each(([], "x", 5), "refused")


def _each(values: Iterable[Any], expected: Expected) -> Iterator[tuple[Any, Expected]]:
    return ((value, expected) for value in values)


def _leaves(content: Any, path: tuple[Any, ...] = ()) -> Iterator[tuple[tuple[Any, ...], Any]]:
    pairs = content.items() if isinstance(content, dict) else enumerate(content[:2])
    for key, value in pairs:
        yield (*path, key), value
        if isinstance(value, dict | list):
            yield from _leaves(value, (*path, key))


def _with(content: Any, path: tuple[Any, ...], bad: Any) -> bytes:
    changed = copy.deepcopy(content)
    _parent(changed, path)[path[-1]] = bad
    return _text(changed)


def _without(content: Any, path: tuple[Any, ...]) -> bytes:
    changed = copy.deepcopy(content)
    del _parent(changed, path)[path[-1]]
    return _text(changed)


def _doubled(content: Any, path: tuple[Any, ...], value: Any) -> bytes:
    changed = copy.deepcopy(content)
    parent = _parent(changed, path)
    parent["@twice"] = value
    key = json.dumps(str(path[-1]))
    return _text(changed).replace(b'"@twice"', key.encode())


def _parent(content: Any, path: tuple[Any, ...]) -> Any:
    for key in path[:-1]:
        content = content[key]
    return content


def _text(content: Any) -> bytes:
    text = json.dumps(content)
    for mark, raw in _RAW.items():
        text = text.replace(f'"{mark}"', raw)
    return text.encode()


def byte_mutations(
    content: bytes, rng: random.Random, flips: int, cuts: int, flipped: Expected = "any"
) -> Iterator[Mutation]:
    """Yield a file cut off at some places, with bits flipped, and replaced as a whole."""
    for _ in range(cuts):
        at = rng.randrange(len(content))
        yield f"cut at {at}", content[:at], "refused"
    for _ in range(flips):
        at, bit = rng.randrange(len(content)), rng.randrange(8)
        yield f"bit {bit} of {at}", flipped_bit(content, at, bit), flipped
    wrong = {
        "empty": b"",
        "zeros": bytes(4096),
        "text": b"Not what was asked for.\n" * 50,
        "deep": b"[" * 100_000,
        "deep objects": b'{"a":' * 100_000,
        "UTF-16": "{}".encode("utf-16"),
        "no UTF-8": b'{"a": "\xff\xfe"}',
        "list": b"[]",
        "number": b"7" * 5000,
        "zip": empty_zip(),
    }
    for name, bad in wrong.items():
        yield name, bad, "refused"


def flipped_bit(content: bytes, at: int, bit: int) -> bytes:
    return content[:at] + bytes([content[at] ^ 1 << bit]) + content[at + 1 :]


def empty_zip() -> bytes:
    packed = io.BytesIO()
    zipfile.ZipFile(packed, "w").close()
    return packed.getvalue()


PLACES: dict[str, Callable[[Path], None]] = {
    "missing": lambda path: None,
    "folder": lambda path: path.mkdir(),
    "FIFO": os.mkfifo,
    "link to itself": lambda path: path.symlink_to(path.name),
    "link to zeros": lambda path: path.symlink_to("/dev/zero"),
}
"""What can stand where a file is expected."""


@dataclass(frozen=True)
class Zeros:
    """The content of a file that is nothing but zeros, and shrinks to a thousandth."""

    size: int


BOMB = Zeros(300 * 2**20)


def zip_of(
    entries: Sequence[tuple[str, bytes | Zeros]], compress: int = zipfile.ZIP_DEFLATED
) -> bytes:
    import warnings

    packed = io.BytesIO()
    with warnings.catch_warnings(), zipfile.ZipFile(packed, "w", compress) as archive:
        warnings.simplefilter("ignore")  # of entries of the same name
        for name, content in entries:
            if isinstance(content, Zeros):
                _append_zeros(archive, name, content.size)
            else:
                archive.writestr(name, content)
    return packed.getvalue()


def _append_zeros(archive: zipfile.ZipFile, name: str, size: int) -> None:
    """Append an entry that was compressed once for all archives."""
    file = archive.fp
    assert file is not None
    info = zipfile.ZipInfo(name)
    packed, info.CRC = _deflated(size)
    info.compress_type, info.compress_size, info.file_size = 8, len(packed), size
    info.header_offset = file.tell()
    file.write(info.FileHeader() + packed)
    archive.filelist.append(info)
    archive.NameToInfo[name] = info
    archive.start_dir = file.tell()


@cache
def _deflated(size: int) -> tuple[bytes, int]:
    """Return so many zeros as zip archives keep them, and their check sum."""
    packer, check, block = zlib.compressobj(wbits=-15), 0, bytes(2**20)
    packed = []
    for at in range(0, size, len(block)):
        part = block[: size - at]
        packed.append(packer.compress(part))
        check = zlib.crc32(part, check)
    return b"".join([*packed, packer.flush()]), check


def entries_of(archive: bytes) -> list[tuple[str, bytes]]:
    with zipfile.ZipFile(io.BytesIO(archive)) as opened:
        return [(name, opened.read(name)) for name in opened.namelist()]


def zip_mutations(archive: bytes, rng: random.Random) -> Iterator[Mutation]:
    """Yield archives that are odd as archives; their files are sound."""
    entries = entries_of(archive)
    extra = ("__MACOSX/._manifest.json", b"\x00\x05\x16\x07")
    yield "as it is", archive, "accepted"
    yield "Mac folder", zip_of([*entries, extra]), "accepted"
    top = [(f"top/{name}", content) for name, content in entries]
    yield "top folder", zip_of(top), "accepted"
    yield "top and Mac folder", zip_of([*top, extra, ("__MACOSX/top/._x", b"x")]), "accepted"
    windows = [(name.replace("/", "\\"), content) for name, content in entries]
    yield "backslashes", raw_names(zip_of(entries), b"/", b"\\"), "accepted"
    yield "backslashes and a folder", zip_of([("a\\b", b""), *windows]), "any"
    yield "encrypted", encrypted(archive), "refused"
    yield "an entry twice", zip_of([*entries, entries[0]]), "refused"
    yield "all entries twice", zip_of([*entries, *entries]), "refused"
    yield "out of it", zip_of([*entries, ("../../x", b"x")]), "refused"
    yield "absolute", zip_of([*entries, ("/etc/x", b"x")]), "refused"
    yield "drive", zip_of([*entries, ("C:\\x", b"x")]), "refused"
    yield "100 001 files", zip_of([*entries, *((f"{n}", b"") for n in range(100_001))]), "refused"
    yield "unknown compression", with_method(archive, 99), "refused"
    yield "LZMA", zip_of(entries, zipfile.ZIP_LZMA), "any"
    yield "BZIP2", zip_of(entries, zipfile.ZIP_BZIP2), "any"
    yield (
        "surrogates",
        zip_of([*entries, ("x\udc80".encode("utf-8", "replace").decode(), b"")]),
        "any",
    )
    yield "self-extracting", b"MZ" + bytes(1000) + archive, "any"
    yield "trailing bytes", archive + bytes(1000), "any"
    for name, content in entries:
        others = [entry for entry in entries if entry[0] != name]
        read = content and not name.startswith("truth")  # which only the tests look at
        yield f"bomb in {name}", zip_of([*others, (name, BOMB)]), "refused" if read else "any"
        yield f"lying size of {name}", lying_size(archive, name, rng), "any"


def encrypted(archive: bytes) -> bytes:
    """Set the flag of encryption at every entry."""
    return _patched(archive, 6, 8, lambda flags: flags | 1)


def with_method(archive: bytes, method: int) -> bytes:
    return _patched(archive, 8, 10, lambda _method: method)


def _patched(archive: bytes, local: int, central: int, change: Callable[[int], int]) -> bytes:
    content = bytearray(archive)
    for signature, offset in ((b"PK\x03\x04", local), (b"PK\x01\x02", central)):
        at = content.find(signature)
        while at >= 0:
            (value,) = struct.unpack_from("<H", content, at + offset)
            struct.pack_into("<H", content, at + offset, change(value))
            at = content.find(signature, at + 4)
    return bytes(content)


def raw_names(archive: bytes, old: bytes, new: bytes) -> bytes:
    """Replace a character in the names of all entries, which `zipfile` would not write."""
    content = bytearray(archive)
    for signature, length_at, name_at in ((b"PK\x03\x04", 26, 30), (b"PK\x01\x02", 28, 46)):
        at = content.find(signature)
        while at >= 0:
            (length,) = struct.unpack_from("<H", content, at + length_at)
            name = slice(at + name_at, at + name_at + length)
            content[name] = content[name].replace(old, new)
            at = content.find(signature, at + 4)
    return bytes(content)


def lying_size(archive: bytes, name: str, rng: random.Random) -> bytes:
    """State another uncompressed size of an entry in the directory of the archive."""
    content = bytearray(archive)
    at = content.find(b"PK\x01\x02")
    while at >= 0:
        (length,) = struct.unpack_from("<H", content, at + 28)
        if content[at + 46 : at + 46 + length] == name.encode():
            struct.pack_into("<I", content, at + 24, rng.randrange(1, 2**32 - 2))
        at = content.find(b"PK\x01\x02", at + 4)
    return bytes(content)
