"""Warnings by rules that are data; outlines; templates for other feet."""

from __future__ import annotations

import json
from dataclasses import replace

import numpy as np
import pytest

from insole_core.errors import DesignError, InputError
from insole_core.foot.landmarks import find_landmarks, with_places
from insole_core.geometry.side import Side
from insole_core.insole.build import build_insole
from insole_core.insole.clinic_rules import PronationStep, load_rules
from insole_core.insole.design_warning import DesignWarning
from insole_core.insole.elements import (
    CORRECTION_TYPES,
    ArchRaise,
    BrushStroke,
    FullLift,
    HeelCup,
    HeelLift,
    HeelSkive,
    Pelott,
    Posting,
    correction,
)
from insole_core.insole.elements.pad_places import placed_pad
from insole_core.insole.elements.words import worded
from insole_core.insole.outline.insole_outline import insole_outline
from insole_core.insole.pads.clearance import behind_heads_mm
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.prescription.design_differences import design_differences
from insole_core.insole.prescription.finish import Finish
from insole_core.insole.prescription.outline import Outline
from insole_core.insole.prescription.prescription_lines import correction_lines
from insole_core.insole.prescription.rim_sliders import with_cup_depth
from insole_core.insole.prescription.template import (
    Template,
    apply_template,
    make_template,
    read_template,
    template_to_json,
    write_template,
)
from insole_core.insole.primitives.outline_curve import crosses_itself, inside_curve
from insole_core.insole.warnings.design_warnings import design_warnings
from insole_core.messages import Message
from insole_core.resources import resource_path
from insole_core.workflows.pad_library import load_pads

RULES = load_rules()
EGG = Pelott(centre_mm=(0.0, 140.0))


def warnings(foot, *corrections, **keys) -> list[str]:
    insole = build_insole(foot, InsoleDesign(foot.side, corrections, **keys))
    return [w.sentence for w in design_warnings(insole, find_landmarks(foot), RULES)]


def snapped(foot, pad: Pelott, behind: float) -> Pelott:
    # The distance is square to the line of the heads, the steps are along y: a few of them.
    for _ in range(5):
        ahead = behind_heads_mm(pad, find_landmarks(foot)) - behind
        pad = replace(pad, centre_mm=(pad.centre_mm[0], pad.centre_mm[1] + ahead))
    return pad


def test_usual_prescription_has_no_warning(left_foot):
    pad = snapped(left_foot, EGG, RULES.pelott_usual_behind_heads_mm)
    assert warnings(left_foot, pad, Posting(rearfoot_deg=4)) == []


@pytest.mark.parametrize(
    ("corrections", "text"),
    [
        ((Posting(rearfoot_deg=7),), "rearfoot is posted by 7° medially; more than 6°"),
        ((Posting(rearfoot_deg=-9.2),), "rearfoot is posted by 9.2° laterally; more than 6°"),
        ((Posting(forefoot_deg=-7),), "forefoot is posted by 7° laterally; more than 6°"),
        ((HeelLift(height_mm=9),), "lifted by 9 mm"),
        (
            (FullLift(height_mm=8, heads_share=0.8),),
            "The ball is lifted by 6.4 mm; on the device up to 5 mm are usual.",
        ),
        ((HeelSkive(depth_mm=3),), "skive of 3 mm with 0° of inversion needs a heel cup of 14 mm"),
        (
            (HeelSkive(depth_mm=3), Posting(rearfoot_deg=4), HeelCup(depth_mm=16)),
            "needs a heel cup of 20 mm, and the cup is 16 mm",
        ),
        ((Pelott(centre_mm=(200.0, 140.0), shape="drop"),), "Only 0% of the drop lies below"),
        ((EGG, replace(EGG, id="b", centre_mm=(3.0, 141.0))), "lies with .* on the pelott"),
    ],
)
def test_unusual_values_are_warned_of(left_foot, corrections, text):
    import re

    assert any(re.search(text, warning) for warning in warnings(left_foot, *corrections))


