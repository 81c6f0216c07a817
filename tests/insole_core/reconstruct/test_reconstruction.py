"""From a small simulated session to the foot, and what bad input is answered with."""

from __future__ import annotations

import json
import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import trimesh

from insole_core.errors import ReconstructionError
from insole_core.geometry.arrays import ByteArray, FloatArray, RawArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.transforms import inverse, rotation_angle_deg, transform
from insole_core.progress import Cancelled, Progress
from insole_core.reconstruct import (
    Method,
    Reconstruction,
    RegistrationLimits,
    reconstruct,
    report_json,
)
from insole_core.recording.box import Box
from insole_core.recording.session import Session, View
from insole_core.sensing.correction import DisparityCorrection
from insole_core.sensing.pinhole_camera import PinholeCamera

SMALL = Path(__file__).parents[2] / "data" / "sessions" / "left_small.zip"


@pytest.fixture(scope="module")
def thesis(session: Session) -> Reconstruction:
    return reconstruct(session, "thesis")


@pytest.fixture(params=["thesis", "fused"])
def reconstruction(request: pytest.FixtureRequest) -> Reconstruction:
    found: Reconstruction = request.getfixturevalue(request.param)
    return found


def altered(session: Session, name: str, **changes: object) -> Session:
    """The session with one view changed."""
    views = (replace(view, **changes) if view.name == name else view for view in session.views)
    return replace(session, views=tuple(views))


def view_of(session: Session, name: str) -> View:
    return next(view for view in session.views if view.name == name)


def reason(session: Session, name: str) -> str:
    """Why a view is left out; the others must be used, and the warning must say so."""
    result = reconstruct(session, "thesis")
    left_out = [view for view in result.views if not view.used]
    assert [view.name for view in left_out] == [name]
    assert result.warnings[0] == f"The view {name} is left out: {left_out[0].reason}."
    assert all("No view shows the side" in warning for warning in result.warnings[1:])
    return left_out[0].reason


def black(index: int) -> ByteArray:
    return np.zeros((1024, 1280, 3), dtype=np.uint8)


def without_reading(index: int) -> RawArray:
    return np.full((480, 640), 2047, dtype=np.uint16)


def turned_camera(camera: PinholeCamera, right: int, down: int) -> PinholeCamera:
    """The camera whose picture is the other's, its columns and rows run through in steps of +-1."""
    return replace(
        camera,
        cx=camera.cx if right > 0 else camera.width - 1 - camera.cx,
        cy=camera.cy if down > 0 else camera.height - 1 - camera.cy,
    )


def turned(session: Session, name: str, right: int, down: int) -> Session:
    """The session with the pictures of one view, and its calibration, mirrored or turned."""
    view = view_of(session, name)
    axes = np.diag([right, down, 1.0, 1.0])
    correction = view.sensor.correction
    assert correction is not None
    sensor = replace(
        view.sensor,
        depth_camera=turned_camera(view.sensor.depth_camera, right, down),
        color_camera=turned_camera(view.sensor.color_camera, right, down),
        depth2color=axes @ view.sensor.depth2color @ axes,
        correction=DisparityCorrection(correction.offset[::down, ::right]),
    )
    return altered(
        session,
        name,
        sensor=sensor,
        read_depth=lambda index: view.read_depth(index)[::down, ::right],
        read_color=lambda index: view.read_color(index)[::down, ::right],
    )


def distance_to_truth(mesh: TriangleMesh, truth: trimesh.Trimesh) -> FloatArray:
    from scipy.spatial import cKDTree

    surface, _ = trimesh.sample.sample_surface(truth, 100_000, seed=1)
    return np.asarray(cKDTree(surface).query(mesh.vertices)[0])


@pytest.fixture(scope="module")
def truth(
    tmp_path_factory: pytest.TempPathFactory,
) -> tuple[trimesh.Trimesh, dict[str, FloatArray]]:
    from zipfile import ZipFile

    folder = tmp_path_factory.mktemp("truth")
    with ZipFile(SMALL) as archive:
        archive.extract("truth.ply", folder)
        poses = json.loads(archive.read("truth_poses.json"))["sensor2reference"]
    mesh = trimesh.load(folder / "truth.ply", process=False, force="mesh")
    return mesh, {name: np.array(pose) for name, pose in poses.items()}


