"""A prescription of one foot on another: an earlier scan, the other foot, another patient's."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

from insole_core.cases.case_record import FootRecord
from insole_core.errors import DesignError
from insole_core.insole.prescription.corrections import CorrectionBase
from insole_core.insole.prescription.design import Correction, InsoleDesign
from insole_core.insole.prescription.template import Template, apply_template, make_template
from insole_core.workflows.foot_landmarks import landmarks_of


def template_of(foot: FootRecord) -> Template:
    """Keep the chosen prescription of a foot for another.

    Raises
    ------
    DesignError
        When the landmarks lie in an impossible order.
    """
    return make_template(foot.chosen, foot.design, landmarks_of(foot))


def fitted(
    template: Template, foot: FootRecord, stamp: Callable[[Correction], Correction]
) -> InsoleDesign:
    """Bring a prescription to a foot by its landmarks, mirrored where it is of the other side.

    It is prescribed anew: every correction gets an id of its own, and a new stamp.

    Raises
    ------
    DesignError
        When the landmarks lie in an impossible order.
    """
    design = apply_template(template, foot.side, landmarks_of(foot))
    fresh = (stamp(replace(c, id=CorrectionBase().id)) for c in design.corrections)
    return replace(design, corrections=tuple(fresh))


def last_design(foot: FootRecord) -> Template | None:
    """Give what was prescribed last for a foot, on this scan or on the one before."""
    if not foot.design.corrections:
        return foot.earlier
    try:
        return template_of(foot)
    except DesignError:
        return foot.earlier


def prescribed_at(design: InsoleDesign) -> str:
    """Give the time (ISO 8601) of the latest correction; empty where none was noted."""
    return max((correction.created_at for correction in design.corrections), default="")
