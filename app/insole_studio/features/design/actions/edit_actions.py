"""Undo, redo, the tools, the selection, and where the keyboard leads; and their actions."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from PySide6.QtWidgets import QApplication, QWidget

from insole_studio.document.case import Case
from insole_studio.features.design.stage import DesignStage
from insole_studio.features.design.tools.posting_tool import posting_of
from insole_studio.features.design.tools.tool_controller import ToolController
from insole_studio.services.action_record import ActionRecord
from insole_studio.texts import tr
from insole_studio.widgets.number_field import NumberField
from insole_studio.widgets.tab_order import give_focus, tab_stops

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


class EditActions:
    """The actions of the Edit and Tools menus."""

    def __init__(self, case: Case, tool_controller: ToolController) -> None:
        self._case = case
        self._tool_controller = tool_controller

    def undo(self) -> None:
        """Cancel the running gesture, or undo the last step of the tool or of the case."""
        if not self._tool_controller.cancel() and not self._tool_controller.take_back():
            self._case.undo()

    def redo(self) -> None:
        """Redo the last undone step."""
        self._tool_controller.cancel()
        self._case.redo()

    def remove_selected(self) -> None:
        """Remove the selected correction."""
        design, selected = self._case.record.design, self._case.selection
        if design is not None and selected is not None:
            self._case.apply(design.with_removed(selected), tr("Remove a correction"))

    def take_tool(self, key: str) -> None:
        """Choose a tool; the posting tool also selects the design's posting, if any."""
        design = self._case.record.design
        if key == "posting" and design is not None:
            posting = posting_of(design)
            self._case.select(None if posting is None else posting.id)
        self._tool_controller.take(key)


class KeyboardNavigation:
    """Moves the focus and the selection."""

    def __init__(self, case: Case, stage: DesignStage) -> None:
        self._case = case
        self._stage = stage
        self._tool_controller = stage.tool_controller

    def go_to_panel(self, step: int) -> None:
        """Move the focus to the next panel, or to the previous one (`step` -1)."""
        panels = [p for p in self._stage.panels if next(tab_stops(p), None) is not None]
        focused = QApplication.focusWidget()
        at = next((n for n, p in enumerate(panels) if _holds(p, focused)), -1 if step > 0 else 0)
        if panels:
            give_focus(next(tab_stops(panels[(at + step) % len(panels)])))

    def edit_values(self, key: str = "") -> None:
        """Move the focus to a number of the parameters, selected to be overwritten.

        Parameters
        ----------
        key
            Of the field; by default it is the first one.
        """
        stops = tab_stops(self._stage.parameters)
        fields = (stop for stop in stops if isinstance(stop, NumberField))
        field = next((f for f in fields if not key or f.property("key") == key), None)
        if field is not None:
            give_focus(field)
            field.selectAll()

    def select_next(self, step: int) -> None:
        """Select the next correction of the list, or the previous one (`step` -1)."""
        design = self._case.record.design
        ids = [c.id for c in design.corrections] if design is not None else []
        if not ids:
            return
        at = ids.index(self._case.selection) if self._case.selection in ids else None
        start = at if at is not None else (-1 if step > 0 else 0)
        self._case.select(ids[(start + step) % len(ids)])

    def go_back(self) -> None:
        """On Escape, focus the view; then let go of what is measured or selected, then the tool."""
        views = (self._stage.foot.scene.surface, self._stage.insole.scene.surface)
        if QApplication.focusWidget() not in views:
            self._stage.focus_view()
        elif self._case.selection is not None:
            self._case.select(None)
        elif not self._tool_controller.take_back(everything=True):
            self._tool_controller.take("orbit")


def _holds(panel: QWidget, focused: QWidget | None) -> bool:
    return focused is not None and (panel is focused or panel.isAncestorOf(focused))
