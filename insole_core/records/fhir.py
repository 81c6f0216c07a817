"""A person and their prescriptions as FHIR R4 (4.0.1) resources, for other systems of a clinic.

Only what the record knows is stated: free texts stay texts, and no code is added that nobody chose.
Sides are coded in SNOMED CT, lengths and weights in UCUM. What the device is stays a text.
https://hl7.org/fhir/R4/patient.html, https://hl7.org/fhir/R4/devicerequest.html
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Final

from insole_core.geometry.side import Side
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.prescription.prescription_lines import correction_lines, make_values
from insole_core.records.order import Order, OrderState
from insole_core.records.person import Person
from insole_core.records.prescription import VersionSummary
from insole_core.records.record_field import typed_fields
from insole_core.records.visit import Visit

Resource = dict[str, Any]

_PSEUDONYM: Final = {
    "system": "http://terminology.hl7.org/CodeSystem/v3-ObservationValue",
    "code": "PSEUDED",
    "display": "pseudonymized",
}
_SWEDISH: Final = "http://electronichealth.se/identifier/"
"""Naming systems of the Swedish base profiles: personnummer and samordningsnummer, 12 digits."""
_SWEDISH_OIDS: Final = {
    "personnummer": "urn:oid:1.2.752.129.2.1.3.1",
    "samordningsnummer": "urn:oid:1.2.752.129.2.1.3.3",
}
"""The same two by which older Swedish systems know them."""
_URI: Final = "urn:ietf:rfc3986"
_SNOMED: Final = "http://snomed.info/sct"
_LATERALITY: Final = ("272741003", "Laterality")
_SIDES: Final = {Side.LEFT: ("7771000", "Left"), Side.RIGHT: ("24028007", "Right")}
_UCUM: Final = "http://unitsofmeasure.org"
_QUANTITY: Final = re.compile(r"(\d+(?:\.\d+)?) (mm|kg)")
_LEAST_COORDINATION_DAY: Final = 61
STATUS_OF: Final[Mapping[OrderState, str]] = {
    OrderState.DESIGNED: "draft",
    OrderState.CHECKED: "draft",
    OrderState.SENT: "active",
    OrderState.IN_PRODUCTION: "active",
    OrderState.DELIVERED: "completed",
    OrderState.ADJUSTED: "completed",
    OrderState.RETURNED: "active",
    OrderState.CANCELLED: "revoked",
}
"""Code of RequestStatus by the state of the order."""

_ELEMENTS: Final[Mapping[str, Callable[[str], Any]]] = {
    "name": lambda text: [{"use": "official", "text": text}],
    "telecom": lambda text: [
        {"system": "other", "value": line.strip()} for line in text.splitlines() if line.strip()
    ],
}
"""How an element of a `Patient` that is more than a text holds one."""


@dataclass(frozen=True)
class PrescribedDevice:
    """An insole as it was prescribed for one foot.

    Parameters
    ----------
    order
        None while it is not ordered.
    """

    version: VersionSummary
    design: InsoleDesign
    visit: Visit
    order: Order | None = None


def patient_resource(person: Person, *, is_pseudonymous: bool = False) -> Resource:
    """Return a FHIR `Patient`.

    Parameters
    ----------
    is_pseudonymous
        Whether the pseudonym stands in place of all that identifies the person.
    """
    pseudonym = {"type": {"coding": [_PSEUDONYM]}, "value": person.pseudonym}
    resource: Resource = {"resourceType": "Patient", "id": person.id}
    if is_pseudonymous:
        return resource | {"identifier": [pseudonym]}
    resource |= {
        "identifier": [*_personal_numbers(person), pseudonym, _uuid(person.id)],
        "active": person.merged_into is None and not person.is_erased,
    }
    return resource | {
        element: _ELEMENTS.get(element, str)(text) for element, text in _texts_of(person)
    }


def device_request_resource(person: Person, device: PrescribedDevice) -> Resource:
    """Return a FHIR `DeviceRequest` for the insole of one foot.

    It refers to the person by ``Patient/<id>`` and names nobody but the prescriber.
    """
    version, design, visit, order = device.version, device.design, device.visit, device.order
    resource: Resource = {
        "resourceType": "DeviceRequest",
        "id": version.id,
        "identifier": [_uuid(version.id)],
        "status": _status(device),
        "intent": "order",
        "codeCodeableConcept": _words(f"Custom-made foot insole, {version.side} foot"),
        "parameter": _parameters(design),
        "subject": {"reference": f"Patient/{person.id}"},
        "authoredOn": version.signed_at or version.changed_at,
        "requester": {"display": version.signed_by or version.author},
    }
    if order is not None:
        resource["groupIdentifier"] = {"value": order.number}
    if order is not None and order.shop:
        resource["performer"] = {"display": order.shop}
    reasons = [text for element, text in _texts_of(visit) if element == "reasonCode"]
    if reasons:
        resource["reasonCode"] = [_words(text) for text in reasons]
    lines = correction_lines(design)
    if lines:
        resource["note"] = [{"text": line} for line in lines]
    return resource


def _texts_of(value: Person | Visit) -> Iterator[tuple[str, str]]:
    """Yield the FHIR element and the text of each filled field that declares one."""
    for name, field in typed_fields(type(value)).items():
        text = field.written(getattr(value, name))
        if field.fhir and text:
            yield field.fhir, text


def _personal_numbers(person: Person) -> list[Resource]:
    """Return the personal number under each name by which systems know it."""
    if not person.personal_number:
        return []
    if person.number_kind != "se":
        return [{"use": "official", "value": person.personal_number}]
    digits = person.personal_number.replace("-", "")
    is_coordination = int(digits[6:8]) >= _LEAST_COORDINATION_DAY
    name = "samordningsnummer" if is_coordination else "personnummer"
    systems = (f"{_SWEDISH}{name}", _SWEDISH_OIDS[name])
    return [{"use": "official", "system": system, "value": digits} for system in systems]


def _status(device: PrescribedDevice) -> str:
    """Return the code of RequestStatus; signing makes a prescription that was not ordered valid."""
    if device.order is not None:
        return STATUS_OF[device.order.state]
    return "active" if device.version.signed_by else "draft"


def _parameters(design: InsoleDesign) -> Sequence[Resource]:
    side = {
        "code": _coded(_LATERALITY, "side"),
        "valueCodeableConcept": _coded(_SIDES[design.side], str(design.side)),
    }
    facts = [
        (f"{name}: {each}" if each else name, text)
        for name, said in make_values(design).items()
        for each, text in ({"": said} if isinstance(said, str) else said).items()
    ]
    return [side, *({"code": _words(name), **_value(value)} for name, value in facts)]


def _value(text: str) -> Resource:
    """Return a fact as a quantity where it is a number of mm or kg, else as a text."""
    quantity = _QUANTITY.fullmatch(text)
    if quantity is None:
        return {"valueCodeableConcept": _words(text)}
    number, unit = float(quantity.group(1)), quantity.group(2)
    return {"valueQuantity": {"value": number, "unit": unit, "system": _UCUM, "code": unit}}


def _coded(code: tuple[str, str], text: str) -> Resource:
    number, display = code
    return {"coding": [{"system": _SNOMED, "code": number, "display": display}], "text": text}


def _uuid(key: str) -> Resource:
    return {"system": _URI, "value": f"urn:uuid:{key}"}


def _words(text: str) -> Resource:
    return {"text": text}
