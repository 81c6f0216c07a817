"""The captures of the record: sessions of sensors, and scans of other devices."""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator
from pathlib import Path, PurePath
from typing import Any, Final

from sqlalchemy import Connection, Row, func, insert, select, update

from insole_core.errors import InputError, RecordsError
from insole_core.files.atomic import scratch_folder
from insole_core.formats.file_formats import SCAN_SUFFIXES
from insole_core.given_file import given_errors, sha256_of
from insole_core.recording.hand_edits_file import edits_path
from insole_core.recording.writer import MANIFEST, pack_corrected, pack_session
from insole_core.records.author import program_version, utc_now
from insole_core.records.capture import Capture, CaptureFacts
from insole_core.records.content_store import MOST_BYTES
from insole_core.records.context import RecordsContext, put_file, refer_to
from insole_core.records.field_checks import check_line
from insole_core.records.person import new_id
from insole_core.records.record_field import Made, fields_of
from insole_core.records.rights import Right
from insole_core.records.schema import captures, visits
from insole_core.records.visit import CaptureState

SESSION: Final = "session"
MESH: Final = "mesh"
_MESH_SUFFIXES: Final = (*SCAN_SUFFIXES, ".zip")
_FACTS: Final = fields_of(CaptureFacts)
_JSON: Final = tuple(n for n, f in _FACTS.items() if isinstance(f, Made) and f.is_json)


class Captures:
    """Stores and finds captures."""

    def __init__(self, context: RecordsContext) -> None:
        self._context = context

    def add(
        self, visit_id: str, kind: str, path: Path, facts: CaptureFacts | None = None
    ) -> Capture:
        """Store a session or a scan with a visit; the capture room has done its work for it.

        What the visit has already is not stored again.

        Parameters
        ----------
        kind
            `SESSION` or `MESH`.
        path
            The folder or archive of a session, or the file of a scan.

        Raises
        ------
        InputError
            When it cannot be read.
        RecordsError, OutputError
            When it cannot be stored.
        """
        if kind not in (SESSION, MESH):
            raise InputError("{kind} is no kind of a capture; use session or mesh.", kind=kind)
        facts = facts or CaptureFacts()
        source = path / MANIFEST if path.is_dir() else path
        with given_errors(source, MOST_BYTES):
            source_sha256 = sha256_of(source, MOST_BYTES)
        sha256, size = self._put(path, kind)
        capture = Capture(
            id=new_id(),
            visit_id=visit_id,
            kind=kind,
            file_name=check_line(path.name[-200:], "name of the file"),
            content_sha256=sha256,
            source_sha256=source_sha256,
            facts=facts,
            program_version=program_version(),
            created_at=utc_now(),
            author=self._context.author.name,
        )
        with self._context.writing_visit(Right.CAPTURE, visit_id) as (connection, _):
            _end_work(connection, visit_id)
            same = _with_content(connection, visit_id, sha256)
            if same is not None:
                return same
            refer_to(connection, sha256, size, kind)
            number = _count(connection, visit_id) + 1
            connection.execute(insert(captures).values(_values(capture) | {"number": number}))
            self._context.log(
                connection, "added", "capture", capture.id, visit=visit_id, sha256=sha256
            )
        return capture

    def of_visit(self, visit_id: str) -> list[Capture]:
        """Return the captures of a visit, the newest first; each as it was corrected last."""
        query = select(captures).where(captures.c.visit_id == visit_id)
        with self._context.reading() as connection:
            rows = connection.execute(query.order_by(captures.c.number.desc())).all()
        return list(_as_corrected(map(_capture, rows)))

    def get(self, capture_id: str) -> Capture:
        """Return a capture.

        Raises
        ------
        RecordsError
            When there is none.
        """
        query = select(captures).where(captures.c.id == capture_id)
        with self._context.reading() as connection:
            row = connection.execute(query).one_or_none()
        if row is None:
            raise RecordsError("This capture is no longer in the record; open the visit again.")
        return _capture(row)

    def copy_to(self, capture: Capture, folder: Path) -> Path:
        """Write a verified copy of a capture into a folder, to open it; return its path.

        Raises
        ------
        RecordsError
            When it is missing, or was changed on the disk.
        OutputError
            When the folder cannot be written.
        """
        suffix = PurePath(capture.file_name).suffix.lower()
        is_scan = capture.kind == MESH and suffix in _MESH_SUFFIXES
        path = folder / f"{capture.kind}-{capture.id[:8]}{suffix if is_scan else '.zip'}"
        self._context.contents.copy_to(capture.content_sha256, path)
        return path

    def _put(self, path: Path, kind: str) -> tuple[str, int]:
        """Store a file, or a session with its corrections; return SHA-256 and size in bytes."""
        is_corrected = kind == SESSION and path.is_file() and edits_path(path).is_file()
        if not path.is_dir() and not is_corrected:
            return put_file(self._context.contents, path)
        pack = pack_corrected if is_corrected else pack_session
        store = self._context.contents
        store.identity()  # makes its folder
        with scratch_folder(store.folder / "session.zip") as parts:
            packed = parts / "session.zip"
            with given_errors(path, MOST_BYTES):
                pack(path, packed)
            return put_file(store, packed)


def _as_corrected(newest_first: Iterable[Capture]) -> Iterator[Capture]:
    """Leave out sessions that were stored again with corrections, such as which foot they show."""
    corrected: set[str] = set()
    for capture in newest_first:
        if corrected.isdisjoint({capture.source_sha256, capture.content_sha256}):
            yield capture
        if capture.kind == SESSION and capture.source_sha256:
            corrected.add(capture.source_sha256)


def _with_content(connection: Connection, visit_id: str, sha256: str) -> Capture | None:
    """Return the capture of a visit that has this content."""
    query = select(captures).where(
        captures.c.visit_id == visit_id, captures.c.content_sha256 == sha256
    )
    row = connection.execute(query.order_by(captures.c.number)).first()
    return None if row is None else _capture(row)


def _count(connection: Connection, visit_id: str) -> int:
    query = select(func.count()).select_from(captures).where(captures.c.visit_id == visit_id)
    return connection.execute(query).scalar_one()


def _end_work(connection: Connection, visit_id: str) -> None:
    is_wanted = visits.c.capture_state == CaptureState.WANTED
    row = update(visits).where(visits.c.id == visit_id, is_wanted)
    connection.execute(
        row.values(
            capture_state=CaptureState.DONE, changed_at=utc_now(), revision=visits.c.revision + 1
        )
    )


def _values(capture: Capture) -> dict[str, Any]:
    values = vars(capture).copy()
    facts = vars(values.pop("facts"))
    dumped = {name: json.dumps(facts[name]) for name in _JSON}
    return {**values, **facts, **dumped}


def _capture(row: Row[Any]) -> Capture:
    values = dict(row._mapping)
    del values["number"]
    facts = {name: values.pop(name) for name in _FACTS}
    facts |= {name: json.loads(facts[name]) for name in _JSON}
    facts["sensor_serials"] = tuple(facts["sensor_serials"])
    return Capture(**values, facts=CaptureFacts(**facts))
