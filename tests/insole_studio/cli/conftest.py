"""What the tests of the commands share: sessions and parsers that are made once; coarse designs."""

from __future__ import annotations

import argparse
from collections.abc import Collection, Iterator
from functools import cache

import pytest
from coarse_designs import begin_coarse, begin_fine

from insole_core import simulate
from insole_studio.cli import main

SIMULATED = cache(simulate.simulate_session)


@pytest.fixture(scope="module", autouse=True)
def coarse_designs() -> Iterator[None]:
    """Let each command design on the coarse grid."""
    with pytest.MonkeyPatch.context() as patch:
        begin_coarse(patch)
        yield


@pytest.fixture(autouse=True)
def product_grid(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> None:
    """Let designs of a test that is marked as fine begin with the product's grid."""
    if request.node.get_closest_marker("fine") is not None:
        begin_fine(monkeypatch)


PARSER_OF = cache(main.command_parser)


@pytest.fixture(scope="module", autouse=True)
def same_parsers() -> Iterator[None]:
    """Let calls of one command share its parser, which parses none differently from the other."""

    def parser(words: Collection[str] | None = None) -> argparse.ArgumentParser:
        if words is None:
            return PARSER_OF()
        return PARSER_OF(tuple(c.NAME for c in main.COMMANDS if c.NAME in words))

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(main, "command_parser", parser)
        yield


@pytest.fixture
def simulated_once(monkeypatch: pytest.MonkeyPatch) -> None:
    """For tests that look at what becomes of a simulated session: simulating takes the longest."""
    monkeypatch.setattr(simulate, "simulate_session", lambda options, _progress: SIMULATED(options))
