"""Points marked by hand in the images, as JSON."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from insole_core.evaluation.alignment import Correspondence
from insole_core.evaluation.color_points import points_at_color, points_at_depth
from insole_core.geometry.arrays import FloatArray
from insole_core.json_object import JsonObject
from insole_core.sensing.sensor import Sensor

_MOST_PX, _MOST_MM = 1e4, 1e5
"""Far beyond any picture and any room; larger numbers are mistakes, and overflow."""


@dataclass(frozen=True, eq=False)
class ObjectPoints:
    """The points of a known object.

    Parameters
    ----------
    true_mm : (n, 3) float64, mm, the object's own axes
    pixels : (n, 2) float64, px, optional
        None for coloured spots, which are detected automatically.
    in_color
        Whether they are marked in the colour image rather than in the depth image.
    """

    names: list[str]
    true_mm: FloatArray
    pixels: FloatArray | None
    in_color: bool

    def measured_mm(self, sensor: Sensor, depth_mm: FloatArray) -> FloatArray:
        """Measure the marked points.

        Parameters
        ----------
        depth_mm : (480, 640) float64, mm, NaN = no reading

        Returns
        -------
        (n, 3) float64, mm, frame of the camera in whose image they are marked; NaN where unseen

        Raises
        ------
        InputError
            If the depth image is almost empty, or a point is outside the image.
        """
        assert self.pixels is not None
        measure = points_at_color if self.in_color else points_at_depth
        return measure(sensor, depth_mm, self.pixels)


def load_object_points(path: Path) -> ObjectPoints:
    """Read ``{"points": [{"name", "true_mm": [x, y, z], "depth_px" or "color_px": [u, v]}]}``.

    Without pixels the points are coloured spots.

    Raises
    ------
    InputError
        Naming the key of the first violation.
    """
    items = _points(path)
    key = "color_px" if items[0].has("color_px") else "depth_px"
    marked = any(item.has("color_px") or item.has("depth_px") for item in items)
    return ObjectPoints(
        [item.text("name") for item in items],
        np.array([item.triple("true_mm", _MOST_MM) for item in items]),
        np.array([item.pair(key, _MOST_PX) for item in items]) if marked else None,
        key == "color_px",
    )


def load_correspondences(path: Path) -> list[Correspondence]:
    """Read ``{"points": [{"depth_px": [u, v], "depth_mm": z, "color_px": [u, v]}]}``.

    Raises
    ------
    InputError
        Naming the key of the first violation.
    """
    return [
        Correspondence(
            item.pair("depth_px", _MOST_PX),
            item.number("depth_mm", 1, _MOST_MM),
            item.pair("color_px", _MOST_PX),
        )
        for item in _points(path)
    ]


def _points(path: Path) -> list[JsonObject]:
    root = JsonObject.read(path)
    items = root.objects("points")
    if not items:
        raise root.fail("points", "is empty; mark the points in the image")
    return items
