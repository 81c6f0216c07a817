"""What a user has said of a foot in a scan, and the scale that follows from its known length."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import TypeVar

import numpy as np

from insole_core.foot.foot_candidate import PoseClicks
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.side import Side
from insole_core.scans.mesh_file import ReadMesh
from insole_core.scans.scale import KnownDistance, KnownSize, known_length_mm

_SCALE_ROUNDS, _SCALE_ERROR = 4, 0.002
_Found = TypeVar("_Found")


@dataclass(frozen=True)
class FootSaid:
    """What a user has said of a foot; None where it is to be concluded.

    Parameters
    ----------
    side
    pose
        As it was clicked.
    known_size
    """

    side: Side | None = None
    pose: PoseClicks | None = None
    known_size: KnownSize | None = None

    @property
    def length_mm(self) -> float | None:
        """Length of the foot, by which a scan without a scale is scaled."""
        if self.known_size is None or isinstance(self.known_size, KnownDistance):
            return None
        return known_length_mm(self.known_size)

    def for_each(self, first: TriangleMesh, second: TriangleMesh) -> tuple[FootSaid, FootSaid]:
        """Return what was said of each of two feet: the points were clicked on one of them."""
        from scipy.spatial import cKDTree

        if self.pose is None:
            return self, self
        clicks = np.array([self.pose.heel, self.pose.toe, self.pose.sole])
        first_mm, second_mm = (
            float(np.sum(cKDTree(mesh.vertices).query(clicks)[0])) for mesh in (first, second)
        )
        other = replace(self, pose=None)
        return (self, other) if first_mm <= second_mm else (other, self)

    def _scaled(self, factor: float) -> FootSaid:
        return replace(self, pose=None if self.pose is None else self.pose.scaled(factor))


NOTHING_SAID = FootSaid()


def at_known_length(
    read: ReadMesh,
    said: FootSaid,
    find: Callable[[ReadMesh, FootSaid], _Found],
    length_of: Callable[[_Found], float | None],
) -> tuple[ReadMesh, _Found]:
    """Find feet in a scan at the scale at which the first of them has its known length.

    Parameters
    ----------
    read
        At the scale at which the points were clicked.
    find
        Finds the feet at any scale.
    length_of
        Length of the first foot that was found, mm; None where there is none.

    Returns
    -------
    read : ReadMesh
        At its final scale.
    found
        What `find` returned at that scale.
    """
    found = find(read, said)
    for _ in range(_SCALE_ROUNDS):
        length_mm = length_of(found)
        if length_mm is None or said.length_mm is None:
            break
        factor = said.length_mm / length_mm
        if abs(factor - 1) < _SCALE_ERROR:
            break
        read, said = read.scaled(factor), said._scaled(factor)
        found = find(read, said)
    return read, found
