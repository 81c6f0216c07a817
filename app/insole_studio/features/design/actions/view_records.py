"""Action table of viewing directions and display options."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from insole_studio.features.design.models.color_maps import MapKind
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
