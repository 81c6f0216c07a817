from __future__ import annotations

import numpy as np
import pytest

from insole_core.simulate.iso_surface import extract_surface

CELL_MM = 0.8
ORIGIN_MM = np.array([-12.0, -10.0, -8.0])


def _grid() -> list[np.ndarray]:
    steps = [np.arange(count) * CELL_MM for count in (30, 26, 21)]
    axes = [first + step for first, step in zip(ORIGIN_MM, steps, strict=True)]
    return list(np.meshgrid(*axes, indexing="ij"))


def test_an_ellipsoid_is_closed_outward_and_of_the_right_volume() -> None:
    x, y, z = _grid()
    half_axes = (9.0, 7.0, 5.0)
    field = np.sqrt((x / 9 - 0.05) ** 2 + (y / 7) ** 2 + (z / 5) ** 2) - 1

    mesh = extract_surface(field, ORIGIN_MM, CELL_MM)

    assert mesh.is_closed
    assert mesh.volume_mm3 == pytest.approx(4 / 3 * np.pi * np.prod(half_axes), rel=0.03)
    np.testing.assert_allclose(mesh.vertices.max(0), [9.45, 7, 5], atol=0.15)
    np.testing.assert_allclose(mesh.vertices.min(0), [-8.55, -7, -5], atol=0.15)


def test_a_flat_face_is_met_exactly() -> None:
    x, y, z = _grid()
    field = np.maximum.reduce([np.abs(x) - 6.1, np.abs(y) - 5.3, np.abs(z) - 4.3])

    mesh = extract_surface(field, ORIGIN_MM, CELL_MM)

    assert mesh.vertices[:, 2].max() == pytest.approx(4.3, abs=0.02)


def test_any_field_gives_a_closed_surface(rng: np.random.Generator) -> None:
    field = np.ones((12, 11, 10))
    field[1:-1, 1:-1, 1:-1] = rng.standard_normal((10, 9, 8))

    assert extract_surface(field, np.zeros(3), 1.0).is_closed
