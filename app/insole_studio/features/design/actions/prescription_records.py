"""Action table of corrections, landmarks, measures and templates."""

from __future__ import annotations

from typing import TYPE_CHECKING

from insole_core.insole.elements import Correction, in_order
from insole_studio.services.action_record import ActionRecord
from insole_studio.texts import tr, translate_core_message

if TYPE_CHECKING:
    from insole_studio.features.design.design import Design


def _added(kind: type[Correction]) -> ActionRecord[Design]:
    return ActionRecord(
        f"add_{kind.type}",
        lambda: translate_core_message(kind.name),
        lambda: translate_core_message(kind.tip),
        lambda design, _on: design.prescription.prescribe(kind.usual()),
        needs_foot=True,
    )


PRESCRIPTION_ACTIONS: tuple[ActionRecord[Design], ...] = (
    ActionRecord(
        "choose_device",
        lambda: tr("Device or finding…"),
        lambda: tr("Choose a device, a base form, or what is proposed for a finding"),
        lambda design, _on: design.devices.open(),
        icon="device",
        shortcut="Ctrl+F",
        needs_foot=True,
    ),
    ActionRecord(
        "toggle_as_scanned",
        lambda: tr("As scanned / designed"),
        lambda: tr("Change between the imprint of the foot and the designed device"),
        lambda design, _on: design.devices.toggle_as_scanned(),
        shortcut="Y",
        needs_foot=True,
    ),
    ActionRecord(
        "edit_materials",
        lambda: tr("Table of materials…"),
        lambda: tr("Change least and usual thickness of the clinic's materials"),
        lambda design, _on: design.devices.table.open(),
    ),
    ActionRecord(
        "choose_shoe",
        lambda: tr("Shoe…"),
        lambda: tr("Choose the shoe by size or last, see where the insole is wider, and trim it"),
        lambda design, _on: design.shoe.ask(),
        needs_foot=True,
    ),
    *(_added(kind) for kind in in_order() if kind.tip),
    ActionRecord(
        "add_arch_height",
        lambda: tr("Arch to a height"),
        lambda: tr("Prescribe the height of the finished arch and its place"),
        lambda design, _on: design.prescription.prescribe_arch_height(),
        needs_foot=True,
    ),
    ActionRecord(
        "confirm_landmarks",
        lambda: tr("Confirm landmarks"),
        lambda: tr("Take all landmarks as they are shown"),
        lambda design, _on: design.prescription.confirm_landmarks(),
        shortcut="Ctrl+K",
        needs_foot=True,
    ),
    ActionRecord(
        "find_landmarks",
        lambda: tr("Find landmarks anew"),
        lambda: tr("Forget the landmarks that were set by hand"),
        lambda design, _on: design.prescription.find_landmarks(),
        needs_foot=True,
    ),
    ActionRecord(
        "copy_measures",
        lambda: tr("Copy the measures"),
        lambda: tr("Put the table of measures onto the clipboard"),
        lambda design, _on: design.measures.copy(),
        shortcut="Ctrl+Shift+M",
        needs_foot=True,
    ),
    ActionRecord(
        "save_measures",
        lambda: tr("Save measures as CSV…"),
        lambda: tr("Write the table of measures for a spreadsheet"),
        lambda design, _on: design.measures.ask_save(),
        needs_foot=True,
    ),
    ActionRecord(
        "save_template",
        lambda: tr("Save as template…"),
        lambda: tr("Save the prescription without the patient, for other feet"),
        lambda design, _on: design.prescription.ask_save_template(),
        needs_foot=True,
    ),
    ActionRecord(
        "apply_template",
        lambda: tr("Apply template…"),
        lambda: tr("Prescribe what a template holds; one of the other side is mirrored"),
        lambda design, _on: design.prescription.ask_apply_template(),
        needs_foot=True,
    ),
    ActionRecord(
        "repeat_design",
        lambda: tr("Repeat the design of a case…"),
        lambda: tr("Prescribe on this scan what an earlier case prescribes"),
        lambda design, _on: design.prescription.ask_repeat_design(),
        needs_foot=True,
    ),
    ActionRecord(
        "author",
        lambda: tr("Who prescribes…"),
        lambda: tr("The name that stands in every correction"),
        lambda design, _on: design.prescriber.ask(),
    ),
)
