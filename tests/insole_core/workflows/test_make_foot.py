"""One way from a session to a foot, whoever asks."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from insole_core.errors import ReconstructionError
from insole_core.geometry.side import Side
from insole_core.reconstruct import RegistrationLimits
from insole_core.reconstruct.fusion.depth_view import read_volume
from insole_core.reconstruct.views.foot_coverage import view_consistency
from insole_core.workflows.make_foot import (
    MadeFoot,
    MeasuredSession,
    make_foot,
    measure_session,
    open_session,
    reconstruct_session,
)
from insole_core.workflows.open_scan import open_scan

SMALL = Path(__file__).parents[2] / "data" / "sessions" / "left_small.zip"
LIMITS = RegistrationLimits()


@pytest.fixture(scope="module")
def measured() -> MeasuredSession:
    return measure_session(SMALL)


@pytest.fixture(scope="module")
def in_window(measured: MeasuredSession) -> MadeFoot:
    """As the foot stage makes it."""
    return make_foot(measured, LIMITS, compare_views=True)


@pytest.mark.slow
def test_window_commands_and_case_files_get_the_same_foot(in_window: MadeFoot) -> None:
    surface = reconstruct_session(open_session(SMALL)).mesh
    assert np.array_equal(surface.vertices, in_window.mesh.vertices)
    assert np.array_equal(surface.triangles, in_window.mesh.triangles)
    scanned = open_scan(SMALL)
    assert scanned.foot.side is in_window.scan.foot.side is Side.LEFT
    assert np.array_equal(scanned.foot.mesh.vertices, in_window.scan.foot.mesh.vertices)
    assert scanned.source == in_window.scan.source
    assert scanned.warnings == in_window.scan.warnings


def test_the_views_are_compared_where_the_reconstruction_read_them(
    in_window: MadeFoot, measured: MeasuredSession
) -> None:
    result = in_window.reconstruction
    assert result.depth_views == ()  # they are large and have been used
    read_again = []
    for view in result.views:
        assert view.used
        assert view.sensor2reference is not None
        one = measured.measured[view.name]
        read_again.append(
            read_volume(
                view.name,
                one.view.sensor,
                view.sensor2reference,
                measured.box,
                raw=one.raw,
                color=one.color,
            )
        )
    expected = view_consistency(in_window.mesh, read_again)
    assert in_window.agreement is not None
    assert np.array_equal(in_window.agreement.views, expected.views)
    assert np.array_equal(in_window.agreement.spread_mm, expected.spread_mm, equal_nan=True)


def test_views_are_compared_only_where_that_is_asked_for(measured: MeasuredSession) -> None:
    made = make_foot(measured)
    assert made.agreement is None


def test_a_view_without_readings_says_so_again(measured: MeasuredSession) -> None:
    view = measured.session.views[0]
    reason = ReconstructionError("its depth frames hold no reading")
    blind = MeasuredSession(measured.path, measured.session, {}, {view.name: reason})
    with pytest.raises(ReconstructionError, match="no reading"):
        blind.measure(view)
    assert blind.measure(measured.session.views[1]).view.name == measured.session.views[1].name
