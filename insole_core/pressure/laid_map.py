"""A map of pressures, or a picture, that lies under a foot."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np
import numpy.typing as npt

from insole_core.geometry.arrays import FloatArray
from insole_core.pressure.placement import Placement

MOST_KEPT_PIXELS = 300_000
"""Of a picture that is laid."""
LOADED_KPA = 10.0
"""From this pressure on a sensor counts as loaded; plates measure from 5 to 10 kPa on."""


@dataclass(frozen=True, eq=False)
class PressureMap:
    """The pressures of one foot under that foot.

    Parameters
    ----------
    kpa : (rows, columns) float64
        The first row towards the toes as printed; NaN where there is no sensor.
    pitch_mm
        Distance of the sensors, across and along.
    placement
    device
        Make of the plate or insole; may be empty. The name of the file, which may be that of a
        patient, is not kept.
    shown
        What of the recording: "peak", "mean" or "frame 12".
    """

    kpa: FloatArray
    pitch_mm: tuple[float, float]
    placement: Placement = field(default_factory=Placement)
    device: str = ""
    shown: str = "peak"

    @property
    def peak_kpa(self) -> float:
        """Greatest pressure."""
        return float(np.nanmax(self.kpa))

    @property
    def centres_mm(self) -> FloatArray:
        """(rows, columns, 2) centres of the sensors, frame of the map."""
        return centres_mm((self.kpa.shape[0], self.kpa.shape[1]), self.pitch_mm)

    def at(self, points: FloatArray) -> FloatArray:
        """Return the pressures (n,) at points (n, 2) of the insole frame, kPa.

        Between sensors they are interpolated; NaN beside the sensors.
        """
        from scipy.ndimage import map_coordinates

        places = _pixels(self.placement.to_map(points), self.kpa.shape, self.pitch_mm)
        known = np.nan_to_num(self.kpa)
        kpa = map_coordinates(known, places, order=1, mode="constant")
        is_sensor = np.isfinite(self.kpa).astype(np.float64)
        over = map_coordinates(is_sensor, places, order=0, mode="constant")
        return np.where(over > 0, kpa, np.nan)

    def placed(self, placement: Placement) -> PressureMap:
        """Return the map at another place."""
        return replace(self, placement=placement.rounded())


@dataclass(frozen=True, eq=False)
class FootprintPicture:
    """A picture of a footprint, or of a scanner, under its foot.

    Parameters
    ----------
    colors : (rows, columns, 3) uint8
        RGB.
    pitch_mm
        Size of a pixel.
    placement
    """

    colors: npt.NDArray[np.uint8]
    pitch_mm: float
    placement: Placement = field(default_factory=Placement)

    def at(self, points: FloatArray) -> tuple[npt.NDArray[np.uint8], npt.NDArray[np.bool_]]:
        """Return the colours (n, 3) at points (n, 2) of the insole frame, and which (n,) it covers.

        Points beside the picture are white.
        """
        shape = self.colors.shape[:2]
        places = _pixels(self.placement.to_map(points), shape, (self.pitch_mm, self.pitch_mm))
        row, column = np.round(places).astype(int)
        inside = (row >= 0) & (row < shape[0]) & (column >= 0) & (column < shape[1])
        colors = np.full((len(points), 3), 255, dtype=np.uint8)
        colors[inside] = self.colors[row[inside], column[inside]]
        return colors, inside

    def placed(self, placement: Placement) -> FootprintPicture:
        """Return the picture at another place."""
        return replace(self, placement=placement.rounded())


@dataclass(frozen=True, eq=False)
class PlantarLayers:
    """What lies under a foot; it has no effect on the insole.

    Parameters
    ----------
    pressure, picture
        None where there is none.
    """

    pressure: PressureMap | None = None
    picture: FootprintPicture | None = None

    def with_foot(self, step: FloatArray) -> PlantarLayers:
        """Return both under a foot that was laid anew by a transform (4, 4)."""
        pressure, picture = self.pressure, self.picture
        if pressure is not None:
            pressure = pressure.placed(pressure.placement.with_foot(step))
        if picture is not None:
            picture = picture.placed(picture.placement.with_foot(step))
        return PlantarLayers(pressure, picture)


def centres_mm(shape: tuple[int, int], pitch_mm: tuple[float, float]) -> FloatArray:
    """Return the centres (rows, columns, 2) of the cells of a grid about its middle, mm."""
    rows, columns = shape
    x = (np.arange(columns) - (columns - 1) / 2) * pitch_mm[0]
    y = ((rows - 1) / 2 - np.arange(rows)) * pitch_mm[1]
    return np.stack(np.meshgrid(x, y), axis=-1)


def _pixels(
    points: FloatArray, shape: tuple[int, ...], pitch_mm: tuple[float, float]
) -> FloatArray:
    """Return rows and columns (2, n) of points (n, 2) of the frame of a map."""
    column = points[:, 0] / pitch_mm[0] + (shape[1] - 1) / 2
    row = (shape[0] - 1) / 2 - points[:, 1] / pitch_mm[1]
    return np.stack([row, column])
