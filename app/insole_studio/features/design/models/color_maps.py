"""Colour maps: of the insole from its surface, and of a pressure map painted over a sole."""

from __future__ import annotations

from collections.abc import Callable, Collection
from dataclasses import dataclass
from enum import StrEnum
from functools import cache

import numpy as np
import numpy.typing as npt

from insole_core.contact.change import MOST_SHOWN, Change, Shown
from insole_core.contact.stance import Sole
from insole_core.foot.foot import Foot
from insole_core.geometry.arrays import BoolArray, FloatArray, IntArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.pressure.laid_map import FootprintPicture, PressureMap
from insole_studio.document.insole_preview import InsolePreview
from insole_studio.document.side_by_side import SideBySide, foot_difference, insole_difference
from insole_studio.scene.coloring import MISSING, Coloring, Swatch, map_colors, rgb
from insole_studio.texts import fill, tr

LEAST_SPAN_MM = 1.0
_FADE_KPA = (5.0, 25.0)
"""Pressures below are not painted, and those between fade: there the foot or the insole shows."""
_LEAST_SPAN_KPA, _ROUND_KPA = 50.0, 50.0
_FACING, _HIGHEST_MM = -0.1, 30.0
_STRIPE_MM, _SLANTED = 3.0, 2**0.5
_STEPS = 256
_STEPS_A_PERCENT = (_STEPS - 1) / (2 * MOST_SHOWN)
_FIRST = np.array([0, _STEPS, _STEPS + 2, _STEPS + 4])
"""Of the colours of each `Shown`, in `_load_colors`."""
_SKIN, _MATERIAL = (224.0, 190.0, 170.0), (222.0, 216.0, 202.0)


class MapKind(StrEnum):
    """What the colours of the insole show."""

    NONE = "none"
    HEIGHT = "height"
    THICKNESS = "thickness"
    FIT = "fit"
    DIFFERENCE = "difference"
    PRESSURE = "pressure"
    LOAD = "load"


def color_by(kind: MapKind, surface: InsolePreview, counterpart: SideBySide) -> Coloring | None:
    """Return the colours of the insole.

    Parameters
    ----------
    kind
        The colour map.
    surface
        The current preview of the insole.
    counterpart
        What a difference compares with.

    Returns
    -------
    Coloring or None
        None if there is nothing to show.
    """
    if surface.mesh is None or surface.contact is None or surface.base is None:
        return None
    if kind is MapKind.DIFFERENCE:
        return _difference(surface, counterpart)
    maker = _MAKERS.get(kind)
    return None if maker is None else maker(surface)


def _height(surface: InsolePreview) -> Coloring:
    assert surface.mesh is not None
    z = surface.mesh.vertices[:, 2]
    return Coloring(z, (0.0, max(float(z.max()), LEAST_SPAN_MM)), tr("Height"))


def _thickness(surface: InsolePreview) -> Coloring:
    assert surface.mesh is not None
    bottom = surface.bottom_heights_mm
    assert bottom is not None
    thickness = surface.mesh.vertices[: len(bottom), 2] - bottom
    limits = (0.0, max(float(thickness.max()), LEAST_SPAN_MM))
    everywhere = surface.values_everywhere(thickness, thickness)
    return Coloring(everywhere, limits, tr("Thickness"))


def _fit(surface: InsolePreview) -> Coloring:
    """Colour by the height of the insole above the sole as scanned, before pads."""
    assert surface.mesh is not None
    assert surface.base is not None
    bottom = surface.bottom_heights_mm
    assert bottom is not None
    top = surface.mesh.vertices[: len(bottom)]
    over = np.nan_to_num(top[:, 2] - surface.base.surface.height_at(top[:, :2]))
    everywhere = surface.values_everywhere(over, np.zeros(len(bottom)))
    return Coloring(everywhere, _symmetric(over), tr("Insole over foot"), signed=True)


def _difference(surface: InsolePreview, counterpart: SideBySide) -> Coloring | None:
    over = insole_difference(surface, counterpart)
    if over is None:
        return None
    everywhere = surface.values_everywhere(over, np.full(len(over), np.nan))
    return Coloring(everywhere, difference_limits(over), tr("Difference"), signed=True)


def color_foot(foot: Foot, counterpart: SideBySide) -> Coloring | None:
    """Colour the sole by its difference to the other foot; None without one."""
    over = foot_difference(foot, counterpart)
    if over is None or not np.isfinite(over).any():
        return None
    return Coloring(over, difference_limits(over), tr("Difference"), signed=True)


