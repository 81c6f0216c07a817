"""The section plane through the insole, and the profile that it cuts."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from PySide6.QtCore import QObject, Signal

from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.sections import ParallelSections
from insole_core.insole.primitives.height_field import HeightField
from insole_core.solids.ball_offset import parallel_below
from insole_studio.document.insole_preview import InsolePreview

_KEPT = 3
"""Meshes whose sections are prepared: top, bottom and foot."""


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
    cover : (n, 2) float64, optional
        The lower side of the cover; None without a cover.
    """

    top: FloatArray
    bottom: FloatArray
    skin: FloatArray
    cover: FloatArray | None = None


class SectionModel(QObject):
    """The current section plane, or None, and what it cuts; part of the view, not of the case."""

    changed = Signal()

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self.plane: SectionPlane | None = None
        self.follows = False
        """Whether the plane follows the pointer."""
        self._slices: list[_Slices] = []
        self._line: tuple[SectionPlane, HeightField, FloatArray | None] | None = None
        self._cover: tuple[HeightField, float, HeightField] | None = None

    def show(self, plane: SectionPlane | None) -> None:
        """Set the section plane; None removes it."""
        if plane is None:
            self._slices, self._line, self._cover = [], None, None  # they hold meshes of the case
        if plane != self.plane:
            self.plane = plane
            self.changed.emit()

    def follow(self, follows: bool) -> None:
        """Let the plane follow the pointer, or leave it where it is."""
        self.follows = follows
        self.changed.emit()

    def profile(self, surface: InsolePreview) -> Profile | None:
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
        plane, line = self.plane, self.line(surface)
        skins, standing = surface.skins, surface.standing_foot
        if plane is None or line is None or skins is None or standing is None:
            return None
        top = _in_plane(line, plane)
        lowest = _in_plane(self._cut(skins[1], plane).reshape(-1, 3), plane)
        lowest = lowest[lowest[:, 0].argsort()]
        bottom = np.stack([top[:, 0], np.interp(top[:, 0], *lowest.T)], axis=1)
        skin = _in_plane(self._cut(standing, plane), plane)
        return Profile(top, bottom, skin, self._cover_line(surface, line, top, bottom))

    def line(self, surface: InsolePreview) -> FloatArray | None:
        """Return the line in which the plane cuts the contact surface.

        Returns
        -------
        (n, 3) float64, mm, or None
            None if the plane misses the surface.
        """
        plane, field = self.plane, surface.contact
        if plane is None or field is None:
            return None
        if self._line is None or self._line[0] is not plane or self._line[1] is not field:
            self._line = plane, field, self._line_of(surface, field, plane)
        return self._line[2]

    def _line_of(
        self, surface: InsolePreview, field: HeightField, plane: SectionPlane
    ) -> FloatArray | None:
        skins = surface.skins
        if skins is None:
            return None
        reached = _in_plane(self._cut(skins[0], plane).reshape(-1, 3), plane)[:, 0]
        if len(reached) == 0:
            return None
        start, end = float(reached.min()), float(reached.max())
        distance = np.linspace(start, end, max(round((end - start) / field.step_mm), 1) + 1)
        places = np.array(plane.origin_mm) + distance[:, None] * plane.along
        return np.column_stack([places, surface.heights_mm(places)])

    def _cover_line(
        self, surface: InsolePreview, line: FloatArray, top: FloatArray, bottom: FloatArray
    ) -> FloatArray | None:
        """Return the lower side (n, 2) of the cover below a line (n, 3), above the bottom."""
        cover_mm, field = surface.cover_mm, surface.contact
        if cover_mm <= 0 or field is None:
            return None
        if self._cover is None or self._cover[0] is not field or self._cover[1] != cover_mm:
            below = replace(field, heights_mm=parallel_below(field, cover_mm))
            self._cover = field, cover_mm, below
        heights = np.nan_to_num(self._cover[2].height_at(line[:, :2]))
        return np.column_stack([top[:, 0], np.clip(heights, bottom[:, 1], top[:, 1])])

    def _cut(self, mesh: TriangleMesh, plane: SectionPlane) -> FloatArray:
        origin = np.append(plane.origin_mm, 0.0)
        for slices in self._slices:
            if slices.mesh is mesh and slices.turn_deg == plane.turn_deg:
                return slices.sections.through(origin)
        slices = _Slices(mesh, plane.turn_deg, ParallelSections(mesh, plane.normal))
        self._slices = [*self._slices, slices][-_KEPT:]
        return slices.sections.through(origin)


@dataclass(frozen=True, eq=False)
class _Slices:
    """The sections of a mesh in one direction."""

    mesh: TriangleMesh
    turn_deg: float
    sections: ParallelSections


def _in_plane(points: FloatArray, plane: SectionPlane) -> FloatArray:
    """Return distance along the plane and height of points (..., 3)."""
    distance = (points[..., :2] - np.array(plane.origin_mm)) @ plane.along
    return np.stack([distance, points[..., 2]], axis=-1)
