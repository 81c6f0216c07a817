"""Persons and prescriptions as FHIR R4, checked against the structure of its resources."""

from __future__ import annotations

import json
from dataclasses import replace
from datetime import date

import pytest
from fhirclient.models.devicerequest import DeviceRequest
from fhirclient.models.patient import Patient

from insole_core.geometry.side import Side
from insole_core.insole.elements import Pelott
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.records.fhir import PrescribedDevice, device_request_resource, patient_resource
from insole_core.records.order import Order, OrderState
from insole_core.records.person import Person
from insole_core.records.prescription import VersionSummary
from insole_core.records.visit import Visit

_PERSON = Person(
    "Åsa 'Öberg' <b>",
    date(1964, 8, 23),
    "19640823-3234",
    "se",
    contact="070 1\nStorgatan 1",
    notes="private",
)
_VISIT = Visit(_PERSON.id, date(2026, 11, 20), reason="pain", findings="flat foot")
_VERSION = VersionSummary(
    id="0b7a1a3c-9a55-4b62-b3a0-6d5a0e5b9d10",
    visit_id=_VISIT.id,
    side=Side.LEFT,
    number=2,
    author="anna",
    station="desk",
    reason="",
    program_version="0.1.0",
    created_at="2026-11-20T09:00:00.000000Z",
    changed_at="2026-11-20T10:00:00.000000Z",
    revision=3,
    is_closed=True,
)
_DESIGN = InsoleDesign(
    Side.LEFT,
    corrections=(Pelott(centre_mm=(-5.0, 160.0), author="anna", created_at="2026-11-20"),),
)
_ORDER = Order(
    "1", "26-7KQ4M", _VISIT.id, _PERSON.id, OrderState.SENT, "Shop", None, "", 1, "",
    (_VERSION.id,), (), (), "", "", 1,
)  # fmt: skip
_STATUS_CODES = {  # http://hl7.org/fhir/R4/valueset-request-status.html
    "draft", "active", "on-hold", "revoked", "completed", "entered-in-error", "unknown",
}  # fmt: skip


def test_a_patient_has_the_structure_of_r4_and_all_that_is_known():
    resource = patient_resource(_PERSON)
    assert _as_read(Patient, resource) == resource
    assert resource["birthDate"] == "1964-08-23"
    assert resource["name"] == [{"use": "official", "text": _PERSON.name}]
    assert [(i.get("system"), i["value"]) for i in resource["identifier"]] == [
        ("http://electronichealth.se/identifier/personnummer", "196408233234"),
        ("urn:oid:1.2.752.129.2.1.3.1", "196408233234"),
        (None, _PERSON.pseudonym),
        ("urn:ietf:rfc3986", f"urn:uuid:{_PERSON.id}"),
    ]
    assert [contact["value"] for contact in resource["telecom"]] == ["070 1", "Storgatan 1"]


def test_a_coordination_number_and_an_unknown_kind_are_told_apart():
    coordination = replace(_PERSON, personal_number="19701063-2391")
    first, second, *_ = patient_resource(coordination)["identifier"]
    assert first["system"].endswith("samordningsnummer")
    assert second["system"] == "urn:oid:1.2.752.129.2.1.3.3"
    other = replace(_PERSON, personal_number="A-1", number_kind="")
    number, *_ = patient_resource(other)["identifier"]
    assert number == {"use": "official", "value": "A-1"}


def test_a_person_of_whom_only_the_name_is_known_is_a_patient():
    resource = patient_resource(Person("X"))
    assert _as_read(Patient, resource) == resource
    assert not resource.keys() & {"birthDate", "telecom"}


def test_a_pseudonymous_patient_holds_the_pseudonym_only():
    resource = patient_resource(_PERSON, is_pseudonymous=True)
    assert _as_read(Patient, resource) == resource
    assert resource.keys() == {"resourceType", "id", "identifier"}
    assert [i["value"] for i in resource["identifier"]] == [_PERSON.pseudonym]


def test_a_device_request_has_the_structure_of_r4_and_says_which_foot():
    device = PrescribedDevice(_VERSION, _DESIGN, _VISIT, _ORDER)
    resource = device_request_resource(_PERSON, device)
    assert _as_read(DeviceRequest, resource) == resource
    assert resource["subject"] == {"reference": f"Patient/{_PERSON.id}"}
    assert "left" in resource["codeCodeableConcept"]["text"]
    side, *others = resource["parameter"]
    assert side["valueCodeableConcept"]["text"] == "left"
    (coding,) = side["valueCodeableConcept"]["coding"]
    assert (coding["system"], coding["code"]) == ("http://snomed.info/sct", "7771000")
    (thickness,) = (p for p in others if p["code"]["text"] == "prescribed thickness")
    assert thickness["valueQuantity"] == {
        "value": 3.0, "unit": "mm", "system": "http://unitsofmeasure.org", "code": "mm",
    }  # fmt: skip
    assert resource["identifier"][0]["value"] == f"urn:uuid:{_VERSION.id}"
    assert resource["groupIdentifier"] == {"value": "26-7KQ4M"}
    assert [reason["text"] for reason in resource["reasonCode"]] == ["pain", "flat foot"]
    assert resource["note"][0]["text"].startswith("Pelott")
    assert _PERSON.name not in json.dumps(resource)


@pytest.mark.parametrize("state", list(OrderState))
def test_every_state_of_an_order_is_a_code_of_r4(state):
    device = PrescribedDevice(_VERSION, _DESIGN, _VISIT, replace(_ORDER, state=state))
    assert device_request_resource(_PERSON, device)["status"] in _STATUS_CODES


def test_what_is_neither_ordered_nor_signed_is_a_draft():
    device = PrescribedDevice(_VERSION, _DESIGN, _VISIT)
    assert device_request_resource(_PERSON, device)["status"] == "draft"
    signed = replace(_VERSION, signed_by="eva", signed_at="2026-11-21T08:00:00.000000Z")
    resource = device_request_resource(_PERSON, replace(device, version=signed))
    assert _as_read(DeviceRequest, resource) == resource
    assert (resource["status"], resource["requester"]) == ("active", {"display": "eva"})
    assert resource["authoredOn"] == signed.signed_at


def _as_read(kind, resource):
    """Return a resource as a reader of R4 understands it; it refuses unknown and missing keys."""
    return kind(json.loads(json.dumps(resource)), strict=True).as_json()
