"""The prescriptions of the record, with all their versions.

One editing of one author writes one version, over and over, until it is closed: by a reason to keep
it, an order, a signature, or a version after it. A closed version never changes.
"""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import dataclass, replace
from datetime import date
from functools import cached_property
from threading import Lock
from typing import Any, Final
from uuid import UUID, uuid5
from weakref import WeakKeyDictionary

from sqlalchemy import Connection, Row, Select, exists, insert, or_, select, update

from insole_core.cases.case_json import foot_from_json, foot_to_json, source_from_json
from insole_core.cases.case_record import FootRecord
from insole_core.cases.scan_source import ScanSource
from insole_core.cases.stored_mesh import pack_mesh, unpack_mesh
from insole_core.errors import Conflict, RecordsError
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.side import Side
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.prescription.design_json import design_from_json
from insole_core.json_object import JsonObject
from insole_core.records.audit import AuditLog
from insole_core.records.author import program_version, utc_now
from insole_core.records.checked_values import word_of
from insole_core.records.content_store import ContentStore
from insole_core.records.context import RecordsContext, refer_to
from insole_core.records.field_checks import check_text
from insole_core.records.person import new_id
from insole_core.records.prescription import Base, ScannedFoot, VersionSummary
from insole_core.records.rights import Right
from insole_core.records.schema import captures, prescription_versions, visits
from insole_core.records.signing import PRESCRIPTION, Signature, sign

_VERSIONS: Final = prescription_versions.c
_SUMMARY: Final = (
    _VERSIONS.id,
    _VERSIONS.visit_id,
    _VERSIONS.side,
    _VERSIONS.number,
    _VERSIONS.author,
    _VERSIONS.station,
    _VERSIONS.reason,
    _VERSIONS.program_version,
    _VERSIONS.created_at,
    _VERSIONS.changed_at,
    _VERSIONS.revision,
    _VERSIONS.is_closed,
    _VERSIONS.signed_by,
    _VERSIONS.signed_at,
    _VERSIONS.signature,
    _VERSIONS.capture_id,
)
_LATER: Final = prescription_versions.alias("later")
_IS_NEWEST: Final = ~exists().where(
    _LATER.c.visit_id == _VERSIONS.visit_id,
    _LATER.c.side == _VERSIONS.side,
    _LATER.c.number > _VERSIONS.number,
)
"""Whether no other version of the foot on that visit came after it."""
_IN_CONFLICT: Final = "Kept beside the version of another station"


@dataclass(frozen=True)
class NewestVersion:
    """The newest version of a foot on a visit.

    What its document says is read only when it is asked for, so that a damaged one costs no more.

    Parameters
    ----------
    document
        JSON.
    """

    summary: VersionSummary
    document: str

    @property
    def design(self) -> InsoleDesign:
        """What it prescribes.

        Raises
        ------
        InsoleError
            When it cannot be read.
        """
        return _chosen_design(self._content)

    def prescribes(self, prescribes: Callable[[InsoleDesign], bool]) -> bool:
        """Return whether a foot may get its prescription, as for `Prescriptions.last_prescribed`.

        Raises
        ------
        InsoleError
            When it cannot be read.
        """
        return _holds_prescription(self._content, prescribes)

    @cached_property
    def source(self) -> ScanSource:
        """What the foot was made from.

        Raises
        ------
        InsoleError
            When it cannot be read.
        """
        return source_from_json(self._content.object("source"))

    @cached_property
    def _content(self) -> JsonObject:
        return _document(self.summary.side, self.summary.number, self.document)


