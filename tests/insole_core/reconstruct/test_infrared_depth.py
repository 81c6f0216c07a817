"""A session whose views have infrared pictures of the dots, and what is wrong with some."""

from __future__ import annotations

import io
import json
import re
import zipfile
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import pytest
import trimesh

from insole_core.errors import InputError, ReconstructionError
from insole_core.geometry.arrays import FloatArray, RawArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.point_tree import point_tree
from insole_core.geometry.ray_casting import RayCaster
from insole_core.reconstruct import Reconstruction, reconstruct, report_json
from insole_core.reconstruct.fusion import infrared_surface
from insole_core.reconstruct.fusion.infrared_evidence import Evidence, infrared_evidence
from insole_core.reconstruct.fusion.infrared_surface import InfraredUse
from insole_core.reconstruct.views.infrared_pictures import infrared_view, infrared_warnings
from insole_core.recording.images import encode_png
from insole_core.recording.reader import read_session
from insole_core.recording.session import DotPictures, InfraredPictures, Session, View
from insole_core.recording.writer import write_session
from insole_core.sensing.correction import DisparityCorrection
from insole_core.sensing.infrared_reference import InfraredReference, ReferenceRecord
from insole_core.simulate.dot_pattern import DotPattern
from insole_studio.texts import translation_into

SMALL = Path(__file__).parents[2] / "data" / "sessions" / "left_small.zip"
FINE = 8
DISTORTION_RAW = 2 * np.sin(np.mgrid[:480, :640] / 150).sum(0)


@cache
def pattern_of(serial: str, seed: int) -> InfraredReference:
    """The dots of a device, as its camera sees them, and its distortion."""
    pattern = DotPattern.draw(np.random.default_rng(seed), px_per_dot=9.0).seen()
    correction = DisparityCorrection(DISTORTION_RAW.astype(np.float32))
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
    v, u = np.mgrid[:480, :640].astype(np.float32)
    across = u * FINE + np.nan_to_num(raw + DISTORTION_RAW, nan=-1e6).astype(np.float32)
    dots = cv2.remap(pattern_of(view.sensor.serial, seed).pattern, across, v, cv2.INTER_LINEAR)
    speckle = np.random.default_rng(seed).gamma(0.2**-2, 0.2**2, dots.shape)
    return np.asarray(np.clip(8 + 60 * dots * speckle, 0, 1023), np.uint16)


def with_picture(view: View, picture: RawArray, reference: InfraredReference) -> View:
    return replace(view, dots=DotPictures(InfraredPictures(1, lambda _: picture, 16), reference))


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
def mean_error_mm(truth: TriangleMesh) -> Callable[[Reconstruction], float]:
    """Mean distance of a foot from the true one."""
    surface, _ = trimesh.sample.sample_surface(
        trimesh.Trimesh(truth.vertices, truth.triangles, process=False), 200_000, seed=1
    )
    tree = point_tree(np.asarray(surface))
    return lambda made: float(np.mean(tree.query(made.mesh.vertices)[0]))


@pytest.fixture(scope="module")
def refined(dotted: Session) -> Reconstruction:
    return reconstruct(dotted)


def test_infrared_pictures_bring_the_foot_nearer_the_truth(
    dotted: Session,
    refined: Reconstruction,
    fused: Reconstruction,
    mean_error_mm: Callable[[Reconstruction], float],
) -> None:
    made = refined

    assert mean_error_mm(made) < 0.85 * mean_error_mm(fused)
    depth = report_json(made, 1.0)["depth"]
    assert depth["source"] == "infrared"
    assert set(depth["trusted_share"]) == {view.name for view in dotted.views}
    assert min(depth["trusted_share"].values()) > 0.9
    assert depth["deviation_of"] == "infrared"
    assert 0.02 < depth["foot_share"] <= 1
    assert made.deviation_mm is not None
    assert fused.deviation_mm is not None
    assert len(made.deviation_mm) == len(made.mesh.vertices)
    assert np.mean(made.deviation_mm) < np.mean(fused.deviation_mm)


