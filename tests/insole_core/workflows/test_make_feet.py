"""Both feet of one capture: each lands on its side, and what contradicts the sides is refused."""

from __future__ import annotations

from dataclasses import replace
from itertools import groupby
from pathlib import Path

import numpy as np
import pytest

from insole_core.errors import InsoleError, UsageError
from insole_core.geometry.side import BOTH, Side
from insole_core.progress import Progress
from insole_core.recording.box import Box
from insole_core.recording.hand_edits import HandEdits, ViewEdits
from insole_core.recording.session import FootPlace
from insole_core.workflows.make_feet import (
    DoubtfulFeetError,
    ReconstructedFoot,
    make_feet,
    reconstruct_feet,
)
from insole_core.workflows.make_foot import MeasuredSession, measure_session, open_session

BOTH_SMALL = Path(__file__).parents[2] / "data" / "sessions" / "both_small.zip"
Triple = tuple[float, float, float]
LENGTHS_MM = {Side.LEFT: 258.2, Side.RIGHT: 243.4}
"""Of the simulated feet, which differ so that they cannot be exchanged unseen."""


@pytest.fixture(scope="module")
def opened() -> MeasuredSession:
    return measure_session(BOTH_SMALL)


def with_places(opened: MeasuredSession, *places: FootPlace) -> MeasuredSession:
    """Say that the feet are elsewhere than they are."""
    manifest = opened.session.manifest
    system = replace(manifest.reference_system, feet=places)
    session = replace(opened.session, manifest=replace(manifest, reference_system=system))
    return replace(opened, session=session)


def places_of(opened: MeasuredSession) -> tuple[FootPlace, FootPlace]:
    left, right = opened.session.manifest.reference_system.feet
    return left, right


@pytest.mark.slow
def test_each_foot_lands_on_its_side(opened: MeasuredSession) -> None:
    feet = make_feet(opened)
    assert [made.scan.foot.side for made in feet] == [Side.LEFT, Side.RIGHT]
    for made in feet:
        foot = made.scan.foot
        assert abs(foot.length_mm - LENGTHS_MM[foot.side]) < 3
        assert abs(np.median(made.mesh.vertices[:, 0])) < 30  # in its own reference frame
        assert made.scan.warnings == ()


@pytest.fixture(scope="module")
def steps() -> list[tuple[float, str]]:
    """What is said while the feet are reconstructed."""
    return []


@pytest.fixture(scope="module")
def of_both(
    opened: MeasuredSession, steps: list[tuple[float, str]]
) -> tuple[ReconstructedFoot, ...]:
    return reconstruct_feet(
        opened, progress=Progress(lambda *step: steps.append(step)), method="thesis"
    )


def test_one_foot_of_both_is_as_that_of_a_session_of_its_own(
    opened: MeasuredSession, of_both: tuple[ReconstructedFoot, ...]
) -> None:
    alone = opened.of_foot(Side.RIGHT)
    assert alone.session.manifest.side is Side.RIGHT
    (made,) = reconstruct_feet(alone, method="thesis")
    right = of_both[1]
    assert made.side is right.side is Side.RIGHT
    ends, ends_of_both = (one.result.mesh.vertices.max(0) for one in (made, right))
    np.testing.assert_allclose(ends, ends_of_both, atol=0.1)
    # Its poses are found anew in the foot's own frame, instead of once for both.
    for one, shared in zip(made.result.views, right.result.views, strict=True):
        assert one.sensor2reference is not None
        assert shared.sensor2reference is not None
        np.testing.assert_allclose(one.sensor2reference, shared.sensor2reference, atol=1e-4)


@pytest.mark.usefixtures("of_both")
def test_progress_names_the_foot(steps: list[tuple[float, str]]) -> None:
    about = [foot for foot, _ in groupby(text.split(": ")[0] for _, text in steps)]
    assert about == ["The left foot", "The right foot"]


