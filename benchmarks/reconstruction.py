"""`fused` beside `thesis` and Open3D: accuracy, its floor, seconds per step, growth with input.

``python -c "import benchmarks.reconstruction as b; b.main('SESSION', …)"`` measures recorded
sessions with their truth; ``main()`` simulates one. Accuracy is the mean distance in place of the
surface from the truth where that faces the ground (mm), its 95 % value, and the share of the true
sole within 1.5 mm of the surface. Where a view's folder holds `true_correction.npz`, the device's
true distortion, the floor is shown with it too.
"""

from __future__ import annotations

import tempfile
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path

import numpy as np
import trimesh
from scipy.spatial import cKDTree

from benchmarks._measure import print_table, recorded_session, run_process
from benchmarks._open3d_peers import Peer, open3d_peers, readings_of, with_true_poses
from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.ray_casting import RayCaster
from insole_core.reconstruct import reconstruct
from insole_core.reconstruct.fusion.depth_view import DepthView
from insole_core.reconstruct.fusion.fused_surface import fuse
from insole_core.reconstruct.fusion.prepared_view import PreparedView, prepare
from insole_core.recording.reader import read_session
from insole_core.recording.session import Session, View
from insole_core.sensing.correction import load_correction

REPEATS = 3
LIMITS = {
    "frames": "decoding PNG; comparing ten frames with the first for motion",
    "markers": "connected components of 1.3 Mpx; pairs of triangles",
    "cutting out": "colours of the picture, told apart",
    "surface": "factorising the normal equations (SuperLU, one core); meshing",
}
FINAL_S = 0.8


@dataclass(frozen=True)
class Truth:
    """Samples of the true surface that face the ground, and all of them to measure against."""

    mesh: TriangleMesh
    places: FloatArray
    normals: FloatArray
    is_sole: np.ndarray

    @staticmethod
    def of(folder: Path) -> Truth:
        loaded = trimesh.load(folder / "truth.ply", process=False, force="mesh")
        places, face = trimesh.sample.sample_surface(loaded, 400_000, seed=1)
        normals = loaded.face_normals[face]
        mesh = TriangleMesh(np.asarray(loaded.vertices), np.asarray(loaded.faces, np.int32))
        is_sole = (normals[:, 2] < -0.5) & (places[:, 2] < 30)
        return Truth(mesh, np.asarray(places), np.asarray(normals), is_sole)

    def figures(self, mesh: TriangleMesh) -> list[str]:
        sample, _ = trimesh.sample.sample_surface(
            trimesh.Trimesh(mesh.vertices, mesh.triangles, process=False), 200_000, seed=2
        )
        apart, nearest = cKDTree(self.places).query(sample)
        # Measured across the surface: the nearest sample would be as coarse as the sampling.
        way = sample - self.places[nearest]
        distance = np.abs(np.einsum("nc,nc->n", way, self.normals[nearest]))
        distance = np.where(apart < 5, distance, apart)
        own = distance[self.is_sole[nearest] & (apart < 15)]
        complete = cKDTree(sample).query(self.places[self.is_sole], distance_upper_bound=1.5)[0]
        return [
            f"{own.mean():.3f}",
            f"{np.percentile(own, 95):.2f}",
            f"{np.isfinite(complete).mean():.3f}",
            f"{np.mean(apart > 5):.4f}",
        ]


def main(*folders: str) -> None:
    with tempfile.TemporaryDirectory() as scratch:
        paths = [Path(folder) for folder in folders] or [recorded_session(Path(scratch))]
        # First of all: a new process counts what its parent holds, and Open3D holds much.
        for path in paths:
            cost = run_process(["reconstruct", str(path), "--out", str(Path(scratch) / "foot.ply")])
            print(f"Whole process, {path.name}: {cost.seconds:.2f} s, {cost.peak_mb:.0f} MB")
        for path in paths:
            print(f"\n-- {path.name} --")
            _compare(path)
        _growth(read_session(paths[0]))


def _compare(path: Path) -> None:
    session = _in_memory(read_session(path))
    truth = Truth.of(path)
    readings = readings_of(session)
    rows = []
    for method in ("fused", "thesis"):
        seconds = _best(partial(reconstruct, session, method))
        rows.append([method, *truth.figures(reconstruct(session, method).mesh), *seconds])
    for name, peer in open3d_peers().items():
        seconds = _best(partial(_fused_by, peer, session))
        rows.append([name, *truth.figures(peer(readings)), *seconds])
    for name, floor in _floors(session, readings, path, truth):
        rows.append([name, *truth.figures(fuse(floor).mesh), "", ""])
    head = ["", "error mean", "p95", "complete", "stray", "s after reading", "processor s"]
    print_table(head, rows)
    _steps(session)


