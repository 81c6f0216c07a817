"""The simulated stereo camera: its noise, its pair, and what is made of its sessions."""

from __future__ import annotations

import re
from typing import Any

import numpy as np
import pytest
import trimesh
from scipy.spatial import cKDTree

from insole_core.errors import UsageError
from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.transforms import rigid
from insole_core.reconstruct import reconstruct
from insole_core.simulate import SimulationOptions, simulate_session
from insole_core.simulate.active_stereo import (
    BASELINE_MM,
    UNIT_MM,
    Projector,
    StereoRecording,
    make_stereo_device,
    record_stereo,
)
from insole_core.simulate.scene import SceneCaster

WALL_MM = 520.0


@pytest.fixture(scope="module")
def wall() -> StereoRecording:
    """A flat wall before two cameras whose projectors both shine."""
    rng = np.random.default_rng(1)
    corners = np.array([[x, y, WALL_MM] for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1))])
    corners[:, :2] *= 400.0
    faces = np.array([[0, 1, 2], [0, 2, 3]], np.int32)
    caster = SceneCaster(TriangleMesh(corners, faces, np.full((4, 3), 200, np.uint8)))
    poses = [np.eye(4), rigid(np.eye(3), np.array([150.0, 20.0, 0.0]))]
    lights = [Projector(make_stereo_device("A", ("sole",), rng), pose) for pose in poses]
    return record_stereo(caster, lights[0], lights, rng, things=corners * [0.12, 0.12, 1.0])


def disparity_error_px(wall: StereoRecording, frame: int) -> FloatArray:
    stored = wall.frame(np.random.default_rng(frame))[wall.region].astype(float)
    focal_px = wall.device.sensor.depth_camera.fx
    seen = focal_px * BASELINE_MM / np.where(stored > 0, stored * UNIT_MM, np.nan)
    expected = focal_px * BASELINE_MM / WALL_MM + wall.device.error_px[wall.region]
    return np.asarray(seen - expected)[15:-15, 15:-15]


def test_a_wall_has_the_noise_of_such_cameras(wall: StereoRecording) -> None:
    first, second = (disparity_error_px(wall, frame) for frame in (1, 2))
    assert np.isfinite(first).mean() > 0.99
    assert 0.05 < np.nanstd(first) < 0.1
    assert abs(np.nanmean(first)) < 0.02
    # What averaging frames removes is the smaller part.
    assert 0.01 < np.nanstd(first - second) / np.sqrt(2) < np.nanstd(first) / 2


def test_the_same_dots_are_in_both_pictures_apart_by_the_disparity(wall: StereoRecording) -> None:
    pair = wall.infrared(np.random.default_rng(3))
    rows, columns = wall.region
    middle = slice(columns.start + 40, columns.stop - 40)
    left = pair["infrared_left"][rows, middle].ravel()
    disparity = wall.device.sensor.depth_camera.fx * BASELINE_MM / WALL_MM
    shifted = slice(middle.start - round(disparity), middle.stop - round(disparity))
    right = pair["infrared_right"][rows, shifted].ravel()
    assert np.corrcoef(left, right)[0, 1] > 0.8


def test_stereo_cameras_below_and_a_kinect_behind_make_one_foot() -> None:
    simulated = simulate_session(
        SimulationOptions(seed=3, distance_mm=520, frames=1, foot_cell_mm=2.5, sensor="mixed")
    )
    result = reconstruct(simulated.session)
    families = [view.family.name for view in result.views if view.family is not None]
    assert families == ["active stereo", "active stereo", "Kinect v1"]
    truth = trimesh.Trimesh(simulated.truth.vertices, simulated.truth.triangles, process=False)
    surface, face = trimesh.sample.sample_surface(truth, 200_000, seed=1)
    normals = truth.face_normals[face]
    nearest = cKDTree(surface).query(result.mesh.vertices)[1]
    off = np.einsum("nc,nc->n", result.mesh.vertices - surface[nearest], normals[nearest])
    sole = (normals[nearest, 2] < -0.5) & (surface[nearest, 2] < 30)
    assert np.abs(off[sole]).mean() < 0.26
    assert np.quantile(np.abs(off[sole]), 0.95) < 0.7


@pytest.mark.parametrize("other", [{"ideal": True}, {"color_size": (640, 480)}])
def test_what_only_a_kinect_has_is_refused(other: dict[str, Any]) -> None:
    with pytest.raises(UsageError, match=re.escape("colour images of 1920 x 1080; leave out")):
        SimulationOptions(sensor="d415", **other)
