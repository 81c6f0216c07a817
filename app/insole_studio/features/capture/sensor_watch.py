"""The state of one sensor in the capture stage: its newest images, and hints for setting it up."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import replace
from typing import Protocol

from insole_core.geometry.arrays import ByteArray, RawArray
from insole_core.geometry.side import Side
from insole_core.progress import Progress
from insole_core.reconstruct.volume import enclosed_volume
from insole_core.sensing.readings import Readings
from insole_core.sensing.sensor import Sensor
from insole_studio.acquisition.capture_plan import view_faces
from insole_studio.acquisition.capture_setup import CaptureSetup
from insole_studio.acquisition.driver_values import usual_sensor
from insole_studio.acquisition.guidance import (
    FrameSnapshot,
    Guidance,
    Hint,
    HintKind,
    centre_depth_mm,
    depth_colors,
    guide,
)
from insole_studio.acquisition.messages import WARM_UP_S, CapturePhase, SensorState
from insole_studio.acquisition.shared_frame_buffer import Kind, Picture
from insole_studio.texts import fill, localised, tr
from insole_studio.view_names import view_text

_FULL_COLOR = (1280, 1024)


def _hint_text(hint: Hint) -> str:
    """Return the translated text of a hint."""
    if hint.side is not None:
        return _text_of_one_foot(hint.kind, hint.side)
    texts = {
        HintKind.NOTHING_MEASURED: tr("Almost nothing is measured; check distance and light"),
        HintKind.TOO_NEAR: tr("Too near: {found:.0f} mm, at least {wanted:.0f} mm is good"),
        HintKind.TOO_FAR: tr("Too far: {found:.0f} mm, at most {wanted:.0f} mm is good"),
        HintKind.NO_MARKERS: tr(
            "The markers are not recognised; bring the reference system into the picture"
        ),
        HintKind.MARKERS_HIDDEN: tr("{found:.0f} of {wanted:.0f} markers are hidden"),
        HintKind.NO_FOOT: tr("No foot between the markers"),
        HintKind.TOO_DARK: tr("Too dark; add light"),
        HintKind.TOO_BRIGHT: tr("Too bright; turn strong lights away"),
        HintKind.MOVING: tr("Something moves; hold the foot still"),
    }
    return fill(texts[hint.kind], found=hint.found, wanted=hint.wanted)


def _text_of_one_foot(kind: HintKind, side: Side) -> str:
    left = side is Side.LEFT
    if kind is HintKind.FOOT_MISSING:
        return tr("No left foot in its place") if left else tr("No right foot in its place")
    return (
        tr("The left foot is partly hidden by the right one; move the sensor or part the feet")
        if left
        else tr("The right foot is partly hidden by the left one; move the sensor or part the feet")
    )


class Pictures(Protocol):
    """Source of the newest images."""

    def picture(self, slot: int, kind: Kind, after: int = 0) -> Picture | None:
        """Return the newest image of a sensor if its number is greater than `after`.

        Parameters
        ----------
        slot
            Index of the sensor in the shared buffer.
        kind
            Depth, colour or infrared.
        after
            Number of the last image seen.
        """
        ...


class SensorWatch:
    """The newest images of one sensor and what they show.

    Parameters
    ----------
    setup
        Reference system and sensors.
    serial
        Serial number of the sensor.
    view
        Its view, which decides which markers it should see.
    factory
        The calibration of its factory, for one that was never calibrated here.
    """

    def __init__(
        self, setup: CaptureSetup, serial: str, view: str, factory: Sensor | None = None
    ) -> None:
        self.view = view
        faces = view_faces(view, setup.system)
        known = setup.known(serial, view)
        sensor = known.sensor if known else factory or usual_sensor(serial, faces, _FULL_COLOR)
        self._sensor = Readings.of(replace(sensor, faces=faces)).sensor
        self._system = setup.system
        self._volume = setup.volume_of_interest or enclosed_volume(setup.system)
        self._colors = depth_colors(self._sensor.disparity)
        self._depth: RawArray | None = None
        self._guided_depth: RawArray | None = None
        self._color: ByteArray | None = None
        self._numbers: dict[Kind, int] = {"depth": 0, "color": 0}
        self._centre_mm: float | None = None
        self._guidance: Guidance | None = None
        self.guided_at_s = 0.0

    def look(
        self, state: SensorState, pictures: Pictures
    ) -> tuple[ByteArray | None, ByteArray | None]:
        """Fetch the newest images.

        Returns
        -------
        tuple
            Colour-mapped depth at half size, and colour, each (height, width, 3) uint8, RGB; None
            for an image that is not new.
        """
        depth, color = (self._newest(state, kind, pictures) for kind in ("depth", "color"))
        if depth is not None:
            self._depth = depth.image
            self._centre_mm = centre_depth_mm(self._sensor.disparity, depth.image)
        if color is not None:
            self._color = color.image
        colored = self._colors[depth.image[::2, ::2]] if depth is not None else None
        return colored, color.image if color is not None else None

    def _newest(self, state: SensorState, kind: Kind, pictures: Pictures) -> Picture | None:
        found = pictures.picture(state.slot, kind, self._numbers[kind])
        if found is not None:
            self._numbers[kind] = found.number
        return found

    def guidance_task(self) -> Callable[[Progress], Guidance] | None:
        """Return a job that judges the images; None until there are two to compare."""
        depth, color = self._depth, self._color
        before, self._guided_depth = self._guided_depth, depth
        self.guided_at_s = time.monotonic()
        if depth is None or before is None or color is None or before is depth:
            return None
        snapshot = FrameSnapshot(depth, before, color)
        sensor, system, volume = self._sensor, self._system, self._volume
        return lambda _progress: guide(sensor, system, volume, snapshot)

    def take_guidance(self, guidance: Guidance) -> None:
        """Store the assessment of the images."""
        self._guidance = guidance

    @property
    def hints(self) -> tuple[str, ...]:
        """What to change, the most urgent first."""
        return tuple(map(_hint_text, self._guidance.hints)) if self._guidance is not None else ()

    def title(self) -> str:
        """Return the name of the view and the depth in the image centre."""
        depth = f"{localised(self._centre_mm, '.0f')} mm" if self._centre_mm is not None else "– mm"
        return f"{view_text(self.view)} · {depth}"

    def facts(self, state: SensorState) -> str:
        """Return frame rate and losses, valid pixels and markers as text."""
        rate = fill(tr("{fps:.0f} frames/s, {lost} lost"), fps=state.fps, lost=state.discarded)
        if state.phase is CapturePhase.WARMING_UP:
            minutes = fill(tr("warm in {minutes:.0f} min"), minutes=(WARM_UP_S - state.warm_s) / 60)
            rate = f"{rate} · {minutes}"
        found = self._guidance
        if found is None:
            return rate
        markers = tr("markers {seen} of {wanted}").format(
            seen=found.markers_seen, wanted=found.markers_wanted
        )
        measured = fill(tr("{share:.0%} measured"), share=found.valid_share)
        return f"{rate} · {measured} · {markers}"
