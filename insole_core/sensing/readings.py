"""From stored depth frames to the readings that are averaged: numbers of raw units, on a lattice.

A Kinect's frames are its readings. Those of a sensor that delivers millimetres are converted to
disparity, and brought to about as many readings per millimetre.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from insole_core.geometry.arrays import RawArray
from insole_core.sensing.metric_depth import (
    NUMBERS_PER_RAW,
    PlainDepth,
    StereoDisparity,
    bin_size,
    binned,
    binned_camera,
    numbers_of,
    raw_of,
)
from insole_core.sensing.sensor import Sensor


@dataclass(frozen=True, eq=False)
class Readings:
    """How the stored frames of a sensor become readings.

    Parameters
    ----------
    stored
        The sensor as its frames are stored.
    sensor
        The same with the lattice of its readings in the place of its pixels.
    per_raw
        Number of parts of a raw unit that readings are whole numbers of.
    bin_px
        Number of pixels across a reading.
    """

    stored: Sensor
    sensor: Sensor
    per_raw: int = 1
    bin_px: int = 1

    @staticmethod
    def of(sensor: Sensor) -> Readings:
        """Return the readings of a sensor."""
        if sensor.depth_unit_mm is None:
            return Readings(sensor, sensor)
        size = bin_size(sensor.depth_camera)
        correction = None if sensor.correction is None else sensor.correction.binned(size)
        camera = binned_camera(sensor.depth_camera, size)
        smaller = replace(sensor, depth_camera=camera, correction=correction)
        return Readings(sensor, smaller, NUMBERS_PER_RAW, size)

    def numbers(self, frame: RawArray) -> RawArray:
        """Convert a frame as it is stored.

        Parameters
        ----------
        frame : (height, width) uint16

        Returns
        -------
        (height, width) uint16, parts of a raw unit, on the lattice
            2047 raw = no reading.
        """
        unit_mm, disparity = self.stored.depth_unit_mm, self.stored.disparity
        if unit_mm is None or not isinstance(disparity, StereoDisparity | PlainDepth):
            return frame
        return binned(numbers_of(frame, unit_mm, disparity), self.bin_px)

    def glance(self, frame: RawArray) -> RawArray:
        """Convert a frame for the eye: one of its readings in each square, in whole raw units.

        Parameters
        ----------
        frame : (height, width) uint16
            As it is stored.

        Returns
        -------
        (height, width) uint16, raw units, on the lattice
            2047 = no reading.
        """
        unit_mm, disparity = self.stored.depth_unit_mm, self.stored.disparity
        if unit_mm is None or not isinstance(disparity, StereoDisparity | PlainDepth):
            return frame
        rows, columns = (side // self.bin_px * self.bin_px for side in frame.shape)
        chosen = frame[: rows : self.bin_px, : columns : self.bin_px]
        return raw_of(chosen, unit_mm, disparity)
