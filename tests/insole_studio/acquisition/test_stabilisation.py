from __future__ import annotations

import numpy as np
from hypothesis import example, given
from hypothesis import strategies as st

from insole_studio.acquisition.sensor_port import DepthFrame
from insole_studio.acquisition.stabilisation import Stabilisation, StabilisationRule

RULE = StabilisationRule(frames=3, tolerance=0.05, most_s=1.0)
PERIOD_S = 1 / 30


def frame(valid: int) -> np.ndarray:
    image = np.full((10, 100), 2047, np.uint16)
    image.ravel()[:valid] = 500
    return image


def feed(settling: Stabilisation, counts: list[int]) -> list[int]:
    """Give the numbers of the frames that were used."""
    frames = [frame(valid) for valid in counts]
    number = {id(image): place for place, image in enumerate(frames)}
    used: list[int] = []
    for place, image in enumerate(frames):
        used += [
            number[id(given.image)]
            for given in settling.add(DepthFrame(image, (place + 1) * PERIOD_S, 0))
        ]
    return used


def test_steady_frames_are_all_used() -> None:
    settling = Stabilisation(RULE, 0.0)
    assert feed(settling, [500, 501, 499, 500, 500]) == [0, 1, 2, 3, 4]
    assert settling.settled_after_s == PERIOD_S
    assert not settling.timed_out


def test_frames_before_the_projector_is_steady_are_left_out() -> None:
    settling = Stabilisation(RULE, 0.0)
    assert feed(settling, [10, 200, 400, 500, 505, 500, 500]) == [3, 4, 5, 6]
    assert settling.settled_after_s == 4 * PERIOD_S


def test_frames_from_before_the_switch_are_left_out() -> None:
    settling = Stabilisation(RULE, 2.5 * PERIOD_S)
    assert feed(settling, [500] * 6) == [2, 3, 4, 5]


def test_what_never_settles_is_taken_at_last() -> None:
    settling = Stabilisation(RULE, 0.0)
    used = feed(settling, [100 if number % 2 else 500 for number in range(40)])
    assert settling.timed_out
    assert used == list(range(28, 40))


def test_an_empty_picture_is_not_steady() -> None:
    settling = Stabilisation(RULE, 0.0)
    assert feed(settling, [0] * 20) == []


@given(st.lists(st.integers(0, 1000), max_size=40))
@example([0] * 31)
def test_used_frames_are_consecutive_up_to_the_last(counts: list[int]) -> None:
    used = feed(Stabilisation(RULE, 0.0), counts)
    assert used == list(range(len(counts) - len(used), len(counts)))
