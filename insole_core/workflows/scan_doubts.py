"""What a user has said of a foot in a scan, and what is in doubt: its unit, its form, its name."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from typing import TypeVar

import numpy as np

from insole_core.foot.foot_candidate import FoundFoot, PoseClicks
from insole_core.foot.foot_doubts import USUAL_LENGTH_MM
from insole_core.foot.foot_proportions import LENGTH_MM, is_within
from insole_core.foot.levelling import at_origin
from insole_core.foot.measures import shoe_size_eu
from insole_core.foot.toe_relief import LEAST_RELIEF_MM, has_ankle, toe_relief_mm
from insole_core.formats.units import MM_PER_UNIT, UNIT_NAMES, UnitReading
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.side import Side
from insole_core.imprints.form import Form
from insole_core.messages import Message, joined
from insole_core.scans.mesh_file import ReadMesh
from insole_core.scans.scale import KnownDistance, KnownSize, known_length_mm
from insole_core.scans.scan_folder import ScanPart

_SCALE_ROUNDS, _SCALE_ERROR = 4, 0.002
_Found = TypeVar("_Found")
_ADULT_MM = 210.0
"""EU 34; a foot that is shorter is a child's."""
_READINGS_MM = (80.0, 400.0)
_FACING_UP = 0.4
"""Mean z of the normals, from which on an open surface is a sole alone, and faces the foot."""


@dataclass(frozen=True)
class FootSaid:
    """What a user has said of a foot; None where it is to be concluded.

    Parameters
    ----------
    side
    pose
        As it was clicked.
    known_size
    """

    side: Side | None = None
    pose: PoseClicks | None = None
    known_size: KnownSize | None = None

    @property
    def length_mm(self) -> float | None:
        """Length of the foot, by which a scan without a scale is scaled."""
        if self.known_size is None or isinstance(self.known_size, KnownDistance):
            return None
        return known_length_mm(self.known_size)

    def for_each(self, first: TriangleMesh, second: TriangleMesh) -> tuple[FootSaid, FootSaid]:
        """Return what was said of each of two feet: the points were clicked on one of them."""
        from scipy.spatial import cKDTree

        if self.pose is None:
            return self, self
        clicks = np.array([self.pose.heel, self.pose.toe, self.pose.sole])
        first_mm, second_mm = (
            float(np.sum(cKDTree(mesh.vertices).query(clicks)[0])) for mesh in (first, second)
        )
        other = replace(self, pose=None)
        return (self, other) if first_mm <= second_mm else (other, self)

    def _scaled(self, factor: float) -> FootSaid:
        return replace(self, pose=None if self.pose is None else self.pose.scaled(factor))


NO_WORD = FootSaid()


def at_known_length(
    read: ReadMesh,
    said: FootSaid,
    find: Callable[[ReadMesh, FootSaid], _Found],
    length_of: Callable[[_Found], float | None],
) -> tuple[ReadMesh, _Found]:
    """Find feet in a scan at the scale at which the first of them has its known length.

    Parameters
    ----------
    read
        At the scale at which the points were clicked.
    find
        Finds the feet at any scale.
    length_of
        Length of the first foot that was found, mm; None where there is none.

    Returns
    -------
    read : ReadMesh
        At its final scale.
    found
        What `find` returned at that scale.
    """
    found = find(read, said)
    for _ in range(_SCALE_ROUNDS):
        length_mm = length_of(found)
        if length_mm is None or said.length_mm is None:
            break
        factor = said.length_mm / length_mm
        if abs(factor - 1) < _SCALE_ERROR:
            break
        read, said = read.scaled(factor), said._scaled(factor)
        found = find(read, said)
    return read, found


def with_unit_doubt(found: FoundFoot, read: ReadMesh) -> FoundFoot:
    """Doubt a unit that only the size tells: of a child's foot, or of a foot in two units.

    A unit that the file or its format states is taken if the foot is one in it. If not, another is
    always asked for. What else is in doubt is told by lengths, and asked once the unit is known.
    """
    if read.is_unit_said or read.stated == read.unit:
        return found
    nearest = found.candidates[0]
    length_mm = nearest.length_mm
    likely = UnitReading(read.unit, length_mm, nearest.part_mm)
    others = [likely.in_unit(unit) for unit in MM_PER_UNIT if unit != read.unit]
    is_adult = is_within(length_mm, (_ADULT_MM, USUAL_LENGTH_MM[1]))
    if (
        read.stated is None
        and is_adult
        and not any(is_within(one.length_mm, USUAL_LENGTH_MM) for one in others)
    ):
        return found
    readings = (likely, *(one for one in others if is_within(one.length_mm, _READINGS_MM)))
    doubt = _unit_doubt(readings, read)
    return replace(found, unit_readings=readings, doubts=(doubt,))


