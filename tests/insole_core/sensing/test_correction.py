from __future__ import annotations

from datetime import UTC, datetime
from pathlib import Path

import numpy as np
import pytest

from insole_core.errors import InputError
from insole_core.sensing.correction import (
    CorrectionRecord,
    DisparityCorrection,
    load_correction,
    parse_correction,
)
from insole_core.sensing.disparity import LinearInverseDisparity
from insole_core.sensing.pinhole_camera import PinholeCamera
from insole_core.sensing.sensor import Sensor

RAMP = np.linspace(-3, 3, 480 * 640, dtype=np.float32).reshape(480, 640)


def correction() -> DisparityCorrection:
    return DisparityCorrection(
        offset=RAMP,
        slope=RAMP / 100,
        reference_raw=650.0,
        raw_range=(600.0, 700.0),
        coverage=np.full((480, 640), 4, np.uint8),
        deviation=np.full((480, 640), 0.25, np.float32),
        record=CorrectionRecord("A003", "2026-11-21T10:00:00+00:00", "smooth", {"walls": 6.0}),
    )


def test_round_trip(tmp_path: Path) -> None:
    path = tmp_path / "correction.npz"
    correction().save(path)
    loaded = load_correction(path)
    assert loaded.record == correction().record
    assert (loaded.reference_raw, loaded.raw_range) == (650.0, (600.0, 700.0))
    for name in ("offset", "slope", "coverage", "deviation"):
        assert np.array_equal(getattr(loaded, name), getattr(correction(), name))


def test_an_offset_alone_is_enough(tmp_path: Path) -> None:
    path = tmp_path / "old.npz"
    np.savez(path, offset=RAMP)
    loaded = load_correction(path)
    raw = np.full((480, 640), 700.0)
    assert np.allclose(loaded.corrected(raw), raw - RAMP)
    assert loaded.covered.all()


def test_arrays_of_another_program_are_left_alone(tmp_path: Path) -> None:
    path = tmp_path / "foreign.npz"
    np.savez(path, offset=RAMP, slope=np.ones(3), coverage=np.zeros((480, 640)))
    assert load_correction(path).slope is None


def test_the_slope_acts_within_the_range_only() -> None:
    at = {r: correction().offset_at(np.full((480, 640), r))[0, 0] for r in (600.0, 650.0, 500.0)}
    assert at[650.0] == pytest.approx(-3)
    assert at[600.0] == pytest.approx(-3 + 0.03 * 50)
    assert at[500.0] == at[600.0]


def test_no_reading_stays_no_reading() -> None:
    raw = np.full((480, 640), 650.0)
    raw[3, 4] = np.nan
    corrected = correction().corrected(raw)
    assert np.isnan(corrected[3, 4])
    assert np.isfinite(corrected).sum() == raw.size - 1


def test_a_sensor_uses_the_refined_correction() -> None:
    camera = PinholeCamera(640, 480, 585, 585, 320, 240)
    disparity = LinearInverseDisparity(3.33, -0.00307)
    sensor = Sensor("m", "s", camera, camera, np.eye(4), disparity, correction=correction())
    raw = np.full((480, 640), 620.0)
    assert np.allclose(
        sensor.depth_mm(raw), disparity.depth_mm(raw - RAMP - RAMP / 100 * (620 - 650))
    )


def test_age() -> None:
    now = datetime(2026, 11, 23, 10, tzinfo=UTC)
    assert correction().record.age_days(now) == pytest.approx(2)
    assert CorrectionRecord(made_at="2026-11-22T10:00:00").age_days(now) == pytest.approx(1)
    assert CorrectionRecord().age_days(now) == float("inf")


@pytest.mark.parametrize(
    ("arrays", "words"),
    [
        ({"other": RAMP}, "no readable array"),
        ({"offset": RAMP[:10]}, "480×640 finite"),
        ({"offset": np.full((480, 640), np.nan)}, "480×640 finite"),
        ({"offset": RAMP, "slope": RAMP[:, :5], "record": np.array("{}")}, '"slope" must hold'),
        ({"offset": RAMP, "record": np.array('{"version": 9}')}, "newer than this program"),
        ({"offset": RAMP, "record": np.array("nonsense")}, "no readable array"),
        ({"offset": RAMP, "record": np.array("{}"), "raw_range": np.ones(3)}, "two raw numbers"),
        ({"offset": RAMP, "record": np.array("{}"), "decay": np.array("x")}, "one number"),
        ({"offset": RAMP, "record": np.array("{}"), "reference_raw": RAMP}, "one number"),
        ({"offset": RAMP, "record": np.array("{}"), "decay": np.array(1.0)}, "one number"),
        ({"offset": RAMP, "record": np.array("{}"), "reference_raw": np.array(1e5)}, "one number"),
        ({"offset": RAMP, "record": np.array('{"made_at": 5}')}, "no readable array"),
        ({"offset": RAMP, "record": np.array('{"made_at": "soon"}')}, "no readable array"),
        ({"offset": RAMP, "record": np.array('{"serial": ["A"]}')}, "no readable array"),
        ({"offset": RAMP, "record": np.array('{"figures": {"rms": "1"}}')}, "no readable array"),
        ({"offset": RAMP, "record": np.array('{"version": "2"}')}, "no readable array"),
        ({"offset": RAMP, "record": np.array("{}"), "coverage": RAMP[:9]}, '"coverage" must hold'),
        ({"offset": RAMP.astype(complex)}, "no readable array"),
        ({"offset": np.full((480, 640), "a")}, "480×640 finite"),
        ({"offset": np.full((480, 640), 1e300)}, "480×640 finite"),
    ],
)
def test_bad_files_are_refused(tmp_path: Path, arrays: dict[str, np.ndarray], words: str) -> None:
    path = tmp_path / "bad.npz"
    np.savez(path, **arrays)
    with pytest.raises(InputError, match=words):
        load_correction(path)


@pytest.mark.parametrize("at", [0.1, 0.4, 0.6, 0.9])
def test_a_flipped_bit_is_noticed(tmp_path: Path, at: float) -> None:
    path = tmp_path / "correction.npz"
    correction().save(path)
    content = bytearray(path.read_bytes())
    content[int(at * len(content))] ^= 4
    path.write_bytes(bytes(content))
    with pytest.raises(InputError, match=r"no readable array|must hold"):
        load_correction(path)


def test_missing_and_damaged_files_are_refused(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="cannot be read"):
        load_correction(tmp_path / "none.npz")
    with pytest.raises(InputError, match="no readable"):
        parse_correction("x.npz", b"PK\x03\x04 broken")
