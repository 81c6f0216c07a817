"""An insole in layers: cover, middle layer and base, each a solid that fits on the next."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import manifold3d
import numpy as np

from insole_core.formats.solid_content import SolidPart
from insole_core.geometry.mesh import TriangleMesh
from insole_core.insole.block import close_block
from insole_core.insole.build import Insole
from insole_core.insole.primitives.height_field import HeightField
from insole_core.solids.ball_offset import parallel_below
from insole_core.solids.shop import LayerMake, LayerName
from insole_core.solids.simplification import from_manifold, to_manifold

_LEAST_VOLUME_MM3 = 1.0
_DEEP_MM = 5.0
_BESIDE_MM = 60.0


def layer_parts(
    insole: Insole, solid: TriangleMesh, makes: Mapping[LayerName, LayerMake], name: str
) -> tuple[SolidPart, ...]:
    """Cut a finished insole along the surfaces between its layers.

    Parameters
    ----------
    insole
        Its design gives the thickness of cover and middle layer; the base is below them.
    solid : mm, insole frame
        Of this insole, with or without markings or reduction.
    makes
        Colour and density of each layer.
    name
        Of the insole; the names of the layers are derived from it.

    Returns
    -------
    tuple of SolidPart
        From the foot down, together exactly the solid; layers without material are left out.
    """
    layers, rest = insole.design.layers, to_manifold(solid)
    cuts: list[tuple[LayerName, float]] = []
    depth = 0.0
    for layer, thickness in (("cover", layers.cover_mm), ("shell", layers.shell_mm)):
        depth += thickness
        if thickness > 0:
            cuts.append((layer, depth))  # type: ignore[arg-type]
    bodies: list[tuple[LayerName, manifold3d.Manifold]] = []
    for layer, depth in cuts:
        below = to_manifold(everything_below(insole.contact, depth))
        bodies.append((layer, rest - below))
        rest ^= below
    bodies.append(("base", rest))
    return tuple(
        SolidPart(from_manifold(body), f"{name}, {layer}", makes[layer].color,
             makes[layer].density_percent, assembly=name)
        for layer, body in bodies
        if body.volume() > _LEAST_VOLUME_MM3
    )  # fmt: skip


def everything_below(contact: HeightField, depth_mm: float) -> TriangleMesh:
    """Return a block that reaches beside and below any insole of this contact surface."""
    heights = parallel_below(contact, depth_mm)
    beside = int(np.ceil(_BESIDE_MM / contact.step_mm))
    wide = HeightField(
        contact.x0_mm - beside * contact.step_mm,
        contact.y0_mm - beside * contact.step_mm,
        contact.step_mm,
        np.pad(heights, beside, mode="edge") + _DEEP_MM,
    )
    block = close_block(wide, wide.triangles(), np.zeros((0, 3)))
    return replace(block, vertices=block.vertices - [0.0, 0, _DEEP_MM])
