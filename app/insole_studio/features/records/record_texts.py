"""How the pages of the record write days, states and authors."""

from __future__ import annotations

from collections.abc import Sequence
from datetime import date

from insole_core.geometry.side import Side
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.prescription.design_differences import corrections_in_words
from insole_core.records.capture import Capture
from insole_core.records.person import PersonSummary
from insole_core.records.prescription import VersionSummary
from insole_core.records.visit import CaptureState, Visit, VisitSummary
from insole_studio.texts import localised, moment_text, tr, translate_core_message
from insole_studio.widgets.row_table import TableRow


def day_text(day: date | None) -> str:
    """Return a day as ISO 8601; empty where it is unknown."""
    return "" if day is None else day.isoformat()


def capture_text(state: CaptureState) -> str:
    """Return what the capture room has to do for a visit."""
    return {
        CaptureState.NONE: "",
        CaptureState.WANTED: tr("Waiting"),
        CaptureState.DONE: tr("Captured"),
    }[state]


def scan_text(capture: Capture) -> str:
    """Return when a foot was scanned, and when the sensors that did it were calibrated."""
    facts = capture.facts
    time = moment_text(facts.recorded_at or capture.created_at)
    if not facts.sensor_serials:
        return tr("Scan {name}, {time}").format(name=capture.file_name, time=time)
    if not facts.calibrated_on:
        return tr("Captured {time}; calibration of the sensors not recorded").format(time=time)
    day = facts.calibrated_on[:10]
    return tr("Captured {time}; sensors calibrated {day}").format(time=time, day=day)


def reused_scan_text(day: str) -> str:
    """Return that a visit has the scan of an earlier one."""
    return tr("Scan of the visit of {day}, used once more").format(day=day)


def mirrored_text(side: Side) -> str:
    """Return that a foot was not scanned."""
    if side is Side.LEFT:
        return tr("Left foot not scanned: mirrored from the right")
    return tr("Right foot not scanned: mirrored from the left")


def visit_time_text(visit: Visit) -> str:
    """Return the day of a visit, with the time at which it was begun if that was on this day."""
    begun, day = moment_text(visit.created_at), visit.visited_on.isoformat()
    return begun if begun.startswith(f"{day} ") else day


def measures_text(visit: Visit) -> str:
    """Return weight and shoe size of a visit; empty where neither is known."""
    weight, size = visit.weight_kg, visit.shoe_size_eu
    parts = (
        "" if weight is None else f"{localised(weight, 'g')} kg",
        "" if size is None else tr("shoe size EU {size}").format(size=localised(size, "g")),
    )
    return ", ".join(filter(None, parts))


def prescribed_text(design: InsoleDesign | None) -> str:
    """Return device and corrections of a prescription; empty where it cannot be read."""
    if design is None:
        return ""
    corrections = [translate_core_message(words) for words in corrections_in_words(design)]
    device = translate_core_message(design.device)
    return "; ".join([*filter(None, [device]), *(corrections or [tr("no corrections")])])


def version_text(version: VersionSummary) -> str:
    """Return whose version it is, where it was made, and when it was changed last."""
    parts = [version.author, version.station, moment_text(version.changed_at)]
    if version.signed_by is not None:
        parts.append(tr("signed by {name}").format(name=version.signed_by))
    return ", ".join(parts)


def person_rows(persons: Sequence[PersonSummary]) -> list[TableRow]:
    """Return the rows of persons in a list."""
    return [
        TableRow(
            person.id,
            (
                person.name,
                day_text(person.birth_date),
                person.personal_number,
                day_text(person.last_visit),
            ),
        )
        for person in persons
    ]


def visit_rows(visits: Sequence[VisitSummary]) -> list[TableRow]:
    """Return the rows of the visits of one day."""
    return [
        TableRow(visit.id, (visit.person_name, visit.reason, capture_text(visit.capture_state)))
        for visit in visits
    ]
