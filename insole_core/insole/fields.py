"""What the fields of a prescription hold."""

from __future__ import annotations

from typing import TypeAlias

Place: TypeAlias = tuple[float, float]
"""(x, y) in mm."""
