"""What the tests of the commands share: sessions that are simulated once."""

from __future__ import annotations

from functools import cache

import pytest

from insole_core import simulate

SIMULATED = cache(simulate.simulate_session)


@pytest.fixture
def simulated_once(monkeypatch: pytest.MonkeyPatch) -> None:
    """For tests that look at what becomes of a simulated session: simulating takes the longest."""
    monkeypatch.setattr(simulate, "simulate_session", lambda options, _progress: SIMULATED(options))