class Prescriptions:
    """Writes and reads versions of prescriptions."""

    def __init__(self, context: RecordsContext) -> None:
        self._context = context
        self._meshes = _StoredMeshes(context.contents)

    def save(
        self,
        visit_id: str,
        foot: FootRecord,
        base: Base | None,
        reason: str = "",
        editing: str = "",
    ) -> Base:
        """Store the prescription of a foot.

        Parameters
        ----------
        base
            What `Visits.open_case` or the last saving returned; None when the visit had no such
            foot. A version that this editing began is continued, any other is followed by a new
            one.
        reason
            With one, the version is kept as it is now, and the next change begins another one.
        editing
            UUID of the editing, by which it knows what it has stored though the answer was lost,
            and goes on with it. Whoever gives one must not store older work after newer one.

        Returns
        -------
        Base
            For the next saving.

        Raises
        ------
        Conflict
            When the newest version is not the one that this work is based on: `mine` is the foot,
            `theirs` the `VersionSummary`. Nothing was written; see `settle`.
        RecordsError, OutputError
            When it cannot be stored.
        """
        reason = check_text(reason, "reason", 2000)
        content = self._content(foot)
        with self._context.writing_visit(Right.WRITE, visit_id) as (connection, _):
            newest = _newest(connection, visit_id, foot.side)
            next_id = _next_id(editing, foot.side, base)
            if newest is not None and editing and _is_unanswered(newest, base, next_id):
                base = Base(newest.id, newest.revision, is_mine=True)
                next_id = _next_id(editing, foot.side, base)
            _check_base(newest, base, foot)
            if newest is not None and base is not None and not reason and content.equals(newest):
                return base
            if newest is not None and base is not None and self._continues(newest, base):
                written = self._update(connection, newest, content)
            else:
                written = self._insert(connection, visit_id, newest, content, next_id)
            if reason:
                _close(connection, written.version_id, reason)
                written = Base(written.version_id, written.revision)
            self._log(connection, "kept" if reason else "changed", written, foot.side)
        return written

    def settle(
        self, visit_id: str, mine: FootRecord, theirs: VersionSummary, chosen: FootRecord
    ) -> Base:
        """Settle a conflict: both versions stay in the history, and the chosen one is the newest.

        Parameters
        ----------
        mine
            As in the `Conflict`; it becomes a closed version after theirs.
        chosen
            `mine`, what `read` returns for theirs, or a foot that holds both as variants.

        Raises
        ------
        Conflict
            When somebody has changed the prescription since `theirs`.
        """
        mine_content, chosen_content = self._content(mine), self._content(chosen)
        with self._context.writing_visit(Right.WRITE, visit_id) as (connection, _):
            newest = _newest(connection, visit_id, mine.side)
            _check_base(newest, Base(theirs.id, theirs.revision), mine)
            written = first = self._insert(connection, visit_id, newest, mine_content)
            if chosen is not mine:
                _close(connection, written.version_id, _IN_CONFLICT)
                last = _newest(connection, visit_id, mine.side)
                written = self._insert(connection, visit_id, last, chosen_content)
            author, beside = self._context.author, [] if chosen is mine else [first.version_id]
            AuditLog.seal(connection, author, PRESCRIPTION, beside)
            self._log(connection, "settled", written, mine.side)
        return written

    def versions(self, visit_id: str, side: Side) -> list[VersionSummary]:
        """Return the versions of one foot on one visit, the newest first."""
        query: Select[Any] = select(*_SUMMARY)
        query = query.where(_VERSIONS.visit_id == visit_id, _VERSIONS.side == side)
        with self._context.reading() as connection:
            rows = connection.execute(query.order_by(_VERSIONS.number.desc())).all()
        return [summary_of(row) for row in rows]

    def read(self, version_id: str) -> FootRecord:
        """Return the foot of a version.

        Raises
        ------
        RecordsError
            When there is none, or its surface is missing or was changed on the disk.
        """
        with self._context.reading() as connection:
            row = connection.execute(
                select(prescription_versions).where(_VERSIONS.id == version_id)
            ).one_or_none()
        if row is None:
            raise _gone()
        return self.foot_of(row)

    def newest(self, visit_id: str) -> list[NewestVersion]:
        """Return the newest version of each foot of a visit, the left one first.

        No surface is read.
        """
        with self._context.reading() as connection:
            rows = self.newest_of(connection, visit_id)
            return [NewestVersion(summary_of(row), row.document) for row in rows]

    def last_prescribed(
        self, person_id: str, prescribes: Callable[[InsoleDesign], bool]
    ) -> list[FootRecord]:
        """Return for each foot of a person the last version that prescribes something.

        It may be of any visit; of other versions, no surface is read.

        Parameters
        ----------
        prescribes
            Whether a design does; a version does too that keeps the prescription of a scan before.

        Raises
        ------
        RecordsError
            When a surface is missing or was changed on the disk.
        """
        last: dict[str, Row[Any]] = {}
        for row in self._newest_of_person(person_id):
            if row.side not in last and _holds_prescription(_document_of(row), prescribes):
                last[row.side] = row
        return [self.foot_of(row) for row in last.values()]

    def last_scanned(self, person_id: str) -> list[ScannedFoot]:
        """Return the versions that hold the last scan of each foot of a person, the left one first.

        A mirror image is one only for a foot that was never scanned. No surface is read.
        """
        scanned: dict[Side, ScannedFoot] = {}
        images: dict[Side, ScannedFoot] = {}
        for row in self._newest_of_person(person_id):
            side = word_of(Side, row.side)
            source = source_from_json(_document_of(row).object("source"))
            day = date.fromisoformat(source.scanned_on) if source.scanned_on else row.visited_on
            kind = images if source.mirrored else scanned
            kind.setdefault(side, ScannedFoot(side, row.id, day))
        last = images | scanned
        return [last[side] for side in Side if side in last]

    def packed_surface(self, version_id: str) -> bytes:
        """Return the surface of a version's foot as it is stored: an ``.npz`` of a case file.

        Raises
        ------
        RecordsError
            As for `read`.
        """
        with self._context.reading() as connection:
            query = select(_VERSIONS.mesh_sha256).where(_VERSIONS.id == version_id)
            sha256 = connection.execute(query).scalar()
        if sha256 is None:
            raise _gone()
        return self._context.contents.read(sha256)

    def close(self, version_id: str, reason: str) -> None:
        """Keep a version as it is, for a reason.

        Raises
        ------
        RecordsError
            When it is closed already.
        """
        reason = check_text(reason, "reason", 2000)
        with self._context.reading() as connection:
            visit_id, side = _visit_and_side(connection, version_id)
        with self._context.writing_visit(Right.WRITE, visit_id) as (connection, _):
            newest = _newest(connection, visit_id, side)
            if newest is None or newest.id != version_id or newest.is_closed:
                raise RecordsError("This version is closed already; it stays as it is.")
            _close(connection, version_id, reason)
            self._log(connection, "kept", Base(version_id, newest.revision), side)

    def sign(self, version_id: str) -> Signature:
        """Sign a version, which closes it for good.

        Raises
        ------
        NotAllowed
            When the account may not sign.
        RecordsError
            When there is no such version, or it is signed already.
        """
        with self._context.reading() as connection:
            visit_id, _ = _visit_and_side(connection, version_id)
        with self._context.writing_visit(Right.SIGN, visit_id) as (connection, _):
            return sign(connection, version_id, self._context.author)

    def foot_of(self, row: Row[Any]) -> FootRecord:
        """Return the foot of a row of the table."""
        document = _document_of(row)
        packed = self._context.contents.read(row.mesh_sha256)
        foot = foot_from_json(document, lambda side: unpack_mesh(f"{side}.npz", packed))
        self._meshes.remember(foot.foot.mesh, row.mesh_sha256, len(packed))
        return foot

    def newest_of(self, connection: Connection, visit_id: str) -> list[Row[Any]]:
        """Return the rows of the newest version of each foot of a visit, the left one first."""
        query = select(prescription_versions).where(_VERSIONS.visit_id == visit_id, _IS_NEWEST)
        return list(connection.execute(query.order_by(_VERSIONS.side)).all())

    def _newest_of_person(self, person_id: str) -> list[Row[Any]]:
        """Return the newest version of each foot of each visit, those of the latest visit first."""
        query = (
            select(prescription_versions, visits.c.visited_on)
            .join(visits, visits.c.id == _VERSIONS.visit_id)
            .where(visits.c.person_id == person_id, _IS_NEWEST)
            .order_by(visits.c.visited_on.desc(), visits.c.created_at.desc())
            .order_by(_VERSIONS.number.desc())
        )
        with self._context.reading() as connection:
            return list(connection.execute(query).all())

    def _content(self, foot: FootRecord) -> _Content:
        kept = replace(foot, source=foot.source.with_needed_place())
        document = json.dumps(foot_to_json(kept), ensure_ascii=False)
        sha256, size = self._meshes.put(foot.foot.mesh)
        return _Content(document, sha256, size, foot.side, foot.source.sha256)

    def _continues(self, newest: Row[Any], base: Base) -> bool:
        author = self._context.author
        is_same_author = (newest.author, newest.station) == (author.name, author.station)
        return base.is_mine and is_same_author and not newest.is_closed

    def _update(self, connection: Connection, newest: Row[Any], content: _Content) -> Base:
        content.refer(connection)
        row = update(prescription_versions).where(_VERSIONS.id == newest.id)
        revision = newest.revision + 1
        connection.execute(
            row.values(
                document=content.document,
                mesh_sha256=content.mesh_sha256,
                capture_id=_capture_of(connection, newest.visit_id, content.source_sha256),
                program_version=program_version(),
                changed_at=utc_now(),
                revision=revision,
            )
        )
        return Base(newest.id, revision, is_mine=True)

    def _insert(
        self,
        connection: Connection,
        visit_id: str,
        newest: Row[Any] | None,
        content: _Content,
        version_id: str = "",
    ) -> Base:
        if newest is not None and not newest.is_closed:
            _close(connection, newest.id, newest.reason)
        content.refer(connection)
        now = utc_now()
        values = {
            "id": version_id or new_id(),
            "visit_id": visit_id,
            "side": str(content.side),
            "number": 1 if newest is None else newest.number + 1,
            "document": content.document,
            "mesh_sha256": content.mesh_sha256,
            "capture_id": _capture_of(connection, visit_id, content.source_sha256),
            "author": self._context.author.name,
            "station": self._context.author.station,
            "program_version": program_version(),
            "created_at": now,
            "changed_at": now,
            "revision": 1,
        }
        connection.execute(insert(prescription_versions).values(values))
        return Base(str(values["id"]), 1, is_mine=True)

    def _log(self, connection: Connection, action: str, written: Base, side: Side) -> None:
        self._context.log(
            connection,
            action,
            "prescription",
            written.version_id,
            side=str(side),
            revision=written.revision,
        )


