"""Pipes, devices and endless files are refused at once, wherever a path comes from."""

from __future__ import annotations

import os
import stat
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import pytest

from insole_core.cases.case_file import read_case
from insole_core.cases.scan_source import ScanSource
from insole_core.errors import InputError
from insole_core.forgiving_json import remembered
from insole_core.insole.prescription.design_json import read_design
from insole_core.insole.prescription.template import read_template
from insole_core.progress import Cancelled, Progress
from insole_core.recording.reader import read_session
from insole_core.recording.sensor_folder import read_sensor
from insole_core.regular_file import read_regular
from insole_core.sensing.correction import load_correction
from insole_core.solids.export_rules import read_rules
from insole_core.workflows.scanned_feet import change_of_source

ENDLESS = 2**40


@pytest.fixture(params=["pipe", "device", "link to a device", "endless file"])
def trap(request: pytest.FixtureRequest, tmp_path: Path) -> Callable[[str], Path]:
    """Lays a trap under the name that is wanted."""

    def lay(name: str) -> Path:
        path = tmp_path / name
        path.parent.mkdir(parents=True, exist_ok=True)
        if request.param == "pipe":
            os.mkfifo(path)
        elif request.param == "endless file":
            with path.open("wb") as file:
                file.truncate(ENDLESS)  # sparse: no disk is filled
        elif request.param == "link to a device" or os.geteuid() != 0:
            path.symlink_to("/dev/zero")
        else:
            os.mknod(path, 0o600 | 0o020000, os.makedev(1, 5))
        return path

    return lay


@pytest.mark.parametrize(
    ("name", "read"),
    [
        ("anna.insole", read_case),
        ("session.zip", read_session),
        ("session/manifest.json", lambda path: read_session(path.parent)),
        ("sensor/sensor.json", lambda path: read_sensor(path.parent)),
        ("correction.npz", load_correction),
        ("design.json", read_design),
        ("pad.insole-template", read_template),
        ("export.json", read_rules),
    ],
)
def test_what_is_no_file_is_refused(
    trap: Callable[[str], Path], name: str, read: Callable[[Path], object]
) -> None:
    with pytest.raises(InputError):
        read(trap(name))


def test_remembered_settings_are_forgotten(trap: Callable[[str], Path]) -> None:
    assert remembered(trap("settings.json"), {"theme": str}) == {}


@pytest.mark.skipif(getattr(os, "geteuid", int)() != 0, reason="only root makes devices")
def test_a_device_in_the_place_of_settings_stays(tmp_path: Path) -> None:
    device = tmp_path / "full"
    os.mknod(device, 0o600 | stat.S_IFCHR, os.makedev(1, 7))
    assert remembered(device, {"theme": str}) == {}
    assert device.is_char_device()


@pytest.mark.parametrize("name", ["foot.ply", "session.zip", "session/manifest.json"])
def test_the_scan_of_a_case_is_told_to_be_lost(trap: Callable[[str], Path], name: str) -> None:
    path = trap(name)
    named = path.parent if name.endswith(".json") else path
    sentence = change_of_source(ScanSource("mesh", str(named), "0" * 64))
    assert "cannot be read" in sentence


def test_looking_at_a_large_scan_can_be_cancelled(tmp_path: Path) -> None:
    scan = tmp_path / "foot.ply"
    scan.write_bytes(b"x")
    source = ScanSource("mesh", str(scan), "0" * 64)
    with pytest.raises(Cancelled):
        change_of_source(source, replace(Progress(), is_cancelled=lambda: True))


def test_a_file_that_grows_is_read_to_its_limit(tmp_path: Path) -> None:
    path = tmp_path / "a"
    path.write_bytes(b"1234")
    assert read_regular(path, 4) == b"1234"
    with pytest.raises(OSError, match="far larger"):
        read_regular(path, 3)
