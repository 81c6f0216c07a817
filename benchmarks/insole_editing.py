"""Editing an insole on a 0.5 mm grid of 300 x 110 mm, beside the same edit with mesh filters.

    python -m benchmarks insole_editing

Limits: drag of a pelott, pointer event to arrays, median 6 ms and 99 % 12 ms; rebuild of 15
corrections 60 ms; undo 20 ms; no growth of memory over 10 000 edits.
"""

from __future__ import annotations

import resource
import time
from collections.abc import Callable
from dataclasses import replace

import numpy as np

from benchmarks._measure import print_table
from insole_core.foot.foot_placement import place_foot
from insole_core.geometry.side import Side
from insole_core.insole.build import build_insole
from insole_core.insole.elements import (
    ArchRaise,
    BrushStroke,
    ForefootTwist,
    HeelCup,
    HeelLift,
    HeelSkive,
    Pelott,
    Posting,
)
from insole_core.insole.pads.pad_heights import pad_heights
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.primitives.height_field import HeightField
from insole_core.simulate.foot_model import build_foot
from insole_core.simulate.foot_shape import FootShape
from insole_core.workflows.edited_insole import EditedInsole
from insole_core.workflows.insole_builder import InsoleBuilder

PAD = Pelott(centre_mm=(5.0, 165.0))
FIFTEEN = (
    Posting(rearfoot_deg=4),
    Posting(forefoot_deg=2, method="intrinsic"),
    ForefootTwist(angle_deg=2),
    HeelSkive(),
    HeelLift(),
    HeelCup(depth_mm=14),
    ArchRaise(),
    PAD,
    Pelott(centre_mm=(0, 40), shape="horseshoe", length_mm=60, width_mm=60, height_mm=3),
    Pelott(centre_mm=(0, 160), shape="bar", length_mm=60, width_mm=80, height_mm=2),
    Pelott(centre_mm=(20, 200), shape="cut_out", length_mm=30, width_mm=25, height_mm=-1),
    Pelott(centre_mm=(30, 110), shape="arch_support", length_mm=90, width_mm=45),
    Pelott(
        centre_mm=(5, 150),
        shape="outline",
        outline_mm=((-15, -20), (15, -20), (18, 20), (-14, 22)),
    ),
    BrushStroke(points_mm=((0, 50), (10, 80))),
    BrushStroke(mode="smooth", strength=0.8, points_mm=((0, 150), (10, 180))),
)
DRAGS, EDITS = 400, 10_000


def times_ms(call: Callable[[int], object], count: int) -> np.ndarray:
    call(0)
    times = []
    for i in range(count):
        start = time.perf_counter()
        call(i)
        times.append(1000 * (time.perf_counter() - start))
    return np.array(times)


def row(name: str, times: np.ndarray, limit: str) -> tuple[str, str, str, str]:
    return name, f"{np.median(times):.2f}", f"{np.quantile(times, 0.99):.2f}", limit


def dragged(design: InsoleDesign, i: int) -> InsoleDesign:
    place = (5 + 15 * np.sin(i / 20), 150 + 20 * np.cos(i / 20))
    return design.with_changed(replace(PAD, centre_mm=place))


def filter_rows(field: HeightField) -> list[tuple[str, str, str, str]]:
    """Time the same pad on the same mesh by trimesh and by pyvista, normals included."""
    import pyvista
    import trimesh

    plain, triangles = field.nodes, field.triangles()
    faces = np.column_stack([np.full(len(triangles), 3), triangles])

    def lifted(i: int) -> np.ndarray:
        pad = dragged(InsoleDesign(Side.LEFT, (PAD,)), i).corrections[0]
        assert isinstance(pad, Pelott)
        points = plain.copy()
        points[:, 2] += pad_heights(pad, points[:, :2])
        return points

    def with_trimesh(i: int) -> object:
        return trimesh.Trimesh(lifted(i), triangles, process=False).vertex_normals

    def with_pyvista(i: int) -> object:
        mesh = pyvista.PolyData(lifted(i), faces)
        return mesh.compute_normals(cell_normals=False, split_vertices=False)["Normals"]

    return [
        row("drag, trimesh", times_ms(with_trimesh, 15), ""),
        row("drag, pyvista", times_ms(with_pyvista, 15), ""),
    ]


def main() -> None:
    shape = FootShape(length_mm=275, ball_width_mm=98)
    mesh = build_foot(shape, np.random.default_rng(1), cell_mm=2.5).mesh
    foot = place_foot(mesh, Side.LEFT, frame="reference")
    one = InsoleDesign(Side.LEFT, (PAD,), grid_mm=0.5, margin_mm=12)
    many = replace(one, corrections=FIFTEEN)
    hand, full = (EditedInsole(InsoleBuilder().bare(foot, each), each) for each in (one, many))
    rows = [row("drag", times_ms(lambda i: hand.follow(dragged(one, i)), DRAGS), "6 / 12")]
    rows.append(
        row(
            "drag, 15 corrections",
            times_ms(lambda i: full.follow(dragged(many, i)), DRAGS),
            "6 / 12",
        )
    )
    rows.append(row("rebuild of 15", times_ms(lambda _: build_insole(foot, many), 30), "60"))
    history = [one, dragged(one, 7)]
    rows.append(row("undo", times_ms(lambda i: hand.follow(history[i % 2]), 50), "20"))
    rows.extend(filter_rows(hand.contact))
    grid = hand.contact.heights_mm.shape
    print(f"{grid[0]} x {grid[1]} nodes")
    print_table(("edit", "median ms", "99 % ms", "limit"), rows)
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    for i in range(EDITS):
        hand.follow(dragged(one, i))
    grown = (resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before) / 1024
    print(f"peak memory grew by {grown:.1f} MB over {EDITS} edits (limit 5)")


if __name__ == "__main__":
    main()