@dataclass(frozen=True)
class _Content:
    """What a version states, with its surface stored already."""

    document: str
    mesh_sha256: str
    mesh_size: int
    side: Side
    source_sha256: str

    def equals(self, row: Row[Any]) -> bool:
        return bool((row.document, row.mesh_sha256) == (self.document, self.mesh_sha256))

    def refer(self, connection: Connection) -> None:
        refer_to(connection, self.mesh_sha256, self.mesh_size, "mesh")


class _StoredMeshes:
    """Remembers which surfaces are stored, so that a drag does not pack one again and again."""

    def __init__(self, store: ContentStore) -> None:
        self._store = store
        self._known: WeakKeyDictionary[TriangleMesh, tuple[str, int]] = WeakKeyDictionary()
        self._lock = Lock()

    def put(self, mesh: TriangleMesh) -> tuple[str, int]:
        """Store a surface; return its SHA-256 and its size in bytes."""
        with self._lock:
            known = self._known.get(mesh)
        if known is not None:
            return known
        packed = pack_mesh(mesh)
        sha256 = self._store.put(packed)
        self.remember(mesh, sha256, len(packed))
        return sha256, len(packed)

    def remember(self, mesh: TriangleMesh, sha256: str, size: int) -> None:
        """Note that a surface is stored."""
        with self._lock:
            self._known[mesh] = sha256, size


