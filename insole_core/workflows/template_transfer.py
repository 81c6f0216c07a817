"""Transfer of a prescription to another scan, the other foot, or another patient."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

from insole_core.cases.case_record import FootRecord
from insole_core.errors import DesignError
from insole_core.insole.elements import Correction, new_id
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.prescription.template import Template, apply_template, make_template
from insole_core.workflows.foot_landmarks import landmarks_of


def template_of(foot: FootRecord) -> Template:
    """Return the chosen prescription of a foot as a template for another foot.

    Raises
    ------
    DesignError
        When the landmarks are in an impossible order.
    """
    return make_template(foot.chosen, foot.design, landmarks_of(foot))


def fitted(
    template: Template, foot: FootRecord, stamp: Callable[[Correction], Correction]
) -> InsoleDesign:
    """Fit a prescription to a foot by its landmarks, mirrored where it is of the other side.

    It counts as a new prescription: every correction gets a new id and a new stamp.

    Parameters
    ----------
    stamp
        Returns a correction with author and time of the new prescription.

    Raises
    ------
    DesignError
        When the landmarks are in an impossible order.
    """
    design = apply_template(template, foot.side, landmarks_of(foot))
    fresh = (stamp(replace(c, id=new_id())) for c in design.corrections)
    return replace(design, corrections=tuple(fresh))


def last_design(foot: FootRecord) -> Template | None:
    """Return the last prescription for a foot, on this scan or the previous one."""
    if not foot.design.corrections:
        return foot.earlier
    try:
        return template_of(foot)
    except DesignError:
        return foot.earlier


def prescribed_at(design: InsoleDesign) -> str:
    """Return the time (ISO 8601) of the latest correction; empty where none is recorded."""
    return max((correction.created_at for correction in design.corrections), default="")
