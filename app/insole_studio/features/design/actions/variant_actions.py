"""Several prescriptions for the same foot: duplicate, name, choose, delete."""

from __future__ import annotations

from insole_core.cases.case_record import FootRecord, Variant
from insole_studio.document.case import Case
from insole_studio.document.variants import choose_variant, next_name
from insole_studio.services.user_messages import UserMessages
from insole_studio.texts import tr


class VariantActions:
    """Every step is one of undo; the chosen variant is the one that is shown, checked and made."""

    def __init__(self, case: Case, messages: UserMessages) -> None:
        self._case = case
        self._messages = messages

    def duplicate(self) -> None:
        """Go on with a copy of the chosen variant, under the next free letter."""
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
        """Let the user name the chosen variant.

        Raises
        ------
        DesignError
            When another has the name.
        """
        foot = self._foot
        question = tr("What is variant {name} to be called?").format(name=foot.chosen)
        name = self._messages.questions.text(tr("Name the variant"), question, foot.chosen)
        if name:
            sentence = tr("Name the variant {name}").format(name=name)
            self._case.apply(foot.with_name(foot.chosen, name), sentence)

    def delete(self) -> None:
        """Leave the chosen variant out.

        Raises
        ------
        DesignError
            When it is the only one.
        """
        foot = self._foot
        sentence = tr("Delete variant {name}").format(name=foot.chosen)
        self._case.apply(foot.without_variant(foot.chosen), sentence)

    @property
    def _foot(self) -> FootRecord:
        foot = self._case.record.current
        assert foot is not None, "the action needs a foot"
        return foot
