"""Intrinsic parameters of a camera from pictures of a board (thesis 5.1, appendices B and C)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import combinations
from pathlib import Path

import cv2
import numpy as np

from insole_core.calibration.boards.board import (
    Board,
    BoardDetection,
    count_corners,
    missing_regions,
    read_grey,
)
from insole_core.calibration.least_squares import Blocks, least_squares, pose, pose_vector
from insole_core.errors import CalibrationError
from insole_core.geometry.arrays import FloatArray, IntArray
from insole_core.geometry.transforms import rigid, transform
from insole_core.messages import Message, joined
from insole_core.progress import SILENT, Progress
from insole_core.sensing.pinhole_camera import PinholeCamera

PARAMETERS = ("fx", "fy", "cx", "cy", "k1", "k2", "p1", "p2", "k3", "skew")
LENS = PARAMETERS[:8]
"""The parameters that are always fitted; k3 and skew are held unless requested."""
_LEAST_PICTURES = 3
_GOOD_PICTURES = 10
_LEAST_TILT_DEG = 10.0
_BOARD_MM = (150.0, 6000.0)


@dataclass(frozen=True)
class IntrinsicsOptions:
    """Free parameters, and the criterion for outlying pictures.

    Parameters
    ----------
    fit_k3
        The sixth order of the lens; the thesis's table 1 has it at 0.
    fit_skew
        Thesis (B.5).
    outlier_factor, outlier_px
        A picture is left out if its error exceeds both this many times the median of all, and
        this many pixels.
    """

    fit_k3: bool = False
    fit_skew: bool = False
    outlier_factor: float = 3.0
    outlier_px: float = 0.5


@dataclass(frozen=True, eq=False)
class PictureFit:
    """The fit of the camera model to one picture.

    Parameters
    ----------
    board2camera : (4, 4) float64, mm
    errors_px : (n, 2) float64
        Detected minus projected.
    """

    detection: BoardDetection
    board2camera: FloatArray
    errors_px: FloatArray

    @property
    def rms_px(self) -> float:
        """Root mean square distance of a corner."""
        return float(np.sqrt((self.errors_px**2).sum(1).mean()))


@dataclass(frozen=True, eq=False)
class CameraCalibration:
    """A calibrated camera, its accuracy, and the pictures it is based on.

    Parameters
    ----------
    deviations
        Standard deviation of every parameter of `PARAMETERS`; 0 where it was not fitted.
    left_out : name to reason
    coverage : (6, 8) int64
        Corners in each cell of the image.
    advice
        Possible improvements, in sentences.
    """

    camera: PinholeCamera
    deviations: dict[str, float]
    rms_px: float
    pictures: tuple[PictureFit, ...]
    left_out: dict[str, str]
    coverage: IntArray
    advice: tuple[str, ...]


def parameters_of(camera: PinholeCamera) -> dict[str, float]:
    """Return the parameters of a camera by their names in `PARAMETERS`."""
    k1, k2, p1, p2, k3 = camera.distortion
    values = (camera.fx, camera.fy, camera.cx, camera.cy, k1, k2, p1, p2, k3, camera.skew)
    return dict(zip(PARAMETERS, values, strict=True))


def with_parameters(camera: PinholeCamera, values: Mapping[str, float]) -> PinholeCamera:
    """Return a camera with some of its parameters replaced.

    Parameters
    ----------
    values
        By their names in `PARAMETERS`.
    """
    fx, fy, cx, cy, *lens, skew = (parameters_of(camera) | dict(values)).values()
    k1, k2, p1, p2, k3 = lens
    return replace(camera, fx=fx, fy=fy, cx=cx, cy=cy, distortion=(k1, k2, p1, p2, k3), skew=skew)


def nominal_normal(detection: BoardDetection) -> FloatArray:
    """Estimate a board's normal (3,), away from a camera with a typical field of view."""
    width, height = detection.size
    focal = 0.82 * width
    nominal = np.array([[focal, 0, width / 2], [0, focal, height / 2], [0, 0, 1]])
    _, turn, _ = cv2.solvePnP(detection.points_mm, detection.pixels, nominal, None)
    normal = cv2.Rodrigues(turn)[0][:, 2]
    return np.asarray(normal * np.sign(normal[2] or 1))


