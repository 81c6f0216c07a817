from __future__ import annotations

import numpy as np
import pytest

from insole_studio.acquisition.light import Light, judge_light


@pytest.mark.parametrize(
    ("level", "light"), [(20, Light.DARK), (130, Light.GOOD), (255, Light.BRIGHT)]
)
def test_light_is_judged(level: int, light: Light) -> None:
    assert judge_light(np.full((480, 640, 3), level, np.uint8)) is light


def test_a_bright_foot_before_a_dark_ground_is_well_lit() -> None:
    picture = np.full((480, 640, 3), 10, np.uint8)
    picture[100:300, 200:400] = 180
    assert judge_light(picture) is Light.GOOD


def test_a_small_glint_is_not_too_bright() -> None:
    picture = np.full((480, 640, 3), 120, np.uint8)
    picture[:50, :50] = 255
    assert judge_light(picture) is Light.GOOD
