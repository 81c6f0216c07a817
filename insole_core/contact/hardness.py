"""From a material of the clinic's table to the elastic layer that it makes."""

from __future__ import annotations

from insole_core.contact.elastic_layers import Layer
from insole_core.errors import DesignError
from insole_core.insole.prescription.materials import MaterialTable, read_materials

USUAL_SHORE_A = 35.0
"""Of the foam that stands for a material that a design does not name: the usual EVA of insoles."""
_FOAM_POISSON, _SOLID_POISSON = 0.2, 0.35
"""Closed cells give way sideways little (Mills, Polymer Foams Handbook, 2007); thermoplastics."""


def modulus_of_shore_a(shore_a: float) -> float:
    """Return Young's modulus, MPa, by Gent (Rubber Chem. Technol. 31, 1958, 896)."""
    return 0.0981 * (56 + 7.62336 * shore_a) / (0.137505 * (254 - 2.54 * shore_a))


def foam(shore_a: float) -> Layer:
    """Return a millimetre of a foam."""
    return Layer(1.0, modulus_of_shore_a(shore_a), _FOAM_POISSON)


def body_of(material: str, table: MaterialTable) -> Layer:
    """Return a millimetre of a material.

    Parameters
    ----------
    material
        Its name; an empty one is the usual foam.
    table
        Which the name is looked up in, and then in that of the product.

    Raises
    ------
    DesignError
        When the table does not hold it, or knows neither its hardness nor its modulus.
    """
    if not material.strip():
        return foam(USUAL_SHORE_A)
    for found in (table.known(material), read_materials().known(material)):
        if found is not None and found.modulus_mpa is not None:
            return Layer(1.0, found.modulus_mpa, _SOLID_POISSON)
        if found is not None and found.shore_a is not None:
            return foam(found.shore_a)
    raise DesignError(
        "How much the material {material} gives way is not known; put its Shore A hardness or its "
        "modulus into the table of materials, or name another material.",
        material=material,
    )
