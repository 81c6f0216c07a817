"""The clinic's record after many years: search, a person, the start page, a case, and memory.

50 000 persons, 200 000 visits and 1 000 000 lines of the audit log, in SQLite and in PostgreSQL
(where it is installed). ``PERSONS=5000`` asks for fewer, ``DATABASES=SQLite`` for one of them.
Beside the search stands one by SQLite's own index of three letters (FTS5), beside a case that is
opened, the same one in a file.
"""

from __future__ import annotations

import multiprocessing
import os
import shutil
import sqlite3
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from concurrent.futures import ProcessPoolExecutor
from contextlib import contextmanager
from dataclasses import replace
from datetime import date, timedelta
from functools import partial
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parents[1] / "tests/insole_core/records"))
from postgres_server import binaries, running_server

from benchmarks._large_record import BEGUN, fill_record
from benchmarks._measure import median_ms, print_table, resident_mb
from benchmarks._window_search import searches_in_window
from insole_core.cases.case_file import read_case, write_case
from insole_core.cases.case_record import CaseRecord, FootRecord
from insole_core.cases.scan_source import ScanSource
from insole_core.foot.foot_placement import place_foot
from insole_core.geometry.side import Side
from insole_core.records.audit_search import AuditFilter, authors_of_audit, search_audit
from insole_core.records.author import Author
from insole_core.records.person_matching import find_duplicates, search_words
from insole_core.records.place import RecordsPlace
from insole_core.records.records import Records, open_records
from insole_core.records.visit import Visit
from insole_core.simulate.foot_model import build_foot
from insole_core.simulate.foot_shape import FootShape

TYPED = (
    "a", "an", "and", "anna", "anna berg", "a b", "a b 19", "19", "1962-03", "sorensen ali",
    "xyzzy", "26-00012",
)  # fmt: skip
SEARCH_MS, PERSON_MS, START_MS, ADMINISTRATION_MS = 50.0, 150.0, 300.0, 300.0
ME = Author("anna", "desk")


def main() -> None:
    count = int(os.environ.get("PERSONS", "50000"))
    kinds = os.environ.get("DATABASES", "SQLite,PostgreSQL").split(",")
    rows: list[list[object]] = []
    with tempfile.TemporaryDirectory(prefix="records-") as name:
        folder = Path(name)
        if "SQLite" in kinds:
            rows += _measured("SQLite", RecordsPlace.local(folder / "local"), count)
            rows += _in_window(folder / "local")
            rows += _peer(folder / "local" / "records.sqlite3", folder / "peer.sqlite3")
        if "PostgreSQL" in kinds and binaries() is None:
            print("PostgreSQL is not installed.")
        elif "PostgreSQL" in kinds:
            with running_server(durable=True) as server:
                place = RecordsPlace.of_url(server.url("postgres"), folder / "contents")
                rows += _measured("PostgreSQL", place, count)
    print_table(["database", "what", "median ms", "slowest ms", "limit ms"], rows)
    if any(isinstance(row[4], float) and float(str(row[2])) > row[4] for row in rows):
        raise SystemExit(1)


def _measured(kind: str, place: RecordsPlace, count: int) -> Iterator[list[object]]:
    started = time.perf_counter()
    with ProcessPoolExecutor(1, multiprocessing.get_context("fork")) as pool:
        ids = pool.submit(_filled, place, count).result()  # its memory is not the record's
    print(
        f"{kind}: filled with {count} persons in {time.perf_counter() - started:.0f} s", flush=True
    )
    before_mb = resident_mb()
    started = time.perf_counter()
    records = open_records(place, ME)
    yield [kind, "open the record", f"{1000 * (time.perf_counter() - started):.1f}", "", ""]
    for typed in TYPED:
        yield _row(kind, f"search “{typed}”", partial(records.persons.search, typed), SEARCH_MS)
    yield _row(kind, "person page", _each(ids, lambda id_: _person_page(records, id_)), PERSON_MS)
    yield _row(kind, "start page", lambda: _start_page(records), START_MS)
    yield _row(kind, "duplicates", lambda: _duplicates(records), ADMINISTRATION_MS)
    for name, call in _audit_searches(records, ids[0]).items():
        yield _row(kind, f"audit log, {name}", call, ADMINISTRATION_MS)
    yield [kind, "memory, MB more than before", f"{resident_mb() - before_mb:.0f}", "", ""]
    yield from _case(kind, records, ids[0])
    records.close()


def _in_window(folder: Path) -> Iterator[list[object]]:
    for typed, times in searches_in_window(folder, TYPED):
        what = f"search “{typed}” in the window"
        yield ["SQLite", what, f"{np.median(times):.1f}", f"{max(times):.1f}", SEARCH_MS]