def test_where_light_or_noise_covers_the_dots_is_told(
    dotted: Session, refined: Reconstruction
) -> None:
    """Sunlight on half of the foot in one view, noise in another, nothing in the third."""
    pictures, rng = [], np.random.default_rng(5)
    for view in dotted.views:
        assert view.dots is not None
        assert view.dots.pictures is not None
        pictures.append(view.dots.pictures.read(0).astype(float))
    sunny, noisy, plain = pictures
    middle = int(np.median(np.nonzero(sunny > 16)[1]))
    sunny[:, middle:] += 150
    noisy += rng.normal(0, 20, noisy.shape)
    views = []
    for view, picture in zip(dotted.views, (sunny, noisy, plain), strict=True):
        assert view.dots is not None
        assert view.dots.reference is not None
        levels = np.clip(picture, 0, 1023).astype(np.uint16)
        views.append(with_picture(view, levels, view.dots.reference))
    made = reconstruct(replace(dotted, views=tuple(views)))

    bright, covered = (
        [warning for warning in made.warnings if reason in warning]
        for reason in ("Bright light outshines", "Noise covers the dots")
    )
    first, second, third = (view.name for view in views)
    assert [re.findall(r"(\w+) \d+%", told) for told in bright] == [[first]]
    assert [re.findall(r"(\w+) \d+%", told) for told in covered] == [[second]]
    assert not any(third in told for told in made.warnings)
    depth = report_json(made, 1.0)["depth"]
    assert 0.2 < depth["bright_share"][first] < 0.8
    assert depth["noisy_share"][second] > 0.5
    assert depth["trusted_share"][third] > 0.9 > depth["trusted_share"][first]
    assert made.deviation_mm is not None
    assert refined.deviation_mm is not None
    assert made.deviation_mm.mean() > refined.deviation_mm.mean()
    assert not any("outshines" in told or "Noise covers" in told for told in refined.warnings)


@pytest.mark.parametrize(
    ("bright", "noisy", "reason"),
    [
        (0.05, 0.3, ""),
        (0.21, 0.46, "Bright light outshines the dots"),
        (0.04, 0.56, "Noise covers the dots"),
    ],
)
def test_undisturbed_views_are_silent_and_disturbed_ones_name_one_reason(
    bright: float, noisy: float, reason: str
) -> None:
    """What undisturbed feet have at most, and disturbed ones at least that are to be told."""
    use = InfraredUse(1.0, used=True, bright=bright, noisy=noisy)
    told = infrared_warnings({}, {"left": use})
    assert [reason in sentence for sentence in told] == [True] * bool(reason)


@pytest.mark.parametrize(
    ("moved_raw", "is_told"), [(None, False), (0.25, False), (0.47, True), (1.2, True)]
)
def test_a_foot_that_moved_is_told_even_where_its_pictures_lie_on_the_depth(
    moved_raw: float | None, is_told: bool
) -> None:
    """Depth of still scenes changes by up to 0.25 raw; a foot that came 0.5 mm nearer by 0.47."""
    use = InfraredUse(1.0, used=True, drift_raw=0.2, moved_raw=moved_raw)
    told = infrared_warnings({}, {"left": use})
    assert ["the foot moved a little" in sentence for sentence in told] == [True] * is_told


def test_a_pattern_that_drifted_is_told_and_moves_nothing(
    dotted: Session, fused: Reconstruction, mean_error_mm: Callable[[Reconstruction], float]
) -> None:
    """Depth tells whether the foot moved before the pictures were taken, where it was asked."""
    views = []
    for view, moved_raw in zip(dotted.views, (None, 0.2, 0.9), strict=True):
        assert view.dots is not None
        assert view.dots.reference is not None
        drifted = DisparityCorrection(view.dots.reference.correction.offset + np.float32(1.2))
        reference = replace(view.dots.reference, correction=drifted)
        dots = replace(view.dots, reference=reference, moved_raw=moved_raw)
        views.append(replace(view, dots=dots))
    made = reconstruct(replace(dotted, views=tuple(views)))

    assert mean_error_mm(made) < 0.95 * mean_error_mm(fused)
    unknown, still = (warning for warning in made.warnings if "lie 0.1" in warning)
    (moved,) = (warning for warning in made.warnings if "depth changed by 0.11 px" in warning)
    assert "the foot moved a little between the two, or the sensor has drifted" in unknown
    assert "though nothing moved between the two, so the sensor's pattern of dots" in still
    assert moved.startswith(f"View {views[2].name}: the foot moved a little between its depth")


