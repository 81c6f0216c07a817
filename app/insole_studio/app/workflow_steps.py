"""The progress of the open case on the way from patient to insole."""

from __future__ import annotations

from pathlib import Path

from insole_core.cases.case_record import CaseRecord
from insole_studio.texts import tr
from insole_studio.widgets.step_strip import StepState, WorkflowStep


def steps_of(record: CaseRecord, exported: bool) -> list[WorkflowStep]:
    """Return the five steps; the current one is where the work is, earlier ones may be incomplete.

    A foot in the case makes design the current step, until the insole is exported.

    Parameters
    ----------
    record
        The open case.
    exported
        Whether the case has been exported since its last change.
    """
    done = {
        "patient": bool(record.patient.name),
        "capture": record.foot is not None,
        "foot": record.foot is not None,
        "design": exported,
        "export": exported,
    }
    keys = list(done)
    reached = max((number + 1 for number, key in enumerate(keys) if done[key]), default=0)
    current = keys[reached] if reached < len(keys) else ""
    return [
        WorkflowStep(key, _texts()[key], _state(is_done, key == current))
        for key, is_done in done.items()
    ]


def session_of(record: CaseRecord) -> Path | None:
    """Return the recorded session of the active foot; None if it no longer exists."""
    source = record.source
    if source is None or source.kind != "session" or not Path(source.path).exists():
        return None
    return Path(source.path)


def _state(done: bool, current: bool) -> StepState:
    if done:
        return StepState.DONE
    return StepState.CURRENT if current else StepState.OPEN


def _texts() -> dict[str, str]:
    return {
        "patient": tr("Patient"),
        "capture": tr("Capture"),
        "foot": tr("Foot"),
        "design": tr("Design"),
        "export": tr("Check & export").replace("&", "&&"),
    }
