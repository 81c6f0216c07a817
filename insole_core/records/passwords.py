"""Passwords of accounts: which are good enough, and how they are stored (argon2id)."""

from __future__ import annotations

import unicodedata
from functools import cache

from argon2 import PasswordHasher, extract_parameters
from argon2.exceptions import InvalidHashError, VerificationError

from insole_core.errors import InputError

SHORTEST, LONGEST = 12, 1000
_FEWEST_DIFFERENT = 5
_ROWS = (
    "abcdefghijklmnopqrstuvwxyz",
    "01234567890",
    "qwertyuiopåasdfghjklöäzxcvbnm",
    "insolestudio",
)
_RUN = 6
"""Letters in a row of the alphabet or the keyboard that are guessed first."""
_HASHER = PasswordHasher()
"""argon2id with the parameters that RFC 9106 recommends for 64 MiB."""
_MOST_KIB, _MOST_PASSES = 4 * 65_536, 8 * 3
"""Of a stored hash: room for stronger ones than today's, and no sign-in that never ends."""


def check_password(password: str, *names: str) -> None:
    """Check a new password: long, of several characters, and nothing that is guessed first.

    No mixture of capitals, digits and signs is asked for, which makes passwords hard to remember
    and easy to guess (NIST SP 800-63B).

    Parameters
    ----------
    names
        Of the account, which must not be part of it.

    Raises
    ------
    InputError
        Which says what to change, without the password.
    """
    text = _normalised(password)
    if not SHORTEST <= len(text) <= LONGEST:
        raise InputError(
            "The password has {count} characters; take {least} to {most}, such as four words.",
            count=len(text),
            least=SHORTEST,
            most=LONGEST,
        )
    folded = text.casefold()
    if len(set(folded)) < _FEWEST_DIFFERENT:
        raise InputError("The password repeats few characters; take four words, for example.")
    parts = [part for name in names for part in name.casefold().split() if len(part) > 3]
    if any(part in folded for part in parts) or len(_without_runs(folded)) < SHORTEST // 2:
        raise InputError(
            "The password is among the first that are tried: a name, or keys in a row; take four "
            "words, for example."
        )


def hash_password(password: str) -> str:
    """Return the hash that is stored, with its salt and parameters."""
    return _HASHER.hash(_normalised(password))


def is_password(password: str, stored: str | None) -> bool:
    """Return whether a password belongs to a stored hash.

    Parameters
    ----------
    stored
        None for an account that does not exist; the answer takes as long.
    """
    known = stored or _nobodys_hash()
    try:
        matches = _is_bounded(known) and _HASHER.verify(known, _normalised(password))
    except (VerificationError, InvalidHashError):
        return False
    return matches and stored is not None


def _is_bounded(stored: str) -> bool:
    """Return whether a hash can be checked in seconds; one that cannot is not of this program."""
    asked = extract_parameters(stored)
    return asked.memory_cost <= _MOST_KIB and asked.time_cost <= _MOST_PASSES


def is_outdated(stored: str) -> bool:
    """Return whether a hash was made with other parameters than today's."""
    return _HASHER.check_needs_rehash(stored)


def _normalised(password: str) -> str:
    """Return the same characters whatever keyboard and system they were typed on."""
    return unicodedata.normalize("NFKC", password)


def _without_runs(text: str) -> str:
    """Remove pieces of rows of the alphabet or the keyboard, forwards and backwards."""
    for row in (*_ROWS, *(row[::-1] for row in _ROWS)):
        for length in range(len(row), _RUN - 1, -1):
            for start in range(len(row) - length + 1):
                text = text.replace(row[start : start + length], "")
    return text


@cache
def _nobodys_hash() -> str:
    return _HASHER.hash("nobody")
