"""What a scan shows: a foot, its imprint, or a cast of it."""

from __future__ import annotations

from enum import StrEnum


class Form(StrEnum):
    """The form of a scan.

    FOOT is the skin of a foot; IMPRINT a negative, such as a foam box; CAST a positive, such as one
    of plaster.
    """

    FOOT = "foot"
    IMPRINT = "imprint"
    CAST = "cast"
