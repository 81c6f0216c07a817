"""What every reader of foreign files relies on: bounded, strict, and only regular files."""

from __future__ import annotations

import io
import os
import zipfile
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from odd_archives import encrypted, with_backslashes, with_sizes, zip_of

from insole_core.errors import InputError
from insole_core.given_file import read_given
from insole_core.json_object import JsonObject
from insole_core.stored_arrays import read_arrays
from insole_core.strict_json import MOST_BYTES
from insole_core.zip_archive import DamagedArchiveError, ZipArchive

NO_FILES: dict[str, tuple[Callable[[Path], object], str]] = {
    "folder": (Path.mkdir, "cannot be read: Is a directory"),
    "pipe": (os.mkfifo, "a pipe or a device, no file"),
    "device": (lambda path: path.symlink_to("/dev/zero"), "a pipe or a device, no file"),
    "link to itself": (lambda path: path.symlink_to(path), "cannot be read"),
    "nothing": (lambda _path: None, "cannot be read: No such file"),
    "too much": (lambda path: path.write_bytes(bytes(2**20 + 1)), "is larger than 1 MB"),
}


@pytest.mark.parametrize("what", NO_FILES)
def test_only_regular_files_are_read(tmp_path: Path, what: str) -> None:
    make, words = NO_FILES[what]
    make(tmp_path / "given")
    with pytest.raises(InputError, match=words):
        read_given(tmp_path / "given", 2**20)


def test_a_name_that_no_file_can_have_is_refused() -> None:
    with pytest.raises(InputError, match="cannot be read"):
        read_given(Path("a\0b"), 1)


BAD_JSON = {
    "a key twice": (b'{"a": {"b": 1, "b": 2}}', 'the key "b" stands twice'),
    "half a character": (b'{"a": ["\\ud800"]}', r"half a character \(\\ud800\)"),
    "half a character in a key": (b'{"\\uDC00": 1}', "half a character"),
    "5000 digits": (b'{"a": ' + b"7" * 5000 + b"}", "not valid JSON"),
    "deep": (b'{"a":' * 100_000, "not valid JSON"),
    "too long": (b" " * (MOST_BYTES + 1), "longer than 16 MB"),
}


@pytest.mark.parametrize("what", BAD_JSON)
def test_json_is_strict(what: str) -> None:
    text, words = BAD_JSON[what]
    with pytest.raises(InputError, match=words) as caught:
        JsonObject.parse("file.json", text)
    assert str(caught.value).startswith("file.json")


def test_whole_characters_beyond_the_basic_plane_are_texts() -> None:
    assert JsonObject.parse("file.json", b'{"a": "\\ud83d\\udc63"}').text("a") == "👣"


@pytest.mark.parametrize("number", ["7" * 400, "-" + "7" * 400, "1e400", "NaN"])
def test_numbers_beyond_measure_are_refused_by_their_key(number: str) -> None:
    given = JsonObject.parse("file.json", f'{{"a": {number}}}'.encode())
    with pytest.raises(InputError, match=r"file\.json: a is .{1,40}, but must be a finite number"):
        given.number("a")


ARCHIVE = zip_of(("a.txt", b"x" * 2000), ("b/c.txt", b"y"))
BAD_ARCHIVES = {
    "no archive": (b"nothing", DamagedArchiveError, "not a readable zip archive"),
    "cut off": (ARCHIVE[:-30], DamagedArchiveError, "not a readable zip archive"),
    "encrypted": (encrypted(ARCHIVE), InputError, "is encrypted; unpack it with its password"),
    "a name twice": (zip_of(("a", b"1"), ("a", b"2")), InputError, "holds a twice"),
    "one name in two spellings": (
        zip_of(("a/b", b"1"), ("a\\b", b"2")), InputError, "holds a/b twice",
    ),
    "unusual packing": (
        zip_of(("a", b"1"), packing=zipfile.ZIP_LZMA), InputError, "packed in an unusual way",
    ),
}  # fmt: skip


