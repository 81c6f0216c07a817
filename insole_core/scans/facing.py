"""Which way the triangles of a surface face."""

from __future__ import annotations

import numpy as np

from insole_core.geometry.mesh import TriangleMesh

INSIDE_OUT = "The surface was inside out and has been turned."


def faces_outwards(mesh: TriangleMesh) -> bool:
    """Return whether the triangles face outwards on the whole, of an open surface as well.

    By the flux of the vectors from the middle: for a closed surface it is three times the volume,
    wherever the middle lies.
    """
    areas_mm2 = mesh.triangle_areas_mm2
    centres = mesh.vertices[mesh.triangles].mean(axis=1)
    middle = areas_mm2 @ centres / mesh.area_mm2
    flux = np.einsum("i,ij,ij->", areas_mm2, mesh.triangle_normals, centres - middle)
    return bool(flux >= 0)
