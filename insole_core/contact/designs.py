"""From designs to the grounds that a foot stands on."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

from insole_core.contact.elastic_layers import Layer
from insole_core.contact.hardness import USUAL_SHORE_A, body_of
from insole_core.contact.stance import Ground, Sole, insole_on_floor, shoe_floor
from insole_core.insole.build import BaseStep, build_insole
from insole_core.insole.elements import HeelLift, Posting
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.prescription.layers import Layers
from insole_core.insole.prescription.materials import MaterialTable
from insole_core.insole.primitives.height_field import HeightField
from insole_core.insole.surface.contact import contact_base
from insole_core.messages import Message
from insole_core.progress import SILENT, Progress

_NO_MATERIAL = (
    "A design names no material; foam of Shore A {hardness:g} is assumed, and the limits allow for "
    "half and twice its stiffness."
)
_LAYERS = Message(
    "A design does not say what its separate layers are made of; they are taken for the material "
    "of the rest, and the limits allow for half and twice its stiffness."
)
_NO_JOINTS = Message(
    "A posting only changes how the sole meets the insole here: no joint turns in the model."
)
_NO_SHIFT = Message(
    "The load that a heel lift moves forwards is not shown: its centre stays where it usually is."
)


@dataclass(frozen=True)
class Shoe:
    """What insoles lie in, and what they are made of where their designs do not say.

    Parameters
    ----------
    layers
        Below the insole; none of a rigid shoe.
    table
        Materials by their names.
    body
        A millimetre of the material of all insoles; None: as each design says.
    """

    table: MaterialTable
    layers: tuple[Layer, ...] = ()
    body: Layer | None = None

    def assumed(self, *designs: InsoleDesign | None) -> tuple[Message, ...]:
        """Return what is assumed of the materials of insoles; none if all are known."""
        given = [design for design in designs if design is not None]
        assumed = []
        if self.body is None and not all(material_name(design) for design in given):
            assumed.append(Message(_NO_MATERIAL, hardness=USUAL_SHORE_A))
        if self.body is None and any(_has_unnamed_layers(design.layers) for design in given):
            assumed.append(_LAYERS)
        return tuple(assumed)

    def floor(self, sole: Sole, design: InsoleDesign) -> Ground:
        """Return the shoe without an insole: flat, or with the heel of a design's shoe."""
        return shoe_floor(sole, design, self.layers)

    def insole(self, sole: Sole, design: InsoleDesign, contact: HeightField) -> Ground:
        """Return the shoe with the insole of a design, whose surface is known.

        Raises
        ------
        DesignError
            When it is not known how much its materials give way.
        """
        own = [self.body] if self.body is not None else list(self._layers_of(design))
        return insole_on_floor(sole, design, contact, own, self.layers)

    def _layers_of(self, design: InsoleDesign) -> Iterator[Layer]:
        """Yield what a design is made of, from the foot down; the last is a millimetre of it."""
        rest, layers = material_name(design), design.layers
        for thickness_mm, material in (
            (layers.cover_mm, layers.cover_material),
            (layers.shell_mm, layers.shell_material),
        ):
            if thickness_mm > 0:
                yield replace(body_of(material or rest, self.table), thickness_mm=thickness_mm)
        yield body_of(rest, self.table)

    def built(
        self,
        sole: Sole,
        design: InsoleDesign,
        progress: Progress = SILENT,
        *,
        base_of: BaseStep = contact_base,
    ) -> Ground:
        """Return the shoe with the insole of a design.

        Raises
        ------
        DesignError
            As `build_insole`, or as `insole`.
        """
        made = build_insole(sole.foot, design, progress, base_of=base_of)
        return self.insole(sole, design, made.contact)


def material_name(design: InsoleDesign) -> str:
    """Return the material of what separate layers leave of a design; empty if it names none."""
    if design.layers.base_mm > 0 and design.layers.base_material:
        return design.layers.base_material
    return "" if design.shell is None else design.shell.material


def _has_unnamed_layers(layers: Layers) -> bool:
    return any(
        thickness_mm > 0 and not material
        for thickness_mm, material in (
            (layers.cover_mm, layers.cover_material),
            (layers.shell_mm, layers.shell_material),
            (layers.base_mm, layers.base_material),
        )
    )


def left_out_of(*designs: InsoleDesign | None) -> tuple[Message, ...]:
    """Return what the model leaves out of what is prescribed; none if that changes little."""
    given = [design for design in designs if design is not None]
    left_out = ((Posting, _NO_JOINTS), (HeelLift, _NO_SHIFT))
    return tuple(note for element, note in left_out if any(one.of(element) for one in given))
