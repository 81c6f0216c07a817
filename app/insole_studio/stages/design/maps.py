"""The colour maps of the insole: what each of them shows, computed from the surface of now."""

from __future__ import annotations

from collections.abc import Callable
from enum import StrEnum

import numpy as np

from insole_core.geometry.arrays import FloatArray
from insole_studio.scene.coloring import Coloring
from insole_studio.texts import tr
from insole_studio.workbench.insole_surface import InsoleSurface

LEAST_SPAN_MM = 1.0


class MapKind(StrEnum):
    """What the insole's colours tell."""

    NONE = "none"
    HEIGHT = "height"
    THICKNESS = "thickness"
    FIT = "fit"


def color_by(kind: MapKind, surface: InsoleSurface) -> Coloring | None:
    """Give the colours of the shown insole; None where there is nothing to tell."""
    if surface.mesh is None or surface.contact is None or surface.base is None:
        return None
    maker = _MAKERS.get(kind)
    return None if maker is None else maker(surface)


def _height(surface: InsoleSurface) -> Coloring:
    assert surface.mesh is not None
    z = surface.mesh.vertices[:, 2]
    return Coloring(z, (0.0, max(float(z.max()), LEAST_SPAN_MM)), tr("Height"))


def _thickness(surface: InsoleSurface) -> Coloring:
    assert surface.mesh is not None
    bottom = surface.bottom_heights_mm
    assert bottom is not None
    thickness = surface.mesh.vertices[: len(bottom), 2] - bottom
    limits = (0.0, max(float(thickness.max()), LEAST_SPAN_MM))
    everywhere = surface.values_everywhere(thickness, thickness)
    return Coloring(everywhere, limits, tr("Thickness"))


def _fit(surface: InsoleSurface) -> Coloring:
    """How far the insole stands over the sole of the foot as it was scanned, before pads."""
    assert surface.mesh is not None
    assert surface.base is not None
    bottom = surface.bottom_heights_mm
    assert bottom is not None
    top = surface.mesh.vertices[: len(bottom)]
    over = np.nan_to_num(top[:, 2] - surface.base.surface.height_at(top[:, :2]))
    everywhere = surface.values_everywhere(over, np.zeros(len(bottom)))
    return Coloring(everywhere, _symmetric(over), tr("Insole over foot"), signed=True)


def _symmetric(values: FloatArray) -> tuple[float, float]:
    span = max(float(np.abs(values).max()), LEAST_SPAN_MM)
    return -span, span


_MAKERS: dict[MapKind, Callable[[InsoleSurface], Coloring]] = {
    MapKind.HEIGHT: _height,
    MapKind.THICKNESS: _thickness,
    MapKind.FIT: _fit,
}
