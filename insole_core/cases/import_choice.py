"""What a user says of a scan that is opened, and what a case keeps of it."""

from __future__ import annotations

from dataclasses import dataclass

from insole_core.foot.foot_candidate import PoseClicks
from insole_core.formats.units import Unit
from insole_core.geometry.side import Side
from insole_core.imprints.form import Form
from insole_core.scans.scale import KnownSize


@dataclass(frozen=True)
class ImportChoice:
    """What the user has said of a scan; None where it is to be concluded.

    Parameters
    ----------
    side
    unit
        Of the coordinates in the file.
    known_size
        In place of a unit.
    form
    pose
        Three clicked points.
    force
        Go on although the shape looks like the other foot, or is none by its proportions.
    """

    side: Side | None = None
    unit: Unit | None = None
    known_size: KnownSize | None = None
    form: Form | None = None
    pose: PoseClicks | None = None
    force: bool = False


NOTHING_SAID = ImportChoice()
"""All is to be concluded."""
