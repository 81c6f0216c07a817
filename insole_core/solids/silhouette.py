"""Outlines of solids from above, of all parts for a cutting machine, and of the solid modeller."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Final

import numpy as np

from insole_core.formats.dxf import DxfOutline, DxfText
from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.polygon import signed_area_mm2
from insole_core.geometry.transforms import transform
from insole_core.insole.outline.insole_outline import shoe_inside
from insole_core.solids.order import Part
from insole_core.solids.shop import Block
from insole_core.solids.simplification import to_manifold
from insole_core.solids.solid_outline import outline_of

if TYPE_CHECKING:
    import manifold3d

_LEAST_MM2: Final = 0.01
"""Of an area; less is a sliver of the triangles."""


def silhouette(solid: TriangleMesh) -> tuple[FloatArray, ...]:
    """Return the outlines (n, 2) of a solid from above, mm; holes turn clockwise.

    Raises
    ------
    DesignError
        If it is not closed.
    """
    return polygons_of(to_manifold(solid).project())


def polygons_of(area: manifold3d.CrossSection) -> tuple[FloatArray, ...]:
    """Return the polygons (n, 2) of an area, mm, without slivers."""
    found = (np.asarray(polygon, float) for polygon in area.to_polygons())
    return tuple(polygon for polygon in found if abs(signed_area_mm2(polygon)) > _LEAST_MM2)


def outlines_of(part: Part, insole2file: FloatArray) -> Iterator[DxfOutline]:
    """Yield the outlines of a part.

    Parameters
    ----------
    insole2file : (4, 4) float64, mm

    Yields
    ------
    DxfOutline
        INSOLE is the solid from above, with its walls; COVER the edge of the surface that the
        cover is glued on; SHOE the inside of the shoe of the prescription, where it names one.

    Raises
    ------
    DesignError
        When the solid is not closed.
    """
    for polygon in silhouette(part.solid):
        yield DxfOutline("INSOLE", _placed(polygon, insole2file))
    if part.order.kind != "insole":
        return
    insole = part.insole
    yield DxfOutline("COVER", _placed(outline_of(insole), insole2file))
    inside = shoe_inside(insole.foot, insole.design.outline)
    if inside is not None:
        yield DxfOutline("SHOE", _placed(inside, insole2file))


def block_outline(block: Block, middle_mm: tuple[float, float]) -> DxfOutline:
    """Return the outline of a block, its length along y, about its middle."""
    length, width, _ = block.sides_mm
    corners = np.array([(-1.0, -1), (1, -1), (1, 1), (-1, 1)]) * [width / 2, length / 2]
    return DxfOutline("BLOCK", corners + middle_mm)


def mark_text(text: str, outlines: Sequence[DxfOutline]) -> DxfText:
    """Return a mark in the middle of outlines, along their length."""
    points = np.concatenate([outline.points_mm for outline in outlines])
    x, y = ((points.min(axis=0) + points.max(axis=0)) / 2).tolist()
    wide, tall = np.ptp(points, axis=0)
    return DxfText(text, (x, y), turn_deg=90.0 if tall > wide else 0.0)


def _placed(polygon: FloatArray, a2b: FloatArray) -> FloatArray:
    return transform(a2b, np.pad(polygon, ((0, 0), (0, 1))))[:, :2]
