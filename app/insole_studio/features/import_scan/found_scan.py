"""What is known of a scan while it is being opened, and the texts with which it is asked about."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from insole_core.cases.scan_source import ImportChoice
from insole_core.errors import InputError
from insole_core.foot.foot import Foot
from insole_core.foot.foot_candidate import FootCandidate, FoundFoot
from insole_core.formats.units import Unit, UnitReading
from insole_core.geometry.side import Side
from insole_core.imprints.form import Form
from insole_core.progress import Progress
from insole_core.scans.mesh_file import ReadMesh, UnitError
from insole_core.workflows.import_scan import (
    ScanExamination,
    examine_surface,
    nearest_candidate,
    read_scan,
)
from insole_core.workflows.scan_doubts import foot_text as foot_text_in
from insole_studio.texts import fill, tr, translate_core_message

CLICKS = ("heel", "toe", "sole")
"""The points that tell a pose, in the order in which they are clicked."""


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


def click_sentence(clicked: int) -> str:
    """Say which point is to be clicked next."""
    sentences = (
        tr("Click the end of the heel."),
        tr("Click the tip of a toe."),
        tr("Click the sole, under the ball of the foot."),
    )
    return sentences[clicked]


def click_name(clicked: int) -> str:
    """Return the name of a clicked point."""
    return (tr("Heel"), tr("Toes"), tr("Sole"))[clicked]


def side_text(side: Side) -> str:
    """Name a foot by its side."""
    return tr("Left foot") if side is Side.LEFT else tr("Right foot")


def unit_text(reading: UnitReading) -> str:
    """Say what the scan is in one unit."""
    unit = dict(unit_options())[reading.unit]
    return f"{unit}: {translate_core_message(foot_text_in(reading))}"


def candidate_text(candidate: FootCandidate) -> str:
    """Describe one way in which a scan can be a foot."""
    parts = [translate_core_message(candidate.length_text)]
    if candidate.leg is not None:
        parts.append(fill(tr("leg cut off at {mm:.0f} mm"), mm=candidate.leg.height_mm))
    return ", ".join(parts)


def finding_text(foot: FoundFoot, chosen: FootCandidate | None) -> str:
    """Say what the scan is taken for, and by what."""
    if chosen is None:
        return tr("Choose which foot it is.")
    if chosen.side is foot.told_side:
        side = {
            Side.LEFT: tr("A left foot by its shape"),
            Side.RIGHT: tr("A right foot by its shape"),
        }[chosen.side]
    else:
        side = side_text(chosen.side)
    return _described(side, foot, chosen)


def _described(side: str, foot: FoundFoot, candidate: FootCandidate) -> str:
    if foot.unit_readings:  # a length that is a guess is none
        return side
    return f"{side}, {candidate_text(candidate)}"


def foot_text(foot: FoundFoot, candidate: FootCandidate | None) -> str:
    """Describe one of several feet of a scan."""
    shown = candidate or foot.candidates[0]
    side = tr("Left or right foot") if candidate is None else side_text(shown.side)
    return _described(side, foot, shown)


def unit_options() -> list[tuple[Unit, str]]:
    """Return the units in which a file may be."""
    return [
        ("mm", tr("Millimetres")),
        ("cm", tr("Centimetres")),
        ("m", tr("Metres")),
        ("inch", tr("Inches")),
    ]


def form_options() -> list[tuple[str, str]]:
    """Return the forms of a scan, with the first for what the shape tells."""
    return [
        ("", tr("As the shape tells")),
        (Form.FOOT.value, tr("A foot")),
        (Form.IMPRINT.value, tr("A foam box or another imprint")),
        (Form.CAST.value, tr("A plaster cast, taken under weight")),
        (Form.UNLOADED_CAST.value, tr("A plaster cast, taken without weight")),
    ]