def test_the_foot_lies_on_the_truth(
    reconstruction: Reconstruction, truth: tuple[trimesh.Trimesh, dict[str, FloatArray]]
) -> None:
    distance_mm = distance_to_truth(reconstruction.mesh, truth[0])
    assert distance_mm.mean() < 1.3
    assert (distance_mm > 5).mean() < 0.02


def test_the_whole_sole_is_there_and_coloured(
    reconstruction: Reconstruction, truth: tuple[trimesh.Trimesh, dict[str, FloatArray]]
) -> None:
    mesh = reconstruction.mesh
    np.testing.assert_allclose(np.ptp(mesh.vertices[:, 1]), np.ptp(truth[0].vertices[:, 1]), atol=6)
    assert mesh.colors is not None
    red, green, blue = mesh.colors.mean(0)
    assert red > green > blue > 20
    facing_ground = mesh.triangle_normals[:, 2] < -0.5
    assert facing_ground.mean() > 0.3


def test_the_poses_are_those_of_the_sensors(
    reconstruction: Reconstruction, truth: tuple[trimesh.Trimesh, dict[str, FloatArray]]
) -> None:
    for view in reconstruction.views:
        assert view.sensor2reference is not None
        true = truth[1][view.name]
        shift = transform(view.sensor2reference, transform(inverse(true), np.zeros(3)))
        assert np.linalg.norm(shift) < 2.5
        assert rotation_angle_deg(view.sensor2reference[:3, :3] @ true[:3, :3].T) < 0.7


def test_the_report_holds_what_the_contract_says(reconstruction: Reconstruction) -> None:
    report = json.loads(json.dumps(report_json(reconstruction, 1.5)))
    assert [view["name"] for view in report["views"]] == ["left", "right", "top"]
    left, _, top = report["views"]
    assert left["used"]
    assert 10 <= left["markers_used"] <= left["markers_found"] <= 12
    assert 7 <= top["markers_used"] <= top["markers_found"] <= 8
    assert 0 < left["residual_mm"]["mean"] <= left["residual_mm"]["rms"]
    assert left["residual_mm"]["rms"] <= left["residual_mm"]["max"]
    assert left["residual_mm"]["mean"] < 2.0
    assert np.shape(left["sensor2reference"]) == (4, 4)
    assert report["vertices"] == len(reconstruction.mesh.vertices) > 5000
    assert report["triangles"] == len(reconstruction.mesh.triangles)
    assert report["seconds"]["total"] == 1.5
    assert report["warnings"] == []


def test_the_report_tells_how_far_the_correction_moved_the_surface(
    reconstruction: Reconstruction,
) -> None:
    moved = report_json(reconstruction, 1.5)["correction_mm"]
    if reconstruction.deviation_mm is None:  # the thesis's method knows no correction
        assert moved is None
    else:
        assert 0.02 < moved["mean"] < moved["p95"] < 3


def test_without_the_correction_the_readings_stay_as_they_are(session: Session) -> None:
    part = replace(session, views=(view_of(session, "left"),))
    plain, corrected = (reconstruct(part, corrected=one) for one in (False, True))
    assert report_json(plain, 1.0)["correction_mm"] is None
    assert report_json(corrected, 1.0)["correction_mm"] is not None
    assert plain.mesh.area_mm2 == pytest.approx(corrected.mesh.area_mm2, rel=0.1)
    assert plain.mesh.vertices.mean() != corrected.mesh.vertices.mean()


@pytest.mark.parametrize(("method", "whole"), [("thesis", True), ("fused", False)])
def test_the_thesis_has_its_depth_in_whole_mm(
    session: Session, method: Method, whole: bool
) -> None:
    result = reconstruct(replace(session, views=(view_of(session, "left"),)), method)
    assert result.views[0].used
    assert len(result.mesh.triangles) > 1000
    pose = result.views[0].sensor2reference
    assert pose is not None
    depth_mm = transform(inverse(pose), result.mesh.vertices)[:, 2]
    assert bool((np.abs(depth_mm - np.rint(depth_mm)) < 1e-6).all()) is whole


