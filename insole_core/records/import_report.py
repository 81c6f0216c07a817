"""What an import has made of its rows or files, counted."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Sequence
from typing import Protocol

from insole_core.messages import Message, joined
from insole_core.records.person_import import Outcome


class Outcomes(Protocol):
    """What becomes of something that is imported."""

    @property
    def outcome(self) -> Outcome:
        """Whether it is added."""


def count_outcomes(lines: Iterable[Outcomes]) -> Message:
    """Return how many there are of each outcome: "3 new, 1 refused"."""
    counts = Counter(line.outcome for line in lines)
    return joined(
        Message("{count} {outcome}", count=counts[outcome], outcome=str(outcome))
        for outcome in Outcome
        if counts[outcome]
    )


def count_added(lines: Sequence[Outcomes], *, with_doubtful: bool) -> Message:
    """Return how many an import has added, and the outcomes: "4 added (3 new, 1 doubtful)".

    Parameters
    ----------
    with_doubtful
        Whether doubtful ones were added.
    """
    added = {Outcome.NEW, Outcome.DOUBTFUL} if with_doubtful else {Outcome.NEW}
    count = sum(line.outcome in added for line in lines)
    return Message("{count} added ({outcomes})", count=count, outcomes=count_outcomes(lines))
