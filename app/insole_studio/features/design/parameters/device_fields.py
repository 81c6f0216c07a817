"""The fields of the device: cup, flange and fill as sliders first, then toe zone and shell."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

from insole_core.errors import DesignError
from insole_core.geometry.side import Side
from insole_core.insole.fields import Range, declared, ranges_of
from insole_core.insole.prescription.base_form import BaseForm
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.prescription.finish import Finish, RimStation
from insole_core.insole.prescription.layers import Layers
from insole_core.insole.prescription.materials import (
    MaterialTable,
    proposed_thickness,
    with_least_thickness,
)
from insole_core.insole.prescription.rim_sliders import (
    cup_depth_mm,
    medial_flange_mm,
    with_cup_depth,
    with_medial_flange,
)
from insole_core.insole.prescription.shell import Post, Shell
from insole_studio.features.design.correction_names import capitalised, device_name, label_of
from insole_studio.features.design.parameters.correction_fields import field_specs, with_value
from insole_studio.features.design.rows import ChoiceSpec, FieldGroup, FieldSpec, Proposal
from insole_studio.texts import localised, tr, translate_core_message

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
    allowed
        Of what it sets; the slider begins at 0.
    """

    label: Callable[[], str]
    tip: Callable[[], str]
    value: Callable[[Finish], float | None]
    changed: Callable[[Finish, float], Finish]
    allowed: Range


SLIDERS: dict[str, _Slider] = {
    "cup": _Slider(
        lambda: tr("Heel cup"),
        lambda: tr("Height of the rim behind the heel over the heel's floor"),
        cup_depth_mm,
        with_cup_depth,
        ranges_of(RimStation)["height_mm"],
    ),
    "flange": _Slider(
        lambda: tr("Medial flange"),
        lambda: tr("Height of the medial rim at its peak, over the heel's floor"),
        medial_flange_mm,
        with_medial_flange,
        ranges_of(RimStation)["height_mm"],
    ),
    "fill": _Slider(
        lambda: label_of(Finish, "arch_fill_mm"),
        lambda: translate_core_message(declared(Finish)["arch_fill_mm"].effect),
        lambda finish: finish.arch_fill_mm,
        lambda finish, value: replace(finish, arch_fill_mm=value),
        ranges_of(Finish)["arch_fill_mm"],
    ),
}


REGIONS: dict[str, Callable[[], str]] = {
    "rearfoot": lambda: tr("Rearfoot post"),
    "forefoot": lambda: tr("Forefoot post"),
}
"""Names of the posts."""


