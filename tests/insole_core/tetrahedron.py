"""A small closed surface, of which no two sides are as long."""

from __future__ import annotations

import numpy as np

from insole_core.geometry.mesh import TriangleMesh

CORNERS = np.array([[0.0, 0, 0], [10, 0, 0], [0, 20, 0], [0, 0, 30.125]])
FACES = np.array([[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]], np.int32)
TETRA = TriangleMesh(CORNERS, FACES)