def _steps(session: Session) -> None:
    """Print the seconds of every step; frames, markers and segmentation treat views in parallel."""
    whole = []
    for _ in range(REPEATS):
        start = time.perf_counter()
        result = reconstruct(session)
        whole.append(time.perf_counter() - start)
    rows = [[step, f"{spent:.2f}", LIMITS[step]] for step, spent in result.seconds.items()]
    print_table(["step", "seconds, all views", "what limits it"], rows)
    print_table(["after the files are read", "limit"], [[f"{min(whole):.2f}", FINAL_S]])


def _floors(
    session: Session, readings: list[DepthView], path: Path, truth: Truth
) -> Iterator[tuple[str, list[PreparedView]]]:
    """Yield what `fused` would start from if it knew more."""
    placed = with_true_poses(readings, path)
    yield "floor: true poses", [prepare(one) for one in placed]
    files = [path / "views" / view.name / "true_correction.npz" for view in session.views]
    if all(file.exists() for file in files):
        views = [_recalibrated(view, file) for view, file in zip(session.views, files, strict=True)]
        known = readings_of(replace(session, views=tuple(views)))
        known = with_true_poses(known, path)
        yield "floor: and true distortion", [prepare(one) for one in known]
    without = [prepare(_exact(one, truth.mesh), corrected=False) for one in placed]
    yield "floor: and depth without error", without


def _recalibrated(view: View, file: Path) -> View:
    return replace(view, sensor=replace(view.sensor, correction=load_correction(file)))


def _growth(session: Session) -> None:
    """Print how the time grows with the number of views and frames, which are repeated."""
    rows = []
    for views in (3, 6, 8):
        many = [
            replace(session.views[i % len(session.views)], name=f"view_{i}") for i in range(views)
        ]
        grown = _in_memory(replace(session, views=tuple(many)))
        rows.append([f"{views} views, 10 frames", *_timed(grown)])
    for frames in (30, 100):
        longer = [
            replace(view, depth_count=frames, read_depth=_cycled(view)) for view in session.views
        ]
        rows.append(
            [
                f"{len(longer)} views, {frames} frames",
                *_timed(replace(session, views=tuple(longer))),
            ]
        )
    print_table(["", "processor s"], rows)


def _cycled(view: View) -> Callable[[int], np.ndarray]:
    frames = [view.read_depth(index) for index in range(view.depth_count)]
    return lambda index: frames[index % len(frames)]


def _timed(session: Session) -> list[str]:
    start = time.process_time()
    reconstruct(session)
    return [f"{time.process_time() - start:.2f}"]


def _fused_by(peer: Peer, session: Session) -> None:
    peer(readings_of(session))


def _best(call: Callable[[], object]) -> list[str]:
    """Return the least wall time and processor time, which other work disturbs less."""
    wall, processor = [], []
    for _ in range(REPEATS):
        start = time.perf_counter(), time.process_time()
        call()
        wall.append(time.perf_counter() - start[0])
        processor.append(time.process_time() - start[1])
    return [f"{min(wall):.2f}", f"{min(processor):.2f}"]


def _in_memory(session: Session) -> Session:
    """Return the session with its pictures decoded, so that reading does not count."""

    def kept(view: View) -> View:
        colors = [view.read_color(index) for index in range(view.color_count)]
        return replace(view, read_depth=_cycled(view), read_color=colors.__getitem__)

    return replace(session, views=tuple(kept(view) for view in session.views))


def _exact(reading: DepthView, truth: TriangleMesh) -> DepthView:
    """Return the reading without any error, where the sensor read something."""
    rays = reading.rays.reshape(-1, 3)
    hits = RayCaster(truth).cast(reading.origin_mm, rays)
    corners = truth.vertices[truth.triangles[hits.triangle]]
    places = np.einsum("nk,nkc->nc", hits.weights, corners)
    raw = np.full(reading.raw.shape, np.nan)
    raw.flat[hits.ray] = reading.sensor.disparity.raw(reading.depth_along(places))
    return reading.with_raw(np.where(reading.known, raw, np.nan))
