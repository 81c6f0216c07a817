"""Arrays in .npz files; of one of unknown origin, what an array says of its size comes first."""

from __future__ import annotations

import io
import math
import tokenize
import zipfile
from collections.abc import Container, Mapping
from typing import Any

import numpy as np
import numpy.typing as npt

from insole_core.errors import InputError
from insole_core.zip_archive import ZipArchive

_SUFFIX = ".npy"
_FAST = 1
"""Level of zlib: surfaces become as small as with numpy's level, 6, in a third of the time."""
_KINDS = "biufU"  # booleans, numbers and text
_HEADERS = {
    (1, 0): np.lib.format.read_array_header_1_0,
    (2, 0): np.lib.format.read_array_header_2_0,
}
_NO_HEADER = (
    ValueError, TypeError, SyntaxError, tokenize.TokenError, KeyError, RecursionError, MemoryError,
)  # fmt: skip


class ArrayError(InputError):
    """An array is not what it says."""


def pack_arrays(arrays: Mapping[str, npt.NDArray[Any]]) -> bytes:
    """Return arrays by name as the bytes of an .npz file; equal arrays give equal bytes."""
    packed = io.BytesIO()
    with zipfile.ZipFile(packed, "w", zipfile.ZIP_DEFLATED, compresslevel=_FAST) as archive:
        for name, array in arrays.items():
            with archive.open(name + _SUFFIX, "w", force_zip64=True) as member:
                np.lib.format.write_array(member, array, allow_pickle=False)
    return packed.getvalue()


def read_arrays(
    name: str, content: bytes, most_bytes: int, only: Container[str] | None = None
) -> dict[str, npt.NDArray[Any]]:
    """Read the arrays of an .npz file: numbers, booleans and text.

    Parameters
    ----------
    name
        Of the file, for messages.
    most_bytes
        All arrays together have no more.
    only
        Names of the arrays to unpack; all by default.

    Raises
    ------
    InputError
        When the file is damaged, larger, or holds anything but such arrays.
    """
    archive = ZipArchive(name, content)
    if archive.stated_bytes > most_bytes:  # reading a file ensures that it is as large as stated
        raise InputError(
            "{path} is larger than {limit_mb} MB, which no file of its kind is; choose another "
            "file.",
            path=name,
            limit_mb=most_bytes // 2**20,
        )
    members = {member.removesuffix(_SUFFIX): member for member in archive.names}
    return {
        key: _array(name, member, archive.read(member, most_bytes))
        for key, member in members.items()
        if only is None or key in only
    }


def _array(name: str, member: str, packed: bytes) -> npt.NDArray[Any]:
    stream = io.BytesIO(packed)
    try:
        shape, is_fortran, dtype = _HEADERS[np.lib.format.read_magic(stream)](stream)
    except _NO_HEADER as error:
        raise _wrong(name, member) from error
    data = packed[stream.tell() :]
    if dtype.kind not in _KINDS or min(shape, default=0) < 0:
        raise _wrong(name, member)
    if math.prod(shape) * dtype.itemsize != len(data):
        raise _wrong(name, member)
    if not data:
        return np.zeros(shape, dtype)
    return np.frombuffer(data, dtype).reshape(shape, order="F" if is_fortran else "C")


def _wrong(name: str, member: str) -> ArrayError:
    return ArrayError(
        "{name}: the array {array} is damaged, or of a kind that does not belong there; restore "
        "the file.",
        name=name,
        array=member.removesuffix(_SUFFIX),
    )
