"""The reports of a calibration: beside the kept sensor, and where they are asked for."""

from __future__ import annotations

from pathlib import Path

import pytest
from simulated_folders import BOARD_CALL

from insole_studio.cli.main import run

pytestmark = pytest.mark.slow

SUFFIXES = (".html", ".json", ".pdf")


def test_reports_where_they_are_asked_for(recorded, tmp_path: Path) -> None:
    asked = [tmp_path / f"asked{suffix}" for suffix in SUFFIXES]
    words = ["calibrate", "color", str(recorded.boards), *BOARD_CALL, "--serial", "SIM1"]
    words += ["--sensors", str(recorded.sensors), "--report", *map(str, asked)]
    assert run(words) == 0
    page = asked[0].read_text()
    assert "SIM1" in page
    assert page.count("data:image/png;base64,") == 4
    assert asked[2].read_bytes().startswith(b"%PDF")
    for suffix, path in zip(SUFFIXES, asked, strict=True):
        kept = recorded.sensors / "SIM1" / f"camera{suffix}"
        assert kept.read_bytes() == path.read_bytes()
