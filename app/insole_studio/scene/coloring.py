"""Values on a surface as colours: perceptually uniform maps, white at zero for signed values."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
import numpy.typing as npt

from insole_core.foot.display_surface import DisplaySurface
from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.mesh import TriangleMesh
from insole_studio.texts import tr

MISSING = "#a9a9a9"
"""Colour of what has no value."""

_VIRIDIS = ("#440154", "#414487", "#2a788e", "#22a884", "#7ad151", "#fde725")
_FROM_LIGHT = ("#fff7ec", "#fdd49e", "#fc8d59", "#d7301f", "#7f0000")
_SIGNED = ("#2166ac", "#67a9cf", "#f7f7f7", "#ef8a62", "#b2182b")


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
    missing
        What it means that a value is NaN, for the legend; empty if it is not told there.
    painted : (n, 3) uint8, optional
        Colours to show in place of those of the map, such as a map over the skin.
    """

    values: FloatArray
    limits: tuple[float, float]
    title: str
    signed: bool = False
    from_light: bool = False
    unit: str = "mm"
    missing: str = ""
    painted: npt.NDArray[np.uint8] | None = None

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


def map_colors(values: FloatArray, limits: tuple[float, float]) -> FloatArray:
    """Return the colours (n, 3), 0 to 255, of values (n,), as the legend of a map shows them."""
    steps = np.array([[int(color[i : i + 2], 16) for i in (1, 3, 5)] for color in _VIRIDIS])
    share = (values - limits[0]) / (limits[1] - limits[0]) * (len(steps) - 1)
    return np.stack([np.interp(share, np.arange(len(steps)), steps[:, i]) for i in range(3)], 1)


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