@pytest.mark.parametrize(("cup_mm", "is_warned"), [(12.0, True), (14.0, False), (20.0, False)])
def test_a_skive_wants_a_deep_cup_of_the_designed_rim(left_foot, cup_mm, is_warned):
    design = InsoleDesign(
        left_foot.side,
        (HeelSkive(depth_mm=3),),
        grid_mm=2.0,
        finish=with_cup_depth(Finish(), cup_mm),
    )
    built = build_insole(left_foot, design)
    said = [str(w.sentence) for w in design_warnings(built, find_landmarks(left_foot), RULES)]
    assert any("needs a heel cup of 14 mm" in sentence for sentence in said) == is_warned


def test_distance_to_the_heads_is_shown_and_snapped_to(left_foot):
    pad = snapped(left_foot, EGG, 8.0)
    assert behind_heads_mm(pad, find_landmarks(left_foot)) == pytest.approx(8.0, abs=0.5)
    ahead = replace(pad, centre_mm=(pad.centre_mm[0], pad.centre_mm[1] + 20))
    assert any("mm ahead of the line" in w for w in warnings(left_foot, ahead))


@pytest.mark.parametrize(
    ("behind_mm", "said"),
    [
        (5.6, "lies 5.6 mm behind the line of the heads 2 to 4; the clinic's rule is 6 to 11 mm"),
        (5.97, ""),
        (11.03, ""),
        (11.4, "lies 11.4 mm behind"),
    ],
)
def test_distance_to_the_heads_is_compared_as_it_is_printed(left_foot, behind_mm, said):
    pad = snapped(left_foot, EGG, behind_mm)
    assert behind_heads_mm(pad, find_landmarks(left_foot)) == pytest.approx(behind_mm, abs=0.01)
    found = [w for w in warnings(left_foot, pad) if "line of the heads" in w]
    assert [said in w for w in found] == ([True] if said else [])


def test_angles_that_add_up_to_the_limit_are_not_above_it(left_foot):
    ten = [Posting(rearfoot_deg=0.6) for _ in range(10)]
    assert sum(c.rearfoot_deg for c in ten) != 6.0, "the sum of the numbers is not the number"
    assert warnings(left_foot, *ten) == []
    (found,) = warnings(left_foot, *ten, Posting(rearfoot_deg=0.1))
    assert found.startswith("The rearfoot is posted by 6.1° medially; more than 6°")


def test_lifts_are_judged_together(left_foot):
    found = warnings(left_foot, HeelLift(height_mm=4), HeelLift(height_mm=4))
    assert ["lifted by 8 mm" in w for w in found].count(True) == 1


@pytest.mark.parametrize(
    ("lifts", "said"),
    [
        ((HeelLift(height_mm=7), FullLift(height_mm=8)), "lifted by 15 mm"),
        ((FullLift(height_mm=4), HeelLift(height_mm=3)), "lifted by 7 mm"),
        ((HeelLift(height_mm=9), HeelLift(height_mm=-4)), ""),
        ((FullLift(height_mm=8),), ""),
    ],
)
def test_a_heel_lift_counts_with_all_that_raises_the_heel(left_foot, lifts, said):
    found = [warning for warning in warnings(left_foot, *lifts) if "heel is lifted" in warning]
    assert [said in warning for warning in found] == ([True] if said else [])


def test_a_usual_lift_of_the_whole_foot_is_not_warned_of(left_foot):
    assert warnings(left_foot, FullLift(), max_height_mm=20.0) == []


def test_an_element_brings_its_own_rule(left_foot, monkeypatch):
    monkeypatch.setattr(correction, "CORRECTION_TYPES", dict(CORRECTION_TYPES))

    class Shim(HeelLift):
        type = "shim"

        @classmethod
        def rule(cls, mine, judged):
            for one in mine:
                lifted_mm, usual_mm = judged.lifted_mm(0.0), judged.rules.greatest_heel_lift_mm
                yield DesignWarning(Message(f"{lifted_mm:g} of {usual_mm:g}"), one.id)

    assert warnings(left_foot, Shim(height_mm=2.0)) == ["2 of 6"]


