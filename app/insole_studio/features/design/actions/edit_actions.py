"""Undo, redo, the choice of the tool, and the selection."""

from __future__ import annotations

from insole_studio.document.case import Case
from insole_studio.features.design.tools.posting_tool import posting_of
from insole_studio.features.design.tools.tool_controller import ToolController
from insole_studio.texts import tr


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
