from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from insole_core.geometry.side import Side
from insole_studio.scene.view_camera import (
    MAX_ELEVATION_DEG,
    Preset,
    Subject,
    ViewCamera,
    fitted,
    look,
)

SIZE = (800, 600)
ANGLES = st.floats(-400, 400)
PIXELS = st.tuples(st.floats(0, 800), st.floats(0, 600))


@pytest.mark.parametrize("side", list(Side))
@pytest.mark.parametrize("subject", list(Subject))
def test_medial_looks_at_the_side_of_the_big_toe(side: Side, subject: Subject) -> None:
    seen = look(ViewCamera(Preset.MEDIAL), subject, side, SIZE)
    assert seen.back == pytest.approx([side.medial_sign, 0, 0])
    assert seen.up == pytest.approx([0, 0, 1])
    lateral = look(ViewCamera(Preset.LATERAL), subject, side, SIZE)
    assert lateral.back == pytest.approx([-side.medial_sign, 0, 0])


def test_plantar_sees_the_sole_from_below_and_the_insole_from_above_toes_up() -> None:
    foot = look(ViewCamera(Preset.PLANTAR), Subject.FOOT, Side.LEFT, SIZE)
    insole = look(ViewCamera(Preset.PLANTAR), Subject.INSOLE, Side.LEFT, SIZE)
    assert foot.back == pytest.approx([0, 0, -1])
    assert insole.back == pytest.approx([0, 0, 1])
    assert foot.up == pytest.approx([0, 1, 0])
    assert insole.up == pytest.approx([0, 1, 0])


def test_posterior_looks_from_the_heel() -> None:
    assert look(ViewCamera(Preset.POSTERIOR), Subject.FOOT, Side.LEFT, SIZE).back == pytest.approx(
        [0, -1, 0]
    )


@given(st.sampled_from(Preset), st.sampled_from(Subject), st.sampled_from(Side), ANGLES, ANGLES)
def test_every_look_is_right_handed(
    preset: Preset, subject: Subject, side: Side, azimuth: float, elevation: float
) -> None:
    seen = look(ViewCamera(preset).orbited(azimuth, elevation), subject, side, SIZE)
    pose = np.stack([seen.right, seen.up, seen.back])
    assert pose @ pose.T == pytest.approx(np.eye(3), abs=1e-9)
    assert np.linalg.det(pose) == pytest.approx(1.0)


@given(ANGLES, ANGLES)
def test_the_camera_never_tumbles(azimuth: float, elevation: float) -> None:
    camera = ViewCamera(Preset.MEDIAL).orbited(azimuth, elevation).orbited(0.0, elevation)
    assert abs(camera.elevation_deg) <= MAX_ELEVATION_DEG
    assert look(camera, Subject.FOOT, Side.LEFT, SIZE).up[2] > 0


@given(PIXELS, st.sampled_from(Preset), ANGLES, ANGLES)
def test_a_point_appears_at_the_pixel_it_was_taken_from(
    pixel: tuple[float, float], preset: Preset, azimuth: float, elevation: float
) -> None:
    seen = look(ViewCamera(preset).orbited(azimuth, elevation), Subject.FOOT, Side.LEFT, SIZE)
    origin, direction = seen.ray_at(*pixel)
    point = origin + 123.0 * direction
    assert seen.pixels_of(point)[0] == pytest.approx(pixel, abs=1e-6)


@given(PIXELS, st.floats(0.2, 5))
def test_zooming_keeps_the_point_under_the_pointer(
    pixel: tuple[float, float], factor: float
) -> None:
    before = look(ViewCamera(), Subject.FOOT, Side.LEFT, SIZE)
    point = before.point_at(*pixel)
    after = look(ViewCamera().zoomed(factor, point), Subject.FOOT, Side.LEFT, SIZE)
    assert after.pixels_of(point)[0] == pytest.approx(pixel, abs=1e-6)


@pytest.mark.parametrize("preset", list(Preset))
@pytest.mark.parametrize("size", [(800, 600), (300, 900)])
def test_fitted_shows_the_whole_box(preset: Preset, size: tuple[int, int]) -> None:
    box = np.array([[-40.0, 0.0, 0.0], [45.0, 260.0, 120.0]])
    camera = fitted(ViewCamera(preset), box, size)
    corners = np.stack(np.meshgrid(*box.T), axis=-1).reshape(-1, 3)
    pixels = look(camera, Subject.FOOT, Side.LEFT, size).pixels_of(corners)
    assert (pixels >= 0).all()
    assert (pixels <= size).all()
