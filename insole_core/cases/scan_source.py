"""Where the foot of a case comes from."""

from __future__ import annotations

from dataclasses import dataclass, replace

from insole_core.cases.import_choice import NOTHING_SAID, ImportChoice
from insole_core.imprints.form import Form


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
        With which a mesh is read as the same foot once more.
    mirrored
        Whether the foot is the mirror image of what this scan shows: of the other foot.
    scanned_on
        Day (ISO 8601) of the earlier visit that the scan is of; empty for one of its own visit.
    """

    kind: str
    path: str
    sha256: str
    recorded_at: str = ""
    form: Form = Form.FOOT
    choice: ImportChoice = NOTHING_SAID
    mirrored: bool = False
    scanned_on: str = ""

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
