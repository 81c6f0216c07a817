"""Warnings about shells: what is made otherwise than was asked for, and what is unusual."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from insole_core.errors import DesignError
from insole_core.foot.landmarks import Landmarks
from insole_core.geometry.arrays import FloatArray
from insole_core.insole.build import Insole
from insole_core.insole.design_warning import DesignWarning
from insole_core.insole.elements import Pelott
from insole_core.insole.outline.insole_outline import insole_outline
from insole_core.insole.outline.shoe_outline import last_heights_mm
from insole_core.insole.outline.trim_line import TrimLine, trim_points
from insole_core.insole.pads.pad_heights import pad_outline
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.prescription.materials import Material, MaterialTable, material_of
from insole_core.insole.prescription.shell import LONGEST_TAPER, Shell
from insole_core.insole.primitives.outline_curve import inside_curve
from insole_core.messages import Message, joined

_CUT_SHARE = 0.03  # of the points on a pad's outline that lie ahead of the trim line
_SHOWN_MM = 0.05  # half of the step in which thicknesses are printed


def shell_warnings(
    insole: Insole, landmarks: Landmarks, table: MaterialTable
) -> Iterator[DesignWarning]:
    """Yield the warnings about the shell of an insole; none if it has no shell."""
    design, shell = insole.design, insole.design.shell
    if shell is None:
        return
    try:
        outline = insole_outline(insole.foot, design, landmarks)
    except DesignError:  # no insole can be made, which is said where it is tried
        return
    yield from _of_material(design, shell, table)
    yield from _of_edges(design, shell, outline)
    yield from _of_least_thickness(insole, outline, material_of(shell))
    if design.outline.extent == "three_quarter" and design.outline.source != "drawn":
        yield from _of_trim_line(design, shell, landmarks)


def _of_material(
    design: InsoleDesign, shell: Shell, table: MaterialTable
) -> Iterator[DesignWarning]:
    known, made = table.known(shell.material), material_of(shell)
    if known is None:
        yield DesignWarning(
            Message(
                "Nothing is known of the material “{material}”: the insole is made at least "
                "{least_mm:g} mm thick, {edge_mm:g} mm at the front edge; choose one of {names}.",
                material=shell.material,
                least_mm=made.least_mm,
                edge_mm=made.least_edge_mm,
                names=joined(table.names, " / "),  # names have commas
            )
        )
        return
    if shell.taper_mm < made.least_edge_mm - _SHOWN_MM:
        yield DesignWarning(
            Message(
                "The front edge is to taper to {taper_mm:g} mm, and {material} needs {least_mm:g} "
                "mm there; it is made {least_mm:g} mm thick.",
                taper_mm=shell.taper_mm,
                material=known.name,
                least_mm=made.least_edge_mm,
            )
        )
    usual_mm = None if shell.body_weight_kg is None else known.usual_mm(shell.body_weight_kg)
    if usual_mm is not None and design.made_thickness_mm < usual_mm - _SHOWN_MM:
        yield DesignWarning(
            Message(
                "For {weight_kg:g} kg of body weight, {material} is usually {usual_mm:g} mm thick, "
                "and this insole is {thickness_mm:g} mm.",
                weight_kg=shell.body_weight_kg or 0.0,
                material=known.name,
                usual_mm=usual_mm,
                thickness_mm=design.made_thickness_mm,
            )
        )


def _of_edges(design: InsoleDesign, shell: Shell, outline: FloatArray) -> Iterator[DesignWarning]:
    length_mm = float(np.ptp(outline[:, 1]))
    if shell.taper_length_mm > LONGEST_TAPER * length_mm:
        yield DesignWarning(
            Message(
                "A taper over {taper_mm:g} mm is too long for an insole of {length_mm:.0f} mm; it "
                "tapers over half of its length. Shorten the taper.",
                taper_mm=shell.taper_length_mm,
                length_mm=length_mm,
            )
        )
    half_mm = design.made_thickness_mm / 2
    if shell.edge_radius_mm > half_mm:
        yield DesignWarning(
            Message(
                "An edge radius of {radius_mm:g} mm is more than half of the thickness; where the "
                "insole is {thickness_mm:g} mm thick, only {half_mm:g} mm of its edge are rounded. "
                "Make the radius smaller.",
                radius_mm=shell.edge_radius_mm,
                thickness_mm=design.made_thickness_mm,
                half_mm=half_mm,
            )
        )
    if shell.chamfer_mm > half_mm:
        yield DesignWarning(
            Message(
                "A chamfer of {chamfer_mm:g} mm is more than half of the thickness; where the "
                "insole is {thickness_mm:g} mm thick, only {half_mm:g} mm of its edge are "
                "bevelled. Make the chamfer smaller.",
                chamfer_mm=shell.chamfer_mm,
                thickness_mm=design.made_thickness_mm,
                half_mm=half_mm,
            )
        )


def _of_least_thickness(
    insole: Insole, outline: FloatArray, material: Material
) -> Iterator[DesignWarning]:
    """Warn where the upper side has to be raised for want of material."""
    field, design = insole.contact, insole.design
    ground = last_heights_mm(design, field.y_mm, insole.foot.length_mm)[:, None]
    left = field.heights_mm - ground - design.taken_off_mm
    thin = np.flatnonzero(left.ravel() < material.least_mm - _SHOWN_MM)
    places = field.nodes[thin, :2]
    thin = thin[inside_curve(outline, places)]
    if len(thin) == 0:
        return
    worst = thin[left.ravel()[thin].argmin()]
    x, y = (float(value) for value in field.nodes[worst, :2])
    yield DesignWarning(
        Message(
            "Only {left_mm:.1f} mm of material would be left at x = {x_mm:.0f} mm, y = {y_mm:.0f} "
            "mm, and {least_mm:g} mm are needed; the surface is raised there. Raise the thickness, "
            "or make the recess shallower.",
            left_mm=float(left.ravel()[worst]),
            x_mm=x,
            y_mm=y,
            least_mm=material.least_mm,
        ),
        place_mm=(x, y),
    )


def _of_trim_line(
    design: InsoleDesign, shell: Shell, landmarks: Landmarks
) -> Iterator[DesignWarning]:
    """Warn of pads that the shell does not hold wholly, for its front edge runs through them."""
    sign = design.side.medial_sign
    line = TrimLine(np.array(trim_points(shell, design.side, landmarks)) * [sign, 1.0])
    for pad in design.of(Pelott):
        x, y = pad_outline(pad, 180).T
        ahead = y > line.y_mm(sign * x)
        if ahead.all():
            yield DesignWarning(
                Message(
                    "The {pad} lies ahead of the trim line and is not made; move the line ahead of "
                    "it, or choose the full length.",
                    pad=pad.noun,
                ),
                pad.id,
                pad.centre_mm,
            )
        elif ahead.mean() > _CUT_SHARE:
            yield DesignWarning(
                Message(
                    "The trim line runs through the {pad}; move the line ahead of it, or the pad "
                    "behind the line.",
                    pad=pad.noun,
                ),
                pad.id,
                pad.centre_mm,
            )
