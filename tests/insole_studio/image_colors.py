"""What is seen in a picture of the window, as numbers."""

from __future__ import annotations

import numpy as np
from PySide6.QtGui import QImage

from insole_core.geometry.arrays import IntArray


def colors_of(image: QImage) -> IntArray:
    """Return the colours of a picture (height, width, 3), 0 to 255; signed, to be compared."""
    image = image.convertToFormat(QImage.Format.Format_RGB888)
    rows = np.frombuffer(image.constBits(), np.uint8).reshape(image.height(), -1)
    colors = rows[:, : 3 * image.width()].reshape(image.height(), -1, 3)
    return colors.astype(np.int64)
