"""The reference foot: a body that anyone can print, and that proves the whole chain.

It is the simulated foot on a stand that carries the markers of a reference system of its own, so
that its place among them is known and nothing is fitted. It is printed on its stand, the sole up:
what lies above the foot as it hangs is filled down to the stand, so that no support touches what is
measured.

Its form must stay what clinics have printed: another form is another version.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache, reduce

import manifold3d
import numpy as np
import scipy

from insole_core.calibration.boards.printed_page import MARKER_MM
from insole_core.evaluation.printed_body import PrintedBar
from insole_core.geometry.arrays import BoolArray, FloatArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.side import Side
from insole_core.geometry.transforms import inverse, rigid, transform
from insole_core.recording.session import Marker, ReferenceSystem
from insole_core.simulate.foot_field import FootField
from insole_core.simulate.foot_shape import FootShape
from insole_core.simulate.iso_surface import extract_surface
from insole_core.solids.simplification import from_manifold, to_manifold

NAME = "reference-foot-1"
"""Of the body and of its reference system, with the version of its form."""
BAR_MM = (100.0, 80.0, 40.0)
"""Edges of the bar that shows size and skew of the print."""
FILM_MM = 0.1
"""Thickness of the blue film that is glued onto the end of a post, as its marker."""
BED_MM = (220.0, 220.0, 250.0)
"""Of a printer that it fits on."""
_SHAPE = FootShape(200.0, 80.0, 55.0, 15.0, 3.0, Side.LEFT)
_CELL_MM, _SMOOTHING_CELLS, _MARGIN_MM = 1.6, 0.8, 8.0
_FLAT_MM = 0.01
"""Triangles that lie in one plane but for this are joined."""
_HALF_WIDTH_MM = 60.0
_FILLED_FROM_MM = 70.0
"""From the heel on: where the front of the leg ends."""
_FILLED_Y_MM = _FILLED_FROM_MM - _SHAPE.length_mm / 2 - 3.0
_UPRIGHT = 0.05
_LEG_END_MM = 133.0
_LOW_MM = 45.0
_WIDEST_AT = {
    "forefoot width": (0.55, 0.8),
    "heel width": (0.05, 0.3),
}
"""Shares of the length."""
PLATE_MM = ((-106.0, -106.0, 130.0), (106.0, 112.0, 136.0))
_HOLE_MM, _HOLE_INSET_MM = 5.0, 14.0
_STEP_MM = 24.0
_BAR_WALL_MM = 15.0
_SOLE = (
    (-66.0, -72.0, 10.0), (-92.0, -84.0, 24.0), (70.0, -80.0, 20.0), (96.0, -74.0, 2.0),
    (-86.0, -38.0, -6.0), (-98.0, 8.0, 22.0), (-80.0, 46.0, 6.0), (-96.0, 84.0, 26.0),
    (84.0, -30.0, 28.0), (98.0, 20.0, -2.0), (82.0, 62.0, 18.0), (98.0, 96.0, 8.0),
    (-52.0, 104.0, 14.0),
)  # fmt: skip
_ACHILLES = (
    (-66.0, -82.0, 30.0), (-66.0, -95.0, 74.0), (-92.0, -94.0, 46.0), (-92.0, -104.0, 104.0),
    (70.0, -90.0, 40.0), (70.0, -99.0, 94.0), (96.0, -84.0, 58.0), (96.0, -93.0, 112.0),
)  # fmt: skip
"""Markers that face -z and -y, mm, reference frame; each fills the end or the edge of its post."""
_PRINTED2REFERENCE = rigid(np.diag([1.0, -1.0, -1.0]), np.array([PLATE_MM[0][0], *PLATE_MM[1][1:]]))
"""As it is printed its plate lies on the bed, with a corner in the origin."""


@dataclass(frozen=True, eq=False)
class ReferenceFoot:
    """The reference foot, as drawn or as printed.

    Parameters
    ----------
    form : mm, reference frame
        The closed surface that is measured.
    stand : mm, reference frame
        Plate and posts, whose ends are the markers.
    system
        Where the markers are.
    """

    form: TriangleMesh
    stand: TriangleMesh
    system: ReferenceSystem
    side: Side = _SHAPE.side

    @property
    def measures_mm(self) -> dict[str, float]:
        """What callipers show of the foot: its length, and its widths across the length."""
        foot = self.form.vertices[self.form.vertices[:, 2] < _LOW_MM]
        start, length = foot[:, 1].min(), np.ptp(foot[:, 1])
        share = (foot[:, 1] - start) / length
        widths = {
            name: float(np.ptp(foot[(share > low) & (share < high), 0]))
            for name, (low, high) in _WIDEST_AT.items()
        }
        return {"length": float(length), **widths}

    @property
    def is_foot(self) -> BoolArray:
        """(m,) which triangles of the form are the foot's own, not walls of what fills it up."""
        ahead = self.form.vertices[self.form.triangles].mean(axis=1)[:, 1] > _FILLED_Y_MM
        upright = np.abs(self.form.triangle_normals[:, 2]) < _UPRIGHT
        return np.asarray(~(ahead & upright))

    def printed(self, bar: PrintedBar) -> ReferenceFoot:
        """Return the body as it came out of a printer, form and markers alike."""

        def placed(points: FloatArray) -> FloatArray:
            own = transform(inverse(_PRINTED2REFERENCE), points)
            return transform(_PRINTED2REFERENCE, bar.placed(own))

        markers = tuple(
            Marker(one.id, _triple(placed(np.array(one.position_mm))), one.face)
            for one in self.system.markers
        )
        return ReferenceFoot(
            self.form.moved(placed(self.form.vertices)),
            self.stand.moved(placed(self.stand.vertices)),
            ReferenceSystem(self.system.name, markers),
        )

    def to_print(self) -> TriangleMesh:
        """Return form and stand as one closed solid, mm, as it lies on the printer's bed."""
        body = from_manifold(to_manifold(self.form) + to_manifold(self.stand))
        return body.transformed(inverse(_PRINTED2REFERENCE))


