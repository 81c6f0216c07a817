"""Open the scan of any scanner: see what it shows and how the foot may lie, then take a foot of it.

`examine_scan` concludes what the user has not said (`ImportChoice`) and doubts what it cannot be
sure of; `take_foot` makes the foot of what was decided. `open_scan` does both for those who cannot
be asked.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from insole_core.cases.scan_source import NOTHING_SAID, ImportChoice
from insole_core.foot.foot import Foot
from insole_core.foot.foot_candidate import FootCandidate, FoundFoot
from insole_core.foot.foot_placement import placed_foot
from insole_core.foot.foot_proportions import check_length, check_proportions, proportions
from insole_core.geometry.transforms import inverse, transform
from insole_core.imprints.form import Form
from insole_core.messages import Message
from insole_core.progress import SILENT, Progress
from insole_core.scans.mesh_file import ReadMesh, read_mesh
from insole_core.workflows.imprinted_feet import find_imprinted_feet, form_notes
from insole_core.workflows.scan_doubts import (
    FootSaid,
    with_name_doubts,
    with_rimless_doubt,
    with_toe_doubt,
)
from insole_core.workflows.scanned_feet import (
    ScannedFoot,
    find_scanned_feet,
    from_file,
    mesh_source,
)


@dataclass(frozen=True, eq=False)
class ScanExamination:
    """What a scan shows.

    Parameters
    ----------
    path
    read
        What was read, at its final scale, without what surrounds the feet.
    form
        As given or concluded.
    feet
        At least one; two of a box or folder with both, more of a folder with such scans.
    notes
        What was assumed or corrected while reading, a sentence each.
    left_out
        What does not belong to a foot, a sentence each.
    """

    path: Path
    read: ReadMesh
    form: Form
    feet: tuple[FoundFoot, ...]
    notes: tuple[str, ...] = ()
    left_out: tuple[str, ...] = ()


def examine_scan(
    path: Path, choice: ImportChoice = NOTHING_SAID, progress: Progress = SILENT
) -> ScanExamination:
    """Read a scan and find the feet in it.

    Parameters
    ----------
    path
        File of a mesh.
    choice
        What is known already.

    Raises
    ------
    UnitError
        When the surface is not of a foot's size.
    InputError
        When the file cannot be read, or shows no foot.
    Cancelled
    """
    read = read_scan(path, choice, progress.part(0.0, 0.3))
    return examine_surface(path, read, choice, progress.part(0.3, 1.0))


def read_scan(
    path: Path, choice: ImportChoice = NOTHING_SAID, progress: Progress = SILENT
) -> ReadMesh:
    """Read the surface of a scan; the first half of `examine_scan`, the same for every pose.

    Parameters
    ----------
    path
        File of a mesh.
    choice
        Of which only unit and size count, and the side where there are two scans.

    Raises
    ------
    UnitError
        When the surface is not of a foot's size.
    InputError
        When the file cannot be read.
    Cancelled
    """
    progress.step(0.0, "Reading the scan")
    return read_mesh(path, choice.unit, known_size=choice.known_size, side=choice.side)


def examine_surface(
    path: Path,
    read: ReadMesh,
    choice: ImportChoice = NOTHING_SAID,
    progress: Progress = SILENT,
) -> ScanExamination:
    """Find the feet in a surface; the second half of `examine_scan`.

    Parameters
    ----------
    path
        Where the surface was read from.
    read
        As `read_scan` returns it.
    choice
        What is known already.

    Raises
    ------
    InputError
        When it shows no foot.
    Cancelled
    """
    progress.step(0.0, "Finding the pose of the foot")
    form, said = choice.form, FootSaid(choice.side, choice.pose, choice.known_size)
    box = find_imprinted_feet(read, form, said)
    if box is None:
        read, left_out, feet = find_scanned_feet(read, said, form is Form.FOOT)
        if form is None and len(feet) == 1:
            feet = (with_rimless_doubt(read, feet[0]),)
        feet = tuple(with_toe_doubt(found, form) for found in feet)
        form = form or Form.FOOT
    else:
        read, form, feet, left_out = box.read, box.form, box.feet, box.left_out
    if read.second is None:
        feet = tuple(from_file(found, read, said) for found in feet)
        feet = (with_name_doubts(feet[0], read, said),) if len(feet) == 1 else feet
    notes = read.notes if read.second is None else ()
    return ScanExamination(path, read, form, feet, notes, left_out)


def take_foot(
    examination: ScanExamination,
    found: FoundFoot,
    candidate: FootCandidate,
    choice: ImportChoice = NOTHING_SAID,
) -> ScannedFoot:
    """Make a foot of what was found in a scan.

    Parameters
    ----------
    found
        One of the feet of the examination.
    candidate
        One of its candidates.
    choice
        That of the examination.

    Raises
    ------
    SideMismatchError
        When the shape is clearly that of the other foot, unless forced.
    ProportionsError
        When the surface is no foot by its proportions, unless forced.
    InputError
        When no foot is as long, unless forced.
    """
    foot = placed_foot(found, candidate, force=choice.force)
    check_length(foot.length_mm, candidate.part_mm, force=choice.force)
    if not choice.force:
        check_proportions(proportions(foot.mesh, foot.length_mm))
    form = examination.form
    length = _length_notes(candidate)
    notes = (*examination.notes, *length, *foot.notes, *examination.left_out, *form_notes(form))
    again = replace(choice, side=candidate.side, unit=found.unit, pose=found.clicks)
    source = replace(mesh_source(found.path or examination.path, form), choice=again)
    warnings = tuple(map(str, found.warnings))
    return ScannedFoot(replace(foot, notes=notes, form=form), source, warnings)


def _length_notes(candidate: FootCandidate) -> Iterator[Message]:
    if candidate.is_length_known:
        yield Message("The foot is {length_mm:.0f} mm long.", length_mm=candidate.length_mm)


def nearest_candidate(feet: Sequence[FoundFoot], foot: Foot) -> tuple[int, FootCandidate] | None:
    """Find the foot of a case in a scan that it was made from before.

    Parameters
    ----------
    feet
        In the scan, at the same scale.
    foot
        That may have been turned a little since.

    Returns
    -------
    number : int
        Of the foot in the scan.
    candidate : FootCandidate
        Of the same side, that lies most like it. None where there is none of that side.
    """
    centre = foot.mesh.vertices.mean(axis=0)
    middle = transform(inverse(foot.source2insole), centre[None, :])

    def far_mm(way: tuple[int, FootCandidate]) -> float:
        turn = way[1].source2insole[:3, :3] @ foot.source2insole[:3, :3].T
        off = transform(way[1].source2insole, middle)[0] - centre
        return float(np.linalg.norm(off) + foot.length_mm * np.linalg.norm(turn - np.eye(3)))

    ways = [
        (number, candidate)
        for number, found in enumerate(feet)
        for candidate in found.candidates
        if candidate.side is foot.side
    ]
    return min(ways, key=far_mm, default=None)
