"""Checks of a solid by other programs; each returns its complaints, or None if not installed."""

from __future__ import annotations

import re
import shutil
import subprocess
from pathlib import Path

import manifold3d
import numpy as np
import trimesh

from insole_core.geometry.mesh import TriangleMesh

_FAULTS = (
    "Total disconnected facets", "Degenerate facets", "Edges fixed", "Facets removed",
    "Facets added", "Facets reversed", "Backwards edges", "Normals fixed",
)  # fmt: skip
PRUSA = "prusa-slicer"


def by_trimesh(path: Path) -> list[str]:
    read = trimesh.load_mesh(path)
    ok = read.is_watertight and read.is_winding_consistent and read.volume > 0
    return [] if ok else ["not watertight"]


def by_manifold(mesh: TriangleMesh) -> list[str]:
    body = manifold3d.Manifold(
        manifold3d.Mesh(mesh.vertices.astype(np.float32), mesh.triangles.astype(np.uint32))
    )
    if body.status() != manifold3d.Error.NoError:
        return [str(body.status())]
    away = abs(body.volume() / mesh.volume_mm3 - 1)
    return [f"volume differs by {away:.2%}"] if away > 1e-3 else []


def by_admesh(path: Path) -> list[str] | None:
    if shutil.which("admesh") is None:
        return None
    # It prints the byte behind a title that fills its 80, whichever that is.
    call = subprocess.run(
        ["admesh", str(path)], capture_output=True, text=True, errors="replace", check=True
    )
    lines = [line for line in call.stdout.splitlines() if any(f in line for f in _FAULTS)]
    assert len(lines) == len(_FAULTS), call.stdout
    counts = [re.search(r":\s*(\d+)", line) for line in lines]
    return [line for line, n in zip(lines, counts, strict=True) if n and n.group(1) != "0"]


def by_prusa_info(path: Path) -> dict[str, str] | None:
    """Return the facts that the slicer reports: manifold, size_x, size_y, size_z, volume …"""
    if shutil.which(PRUSA) is None:
        return None
    call = subprocess.run([PRUSA, "--info", str(path)], capture_output=True, text=True, check=True)
    pairs = re.findall(r"^(\w+)\s*=\s*(.+)$", call.stdout, flags=re.MULTILINE)
    return {key: value.strip() for key, value in pairs}


def by_prusa_slicing(path: Path, folder: Path) -> list[str] | None:
    """Slice on a bed of 400 mm; complaints are a failure, a repair or an empty result."""
    if shutil.which(PRUSA) is None:
        return None
    out = folder / "out.gcode"
    out.unlink(missing_ok=True)
    call = subprocess.run(
        [PRUSA, "--export-gcode", "--bed-shape", "0x0,400x0,400x400,0x400", "--center", "200,200",
         "--layer-height", "0.3", "--output", str(out), str(path)],
        capture_output=True, text=True, check=False,
    )  # fmt: skip
    said = (call.stdout + call.stderr).splitlines()
    faults = [line for line in said if re.search(r"error|repair|empty layer", line, re.IGNORECASE)]
    done = call.returncode == 0 and out.exists() and out.stat().st_size > 10_000
    return faults if done else [*faults, f"no G-code (exit {call.returncode})"]
