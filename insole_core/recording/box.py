"""The volume of interest as a box along the axes of the reference frame."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Box:
    """An axis-aligned volume in the reference frame, mm."""

    min_mm: tuple[float, float, float]
    max_mm: tuple[float, float, float]
