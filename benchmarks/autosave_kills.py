"""Windows killed while the database goes and comes: what a window said was kept is there again.

A window changes the foot of a visit on PostgreSQL, and notes each change of which the status line
says that it is saved, or kept on this computer. Meanwhile the server is stopped without warning and
started again, and a second window of the same user starts, all at random moments; then the windows
are killed with signal 9. The next window, which may start while the server is away, hands over what
was left, and opens the visit: it must show the last change that was said to be kept, or a later
one. The faults must be 0.

``KILLS=20`` asks for fewer kills.
"""

from __future__ import annotations

import os
import random
import signal
import sys
import tempfile
import time
from collections import Counter
from dataclasses import dataclass, field, replace
from datetime import date
from importlib import import_module
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1] / "tests/insole_core/records"))
from postgres_server import PostgresServer, binaries, running_server

from benchmarks._killed_windows import FIRST_MM, Station
from benchmarks._measure import print_table
from benchmarks._record_writers import foot_of
from insole_core.records.author import Author
from insole_core.records.open import open_records
from insole_core.records.person import Person
from insole_core.records.place import RecordsPlace
from insole_core.records.visit import Visit
from insole_studio.app.preload import MODULES

FAULTS = ("lost", "fault", "damaged", "hang", "ended")
_PATIENCE_S = 240.0
_LONGEST_S = 5.0
_LOOK_S = 0.02


@dataclass
class Site:
    """A station, its server, and the windows that run."""

    station: Station
    server: PostgresServer
    rng: random.Random
    windows: list[int] = field(default_factory=list)

    def start_window(self, *, edits: bool) -> None:
        self.windows.append(self.station.start(str(self.rng.random()), edits=edits))

    def switch_server(self) -> None:
        """Stop the server without warning, or start it."""
        if self.server.is_running():
            self.server.stop("immediate")
        else:
            self.server.start()

    def kill_windows(self) -> int:
        """Kill all windows in any order; return how many had ended by themselves."""
        self.rng.shuffle(self.windows)
        ended = 0
        for process in self.windows:
            os.kill(process, signal.SIGKILL)
            code = os.waitstatus_to_exitcode(os.waitpid(process, 0)[1])
            ended += code != -signal.SIGKILL
        self.windows.clear()
        return ended


def main() -> None:
    if binaries() is None:
        print("PostgreSQL is not installed; nothing was tried.")
        return
    kills = int(os.environ.get("KILLS", "200"))
    os.environ["QT_QPA_PLATFORM"] = "offscreen"
    for module in MODULES:  # once, before the processes are forked
        import_module(module)
    started_at = time.monotonic()
    with tempfile.TemporaryDirectory(prefix="autosave-kills-") as name:
        folder = Path(name)
        folder.chmod(0o755)  # the server is another user
        with running_server(durable=True, parent=folder) as server:
            counts = tried(folder, server, kills, os.environ.get("FUZZ_SEED", "1"))
    names = ("kills", "stops", "second windows", "said to be kept", "handed over", *FAULTS)
    seconds = round(time.monotonic() - started_at)
    print_table([*names, "seconds"], [[*(counts[key] for key in names), seconds]])
    if any(counts[fault] for fault in FAULTS):
        raise SystemExit(1)


def tried(folder: Path, server: PostgresServer, kills: int, seed: str) -> Counter[str]:
    """Kill windows so many times; return how often what happened."""
    station = _set_up(folder, server)
    site = Site(station, server, random.Random(seed))
    counts: Counter[str] = Counter()
    try:
        for number in range(kills):
            _open(site, counts)
            _disturb(site, counts)
            counts["kills"] += 1
            counts["ended"] += site.kill_windows()
            if number % 10 == 9:
                print(f"{number + 1} kills: {dict(counts)}", flush=True)
        _open(site, counts)
    finally:
        site.kill_windows()
    counts["said to be kept"] = len(station.said("kept"))
    counts["fault"] = len(station.said("fault"))
    counts["damaged"] = len(list(station.paths.autosave_folder.glob("*.broken-*")))
    for sentence, times in Counter([*station.said("told"), *station.said("fault")]).items():
        print(f"told {times} times: {sentence}")
    return counts


def _set_up(folder: Path, server: PostgresServer) -> Station:
    """Make a patient with a visit and a foot, and a station whose windows open their record."""
    url, contents = server.url("postgres"), folder / "contents"
    foot = foot_of(0)
    foot = foot.with_design(replace(foot.design, thickness_mm=FIRST_MM))
    records = open_records(RecordsPlace.of_url(url, contents), Author("setup", "setup"))
    person = records.persons.add(Person("Anna Berg"))
    visit = records.visits.add(Visit(person.id, date.today()))
    records.prescriptions.save(visit.id, foot, None)
    records.close()
    station = Station(folder, visit.id, folder / "notes")
    station.set_up(url, contents)
    return station


def _open(site: Site, counts: Counter[str]) -> None:
    """Start a window, and see whether the visit that it opens holds all that was kept."""
    station, rng = site.station, site.rng
    kept = max(station.said("kept"), default=0)
    before = len(station.said("opened"))
    counts["handed over"] += bool(list(station.paths.autosave_folder.glob("[!.]*.insole")))
    site.start_window(edits=True)
    if not site.server.is_running():
        time.sleep(rng.uniform(0.0, 3.0))
        site.server.start()
    until = time.monotonic() + _PATIENCE_S
    while len(station.said("opened")) == before:
        if time.monotonic() > until:
            counts["hang"] += 1
            return
        time.sleep(_LOOK_S)
    opened = station.said("opened")[-1]
    if opened < kept:
        counts["lost"] += 1
        print(f"lost: {kept} was said to be kept, {opened} is there", flush=True)


def _disturb(site: Site, counts: Counter[str]) -> None:
    """Let the server go and come, and a second window start, until the windows are killed."""
    rng = site.rng
    moments = sorted(rng.uniform(0.0, _LONGEST_S) for _ in range(rng.choice((1, 1, 2, 3))))
    second = rng.uniform(0.0, _LONGEST_S) if rng.random() < 0.3 else None
    end = rng.uniform(0.2, _LONGEST_S)
    begun = time.monotonic()
    while (now := time.monotonic() - begun) < end:
        if moments and now >= moments[0]:
            moments.pop(0)
            counts["stops"] += site.server.is_running()
            site.switch_server()
        if second is not None and now >= second:
            second = None
            counts["second windows"] += 1
            site.start_window(edits=False)
        time.sleep(_LOOK_S)
