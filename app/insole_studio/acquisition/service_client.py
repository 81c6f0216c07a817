"""The window's client of the capture service."""

from __future__ import annotations

import multiprocessing
import time
from contextlib import suppress
from dataclasses import replace

from insole_core.messages import Message
from insole_studio.acquisition.capture_service import serve
from insole_studio.acquisition.messages import (
    Alive,
    CapturePhase,
    CaptureStatus,
    Command,
    Event,
    Find,
    Quit,
    Sensors,
    Start,
)
from insole_studio.acquisition.sensor_source import SensorSource
from insole_studio.acquisition.shared_frame_buffer import Kind, Picture, SharedFrameBuffer

SILENCE_LIMIT_S = 30.0
"""How long the service may give no sign of life. Tilting several sensors back takes up to 20 s."""
START_LIMIT_S = 60.0
"""The same before its first word: it imports much, and opens every sensor."""
_LONGEST_PAUSE_S = 1.0
_PATIENCE_S = 5.0


class CaptureService:
    """Starts the service, sends it commands, and receives its events and the newest pictures.

    Parameters
    ----------
    source
        Provides the sensors; used in the service's process.
    silence_limit_s
        How long the service may give no sign of life before it is stopped.
    """

    def __init__(self, source: SensorSource, silence_limit_s: float = SILENCE_LIMIT_S) -> None:
        # Not forked: forking a program with threads and a window is not safe.
        self._context = multiprocessing.get_context("spawn")
        self._board = SharedFrameBuffer(self._context)
        self._source = source
        self._silence_limit_s = silence_limit_s
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
        self._has_spoken = False
        self._silent_s = 0.0
        self._looked_s = time.monotonic()

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

        A capture ends with a status in any case, also if the service has died, or hangs and is
        stopped.
        """
        if self._ended:
            return []
        problem: Message | None = None
        received: list[Event | Alive] = []
        try:
            while self._connection.poll():
                received.append(self._connection.recv())
        except (EOFError, OSError):
            problem = Message(
                "The program that reads the sensors has ended; look for sensors again."
            )
        if problem is None and self._hangs(bool(received)):
            self._process.kill()  # what it might still write would get into the next capture
            problem = Message(
                "The program that reads the sensors has not answered for {seconds:.0f} s and was "
                "stopped; complete views are kept. Look for sensors again.",
                seconds=self._silent_s,
            )
        events = [event for event in received if not isinstance(event, Alive)]
        self._follow_capture(events)
        if problem is None:
            return events
        self._ended = True
        return events + self._last_news(events, problem)

    def _follow_capture(self, events: list[Event]) -> None:
        for event in events:
            if isinstance(event, CaptureStatus):
                self._capture = None if event.phase.is_end else event

    def _hangs(self, has_sent: bool) -> bool:
        """Return whether the service has given no sign of life for too long.

        A pause of the window itself, or of the whole computer, does not count.
        """
        now_s = time.monotonic()
        pause_s = min(now_s - self._looked_s, _LONGEST_PAUSE_S)
        self._looked_s = now_s
        self._silent_s = 0.0 if has_sent else self._silent_s + pause_s
        self._has_spoken |= has_sent
        limit_s = self._silence_limit_s if self._has_spoken else START_LIMIT_S
        return self._silent_s > limit_s

    def _last_news(self, events: list[Event], problem: Message) -> list[Event]:
        """Return what a service that has ended can no longer say."""
        last: list[Event] = []
        if self._capture is not None:
            last.append(CaptureStatus(CapturePhase.FAILED, self._capture.views, problem))
        if not any(isinstance(event, Sensors) and event.problem for event in events):
            last.append(Sensors((), problem))
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
