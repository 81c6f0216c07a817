"""Actions of the side-by-side view and the colour maps."""

from __future__ import annotations

from insole_core.errors import UsageError
from insole_studio.document.case import Case
from insole_studio.document.side_by_side import Beside
from insole_studio.features.design.models.color_maps import MapKind
from insole_studio.features.design.stage import DesignStage
from insole_studio.texts import tr


class SideBySideActions:
    """Shows two feet or two variants side by side, and their difference."""

    def __init__(self, case: Case, stage: DesignStage) -> None:
        self._case = case
        self._stage = stage
        self.counterpart = stage.counterpart

    @property
    def map_kind(self) -> MapKind:
        """The colour map of the insole."""
        return self._stage.insole_presenter.map_kind

    def show_beside(self, kind: Beside) -> None:
        """Choose what to show beside the active foot.

        Raises
        ------
        UsageError
            If the case has nothing of that kind.
        """
        if kind is Beside.FOOT and self._case.record.other is None:
            raise UsageError(
                tr("The case has one foot only; open the scan of the other, and it is added.")
            )
        if kind is Beside.VARIANT and not self._has_variants:
            raise UsageError(tr("This foot has one variant only; duplicate it first (Ctrl+D)."))
        self.counterpart.show(kind)
        if kind is Beside.NOTHING:
            self._drop_difference()

    def forget(self) -> None:
        """Show one insole alone, without a difference to what stood beside it."""
        self.counterpart.forget()
        self._drop_difference()

    def show_map(self, kind: MapKind) -> None:
        """Choose the colour map of the insole; a difference colours the foot as well.

        Raises
        ------
        UsageError
            If there is nothing to compare with, or nothing lies under the foot.
        """
        plantar = self._case.record.plantar
        if kind is MapKind.PRESSURE and plantar.pressure is None and plantar.picture is None:
            raise UsageError(
                tr("Nothing lies under this foot yet; lay a pressure map or a footprint (Tools).")
            )
        if kind is MapKind.DIFFERENCE and self.counterpart.kind is Beside.NOTHING:
            two_feet = self._case.record.other is not None
            self.show_beside(Beside.FOOT if two_feet else Beside.VARIANT)
        self._show(kind)

    @property
    def _has_variants(self) -> bool:
        foot = self._case.record.current
        return foot is not None and len(foot.variants) > 1

    def _drop_difference(self) -> None:
        if self.map_kind is MapKind.DIFFERENCE:
            self._show(MapKind.NONE)

    def _show(self, kind: MapKind) -> None:
        self._stage.insole_presenter.show_map(kind)
        self._stage.foot_presenter.show_plantar(kind is MapKind.PRESSURE)
        self._stage.foot_presenter.show_difference(kind is MapKind.DIFFERENCE)
