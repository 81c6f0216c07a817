"""Sessions of cameras that deliver millimetres: an independent one beside the checkout."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import trimesh
from scipy.spatial import cKDTree

from insole_core.errors import ReconstructionError
from insole_core.reconstruct import reconstruct
from insole_core.reconstruct.result import report_json
from insole_core.reconstruct.views.measured_view import measure_view
from insole_core.recording.reader import read_session
from insole_core.recording.session import FrameTimes, Session

pytestmark = pytest.mark.shared


@pytest.fixture(scope="module")
def folder(shared_data: Path) -> Path:
    return shared_data / "realsense" / "left_g"


@pytest.fixture(scope="module")
def session(folder: Path) -> Session:
    return read_session(folder)


def test_the_sole_before_stereo_cameras_has_its_shape_and_place(
    session: Session, folder: Path
) -> None:
    late = replace(session.views[0], times=FrameTimes((0.0,), (100.0,)))
    result = reconstruct(replace(session, views=(late, *session.views[1:])))

    (warning,) = result.warnings
    assert "In the view left a colour picture was taken 100 ms before or after the depth" in warning
    for view in report_json(result, 1.0)["views"]:
        assert (view["sensor_family"], view["matching_error_learnt"]) == ("active stereo", False)
    assert result.correction_mm is None

    truth = trimesh.load(folder / "truth.ply", process=False, force="mesh")
    surface, face = trimesh.sample.sample_surface(truth, 300_000, seed=1)
    normals = truth.face_normals[face]
    nearest = cKDTree(surface).query(result.mesh.vertices)[1]
    off = np.einsum("nc,nc->n", result.mesh.vertices - surface[nearest], normals[nearest])
    sole = (normals[nearest, 2] < -0.5) & (surface[nearest, 2] < 30)
    achilles = (normals[nearest, 1] < -0.5) & (surface[nearest, 2] > 25)
    assert [use.used for use in result.infrared.values()] == [True] * 3
    assert np.abs(off[sole]).mean() < 0.22
    assert np.quantile(np.abs(off[sole]), 0.95) < 0.48
    assert np.abs(off[achilles]).mean() < 0.24
    true_sole = surface[(normals[:, 2] < -0.5) & (surface[:, 2] < 30)]
    away_mm = cKDTree(result.mesh.vertices).query(true_sole)[0]
    assert (away_mm < 1.5).mean() > 0.985


@pytest.mark.parametrize("unit_mm", [0.01, 1.0])
def test_a_wrong_unit_is_told(session: Session, unit_mm: float) -> None:
    view = session.views[0]
    wrong = replace(view, sensor=replace(view.sensor, depth_unit_mm=unit_mm))
    with pytest.raises(ReconstructionError, match=r'by "depth_unit_mm" in its sensor.json .* away'):
        measure_view(wrong)


def test_depth_of_nothing_is_told(session: Session) -> None:
    view = session.views[0]
    empty = np.zeros_like(view.read_depth(0))
    dark = replace(view, read_depth=lambda _: empty)
    with pytest.raises(ReconstructionError, match="its depth frames hold no reading"):
        measure_view(dark)
