"""Which backups are kept, and which ones go (decision 0044)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from datetime import datetime, timedelta
from typing import Final

from insole_core.records.backup.backup_folder import KnownSnapshot, SnapshotName

ALL_OF_DAYS: Final = 30


@dataclass(frozen=True)
class KeepRule:
    """All backups of the last days, then the last good one of each month.

    Parameters
    ----------
    days
        So many of the newest ones stay in any case, also if the clock says that they are old.
    months
        With backups, for how many one is kept; None for all.
    """

    days: int = ALL_OF_DAYS
    months: int | None = None


def superfluous(
    snapshots: Sequence[KnownSnapshot], rule: KeepRule, now: datetime
) -> list[SnapshotName]:
    """Return the snapshots that go by a rule; the newest good one never does.

    Parameters
    ----------
    now
        With its time zone.
    """
    newest_first = sorted(snapshots, key=lambda known: known.name.number, reverse=True)
    since = now - timedelta(days=rule.days)
    kept = {known.name for known in newest_first[: rule.days]}
    kept.update(known.name for known in newest_first if known.name.made_at > since)
    kept.update([known.name for known in newest_first if known.is_good][:1])
    kept.update(_of_months(newest_first)[: rule.months])
    return [known.name for known in newest_first if known.name not in kept]


def _of_months(newest_first: Sequence[KnownSnapshot]) -> list[SnapshotName]:
    """Return one snapshot of each month, its last good one if there is any, the newest first."""
    chosen: dict[tuple[int, int], KnownSnapshot] = {}
    for known in newest_first:
        month = known.name.made_at.year, known.name.made_at.month
        if month not in chosen or (known.is_good and not chosen[month].is_good):
            chosen[month] = known
    return [known.name for known in chosen.values()]
