"""Live images of the sensor being calibrated, and capturing them."""

from __future__ import annotations

import tempfile
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from datetime import UTC, datetime
from pathlib import Path

import cv2
import numpy as np

from insole_core.calibration.boards.board import Board, count_corners
from insole_core.calibration.walls.captures import capture_from_glance
from insole_core.errors import CalibrationError
from insole_core.geometry.arrays import ByteArray, FloatArray, RawArray
from insole_core.geometry.side import Side
from insole_core.messages import Message
from insole_core.progress import Progress
from insole_core.recording.reader import read_session
from insole_core.recording.session import Manifest, ReferenceSystem
from insole_core.sensing.sensor import Sensor
from insole_core.workflows.calibration.infrared_steps import DOTS_DISTANCES_MM
from insole_core.workflows.calibration.picture_folders import LiveKind, keep_infrared, keep_view
from insole_core.workflows.calibration.picture_overlay import draw_distances, draw_missing_cells
from insole_core.workflows.calibration.picture_readiness import (
    Readiness,
    look_at_board,
    look_at_wall,
    small,
    wall_distance_mm,
    wall_distances_mm,
)
from insole_studio.acquisition.capture_plan import make_plan
from insole_studio.acquisition.guidance import depth_colors
from insole_studio.acquisition.messages import (
    Capability,
    CapturePhase,
    CaptureStatus,
    Infrared,
    Sensors,
    SensorState,
    Start,
)
from insole_studio.acquisition.sensor_port import lack_of
from insole_studio.acquisition.service_client import CaptureService
from insole_studio.acquisition.shared_frame_buffer import Kind, Picture
from insole_studio.texts import tr

_LOOK_PERIOD_S = 0.4
_STEADY_SHARE, _NEW_SHARE = 0.004, 0.06
"""In image widths: a board that moved less is steady, one that moved more is in a new pose."""
_STEADY_MM, _NEW_MM = 4.0, 45.0
_VIEW, _FRAMES = "calibration", 10
_SHOWN: dict[LiveKind, Kind] = {
    "boards": "color",
    "walls": "depth",
    "infrared": "infrared",
    "dots": "depth",
}
_KINDS: tuple[Kind, ...] = tuple(dict.fromkeys(_SHOWN.values()))


@dataclass(frozen=True, eq=False)
class LiveInspection:
    """The inspection of one live image.

    Parameters
    ----------
    picture : (height, width, 3) uint8, RGB
        The image with what was detected, and what is still missing, drawn over it.
    sentence
        The finding, translated.
    place : (n,) float64
        Board corners in image widths, or wall distance in mm; None if nothing was found.
    """

    picture: ByteArray
    sentence: str
    place: FloatArray | None = None


