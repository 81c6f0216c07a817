"""The likeliest smooth surface near a mesh, given all readings (maximum a posteriori)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy import sparse
from scipy.sparse.linalg import LinearOperator, SuperLU, cg, splu

from insole_core.errors import ReconstructionError
from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.mesh_graph import smoothed_normals
from insole_core.geometry.ray_casting import RayCaster
from insole_core.reconstruct.fusion.depth_view import DepthView
from insole_core.reconstruct.fusion.observation import SHARED_PX, Observations, observe
from insole_core.reconstruct.fusion.view_gaps import view_gaps
from insole_core.reconstruct.parallel import both, for_views

_EXACT, _MOST_STEPS = 1e-6, 500
"""Residual of the normal equations, as a share of their right side: micrometres."""


@dataclass(frozen=True)
class RefinementLimits:
    """What is known beforehand.

    Parameters
    ----------
    stiffness
        Inverse variance of the bending of the surface: of how far, in mm, a vertex lies from the
        mean of its neighbours along the normal.
    view_offset_raw
        Standard deviation of a view's own disparity offset, and of its tilt per 100 pixels.
    robust
        Residuals from so many standard deviations on lose weight (Geman & McClure).
    rounds
        Times that the weights are determined anew.
    farthest_mm
        No vertex moves farther.
    samples
        Draws from the posterior that its spread is estimated from.
    """

    stiffness: float = 3.0
    view_offset_raw: float = 0.1
    robust: float = 2.5
    rounds: int = 2
    farthest_mm: float = 4.0
    samples: int = 12


@dataclass(frozen=True, eq=False)
class RefinedSurface:
    """A refined mesh.

    Parameters
    ----------
    mesh
    deviation_mm : (n,) float64
        Standard deviation of the vertices along their normals.
    view_offsets_raw : (views, 3) float64
        Offset and tilts that each view was found to have.
    view_gaps_mm : (views, views, 3) float64, reference frame
        The shift from each view's surface to each other's (see `view_gaps`).
    """

    mesh: TriangleMesh
    deviation_mm: FloatArray
    view_offsets_raw: FloatArray
    view_gaps_mm: FloatArray


def refine(
    mesh: TriangleMesh,
    readings: list[DepthView],
    limits: RefinementLimits = RefinementLimits(),
) -> RefinedSurface:
    """Move the vertices along their normals to the posterior's maximum.

    Unknown are the displacements and, per view, an offset and two tilts of the disparity; the
    residuals are disparities along the rays, where the sensor's noise is even; the prior is a
    thin plate. One linear system, solved a few times with the weights of the last solution: the
    first time directly, then by conjugate gradients from there, for which the first is so near
    that a few steps will do.

    Parameters
    ----------
    mesh
    readings
    """
    normals = smoothed_normals(mesh, 5)
    caster = RayCaster(mesh)
    seen, plate = both(
        lambda: for_views(lambda reading: observe(reading, mesh, normals, caster), readings),
        lambda: _Plate.of(mesh, normals, limits.stiffness),
    )
    system = _System.of(seen, plate, limits)
    weights = system.robust_weights(np.zeros(system.size))
    inverse = system.inverse(weights)
    deviation_mm, found = both(
        lambda: system.deviation_mm(inverse, weights), lambda: system.improved(inverse, weights)
    )
    displacement, views = np.split(found, [len(mesh.vertices)])
    moved = np.clip(displacement, -limits.farthest_mm, limits.farthest_mm)
    return RefinedSurface(
        mesh.moved(mesh.vertices + moved[:, None] * normals),
        deviation_mm,
        views.reshape(-1, 3),
        view_gaps(mesh, normals, displacement, readings, seen),
    )


def _robust(left: FloatArray, information: FloatArray, robust: float) -> FloatArray:
    """Weights of residuals, Geman & McClure."""
    # What a window's readings share does not widen the spread of a single one.
    single = left**2 * information * SHARED_PX
    return np.asarray(information / (1 + single / robust**2))


@dataclass(frozen=True, eq=False)
class _Plate:
    """The prior: a thin plate, bent as the mesh is.

    Parameters
    ----------
    bending : (n, n) sparse
        Of a surface, from the displacements of its vertices.
    bent_mm : (n,) float64
        The mesh's own.
    normal : (n, n) sparse
        What it adds to the normal equations; a little more, so that they can be solved anywhere.
    """

    bending: sparse.csr_array[np.float64]
    bent_mm: FloatArray
    normal: sparse.csr_array[np.float64]

    @staticmethod
    def of(mesh: TriangleMesh, normals: FloatArray, stiffness: float) -> _Plate:
        bending = mesh.links.laplacian
        bent_mm = np.einsum("nc,nc->n", np.asarray(bending @ mesh.vertices), normals)
        tiny = 1e-6 * sparse.eye_array(len(bent_mm))
        normal = sparse.csr_array(stiffness * (bending.T @ bending) + tiny)
        return _Plate(bending, bent_mm, normal)


@dataclass(frozen=True, eq=False)
class _System:
    """The equations of all views with the prior."""

    design: sparse.csr_array[np.float64]
    terms: FloatArray
    residuals: FloatArray
    information: FloatArray
    plate: _Plate
    limits: RefinementLimits

    @staticmethod
    def of(seen: list[Observations], plate: _Plate, limits: RefinementLimits) -> _System:
        return _System(
            sparse.csr_array(sparse.vstack([part.design for part in seen])),
            _block_diagonal([part.terms for part in seen]),
            np.concatenate([part.residuals for part in seen]),
            np.concatenate([part.information for part in seen]),
            plate,
            limits,
        )

    @property
    def vertices(self) -> int:
        """Number of the vertices."""
        return len(self.plate.bent_mm)

    @property
    def size(self) -> int:
        """Number of the unknowns: displacements of the vertices, then three terms of every view."""
        return self.vertices + int(self.terms.shape[1])

    def robust_weights(self, found: FloatArray) -> FloatArray:
        left = self.residuals - self._predicted(found)
        return _robust(left, self.information, self.limits.robust)

    def pull(self, weights: FloatArray) -> FloatArray:
        """Right side of the normal equations (unknowns,)."""
        pull = self._gathered(weights * self.residuals)
        bent = np.asarray(self.plate.bending.T @ self.plate.bent_mm)
        pull[: len(bent)] -= self.limits.stiffness * bent
        return pull

    def inverse(self, weights: FloatArray) -> _Inverse:
        """Factorise the normal equations; the views are eliminated (Schur complement)."""
        weighted = sparse.diags_array(weights) @ self.design
        solver = splu(
            sparse.csc_array(self.design.T @ weighted + self.plate.normal),
            permc_spec="MMD_AT_PLUS_A",
            diag_pivot_thresh=0.0,  # positive definite: the diagonal will do, and keeps the order
            panel_size=2,
            options={"SymmetricMode": True},
        )
        coupling = np.asarray(self.design.T @ (weights[:, None] * self.terms))
        response = solver.solve(coupling)
        own = self.terms.T @ (weights[:, None] * self.terms) + self._views_prior()
        return _Inverse(solver, coupling, response, own - coupling.T @ response)

    def improved(self, inverse: _Inverse, weights: FloatArray) -> FloatArray:
        """Solve (unknowns,), and again with the weights that follow from it."""
        found = inverse.applied(self.pull(weights))
        for _ in range(self.limits.rounds - 1):
            found = self.solved(self.robust_weights(found), found, inverse)
        return found

    def solved(self, weights: FloatArray, start: FloatArray, nearly: _Inverse) -> FloatArray:
        """Solve the normal equations of weights whose inverse is nearly known, from a start."""
        shape = (self.size, self.size)
        normal = LinearOperator(shape, lambda found: self._normal(weights, found), dtype=float)
        inverse = LinearOperator(shape, nearly.applied, dtype=float)
        # Residuals change their weights by some hundred times at most: a hundred steps always do.
        found, missed = cg(
            normal, self.pull(weights), start, rtol=_EXACT, M=inverse, maxiter=_MOST_STEPS
        )
        if missed or not np.isfinite(found).all():
            raise ReconstructionError(
                "The surface could not be fitted to the views; see whether a view is spoilt, and "
                "leave it out."
            )
        return np.asarray(found)

    def _normal(self, weights: FloatArray, found: FloatArray) -> FloatArray:
        displacement, views = np.split(found, [self.vertices])
        prior = np.concatenate(
            [np.asarray(self.plate.normal @ displacement), self._views_prior() @ views]
        )
        return np.asarray(self._gathered(weights * self._predicted(found)) + prior)

    def _predicted(self, found: FloatArray) -> FloatArray:
        displacement, views = np.split(found, [self.vertices])
        return np.asarray(np.asarray(self.design @ displacement) + self.terms @ views)

    def _gathered(self, weighted: FloatArray) -> FloatArray:
        of_vertices = np.asarray(self.design.T @ weighted)
        return np.asarray(np.concatenate([of_vertices, self.terms.T @ weighted]))

    def _views_prior(self) -> FloatArray:
        return np.asarray(np.eye(self.terms.shape[1]) / self.limits.view_offset_raw**2)

    def deviation_mm(self, inverse: _Inverse, weights: FloatArray) -> FloatArray:
        """Spread of draws from the posterior, by perturbing data and prior and solving."""
        rng = np.random.default_rng(0)
        count = self.limits.samples
        data = np.sqrt(weights)[:, None] * rng.standard_normal((len(weights), count))
        bent = self.plate.bending.T @ rng.standard_normal((self.vertices, count))
        pull = self.design.T @ data + np.sqrt(self.limits.stiffness) * bent
        return np.asarray(np.sqrt((inverse.solver.solve(pull) ** 2).mean(1)))


@dataclass(frozen=True, eq=False)
class _Inverse:
    """The inverse of the normal equations of all unknowns.

    Parameters
    ----------
    solver
        Of the vertices alone.
    coupling, response : (n, 3 * views) float64
        What the vertices and the views have to do with each other, and what the vertices answer.
    schur : (3 * views, 3 * views) float64
        Of the views, after that.
    """

    solver: SuperLU
    coupling: FloatArray
    response: FloatArray
    schur: FloatArray

    def applied(self, pull: FloatArray) -> FloatArray:
        """Solve for displacements and view terms (unknowns,)."""
        of_vertices, of_views = np.split(pull, [len(self.coupling)])
        alone = self.solver.solve(of_vertices)
        views = np.linalg.solve(self.schur, of_views - self.coupling.T @ alone)
        return np.concatenate([alone - self.response @ views, views])


def _block_diagonal(parts: list[FloatArray]) -> FloatArray:
    return np.asarray(sparse.block_diag(parts).toarray())
