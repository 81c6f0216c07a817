from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from insole_core.geometry.side import Side
from insole_core.reconstruct.volume import volume_of_interest
from insole_core.recording.box import Box
from insole_core.recording.reader import read_session
from insole_core.recording.session import Session
from insole_core.sensing.disparity import FactoryDisparity
from insole_studio.acquisition.guidance import (
    FrameSnapshot,
    Guidance,
    Hint,
    HintKind,
    centre_depth_mm,
    depth_colors,
    guide,
)

DISPARITY = FactoryDisparity(1200.0, 1.042, 75.0, 200.0)


@pytest.fixture(scope="module")
def session() -> Session:
    return read_session(Path(__file__).parents[2] / "data" / "sessions" / "left_small.zip")


def seen(
    session: Session,
    *,
    nearer_raw: int = 0,
    moved_raw: int = 0,
    light: float = 1.0,
    volume: Box | None = None,
) -> Guidance:
    view = session.views[0]
    depth = view.read_depth(0)
    measured = depth < 2047
    now = np.where(measured, depth - nearer_raw, depth).astype(np.uint16)
    before = np.where(measured, now - moved_raw, now).astype(np.uint16)
    color = np.clip(view.read_color(0) * light, 0, 255).astype(np.uint8)
    system = session.manifest.reference_system
    place = volume or volume_of_interest(session)
    return guide(view.sensor, system, place, FrameSnapshot(now, before, color))


def test_a_good_view_has_no_hints(session: Session) -> None:
    found = seen(session)
    assert found.hints == ()
    assert found.markers_seen == found.markers_wanted == 12
    assert 0.01 < found.valid_share < 0.3


def test_a_sensor_that_stands_too_near(session: Session) -> None:
    found = seen(session, nearer_raw=250)
    assert found.hints[0].kind is HintKind.TOO_NEAR


def test_a_foot_that_is_elsewhere(session: Session) -> None:
    away = Box((-70, -150, 400), (70, 150, 600))
    assert Hint(HintKind.NO_FOOT) in seen(session, volume=away).hints


def test_motion_and_darkness(session: Session) -> None:
    assert Hint(HintKind.MOVING) in seen(session, moved_raw=20).hints
    assert Hint(HintKind.TOO_DARK) in seen(session, light=0.15).hints


def test_markers_that_are_not_there(session: Session) -> None:
    view = session.views[0]
    depth = view.read_depth(0)
    grey = np.full((512, 640, 3), 120, np.uint8)
    system = session.manifest.reference_system
    found = guide(view.sensor, system, Box((0, 0, 0), (1, 1, 1)), FrameSnapshot(depth, depth, grey))
    assert found.markers_seen == 0
    assert found.hints[0] == Hint(HintKind.NO_MARKERS)


def test_an_empty_view(session: Session) -> None:
    view = session.views[0]
    nothing = np.full((480, 640), 2047, np.uint16)
    volume = volume_of_interest(session)
    snapshot = FrameSnapshot(nothing, nothing, view.read_color(0))
    found = guide(view.sensor, session.manifest.reference_system, volume, snapshot)
    assert found.valid_share == 0
    assert found.hints[0] == Hint(HintKind.NOTHING_MEASURED)


def test_the_centre_is_the_median_of_the_middle() -> None:
    depth = np.full((480, 640), 2047, np.uint16)
    assert centre_depth_mm(DISPARITY, depth) is None
    depth[235:245, 315:325] = 744
    assert centre_depth_mm(DISPARITY, depth) == pytest.approx(1000.4, abs=1)


def test_colours_grow_with_depth_and_grey_is_nothing() -> None:
    colors = depth_colors(DISPARITY)
    assert colors.shape == (2048, 3)
    assert tuple(colors[2047]) == (48, 48, 48)
    assert tuple(colors[100]) == (68, 1, 84)
    assert tuple(colors[1000]) == (253, 231, 37)


@pytest.fixture(scope="module")
def session_of_both() -> Session:
    return read_session(Path(__file__).parents[2] / "data" / "sessions" / "both_small.zip")


def seen_of_both(session: Session, hidden: slice) -> Guidance:
    """Look at both feet with some columns of the depth image covered."""
    view = session.views[0]
    depth = view.read_depth(0)
    depth[:, hidden] = 2047
    system, place = session.manifest.reference_system, volume_of_interest(session)
    return guide(view.sensor, system, place, FrameSnapshot(depth, depth, view.read_color(0)))


@pytest.mark.parametrize(
    ("hidden", "kinds"),
    [
        (slice(0), []),
        (slice(-300, None), [(HintKind.FOOT_MISSING, Side.RIGHT)]),
        (slice(-260, None), [(HintKind.FOOT_HIDDEN, Side.RIGHT)]),
    ],
)
def test_a_foot_that_is_missing_or_hidden_by_the_other_is_named(
    session_of_both: Session, hidden: slice, kinds: list[tuple[HintKind, Side]]
) -> None:
    found = seen_of_both(session_of_both, hidden)
    of_feet = [(hint.kind, hint.side) for hint in found.hints if hint.side is not None]
    assert of_feet == kinds
