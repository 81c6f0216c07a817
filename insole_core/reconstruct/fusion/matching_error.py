"""The error that the sensor's window leaves in a reading, foretold from what surrounds it.

A window reports some mean of what lies in it, so the pulps of small toes come out too deep and
rims too near. How much cannot be told from a formula (decision 0015), but is much alike from foot
to foot. A small network has learnt it from simulated feet, whose truth is known (`training/`).
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from itertools import pairwise

import cv2
import numpy as np

from insole_core.geometry.arrays import Float32Array, FloatArray, IntArray
from insole_core.reconstruct.fusion.depth_view import DepthView
from insole_core.reconstruct.fusion.neighbourhood import (
    FEATURES,
    level,
    mirrored,
    neighbourhoods,
    support,
)
from insole_core.reconstruct.fusion.shading import find_shading
from insole_core.resources import resource_path

_WEIGHTS = "matching_error/weights.npz"
_LARGEST_RAW = 2.5
_EVERY_PX = 2
"""The error changes slowly from pixel to pixel, because neighbouring windows share their dots."""
_LEAST_SUPPORT = 0.1
_TABLE_SIZE = 15
_LEARNT_MM = (1.0, 1.7)
"""Widths of a pixel that occurred: about 580 to 1000 mm. Beyond, nothing is known of the error."""


@dataclass(frozen=True, eq=False)
class Network:
    """Layers of sums and half-waves.

    Parameters
    ----------
    weights : each (inputs, outputs) float32
    biases : each (outputs,) float32
    """

    weights: tuple[Float32Array, ...]
    biases: tuple[Float32Array, ...]

    @staticmethod
    def load() -> Network:
        """Read what was learnt."""
        with np.load(resource_path(_WEIGHTS)) as stored:
            layers = range(len(stored.files) // 2)
            return Network(
                tuple(stored[f"weights_{i}"].astype(np.float32) for i in layers),
                tuple(stored[f"biases_{i}"].astype(np.float32) for i in layers),
            )

    def predict(self, features: Float32Array) -> Float32Array:
        """Error (n,), raw units, from features (n, FEATURES)."""
        signal = features
        for weights, biases in zip(self.weights[:-1], self.biases[:-1], strict=True):
            signal = np.maximum(signal @ weights + biases, 0)
        return np.asarray((signal @ self.weights[-1] + self.biases[-1])[:, 0])

    def predict_alike(self, features: Float32Array) -> Float32Array:
        """Like `predict`, and the same for a foot and its mirror image."""
        both = self.predict(features) + self.predict(mirrored(features))
        return np.asarray(both / 2, np.float32)


def without_matching_error(reading: DepthView) -> DepthView:
    """Take the error of the matching out of a reading, as far as it can be foretold."""
    pixel_mm = reading.sensor.disparity.depth_mm(reading.raw) / reading.sensor.depth_camera.fx
    turns = _quarter_turns(reading)
    error = matching_error(
        np.rot90(reading.raw, turns),
        np.rot90(find_shading(reading), turns),
        np.rot90(pixel_mm, turns),
        _network(),
    )
    return reading.with_raw(reading.raw - np.rot90(error, -turns))


def matching_error(
    raw: FloatArray, shading: Float32Array, pixel_mm: FloatArray, network: Network
) -> FloatArray:
    """By how much readings exceed the truth.

    Parameters
    ----------
    raw : (height, width) float64, raw units
        Toes, or the sole, towards the last row; NaN = no reading.
    shading : (height, width) float32
        See `find_shading`.
    pixel_mm : (height, width) float64
        Width of a pixel at the surface.
    network

    Returns
    -------
    (height, width) float64, raw units, at most 2.5; 0 where nothing can be said
    """
    every = (slice(None, None, _EVERY_PX),) * 2
    nodes = np.nonzero(support(raw)[every] > _LEAST_SUPPORT)
    if not len(nodes[0]):
        return np.zeros_like(raw)
    rows, columns = (index * _EVERY_PX for index in nodes)
    middle_mm = np.nan_to_num(pixel_mm[rows, columns], nan=float(np.nanmedian(pixel_mm)))
    middle_mm = np.clip(middle_mm, *_LEARNT_MM)
    foretold = network.predict_alike(neighbourhoods(raw, shading, middle_mm, rows, columns))
    error = np.clip(foretold - _of_walls(middle_mm, network), -_LARGEST_RAW, _LARGEST_RAW)
    learnt = np.isfinite(raw) & (pixel_mm >= _LEARNT_MM[0]) & (pixel_mm <= _LEARNT_MM[1])
    return np.where(learnt, _between(raw.shape, rows, columns, error), 0)


def _of_walls(pixel_mm: FloatArray, network: Network) -> FloatArray:
    """What is foretold (n,) of walls that face the sensor.

    Nothing should be: how far all of a view is off, no picture tells.
    """
    table_mm = np.linspace(*_LEARNT_MM, _TABLE_SIZE)
    return np.interp(pixel_mm, table_mm, network.predict_alike(level(table_mm)))


def _between(
    shape: tuple[int, ...], rows: IntArray, columns: IntArray, values: FloatArray
) -> FloatArray:
    """Fill an image between the nodes of a coarser lattice, linearly."""
    total, weight = np.zeros(shape), np.zeros(shape)
    total[rows, columns], weight[rows, columns] = values, 1
    profile = 1 - np.abs(np.arange(1 - _EVERY_PX, _EVERY_PX)) / _EVERY_PX
    total, weight = (
        cv2.sepFilter2D(image, -1, profile, profile, borderType=cv2.BORDER_CONSTANT)
        for image in (total, weight)
    )
    return np.asarray(total / np.maximum(weight, 1e-9))


def _quarter_turns(reading: DepthView) -> int:
    """Turns of the picture, counter-clockwise, that bring the toes to its last row.

    The direction is that in which the skin runs from the calf over the heel to the toes.
    """
    down = reading.sensor2reference[:3, :3].T @ np.array([0.0, 1.0, -1.0])
    return round(float(np.arctan2(down[0], down[1])) / (-np.pi / 2)) % 4


@cache
def _network() -> Network:
    network = Network.load()
    sizes = [weights.shape for weights in network.weights]
    fitting = all(one[1] == other[0] for one, other in pairwise(sizes))
    if sizes[0][0] != FEATURES or not fitting:
        raise ValueError(f"the resource {_WEIGHTS} does not fit this program; install it anew")
    return network
