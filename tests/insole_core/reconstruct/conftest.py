"""A small simulated session, whose views are measured once for all tests of its reconstruction."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import lru_cache
from pathlib import Path

import pytest

from insole_core.reconstruct import Reconstruction, reconstruct, reconstruction
from insole_core.reconstruct.views.measured_view import (
    MeasuredView,
    measure_as_thesis,
    measure_view,
)
from insole_core.recording.reader import read_session
from insole_core.recording.session import Session, View

KEPT_VIEWS = 6


@pytest.fixture(scope="package")
def remembered() -> dict[str, Callable[[View], MeasuredView]]:
    return {
        "fused": lru_cache(KEPT_VIEWS)(measure_view),
        "thesis": lru_cache(KEPT_VIEWS)(measure_as_thesis),
    }


@pytest.fixture(scope="module", autouse=True)
def measured_once(remembered: dict[str, Callable[[View], MeasuredView]]) -> Iterator[None]:
    """Measure a view once, and find its markers once, as the product does while it is open.

    A view that a test has changed is another one.
    """
    defaults = {**(reconstruct.__kwdefaults__ or {}), "measure": remembered["fused"]}
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(reconstruct, "__kwdefaults__", defaults)
        patch.setattr(reconstruction, "measure_as_thesis", remembered["thesis"])
        yield


@pytest.fixture(scope="package")
def session() -> Session:
    return read_session(Path(__file__).parents[2] / "data" / "sessions" / "left_small.zip")


@pytest.fixture(scope="package")
def fused(session: Session) -> Reconstruction:
    """The foot of the small session by the method of the product."""
    return reconstruct(session)
