"""The action that opens the compare stage."""

from __future__ import annotations

from typing import TYPE_CHECKING

from insole_studio.services.action_record import ActionRecord
from insole_studio.texts import tr

if TYPE_CHECKING:
    from insole_studio.features.compare.compare_window import CompareWindow


COMPARE_ACTIONS: tuple[ActionRecord[CompareWindow], ...] = (
    ActionRecord(
        "compare",
        lambda: tr("Compare surfaces…"),
        lambda: tr("How far feet, insoles and scans of moulds differ"),
        lambda window, _on: window.open(),
    ),
)
