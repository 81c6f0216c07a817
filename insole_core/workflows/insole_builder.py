"""The steps from a design to an insole, with the slow ones cached: base, pads, check, solid."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property, partial
from typing import Any, TypeAlias

import numpy as np

from insole_core.foot.foot import Foot
from insole_core.geometry.arrays import FloatArray, IntArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.insole.build import Insole, build_insole, check_design_for
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.surface.contact import ContactBase, base_key, contact_base, values_but
from insole_core.insole.surface.followed_base import coarse_base
from insole_core.insole.surface.pads_on_surface import Window
from insole_core.memo import Memo
from insole_core.progress import SILENT, Progress
from insole_core.solids.prism import Prism
from insole_core.solids.shell_body import Body, BodyPlan
from insole_core.solids.solid import ClosedInsole, closed_insole, insole_solid

_KEPT, _LEAST_KEPT, _MOST_BYTES = 8, 4, 128_000_000
"""Enough to change between devices at once; on fine grids for the other foot and an undo."""

_READ_IN_PART = frozenset({"corrections", "thickness_mm", "layers"})

BareKey: TypeAlias = tuple[Any, ...]


@dataclass(frozen=True, eq=False)
class BareInsole:
    """An insole without pads: everything that adding, removing or moving pads leaves unchanged.

    Parameters
    ----------
    key
        `bare_key` of foot and design; equal keys mean equal bare insoles.
    solid : mm, insole frame
        Vertices of the top, those of the bottom below them, and a second copy of the walls'
        vertices, so that the walls are shaded with normals of their own.
    top_count
        Number of vertices on the top; as many are below them on the bottom.
    rim : (k,) int64
        Indices of the top's vertices at which the walls begin.
    plan, body
        The body between top and bottom at the nodes of the contact surface, and its plan.
    prism, outline
        Walls and edges of the body, and the upper rim.
    coarse
        The base on a coarse grid, by which it follows the finish; None of a design without one.
    """

    key: BareKey
    foot: Foot
    base: ContactBase
    solid: TriangleMesh
    top_count: int
    rim: IntArray
    plan: BodyPlan
    body: Body
    prism: Prism
    outline: FloatArray
    coarse: ContactBase | None = None

    @classmethod
    def of(
        cls,
        key: BareKey,
        foot: Foot,
        base: ContactBase,
        closed: ClosedInsole,
        coarse: ContactBase | None,
    ) -> BareInsole:
        """Return the bare insole of a closed one, with a second copy of the walls' vertices."""
        solid = closed.solid
        count = len(solid.vertices) // 2
        on_top = solid.triangles < count
        is_wall = on_top.any(axis=1) & ~on_top.all(axis=1)
        used = np.unique(solid.triangles[is_wall])
        again = np.zeros(len(solid.vertices), dtype=np.int32)
        again[used] = len(solid.vertices) + np.arange(len(used), dtype=np.int32)
        triangles = solid.triangles.copy()
        triangles[is_wall] = again[triangles[is_wall]]
        vertices = np.concatenate([solid.vertices, solid.vertices[used]])
        mesh = TriangleMesh(vertices, triangles)
        _ = mesh.vertex_normals  # kept by the mesh: computed here, not in the window
        rim = used[used < count].astype(np.int64)
        parts = closed.plan, closed.body, closed.prism, closed.outline
        return cls(key, foot, base, mesh, count, rim, *parts, coarse)

    @cached_property
    def skins(self) -> tuple[TriangleMesh, TriangleMesh]:
        """Top and bottom as meshes of all vertices, without the walls."""
        corners, count = self.solid.triangles, self.top_count
        top = (corners < count).all(axis=1)
        bottom = ((corners >= count) & (corners < 2 * count)).all(axis=1)
        return replace(self.solid, triangles=corners[top]), replace(
            self.solid, triangles=corners[bottom]
        )

    def vertices_in(self, window: Window) -> IntArray:
        """Return the indices (n,) of the vertices of both faces that depend on a window's nodes.

        Where walls lean, those of the bottom lie beside those of the top.
        """
        field = self.base.surface
        low = field.y0_mm + (window.first_row - 1) * field.step_mm
        high = field.y0_mm + window.end_row * field.step_mm
        order, y = self._by_y
        in_rows = order[slice(*np.searchsorted(y, [low, high]))]
        x = self.solid.vertices[in_rows, 0]
        left = field.x0_mm + (window.first_column - 1) * field.step_mm
        right = field.x0_mm + window.end_column * field.step_mm
        return np.asarray(in_rows[(x > left) & (x < right)])

    @cached_property
    def _by_y(self) -> tuple[IntArray, FloatArray]:
        y = self.solid.vertices[: 2 * self.top_count, 1]
        order = np.argsort(y, kind="stable")
        return order, y[order]


