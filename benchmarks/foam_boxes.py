"""Foam boxes made from 20 simulated feet and the real ones: how near the imprints come to the feet.

    python -m benchmarks foam_boxes

Every box is drawn at random (depth 15 to 40 mm, edge of the foam, noise of the scanner, what it
does not see, points 0.6 to 1.2 mm apart, closed block, carton, table) and lies in any pose; a foot
is tilted by up to 4 degrees while it is pressed in. Limits: the supporting part of the sole lies
within 0.3 mm of the foot, in the median and for 95 % of it; every side is right or told as unsure.
FEET=n asks for fewer feet.
"""

from __future__ import annotations

import os
import time
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from scipy.spatial import cKDTree
from scipy.spatial.transform import Rotation

from benchmarks._measure import print_table
from insole_core.errors import InsoleError
from insole_core.foot.foot_placement import placed_foot
from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.sampling import sample_triangles
from insole_core.geometry.side import Side
from insole_core.geometry.transforms import rigid
from insole_core.scans.mesh_file import ReadMesh
from insole_core.simulate.foam_box import DOUBLE_MM, SINGLE_MM, FoamBox, press_feet, pressing
from insole_core.simulate.foot_model import build_foot
from insole_core.simulate.foot_shape import vary_shape
from insole_core.workflows.import_scan import examine_surface
from insole_core.workflows.open_scan import open_scan

FEET = int(os.environ.get("FEET", "20"))
SHARED = Path(__file__).resolve().parents[2] / "shared" / "data" / "feet"
REAL = (
    ("dupontgu/left_foot.stl", Side.LEFT), ("dupontgu/right_foot.stl", Side.RIGHT),
    ("focus_template/template.obj", Side.LEFT), ("plantar_scan.obj", Side.RIGHT),
)  # fmt: skip
LIMIT_MM, SUPPORTING = 0.3, -0.8


@dataclass(frozen=True, eq=False)
class StandingFoot:
    """A foot that stands at z = 0, its middle above the origin, toes towards +y."""

    name: str
    side: Side
    mesh: TriangleMesh


def simulated(number: int) -> StandingFoot:
    rng = np.random.default_rng(1000 + number)
    side = Side.RIGHT if number % 2 else Side.LEFT
    return StandingFoot(f"simulated {number}", side, build_foot(vary_shape(rng, side), rng).mesh)


def real_feet() -> Iterator[StandingFoot]:
    for name, side in REAL:
        if (SHARED / name).is_file():
            foot = open_scan(SHARED / name, side).foot
            middle = rigid(np.eye(3), np.array([0.0, -foot.length_mm / 2, 0.0]))
            yield StandingFoot(name, side, foot.mesh.transformed(middle))


def random_box(size_mm: tuple[float, float], rng: np.random.Generator) -> FoamBox:
    is_closed = bool(rng.random() < 0.3)
    return FoamBox(
        size_mm,
        curl_mm=rng.uniform(2, 7),
        lip_mm=0.0 if is_closed else float(rng.choice([0.0, 6.0])),
        cell_mm=rng.uniform(0.6, 1.2),
        unseen=rng.uniform(0, 0.5),
        is_closed=is_closed,
        table_mm=0.0 if is_closed else float(rng.choice([0.0, 0.0, 120.0])),
    )


def in_foam(foot: StandingFoot, place_mm: FloatArray, rng: np.random.Generator) -> TriangleMesh:
    """Return a foot where it is pressed in, box frame."""
    tilt = Rotation.from_rotvec([*np.radians(rng.uniform(-4, 4, 2)), 0.0]).as_matrix()
    tilted = foot.mesh.transformed(rigid(tilt, np.zeros(3)))
    lowest = float(tilted.vertices[:, 2].min())
    yaw_deg = rng.uniform(0, 12) * foot.side.medial_sign
    depth_mm = rng.uniform(15, 40) + lowest
    return tilted.transformed(pressing(depth_mm, (place_mm[0], place_mm[1]), yaw_deg))


