"""The clinic's rules: limits of what is usual, as data (resources/rules/rules.json)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import MISSING, dataclass, fields
from pathlib import Path

from insole_core.json_object import JsonObject
from insole_core.resources import resource_path

_FARTHEST_AHEAD_MM = 50.0


@dataclass(frozen=True)
class PronationStep:
    """The medial rearfoot posting that is usual from this eversion on; degrees."""

    from_deg: float
    post_deg: float


@dataclass(frozen=True, kw_only=True)
class ClinicRules:
    """Limits of the warnings, and the suggested posting by pronation; mm and degrees.

    The distances behind the heads are < 0 for pads that end ahead of them: trials disagree on where
    a pad works best, so that the place is the clinic's own rule. What has a usual value may be left
    out.
    """

    post_unusual_deg: float
    skive_least_cup_mm: float
    skive_and_inversion_limit: float
    skive_and_inversion_cup_mm: float
    greatest_insole_height_mm: float
    greatest_heel_lift_mm: float
    pelott_least_behind_heads_mm: float
    pelott_greatest_behind_heads_mm: float
    pelott_usual_behind_heads_mm: float
    greatest_metatarsal_pad_height_mm: float
    greatest_recess_depth_mm: float
    least_beside_first_head_mm: float
    least_on_foot_share: float
    greatest_overlap_share: float
    greatest_grid_mm: float
    greatest_ball_lift_mm: float = 5.0
    pronation: tuple[PronationStep, ...] = ()


def load_rules(path: Path | None = None) -> ClinicRules:
    """Read the clinic's rules, by default those shipped with the product.

    Raises
    ------
    InputError
        If the file cannot be read or breaks its format.
    """
    content = JsonObject.read(path or resource_path("rules/rules.json"))
    content.check_format("insole-rules")
    rules = content.object("rules")
    limits = [f.name for f in fields(ClinicRules) if f.default is MISSING or rules.has(f.name)]
    return ClinicRules(
        **{name: rules.number(name, _least(name), 1000) for name in limits},
        pronation=tuple(
            PronationStep(step.number("from_deg", 0, 90), step.number("post_deg", 0, 15))
            for step in (content.objects("pronation") if content.has("pronation") else ())
        ),
    )


def proposed_post_deg(eversion_deg: float, steps: Sequence[PronationStep]) -> float:
    """Return the usual rearfoot posting in degrees, > 0 medial; 0 if none is usual.

    Parameters
    ----------
    eversion_deg
        Of the rearfoot: the Achilles axis relative to the sole, > 0 is valgus.
    """
    return max((s.post_deg for s in steps if eversion_deg >= s.from_deg), default=0.0)


def _least(limit: str) -> float:
    """Return the least value of a limit."""
    return -_FARTHEST_AHEAD_MM if limit.endswith("_behind_heads_mm") else 0.0
