"""Infrared pictures of simulated Kinects: what they show, and what spoils them."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from insole_core.calibration.infrared.infrared_walls import read_infrared_walls
from insole_core.errors import UsageError
from insole_core.geometry.arrays import FloatArray
from insole_core.recording.sensor_folder import read_sensor
from insole_core.sensing.disparity import NO_READING
from insole_core.simulate import SimulatedSession, SimulationOptions, simulate_session
from insole_core.simulate.device import Device
from insole_core.simulate.dot_pattern import DotPattern
from insole_core.simulate.infrared_walls import (
    check_wall_count,
    with_patterns,
    write_walls,
)
from insole_core.simulate.scene import Hits
from insole_core.simulate.simulation import devices_of, dots_of
from insole_core.simulate.surroundings import Surroundings

OPTIONS = SimulationOptions(
    seed=4, frames=1, color_size=(640, 480), foot_cell_mm=6.0, infrared_frames=2
)


@pytest.fixture(scope="module")
def device() -> Device:
    device = devices_of(OPTIONS)["left"]
    assert isinstance(device, Device)
    return device


@pytest.fixture(scope="module")
def written(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """One wall before every sensor."""
    folder = tmp_path_factory.mktemp("written") / "walls"
    write_walls(OPTIONS, 1, folder)
    return folder


@pytest.fixture(scope="module")
def simulated() -> SimulatedSession:
    return simulate_session(OPTIONS)


@pytest.fixture(scope="module")
def dots(device: Device) -> FloatArray:
    return DotPattern.draw(dots_of(device)).seen()


def likeness(picture: FloatArray, raw: FloatArray, dots: FloatArray) -> float:
    """Correlation of a picture with a device's dots at some raw numbers, NaN = not known."""
    v, u = np.nonzero(np.isfinite(raw))
    across = np.rint(u * 8 + raw[v, u]).astype(int)
    return float(np.corrcoef(picture[v, u], dots[v, across])[0, 1])


def known(depth: np.ndarray) -> FloatArray:
    return np.where(depth < NO_READING, depth, np.nan)


def test_a_wall_shows_the_dots_where_its_depth_says(
    written: Path, device: Device, dots: FloatArray
) -> None:
    (wall,) = read_infrared_walls(written / device.sensor.serial, device.sensor.serial)
    picture = wall.brightness.astype(float)

    assert np.isfinite(wall.depth.raw).mean() > 0.9
    assert likeness(picture, wall.depth.raw, dots) > 0.8
    assert likeness(picture, wall.depth.raw + 24, dots) < 0.2


def test_every_sensor_has_walls_with_its_calibration(written: Path) -> None:
    for device in devices_of(OPTIONS).values():
        folder = written / device.sensor.serial
        names = sorted(path.name for path in folder.iterdir())
        assert names == ["correction.npz", "depth_00.png", "infrared_00.png", "sensor.json"]
        assert read_sensor(folder).serial == device.sensor.serial


def test_a_foot_shows_the_dots_of_the_walls(simulated: SimulatedSession, dots: FloatArray) -> None:
    view = simulated.session.views[0]
    assert view.dots is not None
    assert view.dots.pictures is not None
    first, second = (view.dots.pictures.read(index) for index in range(2))

    assert view.dots.pictures.count == 2
    assert not np.array_equal(first, second)
    assert likeness(first.astype(float), known(view.read_depth(0)), dots) > 0.6


def _hits(points: list[list[float]]) -> Hits:
    count = len(points)
    normals = np.tile([0.0, 0.0, -1.0], (count, 1))
    return Hits(np.arange(count), np.ones(count), np.array(points), normals, np.zeros((count, 3)))


SENSOR = np.array([0.0, 0.0, -700.0])


def test_the_sun_shines_on_one_half() -> None:
    seen = Surroundings(sunlight=2.0).seen(
        _hits([[-20, 0, 0], [20, 0, 0]]), np.array([0.5, 0.5]), SENSOR, SENSOR
    )

    assert seen[0] == 0.5
    assert seen[1] > 1.5


def test_a_nail_shines_where_it_faces_the_sensor_and_is_darker_beside() -> None:
    points = _hits([[0, 0, 0], [0, 130, 0], [600, 130, 0]])
    seen = Surroundings(nail_y_mm=125.0).seen(points, np.ones(3), SENSOR, SENSOR)

    assert seen[0] == 1.0
    assert seen[1] > 2
    assert seen[2] < 1


def test_hairs_darken_the_leg_only() -> None:
    spots = np.linspace(0, 30, 500)
    leg = _hits([[spot, -100, 90] for spot in spots])
    sole = _hits([[spot, -100, 5] for spot in spots])
    light = np.ones(len(spots))
    hairy = Surroundings(hairy=True)

    assert 0.03 < (hairy.seen(leg, light, SENSOR, SENSOR) < 1).mean() < 0.3
    np.testing.assert_array_equal(hairy.seen(sole, light, SENSOR, SENSOR), light)


def test_a_pattern_that_drifts_shows_its_dots_elsewhere() -> None:
    dots = DotPattern.draw(np.random.default_rng(1), slice(0, 8))
    u, v, raw = np.arange(60.0), np.full(60, 4.0), np.full(60, 700.0)

    np.testing.assert_allclose(
        replace(dots, drift_raw=0.8).brightness(u, v, raw), dots.brightness(u, v, raw + 0.8)
    )


@pytest.mark.parametrize("other", [{"ideal": True}, {"sensor": "d415"}])
def test_other_sensors_have_no_pictures_of_dots(other: dict[str, object]) -> None:
    with pytest.raises(UsageError, match="Infrared pictures of dots are those of Kinects"):
        SimulationOptions(infrared_frames=1, **other)


def test_a_number_of_walls_that_cannot_be_is_refused(simulated: SimulatedSession) -> None:
    for count in (0, 31):
        with pytest.raises(UsageError, match="give 1 to 30"):
            check_wall_count(count)
    with pytest.raises(UsageError, match="The number of walls is 0"):
        with_patterns(simulated.session, OPTIONS, 0)