def _filled(place: RecordsPlace, count: int) -> list[str]:
    records = open_records(place, ME)
    ids = fill_record(records.context.database, count, 20 * count)
    if not place.is_local:
        with records.context.database.writing() as connection:
            connection.exec_driver_sql("ANALYZE")
    records.close()
    return ids


def _row(kind: str, what: str, call: Callable[[], object], limit_ms: float) -> list[object]:
    call()
    times = []
    for _ in range(9):
        started = time.perf_counter()
        call()
        times.append(1000 * (time.perf_counter() - started))
    return [kind, what, f"{np.median(times):.1f}", f"{max(times):.1f}", limit_ms]


def _each(ids: list[str], call: Callable[[str], object]) -> Callable[[], object]:
    """Return a function that calls with another id each time."""
    rest = iter(ids[:: max(1, len(ids) // 100)])
    return lambda: call(next(rest))


def _person_page(records: Records, person_id: str) -> None:
    records.persons.open(person_id)
    with records.snapshot():
        for visit in records.visits.of_person(person_id):
            for side in Side:
                records.prescriptions.versions(visit.id, side)
            records.captures.of_visit(visit.id)
            records.presence.others(visit.id)
        records.orders.of_person(person_id)
        records.follow_ups.of_person(person_id)


def _start_page(records: Records) -> None:
    records.persons.recent()
    records.visits.on(date.today())
    records.visits.work_list()
    records.orders.open()


def _duplicates(records: Records) -> None:
    find_duplicates(records.persons.alike())
    records.persons.latest_merges()


def _audit_searches(records: Records, person_id: str) -> dict[str, Callable[[], object]]:
    pseudonym = records.persons.get(person_id).pseudonym
    begun = BEGUN.date()
    year_ends, day = begun + timedelta(days=730), begun + timedelta(days=700)
    of_year = AuditFilter(first_day=begun + timedelta(days=365), last_day=year_ends)
    wanted = {
        "newest": AuditFilter(),
        "person": AuditFilter(pseudonym=pseudonym),
        "author": AuditFilter(author="anna"),
        "rare author": AuditFilter(author="rare"),
        "day": AuditFilter(first_day=day, last_day=day),
        "year": of_year,
        "five years": AuditFilter(first_day=begun),
        "author and year": replace(of_year, author="anna"),
        "rare author and year": replace(of_year, author="rare"),
        "person and year": replace(of_year, pseudonym=pseudonym),
        "person and author": AuditFilter(pseudonym=pseudonym, author="ben"),
    }
    searches: dict[str, Callable[[], object]] = {
        name: partial(search_audit, records.context, one) for name, one in wanted.items()
    }
    return searches | {"all authors": partial(authors_of_audit, records.context)}


def _case(kind: str, records: Records, person_id: str) -> Iterator[list[object]]:
    """Open a visit with two feet, and the same case from a file."""
    feet = []
    for side in Side:
        mesh = build_foot(FootShape(side=side), np.random.default_rng(1), cell_mm=1.2).mesh
        foot = place_foot(mesh, side, frame="reference")
        feet.append(FootRecord.begun(foot, ScanSource("mesh", f"{side}.stl", "a" * 64)))
    visit = records.visits.add(Visit(person_id, date.today()))
    record = CaseRecord()
    for foot_record in feet:
        records.prescriptions.save(visit.id, foot_record, None)
        record = record.with_foot(foot_record)
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "case.insole"
        write_case(record, path)
        file_ms = median_ms(lambda: read_case(path))
    opened_ms = median_ms(lambda: records.visits.open_case(visit.id))
    yield [kind, "case from the record", f"{opened_ms:.1f}", "", ""]
    yield [kind, "case from a file", f"{file_ms:.1f}", "", ""]


def _peer(database: Path, copy: Path) -> Iterator[list[object]]:
    """Search by an index of three letters, made by SQLite itself."""
    shutil.copyfile(database, copy)
    with _connected(copy) as connection:
        connection.execute("CREATE VIRTUAL TABLE found USING fts5(search_text, tokenize='trigram')")
        connection.execute(
            "INSERT INTO found (rowid, search_text) SELECT rowid, search_text FROM persons"
        )
        for typed in TYPED:
            words = [word for word in search_words(typed) if len(word) > 2]
            if not words:
                continue  # it knows nothing shorter
            query = " AND ".join(f'"{word}"' for word in words)

            def search(query: str = query) -> list[object]:
                return connection.execute(
                    "SELECT persons.id, persons.name FROM found JOIN persons "
                    "ON persons.rowid = found.rowid WHERE found MATCH ? LIMIT 50",
                    (query,),
                ).fetchall()

            yield [*_row("FTS5 of SQLite", f"search “{typed}”", search, 0.0)[:4], ""]


@contextmanager
def _connected(path: Path) -> Iterator[sqlite3.Connection]:
    connection = sqlite3.connect(path)
    try:
        yield connection
    finally:
        connection.close()
