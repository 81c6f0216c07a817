"""The likeliest smooth surface near a mesh, given all readings (maximum a posteriori)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy import sparse
from scipy.sparse.linalg import SuperLU, splu

from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.mesh_graph import laplacian, smoothed_normals
from insole_core.geometry.ray_casting import RayCaster
from insole_core.reconstruct.fusion.observation import SHARED_PX, Observations, observe
from insole_core.reconstruct.fusion.reading import Reading
from insole_core.reconstruct.fusion.view_gaps import view_gaps
from insole_core.reconstruct.views_at_once import for_views


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
    readings: list[Reading],
    limits: RefinementLimits = RefinementLimits(),
) -> RefinedSurface:
    """Move the vertices along their normals to the posterior's maximum.

    Unknown are the displacements and, per view, an offset and two tilts of the disparity; the
    residuals are disparities along the rays, where the sensor's noise is even; the prior is a
    thin plate. One linear system, solved a few times with the weights of the last solution.

    Parameters
    ----------
    mesh
    readings
    """
    normals = smoothed_normals(mesh, 5)
    caster = RayCaster(mesh)
    seen = for_views(lambda reading: observe(reading, mesh, normals, caster), readings)
    system = _System.of(mesh, normals, seen, limits)
    displacement = np.zeros(len(mesh.vertices))
    views = np.zeros(3 * len(seen))
    for _ in range(limits.rounds):
        weights = system.robust_weights(displacement, views)
        solver = system.factorised(weights)
        displacement, views = system.solve(solver, weights)
    moved = np.clip(displacement, -limits.farthest_mm, limits.farthest_mm)
    return RefinedSurface(
        mesh.moved(mesh.vertices + moved[:, None] * normals),
        system.deviation_mm(solver, weights),
        views.reshape(-1, 3),
        view_gaps(mesh, normals, displacement, readings, seen),
    )


def _robust(left: FloatArray, information: FloatArray, robust: float) -> FloatArray:
    """Weights of residuals, Geman & McClure."""
    # What a window's readings share does not widen the spread of a single one.
    single = left**2 * information * SHARED_PX
    return np.asarray(information / (1 + single / robust**2))


@dataclass(frozen=True, eq=False)
class _System:
    """The equations of all views with the prior."""

    design: sparse.csr_array[np.float64]
    terms: FloatArray
    residuals: FloatArray
    information: FloatArray
    bending: sparse.csr_array[np.float64]
    bent_mm: FloatArray
    plate: sparse.csr_array[np.float64]
    limits: RefinementLimits

    @staticmethod
    def of(
        mesh: TriangleMesh,
        normals: FloatArray,
        seen: list[Observations],
        limits: RefinementLimits,
    ) -> _System:
        bending = laplacian(mesh)
        tiny = 1e-6 * sparse.eye_array(bending.shape[0])
        bent_mm = np.einsum("nc,nc->n", np.asarray(bending @ mesh.vertices), normals)
        return _System(
            sparse.csr_array(sparse.vstack([part.design for part in seen])),
            _block_diagonal([part.terms for part in seen]),
            np.concatenate([part.residuals for part in seen]),
            np.concatenate([part.information for part in seen]),
            bending,
            bent_mm,
            sparse.csr_array(limits.stiffness * (bending.T @ bending) + tiny),
            limits,
        )

    def robust_weights(self, displacement: FloatArray, views: FloatArray) -> FloatArray:
        left = self.residuals - self.design @ displacement - self.terms @ views
        return _robust(left, self.information, self.limits.robust)

    def factorised(self, weights: FloatArray) -> SuperLU:
        weighted = sparse.diags_array(weights) @ self.design
        return splu(
            sparse.csc_array(self.design.T @ weighted + self.plate),
            permc_spec="MMD_AT_PLUS_A",
            diag_pivot_thresh=0.0,  # positive definite: the diagonal will do, and keeps the order
            panel_size=2,
            options={"SymmetricMode": True},
        )

    def solve(self, solver: SuperLU, weights: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Solve for displacements and view terms; the views are eliminated (Schur complement)."""
        pull = self.design.T @ (weights * self.residuals)
        alone = solver.solve(
            np.asarray(pull - self.limits.stiffness * (self.bending.T @ self.bent_mm))
        )
        coupling = np.asarray(self.design.T @ (weights[:, None] * self.terms))
        response = solver.solve(coupling)
        prior = np.eye(self.terms.shape[1]) / self.limits.view_offset_raw**2
        schur = self.terms.T @ (weights[:, None] * self.terms) + prior - coupling.T @ response
        pull_views = self.terms.T @ (weights * self.residuals) - coupling.T @ alone
        views = np.linalg.solve(schur, pull_views)
        return alone - response @ views, views

    def deviation_mm(self, solver: SuperLU, weights: FloatArray) -> FloatArray:
        """Spread of draws from the posterior, by perturbing data and prior and solving."""
        rng = np.random.default_rng(0)
        count = self.limits.samples
        data = np.sqrt(weights)[:, None] * rng.standard_normal((len(weights), count))
        plate = rng.standard_normal((self.bending.shape[0], count))
        pull = self.design.T @ data + np.sqrt(self.limits.stiffness) * (self.bending.T @ plate)
        return np.asarray(np.sqrt((solver.solve(pull) ** 2).mean(1)))


def _block_diagonal(parts: list[FloatArray]) -> FloatArray:
    return np.asarray(sparse.block_diag(parts).toarray())