def test_high_insole_is_warned_of_with_the_place(left_foot):
    insole = build_insole(left_foot, InsoleDesign(Side.LEFT, thickness_mm=20))
    (found,) = design_warnings(insole, find_landmarks(left_foot), RULES)
    assert "may not fit a shoe" in found.sentence
    assert found.place_mm is not None


@pytest.mark.parametrize("side", ["left_foot", "right_foot"])
@pytest.mark.parametrize(
    ("moved", "like", "named"),
    [
        ("metatarsal_head_5", (-1.15, "metatarsal_head_1"), "1st head and 5th head"),
        ("heel_centre", (1.0, "toe_tip_2"), "heel centre and 1st head"),
        ("toe_tip_2", (1.0, "heel_centre"), "2nd head and 2nd toe"),
    ],
)
def test_landmarks_in_impossible_order_are_warned_of_once(request, side, moved, like, named):
    foot = request.getfixturevalue(side)
    insole = build_insole(foot, InsoleDesign(foot.side))
    found = find_landmarks(foot)
    assert design_warnings(insole, found, RULES) == ()
    share, other = like
    x, y, z = found[other].point if share > 0 else found[other].point * [1.15, 1.0, 1.0]
    (warning,) = design_warnings(insole, with_places(foot, found, {moved: (x, y, z)}), RULES)
    assert warning.sentence.startswith(f"The landmarks {named} stand in an order that no foot has")
    assert warning.place_mm == pytest.approx((x, y))


def test_rules_of_the_clinic_are_read_and_checked(tmp_path):
    path = tmp_path / "rules.json"
    rules = {name: getattr(RULES, name) for name in RULES.__dataclass_fields__}
    del rules["pronation"]
    content = {"format": "insole-rules", "version": 1, "rules": {**rules, "post_unusual_deg": 3}}
    path.write_text(json.dumps(content))
    assert load_rules(path).post_unusual_deg == 3
    assert load_rules(path).pronation == ()
    steps = [{"from_deg": 3, "post_deg": 4}]
    path.write_text(json.dumps({**content, "pronation": steps}))
    assert load_rules(path).pronation == (PronationStep(3, 4),)
    path.write_text(json.dumps({**content, "rules": {}}))
    with pytest.raises(InputError, match=r"rules\.json.*post_unusual_deg is missing"):
        load_rules(path)


@pytest.mark.parametrize("foot_name", ["left_foot", "right_foot"])
@pytest.mark.parametrize("extent", ["full", "three_quarter"])
def test_outline_goes_round_the_foot(foot_name, extent, request):
    foot = request.getfixturevalue(foot_name)
    marks = find_landmarks(foot)
    outline = insole_outline(foot, InsoleDesign(foot.side, outline=Outline(extent=extent)), marks)
    assert not crosses_itself(outline)
    x, y = outline.T
    assert (x * np.roll(y, -1) - y * np.roll(x, -1)).sum() > 0
    heads = min(marks[f"metatarsal_head_{n}"].point[1] for n in range(1, 6))
    assert y.max() < foot.length_mm + 5.01
    assert y.min() == pytest.approx(-2, abs=0.5)
    end = foot.length_mm + 5 if extent == "full" else heads - 8
    sole = foot.mesh.vertices[(foot.mesh.vertices[:, 2] < 8) & (foot.mesh.vertices[:, 1] < end - 9)]
    assert inside_curve(outline, sole[:, :2]).mean() > 0.99


def test_outline_of_a_shoe_size_has_its_length(left_foot):
    design = InsoleDesign(Side.LEFT, outline=Outline(source="shoe_size", shoe_size_eu=40))
    outline = insole_outline(left_foot, design, find_landmarks(left_foot))
    assert np.ptp(outline[:, 1]) == pytest.approx(40 * 20 / 3, abs=0.05)


