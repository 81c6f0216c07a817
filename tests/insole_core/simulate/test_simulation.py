from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from scipy.spatial import cKDTree

from insole_core.calibration.boards.printed_page import MARKER_MM
from insole_core.errors import UsageError
from insole_core.geometry.side import Side
from insole_core.geometry.transforms import inverse, is_rotation, transform
from insole_core.progress import Cancelled, Progress
from insole_core.recording.session import View
from insole_core.sensing.disparity import NO_READING
from insole_core.simulate import (
    FootShape,
    SimulatedSession,
    SimulationOptions,
    simulate_session,
)
from insole_core.simulate.scene import load_reference_system

SMALL = SimulationOptions(frames=1, color_size=(640, 480), foot_cell_mm=6.0)


def _points_in_sensor(session: SimulatedSession, view: View, points: np.ndarray) -> np.ndarray:
    return transform(inverse(session.sensor2reference[view.name]), points)


def test_the_views_are_named_by_burst(right_session: SimulatedSession) -> None:
    manifest = right_session.session.manifest

    assert manifest.views == ("left", "left_2", "right", "right_2", "top", "top_2")
    assert manifest.side is Side.RIGHT
    assert tuple(view.name for view in right_session.session.views) == manifest.views
    assert set(right_session.sensor2reference) == set(manifest.views)


def test_bursts_are_the_same_device_in_another_place(right_session: SimulatedSession) -> None:
    first, second = right_session.session.views[:2]
    poses = [right_session.sensor2reference[view.name] for view in (first, second)]

    assert first.sensor is second.sensor
    assert 1 < np.linalg.norm(poses[0][:3, 3] - poses[1][:3, 3]) < 60
    assert not np.array_equal(first.read_depth(0), second.read_depth(0))


def test_the_sensors_stand_where_the_contract_says(right_session: SimulatedSession) -> None:
    poses = right_session.sensor2reference
    for view, position, forward in (
        ("left", [-363, 12, -708], [0.45, 0, 0.89]),
        ("right", [363, 12, -708], [-0.45, 0, 0.89]),
        ("top", [0, -902, 221], [0, 0.988, -0.156]),
    ):
        assert is_rotation(poses[view][:3, :3], 1e-9)
        np.testing.assert_allclose(poses[view][:3, 3], position, atol=30)
        np.testing.assert_allclose(poses[view][:3, 2], forward, atol=0.06)


def test_frames_have_the_declared_form(right_session: SimulatedSession) -> None:
    for view in right_session.session.views:
        depth, color = view.read_depth(1), view.read_color(0)
        assert (depth.shape, depth.dtype) == ((480, 640), np.uint16)
        assert (color.shape, color.dtype) == ((480, 640, 3), np.uint8)
        readings = depth[depth != NO_READING]
        assert readings.size > 5000
        assert readings.max() < 1084


def test_every_marker_is_seen_blue_at_its_place(right_session: SimulatedSession) -> None:
    system = right_session.session.manifest.reference_system
    grid = np.linspace(-0.35, 0.35, 5) * MARKER_MM
    a, b = (axis.ravel() for axis in np.meshgrid(grid, grid))
    on_face = {
        "sole": np.stack([a, b, 0 * a], axis=1),
        "achilles": np.stack([a, 0 * a, b], axis=1),
    }
    for view in right_session.session.views:
        color = view.read_color(0).astype(int)
        markers = system.facing(view.sensor.faces)
        assert len(markers) == (12 if view.sensor.faces == ("sole",) else 8)
        for marker in markers:
            points = np.array(marker.position_mm) + on_face[marker.face]
            in_sensor = _points_in_sensor(right_session, view, points)
            u, v = np.round(view.sensor.color_pixels(in_sensor)).astype(int).T
            seen = color[v, u]
            blueness = seen[:, 2] - seen[:, :2].max(axis=1)
            assert (blueness > 40).mean() > 0.9, (view.name, marker.id)


def test_there_are_blue_things_that_are_no_markers(right_session: SimulatedSession) -> None:
    view = right_session.session.views[0]
    color = view.read_color(0).astype(int)
    blue = color[..., 2] - color[..., :2].max(axis=2) > 40
    system = right_session.session.manifest.reference_system
    points = np.array([marker.position_mm for marker in system.markers])
    places = view.sensor.color_pixels(_points_in_sensor(right_session, view, points))
    v, u = np.nonzero(blue)
    distance = np.hypot(u[:, None] - places[:, 0], v[:, None] - places[:, 1]).min(axis=1)

    assert (distance > 20).sum() > 1000


