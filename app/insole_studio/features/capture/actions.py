"""The action that opens the capture stage."""

from __future__ import annotations

from typing import TYPE_CHECKING

from insole_studio.services.action_record import ActionRecord
from insole_studio.texts import tr

if TYPE_CHECKING:
    from insole_studio.features.capture.capture_window import CaptureWindow


CAPTURE_ACTIONS: tuple[ActionRecord[CaptureWindow], ...] = (
    ActionRecord(
        "capture",
        lambda: tr("Capture…"),
        lambda: tr("Capture a foot with the sensors"),
        lambda window, _on: window.open(),
        icon="capture",
        shortcut="Ctrl+Shift+C",
    ),
)
