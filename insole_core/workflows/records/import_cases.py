"""Adding the case files of a folder to the record: first what would be done, then one by one.

Each case becomes a visit. What the record holds already is found by its content, so an import that
was interrupted goes on where it stopped.
"""

from __future__ import annotations

import logging
import os
import re
from dataclasses import dataclass, replace
from datetime import date
from pathlib import Path
from typing import Final

import numpy as np

from insole_core.cases.case_file import read_case_and_digest
from insole_core.cases.case_json import foot_to_json
from insole_core.cases.case_record import CaseRecord, FootRecord, Patient
from insole_core.cases.days import read_day
from insole_core.cases.scan_source import ScanSource
from insole_core.errors import InputError, RecordsError, Unreachable
from insole_core.given_file import sha256_of
from insole_core.messages import Message
from insole_core.progress import SILENT, Progress
from insole_core.recording.writer import MANIFEST
from insole_core.records.content_store import MOST_BYTES
from insole_core.records.field_checks import check_text
from insole_core.records.person import Person, PersonSummary, new_pseudonym
from insole_core.records.person_import import Outcome
from insole_core.records.person_matching import PersonIndex, summary_of
from insole_core.records.records import Records
from insole_core.records.visit import Visit
from insole_core.workflows.records.capture_facts import capture_facts

log = logging.getLogger(__name__)

SUFFIX: Final = ".insole"
MOST_FILES: Final = 20_000
MOST_REASON: Final = 2000
"""Characters of the reason of a version."""
_ORDER_NUMBER: Final = re.compile(r"\d{2}-[0-9A-Z]{5}")
"""Stands in a case where the workshop knew no pseudonym."""


@dataclass(frozen=True)
class CaseLine:
    """What becomes of one file, and why.

    Parameters
    ----------
    path
        Within the folder, with ``/``.
    name, day
        Of patient and visit; empty and None where the file does not tell.
    reason
        Empty where there is nothing to say.
    """

    path: str
    outcome: Outcome
    name: str = ""
    day: date | None = None
    reason: str = ""


@dataclass(frozen=True)
class CasePlan:
    """What becomes of all case files of a folder."""

    lines: tuple[CaseLine, ...]

    def of(self, *outcomes: Outcome) -> list[CaseLine]:
        """Return the lines with some outcomes."""
        return [line for line in self.lines if line.outcome in outcomes]


def plan_cases(records: Records, folder: Path, progress: Progress = SILENT) -> CasePlan:
    """Return what becomes of the case files in a folder and in those below it.

    A case belongs to the person with the same name and birth date, or with the same pseudonym. One
    that may belong to somebody, but says too little, is doubtful.

    Raises
    ------
    InputError
        When the folder holds no case files, or cannot be read.
    Cancelled
    """
    return _import(records, folder, progress, is_dry=True, with_doubtful=False)


def import_cases(
    records: Records, folder: Path, *, with_doubtful: bool = False, progress: Progress = SILENT
) -> CasePlan:
    """Add the case files of a folder that the record does not hold, each as a visit.

    Parameters
    ----------
    with_doubtful
        Whether doubtful ones are added as new persons, who can be merged with others later.

    Returns
    -------
    CasePlan
        What was done.

    Raises
    ------
    InputError
        When the folder holds no case files, or cannot be read.
    RecordsError, OutputError
        When the record cannot be written. The cases before are in it.
    Cancelled
        The cases before are in the record.
    """
    return _import(records, folder, progress, is_dry=False, with_doubtful=with_doubtful)


def _import(
    records: Records, folder: Path, progress: Progress, *, is_dry: bool, with_doubtful: bool
) -> CasePlan:
    paths = _case_files(folder)
    planner = _Planner(records)
    added = {Outcome.NEW, Outcome.DOUBTFUL} if with_doubtful else {Outcome.NEW}
    lines = []
    for number, path in enumerate(paths):
        progress.step(number / len(paths), "Reading {name}", name=path.name)
        name = path.relative_to(folder).as_posix()
        line, found = planner.planned(path, name)
        if found is not None and line.outcome in added and not is_dry:
            planner.add(found, name)
        lines.append(line)
    return CasePlan(tuple(lines))


