"""Which character set a text of one byte a character is written in.

Bytes do not tell it: what is ``Şahin`` in Turkish is ``Þahin`` in Western Europe. So only what no
language writes is ruled out, and where several readings remain somebody has to choose.
"""

from __future__ import annotations

import itertools
import re
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

_WESTERN: Final = "ÀÁÂÃÄÅÆÇÈÉÊËÌÍÎÏÑÒÓÔÕÖØÙÚÛÜßàáâãäåæçèéêëìíîïñòóôõöøùúûüÿŒœŠšŽž"
_CENTRAL: Final = "ÁÂÄÉÍÎÓÔÖÚÜÝßáâäçéëíîóôöúüýĄąĂăĆćČčĎďĐđĘęĚěŁłĽľŃńŇňŐőŘřŚśŞşŠšŤťŢţŮůŰűŹźŻżŽž"
_BALTIC: Final = "ÄÖÜÕÉäöüõéĀāĄąČčĒēĖėĘęĢģĪīĮįĶķĻļŅņŖŗŠšŪūŲųŽž"
_CYRILLIC: Final = "".join(map(chr, range(0x0410, 0x0450))) + "ЁЂЄІЇЈЉЊЋЎЏҐёђєіїјљњћўџґ"
_GREEK: Final = "".join(map(chr, range(0x0386, 0x03CF)))
SETS: Final = {
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
RARE_SETS: Final = {
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


def readings_of(content: bytes) -> list[Reading]:
    """Return how bytes that are no Unicode may be read; readings of the same text are one.

    Where no character set fits, all that can be read at all.
    """
    pieces = list(dict.fromkeys(_PIECE.findall(content)))
    for sets, is_likely in ((SETS, True), (RARE_SETS, True), (SETS | RARE_SETS, False)):
        found: dict[str, list[str]] = {}
        for encoding, (_, letters) in sets.items():
            texts = _decoded(pieces, encoding)
            if texts is None or texts in found.values():
                continue
            if not is_likely or all(_may_be(text, letters) for text in texts):
                found[encoding] = texts
        if found:
            return [_reading(encoding, found) for encoding in found]
    return []


def _reading(encoding: str, found: dict[str, list[str]]) -> Reading:
    name, _ = (SETS | RARE_SETS)[encoding]
    variants = zip(*found.values(), strict=True)
    telling = [
        text for text, all_ in zip(found[encoding], variants, strict=True) if len({*all_}) > 1
    ]
    examples = (telling or found[encoding])[:_EXAMPLES]
    return Reading(encoding, name, tuple(text[:_LONGEST_EXAMPLE] for text in examples))


def _decoded(pieces: Sequence[bytes], encoding: str) -> list[str] | None:
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
