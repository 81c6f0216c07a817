"""A sensor whose depth has the wrong scale is found by the markers, told, and corrected."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy.spatial import cKDTree

from insole_core.errors import ReconstructionError
from insole_core.reconstruct import Reconstruction, reconstruct
from insole_core.reconstruct.views.measured_view import measure_view
from insole_core.recording.session import Session, View
from insole_core.sensing.disparity import ScaledDisparity


def stretched(view: View, factor: float) -> View:
    """The view of a sensor that measures every depth too large by a factor."""
    disparity = ScaledDisparity(view.sensor.disparity, factor)
    return replace(view, sensor=replace(view.sensor, disparity=disparity))


def with_one_stretched(session: Session, name: str, factor: float) -> Session:
    views = (stretched(view, factor) if view.name == name else view for view in session.views)
    return replace(session, views=tuple(views))


def test_sensors_that_measure_right_are_left_alone(fused: Reconstruction) -> None:
    assert not [warning for warning in fused.warnings if "the depth is" in warning]


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "factor", "said"),
    [
        ("left", 1.01, "1.0 % larger"),
        ("top", 0.97, "3.0 % smaller"),
    ],
)
def test_a_wrong_scale_in_one_view_is_told_and_moves_no_foot(
    name: str, factor: float, said: str, session: Session, fused: Reconstruction
) -> None:
    found = reconstruct(with_one_stretched(session, name, factor))
    percent, direction = said.split(" % ")
    (warning,) = (text for text in found.warnings if text.startswith(f"In the view {name} "))
    assert f"% {direction} than the markers in the colour image say, and is corrected" in warning
    told = float(warning.partition("the depth is ")[2].split(" ")[0])
    assert told == pytest.approx(float(percent), abs=0.2)
    off_mm, _ = cKDTree(fused.mesh.vertices).query(found.mesh.vertices)
    assert np.percentile(off_mm, 95) < 0.6  # before, 1.0 to 6.8 mm


@pytest.mark.parametrize("factor", [1.003, 0.997])
def test_what_calibrated_sensors_may_show_is_no_wrong_scale(
    factor: float, session: Session
) -> None:
    view = session.views[0]
    measured = measure_view(stretched(view, factor))
    assert measured.register(session.manifest.reference_system).depth_scale == 1.0


@pytest.mark.parametrize("factor", [1.08, 0.9])
def test_a_scale_beyond_belief_is_refused(factor: float, session: Session) -> None:
    measured = measure_view(stretched(session.views[0], factor))
    with pytest.raises(ReconstructionError, match="calibrate the sensor"):
        measured.register(session.manifest.reference_system)


def test_a_scaled_model_goes_there_and_back(session: Session) -> None:
    model = session.views[0].sensor.disparity
    depth_mm = np.array([500.0, 700.0, 900.0])
    scaled = ScaledDisparity(model, 1.02)
    assert np.allclose(scaled.depth_mm(model.raw(depth_mm)), 1.02 * depth_mm)
    assert np.allclose(scaled.depth_mm(scaled.raw(depth_mm)), depth_mm)
