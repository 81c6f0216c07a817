"""A recorded capture of one foot or of both, as a value (docs/formats/session.md)."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from insole_core.geometry.arrays import ByteArray, FloatArray, RawArray
from insole_core.geometry.side import BOTH, Side, Sides
from insole_core.recording.box import Box
from insole_core.recording.capture_place import CapturePlace
from insole_core.recording.hand_edits import NO_EDITS, HandEdits
from insole_core.sensing.infrared_reference import InfraredReference
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
class FootPlace:
    """The place of one of two feet in a reference system for both.

    Parameters
    ----------
    origin_mm
        Origin of the foot's own reference frame, in that of the system; their axes are parallel.
    volume_of_interest
        In the foot's own frame.
    """

    side: Side
    origin_mm: tuple[float, float, float]
    volume_of_interest: Box


@dataclass(frozen=True)
class ReferenceSystem:
    """The rigid system of markers around the foot, which defines the reference frame.

    Parameters
    ----------
    feet
        Of a system for both feet, the place of the left one and of the right one.
    """

    name: str
    markers: tuple[Marker, ...]
    feet: tuple[FootPlace, ...] = ()

    @property
    def digest(self) -> str:
        """SHA-256 of its name and of where its markers are, to tell it from others."""
        told = [(one.id, one.face, *map(float, one.position_mm)) for one in self.markers]
        return hashlib.sha256(json.dumps([self.name, told]).encode()).hexdigest()

    def facing(self, faces: tuple[str, ...]) -> tuple[Marker, ...]:
        """Return the markers of the named groups, in order."""
        return tuple(marker for marker in self.markers if marker.face in faces)

    def place(self, side: Side) -> FootPlace:
        """Return the place of a foot in a system for both."""
        return next(place for place in self.feet if place.side is side)

    def around(self, place: FootPlace) -> ReferenceSystem:
        """Return all markers in the own frame of one of the two feet."""
        x, y, z = place.origin_mm

        def moved(marker: Marker) -> Marker:
            at = marker.position_mm
            return replace(marker, position_mm=(at[0] - x, at[1] - y, at[2] - z))

        return ReferenceSystem(self.name, tuple(map(moved, self.markers)))


WEIGHT_BEARING = ("none", "semi", "full")
"""How much of the weight a session says was on the foot."""


@dataclass(frozen=True)
class CaptureCondition:
    """Load and support of the foot during the capture.

    Parameters
    ----------
    weight_bearing
        One of `WEIGHT_BEARING`.
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
    side
        Both only with a reference system that has places for two feet.
    views
        Names of the views, in order.
    volume_of_interest
        Limits the reconstruction; None for the volume that the markers enclose. Of both feet the
        reference system tells it.
    """

    recorded_at: str
    side: Sides
    reference_system: ReferenceSystem
    views: tuple[str, ...]
    volume_of_interest: Box | None = None
    capture_condition: CaptureCondition | None = None
    metric: bool = False
    """Whether a view may come from a sensor that delivers millimetres (version 3)."""
    extra: dict[str, Any] = field(default_factory=dict)
    """Keys that this version does not know; preserved when the session is copied."""

    @property
    def sides(self) -> tuple[Side, ...]:
        """The feet that were captured."""
        return tuple(Side) if self.side == BOTH else (self.side,)

    @property
    def one_side(self) -> Side:
        """The side of a capture of one foot."""
        (side,) = self.sides
        return side

    def of_foot(self, side: Side) -> Manifest:
        """Return the manifest of one of the captured feet, in the foot's own reference frame."""
        if self.side != BOTH:
            assert side is self.side, "only a foot that was captured has a manifest"
            return self
        place = self.reference_system.place(side)
        system = self.reference_system.around(place)
        volume = place.volume_of_interest
        return replace(self, side=side, reference_system=system, volume_of_interest=volume)


@dataclass(frozen=True, eq=False)
class InfraredPictures:
    """The infrared pictures of one camera of a sensor, read one at a time.

    Parameters
    ----------
    read
        Returns picture i, (height, width) uint16.
    bits
        Of the stored pictures, 8 or 16.
    """

    count: int
    read: Callable[[int], RawArray]
    bits: int

    def mean(self) -> FloatArray:
        """Return the mean picture, (height, width) float64."""
        total = self.read(0).astype(np.float64)
        for index in range(1, self.count):
            total += self.read(index)
        return total / self.count


