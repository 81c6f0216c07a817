"""The surface measured by one view: a lattice in order of the depth image, and a coarse mesh."""

from __future__ import annotations

from dataclasses import dataclass, replace

import cv2
import numpy as np

from insole_core.geometry.arrays import BoolArray, ByteArray, FloatArray, IndexArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.transforms import transform
from insole_core.reconstruct.views.measured_view import MeasuredView
from insole_core.reconstruct.volume import is_inside
from insole_core.recording.box import Box
from insole_core.sensing.pinhole_camera import PinholeCamera

_LONGEST_EDGE_PIXELS = 5.0
_SMALLEST_PIECE = 0.01
_STEP = 2


@dataclass(frozen=True, eq=False)
class RangeMesh:
    """The part of the foot that one view measured.

    Parameters
    ----------
    points : (height, width, 3) float64, mm, reference frame; NaN = not measured
    triangles : (m, 3) int32
        Indices into the flattened lattice, counter-clockwise seen from the sensor.
    colors : (height, width, 3) uint8
    sensor2reference : (4, 4) float64, mm
    camera
        The depth camera; every lattice point is one of its pixels.
    """

    points: FloatArray
    triangles: IndexArray
    colors: ByteArray
    sensor2reference: FloatArray
    camera: PinholeCamera

    @property
    def corners(self) -> FloatArray:
        """(m, 3, 3) corner positions of the triangles, mm, reference frame."""
        return np.asarray(self.points.reshape(-1, 3)[self.triangles])

    def keeping(self, kept: BoolArray) -> RangeMesh:
        """Return the mesh with only the triangles chosen by the mask `kept` (m,)."""
        return replace(self, triangles=self.triangles[kept])


def triangulate(points: FloatArray, inside: BoolArray, longest_edge_mm: FloatArray) -> IndexArray:
    """Triangulate the pixels of a depth image, thesis 3.1 and 6.2.3.

    This is a 2-D Delaunay triangulation in the image plane without the long edges. The corners of
    every square of the pixel lattice lie on one circle, so either diagonal gives a Delaunay
    triangulation; the one that is shorter in space is taken. It is 200 times faster than a
    general triangulation of the same points.

    Parameters
    ----------
    points : (height, width, 3) float64, mm
    inside : (height, width) bool
        The pixels that may be used.
    longest_edge_mm : (height, width) float64, mm
        Longest edge in space at every pixel; a longer one is a jump in depth and is cut.

    Returns
    -------
    (m, 3) int32, indices into the flattened lattice
    """
    height, width = inside.shape
    index = np.arange(height * width, dtype=np.int32).reshape(height, width)
    a, b, c, d = index[:-1, :-1], index[:-1, 1:], index[1:, :-1], index[1:, 1:]
    ok = inside.ravel()
    quads = np.flatnonzero((ok[a].astype(np.int8) + ok[b] + ok[c] + ok[d]).ravel() >= 3)
    a, b, c, d = (corner.ravel()[quads] for corner in (a, b, c, d))
    flat = points.reshape(-1, 3)
    falling, rising = _squared_length(flat, a, d), _squared_length(flat, b, c)
    along_falling = ok[a] & ok[d] & ~(ok[b] & ok[c] & (rising < falling))
    candidates = np.concatenate(
        [
            np.stack(corners, axis=1)[halved]
            for corners, halved in (
                ((a, c, d), along_falling),
                ((a, d, b), along_falling),
                ((a, c, b), ~along_falling),
                ((b, c, d), ~along_falling),
            )
        ]
    )
    candidates = candidates[ok[candidates].all(1)]
    limit = longest_edge_mm.ravel()[candidates[:, 0]] ** 2
    short = np.ones(len(candidates), dtype=bool)
    for start, end in ((0, 1), (1, 2), (2, 0)):
        short &= _squared_length(flat, candidates[:, start], candidates[:, end]) <= limit
    return np.asarray(candidates[short])


def longest_edges(depth_mm: FloatArray, focal_px: float) -> FloatArray:
    """Compute the longest edge that is not a jump: five pixels' width, a slope of 78 degrees.

    Parameters
    ----------
    depth_mm : (height, width) float64, mm
    focal_px
        Of the depth camera.

    Returns
    -------
    (height, width) float64, mm
    """
    return np.asarray(_LONGEST_EDGE_PIXELS * depth_mm / focal_px)


def without_small_pieces(sheet: RangeMesh) -> RangeMesh:
    """Drop the connected pieces that have less than a hundredth of the mesh's triangles."""
    if len(sheet.triangles) == 0:
        return sheet
    piece = _pieces(sheet.triangles, sheet.points.shape[:2])
    size = np.bincount(piece)
    return sheet.keeping(size[piece] >= _SMALLEST_PIECE * len(piece))


def join(sheets: list[RangeMesh]) -> TriangleMesh:
    """Concatenate range meshes into one coloured mesh, mm, reference frame.

    Vertices without a triangle are dropped.
    """
    vertices, triangles, colors = [], [], []
    count = 0
    for sheet in sheets:
        used, corners = np.unique(sheet.triangles, return_inverse=True)
        vertices.append(sheet.points.reshape(-1, 3)[used])
        colors.append(sheet.colors.reshape(-1, 3)[used])
        triangles.append((corners.reshape(-1, 3) + count).astype(np.int32))
        count += len(used)
    return TriangleMesh(np.concatenate(vertices), np.concatenate(triangles), np.concatenate(colors))


def _squared_length(points: FloatArray, start: IndexArray, end: IndexArray) -> FloatArray:
    return np.asarray(((points[start] - points[end]) ** 2).sum(1))


def _pieces(triangles: IndexArray, shape: tuple[int, ...]) -> IndexArray:
    """Label the connected piece of every triangle.

    Every triangle has two edges along the lattice. Drawn into an image of twice the size, where
    pixels stand between the lattice's points, they connect exactly what the triangles connect.
    """
    drawing = np.zeros((2 * shape[0] - 1, 2 * shape[1] - 1), dtype=np.uint8)
    v, u = np.unravel_index(triangles, shape)
    for start, end in ((0, 1), (1, 2), (2, 0)):
        straight = (v[:, start] == v[:, end]) | (u[:, start] == u[:, end])
        drawing[v[:, start] + v[:, end], u[:, start] + u[:, end]] |= straight
    drawing[2 * v, 2 * u] = 1
    _, labels = cv2.connectedComponents(drawing, connectivity=4, ltype=cv2.CV_32S)
    return np.asarray(labels[2 * v[:, 0], 2 * u[:, 0]])


def view_mesh(
    measured: MeasuredView, sensor2reference: FloatArray, box: Box, rgb: tuple[int, int, int]
) -> TriangleMesh:
    """Mesh every second reading of a view inside a volume, in one colour.

    Parameters
    ----------
    measured
    sensor2reference : (4, 4) float64, mm
        Pose of the depth camera.
    box
        The volume of interest, reference frame.
    rgb
        Colour of every vertex.

    Returns
    -------
    TriangleMesh, mm, reference frame
    """
    camera = measured.view.sensor.depth_camera
    points = measured.points[::_STEP, ::_STEP]
    placed = transform(sensor2reference, points)
    edges = _STEP * longest_edges(points[..., 2], camera.fx)
    triangles = triangulate(placed, is_inside(placed, box), edges)
    colors = np.broadcast_to(np.array(rgb, dtype=np.uint8), placed.shape)
    return join([RangeMesh(placed, triangles, colors, sensor2reference, camera)])
