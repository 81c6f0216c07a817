"""Backups of a large record: what the second one writes, how long each takes, what comes back.

The peer is what a clinic without this would do every night: SQLite's own backup, and a copy of
all files, unencrypted. ``RECORD_BACKUP_GB`` (20 for the full figure), ``RECORD_BACKUP_PERSONS`` and
``RECORD_BACKUP_LINES`` say how large the record is; the disk has to hold its files twice.

Limits: a second backup writes less than 1 % of the first one; a third one writes at most the new
files, and 40 MB for the tables; everything comes back with equal hashes; the audit log is verified
in less memory than 200 MB.
"""

from __future__ import annotations

import hashlib
import os
import random
import shutil
import sqlite3
import sys
import tempfile
import time
from collections.abc import Callable
from contextlib import closing
from pathlib import Path
from typing import Any

import pyrage
from sqlalchemy import insert, update

from benchmarks._large_record import fill_record
from insole_core.records import schema
from insole_core.records.audit import AuditLog
from insole_core.records.author import Author, utc_now
from insole_core.records.backup.back_up import back_up, set_up_backups
from insole_core.records.backup.backup_key import BackupKey
from insole_core.records.backup.restore import restore
from insole_core.records.backup.snapshot import check_backup, damaged_files
from insole_core.records.context import RecordsContext
from insole_core.records.place import RecordsPlace
from insole_core.records.records import open_records

GIGABYTES = float(os.environ.get("RECORD_BACKUP_GB", "1"))
PERSONS = int(os.environ.get("RECORD_BACKUP_PERSONS", "50000"))
LINES = int(os.environ.get("RECORD_BACKUP_LINES", "1000000"))
FILE_BYTES = 5_000_000
"""A foot's surface; sessions are larger."""
ANNA = Author("anna", "desk")
NEW_FILES, CHANGED_PERSONS = 8, 40
"""A day's work."""


def main() -> None:
    with tempfile.TemporaryDirectory() as name:
        run(Path(name))


def run(folder: Path) -> None:
    identity = pyrage.x25519.Identity.generate()
    context = open_records(RecordsPlace.local(folder / "record"), ANNA).context
    ids = fill_record(context.database, PERSONS, LINES)
    add_files(context, max(int(GIGABYTES * 1e9 / FILE_BYTES), 1))
    set_up_backups(context, BackupKey.for_recipients([str(identity.to_public())]))
    print(f"{PERSONS} persons, {LINES} lines of the audit log, {GIGABYTES} GB of files")

    backups, peer = folder / "backups", folder / "peer"
    timed("peer: copy of database and files", lambda: copy(context, peer))
    shutil.rmtree(peer)
    first = timed("first backup", lambda: back_up(context, backups))
    second = timed("second backup, nothing new", lambda: back_up(context, backups))
    work_a_day(context, ids)
    third = timed("third backup, after a day's work", lambda: back_up(context, backups))
    for text, report in (("first", first), ("second", second), ("third", third)):
        print(f"{text:8} wrote {report.written_bytes / 1e6:9.1f} MB in {report.written_objects}")

    before = resident_mb("VmRSS")
    audit = timed("audit log verified", AuditLog(context.database, ANNA).verify)
    grown = resident_mb("VmHWM") - before
    print(f"  {audit.lines} lines, {grown:.0f} MB more than before")
    damaged = timed("files checked without the key", lambda: damaged_files(backups))
    check = timed("backup decrypted and checked", lambda: check_backup(backups, str(identity)))
    stored = digests(context.contents.folder)
    context.database.close()
    shutil.rmtree(context.contents.folder)  # the disk has failed
    target = RecordsPlace.local(folder / "restored")
    report = timed("restored", lambda: restore(backups, str(identity), target, ANNA))
    equal = stored == digests(target.contents)
    print(f"equal hashes of {check.contents} files: {equal}")
    new_bytes = NEW_FILES * FILE_BYTES
    limits = {
        "second < 1 % of first": second.written_bytes < 0.01 * first.written_bytes,
        "third <= what is new": third.written_bytes < 1.01 * new_bytes + 40e6,
        "equal hashes": equal and report.audit.is_intact,
        "no damage": check.is_sound and not damaged,
        "memory of the audit log": grown < 200,
    }
    for text, holds in limits.items():
        print(f"{'ok  ' if holds else 'FAIL'} {text}")
    if not all(limits.values()):
        sys.exit(1)


def timed(text: str, work: Callable[[], Any]) -> Any:
    """Do some work; print how long it took, and the most memory that it had at a time."""
    Path("/proc/self/clear_refs").write_text("5")  # the peak is what there is now
    start, start_cpu = time.perf_counter(), time.process_time()
    result = work()
    took_s, cpu_s = time.perf_counter() - start, time.process_time() - start_cpu
    print(
        f"{text:34} {took_s:8.1f} s {cpu_s:8.1f} s CPU {resident_mb('VmHWM'):6.0f} MB", flush=True
    )
    return result


def add_files(context: RecordsContext, count: int) -> None:
    """Store files that do not compress, and refer to them."""
    rng = random.Random(count)
    rows = []
    for _ in range(count):
        sha256 = context.contents.put(rng.randbytes(FILE_BYTES))
        rows.append({"sha256": sha256, "size": FILE_BYTES, "kind": "mesh", "created_at": utc_now()})
    with context.database.writing() as connection:
        connection.execute(insert(schema.contents), rows)


def work_a_day(context: RecordsContext, ids: list[str]) -> None:
    add_files(context, NEW_FILES)
    for person_id in random.Random(1).sample(ids, min(CHANGED_PERSONS, len(ids))):
        with context.database.writing() as connection:
            row = update(schema.persons).where(schema.persons.c.id == person_id)
            connection.execute(row.values(notes="came today", changed_at=utc_now()))
            context.log(connection, "changed", "person", person_id)


def copy(context: RecordsContext, target: Path) -> None:
    target.mkdir(parents=True)
    source = context.database.place.database_file
    with closing(sqlite3.connect(source)) as old, closing(sqlite3.connect(target / "db")) as new:
        old.backup(new)
    shutil.copytree(context.contents.folder, target / "contents")


def digests(folder: Path) -> dict[str, str]:
    """Hash all stored files, by their names."""
    return {
        path.name: hashlib.sha256(path.read_bytes()).hexdigest()
        for path in folder.glob("??/*")
        if path.is_file()
    }


def resident_mb(name: str) -> float:
    """Return what Linux says of the memory of this process: VmRSS now, VmHWM at most."""
    lines = Path("/proc/self/status").read_text().splitlines()
    return next(int(line.split()[1]) for line in lines if line.startswith(name)) / 1024