def test_crossing_outlines_are_refused(left_foot):
    crossed = ((0.0, 0.0), (40.0, 100.0), (40.0, 0.0), (0.0, 100.0))
    design = InsoleDesign(Side.LEFT, outline=Outline(source="drawn", points_mm=crossed))
    with pytest.raises(DesignError, match="outline of the insole crosses itself"):
        build_insole(left_foot, design)
    small = tuple((x - 20, y - 50) for x, y in crossed)
    pad = Pelott(centre_mm=(0.0, 100.0), shape="outline", outline_mm=small)
    with pytest.raises(DesignError, match="crosses itself; draw the outline again"):
        build_insole(left_foot, InsoleDesign(Side.LEFT, (pad,)))
    away = replace(pad, outline_mm=((10.0, 0.0), (30.0, 0.0), (20.0, 20.0)))
    with pytest.raises(DesignError, match="does not go round the pad's centre"):
        build_insole(left_foot, InsoleDesign(Side.LEFT, (away,)))


def test_smoothing_beyond_even_is_refused(left_foot):
    stroke = BrushStroke(mode="smooth", strength=1.5, points_mm=((0.0, 50.0),))
    with pytest.raises(DesignError, match=r"strength of corrections\[0\].*must be 0 to 1"):
        build_insole(left_foot, InsoleDesign(Side.LEFT, (stroke,)))


PRESCRIBED = InsoleDesign(
    Side.LEFT, (EGG, Posting(rearfoot_deg=4), BrushStroke(points_mm=((0.0, 50.0), (5.0, 60.0))))
)


def test_template_on_its_own_foot_is_the_design(left_foot):
    template = make_template("flat foot", PRESCRIBED, find_landmarks(left_foot))
    again = apply_template(template, Side.LEFT, find_landmarks(left_foot))
    assert again.corrections[0].centre_mm == pytest.approx(EGG.centre_mm)
    assert again.corrections[1] == PRESCRIBED.corrections[1]


def test_template_for_another_side_is_mirrored(left_foot, right_foot):
    template = make_template("flat foot", PRESCRIBED, find_landmarks(left_foot))
    other = apply_template(template, Side.RIGHT, find_landmarks(right_foot))
    assert other.side is Side.RIGHT
    assert other.corrections[0].centre_mm == pytest.approx((0.0, 140.0), abs=0.05)
    assert other.corrections[2].points_mm[1] == pytest.approx((-5.0, 60.0), abs=0.05)


def test_places_move_with_the_landmarks_and_sizes_stay(left_foot):
    marks = find_landmarks(left_foot)
    template = make_template("t", PRESCRIBED, marks)
    anchors = ("heel_centre", "metatarsal_head_1", "metatarsal_head_5")
    longer = {n: tuple(marks[n].point * [1.1, 1.2, 1]) for n in anchors}
    fitted = apply_template(template, Side.LEFT, with_places(left_foot, marks, longer))
    pad = fitted.corrections[0]
    assert pad.centre_mm == pytest.approx((0.0, 168.0), abs=1e-6)
    assert (pad.length_mm, pad.height_mm) == (EGG.length_mm, EGG.height_mm)


def test_template_file_comes_back(left_foot, tmp_path):
    template = make_template("flat foot", PRESCRIBED, find_landmarks(left_foot))
    write_template(template, tmp_path / "t.json")
    assert read_template(tmp_path / "t.json") == template
    newer = {**template_to_json(template), "version": 2}
    (tmp_path / "t.json").write_text(json.dumps(newer))
    with pytest.raises(InputError, match="version 2, which is newer than this program"):
        read_template(tmp_path / "t.json")


@pytest.mark.parametrize(
    ("change", "reason"),
    [
        ({"metatarsal_head_1": (30.0, -5.0, 0.0)}, "1st metatarsal head lies behind the heel"),
        ({"metatarsal_head_1": (-60.0, 170.0, 0.0)}, "lateral of the 5th on this left foot"),
        ({"heel_centre": (5.0, 160.0, 0.0)}, "behind the heel|on one line"),
    ],
)
def test_landmarks_in_impossible_order_are_refused(left_foot, change, reason):
    marks = with_places(left_foot, find_landmarks(left_foot), change)
    with pytest.raises(DesignError, match=reason):
        make_template("t", PRESCRIBED, marks)


