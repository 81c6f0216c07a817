"""``python -m training FOLDER [--feet N]``: simulate feet into a folder, and learn from them."""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from functools import partial
from pathlib import Path

import cv2
import numpy as np

from insole_core.geometry.arrays import Float32Array
from insole_core.reconstruct.fusion.matching_error import MatchingModel, matching_error
from insole_core.reconstruct.fusion.neighbourhood import (
    FEATURES,
    Familiarity,
    mirrored,
    neighbourhoods,
)
from training.network import drawn, fit
from training.views import Example, simulate_examples

_WEIGHTS = Path(__file__).parents[1] / "resources/matching_error/weights.npz"
_HIDDEN = (128, 32)
_EPOCHS = 8
_PIXELS_A_VIEW = 5000
_TOES, _TOE_SHARE = 5.0, 0.3
"""How many times likelier a pixel of the toes is drawn than another."""
_LEAST_COSINE = 0.15
_OUTLIER_RAW = 8.0
_BLOCK = 20_000
_HELD_BACK = 0.08
"""Fraction of the feet that is held out from training."""


def main() -> None:
    """Train the weights that the product ships."""
    parser = argparse.ArgumentParser(prog="python -m training", description=__doc__)
    parser.add_argument("folder", type=Path, help="keeps the simulated views")
    parser.add_argument("--feet", type=int, default=190)
    parser.add_argument("--stacks", type=int, default=50, help="of boxes, besides the feet")
    arguments = parser.parse_args()
    arguments.folder.mkdir(parents=True, exist_ok=True)
    with ProcessPoolExecutor() as pool:
        simulated = partial(_simulated, arguments.folder, arguments.stacks)
        things = pool.map(simulated, range(arguments.stacks + arguments.feet))
        paths = [path for thing in things for path in thing]
    held_back = round(3 * arguments.feet * _HELD_BACK)
    model = _learn(paths[:-held_back])
    _report(model, paths[-held_back:])
    _WEIGHTS.parent.mkdir(exist_ok=True)
    model.save(_WEIGHTS)


def _simulated(folder: Path, stacks: int, number: int) -> list[Path]:
    """Return the example files of a stack or a foot; simulate those that are missing."""
    cv2.setNumThreads(1)
    is_stack = number < stacks
    kind, seed = ("stack", number) if is_stack else ("foot", number - stacks)
    paths = [folder / f"{kind}{seed:04d}_{name}.npz" for name in ("left", "right", "top")]
    if not all(path.exists() for path in paths):
        seen = simulate_examples(seed, is_stack=is_stack)
        for path, example in zip(paths, seen.values(), strict=True):
            example.save(path)
    return paths


def _learn(paths: list[Path]) -> MatchingModel:
    rng = np.random.default_rng(15)
    shown = [_samples(Example.load(path), "top" not in path.stem, rng) for path in paths]
    features, errors = (np.concatenate(parts) for parts in zip(*shown, strict=True))
    print(
        f"{len(errors)} pixels of {len(paths)} views, rms error {_rms(errors):.3f} raw", flush=True
    )
    network = fit(
        drawn((FEATURES, *_HIDDEN, 1), rng),
        features,
        errors,
        epochs=_EPOCHS,
        rng=rng,
        report=lambda epoch, loss: print(f"epoch {epoch}: rms {np.sqrt(loss):.3f}", flush=True),
    )
    return MatchingModel(network, Familiarity.of(_both_ways(features)))


def _both_ways(features: np.ndarray) -> Iterator[Float32Array]:
    """Return the features in blocks, each also as on the mirrored foot."""
    for start in range(0, len(features), _BLOCK):
        block = features[start : start + _BLOCK].astype(np.float32)
        yield block
        yield mirrored(block)


def _samples(
    example: Example, is_sole: bool, rng: np.random.Generator
) -> tuple[np.ndarray, Float32Array]:
    """Draw pixels of a view; return their surroundings (n, FEATURES) and their errors (n,)."""
    error = example.raw - example.true_raw
    usable = (np.abs(error) < _OUTLIER_RAW) & (example.cosine > _LEAST_COSINE)
    rows, columns = np.nonzero(usable)
    toes = is_sole & (rows > rows.max() - _TOE_SHARE * np.ptp(rows))
    # What faces the sensor counts most, as most of the surface there is made from it.
    chance = np.where(toes, _TOES, 1.0) * example.cosine[rows, columns]
    count = min(_PIXELS_A_VIEW, len(rows))
    chosen = rng.choice(len(rows), count, replace=False, p=chance / chance.sum())
    rows, columns = rows[chosen], columns[chosen]
    features = neighbourhoods(
        example.raw, example.shading, example.pixel_mm[rows, columns], rows, columns
    )
    return features.astype(np.float16), error[rows, columns].astype(np.float32)


def _report(model: MatchingModel, paths: list[Path]) -> None:
    """Print the remaining errors on feet that were held out from training."""
    before, after = [], []
    for example in map(Example.load, paths):
        error = example.raw - example.true_raw
        seen = (np.abs(error) < _OUTLIER_RAW) & (example.cosine > _LEAST_COSINE)
        left = error - matching_error(example.raw, example.shading, example.pixel_mm, model)
        before.append(error[seen])
        after.append(left[seen])
    words = "feet that nothing was learnt from: rms error"
    print(f"{words} {_rms(np.concatenate(before)):.3f} -> {_rms(np.concatenate(after)):.3f} raw")


def _rms(values: np.ndarray) -> float:
    return float(np.sqrt(np.mean(np.square(values))))


if __name__ == "__main__":
    main()
