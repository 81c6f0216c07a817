"""The statement of a custom-made device from the record (Regulation (EU) 2017/745, Annex XIII).

Years later the record tells everything about a device: who prescribed it for whom, from which scan
and calibration it was made, by which program, and that none of it was changed since it was signed.
"""

from __future__ import annotations

import json
from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from datetime import date
from pathlib import Path
from typing import Any

from sqlalchemy import Connection, Row, select

from insole_core.errors import RecordsError
from insole_core.geometry.side import Side
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.prescription.prescription_lines import correction_lines, make_facts
from insole_core.messages import Message, Translate, joined
from insole_core.records.capture import NOT_RECORDED, CaptureFacts
from insole_core.records.context import RecordsContext
from insole_core.records.marks import Erased
from insole_core.records.person import Person
from insole_core.records.prescriptions import Prescriptions
from insole_core.records.record_field import typed_fields
from insole_core.records.rows import person_of, visit_of
from insole_core.records.schema import (
    accounts,
    captures,
    order_events,
    order_feet,
    orders,
    prescription_versions,
)
from insole_core.records.signing import is_as_signed
from insole_core.records.visit import Visit
from insole_core.solids.prescription_paper import (
    Responsible,
    require_statement,
    write_prescription_paper,
)


@dataclass(frozen=True)
class FootStatement:
    """What the record knows about the device of one foot.

    Parameters
    ----------
    version
        Number of the version of the prescription.
    mesh_sha256
        Of the foot's surface that the device was made from.
    signature
        Of the version, see `signing`.
    scanned_on
        Day of the earlier visit that the scan is of; empty for one of the order's own visit.
    mirrored
        Whether this foot was not scanned: scan and capture are those of the other one.
    capture
        What is known about the scan; its calibration is empty where a session does not tell it.
    """

    side: Side
    design: InsoleDesign
    version: int
    author: str
    signed_by: str
    signed_at: str
    signature: str
    mesh_sha256: str
    program_version: str
    scan: str = ""
    scan_sha256: str = ""
    scanned_on: str = ""
    mirrored: bool = False
    capture: CaptureFacts = field(default_factory=CaptureFacts)

    def provenance(self) -> dict[str, str]:
        """Return how the device came about, by name; what is not known is left out.

        A scan by sensors says that their calibration is not recorded, where it is not.
        """
        capture = self.capture
        unknown = NOT_RECORDED if capture.sensor_serials else ""
        image = Message("mirror image of the {side} foot", side=self.side.other)
        facts = {
            "version": str(self.version),
            "designed by": self.author,
            "signed by": f"{self.signed_by}, {self.signed_at[:10]}",
            "signature": self.signature,
            "made from": image if self.mirrored else "",
            "scan": self.scan,
            "SHA-256 of the scan": self.scan_sha256,
            "SHA-256 of the foot": self.mesh_sha256,
            "recorded": capture.recorded_at[:10],
            "scan of the earlier visit": self.scanned_on,
            "sensors": ", ".join(capture.sensor_serials),
            "calibrated": capture.calibrated_on[:10] or unknown,
            "residuals of the calibration": joined(capture.residual_lines, "; ") or unknown,
            "Insole Studio": self.program_version,
        }
        return {name: value for name, value in facts.items() if value}


@dataclass(frozen=True)
class DeviceStatement:
    """The statement about the devices of an order.

    Parameters
    ----------
    identification
        Name, birth date, visit and order; of an erased patient the pseudonym.
    history
        Day and state of each step of the order.
    """

    identification: dict[str, str]
    responsible: Responsible
    feet: tuple[FootStatement, ...]
    history: tuple[tuple[str, str], ...]

    def as_json(self) -> dict[str, Any]:
        """Return the statement for other programs and for later."""
        return {
            "identification": self.identification,
            "responsible": vars(self.responsible),
            "feet": [
                {
                    "side": str(foot.side),
                    "corrections": list(correction_lines(foot.design)),
                    "make": make_facts(foot.design),
                    "provenance": foot.provenance(),
                }
                for foot in self.feet
            ],
            "history": [{"day": day, "state": state} for day, state in self.history],
        }


def order_of_number(context: RecordsContext, number: str) -> str:
    """Return the id of an order that papers name by its number.

    Raises
    ------
    RecordsError
        When there is none.
    """
    with context.reading() as connection:
        query = select(orders.c.id).where(orders.c.number == number)
        found: str | None = connection.execute(query).scalar()
    if found is None:
        raise RecordsError(
            "There is no order {number} in the record; check the number.", number=number[:80]
        )
    return found


