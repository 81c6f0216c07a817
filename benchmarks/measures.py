"""Measures of reconstructed sessions beside the same measures of their true surfaces.

``main()`` takes the recorded sessions with their truth that lie beside the checkout, and simulates
others: of feet of chance, and of real feet and a template that stand in the simulated place, as
they are and varied by chance. For
each measure: bias and root mean square of the error, the ± that the product states, and the share
of the sessions in which the truth lies within it. The foot axis
(pternion to the tip of the 2nd toe), which turns everything, is shown as an angle.

``python -c "import benchmarks.measures as b; b.main('SESSION', …)"`` takes the named sessions.
``SIMULATED`` is the number of simulated feet of chance, ``SEED`` the seed of the first one,
``VARIED`` the number of the real feet and templates in other sizes.
"""

from __future__ import annotations

import os
import tempfile
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from benchmarks._measure import print_table
from benchmarks._scan_variants import SHARED
from insole_core.foot.foot import Foot
from insole_core.foot.foot_placement import place_foot
from insole_core.foot.landmarks import find_landmarks
from insole_core.foot.measures import DEFINITIONS, measure
from insole_core.foot.spread import spreads_of
from insole_core.formats.ply import write_ply
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.side import Side
from insole_core.geometry.transforms import inverse, rigid, transform
from insole_core.recording.writer import write_session
from insole_core.scans.mesh_file import read_mesh
from insole_core.simulate import SimulationOptions, simulate_session
from insole_core.simulate.foot_model import paint_skin
from insole_core.simulate.known_bodies import KnownBody
from insole_core.workflows.make_foot import make_foot, open_session

SIMULATED, SEED = int(os.environ.get("SIMULATED", "4")), int(os.environ.get("SEED", "101"))
VARIED = int(os.environ.get("VARIED", "0"))
_RECORDED = ("sessions/*_?", "infrared/*_?")
_AXIS = "foot axis (degrees)"
_DISTANCES_MM = (700, 780, 820, 740)
_OTHERS = (
    # file, side, scale, distance, mirrored
    ("dupontgu/right_foot.stl", Side.RIGHT, (1.0, 1.0, 1.0), 780, False),
    ("dupontgu/right_foot.stl", Side.RIGHT, (0.95, 0.96, 1.1), 690, True),
    ("focus_template/template.obj", Side.LEFT, (1.0, 1.0, 1.0), 760, False),
    ("focus_template/template.obj", Side.LEFT, (1.06, 0.95, 1.0), 800, True),
)
_ORIGINS = (
    ("dupontgu/right_foot.stl", Side.RIGHT),
    ("focus_template/template.obj", Side.LEFT),
    ("foot3d_0044/mesh.obj", Side.LEFT),
    ("dupontgu/left_foot.stl", Side.LEFT),
)
_SCALED = ((0.94, 0.94, 0.93), (1.07, 1.07, 1.1))  # least and most, across, along and upwards


@dataclass(frozen=True)
class Compared:
    """Errors and their stated 95 % limits by measure, of one session."""

    name: str
    errors: dict[str, float]
    limits: dict[str, float]


def main(*folders: str) -> None:
    compared: list[Compared] = []
    with tempfile.TemporaryDirectory() as scratch:
        for folder in [Path(name) for name in folders] or _sessions(Path(scratch)):
            compared.append(compare(folder))
            print(".", end="", flush=True)
    print()
    print_errors(compared)
    lengths = ("foot_length", "ball_width_across", "ball_length", "heel_width", _AXIS)
    print_table(
        ["error of", *lengths],
        [[one.name, *(_signed(one.errors.get(name)) for name in lengths)] for one in compared],
    )


def print_errors(compared: list[Compared]) -> None:
    """Print bias, root mean square, stated ± and what lies within it, for each measure."""
    print_table(
        ["measure", "bias", "rms", "stated ±", "within", "sessions"],
        [row for name in (*DEFINITIONS, _AXIS) if (row := _row(name, compared))],
    )


def compare(folder: Path) -> Compared:
    foot = make_foot(open_session(folder)).scan.foot
    return judged(folder.name, foot, read_mesh(folder / "truth.ply").mesh)


def judged(name: str, foot: Foot, surface: TriangleMesh) -> Compared:
    """Hold the measures of a foot against those of its true surface (reference frame, mm)."""
    truth = place_foot(surface, foot.side, frame="reference")
    marks = find_landmarks(foot)
    found, known = measure(foot, marks), measure(truth, find_landmarks(truth))
    errors = {
        name: value - true
        for name, value in found.items()
        if value is not None and (true := known[name]) is not None
    }
    errors[_AXIS] = _axis_deg(foot) - _axis_deg(truth)
    spreads = spreads_of(marks, is_recorded=True).items()
    limits = {name: s.limits_95 for name, s in spreads if s.limits_95 is not None}
    return Compared(name, errors, limits)


