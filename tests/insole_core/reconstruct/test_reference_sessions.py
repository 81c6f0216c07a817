"""The baseline's figures on the independent sessions beside the checkout."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
import trimesh
from scipy.spatial import cKDTree

from insole_core.geometry.transforms import inverse, rotation_angle_deg, transform
from insole_core.reconstruct import reconstruct
from insole_core.recording.reader import read_session


@pytest.mark.shared
@pytest.mark.parametrize("name", ["left_a", "right_b"])
def test_the_thesis_chain_reaches_its_figures(shared_data: Path, name: str) -> None:
    folder = shared_data / "sessions" / name
    session = read_session(folder)
    poses = json.loads((folder / "truth_poses.json").read_text())["sensor2reference"]
    result = reconstruct(session, "thesis")

    assert result.warnings == ()
    assert [view.markers_used for view in result.views] == [12, 12, 8]
    box = session.manifest.volume_of_interest
    assert box is not None
    center = (np.array(box.min_mm) + box.max_mm) / 2
    for view in result.views:
        assert view.residuals is not None
        assert view.residuals.mean <= 2.0
        assert view.sensor2reference is not None
        true = np.array(poses[view.name])
        moved = transform(view.sensor2reference, transform(inverse(true), center))
        assert np.linalg.norm(moved - center) <= 2.5
        assert rotation_angle_deg(view.sensor2reference[:3, :3] @ true[:3, :3].T) <= 0.7

    truth = trimesh.load(folder / "truth.ply", process=False, force="mesh")
    surface, face = trimesh.sample.sample_surface(truth, 200_000, seed=1)
    plantar = (truth.face_normals[face, 2] < -0.5) & (surface[:, 2] < 30)
    distance_mm, nearest = cKDTree(surface).query(result.mesh.vertices)
    assert (distance_mm > 5).mean() <= 0.02
    assert distance_mm[plantar[nearest]].mean() <= 1.2
