"""How the pages of the record write days, states and authors."""

from __future__ import annotations

from collections.abc import Sequence
from datetime import date

from insole_core.geometry.side import Side
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.prescription.design_differences import corrections_in_words
from insole_core.messages import Message
from insole_core.records.capture import Capture
from insole_core.records.prescription import VersionSummary
from insole_core.records.record_field import Lines, listed_fields, told_fields
from insole_core.records.visit import CaptureState, Visit, VisitSummary
from insole_studio.texts import moment_text, tr, translate_core_message
from insole_studio.widgets.row_table import TableRow

_MOST_LETTERS = 200
"""Of a long text on the card of a visit."""


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


def visit_heading(visit: Visit) -> str:
    """Return what is said of a visit beside its day."""
    listed = listed_fields(Visit).items()
    said = (shown_message(field.said(getattr(visit, name))) for name, field in listed)
    return "   ".join(filter(None, said))


def visit_texts(visit: Visit) -> list[str]:
    """Return what was found on a visit: a line for each long text, one for all else."""
    short: list[str] = []
    long: list[str] = []
    for field, said in told_fields(visit):
        if not field.is_listed:
            line = f"{translate_core_message(field.label)}: {shown_message(said)}"
            (long if isinstance(field, Lines) else short).append(line)
    texts = [", ".join(short), *(" ".join(line.split())[:_MOST_LETTERS] for line in long)]
    return [text for text in texts if text]


def shown_message(said: str) -> str:
    """Return what a field says in the language of the window; what was typed is as it is."""
    return translate_core_message(said) if isinstance(said, Message) else said


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


def visit_headings() -> tuple[str, ...]:
    """Return the headings of a list of visits of one day."""
    labels = (translate_core_message(field.label) for field in listed_fields(Visit).values())
    return (tr("Name"), *labels, tr("Capture"))


def visit_rows(visits: Sequence[VisitSummary]) -> list[TableRow]:
    """Return the rows of the visits of one day."""
    return [
        TableRow(
            visit.id,
            (
                visit.person_name,
                *(str(getattr(visit, name)) for name in listed_fields(Visit)),
                capture_text(visit.capture_state),
            ),
        )
        for visit in visits
    ]
