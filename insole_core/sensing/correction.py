"""The distortion correction of one sensor, as stored beside sensor.json."""

from __future__ import annotations

import json
from dataclasses import asdict, dataclass, field, replace
from datetime import UTC, datetime
from pathlib import Path
from typing import Any, Literal, get_args

import numpy as np
import numpy.typing as npt

from insole_core.errors import InputError
from insole_core.files.atomic import replacing_file
from insole_core.geometry.arrays import BoolArray, ByteArray, Float32Array, FloatArray
from insole_core.given_file import read_given
from insole_core.json_object import JsonObject
from insole_core.sensing.disparity import DisparityModel
from insole_core.sensing.metric_depth import RAW_PER_PX, binned_map, spread_map
from insole_core.stored_arrays import pack_arrays, read_arrays

VERSION = 2
CorrectionUnit = Literal["raw", "px"]
_ARRAYS = ("slope", "deviation")
_WHOLE_RANGE = (0.0, 2047.0)
_MOST_NUMBER = 1e6  # raw numbers have 11 bits
_MOST_RAW, _MOST_DECAY = 1e4, 0.03
"""Real sensors decay by 0.002; with more, the exponential overflows."""
MAX_BYTES = 32 * 2**20
"""The maps of a correction have 4 MB, those of a stereo camera 12 MB."""


@dataclass(frozen=True)
class CorrectedImage:
    """The depth image that a correction is for.

    Parameters
    ----------
    width, height
        px.
    unit
        Of the stored offset: raw numbers of a Kinect, or pixels of a stereo camera's disparity.
    """

    width: int = 640
    height: int = 480
    unit: CorrectionUnit = "raw"

    @property
    def raw_per_stored(self) -> float:
        """Raw units for one unit of the stored offset; disparity falls as raw units grow."""
        return 1.0 if self.unit == "raw" else -float(RAW_PER_PX)


OF_A_KINECT = CorrectedImage()


@dataclass(frozen=True)
class CorrectionRecord:
    """Origin of a correction.

    Parameters
    ----------
    serial
        Of the device it was measured on.
    made_at
        ISO 8601, UTC.
    method
        Name of the algorithm.
    figures
        Results of its calibration by name.
    version
        Of the file format.
    unit
        Of the array ``offset`` in the file: raw numbers, or pixels of disparity.
    """

    serial: str = ""
    made_at: str = ""
    method: str = ""
    figures: dict[str, float] = field(default_factory=dict)
    version: int = VERSION
    unit: CorrectionUnit = "raw"

    def is_of(self, serial: str) -> bool:
        """Whether it was measured on a device, as far as it says on which."""
        return not self.serial or self.serial == serial

    def age_days(self, now: datetime) -> float:
        """Return the age at `now` (aware); infinite for a correction without a date."""
        if not self.made_at:
            return float("inf")
        made = datetime.fromisoformat(self.made_at)
        return (now - (made if made.tzinfo else made.replace(tzinfo=UTC))).total_seconds() / 86400