def _case_files(folder: Path) -> list[Path]:
    """Return the case files of a folder and those below it, in the order of their names.

    Raises
    ------
    InputError
        When there are none, far too many, or a folder cannot be read.
    """
    found: list[Path] = []
    try:
        for place, folders, names in os.walk(folder, onerror=_raise):
            folders[:] = sorted(name for name in folders if not name.startswith("."))
            cases = (name for name in sorted(names) if name.lower().endswith(SUFFIX))
            found += [Path(place, name) for name in cases if not name.startswith(".")]
            if len(found) > MOST_FILES:
                raise InputError(
                    "{folder} holds more than {most} cases; choose the folders in it one by one.",
                    folder=folder,
                    most=MOST_FILES,
                )
    except OSError as error:
        raise InputError(
            "{folder} cannot be read: {reason}; check its name.",
            folder=error.filename or folder,
            reason=error.strerror or str(error),
        ) from error
    if not found:
        raise InputError(
            "{folder} holds no case files ({suffix}); choose another folder.",
            folder=folder,
            suffix=SUFFIX,
        )
    return found


def _raise(error: OSError) -> None:
    raise error


@dataclass(frozen=True, eq=False)
class _Found:
    """A case that was read, with the person and the visit it belongs to.

    Parameters
    ----------
    person
        Stored, or new with revision 0.
    visit
        New with revision 0, or a stored one that lacks a foot of the case.
    feet
        Those that the visit does not hold.
    """

    case: CaseRecord
    person: Person
    visit: Visit
    feet: tuple[FootRecord, ...]


class _Planner:
    """Compares each case with the record and with the cases before it."""

    def __init__(self, records: Records) -> None:
        self._records = records
        self._index = PersonIndex(records.persons.everybody())
        self._doubtful = PersonIndex(())
        """Apart: nobody is doubtful because of them."""
        self._new: dict[str, Person] = {}
        self._path_of: dict[str, str] = {}

    def planned(self, path: Path, name: str) -> tuple[CaseLine, _Found | None]:
        """Return what becomes of the next case, and what is to be added for it."""
        line = CaseLine(name, Outcome.REFUSED)
        try:
            case, digest = read_case_and_digest(path)
            line = replace(line, name=case.patient.name)
            if digest in self._path_of:
                reason = Message("It is the same as {name}.", name=self._path_of[digest])
                return replace(line, outcome=Outcome.REPEATED, reason=reason), None
            self._path_of[digest] = name
            line = replace(line, day=_day_of(case))
            return self._placed(line, case, _day_of(case))
        except InputError as error:
            return replace(line, reason=error.message), None

    def add(self, found: _Found, name: str) -> None:
        """Store a case.

        Parameters
        ----------
        name
            Of its file.

        Raises
        ------
        RecordsError, OutputError
            When it cannot be stored.
        """
        person = found.person
        if person.revision == 0:
            person = self._records.persons.add(person)
            self._new[person.id] = person
        visit = found.visit
        if visit.revision == 0:
            visit = self._records.visits.add(visit)
        for source in dict.fromkeys(foot.source for foot in found.feet):
            self._add_scan(visit, source)
        number = found.case.patient.pseudonym
        reason = f"Imported from {name}" + (f", {number}" if number else "")
        for foot in found.feet:  # the scan is in the record by now, or where the file tells
            placeless = replace(foot, source=foot.source.without_place())
            self._records.prescriptions.save(visit.id, placeless, None, reason[:MOST_REASON])

    def _add_scan(self, visit: Visit, source: ScanSource) -> None:
        """Store the scan of a foot, which the case holds anyhow, if it can be had."""
        path = _unchanged_scan(source)
        if path is None:
            return
        try:
            self._records.captures.add(visit.id, source.kind, path, capture_facts(path))
        except InputError as error:
            log.warning("the scan of an imported case is not stored: %s", error)

    def _placed(
        self, line: CaseLine, case: CaseRecord, day: date
    ) -> tuple[CaseLine, _Found | None]:
        """Return what becomes of a case of a day, by its person and what that day holds of them.

        Raises
        ------
        InputError
            When the case names nobody, or its data cannot be right.
        """
        person, doubt = self._person_of(case.patient)
        if doubt is None:
            visit, feet = self._visit_of(person, case, day)
        else:
            visit, feet = self._visit_of_namesake(person, case, day)
        if visit.revision > 0 and not feet:
            return replace(line, outcome=Outcome.PRESENT), None
        found = _Found(case, person, visit, feet)
        if doubt is None:
            return replace(line, outcome=Outcome.NEW), found
        return replace(line, outcome=Outcome.DOUBTFUL, reason=doubt), found

    def _person_of(self, patient: Patient) -> tuple[Person, Message | None]:
        """Return the person of a case, and what makes that doubtful."""
        if not patient.name.strip():
            known = self._index.with_pseudonym(patient.pseudonym)
            if known is None:
                raise InputError("It names nobody whom the record knows; type the patient's name.")
            return self._known(known), None
        person = _person(patient)
        match = self._index.find(person)
        if match is not None and match.is_certain:
            return self._known(match.person), None
        if match is None:
            return self._noted(person, self._index), None
        earlier = self._doubtful.find(person)
        if earlier is not None and earlier.is_certain:
            return self._new[earlier.person.id], match.reason
        return self._noted(person, self._doubtful), match.reason

    def _noted(self, person: Person, index: PersonIndex) -> Person:
        """Return a new person, whom later cases find."""
        if self._index.with_pseudonym(person.pseudonym) is not None:
            person = replace(person, pseudonym=new_pseudonym())
        index.add(summary_of(person))
        self._new[person.id] = person
        return person

    def _known(self, known: PersonSummary) -> Person:
        return self._new.get(known.id) or self._records.persons.get(known.id)

    def _visit_of(
        self, person: Person, case: CaseRecord, day: date
    ) -> tuple[Visit, tuple[FootRecord, ...]]:
        """Return the visit of a case, and which feet of the case that does not hold."""
        if person.revision > 0:
            for visit in self._records.visits.of_person(person.id):
                missing = self._missing(visit, case) if visit.visited_on == day else None
                if missing is not None:
                    return visit, missing
        visit = Visit(person.id, day, findings=case.patient.notes)
        return visit.checked(date.today()), case.feet

    def _visit_of_namesake(
        self, person: Person, case: CaseRecord, day: date
    ) -> tuple[Visit, tuple[FootRecord, ...]]:
        """Do the same for somebody doubtful, who may have been added by an import before."""
        for match in self._index.matches(person):
            visit, missing = self._visit_of(self._known(match.person), case, day)
            if visit.revision > 0 and not missing:
                return visit, missing
        return self._visit_of(person, case, day)

    def _missing(self, visit: Visit, case: CaseRecord) -> tuple[FootRecord, ...] | None:
        """Return the feet of a case that a visit lacks; None when it holds other ones."""
        if visit.findings != check_text(case.patient.notes, "notes"):
            return None
        missing = []
        for foot in case.feet:
            versions = self._records.prescriptions.versions(visit.id, foot.side)
            if not versions:
                missing.append(foot)
            elif not any(self._is_same(version.id, foot) for version in versions):
                return None
        return tuple(missing)

    def _is_same(self, version_id: str, foot: FootRecord) -> bool:
        try:
            stored = self._records.prescriptions.read(version_id)
        except Unreachable:
            raise
        except RecordsError:  # damaged or missing: the file brings it back
            return False
        a, b = stored.foot.mesh, foot.foot.mesh
        is_same_mesh = np.array_equal(a.vertices, b.vertices) and np.array_equal(
            a.triangles, b.triangles
        )
        one, other = (
            foot_to_json(replace(each, source=each.source.without_place()))
            for each in (stored, foot)
        )
        return is_same_mesh and one == other


