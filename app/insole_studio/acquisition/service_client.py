"""The window's client of the capture service."""

from __future__ import annotations

import multiprocessing
from contextlib import suppress
from dataclasses import replace

from insole_core.messages import Message
from insole_studio.acquisition.capture_service import serve
from insole_studio.acquisition.capture_status import CapturePhase, CaptureStatus
from insole_studio.acquisition.messages import Command, Event, Find, Quit, Sensors, Start
from insole_studio.acquisition.sensor_source import SensorSource
from insole_studio.acquisition.shared_frame_buffer import Kind, Picture, SharedFrameBuffer

_PATIENCE_S = 5.0


class CaptureService:
    """Starts the service, sends it commands, and receives its events and the newest pictures.

    Parameters
    ----------
    source
        Provides the sensors; used in the service's process.
    """

    def __init__(self, source: SensorSource) -> None:
        # Not forked: forking a program with threads and a window is not safe.
        self._context = multiprocessing.get_context("spawn")
        self._board = SharedFrameBuffer(self._context)
        self._source = source
        self._closed = False
        self._start()

    def _start(self) -> None:
        self._connection, theirs = self._context.Pipe()
        self._process = self._context.Process(
            target=serve,
            args=(theirs, self._board, replace(self._source)),
            name="capture-service",
            daemon=True,
        )
        self._process.start()
        theirs.close()
        self._ended = False
        self._capture: CaptureStatus | None = None

    def send(self, command: Command) -> None:
        """Send a command; if the service has ended, `Find` starts it again.

        Others do nothing then: `news` says that it has ended.
        """
        if self._ended and isinstance(command, Find) and not self._closed:
            self._reap()
            self._start()
        if self._ended:
            return
        if isinstance(command, Start):
            self._capture = CaptureStatus(CapturePhase.SETTLING)
        with suppress(OSError):  # it has ended, which `news` finds as well
            self._connection.send(command)

    def news(self) -> list[Event]:
        """Return the events since the last call, without waiting.

        A capture ends with a status in any case, also if the service has died.
        """
        events: list[Event] = []
        if self._ended:
            return events
        try:
            while self._connection.poll():
                events.append(self._connection.recv())
        except (EOFError, OSError):
            self._ended = True
        for event in events:
            if isinstance(event, CaptureStatus):
                self._capture = None if event.phase.is_end else event
        return events + self._last_news(events) if self._ended else events

    def _last_news(self, events: list[Event]) -> list[Event]:
        """Return what a service that has died can no longer say."""
        ended = Message("The program that reads the sensors has ended; look for sensors again.")
        last: list[Event] = []
        if self._capture is not None:
            last.append(CaptureStatus(CapturePhase.FAILED, self._capture.views, ended))
        if not any(isinstance(event, Sensors) and event.problem for event in events):
            last.append(Sensors((), ended))
        return last

    def picture(self, slot: int, kind: Kind, after: int = 0) -> Picture | None:
        """Return the newest picture of a sensor if its number is larger than `after`.

        Parameters
        ----------
        slot
            Index of the sensor in the shared frame buffer.
        after
            Number of the last picture that was seen.
        """
        return self._board.read(slot, kind, after)

    def close(self) -> None:
        """End the service, which first switches every emitter off; a second call does nothing."""
        if self._closed:
            return
        self._closed = True
        self.send(Quit())
        self._reap()
        self._ended = True

    def _reap(self) -> None:
        self._process.join(_PATIENCE_S)
        if self._process.is_alive():
            self._process.kill()
            self._process.join()
        self._connection.close()
        self._process.close()
