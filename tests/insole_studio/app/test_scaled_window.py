"""What is seen on a screen of 150 %, such as most laptops have."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

from tests.patience import PATIENCE_S

HERE = Path(__file__).parent


@pytest.mark.display
def test_windows_fit_a_scaled_screen_and_views_have_no_black_edge(tmp_path: Path) -> None:
    tests = HERE.parents[1]
    core = tests / "insole_core"
    roots = (HERE.parent, tests, core, core / "records", tests.parent)
    ran = subprocess.run(
        [sys.executable, str(HERE / "scaled_window.py"), str(tmp_path)],
        env={
            **os.environ,
            "QT_SCALE_FACTOR": "1.5",
            "PYTHONPATH": os.pathsep.join(map(str, roots)),
        },
        capture_output=True,
        text=True,
        timeout=PATIENCE_S,
        check=False,
    )
    assert ran.returncode == 0, ran.stderr
    seen = json.loads(ran.stdout.splitlines()[-1])
    assert seen == {
        "window is within": True,
        "export is within": True,
        "any window is within": True,
        "black lines": 0,
    }
