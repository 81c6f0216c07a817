"""What a reconstruction says of pictures and sessions that are not as they should be."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import cv2
import numpy as np
import pytest

from insole_core.foot.side_check import side_doubt
from insole_core.geometry.arrays import ByteArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.side import Side
from insole_core.reconstruct import Reconstruction, reconstruct
from insole_core.reconstruct.views.foot_coverage import coverage_of, coverage_warnings
from insole_core.recording.box import Box
from insole_core.recording.hand_edits import HandEdits
from insole_core.recording.session import Session, View
from insole_core.sensing.correction import DisparityCorrection

HEEL = Box((-50.0, -150.0, -25.0), (50.0, -90.0, 60.0))


def altered(session: Session, name: str, change: Callable[[View], View]) -> Session:
    views = (change(view) if view.name == name else view for view in session.views)
    return replace(session, views=tuple(views))


def with_colors(session: Session, name: str, change: Callable[[ByteArray], ByteArray]) -> Session:
    def changed(view: View) -> View:
        return replace(view, read_color=lambda index: change(view.read_color(index)))

    return altered(session, name, changed)


def said_of(session: Session, name: str, box: Box | None = HEEL) -> str:
    """What is said of a view, used or not; the others are used, and a warning repeats it.

    The views are judged before they are joined, which takes long: only their heel is.
    """
    result = reconstruct(replace(session, edits=HandEdits(volume_of_interest=box)))
    view = next(view for view in result.views if view.name == name)
    assert all(other.used for other in result.views if other is not view)
    assert any(view.reason in warning for warning in result.warnings)
    return view.reason


def scaled(gain: float, offset: float) -> Callable[[ByteArray], ByteArray]:
    return lambda color: np.clip(color * gain + offset, 0, 255).astype(np.uint8)


def test_a_good_session_is_said_nothing_of(fused: Reconstruction) -> None:
    assert fused.warnings == ()
    assert min(fused.coverage.values()) > 0.9


def covered(fused: Reconstruction, name: str, left: int) -> Callable[[ByteArray], ByteArray]:
    """Cover the markers of a view but some."""
    (view,) = (view for view in fused.views if view.name == name)
    places = np.rint([fix.pixel for fix in view.fixes]).astype(int)[left:].tolist()

    def cover(color: ByteArray) -> ByteArray:
        picture = color.copy()
        for u, v in places:
            picture[v - 20 : v + 20, u - 20 : u + 20] = 26
        return picture

    return cover


@pytest.mark.slow
@pytest.mark.parametrize("left", [3, 4])
def test_a_view_of_three_or_four_markers_is_left_out(
    session: Session, fused: Reconstruction, left: int
) -> None:
    said = said_of(with_colors(session, "top", covered(fused, "top", left)), "top")
    assert "markers" in said


@pytest.mark.slow
def test_a_dark_picture(session: Session) -> None:
    assert "almost dark" in said_of(with_colors(session, "right", scaled(0.08, 0)), "right")


@pytest.mark.slow
def test_an_overexposed_picture(session: Session) -> None:
    assert "overexposed" in said_of(with_colors(session, "right", scaled(3.0, 200)), "right")


@pytest.mark.slow
@pytest.mark.parametrize("sigma_px", [5.0, 12.0])
def test_a_picture_out_of_focus(session: Session, sigma_px: float) -> None:
    blurred = with_colors(
        session, "right", lambda color: np.asarray(cv2.GaussianBlur(color, (0, 0), sigma_px))
    )
    assert "out of focus" in said_of(blurred, "right")


@pytest.mark.slow
def test_a_foot_cut_off_by_the_edge_of_the_picture(session: Session) -> None:
    left_px = 300

    def moved(view: View) -> View:
        """The view of a sensor whose depth picture lies elsewhere."""
        camera = view.sensor.depth_camera
        correction = view.sensor.correction
        assert correction is not None
        sensor = replace(
            view.sensor,
            depth_camera=replace(camera, cx=camera.cx - left_px),
            correction=DisparityCorrection(np.roll(correction.offset, -left_px, 1)),
        )

        def read_depth(index: int) -> np.ndarray:
            depth = np.full((480, 640), 2047, np.uint16)
            depth[:, :-left_px] = view.read_depth(index)[:, left_px:]
            return depth

        return replace(view, sensor=sensor, read_depth=read_depth)

    said = said_of(altered(session, "left", moved), "left", None)
    assert "cut off at the left edge" in said


@pytest.mark.slow
def test_a_reference_system_moved_between_two_views(session: Session) -> None:
    """As if everything but the foot had been lifted by 6 mm before the right view was taken."""

    def nearer(view: View) -> View:
        disparity = view.sensor.disparity
        volume = np.s_[140:336, 284:392]

        def read_depth(index: int) -> np.ndarray:
            depth = view.read_depth(index).copy()
            part = depth[volume]
            seen = part < 2047
            moved = disparity.raw(disparity.depth_mm(part[seen].astype(float)) - 6.0)
            part[seen] = np.rint(moved).astype(np.uint16)
            return depth

        return replace(view, read_depth=read_depth)

    result = reconstruct(altered(session, "right", nearer))
    assert any("left and right do not fit each other" in w for w in result.warnings)


def test_the_wrong_foot_declared(fused: Reconstruction) -> None:
    assert side_doubt(fused.mesh, Side.LEFT) == ""
    doubt = side_doubt(fused.mesh, Side.RIGHT)
    assert "looks like a left one" in doubt
    assert 'correct "side" in manifest.json' in doubt
    by_hand = side_doubt(fused.mesh, Side.RIGHT, is_by_hand=True)
    assert 'correct "side" in marker_edits.json' in by_hand


def test_something_that_is_no_foot() -> None:
    v, u = np.mgrid[:60, :60] * 4.0
    places = np.column_stack([u.ravel(), v.ravel(), np.zeros(3600)])
    corner = (np.arange(59)[:, None] * 60 + np.arange(59)).ravel()
    triangles = np.concatenate(
        [
            np.stack([corner, corner + 60, corner + 1], 1),
            np.stack([corner + 1, corner + 60, corner + 61], 1),
        ]
    ).astype(np.int32)
    assert "does not look like a foot" in side_doubt(TriangleMesh(places, triangles), Side.LEFT)


def test_what_a_single_view_does_not_cover_is_named(session: Session) -> None:
    top = replace(session, views=tuple(view for view in session.views if view.name == "top"))
    result = reconstruct(top)
    assert result.coverage["achilles"] > 0.9
    assert max(result.coverage[region] for region in ("toes", "forefoot", "arch", "heel")) == 0
    assert "Not measured: toes" in coverage_warnings(result.coverage, absence_is_reported=False)[0]


def test_a_hole_in_the_arch_is_named(fused: Reconstruction) -> None:
    y = fused.mesh.vertices[:, 1]
    share = (y - y.min()) / np.ptp(y)
    holed = fused.mesh.part((share < 0.38) | (share > 0.52))
    coverage = coverage_of(holed)
    assert coverage["arch"] < 0.6
    assert min(coverage[region] for region in ("toes", "forefoot", "heel")) > 0.9
    assert "arch" in coverage_warnings(coverage, absence_is_reported=False)[0]
