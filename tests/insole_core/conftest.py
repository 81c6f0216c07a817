"""Simulated feet for every part of the core that stands on a foot."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from found_once import share_bases

from insole_core.foot.foot import Foot
from insole_core.foot.foot_placement import place_foot
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.side import Side
from insole_core.scans.mesh_file import read_mesh
from insole_core.simulate.foot_model import build_foot
from insole_core.simulate.foot_shape import FootShape


@pytest.fixture(scope="module", autouse=True)
def same_bases() -> Iterator[None]:
    """Let insoles of one foot share their surface before pads, as they do in the window."""
    with pytest.MonkeyPatch.context() as patch:
        share_bases(patch)
        yield


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
def read_once() -> Callable[[Path], TriangleMesh]:
    """Read each scan of the reference data once."""
    return cache(lambda path: read_mesh(path).mesh)


@pytest.fixture(scope="session")
def placed_once(read_once: Callable[[Path], TriangleMesh]) -> Callable[[Path, Side, str], Foot]:
    """Place each scan of the reference data once."""
    return cache(
        lambda path, side, frame: bare_foot(place_foot(bare(read_once(path)), side, frame=frame))
    )


@pytest.fixture(scope="module")
def scanned_mesh(
    shared_data: Path, read_once: Callable[[Path], TriangleMesh]
) -> Callable[[str], TriangleMesh]:
    """Give a reference scan; what is derived from it goes with the module."""
    return cache(lambda file: bare(read_once(shared_data / "feet" / file)))


@pytest.fixture(scope="module")
def true_mesh(
    shared_data: Path, read_once: Callable[[Path], TriangleMesh]
) -> Callable[[str], TriangleMesh]:
    """Give the true surface of a session of the reference data, in the same way."""
    return cache(lambda session: bare(read_once(shared_data / "sessions" / session / "truth.ply")))


@pytest.fixture(scope="module")
def real_foot(
    shared_data: Path, placed_once: Callable[[Path, Side, str], Foot]
) -> Callable[[str, Side], Foot]:
    """Give the foot of a reference scan, in the same way."""
    return cache(
        lambda file, side: bare_foot(placed_once(shared_data / "feet" / file, side, "unknown"))
    )


@pytest.fixture(scope="module")
def true_foot(
    shared_data: Path, placed_once: Callable[[Path, Side, str], Foot]
) -> Callable[[str, Side], Foot]:
    """Give the true foot of a session of the reference data, in the same way."""

    def give(session: str, side: Side) -> Foot:
        path = shared_data / "sessions" / session / "truth.ply"
        return bare_foot(placed_once(path, side, "reference"))

    return cache(give)


def bare(mesh: TriangleMesh) -> TriangleMesh:
    """Return the same surface with nothing derived from it: that takes ten times its memory."""
    return replace(mesh)


def bare_foot(foot: Foot) -> Foot:
    return replace(foot, mesh=bare(foot.mesh))
