"""How a body came out of a printer: its size and skew, from a bar printed beside it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from insole_core.errors import CalibrationError
from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.messages import Message

MOST_SIZE, MOST_SKEW_DEG = 0.03, 1.0
"""What is corrected; a print that is farther off is not worth a proof."""
_MOST_DISAGREEMENT_MM = 0.3


@dataclass(frozen=True)
class PrintedBar:
    """A bar with upright sides, printed beside a body and turned like it, and its readings.

    Parameters
    ----------
    drawn_mm
        Its edges along x, y and z in the file.
    edges_mm
        The same edges of the print, by callipers.
    diagonals_mm
        Of its face in x and y: the one from the corner of least x and y, then the other.

    Raises
    ------
    CalibrationError
        When the readings contradict each other, or the print is too far off to be used.
    """

    drawn_mm: tuple[float, float, float]
    edges_mm: tuple[float, float, float]
    diagonals_mm: tuple[float, float]

    def __post_init__(self) -> None:
        lengths = (*self.drawn_mm, *self.edges_mm, *self.diagonals_mm)
        if not np.isfinite(lengths).all() or min(lengths) <= 0:
            raise CalibrationError("A length of the printed bar is not above 0; measure it again.")
        x, y, _ = self.edges_mm
        from_edges, from_diagonals = np.hypot(x, y), np.hypot(*self.diagonals_mm) / np.sqrt(2)
        if abs(from_edges - from_diagonals) > _MOST_DISAGREEMENT_MM:
            raise CalibrationError(
                "By its edges the diagonals of the printed bar are {edges:.1f} mm in the mean, but "
                "{diagonals:.1f} mm was read; measure edges and diagonals again.",
                edges=from_edges,
                diagonals=from_diagonals,
            )
        if np.abs(self.sizes - 1).max() > MOST_SIZE or abs(self.skew_deg) > MOST_SKEW_DEG:
            raise CalibrationError(
                "The print is off by {off}; up to {most:g} % and {skew:g}° are corrected. "
                "Check the readings, in mm along x, y and z; if they are right, calibrate the "
                "printer and print the body again.",
                off=self.text,
                most=100 * MOST_SIZE,
                skew=MOST_SKEW_DEG,
            )

    @property
    def sizes(self) -> FloatArray:
        """(3,) by which the print is larger than drawn, along x, y and z."""
        return np.asarray(np.array(self.edges_mm) / self.drawn_mm)

    @property
    def skew_deg(self) -> float:
        """By how much the printed y leans towards x."""
        x, y, _ = self.edges_mm
        first, second = self.diagonals_mm
        return float(np.degrees(np.arcsin(np.clip((first**2 - second**2) / (4 * x * y), -1, 1))))

    @property
    def text(self) -> Message:
        """Size and skew in words."""
        x, y, z = 100 * (self.sizes - 1)
        return Message(
            "x {x:+.2f} %, y {y:+.2f} %, z {z:+.2f} %, skew {skew:+.2f}°",
            x=x,
            y=y,
            z=z,
            skew=self.skew_deg,
        )

    def printed(self, drawn: TriangleMesh) -> TriangleMesh:
        """Return the form that a drawn body, mm, has as printed."""
        return drawn.moved(self.placed(drawn.vertices))

    def placed(self, drawn: FloatArray) -> FloatArray:
        """Return where drawn points (..., 3), mm, lie in the print, whose origin stays."""
        skew = np.radians(self.skew_deg)
        axes = np.array([[1, 0, 0], [np.sin(skew), np.cos(skew), 0], [0, 0, 1]])
        return np.asarray(drawn @ (self.sizes[:, None] * axes))
