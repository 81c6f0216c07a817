"""The shoe of the current foot's insole: chosen, read from a last, trimmed to."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from insole_core.errors import InputError, InsoleError
from insole_core.progress import Progress
from insole_studio.services.app_services import AppServices
from insole_studio.services.files import Kept, surface_kinds
from insole_studio.texts import tr
from insole_studio.widgets.form_parts import Field

if TYPE_CHECKING:
    from insole_core.foot.foot import Foot
    from insole_core.insole.prescription.design import InsoleDesign
    from insole_core.insole.prescription.outline import Shoe
    from insole_studio.features.design.shoe.shoe_dialog import ShoeDialog

CHANNEL = "shoe"


class ShoeActions:
    """Lets the user choose the shoe that the insole is to lie in."""

    def __init__(self, services: AppServices) -> None:
        self._services = services
        self._case = services.case
        self._dialog: ShoeDialog | None = None

    def leave_case(self) -> None:
        """Stop what is read and asked, before another case comes."""
        self._services.jobs.cancel(CHANNEL)
        if self._dialog is not None:
            self._dialog.reject()

    def ask(self) -> None:
        """Let the user choose a shoe."""
        from insole_core.insole.shoes.shoe_sizes import read_shoe_table
        from insole_studio.features.design.shoe.shoe_dialog import ShoeDialog
        from insole_studio.features.design.tools.outline_tool import proposed_size_eu

        foot, design = self._case.foot, self._case.record.design
        if foot is None or design is None or self._dialog is not None:
            return
        usual = proposed_size_eu(self._case.record)
        dialog = ShoeDialog(
            read_shoe_table(), design.outline.shoe, usual,
            lambda shoe: _fit_words(foot, design, shoe), self._services.window,
        )  # fmt: skip
        self._dialog = dialog
        dialog.last_wanted.connect(lambda: self._ask_last(dialog, foot))
        dialog.accepted.connect(lambda: self._take(dialog.shoe()))
        dialog.finished.connect(self._forget)
        dialog.open()

    def ask_size(self) -> float | None:
        """Ask for the size of the shoe of a foot whose length is a guess; None if cancelled."""
        from insole_core.insole.fields import ranges_of
        from insole_core.insole.prescription.outline import Outline

        given = self._services.messages.questions.fields(
            tr("Size of the shoe"),
            tr(
                "Heel or toes of this foot were not scanned: its length is a guess, so no size is "
                "proposed. Put in the EU size of the shoe."
            ),
            [Field("size", tr("EU size"))],
        )
        if given is None:
            return None
        sizes = ranges_of(Outline)["shoe_size_eu"]
        try:
            size = float(given["size"].replace(",", "."))
        except ValueError:
            size = math.nan
        if not sizes.least <= size <= sizes.greatest:
            refused = InputError(
                '"{text}" is no size of a shoe from {least:g} to {greatest:g}; the outline stays '
                "as it is.",
                text=given["size"], least=sizes.least, greatest=sizes.greatest,
            )  # fmt: skip
            self._services.messages.show_error(refused)
            return None
        return size

    def _forget(self) -> None:
        self._services.jobs.cancel(CHANNEL)
        self._dialog = None

    def _ask_last(self, dialog: ShoeDialog, foot: Foot) -> None:
        from insole_core.workflows.shoe_choice import shoe_of_last

        questions = self._services.messages.questions.on(dialog)
        path = questions.file_to_open(surface_kinds(), Kept.SCANS)
        if path is None:
            return

        def read(_progress: Progress) -> Shoe:
            return shoe_of_last(path, foot.side)

        def refuse(error: Exception) -> None:
            if isinstance(error, InsoleError):
                dialog.refuse_last(str(error))
            else:
                self._services.messages.show_error(error, dialog)

        self._services.jobs.start(CHANNEL, read, dialog.show_last, refuse)

    def _take(self, shoe: Shoe | None) -> None:
        from insole_core.workflows.shoe_choice import with_shoe

        design = self._case.record.design
        if design is not None and design.outline.shoe != shoe:
            self._case.apply(with_shoe(design, shoe), tr("Choose the shoe"))


def _fit_words(foot: Foot, design: InsoleDesign, shoe: Shoe) -> list[str]:
    """Say where the insole is wider than a shoe, and what else is unusual."""
    from insole_core.foot.landmarks import find_landmarks
    from insole_core.insole.warnings.shoe_warnings import warnings_in_shoe
    from insole_core.workflows.shoe_choice import with_shoe

    found = warnings_in_shoe(foot, with_shoe(design, shoe), find_landmarks(foot))
    return [one.sentence for one in found]
