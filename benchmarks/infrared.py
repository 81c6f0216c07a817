"""Feet reconstructed by the chip's depth and by infrared pictures, before simulated Kinects.

``python -m benchmarks infrared`` simulates 20 feet of three origins, 705 to 790 mm away, in four
sets of sensors, each with walls from which its dots are learnt: from 12 of them, from 8 and from 4.
A foot of each set is captured again under every disturbance of
`insole_core.simulate.surroundings`, and reconstructed with a pattern that is 0.1 px off. Sessions,
patterns and figures are kept in ``benchmarks/results/infrared`` and are not made twice, figures
while the reconstruction is the same.

``FEET`` is the number of feet (20), ``ONLY`` a comma-separated choice of conditions, each then on
all feet. Sole and tendon: mean and 95 % of the distance after a rigid best fit (shape), mean in
place, share of the sole within 1.5 mm, mm. Of each view: on which share of the foot bright light or
noise was found, and how many views were told for it.
"""

from __future__ import annotations

import hashlib
import json
import os
from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path
from typing import NamedTuple

import numpy as np
import trimesh
from scipy.spatial import cKDTree
from scipy.spatial.transform import Rotation

from benchmarks._measure import print_table
from benchmarks._scan_variants import SHARED
from benchmarks.measures import body_of
from insole_core.calibration.infrared.infrared_walls import read_infrared_walls
from insole_core.calibration.infrared.learnt_reference import learn_reference
from insole_core.foot.foot_placement import place_foot
from insole_core.geometry.arrays import FloatArray, IntArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.side import Side
from insole_core.reconstruct import Reconstruction, reconstruct
from insole_core.reconstruct.views.infrared_pictures import doubted
from insole_core.recording.reader import read_session
from insole_core.recording.session import DotPictures, Session, View
from insole_core.recording.writer import write_session
from insole_core.scans.mesh_file import read_mesh
from insole_core.sensing.correction import DisparityCorrection
from insole_core.sensing.infrared_reference import InfraredReference, load_reference
from insole_core.simulate import SimulationOptions, simulate_session
from insole_core.simulate.infrared_walls import write_walls
from insole_core.simulate.known_bodies import KnownBody
from insole_core.simulate.surroundings import DISTURBANCES

KEPT = Path(__file__).parent / "results" / "infrared"
FEET = int(os.environ.get("FEET", "20"))
ONLY = os.environ.get("ONLY", "")
WALLS = 12
_SETS = ((901, 705.0), (902, 730.0), (903, 760.0), (904, 790.0))
"""Seed of the sensors, and their distance from the foot (mm)."""
_FRAMES = 6
_LEARNT_FROM = {"12 walls": 12, "8 walls": 8, "4 walls": 4}
_OFF = "pattern off"
_OFF_RAW = 0.8
_SOURCES = (
    # file, side, scale, mirrored
    ("dupontgu/right_foot.stl", Side.RIGHT, (1.0, 1.0, 1.0), False),
    ("focus_template/template.obj", Side.LEFT, (1.0, 1.0, 1.0), True),
    ("dupontgu/right_foot.stl", Side.RIGHT, (0.94, 0.97, 1.08), True),
    ("focus_template/template.obj", Side.LEFT, (1.05, 0.96, 1.0), False),
)
_PRODUCT = ("calibration/infrared", "reconstruct", "sensing")


@dataclass(frozen=True)
class Captured:
    """A foot before a set of sensors, under a condition: ``12 walls``, ``sunlight`` …"""

    number: int
    condition: str

    @property
    def sensors(self) -> tuple[int, float]:
        return _SETS[self.number % len(_SETS)]

    @property
    def disturbance(self) -> str:
        return self.condition if self.condition in DISTURBANCES else ""

    @property
    def folder(self) -> Path:
        return KEPT / f"foot_{self.number:02d}{self.disturbance and '_' + self.disturbance}"


class Doubts(NamedTuple):
    """Shares of the foot on which the pictures of its views count less, and the views told."""

    bright: list[float]
    noisy: list[float]
    told: int


class Compared(NamedTuple):
    """Figures of a foot by chip and by infrared, and how far its pictures were trusted."""

    chip: dict[str, float]
    infrared: dict[str, float]
    doubts: Doubts


