from __future__ import annotations

import json
from functools import partial

import pytest
from capture_samples import ASSIGNMENT

from insole_core.errors import UsageError
from insole_core.recording.session import Marker, ReferenceSystem
from insole_studio.acquisition.capture_plan import (
    CaptureStep,
    PlanRequest,
    Shot,
    kept_request,
    make_plan,
    parse_assignment,
    view_faces,
)


def test_sensors_take_turns_by_default() -> None:
    plan = make_plan(ASSIGNMENT)
    assert [[shot.view for shot in step.shots] for step in plan.steps] == [
        ["left"],
        ["right"],
        ["top"],
    ]
    assert plan.frames == 10
    assert plan.serials == ("A1", "B2", "C3")
    assert not any(step.by_hand for step in plan.steps)


def test_simultaneous_is_one_step() -> None:
    (step,) = make_plan(ASSIGNMENT, simultaneous=True).steps
    assert step.shots == tuple(Shot(view, serial, 0.0, view) for view, serial in ASSIGNMENT)


def test_a_sensor_named_twice_is_moved_by_hand() -> None:
    plan = make_plan([("left", "A1"), ("right", "A1"), ("top", "B2")])
    assert [step.by_hand for step in plan.steps] == [False, True, False]


def test_bursts_tilt_to_both_sides() -> None:
    plan = make_plan([("left", "A1"), ("right", "B2")], bursts=3)
    assert plan.steps == (
        CaptureStep((Shot("left", "A1", 0.0, "left"),)),
        CaptureStep((Shot("left_2", "A1", 1.0, "left"),)),
        CaptureStep((Shot("left_3", "A1", -1.0, "left"),)),
        CaptureStep((Shot("right", "B2", 0.0, "right"),)),
        CaptureStep((Shot("right_2", "B2", 1.0, "right"),)),
        CaptureStep((Shot("right_3", "B2", -1.0, "right"),)),
    )


@pytest.mark.parametrize("simultaneous", [False, True])
def test_a_sensor_without_motor_takes_one_series(simultaneous: bool) -> None:
    pairs = [("left", "D1"), ("top", "A1"), ("right", "D2")]
    planned = partial(make_plan, pairs, bursts=3, simultaneous=simultaneous)
    plan = planned(without_motor=("D1", "D2"))
    assert sorted(plan.views) == ["left", "right", "top", "top_2", "top_3"]
    assert {shot.serial for shot in plan.shots if shot.tilt_deg} == {"A1"}
    with pytest.raises(UsageError, match=r"none of these has one: D1, A1, D2\. Capture"):
        planned(without_motor=("A1", "D1", "D2"))
    assert make_plan(pairs, without_motor=("A1", "D1", "D2")).views == ("left", "top", "right")


def test_one_view_can_be_repeated() -> None:
    plan = make_plan(ASSIGNMENT, simultaneous=True, frames=3)
    assert plan.only(["right"]).views == ("right",)
    assert plan.only(["right"]).frames == 3


def test_a_moved_sensor_is_put_back_for_what_is_missing() -> None:
    plan = make_plan([("left", "A1"), ("right", "A1"), ("top", "B2")], bursts=2)
    again = plan.only(["left_2", "right", "right_2", "top"])
    assert [(step.names, step.by_hand) for step in again.steps] == [
        ("left_2", True),
        ("right", True),
        ("right_2", False),
        ("top", False),
    ]


@pytest.mark.parametrize(
    "request_made",
    [
        PlanRequest(ASSIGNMENT, frames=3, simultaneous=True),
        PlanRequest((("left", "A1"), ("right", "A1")), bursts=2, color_frames=4),
        PlanRequest((("left", "D1"), ("top", "A1")), bursts=2, without_motor=("D1",)),
    ],
)
def test_a_request_is_kept(request_made: PlanRequest) -> None:
    kept = json.loads(json.dumps(request_made.as_extra()))
    assert kept_request(kept) == request_made


@pytest.mark.parametrize(
    "damage",
    [
        {"assignment": [["left"]]},
        {"frames": "ten"},
        {"bursts": 0},
        {"speed": 1},
        {"without_motor": 7},
    ],
)
def test_a_request_that_cannot_be_carried_out_is_none(damage: dict[str, object]) -> None:
    (kept,) = PlanRequest(ASSIGNMENT).as_extra().values()
    assert kept_request({"capture_plan": {**kept, **damage}}) is None
    assert kept_request({}) is None


def test_assignment_is_read() -> None:
    assert parse_assignment(["left=A1", "top=B=2"]) == (("left", "A1"), ("top", "B=2"))


@pytest.mark.parametrize("text", ["left", "=A1", "left="])
def test_half_an_assignment_is_refused(text: str) -> None:
    with pytest.raises(UsageError, match="names no view and sensor"):
        parse_assignment([text])


def test_simultaneous_refuses_two_views_of_one_sensor() -> None:
    with pytest.raises(UsageError, match=r"left and top are both given to sensor A1.*one after"):
        make_plan([("left", "A1"), ("right", "B2"), ("top", "A1")], simultaneous=True)


@pytest.mark.parametrize(
    ("assignment", "options", "sentence"),
    [
        ([], {}, "No view was named"),
        ([("left", "A1"), ("left", "B2")], {}, "named twice"),
        ([("Left", "A1")], {}, "cannot name a view"),
        ([(f"v{i}", f"S{i}") for i in range(9)], {}, "9 sensors were named, but at most 8"),
        (ASSIGNMENT, {"frames": 0}, "0 frames were asked for"),
        (ASSIGNMENT, {"color_frames": 1000}, "1 to 999"),
        (ASSIGNMENT, {"bursts": 10}, "1 to 9"),
    ],
)
def test_plans_that_cannot_be_carried_out(
    assignment: list[tuple[str, str]], options: dict[str, int], sentence: str
) -> None:
    with pytest.raises(UsageError, match=sentence):
        make_plan(assignment, **options)


def test_views_see_their_markers() -> None:
    def system(*faces: str) -> ReferenceSystem:
        return ReferenceSystem(
            "own", tuple(Marker(f"{i}", (0, 0, 0), f) for i, f in enumerate(faces))
        )

    usual = system("sole", "sole", "achilles")
    assert view_faces("left", usual) == ("sole",)
    assert view_faces("top_2", usual) == ("achilles",)
    assert view_faces("top", system("a", "b")) == ("a", "b")


def test_views_that_do_not_disturb_each_other_are_taken_at_once_in_the_turn_of_the_first() -> None:
    plan = make_plan([("left", "D1"), ("top", "A1"), ("right", "D2"), ("far", "D1")])
    gathered = plan.gathered(["D1", "D2"])
    names = [[shot.view for shot in step.shots] for step in gathered.steps]
    assert names == [["left", "right"], ["top"], ["far"]]
    assert [step.by_hand for step in gathered.steps] == [False, False, True]
    assert plan.gathered([]) == plan