class LivePictures:
    """Streams one sensor from the capture service; independent of widgets.

    Parameters
    ----------
    make_service
        Starts the capture service.
    system
        Reference system, for the manifest of captured sessions.
    """

    def __init__(self, make_service: Callable[[], CaptureService], system: ReferenceSystem) -> None:
        self._make_service, self._system = make_service, system
        self._service: CaptureService | None = None
        self._draft: tempfile.TemporaryDirectory[str] | None = None
        self._numbers: dict[Kind, int] = {}
        self._newest: dict[Kind, Picture] = {}
        self._of = ""
        """Serial number of the sensor that the pictures are of."""
        self._in_infrared = ""
        self._looked_s = 0.0
        self._places: list[FloatArray] = []
        self._before: FloatArray | None = None
        self.states: tuple[SensorState, ...] = ()
        self.problem = ""

    @property
    def running(self) -> bool:
        """Whether the sensors are in use."""
        return self._service is not None

    @property
    def taking(self) -> bool:
        """Whether a capture is running."""
        return self._draft is not None

    def is_connected(self, serial: str) -> bool:
        """Whether a sensor is there to take pictures with."""
        return self._state(serial) is not None

    def start(self) -> None:
        """Start the sensors."""
        if self._service is None:
            self._service = self._make_service()
            self.problem = tr("Looking for sensors…")

    def stop(self) -> None:
        """Stop the sensors."""
        if self._service is not None:
            self._service.close()
        self._service, self.states, self.problem = None, (), ""
        self._numbers, self._newest, self._of, self._in_infrared = {}, {}, "", ""
        self.end_taking()

    def forget_places(self) -> None:
        """Forget the captured poses, because another step begins."""
        self._places, self._before = [], None

    def poll(self, serial: str, kind: LiveKind) -> Path | None:
        """Fetch events and the newest images of a sensor.

        Parameters
        ----------
        serial
            Serial number of the sensor.
        kind
            Kind of live inspection.

        Returns
        -------
        Path or None
            Session folder of a capture that has just completed, for `keep_task`.
        """
        if self._service is None:
            return None
        if serial != self._of:  # the pictures of one sensor are never kept as those of another
            self._of = serial
            self._numbers.clear()
            self._newest.clear()
            self.problem = "" if self.states else self.problem
        done = None
        for event in self._service.news():
            if isinstance(event, Sensors):
                self.states = event.states
                # What is wrong with others does not concern a sensor that is there.
                self.problem = (event.problem or "") if self._state(serial) is None else ""
            elif isinstance(event, Message):
                self.problem = event
            elif isinstance(event, CaptureStatus) and event.phase.is_end and self._draft:
                if event.phase is CapturePhase.DONE:
                    done = Path(self._draft.name) / "session"
                else:
                    self.problem = event.sentence
                    self.end_taking()
        self._look_at(serial, kind)
        return done

    def _look_at(self, serial: str, kind: LiveKind) -> None:
        """Fetch the newest images of a sensor, and what is wrong with it."""
        state = self._state(serial)
        self._watch_infrared(serial if state is not None and kind == "infrared" else "")
        if state is None:
            self._newest.clear()
            if serial and self.states:
                self.problem = tr("Sensor {serial} is not connected.").format(serial=serial)
        else:
            for shown in _KINDS:
                self._take_newest(state.slot, shown)
            asked = kind in ("infrared", "dots")
            lack = lack_of(state, Capability.INFRARED) if asked else None
            self.problem = state.problem or lack or self.problem

    def glance_task(
        self, kind: LiveKind, sensor: Sensor, board: Board, known: Readiness | None
    ) -> Callable[[Progress], LiveInspection] | None:
        """Return a job that inspects the newest image; None if there is none or it is too early.

        Parameters
        ----------
        kind
            Kind of live inspection.
        sensor
            The sensor as calibrated so far.
        board
            The board in use.
        known
            What the images taken so far cover.
        """
        now = time.monotonic()
        newest = self._newest.get(_SHOWN[kind])
        if newest is None or now - self._looked_s < _LOOK_PERIOD_S:
            return None
        self._looked_s = now
        image = newest.image
        if kind == "boards":
            return lambda _progress: glance_at_board(image, board, known)
        if kind == "infrared":
            gray = cv2.cvtColor(image, cv2.COLOR_GRAY2RGB)
            return lambda _progress: glance_at_board(np.asarray(gray), board, known)
        wanted_mm = DOTS_DISTANCES_MM if kind == "dots" else wall_distances_mm(sensor.family)
        return lambda _progress: glance_at_wall(image, sensor, known, wanted_mm)

    def is_worth_taking(self, glance: LiveInspection) -> bool:
        """Return whether the board or wall is steady in a pose not captured yet."""
        place, before = glance.place, self._before
        self._before = place
        if place is None or before is None or self.taking:
            return False
        steady, new = (_STEADY_MM, _NEW_MM) if len(place) == 1 else (_STEADY_SHARE, _NEW_SHARE)
        if _apart(place, before) > steady:
            return False
        return all(_apart(place, taken) > new for taken in self._places)

    def take_infrared(self, folder: Path) -> Callable[[Progress], Path] | None:
        """Return a job that saves the newest infrared image to a folder; None without an image."""
        newest = self._newest.get("infrared")
        if newest is None:
            return None
        self._remember_place()
        image = newest.image

        def keep(progress: Progress) -> Path:
            progress.step(0.0, tr("Keeping the picture"))
            keep_infrared(image, folder)
            return folder

        return keep

    def take(self, serial: str, kind: LiveKind) -> None:
        """Order the service to record the current view of the sensor, of dots with infrared."""
        if self._service is None or self._draft is not None:
            return
        self._remember_place()
        self._draft = tempfile.TemporaryDirectory(prefix="calibration-")
        manifest = Manifest(
            recorded_at=datetime.now(UTC).isoformat(timespec="seconds"),
            side=Side.LEFT,
            reference_system=self._system,
            views=(),
        )
        plan = make_plan(((_VIEW, serial),), frames=_FRAMES)
        plan = replace(plan, infrared=kind == "dots")
        folder = Path(self._draft.name) / "session"
        self._service.send(Start(plan, folder, manifest, plan.views))

    def keep_task(self, taken: Path, folder: Path, kind: LiveKind) -> Callable[[Progress], Path]:
        """Return a job that copies a captured session into a folder.

        Parameters
        ----------
        taken
            Session folder from `poll`.
        folder
            Folder of the step's images.
        kind
            Kind of live inspection, which decides which images are kept.
        """

        def keep(progress: Progress) -> Path:
            progress.step(0.0, tr("Keeping the picture"))
            (view,) = read_session(taken).views
            keep_view(view, folder, kind)
            return folder

        return keep

    def end_taking(self) -> None:
        """Delete the temporary files of the last capture."""
        if self._draft is not None:
            self._draft.cleanup()
        self._draft = None

    def _remember_place(self) -> None:
        if self._before is not None:
            self._places.append(self._before)

    def _watch_infrared(self, serial: str) -> None:
        """Stream infrared images from this sensor only; from none if the serial is empty."""
        if self._service is None or serial == self._in_infrared:
            return
        if self.is_connected(self._in_infrared):
            self._service.send(Infrared(self._in_infrared, on=False))
        if serial:
            self._service.send(Infrared(serial, on=True))
        self._in_infrared = serial
        self._newest.clear()

    def _state(self, serial: str) -> SensorState | None:
        return next((state for state in self.states if state.serial == serial), None)

    def _take_newest(self, slot: int, kind: Kind) -> None:
        assert self._service is not None
        found = self._service.picture(slot, kind, self._numbers.get(kind, 0))
        if found is not None:
            self._numbers[kind], self._newest[kind] = found.number, found