def measured(
    title: str, feet: list[StandingFoot], size_mm: tuple[float, float], rng: np.random.Generator
) -> Iterator[list[str]]:
    """Yield a row for each foot of one box."""
    aside = 0.0 if len(feet) == 1 else size_mm[0] / 4
    places = [(-foot.side.medial_sign * aside, rng.uniform(-6, 6)) for foot in feet]
    pressed = [in_foam(f, np.array(p), rng) for f, p in zip(feet, places, strict=True)]
    box = random_box(size_mm, rng)
    turn = rigid(Rotation.random(random_state=rng).as_matrix(), rng.uniform(-300, 300, 3))
    scan = press_feet(pressed, box, rng).transformed(turn)
    start = time.process_time()
    try:
        examination = examine_surface(Path("box.ply"), ReadMesh(scan, "mm", 1.0, ""))
    except InsoleError as error:
        yield [title, "", "", "refused", str(error)[:60], "", "", "", ""]
        return
    seconds = time.process_time() - start
    by_place = {
        foot.side: shown.transformed(turn) for foot, shown in zip(feet, pressed, strict=True)
    }
    for found in examination.feet:
        candidate = found.candidates[0]
        truth = by_place.get(candidate.side) if len(feet) > 1 else next(iter(by_place.values()))
        true_side = candidate.side if len(feet) > 1 else feet[0].side
        told = "asked" if found.doubts else "sure"
        assert truth is not None
        sole = placed_foot(found, candidate)
        away = deviations_mm(found.mesh, truth, candidate.source2insole[2, :3])
        depth = max(-shown.vertices[:, 2].min() for shown in pressed)
        right = (
            "right" if candidate.side is true_side and nearest_is(found.mesh, truth) else "WRONG"
        )
        within = np.median(away) <= LIMIT_MM and np.quantile(away, 0.95) <= LIMIT_MM
        yield [
            title,
            f"{'closed' if box.is_closed else 'open'}{', table' if box.table_mm else ''}",
            f"{depth:.0f}",
            right,
            told,
            f"{sole.length_mm - length_of(truth, candidate.source2insole):+.1f}",
            f"{np.median(away):.2f}",
            f"{np.quantile(away, 0.95):.2f}" + ("" if within else " MISSED"),
            f"{seconds:.1f}",
        ]


def nearest_is(sole: TriangleMesh, foot: TriangleMesh) -> bool:
    """Return whether a sole lies at a foot, and not at the other one of the box."""
    return float(np.median(cKDTree(foot.vertices).query(sole.vertices[::20])[0])) < 5


def length_of(foot: TriangleMesh, source2insole: FloatArray) -> float:
    along = foot.vertices @ source2insole[1, :3]
    height = foot.vertices @ source2insole[2, :3]
    return float(np.ptp(along[height < height.min() + 45.0]))


def deviations_mm(sole: TriangleMesh, foot: TriangleMesh, up: FloatArray) -> FloatArray:
    """Return the distances of the supporting points of a sole from the foot."""
    points = sole.vertices[sole.vertex_normals @ up < SUPPORTING]
    samples = sample_triangles(foot, 0.5)
    nearest = cKDTree(samples.points).query(points)[1]
    normals = foot.triangle_normals[samples.triangle[nearest]]
    return np.asarray(np.abs(np.einsum("ij,ij->i", points - samples.points[nearest], normals)))


def boxes() -> Iterator[tuple[str, list[StandingFoot], tuple[float, float]]]:
    feet = [simulated(number) for number in range(FEET)]
    for foot in feet:
        yield foot.name, [foot], SINGLE_MM
    for left, right in zip(feet[::2], feet[1::2], strict=False):
        yield f"{left.name} + {right.name.split()[-1]}", [left, right], DOUBLE_MM
    real = list(real_feet())
    for foot in real:
        yield foot.name, [foot], SINGLE_MM
    if len(real) >= 2:
        yield "dupontgu, both", real[:2], DOUBLE_MM


def main() -> None:
    rows = []
    for number, (title, feet, size_mm) in enumerate(boxes()):
        rows += list(measured(title, feet, size_mm, np.random.default_rng(number)))
    head = (
        "feet", "box", "mm deep", "side", "told", "length mm", "median mm", "95 % mm", "CPU s",
    )  # fmt: skip
    print_table(head, rows)
    wrong = [row for row in rows if row[3] != "right" and row[4] == "sure"]
    missed = [row for row in rows if "MISSED" in row[7] or row[3] == "refused"]
    print(
        f"{len(rows)} feet; limit {LIMIT_MM} mm missed by {len(missed)}; wrong side without a "
        f"word: {len(wrong)}; asked: {sum(row[4] == 'asked' for row in rows)}"
    )
