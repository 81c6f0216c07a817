"""Values on a surface: as colours, perceptually uniform, and as contour lines that show a form."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
import numpy.typing as npt
import scipy

from insole_core.foot.display_surface import DisplaySurface
from insole_core.geometry.arrays import BoolArray, FloatArray, IndexArray, IntArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.sections import level_lines
from insole_studio.texts import localised, tr

MISSING = "#a9a9a9"
"""Colour of what has no value."""
_VIRIDIS = ("#440154", "#414487", "#2a788e", "#22a884", "#7ad151", "#fde725")
_FROM_LIGHT = ("#fff7ec", "#fdd49e", "#fc8d59", "#d7301f", "#7f0000")
_SIGNED = ("#2166ac", "#67a9cf", "#f7f7f7", "#ef8a62", "#b2182b")
STEP_MM = 1.0
_STRONG = 5
"""Every fifth line is drawn stronger, and labelled."""
_STEEPEST_DEG, _STEEPEST_STRONG_DEG = 25.0, 50.0
"""Steeper than this, lines 1 mm and 5 mm apart would merge to a dark band."""
_STEEPEST_LABEL_DEG = 25.0
_LABEL_ROOM_MM, _LABEL_GAP_MM = 5.0, 22.0
"""Least distance of a label from the rim and the lines of other levels, and from other labels."""


@dataclass(frozen=True)
class Swatch:
    """A colour of a legend and what it means.

    Parameters
    ----------
    text
    color, stripe
        As "#rrggbb"; striped with the second, so that it is known without its colour too.
    is_slanted
        Whether the stripes are, or else level.
    """

    text: str
    color: str
    stripe: str = ""
    is_slanted: bool = True


@dataclass(frozen=True, eq=False)
class Coloring:
    """A colour map and the values it shows.

    Parameters
    ----------
    values : (n,) float64
        One per vertex.
    limits
        Values of the first and the last colour.
    title
        Title of the legend.
    signed
        Whether the map diverges, with white at zero.
    from_light
        Whether the map begins as light as the material, and goes to a dark red.
    unit
        Unit of the values, for the legend.
    is_clipped
        Whether greater values are shown by the last colour too, for the legend.
    missing
        What it means that a value is NaN, for the legend; empty if it is not told there.
    painted : (n, 3) uint8, optional
        Colours to show in place of those of the map, such as a map over the skin.
    swatches
        What colours mean that are not in the map, for the legend.
    """

    values: FloatArray
    limits: tuple[float, float]
    title: str
    signed: bool = False
    from_light: bool = False
    unit: str = "mm"
    is_clipped: bool = False
    missing: str = ""
    painted: npt.NDArray[np.uint8] | None = None
    swatches: tuple[Swatch, ...] = ()

    @property
    def color_map(self) -> str:
        """Name of the map in the renderer."""
        if self.from_light:
            return "OrRd"
        return "RdBu_r" if self.signed else "viridis"

    @property
    def colors(self) -> tuple[str, ...]:
        """The map's colours at equal steps, for the legend."""
        if self.from_light:
            return _FROM_LIGHT
        return _SIGNED if self.signed else _VIRIDIS


def map_colors(
    values: FloatArray, limits: tuple[float, float], *, signed: bool = False
) -> FloatArray:
    """Return the colours (n, 3), 0 to 255, of values (n,), as the legend of a map shows them."""
    steps = np.array([rgb(color) for color in (_SIGNED if signed else _VIRIDIS)])
    share = (values - limits[0]) / (limits[1] - limits[0]) * (len(steps) - 1)
    return np.stack([np.interp(share, np.arange(len(steps)), steps[:, i]) for i in range(3)], 1)


def rgb(color: str) -> tuple[int, int, int]:
    """Return red, green and blue of "#rrggbb", 0 to 255."""
    red, green, blue = (int(color[i : i + 2], 16) for i in (1, 3, 5))
    return red, green, blue


def on_display(
    surface: DisplaySurface, coloring: Coloring | None
) -> tuple[TriangleMesh, Coloring | None]:
    """Return the mesh to show of a foot, and its colours there.

    Parameters
    ----------
    surface
        The foot's surface for display.
    coloring
        Of the measured surface; None for the foot's own colours.

    Returns
    -------
    mesh
        Of the display surface.
    coloring
        Filled gaps have no value; None for the foot's own colours.
    """
    if coloring is None:
        return surface.mesh, None
    mesh, values = surface.with_values(coloring.values)
    is_known = bool(np.isfinite(coloring.values).all())  # else grey means other things as well
    missing = tr("not measured") if is_known and surface.is_filled.any() else ""
    return mesh, replace(coloring, values=values, missing=missing)


@dataclass(frozen=True, eq=False)
class ContourLines:
    """Lines of equal height, ready to be drawn.

    Parameters
    ----------
    thin, strong : (k, 2, 3) float64, mm, insole frame
        Segments of the lines.
    labels
        Places (3,) on strong lines, mm, and the heights there as text.
    """

    thin: FloatArray
    strong: FloatArray
    labels: tuple[tuple[FloatArray, str], ...]


def contour_lines(
    vertices: FloatArray, normals: FloatArray, triangles: IndexArray, rim: BoolArray
) -> ContourLines:
    """Draw a line every millimetre of height where the surface is not steep, numbers included.

    Parameters
    ----------
    vertices : (n, 3) float64, mm, insole frame
    normals : (n, 3) float64
        Unit normals.
    triangles : (m, 3) int32
        Of the contact surface.
    rim : (n,) bool
        Whether a vertex lies at its edge.
    """
    lines = level_lines(vertices, triangles, STEP_MM)
    upward = normals[triangles[lines.triangle], 2].mean(axis=1)
    is_strong = lines.number % _STRONG == 0
    thin = ~is_strong & (upward > _cos(_STEEPEST_DEG))
    strong = is_strong & (upward > _cos(_STEEPEST_STRONG_DEG))
    gentle = upward[strong] > _cos(_STEEPEST_LABEL_DEG)
    labels = _labels(
        lines.segments[strong].mean(axis=1), lines.number[strong], gentle, vertices[rim]
    )
    return ContourLines(lines.segments[thin], lines.segments[strong], labels)


def _labels(
    places: FloatArray, number: IntArray, gentle: BoolArray, rim: FloatArray
) -> tuple[tuple[FloatArray, str], ...]:
    """Put a label where a line is furthest from rim and other levels, if there is room."""
    labels: list[tuple[FloatArray, str]] = []
    for level in np.unique(number[gentle]):
        here = places[gentle & (number == level)]
        others = places[number != level]
        around = np.concatenate([others, rim])[:, :2]
        room = np.asarray(scipy.spatial.cKDTree(around).query(here[:, :2])[0])
        for place, _ in labels:
            near = np.linalg.norm(here[:, :2] - place[:2], axis=1) < _LABEL_GAP_MM
            room[near] = 0.0
        best = int(room.argmax())
        if room[best] >= _LABEL_ROOM_MM:
            labels.append((here[best], localised(level * STEP_MM, "g")))
    return tuple(labels)


def _cos(angle_deg: float) -> float:
    return float(np.cos(np.radians(angle_deg)))
