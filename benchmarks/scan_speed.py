"""Three million triangles in every large format: processor time and memory to the foot.

Beside each the peer, `trimesh.load`, which only reads the file. Limits: 6 s and 1.5 GB to the foot.
``SCAN_TRIANGLES`` asks for fewer. Each runs in a process of its own; processor time, since a
benchmark that shares its machine would otherwise measure its neighbours.
"""

from __future__ import annotations

import multiprocessing
import os
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

from benchmarks._measure import print_table
from insole_core.formats.stl import write_stl
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.side import Side
from insole_core.simulate.foot_model import build_foot
from insole_core.simulate.foot_shape import FootShape

TRIANGLES = int(os.environ.get("SCAN_TRIANGLES", "3000000"))
MOST_SECONDS, MOST_MB = 6.0, 1500
_ENDING = """
import resource, time
print(time.process_time(), resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024)
"""
_READ = "from insole_core.scans.mesh_file import read_mesh\nread_mesh(Path(sys.argv[1]))"
_TO_FOOT = (
    "from insole_core.cases.scan_source import ImportChoice\n"
    "from insole_core.workflows.import_scan import examine_scan, take_foot\n"
    "seen = examine_scan(Path(sys.argv[1]))\n"
    "found = seen.feet[0]\n"
    "take_foot(seen, found, found.candidates[0])"
)
_PEER = "import trimesh\ntrimesh.load(sys.argv[1], process=False)"


def fine_foot() -> TriangleMesh:
    import trimesh

    mesh = build_foot(FootShape(side=Side.LEFT), np.random.default_rng(1), cell_mm=1.9).mesh
    vertices, triangles = mesh.vertices, mesh.triangles
    while 4 * len(triangles) <= 1.1 * TRIANGLES:
        vertices, triangles = trimesh.remesh.subdivide(vertices, triangles)
    return TriangleMesh(vertices, triangles[:TRIANGLES].astype(np.int32))


def write_obj(mesh: TriangleMesh, path: Path, *, textured: bool) -> None:
    places = mesh.vertices
    corners = mesh.triangles + 1
    with path.open("w", encoding="ascii") as file:
        file.write("mtllib skin.mtl\nusemtl skin\n" if textured else "")
        file.write("v %.4f %.4f %.4f\n" * len(places) % tuple(places.ravel().tolist()))
        if textured:
            uv = (places[:, :2] - places[:, :2].min(axis=0)) / np.ptp(places[:, :2], axis=0)
            file.write("vt %.5f %.5f\n" * len(uv) % tuple(uv.ravel().tolist()))
            numbers = np.repeat(corners.ravel(), 2).tolist()
            file.write("f %d/%d %d/%d %d/%d\n" * len(corners) % tuple(numbers))
        else:
            file.write("f %d %d %d\n" * len(corners) % tuple(corners.ravel().tolist()))
    if textured:
        import cv2

        (path.parent / "skin.mtl").write_text("newmtl skin\nmap_Kd skin.png\n", encoding="ascii")
        noise = np.random.default_rng(0).integers(0, 255, (1024, 1024, 3), dtype=np.uint8)
        cv2.imwrite(str(path.parent / "skin.png"), noise)


def write_all(folder: Path) -> list[Path]:
    import trimesh

    mesh = fine_foot()
    colors = np.column_stack([np.abs(mesh.vertices) % 255, np.full(len(mesh.vertices), 255)])
    plain = trimesh.Trimesh(mesh.vertices, mesh.triangles, process=False)
    colored = trimesh.Trimesh(
        mesh.vertices, mesh.triangles, vertex_colors=colors.astype(np.uint8), process=False
    )
    write_stl(mesh, folder / "binary.stl")
    plain.export(folder / "plain.ply")
    colored.export(folder / "coloured.ply")
    plain.export(folder / "plain.glb")
    colored.export(folder / "coloured.glb")
    write_obj(mesh, folder / "plain.obj", textured=False)
    write_obj(mesh, folder / "textured.obj", textured=True)
    return [
        folder / name
        for name in (
            "binary.stl", "plain.ply", "coloured.ply", "plain.glb", "coloured.glb", "plain.obj",
            "textured.obj",
        )
    ]  # fmt: skip


def cost(body: str, path: Path) -> tuple[float, float]:
    """Processor seconds, imports included, and peak memory in MB."""
    script = f"import sys\nfrom pathlib import Path\n{body}\n{_ENDING}"
    done = subprocess.run(
        [sys.executable, "-c", script, str(path)], check=True, capture_output=True, text=True
    )
    seconds, peak_mb = done.stdout.split()[-2:]
    return float(seconds), float(peak_mb)


def main() -> None:
    with tempfile.TemporaryDirectory() as name:
        rows = []
        with multiprocessing.get_context("spawn").Pool(1) as pool:  # a child counts what its parent
            paths = pool.apply(write_all, (Path(name),))  # has held as its own memory
        for path in paths:
            costs = [cost(body, path) for body in (_READ, _TO_FOOT, _PEER)]
            cells = [cell for one in costs for cell in (f"{one[0]:.1f} s", f"{one[1]:.0f} MB")]
            is_within = costs[1][0] <= MOST_SECONDS and costs[1][1] <= MOST_MB
            rows.append([path.name, *cells, "yes" if is_within else "NO"])
    print(f"{TRIANGLES} triangles; limit to the foot: {MOST_SECONDS:.0f} s and {MOST_MB} MB")
    print_table(["file", "read", "", "to the foot", "", "trimesh.load alone", "", "within"], rows)


if __name__ == "__main__":
    main()
