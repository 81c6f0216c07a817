"""Balls, cylinders and scans found in a surface that also shows what holds them."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from insole_core.errors import CalibrationError
from insole_core.evaluation.find_form import find_ball, find_cylinder, find_scan, on_form
from insole_core.evaluation.known_form import Ball, Cylinder, Scan, ScannedBody, fitted
from insole_core.evaluation.known_object import KnownRound
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.transforms import rigid, rotation_about, transform
from insole_core.simulate.foot_model import build_foot
from insole_core.simulate.foot_shape import FootShape
from insole_core.simulate.known_bodies import KnownBody, ball, upright_cylinder
from insole_core.simulate.scene import joined


def seen(body: KnownBody) -> TriangleMesh:
    """What sensors below see of a body and its holder, roughened by 0.2 mm."""
    whole = joined([body.mesh, body.holder])
    below = whole.part(whole.vertex_normals[:, 2] < 0.4)
    rough = np.random.default_rng(5).normal(0, 0.2, below.vertices.shape)
    return below.moved(below.vertices + rough)


@cache
def seen_ball() -> TriangleMesh:
    return seen(ball(130))


@cache
def seen_cylinder() -> TriangleMesh:
    return seen(upright_cylinder(110))


def test_ball_apart_from_its_plate() -> None:
    surface = seen_ball()
    found = find_ball(surface, 126)
    assert found.size_mm == pytest.approx(130, abs=0.1)
    assert found.centre_mm == pytest.approx([0, 12, 60], abs=0.1)
    own = on_form(found, surface.vertices, surface.vertex_normals)
    plate = surface.vertices[:, 1] > 12 + 65.5
    assert not own[plate].any()


def test_cylinder_apart_from_its_end_and_plate() -> None:
    found = find_cylinder(seen_cylinder(), 112)
    assert found.size_mm == pytest.approx(110, abs=0.1)
    assert abs(found.axis) == pytest.approx([0, 1, 0], abs=0.01)


def test_what_is_not_there_is_not_found() -> None:
    with pytest.raises(CalibrationError, match="No cylinder of about 130 mm was found"):
        find_cylinder(seen_ball(), 130)
    with pytest.raises(CalibrationError, match="No ball of about 300 mm was found"):
        find_ball(seen_ball(), 300)
    surface = seen_ball()
    few = surface.part(np.arange(len(surface.vertices)) < 200)
    with pytest.raises(CalibrationError, match=r"Only \d+ points were measured"):
        find_ball(few, 130)


def test_size_and_place_of_least_squares() -> None:
    """A form of fixed size takes the place of least squares; a free one also the right size."""
    surface = seen_ball()
    near = Ball(np.array([1.0, 10.0, 63.0]), 131)
    own = on_form(near, surface.vertices, surface.vertex_normals)
    points, areas = surface.vertices[own], surface.vertex_areas[own]
    assert fitted(near, points, areas).size_mm == 131
    assert fitted(near, points, areas, size=True).size_mm == pytest.approx(130, abs=0.1)
    pipe = Cylinder(np.array([1.0, 0.0, 50.0]), np.array([0.0, 1.0, 0.0]), 108)
    surface = seen_cylinder()
    own = on_form(pipe, surface.vertices, surface.vertex_normals)
    points, areas = surface.vertices[own], surface.vertex_areas[own]
    assert fitted(pipe, points, areas, size=True).size_mm == pytest.approx(110, abs=0.1)


def test_another_size_than_said_is_refused_with_both() -> None:
    said = KnownRound("ball", 133, 136.5)
    with pytest.raises(CalibrationError, match=r"said to be 133\.0 to 136\.5 mm .* but 130\.0 mm"):
        replace(said, tolerance_mm=2).find(seen_ball())
    found = said.find(seen_ball())
    assert said.true_size_mm(found.size_mm) == 133
    assert KnownRound("ball", 128, 136.5).true_size_mm(found.size_mm) == found.size_mm


@pytest.fixture(scope="module")
def cast() -> TriangleMesh:
    return build_foot(FootShape(), np.random.default_rng(3), 6.0).mesh


def test_scan_from_any_pose(cast: TriangleMesh) -> None:
    surface = cast.part(cast.vertex_normals[:, 2] < 0.2)
    turn = rigid(rotation_about(np.array([1.0, 2.0, 0.5]), 70), np.array([200.0, -80.0, 33.0]))
    found = find_scan(surface, Scan(cast.transformed(turn)), "cast.stl")
    errors = found.errors(surface.vertices)[0]
    assert np.nanmean(np.abs(errors)) < 0.1
    back = transform(found.scan2place @ turn, cast.vertices)
    assert np.abs(back - cast.vertices).max() < 0.3


def test_other_casts_are_told(cast: TriangleMesh) -> None:
    surface = cast.part(cast.vertex_normals[:, 2] < 0.2)
    mirrored = cast.transformed(np.diag([-1.0, 1.0, 1.0, 1.0])).flipped()
    with pytest.raises(CalibrationError, match="only as its mirror image"):
        find_scan(surface, Scan(mirrored), "cast.stl")
    with pytest.raises(CalibrationError, match=r"is 3\d\d mm long, but would have to be 2\d\d mm"):
        find_scan(surface, Scan(cast.moved(1.12 * cast.vertices)), "cast.stl")


def test_scan_says_nothing_beside_its_edges(cast: TriangleMesh) -> None:
    half = cast.part(cast.vertices[:, 1] < 0)
    errors = ScannedBody(Scan(half), np.eye(4)).errors(cast.vertices)[0]
    beyond = cast.vertices[:, 1] > 5
    within = cast.vertices[:, 1] < -5
    assert np.isnan(errors[beyond & (cast.vertices[:, 2] < 40)]).mean() > 0.95
    assert np.nanmax(np.abs(errors[within])) < 1.0
