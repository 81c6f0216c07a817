from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from capture_samples import Bench

from insole_core.calibration.markers.reference_file import save_reference_system
from insole_core.errors import CalibrationError, InputError
from insole_core.recording.reader import read_session
from insole_core.sensing.correction import CorrectionRecord, DisparityCorrection
from insole_core.sensing.sensor import nominal_kinect
from insole_core.workflows.calibration.sensor_store import SensorStore
from insole_studio.acquisition.capture_plan import view_faces
from insole_studio.acquisition.capture_setup import own_setup, recorded_setup
from insole_studio.acquisition.sensor_source import SensorSource


@pytest.fixture
def store(tmp_path: Path) -> SensorStore:
    return SensorStore(tmp_path / "sensors")


def corrected(serial: str) -> DisparityCorrection:
    offset = np.full((480, 640), 1.5, np.float32)
    record = CorrectionRecord(serial, "2026-11-01T10:00:00+00:00", "walls")
    return DisparityCorrection(offset, record=record)


def test_the_stored_calibration_of_the_serial_number_is_used(
    bench: Bench, store: SensorStore
) -> None:
    store.save(replace(nominal_kinect("A1"), correction=corrected("A1")))
    setup = own_setup(store)
    with bench.rig.open("A1") as opened:
        found = setup.calibrated(opened, "top")
    assert found.origin == "settings"
    assert found.sensor.serial == "A1"
    assert found.sensor.faces == ("achilles",)
    assert found.sensor.correction is not None
    assert found.sensor.correction.offset[0, 0] == 1.5


def test_without_one_the_device_tells(bench: Bench, store: SensorStore) -> None:
    with bench.rig.open("B2") as opened:
        found = own_setup(store).calibrated(opened, "left")
    assert found.origin == "factory"
    assert found.sensor.faces == ("sole",)
    assert found.sensor.depth_camera.fx == pytest.approx(575.816, abs=1e-3)
    assert float(found.sensor.disparity.depth_mm(np.array(744.0))) == pytest.approx(1000.4, abs=1)
    assert "not calibrated" in found.warnings[0]


def test_a_correction_of_another_sensor_is_refused(bench: Bench, store: SensorStore) -> None:
    store.save(replace(nominal_kinect("A1"), correction=corrected("Z9")))
    with bench.rig.open("A1") as opened, pytest.raises(CalibrationError, match="sensor Z9"):
        own_setup(store).calibrated(opened, "left")


def test_an_emulated_sensor_is_calibrated_as_recorded(
    store: SensorStore, small_session: Path
) -> None:
    session = read_session(small_session)
    setup = recorded_setup(store, session)
    assert setup.system == session.manifest.reference_system
    assert setup.volume_of_interest == session.manifest.volume_of_interest
    assert set(setup.recorded) == set(session.manifest.views)


def test_an_own_reference_system_is_read(store: SensorStore, tmp_path: Path) -> None:
    usual = own_setup(store).system
    save_reference_system(replace(usual, name="own"), tmp_path / "own.json")
    assert own_setup(store, tmp_path / "own.json").system.name == "own"


def test_another_reference_system_takes_the_place_of_the_recorded_one(
    store: SensorStore, small_session: Path, tmp_path: Path
) -> None:
    session, file = read_session(small_session), tmp_path / "own.json"
    save_reference_system(replace(session.manifest.reference_system, name="own"), file)
    source = SensorSource(store, small_session, file)
    setup = source.setup()
    assert setup.system.name == "own"
    assert setup.volume_of_interest is None, "that of the recording is in another frame"
    for view in session.views:
        assert setup.recorded[view.name].faces == view_faces(view.name, setup.system)
    with pytest.raises(InputError, match=r"nothing\.json"):
        replace(source, system_file=tmp_path / "nothing.json").setup()
