"""Apply the stored calibrations of its sensors to a recorded session."""

from __future__ import annotations

from dataclasses import replace
from datetime import UTC, datetime

from insole_core.calibration.stored_correction import apply_correction
from insole_core.errors import CalibrationError
from insole_core.messages import Message
from insole_core.recording.session import DotPictures, Session, View
from insole_core.sensing.correction import DisparityCorrection
from insole_core.sensing.sensor import Sensor
from insole_core.workflows.calibration.sensor_store import SensorStore


def calibrated_session(
    session: Session,
    store: SensorStore,
    correction: DisparityCorrection | None = None,
    insist: bool = False,
) -> tuple[Session, tuple[str, ...]]:
    """Replace the sensor of every view by its stored calibration, or apply a given correction.

    Views of sensors that deliver millimetres stay as recorded unless a calibration of theirs is
    stored.
    With the stored calibration, infrared pictures get the pattern of dots that is kept with it.

    Parameters
    ----------
    correction : optional
        For all other views, in place of the stored calibrations.
    insist
        Use a correction of another sensor nevertheless.

    Returns
    -------
    session : Session
    warnings : tuple of str
        For the user.

    Raises
    ------
    CalibrationError
        When a sensor was never calibrated, or the correction is that of another sensor.
    InputError
        When a stored calibration is damaged.
    """
    now = datetime.now(UTC)
    views: list[View] = []
    warnings: list[str] = []
    for view in session.views:
        if view.sensor.depth_unit_mm is not None and (
            correction is not None or store.load(view.sensor.serial) is None
        ):
            views.append(view)
            warnings.append(_as_recorded(view))
            continue
        sensor = view.sensor if correction is not None else _kept(view, store)
        chosen = correction or sensor.correction
        if chosen is not None:
            applied = apply_correction(sensor, chosen, now, insist)
            sensor = applied.sensor
            warnings += [
                Message("View {view}: {warning}", view=view.name, warning=warning)
                for warning in applied.warnings
            ]
        dots = view.dots if correction is not None else _with_pattern(view, store)
        if dots is not None and dots.fault:
            warnings.append(Message("View {view}: {warning}", view=view.name, warning=dots.fault))
        views.append(replace(view, sensor=sensor, dots=dots))
    return replace(session, views=tuple(views)), tuple(warnings)


def _as_recorded(view: View) -> Message:
    return Message(
        "View {view} stays as it was recorded, because its sensor {serial}, a {model}, delivers "
        "millimetres and was not calibrated here; calibrate it with walls.",
        view=view.name,
        serial=view.sensor.serial,
        model=view.sensor.model,
    )


def _with_pattern(view: View, store: SensorStore) -> DotPictures | None:
    """Return the infrared pictures of a view with the kept pattern of its sensor, if there is."""
    if view.dots is None:
        return None
    reference = store.reference(view.sensor.serial)
    if reference is None:
        return view.dots
    return replace(view.dots, reference=reference, pattern_fault="")


def _kept(view: View, store: SensorStore) -> Sensor:
    kept = store.load(view.sensor.serial)
    if kept is None:
        raise CalibrationError(
            "View {view} was recorded with sensor {serial}, which was never calibrated here; "
            "calibrate it first.",
            view=view.name,
            serial=view.sensor.serial,
        )
    recorded, known = view.sensor.color_camera, kept.color_camera
    if (recorded.width, recorded.height) != (known.width, known.height):
        raise CalibrationError(
            "View {view} has colour images of {width}×{height}, but the sensor was calibrated at "
            "{known_width}×{known_height}; calibrate its colour camera with pictures of that size.",
            view=view.name,
            width=recorded.width,
            height=recorded.height,
            known_width=known.width,
            known_height=known.height,
        )
    return replace(kept, faces=view.sensor.faces)