@pytest.mark.parametrize("method", ["thesis", "fused"])
@pytest.mark.parametrize("names", [("top",), ("right", "top")])
def test_any_subset_of_the_views_will_do(
    session: Session, method: Method, names: tuple[str, ...]
) -> None:
    part = replace(session, views=tuple(view_of(session, name) for name in names))
    result = reconstruct(part, method)
    assert all(view.used for view in result.views)
    assert len(result.mesh.triangles) > 1000


def test_a_view_turned_about_its_axis_is_recognised(
    session: Session, thesis: Reconstruction
) -> None:
    was = thesis.views[0].sensor2reference
    now = reconstruct(turned(session, "left", -1, -1), "thesis").views[0].sensor2reference
    assert was is not None
    assert now is not None
    np.testing.assert_allclose(now @ np.diag([-1, -1, 1, 1]), was, atol=1.0)


def test_progress_is_told_and_can_cancel(session: Session) -> None:
    told: list[tuple[float, str]] = []
    reconstruct(session, "thesis", Progress(report=lambda f, text: told.append((f, text))))
    fractions = [fraction for fraction, _ in told]
    assert fractions == sorted(fractions)
    assert fractions[-1] == 1.0
    with pytest.raises(Cancelled):
        reconstruct(session, "thesis", Progress(is_cancelled=lambda: len(told) > 0))


def test_one_view_without_markers(session: Session) -> None:
    assert "no blue marker" in reason(altered(session, "right", read_color=black), "right")


def test_one_view_without_a_reading(session: Session) -> None:
    broken = altered(session, "top", read_depth=without_reading)
    assert "depth frames hold no reading" in reason(broken, "top")


def test_a_sole_view_in_the_place_of_the_achilles_view(session: Session) -> None:
    left = view_of(session, "left")
    swapped = altered(session, "top", read_depth=left.read_depth, read_color=left.read_color)
    text = reason(swapped, "top")
    assert 'says that it sees the markers "achilles", but it sees "sole"' in text


def test_a_sole_view_swapped_with_the_achilles_view(session: Session) -> None:
    left, top = view_of(session, "left"), view_of(session, "top")
    swapped = altered(session, "top", read_depth=left.read_depth, read_color=left.read_color)
    swapped = altered(swapped, "left", read_depth=top.read_depth, read_color=top.read_color)
    result = reconstruct(swapped, "thesis")
    assert [view.used for view in result.views] == [False, True, False]
    assert all("exchange the views" in warning for warning in result.warnings[:2])


def test_a_side_that_no_view_shows_is_named(session: Session) -> None:
    soles = tuple(view_of(session, name) for name in ("left", "right"))
    (warning,) = reconstruct(replace(session, views=soles)).warnings
    assert 'side of the markers "achilles"' in warning


@pytest.mark.slow
def test_one_view_recorded_under_two_names(session: Session) -> None:
    left, right = view_of(session, "left"), view_of(session, "right")
    other = replace(left, name="right", sensor=replace(left.sensor, serial="other"))
    twice = replace(session, views=(left, other, view_of(session, "top")))
    (warning,) = reconstruct(twice).warnings
    assert "left and right stood in the same place (0 mm apart)" in warning
    assert right.sensor.serial != left.sensor.serial


@pytest.mark.slow
def test_frames_in_which_something_moved_are_left_out_and_told(session: Session) -> None:
    view = view_of(session, "left")
    still = np.stack([view.read_depth(i) for i in range(view.depth_count)])

    def moving(index: int) -> RawArray:
        frame = still[index % len(still)].copy()
        if index == 4:
            frame[100:380, 150:500] = np.where(
                frame[100:380, 150:500] < 2047, frame[100:380, 150:500] + 3, 2047
            )
        return frame

    restless = altered(session, "left", read_depth=moving, depth_count=9)
    (warning,) = reconstruct(restless).warnings
    patch = still[0][100:380, 150:500]
    raw = float(np.median(patch[patch < 2047]))
    near_mm, far_mm = view.sensor.disparity.depth_mm(np.array([raw, raw + 3]))
    said = re.search(r"In the view left something moved by (\d\.\d) mm", warning)
    assert said
    assert float(said[1]) == pytest.approx(far_mm - near_mm, rel=0.1)
    assert "1 of its 9 depth frames are left out" in warning