@cache
def reference_foot() -> ReferenceFoot:
    """Return the reference foot as it is drawn."""
    stand = from_manifold(_plate() + reduce(manifold3d.Manifold.__add__, _posts()))
    return ReferenceFoot(_form(), stand, reference_system())


def reference_system() -> ReferenceSystem:
    """Return the markers that its stand carries."""
    groups = (("S", "sole", _SOLE), ("A", "achilles", _ACHILLES))
    return ReferenceSystem(
        NAME,
        tuple(
            Marker(f"{letter}{number}", place, face)
            for letter, face, places in groups
            for number, place in enumerate(places, start=1)
        ),
    )


def scale_bar() -> TriangleMesh:
    """Return a frame whose outer faces are measured by callipers, mm, as it is printed."""
    size = np.array(BAR_MM)
    hole = size - [2 * _BAR_WALL_MM, 2 * _BAR_WALL_MM, -2.0]
    inner = manifold3d.Manifold.cube(tuple(hole)).translate((_BAR_WALL_MM, _BAR_WALL_MM, -1.0))
    return from_manifold(manifold3d.Manifold.cube(BAR_MM) - inner)


def _form() -> TriangleMesh:
    """Return the foot, filled from its widest contour to the stand before the leg."""
    low = np.array([-_HALF_WIDTH_MM, -_MARGIN_MM, -_MARGIN_MM])
    high = np.array([_HALF_WIDTH_MM, _SHAPE.length_mm + _MARGIN_MM, _LEG_END_MM + _MARGIN_MM])
    x, y, z = (np.arange(a, b, _CELL_MM) for a, b in zip(low, high, strict=True))
    field = scipy.ndimage.gaussian_filter(FootField(_SHAPE).sample(x, y, z), _SMOOTHING_CELLS)
    ahead = y > _FILLED_FROM_MM
    field[:, ahead] = np.minimum.accumulate(field[:, ahead], axis=2)
    surface = extract_surface(np.maximum(field, z - _LEG_END_MM), low, _CELL_MM)
    least, most = surface.bounds_mm
    middle = np.array([0.0, (least[1] + most[1]) / 2, least[2]])
    placed = surface.moved(surface.vertices - middle)
    return from_manifold(to_manifold(placed).simplify(_FLAT_MM))


def _plate() -> manifold3d.Manifold:
    """Return the plate of the stand, with a hole for a screw in each corner."""
    low, high = map(np.array, PLATE_MM)
    plate = _block(low, high)
    for x in (low[0] + _HOLE_INSET_MM, high[0] - _HOLE_INSET_MM):
        for y in (low[1] + _HOLE_INSET_MM, high[1] - _HOLE_INSET_MM):
            drill = manifold3d.Manifold.cylinder(20.0, _HOLE_MM / 2, circular_segments=48)
            plate -= drill.translate((x, y, low[2] - 7.0))
    return plate


def _posts() -> list[manifold3d.Manifold]:
    """Return a post for each marker, from its face to the plate; some stand in one another."""
    half, foot_mm = MARKER_MM / 2, PLATE_MM[0][2] + 1.0
    posts = []
    for x, y, z in _SOLE:
        posts.append(_block((x - half, y - half, z + FILM_MM), (x + half, y + half, foot_mm)))
    for x, y, z in _ACHILLES:
        low = (x - half, y + FILM_MM, z - half)
        posts.append(_block(low, (x + half, y + _STEP_MM, foot_mm)))
    return posts


def _block(
    low: FloatArray | tuple[float, ...], high: FloatArray | tuple[float, ...]
) -> manifold3d.Manifold:
    size = np.subtract(high, low)
    return manifold3d.Manifold.cube(_triple(size)).translate(_triple(np.asarray(low)))


def _triple(values: FloatArray) -> tuple[float, float, float]:
    x, y, z = map(float, values)
    return x, y, z
