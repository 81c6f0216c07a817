"""How far views differ on the foot, and what one view alone shows."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from insole_core.geometry.mesh import TriangleMesh
from insole_core.reconstruct.fusion.depth_view import DepthView, read_volume
from insole_core.reconstruct.views.foot_coverage import view_consistency
from insole_core.reconstruct.views.measured_view import MeasuredView, measure_view
from insole_core.reconstruct.views.range_mesh import view_mesh
from insole_core.reconstruct.volume import is_inside, volume_of_interest
from insole_core.recording.session import Session

RED = (255, 0, 0)


@pytest.fixture(scope="module")
def measured(session: Session) -> list[MeasuredView]:
    return [measure_view(view) for view in session.views[:2]]


@pytest.fixture(scope="module")
def readings(session: Session, measured: list[MeasuredView]) -> list[DepthView]:
    system, box = session.manifest.reference_system, volume_of_interest(session)
    return [
        read_volume(
            m.view.name,
            m.view.sensor,
            m.register(system).sensor2reference,
            box,
            raw=m.raw,
            color=m.color,
        )
        for m in measured
    ]


@pytest.fixture(scope="module")
def surface(
    session: Session, measured: list[MeasuredView], readings: list[DepthView]
) -> TriangleMesh:
    """The sole as the left view alone shows it."""
    return view_mesh(measured[0], readings[0].sensor2reference, volume_of_interest(session), RED)


def test_one_view_is_shown_in_one_colour_inside_the_volume(
    session: Session, surface: TriangleMesh
) -> None:
    assert surface.colors is not None
    assert (surface.colors == RED).all()
    assert is_inside(surface.vertices, volume_of_interest(session)).all()
    assert len(surface.triangles) > 1000
    assert (surface.triangle_normals[:, 2] < 0).mean() > 0.8  # towards the sensor, below


def test_one_view_alone_agrees_with_nobody(
    surface: TriangleMesh, readings: list[DepthView]
) -> None:
    alone = view_consistency(surface, readings[:1])
    assert set(alone.views.tolist()) <= {0, 1}
    assert (alone.views == 1).mean() > 0.8
    assert np.isnan(alone.spread_mm).all()


def test_a_view_that_is_moved_differs_by_as_much(
    surface: TriangleMesh, readings: list[DepthView]
) -> None:
    first, second = readings
    usual = view_consistency(surface, [first, second])
    assert (usual.views == 2).mean() > 0.3
    assert np.nanmedian(usual.spread_mm) < 1.5
    axis = second.sensor2reference[:3, 2]
    pose = second.sensor2reference.copy()
    pose[:3, 3] += 5.0 * axis
    moved = view_consistency(surface, [first, replace(second, sensor2reference=pose)])
    both = (usual.views == 2) & (moved.views == 2)
    cosine = -(surface.vertex_normals[both] @ axis)
    np.testing.assert_allclose(np.median(moved.spread_mm[both] / cosine), 5.0, atol=1.5)
