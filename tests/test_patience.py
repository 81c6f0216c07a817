"""All tests wait alike: until it has happened, and a minute at most."""

from __future__ import annotations

import re
from pathlib import Path

HERE = Path(__file__).parent
OWN_LIMIT = re.compile(r"timeout=\d|PATIENCE_M?S = [\d.]+$", re.MULTILINE)


def test_how_long_tests_wait_stands_in_one_place() -> None:
    found = {
        path.relative_to(HERE).as_posix()
        for path in HERE.rglob("*.py")
        if OWN_LIMIT.search(path.read_text(encoding="utf-8"))
    }
    # Windows that are killed and started many times over.
    assert found - {"insole_studio/killed_windows.py"} == {"patience.py"}
