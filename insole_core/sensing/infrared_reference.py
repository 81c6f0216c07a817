"""The dot pattern of one device, as its infrared camera sees it, finer than its pictures."""

from __future__ import annotations

import json
from dataclasses import asdict, dataclass, field
from functools import cached_property
from pathlib import Path

import cv2
import numpy as np

from insole_core.errors import InputError
from insole_core.files.atomic import replacing_file
from insole_core.geometry.arrays import Float32Array, FloatArray
from insole_core.given_file import read_given
from insole_core.json_object import JsonObject
from insole_core.sensing.correction import DisparityCorrection, parse_correction
from insole_core.stored_arrays import pack_arrays, read_arrays

VERSION = 1
RAW_PER_PX = 8
"""Raw numbers are eighths of a pixel of disparity."""
GREATEST = 1023
"""Brightness of a pixel, of 10 bits."""
MOST_SHIFT_PX = 20.0
USUAL_SHIFT_PX = (4.8, 3.9)
"""Of the pictures that a Kinect sends against its depth: half of its correlation window."""
_RECORD = "reference"
"""Name of the record among the arrays of a pattern's file."""
_ROWS, _COLUMNS = 480, 640
_MOST_BYTES = 64 * 2**20
_MOST_FINE, _MOST_PX = 16, 1024
_SATURATED_SHARE = 0.02
_BLACK = 20
"""Number (of 1023) that one pixel in a hundred exceeds, also where the foot fills little."""
_STEPS = 4
"""A correction changes by far less than a raw unit over a raw unit."""


@dataclass(frozen=True)
class ReferenceRecord:
    """Origin of a reference pattern.

    Parameters
    ----------
    serial
        Of the device.
    made_at
        ISO 8601, UTC.
    figures
        Results of its calibration by name.
    shift_px : (u, v)
        Of the pictures it was learnt from (see `on_depth_pixels`), as of all of its sensor.
    version
        Of the file format.
    """

    serial: str = ""
    made_at: str = ""
    figures: dict[str, float] = field(default_factory=dict)
    shift_px: tuple[float, float] = (0.0, 0.0)
    version: int = VERSION


@dataclass(frozen=True, eq=False)
class InfraredReference:
    """What the infrared camera of a device shows at every disparity.

    A surface of the raw number r (with the device's distortion) shows at pixel (u, v) the pattern
    at ``u + r / 8`` of row v.

    Parameters
    ----------
    pattern : (480, width * fine) float32
        Brightness, about 1 on average.
    first_px
        Place of its first column.
    fine
        Columns per pixel.
    correction
        The device's distortion of the pattern, in raw units.
    record
    """

    pattern: Float32Array
    first_px: int
    fine: int
    correction: DisparityCorrection
    record: ReferenceRecord = field(default_factory=ReferenceRecord)

    @cached_property
    def _slope(self) -> Float32Array:
        """Change of the pattern per pixel."""
        slope = cv2.Sobel(self.pattern, cv2.CV_32F, 1, 0, ksize=1, scale=self.fine / 2)
        return np.asarray(slope, np.float32)

    def shown(
        self, raw: FloatArray, corner: tuple[int, int] = (0, 0)
    ) -> tuple[Float32Array, Float32Array]:
        """Look up what the camera shows.

        Parameters
        ----------
        raw : (height, width) float64, raw units
            Of a part of the picture, with the distortion; NaN where unknown.
        corner : (u, v), px
            Position of ``raw[0, 0]`` in the picture.

        Returns
        -------
        brightness, slope : (height, width) float32
            Of the pattern, and its change per raw unit; 0 where `raw` is unknown or the pattern was
            never seen.
        """
        height, width = raw.shape
        u = np.arange(width) + (corner[0] - self.first_px)
        across = (u + np.nan_to_num(raw, nan=-1e6) / RAW_PER_PX) * self.fine
        down = np.repeat(np.arange(height, dtype=np.float32)[:, None] + corner[1], width, axis=1)
        places = across.astype(np.float32), down
        brightness, slope = (
            cv2.remap(image, *places, cv2.INTER_LINEAR, borderMode=cv2.BORDER_CONSTANT)
            for image in (self.pattern, self._slope)
        )
        return np.asarray(brightness), np.asarray(slope / np.float32(RAW_PER_PX))

    def distorted(self, raw: FloatArray) -> FloatArray:
        """Add the device's distortion to a whole image (480, 640) of ideal raw numbers."""
        return distorted(raw, self.correction)

    @cached_property
    def packed(self) -> bytes:
        """The content of its file, which takes a fifth of a second to pack."""
        arrays = {
            "pattern": self.pattern.astype(np.float16),
            "first_px": np.array(self.first_px),
            "fine": np.array(self.fine),
            _RECORD: np.array(json.dumps(asdict(self.record))),
            **self.correction.arrays(),
        }
        return pack_arrays(arrays)

    def save(self, path: Path) -> None:
        """Write the .npz file of the session format.

        Raises
        ------
        OutputError
            When the place cannot be written; a file that was there before is untouched.
        """
        with replacing_file(path) as beside:
            beside.write_bytes(self.packed)


