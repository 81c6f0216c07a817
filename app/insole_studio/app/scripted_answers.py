"""Predefined answers to the questions of a window without a user."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from PySide6.QtWidgets import QWidget

from insole_core.foot.mesh_file import Unit
from insole_core.geometry.side import Side
from insole_studio.services.questions import Answer, Questions, SameSide
from insole_studio.services.scan_dialog import ScanAnswer


@dataclass
class ScriptedAnswers:
    """The predefined answers; may be changed between two steps.

    Parameters
    ----------
    unsaved
        What to do with unsaved work when another case is opened.
    same_side
        What to do with a second scan of a side that the case already has.
    side
        Side of a mesh; None cancels opening it.
    unit
        Of a mesh; None for the one that its size tells.
    anyway
        Whether to continue despite a warning.
    replace
        Whether existing files may be overwritten.
    typed
        A line of text; None cancels.
    path
        A file or folder to open or to write; None cancels.
    """

    unsaved: Answer = Answer.DISCARD
    same_side: SameSide = SameSide.REPLACE
    side: Side | None = None
    unit: Unit | None = None
    anyway: bool = False
    replace: bool = False
    typed: str | None = None
    path: Path | None = None


class AnsweredQuestions(Questions):
    """Questions answered from a `ScriptedAnswers`."""

    def __init__(self, parent: QWidget, answers: ScriptedAnswers) -> None:
        super().__init__(parent)
        self.answers = answers

    def about_scan(self, _path: Path, trouble: str = "") -> ScanAnswer | None:
        """Return side and unit; None when they were wrong."""
        side = self.answers.side
        return None if side is None or trouble else ScanAnswer(side, self.answers.unit)

    def which_side_after_all(self, _sentence: str, asked: Side) -> Side | None:
        """Return the side that was asked for, or None."""
        return asked if self.answers.anyway else None

    def open_anyway(self, _sentence: str) -> bool:
        """Return whether to continue."""
        return self.answers.anyway

    def about_unsaved(self, _name: str) -> Answer:
        """Return what to do with unsaved work."""
        return self.answers.unsaved

    def about_same_side(self, _side: Side) -> SameSide:
        """Return what to do with a second scan of the same side."""
        return self.answers.same_side

    def text(self, _title: str, _question: str, _value: str) -> str | None:
        """Return the line of text."""
        return self.answers.typed

    def may_replace(self, _paths: Sequence[Path]) -> bool:
        """Return whether existing files may be overwritten."""
        return self.answers.replace

    def may_discard(self, _name: str) -> bool:
        """Return whether recovered work may be discarded: if unsaved work is."""
        return self.answers.unsaved is Answer.DISCARD

    def folder_to_open(self) -> Path | None:
        """Return the path."""
        return self.answers.path

    def file_to_open(self, _kinds: str) -> Path | None:
        """Return the path."""
        return self.answers.path

    def file_to_write(self, _suggestion: str, _kinds: str) -> Path | None:
        """Return the path."""
        return self.answers.path
