"""Tables that other programs export as text: their character sets, and their separators."""

from __future__ import annotations

import codecs
import csv
import io
import itertools
import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Final

from insole_core.errors import InputError
from insole_core.given_file import read_given
from insole_core.messages import joined

_WESTERN: Final = "ÀÁÂÃÄÅÆÇÈÉÊËÌÍÎÏÑÒÓÔÕÖØÙÚÛÜßàáâãäåæçèéêëìíîïñòóôõöøùúûüÿŒœŠšŽž"
_CENTRAL: Final = "ÁÂÄÉÍÎÓÔÖÚÜÝßáâäçéëíîóôöúüýĄąĂăĆćČčĎďĐđĘęĚěŁłĽľŃńŇňŐőŘřŚśŞşŠšŤťŢţŮůŰűŹźŻżŽž"
_BALTIC: Final = "ÄÖÜÕÉäöüõéĀāĄąČčĒēĖėĘęĢģĪīĮįĶķĻļŅņŖŗŠšŪūŲųŽž"
_CYRILLIC: Final = "".join(map(chr, range(0x0410, 0x0450))) + "ЁЂЄІЇЈЉЊЋЎЏҐёђєіїјљњћўџґ"
_GREEK: Final = "".join(map(chr, range(0x0386, 0x03CF)))
_SETS: Final = {
    "cp1252": ("Western European", _WESTERN + "ÐÝÞðýþ"),
    "cp1254": ("Turkish", _WESTERN + "ĞİŞğış"),
    "cp1250": ("Central European", _CENTRAL),
    "iso8859-2": ("Central European, ISO", _CENTRAL),
    "cp1257": ("Baltic", _BALTIC),
    "cp1251": ("Cyrillic", _CYRILLIC),
    "cp1253": ("Greek", _GREEK),
}
"""By Python's codec: the name for people, and the letters of names beyond ASCII. The rare Slovak
letters Ĺ and Ŕ are left out: they are the Å and À of others."""
_RARE_SETS: Final = {
    "koi8-r": ("Cyrillic, KOI8", _CYRILLIC),
    "iso8859-5": ("Cyrillic, ISO", _CYRILLIC),
    "cp850": ("Western European, DOS", _WESTERN),
    "mac-roman": ("Western European, Macintosh", _WESTERN),
}
"""Tried where none of the others fits."""
_SIGNS: Final = frozenset("–—‘’‚“”„«»…·•§°´`¨€£²³½№ªº\xa0\xad")
_WORD: Final = re.compile(r"[^\W\d_]+")
_SIGN_IN_WORD: Final = re.compile(r"(?<=[^\W\d_])[^\w\s\x00-\x7f’´·\xad–](?=[^\W\d_])")
_PIECE: Final = re.compile(rb"[^\x00-/:;|\"]*[\x80-\xff][^\x00-/:;|\"]*")
_MOST_ACCENTED: Final = 2
"""In a row: Cyrillic read as Western European has more, and no name."""
_EXAMPLES, _LONGEST_EXAMPLE = 3, 24

MOST_BYTES: Final = 64 * 2**20
MOST_COLUMNS: Final = 1000
MOST_ROWS: Final = 200_000
DELIMITERS: Final = (",", ";", "\t", "|")
_MARKS: Final = (
    (codecs.BOM_UTF8, "utf-8-sig"),
    (codecs.BOM_UTF16_LE, "utf-16"),
    (codecs.BOM_UTF16_BE, "utf-16"),
)
_SAMPLE_ROWS: Final = 200
_SAMPLE_BYTES: Final = 4096
_DECLARED: Final = re.compile(r"sep=(.)\r?\n", re.IGNORECASE)
"""First line by which Excel is told the delimiter."""


@dataclass(frozen=True)
class Reading:
    """One way to read a text.

    Parameters
    ----------
    encoding
        Name of Python's codec.
    name
        Of the character set, for people.
    examples
        Words of the text as they read then, those first that tell the readings apart.
    """

    encoding: str
    name: str
    examples: tuple[str, ...]

    def __str__(self) -> str:
        return f"{self.name} ({self.encoding}): {', '.join(self.examples)}"


