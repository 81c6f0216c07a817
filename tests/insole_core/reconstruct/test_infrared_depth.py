"""A session whose views have infrared pictures of the dots, and what is wrong with some."""

from __future__ import annotations

import io
import json
import zipfile
from collections.abc import Callable
from dataclasses import replace
from functools import cache
from pathlib import Path

import numpy as np
import pytest
import trimesh

from insole_core.errors import ReconstructionError
from insole_core.geometry.arrays import FloatArray, RawArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.point_tree import point_tree
from insole_core.geometry.ray_casting import RayCaster
from insole_core.reconstruct import Reconstruction, reconstruct, report_json
from insole_core.recording.images import encode_png
from insole_core.recording.reader import read_session
from insole_core.recording.session import DotPictures, InfraredPictures, Session, View
from insole_core.recording.writer import write_session
from insole_core.sensing.correction import DisparityCorrection
from insole_core.sensing.infrared_reference import InfraredReference, ReferenceRecord
from insole_core.simulate.dot_pattern import DotPattern

SMALL = Path(__file__).parents[2] / "data" / "sessions" / "left_small.zip"
FINE = 8


@cache
def pattern_of(serial: str, seed: int) -> InfraredReference:
    """The dots of a device without distortion, as its camera sees them."""
    pattern = DotPattern.draw(np.random.default_rng(seed), px_per_dot=9.0).seen()
    correction = DisparityCorrection(np.zeros((480, 640), np.float32))
    return InfraredReference(pattern, 0, FINE, correction, ReferenceRecord(serial))


def picture_of(view: View, truth: TriangleMesh, pose: FloatArray, seed: int) -> RawArray:
    """What the infrared camera of a view sees of the true foot, with speckle."""
    rays = view.sensor.depth_camera.pixel_rays().reshape(-1, 2)
    directions = np.c_[rays, np.ones(len(rays))] @ pose[:3, :3].T
    hits = RayCaster(truth).cast(pose[:3, 3], directions)
    corners = truth.vertices[truth.triangles[hits.triangle]]
    points = np.einsum("nk,nkc->nc", hits.weights, corners)
    raw = np.full((480, 640), np.nan)
    raw.flat[hits.ray] = view.sensor.disparity.raw((points - pose[:3, 3]) @ pose[:3, 2])
    dots, _ = pattern_of(view.sensor.serial, seed).shown(raw)
    speckle = np.random.default_rng(seed).gamma(0.2**-2, 0.2**2, dots.shape)
    return np.asarray(np.clip(8 + 60 * dots * speckle, 0, 1023), np.uint16)


def with_picture(view: View, picture: RawArray, reference: InfraredReference) -> View:
    return replace(view, dots=DotPictures(InfraredPictures(1, lambda _: picture, 16), reference))


@pytest.fixture(scope="module")
def session() -> Session:
    return read_session(SMALL)


@pytest.fixture(scope="module")
def truth() -> TriangleMesh:
    with zipfile.ZipFile(SMALL) as archive:
        loaded = trimesh.load(io.BytesIO(archive.read("truth.ply")), "ply", process=False)
    return TriangleMesh(np.asarray(loaded.vertices, float), np.asarray(loaded.faces))


@pytest.fixture(scope="module")
def dotted(session: Session, truth: TriangleMesh) -> Session:
    """The session with an infrared picture of every view."""
    with zipfile.ZipFile(SMALL) as archive:
        poses = json.loads(archive.read("truth_poses.json"))["sensor2reference"]
    views = []
    for seed, view in enumerate(session.views):
        picture = picture_of(view, truth, np.array(poses[view.name]), seed)
        views.append(with_picture(view, picture, pattern_of(view.sensor.serial, seed)))
    return replace(session, views=tuple(views))


@pytest.fixture(scope="module")
def by_chip(session: Session) -> Reconstruction:
    return reconstruct(session)


def mean_error_mm(made: Reconstruction, truth: TriangleMesh) -> float:
    surface, _ = trimesh.sample.sample_surface(
        trimesh.Trimesh(truth.vertices, truth.triangles, process=False), 200_000, seed=1
    )
    distances_mm, _ = point_tree(np.asarray(surface)).query(made.mesh.vertices)
    return float(np.mean(distances_mm))


