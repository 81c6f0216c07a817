"""The newest pictures of every sensor in shared memory: one process writes, another reads.

Each picture has three slots that are written in turn, so the reader always finds a complete one
and neither side ever waits for the other.
"""

from __future__ import annotations

import ctypes
from dataclasses import dataclass
from multiprocessing.context import BaseContext
from multiprocessing.heap import BufferWrapper
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from insole_core.geometry.arrays import ByteArray, RawArray
from insole_studio.acquisition.capture_plan import MOST_SENSORS

Kind = Literal["depth", "color", "infrared"]

_KINDS: tuple[Kind, ...] = ("depth", "color", "infrared")
_BYTES_PER_PX: dict[Kind, int] = {"depth": 2, "color": 3, "infrared": 1}
_PLACES = 3
_LARGEST_BYTES = 512 * 640 * 3
_COUNT, _HEIGHT, _WIDTH = range(3)


@dataclass(frozen=True, eq=False)
class Picture:
    """A picture from the buffer.

    Parameters
    ----------
    image
        (height, width) uint16 raw numbers, (height, width, 3) uint8, RGB, or (height, width) uint8,
        infrared.
    number
        Increases with every picture.
    """

    image: NDArray[Any]
    number: int


class SharedFrameBuffer:
    """Shared memory for pictures; pass it to the other process when that is started.

    Parameters
    ----------
    context
        The `multiprocessing` context.
    """

    def __init__(self, context: BaseContext) -> None:
        fields = MOST_SENSORS * len(_KINDS) * 3
        self._head = context.RawArray(ctypes.c_int64, fields)
        # No array of `context`: that would be filled with zeros, 70 MB of which most is never used.
        self._body = BufferWrapper(MOST_SENSORS * len(_KINDS) * _PLACES * _LARGEST_BYTES)

    def write(self, sensor: int, image: RawArray | ByteArray) -> None:
        """Write a picture of sensor number `sensor`; shape and dtype determine its kind.

        Parameters
        ----------
        image
            Depth (480, 640) uint16 raw, colour (height, width, 3) uint8, RGB, or infrared
            (height, width) uint8.
        """
        kind = _kind(image)
        head = self._heads()[sensor, _KINDS.index(kind)]
        count = int(head[_COUNT]) + 1
        place = self._place(sensor, kind, count)
        place[: image.nbytes] = np.ascontiguousarray(image).reshape(-1).view(np.uint8)
        head[_HEIGHT], head[_WIDTH] = image.shape[:2]
        head[_COUNT] = count  # last: only now does the reader look there

    def read(self, sensor: int, kind: Kind, after: int = 0) -> Picture | None:
        """Return a copy of the newest picture if its number is larger than `after`, else None.

        Parameters
        ----------
        after
            Number of the last picture that was seen.
        """
        head = self._heads()[sensor, _KINDS.index(kind)]
        while True:
            count = int(head[_COUNT])
            if count <= after:
                return None
            height, width = int(head[_HEIGHT]), int(head[_WIDTH])
            size = height * width * _BYTES_PER_PX[kind]
            copied = self._place(sensor, kind, count)[:size].copy()
            if int(head[_COUNT]) < count + _PLACES - 1:  # otherwise it was overwritten meanwhile
                return Picture(_shaped(copied, kind, height, width), count)

    def _heads(self) -> NDArray[np.int64]:
        return np.ctypeslib.as_array(self._head).reshape(MOST_SENSORS, len(_KINDS), 3)

    def _place(self, sensor: int, kind: Kind, count: int) -> NDArray[np.uint8]:
        places = np.frombuffer(self._body.create_memoryview(), np.uint8)
        places = places.reshape(MOST_SENSORS, len(_KINDS), _PLACES, _LARGEST_BYTES)
        return places[sensor, _KINDS.index(kind), count % _PLACES]


def _kind(image: RawArray | ByteArray) -> Kind:
    if image.ndim == 3:
        return "color"
    return "depth" if image.dtype == np.uint16 else "infrared"


def _shaped(data: NDArray[np.uint8], kind: Kind, height: int, width: int) -> NDArray[Any]:
    if kind == "color":
        return data.reshape(height, width, 3)
    if kind == "infrared":
        return data.reshape(height, width)
    return data.view(np.uint16).reshape(height, width)
