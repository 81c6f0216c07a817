"""A shared session of another's simulator: patterns learnt from its walls refine its foot."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import cv2
import numpy as np
import pytest
import trimesh

from insole_core.calibration.infrared.infrared_walls import read_infrared_walls
from insole_core.calibration.infrared.learnt_reference import learn_reference
from insole_core.geometry.arrays import FloatArray, RawArray
from insole_core.geometry.point_tree import point_tree
from insole_core.reconstruct import Reconstruction, reconstruct
from insole_core.recording.reader import read_session
from insole_core.recording.session import DotPictures, InfraredPictures, View

WALLS = (2, 5, 8, 10)


def with_dots(view: View, infrared: Path, pictures: Path, folder: Path) -> View:
    """Learn the pattern of a view's sensor from a few walls, and give the view its pictures."""
    folder.mkdir()
    for number in WALLS:
        for kind in ("infrared", "depth"):
            name = f"{kind}_{number:02d}.png"
            (folder / name).symlink_to(infrared / "walls" / view.sensor.serial / name)
    learnt = learn_reference(read_infrared_walls(folder, view.sensor.serial), view.sensor)
    assert len(learnt.used) == len(WALLS)
    paths = sorted(pictures.glob("infrared_*.png"))

    def read(index: int) -> RawArray:
        return np.asarray(cv2.imread(str(paths[index]), cv2.IMREAD_UNCHANGED))

    return replace(view, dots=DotPictures(InfraredPictures(len(paths), read, 16), learnt.reference))


def sole_error_mm(made: Reconstruction, truth: FloatArray) -> float:
    """Mean distance of the sole from the truth, in place."""
    low = (made.mesh.vertex_normals[:, 2] < -0.5) & (made.mesh.vertices[:, 2] < 30)
    distances_mm, _ = point_tree(truth).query(made.mesh.vertices[low])
    return float(np.mean(distances_mm))


@pytest.mark.slow
def test_a_shared_sole_is_nearer_the_truth_by_infrared(shared_data: Path, tmp_path: Path) -> None:
    folder = shared_data / "infrared"
    session = read_session(folder / "left_e")
    (left,) = (view for view in session.views if view.name == "left")
    infrared = folder / "infrared"
    dotted = with_dots(left, infrared, infrared / "left_e" / left.name, tmp_path / left.name)
    loaded = trimesh.load(folder / "left_e" / "truth.ply", process=False, force="mesh")
    truth, _ = trimesh.sample.sample_surface(loaded, 400_000, seed=1)

    by_chip, by_infrared = (
        sole_error_mm(reconstruct(replace(session, views=(view,))), np.asarray(truth))
        for view in (left, dotted)
    )

    assert by_infrared < 0.97 * by_chip
