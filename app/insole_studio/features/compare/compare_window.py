"""The compare stage in a window of its own, and the action that opens it."""

from __future__ import annotations

from typing import TYPE_CHECKING

from insole_core.cases.case_record import CaseRecord
from insole_studio.services.action_record import ActionRecord
from insole_studio.services.app_services import AppServices
from insole_studio.services.stage_window import StageWindow
from insole_studio.texts import tr

if TYPE_CHECKING:
    from insole_studio.features.compare.stage import CompareStage

COMPARE_ACTIONS: tuple[ActionRecord[CompareWindow], ...] = (
    ActionRecord(
        "compare",
        lambda: tr("Compare surfaces…"),
        lambda: tr("How far feet, insoles and scans of moulds differ"),
        lambda window, _on: window.open(),
    ),
)


class CompareWindow(StageWindow["CompareStage"]):
    """Opens the compare stage for the open case."""

    def __init__(self, services: AppServices) -> None:
        super().__init__(services.window)
        self._services = services
        self._visits: tuple[tuple[str, CaseRecord], ...] = ()

    def open_visits(self, newer: tuple[str, CaseRecord], older: tuple[str, CaseRecord]) -> None:
        """Compare two visits, each given with its name, in place of the open case."""
        self.close()
        self._visits = newer, older
        self.open()

    def make_stage(self) -> CompareStage:
        """Create the stage in the current theme."""
        from insole_studio.features.compare.stage import CompareStage

        services = self._services
        visits, self._visits = self._visits, ()
        return CompareStage(
            services.case,
            services.dark,
            questions=services.messages.questions,
            visits=visits,
        )
