"""How load moves from one ground to another under a foot."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from benchmarks._contact_cases import forefoot_pads
from insole_core.contact.change import (
    GROUPS,
    HEADS,
    Assumptions,
    Change,
    Loading,
    Shown,
    changed,
    inside,
    pressure_change,
)
from insole_core.contact.designs import Shoe, left_out_of
from insole_core.contact.elastic_layers import uniform_compliance
from insole_core.contact.hardness import body_of, foam, modulus_of_shore_a
from insole_core.contact.load_case import Posture
from insole_core.contact.pressing import Pressed
from insole_core.contact.stance import (
    SOFT_SHOE,
    Ground,
    Sole,
    check_weight,
    notes_of_weight,
    shoe_floor,
)
from insole_core.errors import DesignError, InputError
from insole_core.foot.foot import Foot
from insole_core.foot.landmarks import find_landmarks
from insole_core.insole.elements import HeelLift, Pelott, Posting
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.prescription.layers import Layers
from insole_core.insole.prescription.materials import Material, MaterialTable, read_materials
from insole_core.insole.prescription.shell import Shell
from insole_core.workflows.foot_landmarks import with_places

EVA = Shoe(read_materials(), body=foam(35))


def pad(foot: Foot, height_mm: float) -> Pelott:
    x, y, _ = find_landmarks(foot)["metatarsal_head_3"].point
    return Pelott(
        centre_mm=(float(x), float(y) - 25), length_mm=50, width_mm=36, height_mm=height_mm
    )


def padded(foot: Foot, height_mm: float) -> InsoleDesign:
    corrections = (pad(foot, height_mm),) if height_mm else ()
    return InsoleDesign(foot.side, corrections=corrections, grid_mm=2.0)


@pytest.fixture(scope="module")
def sole(left_foot: Foot) -> Sole:
    return Sole.of(left_foot)


@pytest.fixture(scope="module")
def insole(sole: Sole) -> Ground:
    return EVA.built(sole, padded(sole.foot, 4))


@pytest.fixture(scope="module")
def from_flat(sole: Sole, insole: Ground) -> Change:
    return changed(Loading(sole, 75), shoe_floor(sole), insole, Assumptions())


def test_the_whole_load_is_carried_and_more_area_takes_it(from_flat: Change, sole: Sole) -> None:
    load_n = Loading(sole, 75).load_n
    assert load_n == pytest.approx(75 * 9.80665 / 2)
    for pressed in (from_flat.old, from_flat.new):
        assert pressed.mpa.min() >= 0
        assert pressed.mpa.sum() * 4 == pytest.approx(load_n, rel=1e-6)
    old_mm2, new_mm2 = from_flat.areas_mm2
    assert 3000 < old_mm2 < new_mm2
    heel = from_flat.of("heel").peak_percent
    assert heel is not None
    assert -70 < heel < -20
    assert 80 < from_flat.old_kpa.max() < 250  # of a person who stands on a hard floor


def test_the_mirrored_foot_has_the_mirrored_change(
    from_flat: Change, insole: Ground, left_foot: Foot, right_foot: Foot
) -> None:
    right = Sole.of(right_foot)
    x, y = pad(left_foot, 4).centre_mm
    mirrored_pad = replace(pad(left_foot, 4), centre_mm=(-x, y))
    design = replace(padded(right_foot, 0), corrections=(mirrored_pad,))
    mirrored = changed(
        Loading(right, 75), shoe_floor(right), EVA.built(right, design), Assumptions()
    )
    for name in GROUPS:
        one, other = from_flat.of(name).peak_percent, mirrored.of(name).peak_percent
        assert one == pytest.approx(other, abs=0.1)


def test_more_height_is_more_load_at_the_apex(sole: Sole) -> None:
    apex = pad(sole.foot, 4).centre_mm
    plain = EVA.built(sole, padded(sole.foot, 0))
    heights = (2, 4, 6)
    found = [
        changed(Loading(sole, 75), plain, EVA.built(sole, padded(sole.foot, mm)), Assumptions())
        for mm in heights
    ]
    at_apex = [
        float(replace(sole.field, heights_mm=kpa).height_at(np.array(apex)))
        for kpa in (found[0].old_kpa, *(one.new_kpa for one in found))
    ]
    assert at_apex == sorted(at_apex)
    assert at_apex[-1] > 2 * at_apex[0]


def test_grids_of_2_and_3_mm_find_the_peaks_of_1_mm(sole: Sole, from_flat: Change) -> None:
    def on_grid(step_mm: float) -> Change:
        other = Sole.of(sole.foot, step_mm)
        ground = EVA.built(other, padded(sole.foot, 4))
        return changed(Loading(other, 75), shoe_floor(other), ground, Assumptions())

    fine = on_grid(1.0)
    for coarse in (from_flat, on_grid(3.0)):
        for name in ("heel", "metatarsal_heads"):
            for found, expected in zip(coarse.peaks_kpa(name), fine.peaks_kpa(name), strict=True):
                assert found == pytest.approx(expected, rel=0.03)


def test_what_is_drawn_is_followed_closely_from_the_step_before(
    sole: Sole, from_flat: Change
) -> None:
    design, followed = padded(sole.foot, 4), from_flat
    x, y = pad(sole.foot, 4).centre_mm
    for ahead_mm in (2.0, 4.0):
        moved = replace(pad(sole.foot, 4), centre_mm=(x, y + ahead_mm))
        ground = EVA.built(sole, replace(design, corrections=(moved,)))
        followed = changed(
            from_flat.loading, shoe_floor(sole), ground, Assumptions(), followed, follows=True
        )
        assert followed.old is from_flat.old
    exact = changed(from_flat.loading, shoe_floor(sole), ground, Assumptions())
    for name in ("heel", "midfoot", "metatarsal_heads", "toes"):
        assert followed.of(name).peak_percent == pytest.approx(exact.of(name).peak_percent, abs=6)


def test_a_long_step_of_what_is_drawn_is_as_close(sole: Sole, from_flat: Change) -> None:
    higher = EVA.built(sole, padded(sole.foot, 10))
    given = (from_flat.loading, shoe_floor(sole), higher, Assumptions())
    followed, exact = changed(*given, from_flat, follows=True), changed(*given)
    for name in ("heel", "midfoot", "metatarsal_heads", "toes"):
        assert followed.of(name).peak_percent == pytest.approx(exact.of(name).peak_percent, abs=6)


def test_limits_hold_the_change_and_the_same_ground_changes_nothing(
    sole: Sole, insole: Ground, from_flat: Change
) -> None:
    loading = Loading(sole, 75)
    told = pressure_change(loading, shoe_floor(sole), insole, known=from_flat, points=[(0.0, 30.0)])
    for one in (*told.regions.values(), *told.points):
        if one.percent is not None:
            assert one.limits is not None
            assert one.limits[0] <= one.percent < one.limits[1]
    assert set(told.cannot_tell) == {name for name, one in told.regions.items() if one.reason}
    same = pressure_change(loading, insole, insole)
    loaded = [one for one in same.regions.values() if one.percent is not None]
    assert {one.percent for one in loaded} == {0.0}
    assert {one.limits for one in loaded} == {(0.0, 0.0)}


def test_of_pads_under_the_heads_nothing_is_told_and_of_one_behind_them_it_is(sole: Sole) -> None:
    pads = list(forefoot_pads(sole).values())
    plain = np.full(sole.known.shape, 4.0)
    cases = [(0, Posture.STANDING), (1, Posture.STANDING), (3, Posture.STANDING)]
    told = [
        pressure_change(
            Loading(sole, 70, posture),
            Ground(plain, plain, foam(20)),
            Ground(plain + pads[number], plain + pads[number], foam(20)),
        )
        for number, posture in cases
    ]
    behind, under, covered = (one.regions["metatarsal_heads"] for one in told)
    assert not behind.reason
    assert behind.percent is not None
    assert -17 < behind.percent < 0
    assert "not even the direction" in under.reason
    assert "not even the direction" in covered.reason  # the ground comes up, in the same form
    assert {"metatarsal_heads", *HEADS} <= set(told[1].cannot_tell)
    assert {"metatarsal_heads", *HEADS} <= set(told[1].change.untold)  # and as much at a drag
    reasons = [told[1].regions[head].reason for head in HEADS]
    assert any("so of none of them alone" in reason for reason in reasons)
    assert not all("so of none of them alone" in reason for reason in reasons)


def test_where_limits_leave_the_heads_untold_none_is_told_alone(sole: Sole) -> None:
    floor, thick = shoe_floor(sole), np.full(sole.known.shape, 6.0)
    loading, foams = Loading(sole, 75), Ground(thick, thick, foam(35))
    known = changed(loading, floor, foams, Assumptions())
    mpa = known.new.mpa * np.where(inside(sole, "head_2"), 6.0, 1.0)
    told = pressure_change(
        loading, floor, foams, known=replace(known, new=replace(known.new, mpa=mpa))
    )
    assert "metatarsal_heads" not in told.change.untold
    assert {"metatarsal_heads", *HEADS} <= set(told.cannot_tell)
    assert "so of none of them alone" in told.regions["head_5"].reason


def test_a_place_has_the_reason_of_its_region_and_no_colour(sole: Sole) -> None:
    x, y, _ = find_landmarks(sole.foot)["metatarsal_head_2"].point
    head, beside = (float(x), float(y)), (500.0, 30.0)
    thick = np.full(sole.known.shape, 6.0)
    loading = Loading(sole, 75, Posture.PUSH_OFF)
    ground = Ground(thick, thick, foam(35))
    told = pressure_change(loading, shoe_floor(sole), ground, points=[head, beside])
    at_head, off_the_foot = told.points
    assert at_head.reason == told.regions["head_2"].reason != ""
    assert "beside the sole" in off_the_foot.reason
    corner = (float(sole.field.x0_mm), float(sole.field.y0_mm))
    assert not sole.known[0, 0]
    at_corner = pressure_change(loading, shoe_floor(sole), ground, points=[corner]).points[0]
    assert "beside the sole" in at_corner.reason
    assert "leaves the ground" in told.regions["heel"].reason
    change = told.change  # and as much during a drag, without limits
    assert set(change.untold) <= set(told.cannot_tell)
    assert "head_2" in change.untold
    pressed = inside(sole, "head_2") & np.isfinite(change.percent)
    assert pressed.any()
    assert set(change.shown(change.untold)[pressed]) == {Shown.UNTOLD}
    assert set(change.shown(())[pressed]) == {Shown.PERCENT}


def test_a_place_that_is_newly_pressed_is_told_from_one_where_nothing_presses(
    from_flat: Change,
) -> None:
    heel = inside(from_flat.sole, "heel")
    rows = np.nonzero(heel.any(axis=1))[0]
    back, front = np.zeros(heel.shape, dtype=bool), np.zeros(heel.shape, dtype=bool)
    back[rows[: len(rows) // 3]], front[rows[-len(rows) // 3 :]] = True, True
    old, new = (replace(from_flat.old, mpa=0.1 * (heel & part)) for part in (front, front | back))
    change = replace(from_flat, old=old, new=new)
    shown = change.shown(())
    assert Shown.NEWLY in shown[heel & back]
    assert Shown.PERCENT in shown[heel & front]
    assert set(shown[~change.sole.known]) == {Shown.IDLE}
    assert set(shown[inside(change.sole, "toes")]) == {Shown.IDLE}
    untold = change.shown(("heel", "toes"))  # and nothing is hatched where nothing presses
    assert set(untold[heel]) <= {Shown.UNTOLD, Shown.IDLE}
    assert set(untold[inside(change.sole, "toes")]) == {Shown.IDLE}
    assert np.array_equal(untold == Shown.IDLE, shown == Shown.IDLE)

    # Where nothing of a region was pressed before, its places say so themselves.
    all_new = replace(from_flat, old=replace(old, mpa=np.zeros_like(old.mpa)), new=new)
    assert "heel" in all_new.untold
    assert set(all_new.shown(all_new.untold)[heel]) <= {Shown.NEWLY, Shown.IDLE}


def test_a_lower_peak_where_nothing_pressed_before_is_no_relief(from_flat: Change) -> None:
    midfoot = inside(from_flat.sole, "midfoot")
    rows = np.nonzero(midfoot.any(axis=1))[0]
    front, back = np.zeros(midfoot.shape), np.zeros(midfoot.shape)
    front[rows[-4:]], back[rows[:4]] = 0.1, 0.05
    old, new = (replace(from_flat.old, mpa=mpa * midfoot) for mpa in (front, back))
    moved = replace(from_flat, old=old, new=new)
    assert "where nothing pressed before" in moved.reason("midfoot")
    shown = moved.shown(moved.untold)[midfoot]  # no figure is shown, and what is newly pressed is
    assert {Shown.UNTOLD, Shown.NEWLY} <= set(shown)
    assert Shown.PERCENT not in shown
    assert not replace(from_flat, old=old, new=replace(old, mpa=old.mpa / 2)).reason("midfoot")


def test_a_lower_peak_of_a_region_that_carries_more_is_no_relief(from_flat: Change) -> None:
    """As behind the heads, where a pad takes over what they have pressed with at their border."""
    midfoot = inside(from_flat.sole, "midfoot")
    border = np.zeros_like(midfoot)
    border[np.nonzero(midfoot.any(axis=1))[0][-4:]] = True

    def pressed(border_mpa: float, else_mpa: float) -> Pressed:
        return replace(from_flat.old, mpa=np.where(border, border_mpa, else_mpa) * midfoot)

    for else_mpa, carries_more in ((0.01, False), (0.04, True)):
        moved = replace(from_flat, old=pressed(0.1, 0.01), new=pressed(0.06, else_mpa))
        old, new = moved.peaks_kpa("midfoot")
        assert new < old
        assert ("carries more in all" in moved.reason("midfoot")) == carries_more


def test_where_a_foot_cannot_stand_as_it_may_nothing_is_told(
    sole: Sole, insole: Ground, from_flat: Change, monkeypatch: pytest.MonkeyPatch
) -> None:
    loaded = Loading.pressed

    def pressed(
        loading: Loading, ground: Ground, assumed: Assumptions, *start: Any, **how: Any
    ) -> Pressed:
        if assumed.moved_mm[1] > 0:
            raise InputError("No pressure has this centre.")
        return loaded(loading, ground, assumed, *start, **how)

    monkeypatch.setattr(Loading, "pressed", pressed)
    heel = pressure_change(Loading(sole, 75), shoe_floor(sole), insole, known=from_flat).regions[
        "heel"
    ]
    assert heel.percent == from_flat.of("heel").peak_percent
    assert heel.limits is None
    assert "too much" in heel.reason


def test_landmarks_by_hand_say_where_the_heads_are(sole: Sole) -> None:
    marks = find_landmarks(sole.foot)
    by_hand = with_places(
        sole.foot,
        marks,
        {
            name: tuple(np.add(marks[name].point, (0, 12, 0)))
            for name in marks
            if name.startswith("metatarsal_head_")
        },
    )
    moved = Sole.of(sole.foot, landmarks=by_hand)
    rows = [np.flatnonzero(inside(one, "head_2").any(axis=1)).min() for one in (sole, moved)]
    assert rows[1] - rows[0] == 6
    assert not np.array_equal(moved.tissue, sole.tissue)
    assert Sole.of(sole.foot, landmarks=by_hand) is moved
    assert Sole.of(sole.foot) is sole


def test_flat_foam_relieves_as_in_published_series(sole: Sole) -> None:
    """Flat foam under the heel: 24 % in the mean (Goske 2006)."""
    floor = shoe_floor(sole)
    six = np.full(sole.known.shape, 9.5)
    soft = changed(Loading(sole, 75), floor, Ground(six, six, foam(5)), Assumptions())
    assert soft.of("heel").peak_percent == pytest.approx(-24, abs=10)


def test_a_thin_soft_insole_is_told_to_be_compressed_too_much(sole: Sole) -> None:
    thin = np.full(sole.known.shape, 1.5)
    soft = replace(foam(1), modulus_mpa=0.08)
    told = pressure_change(Loading(sole, 120), shoe_floor(sole), Ground(thin, thin, soft))
    assert "heel" in told.cannot_tell
    assert "too thin" in told.regions["heel"].reason
    away = pressure_change(Loading(sole, 120), Ground(thin, thin, soft), shoe_floor(sole))
    assert "too thin" in away.regions["heel"].reason


def test_the_midsole_below_does_not_compress_the_insole(sole: Sole) -> None:
    thin = np.full(sole.known.shape, 1.0)
    alone, on_soft = (Ground(thin, thin, foam(35), shoe) for shoe in ((), SOFT_SHOE))
    kpa = 0.1
    both_mm = kpa * uniform_compliance((foam(35), *SOFT_SHOE))
    expected = kpa / foam(35).confined_mpa
    assert on_soft.strain(np.full(thin.shape, both_mm)) == pytest.approx(expected)
    assert alone.strain(np.full(thin.shape, expected)) == pytest.approx(expected)
    assert not shoe_floor(sole, shoe=SOFT_SHOE).strain(thin).any()


def test_at_heel_strike_the_heel_carries_nearly_all_and_at_push_off_the_ball(sole: Sole) -> None:
    floor = shoe_floor(sole, shoe=SOFT_SHOE)
    shares = {}
    for posture in Posture:
        loading = Loading(sole, 75, posture)
        pressed = loading.pressed(floor, Assumptions())
        assert pressed.mpa.sum() * 4 == pytest.approx(loading.load_n, rel=1e-6)
        behind = pressed.mpa[sole.share[:, 0] < 0.4].sum() / pressed.mpa.sum()
        shares[posture] = behind
    assert shares[Posture.HEEL_STRIKE] > 0.85
    assert 0.5 < shares[Posture.STANDING] < 0.75
    assert shares[Posture.PUSH_OFF] < 0.1


def test_a_sole_that_weight_has_made_flat_is_refused(left_foot: Foot) -> None:
    mesh = left_foot.mesh
    flat = np.maximum(mesh.vertices, [-np.inf, -np.inf, 7.0]) - [0, 0, 7.0]
    standing = replace(left_foot, mesh=mesh.moved(flat))
    with pytest.raises(InputError, match="weight"):
        Sole.of(standing)


@pytest.mark.parametrize(("kept", "part"), [((0.35, 1.0), "heel"), ((0.0, 0.55), "ball")])
def test_half_a_foot_is_refused(left_foot: Foot, kept: tuple[float, float], part: str) -> None:
    share = left_foot.mesh.vertices[:, 1] / left_foot.length_mm
    half = left_foot.mesh.part((share >= kept[0]) & (share <= kept[1]))
    with pytest.raises(InputError, match=part):
        Sole.of(replace(left_foot, mesh=half))


def test_materials_give_way_by_their_hardness_or_not_at_all() -> None:
    table = read_materials()
    assert 1.2 < modulus_of_shore_a(35) < 1.6
    assert body_of("", table) == body_of("eva, shore a 35", table)
    assert body_of("EVA, Shore A 45", table).modulus_mpa > foam(35).modulus_mpa
    assert body_of("polypropylene", table).modulus_mpa > 1000
    clinics = MaterialTable([Material("own foam", 2, 2, shore_a=20.0), Material("EVA", 2, 2)])
    assert body_of("Own foam", clinics) == foam(20)
    assert body_of("EVA", clinics) == foam(35)  # the product knows it
    for unknown in ("TPU, printed", "felt"):
        with pytest.raises(DesignError, match="hardness"):
            body_of(unknown, table)


def test_what_the_model_leaves_out_of_postings_and_lifts_is_told(sole: Sole) -> None:
    plain = padded(sole.foot, 4.0)
    posted = replace(plain, corrections=(*plain.corrections, Posting(rearfoot_deg=4.0)))
    lifted = replace(plain, corrections=(HeelLift(height_mm=6.0),))
    assert left_out_of(plain, None) == ()
    (of_posting,) = left_out_of(posted)
    assert "no joint turns" in of_posting
    both = left_out_of(lifted, posted)
    assert both[0] == of_posting
    assert "heel lift" in both[1]


def test_a_stiff_shell_is_as_hard_as_a_floor_of_its_form(sole: Sole) -> None:
    design = replace(padded(sole.foot, 0), shell=Shell(material="polypropylene"))
    made = Shoe(read_materials())
    assert not made.assumed(design)
    for old in (padded(sole.foot, 0), replace(design, layers=Layers(cover_mm=3))):
        assert len(made.assumed(design, old)) == 1
    ground = made.built(sole, design)
    assert ground.beds(sole.known) == []
    assert np.array_equal(ground.top_mm, EVA.built(sole, design).top_mm)


def test_layers_give_way_in_series_each_by_its_own_material(sole: Sole) -> None:
    stiff = replace(padded(sole.foot, 0), shell=Shell(material="polypropylene"))
    shoe = Shoe(read_materials())

    def stacked(**layers: Any) -> Ground:
        design = replace(stiff, layers=Layers(**layers))
        assert not shoe.assumed(design)
        return shoe.built(sole, design)

    covered = stacked(cover_mm=3, cover_material="EVA")
    thicker = stacked(cover_mm=3, cover_material="EVA", shell_mm=2, shell_material="EVA")
    soft = stacked(cover_mm=3, cover_material="EVA", base_mm=3, base_material="EVA")
    give = [
        sum(
            uniform_compliance(bed.layers) - uniform_compliance(bed.counted)
            for bed in one.beds(sole.known)
        )
        for one in (covered, thicker, soft)
    ]
    assert give[0] == pytest.approx(3 / foam(35).confined_mpa, rel=0.05)
    assert give[0] < give[1] < give[2]
    assert covered.softer(2).upper[0].modulus_mpa == covered.upper[0].modulus_mpa / 2
    mpa = 0.1
    whole = covered.thickness_mm.clip(0, 3) / foam(35).confined_mpa
    strain = covered.strain(mpa * whole)
    assert strain.max() == pytest.approx(mpa / foam(35).confined_mpa, rel=0.01)
    unsaid = replace(stiff, layers=Layers(cover_mm=3))
    assert len(shoe.assumed(unsaid)) == 1
    assert not Shoe(read_materials(), body=foam(35)).assumed(unsaid)
    with pytest.raises(DesignError, match="felt"):
        stacked(cover_mm=3, cover_material="felt")


def test_a_foot_that_was_recorded_with_weight_is_told_or_refused() -> None:
    assert notes_of_weight("none") == ()
    assert "Nobody has said" in notes_of_weight(None)[0]
    assert "part of the weight" in notes_of_weight("semi")[0]
    with pytest.raises(InputError, match="without weight"):
        check_weight("full")
    check_weight("semi")
