"""The layers of an insole, as they are prescribed."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, kw_only=True)
class Layers:
    """Thickness of the layers from the foot down, mm; 0 for a layer that is not made separately.

    Parameters
    ----------
    cover_is_taken_off
        The cover is glued on later: what is made lies lower by its thickness, and the foot stands
        on the cover.
    """

    cover_mm: float = 0.0
    shell_mm: float = 0.0
    base_mm: float = 0.0
    cover_is_taken_off: bool = False

    @property
    def total_mm(self) -> float:
        """Thickness of all layers together."""
        return self.cover_mm + self.shell_mm + self.base_mm
