"""Predefined answers to the questions of a window without a user."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from PySide6.QtWidgets import QWidget

from insole_core.geometry.side import Side
from insole_studio.services.file_kinds import complete_name
from insole_studio.services.last_folders import Kept
from insole_studio.services.questions import Answer, InUse, Questions, SameSide, Unsaved
from insole_studio.widgets.fields_dialog import Field


@dataclass
class ScriptedAnswers:
    """The predefined answers; may be changed between two steps.

    Parameters
    ----------
    unsaved
        What to do with unsaved work when another case is opened.
    same_side
        What to do with a second scan of a side that the case already has.
    in_use
        How to open a case that another window has open.
    failed_save
        What to do when a case cannot be saved.
    anyway
        Whether to continue despite a warning.
    replace
        Whether existing files may be overwritten.
    typed
        A line of text; None cancels.
    path
        A file or folder to open or to write; None cancels.
    fields
        Several lines of text by key; None cancels.
    """

    unsaved: Answer = Answer.DISCARD
    same_side: SameSide = SameSide.REPLACE
    in_use: InUse = InUse.CANCEL
    failed_save: Unsaved = Unsaved.GO_ON
    anyway: bool = False
    replace: bool = False
    typed: str | None = None
    path: Path | None = None
    fields: dict[str, str] | None = None


class AnsweredQuestions(Questions):
    """Questions answered from a `ScriptedAnswers`."""

    def __init__(self, parent: QWidget, answers: ScriptedAnswers) -> None:
        super().__init__(parent)
        self.answers = answers

    def on(self, window: QWidget) -> AnsweredQuestions:
        """Return the same answers for another window."""
        return AnsweredQuestions(window, self.answers)

    def open_anyway(self, _sentence: str) -> bool:
        """Return whether to continue."""
        return self.answers.anyway

    def make_alone(self, _sentence: str, _side: Side) -> bool:
        """Return whether to make one foot of two."""
        return self.answers.anyway

    def about_unsaved(self, _name: str) -> Answer:
        """Return what to do with unsaved work."""
        return self.answers.unsaved

    def about_same_side(self, _side: Side) -> SameSide:
        """Return what to do with a second scan of the same side."""
        return self.answers.same_side

    def about_case_in_use(self, _sentence: str) -> InUse:
        """Return how to open a case that another window has open."""
        return self.answers.in_use

    def about_failed_save(self, _sentence: str) -> Unsaved:
        """Return what to do when a case cannot be saved."""
        return self.answers.failed_save

    def about_changed_file(self, _sentence: str) -> Unsaved:
        """Return what to do when the file of a case has changed."""
        return self.answers.failed_save

    def text(self, _title: str, _question: str, _value: str) -> str | None:
        """Return the line of text."""
        return self.answers.typed

    def fields(
        self, _title: str, _sentence: str, _fields: Sequence[Field]
    ) -> dict[str, str] | None:
        """Return the lines of text."""
        return self.answers.fields

    def may_replace(self, _paths: Sequence[Path]) -> bool:
        """Return whether existing files may be overwritten."""
        return self.answers.replace

    def may_replace_own(self, _name: str) -> bool:
        """Return whether a device or form of the clinic may be replaced: if existing files may."""
        return self.answers.replace

    def may_discard(self, _name: str) -> bool:
        """Return whether recovered work may be discarded: if unsaved work is."""
        return self.answers.unsaved is Answer.DISCARD

    def may_lose_corrections(self, _sentence: str) -> bool:
        """Return whether a foot may lose corrections: if unsaved work may be."""
        return self.answers.unsaved is Answer.DISCARD

    def may_remove_sample(self) -> bool:
        """Return whether the sample patient may be removed: if unsaved work may be."""
        return self.answers.unsaved is Answer.DISCARD

    def folder_to_open(self, _title: str, _kept: Kept) -> Path | None:
        """Return the path."""
        return self.answers.path

    def file_to_open(self, _kinds: str, _kept: Kept) -> Path | None:
        """Return the path."""
        return self.answers.path

    def file_to_write(self, suggestion: str, kinds: str, kept: Kept) -> Path | None:
        """Return the completed path, unless a file is there that must not be overwritten."""
        path = self.name_to_write(suggestion, kinds, kept)
        return None if path is None or (path.exists() and not self.answers.replace) else path

    def name_to_write(self, _suggestion: str, kinds: str, _kept: Kept) -> Path | None:
        """Return the path, completed as in the dialog."""
        path = self.answers.path
        return None if path is None else complete_name(path, kinds)
