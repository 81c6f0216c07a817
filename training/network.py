"""Fitting of the network: robust least squares (Huber) by Adam (Kingma & Ba 2015)."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from itertools import pairwise

import numpy as np

from insole_core.geometry.arrays import Float32Array
from insole_core.reconstruct.fusion.matching_error import Network
from insole_core.reconstruct.fusion.neighbourhood import mirrored

_BATCH = 1024
_RATE = 2e-3
_DECAY = 1e-3
_OUTLIER_RAW = 2.0
_FORGETTING = (0.9, 0.999)


def drawn(sizes: tuple[int, ...], rng: np.random.Generator) -> Network:
    """Return a network with random initial weights.

    Parameters
    ----------
    sizes
        Number of units of each layer.
    """
    shapes = list(pairwise(sizes))
    weights = [rng.standard_normal(shape) * np.sqrt(2 / shape[0]) for shape in shapes]
    weights[-1] *= 0.1
    return Network(
        tuple(one.astype(np.float32) for one in weights),
        tuple(np.zeros(shape[1], np.float32) for shape in shapes),
    )


def fit(
    network: Network,
    features: np.ndarray,
    errors: Float32Array,
    *,
    epochs: int,
    rng: np.random.Generator,
    report: Callable[[int, float], None],
) -> Network:
    """Train a network in place on examples (n, FEATURES), (n,), mirroring every other batch.

    Parameters
    ----------
    report
        Called with the number of the epoch and its error.
    """
    adam = _Adam([*network.weights, *network.biases])
    batches = len(errors) // _BATCH
    for epoch in range(epochs):
        order, loss = rng.permutation(len(errors)), 0.0
        for number in range(batches):
            part = order[number * _BATCH : (number + 1) * _BATCH]
            shown = features[part].astype(np.float32)
            gradients, square = _gradients(
                network, mirrored(shown) if number % 2 else shown, errors[part]
            )
            progress = (epoch * batches + number) / (epochs * batches)
            adam.step(gradients, _RATE * 0.5 * (1 + np.cos(np.pi * progress)))
            loss += square / batches
        report(epoch, loss)
    return network


def _gradients(
    network: Network, features: Float32Array, errors: Float32Array
) -> tuple[list[Float32Array], float]:
    """Return the gradients of Huber's loss, weights then biases, and the mean square error."""
    signals = [features]
    for weights, biases in zip(network.weights[:-1], network.biases[:-1], strict=True):
        signals.append(np.maximum(signals[-1] @ weights + biases, 0))
    last = signals[-1] @ network.weights[-1] + network.biases[-1]
    off = last[:, 0] - errors
    back = (np.clip(off, -_OUTLIER_RAW, _OUTLIER_RAW) / len(off))[:, None]
    of_weights, of_biases = [], []
    for layer in reversed(range(len(network.weights))):
        decay = np.float32(_DECAY) * network.weights[layer] / np.float32(len(off))
        of_weights.append(signals[layer].T @ back + decay)
        of_biases.append(back.sum(axis=0))
        back = (back @ network.weights[layer].T) * (signals[layer] > 0)
    return of_weights[::-1] + of_biases[::-1], float((off**2).mean())


@dataclass
class _Adam:
    """Steps along gradients, scaled by their past magnitudes; changes the values in place."""

    values: list[Float32Array]
    steps: int = 0
    means: list[Float32Array] = field(init=False)
    squares: list[Float32Array] = field(init=False)

    def __post_init__(self) -> None:
        self.means = [np.zeros_like(value) for value in self.values]
        self.squares = [np.zeros_like(value) for value in self.values]

    def step(self, gradients: list[Float32Array], rate: float) -> None:
        self.steps += 1
        slow, slower = _FORGETTING
        for number, gradient in enumerate(gradients):
            mean, square = self.means[number], self.squares[number]
            mean += (1 - slow) * (gradient - mean)
            square += (1 - slower) * (gradient**2 - square)
            unbiased = mean / (1 - slow**self.steps)
            spread = np.sqrt(square / (1 - slower**self.steps))
            self.values[number] -= (rate * unbiased / (spread + 1e-8)).astype(np.float32)
