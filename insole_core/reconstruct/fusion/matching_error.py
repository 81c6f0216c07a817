"""The error of the sensor's matching window, predicted from the neighbourhood of a reading.

A window reports some mean of the surface in it, so the pulps of small toes are measured too deep
and rims too near. No formula describes the error (decision 0015), but it is similar from foot to
foot. A small network has learnt it from simulated feet, whose true shape is known (`training/`).
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from itertools import pairwise
from pathlib import Path

import cv2
import numpy as np

from insole_core.geometry.arrays import Float32Array, FloatArray, IntArray
from insole_core.reconstruct.fusion.depth_view import DepthView
from insole_core.reconstruct.fusion.neighbourhood import (
    FEATURES,
    Familiarity,
    find_shading,
    level,
    mirrored,
    neighbourhoods,
    smoothness,
    support,
)
from insole_core.resources import resource_path

_WEIGHTS = "matching_error/weights.npz"
_LARGEST_RAW = 2.5
_EVERY_PX = 2
"""The error changes slowly from pixel to pixel, because neighbouring windows share their dots."""
_LEAST_SUPPORT = 0.1
_TABLE_SIZE = 15
_LEARNT_MM = (1.0, 1.7)
"""Widths of a pixel in the training data: distances of about 580 to 1000 mm."""


@dataclass(frozen=True, eq=False)
class Network:
    """A multilayer perceptron with rectified linear units.

    Parameters
    ----------
    weights : each (inputs, outputs) float32
    biases : each (outputs,) float32
    """

    weights: tuple[Float32Array, ...]
    biases: tuple[Float32Array, ...]

    def predict(self, features: Float32Array) -> Float32Array:
        """Predict the errors (n,), raw units, from features (n, FEATURES)."""
        signal = features
        for weights, biases in zip(self.weights[:-1], self.biases[:-1], strict=True):
            signal = np.maximum(signal @ weights + biases, 0)
        return np.asarray((signal @ self.weights[-1] + self.biases[-1])[:, 0])

    def predict_alike(self, features: Float32Array) -> Float32Array:
        """Predict errors like `predict`, but equal for a foot and its mirror image."""
        both = self.predict(features) + self.predict(mirrored(features))
        return np.asarray(both / 2, np.float32)


@dataclass(frozen=True, eq=False)
class MatchingModel:
    """What has been learnt of the matching's error, and in which surroundings."""

    network: Network
    familiarity: Familiarity

    @staticmethod
    def load() -> MatchingModel:
        """Read what was learnt from the resources."""
        with np.load(resource_path(_WEIGHTS)) as stored:
            read = {name: stored[name].astype(np.float32) for name in stored.files}
        layers = range(sum(name.startswith("weights") for name in read))
        network = Network(
            tuple(read[f"weights_{i}"] for i in layers), tuple(read[f"biases_{i}"] for i in layers)
        )
        known = (read["middle"], read["axes"], read["variances"], float(read["rest"]))
        return MatchingModel(network, Familiarity(*known))

    def save(self, path: Path) -> None:
        """Write what was learnt."""
        arrays = {f"weights_{i}": one for i, one in enumerate(self.network.weights)}
        arrays |= {f"biases_{i}": one for i, one in enumerate(self.network.biases)}
        halved = {name: array.astype(np.float16) for name, array in arrays.items()}
        known = {name: np.asarray(value) for name, value in vars(self.familiarity).items()}
        known["axes"] = known["axes"].astype(np.float16)
        np.savez_compressed(path, allow_pickle=False, **halved, **known)


def without_matching_error(reading: DepthView) -> DepthView:
    """Subtract the predicted error of the sensor's matching from a reading."""
    pixel_mm = reading.sensor.disparity.depth_mm(reading.raw) / reading.sensor.depth_camera.fx
    turns = _quarter_turns(reading)
    error = matching_error(
        np.rot90(reading.raw, turns),
        np.rot90(find_shading(reading), turns),
        np.rot90(pixel_mm, turns),
        _model(),
    )
    return reading.with_raw(reading.raw - np.rot90(error, -turns))


def matching_error(
    raw: FloatArray, shading: Float32Array, pixel_mm: FloatArray, model: MatchingModel
) -> FloatArray:
    """Predict by how much readings exceed the true values.

    Parameters
    ----------
    raw : (height, width) float64, raw units
        Turned so that the toes, or the sole, lie towards the last row; NaN = no reading.
    shading : (height, width) float32
        See `find_shading`.
    pixel_mm : (height, width) float64
        Width of a pixel at the surface.
    model

    Returns
    -------
    (height, width) float64, raw units
        Between -2.5 and 2.5; 0 without a reading and outside the distances of the training data,
        and the less, the less its surroundings are like those of the training data, and the sharper
        a step beside it is.
    """
    every = (slice(None, None, _EVERY_PX),) * 2
    nodes = np.nonzero(support(raw)[every] > _LEAST_SUPPORT)
    if not len(nodes[0]):
        return np.zeros_like(raw)
    rows, columns = (index * _EVERY_PX for index in nodes)
    middle_mm = np.nan_to_num(pixel_mm[rows, columns], nan=float(np.nanmedian(pixel_mm)))
    middle_mm = np.clip(middle_mm, *_LEARNT_MM)
    features = neighbourhoods(raw, shading, middle_mm, rows, columns)
    predicted = model.network.predict_alike(features) - _of_walls(middle_mm, model.network)
    counts = model.familiarity.share(features) * smoothness(raw)[rows, columns]
    error = np.clip(predicted, -_LARGEST_RAW, _LARGEST_RAW) * counts
    learnt = np.isfinite(raw) & (pixel_mm >= _LEARNT_MM[0]) & (pixel_mm <= _LEARNT_MM[1])
    return np.where(learnt, _between(raw.shape, rows, columns, error), 0)


def _of_walls(pixel_mm: FloatArray, network: Network) -> FloatArray:
    """Predict the errors (n,) of walls that face the sensor, to be subtracted.

    They should be 0, because a common offset of a view cannot be seen in its image.
    """
    table_mm = np.linspace(*_LEARNT_MM, _TABLE_SIZE)
    return np.interp(pixel_mm, table_mm, network.predict_alike(level(table_mm)))


def _between(
    shape: tuple[int, ...], rows: IntArray, columns: IntArray, values: FloatArray
) -> FloatArray:
    """Interpolate an image linearly between the nodes of a coarser lattice."""
    total, weight = np.zeros(shape), np.zeros(shape)
    total[rows, columns], weight[rows, columns] = values, 1
    profile = 1 - np.abs(np.arange(1 - _EVERY_PX, _EVERY_PX)) / _EVERY_PX
    total, weight = (
        cv2.sepFilter2D(image, -1, profile, profile, borderType=cv2.BORDER_CONSTANT)
        for image in (total, weight)
    )
    return np.asarray(total / np.maximum(weight, 1e-9))


def _quarter_turns(reading: DepthView) -> int:
    """Count the counter-clockwise quarter turns that bring the toes to the image's last row.

    The direction is that in which the skin runs from the calf over the heel to the toes.
    """
    down = reading.sensor2reference[:3, :3].T @ np.array([0.0, 1.0, -1.0])
    return round(float(np.arctan2(down[0], down[1])) / (-np.pi / 2)) % 4


@cache
def _model() -> MatchingModel:
    model = MatchingModel.load()
    sizes = [weights.shape for weights in model.network.weights]
    fitting = all(one[1] == other[0] for one, other in pairwise(sizes))
    if sizes[0][0] != FEATURES or not fitting:
        raise ValueError(f"the resource {_WEIGHTS} does not fit this program; install it anew")
    return model
