"""The two feet of a case: choosing the active one, copying between them; and their actions."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import TYPE_CHECKING

from insole_core.cases.case_record import FootRecord
from insole_core.errors import UsageError
from insole_core.geometry.side import Side
from insole_core.insole.elements import Correction
from insole_core.workflows.starting_design import fitted, mirrored_foot, template_of
from insole_studio.document.case import Case
from insole_studio.document.side_by_side import Beside
from insole_studio.features.design.actions.variant_actions import may_replace
from insole_studio.features.design.correction_names import name_of
from insole_studio.services.action_record import ActionRecord
from insole_studio.services.user_messages import UserMessages
from insole_studio.texts import tr

if TYPE_CHECKING:
    from insole_studio.features.design.design import Design


def _beside(
    kind: Beside, text: Callable[[], str], tip: Callable[[], str], shortcut: str
) -> ActionRecord[Design]:
    return ActionRecord(
        f"beside_{kind.value}",
        text,
        tip,
        lambda design, on: design.side_by_side.show_beside(kind) if on else None,
        shortcut=shortcut,
        checkable=True,
        group="beside",
        needs_foot=True,
    )


FEET_ACTIONS: tuple[ActionRecord[Design], ...] = (
    ActionRecord(
        "foot_other",
        lambda: tr("The other foot"),
        lambda: tr("Work on the other foot of the case"),
        lambda design, _on: design.feet.take_other(),
        shortcut="X",
        needs_foot=True,
    ),
    ActionRecord(
        "foot_left",
        lambda: tr("Left foot"),
        lambda: tr("Work on the left foot"),
        lambda design, _on: design.feet.take(Side.LEFT),
        shortcut="Ctrl+1",
        needs_foot=True,
    ),
    ActionRecord(
        "foot_right",
        lambda: tr("Right foot"),
        lambda: tr("Work on the right foot"),
        lambda design, _on: design.feet.take(Side.RIGHT),
        shortcut="Ctrl+2",
        needs_foot=True,
    ),
    _beside(
        Beside.NOTHING,
        lambda: tr("One insole alone"),
        lambda: tr("Show nothing beside the foot at hand"),
        "Ctrl+Shift+0",
    ),
    _beside(
        Beside.FOOT,
        lambda: tr("Both feet side by side"),
        lambda: tr("Show both feet, and both insoles, beside each other"),
        "Ctrl+B",
    ),
    _beside(
        Beside.VARIANT,
        lambda: tr("Two variants side by side"),
        lambda: tr("Show the variant that was chosen before beside the chosen one"),
        "Ctrl+Shift+B",
    ),
    ActionRecord(
        "mirror_foot",
        lambda: tr("Other foot as mirror image"),
        lambda: tr(
            "Make foot and insole of the side that was not scanned by mirroring; it is said"
        ),
        lambda design, _on: design.feet.mirror(),
        needs_foot=True,
    ),
    ActionRecord(
        "copy_to_other",
        lambda: tr("Copy the prescription to the other foot"),
        lambda: tr("Prescribe the same for the other foot, mirrored and fitted by its landmarks"),
        lambda design, _on: design.feet.copy_prescription(),
        icon="mirror",
        shortcut="Ctrl+Shift+X",
        needs_both=True,
    ),
    ActionRecord(
        "copy_selected_to_other",
        lambda: tr("Copy the selected correction to the other foot"),
        lambda: tr("Prescribe it for the other foot as well, mirrored"),
        lambda design, _on: design.feet.copy_selected(),
        needs_both=True,
    ),
    ActionRecord(
        "repeat_last",
        lambda: tr("Repeat the last design"),
        lambda: tr("Prescribe what was prescribed for this foot before"),
        lambda design, _on: design.repeat.repeat(),
        shortcut="Ctrl+R",
        needs_foot=True,
    ),
    ActionRecord(
        "variant_duplicate",
        lambda: tr("Duplicate as a variant"),
        lambda: tr("Go on with a copy of this prescription; the first stays"),
        lambda design, _on: design.variants.duplicate(),
        shortcut="Ctrl+D",
        needs_foot=True,
    ),
    ActionRecord(
        "variant_next",
        lambda: tr("Next variant"),
        lambda: tr("Choose the variant after this one"),
        lambda design, _on: design.variants.choose_next(),
        shortcut="V",
        needs_foot=True,
    ),
    ActionRecord(
        "variant_name",
        lambda: tr("Name the variant…"),
        lambda: tr("Call the chosen variant by another name"),
        lambda design, _on: design.variants.ask_name(),
        needs_foot=True,
    ),
    ActionRecord(
        "variant_delete",
        lambda: tr("Delete the variant"),
        lambda: tr("Leave the chosen variant out; undo brings it back"),
        lambda design, _on: design.variants.delete(),
        needs_foot=True,
    ),
)


class FeetActions:
    """The actions of the Feet menu."""

    def __init__(self, case: Case, messages: UserMessages) -> None:
        self._case = case
        self._messages = messages

    def take(self, side: Side) -> None:
        """Make the foot of a side the active one.

        Raises
        ------
        UsageError
            If the case has no such foot.
        """
        if self._case.record.of_side(side) is None:
            raise UsageError(_missing(side))
        self._case.take_foot(side)

    def take_other(self) -> None:
        """Make the other foot the active one.

        Raises
        ------
        UsageError
            If the case has no other foot.
        """
        side = self._case.side
        if side is not None:
            self.take(side.other)

    def mirror(self) -> None:
        """Make the foot that was not scanned, and its prescription, as a mirror image.

        Raises
        ------
        UsageError
            If the case has both feet.
        """
        foot = self._case.record.current
        assert foot is not None, "the action needs a foot"
        if self._case.record.other is not None:
            raise UsageError(_there(foot.side.other))
        sentence = {
            Side.LEFT: tr("Mirror the right foot to the left"),
            Side.RIGHT: tr("Mirror the left foot to the right"),
        }
        self._case.apply(mirrored_foot(foot, self._case.stamped), sentence[foot.side.other])

    def copy_prescription(self) -> None:
        """Copy the prescription to the other foot, mirrored; ask where that costs corrections.

        Raises
        ------
        UsageError
            If the case has no other foot.
        DesignError
            If landmarks lie in an impossible order.
        """
        foot, other = self._both()
        design = fitted(template_of(foot), other, self._case.stamped)
        sentence = {
            Side.LEFT: tr("Copy the prescription to the left foot"),
            Side.RIGHT: tr("Copy the prescription to the right foot"),
        }
        if may_replace(self._messages.questions, other.design, design):
            self._case.apply(other.with_design(design), sentence[other.side])

    def copy_selected(self) -> None:
        """Copy the selected correction to the other foot, mirrored.

        Raises
        ------
        UsageError
            If the case has no other foot, or no correction is selected.
        DesignError
            If landmarks lie in an impossible order.
        """
        foot, other = self._both()
        selected = self._selected(foot)
        alone = foot.with_design(replace(foot.design, corrections=(selected,)))
        (mirrored,) = fitted(template_of(alone), other, self._case.stamped).corrections
        sentence = {
            Side.LEFT: tr("Copy to the left foot: {name}"),
            Side.RIGHT: tr("Copy to the right foot: {name}"),
        }
        added = other.with_design(other.design.with_added(mirrored))
        self._case.apply(added, sentence[other.side].format(name=name_of(mirrored)))
        self._case.select(mirrored.id)

    def _both(self) -> tuple[FootRecord, FootRecord]:
        foot, other = self._case.record.current, self._case.record.other
        assert foot is not None, "the action needs a foot"
        if other is None:
            raise UsageError(_missing(foot.side.other))
        return foot, other

    def _selected(self, foot: FootRecord) -> Correction:
        selected = foot.design.correction(self._case.selection or "")
        if selected is None:
            raise UsageError(tr("No correction is selected; click on one in the list first."))
        return selected


def _there(side: Side) -> str:
    if side is Side.LEFT:
        return tr("The case has a left foot already; only one that was not scanned is mirrored.")
    return tr("The case has a right foot already; only one that was not scanned is mirrored.")


def _missing(side: Side) -> str:
    if side is Side.LEFT:
        return tr("The case has no left foot yet; open its scan, and it is added.")
    return tr("The case has no right foot yet; open its scan, and it is added.")