def _document_of(row: Row[Any]) -> JsonObject:
    return _document(row.side, row.number, row.document)


def _document(side: str, number: int, text: str) -> JsonObject:
    return JsonObject.parse(f"{side}, version {number}", text.encode())


def _holds_prescription(document: JsonObject, prescribes: Callable[[InsoleDesign], bool]) -> bool:
    """Return whether a version prescribes something, or keeps what a scan before was prescribed."""
    return document.has("earlier") or prescribes(_chosen_design(document))


def _chosen_design(document: JsonObject) -> InsoleDesign:
    chosen = document.text("chosen")
    variants = document.objects("variants")
    variant = next(found for found in variants if found.text("name") == chosen)
    return design_from_json(variant.value("design"))


def summary_of(row: Row[Any]) -> VersionSummary:
    """Return the summary of a row that holds its columns."""
    values = {column.name: row._mapping[column.name] for column in _SUMMARY}
    return VersionSummary(**values | {"side": word_of(Side, row.side)})


def _newest(connection: Connection, visit_id: str, side: Side) -> Row[Any] | None:
    query = (
        select(prescription_versions)
        .where(_VERSIONS.visit_id == visit_id, _VERSIONS.side == side)
        .order_by(_VERSIONS.number.desc())
        .limit(1)
    )
    return connection.execute(query).one_or_none()


