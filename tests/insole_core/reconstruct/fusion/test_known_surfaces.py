"""Surfaces of known shape, seen by sensors without any error or by simulated ones, fused."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from insole_core.errors import ReconstructionError
from insole_core.geometry.arrays import ByteArray, FloatArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.mesh_graph import smoothed_normals
from insole_core.geometry.ray_casting import RayCaster
from insole_core.geometry.transforms import rigid, rotation_about
from insole_core.reconstruct.fusion.depth_view import DepthView, read_volume
from insole_core.reconstruct.fusion.fused_surface import fuse
from insole_core.reconstruct.fusion.observation import observe
from insole_core.reconstruct.fusion.prepared_view import prepare
from insole_core.reconstruct.fusion.refinement import refine
from insole_core.reconstruct.result import Surface
from insole_core.recording.box import Box
from insole_core.sensing.disparity import LinearInverseDisparity
from insole_core.sensing.frames import average_raw
from insole_core.sensing.pinhole_camera import PinholeCamera
from insole_core.sensing.sensor import Sensor
from insole_core.simulate.block_matching import record_matched_depth
from insole_core.simulate.device import Device
from insole_core.simulate.scene import SceneCaster

DISTANCE_MM = 700.0
SENSOR = Sensor(
    "kinect-v1",
    "0",
    PinholeCamera(640, 480, 580.0, 580.0, 320.0, 240.0),
    PinholeCamera(1280, 1024, 1035.0, 1035.0, 640.0, 512.0),
    np.eye(4),
    LinearInverseDisparity(a=1090 / 348, b=-1 / 348),
)
GREY = np.full((1024, 1280, 3), 120, np.uint8)
BOX = Box((-60.0, -60.0, -40.0), (60.0, 60.0, 40.0))
Height = Callable[[FloatArray, FloatArray], FloatArray]


def pose(tilt_deg: float) -> FloatArray:
    """A sensor below the origin, looking up at it aslant."""
    turn = rotation_about(np.array([0.0, 1.0, 0.0]), tilt_deg)
    return rigid(turn, turn @ [0.0, 0.0, -DISTANCE_MM])


def sheet(height_mm: Height, step_mm: float = 0.5, half_mm: float = 55.0) -> TriangleMesh:
    """A surface over the plane z = 0, where its height is not NaN."""
    y, x = np.mgrid[-half_mm : half_mm + step_mm : step_mm, -half_mm : half_mm + step_mm : step_mm]
    z = height_mm(x, y)
    number = np.arange(z.size).reshape(z.shape)
    a, b, c, d = (
        number[rows, columns].ravel()
        for rows in (slice(None, -1), slice(1, None))
        for columns in (slice(None, -1), slice(1, None))
    )
    triangles = np.concatenate([np.stack([a, c, b], 1), np.stack([b, c, d], 1)])
    known = np.isfinite(z.ravel())
    places = np.column_stack([x.ravel(), y.ravel(), np.nan_to_num(z.ravel())])
    return TriangleMesh(places, triangles[known[triangles].all(1)].astype(np.int32))


def look(surface: TriangleMesh, tilt_deg: float, color: ByteArray = GREY) -> DepthView:
    """What a sensor without any error reads of a surface."""
    sensor2reference = pose(tilt_deg)
    whole = DepthView("view", SENSOR, sensor2reference, (0, 0), np.zeros((480, 640)), color)
    rays = whole.rays.reshape(-1, 3)
    hits = RayCaster(surface).cast(whole.origin_mm, rays)
    corners = surface.vertices[surface.triangles[hits.triangle]]
    depth_mm = whole.depth_along(np.einsum("nk,nkc->nc", hits.weights, corners))
    raw = np.full((480, 640), np.nan)
    raw.flat[hits.ray] = SENSOR.disparity.raw(depth_mm)
    return read_volume("view", SENSOR, sensor2reference, BOX, raw=raw, color=color)


@cache
def looks_at_ball(radius_mm: float, tilts_deg: tuple[float, ...]) -> list[DepthView]:
    """What sensors with a matching window read of the lower end of a ball.

    The mean of several patterns of dots, so that hardly more than the window's error is left.
    """
    low = sheet(cap(radius_mm, steepest_deg=80.0))
    caster, device = SceneCaster(low), Device(SENSOR, np.zeros((480, 640)), 0.0)
    readings = []
    for view, tilt in enumerate(tilts_deg):
        rng = np.random.default_rng([7, view])
        recordings = [
            record_matched_depth(caster, device, pose(tilt), rng, things=low.vertices)
            for _ in range(4)
        ]
        raw = average_raw([recording.frame(rng) for recording in recordings]).raw
        readings.append(read_volume("view", SENSOR, pose(tilt), BOX, raw=raw, color=GREY))
    return readings


def fused(*readings: DepthView) -> Surface:
    return fuse([prepare(reading) for reading in readings])


def tilted(x: FloatArray, y: FloatArray) -> FloatArray:
    return 0.2 * x - 0.1 * y + 3.0


def cap(radius_mm: float, steepest_deg: float = 60.0) -> Height:
    """The lower end of a ball, its lowest point in the origin."""
    lowest = np.cos(np.radians(steepest_deg)) * radius_mm

    def height(x: FloatArray, y: FloatArray) -> FloatArray:
        inside = radius_mm**2 - x**2 - y**2
        steep = inside < lowest**2
        return np.where(steep, np.nan, radius_mm - np.sqrt(np.maximum(inside, 0)))

    return height


def toes(x: FloatArray, y: FloatArray) -> FloatArray:
    """Two cylinders along y of 9 mm radius, 8 mm apart."""
    aside = np.abs(x) - 13.0
    inside = 81.0 - aside**2
    return np.where((inside > 8) & (np.abs(y) < 40), 9.0 - np.sqrt(np.maximum(inside, 0)), np.nan)


def test_a_plane_is_a_plane() -> None:
    surface = fused(look(sheet(tilted), -20.0), look(sheet(tilted), 20.0))
    x, y, z = surface.mesh.vertices.T
    # At its border a real sensor's window would see the plane end, and that is reckoned with.
    inner = np.maximum(np.abs(x), np.abs(y)) < 25
    assert np.abs(z - tilted(x, y))[inner].max() < 0.12
    assert np.abs(z - tilted(x, y)).mean() < 0.5
    assert np.ptp(x) > 100
    assert np.ptp(y) > 100
    assert surface.view_gaps_mm is not None
    assert np.abs(surface.view_gaps_mm[..., 2]).max() < 0.6
    assert surface.deviation_mm is not None
    assert 0.02 < np.median(surface.deviation_mm) < 1.0
    assert (surface.mesh.triangle_normals[:, 2] < 0).all(), "the outside faces the sensors"


@pytest.mark.slow
def test_a_ball_keeps_its_radius() -> None:
    surface = fused(*looks_at_ball(50.0, (-15.0, 15.0)))
    places = surface.mesh.vertices
    radius = np.linalg.norm(places - [0, 0, 50.0], axis=1)
    inner = np.hypot(places[:, 0], places[:, 1]) < 28
    assert abs(radius[inner].mean() - 50.0) < 0.3
    assert np.abs(radius - 50.0)[inner].max() < 0.7


def test_nothing_bridges_the_gap_between_two_toes() -> None:
    surface = fused(look(sheet(toes), -15.0), look(sheet(toes), 15.0))
    x = surface.mesh.vertices[:, 0]
    assert np.abs(x).min() > 2.0
    sides = np.sign(x)[surface.mesh.triangles]
    assert (np.abs(sides.sum(1)) == 3).all(), "every triangle lies on one toe"
    for side in (-1, 1):
        assert np.ptp(x[np.sign(x) == side]) > 12


def ball_in_picture(radius_mm: float, tilt_deg: float) -> ByteArray:
    """A bright ball before a dark wall, its lowest point in the origin."""
    camera, color2reference = SENSOR.color_camera, pose(tilt_deg)
    ahead = np.concatenate([camera.pixel_rays(), np.ones((1024, 1280, 1))], axis=2)
    rays = ahead @ color2reference[:3, :3].T
    way = [0.0, 0.0, radius_mm] - color2reference[:3, 3]
    along = rays @ way / np.linalg.norm(rays, axis=2)
    outside_mm = np.sqrt(np.maximum(way @ way - along**2, 0)) - radius_mm
    share = np.clip(0.5 - outside_mm * camera.fx / DISTANCE_MM, 0, 1)
    return np.asarray(30 + share[..., None] * [150.0, 90.0, 70.0], dtype=np.uint8)


def looks_at_outlined_ball(radius_mm: float, tilts_deg: tuple[float, ...]) -> list[DepthView]:
    """What they read of it when it is bright before a dark wall."""
    return [
        replace(reading, color=ball_in_picture(radius_mm, tilt))
        for reading, tilt in zip(looks_at_ball(radius_mm, tilts_deg), tilts_deg, strict=True)
    ]


@pytest.mark.slow
def test_outlines_in_the_pictures_show_where_a_ball_ends() -> None:
    radius_mm, tilts = 30.0, (-20.0, 20.0)
    plain = fused(*looks_at_ball(radius_mm, tilts)).mesh
    seen = fused(*looks_at_outlined_ball(radius_mm, tilts)).mesh
    assert plain.touches is not None
    assert len(plain.touches.points) == 0
    assert seen.touches is not None
    reach = np.einsum("kc,kc->k", seen.touches.points - [0, 0, radius_mm], seen.touches.normals)
    assert len(reach) > 50
    assert reach == pytest.approx(radius_mm, abs=0.4)
    out = [np.hypot(mesh.vertices[:, 0], mesh.vertices[:, 1]).max() for mesh in (plain, seen)]
    assert out[1] > out[0] + 0.5, "grown towards the outline"
    away = np.linalg.norm(seen.vertices - [0, 0, radius_mm], axis=1)
    assert np.abs(away - radius_mm).mean() < 0.4
    # At one vertex of the border, where no reading is: 2.449 on all processors tried.
    assert np.abs(away - radius_mm).max() < 2.5


def test_the_last_bits_of_the_readings_decide_nothing() -> None:
    looks = looks_at_outlined_ball(30.0, (-20.0, 20.0))
    rng = np.random.default_rng(4)
    shaken = [
        look.with_raw(look.raw * (1 + rng.uniform(-1e-12, 1e-12, look.raw.shape))) for look in looks
    ]
    plain, other = fused(*looks).mesh, fused(*shaken).mesh
    assert other.triangles.shape == plain.triangles.shape
    np.testing.assert_allclose(other.vertices, plain.vertices, rtol=0, atol=1e-6)


def test_noise_is_smoothed_and_outliers_do_not_count() -> None:
    rng = np.random.default_rng(3)
    reading = look(sheet(tilted), 0.0)
    noisy = reading.raw + rng.normal(0, 0.5, reading.raw.shape)
    noisy[rng.random(noisy.shape) < 0.03] += 5.0
    x, y, z = fused(reading.with_raw(noisy)).mesh.vertices.T
    inner = np.maximum(np.abs(x), np.abs(y)) < 30
    error = (z - tilted(x, y))[inner]
    noise_mm = 0.5 / abs(float(reading.raw_per_mm(np.array([DISTANCE_MM]))[0]))
    assert error.std() < noise_mm / 4
    assert abs(error.mean()) < 0.1


@pytest.mark.parametrize("moved_mm", [(0.0, 0.0, 3.0), (3.0, 0.0, 0.0), (0.0, -3.0, 0.0)])
def test_a_view_that_was_moved_is_told_by_its_shift(moved_mm: tuple[float, ...]) -> None:
    first, second = looks_at_ball(50.0, (-15.0, 15.0))
    elsewhere = second.sensor2reference.copy()
    elsewhere[:3, 3] += moved_mm
    gaps_mm = fused(first, replace(second, sensor2reference=elsewhere)).view_gaps_mm
    assert gaps_mm is not None
    np.testing.assert_allclose(gaps_mm[0, 1], moved_mm, atol=0.5)
    np.testing.assert_array_equal(gaps_mm[1, 0], -gaps_mm[0, 1])


def test_a_mesh_too_near_by_a_millimetre_has_that_residual() -> None:
    reading = look(sheet(tilted), 0.0)
    mesh = sheet(lambda x, y: tilted(x, y) - 1.0, step_mm=2.0)
    normals = smoothed_normals(mesh, 1)
    seen = observe(reading, mesh, normals, RayCaster(mesh))
    per_mm = float(reading.raw_per_mm(np.array([DISTANCE_MM]))[0])
    assert np.median(seen.residuals) == pytest.approx(per_mm, rel=0.05)
    # Moving every vertex along its normal, which points to the sensor, by -1/cos mends it.
    step = np.full(len(mesh.vertices), normals[0, 2] * 1.0)
    left = seen.residuals - seen.design @ step
    assert np.abs(np.median(left)) < 0.05 * abs(per_mm)


def test_refining_the_truth_leaves_it() -> None:
    mesh = sheet(tilted, step_mm=2.0)
    refined = refine(mesh, [look(sheet(tilted), 10.0)])
    inner = np.abs(mesh.vertices[:, :2]).max(1) < 42
    assert np.abs(refined.mesh.vertices - mesh.vertices)[inner].max() < 0.05
    np.testing.assert_allclose(refined.view_offsets_raw, 0, atol=0.02)


def test_a_pen_line_of_one_millimetre_is_seen_in_the_colours() -> None:
    distance_mm = DISTANCE_MM + 3.0
    fine = (np.arange(4 * 1280) + 0.5) / 4 - 0.5
    ink = np.abs((fine - 640) / 1035 * distance_mm - 7.3) < 0.5
    share = ink.reshape(1280, 4).mean(1)
    row = np.stack([200 - 160 * share, 160 - 120 * share, 140 - 80 * share], axis=1)
    color = np.broadcast_to(np.rint(row).astype(np.uint8), (1024, 1280, 3)).copy()
    flat = sheet(lambda x, y: np.full_like(x, 3.0))
    mesh = fused(look(flat, 0.0, color)).mesh
    assert mesh.colors is not None
    x = mesh.vertices[:, 0]
    red = mesh.colors[:, 0].astype(float)
    skin = np.median(red[np.abs(x - 7.3) > 3])
    assert skin == pytest.approx(200, abs=2)
    for low in np.arange(-40, 40, 4.0):
        here = (np.abs(mesh.vertices[:, 1] - low) < 2) & (np.abs(x - 7.3) < 1)
        assert red[here].min() < skin - 60, "every 4 mm of the line shows dark vertices"
    width = x[(red < skin - 60) & (np.abs(mesh.vertices[:, 1]) < 40)]
    assert np.ptp(width) < 2.5, "and no wider than two vertices"


def test_nothing_in_the_volume() -> None:
    empty = np.full((480, 640), np.nan)
    with pytest.raises(ReconstructionError, match="no surface in the volume"):
        read_volume("view", SENSOR, pose(0), BOX, raw=empty, color=GREY)