def find_boards(
    paths: Sequence[Path], board: Board, progress: Progress = SILENT
) -> tuple[list[BoardDetection], dict[str, str]]:
    """Detect the board in every picture.

    Returns
    -------
    list of BoardDetection
        Of the pictures that show it.
    dict
        Name of every other picture to the reason.

    Raises
    ------
    InputError
        If a picture cannot be read.
    CalibrationError
        If no picture shows the board, or the pictures differ in size.
    """
    detections: list[BoardDetection] = []
    without: dict[str, str] = {}
    for done, path in enumerate(paths):
        progress.step(done / len(paths), "Looking for the board in {picture}", picture=path.name)
        try:
            detections.append(board.find(path.name, read_grey(path)))
        except CalibrationError as error:
            without[path.name] = str(error)
    if not detections:
        raise CalibrationError(
            "None of the {count} pictures can be used: {reason}",
            count=len(paths),
            reason=next(iter(without.values())),
        )
    _check_sizes(detections)
    return detections, without


def calibrate_camera(
    detections: Sequence[BoardDetection],
    options: IntrinsicsOptions | None = None,
    progress: Progress = SILENT,
) -> CameraCalibration:
    """Fit a camera to all detections of a board, without outlying pictures (Zhang 2000).

    Parameters
    ----------
    detections
        Of the same board in at least three pictures of one size, tilted in different directions.

    Returns
    -------
    CameraCalibration
        Focal lengths and principal point in px, board poses in mm.

    Raises
    ------
    CalibrationError
        If there are fewer than three pictures, all boards are parallel, or a board would be
        impossibly near or far (wrong unit of its square).
    """
    options = options or IntrinsicsOptions()
    _check_sizes(detections)
    _check_count(len(detections))
    _check_poses(detections)
    used, left_out = list(detections), dict[str, str]()
    while True:
        progress.step(
            0.1 + 0.4 * bool(left_out), "Fitting the camera to {count} pictures", count=len(used)
        )
        camera, std, pictures = _fit(used, options)
        outliers = _outliers(pictures, options)
        if not outliers:
            break
        left_out |= {
            p.detection.name: Message(
                "its error of {error_px:.2f} px is far above that of the others", error_px=p.rms_px
            )
            for p in outliers
        }
        used = [detection for detection in used if detection.name not in left_out]
        _check_count(len(used))
    if options.fit_skew:
        progress.step(0.7, "Fitting the skew")
        camera, std, pictures = _fit_skew(camera, pictures, options)
    _check_distance(pictures)
    counts = count_corners(used)
    return CameraCalibration(
        camera=camera,
        deviations=std,
        rms_px=float(np.sqrt(np.concatenate([(p.errors_px**2).sum(1) for p in pictures]).mean())),
        pictures=tuple(pictures),
        left_out=left_out,
        coverage=counts,
        advice=_advice(len(used), counts),
    )


def _fit(
    detections: Sequence[BoardDetection], options: IntrinsicsOptions
) -> tuple[PinholeCamera, dict[str, float], list[PictureFit]]:
    size = detections[0].size
    flags = 0 if options.fit_k3 else cv2.CALIB_FIX_K3
    _, matrix, lens, turns, shifts, spread, _, _ = cv2.calibrateCameraExtended(
        [s.points_mm.astype(np.float32) for s in detections],
        [s.pixels.astype(np.float32) for s in detections],
        size,
        None,
        None,
        flags=flags,
    )
    camera = _camera(size, [matrix[0, 0], matrix[1, 1], matrix[0, 2], matrix[1, 2], *lens.ravel()])
    std = dict.fromkeys(PARAMETERS, 0.0)
    std |= dict(zip(PARAMETERS, spread.ravel()[:9].tolist(), strict=False))
    poses = [
        rigid(cv2.Rodrigues(turn)[0], shift.ravel())
        for turn, shift in zip(turns, shifts, strict=True)
    ]
    return camera, std, _pictures(camera, detections, poses)


