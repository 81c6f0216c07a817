"""The data of one person as JSON: docs/formats/record.schema.json."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from datetime import date
from typing import Any, Final

from insole_core.export.shop_order import terms_to_json
from insole_core.records.author import program_version, utc_now
from insole_core.records.capture import Capture
from insole_core.records.order import Order
from insole_core.records.photo import Photo, marks_to_json
from insole_core.records.prescription import VersionSummary
from insole_core.workflows.records.person_dossier import PersonDossier, VisitDossier

FORMAT: Final = "insole-person"
VERSION: Final = 1
_OF_THE_STORE: Final = frozenset({"merged_into", "is_erased", "revision"})
"""What only this record needs to know of a row."""


@dataclass(frozen=True)
class ExportedFile:
    """A file of an export.

    Parameters
    ----------
    path
        Within the folder, with ``/``.
    size
        Bytes.
    """

    path: str
    sha256: str
    size: int


def person_json(
    dossier: PersonDossier,
    feet: Mapping[str, Mapping[str, Any]],
    files: Sequence[ExportedFile],
    left_out: Sequence[str],
) -> dict[str, Any]:
    """Return all data of a person as plain values for `json.dump`.

    Parameters
    ----------
    feet
        By the id of a version: its foot and prescription, as a case file states them.
    files
        What the folder holds beside this file.
    left_out
        A sentence for each thing that could not be exported.
    """
    return {
        "format": FORMAT,
        "version": VERSION,
        "exported_at": utc_now(),
        "program_version": program_version(),
        "is_pseudonymous": dossier.is_pseudonymous,
        "person": _plain(dossier.person),
        "visits": [_visit(visit, feet) for visit in dossier.visits],
        "orders": [_order(order) for order in dossier.orders],
        "follow_ups": [_plain(follow_up) for follow_up in dossier.follow_ups],
        "files": [_plain(file) for file in files],
        "left_out": list(map(str, left_out)),
    }


def _visit(dossier: VisitDossier, feet: Mapping[str, Mapping[str, Any]]) -> dict[str, Any]:
    return {
        **_plain(dossier.visit),
        "terms": terms_to_json(dossier.visit.terms),
        "captures": [_capture(capture) for capture in dossier.captures],
        "photos": [_photo(photo) for photo in dossier.photos],
        "prescriptions": [_version(version, feet.get(version.id)) for version in dossier.versions],
    }


def _capture(capture: Capture) -> dict[str, Any]:
    values = _plain(capture)
    return values | _plain(values.pop("facts"))


def _photo(photo: Photo) -> dict[str, Any]:
    return {**_plain(photo), "marks": marks_to_json(photo.marks)}


def _version(version: VersionSummary, foot: Mapping[str, Any] | None) -> dict[str, Any]:
    return {**_plain(version), "foot": foot}


def _order(order: Order) -> dict[str, Any]:
    return {
        **_plain(order),
        "files": [_plain(file) for file in order.files],
        "events": [_plain(event) for event in order.events],
    }


def _plain(value: object) -> dict[str, Any]:
    """Return the fields of a value of the record, with dates as ISO 8601."""
    fields = {name: field for name, field in vars(value).items() if name not in _OF_THE_STORE}
    return {name: _plain_field(field) for name, field in fields.items()}


def _plain_field(field: Any) -> Any:
    if isinstance(field, date):
        return field.isoformat()
    if isinstance(field, tuple):
        return list(field)
    return dict(field) if isinstance(field, Mapping) else field
