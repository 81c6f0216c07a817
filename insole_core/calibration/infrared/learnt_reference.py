"""The reference pattern of a device, its distortion, and whether it has drifted since.

The chip's depth of a wall gives a plane, and the plane the disparity of every pixel. With those all
walls together give the pattern; matched against it, block by block, every wall shows the device's
distortion, with which the pattern is fitted again.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass
from datetime import UTC, datetime

import cv2
import numpy as np

from insole_core.calibration.infrared.fine_pattern import FINE, FinePattern
from insole_core.calibration.infrared.infrared_walls import InfraredWall
from insole_core.calibration.walls.captures import WallCapture
from insole_core.calibration.walls.distortion import calibrate_distortion
from insole_core.calibration.walls.wall_plane import (
    NoWallError,
    WallFit,
    fit_wall,
    plane_rows,
)
from insole_core.errors import CalibrationError
from insole_core.geometry.arrays import BoolArray, Float32Array, FloatArray
from insole_core.messages import Message, joined
from insole_core.progress import SILENT, Progress
from insole_core.sensing.correction import DisparityCorrection
from insole_core.sensing.infrared_reference import (
    RAW_PER_PX,
    InfraredReference,
    ReferenceRecord,
    distorted,
    on_depth_pixels,
)
from insole_core.sensing.sensor import Sensor

LEAST_WALLS = 4
_LEAST_RATIO = 1.2
_LEAST_OFTEN, _LEAST_COVERED = 3, 0.6
_PASSES, _ROUNDS = 3, 10
_BLOCK_PX = 16
_MATCHES = 2
_LARGEST_STEP_RAW = 4.0
_LEAST_LIKENESS, _LEAST_SHARE = 0.7, 0.5
_BESIDE_PX = 0.25
"""Where the slope of the pattern across the rows is taken."""
_CLOSED_PX = 31
"""Smaller gaps in the depth of a wall show the wall as well."""
_UNEVEN_RAW, _UNEVEN_SHARE = 6.0, 0.1
_BEYOND = 1.03
"""Walls so little nearer or farther than those of a pattern tell its drift, too."""
_DRIFT_PX = 0.05
"""A pattern that is off by so much costs a fifth of the accuracy."""


@dataclass(frozen=True, eq=False)
class LearntReference:
    """A reference pattern, and how it was learnt.

    Parameters
    ----------
    reference
    used
        Names of the walls that it was learnt from.
    left_out : name to reason
    """

    reference: InfraredReference
    used: tuple[str, ...]
    left_out: dict[str, str]


@dataclass(frozen=True)
class Drift:
    """How one wall differs from a reference pattern.

    A shift along the rows that is the same on the whole wall, or grows evenly across it, moves the
    chip's depth of the wall as well, by which the pattern is placed: a wall cannot show it. Drift
    that has the pattern grow shows across the rows.

    Parameters
    ----------
    shift_px
        Root mean square of its blocks' shifts along the rows.
    down_px
        That of the shifts of its rows of blocks across the rows, which depth does not know.
    likeness
        Median correlation of its blocks with the pattern.
    """

    shift_px: float
    down_px: float
    likeness: float

    @property
    def drift_px(self) -> float:
        """The larger of both shifts."""
        return max(self.shift_px, self.down_px)

    @property
    def doubt(self) -> str:
        """Why the pattern should be learnt anew, a sentence; empty when it still holds."""
        if self.likeness < _LEAST_LIKENESS:
            return Message(
                "The wall shows another pattern (likeness {likeness:.2f}); it is of another "
                "sensor, or no flat wall; else learn the reference again.",
                likeness=self.likeness,
            )
        if self.drift_px > _DRIFT_PX:
            return Message(
                "The pattern has drifted by {shift:.3f} px (at most {most} px); let the sensor "
                "warm up, and learn the reference again.",
                shift=self.drift_px,
                most=_DRIFT_PX,
            )
        return ""


@dataclass(frozen=True, eq=False)
class _Wall:
    """A wall with its plane: the ideal raw numbers, NaN off the wall."""

    name: str
    brightness: Float32Array
    fit: WallFit
    ideal_raw: FloatArray


def learn_reference(
    walls: Sequence[InfraredWall], sensor: Sensor, progress: Progress = SILENT
) -> LearntReference:
    """Learn a device's pattern and distortion from infrared pictures of flat walls.

    Parameters
    ----------
    walls
        At different distances.
    sensor
        Camera, law of the disparity and, where it has one, the correction of the chip's depth.

    Raises
    ------
    CalibrationError
        If there are too few walls, they lie at one distance, cover too little, or show different
        patterns.
    Cancelled
    """
    placed, left_out = _placed(walls, sensor, progress.part(0, 0.1))
    raws = [_seen_raw(wall.ideal_raw, sensor.correction) for wall in placed]
    pattern = FinePattern.holding(raws)
    covered = pattern.coverage(raws, _LEAST_OFTEN)
    if covered < _LEAST_COVERED:
        raise CalibrationError(
            "Only {share:.0%} of the pattern was seen on {least} walls or more, but at least "
            "{needed:.0%} must be; let the walls fill the picture.",
            share=covered,
            least=_LEAST_OFTEN,
            needed=_LEAST_COVERED,
        )
    correction, residual_raw = _no_correction(), float("nan")
    for number in range(_PASSES):
        progress.step(0.1 + 0.9 * number / _PASSES, "Learning the pattern of dots")
        pattern.fit([wall.brightness for wall in placed], raws, _ROUNDS)
        if number == _PASSES - 1:
            break
        known = InfraredReference(pattern.seen, pattern.first_px, FINE, correction)
        matches = [_match(wall, raw, known) for wall, raw in zip(placed, raws, strict=True)]
        captures = [
            _capture(wall, raw, match)
            for wall, raw, match in zip(placed, raws, matches, strict=True)
        ]
        left_out |= {
            wall.name: Message("it shows another pattern than the other walls.")
            for wall, match in zip(placed, matches, strict=True)
            if match.likeness < _LEAST_LIKENESS
        }
        _check_walls(_without(left_out, placed), left_out)
        found = calibrate_distortion(
            [capture for capture in captures if capture.name not in left_out],
            sensor.depth_camera,
            sensor.disparity,
            serial=sensor.serial,
        )
        left_out |= found.left_out
        placed = _without(left_out, placed)
        _check_walls(placed, left_out)
        correction = found.correction
        residual_raw = _rms_raw(captures, placed, correction)
        raws = [_seen_raw(wall.ideal_raw, correction) for wall in placed]
    distances = [float(1 / wall.fit.plane[2]) for wall in placed]
    record = ReferenceRecord(
        sensor.serial,
        datetime.now(UTC).isoformat(timespec="seconds"),
        {
            "walls": float(len(placed)),
            "covered_share": covered,
            "residual_raw": residual_raw,
            "nearest_mm": min(distances),
            "farthest_mm": max(distances),
        },
        walls[0].shift_px,
    )
    reference = InfraredReference(pattern.seen, pattern.first_px, FINE, correction, record)
    return LearntReference(reference, tuple(wall.name for wall in placed), left_out)


def find_drift(wall: InfraredWall, sensor: Sensor, reference: InfraredReference) -> Drift:
    """Compare one wall with a reference pattern.

    Raises
    ------
    CalibrationError
        If the reference is of another device, the capture shows no flat wall, or one nearer or
        farther than those that the pattern was learnt from, where its distortion is a guess.
    """
    if reference.record.serial != sensor.serial:
        raise CalibrationError(
            "The reference pattern is of sensor {found}, but the calibration is of sensor "
            "{serial}; name the reference of that sensor.",
            found=reference.record.serial,
            serial=sensor.serial,
        )
    placed = _place(wall, sensor)
    _check_distance(placed, reference)
    raw = reference.distorted(placed.ideal_raw)
    match = _match(placed, raw, reference)
    return Drift(
        _rms(match.shift_raw) / RAW_PER_PX,
        _rms(_shifts_down_px(placed, raw, match, reference)),
        match.likeness,
    )


def _check_distance(wall: _Wall, reference: InfraredReference) -> None:
    figures = reference.record.figures
    distance_mm = 1 / wall.fit.plane[2]
    nearest_mm = figures.get("nearest_mm", 0.0)
    farthest_mm = figures.get("farthest_mm", np.inf)
    if not nearest_mm / _BEYOND < distance_mm < farthest_mm * _BEYOND:
        raise CalibrationError(
            "{capture} shows a wall {distance_mm:.0f} mm away, but the pattern was learnt from "
            "walls at {nearest_mm:.0f} to {farthest_mm:.0f} mm, and says nothing of others; check "
            "it by a wall between these.",
            capture=wall.name,
            distance_mm=distance_mm,
            nearest_mm=nearest_mm,
            farthest_mm=farthest_mm,
        )


def _rms(values: FloatArray) -> float:
    """Return the root mean square of what is known; infinite without any."""
    known = values[np.isfinite(values)]
    return float(np.sqrt(np.mean(known**2))) if known.size else float("inf")


def _no_correction() -> DisparityCorrection:
    return DisparityCorrection(np.zeros((480, 640), np.float32))


def _seen_raw(ideal_raw: FloatArray, correction: DisparityCorrection | None) -> FloatArray:
    return ideal_raw if correction is None else distorted(ideal_raw, correction)


def _without(left_out: Collection[str], walls: Sequence[_Wall]) -> list[_Wall]:
    return [wall for wall in walls if wall.name not in left_out]


def _placed(
    walls: Sequence[InfraredWall], sensor: Sensor, progress: Progress
) -> tuple[list[_Wall], dict[str, str]]:
    placed: list[_Wall] = []
    left_out: dict[str, str] = {}
    for done, wall in enumerate(walls):
        progress.step(done / len(walls), "Finding the wall in {capture}", capture=wall.depth.name)
        try:
            placed.append(_place(wall, sensor))
        except NoWallError as error:
            left_out[wall.depth.name] = error.reason
    _check_walls(placed, left_out)
    return placed, left_out


def _check_walls(walls: Sequence[_Wall], left_out: dict[str, str]) -> None:
    if len(walls) < LEAST_WALLS:
        reasons = (
            Message("{what}: {reason}", what=name, reason=reason)
            for name, reason in left_out.items()
        )
        raise CalibrationError(
            "Only {count} walls can be used, but the pattern needs {least} or more at different "
            "distances; capture more flat walls. {reasons}",
            count=len(walls),
            least=LEAST_WALLS,
            reasons=joined(reasons, " ") if left_out else "None was left out.",
        )
    distances = [1 / wall.fit.plane[2] for wall in walls]
    if max(distances) < _LEAST_RATIO * min(distances):
        raise CalibrationError(
            "All walls lie between {nearest_mm:.0f} and {farthest_mm:.0f} mm; capture walls from "
            "600 to 900 mm, which show every dot at different pixels.",
            nearest_mm=min(distances),
            farthest_mm=max(distances),
        )


def find_infrared_wall(wall: InfraredWall, sensor: Sensor) -> WallFit:
    """Find the plane of a wall by the chip's depth.

    Raises
    ------
    NoWallError
        If it shows none.
    """
    name = wall.depth.name
    capture = WallCapture(name, sensor.corrected(wall.depth.raw))
    fit = fit_wall(capture, plane_rows(sensor.depth_camera), sensor.disparity)
    off = np.abs(fit.residual_raw[fit.wall])
    if (off > _UNEVEN_RAW).mean() > _UNEVEN_SHARE:
        reason = Message(
            "it shows no plane, as {share:.0%} of it is off by more than {raw:.0f} raw units; "
            "capture a flat, empty wall.",
            share=(off > _UNEVEN_RAW).mean(),
            raw=_UNEVEN_RAW,
        )
        raise NoWallError(name, reason)
    return fit


def _place(wall: InfraredWall, sensor: Sensor) -> _Wall:
    fit = find_infrared_wall(wall, sensor)
    kernel = np.ones((_CLOSED_PX, _CLOSED_PX), np.uint8)
    shown = cv2.morphologyEx(fit.wall.astype(np.uint8), cv2.MORPH_CLOSE, kernel) > 0
    return _Wall(wall.depth.name, wall.brightness, fit, np.where(shown, fit.expected_raw, np.nan))


@dataclass(frozen=True, eq=False)
class _Match:
    """Shift of every block against the pattern, raw units, NaN = not alike."""

    shift_raw: FloatArray
    likeness: float


def _match(wall: _Wall, raw: FloatArray, reference: InfraredReference) -> _Match:
    """Match a wall with the pattern, block by block: gain, offset and one shift (Gauss-Newton)."""
    used: BoolArray = np.isfinite(raw)
    weight, picture = used.astype(float), wall.brightness.astype(float)
    height, width = raw.shape
    shift = np.zeros((height // _BLOCK_PX, width // _BLOCK_PX))
    for _ in range(_MATCHES):
        moved = raw + cv2.resize(shift, (width, height), interpolation=cv2.INTER_CUBIC)
        shown, slope = reference.shown(moved)
        columns = [np.asarray(shown, float), np.ones_like(weight), np.asarray(slope, float)]
        (gain, offset, moving), rhs = _fitted(weight, columns, picture)
        step = moving / np.where(np.abs(gain) > 0.1, gain, np.inf)
        shift += np.clip(step, -_LARGEST_STEP_RAW, _LARGEST_STEP_RAW)
    area = _sums(weight)
    total = _sums(weight * picture**2)
    left = total - np.einsum("kvu,kvu->vu", np.stack([gain, offset, moving]), rhs)
    variance = total - _sums(weight * picture) ** 2 / np.maximum(area, 1)
    likeness = np.sqrt(np.clip(1 - left / np.maximum(variance, 1e-9), 0, 1))
    filled = area > _LEAST_SHARE * _BLOCK_PX**2
    alike = filled & (likeness > _LEAST_LIKENESS) & (gain > 0)
    middle = float(np.median(likeness[filled])) if filled.any() else 0.0
    return _Match(np.where(alike, shift, np.nan), middle)


def _shifts_down_px(
    wall: _Wall, raw: FloatArray, match: _Match, reference: InfraredReference
) -> FloatArray:
    """Return by how much each row of blocks lies below the pattern, NaN = not alike."""
    known = np.isfinite(match.shift_raw)
    shift = np.where(known, match.shift_raw, 0.0)
    weight = np.isfinite(raw).astype(float)
    moved = raw + cv2.resize(shift, raw.shape[::-1], interpolation=cv2.INTER_CUBIC)
    shown, slope = (np.asarray(image, float) for image in reference.shown(moved))
    above, below = (on_depth_pixels(shown, (0.0, side * _BESIDE_PX)) for side in (-1, 1))
    down = (above - below) / (2 * _BESIDE_PX)
    (gain, _, _, moving), _ = _fitted(
        weight, [shown, np.ones_like(weight), slope, down], wall.brightness.astype(float)
    )
    shifts = np.where(known, moving / np.where(gain > 0, gain, np.inf), np.nan)
    rows = known.mean(1) > _LEAST_SHARE
    return np.asarray(np.nanmedian(shifts[rows], axis=1))


def _fitted(
    weight: FloatArray, columns: Sequence[FloatArray], picture: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Explain every block of a picture by the columns (least squares).

    Returns
    -------
    factors, rhs : (columns, rows, columns of blocks) float64
    """
    normal = np.stack(
        [np.stack([_sums(weight * a * b) for b in columns], -1) for a in columns], -2
    ) + 1e-6 * np.eye(len(columns))
    rhs = np.stack([_sums(weight * a * picture) for a in columns], -1)
    factors = np.asarray(np.linalg.solve(normal, rhs[..., None])[..., 0], float)
    return np.moveaxis(factors, -1, 0), np.moveaxis(rhs, -1, 0)


def _sums(image: FloatArray) -> FloatArray:
    height, width = image.shape
    blocks = image.reshape(height // _BLOCK_PX, _BLOCK_PX, width // _BLOCK_PX, _BLOCK_PX)
    return np.asarray(blocks.sum(axis=(1, 3)))


def _capture(wall: _Wall, raw: FloatArray, match: _Match) -> WallCapture:
    shift = np.kron(match.shift_raw, np.ones((_BLOCK_PX, _BLOCK_PX)))
    return WallCapture(wall.name, raw + shift, plane=wall.fit.plane)


def _rms_raw(
    captures: Sequence[WallCapture], walls: Sequence[_Wall], correction: DisparityCorrection
) -> float:
    """Return what the distortion leaves of the shifts of the walls' blocks (rms)."""
    by_name = {capture.name: capture.raw for capture in captures}
    left = [
        correction.corrected(by_name[wall.name])[::_BLOCK_PX, ::_BLOCK_PX]
        - wall.fit.expected_raw[::_BLOCK_PX, ::_BLOCK_PX]
        for wall in walls
    ]
    return float(np.sqrt(np.nanmean(np.square(left))))
