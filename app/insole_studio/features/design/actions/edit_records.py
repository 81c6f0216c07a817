"""Action table of undo, redo, and the tools."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from insole_studio.services.action_record import ActionRecord
from insole_studio.texts import tr

if TYPE_CHECKING:
    from insole_studio.features.design.design import Design


def _tool(
    key: str,
    text: Callable[[], str],
    tip: Callable[[], str],
    shortcut: str,
    short: Callable[[], str] | None = None,
) -> ActionRecord[Design]:
    return ActionRecord(
        f"tool_{key}",
        text,
        tip,
        lambda design, on: design.edit.take_tool(key) if on else None,
        icon=key,
        shortcut=shortcut,
        checkable=True,
        group="tools",
        needs_foot=True,
        short=short,
    )


EDIT_ACTIONS: tuple[ActionRecord[Design], ...] = (
    ActionRecord(
        "undo",
        lambda: tr("Undo"),
        lambda: tr("Take the last step back"),
        lambda design, _on: design.edit.undo(),
        icon="undo",
        shortcut="Ctrl+Z",
    ),
    ActionRecord(
        "redo",
        lambda: tr("Redo"),
        lambda: tr("Do the last undone step again"),
        lambda design, _on: design.edit.redo(),
        icon="redo",
        shortcut="Ctrl+Shift+Z",
        other_shortcut="Ctrl+Y",
    ),
    ActionRecord(
        "remove",
        lambda: tr("Remove correction"),
        lambda: tr("Take the selected correction out of the design"),
        lambda design, _on: design.edit.remove_selected(),
        icon="remove",
        shortcut="Del",
        needs_foot=True,
    ),
    _tool(
        "orbit",
        lambda: tr("Orbit"),
        lambda: tr("Turn the view; click on a pelott to select it"),
        "O",
    ),
    _tool(
        "key_point", lambda: tr("Landmarks"), lambda: tr("Put right the landmarks of the foot"), "K"
    ),
    _tool(
        "turn",
        lambda: tr("Turn the foot"),
        lambda: tr("Turn the foot by rings; type its angles, or align it by the landmarks"),
        "A",
        lambda: tr("Turn foot"),
    ),
    _tool("pelott", lambda: tr("Pelott"), lambda: tr("Place and shape pelotts"), "P"),
    _tool(
        "free_hand",
        lambda: tr("Free-hand pad"),
        lambda: tr("Draw the outline of a pad on the sole"),
        "D",
        lambda: tr("Free-hand"),
    ),
    _tool(
        "posting",
        lambda: tr("Posting"),
        lambda: tr("Tilt rear- and forefoot by degrees, against pronation or supination"),
        "T",
    ),
    _tool(
        "outline",
        lambda: tr("Outline"),
        lambda: tr("Drag the edge of the insole; from the foot, a shoe's size, or drawn"),
        "U",
    ),
    _tool(
        "rim",
        lambda: tr("Rim"),
        lambda: tr("Shape the rim by its stations, in the views and in the graph below"),
        "E",
    ),
    _tool(
        "brush",
        lambda: tr("Brush"),
        lambda: tr("Raise, lower or smooth the surface with strokes"),
        "B",
    ),
    _tool(
        "plane",
        lambda: tr("Reference plane"),
        lambda: tr("A plane to look at the foot against"),
        "R",
        lambda: tr("Plane"),
    ),
    _tool(
        "section",
        lambda: tr("Section"),
        lambda: tr("Cut the insole and measure its thickness"),
        "S",
    ),
    _tool(
        "tape",
        lambda: tr("Measuring tape"),
        lambda: tr("Measure along the surface and straight, on foot or insole"),
        "Shift+M",
        lambda: tr("Tape"),
    ),
    ActionRecord(
        "next_correction",
        lambda: tr("Select the next correction"),
        lambda: tr("Select what stands below in the list"),
        lambda design, _on: design.navigation.select_next(1),
        shortcut="Ctrl+PgDown",
        needs_foot=True,
    ),
    ActionRecord(
        "previous_correction",
        lambda: tr("Select the correction before"),
        lambda: tr("Select what stands above in the list"),
        lambda design, _on: design.navigation.select_next(-1),
        shortcut="Ctrl+PgUp",
        needs_foot=True,
    ),
    ActionRecord(
        "edit_values",
        lambda: tr("Type the values"),
        lambda: tr("Go to the numbers of what is selected"),
        lambda design, _on: design.navigation.edit_values(),
        shortcut="F2",
        needs_foot=True,
    ),
    ActionRecord(
        "edit_thickness",
        lambda: tr("Type the thickness"),
        lambda: tr("Go to the thickness of the insole, whatever is selected"),
        lambda design, _on: design.navigation.edit_values("insole.thickness_mm"),
        shortcut="Shift+F2",
        needs_foot=True,
    ),
    _tool(
        "plantar",
        lambda: tr("Pressure and footprint"),
        lambda: tr("Move and turn the pressure map or footprint under the foot"),
        "Shift+Q",
        lambda: tr("Pressure"),
    ),
    ActionRecord(
        "lay_pressure",
        lambda: tr("Lay a pressure map or footprint…"),
        lambda: tr("Open a pressure map or a picture of a footprint, and align it to its foot"),
        lambda design, _on: design.plantar.ask(),
        icon="plantar",
        needs_foot=True,
    ),
    ActionRecord(
        "next_panel",
        lambda: tr("Next panel"),
        lambda: tr("Lead the keys to the next panel"),
        lambda design, _on: design.navigation.go_to_panel(1),
        shortcut="F6",
    ),
    ActionRecord(
        "previous_panel",
        lambda: tr("Panel before"),
        lambda: tr("Lead the keys to the panel before"),
        lambda design, _on: design.navigation.go_to_panel(-1),
        shortcut="Shift+F6",
    ),
)
