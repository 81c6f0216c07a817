"""Processes that write to a record, and note every write that was acknowledged."""

from __future__ import annotations

import json
import os
import random
from collections import Counter
from dataclasses import dataclass, replace
from datetime import date
from functools import cache
from pathlib import Path
from typing import Any, Final

import numpy as np
from sqlalchemy import select, text

from insole_core.cases.case_record import FootRecord
from insole_core.cases.scan_source import ScanSource
from insole_core.errors import Conflict, InsoleError, RecordsError
from insole_core.foot.foot import Foot
from insole_core.foot.foot_placement import place_foot
from insole_core.geometry.side import Side
from insole_core.records.author import Author
from insole_core.records.captures import MESH
from insole_core.records.person import Person
from insole_core.records.place import RecordsPlace
from insole_core.records.records import Records, open_records
from insole_core.records.schema import audit, contents
from insole_core.records.visit import Visit
from insole_core.simulate.foot_model import build_foot
from insole_core.simulate.foot_shape import FootShape

TRACEBACK: Final = 3
_PERSONS: Final = 3


@dataclass(frozen=True)
class Subjects:
    """What all writers change."""

    persons: tuple[str, ...]
    visits: tuple[str, ...]


@cache
def foot_of(shape: int) -> FootRecord:
    """Return one of a few left feet, each with a surface of its own."""
    mesh = build_foot(FootShape(side=Side.LEFT), np.random.default_rng(shape), cell_mm=9.0).mesh
    foot: Foot = place_foot(mesh, Side.LEFT, frame="reference")
    return FootRecord.begun(foot, ScanSource("mesh", "left.stl", f"{shape:064d}"))


def prepared(place: RecordsPlace) -> Subjects:
    """Make the persons and visits that the writers change."""
    records = open_records(place, Author("setup", "setup"))
    persons = [records.persons.add(Person(f"Anna {number}")) for number in range(_PERSONS)]
    visits = [records.visits.add(Visit(person.id, date.today())) for person in persons]
    records.close()
    return Subjects(tuple(p.id for p in persons), tuple(v.id for v in visits))


class Writer:
    """Changes the record at random, for ever; every write adds one to a counter it changes.

    Parameters
    ----------
    notes
        File that gets a line for each write that was acknowledged, such as ``{"person": id}``.
    """

    def __init__(
        self, place: RecordsPlace, subjects: Subjects, name: str, notes: Path, seed: str
    ) -> None:
        self._place = place
        self._subjects = subjects
        self._author = Author(name, name)
        self._notes = os.open(notes, os.O_WRONLY | os.O_CREAT | os.O_APPEND, 0o600)
        self._rng = random.Random(seed)
        self._scan = notes.with_suffix(".stl")
        self.refused: Counter[str] = Counter()

    def work(self, keeps_on: Any = lambda: True) -> None:
        """Write until `keeps_on` returns False; what is refused is counted, and tried no more."""
        records = open_records(self._place, self._author)
        changes = (self._count_person, self._count_foot, self._add_person, self._add_capture)
        while keeps_on():
            change = self._rng.choices(changes, (4, 4, 1, 1))[0]
            try:
                change(records)
            except Conflict:
                self.refused["conflict"] += 1
            except InsoleError as error:
                self.refused[type(error).__name__] += 1
                self._note(refused=type(error).__name__, sentence=str(error))
        records.close()

    def _note(self, **written: Any) -> None:
        os.write(self._notes, json.dumps(written).encode() + b"\n")

    def _count_person(self, records: Records) -> None:
        person = records.persons.get(self._rng.choice(self._subjects.persons))
        counted = replace(person, notes=str(int(person.notes or "0") + 1))
        stored = records.persons.change(counted, person.revision)
        self._note(counter=person.id, value=int(stored.notes))

    def _count_foot(self, records: Records) -> None:
        """Count by the name of the variant; some counts come with another surface."""
        visit_id = self._rng.choice(self._subjects.visits)
        opened = records.visits.open_case(visit_id)
        now = opened.record.of_side(Side.LEFT)
        value = 0 if now is None else int(now.chosen)
        foot = foot_of(self._rng.randrange(3)) if now is None else now
        if self._rng.random() < 0.3:
            foot = replace(
                foot_of(self._rng.randrange(3)), variants=foot.variants, chosen=foot.chosen
            )
        foot = foot.with_name(foot.chosen, str(value + 1))
        reason = "kept" if self._rng.random() < 0.2 else ""
        records.prescriptions.save(visit_id, foot, opened.bases.get(Side.LEFT), reason)
        self._note(counter=visit_id, value=value + 1)

    def _add_person(self, records: Records) -> None:
        person = records.persons.add(Person("Ben", notes="new"))
        self._note(person=person.id)

    def _add_capture(self, records: Records) -> None:
        self._scan.write_bytes(self._rng.randbytes(20_000))
        visit_id = self._rng.choice(self._subjects.visits)
        capture = records.captures.add(visit_id, MESH, self._scan)
        self._note(capture=capture.id)