def test_pictures_of_another_pose_are_told_and_change_nothing(
    dotted: Session, fused: Reconstruction, truth: TriangleMesh
) -> None:
    """Put back a few millimetres elsewhere, the foot is still near enough to find its dots."""
    with zipfile.ZipFile(SMALL) as archive:
        poses = json.loads(archive.read("truth_poses.json"))["sensor2reference"]
    elsewhere = truth.moved(truth.vertices + np.array([0.0, -9.0, 7.0]))
    views = []
    for seed, view in enumerate(dotted.views):
        picture = picture_of(view, elsewhere, np.array(poses[view.name]), seed)
        views.append(with_picture(view, picture, pattern_of(view.sensor.serial, seed)))
    made = reconstruct(replace(dotted, views=tuple(views)))

    np.testing.assert_array_equal(made.mesh.vertices, fused.mesh.vertices)
    told = [warning for warning in made.warnings if "of another moment, pose or sensor" in warning]
    assert len(told) == len(views)


def test_by_chip_they_change_nothing(dotted: Session, fused: Reconstruction) -> None:
    made = reconstruct(dotted, depth="chip")

    np.testing.assert_array_equal(made.mesh.vertices, fused.mesh.vertices)
    assert "depth" not in report_json(made, 1.0)


def test_pictures_that_cannot_be_used_are_told_and_change_nothing(
    dotted: Session, fused: Reconstruction
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

    np.testing.assert_array_equal(made.mesh.vertices, fused.mesh.vertices)
    assert report_json(made, 1.0)["depth"]["source"] == "chip"
    told = "\n".join(made.warnings)
    assert f"View {left.name}: the infrared pictures are black" in told
    assert f"View {right.name}: the infrared pictures are saturated" in told
    assert f"View {top.name}: its infrared pictures show the pattern on" in told


def test_pictures_of_other_sensors_are_no_infrared(dotted: Session) -> None:
    views, one = [], pattern_of(dotted.views[-1].sensor.serial, 17)
    for view in dotted.views:
        assert view.dots is not None
        foreign = replace(one, record=ReferenceRecord(view.sensor.serial))
        views.append(replace(view, dots=replace(view.dots, reference=foreign)))
    foreign_ones = replace(dotted, views=tuple(views))

    with pytest.raises(ReconstructionError, match="that can be used") as refused:
        reconstruct(foreign_ones, depth="infrared")
    assert str(refused.value).count("show the pattern on") == 3
    assert ".;" not in str(refused.value)


def test_a_picture_that_has_moved_the_surface_is_not_told_as_unused(
    dotted: Session, monkeypatch: pytest.MonkeyPatch
) -> None:
    shares = iter((0.6, 0.4))

    def doubted(*given: Any) -> Evidence:
        return replace(infrared_evidence(*given), share=next(shares))

    monkeypatch.setattr(infrared_surface, "infrared_evidence", doubted)
    made = reconstruct(replace(dotted, views=dotted.views[:1]), depth="infrared")

    assert report_json(made, 1.0)["depth"]["source"] == "infrared"
    (told,) = [warning for warning in made.warnings if "infrared" in warning]
    assert "were trusted on 40% of the foot" in told


def test_a_shifted_picture_is_moved_onto_the_depth_image(dotted: Session) -> None:
    """The depth image lies (4.8, 3.9) px left of and above the infrared picture of a device."""
    v, u = np.mgrid[:480, :640]

    def spot(at: tuple[float, float]) -> FloatArray:
        return 900 * np.exp(-((u - at[0]) ** 2 + (v - at[1]) ** 2) / (2 * 60**2))

    view = with_picture(
        dotted.views[0],
        spot((304.8, 203.9)).astype(np.uint16),
        pattern_of(dotted.views[0].sensor.serial, 0),
    )
    assert view.dots is not None
    seen = infrared_view(replace(view, dots=replace(view.dots, shift_px=(4.8, 3.9))))

    assert seen is not None
    inside = slice(20, 460), slice(20, 620)
    assert np.abs(seen.picture - spot((300, 200)))[inside].max() < 2


def test_why_pictures_are_not_used_is_said_in_the_language_of_the_user(written: Path) -> None:
    view = read_session(written).views[0]
    assert view.dots is not None
    black = with_picture(view, np.zeros((480, 640), np.uint16), pattern_of("SOMEBODY", 3))
    with pytest.raises(InputError) as refused:
        infrared_view(black)
    with kept(written / "views" / view.name) as folder:
        _without(folder)
        dots = read_session(written).views[0].dots
    assert dots is not None
    faults = {"left": refused.value.message, "top": dots.fault}

    first, second = map(translation_into("sv"), infrared_warnings(faults, {}))
    faults = dict.fromkeys(("top", "left"), refused.value.message)
    (both,) = map(translation_into("sv"), infrared_warnings(faults, {}))
    assert first.startswith("Vyn vänster: de infraröda bilderna är svarta; se till att")
    assert both.startswith("Vyerna vänster, uppifrån: de infraröda bilderna är svarta; se till att")
    assert "reference.npz saknas, men sensor.json anger den" in second
    assert all(told.endswith(". Sensorns eget djup användes.") for told in (first, second))


def test_without_any_infrared_is_refused(session: Session) -> None:
    with pytest.raises(ReconstructionError, match=r"No view has infrared .* None were recorded\."):
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


def _far_shifted(view: Path) -> None:
    _shift(view, 400)


def _far_moved(view: Path) -> None:
    _write(view, "infrared_moved_raw", 4000)


def _shift(view: Path, px: float) -> None:
    _write(view, "infrared_shift_px", [px, 3.9])


def _write(view: Path, key: str, value: Any) -> None:
    values = json.loads((view / "sensor.json").read_text())
    (view / "sensor.json").write_text(json.dumps({**values, key: value}))


@contextmanager
def kept(view: Path) -> Iterator[Path]:
    """Let the files of a view be spoilt for a while."""
    contents = {path: path.read_bytes() for path in view.iterdir()}
    try:
        yield view
    finally:
        for path, content in contents.items():
            path.write_bytes(content)


@pytest.fixture(scope="module")
def written(dotted: Session, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The session as a folder, one view with its infrared picture."""
    folder = tmp_path_factory.mktemp("written") / "session"
    first, *others = (replace(view, dots=None) for view in dotted.views)
    dots = dotted.views[0].dots
    assert dots is not None
    first = replace(first, dots=replace(dots, moved_raw=0.125))
    write_session(replace(dotted, views=(first, *others)), folder)
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
    assert after.moved_raw == 0.125
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
        (_far_shifted, "infrared_shift_px"),
        (_far_moved, "infrared_moved_raw"),
    ],
)
def test_what_is_wrong_with_infrared_spoils_no_session(
    spoil: Callable[[Path], None], sentence: str, written: Path
) -> None:
    with kept(written / "views" / read_session(written).views[0].name) as folder:
        spoil(folder)
        view = read_session(written).views[0]

    assert view.dots is not None
    assert sentence in view.dots.fault
    with pytest.raises(InputError, match=re.escape(sentence)):
        infrared_view(view)


def test_a_copy_keeps_what_is_beside_a_fault(written: Path, tmp_path: Path) -> None:
    with kept(written / "views" / read_session(written).views[0].name) as folder:
        _foreign(folder)
        _shift(folder, 4.8)
        session = read_session(written)
        write_session(session, tmp_path / "copy")
    before, after = session.views[0].dots, read_session(tmp_path / "copy").views[0].dots

    assert before is not None
    assert after is not None
    assert after.reference is not None
    assert after.reference.record.serial == "SOMEBODY"
    assert after.shift_px == before.shift_px == (4.8, 3.9)
    assert after.moved_raw == before.moved_raw == 0.125
    assert after.pictures is not None
    assert "is the pattern of sensor SOMEBODY" in after.fault
