"""Open the scan of any scanner: at once where nothing is in doubt, else with a dialog."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from insole_core.cases.scan_source import ImportChoice
from insole_core.errors import InsoleError
from insole_core.geometry.side import Side
from insole_core.progress import Progress
from insole_core.workflows.scanned_feet import ScannedFoot, choice_of, feet_made_of
from insole_studio.services.app_services import AppServices

if TYPE_CHECKING:
    from insole_studio.features.import_scan.found_scan import FoundScan

Take = Callable[[Sequence[ScannedFoot]], None]


class ScanImport:
    """Opens scans that are no sessions."""

    def __init__(self, services: AppServices) -> None:
        self._services = services

    def open(self, path: Path, side: Side | None, channel: str, take: Take) -> None:
        """Open a scan; what the file does not tell is asked.

        Parameters
        ----------
        side
            None to ask. A scan that a foot of the case was made of is always asked about, and
            shown as it was read for that foot.
        channel
            Of the jobs, which other files may replace.
        take
            Called with the feet.
        """

        from insole_studio.features.import_scan.found_scan import find_scan

        in_case = tuple(
            foot for foot in self._services.case.record.feet if side in (None, foot.side)
        )

        def find(progress: Progress) -> tuple[FoundScan, ScannedFoot | None]:
            made = feet_made_of(path, in_case, progress)
            choice = choice_of(made) if made else ImportChoice(side)
            found = find_scan(path, choice, None, progress)
            if made:  # shown as it was read before, for whoever wants to read it in another way
                found = replace(found, before=tuple(record.foot for record in made))
                return replace(found, refusal=_objection(found)), None
            return _taken_at_once(found)

        def opened(result: tuple[FoundScan, ScannedFoot | None]) -> None:
            found, scanned = result
            if scanned is None:
                self._ask(path, found, take)
            else:
                take([scanned])

        self._services.run(channel, find, opened)

    def _ask(self, path: Path, found: FoundScan, take: Take) -> None:
        from insole_studio.features.import_scan.import_dialog import ImportDialog
        from insole_studio.features.import_scan.import_presenter import ImportPresenter

        services = self._services
        dialog = ImportDialog(path.name, services.dark, services.window)
        ImportPresenter(
            dialog, services.jobs, path, found, take=take, failed=services.messages.show_error
        )
        dialog.finished.connect(dialog.deleteLater)
        dialog.open()


def _objection(found: FoundScan) -> str:
    """Return what spoke against the feet of a scan when the user insisted on them."""
    from insole_core.workflows.import_scan import take_foot

    examination = found.examination
    if examination is None or not found.choice.force:
        return found.refusal
    choice = replace(found.choice, force=False)
    proposed = (found.proposed(number) for number in range(len(found.feet)))
    try:
        for foot, candidate in zip(found.feet, proposed, strict=True):
            if candidate is not None:
                take_foot(examination, foot, candidate, choice)
    except InsoleError as error:
        return error.message
    return ""


def _taken_at_once(found: FoundScan) -> tuple[FoundScan, ScannedFoot | None]:
    """Make the foot of a scan of which nothing has to be asked."""
    from insole_core.workflows.import_scan import take_foot

    examination, side = found.examination, found.choice.side
    candidate = found.proposed(0) if found.feet else None
    if examination is None or side is None or candidate is None or not found.is_sure:
        return found, None
    try:
        return found, take_foot(examination, found.feet[0], candidate, found.choice)
    except InsoleError as error:
        return replace(found, refusal=error.message), None
