"""By what the leftovers of an erased person are known on the computers of a clinic."""

from __future__ import annotations

import hashlib
import secrets
from collections.abc import Iterable, Sequence, Set
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from insole_core.cases.case_record import Patient
from insole_core.cases.name_words import WORD, identifying_words, words_in
from insole_core.json_object import JsonObject


@dataclass(frozen=True)
class Traces:
    """What a person was called in the record, as digests: a note of it does not tell the name.

    Parameters
    ----------
    salt
        Drawn for each person, so that no two notes are alike.
    names
        Digests of the person's name and of those merged into them.
    words
        Digests of those of their words that identify.
    visit_ids, capture_ids
        Of all that the record held of them.
    scans
        SHA-256 of the scans that their feet were made from.
    files
        Digests of where such scans lie on this computer, and of the folders around them.
    """

    salt: str
    names: Set[str]
    words: Set[str]
    visit_ids: Set[str]
    capture_ids: Set[str]
    scans: Set[str] = frozenset()
    files: Set[str] = frozenset()

    @classmethod
    def of(
        cls,
        names: Sequence[str],
        visit_ids: Iterable[str] = (),
        capture_ids: Iterable[str] = (),
        scans: Iterable[str] = (),
    ) -> Traces:
        """Return the traces of somebody with these names."""
        salt = secrets.token_hex(16)
        parts = [words_in(name) for name in names]
        words = {word for name in names for word in identifying_words(name)}
        return cls(
            salt,
            frozenset(_digest(salt, _joined(part)) for part in parts if part),
            frozenset(_digest(salt, word) for word in words),
            frozenset(visit_ids),
            frozenset(capture_ids),
            frozenset(scans),
        )

    @classmethod
    def from_json(cls, stored: JsonObject) -> Traces:
        """Return them from what `to_json` gave.

        Raises
        ------
        InputError
            When it is none.
        """
        names, words, visits, captures = (
            frozenset(stored.texts(key)) for key in ("names", "words", "visits", "captures")
        )
        scans, files = (
            frozenset(stored.texts(key)) if stored.has(key) else frozenset()  # of before 2026-11-28
            for key in ("scans", "files")
        )
        return cls(stored.text("salt"), names, words, visits, captures, scans, files)

    def to_json(self) -> dict[str, Any]:
        """Return them as values for `json.dumps`."""
        return {
            "salt": self.salt,
            "names": sorted(self.names),
            "words": sorted(self.words),
            "visits": sorted(self.visit_ids),
            "captures": sorted(self.capture_ids),
            "scans": sorted(self.scans),
            "files": sorted(self.files),
        }

    def with_files(self, paths: Iterable[str]) -> Traces:
        """Return them with the places of the person's scans, and the folders that these lie in."""
        places = {place for path in paths for place in (path, str(Path(path).parent))}
        digests = frozenset(_digest(self.salt, place) for place in places)
        return replace(self, files=self.files | digests)

    def are_of_place(self, path: str) -> bool:
        """Return whether a file or folder holds the name, or a scan of the person."""
        return self.are_in(path) or _digest(self.salt, path) in self.files

    def are_in(self, text: str) -> bool:
        """Return whether a text, such as the name of a file, holds the name."""
        return any(self._is_of_name(word) for word in words_in(text))

    def without(self, text: str) -> str:
        """Return a text without the words of the name."""
        return WORD.sub(lambda w: "–" if self._is_of_name(w[0].casefold()) else w[0], text)

    def are_of(self, patient: Patient) -> bool:
        """Return whether a case is about the person."""
        words = words_in(patient.name)
        return bool(words) and _digest(self.salt, _joined(words)) in self.names

    def _is_of_name(self, word: str) -> bool:
        return _digest(self.salt, word) in self.words


def _joined(words: Iterable[str]) -> str:
    return " ".join(sorted(words))


def _digest(salt: str, text: str) -> str:
    return hashlib.sha256(f"{salt} {text}".encode()).hexdigest()
