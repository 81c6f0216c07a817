"""Left and right in one block, as close as possible, the right one turned where that is closer."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from insole_core.errors import DesignError
from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.transforms import rigid, rotation_about
from insole_core.messages import Message

_PITCH_MM = 1.0
_ROUNDING_MM = 1e-6


@dataclass(frozen=True, eq=False)
class Nest:
    """Solids in one block, standing on z = 0; its corner is the origin, its length along y.

    Parameters
    ----------
    meshes
        In the order given.
    insole2block : (4, 4) float64, mm, for each
    size_mm
        Width (x), length (y) and height they need together, with the margin.
    """

    meshes: tuple[TriangleMesh, ...]
    insole2block: tuple[FloatArray, ...]
    size_mm: tuple[float, float, float]

    def excess_mm(self, block_mm: tuple[float, float, float]) -> float:
        """Return by how much a block (length, width, height) is too small; negative if it fits."""
        length, width = sorted(block_mm[:2], reverse=True)
        x, y, z = self.size_mm
        return max(x - width, y - length, z - block_mm[2])

    def in_middle_of(self, block_mm: tuple[float, float, float]) -> Nest:
        """Return the solids in the middle of a block (length, width, height), on its bottom."""
        length, width = sorted(block_mm[:2], reverse=True)
        shift = rigid(
            np.eye(3), np.array([width - self.size_mm[0], length - self.size_mm[1], 0]) / 2
        )
        return Nest(
            tuple(mesh.transformed(shift) for mesh in self.meshes),
            tuple(shift @ a2b for a2b in self.insole2block),
            self.size_mm,
        )

    def sentence(self, block_mm: tuple[float, float, float]) -> Message:
        """Say what the pair needs of a block (length, width, height), and what there is."""
        length, width = sorted(block_mm[:2], reverse=True)
        x, y, z = (np.ceil(size - _ROUNDING_MM) for size in self.size_mm)
        need, there = f"{y:.0f} × {x:.0f} × {z:.0f}", f"{length:g} × {width:g} × {block_mm[2]:g}"
        if self.excess_mm(block_mm) <= 0:
            return Message(
                "The pair needs {need} mm, and the block has {there} mm.", need=need, there=there
            )
        return Message(
            "The pair needs a block of {need} mm, and this one has {there} mm; take a larger "
            "block, or one for each side.",
            need=need,
            there=there,
        )


def nest_pair(
    left: TriangleMesh,
    right: TriangleMesh,
    block_mm: tuple[float, float, float],
    *,
    gap_mm: float = 12.0,
    margin_mm: float = 4.0,
) -> Nest:
    """Place two solids side by side in the middle of a block that is large enough.

    Parameters
    ----------
    left, right : mm, each in its own frame
    block_mm
        Length, width, height.
    gap_mm
        Between the two, for the cutter.
    margin_mm
        To the sides of the block.

    Returns
    -------
    Nest
        The narrower of both directions of the right solid.

    Raises
    ------
    DesignError
        If the block is too small.
    """
    nest = closest_nest(left, right, gap_mm=gap_mm, margin_mm=margin_mm)
    if nest.excess_mm(block_mm) > 0:
        raise DesignError(nest.sentence(block_mm))
    return nest.in_middle_of(block_mm)


def closest_nest(
    left: TriangleMesh, right: TriangleMesh, *, gap_mm: float = 12.0, margin_mm: float = 4.0
) -> Nest:
    """Place two solids side by side, whatever the size of the block that takes them.

    Parameters
    ----------
    left, right : mm, each in its own frame
    gap_mm, margin_mm
        As for `nest_pair`.

    Returns
    -------
    Nest
        The narrower of both directions of the right solid.
    """
    nests = [_side_by_side(left, right, turn_deg, gap_mm, margin_mm) for turn_deg in (0, 180)]
    return min(nests, key=lambda nest: nest.size_mm[0])


def _side_by_side(
    left: TriangleMesh, right: TriangleMesh, turn_deg: float, gap_mm: float, margin_mm: float
) -> Nest:
    """Place right beside left, their backs level, as near as their outlines allow."""
    turn = rigid(rotation_about(np.array([0.0, 0, 1]), turn_deg), np.zeros(3))
    placed = []
    for mesh, a2b in ((left, np.eye(4)), (right, turn)):
        low = mesh.transformed(a2b).bounds_mm[0]
        placed.append(rigid(np.eye(3), margin_mm * np.array([1.0, 1.0, 0.0]) - low) @ a2b)
    apart = _shift(left.transformed(placed[0]), right.transformed(placed[1]), gap_mm)
    placed[1] = rigid(np.eye(3), np.array([apart, 0, 0])) @ placed[1]
    meshes = (left.transformed(placed[0]), right.transformed(placed[1]))
    high = np.maximum(meshes[0].bounds_mm[1], meshes[1].bounds_mm[1])
    size = (float(high[0]) + margin_mm, float(high[1]) + margin_mm, float(high[2]))
    return Nest(meshes, (placed[0], placed[1]), size)


def _shift(left: TriangleMesh, right: TriangleMesh, gap_mm: float) -> float:
    """Return how far to move the right one along x to clear the left one by the gap."""
    end = max(left.bounds_mm[1, 1], right.bounds_mm[1, 1])
    rows = int(np.ceil(end / _PITCH_MM)) + 1
    right_side = _profile(left, rows, gap_mm, np.maximum, -np.inf)
    left_side = _profile(right, rows, 0.0, np.minimum, np.inf)
    both = np.isfinite(right_side) & np.isfinite(left_side)
    return float((right_side - left_side)[both].max() + gap_mm)


def _profile(
    mesh: TriangleMesh, rows: int, reach_mm: float, extreme: np.ufunc, start: float
) -> FloatArray:
    """Return the outermost x in every row along y, including all within reach along y."""
    profile = np.full(rows, start)
    row = np.clip((mesh.vertices[:, 1] / _PITCH_MM).astype(int), 0, rows - 1)
    extreme.at(profile, row, mesh.vertices[:, 0])
    reach = int(reach_mm / _PITCH_MM) + 1
    padded = np.pad(profile, reach, constant_values=start)
    windows = np.lib.stride_tricks.sliding_window_view(padded, 2 * reach + 1)
    return np.asarray(extreme.reduce(windows, axis=1))
