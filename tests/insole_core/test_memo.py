from __future__ import annotations

import gc
import weakref
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, replace
from threading import Barrier

import numpy as np
from scipy.sparse import csr_matrix

from insole_core.foot.foot import Foot
from insole_core.foot.landmarks import find_landmarks
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.surface.contact import sole_surface
from insole_core.memo import Memo, array_bytes
from tests.patience import PATIENCE_S


def counted(made: list[str], name: str) -> Callable[[], str]:
    def make() -> str:
        made.append(name)
        return f"{name} {len(made)}"

    return make


def test_what_is_kept_is_not_made_again() -> None:
    memo, made = Memo(2), list[str]()
    first = memo.get("outline", 1, counted(made, "a"))
    assert memo.get("outline", 1, counted(made, "b")) is first
    assert memo.known("outline", 1) is first
    assert memo.known("outline", 2) is None
    assert memo.known("sole", 1) is None
    assert made == ["a"]


def test_what_was_not_asked_for_longest_goes_first_and_each_kind_has_its_own_room() -> None:
    memo, made = Memo(2), list[str]()
    for key in ("a", "b", "a", "c"):
        memo.get("outline", key, counted(made, key))
    memo.get("sole", "d", counted(made, "d"))
    assert [memo.known("outline", key) is not None for key in "abc"] == [True, False, True]
    assert memo.known("sole", "d") is not None


@dataclass
class Result:
    parts: tuple[np.ndarray, ...]
    matrix: csr_matrix


def test_large_results_leave_room_for_fewer_but_never_for_less_than_the_least() -> None:
    memo, zeros = Memo(8, most_bytes=3000, least=2), np.zeros(100)
    assert array_bytes(Result((zeros, zeros), csr_matrix(np.eye(10)))) == 800 + 80 + 4 * 21
    for key in range(6):
        memo.get("small", key, lambda: np.zeros(100))
        memo.get("large", key, lambda: {"grid": [np.zeros(1000)]})
    assert [memo.known("small", key) is not None for key in range(6)] == [False] * 3 + [True] * 3
    assert [memo.known("large", key) is not None for key in range(6)] == [False] * 4 + [True] * 2


def test_threads_that_ask_at_once_get_the_same_object() -> None:
    memo, together = Memo(2), Barrier(8)

    def make() -> list[int]:
        together.wait(PATIENCE_S)  # all are at it before the first one is done
        return []

    with ThreadPoolExecutor(8) as pool:
        results = [f.result() for f in [pool.submit(memo.get, "x", 1, make) for _ in range(8)]]
    assert len({id(result) for result in results}) == 1


def test_what_was_derived_from_a_foot_goes_with_it(left_foot: Foot) -> None:
    foot = replace(left_foot)
    marks = find_landmarks(foot)
    assert find_landmarks(foot) is marks
    assert find_landmarks(replace(left_foot)) is not marks  # another foot, as far as anyone knows
    sole = weakref.ref(sole_surface(foot, InsoleDesign(foot.side, grid_mm=2.0)))
    assert sole() is sole_surface(foot, InsoleDesign(foot.side, grid_mm=2.0))
    del foot
    gc.collect()
    assert sole() is None
