"""Undo, redo, the tool in the hand, and what is selected."""

from __future__ import annotations

from insole_studio.document.case import Case
from insole_studio.features.design.tools.posting_tool import posting_of
from insole_studio.features.design.tools.tool_controller import ToolController
from insole_studio.texts import tr


class EditActions:
    """What the Edit and Tools menus do."""

    def __init__(self, case: Case, tool_controller: ToolController) -> None:
        self._case = case
        self._tool_controller = tool_controller

    def undo(self) -> None:
        """Take the gesture or the last step back."""
        if not self._tool_controller.cancel():
            self._case.undo()

    def redo(self) -> None:
        """Do the last undone step again."""
        self._tool_controller.cancel()
        self._case.redo()

    def remove_selected(self) -> None:
        """Take the selected correction out."""
        design, selected = self._case.record.design, self._case.selection
        if design is not None and selected is not None:
            self._case.apply(design.with_removed(selected), tr("Remove a correction"))

    def take_tool(self, key: str) -> None:
        """Take a tool into the hand; pronation shows its own values, not those of the last pad."""
        design = self._case.record.design
        if key == "posting" and design is not None:
            posting = posting_of(design)
            self._case.select(None if posting is None else posting.id)
        self._tool_controller.take(key)
