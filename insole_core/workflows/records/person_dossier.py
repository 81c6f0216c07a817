"""All that the record holds of one person, for export; as JSON: docs/formats/record.schema.json."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from datetime import date
from typing import Any, Final, TypeVar

from insole_core.cases.case_json import foot_to_json
from insole_core.cases.case_record import FootRecord, Patient
from insole_core.errors import InputError
from insole_core.export.shop_order import OrderTerms, terms_to_json
from insole_core.formats.file_formats import names_nobody
from insole_core.geometry.side import Side
from insole_core.messages import Message, counted
from insole_core.records.author import program_version, utc_now
from insole_core.records.capture import Capture
from insole_core.records.marks import Erased
from insole_core.records.order import Order, OrderFile
from insole_core.records.person import Person
from insole_core.records.photo import Photo, marks_to_json
from insole_core.records.prescription import VersionSummary
from insole_core.records.record_field import fields_of
from insole_core.records.records import Records
from insole_core.records.visit import FollowUp, Visit
from insole_core.workflows.nameless import require_nameless

Value = TypeVar("Value", Visit, Order)
_TYPED_KEYS = frozenset({"name", "device", "material", "notes"})
"""Of a case, the texts that somebody may have typed; authors are not the patient."""
FORMAT: Final = "insole-person"
VERSION: Final = 1
_OF_THE_STORE: Final = frozenset({"merged_into", "is_erased", "revision"})
"""What only this record needs to know of a row."""


@dataclass(frozen=True)
class VisitDossier:
    """A visit with all versions of its prescriptions and its captures.

    Parameters
    ----------
    versions
        Of both feet, the left one first, the oldest first.
    captures
        The oldest first.
    """

    visit: Visit
    versions: tuple[VersionSummary, ...]
    captures: tuple[Capture, ...]
    photos: tuple[Photo, ...] = ()

    def newest(self, side: Side) -> VersionSummary | None:
        """Return the newest version of a foot; None when there is none."""
        return next((v for v in reversed(self.versions) if v.side is side), None)


@dataclass(frozen=True)
class PersonDossier:
    """A person with everything that refers to them.

    Parameters
    ----------
    visits
        The oldest first.
    is_pseudonymous
        Whether all that names or describes the person was left out.
    withheld
        A sentence for each file that was left out for that.
    """

    person: Person
    visits: tuple[VisitDossier, ...]
    orders: tuple[Order, ...]
    follow_ups: tuple[FollowUp, ...]
    is_pseudonymous: bool = False
    withheld: tuple[Message, ...] = ()

    def order_of(self, version_id: str) -> Order | None:
        """Return the order in which a version was made; None when there is none."""
        return next((order for order in self.orders if version_id in order.version_ids), None)


def read_dossier(records: Records, person_id: str) -> PersonDossier:
    """Read all that the record holds of a person but the large files.

    Raises
    ------
    RecordsError
        When there is no such person.
    """
    person = records.persons.get(person_id)
    visits = reversed(records.visits.of_person(person.id))
    orders = (records.orders.get(order.id) for order in records.orders.of_person(person.id))
    return PersonDossier(
        person,
        tuple(_visit_dossier(records, visit) for visit in visits),
        tuple(sorted(orders, key=lambda order: order.created_at)),
        tuple(reversed(records.follow_ups.of_person(person.id))),
    )


def _visit_dossier(records: Records, visit: Visit) -> VisitDossier:
    versions = (
        version
        for side in Side
        for version in reversed(records.prescriptions.versions(visit.id, side))
    )
    captures = reversed(records.captures.of_visit(visit.id))
    photos = records.photos.of_visit(visit.id)
    return VisitDossier(visit, tuple(versions), tuple(captures), tuple(photos))


def pseudonymous(dossier: PersonDossier) -> PersonDossier:
    """Return a dossier that names and describes nobody (decision 0049).

    Left out are all fields of the person but the pseudonym, every text that somebody has typed
    about them, photos, captures (files of other programs may hold a name) and the
    papers of orders that name the patient.

    Raises
    ------
    InputError
        When the number of an order holds the name.
    """
    person = dossier.person
    numbers = " ".join(order.number for order in dossier.orders)
    require_nameless(Patient(name=person.name), {"number of an order": numbers})
    orders = [_pseudonymous_order(order, person.name) for order in dossier.orders]
    captures = sum(len(visit.captures) for visit in dossier.visits)
    photos = sum(len(visit.photos) for visit in dossier.visits)
    return PersonDossier(
        Person(
            name="",
            pseudonym=person.pseudonym,
            id=person.id,
            created_at=person.created_at,
            changed_at=person.changed_at,
            revision=person.revision,
        ),
        tuple(_pseudonymous_visit(visit) for visit in dossier.visits),
        tuple(orders),
        (),
        is_pseudonymous=True,
        withheld=tuple(_withheld(dossier.orders, orders, captures, photos)),
    )


def _pseudonymous_visit(dossier: VisitDossier) -> VisitDossier:
    versions = tuple(replace(version, reason="") for version in dossier.versions)
    visit = replace(_without_texts(dossier.visit), terms=OrderTerms())
    return VisitDossier(visit, versions, ())


def _pseudonymous_order(order: Order, name: str) -> Order:
    return replace(
        _without_texts(order),
        events=tuple(replace(event, remarks="") for event in order.events),
        files=tuple(file for file in order.files if _is_for_the_shop(file, name)),
    )


def _without_texts(value: Value) -> Value:
    """Return a visit or an order without the texts that an erasure empties."""
    fields = fields_of(type(value)).items()
    texts = [n for n, f in fields if f.empty == "" and f.mark.erased is Erased.EMPTIED]
    emptied: dict[str, Any] = dict.fromkeys(texts, "")
    return replace(value, **emptied)


def _is_for_the_shop(file: OrderFile, name: str) -> bool:
    """Return whether a file is of a kind that names nobody, and is not named after the patient."""
    try:
        require_nameless(Patient(name=name), {"file": file.name})
    except InputError:
        return False
    return names_nobody(file.name)


def _withheld(
    orders: Iterable[Order], pseudonymous_orders: Iterable[Order], captures: int, photos: int
) -> Iterator[Message]:
    for order, kept in zip(orders, pseudonymous_orders, strict=True):
        count = len(order.files) - len(kept.files)
        if count:
            yield counted(
                count,
                "Order {number}: 1 file that may name the patient",
                "Order {number}: {count} files that may name the patient",
                number=order.number,
            )
    if captures:
        yield counted(
            captures,
            "1 capture, which may show or name the patient",
            "{count} captures, which may show or name the patient",
        )
    if photos:
        yield counted(
            photos,
            "1 photo, which shows the patient",
            "{count} photos, which show the patient",
        )


def pseudonymous_foot(foot: FootRecord, name: str) -> FootRecord:
    """Return a foot that does not tell where its scan was: folders are named after patients.

    Parameters
    ----------
    name
        Of the patient.

    Raises
    ------
    InputError
        When a text of the prescription, such as the name of a variant, holds it.
    """
    texts = " ".join(_typed_texts(foot_to_json(foot)))
    require_nameless(Patient(name=name), {"prescription": texts})
    return replace(foot, source=foot.source.without_place())


def _typed_texts(values: Any, key: str = "") -> Iterator[str]:
    if isinstance(values, dict):
        for inner, value in values.items():
            yield from _typed_texts(value, inner)
    elif isinstance(values, list):
        for value in values:
            yield from _typed_texts(value, key)
    elif isinstance(values, str) and key in _TYPED_KEYS:
        yield values


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
