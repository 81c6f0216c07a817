"""The most probable smooth surface near a mesh, given all readings (maximum a posteriori)."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace

import numpy as np
import scipy

from insole_core.errors import ReconstructionError
from insole_core.geometry.arrays import BoolArray, FloatArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.mesh_graph import smoothed_normals
from insole_core.geometry.ray_casting import RayCaster
from insole_core.reconstruct.fusion.depth_view import DepthView
from insole_core.reconstruct.fusion.observation import Observations, observe, view_gaps
from insole_core.reconstruct.parallel import both, for_views

_EXACT, _MOST_STEPS = 1e-6, 500
"""Residual of the normal equations, relative to their right-hand side: micrometres."""


@dataclass(frozen=True)
class RefinementLimits:
    """The prior and the parameters of the solver.

    Parameters
    ----------
    stiffness
        Inverse variance of the bending of the surface, 1/mm²: of a vertex's distance along the
        normal from the mean of its neighbours.
    view_offset_raw
        Standard deviation of a view's own disparity offset, and of its tilts per 100 pixels.
    robust
        Scale of the robust weights in standard deviations (Geman & McClure).
    rounds
        Number of solutions, each with the weights that follow from the one before.
    farthest_mm
        Largest displacement of a vertex.
    samples
        Number of draws from the posterior by which its spread is estimated.
    """

    stiffness: float = 3.0
    view_offset_raw: float = 0.1
    robust: float = 2.5
    rounds: int = 2
    farthest_mm: float = 4.0
    samples: int = 12


@dataclass(frozen=True, eq=False)
class RefinedSurface:
    """A refined mesh with its uncertainty.

    Parameters
    ----------
    mesh : mm, reference frame
    deviation_mm : (n,) float64
        Standard deviation of the vertices along their normals.
    view_offsets_raw : (views, 3) float64
        Estimated offset and tilts (per 100 pixels) of each view's disparity.
    view_gaps_mm : (views, views, 3) float64, reference frame
        The shift from each view's surface to each other's (see `view_gaps`).
    by_further : (n,) bool
        Where further evidence is more certain than the readings (see `refine_near`).
    """

    mesh: TriangleMesh
    deviation_mm: FloatArray
    view_offsets_raw: FloatArray
    view_gaps_mm: FloatArray
    by_further: BoolArray


def refine(
    mesh: TriangleMesh,
    readings: list[DepthView],
    limits: RefinementLimits = RefinementLimits(),
) -> RefinedSurface:
    """Move the vertices along their normals to the maximum of the posterior.

    The unknowns are the displacements and, per view, an offset and two tilts of the disparity. The
    residuals are disparities along the rays, in which the sensor's noise is uniform; the prior is
    a thin plate. The linear system is solved a few times with the weights of the last solution:
    first directly, then by conjugate gradients, which need few steps because the first
    factorisation is a good preconditioner.

    Parameters
    ----------
    mesh : mm, reference frame
    readings
        Of all views.
    limits

    Returns
    -------
    RefinedSurface

    Raises
    ------
    ReconstructionError
        When the iteration does not converge, as with a corrupted view.
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
    std_mm, solution = both(
        lambda: system.std_mm(inverse, weights), lambda: system.improved(inverse, weights)
    )
    displacement, views = np.split(solution, [len(mesh.vertices)])
    moved = np.clip(displacement, -limits.farthest_mm, limits.farthest_mm)
    return RefinedSurface(
        mesh.moved(mesh.vertices + moved[:, None] * normals),
        std_mm,
        views.reshape(-1, 3),
        view_gaps(mesh, normals, displacement, readings, seen),
        np.zeros(len(std_mm), dtype=bool),
    )


@dataclass(frozen=True)
class NearLimits:
    """How a surface is refined by further evidence.

    Parameters
    ----------
    refinement
        The bending counts that of the change. A view's offset is nearly free: a pattern drifts as a
        whole, and how far a view is off the sensor's own depth tells better.
    hold
        Inverse variance of the change itself, 1/mm², as the readings so far determine it.
    rounds
        Number of times that the evidence is taken anew.
    farthest_mm
        Largest displacement of a vertex in a round.
    """

    refinement: RefinementLimits = field(
        default_factory=lambda: RefinementLimits(stiffness=30.0, view_offset_raw=0.2)
    )
    hold: float = 0.003
    rounds: int = 2
    farthest_mm: float = 2.0