def _readings_of(content: bytes) -> list[Reading]:
    """Return how bytes that are no Unicode may be read; readings of the same text are one.

    Where no character set fits, all that can be read at all.
    """
    pieces = list(dict.fromkeys(_PIECE.findall(content)))
    for sets, is_likely in ((_SETS, True), (_RARE_SETS, True), (_SETS | _RARE_SETS, False)):
        found: dict[str, list[str]] = {}
        for encoding, (_, letters) in sets.items():
            texts = _all_in(pieces, encoding)
            if texts is None or texts in found.values():
                continue
            if not is_likely or all(_may_be(text, letters) for text in texts):
                found[encoding] = texts
        if found:
            return [_reading(encoding, found) for encoding in found]
    return []


def _reading(encoding: str, found: dict[str, list[str]]) -> Reading:
    name, _ = (_SETS | _RARE_SETS)[encoding]
    variants = zip(*found.values(), strict=True)
    telling = [
        text for text, all_ in zip(found[encoding], variants, strict=True) if len({*all_}) > 1
    ]
    examples = (telling or found[encoding])[:_EXAMPLES]
    return Reading(encoding, name, tuple(text[:_LONGEST_EXAMPLE] for text in examples))


def _all_in(pieces: Sequence[bytes], encoding: str) -> list[str] | None:
    try:
        return [piece.decode(encoding) for piece in pieces]
    except UnicodeDecodeError:
        return None


def _may_be(text: str, letters: str) -> bool:
    signs = {sign for sign in text if not sign.isascii() and not sign.isalpha()}
    if not signs <= _SIGNS or _SIGN_IN_WORD.search(text):
        return False
    return all(_is_of(word, letters) and _is_cased(word) for word in _WORD.findall(text))


def _is_of(word: str, letters: str) -> bool:
    """Return whether a word is written with the letters of a character set."""
    beyond = [letter for letter in word if not letter.isascii()]
    if not beyond:
        return True
    if not set(beyond) <= set(letters):
        return False
    if letters in (_CYRILLIC, _GREEK):
        return len(beyond) == len(word)
    runs = [len([*run]) for is_ascii, run in itertools.groupby(word, str.isascii) if not is_ascii]
    return max(runs) <= _MOST_ACCENTED


def _is_cased(word: str) -> bool:
    """Return whether no letter beyond ASCII is a capital within a word of small letters."""
    return word.isupper() or not any(
        letter.isupper() and not letter.isascii() for letter in word[1:]
    )


@dataclass(frozen=True)
class TableRow:
    """One row.

    Parameters
    ----------
    line
        Of the file, from 1, on which the row begins.
    cells
        As many as there are headings, unless the file has more in this row.
    """

    line: int
    cells: tuple[str, ...]


@dataclass(frozen=True)
class TextTable:
    """The rows of a file under its headings, with the way in which it was read.

    Parameters
    ----------
    headings
        Of the first row; "" where a column has none.
    encoding
        Name of Python's codec.
    """

    headings: tuple[str, ...]
    rows: tuple[TableRow, ...]
    encoding: str
    delimiter: str

    def column(self, number: int) -> list[str]:
        """Return the cells of a column that are not empty, without spaces around them."""
        cells = (row.cells[number].strip() for row in self.rows)
        return [cell for cell in cells if cell]


class UnclearCharacterSet(InputError):  # noqa: N818 - says what happened, and asks
    """A text can be read in several ways.

    Parameters
    ----------
    readings
        At least two.
    """

    def __init__(self, path: Path, readings: Sequence[Reading]) -> None:
        super().__init__(
            "{path} does not tell its character set, and names read differently in each; choose "
            "it (--encoding), or save the table again as CSV UTF-8: {readings}.",
            path=path,
            readings=joined(map(str, readings), "; "),
        )
        self.readings = tuple(readings)


def read_table(path: Path, encoding: str | None = None) -> TextTable:
    """Read a table whose first row holds the headings.

    Parameters
    ----------
    encoding
        Name of Python's codec; None to find it.

    Raises
    ------
    UnclearCharacterSet
        When it can be read in several ways, and none was chosen.
    InputError
        When it is no such table, damaged, or larger than any list of a clinic's patients.
    """
    text, encoding = _decoded(path, read_given(path, MOST_BYTES), encoding)
    declared = _DECLARED.match(text)
    skipped = 0
    if declared:
        text, skipped = text[declared.end() :], 1
    delimiter = declared.group(1) if declared else _delimiter_of(text)
    rows = _read_rows(path, text, delimiter, skipped)
    if not rows:
        raise InputError("{path} is empty; choose a table with one row for a person.", path=path)
    headings = tuple(cell.strip() for cell in rows[0].cells)
    count = len(headings)
    filled = tuple(TableRow(row.line, _of_width(row.cells, count)) for row in rows[1:])
    return TextTable(headings, filled, encoding, delimiter)


