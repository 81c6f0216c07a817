"""Cross-validation of distortion corrections: each wall is corrected by a fit to all others."""

from __future__ import annotations

from collections.abc import Sequence

from insole_core.calibration.walls.captures import WallCapture
from insole_core.calibration.walls.distortion import calibrate_distortion
from insole_core.calibration.walls.thesis_maps import cubic_map, mean_map
from insole_core.calibration.walls.wall_plane import fit_wall, plane_rows
from insole_core.errors import CalibrationError
from insole_core.evaluation.wall import Correction, NoCorrection, WallError, wall_error
from insole_core.progress import SILENT, Progress
from insole_core.sensing.disparity import DisparityModel
from insole_core.sensing.pinhole_camera import PinholeCamera

_LEAST_WALLS = 5
"""Algorithm 2 fits a cubic, which takes four other walls."""


def leave_one_out(
    captures: Sequence[WallCapture],
    camera: PinholeCamera,
    disparity: DisparityModel,
    progress: Progress = SILENT,
) -> dict[str, list[WallError]]:
    """Correct every capture by a fit to all the others, and measure the remaining error.

    Parameters
    ----------
    captures
        Of one device.
    camera
        The depth camera.
    disparity
        Converts raw numbers to depth.

    Returns
    -------
    dict
        The errors in the order of `captures`, by correction: raw, the two algorithms of the
        thesis (given the fitted plane, because walls need not be perpendicular), the default.

    Raises
    ------
    CalibrationError
        If there are fewer than five captures.
    """
    if len(captures) < _LEAST_WALLS:
        raise CalibrationError(
            "Leaving one wall out needs captures at {least} distances or more, but there are "
            "{count}; capture more.",
            least=_LEAST_WALLS,
            count=len(captures),
        )
    rows = plane_rows(camera)
    walls = [fit_wall(capture, rows, disparity) for capture in captures]
    errors: dict[str, list[WallError]] = {}
    for i, capture in enumerate(captures):
        progress.step(i / len(captures), "Calibrating without {capture}", capture=capture.name)
        others = [*walls[:i], *walls[i + 1 :]]
        default = calibrate_distortion([wall.capture for wall in others], camera, disparity)
        corrections: dict[str, Correction] = {
            "raw": NoCorrection(),
            "algorithm 1": mean_map(others),
            "algorithm 2": cubic_map(others, disparity),
            "default": default.correction,
        }
        for name, correction in corrections.items():
            error = wall_error(capture, correction, camera, disparity)
            errors.setdefault(name, []).append(error)
    return errors
