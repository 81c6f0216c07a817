"""Surveys of a built reference system by cameras whose every pose is known."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import pytest
from simulated_board import COLOR_CAMERA

from insole_core.calibration.markers.marker_survey import (
    KnownLength,
    MarkerSurvey,
    MarkerView,
    check_survey,
    survey_markers,
)
from insole_core.calibration.markers.reference_file import load_reference_system, positions
from insole_core.errors import CalibrationError
from insole_core.geometry.absolute_orientation import absolute_orientation
from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.transforms import rigid, rotation_about, transform
from insole_core.recording.session import ReferenceSystem
from insole_core.resources import resource_path

NOISE_PX = 0.1
X, Y = np.array([1.0, 0, 0]), np.array([0, 1.0, 0])


@pytest.fixture(scope="module")
def lego() -> ReferenceSystem:
    return load_reference_system(resource_path("reference_systems/lego-20.json"))


@pytest.fixture(scope="module")
def true(lego: ReferenceSystem) -> dict[str, FloatArray]:
    """Every marker is 0.5 mm off, and the achilles face as a whole 4 mm and a degree."""
    generator = np.random.default_rng(2)
    off = rigid(rotation_about(np.array([1.0, -2, 0.5]), 1.0), np.array([2.0, -3, 1.5]))
    return {
        m.id: transform(off if m.face == "achilles" else np.eye(4), np.array(m.position_mm))
        + generator.normal(0, 0.5, 3)
        for m in lego.markers
    }


def poses(seed: int, count: int, tilt_deg: float = 40) -> list[FloatArray]:
    """Poses ``reference2camera`` on a cap of directions, 600 to 900 mm away."""
    generator, found = np.random.default_rng(seed), []
    for _ in range(count):
        tilt = generator.uniform(-tilt_deg, tilt_deg, 2)
        place = np.array([*generator.uniform(-60, 60, 2), generator.uniform(600, 900)])
        found.append(rigid(rotation_about(X, tilt[0]) @ rotation_about(Y, tilt[1]), place))
    return found


def view(
    true: dict[str, FloatArray],
    reference2camera: FloatArray,
    ids: Sequence[str],
    seed: int,
    **of_rig: str,
) -> MarkerView:
    noise = np.random.default_rng(seed).normal(0, NOISE_PX, (len(ids), 2))
    pixels = {
        name: COLOR_CAMERA.project(transform(reference2camera, true[name])) + noise[i]
        for i, name in enumerate(ids)
    }
    return MarkerView(f"picture {seed}", pixels, COLOR_CAMERA, **of_rig)


def ids(system: ReferenceSystem, *faces: str) -> list[str]:
    return [marker.id for marker in system.facing(faces)]


def views_of(
    lego: ReferenceSystem, true: dict[str, FloatArray], count: int, *faces: str
) -> list[MarkerView]:
    seed = 100 * count + len(faces[0])
    return [view(true, p, ids(lego, *faces), seed + i) for i, p in enumerate(poses(seed, count))]


def length(true: dict[str, FloatArray], first: str, second: str) -> KnownLength:
    return KnownLength(first, second, float(np.linalg.norm(true[first] - true[second])))


def judged(
    survey: MarkerSurvey, true: dict[str, FloatArray], names: Sequence[str]
) -> tuple[FloatArray, FloatArray]:
    """Errors (n, 3) of the named markers among each other, mm, and their stated deviations."""
    found = np.array([survey.measured_mm[name] for name in names])
    truth = np.array([true[name] for name in names])
    error = transform(absolute_orientation(found, truth).a2b, found) - truth
    return error, np.array([survey.deviation_mm[name] for name in names])


def assert_as_stated(error: FloatArray, deviation: FloatArray) -> None:
    # The markers' errors go together (a face that is turned), so their mean square spreads widely.
    assert 0.5 < np.sqrt(((error / deviation) ** 2).mean()) < 1.6
    assert np.abs(error / deviation).max() < 4.5


@pytest.mark.slow
def test_both_faces_by_views_that_see_both(
    lego: ReferenceSystem, true: dict[str, FloatArray]
) -> None:
    every = ids(lego, "sole", "achilles")
    pictures = views_of(lego, true, 7, "sole") + views_of(lego, true, 6, "achilles")
    pictures += views_of(lego, true, 5, "sole", "achilles")
    survey = survey_markers(lego, pictures, [length(true, "S1", "S12")])
    assert survey.together == (("sole", "achilles"),)
    assert survey.sentences == ("The faces sole and achilles were measured together.",)
    error, deviation = judged(survey, true, every)
    assert np.abs(error).max() < 0.3
    assert_as_stated(error, deviation)
    shown = sum(len(one.pixels) for one in pictures)
    unknowns = 3 * 20 + 6 * len(pictures)
    expected = NOISE_PX * np.sqrt(2 * (1 - unknowns / (2 * shown)))
    assert survey.rms_px == pytest.approx(expected, rel=0.15)
    assert set(check_survey(lego, survey, 2.0).moved) >= {"A1", "A4", "A7"}


@pytest.mark.slow
def test_both_faces_by_sensors_that_stand_still_to_each_other(
    lego: ReferenceSystem, true: dict[str, FloatArray]
) -> None:
    turn, middle = rotation_about(np.array([1.0, 0.1, 0]), 75), np.array([0.0, 0, 750])
    below2behind = rigid(turn, middle - turn @ middle)
    pictures = [
        view(true, pose, ids(lego, face), 50 * i + j, sensor=sensor, capture=f"{i}")
        for i, below in enumerate(poses(3, 10, 35))
        for j, (sensor, face, pose) in enumerate(
            [("below", "sole", below), ("behind", "achilles", below2behind @ below)]
        )
    ]
    known = [length(true, "S1", "S12")]
    survey = survey_markers(lego, pictures, known)
    assert survey.together == (("sole", "achilles"),)
    error, deviation = judged(survey, true, ids(lego, "sole", "achilles"))
    assert_as_stated(error, deviation)
    apart = [replace(one, sensor="", capture="") for one in pictures]
    assert survey_markers(lego, apart, known).together == (("sole",),)
    few = [one for one in pictures if one.capture in ("0", "1")]
    more = [*few, *views_of(lego, true, 4, "sole")]
    assert survey_markers(lego, more, known).together == (("sole",),)


def test_faces_that_nothing_links(lego: ReferenceSystem, true: dict[str, FloatArray]) -> None:
    pictures = views_of(lego, true, 8, "sole") + views_of(lego, true, 9, "achilles")
    lengths = [length(true, "S1", "S12"), length(true, "A1", "A8")]
    survey = survey_markers(lego, pictures, lengths)
    assert survey.together == (("sole",), ("achilles",))
    (sentence,) = survey.sentences
    assert "their place to each other stays as planned" in sentence
    for face in ("sole", "achilles"):
        assert_as_stated(*judged(survey, true, ids(lego, face)))
        planned = positions(lego.facing((face,)))
        measured = positions(survey.system.facing((face,)))
        lies = absolute_orientation(measured, planned).a2b
        assert np.abs(lies - np.eye(4)).max() < 1e-6
    # Each face is judged among its own markers, so the whole face that stands off is no bump.
    assert check_survey(lego, survey, 2.0).moved == {}


def test_a_face_without_a_length_stays_as_planned(
    lego: ReferenceSystem, true: dict[str, FloatArray]
) -> None:
    pictures = views_of(lego, true, 8, "sole") + views_of(lego, true, 9, "achilles")
    survey = survey_markers(lego, pictures, [length(true, "S1", "S12")])
    assert survey.system.facing(("achilles",)) == lego.facing(("achilles",))
    assert survey.unseen == tuple(ids(lego, "achilles"))
    (sentence,) = survey.sentences
    assert "The face achilles was not measured and stays as planned: no length" in sentence


def test_a_bumped_marker_of_the_second_face_is_named(lego: ReferenceSystem) -> None:
    built = {m.id: np.array(m.position_mm) for m in lego.markers}
    built["A5"] = built["A5"] + [0, 0, 4.0]
    pictures = views_of(lego, built, 6, "sole", "achilles")
    survey = survey_markers(lego, pictures, [length(built, "S1", "A1")])
    assert list(check_survey(lego, survey).moved) == ["A5"]


def test_markers_that_are_not_seen_keep_their_place(
    lego: ReferenceSystem, true: dict[str, FloatArray]
) -> None:
    hidden = [
        replace(one, pixels={k: p for k, p in one.pixels.items() if k != "A8"})
        for one in views_of(lego, true, 6, "sole", "achilles")
    ]
    survey = survey_markers(lego, hidden, [KnownLength("S1", "S12", 312.0)])
    assert survey.unseen == ("A8",)
    assert survey.system.markers[-1] == lego.markers[-1]


def test_surveys_that_cannot_be_made(lego: ReferenceSystem, true: dict[str, FloatArray]) -> None:
    pictures = views_of(lego, true, 4, "sole", "achilles")
    with pytest.raises(CalibrationError, match="2 pictures"):
        survey_markers(lego, pictures[:2], [KnownLength("S1", "S2", 40)])
    with pytest.raises(CalibrationError, match="ends at X9"):
        survey_markers(lego, pictures, [KnownLength("S1", "X9", 40)])
    with pytest.raises(CalibrationError, match="two different markers"):
        survey_markers(lego, pictures, [KnownLength("S1", "S1", 40)])
    apart = views_of(lego, true, 3, "sole") + views_of(lego, true, 4, "achilles")
    with pytest.raises(CalibrationError, match="nothing links these faces"):
        survey_markers(lego, apart, [KnownLength("S1", "A1", 40)])
