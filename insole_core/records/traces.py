"""By what the leftovers of an erased person are known on the computers of a clinic."""

from __future__ import annotations

from collections.abc import Set
from dataclasses import dataclass

from insole_core.cases.case_record import Patient
from insole_core.cases.name_words import holds_any, words_in


@dataclass(frozen=True)
class Traces:
    """What a person was called in the record; never stored, and shown to nobody.

    Parameters
    ----------
    names
        Of the person and of those merged into them.
    words
        Of these names, folded: those that identify.
    visit_ids, capture_ids
        Of all that the record held of them.
    """

    names: tuple[str, ...] = ()
    words: Set[str] = frozenset()
    visit_ids: Set[str] = frozenset()
    capture_ids: Set[str] = frozenset()

    def are_in(self, text: str) -> bool:
        """Return whether a text, such as the name of a file, holds the name."""
        return holds_any(text, self.words)

    def are_of(self, patient: Patient) -> bool:
        """Return whether a case is about the person."""
        words = sorted(words_in(patient.name))
        return bool(words) and words in [sorted(words_in(name)) for name in self.names]
