"""Values on a surface as colours: perceptually uniform maps, white at zero for signed values."""

from __future__ import annotations

from dataclasses import dataclass

from insole_core.geometry.arrays import FloatArray

_VIRIDIS = ("#440154", "#414487", "#2a788e", "#22a884", "#7ad151", "#fde725")
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
    unit
        Unit of the values, for the legend.
    """

    values: FloatArray
    limits: tuple[float, float]
    title: str
    signed: bool = False
    unit: str = "mm"

    @property
    def color_map(self) -> str:
        """Name of the map in the renderer."""
        return "RdBu_r" if self.signed else "viridis"

    @property
    def colors(self) -> tuple[str, ...]:
        """The map's colours at equal steps, for the legend."""
        return _SIGNED if self.signed else _VIRIDIS
