"""The section plane through the insole, and the profile that it cuts."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from PySide6.QtCore import QObject, Signal

from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.plane_section import section_segments
from insole_studio.document.insole_preview import InsolePreview


@dataclass(frozen=True)
class SectionPlane:
    """A vertical plane through the insole.

    Parameters
    ----------
    origin_mm
        A point (x, y) on the plane; the origin of distances along it.
    turn_deg
        Rotation about the vertical: 0 cuts across the foot, 90 along it.
    """

    origin_mm: tuple[float, float]
    turn_deg: float = 0.0

    @property
    def along(self) -> FloatArray:
        """Return the (2,) unit vector in the plane, to the right in its picture."""
        angle = np.radians(self.turn_deg)
        return np.array([np.cos(angle), np.sin(angle)])

    @property
    def normal(self) -> FloatArray:
        """Return the (3,) unit normal of the plane."""
        x, y = self.along
        return np.array([-y, x, 0.0])


@dataclass(frozen=True, eq=False)
class Profile:
    """The profile that the plane cuts; distances along the plane and heights, mm.

    Parameters
    ----------
    top, bottom : (n, 2) float64
        The contact surface and the bottom of the insole, point by point above each other.
    skin : (k, 2, 2) float64
        Segments of the foot as it stands on the insole.
    """

    top: FloatArray
    bottom: FloatArray
    skin: FloatArray


class SectionModel(QObject):
    """The current section plane, or None; part of the view, not of the case."""

    changed = Signal()

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self.plane: SectionPlane | None = None

    def show(self, plane: SectionPlane | None) -> None:
        """Set the section plane; None removes it."""
        if plane != self.plane:
            self.plane = plane
            self.changed.emit()


def cut_profile(surface: InsolePreview, plane: SectionPlane) -> Profile | None:
    """Cut insole and foot by the plane; return None if it misses the insole.

    Parameters
    ----------
    surface
        The insole and the standing foot.

    Returns
    -------
    Profile or None
        Distances along the plane and heights, mm.
    """
    line, skins, standing = section_line(surface, plane), surface.skins, surface.standing_foot
    if line is None or skins is None or standing is None:
        return None
    top = _in_plane(line, plane)
    lowest = _in_plane(_cut(skins[1], plane).reshape(-1, 3), plane)
    lowest = lowest[lowest[:, 0].argsort()]
    bottom = np.stack([top[:, 0], np.interp(top[:, 0], *lowest.T)], axis=1)
    return Profile(top, bottom, _in_plane(_cut(standing, plane), plane))


def section_line(surface: InsolePreview, plane: SectionPlane) -> FloatArray | None:
    """Return the (n, 3) line, mm, in which the plane cuts the contact surface, or None.

    Returns
    -------
    (n, 3) float64, mm, or None
        None if the plane misses the surface.
    """
    field, skins = surface.contact, surface.skins
    if field is None or skins is None:
        return None
    reached = _in_plane(_cut(skins[0], plane).reshape(-1, 3), plane)[:, 0]
    if len(reached) == 0:
        return None
    start, end = float(reached.min()), float(reached.max())
    distance = np.linspace(start, end, max(round((end - start) / field.step_mm), 1) + 1)
    places = np.array(plane.origin_mm) + distance[:, None] * plane.along
    return np.column_stack([places, surface.heights_mm(places)])


def _cut(mesh: TriangleMesh, plane: SectionPlane) -> FloatArray:
    return section_segments(mesh, np.append(plane.origin_mm, 0.0), plane.normal)


def _in_plane(points: FloatArray, plane: SectionPlane) -> FloatArray:
    """Return distance along the plane and height of points (..., 3)."""
    distance = (points[..., :2] - np.array(plane.origin_mm)) @ plane.along
    return np.stack([distance, points[..., 2]], axis=-1)