def _unit_doubt(readings: tuple[UnitReading, ...], read: ReadMesh) -> Message:
    choices = joined(
        [
            Message("{foot} if it is in {unit}", foot=foot_text(one), unit=UNIT_NAMES[one.unit])
            for one in readings
        ]
    )
    if read.stated is None:
        return Message(
            "The file does not say in which unit it is: {choices}. Say which it is.",
            choices=choices,
        )
    return Message(
        "The file is in {stated} by what it says, in which it is no foot: {choices}. Say which it "
        "is.",
        stated=UNIT_NAMES[read.stated],
        choices=choices,
    )


def foot_text(reading: UnitReading) -> Message:
    """Describe the foot that a file shows in one unit."""
    length_mm = reading.length_mm
    if not is_within(length_mm, LENGTH_MM):
        seen_mm = length_mm if reading.scanned_mm is None else reading.scanned_mm
        return Message("{length_mm:.0f} mm (no foot)", length_mm=seen_mm)
    if reading.scanned_mm is not None:
        return Message(
            "a foot without toes, of which {scanned_mm:.0f} mm were scanned",
            scanned_mm=reading.scanned_mm,
        )
    if length_mm < _ADULT_MM:
        return Message(
            "a foot of {length_mm:.0f} mm (a child's, EU {size:.0f})",
            length_mm=length_mm,
            size=shoe_size_eu(length_mm),
        )
    return Message("a foot of {length_mm:.0f} mm", length_mm=length_mm)


def with_toe_doubt(found: FoundFoot, form: Form | None) -> FoundFoot:
    """Tell of a foot that shows no toes, and doubt that it is one if it has no ankle either.

    Parameters
    ----------
    found
    form
        As the user has said; None where it is to be concluded.
    """
    if form not in (None, Form.FOOT):
        return found
    likely = found.candidates[0]
    placed = found.even.transformed(at_origin(found.mesh, likely.source2insole))
    relief_mm = toe_relief_mm(placed, likely.length_mm)
    if relief_mm is None or relief_mm >= LEAST_RELIEF_MM or not likely.is_length_known:
        return found
    if form is None and not has_ankle(placed, likely.length_mm):
        doubt = Message(
            "The surface has no toes and no ankle, as a shoe last or a prosthetic foot; if it is a "
            "foot, say so."
        )
        return replace(found, doubts=(*found.doubts, doubt))
    warning = Message(
        "No single toes are seen, as in a sock or where they melted together, so what lies at them "
        "is a guess; see that it is a foot, and no shoe last or prosthesis."
    )
    return replace(found, warnings=(*found.warnings, warning))


def with_rimless_doubt(read: ReadMesh, found: FoundFoot) -> FoundFoot:
    """Doubt the form of an open sole whose triangles face into the foot in its file.

    Scanners let them face the sensor: those of a foot face down, those of an imprint up. The side
    does not depend on it, but on the way in which the sole bends.
    """
    up = found.candidates[0].source2insole[2, :3]
    facing = float(read.mesh.vertex_areas @ (read.mesh.vertex_normals @ up)) / read.mesh.area_mm2
    if (-facing if read.was_turned else facing) < _FACING_UP:
        return found
    doubt = Message(
        "The surface faces into the foot: it is an imprint whose rim was cut off, or a file that "
        "is inside out; say whether it is a foam box or a foot."
    )
    return replace(found, doubts=(*found.doubts, doubt))


def with_name_doubts(found: FoundFoot, read: ReadMesh, said: FootSaid = NO_WORD) -> FoundFoot:
    """Return the only foot of a file, in doubt if the file's name tells the other side."""
    if read.part is None:
        return found
    return replace(found, doubts=(*_name_doubts(found, read.part, said), *found.doubts))


def _name_doubts(found: FoundFoot, part: ScanPart, said: FootSaid) -> Iterator[Message]:
    if part.side is None:
        return
    told = found.told_side
    if told not in (None, part.side):
        yield Message(
            "{name} is named as a {side} foot, but looks like a {told} one; say which foot it is.",
            name=part.path.name,
            side=part.side,
            told=told,
        )
    elif said.side not in (None, part.side):
        yield Message(
            "{name} is named as a {side} foot, but is opened as a {said} one; say which foot it "
            "is.",
            name=part.path.name,
            side=part.side,
            said=said.side,
        )