def main() -> None:
    KEPT.mkdir(parents=True, exist_ok=True)
    rows: dict[str, list[Compared]] = {}
    for captured in _captured():
        rows.setdefault(captured.condition, []).append(compared(captured))
        print(".", end="", flush=True)
    print()
    head = ["mm, chip → infrared", "feet", *next(iter(rows.values()))[0].chip, "worst foot by"]
    print_table(head, [_row(name, feet) for name, feet in rows.items()])
    print_table(
        ["pictures", "views", "bright", "noisy", "views told"],
        [_doubts_row(name, [foot.doubts for foot in feet]) for name, feet in rows.items()],
    )


def _captured() -> Iterator[Captured]:
    wanted = set(ONLY.split(",")) if ONLY else {*_LEARNT_FROM, *DISTURBANCES, _OFF}
    for condition in (*_LEARNT_FROM, *DISTURBANCES, _OFF):
        some = FEET if ONLY or condition == "12 walls" else min(FEET, len(_SETS))
        yield from (Captured(number, condition) for number in range(some) if condition in wanted)


def _row(name: str, feet: list[Compared]) -> list[str]:
    means = [
        f"{np.mean([foot.chip[key] for foot in feet]):.3f} → "
        f"{np.mean([foot.infrared[key] for foot in feet]):.3f}"
        for key in feet[0].chip
    ]
    worse = max(foot.infrared["shape"] - foot.chip["shape"] for foot in feet)
    return [name, str(len(feet)), *means, f"{worse:+.3f}"]


def _doubts_row(name: str, feet: list[Doubts]) -> list[str]:
    bright = [share for foot in feet for share in foot.bright]
    noisy = [share for foot in feet for share in foot.noisy]
    ranges = (f"{min(shares):.2f} – {max(shares):.2f}" for shares in (bright, noisy))
    return [name, str(len(bright)), *ranges, str(sum(foot.told for foot in feet))]


def compared(captured: Captured) -> Compared:
    """Reconstruct a foot by chip and by infrared."""
    kept = KEPT / "figures" / f"{captured.number:02d}_{captured.condition}_{_product()}.json"
    if not kept.exists():
        session = with_patterns(_session(captured), captured)
        truth = trimesh.load(captured.folder / "truth.ply", process=False, force="mesh")
        chip, infrared = (reconstruct(session, depth=depth) for depth in ("chip", "infrared"))
        found = [figures(made.mesh, truth) for made in (chip, infrared)]
        _keep(kept, json.dumps([*found, _doubts(infrared)]))
    by_chip, by_infrared, doubts = json.loads(kept.read_text())
    return Compared(by_chip, by_infrared, Doubts(*doubts))


def _doubts(made: Reconstruction) -> Doubts:
    uses = made.infrared.values()
    told = sum(map(len, doubted(made.infrared).values()))
    return Doubts([use.bright for use in uses], [use.noisy for use in uses], told)


def _product() -> str:
    """Return a digest of the code that the figures depend on."""
    core = Path(__file__).parents[1] / "insole_core"
    files = [path for part in _PRODUCT for path in sorted((core / part).rglob("*.py"))]
    return hashlib.sha256(b"".join(path.read_bytes() for path in files)).hexdigest()[:12]


def _keep(path: Path, text: str) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    beside = path.with_suffix(".part")
    beside.write_text(text)
    beside.replace(path)


def _options(captured: Captured) -> SimulationOptions:
    seed, distance_mm = captured.sensors
    return SimulationOptions(
        seed=1000 + captured.number,
        sensor_seed=seed,
        side=_side(captured.number),
        distance_mm=distance_mm,
        body=_body(captured.number),
        infrared_frames=_FRAMES,
        disturbances=tuple(kind for kind in DISTURBANCES if kind == captured.disturbance),
    )


def _is_of_chance(number: int) -> bool:
    """Of five feet, the first three are feet of chance."""
    return number // len(_SETS) < 3


