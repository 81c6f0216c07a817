"""L*a*b* colours are those of OpenCV, but for the rounding of a few."""

from __future__ import annotations

import cv2
import numpy as np
import pytest

from insole_core.reconstruct.fusion.silhouette import rgb2lab


def test_colors_are_those_of_opencv() -> None:
    levels = np.arange(0, 256, 3, dtype=np.uint8)  # with 0 and 255, and the dark end of the curve
    every = np.stack(np.meshgrid(levels, levels, levels), axis=-1).reshape(-1, len(levels), 3)
    difference = np.abs(rgb2lab(every).astype(int) - cv2.cvtColor(every, cv2.COLOR_RGB2LAB))
    assert difference.max() <= 1
    assert (difference > 0).mean() < 0.001


@pytest.mark.parametrize(
    ("rgb", "lab"), [((0, 0, 0), (0, 128, 128)), ((255, 255, 255), (255, 128, 128))]
)
def test_black_and_white_have_no_hue(rgb: tuple[int, ...], lab: tuple[int, ...]) -> None:
    assert tuple(rgb2lab(np.array(rgb, np.uint8))) == lab
