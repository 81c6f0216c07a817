"""Base forms: placed by landmarks, graded, mixed with the foot, kept from an insole."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from insole_core.errors import DesignError, InputError
from insole_core.foot.foot import Foot
from insole_core.foot.landmarks import find_landmarks
from insole_core.geometry.arrays import FloatArray
from insole_core.insole.build import Insole, build_insole
from insole_core.insole.elements import HeelSkive, Pelott, Posting
from insole_core.insole.forms.form_file import read_form, write_form
from insole_core.insole.forms.form_surface import finish_on_base, form_frame, form_heights
from insole_core.insole.kept_form import form_of
from insole_core.insole.prescription.base_form import HEADS_ALONG, BaseForm, Form
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.prescription.device import apply_device, read_device
from insole_core.insole.prescription.finish import Finish
from insole_core.insole.surface.contact import base_key, contact_base, sole_surface
from insole_core.resources import resource_path

SHARES = tuple(np.linspace(-0.1, 1.1, 7).round(2).tolist())
FORMS = sorted(resource_path("forms").glob("*.json"))


def form(height_of, length_mm: float = 250.0, ball_width_mm: float = 95.0) -> Form:
    """A form with heights from a function of the shares along and across."""
    rows = tuple(tuple(float(height_of(u, v)) for v in SHARES) for u in SHARES)
    return Form(
        name="Test",
        length_mm=length_mm,
        ball_width_mm=ball_width_mm,
        along_shares=SHARES,
        across_shares=SHARES,
        heights_mm=rows,
    )


def own_size(foot: Foot, height_of) -> Form:
    frame = form_frame(foot)
    return form(height_of, frame.length_mm, frame.ball_width_mm)


def on_base(foot: Foot, of: Form, contact_share: float = 0.0, **more) -> InsoleDesign:
    return InsoleDesign(foot.side, base=BaseForm(form=of, contact_share=contact_share), **more)


def place(foot: Foot, name: str) -> FloatArray:
    return find_landmarks(foot)[name].point[:2]


def support(insole: Insole) -> np.ndarray:
    """Nodes of the sole behind the heads, away from the rim."""
    x, y = np.meshgrid(insole.contact.x_mm, insole.contact.y_mm)
    along, across = form_frame(insole.foot).shares(np.stack([x, y], axis=-1))
    return (along > 0.05) & (along < HEADS_ALONG) & (across > 0.12) & (across < 0.88)


def test_stations_lie_at_the_landmarks(left_foot, right_foot):
    for foot in (left_foot, right_foot):
        shares = form_frame(foot).shares
        for name, across in (("heel_medial", 0), ("heel_lateral", 1), ("metatarsale_tibiale", 0)):
            assert shares(place(foot, name))[1] == pytest.approx(across, abs=1e-9)
        for name in ("metatarsal_head_1", "metatarsal_head_5"):
            assert shares(place(foot, name))[0] == pytest.approx(HEADS_ALONG, abs=0.01)
        along, _ = shares(np.array([[0.0, 0.0], [0.0, foot.length_mm]]))
        np.testing.assert_allclose(along, [0, 1], atol=1e-9)


def test_places_and_shares_are_each_others_inverse(left_foot):
    frame = form_frame(left_foot)
    along, across = np.linspace(-0.05, 1.05, 31), np.linspace(-0.2, 1.2, 15)
    shares = frame.shares(frame.points(along, across))
    np.testing.assert_allclose(shares[0], np.broadcast_to(along[:, None], (31, 15)), atol=1e-5)
    np.testing.assert_allclose(shares[1], np.broadcast_to(across, (31, 15)), atol=1e-9)


def test_a_form_takes_the_place_of_the_sole(left_foot):
    built = contact_base(left_foot, on_base(left_foot, own_size(left_foot, lambda u, v: 20 * v)))
    medial, lateral = (place(left_foot, f"heel_{border}") for border in ("medial", "lateral"))
    heights = built.surface.height_at(np.array([medial, lateral]))
    assert heights[1] - heights[0] == pytest.approx(20, abs=1e-3)


def test_heights_grow_with_the_width_and_not_with_the_length(left_foot):
    frame = form_frame(left_foot)
    narrow = form(lambda u, v: 10 * v, ball_width_mm=frame.ball_width_mm / 1.2, length_mm=300)
    height = form_heights(narrow, frame, place(left_foot, "heel_lateral"))
    assert height == pytest.approx(12, abs=1e-6)


def test_contact_share_weighs_foot_and_form(left_foot):
    tilted = own_size(left_foot, lambda u, v: 10 * u)
    at = np.array([place(left_foot, "heel_centre"), place(left_foot, "arch_apex")])
    rise = {}
    for share in (0.0, 0.3, 1.0):
        surface = contact_base(left_foot, on_base(left_foot, tilted, share)).surface
        rise[share] = float(np.diff(surface.height_at(at))[0])
    assert rise[0.3] == pytest.approx(0.3 * rise[1.0] + 0.7 * rise[0.0], abs=1e-9)
    plain = contact_base(left_foot, InsoleDesign(left_foot.side)).surface
    whole = contact_base(left_foot, on_base(left_foot, tilted, 1.0)).surface
    np.testing.assert_allclose(whole.heights_mm, plain.heights_mm, atol=1e-9)


def test_a_form_is_independent_of_the_scans_heights(left_foot):
    """Only landmarks place it: a bump on the sole changes nothing."""
    flat = contact_base(left_foot, on_base(left_foot, read_form(resource_path("forms/flat.json"))))
    assert np.ptp(flat.surface.heights_mm) == pytest.approx(0, abs=1e-9)
    assert np.ptp(sole_surface(left_foot, InsoleDesign(left_foot.side)).surface.heights_mm) > 10


@pytest.mark.parametrize("path", FORMS, ids=lambda path: path.stem)
def test_every_form_of_the_library_is_mirrored_exactly(path: Path, left_foot, right_foot):
    designs = [on_base(foot, read_form(path)) for foot in (left_foot, right_foot)]
    left, right = (
        contact_base(foot, design).surface
        for foot, design in zip((left_foot, right_foot), designs, strict=True)
    )
    nodes = left.nodes[:, :2]
    there = right.height_at(nodes * [-1, 1])
    inside = np.isfinite(there)
    assert inside.mean() > 0.9
    np.testing.assert_allclose(there[inside], left.heights_mm.ravel()[inside], atol=1e-6)


@pytest.mark.parametrize("path", FORMS, ids=lambda path: path.stem)
def test_every_form_of_the_library_has_its_floor_at_zero(path: Path):
    heights = np.array(read_form(path).heights_mm)
    assert heights.min() == 0
    assert heights.max() < 40


def test_exchanging_the_base_keeps_pads_and_postings(left_foot):
    pad = Pelott(centre_mm=(0.0, 150.0), height_mm=5.0)
    flat = read_form(resource_path("forms/flat.json"))
    bare, padded = (
        build_insole(left_foot, on_base(left_foot, flat, corrections=corrections)).contact
        for corrections in ((), (pad,))
    )
    added = padded.heights_mm - bare.heights_mm
    on_foot = build_insole(left_foot, InsoleDesign(left_foot.side, (pad,))).contact
    bare_foot = build_insole(left_foot, InsoleDesign(left_foot.side)).contact
    np.testing.assert_allclose(added, on_foot.heights_mm - bare_foot.heights_mm, atol=1e-9)
    posted = build_insole(
        left_foot,
        on_base(left_foot, flat, corrections=(Posting(rearfoot_deg=4, forefoot_deg=4),)),
    ).contact
    heel = np.array([place(left_foot, "heel_lateral"), place(left_foot, "heel_medial")])
    heel[1, 1] = heel[0, 1]
    rise = np.diff(posted.height_at(heel))[0]
    assert rise == pytest.approx(np.ptp(heel[:, 0]) * np.tan(np.radians(4)), abs=1e-6)


def test_a_form_of_another_length_by_a_half_is_refused(left_foot):
    other = form(lambda u, v: 0, length_mm=left_foot.length_mm / 1.5)
    with pytest.raises(DesignError, match=r'"Test" is that of a foot of .* choose a form of about'):
        build_insole(left_foot, on_base(left_foot, other))
    near = form(lambda u, v: 0, length_mm=left_foot.length_mm / 1.49)
    build_insole(left_foot, on_base(left_foot, near))


def test_the_base_is_part_of_the_key(left_foot):
    tilted = own_size(left_foot, lambda u, v: u)
    keys = {
        base_key(design)
        for design in (
            InsoleDesign(left_foot.side),
            on_base(left_foot, tilted),
            on_base(left_foot, tilted, 0.5),
            on_base(left_foot, replace(tilted, heights_mm=tilted.heights_mm[::-1])),
        )
    }
    assert len(keys) == 4


@pytest.mark.parametrize(
    "corrections",
    [
        (),
        (
            Posting(rearfoot_deg=4, forefoot_deg=-2),
            HeelSkive(depth_mm=3),
            Pelott(centre_mm=(0.0, 150.0), height_mm=6.0),
            Pelott(shape="cut_out", centre_mm=(0.0, 70.0), length_mm=25, width_mm=20, height_mm=-2),
        ),
    ],
    ids=["plain", "corrected"],
)
def test_a_kept_form_realises_the_insole_again(left_foot, right_foot, corrections):
    for foot in (left_foot, right_foot):
        insole = build_insole(foot, InsoleDesign(foot.side, corrections, thickness_mm=4.0))
        kept = form_of(insole, "Ours", "a test")
        again = build_insole(foot, on_base(foot, kept, thickness_mm=4.0))
        off = again.contact.heights_mm - insole.contact.heights_mm
        assert np.abs(off[support(insole) & insole.measured]).max() <= 0.3
        assert len(kept.heights_mm) * len(kept.heights_mm[0]) < 25000


@pytest.mark.parametrize("key", ["eva-full-length", "ucbl-child"])
def test_an_insole_on_its_own_form_stays_as_it_is(left_foot, key):
    """Fill and smoothing of a scan are not applied to a form a second time."""
    device = read_device(resource_path(f"devices/{key}.json"))
    design = apply_device(device, InsoleDesign(left_foot.side))
    insole = build_insole(left_foot, design)
    kept = form_of(insole, "Ours")
    again = build_insole(left_foot, replace(design, base=BaseForm(form=kept)))
    finished = contact_base(left_foot, design).finished
    assert finished is not None
    off = again.contact.heights_mm - insole.contact.heights_mm
    assert np.abs(off[finished.zones.support]).max() <= 0.3


def test_fill_counts_by_the_share_of_the_foot():
    asked = Finish(arch_fill_mm=3.2, expansion_mm=2.0, skin_smoothing_mm=2.0)
    of = form(lambda u, v: 0.0)
    assert finish_on_base(asked, None) == asked
    half = finish_on_base(asked, BaseForm(form=of, contact_share=0.5))
    assert (half.arch_fill_mm, half.expansion_mm, half.skin_smoothing_mm) == (1.6, 1.0, 2.0)
    alone = finish_on_base(asked, BaseForm(form=of))
    assert (alone.arch_fill_mm, alone.expansion_mm, alone.skin_smoothing_mm) == (0, 0, 0)


def test_a_kept_form_of_a_left_foot_serves_the_right_one(left_foot, right_foot):
    kept = form_of(build_insole(left_foot, InsoleDesign(left_foot.side)), "Ours")
    design = InsoleDesign(right_foot.side)
    of_right = build_insole(right_foot, design)
    again = build_insole(right_foot, on_base(right_foot, kept))
    off = again.contact.heights_mm - of_right.contact.heights_mm
    assert np.abs(off[support(of_right) & of_right.measured]).max() <= 0.3


@pytest.mark.parametrize("name", ["", " ,. ", "x" * 61])
def test_a_kept_form_needs_a_name(left_foot, name):
    with pytest.raises(DesignError, match="1 to 60 characters"):
        form_of(build_insole(left_foot, InsoleDesign(left_foot.side)), name)


def test_a_form_comes_back_from_its_file(tmp_path: Path, left_foot):
    path = tmp_path / "form.json"
    kept = form(lambda u, v: 3.25 * u - v)
    write_form(kept, path)
    assert read_form(path) == kept


BAD = [
    ('"version": 1', '"version": 2', "version 2"),
    ('"insole-form"', '"insole-device"', "insole-form"),
    ('"name": "Flat"', '"name": ""', "1 to 60"),
    ('"length_mm"', '"lenght_mm"', "lacks the key"),
    ('"length_mm": 258.0', '"length_mm": 20', "length_mm of form is 20"),
    ("[0.0, 0.35, 0.7, 1.0]", "[0.0, 0.7, 0.35, 1.0]", "along_shares of form must increase"),
    ("[0.0, 0.35, 0.7, 1.0]", "[0.0, 0.35, 1.0]", "has 3 stations"),
    ("[0.0, 0.0, 0.0, 0.0]]", "[0.0, 0.0, 0.0]]", "4 rows of 4"),
    ("[0.0, 0.0, 0.0, 0.0]]", '[0.0, 0.0, 0.0, "a"]]', "must be a number"),
    ('"source": "A plane"', '"side": "left"', "side"),
]


@pytest.mark.parametrize(("old", "new", "sentence"), BAD)
def test_a_form_is_read_strictly(tmp_path: Path, old: str, new: str, sentence: str):
    text = resource_path("forms/flat.json").read_text("utf-8")
    assert old in text
    path = tmp_path / "form.json"
    path.write_text(text.replace(old, new, 1), "utf-8")
    with pytest.raises(InputError, match=sentence) as refused:
        read_form(path)
    assert str(path) in str(refused.value)
