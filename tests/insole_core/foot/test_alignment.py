"""A foot is turned by its landmarks, and back."""

from __future__ import annotations

import numpy as np
import pytest

from insole_core.errors import InputError
from insole_core.foot.alignment import PoseAngles, levelled, pose_angles, quarter_turned, turned
from insole_core.foot.foot import Foot
from insole_core.foot.foot_placement import place_foot
from insole_core.foot.landmarks import Landmark, find_landmarks
from insole_core.geometry.side import Side
from insole_core.geometry.transforms import inverse, transform
from insole_core.simulate.foot_model import build_foot
from insole_core.simulate.foot_shape import FootShape


@pytest.fixture(scope="module", params=list(Side))
def foot(request: pytest.FixtureRequest) -> Foot:
    shape = FootShape(length_mm=250, ball_width_mm=94, side=request.param)
    mesh = build_foot(shape, np.random.default_rng(3), cell_mm=4.0).mesh
    return place_foot(mesh, request.param, frame="reference")


def carried(foot: Foot, marks: dict[str, Landmark], anew: Foot) -> dict[str, Landmark]:
    step = anew.source2insole @ inverse(foot.source2insole)
    return {
        name: Landmark(transform(step, mark.point[None])[0], mark.confidence)
        for name, mark in marks.items()
    }


@pytest.mark.parametrize("angles", [
    PoseAngles(), PoseAngles(pitch_deg=5), PoseAngles(roll_deg=-8), PoseAngles(yaw_deg=4),
    PoseAngles(3, 6, -5),
])  # fmt: skip
def test_the_foot_lies_at_the_angles_that_are_asked(foot: Foot, angles: PoseAngles) -> None:
    marks = find_landmarks(foot)
    anew = turned(foot, marks, angles)
    found = pose_angles(anew, carried(foot, marks, anew))
    assert vars(found) == pytest.approx(vars(angles), abs=1e-9)
    low, high = anew.mesh.bounds_mm
    assert low[2] == pytest.approx(0.0, abs=1e-9)
    assert high[1] == pytest.approx(anew.length_mm, abs=8.0)


def test_positive_angles_raise_what_they_say(foot: Foot) -> None:
    marks = find_landmarks(foot)
    level = carried(foot, marks, turned(foot, marks, PoseAngles()))
    rolled = carried(foot, marks, turned(foot, marks, PoseAngles(roll_deg=6)))
    pitched = carried(foot, marks, turned(foot, marks, PoseAngles(pitch_deg=6)))
    yawed = carried(foot, marks, turned(foot, marks, PoseAngles(yaw_deg=6)))

    def rise(of: dict[str, Landmark], a: str, b: str) -> float:
        return float((of[a].point - of[b].point)[2])

    first, fifth, heel = "metatarsal_head_1", "metatarsal_head_5", "heel_centre"
    assert rise(level, first, fifth) == pytest.approx(0.0, abs=1e-9)
    assert rise(level, first, heel) == pytest.approx(0.0, abs=1e-9)
    assert rise(rolled, first, fifth) > 5
    assert rise(pitched, first, heel) > 10
    toe = (yawed["toe_tip_2"].point - yawed[heel].point)[0] * foot.side.medial_sign
    assert toe > 15


def test_landmarks_in_an_impossible_order_are_refused(foot: Foot) -> None:
    marks = dict(find_landmarks(foot))
    swapped = marks | {
        "metatarsal_head_1": marks["metatarsal_head_5"],
        "metatarsal_head_5": marks["metatarsal_head_1"],
    }
    with pytest.raises(InputError, match="order that no foot has"):
        turned(foot, swapped, PoseAngles())
    with pytest.raises(InputError, match="drag them to their places"):
        turned(foot, marks | {"toe_tip_2": marks["pternion"]}, PoseAngles())
    with pytest.raises(InputError, match="find"):
        turned(foot, marks | {"metatarsal_head_5": marks["metatarsal_head_1"]}, PoseAngles())


@pytest.mark.parametrize("axis", [0, 1, 2])
def test_four_right_angles_bring_a_foot_back(foot, axis):
    turning = foot
    for quarter in range(4):
        turning = quarter_turned(turning, axis, 1)
        if quarter < 3:
            assert np.abs(turning.mesh.vertices - foot.mesh.vertices).max() > 50
    shift = turning.mesh.vertices - foot.mesh.vertices
    assert np.ptp(shift, axis=0) == pytest.approx(0, abs=1e-9)  # the same pose
    assert shift[:, 2] == pytest.approx(0, abs=1e-9)


def test_a_foot_stood_on_its_toes_is_mended_by_one_right_angle_and_levelling(foot):
    tipped = quarter_turned(foot, 0, -1)
    assert np.ptp(tipped.mesh.vertices[:, 2]) == pytest.approx(np.ptp(foot.mesh.vertices[:, 1]))
    mended = levelled(quarter_turned(tipped, 0, 1))
    assert mended.length_mm == pytest.approx(foot.length_mm, abs=0.5)
    assert np.abs(mended.mesh.vertices - foot.mesh.vertices).max() < 2.0
    carried = transform(mended.source2insole @ inverse(foot.source2insole), foot.mesh.vertices)
    assert carried == pytest.approx(mended.mesh.vertices, abs=1e-9)
