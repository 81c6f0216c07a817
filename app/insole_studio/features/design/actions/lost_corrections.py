"""Asks before a prescription that takes the place of another one costs it corrections."""

from __future__ import annotations

from collections import Counter

from insole_core.geometry.side import Side
from insole_core.insole.prescription.design import InsoleDesign
from insole_studio.features.design.correction_names import name_of
from insole_studio.services.questions import Questions
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