@pytest.mark.parametrize("what", BAD_ARCHIVES)
def test_archives_are_unambiguous(what: str) -> None:
    content, kind, words = BAD_ARCHIVES[what]
    with pytest.raises(kind, match=words):
        ZipArchive("s.zip", content)


def test_an_archive_is_read_at_the_places_of_its_directory(tmp_path: Path) -> None:
    path = tmp_path / "s.zip"
    path.write_bytes(b"MZ" + bytes(500) + with_backslashes(ARCHIVE))  # as a self-extracting one
    archive = ZipArchive("s.zip", path)
    assert archive.names == ["a.txt", "b/c.txt"]
    assert archive.read("a.txt", 2000) == b"x" * 2000
    assert archive.read("b/c.txt", 1) == b"y"


def test_a_bomb_is_not_inflated_whatever_size_it_states() -> None:
    bomb = zip_of(("a", bytes(5 * 2**20)))
    for content in (bomb, with_sizes(bomb, 10)):
        with pytest.raises(InputError, match="larger than 1 MB"):
            ZipArchive("s.zip", content).read("a", 2**20)


@pytest.mark.parametrize("at", [40, 60])
def test_a_damaged_file_is_named(at: int) -> None:
    content = bytearray(zip_of(("a.txt", bytes(range(256))), packing=zipfile.ZIP_STORED))
    content[at] ^= 8
    with pytest.raises(DamagedArchiveError, match=r"a\.txt inside s\.zip is damaged"):
        ZipArchive("s.zip", bytes(content)).read("a.txt", 1000)


def npy(array: np.ndarray, **header: Any) -> bytes:
    packed = io.BytesIO()
    usual = np.lib.format.header_data_from_array_1_0(array)
    np.lib.format.write_array_header_1_0(packed, {**usual, **header})
    return packed.getvalue() + array.tobytes()


GRID = np.arange(6.0).reshape(2, 3)
BAD_ARRAYS = {
    "more than it holds": npy(GRID, shape=(2, 4)),
    "more than any memory": npy(GRID, shape=(10**14, 9)),
    "less than it holds": npy(GRID, shape=(2,)),
    "negative": npy(GRID, shape=(-2, -3)),
    "Python objects": npy(GRID, descr="|O"),
    "dates": npy(GRID, descr="<M8[s]"),
    "complex": npy(GRID.astype(complex)),
    "records": npy(np.zeros(2, [("a", "i4"), ("b", "f8")])),
    "no header": b"\x93NUMPY\x01\x00\x10\x00{'descr': (((((",
    "nothing": b"",
}


@pytest.mark.parametrize("what", BAD_ARRAYS)
def test_arrays_that_lie_are_refused(what: str) -> None:
    with pytest.raises(InputError, match="the array a is damaged"):
        read_arrays("x.npz", zip_of(("a.npy", BAD_ARRAYS[what])), 2**20)


def test_arrays_come_back_as_they_were() -> None:
    given = {
        "grid": GRID, "turned": np.asfortranarray(GRID), "text": np.array("höger"),
        "number": np.float64(2.5), "none": np.zeros((0, 3), np.int32),
    }  # fmt: skip
    packed = io.BytesIO()
    np.savez_compressed(packed, **given)
    found = read_arrays("x.npz", packed.getvalue(), 2**20)
    assert found.keys() == given.keys()
    for name, array in given.items():
        assert np.array_equal(found[name], array)


def test_all_arrays_together_are_bounded() -> None:
    half = npy(np.zeros(100_000))
    content = zip_of(("a.npy", half), ("b.npy", half))
    for packed in (content, with_sizes(content, 2**20 + 1)):
        with pytest.raises(InputError, match=r"x\.npz is larger than 1 MB"):
            read_arrays("x.npz", packed, 2**20)
