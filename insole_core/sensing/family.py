"""What is known of all sensors of one kind: the errors of their readings, and what was learnt."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class SensorFamily:
    """Sensors that measure in the same way.

    Raw units are those of the family's `DisparityModel`.

    Parameters
    ----------
    name
        For reports.
    noise_raw
        Standard deviation of a mean, corrected reading on a surface that faces the sensor, raw
        units.
    spot_offset_px
        Distance of what a matching window sees from its centre: on a slanted surface it becomes an
        error of the depth.
    shared_px
        Number of neighbouring readings that share their error.
    learnt
        Whether the error of the matching was learnt for it (`matching_error`).
    reach_mm
        Distances of a foot at which it measures well.
    wall_mm
        Distances of the walls that its distortion is calibrated with.
    """

    name: str
    noise_raw: float
    spot_offset_px: float
    shared_px: int
    learnt: bool = False
    reach_mm: tuple[float, float] = (0.0, 10_000.0)
    wall_mm: tuple[float, float] = (500.0, 1000.0)


KINECT_V1 = SensorFamily("Kinect v1", 0.21, 0.6, 20, learnt=True, reach_mm=(550.0, 1000.0))
"""Dots lie 0.7 to 1 px off the middle of a window, less the part that is predicted; the sensor
compares 9 x 9 pixels. Closer than its reach it measures little, farther away its depth steps exceed
3 mm."""
ACTIVE_STEREO = SensorFamily(
    "active stereo", 0.65, 1.0, 20, reach_mm=(400.0, 700.0), wall_mm=(400.0, 700.0)
)
"""Where a foot faces the camera, two simulations leave 0.07 to 0.09 px however many frames there
are, as speckle and pixel locking stay. On a slanted surface the brighter half of a window, which
faces the camera, outweighs the other one: by more than a pixel. Closer than its reach the search
for matches ends, farther away a foot keeps errors of more than 0.3 mm."""
DIRECT_DEPTH = SensorFamily("depth in mm", 0.5, 0.5, 10, reach_mm=(250.0, 1000.0))
"""Nothing is known but that it delivers millimetres, which are its raw units."""
