"""Insole solid of about 300 000 triangles: build (limit 150 ms), STL (60 ms, beside trimesh)."""

from __future__ import annotations

import tempfile
from dataclasses import replace
from functools import partial
from pathlib import Path

import trimesh

from benchmarks._measure import median_ms, print_table
from benchmarks._random_designs import random_foot
from insole_core.export.obj import write_obj
from insole_core.export.ply import write_ply
from insole_core.export.stl import write_ascii_stl, write_stl
from insole_core.export.three_mf import ThreeMfPart, write_3mf
from insole_core.geometry.mesh import TriangleMesh
from insole_core.insole.build import build_insole
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.solids.solid import KINDS, insole_solid, make_solid


def main() -> None:
    foot = random_foot(1)
    insole = build_insole(foot, InsoleDesign(foot.side, grid_mm=0.52))
    solid = insole_solid(insole)
    rows: list[list[object]] = [
        [f"build {kind}", len(make_solid(insole, kind).triangles),
         f"{median_ms(partial(make_solid, insole, kind)):.0f}",
         "150" if kind == "insole" else ""]
        for kind in KINDS
    ]  # fmt: skip
    shell = replace(insole, design=replace(insole.design, bottom="following"))
    rows.append(["build insole, bottom following", len(insole_solid(shell).triangles),
                 f"{median_ms(lambda: insole_solid(shell)):.0f}", ""])  # fmt: skip
    peer = trimesh.Trimesh(solid.vertices, solid.triangles, process=False)

    def fresh() -> TriangleMesh:
        return TriangleMesh(solid.vertices, solid.triangles)

    with tempfile.TemporaryDirectory() as name:
        path = Path(name)
        writers = {
            "write STL": (lambda: write_stl(fresh(), path / "a.stl"), "60"),
            "write STL, trimesh": (lambda: _by_trimesh(peer, path / "b.stl"), ""),
            "write ASCII STL": (lambda: write_ascii_stl(fresh(), path / "c.stl"), ""),
            "write PLY": (lambda: write_ply(fresh(), path / "d.ply"), ""),
            "write OBJ": (lambda: write_obj(fresh(), path / "e.obj"), ""),
            "write 3MF": (lambda: write_3mf([ThreeMfPart(solid, "insole")], path / "f.3mf"), ""),
        }
        for title, (write, limit) in writers.items():
            rows.append([title, len(solid.triangles), f"{median_ms(write, 5):.0f}", limit])
    print_table(["step", "triangles", "ms (median)", "limit"], rows)


def _by_trimesh(mesh: trimesh.Trimesh, path: Path) -> None:
    mesh._cache.clear()
    mesh.export(path)
