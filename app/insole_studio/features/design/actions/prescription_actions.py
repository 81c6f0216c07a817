"""The Prescribe menu: corrections, landmarks, measures, templates; and their actions."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from insole_core.cases.case_file import read_case
from insole_core.cases.case_record import FootRecord
from insole_core.errors import InputError
from insole_core.files.atomic import replacing_file
from insole_core.foot.landmarks import find_landmarks
from insole_core.geometry.rounding import rounded
from insole_core.geometry.side import Side
from insole_core.insole.elements import ArchRaise, Correction, in_order, new_id
from insole_core.insole.elements.pad_places import placed_pad
from insole_core.insole.fields import ranges_of
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.prescription.template import (
    make_template,
    read_template,
    write_template,
)
from insole_core.workflows.foot_landmarks import confirmed, found_anew, landmarks_of
from insole_core.workflows.pad_library import LibraryPad
from insole_core.workflows.starting_design import fitted, template_of
from insole_studio.document.case import Case
from insole_studio.features.design.actions.variant_actions import may_replace
from insole_studio.features.design.correction_names import name_of
from insole_studio.features.design.tools.pelott_tool import PelottTool
from insole_studio.features.design.tools.tool_controller import ToolController
from insole_studio.services.action_record import ActionRecord
from insole_studio.services.files import TEMPLATE_SUFFIX, Kept, case_kinds, template_kinds
from insole_studio.services.user_messages import LONG_MS, UserMessages
from insole_studio.texts import tr, translate_core_message

if TYPE_CHECKING:
    from insole_studio.features.design.design import Design

_ABOVE_ARCH_MM = 3.0


class PrescriptionActions:
    """The actions of the Prescribe menu."""

    def __init__(
        self,
        case: Case,
        tool_controller: ToolController,
        pads: Sequence[LibraryPad],
        behind_heads_mm: float,
        messages: UserMessages,
    ) -> None:
        self._case = case
        self._tool_controller = tool_controller
        self._pads = pads
        self._behind_heads_mm = behind_heads_mm
        self._messages = messages

    def prescribe(self, correction: Correction) -> None:
        """Add a correction and show its values."""
        design = self._case.record.design
        if design is None:
            return
        new = self._case.stamped(correction)
        self._case.apply(design.with_added(new), tr("Add: {name}").format(name=name_of(new)))
        self._case.select(new.id)

    def prescribe_arch_height(self) -> None:
        """Add an arch raise to a height, by default a little above the foot's own arch."""
        foot, design = self._case.foot, self._case.record.design
        if foot is None or design is None:
            return
        x, y, z = (float(part) for part in find_landmarks(foot)["arch_apex"].point)
        height = rounded(z + design.least_thickness_mm + _ABOVE_ARCH_MM, 0.5)
        target = ranges_of(ArchRaise)["target_mm"].nearest(height)
        self.prescribe(ArchRaise(target_mm=target, apex_mm=(round(x, 1), round(y, 1))))

    def take_pad(self, number: int) -> None:
        """Add a pad of the library at its usual place, and choose the pad tool."""
        tool, pad = self._tool_controller.tools["pelott"], self._pads[number]
        design, side = self._case.record.design, self._case.side
        assert isinstance(tool, PelottTool)
        self._tool_controller.take("pelott")
        if design is None or side is None:
            return
        landmarks = landmarks_of(self._case.record)
        laid = placed_pad(pad.template, pad.place, side, landmarks, self._behind_heads_mm)
        tool.template = laid
        new = self._case.stamped(replace(laid, id=new_id()))
        self._case.apply(design.with_added(new), tr("Place: {name}").format(name=name_of(new)))
        self._case.select(new.id)

    def ask_save_template(self) -> None:
        """Let the user choose a file, and save the template."""
        path = self._messages.questions.file_to_write(
            f"{tr('template')}{TEMPLATE_SUFFIX}", template_kinds(), Kept.CASES
        )
        if path is not None and self._case.record.design is not None:
            save_template(self._case, path)
            self._messages.say(tr("Written: {name}").format(name=path.name))

    def ask_apply_template(self) -> None:
        """Let the user choose a template, and apply it."""
        path = self._messages.questions.file_to_open(template_kinds(), Kept.CASES)
        if path is not None and self._case.record.design is not None:
            template, foot = read_template(path), _foot_of(self._case)
            design = fitted(template, foot, self._case.stamped)
            if not self._replace(design, tr("Apply a template")):
                return
            if template.design.side is not foot.side:
                self._messages.say(_mirrored_sentence(foot.side), LONG_MS)

    def ask_repeat_design(self) -> None:
        """Let the user choose an earlier case, and repeat its design."""
        path = self._messages.questions.file_to_open(case_kinds(), Kept.CASES)
        if path is not None and self._case.record.design is not None:
            design = design_of_case(self._case, path)
            self._replace(design, tr("Repeat the design of an earlier case"))

    def _replace(self, design: InsoleDesign, sentence: str) -> bool:
        """Put a whole prescription in the place of the present one, unless that is to stay."""
        before = _foot_of(self._case).design
        may = may_replace(self._messages.questions, before, design)
        if may:
            self._case.apply(design, sentence)
        return may

    def confirm_landmarks(self) -> None:
        """Confirm all landmarks at their current positions."""
        self._case.apply(confirmed(self._case.record), tr("Confirm the landmarks"))
        self._messages.say(tr("All landmarks are confirmed where they stand."), LONG_MS)

    def find_landmarks(self) -> None:
        """Discard manually placed landmarks, so that they are detected again."""
        anew = found_anew(self._case.record.annotations)
        self._case.apply(anew, tr("Find the landmarks anew"))


def save_template(case: Case, path: Path) -> None:
    """Write the prescription as a template, with the landmarks it refers to.

    Raises
    ------
    DesignError
        If the landmarks lie in an impossible order.
    OutputError
        If the file cannot be written.
    """
    design = case.record.design
    assert design is not None
    plain = tuple(replace(c, author="", created_at="") for c in design.corrections)
    anonymous = replace(design, corrections=plain)
    template = make_template(path.stem, anonymous, landmarks_of(case.record))
    with replacing_file(path) as beside:
        write_template(template, beside)


def _mirrored_sentence(side: Side) -> str:
    if side is Side.LEFT:
        return tr("The template was made for a right foot; it is mirrored for this left one.")
    return tr("The template was made for a left foot; it is mirrored for this right one.")


def design_of_case(case: Case, path: Path) -> InsoleDesign:
    """Read another case's prescription for the active foot; one for its other foot is mirrored.

    Parameters
    ----------
    case
        The open case.
    path
        File of the other case.

    Raises
    ------
    InputError
        If the file is not a case.
    DesignError
        If it contains no prescription.
    """
    earlier, foot = read_case(path), _foot_of(case)
    source = earlier.of_side(foot.side) or earlier.current
    if source is None:
        raise InputError(
            "{path} holds no prescription yet; choose a case with a design.", path=path
        )
    return fitted(template_of(source), foot, case.stamped)


def _foot_of(case: Case) -> FootRecord:
    assert case.record.current is not None, "the action needs a foot"
    return case.record.current


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
        "print_measures",
        lambda: tr("Print the measures…"),
        lambda: tr("Write the measures with their ±, and a drawing of the angles, as PDF"),
        lambda design, _on: design.measures.ask_sheet(),
        needs_foot=True,
    ),
    ActionRecord(
        "explain_angles",
        lambda: tr("Angles of the feet…"),
        lambda: tr("Draw what rearfoot angle, Achilles to sole and Achilles lean are"),
        lambda design, _on: design.measures.explain_angles(),
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
