"""What is said of an object whose capture proves the chain: its kind, its size, or its scan."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np

from insole_core.errors import CalibrationError, UsageError
from insole_core.evaluation.find_form import (
    find_ball,
    find_cylinder,
    find_scan,
    is_laid_on,
    on_form,
)
from insole_core.evaluation.known_form import KnownForm, Scan, ScannedBody, fitted
from insole_core.evaluation.printed_body import PrintedBar
from insole_core.geometry.arrays import BoolArray, FloatArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.transforms import rotation_angle_deg
from insole_core.messages import Message
from insole_core.recording.session import ReferenceSystem

SIZES_MM = (40.0, 400.0)
_USUAL_TOLERANCE_MM, _USUAL_TOLERANCE = 4.0, 0.02
_MOST_SCALE = 0.01
"""More than sensors are off; prints that nobody measured are."""


class _Fitted:
    """A body whose place is not known: it is laid onto what was measured of it."""

    def reference_form(self, found: KnownForm, best: KnownForm) -> KnownForm:
        """Return which place errors are counted from: where it was found, or where it fits best."""
        return best

    def is_judged(self, points: FloatArray) -> BoolArray:
        """Return whether points (n, 3), reference frame, mm, lie where errors of it count."""
        return np.ones(len(points), dtype=bool)


@dataclass(frozen=True)
class KnownRound(_Fitted):
    """A ball or a cylinder.

    Parameters
    ----------
    kind
        Which of the two.
    least_mm, most_mm
        What its true diameter lies between; equal where it was measured.
    tolerance_mm
        How much farther the fitted diameter may be off before it counts as another object; by
        default 4 mm, or 2 % where that is more.

    Raises
    ------
    UsageError
        When a size is not that of an object that fits in the place of a foot.
    """

    kind: Literal["ball", "cylinder"]
    least_mm: float
    most_mm: float
    tolerance_mm: float | None = None

    def __post_init__(self) -> None:
        low, high = SIZES_MM
        if not low <= self.least_mm <= self.most_mm <= high:
            raise UsageError(
                "The diameter of the {kind} is {size}, but must lie between {low:g} and {high:g} "
                "mm; give it in millimetres.",
                kind=self.kind,
                size=self.size_text,
                low=low,
                high=high,
            )
        if self.tolerance_mm is not None and not 0 < self.tolerance_mm <= self.most_mm / 2:
            raise UsageError(
                "The tolerance is {tolerance:g} mm, but must be above 0 and below the radius.",
                tolerance=self.tolerance_mm,
            )

    @property
    def size_range_mm(self) -> tuple[float, float]:
        """What its true size lies between."""
        return self.least_mm, self.most_mm

    @property
    def size_text(self) -> str:
        """The diameter that was said, in words."""
        if self.least_mm == self.most_mm:
            return f"{self.least_mm:.1f} mm"
        return f"{self.least_mm:.1f} to {self.most_mm:.1f} mm"

    @property
    def text(self) -> str:
        """The object in words."""
        return f"a {self.kind} of {self.size_text} diameter"

    def true_size_mm(self, fitted_mm: float) -> float:
        """Return the diameter that is nearest to the fitted one, of those that were said."""
        return min(max(fitted_mm, self.least_mm), self.most_mm)

    def find(self, surface: TriangleMesh) -> KnownForm:
        """Find it in a surface, mm, with the size that fits best.

        Raises
        ------
        CalibrationError
            When it is not there, or of another size.
        """
        middle_mm = (self.least_mm + self.most_mm) / 2
        form: KnownForm
        if self.kind == "ball":
            form = find_ball(surface, middle_mm)
        else:
            form = find_cylinder(surface, middle_mm)
        usual_mm = max(_USUAL_TOLERANCE_MM, _USUAL_TOLERANCE * middle_mm)
        tolerance_mm = usual_mm if self.tolerance_mm is None else self.tolerance_mm
        if abs(form.size_mm - self.true_size_mm(form.size_mm)) > tolerance_mm:
            raise CalibrationError(
                "The {kind} was said to be {said} in diameter, but {found_mm:.1f} mm was measured "
                "(up to {tolerance_mm:.1f} mm off is put down to the sensors); measure it again, "
                "or calibrate the sensors.",
                kind=self.kind,
                said=self.size_text,
                found_mm=form.size_mm,
                tolerance_mm=tolerance_mm,
            )
        return form


class _OfKnownForm:
    """A body whose form is known, and its size with it."""

    scan: Scan

    @property
    def size_range_mm(self) -> tuple[float, float]:
        """Its longest extent, which is known."""
        return self.scan.extent_mm, self.scan.extent_mm

    def true_size_mm(self, fitted_mm: float) -> float:
        """Return its own size, whatever was fitted."""
        return self.scan.extent_mm


@dataclass(frozen=True, eq=False)
class KnownScan(_OfKnownForm, _Fitted):
    """A rigid body, such as a plaster cast, that another scanner has measured.

    Parameters
    ----------
    scan
        As printed, where a bar was measured.
    name
        Of its file.
    bar
        Printed beside the body, which was drawn, not scanned.
    """

    scan: Scan
    name: str
    bar: PrintedBar | None = None

    @property
    def text(self) -> str:
        """The object in words."""
        if self.bar is None:
            return f"the body of {self.name}"
        return Message(
            "the body of {name} as it was printed ({off})", name=self.name, off=self.bar.text
        )

    def find(self, surface: TriangleMesh) -> KnownForm:
        """Lay the scan onto a surface, mm.

        Raises
        ------
        CalibrationError
            When it does not fit.
        """
        return find_scan(surface, self.scan, self.name)


@dataclass(frozen=True, eq=False)
class KnownPlaced(_OfKnownForm):
    """A body whose place among the markers is known too, so that nothing is fitted.

    Parameters
    ----------
    scan
        In the reference frame, as printed where a bar was measured.
    name
    system
        The markers that it carries, as printed.
    bar
        Printed with the body.
    """

    scan: Scan
    name: str
    system: ReferenceSystem
    bar: PrintedBar | None = None

    @property
    def text(self) -> str:
        """The object in words."""
        if self.bar is None:
            return Message("{name} as it was drawn, its print not measured", name=self.name)
        return Message("{name} as it was printed ({off})", name=self.name, off=self.bar.text)

    def reference_form(self, found: KnownForm, best: KnownForm) -> KnownForm:
        """Return its own place."""
        return found

    def is_judged(self, points: FloatArray) -> BoolArray:
        """Return whether points (n, 3), reference frame, mm, lie on the foot, not on its stand."""
        return self.scan.is_judged(points)

    def find(self, surface: TriangleMesh) -> KnownForm:
        """Return it in its place, where a surface, mm, reference frame, must show it.

        Raises
        ------
        CalibrationError
            When the surface is that of another body, or lies elsewhere among the markers.
        """
        placed = ScannedBody(self.scan, np.eye(4))
        if is_laid_on(placed, surface):
            self._check_size(placed, surface)
            return placed
        found = find_scan(surface, self.scan, self.name)
        away_mm, turn_deg = moved_by(placed, found)
        raise CalibrationError(
            "{name} stands {away_mm:.1f} mm and {turn_deg:.1f}° from its place among the markers; "
            "check that the markers are those of its own stand and lie flat on its posts.",
            name=self.name,
            away_mm=away_mm,
            turn_deg=turn_deg,
        )

    def _check_size(self, placed: ScannedBody, surface: TriangleMesh) -> None:
        own = on_form(placed, surface.vertices, surface.vertex_normals)
        points, areas = surface.vertices[own], surface.vertex_areas[own]
        scale = fitted(placed, points, areas, size=True).scale
        if abs(scale - 1) > _MOST_SCALE:
            raise CalibrationError(
                "{text}: what was captured is {percent:+.1f} % off that size; measure the bar that "
                "was printed with it again, and name the readings with --callipers.",
                text=self.text,
                percent=100 * (scale - 1),
            )


def moved_by(placed: KnownForm, found: KnownForm) -> tuple[float, float]:
    """Return how far a body was found from its place, mm, and by how much turned, degrees."""
    away_mm = float(np.linalg.norm(found.centre_mm - placed.centre_mm))
    if not (isinstance(placed, ScannedBody) and isinstance(found, ScannedBody)):
        return away_mm, 0.0
    turn = found.scan2place[:3, :3] @ placed.scan2place[:3, :3].T
    return away_mm, rotation_angle_deg(turn)


KnownObject = KnownRound | KnownScan | KnownPlaced
