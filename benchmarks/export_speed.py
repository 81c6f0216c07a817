"""Insole solid of about 300 000 triangles: build (limit 150 ms), STL (60 ms, beside trimesh)."""

from __future__ import annotations

import tempfile
from dataclasses import replace
from functools import partial
from pathlib import Path

import trimesh

from benchmarks._measure import median_ms, print_table
from benchmarks._random_designs import random_foot
from insole_core.foot.foot import Foot
from insole_core.formats.obj import write_obj
from insole_core.formats.ply import write_ply
from insole_core.formats.solid_content import SolidPart
from insole_core.formats.stl import write_ascii_stl, write_stl
from insole_core.formats.three_mf import write_3mf
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.side import Side
from insole_core.insole.build import build_insole
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.prescription.layers import Layers
from insole_core.insole.prescription.outline import Outline
from insole_core.insole.prescription.shell import Post, Shell
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
    for title, design in _shells(foot.side).items():
        rebuild = partial(_rebuild, foot, design)
        rows.append([f"rebuild and solid on 1 mm, {title}", len(rebuild().triangles),
                     f"{median_ms(rebuild):.0f}", "120"])  # fmt: skip
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
            "write 3MF": (lambda: write_3mf([SolidPart(solid, "insole")], path / "f.3mf"), ""),
        }
        for title, (write, limit) in writers.items():
            rows.append([title, len(solid.triangles), f"{median_ms(write, 5):.0f}", limit])
    print_table(["step", "triangles", "ms (median)", "limit"], rows)


def _shells(side: Side) -> dict[str, InsoleDesign]:
    """Return designs of shells, from the plain one to one with everything."""
    plain = InsoleDesign(side, outline=Outline(extent="three_quarter"), shell=Shell())
    posts = (Post(angle_deg=4.0), Post(region="forefoot", angle_deg=-3.0))
    rich = replace(
        plain, bottom="following", layers=Layers(cover_mm=2.0, cover_is_taken_off=True),
        shell=Shell(posts=posts, heel_pitch_mm=15.0, draft_medial_deg=-5.0),
    )  # fmt: skip
    return {
        "no shell": replace(plain, shell=None),
        "flat shell": plain,
        "cupped shell": replace(plain, bottom="following"),
        "cupped shell, posts, pitch, cover off": rich,
    }


def _rebuild(foot: Foot, design: InsoleDesign) -> TriangleMesh:
    """Build an insole and its solid as after a changed value: only the foot's own is kept."""
    return insole_solid(build_insole(foot, design))


def _by_trimesh(mesh: trimesh.Trimesh, path: Path) -> None:
    mesh._cache.clear()
    mesh.export(path)
