"""Find the feet that were pressed into the foam of a scanned box."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from insole_core.errors import InputError
from insole_core.foot.foot_candidate import FoundFoot, PoseClicks
from insole_core.foot.foot_placement import find_foot, find_pressed_foot
from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.side import Side
from insole_core.imprints.foam_box import BoxScan, Imprint, find_imprints
from insole_core.imprints.form import Form
from insole_core.messages import Message
from insole_core.scans.cleaning import INSIDE_OUT
from insole_core.scans.mesh_file import ReadMesh
from insole_core.workflows.scan_doubts import NO_WORD, FootSaid, at_known_length
from insole_core.workflows.scanned_feet import named_feet

_HARDLY_MM, _SHALLOW_MM = 8.0, 14.0
"""Depths of an end that is missing in part, and of one that is rounded off: a heel and a toe are
longest some millimetres above the ground."""
_END = 0.12  # share of the length
_END_SHARE = 0.95
_PARALLEL = 0.5  # cosine of the directions of both feet in a box


@dataclass(frozen=True, eq=False)
class ImprintedFeet:
    """What was found in the scan of a foam box.

    Parameters
    ----------
    read
        The scan at its final scale; its notes without what counts for a foot only.
    form
        IMPRINT, unless it was said to be a foot.
    feet
        The left one first, if both are in one box.
    left_out
        A sentence each.
    """

    read: ReadMesh
    form: Form
    feet: tuple[FoundFoot, ...]
    left_out: tuple[str, ...]


def find_imprinted_feet(
    read: ReadMesh, form: Form | None = None, said: FootSaid = NO_WORD
) -> ImprintedFeet | None:
    """Find the feet that were pressed into a scanned surface, or into both of a folder.

    Parameters
    ----------
    read
        Of any form.
    form
        As the user has said; None where it is to be concluded.
    said
        What else the user has said.

    Returns
    -------
    ImprintedFeet or None
        None where there is no foot below a rim, or a user says that what is hollow is none.

    Raises
    ------
    InputError
        When what was pressed in does not look like a foot.
    """
    if read.second is None:
        _, box = at_known_length(
            read,
            said,
            lambda one, known: _in_box(one, form, known),
            lambda found: None if found is None else found.feet[0].candidates[0].length_mm,
        )
        return box
    saids = said.for_each(read.mesh, read.second.mesh)
    first = find_imprinted_feet(replace(read, second=None), form, saids[0])
    second = find_imprinted_feet(read.second, form, saids[1])
    if first is None or second is None:
        return None
    feet = (
        *named_feet(first.feet, first.read, saids[0]),
        *named_feet(second.feet, second.read, saids[1]),
    )
    both = replace(first.read, second=second.read)
    return replace(first, read=both, feet=feet, left_out=(*first.left_out, *second.left_out))


def _in_box(read: ReadMesh, form: Form | None, said: FootSaid) -> ImprintedFeet | None:
    box = find_imprints(read.mesh.flipped() if read.was_turned else read.mesh)
    if box is None or (form not in (None, Form.IMPRINT) and box.is_hollow):
        return None
    clicked = None if said.pose is None else _clicked_imprint(box, said.pose)
    feet = [
        _pressed_foot(imprint, said.pose if number == clicked else None)
        for number, imprint in enumerate(box.imprints)
    ]
    placed = _by_position(*feet) if len(feet) == 2 else feet
    doubts = () if form else tuple(_form_doubts(box))
    found = (
        replace(
            one.foot,
            doubts=(*doubts, *one.doubts(said)),
            notes=(*one.foot.notes, *one.notes()),
        )
        for one in placed
    )
    corrections = tuple(note for note in read.corrections if note != INSIDE_OUT)
    left_out = _left_out(read.mesh, box)
    return ImprintedFeet(
        replace(read, corrections=corrections), form or Form.IMPRINT, tuple(found), (left_out,)
    )


def form_notes(form: Form) -> Iterator[Message]:
    """Say what follows from the form of a scan for the design."""
    if form is Form.IMPRINT:
        yield Message(
            "The foot was pressed into foam, so its tissue is spread by weight already: no "
            "expansion is proposed."
        )
    elif form is Form.CAST:
        yield Message(
            "A cast taken under weight shows tissue that is spread already: no expansion is "
            "proposed."
        )


@dataclass(frozen=True, eq=False)
class _PressedFoot:
    """An imprint and the foot found in it.

    Parameters
    ----------
    place
        Which foot it is by its place beside the other one; None where that tells nothing.
    """

    imprint: Imprint
    foot: FoundFoot
    place: Side | None = None

    @property
    def ahead(self) -> FloatArray:
        """(3,) unit vector from heel to toes, source frame."""
        return self.foot.candidates[0].source2insole[1, :3]

    def doubts(self, said: FootSaid) -> Iterator[Message]:
        """Yield what a user is to be asked."""
        told = self.foot.told_side
        if told is not None and self.place not in (None, told):
            yield Message(
                "By its place in the box this is the {place} foot, by its shape a {told} one; say "
                "which foot it is.",
                place=self.place,
                told=told,
            )
        elif told is None and self.place is None and said.side is None:
            yield Message(
                "The shape of the imprint does not tell left from right; say which foot it is."
            )
        if self._end_mm < _HARDLY_MM and said.side is None:
            yield Message(
                "One end of the imprint is only {depth_mm:.0f} mm deep: heel or toes were hardly "
                "pressed in, so that side and length are uncertain; say which foot it is, and "
                "compare its length.",
                depth_mm=self._end_mm,
            )

    def notes(self) -> Iterator[Message]:
        yield Message(
            "An imprint, {depth_mm:.0f} mm deep, read as the sole that was pressed in.",
            depth_mm=self.imprint.depth_mm,
        )
        if _HARDLY_MM <= self._end_mm < _SHALLOW_MM:
            yield Message(
                "Heel or toes were pressed in by {depth_mm:.0f} mm only: the length is some "
                "millimetres smaller than that of the foot.",
                depth_mm=self._end_mm,
            )

    @cached_property
    def _end_mm(self) -> float:
        """Depth of the shallower end below the rim."""
        along = self.imprint.mesh.vertices @ self.ahead
        depth_mm = self.imprint.rim_mm - self.imprint.mesh.vertices @ self.imprint.dorsal
        end_mm = _END * float(np.ptp(along))
        ends = along < along.min() + end_mm, along > along.max() - end_mm
        return min(float(np.quantile(depth_mm[end], _END_SHARE)) for end in ends)

    def at(self, place: Side) -> _PressedFoot:
        """Return the same foot at a place, which decides where the shape does not tell its side."""
        foot = self.foot
        if foot.told_side is None:
            ordered = sorted(foot.candidates, key=lambda candidate: candidate.side is not place)
            foot = replace(foot, candidates=tuple(ordered))
        return replace(self, foot=foot, place=place)


def _clicked_imprint(box: BoxScan, clicks: PoseClicks) -> int:
    """Return the number of the imprint on which points were clicked: the one nearest to them."""
    centres = np.array([imprint.centre for imprint in box.imprints])
    clicked = np.mean([clicks.heel, clicks.toe, clicks.sole], axis=0)
    return int(np.linalg.norm(centres - clicked, axis=1).argmin())


def _pressed_foot(imprint: Imprint, clicks: PoseClicks | None) -> _PressedFoot:
    if clicks is not None:
        return _PressedFoot(imprint, replace(find_foot(imprint.mesh, None, clicks), doubts=()))
    try:
        foot = find_pressed_foot(imprint.mesh, imprint.dorsal)
    except InputError as error:
        raise InputError(
            "The imprint in the foam, {depth_mm:.0f} mm deep, does not look like a foot; see that "
            "heel, ball and toes are pressed in, and take it again.",
            depth_mm=imprint.depth_mm,
        ) from error
    return _PressedFoot(imprint, foot)


def _by_position(one: _PressedFoot, other: _PressedFoot) -> list[_PressedFoot]:
    """Return two feet of one box, the left one first if they point the same way."""
    if one.ahead @ other.ahead < _PARALLEL:
        return [one, other]
    right = np.cross(one.ahead + other.ahead, one.imprint.dorsal)
    if (other.imprint.centre - one.imprint.centre) @ right < 0:
        one, other = other, one
    return [one.at(Side.LEFT), other.at(Side.RIGHT)]


def _form_doubts(box: BoxScan) -> Iterator[Message]:
    if not box.is_hollow:
        yield Message(
            "A sole stands out of a plane: it is a foot scanned with what lay around it, or a foam "
            "box whose file is inside out; say which it is."
        )


def _left_out(surface: TriangleMesh, box: BoxScan) -> Message:
    kept_mm2 = sum(imprint.mesh.area_mm2 for imprint in box.imprints)
    return Message(
        "The box around the imprint was left out: {percent:.0f} % of what was scanned.",
        percent=100 * (1 - kept_mm2 / surface.area_mm2),
    )
