"""The service in its process, as the window uses it."""

from __future__ import annotations

import os
import signal
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from capture_samples import NothingStored

from insole_core.geometry.side import Side
from insole_core.messages import Message
from insole_core.recording.reader import read_session
from insole_core.recording.session import Manifest
from insole_studio.acquisition.capture_plan import CapturePlan, make_plan
from insole_studio.acquisition.messages import (
    ALIVE_PERIOD_S,
    Cancel,
    CapturePhase,
    CaptureStatus,
    Command,
    Event,
    Find,
    Identify,
    Placed,
    Preset,
    Sensors,
    Start,
    Tilt,
    Tune,
    Tuning,
)
from insole_studio.acquisition.sensor_source import SensorSource
from insole_studio.acquisition.service_client import SILENCE_LIMIT_S, CaptureService
from tests.patience import wait_for


class Window:
    """Stands in for the window: keeps the news, and waits for what must come."""

    def __init__(self, source: SensorSource, silence_limit_s: float = SILENCE_LIMIT_S) -> None:
        self.service = CaptureService(source, silence_limit_s)
        self.events: list[Event] = []

    def wait_for(self, wanted: Callable[[Event], bool]) -> Event:
        found: list[Event] = []

        def has_come() -> bool:
            news = self.service.news()
            self.events += news
            found.extend(filter(wanted, news))
            return bool(found)

        wait_for(has_come)
        return found[0]

    def wait_for_end(self) -> CaptureStatus:
        event = self.wait_for(lambda e: isinstance(e, CaptureStatus) and e.phase.is_end)
        assert isinstance(event, CaptureStatus)
        return event

    def wait_for_sensors(self) -> Sensors:
        event = self.wait_for(lambda e: isinstance(e, Sensors) and all(s.fps > 0 for s in e.states))
        assert isinstance(event, Sensors)
        return event

    def answer(self, command: Command) -> Message:
        self.service.send(command)
        event = self.wait_for(lambda e: isinstance(e, Message))
        assert isinstance(event, Message)
        return event


@pytest.fixture
def window(small_session: Path) -> Iterator[Window]:
    opened = Window(SensorSource(NothingStored(), small_session))
    yield opened
    opened.service.close()


def order(session: Path, folder: Path, plan: CapturePlan | None = None) -> Start:
    recorded = read_session(session)
    views = [(view.name, view.sensor.serial) for view in recorded.views]
    plan = plan or make_plan(views, frames=2)
    manifest = Manifest(
        "2026-11-20T10:00:00+00:00", Side.LEFT, recorded.manifest.reference_system, ()
    )
    return Start(plan, folder, manifest, plan.views)


def test_live_pictures_then_a_session_then_live_again(
    window: Window, small_session: Path, tmp_path: Path
) -> None:
    sensors = window.wait_for_sensors()
    recorded = read_session(small_session)
    assert [s.serial for s in sensors.states] == [v.sensor.serial for v in recorded.views]
    depth = window.service.picture(sensors.states[1].slot, "depth")
    color = window.service.picture(sensors.states[1].slot, "color")
    assert depth is not None
    assert depth.image.shape == (480, 640)
    assert color is not None
    assert color.image.shape == (512, 640, 3)

    draft = tmp_path / "draft"
    window.service.send(order(small_session, draft))
    ended = window.wait_for_end()
    assert ended.phase is CapturePhase.DONE
    assert all(view.finished for view in ended.views)
    assert read_session(draft).manifest.views == ("left", "right", "top")
    window.wait_for_sensors()

    one = make_plan([("right", recorded.views[1].sensor.serial)], frames=3)
    again = order(small_session, draft, one)
    window.service.send(again)
    assert window.wait_for_end().phase is CapturePhase.DONE
    counts = {view.name: view.depth_count for view in read_session(draft).views}
    assert counts == {"right": 3, "left": 2, "top": 2}


def test_cancel_and_moving_by_hand(window: Window, small_session: Path, tmp_path: Path) -> None:
    window.wait_for_sensors()
    serial = read_session(small_session).views[0].sensor.serial
    plan = make_plan([("left", serial), ("right", serial)], frames=2)
    window.service.send(order(small_session, tmp_path / "a", plan))
    window.wait_for(lambda e: isinstance(e, CaptureStatus) and e.phase is CapturePhase.MOVING)
    window.service.send(Placed())
    assert window.wait_for_end().phase is CapturePhase.DONE

    window.service.send(order(small_session, tmp_path / "b", plan))
    window.wait_for(lambda e: isinstance(e, CaptureStatus) and e.phase is CapturePhase.MOVING)
    window.service.send(Cancel())
    assert window.wait_for_end().phase is CapturePhase.CANCELLED
    assert read_session(tmp_path / "b").manifest.views == ("left",)


