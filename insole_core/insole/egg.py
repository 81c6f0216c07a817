"""Earlier names of `insole_core.insole.pads`: the first pads were eggs."""

from __future__ import annotations

from insole_core.insole.pads import pad_heights as pelott_heights
from insole_core.insole.pads import pad_outline as egg_outline

__all__ = ["egg_outline", "pelott_heights"]