def test_a_session_of_both_asks_which_foot_is_meant() -> None:
    with pytest.raises(UsageError, match=r"both feet; say which one, with --side left or --side"):
        open_session(BOTH_SMALL).of_foot(None)


def test_a_session_of_both_is_not_taken_as_that_of_one(opened: MeasuredSession) -> None:
    with pytest.raises(AssertionError, match="the place of each says which one it is"):
        opened.taken_as(Side.LEFT)


def test_a_missing_foot_is_named(opened: MeasuredSession) -> None:
    left, right = places_of(opened)
    nowhere = replace(right, origin_mm=(400.0, 0.0, 0.0))
    with pytest.raises(InsoleError, match=r"both feet, but no right foot is in its place; capture"):
        reconstruct_feet(with_places(opened, left, nowhere), method="thesis")


def test_exchanged_feet_are_refused(opened: MeasuredSession) -> None:
    left, right = places_of(opened)
    exchanged = with_places(
        opened,
        replace(left, origin_mm=right.origin_mm),
        replace(right, origin_mm=left.origin_mm),
    )
    with pytest.raises(DoubtfulFeetError, match="The feet look exchanged: a right one is in the"):
        reconstruct_feet(exchanged, method="thesis")


def test_two_left_feet_are_refused(opened: MeasuredSession) -> None:
    left, right = places_of(opened)
    twice = with_places(opened, left, replace(right, origin_mm=left.origin_mm))
    with pytest.raises(
        DoubtfulFeetError, match="place of the right foot the shape looks like a le"
    ):
        reconstruct_feet(twice, method="thesis")


def test_a_foot_that_reaches_out_of_its_volume_is_refused(opened: MeasuredSession) -> None:
    left, right = places_of(opened)
    beside = replace(left, origin_mm=(left.origin_mm[0] - 40, 0.0, 0.0))
    with pytest.raises(DoubtfulFeetError, match="The left foot reaches out of its volume"):
        reconstruct_feet(with_places(opened, beside, right), method="thesis")


def with_volume_of_left(
    opened: MeasuredSession, low_mm: Triple, high_mm: Triple
) -> MeasuredSession:
    left, right = places_of(opened)
    return with_places(opened, replace(left, volume_of_interest=Box(low_mm, high_mm)), right)


@pytest.mark.parametrize(
    ("low_mm", "high_mm"),
    [
        pytest.param((-70.0, -150.0, -25.0), (70.0, 20.0, 150.0), id="without toes"),
        pytest.param((-70.0, -20.0, -25.0), (70.0, 150.0, 150.0), id="without heel"),
        pytest.param((-70.0, -150.0, 20.0), (70.0, 150.0, 150.0), id="without sole"),
    ],
)
def test_a_foot_that_its_volume_cuts_is_refused(
    opened: MeasuredSession, low_mm: Triple, high_mm: Triple
) -> None:
    alone = with_volume_of_left(opened, low_mm, high_mm).of_foot(Side.LEFT)
    with pytest.raises(DoubtfulFeetError, match="The left foot reaches out of its volume"):
        reconstruct_feet(alone, method="thesis")


def test_a_foot_that_its_volume_cuts_is_refused_beside_the_other_one(
    opened: MeasuredSession,
) -> None:
    cut = with_volume_of_left(opened, (-70.0, -150.0, -25.0), (70.0, 20.0, 150.0))
    with pytest.raises(DoubtfulFeetError, match="The left foot reaches out of its volume"):
        reconstruct_feet(cut, method="thesis")


def test_the_volume_of_one_foot_is_corrected_alone(opened: MeasuredSession) -> None:
    box = Box((-60.0, -150.0, -25.0), (60.0, 150.0, 100.0))
    edits = HandEdits({"left": ViewEdits(excluded=("LS1",))}).with_volume(Side.RIGHT, box)
    left, right = opened.with_edits(edits).feet
    assert right.box == box
    assert left.box == places_of(opened)[0].volume_of_interest
    assert left.edits.of("left") == right.edits.of("left") == edits.of("left")
    assert opened.session.manifest.side == BOTH
