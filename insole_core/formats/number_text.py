"""Large texts of numbers: written at once; of those that are read, every number is, or none."""

from __future__ import annotations

import re
import warnings

import numpy as np

from insole_core.geometry.arrays import (
    BoolArray,
    ByteArray,
    Float32Array,
    FloatArray,
    IndexArray,
    IntArray,
)
from insole_core.messages import Message

LINE_FEED = ord("\n")
_MOST_RUNS = 20_000
"""Of neighbouring lines that are copied one by one."""
BYTE_ORDER_MARKS = {b"\xff\xfe": "utf-16", b"\xfe\xff": "utf-16", b"\xef\xbb\xbf": "utf-8-sig"}

_INDENTED = re.compile(rb"^[ \t]+", re.MULTILINE)
_DECIMAL_COMMA = re.compile(rb"(?<![^\s+-])\d+,\d")


class DecimalCommaError(ValueError):
    """The numbers of a text have commas where points must stand."""


def plain_text(content: bytes) -> bytes:
    """Return a text with line feeds only, in a code that starts like ASCII.

    Raises
    ------
    ValueError
        When it is no text: it holds zero bytes, or half characters of UTF-16.
    """
    for mark, code in BYTE_ORDER_MARKS.items():
        if content.startswith(mark):
            content = content.decode(code).encode()
            break
    if b"\0" in content:
        raise ValueError(Message("it holds zero bytes, which no text does"))
    if b"\r" in content:
        content = content.replace(b"\r\n", b"\n").replace(b"\r", b"\n")
    return content


def unindented(text: bytes) -> bytes:
    """Return a text of which every line begins with its first word."""
    if text.startswith((b" ", b"\t")) or b"\n " in text or b"\n\t" in text:
        return _INDENTED.sub(b"", text)
    return text


def floats(text: bytes) -> FloatArray:
    """Return all numbers (n,) of a text, separated by white space.

    Raises
    ------
    DecimalCommaError
        When its numbers have commas for points.
    ValueError
        When something else in it is no number.
    """
    return np.asarray(_numbers(text, np.float64), dtype=float)


def integers(text: bytes) -> IntArray:
    """Return all whole numbers (n,) int64 of a text, separated by white space.

    Raises
    ------
    ValueError
        When something in it is no whole number.
    """
    return np.asarray(_numbers(text, np.int64), dtype=np.int64)


def _numbers(text: bytes, kind: type) -> FloatArray | IntArray:
    with warnings.catch_warnings():
        warnings.simplefilter("error", DeprecationWarning)  # older numpy stops at a word and warns
        try:
            return np.fromstring(text, dtype=kind, sep=" ")
        except (ValueError, DeprecationWarning) as error:
            if _DECIMAL_COMMA.search(text):
                raise DecimalCommaError from error
            raise ValueError(Message("it holds a word where a number must stand")) from error


def written_rows(form: str, rows: FloatArray | Float32Array | IndexArray) -> str:
    """Return every row (n, columns) in a form such as ``v %.5f %.5f %.5f``, one after the other."""
    return form * len(rows) % tuple(rows.ravel().tolist())


class Lines:
    """The lines of a text, told apart by their first characters without a loop over them.

    Parameters
    ----------
    text
        With line feeds only.
    """

    def __init__(self, text: bytes) -> None:
        self.text = text if text.endswith(b"\n") else text + b"\n"
        self.codes: ByteArray = np.frombuffer(self.text, np.uint8)
        ends = np.flatnonzero(self.codes == LINE_FEED)
        self.starts: IntArray = np.concatenate([[0], ends[:-1] + 1])
        self.lengths: IntArray = ends + 1 - self.starts

    def begin_with(self, word: bytes) -> BoolArray:
        """Return which lines (n,) begin with a word and white space."""
        lines = np.flatnonzero(self.lengths > len(word) + 1)
        for offset, code in enumerate(word):  # the first letter leaves out most of the others
            lines = lines[self.codes[self.starts[lines] + offset] == code]
        after = self.codes[self.starts[lines] + len(word)]
        found = np.zeros(len(self.starts), dtype=bool)
        found[lines[(after == ord(" ")) | (after == ord("\t"))]] = True
        return found

    def joined(self, wanted: BoolArray) -> bytes:
        """Return the wanted lines as one text."""
        changes = np.flatnonzero(np.diff(wanted, prepend=False, append=False))
        if len(changes) > _MOST_RUNS:
            return self.codes[np.repeat(wanted, self.lengths)].tobytes()
        places = np.append(self.starts, len(self.text))[changes].reshape(-1, 2)
        return b"".join(self.text[start:end] for start, end in places.tolist())

    def each(self, wanted: BoolArray) -> list[bytes]:
        """Return the wanted lines one by one, without white space at their ends."""
        rows = np.flatnonzero(wanted)
        return [
            self.text[start : start + length].strip()
            for start, length in zip(
                self.starts[rows].tolist(), self.lengths[rows].tolist(), strict=True
            )
        ]


def words_per_line(text: bytes, begins: IntArray | None = None) -> IntArray:
    """Count the words between white space of each line (n,) of a text that ends in a line feed.

    Parameters
    ----------
    text
    begins : (m,) int64, optional
        Its `word_starts`, where they are known.
    """
    codes = np.frombuffer(text, np.uint8)
    if begins is None:
        begins = word_starts(codes)
    ends = np.flatnonzero(codes == LINE_FEED)
    width = len(begins) // max(len(ends), 1)
    if width and len(begins) == width * len(ends):
        firsts, lasts = begins[::width], begins[width - 1 :: width]
        if (lasts < ends).all() and (firsts[1:] > ends[:-1]).all():
            return np.full(len(ends), width, dtype=np.int64)
    return np.diff(np.searchsorted(begins, ends), prepend=0)


def word_starts(codes: ByteArray) -> IntArray:
    """Return where the words between white space begin (n,)."""
    is_word = codes > ord(" ")
    begins = is_word.copy()
    begins[1:] &= ~is_word[:-1]
    return np.flatnonzero(begins)