def test_tilt_and_light(window: Window, small_session: Path) -> None:
    serial = window.wait_for_sensors().states[0].serial
    for command in (Tilt(serial, 2.0), Tilt(serial, None), Identify(serial, True)):
        window.service.send(command)
    told = window.answer(Tilt("Z9", 1.0))
    assert told == "Sensor Z9 is not in use; look for sensors again."
    assert told.template == "Sensor {serial} is not in use; look for sensors again."
    assert not [e for e in window.events[:-1] if isinstance(e, Message) and "Z9" not in e]
    for tuning, lack in (
        (Tuning(preset=Preset.HIGH_DENSITY), "judges its depth in one way only"),
        (Tuning(laser_mw=90.0), "has a projector of one power only"),
    ):
        assert f"Sensor {serial} {lack}" in window.answer(Tune(serial, tuning))


def test_closing_in_mid_capture_keeps_what_is_there(
    window: Window, small_session: Path, tmp_path: Path
) -> None:
    window.wait_for_sensors()
    draft = tmp_path / "draft"
    window.service.send(order(small_session, draft))
    window.wait_for(
        lambda e: isinstance(e, CaptureStatus) and any(view.finished for view in e.views)
    )
    window.service.close()
    assert read_session(draft).manifest.views[0] == "left"
    assert [path.name for path in draft.glob(".*")] == []


def test_a_session_that_cannot_be_read_is_told(tmp_path: Path) -> None:
    window = Window(SensorSource(NothingStored(), tmp_path))
    event = window.wait_for(lambda e: isinstance(e, Sensors) and e.problem is not None)
    assert isinstance(event, Sensors)
    assert "holds no manifest.json" in str(event.problem)
    window.service.close()


def test_a_service_that_died_is_told(window: Window) -> None:
    window.wait_for_sensors()
    window.service._process.kill()
    event = window.wait_for(lambda e: isinstance(e, Sensors) and e.problem is not None)
    assert "has ended" in str(event)


@pytest.mark.slow
def test_a_service_that_hangs_in_mid_capture_is_stopped_and_told(
    small_session: Path, tmp_path: Path
) -> None:
    window = Window(SensorSource(NothingStored(), small_session), silence_limit_s=3.0)
    window.wait_for_sensors()
    draft = tmp_path / "draft"
    window.service.send(order(small_session, draft, _long_plan(small_session)))
    window.wait_for(
        lambda e: isinstance(e, CaptureStatus) and any(view.finished for view in e.views)
    )
    os.kill(window.service._process.pid, signal.SIGSTOP)
    ended = window.wait_for_end()
    assert ended.phase is CapturePhase.FAILED
    assert "has not answered for 3 s and was stopped; complete views are kept" in ended.sentence
    assert read_session(draft).manifest.views == ("left",)

    window.service.send(Find())
    window.wait_for_sensors()
    window.service.close()


@pytest.mark.slow
def test_a_service_that_waits_for_the_user_does_not_hang(
    small_session: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    signs_of_life, hangs = [], CaptureService._hangs

    def noting(service: CaptureService, has_sent: bool) -> bool:
        signs_of_life.extend([has_sent] if has_sent else [])
        return hangs(service, has_sent)

    monkeypatch.setattr(CaptureService, "_hangs", noting)
    limit_s = 3 * ALIVE_PERIOD_S
    window = Window(SensorSource(NothingStored(), small_session), silence_limit_s=limit_s)
    window.wait_for_sensors()
    serial = read_session(small_session).views[0].sensor.serial
    plan = make_plan([("left", serial), ("right", serial)], frames=2)
    window.service.send(order(small_session, tmp_path / "a", plan))
    window.wait_for(lambda e: isinstance(e, CaptureStatus) and e.phase is CapturePhase.MOVING)
    signs_of_life.clear()
    news: list[Event] = []

    def has_waited_for_longer_than_the_limit() -> bool:
        news.extend(window.service.news())
        return bool(news) or len(signs_of_life) > 4

    wait_for(has_waited_for_longer_than_the_limit)
    assert news == []
    window.service.send(Placed())
    assert window.wait_for_end().phase is CapturePhase.DONE
    window.service.close()


def _long_plan(session: Path) -> CapturePlan:
    """A plan of which there is time to interrupt the second view."""
    views = [(view.name, view.sensor.serial) for view in read_session(session).views]
    return make_plan(views, frames=60)
