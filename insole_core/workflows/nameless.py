"""What goes to the workshop never holds the patient's name."""

from __future__ import annotations

from collections.abc import Mapping

from insole_core.cases.case_record import Patient
from insole_core.cases.name_words import holds_any, identifying_words
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
    words = identifying_words(patient.name)
    for what, text in texts.items():
        if holds_any(text, words):
            raise InputError(
                "The {what} holds the patient's name, which the shop must not get; use the "
                "pseudonym or an order number in its place.",
                what=what,
            )
