"""A recorded capture of one foot, as a value (docs/formats/session.md)."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

from insole_core.geometry.arrays import ByteArray, RawArray
from insole_core.geometry.side import Side
from insole_core.recording.box import Box
from insole_core.recording.hand_edits import NO_EDITS, HandEdits
from insole_core.sensing.sensor import Sensor


@dataclass(frozen=True)
class Marker:
    """A marker of the reference system.

    Parameters
    ----------
    position_mm
        Centre of its visible face, reference frame.
    face
        Group of markers that face the same way; a sensor sees certain groups.
    """

    id: str
    position_mm: tuple[float, float, float]
    face: str


@dataclass(frozen=True)
class ReferenceSystem:
    """The rigid system of markers around the foot, which defines the reference frame."""

    name: str
    markers: tuple[Marker, ...]

    def facing(self, faces: tuple[str, ...]) -> tuple[Marker, ...]:
        """Return the markers of the named groups, in order."""
        return tuple(marker for marker in self.markers if marker.face in faces)


@dataclass(frozen=True)
class CaptureCondition:
    """Load and support of the foot during the capture.

    Parameters
    ----------
    weight_bearing
        ``none``, ``semi`` or ``full``.
    held
        Whether the foot was held.
    """

    weight_bearing: str = "none"
    held: bool = False
    notes: str = ""


@dataclass(frozen=True)
class Manifest:
    """Metadata of the whole capture.

    Parameters
    ----------
    recorded_at
        ISO 8601.
    views
        Names of the views, in order.
    volume_of_interest
        Limits the reconstruction; None for the volume that the markers enclose.
    """

    recorded_at: str
    side: Side
    reference_system: ReferenceSystem
    views: tuple[str, ...]
    volume_of_interest: Box | None = None
    capture_condition: CaptureCondition | None = None
    extra: dict[str, Any] = field(default_factory=dict)
    """Keys that this version does not know; preserved when the session is copied."""


@dataclass(frozen=True, eq=False)
class View:
    """The recording of one sensor; frames are read one at a time, on demand.

    Parameters
    ----------
    depth_count, color_count
        Number of frames.
    read_depth
        Returns depth frame i, (480, 640) uint16 raw numbers, 2047 = no reading.
    read_color
        Returns colour frame i, (height, width, 3) uint8, RGB.
    """

    name: str
    sensor: Sensor
    depth_count: int
    color_count: int
    read_depth: Callable[[int], RawArray]
    read_color: Callable[[int], ByteArray]


@dataclass(frozen=True, eq=False)
class Session:
    """A manifest and its views, in the manifest's order."""

    manifest: Manifest
    views: tuple[View, ...]
    source: str
    """Where it was read from, for messages."""
    edits: HandEdits = NO_EDITS
    """Manual corrections, which `reconstruct` applies."""