def _decoded(path: Path, content: bytes, chosen: str | None) -> tuple[str, str]:
    encoding = chosen or _unicode_of(content) or _character_set_of(path, content)
    try:
        text = content.decode(encoding)
    except UnicodeDecodeError as error:
        raise InputError(
            "{path} is in a character set that is not known, or damaged (at byte {place}); save it "
            "again as CSV UTF-8.",
            path=path,
            place=error.start,
        ) from error
    if "\0" in text:
        raise _no_text(path)
    return text, encoding


def _no_text(path: Path) -> InputError:
    return InputError("{path} is no table of text; save it again as CSV UTF-8.", path=path)


def _unicode_of(content: bytes) -> str | None:
    """Return the codec of a Unicode text: by its mark, by its zeros, or as UTF-8 if it is."""
    for mark, encoding in _MARKS:
        if content.startswith(mark):
            return encoding
    for encoding in ("utf-16-le", "utf-16-be"):
        if _has_lines(content[:_SAMPLE_BYTES], encoding):
            return encoding
    try:
        content.decode("utf-8")
    except UnicodeDecodeError:
        return None
    return "utf-8"


def _has_lines(sample: bytes, encoding: str) -> bool:
    """Return whether a text without a mark is UTF-16: read otherwise, it has zeros."""
    if b"\0" not in sample:
        return False
    text = sample.decode(encoding, "replace")
    return "\0" not in text and any(sign in text for sign in ("\n", "\r", *DELIMITERS))


def _character_set_of(path: Path, content: bytes) -> str:
    if b"\0" in content:
        raise _no_text(path)
    readings = _readings_of(content)
    if len(readings) > 1:
        raise UnclearCharacterSet(path, readings)
    return readings[0].encoding if readings else "cp1252"


def _delimiter_of(text: str) -> str:
    """Return the delimiter that gives most columns, the same number in nearly all rows."""

    def likeness(delimiter: str) -> tuple[float, int]:
        try:
            rows = [cells for _, cells in _records(text, delimiter, _SAMPLE_ROWS)]
        except csv.Error:
            return 0.0, 0
        width = len(rows[0]) if rows else 0
        if width < 2:
            return 0.0, width
        return sum(len(cells) == width for cells in rows) / len(rows), width

    # Rows of one width tell a delimiter from a comma in the texts; then the more columns.
    return max(DELIMITERS, key=likeness)


def _read_rows(path: Path, text: str, delimiter: str, skipped: int) -> list[TableRow]:
    rows: list[TableRow] = []
    line = 0
    try:
        for line, cells in _records(text, delimiter):
            if len(cells) > MOST_COLUMNS:
                raise InputError(
                    "Line {line} of {path} has {count} columns, and a table may have {most}; "
                    "check its quotation marks.",
                    line=line + skipped,
                    path=path,
                    count=len(cells),
                    most=MOST_COLUMNS,
                )
            if len(rows) > MOST_ROWS:
                raise InputError(
                    "{path} has more than {most} rows; divide it.", path=path, most=MOST_ROWS
                )
            rows.append(TableRow(line + skipped, tuple(cells)))
    except csv.Error as error:
        raise InputError(
            "{path} cannot be read after line {line}: a quotation mark is not closed, or a text is "
            "too long; correct it, or export it again.",
            path=path,
            line=line + skipped,
        ) from error
    return rows


def _records(text: str, delimiter: str, most: int | None = None) -> Iterator[tuple[int, list[str]]]:
    """Yield the rows that are not empty, each with the line on which it begins."""
    reader = csv.reader(io.StringIO(text, newline=""), delimiter=delimiter, strict=True)
    begin, count = 1, 0
    for cells in reader:
        if any(cell.strip() for cell in cells):
            yield begin, cells
            count += 1
        begin = reader.line_num + 1
        if count == most:
            return


def _of_width(cells: tuple[str, ...], count: int) -> tuple[str, ...]:
    """Fill up a row, as some programs leave out empty cells at its end; cut empty ones beyond."""
    used = next((n for n in range(len(cells), 0, -1) if cells[n - 1].strip()), 0)
    width = max(count, used)
    return (*cells[:width], *[""] * (width - len(cells)))