def glance_at_board(color: ByteArray, board: Board, known: Readiness | None) -> LiveInspection:
    """Detect the board in a colour image, and mark the areas not yet covered.

    Parameters
    ----------
    color : (height, width, 3) uint8, RGB
        The live image.
    board
        The board in use.
    known
        What the images taken so far cover.
    """
    grey = np.asarray(cv2.cvtColor(color, cv2.COLOR_RGB2GRAY))
    look, sighting = look_at_board(tr("The live picture"), grey, board, color)
    sightings = [sighting] if sighting is not None else []
    cells = count_corners(sightings) + (known.cells if known is not None else 0)
    place = sighting.pixels.ravel() / color.shape[1] if sighting is not None else None
    return LiveInspection(draw_missing_cells(look.picture, cells), look.sentence, place)


def glance_at_wall(
    raw: RawArray,
    sensor: Sensor,
    known: Readiness | None,
    wanted_mm: Sequence[int],
) -> LiveInspection:
    """Detect the wall in a raw depth image, and mark the distances not yet covered.

    Parameters
    ----------
    raw
        The raw depth image.
    sensor
        The sensor as calibrated so far.
    known
        What the images taken so far cover.
    wanted_mm
        All distances at which walls are captured.
    """
    distances = known.distances_mm if known is not None else ()
    name = tr("The live picture")
    colored = small(depth_colors(sensor.disparity)[raw])
    try:
        look, wall = look_at_wall(capture_from_glance(name, raw), sensor)
    except CalibrationError as error:
        return LiveInspection(draw_distances(colored, wanted_mm, distances, None), str(error))
    if wall is None:
        return LiveInspection(draw_distances(colored, wanted_mm, distances, None), look.sentence)
    now_mm = wall_distance_mm(wall)
    picture = draw_distances(look.picture, wanted_mm, distances, now_mm)
    if known is not None:
        upper = draw_missing_cells(look.picture, known.cells)
        picture = draw_distances(upper, wanted_mm, distances, now_mm)
    return LiveInspection(picture, look.sentence, np.array([now_mm]))


def _apart(a: FloatArray, b: FloatArray) -> float:
    return float(np.abs(a - b).mean()) if a.shape == b.shape else float("inf")
