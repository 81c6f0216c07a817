"""Rows of visits, read and locked within a transaction."""

from __future__ import annotations

import json
from collections.abc import Iterable
from dataclasses import fields
from typing import Any, Final

from sqlalchemy import Connection, Row, Select, select

from insole_core.errors import RecordsError
from insole_core.export.shop_order import OrderTerms, terms_from_json, terms_to_json
from insole_core.json_object import JsonObject
from insole_core.records.checked_values import word_of
from insole_core.records.schema import visits
from insole_core.records.visit import CaptureState, Visit

VISIT_FIELDS: Final = tuple(field.name for field in fields(Visit))


def visit_of(connection: Connection, visit_id: str, *, locked: bool = False) -> Visit:
    """Return a visit, on demand with its row locked until the transaction ends.

    Raises
    ------
    RecordsError
        When there is none.
    """
    query = all_visits().where(visits.c.id == visit_id)
    row = connection.execute(query.with_for_update() if locked else query).one_or_none()
    if row is None:
        raise RecordsError("This visit is no longer in the record; open the person again.")
    return visit_from(row)


def all_visits() -> Select[Any]:
    """Return the query of all visits."""
    return select(*(visits.c[name] for name in VISIT_FIELDS))


def visit_from(row: Row[Any]) -> Visit:
    """Return the visit of a row of `all_visits`."""
    values = dict(zip(VISIT_FIELDS, row, strict=True))
    values["measures"] = json.loads(values["measures"])
    values["capture_state"] = word_of(CaptureState, values["capture_state"])
    values["terms"] = _terms(values["terms"])
    return Visit(**values)


def visit_values(visit: Visit, names: Iterable[str] = VISIT_FIELDS) -> dict[str, Any]:
    """Return fields of a visit as the columns of its row; the inverse of `visit_from`."""
    values = {name: getattr(visit, name) for name in names}
    if "measures" in values:
        values["measures"] = json.dumps(dict(visit.measures))
    if "terms" in values:
        said = terms_to_json(visit.terms) if visit.terms != OrderTerms() else {}
        values["terms"] = json.dumps(said, ensure_ascii=False)
    return values


def _terms(text: str) -> OrderTerms:
    said = JsonObject.parse("terms of the order", text.encode())
    return terms_from_json(said) if said.values else OrderTerms()
