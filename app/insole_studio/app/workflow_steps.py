"""How far the open case has come on the path from patient to insole."""

from __future__ import annotations

from pathlib import Path

from insole_core.cases.case_record import CaseRecord
from insole_studio.texts import tr
from insole_studio.widgets.step_strip import StepState, WorkflowStep


def steps_of(record: CaseRecord, exported: bool) -> list[WorkflowStep]:
    """Give the five steps: the current one is where the work is, and what lies behind may be open.

    A foot on the bench is designed on; the design stays current until it is exported.
    """
    prescribed = record.design is not None and bool(record.design.corrections)
    done = {
        "patient": bool(record.patient.name),
        "capture": record.foot is not None,
        "foot": record.foot is not None,
        "design": prescribed and exported,
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
    """Give the recorded session that the foot at hand was made of, where it is still there."""
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
