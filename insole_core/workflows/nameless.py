"""What goes to the workshop never holds the patient's name."""

from __future__ import annotations

import re
from collections.abc import Mapping

from insole_core.cases.case_record import Patient
from insole_core.errors import InputError


def require_nameless(patient: Patient, texts: Mapping[str, str]) -> None:
    """Check that no text for the workshop holds the patient's whole name or surname.

    A first name alone is let pass: it identifies hardly anybody, and Eva is also a material. The
    sample patient is nobody, and "sample" has to stand on what is made for it.

    Parameters
    ----------
    texts
        By what each of them is, such as "file name".

    Raises
    ------
    InputError
        Naming the text, and not the patient.
    """
    if patient.is_sample:
        return
    given, surnames = _words_of(patient.name)
    for what, text in texts.items():
        words = set(_words(text))
        if words & surnames or (given and not surnames and words & given):
            raise InputError(
                "The {what} holds the patient's name, which the shop must not get; use the "
                "pseudonym or an order number in its place.",
                what=what,
            )


def _words_of(name: str) -> tuple[set[str], set[str]]:
    """Return first name and surnames of "Anna Berg" or "Berg, Anna", folded; initials are none."""
    before, comma, after = name.partition(",")
    parts = _words(name)
    surnames = _words(before) if comma and _words(after) else parts[1:]
    long = {word for word in surnames if len(word) > 1}
    return set(parts) - set(surnames), long


def _words(text: str) -> list[str]:
    return re.findall(r"[^\W\d_]+", text.casefold())
