"""What the tests of workflows share: what is found in equal scans, and made of equal feet.

Their designs begin on a coarse grid: a workflow does the same with it.
"""

from __future__ import annotations

from collections.abc import Iterator

import pytest
from coarse_designs import begin_coarse, begin_fine
from found_once import SharedResults, share_results


@pytest.fixture(scope="package")
def kept() -> SharedResults:
    return SharedResults()


@pytest.fixture(scope="module", autouse=True)
def same_results(kept: SharedResults) -> Iterator[None]:
    with pytest.MonkeyPatch.context() as patch:
        share_results(kept, patch)
        begin_coarse(patch)
        yield


@pytest.fixture(autouse=True)
def product_grid(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> None:
    """Let designs of a test that is marked as fine begin with the product's grid."""
    if request.node.get_closest_marker("fine") is not None:
        begin_fine(monkeypatch)
