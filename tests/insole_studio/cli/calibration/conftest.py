"""A sensor's folders of images, recorded once; and calibrated copies of what is kept of it."""

from __future__ import annotations

import shutil
from dataclasses import dataclass
from pathlib import Path

import pytest
from found_once import SharedResults, share_results
from simulated_device import WALLS, SimulatedDevice, smooth_distortion
from simulated_folders import BOARD_CALL, write_boards, write_walls

from insole_core.calibration.plausibility import USUAL_DEPTH
from insole_studio.cli.main import run


@dataclass(frozen=True)
class Recorded:
    """Where the images lie, and where the sensors that were calibrated from them are kept."""

    boards: Path
    infrared: Path
    walls: Path
    sensors: Path


@pytest.fixture(scope="session")
def recorded_once(
    tmp_path_factory: pytest.TempPathFactory, undraw_reports, kept: SharedResults
) -> Recorded:
    folder = tmp_path_factory.mktemp("recorded")
    device = SimulatedDevice(smooth_distortion(3, 3.0), disparity=USUAL_DEPTH)
    recorded = Recorded(
        write_boards(folder / "boards", device, 10),
        write_boards(folder / "infrared", device, 8, ("color", "ir")),
        write_walls(folder / "walls", device, WALLS),
        folder / "sensors",
    )
    call = ["--serial", "SIM1", "--sensors", str(recorded.sensors)]
    with pytest.MonkeyPatch.context() as patch:
        undraw_reports(patch)
        share_results(kept, patch)  # tests look for the board in the same pictures
        assert run(["calibrate", "color", str(recorded.boards), *BOARD_CALL, *call]) == 0
        assert run(["calibrate", "distortion", str(recorded.walls), *call]) == 0
    return recorded


@pytest.fixture
def recorded(recorded_once: Recorded, tmp_path: Path) -> Recorded:
    """The same with a copy of the kept sensors that a test may change."""
    shutil.copytree(recorded_once.sensors, tmp_path / "sensors")
    return Recorded(
        recorded_once.boards, recorded_once.infrared, recorded_once.walls, tmp_path / "sensors"
    )


@pytest.fixture
def last_line(capsys: pytest.CaptureFixture[str]):
    return lambda: capsys.readouterr().err.strip().splitlines()[-1]
