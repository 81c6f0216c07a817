"""Report sections on calibrations (thesis table 1, figures 10 - 12, C.2 - C.5)."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from insole_core.calibration.boards.intrinsics import (
    PARAMETERS,
    CameraCalibration,
    parameters_of,
)
from insole_core.calibration.boards.stereo import StereoCalibration
from insole_core.calibration.markers.marker_survey import MarkerSurvey
from insole_core.calibration.markers.reference_file import BumpCheck, FaceCheck, positions
from insole_core.calibration.walls.disparity_fit import DisparityFit
from insole_core.calibration.walls.distortion import DistortionCalibration
from insole_core.evaluation.report import Number, Plot, ReportSection, Share, Table
from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.transforms import transform
from insole_core.recording.session import ReferenceSystem
from insole_core.sensing.disparity import LinearInverseDisparity
from insole_core.sensing.pinhole_camera import PinholeCamera

_FACE_HEADINGS = (
    "face", "markers", "asymmetry mm", "relief mm", "nearest mm", "seen from x y z", "aside up to",
)  # fmt: skip


def camera_section(calibration: CameraCalibration, title: str = "Colour camera") -> ReportSection:
    """Report the intrinsic calibration of a camera."""
    values = parameters_of(calibration.camera)
    parameters = tuple(
        (name, f"{values[name]:.4f}", f"{calibration.deviations[name]:.4f}") for name in PARAMETERS
    )
    pictures = tuple((p.detection.name, f"{p.rms_px:.3f}") for p in calibration.pictures)
    return ReportSection(
        key="camera",
        title=title,
        numbers=(
            Number("rms_px", "Reprojection error (rms)", calibration.rms_px, "px"),
            Number("pictures", "Pictures used", len(calibration.pictures)),
        ),
        sentences=calibration.advice + _left_out(calibration.left_out),
        tables=(
            Table("Parameters", ("parameter", "value", "standard deviation"), parameters),
            Table("Pictures", ("picture", "error (rms), px"), pictures),
        ),
        plots=(
            Plot("Reprojection errors", lambda figure: _draw_errors(figure, calibration)),
            Plot("Distortion of the lens, px", lambda f: _draw_lens(f, calibration.camera)),
            Plot("Corners in each part of the image", lambda f: _draw_coverage(f, calibration)),
            Plot("Boards before the camera, mm", lambda f: _draw_boards(f, calibration)),
        ),
    )


_UNITS = {"px": "px", "raw": "raw units"}
_POSE_HEADINGS = ("axis", "shift, mm", "standard deviation, mm", "of the turn, °")
_FITTED = {
    "a": "a of the depth, 1/m",
    "b": "b of the depth, 1/m per raw unit",
    "cx": "cx of the depth camera, px",
    "cy": "cy of the depth camera, px",
    "fx": "fx of the depth camera, px",
    "fy": "fy of the depth camera, px",
    "tilt_x": "tilt of the depth to the right, raw units",
    "tilt_y": "tilt of the depth downwards, raw units",
}
"""Display names of the numbers of `board_depth`."""


def stereo_section(
    stereo: StereoCalibration, fitted: Sequence[tuple[str, float, float]] = ()
) -> ReportSection:
    """Report the pose between the two cameras, and the numbers fitted with it.

    Parameters
    ----------
    fitted
        Name, value and standard deviation of each further number.
    """
    rows = tuple(
        (axis, f"{stereo.depth2color[i, 3]:.2f}", f"{stereo.translation_deviation_mm[i]:.2f}",
         f"{stereo.rotation_deviation_deg[i]:.3f}")
        for i, axis in enumerate("xyz")
    )  # fmt: skip
    numbers = tuple(
        (_FITTED.get(name, name), f"{value:.6g}", f"{sd:.2g}") for name, value, sd in fitted
    )
    headings = ("number", "value", "standard deviation")
    beside = (Table("Fitted with it", headings, numbers),) if numbers else ()
    return ReportSection(
        key="stereo",
        title="Depth camera to colour camera",
        numbers=(
            Number("baseline_mm", "Distance of the cameras", stereo.baseline_mm, "mm"),
            Number("rotation_deg", "Angle between the cameras", stereo.rotation_deg, "°"),
            Number("rms", "Residual (rms)", stereo.rms, _UNITS[stereo.unit]),
        ),
        tables=(Table("Pose", _POSE_HEADINGS, rows), *beside),
    )


def disparity_section(fit: DisparityFit) -> ReportSection:
    """Report a fitted disparity model."""
    rows = tuple(
        (name, f"{getattr(fit.model, name):.7g}", f"{sd:.2g}")
        for name, sd in fit.deviations.items()
    )
    low, high = fit.range_mm
    return ReportSection(
        key="disparity",
        title="Raw number to mm",
        numbers=(
            Number("rms_raw", "Residual (rms)", fit.rms_raw, "raw units"),
            Number("rms_mm", "Residual (rms)", fit.rms_mm, "mm"),
        ),
        sentences=(
            f"The {_model_name(fit)} was fitted from {low:.0f} to {high:.0f} mm; beyond it is a "
            "guess.",
        ),
        tables=(Table("Parameters", ("parameter", "value", "standard deviation"), rows),),
    )


def _model_name(fit: DisparityFit) -> str:
    linear = isinstance(fit.model, LinearInverseDisparity)
    return "linear-inverse model" if linear else "tangent model"


_WALL_HEADINGS = (
    "wall", "distance, mm", "tilt, °", "filled", "before (rms), raw units", "after"
)  # fmt: skip


def distortion_section(calibration: DistortionCalibration) -> ReportSection:
    """Report a distortion map."""
    rows = tuple(
        (w.name, f"{w.distance_mm:.0f}", f"{w.tilt_deg:.1f}", f"{w.filled_share:.0%}",
         f"{w.rms_before_raw:.2f}", f"{w.rms_after_raw:.2f}")
        for w in calibration.walls
    )  # fmt: skip
    correction = calibration.correction
    maps = [("Correction, raw units", correction.offset.astype(float))]
    if correction.deviation is not None:
        maps.append(("Standard deviation, raw units", correction.deviation.astype(float)))
    if correction.coverage is not None:
        maps.append(("Walls seen by each pixel", correction.coverage.astype(float)))
    return ReportSection(
        key="distortion",
        title="Distortion of the depth sensor",
        numbers=(
            Number("walls", "Walls used", len(calibration.walls)),
            Share("covered_share", "Share of the image covered", calibration.covered_share),
            Number("deviation_raw", "Standard deviation", calibration.deviation_raw, "raw units"),
        ),
        sentences=calibration.advice + _left_out(calibration.left_out),
        tables=(Table("Walls", _WALL_HEADINGS, rows),),
        plots=tuple(Plot(title, partial(draw_map, image=image)) for title, image in maps),
    )


def reference_section(system: ReferenceSystem, checks: Sequence[FaceCheck]) -> ReportSection:
    """Report a reference system, with a picture of each face as a sensor sees it."""
    problems = tuple(f"Face {c.face}: {problem}." for c in checks for problem in c.problems)
    rows = tuple(
        (
            c.face,
            str(c.markers),
            _likeness(c),
            f"{c.relief_mm:.1f}",
            f"{c.nearest_mm:.1f}",
            " ".join(f"{value:+z.2f}" for value in c.seen_from),
            f"{c.clear_to_deg:.0f}°",
        )
        for c in checks
    )
    return ReportSection(
        key="reference",
        title=f"Reference system {system.name}",
        sentences=problems or ("Every face is fit to tell where a sensor stands.",),
        tables=(Table("Faces", _FACE_HEADINGS, rows),),
        plots=(Plot("Markers, mm", lambda figure: draw_reference(figure, system)),),
    )


def _likeness(check: FaceCheck) -> str:
    if not np.isfinite(check.symmetry_mm):
        return "like itself after no turn"
    return f"{check.symmetry_mm:.1f} at {check.symmetry_turn_deg:.0f}°"


def survey_section(survey: MarkerSurvey, bump: BumpCheck) -> ReportSection:
    """Report the true marker positions of a built system, and which markers have moved."""
    rows = tuple(
        (m.id, *(f"{value:.2f}" for value in m.position_mm),
         f"{np.linalg.norm(survey.deviation_mm[m.id]):.2f}",
         "not measured" if m.id in survey.unseen else "moved" if m.id in bump.moved else "")
        for m in survey.system.markers
    )  # fmt: skip
    moved = tuple(
        f"Marker {name} is {mm:.1f} mm from its place." for name, mm in bump.moved.items()
    )
    return ReportSection(
        key="survey",
        title=f"Reference system {survey.system.name}, measured",
        numbers=(
            Number("rms_px", "Residual in the pictures (rms)", survey.rms_px, "px"),
            Number("rms_mm", "Distance from the plan (rms)", bump.rms_mm, "mm"),
            Number("largest_change_mm", "Farthest from the plan", survey.largest_change_mm, "mm"),
        ),
        sentences=(*survey.sentences, *(moved or ("No marker was bumped.",))),
        tables=(Table("Markers", ("marker", "x", "y", "z", "standard deviation", ""), rows, "mm"),),
    )


def draw_map(figure: Figure, image: FloatArray) -> None:
    """Draw an image (height, width) with its scale; signed values have white at zero."""
    axes = figure.subplots()
    low, high = np.nanpercentile(image, [1, 99])
    signed = low < 0 < high
    limits = (-max(-low, high), max(-low, high)) if signed else (low, max(high, low + 1e-9))
    colors = "RdBu_r" if signed else "viridis"
    shown = axes.imshow(image, vmin=limits[0], vmax=limits[1], cmap=colors)
    axes.set(xlabel="u, px", ylabel="v, px")
    figure.colorbar(shown, ax=axes)


def draw_reference(figure: Figure, system: ReferenceSystem) -> None:
    """Draw every face as seen from its sensor."""
    faces = list(dict.fromkeys(marker.face for marker in system.markers))
    for axes, face in zip(np.atleast_1d(figure.subplots(1, len(faces))), faces, strict=True):
        markers = system.facing((face,))
        points = positions(markers)
        across, up = (0, 2) if np.ptp(points[:, 2]) > np.ptp(points[:, 1]) else (0, 1)
        depth = points[:, 3 - across - up]
        shown = axes.scatter(points[:, across], points[:, up], c=depth, marker="s", s=60)
        for marker, point in zip(markers, points, strict=True):
            axes.annotate(marker.id, (point[across], point[up]), xytext=(5, 4),
                          textcoords="offset points", fontsize=7, parse_math=False)  # fmt: skip
        axes.set_title(face, parse_math=False)
        axes.set(xlabel="xyz"[across], ylabel="xyz"[up], aspect="equal")
        axes.margins(0.15)
        figure.colorbar(shown, ax=axes, label="xyz"[3 - across - up], shrink=0.6)


def _left_out(left_out: dict[str, str]) -> tuple[str, ...]:
    return tuple(f"{name} was left out: {reason}" for name, reason in left_out.items())


def _draw_errors(figure: Figure, calibration: CameraCalibration) -> None:
    axes: Axes = figure.subplots()
    for picture in calibration.pictures:
        axes.plot(picture.errors_px[:, 0], picture.errors_px[:, 1], "+", ms=4)
    axes.set(xlabel="u, px", ylabel="v, px", aspect="equal")
    axes.grid(visible=True, alpha=0.3)


def _draw_lens(figure: Figure, camera: PinholeCamera) -> None:
    """Draw radial, tangential and total displacement of the lens: figures C.3 and C.4."""
    k1, k2, p1, p2, k3 = camera.distortion
    lenses = {
        "radial": (k1, k2, 0.0, 0.0, k3),
        "tangential": (0.0, 0.0, p1, p2, 0.0),
        "complete": camera.distortion,
    }
    v, u = np.meshgrid(
        np.linspace(0, camera.height - 1, 13), np.linspace(0, camera.width - 1, 17), indexing="ij"
    )
    straight = np.stack([(u - camera.cx) / camera.fx, (v - camera.cy) / camera.fy], axis=-1)
    for axes, (name, lens) in zip(figure.subplots(1, 3, sharey=True), lenses.items(), strict=True):
        bent = PinholeCamera(*_geometry(camera), lens).distort(straight)
        move = (bent - straight) * [camera.fx, camera.fy]
        contours = axes.contour(u, v, np.linalg.norm(move, axis=-1) + 1e-12, levels=6)
        axes.clabel(contours, fontsize=6)
        axes.quiver(u, v, move[..., 0], move[..., 1], angles="xy")
        axes.plot(camera.cx, camera.cy, "ro", ms=3)
        axes.set(title=name, aspect="equal", xlim=(0, camera.width), ylim=(camera.height, 0))


def _geometry(camera: PinholeCamera) -> tuple[int, int, float, float, float, float]:
    return camera.width, camera.height, camera.fx, camera.fy, camera.cx, camera.cy


def _draw_coverage(figure: Figure, calibration: CameraCalibration) -> None:
    """Draw the number of corners in each part of the image."""
    axes, counts = figure.subplots(), calibration.coverage
    axes.imshow(counts, cmap="viridis", vmin=0)
    axes.set(xticks=[], yticks=[])
    for (row, column), count in np.ndenumerate(counts):
        color = "white" if count < 0.6 * counts.max() else "black"
        axes.text(column, row, f"{count}", ha="center", va="center", color=color)


def _draw_boards(figure: Figure, calibration: CameraCalibration) -> None:
    axes = figure.add_subplot(projection="3d")
    for picture in calibration.pictures:
        points = picture.detection.points_mm
        low, high = points.min(0), points.max(0)
        outline = np.array([[low[0], low[1], 0], [high[0], low[1], 0], [high[0], high[1], 0],
                            [low[0], high[1], 0], [low[0], low[1], 0]])  # fmt: skip
        x, y, z = transform(picture.board2camera, outline).T
        axes.plot(x, z, -y)
    axes.plot([0], [0], [0], "k^")
    axes.set(xlabel="to the right", ylabel="away", zlabel="upwards", aspect="equal")
    axes.locator_params(nbins=4)
    axes.tick_params(labelsize=7)
