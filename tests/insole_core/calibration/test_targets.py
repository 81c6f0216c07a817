from __future__ import annotations

import re
import runpy
from dataclasses import replace
from datetime import UTC, datetime
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from read_pdf import paths_of_pdf
from simulated_device import CAMERA, DISPARITY

from insole_core.calibration.boards.board import Charuco, Chequerboard
from insole_core.calibration.boards.printed_page import charuco_page, chequerboard_page
from insole_core.calibration.markers.reference_file import load_reference_system
from insole_core.calibration.stored_correction import apply_correction
from insole_core.errors import CalibrationError, UsageError
from insole_core.geometry.arrays import ByteArray
from insole_core.resources import resource_path
from insole_core.sensing.correction import CorrectionRecord, DisparityCorrection
from insole_core.sensing.sensor import Sensor

targets = SimpleNamespace(**runpy.run_path(str(resource_path("targets/make.py"))))
PX_PER_MM = 5.0


def printed(figure: Figure) -> ByteArray:
    figure.set_dpi(PX_PER_MM * 25.4)
    canvas = FigureCanvasAgg(figure)
    canvas.draw()
    return np.ascontiguousarray(np.asarray(canvas.buffer_rgba())[..., 1])


def test_the_printed_chequerboard_has_its_true_size() -> None:
    board = Chequerboard(10, 7, 25)
    found = board.find("print", printed(targets.draw(chequerboard_page(board, targets.A4_MM))))
    steps = np.linalg.norm(np.diff(found.pixels.reshape(7, 10, 2), axis=1), axis=-1)
    assert np.allclose(steps / PX_PER_MM, 25, atol=0.05)


def test_the_printed_charuco_board_has_its_true_size() -> None:
    board = Charuco(10, 7, 27, 20)
    found = board.find("print", printed(targets.draw(charuco_page(board, targets.A4_MM))))
    assert len(found.pixels) == 54
    spread = np.ptp(found.pixels, axis=0) / np.ptp(found.points_mm[:, :2], axis=0)
    assert np.allclose(spread, PX_PER_MM, rtol=2e-3)


@pytest.mark.parametrize(
    ("name", "rulers"),
    [
        ("targets/chequerboard-a4-25mm.pdf", 1), ("targets/chequerboard-a3-30mm.pdf", 1),
        ("targets/charuco-a4-27mm.pdf", 1), ("reference_systems/lego-20-plan.pdf", 2),
        ("reference_systems/lego-40-plan.pdf", 4),
    ],
)  # fmt: skip
def test_the_rulers_of_what_is_shipped_are_100_mm(name: str, rulers: int) -> None:
    sizes = [np.ptp(line, axis=0) for line in paths_of_pdf(resource_path(name))]
    assert sum(bool(np.allclose(size, [100, 0], atol=0.03)) for size in sizes) == rulers


def test_a_board_that_does_not_fit(tmp_path: Path) -> None:
    with pytest.raises(UsageError, match="does not fit a page"):
        chequerboard_page(Chequerboard(10, 7, 30), targets.A4_MM)
    page = chequerboard_page(Chequerboard(10, 7, 30), targets.A3_MM)
    targets.write([targets.draw(page)], tmp_path / "x.pdf")
    box = re.search(rb"/MediaBox \[ ?0 0 ([\d.]+) ([\d.]+)", (tmp_path / "x.pdf").read_bytes())
    assert box is not None
    assert float(box[1]) == pytest.approx(420 / 25.4 * 72, abs=0.1)


def test_the_building_plan(tmp_path: Path) -> None:
    system = load_reference_system(resource_path("reference_systems/lego-20.json"))
    pages = targets.draw_building_plan(system)
    assert len(pages) == 2 * len({marker.face for marker in system.markers})
    targets.write(pages, tmp_path / "plan.pdf")
    assert (tmp_path / "plan.pdf").read_bytes().startswith(b"%PDF")
    for face in ("sole", "achilles"):
        steps = targets.brick_steps(system.facing((face,)))
        assert min(step[1] for step in steps) == 0
        # Everything stands on plates, or on studs turned sideways (2.5 plates).
        assert all(step[3] % 1 == 0 or step[3] % 2.5 == 0 for step in steps)


@pytest.mark.parametrize(
    "name",
    ["chequerboard-a4-25mm.pdf", "chequerboard-a3-30mm.pdf", "charuco-a4-27mm.pdf"],
)
def test_the_targets_come_with_the_product(name: str) -> None:
    assert resource_path(f"targets/{name}").read_bytes().startswith(b"%PDF")


def sensor() -> Sensor:
    return Sensor("m", "A1", CAMERA, CAMERA, np.eye(4), DISPARITY)


def correction(serial: str) -> DisparityCorrection:
    record = CorrectionRecord(serial, "2026-11-01T00:00:00+00:00")
    return DisparityCorrection(np.ones((480, 640), np.float32), record=record)


NOW = datetime(2026, 11, 21, tzinfo=UTC)


def test_a_correction_of_another_kind_of_sensor_is_refused() -> None:
    stereo = replace(sensor(), model="d415", depth_unit_mm=0.1, baseline_mm=55.0)
    of_stereo = replace(correction("A1"), record=replace(correction("A1").record, unit="px"))
    assert apply_correction(stereo, of_stereo, NOW).sensor.correction is of_stereo
    small = replace(of_stereo, offset=np.ones((48, 64), np.float32))
    for known, other in (
        (stereo, correction("A1")),
        (stereo, small),
        (sensor(), of_stereo),
        (replace(stereo, baseline_mm=None), of_stereo),
    ):
        with pytest.raises(CalibrationError, match="is not for the depth of sensor A1, a "):
            apply_correction(known, other, NOW, insist=True)


def test_the_own_correction_is_applied() -> None:
    result = apply_correction(sensor(), correction("A1"), NOW)
    assert result.warnings == ()
    raw = np.full((480, 640), 700.0)
    assert np.allclose(result.sensor.depth_mm(raw), DISPARITY.depth_mm(raw - 1))


def test_the_correction_of_another_device_is_refused_or_warned_of() -> None:
    with pytest.raises(CalibrationError, match="measured on sensor B2, not on A1"):
        apply_correction(sensor(), correction("B2"), NOW)
    result = apply_correction(sensor(), correction("B2"), NOW, insist=True)
    assert "several millimetres" in result.warnings[0]


def test_an_old_correction_is_used_with_a_warning() -> None:
    later = datetime(2027, 11, 21, tzinfo=UTC)
    assert "385 days old" in apply_correction(sensor(), correction("A1"), later).warnings[0]
    undated = replace(correction("A1"), record=CorrectionRecord("A1"))
    assert "unknown age" in apply_correction(sensor(), undated, NOW).warnings[0]
