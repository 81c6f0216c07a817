"""The fields of the device: cup, flange and fill as sliders first, then toe zone and shell."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

from insole_core.geometry.side import Side
from insole_core.insole.prescription.design import Finish, InsoleDesign
from insole_core.insole.prescription.rim_sliders import (
    cup_depth_mm,
    medial_flange_mm,
    with_cup_depth,
    with_medial_flange,
)
from insole_studio.features.design.parameters.correction_fields import field_specs
from insole_studio.features.design.rows import ChoiceSpec, FieldGroup, FieldSpec, Proposal
from insole_studio.texts import tr, translate_core_message

Fields = tuple[FieldSpec | ChoiceSpec, ...]


@dataclass(frozen=True)
class _Slider:
    """A value of the finish that a slider sets.

    Parameters
    ----------
    value
        Returns it; None where the finish has none.
    changed
        Returns the finish with another value.
    greatest
        End of the slider, mm; it begins at 0.
    """

    label: Callable[[], str]
    tip: Callable[[], str]
    value: Callable[[Finish], float | None]
    changed: Callable[[Finish, float], Finish]
    greatest: float


SLIDERS: dict[str, _Slider] = {
    "cup": _Slider(
        lambda: tr("Heel cup"),
        lambda: tr("Height of the rim behind the heel over the heel's floor"),
        cup_depth_mm,
        with_cup_depth,
        30.0,
    ),
    "flange": _Slider(
        lambda: tr("Medial flange"),
        lambda: tr("Height of the medial rim at its peak, over the heel's floor"),
        medial_flange_mm,
        with_medial_flange,
        40.0,
    ),
    "fill": _Slider(
        lambda: tr("Arch fill"),
        lambda: tr("How far the medial arch is lowered below the scan"),
        lambda finish: finish.arch_fill_mm,
        lambda finish, value: replace(finish, arch_fill_mm=value),
        15.0,
    ),
}


def device_group(design: InsoleDesign, side: Side) -> FieldGroup:
    """Return the group of the device; as scanned it has no values of its own."""
    choose = Proposal(
        "action.choose_device",
        tr("Choose…"),
        tr("Choose a device, a base form, or what is proposed for a finding"),
    )
    if design.finish is None:
        offers = (
            choose,
            Proposal(
                "action.toggle_as_scanned",
                tr("Design the rim"),
                tr("Give the imprint a designed rim and toe zone"),
            ),
        )
        return FieldGroup(tr("Device"), (), offers, tr("As scanned: the imprint of the foot"))
    offers = (
        choose,
        Proposal(
            "action.toggle_as_scanned",
            tr("As scanned"),
            tr("Show the imprint of the foot, without a designed rim; once more brings it back"),
        ),
    )
    name = translate_core_message(design.device) or tr("of this foot")
    return FieldGroup(tr("Device"), device_fields(design.finish, side), offers, name)


def device_fields(finish: Finish, side: Side) -> Fields:
    """Return the sliders, and the toe zone."""
    values = ((key, slider, slider.value(finish)) for key, slider in SLIDERS.items())
    sliders = (
        FieldSpec(
            f"device.{key}", slider.label(), "mm", value, 0.0, slider.greatest, step=0.5,
            tip=slider.tip(), slider=True,
        )
        for key, slider, value in values
        if value is not None
    )  # fmt: skip
    return (*sliders, *field_specs(finish, "finish", side))


def with_device_value(design: InsoleDesign, key: str, value: float) -> InsoleDesign:
    """Return the design with the value of a slider."""
    if design.finish is None:
        return design
    return replace(design, finish=SLIDERS[key].changed(design.finish, value))
