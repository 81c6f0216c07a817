"""Whether a busy application costs frames: the capture service beside a CPU-bound Python thread.

Three emulated sensors stream depth and colour in the service's process. In this process, which
stands for the application, either nothing runs or a thread that never releases the interpreter
lock. Limit: no frame discarded, and the frame rate of the idle application.
"""

from __future__ import annotations

import tempfile
import threading
import time
from pathlib import Path

from benchmarks._measure import print_table, recorded_session
from insole_core.sensing.infrared_reference import InfraredReference
from insole_core.sensing.sensor import Sensor
from insole_studio.acquisition.messages import Sensors, SensorState
from insole_studio.acquisition.sensor_source import SensorSource
from insole_studio.acquisition.service_client import CaptureService

SECONDS = 6.0
START_S = 30.0


class NothingStored:
    def load(self, _serial: str) -> Sensor | None:
        return None

    def reference(self, _serial: str) -> InfraredReference | None:
        return None


def watch(service: CaptureService, seconds: float) -> tuple[SensorState, ...]:
    """Follow the service for a while; return the last reported state of the sensors."""
    end = time.monotonic() + seconds
    states: tuple[SensorState, ...] = ()
    while time.monotonic() < end:
        for event in service.news():
            if isinstance(event, Sensors):
                states = event.states
        for state in states:
            service.picture(state.slot, "depth")
        time.sleep(0.02)
    return states


def wait_for_sensors(service: CaptureService) -> None:
    end = time.monotonic() + START_S
    while time.monotonic() < end:
        states = watch(service, 0.5)
        if states and all(state.fps > 0 for state in states):
            return
    raise RuntimeError("the emulated sensors did not start")


def row(name: str, service: CaptureService) -> tuple[str, ...]:
    before = {state.serial: state.discarded for state in watch(service, 1.0)}
    states = watch(service, SECONDS)
    lost = sum(state.discarded - before[state.serial] for state in states)
    slowest = min(state.fps for state in states)
    return name, f"{slowest:.1f}", str(lost), "kept" if lost == 0 else "BROKEN"


def main() -> None:
    stop = threading.Event()

    def spin() -> None:
        number = 0
        while not stop.is_set():
            number = (number + 1) % 1_000_003

    with tempfile.TemporaryDirectory() as folder:
        service = CaptureService(SensorSource(NothingStored(), recorded_session(Path(folder))))
        try:
            wait_for_sensors(service)
            rows = [row("idle", service)]
            busy = threading.Thread(target=spin)
            busy.start()
            rows.append(row("a CPU-bound Python thread", service))
            stop.set()
            busy.join()
        finally:
            service.close()
    print_table(("the application", "slowest frames/s", "frames lost", "limit 0"), rows)


if __name__ == "__main__":
    main()
