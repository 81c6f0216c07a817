"""The warm-up of a sensor goes on after a restart of the program, while it keeps its power."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from types import SimpleNamespace

import pytest
from capture_samples import Bench

from insole_studio.acquisition import live_sensors, warm_up
from insole_studio.acquisition.kinect_sensors import KinectPort
from insole_studio.acquisition.live_sensors import LiveSensors
from insole_studio.acquisition.messages import WARM_UP_S
from insole_studio.acquisition.rig import Rig
from insole_studio.acquisition.warm_up import WarmUps
from kinect_v1.usb_bus import UsbBus

PLACE = (2, 7)
NOW_S = 10_000.0
"""After the start of the computer, which may have been minutes ago."""


@pytest.fixture(autouse=True)
def _standing_clock(monkeypatch: pytest.MonkeyPatch) -> None:
    clock = SimpleNamespace(monotonic=lambda: NOW_S, time=lambda: 1.7e9 + NOW_S)
    for module in (warm_up, live_sensors):
        monkeypatch.setattr(module, "time", clock)


@pytest.fixture
def file(tmp_path: Path) -> Path:
    return tmp_path / "sensors" / "warm_up.json"


def on_for_s(file: Path, serial: str = "A1", place: tuple[int, int] = PLACE) -> float:
    """How long a sensor that is opened now has been on, as a new process finds it."""
    return NOW_S - WarmUps(file).since_s(serial, place)


def age(file: Path, key: str, by_s: float) -> None:
    content = json.loads(file.read_text())
    content["sensors"]["A1"][key] -= by_s
    file.write_text(json.dumps(content))


def test_it_goes_on_where_it_stopped(file: Path) -> None:
    assert on_for_s(file) == 0
    WarmUps(file).keep("A1", PLACE, NOW_S - 600)
    assert on_for_s(file) == 600
    assert on_for_s(file, serial="B2") == 0


def test_a_pause_does_not_warm_and_a_long_one_cools(file: Path) -> None:
    WarmUps(file).keep("A1", PLACE, NOW_S - 600)
    age(file, "seen_s", 240)
    assert on_for_s(file) == 360
    age(file, "since_s", WARM_UP_S)
    age(file, "seen_s", WARM_UP_S)
    assert on_for_s(file) == 0


def test_it_begins_anew_after_a_loss_of_power_and_a_restart_of_the_computer(file: Path) -> None:
    WarmUps(file).keep("A1", PLACE, NOW_S - 600)
    assert on_for_s(file, place=(2, 8)) == 0
    age(file, "booted_s", 3600)
    assert on_for_s(file) == 0


@pytest.mark.parametrize(
    "content", ["", "[]", "{}", '{"sensors": {"A1": {"bus": 2}}}', '{"sensors": {"A1": 3}}']
)
def test_a_damaged_file_is_written_anew(file: Path, content: str) -> None:
    file.parent.mkdir()
    file.write_text(content)
    assert on_for_s(file) == 0
    WarmUps(file).keep("A1", PLACE, NOW_S - 600)
    assert on_for_s(file) == 600


def test_a_place_that_cannot_be_written_only_begins_anew(tmp_path: Path) -> None:
    (tmp_path / "sensors").write_text("in the way")
    warm_ups = WarmUps(tmp_path / "sensors" / "warm_up.json")
    warm_ups.keep("A1", PLACE, NOW_S - 600)
    assert warm_ups.since_s("A1", PLACE) == NOW_S


def test_live_sensors_tell_it_until_one_is_unplugged(
    make: Callable[..., Bench], file: Path
) -> None:
    bench = make()

    def on_s() -> dict[str, float]:
        """What a window that is opened and closed says of each sensor."""
        live = LiveSensors(
            Rig(KinectPort(UsbBus(bench.emulated), WarmUps(file))), lambda _slot, _image: None
        )
        live.find()
        found = {state.serial: state.warm_s for state in live.summary.states}
        for sensor in live.opened.values():
            sensor.on_since_s -= 300
        live.keep_warm_ups()  # as the service does meanwhile, in case it is killed
        live.close()
        return found

    assert max(on_s().values()) == 0
    assert min(on_s().values()) == 300
    bench.emulated.unplug(bench.kinects["B2"])
    bench.emulated.plug(bench.kinects["B2"], 5)
    found = on_s()
    assert found.pop("B2") == 0
    assert min(found.values()) == 600
