"""A pose that is not good enough is refused with its markers; what is odd is never silent."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from insole_core.geometry.arrays import ByteArray
from insole_core.geometry.transforms import rotation_angle_deg
from insole_core.reconstruct import RegistrationLimits, reconstruct
from insole_core.reconstruct.poses.pose_quality import PoseRefusedError
from insole_core.reconstruct.views.measured_view import MeasuredView, measure_view
from insole_core.recording.session import Marker, ReferenceSystem, Session, View


@pytest.fixture(scope="module")
def left(session: Session) -> MeasuredView:
    return measure_view(session.views[0])


def moved(system: ReferenceSystem, places: dict[str, tuple[float, ...]]) -> ReferenceSystem:
    """The system as if some markers stood elsewhere than they do."""

    def at(marker: Marker) -> Marker:
        x, y, z = places.get(marker.id, marker.position_mm)
        return replace(marker, position_mm=(x, y, z))

    return replace(system, markers=tuple(at(marker) for marker in system.markers))


def bumped(system: ReferenceSystem, marker: str, by_mm: float) -> ReferenceSystem:
    (place,) = (m.position_mm for m in system.markers if m.id == marker)
    return moved(system, {marker: (place[0] + by_mm, place[1], place[2])})


@pytest.mark.parametrize(
    ("limits", "said"),
    [
        (RegistrationLimits(residual_mm=0.01), r"0\.\d mm from the reference system on average"),
        (RegistrationLimits(reprojection_px=0.01), r"px apart in the colour image"),
        (RegistrationLimits(displacement_mm=0.01), r"mm uncertain at the foot"),
        (RegistrationLimits(turn_deviation_deg=0.01), r"degrees uncertain in direction"),
    ],
)
def test_every_limit_refuses_with_the_worst_markers(
    session: Session, left: MeasuredView, limits: RegistrationLimits, said: str
) -> None:
    with pytest.raises(PoseRefusedError, match=said) as refused:
        left.register(session.manifest.reference_system, limits)
    assert "worst: S" in str(refused.value)
    assert len(refused.value.registration.fixes) == 12


@pytest.mark.slow
def test_a_refused_view_is_reported_with_its_markers(session: Session) -> None:
    result = reconstruct(session, limits=RegistrationLimits(displacement_mm=0.7))
    left, _, top = result.views
    assert left.used
    assert not top.used
    assert "mm uncertain at the foot" in top.reason
    assert len(top.fixes) == 8
    assert top.displacement_mm is not None
    assert top.displacement_mm > 0.7


@pytest.mark.slow
def test_a_bumped_marker_is_named_and_does_not_count(session: Session, left: MeasuredView) -> None:
    system = bumped(session.manifest.reference_system, "S6", 9.0)
    off = replace(session, manifest=replace(session.manifest, reference_system=system))
    result = reconstruct(off)
    (warning,) = result.warnings
    assert warning.startswith("The marker S6 is seen 9 mm, 9 mm from its place by left, right")
    pose, was = result.views[0].sensor2reference, left.register(session.manifest.reference_system)
    assert pose is not None
    assert rotation_angle_deg(pose[:3, :3].T @ was.sensor2reference[:3, :3]) < 0.1


def only_these(view: View, pixels: list[tuple[float, float]]) -> View:
    """The view with a grey spot on all markers but those."""

    def cover(color: ByteArray) -> ByteArray:
        blue = np.argwhere(color[..., 2] > np.maximum(color[..., 0], color[..., 1]) + 30)
        apart = np.linalg.norm(blue[:, None, ::-1] - np.array(pixels), axis=2).min(1)
        picture = color.copy()
        picture[tuple(blue[apart > 20].T)] = 26
        return picture

    return replace(view, read_color=lambda index: cover(view.read_color(index)))


@pytest.mark.parametrize("kept", [[0, 2, 3, 4, 6, 7], [0, 2, 4, 6, 7]])
def test_one_of_a_few_markers_that_strays_a_little_does_not_cost_the_view(
    session: Session, kept: list[int]
) -> None:
    system, view = session.manifest.reference_system, session.views[2]
    whole = measure_view(view).register(system)
    fixes = [whole.fixes[index] for index in kept]
    few = measure_view(only_these(view, [fix.pixel for fix in fixes]))
    found = few.register(bumped(system, fixes[0].id, 1.2))
    assert [fix.id for fix in found.fixes] == [fix.id for fix in fixes]
    assert found.camera_pose is not None
    assert found.camera_pose.weights[0] < 0.1
    turn = found.sensor2reference[:3, :3].T @ whole.sensor2reference[:3, :3]
    # Leaving out the others alone turns it by half of that: 640 × 480 px do not hold more.
    assert rotation_angle_deg(turn) < found.camera_pose.turn_deviation_deg < 0.8
    assert whole.displacement_mm is not None
    assert found.displacement_mm is not None
    assert found.displacement_mm > whole.displacement_mm


@pytest.mark.parametrize("seed", range(3))
def test_no_marker_is_lost_where_all_stray_a_little(
    session: Session, left: MeasuredView, seed: int
) -> None:
    system = session.manifest.reference_system
    rng = np.random.default_rng(seed)
    strays = {
        marker.id: tuple(np.add(marker.position_mm, [*rng.normal(0, 0.2, 2), 0.0]))
        for marker in system.markers
    }
    assert all(fix.used for fix in left.register(moved(system, strays)).fixes)


def test_two_markers_built_into_each_others_place_do_not_count(
    session: Session, left: MeasuredView
) -> None:
    system = session.manifest.reference_system
    places = {marker.id: marker.position_mm for marker in system.markers}
    swapped = moved(system, {"S2": places["S9"], "S9": places["S2"]})
    registration, usual = left.register(swapped), left.register(system)
    np.testing.assert_allclose(
        registration.sensor2reference, usual.sensor2reference, atol=1e-6
    )  # both look alike: the names are exchanged with the places


def test_a_system_bent_out_of_shape_is_refused(session: Session, left: MeasuredView) -> None:
    system = session.manifest.reference_system
    rng = np.random.default_rng(2)
    places = {
        marker.id: tuple(np.add(marker.position_mm, rng.normal(0, 3.0, 3)))
        for marker in system.markers
    }
    with pytest.raises(PoseRefusedError, match=r"worst: S\d+ \d\.\d px"):
        left.register(moved(system, places))


def test_the_displacement_grows_with_the_distance_from_the_markers(
    session: Session, left: MeasuredView
) -> None:
    pose = left.register(session.manifest.reference_system).camera_pose
    assert pose is not None
    away = np.array([0.0, 0.0, 300.0])
    near, far = pose.displacement_mm(pose.center), pose.displacement_mm(pose.center + away)
    assert 0 < near < far
    lever_mm = 300 * np.radians(pose.turn_deviation_deg)
    assert far < np.hypot(near, lever_mm) + near
