"""A map of pressures, or a picture, that lies under a foot, and where it lies there."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np
import numpy.typing as npt

from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.transforms import transform

MOST_KEPT_PIXELS = 300_000
"""Of a picture that is laid."""
LOADED_KPA = 10.0
"""From this pressure on a sensor counts as loaded; plates measure from 5 to 10 kPa on."""


@dataclass(frozen=True)
class Placement:
    """Where the frame of a map lies in the insole frame, seen from above.

    The frame of a map has its origin in the middle, +x to the right and +y to the first row.

    Parameters
    ----------
    x_mm, y_mm
        Of the map's middle.
    turn_deg
        Counter-clockwise.
    mirrored
        Whether the map shows the foot from below: left and right are exchanged first.
    """

    x_mm: float = 0.0
    y_mm: float = 0.0
    turn_deg: float = 0.0
    mirrored: bool = False

    @property
    def middle_mm(self) -> FloatArray:
        """(2,) middle of the map, insole frame."""
        return np.array([self.x_mm, self.y_mm])

    def to_insole(self, points: FloatArray) -> FloatArray:
        """Transform points (n, 2) of the map, mm, to the insole frame."""
        return np.asarray(points * self._mirror @ self._turn.T + self.middle_mm)

    def to_map(self, points: FloatArray) -> FloatArray:
        """Transform points (n, 2) of the insole frame, mm, to the map."""
        return np.asarray((points - self.middle_mm) @ self._turn * self._mirror)

    def moved(self, x_mm: float, y_mm: float) -> Placement:
        """Return the placement moved by a way."""
        return replace(self, x_mm=self.x_mm + x_mm, y_mm=self.y_mm + y_mm)

    def turned(self, turn_deg: float, about: FloatArray) -> Placement:
        """Return the placement turned about a point (2,) of the insole frame."""
        turn = _rotation(turn_deg)
        x, y = (float(value) for value in turn @ (self.middle_mm - about) + about)
        return Placement(x, y, _wrapped(self.turn_deg + turn_deg), self.mirrored)

    def with_foot(self, step: FloatArray) -> Placement:
        """Return the placement on a foot that was laid anew.

        Parameters
        ----------
        step : (4, 4) float64
            From the insole frame before to the one after.
        """
        corners = np.array([[self.x_mm, self.y_mm, 0.0], [self.x_mm, self.y_mm, 0.0]])
        corners[1, :2] += self._turn @ [0.0, 100.0]
        (x, y, _), (ahead_x, ahead_y, _) = transform(step, corners)
        turn_deg = float(np.degrees(np.arctan2(x - ahead_x, ahead_y - y)))
        return replace(self, x_mm=float(x), y_mm=float(y), turn_deg=turn_deg)

    def rounded(self) -> Placement:
        """Return the placement in steps of 0.01 mm and 0.01°."""
        return replace(
            self,
            x_mm=round(self.x_mm, 2),
            y_mm=round(self.y_mm, 2),
            turn_deg=round(_wrapped(self.turn_deg), 2),
        )

    @property
    def _mirror(self) -> FloatArray:
        return np.array([-1.0 if self.mirrored else 1.0, 1.0])

    @property
    def _turn(self) -> FloatArray:
        return _rotation(self.turn_deg)


def _rotation(turn_deg: float) -> FloatArray:
    cos, sin = np.cos(np.radians(turn_deg)), np.sin(np.radians(turn_deg))
    return np.array([[cos, -sin], [sin, cos]])


def _wrapped(turn_deg: float) -> float:
    return (turn_deg + 180.0) % 360.0 - 180.0


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
