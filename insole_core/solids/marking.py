"""Identification engraved into a flat bottom, or raised from it."""

from __future__ import annotations

from typing import Literal, TypeAlias

import manifold3d
import numpy as np

from insole_core.errors import DesignError
from insole_core.export.lettering import font_path, with_known_letters
from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.solids.simplification import from_manifold, to_manifold

Relief: TypeAlias = Literal["engraved", "raised"]

_OVERLAP_MM = 0.2  # letters extend through the bottom face, so that no sliver remains
_LEAST_LETTER_MM = 2.0
_LINE_PITCH = 1.5  # relative to the letters' height
_CLEAR_MM = 2.0


def mark(
    solid: TriangleMesh,
    lines: tuple[str, ...],
    *,
    centre_mm: tuple[float, float],
    room_mm: tuple[float, float],
    letter_mm: float = 7.0,
    depth_mm: float = 0.6,
    relief: Relief = "engraved",
) -> TriangleMesh:
    """Write lines on the bottom plane of a solid, to be read from below, along y.

    Parameters
    ----------
    solid : mm
        Standing flat on z = 0.
    lines
        In any script; letters missing from the font become a similar one or "?".
    centre_mm, room_mm
        Centre and size (x, y) of the area for the lettering, which is scaled down to fit.
    letter_mm
        Height of a capital letter.
    depth_mm
        Height of the relief.

    Returns
    -------
    TriangleMesh, mm, frame of `solid`

    Raises
    ------
    DesignError
        If nothing is left to write, it does not fit, or the bottom is not flat there.
    """
    known = [text for text in map(with_known_letters, lines) if text]
    if not known:
        raise DesignError("The identification is empty; write a pseudonym, side or date.")
    section = _section(known)
    section = _fitted(section, letter_mm, (room_mm[1], room_mm[0]))
    # Turned by 90 degrees to run along y, and mirrored to be read from below.
    section = section.mirror([1.0, 0.0]).rotate(-90.0).translate(list(centre_mm))
    bottom = float(solid.bounds_mm[0, 2])
    start = bottom - (_OVERLAP_MM if relief == "engraved" else depth_mm)
    letters = section.extrude(depth_mm + _OVERLAP_MM).translate([0.0, 0.0, start])
    body = to_manifold(solid)
    marked = body - letters if relief == "engraved" else body + letters
    _check_depth(body, marked, section.area() * depth_mm)
    return from_manifold(marked)


def _check_depth(
    plain: manifold3d.Manifold, marked: manifold3d.Manifold, expected_mm3: float
) -> None:
    if abs(abs(plain.volume() - marked.volume()) - expected_mm3) > 0.02 * expected_mm3:
        raise DesignError(
            "The identification does not lie wholly on a flat bottom; write it elsewhere, smaller,"
            " or make the bottom flat."
        )


def _section(lines: list[str]) -> manifold3d.CrossSection:
    """Return letters of unit capital height, the lines below each other, centred on the origin."""
    # Letters are rarely wanted, and matplotlib takes long to import.
    from matplotlib.font_manager import FontProperties
    from matplotlib.textpath import TextPath

    font = FontProperties(fname=str(font_path()))
    polygons: list[FloatArray] = []
    for number, text in enumerate(lines):
        path = TextPath((0, 0), text, size=1.0, prop=font)
        outlines = [np.asarray(p, float)[:-1] for p in path.to_polygons()]
        width = max((float(p[:, 0].max()) for p in outlines), default=0.0)
        polygons += [p - [width / 2, number * _LINE_PITCH] for p in outlines]
    section = manifold3d.CrossSection(polygons, manifold3d.FillRule.NonZero)
    low_x, low_y, high_x, high_y = section.bounds()
    return section.translate([-(low_x + high_x) / 2, -(low_y + high_y) / 2])


def _fitted(
    section: manifold3d.CrossSection, letter_mm: float, room_mm: tuple[float, float]
) -> manifold3d.CrossSection:
    """Scale unit letters to their height, or to the available area."""
    low_x, low_y, high_x, high_y = section.bounds()
    scale = min(
        letter_mm / 0.73,  # a capital of DejaVu Sans is 0.73 of the font size
        (room_mm[0] - _CLEAR_MM) / max(high_x - low_x, 1e-9),
        (room_mm[1] - _CLEAR_MM) / max(high_y - low_y, 1e-9),
    )
    if scale * 0.73 < _LEAST_LETTER_MM:
        raise DesignError(
            "The identification is too long for its place; shorten it, so that its letters can be "
            "at least {least_mm:g} mm high.",
            least_mm=_LEAST_LETTER_MM,
        )
    return section.scale([scale, scale])
