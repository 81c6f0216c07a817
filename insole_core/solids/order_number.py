"""Order numbers: what the workshop knows a patient by while the clinic has given no pseudonym."""

from __future__ import annotations

import secrets
from datetime import date

_LETTERS = "23456789CDFGHJKMNPQRTVWXY"  # no vowels, and nothing that looks like another
_LENGTH = 5


def new_order_number(day: date) -> str:
    """Return a number such as "26-7KQ4M": the year, and letters that tell nothing of the patient.

    One in ten million is drawn twice.
    """
    drawn = "".join(secrets.choice(_LETTERS) for _ in range(_LENGTH))
    return f"{day:%y}-{drawn}"
