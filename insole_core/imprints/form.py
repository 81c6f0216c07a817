"""What a scan shows: a foot, its imprint, or a cast of it."""

from __future__ import annotations

from enum import StrEnum


class Form(StrEnum):
    """The form of a scan.

    FOOT is the skin of a foot; IMPRINT a negative, such as a foam box; CAST a positive, such as one
    of plaster, of a foot that stood; UNLOADED_CAST one of a foot without weight on it.
    """

    FOOT = "foot"
    IMPRINT = "imprint"
    CAST = "cast"
    UNLOADED_CAST = "unloaded_cast"

    @property
    def is_spread(self) -> bool:
        """Whether the tissue was spread by weight when the form was taken."""
        return self in (Form.IMPRINT, Form.CAST)