class InsoleBuilder:
    """Builds insoles as `build_insole` does, and caches the slow steps; thread-safe.

    Several designs of the same feet share the steps that they have in common.
    """

    def __init__(self) -> None:
        self._memo = _cache()

    def base(self, foot: Foot, design: InsoleDesign, progress: Progress = SILENT) -> ContactBase:
        """Return the contact surface before pads.

        Parameters
        ----------
        progress
            Reports nothing when the surface is cached.

        Raises
        ------
        DesignError
            When no part of the foot faces the ground.
        Cancelled
        """
        return _base(self._memo, foot, design, progress)

    def insole(self, foot: Foot, design: InsoleDesign, progress: Progress = SILENT) -> Insole:
        """Return the insole with its pads, checked.

        Raises
        ------
        DesignError
            As `build_insole`.
        Cancelled
        """
        return build_insole(foot, design, progress, base_of=partial(_base, self._memo))

    def solid(
        self, foot: Foot, design: InsoleDesign, progress: Progress = SILENT
    ) -> tuple[Insole, TriangleMesh]:
        """Return the insole and its solid with the default options.

        Returns
        -------
        insole : Insole
        solid : TriangleMesh
            Closed, mm, insole frame.

        Raises
        ------
        DesignError
            As `build_insole`, or when the outline leaves no insole.
        Cancelled
        """
        insole = self.insole(foot, design, progress.part(0.0, 0.7))
        progress.step(0.7, "Trimming the insole")
        return insole, insole_solid(insole)

    def bare(self, foot: Foot, design: InsoleDesign, progress: Progress = SILENT) -> BareInsole:
        """Return the closed insole without its pads, to move pads on.

        Raises
        ------
        DesignError
            As `build_insole` except for pads, or when the outline leaves no insole.
        Cancelled
        """
        check_design_for(foot, design)
        memo = self._memo
        make = partial(_bare, memo, foot, design, progress)
        return memo.get("bare", bare_key(foot, design), make)

    def known_bare(self, foot: Foot, design: InsoleDesign) -> BareInsole | None:
        """Return the cached bare insole of a foot and design; None when it has to be built."""
        known: BareInsole | None = self._memo.known("bare", bare_key(foot, design))
        return known

    def forget(self) -> None:
        """Clear the cache; results that are still being computed are not cached either."""
        self._memo = _cache()


def _cache() -> Memo:
    return Memo(_KEPT, most_bytes=_MOST_BYTES, least=_LEAST_KEPT)


def _base(memo: Memo, foot: Foot, design: InsoleDesign, progress: Progress) -> ContactBase:
    key = foot, base_key(design)
    return memo.get("base", key, lambda: contact_base(foot, design, progress))


def _bare(memo: Memo, foot: Foot, design: InsoleDesign, progress: Progress) -> BareInsole:
    base = _base(memo, foot, design, progress.part(0.0, 0.7))
    progress.step(0.7, "Trimming the insole")
    insole = Insole(without_added(design), foot, base.surface, base.measured, base.finished)
    closed = closed_insole(insole)
    coarse = None if design.finish is None else coarse_base(foot, design)
    return BareInsole.of(bare_key(foot, design), foot, base, closed, coarse)


def bare_key(foot: Foot, design: InsoleDesign) -> BareKey:
    """Return everything that the bare insole of a foot and design depends on, as a hashable key."""
    body = values_but(design, _READ_IN_PART | {"device"})
    return foot, base_key(design), design.taken_off_mm, design.of_stage("body"), body


def without_added(design: InsoleDesign) -> InsoleDesign:
    """Return the design without pads and strokes."""
    added = {correction.id for correction in design.of_stage("pad")}
    return replace(design, corrections=tuple(c for c in design.corrections if c.id not in added))