@dataclass(frozen=True, eq=False)
class DotPictures:
    """The infrared pictures of a Kinect's dots in one view, and the pattern of its projector.

    Parameters
    ----------
    pictures
        None where they cannot be read.
    reference
        None without one, or where it cannot be read.
    shift_px : (u, v)
        What the depth image shows at a pixel, the pictures show so much further right and down.
    moved_raw
        By how much depth had changed when they were taken, where it changed most; None where
        nobody looked.
    picture_fault, pattern_fault
        Why pictures or pattern cannot be used, a sentence; empty where they can.
    """

    pictures: InfraredPictures | None = None
    reference: InfraredReference | None = None
    shift_px: tuple[float, float] = (0.0, 0.0)
    moved_raw: float | None = None
    picture_fault: str = ""
    pattern_fault: str = ""

    @property
    def fault(self) -> str:
        """Why they cannot be used, a sentence; empty where they can."""
        return self.picture_fault or self.pattern_fault


@dataclass(frozen=True)
class FrameTimes:
    """When the frames of a view were taken, ms on the clock of its sensor."""

    depth_ms: tuple[float, ...]
    color_ms: tuple[float, ...]

    @property
    def color_apart_ms(self) -> float:
        """The longest time between a colour frame and the depth frame next to it."""
        return max(min(abs(color - depth) for depth in self.depth_ms) for color in self.color_ms)

    def overlap(self, other: FrameTimes) -> bool:
        """Return whether depth was taken meanwhile by a view with the same clock."""
        begins_ms = max(min(self.depth_ms), min(other.depth_ms))
        return begins_ms <= min(max(self.depth_ms), max(other.depth_ms))


@dataclass(frozen=True, eq=False)
class View:
    """The recording of one sensor; frames are read one at a time, on demand.

    Parameters
    ----------
    depth_count, color_count
        Number of frames.
    read_depth
        Returns depth frame i as it is stored (see `Readings`), (height, width) uint16; of a Kinect
        raw numbers, 2047 = no reading.
    read_color
        Returns colour frame i, (height, width, 3) uint8, RGB.
    infrared
        Pictures by the name of their files without number, such as ``infrared_left``.
    times : optional
        Where the sensor told them.
    dots : optional
        Where the view of a Kinect was recorded with its infrared pictures.
    """

    name: str
    sensor: Sensor
    depth_count: int
    color_count: int
    read_depth: Callable[[int], RawArray]
    read_color: Callable[[int], ByteArray]
    infrared: Mapping[str, InfraredPictures] = field(default_factory=dict)
    times: FrameTimes | None = None
    dots: DotPictures | None = None


@dataclass(frozen=True, eq=False)
class Session:
    """A manifest and its views, in the manifest's order."""

    manifest: Manifest
    views: tuple[View, ...]
    source: str
    """Where it was read from, for messages."""
    edits: HandEdits = NO_EDITS
    """Manual corrections, which `reconstruct` applies."""

    @property
    def serials(self) -> tuple[str, ...]:
        """Serial numbers of the sensors, each once, sorted."""
        return tuple(sorted({view.sensor.serial for view in self.views}))

    @property
    def place(self) -> CapturePlace | None:
        """Where it was captured; None where a sensor does not tell its serial number."""
        if not all(self.serials):
            return None
        calibrated = max((view.sensor.calibrated_at for view in self.views), default="")
        return CapturePlace(self.serials, self.manifest.reference_system.digest, calibrated)

    @property
    def feet(self) -> tuple[Session, ...]:
        """One session for each captured foot: all views, in the foot's own reference frame."""
        return tuple(self.of_foot(side) for side in self.manifest.sides)

    def of_foot(self, side: Side) -> Session:
        """Return the session of one of the captured feet, in the foot's own reference frame."""
        if self.manifest.side != BOTH:
            return replace(self, manifest=self.manifest.of_foot(side))
        edits = replace(self.edits, volume_of_interest=self.edits.volumes.get(side), volumes={})
        return replace(self, manifest=self.manifest.of_foot(side), edits=edits)
