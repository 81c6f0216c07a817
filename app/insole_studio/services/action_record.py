"""What an action is."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from insole_studio.app.action_context import ActionContext


@dataclass(frozen=True)
class ActionRecord:
    """One thing the user can do.

    Parameters
    ----------
    key
        Unique name.
    text
        For the menu, in the language of the window when called; likewise `tip`.
    run
        What it does; toggles and choices get their new state.
    icon
        Name in `widgets.icons`; empty for none.
    shortcut
        Qt's portable form; empty for none.
    checkable
        Whether it is on or off.
    group
        Of the actions of one group exactly one is on.
    needs_foot
        Whether it makes sense only with a foot on the bench.
    needs_both
        Whether it makes sense only with two feet in the case.
    short
        A shorter text for the toolbar; by default `text`.
    """

    key: str
    text: Callable[[], str]
    tip: Callable[[], str]
    run: Callable[[ActionContext, bool], object]
    icon: str = ""
    shortcut: str = ""
    checkable: bool = False
    group: str = ""
    needs_foot: bool = False
    needs_both: bool = False
    short: Callable[[], str] | None = None