@dataclass(frozen=True, eq=False)
class DisparityCorrection:
    """Raw units subtracted from every reading: a map, and its dependence on the raw number.

    The correction of a raw number r is ``offset + slope * lever``, where ``lever`` is
    `decay_lever` of ``clip(r, raw_range) - reference_raw``: thesis (16) with Herrera's dependence
    on the disparity. Where ``slope = -decay * offset`` it is his ``offset * exp(-decay * …)``.

    Parameters
    ----------
    offset : (height, width) float32, raw units
        The correction at `reference_raw`; all that other programs need to know.
    slope : (height, width) float32, raw units per raw unit, optional
        At `reference_raw`.
    decay
        Rate at which the correction decays with the raw number, 1 / raw unit; 0 = linear (files of
        version 1).
    raw_range
        The correction is not extrapolated beyond these raw numbers.
    coverage : (height, width) uint8, optional
        Number of captures that determined each pixel; 0 = filled in from its neighbours.
    deviation : (height, width) float32, raw units, optional
        Standard deviation of the residuals after the correction, averaged over 8 x 8 pixels.
    """

    offset: Float32Array
    slope: Float32Array | None = None
    reference_raw: float = 0.0
    decay: float = 0.0
    raw_range: tuple[float, float] = _WHOLE_RANGE
    coverage: ByteArray | None = None
    deviation: Float32Array | None = None
    record: CorrectionRecord = field(default_factory=CorrectionRecord)

    def offset_at(self, raw: FloatArray) -> FloatArray:
        """Return the correction (height, width), raw units, at a raw image."""
        if self.slope is None:
            return self.offset.astype(float)
        beyond_raw = np.clip(raw, *self.raw_range) - self.reference_raw
        return self.offset + self.slope * decay_lever(beyond_raw, self.decay)

    def corrected(self, raw: FloatArray) -> FloatArray:
        """Subtract the correction from a raw image (height, width), NaN = no reading."""
        return np.asarray(raw - self.offset_at(raw))

    def depth_mm(self, raw: FloatArray, disparity: DisparityModel) -> FloatArray:
        """Correct a raw image and convert it to depth.

        Parameters
        ----------
        raw : (height, width) float64, raw units, NaN = no reading

        Returns
        -------
        (height, width) float64, mm along the optical axis, NaN = no reading
        """
        return disparity.depth_mm(self.corrected(raw))

    @property
    def covered(self) -> BoolArray:
        """(height, width) whether any capture determined a pixel."""
        if self.coverage is None:
            return np.ones(self.offset.shape, dtype=bool)
        return self.coverage > 0

    def binned(self, size: int) -> DisparityCorrection:
        """Return the correction of an image of which each pixel is the mean of a square."""
        if size == 1:
            return self
        covered = None if self.coverage is None else binned_map(self.coverage, size)
        return replace(
            self,
            offset=binned_map(self.offset, size),
            slope=None if self.slope is None else binned_map(self.slope, size),
            deviation=None if self.deviation is None else binned_map(self.deviation, size),
            coverage=None if covered is None else np.ceil(covered).astype(np.uint8),
        )

    def spread(self, size: int, height: int, width: int) -> DisparityCorrection:
        """Return the correction of an image of squares of pixels, for the pixels themselves.

        Parameters
        ----------
        size
            Of a square, px.
        height, width
            Of the image, whose last rows and columns need not fill a square.
        """
        if size == 1:
            return self

        def maps(values: Float32Array | ByteArray | None) -> Any:
            return None if values is None else spread_map(values, size, height, width)

        return replace(
            self,
            offset=maps(self.offset),
            slope=maps(self.slope),
            deviation=maps(self.deviation),
            coverage=maps(self.coverage),
        )

    def save(self, path: Path) -> None:
        """Write the .npz file of the session format.

        Raises
        ------
        OutputError
            When the place cannot be written; a file that was there before is untouched.
        """
        with replacing_file(path) as beside:
            beside.write_bytes(pack_arrays(self.arrays()))

    def arrays(self) -> dict[str, npt.NDArray[Any]]:
        """Return the arrays of its file, by name."""
        height, width = self.offset.shape
        image = CorrectedImage(width, height, self.record.unit)
        record = asdict(self.record)
        if self.record.unit == "raw":
            del record["unit"]  # as of files written before there was another
        arrays: dict[str, npt.NDArray[Any]] = {
            "offset": (self.offset / image.raw_per_stored).astype(np.float32),
            "reference_raw": np.array(self.reference_raw, float),
            "decay": np.array(self.decay, float),
            "raw_range": np.array(self.raw_range),
            "record": np.array(json.dumps(record)),
        }
        optional = {"slope": self.slope, "deviation": self.deviation, "coverage": self.coverage}
        return arrays | {name: array for name, array in optional.items() if array is not None}


def decay_lever(beyond: FloatArray, decay: float) -> FloatArray:
    """Return the factor of the slope: (1 - exp(-decay * beyond)) / decay.

    Parameters
    ----------
    beyond : (...) float64, raw units
        Distance from the reference.
    decay : 1 / raw unit
        0 for a linear correction; the factor is then `beyond` itself.

    Returns
    -------
    (...) float64, raw units
    """
    return np.asarray(-np.expm1(-decay * beyond) / decay) if decay else beyond


def load_correction(path: Path, image: CorrectedImage = OF_A_KINECT) -> DisparityCorrection:
    """Read a correction file.

    Parameters
    ----------
    path
    image
        That it must be for.

    Raises
    ------
    InputError
        When it is missing, damaged, or of a newer version.
    """
    return parse_correction(path.name, read_given(path, MAX_BYTES), image)


