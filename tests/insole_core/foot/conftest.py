"""Feet of recorded sessions, each reconstructed once."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from pathlib import Path

import pytest

from insole_core.foot.foot import Foot
from insole_core.workflows.open_scan import open_scan


@pytest.fixture(scope="package")
def recorded_foot(shared_data: Path) -> Callable[[str], Foot]:
    """Give the foot of a session of the reference data by its name."""
    return cache(lambda name: open_scan(shared_data / "sessions" / name).foot)