def test_template_is_a_value(left_foot):
    template = make_template("t", PRESCRIBED, find_landmarks(left_foot))
    assert isinstance(hash(template), int)
    assert isinstance(template, Template)


def metatarsal_pad(foot, **keys) -> Pelott:
    return snapped(foot, replace(EGG, **keys), RULES.pelott_usual_behind_heads_mm)


@pytest.mark.parametrize(("height_mm", "warned"), [(4.0, False), (6.0, False), (6.1, True)])
def test_a_metatarsal_pad_above_6_mm_is_warned_of(left_foot, height_mm, warned):
    found = warnings(left_foot, metatarsal_pad(left_foot, height_mm=height_mm))
    assert found == (["The pelott is 6.1 mm high; up to 6 mm are usual."] if warned else [])


def test_the_place_of_a_pad_may_be_ahead_of_the_heads_by_the_clinics_rule(left_foot, tmp_path):
    content = json.loads(resource_path("rules/rules.json").read_text(encoding="utf-8"))
    content["rules"]["pelott_least_behind_heads_mm"] = -8
    content["rules"]["pelott_greatest_behind_heads_mm"] = -2
    path = tmp_path / "rules.json"
    path.write_text(json.dumps(content), encoding="utf-8")
    rules = load_rules(path)
    pad = snapped(left_foot, EGG, -5.0)
    insole = build_insole(left_foot, InsoleDesign(Side.LEFT, (pad,)))
    assert design_warnings(insole, find_landmarks(left_foot), rules) == ()
    assert "mm ahead of the line" in warnings(left_foot, pad)[0]


def element(foot, kind: str, **keys) -> Pelott:
    (pad,) = (pad for pad in load_pads() if pad.kind == kind)
    template = replace(pad.template, id=kind, **keys)
    return placed_pad(template, pad.place, foot.side, find_landmarks(foot), 8.0)


@pytest.mark.parametrize("side", ["left_foot", "right_foot"])
@pytest.mark.parametrize("kind", ["reverse_mortons_extension", "dancers_pad"])
def test_a_pad_that_comes_under_the_1st_head_is_warned_of(request, side, kind):
    foot = request.getfixturevalue(side)
    pad = element(foot, kind)
    assert warnings(foot, pad) == []
    x, y = pad.centre_mm
    under = replace(pad, centre_mm=(x + 20 * foot.side.medial_sign, y))
    (found,) = (w for w in warnings(foot, under) if "1st head" in w)
    assert "comes within 0 mm of the 1st head, which it leaves free" in found


def test_a_recess_deeper_than_usual_is_warned_of(left_foot):
    deep, usual = (element(left_foot, "relief_head_3", height_mm=-d) for d in (10.4, 10.0))
    assert not [w for w in warnings(left_foot, usual, thickness_mm=14) if "deep" in w]
    (found,) = (w for w in warnings(left_foot, deep, thickness_mm=14) if "deep" in w)
    assert found == "The relief under the 3rd head is 10.4 mm deep; up to 10 mm are usual."


FILLERS = ["forefoot_filler", *(f"toe_filler_{n}" for n in range(1, 6))]


@pytest.mark.parametrize("side", ["left_foot", "right_foot"])
def test_a_filler_that_the_insole_does_not_hold_is_warned_of(request, side):
    foot = request.getfixturevalue(side)
    filler = element(foot, "forefoot_filler")
    (found,) = warnings(foot, filler)
    assert found == (
        "Only 2% of the forefoot filler lies on the insole, and the rest is not made; set the shoe "
        "size or a longer outline."
    )
    x, y = filler.centre_mm
    for kind in FILLERS:
        pad = replace(filler, kind=kind, centre_mm=(x, y + 100))
        (found,) = (w for w in warnings(foot, pad) if "lies on the insole" in w)
        assert found.startswith(f"Only 0% of the {pad.noun} lies")
        inside = replace(pad, centre_mm=(x, y - 60), length_mm=20, width_mm=20)
        assert not [w for w in warnings(foot, inside) if "lies on the insole" in w]


RECESSES = sorted({pad.kind for pad in load_pads() if pad.template.height_mm < 0})


