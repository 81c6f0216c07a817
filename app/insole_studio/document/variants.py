"""Names of variants, and the chosen one."""

from __future__ import annotations

from itertools import count
from string import ascii_uppercase

from insole_core.cases.case_record import FootRecord
from insole_studio.document.case import Case
from insole_studio.texts import tr


def choose_variant(case: Case, name: str) -> None:
    """Choose another prescription for the active foot, as an undo step."""
    foot = case.record.current
    if foot is not None and name != foot.chosen:
        case.apply(foot.with_chosen(name), tr("Choose variant {name}").format(name=name))


def next_name(foot: FootRecord) -> str:
    """Return the first letter that names no variant yet; after Z, numbers."""
    taken = {variant.name for variant in foot.variants}
    letters = (letter for letter in ascii_uppercase if letter not in taken)
    numbers = (str(number) for number in count(1) if str(number) not in taken)
    return next(letters, None) or next(numbers)