def _source(number: int) -> tuple[str, Side, tuple[float, float, float], bool]:
    return _SOURCES[(number // len(_SETS) + number) % len(_SOURCES)]


def _side(number: int) -> Side:
    if _is_of_chance(number):
        return list(Side)[number % 2]
    _, side, _, mirrored = _source(number)
    return side.other if mirrored else side


def _body(number: int) -> KnownBody | None:
    if _is_of_chance(number):
        return None
    file, side, scale, mirrored = _source(number)
    mesh = place_foot(read_mesh(SHARED / file).mesh, side, frame="unknown").mesh
    mesh = TriangleMesh(mesh.vertices * scale, mesh.triangles)
    return body_of(mesh.mirrored() if mirrored else mesh, _side(number))


def _session(captured: Captured) -> Session:
    if not captured.folder.exists():
        made = simulate_session(_options(captured))
        write_session(made.session, captured.folder, made.truth, made.sensor2reference)
    return read_session(captured.folder)


def with_patterns(session: Session, captured: Captured) -> Session:
    """Give every view the pattern of its sensor, as the condition has it."""

    def given(view: View) -> View:
        reference = _reference(captured, view)
        if captured.condition == _OFF:
            offset = reference.correction.offset + np.float32(_OFF_RAW)
            reference = replace(reference, correction=DisparityCorrection(offset))
        assert view.dots is not None
        return replace(view, dots=DotPictures(view.dots.pictures, reference))

    return replace(session, views=tuple(map(given, session.views)))


def _reference(captured: Captured, view: View) -> InfraredReference:
    count = _LEARNT_FROM.get(captured.condition, WALLS)
    seed, _ = captured.sensors
    path = KEPT / f"patterns_{seed}" / f"{view.sensor.serial}_{count}_{_learning()}.npz"
    if not path.exists():
        walls = KEPT / f"walls_{seed}"
        if not walls.exists():
            write_walls(_options(captured), WALLS, walls)
        folder = walls / view.sensor.serial
        all_walls = read_infrared_walls(folder, view.sensor.serial)
        chosen = np.rint(np.linspace(0, WALLS - 1, count)).astype(int)
        learnt = learn_reference([all_walls[index] for index in chosen], view.sensor)
        path.parent.mkdir(parents=True, exist_ok=True)
        learnt.reference.save(path)
    return load_reference(path)


def _learning() -> str:
    folder = Path(__file__).parents[1] / "insole_core" / "calibration" / "infrared"
    content = b"".join(path.read_bytes() for path in sorted(folder.glob("*.py")))
    return hashlib.sha256(content).hexdigest()[:8]


def figures(surface: TriangleMesh, truth: trimesh.Trimesh) -> dict[str, float]:
    """Judge a foot against its truth; regions as the truth has them."""
    mesh = trimesh.Trimesh(surface.vertices, surface.triangles, process=False)
    points = np.asarray(trimesh.sample.sample_surface(mesh, 60_000, seed=1)[0])
    places, face = trimesh.sample.sample_surface(truth, 300_000, seed=2)
    normals = truth.face_normals[face]
    tree = cKDTree(places)
    sole = (normals[:, 2] < -0.5) & (places[:, 2] < 30)
    tendon = (normals[:, 1] < -0.5) & (places[:, 2] > 25) & (places[:, 2] < 150)
    fitted = _fitted(points, tree, normals)
    near, far = (_distances(some, tree, normals) for some in (points, fitted))
    gone = cKDTree(points).query(places[sole], distance_upper_bound=1.5)[0]
    shape = far[1][sole[far[0]]]
    return {
        "shape": float(shape.mean()),
        "95 %": float(np.percentile(shape, 95)),
        "in place": float(near[1][sole[near[0]]].mean()),
        "complete": float(np.isfinite(gone).mean()),
        "Achilles": float(far[1][tendon[far[0]]].mean()),
    }


def _distances(
    points: FloatArray, tree: cKDTree, normals: FloatArray
) -> tuple[IntArray, FloatArray]:
    """Return the nearest sample of the truth, and the distance across its surface, mm."""
    apart, nearest = _nearest(points, tree)
    way = points - tree.data[nearest]
    across = np.abs(np.einsum("nc,nc->n", way, normals[nearest]))
    return nearest, np.where(apart < 3, across, np.minimum(apart, 15))


def _nearest(points: FloatArray, tree: cKDTree) -> tuple[FloatArray, IntArray]:
    apart, nearest = tree.query(points)
    return np.asarray(apart), np.asarray(nearest)


def _fitted(points: FloatArray, tree: cKDTree, normals: FloatArray, rounds: int = 10) -> FloatArray:
    """Move points rigidly to the truth, point to plane; what is farther than 3 mm has no say."""
    for _ in range(rounds):
        some = points[::4]
        apart, nearest = _nearest(some, tree)
        use = apart < 3
        normal, place = normals[nearest[use]], some[use]
        off = np.einsum("nc,nc->n", place - tree.data[nearest[use]], normal)
        rows = np.c_[np.cross(place, normal), normal]
        step = np.linalg.lstsq(rows, -off, rcond=None)[0]
        points = points @ Rotation.from_rotvec(step[:3]).as_matrix().T + step[3:]
    return points
