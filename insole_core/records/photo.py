"""A photo of a visit with what is marked on it, as values."""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace
from typing import Any, Final

from insole_core.errors import InputError
from insole_core.json_object import JsonObject
from insole_core.records.field_checks import check_line, check_text
from insole_core.records.person import new_id

MOST_PHOTOS: Final = 50
MOST_MARKS: Final = 200
MOST_POINTS: Final = 2000
MOST_LETTERS: Final = 500
"""Of the text of a mark."""

Point = tuple[float, float]


@dataclass(frozen=True)
class PhotoMark:
    """A line that is drawn on a photo, or a place on it, with a text.

    Parameters
    ----------
    points
        Across and down, as parts of the width and the height of the photo, from its upper left
        corner; one alone is a place.
    """

    points: tuple[Point, ...]
    text: str = ""

    def checked(self) -> PhotoMark:
        """Return the mark as it is stored.

        Raises
        ------
        InputError
            When it is beside the photo, or larger than anything drawn by hand.
        """
        inside = all(math.isfinite(v) and 0.0 <= v <= 1.0 for point in self.points for v in point)
        if len(self.points) > MOST_POINTS:
            raise InputError(
                "A line on a photo has at most {most} points; draw it in parts.", most=MOST_POINTS
            )
        if not inside or not self.points:
            raise InputError("A mark must lie on the photo; draw it again.")
        points = tuple((round(x, 4), round(y, 4)) for x, y in self.points)
        return replace(
            self, points=points, text=check_text(self.text, "text of the mark", MOST_LETTERS)
        )


@dataclass(frozen=True)
class Photo:
    """A photo of a visit.

    Parameters
    ----------
    number
        On the visit, 1 for the first.
    content_sha256
        Of the JPEG, which is upright and tells neither place nor camera.
    revision
        Grows with every change; 0 for one that is not in the record yet.
    """

    visit_id: str
    number: int
    content_sha256: str
    caption: str = ""
    marks: tuple[PhotoMark, ...] = ()
    id: str = field(default_factory=new_id)
    created_at: str = ""
    changed_at: str = ""
    author: str = ""
    revision: int = 0

    def checked(self) -> Photo:
        """Return the photo as it is stored.

        Raises
        ------
        InputError
            When the caption or a mark cannot be right.
        """
        if len(self.marks) > MOST_MARKS:
            raise InputError(
                "A photo takes at most {most} marks; add another photo.", most=MOST_MARKS
            )
        return replace(
            self,
            caption=check_line(self.caption, "caption of the photo"),
            marks=tuple(mark.checked() for mark in self.marks),
        )


def marks_to_json(marks: tuple[PhotoMark, ...]) -> list[dict[str, Any]]:
    """Return marks as plain values for `json.dump`."""
    return [{"points": list(map(list, mark.points)), "text": mark.text} for mark in marks]


def marks_from_text(text: str) -> tuple[PhotoMark, ...]:
    """Read marks as the record has them.

    Raises
    ------
    InputError
        When they are none.
    """
    return marks_of(JsonObject.parse("marks of a photo", f'{{"marks": {text}}}'.encode()))


def marks_of(root: JsonObject) -> tuple[PhotoMark, ...]:
    """Read the marks that an object has; the inverse of `marks_to_json`.

    Raises
    ------
    InputError
        When they are none.
    """
    return tuple(_mark(mark) for mark in root.objects("marks"))


def _mark(mark: JsonObject) -> PhotoMark:
    points = mark.value("points")
    try:
        pairs = tuple((float(x), float(y)) for x, y in points)
    except (TypeError, ValueError):
        raise mark.fail("points", "must be pairs of numbers") from None
    return PhotoMark(pairs, mark.text("text", empty=True)).checked()
