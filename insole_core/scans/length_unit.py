"""Conclude the unit of a scan from its size."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import chain
from pathlib import Path

import numpy as np

from insole_core.formats.units import MM_PER_UNIT, UNIT_NAMES, Unit, UnitError
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.mesh_graph import in_large_pieces
from insole_core.scans.surroundings import without_sheet

_LENGTH_MM = (80.0, 600.0)  # of a foot or a part of it, with or without the lower leg
_FOOT_MM = (140.0, 330.0)  # of a whole foot; no number is one of these in two units
_SHEET_TOLERANCE = 0.006  # of the longest extent
_LEAST_PIECE = 0.02


def stated_or_likely_unit(mesh: TriangleMesh, stated: Unit | None, path: Path) -> Unit:
    """Return the unit in which the surface is as large as a foot: the stated one, if it is.

    Raises
    ------
    UnitError
        When there is none.
    """
    extent = _extent(mesh)
    for length in chain([extent], _without_surroundings(mesh, extent)):
        unit = _likely_unit(length, stated)
        if unit is not None:
            return unit
    raise UnitError(
        "{path} measures {length:g} in its longest direction, which is no foot in millimetres, "
        "centimetres, metres or inches; check the unit of the export.",
        path=path,
        length=extent,
    )


def checked_length(mesh: TriangleMesh, mm_per_unit: float, path: Path, unit: Unit | None) -> None:
    """Refuse a scan that is no foot in its unit, or None by a known size.

    Raises
    ------
    UnitError
    """
    extent = _extent(mesh)
    if _is_length(extent * mm_per_unit, _LENGTH_MM):
        return
    if any(
        _is_length(length * mm_per_unit, _LENGTH_MM)
        for length in _without_surroundings(mesh, extent)
    ):
        return
    if unit is None:
        raise UnitError(
            "{path} is {length_mm:.0f} mm long by the size that is given, which is no foot; check "
            "the size.",
            path=path,
            length_mm=extent * mm_per_unit,
        )
    raise UnitError(
        "{path} is {length_mm:.0f} mm long if it is read in {unit}, which is no foot; "
        "choose another unit.",
        path=path,
        length_mm=extent * mm_per_unit,
        unit=UNIT_NAMES[unit],
    )


def _extent(mesh: TriangleMesh) -> float:
    return float(np.ptp(mesh.vertices, axis=0).max())


def _without_surroundings(mesh: TriangleMesh, extent: float) -> Iterator[float]:
    """Yield the extent without scraps, and then without a floor as well."""
    if len(mesh.triangles):
        large = in_large_pieces(mesh, _LEAST_PIECE)
        part = mesh.part(large) if large.any() else mesh
        yield _extent(part)
        yield _extent(without_sheet(part, _SHEET_TOLERANCE * extent))


def _likely_unit(extent: float, stated: Unit | None) -> Unit | None:
    """Return the unit in which the extent is a foot's, or else a foot with its leg or a part."""
    if stated is not None and _is_length(extent * MM_PER_UNIT[stated], _LENGTH_MM):
        return stated
    for limits in (_FOOT_MM, _LENGTH_MM):
        for unit, factor in MM_PER_UNIT.items():
            if _is_length(extent * factor, limits):
                return unit
    return None


def _is_length(length_mm: float, limits: tuple[float, float]) -> bool:
    return limits[0] <= length_mm <= limits[1]
