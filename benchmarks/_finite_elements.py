"""A rigid cylinder or ball on a layered pad, by finite elements: plane strain, axisymmetric."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import numpy as np
import skfem
from scipy.sparse.linalg import splu

from insole_core.contact.elastic_layers import Layer
from insole_core.geometry.arrays import BoolArray, FloatArray

FINE = 60
"""Elements below what may touch."""
_COARSE = 24
"""Elements beside it."""
_MAY_TOUCH = 1.3
"""Against the half width at which the undeformed surfaces cross."""
_BESIDE = 4.0
_ROUNDS = 60


@dataclass(frozen=True)
class Indented:
    """What a body does to a pad.

    Parameters
    ----------
    load_n
        Of a cylinder per mm of its length.
    peak_mpa
    """

    load_n: float
    peak_mpa: float


def indent(
    layers: Sequence[Layer], radius_mm: float, sunk_mm: float, *, is_ball: bool, fine: int = FINE
) -> Indented:
    """Press a body into a pad whose lower face is glued, without friction on its upper one.

    Parameters
    ----------
    layers
        From the upper face down.
    fine
        As `FINE`; through a layer go a fifth of them.
    """
    touching_mm = _MAY_TOUCH * float(np.sqrt(2 * radius_mm * sunk_mm))
    basis = skfem.Basis(_mesh(layers, touching_mm, fine), skfem.ElementVector(skfem.ElementQuad2()))
    around = skfem.BilinearForm(lambda u, v, w: _work(u, v, w, layers, is_ball=is_ball))
    matrix = around.assemble(basis).tocsc()
    height_mm = sum(layer.thickness_mm for layer in layers)
    top = basis.get_dofs(lambda x: np.isclose(x[1], height_mm)).all(["u^2"])
    top = top[basis.doflocs[0, top] <= touching_mm + 1e-9]
    top = top[np.argsort(basis.doflocs[0, top])]
    held = np.concatenate(
        [
            basis.get_dofs(lambda x: np.isclose(x[1], 0.0)).all(),
            basis.get_dofs(lambda x: np.isclose(x[0], 0.0)).all(["u^1"]),
        ]
    )
    x_mm = basis.doflocs[0, top]
    sunk = _sunk_by_forces(matrix, np.setdiff1d(np.arange(basis.N), held), top)
    forces = _balanced(sunk, sunk_mm - x_mm**2 / (2 * radius_mm))
    areas = _areas(x_mm, is_ball=is_ball)
    wide = areas > 0.2 * np.median(areas)
    peak = float((forces[wide] / areas[wide]).max())
    return Indented(float(forces.sum()) * (1 if is_ball else 2), peak)


def _mesh(layers: Sequence[Layer], touching_mm: float, fine: int) -> Any:
    height = sum(layer.thickness_mm for layer in layers)
    beside = touching_mm + _BESIDE * height * np.linspace(0, 1, _COARSE + 1)[1:] ** 1.7
    faces = np.cumsum([0.0, *(layer.thickness_mm for layer in reversed(layers))])
    y = [np.linspace(a, b, fine // 5 + 1) for a, b in pairwise(faces)]
    across = np.concatenate([np.linspace(0, touching_mm, fine + 1), beside])
    return skfem.MeshQuad.init_tensor(across, np.unique(np.concatenate(y).round(9)))


def _work(u: Any, v: Any, w: Any, layers: Sequence[Layer], *, is_ball: bool) -> Any:
    """Virtual work of an elastic material, in plane strain or around an axis."""
    shear, lame = np.zeros_like(w.x[1]), np.zeros_like(w.x[1])
    lower = 0.0
    for layer in reversed(layers):
        here = (w.x[1] >= lower) & (w.x[1] <= lower + layer.thickness_mm)
        own = layer.modulus_mpa / (2 * (1 + layer.poisson))
        shear[here] = own
        lame[here] = 2 * own * layer.poisson / (1 - 2 * layer.poisson)
        lower += layer.thickness_mm
    around_u = u[0] / w.x[0] if is_ball else 0.0
    around_v = v[0] / w.x[0] if is_ball else 0.0
    grown = (u.grad[0, 0] + u.grad[1, 1] + around_u) * (v.grad[0, 0] + v.grad[1, 1] + around_v)
    turned = (u.grad[0, 1] + u.grad[1, 0]) * (v.grad[0, 1] + v.grad[1, 0]) / 2
    strained = u.grad[0, 0] * v.grad[0, 0] + u.grad[1, 1] * v.grad[1, 1] + around_u * around_v
    around = 2 * np.pi * w.x[0] if is_ball else 1.0
    return (lame * grown + 2 * shear * (strained + turned)) * around


def _sunk_by_forces(matrix: Any, free: Any, top: Any) -> FloatArray:
    """(n, n) how far the upper face sinks at each node under 1 N on each other one."""
    solved = splu(matrix[free][:, free].tocsc())
    rows = np.searchsorted(free, top)
    loads = np.zeros((len(free), len(top)))
    loads[rows, np.arange(len(top))] = 1.0
    return np.asarray(solved.solve(loads)[rows])


def _balanced(sunk: FloatArray, wanted_mm: FloatArray) -> FloatArray:
    """Return the forces, none pulling, under which what touches sinks as far as the body."""
    touches: BoolArray = wanted_mm > 0
    forces = np.zeros(len(wanted_mm))
    for _ in range(_ROUNDS):
        forces[:] = 0.0
        forces[touches] = np.linalg.solve(sunk[np.ix_(touches, touches)], wanted_mm[touches])
        after = np.where(touches, forces > 0, sunk @ forces < wanted_mm - 1e-9)
        if (after == touches).all():
            break
        touches = after
    return forces


def _areas(x_mm: FloatArray, *, is_ball: bool) -> FloatArray:
    """(n,) area, or width, that each node of quadratic elements stands for."""
    areas = np.zeros(len(x_mm))
    for first in range(0, len(x_mm) - 2, 2):
        low, high = x_mm[first], x_mm[first + 2]
        s, weight = np.polynomial.legendre.leggauss(3)
        s = (s + 1) / 2
        shapes = np.stack([(1 - s) * (1 - 2 * s), 4 * s * (1 - s), s * (2 * s - 1)])
        around = 2 * np.pi * (low + s * (high - low)) if is_ball else np.ones(3)
        areas[first : first + 3] += (shapes * around * weight / 2).sum(axis=1) * (high - low)
    return areas