def statement_of(
    context: RecordsContext, order_id: str, responsible: Responsible
) -> DeviceStatement:
    """Return the statement about an order's devices, each of which is signed and unchanged.

    Parameters
    ----------
    responsible
        Maker and clinic. The prescriber is whoever has signed.

    Raises
    ------
    NotAllowed
    RecordsError
        When the order is gone, or a prescription is not signed or was changed afterwards.
    InputError
        When something is missing that the annex asks for.
    """
    with context.reading() as connection:
        order = connection.execute(select(orders).where(orders.c.id == order_id)).one_or_none()
        if order is None:
            raise RecordsError("This order is no longer in the record; look at the list again.")
        rows = list(_versions(connection, order_id))
        feet = tuple(_foot(connection, context, row) for row in rows)
        identification = _identification(connection, order)
        steps = connection.execute(
            select(order_events.c.at, order_events.c.to_state)
            .where(order_events.c.order_id == order_id)
            .order_by(order_events.c.seq)
        ).all()
    signers = {foot.signed_by for foot in feet}
    responsible = replace(responsible, prescriber=" / ".join(sorted(signers)))
    require_statement(responsible, identification)
    return DeviceStatement(
        identification, responsible, feet, tuple((step.at[:10], step.to_state) for step in steps)
    )


def write_statement_paper(
    statement: DeviceStatement, path: Path, day: date, translate: Translate = str
) -> None:
    """Write the statement as a PDF, with the corrections and how the devices came about.

    Parameters
    ----------
    translate
        Into the language of the paper.

    Raises
    ------
    OutputError
        When the place cannot be written.
    """
    write_prescription_paper(
        [foot.design for foot in statement.feet],
        path,
        responsible=statement.responsible,
        identification=statement.identification,
        material="",
        day=day,
        provenance={foot.side: foot.provenance() for foot in statement.feet},
        translate=translate,
    )


def _versions(connection: Connection, order_id: str) -> Iterator[Row[Any]]:
    query = (
        select(prescription_versions)
        .join(order_feet, order_feet.c.prescription_version_id == prescription_versions.c.id)
        .join(orders, orders.c.id == order_feet.c.order_id)
        .where(orders.c.id == order_id, order_feet.c.release == orders.c.release)
        .order_by(prescription_versions.c.side)
    )
    for row in connection.execute(query):
        if row.signed_at is None:
            raise RecordsError(
                "The prescription of the {side} foot is not signed; sign it first.", side=row.side
            )
        if not is_as_signed(connection, row):
            raise RecordsError(
                "The prescription of the {side} foot is not what was signed; compare it with a "
                "backup.",
                side=row.side,
            )
        yield row


def _foot(connection: Connection, context: RecordsContext, row: Row[Any]) -> FootStatement:
    foot = Prescriptions(context).foot_of(row)
    statement = FootStatement(
        side=Side(row.side),
        design=foot.design,
        version=row.number,
        author=_full_name(connection, row.author),
        signed_by=_full_name(connection, row.signed_by),
        signed_at=row.signed_at,
        signature=row.signature,
        mesh_sha256=row.mesh_sha256,
        program_version=row.program_version,
        scanned_on=foot.source.scanned_on,
        mirrored=foot.source.mirrored,
    )
    query = select(captures).where(captures.c.id == row.capture_id)
    capture = connection.execute(query).one_or_none()
    if capture is None:
        return statement
    return replace(
        statement,
        scan=capture.file_name,
        scan_sha256=capture.content_sha256,
        capture=CaptureFacts(
            recorded_at=capture.recorded_at,
            sensor_serials=tuple(json.loads(capture.sensor_serials)),
            calibrated_on=capture.calibrated_on,
            calibration_residuals=json.loads(capture.calibration_residuals),
        ),
    )


def _identification(connection: Connection, order: Row[Any]) -> dict[str, str]:
    person = person_of(connection, order.person_id)
    visit = visit_of(connection, order.visit_id)
    facts = {
        **_stated(person),
        "pseudonym": f"{person.pseudonym}, {order.number}" if person.is_erased else order.number,
        **_stated(visit),
    }
    return {name: value for name, value in facts.items() if value}


def _stated(value: Person | Visit) -> dict[str, str]:
    """Return what identifies the person and the visit, without what an erasure took away."""
    fields = typed_fields(type(value)).items()
    is_erased = isinstance(value, Person) and value.is_erased
    return {
        field.stated: field.written(getattr(value, name))
        for name, field in fields
        if field.stated and not (is_erased and field.mark.erased is Erased.PSEUDONYM)
    }


def _full_name(connection: Connection, name: str) -> str:
    """Return the full name of an account; while accounts are off, the name that was recorded."""
    query = select(accounts.c.full_name).where(accounts.c.name == name)
    return connection.execute(query).scalar() or name
