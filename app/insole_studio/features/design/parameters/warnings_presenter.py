"""Presenter of the warnings: checks the insole against the clinic's rules."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, Protocol

from insole_core.insole.clinic_rules import ClinicRules
from insole_core.insole.design_warning import DesignWarning
from insole_core.insole.warnings.design_warnings import design_warnings
from insole_core.workflows.foot_landmarks import landmarks_of
from insole_studio.document.case import Case
from insole_studio.document.insole_preview import InsolePreview
from insole_studio.document.material_model import MaterialModel
from insole_studio.features.design.rows import WarningRow
from insole_studio.features.design.tools.tool_controller import ToolController
from insole_studio.texts import translate_core_message


class WarningsPanel(Protocol):
    """The panel that shows warnings, and emits which one was chosen."""

    warning_chosen: Any

    def show_warnings(self, rows: Sequence[WarningRow]) -> None: ...  # noqa: D102


class WarningsPresenter:
    """Checks the insole whenever it has changed and no gesture is running."""

    def __init__(
        self,
        panel: WarningsPanel,
        *,
        case: Case,
        surface: InsolePreview,
        tool_controller: ToolController,
        rules: ClinicRules,
        materials: MaterialModel,
        look_at: Callable[[tuple[float, float]], None],
    ) -> None:
        self._panel = panel
        self._case = case
        self._surface = surface
        self._tool_controller = tool_controller
        self._rules = rules
        self._materials = materials
        self._look_at = look_at
        self._warnings: tuple[DesignWarning, ...] = ()
        panel.warning_chosen.connect(self.lead_to)
        surface.changed.connect(self.show)
        case.changed.connect(self.show)
        tool_controller.gesture_ended.connect(self.show)
        materials.changed.connect(self.show)

    def show(self) -> None:
        """Show the current warnings."""
        if self._tool_controller.is_busy:
            return
        self._warnings = self._found()
        self._panel.show_warnings(
            [
                WarningRow(translate_core_message(w.sentence), bool(w.correction_id or w.place_mm))
                for w in self._warnings
            ]
        )

    def lead_to(self, number: int) -> None:
        """Select the cause of a warning, and centre the views on it."""
        warning = self._warnings[number]
        if warning.correction_id:
            self._case.select(warning.correction_id)
        if warning.place_mm is not None:
            self._look_at(warning.place_mm)

    def _found(self) -> tuple[DesignWarning, ...]:
        record, insole = self._case.record, self._surface.insole
        if record.design is None or self._surface.base is None:
            return ()
        if insole is None:
            return self._warnings
        return design_warnings(insole, landmarks_of(record), self._rules, self._materials.table)
