"""Moulds and finished insoles seen by one sensor on a table, without a reference system."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from simulated_view import simulate_view

from insole_core.compare.best_fit import find_dots
from insole_core.compare.comparison import compare_surfaces
from insole_core.compare.one_view import one_view_surface
from insole_core.errors import ReconstructionError
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.side import Side
from insole_core.insole.build import build_insole
from insole_core.insole.elements import Pelott
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.recording.session import View
from insole_core.solids.solid import insole_solid, positive_solid

pytestmark = pytest.mark.slow

PAD = Pelott(centre_mm=(5.0, 150.0), height_mm=5.0)
DOTS = np.array([(-20.0, 40), (18, 55), (25, 175), (-30, 150)])


def with_dots(mesh: TriangleMesh, sign: float) -> TriangleMesh:
    """Four black dots of 10 mm on the upper side; `sign` as x was turned."""
    places = DOTS * [sign, 1]
    away = np.linalg.norm(mesh.vertices[:, None, :2] - places, axis=2).min(axis=1)
    dark = (away < 5) & (mesh.vertices[:, 2] > 1)
    return replace(mesh, colors=np.where(dark[:, None], 15, 225).repeat(3, 1).astype(np.uint8))


@pytest.fixture(scope="module")
def models(left_foot) -> dict[str, TriangleMesh]:
    """N as it was designed; F a plaster mould, O a finished insole whose pad lies ahead."""
    design = InsoleDesign(Side.LEFT, grid_mm=2.0)
    ahead = replace(PAD, centre_mm=(PAD.centre_mm[0], PAD.centre_mm[1] + 5))
    n, f, o = (
        build_insole(left_foot, design.with_added(pad))
        for pad in (replace(PAD, height_mm=5.4), PAD, ahead)
    )
    return {
        "N": with_dots(insole_solid(n), 1),
        "F": one_view_surface(simulate_view(with_dots(positive_solid(f), -1), 3)),
        "O": one_view_surface(simulate_view(with_dots(insole_solid(o), 1), 4)),
    }


def test_background_is_taken_away(models):
    for name in "FO":
        width, length, height = models[name].bounds_mm[1] - models[name].bounds_mm[0]
        assert 80 < width < 115
        assert 240 < length < 280
        assert height < 50
        assert models[name].triangle_normals[:, 2].mean() > 0.5


def test_heights_are_those_over_the_table(models, left_foot):
    insole = insole_solid(build_insole(left_foot, InsoleDesign(Side.LEFT, grid_mm=2.0)))
    assert models["O"].bounds_mm[1, 2] == pytest.approx(insole.bounds_mm[1, 2], abs=3)


def test_thesis_case_from_scans(models):
    """The thesis found 1.2 to 1.45 mm; the pad that lies ahead shows in O alone."""
    maps = {
        pair: compare_surfaces(models[pair[0]], models[pair[1]], median_pixels=6)
        for pair in ("OF", "NF", "NO")
    }
    means = {pair: result.statistics["mean_abs"] for pair, result in maps.items()}
    assert max(means.values()) < 0.7
    assert means["NF"] < means["OF"]
    places = maps["NO"].grid.places
    behind, before = (np.linalg.norm(places - [5, y], axis=2) < 4 for y in (135, 172))
    assert np.nanmean(maps["NO"].signed_mm[behind]) > 0.3
    assert np.nanmean(maps["NO"].signed_mm[before]) < -0.3


def test_black_dots_place_a_scan(models):
    for name in "FO":
        result = compare_surfaces(models["N"], models[name], "dots")
        assert result.fit.residual_mm < 1.5
        assert result.statistics["median_abs"] < 1.0


def test_dots_of_a_scan_are_found_where_they_are(models):
    found = find_dots(models["F"], "the mould")
    apart = np.linalg.norm(found[:, None] - found, axis=2)
    true = np.linalg.norm(DOTS[:, None] - DOTS, axis=2)
    assert np.sort(apart[apart > 0]) == pytest.approx(np.sort(true[true > 0]), abs=4)


@pytest.fixture(scope="module")
def speck() -> View:
    """A table with hardly anything on it."""
    corners = np.array([[0.0, 0, 5], [9, 0, 5], [0, 9, 5]])
    return simulate_view(TriangleMesh(corners, np.array([[0, 1, 2]])), 1)


def test_empty_table(speck):
    with pytest.raises(ReconstructionError, match="stands out from its background"):
        one_view_surface(speck)


def test_sensor_that_sees_nothing(speck):
    def read_nothing(_index: int) -> np.ndarray:
        return np.full((480, 640), 2047, np.uint16)

    blind = View(speck.name, speck.sensor, 1, 1, read_nothing, speck.read_color)
    with pytest.raises(ReconstructionError, match="record it again"):
        one_view_surface(blind)
