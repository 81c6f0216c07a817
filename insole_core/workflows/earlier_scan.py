"""The scan of an earlier visit, used once more on a later one."""

from __future__ import annotations

from dataclasses import replace
from datetime import date

from insole_core.cases.case_record import FootRecord
from insole_core.workflows.starting_design import StartingDevice
from insole_core.workflows.template_transfer import last_design


def on_earlier_scan(record: FootRecord, scanned_on: date, starting: StartingDevice) -> FootRecord:
    """Return a foot for a new prescription on the scan of an earlier visit, with its landmarks.

    It is marked with the day of the visit that it was scanned on, so that window, papers and record
    say it. The earlier prescription is there to be repeated.

    Parameters
    ----------
    record
        The foot as the earlier visit has it.
    scanned_on
        Day of the visit that it was scanned on.
    starting
        The device that new prescriptions begin with.
    """
    day = scanned_on.isoformat()
    return FootRecord.begun(
        replace(record.foot, scanned_on=day),
        replace(record.source, scanned_on=day),
        starting.design(record.foot),
        annotations=record.annotations,
        earlier=last_design(record),
    )
