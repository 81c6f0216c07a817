"""The rectangular block with the contact surface on top, thesis 6.3.4."""

from __future__ import annotations

import numpy as np

from insole_core.geometry.arrays import FloatArray, IndexArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.insole.build import Insole
from insole_core.insole.elements import Pelott
from insole_core.insole.pads.pad_heights import pad_heights
from insole_core.insole.primitives.height_field import HeightField

_APEX_INSET = 0.1  # an apex stays this share of a cell away from the cell's edges


def block_solid(insole: Insole) -> TriangleMesh:
    """Close the contact surface with walls and a bottom at z = 0; the foot is towards +z.

    The apex of each pad becomes a vertex, so that its position and height do not depend on the
    grid.

    Returns
    -------
    TriangleMesh, mm, insole frame
        Closed, facing outwards.
    """
    tips, top = _insert_apexes(insole, insole.contact.triangles())
    return close_block(insole.contact, top, tips)


def close_block(field: HeightField, top: IndexArray, tips: FloatArray) -> TriangleMesh:
    """Close a surface with walls and a bottom at z = 0.

    Parameters
    ----------
    field
        Above z = 0 everywhere.
    top : (m, 3) int32
        Triangles between its nodes and the tips, which are numbered after the nodes.
    tips : (k, 3) float64, mm
        Additional points of the surface.

    Returns
    -------
    TriangleMesh, mm, frame of `field`
        Closed, facing outwards.
    """
    rim = _rim(field)
    floor = field.nodes[rim] * [1, 1, 0]
    centre = np.array([[field.x_mm.mean(), field.y_mm.mean(), 0.0]])
    first_floor = len(field.nodes) + len(tips)
    vertices = np.concatenate([field.nodes, tips, floor, centre])
    return TriangleMesh(vertices, np.concatenate([top, _sides(rim, first_floor)]))


def _rim(field: HeightField) -> IndexArray:
    """Return the indices of the outermost nodes, counter-clockwise seen from above."""
    rows, columns = field.heights_mm.shape
    index = np.arange(rows * columns, dtype=np.int32).reshape(rows, columns)
    return np.concatenate([index[0, :-1], index[:-1, -1], index[-1, :0:-1], index[:0:-1, 0]])


def _sides(rim: IndexArray, first_floor: int) -> IndexArray:
    """Return the walls between the rim and the floor below it, and the floor as a triangle fan."""
    count = len(rim)
    floor = np.arange(first_floor, first_floor + count, dtype=np.int32)
    next_rim, next_floor = np.roll(rim, -1), np.roll(floor, -1)
    centre = np.full(count, first_floor + count, dtype=np.int32)
    return np.concatenate(
        [
            np.stack([floor, next_floor, next_rim], axis=1),
            np.stack([floor, next_rim, rim], axis=1),
            np.stack([next_floor, floor, centre], axis=1),
        ]
    )


def apexes(insole: Insole) -> dict[tuple[int, int], FloatArray]:
    """Return the point (3,) of the exact surface at the apex of each pad, in mm.

    Keyed by the cell (row, column) of the grid; of several apexes in one cell the first counts.
    """
    field = insole.contact
    rows, columns = field.heights_mm.shape
    found: dict[tuple[int, int], FloatArray] = {}
    for pad in insole.design.of(Pelott):
        column, row = (np.array(pad.centre_mm) - [field.x0_mm, field.y0_mm]) / field.step_mm
        j, i = int(np.floor(column)), int(np.floor(row))
        if 0 <= i < rows - 1 and 0 <= j < columns - 1:
            found.setdefault((i, j), _apex(insole, i, j, column - j, row - i))
    return found


def _insert_apexes(insole: Insole, triangles: IndexArray) -> tuple[FloatArray, IndexArray]:
    """Replace the two triangles of each cell that holds an apex by a fan of four about it."""
    rows, columns = insole.contact.heights_mm.shape
    tips = apexes(insole)
    cells = np.array([i * (columns - 1) + j for i, j in tips], dtype=np.int64)
    cell_count = (rows - 1) * (columns - 1)
    keep = np.ones(len(triangles), dtype=bool)
    keep[np.concatenate([cells, cells + cell_count])] = False
    fans = [triangles[keep]]
    for number, cell in enumerate(cells):
        a, b, c = triangles[cell]
        d = triangles[cell + cell_count, 2]
        tip = rows * columns + number
        fans.append(np.array([[a, b, tip], [b, c, tip], [c, d, tip], [d, a, tip]], np.int32))
    return np.array(list(tips.values())).reshape(-1, 3), np.concatenate(fans)


def _apex(insole: Insole, i: int, j: int, u: float, v: float) -> FloatArray:
    """Evaluate the exact surface at (u, v) of cell (i, j): base interpolated, pads computed."""
    field = insole.contact
    u, v = np.clip([u, v], _APEX_INSET, 1 - _APEX_INSET)
    x, y = field.x0_mm + (j + u) * field.step_mm, field.y0_mm + (i + v) * field.step_mm
    corners = np.array([[field.x_mm[c], field.y_mm[r]] for r in (i, i + 1) for c in (j, j + 1)])
    base = field.heights_mm[i : i + 2, j : j + 2].ravel().copy()
    added = 0.0
    for pad in insole.design.of(Pelott):
        base -= pad_heights(pad, corners)
        added += float(pad_heights(pad, np.array([x, y])))
    weights = np.array([(1 - u) * (1 - v), u * (1 - v), (1 - u) * v, u * v])
    return np.array([x, y, weights @ base + added])
