"""What all tests share."""

from __future__ import annotations

import gc
import os
from collections.abc import Iterator
from pathlib import Path

import pytest
from hypothesis import settings

from benchmarks._measure import resident_mb
from insole_studio.native_heap import return_freed_memory

settings.register_profile("any machine", deadline=None)
settings.load_profile("any machine")

# As the command does, before numpy reads it: beside a second worker, threads of OpenBLAS only wait
# for each other, in twice the processor time.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
# So do those of Mesa, which draws with the processor.
os.environ.setdefault("LP_NUM_THREADS", "1")

GROWN_MB = 150.0
KEPT_MB = pytest.StashKey[float]()

gc.disable()  # nothing that is imported for the tests is garbage


@pytest.hookimpl(optionalhook=True)
def pytest_xdist_auto_num_workers() -> int:
    """Start one more than there are processors: tests wait for frames, disks and servers."""
    return (os.cpu_count() or 1) + 1


def pytest_collection_finish() -> None:
    """Collect what the tests leave, and look through nothing that was there before them."""
    gc.freeze()
    gc.enable()


@pytest.fixture(scope="module", autouse=True)
def returned_memory(request: pytest.FixtureRequest) -> Iterator[None]:
    """Hand back what a module has freed, and made once for all its tests.

    Commands of the product keep what is freed in the heap.
    """
    yield
    for made_once in vars(request.module).values():
        if getattr(made_once, "__module__", "") == request.module.__name__:
            getattr(made_once, "cache_clear", int)()
    return_freed_memory()


@pytest.hookimpl(trylast=True)
def pytest_runtest_teardown(item: pytest.Item, nextitem: pytest.Item | None) -> None:
    """Look through what is frozen too, once the process has grown.

    A window that served a whole module was there before its tests, was frozen by them, and is a
    cycle when the module ends; so is a foot that was kept for other tests until newer ones came.
    """
    stash = item.config.stash
    kept_mb = stash.setdefault(KEPT_MB, resident_mb())
    if nextitem is None or nextitem.path != item.path:  # what its module shared is free again
        kept_mb = stash[KEPT_MB] = min(kept_mb, resident_mb())
    most_mb = kept_mb + GROWN_MB
    # What is frozen takes half a second to look through: mostly the test has just freed much.
    if resident_mb() <= most_mb:
        return
    for free in (return_freed_memory, gc.collect, return_freed_memory):
        free()
        if resident_mb() <= most_mb:
            return
    gc.unfreeze()
    gc.collect()
    gc.freeze()
    return_freed_memory()
    stash[KEPT_MB] = resident_mb()


SHARED_DATA = Path(__file__).resolve().parents[2] / "shared" / "data"


@pytest.fixture(scope="session")
def shared_data() -> Path:
    """The reference data beside the checkout; the test is skipped where it is absent."""
    if not SHARED_DATA.is_dir():
        pytest.skip("the reference data ../shared/data is absent")
    return SHARED_DATA


@pytest.fixture(scope="session", autouse=True)
def unsynced() -> Iterator[None]:
    """Wait for no disk: no test cuts the power, and what a killed process has written is there."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(os, "fsync", lambda _handle: None)
        yield


@pytest.fixture(scope="session", autouse=True)
def own_state_folder(tmp_path_factory: pytest.TempPathFactory) -> Iterator[None]:
    """Journals, settings, devices and sensors are kept apart from those of this computer's user."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("XDG_STATE_HOME", str(tmp_path_factory.mktemp("state")))
        patch.setenv("XDG_CONFIG_HOME", str(tmp_path_factory.mktemp("config")))
        patch.setenv("XDG_DATA_HOME", str(tmp_path_factory.mktemp("data")))
        yield
