"""The steps from a design to an insole, those that take long kept: base, pads, check, solid."""

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
from insole_core.insole.surface.contact import ContactBase, base_key, contact_base
from insole_core.insole.surface.pads_on_surface import Window, added_corrections
from insole_core.memo import Memo
from insole_core.progress import SILENT, Progress
from insole_core.solids.solid import insole_solid

_KEPT = 4  # so that the other foot, another variant or a step of undo is there at once

BareKey: TypeAlias = tuple[Any, ...]


@dataclass(frozen=True, eq=False)
class BareInsole:
    """An insole without its pads: what stays the same while they come, go and move.

    Parameters
    ----------
    key
        Of foot and design, `bare_key`: equal keys, equal bare insole.
    foot
    base
    solid : mm, insole frame
        Its vertices are the top, the bottom below it, and those of the walls once more, so that
        light falls on them as on walls.
    top_count
        Number of vertices that follow the contact surface; as many are below them.
    rim : (k,) int64
        Which of them the walls begin at.
    """

    key: BareKey
    foot: Foot
    base: ContactBase
    solid: TriangleMesh
    top_count: int
    rim: IntArray

    @classmethod
    def of(cls, key: BareKey, foot: Foot, base: ContactBase, solid: TriangleMesh) -> BareInsole:
        """Take a closed solid whose first half of vertices is the top."""
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
        return cls(key, foot, base, mesh, count, used[used < count].astype(np.int64))

    @cached_property
    def skins(self) -> tuple[TriangleMesh, TriangleMesh]:
        """Top and bottom, without the walls."""
        corners, count = self.solid.triangles, self.top_count
        top = (corners < count).all(axis=1)
        bottom = ((corners >= count) & (corners < 2 * count)).all(axis=1)
        return replace(self.solid, triangles=corners[top]), replace(
            self.solid, triangles=corners[bottom]
        )

    def vertices_in(self, window: Window) -> IntArray:
        """Give the indices (n,) of the top's vertices that the nodes of a window decide."""
        field = self.base.surface
        low = field.y0_mm + (window.first_row - 1) * field.step_mm
        high = field.y0_mm + window.end_row * field.step_mm
        order, y = self._by_y
        found = order[slice(*np.searchsorted(y, [low, high]))]
        x = self.solid.vertices[found, 0]
        left = field.x0_mm + (window.first_column - 1) * field.step_mm
        right = field.x0_mm + window.end_column * field.step_mm
        return np.asarray(found[(x > left) & (x < right)])

    @cached_property
    def _by_y(self) -> tuple[IntArray, FloatArray]:
        y = self.solid.vertices[: self.top_count, 1]
        order = np.argsort(y, kind="stable")
        return order, y[order]


class InsoleBuilder:
    """Builds insoles as `build_insole` does, and keeps the steps that take long.

    Any thread may ask. Several designs of the same feet share what they have in common.
    """

    def __init__(self) -> None:
        self._memo = Memo(_KEPT)

    def base(self, foot: Foot, design: InsoleDesign, progress: Progress = SILENT) -> ContactBase:
        """Give the contact surface before pads.

        Raises
        ------
        DesignError
            When nothing of the foot faces the ground.
        Cancelled
        """
        return _base(self._memo, foot, design, progress)

    def insole(self, foot: Foot, design: InsoleDesign, progress: Progress = SILENT) -> Insole:
        """Give the insole with its pads, checked.

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
        """Give the insole and what a shop makes of it by default.

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
        """Give the insole without its pads, closed, for pads to be moved on.

        Raises
        ------
        DesignError
            As `build_insole` but for the pads, or when the outline leaves no insole.
        Cancelled
        """
        check_design_for(foot, design)
        memo = self._memo
        make = partial(_bare, memo, foot, design, progress)
        return memo.get("bare", bare_key(foot, design), make)

    def known_bare(self, foot: Foot, design: InsoleDesign) -> BareInsole | None:
        """Give a bare insole that was built lately; None where it has to be built."""
        known: BareInsole | None = self._memo.known("bare", bare_key(foot, design))
        return known

    def forget(self) -> None:
        """Keep nothing of what was built, nor of what is being built."""
        self._memo = Memo(_KEPT)


def _base(memo: Memo, foot: Foot, design: InsoleDesign, progress: Progress) -> ContactBase:
    key = foot, base_key(design)
    return memo.get("base", key, lambda: contact_base(foot, design, progress))


def _bare(memo: Memo, foot: Foot, design: InsoleDesign, progress: Progress) -> BareInsole:
    base = _base(memo, foot, design, progress.part(0.0, 0.7))
    progress.step(0.7, "Trimming the insole")
    insole = Insole(without_added(design), foot, base.surface, base.measured)
    return BareInsole.of(bare_key(foot, design), foot, base, insole_solid(insole))


def bare_key(foot: Foot, design: InsoleDesign) -> BareKey:
    """Give all that a bare insole depends on."""
    return foot, base_key(design), design.outline, design.bottom


def without_added(design: InsoleDesign) -> InsoleDesign:
    """Leave out the pads and strokes."""
    added = {correction.id for correction in added_corrections(design)}
    return replace(design, corrections=tuple(c for c in design.corrections if c.id not in added))
