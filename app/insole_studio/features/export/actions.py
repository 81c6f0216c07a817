"""The actions of the export feature."""

from __future__ import annotations

from typing import TYPE_CHECKING

from insole_studio.services.action_record import ActionRecord
from insole_studio.texts import tr

if TYPE_CHECKING:
    from insole_studio.features.export.export_actions import ExportActions


EXPORT_ACTIONS: tuple[ActionRecord[ExportActions], ...] = (
    ActionRecord(
        "export",
        lambda: tr("Check & export…").replace("&", "&&"),
        lambda: tr("Check the insole and write it for the shop, with its papers"),
        lambda exporter, _on: exporter.open(),
        icon="export",
        shortcut="Ctrl+E",
        needs_foot=True,
    ),
    ActionRecord(
        "print_outline",
        lambda: tr("Print outline 1:1…"),
        lambda: tr("Write the outline of the insole in true size as a PDF"),
        lambda exporter, _on: exporter.ask_print_outline(),
        shortcut="Ctrl+P",
        needs_foot=True,
    ),
    ActionRecord(
        "verify_order",
        lambda: tr("Verify order…"),
        lambda: tr("Say whether the files of an order are as they were written"),
        lambda exporter, _on: exporter.ask_verify_order(),
    ),
)
