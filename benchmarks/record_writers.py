"""Two and eight processes that change the same few persons and prescriptions at once.

Each change adds one to a counter that it has read before, so a lost update shows in the sum. A
conflict is told to the one who saves second, who tries again. There must be no lost update and no
other refusal: neither a deadlock nor a wait that was given up.

``MINUTES=10`` asks for ten minutes for each number of writers; one fourth of one is the default.
``WRITERS=2,8`` are the numbers, ``DATABASES=SQLite,PostgreSQL`` the databases.
"""

from __future__ import annotations

import json
import os
import sys
import tempfile
import time
from collections import Counter
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1] / "tests/insole_core/records"))
from postgres_server import binaries, running_server

from benchmarks._measure import print_table
from benchmarks._record_writers import (
    Subjects,
    Writer,
    acknowledged_counts,
    counts_of,
    faults_of,
    foot_of,
    prepared,
)
from insole_core.records.place import RecordsPlace


def main() -> None:
    minutes = float(os.environ.get("MINUTES", "0.25"))
    numbers = [int(number) for number in os.environ.get("WRITERS", "2,8").split(",")]
    kinds = os.environ.get("DATABASES", "SQLite,PostgreSQL").split(",")
    for shape in range(3):
        foot_of(shape)
    rows: list[list[object]] = []
    for count in numbers:
        with tempfile.TemporaryDirectory(prefix="record-writers-") as name:
            folder = Path(name)
            if "SQLite" in kinds:
                place = RecordsPlace.local(folder / "record")
                rows.append(_tried("SQLite", place, count, minutes))
            if "PostgreSQL" in kinds and binaries() is not None:
                with running_server(durable=True) as server:
                    place = RecordsPlace.of_url(server.url("postgres"), folder / "contents")
                    rows.append(_tried("PostgreSQL", place, count, minutes))
    head = ["database", "writers", "minutes", "counted", "conflicts", "lost", "refused", "faults"]
    print_table(head, rows)
    if any(row[5] or row[6] or row[7] for row in rows):
        raise SystemExit(1)


def _tried(kind: str, place: RecordsPlace, count: int, minutes: float) -> list[object]:
    subjects = prepared(place)
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        until = time.monotonic() + 60 * minutes
        pids = [_start(place, subjects, folder, number, until) for number in range(count)]
        codes = [os.waitstatus_to_exitcode(os.waitpid(pid, 0)[1]) for pid in pids]
        notes = sorted(folder.glob("*.notes"))
        refused: Counter[str] = Counter()
        for path in folder.glob("*.refused"):
            refused.update(json.loads(path.read_text()))
        counted = acknowledged_counts(notes)
        lost = counted - counts_of(place, subjects)
        faults = sum(faults_of(place, subjects, notes).values()) + sum(map(bool, codes))
    conflicts = refused.pop("conflict", 0)
    print(f"{kind}, {count} writers: {counted} counted, refused: {dict(refused)}", flush=True)
    return [kind, count, minutes, counted, conflicts, lost, sum(refused.values()), faults]


def _start(place: RecordsPlace, subjects: Subjects, folder: Path, number: int, until: float) -> int:
    pid = os.fork()
    if pid:
        return pid
    code = 1
    try:
        writer = Writer(place, subjects, f"w{number}", folder / f"{number}.notes", str(number))
        writer.work(lambda: time.monotonic() < until)
        (folder / f"{number}.refused").write_text(json.dumps(writer.refused))
        code = 0
    finally:
        os._exit(code)
