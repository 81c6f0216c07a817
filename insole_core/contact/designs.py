"""From designs to the grounds that a foot stands on."""

from __future__ import annotations

from dataclasses import dataclass

from insole_core.contact.elastic_layers import Layer
from insole_core.contact.hardness import USUAL_SHORE_A, body_of
from insole_core.contact.stance import Ground, Sole, insole_on_floor, shoe_floor
from insole_core.insole.build import BaseStep, build_insole
from insole_core.insole.prescription.design import InsoleDesign
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
    "A design has separate layers, whose materials are not known; the insole is taken for one "
    "piece, and the limits allow for half and twice its stiffness."
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
        if any(design.layers.total_mm > 0 for design in given):
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
            When it is not known how much its material gives way.
        """
        body = self.body or body_of(material_name(design), self.table)
        return insole_on_floor(sole, design, contact, body, self.layers)

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
    """Return the material that a design names; empty if it names none."""
    return "" if design.shell is None else design.shell.material
