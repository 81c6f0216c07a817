"""The variants of a prescription, and the question before one costs another its corrections."""

from __future__ import annotations

from collections import Counter

from insole_core.cases.case_record import FootRecord, Variant
from insole_core.geometry.side import Side
from insole_core.insole.prescription.design import InsoleDesign
from insole_studio.document.case import Case
from insole_studio.document.case_names import choose_variant, next_name
from insole_studio.features.design.correction_names import name_of
from insole_studio.services.questions import Questions
from insole_studio.services.user_messages import UserMessages
from insole_studio.texts import tr


def may_replace(questions: Questions, before: InsoleDesign, after: InsoleDesign) -> bool:
    """Return whether a whole prescription may take the place of another one.

    The user is asked where a correction would go that the new one has none of: who copies again
    what they have just copied is not.
    """
    names = _lost(before, after)
    if not names:
        return True
    sentence = {
        Side.LEFT: tr("The new prescription has no {names}; the left foot loses that."),
        Side.RIGHT: tr("The new prescription has no {names}; the right foot loses that."),
    }[before.side]
    return questions.may_lose_corrections(sentence.format(names=names))


def _lost(before: InsoleDesign, after: InsoleDesign) -> str:
    """Return the names of the corrections that one design has, and the other one has none of."""
    lost = Counter(map(name_of, before.corrections)) - Counter(map(name_of, after.corrections))
    return ", ".join(f"{count} × {name}" if count > 1 else name for name, count in lost.items())


class VariantActions:
    """The actions on variants; each is one undo step.

    The chosen variant is the one that is shown, checked and exported.
    """

    def __init__(self, case: Case, messages: UserMessages) -> None:
        self._case = case
        self._messages = messages

    def duplicate(self) -> None:
        """Copy the chosen variant under the next free letter, and choose the copy."""
        foot = self._foot
        copy = Variant(next_name(foot), foot.design)
        sentence = tr("Duplicate as variant {name}").format(name=copy.name)
        self._case.apply(foot.with_variant(copy), sentence)

    def choose_next(self) -> None:
        """Choose the variant after the chosen one."""
        foot = self._foot
        names = [variant.name for variant in foot.variants]
        after = (names.index(foot.chosen) + 1) % len(names)
        choose_variant(self._case, names[after])

    def ask_name(self) -> None:
        """Let the user rename the chosen variant.

        Raises
        ------
        DesignError
            If another variant has the name.
        """
        foot = self._foot
        question = tr("What is variant {name} to be called?").format(name=foot.chosen)
        name = self._messages.questions.text(tr("Name the variant"), question, foot.chosen)
        if name:
            sentence = tr("Name the variant {name}").format(name=name)
            self._case.apply(foot.with_name(foot.chosen, name), sentence)

    def delete(self) -> None:
        """Delete the chosen variant; ask where that costs corrections.

        Raises
        ------
        DesignError
            If it is the only one.
        """
        foot = self._foot
        sentence = tr("Delete variant {name}").format(name=foot.chosen)
        left = foot.without_variant(foot.chosen)
        if may_replace(self._messages.questions, foot.design, left.design):
            self._case.apply(left, sentence)

    @property
    def _foot(self) -> FootRecord:
        foot = self._case.record.current
        assert foot is not None, "the action needs a foot"
        return foot