def _axis_deg(foot: Foot) -> float:
    """Return the direction of the foot axis in the frame of the session, > 0 towards medial."""
    marks, insole2source = find_landmarks(foot), inverse(foot.source2insole)
    heel, toe = (transform(insole2source, marks[n].point) for n in ("pternion", "toe_tip_2"))
    across, ahead = (toe - heel)[:2]
    return float(np.degrees(np.arctan2(across * foot.side.medial_sign, ahead)))


def _row(name: str, compared: list[Compared]) -> list[str]:
    errors = np.array([one.errors[name] for one in compared if name in one.errors])
    if len(errors) == 0:
        return []
    stated = np.array([one.limits.get(name, np.nan) for one in compared if name in one.errors])
    known = np.isfinite(stated)
    within = np.abs(errors[known]) <= stated[known]
    told = [f"{stated[known].mean():.2f}", f"{within.mean():.2f}"] if known.any() else ["", ""]
    rms = np.sqrt((errors**2).mean())
    return [name, f"{errors.mean():+.2f}", f"{rms:.2f}", *told, str(len(errors))]


def _signed(value: float | None) -> str:
    return "" if value is None else f"{value:+.2f}"


def _sessions(scratch: Path) -> Iterator[Path]:
    data = SHARED.parent
    yield from (path for pattern in _RECORDED for path in sorted(data.glob(pattern)))
    for number in range(SIMULATED):
        options = SimulationOptions(
            seed=SEED + number,
            side=list(Side)[number % 2],
            distance_mm=_DISTANCES_MM[number % len(_DISTANCES_MM)],
        )
        yield _written(options, scratch / f"simulated_{SEED + number}")
    for number, (file, side, scale, distance_mm, mirrored) in enumerate(
        (*_OTHERS, *varied(VARIED, SEED))
    ):
        if (SHARED / file).exists():
            shown, body = scaled_body(file, side, scale, mirrored)
            options = SimulationOptions(
                seed=SEED + 50 + number, side=shown, distance_mm=distance_mm, body=body
            )
            yield _written(options, scratch / f"{Path(file).parent}_{number}")


def varied(count: int, seed: int) -> Iterator[tuple[str, Side, tuple[float, ...], int, bool]]:
    """Yield real feet and a template in other sizes: file, its side, scale, mm, mirrored."""
    rng = np.random.default_rng(seed)
    for number in range(count):
        scale = tuple(rng.uniform(*_SCALED))
        distance_mm, mirrored = int(rng.uniform(690, 820)), bool(rng.integers(2))
        yield (*_ORIGINS[number % len(_ORIGINS)], scale, distance_mm, mirrored)


def scaled_body(
    file: str, side: Side, scale: tuple[float, ...], mirrored: bool
) -> tuple[Side, KnownBody]:
    """Return a foot of the shared data in another size, and which side it shows then."""
    mesh = place_foot(read_mesh(SHARED / file).mesh, side, frame="unknown").mesh
    mesh = TriangleMesh(mesh.vertices * scale, mesh.triangles)
    shown = side.other if mirrored else side
    return shown, body_of(mesh.mirrored() if mirrored else mesh, shown)


def body_of(mesh: TriangleMesh, side: Side) -> KnownBody:
    """Place a foot, mm, insole frame, in the middle, with skin; what holds it cannot be seen."""
    low = mesh.vertices[mesh.vertices[:, 2] < 45.0]
    middle = (low.min(axis=0) + low.max(axis=0)) / 2
    mesh = mesh.transformed(rigid(np.eye(3), -middle * (1.0, 1.0, 0.0)))
    foot = place_foot(mesh, side, frame="reference")
    back = inverse(foot.source2insole)
    marks = {name: transform(back, mark.point) for name, mark in find_landmarks(foot).items()}
    skin = paint_skin(mesh, marks, np.random.default_rng(5))
    inside = np.array([[0.0, -80, 60], [1, -80, 60], [0, -79, 60], [0, -80, 61]])
    corners = np.array([[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]], dtype=np.int32)
    holder = TriangleMesh(inside, corners).with_attributes(colors=np.full((4, 3), 90, np.uint8))
    return KnownBody(skin, holder)


def _written(options: SimulationOptions, folder: Path) -> Path:
    simulated = simulate_session(options)
    write_session(simulated.session, folder)
    write_ply(simulated.truth, folder / "truth.ply")
    return folder
