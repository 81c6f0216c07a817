from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import pytest

from insole_core.geometry.arrays import RawArray
from insole_core.sensing.frames import average_raw, mean_raw, median_raw


def stack(*readings: list[int]) -> RawArray:
    """Frames of one row: one list per pixel, over time."""
    return np.array(readings, dtype=np.uint16).T[:, None, :]


def test_median_of_what_was_measured() -> None:
    frames = stack([700, 702, 2047, 701, 950], [700, 701, 702, 703, 2047])
    np.testing.assert_array_equal(median_raw(frames), [[701.5, 701.5]])


def test_a_single_frame_is_its_own_median() -> None:
    np.testing.assert_array_equal(median_raw(stack([700], [2047])), [[700, np.nan]])


@pytest.mark.parametrize("average", [median_raw, mean_raw])
def test_a_pixel_that_mostly_failed_is_no_reading(average: object) -> None:
    assert callable(average)
    frames = stack([700, 2047, 2047, 2047], [700, 700, 2047, 2047], [2047] * 4)
    np.testing.assert_array_equal(average(frames), [[np.nan, 700, np.nan]])


def test_mean_keeps_fractions_and_drops_outliers() -> None:
    frames = stack([700, 701, 701, 701, 900, 2047], [650, 651, 650, 651, 650, 651])
    np.testing.assert_allclose(mean_raw(frames), [[700.75, 650.5]])


def test_mean_reads_each_frame_once_and_lets_it_go() -> None:
    alive: list[int] = []

    class Frame(np.ndarray):
        def __del__(self) -> None:
            if self.base is None:
                alive.remove(int(self[0, 0]) - 700)

    def frames() -> Iterator[RawArray]:
        for index in range(40):
            frame = np.full((2, 2), 700 + index, dtype=np.uint16).view(Frame).copy()
            alive.append(index)
            assert len(alive) <= 12
            yield frame

    assert mean_raw(frames()).shape == (2, 2)


def still(count: int) -> list[np.ndarray]:
    rng = np.random.default_rng(4)
    return [np.rint(700 + rng.normal(0, 0.5, (64, 96))).astype(np.uint16) for _ in range(count)]


def test_the_variance_is_that_of_the_mean() -> None:
    average = average_raw(still(40))
    # Rounding to whole numbers adds 1/12.
    assert np.median(average.variance) == pytest.approx((0.25 + 1 / 12) / 40, rel=0.1)
    assert average.moved == ()
    assert average.motion_raw < 0.2


def test_a_frame_in_which_something_moved_is_left_out() -> None:
    frames = still(12)
    frames[5][16:48, 16:64] += 3
    average = average_raw(frames)
    assert average.moved == (5,)
    assert average.motion_raw == pytest.approx(3.0, abs=0.2)
    np.testing.assert_allclose(average.raw[20:40, 20:60].mean(), 700, atol=0.05)


def tilted(shift_px: float, rng: np.random.Generator) -> RawArray:
    """A ball before a wall, and noise; the ball shifted along u."""
    v, u = np.mgrid[:192, :256].astype(float)
    height = 60**2 - (u - 128 - shift_px) ** 2 - (v - 96) ** 2
    ball = 760 - 0.8 * (60 - np.sqrt(np.maximum(height, 0)))
    raw = np.where(height > 0, ball, 500.0) + rng.normal(0, 0.5, u.shape)
    return np.rint(raw).astype(np.uint16)


def test_a_shift_sideways_is_found_and_measured() -> None:
    rng = np.random.default_rng(7)
    shifts = [0.0] * 12
    shifts[7] = 3.0
    average = average_raw(tilted(shift, rng) for shift in shifts)
    assert average.moved == (7,)
    assert average.sideways_px == pytest.approx(3.0, abs=0.7)


@pytest.mark.parametrize(("along_u_px", "nearer_raw"), [(3.0, 0.0), (2.0, -2.0), (0.0, 3.0)])
def test_the_motion_is_that_of_the_thing_not_of_its_borders(
    along_u_px: float, nearer_raw: float
) -> None:
    rng = np.random.default_rng(9)
    frames = [tilted(0.0, rng) for _ in range(9)]
    moved = tilted(along_u_px, rng)
    moved[moved > 600] += np.array(nearer_raw).astype(np.int16).astype(np.uint16)
    motion = average_raw([*frames, moved]).motion
    assert motion is not None
    assert motion.along_u_px == pytest.approx(along_u_px, abs=0.3)
    assert motion.along_v_px == pytest.approx(0.0, abs=0.2)
    assert motion.nearer_raw == pytest.approx(nearer_raw, abs=0.3)
    assert motion.at_raw == pytest.approx(750, abs=10)


def test_what_did_not_move_as_a_whole_has_no_one_motion() -> None:
    rng = np.random.default_rng(10)
    frames = [tilted(0.0, rng) for _ in range(9)]
    torn = tilted(0.0, rng)
    torn[:96] += 5
    torn[96:] -= 5
    average = average_raw([*frames, torn])
    assert average.moved == (9,)
    assert average.motion is None


def test_noise_is_no_shift() -> None:
    rng = np.random.default_rng(8)
    average = average_raw(tilted(0.0, rng) for _ in range(30))
    assert average.moved == ()
    assert average.sideways_px < 0.6
