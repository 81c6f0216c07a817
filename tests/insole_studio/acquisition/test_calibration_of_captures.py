"""A capture tells when its sensors were calibrated, and how well."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from capture_samples import FRAMES, SERIALS, make_bench

from insole_core.evaluation.report import ReportSection
from insole_core.recording.reader import read_session
from insole_core.recording.writer import write_session
from insole_core.records.capture import CaptureFacts
from insole_core.sensing.correction import CorrectionRecord, DisparityCorrection
from insole_core.sensing.sensor import CalibrationRecord, nominal_kinect
from insole_core.workflows.calibration.report_files import keep_step
from insole_core.workflows.calibration.sensor_store import SensorStore
from insole_core.workflows.calibration.steps import StepResult
from insole_core.workflows.records.capture_facts import capture_facts
from insole_studio.acquisition.capture_plan import make_plan

SERIAL = SERIALS[0]


@pytest.fixture(scope="module")
def captured(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A session of one view, of a sensor two steps of which were saved, one of them twice."""
    folder = tmp_path_factory.mktemp("captured")
    store = SensorStore(folder / "sensors")
    for step, residual in (("camera", 0.9), ("camera", 0.312345), ("disparity", 1.25)):
        sensor = store.load(SERIAL) or nominal_kinect(SERIAL)
        unit = "px" if step == "camera" else "mm"
        keep_step(StepResult(sensor, ReportSection(step, step), (), (residual, unit)), store)
    bench = make_bench(folder / "draft", store)
    try:
        bench.capture(make_plan([("left", SERIAL)], frames=FRAMES))
        bench.draft.publish(folder / "session")
    finally:
        bench.close()
    return folder / "session"


def test_a_capture_holds_date_and_residuals_of_each_step(captured: Path) -> None:
    (view,) = read_session(captured).views
    assert [(s.step, s.residual, s.unit) for s in view.sensor.calibration] == [
        ("camera", 0.312345, "px"),
        ("disparity", 1.25, "mm"),
    ]
    facts = capture_facts(captured)
    assert facts.calibrated_on == view.sensor.calibration[0].made_at
    assert facts.calibration_residuals == {
        f"{SERIAL}: camera, px": 0.312,
        f"{SERIAL}: disparity, mm": 1.25,
    }
    assert facts.residual_lines == [f"{SERIAL}: camera 0.31 px", f"{SERIAL}: disparity 1.25 mm"]


def test_an_archive_keeps_it(captured: Path, tmp_path: Path) -> None:
    write_session(read_session(captured), tmp_path / "session.zip")
    assert capture_facts(tmp_path / "session.zip") == capture_facts(captured)


@pytest.mark.parametrize(
    "values",
    [
        None,
        "2026-11-01",
        {"camera": 1},
        [1, {}, {"step": "camera"}],
        [{"step": "<b>", "made_at": "2026-11-01", "residual": 1, "unit": "px"}],
        [{"step": "camera", "made_at": "yesterday", "residual": 1, "unit": "px"}],
        [{"step": "camera", "made_at": "2026-11-01", "residual": -1, "unit": "px"}],
        [{"step": "camera", "made_at": "2026-11-01", "residual": float("nan"), "unit": "px"}],
        [{"step": "camera", "made_at": "2026-11-01", "residual": 1, "unit": "miles"}],
    ],
)
def test_what_other_programs_mean_by_it_is_passed_over(
    captured: Path, tmp_path: Path, values: object
) -> None:
    session = read_session(captured)
    write_session(session, tmp_path / "session")
    path = tmp_path / "session/views/left/sensor.json"
    sensor = json.loads(path.read_text())
    path.write_text(json.dumps(sensor | {"calibration": values}))
    facts = capture_facts(tmp_path / "session")
    assert (facts.calibrated_on, facts.calibration_residuals) == ("", {})
    assert facts.sensor_serials == (SERIAL,)


def test_older_sessions_tell_what_their_correction_tells(captured: Path, tmp_path: Path) -> None:
    session = read_session(captured)
    record = CorrectionRecord(SERIAL, "2026-09-01T08:00:00", "walls", {"rms_after_raw": 0.52})
    correction = DisparityCorrection(np.zeros((480, 640), np.float32), record=record)
    older = replace(session.views[0].sensor, calibration=(), correction=correction)
    view = replace(session.views[0], sensor=older)
    write_session(replace(session, views=(view,)), tmp_path / "session")
    facts = capture_facts(tmp_path / "session")
    assert facts.calibrated_on == "2026-09-01T08:00:00"
    assert facts.calibration_residuals == {f"{SERIAL}: distortion, raw": 0.52}
    later = older.calibrated(CalibrationRecord("distortion", "2026-10-01", 0.4, "raw"))
    write_session(replace(session, views=(replace(view, sensor=later),)), tmp_path / "later")
    assert capture_facts(tmp_path / "later").calibrated_on == "2026-10-01"


def test_a_scan_of_another_device_tells_nothing(tmp_path: Path) -> None:
    path = tmp_path / "left.stl"
    path.write_bytes(b"solid")
    assert capture_facts(path) == CaptureFacts()
