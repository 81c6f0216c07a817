"""Answers to the questions of the window, for tests that do not show them."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from insole_core.geometry.side import Side
from insole_studio.services.files import Kept
from insole_studio.services.questions import (
    Answer,
    InUse,
    Namesake,
    OtherFoot,
    SameSide,
    Unsaved,
)
from insole_studio.widgets.form_parts import Field


class CannedQuestions:
    """Answers without asking; a test sets what."""

    def __init__(self) -> None:
        self.anyway = False
        self.unsaved = Answer.DISCARD
        self.replace = True
        self.same_side = SameSide.CANCEL
        self.namesake = Namesake.ANOTHER
        self.typed: str | None = None
        self.given: dict[str, str] | None = None
        self.path: Path | None = None
        self.asked: list[str] = []

    def on(self, _window: object) -> CannedQuestions:
        return self

    def open_anyway(self, sentence: str) -> bool:
        self.asked.append(sentence)
        return self.anyway

    def may_open_newer(self) -> bool:
        return self.open_anyway("newer")

    def make_alone(self, sentence: str, _side: Side) -> bool:
        return self.open_anyway(sentence)

    def about_unsaved(self, _name: str) -> Answer:
        self.asked.append("unsaved")
        return self.unsaved

    def about_other_foot(self, sentence: str, _shown: Side) -> OtherFoot:
        return OtherFoot.INSIST if self.open_anyway(sentence) else OtherFoot.CANCEL

    def use_unfinished(self, sentence: str) -> bool:
        return self.open_anyway(sentence)

    def about_result(self, step: str) -> Answer:
        self.asked.append(f"result {step}")
        return self.unsaved

    def about_same_side(self, _side: Side, order: str = "") -> SameSide:
        self.asked.append(f"same side {order}".strip())
        return self.same_side

    def about_case_in_use(self, sentence: str) -> InUse:
        self.asked.append(sentence)
        return InUse.CANCEL

    def about_namesake(self, person: str, _same: str, _another: str) -> Namesake:
        self.asked.append(person)
        return self.namesake

    def about_failed_save(self, sentence: str) -> Unsaved:
        self.asked.append(sentence)
        return Unsaved.GO_ON

    about_changed_file = about_failed_save

    def text(self, _title: str, _question: str, _value: str) -> str | None:
        return self.typed

    def fields(self, _title: str, sentence: str, fields: Sequence[Field]) -> dict[str, str] | None:
        self.asked.append(sentence)
        shown = {field.key: field.value for field in fields}
        return None if self.given is None else shown | self.given

    def may_replace_own(self, name: str) -> bool:
        self.asked.append(f"replace {name}")
        return self.replace

    def may_discard(self, name: str) -> bool:
        self.asked.append(f"discard {name}")
        return self.unsaved is Answer.DISCARD

    def may_lose_corrections(self, sentence: str) -> bool:
        self.asked.append(sentence)
        return self.replace

    def may_remove_sample(self) -> bool:
        self.asked.append("remove sample")
        return self.unsaved is Answer.DISCARD

    def may_delete_photo(self) -> bool:
        self.asked.append("delete photo")
        return self.unsaved is Answer.DISCARD

    def folder_to_open(self, _title: str, _kept: Kept) -> Path | None:
        return self.path

    def file_to_open(self, _kinds: str, _kept: Kept) -> Path | None:
        return self.path

    def may_replace(self, _paths: object) -> bool:
        return True

    def file_to_write(self, _suggestion: str, _kinds: str, _kept: Kept) -> Path | None:
        return self.path

    name_to_write = file_to_write
