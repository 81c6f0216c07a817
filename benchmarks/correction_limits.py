"""The learnt correction where nothing was learnt: other objects, seen by other matchers.

Balls, cylinders, boxes, steps, casts with flat cuts, feet without forefoot, in a sock, in a shoe;
by windows of 7 x 7 and 11 x 11 pixels and random dots, which training never saw. The error of
single readings along the surface's normal, without and with the correction; a common offset of a
view is not counted, as nobody can see it in a picture. Never may it be worse by more than 0.02 mm
in the mean or 0.1 mm at 95 %.
"""

from __future__ import annotations

from collections.abc import Iterator

import manifold3d
import numpy as np
import trimesh

from benchmarks._measure import print_table
from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.transforms import rotation_about
from insole_core.reconstruct.fusion.matching_error import MatchingModel, matching_error
from insole_core.simulate.block_matching import Matcher
from training.feet import varied_foot
from training.views import seen_by_stations

WORSE_MEAN_MM, WORSE_95_MM = 0.02, 0.1
MATCHERS = {
    "as real": Matcher(),
    "7 x 7": Matcher((7, 7), px_per_dot=9.0),
    "11 x 11": Matcher((11, 11), px_per_dot=9.0),
}
DISTANCE_MM = 780.0
OUTLIER_RAW, LEAST_COSINE = 8.0, 0.3


def main() -> None:
    model, rows, failed = MatchingModel.load(), [], []
    for name, thing in things():
        row = [name]
        for matcher_name, matcher in MATCHERS.items():
            without, left = errors_mm(thing, matcher, model)
            mean, most = (f(left) - f(without) for f in (np.mean, _at_95))
            row.append(f"{np.mean(without):.2f}{mean:+.3f}  {_at_95(without):.2f}{most:+.2f}")
            if mean > WORSE_MEAN_MM or most > WORSE_95_MM:
                failed.append(f"{name}, {matcher_name}")
        rows.append(row)
        print(".", end="", flush=True)
    print()
    print_table(("mean and 95 %, mm, and change", *MATCHERS), rows)
    if failed:
        raise SystemExit(f"worse with the correction: {'; '.join(failed)}")


def errors_mm(
    thing: TriangleMesh, matcher: Matcher, model: MatchingModel
) -> tuple[FloatArray, FloatArray]:
    """Return the errors (n,) of the readings without and with the correction."""
    without: list[FloatArray] = []
    left: list[FloatArray] = []
    rng = np.random.default_rng(11)
    for example, sensor in seen_by_stations(thing, DISTANCE_MM, matcher, rng):
        error_raw = example.raw - example.true_raw
        used = (np.abs(error_raw) < OUTLIER_RAW) & (example.cosine > LEAST_COSINE)
        step = sensor.disparity.depth_mm(example.true_raw + 1)
        mm = (step - sensor.disparity.depth_mm(example.true_raw)) * example.cosine
        foretold = matching_error(example.raw, example.shading, example.pixel_mm, model)
        for listed, raw in ((without, error_raw), (left, error_raw - foretold)):
            values = (raw * mm)[used]
            listed.append(np.abs(values - np.median(values)))
    return np.concatenate(without), np.concatenate(left)


def _at_95(values: FloatArray) -> float:
    return float(np.quantile(values, 0.95))


def things() -> Iterator[tuple[str, TriangleMesh]]:
    """Yield names and surfaces, mm, where a foot would be; the feet are for comparison."""
    foot = varied_foot(np.random.default_rng(9001))
    low, high = foot.bounds_mm
    ahead = float(high[1] - low[1])
    yield "foot", foot
    for radius in (50, 105):
        ball = trimesh.creation.icosphere(subdivisions=5, radius=radius)
        yield f"ball of {radius} mm", _grey(ball, (0, 0, radius - 5))
    for radius in (40, 70):
        pipe = trimesh.creation.cylinder(radius, 240, sections=200)
        yield f"cylinder of {radius} mm", _grey(pipe, (0, 0, radius - 5), (90, 0))
    yield "box", _grey(trimesh.creation.box((90, 230, 60)), (0, 0, 25))
    yield "box on its edge", _grey(trimesh.creation.box((90, 230, 60)), (0, 0, 40), (0, 30))
    for height in (6, 12, 25):
        yield f"steps of {height} mm", _steps(height)
    yield "cast, cut flat", _cut(foot, low[1] + 0.62 * ahead, (0, -1, 0))
    yield "forefoot missing", _cut(foot, low[1] + 0.68 * ahead, (0.3, -1, 0.2))
    yield "toes missing", _cut(foot, low[1] + 0.8 * ahead, (0, -1, 0.3))
    body = trimesh.Trimesh(foot.vertices, foot.triangles)
    body.vertices = body.vertices + 1.5 * body.vertex_normals
    yield "sock", _grey(trimesh.smoothing.filter_laplacian(body, iterations=60))
    yield "shoe", _shoe(foot)


def _grey(
    thing: trimesh.Trimesh,
    middle_mm: tuple[float, float, float] = (0, 0, 0),
    turned_deg: tuple[float, float] = (0, 0),
) -> TriangleMesh:
    turn = np.eye(3)
    for axis, angle in zip(np.eye(3)[:2], turned_deg, strict=True):
        turn = rotation_about(axis, angle) @ turn
    vertices = np.asarray(thing.vertices) @ turn.T + middle_mm
    colors = np.full((len(vertices), 3), 160, np.uint8)
    return TriangleMesh(vertices, np.asarray(thing.faces, np.int32), colors)


def _steps(height_mm: float) -> TriangleMesh:
    boxes = [
        trimesh.creation.box(
            (100 - 12 * n, 230 - 50 * n, height_mm),
            transform=trimesh.transformations.translation_matrix([0, 8 * n, 50 - height_mm * n]),
        )
        for n in range(4)
    ]
    return _grey(trimesh.util.concatenate(boxes))


def _cut(foot: TriangleMesh, at_mm: float, keep: tuple[float, float, float]) -> TriangleMesh:
    normal = np.array(keep) / np.linalg.norm(keep)
    whole = trimesh.Trimesh(foot.vertices, foot.triangles)
    triangles = np.asarray(whole.faces, np.uint32)
    body = manifold3d.Manifold(manifold3d.Mesh(np.asarray(whole.vertices, np.float32), triangles))
    part = body.trim_by_plane(tuple(normal), float(normal @ [0, at_mm, 0])).to_mesh()
    return _grey(trimesh.Trimesh(part.vert_properties[:, :3], part.tri_verts))


def _shoe(foot: TriangleMesh) -> TriangleMesh:
    upper = trimesh.Trimesh(foot.vertices, foot.triangles).convex_hull
    low, high = upper.bounds
    move = trimesh.transformations.translation_matrix
    middle = (low + high) / 2
    sole = trimesh.creation.box(
        (*(high - low)[:2] + 12, 8), transform=move([*middle[:2], low[2] + 4])
    )
    heel = trimesh.creation.box((60, 60, 15), transform=move([middle[0], low[1] + 30, low[2] - 6]))
    return _grey(trimesh.util.concatenate([upper, sole, heel]))
