"""Registration by points picked on both surfaces, or by black dots found on them."""

from __future__ import annotations

from itertools import permutations
from pathlib import Path

import numpy as np
import scipy

from insole_core.compare.best_fit import Fit
from insole_core.errors import InputError, ReconstructionError
from insole_core.geometry.absolute_orientation import absolute_orientation
from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.transforms import transform
from insole_core.json_object import JsonObject

DOTS = 4
"""Number of black dots on a mould, thesis 8.2."""
_DARK = 0.45  # of the usual brightness
_DOT_EXTENT_MM = (2.0, 20.0)
_LEAST_ROUNDNESS = 0.4
_LUMA = (0.299, 0.587, 0.114)


def read_picked_points(path: Path) -> tuple[FloatArray, FloatArray]:
    """Read points picked on a and on b: ``{"a": [[x, y, z], …], "b": [[x, y, z], …]}``, mm.

    Returns
    -------
    a, b : (n, 3) float64, mm
        Row i of one corresponds to row i of the other.

    Raises
    ------
    InputError
        Naming the file and what is wrong with it.
    """
    root = JsonObject.read(path)
    a, b = (np.array(root.vectors(key, 3)).reshape(-1, 3) for key in ("a", "b"))
    if len(a) != len(b):
        raise InputError(
            "{path} holds {count_a} points of a and {count_b} of b; pick each point on both.",
            path=path,
            count_a=len(a),
            count_b=len(b),
        )
    return a, b


def fit_points(a: FloatArray, b: FloatArray) -> Fit:
    """Fit points of b to their partners on a by Horn's method (thesis 3.2).

    Parameters
    ----------
    a, b : (n, 3) float64, mm
        Row i of one corresponds to row i of the other.

    Raises
    ------
    InputError
        If there are fewer than three points, or all on one line.
    """
    try:
        b2a = absolute_orientation(b, a).a2b
    except ReconstructionError as error:
        raise InputError(
            "The picked points cannot place one surface on the other: {reason}", reason=str(error)
        ) from error
    away = np.linalg.norm(transform(b2a, b) - a, axis=1)
    return Fit(b2a, float(np.sqrt((away**2).mean())), 1.0)


def fit_dots(a: FloatArray, b: FloatArray) -> Fit:
    """Fit dots of b to those of a without known correspondence, by trying every order.

    Parameters
    ----------
    a, b : (4, 3) float64, mm

    Raises
    ------
    InputError
        If the dots lie on one line.
    """
    fits = (fit_points(a, b[list(order)]) for order in permutations(range(len(b))))
    return min(fits, key=lambda fit: fit.residual_mm)


def find_dots(mesh: TriangleMesh, name: str) -> FloatArray:
    """Find the four black dots on a coloured surface.

    Parameters
    ----------
    name
        Of the surface, for messages.

    Returns
    -------
    (4, 3) float64, mm
        Their centres.

    Raises
    ------
    InputError
        If the surface has no colours, or not exactly four dots.
    """
    if mesh.colors is None:
        raise InputError(
            "{name} has no colours, so no dots can be found; pick the points instead.", name=name
        )
    brightness = mesh.colors @ np.array(_LUMA)
    dark = np.flatnonzero(brightness < _DARK * np.median(brightness))
    _, piece = scipy.sparse.csgraph.connected_components(
        mesh.links.adjacency[dark][:, dark], directed=False
    )
    spots = [dark[piece == number] for number in range(piece.max(initial=-1) + 1)]
    dots = [spot for spot in spots if _is_dot(mesh.vertices[spot])]
    if len(dots) != DOTS:
        raise InputError(
            "{count} black dots were found on {name} and four are needed; pick the points instead.",
            count=len(dots),
            name=name,
        )
    areas = mesh.vertex_areas
    return np.array([areas[dot] @ mesh.vertices[dot] / areas[dot].sum() for dot in dots])


def _is_dot(spot: FloatArray) -> bool:
    if len(spot) < 3:
        return False
    length, width, _ = np.linalg.svd(
        spot - spot.mean(axis=0), compute_uv=False, full_matrices=False
    )
    extent = np.ptp(spot, axis=0).max()
    return bool(
        _DOT_EXTENT_MM[0] <= extent <= _DOT_EXTENT_MM[1] and width >= _LEAST_ROUNDNESS * length
    )
