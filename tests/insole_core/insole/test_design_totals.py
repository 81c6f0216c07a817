"""A design is checked as a whole: each correction in range, all together not."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from insole_core.errors import DesignError, InputError
from insole_core.foot.landmarks import find_landmarks
from insole_core.geometry.side import Side
from insole_core.insole.build import build_insole
from insole_core.insole.clinic_rules import load_rules
from insole_core.insole.elements import Correction, ForefootTwist, HeelLift, Pelott, Posting
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.prescription.design_json import (
    design_from_json,
    design_to_json,
    read_design,
)
from insole_core.insole.prescription.design_totals import MOST_CORRECTIONS, check_totals
from insole_core.insole.warnings.design_warnings import design_warnings


def many(count: int, kind: type[Correction], **values) -> InsoleDesign:
    return InsoleDesign(Side.LEFT, tuple(kind(**values) for _ in range(count)))


TOO_MUCH = [
    (many(100, Posting, rearfoot_deg=15), "turn the foot by 1500° together, and must be -15 to 15"),
    (many(100, HeelLift, height_mm=20), "lifts add up to 2000 mm, and must be -10 to 20 mm"),
    (many(3, HeelLift, height_mm=-5), "lifts add up to -15 mm"),
    (
        InsoleDesign(Side.LEFT, (Posting(forefoot_deg=10), ForefootTwist(angle_deg=6))),
        "turn the foot by 16° together",
    ),
    (  # the ends add up to nothing, and the middle to 30°
        InsoleDesign(
            Side.LEFT,
            (
                Posting(rearfoot_deg=-15, forefoot_deg=15, blend_start=0.1, blend_end=0.2),
                Posting(rearfoot_deg=15, forefoot_deg=-15, blend_start=0.8, blend_end=0.9),
            ),
        ),
        "turn the foot by 30° together",
    ),
    (many(MOST_CORRECTIONS + 1, Posting), "201 corrections, and 200 can be made"),
]


@pytest.mark.parametrize(("design", "sentence"), TOO_MUCH)
def test_totals_are_refused_in_words(left_foot, tmp_path: Path, design, sentence):
    with pytest.raises(DesignError, match=sentence):
        build_insole(left_foot, design)
    path = tmp_path / "design.json"
    path.write_text(json.dumps(design_to_json(design)))
    with pytest.raises(InputError, match=rf"design\.json: .*{sentence}"):
        read_design(path)
    assert design_from_json(design_to_json(design)) == design, "a case with it opens"


@pytest.mark.parametrize(
    "design",
    [
        many(25, Posting, rearfoot_deg=0.6),
        many(2, HeelLift, height_mm=10),
        InsoleDesign(Side.LEFT, (Posting(rearfoot_deg=15), Posting(rearfoot_deg=-15))),
        InsoleDesign(Side.LEFT, (Posting(rearfoot_deg=15), Posting(rearfoot_deg=9, enabled=False))),
        many(MOST_CORRECTIONS, Pelott, centre_mm=(0.0, 100.0)),
    ],
)
def test_totals_within_their_limits_pass(design):
    check_totals(design)


def test_pads_on_each_other_are_refused_by_the_height_of_the_insole(left_foot):
    heap = many(15, Pelott, centre_mm=(0.0, 140.0), height_mm=20)
    with pytest.raises(DesignError, match=r"would be 3\d\d mm high, and 200 mm can be made"):
        build_insole(left_foot, heap)


def test_more_corrections_than_are_ever_edited_are_not_read():
    with pytest.raises(DesignError, match="corrections holds 1001 of them, and may hold 1000"):
        design_from_json(design_to_json(many(1001, Posting)))


def test_very_many_pads_on_each_other_are_not_all_warned_of(left_foot):
    insole = build_insole(left_foot, many(30, Pelott, centre_mm=(0.0, 140.0), height_mm=0.1))
    found = design_warnings(insole, find_landmarks(left_foot), load_rules())
    overlaps = [w for w in found if "their heights add up" in w.sentence]
    assert 1 < len(overlaps) <= 10