def difference_limits(over: FloatArray) -> tuple[float, float]:
    """Return symmetric limits that enclose 99 % of the values, in steps of 0.5 mm."""
    known = np.abs(over[np.isfinite(over)])
    span = float(np.quantile(known, 0.99)) if len(known) else 0.0
    span = max(np.ceil(2 * span) / 2, LEAST_SPAN_MM)
    return -span, span


def numbers_text(over: FloatArray) -> str:
    """Return the mean of a difference, and 95 % quantile and maximum of its magnitude, as text."""
    known = over[np.isfinite(over)]
    if len(known) == 0:
        return tr("Nothing lies over each other")
    size = np.abs(known)
    return fill(
        tr("mean {mean:+.2f}   95 % {p95:.2f}   max {max:.2f} mm"),
        mean=float(known.mean()) + 0.0,
        p95=float(np.quantile(size, 0.95)),
        max=float(size.max()),
    )


def _symmetric(values: FloatArray) -> tuple[float, float]:
    span = max(float(np.abs(values).max()), LEAST_SPAN_MM)
    return -span, span


_MAKERS: dict[MapKind, Callable[[InsolePreview], Coloring]] = {
    MapKind.HEIGHT: _height,
    MapKind.THICKNESS: _thickness,
    MapKind.FIT: _fit,
}


def painted_foot(
    shown: PressureMap | FootprintPicture, mesh: TriangleMesh, opacity: float
) -> Coloring:
    """Return the colours of a foot with a map over its sole.

    Parameters
    ----------
    shown
        The map or picture, under the foot.
    mesh : mm, insole frame
        The foot as shown.
    opacity
        0 to 1.
    """
    if mesh.colors is not None:
        base = mesh.colors.astype(np.float64)
    else:
        base = np.tile(_SKIN, (len(mesh.vertices), 1))
    return _painted(shown, mesh.vertices, base, is_sole(mesh), opacity)


def painted_insole(
    shown: PressureMap | FootprintPicture, vertices: FloatArray, is_top: BoolArray, opacity: float
) -> Coloring:
    """Return the colours of an insole with a map over its upper side.

    Parameters
    ----------
    vertices : (n, 3) float64, mm, insole frame
    is_top : (n,) bool
        Which of them belong to the upper side.
    """
    base = np.tile(_MATERIAL, (len(vertices), 1))
    return _painted(shown, vertices, base, is_top, opacity)


def _painted(
    shown: PressureMap | FootprintPicture,
    vertices: FloatArray,
    base: FloatArray,
    where: BoolArray,
    opacity: float,
) -> Coloring:
    values = np.full(len(vertices), np.nan)
    colors = base.copy()
    points = vertices[where, :2]
    if isinstance(shown, PressureMap):
        limits, title, unit = (0.0, _span_kpa(shown)), tr("Pressure"), "kPa"
        values[where] = shown.at(points)
        faded = np.interp(np.nan_to_num(values), _FADE_KPA, (0.0, opacity))
        on = faded > 0
        colors[on] = map_colors(values[on], limits)
    else:
        limits, title, unit = (0.0, 1.0), "", ""
        seen, covered = shown.at(points)
        on = where.copy()
        on[where] = covered
        colors[on] = seen[covered]
        faded = np.where(on, opacity, 0.0)
    share = faded[:, None]
    colors = share * colors + (1 - share) * base
    return Coloring(values, limits, title, unit=unit, painted=colors.round().astype(np.uint8))


