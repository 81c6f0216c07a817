"""A scanned surface becomes a foot: brought to the insole frame, its side checked."""

from __future__ import annotations

from typing import Literal

import numpy as np

from insole_core.errors import InsoleError
from insole_core.foot.foot import Foot
from insole_core.foot.levelling import LevelFoot, level
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.side import Side

Frame = Literal["reference", "unknown"]


class SideMismatchError(InsoleError):
    """The shape is that of the other foot."""


def place_foot(mesh: TriangleMesh, side: Side, *, frame: Frame, force: bool = False) -> Foot:
    """Bring a surface to the insole frame.

    Parameters
    ----------
    mesh : mm
    side
    frame
        "reference": toes towards +y and dorsal +z are known, and only the last degrees are found;
        "unknown": the surface may lie in any way.
    force
        Go on although the shape looks like the other foot.

    Raises
    ------
    SideMismatchError
        When the shape is clearly that of the other foot, unless `force`.
    ReconstructionError
        When no foot is seen in the surface.
    """
    found: LevelFoot = level(mesh, side, np.eye(4))
    return Foot(side, mesh.transformed(found.source2insole), found.source2insole, found.length_mm)
