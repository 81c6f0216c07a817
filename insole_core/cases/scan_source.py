"""Where the foot of a case comes from, and what a user said of its scan; as values and as JSON."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

from insole_core.foot.foot_candidate import PoseClicks
from insole_core.formats.units import MM_PER_UNIT, Unit
from insole_core.geometry.side import Side
from insole_core.imprints.form import Form
from insole_core.json_object import JsonObject
from insole_core.recording.capture_place import CapturePlace
from insole_core.scans.scale import KnownDistance, KnownFootLength, KnownShoeSize, KnownSize

_MOST = 1e9  # of a coordinate, in any unit


@dataclass(frozen=True)
class ImportChoice:
    """What the user has said of a scan; None where it is to be concluded.

    Parameters
    ----------
    side
    unit
        Of the coordinates in the file.
    known_size
        In place of a unit.
    form
    pose
        Three clicked points.
    force
        Go on although the shape looks like the other foot, or is none by its proportions.
    """

    side: Side | None = None
    unit: Unit | None = None
    known_size: KnownSize | None = None
    form: Form | None = None
    pose: PoseClicks | None = None
    force: bool = False


NOTHING_SAID = ImportChoice()
"""All is to be concluded."""


def choice_to_json(choice: ImportChoice) -> dict[str, Any]:
    """Return what was said of a scan as plain values: a key for each that was said."""
    content: dict[str, Any] = {}
    for key, word in (("side", choice.side), ("unit", choice.unit), ("form", choice.form)):
        if word is not None:
            content[key] = str(word)
    if choice.known_size is not None:
        content["known_size"] = vars(choice.known_size).copy()
    if choice.pose is not None:
        content["clicks"] = vars(choice.pose).copy()
    if choice.force:
        content["force"] = True
    return content


def choice_from_json(choice: JsonObject) -> ImportChoice:
    """Read what was said of a scan.

    Raises
    ------
    InputError
        Names the file and the key of the first violation.
    """
    return ImportChoice(
        choice.choice("side", list(Side)) if choice.has("side") else None,
        choice.choice("unit", list(MM_PER_UNIT)) if choice.has("unit") else None,
        _known_size(choice.object("known_size")) if choice.has("known_size") else None,
        choice.choice("form", list(Form)) if choice.has("form") else None,
        _clicks(choice.object("clicks")) if choice.has("clicks") else None,
        choice.flag("force") if choice.has("force") else False,
    )


def _known_size(size: JsonObject) -> KnownSize:
    if size.has("length_mm"):
        return KnownFootLength(size.number("length_mm", 0, _MOST))
    if size.has("size_eu"):
        return KnownShoeSize(size.number("size_eu", 0, _MOST))
    first, second = size.triple("first", _MOST), size.triple("second", _MOST)
    return KnownDistance(first, second, size.number("distance_mm", 0, _MOST))


def _clicks(clicks: JsonObject) -> PoseClicks:
    return PoseClicks(*(clicks.triple(key, _MOST) for key in ("heel", "toe", "sole")))


@dataclass(frozen=True)
class ScanSource:
    """The scan that a foot was made from.

    Parameters
    ----------
    kind
        ``session`` or ``mesh``.
    sha256
        Of the manifest of a session, or of the file of a mesh or an archive.
    recorded_at
        ISO 8601, UTC; empty where unknown.
    form
        What was scanned; a session shows a foot.
    choice
        With which a mesh is read as the same foot once more; of a session only the side, where it
        was taken as another foot than it was recorded as.
    mirrored
        Whether the foot is the mirror image of what this scan shows: of the other foot.
    scanned_on
        Day (ISO 8601) of the earlier visit that the scan is of; empty for one of its own visit.
    place
        Where a session was captured; None where that is not known.
    weight_bearing
        One of `WEIGHT_BEARING`, by what a session says.
    """

    kind: str
    path: str
    sha256: str
    recorded_at: str = ""
    form: Form = Form.FOOT
    choice: ImportChoice = NOTHING_SAID
    mirrored: bool = False
    scanned_on: str = ""
    place: CapturePlace | None = None
    weight_bearing: str = "none"

    @property
    def said_weight(self) -> str | None:
        """How much weight was on the foot, one of `WEIGHT_BEARING`; None where nobody says."""
        return self.weight_bearing if self.kind == "session" else None

    def with_needed_place(self) -> ScanSource:
        """Return the source as the record keeps it, which holds the scan itself as a capture.

        Only a session keeps its place: there the window corrects its markers.
        """
        return self if self.kind == "session" else self.without_place()

    def without_place(self) -> ScanSource:
        """Return the source without where its file lay: folders and files are named after patients.

        Its kind stands there instead.
        """
        return replace(self, path=self.kind)
