"""Names: of the open case, for the title and as a file name, and of the variants."""

from __future__ import annotations

import re
from itertools import count
from string import ascii_uppercase

from insole_core.cases.case_record import CaseRecord, FootRecord
from insole_core.geometry.side import Side
from insole_core.visible_text import visible_line
from insole_studio.document.case import Case
from insole_studio.texts import tr

_AUTOMATIC = 2
"""Characters of the longest name that is given by itself, such as "B" or "12"."""


def case_name(case: Case) -> str:
    """Return the name of the case's file, or of its patient."""
    if case.path is not None:
        return visible_line(case.path.stem)
    return case.record.patient.name or tr("New case")


def title_of(case: Case) -> str:
    """Return the name of the case for the title of the window."""
    name = case_name(case)
    return tr("{name} (read-only)").format(name=name) if case.is_read_only else name


def file_stem(case: Case) -> str:
    """Return a suggested name for a file of the whole case, with the side if it has one foot."""
    return foot_stem(case) if len(case.record.feet) == 1 else _name_or(case, tr("Insole").lower())


def foot_stem(case: Case) -> str:
    """Return a suggested name for a file of the active foot, with its side.

    Both hold the patient's name, so that neither is for a file that goes to the workshop.
    """
    name, side = _name_or(case, tr("Insole").lower()), case.side
    if side is None:
        return name
    word = tr("left") if side is Side.LEFT else tr("right")
    words = re.findall(r"[^\W_]+", name.casefold())
    return name if {side.value, word} & set(words) else f"{name}-{word}"


def _name_or(case: Case, otherwise: str) -> str:
    return case_name(case) if case.record.patient.name or case.path else otherwise


def whose(record: CaseRecord) -> str:
    """Return whose case it is, and which foot."""
    side = {Side.LEFT: tr("LEFT foot"), Side.RIGHT: tr("RIGHT foot")}
    foot = record.current
    words = (
        record.patient.name,
        side[foot.side] if foot is not None else "",
        variant_title(foot.chosen) if foot is not None and len(foot.variants) > 1 else "",
    )
    return "  ·  ".join(word for word in words if word)


def variant_title(name: str) -> str:
    """Return what a variant is called where it is not plain that it is one."""
    return tr("Variant {name}").format(name=name)


def variant_heading(name: str) -> str:
    """Return what stands over a variant: its name, if that alone says that it is one."""
    return name if len(name) > _AUTOMATIC else variant_title(name)


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
