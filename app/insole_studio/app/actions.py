"""All actions of the window: each feature contributes a table of records."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from functools import partial
from typing import Any, TypeVar

from insole_studio.app.features import Features
from insole_studio.app.window_actions import WINDOW_ACTIONS, WindowFeature
from insole_studio.features.calibrate.calibrate_window import CALIBRATE_ACTIONS
from insole_studio.features.capture.capture_window import CAPTURE_ACTIONS
from insole_studio.features.case_files.case_files import CASE_FILE_ACTIONS
from insole_studio.features.clinic.actions import CLINIC_ACTIONS
from insole_studio.features.compare.compare_window import COMPARE_ACTIONS
from insole_studio.features.design.actions import DESIGN_ACTIONS
from insole_studio.features.export.export_actions import EXPORT_ACTIONS
from insole_studio.features.records.actions import RECORD_ACTIONS
from insole_studio.services.action_record import ActionRecord

Feature = TypeVar("Feature")
Run = Callable[[bool], object]

ACTIONS: tuple[ActionRecord[Any], ...] = (
    *RECORD_ACTIONS,
    *CLINIC_ACTIONS,
    *CASE_FILE_ACTIONS,
    *CAPTURE_ACTIONS,
    *DESIGN_ACTIONS,
    *EXPORT_ACTIONS,
    *COMPARE_ACTIONS,
    *CALIBRATE_ACTIONS,
    *WINDOW_ACTIONS,
)


def bind_actions(features: Features, window: WindowFeature) -> dict[str, Run]:
    """Return the callable that runs each action, by the action's key."""
    return {
        **_bound(RECORD_ACTIONS, features.records),
        **_bound(CLINIC_ACTIONS, features.clinic),
        **_bound(CASE_FILE_ACTIONS, features.case_files),
        **_bound(CAPTURE_ACTIONS, features.capture),
        **_bound(DESIGN_ACTIONS, features.design),
        **_bound(EXPORT_ACTIONS, features.export),
        **_bound(COMPARE_ACTIONS, features.compare),
        **_bound(CALIBRATE_ACTIONS, features.calibrate),
        **_bound(WINDOW_ACTIONS, window),
    }


def _bound(records: Iterable[ActionRecord[Feature]], feature: Feature) -> dict[str, Run]:
    return {record.key: partial(record.run, feature) for record in records}