@dataclass(frozen=True, eq=False)
class LoadedVertices:
    """Where vertices lie on the grid of a sole: found once, while a drag changes what is there.

    Parameters
    ----------
    sole
    xy : (2, n) float64, mm, insole frame
        Of all vertices of the surface; a row each is compared in a third of the time.
    can_press : (p,) int64
        Those vertices at which something can press.
    nearest : (p,) int64
        Node of the grid next to each of these vertices.
    nodes, shares : (p, 4) int64, float64
        Nodes about each of these vertices, and their shares in what it shows.
    colors : (4 * p,) int16
        For each `Shown`, which of `_load_colors` these vertices have.
    """

    sole: Sole
    xy: FloatArray
    can_press: IntArray
    nearest: IntArray
    nodes: IntArray
    shares: FloatArray
    colors: npt.NDArray[np.int16]

    @classmethod
    def of(cls, sole: Sole, vertices: FloatArray, where: BoolArray) -> LoadedVertices:
        """Return those of a surface, with vertices (n, 3), of which (n,) can be pressed."""
        shares = sole.field.weights_at(vertices[:, :2])
        (can_press,) = np.nonzero(where & np.isfinite(shares.data.reshape(-1, 4)[:, 0]))
        weights = shares.data.reshape(-1, 4)[can_press]
        nodes = shares.indices.reshape(-1, 4)[can_press].astype(np.int64)
        nearest = nodes[np.arange(len(nodes)), weights.argmax(axis=1)]
        xy = vertices[:, :2].T.copy()
        x, y = xy[:, can_press]
        colors = np.tile(_FIRST[:, None], len(can_press)).astype(np.int16)
        colors[Shown.NEWLY] += (y // _STRIPE_MM % 2).astype(np.int16)
        colors[Shown.UNTOLD] += ((x + y) // (_SLANTED * _STRIPE_MM) % 2).astype(np.int16)
        return cls(sole, xy, can_press, nearest, nodes, weights, colors.ravel())

    def are_those_of(self, sole: Sole, vertices: FloatArray) -> bool:
        """Return whether vertices (n, 3) of the same surface still lie there."""
        return self.sole is sole and all(map(np.array_equal, self.xy, vertices[:, :2].T))

    def coloring(self, change: Change, untold: Collection[str]) -> Coloring:
        """Return the colours of the surface by how the pressure changes there.

        Parameters
        ----------
        untold
            Names of the regions of which nothing can be told.
        """
        shown = change.shown(untold).take(self.nearest)
        colors = self.colors.take(shown * len(shown) + np.arange(len(shown)))
        (known,) = np.nonzero(shown == Shown.PERCENT)
        at = self._percent(change, known)
        steps = (np.clip(at, -MOST_SHOWN, MOST_SHOWN) + MOST_SHOWN) * _STEPS_A_PERCENT
        colors[known] = np.rint(steps)
        of_all = np.full(self.xy.shape[1], _FIRST[Shown.IDLE])
        of_all[self.can_press] = colors
        values = np.full(self.xy.shape[1], np.nan)
        values[self.can_press[known]] = at
        return Coloring(
            values,
            (-MOST_SHOWN, MOST_SHOWN),
            tr("Change of pressure"),
            signed=True,
            unit="%",
            is_clipped=True,
            painted=_load_colors().take(of_all, axis=0),
            swatches=tuple(_load_swatches().values()),
        )

    def _percent(self, change: Change, which: IntArray) -> FloatArray:
        """(n,) change at some of the vertices that can be pressed, whose nearest nodes have one."""
        percent = change.percent.ravel()
        about = percent.take(self.nodes.take(which, axis=0))
        at = np.einsum("ij,ij->i", about, self.shares.take(which, axis=0))
        nearest = percent.take(self.nearest.take(which))
        return np.where(np.isnan(at), nearest, at)  # beside what has no figure


@cache
def _load_colors() -> npt.NDArray[np.uint8]:
    """(n, 3) the colours of the map by steps, then those of each other `Shown`, as `_FIRST`."""
    steps = np.linspace(-MOST_SHOWN, MOST_SHOWN, _STEPS)
    of_map = map_colors(steps, (-MOST_SHOWN, MOST_SHOWN), signed=True)
    others = [
        rgb(color)
        for swatch in _load_swatches().values()
        for color in (swatch.color, swatch.stripe or swatch.color)
    ]
    return np.concatenate([of_map.round(), others]).astype(np.uint8)


def _load_swatches() -> dict[Shown, Swatch]:
    """Return the colours of what has none of the map, known by their stripes too."""
    return {
        Shown.NEWLY: Swatch(tr("newly pressed"), "#ffd400", "#7a6000", is_slanted=False),
        Shown.IDLE: Swatch(tr("nothing presses"), MISSING),
        Shown.UNTOLD: Swatch(tr("nothing told"), "#e6e6e6", "#6b6b6b"),
    }


def is_sole(mesh: TriangleMesh) -> BoolArray:
    """(n,) which vertices of a foot belong to its sole."""
    low = mesh.vertices[:, 2] < _HIGHEST_MM
    return np.asarray((mesh.vertex_normals[:, 2] < _FACING) & low)


def _span_kpa(shown: PressureMap) -> float:
    """Return the greatest value of the legend: the peak, rounded up to 50 kPa."""
    return max(float(np.ceil(shown.peak_kpa / _ROUND_KPA) * _ROUND_KPA), _LEAST_SPAN_KPA)