def test_infrared_pictures_bring_the_foot_nearer_the_truth(
    dotted: Session, by_chip: Reconstruction, truth: TriangleMesh
) -> None:
    made = reconstruct(dotted)

    assert mean_error_mm(made, truth) < 0.95 * mean_error_mm(by_chip, truth)
    assert set(made.infrared_shares) == {view.name for view in dotted.views}
    assert min(made.infrared_shares.values()) > 0.9
    depth = report_json(made, 1.0)["depth"]
    assert depth == {"source": "infrared", "trusted_share": made.infrared_shares}


def test_by_chip_they_change_nothing(dotted: Session, by_chip: Reconstruction) -> None:
    made = reconstruct(dotted, depth="chip")

    np.testing.assert_array_equal(made.mesh.vertices, by_chip.mesh.vertices)
    assert "depth" not in report_json(made, 1.0)


def test_pictures_that_cannot_be_used_are_told_and_change_nothing(
    dotted: Session, by_chip: Reconstruction
) -> None:
    left, right, top = dotted.views
    foreign = pattern_of(top.sensor.serial, 17)
    assert top.dots is not None
    assert top.dots.pictures is not None
    views = (
        with_picture(left, np.zeros((480, 640), np.uint16), pattern_of(left.sensor.serial, 0)),
        with_picture(right, np.full((480, 640), 1023, np.uint16), foreign),
        with_picture(top, top.dots.pictures.read(0), foreign),
    )
    made = reconstruct(replace(dotted, views=views))

    np.testing.assert_array_equal(made.mesh.vertices, by_chip.mesh.vertices)
    told = "\n".join(made.warnings)
    assert f"View {left.name}: its infrared pictures are black" in told
    assert f"View {right.name}: its infrared pictures are saturated" in told
    assert f"View {top.name}: its infrared pictures show the pattern on" in told


def test_without_any_infrared_is_refused(session: Session) -> None:
    with pytest.raises(ReconstructionError, match="No view has infrared pictures"):
        reconstruct(session, depth="infrared")


def _small(view: Path) -> None:
    small = np.zeros((240, 320), np.uint16)
    (view / "infrared_000.png").write_bytes(encode_png(small))


def _half(view: Path) -> None:
    path = view / "reference.npz"
    path.write_bytes(path.read_bytes()[:1000])


def _foreign(view: Path) -> None:
    pattern_of("SOMEBODY", 3).save(view / "reference.npz")


def _without(view: Path) -> None:
    (view / "reference.npz").unlink()


def _shifted(view: Path) -> None:
    values = json.loads((view / "sensor.json").read_text())
    (view / "sensor.json").write_text(json.dumps({**values, "infrared_shift_px": [4, 4]}))


@pytest.fixture(scope="module")
def written(dotted: Session, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The session as a folder, one view with its infrared picture."""
    folder = tmp_path_factory.mktemp("written") / "session"
    first, *others = dotted.views
    write_session(
        replace(dotted, views=(first, *(replace(view, dots=None) for view in others))), folder
    )
    return folder


def test_pictures_and_pattern_are_read_as_they_were_written(dotted: Session, written: Path) -> None:
    before, after = dotted.views[0].dots, read_session(written).views[0].dots

    assert before is not None
    assert before.pictures is not None
    assert before.reference is not None
    assert after is not None
    assert after.pictures is not None
    assert after.reference is not None
    np.testing.assert_array_equal(after.pictures.read(0), before.pictures.read(0))
    np.testing.assert_allclose(
        after.reference.pattern, before.reference.pattern, rtol=1e-3, atol=1e-3
    )
    assert read_session(written).views[1].dots is None


@pytest.mark.parametrize(
    ("spoil", "sentence"),
    [
        (_small, "infrared_000.png is 320×240"),
        (_half, "reference.npz holds no readable infrared reference pattern"),
        (_foreign, "is the pattern of sensor SOMEBODY"),
        (_without, "reference.npz is missing"),
        (_shifted, "infrared_shift_px"),
    ],
)
def test_what_is_wrong_with_infrared_spoils_no_session(
    spoil: Callable[[Path], None], sentence: str, written: Path
) -> None:
    view = written / "views" / read_session(written).views[0].name
    kept = {path: path.read_bytes() for path in view.iterdir()}
    try:
        spoil(view)
        dots = read_session(written).views[0].dots
    finally:
        for path, content in kept.items():
            path.write_bytes(content)

    assert dots is not None
    assert dots.reference is None
    assert sentence in dots.fault
