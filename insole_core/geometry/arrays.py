"""Aliases for the array types used throughout the core."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

FloatArray = npt.NDArray[np.float64]
Float32Array = npt.NDArray[np.float32]
IntArray = npt.NDArray[np.int64]
IndexArray = npt.NDArray[np.int32]
LabelArray = npt.NDArray[np.int16]
BoolArray = npt.NDArray[np.bool_]
ByteArray = npt.NDArray[np.uint8]
RawArray = npt.NDArray[np.uint16]
