"""Kills and full disks under the clinic's record: nothing acknowledged is lost, nothing is torn.

Two processes write to one record: fields of persons, prescriptions with their surfaces, new persons
and captures. Each notes every write that was acknowledged. Then

- one of them is killed with signal 9 at a random moment, the other a moment later; with PostgreSQL,
  each tenth time the server is stopped without warning as well; or
- their disk has only so many bytes left (a small file system in memory, which root may mount; else
  a limit on the size of files, for SQLite alone).

After each, the record is opened anew: every acknowledged write must be there, the counters must be
what the audit log tells, its chain must hold, the database must find itself in order, and all files
must be what their names say. The faults must be 0.

``KILLS=20`` asks for fewer kills, ``FULL=5`` for fewer full disks, of each database;
``DATABASES=SQLite,PostgreSQL`` are the databases.
"""

from __future__ import annotations

import errno
import os
import random
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1] / "tests/insole_core/records"))
from postgres_server import PostgresServer, binaries, running_server

from benchmarks._measure import print_table
from benchmarks._record_writers import (
    TRACEBACK,
    Subjects,
    Writer,
    acknowledged_counts,
    faults_of,
    foot_of,
    prepared,
    refusals,
    started,
)
from insole_core.records.place import RecordsPlace

FAULTS = ("lost", "torn", "broken", "traceback", "not opened")
_PAGES = 2**16
_MOST_LEFT = 300_000
_FULL_S = 1.5


@dataclass
class Site:
    """A record under test, and the server that it may need.

    Parameters
    ----------
    disk
        Folder whose disk can be filled; None where that cannot be done.
    """

    kind: str
    folder: Path
    place: RecordsPlace
    subjects: Subjects
    server: PostgresServer | None
    disk: Path | None
    rng: random.Random

    @property
    def notes(self) -> list[Path]:
        return sorted(self.folder.glob("*.notes"))

    def start_writer(self, name: str) -> int:
        seed = str(self.rng.random())
        notes = self.folder / f"{name}.notes"
        return started(Writer(self.place, self.subjects, name, notes, seed))


def main() -> None:
    kills, full = int(os.environ.get("KILLS", "300")), int(os.environ.get("FULL", "50"))
    for shape in range(3):
        foot_of(shape)  # made once, before the processes are forked
    rows = []
    for kind in os.environ.get("DATABASES", "SQLite,PostgreSQL").split(","):
        if kind == "PostgreSQL" and binaries() is None:
            print("PostgreSQL is not installed; only SQLite was tried.")
            continue
        for what, times, attempt in (("killed", kills, _kill), ("full disk", full, _fill)):
            started_at = time.monotonic()
            with _site(kind, is_small=what == "full disk") as site:
                counts = _tried(site, times, attempt)
                written = [acknowledged_counts(site.notes), refusals(site.notes)]
            seconds = round(time.monotonic() - started_at)
            faults = [counts[fault] for fault in FAULTS]
            rows.append([kind, what, counts["tried"], *written, *faults, seconds])
            print(f"{kind}, {what}: {seconds} s", flush=True)
    print_table(["database", "what", "times", "acknowledged", "refused", *FAULTS, "seconds"], rows)
    if any(count for row in rows for count in row[5:-1]):
        raise SystemExit(1)


def _tried(site: Site, times: int, attempt: Callable[[Site, int], list[int]]) -> Counter[str]:
    counts: Counter[str] = Counter()
    for number in range(times):
        codes = attempt(site, number)
        counts["traceback"] += codes.count(TRACEBACK)
        counts["tried"] += 1
        try:
            found = faults_of(site.place, site.subjects, site.notes)
        except Exception as error:  # noqa: BLE001 - any is a fault
            print(f"{site.kind} {number}: {error!r}", flush=True)
            found = Counter({"not opened": 1})
        if number % 25 == 24:
            print(f"{site.kind}: {number + 1} tried", flush=True)
        if any(found.values()):
            print(f"{site.kind} {number}: {dict(found)}", flush=True)
        counts += found
    return counts


