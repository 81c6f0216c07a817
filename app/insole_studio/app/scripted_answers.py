"""Answers given beforehand, for a window that no user sits before."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from PySide6.QtWidgets import QWidget

from insole_core.geometry.side import Side
from insole_studio.services.questions import Answer, Questions, SameSide


@dataclass
class ScriptedAnswers:
    """What is answered; may be changed between two steps.

    Parameters
    ----------
    unsaved
        What to do with unsaved work when another case is opened.
    same_side
        What to do with a second scan of a foot that the case has.
    side
        Of a mesh; None does not open it.
    anyway
        Whether to go on although a sentence speaks against it.
    replace
        Whether files may be replaced.
    typed
        A line of text; None for never mind.
    path
        A file or folder to open or to write; None for never mind.
    """

    unsaved: Answer = Answer.DISCARD
    same_side: SameSide = SameSide.REPLACE
    side: Side | None = None
    anyway: bool = False
    replace: bool = False
    typed: str | None = None
    path: Path | None = None


class AnsweredQuestions(Questions):
    """Asks nobody."""

    def __init__(self, parent: QWidget, answers: ScriptedAnswers) -> None:
        super().__init__(parent)
        self.answers = answers

    def which_side(self, _path: Path) -> Side | None:
        """Give the side."""
        return self.answers.side

    def open_anyway(self, _sentence: str) -> bool:
        """Tell whether to go on."""
        return self.answers.anyway

    def about_unsaved(self, _name: str) -> Answer:
        """Tell what becomes of unsaved work."""
        return self.answers.unsaved

    def about_same_side(self, _side: Side) -> SameSide:
        """Tell what becomes of a second scan."""
        return self.answers.same_side

    def text(self, _title: str, _question: str, _value: str) -> str | None:
        """Give the line of text."""
        return self.answers.typed

    def may_replace(self, _paths: Sequence[Path]) -> bool:
        """Tell whether files may be replaced."""
        return self.answers.replace

    def folder_to_open(self) -> Path | None:
        """Give the path."""
        return self.answers.path

    def file_to_open(self, _kinds: str) -> Path | None:
        """Give the path."""
        return self.answers.path

    def file_to_write(self, _suggestion: str, _kinds: str) -> Path | None:
        """Give the path."""
        return self.answers.path
