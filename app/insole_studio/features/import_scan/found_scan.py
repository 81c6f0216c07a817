"""What is known of a scan while it is being opened."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from insole_core.cases.scan_source import ImportChoice
from insole_core.errors import InputError
from insole_core.foot.foot import Foot
from insole_core.foot.foot_candidate import FootCandidate, FoundFoot
from insole_core.geometry.side import Side
from insole_core.progress import Progress
from insole_core.scans.mesh_file import ReadMesh, UnitError
from insole_core.workflows.import_scan import (
    ScanExamination,
    examine_surface,
    nearest_candidate,
    read_scan,
)


@dataclass(frozen=True, eq=False)
class FoundScan:
    """A scan as far as it could be read in the way that was chosen.

    Parameters
    ----------
    choice
        What the user has said of it.
    read
        All of it, as it was read; None where no unit makes it as large as a foot.
    examination
        None where no foot was found.
    refusal
        Why, or what speaks against the foot that was found, as a sentence.
    before
        Feet of the case that were made of this scan with this choice.
    """

    choice: ImportChoice
    read: ReadMesh | None = None
    examination: ScanExamination | None = None
    refusal: str = ""
    before: tuple[Foot, ...] = ()

    @property
    def feet(self) -> tuple[FoundFoot, ...]:
        """The feet that were found."""
        return () if self.examination is None else self.examination.feet

    def proposed(self, number: int, said: Side | None = None) -> FootCandidate | None:
        """Return the way in which a foot is to be taken; None if that has to be asked.

        Parameters
        ----------
        number
            Of the foot.
        said
            Which foot it is, as the user has said since.
        """
        for made in self.before:
            near = nearest_candidate(self.feet, made)
            if near is not None and near[0] == number:
                return near[1]
        foot = self.feet[number]
        if said is None and len(self.feet) == 1:
            said = self.choice.side
        if said is not None:
            return foot.best(said)
        return foot.candidates[0] if foot.told_side is not None else None

    @property
    def mm_per_read_mm(self) -> float:
        """What the surface that is shown was multiplied with since it was read."""
        if self.read is None or self.examination is None:
            return 1.0
        return self.examination.read.mm_per_unit / self.read.mm_per_unit

    @property
    def is_sure(self) -> bool:
        """Whether nothing has to be asked: the side was said, and nothing is in doubt."""
        is_said = self.choice.side is not None and len(self.feet) == 1
        return is_said and not any(foot.doubts for foot in self.feet)


def find_scan(
    path: Path, choice: ImportChoice, read: ReadMesh | None, progress: Progress
) -> FoundScan:
    """Read a scan in the chosen way, and find the feet in it.

    Parameters
    ----------
    read
        The surface, where it was read before in the same unit.

    Raises
    ------
    InputError
        When the file cannot be read at all.
    Cancelled
    """
    if read is None:
        try:
            read = read_scan(path, choice, progress.part(0.0, 0.4))
        except UnitError as error:
            return FoundScan(choice, refusal=error.message)
    try:
        examination = examine_surface(path, read, choice, progress.part(0.4, 1.0))
    except InputError as error:
        return FoundScan(choice, read, refusal=error.message)
    return FoundScan(choice, read, examination)
