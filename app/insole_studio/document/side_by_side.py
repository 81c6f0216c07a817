"""What is shown beside the active foot for comparison: the other foot, or a variant."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

import numpy as np
from PySide6.QtCore import QObject, Signal

from insole_core.compare.seen_surface import STEEPEST, grid_over, height_map
from insole_core.errors import InsoleError
from insole_core.foot.display_surface import DisplaySurface
from insole_core.foot.foot import Foot
from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.side import Side
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.primitives.height_field import HeightField
from insole_core.progress import Progress
from insole_core.workflows.insole_builder import InsoleBuilder
from insole_studio.document.case import Case
from insole_studio.document.insole_preview import InsolePreview
from insole_studio.jobs import Jobs

CHANNEL = "counterpart"
_SOLE_PITCH_MM, _SOLE_TO_MM, _SEEN_MM = 1.0, 30.0, 1.5


class Beside(StrEnum):
    """The kinds of counterpart."""

    NOTHING = "nothing"
    FOOT = "foot"
    VARIANT = "variant"


@dataclass(frozen=True, eq=False)
class Built:
    """A foot with one of its designs, built for display.

    Parameters
    ----------
    contact
        The contact surface of the insole.
    sole
        Heights of the foot seen from below; NaN outside it.
    foot_display
        The foot's surface as it is shown.
    """

    foot: Foot
    design: InsoleDesign
    contact: HeightField
    solid: TriangleMesh
    sole: HeightField
    foot_display: DisplaySurface


class SideBySide(QObject):
    """Builds the counterpart of the active foot in the background and keeps it up to date."""

    changed = Signal()
    failed = Signal(object)

    def __init__(
        self, case: Case, jobs: Jobs, builder: InsoleBuilder, parent: QObject | None = None
    ) -> None:
        super().__init__(parent)
        self._builder = builder
        self._case = case
        self._jobs = jobs
        self._against = ""
        self._last_chosen: tuple[Side, str] | None = None
        self._names = ("", "")
        """Names of the chosen variant and of the one beside it, as last announced."""
        self._laid: tuple[object, Built, FloatArray] | None = None
        self.kind = Beside.NOTHING
        self.built: Built | None = None
        """None while it is being built, and if there is nothing to build."""
        case.foot_changed.connect(self._refresh)
        case.changed.connect(self._refresh)

    @property
    def variant(self) -> str:
        """Return the name of the variant shown beside the chosen one; empty for none."""
        foot = self._case.record.current
        if foot is None or self.kind is not Beside.VARIANT:
            return ""
        others = [variant.name for variant in foot.variants if variant.name != foot.chosen]
        if self._against in others:
            return self._against
        return others[0] if others else ""

    @property
    def is_mirrored(self) -> bool:
        """Whether it has to be mirrored to match the active foot."""
        return self.built is not None and self.built.foot.side is not self._case.side

    def show(self, kind: Beside, variant: str = "") -> None:
        """Show another counterpart beside the active foot.

        Parameters
        ----------
        variant
            Its name; by default the one that was chosen before.
        """
        self.kind = kind
        self._against = variant or self._against
        self.built = None
        self._refresh()
        self.changed.emit()

    def forget(self) -> None:
        """Show nothing beside the foot, and forget what was chosen before."""
        self._against, self._last_chosen = "", None
        self.show(Beside.NOTHING)

    def heights_mm(self, field: HeightField, xy: FloatArray) -> FloatArray:
        """Return the counterpart's heights at places (n, 2) of the active foot; NaN outside it.

        Parameters
        ----------
        field
            Heights of the counterpart.
        xy : (n, 2)
            Places of the active foot, mm.

        Returns
        -------
        (n,) float64, mm
            NaN outside the counterpart.
        """
        return field.height_at(xy * [-1.0, 1.0] if self.is_mirrored else xy)

    def heights_under(self, surface: InsolePreview, xy: FloatArray) -> FloatArray:
        """Return the counterpart's heights at the vertices of the shown insole's top; cached.

        Parameters
        ----------
        xy : (n, 2)
            Places of the top's vertices, mm.

        Returns
        -------
        (n,) float64, mm
            NaN outside the counterpart.
        """
        assert self.built is not None
        laid = self._laid
        if laid is None or laid[0] is not surface.base or laid[1] is not self.built:
            laid = surface.base, self.built, self.heights_mm(self.built.contact, xy)
            self._laid = laid
        return laid[2]

    def sole_of(self, foot: Foot) -> HeightField:
        """Return the heights of a foot as seen from below; cached, as computing them is slow."""
        return foot.derived.get("heights from below", (), lambda: sole_heights(foot))

    def _refresh(self) -> None:
        self._note_chosen()
        wanted = self._wanted()
        foot = self._case.record.current
        before, self._names = self._names, ("" if foot is None else foot.chosen, self.variant)
        if wanted is None:
            self._forget()
        elif self.built is None or (self.built.foot, self.built.design) != wanted:
            if self.built is not None and self.built.foot is not wanted[0]:
                self._forget()
            self._build(*wanted)
        elif self._names != before:
            self.changed.emit()  # the same design under another name

    def _note_chosen(self) -> None:
        """Compare with the variant that was chosen before this one."""
        foot = self._case.record.current
        chosen = None if foot is None else (foot.side, foot.chosen)
        if chosen != self._last_chosen:
            before, self._last_chosen = self._last_chosen, chosen
            if before is not None and chosen is not None and before[0] is chosen[0]:
                self._against = before[1]

    def _wanted(self) -> tuple[Foot, InsoleDesign] | None:
        record = self._case.record
        if self.kind is Beside.FOOT and record.other is not None:
            return record.other.foot, record.other.design
        if record.current is not None and self.variant:
            return record.current.foot, record.current.variant(self.variant).design
        return None

    def _forget(self) -> None:
        self._jobs.cancel(CHANNEL)
        self._laid = None
        if self.built is not None:
            self.built = None
            self.changed.emit()

    def _build(self, foot: Foot, design: InsoleDesign) -> None:
        def build(progress: Progress) -> Built:
            insole, solid = self._builder.solid(foot, design, progress)
            shown = foot.display_surface()
            return Built(foot, design, insole.contact, solid, self.sole_of(foot), shown)

        def take(built: Built) -> None:
            self.built = built
            self.changed.emit()

        def fail(error: Exception) -> None:
            if not isinstance(error, InsoleError):
                raise error
            self.failed.emit(str(error))

        self._jobs.start(CHANNEL, build, take, fail)


def sole_heights(foot: Foot) -> HeightField:
    """Return the heights of a foot as seen from below."""
    grid = grid_over(foot.mesh, _SOLE_PITCH_MM)
    heights = height_map(foot.mesh, grid, from_above=False)
    heights[heights > _SOLE_TO_MM] = np.nan  # flanks and ankle, visible beyond the sole
    return HeightField(*grid.first_mm, grid.pitch_mm, heights)


def insole_difference(surface: InsolePreview, counterpart: SideBySide) -> FloatArray | None:
    """Return the height of the shown insole's contact surface over the counterpart's, mm.

    Edges, which are rounded where an insole is made, make no difference. Both lie on the same
    bottom plane, heel on heel and foot axis on foot axis; NaN outside the counterpart. None while
    there is nothing to compare with.

    Returns
    -------
    (n,) float64, mm, or None
        One difference for each vertex of the top.
    """
    bottom, contact = surface.bottom_heights_mm, surface.contact
    if surface.mesh is None or bottom is None or contact is None or counterpart.built is None:
        return None
    xy = surface.mesh.vertices[: len(bottom), :2]
    return np.asarray(contact.height_at(xy) - counterpart.heights_under(surface, xy))


def foot_difference(foot: Foot, counterpart: SideBySide) -> FloatArray | None:
    """Return the height of the sole over the counterpart's, mm, at the vertices; NaN beside it.

    None if the counterpart is the same foot, or there is none.

    Returns
    -------
    (n,) float64, mm, or None
        One difference for each vertex of the foot.
    """
    built = counterpart.built
    if built is None or built.foot is foot:
        return None
    vertices = foot.mesh.vertices
    over = vertices[:, 2] - counterpart.heights_mm(built.sole, vertices[:, :2])
    # What is hidden behind something else is not seen from below.
    behind = vertices[:, 2] - counterpart.sole_of(foot).height_at(vertices[:, :2])
    is_sole = (foot.mesh.vertex_normals[:, 2] < -STEEPEST) & (behind < _SEEN_MM)
    return np.where(is_sole, over, np.nan)
