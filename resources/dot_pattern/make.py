"""Find the dots of the sensor's pattern: ``python resources/dot_pattern/make.py PICTURE``.

The picture is that of connecting_the_dots (autonomousvision; MIT, see LICENSE beside this file):
1280 x 1024, two of its pixels to a pixel of the depth image.
"""

from __future__ import annotations

import argparse
from pathlib import Path

import cv2
import numpy as np
import scipy

from insole_core.geometry.arrays import Float32Array, FloatArray

_PICTURE_PX_PER_PX = 2
_BLUR_PX, _LEAST_BRIGHTNESS = 0.7, 25
_REACH = 1


def main() -> None:
    """Write the dots to their place among the resources."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("picture", type=Path)
    picture = cv2.imread(str(parser.parse_args().picture), cv2.IMREAD_GRAYSCALE)
    if picture is None:
        parser.error("the picture cannot be read")
    dots_px = _centroids(picture.astype(np.float32)) / _PICTURE_PX_PER_PX
    path = Path(__file__).parent / "dots.npz"
    np.savez_compressed(path, allow_pickle=False, dots_px=dots_px.astype(np.float32))
    print(f"{len(dots_px)} dots, {path.stat().st_size / 1024:.0f} kB")


def _centroids(picture: Float32Array) -> FloatArray:
    """Return the bright spots (n, 2) of a picture, in its pixels."""
    smooth = cv2.GaussianBlur(picture, (0, 0), _BLUR_PX)
    peaks = (smooth == scipy.ndimage.maximum_filter(smooth, 3)) & (smooth > _LEAST_BRIGHTNESS)
    peaks[[0, -1]], peaks[:, [0, -1]] = False, False
    rows, columns = np.nonzero(peaks)
    y, x = np.mgrid[-_REACH : _REACH + 1, -_REACH : _REACH + 1]
    around = picture[rows[:, None, None] + y, columns[:, None, None] + x]
    total = around.sum(axis=(1, 2))
    off = [(around * axis).sum(axis=(1, 2)) / total for axis in (x, y)]
    return np.column_stack([columns + off[0], rows + off[1]])


if __name__ == "__main__":
    main()