def recess(foot, kind: str, height_mm: float) -> Pelott:
    pad = next(pad for pad in load_pads() if pad.kind == kind)
    template = replace(pad.template, id=kind, height_mm=height_mm)
    return placed_pad(template, pad.place, foot.side, find_landmarks(foot), 8.0)


@pytest.mark.parametrize("kind", RECESSES)
def test_a_recess_is_told_by_its_depth(left_foot, kind):
    deep, knob, flat = (recess(left_foot, kind, height) for height in (-3.5, 3.5, -1.0))
    found = deep.declared("height_mm")
    assert worded(found, deep.height_mm) == "3.5 mm"
    assert worded(found, knob.height_mm) == "-3.5 mm"
    before, *both = (InsoleDesign(left_foot.side, (pad,)) for pad in (flat, deep, knob))
    for design, brief in zip(both, ("3.5 mm deep", "3.5 mm high"), strict=True):
        assert str(design.corrections[0].brief()).startswith(brief)
        (difference,) = design_differences(before, design)
        told, _, now = difference.partition(" → ")
        assert "1 mm deep" in told
        assert now.startswith(brief)
        (line,) = correction_lines(design)
        assert f"Depth {worded(found, design.corrections[0].height_mm)};" in line
        assert "Height" not in line


def test_recesses_that_stand_out_are_warned_of(left_foot):
    knobs, deep = ([recess(left_foot, kind, height) for kind in RECESSES] for height in (3.5, -0.5))
    assert {
        f"The {pad.noun} stands 3.5 mm out of the insole and presses instead of relieving; set a "
        "depth above 0."
        for pad in knobs
    } == {sentence for sentence in warnings(left_foot, *knobs) if "stands" in sentence}
    assert not [sentence for sentence in warnings(left_foot, *deep) if "stands" in sentence]


def test_all_others_are_told_by_their_height():
    others = [pad.template for pad in load_pads() if pad.template.height_mm > 0]
    assert {pad.declared("height_mm").label for pad in others} == {"Height"}
    own = replace(EGG, kind="My relief", shape="cut_out")
    assert own.declared("height_mm").label == "Depth"  # a kind of the clinic's: by its shape


def test_a_recess_through_the_bottom_is_refused(left_foot):
    with pytest.raises(DesignError, match=r"would be only .* mm thick"):
        warnings(left_foot, element(left_foot, "relief_head_3", height_mm=-5.0))


def test_a_filler_lies_beside_the_foot_without_a_warning(left_foot):
    filler, longer = (
        element(left_foot, "forefoot_filler", length_mm=25),
        Outline(toe_allowance_mm=30),
    )
    assert warnings(left_foot, filler, outline=longer) == []
    (found,) = warnings(left_foot, replace(filler, kind=None), outline=longer)
    assert "lies below the foot" in found


APEX = (18.0, 118.0)


def of_arch(foot, *corrections) -> list[str]:
    return [warning for warning in warnings(foot, *corrections) if "arch" in warning]


@pytest.mark.parametrize(("target_mm", "said"), [
    (30.0, ""), (5.0, "mm high where 5 mm are prescribed, and an arch raise lowers nothing"),
])  # fmt: skip
def test_a_target_below_the_arch_is_warned_of(left_foot, target_mm, said):
    found = of_arch(left_foot, ArchRaise(target_mm=target_mm, apex_mm=APEX))
    assert [said in warning for warning in found] == ([True] if said else [])


def test_a_recess_that_takes_the_arch_away_is_warned_of(left_foot):
    recess = Pelott(centre_mm=APEX, shape="cut_out", length_mm=20, width_mm=20, height_mm=-3)
    (found,) = of_arch(left_foot, ArchRaise(target_mm=30.0, apex_mm=APEX), recess)
    assert found.startswith("The arch is only 27 mm high where 30 mm are prescribed")


def test_an_arch_raised_beside_the_insole_is_warned_of(left_foot):
    (found,) = of_arch(left_foot, ArchRaise(target_mm=30.0, apex_mm=(300.0, 118.0)))
    assert found == "The arch is to be raised beside the insole; move its place inwards."
