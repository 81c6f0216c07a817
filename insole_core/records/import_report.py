"""The report of an import as a table for a spreadsheet."""

from __future__ import annotations

import csv
import io
from collections import Counter
from collections.abc import Iterable, Sequence
from typing import Protocol

from insole_core.messages import Message, joined
from insole_core.records.person_import import Outcome

_COMMANDS = ("=", "+", "-", "@", "\t", "\r")
"""What a spreadsheet takes for a formula at the beginning of a cell."""


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


def report_csv(headings: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """Return a report as CSV; texts of the imported file in it are never formulas."""
    written = io.StringIO()
    writer = csv.writer(written)
    writer.writerow(headings)
    writer.writerows([_harmless(cell) for cell in row] for row in rows)
    return written.getvalue()


def _harmless(cell: str) -> str:
    return f"'{cell}" if cell.startswith(_COMMANDS) else cell