def _next_id(editing: str, side: Side, base: Base | None) -> str:
    """Return the key of the version that an editing begins after another one."""
    if not editing:
        return new_id()
    return str(uuid5(UUID(editing), f"{side} {'' if base is None else base.version_id}"))


def _is_unanswered(newest: Row[Any], base: Base | None, next_id: str) -> bool:
    """Return whether the newest version was stored by the same editing, without an answer."""
    if base is not None and base.is_mine and newest.id == base.version_id:
        return bool(newest.revision > base.revision)
    return bool(newest.id == next_id)


def _check_base(newest: Row[Any] | None, base: Base | None, foot: FootRecord) -> None:
    """Raise a `Conflict` unless the newest version is the one that the work is based on."""
    if newest is None:
        return
    if base is not None and (base.version_id, base.revision) == (newest.id, newest.revision):
        return
    raise Conflict(
        foot,
        summary_of(newest),
        "{author} at {station} has changed the {side} foot meanwhile; compare both versions and "
        "choose.",
        author=newest.author,
        station=newest.station,
        side=newest.side,
    )


def _close(connection: Connection, version_id: str, reason: str) -> None:
    row = update(prescription_versions).where(_VERSIONS.id == version_id)
    connection.execute(row.values(is_closed=True, reason=reason))


def _capture_of(connection: Connection, visit_id: str, source_sha256: str) -> str | None:
    """Return the capture that a foot of a visit was made from: of it, or of an earlier one."""
    is_source = or_(
        captures.c.source_sha256 == source_sha256, captures.c.content_sha256 == source_sha256
    )
    person_id = select(visits.c.person_id).where(visits.c.id == visit_id).scalar_subquery()
    query = select(captures.c.id).join(visits, visits.c.id == captures.c.visit_id)
    query = query.where(visits.c.person_id == person_id, is_source)
    query = query.order_by(
        captures.c.visit_id != visit_id, captures.c.created_at.desc(), captures.c.number.desc()
    )
    found: str | None = connection.execute(query.limit(1)).scalar()
    return found


def _visit_and_side(connection: Connection, version_id: str) -> tuple[str, Side]:
    query = select(_VERSIONS.visit_id, _VERSIONS.side).where(_VERSIONS.id == version_id)
    row = connection.execute(query).one_or_none()
    if row is None:
        raise _gone()
    return row.visit_id, word_of(Side, row.side)


def _gone() -> RecordsError:
    return RecordsError(
        "This version is no longer in the record; open the history of the visit again."
    )