def device_group(design: InsoleDesign, side: Side) -> FieldGroup:
    """Return the group of the device; as scanned it has no values of its own."""
    choose = Proposal(
        "action.choose_device",
        tr("Device or finding…"),
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
        note = tr("As scanned: the imprint of the foot")
        return FieldGroup(tr("Device"), _base_fields(design), offers, note)
    offers = (
        choose,
        Proposal(
            "action.toggle_as_scanned",
            tr("As scanned"),
            tr("Show the imprint of the foot, without a designed rim; once more brings it back"),
        ),
    )
    fields = (*device_fields(design.finish, side), *_base_fields(design))
    return FieldGroup(tr("Device"), fields, offers, device_name(design))


def _base_fields(design: InsoleDesign) -> Fields:
    """Return how much of the foot's own sole a base form is blended with."""
    if design.base is None:
        return ()
    tip = tr("{form}: at 0 % the form alone, at 100 % the sole of the foot").format(
        form=translate_core_message(design.base.form.name)
    )
    share = 100 * design.base.contact_share
    label = label_of(BaseForm, "contact_share")
    return (
        FieldSpec(
            "base.contact_share", label, "%", share, 0.0, 100.0, step=5.0, tip=tip, slider=True
        ),
    )


def with_foot_share(design: InsoleDesign, percent: float) -> InsoleDesign:
    """Return the design with another blend of its base form and the sole of the foot."""
    if design.base is None:
        return design
    return replace(design, base=replace(design.base, contact_share=percent / 100))


def device_fields(finish: Finish, side: Side) -> Fields:
    """Return the sliders, and the toe zone."""
    values = ((key, slider, slider.value(finish)) for key, slider in SLIDERS.items())
    sliders = (
        FieldSpec(
            f"device.{key}", slider.label(), "mm", value, 0.0, slider.allowed.greatest, step=0.5,
            tip=slider.tip(), slider=True,
        )
        for key, slider, value in values
        if value is not None
    )  # fmt: skip
    return (*sliders, *field_specs(finish, "finish", side))


def shell_group(design: InsoleDesign, table: MaterialTable) -> FieldGroup:
    """Return the group of a shell, with the thickness that is usual for material and weight.

    Parameters
    ----------
    table
        The clinic's materials.
    """
    shell = design.shell
    assert shell is not None, "a solid insole has no shell"
    allowed = ranges_of(Shell)["body_weight_kg"]
    weight = FieldSpec(
        "shell.body_weight_kg",
        label_of(Shell, "body_weight_kg"),
        "kg",
        shell.body_weight_kg or 0.0,
        0.0,
        allowed.greatest,
        step=1.0,
        tip=tr("From {least} kg on, a thickness is proposed; 0 if unknown").format(
            least=localised(allowed.least, "g")
        ),
        least_known=allowed.least,
    )
    known = table.names
    names = known if shell.material in known else (*known, shell.material)
    materials = tuple((name, capitalised(name)) for name in names)
    material = ChoiceSpec(
        "shell.material",
        label_of(Shell, "material"),
        shell.material,
        materials,
        tr("From which, with the weight, a thickness is proposed"),
    )
    posts = (spec for region in REGIONS for spec in _post_fields(design, region))
    fields = (material, weight, *field_specs(shell, "shell", design.side), *posts)
    return FieldGroup(tr("Shell"), fields, _offers(design, table))


def layers_group(design: InsoleDesign, table: MaterialTable) -> FieldGroup:
    """Return the group of the separate layers: the material of one is asked once it has some.

    Parameters
    ----------
    table
        The clinic's materials.
    """
    layers = design.layers
    fields: list[FieldSpec | ChoiceSpec] = []
    for spec in field_specs(layers, "layers", design.side):
        fields.append(spec)
        layer = spec.key.removeprefix("layers.").removesuffix("_mm")
        if isinstance(spec, FieldSpec) and spec.value > 0:
            fields.append(_layer_material(layers, f"{layer}_material", table))
    return FieldGroup(tr("Layers"), tuple(fields))


def with_layers_value(design: InsoleDesign, name: str, value: float | str) -> Layers:
    """Return the layers of a design with a thickness, or a material, which may be none."""
    if value == "":
        unsaid: dict[str, Any] = {name: None}
        return replace(design.layers, **unsaid)
    return with_value(design.layers, name, value, design.side)


def _layer_material(layers: Layers, name: str, table: MaterialTable) -> ChoiceSpec:
    chosen: str = getattr(layers, name) or ""
    names = table.names if not chosen or chosen in table.names else (*table.names, chosen)
    return ChoiceSpec(
        f"layers.{name}",
        label_of(Layers, name),
        chosen,
        (("", tr("not said")), *((material, capitalised(material)) for material in names)),
        tr("What the layer is made of: by it, the change of the pressure is computed"),
    )


def _post_fields(design: InsoleDesign, region: str) -> Fields:
    """Return whether there is a post, and its angle."""
    assert design.shell is not None
    post = next((post for post in design.shell.posts if post.region == region), None)
    options = (("", tr("None")), (region, tr("Post")))
    label = REGIONS[region]()
    tip = tr("A body below the shell that tilts it and stands flat on the ground")
    choice = ChoiceSpec(f"post.{region}", label, "" if post is None else region, options, tip)
    if post is None:
        return (choice,)
    return (choice, *field_specs(post, f"post.{region}", design.side))


def _offers(design: InsoleDesign, table: MaterialTable) -> tuple[Proposal, ...]:
    """Return the button of the table, and one that takes the usual thickness if another is set."""
    shell = design.shell
    assert shell is not None
    edit = Proposal(
        "action.edit_materials",
        tr("Materials…"),
        tr("Change least and usual thickness of the clinic's materials"),
    )
    try:
        usual_mm = proposed_thickness(shell.material, shell.body_weight_kg, table)
    except DesignError:  # without weight or material there is nothing to propose
        return (edit,)
    if usual_mm == design.thickness_mm:
        return (edit,)
    text = tr("Take {thickness} mm").format(thickness=localised(usual_mm, "g"))
    tip = tr("The usual thickness for this material and weight")
    return (Proposal("thickness.usual", text, tip), edit)


def with_shell_value(
    design: InsoleDesign, name: str, value: float | str, table: MaterialTable
) -> InsoleDesign:
    """Return the design with a value of its shell: material, weight, edges.

    Parameters
    ----------
    table
        Of the least thicknesses that come with a material.
    """
    shell = design.shell
    assert shell is not None
    if name == "material":
        other = replace(shell, material=str(value), least_mm=None, least_edge_mm=None)
        return with_least_thickness(replace(design, shell=other), table)
    if name == "body_weight_kg":
        return replace(design, shell=replace(shell, body_weight_kg=float(value) or None))
    return replace(design, shell=with_value(shell, name, value, design.side))


def with_post_value(design: InsoleDesign, name: str, value: float | str) -> InsoleDesign:
    """Return the design with a post added or removed, or with another angle."""
    shell, (region, _, key) = design.shell, name.partition(".")
    assert shell is not None
    others = tuple(post for post in shell.posts if post.region != region)
    found = next((post for post in shell.posts if post.region == region), Post(region=region))
    if key:
        posts: tuple[Post, ...] = (*others, with_value(found, key, value, design.side))
    else:
        posts = (*others, found) if value else others
    return replace(design, shell=replace(shell, posts=posts))


def with_usual_thickness(design: InsoleDesign, table: MaterialTable) -> InsoleDesign:
    """Return the design with the usual thickness for its material and the weight.

    Raises
    ------
    DesignError
        As `proposed_thickness`.
    """
    assert design.shell is not None
    usual_mm = proposed_thickness(design.shell.material, design.shell.body_weight_kg, table)
    return replace(design, thickness_mm=usual_mm)


def with_slid_value(design: InsoleDesign, key: str, value: float) -> InsoleDesign:
    """Return the design with the value of a slider, by the key of its field."""
    group, name = key.split(".", 1)
    if group == "base":
        return with_foot_share(design, value)
    return with_device_value(design, name, value)


def with_device_value(design: InsoleDesign, key: str, value: float) -> InsoleDesign:
    """Return the design with another cup, medial flange or fill."""
    if design.finish is None:
        return design
    return replace(design, finish=SLIDERS[key].changed(design.finish, value))
