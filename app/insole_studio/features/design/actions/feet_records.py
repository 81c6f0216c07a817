"""Action table of the two feet and the variants."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from insole_core.geometry.side import Side
from insole_studio.document.side_by_side import Beside
from insole_studio.services.action_record import ActionRecord
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
