"""The names of views in the language of the window."""

from __future__ import annotations

import re
from collections.abc import Iterable

from insole_studio.texts import tr

_USUAL = re.compile(r"(left|right|top|left_top|right_top|middle|far_left|far_right)(?:_(\d+))?")


def view_text(view: str) -> str:
    """Return the name of a view: a known view or burst translated, any other unchanged."""
    match = _USUAL.fullmatch(view)
    if match is None:
        return view
    word = {
        "left": tr("left"),
        "right": tr("right"),
        "top": tr("top"),
        "left_top": tr("left, top"),
        "right_top": tr("right, top"),
        "middle": tr("middle"),
        "far_left": tr("far left"),
        "far_right": tr("far right"),
    }[match[1]]
    return f"{word} {match[2]}" if match[2] else word


def views_text(views: Iterable[str]) -> str:
    """Return the names of several views."""
    return ", ".join(map(view_text, views))