def _kill(site: Site, number: int) -> list[int]:
    """Kill one writer at a random moment, the other, and perhaps the server, soon after."""
    pids = [site.start_writer(name) for name in ("one", "two")]
    time.sleep(site.rng.uniform(0.05, 0.9 if site.server is None else 1.6))
    is_crash = site.server is not None and number % 10 == 9
    if is_crash and site.server is not None:
        site.server.stop("immediate")
    os.kill(pids[number % 2], signal.SIGKILL)
    time.sleep(site.rng.uniform(0.0, 0.1))
    os.kill(pids[1 - number % 2], signal.SIGKILL)
    codes = [os.waitstatus_to_exitcode(os.waitpid(pid, 0)[1]) for pid in pids]
    if is_crash and site.server is not None:
        site.server.start()
    return codes


def _fill(site: Site, _number: int) -> list[int]:
    """Let both writers work while their disk has only so many bytes left."""
    left = site.rng.randrange(_MOST_LEFT)
    filler = None if site.disk is None else site.disk / "filler"
    if filler is None:
        _limit_files(site, left)
    pids = [site.start_writer(name) for name in ("one", "two")]
    time.sleep(0.2)
    if filler is not None:
        _occupy(filler, left)
    time.sleep(_FULL_S)
    for pid in pids:
        os.kill(pid, signal.SIGKILL)
    codes = [os.waitstatus_to_exitcode(os.waitpid(pid, 0)[1]) for pid in pids]
    if filler is None:
        _limit_files(site, None)
    else:
        filler.unlink(missing_ok=True)
    if site.server is not None and not site.server.is_running():
        site.server.start()
    return codes


def _occupy(filler: Path, left: int) -> None:
    """Leave only so many bytes on a disk, to which others write meanwhile."""
    with filler.open("wb") as file:
        size = shutil.disk_usage(filler.parent).free - left
        while size > 0:
            try:
                os.posix_fallocate(file.fileno(), 0, size)
            except OSError as error:
                if error.errno != errno.ENOSPC:
                    raise
                size -= _PAGES
            else:
                return


def _limit_files(site: Site, left: int | None) -> None:
    """Let no file of the processes started from now on grow past a limit."""
    signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
    hard = resource.getrlimit(resource.RLIMIT_FSIZE)[1]
    size = site.place.database_file.stat().st_size
    resource.setrlimit(resource.RLIMIT_FSIZE, (hard if left is None else size + left, hard))


@contextmanager
def _site(kind: str, *, is_small: bool) -> Iterator[Site]:
    rng = random.Random(f"{os.environ.get('FUZZ_SEED', '1')} {kind} {is_small}")
    with tempfile.TemporaryDirectory(prefix="record-kills-") as name:
        folder = Path(name)
        folder.chmod(0o755)  # the server is another user
        disk = folder / "disk"
        disk.mkdir()
        with _small_disk(disk, 160 if kind == "PostgreSQL" else 40) as is_mounted:
            where = disk if is_small and is_mounted else folder
            if kind == "SQLite":
                place = RecordsPlace.local(where / "record")
                yield Site(
                    kind, folder, place, prepared(place), None,
                    disk if where is disk else None, rng,
                )  # fmt: skip
                return
            options = ("-c", "max_wal_size=32MB")
            with running_server(durable=True, options=options, parent=where) as server:
                place = RecordsPlace.of_url(server.url("postgres"), where / "contents")
                yield Site(
                    kind, folder, place, prepared(place), server,
                    disk if where is disk else None, rng,
                )  # fmt: skip


@contextmanager
def _small_disk(folder: Path, size_mb: int) -> Iterator[bool]:
    """Mount a small file system in memory; yield whether that could be done."""
    command = ["mount", "-t", "tmpfs", "-o", f"size={size_mb}m,mode=755", "tmpfs", str(folder)]
    if os.geteuid() != 0 or subprocess.run(command, check=False).returncode:
        yield False
        return
    try:
        yield True
    finally:
        subprocess.run(["umount", "--lazy", str(folder)], check=True)
