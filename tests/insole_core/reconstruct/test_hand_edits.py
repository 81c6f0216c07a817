"""What somebody corrects by hand, from the value to the pose and the foot."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from insole_core.errors import ReconstructionError
from insole_core.geometry.side import Side
from insole_core.geometry.transforms import inverse, rotation_angle_deg, transform
from insole_core.reconstruct import MarkerObservation, reconstruct
from insole_core.reconstruct.markers.marker_observation import Registration
from insole_core.reconstruct.views.measured_view import (
    MeasuredView,
    measure_as_thesis,
    measure_view,
)
from insole_core.recording.box import Box
from insole_core.recording.hand_edits import NO_VIEW_EDITS, HandEdits, NamedSpot, Pixel, ViewEdits
from insole_core.recording.session import Session, View

NOTHING = NO_VIEW_EDITS


@pytest.fixture(scope="module")
def left(session: Session) -> MeasuredView:
    return measure_view(session.views[0])


@pytest.fixture(scope="module")
def place(left: MeasuredView, session: Session):
    """Register the left view with edits."""
    system = session.manifest.reference_system
    return lambda edits=NOTHING: left.register(system, edits=edits)


def fix_of(registration: Registration, marker: str) -> MarkerObservation:
    return next(fix for fix in registration.fixes if fix.id == marker)


def pixel_of(registration: Registration, marker: str) -> Pixel:
    return fix_of(registration, marker).pixel


def apart_mm(a: Registration, b: Registration) -> float:
    """How far two poses put the foot apart."""
    there = transform(inverse(a.sensor2reference), np.array([0.0, 0.0, 20.0]))
    return float(np.linalg.norm(transform(b.sensor2reference, there) - [0.0, 0.0, 20.0]))


def square(centre: Pixel, half: float = 30.0) -> tuple[Pixel, ...]:
    u, v = centre
    return ((u - half, v - half), (u + half, v - half), (u + half, v + half), (u - half, v + half))


def test_an_excluded_marker_is_seen_but_does_not_count(place) -> None:
    usual, edited = place(), place(NOTHING.with_excluded("S3"))
    fix = fix_of(edited, "S3")
    assert fix.excluded
    assert not fix.used
    assert fix.reprojection_px is not None
    assert len(edited.fixes) == len(usual.fixes)
    assert 0 < apart_mm(usual, edited) < 0.5


def test_names_that_the_search_would_give_change_nothing(place) -> None:
    usual = place()
    edits = NOTHING
    for marker in ("S2", "S9"):
        edits = edits.with_named(NamedSpot(marker, pixel_of(usual, marker)))
    edited = place(edits)
    assert fix_of(edited, "S2").by_hand
    np.testing.assert_allclose(edited.sensor2reference, usual.sensor2reference, atol=1e-6)


def test_two_names_exchanged_are_told_and_put_back(place) -> None:
    usual = place()
    s2, s9 = (pixel_of(usual, marker) for marker in ("S2", "S9"))
    wrong = NOTHING.with_named(NamedSpot("S2", s9)).with_named(NamedSpot("S9", s2))
    exchanged = place(wrong)
    assert not fix_of(exchanged, "S2").used
    assert not fix_of(exchanged, "S9").used
    assert fix_of(exchanged, "S2").reprojection_px > 50  # type: ignore[operator]
    assert apart_mm(usual, exchanged) < 1.0
    right = wrong.with_named(NamedSpot("S2", s2)).with_named(NamedSpot("S9", s9))
    np.testing.assert_allclose(place(right).sensor2reference, usual.sensor2reference, atol=1e-6)
    assert place(right.without_name("S2").without_name("S9")).fixes == usual.fixes


def test_a_marker_pointed_at_beside_its_place_is_excluded_again(place) -> None:
    usual = place()
    u, v = pixel_of(usual, "S5")
    moved = NOTHING.with_named(NamedSpot("S5", (u + 20, v), exact=True))
    off = fix_of(place(moved), "S5")
    assert off.pixel == (u + 20, v)
    assert off.reprojection_px == pytest.approx(20, abs=1)
    assert not off.used
    out = place(moved.with_excluded("S5"))
    assert apart_mm(out, place(NOTHING.with_excluded("S5"))) < 1e-3


def test_a_place_pointed_at_counts_like_the_blue_spot_there(place) -> None:
    usual = place()
    spot = NamedSpot("S7", pixel_of(usual, "S7"), exact=True)
    edited = place(NOTHING.with_named(spot))
    assert fix_of(edited, "S7").residual_mm < 3
    assert apart_mm(usual, edited) < 0.3


def test_four_names_alone_say_where_the_sensor_is(place) -> None:
    usual = place()
    edits = NOTHING
    for marker in ("S1", "S5", "S8", "S12"):
        u, v = pixel_of(usual, marker)
        edits = edits.with_named(NamedSpot(marker, (u + 4, v - 3)))
    edited = place(edits)
    assert len(edited.fixes) == len(usual.fixes)
    np.testing.assert_allclose(edited.sensor2reference, usual.sensor2reference, atol=1e-3)


def test_names_that_no_place_of_the_sensor_explains_never_count(place) -> None:
    usual = place()
    edits = NOTHING
    for marker, other in (("S1", "S12"), ("S5", "S2"), ("S8", "S5"), ("S12", "S9")):
        edits = edits.with_named(NamedSpot(marker, pixel_of(usual, other)))
    try:
        edited = place(edits)
    except ReconstructionError as error:
        assert "markers" in str(error)  # noqa: PT017 - refused is right as well
    else:
        assert not any(fix.used for fix in edited.fixes if fix.by_hand)
        assert apart_mm(usual, edited) < 1.0


def test_nothing_is_found_in_an_ignored_region(place) -> None:
    usual = place()
    edited = place(NOTHING.with_ignored(square(pixel_of(usual, "S4"))))
    assert [fix.id for fix in usual.fixes if fix not in edited.fixes or fix.id == "S4"]
    assert "S4" not in [fix.id for fix in edited.fixes]
    assert apart_mm(usual, edited) < 1.0


def test_a_marker_pointed_at_in_an_ignored_region_counts(place) -> None:
    usual = place()
    at = pixel_of(usual, "S4")
    edits = NOTHING.with_ignored(square(at)).with_named(NamedSpot("S4", at))
    np.testing.assert_allclose(place(edits).sensor2reference, usual.sensor2reference, atol=1e-6)


def test_nothing_is_found_outside_of_the_searched_region(place, left: MeasuredView) -> None:
    usual = place()
    middle = left.view.sensor.color_camera.width / 2
    half = ((0.0, 0.0), (middle, 0.0), (middle, 2000.0), (0.0, 2000.0))
    kept = {fix.id for fix in usual.fixes if fix.pixel[0] < middle}
    assert 4 <= len(kept) < len(usual.fixes)
    edits = replace(NOTHING, searched=half)
    try:
        found = {fix.id for fix in place(edits).fixes}
    except ReconstructionError as error:
        assert "are needed" in str(error)  # noqa: PT017 - either answer is right
    else:
        assert found <= kept


def test_too_few_markers_left(place) -> None:
    usual = place()
    edits = NOTHING
    for fix in usual.fixes[3:]:
        edits = edits.with_excluded(fix.id)
    with pytest.raises(ReconstructionError, match="only 3 of the 12 markers are left"):
        place(edits)


def test_the_thesis_heeds_the_hand_as_well(session: Session) -> None:
    measured = measure_as_thesis(session.views[0])
    system = session.manifest.reference_system
    usual = measured.register(system)
    edited = measured.register(system, edits=NOTHING.with_excluded("S1"))
    assert fix_of(edited, "S1").excluded
    assert rotation_angle_deg(
        usual.sensor2reference[:3, :3].T @ edited.sensor2reference[:3, :3]
    ) == pytest.approx(0, abs=0.5)


def test_the_foot_and_its_warnings_heed_the_hand(session: Session, left: MeasuredView) -> None:
    edits = HandEdits(side=Side.RIGHT).with_view("left", NOTHING.with_excluded("S3"))
    edits = edits.with_view("right", ViewEdits(off=True))
    asked: list[str] = []

    def remembered(view: View) -> MeasuredView:
        asked.append(view.name)
        return left if view.name == "left" else measure_view(view)

    result = reconstruct(replace(session, edits=edits), measure=remembered)
    assert asked == ["left", "top"]
    assert [view.used for view in result.views] == [True, False, True]
    assert result.warnings[0] == "The view right is left out: it was switched off by hand."
    assert "The markers of the view left were corrected by hand: S3 excluded." in result.warnings
    assert "It was set by hand that it is a right foot." in result.warnings


def test_a_volume_set_by_hand_bounds_the_foot(session: Session) -> None:
    box = Box((-70, -60, -40), (70, 60, 160))
    result = reconstruct(replace(session, edits=HandEdits(volume_of_interest=box)), "thesis")
    assert np.ptp(result.mesh.vertices[:, 1]) < 126
    assert "The volume of interest was set by hand." in result.warnings


@pytest.mark.parametrize(("exact", "step"), [(True, 0.0), (False, 0.0), (False, 0.3)])
def test_several_markers_in_one_place_are_refused(place, exact: bool, step: float) -> None:
    u, v = pixel_of(place(), "S3")
    spots = tuple(NamedSpot(f"S{number}", (u + step * number, v), exact) for number in range(1, 6))
    with pytest.raises(ReconstructionError, match=r"in one place|cannot be seen at"):
        place(replace(NOTHING, named=spots))