def test_every_vertex_has_a_standard_deviation(fused: Reconstruction) -> None:
    assert fused.deviation_mm is not None
    assert fused.deviation_mm.shape == (len(fused.mesh.vertices),)
    assert 0 < np.median(fused.deviation_mm) < 2


@pytest.mark.slow
def test_markers_are_recognised_by_colour_where_depth_fails_on_them(
    session: Session, fused: Reconstruction
) -> None:
    usual = fused
    view = view_of(session, "left")
    pixels = np.array([fix.pixel for fix in usual.views[0].fixes])

    def without_markers(index: int) -> RawArray:
        depth = view.read_depth(index).copy()
        scale = view.sensor.color_camera.fx / view.sensor.depth_camera.fx
        for u, v in pixels / scale:
            depth[max(int(v) - 40, 0) : int(v) + 40, max(int(u) - 22, 0) : int(u) + 45] = 2047
        return depth

    found = reconstruct(altered(session, "left", read_depth=without_markers)).views[0]
    assert found.used
    pose, was = found.sensor2reference, usual.views[0].sensor2reference
    assert pose is not None
    assert was is not None
    foot = transform(inverse(was), np.zeros(3))
    assert np.linalg.norm(transform(pose, foot)) < 2.0
    # Each is known to 0.2 degrees in this small picture, which one ray per pixel was cast for.
    assert rotation_angle_deg(pose[:3, :3].T @ was[:3, :3]) < 0.5


def test_mirrored_pictures(session: Session) -> None:
    assert "mirror image" in reason(turned(session, "left", -1, 1), "left")


def test_markers_of_another_reference_system(session: Session) -> None:
    system = session.manifest.reference_system
    rng = np.random.default_rng(3)
    moved = tuple(
        replace(
            marker, position_mm=tuple(rng.permutation(marker.position_mm) + rng.normal(0, 30, 3))
        )
        for marker in system.markers
    )
    other = replace(session.manifest, reference_system=replace(system, markers=moved))
    with pytest.raises(ReconstructionError) as refused:
        reconstruct(replace(session, manifest=other), "thesis")
    text = str(refused.value)
    assert "No foot can be made from" in text
    assert all(
        f"view {name}: the markers of the reference system" in text
        for name in ("left", "right", "top")
    )


def test_faces_that_the_reference_system_does_not_have(session: Session) -> None:
    sensor = replace(view_of(session, "left").sensor, faces=("front",))
    text = reason(altered(session, "left", sensor=sensor), "left")
    assert '"front"' in text
    assert '"sole", "achilles"' in text


def test_a_pose_worse_than_the_limit_is_refused_with_its_markers(session: Session) -> None:
    with pytest.raises(ReconstructionError, match=r"more than 0\.01 mm \(worst: [SA]\d+ "):
        reconstruct(session, "thesis", limits=RegistrationLimits(residual_mm=0.01))


def test_without_a_volume_the_reference_system_bounds_the_foot(session: Session) -> None:
    unbounded = replace(session, manifest=replace(session.manifest, volume_of_interest=None))
    bounded = reconstruct(session, "thesis").mesh
    mesh = reconstruct(unbounded, "thesis").mesh
    assert len(mesh.vertices) == pytest.approx(len(bounded.vertices), rel=0.1)


def test_a_volume_without_a_foot(session: Session) -> None:
    beside = Box((300, -150, -40), (440, 150, 160))
    elsewhere = replace(session, manifest=replace(session.manifest, volume_of_interest=beside))
    with pytest.raises(ReconstructionError, match="no surface in the volume of interest"):
        reconstruct(elsewhere, "thesis")
