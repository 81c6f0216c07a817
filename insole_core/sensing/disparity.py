"""Conversion between the sensor's raw 11-bit numbers and millimetres.

The three models of the session format. `raw` is float everywhere: averaging and correction happen
before the conversion, in fractions of a raw unit.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import numpy as np

from insole_core.geometry.arrays import FloatArray

NO_READING = 2047
"""The raw number that the sensor sends for a pixel without a reading."""


class DisparityModel(Protocol):
    """Conversion between raw numbers and depth, element by element."""

    def depth_mm(self, raw: FloatArray) -> FloatArray:
        """Depth along the optical axis; NaN where the raw number lies at or beyond infinity."""
        ...

    def raw(self, depth_mm: FloatArray) -> FloatArray:
        """Return the raw numbers of depths; inverse of `depth_mm`."""
        ...


def _positive(
    depth_mm: FloatArray, valid: np.ndarray[tuple[int, ...], np.dtype[np.bool_]]
) -> FloatArray:
    return np.where(valid & (depth_mm > 0), depth_mm, np.nan)


@dataclass(frozen=True)
class FactoryDisparity:
    """Conversion by the parameters that the device itself reports (``kinect-v1-factory``).

    Parameters
    ----------
    reference_distance_mm
        Z0, distance of the reference plane.
    reference_pixel_size_mm
        p, size of a pixel on the reference plane.
    baseline_mm
        b, between emitter and infrared camera.
    constant_shift
        px.
    """

    reference_distance_mm: float
    reference_pixel_size_mm: float
    baseline_mm: float
    constant_shift: float

    def depth_mm(self, raw: FloatArray) -> FloatArray:
        """Z = Z0 b / (b - m), m = (raw/4 - shift - 0.375) p."""
        m = (
            np.asarray(raw, dtype=float) / 4 - self.constant_shift - 0.375
        ) * self.reference_pixel_size_mm
        gap = self.baseline_mm - m
        with np.errstate(divide="ignore", invalid="ignore"):
            return _positive(self.reference_distance_mm * self.baseline_mm / gap, gap > 0)

    def raw(self, depth_mm: FloatArray) -> FloatArray:
        """Return the raw numbers of depths; inverse of `depth_mm`."""
        depth = np.asarray(depth_mm, dtype=float)
        m = self.baseline_mm * (1 - self.reference_distance_mm / depth)
        return np.asarray((m / self.reference_pixel_size_mm + self.constant_shift + 0.375) * 4)


@dataclass(frozen=True)
class LinearInverseDisparity:
    """Burrus's model, thesis (17): Z = 1000 / (a + b raw), mm."""

    a: float
    b: float

    def depth_mm(self, raw: FloatArray) -> FloatArray:
        """Z = 1000 / (a + b raw)."""
        inverse = self.a + self.b * np.asarray(raw, dtype=float)
        with np.errstate(divide="ignore", invalid="ignore"):
            return _positive(1000.0 / inverse, inverse > 0)

    def raw(self, depth_mm: FloatArray) -> FloatArray:
        """Return the raw numbers of depths; inverse of `depth_mm`."""
        return np.asarray((1000.0 / np.asarray(depth_mm, dtype=float) - self.a) / self.b)


@dataclass(frozen=True)
class ScaledDisparity:
    """Another model whose depths are multiplied by a factor."""

    model: DisparityModel
    factor: float

    def depth_mm(self, raw: FloatArray) -> FloatArray:
        """Z = factor · depth of the model."""
        return self.factor * self.model.depth_mm(raw)

    def raw(self, depth_mm: FloatArray) -> FloatArray:
        """Return the raw numbers of depths; inverse of `depth_mm`."""
        return self.model.raw(np.asarray(depth_mm, dtype=float) / self.factor)


@dataclass(frozen=True)
class TangentDisparity:
    """Tangent model, thesis (12): Z = k1 tan(raw / k2 + k3), mm."""

    k1_mm: float
    k2: float
    k3: float

    def depth_mm(self, raw: FloatArray) -> FloatArray:
        """Z = k1 tan(raw / k2 + k3), up to the pole of the tangent."""
        angle = np.asarray(raw, dtype=float) / self.k2 + self.k3
        with np.errstate(invalid="ignore"):
            return _positive(self.k1_mm * np.tan(angle), angle < np.pi / 2)

    def raw(self, depth_mm: FloatArray) -> FloatArray:
        """Return the raw numbers of depths; inverse of `depth_mm`."""
        depth = np.asarray(depth_mm, dtype=float)
        return np.asarray((np.arctan(depth / self.k1_mm) - self.k3) * self.k2)
