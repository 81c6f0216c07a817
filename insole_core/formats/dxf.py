"""Outlines for cutting machines and drawing programs: DXF, in mm, a layer for each kind."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Final, Literal, TypeAlias, get_args

import cv2
import numpy as np

from insole_core.files.atomic import replacing_file
from insole_core.geometry.arrays import FloatArray

Layer: TypeAlias = Literal["INSOLE", "COVER", "BLOCK", "SHOE", "MARK"]
_COLOURS: Final[dict[Layer, int]] = {"INSOLE": 7, "COVER": 1, "BLOCK": 8, "SHOE": 5, "MARK": 3}
"""Numbers of AutoCAD: black or white, red, grey, blue, green."""
_STRAIGHT_MM: Final = 0.02
"""From an outline to what is drawn of it."""
_VERSION: Final = "R2010"
_IN_MM: Final = 4
"""Code of ``$INSUNITS``."""


@dataclass(frozen=True, eq=False)
class DxfOutline:
    """A closed line of a layer: (n, 2) float64, mm; the first point is not repeated."""

    layer: Layer
    points_mm: FloatArray


@dataclass(frozen=True)
class DxfText:
    """A line of text, centred on a place; it runs along x, turned counter-clockwise."""

    text: str
    place_mm: tuple[float, float]
    height_mm: float = 5.0
    turn_deg: float = 0.0


def write_dxf(outlines: Sequence[DxfOutline], texts: Sequence[DxfText], path: Path) -> None:
    """Write outlines, and texts on the layer MARK.

    Raises
    ------
    OutputError
        When the place cannot be written; a file that was there before is untouched.
    """
    # They take long, and few orders need them.
    from ezdxf.enums import TextEntityAlignment
    from ezdxf.filemanagement import new

    drawing = new(_VERSION, units=_IN_MM)
    drawing.header["$MEASUREMENT"] = 1
    for layer in get_args(Layer):
        drawing.layers.add(layer, color=_COLOURS[layer])
    space = drawing.modelspace()
    for outline in outlines:
        space.add_lwpolyline(
            _drawn(outline.points_mm).tolist(), close=True, dxfattribs={"layer": outline.layer}
        )
    for text in texts:
        attributes = {"layer": "MARK", "rotation": text.turn_deg}
        space.add_text(text.text, height=text.height_mm, dxfattribs=attributes).set_placement(
            text.place_mm, align=TextEntityAlignment.MIDDLE_CENTER
        )
    with replacing_file(path) as beside, beside.open("w", encoding="utf-8", newline="\n") as file:
        drawing.write(file)


def _drawn(points_mm: FloatArray) -> FloatArray:
    """Return an outline without the points that hardly change it."""
    points = np.asarray(points_mm, np.float32)[:, None]
    return np.asarray(cv2.approxPolyDP(points, _STRAIGHT_MM, True)[:, 0], float)