def on_depth_pixels(picture: FloatArray, shift_px: tuple[float, float]) -> FloatArray:
    """Move an infrared picture that is shifted against the depth image onto the pixels of that.

    Parameters
    ----------
    picture : (height, width) float64
    shift_px : (u, v)
        What the depth image shows at a pixel, the picture shows so much further right and down.

    Returns
    -------
    (height, width) float64
        0 where the picture does not reach.
    """
    if not any(shift_px):
        return picture
    there = np.array([[1.0, 0.0, shift_px[0]], [0.0, 1.0, shift_px[1]]])
    return np.asarray(
        cv2.warpAffine(
            picture, there, picture.shape[::-1], flags=cv2.INTER_CUBIC | cv2.WARP_INVERSE_MAP
        )
    )


def check_picture(mean: FloatArray, saturated_share: float = _SATURATED_SHARE) -> None:
    """Check that the mean of a view's infrared pictures shows dots.

    Parameters
    ----------
    mean : (height, width) float64
    saturated_share
        That may be as bright as pixels can be.

    Raises
    ------
    InputError
        When it is saturated or black; as the end of a sentence on the view.
    """
    if (mean >= GREATEST).mean() > saturated_share:
        raise InputError(
            "the infrared pictures are saturated; lower their brightness, or keep sunlight off the "
            "foot."
        )
    if np.percentile(mean, 99) < _BLACK:
        raise InputError("the infrared pictures are black; see that the emitter is on.")


def distorted(raw: FloatArray, correction: DisparityCorrection) -> FloatArray:
    """Add a distortion to ideal raw numbers (480, 640); inverse of `correction.corrected`."""
    seen = raw
    for _ in range(_STEPS):
        seen = raw + correction.offset_at(seen)
    return seen


def load_reference(path: Path) -> InfraredReference:
    """Read a file that `InfraredReference.save` wrote.

    Raises
    ------
    InputError
        When it is missing, damaged, no reference pattern, or of a newer version.
    """
    return parse_reference(path.name, read_given(path, _MOST_BYTES))


def load_record(path: Path) -> ReferenceRecord:
    """Read where a pattern comes from, without the pattern itself.

    Raises
    ------
    InputError
        When the file is missing, damaged, or no reference pattern.
    """
    content = read_given(path, _MOST_BYTES)
    arrays = read_arrays(path.name, content, _MOST_BYTES, only=(_RECORD,))
    if _RECORD not in arrays:
        raise _unreadable(path.name)
    return _record(path.name, str(arrays[_RECORD]))


def parse_reference(name: str, content: bytes) -> InfraredReference:
    """Read the bytes of a reference pattern.

    Parameters
    ----------
    name
        Of the file, for messages.

    Raises
    ------
    InputError
        When it is damaged, no reference pattern, or of a newer version.
    """
    unreadable = _unreadable(name)
    try:
        arrays = read_arrays(name, content, _MOST_BYTES)
        record = _record(name, str(arrays[_RECORD]))
        correction = parse_correction(name, content)
        pattern, first, fine = (arrays[key] for key in ("pattern", "first_px", "fine"))
    except (InputError, KeyError) as error:
        raise unreadable from error
    if record.version > VERSION:
        raise InputError(
            "{name} is of version {version}, which is newer than this program (it reads up to "
            "{newest}); install a newer Insole Studio.",
            name=name,
            version=record.version,
            newest=VERSION,
        )
    whole = all(number.shape == () and number.dtype.kind in "iu" for number in (first, fine))
    if not (whole and 1 <= fine <= _MOST_FINE and abs(int(first)) <= _MOST_PX):
        raise unreadable
    height, width = pattern.shape if pattern.ndim == 2 else (0, 0)
    if height != _ROWS or width < _COLUMNS * fine or pattern.dtype.kind != "f":
        raise unreadable
    values = pattern.astype(np.float32)
    if not np.isfinite(values).all():
        raise unreadable
    return InfraredReference(values, int(first), int(fine), correction, record)


def check_owner(name: str, reference: InfraredReference, serial: str) -> None:
    """Check that a pattern is of the sensor of a view.

    Parameters
    ----------
    name
        Of the pattern's file.
    reference
    serial
        Of the sensor.

    Raises
    ------
    InputError
    """
    if reference.record.serial != serial:
        raise InputError(
            "{name} is the pattern of sensor {found}, but the view is of sensor {serial}; put in "
            "the pattern of that sensor.",
            name=name,
            found=reference.record.serial,
            serial=serial,
        )


def _unreadable(name: str) -> InputError:
    return InputError(
        "{name} holds no readable infrared reference pattern; make it again by calibrate infrared.",
        name=name,
    )


def _record(name: str, text: str) -> ReferenceRecord:
    root = JsonObject.parse(f"{name}: reference", text.encode(errors="surrogatepass"))
    figures = root.object("figures")
    shift_px = root.pair("shift_px", MOST_SHIFT_PX) if root.has("shift_px") else (0.0, 0.0)
    return ReferenceRecord(
        root.text("serial", empty=True),
        root.text("made_at", empty=True),
        {key: figures.number(key) for key in figures.values},
        shift_px,
        root.integer("version", 1, 1000),
    )
