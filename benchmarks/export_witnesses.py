"""Solids of random designs, with and without shells, judged by four other programs."""

from __future__ import annotations

import os
import tempfile
from collections import Counter
from itertools import chain
from pathlib import Path

from benchmarks._measure import print_table
from benchmarks._random_designs import random_shell_solids, random_solids
from benchmarks._witnesses import (
    by_admesh,
    by_manifold,
    by_prusa_info,
    by_prusa_slicing,
    by_trimesh,
)
from insole_core.errors import DesignError
from insole_core.formats.solid_content import SolidPart
from insole_core.formats.stl import write_stl
from insole_core.formats.three_mf import write_3mf
from insole_core.geometry.arrays import FloatArray
from insole_core.solids.solid import DEFAULT_OPTIONS, KINDS, make_solid

DESIGNS = int(os.environ.get("INSOLE_DESIGNS", "200"))
SLICED = max(1, DESIGNS // 10)
SIZE_TOLERANCE_MM = 0.01


def main() -> None:
    good: Counter[str] = Counter()
    asked: Counter[str] = Counter()
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        shells = ((insole, KINDS[0], DEFAULT_OPTIONS) for insole in random_shell_solids(DESIGNS))
        asked_for = chain(random_solids(DESIGNS), shells)
        for number, (insole, kind, options) in enumerate(asked_for):
            solid = make_solid(insole, kind, options)
            stl, three_mf = folder / "solid.stl", folder / "solid.3mf"
            write_stl(solid, stl)
            write_3mf([SolidPart(solid, kind)], three_mf)
            answers = {
                "trimesh: watertight": by_trimesh(stl),
                "ADMesh: no fault": by_admesh(stl),
                "manifold3d: same volume": by_manifold(solid),
                "PrusaSlicer: manifold": _called_manifold(stl),
                "PrusaSlicer: size of 3MF": _size_of(three_mf, solid.bounds_mm),
            }
            if number % (DESIGNS // SLICED) == 0:
                answers["PrusaSlicer: sliced"] = by_prusa_slicing(stl, folder)
            for witness, complaints in answers.items():
                if complaints is None:
                    continue
                asked[witness] += 1
                good[witness] += not complaints
                if complaints:
                    shape = insole.design.shell or options
                    print(f"design {number} ({kind}, {shape}): {witness}: {complaints[:3]}")
    print_table(["witness", "solids", "without a fault"], [[w, asked[w], good[w]] for w in asked])
    if good != asked:
        raise DesignError("A solid was refused; see above.")


def _called_manifold(path: Path) -> list[str] | None:
    info = by_prusa_info(path)
    return None if info is None else [] if info.get("manifold") == "yes" else [str(info)]


def _size_of(path: Path, bounds: FloatArray) -> list[str] | None:
    info = by_prusa_info(path)
    if info is None:
        return None
    sizes = [float(info[f"size_{axis}"]) for axis in "xyz"]
    away = max(abs(a - b) for a, b in zip(sizes, bounds[1] - bounds[0], strict=True))
    return [] if away < SIZE_TOLERANCE_MM else [f"size differs by {away:.2f} mm"]
