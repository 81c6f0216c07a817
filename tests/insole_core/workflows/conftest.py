"""What the tests of workflows share: what is found in equal scans, and made of equal feet."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
from found_once import SharedResults, share_results


@pytest.fixture(scope="package")
def kept() -> SharedResults:
    return SharedResults()


@pytest.fixture(scope="module", autouse=True)
def same_results(kept: SharedResults) -> Iterator[None]:
    with pytest.MonkeyPatch.context() as patch:
        share_results(kept, patch)
        yield