def parse_correction(
    name: str, content: bytes, image: CorrectedImage = OF_A_KINECT
) -> DisparityCorrection:
    """Read the bytes of a correction file; only the array ``offset`` is required.

    Parameters
    ----------
    name
        Of the file, for messages.
    image
        That it must be for.

    Returns
    -------
    DisparityCorrection
        Of a file that another program wrote (without ``record``), the offset alone.

    Raises
    ------
    InputError
        When it is damaged, holds arrays of another shape, was measured on another kind of sensor,
        or is of a newer version.
    """
    try:
        arrays = read_arrays(name, content, MAX_BYTES)
    except InputError as error:
        raise InputError(
            '{name} holds no readable array "offset"; calibrate the sensor again.', name=name
        ) from error
    if "offset" not in arrays:
        raise InputError(
            '{name} holds no readable array "offset"; calibrate the sensor again.', name=name
        )
    record = _record_among(name, arrays)
    if record is not None and record.unit != image.unit:
        raise _of_another_kind(name)
    _check_map(name, "offset", arrays["offset"], image)
    offset = (arrays["offset"] * image.raw_per_stored).astype(np.float32)
    if record is None:
        # Written by another program: the meaning of its other arrays is unknown.
        return DisparityCorrection(offset, record=CorrectionRecord(unit=image.unit))
    if record.version > VERSION:
        raise InputError(
            "{name} is of version {version}, which is newer than this program (it reads up to "
            "{newest}); install a newer Insole Studio.",
            name=name,
            version=record.version,
            newest=VERSION,
        )
    for key in (*_ARRAYS, "coverage"):
        if key in arrays:
            _check_map(name, key, arrays[key], image)
    _check_numbers(name, "raw_range", arrays.get("raw_range", _WHOLE_RANGE), (2,), _MOST_RAW)
    for key, most in (("reference_raw", _MOST_RAW), ("decay", _MOST_DECAY)):
        _check_numbers(name, key, arrays.get(key, 0.0), (), most)
    return _assemble(arrays | {"offset": offset}, record)


def _of_another_kind(name: str) -> InputError:
    return InputError(
        "{name} corrects another kind of sensor than this one; calibrate this sensor, or put in "
        "its own correction.",
        name=name,
    )


def _record_among(name: str, arrays: dict[str, npt.NDArray[Any]]) -> CorrectionRecord | None:
    """Return what a file says of its origin; None for one of another program."""
    if "record" not in arrays:
        return None
    try:
        return _record(name, str(arrays["record"]))
    except InputError as error:
        raise InputError(
            '{name} holds no readable array "record"; calibrate the sensor again.', name=name
        ) from error


def _record(name: str, text: str) -> CorrectionRecord:
    root = JsonObject.parse(f"{name}: record", text.encode(errors="surrogatepass"))
    version = root.integer("version", 1, 1000) if root.has("version") else VERSION
    if root.has("made_at") and root.text("made_at", empty=True):
        root.date("made_at")
    texts = ("serial", "made_at", "method")
    figures = root.object("figures") if root.has("figures") else None
    return CorrectionRecord(
        **{key: root.text(key, empty=True) for key in texts if root.has(key)},
        figures={} if figures is None else {key: figures.number(key) for key in figures.values},
        version=version,
        unit=root.choice("unit", get_args(CorrectionUnit)) if root.has("unit") else "raw",
    )


def _check_map(name: str, key: str, array: npt.NDArray[Any], image: CorrectedImage) -> None:
    shape = (image.height, image.width)
    if array.shape == (OF_A_KINECT.height, OF_A_KINECT.width) != shape:
        raise _of_another_kind(name)
    if array.shape != shape or not _are_numbers(array):
        raise InputError(
            '{name}: the array "{key}" must hold {height}×{width} finite numbers; calibrate the '
            "sensor again.",
            name=name,
            key=key,
            height=image.height,
            width=image.width,
        )


def _check_numbers(
    name: str, key: str, values: npt.ArrayLike, shape: tuple[int, ...], most: float = _MOST_NUMBER
) -> None:
    if np.shape(values) != shape or not _are_numbers(np.asarray(values), most):
        what = "two raw numbers" if shape else "one number"
        raise InputError(
            '{name}: "{key}" must hold {what}; calibrate the sensor again.',
            name=name,
            key=key,
            what=what,
        )


def _are_numbers(array: npt.NDArray[Any], most: float = _MOST_NUMBER) -> bool:
    return array.dtype.kind in "iuf" and bool((np.abs(array) <= most).all())


def _assemble(arrays: dict[str, Any], record: CorrectionRecord) -> DisparityCorrection:
    maps = {key: arrays[key].astype(np.float32) for key in _ARRAYS if key in arrays}
    if "coverage" in arrays:
        maps["coverage"] = arrays["coverage"].astype(np.uint8)
    low, high = arrays.get("raw_range", _WHOLE_RANGE)
    return DisparityCorrection(
        arrays["offset"].astype(np.float32),
        reference_raw=float(arrays.get("reference_raw", 0.0)),
        decay=float(arrays.get("decay", 0.0)),
        raw_range=(float(low), float(high)),
        record=record,
        **maps,
    )
