"""Find pen marks on the skin by their colour, to be offered as landmarks."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
import scipy

from insole_core.foot.foot import Foot
from insole_core.foot.landmarks import Landmarks
from insole_core.geometry.arrays import BoolArray, FloatArray
from insole_core.geometry.mesh import TriangleMesh

_DARK = 0.6  # brightness of ink against the median of the skin
_BLUE = 0.12  # least excess of blue of ink over the skin, as a share of all light
_AREA_MM2 = (8.0, 600.0)
_OFFER_MM = 15.0


@dataclass(frozen=True, eq=False)
class SkinMark:
    """A pen mark on the skin.

    Parameters
    ----------
    point : (3,) float64, mm, insole frame
        Its centre.
    area_mm2
    landmark
        Name of the nearest landmark; empty when none is near.
    """

    point: FloatArray
    area_mm2: float
    landmark: str = ""


def skin_marks(foot: Foot, landmarks: Landmarks) -> tuple[SkinMark, ...]:
    """Find the pen marks on a foot.

    Parameters
    ----------
    foot
        Without colours it has no marks.
    landmarks
        Of which each mark may mean the nearest one.

    Returns
    -------
    tuple of SkinMark
        The largest first.
    """
    mesh = foot.mesh
    if mesh.colors is None:
        return ()
    inked = _is_ink(mesh.colors.astype(np.float64), mesh)
    marks = [
        SkinMark(point, area, _nearest(point, landmarks)) for point, area in _blobs(mesh, inked)
    ]
    return tuple(sorted(marks, key=lambda mark: -mark.area_mm2))


def _is_ink(colors: FloatArray, mesh: TriangleMesh) -> BoolArray:
    """Return which vertices (n,) are darker and bluer than the skin."""
    light = np.maximum(colors.sum(axis=1), 1.0)
    blue = (colors[:, 2] - colors[:, 0]) / light
    seen = mesh.vertex_areas > 0
    dark = light < _DARK * np.median(light[seen])
    return np.asarray(dark & (blue > np.median(blue[seen]) + _BLUE))


def _blobs(mesh: TriangleMesh, inked: BoolArray) -> Iterator[tuple[FloatArray, float]]:
    part = mesh.part(inked)
    if len(part.vertices) == 0:
        return
    areas = mesh.vertex_areas[inked]
    edges = part.triangles[:, [0, 1, 1, 2]].reshape(-1, 2)
    count = len(part.vertices)
    links = scipy.sparse.coo_array(
        (np.ones(len(edges), bool), (edges[:, 0], edges[:, 1])), (count, count)
    )
    blobs, blob = scipy.sparse.csgraph.connected_components(links, directed=False)
    area = np.bincount(blob, areas, minlength=blobs)
    for number in np.flatnonzero((area > _AREA_MM2[0]) & (area < _AREA_MM2[1])):
        chosen = blob == number
        middle = np.average(part.vertices[chosen], axis=0, weights=areas[chosen])
        yield np.asarray(middle), float(area[number])


def _nearest(point: FloatArray, landmarks: Landmarks) -> str:
    away = {name: np.linalg.norm(mark.point - point) for name, mark in landmarks.items()}
    name = min(away, key=lambda n: float(away[n]), default="")
    return name if name and away[name] < _OFFER_MM else ""
