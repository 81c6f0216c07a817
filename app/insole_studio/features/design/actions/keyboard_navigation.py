"""Navigation by keyboard: to panels, to the parameters, to the next correction."""

from __future__ import annotations

from PySide6.QtWidgets import QApplication, QWidget

from insole_studio.document.case import Case
from insole_studio.features.design.stage import DesignStage
from insole_studio.widgets.number_field import NumberField
from insole_studio.widgets.tab_order import give_focus, tab_stops


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
