"""Old backups go by a rule: what is left can be restored, and the folder shrinks by the rest."""

from __future__ import annotations

from collections.abc import Iterator
from datetime import UTC, datetime, timedelta
from pathlib import Path

import pytest
from backed_up_record import ANNA, RECIPIENT, SECRET, add_person, all_rows, context_of, make_record

from insole_core.records.backup import back_up as backing_up
from insole_core.records.backup.back_up import (
    KeepRule,
    back_up,
    last_backup_at,
    set_up_backups,
    superfluous,
)
from insole_core.records.backup.backup_folder import BackupFolder, KnownSnapshot, SnapshotName
from insole_core.records.backup.backup_key import BackupKey
from insole_core.records.backup.restore import restore
from insole_core.records.backup.snapshot import check_backup, damaged_files
from insole_core.records.context import RecordsContext
from insole_core.records.place import RecordsPlace

NOON = datetime(2026, 11, 22, 12, tzinfo=UTC)
DAY = timedelta(days=1)


def kept_days(rule: KeepRule, *, bad: tuple[int, ...] = (), days: int = 400) -> list[int]:
    """Return the age in days of what stays of a backup a day, pruned every day."""
    known: list[KnownSnapshot] = []
    for number in range(days + 1):
        name = SnapshotName(number + 1, NOON - (days - number) * DAY)
        known.append(KnownSnapshot(name, (days - number) not in bad))
        going = superfluous(known, rule, name.made_at)
        known = [snapshot for snapshot in known if snapshot.name not in going]
    return [(NOON - snapshot.name.made_at).days for snapshot in reversed(known)]


def test_all_of_a_month_stay_and_the_last_one_of_each_month_before() -> None:
    kept = kept_days(KeepRule())
    assert kept[:30] == list(range(30))
    assert [(NOON - age * DAY).strftime("%m-%d") for age in kept[30:]] == [
        "09-30", "08-31", "07-31", "06-30", "05-31", "04-30", "03-31", "02-28", "01-31", "12-31",
        "11-30", "10-31",
    ]  # fmt: skip


def test_months_may_be_limited() -> None:
    kept = kept_days(KeepRule(months=3))
    assert kept[:30] == list(range(30))
    assert [(NOON - age * DAY).strftime("%m-%d") for age in kept[30:]] == ["09-30"]


def test_of_a_month_the_last_good_one_stays() -> None:
    september_30 = (NOON - datetime(2026, 9, 30, 12, tzinfo=UTC)).days
    kept = kept_days(KeepRule(), bad=(september_30,))
    assert september_30 + 1 in kept
    assert september_30 not in kept


def test_the_last_good_one_stays_however_old_it_is() -> None:
    kept = kept_days(KeepRule(months=1), bad=tuple(range(200)), days=250)
    assert kept == [*range(30), 200]


def test_a_clock_that_jumps_forward_removes_none_of_the_newest() -> None:
    known = [KnownSnapshot(SnapshotName(n, NOON + n * DAY), True) for n in range(1, 31)]
    assert superfluous(known, KeepRule(months=1), NOON + 5000 * DAY) == []


@pytest.fixture
def context(migrated_file: Path, tmp_path: Path) -> Iterator[RecordsContext]:
    context = make_record(migrated_file, tmp_path / "record")
    set_up_backups(context, BackupKey.for_recipients([RECIPIENT]))
    yield context
    context.database.close()


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    return tmp_path / "backups"


def numbers_in(folder: Path) -> list[int]:
    return [snapshot.number for snapshot in BackupFolder(folder).snapshots()]


def test_what_only_removed_backups_refer_to_goes_with_the_next_one(
    context: RecordsContext, folder: Path, tmp_path: Path
) -> None:
    assert last_backup_at(context.database) is None
    for number in range(3):
        add_person(context, f"person {number}")
        back_up(context, folder)
    before = set(BackupFolder(folder).objects())
    _make_old(folder)
    rule = KeepRule(days=1, months=1)
    report = back_up(context, folder, keep=rule)
    assert report.removed_snapshots == 3
    assert numbers_in(folder) == [4]
    assert before <= BackupFolder(folder).objects().keys()  # whoever restores one can finish
    back_up(context, folder, keep=rule)
    after = BackupFolder(folder).objects()
    assert len(before - after.keys()) >= 3
    assert sorted(path.stem for path in (folder / "lists").iterdir()) == sorted(
        path.stem for path in (folder / "snapshots").iterdir()
    )
    assert check_backup(folder, SECRET).is_sound
    assert damaged_files(folder) == ()
    place = RecordsPlace.local(tmp_path / "restored")
    restore(folder, SECRET, place, ANNA)
    restored = context_of(place)
    assert all_rows(restored)["persons"] == all_rows(context)["persons"]
    restored.database.close()
    assert last_backup_at(context.database) is not None


def _make_old(folder: Path) -> None:
    """Let all backups be of a month long ago."""
    for path in [*(folder / "snapshots").iterdir(), *(folder / "lists").iterdir()]:
        number, _, rest = path.name.partition("-")
        path.rename(path.with_name(f"{number}-2020-01-01T00-00-00Z.{rest.rpartition('.')[2]}"))


def test_nothing_is_removed_that_an_unlisted_backup_may_need(
    context: RecordsContext, folder: Path
) -> None:
    """One of an older program says to nobody but its owner what it refers to."""
    back_up(context, folder)
    (listed,) = (folder / "lists").iterdir()
    listed.unlink()
    before = set(BackupFolder(folder).objects())
    add_person(context, "new")
    for _ in range(2):
        back_up(context, folder, keep=KeepRule(days=2))
    assert before <= BackupFolder(folder).objects().keys()
    assert check_backup(folder, SECRET, 2).is_sound


def test_a_folder_that_lets_nothing_be_removed_fails_no_backup(
    context: RecordsContext, folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    back_up(context, folder)
    _make_old(folder)

    def refuse(_path: Path, missing_ok: bool = False) -> None:
        raise PermissionError(13, "Permission denied")

    monkeypatch.setattr(backing_up.BackupWriter, "_remove_unused", lambda _self, _lists: None)
    monkeypatch.setattr(Path, "unlink", refuse)
    report = back_up(context, folder, keep=KeepRule(days=1, months=1))
    assert report.removed_snapshots == 0
    assert numbers_in(folder) == [1, 2]
