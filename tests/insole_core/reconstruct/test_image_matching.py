"""Who is who and where the camera stood, from pixels alone."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from insole_core.errors import ReconstructionError
from insole_core.geometry.arrays import FloatArray, IntArray
from insole_core.geometry.transforms import (
    inverse,
    rigid,
    rotation_about,
    rotation_angle_deg,
    transform,
)
from insole_core.reconstruct.markers.image_matching import match_in_image
from insole_core.reconstruct.markers.marker_faces import apparent_centers
from insole_core.reconstruct.poses.camera_pose import SeenMarkers, SightingNoise, fit_camera_pose
from insole_core.sensing.pinhole_camera import PinholeCamera

MARKERS = np.array(
    [
        [-96.0, -120, 19.2], [-96, -64, 19.2], [-88, -24, 9.6], [-96, 40, 28.8],
        [-88, 80, 9.6], [80, -104, 28.8], [88, -64, 28.8], [80, -24, 9.6],
        [80, 40, 28.8], [80, 96, -9.6], [-40, 160, 28.8], [48, 160, 19.2],
    ]
)  # fmt: skip
CAMERA = PinholeCamera(1280, 1024, 1034.0, 1034.0, 640.2, 520.0, (0.14, -0.24, 0.0, 0.0, 0.0))


def camera_pose(rng: np.random.Generator) -> FloatArray:
    """A camera before the faces, aslant by up to 40 degrees, turned about its axis at will."""
    slant = rotation_about(np.array([*rng.normal(size=2), 0.0]), rng.uniform(0, 40))
    rotation = rotation_about(np.array([0.0, 0, 1]), rng.uniform(0, 360)) @ slant
    ahead = np.array([*rng.uniform(-20, 20, 2), rng.uniform(620, 950)])
    return rigid(rotation, ahead - rotation @ MARKERS.mean(0))


def look(
    rng: np.random.Generator, hidden: int, clutter: int
) -> tuple[FloatArray, IntArray, FloatArray]:
    """Pixels, the marker that each is (-1: none), and the pose they were seen from."""
    pose = camera_pose(rng)
    seen = rng.permutation(len(MARKERS))[hidden:]
    pixels = CAMERA.project(transform(pose, MARKERS[seen])) + rng.normal(0, 0.1, (len(seen), 2))
    others = rng.uniform([150, 50], [1130, 970], (clutter, 2))
    order = rng.permutation(len(pixels) + clutter)
    truth = np.concatenate([seen, np.full(clutter, -1)])
    return np.vstack([pixels, others])[order], truth[order], pose


@pytest.mark.slow
@settings(max_examples=10, deadline=None)
@given(st.integers(0, 2**32 - 1), st.integers(0, 4), st.integers(0, 8))
def test_every_marker_is_named_rightly_or_the_view_is_refused(
    seed: int, hidden: int, clutter: int
) -> None:
    pixels, truth, pose = look(np.random.default_rng(seed), hidden, clutter)
    try:
        found = match_in_image(pixels, np.full(len(pixels), 400.0), MARKERS, CAMERA)
    except ReconstructionError:
        return
    far = truth[found.pairs.points] < 0
    np.testing.assert_array_equal(truth[found.pairs.points][~far], found.pairs.markers[~far])
    moved = transform(inverse(pose), transform(found.reference2color, MARKERS))
    assert np.linalg.norm(moved - MARKERS, axis=1).mean() < 4.0


@pytest.mark.slow
def test_hardly_a_view_is_refused() -> None:
    refused = 0
    for seed in range(20):
        pixels, _, _ = look(np.random.default_rng(seed), hidden=4, clutter=8)
        try:
            match_in_image(pixels, np.full(len(pixels), 400.0), MARKERS, CAMERA)
        except ReconstructionError:
            refused += 1
    assert refused <= 1


def test_a_marker_that_is_partly_hidden_costs_neither_the_view_nor_the_pose() -> None:
    rng = np.random.default_rng(9)
    pose = camera_pose(rng)
    pixels = CAMERA.project(transform(pose, MARKERS)) + rng.normal(0, 0.05, (len(MARKERS), 2))
    pixels[4] += [1.8, -1.5]
    found = match_in_image(pixels, np.full(len(pixels), 400.0), MARKERS, CAMERA)
    assert found.rms_px < 0.2
    assert found.pairs.used[found.pairs.markers != 4].all()
    assert not found.pairs.used[found.pairs.markers == 4].any()
    assert rotation_angle_deg(found.reference2color[:3, :3] @ pose[:3, :3].T) < 0.2


def test_mirrored_pictures_are_refused() -> None:
    pixels, _, _ = look(np.random.default_rng(3), hidden=0, clutter=3)
    flipped = pixels * [-1, 1] + [CAMERA.width - 1, 0]
    with pytest.raises(ReconstructionError, match="mirrored"):
        match_in_image(flipped, np.full(len(pixels), 400.0), MARKERS, CAMERA)


def test_a_symmetric_system_is_refused() -> None:
    square = np.array([[x, y, 0.0] for x in (-80, 0, 80) for y in (-120, 0, 120)])
    pose = rigid(np.eye(3), np.array([0.0, 0, 800]))
    with pytest.raises(ReconstructionError, match="in two ways"):
        match_in_image(CAMERA.project(transform(pose, square)), np.full(9, 400.0), square, CAMERA)


@pytest.mark.parametrize("count", [0, 2, 3, 4, 5])
def test_fewer_than_six_are_refused(count: int) -> None:
    pixels, _, _ = look(np.random.default_rng(1), hidden=12 - count, clutter=0)
    with pytest.raises(ReconstructionError, match="and 6 are needed"):
        match_in_image(pixels, np.full(count, 400.0), MARKERS, CAMERA)


def test_a_side_of_three_markers_tells_no_pose() -> None:
    pixels, _, _ = look(np.random.default_rng(1), hidden=4, clutter=0)
    with pytest.raises(ReconstructionError, match="only 0 of the 8 blue spots fit the 3 markers"):
        match_in_image(pixels, np.full(8, 400.0), MARKERS[:3], CAMERA)


def seen_from(pose: FloatArray, pixels: FloatArray) -> SeenMarkers:
    return SeenMarkers(MARKERS, MARKERS, pixels, transform(pose, MARKERS)[:, 2])


def test_exact_pixels_give_the_exact_pose() -> None:
    pose = camera_pose(np.random.default_rng(5))
    start = rigid(rotation_about(np.array([1.0, 2, 3]), 3.0) @ pose[:3, :3], pose[:3, 3] + 6.0)
    seen = seen_from(pose, CAMERA.project(transform(pose, MARKERS)))
    found = fit_camera_pose(seen, CAMERA, start)
    np.testing.assert_allclose(found.reference2color, pose, atol=1e-6)
    assert found.rms_px < 1e-6


def test_one_wrong_marker_loses_its_weight() -> None:
    pose = camera_pose(np.random.default_rng(6))
    pixels = CAMERA.project(transform(pose, MARKERS))
    pixels[4] += [5.0, -3.0]
    found = fit_camera_pose(seen_from(pose, pixels), CAMERA, pose)
    assert found.weights.argmin() == 4
    assert found.weights[4] < 0.01
    assert rotation_angle_deg(found.reference2color[:3, :3] @ pose[:3, :3].T) < 0.01


def test_the_stated_deviation_is_that_of_many_draws() -> None:
    rng = np.random.default_rng(7)
    pose = camera_pose(rng)
    noise = SightingNoise(pixel_px=0.3, depth_mm=1.0)
    true = CAMERA.project(transform(pose, MARKERS))
    shifts, stated = [], []
    for _ in range(60):
        seen = seen_from(pose, true + rng.normal(0, 0.3, true.shape))
        depth = seen.distances_mm + rng.normal(0, 1.0, 12)
        found = fit_camera_pose(replace(seen, distances_mm=depth), CAMERA, pose, noise)
        center = MARKERS.mean(0)
        shifts.append(transform(found.reference2color, center) - transform(pose, center))
        stated.append(found.displacement_mm(center))
    scatter = np.sqrt((np.array(shifts) ** 2).sum(1).mean())
    # Robust weights cost some efficiency; the statement is on the safe side.
    assert scatter < np.mean(stated) < 3 * scatter


def test_the_noise_of_a_picture_is_taken_from_the_residuals() -> None:
    rng = np.random.default_rng(8)
    pose = camera_pose(rng)
    true = CAMERA.project(transform(pose, MARKERS))
    errors: dict[str, list[float]] = {"told": [], "unknown": []}
    for _ in range(60):
        seen = seen_from(pose, true + rng.normal(0, 0.8, true.shape))
        seen = replace(seen, distances_mm=seen.distances_mm + rng.normal(0, 1.0, 12))
        for how, noise in (("told", SightingNoise(0.8)), ("unknown", SightingNoise())):
            found = fit_camera_pose(seen, CAMERA, pose, noise)
            off = transform(found.reference2color, MARKERS) - transform(pose, MARKERS)
            errors[how].append(float(np.linalg.norm(off, axis=1).mean()))
    assert np.mean(errors["unknown"]) < 1.05 * np.mean(errors["told"])


@pytest.mark.parametrize("flank_mm", [0.0, 4.0])
def test_a_blue_flank_is_recognised_by_the_width_of_the_blobs(flank_mm: float) -> None:
    slant = rotation_about(np.array([0.0, 1, 0]), 35.0)
    pose = rigid(slant, np.array([0.0, 0, 800]) - slant @ MARKERS.mean(0))
    size_mm = 16.0
    spreads = []
    for marker in MARKERS:
        towards = inverse(pose)[:3, 3] - marker
        tangent = np.linalg.norm(towards[:2]) / -towards[2]
        along = towards[:2] / np.linalg.norm(towards[:2])
        wide, narrow = ((size_mm + flank_mm * tangent) ** 2 / 12, size_mm**2 / 12)
        in_plane = wide * np.outer(along, along) + narrow * (np.eye(2) - np.outer(along, along))
        at = CAMERA.project(transform(pose, marker[None]))[0]
        step = [
            CAMERA.project(transform(pose, (marker + axis)[None]))[0] - at for axis in np.eye(3)[:2]
        ]
        to_pixels = np.stack(step, axis=1)
        spreads.append(to_pixels @ in_plane @ to_pixels.T)
    centers = apparent_centers(MARKERS, np.array(spreads), CAMERA, pose)
    np.testing.assert_allclose((centers - MARKERS)[:, 2], flank_mm / 2, atol=0.01)
