"""Sensors that play known frames, and what a capture needs around them."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from capture_samples import Bench, NothingStored, make_bench

from insole_core.recording.session import CaptureCondition


@pytest.fixture
def condition() -> CaptureCondition:
    return CaptureCondition("semi", True, "cold feet")


@pytest.fixture
def make(tmp_path: Path) -> Iterator[Callable[..., Bench]]:
    """Make a bench; its draft is closed at the end."""
    benches: list[Bench] = []

    def build(**options: object) -> Bench:
        benches.append(make_bench(tmp_path / f"draft{len(benches)}", NothingStored(), **options))
        return benches[-1]

    yield build
    for bench in benches:
        bench.close()


@pytest.fixture
def bench(make: Callable[..., Bench]) -> Bench:
    """Three sensors, each on a controller of its own."""
    return make()
