"""Simulated feet for every part of the core that stands on a foot."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import cache
from pathlib import Path

import numpy as np
import pytest

from insole_core.foot.foot import Foot
from insole_core.foot.foot_placement import place_foot
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.side import Side
from insole_core.scans.mesh_file import read_mesh
from insole_core.simulate.foot_model import build_foot
from insole_core.simulate.foot_shape import FootShape


@pytest.fixture(scope="session")
def left_mesh() -> TriangleMesh:
    """A left foot of 245 mm, reference frame, closed, coarse."""
    return build_foot(FootShape(side=Side.LEFT), np.random.default_rng(1), cell_mm=3.0).mesh


@pytest.fixture(scope="session")
def right_mesh(left_mesh: TriangleMesh) -> TriangleMesh:
    """The exact mirror image of the left foot."""
    mirrored = replace(left_mesh, vertices=left_mesh.vertices * [-1, 1, 1])
    return mirrored.flipped()


@pytest.fixture(scope="session")
def left_foot(left_mesh: TriangleMesh) -> Foot:
    return place_foot(left_mesh, Side.LEFT, frame="reference")


@pytest.fixture(scope="session")
def right_foot(right_mesh: TriangleMesh) -> Foot:
    return place_foot(right_mesh, Side.RIGHT, frame="reference")


@pytest.fixture(scope="session")
def scanned_mesh(shared_data: Path) -> Callable[[str], TriangleMesh]:
    """Read each scan of the reference data once."""
    return cache(lambda file: read_mesh(shared_data / "feet" / file).mesh)


@pytest.fixture(scope="session")
def placed_scan(scanned_mesh: Callable[[str], TriangleMesh]) -> Callable[[str, Side], Foot]:
    """Place each scan of the reference data once."""
    return cache(lambda file, side: place_foot(scanned_mesh(file), side, frame="unknown"))


@pytest.fixture(scope="session")
def true_mesh(shared_data: Path) -> Callable[[str], TriangleMesh]:
    """Read the true surface of each session of the reference data once."""
    return cache(lambda session: read_mesh(shared_data / "sessions" / session / "truth.ply").mesh)


@pytest.fixture(scope="session")
def true_foot(true_mesh: Callable[[str], TriangleMesh]) -> Callable[[str, Side], Foot]:
    """Place the true foot of each session of the reference data once."""
    return cache(lambda session, side: place_foot(true_mesh(session), side, frame="reference"))


@pytest.fixture(scope="module")
def real_foot(placed_scan: Callable[[str, Side], Foot]) -> Callable[[str, Side], Foot]:
    """Give the foot of a reference scan; what is derived from it goes with the module."""
    return cache(lambda file, side: replace(placed_scan(file, side)))
