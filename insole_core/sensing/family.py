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
    """

    name: str
    noise_raw: float
    spot_offset_px: float
    shared_px: int
    learnt: bool = False


KINECT_V1 = SensorFamily("Kinect v1", 0.21, 0.6, 20, learnt=True)
"""Dots lie 0.7 to 1 px off the middle of a window, less the part that is predicted; the sensor
compares 9 x 9 pixels."""
ACTIVE_STEREO = SensorFamily("active stereo", 0.4, 1.0, 20)
"""On a slanted surface the brighter half of a window, which faces the camera, outweighs the other
one: by more than a pixel."""
DIRECT_DEPTH = SensorFamily("depth in mm", 0.5, 0.5, 10)
"""Nothing is known but that it delivers millimetres, which are its raw units."""
