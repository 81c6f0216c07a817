"""The definition of an action."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Generic, TypeVar

Feature = TypeVar("Feature")


@dataclass(frozen=True)
class ActionRecord(Generic[Feature]):
    """One action of the user, contributed by the feature that performs it.

    Parameters
    ----------
    key
        Unique name.
    text
        For the menu, in the language of the window when called; likewise `tip`.
    run
        Called when the action is triggered; toggles and choices receive their new state.
    icon
        Name in `widgets.icons`; empty for none.
    shortcut
        Qt's portable form; empty for none.
    other_shortcut
        One that does the same, for users of programs that have it.
    checkable
        Whether it can be on or off.
    group
        Exactly one action of a group is on.
    needs_foot
        Whether it makes sense only with an open foot.
    needs_both
        Whether it makes sense only with two feet in the case.
    everywhere
        Whether its keys hold in the windows of stages too; it brings the main window to the front.
    short
        A shorter text for the toolbar, or for the page that it is about; by default `text`.
    """

    key: str
    text: Callable[[], str]
    tip: Callable[[], str]
    run: Callable[[Feature, bool], object]
    icon: str = ""
    shortcut: str = ""
    other_shortcut: str = ""
    checkable: bool = False
    group: str = ""
    needs_foot: bool = False
    needs_both: bool = False
    everywhere: bool = False
    short: Callable[[], str] | None = None
