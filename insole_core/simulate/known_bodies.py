"""Bodies of known form in the place of a foot, for a proof of the whole chain."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from insole_core.errors import UsageError
from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.recording.session import ReferenceSystem
from insole_core.simulate.iso_surface import extract_surface
from insole_core.simulate.reference_foot import ReferenceFoot, reference_foot

_CELL_MM = 2.0
"""With it a ball of 60 mm radius is 0.01 mm off, far below any sensor's error."""
SIZES_MM = (40.0, 400.0)
_CYLINDER_MM = 150.0
_MIDDLE_Y_MM = 12.0
_LOWEST_Z_MM = -5.0
_ORANGE = (196, 112, 58)
_PLATE = (92, 98, 104)
_PLATE_MM = (136.0, 10.0, 110.0)


@dataclass(frozen=True, eq=False)
class KnownBody:
    """A body in the place of a foot.

    Parameters
    ----------
    mesh : mm, reference frame, with colours
    holder : mm, reference frame, with colours
        What it rests on; seen by the sensors too.
    system
        The markers that it carries, where it has its own; by default it hangs among those of a
        foot.
    true_system
        Where they are, if it was not printed as it is drawn.
    """

    mesh: TriangleMesh
    holder: TriangleMesh
    system: ReferenceSystem | None = None
    true_system: ReferenceSystem | None = None


def ball(diameter_mm: float) -> KnownBody:
    """Return a ball that rests on a plate at the toes' end, which is below where the sole hangs.

    Raises
    ------
    UsageError
        When it would not fit in the place of a foot.
    """
    _check_size(diameter_mm)
    radius = diameter_mm / 2
    centre = np.array([0.0, _MIDDLE_Y_MM, _LOWEST_Z_MM + radius])
    mesh = _body(lambda p: np.linalg.norm(p, axis=-1) - radius, centre, np.full(3, radius))
    return on_plate(mesh)


def upright_cylinder(diameter_mm: float) -> KnownBody:
    """Return a cylinder that stands on such a plate, its axis along the foot's.

    Raises
    ------
    UsageError
        When it would not fit in the place of a foot.
    """
    _check_size(diameter_mm)
    radius, half = diameter_mm / 2, _CYLINDER_MM / 2
    centre = np.array([0.0, _MIDDLE_Y_MM, _LOWEST_Z_MM + radius])

    def distance(points: FloatArray) -> FloatArray:
        around = np.hypot(points[..., 0], points[..., 2]) - radius
        return np.asarray(np.maximum(around, np.abs(points[..., 1]) - half))

    return on_plate(_body(distance, centre, np.array([radius, half, radius])))


def printed_foot(printed: ReferenceFoot | None = None) -> KnownBody:
    """Return the reference foot, as it is drawn or as a printer made it."""
    drawn = reference_foot()
    real = drawn if printed is None else printed
    return KnownBody(
        _painted(real.form, _ORANGE), _painted(real.stand, _PLATE), drawn.system, real.system
    )


def on_plate(mesh: TriangleMesh) -> KnownBody:
    """Rest a body, mm, reference frame, on a plate at its toes' end."""
    low, high = mesh.bounds_mm
    half = np.array(_PLATE_MM) / 2
    centre = np.array([(low[0] + high[0]) / 2, high[1] + half[1], (low[2] + high[2]) / 2])
    plate = _body(lambda p: np.asarray((np.abs(p) - half).max(axis=-1)), centre, half, _PLATE)
    return KnownBody(mesh, plate)


def _check_size(diameter_mm: float) -> None:
    low, high = SIZES_MM
    if not low <= diameter_mm <= high:
        raise UsageError(
            "A body of {diameter_mm:g} mm cannot be simulated in the place of a foot; choose a "
            "diameter from {low:g} to {high:g} mm.",
            diameter_mm=diameter_mm,
            low=low,
            high=high,
        )


def _body(
    distance: Callable[[FloatArray], FloatArray],
    centre: FloatArray,
    half: FloatArray,
    color: tuple[int, int, int] = _ORANGE,
) -> TriangleMesh:
    """Mesh a distance (…,), mm, of points (…, 3) around a centre; `half` is the body's extent."""
    axes = [np.arange(-extent - 2 * _CELL_MM, extent + 3 * _CELL_MM, _CELL_MM) for extent in half]
    points = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1)
    low = centre + [axis[0] for axis in axes]
    surface = extract_surface(distance(points), low, _CELL_MM)
    return _painted(surface, color)


def _painted(mesh: TriangleMesh, color: tuple[int, int, int]) -> TriangleMesh:
    return mesh.with_attributes(colors=np.full((len(mesh.vertices), 3), color, np.uint8))
