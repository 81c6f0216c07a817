"""Numbers on a surface as colours: perceptually uniform; white is zero where they are signed."""

from __future__ import annotations

from dataclasses import dataclass

from insole_core.geometry.arrays import FloatArray

_VIRIDIS = ("#440154", "#414487", "#2a788e", "#22a884", "#7ad151", "#fde725")
_SIGNED = ("#2166ac", "#67a9cf", "#f7f7f7", "#ef8a62", "#b2182b")


@dataclass(frozen=True, eq=False)
class Coloring:
    """What a colour map shows.

    Parameters
    ----------
    values : (n,) float64
        One a vertex.
    limits
        Numbers of the first and the last colour.
    title
        What is shown, for the legend.
    signed
        Whether zero is the middle, and white.
    unit
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
        """The map's colours at equal distances, for the legend."""
        return _SIGNED if self.signed else _VIRIDIS