def _person(patient: Patient) -> Person:
    """Return the patient of a case as a new person.

    Raises
    ------
    InputError
        When a field cannot be right.
    """
    today = date.today()
    born = read_day("born", patient.born, today)
    pseudonym = patient.pseudonym.strip()
    if not pseudonym or _ORDER_NUMBER.fullmatch(pseudonym):
        pseudonym = new_pseudonym()
    birth_date = date.fromisoformat(born) if born else None
    return Person(patient.name, birth_date, pseudonym=pseudonym).checked(today)


def _day_of(case: CaseRecord) -> date:
    """Return the day of the visit; where it was not filled in, the day of the scan.

    Raises
    ------
    InputError
        When the case tells neither.
    """
    written = read_day("visit", case.patient.visit, date.today())
    scans = sorted(foot.source.recorded_at[:10] for foot in case.feet if foot.source.recorded_at)
    day = written or (read_day("visit", scans[0], date.today()) if scans else "")
    if not day:
        raise InputError("It has no date of a visit; open it and choose one.")
    return date.fromisoformat(day)


def _unchanged_scan(source: ScanSource) -> Path | None:
    """Return where the scan of a foot still lies as it was; None if it does not."""
    path = Path(source.path)
    try:
        digest = sha256_of(path / MANIFEST if path.is_dir() else path, MOST_BYTES)
    except (OSError, ValueError):  # on another computer, moved, or no name of a file here
        return None
    return path if digest == source.sha256 else None
