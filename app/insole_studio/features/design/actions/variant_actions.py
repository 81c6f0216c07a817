"""Actions on the variants of a prescription: duplicate, name, choose, delete."""

from __future__ import annotations

from insole_core.cases.case_record import FootRecord, Variant
from insole_studio.document.case import Case
from insole_studio.document.case_names import choose_variant, next_name
from insole_studio.features.design.actions.lost_corrections import may_replace
from insole_studio.services.user_messages import UserMessages
from insole_studio.texts import tr


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
