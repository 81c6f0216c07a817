"""The details of the audit log in words; the log itself keeps the names that the program has."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import partial
from typing import Final

from insole_core.geometry.side import Side
from insole_core.records.author import Role
from insole_core.records.order import OrderState
from insole_core.records.person import Person
from insole_core.records.record_field import fields_of
from insole_core.records.visit import Visit
from insole_studio.texts import tr, translate_core_message

NAMES: Final[Mapping[str, Callable[[], str]]] = {
    "audit_seq": lambda: tr("last line"),
    "captures": lambda: tr("captures"),
    "count": lambda: tr("count"),
    "damaged": lambda: tr("damaged"),
    "digest": lambda: tr("digest"),
    "failures": lambda: tr("failed attempts"),
    "fields": lambda: tr("fields"),
    "files": lambda: tr("files"),
    "has_system_user": lambda: tr("has a user of the system"),
    "is_disabled": lambda: tr("disabled"),
    "is_pseudonymous": lambda: tr("under a pseudonym"),
    "kept_until": lambda: tr("kept until"),
    "merge": lambda: tr("merge"),
    "merged": lambda: tr("merged"),
    "orders": lambda: tr("orders"),
    "person": lambda: tr("person"),
    "prescriptions": lambda: tr("prescriptions"),
    "reason": lambda: tr("reason"),
    "release": lambda: tr("release"),
    "removed": lambda: tr("removed"),
    "revision": lambda: tr("revision"),
    "role": lambda: tr("role"),
    "rows": lambda: tr("rows"),
    "sha256": lambda: "SHA-256",
    "side": lambda: tr("side"),
    "signature": lambda: tr("signature"),
    "signed_in_by": lambda: tr("signed in by"),
    "state": lambda: tr("state"),
    "visit": lambda: tr("visit"),
    "visits": lambda: tr("visits"),
}
"""Names of details."""
WORDS: Final[Mapping[str, Callable[[], str]]] = {
    "True": lambda: tr("yes"),
    "False": lambda: tr("no"),
    "None": lambda: tr("nothing"),
    "request": lambda: tr("on request"),
    "retention over": lambda: tr("time of keeping over"),
    "sample": lambda: tr("sample patient"),
    "password": lambda: tr("password"),
    "system user": lambda: tr("user of the system"),
    **{
        str(word): partial(translate_core_message, str(word))
        for kind in (Side, Role, OrderState)
        for word in kind
    },
}
"""Values that are words."""
FIELDS: Final[Mapping[str, Callable[[], str]]] = {
    name: partial(translate_core_message, field.noun)
    for kind in (Person, Visit)
    for name, field in fields_of(kind).items()
}
"""Fields of a person and of a visit, whose names a line lists when they were changed."""


def details_text(details: Mapping[str, str]) -> str:
    """Say the details of a line in the language of the window; what is no word stays as it is."""
    return ", ".join(f"{_word(NAMES, key)}: {_value(key, text)}" for key, text in details.items())


def _value(key: str, text: str) -> str:
    if key == "fields":
        return " · ".join(_word(FIELDS, name) for name in text.split())
    return WORDS.get(text, lambda: text)()


def _word(words: Mapping[str, Callable[[], str]], key: str) -> str:
    return words.get(key, lambda: key.replace("_", " "))()
