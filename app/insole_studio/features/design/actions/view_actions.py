"""Viewing directions, the side-by-side view, the colour maps; and their actions."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from insole_core.errors import UsageError
from insole_studio.document.case import Case
from insole_studio.document.side_by_side import Beside
from insole_studio.features.design.models.color_maps import MapKind
from insole_studio.features.design.stage import DesignStage
from insole_studio.scene.view_camera import Preset
from insole_studio.services.action_record import ActionRecord
from insole_studio.texts import tr

if TYPE_CHECKING:
    from insole_studio.features.design.design import Design


def _map(
    kind: MapKind, text: Callable[[], str], tip: Callable[[], str], shortcut: str
) -> ActionRecord[Design]:
    return ActionRecord(
        f"map_{kind.value}",
        text,
        tip,
        lambda design, on: design.side_by_side.show_map(kind) if on else None,
        shortcut=shortcut,
        checkable=True,
        group="maps",
        needs_foot=True,
    )


def _preset(preset: Preset, number: int, text: Callable[[], str]) -> ActionRecord[Design]:
    return ActionRecord(
        f"look_{preset.value}",
        text,
        lambda: tr("Look from here, in both views"),
        lambda design, _on: design.stage.look(preset),
        shortcut=str(number),
        needs_foot=True,
    )


VIEW_ACTIONS: tuple[ActionRecord[Design], ...] = (
    _preset(Preset.PLANTAR, 1, lambda: tr("Plantar")),
    _preset(Preset.MEDIAL, 2, lambda: tr("Medial")),
    _preset(Preset.LATERAL, 3, lambda: tr("Lateral")),
    _preset(Preset.POSTERIOR, 4, lambda: tr("Posterior")),
    _preset(Preset.ANTERIOR, 5, lambda: tr("Anterior")),
    _preset(Preset.DORSAL, 6, lambda: tr("Dorsal")),
    ActionRecord(
        "fit",
        lambda: tr("Show all"),
        lambda: tr("Show the whole foot and the whole insole"),
        lambda design, _on: design.stage.fit(),
        icon="fit",
        shortcut="F",
        needs_foot=True,
    ),
    _map(MapKind.NONE, lambda: tr("Shaded"), lambda: tr("Show the insole in its material"), "0"),
    _map(MapKind.HEIGHT, lambda: tr("Height map"), lambda: tr("Colour by height"), "H"),
    _map(MapKind.THICKNESS, lambda: tr("Thickness map"), lambda: tr("Colour by thickness"), "M"),
    _map(
        MapKind.FIT,
        lambda: tr("Fit map"),
        lambda: tr("Colour by the distance of the insole from the foot"),
        "I",
    ),
    _map(
        MapKind.DIFFERENCE,
        lambda: tr("Difference map"),
        lambda: tr("Colour by the difference to what stands beside, mirrored where it has to be"),
        "J",
    ),
    _map(
        MapKind.PRESSURE,
        lambda: tr("Pressure map"),
        lambda: tr("Paint the pressure map or footprint over foot and insole"),
        "Q",
    ),
    ActionRecord(
        f"map_{MapKind.LOAD.value}",
        lambda: tr("Change of pressure"),
        lambda: tr("Colour by where this insole takes load off, and where it puts it, by a model"),
        lambda design, on: design.load.show() if on else None,
        shortcut="Shift+L",
        checkable=True,
        group="maps",
        needs_foot=True,
    ),
    ActionRecord(
        "contours",
        lambda: tr("Contour lines"),
        lambda: tr("Lines of equal height on the contact surface, a millimetre apart"),
        lambda design, on: design.stage.insole_presenter.show_contours(on),
        shortcut="N",
        checkable=True,
        needs_foot=True,
    ),
    ActionRecord(
        "grazing_light",
        lambda: tr("Light from the side"),
        lambda: tr("Light the insole from the side, so that bumps and hollows show"),
        lambda design, on: design.stage.insole_presenter.show_grazing_light(on),
        shortcut="Shift+N",
        checkable=True,
        needs_foot=True,
    ),
    ActionRecord(
        "shoe",
        lambda: tr("Shoe outline"),
        lambda: tr("Draw the outline of a usual shoe of this size, with the height of its heel"),
        lambda design, on: design.stage.insole_presenter.show_shoe(on),
        shortcut="Shift+O",
        checkable=True,
        needs_foot=True,
    ),
    ActionRecord(
        "section_follows",
        lambda: tr("Section follows the pointer"),
        lambda: tr("Cut the insole where the pointer is, and show the heights there"),
        lambda design, on: design.stage.section_follower.follow(on),
        shortcut="Shift+S",
        checkable=True,
        needs_foot=True,
    ),
    ActionRecord(
        "ghost",
        lambda: tr("Insole through the foot"),
        lambda: tr("Show the insole below the foot, seen through"),
        lambda design, on: design.stage.foot_presenter.show_ghost(on),
        shortcut="G",
        checkable=True,
        needs_foot=True,
    ),
    ActionRecord(
        "wireframe",
        lambda: tr("Wireframe"),
        lambda: tr("Show the edges of the insole's triangles alone"),
        lambda design, on: design.stage.insole_presenter.show_wireframe(on),
        shortcut="W",
        checkable=True,
        needs_foot=True,
    ),
)


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

    def show_beside(self, kind: Beside, variant: str = "") -> None:
        """Choose what to show beside the active foot.

        Parameters
        ----------
        variant
            Its name; by default the one that was chosen before.

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
        self.counterpart.show(kind, variant)
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
        self._stage.foot_presenter.show_load(kind is MapKind.LOAD)
        self._stage.foot_presenter.show_plantar(kind is MapKind.PRESSURE)
        self._stage.foot_presenter.show_difference(kind is MapKind.DIFFERENCE)
