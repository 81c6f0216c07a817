"""The interface of a 3-D panel, as the presenters of foot and insole see it."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Protocol

from insole_core.cases.case_record import ReferencePlane
from insole_core.geometry.arrays import FloatArray, IntArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.side import Side
from insole_studio.scene.coloring import Coloring, ContourLines
from insole_studio.scene.guide_lines import GuideLines, NameLabel
from insole_studio.scene.pointer import Handle, MarkedPoint


class ModelPanel(Protocol):
    """A panel that shows the foot or the insole in 3-D."""

    def show_side(  # noqa: D102
        self, side: Side | None, *, mirrored: bool = False, scanned_on: str = ""
    ) -> None: ...
    def show_empty(self, sentence: str, offers: dict[str, str]) -> None: ...  # noqa: D102
    def clear(self) -> None: ...  # noqa: D102
    def show_mesh(  # noqa: D102
        self,
        mesh: TriangleMesh,
        coloring: Coloring | None = None,
    ) -> None: ...
    def move_mesh(  # noqa: D102
        self,
        mesh: TriangleMesh,
        normals: FloatArray,
        moved: IntArray | None = None,
        coloring: Coloring | None = None,
    ) -> bool: ...
    def show_shoe(self, lines: GuideLines | None) -> None: ...  # noqa: D102
    def show_grazing_light(self, on: bool) -> None: ...  # noqa: D102
    def show_wireframe(self, shown: bool) -> None: ...  # noqa: D102
    def show_ghost(self, mesh: TriangleMesh | None) -> None: ...  # noqa: D102
    def show_contours(self, lines: ContourLines | None) -> None: ...  # noqa: D102
    def show_guide(  # noqa: D102
        self, lines: Sequence[FloatArray], text: str, place_mm: FloatArray | None = None
    ) -> None: ...
    def right_of(self, outline: FloatArray, place_mm: FloatArray) -> FloatArray: ...  # noqa: D102
    def show_turned(self, step: FloatArray | None) -> None: ...  # noqa: D102
    def show_axes(self, axes: GuideLines | None) -> None: ...  # noqa: D102
    def show_outlines(  # noqa: D102
        self, lines: Sequence[FloatArray], selected: Sequence[FloatArray]
    ) -> None: ...
    def show_handles(self, handles: tuple[Handle, ...]) -> None: ...  # noqa: D102
    def show_key_points(self, points: Sequence[MarkedPoint]) -> None: ...  # noqa: D102
    def show_plane(self, plane: ReferencePlane | None, size_mm: float) -> None: ...  # noqa: D102
    def show_section(self, line: FloatArray | None) -> None: ...  # noqa: D102
    def show_sketch(self, line: FloatArray) -> None: ...  # noqa: D102
    def show_directions(self, side: Side, bounds_mm: FloatArray) -> None: ...  # noqa: D102
    def show_warning(self, text: str) -> None: ...  # noqa: D102
    def show_companion(  # noqa: D102
        self, mesh: TriangleMesh | None, coloring: Coloring | None = None
    ) -> None: ...
    def show_names(self, names: Sequence[NameLabel]) -> None: ...  # noqa: D102
    def show_numbers(self, text: str) -> None: ...  # noqa: D102