def refine_near(
    start: RefinedSurface,
    observe_mesh: Callable[[TriangleMesh, FloatArray, RayCaster], list[Observations]],
    limits: NearLimits = NearLimits(),
) -> RefinedSurface:
    """Change a surface smoothly towards further evidence; without any it keeps its shape.

    Parameters
    ----------
    start
    observe_mesh
        Compares all views with a mesh, the directions of its vertices and its ray caster.
    limits

    Returns
    -------
    RefinedSurface
        With the gaps of `start`, and at each vertex the deviation of what is more certain there:
        the change by the further evidence, or `start`.
    """
    mesh, changed_mm = start.mesh, np.full(len(start.deviation_mm), np.inf)
    for number in range(limits.rounds):
        normals = smoothed_normals(mesh, 5)
        seen = observe_mesh(mesh, normals, RayCaster(mesh))
        if not seen:
            break
        system = _System.of(seen, _Plate.near(mesh, start.mesh, normals, limits), limits.refinement)
        rhs = system.rhs(system.information)
        change = mesh.vertices - start.mesh.vertices
        rhs[: system.vertices] -= limits.hold * np.einsum("nc,nc->n", change, normals)
        inverse = system.inverse(system.information)
        displacement = inverse.applied(rhs)[: system.vertices]
        moved = np.clip(displacement, -limits.farthest_mm, limits.farthest_mm)
        mesh = mesh.moved(mesh.vertices + moved[:, None] * normals)
        if number == limits.rounds - 1:
            changed_mm = system.std_mm(inverse, system.information)
    return replace(
        start,
        mesh=mesh,
        deviation_mm=np.minimum(start.deviation_mm, changed_mm),
        by_further=changed_mm < start.deviation_mm,
    )


def _robust(
    residuals: FloatArray, information: FloatArray, shared: FloatArray, robust: float
) -> FloatArray:
    """Compute the weights of residuals (Geman & McClure)."""
    # The error that the readings of a window share does not widen the spread of a single one.
    single = residuals**2 * information * shared
    return np.asarray(information / (1 + single / robust**2))


@dataclass(frozen=True, eq=False)
class _Plate:
    """The prior: the energy of a thin plate.

    Parameters
    ----------
    bending : (n, n) sparse
        From the displacements of the vertices to the change of the bending.
    bent_mm : (n,) float64
        Bending of the mesh itself.
    normal : (n, n) sparse
        Its part of the normal equations, plus a small diagonal that makes them regular.
    """

    bending: scipy.sparse.csr_array[np.float64]
    bent_mm: FloatArray
    normal: scipy.sparse.csr_array[np.float64]

    @staticmethod
    def of(mesh: TriangleMesh, normals: FloatArray, stiffness: float) -> _Plate:
        bending = mesh.links.laplacian
        bent_mm = np.einsum("nc,nc->n", np.asarray(bending @ mesh.vertices), normals)
        tiny = 1e-6 * scipy.sparse.eye_array(len(bent_mm))
        normal = scipy.sparse.csr_array(stiffness * (bending.T @ bending) + tiny)
        return _Plate(bending, bent_mm, normal)

    @staticmethod
    def near(
        mesh: TriangleMesh, start: TriangleMesh, normals: FloatArray, limits: NearLimits
    ) -> _Plate:
        """Return the prior of the change from `start`, which has the same triangles."""
        plate = _Plate.of(mesh, normals, limits.refinement.stiffness)
        change = np.asarray(plate.bending @ (mesh.vertices - start.vertices))
        held = limits.hold * scipy.sparse.eye_array(len(normals))
        return _Plate(
            plate.bending,
            np.einsum("nc,nc->n", change, normals),
            scipy.sparse.csr_array(plate.normal + held),
        )


