"""A name that stands over a model."""

from __future__ import annotations

from dataclasses import dataclass

from insole_core.geometry.arrays import FloatArray


@dataclass(frozen=True, eq=False)
class NameLabel:
    """A word on a coloured ground at a place (3,), mm."""

    text: str
    place_mm: FloatArray
    color: str
