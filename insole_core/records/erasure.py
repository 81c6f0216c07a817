"""Removing what identifies a person, by the marks of the columns (`marks`).

Nothing here names a column that only identifies: a new one says on itself what becomes of it.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator, Mapping, Set
from datetime import date
from pathlib import PurePath
from typing import Any, Final

from sqlalchemy import (
    Column,
    ColumnElement,
    Connection,
    Row,
    Table,
    and_,
    delete,
    exists,
    select,
    update,
)

from insole_core.cases.name_words import holds_any, identifying_words
from insole_core.records.author import Author, utc_now
from insole_core.records.bare_files import BareFile, BareFiles
from insole_core.records.captures import SESSION
from insole_core.records.content_store import ContentStore
from insole_core.records.context import refer_to
from insole_core.records.marks import Erased, mark_of
from insole_core.records.person import new_pseudonym
from insole_core.records.row_seals import ids_of_persons
from insole_core.records.rows import ids_of_joined
from insole_core.records.schema import (
    captures,
    contents,
    empty_value,
    is_of_person,
    metadata,
    order_files,
    orders,
    persons,
    prescription_versions,
    tables_of_persons,
)
from insole_core.records.signing import is_as_signed, note_redaction
from insole_core.records.traces import Traces
from insole_core.scans.scan_folder import side_of_name
from insole_core.solids.order_number import new_order_number

REFERRING: Final = tuple(
    key.parent
    for table in metadata.sorted_tables
    for key in table.foreign_keys
    if key.column is contents.c.sha256
)
"""What refers to large files."""
_ANEW: Final[dict[Column[Any], Callable[[], str]]] = {
    persons.c.pseudonym: new_pseudonym,
    orders.c.number: lambda: new_order_number(date.today()),
}
"""How a text is drawn that has to be unique."""


class Eraser:
    """Removes what identifies one person, also from the rows of those merged into them.

    Parameters
    ----------
    connection
        In whose transaction the person is read, and erased.
    bare
        That may hold the person's files already, from `prepared`.
    """

    def __init__(
        self,
        connection: Connection,
        store: ContentStore,
        person_id: str,
        bare: BareFiles | None = None,
    ) -> None:
        joined = select(persons.c.id, persons.c.name).where(
            persons.c.id.in_(ids_of_joined(person_id))
        )
        names = {row.id: row.name for row in connection.execute(joined)}
        self._connection = connection
        self._ids = list(names)
        self._names = tuple(names.values())
        self._words: Set[str] = {
            word for name in names.values() for word in identifying_words(name)
        }
        self._bare = bare or BareFiles(store)

    def prepared(self) -> BareFiles:
        """Return the person's files without texts: to make them takes long, and nobody waits.

        Raises
        ------
        Unreachable, OutputError
            When files cannot be stored.
        """
        for row in self._rows(captures):
            self._bare_capture(row)
        for row in self._rows(order_files):
            self._bare_order_file(row)
        return self._bare

    def erase_persons(self) -> None:
        """Empty the rows of the persons."""
        values: dict[Any, Any] = {c: empty_value(c) for c in _marked(persons, Erased.EMPTIED)}
        values |= {persons.c.is_erased: True, persons.c.changed_at: utc_now()}
        values[persons.c.revision] = persons.c.revision + 1
        of_person = persons.c.id.in_(self._ids)
        self._connection.execute(update(persons).where(of_person).values(values))
        self._check_texts(persons)
        name = dict.fromkeys(_marked(persons, Erased.PSEUDONYM), persons.c.pseudonym)
        self._connection.execute(update(persons).where(of_person).values(name))

    def erase_rows(self, author: Author) -> None:
        """Do so with all that belongs to them, once `erase_persons` has marked them as erased."""
        sound = self._sound_signatures()
        self._remove_rows()
        for table in tables_of_persons():
            self._empty(table)
        self._redact_versions()
        self._replace_files()
        for table in tables_of_persons():
            self._check_texts(table)
        for version_id in sound:
            key = prescription_versions.c.id == version_id
            row = self._connection.execute(select(prescription_versions).where(key)).one()
            note_redaction(self._connection, author, row)

    def traces(self) -> Traces:
        """Return by what leftovers of the person are known outside the record."""
        rows = self.sealed_rows()
        scans = {
            sha256
            for row in self._rows(captures)
            for sha256 in (row.source_sha256, row.content_sha256)
            if sha256
        }
        sources = [_source_of(row.document) for row in self._rows(prescription_versions)]
        scans |= {str(source["sha256"]) for source in sources if source.get("sha256")}
        traces = Traces.of(self._names, rows["visit"], rows["capture"], scans)
        return traces.with_files(str(s["path"]) for s in sources if s.get("kind") != s.get("path"))

    def sealed_rows(self) -> dict[str, list[str]]:
        """Return the ids of all rows of which the audit log keeps digests."""
        return ids_of_persons(self._connection, self._ids)

    def files(self) -> set[str]:
        """Return the SHA-256 of all files that something of the persons refers to."""
        return {
            row._mapping[column.name] for column in REFERRING for row in self._rows(column.table)
        }

    def _rows(self, table: Table) -> Iterator[Row[Any]]:
        yield from self._connection.execute(
            select(table).where(is_of_person(table, self._ids))
        ).all()

    def _remove_rows(self) -> None:
        """Remove the rows of tables that show the person, and document no device."""
        for table in tables_of_persons():
            if _marked(table, Erased.REMOVED):
                self._connection.execute(delete(table).where(is_of_person(table, self._ids)))

    def _empty(self, table: Table) -> None:
        values: dict[Any, Any] = {c: empty_value(c) for c in _marked(table, Erased.EMPTIED)}
        if not values:
            return
        if "changed_at" in table.c and table is not prescription_versions:
            values[table.c.changed_at] = utc_now()
        self._connection.execute(update(table).where(is_of_person(table, self._ids)).values(values))

    def _sound_signatures(self) -> list[str]:
        """Return the versions that are what was signed; only these may be so afterwards."""
        return [
            row.id
            for row in self._rows(prescription_versions)
            if row.signed_at is not None and is_as_signed(self._connection, row)
        ]

    def _redact_versions(self) -> None:
        """Take names and notes out of prescriptions."""
        for before in self._rows(prescription_versions):
            values = {
                column: _nameless_document(before._mapping[column.name], self._words)
                for column in _marked(prescription_versions, Erased.DOCUMENT)
            }
            _change(self._connection, prescription_versions, before, values)

    def _replace_files(self) -> None:
        """Keep scans and solids as bare surfaces, and remove what else was stored for an order."""
        for row in self._rows(captures):
            bare = self._bare_capture(row) or self._bare.nothing()
            refer_to(self._connection, bare.sha256, bare.size, row.kind)
            values = {captures.c.content_sha256: bare.sha256}
            values[captures.c.file_name] = f"{row.kind}{bare.suffix}"
            _change(self._connection, captures, row, values)
        for number, row in enumerate(self._rows(order_files), 1):
            self._replace_order_file(row, number)

    def _bare_capture(self, row: Row[Any]) -> BareFile | None:
        suffix = ".zip" if row.kind == SESSION else PurePath(row.file_name).suffix.lower()
        return self._bare.of(row.content_sha256, suffix, self._words)

    def _bare_order_file(self, row: Row[Any]) -> BareFile | None:
        suffix = PurePath(row.name).suffix.lower()
        return self._bare.of(row.content_sha256, suffix, self._words)

    def _replace_order_file(self, row: Row[Any], number: int) -> None:
        connection, bare = self._connection, self._bare_order_file(row)
        if bare is None:
            connection.execute(delete(order_files).where(_is_row(order_files, row)))
            return
        refer_to(connection, bare.sha256, bare.size, "order")
        side = side_of_name(PurePath(row.name).stem)
        name = "-".join(filter(None, ("solid", str(number), side)))
        values: dict[Column[Any], Any] = {
            order_files.c.name: name + bare.suffix,
            order_files.c.content_sha256: bare.sha256,
            order_files.c.size: bare.size,
        }
        _change(connection, order_files, row, values)

    def _check_texts(self, table: Table) -> None:
        """Empty the texts that are kept for a reason, and hold the name all the same."""
        checked = _marked(table, Erased.CHECKED)
        if not checked:
            return
        for row in self._rows(table):
            held = [c for c in checked if holds_any(row._mapping[c.name] or "", self._words)]
            values = {c: _ANEW[c]() if c in _ANEW else empty_value(c) for c in held}
            if values:
                _change(self._connection, table, row, values)


def is_unused() -> ColumnElement[bool]:
    """Return the condition under which nothing refers to a row of `contents`."""
    return and_(*(~exists().where(column == contents.c.sha256) for column in REFERRING))


def _marked(table: Table, erased: Erased) -> list[Column[Any]]:
    return [column for column in table.columns if mark_of(column).erased is erased]


def _is_row(table: Table, row: Row[Any]) -> ColumnElement[bool]:
    return and_(*(key == row._mapping[key.name] for key in table.primary_key.columns))


def _change(
    connection: Connection, table: Table, row: Row[Any], values: Mapping[Column[Any], Any]
) -> None:
    connection.execute(update(table).where(_is_row(table, row)).values(dict(values)))


_NOTHING = "–"
"""In place of a text that may not be empty."""


def _nameless_document(document: str, words: Set[str]) -> str:
    """Return what a version of a prescription states, without names, notes and places of files.

    Variants and key points get new names, in their order. A text of the design, such as a
    material, stays, unless it holds one of the words: it says what the device is made of.

    Parameters
    ----------
    document
        As `prescription_versions` holds it; of any version, also a damaged one.
    words
        Of the patient's name, folded.
    """
    try:
        content = json.loads(document)
    except ValueError:
        content = {}
    foot = content if isinstance(content, dict) else {}
    if "notes" in foot:
        foot["notes"] = []
    foot.pop("picture", None)  # of a footprint on paper, where a name may be written
    _rename_source(_within(foot, "source"))
    for number, point in enumerate(_each(_within(foot, "annotations").get("key_points")), 1):
        point["name"] = str(number)
    _rename_variants(foot)
    for part, key in (("earlier", "name"), ("pressure", "device"), ("pressure", "shown")):
        if key in _within(foot, part):
            foot[part][key] = _NOTHING
    return json.dumps(_without(foot, words), ensure_ascii=False)


def _source_of(document: str) -> dict[str, Any]:
    """Return what a version says of its scan; of any version, also a damaged one."""
    try:
        content = json.loads(document)
    except ValueError:
        content = {}
    source = _within(content, "source") if isinstance(content, dict) else {}
    return source if isinstance(source.get("path"), str) else {}


def _rename_source(source: dict[str, Any]) -> None:
    if "path" in source:
        source["path"] = str(source.get("kind", _NOTHING))


def _rename_variants(foot: dict[str, Any]) -> None:
    names = {}
    for number, variant in enumerate(_each(foot.get("variants")), 1):
        names[variant.get("name")] = variant["name"] = str(number)
    if "chosen" in foot:
        foot["chosen"] = names.get(foot["chosen"], _NOTHING)


def _without(value: Any, words: Set[str]) -> Any:
    """Return a value without texts and keys that hold one of some words."""
    if isinstance(value, dict):
        kept = {k: v for k, v in value.items() if not holds_any(k, words)}
        return {key: _without(inner, words) for key, inner in kept.items()}
    if isinstance(value, list):
        return [_without(inner, words) for inner in value]
    return _NOTHING if isinstance(value, str) and holds_any(value, words) else value


def _within(values: dict[str, Any], key: str) -> dict[str, Any]:
    inner = values.get(key)
    return inner if isinstance(inner, dict) else {}


def _each(values: Any) -> list[dict[str, Any]]:
    return [v for v in values if isinstance(v, dict)] if isinstance(values, list) else []
