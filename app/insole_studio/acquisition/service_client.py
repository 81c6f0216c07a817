"""The window's client of the capture service."""

from __future__ import annotations

import multiprocessing
from dataclasses import replace

from insole_studio.acquisition.capture_service import serve
from insole_studio.acquisition.messages import Command, Event, Quit, Sensors
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
        context = multiprocessing.get_context("spawn")
        self._connection, theirs = context.Pipe()
        self._board = SharedFrameBuffer(context)
        self._process = context.Process(
            target=serve,
            args=(theirs, self._board, replace(source)),
            name="capture-service",
            daemon=True,
        )
        self._process.start()
        theirs.close()
        self._ended = self._closed = False

    def send(self, command: Command) -> None:
        """Send a command; does nothing if the service has ended."""
        if not self._ended:
            try:
                self._connection.send(command)
            except OSError:
                self._ended = True

    def news(self) -> list[Event]:
        """Return the events since the last call, without waiting."""
        events: list[Event] = []
        try:
            while not self._ended and self._connection.poll():
                events.append(self._connection.recv())
        except (EOFError, OSError):
            self._ended = True
            if not any(isinstance(event, Sensors) and event.problem for event in events):
                events.append(
                    Sensors((), "The program that reads the sensors has ended; start it again.")
                )
        return events

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
        self._process.join(_PATIENCE_S)
        if self._process.is_alive():
            self._process.kill()
            self._process.join()
        self._connection.close()
        self._process.close()
        self._ended = True
