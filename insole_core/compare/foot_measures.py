"""The measures of a compared surface that is a foot: those that the window and `measure` show."""

from __future__ import annotations

from insole_core.compare.seen_surface import facing, is_one_sided
from insole_core.errors import InputError
from insole_core.foot.foot_placement import SideMismatchError, place_foot, recognised_foot
from insole_core.foot.landmarks import find_landmarks
from insole_core.foot.measure_table import Measured
from insole_core.foot.measures import measure
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.side import Side


def recorded_foot_measures(mesh: TriangleMesh, side: Side) -> Measured | None:
    """Measure the foot of a session.

    Parameters
    ----------
    mesh : mm, reference frame
    side
        As the session says.

    Returns
    -------
    dict or None
        By the names in `DEFINITIONS`; None when it is not a foot of that side.
    """
    try:
        foot = place_foot(mesh, side, frame="reference")
    except (InputError, SideMismatchError):
        return None
    return measure(foot, find_landmarks(foot))


def surface_measures(mesh: TriangleMesh) -> tuple[Side | None, Measured | None]:
    """Measure a surface of which nothing is known, if it is a foot, and tell which one.

    Parameters
    ----------
    mesh : mm, any frame

    Returns
    -------
    side : Side or None
    measures : dict or None
        By the names in `DEFINITIONS`; None for insoles, moulds, and what looks like no foot.
    """
    if not is_one_sided(mesh) and facing(mesh)[2] > 0:
        return None, None
    foot = recognised_foot(mesh)
    return (None, None) if foot is None else (foot.side, measure(foot, find_landmarks(foot)))