def test_the_measured_surface_lies_on_the_truth(right_session: SimulatedSession) -> None:
    """Raw numbers through calibration and true pose give the true foot, not its mirror image."""
    vertices = right_session.truth.vertices
    for view in right_session.session.views:
        raw = view.read_depth(0).astype(float)
        raw[raw == NO_READING] = np.nan
        points = view.sensor.points(view.sensor.depth_mm(raw)).reshape(-1, 3)
        points = transform(right_session.sensor2reference[view.name], points)
        box = right_session.session.manifest.volume_of_interest
        assert box is not None
        inside = ((points > box.min_mm) & (points < box.max_mm)).all(axis=1)
        sampled = points[inside][::97]
        distance, _ = cKDTree(vertices).query(sampled)
        assert len(sampled) > 40
        assert np.median(distance) < 2.5
        assert np.percentile(distance, 90) < 6.0


@pytest.mark.slow
def test_the_same_seed_gives_the_same_session_in_any_order() -> None:
    options = replace(SMALL, seed=9, frames=2, distance_mm=1200.0)  # few pixels
    first, second = (simulate_session(options) for _ in range(2))

    np.testing.assert_array_equal(first.truth.vertices, second.truth.vertices)
    np.testing.assert_array_equal(first.truth.colors, second.truth.colors)
    for one, other in zip(first.session.views, second.session.views, strict=True):
        later = other.read_depth(1)
        np.testing.assert_array_equal(one.read_depth(0), other.read_depth(0))
        np.testing.assert_array_equal(one.read_depth(1), later)
        np.testing.assert_array_equal(one.read_color(0), other.read_color(0))
        np.testing.assert_array_equal(one.sensor.correction.offset, other.sensor.correction.offset)
        assert not np.array_equal(one.read_depth(0), later)


@pytest.mark.slow
def test_another_seed_another_distance_and_shape(right_session: SimulatedSession) -> None:
    shape = FootShape(length_mm=230)
    simulated = simulate_session(replace(SMALL, seed=1, distance_mm=650, shape=shape, ideal=True))
    cameras = [
        session.session.views[0].sensor.depth_camera for session in (simulated, right_session)
    ]

    assert simulated.foot.shape is shape
    assert right_session.foot.shape.length_mm != shape.length_mm
    assert cameras[0] != cameras[1]
    assert abs(simulated.sensor2reference["left"][2, 3]) == pytest.approx(575, abs=30)


def test_the_reference_system_cannot_be_mistaken_for_itself_turned() -> None:
    """No rotation or mirror image by the axes maps a group of markers onto itself."""
    system = load_reference_system()
    assert [len(system.facing((face,))) for face in ("sole", "achilles")] == [12, 8]
    for face in ("sole", "achilles"):
        points = np.array([marker.position_mm for marker in system.facing((face,))])
        points -= points.mean(axis=0)
        for signs in ((-1, 1, 1), (1, -1, 1), (1, 1, -1), (-1, -1, 1), (-1, 1, -1), (1, -1, -1)):
            distance = np.linalg.norm(points[:, None] - points * signs, axis=2).min(axis=1)
            assert distance.max() > MARKER_MM / 2


@pytest.mark.parametrize(
    ("values", "words"),
    [
        ({"distance_mm": 50.0}, "distance of the sensors .* 50; choose a value from 400 to 1500"),
        ({"distance_mm": float("nan")}, "distance of the sensors"),
        ({"bursts": 0}, "number of places"),
        ({"seed": -1}, "seed"),
        ({"frames": 0}, "number of depth frames"),
        ({"color_size": (320, 240)}, "320 x 240 px .* choose"),
    ],
)
def test_what_cannot_be_simulated_is_refused(values: dict[str, Any], words: str) -> None:
    with pytest.raises(UsageError, match=words):
        SimulationOptions(**values)


def test_a_shape_of_the_other_side_is_refused() -> None:
    with pytest.raises(UsageError, match=r"left.*right foot"):
        SimulationOptions(side=Side.RIGHT, shape=FootShape(side=Side.LEFT))


def test_it_can_be_cancelled_and_reports_progress() -> None:
    seen: list[float] = []
    progress = Progress(lambda fraction, _: seen.append(fraction), lambda: len(seen) == 2)

    with pytest.raises(Cancelled):
        simulate_session(SMALL, progress)
    assert seen == sorted(seen)
    assert seen[0] == 0.0