@dataclass(frozen=True, eq=False)
class _System:
    """The equations of all views and the prior."""

    design: scipy.sparse.csr_array[np.float64]
    terms: FloatArray
    residuals: FloatArray
    information: FloatArray
    shared: FloatArray
    plate: _Plate
    limits: RefinementLimits

    @staticmethod
    def of(seen: list[Observations], plate: _Plate, limits: RefinementLimits) -> _System:
        return _System(
            scipy.sparse.csr_array(scipy.sparse.vstack([part.design for part in seen])),
            _block_diagonal([part.terms for part in seen]),
            np.concatenate([part.residuals for part in seen]),
            np.concatenate([part.information for part in seen]),
            np.concatenate([part.shared for part in seen]),
            plate,
            limits,
        )

    @property
    def vertices(self) -> int:
        """Number of vertices."""
        return len(self.plate.bent_mm)

    @property
    def size(self) -> int:
        """Number of unknowns: displacements of the vertices, then three terms of every view."""
        return self.vertices + int(self.terms.shape[1])

    def robust_weights(self, solution: FloatArray) -> FloatArray:
        residuals = self.residuals - self._predicted(solution)
        return _robust(residuals, self.information, self.shared, self.limits.robust)

    def rhs(self, weights: FloatArray) -> FloatArray:
        """Compute the right-hand side of the normal equations (unknowns,)."""
        rhs = self._gathered(weights * self.residuals)
        bent = np.asarray(self.plate.bending.T @ self.plate.bent_mm)
        rhs[: len(bent)] -= self.limits.stiffness * bent
        return rhs

    def inverse(self, weights: FloatArray) -> _Inverse:
        """Factorise the normal equations with the Schur complement of the views."""
        weighted = scipy.sparse.diags_array(weights) @ self.design
        solver = scipy.sparse.linalg.splu(
            scipy.sparse.csc_array(self.design.T @ weighted + self.plate.normal),
            permc_spec="MMD_AT_PLUS_A",
            diag_pivot_thresh=0.0,  # positive definite: no pivoting, which keeps the order
            panel_size=2,
            options={"SymmetricMode": True},
        )
        coupling = np.asarray(self.design.T @ (weights[:, None] * self.terms))
        response = solver.solve(coupling)
        own = self.terms.T @ (weights[:, None] * self.terms) + self._views_prior()
        return _Inverse(solver, coupling, response, own - coupling.T @ response)

    def improved(self, inverse: _Inverse, weights: FloatArray) -> FloatArray:
        """Solve for the unknowns (unknowns,), then again with the weights of each solution."""
        solution = inverse.applied(self.rhs(weights))
        for _ in range(self.limits.rounds - 1):
            solution = self.solved(self.robust_weights(solution), solution, inverse)
        return solution

    def solved(self, weights: FloatArray, start: FloatArray, nearly: _Inverse) -> FloatArray:
        """Solve the normal equations by conjugate gradients, preconditioned by `nearly`."""
        shape = (self.size, self.size)
        normal = scipy.sparse.linalg.LinearOperator(
            shape, lambda x: self._normal(weights, x), dtype=float
        )
        inverse = scipy.sparse.linalg.LinearOperator(shape, nearly.applied, dtype=float)
        # Weights change by a factor of some hundred at most, so a hundred steps are enough.
        solution, missed = scipy.sparse.linalg.cg(
            normal, self.rhs(weights), start, rtol=_EXACT, M=inverse, maxiter=_MOST_STEPS
        )
        if missed or not np.isfinite(solution).all():
            raise ReconstructionError(
                "The surface could not be fitted to the views; see whether a view is spoilt, and "
                "leave it out."
            )
        return np.asarray(solution)

    def _normal(self, weights: FloatArray, solution: FloatArray) -> FloatArray:
        displacement, views = np.split(solution, [self.vertices])
        prior = np.concatenate(
            [np.asarray(self.plate.normal @ displacement), self._views_prior() @ views]
        )
        return np.asarray(self._gathered(weights * self._predicted(solution)) + prior)

    def _predicted(self, solution: FloatArray) -> FloatArray:
        displacement, views = np.split(solution, [self.vertices])
        return np.asarray(np.asarray(self.design @ displacement) + self.terms @ views)

    def _gathered(self, weighted: FloatArray) -> FloatArray:
        of_vertices = np.asarray(self.design.T @ weighted)
        return np.asarray(np.concatenate([of_vertices, self.terms.T @ weighted]))

    def _views_prior(self) -> FloatArray:
        return np.asarray(np.eye(self.terms.shape[1]) / self.limits.view_offset_raw**2)

    def std_mm(self, inverse: _Inverse, weights: FloatArray) -> FloatArray:
        """Estimate the standard deviations (n,) from draws: perturb data and prior, and solve."""
        rng = np.random.default_rng(0)
        count = self.limits.samples
        data = np.sqrt(weights)[:, None] * rng.standard_normal((len(weights), count))
        bent = self.plate.bending.T @ rng.standard_normal((self.vertices, count))
        rhs = self.design.T @ data + np.sqrt(self.limits.stiffness) * bent
        return np.asarray(np.sqrt((inverse.solver.solve(rhs) ** 2).mean(1)))


@dataclass(frozen=True, eq=False)
class _Inverse:
    """The factorised normal equations of all unknowns.

    Parameters
    ----------
    solver
        Of the vertices alone.
    coupling, response : (n, 3 * views) float64
        The block of the normal equations between vertices and views, and `solver` applied to it.
    schur : (3 * views, 3 * views) float64
        Schur complement of the views.
    """

    solver: scipy.sparse.linalg.SuperLU
    coupling: FloatArray
    response: FloatArray
    schur: FloatArray

    def applied(self, rhs: FloatArray) -> FloatArray:
        """Solve for displacements and view terms (unknowns,)."""
        of_vertices, of_views = np.split(rhs, [len(self.coupling)])
        alone = self.solver.solve(of_vertices)
        views = np.linalg.solve(self.schur, of_views - self.coupling.T @ alone)
        return np.concatenate([alone - self.response @ views, views])


def _block_diagonal(parts: list[FloatArray]) -> FloatArray:
    return np.asarray(scipy.sparse.block_diag(parts).toarray())