def _fit_skew(
    camera: PinholeCamera, pictures: Sequence[PictureFit], options: IntrinsicsOptions
) -> tuple[PinholeCamera, dict[str, float], list[PictureFit]]:
    """Refine all parameters together with a skew, which OpenCV's own fit does not have."""
    names = [name for name in PARAMETERS if name != "k3" or options.fit_k3]
    fixed = parameters_of(camera)
    detections = [picture.detection for picture in pictures]
    size, count = detections[0].size, len(names)

    def split(unknowns: FloatArray) -> tuple[PinholeCamera, list[FloatArray]]:
        values = fixed | dict(zip(names, unknowns[:count].tolist(), strict=True))
        poses = [pose(part) for part in unknowns[count:].reshape(-1, 6)]
        return _camera(size, list(values.values())[:9], values["skew"]), poses

    def residuals(unknowns: FloatArray) -> FloatArray:
        return np.concatenate(
            [
                p.errors_px.ravel()
                for p in _pictures(split(unknowns)[0], detections, split(unknowns)[1])
            ]
        )

    start = [fixed[name] for name in names]
    start += np.concatenate([pose_vector(p.board2camera) for p in pictures]).tolist()
    lengths = tuple(2 * len(detection.pixels) for detection in detections)
    solution = least_squares(residuals, np.array(start), Blocks(lengths, count))
    skewed, poses = split(solution.values)
    std = dict.fromkeys(PARAMETERS, 0.0)
    std |= dict(zip(names, solution.std[:count].tolist(), strict=True))
    return skewed, std, _pictures(skewed, detections, poses)


def _camera(size: tuple[int, int], values: Sequence[float], skew: float = 0.0) -> PinholeCamera:
    fx, fy, cx, cy, k1, k2, p1, p2, k3 = (float(value) for value in values)
    return PinholeCamera(*size, fx, fy, cx, cy, (k1, k2, p1, p2, k3), skew)


def _pictures(
    camera: PinholeCamera, detections: Sequence[BoardDetection], poses: Sequence[FloatArray]
) -> list[PictureFit]:
    return [
        PictureFit(s, board2camera, s.pixels - camera.project(transform(board2camera, s.points_mm)))
        for s, board2camera in zip(detections, poses, strict=True)
    ]


def _outliers(pictures: Sequence[PictureFit], options: IntrinsicsOptions) -> list[PictureFit]:
    median = float(np.median([picture.rms_px for picture in pictures]))
    limit = max(options.outlier_factor * median, options.outlier_px)
    return [picture for picture in pictures if picture.rms_px > limit]


def _check_sizes(detections: Sequence[BoardDetection]) -> None:
    by_size = {detection.size: detection.name for detection in detections}
    if len(by_size) > 1:
        named = ", ".join(f"{name} ({w}×{h})" for (w, h), name in by_size.items())
        raise CalibrationError(
            "The pictures differ in size: {sizes}; use pictures of one camera in one mode.",
            sizes=named,
        )


def _check_count(count: int) -> None:
    if count < _LEAST_PICTURES:
        raise CalibrationError(
            "Only {count} pictures of the board can be used, but at least {least} are needed and "
            "{good} are good; take more, with the board tilted differently.",
            count=count,
            least=_LEAST_PICTURES,
            good=_GOOD_PICTURES,
        )


def _check_poses(detections: Sequence[BoardDetection]) -> None:
    """Refuse boards that are all parallel: they leave the focal length open (Zhang 2000)."""
    normals = [nominal_normal(detection) for detection in detections]
    widest = max(_angle_deg(a, b) for a, b in combinations(normals, 2))
    if widest < _LEAST_TILT_DEG:
        raise CalibrationError(
            "The board was held the same way in all pictures; tilt it by 20 to 40 degrees to all "
            "sides and take more."
        )


def _angle_deg(a: FloatArray, b: FloatArray) -> float:
    return float(np.degrees(np.arctan2(np.linalg.norm(np.cross(a, b)), a @ b)))


def _check_distance(pictures: Sequence[PictureFit]) -> None:
    low, high = _BOARD_MM
    distance = float(np.median([picture.board2camera[2, 3] for picture in pictures]))
    if not low <= distance <= high:
        raise CalibrationError(
            "The board would have stood {distance_mm:.0f} mm from the camera; check the size of "
            "its square, which must be given in millimetres.",
            distance_mm=distance,
        )


def _advice(count: int, counts: IntArray) -> tuple[str, ...]:
    advice = []
    if count < _GOOD_PICTURES:
        advice.append(
            Message(
                "Only {count} pictures were used; {good} or more are better.",
                count=count,
                good=_GOOD_PICTURES,
            )
        )
    if missing := missing_regions(counts):
        advice.append(
            Message("The board was hardly seen in these parts: {parts}.", parts=joined(missing))
        )
    return tuple(advice)


def with_shift(camera: PinholeCamera, shift_px: tuple[float, float]) -> PinholeCamera:
    """Return the same camera for an image shifted by (u, v) pixels, for example IR to depth."""
    return replace(camera, cx=camera.cx + shift_px[0], cy=camera.cy + shift_px[1])