def started(writer: Writer) -> int:
    """Start a process that writes until it is killed; return its number."""
    pid = os.fork()
    if pid == 0:
        code = TRACEBACK
        try:
            writer.work()
        except RecordsError as error:  # it could not even be opened
            os.write(2, f"{error}\n".encode())
            code = 0
        except BaseException as error:  # noqa: BLE001 - whatever it is, it is what is looked for
            os.write(2, f"{error!r}\n".encode())
        finally:
            os._exit(code)
    return pid


def faults_of(place: RecordsPlace, subjects: Subjects, notes: list[Path]) -> Counter[str]:
    """Open the record anew, and count what is wrong with it.

    ``lost`` is an acknowledged write that is not there; ``torn`` one whose parts do not belong
    together; ``broken`` what the database, the log or the files say against themselves.
    """
    faults: Counter[str] = Counter()
    records = open_records(place, Author("judge", "judge"))
    counters, persons, captures = _acknowledged(notes)
    for person_id in subjects.persons:
        value = int(records.persons.get(person_id).notes or "0")
        faults["lost"] += value < counters.get(person_id, 0)
        faults["torn"] += value != _changes(records, "person", person_id)
    for visit_id in subjects.visits:
        foot = records.visits.open_case(visit_id).record.of_side(Side.LEFT)
        faults["lost"] += (0 if foot is None else int(foot.chosen)) < counters.get(visit_id, 0)
    for known, get in ((persons, records.persons.get), (captures, records.captures.get)):
        for id_ in known:
            try:
                get(id_)
            except RecordsError:
                faults["lost"] += 1
    faults["broken"] += _broken(records)
    records.close()
    return faults


def counts_of(place: RecordsPlace, subjects: Subjects) -> int:
    """Return the sum of all counters."""
    records = open_records(place, Author("judge", "judge"))
    total = sum(int(records.persons.get(id_).notes or "0") for id_ in subjects.persons)
    for visit_id in subjects.visits:
        foot = records.visits.open_case(visit_id).record.of_side(Side.LEFT)
        total += 0 if foot is None else int(foot.chosen)
    records.close()
    return total


def acknowledged_counts(notes: list[Path]) -> int:
    """Return how often a writer was told that it has counted."""
    return sum("counter" in line for path in notes for line in path.read_text().splitlines())


def refusals(notes: list[Path]) -> int:
    """Return how often a writer was refused, conflicts apart."""
    return sum("refused" in line for path in notes for line in path.read_text().splitlines())


def _acknowledged(notes: list[Path]) -> tuple[dict[str, int], list[str], list[str]]:
    counters: dict[str, int] = {}
    persons, captures = [], []
    for path in notes:
        for line in path.read_text().splitlines() if path.exists() else ():
            written = json.loads(line)
            if "counter" in written:
                value = max(counters.get(written["counter"], 0), written["value"])
                counters[written["counter"]] = value
            persons += [written["person"]] if "person" in written else []
            captures += [written["capture"]] if "capture" in written else []
    return counters, persons, captures


def _changes(records: Records, kind: str, id_: str) -> int:
    """Return how many changes of a subject the audit log holds."""
    with records.context.database.reading() as connection:
        query = select(audit.c.seq).where(
            audit.c.subject_id == id_, audit.c.subject_kind == kind, audit.c.action == "changed"
        )
        return len(connection.execute(query).all())


def _broken(records: Records) -> int:
    """Count what the database, the log and the files say against themselves."""
    with records.context.database.reading() as connection:
        used = {row.sha256: row.size for row in connection.execute(select(contents))}
        found: list[object] = []
        if records.place.is_local:
            found += connection.execute(text("PRAGMA foreign_key_check")).all()
            found += [
                row for row in connection.execute(text("PRAGMA integrity_check")) if row[0] != "ok"
            ]
    report = records.contents.verify(used)
    is_sound = report.is_sound and not report.foreign
    return len(found) + (not is_sound) + (not records.audit.verify().is_intact)
