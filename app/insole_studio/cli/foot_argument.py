"""The argument FOOT: a session, or a mesh and its side."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING

from insole_core.geometry.side import Side
from insole_core.progress import Progress

if TYPE_CHECKING:
    from insole_core.foot.foot import Foot


def read_foot(path: Path, side: Side | None, force: bool, progress: Progress) -> Foot:
    """Return the foot of a session or a mesh; warnings about it go to stderr.

    Parameters
    ----------
    side
        Needed for a mesh; for a session it has to agree.
    force
        Continue even if the shape is that of the other foot.

    Raises
    ------
    UsageError
        When the side is missing or contradicts the session.
    """
    from insole_core.workflows.open_scan import open_scan

    scanned = open_scan(path, side, force=force, progress=progress)
    for warning in scanned.warnings:
        print(f"Warning: {warning}", file=sys.stderr)
    for note in scanned.foot.notes:
        print(note, file=sys.stderr)
    return scanned.foot
