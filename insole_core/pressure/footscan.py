"""footscan (RSscan, Materialise): its table of forces, saved as text.

Frames begin with a line such as ``Frame 12 (96 ms)``. The table names no unit and no distance: its
numbers are forces in N on sensors of 5.08 × 7.62 mm, and its rows run from the heel, as the public
reader of the R package pressuRe has them (Telfer & Li 2023).
"""

from __future__ import annotations

import re
from dataclasses import replace
from pathlib import Path

from insole_core.pressure.grid_text import read_grid
from insole_core.pressure.recording import PressureRecording, PressureUnit, SeenFrom

_FRAME = re.compile(r"^\W*Frame\s+\d+\s*\([\d.,]+\s*ms\)", re.MULTILINE)
_PITCH_MM = 5.08, 7.62


def is_footscan(text: str) -> bool:
    """Return whether a text is a table of a footscan program."""
    return _FRAME.search(text) is not None


def read_footscan(path: Path, text: str) -> tuple[PressureRecording, ...]:
    """Read all frames; which foot it is, is not said.

    Raises
    ------
    InputError
        As `read_grid`.
    """
    (table,) = read_grid(path, text)
    return (
        replace(
            table,
            device="footscan",
            pitch_mm=table.pitch_mm or _PITCH_MM,
            unit=table.unit or PressureUnit.NEWTON,
            # From the heel on, the map that is seen from above is that seen from below, turned.
            seen_from=table.seen_from or SeenFrom.BELOW,
        ),
    )
